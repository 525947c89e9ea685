//! Order: the slopes of the error on a ladder of steps, down to the integrator's rounding.

use super::probe::{G_OVER_L, Probe, distance, exact, frequency};
use super::verdict::{Measured, Trouble, Verdict};
use crate::finding::{Finding, Measurement, Slopes};
use crate::integrator::Request;
use pendula::systems::Phase;

/// The duration of a run (s): about a swing and a half, and no whole number of half swings, at
/// which symmetry would hide errors.
pub const DURATION: f64 = 2.7;

/// Beyond this order a claim makes the ladder no finer: its rungs would lie closer than the whole
/// numbers of steps that they stand for, and nobody claims more than 24 of a method that is known
/// here.
const STEEPEST: u32 = 32;

/// So many rungs in a row may lie beneath rounding before the ladder ends.
const PASSING: usize = 2;

/// The runs of a rung. The leading term may vanish at one start and not at both.
pub const STARTS: [Phase; 2] = [Phase::at_rest(1.0), Phase { theta: -0.6, omega: 4.0 }];

/// Steps, errors and what they show.
#[derive(Clone, Debug)]
pub struct Ladder {
    /// Steps (s), from coarse to fine, and the largest error of the state (rad).
    pub rungs: Vec<(f64, f64)>,
    /// The slopes between neighbours, as far as both are truncation and not rounding.
    pub slopes: Vec<f64>,
    /// Where slopes are those of the leading term: from this index on.
    pub leading: usize,
}

/// The largest error in runs of so many steps from `starts` (rad), as far as each `every`-th state
/// shows it.
pub fn error(probe: &Probe<'_>, starts: &[Phase], steps: u64, every: u64) -> Measured<f64> {
    let mut largest = 0.0_f64;
    for &start in starts {
        let h = DURATION / steps as f64;
        let steps = steps - steps % every;
        let truth = exact(G_OVER_L, start);
        let states = probe.states(Request::run(start, h, steps).every(every))?;
        for (k, z) in (1..).zip(states) {
            largest = libm::fmaximum(largest, distance(z, truth.at((k * every) as f64 * h)));
        }
    }
    Ok(largest)
}

/// Makes the step shorter, by a factor that lets an error of order `expected` fall sixteenfold at
/// most, until the error is rounding or a run would be too long.
///
/// An error is taken for truncation while it is at least 30 times what rounding adds up to: a slope
/// is then bent by less than log₂(1 + 1/30) = 0.05.
pub fn ladder(probe: &Probe<'_>, expected: u32) -> Measured<Ladder> {
    const LONGEST: u64 = 1 << 14;
    let order = f64::from(expected.max(1));
    let factor = libm::exp2((4.0 / order.min(f64::from(STEEPEST))).min(1.0));
    let mut rungs: Vec<(f64, f64)> = Vec::new();
    let mut steps = if expected > 8 { 6.0 } else { 8.0 };
    let longest = LONGEST.min(probe.in_time(LONGEST).unwrap_or(LONGEST / 10));
    let mut unanswered = None;
    let (mut before, mut beneath) = (0, 0);
    while steps <= longest as f64 {
        let n = libm::round(steps) as u64;
        steps *= factor;
        // Of the short ladders of high orders several rungs may be one.
        if n == before {
            continue;
        }
        before = n;
        match error(probe, &STARTS, n, 1.max(n / 64)) {
            Ok(error) => rungs.push((DURATION / n as f64, error)),
            // Too long a step for an implicit method, or for a method that runs away.
            Err(trouble @ (Trouble::NoAnswer(_) | Trouble::Lost(_) | Trouble::NotFinite))
                if rungs.is_empty() =>
            {
                unanswered = Some(trouble);
                continue;
            }
            Err(trouble) => return Err(trouble),
        }
        unanswered = None;
        let (_, last) = rungs[rungs.len() - 1];
        let x = frequency() * DURATION / n as f64;
        // An error passes zero where a term of lower order has the other sign, and is there again
        // in the next rungs.
        // By far more than rounding: what rounds coarsely may be a little above it by chance.
        let times = if beneath > 0 { 30.0 } else { 3.0 };
        beneath = if last < times * probe.bound(n, x) { beneath + 1 } else { 0 };
        if beneath > PASSING {
            break;
        }
    }
    rungs.truncate(rungs.len() - beneath);
    if let Some(trouble) = unanswered {
        return Err(trouble);
    }
    let slopes: Vec<f64> = rungs
        .windows(2)
        .map(|pair| libm::log(pair[0].1 / pair[1].1) / libm::log(pair[0].0 / pair[1].0))
        .collect();
    // The leading term dominates where the next, smaller by a power of x and so by about the p-th
    // root of the error, is at most a thirtieth.
    let small = libm::pow(0.03, order).max(if expected > 8 { 1e-5 } else { 1e-7 });
    let short = |h: f64| frequency() * h < 1.4;
    let leading = rungs.iter().position(|rung| short(rung.0) && rung.1 < small);
    let leading = leading.unwrap_or(rungs.len());
    let leading = leading.min(slopes.len().saturating_sub(2));
    Ok(Ladder { rungs, slopes, leading })
}

