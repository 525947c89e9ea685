//! Questions of "Störmer–Verlet".

use pendula::exact::{Motion, period};
use pendula::methods::StormerVerlet;
use pendula::metrics::CrossingPeriod;
use pendula::systems::Counting;
use pendula::{Grid, Hamiltonian, Method, Pendulum, Phase, Separable, integrate, integrate_with};

use super::{Compute, Truth, Within};

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] = &[
    ("stormer-verlet-cost", cost),
    ("stormer-verlet-period", period_of_a_small_swing),
    ("stormer-verlet-whole-kick", whole_kick),
];

const PENDULUM: Pendulum = Pendulum::PAPER;

/// Störmer–Verlet as its formula has it, with the force computed for each of the half kicks.
struct BothKicks;

impl<S: Separable> Method<S> for BothKicks {
    type Carry = ();

    fn start(&self, _: &S, _: f64, _: f64, _: S::State) {}

    fn step(&self, system: &S, t: f64, h: f64, z: S::State, _: &mut ()) -> S::State {
        let z = system.kick(z, system.force(t, z), 0.5 * h);
        let z = system.drift(z, h);
        system.kick(z, system.force(t + h, z), 0.5 * h)
    }
}

/// How often a thousand steps compute the force.
fn cost() -> Truth {
    fn counted(method: &impl Method<Counting<Pendulum>>) -> f64 {
        let pendulum = Counting::new(PENDULUM);
        let grid = Grid::new(0.01, 1000).expect("a grid");
        integrate(&pendulum, method, Phase::at_rest(1.0), &grid);
        pendulum.evaluations() as f64
    }
    Truth::Number {
        right: counted(&StormerVerlet),
        // A thousand, and one more for the first half kick of all.
        within: Within::Count(1),
        mistakes: vec![("both-kicks", counted(&BothKicks))],
    }
}

/// Whether the period is too long, exact or too short, by its relative error over x².
fn period_of_a_small_swing() -> Truth {
    const X: f64 = 0.1;
    /// A hundredth of x² is nothing: it is a quarter of what theory says.
    const NOTHING: f64 = 0.01;
    let exact = period(&PENDULUM, 0.1).expect("it swings");
    let h = X / PENDULUM.small_angle_frequency();
    let grid = Grid::new(h, (50.0 * exact / h) as u64).expect("a grid");
    let mut crossings = CrossingPeriod::default();
    integrate_with(&PENDULUM, &StormerVerlet, Phase::at_rest(0.1), &grid, &mut crossings);
    let measured = crossings.period().expect("it swings fifty times");
    let shift = (measured / exact - 1.0) / (X * X);
    Truth::Which(vec![
        ("long", shift > NOTHING),
        ("exact", shift.abs() <= NOTHING),
        ("short", shift < -NOTHING),
    ])
}

/// A program of Störmer–Verlet, by how many steps each of its lines kicks or drifts: the kick
/// before the loop, the drift and the kick in it, the kick after it.
type Program = [f64; 4];

/// The errors of a program that takes `steps` steps in a second, from rest at 1 rad: of the angle
/// at the end (rad), and the largest one of the energy (J).
fn errors([before, drift, kick, after]: Program, steps: u32) -> [f64; 2] {
    let (h, start) = (1.0 / f64::from(steps), Phase::at_rest(1.0));
    let kicked = |z, by: f64| PENDULUM.kick(z, PENDULUM.force(0.0, z), by * h);
    let (mut ahead, mut z, mut strayed) = (kicked(start, before), start, 0.0);
    for _ in 0..steps {
        ahead = kicked(PENDULUM.drift(ahead, drift * h), kick);
        z = kicked(ahead, after);
        strayed = f64::max(strayed, (PENDULUM.energy(z) - PENDULUM.energy(start)).abs());
    }
    let truth = Motion::new(&PENDULUM, start).expect("a finite start").at(1.0);
    [(z.theta - truth.theta).abs(), strayed]
}

/// The line whose mending makes the angle's error one of order 2. Those that are right are changed
/// into what readers take for right.
fn whole_kick() -> Truth {
    const PROGRAM: Program = [1.0, 1.0, 1.0, -0.5];
    let slopes = |program| {
        let (coarse, fine) = (errors(program, 500), errors(program, 1000));
        [0, 1].map(|i| libm::log2(coarse[i] / fine[i]))
    };
    let is = |slope: f64, order: f64| (slope - order).abs() < 0.1;
    let [angle, energy] = slopes(PROGRAM);
    let is_as_told = is(angle, 1.0) && is(energy, 2.0);
    let is_mended = |line: usize, by: f64| {
        let mut program = PROGRAM;
        program[line] = by;
        is_as_told && is(slopes(program)[0], 2.0)
    };
    Truth::Which(vec![
        ("before", is_mended(0, 0.5)),
        ("drift", is_mended(1, 0.5)),
        ("kick", is_mended(2, 0.5)),
        ("after", is_mended(3, -1.0)),
    ])
}
