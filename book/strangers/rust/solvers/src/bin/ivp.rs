//! ivp 0.6.0, `Ivp::first_order`. A step ends at the last time; those before are interpolated
//! (`t_eval`).

use ivp::prelude::*;
use strangers_protocol::solver::{serve, Run, Solver};

struct Equations<'a> {
    run: &'a Run,
    events: usize,
}

impl FirstOrderSystem for Equations<'_> {
    fn derivative(&self, t: f64, y: &[f64], rate: &mut [f64]) {
        rate.copy_from_slice(&self.run.rate(t, [y[0], y[1]]));
    }

    fn n_events(&self) -> usize {
        self.events
    }

    fn events(&self, _: f64, y: &[f64], out: &mut [f64]) {
        out[0] = y[0];
    }
}

fn solution(run: &Run, method: Method, events: usize) -> Result<Solution, String> {
    let equations = Equations { run, events };
    let found = Ivp::first_order(&equations, run.from(), run.end(), &run.start)
        .method(method)
        .rtol(run.tol)
        .atol(run.each.to_vec())
        .max_steps(1_000_000)
        .t_eval(run.grid[1..].to_vec())
        .solve();
    let found = found.map_err(|why| format!("{why:?}"))?;
    match found.status {
        Status::Success => Ok(found),
        other => Err(format!("{other:?}")),
    }
}

macro_rules! solver {
    ($name:ident) => {
        Solver {
            name: stringify!($name),
            solve: |run| {
                let found = solution(run, Method::$name, 0)?;
                Ok(found.y.iter().map(|y| [y[0], y[1]]).collect())
            },
            crossings: Some(|run| {
                let found = solution(run, Method::$name, 1)?;
                let rows = found.t_events[0].iter().zip(&found.y_events[0]);
                Ok(rows.map(|(t, y)| [*t, y[0], y[1]]).collect())
            }),
        }
    };
}

fn main() {
    serve(vec![
        solver!(RK23),
        solver!(DOPRI5),
        solver!(DOP853),
        solver!(RADAU),
        solver!(BDF),
        solver!(LSODA),
    ]);
}
