//! What is checked before anything is set.
//!
//! Every include finds its file and anchor: mdBook exits with status 0 when an included file is
//! missing, and shows nothing at all when an anchor is. So the chapters are read from disk again,
//! as they were before mdBook's `links` step, and their includes are resolved by the same rules.
//!
//! And the snapshots in the book are what the code makes. A chapter includes the file that was
//! reviewed. Whoever changes a method and does not review what moved, or types a digit over, would
//! publish a book in which the tables contradict the numbers in the text, which are computed.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use mdbook_preprocessor::book::Book;

use super::{chapters, name};
use crate::book::ledger::Ledger;
use crate::book::versions::{File, name_of};
use crate::book::{Pattern, pattern};
use crate::output::files;

/// Checks the includes of every chapter that has a file in the folder `source`, and returns the
/// files that they name.
pub fn includes(source: &Path, book: &Book) -> Result<BTreeSet<PathBuf>> {
    let mut files = BTreeSet::new();
    for chapter in chapters(book) {
        let Some(path) = &chapter.source_path else { continue };
        let file = source.join(path);
        files::text(&file)
            .and_then(|text| included(&text, file.parent().unwrap_or(source)))
            .map(|named| files.extend(named))
            .with_context(|| format!("chapter {}", name(chapter)))?;
    }
    Ok(files)
}

/// The files that a text includes, whose relative paths start from `folder`.
fn included(text: &str, folder: &Path) -> Result<Vec<PathBuf>> {
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
        has_text(folder, path, anchor).with_context(|| link[0].to_string())?;
    }
    Ok(files)
}

/// Whether a test has made this snapshot, and nobody has accepted it.
fn not_accepted(file: &Path) -> bool {
    file.with_extension("snap.new").exists()
}

/// Checks the text that mdBook will include; it is never empty. By numbers of lines, which move,
/// nothing is.
fn has_text(folder: &Path, path: &str, anchor: &str) -> Result<()> {
    let file = folder.join(path);
    let text = files::read_to_string(&file).with_context(|| match not_accepted(&file) {
        true => format!("{path} is made and not accepted: `pendula review` shows it"),
        false => format!("there is no file {path}"),
    })?;
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

/// Compares each snapshot among the included files with what `ledger` makes of it. Those that a
/// command or a test makes cannot be compared.
pub fn snapshots(included: &BTreeSet<PathBuf>, ledger: &dyn Ledger) -> Result<()> {
    let mut quoted: BTreeMap<String, (String, File)> = BTreeMap::new();
    let is_in_folder = |path: &&PathBuf| path.parent().is_some_and(|at| at.ends_with("snapshots"));
    for path in included.iter().filter(is_in_folder) {
        let shown = format!("snapshots/{}", path.file_name().unwrap_or_default().display());
        let Some(name) = name_of(&shown, ".snap") else { continue };
        let file = File::parse(name, &files::text(path)?, Path::new(&shown));
        let file = file.with_context(|| {
            format!(
                "a snapshot is corrupt: restore its file, or remove it and run `pendula review \
                 --accept {name}`"
            )
        })?;
        if file.content.kind.is_of_the_study() {
            quoted.insert(name.to_string(), (shown.clone(), file));
        }
    }
    let (made, failed) = ledger.snapshots(quoted.keys().cloned().collect())?;
    let mut moved = Vec::new();
    for (name, (shown, file)) in &quoted {
        match (made.get(name), failed.get(name)) {
            (Some(content), _) if content.text == file.content.text => {}
            (Some(_), _) => moved.push(shown),
            (None, Some(why)) => bail!("{shown} cannot be computed any more: {why}"),
            (None, None) => bail!("{shown}: the code makes no snapshot `{name}`"),
        }
    }
    match moved[..] {
        [] => Ok(()),
        [one] => bail!("{one} is not what the code gives: run `pendula review`"),
        [first, ..] => bail!(
            "{first} and {} more are not what the code gives: run `pendula review`",
            moved.len() - 1
        ),
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use pendula_study::report::snapshots::Kind;

    use super::*;
    use crate::book::ledger::Entry;
    use crate::book::versions::{Content, Made};

    fn followed(text: &str) -> Result<()> {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
        write("step.rs", "use a;\n// ANCHOR: step\nlet a = 1;\n// ANCHOR_END: step\nend\n");
        let empty = "// ANCHOR: step\n// ANCHOR: a\n\n// ANCHOR_END: a\n// ANCHOR_END: step\nend\n";
        write("empty.rs", empty);
        write("nested.md", "{{#include step.rs:step}}\n");
        included(text, folder.path()).map(drop)
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

    const TABLE: &str =
        "---\na: 1\n---\n<!-- ANCHOR: table -->\n| 1 |\n<!-- ANCHOR_END: table -->\n";

    /// The code makes `orders` as it is in [`TABLE`], and cannot make `zoo`.
    struct Code;

    impl Ledger for Code {
        fn entry(&self, _: &str) -> Option<Entry> {
            None
        }

        fn snapshots(&self, names: BTreeSet<String>) -> Result<Made> {
            let orders = Content { kind: Kind::Table, text: "| 1 |\n".to_string() };
            let made = [("orders".to_string(), orders)];
            let failed = [("zoo".to_string(), "no result".to_string())];
            let made = made.into_iter().filter(|(name, _)| names.contains(name));
            Ok((made.collect(), failed.into()))
        }
    }

    /// The error for a file of this name and text that a chapter includes.
    fn error(name: &str, text: &str) -> Option<String> {
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("snapshots").join(name);
        fs::create_dir(file.parent().unwrap()).unwrap();
        fs::write(&file, text).unwrap();
        let checked = snapshots(&[file].into(), &Code);
        checked.err().map(|error| format!("{error:#}"))
    }

    /// Catches: a digit typed over in a table, or a file that was cut off, that is published; an
    /// error that does not say which or what to do.
    #[test]
    fn what_the_code_does_not_give_is_refused() {
        assert_eq!(error("1_orders.snap", TABLE), None);
        let refused = |name: &str, text: &str, parts: &[&str]| {
            let error = error(name, text).unwrap();
            assert!(parts.iter().all(|part| error.contains(part)), "{error}");
        };
        let typed_over = TABLE.replace("| 1 |", "| 2 |");
        refused("1_orders.snap", &typed_over, &["snapshots/1_orders.snap", "`pendula review`"]);
        for end in [TABLE.len() - 30, TABLE.len() - 4, 20, 0] {
            let parts = ["snapshots/1_orders.snap: corrupt", "`pendula review --accept orders`"];
            refused("1_orders.snap", &TABLE[..end], &parts);
        }
        refused("1_orders.snap", &TABLE.replace("table", "x"), &["corrupt: an unknown anchor"]);
        refused("1_zoo.snap", TABLE, &["snapshots/1_zoo.snap", "no result"]);
        refused("1_none.snap", TABLE, &["snapshots/1_none.snap", "`none`"]);
    }

    /// Catches: a recorded table, which nothing computes, compared with nothing; one that was cut
    /// off let pass; another file taken for a snapshot.
    #[test]
    fn what_is_recorded_need_only_be_whole() {
        assert_eq!(error("4_strangers.snap", &TABLE.replace("| 1 |", "| 2 |")), None);
        assert!(error("4_strangers.snap", &TABLE[..TABLE.len() - 30]).is_some());
        assert_eq!(error("listing.rs", "fn main() {}\n"), None);
    }
}
