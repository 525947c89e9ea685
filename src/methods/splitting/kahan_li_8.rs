//! Kahan and Li's symplectic method of order 8.

use crate::methods::splitting::{Splitting, kicks, palindrome};
use crate::methods::{Info, MethodInfo};

/// Kahan and Li's method of order 8: seventeen short steps of Störmer–Verlet, where fifteen long
/// ones would suffice.
///
/// Order 8, symplectic, symmetric, seventeen force evaluations a step. W. Kahan, R.-C. Li:
/// Composition constants for raising the orders of unconventional schemes for ordinary differential
/// equations, *Mathematics of Computation* 66 (1997), 1089–1099, doi:10.1090/S0025-5718-97-00873-9,
/// s17odr8a; Hairer, Lubich, Wanner, *Geometric Numerical Integration*, Sect. V.3.2.
#[derive(Clone, Copy, Debug, Default)]
pub struct KahanLi8;

impl Info for KahanLi8 {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Kahan–Li 8",
            aliases: &["s17odr8a"],
            symplectic: true,
            symmetric: true,
            force_evaluations: 17,
            start_evaluations: 1,
            reference: "W. Kahan, R.-C. Li, Math. Comp. 66 (1997) 1089; Hairer, Lubich, Wanner \
                        (2006), Eq. V.3.14",
            ..MethodInfo::new("kahan-li-8", 8)
        }
    }
}

const SUBSTEPS: [f64; 17] = palindrome::<8, 17>(
    [
        0.130_202_483_088_890_07,
        0.561_162_981_775_108_4,
        -0.389_474_962_644_847_27,
        0.158_841_906_555_155_6,
        -0.395_903_894_133_237_57,
        0.184_539_640_978_315_7,
        0.258_374_387_686_322_04,
        0.295_011_723_609_310_3,
    ],
    -0.605_508_533_830_034_6,
);

impl Splitting for KahanLi8 {
    const KICKS: &'static [f64] = &kicks::<17, 18>(SUBSTEPS);
    const DRIFTS: &'static [f64] = &SUBSTEPS;
}
