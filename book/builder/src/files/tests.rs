//! Every operation of every command that writes fails once, with the disk full from there on, and
//! with everything failing from there on, as if the process had been killed.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use pendula::METHODS;
use pendula::methods::StormerVerlet;
use pendula::verify::Claims;
use pendula::verify::try_judge;
use tempfile::TempDir;

use super::faults::{Fault, SAYS, with, with_two_renames};
use super::operations::Operation;
use super::whole_folder::{HEADER, LIST, WholeFolder};
use crate::cli::{self, Command};
use crate::commands::{self, study};
use crate::failure::Failure;
use crate::ledger::{Entry, Ledger};
use crate::progress::Progress;
use crate::review::working_tree::WorkingTree;
use crate::versions::{Version, on_disk};
use crate::work_precision::{Curve, Measured, Measurement, SCENES};

/// All that is in a folder: the files with their bytes, and the permissions where there are any.
type Contents = BTreeMap<PathBuf, (u32, Option<Vec<u8>>)>;

fn contents(folder: &Path) -> Contents {
    let mut found = Contents::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(folder_now) = folders.pop() {
        for entry in fs::read_dir(folder_now).unwrap() {
            let path = entry.unwrap().path();
            let about = fs::symlink_metadata(&path).unwrap();
            let bytes = about.is_file().then(|| fs::read(&path).unwrap());
            if about.is_dir() {
                folders.push(path.clone());
            }
            found.insert(path.strip_prefix(folder).unwrap().into(), (mode(&about), bytes));
        }
    }
    found
}

#[cfg(unix)]
fn mode(about: &fs::Metadata) -> u32 {
    std::os::unix::fs::PermissionsExt::mode(&about.permissions())
}

#[cfg(not(unix))]
fn mode(_: &fs::Metadata) -> u32 {
    0
}

/// A folder as `prepare` makes it.
fn prepared(prepare: &impl Fn(&Path)) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    prepare(folder.path());
    folder
}

/// A command that ends with status 0 or 1 and is let fail at each of its operations.
struct Trial<P, C> {
    /// Makes what is there before.
    prepare: P,
    /// Is given the folder.
    command: C,
    /// Of which the line on standard error has to name one, or the file of the operation.
    names: &'static [&'static str],
    /// What is old or new as a whole even when the process is killed; every file is.
    place: &'static str,
}

impl<P: Fn(&Path), C: Fn(&Path) -> Result<(), Failure>> Trial<P, C> {
    fn run(&self) {
        let good = prepared(&self.prepare);
        let (result, operations) = with(Fault::None, || (self.command)(good.path()));
        assert!(result.as_ref().map_or_else(Failure::status, |()| 0) < 2, "{result:?}");
        let new = contents(good.path());
        assert!(operations.iter().any(|(what, _)| *what == Operation::Rename), "{operations:?}");
        for number in 1..=operations.len() {
            let operation = &operations[number - 1];
            self.fails_once(number, operation, &new);
            // Where nothing is changed the next operation finds the same.
            if operation.0.takes_room() {
                self.fills_up(number, &new);
            }
            if operation.0.changes() {
                self.is_killed(number, &new);
            }
        }
    }

    /// Runs it with a fault; returns what was there before, what is there after, and the end.
    fn with(&self, fault: Fault) -> (Contents, Contents, TempDir, Result<(), Failure>) {
        let folder = prepared(&self.prepare);
        let before = contents(folder.path());
        let (result, _) = with(fault, || (self.command)(folder.path()));
        let after = contents(folder.path());
        (before, after, folder, result)
    }

    fn fails_once(&self, number: usize, operation: &(Operation, PathBuf), new: &Contents) {
        let (before, after, _, result) = self.with(Fault::Once(number));
        let about = format!("operation {number}, {operation:?}: {result:?}");
        let failure = result.expect_err(&about);
        self.is_told(&failure, &operation.1, &about);
        assert!(after == before || after == *new, "{about}: {}", difference(&after, &before));
    }

