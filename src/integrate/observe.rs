//! Observers: what is measured along a trajectory. What is not observed costs nothing.

use core::num::NonZeroU64;

#[diagnostic::on_unimplemented(
    message = "`{Self}` does not observe states `{Z}`",
    note = "observers are `()`, a closure `|n: u64, t: f64, z: {Z}| …`, and tuples of observers"
)]
/// Receives every sample of a trajectory, the start included.
///
/// Observers are generic parameters of [`integrate`](crate::integrate()): `()` observes nothing and
/// leaves the bare loop, a closure `|n, t, z| …` is an observer, and a tuple combines several.
///
/// ```
/// use pendula::metrics::EnergyDrift;
/// use pendula::{Grid, Pendulum, Phase, StormerVerlet, integrate_with};
///
/// let (pendulum, grid) = (Pendulum::PAPER, Grid::with_duration(0.01, 10.0)?);
/// let mut turns = Vec::new();
/// let mut before = 0.0;
/// let note_turns = |_n: u64, t: f64, z: Phase| {
///     if before * z.omega < 0.0 {
///         turns.push(t);
///     }
///     before = z.omega;
/// };
/// let mut watch = (EnergyDrift::new(&pendulum), note_turns);
/// integrate_with(&pendulum, &StormerVerlet, Phase::at_rest(1.0), &grid, &mut watch);
/// assert!(watch.0.largest() < 1.1e-3);
/// // A swing takes 2.14 s, and turns twice.
/// assert_eq!(turns.len(), 9);
/// # Ok::<(), pendula::Error>(())
/// ```
pub trait Observer<Z> {
    /// Receives the state `z` after `n` steps, at time `t` (s).
    fn observe(&mut self, n: u64, t: f64, z: Z);

    /// Whether the observer needs no more samples. The time loop ends as soon as this is true; for
    /// most observers it never is.
    #[inline]
    fn is_satisfied(&self) -> bool {
        false
    }
}

impl<Z> Observer<Z> for () {
    #[inline]
    fn observe(&mut self, _n: u64, _t: f64, _z: Z) {}
}

impl<Z, F: FnMut(u64, f64, Z)> Observer<Z> for F {
    #[inline]
    fn observe(&mut self, n: u64, t: f64, z: Z) {
        self(n, t, z);
    }
}

macro_rules! tuple_observer {
    ($($name:ident)+) => {
        impl<Z: Copy, $($name: Observer<Z>),+> Observer<Z> for ($($name,)+) {
            #[inline]
            fn observe(&mut self, n: u64, t: f64, z: Z) {
                #[allow(non_snake_case)]
                let ($($name,)+) = self;
                $($name.observe(n, t, z);)+
            }

            #[inline]
            fn is_satisfied(&self) -> bool {
                #[allow(non_snake_case)]
                let ($($name,)+) = self;
                true $(&& $name.is_satisfied())+
            }
        }
    };
}
tuple_observer!(A B);
tuple_observer!(A B C);
tuple_observer!(A B C D);

/// Passes on every k-th sample, the start included.
#[derive(Clone, Debug)]
pub struct Every<O> {
    every: NonZeroU64,
    /// Samples to skip until the next one passed on.
    skip: u64,
    observer: O,
}

impl<O> Every<O> {
    /// Passes the samples 0, k, 2k, … to `observer`, where k is `every`.
    pub const fn new(every: NonZeroU64, observer: O) -> Self {
        Self { every, skip: 0, observer }
    }

    /// The inner observer, with its results.
    pub fn into_inner(self) -> O {
        self.observer
    }
}

impl<Z, O: Observer<Z>> Observer<Z> for Every<O> {
    #[inline]
    fn observe(&mut self, n: u64, t: f64, z: Z) {
        if self.skip == 0 {
            self.observer.observe(n, t, z);
            self.skip = self.every.get();
        }
        self.skip -= 1;
    }

    #[inline]
    fn is_satisfied(&self) -> bool {
        self.observer.is_satisfied()
    }
}

/// Writes the states, one after the other, into a slice of the caller.
#[derive(Debug)]
pub struct Record<'a, Z> {
    storage: core::slice::IterMut<'a, Z>,
}

impl<'a, Z> Record<'a, Z> {
    /// Records into `storage`: [`Grid::samples`](crate::Grid::samples) slots hold a whole
    /// trajectory. Samples beyond its end are dropped.
    pub fn new(storage: &'a mut [Z]) -> Self {
        Self { storage: storage.iter_mut() }
    }
}

impl<Z> Observer<Z> for Record<'_, Z> {
    #[inline]
    fn observe(&mut self, _n: u64, _t: f64, z: Z) {
        if let Some(slot) = self.storage.next() {
            *slot = z;
        }
    }
}
