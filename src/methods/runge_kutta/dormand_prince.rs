//! Dormand and Prince's method of order 5.

use super::embedded::{Embedded, hermite};
use super::tableau::{Coefficient, Row, Tableau, coefficient, row, tableau};
use crate::integrate::Method;
use crate::methods::{Info, MethodInfo};
use crate::systems::{RateOf, System, Vector};

/// Dormand–Prince 5(4): six slopes for a step of order 5, and a seventh, the first of the next
/// step, to estimate its error.
///
/// Order 5, not symplectic, not symmetric, six force evaluations a step and one before the first;
/// dense output of order 4 takes none. Also called DOPRI5, RK45, RKDP or ode45. Dormand, Prince,
/// *J. Comput. Appl. Math.* 6 (1980) 19–26; Hairer, Nørsett, Wanner, *Solving Ordinary Differential
/// Equations I* (1993), Table II.5.2 and Sect. II.6.
///
/// With a tolerance the largest error of a step was 3200 tolerances in 1.5 million random steps of
/// pendulums of all kinds, and above 10 in one of 600. The estimate is one difference, which may
/// vanish by chance, and the slopes contain no other of its order. Beside an unstable equilibrium a
/// displacement smaller than the tolerance, which no estimate sees, may grow a thousandfold in a
/// step.
#[derive(Clone, Copy, Debug, Default)]
pub struct DormandPrince;

impl Info for DormandPrince {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Dormand–Prince",
            aliases: &["DOPRI5", "RK45", "ode45"],
            force_evaluations: 6,
            start_evaluations: 1,
            reference: "Hairer, Nørsett, Wanner (1993), Table II.5.2",
            ..MethodInfo::new("dormand-prince", 5)
        }
    }
}

impl<S: System> Method<S> for DormandPrince {
    /// The slope at the start of the step, evaluated at the end of the last one.
    type Carry = RateOf<S>;

    const REACH: f64 = TABLEAU.reach();
    const IS_LONG: bool = true;

    fn start(&self, system: &S, t: f64, _h: f64, z: S::State) -> RateOf<S> {
        system.rate(t, z)
    }

    #[inline(always)]
    fn step(&self, system: &S, t: f64, h: f64, z: S::State, slope: &mut RateOf<S>) -> S::State {
        let stages = Stages::evaluate(system, t, h, z, [*slope]);
        *slope = stages.k7;
        z + stages.step() * h
    }
}

impl Embedded for DormandPrince {
    /// The embedded method has order 4, and its step an error of O(h⁵).
    const ESTIMATE_ORDER: u32 = 5;

    type Stages<D: Vector> = Stages<D>;
    type Dense<D: Vector> = [D; 4];

    #[inline(always)]
    fn attempt<S: System>(
        &self,
        system: &S,
        t: f64,
        h: f64,
        z: S::State,
        slope: RateOf<S>,
    ) -> (S::State, Stages<RateOf<S>>) {
        let stages = Stages::evaluate(system, t, h, z, [slope]);
        (z + stages.step() * h, stages)
    }

    #[inline]
    fn error<D: Vector>(&self, stages: &Stages<D>, size: impl Fn(D) -> f64) -> f64 {
        size(stages.error())
    }

    fn end_slope<S: System>(
        &self,
        _system: &S,
        _t: f64,
        _z: S::State,
        stages: &Stages<RateOf<S>>,
    ) -> RateOf<S> {
        stages.k7
    }

    fn dense<S: System>(
        &self,
        _system: &S,
        _t: f64,
        h: f64,
        _z: S::State,
        stages: &Stages<RateOf<S>>,
        end_slope: RateOf<S>,
    ) -> [RateOf<S>; 4] {
        let [first, second, third] = hermite(stages.step() * h, stages.k1 * h, end_slope * h);
        [first, second, third, stages.fourth() * h]
    }
}

tableau! {
    /// The stages, the weights of the step, of its error estimate and of the dense output.
    Stages, TABLEAU, from [k1];
    stages {
        k2 at 1.0 / 5.0 => {
            k1: 1.0 / 5.0,
        }
        k3 at 3.0 / 10.0 => {
            k1: 3.0 / 40.0,
            k2: 9.0 / 40.0,
        }
        k4 at 4.0 / 5.0 => {
            k1: 44.0 / 45.0,
            k2: -56.0 / 15.0,
            k3: 32.0 / 9.0,
        }
        k5 at 8.0 / 9.0 => {
            k1: 19_372.0 / 6561.0,
            k2: -25_360.0 / 2187.0,
            k3: 64_448.0 / 6561.0,
            k4: -212.0 / 729.0,
        }
        k6 at 1.0 => {
            k1: 9017.0 / 3168.0,
            k2: -355.0 / 33.0,
            k3: 46_732.0 / 5247.0,
            k4: 49.0 / 176.0,
            k5: -5103.0 / 18_656.0,
        }
        k7 at 1.0 => {
            k1: 35.0 / 384.0,
            k3: 500.0 / 1113.0,
            k4: 125.0 / 192.0,
            k5: -2187.0 / 6784.0,
            k6: 11.0 / 84.0,
        }
    }
    sums {
        /// The step of order 5, over h.
        step => {
            k1: 35.0 / 384.0,
            k3: 500.0 / 1113.0,
            k4: 125.0 / 192.0,
            k5: -2187.0 / 6784.0,
            k6: 11.0 / 84.0,
        }
        /// The difference from the step of the embedded method of order 4, over h.
        error => {
            k1: 71.0 / 57_600.0,
            k3: -71.0 / 16_695.0,
            k4: 71.0 / 1920.0,
            k5: -17_253.0 / 339_200.0,
            k6: 22.0 / 525.0,
            k7: -1.0 / 40.0,
        }
        /// The fourth coefficient of the dense output, over h.
        fourth => {
            k1: -12_715_105_075.0 / 11_282_082_432.0,
            k3: 87_487_479_700.0 / 32_700_410_799.0,
            k4: -10_690_763_975.0 / 1_880_347_072.0,
            k5: 701_980_252_875.0 / 199_316_789_632.0,
            k6: -1_453_857_185.0 / 822_651_844.0,
            k7: 69_997_945.0 / 29_380_423.0,
        }
    }
}
