//! Symplectic Euler, kick then drift.

use crate::integrate::Method;
use crate::methods::{Info, MethodInfo};
use crate::systems::Separable;

/// Symplectic Euler: the velocity is kicked first, then the position drifts with the *new*
/// velocity.
///
/// Order 1, symplectic, not symmetric, one force evaluation a step. Also called semi-implicit Euler
/// or Euler–Cromer. Paper, Eqs. 8–9; Hairer, Lubich, Wanner, *Geometric Numerical Integration*,
/// Sect. I.1.2.
#[derive(Clone, Copy, Debug, Default)]
pub struct SymplecticEuler;

impl Info for SymplecticEuler {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Symplectic Euler",
            aliases: &["semi-implicit Euler", "Euler–Cromer"],
            symplectic: true,
            reference: "Hairer, Lubich, Wanner (2006), Sect. I.1.2",
            ..MethodInfo::new("symplectic-euler", 1)
        }
    }
}

// ANCHOR: step
impl<S: Separable> Method<S> for SymplecticEuler {
    type Carry = ();

    fn start(&self, _system: &S, _t: f64, _h: f64, _z: S::State) {}

    #[inline(always)]
    fn step(&self, system: &S, t: f64, h: f64, z: S::State, _carry: &mut ()) -> S::State {
        let force = system.force(t, z);
        let z = system.kick(z, force, h);
        system.drift(z, h)
    }
}
// ANCHOR_END: step
