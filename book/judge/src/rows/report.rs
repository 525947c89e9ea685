//! What is found in the rows of a run, as data. The words are in `words/rows.rs`.

/// Why a text is not identified.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Refusal {
    /// There is nothing in it.
    Empty,
    /// Bytes that are no text.
    Binary,
    /// More than is read at once.
    TooLong,
    /// No two lines with numbers side by side.
    NoRows,
    /// One row: nothing leads from one to the next.
    OneRow,
    /// One number in each row.
    OneColumn,
    /// No column goes on evenly, as a time does.
    NoTime,
    /// The angle never changes.
    NoMotion,
    /// Fewer rows than the equation has unknown numbers.
    TooFewRows {
        /// The rows that there are.
        rows: usize,
        /// The rows that it takes.
        needed: usize,
    },
}

/// In what the angle is given.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Unit {
    /// Radians.
    Radians,
    /// Degrees.
    Degrees,
    /// Cartesian coordinates, of which the angle is computed.
    Coordinates,
}

/// How exactly the numbers of a column are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Digits {
    /// So many decimals.
    Decimals(i32),
    /// So many digits from the first that is not 0.
    Significant(i32),
}

/// A column that was used.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Used {
    /// Its number in the table, counted from 1.
    pub column: usize,
    /// Its heading; empty if there is none.
    pub heading: String,
    /// Its digits.
    pub digits: Digits,
}

/// What was read.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Read {
    /// How many rows.
    pub rows: usize,
    /// The time.
    pub time: Used,
    /// The angle, or x.
    pub angle: Used,
    /// y, if the angle was computed of both.
    pub height: Option<Used>,
    /// The angular velocity, if there is one.
    pub velocity: Option<Used>,
    /// The unit of the angle.
    pub unit: Unit,
    /// Whether the velocity is in radians where the angle is in degrees.
    pub velocity_in_radians: bool,
    /// From row to row (s), if the times are even.
    pub spacing: Option<f64>,
    /// How exactly that is known (s).
    pub spacing_known_to: f64,
    /// How many lines were no rows.
    pub lines_left_out: usize,
}

/// What is wrong with the rows, or strange. Rows are counted from 1.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Fault {
    /// A cell has no number.
    NoNumber {
        /// The row.
        row: usize,
    },
    /// The time jumps over rows.
    Missing {
        /// After this row.
        after: usize,
        /// So many.
        rows: usize,
    },
    /// The time is that of the row before.
    TimeRepeated {
        /// The row.
        row: usize,
    },
    /// The state is that of the row before.
    StateRepeated {
        /// The row.
        row: usize,
    },
    /// From this row on the times are so many rows late: the states have gone on.
    TimesLate {
        /// The row.
        row: usize,
        /// By so many rows.
        by: usize,
    },
    /// The time of this row is not that of its place.
    TimeOff {
        /// The row.
        row: usize,
    },
    /// This row does not follow from the one before, nor the next from it, but the next from the
    /// one before.
    Edited {
        /// The row.
        row: usize,
    },
    /// The velocity is that of another row: the next for 1, the one before for -1.
    VelocityShifted {
        /// By so many rows.
        rows: i32,
    },
    /// The angle is brought back by full turns.
    Wrapped {
        /// The first row after a jump.
        row: usize,
        /// How many jumps.
        times: usize,
    },
    /// The times are not even, and no steps of one length lead from row to row.
    Uneven,
}

/// The force, -k f(θ).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Force {
    /// sin θ.
    Sine,
    /// θ.
    Linear,
    /// θ - θ³/6.
    Cubic,
    /// cos θ.
    Cosine,
    /// sin θ cos θ.
    SineCosine,
    /// sin(πθ/180).
    Degrees,
}

/// A number with what it is known to.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Known {
    /// As it was fitted.
    pub value: f64,
    /// Off by so much at most, if the equation and the method are right.
    pub known_to: f64,
    /// The shortest decimal within that.
    pub short: f64,
}

