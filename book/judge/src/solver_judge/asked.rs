//! How a solver is asked: its answers checked, its errors against the exact motion, and what
//! rounding may make of them.

use core::fmt;

use crate::integrator::Reply;
use crate::judge::probe::{G_OVER_L, exact};
use crate::judge::verdict::{Measured, checked};
use crate::solver::{Crossings, CrossingsRequest, SolveRequest, Solver};
use pendula::exact::Motion;
use pendula::systems::Phase;

/// The tolerance of the runs whose tolerance does not matter: far from rounding for every method,
/// and quick.
pub const USUAL: f64 = 1e-7;

/// The pendulum that most requests are about, and their runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scenes {
    /// g/L (1/s²).
    pub g_over_l: f64,
    /// Where runs start (rad, rad/s).
    pub starts: [Phase; 3],
    /// How long they are (s).
    pub duration: f64,
    /// What the solver rounds by, relative to a number.
    pub epsilon: f64,
}

impl Scenes {
    /// A wide swing from rest, a smaller one, and a rotation, for five swings and a half.
    pub const USUAL: Self = Self {
        g_over_l: G_OVER_L,
        starts: [
            Phase::at_rest(2.0),
            Phase { theta: -0.7, omega: 2.1 },
            Phase { theta: 0.4, omega: 8.0 },
        ],
        duration: 10.0,
        epsilon: f64::EPSILON,
    };

    /// The same for a solver in single precision: a fifth as long, so that errors of steps are seen
    /// above those of rounding, which grow more.
    pub const fn in_single(self) -> Self {
        Self { epsilon: f32::EPSILON as f64, duration: 0.2 * self.duration, ..self }
    }

    /// How many times coarser it is than double precision.
    pub fn coarser(&self) -> f64 {
        self.epsilon / f64::EPSILON
    }

    /// ω₀ (rad/s).
    pub fn frequency(&self) -> f64 {
        libm::sqrt(self.g_over_l)
    }

    /// A run from `start`.
    pub const fn run(&self, start: Phase, tolerance: f64) -> SolveRequest {
        SolveRequest::new(self.g_over_l, start, tolerance)
    }

    /// A state with its velocity in units of ω₀.
    pub fn state(&self, theta: f64, omega: f64) -> Phase {
        Phase { theta, omega: omega * self.frequency() }
    }

    /// The exact motion from `start`.
    pub fn motion(&self, start: Phase) -> Motion {
        exact(self.g_over_l, start)
    }

    /// The distance of two states: max(|Δθ|, |Δω|/ω₀) (rad), NaN if one of them is.
    pub fn apart(&self, a: Phase, b: Phase) -> f64 {
        apart(self.g_over_l, a, b)
    }

    /// What rounding may make of a run with so many evaluations (rad): each step rounds the state
    /// by ε, which adds up like a random walk in the state and, since an error of the energy is one
    /// of the frequency, grows with the time in the phase. Ten is what the largest of some thousand
    /// such sums may exceed their mean by. Steps are at most as many as evaluations.
    pub fn rounding(&self, evaluations: u64) -> f64 {
        self.rounding_in(evaluations, self.duration)
    }

    /// The same of a run of another duration (s).
    pub fn rounding_in(&self, evaluations: u64, duration: f64) -> f64 {
        let phase = 1.0 + self.frequency() * duration;
        10.0 * self.epsilon * libm::sqrt(evaluations as f64) * phase
    }
}

/// A solver, asked.
#[derive(Clone, Copy)]
pub struct Asked<'s> {
    pub solver: &'s dyn Solver,
    pub scenes: Scenes,
}

impl fmt::Debug for Asked<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Asked").field("scenes", &self.scenes).finish_non_exhaustive()
    }
}

impl Asked<'_> {
    /// The answer, with as many finite states as were asked for.
    pub fn reply(&self, request: &SolveRequest) -> Measured<Reply> {
        checked(self.solver.solve(request)?, request.times.len() as u64)
    }

    /// The passages through zero.
    pub fn crossings(&self, request: &CrossingsRequest) -> Measured<Crossings> {
        Ok(self.solver.crossings(request)?)
    }

    /// The errors (rad) of the states of a request without a drive.
    pub fn errors(&self, request: &SolveRequest) -> Measured<Vec<f64>> {
        let states = self.reply(request)?.states;
        Ok(errors(request, &states))
    }
}

