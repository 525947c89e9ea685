//! Yoshida's symplectic method of order 6.

use crate::methods::splitting::{Splitting, kicks, palindrome};
use crate::methods::{Info, MethodInfo};

/// Yoshida's method of order 6: seven steps of Störmer–Verlet.
///
/// Order 6, symplectic, symmetric, seven force evaluations a step. H. Yoshida: Construction of
/// higher order symplectic integrators, *Physics Letters A* 150 (1990), 262–268,
/// doi:10.1016/0375-9601(90)90092-3, Table 1, solution A; the digits beyond the fourteen printed
/// there solve the same conditions.
#[derive(Clone, Copy, Debug, Default)]
pub struct Yoshida6;

impl Info for Yoshida6 {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Yoshida 6",
            aliases: &["Yoshida’s solution A of order 6"],
            symplectic: true,
            symmetric: true,
            force_evaluations: 7,
            start_evaluations: 1,
            reference: "H. Yoshida, Phys. Lett. A 150 (1990) 262, Table 1, A",
            ..MethodInfo::new("yoshida-6", 6)
        }
    }
}

const SUBSTEPS: [f64; 7] = palindrome::<3, 7>(
    [0.784_513_610_477_557_3, 0.235_573_213_359_358_13, -1.177_679_984_178_871],
    1.315_186_320_683_911_2,
);

impl Splitting for Yoshida6 {
    const KICKS: &'static [f64] = &kicks::<7, 8>(SUBSTEPS);
    const DRIFTS: &'static [f64] = &SUBSTEPS;
}
