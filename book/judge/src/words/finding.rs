//! Findings in words: what was measured, and how or what follows.

use super::numbers::{about, scientific, slopes};
use super::solver_finding;
use crate::finding::{Beyond, EnergyLaw, Finding, LossBy, Measurement, OtherAnswer, Slopes};
use crate::judge::verdict::{Trouble, Verdict};
use crate::property::Property;

/// The pendulum's equation.
const RIGHT: &str = "θ̈ = −(g/L) sin θ";

impl Finding {
    /// What was measured, in words.
    pub fn measured(&self) -> String {
        let first = self.values.first().copied().unwrap_or(f64::NAN);
        match &self.measurement {
            Measurement::Nothing | Measurement::NotHad(Trouble::NoAnswer(_) | Trouble::Lost(_)) => {
                "–".to_string()
            }
            Measurement::NotHad(trouble) => trouble.to_string(),
            Measurement::RightRates | Measurement::StepsOf(_) => RIGHT.to_string(),
            Measurement::OtherEquation(departure) => match departure.equation() {
                Some(equation) => equation.to_string(),
                None => "another one".to_string(),
            },
            Measurement::AsAsked => "θ in rad, ω in rad/s, a row for each state".to_string(),
            Measurement::OtherOutput(departure) => departure.sentence(),
            Measurement::Slopes(_) if self.values.is_empty() => "no slope".to_string(),
            Measurement::Slopes(_) => format!("slopes {}", slopes(&self.values)),
            Measurement::Area { x, .. } => {
                format!("det J − 1 = {} at x = {x:.1}", scientific(first))
            }
            Measurement::WayBack { .. } => {
                format!("misses the start by {} rad", scientific(first))
            }
            Measurement::EnergyAtEnds { law, .. } => {
                let last = self.values.last().copied().unwrap_or(f64::NAN);
                let law = in_words(*law);
                format!("{} at first, {} at last: {law}", scientific(first), scientific(last))
            }
            Measurement::Apart { .. } => format!("apart by {} rad", scientific(first)),
            Measurement::InPieces { .. } => format!("{first:.2} steps apart"),
            Measurement::Counted => format!("{first} a step"),
            Measurement::SameAnswers(None) => "the same bits".to_string(),
            Measurement::SameAnswers(Some(_)) => "other answers".to_string(),
            Measurement::Rounding { .. } => about(first).to_string(),
            Measurement::Lost { .. } => match self.bound {
                Some(bound) if first.abs() <= bound => {
                    format!("less than {} a step", about(bound))
                }
                _ => format!("{} a step", scientific(first)),
            },
            Measurement::Is(identity) => identity.method.to_string(),
            Measurement::OneOf(names) => one_of(names),
            Measurement::NoKnownMethod => "none that is known".to_string(),
            Measurement::Mistake(name) => format!("the known mistake {name}"),
            Measurement::DrivenSlopes { .. } if self.values.is_empty() => {
                "only rounding with a drive".to_string()
            }
            Measurement::DrivenSlopes { .. } => {
                format!("slopes with a drive {}", slopes(&self.values))
            }
            Measurement::Beyond(Beyond::Same { fast, small, long }) => {
                let parts = [
                    fast.then_some("|ω| up to 30 ω₀"),
                    small.then_some("swings of 10⁻⁴ rad"),
                    long.then_some("ω₀h up to 1.9"),
                ];
                let parts: Vec<&str> = parts.into_iter().flatten().collect();
                format!("the same for {}", parts.join(", "))
            }
            Measurement::Beyond(_) => "different beyond the usual states and steps".to_string(),
            Measurement::OfSolver(what) => solver_finding::measured(self, what),
        }
    }

