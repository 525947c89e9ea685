//! The zero of a function between two points.

/// Secant steps before bisection takes over: more than any function needs that is nearly linear
/// near its zero.
const SECANTS: u32 = 200;

/// The zero of `f` between `low` and `high`, at which its signs differ, by the secant method kept
/// inside the bracket (the Illinois rule: Dahlquist, Björck, *Numerical Methods* (1974), Ch. 6), to
/// the precision of f64.
///
/// `f` is evaluated at `low` first, then at `high`, then between. `None` if one of these values is
/// `None` or NaN, or if the signs at both ends are the same. A zero at `low` is returned whatever
/// the value at `high`, unless that is `None`.
pub fn root(mut f: impl FnMut(f64) -> Option<f64>, low: f64, high: f64) -> Option<f64> {
    let (mut a, mut b) = (low, high);
    let (mut at_a, mut at_b) = (f(a)?, f(b)?);
    if at_a == 0.0 {
        return Some(a);
    }
    // A NaN satisfies neither.
    if !(at_a < 0.0 && at_b >= 0.0 || at_a > 0.0 && at_b <= 0.0) {
        return None;
    }
    let mut number = |x| f(x).filter(|value| !value.is_nan());
    // b is the latest point and a the other end of the bracket.
    for _ in 0..SECANTS {
        if at_b == 0.0 {
            return Some(b);
        }
        let secant = b - at_b * ((b - a) / (at_b - at_a));
        let inside = secant > a.min(b) && secant < a.max(b);
        let next = if inside { secant } else { a.midpoint(b) };
        let value = number(next)?;
        if (value > 0.0) == (at_b > 0.0) {
            // The same end has stayed twice: halve its value, so that it moves.
            at_a *= 0.5;
        } else {
            (a, at_a) = (b, at_b);
        }
        let narrow = (next - b).abs() <= f64::EPSILON * next.abs();
        (b, at_b) = (next, value);
        if narrow {
            // In a bracket of many decades a secant may only have fallen short: then the sign does
            // not change beside it.
            let beside = b + (2.0 * f64::EPSILON * b.abs()).copysign(a - b);
            let changes =
                (a - b).abs() <= (beside - b).abs() || (number(beside)? > 0.0) != (at_b > 0.0);
            if changes || at_b == 0.0 {
                return Some(b);
            }
            break;
        }
    }
    bisect(number, a, b, at_b)
}

/// The zero between `a` and `b`, where the function is `at_b`, by bisection of the f64s between
/// them, not of their distance: 64 steps, however many decades there are.
fn bisect(mut f: impl FnMut(f64) -> Option<f64>, a: f64, mut b: f64, at_b: f64) -> Option<f64> {
    let (mut from, mut to) = (rank(a), rank(b));
    loop {
        let middle = i64::midpoint(from, to);
        // Rounded towards zero: it may be either end.
        if middle == from || middle == to {
            return Some(b);
        }
        let value = f(at_rank(middle))?;
        if value == 0.0 {
            return Some(at_rank(middle));
        }
        if (value > 0.0) == (at_b > 0.0) {
            (to, b) = (middle, at_rank(middle));
        } else {
            from = middle;
        }
    }
}

/// The place of `x` in the order of all f64s, zero at zero.
const fn rank(x: f64) -> i64 {
    let bits = x.to_bits().cast_signed();
    if bits < 0 { i64::MIN - bits } else { bits }
}

/// The f64 of that rank.
const fn at_rank(rank: i64) -> f64 {
    f64::from_bits((if rank < 0 { i64::MIN - rank } else { rank }).cast_unsigned())
}
