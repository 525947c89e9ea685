//! russell_ode 5.0.0 with equal steps (`h_equal`). It integrates forwards only. The implicit
//! methods get their Jacobian by differences, the crate's own default.

use russell_lab::Vector;
use russell_ode::prelude::{Method, OdeSolver, Output, Params, System};
use strangers_protocol::{Integrator, Path, Pendulum, Request, serve};

struct Count {
    gl: f64,
    a: f64,
    w: f64,
    forces: usize,
}

fn steps(method: Method, pendulum: &Pendulum, asked: &Request) -> Path {
    let why = |error: &str| error.to_string();
    let Pendulum { gl, a, w, .. } = *pendulum;
    let system = System::new(2, |rate: &mut Vector, t: f64, y: &Vector, count: &mut Count| {
        count.forces += 1;
        rate[0] = y[1];
        rate[1] = count.a * (count.w * t).cos() - count.gl * y[0].sin();
        Ok(())
    });
    let mut params = Params::new(method);
    if method.information().implicit {
        params.newton.use_numerical_jacobian = true;
        params.set_tolerances(1e-12, 1e-12, None).map_err(why)?;
    }
    let mut solver = OdeSolver::new(params, system).map_err(why)?;
    let mut out = Output::new();
    out.set_step_recording(&[0, 1]);
    let mut count = Count { gl, a, w, forces: 0 };
    let mut y = Vector::from(&[asked.theta, asked.omega]);
    let end = asked.n as f64 * asked.h;
    // A hair more than h: the crate rounds the number of steps up.
    let h = Some(asked.h * (1.0 + 1e-9));
    solver.solve(&mut y, 0.0, end, h, &mut count, Some(&mut out)).map_err(why)?;
    pendulum.forces.set(count.forces);
    let path = out.step_y(0).iter().zip(out.step_y(1));
    Ok(path.skip(1).take(asked.n).map(|(theta, omega)| [*theta, *omega]).collect())
}

macro_rules! integrators {
    ($($name:ident)*) => {
        vec![$(Integrator::new(stringify!($name), true, |pendulum, asked| {
            steps(Method::$name, pendulum, asked)
        })),*]
    };
}

fn main() {
    serve(integrators![
        FwEuler BwEuler Rk2 Rk3 Heun3 Rk4 Rk4alt MdEuler Merson4 Zonneveld4 Fehlberg4 DoPri5 Verner6
        Fehlberg7 DoPri8 Radau5
    ]);
}
