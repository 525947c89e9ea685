//! Area in phase space: the determinant of the Jacobian of one step.

use pendula::study::properties::{AREA_STEP, AREA_TOLERANCE, area_defect, area_tolerance};
use pendula::{AnyMethod, Pendulum, Phase};

use super::{Verdict, beyond, near};

/// Below and above the horizontal, moving and at rest; L ≠ 1 so that no g can stand for g/L.
pub fn cases() -> impl Iterator<Item = (Pendulum, Phase)> {
    let long = Pendulum::new(9.81, 3.0, 1.0).expect("a pendulum");
    [(0.0, 0.0), (0.5, 1.0), (1.0, -2.0), (2.5, 0.3), (-3.0, 0.0)].into_iter().flat_map(
        move |(theta, omega)| {
            [Pendulum::PAPER, long].map(|pendulum| (pendulum, Phase { theta, omega }))
        },
    )
}

pub fn check(method: &dyn AnyMethod) -> Verdict {
    let largest = |h: f64| {
        let defects = cases().map(|(pendulum, z)| area_defect(method, &pendulum, z, h).abs());
        // Not `max`, which drops a NaN.
        defects.fold(0.0, libm::fmaximum)
    };
    if method.properties().symplectic {
        return near("det J − 1", largest(AREA_STEP), 0.0, AREA_TOLERANCE);
    }
    // The smallest defect among the paper's methods is RK4's, x⁶/72 = 5e-7 at the bottom of the long pendulum. The higher the
    // order, the longer the step with which it shows: 0.4 s, of x = 1.25, do for order 24.
    let seen =
        |h: f64| beyond("symplectic after all: det J − 1", largest(h), 100.0 * area_tolerance(h));
    seen(AREA_STEP).or_else(|_| seen(2.0 * AREA_STEP)).or_else(|_| seen(4.0 * AREA_STEP))
}
