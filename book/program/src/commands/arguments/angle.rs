//! Angles on the command line: radians, multiples of π, degrees.
//!
//! `1.5`, `pi/3`, `-2pi/3`, `0.5pi`, `60deg`. π/3 is no number of f64, and neither is 60 degrees:
//! what is meant is the f64 nearest to the real angle, and it is found in double-double, since π as
//! an f64 divided by three is not always that number.

use pendula::arithmetic::double_double::DoubleDouble;

use super::number::Sweep;

/// What an angle may be.
const ALLOWED: &str =
    "it must be an angle: radians as 1.5, multiples of π as -2pi/3 or 0.5pi, degrees as 60deg";

/// An angle (rad). Whether it may be infinite is for the library to say.
pub fn angle(text: &str) -> Result<f64, &'static str> {
    read(text).ok_or(ALLOWED)
}

/// An angle, or a range of them.
pub fn angles(text: &str) -> Result<Sweep, String> {
    Sweep::of(text, ALLOWED, read)
}

fn read(text: &str) -> Option<f64> {
    text.parse().ok().or_else(|| multiple_of_pi(text))
}

/// `2pi/3` or `60deg`: the f64 nearest to the real angle, unless its first 53 bits and the next 45
/// or so are a tie.
fn multiple_of_pi(text: &str) -> Option<f64> {
    let text = text.trim().to_lowercase();
    let (sign, text) = match text.strip_prefix('-') {
        Some(rest) => (-1.0, rest),
        None => (1.0, text.strip_prefix('+').unwrap_or(&text)),
    };
    let (factor, divisor) = match text.strip_suffix("deg").or_else(|| text.strip_suffix('°')) {
        Some(degrees) => (decimal(degrees.trim_end())?, exactly(180)),
        None => {
            let (factor, rest) = text.split_once("pi").or_else(|| text.split_once('π'))?;
            let factor = factor.trim_end().strip_suffix('*').unwrap_or(factor).trim_end();
            let factor = if factor.is_empty() { DoubleDouble::ONE } else { decimal(factor)? };
            match rest {
                "" => (factor, DoubleDouble::ONE),
                rest => (factor, decimal(rest.strip_prefix('/')?)?),
            }
        }
    };
    let pi = DoubleDouble::HALF_PI.scaled(2.0);
    (divisor != DoubleDouble::ZERO).then(|| sign * (pi * factor / divisor).rounded())
}

/// A decimal number without sign, of up to 19 digits, to 100 bits or more.
fn decimal(text: &str) -> Option<DoubleDouble> {
    let (digits, exponent) = match text.split_once('e') {
        Some((digits, exponent)) => (digits, exponent.parse::<i32>().ok()?),
        None => (text, 0),
    };
    let (whole, part) = digits.split_once('.').unwrap_or((digits, ""));
    let all = format!("{whole}{part}");
    if !all.bytes().all(|byte| byte.is_ascii_digit()) {
        return None;
    }
    let power = exponent.checked_sub(i32::try_from(part.len()).ok()?)?;
    let ten = exactly(10_u64.checked_pow(power.unsigned_abs())?);
    let number = exactly(all.parse().ok()?);
    Some(if power < 0 { number / ten } else { number * ten })
}

fn exactly(whole: u64) -> DoubleDouble {
    let nearest = whole as f64;
    let rest = i128::from(whole) - nearest as i128;
    DoubleDouble::new(nearest) + DoubleDouble::new(rest as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The nearest f64 by π to 120 digits, from Machin's formula in integers of Python; π as an f64
    /// gives another for each of the first, in either order of operations.
    ///
    /// Catches: π/3 as the quotient of two f64; degrees turned to radians by a factor that is
    /// rounded; a quotient cut off instead of rounded, or rounded from its first 64 bits; a sign, a
    /// factor or a divisor that is lost.
    #[test]
    fn an_angle_is_the_nearest_f64() {
        for (text, bits) in [
            ("pi/3", 0x3ff0_c152_382d_7366),
            ("60deg", 0x3ff0_c152_382d_7366),
            ("2pi/3", 0x4000_c152_382d_7366),
            ("pi/6", 0x3fe0_c152_382d_7366),
            ("11pi/12", 0x4007_09d1_0d3e_7eac),
            ("59deg", 0x3ff0_79d5_1da4_28f1),
            ("61deg", 0x3ff1_08cf_52b6_bdda),
            ("65°", 0x3ff2_26c3_bcdb_e7ae),
            ("1e0 deg", 0x3f91_df46_a252_9d39),
            ("5*PI/6", 0x4004_f1a6_c638_d03f),
            ("0.5pi", std::f64::consts::FRAC_PI_2.to_bits()),
            ("π/2.5e-1", (4.0 * std::f64::consts::PI).to_bits()),
            ("180deg", std::f64::consts::PI.to_bits()),
            ("+pi", std::f64::consts::PI.to_bits()),
            ("0pi", 0.0_f64.to_bits()),
            ("1048576pi", (1_048_576.0 * std::f64::consts::PI).to_bits()),
            // Its leading 64 bits alone are a tie.
            ("10767pi", 0x40e0_8430_e634_7d93),
            (
                "9223372036854775808pi",
                (9_223_372_036_854_775_808.0 * std::f64::consts::PI).to_bits(),
            ),
        ] {
            assert_eq!(angle(text).map(f64::to_bits), Ok(bits), "{text}");
            if !text.starts_with('+') {
                let negative = angle(&format!("-{text}"));
                assert_eq!(negative.map(f64::to_bits), Ok(bits | 1 << 63), "-{text}");
            }
        }
        assert_eq!(angles("-pi/3:60deg:3"), "-1.0471975511965979:1.0471975511965979:3".parse());
    }

    /// Catches: nonsense that is taken for a number.
    #[test]
    fn what_is_no_angle_is_refused() {
        for text in [
            "pi/0", "deg", "pi/", "pi/3/4", "2pi3x", "--pi", "six", "", "1e40pi", "pi/-3", "1/3pi",
            "60d", "-pi/x",
        ] {
            assert_eq!(angle(text), Err(ALLOWED), "{text}");
        }
        assert!(angles("inf").is_err() && angles("0:pi:1").is_err() && angles("0:pi").is_err());
    }
}
