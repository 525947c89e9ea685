//! Numbers as the study prints them, read.

use regex::Captures;

use crate::book::{Pattern, pattern};

/// A printed number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number {
    /// Its value.
    pub value: f64,
    /// How many significant digits are printed.
    pub digits: usize,
}

/// The number at the start of a cell such as `1.10271 × 10⁻⁵`, `15 ± 2` or `0.0193 (Table 5)`;
/// `None` if there is none.
pub fn leading(cell: &str) -> Option<Number> {
    let plain = plain(cell);
    let literal = plain.split_whitespace().next()?;
    let is_number = literal.starts_with(|c: char| c.is_ascii_digit() || c == '-');
    // "-nan" and 1e999 are numbers to Rust.
    let value = literal.parse().ok().filter(|value: &f64| is_number && value.is_finite())?;
    let (mantissa, _) = literal.split_once('e').unwrap_or((literal, ""));
    let digits = mantissa.trim_start_matches(['-', '0', '.']);
    let digits = digits.chars().filter(char::is_ascii_digit).count();
    Some(Number { value, digits })
}

/// In a program's notation: `2.01e-4` and `-5.3` for the library's `2.01 × 10⁻⁴` and `−5.3`.
pub fn plain(value: &str) -> String {
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

#[cfg(test)]
mod tests {
    use rstest::rstest;

    use super::*;

    /// Catches: an exponent or a sign that is lost, a remark that is read as part of the number, a
    /// word taken for a number.
    #[rstest]
    #[case("1.10271 × 10⁻⁵", Some((1.10271e-5, 6)))]
    #[case("−5.300366", Some((-5.300366, 7)))]
    #[case("6 × 10⁻⁸⁹", Some((6e-89, 1)))]
    #[case("0.0193 (Table 5)", Some((0.0193, 3)))]
    #[case("15 ± 2", Some((15.0, 2)))]
    #[case("—", None)]
    #[case("< 200", None)]
    #[case("infinite", None)]
    #[case("nan", None)]
    #[case("−nan", None)]
    #[case("1e999", None)]
    #[case("", None)]
    fn the_leading_number_is_read(#[case] cell: &str, #[case] expected: Option<(f64, usize)>) {
        let number = leading(cell).map(|n| (n.value, n.digits));
        assert_eq!(number, expected);
    }
}
