//! The Gauss method of eight stages.

use crate::integrate::{Method, Unsolved};
use crate::methods::implicit::{ImplicitTableau, Iteration};
use crate::methods::{Info, MethodInfo};
use crate::systems::{Measurable, System};

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
            name: "gauss-16",
            title: "Gauss 16",
            aliases: &["Kuntzmann–Butcher 16"],
            order: 16,
            symplectic: true,
            symmetric: true,
            implicit: true,
            force_evaluations: 8,
            start_evaluations: 0,
            reference: "Hairer, Lubich, Wanner (2006), Sect. II.1.3",
        }
    }
}

impl Gauss16 {
    /// The coefficients, computed with 60 digits from the zeros of the Legendre polynomial of
    /// degree 8.
    pub const TABLEAU: ImplicitTableau<8> = ImplicitTableau {
        a: [
            [
                0.025_307_134_072_594_065,
                -0.009_105_943_305_970_076,
                0.006_280_831_147_030_474,
                -0.004_483_015_613_054_752,
                0.003_078_491_368_326_779_7,
                -0.001_917_675_254_636_952_3,
                0.000_972_757_664_059_263_5,
                -0.000_277_508_327_116_919_2,
            ],
            [
                0.054_759_321_767_554_32,
                0.055_595_258_613_343_62,
                -0.013_639_796_235_781_67,
                0.008_149_708_858_360_551,
                -0.005_215_352_089_147_153_6,
                0.003_139_752_985_463_669,
                -0.001_564_934_910_948_942_4,
                0.000_442_802_304_342_237_83,
            ],
            [
                0.048_587_535_998_912_884,
                0.120_859_524_997_173_17,
                0.078_426_661_469_471_82,
                -0.015_975_103_361_878_43,
                0.008_371_732_720_226_163,
                -0.004_643_465_862_104_48,
                0.002_225_714_775_284_9,
                -0.000_618_805_695_250_515_4,
            ],
            [
                0.051_865_520_970_581_23,
                0.106_193_490_148_348_4,
                0.170_671_134_274_553_63,
                0.090_670_945_844_590_5,
                -0.016_021_041_321_025_012,
                0.007_241_206_561_222_27,
                -0.003_197_814_310_360_770_3,
                0.000_859_236_584_264_852_7,
            ],
            [
                0.049_755_031_560_923_28,
                0.114_388_331_537_048,
                0.149_612_116_377_721_37,
                0.197_362_933_010_206,
                0.090_670_945_844_590_5,
                -0.013_817_811_335_609_978,
                0.004_997_027_078_338_829,
                -0.001_251_252_825_393_105,
            ],
            [
                0.051_233_073_840_438_646,
                0.108_964_802_451_402_33,
                0.161_496_788_801_048_12,
                0.172_970_158_968_954_82,
                0.197_316_995_051_059_43,
                0.078_426_661_469_471_82,
                -0.009_669_007_770_485_932,
                0.002_026_732_146_275_248_7,
            ],
            [
                0.050_171_465_840_845_89,
                0.112_755_452_137_636_17,
                0.153_713_569_953_479_98,
                0.186_557_243_778_328_14,
                0.173_192_182_830_820_44,
                0.170_493_119_174_725_32,
                0.055_595_258_613_343_62,
                -0.004_145_053_622_366_191,
            ],
            [
                0.050_891_776_472_305_05,
                0.110_217_759_562_627_97,
                0.158_770_998_193_580_6,
                0.178_263_400_320_854_22,
                0.185_824_907_302_235_75,
                0.150_572_491_791_913_18,
                0.120_296_460_532_657_31,
                0.025_307_134_072_594_065,
            ],
        ],
        b: [
            0.050_614_268_145_188_13,
            0.111_190_517_226_687_24,
            0.156_853_322_938_943_63,
            0.181_341_891_689_181,
            0.181_341_891_689_181,
            0.156_853_322_938_943_63,
            0.111_190_517_226_687_24,
            0.050_614_268_145_188_13,
        ],
        c: [
            0.019_855_071_751_231_884,
            0.101_666_761_293_186_64,
            0.237_233_795_041_835_5,
            0.408_282_678_752_175_1,
            0.591_717_321_247_825,
            0.762_766_204_958_164_5,
            0.898_333_238_706_813_4,
            0.980_144_928_248_768_1,
        ],
    };
}

impl<S: System<State: Measurable>> Method<S> for Gauss16 {
    type Carry = ();

    fn start(&self, _system: &S, _t: f64, _h: f64, _z: S::State) {}

    #[inline(always)]
    fn step(&self, system: &S, t: f64, h: f64, z: S::State, _carry: &mut ()) -> S::State {
        Self::TABLEAU.step(system, t, h, z)
    }

    #[inline(always)]
    fn try_step(
        &self,
        system: &S,
        t: f64,
        h: f64,
        z: S::State,
        _carry: &mut (),
    ) -> Result<S::State, Unsolved> {
        Self::TABLEAU.try_step(system, t, h, z, Iteration::TO_ROUNDING)
    }
}
