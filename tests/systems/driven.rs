//! Driven systems: at which times a method evaluates the force; and the driven pendulum, its
//! cycles, period doublings and chaos.

use std::cell::RefCell;

use pendula::methods::{ForwardEuler, Rk4, StormerVerlet, SymplecticEuler};
use pendula::{Damped, Driven, Grid, Info, Method, Pendulum, Phase, Separable, System, integrate};
use pendula_judge::properties::driven::{Pushed, check, check_euler};
use pendula_judge::properties::near;
use pendula_study::dynamics::lyapunov::Watch;
use pendula_study::dynamics::{
    Bundle, Linearised, Stroboscope, contraction, largest_exponent, periodic_orbit,
};
use pendula_study::experiments::beyond::{
    CHAOTIC, COARSE, Doubling, attractor, doubling, doublings, poincare, seen,
};
use rstest::rstest;

/// Catches: stages at the wrong times, a kick with the force of the other end of the step: the
/// pendulum, which is autonomous, shows neither.
fn a_push_that_grows_is_followed_to_the_order<M: Info + Method<Pushed>>(method: &M) {
    check(method).unwrap();
}
each_general_method_type!(a_push_that_grows_is_followed_to_the_order);

/// Catches: the force at the end of the step, or half-way: an error of order h, which Euler's
/// methods have anyway, so that an order test does not show it.
#[test]
fn eulers_methods_ask_for_the_force_at_the_beginning_of_a_step() {
    check_euler(&ForwardEuler).unwrap();
    check_euler(&SymplecticEuler).unwrap();
}

// -------------------------------------------------------------------------------------------------
// The driven pendulum
// -------------------------------------------------------------------------------------------------

/// g/L = 2.5, L ≠ 1, m ≠ 1, Ω not a multiple of ω₀.
fn driven(strength: f64) -> Driven {
    let pendulum = Pendulum::new(5.0, 2.0, 3.0).unwrap();
    Driven::new(Damped::new(pendulum, 0.4).unwrap(), strength, 1.1).unwrap()
}

/// Rate and force agree at any time, and both depend on it.
///
/// Catches: a drive in only one of the two, a phase that differs between them; sin for cos in the
/// drive, its sign, γ without ω₀², g·L for g/L, the frequency in Hz; a getter that returns another
/// number than the one used.
#[rstest]
fn rate_is_force_and_velocity(#[values(0.0, 0.3, 17.0)] t: f64) {
    let driven = driven(1.3);
    let z = Phase { theta: 0.7, omega: -1.3 };
    let rate = driven.rate(t, z);
    assert_eq!(rate.theta, z.omega);
    let by_hand = -2.5 * 0.7_f64.sin() + 1.3 * 2.5 * (1.1 * t).cos();
    // A few roundings of numbers below 10.
    near("force", driven.force(t, z), by_hand, 4e-15).unwrap();
    near("rate", rate.omega, by_hand + 2.0 * 0.4 * 1.3, 4e-15).unwrap();
    near("period", driven.period(), 5.711986642890533, 2e-15).unwrap();
    assert_eq!((driven.strength(), driven.frequency()), (1.3, 1.1));
    let undriven = Driven::new(*driven.damped(), 0.0, 1.1).unwrap();
    assert_eq!(undriven.force(t, z), driven.damped().force(t, z));
}

/// Taylor's pendulum doubles its period at the known values: γ₁ = 1.066372862 and γ₂ = 1.079313906,
/// to their last digit.
///
/// Catches: a change in the fifth digit of the equation of motion; the wrong orbit; a multiplier of
/// another matrix.
#[test]
fn periods_double_where_they_should() {
    let [first, second] = doublings();
    // Half a unit of the reference's last digit. RK4 at 1000 steps a period is off by 3e-11.
    near("γ₁", first.strength, 1.066372862, 6e-10).unwrap();
    near("γ₂", second.strength, 1.079313906, 6e-10).unwrap();
    for (Doubling { strength, orbit }, periods) in [(first, 1), (second, 2)] {
        let driven = Driven::taylor(strength).unwrap();
        let contraction = contraction(&driven).powi(periods);
        // RK4's determinant is off by 3.7 (ω₀h)⁵/120 a step, as in the test above, times
        // 1000 steps a period and up to two periods.
        near("det", orbit.monodromy.determinant() / contraction, 1.0, 4.6e-9).unwrap();
        near("(μ₁ + 1)(μ₂ + 1)", orbit.monodromy.characteristic(-1.0), 0.0, 1e-9).unwrap();
        // One multiplier is −1, so the other is −det.
        near("μ₁ + μ₂", orbit.monodromy.trace(), -1.0 - contraction, 1e-8).unwrap();
        near("|μ|", orbit.monodromy.largest_modulus(), 1.0, 1e-8).unwrap();
        assert_eq!(orbit.periods, periods as u32);
    }
}

