//! Which rungs of a ladder of halved steps say something about the method.

use pendula::order::is_credible;

/// A larger error (rad) is no approximation: the pendulum may be anywhere.
const LARGEST: f64 = 1.0;

/// For each rung whether it counts: whether its error is small enough to be one, and the next one, with half the step,
/// finds it credible. The last has no next one and does not count.
pub fn counts(errors: &[f64], order: u32) -> Vec<bool> {
    let pairs = errors.windows(2);
    let credible = pairs.map(|pair| pair[0] <= LARGEST && is_credible(order, pair[0], pair[1]));
    credible.chain((!errors.is_empty()).then_some(false)).collect()
}

/// Whether no finer rung will count: some have, the last three that have a next one have not, and the error of the last,
/// of so many `steps`, is no larger than their roundings may be.
///
/// A lucky crossing costs two rungs, and where two parts of an error are of opposite sign, and of different order, more.
pub fn is_done(counts: &[bool], error: f64, steps: u64) -> bool {
    let settled = match counts {
        [before @ .., a, b, c, _last] => before.contains(&true) && ![a, b, c].contains(&&true),
        _ => false,
    };
    settled && error <= steps as f64 * f64::EPSILON
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: a step whose error happens to cross zero taken for a good one.
    #[test]
    fn a_lucky_crossing_does_not_count() {
        let errors = [1.6e-2, 4e-3, 1e-6, 2.5e-4, 6.25e-5, 1.6e-5];
        assert_eq!(counts(&errors, 2), [true, true, false, true, true, false]);
    }

    /// Catches: rungs on the floor of rounding, or beyond the reach of the order, counted as the method's; a
    /// last rung trusted without a finer one.
    #[test]
    fn neither_rounding_nor_chaos_counts() {
        let errors = [3.0, 0.5, 3.1e-2, 2e-3, 1.2e-4, 1e-13, 2e-13, 9e-14];
        assert_eq!(counts(&errors, 4), [false, true, true, true, true, false, false, false]);
        assert_eq!(counts(&[f64::NAN, 1e-3, 2e-3], 1), [false; 3]);
        assert_eq!(counts(&[1e-3], 1), [false]);
        assert!(counts(&[], 1).is_empty());
    }

    /// Catches: a ladder left at a lucky crossing, or before its first rung that counts; one climbed for ever.
    #[test]
    fn a_ladder_ends_on_the_floor() {
        let floor = |counts: &[bool]| is_done(counts, 1e-13, 1000);
        assert!(!floor(&[false; 9]));
        assert!(!floor(&[true, false, false, false]));
        assert!(floor(&[true, false, false, false, false]));
        assert!(!is_done(&[true, false, false, false, false], 1e-12, 1000));
    }
}
