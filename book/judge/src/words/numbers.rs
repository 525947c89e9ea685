//! How numbers are written.

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

/// A number that is known to `known_to`, as short as that allows.
pub fn short(value: f64, known_to: f64) -> String {
    let value = crate::judge::equation::short(value, known_to);
    let size = value.abs();
    if size != 0.0 && !(1e-4..1e6).contains(&size) {
        return Scientific(value, 1).to_string();
    }
    // Six digits are more than a reader compares.
    let digits = (5.0 - libm::floor(libm::log10(size.max(1e-9)))).clamp(0.0, 12.0) as usize;
    plain(value, digits)
}

/// A number with so many decimals, without zeros at its end.
pub fn plain(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    let text =
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    text.replace('-', "−")
}

/// Two numbers that are not the same, each as short as its uncertainty allows, with as many more
/// digits as it takes to see that they differ.
pub fn differing(a: f64, b: f64, known_to: f64) -> [String; 2] {
    let both = [a, b].map(|x| short(x, known_to));
    if both[0] != both[1] {
        return both;
    }
    let more = (0..=17).map(|digits| [a, b].map(|x| plain(x, digits)));
    more.into_iter().find(|[a, b]| a != b).unwrap_or(both)
}
