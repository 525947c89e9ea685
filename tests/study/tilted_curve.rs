//! The level curves of symplectic Euler's modified energy, beside the points of the method.

use pendula::{Pendulum, Phase};
use pendula_study::experiments::level_curves::{ORDERS, THETA_0, TILTED_STEP, tilted};
use pendula_study::theory::Dimensionless;
use pendula_study::theory::symplectic_euler::correction_to_order;

/// H̃ to this order, in units of m g L.
fn modified_energy(order: usize, z: Phase) -> f64 {
    let x = Pendulum::PAPER.small_angle_frequency() * TILTED_STEP;
    let z = Dimensionless::from_phase(&Pendulum::PAPER, z);
    z.energy() + correction_to_order(order, z, x)
}

/// How much H̃ to this order changes along these states.
fn change(order: usize, states: &[Phase]) -> f64 {
    let values = states.iter().map(|z| modified_energy(order, *z));
    let (low, high) = values.fold((f64::MAX, f64::MIN), |(l, h), e| (l.min(e), h.max(e)));
    high - low
}

/// A curve is found by Newton's iteration, to rounding: 1e-12 is ten thousand roundings of a H̃ of
/// about 1/2. Along the method's points H changes as x, H̃ with one term as x², and with seven as
/// x⁸, where x is 0.78 and the coefficients fall too: a factor of 4 for each is little.
///
/// Catches: a curve of another order than it says, or of another step; one through another start;
/// terms that do not come nearer to the method's points.
#[test]
fn each_curve_is_level_and_through_the_start() {
    let run = tilted();
    assert_eq!(run.curves.len(), ORDERS.len());
    let start = Phase::at_rest(THETA_0);
    for (order, curve) in ORDERS.into_iter().zip(&run.curves) {
        assert!(change(order, curve) < 1e-12, "{order}: {:e}", change(order, curve));
        let off = modified_energy(order, curve[0]) - modified_energy(order, start);
        assert!(off.abs() < 1e-12, "{order}: {off:e}");
    }
    let [none, one, seven] = ORDERS.map(|order| change(order, &run.points));
    assert!(one < none / 4.0 && seven < one / 4.0, "{none:e} {one:e} {seven:e}");
}
