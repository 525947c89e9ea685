//! [`METHODS`]: the methods on the pendulum.

use crate::fast;
#[cfg(feature = "table")]
use crate::fast::{ByItsTable, TakesBlocks};
use crate::for_each_method;
use crate::integrate::{Grid, Run};
use crate::methods::{Info, MethodInfo};
use crate::registry::AnyMethod;
use crate::systems::{Pendulum, Phase};

/// A method of the library on the pendulum, with the step as the unit of time.
struct Listed<M>(M);

impl<M: Info> Info for Listed<M> {
    fn info(&self) -> MethodInfo {
        self.0.info()
    }
}

/// The steps in lanes of a method. Of the long tables of kicks and drifts they are compiled once,
/// with coefficients that are read while they are taken; in short ones a fifth of the time would go
/// to reading them.
#[cfg(feature = "table")]
macro_rules! blocks {
    (Suzuki4, $method:expr) => { blocks!(by its table, $method) };
    (BlanesMoan6, $method:expr) => { blocks!(by its table, $method) };
    (BlanesMoanSrkn6b, $method:expr) => { blocks!(by its table, $method) };
    (BlanesMoanSrkn14a, $method:expr) => { blocks!(by its table, $method) };
    (Yoshida6, $method:expr) => { blocks!(by its table, $method) };
    (Yoshida8, $method:expr) => { blocks!(by its table, $method) };
    (KahanLi8, $method:expr) => { blocks!(by its table, $method) };
    (by its table, $method:expr) => { &const { ByItsTable($method) } };
    ($other:ident, $method:expr) => { &$method };
}

macro_rules! collect {
    ($($module:ident::$method:ident,)+) => {
        $(impl AnyMethod for Listed<crate::methods::$method> {
            fn begin(&self, pendulum: &Pendulum, start: Phase, grid: &Grid) -> Run<'_, Phase> {
                fast::begin(pendulum, &self.0, start, grid)
            }

            #[cfg(feature = "table")]
            fn blocks(&self) -> Option<&dyn TakesBlocks> {
                Some(blocks!($method, crate::methods::$method))
            }
        })+

        /// Every method of the library: the paper's four in the order of its tables, then the
        /// others.
        pub static METHODS: &[&dyn AnyMethod] = &[$(&Listed(crate::methods::$method),)+];
    };
}
for_each_method!(collect);
