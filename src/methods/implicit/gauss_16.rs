//! The Gauss method of eight stages.

use crate::methods::implicit::ImplicitTableau;
use crate::methods::{Info, MethodInfo};

/// The Gauss method of eight stages: collocation at the zeros of a Legendre polynomial.
///
/// Order 16, symplectic for every Hamiltonian system, separable or not, symmetric; a step evaluates
/// the force at each stage in each sweep, and once to begin. Hairer, Lubich, Wanner, *Geometric
/// Numerical Integration*, Sects. II.1.3 and VIII.6. Also called Gauss–Legendre or
/// Kuntzmann–Butcher.
#[derive(Clone, Copy, Debug, Default)]
pub struct Gauss16;

impl Info for Gauss16 {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Gauss 16",
            aliases: &["Kuntzmann–Butcher 16"],
            symplectic: true,
            symmetric: true,
            implicit: true,
            force_evaluations: 8,
            reference: "Hairer, Lubich, Wanner (2006), Sect. II.1.3",
            ..MethodInfo::new("gauss-16", 16)
        }
    }
}

impl Gauss16 {
    /// The coefficients, computed with 60 digits from the zeros of the Legendre polynomial of
    /// degree 8.
    pub const TABLEAU: ImplicitTableau<8> = ImplicitTableau::symplectic(
        [
            -0.081_894_963_105_581_5,
            0.040_042_703_777_945_055,
            -0.024_721_345_803_200_376,
            0.016_976_173_236_371_093,
            -0.012_225_914_113_298_207,
            0.008_748_566_769_197_368,
            -0.005_482_808_253_215_883,
            -0.086_958_924_300_832_73,
            0.044_941_126_302_625_686,
            -0.028_759_775_474_749_31,
            0.020_017_127_636_408_71,
            -0.014_074_355_889_166_93,
            0.008_748_566_769_197_368,
            -0.088_093_838_732_308_32,
            0.046_165_464_814_800_036,
            -0.029_603_873_064_977_94,
            0.020_017_127_636_408_71,
            -0.012_225_914_113_298_207,
            -0.088_347_161_109_827_78,
            0.046_165_464_814_800_036,
            -0.028_759_775_474_749_31,
            0.016_976_173_236_371_093,
            -0.088_093_838_732_308_32,
            0.044_941_126_302_625_686,
            -0.024_721_345_803_200_376,
            -0.086_958_924_300_832_73,
            0.040_042_703_777_945_055,
            -0.081_894_963_105_581_5,
        ],
        [
            0.050_614_268_145_188_13,
            0.111_190_517_226_687_24,
            0.156_853_322_938_943_63,
            0.181_341_891_689_181,
            0.181_341_891_689_181,
            0.156_853_322_938_943_63,
            0.111_190_517_226_687_24,
            0.050_614_268_145_188_13,
        ],
        [
            0.019_855_071_751_231_884,
            0.101_666_761_293_186_64,
            0.237_233_795_041_835_5,
            0.408_282_678_752_175_1,
            0.591_717_321_247_825,
            0.762_766_204_958_164_5,
            0.898_333_238_706_813_4,
            0.980_144_928_248_768_1,
        ],
    );
}
