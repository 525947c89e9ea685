//! Dormand and Prince's method of order 8, in Hairer and Wanner's version.

#![allow(
    clippy::excessive_precision,
    reason = "all digits of the source: tests need them, an f64 drops them"
)]

use super::embedded::{Embedded, hermite};
use super::tableau::{Coefficient, Row, Tableau, coefficient, row, tableau};
use crate::integrate::Method;
use crate::methods::{Info, MethodInfo};
use crate::systems::{RateOf, System, Vector};

/// Dormand–Prince 8(5,3): twelve slopes for a step of order 8, two error estimates, dense output of
/// order 7.
///
/// Order 8, not symplectic, not symmetric, twelve force evaluations a step; dense output takes
/// three more. Also called DOP853, Hairer's 8(5,3). The estimates are those of dop853.f and one
/// more, which holds where the first vanishes by chance.
///
/// With a tolerance the largest error of a step was 130 tolerances in 1.6 million random steps of
/// pendulums of all kinds, and above 10 in one of 10 000; with the estimates of dop853.f it was
/// 4800 in 0.6 million. Hairer, Nørsett, Wanner, *Solving Ordinary
/// Differential Equations I* (1993), Sects. II.5, II.6 and II.10; the coefficients are those of the
/// authors' program dop853.f.
#[derive(Clone, Copy, Debug, Default)]
pub struct Dop853;

impl Info for Dop853 {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "DOP853",
            aliases: &["Dormand–Prince 8(5,3)", "Hairer's 8(5,3)"],
            force_evaluations: 12,
            reference: "Hairer, Nørsett, Wanner (1993), Sects. II.5 and II.10",
            ..MethodInfo::new("dop853", 8)
        }
    }
}

impl<S: System> Method<S> for Dop853 {
    type Carry = ();

    const REACH: f64 = STEP.reach();
    const IS_LONG: bool = true;

    fn start(&self, _system: &S, _t: f64, _h: f64, _z: S::State) {}

    #[inline(always)]
    fn step(&self, system: &S, t: f64, h: f64, z: S::State, _carry: &mut ()) -> S::State {
        let stages = Stages::evaluate(system, t, h, z, [system.rate(t, z)]);
        z + stages.step() * h
    }
}

impl Embedded for Dop853 {
    /// The first estimate, O(h⁶), is divided by √(1 + 0.01 q²), where q is the ratio of the second,
    /// O(h⁴), to the first. The quotient is O(h⁸); the error of the step itself is O(h⁹).
    const ESTIMATE_ORDER: u32 = 8;

    type Stages<D: Vector> = Stages<D>;
    type Dense<D: Vector> = [D; 7];

    #[inline(always)]
    fn attempt<S: System>(
        &self,
        system: &S,
        t: f64,
        h: f64,
        z: S::State,
        slope: RateOf<S>,
    ) -> (S::State, Stages<RateOf<S>>) {
        let stages = Stages::evaluate(system, t, h, z, [slope]);
        (z + stages.step() * h, stages)
    }

    /// ‖e₅‖² / √(‖e₅‖² + 0.01 ‖e₃‖²), where e₅ and e₃ are the differences from embedded methods of
    /// order 5 and 3 (Hairer, Nørsett, Wanner, Sect. II.10).
    ///
    /// The leading term of e₅ passes through zero on some steps, and the estimate with it. A second
    /// difference of the same order has a leading term that cannot vanish with the first's; so
    /// ‖e₅‖ is here the size of the first, as in dop853.f, or half that of the second if that is
    /// larger. It costs no evaluation, and one step more in 400.
    #[inline]
    fn error<D: Vector>(&self, stages: &Stages<D>, size: impl Fn(D) -> f64) -> f64 {
        let fifth = libm::fmax(size(stages.fifth()), 0.5 * size(stages.other_fifth()));
        let third = size(stages.step() + stages.third() * -1.0);
        if fifth == 0.0 {
            0.0
        } else {
            fifth * fifth / libm::sqrt(fifth * fifth + 0.01 * third * third)
        }
    }

    fn end_slope<S: System>(
        &self,
        system: &S,
        t: f64,
        z: S::State,
        _stages: &Stages<RateOf<S>>,
    ) -> RateOf<S> {
        system.rate(t, z)
    }

