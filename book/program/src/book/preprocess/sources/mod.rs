//! The tests' sources as pages of the book, so that a chapter's links to them work offline and
//! cannot break.
//!
//! [`Tests`] finds the tests in the files and resolves links, and [`page`] makes a page of a file.
//! A file is read line by line: rustfmt has set the first line of a function and its last brace
//! below each other. So a test inside `proptest! { … }` or another macro, which a parser skips,
//! looks like any other.

use std::ops::Range;
use std::path::Path;

use crate::output::files;
use anyhow::{Context, Result, bail, ensure};
use mdbook_preprocessor::book::{BookItem, Chapter};

use crate::book::{Pattern, pattern};

pub mod page;

/// The integration tests: every Rust file under `tests/`.
#[derive(Debug, Default)]
pub struct Tests {
    /// In alphabetical order.
    pub files: Vec<TestFile>,
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
        let mut sources = Vec::new();
        for path in files::with_extension(folder, "rs")? {
            let name = path.with_extension("").to_string_lossy().replace('\\', "/");
            sources.push((name, files::text(&folder.join(path))?));
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
            let tests = scan(&source).with_context(|| format!("tests/{name}.rs is broken"))?;
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
    let chapter = |title: &str, content: String, name: &str, parents: &[String]| {
        let mut chapter =
            Chapter::new(title, content, format!("tests/{name}.md"), parents.to_vec());
        // There is no such file in the book's sources.
        chapter.source_path = None;
        chapter
    };
    let overview = chapter("All tests", page::overview(tests), "all", &[]);
    let mut items = vec![BookItem::PartTitle("The tests".to_string()), BookItem::Chapter(overview)];
    for group in tests.files.chunk_by(|one, other| one.folder() == other.folder()) {
        let (roots, files): (Vec<_>, Vec<_>) =
            group.iter().partition(|file| file.path_in_folder() == "main");
        let title = format!("tests/{}", group[0].folder());
        let root = roots.first().map(|root| chapter(&title, page::of(root), &root.name, &[]));
        let parents: Vec<String> = root.iter().map(|root| root.name.clone()).collect();
        let pages = files.into_iter().map(|file| {
            let title = format!("{}.rs", file.path_in_folder());
            BookItem::Chapter(chapter(&title, page::of(file), &file.name, &parents))
        });
        match root {
            Some(mut root) => {
                root.sub_items = pages.collect();
                items.push(BookItem::Chapter(root));
            }
            None => items.extend(pages),
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
}

/// A test function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Test {
    /// The function's name.
    pub name: String,
    /// Its lines, counted from 0, with its attributes, its documentation and the comments right
    /// above.
    pub lines: Range<usize>,
    /// Whether its documentation has a line `Catches:`, on what wrong code it catches.
    pub says_what_it_catches: bool,
}

/// The tests of a source file, from top to bottom: functions with the attribute `test` or `rstest`,
/// and those of which a macro below makes tests, as `each_method!(slopes);` does, one for each
/// method.
fn scan(source: &str) -> Result<Vec<Test>> {
    static FUNCTION: Pattern = Pattern::new(|| {
        pattern(r"^( *)(?:pub(?:\([a-z]+\))? )?(?:async |const |unsafe )*fn (\w+)")
    });
    static ATTRIBUTE: Pattern = Pattern::new(|| pattern(r"^ *#\[(?:\w+::)*(?:rs)?test\b"));
    let lines: Vec<&str> = source.lines().collect();
    let mut tests = Vec::new();
    for (at, line) in lines.iter().enumerate() {
        let Some(found) = FUNCTION.captures(line) else { continue };
        let (indent, name) = (&found[1], &found[2]);
        let brace = format!("{indent}}}");
        // What stands above it without a gap, but for another item and what is around both.
        let is_above = |line: &str| match line.strip_prefix(indent) {
            _ if line == brace || line.starts_with("//!") => false,
            Some(rest) => rest.starts_with([' ', '#', '/', '}', ')']),
            None => false,
        };
        let start = at - lines[..at].iter().rev().take_while(|line| is_above(line)).count();
        let is_test = lines[start..at].iter().any(|line| ATTRIBUTE.is_match(line));
        let last = match line.ends_with('}') {
            true => Some(at),
            false => (at..lines.len()).find(|&end| lines[end] == brace),
        };
        let Some(last) = last else {
            // One without a body has none.
            ensure!(!is_test, "the function {name} has no end");
            continue;
        };
        let each = lines.get(last + 1).is_some_and(|line| {
            line.trim().starts_with("each_") && line.ends_with(&format!("!({name});"))
        });
        if is_test || each {
            tests.push(Test {
                name: name.to_string(),
                lines: start..last + 1 + usize::from(each),
                says_what_it_catches: lines[start..at].iter().any(|line| {
                    line.trim().strip_prefix("///").is_some_and(|text| text.contains("Catches:"))
                }),
            });
        }
    }
    Ok(tests)
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
        let names: Vec<_> = tests.files.iter().map(|file| file.name.as_str()).collect();
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

    /// Catches: an anchor that a reader of the file sees, as a block of code of its own.
    #[test]
    fn a_page_has_no_anchors() {
        let source = "// ANCHOR: one\n#[test]\nfn a() {}\n// ANCHOR_END: one\n";
        let tests = Tests::from_sources([("order", source)]).unwrap();
        let page = page::of(&tests.files[0]);
        assert!(page.contains("fn a() {}") && !page.contains("ANCHOR"), "{page}");
        assert_eq!(page.matches("rust,source").count(), 1, "{page}");
    }

    /// Catches: two tests under one id, of which links reach only the first.
    #[test]
    fn two_tests_of_one_name_are_refused() {
        let source = "#[test]\nfn a() {}\nmod m {\n    #[test]\n    fn a() {}\n}\n";
        let error = Tests::from_sources([("order", source)]).unwrap_err().to_string();
        assert!(error.contains("two tests called a"), "{error}");
    }

    const SOURCE: &str = r#"//! Header.

/// Catches: one thing.
#[test]
fn plain() {
    let text = "fn not_a_test() {";
}

// Why: a plain comment.
#[track_caller]
pub(crate) fn applied<const N: usize>(method: &dyn Method) -> [u8; 3] {
    each_method!(helper);
    [0; { 3 }]
}
each_method!(applied);

each_method! { collect }
fn helper() {}

mod inner {
    #[rstest::rstest]
    #[case(1)]
    async fn parametrised(#[case] n: i32) {}
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    /// Catches: another thing.
    #[test]
    fn property(theta in -3.0..3.0f64, omega in 0.0..1.0f64) {
        prop_assert!(theta < 3.0);
    }

    fn not_run(x in 0..3) {}
}
"#;

    /// Catches: a scan that misses a kind of test, or takes a helper or a string for one.
    #[test]
    fn every_kind_of_test_is_found_and_nothing_else() {
        let names: Vec<_> = scan(SOURCE).unwrap().into_iter().map(|test| test.name).collect();
        assert_eq!(names, ["plain", "applied", "parametrised", "property"]);
    }

    /// Catches: a cut that separates a test from its documentation, its comments, its attributes or
    /// its last brace.
    #[test]
    fn a_test_is_cut_out_whole() {
        let lines: Vec<&str> = SOURCE.lines().collect();
        let cut: Vec<_> =
            scan(SOURCE).unwrap().into_iter().map(|test| &lines[test.lines]).collect();
        let ends = |at: usize| (cut[at][0].trim(), *cut[at].last().unwrap());
        assert_eq!(ends(0), ("/// Catches: one thing.", "}"));
        assert_eq!(ends(1), ("// Why: a plain comment.", "each_method!(applied);"));
        assert_eq!(ends(2), ("#[rstest::rstest]", "    async fn parametrised(#[case] n: i32) {}"));
        assert_eq!(ends(3), ("/// Catches: another thing.", "    }"));
    }

    /// Catches: a test that is cut off shown as a whole one.
    #[test]
    fn a_function_without_an_end_is_an_error() {
        assert!(scan("#[test]\nfn a() {\n    }\n").is_err());
    }
}