/// θ̈ = -k f(θ) - c ω + A cos(Ωt + φ).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct FoundEquation {
    /// f.
    pub force: Force,
    /// k (1/s²).
    pub k: Known,
    /// c (1/s), if it is not 0.
    pub damping: Option<Known>,
    /// A (1/s²), Ω (1/s) and φ, if there is a drive.
    pub drive: Option<[Known; 3]>,
}

/// A method that makes these rows.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Made {
    /// Its name among the known answers.
    pub name: &'static str,
    /// Whether it is a mistake, not a method.
    pub wrong: bool,
    /// How many steps lead from row to row.
    pub steps: u32,
    /// Their length (s).
    pub step: f64,
    /// The equation with it.
    pub equation: FoundEquation,
    /// How far off the worst row is, in what rounding of both rows does.
    pub off: f64,
    /// Others that make the same rows to the last bit of a double, with another k perhaps.
    pub same: Vec<(&'static str, f64)>,
}

/// What would tell apart those that are left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Distinguish {
    /// The velocity beside the angle.
    Velocity,
    /// More digits than there are.
    Digits,
    /// Longer steps, or fewer of them from row to row.
    LongerStep,
    /// More rows.
    Rows,
}

/// Who made the rows.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Maker {
    /// This method, and no other that is known.
    Method(Box<Made>),
    /// It cannot be told: several methods make these rows.
    Several {
        /// Examples of them, the likeliest first. Another may have made the rows, because methods
        /// that are as near may be far from where the search began.
        methods: Vec<Made>,
        /// How far off the exact motion is, in what rounding of both rows does, if it is not ten
        /// times as far off: then no method can be told.
        exact: Option<f64>,
        /// What would tell them apart.
        by: Vec<Distinguish>,
    },
    /// Rows with noise, as measurements have.
    Measured {
        /// Its standard deviation (rad).
        noise: f64,
    },
    /// None of the known ones was found to make them.
    Unknown {
        /// How far off the nearest is, in what rounding of both rows does.
        nearest: Option<(&'static str, f64)>,
        /// How far off the exact motion is.
        exact: f64,
        /// The equation whose exact motion is the nearest. None of its numbers is known: the error
        /// of an unknown method may look like another force, or like a drag.
        equation: FoundEquation,
    },
    /// No equation of a pendulum was found that describes the rows.
    NoPendulum,
}

/// The error at the last row against the exact motion of the equation that was found.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct AtTheEnd {
    /// Of the angle (rad).
    pub angle: f64,
    /// Of the energy, as a fraction of that of the first row above rest; without drag and drive.
    pub energy: Option<f64>,
    /// What the angle is off with another method and the same steps: its name and that.
    pub others: Vec<(&'static str, f64)>,
    /// The time from the first row to the last (s).
    pub time: f64,
}

/// Some rows, evenly spread, beside the exact motion of the equation that was found.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Drawn {
    /// The times (s).
    pub t: Vec<f64>,
    /// The angles (rad).
    pub theta: Vec<f64>,
    /// What the exact motion from the first row has there (rad).
    pub exact: Vec<f64>,
    /// How far each row is from what was found makes of the row before it, in what rounding of both
    /// does: more than 1 is too far.
    pub off: Vec<f64>,
}

/// What the rows of a run are.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct RunReport {
    /// What was read.
    pub read: Read,
    /// What is wrong with the rows.
    pub faults: Vec<Fault>,
    /// The equation, if it is known with what made the rows.
    pub equation: Option<FoundEquation>,
    /// The method.
    pub maker: Maker,
    /// How many pairs of rows were compared, of how many.
    pub compared: (usize, usize),
    /// What follows.
    pub end: Option<AtTheEnd>,
    /// What can be drawn, if an equation was found, or one that is near.
    pub drawn: Option<Drawn>,
}
