//! Order of convergence: the slope of the error against the step, between neighbouring rungs of a
//! ladder.

use pendula::exact::Motion;
use pendula::{
    AnyMethod, Error, ForwardEuler, Grid, Pendulum, Phase, Rk4, StormerVerlet, SymplecticEuler,
};
use pendula_judge::properties::ORDER;
use rstest::rstest;

// ANCHOR: halving
/// Halving the step divides the error by 2ᵖ, where p is the order next to each method.
///
/// The next term of the error is at most x = ω₀²hT/2 of the first, for forward Euler, whose error
/// grows like eˣ, and less for the others; it bends the slope by at most x / (2 ln 2). Rounding,
/// at most 2048 · 4e-16 of the finest error of 6e-11 (RK4), by 0.02 more.
///
/// Catches: a coefficient so far off that it lowers the order.
#[rstest]
#[case::forward_euler(&ForwardEuler, 1.0)]
#[case::symplectic_euler(&SymplecticEuler, 1.0)]
#[case::stormer_verlet(&StormerVerlet, 2.0)]
#[case::rk4(&Rk4, 4.0)]
fn halving_the_step_shows_the_order(
    #[case] method: &dyn AnyMethod,
    #[case] order: f64,
) -> Result<(), Error> {
    // With a length or a mass of 1 a wrong factor would hide; at a whole period, an error of phase.
    let (pendulum, start, duration) = (Pendulum::new(9.81, 0.8, 1.7)?, Phase::at_rest(1.0), 2.7);
    let exact = Motion::new(&pendulum, start)?.at(duration);
    let error = |steps: u64| -> Result<f64, Error> {
        let grid = Grid::new(duration / steps as f64, steps)?;
        let end = method.run(&pendulum, start, &grid, &mut ());
        Ok((end.theta - exact.theta).hypot(end.omega - exact.omega))
    };
    for steps in [512, 1024] {
        let slope = (error(steps)? / error(2 * steps)?).log2();
        let x = 9.81 / 0.8 * (duration / steps as f64) * duration / 2.0;
        let window = 0.72 * x + 0.02;
        assert!((slope - order).abs() <= window, "{slope}, not {order} ± {window}");
    }
    Ok(())
}
// ANCHOR_END: halving

/// On the ladder of `properties/order.rs` each slope between two steps whose errors are
/// above rounding is the order, within 0.05: the next term of the error is at most 1/30 of the
/// first. That file derives it, and the wider windows of methods beyond order 4 whose next term is
/// only one power of h smaller, and beyond order 8, where steps are long.
///
/// Catches: any coefficient so far off that it lowers the order; an entry whose order is too high
/// or too low; time that drifts from the count of steps. (Not forward Euler posing as symplectic
/// Euler: both have order 1.)
fn every_slope_is_the_order(method: &dyn AnyMethod) {
    ORDER.assert(method);
}
each_method!(every_slope_is_the_order);
