//! The methods, one file each.

pub mod blanes_moan_4;
pub mod blanes_moan_6;
pub mod dop853;
pub mod dormand_prince;
pub mod explicit_midpoint;
pub mod forest_ruth;
pub mod forward_euler;
pub mod gauss_16;
pub mod gauss_4;
pub mod gauss_6;
pub mod heun;
pub mod implicit_midpoint;
pub mod kahan_li_8;
pub mod position_verlet;
pub mod rk4;
pub mod ruth_3;
pub mod stormer_verlet;
pub mod suzuki_4;
pub mod symplectic_euler;
pub mod taylor_24;
pub mod yoshida_6;
pub mod yoshida_8;
