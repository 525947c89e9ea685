//! In what a program departs from the pendulum that is asked for.

use super::form::Equation;

/// What a quantity is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Of {
    /// The angle.
    Angle,
    /// The velocity.
    Velocity,
    /// Both.
    Both,
}

/// What a stage adds to an angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Added {
    /// An increment of the velocity.
    Velocity,
    /// The step.
    Step,
}

/// The range in which angles are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Range {
    /// (−π, π].
    AboutZero,
    /// [0, 2π).
    FromZero,
    /// Another one of a turn.
    OfATurn,
}

/// In what a program departs from the pendulum, θ̇ = ω and ω̇ = −(g/L) sin θ, from the step, or
/// from the way in which states are to be returned. Numbers are in rad, rad/s, s and 1/s².
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Departure {
    /// Another function of the angle in place of its sine.
    Force(Equation),
    /// The sine of the angle taken in degrees.
    SineOfDegrees(Equation),
    /// The force has the wrong sign.
    Sign(Equation),
    /// g/L is so many times as large.
    Gravity(Equation),
    /// The force scales with another power of g/L.
    GravityPower(Equation),
    /// g/L is the same, whatever is asked for.
    FixedGravity(Equation),
    /// The angle's rate is so many times the velocity.
    Drift(Equation),
    /// Both rates are so many times as large.
    Rates(Equation),
    /// A force against the velocity, and in proportion to it.
    Damping(Equation),
    /// A force against the velocity, and in proportion to its square.
    QuadraticDamping(Equation),
    /// A force that does not depend on the state.
    Torque(Equation),
    /// The step is so many times as long.
    Step {
        /// How many times as long, or as large.
        times: f64,
        /// The equation that this amounts to, where it is known.
        equation: Option<Equation>,
    },
    /// The first step is so many times as long, and later ones are not.
    FirstStep {
        /// How many times as long, or as large.
        times: f64,
    },
    /// The step, or the whole run, takes this time, whatever is asked for.
    FixedStep {
        /// The step (s), if it is known.
        step: Option<f64>,
        /// Whether the whole run takes it, and not each step.
        whole_run: bool,
        /// What the numbers are known to.
        known_to: f64,
    },
    /// Every step ends there, wherever it starts.
    FixedEnd {
        /// The angle (rad).
        theta: f64,
        /// The velocity (rad/s).
        omega: f64,
        /// What the numbers are known to.
        known_to: f64,
    },
    /// Each step multiplies the velocity by a factor, however short it is.
    DragEachStep {
        /// The factor.
        left: f64,
        /// What the numbers are known to.
        known_to: f64,
    },
    /// A change is divided by the step.
    DividedByStep(Of),
    /// A change scales with the square of the step.
    SquaredStep {
        /// Of what.
        of: Of,
        /// Its factor, with h in seconds.
        factor: f64,
    },
    /// A change is not multiplied by the step.
    WithoutStep(Of),
    /// Each step turns the angle by π, however short it is.
    TurnedEachStep,
    /// The velocity that is returned vanishes with the step.
    VelocityVanishes,
    /// The force never reaches the velocity.
    NoKick,
    /// The velocity never reaches the angle.
    NoDrift,
    /// The stages add to the angle what has another unit.
    Units(Added),
    /// The start's angle, or its velocity, is ignored.
    StartIgnored(Of),
    /// However short a step is, it leads from the first of these states to the second.
    Jump {
        /// The first (rad, rad/s).
        from: [f64; 2],
        /// The second (rad, rad/s).
        to: [f64; 2],
        /// What the numbers are known to.
        known_to: f64,
    },
    /// A rate at this state is another one.
    Rate {
        /// The state (rad, rad/s).
        at: [f64; 2],
        /// Of what.
        of: Of,
        /// The rate (rad/s or 1/s²).
        value: f64,
        /// What it should be.
        right: f64,
        /// What the numbers are known to.
        known_to: f64,
    },
    /// The force of later steps is another one than that of the first, which departs so.
    ChangesInTime(Box<Self>),
    /// Angles, velocities, or both are returned in degrees.
    DegreesOut(Of),
    /// The start, or its angle, is taken for degrees.
    DegreesIn(Of),
    /// The program computes in degrees, and is given radians.
    DegreesInAndOut(Equation),
    /// Angle and velocity are returned, or taken, so many times as large.
    Scaled {
        /// How many times as long, or as large.
        times: [f64; 2],
        /// Whether in what is taken.
        taken: bool,
        /// What the numbers are known to.
        known_to: f64,
    },
    /// Angle and velocity are exchanged, in what is returned or also in what is taken.
    Swapped {
        /// Whether also in what is taken.
        taken_too: bool,
    },
    /// The angle is measured from the top.
    FromTheTop,
    /// A state is returned so many steps after it is reached.
    RowsLate(u32),
    /// A state is returned so many steps before it is reached.
    RowsEarly(u32),
    /// Whole turns are taken off the angle.
    Wrapped(Range),
    /// So many decimals are returned.
    Decimals(usize),
    /// So many significant digits are returned.
    Digits(usize),
}

