//! The symmetries of the pendulum, kept by every method.

use pendula::AnyMethod;
use pendula::verify::symmetry::{check_mass_and_length, check_mirror, check_time, check_turns};
use rstest_reuse::apply;

use crate::common::each_method;

/// Catches: a preferred direction, such as a constant torque of 1e-12, and a sine that is not odd
/// to the last bit.
#[apply(each_method)]
fn the_mirror_image_has_the_same_bits<M: AnyMethod>(#[case] method: M) {
    check_mirror(&method).unwrap();
}

/// Catches: g·L for g/L, a forgotten L, a mass in the motion.
#[apply(each_method)]
fn only_gravity_over_length_counts<M: AnyMethod>(#[case] method: M) {
    check_mass_and_length(&method).unwrap();
}

/// Catches: a step, a frequency or a time that enters with a wrong power; a constant with a hidden
/// unit.
#[apply(each_method)]
fn the_unit_of_time_does_not_count<M: AnyMethod>(#[case] method: M) {
    check_time(&method).unwrap();
}

/// Catches: the linearised sine, degrees for radians, an angle that is wrapped, a sine that loses
/// digits at large angles.
#[apply(each_method)]
fn a_whole_turn_changes_nothing<M: AnyMethod>(#[case] method: M) {
    check_turns(&method).unwrap();
}
