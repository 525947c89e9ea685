//! The period of each method at every amplitude, against theory; and the resonances, where a
//! numerical swing takes a whole number of steps.

use std::f64::consts::{FRAC_PI_2, PI};

use approx::assert_relative_eq;
use pendula::methods::{ForwardEuler, Rk4, StormerVerlet, SymplecticEuler};
use pendula::metrics::CrossingPeriod;
use pendula::{
    Grid, LinearOscillator, METHODS, Method, Pendulum, Phase, exact, integrate, integrate_with,
    method_named,
};
use pendula_study::experiments::resonance::{EVEN, largest_error, place, slip, tau};
use pendula_study::theory;
use pendula_study::theory::period::{of_stormer_verlet, of_symplectic_euler};
use pendula_study::theory::small_angle::LinearRecurrence;
use rstest::rstest;

use crate::common::pendulum;

/// T̃/T − 1 of a method in steps of x = ω₀h, the mean over `periods` swings.
pub fn shift<M: Method<Pendulum>>(method: &M, theta_0: f64, x: f64, periods: f64) -> f64 {
    let pendulum = pendulum();
    let h = x / pendulum.small_angle_frequency();
    let period = exact::period(&pendulum, theta_0).unwrap();
    let grid = Grid::new(h, (periods * period / h) as u64).unwrap();
    let mut crossings = CrossingPeriod::default();
    integrate_with(&pendulum, method, Phase::at_rest(theta_0), &grid, &mut crossings);
    crossings.period().unwrap() / period - 1.0
}

/// What T̃/T = 1 + x²τ₂/ω₀² leaves out, over x⁴. At small angles it is 17/5760 = 0.00295 of x/(2
/// asin(x/2)); at larger ones it is of either sign, and 0.0031 at most.
const NEXT_TERM: f64 = 0.0035;

/// The relative error of the measured period: at most x³/24 at each of the two outermost crossings,
/// where symplectic Euler's velocity belongs half a step earlier, over 400 periods of 2π or more.
fn reading(x: f64) -> f64 {
    2.0 * x * x * x / 24.0 / (400.0 * 2.0 * PI)
}

/// At every amplitude the period changes by h²τ₂, up to terms in x⁴.
///
/// Catches: a wrong phase error of second order, which order tests accept; the half kick between
/// the two methods forgotten (their τ₂ differ); L or ω₀ missing.
#[rstest]
fn the_period_of_second_order_methods_shifts_as_predicted(
    #[values(0.1, 1.0, 2.0, 3.0)] theta_0: f64,
    #[values(0.2, 0.1)] x: f64,
) {
    let pendulum = pendulum();
    let x2 = x * x;
    let allowed = NEXT_TERM * x2 * x2 + reading(x);
    for (measured, tau) in [
        (shift(&StormerVerlet, theta_0, x, 400.0), of_stormer_verlet(&pendulum, theta_0)),
        (shift(&SymplecticEuler, theta_0, x, 400.0), of_symplectic_euler(&pendulum, theta_0)),
    ] {
        let law = x2 * tau / pendulum.frequency_squared();
        assert!((measured - law).abs() < allowed, "{measured:e} for {law:e} ± {allowed:e}");
        assert!(law.abs() > 50.0 * allowed, "the law is lost in its tolerance");
    }
}

/// Where τ₂ vanishes the period's error is O(h⁴).
///
/// Catches: a τ₂ that is right by chance at the angles of the test before.
#[rstest]
fn the_period_is_of_fourth_order_where_two_errors_cancel(#[values(0.2, 0.1)] x: f64) {
    /// Where cos θ₀ = 3⟨cos θ⟩, to ten digits.
    const VERLET_ZERO: f64 = 2.744_783_690_5;
    let pendulum = pendulum();
    assert!(of_stormer_verlet(&pendulum, VERLET_ZERO).abs() < 1e-10);
    assert!(of_symplectic_euler(&pendulum, FRAC_PI_2).abs() < 1e-15);
    let allowed = NEXT_TERM * x * x * x * x + reading(x);
    for left in
        [shift(&StormerVerlet, VERLET_ZERO, x, 400.0), shift(&SymplecticEuler, FRAC_PI_2, x, 400.0)]
    {
        assert!(left.abs() < allowed, "{left:e} is more than {allowed:e}");
    }
}

/// RK4's period changes by h⁴τ₄. With steps that divide a quarter period there is nothing to
/// interpolate; the energy loss adds a term in h⁵, which extrapolation from two steps removes. What
/// is left is of relative order x² < 1e-3, with a coefficient below 1.
///
/// Catches: an RK4 with a wrong error constant, which is still of order 4.
#[rstest]
fn the_period_of_rk4_shifts_as_predicted(#[values(0.1, 1.0, 2.0, 3.0)] theta_0: f64) {
    let pendulum = pendulum();
    let quarter = 0.25 * exact::period(&pendulum, theta_0).unwrap();
    let shift = |steps: u64| {
        let h = quarter / steps as f64;
        let grid = Grid::new(h, steps).unwrap();
        let z = integrate(&pendulum, &Rk4, Phase::at_rest(theta_0), &grid);
        -z.theta / z.omega / quarter / (h * h * h * h)
    };
    let law = theory::rk4::period_shift(&pendulum, theta_0);
    assert_relative_eq!(2.0 * shift(200) - shift(100), law, max_relative = 1e-3);
}

