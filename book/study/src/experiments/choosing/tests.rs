//! The law, the curve and the map, on constructed errors.

use pendula::exact::Motion;
use pendula::{Pendulum, Phase, method_named};

use super::error_law::{CLEAR, LARGE, PHASES, Rung};
use super::*;
use crate::experiments::MethodRef;

fn named(name: &str) -> MethodRef {
    method_named(name).expect("a method of the library")
}

fn rung(steps: u64, growth: [f64; 3]) -> Rung {
    Rung { steps, periods: 8, growth: vec![[0.0; 3], growth], seen: Vec::new() }
}

/// e₀ + e₁n + e₂n² at both ends of the run, and at its vertex where that lies between.
///
/// Catches: a wrong vertex, one outside the run that counts, a sign that hides an error.
#[test]
fn the_largest_error_is_at_an_end_or_at_the_vertex() {
    let hump = rung(64, [0.0, 8.0, -2.0]);
    assert_eq!(
        [1, 2, 3, 4, 5, 7].map(|periods| hump.error(periods)),
        [0.0, 6.0, 8.0, 8.0, 8.0, 24.0]
    );
    let apart = rung(64, [-3.0, 4.0, 2.0]);
    assert_eq!([1, 2, 3].map(|periods| apart.error(periods)), [3.0, 3.0, 13.0]);
    let seen = Rung { seen: vec![0.5, 0.75], ..hump };
    assert_eq!([1, 2, 3].map(|periods| seen.error(periods)), [0.5, 0.75, 8.0]);
}

/// The errors of 2q + 1 periods, q being `half`, that follow the law with these coefficients at
/// the first phase, and with half of them at the others.
fn lawful(steps: usize, half: usize, [e0, e1, e2]: [f64; 3]) -> Vec<f64> {
    let period = |n: usize| {
        let error = e0 + n as f64 * (e1 + n as f64 * e2);
        core::iter::once(error).chain(core::iter::repeat_n(0.5 * error, steps - 1))
    };
    (0..=2 * half).flat_map(period).collect()
}

/// The numbers are binary fractions, and nothing is rounded.
///
/// Catches: a coefficient off by a factor; one of a drift where there is none; phases mixed up,
/// or left out where they are few.
#[test]
fn the_law_is_found_in_errors_that_follow_it() {
    let law = [1.0 / 1024.0, -3.0 / 4096.0, 1.0 / 16_384.0];
    for steps in [COARSE as usize, 100, 512] {
        let rung = Rung::fit(&lawful(steps, 8, law), steps, true);
        assert_eq!((rung.steps, rung.periods), (steps as u64, 16));
        assert_eq!(rung.growth[0], law);
        assert!(rung.growth[1..].iter().all(|e| *e == law.map(|e| 0.5 * e)));
        assert_eq!(rung.growth.len(), steps.min(PHASES));
        assert!(rung.seen.is_empty());
    }
    let straight = Rung::fit(&lawful(32, 8, [law[0], law[1], 0.0]), 32, false);
    assert_eq!(straight.growth[0], [law[0], law[1], 0.0]);
    // Without e₂ a curved law is replaced by its chord from the first period to the last.
    let chord = Rung::fit(&lawful(32, 8, law), 32, false);
    assert_eq!(chord.growth[0], [law[0], law[1] + 16.0 * law[2], 0.0]);
}

/// Catches: a law fitted to errors too large for it; a run cut too short, or to nothing.
#[test]
fn where_the_error_is_large_a_shorter_run_is_taken() {
    let periods = |e1: f64| Rung::fit(&lawful(32, 8, [0.0, e1, 0.0]), 32, false).periods;
    assert_eq!(periods(LARGE.next_down() / 16.0), 16);
    assert_eq!(periods(LARGE / 16.0), 8);
    assert_eq!(periods(LARGE / 4.0), 2);
    assert_eq!([LARGE, f64::NAN].map(periods), [2, 2]);
}

/// Catches: the last error taken for the largest, and steps just fine enough taken for coarse
/// ones.
#[test]
fn in_coarse_steps_the_largest_error_so_far_is_kept() {
    let rung = Rung::fit(&[1.0, -2.0, 0.0, 1.0, -3.0, 3.5], 2, false);
    assert_eq!((rung.steps, rung.periods), (2, 3));
    assert_eq!(rung.seen, [2.0, 2.0, 3.5]);
    let steps = COARSE as usize;
    assert!(Rung::fit(&lawful(steps, 1, [0.0; 3]), steps, false).seen.is_empty());
    assert_eq!(Rung::fit(&lawful(steps - 1, 1, [0.0; 3]), steps - 1, false).seen, [0.0; 3]);
}

