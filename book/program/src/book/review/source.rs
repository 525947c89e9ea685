//! What changed in the code: the file of a method, and the difference in it.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

use anyhow::{Context, Result};

use crate::book::versions::git;
use crate::output::files;

/// The folders that the snapshots are made of, and that of the methods.
const FOLDERS: [&str; 4] = ["src", "book/study/src", "book/charts/src", "book/dynamics/src"];
const METHODS: &str = "src/methods";

/// The code of a project, and since when changes in it are shown.
#[derive(Clone, Debug, Default)]
pub struct Code {
    /// Its files that are written in Rust, from the top folder.
    files: Vec<String>,
    /// What is compared with: a commit, in words too. Without one there is no difference to show.
    since: Option<(String, String)>,
    /// The top folder.
    root: PathBuf,
}

/// How a file changed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// In what it is written: `diff`, or `rust` for a whole file.
    pub language: &'static str,
    /// Since when it changed, or why all of it is shown.
    pub why: String,
    /// The difference, without the names of the files, or all of it.
    pub text: String,
}

impl Code {
    /// The code below `root`, which changed since `commit`, or else since the reviewed snapshots
    /// were last committed.
    pub fn read(root: &Path, commit: Option<&str>) -> Result<Self> {
        let mut code = Self { root: root.to_path_buf(), ..Self::default() };
        for name in FOLDERS {
            for path in files::with_extension(&root.join(name), "rs")? {
                let path = path.to_string_lossy().replace('\\', "/");
                code.files.push(format!("{name}/{path}"));
            }
        }
        if code.files.is_empty() {
            return Ok(code);
        }
        // What is not committed, or else since snapshots were: then a change was, without them.
        let known = |arguments: &[&str], words: &str| {
            let commit = git(root, arguments).ok().filter(|commit| !commit.is_empty())?;
            let short = commit.get(..9).unwrap_or(&commit);
            Some((commit.trim().to_string(), format!("{short} ({words})")))
        };
        code.since = match commit {
            Some(commit) => known(&["rev-parse", commit], "the revision"),
            None => known(&["rev-parse", "--verify", "HEAD"], "the last commit"),
        };
        if commit.is_none() && code.changed()?.is_empty() {
            let last = ["log", "-1", "--format=%H", "--", "snapshots"];
            code.since = known(&last, "the last commit of a snapshot");
        }
        Ok(code)
    }

    /// Since when, in words.
    pub fn since(&self) -> Option<&str> {
        self.since.as_ref().map(|(_, short)| short.as_str())
    }

    /// The file of the method with this title.
    pub fn file_of(&self, title: &str) -> Result<Option<&str>> {
        let own = format!("title: \"{title}\"");
        for name in self.files.iter().filter(|name| name.starts_with(METHODS)) {
            if files::text(&self.root.join(name))?.contains(&own) {
                return Ok(Some(name));
            }
        }
        Ok(None)
    }

    /// How a file changed; nothing if it did not.
    pub fn change(&self, name: &str) -> Result<Option<Change>> {
        let all = |why: &str| {
            let text = files::text(&self.root.join(name))?;
            Ok(Some(Change { language: "rust", why: why.to_string(), text }))
        };
        let Some((commit, since)) = &self.since else {
            return all("all of it, as git does not say what changed in it");
        };
        let plain = ["diff", "--no-color", "--no-ext-diff", "--no-textconv", "--relative"];
        let diff = git(&self.root, &[&plain[..], &[commit, "--", name]].concat())?;
        if !diff.is_empty() {
            let from = diff.find("\n@@").map_or(0, |at| at + 1);
            let (why, text) = (format!("since {since}"), diff[from..].to_string());
            return Ok(Some(Change { language: "diff", why, text }));
        }
        let is_known = !git(&self.root, &["ls-files", "--", name])?.is_empty();
        if is_known { Ok(None) } else { all("which git does not know yet") }
    }

    /// The files that changed, by name.
    pub fn changed(&self) -> Result<Vec<String>> {
        let Some((commit, _)) = &self.since else { return Ok(Vec::new()) };
        let with_folders = |words: &[&str]| {
            let words: Vec<&str> = words.iter().copied().chain(["--"]).chain(FOLDERS).collect();
            git(&self.root, &words)
        };
        let diff = ["diff", "--name-only", "-z", "--relative", commit];
        let others = ["ls-files", "-z", "--others", "--exclude-standard"];
        let names = with_folders(&diff)? + &with_folders(&others)?;
        Ok(names.split_terminator('\0').map(str::to_string).collect())
    }

    /// A file that changed after this program was compiled, or that it was not compiled from: what
    /// it computes is not what the file says.
    pub fn not_compiled(&self) -> Result<Option<String>> {
        if self.files.is_empty() {
            return Ok(None);
        }
        let cannot = || format!("{} cannot be read", self.root.display());
        let here = files::canonicalize(&self.root).with_context(cannot)?;
        // That folder may have gone, and then it is another.
        let ours = files::canonicalize(Path::new(env!("CARGO_MANIFEST_DIR")).join("../.."));
        if ours.ok() != Some(here) {
            return Ok(Some(format!("the code in {}", self.root.display())));
        }
        let program = std::env::current_exe().context("the program cannot find itself")?;
        let newer = self.newer_than(changed_at(&program)?)?;
        Ok(newer.map(|name| format!("`{name}`")))
    }

    fn newer_than(&self, time: Option<SystemTime>) -> Result<Option<&str>> {
        // Files of tests are no part of the program.
        for name in self.files.iter().filter(|name| !name.ends_with("/tests.rs")) {
            if changed_at(&self.root.join(name))? > time {
                return Ok(Some(name));
            }
        }
        Ok(None)
    }
}

/// When a file was last changed.
fn changed_at(path: &Path) -> Result<Option<SystemTime>> {
    let about = files::metadata(path).and_then(|about| about.map(|a| a.modified()).transpose());
    about.with_context(|| format!("{} cannot be read", path.display()))
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::time::Duration;

    use super::*;

    /// Catches: a program that is older than a file of the code, and computes what that no longer
    /// says, without a word; one that is never new enough, as it has no tests in it.
    #[test]
    fn a_newer_file_is_found() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("src")).unwrap();
        fs::write(folder.path().join("src/a.rs"), "").unwrap();
        let code = Code::read(folder.path(), None).unwrap();
        let written = changed_at(&folder.path().join("src/a.rs")).unwrap().unwrap();
        let second = Duration::from_secs(1);
        assert_eq!(code.newer_than(Some(written - second)).unwrap(), Some("src/a.rs"));
        assert_eq!(code.newer_than(Some(written + second)).unwrap(), None);
        fs::rename(folder.path().join("src/a.rs"), folder.path().join("src/tests.rs")).unwrap();
        let tests = Code::read(folder.path(), None).unwrap();
        assert_eq!(tests.newer_than(Some(written - second)).unwrap(), None);
    }
}
