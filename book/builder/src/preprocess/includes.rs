//! Checks that every include finds its file and anchor.
//!
//! mdBook exits with status 0 when an included file is missing, and shows nothing at all when an
//! anchor is. So the chapters are read from disk again, as they were before mdBook's `links` step,
//! and their includes are resolved by the same rules.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use mdbook_preprocessor::book::Book;

use super::{chapters, name};
use crate::{Pattern, pattern};
use pendula_output::files;

/// Checks the includes of every chapter that has a file in the folder `source`, and returns the
/// files that they name.
pub fn check(source: &Path, book: &Book) -> Result<BTreeSet<PathBuf>> {
    let mut files = BTreeSet::new();
    for chapter in chapters(book) {
        let Some(path) = &chapter.source_path else { continue };
        let file = source.join(path);
        files::text(&file)
            .and_then(|text| includes(&text, file.parent().unwrap_or(source)))
            .map(|named| files.extend(named))
            .with_context(|| format!("chapter {}", name(chapter)))?;
    }
    Ok(files)
}

/// The files that a text includes, whose relative paths start from `folder`.
fn includes(text: &str, folder: &Path) -> Result<Vec<PathBuf>> {
    // The first alternative is mdBook's escape: everything up to the last braces of the line.
    static LINK: Pattern = Pattern::new(|| {
        pattern(r"\\\{\{#.*\}\}|\{\{\s*#(?<kind>[a-zA-Z0-9_]+)\s+(?<rest>[^}]+)\}\}")
    });
    let mut files = Vec::new();
    for link in LINK.captures_iter(text) {
        let (Some(kind), Some(rest)) = (link.name("kind"), link.name("rest")) else { continue };
        let kind = kind.as_str();
        ensure!(kind == "include", "{}: there is no {kind}; there is include", &link[0]);
        let argument = rest.as_str().split_whitespace().next().unwrap_or_default();
        let (path, anchor) = argument.split_once(':').unwrap_or((argument, ""));
        files.push(folder.join(path));
        included(folder, path, anchor).with_context(|| link[0].to_string())?;
    }
    Ok(files)
}

/// Checks the text that mdBook will include; it is never empty. By numbers of lines, which move,
/// nothing is.
fn included(folder: &Path, path: &str, anchor: &str) -> Result<()> {
    let file = folder.join(path);
    let text = files::read_to_string(&file).with_context(|| format!("there is no file {path}"))?;
    let included = match anchor {
        "" => text,
        _ => anchored(&text, anchor)
            .with_context(|| format!("{path} has no line with ANCHOR: {anchor}"))?,
    };
    ensure!(!included.trim().is_empty(), "{path} has nothing between these anchors");
    // mdBook would follow it, and nobody check it.
    ensure!(!included.contains("{{#"), "{path} includes something itself");
    Ok(())
}

/// The lines from `ANCHOR: name` to `ANCHOR_END: name`, or to the end of the file, without those of
/// other anchors.
fn anchored(text: &str, name: &str) -> Option<String> {
    let marks = |line: &str, mark: &str| {
        let rest = line.split_once(mark).map_or("", |(_, rest)| rest);
        rest.split_whitespace().next() == Some(name)
    };
    let mut lines = text.lines().skip_while(|line| !marks(line, "ANCHOR:"));
    lines.next()?;
    let lines = lines.take_while(|line| !marks(line, "ANCHOR_END:"));
    Some(lines.filter(|line| !line.contains("ANCHOR")).collect())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    fn followed(text: &str) -> Result<()> {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
        write("step.rs", "use a;\n// ANCHOR: step\nlet a = 1;\n// ANCHOR_END: step\nend\n");
        let empty = "// ANCHOR: step\n// ANCHOR: a\n\n// ANCHOR_END: a\n// ANCHOR_END: step\nend\n";
        write("empty.rs", empty);
        write("nested.md", "{{#include step.rs:step}}\n");
        includes(text, folder.path()).map(drop)
    }

    /// Catches: a check that refuses what mdBook includes.
    #[test]
    fn what_mdbook_includes_is_accepted() {
        for text in [
            "{{#include step.rs}}",
            "{{#include step.rs:step}}",
            "{{ #include step.rs:step }}",
            "\\{{#include no/such/file.rs}}",
            "no include",
        ] {
            followed(text).unwrap_or_else(|error| panic!("{text}: {error:#}"));
        }
    }

    /// Catches: a book with a listing missing, built with status 0.
    #[test]
    fn what_mdbook_leaves_out_in_silence_is_an_error() {
        for (text, named) in [
            ("{{#include steps.rs}}", "steps.rs"),
            ("{{#include step.rs:stop}}", "ANCHOR: stop"),
            ("{{#include empty.rs:step}}", "nothing between"),
            ("{{#include step.rs:2:3}}", "ANCHOR: 2:3"),
            ("{{#rustdoc_include step.rs:step}}", "there is include"),
            ("{{#include nested.md}}", "includes something itself"),
            ("{{#inlcude step.rs}}", "inlcude"),
        ] {
            let error = format!("{:#}", followed(text).unwrap_err());
            assert!(error.contains(named), "{text}: {error}");
        }
    }
}
