//! Forward Euler.

use crate::integrate::Method;
use crate::methods::{Info, MethodInfo};
use crate::systems::System;

/// Forward Euler: both components move along the tangent at the start of the step.
///
/// Order 1, not symplectic, not symmetric, one force evaluation a step. Also called explicit Euler.
/// Paper, Eqs. 6–7; Hairer, Lubich, Wanner, *Geometric Numerical Integration*, Sect. I.1.2.
#[derive(Clone, Copy, Debug, Default)]
pub struct ForwardEuler;

impl Info for ForwardEuler {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Forward Euler",
            aliases: &["explicit Euler", "Euler's method"],
            reference: "Hairer, Lubich, Wanner (2006), Sect. I.1.2",
            ..MethodInfo::new("forward-euler", 1)
        }
    }
}

// ANCHOR: step
impl<S: System> Method<S> for ForwardEuler {
    type Carry = ();

    fn start(&self, _system: &S, _t: f64, _h: f64, _z: S::State) {}

    #[inline(always)]
    fn step(&self, system: &S, t: f64, h: f64, z: S::State, _carry: &mut ()) -> S::State {
        z + system.rate(t, z) * h
    }
}
// ANCHOR_END: step
