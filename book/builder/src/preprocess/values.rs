//! How the ledger's values are typeset: `2.01e-4` as 2.01 × 10⁻⁴.

use std::sync::LazyLock;

use regex::Regex;

use super::{inert, markdown};
use crate::number::plain;

/// A value as HTML: a line may end between its words, but not within a number or before its unit.
pub fn html(value: &str) -> String {
    static NOTABLE: LazyLock<Regex> = LazyLock::new(|| {
        Regex::new(r"(?:(?<mantissa>\d+(?:\.\d+)?)[eE]|\^)(?<exponent>[+-]?\d+)|-")
            .expect("the pattern is a constant")
    });
    let value = &markdown::held(&plain(value));
    let (mut html, mut done) = (String::new(), 0);
    for found in NOTABLE.captures_iter(value) {
        let whole = found.get(0).expect("group 0 is the match");
        let mantissa = found.name("mantissa").map(|mantissa| inert::text(mantissa.as_str()));
        let exponent = found.name("exponent").map(|digits| digits.as_str().parse::<i32>());
        let sup = |exponent: i32| format!("<sup>{exponent}</sup>").replace('-', "−");
        let set = match (mantissa, exponent) {
            (Some(mantissa), Some(Ok(0))) => mantissa,
            (Some(mantissa), Some(Ok(n))) => format!("{mantissa}\u{a0}×\u{a0}10{}", sup(n)),
            (None, Some(Ok(n))) => sup(n),
            (None, None) if is_sign(value, whole.start()) => "−".to_string(),
            _ => continue,
        };
        html += &inert::text(&value[done..whole.start()]);
        html += &set;
        done = whole.end();
    }
    html + &inert::text(&value[done..])
}

/// Whether the hyphen at `at` is the sign of a number.
fn is_sign(value: &str, at: usize) -> bool {
    let before = value[..at].chars().next_back();
    let after = value[at + 1..].chars().next();
    !before.is_some_and(|c| c.is_alphanumeric() || c == '.')
        && after.is_some_and(|c| c.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a browser shows: character references resolved, and no-break spaces as spaces.
    fn shown(value: &str) -> String {
        let html = html(value).replace('\u{a0}', " ");
        let mut parts = html.split("&#");
        let mut shown = parts.next().unwrap().to_string();
        for part in parts {
            let (code, rest) = part.split_once(';').unwrap();
            shown.push(char::from_u32(code.parse().unwrap()).unwrap());
            shown.push_str(rest);
        }
        shown
    }

    /// Catches: a mantissa of another precision, a lost sign, a padded exponent such as 10⁺⁰².
    #[test]
    fn powers_of_ten_are_set_as_such() {
        assert_eq!(shown("2.01e-4"), "2.01 × 10<sup>−4</sup>");
        assert_eq!(shown("2.010e+02"), "2.010 × 10<sup>2</sup>");
        assert_eq!(shown("-1e-10"), "−1 × 10<sup>−10</sup>");
        assert_eq!(shown("<1e-6 J"), "<1 × 10<sup>−6</sup> J");
        assert_eq!(shown("2.36e0"), "2.36");
    }

    /// Catches: a number as the library prints it typeset differently from the same number in a
    /// program's notation.
    #[test]
    fn what_is_typeset_already_is_set_the_same() {
        assert_eq!(html("2.01 × 10⁻⁴"), html("2.01e-4"));
        assert_eq!(html("−5.300 × 10¹²"), html("-5.300e12"));
        assert_eq!(html("10³ m/s²"), html("10^3 m/s^2"));
    }

    /// Catches: 2.01 at the end of a line and its power of ten on the next; a sentence that cannot
    /// be broken, and so runs out of the page.
    #[test]
    fn a_line_ends_between_words_only() {
        assert_eq!(html("2e-4 J"), "2\u{a0}×\u{a0}10<sup>−4</sup>\u{a0}J");
        assert_eq!(html("7 of 100 000 steps in 2 s"), "7 of 100\u{a0}000 steps in 2\u{a0}s");
    }

    /// Catches: text that is not a number split up; a range read as a difference.
    #[test]
    fn other_values_stay_as_they_are() {
        for value in ["5.158 s", "1,1,2,4", "3-4", "0.02% / 9090%", "Yes", "rounding-dependent"] {
            assert_eq!(shown(value), value);
        }
        assert_eq!(shown("-5.292"), "−5.292");
        assert_eq!(shown("9.81 m/s^2"), "9.81 m/s<sup>2</sup>");
    }
}
