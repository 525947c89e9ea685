//! Output at given times.

use super::controlled::Controlled;
use super::steps::{AdaptiveSteps, DenseOf, StepOf};
use crate::error::Error;
use crate::systems::{Components, System};

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
