//! Splitting methods: alternately the force kicks the velocity and the velocity drifts the
//! position.
//!
//! Symplectic Euler and the two Verlet methods are written out; the others are tables of kicks and
//! drifts, a [`Splitting`] each.

mod blanes_moan_6;
mod blanes_moan_srkn_14a;
mod blanes_moan_srkn_6b;
mod deuflhard;
mod forest_ruth;
mod kahan_li_8;
mod position_verlet;
mod ruth_3;
mod stormer_verlet;
mod suzuki_4;
mod symplectic_euler;
mod table;
mod yoshida_6;
mod yoshida_8;

pub use blanes_moan_6::BlanesMoan6;
pub use blanes_moan_srkn_6b::BlanesMoanSrkn6b;
pub use blanes_moan_srkn_14a::BlanesMoanSrkn14a;
pub use deuflhard::{Deuflhard, Rotating};
pub use forest_ruth::ForestRuth;
pub use kahan_li_8::KahanLi8;
pub use position_verlet::PositionVerlet;
pub use ruth_3::Ruth3;
pub use stormer_verlet::StormerVerlet;
pub use suzuki_4::Suzuki4;
pub use symplectic_euler::SymplecticEuler;
#[cfg(feature = "table")]
pub(crate) use table::KicksAndDrifts;
pub(crate) use table::palindrome;
pub use table::{Splitting, kicks, length};
pub use yoshida_6::Yoshida6;
pub use yoshida_8::Yoshida8;
