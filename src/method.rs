//! What a method is, and what is known of it.

use crate::system::System;

// ANCHOR: method
/// A one-step method for the system `S`: an immutable value that maps a state to the state one step later.
///
/// Runge–Kutta methods implement it for every [`System`], splitting methods for every
/// [`Separable`](crate::Separable) one.
pub trait Method<S: System> {
    /// What one step hands to the next: `()`, or what need not be computed again. It belongs to the time loop, not to
    /// the method.
    type Memo: Copy;

    /// How far one step may kick or drift, or one of its stages, in steps: the sum of the sizes of its coefficients, those
    /// backwards counted like those forwards. It bounds how far a run can turn. A series has no such bound; 1 holds where
    /// it converges.
    const REACH: f64 = 1.0;

    /// Prepares the memo for a trajectory of steps `h` (s) that begins at `z` at time `t` (s).
    fn start(&self, system: &S, t: f64, h: f64, z: S::State) -> Self::Memo;

    /// The state one step `h` (s) after `z` at time `t` (s). `memo` is the one that `start` or the last step left for
    /// this very `z`: a method may find all it needs there.
    ///
    /// Implementations are `#[inline(always)]`: in the time loop `h` and the system are known, and a call would hide it.
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
    /// Whether a step solves equations by iteration. It then takes as many evaluations as the iteration needs sweeps, and
    /// where the step is too long for it to converge, no component of the state is a number.
    pub implicit: bool,
    /// Force evaluations a step; of an implicit method, a sweep of its iteration, which one evaluation more begins.
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
