//! A method that estimates its own error, chosen at run time.

use super::Tolerance;
use super::controlled::{ChoosesSteps, Controlled, Times};
use crate::methods::runge_kutta::Interpolant;
use crate::methods::{Dop853, DormandPrince, Info, MethodInfo};
use crate::systems::{Components, Counting, System};

/// A method of the library that estimates its own error, chosen at run time: for
/// [`Adaptive`](super::Adaptive), in all that it does, with the bits of the method itself.
///
/// ```
/// use pendula::adaptive::{Adaptive, AnyEmbedded, Tolerance};
/// use pendula::{Pendulum, Phase};
///
/// let method = AnyEmbedded::named("RK45").expect("Dormand–Prince, by its name in SciPy");
/// let adaptive = Adaptive::new(method, Tolerance::uniform(1e-9)?);
/// let (end, _) = adaptive.integrate(&Pendulum::PAPER, Phase::at_rest(1.0), 0.0, 10.0)?;
/// assert!(end.theta.abs() < 1.0);
/// // It has no estimate of its error.
/// assert!(AnyEmbedded::named("rk4").is_none());
/// # Ok::<(), pendula::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum AnyEmbedded {
    /// [`DormandPrince`].
    DormandPrince,
    /// [`Dop853`].
    Dop853,
}

impl AnyEmbedded {
    /// All of them.
    pub const ALL: &[Self] = &[Self::DormandPrince, Self::Dop853];

    /// The method [called](MethodInfo::is_called) so; none if there is no such method, or if it
    /// does not estimate its error.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|method| method.info().is_called(name))
    }
}

impl Info for AnyEmbedded {
    fn info(&self) -> MethodInfo {
        match self {
            Self::DormandPrince => DormandPrince.info(),
            Self::Dop853 => Dop853.info(),
        }
    }
}

impl ChoosesSteps for AnyEmbedded {}

/// What the two methods share: of all that they keep from step to step, nothing is their own.
type Memory<S> = <Dop853 as Controlled<S>>::Memory;

impl<S: System<State: Components>> Controlled<S> for AnyEmbedded {
    type Memory = Memory<S>;
    type Record =
        Either<<DormandPrince as Controlled<S>>::Record, <Dop853 as Controlled<S>>::Record>;
    type Dense = Either<<DormandPrince as Controlled<S>>::Dense, <Dop853 as Controlled<S>>::Dense>;

    fn begin(
        &self,
        system: &Counting<&S>,
        tolerance: &Tolerance<'_>,
        t: f64,
        z: S::State,
        duration: f64,
        first: Option<f64>,
    ) -> Memory<S> {
        match self {
            Self::DormandPrince => DormandPrince.begin(system, tolerance, t, z, duration, first),
            Self::Dop853 => Dop853.begin(system, tolerance, t, z, duration, first),
        }
    }

    fn propose(
        &self,
        system: &Counting<&S>,
        tolerance: &Tolerance<'_>,
        memory: &mut Memory<S>,
        t: f64,
        z: S::State,
    ) -> f64 {
        match self {
            Self::DormandPrince => DormandPrince.propose(system, tolerance, memory, t, z),
            Self::Dop853 => Dop853.propose(system, tolerance, memory, t, z),
        }
    }

    fn attempt_step(
        &self,
        system: &Counting<&S>,
        tolerance: &Tolerance<'_>,
        memory: &mut Memory<S>,
        times: Times,
        z: S::State,
    ) -> Option<(S::State, Self::Record)> {
        match self {
            Self::DormandPrince => DormandPrince
                .attempt_step(system, tolerance, memory, times, z)
                .map(|(end, record)| (end, Either::DormandPrince(record))),
            Self::Dop853 => Dop853
                .attempt_step(system, tolerance, memory, times, z)
                .map(|(end, record)| (end, Either::Dop853(record))),
        }
    }

    fn interpolant(
        &self,
        system: &Counting<&S>,
        tolerance: &Tolerance<'_>,
        memory: &Memory<S>,
        times: Times,
        z: S::State,
        record: &Self::Record,
    ) -> Self::Dense {
        match record {
            Either::DormandPrince(record) => Either::DormandPrince(
                DormandPrince.interpolant(system, tolerance, memory, times, z, record),
            ),
            Either::Dop853(record) => {
                Either::Dop853(Dop853.interpolant(system, tolerance, memory, times, z, record))
            }
        }
    }
}

/// What belongs to the one or to the other method.
#[derive(Clone, Copy, Debug)]
pub enum Either<A, B> {
    /// To Dormand–Prince.
    DormandPrince(A),
    /// To DOP853.
    Dop853(B),
}

impl<D, A: Interpolant<D>, B: Interpolant<D>> Interpolant<D> for Either<A, B> {
    fn displacement(&self, s: f64) -> Option<D> {
        match self {
            Self::DormandPrince(a) => a.displacement(s),
            Self::Dop853(b) => b.displacement(s),
        }
    }
}
