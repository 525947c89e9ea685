//! Averages along the exact orbit.

use pendula::exact::{Motion, MotionKind};
use pendula::{Pendulum, Phase};

use super::Dimensionless;

/// Points on the orbit. The error of the trapezoid rule is the N-th harmonic and those beyond,
/// which fall as exp(−π K'/(2K)) each: for N = 256 it is far below rounding for θ₀ ≤ 3, and
/// exp(−31) at 1e-8 rad from the top.
const POINTS: u32 = 256;

/// The mean over time, along the exact swing of a release from rest at `theta_0` (rad), of
/// `quantity`.
///
/// The integrand is periodic and analytic, so the trapezoid rule converges geometrically (Trefethen
/// & Weideman, SIAM Review 56 (2014)).
pub fn average(pendulum: &Pendulum, theta_0: f64, quantity: impl Fn(Dimensionless) -> f64) -> f64 {
    let Ok(motion) = Motion::new(pendulum, Phase::at_rest(theta_0)) else {
        return f64::NAN;
    };
    match (motion.kind(), motion.period()) {
        (MotionKind::Libration, Some(period)) => {
            let at = |n: u32| motion.at(period * (f64::from(n) / f64::from(POINTS)));
            let sum: f64 =
                (0..POINTS).map(|n| quantity(Dimensionless::from_phase(pendulum, at(n)))).sum();
            sum / f64::from(POINTS)
        }
        _ => f64::NAN,
    }
}
