//! What the ladder of tolerances tells: whether the tolerance is kept, the power of the estimate,
//! the order, the precision and the effort.

use std::borrow::Cow;
use std::sync::LazyLock;

use super::asked::{Asked, Power, Scenes, single};
use super::found::{Falls, OfSolver, PowerOf};
use super::ladder::{Ladder, Rung};
use crate::Description;
use crate::finding::{Finding, Measurement};
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
    if let Some(idle) = ladder.idle().filter(|_| ladder.by_tolerance().is_none()) {
        return Finding {
            measurement: Measurement::OfSolver(OfSolver::Idle { tolerance: idle.tolerance }),
            values: vec![idle.error],
            verdict: Verdict::Fails,
            ..Finding::default()
        };
    }
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
    let how = match (ladder.floor(), by_rise) {
        (Some(floor), _) => Falls::Stays([floor.tolerance, floor.error]),
        (None, Verdict::Fails) => Falls::Rises([at, rise]),
        (None, _) => Falls::As {
            power: slope.numbers(),
            times: multiple(ladder, ladder.usual()),
            tolerance: ladder.usual(),
            ended: ladder.ended.clone(),
        },
    };
    let measurement = OfSolver::Falls {
        how,
        least,
        most: [RISE, AN_EVALUATION],
        an_evaluation: ladder.an_evaluation().map(|(times, _)| times),
        ours: multiple(&ours.dormand_prince, ladder.usual()),
    };
    Finding {
        measurement: Measurement::OfSolver(measurement),
        values: vec![slope.value, rise],
        verdict,
        ..Finding::default()
    }
}

