//! Run time against error, on the reader's machine: every method on three scenes.
//!
//! Wall time is not a result of the study: no snapshot contains it, and the book shows it only
//! where it has been measured. What is measured, and which steps count, is here; the figure in the
//! book, and who leads in it, in [`figure`].

use std::hint::black_box;
use std::time::Instant;

use pendula::metrics::EndError;
use pendula::{Grid, METHODS, Pendulum, Phase};
use pendula_study::experiments::MethodRef;

use crate::book::progress::Progress;

pub mod figure;

/// A release from rest, and the duration of the run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Problem {
    /// Angle of release (rad).
    pub theta0: f64,
    /// Duration (s), a whole number of seconds.
    pub duration: u32,
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
    /// How much of it may be rounding (rad).
    pub rounding: f64,
    /// Median time of a run (s), while climbing the shortest.
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

/// How far each ladder of halved steps is climbed.
#[derive(Clone, Copy, Debug)]
pub enum Budget {
    /// For about so long at most (s), of which each method has its share on each scene, and of what
    /// those before it have left.
    Seconds(f64),
    /// To the first run of more steps, however long that takes.
    Steps(u64),
}

/// Measures as much as the budget allows.
pub fn measure(budget: Budget, progress: &Progress) -> Measured {
    let all = SCENES.iter().flat_map(|scene| METHODS.iter().map(move |method| (*scene, *method)));
    let mut left = SCENES.len() * METHODS.len();
    progress.stage("", left);
    let clock = Instant::now();
    let mut curves = Vec::new();
    for (scene, method) in all {
        progress.next(method.info().title);
        let share = match budget {
            Budget::Seconds(all) => {
                Budget::Seconds((all - clock.elapsed().as_secs_f64()) / left as f64)
            }
            steps @ Budget::Steps(_) => steps,
        };
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

/// With a larger error (rad) the result is no approximation.
const LARGEST: f64 = 1.0;

/// Climbs a ladder of halved steps up to the rounding floor, or as far as the budget allows, and
/// times the rungs that count more carefully.
fn curve(scene: Problem, method: MethodRef, budget: Budget) -> Curve {
    let order = method.info().order;
    let mut rungs: Vec<Measurement> = Vec::new();
    for rate in (0..).map(|doubled| COARSEST << doubled) {
        let rung = climbed(scene, method, rate);
        rungs.push(rung);
        let is_spent = match budget {
            Budget::Seconds(seconds) => 2.0 * rung.seconds > seconds / LADDER,
            Budget::Steps(most) => rung.steps > most,
        };
        if is_spent || is_done(&rungs, order) {
            break;
        }
    }
    let counted = rungs.iter().zip(counts(&rungs, order)).filter(|(_, counts)| *counts);
    Curve { scene, method, points: counted.map(|(rung, _)| timed(scene, method, *rung)).collect() }
}

/// For each rung whether it counts: its error must be at most `LARGEST` and agree with that of the
/// next rung, with half the step. The last rung has no next one and does not count; nor do those
/// after the first on the rounding floor.
fn counts(rungs: &[Measurement], order: u32) -> Vec<bool> {
    let mut ended = false;
    let pairs = rungs.windows(2).map(|pair| {
        let [rung, finer] = [pair[0], pair[1]];
        let credible = is_asymptotic(order, rung.error, finer.error, finer.rounding);
        let counts = !ended && rung.error <= LARGEST && credible;
        ended |= counts && is_floor(rung.error, rung.rounding, finer.error);
        counts
    });
    let mut counts: Vec<bool> = pairs.collect();
    counts.extend((!rungs.is_empty()).then_some(false));
    counts
}

/// Whether no finer rung will count: a rung on the floor counts already, or there are three on it
/// that happen not to count.
fn is_done(rungs: &[Measurement], order: u32) -> bool {
    let pairs = rungs.windows(2).zip(counts(rungs, order));
    let on_the_floor: Vec<bool> = pairs
        .filter(|(pair, _)| is_floor(pair[0].error, pair[0].rounding, pair[1].error))
        .map(|(_, counts)| counts)
        .collect();
    on_the_floor.len() >= 3 || on_the_floor.contains(&true)
}

/// Whether the `error` of a method of this `order` agrees with its order and is not small by
/// chance, judged by the error with half the step, `finer`, of which as much as `rounding` may be
/// rounding.
///
/// The error as a function of the step may cross zero, and near there a poor method looks splendid.
/// But with half the step an error should be 2ᵖ times smaller: if 2ᵖ `finer` is more than three
/// times `error`, then `error` was small by chance, or rounding has been reached. A high order may
/// reach rounding in a single halving. So if `finer` may be rounding, it need only be at most three
/// times `error`.
fn is_asymptotic(order: u32, error: f64, finer: f64, rounding: f64) -> bool {
    let falls = 3.0 * error >= libm::exp2(f64::from(order)) * finer;
    falls || finer <= rounding && 3.0 * error >= finer
}

/// Whether an `error`, of which as much as `rounding` may be rounding, is on the rounding floor:
/// the error with half the step, `finer`, is not less than half of it, as it would be for any
/// method above the floor.
fn is_floor(error: f64, rounding: f64, finer: f64) -> bool {
    error <= rounding && 2.0 * finer >= error
}

/// The rung with `rate` steps a second: its error, and the shortest time of a few runs.
fn climbed(scene: Problem, method: MethodRef, rate: u64) -> Measurement {
    let Problem { theta0, duration } = scene;
    let (dt, steps) = (1.0 / rate as f64, u64::from(duration) * rate);
    let [(end, seconds), others @ ..] = [(); TRIES].map(|()| run(theta0, method, dt, steps));
    let seconds = others.iter().fold(seconds, |shortest, (_, again)| shortest.min(*again));
    let error = EndError::new(&Pendulum::PAPER, Phase::at_rest(theta0), f64::from(duration))
        .expect("a release that has a motion");
    Measurement { dt, steps, error: error.of(end), rounding: error.rounding(steps), seconds }
}

/// The same with the median time of several runs.
fn timed(scene: Problem, method: MethodRef, rung: Measurement) -> Measurement {
    let repeats = (SHORTEST / rung.seconds).clamp(1.0, 1e3).ceil();
    let times = [(); RUNS].map(|()| {
        let clock = Instant::now();
        for _ in 0..repeats as u32 {
            run(scene.theta0, method, rung.dt, rung.steps);
        }
        clock.elapsed().as_secs_f64() / repeats
    });
    Measurement { seconds: median(times), ..rung }
}

fn median(mut times: [f64; RUNS]) -> f64 {
    times.sort_by(f64::total_cmp);
    times[RUNS / 2]
}

/// The last state of a run, and how long it took (s). Without an observer: the cost of the method
/// alone.
fn run(theta0: f64, method: MethodRef, dt: f64, steps: u64) -> (Phase, f64) {
    let grid = Grid::new(dt, steps).expect("a ladder of possible grids");
    let start = Phase::at_rest(theta0);
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
    use rstest::rstest;

    use super::*;

    /// Rungs of a second each, in which rounding may be up to 2e-13.
    fn rungs(errors: &[f64]) -> Vec<Measurement> {
        let rung = |(k, error): (usize, &f64)| Measurement {
            dt: 0.5_f64.powi(k as i32),
            steps: 1 << k,
            error: *error,
            rounding: 2e-13,
            seconds: 1.0,
        };
        errors.iter().enumerate().map(rung).collect()
    }

    /// Catches: a mean, which one disturbed run in five can double; the shortest time or the
    /// longest; the middle of times that are in no order.
    #[test]
    fn a_disturbed_run_does_not_move_the_median() {
        assert_eq!(median([1.0, 1.0, 1.0, 1.0, 9.0]), 1.0);
        assert_eq!(median([9.0, 4.0, 1.0, 2.0, 3.0]), 3.0);
    }

    /// Catches: a step accepted because its error happens to cross zero; a step refused because its
    /// error falls faster than its order requires.
    #[test]
    fn a_lucky_step_is_not_credible() {
        assert!(is_asymptotic(2, 4e-4, 1e-4, 0.0));
        assert!(is_asymptotic(2, 1e-3, 1e-6, 0.0), "the finer one is lucky");
        assert!(!is_asymptotic(2, 1e-6, 2.5e-5, 0.0));
        assert!(is_asymptotic(4, 5.4e-13, 1e-13, 0.0) && !is_asymptotic(4, 5.3e-13, 1e-13, 0.0));
        assert!(!is_asymptotic(1, f64::NAN, 1.0, 2.0) && !is_asymptotic(1, 1.0, f64::NAN, 2.0));
    }

    /// Catches: a method of order 24 that is never accepted, since its errors reach rounding in one
    /// halving; a rounding bound that accepts an error which happens to cross zero.
    #[test]
    fn what_falls_to_rounding_is_credible() {
        assert!(is_asymptotic(24, 1e-8, 1e-13, 2e-13) && !is_asymptotic(24, 1e-8, 3e-13, 2e-13));
        assert!(is_asymptotic(24, 4e-14, 1e-13, 1e-13) && !is_asymptotic(24, 3e-14, 1e-13, 1e-13));
    }

    /// The bounds are powers of two, so that an f64 lies on each of them and its neighbour just
    /// beyond.
    ///
    /// Catches: a bound slightly too high or too low, or only one of the two conditions checked.
    #[test]
    fn an_error_on_the_floor_may_be_rounding_and_does_not_fall() {
        assert!(is_floor(1.0, 1.0, 0.5) && is_floor(0.25, 1.0, 4.0));
        assert!(!is_floor(1.0_f64.next_up(), 1.0, 1.0), "more than rounding");
        assert!(!is_floor(1.0, 1.0, 0.5_f64.next_down()), "it falls");
        assert!(!is_floor(f64::NAN, 1.0, 1.0) && !is_floor(1.0, 1.0, f64::NAN));
    }

    /// Catches: a step whose error happens to cross zero taken for a good step; rungs counted as
    /// the method's after the first that is on the floor of rounding, or before its order holds; a
    /// last rung trusted without a finer one; a method of high order that reaches the floor in one
    /// halving, and gets no rung for it.
    #[rstest]
    #[case::lucky_crossing(2, &[1.6e-2, 4e-3, 1e-6, 2.5e-4, 6.25e-5, 1.6e-5], &[0, 1, 3, 4])]
    #[case::floor(4, &[3.0, 0.5, 3.1e-2, 2e-3, 1.2e-4, 1e-13, 2e-13, 9e-14], &[1, 2, 3, 4, 5])]
    #[case::high_order(24, &[2e-4, 3e-9, 1e-13, 9e-14], &[1, 2])]
    #[case::no_number(1, &[f64::NAN, 1e-3, 2e-3], &[])]
    #[case::alone(1, &[1e-3], &[])]
    #[case::none(1, &[], &[])]
    fn rungs_count(#[case] order: u32, #[case] errors: &[f64], #[case] expected: &[usize]) {
        let counts = counts(&rungs(errors), order);
        assert_eq!(counts.len(), errors.len());
        let counted: Vec<usize> = (0..counts.len()).filter(|i| counts[*i]).collect();
        assert_eq!(counted, expected);
    }

    /// Catches: a ladder ended at a zero crossing of the error, or before its first rung that
    /// counts; one that never ends.
    #[test]
    fn a_ladder_ends_on_the_floor() {
        assert!(!is_done(&rungs(&[]), 4) && !is_done(&rungs(&[1e-13]), 4));
        assert!(!is_done(&rungs(&[1e-3, 6e-5, 1e-13]), 4));
        assert!(!is_done(&rungs(&[1e-3, 6e-5, 1e-13, 2e-7]), 4));
        assert!(is_done(&rungs(&[1e-3, 6e-5, 1e-13, 2e-13]), 4));
        let unlucky = rungs(&[1e-3, 1e-14, 4e-14, 1.5e-13, 6e-13]);
        assert!(!is_done(&unlucky[..4], 4) && is_done(&unlucky, 4));
    }
}
