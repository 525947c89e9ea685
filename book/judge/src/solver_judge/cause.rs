//! Why a claim of a solver fails, as data. [`words`](crate::words) makes sentences of it.

use crate::judge::equation::Departure;

/// Why a claim of a solver fails, or where to look.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum SolverCause {
    /// Its equation, or its output, departs from the pendulum's.
    Departs(Departure),
    /// Its states are numbers of single precision.
    SinglePrecision,
    /// From this tolerance on all answers are the same, off by this much (rad).
    IdleTolerance {
        /// The tolerance.
        tolerance: f64,
        /// The error (rad).
        error: f64,
    },
    /// Its time runs at another rate: at the end it is later by so much (s).
    ClockRate {
        /// How much later (s).
        later: f64,
        /// The length of the run (s).
        duration: f64,
    },
    /// State and time come apart on the way.
    TimeParts {
        /// When that is seen (s), and how much later the state is then (s).
        seen: [f64; 2],
        /// The length of the run (s), and how much later the state is at its end (s).
        end: [f64; 2],
    },
    /// At its end a run has the state of a time that is later by so much (s).
    RunsOver(f64),
    /// At its end a run has the state of a time that is earlier by so much (s).
    StopsBefore(f64),
    /// The estimate is of first power.
    FirstPower,
    /// The estimate is of another power than is claimed.
    OtherPower {
        /// The power, and how far off it may be.
        power: [f64; 2],
        /// The claim.
        claimed: u32,
    },
    /// It is wrong with another t₀.
    OtherStart,
    /// Outputs between steps are worse than the steps.
    Outputs {
        /// Whether they are numbers of single precision.
        single: bool,
        /// Whether the ends of runs are as bad.
        ends_too: bool,
        /// The degree of the polynomials on which they lie.
        degree: Option<usize>,
        /// The power with which their error falls, and how far off it may be.
        power: Option<[f64; 2]>,
    },
    /// From this tolerance on the error stays where it is (rad).
    ErrorStays {
        /// The tolerance.
        tolerance: f64,
        /// The error (rad).
        error: f64,
    },
    /// The error falls with this power of the evaluations, known so well.
    OrderIs([f64; 2]),
    /// At no tolerance is it right.
    NeverRight,
    /// At this tolerance the error is so many times that at a looser one.
    Rises {
        /// The tolerance.
        tolerance: f64,
        /// How many times.
        times: f64,
    },
    /// The error is up to so many tolerances for each evaluation.
    ManyTolerances(f64),
    /// The error falls with this power of the tolerance, known so well.
    FallsSlowly([f64; 2]),
    /// The angle of the start is wrapped.
    StartWrapped,
    /// It is wrong backwards.
    Backwards,
    /// The last of many outputs is wrong, and right where it is asked for alone.
    LastOfMany,
    /// Rows are missing, or not those of their times.
    Rows,
    /// The same requests count so many evaluations the first and the second time.
    CountKept([u64; 2]),
    /// The same question has different answers.
    AnswersDiffer,
    /// Asking for outputs changes the run.
    OutputsMoveRun,
    /// Every second crossing is missed.
    EverySecondPassage,
    /// Crossings are wrong from another t₀ on.
    PassagesElsewhere,
    /// The angle is not zero where a crossing is told.
    PassagesOffZero,
    /// Crossings are missed, or elsewhere.
    Passages,
    /// The time for many outputs grows faster than their number.
    ManySlow,
    /// Ten thousand outputs are off by this much (rad), and a thousand are right.
    ManyWrong(f64),
    /// What makes no sense has an answer.
    NotRefused,
    /// A constant in seconds is in it.
    ConstantInSeconds,
    /// The mirrored run is another.
    NotMirrored,
    /// A driven run is wrong.
    Driven(DrivenCause),
}

/// What is wrong under a drive.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum DrivenCause {
    /// All of it.
    Wrong,
    /// What starts at another time than 0.
    Elsewhere,
    /// What runs backwards.
    Backwards,
    /// What lies between steps.
    BetweenSteps,
    /// The last of several outputs.
    LastOutput,
    /// What runs backwards, by as much (rad) as without a drive.
    BackwardsAnyway(f64),
    /// What starts at another time than 0, by as much (rad) as without a drive.
    ElsewhereAnyway(f64),
    /// Nothing, but at this tolerance it takes so many times the evaluations.
    Work {
        /// The tolerance.
        tolerance: f64,
        /// How many times.
        times: f64,
    },
}

impl SolverCause {
    /// Its name in reports.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Departs(departure) => departure.kind().name(),
            Self::SinglePrecision => "single-precision",
            Self::IdleTolerance { .. } => "idle-tolerance",
            Self::ClockRate { .. } => "clock-rate",
            Self::TimeParts { .. } => "time-parts",
            Self::RunsOver(_) => "runs-over",
            Self::StopsBefore(_) => "stops-before",
            Self::FirstPower => "first-power",
            Self::OtherPower { .. } => "other-power",
            Self::OtherStart => "other-start",
            Self::Outputs { .. } => "outputs-worse",
            Self::ErrorStays { .. } => "error-stays",
            Self::OrderIs(_) => "other-order",
            Self::NeverRight => "never-right",
            Self::Rises { .. } => "error-rises",
            Self::ManyTolerances(_) => "many-tolerances",
            Self::FallsSlowly(_) => "falls-slowly",
            Self::StartWrapped => "start-wrapped",
            Self::Backwards => "backwards",
            Self::LastOfMany => "last-of-many",
            Self::Rows => "rows",
            Self::CountKept(_) => "count-kept",
            Self::AnswersDiffer => "answers-differ",
            Self::OutputsMoveRun => "outputs-move-run",
            Self::EverySecondPassage => "every-second-passage",
            Self::PassagesElsewhere => "passages-elsewhere",
            Self::PassagesOffZero => "passages-off-zero",
            Self::Passages => "passages",
            Self::ManySlow => "many-slow",
            Self::ManyWrong(_) => "many-wrong",
            Self::NotRefused => "not-refused",
            Self::ConstantInSeconds => "constant-in-seconds",
            Self::NotMirrored => "not-mirrored",
            Self::Driven(DrivenCause::Work { .. }) => "driven-work",
            Self::Driven(_) => "driven",
        }
    }
}
