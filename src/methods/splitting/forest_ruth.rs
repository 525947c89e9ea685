//! Forest and Ruth's symplectic method of order 4.

use crate::methods::splitting::{Splitting, kicks};
use crate::methods::{Info, MethodInfo};

/// Forest and Ruth's method: three steps of Störmer–Verlet, the second of them backwards.
///
/// With w = 1/(2 − ∛2) the substeps are w, −∛2 w, w: their sum is 1, and the sum of their cubes,
/// which multiplies the leading error, is 0. Order 4, symplectic, symmetric, three force
/// evaluations a step. Also called Yoshida's method of order 4, or the triple jump. E. Forest, R.
/// D. Ruth: Fourth-order symplectic integration, *Physica D* 43 (1990), 105–117,
/// doi:10.1016/0167-2789(90)90019-L; H. Yoshida, *Physics Letters A* 150 (1990), 262–268.
#[derive(Clone, Copy, Debug, Default)]
pub struct ForestRuth;

impl Info for ForestRuth {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Forest–Ruth",
            aliases: &["Yoshida 4", "the triple jump"],
            symplectic: true,
            symmetric: true,
            force_evaluations: 3,
            start_evaluations: 1,
            reference: "E. Forest, R. D. Ruth, Physica D 43 (1990) 105",
            ..MethodInfo::new("forest-ruth", 4)
        }
    }
}

/// ∛2.
const CUBE_ROOT: f64 = 1.259_921_049_894_873_2;
const OUTER: f64 = 1.0 / (2.0 - CUBE_ROOT);
// ANCHOR: table
const SUBSTEPS: [f64; 3] = [OUTER, -CUBE_ROOT * OUTER, OUTER];

impl Splitting for ForestRuth {
    const KICKS: &'static [f64] = &kicks::<3, 4>(SUBSTEPS);
    const DRIFTS: &'static [f64] = &SUBSTEPS;
}
// ANCHOR_END: table
