//! Options of steps that vary, for a pulse that they would miss: how long the first and every step
//! may be, and a tolerance for each component.

use pendula::Error;
use pendula::adaptive::{Adaptive, Tolerance};
use pendula::methods::DormandPrince;
use pendula::systems::FromRate;

pub fn main() -> Result<(), Error> {
    // A push for 0.01 s, from 8.64 s on, to a spring at rest, with friction.
    let pulse = |t: f64| if (8.64..8.65).contains(&t) { 100.0 } else { 0.0 };
    let spring = FromRate::new(move |t, [x, v]: [f64; 2]| [v, pulse(t) - x - 0.2 * v]);
    let tolerance = Tolerance::for_each(&[1e-6, 1e-5], 1e-6)?;
    let free = Adaptive::new(DormandPrince, tolerance);
    let held = free.first_step(1e-3)?.max_step(5e-3)?.max_attempts(100_000);

    let end = |adaptive: Adaptive<'_, _>| adaptive.integrate(&spring, [0.0, 0.0], 0.0, 10.0);
    let ((missed, _), (hit, counts)) = (end(free)?, end(held)?);
    println!("{:.3} without, {:.3} with {} steps", missed[0], hit[0], counts.accepted);
    assert!(missed[0] == 0.0 && hit[0] > 0.5);
    Ok(())
}
