//! Heun's method.

use crate::integrate::Method;
use crate::methods::{Info, MethodInfo};
use crate::systems::System;

/// Heun's method of order 2: the mean of the slopes at both ends of an Euler step.
///
/// Order 2, not symplectic, not symmetric, two force evaluations a step. Also called the explicit
/// trapezoidal rule or improved Euler. K. Heun, *Zeitschrift für Mathematik und Physik* 45 (1900),
/// 23–38; Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, Sect. II.1.
#[derive(Clone, Copy, Debug, Default)]
pub struct Heun;

impl Info for Heun {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Heun",
            aliases: &["explicit trapezoidal rule", "improved Euler"],
            reference: "K. Heun, Z. Math. Phys. 45 (1900) 23; Hairer, Nørsett, Wanner (1993), \
                        Sect. II.1",
            ..MethodInfo::new("heun", 2)
        }
    }
}

impl<S: System> Method<S> for Heun {
    type Carry = ();

    fn start(&self, _system: &S, _t: f64, _h: f64, _z: S::State) {}

    #[inline(always)]
    fn step(&self, system: &S, t: f64, h: f64, z: S::State, _carry: &mut ()) -> S::State {
        let k1 = system.rate(t, z);
        let k2 = system.rate(t + h, z + k1 * h);
        z + (k1 + k2) * (h / 2.0)
    }
}