    fn fills_up(&self, number: usize, new: &Contents) {
        let (before, after, _, result) = self.with(Fault::FullFrom(number));
        let about = format!("full from operation {number} on: {result:?}");
        match &result {
            Err(failure) if failure.status() == 2 => {
                self.is_told(failure, Path::new("?"), &about);
                let whole = after == before || after == *new;
                assert!(whole, "{about}: {}", difference(&after, &before));
            }
            // Nothing was written from there on.
            _ => assert!(after == *new, "{about}: {}", difference(&after, new)),
        }
    }

    /// Every file is old or new, nothing else is lost, and the next run puts everything right.
    fn is_killed(&self, number: usize, new: &Contents) {
        let (before, after, folder, result) = self.with(Fault::AllFrom(number));
        let about = format!("killed at operation {number}: {result:?}");
        assert!(result.is_err_and(|failure| failure.status() == 2), "{about}");
        for path in before.keys().chain(new.keys()) {
            let [is, was, will] = [&after, &before, new].map(|contents| contents.get(path));
            assert!(is == was || is == will, "{about}: {}", path.display());
        }
        let place = |contents: &Contents| {
            let at = contents.iter().filter(|(path, _)| path.starts_with(self.place));
            at.map(|(path, what)| (path.clone(), what.clone())).collect::<Contents>()
        };
        if !self.place.is_empty() {
            let whole = [&before, new].iter().any(|contents| place(contents) == place(&after));
            assert!(whole, "{about}: {}", difference(&place(&after), &place(&before)));
        }
        let again = (self.command)(folder.path());
        assert!(again.as_ref().map_or_else(Failure::status, |()| 0) < 2, "{about}: {again:?}");
        let after = contents(folder.path());
        assert!(after == *new, "{about}: {}", difference(&after, new));
    }

    fn is_told(&self, failure: &Failure, path: &Path, about: &str) {
        let line = failure.line().expect(about);
        assert_eq!((failure.status(), line.lines().count()), (2, 1), "{about}");
        let file = path.file_name().unwrap_or_default().to_string_lossy();
        let named = line.contains(&*file) || self.names.iter().any(|name| line.contains(name));
        assert!(named && line.contains(SAYS), "{about}: {line}");
    }
}

/// In what two folders differ.
fn difference(after: &Contents, wanted: &Contents) -> String {
    let names = after.keys().chain(wanted.keys());
    let differing = names.filter(|name| after.get(*name) != wanted.get(*name));
    format!("{:?}", differing.collect::<BTreeSet<_>>())
}

/// What `pendula` with these arguments does, `FILE` being a file in the folder.
fn pendula(folder: &Path, arguments: &str) -> Result<(), Failure> {
    commands::run(parsed(folder, arguments), &mut Vec::new())
}

fn parsed(folder: &Path, arguments: &str) -> Command {
    let file = folder.join("out.csv").to_str().unwrap().to_string();
    let words = arguments.split(' ').map(|word| if word == "FILE" { &file } else { word });
    cli::parse(["pendula"].into_iter().chain(words)).unwrap()
}

