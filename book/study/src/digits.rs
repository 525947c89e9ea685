//! Numbers as the paper prints them and as we do: fixed significant digits, true minus signs,
//! powers of ten.

/// How a number is printed: only as many digits as can be defended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Digits {
    /// This many significant digits and a power of ten: 2.01 × 10².
    Scientific(usize),
    /// This many digits after the point: −5.300.
    Fixed(usize),
    /// This many significant digits, with a power of ten only where the plain number would be hard
    /// to read.
    Significant(usize),
}

impl Digits {
    /// The format in which the literal was printed: `2.01e2` is scientific with three digits,
    /// `-5.300` fixed with three decimals. `None` if it does not parse as a number.
    pub fn of(literal: &str) -> Option<Self> {
        literal.parse::<f64>().ok()?;
        let decimals = |digits: &str| digits.split_once('.').map_or(0, |(_, after)| after.len());
        Some(match literal.split_once('e') {
            Some((mantissa, _)) => Self::Scientific(decimals(mantissa) + 1),
            None => Self::Fixed(decimals(literal)),
        })
    }

    /// `value` as text, rounded to nearest and typeset.
    pub fn print(self, value: f64) -> String {
        typeset(&self.literal(value))
    }

    /// `value` as a program writes it, rounded to nearest: `-5.300`, `2.01e2`.
    pub fn literal(self, value: f64) -> String {
        match self {
            Self::Scientific(digits) => format!("{value:.*e}", digits - 1),
            Self::Fixed(decimals) => format!("{value:.decimals$}"),
            Self::Significant(digits) => {
                // The exponent after rounding: 9.9996 to four digits is 10.00.
                let rounded = format!("{value:.*e}", digits - 1);
                let exponent = rounded.split_once('e').and_then(|(_, e)| e.parse::<i32>().ok());
                match exponent {
                    Some(exponent @ -4..=5) if exponent < digits as i32 => {
                        Self::Fixed((digits as i32 - 1 - exponent) as usize).literal(value)
                    }
                    _ => rounded,
                }
            }
        }
    }
}

/// A literal as the book prints it, with a true minus sign and a power of ten: 2.01 × 10².
pub fn typeset(literal: &str) -> String {
    match literal.split_once('e') {
        Some((mantissa, exponent)) => format!("{} × 10{}", minus(mantissa), superscript(exponent)),
        None => minus(literal),
    }
}

/// Whether `value` lies within half a unit in the last place of what is `printed`; `None` if that
/// does not parse as a number.
pub fn rounds_to(value: f64, printed: &str) -> Option<bool> {
    let (stated, half) = (printed.parse::<f64>().ok()?, half_unit(printed)?);
    Some((value - stated).abs() <= half)
}

/// Half a unit in the last printed place of `literal`; `None` if its exponent is no number.
fn half_unit(literal: &str) -> Option<f64> {
    let (mantissa, exponent) = literal.split_once('e').unwrap_or((literal, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, after)| after.len());
    let place = exponent.parse::<i32>().ok()?.checked_sub(i32::try_from(decimals).ok()?)?;
    format!("0.5e{place}").parse().ok()
}

fn minus(text: &str) -> String {
    text.replace('-', "−")
}

fn superscript(exponent: &str) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let raised = |c: char| c.to_digit(10).map_or('⁻', |digit| RAISED[digit as usize]);
    exponent.chars().map(raised).collect()
}

#[cfg(test)]
mod tests {
    use rstest::rstest;

    use super::Digits::{self, Fixed, Scientific, Significant};
    use super::{half_unit, rounds_to};

    /// Catches: a digit too many or too few, a plain number that claims digits it does not have,
    /// and an exponent taken before the rounding that changes it.
    #[rstest]
    #[case(Scientific(3), 200.96, "2.01 × 10²")]
    #[case(Scientific(1), -4.5678e-13, "−5 × 10⁻¹³")]
    #[case(Scientific(2), 1.04e9, "1.0 × 10⁹")]
    #[case(Fixed(3), -5.3, "−5.300")]
    #[case(Fixed(0), 9090.4, "9090")]
    #[case(Significant(4), 123.45, "123.5")]
    #[case::no_place_is_left(Significant(3), 123.4, "123")]
    #[case::one_place_too_many(Significant(3), 1234.0, "1.23 × 10³")]
    #[case::two_places_too_many(Significant(3), 12345.0, "1.23 × 10⁴")]
    #[case::rounded_up_to_the_next_power(Significant(4), 9.9996, "10.00")]
    #[case::rounded_up_out_of_its_digits(Significant(3), 999.6, "1.00 × 10³")]
    #[case::the_least_plain(Significant(3), 1e-4, "0.000100")]
    #[case::less(Significant(3), 9.99e-5, "9.99 × 10⁻⁵")]
    #[case::the_largest_plain(Significant(7), 999_999.0, "999999.0")]
    #[case::more(Significant(7), 1e6, "1.000000 × 10⁶")]
    #[case::no_number(Significant(3), f64::INFINITY, "inf")]
    fn a_number_prints_the_digits_asked_for(
        #[case] format: Digits,
        #[case] value: f64,
        #[case] text: &str,
    ) {
        assert_eq!(format.print(value), text);
    }

    /// Catches: a decimal of the mantissa that is not counted, an exponent that is, and words that
    /// pass for a number.
    #[rstest]
    #[case("2.01e2", Some(Scientific(3)), Some(0.5))]
    #[case("1e-4", Some(Scientific(1)), Some(0.5e-4))]
    #[case("-5.300", Some(Fixed(3)), Some(0.5e-3))]
    #[case("9090", Some(Fixed(0)), Some(0.5))]
    #[case("one", None, None)]
    fn a_literal_tells_its_format_and_its_unit(
        #[case] literal: &str,
        #[case] format: Option<Digits>,
        #[case] half: Option<f64>,
    ) {
        assert_eq!(Digits::of(literal), format);
        assert_eq!(half_unit(literal), half);
    }

    /// Half a unit is a binary fraction except in 0.919, so that the bound itself and its
    /// neighbour can be tested.
    ///
    /// Catches: a bound a little too narrow or too wide, and one that has only one side.
    #[rstest]
    #[case("7", 7.0, true)]
    #[case("7", 7.5, true)]
    #[case("7", 6.5, true)]
    #[case("7", 7.5_f64.next_up(), false)]
    #[case("7", 6.5_f64.next_down(), false)]
    #[case("2.0e1", 20.5, true)]
    #[case("2.0e1", 20.5_f64.next_up(), false)]
    #[case("-7", -7.5, true)]
    #[case("-7", 7.0, false)]
    #[case("0.919", 0.9194, true)]
    #[case("0.919", 0.9196, false)]
    #[case("7", f64::NAN, false)]
    fn what_rounds_to_a_literal_is_half_a_unit_away_at_most(
        #[case] printed: &str,
        #[case] value: f64,
        #[case] rounds: bool,
    ) {
        assert_eq!(rounds_to(value, printed), Some(rounds));
    }

    /// Catches: a comparison with words that returns true or false.
    #[test]
    fn nothing_rounds_to_words() {
        assert_eq!(rounds_to(7.0, "seven"), None);
    }
}
