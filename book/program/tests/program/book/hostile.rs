//! Whatever stands in a chapter: it is set as it stands, or refused in one line.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use pendula_program::book::ledger::Entry;
use pendula_program::book::preprocess::chapter::Setter;
use pendula_program::book::preprocess::sources::Tests;
use pendula_program::book::preprocess::{captions, claims, tables};
use pendula_program::output::failure::Failure;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use crate::book::chapters::chapters;

/// A thousand cases, or as many as the environment asks for, if that is more.
fn config() -> ProptestConfig {
    let asked = ProptestConfig::default();
    ProptestConfig {
        cases: asked.cases.max(1000),
        rng_seed: RngSeed::Fixed(0x0050_E4D0_1A01),
        failure_persistence: None,
        ..asked
    }
}

/// What a failed command prints: one line, with something in it.
fn is_one_line(error: anyhow::Error) -> bool {
    let line = Failure::from(error).line().unwrap_or_default();
    line.lines().count() == 1 && line.len() > "pendula: ".len()
}

/// A claim with values of every kind, and one with none.
fn ledger(id: &str) -> Option<Entry> {
    let entry = |value: Option<&str>| Entry {
        stated: value.map(str::to_string),
        measured: value.map(str::to_string),
        verdict: Some("reproduced".to_string()),
    };
    match id {
        "T4.rk4.0.01" => Some(entry(Some("2.34e-7"))),
        "T5.fe.dH" => Some(entry(None)),
        _ => None,
    }
}

static TESTS: LazyLock<Tests> = LazyLock::new(|| {
    let source = "/// Catches: `a` < b, and $x$.\n#[test]\nfn a() {}\n#[test]\nfn b() {}\n";
    Tests::from_sources([("x", source)]).unwrap()
});

static CHAPTERS: LazyLock<Vec<String>> =
    LazyLock::new(|| chapters().into_iter().map(|(_, text)| text).collect());

/// What authors type, and what they should not.
#[rustfmt::skip]
const SNIPPETS: &[&str] = &[
    // Directives.
    "{{", "}}", "{{}}", "{{ }}", "\\{{", "{{measured T4.rk4.0.01}}", "{{stated T5.fe.dH}}",
    "{{verdict nobody}}", "{{measured}}", "{{test x::a}}", "* {{test x::a}}.",
    "{{test x::b}}", "{{verdicts}}", "{{work-precision}}", "{{#include x}}",
    // Formulas.
    "$", "$$", "\\$", "\\(", "$x^2$", "$\\frac{1$", "$\\begin{matrix}$", "$\\unknown$",
    "${{measured T4.rk4.0.01}}$",
    // Code, lists and tables.
    "`", "```", "```rust\n", "~~~", "    ", "\t", "\n", "\n\n", "\r\n", "> ", "* ", "1. ", "- [ ] ",
    "|", "|---|\n", "| Claim | verdict |\n|---|---|\n| `T4.rk4.0.01` | reproduced |\n",
    "| Claim |\n|--:|\n| `no` |\n", "| id | a |\n| -- | -- |\n| * | T1.* |\n| b | ≠ 1e-3 |\n",
    "Table: A caption.\n\n", "Table[RK4]: x\n\n", "Table[]:",
    // Other markup.
    "<div>", "</main>", "<script>x</script>", "<!-- ", " -->", "[a](b.md", "![](", "[^1]",
    "[^1]: note", "# ", "## \n", "\\", "&", "&nbsp;", "&#0;", "*", "**", "_",
    // Letters.
    "10⁻⁷", "10⁻", "1 000 000", "\u{a0}", "\u{0}", "\u{202e}", "\u{feff}", "é", "🙂", "θ₀",
];

/// Pieces of the book's chapters and what else is typed, one after the other.
fn spoilt_chapter() -> impl Strategy<Value = String> {
    let place = (any::<prop::sample::Index>(), any::<prop::sample::Index>(), 0..300_usize);
    let piece = place.prop_map(|(chapter, from, length)| {
        let text = &CHAPTERS[chapter.index(CHAPTERS.len())];
        let from = from.index(text.chars().count());
        text.chars().skip(from).take(length).collect::<String>()
    });
    let snippet = prop::sample::select(SNIPPETS).prop_map(str::to_string);
    let typed = prop_oneof![6 => snippet, 4 => piece, 1 => "\\PC{0,8}", 1 => any::<String>()];
    prop::collection::vec(typed, 0..9).prop_map(|parts| parts.concat())
}

/// All that is done to the text of a chapter.
fn set(text: &str) -> anyhow::Result<String> {
    let setter = Setter::new(&ledger, &TESTS, "<figure>".to_string());
    let mut quoted = BTreeSet::new();
    let text = captions::set(&tables::set(text)?)?;
    let text = setter.set(&text, "../", &mut quoted)?;
    claims::set(&text, &claims::Quotes::new())
}

proptest! {
    #![proptest_config(config())]

    /// Catches: a text cut between the bytes of a character; a passage that ends before it begins;
    /// a directive left open, nested or empty that is more than an error; an error of many lines.
    #[test]
    fn a_chapter_is_set_or_refused(text in spoilt_chapter()) {
        if let Err(error) = set(&text) {
            prop_assert!(is_one_line(error));
        }
    }
}
