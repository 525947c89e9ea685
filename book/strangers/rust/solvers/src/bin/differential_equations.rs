//! differential-equations 0.7.0, `IVP::ode`. A step ends at the last time; those before are
//! interpolated (`t_eval`). Crossings are those of `crossing`.

use differential_equations::ivp::IVP;
use differential_equations::methods::{
    AdamsPredictorCorrector, BackwardDifferentiationFormula, DiagonallyImplicitRungeKutta,
    ExplicitRungeKutta, ImplicitRungeKutta,
};
use differential_equations::ode::ODE;
use differential_equations::solout::CrossingDirection;
use strangers_protocol::solver::{serve, Run, Solver};

struct Equations<'a>(&'a Run);

impl ODE<f64, [f64; 2]> for Equations<'_> {
    fn diff(&self, t: f64, y: &[f64; 2], rate: &mut [f64; 2]) {
        *rate = self.0.rate(t, *y);
    }
}

/// More steps than anybody asks for.
const MOST: usize = 1_000_000;

macro_rules! solver {
    ($family:ident :: $name:ident) => {
        solver!($family::$name, |run| {
            $family::$name().rtol(run.tol).atol(run.each).max_steps(MOST)
        })
    };
    ($family:ident :: $name:ident, |$run:ident| $method:expr) => {
        Solver {
            name: stringify!($name),
            solve: |$run| {
                let solution = IVP::ode(&Equations($run), $run.from(), $run.end(), $run.start)
                    .t_eval(&$run.grid[1..])
                    .method($method)
                    .solve();
                Ok(solution.map_err(|why| format!("{why:?}"))?.y)
            },
            crossings: Some(|$run| {
                let solution = IVP::ode(&Equations($run), $run.from(), $run.end(), $run.start)
                    .crossing(0, 0.0, CrossingDirection::Both)
                    .method($method)
                    .solve();
                let found = solution.map_err(|why| format!("{why:?}"))?;
                Ok(found.t.iter().zip(&found.y).map(|(t, y)| [*t, y[0], y[1]]).collect())
            }),
        }
    };
}

fn main() {
    serve(vec![
        solver!(ExplicitRungeKutta::rkf45),
        solver!(ExplicitRungeKutta::cash_karp),
        solver!(ExplicitRungeKutta::dopri5),
        solver!(ExplicitRungeKutta::dop853),
        solver!(ExplicitRungeKutta::rkv655e),
        solver!(ExplicitRungeKutta::rkv656e),
        solver!(ExplicitRungeKutta::rkv766e),
        solver!(ExplicitRungeKutta::rkv767e),
        solver!(ExplicitRungeKutta::rkv877e),
        solver!(ExplicitRungeKutta::rkv878e),
        solver!(ExplicitRungeKutta::rkv988e),
        solver!(ExplicitRungeKutta::rkv989e),
        solver!(ImplicitRungeKutta::gauss_legendre_4),
        solver!(ImplicitRungeKutta::gauss_legendre_6),
        solver!(ImplicitRungeKutta::lobatto_iiic_4),
        solver!(ImplicitRungeKutta::radau5),
        solver!(DiagonallyImplicitRungeKutta::sdirk21),
        solver!(DiagonallyImplicitRungeKutta::esdirk324l2sa),
        solver!(DiagonallyImplicitRungeKutta::kvaerno423),
        solver!(DiagonallyImplicitRungeKutta::kvaerno745),
        solver!(BackwardDifferentiationFormula::adaptive),
        solver!(AdamsPredictorCorrector::v4, |run| {
            AdamsPredictorCorrector::v4().tol(run.tol).h0(run.first()).max_steps(MOST)
        }),
    ]);
}
