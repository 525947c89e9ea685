//! bacon-sci 0.16.2. A run goes from each time asked for to the next, as it has no states but
//! those at its steps. It goes forward alone, and looks for no events. Steps may be as long as the
//! run, and as short as 10⁻¹² of it.

use bacon_sci::ivp::adams::{Adams3, Adams5};
use bacon_sci::ivp::bdf::{BDF2, BDF6};
use bacon_sci::ivp::rk::{RungeKutta23, RungeKutta45};
use bacon_sci::ivp::{IVPSolver, UserError};
use bacon_sci::BSVector;
use strangers_protocol::solver::{serve, Run, Solver};

macro_rules! solver {
    ($name:ident) => {
        Solver {
            name: stringify!($name),
            solve: |run| {
                let longest = (run.end() - run.from()).abs();
                let rate = |t: f64, y: &[f64], run: &mut &Run| -> Result<_, UserError> {
                    Ok(BSVector::<f64, 2>::from(run.rate(t, [y[0], y[1]])))
                };
                let mut y = run.start;
                let mut rows = Vec::new();
                for two in run.grid.windows(2) {
                    let solver = || {
                        $name::new()?
                            .with_maximum_dt(longest)?
                            .with_minimum_dt(1e-12 * longest)?
                            .with_initial_time(two[0])?
                            .with_ending_time(two[1])?
                            .with_tolerance(run.tol)?
                            .with_initial_conditions_slice(&y)?
                            .with_derivative(rate)
                            .solve(run)
                    };
                    let path = solver().and_then(|path| path.collect_vec());
                    let path = path.map_err(|why| format!("{why:?}"))?;
                    let (t, end) = path.last().ok_or("no step")?;
                    if *t != two[1] {
                        return Err(format!("it ends at {t} instead of {}", two[1]));
                    }
                    y = [end[0], end[1]];
                    rows.push(y);
                }
                Ok(rows)
            },
            crossings: None,
        }
    };
}

fn main() {
    serve(vec![
        solver!(RungeKutta45),
        solver!(RungeKutta23),
        solver!(Adams5),
        solver!(Adams3),
        solver!(BDF6),
        solver!(BDF2),
    ]);
}
