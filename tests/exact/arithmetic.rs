//! Numbers that are more than one f64: two of them as one number, and many side by side.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use fearless_simd::{Level, f64x4, f64x8};
use pendula::internals::double_double::{DoubleDouble, reduced_sine_cosine};
use pendula::internals::sine::half_turn;
use pendula::internals::{Apart, Mask, Number, OfF64, Two};
use pendula::internals::{Lanes, Pair};

// -------------------------------------------------------------------------------------------------
// Double-double
// -------------------------------------------------------------------------------------------------

/// A few units of 2⁻¹⁰⁴: one for each operation of a result.
const TOLERANCE: f64 = 2e-31;

fn near(x: DoubleDouble, hi: f64, lo: f64) -> bool {
    let difference = x - (DoubleDouble::new(hi) + DoubleDouble::new(lo));
    difference.rounded().abs() <= TOLERANCE * hi.abs()
}

/// Catches: a product, quotient or root with the digits of f64 only.
#[test]
fn root_and_quotient_invert_square_and_product() {
    for x in [2.0, 9.81, 1e-300, 5e-324, 1e300, 1.0 / 3.0] {
        let root = DoubleDouble::new(x).sqrt();
        let power = root.rounded().log2().floor().exp2();
        let back = root.scaled(1.0 / power).squared();
        let x = x / power / power;
        assert!(near(back, x, 0.0), "{back:?} {x}");
    }
    let third = DoubleDouble::ONE / DoubleDouble::new(3.0);
    assert!(near(third, 1.0 / 3.0, 1.850_371_707_708_594e-17));
    assert!(near(third * DoubleDouble::new(3.0), 1.0, 0.0));
}

/// Catches: a reduction with too few digits of π/2: cos(π as f64 / 2) consists only of digits
/// beyond the f64.
#[test]
fn sine_and_cosine_keep_all_digits_beside_a_multiple_of_half_pi() {
    let (sin, cos, n) = reduced_sine_cosine(FRAC_PI_2);
    assert_eq!(n, 1.0);
    // The second and third part of π/2.
    assert!(near(-sin, 6.123_233_995_736_766e-17, -1.497_384_904_859_169_8e-33));
    assert!(near(cos, 1.0, 0.0));
    // sin 1 and cos 1 = sin and cos of 1 − π/2, shifted by a quarter turn, to 32 digits by
    // mpmath.
    let (sin, cos, n) = reduced_sine_cosine(1.0);
    assert_eq!(n, 1.0);
    assert!(near(cos, 0.841_470_984_807_896_5, 1.776_845_092_935_536e-18));
    assert!(near(-sin, 0.540_302_305_868_139_8, -4.760_954_612_604_417e-17));
}

// -------------------------------------------------------------------------------------------------
// Lanes
// -------------------------------------------------------------------------------------------------

/// What each function makes of each number, as bits.
fn results<N: Number>(x: N, of_lanes: impl Fn(N) -> [u64; 8]) -> [[u64; 8]; 13] {
    let (half_turns, rest) = x.half_turns();
    let (rest_alone, any) = (rest.sine_and_cosine(), x.sin_and_cos());
    let half = x.splat(0.5);
    let smaller = N::select(x.abs().at_most(half), x, half);
    [
        (x + half) * x - 0.25,
        (x / half - 0.5) / 3.0,
        -x,
        x.abs(),
        half.copysign(x),
        half.signed_by(x),
        smaller,
        half_turns,
        x.sine(),
        rest_alone.0,
        rest_alone.1,
        any.0,
        any.1,
    ]
    .map(of_lanes)
}

