//! Questions of "Did you learn it?".

use pendula::arithmetic::sine::{cos, sin};
use pendula::exact::{Motion, period};
use pendula::integrate::Observer;
use pendula::methods::{ForwardEuler, Info, Rk4, StormerVerlet, SymplecticEuler};
use pendula::metrics::{AngleError, EnergyDrift};
use pendula::{Grid, Hamiltonian, Method, Pendulum, Phase, Separable, integrate, integrate_with};
use pendula_dynamics::kepler::{Ellipse, Kepler};

use super::{Compute, Truth, Within};

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] = &[
    ("exam-one-digit", one_digit),
    ("exam-energy-off", energy_off),
    ("exam-kick-back", kick_back),
    ("exam-thousand-times", thousand_times),
    ("exam-order-three", order_three),
    ("exam-ten-times", ten_times),
    ("exam-in-turn", in_turn),
    ("exam-twice-as-high", twice_as_high),
    ("exam-dies-away", dies_away),
    ("exam-triple-jump", triple_jump),
    ("exam-ellipse", ellipse),
    ("exam-allowance", allowance),
];

const PENDULUM: Pendulum = Pendulum::PAPER;

fn grid(step: f64, steps: u64) -> Grid {
    Grid::new(step, steps).expect("a positive step")
}

fn motion(start: Phase) -> Motion {
    Motion::new(&PENDULUM, start).expect("a finite start")
}

fn is_near(value: f64, expected: f64) -> bool {
    (value - expected).abs() < 0.1
}

/// The state after a kick for so long a time (s).
fn kicked(z: Phase, time: f64) -> Phase {
    PENDULUM.kick(z, PENDULUM.force(0.0, z), time)
}

/// A line of the program that swings without the sine, changed into what readers take for right.
#[derive(Clone, Copy, PartialEq)]
enum Line {
    Step,
    Kick,
    Drift,
    Clock,
}

/// The relative error of the program's period from rest at `theta_0` (rad).
fn off_by(theta_0: f64, changed: Option<Line>) -> f64 {
    let h = if changed == Some(Line::Step) { 0.0001 } else { 0.001 };
    let (mut theta, mut omega, mut t) = (theta_0, 0.0, 0.0);
    // The times of the falls through the bottom, on a straight line between two steps.
    let mut falls = Vec::new();
    for n in 1_u32.. {
        let (before, old) = (theta, omega);
        let pull = if changed == Some(Line::Kick) { sin(theta) } else { theta };
        omega -= h * 9.81 * pull;
        theta += h * if changed == Some(Line::Drift) { old } else { omega };
        t = if changed == Some(Line::Clock) { f64::from(n) * h } else { t + h };
        if before > 0.0 && theta <= 0.0 {
            falls.push(t - h * theta / (theta - before));
            if falls.len() == 2 {
                break;
            }
        }
    }
    ((falls[1] - falls[0]) / period(&PENDULUM, theta_0).expect("it swings") - 1.0).abs()
}

/// The line with which changed the period from 1 rad is as right as that from half a degree.
fn one_digit() -> Truth {
    const HALF_A_DEGREE: f64 = 0.5 * core::f64::consts::PI / 180.0;
    const FOUR_DIGITS: f64 = 1e-4;
    let is_as_told = off_by(HALF_A_DEGREE, None) < FOUR_DIGITS && off_by(1.0, None) > 0.01;
    let mends = |line| is_as_told && off_by(1.0, Some(line)) < FOUR_DIGITS;
    Truth::Which(vec![
        ("step", mends(Line::Step)),
        ("kick", mends(Line::Kick)),
        ("drift", mends(Line::Drift)),
        ("clock", mends(Line::Clock)),
    ])
}

