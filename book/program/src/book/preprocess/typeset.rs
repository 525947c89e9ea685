//! Formulas, values and text as HTML that Markdown leaves unchanged.
//!
//! mdBook parses a chapter again after this preprocessor, and would take `a_1*b_2` for emphasis,
//! `|` for a new cell and primes for curly quotes. It never does so with character references.
//!
//! Formulas are typeset by KaTeX in Rust: HTML for the screen, MathML for screen readers. No script
//! runs in the reader's browser. The ledger's values become 2.01 × 10⁻⁴ for `2.01e-4`.

use std::borrow::Cow;

use anyhow::{Result, anyhow, ensure};
use katex::{KatexContext, OutputFormat, Settings, StrictMode, StrictSetting, render_to_string};
use regex::Captures;

use super::markdown;
use crate::book::{Pattern, pattern};

/// `text` as HTML without active Markdown characters.
pub fn inert(text: &str) -> String {
    let mut inert = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            _ if c.is_ascii_punctuation() => inert += &format!("&#{};", u32::from(c)),
            '\n' | '\r' => inert.push(' '),
            _ => inert.push(c),
        }
    }
    inert
}

/// A typesetter; constructing one takes longer than typesetting a formula, so the whole book shares
/// one.
#[derive(Default)]
pub struct Maths(KatexContext);

impl Maths {
    /// The HTML of a formula, safe to stand in Markdown.
    pub fn set(&self, tex: &str, display: bool) -> Result<String> {
        let parts = if display { formulas(tex) } else { vec![tex] };
        let parts = parts.iter().map(|part| self.set_one(part, display));
        let html = parts.collect::<Result<Vec<_>>>()?.concat();
        // One display of several formulas, which stand below one another where there is no room.
        Ok(inert_html(&html.replace("</span><span class=\"katex-display\">", "")))
    }

    fn set_one(&self, tex: &str, display: bool) -> Result<String> {
        let settings = Settings::builder()
            .display_mode(display)
            .output(OutputFormat::HtmlAndMathml)
            .throw_on_error(true)
            .strict(StrictSetting::Mode(StrictMode::Error))
            .build();
        let html = render_to_string(&self.0, tex, &settings)
            .map_err(|error| anyhow!("formula {}: {error}", tex.trim()))?;
        ensure!(!has_bare_root(tex), "formula {}: write \\sqrt{{…}} with braces", tex.trim());
        Ok(without_annotations(&html).into_owned())
    }
}

/// The formulas that stand beside one another in a display, with `\qquad` between them.
fn formulas(tex: &str) -> Vec<&str> {
    static TOKEN: Pattern = Pattern::new(|| pattern(r"\\[A-Za-z]+|\\.|[{}]"));
    let (mut formulas, mut begin, mut depth) = (Vec::new(), 0, 0);
    for token in TOKEN.find_iter(tex) {
        match token.as_str() {
            "{" | r"\begin" | r"\left" => depth += 1,
            "}" | r"\end" | r"\right" => depth -= 1,
            r"\qquad" if depth == 0 => {
                formulas.push(&tex[begin..token.start()]);
                begin = token.end();
            }
            _ => {}
        }
    }
    formulas.push(&tex[begin..]);
    formulas
}

/// Whether there is a root of a bare symbol, `\sqrt2`: katex-rs draws the root sign over it.
fn has_bare_root(tex: &str) -> bool {
    tex.split(r"\sqrt").skip(1).any(|argument| !argument.trim_start().starts_with(['{', '[']))
}

/// KaTeX repeats the TeX source in an annotation, which is invisible but gets into the search
/// index.
fn without_annotations(html: &str) -> Cow<'_, str> {
    static ANNOTATION: Pattern = Pattern::new(|| pattern("(?s)<annotation .*?</annotation>"));
    ANNOTATION.replace_all(html, "")
}

