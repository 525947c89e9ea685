//! Run time against error, on the reader's machine: every method on three scenes.
//!
//! Wall time is not a result of the study: no snapshot contains it, and the book shows it only
//! where it has been measured. In reading order: what is measured, here; which steps count, in
//! [`ladder`]; who leads, in [`front`]; the figure in the book, in [`figure`].

use std::hint::black_box;
use std::time::Instant;

use ladder::Rung;
use pendula::metrics::EndError;
use pendula::{Grid, METHODS, Pendulum, Phase};
use pendula_study::experiments::MethodRef;

use pendula_book::progress::Progress;

pub mod figure;
pub mod front;
pub mod ladder;

/// A release from rest, and the duration of the run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Problem {
    /// Angle of release (rad).
    pub theta0: f64,
    /// Duration (s), a whole number of seconds.
    pub duration: u32,
}

impl Problem {
    /// The number of steps at `rate` steps a second.
    fn steps(self, rate: u64) -> u64 {
        u64::from(self.duration) * rate
    }
}

/// A wide swing, one that lingers near the top, and a long run.
pub const SCENES: [Problem; 3] = [
    Problem { theta0: 1.0, duration: 100 },
    Problem { theta0: 3.0, duration: 30 },
    Problem { theta0: 1.0, duration: 1000 },
];

/// A number of steps, with its error and its cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measurement {
    /// Step Δt (s).
    pub dt: f64,
    /// Number of steps.
    pub steps: u64,
    /// max(|Δθ|, |Δω|/ω₀) at the end, against the closed form (rad).
    pub error: f64,
    /// Median time of a run (s).
    pub seconds: f64,
}

/// The results of a method on a scene.
#[derive(Clone, Debug)]
pub struct Curve {
    /// The scene.
    pub scene: Problem,
    /// The method.
    pub method: MethodRef,
    /// The steps that count, from the longest to the shortest.
    pub points: Vec<Measurement>,
}

/// All that has been measured, and on what.
#[derive(Clone, Debug)]
pub struct Measured {
    /// The vector instructions of the machine, on which its time depends.
    pub instructions: &'static str,
    /// A curve for each scene and method, scene by scene.
    pub curves: Vec<Curve>,
}

/// Measures for at most about `seconds`, of which each method has its share on each scene, and of
/// what those before it have left.
pub fn measure(seconds: f64, progress: &Progress) -> Measured {
    let all = SCENES.iter().flat_map(|scene| METHODS.iter().map(move |method| (*scene, *method)));
    let mut left = SCENES.len() * METHODS.len();
    progress.stage("", left);
    let clock = Instant::now();
    let mut curves = Vec::new();
    for (scene, method) in all {
        progress.next(method.info().title);
        let share = (seconds - clock.elapsed().as_secs_f64()) / left as f64;
        curves.push(curve(scene, method, share));
        left -= 1;
    }
    progress.finish();
    Measured { instructions: instructions(), curves }
}

/// Steps a second on the coarsest rung. A power of two, as on all finer rungs: n Δt is exact, so
/// that rounding of the time adds nothing to the error.
const COARSEST: u64 = 4;

/// Runs of which the shortest counts while climbing, so that other load on the machine does not
/// decide.
const TRIES: usize = 3;

/// Runs of which the median is taken.
const RUNS: usize = 5;

/// The cost of a ladder, in runs of its last rung. The time doubles from rung to rung: all rungs
/// together take twice as long as the last, and those before it as long as the last; of these, the
/// ones that count are timed again.
const LADDER: f64 = (2 * TRIES + RUNS) as f64;

/// A shorter run is repeated until it has taken this long (s): a thousand ticks of the clock.
const SHORTEST: f64 = 1e-4;

