//! When a motion crosses the bottom, by a last step that ends there.

use pendula::metrics::CrossingRule;
use pendula::{Method, Phase, Rk4, System, state};

/// A step of the system itself that ends on the crossing: an RK4 step back from the sample beyond,
/// with θ as the independent variable, so that its length, −θ, is known (Hénon, *Physica D* 5
/// (1982) 412–414).
#[derive(Clone, Copy, Debug)]
pub struct Henon<'a, S>(pub &'a S);

impl<S: System<State = Phase>> CrossingRule for Henon<'_, S> {
    fn time(&self, _before: f64, _from: Phase, after: f64, to: Phase) -> f64 {
        let moment = Moment { time: after, omega: to.omega };
        Rk4.step(self, to.theta, -to.theta, moment, &mut ()).time
    }
}

/// The equation of motion with θ as its independent variable: dt/dθ = 1/θ̇, dω/dθ = ω̇/θ̇.
impl<S: System<State = Phase>> System for Henon<'_, S> {
    type State = Moment;

    fn rate(&self, theta: f64, Moment { time, omega }: Moment) -> Moment {
        let rate = self.0.rate(time, Phase { theta, omega });
        Moment { time: 1.0 / rate.theta, omega: rate.omega / rate.theta }
    }
}

state! {
    /// When the pendulum is at a given angle, and how fast it then moves; or the rate of change of
    /// both, per radian.
    pub struct Moment {
        /// Time t (s).
        pub time: f64,
        /// Angular velocity (rad/s).
        pub omega: f64,
    }
}