/// Where in a swing from 1 rad symplectic Euler's energy is furthest from the truth.
fn energy_off() -> Truth {
    let released = Phase::at_rest(1.0);
    let (mut largest, mut place) = (0.0, f64::NAN);
    let mut watch = |_: u64, _: f64, z: Phase| {
        let off = (PENDULUM.energy(z) - PENDULUM.energy(released)).abs();
        if off > largest {
            (largest, place) = (off, z.theta.abs());
        }
    };
    integrate_with(&PENDULUM, &SymplecticEuler, released, &grid(0.001, 10_000), &mut watch);
    Truth::Which(vec![
        ("bottom", place < 0.2),
        ("between", (0.2..0.8).contains(&place)),
        ("turning", place >= 0.8),
    ])
}

/// The order of symplectic Euler's angles, where half a kick back is taken before the first step.
fn kick_back() -> Truth {
    let released = Phase::at_rest(1.0);
    let truth = motion(released);
    let error = |steps: u64| {
        let h = 5.0 / steps as f64;
        let mut error = AngleError::new(|t| truth.at(t).theta);
        let start = kicked(released, -0.5 * h);
        integrate_with(&PENDULUM, &SymplecticEuler, start, &grid(h, steps), &mut error);
        error.largest()
    };
    let order = libm::log2(error(500) / error(1000));
    Truth::Which(vec![
        ("none", is_near(order, 0.0)),
        ("one", is_near(order, 1.0)),
        ("two", is_near(order, 2.0)),
    ])
}

/// The factor by which RK4's step has to be shorter, so that a thousand times as many swings lose
/// no more energy.
fn thousand_times() -> Truth {
    const LONGER: f64 = 1000.0;
    let (released, swing) = (Phase::at_rest(1.0), period(&PENDULUM, 1.0).expect("it swings"));
    let lost = |swings: u64, steps_a_swing: u64| {
        let grid = grid(swing / steps_a_swing as f64, swings * steps_a_swing);
        let end = integrate(&PENDULUM, &Rk4, released, &grid);
        PENDULUM.energy(released) - PENDULUM.energy(end)
    };
    // The powers of the time and of the step.
    let growth = libm::log2(lost(20, 100) / lost(10, 100));
    let power = libm::log2(lost(10, 100) / lost(10, 200));
    let shorter = |power: f64| libm::pow(LONGER, growth / power);
    Truth::Number {
        right: shorter(power),
        // The fifth root of 1000: who knows that 4⁵ is 1024 is off by half a per cent.
        within: Within::Percent(1.0),
        mistakes: vec![
            ("state", shorter(Rk4.info().order.into())),
            ("step", shorter(power + 1.0)),
            ("in-proportion", shorter(1.0)),
        ],
    }
}

/// A line of the program that measures an order, changed into what readers take for right.
#[derive(Clone, Copy, PartialEq)]
enum Measuring {
    Step,
    Loop,
    Error,
    Slope,
}

/// The order that the program finds for Störmer–Verlet.
fn found(changed: Option<Measuring>) -> f64 {
    let released = Phase::at_rest(1.0);
    let truth = motion(released);
    let errors = [0_u32, 1].map(|k| {
        let halvings = f64::from(1 << k);
        let h = if changed == Some(Measuring::Step) { 0.005 } else { 0.01 } / halvings;
        let steps = if changed == Some(Measuring::Loop) { 10_000 << k } else { 10_000 };
        let mut error = 0.0;
        let mut watch = |_: u64, t: f64, z: Phase| {
            let off = z - truth.at(t);
            let off = libm::hypot(off.theta, off.omega);
            error = if changed == Some(Measuring::Error) { off } else { f64::max(error, off) };
        };
        integrate_with(&PENDULUM, &StormerVerlet, released, &grid(h, steps), &mut watch);
        error
    });
    let ratio = errors[0] / errors[1];
    libm::log2(if changed == Some(Measuring::Slope) { 1.0 / ratio } else { ratio })
}

/// The line with which changed the program finds the order 2 and not 3.
fn order_three() -> Truth {
    let is_as_told = is_near(found(None), 3.0);
    let mends = |line| is_as_told && is_near(found(Some(line)), 2.0);
    Truth::Which(vec![
        ("step", mends(Measuring::Step)),
        ("loop", mends(Measuring::Loop)),
        ("error", mends(Measuring::Error)),
        ("slope", mends(Measuring::Slope)),
    ])
}

