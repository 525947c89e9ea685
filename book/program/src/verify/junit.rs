//! The report of the judge as JUnit XML, which servers that run tests read: a test case for each
//! property that is claimed.

use pendula::verify::{Finding, Verdict};

use super::Judged;

/// The report. A claim that fails is a failure; one that was not measured or is unclear is an
/// error, or skipped where that is allowed (`lenient`).
pub fn text(judged: &Judged<'_>, lenient: bool) -> String {
    let claimed: Vec<&Finding> =
        judged.report.findings.iter().filter(|finding| finding.claimed.is_some()).collect();
    let count = |these: fn(Verdict) -> bool| {
        claimed.iter().filter(|finding| these(finding.verdict)).count()
    };
    let open = count(is_open);
    let (errors, skipped) = if lenient { (0, open) } else { (open, 0) };
    let suite = escaped(judged.title());
    let cases: String = claimed.iter().map(|finding| case(finding, &suite, lenient)).collect();
    let told = [judged.report.look_at.join("\n"), judged.report.summary()].join("\n");
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
        escaped(told.trim_start())
    )
}

/// Neither shown nor refuted.
fn is_open(verdict: Verdict) -> bool {
    matches!(verdict, Verdict::NotMeasured | Verdict::Unclear)
}

fn case(finding: &Finding, suite: &str, lenient: bool) -> String {
    let claimed = finding.claimed.as_deref().unwrap_or_default();
    let [name, message] = [format!("{}: {claimed}", finding.name), finding.measured.clone()]
        .map(|text| escaped(&text));
    let verdict = finding.verdict.name();
    let why = escaped(&finding.why);
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
fn escaped(text: &str) -> String {
    let allowed = |c: char| match c {
        '\n' | '\t' => c,
        '\u{fffe}' | '\u{ffff}' => '\u{fffd}',
        c if c.is_control() => '\u{fffd}',
        c => c,
    };
    pendula_output::page::escaped(&text.chars().map(allowed).collect::<String>())
}
