//! Work: force evaluations are counted, and are what each method's entry says.

use pendula::verify::properties::WORK;
use pendula::{AnyMethod, Grid, Pendulum, Phase};

/// A system that counts is given to the method: as many evaluations before the first step, and in
/// 1234 steps, as the entry says, to the last. An implicit method takes whole sweeps, 4 to 12 a
/// step: `src/verify/properties/work.rs` derives how many bring it to rounding.
///
/// Catches: a Störmer–Verlet that evaluates the force twice a step, as the paper says it must; any
/// method whose entry promises fewer evaluations than its step makes.
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