/// Catches: a method whose action does not drift, by either property, fitted with a drift; one
/// whose action does, fitted without.
#[test]
fn only_a_method_without_symmetry_drifts() {
    let release = Release::new();
    let motion = Motion::new(&Pendulum::PAPER, release.start).unwrap();
    let grid = release.grid(32, 1);
    let truth: Vec<Phase> = (1..=32).map(|n| motion.at(grid.time(n))).collect();
    let drift = |name| Rung::measure(named(name), &release, &truth).drift();
    assert!(drift("rk4") > 0.0);
    // Symplectic and not symmetric, and both.
    assert_eq!(["symplectic-euler", "stormer-verlet"].map(drift), [0.0, 0.0]);
}

/// The steps of those of the two rungs that RK4's curve over `periods` periods keeps.
fn kept(rungs: [Rung; 2], periods: u64) -> Vec<u64> {
    let profile = Profile { method: named("rk4"), release: Release::new(), rungs: rungs.to_vec() };
    let points = profile.over(periods).points;
    points.iter().map(|(steps, _)| *steps as u64).collect()
}

/// Eight periods of 64 steps, with an error of ten times what rounding adds. Beyond the measured
/// run the rounding is extrapolated: in proportion to the length, or, where the action drifts, to
/// four times its square.
///
/// Catches: an error made of rounding that counts, a clear one that does not, a shorter run
/// treated as one beyond the measured.
#[test]
fn an_error_counts_where_it_is_clear_of_rounding() {
    let rounding = Release::new().rounding(named("rk4"), 64, 8);
    let at = |bound: f64, periods, growth: [f64; 3]| {
        let coarser = rung(32, [1.0, 0.0, 0.0]);
        let [e0, e1, e2] = growth.map(|e| e * bound);
        kept([coarser, rung(64, [e0, e1, e2])], periods)
    };
    for (periods, carried) in [(1, 1.0), (8, 1.0), (24, 3.0)] {
        let bound = CLEAR * carried * rounding;
        assert_eq!(at(bound, periods, [1.0, 0.0, 0.0]), [32], "{periods}");
        assert_eq!(at(bound.next_up(), periods, [1.0, 0.0, 0.0]), [32, 64], "{periods}");
        let drifting = [1.0, 0.0, 1e-20];
        assert_eq!(at(4.0 * carried * bound * (1.0 - 1e-9), periods, drifting), [32]);
        assert_eq!(at(4.0 * carried * bound * (1.0 + 1e-9), periods, drifting), [32, 64]);
    }
}

/// Catches: a law used where steps are too coarse for it, a rung dropped though its whole run was
/// measured, the run of an implicit method that found no solution, and one in short steps dropped
/// as if it were coarse.
#[test]
fn of_coarse_steps_the_curve_knows_what_was_seen() {
    let coarse = |steps, last| Rung {
        seen: vec![0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, last],
        ..rung(steps, [0.5, 0.0, 0.0])
    };
    let fine = || rung(64, [0.25, 0.0, 0.0]);
    assert_eq!(kept([coarse(COARSE - 1, 0.5), fine()], 8), [COARSE - 1, 64]);
    assert_eq!(kept([coarse(COARSE - 1, 0.5), fine()], 9), [64]);
    assert_eq!(kept([rung(COARSE, [0.5, 0.0, 0.0]), fine()], 9), [COARSE, 64]);
    for lost in [f64::NAN, f64::INFINITY] {
        assert_eq!(kept([coarse(COARSE - 1, lost), fine()], 7), [COARSE - 1, 64]);
        assert_eq!(kept([coarse(COARSE - 1, lost), fine()], 8), [64]);
    }
    assert!(kept([rung(COARSE, [f64::NAN, 0.0, 0.0]), fine()], 8).is_empty());
}

/// RK4 with a drift that falls with the fourth power of the step, and with the fifth, on rungs
/// over two octaves and over four.
///
/// Catches: a power that is not the measured one, or not rounded to the order or the next.
#[test]
fn a_drift_goes_on_with_its_own_power() {
    for power in [4, 5] {
        for octave in [2_u64, 4] {
            let drift = |k: u32| 1e-4 / (octave.pow(k * power) as f64);
            let rungs = (0..3).map(|k| rung(32 * octave.pow(k), [0.0, 0.0, drift(k)])).collect();
            let profile = Profile { method: named("rk4"), release: Release::new(), rungs };
            let curve = profile.over(11);
            let last = 32 * octave.pow(2);
            // e₂ · 10², and sixteen times as many steps.
            let expected = 100.0 * drift(2) / (16_u64.pow(power) as f64);
            let error = curve.error(16 * last);
            // Powers and logarithms of numbers up to 50.
            assert!((error / expected - 1.0).abs() < 1e-12, "{power}, {octave}: {error:e}");
        }
    }
}

