//! The methods, one file each.

pub mod forward_euler;
pub mod rk4;
pub mod stormer_verlet;
pub mod symplectic_euler;
