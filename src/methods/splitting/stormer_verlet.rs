//! Störmer–Verlet in velocity form.

use crate::integrate::Method;
use crate::methods::{Info, MethodInfo};
use crate::systems::Separable;

/// Störmer–Verlet in velocity form: half a kick, a drift, half a kick.
///
/// The force at the end of a step is the force at the start of the next, so it is evaluated once
/// for both. Order 2, symplectic, symmetric, one force evaluation a step and one before the first.
/// Also called velocity Verlet, leapfrog, kick–drift–kick. Paper, Eqs. 10–12; Hairer, Lubich,
/// Wanner, *Geometric Numerical Integration*, Sect. I.1.4.
#[derive(Clone, Copy, Debug, Default)]
pub struct StormerVerlet;

impl Info for StormerVerlet {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Störmer–Verlet",
            aliases: &["velocity Verlet", "leapfrog", "kick–drift–kick"],
            symplectic: true,
            symmetric: true,
            force_evaluations: 1,
            start_evaluations: 1,
            reference: "Hairer, Lubich, Wanner (2006), Sect. I.1.4",
            ..MethodInfo::new("stormer-verlet", 2)
        }
    }
}

// ANCHOR: step
impl<S: Separable> Method<S> for StormerVerlet {
    /// The state half a kick ahead.
    type Carry = S::State;

    fn start(&self, system: &S, t: f64, h: f64, z: S::State) -> S::State {
        system.kick(z, system.force(t, z), 0.5 * h)
    }

    #[inline(always)]
    fn step(&self, system: &S, t: f64, h: f64, _z: S::State, ahead: &mut S::State) -> S::State {
        let z = system.drift(*ahead, h);
        let force = system.force(t + h, z);
        // The half kick that ends this step and the one that begins the next are merged into one.
        *ahead = system.kick(z, force, h);
        // Only an observer reads this state: without one the compiler removes it.
        system.kick(z, force, 0.5 * h)
    }
}
// ANCHOR_END: step