/// The curve of a method through these steps a period and errors (rad).
fn curve(name: &str, periods: u64, points: &[(f64, f64)]) -> Curve {
    let points = points.iter().map(|(n, e)| (*n, libm::log(*e))).collect();
    Curve { method: named(name), release: Release::new(), periods, points }
}

/// Half an octave beyond 16 steps a period there are 22.6, rounded to 23, with the error of 23.
///
/// Catches: the error of 22.6 steps; e₂ extrapolated with the power of the others.
#[test]
fn a_rung_below_the_last_has_whole_steps() {
    let finer = rung(16, [1.0, -0.5, 0.25]).refined(core::f64::consts::SQRT_2, 4.0, 5.0);
    let (by, drift) = (libm::pow(23.0 / 16.0, -4.0), libm::pow(23.0 / 16.0, -5.0));
    assert_eq!((finer.steps, finer.periods), (23, 8));
    assert_eq!(finer.growth, [[0.0; 3], [by, -0.5 * by, 0.25 * drift]]);
}

/// Catches: an error off its chord, or beyond the curve; steps for an error that the curve does
/// not reach.
#[test]
fn between_two_rungs_the_curve_is_a_chord() {
    let curve = curve("rk4", 3, &[(32.0, 1e-2), (64.0, 1e-4), (128.0, 1e-5)]);
    // Half-way between the rungs on logarithmic axes, but for rounding to whole steps.
    for (steps, expected) in [(32, 1e-2), (64, 1e-4), (128, 1e-5)] {
        assert!((curve.error(steps) / expected - 1.0).abs() < 1e-13);
    }
    let at = |n: f64, (m, e): (f64, f64), power: f64| e * libm::pow(n / m, -power);
    assert!((curve.error(45) / at(45.0, (32.0, 1e-2), libm::log2(100.0)) - 1.0).abs() < 1e-13);
    assert!((curve.error(90) / at(90.0, (64.0, 1e-4), libm::log2(10.0)) - 1.0).abs() < 1e-13);
    assert!(curve.error(31).is_nan() && curve.error(129).is_nan());
    for n in [45, 90] {
        let steps = curve.steps_for(curve.error(n)).unwrap();
        assert!((steps / n as f64 - 1.0).abs() < 1e-13, "{steps}");
    }
    for none in [f64::NAN, -1.0, 0.0, 9e-6] {
        assert_eq!(curve.steps_for(none), None);
    }
}

/// Catches: a chord where the rungs are too coarse for one, also at the first that is not; a
/// step more than a rung has, by rounding.
#[test]
fn coarse_rungs_are_taken_as_they_are() {
    let coarse = COARSE as f64;
    let points = [(8.0, 2.0), (11.0, 1.0), (coarse, 1e-2), (2.0 * coarse, 1e-4)];
    let curve = curve("rk4", 3, &points);
    assert_eq!([3.0, 1.5, 0.5].map(|wanted| curve.steps_for(wanted).unwrap()), [8.0, 11.0, coarse]);
    let between = curve.steps_for(1e-3).unwrap();
    assert!(between > 1.2 * coarse && between < 1.6 * coarse, "{between}");
}

/// Catches: a run of more steps than can be counted, a limit that is off.
#[test]
fn a_run_too_long_to_be_counted_is_not_advised() {
    let advice = |periods| curve("rk4", periods, &[(1024.0, 1e99), (2048.0, 1e98)]).advice(1e100);
    let most = pendula::error::MAX_STEPS / 1024;
    assert_eq!(advice(most).map(|advice| advice.steps), Some(1024));
    assert!(advice(most + 1).is_none());
}

/// Catches: evaluations counted once, or for one period; a count of sweeps in other steps than the
/// run's, or in one place.
#[test]
fn the_force_is_counted_over_the_whole_run() {
    let of = |name, steps| curve(name, 3, &[(32.0, 1.0), (64.0, 0.1)]).evaluations(steps);
    assert_eq!((of("rk4", 50), of("stormer-verlet", 50)), (600, 151));
    let release = Release::new();
    // Counted from only one eighth, the second is off by 3.8 %.
    for (name, steps) in [("gauss-4", 50), ("gauss-6", 3000)] {
        let grid = release.grid(steps, 3);
        let counted = named(name).count_evaluations(&Pendulum::PAPER, release.start, &grid);
        let carried = of(name, steps) as f64;
        // Where the number of sweeps changes, half an eighth of the period is miscounted by one
        // sweep in five or so: 1.3 %, and a swing has two such places.
        assert!((carried / counted as f64 - 1.0).abs() < 0.03, "{carried} and {counted}");
    }
}
