//! The pendulum on a shaken pivot: where the upright is stable, and where it is not.

use approx::assert_abs_diff_eq;
use pendula::systems::{Mathieu, Shaken};
use pendula::{Pendulum, Phase, Separable, System};
use pendula_study::experiments::beyond::{Boundary, mathieu_boundary, trials, upright};
use pendula_study::theory::other_systems::{a0, b1};
use rstest::rstest;

/// L ≠ 1, m ≠ 1, so that a missing factor shows.
fn pendulum() -> Pendulum {
    Pendulum::new(9.81, 0.8, 1.7).unwrap()
}

/// At q = 5 the values of Abramowitz and Stegun (1964), Table 20.1; at ½ and 1, where that table
/// has none, the smallest eigenvalues of 40 rows of DLMF 28.4 with 40 digits, which at 5 are those
/// of the table.
///
/// Catches: the even curve exchanged with the odd one, a row too few where the series of DLMF 28.6
/// no longer tells, a square root of the wrong off-diagonal element.
#[rstest]
#[case(0.5, -0.121_765_544_941_082_7, 0.470_654_354_933_839_1, 4e-16)]
#[case(1.0, -0.455_138_604_107_413_6, -0.110_248_816_992_095_17, 4e-16)]
#[case(5.0, -5.800_046_02, -5.790_080_60, 5e-9)]
fn mathieus_curves_have_their_published_digits(
    #[case] q: f64,
    #[case] even: f64,
    #[case] odd: f64,
    #[case] tolerance: f64,
) {
    assert_abs_diff_eq!(a0(q), even, epsilon = tolerance);
    assert_abs_diff_eq!(b1(q), odd, epsilon = tolerance);
}

/// RK4 at 1000 steps a period: (2π/1000)⁴/120 · 2π = 8e-11 of Ω in the multipliers, and up to about
/// six times that in the amplitude, where they depend on it least.
const AMPLITUDE: f64 = 1e-9;

/// Both boundaries, found from the monodromy matrix, are Mathieu's, for slow and fast shaking.
///
/// Catches: aΩ in place of aΩ²; a/L in place of 2a/L; g·L in place of g/L; Ωt in place of Ωt/2; a
/// multiplier of the hanging pendulum.
#[rstest]
fn the_upright_is_stable_between_mathieus_curves(#[values(20.0, 60.0, 400.0)] frequency: f64) {
    for (boundary, curve) in [(Boundary::Falling, a0 as fn(f64) -> f64), (Boundary::Rocking, b1)] {
        let amplitude = upright(&pendulum(), frequency, boundary, 1000).unwrap();
        let Mathieu { a, q } = Shaken::new(pendulum(), amplitude, frequency).unwrap().mathieu();
        // From the curve's value to the amplitude by its slope, −q or −1.
        let slope = if boundary == Boundary::Falling { q } else { 1.0 };
        assert_abs_diff_eq!((a - curve(q)) / (slope * q), 0.0, epsilon = AMPLITUDE);
    }
}

/// For slow shaking the two curves lie close together, far above the amplitudes that are searched,
/// which end at 0.4 L.
#[test]
fn slow_shaking_never_holds_it() {
    assert_eq!(upright(&pendulum(), 2.0, Boundary::Falling, 1000), None);
}

/// The marks of the book's figure: each stands or leaves as Mathieu's curves say.
///
/// Catches: a boundary that holds at one frequency only; a mark on the wrong side of a curve; a
/// factor of ω₀ or L left out.
#[test]
fn every_trial_ends_as_mathieu_says() {
    let trials = trials();
    for trial in &trials {
        let a = -4.0 / (trial.frequency * trial.frequency);
        let q = 2.0 * trial.amplitude;
        assert_eq!(trial.stands, a0(q) < a && a < b1(q), "{trial:?}");
    }
    assert!((40..60).contains(&trials.iter().filter(|trial| trial.stands).count()));
}

