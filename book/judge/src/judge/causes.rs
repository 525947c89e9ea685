//! Causes that are shown: each is a hypothesis that predicts the program's numbers, to what it
//! rounds, where the right program has others.

use core::f64::consts::{PI, TAU};

use super::equation::Departure;
use super::identity::Asked;
use super::probe::{G_OVER_L, Probe, distance, frequency, states_after, step};
use super::verdict::{Measured, Trouble, Verdict, told};
use crate::integrator::Request;
use crate::property::Property;
use pendula::METHODS;
use pendula::systems::Phase;

/// What was shown of a program.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Shown {
    /// A step of −h is a step of h.
    SizeOfStep,
    /// The step that it takes for the one it is told.
    Step(TakenStep),
    /// A run of this many steps ends where one of so many more does.
    MoreSteps(u64, i64),
    /// The first steps are so many times as long.
    FirstSteps(Vec<f64>),
    /// It returns other rows of the method of this title.
    Rows(Rows, &'static str),
    /// The velocity has this limit (rad/s), whatever g/L is, or in units of √(g/L).
    Limit(f64, bool),
    /// A small swing stands still from this step on.
    Halted(f64, u64),
    /// The force is not smooth along the angle, by this part of g/L.
    Corners(f64),
    /// g/L is rounded to so many decimals.
    Gravity(i32),
    /// A turn that is taken off is longer than 2π by this (rad).
    Turns(f64),
    /// A step from a turn higher is another one, which differs with this power of the step.
    OneBottom(f64),
}

/// What becomes of the step (s).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum TakenStep {
    /// It is in single precision.
    Single,
    /// It is rounded to a whole number of these.
    Rounded(f64),
    /// It is no longer than this.
    Most(f64),
    /// It is no shorter than this.
    Least(f64),
}

/// What is returned in place of a state.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Rows {
    /// The angle, with the velocity of the step before.
    OldVelocity,
    /// The velocity, with the angle of the step before.
    OldAngle,
    /// The mean of the state and that of the step before.
    Mean,
    /// The state of so many steps before.
    Late(usize),
    /// The angle, with the difference from the angle before over the step for a velocity.
    Difference,
    /// The sine of the angle for the angle.
    Sine,
    /// The place of the bob, and its velocity along it.
    Place,
    /// The velocity times the step.
    TimesStep,
}

const ROWS: [Rows; 10] = [
    Rows::OldVelocity,
    Rows::OldAngle,
    Rows::Mean,
    Rows::Late(2),
    Rows::Late(3),
    Rows::Late(4),
    Rows::Difference,
    Rows::Sine,
    Rows::Place,
    Rows::TimesStep,
];

impl Rows {
    /// The k-th row, from the states, of which the first is the start.
    fn of(self, states: &[Phase], k: usize, h: f64) -> Phase {
        let (z, before) = (states[k], states[k - 1]);
        match self {
            Self::OldVelocity => Phase { omega: before.omega, ..z },
            Self::OldAngle => Phase { theta: before.theta, ..z },
            Self::Mean => (z + before) * 0.5,
            Self::Late(by) => states[k.saturating_sub(by)],
            Self::Difference => Phase { omega: (z.theta - before.theta) / h, ..z },
            Self::Sine => Phase { theta: libm::sin(z.theta), ..z },
            Self::Place => Phase { theta: libm::sin(z.theta), omega: z.omega * libm::cos(z.theta) },
            Self::TimesStep => Phase { omega: z.omega * h, ..z },
        }
    }
}

