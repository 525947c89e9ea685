//! Störmer–Verlet in position form.

use crate::integrate::Method;
use crate::methods::{Info, MethodInfo};
use crate::systems::Separable;

/// Störmer–Verlet in position form: half a drift, a kick, half a drift.
///
/// The half drift that ends a step and the one that begins the next are merged into one. Order 2,
/// symplectic, symmetric, one force evaluation a step and none before the first. Also called
/// drift–kick–drift. Hairer, Lubich, Wanner, *Geometric Numerical Integration*, Sect. I.1.4.
#[derive(Clone, Copy, Debug, Default)]
pub struct PositionVerlet;

impl Info for PositionVerlet {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Position Verlet",
            aliases: &["drift–kick–drift"],
            symplectic: true,
            symmetric: true,
            force_evaluations: 1,
            reference: "Hairer, Lubich, Wanner (2006), Sect. I.1.4",
            ..MethodInfo::new("position-verlet", 2)
        }
    }
}

impl<S: Separable> Method<S> for PositionVerlet {
    /// The state half a drift ahead.
    type Carry = S::State;

    fn start(&self, system: &S, _t: f64, h: f64, z: S::State) -> S::State {
        system.drift(z, 0.5 * h)
    }

    #[inline(always)]
    fn step(&self, system: &S, t: f64, h: f64, _z: S::State, ahead: &mut S::State) -> S::State {
        let force = system.force(t + 0.5 * h, *ahead);
        let z = system.kick(*ahead, force, h);
        *ahead = system.drift(z, h);
        system.drift(z, 0.5 * h)
    }
}
