//! What a method is, and [`METHODS`], the one list from which tests, tables, benches and book all follow.

use core::fmt;

use crate::grid::Grid;
use crate::integrate::integrate;
use crate::observe::Observer;
use crate::pendulum::Pendulum;
use crate::phase::Phase;
use crate::system::{Counting, System};

// ANCHOR: method
/// A one-step method for the system `S`: an immutable value that maps a state to the state one step later.
///
/// Runge–Kutta methods implement it for every [`System`], splitting methods for every
/// [`Separable`](crate::Separable) one.
pub trait Method<S: System> {
    /// What one step hands to the next: `()`, or the last force. It belongs to the time loop, not to the method.
    type Memo;

    /// Prepares the memo for a trajectory that begins at `z` at time `t` (s).
    fn start(&self, system: &S, t: f64, z: S::State) -> Self::Memo;

    /// The state one step `h` (s) after `z` at time `t` (s).
    fn step(&self, system: &S, t: f64, h: f64, z: S::State, memo: &mut Self::Memo) -> S::State;
}
// ANCHOR_END: method

/// What is known of a method. It stands once, beside the method's step, and every test, table and page reads it there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Properties {
    /// Name on the command line and in test names.
    pub name: &'static str,
    /// Name in tables and text.
    pub title: &'static str,
    /// Other names in use for the same method.
    pub aliases: &'static [&'static str],
    /// Order p: the global error of the state is O(hᵖ).
    pub order: u32,
    /// Whether one step preserves area in phase space for every Hamiltonian system.
    pub symplectic: bool,
    /// Whether a step with −h undoes a step with h.
    pub symmetric: bool,
    /// Force evaluations a step.
    pub force_evaluations: u64,
    /// Force evaluations once, before the first step.
    pub start_evaluations: u64,
    /// Where the method is defined and analysed.
    pub reference: &'static str,
}

/// A method that can say what is known of it.
pub trait Described {
    /// The method's entry.
    fn properties(&self) -> Properties;
}

/// A method whose type is forgotten, so that a list can hold it: what tables, book and command line run over.
///
/// Every [`Described`] method of the pendulum is one. The step within is compiled for its method; only the observer is
/// called through a pointer.
pub trait AnyMethod: Described + Sync {
    /// [`integrate()`], for the pendulum.
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
    M: Described + Method<Pendulum> + Method<Counting<Pendulum>> + Sync,
{
    fn run(
        &self,
        pendulum: &Pendulum,
        start: Phase,
        grid: &Grid,
        observer: &mut dyn Observer<Phase>,
    ) -> Phase {
        integrate(pendulum, self, start, grid, observer)
    }

    fn count_evaluations(&self, pendulum: &Pendulum, start: Phase, grid: &Grid) -> u64 {
        let counting = Counting::new(*pendulum);
        integrate(&counting, self, start, grid, &mut ());
        counting.evaluations()
    }
}

impl fmt::Debug for dyn AnyMethod {
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

/// The method of that [name](Properties::name).
pub fn method_named(name: &str) -> Option<&'static dyn AnyMethod> {
    METHODS.iter().copied().find(|method| method.properties().name == name)
}
