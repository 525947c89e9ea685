//! The law, the curve and the map for choosing an integrator, on constructed errors.

use pendula::method_named;
use pendula_study::experiments::choosing::{Curve, Profile, Release, Rung, THETA_0};
use pendula_study::experiments::{MethodRef, evaluations};

fn named(name: &str) -> MethodRef {
    method_named(name).expect("a method of the library")
}

fn rung(steps: f64, growth: [f64; 3]) -> Rung {
    Rung { steps, periods: 8, growth: vec![[0.0; 3], growth], seen: Vec::new() }
}

/// e₀ + e₁n + e₂n² at both ends of the run, and at its vertex where that lies between.
///
/// Catches: a wrong vertex, one outside the run that counts, a sign that hides an error.
#[test]
fn the_largest_error_is_at_an_end_or_at_the_vertex() {
    let hump = rung(64.0, [0.0, 8.0, -2.0]);
    assert_eq!(
        [1, 2, 3, 4, 5, 7].map(|periods| hump.error(periods)),
        [0.0, 6.0, 8.0, 8.0, 8.0, 24.0]
    );
    let apart = rung(64.0, [-3.0, 4.0, 2.0]);
    assert_eq!([1, 2, 3].map(|periods| apart.error(periods)), [3.0, 3.0, 13.0]);
    let seen = Rung { seen: vec![0.5, 0.75], ..hump };
    assert_eq!([1, 2, 3].map(|periods| seen.error(periods)), [0.5, 0.75, 8.0]);
}

/// At each phase the law is exact but for what swings within eight periods. What was seen has each
/// phase once in the last eight periods, the largest error up to eight periods before the end, when
/// it was less: of 64 periods by an eighth at most, and less where the phases of large errors come
/// in between.
///
/// Catches: a phase of a later period counted as one of the first, as the errors of coarse steps
/// repeat their phases after eight periods only.
#[test]
fn in_coarse_steps_the_law_is_what_was_seen() {
    let release = Release::new(THETA_0);
    for (name, steps) in [("blanes-moan-6", 9.375), ("dop853", 9.625), ("processed-6", 20.125)] {
        let rung = Rung::measure(named(name), &release, steps, &release.exact(steps));
        let law = Rung { seen: Vec::new(), ..rung.clone() };
        for periods in [64, 128, rung.seen.len() as u64] {
            let ratio = law.error(periods) / rung.error(periods);
            assert!((ratio - 1.0).abs() < 0.03, "{name} after {periods}: {ratio}");
        }
    }
}

/// Catches: a method whose action does not drift, by either property, fitted with a drift; one
/// whose action does, fitted without.
#[test]
fn only_a_method_without_symmetry_drifts() {
    let release = Release::new(THETA_0);
    let truth = release.exact(32.0);
    let drift = |name| Rung::measure(named(name), &release, 32.0, &truth).drift();
    assert!(drift("rk4") > 0.0);
    // Symplectic and not symmetric, and both.
    assert_eq!(["symplectic-euler", "stormer-verlet"].map(drift), [0.0, 0.0]);
}

/// The steps of those of the two rungs that RK4's curve over `periods` periods keeps, and up to
/// which they are measured.
fn kept(rungs: [Rung; 2], periods: u64) -> (Vec<f64>, f64) {
    let release = Release::new(THETA_0);
    let profile = Profile { method: named("rk4"), release, rungs: rungs.to_vec() };
    let curve = profile.over(periods);
    (
        curve.points.iter().map(|(steps, _)| *steps).filter(|steps| *steps <= 64.0).collect(),
        curve.known,
    )
}

/// Of coarse steps the curve has what was seen, and in longer runs what follows from the law, but
/// no less than was seen.
///
/// Catches: a rung dropped because its steps are long, or kept though the implicit method found no
/// solution in some of its steps; an extrapolated error taken for a measured one; one in short
/// steps dropped as if they were coarse.
#[test]
fn of_coarse_steps_the_curve_knows_what_was_seen() {
    let last = Release::new(THETA_0).coarse;
    assert_eq!(last, 24.0);
    let coarse = |steps, last| Rung {
        seen: vec![0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, last],
        ..rung(steps, [0.25, 0.125, 0.0])
    };
    let fine = || rung(64.0, [0.25, 0.0, 0.0]);
    assert_eq!(kept([coarse(23.875, 0.5), fine()], 8), (vec![23.875, 64.0], 64.0));
    assert_eq!(kept([coarse(23.875, 0.5), fine()], 9), (vec![23.875, 64.0], 0.0));
    assert_eq!([8, 9, 16].map(|n| coarse(23.875, 0.5).error(n)), [0.5, 1.25, 2.125]);
    assert_eq!(coarse(23.875, 3.0).error(9), 3.0);
    for lost in [f64::NAN, f64::INFINITY] {
        assert_eq!(kept([coarse(23.875, lost), fine()], 7).0, [23.875, 64.0]);
        assert_eq!(kept([coarse(23.875, lost), fine()], 8).0, [64.0]);
        assert_eq!(kept([coarse(23.875, lost), fine()], 9).0, [64.0]);
    }
    assert!(kept([rung(24.0, [f64::NAN, 0.0, 0.0]), fine()], 8).0.is_empty());
}

