//! The snapshots that the book quotes are what the code gives, or there is no book.

use std::fs;
use std::path::{Path, PathBuf};

use pendula_book::build;
use pendula_book::progress::Progress;
use pendula_output::failure::Failure;
use tempfile::TempDir;

use crate::claims::PAPER;

const TABLE: &str = "snapshots/1_table_5.snap";

/// A book of one chapter, which includes the paper's Table 5.
struct Project(TempDir);

impl Project {
    fn new() -> Self {
        let project = Self(tempfile::tempdir().unwrap());
        let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        for (path, text) in [
            (
                "book/book.toml",
                "[book]\ntitle = \"a\"\n[build]\nbuild-dir = \"../target/book\"\n\
                 [preprocessor.pendula]\nafter = [\"links\"]\nrenderers = [\"html\"]\n",
            ),
            ("book/src/SUMMARY.md", "# Summary\n\n* [One](one.md)\n"),
            (
                "book/src/one.md",
                "# One\n\nTable: Energy errors.\n\n\
                 {{#include ../../snapshots/1_table_5.snap:table}}\n",
            ),
            ("benches/work-precision.svg", "<svg></svg>\n"),
            (TABLE, &fs::read_to_string(top.join(TABLE)).unwrap()),
        ] {
            let path = project.path(path);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        project
    }

    fn path(&self, path: &str) -> PathBuf {
        self.0.path().join(path)
    }

    fn build(&self) -> Result<PathBuf, Failure> {
        let (root, paper) = (self.path("book"), PAPER.clone());
        let built = build::book(&root, None, paper, Progress::hidden(), &Default::default());
        built.map_err(Failure::from)
    }
}

/// Catches: a digit typed over in a snapshot, or a snapshot that was cut off, published; a book
/// that is lost by it.
#[test]
fn a_snapshot_typed_over_is_not_published() {
    let project = Project::new();
    assert!(project.build().unwrap().ends_with("target/book/index.html"));
    let page = || fs::read_to_string(project.path("target/book/one.html")).unwrap();
    let published = page();
    assert!(published.contains("481.797"), "{published}");

    let text = fs::read_to_string(project.path(TABLE)).unwrap();
    for (wrong, says) in [
        (text.replace("481.797", "481.798"), "is not what the code gives: run `pendula review`"),
        (text[..text.len() - 20].to_string(), "corrupt"),
    ] {
        fs::write(project.path(TABLE), wrong).unwrap();
        let failure = project.build().unwrap_err();
        let (status, error) = (failure.status(), failure.line().unwrap());
        assert_eq!((status, error.lines().count()), (2, 1), "{error}");
        assert!(error.contains(TABLE) && error.contains(says), "{error}");
        assert!(error.contains("`pendula review"), "{error}");
        assert!(page() == published);
    }
}
