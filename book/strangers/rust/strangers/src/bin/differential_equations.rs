//! differential-equations 0.7.0. The methods with step control are held to fixed steps by
//! tolerances that nothing exceeds and by `h_max`.

use differential_equations::error::Error;
use differential_equations::methods::{
    DiagonallyImplicitRungeKutta, ExplicitRungeKutta, ImplicitRungeKutta, SymplecticIntegrator,
};
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};
use strangers_protocol::{Integrator, Path, Pendulum, Request, serve};

struct Equations<'a>(&'a Pendulum);

impl ODE<f64, [f64; 2]> for Equations<'_> {
    fn diff(&self, t: f64, y: &[f64; 2], rate: &mut [f64; 2]) {
        *rate = [y[1], self.0.force(y[0], t)];
    }
}

/// Step by step: `solve` would cut the last step.
fn steps(
    mut method: impl OrdinaryNumericalMethod<f64, [f64; 2]>,
    pendulum: &Pendulum,
    asked: &Request,
) -> Path {
    let why = |error: Error<f64, [f64; 2]>| format!("{error:?}");
    let equations = Equations(pendulum);
    let end = asked.n as f64 * asked.h;
    method.init(&equations, 0.0, end, &[asked.theta, asked.omega]).map_err(why)?;
    let mut path = Vec::with_capacity(asked.n);
    for i in 0..asked.n {
        method.step(&equations).map_err(why)?;
        let due = (i + 1) as f64 * asked.h;
        if (method.t() - due).abs() > 1e-6 * asked.h.abs() * (i + 1) as f64 {
            return Err(format!("at {} instead of {due}", method.t()));
        }
        path.push(*method.y());
    }
    Ok(path)
}

/// More steps than anybody asks for.
const MOST: usize = 1 << 30;

macro_rules! fixed {
    ($family:ident :: $name:ident) => {
        Integrator::new(stringify!($name), true, |pendulum, asked| {
            steps($family::$name(asked.h).max_steps(MOST), pendulum, asked)
        })
    };
}

macro_rules! held {
    ($family:ident :: $name:ident) => {
        Integrator::new(stringify!($name), true, |pendulum, asked| {
            let method = $family::$name().rtol(1e100).atol(1e100).h0(asked.h).h_max(asked.h.abs());
            steps(method.max_steps(MOST), pendulum, asked)
        })
    };
}

fn main() {
    serve(vec![
        fixed!(ExplicitRungeKutta::euler),
        fixed!(ExplicitRungeKutta::midpoint),
        fixed!(ExplicitRungeKutta::heun),
        fixed!(ExplicitRungeKutta::ralston),
        fixed!(ExplicitRungeKutta::ssp_rk3),
        fixed!(ExplicitRungeKutta::rk4),
        fixed!(ExplicitRungeKutta::three_eighths),
        fixed!(ImplicitRungeKutta::backward_euler),
        fixed!(ImplicitRungeKutta::crank_nicolson),
        fixed!(ImplicitRungeKutta::trapezoidal),
        fixed!(DiagonallyImplicitRungeKutta::esdirk33),
        fixed!(SymplecticIntegrator::velocity_verlet),
        fixed!(SymplecticIntegrator::ruth_forest),
        held!(ExplicitRungeKutta::rkf45),
        held!(ExplicitRungeKutta::cash_karp),
        held!(ExplicitRungeKutta::dopri5),
        held!(ExplicitRungeKutta::dop853),
        held!(ExplicitRungeKutta::rkv655e),
        held!(ExplicitRungeKutta::rkv656e),
        held!(ExplicitRungeKutta::rkv766e),
        held!(ExplicitRungeKutta::rkv767e),
        held!(ExplicitRungeKutta::rkv877e),
        held!(ExplicitRungeKutta::rkv878e),
        held!(ExplicitRungeKutta::rkv988e),
        held!(ExplicitRungeKutta::rkv989e),
        held!(ImplicitRungeKutta::gauss_legendre_4),
        held!(ImplicitRungeKutta::gauss_legendre_6),
        held!(ImplicitRungeKutta::lobatto_iiic_2),
        held!(ImplicitRungeKutta::lobatto_iiic_4),
        held!(DiagonallyImplicitRungeKutta::sdirk21),
        held!(DiagonallyImplicitRungeKutta::esdirk324l2sa),
        held!(DiagonallyImplicitRungeKutta::kvaerno423),
        held!(DiagonallyImplicitRungeKutta::kvaerno745),
    ]);
}
