//! The report of the judge for other programs: as JSON, as JUnit XML, and as Markdown.

use serde_json::{Value, json};

use crate::printable::{escaped, printable};
use crate::{Advice, Claims, Departure, Finding, Report, Verdict};

/// A program with what was found of it.
#[derive(Clone, Copy, Debug)]
pub struct Judged<'a> {
    /// The command that started it; empty where it is a function that is called.
    pub command: &'a str,
    /// What it calls itself, which may be nothing.
    pub name: &'a str,
    /// What was claimed of it.
    pub claims: &'a Claims,
    /// What was found.
    pub report: &'a Report,
}

impl Judged<'_> {
    /// Its name, or the command where it has none; a function may have neither.
    pub fn title(&self) -> &str {
        match (self.name, self.command) {
            ("", "") => "an integrator",
            ("", command) => command,
            (name, _) => name,
        }
    }

    /// What is claimed, in words.
    pub fn claimed(&self) -> String {
        let claims = self.claims.to_string();
        if claims.is_empty() { "nothing".to_string() } else { claims }
    }
}

/// The number of the schema: another one where a field changes its meaning or goes.
const SCHEMA: u32 = 1;

/// The report as JSON, on whose fields programs may rely: `report.schema.json` says which there
/// are.
pub fn json(judged: &Judged<'_>) -> Value {
    let Judged { command, name, claims, report } = judged;
    json!({
        "schema": SCHEMA,
        "version": env!("CARGO_PKG_VERSION"),
        "program": { "command": command, "name": name },
        "claims": claims.to_string(),
        "verdict": report.verdict.name(),
        "summary": report.summary(),
        "identity": report.identity.as_ref().map(|identity| identity.method),
        "mistake": report.mistake.map(|mistake| &mistake.name),
        "departure": report.departure.as_ref().map(departure),
        "what_it_is": report.what_it_is(),
        "what_to_look_at": report.look_at(),
        "causes": report.advice.iter().map(cause).collect::<Vec<_>>(),
        "properties": report.findings.iter().map(property).collect::<Vec<_>>(),
        "text": report.to_string(),
    })
}

/// In what it departs from the pendulum, with its numbers.
fn departure(found: &Departure) -> Value {
    json!({
        "kind": found.kind().name(),
        "place": found.place().name(),
        "values": found.values(),
        "equation": found.equation().map(ToString::to_string),
        "sentence": found.sentence(),
    })
}

/// A cause of what fails, and the names of the properties that fail by it.
fn cause(Advice { cause, explains }: &Advice) -> Value {
    json!({
        "kind": cause.name(),
        "explains": explains.iter().map(|property| property.name()).collect::<Vec<_>>(),
        "sentence": cause.to_string(),
    })
}

/// A property: its value is a number or, where several were measured, all of them.
fn property(finding: &Finding) -> Value {
    let value = match &finding.values[..] {
        [] => Value::Null,
        [one] => json!(one),
        several => json!(several),
    };
    json!({
        "name": finding.property.name(),
        "finding": finding.measurement.name(),
        "claimed": finding.claimed,
        "verdict": finding.verdict.name(),
        "measured": finding.measured(),
        "value": value,
        "unit": finding.unit,
        "bound": finding.bound,
        "why": finding.why(),
    })
}

/// The report as JUnit XML, which servers that run tests read: a test case for each property that
/// is claimed. A claim that fails is a failure; one that was not measured or is unclear is an
/// error, or skipped where that is allowed (`lenient`).
pub fn junit(judged: &Judged<'_>, lenient: bool) -> String {
    let claimed: Vec<&Finding> =
        judged.report.findings.iter().filter(|finding| finding.claimed.is_some()).collect();
    let count = |these: fn(Verdict) -> bool| {
        claimed.iter().filter(|finding| these(finding.verdict)).count()
    };
    let open = count(is_open);
    let (errors, skipped) = if lenient { (0, open) } else { (open, 0) };
    let suite = as_xml(judged.title());
    let cases: String = claimed.iter().map(|finding| case(finding, &suite, lenient)).collect();
    let told = [judged.report.look_at().join("\n"), judged.report.summary()].join("\n");
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<testsuites>
  <testsuite name="{suite}" tests="{}" failures="{}" errors="{errors}" skipped="{skipped}" time="0">
{cases}    <system-out>{}</system-out>
  </testsuite>
</testsuites>
"#,
        claimed.len(),
        count(|verdict| verdict == Verdict::Fails),
        as_xml(told.trim_start())
    )
}

