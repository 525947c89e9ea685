//! The folder of the built book: in the place of the old one, also where links lead; and no book of
//! snapshots that the code does not give.
#![cfg(unix)]

use std::fs::{self, Permissions};
use std::os::unix::fs::{MetadataExt, PermissionsExt, symlink};
use std::path::{Path, PathBuf};
use std::thread;

use pendula_program::book::build;
use pendula_program::book::ledger::{Entry, Ledger};
use pendula_program::book::progress::Progress;
use pendula_program::output::files;
use tempfile::TempDir;

use crate::book::built_book::PAPER;
use crate::book::root;

const BOOK: &str = "[book]\ntitle = \"a\"\n[build]\nbuild-dir = \"../target/book\"\n\
                    [preprocessor.pendula]\nafter = [\"links\"]\nrenderers = [\"html\"]\n\
                    [output.html]\nhash-files = false\n\
                    [output.html.search]\nenable = false\n[output.html.print]\nenable = false\n";

/// What is in the folder of a book that is built: the lock is kept.
const BOOK_ALONE: [&str; 2] = ["target/.book.lock", "target/book"];

/// A book of one chapter.
fn small_book() -> (TempDir, impl Fn(&str) -> PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_path_buf();
    let at = move |name: &str| path.join(name);
    for (name, text) in [
        ("book/book.toml", BOOK),
        ("book/src/SUMMARY.md", "# Summary\n\n* [One](one.md)\n"),
        ("book/src/one.md", "# One\n"),
        ("benches/work-precision.svg", "<svg></svg>\n"),
    ] {
        fs::create_dir_all(at(name).parent().unwrap()).unwrap();
        fs::write(at(name), text).unwrap();
    }
    (folder, at)
}

fn build(folder: &TempDir) -> Result<(), String> {
    build_with(folder, |_: &str| None::<Entry>)
}

fn build_with(folder: &TempDir, ledger: impl Ledger + 'static) -> Result<(), String> {
    let root = folder.path().join("book");
    let built = build::book(&root, None, ledger, Progress::hidden());
    built.map(drop).map_err(|error| format!("{error:#}"))
}

/// Catches: a page of the old book that stays; an old book that is lost by what is wrong with a
/// chapter; a warning of mdBook that is let pass.
#[test]
fn a_book_takes_the_place_of_the_old_one() {
    let (folder, at) = small_book();
    build(&folder).unwrap();
    fs::rename(at("book/src/one.md"), at("book/src/two.md")).unwrap();
    fs::write(at("book/src/SUMMARY.md"), "# Summary\n\n* [Two](two.md)\n").unwrap();
    fs::write(at("book/src/two.md"), "{{#include nothing.rs}}\n").unwrap();
    let line = build(&folder).unwrap_err();
    assert!(line.contains("nothing.rs"), "{line}");
    assert!(at("target/book/one.html").exists() && !at("target/book/two.html").exists());
    fs::write(at("book/src/two.md"), "<div>\n").unwrap();
    let line = build(&folder).unwrap_err();
    assert!(line.contains("mdBook warns: "), "{line}");
    fs::write(at("book/src/two.md"), "# Two\n").unwrap();
    build(&folder).unwrap();
    assert!(!at("target/book/one.html").exists() && at("target/book/two.html").exists());
    assert_eq!(files::list(&at("target")).unwrap(), BOOK_ALONE.map(&at));
}

/// What comes after mdBook's part fails: the known answers are no JSON.
///
/// Catches: a book that is built in the place of the old one, which is gone when the build fails,
/// or is ended, in its last part.
#[test]
fn the_old_book_stays_when_the_last_part_fails() {
    let (folder, at) = small_book();
    build(&folder).unwrap();
    let old = files::tree(&at("target/book")).unwrap();
    fs::create_dir_all(at("book/src/assets/which")).unwrap();
    fs::create_dir_all(at("book/judge/known-answers")).unwrap();
    fs::write(at("book/src/assets/which/a.txt"), "").unwrap();
    fs::write(at("book/judge/known-answers/known-answers.json"), "{").unwrap();
    fs::write(at("book/src/one.md"), "# Another\n").unwrap();
    let line = build(&folder).unwrap_err();
    assert!(line.contains("known-answers.json"), "{line}");
    assert_eq!(files::tree(&at("target/book")).unwrap(), old);
    assert!(!fs::read_to_string(at("target/book/one.html")).unwrap().contains("Another"));
    assert_eq!(files::list(&at("target")).unwrap(), BOOK_ALONE.map(&at));
}

/// Catches: two builds that write the same pages, so that what each page loads is in it twice.
#[test]
fn two_builds_at_once_are_two_whole_books() {
    let (folder, at) = small_book();
    thread::scope(|scope| {
        let builds = [(); 4].map(|()| scope.spawn(|| build(&folder)));
        for built in builds {
            built.join().unwrap().unwrap();
        }
    });
    for page in ["index.html", "one.html", "404.html"] {
        let page = fs::read_to_string(at("target/book").join(page)).unwrap();
        assert_eq!(page.matches("Content-Security-Policy").count(), 1);
    }
}

/// Catches: a digit typed over in a snapshot, or a snapshot that was cut off, published; a book
/// that is lost by it.
#[test]
fn a_snapshot_typed_over_is_not_published() {
    const TABLE: &str = "snapshots/1_table_5.snap";
    let (folder, at) = small_book();
    let build = || build_with(&folder, PAPER.clone());
    let chapter =
        format!("# One\n\nTable: Energy errors.\n\n{{{{#include ../../{TABLE}:table}}}}\n");
    fs::write(at("book/src/one.md"), chapter).unwrap();
    let reviewed = fs::read_to_string(root().join(TABLE)).unwrap();
    fs::create_dir(at("snapshots")).unwrap();
    fs::write(at(TABLE), &reviewed).unwrap();
    build().unwrap();
    let page = || fs::read_to_string(at("target/book/one.html")).unwrap();
    let published = page();
    assert!(published.contains("481.797"), "{published}");
    for (wrong, says) in [
        (
            reviewed.replace("481.797", "481.798"),
            "is not what the code gives: run `pendula review`",
        ),
        (reviewed[..reviewed.len() - 20].to_string(), "`pendula review --accept table_5`"),
    ] {
        fs::write(at(TABLE), wrong).unwrap();
        let error = build().unwrap_err();
        assert!(error.contains(TABLE) && error.contains(says), "{error}");
        assert!(page() == published);
    }
}

/// Catches: a link to the book replaced by the book, the permissions of its folder lost.
#[test]
fn a_book_stays_where_a_link_leads() {
    let (folder, at) = small_book();
    fs::create_dir(at("published")).unwrap();
    fs::create_dir(at("target")).unwrap();
    fs::set_permissions(at("published"), Permissions::from_mode(0o750)).unwrap();
    symlink("../published", at("target/book")).unwrap();
    build(&folder).unwrap();
    assert_eq!(fs::read_link(at("target/book")).unwrap(), Path::new("../published"));
    assert!(at("published/one.html").exists());
    assert_eq!(fs::metadata(at("published")).unwrap().mode() & 0o777, 0o750);
    let all = [".published.lock", "benches", "book", "published", "target"].map(&at);
    assert_eq!(files::list(folder.path()).unwrap(), all);
    assert_eq!(fs::read_dir(at("target")).unwrap().count(), 1);
}