macro_rules! kinds {
    ($($(#[$doc:meta])+ $kind:ident $name:literal $place:ident;)+) => {
        /// The kinds of departures.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        #[non_exhaustive]
        pub enum Kind {
            $($(#[$doc])+ $kind,)+
        }

        impl Kind {
            /// Its name in reports.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$kind => $name,)+
                }
            }

            /// All of them.
            pub const ALL: &'static [Self] = &[$(Self::$kind,)+];

            /// Where it lies.
            pub const fn place(self) -> Place {
                match self {
                    $(Self::$kind => Place::$place,)+
                }
            }
        }
    };
}

/// Where a departure lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// In the equation, or in the step: the motion is another one.
    Equation,
    /// In what is returned, or taken: the program's own states are those of a right one.
    Output,
}

impl Place {
    /// Its name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Equation => "equation",
            Self::Output => "output",
        }
    }
}

kinds! {
    /// Another function of the angle in place of its sine.
    Force "force" Equation;
    /// The sine of the angle taken in degrees.
    SineOfDegrees "sine-of-degrees" Equation;
    /// The force has the wrong sign.
    Sign "sign" Equation;
    /// g/L is so many times as large.
    Gravity "gravity" Equation;
    /// The force scales with another power of g/L.
    GravityPower "gravity-power" Equation;
    /// g/L is this, whatever is asked for.
    FixedGravity "fixed-gravity" Equation;
    /// The angle's rate is so many times the velocity.
    Drift "drift" Equation;
    /// The step is so many times as long.
    Step "step" Equation;
    /// The step is this, whatever is asked for.
    FixedStep "fixed-step" Equation;
    /// A force against the velocity, and in proportion to it.
    Damping "damping" Equation;
    /// A force against the velocity, and in proportion to its square.
    QuadraticDamping "quadratic-damping" Equation;
    /// A force that does not depend on the state.
    Torque "torque" Equation;
    /// Each step multiplies the velocity by a factor, however short it is.
    DragEachStep "drag-each-step" Equation;
    /// Something is divided by the step.
    DividedByStep "divided-by-step" Equation;
    /// A change scales with the square of the step.
    SquaredStep "squared-step" Equation;
    /// A change is not multiplied by the step.
    WithoutStep "without-step" Equation;
    /// The force never reaches the velocity.
    NoKick "no-kick" Equation;
    /// The velocity never reaches the angle.
    NoDrift "no-drift" Equation;
    /// Quantities of different units are added.
    Units "units" Equation;
    /// Known by its numbers alone.
    Values "values" Equation;
    /// Angles, or angles and velocities, are returned in degrees.
    DegreesOut "degrees-out" Output;
    /// Angles, or angles and velocities, are taken for degrees.
    DegreesIn "degrees-in" Output;
    /// Both.
    DegreesInAndOut "degrees-in-and-out" Output;
    /// Angle and velocity are returned, or taken, so many times as large.
    Scaled "scaled" Output;
    /// Angle and velocity are exchanged.
    Swapped "swapped" Output;
    /// The angle is measured from the top.
    FromTheTop "from-the-top" Output;
    /// A state is returned later than it is reached.
    RowsLate "rows-late" Output;
    /// A state is returned before it is reached.
    RowsEarly "rows-early" Output;
    /// Whole turns are taken off the angle.
    Wrapped "wrapped" Output;
    /// So many decimals are returned.
    Decimals "decimals" Output;
    /// So many significant digits are returned.
    Digits "digits" Output;
}

