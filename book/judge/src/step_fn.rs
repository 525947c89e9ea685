//! A function for one step, as an integrator.

use core::fmt;

use pendula::systems::{Counting, Phase, Separable};

use crate::integrator::{Fault, Integrator, NOTHING, Reply, Request, pendulum};

/// An integrator that is a function for one step: of the force, θ (rad), ω (rad/s) and h (s), which
/// returns θ and ω one step later. `force(theta)` is the angular acceleration −(g/L) sin θ (1/s²),
/// and how often it is called is counted.
///
/// ```
/// use pendula_judge::{Claims, FromStep, judge};
///
/// let verlet = FromStep::new(|force, theta, omega, h| {
///     let omega = omega + h / 2.0 * force(theta);
///     let theta = theta + h * omega;
///     (theta, omega + h / 2.0 * force(theta))
/// });
/// let report = judge(&verlet, Claims::order(2).symplectic().symmetric().evaluations(2));
/// report.assert();
/// assert_eq!(report.identity.unwrap().method, "stormer-verlet");
/// ```
///
/// For a whole run, which may keep a force from one step to the next, there is
/// [`FromFn`](crate::FromFn). Neither is told the time, so that both answer for the pendulum
/// without a drive alone.
#[derive(Clone, Copy)]
pub struct FromStep<F>(F);

impl<F: Fn(&dyn Fn(f64) -> f64, f64, f64, f64) -> (f64, f64)> FromStep<F> {
    /// The integrator that takes each step by `step`.
    pub const fn new(step: F) -> Self {
        Self(step)
    }
}

impl<F> fmt::Debug for FromStep<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FromStep").finish_non_exhaustive()
    }
}

impl<F: Fn(&dyn Fn(f64) -> f64, f64, f64, f64) -> (f64, f64)> Integrator for FromStep<F> {
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        if request.drive.is_some() {
            return Err(Fault::Unsupported);
        }
        request.check()?;
        let pendulum = Counting::new(pendulum(request)?);
        let force = |theta: f64| pendulum.force(0.0, Phase::at_rest(theta));
        let mut states = vec![NOTHING; request.states() as usize];
        let Phase { mut theta, mut omega } = request.start;
        for n in 1..=request.steps {
            (theta, omega) = (self.0)(&force, theta, omega, request.step);
            if n % request.every == 0 {
                states[(n / request.every - 1) as usize] = Phase { theta, omega };
            }
        }
        Ok(Reply { states, evaluations: Some(pendulum.evaluations()) })
    }
}
