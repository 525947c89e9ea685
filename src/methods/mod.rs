//! The methods, by family.

pub mod gauss;
mod info;
pub mod registry;
pub mod runge_kutta;
pub mod splitting;
pub mod taylor;

pub use gauss::{Gauss4, Gauss6, Gauss16, ImplicitMidpoint};
pub use info::{Described, Properties};
pub use registry::{AnyMethod, METHODS, method_named};
pub use runge_kutta::{Dop853, DormandPrince, ExplicitMidpoint, ForwardEuler, Heun, Rk4};
pub use splitting::{
    BlanesMoan4, BlanesMoan6, ForestRuth, KahanLi8, PositionVerlet, Ruth3, StormerVerlet, Suzuki4,
    SymplecticEuler, Yoshida6, Yoshida8,
};
pub use taylor::{Taylor, Taylor24};
