//! The method of the discrete gradient.

use crate::arithmetic::number::Number;
use crate::integrate::{Method, Unsolved};
use crate::methods::implicit::iteration::solved;
use crate::methods::implicit::tableau::NumberOf;
use crate::methods::implicit::{ImplicitMidpoint, Iteration};
use crate::methods::{Info, MethodInfo};
use crate::systems::{MeanForce, Measurable, RateOf, System};

/// The method of the discrete gradient: the implicit midpoint rule with the mean of the force
/// along the step in place of the force at its middle.
///
/// The mean force times the way is the work, so that the kinetic energy grows by what the potential
/// loses: the energy is conserved in steps of any length, to rounding. Order 2, symmetric, not
/// symplectic: the motion is on the right curve and late on it. A step evaluates the mean force,
/// two sines, once in each sweep, and the force once to begin.
///
/// With one degree of freedom the discrete gradient of Itoh and Abe, *J. Comput. Phys.* 76 (1988)
/// 85, and the mean along a straight line are one and the same: R. I. McLachlan, G. R. W. Quispel,
/// N. Robidoux, *Phil. Trans. R. Soc. A* 357 (1999) 1021. Also called the method of the average
/// vector field; Hairer, Lubich, Wanner, *Geometric Numerical Integration*, Sect. V.5. Gonzalez's,
/// *J. Nonlinear Sci.* 6 (1996) 449, is another: it corrects the midpoint's gradient along the step
/// in phase space, so that the angle does not move by the mean velocity. It conserves the energy as
/// well; the known answers have it.
#[derive(Clone, Copy, Debug, Default)]
pub struct DiscreteGradient;

impl Info for DiscreteGradient {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Discrete gradient",
            aliases: &["average vector field", "energy-conserving"],
            symmetric: true,
            conserves_energy: true,
            implicit: true,
            reference: "R. I. McLachlan, G. R. W. Quispel, N. Robidoux, Phil. Trans. R. Soc. A 357 \
                        (1999) 1021",
            ..MethodInfo::new("discrete-gradient", 2)
        }
    }
}

/// A system with the mean of its force along a step of `h` (s) for its force, and its time `pace`
/// times as fast.
struct AlongTheStep<'s, S: MeanForce> {
    system: &'s S,
    h: NumberOf<S>,
    pace: NumberOf<S>,
}

impl<S: MeanForce> System for AlongTheStep<'_, S> {
    type State = S::State;

    #[inline(always)]
    fn rate(&self, _t: f64, middle: S::State) -> RateOf<S> {
        S::State::times(self.system.mean_force_rate(middle, self.h), self.pace)
    }
}

impl DiscreteGradient {
    /// A step of `pace` times `h` (s), which may differ from lane to lane, from the slope `first`;
    /// and why it has no end, if it has none.
    #[inline(always)]
    pub(super) fn attempt<S: MeanForce>(
        system: &S,
        t: f64,
        h: f64,
        z: S::State,
        first: RateOf<S>,
        pace: NumberOf<S>,
    ) -> (S::State, Option<Unsolved>) {
        let along = AlongTheStep { system, h: pace * h, pace };
        ImplicitMidpoint::TABLEAU.attempt(&along, t, h, z, first, Iteration::TO_ROUNDING)
    }

    /// The same at the pace of time itself.
    #[inline(always)]
    fn plain<S: MeanForce>(
        system: &S,
        t: f64,
        h: f64,
        z: S::State,
    ) -> (S::State, Option<Unsolved>) {
        let first = system.rate(t, z);
        Self::attempt(system, t, h, z, first, z.size(first).splat(1.0))
    }
}

impl<S: MeanForce> Method<S> for DiscreteGradient {
    type Carry = ();

    const IS_LONG: bool = true;

    fn start(&self, _system: &S, _t: f64, _h: f64, _z: S::State) {}

    #[inline(always)]
    fn step(&self, system: &S, t: f64, h: f64, z: S::State, _carry: &mut ()) -> S::State {
        Self::plain(system, t, h, z).0
    }

    #[inline(always)]
    fn try_step(
        &self,
        system: &S,
        t: f64,
        h: f64,
        z: S::State,
        _carry: &mut (),
    ) -> Result<S::State, Unsolved> {
        solved(Self::plain(system, t, h, z))
    }
}
