//! Processed method of order 6, with the force gradient in one of three kicks.

use crate::integrate::Method;
use crate::methods::{Info, MethodInfo};
use crate::systems::{ForceGradient, Processor};

/// Four kicks and three drifts, the gradient of the force in the outer kicks, processed: of order 6
/// at three sines and one cosine a step.
///
/// The kernel is a palindrome with three numbers, the least that order 6 can be had for: one
/// condition of order 4 and two of order 6 are left to the kernel, the processor meets the others.
/// Symplectic, symmetric. The last kick of a step and the first of the next are one, so that a step
/// costs three forces and one gradient, counted as four evaluations; before the first step the
/// change of variables costs twelve, and the first kick two. The coefficients solve the order
/// conditions, which `tests/methods/order_conditions/processed.rs` states. S. Blanes, F. Casas, J.
/// Ros, *SIAM J. Sci. Comput.* 21 (1999) 711–727, on such methods and how many conditions they
/// have; M. A. López-Marcos, J. M. Sanz-Serna, R. D. Skeel, *SIAM J. Sci. Comput.* 18 (1997)
/// 223–238, on the gradient.
#[derive(Clone, Copy, Debug, Default)]
pub struct Processed6;

impl Info for Processed6 {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Processed 6",
            aliases: &["kick–drift kernel with the force gradient"],
            symplectic: true,
            symmetric: true,
            force_evaluations: 4,
            start_evaluations: Processor::EVALUATIONS + 2,
            reference: "S. Blanes, F. Casas, J. Ros, SIAM J. Sci. Comput. 21 (1999) 711",
            ..MethodInfo::new("processed-6", 6)
        }
    }
}

/// The outer kicks, in steps; the inner ones are what is left of a half.
pub const KICK: f64 = 0.237_887_064_748_297_18;
/// The outer drifts, in steps; the inner one is what is left of the whole, and leads back.
pub const DRIFT: f64 = 0.568_261_038_391_863;
/// What stands before h² f f' in the outer kicks.
pub const GRADIENT: f64 = 0.068_944_954_335_503_56;
/// What the processor adds.
pub const PROCESSOR: Processor = Processor::new(
    -0.019_026_432_922_978_27,
    0.003_053_019_527_983_182_5,
    7.413_200_225_139_536e-5,
);

// ANCHOR: step
impl<S: ForceGradient> Method<S> for Processed6 {
    /// The state of the kernel, one kick ahead.
    type Carry = S::State;

    const REACH: f64 = 4.0 * DRIFT - 1.0;
    const GRADIENT: f64 = GRADIENT;

    #[inline(always)]
    fn start(&self, system: &S, t: f64, h: f64, z: S::State) -> S::State {
        let z = z + system.unprocessing(z, &PROCESSOR.over(h));
        let force = system.force_with_gradient(t, z, GRADIENT * (h * h));
        system.kick(z, force, KICK * h)
    }

    #[inline(always)]
    fn step(&self, system: &S, t: f64, h: f64, _z: S::State, ahead: &mut S::State) -> S::State {
        let z = system.drift(*ahead, DRIFT * h);
        let z = system.kick(z, system.force(t + DRIFT * h, z), (0.5 - KICK) * h);
        let z = system.drift(z, (1.0 - 2.0 * DRIFT) * h);
        let force = system.force(t + (1.0 - DRIFT) * h, z);
        let z = system.drift(system.kick(z, force, (0.5 - KICK) * h), DRIFT * h);
        let force = system.force_with_gradient(t + h, z, GRADIENT * (h * h));
        *ahead = system.kick(z, force, 2.0 * KICK * h);
        // Only an observer reads what follows: without one the compiler removes it.
        let z = system.kick(z, force, KICK * h);
        z + system.processing(z, &PROCESSOR.over(h))
    }
}
// ANCHOR_END: step
