//! The method of Cieśliński and Ratkiewicz: a discrete gradient that is exact for small swings.

use crate::arithmetic::number::Number;
use crate::arithmetic::sine::{cos, sinc};
use crate::integrate::{Method, Unsolved};
use crate::methods::implicit::DiscreteGradient;
use crate::methods::implicit::iteration::solved;
use crate::methods::{Info, MethodInfo};
use crate::systems::{MeanForce, Measurable, NearlyLinear};

/// The method of Cieśliński and Ratkiewicz: the [discrete gradient](DiscreteGradient) with steps of
/// the length (2/ω₀) tan(ω₀h/2) in place of h.
///
/// The energy is conserved, as it is by a discrete gradient in steps of any length. On a linear
/// force that method turns by 2 arctan(x/2) in a step of x = ω₀h, so that with the tangent a small
/// swing turns by x: its period is exact. Order 2, symmetric, not symplectic. A step evaluates the
/// mean force, two sines, once in each sweep, and the force once to begin.
///
/// The tangent has its pole at half a turn of the linear pendulum, x = π; from x = 3 on no step is
/// tried, and the run is refused. Small swings are refused from x = 1.3 on: a sweep multiplies what
/// is wrong by tan(x/2), and a hundred leave too much.
///
/// Also called the modified discrete gradient, MOD-GR. J. L. Cieśliński, B. Ratkiewicz, *J. Phys.
/// A* 42 (2009) 105204.
#[derive(Clone, Copy, Debug, Default)]
pub struct CieslinskiRatkiewicz;

impl Info for CieslinskiRatkiewicz {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Cieśliński–Ratkiewicz",
            aliases: &["modified discrete gradient", "MOD-GR"],
            symmetric: true,
            conserves_energy: true,
            implicit: true,
            reference: "J. L. Cieśliński, B. Ratkiewicz, J. Phys. A 42 (2009) 105204",
            ..MethodInfo::new("cieslinski-ratkiewicz", 2)
        }
    }
}

/// The longest x = ω₀h of a step that is tried: beyond the pole, where the tangent is negative or
/// small again, a step would be solved, and be another one.
const LONGEST: f64 = 3.0;

impl<S> Method<S> for CieslinskiRatkiewicz
where
    S: MeanForce + NearlyLinear<State: Measurable<Number = S::Time>>,
{
    /// The pace tan(x/2)/(x/2); NaN, with which nothing is solved, for a step that is too long.
    type Carry = S::Time;

    /// The pace at x = 3.
    const REACH: f64 = 9.5;

    const IS_LONG: bool = true;

    fn start(&self, system: &S, _t: f64, h: f64, _z: S::State) -> S::Time {
        system.linear_frequency_squared().map(|frequency_squared| {
            let half_turned = 0.5 * libm::sqrt(frequency_squared) * h;
            let is_tried = half_turned.abs() < 0.5 * LONGEST;
            if is_tried { sinc(half_turned) / cos(half_turned) } else { f64::NAN }
        })
    }

    #[inline(always)]
    fn step(&self, system: &S, t: f64, h: f64, z: S::State, pace: &mut S::Time) -> S::State {
        DiscreteGradient::attempt(system, t, h, z, system.rate(t, z), *pace).0
    }

    #[inline(always)]
    fn try_step(
        &self,
        system: &S,
        t: f64,
        h: f64,
        z: S::State,
        pace: &mut S::Time,
    ) -> Result<S::State, Unsolved> {
        solved(DiscreteGradient::attempt(system, t, h, z, system.rate(t, z), *pace))
    }
}
