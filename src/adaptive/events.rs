//! Events: when a function of the state crosses zero.

use super::controlled::Controlled;
use super::steps::{AdaptiveSteps, DenseOf};
use crate::error::Error;
use crate::systems::{Components, System};

/// Which changes of sign count as crossings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Direction {
    /// From below zero to zero or above, in the order of the steps.
    Rising,
    /// From above zero to zero or below.
    Falling,
    /// Both.
    Either,
}

impl Direction {
    /// Whether a function with the value `before`, and then `after`, has crossed zero in this
    /// direction. A function that begins at zero does not cross it there.
    fn crossed(self, before: f64, after: f64) -> bool {
        let rising = before < 0.0 && after >= 0.0;
        let falling = before > 0.0 && after <= 0.0;
        match self {
            Self::Rising => rising,
            Self::Falling => falling,
            Self::Either => rising || falling,
        }
    }
}

/// When a function crossed zero, and where the system was.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Crossing<Z> {
    /// The time t (s).
    pub t: f64,
    /// The state.
    pub z: Z,
}

/// Points of a step at which the sign is checked: two zeros closer together than an eighth of a
/// step can hide each other.
const LOOKS: u32 = 8;

/// An iterator over the crossings in a sequence of steps: see [`AdaptiveSteps::crossings`].
pub struct Crossings<'w, 'a, S: System<State: Components>, M: Controlled<S>, G> {
    walk: &'w mut AdaptiveSteps<'a, S, M>,
    direction: Direction,
    g: G,
    /// The present step, and at how many points its sign has been checked.
    step: Option<(DenseOf<S, M>, u32)>,
    /// The value of the function at the last of these points.
    value: f64,
}

impl<'a, S, M> AdaptiveSteps<'a, S, M>
where
    S: System<State: Components>,
    M: Controlled<S>,
{
    /// An iterator over the crossings from here on: the times (s) and states at which the function
    /// `g` of time and state changes sign in the `direction`.
    ///
    /// Within a step they are found on its dense output. Two zeros that lie closer than an eighth
    /// of a step can hide each other.
    pub fn crossings<G>(&mut self, direction: Direction, g: G) -> Crossings<'_, 'a, S, M, G>
    where
        G: FnMut(f64, S::State) -> f64,
    {
        Crossings::new(self, direction, g)
    }
}

impl<'w, 'a, S, M, G> Crossings<'w, 'a, S, M, G>
where
    S: System<State: Components>,
    M: Controlled<S>,
    G: FnMut(f64, S::State) -> f64,
{
    pub(super) fn new(
        walk: &'w mut AdaptiveSteps<'a, S, M>,
        direction: Direction,
        mut g: G,
    ) -> Self {
        let value = g(walk.time(), walk.state());
        Self { walk, direction, g, step: None, value }
    }

    /// The next crossing within the present step.
    fn within_step(&mut self) -> Option<Crossing<S::State>> {
        while let Some((dense, looks)) = self.step {
            if looks == LOOKS {
                self.step = None;
                break;
            }
            let part = |looks| f64::from(looks) / f64::from(LOOKS);
            let (low, high) = (part(looks), part(looks + 1));
            let before = self.value;
            self.value = (self.g)(dense.time(high), dense.after(high));
            self.step = Some((dense, looks + 1));
            if self.direction.crossed(before, self.value) {
                return Some(self.bisect(dense, before, low, high));
            }
        }
        None
    }

    // ANCHOR: bisect
    /// The crossing between the fractions `low` and `high` of a step, by bisection until no f64
    /// lies between; `before` is the function at `low`. Bisection is slow, but cannot fail, and
    /// evaluates no force.
    fn bisect(
        &mut self,
        dense: DenseOf<S, M>,
        before: f64,
        mut low: f64,
        mut high: f64,
    ) -> Crossing<S::State> {
        // 2⁻⁶⁴ of an eighth of a step is less than an ulp of any time in it but zero.
        for _ in 0..64 {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            let value = (self.g)(dense.time(middle), dense.after(middle));
            if Direction::Either.crossed(before, value) {
                high = middle;
            } else {
                low = middle;
            }
        }
        Crossing { t: dense.time(high), z: dense.after(high) }
    }
    // ANCHOR_END: bisect
}

impl<S, M, G> Iterator for Crossings<'_, '_, S, M, G>
where
    S: System<State: Components>,
    M: Controlled<S>,
    G: FnMut(f64, S::State) -> f64,
{
    type Item = Result<Crossing<S::State>, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            if let Some(crossing) = self.within_step() {
                return Some(Ok(crossing));
            }
            match self.walk.next()? {
                Ok(step) => self.step = Some((self.walk.dense(&step), 0)),
                Err(error) => return Some(Err(error)),
            }
        }
    }
}
