//! russell_ode 5.0.0 with equal steps (`h_equal`). It integrates forwards only. The implicit
//! methods get their Jacobian by differences, the crate's own default.
//! Claims, as quoted from that version:
//!   FwEuler: order=1 name=forward-euler. “Method::FwEuler => "Forward Euler method (explicit,
//!   order 1)",”
//!     (russell_ode src/enums.rs:157)
//!   BwEuler: order=1. “Method::BwEuler => "Backward Euler method (implicit, order 1)",”
//!   (russell_ode
//!     src/enums.rs:156)
//!   Rk2: order=2 name=explicit-midpoint. “Method::Rk2 => "Runge (Kutta) method (mid-point)
//!   (explicit, order
//!     2)",” (russell_ode src/enums.rs:158)
//!   Rk3: order=3. “Method::Rk3 => "Runge (Kutta) method (explicit, order 3)",” (russell_ode
//!     src/enums.rs:159)
//!   Heun3: order=3. “Method::Heun3 => "Heun method (explicit, order 3)",” (russell_ode
//!   src/enums.rs:160)
//!   Rk4: order=4 name=rk4. “Method::Rk4 => "(The) Runge-Kutta method (explicit, order 4)",”
//!   (russell_ode
//!     src/enums.rs:161)
//!   Rk4alt: order=4. “Method::Rk4alt => "Runge-Kutta method (alternative) (explicit, order 4,
//!   3/8-Rule)",”
//!     (russell_ode src/enums.rs:162)
//!   MdEuler: order=2. “Method::MdEuler => "Modified Euler method (explicit, order 2(1),
//!   embedded)",”
//!     (russell_ode src/enums.rs:163)
//!   Merson4: order=4. “Method::Merson4 => "Merson method (explicit, order 4('5'), embedded)",”
//!   (russell_ode
//!     src/enums.rs:164)
//!   Zonneveld4: order=4. “Method::Zonneveld4 => "Zonneveld method (explicit, order 4(3),
//!   embedded)",”
//!     (russell_ode src/enums.rs:165)
//!   Fehlberg4: order=4. “Method::Fehlberg4 => "Fehlberg method (explicit, order 4(5), embedded)",”
//!     (russell_ode src/enums.rs:166)
//!   DoPri5: order=5 name=dormand-prince. “Method::DoPri5 => "Dormand-Prince method (explicit,
//!   order 5(4),
//!     embedded)",” (russell_ode src/enums.rs:167)
//!   Verner6: order=6. “Method::Verner6 => "Verner method (explicit, order 6(5), embedded)",”
//!   (russell_ode
//!     src/enums.rs:168)
//!   Fehlberg7: order=7. “Method::Fehlberg7 => "Fehlberg method (explicit, order 7(8), embedded)",”
//!     (russell_ode src/enums.rs:169)
//!   DoPri8: order=8 name=dop853. “Method::DoPri8 => "Dormand-Prince method (explicit, order
//!   8(5,3),
//!     embedded)",” (russell_ode src/enums.rs:170)
//!   Radau5: order=5. “Method::Radau5 => "Radau method (Radau IIA) (implicit, order 5, embedded)",”
//!     (russell_ode src/enums.rs:155)

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
