//! What every method is asked, but its order: each property of the judge's `properties/`; and laws
//! of single methods that hold the measurement of a property to theory.

use pendula::methods::{ForwardEuler, Rk4};
use pendula::{AnyMethod, Grid, LinearOscillator, Method, Pendulum, Phase, integrate};
use pendula_judge::properties::area::{AREA_TOLERANCE, area_defect, cases};
use pendula_judge::properties::error_constant::{leading_local_error, measured_local_error};
use pendula_judge::properties::linear::{
    check_denials, check_matrix, determinant, known, matrix_of, trace,
};
use pendula_judge::properties::symmetry::{
    check_mass_and_length, check_mirror, check_time, check_turns,
};
use pendula_judge::properties::{AREA, ERROR_CONSTANT, LINEAR, REVERSAL, WORK, energy};
use rstest::rstest;

use crate::common::method;

// -------------------------------------------------------------------------------------------------
// Error constant: not only the slope of the error, but its size
// -------------------------------------------------------------------------------------------------

/// The error at the time 4/ω₀ over (ω₀h)ᵖ, extrapolated to h = 0 from 100, 200 and 400 steps, is
/// what theory's transport of the local error leads to, to 2e-4: the extrapolation leaves out x³/8
/// with a coefficient of 11, 8e-5. `properties/error_constant.rs` has the local errors,
/// and the tolerances where they are measured or the constant comes from a file of 50 digits.
///
/// Catches: a method of the right order whose leading error has a wrong coefficient, such as
/// position Verlet for velocity Verlet or drift–kick for kick–drift; a step that is not the
/// declared one; an end that is one step early or late.
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
    for pendulum in [Pendulum::PAPER, pendula_judge::properties::pendulum()] {
        let series = leading_local_error(method.info().name, z).expect("it is on file");
        let measured = measured_local_error(method, &pendulum, z);
        let difference = (measured[0] - series[0]).hypot(measured[1] - series[1]);
        let size = series[0].hypot(series[1]);
        assert!(difference < TOLERANCE * size, "{measured:?}, not {series:?}");
    }
}

// -------------------------------------------------------------------------------------------------
// Area: the determinant of the Jacobian of one step
// -------------------------------------------------------------------------------------------------

/// As the judge measures it: det J by differences of fourth order, at five states in steps of x =
/// 0.1, 0.4 and 1, is 1 to ten times the ruler's own error if the method is symplectic, and if not
/// off by a hundred times that. `book/judge/src/properties/area.rs` derives how right the ruler has
/// to be.
///
/// Catches: forward Euler posing as symplectic Euler, and every other step that is said to preserve
/// area and does not.
fn symplectic_methods_preserve_area(method: &dyn AnyMethod) {
    AREA.assert(method);
}
each_method!(symplectic_methods_preserve_area);

/// det J = 1 + h² (g/L) cos θ, exactly: the Jacobian is (1, h; −h (g/L) cos θ, 1).
///
/// Catches: a forward Euler that uses the new angle or velocity anywhere.
#[test]
fn forward_euler_grows_area_by_its_exact_defect() {
    for (pendulum, z) in cases() {
        for h in [0.1, 0.01] {
            let defect = area_defect(&ForwardEuler, &pendulum, z, h);
            let exact = h * h * pendulum.frequency_squared() * z.theta.cos();
            assert!((defect - exact).abs() < AREA_TOLERANCE, "{defect:e} for {exact:e} at {z:?}");
        }
    }
}

/// At the bottom det J = |R(ix)|² = 1 − x⁶/72 + x⁸/576 with x = ω₀h, from RK4's stability
/// polynomial R.
///
/// Catches: any change of RK4 that shows on the linear oscillator.
#[test]
fn rk4_shrinks_area_at_the_bottom_as_its_polynomial_says() {
    for (pendulum, _) in cases() {
        for h in [0.3, 0.2, 0.1] {
            let x2 = pendulum.frequency_squared() * h * h;
            let exact = -x2.powi(3) / 72.0 + x2.powi(4) / 576.0;
            let defect = area_defect(&Rk4, &pendulum, Phase::at_rest(0.0), h);
            assert!((defect - exact).abs() < AREA_TOLERANCE, "{defect:e} for {exact:e} at h = {h}");
        }
    }
}

