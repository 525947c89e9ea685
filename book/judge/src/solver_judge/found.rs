//! What was measured of a solver, as data; the numbers that decide are in
//! [`Finding::values`](crate::Finding::values).

use crate::judge::verdict::Trouble;

/// What was measured of a property of a solver, and how.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum OfSolver {
    /// From this tolerance on all answers are the same.
    Idle {
        /// The tolerance.
        tolerance: f64,
    },
    /// How the error goes with the tolerance.
    Falls {
        /// What is to be said of it first.
        how: Falls,
        /// The least power that is allowed.
        least: f64,
        /// What the error may rise by, and how many tolerances it may be for each evaluation.
        most: [f64; 2],
        /// How many tolerances it is for each evaluation.
        an_evaluation: Option<f64>,
        /// How many tolerances the error of Dormand and Prince's is.
        ours: f64,
    },
    /// Too few of so many runs have an error that tells.
    TooFew {
        /// How many runs.
        runs: usize,
    },
    /// The power of the estimate, or of the error, by the evaluations.
    Power {
        /// Of which of them.
        of: PowerOf,
        /// The power, and how far off it may be.
        power: [f64; 2],
        /// What is claimed, and how much less and more is allowed.
        claimed: Option<(u32, [f64; 2])>,
    },
    /// The smallest error.
    Least {
        /// Whether its states are numbers of single precision.
        single: bool,
    },
    /// The smallest error of a solver in single precision.
    LeastInSingle,
    /// Evaluations over those of two methods of the library.
    Effort,
    /// The worst state between steps.
    Between {
        /// At which tolerance.
        tolerance: f64,
        /// Its error (rad).
        outputs: f64,
        /// The error of the steps (rad).
        steps: f64,
        /// How many states were asked for.
        count: u32,
        /// Whether they are numbers of single precision.
        single: bool,
        /// The power with which their error falls, where it is to be told.
        power: Option<[f64; 2]>,
        /// The degree of the polynomials that is claimed, where they are worse than the steps.
        claimed: Option<u32>,
    },
    /// The end of a run with outputs and without.
    Free {
        /// How the two are alike.
        ends: Ends,
        /// The error of the end without outputs (rad).
        without: f64,
        /// How many outputs.
        count: u32,
        /// How many times the evaluations they take.
        more: f64,
    },
    /// Rows at times that are easily forgotten.
    Rows {
        /// Those that are wrong.
        wrong: Vec<(&'static str, WrongRows)>,
        /// Those that are refused, and why.
        refused: Vec<(&'static str, String)>,
    },
    /// Many outputs.
    Many {
        /// How many.
        count: u32,
        /// How long they took (s), if too long, and a tenth of them (s).
        took: [Option<f64>; 2],
        /// The tolerance, if it is not the usual one.
        tolerance: Option<f64>,
    },
    /// How far a run is off.
    Off {
        /// Which.
        run: &'static str,
        /// The tolerance, if it is not the usual one.
        tolerance: Option<f64>,
        /// The error of a usual run with it (rad).
        usual: f64,
    },
    /// How many of so many answers are others the second time, or the two counts of evaluations.
    Again {
        /// How many answers.
        of: u32,
        /// The counts, if they alone differ.
        counts: Option<[u64; 2]>,
    },
    /// Passages through zero, the first and the last that is wrong.
    Passages {
        /// Those that are wrong.
        wrong: Vec<(&'static str, WrongPassage)>,
        /// A run that is refused, and why.
        refused: Option<(&'static str, String)>,
    },
    /// A driven run.
    Driven {
        /// Which.
        run: &'static str,
        /// The tolerance.
        tolerance: f64,
        /// Runs that are refused, and why.
        refused: Vec<(&'static str, String)>,
    },
    /// Evaluations of a driven run over those of free ones.
    DrivenWork {
        /// The tolerance.
        tolerance: f64,
    },
    /// What came of requests that have no right answer.
    Impossible {
        /// Those that are not refused: what was asked for, and what came.
        answered: Vec<(&'static str, Answered)>,
        /// An answer that is off by more is wrong (rad).
        wrong: f64,
    },
}

/// What came in place of a refusal.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Answered {
    /// A state at a time that never comes.
    State,
    /// A state that is off by this (rad).
    Off(f64),
    /// An answer that cannot be used, or none.
    Unusable(Trouble),
}

/// How an error goes with the tolerance.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Falls {
    /// From this tolerance on it stays at this (rad).
    Stays([f64; 2]),
    /// At this tolerance it rises so many times.
    Rises([f64; 2]),
    /// With this power; it is so many tolerances at this one.
    As {
        /// The power, and how far off it may be.
        power: [f64; 2],
        /// How many tolerances.
        times: f64,
        /// At which.
        tolerance: f64,
        /// Why smaller ones were not asked for.
        ended: Option<Ended>,
    },
}

/// Why smaller tolerances were not asked for.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Ended {
    /// This one has no answer.
    NoAnswer {
        /// The tolerance.
        tolerance: f64,
        /// Why.
        why: String,
    },
    /// Smaller ones than this take too long.
    TooLong {
        /// The tolerance.
        tolerance: f64,
    },
}

/// Of what a power is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PowerOf {
    /// Of the estimate.
    Estimate,
    /// Of the error.
    Error,
}

/// How the ends of a run with outputs and without are alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Ends {
    /// To the bit.
    Same,
    /// But for rounding.
    ButForRounding,
    /// The one with outputs is wrong.
    Wrong,
    /// They are as good.
    AsGood,
}

/// What is wrong with rows.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum WrongRows {
    /// They are off by this much (rad).
    Off(f64),
    /// They are no answer.
    Trouble(Trouble),
}

/// What is wrong with passages.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum WrongPassage {
    /// One is off by this much (rad).
    Off(f64),
    /// So many of so many are at other times.
    Elsewhere([usize; 2]),
    /// So many are told where there are so many.
    Count([usize; 2]),
    /// The angle is this (rad) at one.
    NotZero(f64),
}

impl OfSolver {
    /// Its name in reports.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Idle { .. } => "idle-tolerance",
            Self::Falls { .. } => "falls-with-tolerance",
            Self::TooFew { .. } => "too-few-errors",
            Self::Power { of: PowerOf::Estimate, .. } => "power-of-estimate",
            Self::Power { of: PowerOf::Error, .. } => "power-of-error",
            Self::Least { .. } | Self::LeastInSingle => "least-error",
            Self::Effort => "effort",
            Self::Impossible { answered, .. } if answered.is_empty() => "refused",
            Self::Impossible { .. } => "not-refused",
            Self::Between { .. } => "between-steps",
            Self::Free { .. } => "ends",
            Self::Rows { .. } => "rows",
            Self::Many { .. } => "many-outputs",
            Self::Off { .. } => "off",
            Self::Again { .. } => "answers-again",
            Self::Passages { .. } => "passages",
            Self::Driven { .. } => "driven-error",
            Self::DrivenWork { .. } => "driven-work",
        }
    }
}