/// Below γ₁ a motion settles on a cycle of one period, above it on one of two periods.
///
/// Catches: a Newton search that finds an orbit other than the attracting one.
#[test]
fn the_orbit_that_newton_finds_is_the_one_that_attracts() {
    for (strength, periods, modulus) in [(1.060, 1, 0..1), (1.070, 2, 0..1), (1.070, 1, 1..9)] {
        let driven = Driven::taylor(strength).unwrap();
        let strobe = seen(&driven, 100);
        let settled = attractor(&driven);
        let again = (0..periods).fold(settled, |z, _| strobe.map(z));
        let orbit = periodic_orbit(&strobe, settled, periods).unwrap();
        let size = orbit.monodromy.largest_modulus();
        if modulus.start == 0 {
            // After 200 periods at exponents below −0.25 a period, exp(−50).
            near("θ", again.theta, settled.theta, 1e-9).unwrap();
            near("Newton's θ", orbit.point.theta, settled.theta, 1e-9).unwrap();
            assert!(size < 1.0, "attracts at {strength}: {size}");
        } else {
            // The cycle of one period still exists, but repels.
            assert!(size > 1.0, "repels at {strength}: {size}");
            assert!((orbit.point.theta - settled.theta).abs() > 1e-3);
        }
    }
    // A NaN start gives no orbit; and where the orbit of one period attracts at both ends of the
    // bracket, there is no doubling.
    let driven = Driven::taylor(1.06).unwrap();
    assert_eq!(periodic_orbit(&seen(&driven, 100), Phase::at_rest(f64::NAN), 1), None);
    assert!(doubling(1, (1.06, 1.065), 100).is_none());
}

/// A driven pendulum that notes the states in which periods begin.
struct Noted<'a>(&'a Driven, RefCell<Vec<Phase>>);

impl System for Noted<'_> {
    type State = Phase;

    fn rate(&self, t: f64, z: Phase) -> Phase {
        if t == 0.0 {
            self.1.borrow_mut().push(z);
        }
        self.0.rate(t, z)
    }
}

impl Linearised for Noted<'_> {
    fn tangent(&self, t: f64, z: Phase, v: Phase) -> Phase {
        self.0.tangent(t, z, v)
    }

    fn size(&self, v: Phase) -> f64 {
        self.0.size(v)
    }
}

/// Each error is about C times the square of the one before, and the first step within 1e-13 is the
/// last.
///
/// Catches: nine tenths of a step, or a derivative of the first guess, which find the same orbit
/// later; a search that goes on when it has converged, or ends before.
#[test]
fn newtons_method_squares_its_error() {
    let driven = Driven::taylor(1.070).unwrap();
    let strobe = seen(&driven, 100);
    let orbit = periodic_orbit(&strobe, attractor(&driven), 1).unwrap();
    for off in [0.03, -0.01, 0.003] {
        let guess = orbit.point + Phase { theta: off, omega: -2.0 * off };
        let noted = Noted(&driven, RefCell::default());
        let strobe = Stroboscope::new(&noted, &Rk4, driven.period(), 100).unwrap();
        let found = periodic_orbit(&strobe, guess, 1).unwrap();
        let mut path = noted.1.take();
        path.push(found.point);
        let size = |a: Phase, b: Phase| driven.size(a + b * -1.0);
        let errors: Vec<f64> = path.iter().map(|z| size(*z, orbit.point)).collect();
        // C is the second derivative of the map times the inverse of M − 1, both of order 1.
        let squared = |e: &[f64]| (0.1..10.0).contains(&(e[1] / (e[0] * e[0])));
        let seen = errors.iter().filter(|e| **e > 1e-11).count();
        assert!(seen > 2 && errors[..seen].windows(2).all(squared), "{errors:?}");
        let mut steps: Vec<f64> = path.windows(2).map(|z| size(z[0], z[1])).collect();
        assert!(steps.pop() <= Some(1e-13) && steps.iter().all(|s| *s > 1e-13), "{steps:?}");
    }
}

