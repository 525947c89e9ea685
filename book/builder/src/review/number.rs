//! Numbers as the snapshots print them.

use pendula_study::digits::{Digits, half_unit};

use crate::preprocess::values::plain;

/// A printed number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number {
    /// Its value.
    pub value: f64,
    /// Half a unit in its last printed place.
    pub half_unit: f64,
    /// How many significant digits are printed.
    pub digits: usize,
}

/// The number at the start of a cell such as `1.10271 × 10⁻⁵`, `15 ± 2` or `0.0193 (Table 5)`;
/// `None` if there is none.
pub fn leading(cell: &str) -> Option<Number> {
    let plain = plain(cell);
    let literal = plain.split_whitespace().next()?;
    literal.starts_with(|c: char| c.is_ascii_digit() || c == '-').then(|| parse(literal))?
}

/// A number in a program's notation.
pub fn parse(literal: &str) -> Option<Number> {
    // "nan" and 1e999 are numbers to Rust.
    let value = literal.parse().ok().filter(|value: &f64| value.is_finite())?;
    let (mantissa, _) = literal.split_once('e').unwrap_or((literal, ""));
    let digits = mantissa.trim_start_matches(['-', '0', '.']);
    let digits = digits.chars().filter(char::is_ascii_digit).count();
    Some(Number { value, half_unit: half_unit(literal)?, digits })
}

/// The relative change from `old` to `new`; `None` from zero, and where there is none.
pub fn change(old: f64, new: f64) -> Option<f64> {
    let change = (new - old) / old.abs();
    (change.is_finite() && change != 0.0).then_some(change)
}

/// A relative change as text: a factor from a doubling on, per cent, or parts per million.
pub fn change_text(change: f64) -> String {
    let signed = |value: f64, unit: &str| {
        let decimals = match value.abs() {
            size if size >= 100.0 => 0,
            size if size >= 10.0 => 1,
            _ => 2,
        };
        format!("{value:+.decimals$} {unit}").replace('-', "−")
    };
    match change.abs() {
        size if size >= 1.0 => format!("× {}", Digits::Significant(3).print(1.0 + change)),
        size if size >= 1e-4 => signed(100.0 * change, "%"),
        _ => signed(1e6 * change, "ppm"),
    }
}

#[cfg(test)]
mod tests {
    use rstest::rstest;

    use super::*;

    /// Catches: an exponent or a sign that is lost, a remark that is read as part of the number, a
    /// word taken for a number.
    #[rstest]
    #[case("1.10271 × 10⁻⁵", Some((1.10271e-5, 0.5e-10, 6)))]
    #[case("−5.300366", Some((-5.300366, 0.5e-6, 7)))]
    #[case("0.0193 (Table 5)", Some((0.0193, 0.5e-4, 3)))]
    #[case("15 ± 2", Some((15.0, 0.5, 2)))]
    #[case("—", None)]
    #[case("< 200", None)]
    #[case("infinite", None)]
    #[case("nan", None)]
    #[case("−nan", None)]
    #[case("1e999", None)]
    #[case("", None)]
    fn the_leading_number_is_read(#[case] cell: &str, #[case] expected: Option<(f64, f64, usize)>) {
        let number = leading(cell).map(|n| (n.value, n.half_unit, n.digits));
        assert_eq!(number, expected);
    }

    /// Catches: a change in the wrong unit, without a sign, or taken from the new value.
    #[rstest]
    #[case(1.0, 1.0132, "+1.32 %")]
    #[case(-2.0, -1.0, "+50.0 %")]
    #[case(1.0, 1.00002, "+20.0 ppm")]
    #[case(1.0, 0.5, "−50.0 %")]
    #[case(1.0, 12.0, "× 12.0")]
    #[case(1.0, 1.2e7, "× 1.20 × 10⁷")]
    fn a_change_has_its_unit(#[case] old: f64, #[case] new: f64, #[case] text: &str) {
        assert_eq!(change_text(change(old, new).unwrap()), text);
    }

    /// Catches: an infinite change.
    #[test]
    fn from_zero_there_is_no_relative_change() {
        assert_eq!(change(0.0, 1.0), None);
        assert_eq!(change(2.0, 2.0), None);
    }
}
