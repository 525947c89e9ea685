//! Numbers as the paper prints them and as we do: fixed significant digits, true minus signs, powers of ten.

/// How a number is printed: only as many digits as can be defended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// This many significant digits and a power of ten: 2.01 × 10².
    Scientific(usize),
    /// This many digits after the point: −5.300.
    Fixed(usize),
    /// This many significant digits, with a power of ten only where the plain number would be hard to read.
    Significant(usize),
}

impl Format {
    /// The format in which the literal was printed: `2.01e2` is scientific with three digits, `-5.300` fixed with
    /// three decimals. `None` for what is no number.
    pub fn of(literal: &str) -> Option<Self> {
        literal.parse::<f64>().ok()?;
        let decimals = |digits: &str| digits.split_once('.').map_or(0, |(_, after)| after.len());
        Some(match literal.split_once('e') {
            Some((mantissa, _)) => Self::Scientific(decimals(mantissa) + 1),
            None => Self::Fixed(decimals(literal)),
        })
    }

    /// `value` as text, rounded to nearest.
    pub fn print(self, value: f64) -> String {
        match self {
            Self::Scientific(digits) => {
                let text = format!("{value:.*e}", digits - 1);
                match text.split_once('e') {
                    Some((mantissa, exponent)) => {
                        format!("{} × 10{}", minus(mantissa), superscript(exponent))
                    }
                    None => minus(&text),
                }
            }
            Self::Fixed(decimals) => minus(&format!("{value:.decimals$}")),
            Self::Significant(digits) => {
                // The exponent after rounding: 9.9996 to four digits is 10.00.
                let rounded = format!("{value:.*e}", digits - 1);
                let exponent = rounded.split_once('e').and_then(|(_, e)| e.parse::<i32>().ok());
                match exponent {
                    Some(exponent @ -4..=5) if exponent < digits as i32 => {
                        Self::Fixed((digits as i32 - 1 - exponent) as usize).print(value)
                    }
                    _ => Self::Scientific(digits).print(value),
                }
            }
        }
    }
}

/// Half a unit in the last printed place of `literal`: a number that rounds to it is no further away.
pub fn half_unit(literal: &str) -> Option<f64> {
    let (mantissa, exponent) = literal.split_once('e').unwrap_or((literal, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, after)| after.len());
    let place = exponent.parse::<i32>().ok()? - i32::try_from(decimals).ok()?;
    format!("0.5e{place}").parse().ok()
}

fn minus(text: &str) -> String {
    text.replace('-', "−")
}

fn superscript(exponent: &str) -> String {
    exponent
        .chars()
        .map(|c| match c {
            '-' => '⁻',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            '0' | '4'..='9' => char::from_u32('⁰' as u32 + c as u32 - '0' as u32).unwrap_or(c),
            other => other,
        })
        .collect()
}
