//! What the judge takes for the order and the leading error of a stranger.

use pendula::internals::{Ladder, Probe, leading_error, shown};
use pendula::method_named;
use pendula::verify::ByPointer;
use pendula::verify::properties::error_constant::leading_local_error;

use crate::common::{steps, steps_on};

/// The smallest of these errors are RK4's, a fortieth of 1/5!. Step and truth are rounded by ε
/// at the quarter step, which there is 1/(3e4 · 5!); times 8/3, its weight in the
/// extrapolation, 4e-3 of the error. The extrapolation leaves x³/8 with x = 0.06: 3e-5.
///
/// Catches: an error that is not extrapolated or drowned in rounding, one of ω in rad/s and not
/// in ω₀, a power of x too many.
#[test]
fn the_leading_error_is_that_of_theory() {
    for name in ["forward-euler", "symplectic-euler", "stormer-verlet", "rk4"] {
        let method = method_named(name).unwrap();
        let stranger = ByPointer { pendulum: steps(method), driven: steps_on(method) };
        let law = leading_local_error(name, [1.0, 1.0]).unwrap();
        let probe = Probe::new(&stranger).unwrap();
        let found = leading_error(&probe, method.info().order).unwrap();
        for i in 0..2 {
            let allowed = 4e-3 * law[i].abs();
            assert!((found[i] - law[i]).abs() <= allowed, "{name}: {found:?}, not {law:?}");
        }
    }
}

/// Catches: an order shown by the finest slope alone.
#[test]
fn two_slopes_show_an_order() {
    let ladder = |slopes: &[f64]| Ladder { rungs: vec![], slopes: slopes.to_vec(), leading: 0 };
    assert_eq!(shown(&ladder(&[1.4, 1.6, 3.05])), None);
    assert_eq!(shown(&ladder(&[2.9, 3.05])), Some(3));
}
