//! One step on the linear oscillator is a matrix, which is known for each method.

use pendula::verify::properties::LINEAR;
use pendula::verify::properties::linear::{
    check_denials, check_matrix, determinant, known, matrix_of, trace,
};
use pendula::{AnyMethod, Grid, LinearOscillator, Method, integrate};
use rstest::rstest;

/// Catches: every wrong coefficient that acts on a linear force, to the last digit: trace,
/// determinant and each element; a carried force that is not that of the step before; symmetry or
/// area preservation that is wrongly claimed.
fn the_pendulum_at_the_bottom_has_the_known_matrix(method: &dyn AnyMethod) {
    LINEAR.assert(method);
}
each_method!(the_pendulum_at_the_bottom_has_the_known_matrix);

/// Catches: a linear oscillator that is not the linearisation of its pendulum; a method written for
/// one system only.
fn the_linear_oscillator_has_the_same_matrix<M: AnyMethod + Method<LinearOscillator>>(method: &M) {
    let pendulum = pendula::verify::properties::pendulum();
    let (system, frequency) = (LinearOscillator::new(pendulum), pendulum.small_angle_frequency());
    let matrix = |x: f64| {
        let grid = Grid::new(x / frequency, 1).unwrap();
        matrix_of(frequency, |z| integrate(&system, method, z, &grid, &mut ()))
    };
    for x in [0.3, 0.5, 1.1] {
        check_matrix(method, x, matrix(x)).unwrap();
    }
    check_denials(method, matrix).unwrap();
}
each_method_type!(the_linear_oscillator_has_the_same_matrix);

/// At x = 1 the determinants 1 + x², 1, 1 − x⁶/72 + x⁸/576 and 1, and the traces 2, 2 − x², 2 −
/// x² + x⁴/12 and 2 − x²; of Cayley's transform 1 and (2 − x²/2)/(1 + x²/4), of the rotation 1 and
/// 2 cos x. A few roundings of numbers up to 2.
///
/// Catches: a tabulated matrix that is wrong in the same way as its method.
#[rstest]
#[case::forward_euler("forward-euler", 2.0, 2.0)]
#[case::symplectic_euler("symplectic-euler", 1.0, 1.0)]
#[case::rk4("rk4", 1.0 - 1.0 / 72.0 + 1.0 / 576.0, 1.0 + 1.0 / 12.0)]
#[case::stormer_verlet("stormer-verlet", 1.0, 1.0)]
#[case::implicit_midpoint("implicit-midpoint", 1.0, 1.2)]
#[case::trapezoidal("trapezoidal", 1.0, 1.2)]
#[case::discrete_gradient("discrete-gradient", 1.0, 1.2)]
#[case::deuflhard("deuflhard", 1.0, 1.080_604_611_736_279_4)]
#[case::cieslinski_ratkiewicz("cieslinski-ratkiewicz", 1.0, 1.080_604_611_736_279_4)]
fn the_matrices_on_file_have_their_invariants(
    #[case] name: &str,
    #[case] determinant_at_one: f64,
    #[case] trace_at_one: f64,
) {
    let matrix = known(name, 1.0).expect("it is on file");
    assert!((determinant(matrix) - determinant_at_one).abs() < 1e-15);
    assert!((trace(matrix) - trace_at_one).abs() < 1e-15);
}
