//! Compensated sums: a state that carries its rounding errors along, with every method.

use pendula::methods::{Rk4, StormerVerlet, SymplecticEuler};
use pendula::metrics::EnergyDrift;
use pendula::{
    AnyMethod, Compensated, CompensatedPhase, Grid, Hamiltonian, Method, Pendulum, Phase,
    Separable, System, integrate, integrate_with,
};
use pendula_study::experiments::long_run;
use pendula_study::theory::{Dimensionless, stormer_verlet};
use rstest::rstest;

use crate::common::{in_seconds, on};

/// A sum plus its carried rounding error is exact to twice the precision.
///
/// Catches: a rounding error with the wrong sign, added twice, or dropped in the next sum;
/// components exchanged.
#[test]
fn nothing_is_lost_of_a_sum() {
    let tiny = Phase { theta: 1e-17, omega: -3e-18 };
    let mut z = CompensatedPhase::from(Phase { theta: 1.0, omega: -2.0 });
    for _ in 0..1000 {
        z = z + tiny;
        // Each increment is less than half a unit in the last place of 1 and of 2: without
        // compensation the sum would never change.
        assert!(z.lost.theta.abs() <= 1.2e-16 && z.lost.omega.abs() <= 2.3e-16, "{z:?}");
    }
    let moved = |rounded: f64, start: f64, lost: f64| (rounded - start) + lost;
    // The carried errors are below 1e-16, and rounded by 1e-32 a thousand times.
    assert!((moved(z.phase.theta, 1.0, z.lost.theta) - 1e-14).abs() < 1e-28, "{z:?}");
    assert!((moved(z.phase.omega, -2.0, z.lost.omega) + 3e-15).abs() < 1e-28, "{z:?}");
}

/// The last state with time in seconds, without and with compensation.
fn ends(
    method: &dyn AnyMethod,
    pendulum: &Pendulum,
    start: Phase,
    grid: &Grid,
) -> (Phase, CompensatedPhase) {
    let system = Compensated::new(*pendulum);
    let plain = in_seconds(method).try_run(pendulum, start, grid, &mut ());
    let carried = on(method).try_run(&system, start.into(), grid, &mut ());
    (plain.unwrap(), carried.unwrap())
}

/// A pendulum in almost no gravity rotates uniformly, by the same small angle each step: the sums
/// round alike each time, and the errors of 10⁵ sums add up to a good part of 10⁵ · ε/2 · 10 rad.
/// With compensation they do not: what is left is the rounding of the products hω, each by ε/2 of
/// itself, and of the last sum, ε/2 of 15 rad.
///
/// Catches: a method with sums that are not compensated; a drift that drops the carried error.
fn an_even_turn_is_even(method: &dyn AnyMethod) {
    // 1e-30/s² for 1000 s: less than 1e-24 rad.
    let pendulum = Pendulum::new(1e-30, 1.0, 1.0).unwrap();
    let start = Phase { theta: 1.0, omega: 0.014_142_135_623_730_95 };
    let grid = Grid::new(0.01, 100_000).unwrap();
    let exact = start.theta + start.omega * grid.time(100_000);
    let (plain, carried) = ends(method, &pendulum, start, &grid);
    let (plain, carried) = (plain.theta - exact, carried.phase.theta - exact);
    // Eight products that add up to 15 rad, and weights of up to 15.
    assert!(carried.abs() < 2e-14, "{carried:e}");
    assert!(plain.abs() > 10.0 * carried.abs(), "{plain:e}, {carried:e}");
}
each_method!(an_even_turn_is_even);

/// The steps are the same, except for rounding: in 10⁴ steps it adds up to at most 10⁴ · ε of the
/// state, and to x · 10⁴ times as much in phase.
///
/// Catches: a kick, a drift or a rate of another system.
fn the_steps_are_the_methods_own(method: &dyn AnyMethod) {
    let pendulum = Pendulum::new(5.0, 2.0, 3.0).unwrap();
    let start = Phase { theta: 1.2, omega: 0.7 };
    for steps in [1, 10_000] {
        let grid = Grid::new(0.01, steps).unwrap();
        let (plain, carried) = ends(method, &pendulum, start, &grid);
        let n = steps as f64;
        let tolerance = 4.0 * n * f64::EPSILON * (1.0 + 0.016 * n);
        let (d_theta, d_omega) =
            (carried.phase.theta - plain.theta, carried.phase.omega - plain.omega);
        assert!(d_theta.abs() < tolerance && d_omega.abs() < tolerance, "{d_theta:e}, {d_omega:e}");
    }
}
each_method!(the_steps_are_the_methods_own);

/// The step (s) of the random walks below, and the number of steps.
const STEP: f64 = 0.01;
const STEPS: u64 = 1_000_000;