impl Shown {
    /// Its name in reports.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::SizeOfStep => "size-of-step",
            Self::Step(TakenStep::Single) => "step-in-single-precision",
            Self::Step(TakenStep::Rounded(_)) => "step-rounded",
            Self::Step(TakenStep::Most(_)) => "largest-step",
            Self::Step(TakenStep::Least(_)) => "smallest-step",
            Self::MoreSteps(..) => "other-number-of-steps",
            Self::FirstSteps(_) => "first-steps",
            Self::Rows(..) => "other-rows",
            Self::Limit(..) => "limited-velocity",
            Self::Halted(..) => "brought-to-a-halt",
            Self::Corners(_) => "table-of-the-force",
            Self::Gravity(_) => "gravity-rounded",
            Self::Turns(_) => "few-digits-of-pi",
            Self::OneBottom(_) => "one-bottom",
        }
    }

    /// What fails by it.
    pub const fn explains(&self) -> &'static [Property] {
        match self {
            Self::SizeOfStep => &[Property::Reversal, Property::Loss],
            Self::Step(_) => &[
                Property::Order,
                Property::Units,
                Property::Range,
                Property::Clock,
                Property::Loss,
                Property::Equation,
                Property::Reversal,
            ],
            Self::MoreSteps(..) => &[
                Property::Clock,
                Property::Order,
                Property::Reversal,
                Property::Loss,
                Property::Energy,
            ],
            Self::FirstSteps(_) => &[
                Property::Order,
                Property::Clock,
                Property::Reversal,
                Property::Area,
                Property::StageTimes,
            ],
            Self::Rows(..) => &[
                Property::Order,
                Property::Area,
                Property::Reversal,
                Property::Energy,
                Property::Mirror,
                Property::Units,
                Property::Turn,
                Property::Clock,
                Property::Loss,
                Property::Name,
                Property::StageTimes,
                Property::Range,
                Property::Equation,
                Property::Output,
            ],
            Self::Limit(..) => &[
                Property::Range,
                Property::Units,
                Property::Mirror,
                Property::Turn,
                Property::Energy,
                Property::Order,
            ],
            Self::Halted(..) => {
                &[Property::Range, Property::Reversal, Property::Loss, Property::Order]
            }
            Self::Corners(_) => {
                &[Property::Order, Property::Equation, Property::Name, Property::StageTimes]
            }
            Self::Turns(_) | Self::OneBottom(_) => &[Property::Turn],
            Self::Gravity(_) => &[
                Property::Equation,
                Property::Order,
                Property::Units,
                Property::Name,
                Property::StageTimes,
            ],
        }
    }
}

/// Whether these are the sums of the first weights of Adams and Bashforth's methods of order 2 to
/// 5, as which a first step, a second one and so on begin where the slopes before the start are
/// zero.
pub(crate) fn adds_up_to_no_slopes(times: &[f64]) -> bool {
    const WEIGHTS: [(f64, &[f64]); 4] = [
        (2.0, &[3.0, -1.0]),
        (12.0, &[23.0, -16.0, 5.0]),
        (24.0, &[55.0, -59.0, 37.0, -9.0]),
        (720.0, &[1901.0, -2774.0, 2616.0, -1274.0, 251.0]),
    ];
    WEIGHTS.iter().any(|(of, weights)| {
        let mut sum = 0.0;
        let sums = weights.iter().map(|weight| {
            sum += weight / of;
            sum
        });
        times.len() + 1 == weights.len()
            && sums.zip(times).all(|(sum, times)| (sum - times).abs() < 5e-3)
    })
}

/// Whether two numbers are one, but for what the integrator rounds, `times` over.
fn same(probe: &Probe<'_>, times: f64, a: f64, b: f64) -> bool {
    (a - b).abs() <= times * probe.rounding * a.abs().max(b.abs())
}

/// A program that takes |h| for h: to the bit.
pub fn size_of_step(probe: &Probe<'_>) -> Measured<Option<Shown>> {
    let start = Phase { theta: 1.2, omega: 0.8 };
    for x in [0.1, 0.4] {
        let ahead = probe.states(Request::run(start, step(x), 5))?;
        if probe.states(Request::run(start, -step(x), 5))? != ahead {
            return Ok(None);
        }
    }
    Ok(Some(Shown::SizeOfStep))
}

