//! The double nearest to a decimal, for the page.
//!
//! The standard library's reading is faster for numbers of 16 digits and more, but its table of
//! powers is ten kilobytes that cannot be compressed, a tenth of what a reader of the page loads.
//! Both are the nearest double, so both are the same.

/// The double nearest to a number such as −12.5e-3.
pub fn nearest(text: &str) -> Option<f64> {
    if cfg!(target_arch = "wasm32") { by_division(text) } else { text.parse().ok() }
}

/// A decimal between two doubles' middle and them shows it in so many digits.
const MOST_DIGITS: usize = 800;

fn by_division(text: &str) -> Option<f64> {
    let (text, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let mut exponent: i64 = exponent.parse::<i32>().ok()?.into();
    let (sign, text) = match text.strip_prefix('-') {
        Some(rest) => (-1.0, rest),
        None => (1.0, text.strip_prefix('+').unwrap_or(text)),
    };
    let (mut digits, mut after, mut rest) = (Vec::new(), false, false);
    for byte in text.bytes() {
        match byte {
            b'.' if !after => after = true,
            b'0'..=b'9' if digits.len() < MOST_DIGITS => {
                if byte != b'0' || !digits.is_empty() {
                    digits.push(u32::from(byte - b'0'));
                }
                exponent -= i64::from(after);
            }
            b'0'..=b'9' => {
                rest |= byte != b'0';
                exponent += i64::from(!after);
            }
            _ => return None,
        }
    }
    // What comes behind them only says that there is more.
    if rest {
        digits.push(1);
        exponent -= 1;
    }
    let size = digits.len() as i64 + exponent;
    if digits.is_empty() || size < -330 {
        return Some(0.0 * sign);
    }
    if size > 310 {
        return Some(f64::INFINITY * sign);
    }
    let power = exponent.unsigned_abs() as usize;
    if digits.len() <= 15 && power <= 22 {
        // Both are doubles, and the last operation is the only one that rounds.
        let whole = digits.iter().fold(0.0, |sum, &digit| 10.0 * sum + f64::from(digit));
        let power = (0..power).fold(1.0, |power, _| 10.0 * power);
        return Some(sign * if exponent < 0 { whole / power } else { whole * power });
    }
    let mut over = Vec::new();
    digits.iter().for_each(|&digit| times_and(&mut over, 10, digit));
    let mut under = vec![1];
    let scaled = if exponent < 0 { &mut under } else { &mut over };
    (0..power).for_each(|_| times_and(scaled, 10, 0));
    Some(sign * quotient(over, under))
}

/// The double nearest to the quotient of two whole numbers above 0, whose words are the lowest
/// first.
fn quotient(mut over: Vec<u32>, mut under: Vec<u32>) -> f64 {
    // So many halvings make it a number of 64 or 65 bits, of which the last stands for all below.
    let shift = 64 + bits(&under) - bits(&over);
    let scaled = if shift > 0 { &mut over } else { &mut under };
    scaled.splice(0..0, vec![0; shift.unsigned_abs() as usize / 32]);
    times_and(scaled, 1 << (shift.unsigned_abs() % 32), 0);
    let mut whole: u128 = 0;
    under.splice(0..0, [0; 3]);
    for _ in 0..=96 {
        whole <<= 1;
        if !is_less(&over, &under) {
            subtract(&mut over, &under);
            whole |= 1;
        }
        halve(&mut under);
    }
    let rest = over.iter().any(|&word| word != 0);
    let length = 128 - whole.leading_zeros() as i32;
    // A double has 53 bits, and fewer below 2⁻¹⁰²².
    let kept = (length - shift as i32 + 1074).min(53);
    let dropped = length - kept;
    if kept < 0 {
        return 0.0;
    }
    let (mut mantissa, below) = (whole >> dropped, whole & ((1 << dropped) - 1));
    let half = 1 << (dropped - 1);
    if below > half || below == half && (rest || mantissa & 1 == 1) {
        mantissa += 1;
    }
    libm::ldexp(mantissa as f64, dropped - shift as i32)
}

fn bits(number: &[u32]) -> i64 {
    let last = number.iter().rposition(|&word| word != 0).unwrap_or(0);
    32 * (last as i64 + 1) - i64::from(number[last].leading_zeros())
}

fn times_and(number: &mut Vec<u32>, factor: u32, add: u32) {
    let mut carry = u64::from(add);
    for word in number.iter_mut() {
        let product = u64::from(*word) * u64::from(factor) + carry;
        (*word, carry) = (product as u32, product >> 32);
    }
    if carry > 0 {
        number.push(carry as u32);
    }
}

fn is_less(a: &[u32], b: &[u32]) -> bool {
    let word = |number: &[u32], i: usize| number.get(i).copied().unwrap_or(0);
    let differ = (0..a.len().max(b.len())).rev().find(|&i| word(a, i) != word(b, i));
    differ.is_some_and(|i| word(a, i) < word(b, i))
}

/// a − b, which is not less than 0.
fn subtract(a: &mut [u32], b: &[u32]) {
    let mut borrow = 0;
    for (i, word) in a.iter_mut().enumerate() {
        let difference = i64::from(*word) - i64::from(b.get(i).copied().unwrap_or(0)) - borrow;
        (*word, borrow) = (difference as u32, i64::from(difference < 0));
    }
}

fn halve(number: &mut [u32]) {
    let mut carry = 0;
    for word in number.iter_mut().rev() {
        (*word, carry) = (*word >> 1 | carry << 31, *word & 1);
    }
}

#[cfg(test)]
mod tests {
    use super::by_division;

    /// Catches: a last bit that is rounded wrongly, next to the middle between two doubles, below
    /// the least normal one or of few digits; an exponent that is off where digits are left out.
    #[test]
    fn the_nearest_double_is_that_of_the_standard_library() {
        let mut r = fastrand::Rng::with_seed(1);
        let hold = |text: &str| {
            let expected: f64 = text.parse().unwrap();
            let read = by_division(text).unwrap();
            assert_eq!(read.to_bits(), expected.to_bits(), "{text}: {read:e}, not {expected:e}");
        };
        for _ in 0..20_000 {
            let any = f64::from_bits(r.u64(..));
            let near = 4.0 * r.f64() - 2.0;
            let size = r.u32(1..55);
            let tiny = f64::from_bits(r.u64(..1 << size));
            for x in [any, near, tiny].into_iter().filter(|x| x.is_finite()) {
                hold(&format!("{x:e}"));
                hold(&format!("{x:.*e}", r.usize(0..25)));
            }
            hold(&format!("{near}"));
            hold(&format!("{near:.*}", r.usize(0..25)));
            // The middle between two doubles, exactly and a little beside it.
            let middle =
                format!("{:.60}", (1u64 << 53 | r.u64(..1 << 52) | 1) as f64 * 0.5_f64.powi(52));
            let exact = middle.trim_end_matches('0');
            hold(exact);
            hold(&format!("{exact}{}1", "0".repeat(r.usize(0..40))));
        }
        for text in
            ["0", "-0.0", "1e400", "-1e-400", "1e22", "1e23", "123456789012345678", "0.1e-7"]
        {
            hold(text);
        }
        let half = format!("{:.1074}", f64::from_bits(1));
        hold(&half);
        hold(&format!("9007199254740993{}", "0".repeat(280)));
        hold(&format!("9007199254740993.{}1", "0".repeat(900)));
        hold(&format!("{}e-1200", "7".repeat(1100)));
        assert_eq!(by_division("1,5"), None);
    }
}