    /// How it was measured, the bound and where that comes from, or what follows, in whole
    /// sentences; or why nothing was measured.
    pub fn why(&self) -> String {
        let first = self.values.first().copied().unwrap_or(f64::NAN);
        let bound = self.bound.unwrap_or(f64::NAN);
        match &self.measurement {
            Measurement::Nothing | Measurement::AsAsked => String::new(),
            Measurement::NotHad(Trouble::NoAnswer(why) | Trouble::Lost(why)) => why.clone(),
            Measurement::NotHad(trouble) => trouble.to_string(),
            Measurement::RightRates => format!(
                "The rates of angle and velocity are the pendulum's at fourteen states, to within \
                 {}.",
                about(first)
            ),
            Measurement::StepsOf(method) => format!("Its steps are those of {method}."),
            Measurement::OtherEquation(departure) => format!("{}.", departure.sentence()),
            Measurement::OtherOutput(_) => {
                "The numbers that go in or out cause this, and not the method.".to_string()
            }
            Measurement::Slopes(found) => of_slopes(*found),
            Measurement::Area { x, ruler } => format!(
                "A step of x = ω₀h = {x:.1} changes a small area by the fraction det J − 1 = {}. \
                 The measurement is right to within {}.",
                scientific(first),
                about(*ruler)
            ),
            Measurement::WayBack { x, steps, by_itself } => {
                let back = if *by_itself { "with −h" } else { "with the velocity reversed" };
                format!(
                    "After {steps} steps of x = ω₀h = {x} and as many back {back}, the start is \
                     missed by {} rad. Rounding explains at most {} rad.",
                    scientific(first),
                    about(bound)
                )
            }
            Measurement::EnergyAtEnds { x, steps, law } => {
                let last = self.values.last().copied().unwrap_or(f64::NAN);
                let follows = match (self.verdict, law) {
                    (Verdict::Unclear, EnergyLaw::Rounding) => {
                        " Both are rounding, so this run cannot show whether the energy is bounded."
                    }
                    (Verdict::Unclear, _) => {
                        " It grows a little, or wanders, and the run is too short to tell which."
                    }
                    _ => "",
                };
                format!(
                    "In {steps} steps of x = ω₀h = {x} from 1 rad the largest |ΔH|/(mgL) is {} in \
                     the first tenth of the run and {} in the last.{follows}",
                    scientific(first),
                    scientific(last)
                )
            }
            Measurement::Apart { by_tolerance } => {
                let runs = match self.property {
                    Property::Mirror => {
                        "The run from (−θ, −ω), mirrored, and the run from (θ, ω) differ"
                    }
                    Property::Units => "The run and the same run in other units of time differ",
                    Property::Turn => "The run from a whole turn higher and the run itself differ",
                    _ => "The runs differ",
                };
                format!(
                    "{runs} by up to {} rad. Rounding explains at most {} rad.{}",
                    scientific(first),
                    about(bound),
                    may(*by_tolerance)
                )
            }
            Measurement::InPieces { steps, remembers } => {
                let what = match (self.verdict, remembers) {
                    (Verdict::Holds, true) => " A method that remembers older states may do so.",
                    (Verdict::Holds, false) => " That is rounding.",
                    _ => "",
                };
                format!(
                    "{steps} steps in one run, and in several runs that continue each other, end \
                     {first:.2} steps apart.{what}"
                )
            }
            Measurement::Counted => "They were counted over a thousand steps.".to_string(),
            Measurement::SameAnswers(found) => match found {
                None => "Every answer was the same to the bit.",
                Some(OtherAnswer::SecondTime) => {
                    "The same request had another answer the second time."
                }
                Some(OtherAnswer::AfterAnother) => "An answer depends on the request before it.",
                Some(OtherAnswer::Thinned) => {
                    "Every fifth state of a run is another one if only those are asked for."
                }
            }
            .to_string(),
            Measurement::Rounding { cut_off: Some(cut_off) } => format!("{}.", cut_off.sentence()),
            Measurement::Rounding { cut_off: None } => {
                format!(
                    "A step from angles and velocities of about 1 rounds them by {}.",
                    about(first)
                )
            }
            Measurement::Lost { by, by_tolerance } => {
                let by = match by {
                    LossBy::Reversal => "The energy after the way out and back",
                    LossBy::Method => "The energy, compared with that of the known method,",
                    LossBy::Area => "The area after many steps",
                };
                let does = if first < 0.0 { "gain" } else { "loss" };
                format!(
                    "{by} shows a {does} of {} per step. Rounding explains at most {}.{}",
                    scientific(first.abs()),
                    about(bound),
                    may(*by_tolerance)
                )
            }
            Measurement::Is(_) if self.verdict == Verdict::Holds => {
                "Its steps are those of the method.".to_string()
            }
            Measurement::Is(identity) => format!("It is {identity}."),
            Measurement::OneOf(_) => match self.verdict {
                Verdict::Fails => "Its steps are not those of the method.".to_string(),
                _ => "Its digits can't tell it from other methods.".to_string(),
            },
            Measurement::NoKnownMethod => "Its steps are those of no known method.".to_string(),
            Measurement::Mistake(name) => {
                format!("Its steps are those of the known mistake {name}.")
            }
            Measurement::DrivenSlopes { order, rounding } => match self.values.last() {
                Some(last) if self.verdict == Verdict::Holds => {
                    let last = slopes(&[*last]);
                    format!("With a drive the slopes end at {last}, as order {order} needs.")
                }
                Some(last) => {
                    format!("With a drive the slopes end at {}, not at {order}.", slopes(&[*last]))
                }
                None if *rounding => {
                    "With a drive the error is rounding even at the longest steps.".to_string()
                }
                None => {
                    "With a drive no order can be told, because the error is larger than rounding \
                     at too few step sizes."
                        .to_string()
                }
            },
            Measurement::Beyond(Beyond::Same { .. }) => String::new(),
            Measurement::Beyond(Beyond::Fast { velocity, power, usual }) => {
                let falls = match *power {
                    ..0.5 => "does not fall with h".to_string(),
                    power => format!("falls as h to the power {power:.1}"),
                };
                format!(
                    "From |ω| = {velocity} ω₀ the error of a step {falls}. From slow states it \
                     falls as h to the power {usual:.1}."
                )
            }
            Measurement::Beyond(Beyond::Small { amplitude, larger }) => format!(
                "A swing of {} rad is not a swing of {larger} rad made smaller: they differ by {} \
                 of the amplitude.",
                about(*amplitude),
                scientific(first)
            ),
            Measurement::Beyond(Beyond::Long { x }) if *x < 1.0 => format!(
                "Steps from a fast rotation are not those of its method: they differ by {} rad.",
                scientific(first)
            ),
            Measurement::Beyond(Beyond::Long { x }) => format!(
                "Steps of x = ω₀h = {x} are not those of its method: they differ by {} rad.",
                scientific(first)
            ),
            Measurement::OfSolver(what) => solver_finding::why(self, what),
        }
    }
}

