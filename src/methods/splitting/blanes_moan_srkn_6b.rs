//! Blanes and Moan's symplectic Runge–Kutta–Nyström method of order 4.

use crate::methods::splitting::Splitting;
use crate::methods::{Info, MethodInfo};

/// Blanes and Moan's method of order 4, made for forces that do not depend on the velocity: six
/// stages, where three would suffice, for a small error.
///
/// Where the kinetic energy is quadratic, the leading error, of order 5, has fewer terms than for
/// other splittings, and three parameters are chosen so that those are small. On other splittings
/// it is of order 4 as well. Order 4, symplectic, symmetric, six force evaluations a step. The
/// coefficients are the nearest to those printed that meet the order conditions beyond the printed
/// digits. S. Blanes, P. C. Moan: Practical symplectic partitioned Runge–Kutta and
/// Runge–Kutta–Nyström methods, *Journal of Computational and Applied Mathematics* 142 (2002),
/// 313–330, doi:10.1016/S0377-0427(01)00492-7, Table 3, the six-stage method that begins with a
/// kick.
#[derive(Clone, Copy, Debug, Default)]
pub struct BlanesMoanSrkn6b;

impl Info for BlanesMoanSrkn6b {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Blanes–Moan SRKN₆ᵇ",
            aliases: &["SRKN 6b", "RKN4b"],
            symplectic: true,
            symmetric: true,
            force_evaluations: 6,
            start_evaluations: 1,
            reference: "S. Blanes, P. C. Moan, J. Comput. Appl. Math. 142 (2002) 313, Table 3",
            ..MethodInfo::new("blanes-moan-srkn-6b", 4)
        }
    }
}

const B1: f64 = 0.082_984_406_417_404_94;
const B2: f64 = 0.396_309_801_498_367_86;
const B3: f64 = -0.039_056_304_922_348_31;
const B4: f64 = 1.0 - 2.0 * (B1 + B2 + B3);
const A1: f64 = 0.245_298_957_184_271_05;
const A2: f64 = 0.604_872_665_711_08;
const A3: f64 = 0.5 - (A1 + A2);

impl Splitting for BlanesMoanSrkn6b {
    const KICKS: &'static [f64] = &[B1, B2, B3, B4, B3, B2, B1];
    const DRIFTS: &'static [f64] = &[A1, A2, A3, A3, A2, A1];
}
