//! The properties of each method, measured and not declared: the paper's Table 2.

use core::fmt;

use super::{MethodRef, long_run, released};
use crate::catalogue::AnyMethod;
use crate::exact::Motion;
use crate::order::slopes;
use crate::{Grid, Pendulum, Phase};

/// A row of Table 2.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// The method.
    pub method: MethodRef,
    /// Errors of the state on a ladder of steps.
    pub ladder: Ladder,
    /// det J − 1 of one step at θ = 1 rad, ω = 0.5 rad/s: how much the area grows.
    pub area_defect: f64,
    /// Force evaluations a step, counted.
    pub evaluations: f64,
    /// What the energy does over the 1000 s of Table 5.
    pub energy: EnergyBehaviour,
}

impl Row {
    /// The slope between the two finest rungs above the rounding floor.
    pub fn order(&self) -> f64 {
        self.ladder.slopes().last().unwrap_or(f64::NAN)
    }

    /// Whether one step preserves area, to the accuracy of the finite difference that measures it.
    pub fn symplectic(&self) -> bool {
        self.area_defect.abs() < area_tolerance(area_step(self.method))
    }
}

/// What a method's energy error does over a long run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EnergyBehaviour {
    /// It reaches its bound in the first tenth of the run and never leaves it.
    BoundedOscillation,
    /// It grows, and is still a small part of the energy at the end.
    SlowSecularDrift,
    /// It grows to more than the energy itself, at every step.
    MonotonicDrift,
    /// It grows to more than the energy itself, but many a step takes energy away.
    DriftWithFalls,
}

impl fmt::Display for EnergyBehaviour {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::BoundedOscillation => "Bounded oscillation",
            Self::SlowSecularDrift => "Slow secular drift",
            Self::MonotonicDrift => "Monotonic drift",
            Self::DriftWithFalls => "Drift with falls",
        })
    }
}

/// Measures each method; what its energy does is read off the long run.
pub fn run(long_run: &[long_run::Row]) -> Vec<Row> {
    long_run
        .iter()
        .map(|run| Row {
            method: run.method,
            ladder: Ladder::climb(run.method),
            area_defect: area_defect(
                run.method,
                &Pendulum::PAPER,
                AREA_STATE,
                area_step(run.method),
            ),
            evaluations: evaluations(run.method),
            energy: energy_behaviour(run),
        })
        .collect()
}

/// The run on which order is measured (s): from 1 rad, and no whole number of periods, where symmetry would flatter.
pub const DURATION: f64 = 2.7;

/// Errors of the state on a ladder of steps.
#[derive(Clone, Copy, Debug)]
pub struct Ladder {
    /// Steps (s), each shorter than the one before by the same factor, to a whole number of steps: a half up to order 4,
    /// and beyond such that the error falls sixteenfold from rung to rung, so that there is room for five. Beyond order
    /// 8 it falls 2¹⁶-fold: with errors that differ by less, in steps so long, chance would make the slope.
    pub steps: [f64; 5],
    /// Largest max(|Δθ|, |Δω|/ω₀) over the run against the closed form (rad), at each step.
    pub errors: [f64; 5],
    /// How far the slope between a rung and the next may be from the order, if the method has its order.
    ///
    /// Up to order 4, and of a symmetric method up to order 8, 0.05: the second term of the error is at most 1/30 of the
    /// first at the coarsest rung, which bends the slope between it and the next by less than 0.03.
    ///
    /// Of other methods up to order 8 as much and 3/2 x, with x = ω₀h: the second term is smaller than the first by one
    /// power of x and not by two, and not by a small factor, as those methods are made for a first term that is small. Of
    /// Dormand–Prince's it is 1.4 x.
    ///
    /// Beyond, the steps above rounding are not short against the time in which the motion changes, 1/ω₀; an error is its
    /// first term, or half or twice that, and a slope over the factor f in the step is uncertain by ln 4 / ln f: by 2 of
    /// 16, by 3 of 24.
    pub windows: [f64; 4],
}

impl Ladder {
    /// Climbs the ladder with `method`, from the coarsest step with which its own error shows that the leading term
    /// dominates: the next is smaller by a power of the step, and so, at order p, by about the p-th root of the error.
    pub fn climb(method: &dyn AnyMethod) -> Self {
        let entry = method.properties();
        let order = f64::from(entry.order.max(1));
        let (shortest, powers, smallest) =
            if entry.order > 8 { (4.0, 16.0, 1e-6) } else { (8.0, 4.0, 1e-8) };
        let asymptotic = libm::pow(0.03, order).max(smallest);
        let factor = libm::exp2((powers / order).min(1.0));
        let firsts = (0..).map(|k| rung(shortest, factor, k));
        let first =
            firsts.take_while(|n| *n < 65_536).find(|n| largest_error(method, *n) < asymptotic);
        let rungs = [0, 1, 2, 3, 4].map(|k| rung(first.unwrap_or(65_536) as f64, factor, k));
        let steps = rungs.map(|n| DURATION / n as f64);
        let window = |k: usize| {
            if entry.order > 8 {
                libm::log(4.0) / libm::log(steps[k] / steps[k + 1])
            } else if entry.symmetric || entry.order <= 4 {
                0.05
            } else {
                0.05 + 1.5 * pendulum().small_angle_frequency() * steps[k]
            }
        };
        Self {
            steps,
            errors: rungs.map(|n| largest_error(method, n)),
            windows: [0, 1, 2, 3].map(window),
        }
    }

    /// The slope of each pair of neighbours above the rounding floor.
    pub fn slopes(&self) -> impl Iterator<Item = f64> {
        self.slopes_and_windows().map(|(slope, _)| slope)
    }

