//! [`METHODS`], the one list from which tests, tables, benches and book all follow.

use core::fmt;

use crate::grid::Grid;
use crate::integrate::integrate;
use crate::method::{Described, Method};
use crate::observe::Observer;
use crate::pendulum::Pendulum;
use crate::phase::Phase;
use crate::stepped::Stepped;
use crate::swing::swing;
use crate::system::Counting;

/// A method whose type is forgotten, so that a list can hold it: what tables, book and command line run over.
///
/// Every [`Described`] method of the pendulum is one. The step within is compiled for its method; only the observer is
/// called through a pointer.
pub trait AnyMethod: Described + Sync {
    /// [`swing()`].
    fn run(
        &self,
        pendulum: &Pendulum,
        start: Phase,
        grid: &Grid,
        observer: &mut dyn Observer<Phase>,
    ) -> Phase;

    /// Force evaluations counted, not declared, over the whole of `grid`.
    fn count_evaluations(&self, pendulum: &Pendulum, start: Phase, grid: &Grid) -> u64;
}

impl<M> AnyMethod for M
where
    M: Described + Method<Pendulum> + Method<Stepped> + Method<Counting<Pendulum>> + Sync,
{
    fn run(
        &self,
        pendulum: &Pendulum,
        start: Phase,
        grid: &Grid,
        observer: &mut dyn Observer<Phase>,
    ) -> Phase {
        swing(pendulum, self, start, grid, observer)
    }

    fn count_evaluations(&self, pendulum: &Pendulum, start: Phase, grid: &Grid) -> u64 {
        let counting = Counting::new(*pendulum);
        integrate(&counting, self, start, grid, &mut ());
        counting.evaluations()
    }
}

impl fmt::Debug for dyn AnyMethod + '_ {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.properties().name)
    }
}

/// Hands the list of methods to the macro `$then`, as `module::Method` pairs in the order of the paper's tables.
///
/// This is the list. [`METHODS`] is made from it, and so is every test that runs over all methods with their types
/// known.
#[macro_export]
macro_rules! methods {
    ($then:ident) => {
        $then! {
            forward_euler::ForwardEuler,
            symplectic_euler::SymplecticEuler,
            rk4::Rk4,
            stormer_verlet::StormerVerlet,
        }
    };
}

macro_rules! collect {
    ($($module:ident::$method:ident,)+) => {
        /// Every method of the library, in the order of the paper's tables.
        pub static METHODS: &[&dyn AnyMethod] = &[$(&$crate::methods::$module::$method,)+];
    };
}
methods!(collect);

/// The method of that [name](crate::method::Properties::name).
pub fn method_named(name: &str) -> Option<&'static dyn AnyMethod> {
    METHODS.iter().copied().find(|method| method.properties().name == name)
}
