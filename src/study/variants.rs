//! A method that the paper might have meant but did not use: its numbers tell the two apart.

use crate::method::{Described, Method, Properties};
use crate::methods::symplectic_euler::SymplecticEuler;
use crate::system::Separable;

/// Symplectic Euler the other way round: drift, then kick.
///
/// Order 1, symplectic, not symmetric, one force evaluation a step. Hairer, Lubich, Wanner (2006), Sect. I.1.2.
#[derive(Clone, Copy, Debug)]
pub struct DriftKick;

impl Described for DriftKick {
    fn properties(&self) -> Properties {
        Properties { name: "drift-kick", ..SymplecticEuler.properties() }
    }
}

impl<S: Separable> Method<S> for DriftKick {
    type Memo = ();

    fn start(&self, _system: &S, _t: f64, _h: f64, _z: S::State) {}

    #[inline(always)]
    fn step(&self, system: &S, t: f64, h: f64, z: S::State, _memo: &mut ()) -> S::State {
        let z = system.drift(z, h);
        system.kick(z, system.force(t + h, z), h)
    }
}
