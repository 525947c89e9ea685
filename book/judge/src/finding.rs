//! What was found of a property, as data. [`words`](crate::words) makes sentences of it.

use crate::judge::equation::Departure;
use crate::judge::identity::Identity;
use crate::judge::verdict::{Trouble, Verdict};
use crate::property::Property;
use crate::solver_judge::OfSolver;

/// What was found of one property.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Finding {
    /// The property.
    pub property: Property,
    /// What is claimed; "implied" for what everybody claims as soon as anything is claimed.
    pub claimed: Option<String>,
    /// The numbers that were measured, in [`unit`](Self::unit); none if nothing was.
    pub values: Vec<f64>,
    /// The unit of the numbers: "rad", "a step"; empty for pure numbers.
    pub unit: &'static str,
    /// What the value may be at most where the claim holds, if one number decides.
    pub bound: Option<f64>,
    /// What follows for the claim.
    pub verdict: Verdict,
    /// What was measured, and how.
    pub measurement: Measurement,
}

/// What was measured of a property, and how; the numbers are in [`Finding::values`].
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Measurement {
    /// Nothing.
    #[default]
    Nothing,
    /// Nothing, for this reason.
    NotHad(Trouble),
    /// The rates of angle and velocity at fourteen states are the pendulum's.
    RightRates,
    /// The steps are those of this method.
    StepsOf(&'static str),
    /// The equation is another one.
    OtherEquation(Departure),
    /// Start and states have the form that is asked for.
    AsAsked,
    /// What is taken or returned has another form.
    OtherOutput(Departure),
    /// Slopes of the error on a ladder of steps.
    Slopes(Slopes),
    /// The determinant of a step less one.
    Area {
        /// x = ω₀h of the step.
        x: f64,
        /// The error of the measurement itself.
        ruler: f64,
    },
    /// The distance from the start after the way out and back.
    WayBack {
        /// x = ω₀h of the steps.
        x: f64,
        /// Steps each way.
        steps: u64,
        /// Whether the way back was by −h; else with the velocity reversed.
        by_itself: bool,
    },
    /// The largest energy error in the first tenth of a run and in the last.
    EnergyAtEnds {
        /// x = ω₀h of the steps.
        x: f64,
        /// Their number.
        steps: u64,
        /// What becomes of it.
        law: EnergyLaw,
    },
    /// The distance of two runs that should be one.
    Apart {
        /// Whether a tolerance inside the program may explain it.
        by_tolerance: bool,
    },
    /// The distance of a run in one piece and in several, in steps.
    InPieces {
        /// Steps of the run.
        steps: u64,
        /// Whether it is more than rounding, and little enough for what a method remembers.
        remembers: bool,
    },
    /// Evaluations, counted.
    Counted,
    /// Whether the same request has the same answer.
    SameAnswers(Option<OtherAnswer>),
    /// What a step rounds by, relative to a state of order 1.
    Rounding {
        /// What is cut off of the numbers, if that is what rounds them.
        cut_off: Option<Departure>,
    },
    /// The share that is lost in a step.
    Lost {
        /// How it was measured.
        by: LossBy,
        /// Whether a tolerance inside the program may explain it.
        by_tolerance: bool,
    },
    /// The known method that it is.
    Is(Box<Identity>),
    /// Several known methods that it may be.
    OneOf(Vec<&'static str>),
    /// It is none of the known methods.
    NoKnownMethod,
    /// It makes the known mistake of this name.
    Mistake(&'static str),
    /// Slopes of the error of a driven pendulum.
    DrivenSlopes {
        /// The order that they are held to.
        order: u32,
        /// Whether the error of the coarsest steps is rounding already.
        rounding: bool,
    },
    /// Whether it is the same beyond the usual states and steps.
    Beyond(Beyond),
    /// That of a solver.
    OfSolver(OfSolver),
}

/// What the slopes of a ladder of steps say of a claimed order.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Slopes {
    /// No order is claimed.
    Unclaimed,
    /// Too few steps lie between coarse ones and rounding.
    TooFew,
    /// They tend to the order.
    Tend,
    /// They come down to it from above.
    ComeDown,
    /// They reach it and leave it again.
    Leave,
    /// They are those of a higher order.
    Better {
        /// The order that they show.
        shown: u32,
        /// The order that is claimed.
        claimed: u32,
    },
    /// The error grows as the steps become short.
    Grows,
    /// The error does not fall, and is as small as that of a tolerance inside the program.
    NoFall,
    /// The last one is of another order.
    Settled(f64),
    /// The last one lies between orders.
    Between(f64),
    /// The last two are more than an order too low; this is the last.
    Low(f64),
    /// They are unclear, and the method that it is has this order.
    OfMethod(u32),
    /// Beyond order 8, the slope over the finest steps with its uncertainty.
    Long {
        /// The order that is claimed.
        order: u32,
        /// The slope.
        slope: f64,
        /// How far off it may be.
        window: f64,
    },
}

/// How it is beyond the usual states and steps.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Beyond {
    /// The same, as far as it was measured.
    Same {
        /// In a fast rotation.
        fast: bool,
        /// In a small swing.
        small: bool,
        /// In long steps.
        long: bool,
    },
    /// The error of a step falls with a lower power of it in a fast rotation.
    Fast {
        /// The velocity, in ω₀.
        velocity: f64,
        /// The power there.
        power: f64,
        /// The power elsewhere.
        usual: f64,
    },
    /// A small swing is not a larger one in proportion.
    Small {
        /// Its amplitude (rad).
        amplitude: f64,
        /// The amplitude of the larger one (rad).
        larger: f64,
    },
    /// Long steps are not those of the method.
    Long {
        /// x = ω₀h; less than 1 for steps from a fast rotation.
        x: f64,
    },
}

/// What becomes of an energy error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum EnergyLaw {
    /// It is bounded.
    Bounded,
    /// It grows in proportion to the time.
    GrowsWithTime,
    /// It grows.
    Grows,
    /// It grows a little, or wanders.
    Wanders,
    /// It is rounding.
    Rounding,
}