/// On the linear oscillator the period is that of the recurrence: x/φ times the exact one. Each
/// crossing is off by at most x³/24.
///
/// Catches: a method with the wrong frequency on a linear force, whatever it does on the sine.
#[rstest]
#[case::forward_euler(ForwardEuler, LinearRecurrence::forward_euler)]
#[case::symplectic_euler(SymplecticEuler, LinearRecurrence::symplectic_euler)]
#[case::rk4(Rk4, LinearRecurrence::rk4)]
#[case::stormer_verlet(StormerVerlet, LinearRecurrence::stormer_verlet)]
fn the_period_on_the_linear_oscillator_is_that_of_the_recurrence<M>(
    #[case] method: M,
    #[case] recurrence: fn(&Pendulum, f64) -> LinearRecurrence,
    #[values(0.2, 0.05)] x: f64,
) where
    M: Method<LinearOscillator>,
{
    let pendulum = pendulum();
    let h = x / pendulum.small_angle_frequency();
    let linear = LinearOscillator::new(pendulum);
    let grid = Grid::new(h, (400.0 * 2.0 * PI / x) as u64).unwrap();
    let mut crossings = CrossingPeriod::default();
    integrate_with(&linear, &method, Phase::at_rest(1.0), &grid, &mut crossings);
    let measured = crossings.period().unwrap() / pendulum.small_angle_period();
    let law = x / recurrence(&pendulum, h).advance;
    assert!((measured - law).abs() < reading(x), "{measured} for {law}");
}

// -------------------------------------------------------------------------------------------------
// Step-size resonances
// -------------------------------------------------------------------------------------------------

/// At the place that theory gives, every swing takes `count` steps, so that the samples of all
/// swings fall on each other, within half their distance; `beside` it (steps a period) they have
/// gone round by a whole turn or more.
///
/// An offset d slips by d/count turns a swing, and 400 swings by 400 d/count. Störmer–Verlet's
/// orbit stays locked for a twentieth of a step and more on either side; its place is a quarter of
/// a step from that of a method whose period is right.
///
/// Catches: a place that leaves out the period's shift, or has it with the wrong sign; a place
/// given in steps per small-angle period.
#[rstest]
#[case("blanes-moan-6", 6, 0.05)]
#[case("blanes-moan-6", 8, 0.05)]
#[case("blanes-moan-6", 10, 0.05)]
#[case("stormer-verlet", 6, 0.15)]
fn theory_has_the_place_of_a_resonance(
    #[case] name: &str,
    #[case] count: u32,
    #[case] beside: f64,
) {
    let method = method_named(name).unwrap();
    let place = place(count, tau(method));
    let locked = slip(method, place, count);
    assert!(locked < 0.5 / f64::from(count), "{name} slips by {locked} at {place}");
    for steps in [place - beside, place + beside] {
        let slipped = slip(method, steps, count);
        assert!(slipped > 1.0, "{name} slips by {slipped} at {steps}");
    }
}

/// The largest error within 0.04 steps of the place, over the larger of those a quarter of a step
/// to either side.
fn height(name: &str, place: f64) -> f64 {
    let method = method_named(name).unwrap();
    let error = |offset: f64| largest_error(method, place + offset);
    let peak = [0.01, 0.02, 0.03, 0.04].into_iter().flat_map(|d| [error(-d), error(d)]);
    peak.fold(0.0, f64::max) / error(-0.25).max(error(0.25))
}

/// Beside a place that is met, errors are small divisors: they fall as one over the distance, and
/// so by 6 to 25 from 0.01 to 0.25, where the method's own error is smaller than that and its
/// period near enough to the exact one. At an odd count the half swings, mirror images, undo each
/// other, whatever the symplectic method; the errors of order 16 are rounding.
///
/// Catches: peaks that are those of a single swing; odd counts taken for resonances; a parity that
/// one method has by chance.
#[test]
fn peaks_stand_at_even_counts_and_not_at_odd_ones() {
    for (name, counts) in [
        ("blanes-moan-6", &EVEN[..3]),
        ("gauss-6", &EVEN[..2]),
        ("processed-6", &EVEN[..2]),
        ("yoshida-6", &EVEN[..1]),
        ("yoshida-8", &EVEN[..1]),
        ("kahan-li-8", &EVEN[..1]),
    ] {
        for count in counts {
            let height = height(name, f64::from(*count));
            assert!(height > 6.0, "{name} at {count}: {height}");
        }
    }
    let symplectic = METHODS.iter().map(|method| method.info());
    for info in symplectic.filter(|info| info.symplectic && info.order <= 8) {
        for count in [7, 9, 11] {
            let height = height(info.name, f64::from(count));
            assert!(height < 1.0, "{} at {count}: {height}", info.name);
        }
    }
}
