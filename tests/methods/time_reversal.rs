//! Reversal: forward, flip the velocity, forward again. The end state tells symmetric methods from
//! the others.

use pendula::AnyMethod;
use pendula::verify::reversal::check;
use rstest_reuse::apply;

use crate::common::each_method;

/// Catches: symplectic Euler posing as Störmer–Verlet, half a kick lost or doubled on one side,
/// damping of 1e-12 a step; and an entry that wrongly claims or denies symmetry.
#[apply(each_method)]
fn symmetric_methods_return_and_no_others_do<M: AnyMethod>(#[case] method: M) {
    check(&method).unwrap();
}
