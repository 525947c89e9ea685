//! What is said of a program that departs from the pendulum that is asked for.

/// In what a program departs from the pendulum, θ̇ = ω and ω̇ = −(g/L) sin θ, from the step or from
/// the way in which states are to be handed out.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Departure {
    /// Of which kind it is.
    pub kind: Kind,
    /// Its numbers, in the order in which the sentence has them: a factor, a damping (1/s), a step
    /// (s), a g/L (1/s²), a force (1/s²) and the right one.
    pub values: Vec<f64>,
    /// What is wrong, in a sentence without its full stop.
    pub sentence: String,
    /// The equation that is solved in place of the pendulum's, where it is known: θ̈ = −(g/L) θ.
    pub equation: Option<String>,
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

            /// Where it stands.
            pub const fn place(self) -> Place {
                match self {
                    $(Self::$kind => Place::$place,)+
                }
            }
        }
    };
}

/// Where a departure stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// In the equation, or in the step: the motion is another one.
    Equation,
    /// In what is handed out, or taken: the program's own states are those of a right one.
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
    /// The force goes with another power of g/L.
    GravityPower "gravity-power" Equation;
    /// g/L is this, whatever is asked for.
    FixedGravity "fixed-gravity" Equation;
    /// The angle goes with so many times the velocity.
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
    /// A change goes with the square of the step.
    SquaredStep "squared-step" Equation;
    /// A change is not multiplied by the step.
    WithoutStep "without-step" Equation;
    /// The force never reaches the velocity.
    NoKick "no-kick" Equation;
    /// The velocity never reaches the angle.
    NoDrift "no-drift" Equation;
    /// Quantities of different units are added.
    Units "units" Equation;
    /// Not told, but by its values.
    Values "values" Equation;
    /// Angles, or angles and velocities, are handed out in degrees.
    DegreesOut "degrees-out" Output;
    /// Angles, or angles and velocities, are taken for degrees.
    DegreesIn "degrees-in" Output;
    /// Both.
    DegreesInAndOut "degrees-in-and-out" Output;
    /// Angle and velocity are handed out, or taken, so many times as large.
    Scaled "scaled" Output;
    /// Angle and velocity are exchanged.
    Swapped "swapped" Output;
    /// The angle is counted from the top.
    FromTheTop "from-the-top" Output;
    /// A state is handed out later than it is reached.
    RowsLate "rows-late" Output;
    /// A state is handed out before it is reached.
    RowsEarly "rows-early" Output;
    /// Whole turns are taken off the angle.
    Wrapped "wrapped" Output;
    /// So many decimals are handed out.
    Decimals "decimals" Output;
    /// So many significant digits are handed out.
    Digits "digits" Output;
}

impl Departure {
    pub(super) fn new(kind: Kind, values: &[f64], sentence: impl Into<String>) -> Self {
        Self { kind, values: values.to_vec(), sentence: sentence.into(), equation: None }
    }

    pub(super) fn solving(self, equation: impl Into<String>) -> Self {
        Self { equation: Some(equation.into()), ..self }
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

/// The same in words.
pub fn in_words(value: f64, known_to: f64) -> String {
    let value = short(value, known_to);
    let size = value.abs();
    if size != 0.0 && !(1e-4..1e6).contains(&size) {
        return crate::judge::report::Scientific(value, 1).to_string();
    }
    // Six digits are more than a reader compares.
    let digits = (5.0 - libm::floor(libm::log10(size.max(1e-9)))).clamp(0.0, 12.0) as usize;
    let text = format!("{value:.digits$}");
    let text =
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    text.replace('-', "−")
}
