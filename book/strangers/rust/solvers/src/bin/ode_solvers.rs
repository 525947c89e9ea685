//! ode_solvers 0.6.2. A single time is the end of the last step; several are evaluated from its
//! continuous output model. It looks for no events.

use ode_solvers::continuous_output_model::ContinuousOutputModel;
use ode_solvers::dop_shared::OutputType;
use ode_solvers::{Dop853, Dopri5, System, Vector2};
use strangers_protocol::solver::{serve, Run, Solver};

struct Equations<'a>(&'a Run);

impl System<f64, Vector2<f64>> for Equations<'_> {
    fn system(&self, t: f64, y: &Vector2<f64>, rate: &mut Vector2<f64>) {
        *rate = self.0.rate(t, [y[0], y[1]]).into();
    }
}

macro_rules! solver {
    ($name:literal, $method:ident) => {
        Solver {
            name: $name,
            solve: |run| {
                let (start, end) = (run.from(), run.end());
                let y = Vector2::from(run.start);
                let mut stepper =
                    $method::new(Equations(run), start, end, end - start, y, run.tol, run.tol);
                if run.grid.len() == 2 {
                    stepper.set_output(OutputType::Sparse);
                    stepper.integrate().map_err(|why| why.to_string())?;
                    return Ok(vec![stepper.y_out().last().map_or(run.start, |y| [y[0], y[1]])]);
                }
                let mut model = ContinuousOutputModel::default();
                let told = stepper.integrate_with_continuous_output_model(&mut model);
                told.map_err(|why| why.to_string())?;
                let at = |t: &f64| model.evaluate(*t).map(|y| [y[0], y[1]]);
                run.grid[1..].iter().map(at).collect::<Option<_>>().ok_or("outside".into())
            },
            crossings: None,
        }
    };
}

fn main() {
    serve(vec![solver!("Dopri5", Dopri5), solver!("Dop853", Dop853)]);
}
