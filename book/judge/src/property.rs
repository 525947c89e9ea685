//! The properties that are measured, by their names in reports.

use core::fmt;

macro_rules! properties {
    ($($(#[$doc:meta])+ $property:ident $name:literal;)+) => {
        /// What is measured of an integrator. A solver that also takes fixed steps has some
        /// properties twice; those of its runs by tolerance begin with `Solve`.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[non_exhaustive]
        pub enum Property {
            $($(#[$doc])+ $property,)+
        }

        impl Property {
            /// All of them.
            pub const ALL: &'static [Self] = &[$(Self::$property,)+];

            /// Its name in reports.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$property => $name,)+
                }
            }
        }
    };
}

properties! {
    /// The equation that is solved.
    #[default]
    Equation "equation";
    /// The form of the states that are returned, or of the start that is taken. Of a solver: the
    /// states between its steps.
    Output "output";
    /// The power of the step, or of the number of evaluations, with which the error falls.
    Order "order";
    /// Whether a step preserves area in phase space.
    Area "area";
    /// Whether a step with −h undoes a step with h.
    Reversal "reversal";
    /// Whether the energy error stays bounded.
    Energy "energy";
    /// Whether the mirrored start leads to the mirrored run.
    Mirror "mirror";
    /// Whether the run is the same in other units of time.
    Units "units";
    /// Whether the run is the same whole turns further.
    Turn "turn";
    /// Whether n steps take n·h.
    Clock "clock";
    /// Force evaluations per step.
    Evaluations "evaluations";
    /// Whether the same request has the same answer.
    Repeatable "repeatable";
    /// What a step rounds by. Of a solver: the smallest error that it reaches.
    Precision "precision";
    /// Energy, or area, that is lost in each step.
    Loss "loss";
    /// The method that it is.
    Name "name";
    /// Whether the stages ask for a drive at their own times.
    StageTimes "stage-times";
    /// Whether it is the same in fast rotations, small swings and long steps.
    Range "range";
    /// Of a solver: whether the error falls with the tolerance.
    Tolerance "tolerance";
    /// Of a solver: the power of the step with which the error estimate falls.
    Estimate "estimate";
    /// Of a solver: whether asking for outputs changes the run.
    FreeOutputs "free-outputs";
    /// Of a solver: whether each time has its row.
    Rows "rows";
    /// Of a solver: where θ passes zero.
    Crossings "crossings";
    /// Of a solver: runs backwards.
    Back "back";
    /// Of a solver: runs that start at another time than 0.
    Start "start";
    /// Of a solver: runs under a drive.
    Driven "driven";
    /// Of a solver: as many outputs as anybody asks for.
    Many "many";
    /// Of a solver: its evaluations against those of the library.
    Effort "effort";
    /// Of a solver: whether what has no right answer ends in an error.
    Refusal "refusal";
    /// [`Order`](Self::Order) of what was judged by its fixed steps too.
    SolveOrder "solve-order";
    /// [`Output`](Self::Output) of the same.
    SolveOutput "solve-output";
    /// [`Precision`](Self::Precision) of the same.
    SolvePrecision "solve-precision";
    /// [`Mirror`](Self::Mirror) of the same.
    SolveMirror "solve-mirror";
    /// [`Units`](Self::Units) of the same.
    SolveUnits "solve-units";
    /// [`Turn`](Self::Turn) of the same.
    SolveTurn "solve-turn";
    /// [`Repeatable`](Self::Repeatable) of the same.
    SolveRepeatable "solve-repeatable";
}

impl Property {
    /// The property of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|property| property.name() == name)
    }

    /// The property of a solver, in a report that has those of fixed steps too.
    pub(crate) const fn of_solver(self) -> Self {
        match self {
            Self::Order => Self::SolveOrder,
            Self::Output => Self::SolveOutput,
            Self::Precision => Self::SolvePrecision,
            Self::Mirror => Self::SolveMirror,
            Self::Units => Self::SolveUnits,
            Self::Turn => Self::SolveTurn,
            Self::Repeatable => Self::SolveRepeatable,
            other => other,
        }
    }
}

impl fmt::Display for Property {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
