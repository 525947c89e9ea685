//! What is measured of runs: energy error, angle error and period, each by an observer; the error
//! at the end; and the slope of errors against steps.
//!
//! A tuple of observers is an observer.
//!
//! ```
//! use pendula::metrics::{AngleError, CrossingPeriod, EnergyDrift};
//! use pendula::{Grid, Motion, Pendulum, Phase, Rk4, exact, integrate_with};
//!
//! let (pendulum, start) = (Pendulum::PAPER, Phase::at_rest(1.0));
//! let motion = Motion::new(&pendulum, start)?;
//! let energy = EnergyDrift::new(&pendulum);
//! let angle = AngleError::new(|t| motion.at(t).theta);
//! let mut observer = (energy, angle, CrossingPeriod::default());
//! integrate_with(&pendulum, &Rk4, start, &Grid::with_duration(0.01, 10.0)?, &mut observer);
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
