//! Finding the tests in a Rust file.
//!
//! The file is read as tokens, not as a syntax tree: a test inside `proptest! { … }` or another
//! macro, which a parser skips, looks like any other.

use std::ops::Range;
use std::str::FromStr;

use anyhow::{Result, anyhow};
use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};

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

/// Attributes that make a function a test, by the last segment of their path.
const TEST_ATTRIBUTES: [&str; 2] = ["test", "rstest"];
/// What the names of macros begin with that make tests of a function: `each_method!(slopes);` below
/// the function `slopes` makes one for each method.
const EACH: &str = "each_";

/// The tests of a source file, from top to bottom.
///
/// # Errors
/// When the text does not consist of Rust's tokens.
pub fn tests(source: &str) -> Result<Vec<Test>> {
    let tokens = TokenStream::from_str(source)
        .map_err(|error| anyhow!("{error} in line {}", error.span().start().line))?;
    let mut functions = Vec::new();
    walk(tokens, &mut functions);
    let tests = functions.into_iter().filter(|function| function.is_test);
    let mut tests: Vec<Test> = tests.map(|function| function.test).collect();
    let lines: Vec<&str> = source.lines().collect();
    for test in &mut tests {
        while test.lines.start > 0 && is_comment(lines[test.lines.start - 1]) {
            test.lines.start -= 1;
        }
        test.catches = catches(&lines[test.lines.clone()]);
    }
    Ok(tests)
}

/// What follows `Catches:` in its paragraph of the documentation, without the full stop, which the
/// chapter sets.
fn catches(lines: &[&str]) -> String {
    let above = lines.iter().map(|line| line.trim()).take_while(|line| !line.starts_with("fn "));
    let documentation = above.filter_map(|line| line.strip_prefix("///"));
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

fn is_comment(line: &str) -> bool {
    let line = line.trim_start();
    line.starts_with("//") && !line.starts_with("//!")
}

/// The attributes read before the keyword of an item.
#[derive(Default)]
struct Attributes {
    /// The line the first one begins on.
    start: Option<usize>,
    names: Vec<String>,
}

impl Attributes {
    fn make_a_test(&self) -> bool {
        self.names.iter().any(|name| TEST_ATTRIBUTES.contains(&name.as_str()))
    }
}

/// A function, which may be a test.
struct Function {
    test: Test,
    is_test: bool,
}

fn walk(tokens: TokenStream, functions: &mut Vec<Function>) {
    let mut tokens = tokens.into_iter().peekable();
    let mut attributes = Attributes::default();
    while let Some(token) = tokens.next() {
        match token {
            TokenTree::Punct(hash) if hash.as_char() == '#' => {
                if let Some(TokenTree::Group(group)) = tokens.peek()
                    && group.delimiter() == Delimiter::Bracket
                {
                    attributes.start.get_or_insert(hash.span().start().line - 1);
                    attributes.names.extend(attribute_name(group));
                    tokens.next();
                }
            }
            TokenTree::Ident(keyword) if keyword == "fn" => {
                let name = tokens.next();
                // Arguments are groups too; the body is the first in braces.
                let body = tokens.by_ref().find_map(|token| match token {
                    TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => Some(group),
                    _ => None,
                });
                if let (Some(TokenTree::Ident(name)), Some(body)) = (name, body) {
                    let start = attributes.start.unwrap_or(keyword.span().start().line - 1);
                    let lines = start..body.span_close().end().line;
                    let test = Test { name: name.to_string(), lines, catches: String::new() };
                    functions.push(Function { test, is_test: attributes.make_a_test() });
                }
                attributes = Attributes::default();
            }
            TokenTree::Ident(each) if each.to_string().starts_with(EACH) => {
                let called = tokens.next_if(|token| token.to_string() == "!");
                if let (Some(_), Some(TokenTree::Group(arguments))) = (called, tokens.peek()) {
                    let name = arguments.stream().to_string();
                    let of = functions.iter_mut().rfind(|function| function.test.name == name);
                    if let Some(function) = of {
                        function.is_test = true;
                        function.test.lines.end = arguments.span_close().end().line;
                    }
                }
                attributes = Attributes::default();
            }
            // Visibility and qualifiers stand between attributes and keyword.
            TokenTree::Ident(word)
                if ["pub", "async", "const", "unsafe", "extern"].iter().any(|q| word == q) => {}
            TokenTree::Group(group) if group.delimiter() == Delimiter::Parenthesis => {}
            TokenTree::Group(group) => {
                walk(group.stream(), functions);
                attributes = Attributes::default();
            }
            _ => attributes = Attributes::default(),
        }
    }
}

/// `test` for `#[test]`, `rstest` for `#[rstest::rstest]`.
fn attribute_name(attribute: &Group) -> Option<String> {
    let mut name = None;
    for token in attribute.stream() {
        match token {
            TokenTree::Ident(segment) => name = Some(segment.to_string()),
            TokenTree::Punct(colon) if colon.as_char() == ':' => {}
            _ => break,
        }
    }
    name
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

    /// Catches: a file that is broken shown as a file without tests.
    #[test]
    fn what_is_not_rust_is_an_error() {
        assert!(tests("fn a( {}").is_err());
    }
}
