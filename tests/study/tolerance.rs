//! What a tolerance promises: what a count tells of an estimate, and outputs of an interpolant.

use pendula_study::experiments::tolerance::{
    CUBIC, OWN_INTERPOLANT, Run, SIGN_TURNED, along, of_the_zoo, power_of_estimate, run, slope,
    solvers, tolerances,
};

/// The tolerances below 10⁻⁶: their steps are short enough.
fn small() -> impl Iterator<Item = f64> {
    tolerances(12).filter(|tol| *tol < 2e-6)
}

/// Along a line over six decades, 13.8 in ln tol, ln evaluations is off by attempts that are
/// refused, one in twenty or none at either end: 0.1; by some four steps in which a run finds its
/// step, of 120 at the loose end with order 5 and of 50 with order 8: 0.03 and 0.08; and by the
/// higher terms of the estimate in the longest steps, a third of the first term with order 5, and
/// as large as it with order 8: ln(4/3)/5 = 0.06 and ln(2)/8 = 0.09. Together 0.19 moves 1/5 by
/// 0.014, and 0.27 moves 1/8 by 0.02.
const FIVE: f64 = 0.4;
const EIGHT: f64 = 1.5;
/// Where the estimate is h/20 of the slope, a thousand steps and more are all alike: a step more or
/// less is 0.001, and the slope of a line over two decades, 4.6 in ln tol, is off by less than
/// that.
const ONE: f64 = 0.01;

/// An estimate of power q makes the evaluations grow as tol^(−1/q).
///
/// Catches: a wrong weight of the estimate, which no order test sees: the run is as accurate as can
/// be, and takes ten times the steps for a tenth of the tolerance.
#[test]
fn evaluations_tell_the_power_of_an_estimate() {
    let [(_, dormand_prince), (_, dop853), _] = solvers();
    let power = |solver: &dyn pendula_judge::Solver, tolerances: Vec<f64>| {
        let runs: Vec<Run> = tolerances.into_iter().map(|tol| run(solver, tol)).collect();
        power_of_estimate(&runs)
    };
    let five = power(&*dormand_prince, small().collect());
    assert!((five - 5.0).abs() < FIVE, "{five}");
    let eight = power(&*dop853, small().collect());
    assert!((eight - 8.0).abs() < EIGHT, "{eight}");
    let turned = of_the_zoo(SIGN_TURNED);
    let one = power(&*turned, tolerances(5).collect());
    assert!((one - 1.0).abs() < ONE, "{one}");
    // It is not wrong, only hopeless.
    let (right, hopeless) = (run(&*dormand_prince, 1e-3), run(&*turned, 1e-3));
    assert!(hopeless.error < 1e-6 * right.error, "{hopeless:?} for {right:?}");
    assert!(hopeless.evaluations > 30.0 * right.evaluations, "{hopeless:?} for {right:?}");
}

/// The error of a cubic through two states and slopes goes with the fourth power of the step. The
/// longest of a hundred steps, whose error is looked at, is longer than the mean by a factor that
/// changes by a fifth from run to run: 4 · ln 1.2 over a line of ln evaluations that is 1.2 long,
/// if both ends have moved; along thirteen points less than half of it.
const CUBIC_POWER: f64 = 0.3;

/// Catches: outputs by a cubic between steps of order 8, which a test that looks at the end of a
/// run does not see.
#[test]
fn a_cubic_spoils_only_what_lies_between_the_steps() {
    let [own, cubic] = [OWN_INTERPOLANT, CUBIC].map(of_the_zoo);
    let mut points = Vec::new();
    for tol in small() {
        let [right, wrong] = [&own, &cubic].map(|solver| run(&**solver, tol));
        assert_eq!(right.error, wrong.error, "the ends of a run");
        let [right, spoilt] = [&own, &cubic].map(|solver| {
            let errors = along(&**solver, tol, 2000).into_iter().map(|(_, error)| error);
            errors.fold(0.0, f64::max)
        });
        if tol < 2e-8 {
            assert!(spoilt > 1e4 * right, "{tol:e}: {spoilt:e} for {right:e}");
        }
        points.push((wrong.evaluations.ln(), -spoilt.ln()));
    }
    let power = slope(points.into_iter());
    assert!((power - 4.0).abs() < CUBIC_POWER, "{power}");
}
