//! A walk that is kept, to be looked up at any time.

use alloc::vec::Vec;
use core::fmt;

use super::controlled::Controlled;
use super::steps::{AdaptiveSteps, DenseOf};
use crate::error::Error;
use crate::systems::{Components, System};

/// The motion between two times: the [dense output](super::Dense) of every step of a walk, in which
/// the state at any time is looked up. It borrows nothing.
///
/// ```
/// use pendula::adaptive::{Adaptive, Direction, Solution, Tolerance};
/// use pendula::methods::Dop853;
/// use pendula::{Pendulum, Phase};
///
/// /// A swing, and when the bob was at the bottom and at rest.
/// struct Swing {
///     solution: Solution<Pendulum, Dop853>,
///     bottom: Vec<f64>,
///     rest: Vec<f64>,
/// }
///
/// fn swing(pendulum: &Pendulum, start: Phase) -> Result<Swing, pendula::Error> {
///     let adaptive = Adaptive::new(Dop853, Tolerance::uniform(1e-12)?);
///     let mut walk = adaptive.steps(pendulum, start, 0.0, 2.0)?;
///     let solution = walk.clone().solution()?;
///     let (mut bottom, mut rest) = (Vec::new(), Vec::new());
///     for event in walk.events([
///         (Direction::Either, &|_, z| z.theta),
///         (Direction::Either, &|_, z| z.omega),
///     ]) {
///         let (which, crossing) = event?;
///         [&mut bottom, &mut rest][which].push(crossing.t);
///     }
///     Ok(Swing { solution, bottom, rest })
/// }
///
/// let swing = swing(&Pendulum::PAPER, Phase::at_rest(1.0))?;
/// assert_eq!((swing.bottom.len(), swing.rest.len()), (2, 1));
/// for t in swing.bottom {
///     assert!(swing.solution.at(t).expect("it is on the way").theta.abs() < 1e-14);
/// }
/// for t in swing.rest {
///     assert!(swing.solution.at(t).expect("it is on the way").omega.abs() < 1e-13);
/// }
/// assert_eq!(swing.solution.at(0.0), Some(Phase::at_rest(1.0)));
/// assert_eq!(swing.solution.at(2.5), None);
/// # Ok::<(), pendula::Error>(())
/// ```
pub struct Solution<S: System<State: Components>, M: Controlled<S>> {
    start: f64,
    /// In the order of the walk, each from where the one before ends.
    steps: Vec<DenseOf<S, M>>,
    /// Where the walk ended: the time (s) and the state.
    end: (f64, S::State),
}

impl<S: System<State: Components>, M: Controlled<S>> Solution<S, M> {
    /// The time from which on it is known (s).
    pub const fn start_time(&self) -> f64 {
        self.start
    }

    /// The time up to which it is known (s): the earlier one, if the walk went backwards in time.
    pub const fn end_time(&self) -> f64 {
        self.end.0
    }

    /// The state at time `t` (s), from the dense output of the step that it lies in; none before
    /// the start or after the end. At the ends of steps it is the very state of the walk.
    pub fn at(&self, t: f64) -> Option<S::State> {
        let (start, (end, state)) = (self.start, self.end);
        if !(start.min(end)..=start.max(end)).contains(&t) {
            return None;
        }
        if t == end {
            return Some(state);
        }
        let begun = |time: f64| if end < start { time >= t } else { time <= t };
        let begun = self.steps.partition_point(|step| begun(step.time(0.0)));
        self.steps.get(begun.checked_sub(1)?).map(|step| step.at(t))
    }
}

impl<S: System<State: Components>, M: Controlled<S>> Clone for Solution<S, M> {
    fn clone(&self) -> Self {
        Self { steps: self.steps.clone(), ..*self }
    }
}

impl<S: System<State: Components>, M: Controlled<S>> fmt::Debug for Solution<S, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Solution")
            .field("start_time", &self.start)
            .field("end_time", &self.end.0)
            .field("steps", &self.steps.len())
            .finish_non_exhaustive()
    }
}

impl<S: System<State: Components>, M: Controlled<S>> AdaptiveSteps<'_, S, M> {
    /// The rest of the walk, kept: from the crossing or the state that was last read, or from the
    /// end of the step that was last taken. Afterwards the walk is at its end.
    ///
    /// # Errors
    /// Those of the steps. Of a walk that has ended with an error there is nothing more to keep.
    pub fn solution(&mut self) -> Result<Solution<S, M>, Error> {
        let start = self.reading_time();
        let mut steps = Vec::from_iter(self.rest_of_step());
        while let Some(step) = self.next() {
            steps.push(self.dense(&step?));
        }
        Ok(Solution { start, steps, end: (self.time(), self.state()) })
    }
}
