//! The classical Runge–Kutta method of order 4.

use crate::integrate::Method;
use crate::methods::{Info, MethodInfo};
use crate::systems::System;

/// The classical Runge–Kutta method: four slopes, weighted 1 : 2 : 2 : 1.
///
/// Order 4, not symplectic, not symmetric, four force evaluations a step. Also called RK4 or "the"
/// Runge–Kutta method. Paper, Algorithm 1; Hairer, Lubich, Wanner, *Geometric Numerical
/// Integration*, Sect. II.1.1.
#[derive(Clone, Copy, Debug, Default)]
pub struct Rk4;

impl Info for Rk4 {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "RK4",
            aliases: &["classical Runge–Kutta", "the Runge–Kutta method"],
            reference: "Hairer, Lubich, Wanner (2006), Sect. II.1.1",
            ..MethodInfo::new("rk4", 4)
        }
    }
}

// ANCHOR: step
impl<S: System> Method<S> for Rk4 {
    type Carry = ();

    fn start(&self, _system: &S, _t: f64, _h: f64, _z: S::State) {}

    #[inline(always)]
    fn step(&self, system: &S, t: f64, h: f64, z: S::State, _carry: &mut ()) -> S::State {
        let k1 = system.rate(t, z);
        let k2 = system.rate(t + h / 2.0, z + k1 * (h / 2.0));
        let k3 = system.rate(t + h / 2.0, z + k2 * (h / 2.0));
        let k4 = system.rate(t + h, z + k3 * h);
        z + (k1 + k2 * 2.0 + k3 * 2.0 + k4) * (h / 6.0)
    }
}
// ANCHOR_END: step
