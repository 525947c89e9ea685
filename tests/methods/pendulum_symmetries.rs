//! The symmetries of the pendulum, kept by every method.

use pendula::AnyMethod;
use pendula::verify::properties::symmetry::{
    check_mass_and_length, check_mirror, check_time, check_turns,
};

/// Catches: a preferred direction, such as a constant torque of 1e-12, and a sine that is not odd
/// to the last bit.
fn the_mirror_image_has_the_same_bits(method: &dyn AnyMethod) {
    check_mirror(method).unwrap();
}
each_method!(the_mirror_image_has_the_same_bits);

/// Catches: g·L for g/L, a forgotten L, a mass in the motion.
fn only_gravity_over_length_counts(method: &dyn AnyMethod) {
    check_mass_and_length(method).unwrap();
}
each_method!(only_gravity_over_length_counts);

/// Catches: a step, a frequency or a time that enters with a wrong power; a constant with a hidden
/// unit.
fn the_unit_of_time_does_not_count(method: &dyn AnyMethod) {
    check_time(method).unwrap();
}
each_method!(the_unit_of_time_does_not_count);

/// Catches: the linearised sine, degrees for radians, an angle that is wrapped, a sine that loses
/// digits at large angles.
fn a_whole_turn_changes_nothing(method: &dyn AnyMethod) {
    check_turns(method).unwrap();
}
each_method!(a_whole_turn_changes_nothing);
