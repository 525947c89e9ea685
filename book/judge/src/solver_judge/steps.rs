//! What the ladder of tolerances tells: whether the tolerance is kept, the power of the estimate,
//! the order, the precision and the effort.

use std::borrow::Cow;
use std::sync::LazyLock;

use super::asked::{Asked, Power, Scenes, single};
use super::ladder::{Ladder, Rung};
use super::outputs::{in_words, rounded};
use crate::Description;
use crate::finding::Measurement;
use crate::judge::report::{Finding, about, scientific};
use crate::judge::verdict::{Measured, Trouble, Verdict};
use crate::solver::{ByTolerance, Solver};
use pendula::methods::{Dop853, DormandPrince};

/// By what the error, a mean of nine runs, may rise from one tolerance to a smaller one. That of
/// right solvers rises by up to 3: some of the nine errors may vanish by chance.
const RISE: f64 = 6.0;

/// How many tolerances the error may be for each evaluation of a run.
///
/// A step errs by a tolerance at most, and has an evaluation at least. Along these runs an error of
/// the state grows sevenfold on average, as that of an energy is one of the frequency; and the
/// tolerance is relative to states of a few radians: 7 · 3. Right Runge–Kutta methods come to 3,
/// series, which count one evaluation a step, to 15.
const AN_EVALUATION: f64 = 20.0;

/// Whether the error falls with the tolerance.
///
/// Of a method of order p with an estimate of power q at most p + 1, the error goes as tol^(p/q):
/// at least as tol^(p/(p + 1)), and a fifth less is allowed for what bends the line.
pub fn tolerance(ladder: &Ladder, ours: &Ours) -> Finding {
    let Some(slope) = ladder.by_tolerance() else {
        return no_slope(ladder);
    };
    let (rise, at) = ladder.rise();
    let order = ladder.order().map_or(1.0, |order| libm::fmax(order.value, 1.0));
    let least = 0.8 * order / (order + 1.0);
    let by_slope = Verdict::of(least - slope.value, slope.uncertainty, 2.0 * slope.uncertainty);
    let by_rise = Verdict::of(rise, RISE, 3.0 * RISE);
    let by_evaluation = match ladder.an_evaluation() {
        Some((times, _)) => Verdict::of(times, AN_EVALUATION, 2.0 * AN_EVALUATION),
        None => Verdict::Holds,
    };
    let by_floor = if ladder.floor().is_some() { Verdict::Fails } else { Verdict::Holds };
    let verdicts = [by_floor, by_rise, by_slope, by_evaluation];
    let verdict = [Verdict::Fails, Verdict::Unclear].into_iter().find(|it| verdicts.contains(it));
    let verdict = verdict.unwrap_or(Verdict::Holds);
    let measured = match (ladder.floor(), by_rise, &ladder.ended) {
        (Some(floor), _, _) => format!(
            "below {} the error stays at {} rad",
            about(floor.tolerance),
            scientific(floor.error)
        ),
        (None, Verdict::Fails, _) => {
            format!("at {} the error rises {} times", about(at), rounded(rise))
        }
        (None, _, ended) => format!(
            "the error goes as tol^{}; it is {} times the tolerance at {}{}",
            in_words(slope),
            rounded(multiple(ladder, ladder.usual())),
            about(ladder.usual()),
            ended.as_ref().map(|why| format!("; {why}")).unwrap_or_default()
        ),
    };
    let why = format!(
        "it has to fall at least as tol^{least:.2}, never to rise more than {RISE:.0} times, and \
         to be {AN_EVALUATION:.0} tolerances at most for each evaluation ({}); Dormand–Prince's is \
         {} times the tolerance",
        ladder.an_evaluation().map_or("–".to_string(), |(times, _)| rounded(times)),
        rounded(multiple(&ours.dormand_prince, ladder.usual()))
    );
    Finding {
        measurement: Measurement::Said { measured, why },
        values: vec![slope.value, rise],
        verdict,
        ..Finding::default()
    }
}

/// What is to be said where too few errors tell.
fn no_slope(ladder: &Ladder) -> Finding {
    if let Some(ended) = &ladder.ended {
        return Finding::nothing(ended.clone());
    }
    let worst = ladder.rungs.iter().map(Rung::largest).fold(0.0, libm::fmaximum);
    // All of them rounding is better than asked.
    let verdict = if worst < 1e-6 { Verdict::Unclear } else { Verdict::Fails };
    let measured = format!(
        "of {} runs fewer than four have an error between rounding and 0.1 rad",
        ladder.rungs.len()
    );
    let why = "a line needs four points".to_string();
    Finding {
        measurement: Measurement::Said { measured, why },
        ..Finding::number(worst, "rad", 0.1, verdict)
    }
}

