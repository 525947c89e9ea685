//! `pendula review` in a project of its own.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use clap::Parser;
use pendula_program::book::review::working_tree::{WorkingTree, contents};
use pendula_program::book::versions::{Made, Version, on_disk};
use pendula_program::commands::study::review::{Arguments, run_in};
use pendula_program::output::failure::Failure;
use tempfile::TempDir;

use crate::{PENDULA, refused};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// The snapshots as reviewed, and as if the code gave another slope than 0.72.
fn with_slope(slope: &str) -> Version {
    let mut version = contents(&on_disk(&root().join("snapshots"), ".snap").unwrap());
    let slopes = version.get_mut("slopes").unwrap();
    assert!(slopes.text.contains("0.72"));
    slopes.text = slopes.text.replace("0.72", slope);
    version
}

/// The command alone.
#[derive(Parser)]
struct Call {
    #[command(flatten)]
    arguments: Arguments,
}

/// A project with some of the snapshots, in a repository with one commit.
struct Project(TempDir);

impl Project {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let at = |path: &str| folder.path().join(path);
        fs::create_dir_all(at("book/src")).unwrap();
        fs::create_dir(at("snapshots")).unwrap();
        fs::write(at("book/book.toml"), "[preprocessor.pendula]\n").unwrap();
        for name in ["1_table_4", "1_slopes", "2_figure_2", "3_bits"] {
            let path = format!("snapshots/{name}.snap");
            fs::copy(root().join(&path), at(&path)).unwrap();
        }
        let project = Self(folder);
        project.git(&["init", "--quiet"]);
        project.commit();
        project
    }

    fn git(&self, arguments: &[&str]) {
        let git = Command::new("git").arg("-C").arg(self.0.path()).args(arguments).status();
        assert!(git.unwrap().success());
    }

    fn commit(&self) {
        self.git(&["add", "."]);
        self.git(&["-c", "user.name=a", "-c", "user.email=a@b", "commit", "--quiet", "-m", "one"]);
    }

    /// The status and the output of a call where the code gives the snapshots as reviewed, but for
    /// a slope.
    fn gives(&self, words: &str, slope: &str) -> (i32, String) {
        let mut version = with_slope(slope);
        version.retain(|name, _| ["table_4", "slopes", "figure_2"].contains(&name.as_str()));
        let (result, out) = self.run(words, &|| Ok((version.clone(), BTreeMap::new())));
        let status = result.as_ref().map_or_else(|failure| failure.status().into(), |()| 0);
        assert!(status < 2, "{result:?}");
        (status, out)
    }

    /// What comes of a call, and its output, where `compute` says what the code gives.
    fn run(
        &self,
        words: &str,
        compute: &dyn Fn() -> anyhow::Result<Made>,
    ) -> (Result<(), Failure>, String) {
        let call = Call::parse_from(["review"].into_iter().chain(words.split_whitespace()));
        let mut out = Vec::new();
        let result = run_in(self.0.path(), &call.arguments, compute, &mut out);
        (result, String::from_utf8(out).unwrap())
    }

    fn path(&self, path: &str) -> PathBuf {
        self.0.path().join(path)
    }

    fn edit(&self, path: &str, from: &str, to: &str) {
        let text = fs::read_to_string(self.path(path)).unwrap();
        assert!(text.contains(from));
        fs::write(self.path(path), text.replace(from, to)).unwrap();
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(PENDULA);
        command.arg("review").args(arguments).current_dir(self.0.path());
        command
    }

    #[track_caller]
    fn refuses(&self, mut command: Command, says: &str) {
        let line = refused(&command.output().unwrap());
        assert!(line.contains(says), "{line}");
    }
}

