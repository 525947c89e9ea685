//! What the size of a step and the order of a series follow from.

use pendula::adaptive::{SMALLEST_RELATIVE, Tolerance};
use pendula::internals::{Controller, exp2, log2, order};

/// A few roundings, and the powers of another library.
const ROUNDING: f64 = 1e-14;

/// What `controller` makes of these errors, one after the other, is that.
#[track_caller]
fn assert_judged(mut controller: Controller, judged: &[(f64, bool, f64)]) {
    for &(error, accepted, factor) in judged {
        let (found, by) = controller.judge(error);
        assert!(found == accepted, "{error}: {found}");
        assert!((by / factor - 1.0).abs() < ROUNDING, "{error}: {by}, not {factor}");
    }
}

/// Factors computed with 40 digits: 0.9 error^(−0.85/k) last^(0.2/k) after a step that is
/// accepted, where the `last` is 1e-4 before the first, and 0.9 error^(−1/k) after one that is
/// not.
///
/// Catches: a wrong exponent of either error, or a swapped sign, which leaves the tolerance
/// kept and only takes more steps; the order of the method in place of that of its estimate; a
/// memory of the error that was refused.
#[test]
fn a_step_is_judged_by_its_error_and_the_one_before() {
    for (order, factors) in [
        (
            5,
            [
                0.700_515_273_422_561_8,
                1.915_143_450_563_941_6,
                0.748_587_393_992_403_9,
                0.722_467_405_584_207_6,
            ],
        ),
        (
            8,
            [
                0.769_532_464_874_439_2,
                1.442_835_301_480_292_3,
                0.802_125_844_320_371,
                0.784_516_988_584_562_1,
            ],
        ),
    ] {
        let [first, second, third, refused] = factors;
        assert_judged(
            Controller::new(order),
            &[(0.5, true, first), (0.01, true, second), (1.0, true, third)],
        );
        // The error of a step that was refused is not remembered; what was before it is, and
        // the next step does not grow.
        assert_judged(
            Controller::new(order),
            &[(0.5, true, first), (3.0, false, refused), (0.01, true, 1.0), (1.0, true, third)],
        );
    }
}

/// Catches: a step that grows or shrinks without limit; a NaN or an infinity that is accepted,
/// or from which the next step is NaN.
#[test]
fn a_step_changes_within_limits() {
    for order in [5, 8] {
        let judged = [
            (0.0, true, 10.0),
            (1e-300, true, 10.0),
            (1.0_f64.next_up(), false, 0.9),
            (1e9, false, 0.2),
            (f64::INFINITY, false, 0.2),
            (f64::NAN, false, 0.2),
            // After a refusal no growth, once.
            (0.0, true, 1.0),
            (0.0, true, 10.0),
        ];
        assert_judged(Controller::new(order), &judged);
    }
}

/// From the exponents at both ends and the mantissas between: log₂(1 + f) − f is at most
/// 0.0861, at f = 1/ln 2 − 1; and 2ᶠ, for |f| ≤ ½, is within 0.9 % of its parabola.
///
/// Catches: an exponent off by one, a mantissa that is not in it, a fraction rounded the wrong
/// way: steps that are wrong by up to 9 %, which the tolerance would hide.
#[test]
fn roots_are_good_to_a_hundredth() {
    for n in 0..40_000 {
        let y = f64::from(n - 20_000) / 20.0 + 0.013;
        let power = libm::exp2(y);
        let short = y - log2(power);
        assert!((-1e-9..0.0861).contains(&short), "{y}: {short}");
        assert!((exp2(y) / power - 1.0).abs() < 0.0095, "{y}: {}", exp2(y));
    }
    assert_eq!((log2(0.0), log2(1.0), exp2(0.0), exp2(-3.0)), (-1023.0, 0.0, 1.0, 0.125));
}

/// ⌈(2 − ln ε)/4⌉ blocks of four, by hand: 2 − ln 1e-12 = 29.6.
///
/// Catches: Jorba and Zou's order, half of it; a decimal or binary logarithm; an order that
/// there are no terms for.
#[test]
fn the_order_follows_from_the_tolerance() {
    for (relative, expected) in [
        (SMALLEST_RELATIVE, 36),
        (1e-14, 36),
        (1e-12, 32),
        (1e-10, 28),
        (1e-8, 24),
        (1e-6, 16),
        (1e-4, 12),
        (1e-2, 8),
        (0.5, 4),
        (1.0_f64.next_down(), 4),
    ] {
        assert_eq!(order(&Tolerance::new(1.0, relative).unwrap()), expected, "{relative}");
    }
}
