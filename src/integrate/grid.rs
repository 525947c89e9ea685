//! The grid of times: an integer number of steps, and the time computed from the step count.

use crate::error::{Error, MAX_STEPS, finite, positive};

/// The times n h for n = 0 … N (s).
///
/// It begins at t = 0. If your system depends on the time and starts at t₀, add t₀ in its closure.
///
/// Time is the product of count and step, never a sum: adding 0.1 ten thousand times misses 1000 s
/// and, tested with `t < end`, can take a step too many.
///
/// ```
/// use pendula::Grid;
///
/// let grid = Grid::with_duration(0.1, 1000.0)?;
/// assert_eq!((grid.steps(), grid.samples()), (10_000, 10_001));
/// assert_eq!(grid.time(3), 0.1 * 3.0);
/// // A duration that is not a whole number of steps is refused.
/// assert!(Grid::with_duration(0.3, 1.0).is_err());
/// # Ok::<(), pendula::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    step: f64,
    steps: u64,
}

impl Grid {
    /// `steps` steps of `step` (s).
    ///
    /// # Errors
    /// [`Error::Parameter`] for a step that is not finite and positive or an end beyond the range
    /// of f64; [`Error::TooManySteps`] for more than [`MAX_STEPS`].
    pub fn new(step: f64, steps: u64) -> Result<Self, Error> {
        let step = positive("step Δt (s)", step)?;
        if steps > MAX_STEPS {
            return Err(Error::TooManySteps { steps: steps as f64 });
        }
        finite("duration (s)", steps as f64 * step)?;
        Ok(Self { step, steps })
    }

    /// As many steps of `step` (s) as fill `duration` (s).
    ///
    /// # Errors
    /// As [`Grid::new`]; also [`Error::Parameter`] for a duration that is not finite and positive,
    /// and [`Error::PartialStep`] for one that is not a whole number of steps. The test allows for
    /// the rounding of decimals: 50 s is 500 steps of 0.1 s although 0.1 is not exactly an f64.
    pub fn with_duration(step: f64, duration: f64) -> Result<Self, Error> {
        let duration = positive("duration (s)", duration)?;
        let step = positive("step Δt (s)", step)?;
        let quotient = duration / step;
        if quotient > MAX_STEPS as f64 {
            return Err(Error::TooManySteps { steps: quotient });
        }
        // Duration, step and their quotient are each rounded once, by at most ε/2 relative: a whole
        // number of steps given in decimals is within 3ε/2 of an integer, relatively. Twice that
        // allows for the rounding of this test.
        let steps = libm::round(quotient);
        if steps < 1.0 || libm::fabs(quotient - steps) > 3.0 * f64::EPSILON * steps {
            return Err(Error::PartialStep { duration, step });
        }
        Self::new(step, steps as u64)
    }

    /// The step h = Δt (s).
    pub const fn step(&self) -> f64 {
        self.step
    }

    /// The same grid with its step as the unit of time.
    pub const fn in_steps(&self) -> Self {
        Self { step: 1.0, steps: self.steps }
    }

    /// The number N of steps.
    pub const fn steps(&self) -> u64 {
        self.steps
    }

    /// The number N + 1 of samples, including the start.
    pub const fn samples(&self) -> u64 {
        self.steps + 1
    }

    /// The time after `n` steps (s), rounded once.
    #[inline]
    pub const fn time(&self, n: u64) -> f64 {
        n as f64 * self.step
    }
}
