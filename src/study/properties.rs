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
    /// det J − 1 of one step of 0.1 s at θ = 1 rad, ω = 0.5 rad/s: how much the area grows.
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
    pub const fn symplectic(&self) -> bool {
        self.area_defect.abs() < AREA_TOLERANCE
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
            area_defect: area_defect(run.method, &Pendulum::PAPER, AREA_STATE, AREA_STEP),
            evaluations: evaluations(run.method),
            energy: energy_behaviour(run),
        })
        .collect()
}

/// The run on which order is measured (s): from 1 rad, and no whole number of periods, where symmetry would flatter.
pub const DURATION: f64 = 2.7;

/// Errors of the state on a ladder of halved steps.
#[derive(Clone, Copy, Debug)]
pub struct Ladder {
    /// Steps (s), each half the one before.
    pub steps: [f64; 5],
    /// Largest max(|Δθ|, |Δω|/ω₀) over the run against the closed form (rad), at each step.
    pub errors: [f64; 5],
}

impl Ladder {
    /// Errors below this are made of rounding as much as of truncation (rad): up to 16 384 steps, each rounded by
    /// 2e-16 in θ and in ω, add up to 4e-12 at the worst. Three times that bends a slope by less than a half.
    pub const ROUNDING_FLOOR: f64 = 1.2e-11;

    /// Climbs the ladder with `method`. The higher the order it claims, the coarser the first rung, so that all five
    /// lie between where the leading term dominates and where rounding does.
    pub fn climb(method: &dyn AnyMethod) -> Self {
        let coarsest = 2048_u64 >> method.properties().order.min(8);
        let rungs = [0, 1, 2, 3, 4].map(|k| coarsest << k);
        Self {
            steps: rungs.map(|n| DURATION / n as f64),
            errors: rungs.map(|n| largest_error(method, n)),
        }
    }

    /// The slope of each pair of neighbours above the rounding floor.
    pub fn slopes(&self) -> impl Iterator<Item = f64> {
        slopes(&self.steps, &self.errors, Self::ROUNDING_FLOOR).flatten()
    }
}

/// Largest error of the state, max(|Δθ|, |Δω|/ω₀) (rad), over a run of `steps` steps.
///
/// The pendulum is not the paper's: with L ≠ 1 no g·L, and with m ≠ 1 no mass in the motion, converges to the truth.
fn largest_error(method: &dyn AnyMethod, steps: u64) -> f64 {
    let pendulum = Pendulum::new(9.81, 0.8, 1.7).expect("parameters in range");
    let start = released(1.0);
    let motion = Motion::new(&pendulum, start).expect("a finite start");
    let grid = Grid::new(DURATION / steps as f64, steps).expect("a positive step");
    let mut largest = 0.0_f64;
    method.run(&pendulum, start, &grid, &mut |_, t: f64, z: Phase| {
        let truth = motion.at(t);
        let angle = (z.theta - truth.theta).abs();
        let velocity = (z.omega - truth.omega).abs() / pendulum.small_angle_frequency();
        largest = largest.max(angle).max(velocity);
    });
    largest
}

/// Where Table 2 measures the area …
const AREA_STATE: Phase = Phase { theta: 1.0, omega: 0.5 };
/// … and with which step (s).
const AREA_STEP: f64 = 0.1;

/// Half the width of the central difference that measures det J.
const DELTA: f64 = 1e-4;

/// What the central difference may be off by: each of four derivatives by rounding, ε θ/δ ≈ 2e-12 for a state of
/// order 1, and by truncation, δ²/6 times a third derivative of order h² g/L ≈ 0.1 times a slope of order 1: 2e-10.
pub const AREA_TOLERANCE: f64 = 5e-10;

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

fn energy_behaviour(run: &long_run::Row) -> EnergyBehaviour {
    let energy = run.initial + Pendulum::PAPER.depth();
    if run.drift <= 1.01 * run.early_drift {
        EnergyBehaviour::BoundedOscillation
    } else if run.drift < 0.01 * energy {
        EnergyBehaviour::SlowSecularDrift
    } else if run.falls == 0 {
        EnergyBehaviour::MonotonicDrift
    } else {
        EnergyBehaviour::DriftWithFalls
    }
}