/// The step that is taken, by the way of a pendulum on which nearly no force acts.
pub fn step_taken(probe: &Probe<'_>) -> Measured<Option<Shown>> {
    const STEPS: [f64; 12] = [
        1.234_567_891e-5,
        7.654_321_987e-5,
        3.141_592_653e-4,
        9.876_543_21e-4,
        2.345_678_912e-3,
        7.171_717_171e-3,
        0.012_345_678_91,
        0.031_415_926_53,
        0.087_654_321_98,
        0.234_567_891_2,
        0.717_171_717_1,
        1.618_033_988_7,
    ];
    let start = Phase { theta: 0.0, omega: 1.0 };
    let mut taken = Vec::new();
    for h in STEPS {
        let end = probe.end(Request::run(start, h, 1).with(1e-12))?;
        taken.push(end.theta);
    }
    // The force that acts adds less than 10⁻¹² of itself.
    let is = |wanted: &dyn Fn(f64) -> f64| {
        STEPS.iter().zip(&taken).all(|(h, taken)| (taken - wanted(*h)).abs() <= 1e-11 * h)
    };
    if is(&|h| h) {
        return Ok(None);
    }
    let (first, last) = (taken[0], taken[taken.len() - 1]);
    let found = if is(&|h| f64::from(h as f32)) {
        Some(TakenStep::Single)
    } else if last > STEPS[1] && is(&|h| h.min(last)) {
        Some(TakenStep::Most(last))
    } else if first < STEPS[STEPS.len() - 2] && is(&|h| h.max(first)) {
        Some(TakenStep::Least(first))
    } else {
        [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9]
            .into_iter()
            .find(|to| is(&|h| libm::round(h / to) * to) || is(&|h| libm::floor(h / to) * to))
            .map(TakenStep::Rounded)
    };
    Ok(found.map(Shown::Step))
}

/// A run that takes other than the steps that are asked for: its end is not the state of that place
/// in a run of some steps more, but one beside it.
pub fn steps_taken(probe: &Probe<'_>) -> Measured<Option<Shown>> {
    const MORE: u64 = 8;
    let x = 0.01;
    for (h, steps) in [(0.1, 1000), (0.01, 1000), (0.1, 100), (0.01, 21)] {
        if probe.in_time(steps + MORE)? < steps + MORE {
            continue;
        }
        let slow = x / h;
        let start = Phase { theta: 0.3, omega: -0.1 * slow };
        let run = |steps| Request::run(start, h, steps).with(slow * slow);
        let whole = probe.end(run(steps))?;
        let states = probe.states(run(steps + MORE))?;
        let near = |z: &Phase| {
            let apart = (whole.theta - z.theta).abs().max((whole.omega - z.omega).abs() / slow);
            apart <= 10.0 * probe.bound(steps, x)
        };
        let place = states.iter().position(near);
        let by = place.map(|place| place as i64 + 1 - steps as i64).filter(|by| *by != 0);
        if let Some(by) = by {
            return Ok(Some(Shown::MoreSteps(steps, by)));
        }
    }
    Ok(None)
}

/// The lengths of the first steps, in h, where these alone are others: by the way of short ones.
pub fn first_steps(probe: &Probe<'_>) -> Measured<Option<Shown>> {
    const COUNT: u64 = 8;
    let h = step(1e-4);
    let mut all: Vec<Vec<f64>> = Vec::new();
    for (theta, q) in [(1.0, 0.5), (-0.7, 1.1)] {
        let start = Phase { theta, omega: q * frequency() };
        let states = probe.states(Request::run(start, h, COUNT))?;
        let befores = [start].into_iter().chain(states.iter().copied());
        let (mut angles, mut velocities) = (Vec::new(), Vec::new());
        for (before, z) in befores.zip(&states) {
            angles.push((z.theta - before.theta) / (h * start.omega));
            velocities.push((z.omega - before.omega) / (-h * G_OVER_L * libm::sin(theta)));
        }
        all.extend([angles, velocities]);
    }
    // What eight steps of 10⁻⁴ change of a slope, and rounding.
    let room = 5e-3 + 1e5 * probe.rounding;
    let one = |k: usize, value: f64| all.iter().all(|ways| (ways[k] - value).abs() <= room);
    let last = COUNT as usize - 1;
    let others = (0..=last).rev().find(|k| !one(*k, 1.0));
    let Some(others) = others.filter(|k| *k < last - 1) else { return Ok(None) };
    let times: Vec<f64> = (0..=others).map(|k| libm::round(all[0][k] * 1e3) / 1e3).collect();
    // Of angle and velocity, and of both starts, the same.
    let alike = times.iter().enumerate().all(|(k, times)| one(k, *times));
    Ok(alike.then_some(Shown::FirstSteps(times)))
}