/// The order that the finest slopes show, if they agree on a whole number.
pub fn shown(ladder: &Ladder) -> Option<u32> {
    let finest = &ladder.slopes[ladder.leading..];
    let last = *finest.last()?;
    let whole = libm::round(last);
    let window = if whole > 8.0 { 3.0 } else { 0.15 };
    (whole >= 0.0 && finest.iter().rev().take(2).all(|slope| (slope - whole).abs() < window))
        .then_some(whole as u32)
}

/// What is to be said of a claim of order `claimed`, of a method that is `known` to be of an order,
/// if it is; without a claim, what was measured.
pub fn judge(ladder: &Ladder, claimed: Option<u32>, known: Option<u32>) -> Finding {
    let (verdict, slopes) = match claimed {
        Some(order) => match (verdict(ladder, order), known) {
            ((Verdict::Unclear, _), Some(known)) => {
                let verdict = if known >= order { Verdict::Holds } else { Verdict::Fails };
                (verdict, Slopes::OfMethod(known))
            }
            (told, _) => told,
        },
        None => (Verdict::Unclaimed, Slopes::Unclaimed),
    };
    let (measurement, values) = (Measurement::Slopes(slopes), ladder.slopes.clone());
    Finding { measurement, values, verdict, ..Finding::default() }
}

/// The verdict on a claim of order `claimed`, and why.
pub fn verdict(ladder: &Ladder, claimed: u32) -> (Verdict, Slopes) {
    let order = f64::from(claimed);
    let Ladder { rungs, slopes, leading } = ladder;
    let finest = &slopes[*leading..];
    let Some(&last) = finest.last() else {
        return (Verdict::Unclear, Slopes::TooFew);
    };
    if claimed > 8 {
        return high(ladder, claimed);
    }
    let off = |slope: &f64| (slope - order).abs();
    let nearest = finest.iter().map(off).fold(f64::INFINITY, f64::min);
    // The next term bends a slope by less with every finer step. Of a method that is not symmetric
    // it is smaller by one power of x only, and by no small factor where the method was designed
    // for a small first term: Dormand and Prince's bends its slopes by 1.4 x.
    let x = frequency() * rungs[rungs.len() - 1].0;
    let bent = if claimed > 4 { 1.5 * x } else { 0.0 };
    // A slope that leaves the order again, by more than rounding can bend it, is that of a lower
    // order which comes to the fore.
    if nearest < 0.05 && last < order - 0.2 - bent {
        return (Verdict::Fails, Slopes::Leave);
    }
    if off(&last) <= 0.2 + bent {
        return (Verdict::Holds, Slopes::Tend);
    }
    if let Some(verdict) = beyond(ladder, claimed, order) {
        return verdict;
    }
    if last > order && comes_down(ladder, order) {
        return (Verdict::Holds, Slopes::ComeDown);
    }
    // Errors that do not fall, and are as small as a solver's tolerance, tell nothing of an order.
    let largest = rungs.iter().map(|rung| rung.1).fold(0.0, f64::max);
    if largest < 1e-8 && last < 0.5 {
        return (Verdict::Unclear, Slopes::NoFall);
    }
    // More than an order too low twice, by errors that are no rounding: not on its way.
    let low = |slope: &f64| *slope < order - 1.5 - bent;
    if finest.len() >= 2 && finest[finest.len() - 2..].iter().all(low) {
        return (Verdict::Fails, Slopes::Low(last));
    }
    let moved = finest.len() < 2 || (last - finest[finest.len() - 2]).abs() > 0.1;
    let towards = moved && off(&last) < off(&finest[finest.len().saturating_sub(2)]);
    // Settled on another whole number.
    let whole = libm::round(last);
    let elsewhere = !moved && whole != order && (last - whole).abs() < 0.08;
    let settled = !moved || finest.iter().rev().take(2).all(|s| *s < order - 0.5 - bent);
    // One slope alone, between long steps and rounding, has settled on nothing.
    if elsewhere || (finest.len() >= 2 && last < order && !towards && settled) {
        (Verdict::Fails, Slopes::Settled(last))
    } else {
        (Verdict::Unclear, Slopes::Between(last))
    }
}

