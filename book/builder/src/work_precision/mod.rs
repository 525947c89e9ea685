//! Run time against error, on the reader's machine: every method on three scenes.
//!
//! Wall time is no result of the study: it stands in no snapshot, and the book shows it only where it has been measured.
//! In reading order: what is measured, here; which steps count, in [`ladder`]; the picture, and its place in the
//! book, in [`figure`].

use std::hint::black_box;
use std::time::Instant;

use pendula::study::MethodRef;
use pendula::{Grid, METHODS, Motion, Pendulum, Phase};

use crate::progress::Progress;

pub mod figure;
pub mod ladder;

/// A release from rest, and how long it is followed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scene {
    /// Angle of release (rad).
    pub theta0: f64,
    /// Duration (s), a whole number of seconds.
    pub duration: u32,
}

/// A wide swing, one that lingers near the top, and a long run.
pub const SCENES: [Scene; 3] = [
    Scene { theta0: 1.0, duration: 100 },
    Scene { theta0: 3.0, duration: 30 },
    Scene { theta0: 1.0, duration: 1000 },
];

/// A number of steps, what it comes to, and what it costs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Step Δt (s).
    pub dt: f64,
    /// Number of steps.
    pub steps: u64,
    /// max(|Δθ|, |Δω|/ω₀) at the end, against the closed form (rad).
    pub error: f64,
    /// Median time of a run (s).
    pub seconds: f64,
}

/// What a method comes to on a scene.
#[derive(Clone, Debug)]
pub struct Curve {
    /// The scene.
    pub scene: Scene,
    /// The method.
    pub method: MethodRef,
    /// The steps that count, from the longest to the shortest.
    pub points: Vec<Point>,
}

/// All that has been measured, and on what.
#[derive(Clone, Debug)]
pub struct Measured {
    /// The machine's instructions: what its time depends on.
    pub instructions: &'static str,
    /// A curve for each scene and method, scene by scene.
    pub curves: Vec<Curve>,
}

/// Measures for at most about `seconds`.
pub fn measure(seconds: f64, progress: &Progress) -> Measured {
    let count = SCENES.len() * METHODS.len();
    let share = seconds / count as f64;
    progress.stage("", count);
    let pairs = SCENES.into_iter().flat_map(|scene| METHODS.iter().map(move |m| (scene, *m)));
    let curves = pairs.map(|(scene, method)| {
        progress.next(method.properties().title);
        Curve { scene, method, points: points(scene, method, share) }
    });
    let curves = curves.collect();
    progress.finish();
    Measured { instructions: instructions(), curves }
}

/// Steps a second on the coarsest rung. It is a power of two, as is their number on all finer ones: n Δt is exact, and
/// the clock has no part in the error.
const COARSEST: u64 = 4;

/// Runs of which the median is taken.
const RUNS: usize = 5;

/// A shorter run is repeated until it has taken this long (s): a thousand ticks of the clock.
const SHORTEST: f64 = 1e-4;

/// Climbs the ladder as far as `share` (s) allows, then times the rungs that count.
fn points(scene: Scene, method: MethodRef, share: f64) -> Vec<Point> {
    let order = method.properties().order;
    let mut rungs: Vec<Point> = Vec::new();
    // With every rung the time doubles: all rungs take twice as long as the last. The last is not timed again, so
    // that timing takes RUNS times as long as it.
    let affordable = share / (RUNS + 2) as f64;
    loop {
        let rung = climbed(scene, method, COARSEST << rungs.len());
        rungs.push(rung);
        let errors: Vec<f64> = rungs.iter().map(|rung| rung.error).collect();
        let counts = ladder::counts(&errors, order);
        if 2.0 * rung.seconds > affordable || ladder::is_done(&counts, rung.error, rung.steps) {
            let counted =
                rungs.iter().zip(counts).filter_map(|(rung, counts)| counts.then_some(rung));
            return counted.map(|rung| timed(scene, method, *rung)).collect();
        }
    }
}

/// The rung with so many steps a second: its error, and the time of a first run.
fn climbed(scene: Scene, method: MethodRef, rate: u64) -> Point {
    let Scene { theta0, duration } = scene;
    let steps = u64::from(duration) * rate;
    let dt = 1.0 / rate as f64;
    let (end, seconds) = run(scene, method, dt, steps);
    let pendulum = Pendulum::PAPER;
    let motion =
        Motion::new(&pendulum, Phase::at_rest(theta0)).expect("a release that has a motion");
    let truth = motion.at(f64::from(duration));
    let omega = (end.omega - truth.omega) / pendulum.small_angle_frequency();
    Point { dt, steps, error: (end.theta - truth.theta).abs().max(omega.abs()), seconds }
}

/// The same with its time measured in earnest.
fn timed(scene: Scene, method: MethodRef, rung: Point) -> Point {
    let repeats = (SHORTEST / rung.seconds).clamp(1.0, 1e3).ceil();
    let mut times = [(); RUNS].map(|()| {
        let clock = Instant::now();
        for _ in 0..repeats as u32 {
            run(scene, method, rung.dt, rung.steps);
        }
        clock.elapsed().as_secs_f64() / repeats
    });
    times.sort_by(f64::total_cmp);
    Point { seconds: times[RUNS / 2], ..rung }
}

/// The last state of a run, and how long it took (s). Nobody watches: that is the cost of the method alone.
fn run(scene: Scene, method: MethodRef, dt: f64, steps: u64) -> (Phase, f64) {
    let grid = Grid::new(dt, steps).expect("a ladder of possible grids");
    let start = Phase::at_rest(scene.theta0);
    let clock = Instant::now();
    let end = method.end(&Pendulum::PAPER, black_box(start), black_box(&grid));
    let end = black_box(end);
    // Nothing takes no time: the clock is coarse.
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

    /// Catches: a clock that adds to the error, an end time that is not the scene's.
    #[test]
    fn every_rung_ends_when_its_scene_does() {
        for scene in SCENES {
            for doubled in 0..20 {
                let rate = COARSEST << doubled;
                let grid = Grid::new(1.0 / rate as f64, u64::from(scene.duration) * rate).unwrap();
                assert_eq!(grid.time(grid.steps()), f64::from(scene.duration));
            }
        }
    }
}
