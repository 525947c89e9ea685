//! Which rungs of a ladder of halved steps count for the method.

use pendula::metrics::order::{is_asymptotic, is_floor};

/// With a larger error (rad) the result is no approximation.
const LARGEST: f64 = 1.0;

/// The measurements of a rung.
#[derive(Clone, Copy, Debug)]
pub struct Rung {
    /// The error (rad).
    pub error: f64,
    /// How much of it may be rounding (rad).
    pub rounding: f64,
    /// The time of a run (s).
    pub seconds: f64,
}

/// For each rung whether it counts: its error must be at most `LARGEST` and agree with that of the
/// next rung, with half the step. The last rung has no next one and does not count; nor do those
/// after the first on the rounding floor.
pub fn counts(rungs: &[Rung], order: u32) -> Vec<bool> {
    let mut ended = false;
    let pairs = rungs.windows(2).map(|pair| {
        let [rung, finer] = [pair[0], pair[1]];
        let credible = is_asymptotic(order, rung.error, finer.error, finer.rounding);
        let counts = !ended && rung.error <= LARGEST && credible;
        ended |= counts && is_floor(rung.error, rung.rounding, finer.error);
        counts
    });
    let mut counts: Vec<bool> = pairs.collect();
    counts.extend((!rungs.is_empty()).then_some(false));
    counts
}

/// Whether no finer rung will count: a rung on the floor counts already, or there are three on it
/// that happen not to count.
pub fn is_done(rungs: &[Rung], order: u32) -> bool {
    let pairs = rungs.windows(2).zip(counts(rungs, order));
    let on_the_floor: Vec<bool> = pairs
        .filter(|(pair, _)| is_floor(pair[0].error, pair[0].rounding, pair[1].error))
        .map(|(_, counts)| counts)
        .collect();
    on_the_floor.len() >= 3 || on_the_floor.contains(&true)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rungs of a second each, in which rounding may be up to 2e-13.
    fn rungs(errors: &[f64]) -> Vec<Rung> {
        errors.iter().map(|error| Rung { error: *error, rounding: 2e-13, seconds: 1.0 }).collect()
    }

    /// Catches: a step whose error happens to cross zero taken for a good step.
    #[test]
    fn a_lucky_crossing_does_not_count() {
        let errors = [1.6e-2, 4e-3, 1e-6, 2.5e-4, 6.25e-5, 1.6e-5];
        assert_eq!(counts(&rungs(&errors), 2), [true, true, false, true, true, false]);
    }

    /// Catches: rungs counted as the method's after the first that is on the floor of rounding, or
    /// before its order holds; a last rung trusted without a finer one.
    #[test]
    fn neither_rounding_nor_chaos_counts() {
        let errors = [3.0, 0.5, 3.1e-2, 2e-3, 1.2e-4, 1e-13, 2e-13, 9e-14];
        let expected = [false, true, true, true, true, true, false, false];
        assert_eq!(counts(&rungs(&errors), 4), expected);
        assert_eq!(counts(&rungs(&[f64::NAN, 1e-3, 2e-3]), 1), [false; 3]);
        assert_eq!(counts(&rungs(&[1e-3]), 1), [false]);
        assert!(counts(&[], 1).is_empty());
    }

    /// Catches: a method of high order that reaches the floor in one halving, and gets no rung for
    /// it.
    #[test]
    fn a_high_order_has_its_rungs() {
        assert_eq!(counts(&rungs(&[2e-4, 3e-9, 1e-13, 9e-14]), 24), [false, true, true, false]);
    }

    /// Catches: a ladder ended at a zero crossing of the error, or before its first rung that
    /// counts; one that never ends.
    #[test]
    fn a_ladder_ends_on_the_floor() {
        assert!(!is_done(&rungs(&[]), 4) && !is_done(&rungs(&[1e-13]), 4));
        assert!(!is_done(&rungs(&[1e-3, 6e-5, 1e-13]), 4));
        assert!(!is_done(&rungs(&[1e-3, 6e-5, 1e-13, 2e-7]), 4));
        assert!(is_done(&rungs(&[1e-3, 6e-5, 1e-13, 2e-13]), 4));
        let unlucky = rungs(&[1e-3, 1e-14, 4e-14, 1.5e-13, 6e-13]);
        assert!(!is_done(&unlucky[..4], 4) && is_done(&unlucky, 4));
    }
}
