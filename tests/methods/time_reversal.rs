//! Reversal: forward, flip the velocity, forward again. The end state tells symmetric methods from
//! the others.

use pendula::AnyMethod;
use pendula::verify::properties::REVERSAL;

/// 100 000 steps of 0.01 s from 1 rad, and as many back, miss the start by at most 1e-13 rad and
/// 1e-10 ω₀, what a random walk of roundings makes of energy and phase, if the method is symmetric.
/// Of the others each misses by more than 1e-9, in steps of 0.01 s or, the higher the order, longer
/// ones. `src/verify/properties/reversal.rs` derives these numbers.
///
/// Catches: symplectic Euler posing as Störmer–Verlet, half a kick lost or doubled on one side,
/// damping of 1e-12 a step; and an entry that wrongly claims or denies symmetry.
fn symmetric_methods_return_and_no_others_do(method: &dyn AnyMethod) {
    REVERSAL.assert(method);
}
each_method!(symmetric_methods_return_and_no_others_do);
