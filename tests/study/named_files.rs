//! The files and folders that the pages beside the code name, and which part of the code uses
//! which.

use std::fs;
use std::path::{Path, PathBuf};

/// The folder of the repository.
fn top() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

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
    let top = top();
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

/// Within a crate the compiler allows circles.
///
/// Catches: a module of the library that uses one that stands on it.
#[test]
fn each_module_of_the_library_uses_those_before_it() {
    const MODULES: [&str; 9] = [
        "arithmetic",
        "systems",
        "exact",
        "integrate",
        "methods",
        "metrics",
        "fast",
        "adaptive",
        "registry",
    ];
    let place = |name: &str| MODULES.iter().position(|module| *module == name);
    let top = top();
    let mut used = 0;
    for module in MODULES {
        let mut found = vec![];
        below(&top.join("src").join(module), &top, &mut found);
        for file in found.iter().filter(|path| path.ends_with(".rs")) {
            let text = fs::read_to_string(top.join(file.trim_start_matches('/'))).unwrap();
            let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
            for path in code.flat_map(|line| line.split("crate::").skip(1)) {
                let end = path.find(|c: char| !c.is_alphanumeric() && c != '_');
                let name = &path[..end.unwrap_or(path.len())];
                assert!(place(name) <= place(module), "{file} uses {name}");
                used += usize::from(place(name).is_some());
            }
        }
    }
    assert!(used > 100, "{used}");
}

/// Catches: a table of the house that is not what Cargo is told, a crate that has no row in it.
#[test]
fn the_table_of_the_house_is_that_of_the_manifests() {
    let top = top();
    let page = fs::read_to_string(top.join("CONTRIBUTING.md")).unwrap();
    // Of the table of the house alone: what, what it uses, and so that.
    let is_of_the_house = |line: &&str| line.starts_with("| `") && line.matches(" | ").count() == 2;
    let rows: Vec<&str> = page.lines().filter(is_of_the_house).collect();
    for row in &rows {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let manifest = top.join(cells[1].trim_matches('`')).join("Cargo.toml");
        let manifest = fs::read_to_string(manifest).unwrap();
        let dependencies = manifest.split("[dependencies]").nth(1).unwrap_or_default();
        let dependencies = dependencies.split("dev-dependencies]").next().unwrap();
        let mut asked: Vec<&str> = dependencies
            .lines()
            .filter(|line| line.starts_with("pendula"))
            .map(|line| match line.split(' ').next().unwrap() {
                "pendula" => "the library",
                name => name.trim_start_matches("pendula-"),
            })
            .collect();
        let mut said: Vec<&str> = cells[2].split(", ").filter(|name| *name != "nothing").collect();
        asked.sort_unstable();
        said.sort_unstable();
        assert_eq!(said, asked, "{}", cells[1]);
    }
    let workspace = fs::read_to_string(top.join("Cargo.toml")).unwrap();
    let members = workspace.lines().find(|line| line.starts_with("members")).unwrap();
    for member in members.split('"').skip(1).step_by(2) {
        let has_row = rows.iter().any(|row| row.starts_with(&format!("| `{member}` |")));
        assert!(has_row || member == ".", "{member} has no row");
    }
}
