//! Finding the tests in a Rust file, line by line: rustfmt has set the first line of a function and
//! its last brace below each other. So a test inside `proptest! { … }` or another macro, which a
//! parser skips, looks like any other.

use std::ops::Range;
use std::sync::LazyLock;

use anyhow::{Result, ensure};
use regex::Regex;

/// A test function.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Test {
    /// The function's name.
    pub name: String,
    /// Its lines, counted from 0, with its attributes, its documentation and the comments right
    /// above.
    pub lines: Range<usize>,
    /// What wrong code it catches, as its documentation says after `Catches:`; empty if it does
    /// not.
    pub catches: String,
}

/// The tests of a source file, from top to bottom: functions with the attribute `test` or `rstest`,
/// and those of which a macro below makes tests, as `each_method!(slopes);` does, one for each
/// method.
pub fn tests(source: &str) -> Result<Vec<Test>> {
    static FUNCTION: LazyLock<Regex> = LazyLock::new(|| {
        let pattern = r"^( *)(?:pub(?:\([a-z]+\))? )?(?:async |const |unsafe )*fn (\w+)";
        Regex::new(pattern).expect("the pattern is a constant")
    });
    static ATTRIBUTE: LazyLock<Regex> = LazyLock::new(|| {
        Regex::new(r"^ *#\[(?:\w+::)*(?:rs)?test\b").expect("the pattern is a constant")
    });
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
                catches: catches(&lines[start..at]),
            });
        }
    }
    Ok(tests)
}

/// What follows `Catches:` in its paragraph of the documentation, without the full stop, which the
/// chapter sets.
fn catches(above: &[&str]) -> String {
    let documentation = above.iter().filter_map(|line| line.trim().strip_prefix("///"));
    let mut paragraph = documentation.map(str::trim);
    let first = paragraph.by_ref().find_map(|line| Some(line.split_once("Catches:")?.1));
    let rest = paragraph.take_while(|line| !line.is_empty());
    let words: Vec<&str> = first.into_iter().chain(rest).flat_map(str::split_whitespace).collect();
    let sentence = words.join(" ");
    match sentence.strip_suffix(".)") {
        Some(inside) => format!("{inside})"),
        None => sentence.trim_end_matches('.').to_string(),
    }
}

#[cfg(test)]
mod unit {
    use super::*;

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
        let names: Vec<_> = tests(SOURCE).unwrap().into_iter().map(|test| test.name).collect();
        assert_eq!(names, ["plain", "applied", "parametrised", "property"]);
    }

    /// Catches: a cut that separates a test from its documentation, its comments, its attributes or
    /// its last brace.
    #[test]
    fn a_test_is_cut_out_whole() {
        let lines: Vec<&str> = SOURCE.lines().collect();
        let cut: Vec<_> =
            tests(SOURCE).unwrap().into_iter().map(|test| &lines[test.lines]).collect();
        let ends = |at: usize| (cut[at][0].trim(), *cut[at].last().unwrap());
        assert_eq!(ends(0), ("/// Catches: one thing.", "}"));
        assert_eq!(ends(1), ("// Why: a plain comment.", "each_method!(applied);"));
        assert_eq!(ends(2), ("#[rstest::rstest]", "    async fn parametrised(#[case] n: i32) {}"));
        assert_eq!(ends(3), ("/// Catches: another thing.", "    }"));
    }

    /// Catches: a test that is cut off shown as a whole one.
    #[test]
    fn a_function_without_an_end_is_an_error() {
        assert!(tests("#[test]\nfn a() {\n    }\n").is_err());
    }
}
