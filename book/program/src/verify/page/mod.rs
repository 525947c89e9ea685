//! The report of the judge as one page to keep.

mod figures;

use pendula::verify::{Claims, Finding, Report, Verdict};

use self::figures::Drawn;
use super::Judged;
use pendula_output::page::{Page, escaped, with_code};

/// The page.
pub fn html(judged: &Judged<'_>) -> String {
    let Judged { command, name, claims, report } = *judged;
    let claimed = judged.claimed();
    let named = if name.is_empty() { String::new() } else { format!(" ({name})") };
    let page = Page {
        title: "An integrator, judged",
        lead: &format!("Claimed: {claimed}. The program: {command}{named}."),
        body: &[verdict(report), properties(report), drawings(report, claims)].concat(),
        style: include_str!("page.css"),
    };
    page.html()
}

fn verdict(report: &Report) -> String {
    let weight = match report.verdict {
        Verdict::Holds | Verdict::Unclaimed => "moved",
        _ => "alarm",
    };
    let look_at: String = report
        .look_at
        .iter()
        .map(|line| format!("<li>What to look at: {}</li>\n", with_code(line)))
        .collect();
    format!(
        r#"<section id="verdict" aria-labelledby="verdict-title">
<h2 id="verdict-title">The verdict</h2>
<ul class="sentences">
<li class="{weight}">{}</li>
{look_at}<li>What it is: {}.</li>
</ul>
</section>
"#,
        escaped(&report.summary()),
        with_code(&report.what_it_is())
    )
}

fn properties(report: &Report) -> String {
    let rows: String = report.findings.iter().map(row).collect();
    format!(
        r#"
<section aria-labelledby="properties-title">
<h2 id="properties-title">Property by property</h2>
<div class="table-wrapper" tabindex="0" role="region" aria-label="Property by property">
<table class="properties">
<thead><tr><th scope="col">Property</th><th scope="col">claimed</th><th scope="col">verdict</th>
<th scope="col">measured, and what follows</th></tr></thead>
<tbody>
{rows}</tbody></table></div>
</section>
"#
    )
}

fn row(finding: &Finding) -> String {
    let class = if finding.verdict == Verdict::Fails { r#" class="alarm""# } else { "" };
    let [name, claimed, verdict] =
        [finding.name, finding.claimed.as_deref().unwrap_or("–"), finding.verdict.name()]
            .map(escaped);
    let [measured, why] = [&finding.measured, &finding.why].map(|text| with_code(text));
    format!(
        r#"<tr{class}><th scope="row">{name}</th><td>{claimed}</td><td>{verdict}</td>
<td>{measured}<p class="how">{why}</p></td></tr>
"#
    )
}

fn drawings(report: &Report, claims: &Claims) -> String {
    let figure = |Drawn { svg, caption }: &Drawn| {
        format!("<figure>\n{svg}<figcaption>{}</figcaption>\n</figure>\n", escaped(caption))
    };
    let figures: String = figures::all(&report.evidence, claims).iter().map(figure).collect();
    if figures.is_empty() {
        return figures;
    }
    format!(
        r#"
<section aria-labelledby="figures-title">
<h2 id="figures-title">What decides</h2>
{figures}</section>
"#
    )
}
