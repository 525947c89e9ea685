//! [`METHODS`], the one list from which tests, tables, benches and book all follow.

use core::fmt;

#[cfg(feature = "ensemble")]
use crate::ensemble::{Ensemble, InLanes};
use crate::grid::Grid;
use crate::integrate::integrate;
use crate::method::{Described, Method};
use crate::metrics::EnergyDrift;
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

    /// The last state alone. Nobody watches, so that no step pays for it.
    fn end(&self, pendulum: &Pendulum, start: Phase, grid: &Grid) -> Phase {
        self.run(pendulum, start, grid, &mut ())
    }

    /// The largest energy error and the last state from each of `starts`, into `drifts` and `ends`: a slot of both for
    /// each start. With the feature `ensemble` the steps are taken in lanes, with the same bits.
    ///
    /// # Panics
    /// If there are not as many slots as starts.
    fn drift_each(
        &self,
        pendulum: &Pendulum,
        starts: &[Phase],
        grid: &Grid,
        drifts: &mut [EnergyDrift<'_, Pendulum>],
        ends: &mut [Phase],
    ) {
        assert_slots(starts, drifts, ends);
        for ((start, drift), end) in starts.iter().zip(drifts).zip(ends) {
            *end = self.run(pendulum, *start, grid, drift);
        }
    }
}

fn assert_slots<D>(starts: &[Phase], drifts: &[D], ends: &[Phase]) {
    assert!(starts.len() == drifts.len() && starts.len() == ends.len(), "two slots for each start");
}

/// What a list of methods needs beside the steps of one trajectory: steps in lanes, where there are any.
#[cfg(feature = "ensemble")]
use InLanes as Laned;

#[cfg(not(feature = "ensemble"))]
mod laned {
    /// Nothing.
    pub trait Laned {}

    impl<M> Laned for M {}
}
#[cfg(not(feature = "ensemble"))]
use laned::Laned;

impl<M> AnyMethod for M
where
    M: Described + Method<Pendulum> + Method<Stepped> + Method<Counting<Pendulum>> + Laned + Sync,
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

    #[cfg(feature = "ensemble")]
    fn drift_each(
        &self,
        pendulum: &Pendulum,
        starts: &[Phase],
        grid: &Grid,
        drifts: &mut [EnergyDrift<'_, Pendulum>],
        ends: &mut [Phase],
    ) {
        assert_slots(starts, drifts, ends);
        let slots = drifts.iter_mut().zip(ends);
        let mut watches: Vec<_> = slots.map(|(drift, end)| DriftAndEnd { drift, end }).collect();
        let ensemble = Ensemble::of(pendulum, starts, *grid);
        ensemble.watch(core::num::NonZeroU64::MIN, self, &mut watches);
    }
}

/// Watches the energy, and keeps the state seen last.
#[cfg(feature = "ensemble")]
struct DriftAndEnd<'a, 'p> {
    drift: &'a mut EnergyDrift<'p, Pendulum>,
    end: &'a mut Phase,
}

#[cfg(feature = "ensemble")]
impl Observer<Phase> for DriftAndEnd<'_, '_> {
    #[inline]
    fn observe(&mut self, n: u64, t: f64, z: Phase) {
        self.drift.observe(n, t, z);
        *self.end = z;
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
        pub static METHODS: &[&dyn AnyMethod] = &[$(&$crate::methods::$module::$method,)+];
    };
}
methods!(collect);

/// The method of that [name](crate::method::Properties::name).
pub fn method_named(name: &str) -> Option<&'static dyn AnyMethod> {
    METHODS.iter().copied().find(|method| method.properties().name == name)
}