/// Other rows of a method of the library, or of the other symplectic Euler, in eight steps from
/// three states by four lengths. Rows that are the method's own, as a difference of angles is
/// symplectic Euler's velocity, are no cause.
pub fn rows(probe: &Probe<'_>) -> Measured<Option<Shown>> {
    type Run<'m> = &'m dyn Fn(Phase, f64, u64) -> Option<Vec<Phase>>;
    let asked = Asked::of(probe)?;
    let of = |rows: Rows, run: Run<'_>| {
        let own = |start: Phase, h: f64, count: u64| {
            let mut states = vec![start];
            states.extend(run(start, h, count)?);
            Some((1..states.len()).map(|k| rows.of(&states, k, h)).collect::<Vec<Phase>>())
        };
        asked.apart(0.0, distance, own).is_some() && asked.apart(0.0, distance, run).is_none()
    };
    for rows in ROWS {
        for method in METHODS {
            let run = |start, h, count| states_after(*method, G_OVER_L, start, h, count);
            if of(rows, &run) {
                return Ok(Some(Shown::Rows(rows, method.info().title)));
            }
        }
        let drift_first = |start: Phase, h: f64, count: u64| {
            let mut z = start;
            let step = |_| {
                z.theta += h * z.omega;
                z.omega -= h * G_OVER_L * libm::sin(z.theta);
                z
            };
            Some((0..count).map(step).collect())
        };
        if of(rows, &drift_first) {
            return Ok(Some(Shown::Rows(rows, "the other symplectic Euler, which drifts first")));
        }
    }
    Ok(None)
}

/// A limit of the velocity, by short steps at ever larger ones, and at four times g/L.
pub fn limit(probe: &Probe<'_>) -> Measured<Option<Shown>> {
    const VELOCITIES: [f64; 9] = [1.0, 3.0, 6.0, 10.0, 20.0, 50.0, 100.0, 300.0, 1000.0];
    let at = |g_over_l: f64| -> Measured<Option<f64>> {
        let mut ends = Vec::new();
        for omega in VELOCITIES {
            let run = Request::run(Phase { theta: 0.0, omega }, 1e-7, 1).with(g_over_l);
            ends.push(probe.end(run)?.omega);
        }
        let most = ends[ends.len() - 1];
        // Slow ones are as they are.
        let held = most > 1.5 && most < 900.0 && (ends[0] - VELOCITIES[0]).abs() < 1e-4;
        let near = |(omega, end): (&f64, &f64)| (end - omega.min(most)).abs() <= 1e-4 * omega;
        Ok((held && VELOCITIES.iter().zip(&ends).all(near)).then_some(most))
    };
    let (Some(one), Some(four)) = (at(G_OVER_L)?, at(4.0 * G_OVER_L)?) else { return Ok(None) };
    Ok(if same(probe, 1e4, one, four) || (one - four).abs() < 1e-4 * one {
        Some(Shown::Limit(libm::round(one * 1e4) / 1e4, false))
    } else if (2.0 * one - four).abs() < 1e-4 * four {
        Some(Shown::Limit(libm::round(one / frequency() * 1e4) / 1e4, true))
    } else {
        None
    })
}

/// A small swing that stands still: its velocity is zero to the end.
pub fn halted(probe: &Probe<'_>) -> Measured<Option<Shown>> {
    for amplitude in [1e-2, 1e-3, 1e-4, 1e-6] {
        let start = Phase { theta: amplitude, omega: 0.0 };
        let states = probe.states(Request::run(start, step(0.1), 400))?;
        let from = states.iter().rposition(|z| z.omega != 0.0).map_or(0, |k| k + 1);
        if from < 380 {
            return Ok(Some(Shown::Halted(amplitude, from as u64 + 1)));
        }
    }
    Ok(None)
}

