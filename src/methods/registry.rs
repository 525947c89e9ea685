//! [`METHODS`], the one list that tests, tables, benches and book use.

use core::fmt;
use core::num::NonZeroU64;

use crate::error::Error;
use crate::fast::{FastRun, PendulumSteps};
use crate::integrate::{Grid, Observer, Run};
use crate::methods::Info;
use crate::systems::{Pendulum, Phase};

/// A type-erased method, so that a list can hold it, over which tables, book and command line
/// iterate.
///
/// Every [`Info`] method of the pendulum is one. Its [steps](PendulumSteps) are compiled for it,
/// and the rest once for all.
pub trait AnyMethod: Info + Sync {
    /// [`integrate_fast`](crate::integrate_fast()).
    fn run(
        &self,
        pendulum: &Pendulum,
        start: Phase,
        grid: &Grid,
        observer: &mut dyn Observer<Phase>,
    ) -> Phase;

    /// [`try_integrate_fast`](crate::try_integrate_fast).
    ///
    /// # Errors
    /// [`Error::NotSolved`] at a step of an implicit method whose iteration does not converge.
    fn try_run(
        &self,
        pendulum: &Pendulum,
        start: Phase,
        grid: &Grid,
        observer: &mut dyn Observer<Phase>,
    ) -> Result<Phase, Error> {
        Ok(self.run(pendulum, start, grid, observer))
    }

    /// Force evaluations counted, not declared, over the whole of `grid`.
    fn count_evaluations(&self, pendulum: &Pendulum, start: Phase, grid: &Grid) -> u64;

    /// The last state alone, without the cost of an observer.
    fn end(&self, pendulum: &Pendulum, start: Phase, grid: &Grid) -> Phase {
        self.run(pendulum, start, grid, &mut ())
    }

    /// Its steps, for a [`FastRun`]; none of a method that is known by its runs alone.
    fn steps(&self) -> Option<&dyn PendulumSteps> {
        None
    }
}

impl<M: Info + PendulumSteps> AnyMethod for M {
    fn run(
        &self,
        pendulum: &Pendulum,
        start: Phase,
        grid: &Grid,
        observer: &mut dyn Observer<Phase>,
    ) -> Phase {
        FastRun::start(pendulum, self, start, grid).to_end(start, NonZeroU64::MIN, observer)
    }

    fn try_run(
        &self,
        pendulum: &Pendulum,
        start: Phase,
        grid: &Grid,
        observer: &mut dyn Observer<Phase>,
    ) -> Result<Phase, Error> {
        observer.observe(0, 0.0, start);
        if grid.steps() == 0 || observer.is_satisfied() {
            return Ok(start);
        }
        let mut run = FastRun::start(pendulum, self, start, grid);
        run.advance(grid.steps(), NonZeroU64::MIN, observer)
    }

    fn count_evaluations(&self, pendulum: &Pendulum, start: Phase, grid: &Grid) -> u64 {
        let mut run = Run::start(pendulum, self, start, grid);
        // Whether it comes to the end or not: what it has cost is counted.
        let _ = run.advance(grid.steps(), NonZeroU64::MAX, &mut ());
        run.evaluations()
    }

    fn end(&self, pendulum: &Pendulum, start: Phase, grid: &Grid) -> Phase {
        FastRun::start(pendulum, self, start, grid).to_end(start, NonZeroU64::MAX, &mut ())
    }

    fn steps(&self) -> Option<&dyn PendulumSteps> {
        Some(self)
    }
}

impl fmt::Debug for dyn AnyMethod + '_ {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.info().name)
    }
}

/// Passes the methods for every system, or every separable one, to the macro `$then`, as
/// `module::Method` pairs: the paper's four in the order of its tables, then the others. Further
/// arguments follow them.
#[macro_export]
#[doc(hidden)]
macro_rules! for_each_general_method {
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
            trapezoidal::Trapezoidal,
            gauss_4::Gauss4,
            gauss_6::Gauss6,
            gauss_16::Gauss16,
            $($($more)+)?
        }
    };
}

/// Passes the list of methods to the macro `$then`: the [general ones](for_each_general_method),
/// and those that need more of a system. Further arguments follow them.
///
/// This is the list. [`METHODS`] is made from it, and so is every test that needs the type of each
/// method.
#[macro_export]
#[doc(hidden)]
macro_rules! for_each_method {
    ($then:ident $(, $($more:tt)+)?) => {
        $crate::for_each_general_method! {
            $then,
            discrete_gradient::DiscreteGradient,
            cieslinski_ratkiewicz::CieslinskiRatkiewicz,
            deuflhard::Deuflhard,
            processed_4::Processed4,
            processed_6::Processed6,
            taylor_24::Taylor24,
            $($($more)+)?
        }
    };
}

macro_rules! collect {
    ($($module:ident::$method:ident,)+) => {
        /// Every method of the library: the paper's four in the order of its tables, then the
        /// others.
        pub static METHODS: &[&dyn AnyMethod] = &[$(&$crate::methods::$method,)+];
    };
}
for_each_method!(collect);

/// The method of that [name](super::MethodInfo::name).
pub fn method_named(name: &str) -> Option<&'static dyn AnyMethod> {
    METHODS.iter().copied().find(|method| method.info().name == name)
}
