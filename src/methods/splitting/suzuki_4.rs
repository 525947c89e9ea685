//! Suzuki's symplectic method of order 4.

use crate::methods::splitting::{Splitting, kicks};
use crate::methods::{Info, MethodInfo};

/// Suzuki's method of order 4: five steps of Störmer–Verlet, the middle one backwards.
///
/// With p = 1/(4 − ∛4) the substeps are p, p, 1 − 4p, p, p: each is shorter than the step, while
/// those of Forest and Ruth are longer, and the error is the smaller for it. Order 4, symplectic,
/// symmetric, five force evaluations a step. M. Suzuki: Fractal decomposition of exponential
/// operators, *Physics Letters A* 146 (1990), 319–323, doi:10.1016/0375-9601(90)90962-N.
#[derive(Clone, Copy, Debug, Default)]
pub struct Suzuki4;

impl Info for Suzuki4 {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Suzuki 4",
            aliases: &["Suzuki’s fractal"],
            symplectic: true,
            symmetric: true,
            force_evaluations: 5,
            start_evaluations: 1,
            reference: "M. Suzuki, Phys. Lett. A 146 (1990) 319",
            ..MethodInfo::new("suzuki-4", 4)
        }
    }
}

/// ∛4.
const CUBE_ROOT: f64 = 1.587_401_051_968_199_5;
const P: f64 = 1.0 / (4.0 - CUBE_ROOT);
const SUBSTEPS: [f64; 5] = [P, P, 1.0 - 4.0 * P, P, P];

impl Splitting for Suzuki4 {
    const KICKS: &'static [f64] = &kicks::<5, 6>(SUBSTEPS);
    const DRIFTS: &'static [f64] = &SUBSTEPS;
}
