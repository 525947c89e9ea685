//! What is measured along a trajectory, each as an observer: energy error, angle error, period; and the area of a polygon
//! of initial states.

mod angle;
mod area;
mod energy;
mod period;

pub use angle::AngleError;
pub use area::polygon_area;
pub use energy::EnergyDrift;
pub use period::{Crossing, CrossingPeriod, Henon, Hermite, Linear, Moment, Peak, PeakPeriod};
