//! Area in phase space: the determinant of the Jacobian of one step.

use core::convert::Infallible;

use super::{CheckResult, as_claimed, measured, near};
use crate::judge::area::{judge, largest};
use pendula::{AnyMethod, Grid, Pendulum, Phase};

/// The step (s) whose change of area is measured.
pub const AREA_STEP: f64 = 0.1;

/// The half width of the differences of [`area_defect`] (rad, and in units of ω₀).
const DELTA: f64 = 1e-3;

/// The error of [`area_defect`]: each of four derivatives is off by 3/2 of a rounding over δ, 4 ε
/// of a state up to 3 in a step of many stages, 4e-12, and enters times entries of the Jacobian of
/// up to 2: 3e-11. Truncation, δ⁴/30 times a fifth derivative of order 1, is 3e-14.
pub const AREA_TOLERANCE: f64 = 5e-11;

// ANCHOR: area_defect
/// det J − 1 of one step of `h` (s) at `z`: by how much the step inflates area in phase space.
pub fn area_defect(method: &dyn AnyMethod, pendulum: &Pendulum, z: Phase, h: f64) -> f64 {
    let one_step = Grid::new(h, 1).expect("a positive step");
    let Ok(determinant) = determinant(DELTA, |right, up| {
        let start = Phase { theta: z.theta + right * DELTA, omega: z.omega + up * DELTA };
        let end = method.run(pendulum, start, &one_step, &mut ());
        Ok::<_, Infallible>([end.theta, end.omega])
    });
    determinant - 1.0
}

/// det J of a map, of which `image` has the neighbours so many `delta` to the right and up.
pub fn determinant<E>(
    delta: f64,
    image: impl Fn(f64, f64) -> Result<[f64; 2], E>,
) -> Result<f64, E> {
    let along = |right: f64, up: f64| {
        let [a, b] = [image(right, up)?, image(-right, -up)?];
        let [c, d] = [image(2.0 * right, 2.0 * up)?, image(-2.0 * right, -2.0 * up)?];
        Ok([0, 1].map(|i| (8.0 * (a[i] - b[i]) - (c[i] - d[i])) / (12.0 * delta)))
    };
    let [[j11, j21], [j12, j22]] = [along(1.0, 0.0)?, along(0.0, 1.0)?];
    Ok(j11 * j22 - j12 * j21)
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

/// Whether a step preserves area or not, as the entry says.
pub fn check(method: &dyn AnyMethod) -> CheckResult {
    let defect = measured(method, largest)?;
    // The judge's ruler is as right where a method is smooth.
    let what = "what two widths of differences disagree by";
    near(what, defect.ruler, 0.0, AREA_TOLERANCE)?;
    as_claimed(method.info().symplectic, "symplectic after all", judge(&defect))
}
