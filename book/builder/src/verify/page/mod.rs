//! The report of the judge as one page to keep.

mod figures;

use anyhow::Result;
use pendula::verify::{Claims, Finding, Report, Verdict};
use serde_json::{Value, json};

use crate::page::{Page, with_code};

/// The page: what the judge found of `command`, which calls itself `name`, and of which this is
/// claimed.
///
/// # Errors
/// If mdBook's theme cannot be read.
pub fn html(report: &Report, claims: &Claims, command: &str, name: &str) -> Result<String> {
    let claimed = match claims.to_string() {
        none if none.is_empty() => "nothing but what everybody claims".to_string(),
        claimed => claimed,
    };
    let named = if name.is_empty() { String::new() } else { format!(" ({name})") };
    let page = Page {
        title: "An integrator, judged",
        lead: &format!("Claimed: {claimed}. The program: {command}{named}."),
        template: include_str!("page.hbs"),
        style: include_str!("page.css"),
        script: "",
    };
    page.html(&data(report, claims))
}

/// What the template prints.
fn data(report: &Report, claims: &Claims) -> Value {
    let is = match &report.identity {
        Some(identity) => identity.to_string(),
        None => report.description.clone(),
    };
    let failures: Vec<&str> = report.failures().collect();
    let sentence = match report.verdict {
        Verdict::Fails => format!("A claim fails: {}.", failures.join(", ")),
        Verdict::Unclear => "No claim fails; some cannot be told.".to_string(),
        _ => "Every claim holds.".to_string(),
    };
    json!({
        "sentence": sentence,
        "weight": if report.verdict == Verdict::Fails { "alarm" } else { "moved" },
        "is": with_code(&is),
        "findings": report.findings.iter().map(finding).collect::<Vec<_>>(),
        "figures": figures::all(&report.evidence, claims),
    })
}

fn finding(finding: &Finding) -> Value {
    json!({
        "name": finding.name,
        "claimed": finding.claimed.as_deref().unwrap_or("–"),
        "verdict": finding.verdict.name(),
        "fails": finding.verdict == Verdict::Fails,
        "measured": with_code(&finding.measured),
        "why": with_code(&finding.why),
    })
}
