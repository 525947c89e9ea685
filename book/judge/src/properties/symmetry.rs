//! The symmetries of the pendulum, as the judge measures them; of our methods more is asked: where
//! no rounding can differ, the bits are the same.

use super::{CheckResult, holds, measured, near, same};
use crate::integrator::{Chosen, Integrator, Ours, Request};
use crate::judge::probe::step;
use crate::judge::symmetry::{Apart, STARTS, STEPS, X, in_units, mirror, turn};
use pendula::AnyMethod;

fn to_the_bit(what: &str, Apart { largest, .. }: Apart) -> CheckResult {
    near(format_args!("the largest difference {what}"), largest, 0.0, 0.0)
}

/// θ → −θ, ω → −ω: the same bits but for the signs; and a pendulum at rest at the bottom stays.
pub fn check_mirror(method: &dyn AnyMethod) -> CheckResult {
    to_the_bit("from the mirror image", measured(method, mirror)?)
}

/// The motion depends on g/L, and not on the mass: with twice the length, twice the gravity and
/// three times the mass the bits are the same.
pub fn check_mass_and_length(method: &dyn AnyMethod) -> CheckResult {
    for start in STARTS {
        let run = Request::run(start, step(X), STEPS);
        let of = |integrator: &dyn Integrator| integrator.answer(&run).map_err(|it| it.to_string());
        let (ours, plain) = (of(&Ours(method))?.states, of(&Chosen::new(method))?.states);
        same("the same g/L", ours, plain)?;
    }
    Ok(())
}

/// Time in another unit: with the same (g/L) h², θ is the same. Scaling by powers of two is exact,
/// so that the bits agree.
pub fn check_time(method: &dyn AnyMethod) -> CheckResult {
    let exact = measured(method, |probe| in_units(probe, &[8.0, 0.25]))?;
    to_the_bit("with time in other units, by a power of two,", exact)?;
    holds(
        "time in thirds of a second",
        measured(method, |probe| in_units(probe, &[3.0]))?.judge(false),
    )
}

/// θ → θ + 2πk: whole turns higher, and otherwise the same.
pub fn check_turns(method: &dyn AnyMethod) -> CheckResult {
    holds("whole turns on", measured(method, turn)?.judge(false))
}

/// Whether the motion has the symmetries of the pendulum: mirror, mass and length, unit of time,
/// whole turns.
pub fn check(method: &dyn AnyMethod) -> CheckResult {
    check_mirror(method)?;
    check_mass_and_length(method)?;
    check_time(method)?;
    check_turns(method)
}
