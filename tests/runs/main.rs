//! The time loops: grid, observers, lanes, variable steps; and extreme inputs.

#[macro_use]
#[path = "../common/each_method.rs"]
mod common;

#[path = "../common/random.rs"]
mod random;

mod adaptive;
mod anything;
mod checkpoint;
mod ensemble;
mod extremes;
mod flips;
mod grid;
mod implicit;
mod integrate_fast;
mod observers;
mod parameters;
mod separatrix;
mod stability;
mod step_size;
mod symmetric_steps;
mod taylor_series;
