//! Numbers in a report, as the book prints them.

use core::fmt;

/// A number in scientific notation with this many digits after the point: 8.0 × 10⁻¹⁵; 0 is 0.
#[derive(Clone, Copy, Debug)]
pub struct Scientific(pub f64, pub usize);

impl fmt::Display for Scientific {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(value, digits) = *self;
        if value == 0.0 || !value.is_finite() {
            return write!(f, "{value:.0}");
        }
        let text = format!("{value:.digits$e}").replace('-', "−");
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        if exponent == "0" {
            return f.write_str(mantissa);
        }
        let raised = |c: char| match c {
            '−' => '⁻',
            digit => DIGITS[digit.to_digit(10).unwrap_or(0) as usize],
        };
        write!(f, "{mantissa} × 10{}", exponent.chars().map(raised).collect::<String>())
    }
}

const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];

/// A whole number as an exponent: ⁴.
pub fn raised(power: usize) -> String {
    power.to_string().chars().map(|c| DIGITS[c.to_digit(10).unwrap_or(0) as usize]).collect()
}

/// With one digit after the point.
pub fn scientific(value: f64) -> Scientific {
    Scientific(value, 1)
}

/// A bound, of which only the size matters.
pub fn about(value: f64) -> Scientific {
    Scientific(value, 0)
}

/// Slopes, with two digits: "2.11, 2.00, −0.03".
pub fn slopes(slopes: &[f64]) -> String {
    // Without the sign of a slope that rounds to zero.
    let text = slopes.iter().map(|slope| format!("{slope:.2}").replace('-', "−"));
    let text = text.map(|text| if text == "−0.00" { "0.00".to_string() } else { text });
    text.collect::<Vec<_>>().join(", ")
}
