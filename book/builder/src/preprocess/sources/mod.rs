//! The tests' sources as pages of the book, so that a chapter's links to them work offline and
//! cannot break.
//!
//! [`scan`] finds the tests in a file, [`page`] makes its page, and [`Tests`] resolves links.

use std::path::Path;

use anyhow::{Context, Result, bail, ensure};
use mdbook_preprocessor::book::{BookItem, Chapter};

use self::scan::Test;
use pendula_output::files;

pub mod page;
pub mod scan;

/// The integration tests: every Rust file under `tests/`.
#[derive(Debug, Default)]
pub struct Tests {
    /// In alphabetical order.
    files: Vec<TestFile>,
}

/// One file under `tests/`.
#[derive(Debug)]
pub struct TestFile {
    /// Its path without `tests/` and `.rs`: `methods/order`.
    pub name: String,
    /// Its text.
    pub source: String,
    /// Its tests, from top to bottom.
    pub tests: Vec<Test>,
}

impl Tests {
    /// Reads the folder `tests/`; a folder that does not exist has no tests.
    pub fn read(folder: &Path) -> Result<Self> {
        let cannot = |path: &Path| format!("{} cannot be read", path.display());
        let mut sources = Vec::new();
        if files::is_folder(folder).with_context(|| cannot(folder))? {
            for (path, _) in files::tree(folder).with_context(|| cannot(folder))? {
                if path.extension().is_some_and(|extension| extension == "rs") {
                    let name = path.with_extension("").to_string_lossy().replace('\\', "/");
                    let path = folder.join(path);
                    let source = files::read_to_string(&path).with_context(|| cannot(&path))?;
                    sources.push((name, source));
                }
            }
        }
        sources.sort();
        Self::from_sources(sources)
    }

    /// The tests of files given as name and text.
    pub fn from_sources<S: Into<String>>(
        sources: impl IntoIterator<Item = (S, S)>,
    ) -> Result<Self> {
        let mut files = Vec::new();
        for (name, source) in sources {
            let (name, source) = (name.into(), source.into());
            let tests =
                scan::tests(&source).with_context(|| format!("tests/{name}.rs is broken"))?;
            for (at, test) in tests.iter().enumerate() {
                // The name is the id that links point to.
                ensure!(
                    tests[..at].iter().all(|earlier| earlier.name != test.name),
                    "tests/{name}.rs has two tests called {}: a link could mean either",
                    test.name
                );
            }
            files.push(TestFile { name, source, tests });
        }
        Ok(Self { files })
    }

    /// The files, in alphabetical order.
    pub fn files(&self) -> &[TestFile] {
        &self.files
    }

    /// What the test cited as `file::function` catches, as its documentation says.
    pub fn catches(&self, cited: &str) -> Result<&str> {
        let (_, Test { name, catches, .. }) = self.find(cited)?;
        ensure!(!catches.is_empty(), "the documentation of {name} has no line `Catches:`");
        Ok(catches)
    }

    /// File and function of a test cited as `file::function`, as `cargo test` prints it; the name
    /// of its program may precede it, as `program::file::function` or `program/file::function`.
    pub fn find(&self, cited: &str) -> Result<(&TestFile, &Test)> {
        let Some((file, function)) = cited.rsplit_once("::") else {
            bail!("a test is cited as file::function");
        };
        let file = file.replace("::", "/");
        let cited = |known: &&TestFile| known.name == file || known.path_in_folder() == file;
        let found: Vec<&TestFile> = self.files.iter().filter(cited).collect();
        let file = match found[..] {
            [file] => file,
            [] => bail!("there is no {file}.rs in tests/"),
            [..] => bail!("{file}.rs stands in two folders of tests/: name the folder"),
        };
        let test = file.tests.iter().find(|known| known.name == function);
        Ok((file, test.with_context(|| format!("tests/{}.rs has no test {function}", file.name))?))
    }
}

