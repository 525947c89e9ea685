//! Störmer–Verlet in velocity form.

use crate::method::{Described, Method, Properties};
use crate::system::Separable;

/// Störmer–Verlet in velocity form: half a kick, a drift, half a kick.
///
/// The force at the end of a step is the force at the start of the next, so it is evaluated once and handed on.
/// Order 2, symplectic, symmetric, one force evaluation a step and one before the first. Also called velocity Verlet,
/// leapfrog, kick–drift–kick. Paper, Eqs. 10–12; Hairer, Lubich, Wanner, *Geometric Numerical Integration*, Sect. I.1.4.
#[derive(Clone, Copy, Debug, Default)]
pub struct StormerVerlet;

impl Described for StormerVerlet {
    fn properties(&self) -> Properties {
        Properties {
            name: "stormer-verlet",
            title: "Störmer–Verlet",
            aliases: &["velocity Verlet", "leapfrog", "kick–drift–kick"],
            order: 2,
            symplectic: true,
            symmetric: true,
            force_evaluations: 1,
            start_evaluations: 1,
            reference: "Hairer, Lubich, Wanner (2006), Sect. I.1.4",
        }
    }
}

// ANCHOR: step
impl<S: Separable> Method<S> for StormerVerlet {
    /// The force at the end of the last step.
    type Memo = S::Force;

    fn start(&self, system: &S, t: f64, z: S::State) -> S::Force {
        system.force(t, z)
    }

    #[inline]
    fn step(&self, system: &S, t: f64, h: f64, z: S::State, force: &mut S::Force) -> S::State {
        let z = system.kick(z, *force, 0.5 * h);
        let z = system.drift(z, h);
        *force = system.force(t + h, z);
        system.kick(z, *force, 0.5 * h)
    }
}
// ANCHOR_END: step
