//! What is read from a walk: when functions of the state cross zero, and states at given times.

use core::fmt;

use super::controlled::Controlled;
use super::steps::AdaptiveSteps;
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

/// Which of several functions crossed zero, counted from 0, and when and where.
pub type Event<Z> = (usize, Crossing<Z>);

/// Points of a step at which the sign is looked at: two zeros of one function that lie closer
/// together than an eighth of a step can hide each other.
const LOOKS: f64 = 8.0;

/// The functions whose crossings are looked for, each with its direction.
trait Functions<Z> {
    fn direction(&self, index: usize) -> Direction;

    fn value(&mut self, index: usize, t: f64, z: Z) -> f64;
}

/// One function, which may keep a memory.
struct One<G> {
    direction: Direction,
    g: G,
}

impl<Z, G: FnMut(f64, Z) -> f64> Functions<Z> for One<G> {
    fn direction(&self, _index: usize) -> Direction {
        self.direction
    }

    fn value(&mut self, _index: usize, t: f64, z: Z) -> f64 {
        (self.g)(t, z)
    }
}

/// A function of time (s) and state, whose zeros are events.
pub type EventFunction<'g, Z> = &'g dyn Fn(f64, Z) -> f64;

type Several<'g, Z, const N: usize> = [(Direction, EventFunction<'g, Z>); N];

impl<Z, const N: usize> Functions<Z> for Several<'_, Z, N> {
    fn direction(&self, index: usize) -> Direction {
        self[index].0
    }

    fn value(&mut self, index: usize, t: f64, z: Z) -> f64 {
        (self[index].1)(t, z)
    }
}

/// The crossings of `N` functions from where the walk is read, in the order of its steps.
struct Search<'w, 'a, S: System<State: Components>, M: Controlled<S>, F, const N: usize> {
    walk: &'w mut AdaptiveSteps<'a, S, M>,
    functions: F,
    /// The fraction of the present step up to which the signs have been looked at, and the values
    /// of the functions there.
    seen: f64,
    values: [f64; N],
    /// The fractions at which functions have crossed before `seen` that are still to be told.
    found: [Option<f64>; N],
    is_started: bool,
    is_over: bool,
}

impl<'w, 'a, S, M, F, const N: usize> Search<'w, 'a, S, M, F, N>
where
    S: System<State: Components>,
    M: Controlled<S>,
    F: Functions<S::State>,
{
    fn new(walk: &'w mut AdaptiveSteps<'a, S, M>, functions: F) -> Self {
        let (values, found) = ([0.0; N], [None; N]);
        Self { walk, functions, seen: 0.0, values, found, is_started: false, is_over: false }
    }

    fn next(&mut self) -> Option<Result<Event<S::State>, Error>> {
        if self.is_over {
            return None;
        }
        let event = self.find();
        self.is_over = !matches!(event, Ok(Some(_)));
        event.transpose()
    }

    /// The next crossing; none at the end of the walk.
    fn find(&mut self) -> Result<Option<Event<S::State>>, Error> {
        if !self.is_started {
            self.is_started = true;
            let (s, t, z) = self.walk.reading_point();
            self.seen = s;
            self.values = self.values_at(t, z)?;
        }
        loop {
            if let Some((index, s)) = self.take_earliest() {
                let (t, z) = self.walk.read_to(s);
                return Ok(Some((index, Crossing { t, z })));
            }
            if self.seen == 1.0 || !self.walk.is_within_step() {
                match self.walk.next() {
                    Some(step) => self.walk.read_from_start(step?),
                    None => return Ok(None),
                }
                self.seen = 0.0;
            }
            self.look()?;
        }
    }

    /// Looks at the signs an eighth of a step further, and finds where they have changed.
    fn look(&mut self) -> Result<(), Error> {
        let (low, high) = (self.seen, (libm::floor(self.seen * LOOKS) + 1.0) / LOOKS);
        let (t, z) = self.walk.read_at(high);
        let after = self.values_at(t, z)?;
        for (index, &after) in after.iter().enumerate() {
            if self.functions.direction(index).crossed(self.values[index], after) {
                self.found[index] = Some(self.bisect(index, low, high)?);
            }
        }
        (self.seen, self.values) = (high, after);
        Ok(())
    }

    /// The fraction of a step at which a function has crossed between the fractions `low` and
    /// `high`, by bisection until no f64 lies between. Bisection is slow, but cannot fail, and
    /// evaluates no force.
    fn bisect(&mut self, index: usize, mut low: f64, mut high: f64) -> Result<f64, Error> {
        let before = self.values[index];
        // 2⁻⁶⁴ of an eighth of a step is less than an ulp of any time in it but zero.
        for _ in 0..64 {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                break;
            }
            let (t, z) = self.walk.read_at(middle);
            if Direction::Either.crossed(before, self.value(index, t, z)?) {
                high = middle;
            } else {
                low = middle;
            }
        }
        Ok(high)
    }

    /// The earliest crossing that has been found, and of two at the same time the first function.
    fn take_earliest(&mut self) -> Option<(usize, f64)> {
        let found = self.found.iter().enumerate().filter_map(|(index, s)| Some((index, (*s)?)));
        let earliest = found.reduce(|one, other| if other.1 < one.1 { other } else { one })?;
        self.found[earliest.0] = None;
        Some(earliest)
    }

    fn values_at(&mut self, t: f64, z: S::State) -> Result<[f64; N], Error> {
        let mut values = [0.0; N];
        for (index, value) in values.iter_mut().enumerate() {
            *value = self.value(index, t, z)?;
        }
        Ok(values)
    }

    fn value(&mut self, index: usize, t: f64, z: S::State) -> Result<f64, Error> {
        let value = self.functions.value(index, t, z);
        if value.is_nan() { Err(Error::UndefinedEvent { index, t }) } else { Ok(value) }
    }
}

