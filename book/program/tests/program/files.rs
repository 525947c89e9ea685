//! `--output` and the files it is given: their permissions, links, limits.
#![cfg(unix)]

use std::fs::{self, Permissions};
use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use tempfile::TempDir;

use crate::{PENDULA, names, refused, shell, words};

const RUN: [&str; 9] =
    ["simulate", "--method", "rk4", "--theta0", "1", "--dt", "0.01", "--steps", "1000"];

/// What `pendula simulate` does with the file.
fn simulate(file: &Path) -> Output {
    Command::new(PENDULA).args(RUN).arg("--output").arg(file).output().unwrap()
}

#[track_caller]
fn succeeds(output: &Output) {
    assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
}

fn folder() -> (TempDir, impl Fn(&str) -> PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_path_buf();
    (folder, move |name: &str| path.join(name))
}

/// Catches: a private file that becomes readable by all, one for a group that becomes private, and
/// a new one that ignores the user's mask or is private as temporary files are.
#[test]
fn a_file_keeps_its_permissions() {
    let (folder, at) = folder();
    for mode in [0o600, 0o640, 0o664, 0o755] {
        fs::write(at("a.csv"), "old").unwrap();
        fs::set_permissions(at("a.csv"), Permissions::from_mode(mode)).unwrap();
        let before = fs::metadata(at("a.csv")).unwrap();
        succeeds(&simulate(&at("a.csv")));
        let after = fs::metadata(at("a.csv")).unwrap();
        assert_eq!(
            (after.mode(), after.uid(), after.gid()),
            (before.mode(), before.uid(), before.gid())
        );
        assert!(after.len() > 3);
    }
    let mut masked = shell("umask 027; \"$0\" \"$@\"");
    succeeds(&masked.args(RUN).arg("--output").arg(at("b.csv")).output().unwrap());
    assert_eq!(fs::metadata(at("b.csv")).unwrap().mode() & 0o777, 0o640);
    assert_eq!(names(folder.path()), ["a.csv", "b.csv"]);
}

/// Catches: a file made where a folder is named that is not there.
#[test]
fn a_name_with_a_separator_at_its_end_is_no_file() {
    let (folder, at) = folder();
    let line = refused(&simulate(&at("new/")));
    assert!(line.contains("new/: cannot be written: it names a folder"), "{line}");
    assert_eq!(names(folder.path()), [""; 0]);
}

/// Catches: a file that its owner has made read-only, replaced because its folder may be written.
#[test]
fn a_read_only_file_is_refused() {
    let (folder, at) = folder();
    fs::write(at("a.csv"), "old").unwrap();
    fs::set_permissions(at("a.csv"), Permissions::from_mode(0o444)).unwrap();
    let line = refused(&simulate(&at("a.csv")));
    assert!(line.contains("a.csv: cannot be written: it is read-only"), "{line}");
    assert_eq!(fs::read(at("a.csv")).unwrap(), b"old");
    assert_eq!(names(folder.path()), ["a.csv"]);
}

/// Catches: a link replaced by a file, whether it leads to a file, to none yet, or nowhere.
#[test]
fn a_link_keeps_leading_where_it_leads() {
    let (folder, at) = folder();
    fs::create_dir(at("results")).unwrap();
    fs::write(at("results/old.csv"), "old").unwrap();
    for (link, target) in [
        ("old", "results/old.csv"),
        ("new", "results/new.csv"),
        ("over", "new"),
        ("round", "about"),
        ("about", "round"),
        ("nowhere", "no/such/folder/a.csv"),
    ] {
        symlink(target, at(link)).unwrap();
    }
    succeeds(&simulate(&at("old")));
    succeeds(&simulate(&at("new")));
    fs::remove_file(at("results/new.csv")).unwrap();
    succeeds(&simulate(&at("over")));
    let [old, new] = ["results/old.csv", "results/new.csv"].map(|name| fs::read(at(name)).unwrap());
    assert!(old == new && old.len() > 1000);
    for link in ["round", "nowhere"] {
        let line = refused(&simulate(&at(link)));
        assert!(line.contains(link) && line.contains("cannot be written"), "{line}");
    }
    for link in ["old", "new", "over", "round", "about", "nowhere"] {
        assert!(fs::symlink_metadata(at(link)).unwrap().is_symlink(), "{link}");
    }
    assert_eq!(
        names(folder.path()),
        ["about", "new", "nowhere", "old", "over", "results", "round"]
    );
    assert_eq!(fs::read_dir(at("results")).unwrap().count(), 2);
}