    fn dense<S: System>(
        &self,
        system: &S,
        t: f64,
        h: f64,
        z: S::State,
        stages: &Stages<RateOf<S>>,
        end_slope: RateOf<S>,
    ) -> [RateOf<S>; 7] {
        let Stages { k1, k6, k7, k8, k9, k10, k11, k12, .. } = *stages;
        let [first, second, third] = hermite(stages.step() * h, k1 * h, end_slope * h);
        let more = More::evaluate(system, t, h, z, [k1, k6, k7, k8, k9, k10, k11, k12, end_slope]);
        let [fourth, fifth] = [more.fourth() * h, more.fifth() * h];
        [first, second, third, fourth, fifth, more.sixth() * h, more.seventh() * h]
    }
}

tableau! {
    /// The twelve stages of a step, its weights and those of its error estimates.
    Stages, STEP, from [k1];
    stages {
        k2 at 5.260_015_195_876_773_187_855_875_444_88e-2 => {
            k1: 5.260_015_195_876_773_187_855_875_444_88e-2,
        }
        k3 at 7.890_022_793_815_159_781_783_813_167_32e-2 => {
            k1: 1.972_505_698_453_789_945_445_953_291_83e-2,
            k2: 5.917_517_095_361_369_836_337_859_875_49e-2,
        }
        k4 at 1.183_503_419_072_273_967_267_571_975_10e-1 => {
            k1: 2.958_758_547_680_684_918_168_929_937_75e-2,
            k3: 8.876_275_643_042_054_754_506_789_813_24e-2,
        }
        k5 at 2.816_496_580_927_726_032_732_428_024_90e-1 => {
            k1: 2.413_651_341_592_666_855_023_697_986_65e-1,
            k3: -8.845_494_793_282_860_853_448_649_627_17e-1,
            k4: 9.248_340_032_617_920_031_157_379_665_43e-1,
        }
        k6 at 1.0 / 3.0 => {
            k1: 3.703_703_703_703_703_703_703_703_703_7e-2,
            k4: 1.708_286_087_294_738_712_796_044_821_73e-1,
            k5: 1.254_676_875_668_224_250_166_918_141_23e-1,
        }
        k7 at 1.0 / 4.0 => {
            k1: 3.710_937_5e-2,
            k4: 1.702_522_110_195_440_393_149_780_602_72e-1,
            k5: 6.021_653_898_045_596_068_502_193_972_83e-2,
            k6: -1.757_812_5e-2,
        }
        k8 at 4.0 / 13.0 => {
            k1: 3.709_200_011_850_479_271_087_793_198_36e-2,
            k4: 1.703_839_257_122_399_938_102_140_547_05e-1,
            k5: 1.072_620_304_463_732_846_518_091_991_68e-1,
            k6: -1.531_943_774_862_440_175_279_361_582_36e-2,
            k7: 8.273_789_163_814_022_887_584_737_660_02e-3,
        }
        k9 at 6.512_820_512_820_512_820_512_820_512_82e-1 => {
            k1: 6.241_109_587_160_757_171_144_295_778_12e-1,
            k4: -3.360_892_629_446_941_294_068_571_098_25,
            k5: -8.682_193_468_417_260_068_181_898_914_53e-1,
            k6: 2.759_209_969_944_670_830_494_156_007_97e1,
            k7: 2.015_406_755_047_789_340_861_867_889_79e1,
            k8: -4.348_988_418_106_995_884_773_662_551_44e1,
        }
        k10 at 3.0 / 5.0 => {
            k1: 4.776_625_364_382_643_658_904_339_085_27e-1,
            k4: -2.488_114_619_971_667_641_926_425_864_68,
            k5: -5.902_908_268_368_429_963_714_464_757_43e-1,
            k6: 2.123_005_144_818_119_423_472_889_498_97e1,
            k7: 1.527_923_363_288_242_358_325_969_229_38e1,
            k8: -3.328_821_096_898_486_291_944_532_655_87e1,
            k9: -2.033_120_170_850_862_613_582_229_285_93e-2,
        }
        k11 at 6.0 / 7.0 => {
            k1: -9.371_424_300_859_873_257_170_402_165_8e-1,
            k4: 5.186_372_428_844_063_708_300_238_532_09,
            k5: 1.091_437_348_996_729_578_185_002_546_54,
            k6: -8.149_787_010_746_926_125_139_972_673_57,
            k7: -1.852_006_565_999_695_986_415_661_807_01e1,
            k8: 2.273_948_709_935_050_428_189_700_567_34e1,
            k9: 2.493_605_552_679_652_389_870_893_967_62,
            k10: -3.046_764_471_898_219_500_382_366_902_2,
        }
        k12 at 1.0 => {
            k1: 2.273_310_147_516_538_207_923_597_684_49,
            k4: -1.053_449_546_673_725_019_840_666_898_79e1,
            k5: -2.000_872_058_224_862_499_096_757_184_44,
            k6: -1.795_893_186_311_879_891_727_659_505_34e1,
            k7: 2.794_888_452_941_996_005_084_998_088_37e1,
            k8: -2.858_998_277_135_023_694_740_655_086_74,
            k9: -8.872_856_933_530_629_544_335_492_892_58,
            k10: 1.236_056_717_579_430_306_472_662_015_28e1,
            k11: 6.433_927_460_157_635_303_559_704_840_46e-1,
        }
    }
    sums {
        /// The step of order 8, over h.
        step => {
            k1: 5.429_373_411_656_876_223_805_357_663_63e-2,
            k6: 4.450_312_892_752_408_881_441_139_505_66,
            k7: 1.891_517_899_314_500_383_042_815_990_44,
            k8: -5.801_203_960_010_584_781_467_211_422_7,
            k9: 3.111_643_669_578_198_944_089_160_623_7e-1,
            k10: -1.521_609_496_625_160_785_561_788_068_05e-1,
            k11: 2.013_654_008_040_303_483_747_765_375_01e-1,
            k12: 4.471_061_572_777_259_051_768_855_690_43e-2,
        }
        /// The step of the embedded method of order 3, over h.
        third => {
            k1: 2.440_944_881_889_763_779_527_559_055_12e-1,
            k9: 7.338_466_882_816_118_573_413_617_415_47e-1,
            k12: 2.205_882_352_941_176_470_588_235_294_12e-2,
        }
        /// The difference from the step of the embedded method of order 5, over h.
        fifth => {
            k1: 1.312_004_499_419_488_073_250_102_996e-2,
            k6: -1.225_156_446_376_204_440_720_569_753,
            k7: -4.957_589_496_572_501_915_214_079_952e-1,
            k8: 1.664_377_182_454_986_536_961_530_415,
            k9: -3.503_288_487_499_736_816_886_487_290e-1,
            k10: 3.341_791_187_130_174_790_297_318_841e-1,
            k11: 8.192_320_648_511_571_246_570_742_613e-2,
            k12: -2.235_530_786_388_629_525_884_427_845e-2,
        }
        /// Another such difference, over h. Those of order 5 from the stages of the step are three,
        /// linearly independent, and one of them is of order 6. This is the one whose error terms
        /// of order 6 are orthogonal to those of the first, each weighted by 1/σ of its tree, and
        /// of the same size; of these, the one with the smallest weights. (Computed with 40 digits
        /// from the order conditions.)
        other_fifth => {
            k1: 2.165_756_247_538_932_985_599_477_906_4e-2,
            k6: 2.879_296_166_195_582_470_903_128_688_9e-1,
            k7: -4.688_009_795_612_844_479_514_078_030_2e-1,
            k8: 3.717_616_063_560_690_964_789_417_494_6e-1,
            k9: 1.241_891_375_052_300_307_256_924_154_5,
            k10: -1.324_212_051_799_985_256_435_369_674_3,
            k11: -1.593_782_221_816_809_175_822_966_894_9e-1,
            k12: 2.915_109_303_963_364_128_690_061_485_7e-2,
        }
    }
}

