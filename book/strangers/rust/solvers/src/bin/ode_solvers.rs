//! ode_solvers 0.6.2. A single time is the end of the last step. Several are evaluated from the
//! continuous output model of Dopri5; Dop853 has none, only equal distances, so that each of them
//! is the end of a run. It looks for no events.

use ode_solvers::continuous_output_model::ContinuousOutputModel;
use ode_solvers::dop_shared::OutputType;
use ode_solvers::{Dop853, Dopri5, System, Vector2};
use strangers_protocol::solver::{serve, Run, Solver, States};

struct Equations<'a>(&'a Run);

impl System<f64, Vector2<f64>> for Equations<'_> {
    fn system(&self, t: f64, y: &Vector2<f64>, rate: &mut Vector2<f64>) {
        *rate = self.0.rate(t, [y[0], y[1]]).into();
    }
}

macro_rules! ends {
    ($method:ident, $run:ident) => {{
        let mut y = Vector2::from($run.start);
        let mut rows = Vec::new();
        for two in $run.grid.windows(2) {
            let (equations, dx) = (Equations($run), two[1] - two[0]);
            let mut stepper = $method::new(equations, two[0], two[1], dx, y, $run.tol, $run.tol);
            stepper.set_output(OutputType::Sparse);
            stepper.integrate().map_err(|why| why.to_string())?;
            y = *stepper.y_out().last().ok_or("no step")?;
            rows.push([y[0], y[1]]);
        }
        Ok(rows)
    }};
}

fn dopri5(run: &Run) -> States {
    if run.grid.len() == 2 {
        return ends!(Dopri5, run);
    }
    let (start, end) = (run.from(), run.end());
    let y = Vector2::from(run.start);
    let mut stepper = Dopri5::new(Equations(run), start, end, end - start, y, run.tol, run.tol);
    let mut model = ContinuousOutputModel::default();
    let told = stepper.integrate_with_continuous_output_model(&mut model);
    told.map_err(|why| why.to_string())?;
    let at = |t: &f64| model.evaluate(*t).map(|y| [y[0], y[1]]);
    run.grid[1..].iter().map(at).collect::<Option<_>>().ok_or("outside the model".into())
}

fn dop853(run: &Run) -> States {
    ends!(Dop853, run)
}

fn main() {
    serve(vec![
        Solver { name: "Dopri5", solve: dopri5, crossings: None },
        Solver { name: "Dop853", solve: dop853, crossings: None },
    ]);
}
