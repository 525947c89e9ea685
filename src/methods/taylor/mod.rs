//! Taylor series of the motion, to any power of the step.

mod taylor_24;

pub use taylor_24::Taylor24;

use crate::integrate::Method;
use crate::systems::Analytic;

/// The Taylor series of the motion to the power `P` of the step.
///
/// Order P, not symplectic, not symmetric, one sine and one cosine a step; for systems that are
/// [`Analytic`]. À. Jorba, M. Zou, *Experiment. Math.* 14 (2005) 99–117.
#[derive(Clone, Copy, Debug, Default)]
pub struct Taylor<const P: usize>;

impl<S: Analytic, const P: usize> Method<S> for Taylor<P> {
    type Carry = ();

    fn start(&self, _system: &S, _t: f64, _h: f64, _z: S::State) {}

    #[inline(always)]
    fn step(&self, system: &S, _t: f64, h: f64, z: S::State, _carry: &mut ()) -> S::State {
        z + system.mean_rate::<P>(h, z) * h
    }
}