/// Catches: a boundary drawn in other units than those of [`Shaken::mathieu`], the two exchanged.
#[rstest]
#[case(Boundary::Falling, a0)]
#[case(Boundary::Rocking, b1)]
fn a_boundary_is_where_its_curve_is(#[case] boundary: Boundary, #[case] curve: fn(f64) -> f64) {
    let pendulum = pendulum();
    let (frequency, amplitude) = mathieu_boundary(boundary, 1.1).unwrap();
    let omega = frequency * pendulum.frequency_squared().sqrt();
    let shaken = Shaken::new(pendulum, amplitude * pendulum.length(), omega).unwrap();
    let Mathieu { a, q } = shaken.mathieu();
    // A few roundings of numbers near 1.
    assert_abs_diff_eq!(q, 1.1, epsilon = 1e-15);
    assert_abs_diff_eq!(a, curve(q), epsilon = 4e-15);
    // At q = 0.9, b₁ is positive still: no shaking is fast enough to reach it.
    assert_eq!(mathieu_boundary(boundary, 0.9).is_some(), boundary == Boundary::Falling);
}

/// The force by hand, at two times: the pivot's acceleration is −aΩ² cos Ωt, and it adds to g.
///
/// Catches: a wrong sign of the shaking (a shift by half a period), sin for cos, a rate that
/// differs from the force; a getter that returns another number than the one used.
#[rstest]
fn the_weight_is_gravity_and_the_pivots_acceleration(#[values(0.0, 0.013)] t: f64) {
    let shaken = Shaken::new(pendulum(), 0.1, 60.0).unwrap();
    assert_eq!((shaken.amplitude(), shaken.frequency()), (0.1, 60.0));
    assert_eq!(shaken.pendulum(), &pendulum());
    let z = Phase { theta: 0.7, omega: -1.3 };
    let felt = 9.81 - 0.1 * 3600.0 * (60.0 * t).cos();
    // A few roundings of numbers below 500.
    assert_abs_diff_eq!(shaken.force(t, z), -felt / 0.8 * 0.7_f64.sin(), epsilon = 3e-13);
    assert_eq!(shaken.rate(t, z), Phase { theta: z.omega, omega: shaken.force(t, z) });
    assert_eq!(shaken.kick(z, 2.0, 0.5), Phase { omega: z.omega + 1.0, ..z });
    assert_eq!(shaken.drift(z, 0.5), Phase { theta: 0.7 - 0.65, ..z });
    // In τ = Ωt/2: 4/Ω² times the squared frequency about the upright, −g/L + (aΩ²/L) cos 2τ.
    let Mathieu { a, q } = shaken.mathieu();
    assert_abs_diff_eq!(a, -4.0 * 9.81 / (0.8 * 3600.0), epsilon = 1e-17);
    assert_abs_diff_eq!(q, 0.25, epsilon = 1e-16);
}

/// Catches: NaN accepted, an error that does not give the reason; shaking so slow that its period
/// or Mathieu's parameter is infinite.
#[test]
fn impossible_shaking_is_refused() {
    for (amplitude, frequency, because) in [
        (-0.1, 60.0, "pivot amplitude a"),
        (f64::NAN, 60.0, "pivot amplitude a"),
        (0.1, 0.0, "greater than zero"),
        (0.1, 1e200, "shaking a Ω²/L"),
        (0.1, 1e-308, "at least 3.5e-308"),
        (0.1, 1e-170, "Mathieu's −4g/(LΩ²)"),
        (8.9e307, 1e-100, "Mathieu's 2a/L"),
    ] {
        let refused = Shaken::new(pendulum(), amplitude, frequency).unwrap_err().to_string();
        assert!(refused.contains(because), "{refused}");
    }
    // Where Ω² underflows, −4g/(LΩ²) need not.
    let soft = Pendulum::new(1e-300, 1.0, 1.0).unwrap();
    let Mathieu { a, q } = Shaken::new(soft, 0.1, 1e-165).unwrap().mathieu();
    assert!((a / -4e30 - 1.0).abs() < 1e-15 && q == 0.2, "{a:e} {q}");
}