/// RK4's curve through these steps a period and errors (rad).
fn curve(periods: u64, points: &[(f64, f64)]) -> Curve {
    let points = points.iter().map(|(n, e)| (*n, libm::log(*e))).collect();
    let (method, release) = (named("rk4"), Release::new(THETA_0));
    Curve { method, release, periods, points, known: 0.0, finest: 0.0 }
}

/// From one number of steps to the next it is chance in which of them a last digit asks for
/// one sweep more: of a single count a hundredth, of the mean of fourteen 0.3 % at most,
/// measured.
/// An eighth of the period counts 0.8 to 3.5 % too many, as its first step has none before it
/// to begin from.
///
/// Catches: the evaluations of an implicit method counted over a part of the period that is not
/// like the whole, such as an eighth; those of one period taken for those of the run; a mean
/// over steps that were not taken.
#[test]
fn evaluations_are_those_of_the_whole_run() {
    let release = Release::new(THETA_0);
    for method in pendula::METHODS.iter().copied().filter(|method| method.info().implicit) {
        for periods in [1, 5] {
            let all = (24..=128).step_by(8).map(f64::from);
            let excess = all.clone().map(|steps| {
                let curve =
                    Curve { method, release, periods, points: Vec::new(), known: 0.0, finest: 0.0 };
                let grid = release.grid(steps, periods);
                let whole = evaluations(method, release.start, &grid);
                curve.evaluations(steps) as f64 / whole as f64 - 1.0
            });
            let mean = excess.sum::<f64>() / all.count() as f64;
            assert!(mean.abs() < 5e-3, "{method:?} over {periods} periods: {mean}");
        }
    }
}

/// In steps so short that the second sweep or the third changes rounding alone, it depends on
/// the phase which it is. Some steps from each eighth of a period count as the whole of it to
/// 2 %, measured; as many from its beginning count 5 to 7 % too few.
///
/// Catches: the first steps of a long period taken for the whole of it, or eight times those of
/// one eighth.
#[test]
fn evaluations_are_those_of_every_eighth() {
    let release = Release::new(THETA_0);
    let many = [("implicit-midpoint", [7.2e5, 8.5e5]), ("gauss-4", [5.4e5, 6.4e5])];
    for (name, steps) in many {
        for steps in steps {
            let (method, points) = (named(name), Vec::new());
            let curve = Curve { method, release, periods: 1, points, known: 0.0, finest: 0.0 };
            let grid = release.grid(steps, 1);
            let whole = evaluations(method, release.start, &grid);
            let excess = curve.evaluations(steps) as f64 / whole as f64 - 1.0;
            assert!(excess.abs() < 0.03, "{name} in {steps} steps: {excess}");
        }
    }
}

/// Catches: an error off its chord, or beyond the curve; steps for an error that the curve does
/// not reach.
#[test]
fn between_two_rungs_the_curve_is_a_chord() {
    let curve = curve(3, &[(32.0, 1e-2), (64.0, 1e-4), (128.0, 1e-5)]);
    // Half-way between the rungs on logarithmic axes, but for rounding to whole steps.
    for (steps, expected) in [(32.0, 1e-2), (64.0, 1e-4), (128.0, 1e-5)] {
        assert!((curve.error(steps) / expected - 1.0).abs() < 1e-13);
    }
    let at = |n: f64, (m, e): (f64, f64), power: f64| e * libm::pow(n / m, -power);
    assert!((curve.error(45.0) / at(45.0, (32.0, 1e-2), libm::log2(100.0)) - 1.0).abs() < 1e-13);
    assert!((curve.error(90.0) / at(90.0, (64.0, 1e-4), libm::log2(10.0)) - 1.0).abs() < 1e-13);
    assert!(curve.error(31.0).is_nan() && curve.error(129.0).is_nan());
    for n in [45.0, 90.0] {
        let steps = curve.steps_for(curve.error(n)).unwrap();
        assert!((steps / n - 1.0).abs() < 1e-13, "{steps}");
    }
    for none in [f64::NAN, -1.0, 0.0, 9e-6] {
        assert_eq!(curve.steps_for(none), None);
    }
}

/// Catches: a run of more steps than can be counted, a limit that is off.
#[test]
fn a_run_too_long_to_be_counted_is_not_advised() {
    let advice = |periods| curve(periods, &[(1024.0, 1e99), (2048.0, 1e98)]).advice(1e100);
    let most = pendula::error::MAX_STEPS / 1024;
    assert_eq!(advice(most).map(|advice| advice.steps), Some(1024.0));
    assert!(advice(most + 1).is_none());
}
