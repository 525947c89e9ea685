//! differential-equations 0.7.0. The methods with step control are held to fixed steps by
//! tolerances that nothing exceeds and by `h_max`.
//! Claims, as quoted from that version:
//!   euler: order=1 name=forward-euler evaluations=1. “"Creates an Explicit Euler method (1st
//!   order, 1
//!     stage)."” (differential-equations src/methods/erk/fixed/mod.rs:46)
//!   midpoint: order=2 name=explicit-midpoint evaluations=2. “"Creates an Explicit Midpoint method
//!   (2nd
//!     order, 2 stages)."” (differential-equations src/methods/erk/fixed/mod.rs:53)
//!   heun: order=2 name=heun evaluations=2. “"Creates an Explicit Heun method (2nd order, 2
//!   stages)."”
//!     (differential-equations src/methods/erk/fixed/mod.rs:60)
//!   ralston: order=2 evaluations=2. “"Creates an Explicit Ralston method (2nd order, 2 stages)."”
//!     (differential-equations src/methods/erk/fixed/mod.rs:67)
//!   ssp_rk3: order=3. “"Creates the Strong Stability Preserving 3rd order Runge-Kutta method."”
//!     (differential-equations src/methods/erk/fixed/mod.rs:88)
//!   rk4: order=4 name=rk4. “"Creates the classical 4th order Runge-Kutta method."”
//!   (differential-equations
//!     src/methods/erk/fixed/mod.rs:74)
//!   three_eighths: order=4. “"Creates the three-eighths rule 4th order Runge-Kutta method."”
//!     (differential-equations src/methods/erk/fixed/mod.rs:81)
//!   backward_euler: order=1. “"Backward Euler, order 1, 1 stage. A-stable; stiff-suitable."”
//!     (differential-equations src/methods/irk/fixed/mod.rs:45)
//!   crank_nicolson: order=2. “"Crank-Nicolson, order 2, 2 stages. A-stable; stiff-suitable."”
//!     (differential-equations src/methods/irk/fixed/mod.rs:52)
//!   trapezoidal: order=2. “"Trapezoidal, order 2, 2 stages. A-stable; stiff-suitable."”
//!     (differential-equations src/methods/irk/fixed/mod.rs:59)
//!   esdirk33: order=3. “impl_dirk_fixed_step_constructor!(esdirk33, 3, 3, 3, "ESDIRK-3-3:
//!   3-stage, order
//!     3.");” (differential-equations src/methods/dirk/fixed/mod.rs:39)
//!   velocity_verlet: order=2 symplectic name=stormer-verlet. “Velocity Verlet (2nd Order
//!   Symplectic
//!     Integrator). … 2-form, which geometrically means they preserve phase space volume exactly.”
//!     (differential-equations src/methods/symplectic/velocity_verlet.rs:16; differential-equations
//!     src/methods/symplectic/mod.rs:8)
//!   ruth_forest: order=4 symplectic name=forest-ruth. “Ruth-Forest (4th Order Symplectic
//!   Integrator). …
//!     2-form, which geometrically means they preserve phase space volume exactly.”
//!     (differential-equations
//!     src/methods/symplectic/ruth_forest.rs:16; differential-equations
//!     src/methods/symplectic/mod.rs:8)
//!   rkf45: order=5. “"Creates a Runge-Kutta-Fehlberg 4(5) method with error estimation."”
//!     (differential-equations src/methods/erk/adaptive/mod.rs:49)
//!   cash_karp: order=5. “"Creates a Cash-Karp 4(5) method with error estimation."”
//!   (differential-equations
//!     src/methods/erk/adaptive/mod.rs:57)
//!   rkv655e: order=6. “"Creates an Explicit Runge-Kutta 6(5) method with 9 stages and a 5th order
//!     interpolant."” (differential-equations src/methods/erk/adaptive/mod.rs:65)
//!   rkv656e: order=6. “"Creates an Explicit Runge-Kutta 6(5) method with 9 stages and a 6th order
//!     interpolant."” (differential-equations src/methods/erk/adaptive/mod.rs:73)
//!   rkv766e: order=7. “"Creates an Explicit Runge-Kutta 7(6) method with 10 stages and a 6th order
//!     interpolant."” (differential-equations src/methods/erk/adaptive/mod.rs:81)
//!   rkv767e: order=7. “"Creates an Explicit Runge-Kutta 7(6) method with 10 stages and a 7th order
//!     interpolant."” (differential-equations src/methods/erk/adaptive/mod.rs:89)
//!   rkv877e: order=8. “"Creates an Explicit Runge-Kutta 8(7) method with 13 stages and a 7th order
//!     interpolant."” (differential-equations src/methods/erk/adaptive/mod.rs:97)
//!   rkv878e: order=8. “"Creates an Explicit Runge-Kutta 8(7) method with 13 stages and an 8th
//!   order
//!     interpolant."” (differential-equations src/methods/erk/adaptive/mod.rs:105)
//!   rkv988e: order=9. “"Creates an Explicit Runge-Kutta 9(8) method with 16 stages and an 8th
//!   order
//!     interpolant."” (differential-equations src/methods/erk/adaptive/mod.rs:113)
//!   rkv989e: order=9. “"Creates an Explicit Runge-Kutta 9(8) method with 16 stages and a 9th order
//!     interpolant."” (differential-equations src/methods/erk/adaptive/mod.rs:121)
//!   dopri5: order=5 name=dormand-prince. “"Creates the DOPRI5 method (5th order, 7 stages)."”
//!     (differential-equations src/methods/erk/dormandprince/mod.rs:57)
//!   dop853: order=8 name=dop853. “"Creates the DOP853 method (8th order, 12 stages, 4 dense output
//!     stages)."” (differential-equations src/methods/erk/dormandprince/mod.rs:50)
//!   gauss_legendre_4: order=4 name=gauss-4. “"Creates a new Gauss-Legendre 2-stage implicit
//!   Runge-Kutta
//!     method of order 4."” (differential-equations src/methods/irk/adaptive/mod.rs:46)
//!   gauss_legendre_6: order=6 name=gauss-6. “"Creates a new Gauss-Legendre 3-stage implicit
//!   Runge-Kutta
//!     method of order 6."” (differential-equations src/methods/irk/adaptive/mod.rs:53)
//!   lobatto_iiic_2: order=2. “"Creates a new Lobatto IIIC 2-stage implicit Runge-Kutta method of
//!   order 2."”
//!     (differential-equations src/methods/irk/adaptive/mod.rs:62)
//!   lobatto_iiic_4: order=4. “"Creates a new Lobatto IIIC 3-stage implicit Runge-Kutta method of
//!   order 4."”
//!     (differential-equations src/methods/irk/adaptive/mod.rs:69)
//!   sdirk21: order=2. “"SDIRK-2-1: 2-stage, order 2(1). Embedded; L-stable."”
//!   (differential-equations
//!     src/methods/dirk/adaptive/mod.rs:45)
//!   esdirk324l2sa: order=3. “"ESDIRK3(2)4L[2]SA: 4-stage, order 3(2). Embedded; L-stable."”
//!     (differential-equations src/methods/dirk/adaptive/mod.rs:52)
//!   kvaerno423: order=3. “"Kvaerno(4,2,3): 4-stage, order 3(2). Embedded; L-stable."”
//!     (differential-equations src/methods/dirk/adaptive/mod.rs:59)
//!   kvaerno745: order=5. “"Kvaerno(7,4,5): 7-stage, order 5(4). Embedded; L-stable."”
//!     (differential-equations src/methods/dirk/adaptive/mod.rs:66)

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
