//! The report of the judge as JSON, whose fields programs may rely on.

use pendula::verify::{Finding, Report};
use serde_json::{Value, json};

/// The report: `verdict`, `identity` and `properties`.
pub fn value(report: &Report) -> Value {
    json!({
        "verdict": report.verdict.name(),
        "identity": report.identity.as_ref().map(|identity| identity.method),
        "properties": report.findings.iter().map(property).collect::<Vec<_>>(),
    })
}

fn property(finding: &Finding) -> Value {
    json!({
        "name": finding.name,
        "claimed": finding.claimed,
        "measured": finding.measured,
        "verdict": finding.verdict.name(),
        "why": finding.why,
    })
}

#[cfg(test)]
mod tests {
    use pendula::verify::{Evidence, Verdict};

    use super::*;

    /// Catches: a field that is missing or has another name, a null that is a text.
    #[test]
    fn every_field_has_its_name() {
        let finding = Finding {
            name: "order",
            claimed: None,
            measured: "2.00".to_string(),
            verdict: Verdict::Unclaimed,
            why: "three slopes".to_string(),
        };
        let report = Report {
            verdict: Verdict::Unclear,
            identity: None,
            description: "nothing on the list".to_string(),
            findings: vec![finding],
            evidence: Evidence::default(),
        };
        let expected = r#"{"verdict": "unclear", "identity": null, "properties": [{"name": "order",
            "claimed": null, "measured": "2.00", "verdict": "unclaimed", "why": "three slopes"}]}"#;
        assert_eq!(value(&report), serde_json::from_str::<Value>(expected).unwrap());
    }
}
