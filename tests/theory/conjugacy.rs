//! Conjugacy: Störmer–Verlet and symplectic Euler are the same map up to half a kick.

use pendula::methods::{PositionVerlet, StormerVerlet, SymplecticEuler};
use pendula::verify::conjugacy::check_pair;
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
