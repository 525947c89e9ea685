//! The versions of the snapshots that can be compared: as reviewed, as `cargo test` left them
//! beside these for review, as the code makes them now, and as committed.

use std::any::Any;
use std::collections::BTreeMap;
use std::panic::{self, AssertUnwindSafe};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::thread;

use anyhow::{Context, Result, anyhow, bail, ensure};
use pendula_study::report::snapshots::{self, Kind};

use crate::book::ledger::Paper;
use crate::book::progress::Progress;
use crate::output::files;

/// The content of a snapshot, without insta's header.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Content {
    /// What it consists of.
    pub kind: Kind,
    /// What stands between the anchors.
    pub text: String,
}

/// All snapshots of a version, by name.
pub type Version = BTreeMap<String, Content>;

/// What the code makes, and why it does not make what it cannot.
pub type Made = (Version, BTreeMap<String, String>);

/// A file of insta's: a header in YAML between two lines of dashes, and the content.
#[derive(Clone, Debug)]
pub struct File {
    /// Where it is.
    pub path: PathBuf,
    /// The lines between the dashes.
    pub header: String,
    /// What follows.
    pub content: Content,
}

impl File {
    /// Reads the text of a file of the snapshot `name`.
    pub fn parse(name: &str, text: &str, path: &Path) -> Result<Self> {
        let broken = |what| format!("{}: corrupt: {what}", path.display());
        let (header, body) = text
            .strip_prefix("---\n")
            .and_then(|rest| rest.split_once("\n---\n"))
            .with_context(|| broken("no header between two lines of dashes"))?;
        let inner = body.trim_end().strip_prefix("<!-- ANCHOR: ").and_then(|rest| {
            let (anchor, rest) = rest.split_once(" -->\n")?;
            let content = rest.strip_suffix(&format!("<!-- ANCHOR_END: {anchor} -->"))?;
            Some((anchor, content))
        });
        let (anchor, content) = inner.with_context(|| broken("no anchors around its content"))?;
        let kind = kind(name, anchor).with_context(|| broken("an unknown anchor"))?;
        let content = Content { kind, text: content.to_string() };
        Ok(Self { path: path.to_path_buf(), header: header.to_string(), content })
    }

    /// The text of the file.
    pub fn text(&self) -> String {
        let (Self { header, content, .. }, anchor) = (self, self.content.kind.anchor());
        format!(
            "---\n{header}\n---\n<!-- ANCHOR: {anchor} -->\n{}<!-- ANCHOR_END: {anchor} -->\n",
            content.text
        )
    }
}

/// The kind of the snapshot `name` with this anchor.
fn kind(name: &str, anchor: &str) -> Option<Kind> {
    let recorded = snapshots::RECORDED.iter().any(|(recorded, _)| *recorded == name);
    Some(match anchor {
        "table" if recorded => Kind::Recorded,
        "table" => Kind::Table,
        "figure" => Kind::Figure,
        "hashes" => Kind::Hashes,
        "diff" => Kind::Example,
        _ => return None,
    })
}

/// The name of the snapshot in a file that ends in `suffix`: without the digit that orders it.
pub fn name_of<'p>(path: &'p str, suffix: &str) -> Option<&'p str> {
    let stem = path.rsplit('/').next()?.strip_suffix(suffix)?;
    match stem.split_once('_') {
        Some((digit, name)) if digit.len() == 1 && digit.chars().all(|c| c.is_ascii_digit()) => {
            Some(name)
        }
        _ => Some(stem),
    }
}

/// The files in `folder` that end in `suffix`, by the name of their snapshot.
pub fn on_disk(folder: &Path, suffix: &str) -> Result<BTreeMap<String, File>> {
    let paths =
        files::list(folder).with_context(|| format!("{} cannot be read", folder.display()))?;
    let mut found = BTreeMap::new();
    for path in paths {
        let shown = path.display().to_string();
        let Some(name) = name_of(&shown, suffix) else { continue };
        ensure!(path.to_str().is_some(), "{shown}: corrupt: its name is not UTF-8");
        let file = File::parse(name, &files::text(&path)?, &path)?;
        let before = found.insert(name.to_string(), file);
        ensure!(before.is_none(), "{shown}: there are two files of this snapshot");
    }
    Ok(found)
}

/// What the code makes now, and why it does not make what it cannot.
pub fn computed(progress: &Progress) -> Result<Made> {
    let made = quietly(|| Paper::measure(progress).made(|_| true));
    progress.finish();
    made.map_err(|panic| anyhow!("the study cannot be computed: {}", said(&*panic)))
}

/// The result of `work`, in which panics print nothing.
pub(crate) fn quietly<T>(work: impl FnOnce() -> T) -> thread::Result<T> {
    let before = panic::take_hook();
    panic::set_hook(Box::new(|_| {}));
    let result = panic::catch_unwind(AssertUnwindSafe(work));
    panic::set_hook(before);
    result
}

/// What a panic says.
pub(crate) fn said(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<&str>().map(ToString::to_string);
    text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_default()
}

/// The snapshots as committed at `revision` in the repository around `root`, and the hash of that
/// commit.
pub fn committed(root: &Path, revision: &str) -> Result<(String, Version)> {
    let git =
        |arguments: &[&str]| git(root, arguments).with_context(|| format!("--since {revision}"));
    let commit = format!("{revision}^{{commit}}");
    let commit = git(&["rev-parse", "--verify", "--end-of-options", &commit])?;
    let commit = commit.trim();
    let paths = git(&["ls-tree", "-r", "-z", "--name-only", commit, "--", "snapshots"])?;
    let mut version = Version::new();
    for path in paths.split_terminator('\0') {
        let Some(name) = name_of(path, ".snap") else { continue };
        let text = git(&["show", &format!("{commit}:./{path}")])?;
        let place = PathBuf::from(format!("{path} at {revision}"));
        version.insert(name.to_string(), File::parse(name, &text, &place)?.content);
    }
    ensure!(!version.is_empty(), "--since {revision}: no snapshots in that revision");
    Ok((commit.to_string(), version))
}

/// What git answers.
pub fn git(root: &Path, arguments: &[&str]) -> Result<String> {
    let output = Command::new("git").arg("-C").arg(root).args(arguments).output();
    let output = output.context("git cannot be started")?;
    if !output.status.success() {
        let error = String::from_utf8_lossy(&output.stderr).replace('\n', " ");
        let error = error.replace("Needed a single revision", "there is no such revision");
        bail!("git says: {}", error.trim().trim_start_matches("fatal: "));
    }
    String::from_utf8(output.stdout).context("git's answer is not UTF-8")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: a name that keeps the digit of its file; one of a time when files had none, lost.
    #[test]
    fn a_file_names_its_snapshot() {
        assert_eq!(name_of("snapshots/1_table_4.snap", ".snap"), Some("table_4"));
        assert_eq!(name_of("table_4.snap", ".snap"), Some("table_4"));
        assert_eq!(name_of("1_table_4.snap.new", ".snap"), None);
    }

    /// Catches: a panic of the study that ends the program with a stack trace, or whose reason is
    /// lost.
    #[test]
    fn a_panic_is_an_error() {
        let reason = |work: fn() -> u8| quietly(work).map_err(|panic| said(&*panic));
        assert!(
            reason(|| u8::try_from(300).expect("a result"))
                .is_err_and(|says| says.starts_with("a result"))
        );
        assert_eq!(reason(|| panic!("{} of {}", 3, 7)), Err("3 of 7".to_string()));
        assert_eq!(reason(|| 7), Ok(7));
    }
}
