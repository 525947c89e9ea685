//! Library by library, what was measured.

use std::fmt::Write;

use pendula_judge::Verdict;

use super::text::{escape, plain, raised};
use super::{Aside, Finding, JUDGED, Judged, Library, Outcome, SOLVERS};
use crate::report::table::Table;

/// Library by library, solver by solver, what was measured, as Markdown.
pub fn by_library() -> String {
    let mut page = String::new();
    for library in &SOLVERS.library {
        let Library { name, id, language, version, docs, install, called, also, .. } = library;
        let _ = write!(
            page,
            "## {name} {version} {{ #{id} }}\n\n{language} · {} · [documentation]({docs})\n\n\
             *How it was called:* {}\n\n",
            plain(install),
            plain(called.trim())
        );
        for report in also {
            let _ = write!(page, "Besides: [`{report}`](others.md#{report}).\n\n");
        }
        for it in JUDGED.iter().filter(|it| it.library.id == *id) {
            page += &of_a_solver(it);
        }
    }
    page
}

fn of_a_solver(it: &Judged) -> String {
    let Judged { entry, found, .. } = it;
    let names = it.with(Verdict::Fails).collect::<Vec<_>>().join(", ");
    let told = match it.outcome() {
        Outcome::Holds => "every claim holds".to_string(),
        Outcome::Unclaimed => "nothing is claimed".to_string(),
        outcome if names.is_empty() => format!("{}: {}", outcome.name(), it.why()),
        outcome => format!("{}: {names}", outcome.name()),
    };
    let mut page = format!(
        "<details>\n<summary><code>{}</code> {told}</summary>\n\n<a id=\"{}\"></a>\n\n\
         {} ({})\n\n",
        escape(&entry.name),
        it.anchor(),
        match entry.quote.trim() {
            "" => "*Nothing is promised that could be judged.*".to_string(),
            quote => format!("> “{}”", plain(quote)),
        },
        plain(&entry.place)
    );
    if let Some(note) = &entry.note {
        let _ = write!(page, "{}\n\n", plain(note));
    }
    for it in &entry.documented {
        let (quote, place) = (plain(it.quote.trim()), plain(&it.place));
        let _ = write!(page, "> Of *{}*: “{quote}” — {place}\n\n", it.property);
    }
    for it in &entry.defect {
        let names = it.properties.join(", ");
        let _ = write!(page, "*{names}* fails by [this defect](others.md#{}).\n\n", it.id);
    }
    for it in &entry.aside {
        let _ = write!(page, "*{}* was set aside: {}\n\n", it.property, plain(&it.why));
    }
    for Aside { property, why } in &SOLVERS.aside {
        if found.failures().any(|name| name == property) {
            let _ = write!(page, "*{property}* does not count: {}\n\n", plain(why));
        }
    }
    for line in &found.look_at {
        let _ = writeln!(page, "* {}", raised(&plain(line)));
    }
    page.push('\n');
    if found.findings.is_empty() {
        return page + "</details>\n\n";
    }
    let mut table = Table::new(["property", "claimed", "verdict", "bound", "measured"]);
    for finding in &found.findings {
        table.push([
            finding.name.to_string(),
            if finding.claimed.is_empty() { "–" } else { finding.claimed }.to_string(),
            finding.verdict.name().to_string(),
            bound(finding),
            raised(&plain(finding.measured)),
        ]);
    }
    page + &table.with_remarks(5).to_markdown() + "\n</details>\n\n"
}

/// The bound of a finding, where one number decides.
fn bound(finding: &Finding) -> String {
    let Some(bound) = finding.bound.filter(|it| *it != 0.0) else { return "–".to_string() };
    let text =
        if (1.0..1e4).contains(&bound) { format!("{bound:.1}") } else { format!("{bound:.1e}") };
    format!("{text} {}", finding.unit).trim_end().to_string()
}
