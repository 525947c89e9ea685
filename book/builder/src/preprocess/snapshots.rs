//! Checks that the snapshots in the book are what the code makes.
//!
//! A chapter includes the file that was reviewed. Whoever changes a method and does not review what
//! moved, or types a digit over, would publish a book in which the tables contradict the numbers in
//! the text, which are computed.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use anyhow::{Context, Result, bail};
use pendula_study::report::snapshots::Kind;

use crate::ledger::Ledger;
use crate::versions::{File, name_of};
use pendula_output::files;

/// Compares each snapshot among the included files with what `ledger` makes of it. Those that are
/// recorded cannot be compared.
pub fn check(
    included: &BTreeSet<PathBuf>,
    ledger: &dyn Ledger,
    interrupted: &AtomicBool,
) -> Result<()> {
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
        if file.content.kind != Kind::Recorded {
            quoted.insert(name.to_string(), (shown.clone(), file));
        }
    }
    let (made, failed) = ledger.snapshots(quoted.keys().cloned().collect(), interrupted)?;
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

    use super::*;
    use crate::ledger::Entry;
    use crate::versions::{Content, Made};

    const TABLE: &str =
        "---\na: 1\n---\n<!-- ANCHOR: table -->\n| 1 |\n<!-- ANCHOR_END: table -->\n";

    /// The code makes `orders` as it is in [`TABLE`], and cannot make `zoo`.
    struct Code;

    impl Ledger for Code {
        fn entry(&self, _: &str) -> Option<Entry> {
            None
        }

        fn snapshots(&self, names: BTreeSet<String>, _: &AtomicBool) -> Result<Made> {
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
        let checked = check(&[file].into(), &Code, &AtomicBool::new(false));
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
