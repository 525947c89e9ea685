//! Which equation is solved, and in which form states are taken and returned: from single steps,
//! short and moderate ones, before anything is said of a method.
//!
//! A step of any method is (θ, ω) + h (ω, −(g/L) sin θ) + O(h²). What is found in place of the
//! first two terms, as functions of θ, ω and g/L, tells the equation; what does not vanish with h,
//! or grows as h falls, tells what was done with the step.

mod departure;
mod field;
mod finding;
pub(crate) mod form;
mod jumps;
mod output;
mod rates;
mod solved;

pub(crate) use departure::short;
pub use departure::{Added, Departure, Kind, Of, Place, Range};
pub use finding::Told;
pub use form::Equation;
pub use output::{Undo, Undone};
pub use solved::{Solved, Solver};

use self::field::{Field, STARTS};
use super::probe::{G_OVER_L, Probe, distance, frequency, step};
use super::series::{least_squares, residual};
use super::verdict::{Measured, Trouble, told};
use crate::integrator::{Integrator, Request};
use pendula::systems::Phase;

/// What was found of the equation.
#[derive(Clone, Debug)]
pub struct Looked {
    /// In what it departs from the pendulum's, if it does.
    pub departure: Option<Departure>,
    /// By how much rates are known, in units of √(g/L) and g/L.
    pub known_to: f64,
    /// The equation that is solved in its place, as a system.
    pub solved: Option<Solved>,
    /// The force at angles at rest, in units of g/L, for a figure.
    pub force: Vec<(f64, f64)>,
}

impl Looked {
    fn at(departure: Departure) -> Self {
        Self { departure: Some(departure), known_to: 0.0, solved: None, force: Vec::new() }
    }

    fn with(departure: Option<Departure>, field: &Field) -> Self {
        let force = field.rate.iter().zip(STARTS).map(|(rate, [theta, _])| (theta, rate[1]));
        let mut force: Vec<(f64, f64)> = force.collect();
        force.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self { departure, known_to: field.known_to[1], solved: None, force }
    }
}

/// A change of what is taken and returned that can be seen without a rate, and what undoes it.
pub fn output(probe: &Probe<'_>) -> Measured<Option<(Departure, Undo)>> {
    // Angles beyond half a turn, to both sides of it.
    let mut ends = Vec::new();
    for (theta, omega) in [(4.0, 1.0), (-0.5, -1.0), (-4.0, 1.0), (7.0, 0.5)] {
        let end = probe.end(Request::run(Phase { theta, omega }, step(0.02), 1))?;
        ends.push((theta, end.theta));
    }
    if let Some(wrapped) = output::wrapped(&ends) {
        return Ok(Some((wrapped, Undo::Wrapped)));
    }
    let starts = STARTS.map(|[theta, q]| Phase { theta, omega: q * frequency() });
    // The start, returned as the first state, and the first step's as the second.
    let mut late = true;
    for start in starts.into_iter().take(4) {
        let states = probe.states(Request::run(start, step(0.3), 2))?;
        late &= states[0] == start && states[1] != start;
        if !late {
            break;
        }
    }
    if late {
        return Ok(Some((Departure::RowsLate(1), Undo::Late(1))));
    }
    Ok(None)
}

/// Whether the field is the pendulum's.
fn is_right(integrator: &dyn Integrator) -> Measured<bool> {
    is_right_to(integrator, 0.0)
}

/// Whether it is to `known_to`, in units of √(g/L) and g/L.
fn is_right_to(integrator: &dyn Integrator, known_to: f64) -> Measured<bool> {
    let probe = Probe::new(integrator)?;
    let mut field = field::measure(&probe, G_OVER_L, 0)?;
    field.known_to = field.known_to.map(|known| libm::fmaximum(known, known_to));
    Ok(field.off() <= SURE)
}

/// So many times what it is known to a value has to be off before it is said to be wrong.
const SURE: f64 = 10.0;

/// What decimals or digits are cut off, of numbers as they came.
pub fn cut_off(probe: &Probe<'_>) -> Measured<Option<Departure>> {
    let mut numbers = Vec::new();
    for [theta, q] in STARTS {
        let start = Phase { theta, omega: q * frequency() };
        for z in probe.states(Request::run(start, step(0.07), 3))? {
            numbers.extend([z.theta, z.omega]);
        }
    }
    Ok(output::cut_off(&numbers, probe.rounding))
}

