//! Splitting methods of higher order, as tables of kicks and drifts.

use crate::integrate::Method;
use crate::systems::Separable;

/// A splitting method as data: kicks and drifts alternate, a kick first and a kick last.
///
/// The first kick of a step needs the force that the last kick of the step before has just
/// evaluated, so the two are merged into one. A step thus costs as many evaluations as it has
/// drifts. Where both are 0, the method begins and ends with a drift: then those two are merged,
/// and a step costs as many evaluations as it has kicks that are not 0.
///
/// ```
/// use pendula::methods::Splitting;
/// use pendula::metrics::EnergyDrift;
/// use pendula::{Grid, Pendulum, Phase, StormerVerlet, integrate_with};
///
/// /// McLachlan's method of order 2, whose coefficient a makes its error small.
/// struct McLachlan2;
/// const A: f64 = 0.193_183_327_503_783_6;
///
/// impl Splitting for McLachlan2 {
///     const KICKS: &'static [f64] = &[A, 1.0 - 2.0 * A, A];
///     const DRIFTS: &'static [f64] = &[0.5, 0.5];
/// }
///
/// // Beside Störmer–Verlet with half the step, which costs as much.
/// let (pendulum, start) = (Pendulum::PAPER, Phase::at_rest(1.0));
/// let mut drifts = [EnergyDrift::new(&pendulum), EnergyDrift::new(&pendulum)];
/// let [one, other] = [Grid::with_duration(0.02, 100.0)?, Grid::with_duration(0.01, 100.0)?];
/// integrate_with(&pendulum, &McLachlan2, start, &one, &mut drifts[0]);
/// integrate_with(&pendulum, &StormerVerlet, start, &other, &mut drifts[1]);
/// assert!(drifts[0].largest() < drifts[1].largest());
/// # Ok::<(), pendula::Error>(())
/// ```
pub trait Splitting {
    /// The kicks, in units of the step: one more than there are drifts. Where the method begins
    /// with a drift, the first is 0, and where it ends with one, the last.
    const KICKS: &'static [f64];
    /// The drifts, in units of the step.
    const DRIFTS: &'static [f64];
}

/// The kicks and drifts of a [`Splitting`] as a value: in lanes, all of them share the code that
/// takes its steps.
#[derive(Clone, Copy, Debug)]
pub(crate) struct KicksAndDrifts {
    kicks: &'static [f64],
    drifts: &'static [f64],
}

impl KicksAndDrifts {
    /// Those of the method `M`.
    pub(crate) const fn of<M: Splitting>() -> Self {
        assert!(!M::DRIFTS.is_empty(), "a splitting method has a drift at least");
        assert!(M::KICKS.len() == M::DRIFTS.len() + 1, "one kick more than drifts");
        Self { kicks: M::KICKS, drifts: M::DRIFTS }
    }

    /// Whether the method begins and ends with a drift.
    const fn drifts_first(&self) -> bool {
        self.kicks[0] == 0.0 && self.kicks[self.drifts.len()] == 0.0
    }

    /// A step of a method that begins and ends with a drift, from and to one drift `ahead`.
    #[inline(always)]
    fn step_from_a_drift<S: Separable>(
        &self,
        system: &S,
        t: f64,
        h: f64,
        ahead: &mut S::State,
    ) -> S::State {
        let Self { kicks, drifts } = *self;
        let last = drifts.len() - 1;
        let (mut z, mut elapsed) = (*ahead, 0.0);
        for i in 0..last {
            elapsed += drifts[i];
            z = system.kick(z, system.force(t + elapsed * h, z), kicks[i + 1] * h);
            if i + 1 < last {
                z = system.drift(z, drifts[i + 1] * h);
            }
        }
        *ahead = system.drift(z, (drifts[last] + drifts[0]) * h);
        system.drift(z, drifts[last] * h)
    }
}

// ANCHOR: step
impl<S: Separable> Method<S> for KicksAndDrifts {
    /// The state one kick ahead, or one drift where a drift comes first.
    type Carry = S::State;

    #[inline(always)]
    fn start(&self, system: &S, t: f64, h: f64, z: S::State) -> S::State {
        if self.drifts_first() {
            return system.drift(z, self.drifts[0] * h);
        }
        system.kick(z, system.force(t, z), self.kicks[0] * h)
    }

    #[inline(always)]
    fn step(&self, system: &S, t: f64, h: f64, _z: S::State, ahead: &mut S::State) -> S::State {
        let Self { kicks, drifts } = *self;
        let last = drifts.len() - 1;
        let (mut z, mut elapsed) = (*ahead, 0.0);
        if self.drifts_first() {
            return self.step_from_a_drift(system, t, h, ahead);
        }
        for i in 0..last {
            z = system.drift(z, drifts[i] * h);
            elapsed += drifts[i];
            z = system.kick(z, system.force(t + elapsed * h, z), kicks[i + 1] * h);
        }
        z = system.drift(z, drifts[last] * h);
        let force = system.force(t + h, z);
        *ahead = system.kick(z, force, (kicks[last + 1] + kicks[0]) * h);
        system.kick(z, force, kicks[last + 1] * h)
    }
}
// ANCHOR_END: step

// A type that is no method is told to become one, and not to become a table.
#[diagnostic::do_not_recommend]
impl<M: Splitting, S: Separable> Method<S> for M {
    type Carry = S::State;

    const REACH: f64 = length(M::KICKS).max(length(M::DRIFTS));

    #[inline(always)]
    fn start(&self, system: &S, t: f64, h: f64, z: S::State) -> S::State {
        KicksAndDrifts::of::<M>().start(system, t, h, z)
    }

    #[inline(always)]
    fn step(&self, system: &S, t: f64, h: f64, z: S::State, ahead: &mut S::State) -> S::State {
        const { KicksAndDrifts::of::<M>() }.step(system, t, h, z, ahead)
    }
}

/// The sum of the absolute values, Σ |x|.
pub const fn length(all: &[f64]) -> f64 {
    let (mut sum, mut i) = (0.0, 0);
    while i < all.len() {
        sum += all[i].abs();
        i += 1;
    }
    sum
}

/// The kicks of a composition of Störmer–Verlet steps: the two half kicks between two drifts are
/// merged into one, and the outermost are half kicks. The drifts are the substeps themselves.
pub const fn kicks<const N: usize, const KICKS: usize>(substeps: [f64; N]) -> [f64; KICKS] {
    assert!(KICKS == N + 1);
    let mut kicks = [0.0; KICKS];
    let mut i = 0;
    while i < N {
        kicks[i] += 0.5 * substeps[i];
        kicks[i + 1] += 0.5 * substeps[i];
        i += 1;
    }
    kicks
}

/// A palindrome from its first half and its middle.
pub(crate) const fn palindrome<const HALF: usize, const N: usize>(
    half: [f64; HALF],
    middle: f64,
) -> [f64; N] {
    assert!(N == 2 * HALF + 1);
    let mut all = [middle; N];
    let mut i = 0;
    while i < HALF {
        all[i] = half[i];
        all[N - 1 - i] = half[i];
        i += 1;
    }
    all
}