/// On a cycle the largest Lyapunov exponent is the logarithm of its larger multiplier, over the
/// period.
///
/// Catches: a logarithm of the wrong base, a period forgotten, a neighbour that is not rescaled, a
/// change of the norm itself counted.
#[rstest]
#[case::one_period(1.060, 1)]
#[case::two_periods(1.070, 2)]
fn the_exponent_of_a_cycle_is_that_of_its_multiplier(#[case] strength: f64, #[case] periods: u32) {
    let driven = Driven::taylor(strength).unwrap();
    let strobe = seen(&driven, 100);
    let start = attractor(&driven);
    let orbit = periodic_orbit(&strobe, start, periods).unwrap();
    let expected = orbit.monodromy.largest_modulus().ln() / f64::from(periods);
    let watch = Watch::new(100, 4, 10).unwrap();
    let exponent = largest_exponent(&strobe, start, watch);
    // The start is on the cycle to 1e-9 or better, and the modulus depends smoothly on it.
    near("λ", exponent.value, expected, 1e-7).unwrap();
    near("its error", exponent.error, 0.0, 1e-7).unwrap();
}

/// At γ = 1.105 the exponent is positive. Two neighbours at a finite distance, without the
/// variational equation, separate at the same rate; and 32 runs scatter as the error bars say.
///
/// Catches: an exponent of the wrong sign or unit; an error bar that is too small by the root of
/// the number of blocks.
#[test]
fn chaos_has_a_positive_exponent_with_an_honest_error_bar() {
    const RUNS: u32 = 32;
    let driven = Driven::taylor(CHAOTIC).unwrap();
    let strobe = seen(&driven, COARSE);
    let watch = Watch::new(50, 20, 25).unwrap();
    // All on the same attractor, 700 periods apart: there is a regular one too, for other starts.
    let mut start = attractor(&driven);
    let exponents: Vec<_> = (0..RUNS)
        .map(|_| {
            start = (0..700).fold(start, |z, _| strobe.map(z));
            largest_exponent(&strobe, start, watch)
        })
        .collect();
    let runs = f64::from(RUNS);
    let mean = exponents.iter().map(|exponent| exponent.value).sum::<f64>() / runs;
    let squares = exponents.iter().map(|exponent| (exponent.value - mean).powi(2));
    let scatter = squares.sum::<f64>() / (runs - 1.0);
    let bars = exponents.iter().map(|exponent| exponent.error.powi(2)).sum::<f64>() / runs;
    // The ratio of two variances, with 31 and with 32 · 19 degrees of freedom, is below 0.38 and
    // above 2.2 once in 10⁴ times each.
    let ratio = scatter / bars;
    assert!((0.38..2.2).contains(&ratio), "scatter {scatter:e}, bars {bars:e}");
    let error = (bars / runs).sqrt();
    assert!(mean > 20.0 * error, "{mean} ± {error}");

    // Two neighbours, rescaled to a distance of 1e-8 each period: no variational equation. 500
    // periods, as uncertain as one run.
    let (mut one, mut sum) = (attractor(&driven), 0.0);
    let mut other = one + Phase { theta: 1e-8, omega: 0.0 };
    for _ in 0..500 {
        (one, other) = (strobe.map(one), strobe.map(other));
        let apart = other + one * -1.0;
        let size = apart.theta.hypot(apart.omega / (3.0 * std::f64::consts::PI)) / 1e-8;
        sum += size.ln();
        other = one + apart * (1.0 / size);
    }
    // Four standard errors of the difference between one run and the mean of all.
    let difference = (bars * (1.0 + 1.0 / runs)).sqrt();
    near("λ by neighbours", sum / 500.0, mean, 4.0 * difference).unwrap();
}

