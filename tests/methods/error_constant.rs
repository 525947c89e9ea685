//! The error constant: not only the slope of the error, but its size.

use pendula::verify::properties::ERROR_CONSTANT;
use pendula::verify::properties::error_constant::{leading_local_error, measured_local_error};
use pendula::{AnyMethod, Pendulum};
use rstest::rstest;

use crate::common::method;

/// The error at the time 4/ω₀ over (ω₀h)ᵖ, extrapolated to h = 0 from 100, 200 and 400 steps, is
/// what theory's transport of the local error leads to, to 2e-4: the extrapolation leaves out x³/8
/// with a coefficient of 11, 8e-5. `src/verify/properties/error_constant.rs` has the local errors,
/// and the tolerances where they are measured or the constant comes from a file of 50 digits.
///
/// Catches: a method of the right order with a wrong coefficient in its leading error, such as
/// position Verlet for velocity Verlet or drift–kick for kick–drift; a step that is not the one
/// declared; an end one step early or late.
fn the_error_is_the_constant_of_theory(method: &dyn AnyMethod) {
    ERROR_CONSTANT.assert(method);
}
each_method!(the_error_is_the_constant_of_theory);

/// Extrapolation from x = 0.2 leaves out x³/8 = 1e-3 of d, with a coefficient of a few; of eight
/// for Cieśliński's and Ratkiewicz's method, whose d of small swings is almost nothing.
const TOLERANCE: f64 = 1e-2;

/// The tabulated series against single steps. At x = 0.05 RK4's error is at least 3e-9,
/// rounded by 2e-16.
///
/// Catches: a series that is wrong in the same way as the run it is compared with.
#[rstest]
#[case::forward_euler(method("forward_euler"))]
#[case::symplectic_euler(method("symplectic_euler"))]
#[case::rk4(method("rk4"))]
#[case::stormer_verlet(method("stormer_verlet"))]
#[case::trapezoidal(method("trapezoidal"))]
#[case::discrete_gradient(method("discrete_gradient"))]
#[case::cieslinski_ratkiewicz(method("cieslinski_ratkiewicz"))]
#[case::deuflhard(method("deuflhard"))]
fn a_single_step_misses_by_its_taylor_series(
    #[case] method: &dyn AnyMethod,
    #[values([1.0, 0.0], [-2.0, 0.5], [0.5, 2.5], [3.0, -0.3], [0.1, 0.1])] z: [f64; 2],
) {
    for pendulum in [Pendulum::PAPER, pendula::verify::properties::pendulum()] {
        let series = leading_local_error(method.info().name, z).expect("it is on file");
        let measured = measured_local_error(method, &pendulum, z);
        let difference = (measured[0] - series[0]).hypot(measured[1] - series[1]);
        let size = series[0].hypot(series[1]);
        assert!(difference < TOLERANCE * size, "{measured:?}, not {series:?}");
    }
}
