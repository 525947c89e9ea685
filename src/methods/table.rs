//! The steps of every method of the library, compiled once: in lanes, and on systems beyond the
//! pendulum. With the feature `table`.
//!
//! A program that names a method by its type compiles the steps that it takes, and in lanes that is
//! seconds a method. Here they are compiled with the library, behind pointers, for whoever chooses
//! the method by its name.
//!
//! ```
//! use pendula::methods::table::in_lanes;
//! use pendula::{Ensemble, Grid, Pendulum, Phase};
//!
//! let starts = [0.1, 0.2, 0.3].map(Phase::at_rest);
//! let mut ends = [Phase::default(); 3];
//! let grid = Grid::with_duration(0.01, 10.0)?;
//! let method = in_lanes("blanes-moan-6").expect("a method of the library");
//! Ensemble::new(&Pendulum::PAPER, &starts, grid).ends(method, &mut ends);
//! # Ok::<(), pendula::Error>(())
//! ```

use core::marker::PhantomData;

use crate::fast::{ByItsTable, DoubleInLanes, InLanes};
use crate::for_each_method;
use crate::integrate::Steps;
use crate::methods::{Info, Rk4, Splitting};
use crate::systems::{
    Compensated, Damped, DoublePendulum, Driven, Numbers, Pendulum, Shaken, System,
};

/// RK4, for the first flips of double pendulums.
#[doc(hidden)]
pub static RK4_IN_LANES: &dyn DoubleInLanes = &Rk4;

/// A system for which the library has the steps of its methods compiled.
pub trait Listed: System<State: Numbers> + Copy + 'static {
    /// The steps of the method of that [name](super::MethodInfo::name); none if there is no such
    /// method, or if it needs more of a system than this one has.
    fn steps(method: &str) -> Option<&'static dyn Steps<Self>>;
}

/// A method, asked for more than it has in common with all others. The compiler prefers what holds
/// for the method itself ([`Suits`], [`HasTable`]) to what holds for a reference to it
/// ([`SuitsNot`], [`HasNone`]), so that the types say what a method is, and no list could be wrong.
struct Asked<M: 'static, S>(&'static M, PhantomData<S>);

/// A method that steps the system `S`.
trait Suits<S: System> {
    fn steps(&self) -> Option<&'static dyn Steps<S>>;
}

impl<S: System, M: Steps<S>> Suits<S> for Asked<M, S> {
    fn steps(&self) -> Option<&'static dyn Steps<S>> {
        Some(self.0)
    }
}

trait SuitsNot<S: System> {
    fn steps(&self) -> Option<&'static dyn Steps<S>> {
        None
    }
}

impl<M, S: System> SuitsNot<S> for &Asked<M, S> {}

/// A method that is a table of kicks and drifts.
trait HasTable {
    fn in_lanes(&self) -> &'static dyn InLanes;
}

impl<M: Splitting + InLanes> HasTable for Asked<ByItsTable<M>, ()> {
    fn in_lanes(&self) -> &'static dyn InLanes {
        // In short tables a fifth of the time would go to reading them.
        if const { M::KICKS.len() > 5 } { self.0 } else { &self.0.0 }
    }
}

trait HasNone {
    fn in_lanes(&self) -> &'static dyn InLanes;
}

impl<M: InLanes> HasNone for &Asked<ByItsTable<M>, ()> {
    fn in_lanes(&self) -> &'static dyn InLanes {
        &self.0.0
    }
}

macro_rules! listed {
    ([$($method:ident)+]) => {};
    ([$($method:ident)+] $System:ty, $($more:tt)*) => {
        impl Listed for $System {
            fn steps(method: &str) -> Option<&'static dyn Steps<Self>> {
                $(if method == super::$method.info().name {
                    return (&Asked(&super::$method, PhantomData::<Self>)).steps();
                })+
                None
            }
        }

        listed! { [$($method)+] $($more)* }
    };
}

macro_rules! table {
    ($($module:ident::$method:ident,)+) => {
        /// The steps in lanes of the method of that [name](super::MethodInfo::name).
        pub fn in_lanes(method: &str) -> Option<&'static dyn InLanes> {
            $(if method == super::$method.info().name {
                static METHOD: ByItsTable<super::$method> = ByItsTable(super::$method);
                return Some((&Asked(&METHOD, PhantomData::<()>)).in_lanes());
            })+
            None
        }

        listed! {
            [$($method)+] Damped, Driven, Shaken, DoublePendulum, Compensated<Pendulum>,
        }
    };
}
for_each_method!(table);