/// Climbs the ladder up to the rounding floor, or for about `seconds`, and times the rungs that
/// count more carefully.
fn curve(scene: Problem, method: MethodRef, seconds: f64) -> Curve {
    let order = method.info().order;
    let rates = || (0..).map(|doubled| COARSEST << doubled);
    let mut rungs: Vec<Rung> = Vec::new();
    for rate in rates() {
        let rung = climbed(scene, method, rate);
        rungs.push(rung);
        if 2.0 * rung.seconds > seconds / LADDER || ladder::is_done(&rungs, order) {
            break;
        }
    }
    let counted = rungs.iter().zip(rates()).zip(ladder::counts(&rungs, order));
    let points = counted
        .filter(|(_, counts)| *counts)
        .map(|((rung, rate), _)| timed(scene, method, *rung, rate));
    Curve { scene, method, points: points.collect() }
}

/// The rung with `rate` steps a second: its error, and the shortest time of a few runs.
fn climbed(scene: Problem, method: MethodRef, rate: u64) -> Rung {
    let Problem { theta0, duration } = scene;
    let [(end, seconds), others @ ..] = [(); TRIES].map(|()| run(scene, method, rate));
    let seconds = others.iter().fold(seconds, |shortest, (_, again)| shortest.min(*again));
    let error = EndError::new(&Pendulum::PAPER, Phase::at_rest(theta0), f64::from(duration))
        .expect("a release that has a motion");
    Rung { error: error.of(end), rounding: error.rounding(scene.steps(rate)), seconds }
}

/// The same with the median time of several runs.
fn timed(scene: Problem, method: MethodRef, rung: Rung, rate: u64) -> Measurement {
    let repeats = (SHORTEST / rung.seconds).clamp(1.0, 1e3).ceil();
    let times = [(); RUNS].map(|()| {
        let clock = Instant::now();
        for _ in 0..repeats as u32 {
            run(scene, method, rate);
        }
        clock.elapsed().as_secs_f64() / repeats
    });
    let (dt, steps) = (1.0 / rate as f64, scene.steps(rate));
    Measurement { dt, steps, error: rung.error, seconds: median(times) }
}

fn median(mut times: [f64; RUNS]) -> f64 {
    times.sort_by(f64::total_cmp);
    times[RUNS / 2]
}

/// The last state of a run, and how long it took (s). Without an observer: the cost of the method
/// alone.
fn run(scene: Problem, method: MethodRef, rate: u64) -> (Phase, f64) {
    let grid = Grid::new(1.0 / rate as f64, scene.steps(rate)).expect("a ladder of possible grids");
    let start = Phase::at_rest(scene.theta0);
    let clock = Instant::now();
    let end = method.end(&Pendulum::PAPER, black_box(start), black_box(&grid));
    let end = black_box(end);
    // A coarse clock may show zero.
    (end, clock.elapsed().as_secs_f64().max(1e-9))
}

/// The best vector instructions of this machine, or the name of its architecture.
fn instructions() -> &'static str {
    #[cfg(target_arch = "x86_64")]
    {
        let has = [
            (is_x86_feature_detected!("avx512f"), "x86-64 with AVX-512"),
            (is_x86_feature_detected!("avx2"), "x86-64 with AVX2"),
            (is_x86_feature_detected!("avx"), "x86-64 with AVX"),
        ];
        has.into_iter().find_map(|(has, name)| has.then_some(name)).unwrap_or("x86-64 with SSE2")
    }
    #[cfg(not(target_arch = "x86_64"))]
    std::env::consts::ARCH
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: a mean, which one disturbed run in five can double; the shortest time or the
    /// longest; the middle of times that are in no order.
    #[test]
    fn a_disturbed_run_does_not_move_the_median() {
        assert_eq!(median([1.0, 1.0, 1.0, 1.0, 9.0]), 1.0);
        assert_eq!(median([9.0, 4.0, 1.0, 2.0, 3.0]), 3.0);
    }

    /// Catches: a clock that adds to the error, an end time that is not the scene's.
    #[test]
    fn every_rung_ends_when_its_scene_does() {
        for scene in SCENES {
            for doubled in 0..20 {
                let rate = COARSEST << doubled;
                let grid = Grid::new(1.0 / rate as f64, scene.steps(rate)).unwrap();
                assert_eq!(grid.time(grid.steps()), f64::from(scene.duration));
            }
        }
    }
}