/// Whether the finest slopes fall towards the order, as far as their rungs tell: where a method is
/// designed for a small first term, the second bends the slopes by s xᵏ, with k = 2 if it is
/// symmetric and k = 1 if not, and the first term alone comes to the fore at errors near rounding.
/// So what two slopes tend to is within the 0.2 that one slope may be off by, or above: an error
/// that falls faster than is claimed keeps the claim. Of the two, k = 1 tends to less.
fn comes_down(Ladder { rungs, slopes, leading }: &Ladder, order: f64) -> bool {
    let finest = slopes.len() - 1;
    if finest < leading + 1 || slopes[finest] >= slopes[finest - 1] {
        return false;
    }
    [1, 2].into_iter().any(|k| {
        let factor = libm::pow(rungs[finest - 1].0 / rungs[finest].0, f64::from(k));
        let limit = (factor * slopes[finest] - slopes[finest - 1]) / (factor - 1.0);
        (limit - order).abs() <= 0.2 || (k == 1 && limit > order)
    })
}

/// The verdict where no order is claimed that would have to be told from its neighbours: of errors
/// that grow as the steps become short, and of a method that is better than claimed.
fn beyond(ladder: &Ladder, claimed: u32, order: f64) -> Option<(Verdict, Slopes)> {
    let Ladder { rungs, slopes, leading } = ladder;
    let grows = |pair: &[(f64, f64)]| pair[1].1 > 1.1 * pair[0].1;
    if rungs.len() >= 4 && rungs[rungs.len() - 4..].windows(2).all(grows) {
        return Some((Verdict::Fails, Slopes::Grows));
    }
    // At least two slopes are half an order steeper, and none less than what is claimed.
    let finest = &slopes[*leading..];
    let steep = finest.len() >= 2 && finest[finest.len() - 2..].iter().all(|s| *s > order + 0.5);
    let shown = shown(ladder).filter(|shown| *shown > claimed)?;
    steep.then_some((Verdict::Holds, Slopes::Better { shown, claimed }))
}

/// The same beyond order 8. At steps that are not short against the motion's own time an error is
/// between half and twice its leading term, and a slope over the factor f in the step is uncertain
/// by ln 4 / ln f.
fn high(Ladder { rungs, leading, .. }: &Ladder, claimed: u32) -> (Verdict, Slopes) {
    let order = f64::from(claimed);
    let last = rungs[rungs.len() - 1];
    let first = rungs[(*leading).max(rungs.len().saturating_sub(4))];
    let factor = libm::log(first.0 / last.0);
    let (slope, window) = (libm::log(first.1 / last.1) / factor, libm::log(4.0) / factor);
    let off = (slope - order).abs();
    let verdict = if window > order / 4.0 {
        Verdict::Unclear
    } else {
        Verdict::of(off, window, 2.0 * window)
    };
    (verdict, Slopes::Long { order: claimed, slope, window })
}
