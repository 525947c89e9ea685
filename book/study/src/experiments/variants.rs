//! A method that the paper might have meant but did not use: its numbers tell the two apart.

use pendula::methods::SymplecticEuler;
use pendula::systems::Separable;
use pendula::{Info, Method, MethodInfo};

/// Symplectic Euler the other way round: drift, then kick.
///
/// Order 1, symplectic, not symmetric, one force evaluation a step. Hairer, Lubich, Wanner (2006),
/// Sect. I.1.2.
#[derive(Clone, Copy, Debug)]
pub struct DriftKick;

impl Info for DriftKick {
    fn info(&self) -> MethodInfo {
        MethodInfo { name: "drift-kick", ..SymplecticEuler.info() }
    }
}

impl<S: Separable> Method<S> for DriftKick {
    type Carry = ();

    fn start(&self, _system: &S, _t: f64, _h: f64, _z: S::State) {}

    #[inline(always)]
    fn step(&self, system: &S, t: f64, h: f64, z: S::State, _carry: &mut ()) -> S::State {
        let z = system.drift(z, h);
        system.kick(z, system.force(t + h, z), h)
    }
}

#[cfg(test)]
mod tests {
    use pendula::{Damped, Driven, Pendulum, Phase};

    use super::*;

    /// Catches: the force at the time of the step's beginning, which shows only on a system that
    /// depends on time; an entry under another method's name.
    #[test]
    fn the_kick_follows_the_drift_in_place_and_time() {
        let damped = Damped::new(Pendulum::PAPER, 0.0).unwrap();
        let driven = Driven::new(damped, 0.8, 1.1).unwrap();
        let (t, h, z) = (0.7, 0.25, Phase { theta: 1.0, omega: 0.5 });
        let end = DriftKick.step(&driven, t, h, z, &mut ());
        let theta = 1.0 + h * 0.5;
        let alpha = 9.81 * (0.8 * libm::cos(1.1 * (t + h)) - libm::sin(theta));
        assert_eq!(end.theta, theta);
        // Roundings of numbers up to 10, times h.
        assert!((end.omega - (0.5 + h * alpha)).abs() < 1e-14, "{end:?}");
        assert_eq!(DriftKick.info().name, "drift-kick");
    }
}
