//! The files and folders that the pages beside the code name.

use std::fs;
use std::path::Path;

/// All files and folders below a folder, as paths from the top with `/` at their beginning.
fn below(folder: &Path, top: &Path, found: &mut Vec<String>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.strip_prefix(top).unwrap().to_str().unwrap().replace('\\', "/");
        if name == "target" || name == ".git" {
            continue;
        }
        found.push(format!("/{name}"));
        if path.is_dir() {
            below(&path, top, found);
        }
    }
}

/// Catches: a page that names a file or a folder that has gone or was renamed.
#[test]
fn what_a_page_names_is_there() {
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap();
    let mut found = vec![];
    below(&top, &top, &mut found);
    let mut named = 0;
    for page in ["README.md", "CONTRIBUTING.md", "SECURITY.md", ".ci/mutants.md"] {
        let text = fs::read_to_string(top.join(page)).unwrap();
        for word in text.split('`').skip(1).step_by(2) {
            let is_path = word.trim_matches('/').contains('/')
                && word.chars().all(|c| c.is_ascii_lowercase() || "_-./0123456789".contains(c))
                && !word.starts_with("target/");
            if is_path {
                let ending = format!("/{}", word.trim_matches('/'));
                assert!(found.iter().any(|path| path.ends_with(&ending)), "{page}: {word}");
                named += 1;
            }
        }
    }
    assert!(named > 60, "{named}");
}