/// How many times the tolerance the error is.
fn multiple(ladder: &Ladder, tolerance: f64) -> f64 {
    let nearest = ladder.rungs.iter().find(|rung| rung.tolerance < 1.1 * tolerance);
    nearest.map_or(f64::NAN, |rung| rung.largest() / rung.tolerance)
}

/// The ladders of two methods of the library, as yardsticks.
#[derive(Clone)]
pub struct Ours {
    dormand_prince: Ladder,
    dop853: Ladder,
}

/// Those of the usual scenes: who judges many solvers needs them once.
static USUAL: LazyLock<Ours> = LazyLock::new(|| Ours::run(Scenes::USUAL));

impl Ours {
    /// Those of these scenes.
    pub fn of(scenes: Scenes) -> Cow<'static, Self> {
        let scenes = Scenes { epsilon: f64::EPSILON, ..scenes };
        if scenes == Scenes::USUAL { Cow::Borrowed(&USUAL) } else { Cow::Owned(Self::run(scenes)) }
    }

    fn run(scenes: Scenes) -> Self {
        let of = |solver: &dyn Solver| {
            let (rungs, outputs) = Default::default();
            let nothing = Ladder { scenes, rungs, ended: None, outputs, miscount: None };
            Ladder::of(Asked { solver, scenes }).unwrap_or(nothing)
        };
        Self {
            dormand_prince: of(&ByTolerance::new(DormandPrince)),
            dop853: of(&ByTolerance::new(Dop853)),
        }
    }
}

/// An error if nobody counts.
fn counted(ladder: &Ladder) -> Measured<()> {
    let why = match ladder.miscount {
        Some(_) => "the same request counts other evaluations the second time",
        None if ladder.counts() => return Ok(()),
        None => "no count of evaluations that grows as its tolerance falls",
    };
    Err(Trouble::NoAnswer(why.to_string()))
}

fn too_few() -> Trouble {
    Trouble::NoAnswer("its runs do not tell a power".to_string())
}

/// Below this power an estimate that is worse than the result by more than this is that of a wrong
/// weight. The error of a step is of second power at least; held to the tolerance for each second,
/// as some solvers do, of first, and then the result is of the same order or the next.
const HOPELESS: f64 = 1.5;

/// Whether the estimate is that of a wrong weight.
pub fn hopeless(ladder: &Ladder) -> bool {
    let order = ladder.order().map_or(f64::INFINITY, |order| order.value);
    ladder.estimate().is_some_and(|it| it.value < HOPELESS && order > it.value + HOPELESS)
}

/// The power of the estimate, from the evaluations.
pub fn estimate(ladder: &Ladder, claimed: Option<u32>) -> Measured<Finding> {
    counted(ladder)?;
    let power = ladder.estimate().ok_or_else(too_few)?;
    let (verdict, why) = match claimed {
        Some(claimed) => (by_claim(power, claimed), window(claimed)),
        None => (
            if hopeless(ladder) { Verdict::Fails } else { Verdict::Holds },
            "of first power is only an estimate with a wrong weight, or that of a low order".into(),
        ),
    };
    let measured = format!(
        "evaluations grow as tol^(−1/q) with q = {}{}",
        in_words(power),
        varies(power, claimed)
    );
    Ok(Finding {
        measurement: Measurement::Said { measured, why },
        values: vec![power.value],
        verdict,
        ..Finding::default()
    })
}

/// How far below the claimed power the measured one may be. In the limit of short steps it is the
/// power itself; what is left of higher terms makes it larger, by up to a quarter of it and a half
/// in the steps of the higher orders, and seldom smaller.
fn below(claimed: u32) -> f64 {
    0.08 * f64::from(claimed)
}

/// How far above.
fn above(claimed: u32) -> f64 {
    0.5 + 0.25 * f64::from(claimed)
}

pub fn by_claim(power: Power, claimed: u32) -> Verdict {
    let off = power.value - f64::from(claimed);
    let (lower, upper) = (below(claimed), above(claimed));
    // An order is a whole number: half of one is the most that a poor line excuses.
    let poor = power.uncertainty.min(0.5);
    match off < 0.0 {
        true => Verdict::of(-off, lower.max(poor), lower + power.uncertainty),
        false => Verdict::of(off, upper.max(poor), upper + power.uncertainty),
    }
}

