//! russell_ode 5.0.0. A step ends at the last time; those before are its dense output, where the
//! method has one, and otherwise each is the end of a run. It goes forward alone, and looks for no
//! events. The implicit method gets its Jacobian by differences, the crate's own default.

use russell_lab::Vector;
use russell_ode::prelude::{Method, OdeSolver, Output, Params, System};
use strangers_protocol::solver::{serve, Run, Solver, States};
use strangers_protocol::Pendulum;

struct Count {
    gl: f64,
    a: f64,
    w: f64,
    forces: usize,
}

fn states(run: &Run, method: Method, dense: bool) -> States {
    let why = |error: &str| error.to_string();
    let system = System::new(2, |rate: &mut Vector, t: f64, y: &Vector, count: &mut Count| {
        count.forces += 1;
        rate[0] = y[1];
        rate[1] = count.a * (count.w * t).cos() - count.gl * y[0].sin();
        Ok(())
    });
    let mut params = Params::new(method);
    if method.information().implicit {
        params.newton.use_numerical_jacobian = true;
    }
    params.step.n_step_max = 1_000_000;
    params.set_tolerances(run.tol, run.tol, None).map_err(why)?;
    let mut solver = OdeSolver::new(params, system).map_err(why)?;
    let Pendulum { gl, a, w, .. } = run.pendulum;
    let mut count = Count { gl, a, w, forces: 0 };
    let mut y = Vector::from(&run.start);
    let mut rows = Vec::new();
    let times = &run.grid[1..];
    if times.len() > 1 && dense {
        let mut out = Output::new();
        out.set_dense_x_out(&times[..times.len() - 1]).map_err(why)?;
        out.set_dense_recording(&[0, 1]);
        let told = solver.solve(&mut y, run.from(), run.end(), None, &mut count, Some(&mut out));
        told.map_err(why)?;
        let path = out.dense_y(0).iter().zip(out.dense_y(1)).map(|(theta, omega)| [*theta, *omega]);
        rows.extend(path.skip(1));
    } else {
        for two in run.grid.windows(2) {
            solver.solve(&mut y, two[0], two[1], None, &mut count, None).map_err(why)?;
            rows.push([y[0], y[1]]);
        }
    }
    run.pendulum.forces.set(count.forces);
    Ok(rows)
}

macro_rules! solvers {
    ($($name:ident $dense:literal)*) => {
        vec![$(Solver {
            name: stringify!($name),
            solve: |run| states(run, Method::$name, $dense),
            crossings: None,
        }),*]
    };
}

fn main() {
    serve(solvers![
        Merson4 false Zonneveld4 false Fehlberg4 false DoPri5 true Verner6 false Fehlberg7 false
        DoPri8 true Radau5 true
    ]);
}