/// Catches: a limit on the size of files that kills the program with its temporary file left
/// behind, or is told without the name of the file.
#[test]
fn a_file_that_grows_too_large_is_told() {
    let (folder, at) = folder();
    fs::write(at("a.csv"), "old").unwrap();
    let limited = |redirect: &str| {
        let mut limited = shell(&format!("ulimit -f 4; exec \"$0\" \"$@\" {redirect}"));
        limited.args(RUN).current_dir(folder.path());
        limited
    };
    let line = refused(&limited("").args(["--output", "a.csv"]).output().unwrap());
    assert!(line.contains("a.csv cannot be written: File too large"), "{line}");
    assert_eq!(fs::read(at("a.csv")).unwrap(), b"old");
    let line = refused(&limited("> b.csv").output().unwrap());
    assert!(line.contains("standard output cannot be written: File too large"), "{line}");
    assert_eq!(names(folder.path()), ["a.csv", "b.csv"]);
}

/// Catches: rows lost on a full disk with status 0, or with a line that does not say where.
#[test]
fn a_full_disk_is_told() {
    if !Path::new("/dev/full").exists() {
        return;
    }
    let line = refused(&simulate(Path::new("/dev/full")));
    assert!(line.contains("/dev/full cannot be written: No space left"), "{line}");
    let mut full = shell("exec \"$0\" \"$@\" > /dev/full");
    let line = refused(&full.args(RUN).output().unwrap());
    assert!(line.contains("standard output cannot be written: No space left"), "{line}");
}

/// Rust opens /dev/null in the place of a stream that is closed.
///
/// Catches: rows, a report, help or a summary that nobody gets, with status 0; a command refused
/// that has nothing to say there.
#[test]
fn a_closed_stream_is_told() {
    let (folder, at) = folder();
    let run = RUN.join(" ");
    let ended = |line: &str| {
        let output = shell(&format!("exec \"$0\" {line}")).current_dir(folder.path()).output();
        output.unwrap()
    };
    for line in [
        &*format!("{run} >&-"),
        &format!("{run} --plot - >&-"),
        "exact --theta0 1 >&-",
        "methods >&-",
        "--help >&-",
        "--version >&-",
        "verify --claims order=4 -- \"$0\" serve rk4 >&-",
    ] {
        let told = refused(&ended(line));
        assert!(told.contains("standard output cannot be written: it is closed"), "{line}: {told}");
    }
    assert_eq!(ended(&format!("{run} --summary --output a.csv 2>&-")).status.code(), Some(2));
    succeeds(&ended(&format!("{run} --output b.csv >&-")));
    succeeds(&ended(&format!("{run} --output b.csv > /dev/null 2>&-")));
    assert!(fs::read(at("b.csv")).unwrap().len() > 1000);
}

/// Of several outputs one fails: of rows and their plot, of a report and its page, of a table and
/// its files. What is no file cannot be taken back, but the files are as they were.
///
/// Catches: a file that is replaced before it is known that all there is to write is written.
#[test]
fn all_files_are_replaced_or_none() {
    if !Path::new("/dev/full").exists() {
        return;
    }
    let (folder, at) = folder();
    for name in ["a.svg", "work-precision.svg", "work-precision.csv"] {
        fs::write(at(name), "old").unwrap();
    }
    // So few rows that they go out at the end.
    let run = RUN.join(" ").replace("1000", "9");
    for line in [
        &*format!("{run} --plot a.svg --output /dev/full"),
        &format!("{run} --output a.svg --plot /dev/full"),
        &format!("{run} --plot a.svg > /dev/full"),
        &format!("{run} --output a.svg --plot - > /dev/full"),
        "sweep --method rk4 --theta0 0:1:3 --dt 0.1 --duration 1 --plot a.svg --output /dev/full",
        "verify --report a.svg -- \"$0\" serve rk4 > /dev/full",
        "bench --seconds 1e-9 --output . > /dev/full",
    ] {
        let output = shell(&format!("exec \"$0\" {line}")).current_dir(folder.path()).output();
        let told = refused(&output.unwrap());
        assert!(told.contains("cannot be written: "), "{line}: {told}");
        for name in ["a.svg", "work-precision.svg", "work-precision.csv"] {
            assert_eq!(fs::read(at(name)).unwrap(), b"old", "{line}");
        }
        assert_eq!(names(folder.path()).len(), 3, "{line}");
    }
}