/// Corners of the force: fourth differences of what a step makes of the velocity, along angles.
pub fn corners(probe: &Probe<'_>) -> Measured<Option<Shown>> {
    const APART: f64 = 3e-3;
    let h = step(0.05);
    let mut kicks = Vec::new();
    for j in 0..48 {
        let start = Phase { theta: 0.7 + f64::from(j) * APART, omega: 0.0 };
        kicks.push(probe.end(Request::run(start, h, 1))?.omega / (h * G_OVER_L));
    }
    let fourth = |w: &[f64]| (w[4] - 4.0 * w[3] + 6.0 * w[2] - 4.0 * w[1] + w[0]).abs();
    let rough = kicks.windows(5).map(fourth);
    let corners = rough.clone().fold(0.0, libm::fmaximum);
    let many = rough.filter(|rough| *rough > 0.1 * corners).count();
    // Of a smooth force APART⁴, and of rounding √70 times as much as that of a kick over x.
    let smooth = 10.0 * libm::pow(APART, 4.0) + 1e3 * probe.rounding / 0.05;
    Ok((corners > 10.0 * smooth && many >= 4).then_some(Shown::Corners(corners)))
}

/// g/L that is rounded to decimals, by the kick of a short step where the drift hardly enters.
pub fn gravity(probe: &Probe<'_>) -> Measured<Option<Shown>> {
    const ASKED: [f64; 4] = [12.262_537, 3.217_592_6, 47.123_456, 0.987_654];
    let mut taken = Vec::new();
    for g_over_l in ASKED {
        let x = 1e-4;
        let h = x / libm::sqrt(g_over_l);
        let end =
            probe.end(Request::run(Phase { theta: 0.5 * PI, omega: 0.0 }, h, 1).with(g_over_l))?;
        taken.push(-end.omega / h);
    }
    // The sine is 1 to the second order about there, and the kick to x⁴.
    let is = |decimals: i32| {
        let power = libm::pow(10.0, f64::from(decimals));
        let pairs = ASKED.iter().zip(&taken);
        pairs.clone().all(|(asked, taken)| {
            (taken - libm::round(asked * power) / power).abs() <= 1e-7 * asked.max(1.0)
        })
    };
    Ok((0..=4).find(|decimals| is(*decimals)).map(Shown::Gravity))
}

/// What a step from some turns higher differs by, where it differs in proportion to the turns.
pub fn turned(probe: &Probe<'_>) -> Measured<Option<Shown>> {
    let apart = |theta: f64, turns: f64, x: f64| -> Measured<f64> {
        let omega = 0.7;
        let here = probe.end(Request::run(Phase { theta, omega }, step(x), 1))?;
        let raised = Phase { theta: theta + TAU * turns, omega };
        Ok(probe.end(Request::run(raised, step(x), 1))?.omega - here.omega)
    };
    let rounding = 1e4 * probe.rounding * frequency();
    let near = |a: f64, b: f64| (a - b).abs() <= 0.05 * a.abs().max(b.abs());
    let (mut powers, mut turns) = (Vec::new(), Vec::new());
    for theta in [0.6, 1.2] {
        let [one, two] = [apart(theta, 1.0, 0.1)?, apart(theta, 2.0, 0.1)?];
        let short = apart(theta, 1.0, 0.05)?;
        if one.abs() < rounding || short.abs() < rounding || !near(2.0 * one, two) {
            return Ok(None);
        }
        powers.push(libm::log2(one / short));
        // A kick by the angle, which is off by what the turn is.
        turns.push(one / (step(0.1) * G_OVER_L * libm::cos(theta)));
    }
    let (power, by) = (powers[0], turns[0]);
    let short_pi = near(turns[0], turns[1]) || powers.iter().all(|power| (power - 1.0).abs() < 0.2);
    Ok(if short_pi {
        Some(Shown::Turns(by))
    } else if power > 1.5 && (powers[1] - power).abs() < 0.5 {
        Some(Shown::OneBottom(power))
    } else {
        None
    })
}

