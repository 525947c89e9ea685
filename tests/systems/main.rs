//! Systems beyond the simple pendulum.

#[macro_use]
#[path = "../common/each_method.rs"]
mod common;

mod damped;
mod double_pendulum;
mod driven;
mod dynamics;
mod kepler;
mod known_answers;
mod magnetic;
mod many_bodies;
mod shaken;
mod symmetric_steps;
