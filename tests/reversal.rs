//! Reversal: forward, flip the velocity, forward again. Where it ends tells symmetric methods from the rest.

mod common;
mod properties;

use approx::assert_relative_eq;
use common::each_method;
use pendula::methods::rk4::Rk4;
use pendula::{AnyMethod, Hamiltonian, Pendulum, theory};
use properties::reversal::{START, check, there_and_back};
use rstest::rstest;
use rstest_reuse::apply;

/// Catches: symplectic Euler posing as Störmer–Verlet, half a kick lost or doubled on one side, damping of 1e-12 a step;
/// and an entry that claims a symmetry, or denies it.
#[apply(each_method)]
fn symmetric_methods_return_and_no_others_do<M: AnyMethod>(#[case] method: M) {
    check(&method).unwrap();
}

/// RK4 loses energy on the way there and as much on the way back. The law leaves out x⁴ = 1e-6 of the rate, and that the
/// energy is not lost in whole swings: one of 500 to 1000 there, and one back, which mirror each other but for the loss.
///
/// Catches: an RK4 whose loss of energy is reversible, as an error of order h⁴ would be.
#[rstest]
#[case(Pendulum::PAPER)]
#[case(properties::pendulum())]
fn rk4_returns_with_less_by_what_it_loses(#[case] pendulum: Pendulum) {
    let lost = pendulum.energy(START) - pendulum.energy(there_and_back(&Rk4, &pendulum));
    let law = -2000.0 * theory::rk4::secular_rate(&pendulum, 1.0, 0.01);
    assert_relative_eq!(lost, law, max_relative = 1e-3);
}