// -------------------------------------------------------------------------------------------------
// Reversal: forward, flip the velocity, forward again
// -------------------------------------------------------------------------------------------------

/// As the judge measures it: a thousand short steps out and back, or fewer long ones, miss the
/// start by rounding if the method is symmetric, and if not by ten times that. Of a symmetric also
/// 100 000 steps of x = 0.03 and as many back miss it by at most 1e-10 rad, what a random walk of
/// roundings makes of energy and phase: `book/judge/src/properties/reversal.rs` derives it.
///
/// Catches: symplectic Euler posing as Störmer–Verlet; half a kick lost or doubled on one side;
/// damping of 1e-12 per step; an entry that wrongly claims or denies symmetry.
fn symmetric_methods_return_and_no_others_do(method: &dyn AnyMethod) {
    REVERSAL.assert(method);
}
each_method!(symmetric_methods_return_and_no_others_do);

// -------------------------------------------------------------------------------------------------
// Energy: conserved in steps of any length, or not
// -------------------------------------------------------------------------------------------------

/// From three starts, in 2000 steps of x = 0.05, 0.3 and 1, the energy changes by what a random
/// walk of roundings makes of it if the entry says that it is conserved, and otherwise by more than
/// ten times that in some of them.
///
/// Catches: a discrete gradient with a wrong mean of the force; an entry that wrongly claims or
/// denies it.
fn the_energy_is_conserved_or_not_as_the_entry_says(method: &dyn AnyMethod) {
    energy::check(method).unwrap();
}
each_method!(the_energy_is_conserved_or_not_as_the_entry_says);

// -------------------------------------------------------------------------------------------------
// The symmetries of the pendulum
// -------------------------------------------------------------------------------------------------

/// Catches: a preferred direction, such as a constant torque of 1e-12, and a sine that is not odd
/// to the last bit.
fn the_mirror_image_has_the_same_bits(method: &dyn AnyMethod) {
    check_mirror(method).unwrap();
}
each_method!(the_mirror_image_has_the_same_bits);

/// Catches: g·L in place of g/L; a forgotten L; a mass in the motion.
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

// -------------------------------------------------------------------------------------------------
// One step on the linear oscillator: a matrix, which is known for each method
// -------------------------------------------------------------------------------------------------

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
    let pendulum = pendula_judge::properties::pendulum();
    let (system, frequency) = (LinearOscillator::new(pendulum), pendulum.small_angle_frequency());
    let matrix = |x: f64| {
        let grid = Grid::new(x / frequency, 1).unwrap();
        matrix_of(frequency, |z| integrate(&system, method, z, &grid))
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

// -------------------------------------------------------------------------------------------------
// Work
// -------------------------------------------------------------------------------------------------

/// A system that counts is given to the method: as many evaluations before the first step, and in
/// 1234 steps, as the entry says, to the last. An implicit method takes whole sweeps, 4 to 12 a
/// step: `book/judge/src/properties/work.rs` derives how many bring it to rounding.
///
/// Catches: a Störmer–Verlet that evaluates the force twice a step, as the paper says it must; any
/// method that makes more evaluations than its entry promises.
fn evaluations_are_those_of_the_entry(method: &dyn AnyMethod) {
    WORK.assert(method);
}
each_method!(evaluations_are_those_of_the_entry);

/// Catches: unneeded evaluations before the first step, and a loop that takes a step on an empty
/// grid.
fn no_step_costs_no_more_than_the_start(method: &dyn AnyMethod) {
    let (start, none) = (Phase { theta: 1.0, omega: 2.0 }, Grid::new(0.01, 0).unwrap());
    assert_eq!(method.end(&Pendulum::PAPER, start, &none), start);
    let evaluations = method.count_evaluations(&Pendulum::PAPER, start, &none);
    assert_eq!(evaluations, method.info().start_evaluations);
}
each_method!(no_step_costs_no_more_than_the_start);
