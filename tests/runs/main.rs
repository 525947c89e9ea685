//! The time loops: grid, observers, lanes, variable steps; and extreme inputs.

#[path = "../common/each_method.rs"]
mod common;

mod adaptive;
mod ensemble;
mod extremes;
mod grid;
mod integrate_fast;
mod observers;
mod parameters;
mod separatrix;
mod stability;
mod symmetric_steps;
