//! Single measurements behind sentences of the paper: each a function of the parameters that the
//! sentence leaves open.

use pendula::adaptive::{Adaptive, Tolerance};
use pendula::exact::{Motion, period};
use pendula::methods::{DormandPrince, Rk4, StormerVerlet, SymplecticEuler};
use pendula::metrics::order::slopes;
use pendula::metrics::{AngleError, EnergyDrift};
use pendula::systems::{Components, Damped, Hamiltonian, Separable, System};
use pendula::{
    AnyMethod, Grid, Info, LinearOscillator, Method, Pendulum, Phase, integrate, integrate_with,
};
use pendula_dynamics::kepler::{Ellipse, Kepler, PlanePhase};

use crate::experiments::{grid, largest_energy_error, standard_map};

const PENDULUM: Pendulum = Pendulum::PAPER;

/// Largest energy error over `steps` steps of `step` (s) from rest at `theta_0` (rad), in J.
pub fn energy_drift(method: &dyn AnyMethod, theta_0: f64, step: f64, steps: u64) -> f64 {
    let grid = Grid::new(step, steps).expect("a positive step");
    largest_energy_error(method, theta_0, &grid)
}

/// Energy above the bottom (J) after `steps` steps of `step` (s) from rest at `theta_0` (rad).
pub fn last_energy(method: &dyn AnyMethod, theta_0: f64, step: f64, steps: u64) -> f64 {
    let grid = Grid::new(step, steps).expect("a positive step");
    PENDULUM.energy(method.run(&PENDULUM, Phase::at_rest(theta_0), &grid, &mut ()))
}

/// Time (s) of the first step that lowers the energy, from rest at `theta_0` (rad); `None` if no
/// step within `duration` (s) does.
pub fn first_fall(method: &dyn AnyMethod, theta_0: f64, step: f64, duration: f64) -> Option<f64> {
    let (mut before, mut fall) = (f64::NEG_INFINITY, None);
    let mut watch = |_, t, z| {
        let energy = PENDULUM.energy(z);
        if energy < before {
            fall.get_or_insert(t);
        }
        before = energy;
    };
    method.run(&PENDULUM, Phase::at_rest(theta_0), &grid(duration, step), &mut watch);
    fall
}

/// Largest and root-mean-square angle error against the small-angle formula, divided by θ₀, from
/// rest at `theta_0` (rad) over 10 s in steps of `step` (s).
pub fn normalised_formula_error(method: &dyn AnyMethod, theta_0: f64, step: f64) -> (f64, f64) {
    let start = Phase::at_rest(theta_0);
    let formula = LinearOscillator::new(PENDULUM);
    let mut error = AngleError::new(|t| formula.exact(start, t).theta);
    method.run(&PENDULUM, start, &grid(10.0, step), &mut error);
    (error.largest() / theta_0, error.root_mean_square() / theta_0)
}

/// The error of a single step of `step` (s) from `start`: the larger of |Δθ| (rad) and |Δω|
/// (rad/s).
pub fn one_step_error(method: &dyn AnyMethod, start: Phase, step: f64) -> f64 {
    let truth = Motion::new(&PENDULUM, start).expect("a finite start").at(step);
    let z = method.run(&PENDULUM, start, &grid(step, step), &mut ());
    libm::fmaximum((z.theta - truth.theta).abs(), (z.omega - truth.omega).abs())
}

/// Slope of the error of a single step against the step: one more than the order. From 1 rad and 1
/// rad/s, between 0.02 s and 0.01 s.
pub fn one_step_slope(method: &dyn AnyMethod) -> f64 {
    let steps = [0.02, 0.01];
    let start = Phase { theta: 1.0, omega: 1.0 };
    let errors = steps.map(|step| one_step_error(method, start, step));
    slopes(&steps, &errors, 0.0).flatten().next().unwrap_or(f64::NAN)
}