/// What is found of the equation, and what undoes it, if it is a change of output.
pub fn look(integrator: &dyn Integrator, probe: &Probe<'_>) -> Measured<(Looked, Option<Undo>)> {
    if let Some(departure) = of_the_step(probe)? {
        return Ok((Looked::at(departure), None));
    }
    let field = field::measure(probe, G_OVER_L, 0)?;
    let off = field.off();
    if off.is_nan() {
        return Err(Trouble::NotFinite);
    }
    if off <= SURE {
        return Ok((Looked::with(units(probe, &field)?, &field), None));
    }
    let jumps = field.jump.as_flattened().iter().any(|x| x.abs() > SURE * field.known_to[0]);
    if jumps {
        return by_jumps(integrator, probe, &field);
    }
    // A first step is another one where velocities are differences, or where older states are kept.
    if field::measure(probe, G_OVER_L, 2)?.off() <= SURE {
        return Ok(first_step(&field));
    }
    if let Some(departure) = vanishing(probe, &field)? {
        return Ok((Looked::with(Some(departure), &field), None));
    }
    let angle_in_the_force = field.rate.iter().zip(STARTS).all(|(rate, [theta, _])| {
        (rate[1] * G_OVER_L - theta).abs() <= 1e-3 + SURE * field.known_to[1] * G_OVER_L
    });
    if angle_in_the_force && is_right(&Undone { integrator, undo: Undo::Swapped })? {
        let departure = Departure::Swapped { taken_too: true };
        return Ok((Looked::with(Some(departure), &field), Some(Undo::Swapped)));
    }
    let four = field::measure(probe, 4.0 * G_OVER_L, 0)?;
    let quarter = field::measure(probe, 0.25 * G_OVER_L, 0)?;
    let fields = [field, four, quarter];
    // A program may refuse angles beyond half a turn.
    let far = told(field::from(probe, &field::FAR, G_OVER_L, 0))?;
    let (departure, solved) = rates::told(&fields, far.as_ref());
    // What breaks off is broken again where the properties are measured.
    let (departure, solved) = match forgets(probe) {
        Ok(false) => (at_the_start(departure), None),
        _ => (departure, solved),
    };
    let in_degrees = departure.kind() == Kind::DegreesInAndOut;
    let undo = in_degrees.then_some(Undo::InAndOut([core::f64::consts::PI / 180.0; 2]));
    let [field, ..] = &fields;
    let looked = Looked { solved, ..Looked::with(Some(departure), field) };
    Ok((looked, undo))
}

/// What is said where only the first step is another one: if it goes twice as far, each state is
/// that of the step after.
fn first_step(field: &Field) -> (Looked, Option<Undo>) {
    let twice = field.rate.iter().zip(STARTS).all(|(rate, [theta, q])| {
        let apart = [rate[0] - 2.0 * q, rate[1] + 2.0 * libm::sin(theta)];
        apart.iter().all(|apart| apart.abs() <= SURE * field.known_to[1] + 1e-9)
    });
    if !twice {
        return (Looked::with(None, field), None);
    }
    (Looked::with(Some(Departure::RowsEarly(1)), field), Some(Undo::Early(1)))
}

/// Whether a step is the same late in a run as from its state: that of a force that depends on the
/// time, or on what was before, is another one.
fn forgets(probe: &Probe<'_>) -> Measured<bool> {
    let h = step(0.1);
    let mut apart = 0.0_f64;
    for start in [Phase { theta: 0.4, omega: 0.3 }, Phase { theta: -0.7, omega: 1.0 }] {
        let states = probe.states(Request::run(start, h, 200))?;
        for k in [60, 130, 198] {
            let anew = probe.end(Request::run(states[k], h, 1))?;
            apart = libm::fmaximum(apart, distance(anew, states[k + 1]));
        }
    }
    // By less than a hundredth of the way of a step.
    Ok(apart <= 1e-3 + 100.0 * probe.rounding)
}

/// What is found at t = 0 of a force that depends on the time, or on what was before.
fn at_the_start(departure: Departure) -> Departure {
    match departure {
        Departure::Step { times, .. } => Departure::FirstStep { times },
        departure => Departure::ChangesInTime(Box::new(departure)),
    }
}