impl Departure {
    /// Of which kind it is.
    pub const fn kind(&self) -> Kind {
        match self {
            Self::Force(_) => Kind::Force,
            Self::SineOfDegrees(_) => Kind::SineOfDegrees,
            Self::Sign(_) => Kind::Sign,
            Self::Gravity(_) => Kind::Gravity,
            Self::GravityPower(_) => Kind::GravityPower,
            Self::FixedGravity(_) => Kind::FixedGravity,
            Self::Drift(_) => Kind::Drift,
            Self::Damping(_) => Kind::Damping,
            Self::QuadraticDamping(_) => Kind::QuadraticDamping,
            Self::Torque(_) => Kind::Torque,
            Self::Step { .. } => Kind::Step,
            Self::FixedStep { .. } => Kind::FixedStep,
            Self::DragEachStep { .. } => Kind::DragEachStep,
            Self::DividedByStep(_) => Kind::DividedByStep,
            Self::SquaredStep { .. } => Kind::SquaredStep,
            Self::WithoutStep(_) | Self::TurnedEachStep => Kind::WithoutStep,
            Self::NoKick => Kind::NoKick,
            Self::NoDrift => Kind::NoDrift,
            Self::Units(_) => Kind::Units,
            Self::Rates(_)
            | Self::FirstStep { .. }
            | Self::FixedEnd { .. }
            | Self::StartIgnored(_)
            | Self::VelocityVanishes
            | Self::Jump { .. }
            | Self::Rate { .. }
            | Self::ChangesInTime(_) => Kind::Values,
            Self::DegreesOut(_) => Kind::DegreesOut,
            Self::DegreesIn(_) => Kind::DegreesIn,
            Self::DegreesInAndOut(_) => Kind::DegreesInAndOut,
            Self::Scaled { .. } => Kind::Scaled,
            Self::Swapped { .. } => Kind::Swapped,
            Self::FromTheTop => Kind::FromTheTop,
            Self::RowsLate(_) => Kind::RowsLate,
            Self::RowsEarly(_) => Kind::RowsEarly,
            Self::Wrapped(_) => Kind::Wrapped,
            Self::Decimals(_) => Kind::Decimals,
            Self::Digits(_) => Kind::Digits,
        }
    }

    /// Where it lies.
    pub const fn place(&self) -> Place {
        self.kind().place()
    }

    /// Its numbers, in the order in which its sentence has them: a factor, a damping (1/s), a step
    /// (s), a g/L (1/s²), a force (1/s²) and the right one.
    pub fn values(&self) -> Vec<f64> {
        match self {
            Self::Force(equation) | Self::Gravity(equation) => vec![equation.times()],
            Self::Sign(equation) => vec![equation.factor],
            Self::GravityPower(equation) => {
                let (factor, known_to) = equation.factor_of_g();
                vec![equation.power() + 1.0, short(factor, known_to)]
            }
            Self::FixedGravity(equation) => {
                let (g_over_l, known_to) = equation.factor_of_g();
                vec![short(g_over_l, known_to)]
            }
            Self::Drift(equation) => vec![equation.drifts()],
            Self::Rates(equation) => vec![equation.drift, equation.factor],
            Self::Damping(equation) | Self::QuadraticDamping(equation) | Self::Torque(equation) => {
                equation.besides().map(|beside| beside.value).collect()
            }
            Self::Step { times, .. } | Self::FirstStep { times } => vec![*times],
            Self::FixedStep { step, .. } => step.iter().copied().collect(),
            Self::FixedEnd { theta, omega, .. } => vec![*theta, *omega],
            Self::DragEachStep { left, .. } => vec![*left],
            Self::SquaredStep { factor, .. } => vec![*factor],
            Self::Jump { to, .. } => to.to_vec(),
            Self::Rate { value, right, .. } => vec![*value, *right],
            Self::ChangesInTime(first) => first.values(),
            Self::Scaled { times, .. } => times.to_vec(),
            Self::RowsLate(by) | Self::RowsEarly(by) => vec![f64::from(*by)],
            Self::Decimals(count) | Self::Digits(count) => vec![*count as f64],
            Self::SineOfDegrees(_)
            | Self::DividedByStep(_)
            | Self::WithoutStep(_)
            | Self::TurnedEachStep
            | Self::VelocityVanishes
            | Self::NoKick
            | Self::NoDrift
            | Self::Units(_)
            | Self::StartIgnored(_)
            | Self::DegreesOut(_)
            | Self::DegreesIn(_)
            | Self::DegreesInAndOut(_)
            | Self::Swapped { .. }
            | Self::FromTheTop
            | Self::Wrapped(_) => Vec::new(),
        }
    }

    /// The equation that is solved in place of the pendulum's, where it is known.
    pub const fn equation(&self) -> Option<&Equation> {
        match self {
            Self::Force(equation)
            | Self::SineOfDegrees(equation)
            | Self::Sign(equation)
            | Self::Gravity(equation)
            | Self::GravityPower(equation)
            | Self::FixedGravity(equation)
            | Self::Drift(equation)
            | Self::Rates(equation)
            | Self::Damping(equation)
            | Self::QuadraticDamping(equation)
            | Self::Torque(equation)
            | Self::DegreesInAndOut(equation) => Some(equation),
            Self::Step { equation, .. } => equation.as_ref(),
            _ => None,
        }
    }
}

/// A number that is known to `known_to`, as short as that allows: 0.1 for 0.1000000003.
pub fn short(value: f64, known_to: f64) -> f64 {
    let near = |rounded: &f64| (rounded - value).abs() <= known_to.max(1e-13 * value.abs());
    let rounded = (0..=12).map(|digits| {
        let power = libm::pow(10.0, f64::from(digits));
        libm::round(value * power) / power
    });
    let mut rounded = rounded.filter(near);
    // Not -0.
    rounded.next().unwrap_or(value) + 0.0
}