/// How far an orbit misses its start after one exact period in steps of about 0.01 s, from rest at
/// `theta_0` (rad): the larger of |Δθ| (rad) and |Δω| (rad/s).
pub fn closure(method: &dyn AnyMethod, theta_0: f64) -> f64 {
    let start = Phase::at_rest(theta_0);
    let period = period(&PENDULUM, theta_0).expect("a finite angle");
    let steps = libm::round(period / 0.01);
    let grid = Grid::new(period / steps, steps as u64).expect("a positive step");
    let end = method.run(&PENDULUM, start, &grid, &mut ());
    libm::fmaximum((end.theta - theta_0).abs(), end.omega.abs())
}

/// The waveform from rest at `theta_0` (rad): the fraction of time beyond nine tenths of the
/// amplitude, and the third harmonic over the first, in size.
pub fn waveform(theta_0: f64) -> (f64, f64) {
    const SAMPLES: u32 = 4096;
    let motion = Motion::new(&PENDULUM, Phase::at_rest(theta_0)).expect("a finite start");
    let period = motion.period().expect("it swings");
    let (mut beyond, mut first, mut third) = (0, 0.0, 0.0);
    for n in 0..SAMPLES {
        let turn = f64::from(n) / f64::from(SAMPLES);
        let theta = motion.at(turn * period).theta;
        let phase = 2.0 * core::f64::consts::PI * turn;
        beyond += u32::from(theta.abs() > 0.9 * theta_0);
        first += theta * pendula::arithmetic::sine::cos(phase);
        third += theta * pendula::arithmetic::sine::cos(3.0 * phase);
    }
    (f64::from(beyond) / f64::from(SAMPLES), (third / first).abs())
}

/// The largest speed ωh (rad a step) of `method` within `steps` steps of the size at which the
/// standard map has the parameter K = (g/L) h²: from a state beside the unstable equilibrium, in
/// the chaotic layer.
pub fn chaotic_speed(method: &dyn AnyMethod, k: f64, steps: u64) -> f64 {
    let step = standard_map::step(k);
    let start = Phase { theta: core::f64::consts::PI - 1e-3, omega: 0.0 };
    let mut fastest = 0.0_f64;
    let grid = Grid::new(step, steps).expect("a positive step");
    method.run(&PENDULUM, start, &grid, &mut |_, _, z: Phase| {
        fastest = fastest.max(z.omega.abs() * step);
    });
    fastest
}

/// The largest energy error over `long` swings from 1 rad over that of the first `short`, with
/// `steps` steps a swing: 1 for an oscillation that does not grow.
pub fn growth_over_swings(method: &dyn AnyMethod, steps: f64, [short, long]: [f64; 2]) -> f64 {
    let step = period(&PENDULUM, 1.0).expect("a finite angle") / steps;
    let drift = |swings: f64| energy_drift(method, 1.0, step, (swings * steps) as u64);
    drift(long) / drift(short)
}

/// Störmer–Verlet's largest energy error (J/kg) on Kepler's problem without angular momentum, in
/// steps of `step` (s): from rest at 1 m, with μ = 1 m³/s², over 2 s, in which the body falls
/// through the centre. A separable Hamiltonian, whose orbit stays in no compact set of the phase
/// plane.
pub fn energy_error_of_a_fall(step: f64) -> f64 {
    let kepler = Kepler::new(1.0).expect("a positive attraction");
    let start = PlanePhase { x: 1.0, ..PlanePhase::default() };
    let mut drift = EnergyDrift::new(&kepler);
    integrate_with(&kepler, &StormerVerlet, start, &grid(2.0, step), &mut drift);
    drift.largest()
}

/// A stone of 1 kg in free fall: `theta` is its height (m) and `omega` its speed (m/s), upwards.
struct FallingStone;

impl System for FallingStone {
    type State = Phase;

    fn rate(&self, t: f64, z: Phase) -> Phase {
        Phase { theta: z.omega, omega: self.force(t, z) }
    }
}

impl Separable for FallingStone {
    type Force = f64;

    fn force(&self, _t: f64, _z: Phase) -> f64 {
        -9.81
    }

    fn kick(&self, z: Phase, force: f64, h: f64) -> Phase {
        Phase { omega: z.omega + force * h, ..z }
    }

    fn drift(&self, z: Phase, h: f64) -> Phase {
        Phase { theta: z.theta + z.omega * h, ..z }
    }
}

