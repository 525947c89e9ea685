//! Runs and readings behind single sentences, beside those of the study's experiments.

use core::f64::consts::FRAC_PI_2;
use pendula::registry::InSteps;

use super::*;

/// The small-angle formula's own error in Table 6: the RMS of θ₀ cos ω₀t against the exact solution
/// (rad), over the samples of the finest step.
pub(super) static FLOOR: LazyLock<f64> = LazyLock::new(|| {
    let start = Phase::at_rest(small_angle::THETA_0);
    let motion = motion(start);
    let formula = LinearOscillator::new(Pendulum::PAPER);
    let mut error = AngleError::new(|t| formula.exact(start, t).theta);
    let grid = grid(small_angle::DURATION, STEPS[4]);
    for n in 0..grid.samples() {
        error.observe(n, grid.time(n), motion.at(grid.time(n)));
    }
    error.root_mean_square()
});

/// The width of a line in a figure of the size of the paper's Figure 5 (rad, or rad/s).
pub(super) const LINE: f64 = 0.01;

fn motion(start: Phase) -> Motion {
    Motion::new(&Pendulum::PAPER, start).expect("a finite start")
}

/// g/L (1/s²) from the printed small-angle period.
pub(super) fn squared_frequency_of_t_0() -> f64 {
    let frequency = core::f64::consts::TAU / printed("T7.T0");
    frequency * frequency
}

/// ∂H/∂ω over the rate of θ and −∂H/∂θ over that of ω, by central differences at two states: of the
/// four ratios the one that is furthest from 1. Where (θ, ω) are canonical, it is 1.
pub(super) fn hamilton_over_newton(pendulum: &Pendulum) -> f64 {
    // Halfway between the rounding of 10 J over δ and δ²/6 of a third derivative of 10 J.
    const DELTA: f64 = 1e-4;
    let slope = |dz: Phase, z: Phase| {
        let at = |sign: f64| {
            let (theta, omega) = (z.theta + sign * dz.theta, z.omega + sign * dz.omega);
            pendulum.energy_from_pivot(Phase { theta, omega })
        };
        (at(DELTA) - at(-DELTA)) / (2.0 * DELTA)
    };
    let ratios = [(0.5, 1.0), (2.5, -2.0)].map(|(theta, omega)| {
        let z = Phase { theta, omega };
        let rate = pendulum.rate(0.0, z);
        [
            slope(Phase { theta: 0.0, omega: 1.0 }, z) / rate.theta,
            -slope(Phase { theta: 1.0, omega: 0.0 }, z) / rate.omega,
        ]
    });
    let away = |ratio: f64| (ratio - 1.0).abs();
    let furthest = |a: f64, b: f64| if away(b) > away(a) { b } else { a };
    ratios.into_iter().flatten().fold(1.0, furthest)
}

/// The exact motions along which Eqs. 1 to 3 are looked at, and the moments (s).
fn moments() -> impl Iterator<Item = (Motion, f64)> {
    let motions = [1.0, 3.0].map(|theta_0| motion(Phase::at_rest(theta_0)));
    motions.into_iter().flat_map(|motion| (1..=100).map(move |n| (motion, 0.1 * f64::from(n))))
}

/// What is left of θ̈ + (g/L) sin θ, over g/L, and of θ̇ − ω, over ω₀, where the derivatives are
/// differences over a millisecond: the largest of both.
pub(super) fn left_of_the_equations() -> f64 {
    let h = 1e-3;
    let left = moments().map(|(motion, t)| {
        let [before, z, after] = [t - h, t, t + h].map(|t| motion.at(t));
        let second = (after.theta - 2.0 * z.theta + before.theta) / (h * h);
        let first = (after.theta - before.theta) / (2.0 * h);
        let newton = second / Pendulum::PAPER.frequency_squared() + sin(z.theta);
        let system = (first - z.omega) / Pendulum::PAPER.small_angle_frequency();
        libm::fmaximum(newton.abs(), system.abs())
    });
    left.fold(0.0, libm::fmaximum)
}

/// The largest change of H along the same motions, over m g L.
pub(super) fn change_of_the_energy() -> f64 {
    let energy = |z| Pendulum::PAPER.energy_from_pivot(z);
    let changes = moments().map(|(motion, t)| energy(motion.at(t)) - energy(motion.at(0.0)));
    let depth = Pendulum::PAPER.depth();
    changes.map(|change| change.abs() / depth).fold(0.0, libm::fmaximum)
}

/// The right-hand side of Eq. 5 (s), with its integral as printed. The trapezoidal rule converges
/// geometrically, as the integrand is even and periodic: at 3 rad like e^(−0.28 n).
pub(super) fn period_of_eq_5(theta_0: f64) -> f64 {
    const PIECES: u32 = 400;
    let width = FRAC_PI_2 / f64::from(PIECES);
    let k = sin(0.5 * theta_0);
    let integrand = |n: u32| {
        let s = k * sin(width * f64::from(n));
        1.0 / libm::sqrt(1.0 - s * s)
    };
    let ends = 0.5 * (integrand(0) + integrand(PIECES));
    let integral = width * (ends + (1..PIECES).map(integrand).sum::<f64>());
    4.0 / Pendulum::PAPER.small_angle_frequency() * integral
}

/// The period (s) from rest at `theta_0` (rad) of RK4's run in steps of a millisecond, between the
/// zeros of θ.
pub(super) fn period_of_a_run(theta_0: f64) -> f64 {
    let mut watch = <CrossingPeriod>::default();
    let grid = grid(large_angle::DURATION, large_angle::STEP);
    InSteps(Rk4).run(&Pendulum::PAPER, Phase::at_rest(theta_0), &grid, &mut watch);
    watch.period().unwrap_or(f64::NAN)
}

