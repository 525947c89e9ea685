//! `pendula review`: what it says of changes that are known, and what accepting a snapshot leaves
//! in the folder.

use std::collections::BTreeMap;
use std::fs;
use std::sync::LazyLock;

use pendula_program::book::review::Review;
use pendula_program::book::review::working_tree::{WorkingTree, contents};
use pendula_program::book::versions::{Version, on_disk};

use crate::book::root;

mod said;

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

/// Catches: a snapshot that is accepted with another header or content than `cargo insta accept`
/// gives it, one that is accepted though it did not move, some of several accepted although one is
/// refused; one that is refused because it is named twice.
#[test]
fn what_is_accepted_is_what_was_pending() {
    let folder = tempfile::tempdir().unwrap();
    let snapshots = folder.path();
    for name in ["1_table_4", "1_slopes", "2_figure_2", "3_bits"] {
        let file = format!("{name}.snap");
        fs::copy(root().join("snapshots").join(&file), snapshots.join(&file)).unwrap();
    }
    let slopes = snapshots.join("1_slopes.snap");
    let reviewed = fs::read_to_string(&slopes).unwrap();
    let pending = reviewed.replace("0.72", "0.73");
    let with_line = pending.replacen("---\n", "---\nassertion_line: 7\n", 1);
    fs::write(snapshots.join("1_slopes.snap.new"), with_line).unwrap();
    let mut tree = WorkingTree {
        reviewed: on_disk(snapshots, ".snap").unwrap(),
        pending: on_disk(snapshots, ".snap.new").unwrap(),
        now: Version::new(),
        recorded: Vec::new(),
        stale: Vec::new(),
        failed: BTreeMap::new(),
    };
    tree.now = tree.reviewed();
    tree.now.extend(contents(&tree.pending));
    // What the code has begun to make, and what it no longer makes.
    tree.now.insert("figure_9".to_string(), REVIEWED["figure_2"].clone());
    tree.now.remove("bits");
    let accept = |names: &[&str]| {
        let names: Vec<String> = names.iter().map(ToString::to_string).collect();
        tree.accept(snapshots, &names).map_err(|error| error.to_string())
    };
    assert_eq!(accept(&["slopes", "table_9"]), Err("--accept table_9: no such snapshot".into()));
    assert_eq!(accept(&["slopes", "table_4"]), Err("--accept table_4: it has not moved".into()));
    assert_eq!(fs::read_to_string(&slopes).unwrap(), reviewed);
    // One of them twice.
    assert_eq!(accept(&["slopes", "figure_9", "bits", "slopes"]), Ok(()));
    let mut files: Vec<_> =
        fs::read_dir(snapshots).unwrap().map(|e| e.unwrap().file_name()).collect();
    files.sort();
    assert_eq!(files, ["1_slopes.snap", "1_table_4.snap", "2_figure_2.snap", "2_figure_9.snap"]);
    assert_eq!(fs::read_to_string(&slopes).unwrap(), pending);
}