/// The bits of a function of each lane are those of the same function of one number, with all
/// the instructions that this machine has: at zeros of both signs, where the reduction changes
/// its mind, and beyond the angles that it reduces.
///
/// Catches: sine and cosine confused in an odd quarter turn, or a sign of theirs in any of the
/// quarters; the sine of −0 without its sign; a lane beyond the limit reduced as if it were
/// within it; a mask inverted.
#[test]
fn a_lane_has_the_bits_of_a_number_alone() {
    /// 2⁻²⁷: below it the angle is its own sine.
    const TINY: f64 = 7.450580596923828e-9;
    let next = |x: f64| [x.next_down(), x, x.next_up()];
    let edges = [FRAC_PI_4, FRAC_PI_2, 3.0 * FRAC_PI_4, half_turn::LARGEST, 0.5, TINY];
    let mut numbers: Vec<f64> = edges.into_iter().flat_map(next).collect();
    numbers.extend([0.0, 1e-300, 5e-324, 1.0, 3.0, 4.0, 5.0, 1e4, 1e6, 4e6, 1e15]);
    numbers.extend(numbers.clone().into_iter().map(|x| -x));
    let count = numbers.len();
    for start in 0..numbers.len() {
        let eight: [f64; 8] = core::array::from_fn(|i| numbers[(start + 7 * i) % count]);
        let alone = eight.map(|x| results(x, |x| [x.to_bits(); 8]));
        let expected: [[u64; 8]; 13] =
            core::array::from_fn(|of| core::array::from_fn(|lane| alone[lane][of][lane]));
        fn bits<N: Lanes>(x: N) -> [u64; 8] {
            core::array::from_fn(|lane| x.lane(lane).to_bits())
        }
        fn in_lanes<N: Lanes>(simd: N::Simd, eight: [f64; 8]) -> [[u64; 8]; 13] {
            results(N::from_lanes(simd, |lane| eight[lane]), bits)
        }
        fearless_simd::dispatch!(Level::new(), simd => {
            assert_eq!(in_lanes::<f64x8<_>>(simd, eight), expected, "{eight:?}");
            assert_eq!(in_lanes::<Pair<f64x4<_>>>(simd, eight), expected, "{eight:?}");
        });
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        if let Some(simd) = Level::new().as_sse2() {
            assert_eq!(in_lanes::<f64x8<_>>(simd, eight), expected, "{eight:?}");
        }
    }
}

/// Catches: a mask that looks at one lane, or at one of a pair.
#[test]
fn all_is_every_lane() {
    fn all<N: Lanes>(simd: N::Simd, different: usize) -> bool {
        let x = N::from_lanes(simd, |lane| if lane == different { 2.0 } else { 1.0 });
        x.at_most(x.splat(1.5)).all()
    }
    fearless_simd::dispatch!(Level::new(), simd => {
        assert!(all::<f64x8<_>>(simd, 99) && all::<Pair<f64x4<_>>>(simd, 99));
        for lane in 0..8 {
            assert!(!all::<f64x8<_>>(simd, lane) && !all::<Pair<f64x4<_>>>(simd, lane));
        }
    });
}

/// Catches: halves of a register confused; the sign of the wrong one changed, or that of a zero
/// or a NaN left; a factor that multiplies one half.
#[test]
fn a_register_holds_what_two_numbers_would() {
    fn bits<T: Two<f64>>(a: f64, b: f64) -> [u64; 6] {
        let two = T::new(a, b);
        let turned = (two + T::new(0.1, 0.2)).times(T::factor(0.3)).turned();
        [two, two.turned(), turned]
            .map(|two| [two.second(), two.turned().turned().turned().second()])
            .as_flattened()
            .iter()
            .map(|x| x.to_bits())
            .collect::<Vec<_>>()
            .try_into()
            .unwrap()
    }
    for (a, b) in [(1.5, -2.5), (0.0, -0.0), (-0.0, 0.0), (5e-324, -f64::MAX)] {
        assert_eq!(bits::<OfF64>(a, b), bits::<Apart<f64>>(a, b), "{a}, {b}");
    }
    let (a, b) = (1.5, -2.5);
    let [second, first, minus_first, ..] = bits::<OfF64>(a, b);
    assert_eq!([second, first, minus_first], [b, a, -a].map(f64::to_bits));
}
