//! `pendula review`: what it says of changes that are known, and how it fails.

use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use pendula_book::review::Review;
use pendula_book::review::working_tree::contents;
use pendula_book::versions::{Version, on_disk};

mod accepted;
mod said;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

/// The snapshots as reviewed.
pub static REVIEWED: LazyLock<Version> =
    LazyLock::new(|| contents(&on_disk(&root().join("snapshots"), ".snap").unwrap()));

/// The reviewed snapshots with other texts in some of them.
fn changed(edits: &[(&str, &str, &str)]) -> Version {
    let mut version = REVIEWED.clone();
    for (name, from, to) in edits {
        let content = version.get_mut(*name).unwrap();
        assert!(content.text.contains(from), "{name} has no {from}");
        content.text = content.text.replace(from, to);
    }
    version
}

fn review(edits: &[(&str, &str, &str)]) -> Review {
    between(&REVIEWED, &changed(edits))
}

fn between(old: &Version, new: &Version) -> Review {
    let versions = ["then".to_string(), "now".to_string()];
    Review::new(versions, old, new, &root().join("book/src")).unwrap()
}
