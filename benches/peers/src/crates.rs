//! The other crates, each at its best: `differential-equations` is stepped by hand, which keeps no
//! states; `ode_solvers` always keeps every state. Neither has symplectic Euler.

use differential_equations::methods::{ExplicitRungeKutta, SymplecticIntegrator};
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};
use ode_solvers::{OutputType, System, Vector2};
use pendula::Phase;

/// The paper's pendulum, in the form that the crates require.
struct Equations;

impl System<f64, Vector2<f64>> for Equations {
    fn system(&self, _t: f64, z: &Vector2<f64>, rate: &mut Vector2<f64>) {
        rate[0] = z[1];
        rate[1] = -9.81 * z[0].sin();
    }
}

impl ODE<f64, [f64; 2]> for Equations {
    fn diff(&self, _t: f64, z: &[f64; 2], rate: &mut [f64; 2]) {
        *rate = [z[1], -9.81 * z[0].sin()];
    }
}

/// A method of a crate with fixed steps: the start, the number of steps and their length (s).
pub type Loop = fn(Phase, u64, f64) -> Phase;

/// A method of a crate with a tolerance: the start, the end time (s), the tolerance. A run that
/// fails returns NaN.
pub type Controlled = fn(Phase, f64, f64) -> Phase;

/// The crates' methods that the library has too, by the library's name.
pub const STEPPED: [(&str, &str, Loop); 5] = [
    ("forward-euler", "differential-equations", |start, steps, step| {
        stepped_by_hand(ExplicitRungeKutta::euler(step).max_steps(MOST), start, steps, step)
    }),
    ("rk4", "ode_solvers", ode_solvers_rk4),
    ("rk4", "differential-equations", |start, steps, step| {
        stepped_by_hand(ExplicitRungeKutta::rk4(step).max_steps(MOST), start, steps, step)
    }),
    ("stormer-verlet", "differential-equations", |start, steps, step| {
        let method = SymplecticIntegrator::velocity_verlet(step);
        stepped_by_hand(method.max_steps(MOST), start, steps, step)
    }),
    ("forest-ruth", "differential-equations", |start, steps, step| {
        let method = SymplecticIntegrator::ruth_forest(step);
        stepped_by_hand(method.max_steps(MOST), start, steps, step)
    }),
];

/// The crates' methods that may reach a small error.
pub const CONTROLLED: [(&str, Controlled); 5] = [
    ("ode_solvers Dopri5", ode_solvers_dopri5),
    ("ode_solvers Dop853", ode_solvers_dop853),
    ("differential-equations dopri5", |start, end, tolerance| {
        let method = ExplicitRungeKutta::dopri5();
        controlled_by_hand(method.rtol(tolerance).atol(tolerance).max_steps(MOST), start, end)
    }),
    ("differential-equations dop853", |start, end, tolerance| {
        let method = ExplicitRungeKutta::dop853();
        controlled_by_hand(method.rtol(tolerance).atol(tolerance).max_steps(MOST), start, end)
    }),
    ("differential-equations rkv988e", |start, end, tolerance| {
        let method = ExplicitRungeKutta::rkv988e();
        controlled_by_hand(method.rtol(tolerance).atol(tolerance).max_steps(MOST), start, end)
    }),
];

/// More steps than any run needs.
const MOST: usize = 1 << 30;

/// The result of a run that failed.
const NOWHERE: Phase = Phase { theta: f64::NAN, omega: f64::NAN };

fn ode_solvers_rk4(start: Phase, steps: u64, step: f64) -> Phase {
    let z = Vector2::new(start.theta, start.omega);
    let mut stepper = ode_solvers::Rk4::new(Equations, 0.0, z, steps as f64 * step, step);
    stepper.integrate().expect("a fixed step");
    let end = stepper.y_out().last().expect("the start at least");
    Phase { theta: end[0], omega: end[1] }
}

fn stepped_by_hand(
    mut method: impl OrdinaryNumericalMethod<f64, [f64; 2]>,
    start: Phase,
    steps: u64,
    step: f64,
) -> Phase {
    let end = steps as f64 * step;
    method.init(&Equations, 0.0, end, &[start.theta, start.omega]).expect("a fixed step");
    for _ in 0..steps {
        method.step(&Equations).expect("as many steps as are allowed");
    }
    let [theta, omega] = *method.y();
    Phase { theta, omega }
}

fn controlled_by_hand(
    mut method: impl OrdinaryNumericalMethod<f64, [f64; 2]>,
    start: Phase,
    end: f64,
) -> Phase {
    if method.init(&Equations, 0.0, end, &[start.theta, start.omega]).is_err() {
        return NOWHERE;
    }
    while method.t() < end {
        if method.h() > end - method.t() {
            method.set_h(end - method.t());
        }
        if method.step(&Equations).is_err() {
            return NOWHERE;
        }
    }
    let [theta, omega] = *method.y();
    Phase { theta, omega }
}

macro_rules! controlled_by_ode_solvers {
    ($($name:ident: $stepper:ident, $beta:literal, $smallest:literal, $largest:literal;)+) => {$(
        /// With the crate's own defaults, except for the number of steps allowed and the output,
        /// which is every step and nothing between.
        fn $name(start: Phase, end: f64, tolerance: f64) -> Phase {
            let z = Vector2::new(start.theta, start.omega);
            let mut stepper = ode_solvers::$stepper::from_param(
                Equations, 0.0, end, end, z, tolerance, tolerance,
                0.9, $beta, $smallest, $largest, end, 0.0, u32::MAX, 1000, OutputType::Sparse,
            );
            match (stepper.integrate(), stepper.y_out().last()) {
                (Ok(_), Some(end)) => Phase { theta: end[0], omega: end[1] },
                _ => NOWHERE,
            }
        }
    )+};
}
controlled_by_ode_solvers! {
    ode_solvers_dopri5: Dopri5, 0.04, 0.2, 10.0;
    ode_solvers_dop853: Dop853, 0.0, 0.333, 6.0;
}
