//! What is measured along a trajectory, each as an observer: energy error, angle error, period.

mod angle;
mod energy;
mod period;

pub use angle::AngleError;
pub use energy::EnergyDrift;
pub use period::{Crossing, CrossingPeriod, Henon, Hermite, Linear, Moment, Peak, PeakPeriod};
