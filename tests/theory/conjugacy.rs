//! Conjugacy: Störmer–Verlet and symplectic Euler are the same map up to half a kick, the
//! trapezoidal rule and the implicit midpoint rule up to half a step of forward Euler, and a
//! processed method is its kernel up to a change of variables.

use pendula::methods::{
    DiscreteGradient, ImplicitMidpoint, PositionVerlet, Processed4, Processed6, StormerVerlet,
    SymplecticEuler, Trapezoidal,
};
use pendula::verify::conjugacy::{
    PROCESSED_4, PROCESSED_6, check_implicit_pair, check_pair, check_processed,
};
use pendula_study::experiments::variants::DriftKick;

/// Catches: any error in one of the two that is not in the other; the position form, drift before
/// kick, a stale force, a wrong weight of a kick.
#[test]
fn verlet_is_symplectic_euler_between_half_kicks() {
    check_pair(&StormerVerlet, &SymplecticEuler).unwrap();
}

/// Catches: a check that any two symplectic methods would pass.
#[test]
fn other_variants_are_not_conjugate_by_half_a_kick() {
    assert!(check_pair(&PositionVerlet, &SymplecticEuler).is_err());
    assert!(check_pair(&StormerVerlet, &DriftKick).is_err());
}

/// Catches: any error in one of the two that is not in the other; an iteration that stops early.
#[test]
fn the_trapezoidal_rule_is_the_midpoint_rule_between_half_steps_of_euler() {
    check_implicit_pair(&Trapezoidal, &ImplicitMidpoint).unwrap();
}

/// Catches: a check that any two implicit methods of order 2 would pass, or the two exchanged.
#[test]
fn other_implicit_methods_are_not_conjugate_by_half_a_step_of_euler() {
    assert!(check_implicit_pair(&ImplicitMidpoint, &Trapezoidal).is_err());
    assert!(check_implicit_pair(&DiscreteGradient, &ImplicitMidpoint).is_err());
    assert!(check_implicit_pair(&Trapezoidal, &DiscreteGradient).is_err());
}

/// Catches: a processor that is not undone by its inverse, or only to some power of the step; a
/// kernel with another coefficient; a state of the kernel handed out as the seen one; a change of
/// variables in each step, where rounding adds up.
#[test]
fn a_processed_method_is_its_kernel_between_changes_of_variables() {
    check_processed(&Processed4, &PROCESSED_4).unwrap();
    check_processed(&Processed6, &PROCESSED_6).unwrap();
}

/// Catches: a check that the kernel alone would pass, or another processor.
#[test]
fn a_kernel_is_not_its_processed_method() {
    assert!(check_processed(&PositionVerlet, &PROCESSED_4).is_err());
    let mut alone = PROCESSED_4;
    alone.processor = [0.0; 3];
    assert!(check_processed(&Processed4, &alone).is_err());
    let mut linear = PROCESSED_6;
    linear.processor[1..].fill(0.0);
    assert!(check_processed(&Processed6, &linear).is_err());
}
