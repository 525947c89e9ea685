//! Finds the code and the formulas in a Markdown text.

use std::ops::Range;

use pulldown_cmark::{Event, Options, Parser, Tag};

use crate::book::{Pattern, pattern};

/// What stands in a text that is not prose.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A code span or a code block: it stays as it is.
    Code,
    /// `$tex$` or `$$tex$$`.
    Formula {
        /// What stands between the delimiters.
        tex: String,
        /// Whether it is set on its own line.
        display: bool,
    },
    /// The exponent of a power of ten such as 10⁻⁴, in Unicode superscripts, of which few fonts
    /// have all; or a number as programs write it, 3.2e-4.
    Exponent,
    /// The space between a number and its unit, or between the thousands of a number: a line must
    /// not end there.
    Gap,
    /// A `$` that is not part of a formula and not escaped: almost always a formula that Markdown
    /// did not recognise, because a brace is missing, a space follows the `$`, or HTML is around
    /// it.
    StrayDollar,
}

/// What is not prose in a Markdown text, with its bytes, delimiters included: in order, without
/// overlap.
pub fn passages(text: &str) -> Vec<(Range<usize>, Kind)> {
    let mut passages = Vec::new();
    let mut code = 0..0;
    for (event, range) in Parser::new_ext(text, options()).into_offset_iter() {
        let kind = match event {
            Event::Code(_) => Kind::Code,
            Event::Start(Tag::CodeBlock(_)) => {
                code = range.clone();
                Kind::Code
            }
            Event::Text(_) | Event::Html(_) | Event::InlineHtml(_) if range.start >= code.end => {
                passages.extend(stray_dollar(text, &range).map(|at| (at, Kind::StrayDollar)));
                // Not in HTML: SVG text has no <sup>.
                if let Event::Text(_) = event {
                    passages.extend(exponents(text, &range).map(|at| (at, Kind::Exponent)));
                    passages.extend(gaps(text, &range).map(|at| (at, Kind::Gap)));
                }
                continue;
            }
            Event::SoftBreak if is_gap(text, &range) => Kind::Gap,
            Event::InlineMath(tex) => Kind::Formula { tex: tex.into_string(), display: false },
            Event::DisplayMath(tex) => Kind::Formula { tex: tex.into_string(), display: true },
            _ => continue,
        };
        passages.push((range, kind));
    }
    // Footnote definitions and the like may come out of order.
    passages.sort_by_key(|(range, _)| range.start);
    passages
}

fn exponents(text: &str, range: &Range<usize>) -> impl Iterator<Item = Range<usize>> {
    static POWER: Pattern = Pattern::new(|| pattern(r"10(⁻?[⁰¹²³⁴-⁹]+)|\b(\d+(?:\.\d+)?e-?\d+)\b"));
    let start = range.start;
    let found = POWER.captures_iter(&text[range.clone()]);
    found
        .filter_map(|found| found.get(1).or(found.get(2)))
        .map(move |exponent| start + exponent.start()..start + exponent.end())
}

fn gaps(text: &str, range: &Range<usize>) -> impl Iterator<Item = Range<usize>> {
    let start = range.start;
    let spaces = text[range.clone()].match_indices(' ');
    let spaces = spaces.map(move |(at, _)| start + at..start + at + 1);
    spaces.filter(|space| is_gap(text, space))
}

/// `text` with a no-break space for each space that must not end a line.
pub fn held(text: &str) -> String {
    splice(text, gaps(text, &(0..text.len())).map(|gap| (gap, "\u{a0}".to_string())))
}

/// What no line must separate from a formula before it: the unit, or the value, as in `$h$ = 1 s`;
/// with the white space before it. `after` is the text after the formula.
pub fn held_after(after: &str) -> Option<&str> {
    static HELD: Pattern = Pattern::new(|| {
        let value = r"=\s[−-]?\d+(?:\.\d+)?";
        pattern(&format!(r"^(?<held>\s(?:{value}\s{UNITS}|{value}|{UNITS}))(?:$|[^\w/*])"))
    });
    Some(HELD.captures(after)?.name("held")?.as_str())
}

const UNITS: &str = "(?:rad/s²?|rad|m/s²?|[µmn]?s|J|kg|m|%)";

/// Whether this white space is between a number (typed, or from a directive or a formula) and a
/// unit, or between two groups of digits, or beside the sign in `h = 0.1`.
fn is_gap(text: &str, space: &Range<usize>) -> bool {
    static UNIT: Pattern = Pattern::new(|| pattern(&format!(r"^{UNITS}(?:$|[^\w/*])")));
    static VALUE: Pattern = Pattern::new(|| pattern(r"^[−-]?\d"));
    static IS_VALUE: Pattern = Pattern::new(|| pattern(r"^=\s[−-]?\d"));
    static NAME: Pattern = Pattern::new(|| pattern(r"(?:^|[^\w])\w{1,2}[²³]?$"));
    static THOUSANDS: Pattern = Pattern::new(|| pattern(r"^\d{3}(?:$|[^\w])"));
    let (before, after) = (&text[..space.start], &text[space.end..]);
    let digit = before.ends_with(|c: char| c.is_ascii_digit());
    let number =
        before.ends_with(char::is_numeric) || before.ends_with("}}") || before.ends_with('$');
    number && UNIT.is_match(after)
        || digit && THOUSANDS.is_match(after)
        || before.ends_with(" =") && VALUE.is_match(after)
        || IS_VALUE.is_match(after) && NAME.is_match(before)
}