/// Catches: points of the section that are not on the attractor, angles that are not wrapped,
/// states between periods.
#[test]
fn the_poincare_section_is_a_motion_seen_once_a_period() {
    let states = poincare(50);
    let driven = Driven::taylor_damped(1.5, 0.125).unwrap();
    assert_eq!(states.len(), 50);
    for pair in states.windows(2) {
        let next = seen(&driven, COARSE).map(pair[0]);
        let turns = (next.theta - pair[1].theta) / (2.0 * std::f64::consts::PI);
        // Rounding of a few turns.
        near("whole turns", turns, turns.round(), 1e-14).unwrap();
        assert_eq!(next.omega, pair[1].omega);
        assert!((-std::f64::consts::PI..std::f64::consts::PI).contains(&pair[1].theta));
    }
}

/// Two blocks differ from their mean by half their difference, which is its standard error. The
/// blocks are taken by hand.
///
/// Catches: an error bar with the wrong number of blocks under the root; a block that counts
/// periods of the settling.
#[test]
fn the_error_bar_of_two_blocks_is_half_their_difference() {
    let driven = Driven::taylor(CHAOTIC).unwrap();
    let (strobe, start) = (seen(&driven, COARSE), attractor(&driven));
    let mut neighbour = Bundle { base: start, tangents: [Phase { theta: 1.0, omega: 0.0 }] };
    let growths: Vec<f64> = (0..11)
        .map(|_| {
            neighbour = strobe.map_bundle(neighbour);
            let [along] = neighbour.tangents;
            let size =
                along.theta.hypot(along.omega / driven.damped().pendulum().small_angle_frequency());
            neighbour.tangents = [along * (1.0 / size)];
            size.ln()
        })
        .collect();
    // A period is 1 s.
    let [one, two] = [5, 8].map(|first| growths[first..first + 3].iter().sum::<f64>() / 3.0);
    let found = largest_exponent(&strobe, start, Watch::new(5, 2, 3).unwrap());
    // All are of order 1, and rounded a few times; the orbit itself is the same to the bit, and the
    // displacement is rescaled by a size whose last bit differs.
    near("mean", found.value, (one + two) / 2.0, 1e-13).unwrap();
    near("standard error", found.error, (one - two).abs() / 2.0, 1e-13).unwrap();
    assert!(found.error > 1e-3);
}

/// Störmer–Verlet against RK4, whose error is negligible here. Verlet's shifts the phase by
/// (hω₀)²/24 of ω₀t: 3e-7, of a swing of 1 rad and 1.6 rad/s. With a margin of 10.
///
/// Catches: a kick or a drift that ignores the state, or the friction.
#[test]
fn kicks_and_drifts_are_the_same_motion() {
    let (driven, grid) = (driven(0.8), Grid::new(0.001, 2000).unwrap());
    let start = Phase { theta: 1.0, omega: 0.4 };
    let verlet = integrate(&driven, &StormerVerlet, start, &grid);
    let rk4 = integrate(&driven, &Rk4, start, &grid);
    let off = verlet + rk4 * -1.0;
    assert!(off.theta.abs() < 3e-6 && off.omega.abs() < 5e-6, "{off:?}");
}

/// Catches: a period that is not the grid's.
#[test]
fn a_stroboscope_has_the_period_of_the_drive() {
    let driven = driven(0.8);
    // The step is the period over the number of steps, rounded; the period is their product,
    // rounded again.
    near("period", seen(&driven, COARSE).period(), driven.period(), 1e-15 * driven.period())
        .unwrap();
}

/// Catches: NaN accepted, a drive without a period, an error that does not give the reason.
#[test]
fn impossible_drives_are_refused() {
    let damped = *driven(1.0).damped();
    for (strength, frequency, because) in [
        (f64::NAN, 1.0, "drive strength γ"),
        (f64::MAX, 1.0, "drive γ g/L"),
        (1.0, 0.0, "greater than zero"),
        (1.0, f64::INFINITY, "drive frequency Ω"),
        (1.0, 3e-308, "at least 3.5e-308"),
    ] {
        let refused = Driven::new(damped, strength, frequency).unwrap_err().to_string();
        assert!(refused.contains(because), "{refused}");
    }
    assert!(Driven::new(damped, 1.0, 4e-308).unwrap().period().is_finite());
    let driven = driven(1.0);
    assert!(Stroboscope::new(&driven, &Rk4, driven.period(), 0).is_err());
    assert!(Stroboscope::new(&driven, &Rk4, -1.0, 10).is_err());
}