/// What is to be said where too few errors tell.
fn no_slope(ladder: &Ladder) -> Finding {
    if let Some(ended) = &ladder.ended {
        return Finding::nothing(ended.to_string());
    }
    let worst = ladder.rungs.iter().map(Rung::largest).fold(0.0, libm::fmaximum);
    // All of them rounding is better than asked.
    let verdict = if worst < 1e-6 { Verdict::Unclear } else { Verdict::Fails };
    Finding {
        measurement: Measurement::OfSolver(OfSolver::TooFew { runs: ladder.rungs.len() }),
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
            let nothing = {
                let (rungs, outputs) = Default::default();
                Ladder { scenes, rungs, ended: None, outputs, miscount: None, in_short: None }
            };
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
    let verdict = match claimed {
        // In single precision tolerances end where steps are still long.
        Some(claimed) if ladder.scenes.coarser() > 1.0 => {
            let upper = 0.5 + 0.25 * f64::from(claimed);
            within(power, claimed, [below(claimed), upper.max(above(claimed))])
        }
        Some(claimed) => by_claim(power, claimed),
        None if hopeless(ladder) => Verdict::Fails,
        None => Verdict::Holds,
    };
    Ok(of_power(PowerOf::Estimate, power, claimed, verdict))
}

/// What is to be said of a power.
fn of_power(of: PowerOf, power: Power, claimed: Option<u32>, verdict: Verdict) -> Finding {
    let claimed = claimed.map(|it| (it, [below(it), above(it)]));
    let measurement = OfSolver::Power { of, power: power.numbers(), claimed };
    Finding {
        measurement: Measurement::OfSolver(measurement),
        values: vec![power.value],
        verdict,
        ..Finding::default()
    }
}

/// How far below the claimed power the measured one may be. In the limit of short steps it is the
/// power itself; what is left of higher terms makes it larger, by up to a quarter of it and a half
/// in the steps of the higher orders, and seldom smaller.
fn below(claimed: u32) -> f64 {
    0.08 * f64::from(claimed)
}

/// How far above: the steps of a higher order are longer, and so are its higher terms. 95 published
/// solvers came to 0.2 more where 4 or less was claimed, to 0.6 of 5, 0.9 of 6, 1.4 of 7 and 1.9 of
/// 8; Tsitouras's with its error per unit step to 0.5 of 4. Somewhat less than this.
fn above(claimed: u32) -> f64 {
    let claimed = f64::from(claimed);
    libm::fmin(claimed * claimed / 32.0, 0.5 + 0.25 * claimed).max(0.15 * claimed)
}

/// Whether this power is the claimed one.
pub fn by_claim(power: Power, claimed: u32) -> Verdict {
    within(power, claimed, [below(claimed), above(claimed)])
}

/// Whether this power is the claimed one, of which it may be so much less and so much more.
fn within(power: Power, claimed: u32, [lower, upper]: [f64; 2]) -> Verdict {
    let off = power.value - f64::from(claimed);
    // An order is a whole number: half of one is the most that a poor line excuses.
    let poor = power.uncertainty.min(0.5);
    match off < 0.0 {
        true => Verdict::of(-off, lower.max(poor), lower + power.uncertainty),
        false => Verdict::of(off, upper.max(poor), upper + power.uncertainty),
    }
}

/// The order, from error against evaluations: of short runs, or of the long ones where those are
/// not answered.
pub fn order(ladder: &Ladder, claimed: Option<u32>) -> Measured<Finding> {
    counted(ladder)?;
    let (power, kept): (_, fn(Power, u32) -> Verdict) = match ladder.in_short {
        Some(power) => (power, kept_in_short),
        None => (ladder.order().ok_or_else(too_few)?, kept),
    };
    let verdict = claimed.map_or(Verdict::Unclaimed, |claimed| kept(power, claimed));
    Ok(of_power(PowerOf::Error, power, claimed, verdict))
}

/// Whether this power of short runs is that of an order: those of right methods are not less, but
/// for what a line is not sure of, and those of the next order below come to 0.6 less.
fn kept_in_short(power: Power, claimed: u32) -> Verdict {
    let less = f64::from(claimed) - power.value;
    let holds = below(claimed).max(power.uncertainty.min(0.4));
    Verdict::of(less, holds, holds.max(power.uncertainty))
}

/// Whether this power is that of an order. More than is claimed is no complaint; less that may as
/// well be the next order below decides nothing.
fn kept(power: Power, claimed: u32) -> Verdict {
    let less = f64::from(claimed) - power.value;
    let is_next = less + power.uncertainty >= 1.0;
    match by_claim(power, claimed) {
        _ if less < 0.0 => Verdict::Holds,
        Verdict::Holds if less > below(claimed) && is_next => Verdict::Unclear,
        other => other,
    }
}

/// The smallest error that it comes to; of a solver in single precision, whether rounding can make
/// it.
pub fn precision(ladder: &Ladder) -> Finding {
    let least = ladder.rungs.iter().map(Rung::largest).fold(f64::INFINITY, f64::min);
    let ends: Vec<_> = ladder.rungs.iter().flat_map(|rung| rung.ends).collect();
    if let (true, Some(last)) = (ladder.scenes.coarser() > 1.0, ladder.rungs.last()) {
        let bound = ladder.scenes.rounding(last.a_run());
        let verdict = Verdict::of(least, bound, 10.0 * bound);
        return Finding {
            measurement: Measurement::OfSolver(OfSolver::LeastInSingle),
            ..Finding::number(least, "rad", bound, verdict)
        };
    }
    let single = single(&ends);
    Finding {
        measurement: Measurement::OfSolver(OfSolver::Least { single }),
        values: vec![least],
        unit: "rad",
        verdict: if single { Verdict::Fails } else { Verdict::Holds },
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
    Ok(Finding {
        measurement: Measurement::OfSolver(OfSolver::Effort),
        values,
        verdict: Verdict::Unclaimed,
        ..Finding::default()
    })
}

/// What it is.
pub fn description(ladder: &Ladder) -> Description {
    let power = |power: Option<Power>| power.map(Power::numbers);
    let order = ladder.in_short.or(ladder.order());
    Description::Solver { order: power(order), estimate: power(ladder.estimate()) }
}