/// Writes files, in folders that are made.
fn write(folder: &Path, files: &[(&str, &str)]) {
    for (name, text) in files {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
}

/// An older file that only its owner may read.
fn older(folder: &Path) {
    write(folder, &[("out.csv", "old\n")]);
    #[cfg(unix)]
    set_mode(&folder.join("out.csv"), 0o600);
}

#[cfg(unix)]
fn set_mode(path: &Path, mode: u32) {
    fs::set_permissions(path, std::os::unix::fs::PermissionsExt::from_mode(mode)).unwrap();
}

// -------------------------------------------------------------------------------------------------
// Each command that writes
// -------------------------------------------------------------------------------------------------

/// Catches: a fault of any operation that is taken for success, told without the name of the file
/// or with another status than 2, or that leaves a half-written file, a file with other
/// permissions, or a temporary one.
#[test]
fn rows_are_written_whole_or_not_at_all() {
    for arguments in [
        "simulate --method rk4 --theta0 1 --dt 0.01 --steps 400 --output FILE",
        "ensemble --method rk4 --theta0 0:1:5 --dt 0.1 --duration 0.2 --output FILE",
        "adaptive --method dop853 --theta0 1 --duration 2 --tolerance 1e-6 --output FILE",
        "double-pendulum --theta1 1 --theta2 1 --dt 0.01 --steps 40 --output FILE",
    ] {
        let command = |folder: &Path| pendula(folder, arguments);
        let (names, place) = (&["out.csv"], "out.csv");
        Trial { prepare: older, command, names, place }.run();
        Trial { prepare: |_: &Path| {}, command, names, place }.run();
    }
}

/// Catches: a report half written, or written over by a fault.
#[test]
fn a_report_is_written_whole_or_not_at_all() {
    let report = try_judge(&StormerVerlet, &Claims::default().symplectic()).unwrap();
    let command = |folder: &Path| {
        let Command::Verify(arguments) = parsed(folder, "verify --report FILE -- x") else {
            panic!("another command")
        };
        let judge = |_, _: &_| Ok((report.clone(), "verlet".to_string()));
        commands::verify::run_with(&arguments, &mut Vec::new(), judge)
    };
    let names = &["--report", "mdBook's theme", "temporary folder"];
    Trial { prepare: older, command, names, place: "out.csv" }.run();
}

/// Catches: a figure replaced without the numbers that it shows, or a folder that is not tried
/// before the measurement.
#[test]
fn a_measurement_is_written_whole_or_not_at_all() {
    let point = |steps| Measurement { dt: 0.1, steps, error: 1e-3, seconds: 1e-6 };
    let curve = Curve { scene: SCENES[0], method: METHODS[0], points: vec![point(10), point(20)] };
    let measured = Measured { instructions: "none", curves: vec![curve] };
    let command = |folder: &Path| {
        let folder = study::work_precision::folder(Some(folder))?;
        study::work_precision::write_files(&folder, &measured).map(drop)
    };
    let prepare = |folder: &Path| {
        write(folder, &[("work-precision.svg", "old"), ("work-precision.csv", "old")]);
    };
    Trial { prepare, command, names: &["--output", "work-precision"], place: "" }.run();
}

/// The snapshots of a project of four.
const SNAPSHOTS: [&str; 4] = ["1_table_4", "1_slopes", "2_forces", "3_bits"];

/// A project in which a table has moved; with `git`, where a repository is.
fn project(folder: &Path, git: Option<&Path>) {
    let snapshots = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../snapshots");
    for name in SNAPSHOTS {
        let text = fs::read_to_string(snapshots.join(format!("{name}.snap"))).unwrap();
        write(folder, &[(&format!("snapshots/{name}.snap"), &text)]);
    }
    write(folder, &[("book/book.toml", "[preprocessor.pendula]\n"), ("book/src/a.md", "A\n")]);
    if let Some(git) = git {
        let text = fs::read_to_string(folder.join("snapshots/1_slopes.snap")).unwrap();
        write(
            folder,
            &[
                ("snapshots/1_slopes.snap", &text.replace("0.72", "0.73")),
                (".git", &format!("gitdir: {}\n", git.display())),
                ("target/review/index.html", "old"),
            ],
        );
    }
}

/// Catches: a page of a review half written, a snapshot that cannot be read passed over.
#[test]
fn a_review_is_written_whole_or_not_at_all() {
    let committed = tempfile::tempdir().unwrap();
    project(committed.path(), None);
    for arguments in [
        &["init", "--quiet"][..],
        &["add", "."],
        &["-c", "user.name=a", "-c", "user.email=a@b", "commit", "--quiet", "-m", "first"],
    ] {
        let mut git = std::process::Command::new("git");
        git.arg("-C").arg(committed.path()).args(arguments);
        assert!(git.status().unwrap().success());
    }
    let reviewed = on_disk(&committed.path().join("snapshots"), ".snap").unwrap();
    let mut made = crate::review::working_tree::contents(&reviewed);
    made.remove("bits");
    let slopes = made.get_mut("slopes").unwrap();
    slopes.text = slopes.text.replace("0.72", "0.73");
    let command = |folder: &Path| {
        let Command::Study(study::Command::Review(arguments)) =
            parsed(folder, "review --since HEAD")
        else {
            panic!("another command")
        };
        // What the code gives is what stands in the files that are no hashes.
        let compute = || Ok((made.clone(), BTreeMap::new()));
        study::review::run_in(folder, &arguments, &compute, &mut Vec::new())
    };
    let git = committed.path().join(".git");
    let prepare = |folder: &Path| project(folder, Some(&git));
    let names = &["target/review/index.html", "book/src", "mdBook's theme", "temporary folder"];
    Trial { prepare, command, names, place: "target" }.run();
}

/// Catches: some of several snapshots accepted although one of them fails, a pending file that is
/// lost before its snapshot is accepted.
#[test]
fn snapshots_are_accepted_together_or_not_at_all() {
    let prepare = |folder: &Path| {
        project(folder, None);
        let text = fs::read_to_string(folder.join("snapshots/1_slopes.snap")).unwrap();
        write(folder, &[("snapshots/1_slopes.snap.new", &text.replace("0.72", "0.73"))]);
    };
    let good = prepared(&prepare);
    let snapshots = good.path().join("snapshots");
    let reviewed = on_disk(&snapshots, ".snap").unwrap();
    let mut now: Version = crate::review::working_tree::contents(&reviewed);
    for name in ["slopes", "table_4"] {
        let content = now.get_mut(name).unwrap();
        content.text = content.text.replace("0.72", "0.73").replace("1.", "2.");
    }
    // One that is new, and one that the code no longer makes.
    now.insert("figure_9".to_string(), now["forces"].clone());
    now.remove("bits");
    let command = |folder: &Path| {
        let snapshots = folder.join("snapshots");
        let [reviewed, pending] = [".snap", ".snap.new"].map(|suffix| on_disk(&snapshots, suffix));
        let tree = WorkingTree {
            reviewed: reviewed?,
            pending: pending?,
            now: now.clone(),
            recorded: Vec::new(),
            stale: Vec::new(),
            failed: BTreeMap::new(),
        };
        // Those that a run that was killed has accepted already have not moved.
        let reviewed = tree.reviewed();
        let names = ["slopes", "table_4", "figure_9", "bits"].map(str::to_string);
        let waits =
            |name: &String| reviewed.get(name) != now.get(name) || tree.pending.contains_key(name);
        let names: Vec<String> = names.into_iter().filter(waits).collect();
        Ok(tree.accept(&snapshots, &names)?)
    };
    let prepare_again = |folder: &Path| prepare(folder);
    Trial { prepare: prepare_again, command, names: &["snapshots"], place: "" }.run();
}

// -------------------------------------------------------------------------------------------------
// The book
// -------------------------------------------------------------------------------------------------

/// A book of one chapter, an older one in the place where it is built, and files there that are of
/// no book.
fn small_book(folder: &Path) {
    write(
        folder,
        &[
            ("book/book.toml", BOOK),
            ("book/src/SUMMARY.md", "# Summary\n\n* [One](one.md)\n"),
            ("book/src/one.md", "# One\n\nNothing.\n"),
            ("benches/work-precision.svg", "<svg></svg>\n"),
            ("target/book/index.html", "old"),
            ("target/book/css/old.css", "old"),
            ("target/book/css/mine.css", "mine"),
            ("target/book/mine/notes.txt", "mine"),
            ("target/book/notes.txt", "mine"),
            (&format!("target/book/{LIST}"), &format!("{HEADER}\nindex.html\ncss/old.css\n")),
        ],
    );
}

const BOOK: &str = "[book]\ntitle = \"a\"\n[build]\nbuild-dir = \"../target/book\"\n\
                    [preprocessor.pendula]\nrenderers = [\"html\"]\n\
                    [output.html]\nhash-files = false\n\
                    [output.html.search]\nenable = false\n[output.html.print]\nenable = false\n";

fn build(folder: &Path) -> Result<(), Failure> {
    build_with(folder, |_: &str| None::<Entry>)
}

fn build_with(folder: &Path, ledger: impl Ledger + 'static) -> Result<(), Failure> {
    build_until(folder, ledger, &Arc::default())
}

fn build_until(
    folder: &Path,
    ledger: impl Ledger + 'static,
    interrupted: &Arc<AtomicBool>,
) -> Result<(), Failure> {
    crate::build::book(&folder.join("book"), None, ledger, Progress::hidden(), interrupted)?;
    Ok(())
}

/// Of the book everything may fail that can: reading a chapter, and the name of its folder.
const OF_THE_BOOK: &[&str] = &["target/book", ".book.building", "one.md", "work-precision.svg"];

/// Catches: a book of which half is new, one that is gone for a moment, files of somebody else that
/// are deleted, and leftovers that nobody removes.
#[test]
fn a_book_is_built_whole_or_not_at_all() {
    Trial { prepare: small_book, command: build, names: OF_THE_BOOK, place: "target/book" }.run();
}

/// Where two folders cannot change places in one step, the old book has another name for a moment,
/// in which the process may be killed.
///
/// Catches: the old book lost in that moment.
#[test]
fn a_book_survives_two_renames() {
    let command = |folder: &Path| with_two_renames(|| build(folder));
    let good = prepared(&small_book);
    let (result, operations) = with(Fault::None, || command(good.path()));
    result.unwrap();
    let new = contents(good.path());
    let trial = Trial { prepare: small_book, command, names: OF_THE_BOOK, place: "target/book" };
    let renames = operations
        .iter()
        .enumerate()
        .filter(|(_, (what, path))| *what == Operation::Rename && !path.ends_with(LIST));
    let renames: Vec<usize> = renames.map(|(index, _)| index + 1).collect();
    let [away, into_place] = renames[..] else { panic!("{operations:?}") };
    for number in [away, into_place] {
        trial.fails_once(number, &operations[number - 1], &new);
    }
    trial.is_killed(away, &new);
    let (before, after, folder, _) = trial.with(Fault::AllFrom(into_place));
    let old = |contents: &Contents, at: &str| {
        let below = contents.iter().filter_map(|(path, what)| {
            Some((path.strip_prefix(at).ok()?.to_path_buf(), what.clone()))
        });
        below.collect::<Contents>()
    };
    assert_eq!(old(&after, "target/.book.building/old"), old(&before, "target/book"));
    let locked = WholeFolder::beside(&folder.path().join("target/book")).unwrap();
    drop(locked);
    assert_eq!(contents(folder.path()), before, "the next builder restores it");
}

/// Catches: an interrupt, a warning or an error of mdBook that costs the old book, or that leaves
/// something beside it.
#[test]
fn a_build_that_stops_leaves_the_old_book() {
    let stops = |chapter: &str, says: &str| {
        let folder = prepared(&small_book);
        write(folder.path(), &[("book/src/one.md", chapter)]);
        let before = contents(folder.path());
        let interrupted = Arc::new(AtomicBool::new(false));
        let raise = Arc::clone(&interrupted);
        let ledger = move |_: &str| {
            raise.store(true, Ordering::Relaxed);
            Some(Entry { stated: Some("1".to_string()), ..Entry::default() })
        };
        let failure = build_until(folder.path(), ledger, &interrupted).unwrap_err();
        let line = failure.line().unwrap();
        assert!(failure.status() == 2 && line.contains(says), "{line}");
        assert!(contents(folder.path()) == before, "{chapter}");
    };
    stops("{{stated T1.a}}\n", "interrupted");
    stops("<div>\n", "mdBook warns: ");
    stops("{{#include nothing.rs}}\n", "nothing.rs");
}

/// Catches: a folder emptied because somebody named it as the place of the book; a file replaced by
/// a chapter that happens to have its name; a list of files that may name any.
#[test]
fn what_is_not_of_the_book_is_never_removed() {
    let refused = |files: &[(&str, &str)], says: &str| {
        let folder = prepared(&small_book);
        fs::remove_file(folder.path().join("target/book").join(LIST)).unwrap();
        write(folder.path(), files);
        let before = contents(folder.path());
        let line = build(folder.path()).unwrap_err().line().unwrap();
        assert!(line.contains(says), "{line}");
        assert!(contents(folder.path()) == before, "{says}");
    };
    let list = format!("target/book/{LIST}");
    refused(&[], "target/book has files in it");
    refused(&[(&list, "index.html\ncss/old.css\n")], "target/book has files in it");
    refused(&[(&list, &format!("{HEADER}\n"))], "index.html is not of the book");
    refused(&[("target/.book.building/thesis.txt", "mine")], ".book.building has files in it");

    let folder = prepared(&small_book);
    fs::remove_dir_all(folder.path().join("target/book")).unwrap();
    write(folder.path(), &[("target/book", "a file")]);
    let line = build(folder.path()).unwrap_err().line().unwrap();
    assert!(line.contains("target/book is not a folder"), "{line}");
    assert_eq!(fs::read(folder.path().join("target/book")).unwrap(), b"a file");
}

/// Catches: an empty folder refused, a link to the book replaced by the book, the permissions of
/// its folder lost.
#[cfg(unix)]
#[test]
fn a_book_stays_where_a_link_leads() {
    let folder = prepared(&small_book);
    let at = |path: &str| folder.path().join(path);
    fs::remove_dir_all(at("target/book")).unwrap();
    fs::create_dir(at("published")).unwrap();
    set_mode(&at("published"), 0o750);
    std::os::unix::fs::symlink("../published", at("target/book")).unwrap();
    build(folder.path()).unwrap();
    assert_eq!(fs::read_link(at("target/book")).unwrap(), Path::new("../published"));
    assert!(at("published/one.html").exists());
    assert_eq!(mode(&fs::metadata(at("published")).unwrap()) & 0o777, 0o750);
    let left: Vec<_> = fs::read_dir(at("target")).unwrap().collect();
    assert_eq!(left.len(), 1, "{left:?}");
}

/// Catches: two builders that write the same book.
#[test]
fn a_second_builder_is_refused() {
    let folder = prepared(&small_book);
    let before = contents(folder.path());
    let first = WholeFolder::beside(&folder.path().join("target/book")).unwrap();
    let line = build(folder.path()).unwrap_err().line().unwrap();
    assert!(line.ends_with("is being built by another process"), "{line}");
    drop(first);
    assert!(contents(folder.path()) == before);
    build(folder.path()).unwrap();
}

/// Catches: a file that somebody put into the old book just before it was exchanged, removed with
/// it; one that has changed since, replaced by its older self.
#[test]
fn what_comes_late_is_kept() {
    let folder = prepared(&small_book);
    let at = |path: &str| folder.path().join(path);
    let (_, operations) = with(Fault::None, || build(prepared(&small_book).path()));
    let exchanged = operations
        .iter()
        .position(|(what, path)| *what == Operation::Rename && path.ends_with("target/book"));
    let number = exchanged.unwrap() + 2;
    with(Fault::AllFrom(number), || build(folder.path())).0.unwrap_err();
    let old = "target/.book.building/new";
    assert_eq!(fs::read(at(&format!("{old}/index.html"))).unwrap(), b"old", "it was killed late");
    write(folder.path(), &[(&format!("{old}/late.txt"), "late")]);
    // An editor writes a new file and gives it the old name.
    write(folder.path(), &[("new.txt", "newer")]);
    fs::rename(at("new.txt"), at("target/book/notes.txt")).unwrap();
    build(folder.path()).unwrap();
    let read = |name: &str| fs::read_to_string(at("target/book").join(name)).unwrap();
    assert_eq!(["late.txt", "notes.txt"].map(read), ["late", "newer"]);
    assert!(!at("target/.book.building").exists());
}

// -------------------------------------------------------------------------------------------------
// The place
// -------------------------------------------------------------------------------------------------

/// The code of a file, without its unit tests.
fn code(path: &Path) -> String {
    let text = fs::read_to_string(path).unwrap();
    text.split("#[cfg(test)]\nmod tests {").next().unwrap().to_string()
}

/// Catches: a file that is written or read past the one place where every fault is tried.
#[test]
fn files_are_touched_in_one_place() {
    const DIRECT: [&str; 10] = [
        "fs::",
        "{fs",
        "fs,",
        "File::open",
        "File::create",
        "OpenOptions",
        "tempfile",
        ".exists()",
        ".canonicalize()",
        ".read_dir(",
    ];
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let (mut folders, mut seen) = (vec![top.clone()], 0);
    while let Some(folder) = folders.pop() {
        for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if path.is_dir() && path != top.join("files") {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                seen += 1;
                let code = code(&path);
                let found = DIRECT.iter().find(|word| code.contains(*word));
                assert!(found.is_none(), "{}: {found:?}", path.display());
            }
        }
    }
    assert!(seen > 60, "{seen}");
    let place = code(&top.join("files/operations.rs"));
    assert!(DIRECT.iter().filter(|word| place.contains(*word)).count() > 2);
}
