//! The report of the judge as Markdown, for a pull request.

use pendula::verify::Verdict;

use super::Judged;
use pendula_output::printable::printable;

/// The report: the verdict, what to look at, and a table.
pub fn text(judged: &Judged<'_>) -> String {
    let Judged { report, .. } = judged;
    let mut text = format!(
        "### {}\n\n{}\n\nClaimed: {}. What it is: {}.\n",
        escaped(judged.title()),
        escaped(&report.summary()),
        escaped(&judged.claimed()),
        escaped(&report.what_it_is())
    );
    if !report.look_at.is_empty() {
        text.push_str("\nWhat to look at:\n\n");
        text.extend(report.look_at.iter().map(|line| format!("* {}\n", escaped(line))));
    }
    text.push_str("\n| property | claimed | verdict | measured |\n| --- | --- | --- | --- |\n");
    for finding in &report.findings {
        let verdict = match finding.verdict {
            Verdict::Fails => "**fails**",
            other => other.name(),
        };
        let claimed = escaped(finding.claimed.as_deref().unwrap_or("–"));
        let told = match finding.verdict {
            Verdict::NotMeasured => escaped(&finding.why),
            Verdict::Fails | Verdict::Unclear => {
                format!("{}: {}", escaped(&finding.measured), escaped(&finding.why))
            }
            _ => escaped(&finding.measured),
        };
        text.push_str(&format!("| {} | {claimed} | {verdict} | {told} |\n", finding.name));
    }
    text
}

/// Text in which nothing is markup: a program's own words may be anything.
fn escaped(text: &str) -> String {
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
