//! The cells of the tables, as predicted by theory, against the measured values.

use std::collections::BTreeSet;

use approx::assert_relative_eq;
use pendula::methods::{ForwardEuler, Rk4, StormerVerlet};
use pendula::metrics::AngleError;
use pendula::{Grid, LinearOscillator, Motion, Pendulum, Phase, integrate_with};
use pendula_study::claims::{Prediction, predictions};
use pendula_study::experiments::{PaperMethod, STEPS, convergence, small_angle};
use pendula_study::theory::small_angle::{
    LinearRecurrence, cancelling_step, errors, floor, own_error_of_stormer_verlet,
};
use rstest::rstest;

use crate::{LEDGER, measured};

/// Each measured cell lies within the tolerance of its law, on either side. The tolerances are
/// derived in `book/study/src/claims/predictions.rs`, from what each law leaves out.
///
/// Catches: a method, metric, constant or number of steps that is wrong but still gives the paper's
/// digits, and one that is as wrong as the paper's: the predictions use no measured number.
#[rstest]
fn every_cell_is_as_predicted(#[values("T4.", "T5.", "T6.", "T8.", "P6.")] table: &str) {
    let cells: Vec<_> = predictions().iter().filter(|cell| cell.id.starts_with(table)).collect();
    assert!(!cells.is_empty());
    for cell in cells {
        let measured = measured(&cell.id);
        let error = cell.relative_error(measured);
        assert!(cell.agrees_with(measured), "{measured:e} is off by {error:.1e}: {cell:?}");
    }
}

/// 4 methods × (5 steps in Table 4, 5 in Table 6, 1 each in Tables 5 and 8), and one number from
/// the text.
///
/// Catches: a cell forgotten, named twice, or out of the ledger's order, so that a join would lose
/// it.
#[test]
fn every_cell_that_theory_reaches_is_predicted() {
    let ids: Vec<&str> = predictions().iter().map(|cell| cell.id.as_str()).collect();
    assert_eq!(ids.len(), PaperMethod::ALL.len() * (2 * STEPS.len() + 2) + 1);
    assert_eq!(ids.iter().collect::<BTreeSet<_>>().len(), ids.len(), "an id stands twice");
    let position = |id: &str| LEDGER.claims().iter().position(|claim| claim.id == id);
    let positions: Vec<_> = ids.iter().map(|id| position(id).expect("in the ledger")).collect();
    assert!(positions.is_sorted(), "{ids:?}");
}

/// Below 6e-4, less than a unit in the third digit, except where the steps are large (0.1 s) and
/// where RK4's error is rounding (0.001 s).
///
/// Catches: a tolerance that grew until anything would agree.
#[test]
fn tolerances_are_small() {
    for cell in predictions().iter() {
        let largest = match cell.id.as_str() {
            "T4.rk4.0.001" => 0.1,
            "T4.fe.0.1" | "T6.fe.0.1" | "T4.rk4.0.1" => 1e-2,
            _ => 6e-4,
        };
        assert!(cell.value > 0.0 && cell.tolerance > 0.0 && cell.tolerance < largest, "{cell:?}");
    }
}

/// A prediction rejects values that are too large or too small.
///
/// Catches: a comparison without `abs`, or of a NaN.
#[test]
fn a_prediction_can_fail() {
    let cell = Prediction { id: String::new(), value: 2.0, tolerance: 1e-2, law: "" };
    assert!(cell.agrees_with(2.01) && cell.agrees_with(1.99));
    assert!(!cell.agrees_with(2.03) && !cell.agrees_with(1.97) && !cell.agrees_with(f64::NAN));
}

/// The linear recurrence with frozen coefficients predicts forward Euler too, as long as the swing
/// stays small: its growth depends on the amplitude as about 1 − A²/8, which over x ω₀T/2 ≤ 0.5
/// e-folds is 4e-4 at A = 0.08.
///
/// Catches: a wrong growth or phase of the recurrence, which the law used for the table, the
/// modified equation, does not contain.
#[rstest]
fn forward_euler_is_predicted_twice(#[values(0.01, 0.005, 0.001)] h: f64) {
    let grid = Grid::with_duration(h, small_angle::DURATION).unwrap();
    let recurrence = LinearRecurrence::forward_euler(&Pendulum::PAPER, h);
    let theta_0 = small_angle::THETA_0;
    let angles = recurrence.angles(theta_0);
    let (predicted, _) = errors(&Pendulum::PAPER, theta_0, h, grid.steps(), angles);
    assert_relative_eq!(predicted, measured(&format!("T6.fe.{h}")), max_relative = 4e-4);
}

