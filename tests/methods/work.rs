//! Work: force evaluations are counted, and are what each method's entry says.

use pendula::{AnyMethod, Counting, Grid, Info, Method, Pendulum, Phase, integrate};
use rstest_reuse::apply;

use crate::common::each_method;

/// Catches: a Störmer–Verlet that evaluates the force twice a step, as the paper says it must; any
/// method whose entry promises fewer evaluations than its step makes.
#[apply(each_method)]
fn evaluations_are_those_of_the_entry<M: AnyMethod>(#[case] method: M) {
    pendula::verify::work::check(&method).unwrap();
}

/// Catches: unneeded evaluations before the first step, and a loop that takes a step on an empty
/// grid.
#[apply(each_method)]
fn no_step_costs_no_more_than_the_start<M>(#[case] method: M)
where
    M: Info + Method<Counting<Pendulum>>,
{
    let system = Counting::new(Pendulum::PAPER);
    let start = Phase { theta: 1.0, omega: 2.0 };
    let end = integrate(&system, &method, start, &Grid::new(0.01, 0).unwrap(), &mut ());
    assert_eq!(end, start);
    assert_eq!(system.evaluations(), method.info().start_evaluations);
}