/// The errors (rad) of these states: max(|Δθ|, |Δω|/ω₀).
pub fn errors(request: &SolveRequest, states: &[Phase]) -> Vec<f64> {
    let SolveRequest { g_over_l, start, from, ref times, .. } = *request;
    let motion = exact(g_over_l, start);
    let error = |(t, z): (&f64, &Phase)| apart(g_over_l, *z, motion.at(t - from));
    times.iter().zip(states).map(error).collect()
}

/// The distance of two states: max(|Δθ|, |Δω|/ω₀) (rad), NaN if one of them is.
pub fn apart(g_over_l: f64, a: Phase, b: Phase) -> f64 {
    let along = (a.omega - b.omega).abs() / libm::sqrt(g_over_l);
    libm::fmaximum((a.theta - b.theta).abs(), along)
}

/// Whether these states are numbers of single precision, which is no chance; but for one in ten, as
/// outputs at the ends of steps may be others.
pub fn single(states: &[Phase]) -> bool {
    let is_single = |z: &&Phase| [z.theta, z.omega].into_iter().all(|x| f64::from(x as f32) == x);
    10 * states.iter().filter(is_single).count() >= 9 * states.len()
}

/// A request of no meaning other than to see whether it is understood.
pub fn first() -> SolveRequest {
    Scenes::USUAL.run(Scenes::USUAL.starts[0], 1e-3).to(&[0.1])
}

/// The largest of these errors, NaN if one is.
pub fn largest_of(errors: impl IntoIterator<Item = f64>) -> f64 {
    errors.into_iter().fold(0.0, libm::fmaximum)
}

/// `count` times (s), evenly spaced, the last of them at `end`.
pub fn evenly(count: u32, end: f64) -> Vec<f64> {
    (1..=count)
        .map(|k| if k == count { end } else { end * f64::from(k) / f64::from(count) })
        .collect()
}

/// A power, with its uncertainty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Power {
    /// The power.
    pub value: f64,
    /// How far off it may be: twice the standard error of the line, or half of what separates the
    /// slopes of its two halves if that is more. The second is there because what bends a line is
    /// no chance: the higher terms of long steps.
    pub uncertainty: f64,
}

impl Power {
    /// The power and its uncertainty.
    pub const fn numbers(self) -> [f64; 2] {
        [self.value, self.uncertainty]
    }
}

/// The slope of a line through points (ln x, ln y), by least squares; of at least four, if it is
/// known to more than itself.
pub fn power(points: &[(f64, f64)]) -> Option<Power> {
    let (slope, error) = line(points).filter(|_| points.len() >= 4)?;
    let (first, second) = points.split_at(points.len() / 2);
    let halves = [first, second].map(|half| line(half).map(|(slope, _)| slope));
    let bent = match halves {
        [Some(first), Some(second)] => 0.5 * (first - second).abs(),
        _ => 0.0,
    };
    let value = Power { value: slope, uncertainty: libm::fmax(2.0 * error, bent) };
    (value.uncertainty < value.value.abs().max(1.0)).then_some(value)
}

/// Slope and its standard error.
fn line(points: &[(f64, f64)]) -> Option<(f64, f64)> {
    let n = points.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / n;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let sum =
        |of: &dyn Fn(f64, f64) -> f64| points.iter().map(|p| of(p.0 - x, p.1 - y)).sum::<f64>();
    let (squares, products) = (sum(&|dx, _| dx * dx), sum(&|dx, dy| dx * dy));
    let slope = products / squares;
    let left = sum(&|dx, dy| (dy - slope * dx) * (dy - slope * dx));
    let error = libm::sqrt(left / (n - 2.0).max(1.0) / squares);
    (points.len() >= 2 && squares > 0.0).then_some((slope, error))
}
