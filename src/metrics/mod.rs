//! What is measured of runs: energy error, angle error and period, each by an observer; the error
//! at the end; the area of a polygon of states; and the slope of errors against steps.
//!
//! A tuple of observers is an observer.
//!
//! ```
//! use pendula::metrics::{AngleError, CrossingPeriod, EnergyDrift};
//! use pendula::{Grid, Motion, Pendulum, Phase, Rk4, exact, integrate};
//!
//! let (pendulum, start) = (Pendulum::PAPER, Phase::at_rest(1.0));
//! let motion = Motion::new(&pendulum, start)?;
//! let energy = EnergyDrift::new(&pendulum);
//! let angle = AngleError::new(|t| motion.at(t).theta);
//! let mut observer = (energy, angle, CrossingPeriod::default());
//! integrate(&pendulum, &Rk4, start, &Grid::with_duration(0.01, 10.0)?, &mut observer);
//! let (energy, angle, period) = observer;
//! assert!(energy.largest() < 1e-6 && angle.root_mean_square() < 1e-6);
//! let exact = exact::period(&pendulum, 1.0)?;
//! assert!((period.period().unwrap() - exact).abs() < 1e-6);
//! # Ok::<(), pendula::Error>(())
//! ```

mod errors;
pub mod order;
mod period;

pub use errors::{AngleError, EndError, EnergyDrift};
pub use period::{CrossingPeriod, CrossingRule, Hermite, Linear, PeakPeriod};

use crate::systems::Phase;

/// The signed area of a polygon in phase space (rad²/s), positive if its corners are
/// counterclockwise with θ to the right and ω upwards.
///
/// A Hamiltonian flow preserves the area within a curve, but not within a polygon, whose edges it
/// bends: the area of a polygon of n points on a curve is off by O(1/n²). Affine maps, such as the
/// flow of the linear oscillator, keep edges straight.
pub fn polygon_area(corners: &[Phase]) -> f64 {
    let Some((first, rest)) = corners.split_first() else { return 0.0 };
    // Triangles from the first corner: a small polygon far from the origin loses no digits.
    let from_first =
        |z: &Phase| Phase { theta: z.theta - first.theta, omega: z.omega - first.omega };
    rest.windows(2)
        .map(|edge| (from_first(&edge[0]), from_first(&edge[1])))
        .map(|(a, b)| 0.5 * (a.theta * b.omega - b.theta * a.omega))
        .sum()
}
