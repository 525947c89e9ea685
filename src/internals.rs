//! What the tests, the benches and the book of the repository look at inside the library. It is no
//! part of the interface, and may change at any time.

pub use crate::adaptive::control::Controller;
pub use crate::adaptive::series::order;
#[cfg(feature = "ensemble")]
pub use crate::arithmetic::lanes::{Lanes, Pair};
pub use crate::arithmetic::number::{Apart, Many, Mask, Number, OfF64, Two};
pub use crate::arithmetic::rough::{exp2, log2};
pub use crate::exact::elliptic::{arithmetic_geometric_mean, carlson_rf};
#[cfg(feature = "ensemble")]
pub use crate::fast::block::LANES;
pub use crate::fast::deferred::Deferred;
pub use crate::fast::scaled::{ReducedPhase, ReducedRate, ScaledPendulum};
#[cfg(feature = "alloc")]
pub use crate::registry::names::in_seconds;
pub use crate::systems::pendulum::energy_in_lanes;

/// Double-double numbers.
pub mod double_double {
    pub use crate::arithmetic::double_double::*;
}

/// The sines.
pub mod sine {
    pub use crate::arithmetic::sine::{C, S, sin_and_cos_within};

    /// That of the time loops.
    pub mod half_turn {
        pub use crate::arithmetic::sine::half_turn::*;
    }
}

/// The Runge–Kutta methods that are given as a tableau.
pub mod runge_kutta {
    pub use crate::methods::runge_kutta::tableau::{Coefficient, Row, Tableau};

    /// DOP853.
    pub mod dop853 {
        pub use crate::methods::runge_kutta::dop853::*;
    }

    /// Dormand–Prince.
    pub mod dormand_prince {
        pub use crate::methods::runge_kutta::dormand_prince::*;
    }
}

/// The coefficients of the processed methods.
pub mod processed {
    /// Those of order 4.
    pub mod processed_4 {
        pub use crate::methods::processed::processed_4::{GRADIENT, PROCESSOR};
    }

    /// Those of order 6.
    pub mod processed_6 {
        pub use crate::methods::processed::processed_6::{DRIFT, GRADIENT, KICK, PROCESSOR};
    }
}
