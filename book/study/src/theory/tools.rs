//! The tools: averages along the exact orbit, and the flow of a modified equation, solved far more
//! accurately than the equation itself is known.

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

/// Columns of the extrapolation table: order 2 × 4 = 8.
const COLUMNS: usize = 4;

/// The state a time `step` after `z` along ż = `rate`(z): the midpoint rule with 2, 4, 6 and 8
/// substeps, extrapolated to infinitely many.
///
/// Gragg's method: the error of the midpoint rule after an even number of substeps is a series in
/// even powers of their length, so that each column of the Aitken–Neville table raises the order by
/// two (Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I* (1993), Sect. II.9). A
/// step that turns the pendulum by 0.3 rad errs by 1e-10.
pub(super) fn flow<const N: usize>(
    rate: impl Fn([f64; N]) -> [f64; N],
    z: [f64; N],
    step: f64,
) -> [f64; N] {
    let along = |z: [f64; N], slope: [f64; N], h: f64| -> [f64; N] {
        core::array::from_fn(|i| z[i] + h * slope[i])
    };
    let initial = rate(z);
    let mut table = [[0.0; N]; COLUMNS];
    for k in 0..COLUMNS {
        let substeps = 2 * (k + 1);
        let h = step / substeps as f64;
        let (mut before, mut now) = (z, along(z, initial, h));
        for _ in 1..substeps {
            (before, now) = (now, along(before, rate(now), 2.0 * h));
        }
        // Aitken–Neville in the square of the substep; the diagonal ends up in table[0].
        table[k] = now;
        for j in (0..k).rev() {
            let ratio = substeps as f64 / (2 * (j + 1)) as f64;
            let weight = 1.0 / (ratio * ratio - 1.0);
            table[j] = core::array::from_fn(|i| {
                table[j + 1][i] + (table[j + 1][i] - table[j][i]) * weight
            });
        }
    }
    table[0]
}
