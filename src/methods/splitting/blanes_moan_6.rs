//! Blanes and Moan's symplectic Runge–Kutta–Nyström method of order 6.

use crate::methods::splitting::{Splitting, palindrome};
use crate::methods::{Info, MethodInfo};

/// Blanes and Moan's method of order 6 for forces that do not depend on the velocity.
///
/// Because the kinetic energy is quadratic, some of the conditions for order 6 hold automatically,
/// which leaves parameters free to make the error small. Order 6, symplectic, symmetric, eleven
/// force evaluations a step. S. Blanes, P. C. Moan: Practical symplectic partitioned Runge–Kutta
/// and Runge–Kutta–Nyström methods, *Journal of Computational and Applied Mathematics* 142 (2002),
/// 313–330, doi:10.1016/S0377-0427(01)00492-7, Table 3, the eleven-stage method that begins with a
/// kick.
#[derive(Clone, Copy, Debug, Default)]
pub struct BlanesMoan6;

impl Info for BlanesMoan6 {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Blanes–Moan 6",
            aliases: &["SRKN 11b"],
            symplectic: true,
            symmetric: true,
            force_evaluations: 11,
            start_evaluations: 1,
            reference: "S. Blanes, P. C. Moan, J. Comput. Appl. Math. 142 (2002) 313, Table 3",
            ..MethodInfo::new("blanes-moan-6", 6)
        }
    }
}

const B: [f64; 5] = [
    0.041_464_998_518_262_4,
    0.198_128_671_918_067,
    -0.040_006_192_104_153_3,
    0.075_253_984_301_580_7,
    -0.011_511_387_420_687_9,
];
const B6: f64 = 0.5 - (B[0] + B[1] + B[2] + B[3] + B[4]);
const A: [f64; 5] = [
    0.123_229_775_946_271,
    0.290_553_797_799_558,
    -0.127_049_212_625_417,
    -0.246_331_761_062_075,
    0.357_208_872_795_928,
];
const A6: f64 = 1.0 - 2.0 * (A[0] + A[1] + A[2] + A[3] + A[4]);

impl Splitting for BlanesMoan6 {
    const KICKS: &'static [f64] =
        &[B[0], B[1], B[2], B[3], B[4], B6, B6, B[4], B[3], B[2], B[1], B[0]];
    const DRIFTS: &'static [f64] = &palindrome::<5, 11>(A, A6);
}
