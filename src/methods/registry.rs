//! [`METHODS`], the one list from which tests, tables, benches and book all follow.

use core::fmt;

use crate::fast::{Stepped, swing};
use crate::integrate::{Grid, Method, Observer, integrate};
use crate::methods::Described;
use crate::systems::{Counting, Pendulum, Phase};

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

    /// The last state alone. Nobody watches, so that no step pays for it.
    fn end(&self, pendulum: &Pendulum, start: Phase, grid: &Grid) -> Phase {
        self.run(pendulum, start, grid, &mut ())
    }
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

    fn end(&self, pendulum: &Pendulum, start: Phase, grid: &Grid) -> Phase {
        swing(pendulum, self, start, grid, &mut ())
    }
}

impl fmt::Debug for dyn AnyMethod + '_ {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.properties().name)
    }
}

/// Hands the methods that suit every system, or every separable one, to the macro `$then`, as `module::Method` pairs:
/// the paper's four in the order of its tables, then the others. What else is given follows them.
#[macro_export]
macro_rules! general_methods {
    ($then:ident $(, $($more:tt)+)?) => {
        $then! {
            forward_euler::ForwardEuler,
            symplectic_euler::SymplecticEuler,
            rk4::Rk4,
            stormer_verlet::StormerVerlet,
            explicit_midpoint::ExplicitMidpoint,
            heun::Heun,
            position_verlet::PositionVerlet,
            ruth_3::Ruth3,
            forest_ruth::ForestRuth,
            suzuki_4::Suzuki4,
            blanes_moan_4::BlanesMoan4,
            yoshida_6::Yoshida6,
            blanes_moan_6::BlanesMoan6,
            yoshida_8::Yoshida8,
            kahan_li_8::KahanLi8,
            dormand_prince::DormandPrince,
            dop853::Dop853,
            implicit_midpoint::ImplicitMidpoint,
            gauss_4::Gauss4,
            gauss_6::Gauss6,
            gauss_16::Gauss16,
            $($($more)+)?
        }
    };
}

/// Hands the list of methods to the macro `$then`: the [general ones](general_methods), and those that ask more of a
/// system.
///
/// This is the list. [`METHODS`] is made from it, and so is every test that runs over all methods with their types
/// known.
#[macro_export]
macro_rules! methods {
    ($then:ident) => {
        $crate::general_methods! { $then, taylor_24::Taylor24, }
    };
}

macro_rules! collect {
    ($($module:ident::$method:ident,)+) => {
        /// Every method of the library, in the order of the paper's tables.
        pub static METHODS: &[&dyn AnyMethod] = &[$(&$crate::methods::$method,)+];
    };
}
methods!(collect);

/// The method of that [name](Properties::name).
pub fn method_named(name: &str) -> Option<&'static dyn AnyMethod> {
    METHODS.iter().copied().find(|method| method.properties().name == name)
}