/// The largest errors of the energy (J) and of the angle (rad) in the long run, for one evaluation
/// of the force in each of its steps.
pub(super) fn errors_for_work(method: &dyn AnyMethod, evaluations: f64) -> [f64; 2] {
    let step = evaluations * long_run::STEP;
    let steps = libm::round(long_run::DURATION / step) as u64;
    let start = Phase::at_rest(long_run::THETA_0);
    let truth = motion(start);
    let mut watch = (EnergyDrift::new(&Pendulum::PAPER), AngleError::new(|t| truth.at(t).theta));
    let grid = Grid::new(step, steps).expect("a positive step");
    method.run(&Pendulum::PAPER, start, &grid, &mut watch);
    [watch.0.largest(), watch.1.largest()]
}

/// The columns of each method that has a row in the table whose ids begin so.
pub(super) fn columns_of_methods(table: &str) -> Vec<Vec<&'static str>> {
    let columns = PaperMethod::ALL.map(|method| {
        let row = format!("{table}{}.", method.id());
        CELLS.iter().filter_map(|cell| cell.id.strip_prefix(row.as_str())).collect::<Vec<_>>()
    });
    columns.into_iter().filter(|columns| !columns.is_empty()).collect()
}

/// The largest energy error (J) of Table 4's run in steps of `step` (s) by Algorithm 1, line by
/// line.
pub(super) fn energy_error_of_algorithm_1(step: f64) -> f64 {
    let f = |theta: f64, omega: f64| (omega, -9.81 * sin(theta));
    let mut drift = EnergyDrift::new(&Pendulum::PAPER);
    let grid = grid(convergence::DURATION, step);
    let (mut theta, mut omega) = (convergence::THETA_0, 0.0);
    for n in 0..grid.samples() {
        drift.observe(n, grid.time(n), Phase { theta, omega });
        let half = 0.5 * step;
        let k1 = f(theta, omega);
        let k2 = f(theta + half * k1.0, omega + half * k1.1);
        let k3 = f(theta + half * k2.0, omega + half * k2.1);
        let k4 = f(theta + step * k3.0, omega + step * k3.1);
        theta += step / 6.0 * (k1.0 + 2.0 * k2.0 + 2.0 * k3.0 + k4.0);
        omega += step / 6.0 * (k1.1 + 2.0 * k2.1 + 2.0 * k3.1 + k4.1);
    }
    drift.largest()
}

/// The largest difference, in angle (rad) or velocity (rad/s), between Eqs. 10 to 12 and two half
/// kicks about a drift, over Table 4's run at 0.01 s.
pub(super) fn equations_10_to_12_from_half_kicks() -> f64 {
    let h = 0.01;
    let alpha = |theta: f64| -9.81 * sin(theta);
    let start = Phase::at_rest(convergence::THETA_0);
    let (mut z, mut kicked) = (start, start);
    let mut apart = 0.0;
    for _ in 0..grid(convergence::DURATION, h).steps() {
        let theta = z.theta + z.omega * h + 0.5 * alpha(z.theta) * h * h;
        let omega = z.omega + 0.5 * (alpha(z.theta) + alpha(theta)) * h;
        z = Phase { theta, omega };
        let middle = kicked.omega + 0.5 * h * alpha(kicked.theta);
        kicked.theta += h * middle;
        kicked.omega = middle + 0.5 * h * alpha(kicked.theta);
        let away = libm::fmaximum((z.theta - kicked.theta).abs(), (z.omega - kicked.omega).abs());
        apart = libm::fmaximum(apart, away);
    }
    apart
}

/// How far the worst of Figure 5's three orbits misses its start after one exact period: the larger
/// of |Δθ| (rad) and |Δω| (rad/s).
pub(super) fn gap_of_the_orbits(method: &dyn AnyMethod) -> f64 {
    let gaps = level_curves::PORTRAIT.map(|theta_0| findings::closure(method, theta_0));
    gaps.into_iter().fold(0.0, libm::fmaximum)
}

/// RK4's error of a single step over the smallest of the paper's other methods: the largest of four
/// states and three steps.
pub(super) fn rk4_over_the_next_in_a_step() -> f64 {
    let others: [&dyn AnyMethod; 3] =
        [&InSteps(ForwardEuler), &InSteps(SymplecticEuler), &InSteps(StormerVerlet)];
    let states = [(0.05, 0.1), (1.0, 1.0), (2.0, -1.0), (3.0, 2.0)];
    let cases = states.into_iter().flat_map(|z| [0.1, 0.01, 0.001].map(|h| (z, h)));
    let ratios = cases.map(|((theta, omega), h)| {
        let error = |method| findings::one_step_error(method, Phase { theta, omega }, h);
        error(&InSteps(Rk4)) / others.into_iter().map(error).fold(f64::INFINITY, libm::fminimum)
    });
    ratios.fold(0.0, libm::fmaximum)
}

/// The turning points of forward Euler's run of Figure 4, on the parameters of Table 6: the energy
/// gained by then (J), and the angle (rad) of the sample that is furthest out.
pub(super) fn turning_points_of_figure_4() -> Vec<(f64, f64)> {
    let run = small_angle::trajectory(&InSteps(ForwardEuler), 0.01);
    let energy = energy_error(&run);
    let out = |n: usize| run[n].1.theta.abs();
    let turns = (1..run.len() - 1).filter(|&n| out(n) > out(n - 1) && out(n) >= out(n + 1));
    turns.map(|n| (energy[n].1, run[n].1.theta)).collect()
}
