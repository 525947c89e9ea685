//! The explicit midpoint rule.

use crate::integrate::Method;
use crate::methods::{Info, MethodInfo};
use crate::systems::System;

/// The explicit midpoint rule: the slope half a step ahead, for the whole step.
///
/// Order 2, not symplectic, not symmetric, two force evaluations a step. Also called Runge's method
/// or modified Euler. C. Runge, *Mathematische Annalen* 46 (1895), 167–178, doi:10.1007/BF01446807;
/// Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, Sect. II.1.
#[derive(Clone, Copy, Debug, Default)]
pub struct ExplicitMidpoint;

impl Info for ExplicitMidpoint {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Explicit midpoint",
            aliases: &["Runge's method", "modified Euler"],
            reference: "C. Runge, Math. Ann. 46 (1895) 167; Hairer, Nørsett, Wanner (1993), Sect. \
                        II.1",
            ..MethodInfo::new("explicit-midpoint", 2)
        }
    }
}

impl<S: System> Method<S> for ExplicitMidpoint {
    type Carry = ();

    fn start(&self, _system: &S, _t: f64, _h: f64, _z: S::State) {}

    #[inline(always)]
    fn step(&self, system: &S, t: f64, h: f64, z: S::State, _carry: &mut ()) -> S::State {
        let half = z + system.rate(t, z) * (h / 2.0);
        z + system.rate(t + h / 2.0, half) * h
    }
}
