//! The style sheets of a page, joined: a browser that waits for one file instead of ten shows the
//! page sooner. One sheet has what every page needs, and another what the pages with a lab need
//! besides. What single pages bring along, the styles of formulas among it, stays by itself.
//!
//! mdBook loads a sheet for the listings of each of its themes, and has a script of its own keep
//! all but one of them off. Here each stands in the rules of its themes.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use anyhow::{Context, Result, ensure};
use regex::{Captures, Regex};

use crate::book::page_files::FOLDER;
use crate::output::files;

/// What every page has.
pub const ALL: &str = "theme/book.css";

/// What the pages with a lab, or with a figure that it moves, have besides.
const LAB: &str = "theme/lab/bundle.css";

/// The classes of the root in whose themes a sheet of listings counts, by its id.
const THEMES: [(&str, &str); 3] = [
    ("mdbook-highlight-css", ".light, .rust"),
    ("mdbook-tomorrow-night-css", ".coal, .navy"),
    ("mdbook-ayu-highlight-css", ".ayu"),
];

/// Which sheet has become part of which.
#[derive(Debug, Default)]
pub struct Sheets {
    joined: BTreeMap<String, &'static str>,
}

impl Sheets {
    /// Joins the sheets that the first page loads, in their order, in the folder of the pages.
    pub fn join(pages: &Path) -> Result<Sheets> {
        let index = files::text(&pages.join("index.html"))?;
        let (mut sheets, mut texts) = (Sheets::default(), BTreeMap::<_, String>::new());
        for link in pattern().captures_iter(&index) {
            let name = &link["file"];
            let into = if name.starts_with(FOLDER) { LAB } else { ALL };
            if name.starts_with("assets/") || sheets.joined.contains_key(name) {
                continue;
            }
            let file = pages.join(name);
            let text = part(&files::text(&file)?, name, &link[0])?;
            *texts.entry(into).or_default() += &format!("/* {name} */\n{text}\n");
            sheets.joined.insert(name.to_string(), into);
            fs::remove_file(&file).with_context(|| file.display().to_string())?;
        }
        for (name, text) in texts {
            let file = pages.join(name);
            fs::create_dir_all(file.parent().context("a folder of themes")?)?;
            fs::write(&file, text).with_context(|| file.display().to_string())?;
        }
        Ok(sheets)
    }

    /// The page with the joined sheets in the place of the first of their parts.
    pub fn linked(&self, page: &str) -> String {
        let mut seen = Vec::new();
        let replaced = pattern().replace_all(page, |link: &Captures<'_>| {
            let Some(into) = self.joined.get(&link["file"]) else { return link[0].to_string() };
            if seen.contains(into) {
                return String::new();
            }
            seen.push(into);
            format!("<link rel=\"stylesheet\" href=\"{}{into}\">\n", &link["root"])
        });
        replaced.into_owned()
    }
}

/// A link to a style sheet, with the rest of its line.
fn pattern() -> Regex {
    let link = r#"<link rel="stylesheet"[^>]* href="(?<root>(?:\.\./)*)(?<file>[^"]*)"[^>]*>\s*"#;
    Regex::new(link).expect("the pattern is a constant")
}

/// What becomes of a sheet, which a page loads by `link`.
fn part(sheet: &str, name: &str, link: &str) -> Result<String> {
    let sheet = without_indents(&without_blocks(sheet));
    // These count at the beginning of a sheet alone.
    for rule in ["@import", "@charset", "@namespace"] {
        ensure!(!sheet.contains(rule), "{name} cannot be joined because it has {rule}");
    }
    let address = Regex::new(r#"url\((?<quote>["']?)(?<at>[^"')]+)"#).expect("a constant");
    let folder = name.rsplit_once('/').map_or(String::new(), |(folder, _)| format!("{folder}/"));
    // From the folder of the joined sheet, which is one below the root, or two.
    let up = if name.starts_with(FOLDER) { "../../" } else { "../" };
    let sheet = address.replace_all(&sheet, |found: &Captures<'_>| {
        let at = &found["at"];
        let is_whole = at.starts_with(['#', '/']) || at.contains(':');
        let root = if is_whole { String::new() } else { format!("{up}{folder}") };
        format!("url({}{root}{at}", &found["quote"])
    });
    let sheet = sheet.trim();
    Ok(if link.contains("media=\"print\"") {
        format!("@media print {{\n{sheet}\n}}")
    } else if let Some((_, themes)) = THEMES.iter().find(|(id, _)| link.contains(id)) {
        // Without a weight of its own, so that the same rules as before come after it.
        format!(":where({themes}) {{\n{sheet}\n}}")
    } else {
        sheet.to_string()
    })
}