/// How the same request has another answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum OtherAnswer {
    /// The second time.
    SecondTime,
    /// After another request.
    AfterAnother,
    /// If fewer states are asked for.
    Thinned,
}

/// How a loss was measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum LossBy {
    /// By the energy after the way out and home.
    Reversal,
    /// By the energy of the known method.
    Method,
    /// By the area after many steps.
    Area,
}

impl Measurement {
    /// Its name in reports.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Nothing => "nothing",
            Self::NotHad(Trouble::NoAnswer(_)) => "no-answer",
            Self::NotHad(Trouble::Lost(_)) => "lost-answer",
            Self::NotHad(_) => "wrong-answer",
            Self::RightRates => "right-rates",
            Self::StepsOf(_) => "steps-of-method",
            Self::OtherEquation(departure) | Self::OtherOutput(departure) => {
                departure.kind().name()
            }
            Self::AsAsked => "as-asked",
            Self::Slopes(slopes) => match slopes {
                Slopes::Unclaimed => "slopes",
                Slopes::TooFew => "too-few-slopes",
                Slopes::Tend => "slopes-tend",
                Slopes::ComeDown => "slopes-come-down",
                Slopes::Leave => "slopes-leave",
                Slopes::Better { .. } => "better",
                Slopes::Grows => "error-grows",
                Slopes::NoFall => "error-stays",
                Slopes::Settled(_) => "other-order",
                Slopes::Between(_) => "between-orders",
                Slopes::Low(_) => "low-slopes",
                Slopes::OfMethod(_) => "order-of-method",
                Slopes::Long { .. } => "long-steps",
            },
            Self::Area { .. } => "determinant",
            Self::WayBack { .. } => "way-back",
            Self::EnergyAtEnds { law, .. } => match law {
                EnergyLaw::Bounded => "bounded",
                EnergyLaw::GrowsWithTime => "grows-with-time",
                EnergyLaw::Grows => "grows",
                EnergyLaw::Wanders => "wanders",
                EnergyLaw::Rounding => "rounding",
            },
            Self::Apart { by_tolerance: true } => "apart-by-tolerance",
            Self::Apart { by_tolerance: false } => "apart",
            Self::InPieces { remembers: true, .. } => "remembers",
            Self::InPieces { remembers: false, .. } => "in-pieces",
            Self::Counted => "counted",
            Self::SameAnswers(None) => "same-answers",
            Self::SameAnswers(Some(_)) => "other-answers",
            Self::Rounding { cut_off: Some(_) } => "cut-off",
            Self::Rounding { cut_off: None } => "rounding",
            Self::Lost { .. } => "loss",
            Self::Is(_) => "method",
            Self::OneOf(_) => "one-of-methods",
            Self::NoKnownMethod => "no-known-method",
            Self::Mistake(_) => "mistake",
            Self::DrivenSlopes { .. } => "driven-slopes",
            Self::Beyond(beyond) => match beyond {
                Beyond::Same { .. } => "the-same",
                Beyond::Fast { .. } => "other-when-fast",
                Beyond::Small { .. } => "other-when-small",
                Beyond::Long { .. } => "other-in-long-steps",
            },
            Self::OfSolver(what) => what.name(),
        }
    }
}

impl Finding {
    /// One number, which `bound` decides.
    pub(crate) fn number(value: f64, unit: &'static str, bound: f64, verdict: Verdict) -> Self {
        Self { values: vec![value], unit, bound: Some(bound), verdict, ..Self::default() }
    }

    /// That nothing is known, and why.
    pub(crate) fn nothing(why: String) -> Self {
        Self::from(Trouble::NoAnswer(why))
    }

    /// That the program departs so from what is asked for.
    pub(crate) fn departing(
        departure: &Departure,
        measurement: fn(Departure) -> Measurement,
    ) -> Self {
        let (values, measurement) = (departure.values(), measurement(departure.clone()));
        Self { values, measurement, verdict: Verdict::Fails, ..Self::default() }
    }
}

/// What a measurement that was not had says: a program without an answer was not measured, one
/// with a wrong answer fails.
impl From<Trouble> for Finding {
    fn from(trouble: Trouble) -> Self {
        let verdict = match trouble {
            Trouble::NoAnswer(_) | Trouble::Lost(_) => Verdict::NotMeasured,
            _ => Verdict::Fails,
        };
        Self { verdict, measurement: Measurement::NotHad(trouble), ..Self::default() }
    }
}