/// What was done with the step, where no field can be had: a step that is the same whatever is
/// asked for, or a change that grows as the step falls.
fn of_the_step(probe: &Probe<'_>) -> Measured<Option<Departure>> {
    let frequency = frequency();
    let way = |x: f64| -> Measured<Vec<[f64; 2]>> {
        let ways = STARTS.iter().take(6).map(|[theta, q]| {
            let start = Phase { theta: *theta, omega: q * frequency };
            let end = probe.end(Request::run(start, step(x), 1))?;
            Ok([end.theta - theta, (end.omega - start.omega) / frequency])
        });
        ways.collect()
    };
    let (long, middle, short_way) = (way(0.25)?, way(0.25 / 64.0)?, way(0.25 / 4096.0)?);
    let largest = |ways: &[[f64; 2]], part: usize| {
        ways.iter().map(|way| way[part].abs()).fold(0.0, libm::fmaximum)
    };
    let room = 100.0 * probe.rounding;
    let apart = |a: &[[f64; 2]], b: &[[f64; 2]]| {
        let pairs = a.as_flattened().iter().zip(b.as_flattened());
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, libm::fmaximum)
    };
    let moves = largest(&long, 0) > room || largest(&long, 1) > room;
    if moves && apart(&long, &middle) <= room && apart(&middle, &short_way) <= room {
        return fixed_step(probe).map(Some);
    }
    if let Some(times) = times(probe)? {
        return Ok(Some(Departure::Step { times, equation: None }));
    }
    // Sixty-four times as large in a step a sixty-fourth as long.
    let grows = |part: usize| {
        let [a, b] = [largest(&middle, part), largest(&short_way, part)];
        b > 16.0 * a && a > room
    };
    Ok(match [grows(0), grows(1)] {
        [false, false] => None,
        [true, true] => Some(Departure::DividedByStep(Of::Both)),
        [true, false] => Some(Departure::DividedByStep(Of::Angle)),
        [false, true] => Some(Departure::DividedByStep(Of::Velocity)),
    })
}

/// How many times as long a step is, where that is so much, or so little, that no field can be had:
/// by the way of a pendulum on which nearly no force acts.
fn times(probe: &Probe<'_>) -> Measured<Option<f64>> {
    let start = Phase { theta: 0.1, omega: 1.0 };
    let long = |x: f64| -> Measured<f64> {
        let h = step(x);
        Ok((probe.end(Request::run(start, h, 1).with(1e-12))?.theta - start.theta) / h)
    };
    let [a, b] = [long(0.25)?, long(0.25 / 64.0)?];
    let known_to = 1e3 * probe.rounding + 1e-9;
    let same = (a - b).abs() <= known_to * a.abs().max(1.0);
    Ok((same && a.abs() > 20.0).then(|| short(a, known_to * a.abs())))
}

/// The step that is taken whatever is asked for, by the way of a pendulum on which nearly no force
/// acts.
fn fixed_step(probe: &Probe<'_>) -> Measured<Departure> {
    let start = Phase { theta: 0.0, omega: 1.0 };
    let end = |steps| probe.end(Request::run(start, step(0.25), steps).with(1e-9));
    let (one, two) = (end(1)?, end(2)?);
    let known_to = 1e-9 + 10.0 * probe.rounding;
    let other = Request::run(Phase { theta: 0.5, omega: -1.0 }, step(0.25), 1);
    if probe.end(other)? == probe.end(Request::run(start, step(0.25), 1))? {
        return Ok(Departure::FixedEnd { theta: one.theta, omega: one.omega, known_to });
    }
    let moves = (one.omega - 1.0).abs() <= 1e-6 && one.theta != 0.0;
    let whole_run = moves && (two.theta - one.theta).abs() <= 1e-6 * one.theta.abs();
    let step = moves.then(|| short(one.theta, known_to));
    Ok(Departure::FixedStep { step, whole_run, known_to })
}

fn by_jumps(
    integrator: &dyn Integrator,
    probe: &Probe<'_>,
    field: &Field,
) -> Measured<(Looked, Option<Undo>)> {
    let (departure, undos) = jumps::told(probe, field)?;
    for undo in undos.iter().copied() {
        // A factor is known to what the jumps are.
        let known_to = if departure.kind() == Kind::Scaled { 1e-8 } else { 0.0 };
        if is_right_to(&Undone { integrator, undo }, known_to)? {
            // A factor of what is returned is one of what is taken.
            let departure = match (undo, departure) {
                (Undo::In(_), Departure::Scaled { times, known_to, .. }) => {
                    Departure::Scaled { times, taken: true, known_to }
                }
                (_, departure) => departure,
            };
            return Ok((Looked::with(Some(departure), field), Some(undo)));
        }
    }
    // Behind it is another equation; which of several changes it is cannot be told.
    let alone = if let [undo] = undos[..] { Some(undo) } else { None };
    let looked = Looked { force: Vec::new(), ..Looked::with(Some(departure), field) };
    Ok((looked, alone))
}