/// The largest errors in 100 s and in 1000 s, in steps of 0.01 s: of the energy (J) and, sampled
/// once in ten steps, of the angle (rad).
fn errors(method: &impl Method<Pendulum>, start: Phase) -> [[f64; 2]; 2] {
    let truth = motion(start);
    let mut energies = EnergyDrift::new(&PENDULUM);
    let (mut angle, mut tenth) = (0.0, [f64::NAN; 2]);
    let mut watch = |n: u64, t: f64, z: Phase| {
        energies.observe(n, t, z);
        if n.is_multiple_of(10) {
            angle = f64::max(angle, (z.theta - truth.at(t).theta).abs());
        }
        if n == 10_000 {
            tenth = [energies.largest(), angle];
        }
    };
    integrate_with(&PENDULUM, method, start, &grid(0.01, 100_000), &mut watch);
    [tenth, [energies.largest(), angle]]
}

/// Errors by how much they grow from 100 s to 1000 s.
fn ten_times() -> Truth {
    let released = Phase::at_rest(1.0);
    let growth = |[tenth, whole]: [[f64; 2]; 2]| [0, 1].map(|i| whole[i] / tenth[i]);
    let verlet = growth(errors(&StormerVerlet, released));
    let [_, rk4] = growth(errors(&Rk4, released));
    let [euler, _] = growth(errors(&ForwardEuler, Phase::at_rest(0.001)));
    Truth::ascending(vec![
        ("verlet-energy", verlet[0]),
        ("verlet-angle", verlet[1]),
        ("rk4-angle", rk4),
        ("euler-energy", euler),
    ])
}

/// What the energy error does where long and short steps of Störmer–Verlet take turns.
fn in_turn() -> Truth {
    let released = Phase::at_rest(1.0);
    // The largest error (J) in so many pairs of steps.
    let largest = |pairs: u32, steps: [f64; 2]| {
        let (mut z, mut largest) = (released, 0.0);
        for _ in 0..pairs {
            for h in steps {
                z = kicked(PENDULUM.drift(kicked(z, 0.5 * h), h), 0.5 * h);
                largest = f64::max(largest, (PENDULUM.energy(z) - PENDULUM.energy(released)).abs());
            }
        }
        largest
    };
    let [short, long] = [5_000, 50_000].map(|pairs| largest(pairs, [0.015, 0.005]));
    let is_bounded = long < 1.1 * short;
    let is_larger = long > 1.1 * largest(5_000, [0.01, 0.01]);
    Truth::Which(vec![
        ("drifts", !is_bounded),
        ("same", is_bounded && !is_larger),
        ("larger", is_bounded && is_larger),
    ])
}

/// The factor between the steps in which Störmer–Verlet's error against the small-angle formula
/// vanishes, from 0.1 rad and from 0.05 rad.
fn twice_as_high() -> Truth {
    let frequency = PENDULUM.small_angle_frequency();
    // The steps of the 10 s in which it is least: it falls up to there, and rises beyond.
    let vanishing = |theta_0: f64| {
        let error = |steps: u64| {
            let mut error = AngleError::new(|t: f64| theta_0 * cos(frequency * t));
            let grid = grid(10.0 / steps as f64, steps);
            integrate_with(&PENDULUM, &StormerVerlet, Phase::at_rest(theta_0), &grid, &mut error);
            error.root_mean_square()
        };
        let (mut few, mut many) = (100_u64, 1000);
        while many > few + 1 {
            let middle = few.midpoint(many);
            *(if error(middle) < error(middle + 1) { &mut many } else { &mut few }) = middle;
        }
        many as f64
    };
    let right = vanishing(0.05) / vanishing(0.1);
    Truth::Number {
        right,
        // Twice, but for the steps being whole numbers of a run, and for the next order.
        within: Within::Percent(1.0),
        mistakes: vec![("square", right * right), ("same", 1.0), ("inverse", 1.0 / right)],
    }
}