    /// The same, each with how far it may be from the order.
    pub fn slopes_and_windows(&self) -> impl Iterator<Item = (f64, f64)> {
        let pairs = (0..4).zip(slopes(&self.steps, &self.errors, 0.0));
        // Errors below this (rad) are made of rounding as much as of truncation: each of N steps is rounded by 2e-16 in θ
        // and in ω, which adds up to 2N · 2e-16 at the worst. Twice that bends a slope by less than a half.
        let above = |k: usize| self.errors[k] > 4.0 * 2.2e-16 * (DURATION / self.steps[k]);
        pairs.filter_map(move |(k, slope)| {
            slope.filter(|_| above(k) && above(k + 1)).map(|slope| (slope, self.windows[k]))
        })
    }
}

/// The pendulum on which order is measured. It is not the paper's: with L ≠ 1 no g·L, and with m ≠ 1 no mass in the
/// motion, converges to the truth.
fn pendulum() -> Pendulum {
    Pendulum::new(9.81, 0.8, 1.7).expect("parameters in range")
}

/// The number of steps on the `k`-th rung above `first`.
fn rung(first: f64, factor: f64, k: u32) -> u64 {
    libm::round(first * libm::pow(factor, f64::from(k))) as u64
}

/// Largest error of the state, max(|Δθ|, |Δω|/ω₀) (rad), over a run of `steps` steps; NaN if there is a state that is
/// none.
fn largest_error(method: &dyn AnyMethod, steps: u64) -> f64 {
    let pendulum = pendulum();
    let start = released(1.0);
    let motion = Motion::new(&pendulum, start).expect("a finite start");
    let grid = Grid::new(DURATION / steps as f64, steps).expect("a positive step");
    let mut largest = 0.0_f64;
    method.run(&pendulum, start, &grid, &mut |_, t: f64, z: Phase| {
        let truth = motion.at(t);
        let angle = (z.theta - truth.theta).abs();
        let velocity = (z.omega - truth.omega).abs() / pendulum.small_angle_frequency();
        largest = [angle, velocity].into_iter().fold(largest, libm::fmaximum);
    });
    largest
}

/// Where Table 2 measures the area …
const AREA_STATE: Phase = Phase { theta: 1.0, omega: 0.5 };
/// … and with which step (s).
pub const AREA_STEP: f64 = 0.1;

/// The step (s) of which the area is measured: [`AREA_STEP`], and four times that beyond order 4, where so short a step
/// changes area by no more than the measurement can see, whatever the method.
fn area_step(method: MethodRef) -> f64 {
    if method.properties().order > 4 { 4.0 * AREA_STEP } else { AREA_STEP }
}

/// Half the width of the central difference that measures det J.
const DELTA: f64 = 1e-4;

/// What the central difference may be off by: each of four derivatives by rounding, ε θ/δ ≈ 2e-12 for a state of
/// order 1, and by truncation, δ²/6 times a third derivative of order h² g/L ≈ 0.1 times a slope of order 1: 2e-10.
pub const AREA_TOLERANCE: f64 = 5e-10;

/// The same for a step of `h` (s): the third derivative goes with h², and rounding stays.
///
/// # Panics
/// For a step shorter than [`AREA_STEP`], where rounding would be more than this.
pub const fn area_tolerance(h: f64) -> f64 {
    let ratio = h / AREA_STEP;
    assert!(ratio >= 1.0, "rounding is more than this");
    AREA_TOLERANCE * ratio * ratio
}

// ANCHOR: area_defect
/// det J − 1 of one step of `h` (s) at `z`, by central differences: by how much the step inflates area in phase space.
pub fn area_defect(method: &dyn AnyMethod, pendulum: &Pendulum, z: Phase, h: f64) -> f64 {
    let one_step = Grid::new(h, 1).expect("a positive step");
    let image = |theta, omega| method.run(pendulum, Phase { theta, omega }, &one_step, &mut ());
    let along = |plus: Phase, minus: Phase| {
        let width = 2.0 * DELTA;
        ((plus.theta - minus.theta) / width, (plus.omega - minus.omega) / width)
    };
    let (j11, j21) = along(image(z.theta + DELTA, z.omega), image(z.theta - DELTA, z.omega));
    let (j12, j22) = along(image(z.theta, z.omega + DELTA), image(z.theta, z.omega - DELTA));
    j11 * j22 - j12 * j21 - 1.0
}
// ANCHOR_END: area_defect

/// Evaluations a step: the difference between a run of 1001 steps and one of a single step, so that what a method
/// does once before it begins does not count.
fn evaluations(method: MethodRef) -> f64 {
    let count = |steps| {
        let grid = Grid::new(0.01, steps).expect("a positive step");
        method.count_evaluations(&Pendulum::PAPER, released(1.0), &grid)
    };
    (count(1001) - count(1)) as f64 / 1000.0
}

/// What rounding makes of the energy in the 10⁵ steps of the long run (J): each rounds some 5 J by 1e-16 of it or a few, at
/// random, which adds up to 3e-13, and to ten times that if luck is bad.
pub const ROUNDING: f64 = 3e-12;

fn energy_behaviour(run: &long_run::Row) -> EnergyBehaviour {
    let energy = run.initial + Pendulum::PAPER.depth();
    if run.drift <= 1.01 * run.early_drift + ROUNDING {
        EnergyBehaviour::BoundedOscillation
    } else if run.drift < 0.01 * energy {
        EnergyBehaviour::SlowSecularDrift
    } else if run.falls == 0 {
        EnergyBehaviour::MonotonicDrift
    } else {
        EnergyBehaviour::DriftWithFalls
    }
}
