//! The methods, one file each.

pub mod dop853;
pub mod dormand_prince;
pub mod forward_euler;
pub mod rk4;
pub mod stormer_verlet;
pub mod symplectic_euler;
