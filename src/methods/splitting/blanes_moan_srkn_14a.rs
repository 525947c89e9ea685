//! Blanes and Moan's symplectic Runge–Kutta–Nyström method of order 6 that begins with a drift.

use crate::methods::splitting::{Splitting, palindrome};
use crate::methods::{Info, MethodInfo};

/// Blanes and Moan's method of order 6 for forces that do not depend on the velocity, with fourteen
/// stages: three more than [`BlanesMoan6`](crate::methods::BlanesMoan6) has, for an error so much
/// smaller that its steps may be longer.
///
/// Order 6, symplectic, symmetric. It begins and ends with a drift, so that a step has fourteen
/// kicks, and fourteen force evaluations. The coefficients are the nearest to those printed that
/// meet the order conditions beyond the printed digits. S. Blanes, P. C. Moan: Practical symplectic
/// partitioned Runge–Kutta and Runge–Kutta–Nyström methods, *Journal of Computational and Applied
/// Mathematics* 142 (2002), 313–330, doi:10.1016/S0377-0427(01)00492-7, Table 3, the fourteen-stage
/// method that begins with a drift.
#[derive(Clone, Copy, Debug, Default)]
pub struct BlanesMoanSrkn14a;

impl Info for BlanesMoanSrkn14a {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Blanes–Moan SRKN₁₄ᵃ",
            aliases: &["SRKN 14a", "RKN6a"],
            symplectic: true,
            symmetric: true,
            force_evaluations: 14,
            reference: "S. Blanes, P. C. Moan, J. Comput. Appl. Math. 142 (2002) 313, Table 3",
            ..MethodInfo::new("blanes-moan-srkn-14a", 6)
        }
    }
}

const A: [f64; 7] = [
    0.037_859_319_840_610_965,
    0.102_635_633_102_436_44,
    -0.025_867_888_266_558_163,
    0.314_241_403_071_446_3,
    -0.130_144_459_517_415_2,
    0.106_417_700_369_541_33,
    -0.008_794_243_128_510_227,
];
const A8: f64 = 1.0 - 2.0 * (A[0] + A[1] + A[2] + A[3] + A[4] + A[5] + A[6]);
const B: [f64; 6] = [
    0.091_719_152_624_462_02,
    0.183_983_170_005_005_03,
    -0.056_534_365_832_889_4,
    0.004_914_688_774_711_884,
    0.143_761_127_168_361_67,
    0.328_567_693_746_804_1,
];
const B7: f64 = 0.5 - (B[0] + B[1] + B[2] + B[3] + B[4] + B[5]);

impl Splitting for BlanesMoanSrkn14a {
    const KICKS: &'static [f64] =
        &[0.0, B[0], B[1], B[2], B[3], B[4], B[5], B7, B7, B[5], B[4], B[3], B[2], B[1], B[0], 0.0];
    const DRIFTS: &'static [f64] = &palindrome::<7, 15>(A, A8);
}