/// What a tolerance inside the program may explain.
const fn may(by_tolerance: bool) -> &'static str {
    if by_tolerance { " A tolerance inside the program may explain it." } else { "" }
}

const fn in_words(law: EnergyLaw) -> &'static str {
    match law {
        EnergyLaw::Bounded => "bounded",
        EnergyLaw::GrowsWithTime => "grows with time",
        EnergyLaw::Grows => "grows",
        EnergyLaw::Wanders => "grows a little, or wanders",
        EnergyLaw::Rounding => "rounding",
    }
}

fn of_slopes(found: Slopes) -> String {
    match found {
        Slopes::Unclaimed => String::new(),
        Slopes::TooFew => {
            "Too few step sizes lie between coarse ones and rounding to show an order.".to_string()
        }
        Slopes::Tend => "The slopes tend to the order as the steps become short.".to_string(),
        Slopes::ComeDown => {
            "The slopes come down to the order as the steps become short.".to_string()
        }
        Slopes::Leave => "The slopes reach the order and leave it again as the steps become \
                          short, because a term of lower order is left."
            .to_string(),
        Slopes::Better { shown, claimed } => {
            format!("The order is {shown}, which is better than {claimed}.")
        }
        Slopes::Grows => "The error grows as the steps become short.".to_string(),
        Slopes::NoFall => "The error doesn't fall. It is as small as a tolerance inside the \
                           program may leave it."
            .to_string(),
        Slopes::Settled(last) => format!("The slopes end at {}.", slopes(&[last])),
        Slopes::Between(last) => format!(
            "The slopes end at {}, between two orders or still on the way to one.",
            slopes(&[last])
        ),
        Slopes::Low(last) => {
            format!("The slopes end at {}, more than an order too low.", slopes(&[last]))
        }
        Slopes::OfMethod(order) => format!(
            "The slopes alone are unclear. Its steps are those of a known method, of order {order}."
        ),
        Slopes::Long { order, slope, window } => format!(
            "Over the shortest steps the slope is {slope:.1}. Only long steps show order {order}, \
             and their slope is uncertain by ± {window:.1}."
        ),
    }
}

/// The most methods of which it is said that it may be one.
const MOST_NAMES: usize = 3;

/// What it may be, as far as its digits tell.
pub(super) fn one_of(names: &[&str]) -> String {
    match names.len() {
        ..=MOST_NAMES => format!("one of: {}", names.join(", ")),
        many => format!("one of {many} methods"),
    }
}
