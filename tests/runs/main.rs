//! The time loops: grid, observers, lanes, steps that vary; and what happens at the edges.

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
