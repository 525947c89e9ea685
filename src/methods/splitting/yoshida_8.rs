//! Yoshida's symplectic method of order 8.

use crate::methods::splitting::{Splitting, kicks, palindrome};
use crate::methods::{Info, MethodInfo};

/// Yoshida's method of order 8: fifteen steps of Störmer–Verlet, some of them almost twice as long
/// as the whole step.
///
/// Order 8, symplectic, symmetric, fifteen force evaluations a step. H. Yoshida: Construction of
/// higher order symplectic integrators, *Physics Letters A* 150 (1990), 262–268,
/// doi:10.1016/0375-9601(90)90092-3, Table 2, solution D. The fifteen-digit values commonly used
/// are right to 3·10⁻¹³; these solve the same conditions to the last digit.
#[derive(Clone, Copy, Debug, Default)]
pub struct Yoshida8;

impl Info for Yoshida8 {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Yoshida 8",
            aliases: &["Yoshida’s solution D of order 8"],
            symplectic: true,
            symmetric: true,
            force_evaluations: 15,
            start_evaluations: 1,
            reference: "H. Yoshida, Phys. Lett. A 150 (1990) 262, Table 2, D",
            ..MethodInfo::new("yoshida-8", 8)
        }
    }
}

const SUBSTEPS: [f64; 15] = palindrome::<7, 15>(
    [
        0.914_844_246_229_791_5,
        0.253_693_336_566_211_35,
        -1.444_852_236_860_605_2,
        -0.158_240_635_368_050_16,
        1.938_139_137_622_525_9,
        -1.960_610_232_975_310_8,
        0.102_799_849_391_796_44,
    ],
    1.708_453_070_787_281_6,
);

impl Splitting for Yoshida8 {
    const KICKS: &'static [f64] = &kicks::<15, 16>(SUBSTEPS);
    const DRIFTS: &'static [f64] = &SUBSTEPS;
}