/// The law θ₀³ω₀T/(16√6) leaves out ⟨t² cos 2ω₀t⟩, which is at most 3/(2ω₀T) of the mean square,
/// half that of its root; RK4's own x⁴/120 is 5e-5 of θ₀²/16.
///
/// Catches: the paper's floor taken for a constant, or for a property of the methods.
#[rstest]
#[case(10.0)]
#[case(40.0)]
fn what_is_left_at_small_steps_is_the_formulas_own_error(#[case] duration: f64) {
    let (pendulum, theta_0) = (Pendulum::new(9.81, 2.0, 1.0).unwrap(), 0.05);
    let start = Phase::at_rest(theta_0);
    let formula = LinearOscillator::new(pendulum);
    let mut error = AngleError::new(|t| formula.exact(start, t).theta);
    integrate_with(
        &pendulum,
        &Rk4,
        start,
        &Grid::with_duration(0.01, duration).unwrap(),
        &mut error,
    );
    let floor = floor(&pendulum, theta_0, duration);
    let left_out = 0.75 / (pendulum.small_angle_frequency() * duration);
    assert_relative_eq!(error.root_mean_square(), floor, max_relative = left_out);
}

/// At x = θ₀√(3/2) Störmer–Verlet's error and the formula's cancel to the next order, which is
/// smaller by θ₀² and x², each below 0.004: at most a hundredth of the floor is left.
///
/// Catches: a frequency error of Störmer–Verlet other than x²/24.
#[test]
fn two_errors_cancel_at_the_step_foreseen() {
    let (pendulum, theta_0) = (Pendulum::PAPER, small_angle::THETA_0);
    let step = cancelling_step(&pendulum, theta_0);
    let steps = (small_angle::DURATION / step).round();
    let grid = Grid::new(small_angle::DURATION / steps, steps as u64).unwrap();
    let verlet = pendula::method_named("stormer-verlet").unwrap();
    let left = small_angle::errors(verlet, &grid).formula;
    assert!(left < 1e-2 * floor(&pendulum, theta_0, small_angle::DURATION), "{left:e}");
}

/// Störmer–Verlet's own error in the small swing is θ₀ω₀T x²/(24√6). That leaves out ⟨t² cos 2ω₀t⟩,
/// as the floor does; the next term of its phase, 9x²/80 of the first; and θ₀²/8, by which its τ₂
/// falls with the amplitude.
///
/// Catches: a line in the figure that passes near the markers but is not the law; x for x², a
/// period for a duration.
#[rstest]
fn stormer_verlets_own_error_is_that_of_its_phase(
    #[values(0.1, 0.01, 0.001)] h: f64,
    #[values(10.0, 40.0)] duration: f64,
) {
    let (pendulum, theta_0) = (Pendulum::new(9.81, 2.0, 0.7).unwrap(), 0.05);
    let start = Phase::at_rest(theta_0);
    let truth = Motion::new(&pendulum, start).unwrap();
    let mut error = AngleError::new(|t| truth.at(t).theta);
    let grid = Grid::with_duration(h, duration).unwrap();
    integrate_with(&pendulum, &StormerVerlet, start, &grid, &mut error);
    let law = own_error_of_stormer_verlet(&pendulum, theta_0, h, duration);
    let x = pendulum.small_angle_frequency() * h;
    let left_out = 0.75 / (x / h * duration) + 9.0 * x * x / 80.0 + theta_0 * theta_0 / 8.0;
    assert_relative_eq!(error.root_mean_square(), law, max_relative = left_out);
}

/// In Table 4 forward Euler goes over the top at the three largest steps, as it does in Table 5,
/// and within the time that the tolerances of `predictions.rs` suppose.
///
/// Catches: a tolerance derived for a swing where the pendulum rotates.
#[test]
fn forward_euler_goes_over_in_table_4() {
    let when = STEPS.map(|h| {
        let mut first = None;
        let mut look = |_: u64, t: f64, z: Phase| {
            if z.theta.abs() > std::f64::consts::PI {
                first.get_or_insert(t);
            }
        };
        let grid = Grid::with_duration(h, convergence::DURATION).unwrap();
        let start = Phase::at_rest(convergence::THETA_0);
        integrate_with(&Pendulum::PAPER, &ForwardEuler, start, &grid, &mut look);
        first.map(|t| t.round())
    });
    assert_eq!(when, [Some(6.0), Some(5.0), Some(27.0), None, None]);
}