/// The code gives 0.72, or 0.73 after a change of it.
///
/// Catches: `--since` that compares what is recorded, and so calls a change nothing until it is
/// accepted, or until it is not committed; an acceptance that is taken for the change; hashes that
/// are not computed, without a word.
#[test]
fn a_change_is_seen_since_a_commit_whether_or_not_it_is_accepted() {
    let project = Project::new();
    let since = |revision: &str, code: &str| {
        project.gives(&format!("--since {revision} --format text"), code)
    };
    let moved = |(status, out): (i32, String)| {
        let row = out.lines().find(|line| line.starts_with("0.1 → 0.05 s"));
        let row = row.map(|row| row.ends_with("0.72  0.73"));
        (status, row, out.contains("not yet accepted: slopes"))
    };
    let nothing = since("HEAD", "0.72");
    let said = "Nothing moved of what is computed here: 3 snapshots are the same\n";
    assert!(nothing.1.starts_with(said), "{nothing:?}");
    assert!(nothing.1.contains("The hashes of the bits are not computed here"), "{nothing:?}");
    let recorded = "Not computed, but compared as their files stand: bits.";
    assert!(nothing.1.contains(recorded), "{nothing:?}");
    assert_eq!(moved(nothing), (0, None, false));
    assert_eq!(moved(since("HEAD", "0.73")), (1, Some(true), true), "not accepted");
    project.edit("snapshots/1_slopes.snap", "0.72", "0.73");
    assert_eq!(moved(since("HEAD", "0.73")), (1, Some(true), false), "accepted");
    assert_eq!(moved(since("HEAD", "0.72")), (0, None, true), "accepted, but no change");
    project.commit();
    assert_eq!(moved(since("HEAD", "0.73")), (0, None, false), "committed");
    assert_eq!(moved(since("HEAD~1", "0.73")), (1, Some(true), false), "committed");
    project.edit("snapshots/3_bits.snap", "c2c47d4665baff4a", "c2c47d4665baff4b");
    let (status, out) = since("HEAD", "0.73");
    assert!(status == 1 && out.starts_with("1 result with other bits"), "{out}");
    // Nothing moved, but one cannot be computed.
    let mut version = with_slope("0.73");
    version.retain(|name, _| ["table_4", "figure_2"].contains(&name.as_str()));
    let failed = BTreeMap::from([("slopes".to_owned(), "a panic".to_owned())]);
    let (unsure, _) = project.run("--format text", &|| Ok((version.clone(), failed.clone())));
    assert_eq!(unsure.unwrap_err().status(), 1);
    let (status, page) = project.gives("--since HEAD~1", "0.73");
    assert!(status == 1 && page.ends_with("target/review/index.html\n"), "{page}");
    let page = fs::read_to_string(project.path("target/review/index.html")).unwrap();
    assert!(!page.contains("--accept"), "what is committed is not accepted");
}

/// Catches: a change in a method's file that is not shown, or one of another commit; a file that
/// git does not know and that is not shown either; the file of another method.
#[test]
fn a_group_shows_the_change_in_its_file() {
    let project = Project::new();
    let file = "src/methods/runge_kutta/forward_euler.rs";
    let write = |text: &str| {
        fs::create_dir_all(project.path(file).parent().unwrap()).unwrap();
        fs::write(project.path(file), text).unwrap();
    };
    let body = |words: &str| project.gives(&format!("{words} --format markdown"), "0.73").1;
    write("title: \"Forward Euler\", // one\n");
    let untracked = body("");
    let link = format!("[`{file}`]({file})");
    let text = format!("{link}, which git does not know yet:");
    assert!(untracked.contains(&text) && untracked.contains("// one\n```"), "{untracked}");
    project.commit();
    // Nothing is left to commit, and no snapshot came with it.
    let committed = body("");
    assert!(committed.contains("(the last commit of a snapshot):"), "{committed}");
    assert!(committed.contains("+title: \"Forward Euler\", // one\n```"), "{committed}");
    assert!(body("--since HEAD").contains(&format!("Its file {link} is as it was.")));
    write("title: \"Forward Euler\", // two\n");
    for words in ["", "--since HEAD"] {
        let changed = body(words);
        let text = "-title: \"Forward Euler\", // one\n+title: \"Forward Euler\", // two\n```";
        assert!(changed.contains(&link) && changed.contains(text), "{changed}");
        let outdated = "### This program was not compiled from the code in";
        assert!(changed.starts_with(outdated), "{changed}");
        let (status, same) = project.gives(&format!("{words} --format markdown"), "0.72");
        assert!(status == 1 && same.starts_with(outdated), "{same}");
    }
    fs::write(project.path("src/methods/other.rs"), "fn other() {}\n").unwrap();
    let (refused, _) = project.run("--accept slopes", &|| panic!("nothing to compute"));
    let refused = refused.unwrap_err();
    assert!(refused.line().unwrap().contains("was not compiled from"), "{refused:?}");
    let changed = body("");
    let (_, elsewhere) = changed.split_once("## What else changed in the code").unwrap();
    assert!(elsewhere.contains("src/methods/other.rs") && !elsewhere.contains(file), "{changed}");
    write("title: \"Forward Euler\", // one\n");
    let shared = body("");
    let (_, after) = shared.split_once("## What changed in the code").unwrap();
    assert!(after.contains("## Forward Euler: 1 value"), "{shared}");
    assert!(after.contains(&format!("\nIts file {link} is as it was.\n")), "{shared}");
    fs::remove_dir_all(project.path(".git")).unwrap();
    let text = format!("{link}, all of it, as git does not say what changed in it:");
    assert!(body("").contains(&text), "{}", body(""));
}

