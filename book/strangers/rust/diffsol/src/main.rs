//! diffsol 0.18.0 with nalgebra. Several times are asked for by `solve_dense`, which interpolates;
//! a single one by `solve`, which ends a step there. A crossing ends a run, so the next one begins
//! there.

use diffsol::{
    DiffsolError, MatrixCommon, NalgebraLU, NalgebraMat, OdeBuilder, OdeSolverMethod,
    OdeSolverStopReason,
};
use strangers_protocol::solver::{serve, Run, Solver};

type Matrix = NalgebraMat<f64>;
type Lu = NalgebraLU<f64>;

macro_rules! problem {
    ($run:expr, $t0:expr, $start:expr) => {
        OdeBuilder::<Matrix>::new()
            .t0($t0)
            .h0($run.first())
            .rtol($run.tol)
            .atol($run.each)
            .rhs_implicit(
                |y: &[f64], _: &[f64], t: f64, rate: &mut [f64]| {
                    rate.copy_from_slice(&$run.rate(t, [y[0], y[1]]));
                },
                |y: &[f64], _: &[f64], _: f64, v: &[f64], out: &mut [f64]| {
                    out[0] = v[1];
                    out[1] = -$run.pendulum.gl * y[0].cos() * v[0];
                },
            )
            .init(|_: &[f64], _: f64, y: &mut [f64]| y.copy_from_slice(&$start), 2)
    };
}

fn told(why: DiffsolError) -> String {
    why.to_string()
}

macro_rules! solver {
    ($name:literal, |$problem:ident| $method:expr) => {
        Solver {
            name: $name,
            solve: |run| {
                let $problem = problem!(run, run.from(), run.start).build().map_err(told)?;
                let mut solver = $method.map_err(told)?;
                if run.grid.len() == 2 {
                    let (y, ..) = solver.solve(run.end()).map_err(told)?;
                    let last = y.ncols() - 1;
                    return Ok(vec![[0, 1].map(|i| y.inner()[(i, last)])]);
                }
                let (y, _) = solver.solve_dense(&run.grid[1..]).map_err(told)?;
                Ok((0..y.ncols()).map(|k| [0, 1].map(|i| y.inner()[(i, k)])).collect())
            },
            crossings: Some(|run| {
                let $problem = problem!(run, run.from(), run.start)
                    .root(|y: &[f64], _: &[f64], _: f64, out: &mut [f64]| out[0] = y[0], 1)
                    .build()
                    .map_err(told)?;
                let mut solver = $method.map_err(told)?;
                let mut rows = Vec::new();
                loop {
                    let (.., reason) = solver.solve(run.end()).map_err(told)?;
                    let OdeSolverStopReason::RootFound(t, _) = reason else { return Ok(rows) };
                    let y = solver.state().y;
                    rows.push([t, y[0], y[1]]);
                }
            }),
        }
    };
}

fn main() {
    serve(vec![
        solver!("tsit45", |problem| problem.tsit45()),
        solver!("bdf", |problem| problem.bdf::<Lu>()),
        solver!("tr_bdf2", |problem| problem.tr_bdf2::<Lu>()),
        solver!("esdirk34", |problem| problem.esdirk34::<Lu>()),
    ]);
}