/// An iterator over the crossings in a sequence of steps: see [`AdaptiveSteps::crossings`].
pub struct Crossings<'w, 'a, S: System<State: Components>, M: Controlled<S>, G> {
    search: Search<'w, 'a, S, M, One<G>, 1>,
}

impl<S, M, G> fmt::Debug for Crossings<'_, '_, S, M, G>
where
    S: System<State: Components>,
    M: Controlled<S>,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Crossings").field("walk", self.search.walk).finish_non_exhaustive()
    }
}

/// An iterator over the events in a sequence of steps: see [`AdaptiveSteps::events`].
pub struct Events<'w, 'a, S: System<State: Components>, M: Controlled<S>, const N: usize> {
    search: Search<'w, 'a, S, M, Several<'w, S::State, N>, N>,
}

impl<S, M, const N: usize> fmt::Debug for Events<'_, '_, S, M, N>
where
    S: System<State: Components>,
    M: Controlled<S>,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Events").field("walk", self.search.walk).finish_non_exhaustive()
    }
}

impl<'a, S, M> AdaptiveSteps<'a, S, M>
where
    S: System<State: Components>,
    M: Controlled<S>,
{
    /// An iterator over the crossings from here on: the times (s) and states at which the function
    /// `g` of time and state changes sign in the `direction`.
    ///
    /// "Here" is the crossing, or the [state](Self::states_at), that was last read from this walk,
    /// or the end of the step that was last taken: what is left of a step is searched too. Within a
    /// step crossings are found on its dense output. Two zeros that lie closer than an eighth of a
    /// step can hide each other.
    ///
    /// To stop at a crossing and go on differently, as with SciPy's `terminal`, take the first one,
    /// and begin a new walk at its time with the state that you want:
    ///
    /// ```
    /// use pendula::adaptive::{Adaptive, Direction, Tolerance};
    /// use pendula::methods::DormandPrince;
    /// use pendula::systems::FromRate;
    ///
    /// // A ball at 1 m, which keeps 0.8 of its velocity when it bounces.
    /// let fall = FromRate::new(|_t, [_, velocity]: [f64; 2]| [velocity, -9.81]);
    /// let adaptive = Adaptive::new(DormandPrince, Tolerance::uniform(1e-9)?);
    /// let (mut t, mut z) = (0.0, [1.0, 0.0]);
    /// for _ in 0..2 {
    ///     let mut walk = adaptive.steps(&fall, z, t, t + 10.0)?;
    ///     let hit = walk.crossings(Direction::Falling, |_t, z| z[0]).next().expect("it falls")?;
    ///     (t, z) = (hit.t, [0.0, -0.8 * hit.z[1]]);
    /// }
    /// // √(2/g) down, and 0.8 of it up and down again.
    /// assert!((t - 2.6 * (2.0_f64 / 9.81).sqrt()).abs() < 1e-6);
    /// # Ok::<(), pendula::Error>(())
    /// ```
    ///
    /// It ends after an error: those of the steps, and [`Error::UndefinedEvent`] where `g` is NaN.
    pub fn crossings<G>(&mut self, direction: Direction, g: G) -> Crossings<'_, 'a, S, M, G>
    where
        G: FnMut(f64, S::State) -> f64,
    {
        Crossings { search: Search::new(self, One { direction, g }) }
    }

    /// An iterator over the crossings of several functions, from here on and in the order in which
    /// they happen: the index of the function in `functions`, with the time (s) and the state. Of
    /// two that happen at the same time the first comes first. Otherwise as
    /// [`crossings`](Self::crossings).
    ///
    /// ```
    /// use pendula::adaptive::{Adaptive, Direction, Tolerance};
    /// use pendula::methods::Dop853;
    /// use pendula::{Pendulum, Phase};
    ///
    /// let adaptive = Adaptive::new(Dop853, Tolerance::uniform(1e-10)?);
    /// let mut walk = adaptive.steps(&Pendulum::PAPER, Phase::at_rest(1.0), 0.0, 2.0)?;
    /// let events = walk.events([
    ///     (Direction::Either, &|_, z| z.theta),
    ///     (Direction::Either, &|_, z| z.omega),
    /// ]);
    /// let names = ["bottom", "turn"];
    /// let seen = events.map(|event| Ok(names[event?.0])).collect::<Result<Vec<_>, _>>()?;
    /// assert_eq!(seen, ["bottom", "turn", "bottom"]);
    /// # Ok::<(), pendula::Error>(())
    /// ```
    pub fn events<'w, const N: usize>(
        &'w mut self,
        functions: [(Direction, EventFunction<'w, S::State>); N],
    ) -> Events<'w, 'a, S, M, N> {
        Events { search: Search::new(self, functions) }
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
        self.search.next().map(|event| event.map(|(_, crossing)| crossing))
    }
}

impl<S, M, const N: usize> Iterator for Events<'_, '_, S, M, N>
where
    S: System<State: Components>,
    M: Controlled<S>,
{
    type Item = Result<Event<S::State>, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        self.search.next()
    }
}

