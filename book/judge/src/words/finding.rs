//! Findings in words: what was measured, and how or what follows.

use super::numbers::{about, scientific, slopes};
use crate::finding::{EnergyLaw, Finding, LossBy, Measurement, OtherAnswer, Slopes};
use crate::judge::verdict::{Trouble, Verdict};

/// The pendulum's equation.
const RIGHT: &str = "θ̈ = −(g/L) sin θ";

impl Finding {
    /// What was measured, in words.
    pub fn measured(&self) -> String {
        let first = self.values.first().copied().unwrap_or(f64::NAN);
        match &self.measurement {
            Measurement::Nothing | Measurement::NotHad(Trouble::NoAnswer(_)) => "–".to_string(),
            Measurement::NotHad(trouble) => trouble.to_string(),
            Measurement::RightRates | Measurement::StepsOf(_) => RIGHT.to_string(),
            Measurement::OtherEquation(departure) => match departure.equation() {
                Some(equation) => equation.to_string(),
                None => "another one".to_string(),
            },
            Measurement::AsAsked => "θ in rad, ω in rad/s, row by row".to_string(),
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
                "with a drive: rounding".to_string()
            }
            Measurement::DrivenSlopes { .. } => {
                format!("with a drive: slopes {}", slopes(&self.values))
            }
            Measurement::Said { measured, .. } => measured.clone(),
        }
    }

    /// How it was measured, the bound and where that comes from, or what follows; or why nothing
    /// was measured.
    pub fn why(&self) -> String {
        let first = self.values.first().copied().unwrap_or(f64::NAN);
        let bound = self.bound.unwrap_or(f64::NAN);
        match &self.measurement {
            Measurement::Nothing => String::new(),
            Measurement::NotHad(Trouble::NoAnswer(why)) => why.clone(),
            Measurement::NotHad(trouble) => trouble.to_string(),
            Measurement::RightRates => {
                format!("its rates at fourteen states, to {}", about(first))
            }
            Measurement::StepsOf(method) => format!("its steps are those of {method}"),
            Measurement::OtherEquation(departure) => departure.sentence(),
            Measurement::AsAsked => String::new(),
            Measurement::OtherOutput(_) => {
                "the adapter or the output, and not the method".to_string()
            }
            Measurement::Slopes(found) => of_slopes(*found),
            Measurement::Area { x, ruler } => format!(
                "at x = ω₀h = {x:.1} the area changes by {}; the ruler is right to {}",
                scientific(first),
                about(*ruler)
            ),
            Measurement::WayBack { x, steps, by_itself } => {
                let back =
                    if *by_itself { "back with −h" } else { "back with the velocity reversed" };
                format!(
                    "{steps} steps of x = ω₀h = {x} and {back} miss the start by {} rad; rounding \
                     makes {} rad at most",
                    scientific(first),
                    about(bound)
                )
            }
            Measurement::EnergyAtEnds { x, steps, law } => {
                let last = self.values.last().copied().unwrap_or(f64::NAN);
                let why = format!(
                    "in {steps} steps of x = ω₀h = {x} from 1 rad the largest |ΔH|/(mgL) is {} in \
                     the first tenth and {} in the last",
                    scientific(first),
                    scientific(last)
                );
                match self.verdict {
                    Verdict::Unclear => format!("{why}: {}", in_words(*law)),
                    _ => why,
                }
            }
            Measurement::Apart { by_tolerance } => {
                let may = if *by_tolerance { "; a tolerance inside it may do so" } else { "" };
                format!(
                    "apart by {} rad, where rounding makes {} at most{may}",
                    scientific(first),
                    about(bound)
                )
            }
            Measurement::InPieces { steps, remembers } => {
                let what = match (self.verdict, remembers) {
                    (Verdict::Holds, true) => ": what it keeps of the past is of no more weight",
                    (Verdict::Holds, false) => ": rounding",
                    _ => "",
                };
                format!(
                    "{steps} steps in one piece and in several differ by {first:.2} steps' \
                     worth{what}"
                )
            }
            Measurement::Counted => "counted over a thousand steps".to_string(),
            Measurement::SameAnswers(found) => match found {
                None => "to the bit",
                Some(OtherAnswer::SecondTime) => {
                    "the same request has another answer the second time"
                }
                Some(OtherAnswer::AfterAnother) => "the answer depends on the request before it",
                Some(OtherAnswer::Thinned) => {
                    "every fifth state of a run is another one if only those are asked for"
                }
            }
            .to_string(),
            Measurement::Rounding { cut_off: Some(cut_off) } => cut_off.sentence(),
            Measurement::Rounding { cut_off: None } => {
                format!("a step rounds by {} of a state of order 1", about(first))
            }
            Measurement::Lost { by, by_tolerance } => {
                let by = match by {
                    LossBy::Reversal => "the energy after the way out and home",
                    LossBy::Method => "the energy beside its own method's",
                    LossBy::Area => "the area after many steps",
                };
                let may = if *by_tolerance { "; a tolerance inside it may do so" } else { "" };
                format!(
                    "by {by}: {} a step, where rounding makes {} at most{may}",
                    scientific(first),
                    about(bound)
                )
            }
            Measurement::Is(_) if self.verdict == Verdict::Holds => {
                "its steps are those of the method".to_string()
            }
            Measurement::Is(identity) => format!("it is {identity}"),
            Measurement::OneOf(_) => match self.verdict {
                Verdict::Fails => "its steps are not those of the method".to_string(),
                _ => "its digits do not tell it from others".to_string(),
            },
            Measurement::NoKnownMethod => "its steps are those of no known method".to_string(),
            Measurement::Mistake(name) => {
                format!("its steps are those of the known mistake {name}")
            }
            Measurement::DrivenSlopes { order, rounding } => match self.values.last() {
                Some(last) => format!("the slope ends at {}, not {order}", slopes(&[*last])),
                None if *rounding => "the error of the coarsest steps is rounding".to_string(),
                None => "too few steps above rounding".to_string(),
            },
            Measurement::Said { why, .. } => why.clone(),
        }
    }
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
        Slopes::TooFew => "too few steps lie between coarse and rounding".to_string(),
        Slopes::Tend => "the slopes tend to it as the steps become short".to_string(),
        Slopes::ComeDown => "the slopes come down to it as the steps become short".to_string(),
        Slopes::Leave => {
            "as the steps become short the slopes leave it: a term of lower order".to_string()
        }
        Slopes::Better { shown, claimed } => format!("better: {shown}, not {claimed}"),
        Slopes::Grows => "the shorter the step, the larger the error".to_string(),
        Slopes::NoFall => {
            "the error does not fall, and is as small as that of a tolerance inside it".to_string()
        }
        Slopes::Settled(last) => format!("the finest slope is {}", slopes(&[last])),
        Slopes::Between(last) => {
            format!("the finest slope is {}, on its way or between orders", slopes(&[last]))
        }
        Slopes::Long { order, slope, window } => format!(
            "over the finest steps the slope is {slope:.1}; steps that show order {order} are \
             long, where a slope is known to ± {window:.1}"
        ),
    }
}

/// The most methods of which it is said that it may be one.
const MOST_NAMES: usize = 3;

/// What it may be, as far as its digits tell.
pub fn one_of(names: &[&str]) -> String {
    match names.len() {
        ..=MOST_NAMES => format!("one of: {}", names.join(", ")),
        many => format!("one of {many} methods"),
    }
}
