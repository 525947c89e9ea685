//! Conjugacy: Störmer–Verlet and symplectic Euler are the same map up to half a kick, the
//! trapezoidal rule and the implicit midpoint rule up to half a step of forward Euler, and a
//! processed method is its kernel up to a change of variables.

use approx::assert_relative_eq;
use pendula::methods::{
    DiscreteGradient, ImplicitMidpoint, PositionVerlet, Processed4, Processed6, StormerVerlet,
    SymplecticEuler, Trapezoidal,
};
use pendula::{Grid, Pendulum, Phase, Separable, integrate};
use pendula_judge::properties::CheckResult;
use pendula_judge::properties::conjugacy::{
    PROCESSED_4, PROCESSED_6, check_implicit_pair, check_pair, check_processed,
};
use pendula_judge::zoo::euler::DriftKick;

/// Ten times what rounding may do.
const VISIBLE: f64 = 7e-11;

/// Catches: any error in one of the two methods that is not in the other: the position form, drift
/// before kick, a stale force, a wrong weight of a kick.
#[test]
fn verlet_is_symplectic_euler_between_half_kicks() {
    check_pair(&StormerVerlet, &SymplecticEuler).unwrap();
}

/// Symplectic Euler is not symmetric, but half a kick away from a method that is: so it retraces
/// its way if the velocity is reversed there, ω → −(ω + h α). Reversed in place it does not.
/// Rounding adds up to about 1e-13 in a hundred seconds.
///
/// Catches: the old velocity in the drift, or another force in the kick than that of the start.
#[test]
fn symplectic_euler_goes_home_by_a_reversal_of_its_own() {
    let pendulum = Pendulum::new(19.62, 2.0, 1.0).unwrap();
    let grid = Grid::with_duration(0.01, 100.0).unwrap();
    let start = Phase::at_rest(1.0);
    let missed = |part_of_a_kick: f64| {
        let reversed = |z: Phase| {
            let kick = part_of_a_kick * grid.step() * pendulum.force(0.0, z);
            Phase { omega: -(z.omega + kick), ..z }
        };
        let run = |z| integrate(&pendulum, &SymplecticEuler, z, &grid);
        let back = reversed(run(reversed(run(start))));
        (back.theta - start.theta).abs() + (back.omega - start.omega).abs()
    };
    assert!(missed(1.0) < 1e-11, "{}", missed(1.0));
    assert!(missed(0.0) > 0.1, "{}", missed(0.0));
}

/// By how much the two differ, according to the check, in `what` (θ or ω) after a single step,
/// which is as soon as they can.
fn apart_at_once(what: &str, checked: CheckResult) -> f64 {
    let said = checked.expect_err("they are not conjugate");
    assert!(said.starts_with(&format!("{what} after 1 steps")), "{said}");
    let (_, values) = said.split_once(" is ").expect("two values");
    let mut values = values.split([',', ' ']).filter_map(|word| word.parse::<f64>().ok());
    let [one, other] = [(); 2].map(|()| values.next().expect("a value"));
    (one - other).abs()
}

/// From rest at 1 rad with g/L = 2.5 1/s² in a step of 0.05 s: kicks at the wrong end of a drift
/// are a drift of h α too much, and the kick in the middle of the drift finds the angle as it was,
/// which is h³α''/4 in ω, to the next order in h.
///
/// Catches: a check that any two symplectic methods would pass, or that fails for another reason.
#[test]
fn other_variants_are_not_conjugate_by_half_a_kick() {
    let (h, pull, (sine, cosine)) = (0.05_f64, 2.5, 1.0_f64.sin_cos());
    let drifts = apart_at_once("θ", check_pair(&StormerVerlet, &DriftKick));
    assert_relative_eq!(drifts, h * h * pull * sine, max_relative = 1e-9);
    let kicks = apart_at_once("ω", check_pair(&PositionVerlet, &SymplecticEuler));
    let second = pull * cosine * pull * sine;
    assert_relative_eq!(kicks, h.powi(3) * second / 4.0, max_relative = h);
}

/// Catches: any error in one of the two that is not in the other; an iteration that stops early.
#[test]
fn the_trapezoidal_rule_is_the_midpoint_rule_between_half_steps_of_euler() {
    check_implicit_pair(&Trapezoidal, &ImplicitMidpoint).unwrap();
}

/// Catches: a check that any two implicit methods of order 2 would pass, or the two exchanged.
#[test]
fn other_implicit_methods_are_not_conjugate_by_half_a_step_of_euler() {
    assert!(apart_at_once("θ", check_implicit_pair(&ImplicitMidpoint, &Trapezoidal)) > VISIBLE);
    assert!(
        apart_at_once("θ", check_implicit_pair(&DiscreteGradient, &ImplicitMidpoint)) > VISIBLE
    );
    assert!(apart_at_once("θ", check_implicit_pair(&Trapezoidal, &DiscreteGradient)) > VISIBLE);
}

/// Catches: a processor that is not undone by its inverse, or only to some power of the step; a
/// kernel with another coefficient; a state of the kernel returned as the seen one; a change of
/// variables in each step, where rounding adds up.
#[test]
fn a_processed_method_is_its_kernel_between_changes_of_variables() {
    check_processed(&Processed4, &PROCESSED_4).unwrap();
    check_processed(&Processed6, &PROCESSED_6).unwrap();
}

/// Catches: a check that the kernel alone would pass, or another processor.
#[test]
fn a_kernel_is_not_its_processed_method() {
    assert!(apart_at_once("θ", check_processed(&PositionVerlet, &PROCESSED_4)) > VISIBLE);
    let mut alone = PROCESSED_4;
    alone.processor = [0.0; 3];
    assert!(apart_at_once("θ", check_processed(&Processed4, &alone)) > VISIBLE);
    let mut linear = PROCESSED_6;
    linear.processor[1..].fill(0.0);
    assert!(apart_at_once("θ", check_processed(&Processed6, &linear)) > VISIBLE);
}