/// `html` with its text made inert, its tags' attributes in alphabetical order and its line breaks
/// as spaces.
///
/// katex-rs keeps attributes in a hash map, and so writes them in a different order in each
/// process.
fn inert_html(html: &str) -> String {
    // A tag, or a reference such as `&amp;`, which stands for a character already.
    static MARKUP: Pattern = Pattern::new(|| {
        let tag = r#"(?<name></?[^\s/<>]+)(?<attributes>(?:"[^"]*"|'[^']*'|[^"'<>])*?)(?<end>/?>)"#;
        pattern(&format!("{tag}|&[^;]*;"))
    });
    static ATTRIBUTE: Pattern = Pattern::new(|| pattern(r#"(?:"[^"]*"|'[^']*'|[^"'\s])+"#));
    let (mut set, mut done) = (String::with_capacity(html.len() * 2), 0);
    for found in MARKUP.captures_iter(html) {
        let markup = found.get_match();
        set += &inert(&html[done..markup.start()]);
        done = markup.end();
        let Some(attributes) = found.name("attributes") else {
            set += markup.as_str();
            continue;
        };
        let mut attributes: Vec<&str> =
            ATTRIBUTE.find_iter(attributes.as_str()).map(|found| found.as_str()).collect();
        attributes.sort_unstable();
        set += &found["name"];
        for attribute in attributes {
            set.push(' ');
            // A table cell ends at `|` even inside a tag.
            set += &attribute.replace(['\n', '\r'], " ").replace('|', "&#124;");
        }
        set += &found["end"];
    }
    set + &inert(&html[done..])
}

/// A value as HTML: a line may end between its words, but not within a number or before its unit.
pub fn value(value: &str) -> String {
    static NOTABLE: Pattern =
        Pattern::new(|| pattern(r"(?:(?<mantissa>\d+(?:\.\d+)?)[eE]|\^)(?<exponent>[+-]?\d+)|-"));
    let value = &markdown::held(&plain(value));
    let (mut html, mut done) = (String::new(), 0);
    for found in NOTABLE.captures_iter(value) {
        let whole = found.get_match();
        let mantissa = found.name("mantissa").map(|mantissa| inert(mantissa.as_str()));
        let exponent = found.name("exponent").map(|digits| digits.as_str().parse::<i32>());
        let sup = |exponent: i32| format!("<sup>{exponent}</sup>").replace('-', "−");
        let set = match (mantissa, exponent) {
            (Some(mantissa), Some(Ok(0))) => mantissa,
            (Some(mantissa), Some(Ok(n))) => format!("{mantissa}\u{a0}×\u{a0}10{}", sup(n)),
            (None, Some(Ok(n))) => sup(n),
            (None, None) if is_sign(value, whole.start()) => "−".to_string(),
            _ => continue,
        };
        html += &inert(&value[done..whole.start()]);
        html += &set;
        done = whole.end();
    }
    html + &inert(&value[done..])
}

/// In a program's notation: `2.01e-4` and `-5.3` for the library's `2.01 × 10⁻⁴` and `−5.3`.
fn plain(value: &str) -> String {
    static TYPESET: Pattern =
        Pattern::new(|| pattern(r"(?:(?<times>\s*×\s*10)|10)?(?<power>⁻?[⁰¹²³⁴-⁹]+)|−"));
    let typed = TYPESET.replace_all(value, |found: &Captures<'_>| match found.name("power") {
        None => "-".to_string(),
        Some(power) => {
            let digits: String = power.as_str().chars().map(ascii).collect();
            let before = match (found.name("times"), found[0].starts_with("10")) {
                (Some(_), _) => "e",
                (None, true) => "10^",
                (None, false) => "^",
            };
            format!("{before}{digits}")
        }
    });
    typed.into_owned()
}

/// `-` for `⁻`, `4` for `⁴`.
fn ascii(superscript: char) -> char {
    const DIGITS: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹";
    match DIGITS.chars().position(|digit| digit == superscript) {
        Some(digit) => char::from(b"0123456789"[digit]),
        None => '-',
    }
}

/// Whether the hyphen at `at` is the sign of a number.
fn is_sign(value: &str, at: usize) -> bool {
    let before = value[..at].chars().next_back();
    let after = value[at + 1..].chars().next();
    !before.is_some_and(|c| c.is_alphanumeric() || c == '.')
        && after.is_some_and(|c| c.is_ascii_digit())
}

#[cfg(test)]
pub(super) mod tests {
    use rstest::rstest;

    use super::*;

    /// What a browser makes of references, but those such as `&lt;`.
    pub fn shown(inert: &str) -> String {
        let mut parts = inert.split("&#");
        let mut shown = parts.next().unwrap().to_string();
        for part in parts {
            let (code, rest) = part.split_once(';').unwrap();
            shown.push(char::from_u32(code.parse().unwrap()).unwrap());
            shown.push_str(rest);
        }
        shown
    }

    /// Catches: a subscript read as emphasis, a norm as a cell's end, primes as curly quotes; a
    /// `&lt;` escaped twice, which shows as `&lt;` on the page.
    #[test]
    fn no_active_character_is_left_in_text() {
        assert_eq!(inert("a_1*|b|'"), "a&#95;1&#42;&#124;b&#124;&#39;");
        assert_eq!(inert_html("<b>a_1 &lt; b</b>"), "<b>a&#95;1 &lt; b</b>");
    }

    /// Catches: pages that differ from run to run.
    #[test]
    fn attributes_are_in_order() {
        assert_eq!(inert_html("<mo stretchy=\"false\" form='a > b' lspace=\"0\">"), {
            "<mo form='a > b' lspace=\"0\" stretchy=\"false\">"
        });
        assert_eq!(inert_html("<path d=\"M1 2\" a=\"|\"/>"), "<path a=\"&#124;\" d=\"M1 2\"/>");
    }

    const PENDULUM: &str = r"\ddot\theta + \frac{g}{L}\sin\theta = 0";

    /// Catches: a root sign that covers its argument.
    #[test]
    fn roots_need_their_braces() {
        let maths = Maths::default();
        assert!(maths.set(r"2\sqrt2", false).unwrap_err().to_string().contains("braces"));
        let html = maths.set(r"2\sqrt{2} + \sqrt[3]{x}", false).unwrap();
        assert!(html.contains("padding-left") || html.contains("padding&#45;left"), "{html}");
    }

    /// Catches: formulas that a telephone shows one of, because no line may end between them; one
    /// torn apart within a bracket or a table.
    #[test]
    fn formulas_beside_one_another_are_several() {
        let torn =
            r"\left(a \qquad b\right) \begin{aligned} c \qquad \{ \end{aligned} \text{d \qquad}";
        assert_eq!(formulas(torn), [torn]);
        assert_eq!(formulas(r"\{a\}, \qquad b"), [r"\{a\}, ", " b"]);
        let html = Maths::default().set(r"a, \qquad b", true).unwrap();
        let count = |tag: &str| html.matches(&format!("<span class=\"{tag}\">")).count();
        assert_eq!((count("katex-display"), count("katex")), (1, 2), "{html}");
    }

    /// Catches: only one of the two outputs, for the eye or for a screen reader.
    #[test]
    fn there_is_html_and_mathml() {
        let html = Maths::default().set(PENDULUM, false).unwrap();
        assert!(html.contains("katex-html") && html.contains("<math"), "{html}");
    }

    /// Catches: a mantissa of another precision, a lost sign, a padded exponent such as 10⁺⁰²; a
    /// number as the library prints it set differently from the same in a program's notation; 2.01
    /// at the end of a line and its power of ten on the next; a sentence that cannot be broken, and
    /// so runs out of the page; text that is no number split up; a range read as a difference.
    #[rstest]
    #[case("2.01e-4", "2.01~×~10<sup>−4</sup>")]
    #[case("2.010e+02", "2.010~×~10<sup>2</sup>")]
    #[case("-1e-10", "−1~×~10<sup>−10</sup>")]
    #[case("<1e-6 J", "<1~×~10<sup>−6</sup>~J")]
    #[case("2.36e0", "2.36")]
    #[case("2.01 × 10⁻⁴", "2.01~×~10<sup>−4</sup>")]
    #[case("−5.300 × 10¹²", "−5.300~×~10<sup>12</sup>")]
    #[case("10³ m/s²", "10<sup>3</sup>~m/s<sup>2</sup>")]
    #[case("10^3 m/s^2", "10<sup>3</sup>~m/s<sup>2</sup>")]
    #[case("7 of 100 000 steps in 2 s", "7 of 100~000 steps in 2~s")]
    #[case("-5.292", "−5.292")]
    #[case("1,1,2,4", "1,1,2,4")]
    #[case("3-4", "3-4")]
    #[case("0.02% / 9090%", "0.02% / 9090%")]
    #[case("rounding-dependent", "rounding-dependent")]
    fn a_value_is_set_as_it_is_read(#[case] typed: &str, #[case] expected: &str) {
        assert_eq!(shown(&value(typed)).replace('\u{a0}', "~"), expected);
    }
}