/// The relative change of the modified energy over the run: root mean square over 16 starts.
fn wandered<S>(system: &S, phase: fn(S::State) -> Phase) -> f64
where
    S: Separable<State: From<Phase>>,
{
    let pendulum = Pendulum::PAPER;
    let frequency = pendulum.small_angle_frequency();
    let energy = |z: Phase| {
        let point = Dimensionless::new(z.theta, z.omega / frequency);
        point.energy() + stormer_verlet::correction(point, STEP * frequency)
    };
    let square = |i: i32| {
        let start = Phase::at_rest(0.5 + 0.02 * f64::from(i));
        let grid = Grid::new(STEP, STEPS).unwrap();
        let end = integrate(system, &StormerVerlet, start, &grid);
        (energy(phase(end)) / energy(start) - 1.0).powi(2)
    };
    ((0..16).map(square).sum::<f64>() / 16.0).sqrt()
}

/// Störmer–Verlet's modified energy makes a random walk, driven by the rounding of each step. Let u
/// be the root-mean-square rounding of a number of size 1; θ = A cos φ and q = A sin φ.
///
/// Without compensation a step rounds q and θ: δH̃ = qδq + θδθ has the square u²A⁴(sin⁴φ + cos⁴φ),
/// on average ¾ u²A⁴. With compensation only the displacements are rounded: that of q, xA cos φ,
/// four times, in the angle, in its sine, and in the products with g/L and with h; that of θ, xA
/// sin φ, once, in the product with h: u²A⁴x²(4 + 1) sin²φ cos²φ, on average ⅝ u²A⁴x². The walks
/// differ by the root of the quotient, 1.1/x: a factor of 35 at x = 0.031.
///
/// Sixteen walks determine it to a quarter; u depends on where in its binade a number is, and the
/// sine's rounding is not exactly uniform: a factor of two in all.
///
/// Catches: a compensation that does nothing, or that leaves out half of the sums or one
/// coordinate; one that the next kick undoes.
#[test]
fn the_modified_energy_wanders_less_by_the_step() {
    let pendulum = Pendulum::PAPER;
    let plain = wandered(&pendulum, |z| z);
    let carried = wandered(&Compensated::new(pendulum), |z: CompensatedPhase| z.phase);
    let law = 1.1 / (STEP * pendulum.small_angle_frequency());
    let gain = plain / carried;
    assert!(gain > 0.5 * law && gain < 2.0 * law, "{plain:e} / {carried:e} = {gain}, not {law}");
}

/// The digits that the paper prints for the run of 1000 s come from the methods, not from rounding:
/// they are the same with and without compensation. The paper prints at most four; here six are
/// compared, of energy errors down to 4e-6 of 5 J, which rounding changes by 3e-12.
///
/// Catches: a compensated run that is another motion; a digit in the tables that is due to
/// rounding.
#[rstest]
#[case::symplectic_euler(SymplecticEuler)]
#[case::stormer_verlet(StormerVerlet)]
#[case::rk4(Rk4)]
fn no_printed_digit_changes<M>(#[case] method: M)
where
    M: Method<Pendulum> + Method<Compensated<Pendulum>>,
{
    let grid = Grid::with_duration(long_run::STEP, long_run::DURATION).unwrap();
    let printed = |x: f64| format!("{x:.5e}");
    fn drift<S, M>(system: &S, method: &M, grid: &Grid) -> f64
    where
        S: Hamiltonian<State: From<Phase>>,
        M: Method<S>,
    {
        let start = Phase::at_rest(long_run::THETA_0);
        let mut drift = EnergyDrift::new(system);
        integrate_with(system, method, start, grid, &mut drift);
        drift.largest()
    }
    let plain = drift(&Pendulum::PAPER, &method, &grid);
    let carried = drift(&Compensated::new(Pendulum::PAPER), &method, &grid);
    assert_eq!(printed(plain), printed(carried));
    assert_ne!(plain, carried, "and yet it was another rounding");
}

/// Catches: an energy or a rate evaluated at another state; a drift with the rounded velocity
/// alone.
#[test]
fn the_system_is_the_one_within() {
    let pendulum = Pendulum::new(5.0, 2.0, 3.0).unwrap();
    let system = Compensated::new(pendulum);
    let z = Phase { theta: 0.7, omega: -1.3 };
    assert_eq!(system.energy(z.into()), pendulum.energy(z));
    assert_eq!(system.rate(0.0, z.into()), pendulum.rate(0.0, z));
    assert_eq!(system.force(0.0, z.into()), pendulum.force(0.0, z));
    let kicked = system.kick(z.into(), 0.3, 0.1);
    assert_eq!(kicked.phase, pendulum.kick(z, 0.3, 0.1));
    assert_eq!(system.drift(z.into(), 0.1).phase, pendulum.drift(z, 0.1));
    // The carried error of the velocity drifts too.
    let lost = Phase { theta: 0.0, omega: 1e-17 };
    let z = CompensatedPhase { phase: Phase { theta: 0.0, omega: 1.0 }, lost };
    let drifted = system.drift(z, 1.0);
    let expected = Phase { theta: 1e-17, omega: 1e-17 };
    assert_eq!((drifted.phase, drifted.lost), (Phase { theta: 1.0, omega: 1.0 }, expected));
}