/// Catches: bad input that is not refused, in more than a line, or with the status that says that
/// something moved.
#[test]
fn bad_input_is_refused_in_one_line() {
    let project = Project::new();
    // A file where the folder should be: a superuser may write where others may not.
    fs::write(project.path("target"), "").unwrap();
    project.refuses(project.command(&["--since", "HEAD"]), "target/review/index.html");
    fs::remove_file(project.path("target")).unwrap();
    project.refuses(
        project.command(&["--since", "no-such-thing"]),
        "--since no-such-thing: git says: there is no such revision",
    );
    project.refuses(project.command(&["--since=--output=x"]), "--since --output=x");
    project.refuses(project.command(&["--since", "HEAD", "--accept", "bits"]), "--accept");
    project
        .refuses(project.command(&["--format", "pdf"]), "[possible values: html, text, markdown]");
    let mut without_git = project.command(&["--since", "HEAD"]);
    without_git.env("PATH", "");
    project.refuses(without_git, "git");
    project.edit("snapshots/1_slopes.snap", "---\nsource", "source");
    for arguments in [&["--since", "HEAD"][..], &[], &["--accept", "bits"]] {
        project.refuses(project.command(arguments), "1_slopes.snap: corrupt");
    }
    fs::remove_dir_all(project.path("snapshots")).unwrap();
    project.refuses(project.command(&[]), "snapshots cannot be read");
}

/// Catches: a snapshot whose name nobody can type passed over.
#[cfg(target_os = "linux")]
#[test]
fn a_name_that_is_no_text_is_refused() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;

    let project = Project::new();
    let path = project.path("snapshots").join(OsStr::from_bytes(b"1_\xff.snap"));
    fs::write(&path, "").unwrap();
    project.commit();
    project.refuses(project.command(&[]), "corrupt: its name is not UTF-8");
    fs::remove_file(path).unwrap();
    project.refuses(project.command(&["--since", "HEAD"]), "not UTF-8");
}

/// Catches: a pending file of an older run that is taken for what the code gives, or passed over
/// without a word; one of hashes, which are not computed, that is; a snapshot that cannot be
/// computed called unmoved.
#[test]
fn what_the_code_does_not_give_is_told() {
    let project = Project::new();
    for (name, from, to) in [("1_slopes", "0.72", "0.74"), ("3_bits", "c2c4", "c2c5")] {
        let text = fs::read_to_string(project.path(&format!("snapshots/{name}.snap"))).unwrap();
        let pending = project.path(&format!("snapshots/{name}.snap.new"));
        fs::write(pending, text.replace(from, to)).unwrap();
    }
    let code = with_slope("0.73");
    let made = || {
        let given = |name: &str| (name.to_string(), code[name].clone());
        let failed = BTreeMap::from([("figure_2".to_string(), "no result".to_string())]);
        Ok((Version::from(["slopes", "table_4"].map(given)), failed))
    };
    let tree = WorkingTree::read(&project.path("snapshots"), made).unwrap();
    assert_eq!(
        (&tree.stale[..], &tree.recorded[..]),
        (&["slopes".into()][..], &["bits".into()][..])
    );
    assert_eq!(tree.moved(), ["bits", "slopes"]);
    assert!(tree.now["slopes"].text.contains("0.73") && tree.now["bits"].text.contains("c2c5"));
    let (result, out) = project.run("--format text", &made);
    assert_eq!(result.unwrap_err().status(), 1);
    let failed = "figure_2 cannot be computed any more, and is left out: no result\n";
    assert!(out.starts_with(failed), "{out}");
    let stale = "slopes: its pending file is not what the code gives now; run the tests again, or";
    assert!(out.contains(stale), "{out}");
}
