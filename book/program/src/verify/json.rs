//! The report of the judge as JSON, whose fields programs may rely on: `report.schema.json` says
//! which there are.

use pendula::verify::Finding;
use serde_json::{Value, json};

use super::Judged;

/// The number of the schema: another one where a field changes its meaning or goes.
pub const SCHEMA: u32 = 1;

/// The report.
pub fn value(judged: &Judged<'_>) -> Value {
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
        "what_it_is": report.what_it_is(),
        "what_to_look_at": report.look_at,
        "properties": report.findings.iter().map(property).collect::<Vec<_>>(),
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
        "name": finding.name,
        "claimed": finding.claimed,
        "verdict": finding.verdict.name(),
        "measured": finding.measured,
        "value": value,
        "unit": finding.unit,
        "bound": finding.bound,
        "why": finding.why,
    })
}