fn window(claimed: u32) -> String {
    format!(
        "claimed {claimed}; {:.1} less and {:.1} more may come of steps that are not short",
        below(claimed),
        above(claimed)
    )
}

/// What is said where nothing is claimed and no one power fits.
fn varies(power: Power, claimed: Option<u32>) -> &'static str {
    let varies = claimed.is_none() && (power.value > 12.0 || power.uncertainty > 2.0);
    if varies { ", as of a method whose order varies" } else { "" }
}

/// The order, from error against evaluations.
pub fn order(ladder: &Ladder, claimed: Option<u32>) -> Measured<Finding> {
    counted(ladder)?;
    let power = ladder.order().ok_or_else(too_few)?;
    let (verdict, why) = match claimed {
        // More than is claimed is no complaint.
        Some(claimed) if power.value > f64::from(claimed) => (Verdict::Holds, window(claimed)),
        Some(claimed) => (by_claim(power, claimed), window(claimed)),
        None => (Verdict::Unclaimed, String::new()),
    };
    let measured = format!(
        "the error falls with the power {} of the evaluations{}",
        in_words(power),
        varies(power, claimed)
    );
    Ok(Finding {
        measurement: Measurement::Said { measured, why },
        values: vec![power.value],
        verdict,
        ..Finding::default()
    })
}

/// The smallest error that it comes to; of a solver in single precision, whether rounding can make
/// it.
pub fn precision(ladder: &Ladder) -> Finding {
    let least = ladder.rungs.iter().map(Rung::largest).fold(f64::INFINITY, f64::min);
    let ends: Vec<_> = ladder.rungs.iter().flat_map(|rung| rung.ends).collect();
    if let (true, Some(last)) = (ladder.scenes.coarser() > 1.0, ladder.rungs.last()) {
        let bound = ladder.scenes.rounding(last.a_run());
        let verdict = Verdict::of(least, bound, 10.0 * bound);
        let measured = format!("off by {} rad at best", scientific(least));
        let why = format!("in single precision rounding may make {} of it", about(bound));
        return Finding {
            measurement: Measurement::Said { measured, why },
            ..Finding::number(least, "rad", bound, verdict)
        };
    }
    let (verdict, what) = match single(&ends) {
        true => (Verdict::Fails, "its states are numbers of single precision, "),
        false => (Verdict::Holds, ""),
    };
    let measured = format!("{what}off by {} rad at best", scientific(least));
    let why = "a double has sixteen digits, and a single seven".to_string();
    Finding {
        measurement: Measurement::Said { measured, why },
        values: vec![least],
        unit: "rad",
        verdict,
        ..Finding::default()
    }
}

/// Evaluations beside those of the library for the same error.
pub fn effort(ladder: &Ladder, ours: &Ours) -> Measured<Finding> {
    counted(ladder)?;
    let at = |ladder: &Ladder, error: f64| {
        ladder.rungs.windows(2).find_map(|pair| {
            let (a, b) = (pair[0].mean(), pair[1].mean());
            let (n, m) = (pair[0].evaluations? as f64, pair[1].evaluations? as f64);
            (a >= error && error > b)
                .then(|| n * libm::pow(m / n, libm::log(a / error) / libm::log(a / b)))
        })
    };
    let others = [&ours.dormand_prince, &ours.dop853];
    let ratios: Option<Vec<f64>> =
        others.iter().map(|it| Some(at(ladder, 1e-6)? / at(it, 1e-6)?)).collect();
    let unknown = || Trouble::NoAnswer("its errors are not on both sides of 10⁻⁶ rad".to_string());
    let values = ratios.ok_or_else(unknown)?;
    let [by_5, by_8] = [values[0], values[1]].map(rounded);
    let measured = format!(
        "{by_5} times the evaluations of Dormand–Prince 5(4) for an error of 10⁻⁶ rad, and {by_8} \
         times those of DOP853"
    );
    Ok(Finding {
        measurement: Measurement::Said { measured, why: String::new() },
        values,
        verdict: Verdict::Unclaimed,
        ..Finding::default()
    })
}

/// What it is.
pub fn description(ladder: &Ladder) -> Description {
    let power = |power: Option<Power>| power.map(|it| [it.value, it.uncertainty]);
    Description::Solver { order: power(ladder.order()), estimate: power(ladder.estimate()) }
}