/// With which methods a small swing dies away in steps of 0.7 s.
fn dies_away() -> Truth {
    fn dies(method: &impl Method<Pendulum>) -> bool {
        let released = Phase::at_rest(1e-6);
        let end = integrate(&PENDULUM, method, released, &grid(0.7, 10));
        PENDULUM.energy(end) < 0.1 * PENDULUM.energy(released)
    }
    let [euler, verlet, rk4] = [dies(&ForwardEuler), dies(&StormerVerlet), dies(&Rk4)];
    Truth::Which(vec![
        ("euler", euler),
        ("verlet", verlet),
        ("rk4", rk4),
        ("none", !euler && !verlet && !rk4),
    ])
}

/// The order of the triple jump with symplectic Euler for Störmer–Verlet.
fn triple_jump() -> Truth {
    let released = Phase::at_rest(1.0);
    let outer = 1.0 / (2.0 - libm::cbrt(2.0));
    let truth = motion(released).at(1.0);
    let error = |steps: u32| {
        let h = 1.0 / f64::from(steps);
        let step = |z| {
            [outer, 1.0 - 2.0 * outer, outer]
                .into_iter()
                .fold(z, |z, part| PENDULUM.drift(kicked(z, part * h), part * h))
        };
        ((0..steps).fold(released, |z, _| step(z)).theta - truth.theta).abs()
    };
    let order = libm::log2(error(1000) / error(2000));
    Truth::nearest(order, &[("one", 1.0), ("two", 2.0), ("three", 3.0), ("four", 4.0)])
}

/// What Störmer–Verlet gets wrong on an ellipse in a hundred revolutions: the largest errors.
fn ellipse() -> Truth {
    let centre = Kepler::new(1.0).expect("an attraction");
    let ellipse = Ellipse::new(&centre, 1.0, 0.6).expect("an ellipse");
    let start = ellipse.at(0.0);
    let (energy, momentum) = (centre.energy(start), centre.angular_momentum(start));
    let mut largest = [0.0; 3];
    let mut watch = |_: u64, _: f64, z| {
        // The ellipse's long axis lies along x at first.
        let axis = centre.eccentricity(z);
        let off = [
            centre.angular_momentum(z) / momentum - 1.0,
            centre.energy(z) / energy - 1.0,
            libm::atan2(axis.y, axis.x),
        ];
        largest = core::array::from_fn(|i| f64::max(largest[i], off[i].abs()));
    };
    let run = grid(ellipse.period() / 100.0, 10_000);
    integrate_with(&centre, &StormerVerlet, start, &run, &mut watch);
    let [momentum, energy, direction] = largest;
    Truth::ascending(vec![("momentum", momentum), ("energy", energy), ("direction", direction)])
}

/// The factor of the evaluations if Störmer–Verlet's energy error may be a hundredth, in ten times
/// the time.
fn allowance() -> Truth {
    const SMALLER: f64 = 100.0;
    const LONGER: f64 = 10.0;
    let largest = |step: f64, steps: u64| {
        let mut drift = EnergyDrift::new(&PENDULUM);
        integrate_with(
            &PENDULUM,
            &StormerVerlet,
            Phase::at_rest(1.0),
            &grid(step, steps),
            &mut drift,
        );
        drift.largest()
    };
    // The powers of the step and of the time.
    let power = libm::log2(largest(0.02, 1000) / largest(0.01, 2000));
    let growth = libm::log10(largest(0.01, 20_000) / largest(0.01, 2000));
    let work = |power: f64, growth: f64| {
        LONGER * libm::pow(SMALLER * libm::pow(LONGER, growth), 1.0 / power)
    };
    Truth::Number {
        right: work(power, growth),
        // A hundred, but for the measured powers, which are off by less than this.
        within: Within::Percent(1.0),
        mistakes: vec![
            ("grows", work(power, 1.0)),
            ("in-proportion", work(1.0, growth)),
            ("time", LONGER),
        ],
    }
}
