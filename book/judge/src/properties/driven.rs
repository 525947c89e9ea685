//! Driven: a force that depends on time alone. The pendulum's does not, and so cannot show at which
//! times a method evaluates it.

use super::{CheckResult, near};
use pendula::{Grid, Method, Phase, Separable, System, integrate};

/// A free particle under the force t³/6 (rad/s²).
#[derive(Clone, Copy, Debug)]
pub struct Pushed;

impl System for Pushed {
    type State = Phase;

    fn rate(&self, t: f64, z: Phase) -> Phase {
        Phase { theta: z.omega, omega: self.force(t, z) }
    }
}

impl Separable for Pushed {
    type Force = f64;

    fn force(&self, t: f64, _z: Phase) -> f64 {
        t * t * t / 6.0
    }

    fn kick(&self, z: Phase, alpha: f64, h: f64) -> Phase {
        Phase { omega: z.omega + alpha * h, ..z }
    }

    fn drift(&self, z: Phase, h: f64) -> Phase {
        Phase { theta: z.theta + z.omega * h, ..z }
    }
}

/// ω = t⁴/24, from rest. A method of order p on n steps of h = 1/n has an error of about hᵖ at the
/// end; here at most ½hᵖ, and for RK4, which integrates cubics exactly, and for all of higher order
/// only rounding. A step adds to numbers up to 1/24 and rounds by ε/2 of them. Only beyond order 8
/// is that more than ½hᵖ; and the weights of those methods add up to one in size, so that their
/// slopes round by no more.
pub fn check<M: Method<Pushed> + pendula::Info>(method: &M) -> CheckResult {
    let order = f64::from(method.info().order);
    for steps in [8, 16, 32] {
        let h = 1.0 / steps as f64;
        let grid = Grid::new(h, steps).expect("a positive step");
        let end = integrate(&Pushed, method, Phase::default(), &grid);
        let rounding = steps as f64 * f64::EPSILON / 24.0;
        let tolerance = (0.5 * libm::pow(h, order)).max(rounding);
        near(format_args!("ω with h = {h}"), end.omega, 1.0 / 24.0, tolerance)?;
        near(format_args!("θ with h = {h}"), end.theta, 1.0 / 120.0, tolerance)?;
    }
    Ok(())
}

/// ω after n steps of either of Euler's methods, which evaluate the force at the beginning of each:
/// h Σ (kh)³/6 for k below n, which is h⁴ (n(n − 1)/2)²/6. With h = 1/16 only the sixth and the sum
/// round, by at most ε/2 a step of ω, which is below 1/24. With the force at the end of each step ω
/// would be off by h (nh)³/6: 1e-2 at the end, 3e-6 after the first step.
pub fn check_euler<M: Method<Pushed>>(method: &M) -> CheckResult {
    let h = 0.0625;
    for steps in [1, 2, 5, 16] {
        let grid = Grid::new(h, steps).expect("a positive step");
        let end = integrate(&Pushed, method, Phase::default(), &grid);
        let n = steps as f64;
        let pairs = n * (n - 1.0) / 2.0;
        let sum = h * h * h * h * pairs * pairs / 6.0;
        let tolerance = n * f64::EPSILON / 24.0;
        near(format_args!("ω after {steps} steps"), end.omega, sum, tolerance)?;
    }
    Ok(())
}