tableau! {
    /// The three more stages that dense output needs, after k13 = f(t + h, z + h · step), and its
    /// weights.
    More, DENSE, from [k1, k6, k7, k8, k9, k10, k11, k12, k13];
    stages {
        k14 at 1.0 / 10.0 => {
            k1: 5.616_750_228_304_795_233_929_092_196_81e-2,
            k7: 2.535_002_102_166_248_110_887_947_653_33e-1,
            k8: -2.462_390_374_708_024_899_174_414_754_41e-1,
            k9: -1.241_914_232_638_163_604_690_101_406_26e-1,
            k10: 1.532_917_982_787_656_973_120_632_268_5e-1,
            k11: 8.201_052_295_634_689_884_916_666_020_57e-3,
            k12: 7.567_897_660_545_699_761_386_035_895_84e-3,
            k13: -8.298e-3,
        }
        k15 at 1.0 / 5.0 => {
            k1: 3.183_464_816_350_214_050_607_684_732_61e-2,
            k6: 2.830_090_967_236_677_552_883_229_614_02e-2,
            k7: 5.354_198_830_743_856_762_237_973_843_72e-2,
            k8: -5.492_374_857_139_098_846_465_693_403_06e-2,
            k11: -1.083_473_286_972_493_228_585_093_169_94e-4,
            k12: 3.825_710_908_356_584_129_549_201_923_23e-4,
            k13: -3.404_650_086_874_045_608_029_771_144_92e-4,
            k14: 1.413_124_436_746_325_002_780_746_183_66e-1,
        }
        k16 at 7.0 / 9.0 => {
            k1: -4.288_963_015_837_919_234_085_735_386_92e-1,
            k6: -4.697_621_415_361_163_843_144_494_472_06,
            k7: 7.683_421_196_062_599_041_842_409_538_78,
            k8: 4.068_989_818_397_110_079_702_135_543_31,
            k9: 3.567_271_874_552_811_092_706_695_430_21e-1,
            k13: -1.399_024_165_159_014_621_294_180_097_34e-3,
            k14: 2.947_514_789_152_772_338_955_627_214_9,
            k15: -9.150_958_472_179_870_010_818_701_871_38,
        }
    }
    sums {
        /// The fourth coefficient of the dense output, over h.
        fourth => {
            k1: -8.428_938_276_109_012_865_135_349_114_2,
            k6: 5.667_149_535_193_777_696_253_178_359_0e-1,
            k7: -3.068_949_945_949_891_691_279_730_472_7,
            k8: 2.384_667_656_512_069_828_772_814_968_0,
            k9: 2.117_034_582_445_028_276_715_514_994_6,
            k10: -8.713_915_837_779_729_920_678_990_749_0e-1,
            k11: 2.240_437_430_260_788_275_854_177_165_0,
            k12: 6.315_787_787_694_688_181_557_024_929_0e-1,
            k13: -8.899_033_645_133_331_082_069_811_740_0e-2,
            k14: 1.814_850_552_085_472_725_665_640_496_2e1,
            k15: -9.194_632_392_478_355_400_045_198_443_6,
            k16: -4.436_036_387_594_893_966_431_057_200_0,
        }
        /// The fifth coefficient of the dense output, over h.
        fifth => {
            k1: 1.042_750_864_257_913_460_341_315_100_9e1,
            k6: 2.422_834_917_752_581_828_843_017_531_9e2,
            k7: 1.652_004_517_172_702_819_850_539_488_7e2,
            k8: -3.745_467_547_226_902_027_951_831_215_2e2,
            k9: -2.211_366_685_312_530_603_627_093_857_8e1,
            k10: 7.733_432_668_472_263_838_960_389_880_8,
            k11: -3.067_408_473_108_939_818_206_121_362_6e1,
            k12: -9.332_130_526_430_227_872_956_722_170_6,
            k13: 1.569_723_812_177_084_388_613_109_107_5e1,
            k14: -3.113_940_321_956_517_767_728_285_041_1e1,
            k15: -9.352_924_358_844_478_386_571_386_266_4,
            k16: 3.581_684_148_639_408_375_246_589_854_0e1,
        }
        /// The sixth coefficient of the dense output, over h.
        sixth => {
            k1: 1.998_505_324_200_243_382_098_765_361_7e1,
            k6: -3.870_373_087_493_517_655_510_590_174_2e2,
            k7: -1.891_781_381_951_675_688_283_083_832_8e2,
            k8: 5.278_081_592_054_236_490_056_101_668_6e2,
            k9: -1.157_390_253_995_963_012_614_187_113_4e1,
            k10: 6.881_232_694_696_300_016_966_692_266_1,
            k11: -1.000_605_096_691_083_840_318_386_098_0,
            k12: 7.777_137_798_053_443_209_286_926_574_0e-1,
            k13: -2.778_205_752_353_508_406_593_200_433_9,
            k14: -6.019_669_523_126_412_075_826_738_084_6e1,
            k15: 8.432_040_550_667_716_101_815_990_378_4e1,
            k16: 1.199_229_113_618_278_932_803_513_003_0e1,
        }
        /// The seventh coefficient of the dense output, over h.
        seventh => {
            k1: -2.569_393_346_270_374_900_331_258_612_9e1,
            k6: -1.541_897_486_902_364_337_405_399_362_7e2,
            k7: -2.315_293_791_760_454_956_753_603_910_9e2,
            k8: 3.576_391_179_106_141_237_828_534_991_0e2,
            k9: 9.340_532_418_362_431_000_390_769_170_4e1,
            k10: -3.745_832_313_645_163_315_687_513_935_1e1,
            k11: 1.040_996_495_089_623_004_514_724_618_4e2,
            k12: 2.984_029_342_666_050_312_334_436_357_9e1,
            k13: -4.353_345_659_001_114_375_443_217_505_8e1,
            k14: 9.632_455_395_918_828_294_839_495_060_0e1,
            k15: -3.917_726_167_561_543_916_523_148_617_2e1,
            k16: -1.497_268_362_579_856_258_142_212_527_6e2,
        }
    }
}
