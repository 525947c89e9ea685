//! What is known of other people's solvers, where a chapter asks for it: `{{solvers}}` is the table
//! of all, `{{solvers-by-library}}` what was measured of each, `{{solvers-failing}}` the number of
//! those that do not do what is said of them, and `{{reports}}` are the reports on defects. All are
//! made from the data in `book/strangers/`.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;

use crate::output::files;
use anyhow::{Context, Result};
use pendula_study::solvers::{JUDGED, Judged, Outcome, page, table};

/// The chapter's text with what it asks for; `reports` is the folder of the reports.
pub fn insert(text: &str, reports: &Path) -> Result<String> {
    let mut text = text.to_string();
    let makers: [(&str, &dyn Fn() -> Result<String>); 4] = [
        ("{{solvers}}", &|| Ok(table::table().to_markdown())),
        ("{{solvers-by-library}}", &|| Ok(page::by_library())),
        ("{{solvers-failing}}", &|| {
            let fails = |it: &&Judged| it.outcome() == Outcome::Fails;
            Ok(JUDGED.iter().filter(fails).count().to_string())
        }),
        ("{{reports}}", &|| defects(reports)),
    ];
    for (directive, make) in makers {
        if text.contains(directive) {
            text = text.replace(directive, make()?.trim_end());
        }
    }
    Ok(text)
}

/// The reports on defects, as texts for maintainers, each folded under its title.
fn defects(folder: &Path) -> Result<String> {
    let mut page = String::new();
    for (id, text) in reports(folder)? {
        let report = report(&id, &text).with_context(|| {
            format!("{id}.md: a report begins with a title, a library and a version")
        })?;
        page += &report;
    }
    Ok(page)
}

/// The texts of the reports, by their names.
fn reports(folder: &Path) -> Result<BTreeMap<String, String>> {
    let paths =
        files::list(folder).with_context(|| format!("{} cannot be read", folder.display()))?;
    let named = |path: &Path| Some(path.file_stem()?.to_str()?.to_string());
    let markdown = paths.into_iter().filter(|path| path.extension().is_some_and(|it| it == "md"));
    markdown
        .map(|path| Ok((named(&path).context("a name that is not UTF-8")?, files::text(&path)?)))
        .collect()
}

/// A report as the book shows it; `None` if it does not begin as reports do.
fn report(id: &str, text: &str) -> Option<String> {
    let (title, rest) = text.split_once("\n\n")?;
    let title = escape(title.trim_start_matches("# "));
    let library = text.split_once("*Library:* ")?.1;
    let library = escape(library.split_once(". *Version:*")?.0);
    let lines = rest.lines().filter(|line| !line.starts_with("<!-- ANCHOR"));
    let mut body = String::new();
    for line in lines {
        let _ = match (line, line.strip_prefix("## ")) {
            (_, Some(heading)) => writeln!(body, "**{heading}**"),
            // What the book's highlighter does not know.
            ("```java" | "```octave" | "```r", _) => writeln!(body, "```text"),
            _ => writeln!(body, "{line}"),
        };
    }
    // Where a link to it leads, a browser unfolds it.
    Some(format!(
        "<details class=\"defect\">\n<summary>{library}: {title}</summary>\n\n\
         <a id=\"{id}\"></a>\n{body}\n</details>\n\n"
    ))
}

/// A text for HTML, as it stands.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
