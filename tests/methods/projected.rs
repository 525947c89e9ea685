//! Steps that are projected onto the energy of the start.

use pendula::methods::{Heun, Projected};
use pendula::{
    ForwardEuler, Grid, Hamiltonian, Method, Motion, Pendulum, Phase, Rk4, StormerVerlet,
    integrate, integrate_with,
};
use rstest::rstest;

const START: Phase = Phase::at_rest(1.0);

/// The largest error of the angle (rad), and of the energy (J), of a run from rest at 1 rad; and
/// the largest change of the energy (J) by one step.
fn run(method: &impl Method<Pendulum>, h: f64, duration: f64) -> [f64; 3] {
    let pendulum = Pendulum::PAPER;
    let motion = Motion::new(&pendulum, START).unwrap();
    let (energy, mut before) = (pendulum.energy(START), pendulum.energy(START));
    let [mut angle, mut drift, mut change] = [0.0_f64; 3];
    let mut look = |_, t: f64, z: Phase| {
        let now = pendulum.energy(z);
        angle = angle.max((z.theta - motion.at(t).theta).abs());
        drift = drift.max((now - energy).abs());
        change = change.max((now - before).abs());
        before = now;
    };
    let grid = Grid::with_duration(h, duration).unwrap();
    integrate_with(&pendulum, method, START, &grid, &mut look);
    [angle, drift, change]
}

/// In units of mgL the energy has curvatures of at most 1, and on the curve through 1 rad a
/// gradient of at least sin(1): its square, sin²θ + 2(cos θ − cos 1), is smallest at the turning
/// points. So a step that leaves the curve by e is brought back to within e²/(2 sin²1) of it. The
/// step of the method alone is taken from a state as close to the curve, and e is what it changes
/// the energy by. An energy of 4.5 J is rounded by 9e-16, a few times in a step.
///
/// The order is that of the method: the next term bends its slope by at most 0.1 at these steps.
/// (In a longer run forward Euler would look like a method of order 2. Its error of order 1 comes
/// and goes in each swing, and what adds up is of order 2.)
///
/// Catches: a projection onto the energy of the step before, whose errors add up; one along another
/// direction than the gradient, or as far as half of it or twice; one that spoils the order.
#[rstest]
#[case::forward_euler(ForwardEuler, 1.0, 0.0005)]
#[case::heun(Heun, 2.0, 0.005)]
#[case::rk4(Rk4, 4.0, 0.01)]
fn the_energy_stays_and_the_order_too(
    #[case] method: impl Method<Pendulum, Carry = ()> + Copy,
    #[case] order: f64,
    #[case] h: f64,
) {
    // Plain steps change the energy most in the first swing, before they have gained or lost much.
    let [_, plain, change] = run(&method, h, 2.0);
    let allowed = (change / Pendulum::PAPER.depth()).powi(2) / (2.0 * 1.0_f64.sin().powi(2));
    let [_, drift, _] = run(&Projected(method), h, 20.0);
    let bound = 1.2 * allowed * Pendulum::PAPER.depth() + 1e-14;
    assert!(drift <= bound && drift < 0.01 * plain, "{drift:e}, not {bound:e}; plain {plain:e}");
    let [angle, finer] = [h, 0.5 * h].map(|h| run(&Projected(method), h, 2.0)[0]);
    let slope = (angle / finer).log2();
    assert!((slope - order).abs() < 0.1, "{slope}, not {order}");
}

/// The energy alone does not make a good angle: forward Euler, projected, is off by ten times as
/// much as Störmer–Verlet, which lets its energy swing. RK4's error grows with the square of the
/// time while its energy drifts, and in proportion to it where that is held.
///
/// Catches: a projection that also moves the state along the curve.
#[test]
fn the_energy_says_on_which_curve_and_not_where() {
    let [projected, verlet] =
        [run(&Projected(ForwardEuler), 0.01, 10.0)[0], run(&StormerVerlet, 0.01, 10.0)[0]];
    assert!(projected > 8.0 * verlet && projected < 12.0 * verlet, "{projected}, {verlet}");
    let growth = |errors: [f64; 2]| errors[1] / errors[0];
    let plain = growth([100.0, 400.0].map(|duration| run(&Rk4, 0.05, duration)[0]));
    let held = growth([100.0, 400.0].map(|duration| run(&Projected(Rk4), 0.05, duration)[0]));
    assert!(plain > 12.0 && (3.5..4.5).contains(&held), "{plain}, {held}");
}

/// At rest at the bottom the energy has no gradient, and nothing is divided by nothing.
///
/// Catches: 0/0.
#[test]
fn nothing_happens_at_the_bottom() {
    let grid = Grid::new(0.1, 10).unwrap();
    let rest = Phase::at_rest(0.0);
    assert_eq!(integrate(&Pendulum::PAPER, &Projected(Rk4), rest, &grid), rest);
}
