//! The list of methods: complete, unambiguous, and true to the files.

use std::collections::BTreeSet;
use std::path::Path;

use pendula::{METHODS, method_named};

/// Catches: a method whose file exists but which no test, table or page would ever run.
#[test]
fn every_file_of_methods_is_on_the_list() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/methods");
    let files: BTreeSet<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path().file_stem().unwrap().to_string_lossy().replace('_', "-"))
        .filter(|name| name != "mod")
        .collect();
    let names: BTreeSet<String> =
        METHODS.iter().map(|method| method.properties().name.to_string()).collect();
    assert_eq!(files, names);
}

/// Catches: two methods of one name, a name that cannot be typed, an entry left half empty.
#[test]
fn entries_are_complete_and_distinct() {
    let mut seen = BTreeSet::new();
    for method in METHODS {
        let entry = method.properties();
        assert!(seen.insert(entry.name), "{} stands twice", entry.name);
        let typeable = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
        assert!(entry.name.chars().all(typeable), "{}", entry.name);
        assert_eq!(method_named(entry.name).map(|m| m.properties()), Some(entry));
        assert!(!entry.title.is_empty() && !entry.aliases.is_empty());
        assert!(entry.order > 0 && entry.force_evaluations > 0 && !entry.reference.is_empty());
    }
    assert!(method_named("no-such-method").is_none());
    assert_eq!(format!("{:?}", METHODS[0]), METHODS[0].properties().name);
}
