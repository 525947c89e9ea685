//! Errors: what happened, why, and what to do, each in a sentence of its own.

use core::fmt;

/// An input that was refused, or a run that could not be completed.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Error {
    /// A number outside its allowed range.
    #[non_exhaustive]
    Parameter {
        /// The name of the quantity, with its symbol and unit where it has them.
        name: &'static str,
        /// What was asked for.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// A duration that is not a whole number of steps.
    #[non_exhaustive]
    PartialStep {
        /// The duration asked for (s).
        duration: f64,
        /// The step asked for (s).
        step: f64,
    },
    /// More steps than an f64 can count one by one.
    #[non_exhaustive]
    TooManySteps {
        /// The number of steps asked for; an f64, as it may exceed every integer type.
        steps: f64,
    },
    /// No step, however small, meets the tolerance: the motion ends or is singular there, or its
    /// rate is not finite.
    ///
    /// That a motion ends is not always told so:
    /// [`Adaptive`](crate::adaptive::Adaptive#what-it-cannot-see) says when.
    #[non_exhaustive]
    StepTooSmall {
        /// The time that was reached (s).
        t: f64,
        /// The step that was refused (s): a tenth of it no longer changes the time in f64.
        step: f64,
    },
    /// More attempts at a step than were allowed.
    #[non_exhaustive]
    OutOfSteps {
        /// The time that was reached (s).
        t: f64,
        /// The number allowed.
        limit: u64,
    },
    /// A function whose crossings are looked for is NaN, so that it has no sign.
    #[non_exhaustive]
    UndefinedEvent {
        /// Which of the functions, counted from 0.
        index: usize,
        /// The time at which it was looked at (s).
        t: f64,
    },
    /// A step of an implicit method whose equations have not been solved.
    #[non_exhaustive]
    NotSolved {
        /// The number of steps taken before it.
        n: u64,
        /// The step Δt (s).
        step: f64,
        /// The sweeps of the iteration that were taken.
        sweeps: u32,
        /// What the last of them still changed in the slopes, relative to the slopes and to the
        /// state over the step; NaN if they are not finite.
        change: f64,
    },
}

impl Error {
    /// [`Error::Parameter`], for a system of your own that checks its parameters: the name of the
    /// quantity, what was asked for, and what is allowed.
    ///
    /// ```
    /// use pendula::Error;
    ///
    /// let error = Error::parameter("mass (kg)", -1.0, "greater than zero");
    /// assert_eq!(error.to_string(), "mass (kg) cannot be -1.0. It must be greater than zero");
    /// ```
    pub const fn parameter(name: &'static str, value: f64, allowed: &'static str) -> Self {
        Self::Parameter { name, value, allowed }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Parameter { name, value, allowed } => {
                write!(f, "{name} cannot be {value:?}. It must be {allowed}")
            }
            Self::PartialStep { duration, step } => {
                let steps = duration / step;
                write!(
                    f,
                    "a duration of {duration:?} s is {steps:?} steps of {step:?} s. It must be a \
                     whole number of steps. "
                )?;
                if steps < 1.0 {
                    return write!(f, "The longest step that fits is {duration:?} s");
                }
                let (longer, shorter) =
                    (duration / libm::floor(steps), duration / libm::ceil(steps));
                write!(f, "The nearest steps that fit are {longer:?} s and {shorter:?} s")
            }
            Self::TooManySteps { steps } => write!(
                f,
                "{steps:?} steps are too many. At most 2^53 = {MAX_STEPS} can be counted exactly"
            ),
            Self::StepTooSmall { t, step } => write!(
                f,
                "at {t:?} s no step meets the tolerance, not even one of {step:?} s. The motion \
                 ends or is singular there, or its rate is not a finite number. End the run \
                 earlier, allow a larger tolerance, or choose units in which the numbers are \
                 closer to 1"
            ),
            Self::OutOfSteps { t, limit } => write!(
                f,
                "{limit} steps were not enough, and the run came only to {t:?} s. Allow more \
                 steps, a larger tolerance or a shorter run"
            ),
            Self::UndefinedEvent { index, t } => write!(
                f,
                "the event function {index} is NaN at {t:?} s. It must have a sign there too, \
                 because a step may go beyond the event before the event is found"
            ),
            Self::NotSolved { n, step, sweeps, change } => write!(
                f,
                "the equations of a step of {step:?} s were not solved after {n} steps: the last \
                 of {sweeps} iterations still changed it by {change:.1e} of its size. Take a \
                 shorter step, well below the time in which the state changes by its own size"
            ),
        }
    }
}

impl core::error::Error for Error {}

/// 2⁵³: up to here every integer is an f64, so that the count of steps is never rounded.
pub const MAX_STEPS: u64 = 1 << 53;

/// Returns `value` if it `fits`; otherwise the error says what is `allowed`. A comparison with a
/// NaN is false, so that it does not fit.
pub(crate) fn checked(
    name: &'static str,
    value: f64,
    fits: bool,
    allowed: &'static str,
) -> Result<f64, Error> {
    if fits { Ok(value) } else { Err(Error::Parameter { name, value, allowed }) }
}

/// Returns `value` if it is finite and greater than zero.
pub(crate) fn positive(name: &'static str, value: f64) -> Result<f64, Error> {
    checked(name, value, value.is_finite() && value > 0.0, "finite and greater than zero")
}

/// Returns `value` if it is finite.
pub(crate) fn finite(name: &'static str, value: f64) -> Result<f64, Error> {
    checked(name, value, value.is_finite(), "finite")
}

/// Returns `value` if it is zero or greater, and finite when doubled.
pub(crate) fn not_negative(name: &'static str, value: f64) -> Result<f64, Error> {
    checked(name, value, value >= 0.0 && (2.0 * value).is_finite(), "between 0 and 8.9e307")
}

/// Returns the angular frequency `value` (rad/s) if it is greater than zero, and its period finite.
pub(crate) fn frequency(name: &'static str, value: f64) -> Result<f64, Error> {
    let has_period = (2.0 * core::f64::consts::PI / positive(name, value)?).is_finite();
    checked(name, value, has_period, "at least 3.5e-308: its period is finite")
}

/// Returns `value`, a product of parameters, if it neither overflowed nor lost digits to underflow.
pub(crate) fn normal(name: &'static str, value: f64) -> Result<f64, Error> {
    checked(name, value, value.is_normal(), "between 2.3e-308 and 1.8e308")
}
