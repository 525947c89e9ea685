//! Blanes and Moan's symplectic method of order 4.

use crate::methods::splitting::Splitting;
use crate::methods::{Info, MethodInfo};

/// Blanes and Moan's method of order 4: six stages, where three would suffice, for a small error.
///
/// Order 4, symplectic, symmetric, six force evaluations a step. Three parameters are free, and are
/// chosen so that the leading error, of order 5, is small. S. Blanes, P. C. Moan: Practical
/// symplectic partitioned Runge–Kutta and Runge–Kutta–Nyström methods, *Journal of Computational
/// and Applied Mathematics* 142 (2002), 313–330, doi:10.1016/S0377-0427(01)00492-7, Table 2, S₆.
#[derive(Clone, Copy, Debug, Default)]
pub struct BlanesMoan4;

impl Info for BlanesMoan4 {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Blanes–Moan 4",
            aliases: &["S₆"],
            symplectic: true,
            symmetric: true,
            force_evaluations: 6,
            start_evaluations: 1,
            reference: "S. Blanes, P. C. Moan, J. Comput. Appl. Math. 142 (2002) 313, Table 2",
            ..MethodInfo::new("blanes-moan-4", 4)
        }
    }
}

const B1: f64 = 0.079_203_696_431_195_7;
const B2: f64 = 0.353_172_906_049_774;
const B3: f64 = -0.042_065_080_357_719_5;
const B4: f64 = 1.0 - 2.0 * (B1 + B2 + B3);
const A1: f64 = 0.209_515_106_613_362;
const A2: f64 = -0.143_851_773_179_818;
const A3: f64 = 0.5 - (A1 + A2);

impl Splitting for BlanesMoan4 {
    const KICKS: &'static [f64] = &[B1, B2, B3, B4, B3, B2, B1];
    const DRIFTS: &'static [f64] = &[A1, A2, A3, A3, A2, A1];
}
