//! The methods against the predictions of theory.

#[macro_use]
#[path = "../common/each_method.rs"]
mod common;

mod carried_area;
mod compensated;
mod completing;
mod conjugacy;
mod enclosure;
mod energy_law;
mod long_time;
mod modified_series;
mod period_readings;
mod period_shift;
mod saturation;
mod standard_map;
