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

use crate::files;
use crate::ledger::Ledger;
use crate::review::versions::{File, name_of};

/// Compares each snapshot among the included files with what `ledger` makes of it. Those that are
/// recorded cannot be compared.
///
/// # Errors
/// If one is corrupt, cannot be made, or is another; the error names it and says what to run.
pub fn check(
    included: &BTreeSet<PathBuf>,
    ledger: &dyn Ledger,
    interrupted: &AtomicBool,
) -> Result<()> {
    let mut quoted: BTreeMap<String, (String, File)> = BTreeMap::new();
    for path in included.iter().filter(|path| is_snapshot(path)) {
        let shown = format!("snapshots/{}", path.file_name().unwrap_or_default().display());
        let name = name_of(&shown, ".snap").with_context(|| format!("{shown}: a strange name"))?;
        let text = files::read(path).with_context(|| format!("{shown} cannot be read"))?;
        let text = String::from_utf8_lossy(&text);
        let file = File::parse(name, &text, &shown).with_context(|| restore(name))?;
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

fn is_snapshot(path: &Path) -> bool {
    let folder = path.parent().and_then(Path::file_name);
    folder.is_some_and(|folder| folder == "snapshots")
        && path.extension().is_some_and(|extension| extension == "snap")
}

/// What to do about a corrupt snapshot.
fn restore(name: &str) -> String {
    format!(
        "a snapshot is corrupt: restore its file, or remove it and run `pendula review --accept \
         {name}`"
    )
}