/// The number of binary digits of what is returned, if these are no more than those of single
/// precision.
pub fn binary_digits(probe: &Probe<'_>) -> Measured<Option<u32>> {
    let states = probe.states(Request::run(Phase { theta: 0.9, omega: 0.3 }, step(0.1), 30))?;
    let digits = |x: f64| match x.to_bits() & ((1 << 52) - 1) {
        0 => 1,
        fraction => 53 - fraction.trailing_zeros(),
    };
    let most = states.iter().flat_map(|z| [z.theta, z.omega]).map(digits).max();
    Ok(most.filter(|most| *most <= 24))
}

/// Units in which angles and velocities may be returned.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Unit {
    /// Turns, and turns per second.
    Turns,
    /// Angles in turns.
    AnglesInTurns,
    /// Velocities in turns per second.
    TurnsPerSecond,
    /// Velocities in turns per minute.
    TurnsPerMinute,
    /// Velocities in units of √(g/L).
    OwnTime,
    /// Gradians.
    Gradians,
    /// Thousandths of a radian.
    Milliradians,
}

/// The units that a factor of what is returned is of.
pub fn unit(departure: &Departure) -> Option<Unit> {
    let Departure::Scaled { times: [angle, velocity], .. } = *departure else { return None };
    let is = |value: f64, wanted: f64| (value / wanted - 1.0).abs() < 1e-6;
    [
        (1.0 / TAU, 1.0 / TAU, Unit::Turns),
        (1.0 / TAU, 1.0, Unit::AnglesInTurns),
        (1.0, 1.0 / TAU, Unit::TurnsPerSecond),
        (1.0, 60.0 / TAU, Unit::TurnsPerMinute),
        (1.0, 1.0 / frequency(), Unit::OwnTime),
        (200.0 / PI, 200.0 / PI, Unit::Gradians),
        (1e3, 1e3, Unit::Milliradians),
    ]
    .into_iter()
    .find(|(a, b, _)| is(angle, *a) && is(velocity, *b))
    .map(|(.., unit)| unit)
}

/// What a hypothesis needs of the report.
#[derive(Clone, Copy, Debug)]
pub struct Failed<'a> {
    /// The properties that fail.
    pub those: &'a [Property],
    /// What is said of the precision.
    pub precision: Verdict,
}

/// The first hypothesis that is shown, of those that may explain what fails.
pub fn shown(probe: &Probe<'_>, failed: Failed<'_>) -> Measured<Option<Shown>> {
    type Hypothesis = fn(&Probe<'_>) -> Measured<Option<Shown>>;
    let any = |those: &[Property]| failed.those.iter().any(|failed| those.contains(failed));
    let all: [(bool, Hypothesis); 10] = [
        (
            any(&[
                Property::Order,
                Property::Units,
                Property::Range,
                Property::Clock,
                Property::Equation,
            ]),
            step_taken,
        ),
        (any(&[Property::Clock]), steps_taken),
        (
            any(&[
                Property::Order,
                Property::Clock,
                Property::Output,
                Property::Equation,
                Property::Name,
            ]),
            rows,
        ),
        (any(&[Property::Order, Property::Clock]), first_steps),
        (any(&[Property::Reversal, Property::Name]), size_of_step),
        (any(&[Property::Range, Property::Units, Property::Mirror]), limit),
        (any(&[Property::Range]), halted),
        (any(&[Property::Turn]), turned),
        (any(&[Property::Equation, Property::Units, Property::Order]), gravity),
        (
            any(&[Property::Order, Property::Equation]) && failed.precision == Verdict::Holds,
            corners,
        ),
    ];
    for (_, hypothesis) in all.into_iter().filter(|(may, _)| *may) {
        // A question that is not answered shows nothing.
        match told(hypothesis(probe)) {
            Ok(Some(Some(shown))) => return Ok(Some(shown)),
            Err(Trouble::Broken(why)) => return Err(Trouble::Broken(why)),
            _ => {}
        }
    }
    Ok(None)
}
