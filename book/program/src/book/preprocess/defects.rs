//! The reports on defects, as texts for maintainers.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::path::PathBuf;

use super::text::escape;
use crate::book::at_root;

/// The reports on defects, each folded under its title; those of solvers and of fixed steps.
pub fn defects() -> String {
    let mut page = String::new();
    for (id, text) in reports_on_defects() {
        let (title, rest) = text.split_once("\n\n").expect("a title");
        let title = escape(title.trim_start_matches("# "));
        let library = text.split_once("*Library:* ").expect("a library").1;
        let library = escape(library.split_once(". *Version:*").expect("a version").0);
        let lines = rest.lines().filter(|line| !line.starts_with("<!-- ANCHOR"));
        let lines = lines.map(|line| match (line, line.strip_prefix("## ")) {
            (_, Some(heading)) => format!("**{heading}**\n"),
            // What the book's highlighter does not know.
            ("```java" | "```octave" | "```r", _) => "```text\n".to_string(),
            _ => format!("{line}\n"),
        });
        // Where a link to it leads, a browser unfolds it.
        let _ = write!(
            page,
            "<details>\n<summary>{library}: {title}</summary>\n\n<a id=\"{id}\"></a>\n{}\n\
             </details>\n\n",
            lines.collect::<String>()
        );
    }
    page
}

/// The reports on defects, by their names.
pub fn reports_on_defects() -> BTreeMap<String, String> {
    let folder = fs::read_dir(at_root("book/strangers/reports")).expect("a folder");
    let paths = folder.map(|entry| entry.expect("a file").path());
    let read = |path: PathBuf| {
        let name = path.file_stem().and_then(|stem| stem.to_str()).expect("a name").to_string();
        (name, fs::read_to_string(path).expect("a report"))
    };
    paths.map(read).collect()
}