/// The book's last part: an overview, a page for each program of tests, and below it one for each
/// of its files. Nothing, if there are no tests.
pub fn pages(tests: &Tests) -> Vec<BookItem> {
    if tests.files.is_empty() {
        return Vec::new();
    }
    let chapter = |title: &str, content: String, path: String, parents: Vec<String>| {
        let mut chapter = Chapter::new(title, content, path, parents);
        // There is no such file in the book's sources.
        chapter.source_path = None;
        chapter
    };
    let overview = page::overview(tests);
    let overview = chapter("All tests", overview, "tests/all.md".to_string(), Vec::new());
    let mut items = vec![BookItem::PartTitle("The tests".to_string()), BookItem::Chapter(overview)];
    for group in tests.files.chunk_by(|one, other| one.folder() == other.folder()) {
        let folder = group[0].folder();
        let title = format!("tests/{folder}");
        let (roots, files): (Vec<_>, Vec<_>) = group.iter().partition(|file| file.is_root());
        let below = |parents: &[String]| {
            let page = |file: &&TestFile| {
                let path = format!("tests/{}.md", file.name);
                let title = format!("{}.rs", file.path_in_folder());
                BookItem::Chapter(chapter(&title, page::of(file), path, parents.to_vec()))
            };
            files.iter().map(page).collect::<Vec<_>>()
        };
        match roots[..] {
            [root, ..] => {
                let path = format!("tests/{}.md", root.name);
                let mut parent = chapter(&title, page::of(root), path, Vec::new());
                parent.sub_items = below(&[title]);
                items.push(BookItem::Chapter(parent));
            }
            [] => items.extend(below(&[])),
        }
    }
    items
}

impl TestFile {
    /// The folder below `tests/` that it is in, which is the name of its program; empty for a file
    /// directly in `tests/`.
    fn folder(&self) -> &str {
        self.name.split_once('/').map_or("", |(folder, _)| folder)
    }

    /// Its path below that folder, without `.rs`.
    fn path_in_folder(&self) -> &str {
        self.name.split_once('/').map_or(&self.name, |(_, path)| path)
    }

    /// Whether it is the one that lists its program's files.
    fn is_root(&self) -> bool {
        self.path_in_folder() == "main"
    }
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    /// Catches: a page for a file that is not Rust, a nested file lost, an order that depends on
    /// the disk.
    #[test]
    fn every_rust_file_has_a_page() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir_all(folder.path().join("support/data")).unwrap();
        for file in ["order.rs", "area.rs", "support/scenes.rs", "support/data/period.csv"] {
            fs::write(folder.path().join(file), "//! Header.\n").unwrap();
        }
        let tests = Tests::read(folder.path()).unwrap();
        let names: Vec<_> = tests.files().iter().map(|file| file.name.as_str()).collect();
        assert_eq!(names, ["area", "order", "support/scenes"]);
    }

    /// Catches: a citation resolved by its function alone, and a function that is not a test.
    #[test]
    fn a_citation_names_file_and_function() {
        let tests = Tests::from_sources([
            ("order", "#[test]\nfn slopes() {}\nfn helper() {}\n"),
            ("support/scenes", "#[test]\nfn start() {}\n"),
            ("a/twice", "#[test]\nfn start() {}\n"),
            ("b/twice", "#[test]\nfn start() {}\n"),
        ])
        .unwrap();
        let found = |cited| {
            let (file, test) = tests.find(cited).unwrap();
            (file.name.as_str(), test.name.as_str())
        };
        assert_eq!(found("order::slopes"), ("order", "slopes"));
        assert_eq!(found("support::scenes::start"), ("support/scenes", "start"));
        assert_eq!(found("scenes::start"), ("support/scenes", "start"));
        for wrong in [
            "slopes",
            "area::slopes",
            "order::start",
            "order::helper",
            "cenes::start",
            "twice::start",
        ] {
            assert!(tests.find(wrong).is_err(), "{wrong}");
        }
    }

    /// Catches: two tests under one id, of which links reach only the first.
    #[test]
    fn two_tests_of_one_name_are_refused() {
        let source = "#[test]\nfn a() {}\nmod m {\n    #[test]\n    fn a() {}\n}\n";
        let error = Tests::from_sources([("order", source)]).unwrap_err().to_string();
        assert!(error.contains("two tests called a"), "{error}");
    }
}
