//! What is read off a walk: when a function of the state crosses zero, and states at given times.

use super::controlled::Controlled;
use super::steps::{AdaptiveSteps, DenseOf, StepOf};
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
    pub fn crossings<G>(&mut self, direction: Direction, mut g: G) -> Crossings<'_, 'a, S, M, G>
    where
        G: FnMut(f64, S::State) -> f64,
    {
        let value = g(self.time(), self.state());
        Crossings { walk: self, direction, g, step: None, value }
    }
}

impl<S, M, G> Crossings<'_, '_, S, M, G>
where
    S: System<State: Components>,
    M: Controlled<S>,
    G: FnMut(f64, S::State) -> f64,
{
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

/// An iterator over the states at given times: see [`AdaptiveSteps::states_at`].
pub struct StatesAt<'w, 'a, S: System<State: Components>, M: Controlled<S>, I> {
    walk: &'w mut AdaptiveSteps<'a, S, M>,
    times: I,
    /// The last of the times (s).
    last: f64,
    /// The step to which the walk has gone on.
    step: Option<StepOf<S, M>>,
    /// Its dense output, if a time lies in it.
    dense: Option<DenseOf<S, M>>,
    failed: bool,
}

impl<'a, S: System<State: Components>, M: Controlled<S>> AdaptiveSteps<'a, S, M> {
    /// An iterator over the states at the `times` (s), which lie between here and the end of the
    /// walk, in its order. The walk takes the steps that it would take without them, and no more
    /// than they need; within a step a state is that of its dense output. Then it stands at the end
    /// of the step in which the last of them lies: a time before that is refused to a second call.
    /// Of a walk that has ended with an error there are no states.
    ///
    /// ```
    /// use pendula::adaptive::{Adaptive, Tolerance};
    /// use pendula::methods::Dop853;
    /// use pendula::{Motion, Pendulum, Phase};
    ///
    /// let (pendulum, start) = (Pendulum::PAPER, Phase::at_rest(3.0));
    /// let motion = Motion::new(&pendulum, start)?;
    /// let adaptive = Adaptive::new(Dop853, Tolerance::uniform(1e-12)?);
    /// let times = [0.0, 0.5, 1.0, 7.3];
    /// let mut walk = adaptive.steps(&pendulum, start, 0.0, 10.0)?;
    /// for (t, z) in times.into_iter().zip(walk.states_at(times)) {
    ///     assert!((z?.theta - motion.at(t).theta).abs() < 1e-9);
    /// }
    /// # Ok::<(), pendula::Error>(())
    /// ```
    ///
    /// It ends after an error: those of the steps, and [`Error::Parameter`] for a time before the
    /// one that precedes it, or beyond the end of the walk.
    pub fn states_at<I: IntoIterator<Item = f64>>(
        &mut self,
        times: I,
    ) -> StatesAt<'_, 'a, S, M, I::IntoIter> {
        let last = self.time();
        StatesAt {
            walk: self,
            times: times.into_iter(),
            last,
            step: None,
            dense: None,
            failed: false,
        }
    }
}

impl<S, M, I> StatesAt<'_, '_, S, M, I>
where
    S: System<State: Components>,
    M: Controlled<S>,
{
    /// The state at time `t` (s), or the error of the walk on its way there; none after an error
    /// that the walk has told before.
    fn state(&mut self, t: f64) -> Option<Result<S::State, Error>> {
        let (last, until) = (self.last, self.walk.end_time());
        if !(last.min(until)..=last.max(until)).contains(&t) {
            let allowed = "no earlier in the walk than the time before it, nor beyond its end";
            return Some(Err(Error::Parameter { name: "time of a state (s)", value: t, allowed }));
        }
        self.last = t;
        let is_ahead_of = |time: f64| if until < last { t < time } else { t > time };
        while is_ahead_of(self.walk.time()) {
            match self.walk.next()? {
                Ok(step) => (self.step, self.dense) = (Some(step), None),
                Err(error) => return Some(Err(error)),
            }
        }
        if t == self.walk.time() {
            return Some(Ok(self.walk.state()));
        }
        let step = self.step.as_ref()?;
        Some(Ok(self.dense.get_or_insert_with(|| self.walk.dense(step)).at(t)))
    }
}

impl<S, M, I> Iterator for StatesAt<'_, '_, S, M, I>
where
    S: System<State: Components>,
    M: Controlled<S>,
    I: Iterator<Item = f64>,
{
    type Item = Result<S::State, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.failed {
            return None;
        }
        let t = self.times.next()?;
        let state = self.state(t);
        self.failed = !matches!(state, Some(Ok(_)));
        state
    }
}
