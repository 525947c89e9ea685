//! The time loops: grid, observers, lanes, variable steps; and extreme inputs.

#[macro_use]
#[path = "../common/each_method.rs"]
mod common;

mod adaptive;
mod anything;
mod doors;
mod ensemble;
mod extremes;
mod grid;
mod implicit;
mod in_parts;
mod integrate_fast;
mod separatrix;
mod series_overflow;
mod stability;
mod step_density;
mod taylor_series;