/// A style sheet without its comments, for which nobody has to wait; one that does not end is left
/// as it is.
fn without_blocks(sheet: &str) -> String {
    let (mut light, mut rest) = (String::new(), sheet);
    while let Some((before, after)) = rest.split_once("/*") {
        let Some((_, after)) = after.split_once("*/") else { break };
        light += before;
        rest = after;
    }
    light + rest
}

/// A style sheet without what stands before and between its lines; within a text that goes on in
/// the next line, nothing changes.
fn without_indents(sheet: &str) -> String {
    let (mut light, mut goes_on) = (String::new(), false);
    for line in sheet.lines() {
        let line = if goes_on { line } else { line.trim_start() };
        goes_on = line.ends_with('\\');
        if !line.is_empty() {
            light += line;
            light.push('\n');
        }
    }
    light
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "<link rel=\"stylesheet\" href=\"assets/katex/katex.min.css\">\n\
        <link rel=\"stylesheet\" href=\"css/print-1a2b.css\" media=\"print\">\n\
        <link rel=\"stylesheet\" href=\"fonts/fonts.css\">\n\
        <link rel=\"stylesheet\" id=\"mdbook-ayu-highlight-css\" href=\"ayu-highlight.css\">\n\
        <link rel=\"stylesheet\" href=\"theme/lab/lab.css\">\n\
        <link rel=\"stylesheet\" href=\"theme/lab/moved.css\">\n<main>";

    /// Catches: a sheet left out or in another order, one for paper or for one theme that counts
    /// always, a font at an address that is right from the old sheet alone; a name of mdBook with
    /// its hash that is not found; a page that loads a part twice, or the lab without need.
    #[test]
    fn sheets_are_joined_and_pages_load_what_has_become_of_them() {
        let folder = tempfile::tempdir().unwrap();
        let pages = folder.path();
        let write = |name: &str, text: &str| {
            fs::create_dir_all(pages.join(name).parent().unwrap()).unwrap();
            fs::write(pages.join(name), text).unwrap();
        };
        write("index.html", PAGE);
        write("css/print-1a2b.css", "/* on paper */\na { b: c }\n");
        write("fonts/fonts.css", "@font-face { src: url(\"a.woff2\"), url('data:x') }\n");
        write("ayu-highlight.css", ".hljs { d: e }\n");
        write("theme/lab/lab.css", ".lab { f: url(g.svg) }");
        write("theme/lab/moved.css", ".moved { h: i }");
        write("assets/katex/katex.min.css", ".katex { j: k }");
        let sheets = Sheets::join(pages).unwrap();
        let read = |name: &str| fs::read_to_string(pages.join(name)).unwrap();
        assert_eq!(
            read("theme/book.css"),
            "/* css/print-1a2b.css */\n@media print {\na { b: c }\n}\n\
             /* fonts/fonts.css */\n\
             @font-face { src: url(\"../fonts/a.woff2\"), url('data:x') }\n\
             /* ayu-highlight.css */\n:where(.ayu) {\n.hljs { d: e }\n}\n"
        );
        assert_eq!(
            read("theme/lab/bundle.css"),
            "/* theme/lab/lab.css */\n.lab { f: url(../../theme/lab/g.svg) }\n\
             /* theme/lab/moved.css */\n.moved { h: i }\n"
        );
        assert!(!pages.join("fonts/fonts.css").exists());
        assert!(pages.join("assets/katex/katex.min.css").exists());

        let linked = "<link rel=\"stylesheet\" href=\"assets/katex/katex.min.css\">\n\
            <link rel=\"stylesheet\" href=\"theme/book.css\">\n\
            <link rel=\"stylesheet\" href=\"theme/lab/bundle.css\">\n<main>";
        assert_eq!(sheets.linked(PAGE), linked);
        let below = "<link rel=\"stylesheet\" href=\"../fonts/fonts.css\">\n";
        let linked = "<link rel=\"stylesheet\" href=\"../theme/book.css\">\n";
        assert_eq!(sheets.linked(below), linked);
    }

    /// Catches: a rule that counts nowhere in a joined sheet, and is lost without a word.
    #[test]
    fn what_must_begin_a_sheet_cannot_be_joined() {
        let error = part("@import 'a.css';", "x.css", "").unwrap_err().to_string();
        assert_eq!(error, "x.css cannot be joined because it has @import");
    }

    /// Catches: a rule lost with a comment, or a comment that is kept.
    #[test]
    fn comments_are_left_out_and_nothing_else() {
        assert_eq!(without_blocks("a {}\n/* x { */\nb { /* y */ c: d }"), "a {}\n\nb {  c: d }");
        assert_eq!(without_blocks("a {} /* b {}"), "a {} /* b {}");
        assert_eq!(without_indents("a {\n\n  b: 'c \\\n  d'\n  e\n"), "a {\nb: 'c \\\n  d'\ne\n");
    }
}
