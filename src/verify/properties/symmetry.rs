//! The symmetries of the pendulum: the mirror, the units of mass, length and time, and a whole
//! turn.
//!
//! All but mass and length, of which a stranger is not told, are measured by the judge; where
//! nothing rounds a method of the library has to be right to the bit.

use super::{CheckResult, near, pendulum, same, samples};
use crate::verify::judge::Listed;
use crate::verify::judge::probe::{Measured, Probe};
use crate::verify::judge::symmetry::{Apart, UNITS, mirror, turn, units};
use crate::{AnyMethod, Pendulum, Phase};

/// By how much two runs of `method` differ that should not, and what rounding may make of it.
fn apart(
    method: &dyn AnyMethod,
    measure: impl FnOnce(&Probe<'_>) -> Measured<Apart>,
) -> Result<Apart, String> {
    let measured = Probe::new(&Listed(method)).and_then(|probe| measure(&probe));
    measured.map_err(|trouble| trouble.to_string())
}

/// θ → −θ, ω → −ω: the same bits but for the signs.
pub fn check_mirror(method: &dyn AnyMethod) -> CheckResult {
    near("the distance from the mirror image (rad)", apart(method, mirror)?.largest, 0.0, 0.0)
}

/// The motion depends on g/L, and not on the mass: with another mass, and with g and L twice as
/// large, the bits are the same.
pub fn check_mass_and_length(method: &dyn AnyMethod) -> CheckResult {
    for start in [Phase { theta: 1.2, omega: 0.7 }, Phase { theta: -0.4, omega: 5.0 }] {
        let of = |pendulum: Pendulum| samples(method, &pendulum, start, 0.05, 200);
        let built = |g, l, m| Pendulum::new(g, l, m).expect("a pendulum");
        same("another mass", of(built(5.0, 2.0, 17.0)), of(pendulum()))?;
        same("the same g/L", of(built(10.0, 4.0, 3.0)), of(pendulum()))?;
    }
    Ok(())
}

/// Time in another unit: with the same (g/L) h², θ is the same. Scaling by powers of two is exact,
/// so that the bits agree.
pub fn check_time(method: &dyn AnyMethod) -> CheckResult {
    let [four, quarter, three] = UNITS;
    let Apart { largest, .. } = apart(method, |probe| units(probe, &[four, quarter]))?;
    near("with time in 4 s and in 1/4 s, the distance (rad)", largest, 0.0, 0.0)?;
    let Apart { largest, bound } = apart(method, |probe| units(probe, &[three]))?;
    near("with time in 3 s, the distance (rad)", largest, 0.0, bound)
}

/// θ → θ + 2πk: whole turns higher, and otherwise the same.
pub fn check_turns(method: &dyn AnyMethod) -> CheckResult {
    let Apart { largest, bound } = apart(method, turn)?;
    near("whole turns on, the distance (rad)", largest, 0.0, bound)
}

/// Whether the motion has the symmetries of the pendulum: mirror, mass and length, unit of time,
/// whole turns.
///
/// # Errors
/// Says what is not, and by how much.
pub fn check(method: &dyn AnyMethod) -> CheckResult {
    check_mirror(method)?;
    check_mass_and_length(method)?;
    check_time(method)?;
    check_turns(method)
}
