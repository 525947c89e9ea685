//! What is measured along a trajectory, each as an observer: energy error, angle error, period; the error at its end; and
//! the area of a polygon of initial states.

mod angle;
mod area;
mod end;
mod energy;
pub mod order;
mod period;

pub use angle::AngleError;
pub use area::polygon_area;
pub use end::EndError;
pub use energy::EnergyDrift;
pub use period::{Crossing, CrossingPeriod, Henon, Hermite, Linear, Moment, Peak, PeakPeriod};
