//! Taylor series of order 24.

use super::Taylor;
use crate::integrate::Method;
use crate::methods::{Info, MethodInfo};
use crate::systems::Analytic;

/// The Taylor series of the motion itself, to the 24th power of the step: for long steps and all
/// digits.
///
/// Order 24, neither symplectic nor symmetric, though the deviation is often below rounding. A step
/// evaluates one sine and one cosine; the powers follow by recurrence, and each is counted as one
/// evaluation. A step is limited by the convergence of the series to about two radians of the
/// motion: in longer steps the state grows with their 24th power, and may overflow. Also called the
/// method of Taylor series, or automatic differentiation. Hairer, Nørsett, Wanner, *Solving
/// Ordinary Differential Equations I*, Sect. I.8; À. Jorba, M. Zou, *Experimental Mathematics* 14
/// (2005), 99–117, doi:10.1080/10586458.2005.10128904. Any other order is [`Taylor<P>`](Taylor).
#[derive(Clone, Copy, Debug, Default)]
pub struct Taylor24;

impl Info for Taylor24 {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Taylor 24",
            aliases: &["power series", "automatic differentiation"],
            reference: "Hairer, Nørsett, Wanner (1993), Sect. I.8",
            ..MethodInfo::new("taylor-24", 24)
        }
    }
}

impl<S: Analytic> Method<S> for Taylor24 {
    type Carry = ();

    const IS_LONG: bool = true;

    fn start(&self, _system: &S, _t: f64, _h: f64, _z: S::State) {}

    #[inline(always)]
    fn step(&self, system: &S, t: f64, h: f64, z: S::State, carry: &mut ()) -> S::State {
        Taylor::<24>.step(system, t, h, z, carry)
    }
}
