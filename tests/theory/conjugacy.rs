//! Conjugacy: Störmer–Verlet and symplectic Euler are the same map up to half a kick, and the
//! trapezoidal rule and the implicit midpoint rule up to half a step of forward Euler.

use pendula::methods::{
    DiscreteGradient, ImplicitMidpoint, PositionVerlet, StormerVerlet, SymplecticEuler, Trapezoidal,
};
use pendula::verify::conjugacy::{check_implicit_pair, check_pair};
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
