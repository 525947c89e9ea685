//! Conjugacy: Störmer–Verlet and symplectic Euler are one method, seen from half a kick apart.

mod properties;

use pendula::methods::position_verlet::PositionVerlet;
use pendula::methods::{stormer_verlet::StormerVerlet, symplectic_euler::SymplecticEuler};
use pendula::study::variants::DriftKick;
use properties::conjugacy::check_pair;

/// Catches: any error in one of the two that is not in the other; the position form, drift before kick, a stale force, a
/// wrong weight of a kick.
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
