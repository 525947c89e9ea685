//! Area in phase space: the determinant of the Jacobian of one step.

use super::{CheckResult, beyond, near};
use pendula::{AnyMethod, Grid, Pendulum, Phase};

/// The step (s) whose change of area is measured.
pub const AREA_STEP: f64 = 0.1;

/// Half the width of the central difference that measures det J.
const DELTA: f64 = 1e-4;

/// The error of the central difference: in each of four derivatives by rounding, ε θ/δ ≈ 2e-12 for
/// a state of order 1, and by truncation, δ²/6 times a third derivative of order h² g/L ≈ 0.1 times
/// a slope of order 1: 2e-10.
pub const AREA_TOLERANCE: f64 = 5e-10;

/// The same for a step of `h` (s): the third derivative goes with h², and rounding stays.
///
/// # Panics
/// For a step shorter than [`AREA_STEP`], where rounding would be more than this.
pub const fn area_tolerance(h: f64) -> f64 {
    let ratio = h / AREA_STEP;
    assert!(ratio >= 1.0, "rounding is more than this");
    AREA_TOLERANCE * ratio * ratio
}

// ANCHOR: area_defect
/// det J − 1 of one step of `h` (s) at `z`, by central differences: by how much the step inflates
/// area in phase space.
pub fn area_defect(method: &dyn AnyMethod, pendulum: &Pendulum, z: Phase, h: f64) -> f64 {
    let one_step = Grid::new(h, 1).expect("a positive step");
    let image = |theta, omega| method.run(pendulum, Phase { theta, omega }, &one_step, &mut ());
    let along = |plus: Phase, minus: Phase| {
        let width = 2.0 * DELTA;
        ((plus.theta - minus.theta) / width, (plus.omega - minus.omega) / width)
    };
    let (j11, j21) = along(image(z.theta + DELTA, z.omega), image(z.theta - DELTA, z.omega));
    let (j12, j22) = along(image(z.theta, z.omega + DELTA), image(z.theta, z.omega - DELTA));
    j11 * j22 - j12 * j21 - 1.0
}
// ANCHOR_END: area_defect

/// Below and above the horizontal, moving and at rest; L ≠ 1, so that g in place of g/L shows.
pub fn cases() -> impl Iterator<Item = (Pendulum, Phase)> {
    let long = Pendulum::new(9.81, 3.0, 1.0).expect("a pendulum");
    [(0.0, 0.0), (0.5, 1.0), (1.0, -2.0), (2.5, 0.3), (-3.0, 0.0)].into_iter().flat_map(
        move |(theta, omega)| {
            [Pendulum::PAPER, long].map(|pendulum| (pendulum, Phase { theta, omega }))
        },
    )
}

/// Whether one step preserves area or not, as the entry says.
pub fn check(method: &dyn AnyMethod) -> CheckResult {
    let largest = |h: f64| {
        let defects = cases().map(|(pendulum, z)| area_defect(method, &pendulum, z, h).abs());
        // `fmaximum` keeps a NaN, which `max` would drop.
        defects.fold(0.0, libm::fmaximum)
    };
    if method.info().symplectic {
        let what = format_args!("the largest |det J − 1| in steps of {AREA_STEP} s");
        return near(what, largest(AREA_STEP), 0.0, AREA_TOLERANCE);
    }
    // The smallest defect among the paper's methods is RK4's, x⁶/72 = 5e-7 at the bottom of the
    // long pendulum. The higher the order, the longer the step at which the defect shows: 0.4 s,
    // x = 1.25, is enough for order 24.
    let seen = |h: f64| {
        let what = format_args!("symplectic after all: the largest |det J − 1| in steps of {h} s");
        beyond(what, largest(h), 100.0 * area_tolerance(h))
    };
    seen(AREA_STEP).or_else(|_| seen(2.0 * AREA_STEP)).or_else(|_| seen(4.0 * AREA_STEP))
}
