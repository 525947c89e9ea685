//! Reversal: forward, flip the velocity, forward again. The end state tells symmetric methods from
//! the others.

use pendula::AnyMethod;
use pendula::verify::properties::reversal::check;

/// Catches: symplectic Euler posing as Störmer–Verlet, half a kick lost or doubled on one side,
/// damping of 1e-12 a step; and an entry that wrongly claims or denies symmetry.
fn symmetric_methods_return_and_no_others_do(method: &dyn AnyMethod) {
    check(method).unwrap();
}
each_method!(symmetric_methods_return_and_no_others_do);
