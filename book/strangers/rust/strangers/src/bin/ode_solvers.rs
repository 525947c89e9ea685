//! ode_solvers 0.6.2. Dopri5 and Dop853 are held to fixed steps by tolerances that nothing exceeds
//! and by `h_max`.

use ode_solvers::dop_shared::OutputType;
use ode_solvers::{Dop853, Dopri5, Rk4, System, Vector2};
use strangers_protocol::{Integrator, Pendulum, serve};

struct Equations<'a>(&'a Pendulum);

impl System<f64, Vector2<f64>> for Equations<'_> {
    fn system(&self, t: f64, y: &Vector2<f64>, rate: &mut Vector2<f64>) {
        rate[0] = y[1];
        rate[1] = self.0.force(y[0], t);
    }
}

fn after_the_start(states: &[Vector2<f64>]) -> Vec<[f64; 2]> {
    states.iter().skip(1).map(|y| [y[0], y[1]]).collect()
}

macro_rules! held {
    ($name:literal, $method:ident) => {
        Integrator::new($name, true, |pendulum, asked| {
            let (h, end) = (asked.h, asked.n as f64 * asked.h);
            let start = Vector2::new(asked.theta, asked.omega);
            let never = u32::MAX;
            let mut stepper = $method::from_param(
                Equations(pendulum),
                0.0,
                end,
                h,
                start,
                1e100,
                1e100,
                0.9,
                0.0,
                0.2,
                10.0,
                h.abs(),
                h,
                never,
                never,
                OutputType::Sparse,
            );
            stepper.integrate().map_err(|why| why.to_string())?;
            Ok(after_the_start(stepper.y_out()))
        })
    };
}

fn main() {
    serve(vec![
        Integrator::new("Rk4", true, |pendulum, asked| {
            let start = Vector2::new(asked.theta, asked.omega);
            let end = (asked.n as f64 - 0.5) * asked.h; // rounded up to n steps
            let mut stepper = Rk4::new(Equations(pendulum), 0.0, start, end, asked.h);
            stepper.integrate().map_err(|why| why.to_string())?;
            Ok(after_the_start(stepper.y_out()))
        }),
        held!("Dopri5", Dopri5),
        held!("Dop853", Dop853),
    ]);
}
