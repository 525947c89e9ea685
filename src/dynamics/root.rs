//! The zero of a function between two points.

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
    // b is the latest point and a the other end of the bracket. Even bisection down to zero would
    // take fewer steps.
    for _ in 0..1100 {
        if at_b == 0.0 {
            return Some(b);
        }
        let secant = b - at_b * ((b - a) / (at_b - at_a));
        let inside = secant > a.min(b) && secant < a.max(b);
        let next = if inside { secant } else { 0.5 * (a + b) };
        let value = f(next)?;
        if value.is_nan() {
            return None;
        }
        if (value > 0.0) == (at_b > 0.0) {
            // The same end has stayed twice: halve its value, so that it moves.
            at_a *= 0.5;
        } else {
            (a, at_a) = (b, at_b);
        }
        let narrow = (next - b).abs() <= f64::EPSILON * next.abs();
        (b, at_b) = (next, value);
        if narrow {
            break;
        }
    }
    Some(b)
}
