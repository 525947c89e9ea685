//! Processed method of order 4: position Verlet with the force gradient.

use crate::integrate::Method;
use crate::methods::{Info, MethodInfo};
use crate::systems::{ForceGradient, Processor};

/// Position Verlet with the gradient of the force in its kick, processed: of order 4 at one sine
/// and its cosine a step.
///
/// The kick is in the potential V − (h²/24) V'², whose force is f + (h²/12) f f'. The kernel alone
/// is of order 2; between the changes of variables it is of order 4. Symplectic, symmetric, and
/// stable up to x = ω₀h = √12. One force and one gradient a step, counted as two evaluations; the
/// change of variables before the first step costs twelve. Also called the method of Rowlands, or
/// of Takahashi and Imada. G. Rowlands, *J. Comput. Phys.* 97 (1991) 235–239; M. Takahashi, M.
/// Imada, *J. Phys. Soc. Jpn.* 53 (1984) 3765–3769; M. A. López-Marcos, J. M. Sanz-Serna, R. D.
/// Skeel, *SIAM J. Sci. Comput.* 18 (1997) 223–238.
#[derive(Clone, Copy, Debug, Default)]
pub struct Processed4;

impl Info for Processed4 {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Processed 4",
            aliases: &["Rowlands", "Takahashi–Imada", "position Verlet with the force gradient"],
            symplectic: true,
            symmetric: true,
            force_evaluations: 2,
            start_evaluations: Processor::EVALUATIONS,
            reference: "G. Rowlands, J. Comput. Phys. 97 (1991) 235",
            ..MethodInfo::new("processed-4", 4)
        }
    }
}

/// What stands before h² f f' in the kick.
pub const GRADIENT: f64 = 1.0 / 12.0;
/// Of the leading error of the kernel, h² (V'² − ω²V'')/24, a change of variables leaves nothing.
pub const PROCESSOR: Processor = Processor::new(1.0 / 24.0, 0.0, 0.0);

// ANCHOR: step
impl<S: ForceGradient> Method<S> for Processed4 {
    /// The state of the kernel, half a drift ahead.
    type Carry = S::State;

    const REACH: f64 = 1.0;
    const GRADIENT: f64 = GRADIENT;

    #[inline(always)]
    fn start(&self, system: &S, _t: f64, h: f64, z: S::State) -> S::State {
        let z = z + system.unprocessing(z, &PROCESSOR.over(h));
        system.drift(z, 0.5 * h)
    }

    #[inline(always)]
    fn step(&self, system: &S, t: f64, h: f64, _z: S::State, ahead: &mut S::State) -> S::State {
        let force = system.force_with_gradient(t + 0.5 * h, *ahead, GRADIENT * (h * h));
        let z = system.kick(*ahead, force, h);
        *ahead = system.drift(z, h);
        // Only an observer reads what follows: without one the compiler removes it.
        let z = system.drift(z, 0.5 * h);
        z + system.processing(z, &PROCESSOR.over(h))
    }
}
// ANCHOR_END: step