/// A rate that vanishes, whose change goes with the square of the step, or is none.
fn vanishing(probe: &Probe<'_>, field: &Field) -> Measured<Option<Departure>> {
    let known_to = SURE * field.known_to[1];
    let none = |part: usize| field.rate.iter().all(|rate| rate[part].abs() <= known_to);
    let frequency = frequency();
    // In units of the right change over h, h² is h times as much.
    let square = |part: usize, value: fn([f64; 2]) -> f64| {
        let column = [STARTS.map(value).to_vec()];
        let seconds: Vec<f64> = field.second.iter().map(|second| second[part]).collect();
        let factor = least_squares(&column, &seconds);
        let room = SURE * field.known_to[2] + 1e-9;
        let fits = residual(&column, &factor, &seconds) <= room;
        (fits && factor[0].abs() > 10.0 * room).then_some(factor[0] * frequency)
    };
    let departure = if none(1) {
        match square(1, |[theta, _]| -libm::sin(theta)) {
            Some(factor) => {
                Departure::SquaredStep { of: Of::Velocity, factor: short(factor, 1e-6) }
            }
            None if stays(probe, |z| z.omega)? => Departure::NoKick,
            None => return Ok(None),
        }
    } else if none(0) {
        match square(0, |[_, q]| q) {
            Some(factor) => Departure::SquaredStep { of: Of::Angle, factor: short(factor, 1e-6) },
            None if stays(probe, |z| z.theta)? => Departure::NoDrift,
            None => return Ok(None),
        }
    } else {
        return Ok(None);
    };
    Ok(Some(departure))
}

/// Whether this part of a state is the same after steps of any length.
fn stays(probe: &Probe<'_>, part: fn(&Phase) -> f64) -> Measured<bool> {
    for [theta, q] in STARTS.into_iter().take(6) {
        let start = Phase { theta, omega: q * frequency() };
        for x in [0.05, 0.4] {
            for z in probe.states(Request::run(start, step(x), 3))? {
                if (part(&z) - part(&start)).abs() > 30.0 * probe.rounding * frequency() {
                    return Ok(false);
                }
            }
        }
    }
    Ok(true)
}

/// Quantities of different units that a step adds, where the equation is right: the change of ω
/// with h² is then none of α′ω, and is another one in other units of time.
fn units(probe: &Probe<'_>, field: &Field) -> Measured<Option<Departure>> {
    let column = |value: fn([f64; 2]) -> f64| STARTS.map(value).to_vec();
    let right = column(|[theta, q]| -libm::cos(theta) * q);
    let by_kicks = column(|[theta, _]| libm::cos(theta) * libm::sin(theta));
    let by_time = column(|[theta, _]| -libm::cos(theta));
    // The two factors, as far as they are seen at all: each column is of order 1/2.
    let strange = |field: &Field| {
        let seconds: Vec<f64> = field.second.iter().map(|second| second[1]).collect();
        let known_to = field.known_to[2] + 1e-9;
        let all = [right.clone(), by_kicks.clone(), by_time.clone()];
        let factors = least_squares(&all, &seconds);
        let seen = factors[1..].iter().any(|factor| factor.abs() > 6.0 * known_to);
        let told = seen && residual(&all, &factors, &seconds) <= 4.0 * known_to;
        told.then_some([factors[1], factors[2]])
    };
    let Some([kicks, time]) = strange(field) else { return Ok(None) };
    let four = field::measure(probe, 4.0 * G_OVER_L, 0)?;
    let Some([kicks_at_four, time_at_four]) = strange(&four) else { return Ok(None) };
    // An increment of ω is, in units of the angle, √(g/L) times as large; a time as much smaller.
    let near = |a: f64, b: f64| (a - b).abs() <= 0.25 * b.abs();
    let added = if kicks.abs() > time.abs() && near(kicks_at_four, 2.0 * kicks) {
        Added::Velocity
    } else if time.abs() > kicks.abs() && near(time_at_four, 0.5 * time) {
        Added::Step
    } else {
        return Ok(None);
    };
    Ok(Some(Departure::Units(added)))
}
