//! How the ledger's values are typeset: `2.01e-4` as 2.01 × 10⁻⁴.

use super::{inert, markdown};
use crate::number::plain;
use crate::{Pattern, pattern};

/// A value as HTML: a line may end between its words, but not within a number or before its unit.
pub fn html(value: &str) -> String {
    static NOTABLE: Pattern =
        Pattern::new(|| pattern(r"(?:(?<mantissa>\d+(?:\.\d+)?)[eE]|\^)(?<exponent>[+-]?\d+)|-"));
    let value = &markdown::held(&plain(value));
    let (mut html, mut done) = (String::new(), 0);
    for found in NOTABLE.captures_iter(value) {
        let whole = found.get_match();
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
    use rstest::rstest;

    use super::super::inert::tests::shown;
    use super::*;

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
    fn a_value_is_set_as_it_is_read(#[case] value: &str, #[case] expected: &str) {
        assert_eq!(shown(&html(value)).replace('\u{a0}', "~"), expected);
    }
}