/// An iterator over the states at given times: see [`AdaptiveSteps::states_at`].
pub struct StatesAt<'w, 'a, S: System<State: Components>, M: Controlled<S>, I> {
    walk: &'w mut AdaptiveSteps<'a, S, M>,
    times: I,
    failed: bool,
}

impl<S, M, I> fmt::Debug for StatesAt<'_, '_, S, M, I>
where
    S: System<State: Components>,
    M: Controlled<S>,
{
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("StatesAt").field("walk", self.walk).finish_non_exhaustive()
    }
}

impl<'a, S: System<State: Components>, M: Controlled<S>> AdaptiveSteps<'a, S, M> {
    /// An iterator over the states at the `times` (s), which lie between here and the end of the
    /// walk, in its order. "Here" is the state, or the [crossing](Self::crossings), that was last
    /// read from this walk, or the end of the step that was last taken. The walk takes the steps
    /// that it would take without them, and no more than they need; within a step a state is that
    /// of its dense output. Of a walk that has ended with an error there are no states.
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
        StatesAt { walk: self, times: times.into_iter(), failed: false }
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
        let (last, until) = (self.walk.reading_time(), self.walk.end_time());
        if !(last.min(until)..=last.max(until)).contains(&t) {
            let allowed = "no earlier in the walk than the time before it, nor beyond its end";
            return Some(Err(Error::Parameter { name: "time of a state (s)", value: t, allowed }));
        }
        let is_ahead_of = |time: f64| if until < last { t < time } else { t > time };
        while is_ahead_of(self.walk.time()) {
            match self.walk.next()? {
                Ok(step) => self.walk.read_from_start(step),
                Err(error) => return Some(Err(error)),
            }
        }
        Some(Ok(self.walk.read_to_time(t)))
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