/// Neither shown nor refuted.
fn is_open(verdict: Verdict) -> bool {
    !matches!(verdict, Verdict::Holds | Verdict::Fails | Verdict::Unclaimed)
}

fn case(finding: &Finding, suite: &str, lenient: bool) -> String {
    let claimed = finding.claimed.as_deref().unwrap_or_default();
    let [name, message] =
        [format!("{}: {claimed}", finding.property), finding.measured()].map(|text| as_xml(&text));
    let verdict = finding.verdict.name();
    let why = as_xml(&finding.why());
    let result = match finding.verdict {
        Verdict::Fails => {
            format!("<failure message=\"{message}\" type=\"{verdict}\">{why}</failure>")
        }
        open if is_open(open) && lenient => format!("<skipped message=\"{verdict}: {why}\"/>"),
        open if is_open(open) => {
            format!("<error message=\"{message}\" type=\"{verdict}\">{why}</error>")
        }
        _ => String::new(),
    };
    format!("    <testcase classname=\"{suite}\" name=\"{name}\" time=\"0\">{result}</testcase>\n")
}

/// Text as XML: markup and what XML cannot hold replaced.
fn as_xml(text: &str) -> String {
    let allowed = |c: char| match c {
        '\n' | '\t' => c,
        '\u{fffe}' | '\u{ffff}' => '\u{fffd}',
        c if c.is_control() => '\u{fffd}',
        c => c,
    };
    escaped(&text.chars().map(allowed).collect::<String>())
}

/// The report as Markdown, for a pull request: the verdict, what to look at, and a table.
pub fn markdown(judged: &Judged<'_>) -> String {
    let Judged { report, .. } = judged;
    let mut text = format!(
        "### {}\n\n{}\n\nClaimed: {}. What it is: {}.\n",
        as_markdown(judged.title()),
        as_markdown(&report.summary()),
        as_markdown(&judged.claimed()),
        as_markdown(&report.what_it_is())
    );
    let look_at = report.look_at();
    if !look_at.is_empty() {
        text.push_str("\nWhat to look at:\n\n");
        text.extend(look_at.iter().map(|line| format!("* {}\n", as_markdown(line))));
    }
    text.push_str("\n| property | claimed | verdict | measured |\n| --- | --- | --- | --- |\n");
    for finding in &report.findings {
        let verdict = match finding.verdict {
            Verdict::Fails => "**fails**",
            other => other.name(),
        };
        let claimed = as_markdown(finding.claimed.as_deref().unwrap_or("–"));
        let told = match finding.verdict {
            Verdict::NotMeasured => as_markdown(&finding.why()),
            Verdict::Fails | Verdict::Unclear => {
                format!("{}: {}", as_markdown(&finding.measured()), as_markdown(&finding.why()))
            }
            _ => as_markdown(&finding.measured()),
        };
        text.push_str(&format!("| {} | {claimed} | {verdict} | {told} |\n", finding.property));
    }
    text
}

/// Text in which nothing is markup: a program's own words may be anything.
fn as_markdown(text: &str) -> String {
    let mut escaped = String::new();
    for c in printable(text).chars() {
        if c.is_ascii_punctuation() && !matches!(c, '.' | ',' | ':' | ';' | '/' | '=' | '\'' | '%')
        {
            escaped.push('\\');
        }
        escaped.push(if c.is_whitespace() { ' ' } else { c });
    }
    escaped
}