/// Catches: a report that is lost in silence where a claim fails; one with the status of a program
/// that cannot be judged; a page that nobody gets because nobody reads the report.
#[test]
fn a_report_that_cannot_be_written_is_told() {
    if !Path::new("/dev/full").exists() {
        return;
    }
    let (folder, at) = folder();
    for (claims, reader, status, told) in [
        ("order=2", "> /dev/full", 2, "pendula: the report cannot be written: standard output"),
        ("order=4", "> /dev/full", 1, "pendula: the report cannot be written: standard output"),
        ("order=4", "| true", 1, ""),
    ] {
        let script = format!(
            "{{ \"$0\" verify --report a.html --claims {claims} -- \"$0\" serve stormer-verlet\n\
             echo $? > status; }} {reader}"
        );
        let output = shell(&script).current_dir(folder.path()).output().unwrap();
        let line = String::from_utf8(output.stderr).unwrap();
        assert!(line.starts_with(told) && line.lines().count() == told.lines().count(), "{line}");
        assert_eq!(fs::read_to_string(at("status")).unwrap(), format!("{status}\n"), "{claims}");
        assert_eq!(at("a.html").exists(), told.is_empty(), "{claims}");
    }
}

/// The shell leads a stream to the file that an option names; then also where nothing is written
/// to that stream.
///
/// Catches: a drawing, rows, a summary or a report that are written to a file which is then
/// replaced, and lost with status 0; a redirection refused that loses nothing.
#[test]
fn a_stream_and_a_file_of_one_name_are_refused() {
    let (folder, at) = folder();
    let run = RUN.join(" ");
    let lost = [
        &*format!("{run} --plot - --output x > x"),
        &format!("{run} --plot x > x"),
        &format!("{run} --plot - --output link >> x"),
        "sweep --method rk4 --theta0 0:1:3 --dt 0.1 --duration 1 --plot x > x",
        "verify --report x -- \"$0\" serve rk4 > x",
        "bench --seconds 1e-9 --output . > work-precision.csv",
    ];
    symlink("x", at("link")).unwrap();
    for line in lost {
        let output = shell(&format!("exec \"$0\" {line}")).current_dir(folder.path()).output();
        let told = refused(&output.unwrap());
        assert!(told.contains("and standard output: both cannot be written to"), "{line}: {told}");
    }
    let with_summary = format!("exec \"$0\" {run} --summary --output x 2> x");
    let output = shell(&with_summary).current_dir(folder.path()).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    let told = fs::read_to_string(at("x")).unwrap();
    assert!(told.contains("and standard error: both cannot be written to"), "{told}");
    for line in [format!("{run} --output x > x"), format!("{run} --output x 2> x")] {
        let output = shell(&format!("exec \"$0\" {line}")).current_dir(folder.path()).output();
        succeeds(&output.unwrap());
        assert_eq!(fs::read_to_string(at("x")).unwrap().lines().count(), 1002, "{line}");
    }
}

/// Also through a link.
///
/// Catches: rows that are written, and overwritten at the end of a long run.
#[test]
fn two_outputs_of_one_name_are_refused() {
    let (folder, at) = folder();
    symlink("x", at("link")).unwrap();
    fs::write(at("x"), "old").unwrap();
    for line in [
        "simulate --method rk4 --theta0 1 --dt 0.01 --steps 9 --output x --plot link",
        "sweep --method rk4 --theta0 0:1:9 --dt 0.1 --duration 1 --output link --plot ./x",
    ] {
        let mut command = Command::new(PENDULA);
        let output = command.args(words(line)).current_dir(folder.path()).output().unwrap();
        assert!(refused(&output).contains("both cannot be written to"), "{output:?}");
        assert_eq!(fs::read(at("x")).unwrap(), b"old");
        assert_eq!(names(folder.path()), ["link", "x"]);
    }
}
