//! What to look at where a claim of a solver fails: the cause first.

use super::Found;
use super::outputs::{Outputs, polynomial, rounded};
use crate::judge::report::{Report, about};
use crate::judge::verdict::Verdict;

/// The most that is said.
const MOST: usize = 3;

/// At most three sentences.
pub fn at(report: &Report, found: &Found) -> Vec<String> {
    let fails = |name: &str| {
        let finding = report.finding(name);
        finding.is_some_and(|finding| finding.verdict == Verdict::Fails)
    };
    let mut causes = Vec::new();
    let mut say = |holds: bool, sentence: &dyn Fn() -> String| {
        if holds {
            causes.push(sentence());
        }
    };
    let ladder = &found.ladder;
    let floor = ladder.floor();
    say(fails("precision"), &|| "States are numbers of single precision.".to_string());
    let hopeless = ladder.estimate().or_else(|| ladder.any_estimate());
    let hopeless = hopeless.is_some_and(|power| power.value < 1.5);
    say(fails("estimate") && hopeless, &|| {
        "The estimate is of first power: a weight of the embedded method is wrong.".to_string()
    });
    say(fails("start") && !found.single && fails("start"), &|| {
        "Far from t = 0 it is wrong: time is in single precision, or what is compared with it is \
         too coarse."
            .to_string()
    });
    let interpolated = found.outputs.as_ref().filter(|_| fails("output"));
    let ends = interpolated.is_some_and(Outputs::interpolates_the_end);
    let power = interpolated.and_then(Outputs::power);
    let what = || power.map_or("a polynomial of too low a degree".to_string(), polynomial);
    say(interpolated.is_some() && ends, &|| {
        format!("The end of a run is interpolated, like all outputs: they come from {}.", what())
    });
    say(interpolated.is_some() && !ends, &|| format!("Outputs come from {}.", what()));
    say(fails("tolerance") && floor.is_some() && !fails("precision"), &|| {
        let (tolerance, _) = floor.unwrap_or_default();
        format!("Below {} the tolerance does nothing.", about(tolerance))
    });
    let (rise, tolerance) = ladder.rise();
    say(fails("tolerance") && floor.is_none() && rise > 18.0, &|| {
        format!(
            "At a tolerance of {} the error is {} times that at a looser one: a run may end before \
             its time, or the slope of a refused step be kept.",
            about(tolerance),
            rounded(rise)
        )
    });
    say(fails("tolerance") && floor.is_none() && rise <= 18.0, &|| {
        "The error falls more slowly than the tolerance: the last step may run over the end, or the \
         end be interpolated."
            .to_string()
    });
    say(fails("crossings") && found.only_one_way, &|| {
        "Every second crossing is missed.".to_string()
    });
    for (name, sentence) in [
        ("free-outputs", "Asking for outputs changes the run."),
        ("back", "Backwards it is wrong: look at the sign of the step where times are compared."),
        ("units", "A constant in seconds is in it: a smallest, largest or first step."),
        ("mirror", "The error of a step has a sign where its size is meant."),
        ("driven", "The stages do not know the time."),
        ("repeatable", "Something is kept from one request to the next."),
    ] {
        say(fails(name), &|| sentence.to_string());
    }
    causes.truncate(MOST);
    causes
}