fn stray_dollar(text: &str, range: &Range<usize>) -> Option<Range<usize>> {
    let at = range.start + text[range.clone()].find('$')?;
    (!text[..at].ends_with('\\')).then_some(at..at + 1)
}

/// mdBook's own extensions, so that both parse a chapter alike, and formulas.
pub fn options() -> Options {
    Options::ENABLE_TABLES
        | Options::ENABLE_FOOTNOTES
        | Options::ENABLE_STRIKETHROUGH
        | Options::ENABLE_TASKLISTS
        | Options::ENABLE_HEADING_ATTRIBUTES
        | Options::ENABLE_SMART_PUNCTUATION
        | Options::ENABLE_DEFINITION_LIST
        | Options::ENABLE_GFM
        | Options::ENABLE_MATH
}

/// `text` with each range replaced. The ranges are in order and do not overlap.
pub fn splice(text: &str, edits: impl IntoIterator<Item = (Range<usize>, String)>) -> String {
    let mut spliced = String::with_capacity(text.len());
    let mut done = 0;
    for (range, replacement) in edits {
        spliced.push_str(&text[done..range.start]);
        spliced.push_str(&replacement);
        done = range.end;
    }
    spliced.push_str(&text[done..]);
    spliced
}

/// Backticks around code: one more than stand together in it, and at least as many as `least`.
pub fn fence(code: &str, least: usize) -> String {
    let longest = code.split(|c| c != '`').map(str::len).max().unwrap_or(0);
    "`".repeat((longest + 1).max(least))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(text: &str) -> Vec<(&str, Kind)> {
        passages(text).into_iter().map(|(range, kind)| (&text[range], kind)).collect()
    }

    /// Catches: a formula with a mistake in it that reaches the page as dollars and backslashes.
    #[test]
    fn a_dollar_is_a_formula_or_escaped() {
        let stray = |text: &str| found(text).iter().any(|(_, kind)| *kind == Kind::StrayDollar);
        for text in ["an $\\frac{1$ open", "$ x$", "<figcaption>\n$x$\n</figcaption>\n"] {
            assert!(stray(text), "{text}");
        }
        for text in ["it costs \\$5", "    $indented code\n", "`$`", "$x$", "<p>\n\n$x$\n\n</p>"] {
            assert!(!stray(text), "{text}");
        }
    }

    /// Catches: superscripts left in a table's cells, and markup put into a drawing or into code.
    #[test]
    fn powers_of_ten_are_found_in_prose_only() {
        let text = "| a |\n|---|\n| 2 × 10⁻¹² |\n\n`10³` m² 3e-4, x2e5, 0.5e, `1e-6`\n\n\
                    <figure><svg>10³</svg></figure>\n";
        let exponents: Vec<_> =
            found(text).into_iter().filter(|(_, kind)| *kind == Kind::Exponent).collect();
        assert_eq!(exponents, [("⁻¹²", Kind::Exponent), ("3e-4", Kind::Exponent)]);
    }

    /// Catches: a line that ends between 1000 and s; words after a number taken for units, years
    /// for thousands.
    #[test]
    fn numbers_hold_on_to_their_units() {
        let gaps = |text: &str| {
            let gaps = passages(text).into_iter().filter(|(_, kind)| *kind == Kind::Gap);
            splice(text, gaps.map(|(range, _)| (range, "~".to_string())))
        };
        for (text, held) in [
            ("over 1000 s, from 1 rad.", "over 1000~s, from 1~rad."),
            ("of 100 000 steps at 9.81 m/s²", "of 100~000 steps at 9.81~m/s²"),
            ("{{measured T5.rk4}} J and $h$ s", "{{measured T5.rk4}}~J and $h$~s"),
            ("about 2 × 10⁻⁴ rad", "about 2 × 10⁻⁴~rad"),
            ("a step of 0.01\ns is small", "a step of 0.01~s is small"),
            ("| a |\n|---|\n| 12 ns |", "| a |\n|---|\n| 12~ns |"),
            ("an order = 4", "an order =~4"),
            ("at γ = 1.07, Δt = −0.1 s", "at γ~=~1.07, Δt~=~−0.1~s"),
        ] {
            assert_eq!(gaps(text), held);
        }
        for text in [
            "a = b",
            "1 step",
            "4 methods",
            "in 1967 1000",
            "`1 s`",
            "s 1",
            "> 1\n> s",
            "<b>1</b> s",
        ] {
            assert_eq!(gaps(text), text);
        }
    }

    /// Catches: a line that begins with the unit of a formula, or ends before its value; words that
    /// are taken along.
    #[test]
    fn formulas_hold_on_to_their_units() {
        assert_eq!(held_after(" rad. Then"), Some(" rad"));
        assert_eq!(held_after(" = 0.05 rad over"), Some(" = 0.05 rad"));
        assert_eq!(held_after("\n= 50, and"), Some("\n= 50"));
        for none in ["rad", " radians", " = x", " = 1e-4 s", ", s", " and"] {
            assert_eq!(held_after(none), None);
        }
    }

    /// Catches: the `>` of a block quote taken for part of the formula.
    #[test]
    fn a_formula_over_several_lines_of_a_quote_is_whole() {
        let text = "> $$\n> a\n> $$\n";
        let (source, Kind::Formula { tex, display: true }) = &found(text)[0] else { panic!() };
        assert_eq!((*source, tex.trim()), ("$$\n> a\n> $$", "a"));
    }
}