impl Hamiltonian for FallingStone {
    fn energy(&self, z: Phase) -> f64 {
        0.5 * z.omega * z.omega + 9.81 * z.theta
    }
}

/// Symplectic Euler's largest energy error in 1000 s over that in 10 s, in steps of `step` (s), of
/// a stone that falls from rest. A Hamiltonian system, whose orbit stays in no bounded region:
/// after n steps the energy is off by g² h² n/2, exactly.
pub fn growth_on_a_falling_stone(step: f64) -> f64 {
    let [short, long] = [10.0, 1000.0].map(|duration| {
        let mut drift = EnergyDrift::new(&FallingStone);
        let start = Phase::default();
        integrate_with(&FallingStone, &SymplecticEuler, start, &grid(duration, step), &mut drift);
        drift.largest()
    });
    long / short
}

/// The error at the end in steps that Dormand and Prince's method chooses, over its error in as
/// many fixed steps as give the same number of evaluations: of the pendulum from 1 rad after 10 s,
/// and of a planet on an ellipse of eccentricity 0.9 after a revolution.
pub fn adaptive_over_fixed() -> [f64; 2] {
    let start = Phase::at_rest(1.0);
    let truth = Motion::new(&PENDULUM, start).expect("a finite start").at(10.0);
    let away = |z: Phase| (z.theta - truth.theta).abs();
    let pendulum = gain(&PENDULUM, start, 10.0, 1e-6, away);
    let centre = Kepler::new(1.0).expect("a positive attraction");
    let ellipse = Ellipse::new(&centre, 1.0, 0.9).expect("an ellipse");
    let start = ellipse.at(0.0);
    let away = |z: PlanePhase| libm::hypot(z.x - start.x, z.y - start.y);
    [pendulum, gain(&centre, start, ellipse.period(), 1e-6, away)]
}

/// Störmer–Verlet's root-mean-square angle error over RK4's for 400 evaluations each, from 1 rad
/// over 10 s: without friction, and with a damping rate β of 0.2/s. The truth is RK4 in steps a
/// hundred times as short.
pub fn verlet_over_rk4_damped() -> [f64; 2] {
    [0.0, 0.2].map(|rate| {
        let damped = Damped::new(PENDULUM, rate).expect("a rate in range");
        let fine = Grid::new(10.0 / 40_000.0, 40_000).expect("a positive step");
        let mut truth = Vec::new();
        integrate_with(&damped, &Rk4, Phase::at_rest(1.0), &fine, &mut |_, _, z: Phase| {
            truth.push(z.theta)
        });
        let verlet = error_against(&truth, &damped, &StormerVerlet, 400);
        verlet / error_against(&truth, &damped, &Rk4, 100)
    })
}

/// The root-mean-square difference of the angles of a run of `steps` steps over 10 s from 1 rad
/// from those of a finer one.
fn error_against(truth: &[f64], damped: &Damped, method: &impl Method<Damped>, steps: u64) -> f64 {
    let a_second = 0.1 * (truth.len() - 1) as f64;
    let grid = Grid::new(10.0 / steps as f64, steps).expect("a positive step");
    let mut error = AngleError::new(|t| truth[libm::round(t * a_second) as usize]);
    integrate_with(damped, method, Phase::at_rest(1.0), &grid, &mut error);
    error.root_mean_square()
}

/// The one error over the other, of steps chosen with a `tolerance` until `end` (s).
fn gain<S>(
    system: &S,
    start: S::State,
    end: f64,
    tolerance: f64,
    error: impl Fn(S::State) -> f64,
) -> f64
where
    S: System<State: Components>,
{
    let tolerance = Tolerance::uniform(tolerance).expect("a tolerance in range");
    let adaptive = Adaptive::new(DormandPrince, tolerance);
    let (last, counts) =
        adaptive.integrate(system, start, 0.0, end).expect("a tolerance that can be met");
    let steps = counts.evaluations / DormandPrince.info().force_evaluations;
    let grid = Grid::new(end / steps as f64, steps).expect("a positive step");
    error(last) / error(integrate(system, &DormandPrince, start, &grid))
}
