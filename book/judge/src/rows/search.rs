//! Which candidates make the rows, with which numbers and how many steps from row to row.

use super::candidates::{Candidate, Equation, all};
use super::fit::{
    Active, Applied, Data, Fit, Map, Pair, exact_within, first_guess, fit, mean, worst,
};
use super::report::Force;

/// A candidate that is off by more than this many bounds is another one.
pub const APART: f64 = 10.0;
/// More steps from row to row than this are not looked for.
pub const MOST_STEPS: u32 = 100;
/// As many pairs decide between candidates.
const PAIRS: usize = 120;
/// As many are enough to see whether one is worth a fit.
const FEW: usize = 16;
/// As many that agree are enough to say that they cannot be told apart.
const ENOUGH: usize = 6;
/// So many steps are fitted for every candidate, as what they lead to may be far from the motion.
const CRUDE: u32 = 4;
/// What most programs have.
const USUAL: [&str; 8] = [
    "rk4",
    "stormer-verlet",
    "position-verlet",
    "symplectic-euler",
    "heun",
    "explicit-midpoint",
    "forest-ruth",
    "dormand-prince-5",
];
/// Numbers of steps at which it is looked what a candidate's error is.
const LADDER: [u32; 20] = [1, 2, 3, 4, 5, 6, 7, 8, 10, 12, 14, 17, 20, 25, 32, 40, 50, 64, 80, 100];

/// What the exact motion makes of the rows.
#[derive(Clone, Debug)]
pub struct Motion {
    /// The fit by the exact motion.
    pub fit: Fit,
    /// How far off its pairs are, as a fraction of what they move.
    pub fraction: f64,
    /// How far off half of the pairs are at most: a few bad rows do not count.
    pub middle: f64,
}

/// What is left.
#[derive(Clone, Debug, Default)]
pub struct Found {
    /// Fits that agree, the nearest first.
    pub agree: Vec<Fit>,
    /// Fits that do not, and are not ten times as far off.
    pub near: Vec<Fit>,
    /// The nearest of all that do not agree.
    pub nearest: Option<Fit>,
    /// From how far to how far the pairs go that were compared, in rows.
    pub lag: u32,
    /// Whether the exact motion is not ten times as far off as what is found.
    pub exact: bool,
    /// The exact motion, if it agrees.
    pub motion: Option<Fit>,
}

/// Which numbers are fitted.
pub fn active(data: &Data, damped: bool, driven: bool) -> Active {
    let loose = data.spacing_known_to > 1e-10 * data.spacing;
    [true, damped, loose && data.has_velocities(), driven, driven, driven]
}

/// Fits the exact motion of each force; the best first.
pub fn motions(data: &Data, driven: Option<[f64; 3]>) -> Vec<Motion> {
    let pairs = data.pairs(1, 40);
    let numbers = active(data, true, driven.is_some());
    let whole = |fit: Fit| {
        let fit = robust(fit, data, &pairs, &numbers);
        let here = applied(data, &fit);
        let off = here.off(&pairs, &here.bounds(&pairs));
        let mut sizes: Vec<f64> = off.iter().map(|x| x.abs()).collect();
        sizes.sort_by(f64::total_cmp);
        let middle = sizes.get(sizes.len() / 2).copied().unwrap_or(f64::INFINITY);
        Motion { fraction: fraction(data, &fit, &pairs), middle, fit }
    };
    let of = |force| {
        let equation = Equation { drive: driven.unwrap_or([0.0; 3]), ..first_guess(data, force) };
        let from = Applied { data, map: Map::Exact, equation, stretch: 1.0 };
        fit(from, &pairs, &numbers, false).map(whole)
    };
    let mut found: Vec<Motion> = Force::ALL.into_iter().filter_map(of).collect();
    // Rows that are far apart: no difference of two rows is near a rate.
    let bad = found.iter().all(|motion| motion.fraction.is_nan() || motion.fraction >= 0.01);
    if bad && data.has_velocities() && driven.is_none() {
        let scan = |force| from_a_scan(data, force, &numbers).map(whole);
        found.extend([Force::Sine, Force::Linear].into_iter().filter_map(scan));
    }
    found.sort_by(|a, b| a.middle.total_cmp(&b.middle));
    // The sine and the angle itself are what programs have: another only where it is much nearer.
    let usual = |motion: &Motion| matches!(motion.fit.equation.force, Force::Sine | Force::Linear);
    let best = found.iter().find(|motion| usual(motion)).map_or(f64::INFINITY, |x| x.fit.mean);
    let limit = 0.3 * libm::fmax(best, 3.0);
    let mut seen = Vec::new();
    found.retain(|motion| {
        let new = !seen.contains(&motion.fit.equation.force);
        seen.push(motion.fit.equation.force);
        new
    });
    found.retain(|motion| usual(motion) || motion.fit.mean < limit);
    found
}

/// The fit without the pairs that are far worse than the others, again until there are none.
fn robust(first: Fit, data: &Data, pairs: &[Pair], numbers: &Active) -> Fit {
    let entries = data.entries();
    let mut best = first;
    for _ in 0..4 {
        let here = applied(data, &best);
        let off = here.off(pairs, &here.bounds(pairs));
        let mut sizes: Vec<f64> = off.iter().map(|x| x.abs()).filter(|x| x.is_finite()).collect();
        sizes.sort_by(f64::total_cmp);
        let Some(&middle) = sizes.get(sizes.len() / 2) else { return best };
        let limit = 6.0 * libm::fmax(middle, 0.5);
        let near = |i: &usize| off[i * entries..(i + 1) * entries].iter().all(|x| x.abs() <= limit);
        let good: Vec<Pair> = (0..pairs.len()).filter(near).map(|i| pairs[i]).collect();
        if good.len() == pairs.len() || good.len() * 4 < pairs.len() * 3 {
            return best;
        }
        match fit(here, &good, numbers, false) {
            Some(fit) => best = fit,
            None => return best,
        }
    }
    best
}

/// Each k is tried.
fn from_a_scan(data: &Data, force: Force, numbers: &Active) -> Option<Fit> {
    let pairs = data.pairs(1, 12);
    let square = data.spacing * data.spacing;
    let mut tried: Vec<(f64, f64)> = (0..240)
        .map(|n| {
            let k = 0.05 * libm::pow(1.03, f64::from(n)) / square;
            let equation = Equation { force, k, c: 0.0, drive: [0.0; 3] };
            let here = Applied { data, map: Map::Exact, equation, stretch: 1.0 };
            let off = pairs.iter().flat_map(|pair| {
                let [a, b] = here.residual(pair);
                [a, b / libm::sqrt(k)]
            });
            (mean(&off.collect::<Vec<_>>()), k)
        })
        .filter(|(off, _)| off.is_finite())
        .collect();
    tried.sort_by(|a, b| a.0.total_cmp(&b.0));
    let more = data.pairs(1, 40);
    let fits = tried.iter().take(3).filter_map(|&(_, k)| {
        let equation = Equation { force, k, c: 0.0, drive: [0.0; 3] };
        fit(Applied { data, map: Map::Exact, equation, stretch: 1.0 }, &more, numbers, false)
    });
    fits.min_by(|a, b| a.mean.total_cmp(&b.mean))
}

/// How far off pairs are, as a fraction of how far the states move.
fn fraction(data: &Data, fit: &Fit, pairs: &[Pair]) -> f64 {
    let here = applied(data, fit);
    let (mut off, mut moved) = (0.0, 0.0);
    for pair in pairs {
        let [i, j, k] = pair.rows;
        let residual = here.residual(pair);
        if !(residual[0].is_finite() && residual[1].is_finite()) {
            return f64::INFINITY;
        }
        if data.has_velocities() {
            let rate = libm::fmax(fit.equation.rate(), 1e-9);
            let [a, b] = [data.theta[k] - data.theta[i], data.omega[k] - data.omega[i]];
            off += residual[0] * residual[0] + residual[1] * residual[1] / (rate * rate);
            moved += a * a + b * b / (rate * rate);
        } else {
            let bend = data.theta[i] - 2.0 * data.theta[j] + data.theta[k];
            off += residual[0] * residual[0];
            moved += bend * bend;
        }
    }
    libm::sqrt(off / moved)
}

/// A fit as a map on the data.
pub fn applied<'a>(data: &'a Data, fit: &Fit) -> Applied<'a> {
    Applied { data, map: fit.map, equation: fit.equation, stretch: fit.stretch }
}

/// How many rows to go from one of a pair to the other: as few as show the exact motion to be wrong
/// by thirty bounds, or else as many as can be had.
fn lag(data: &Data, motion: &Motion) -> u32 {
    let here = applied(data, &motion.fit);
    let rate = here.equation.rate() * data.spacing;
    let mut chosen = 1;
    for lag in [1_u32, 3, 10, 30, 100, 300] {
        let pairs = data.pairs(lag, FEW);
        let time = f64::from(lag) * rate;
        // Without velocities two angles half a swing apart do not say what is between them.
        let too_long = if data.has_velocities() { time > 30.0 } else { time > 1.0 };
        if lag > 1 && (too_long || pairs.len() < FEW / 2 || lag as usize * 4 > data.row.len()) {
            break;
        }
        let bounds = here.bounds(&pairs);
        // Beyond that a bound by the derivative is none.
        if lag > 1 && worst(&bounds) >= 0.03 {
            break;
        }
        chosen = lag;
        // Fitted: numbers that are a little wrong add up.
        let numbers = active(data, true, here.equation.drive[2] != 0.0);
        if fit(here, &pairs, &numbers, false).is_none_or(|fit| fit.mean > 15.0) {
            break;
        }
    }
    chosen
}

/// Searches all candidates about one motion.
pub fn search(data: &Data, motion: &Motion, found: &mut Found) {
    let lag = lag(data, motion);
    found.lag = found.lag.max(lag);
    let driven = motion.fit.equation.drive[2] != 0.0;
    let damped = motion.fit.equation.c > 0.0;
    let numbers = active(data, true, driven);
    let few = data.pairs(lag, FEW);
    let many = data.pairs(lag, PAIRS);
    // The exact motion over these spans.
    let Some(whole) = fit(applied(data, &motion.fit), &few, &numbers, false) else { return };
    let here = applied(data, &whole);
    if let Some(best) = best_of(data, Map::Exact, here.equation, &many, &numbers) {
        // What the exact motion is not ten times as far off as is no method's alone.
        found.exact |= best.worst < APART;
        found.motion = found.motion.or(Some(best).filter(|fit| fit.worst < APART));
    }
    let base = here.linear(&few, &numbers, here.bounds(&few));
    let flat = Flat::new(&base.slopes);
    let away = flat.project(&base.off);
    let distance = mean(&away);
    let moved = mean(&here.moves(&few, &base.bounds));
    let mut wanted: Vec<(f64, &'static Candidate, u32)> = Vec::new();
    // Where the exact motion agrees some examples are enough.
    let looked_at = |candidate: &&Candidate| {
        candidate.suits(damped, driven) && (!found.exact || USUAL.contains(&candidate.name))
    };
    for candidate in all().iter().filter(looked_at) {
        if candidate.older() > 0 {
            if data.has_velocities() {
                wanted.push((0.0, candidate, 1));
            }
            continue;
        }
        let mut before: Option<(u32, Vec<f64>)> = None;
        for steps in LADDER {
            let map = Map::Steps(candidate, steps);
            let there = Applied { map, ..here };
            let off = there.off(&few, &base.bounds);
            if !worst(&off).is_finite() {
                continue;
            }
            let error: Vec<f64> = base.off.iter().zip(&off).map(|(a, b)| a - b).collect();
            let error = flat.project(&error);
            let left: Vec<f64> = away.iter().zip(&error).map(|(a, b)| a - b).collect();
            let left = mean(&left);
            // What is found to the first order in the numbers is improved by a fit: by how much,
            // goes with how large the error is.
            let crude = mean(&error) / moved;
            let worth = crude > 0.01 && lag == 1 && steps <= CRUDE;
            if worth || left <= libm::fmax(3.0, (0.1 + 20.0 * crude).min(0.6) * distance) {
                wanted.push((left, candidate, steps));
            }
            let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
            let ee = dot(&error, &error);
            if libm::sqrt(ee / error.len() as f64) < 0.03 {
                break;
            }
            // Short steps: the error keeps its direction, and goes with a power of their number.
            // So it is known with how many steps it would be that of the rows.
            if let Some((fewer, old)) = before.as_ref().filter(|_| crude < 0.02) {
                let oo = dot(old, old);
                if dot(old, &error) > 0.98 * libm::sqrt(oo * ee) {
                    let power =
                        0.5 * libm::log(oo / ee) / libm::log(f64::from(steps) / f64::from(*fewer));
                    let ratio = dot(&away, &error) / ee;
                    let along = ratio * libm::sqrt(ee / dot(&away, &away));
                    if power > 0.3 && along > 0.6 && ratio < 1.0 {
                        let middle = f64::from(steps) * libm::pow(ratio, -1.0 / power);
                        // Far from there the power itself still changes.
                        if middle > 2.5 * f64::from(steps) && middle < 1e3 {
                            before = Some((steps, error));
                            continue;
                        }
                        let spread = libm::ceil(0.03 * middle) as u32;
                        let middle = libm::round(middle) as u32;
                        let about = middle.saturating_sub(spread).max(steps + 1)..=middle + spread;
                        let about = about.filter(|&n| n <= MOST_STEPS);
                        wanted.extend(about.map(|n| (0.0, candidate, n)));
                    } else if along > 0.6 && ratio < 1.0 {
                        before = Some((steps, error));
                        continue;
                    }
                    break;
                }
            }
            before = Some((steps, error));
        }
    }
    wanted.sort_by(|a, b| a.0.total_cmp(&b.0));
    if found.exact {
        wanted.sort_by_key(|(_, candidate, steps)| (!candidate.right, *steps));
        wanted.truncate(2 * ENOUGH);
    }
    for (_, candidate, steps) in wanted {
        // Where the exact motion agrees, every method does that is accurate enough.
        if found.exact && found.agree.len() >= ENOUGH {
            break;
        }
        let map = Map::Steps(candidate, steps);
        // Few pairs say whether all are worth it.
        // The older states of a method of several steps are not there in the first rows.
        let with_past = |most| {
            let mut pairs = data.pairs(lag, most);
            pairs.retain(|pair| pair.rows[0] >= candidate.older());
            pairs
        };
        let pairs = if candidate.older() > 0 { with_past(FEW) } else { few.clone() };
        let free = Equation { c: 0.0, ..here.equation };
        let from = |equation| fit(Applied { map, equation, ..here }, &pairs, &numbers, false);
        let mut first = from(here.equation);
        if first.is_none_or(|fit| fit.mean > APART) && steps <= CRUDE {
            let again = from(free).filter(|fit| first.is_none_or(|old| fit.mean < old.mean));
            first = again.or(first);
        }
        let Some(first) = first else { continue };
        if first.mean > 3.0 {
            if first.worst < APART {
                found.near.push(first);
            } else {
                keep(&mut found.nearest, first);
            }
            continue;
        }
        let pairs = if candidate.older() > 0 {
            with_past(PAIRS)
        } else if found.exact {
            few.clone()
        } else {
            many.clone()
        };
        let Some(best) = best_of(data, map, first.equation, &pairs, &numbers) else { continue };
        if best.worst <= 1.0 {
            found.agree.push(best);
        } else if best.worst < APART {
            found.near.push(best);
        } else {
            keep(&mut found.nearest, best);
        }
    }
    for list in [&mut found.agree, &mut found.near] {
        list.sort_by(|a, b| a.worst.total_cmp(&b.worst));
        let mut seen: Vec<(&str, u32, Force)> = Vec::new();
        list.retain(|fit| {
            let Map::Steps(candidate, steps) = fit.map else { return true };
            let key = (candidate.name, steps, fit.equation.force);
            let new = !seen.contains(&key);
            seen.push(key);
            new
        });
    }
}

/// Compares what is left over more rows, in which the methods' errors add up and the digits' do not
/// as fast, until one is left or no more rows can be had.
pub fn sharpen(data: &Data, found: &mut Found) {
    for _ in 0..3 {
        let lag = 5 * found.lag;
        let Some(best) = found.agree.first().copied() else { return };
        let here = applied(data, &best);
        let time = f64::from(lag) * data.spacing * here.equation.rate();
        let too_long = if data.has_velocities() { time > 30.0 } else { time > 1.0 };
        let pairs = data.pairs(lag, 2 * FEW);
        let short = pairs.len() < FEW || lag as usize * 3 > data.row.len();
        let one = found.agree.len() == 1 && found.near.is_empty();
        if one || found.exact || too_long || short || worst(&here.bounds(&pairs)) >= 0.03 {
            return;
        }
        found.lag = lag;
        let numbers = active(data, true, here.equation.drive[2] != 0.0);
        let all: Vec<Fit> = found.agree.drain(..).chain(found.near.drain(..)).collect();
        for fit in all {
            let older = match fit.map {
                Map::Steps(candidate, _) => candidate.older(),
                Map::Exact => 0,
            };
            let mut pairs = pairs.clone();
            pairs.retain(|pair| pair.rows[0] >= older);
            match best_of(data, fit.map, fit.equation, &pairs, &numbers) {
                Some(best) if best.worst <= 1.0 => found.agree.push(best),
                Some(best) if best.worst < APART => found.near.push(best),
                Some(best) => keep(&mut found.nearest, best),
                None => {}
            }
        }
    }
}

fn keep(nearest: &mut Option<Fit>, fit: Fit) {
    if nearest.as_ref().is_none_or(|old| fit.worst < old.worst) {
        *nearest = Some(fit);
    }
}

/// The fit without a drag where a drag would have to be negative, and with its largest residual
/// made small where that may decide.
pub fn best_of(
    data: &Data,
    map: Map,
    equation: Equation,
    pairs: &[Pair],
    numbers: &Active,
) -> Option<Fit> {
    let from = Applied { data, map, equation, stretch: 1.0 };
    let mut best = fit(from, pairs, numbers, false)?;
    let mut numbers = *numbers;
    // Of no drag, or of one that is no number of the rows, nothing is left but zero.
    if best.equation.c < best.known_to[1] {
        let plain = [numbers[0], false, numbers[2], numbers[3], numbers[4], numbers[5]];
        let without = Applied { equation: Equation { c: 0.0, ..best.equation }, ..from };
        let undamped = fit(without, pairs, &plain, false);
        if best.equation.c < 0.0 || undamped.is_some_and(|fit| fit.worst <= 1.0) {
            best = undamped?;
            numbers = plain;
        }
    }
    if best.worst > 1.0 && best.mean < APART {
        let even = fit(applied(data, &best), pairs, &numbers, true);
        if let Some(even) = even.filter(|even| even.worst < best.worst) {
            best = Fit { known_to: best.known_to, ..even };
        }
    }
    Some(best)
}

/// Directions that a change of the numbers can take, made square to each other.
struct Flat(Vec<Vec<f64>>);

impl Flat {
    fn new(slopes: &[Vec<f64>]) -> Self {
        let mut flat = Self(Vec::new());
        for slope in slopes {
            let mut left = flat.project(slope);
            let norm = |x: &[f64]| libm::sqrt(x.iter().map(|x| x * x).sum::<f64>());
            let (before, after) = (norm(slope), norm(&left));
            if after > 1e-7 * before && after.is_finite() {
                left.iter_mut().for_each(|x| *x /= after);
                flat.0.push(left);
            }
        }
        flat
    }

    /// What no change of the numbers makes.
    fn project(&self, x: &[f64]) -> Vec<f64> {
        let mut left = x.to_vec();
        // Twice, as the first leaves rounding.
        for _ in 0..2 {
            for direction in &self.0 {
                let along: f64 = left.iter().zip(direction).map(|(a, b)| a * b).sum();
                left.iter_mut().zip(direction).for_each(|(a, b)| *a -= along * b);
            }
        }
        left
    }
}

/// Whether one fit's map is another's on these rows, whatever its numbers are: then these are said.
///
/// The one's steps, in doubles, are given to the other as rows.
pub fn same(data: &Data, one: &Fit, other: &Fit) -> Option<f64> {
    let here = applied(data, one);
    let Map::Steps(candidate, steps) = other.map else { return None };
    let Map::Steps(own, _) = one.map else { return None };
    if candidate.older() > 0 || own.older() > 0 {
        return None;
    }
    let mut rows =
        Data { spacing: data.spacing, even: false, start: data.start, ..Data::default() };
    for (n, pair) in data.pairs(1, 12).iter().enumerate() {
        let [i, j, _] = pair.rows;
        let omega = match data.omega.get(i) {
            Some(omega) => *omega,
            None => here.velocity(pair, data.theta[i], data.theta[j])?,
        };
        let t = data.t[i];
        let z = [data.theta[i], omega];
        let end = here.advance(t, z, data.spacing, 1);
        for (t, z) in [(t, z), (t + data.spacing * one.stretch, end)] {
            rows.row.push(rows.row.len());
            // Every second pair of rows is none.
            rows.at.push(3 * n as i64 + (rows.row.len() as i64 - 1) % 2);
            rows.t.push(t);
            rows.theta.push(z[0]);
            rows.omega.push(z[1]);
            rows.half_theta.push(0.0);
            rows.half_omega.push(0.0);
        }
    }
    let pairs = rows.pairs(1, usize::MAX);
    let map = Map::Steps(candidate, steps);
    let driven = one.equation.drive[2] != 0.0;
    let mut numbers = active(&rows, one.equation.c != 0.0, driven);
    numbers[2] = false;
    let from = Applied { data: &rows, map, equation: other.equation, stretch: 1.0 };
    let best = fit(from, &pairs, &numbers, false)?;
    (best.worst <= 2.0).then_some(best.equation.k)
}

/// A drive that makes the undriven motion's misfit small: its a, b and Ω.
pub fn drive(data: &Data) -> Option<[f64; 3]> {
    let pairs = data.pairs(1, 600);
    let mut rows = Vec::new();
    for pair in &pairs {
        let [i, j, k] = pair.rows;
        let th = &data.theta;
        let (t, bend, force, rate) = if data.has_velocities() {
            let span = data.t[j] - data.t[i];
            let (a, b) = (data.omega[i], data.omega[j]);
            let t = 0.5 * (data.t[i] + data.t[j]);
            (t, (b - a) / span, 0.5 * (libm::sin(th[i]) + libm::sin(th[j])), 0.5 * (a + b))
        } else {
            let span = data.t[j] - data.t[i];
            let bend = (th[i] - 2.0 * th[j] + th[k]) / (span * span);
            (data.t[j], bend, libm::sin(th[j]), (th[k] - th[i]) / (2.0 * span))
        };
        rows.push([t, bend, -force, -rate]);
    }
    let length = data.t.last()? - data.t.first()?;
    let misfit = |frequency: f64| {
        let columns: Vec<Vec<f64>> = vec![
            rows.iter().map(|x| x[2]).collect(),
            rows.iter().map(|x| x[3]).collect(),
            rows.iter().map(|x| libm::cos(frequency * x[0])).collect(),
            rows.iter().map(|x| libm::sin(frequency * x[0])).collect(),
        ];
        let bends: Vec<f64> = rows.iter().map(|x| x[1]).collect();
        let flat = Flat::new(&columns);
        (mean(&flat.project(&bends)), columns, bends)
    };
    let highest = 1.5 / data.spacing;
    let lowest = 1.0 / length;
    let count = ((highest - lowest) * length * 2.0).clamp(50.0, 3000.0) as usize;
    let at = |i: usize| lowest + (highest - lowest) * i as f64 / count as f64;
    let best = (0..=count).map(|i| (misfit(at(i)).0, i)).min_by(|a, b| a.0.total_cmp(&b.0))?;
    let (mut low, mut high) = (at(best.1.saturating_sub(1)), at(best.1 + 1));
    for _ in 0..40 {
        let (a, b) = (low + (high - low) * 0.4, low + (high - low) * 0.6);
        if misfit(a).0 < misfit(b).0 { high = b } else { low = a }
    }
    let frequency = 0.5 * (low + high);
    let (left, columns, bends) = misfit(frequency);
    let without = mean(&Flat::new(&columns[..2]).project(&bends));
    if left > 0.3 * without {
        return None;
    }
    // a and b by least squares, as what the others leave.
    let others = Flat::new(&columns[..2]);
    let [c, s] = [&columns[2], &columns[3]].map(|x| others.project(x));
    let target = others.project(&bends);
    let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(a, b)| a * b).sum::<f64>();
    let (cc, cs, ss) = (dot(&c, &c), dot(&c, &s), dot(&s, &s));
    let (ct, st) = (dot(&c, &target), dot(&s, &target));
    let det = cc * ss - cs * cs;
    Some([(ct * ss - st * cs) / det, (st * cc - ct * cs) / det, frequency])
}

/// The exact motion from the first row over all of the run: angle and velocity.
pub fn exact_end(equation: &Equation, start: f64, z: [f64; 2], time: f64) -> [f64; 2] {
    exact_within(equation, start, z, time, 1e8)
}

/// The fraction of a row of numbers that a combination of others does not explain.
pub fn unexplained(columns: &[Vec<f64>], of: &[f64]) -> f64 {
    mean(&Flat::new(columns).project(of)) / mean(of)
}

/// The equation by pairs that are about a sixth of a swing apart, in which noise counts less.
pub fn long_fit(data: &Data, motion: &Motion) -> Option<Fit> {
    let here = applied(data, &motion.fit);
    let lag = libm::round(1.0 / (here.equation.rate() * data.spacing)).clamp(1.0, 1000.0) as u32;
    let numbers = active(data, true, here.equation.drive[2] != 0.0);
    let mut fit = fit(here, &data.pairs(lag, 1000), &numbers, false)?;
    // The bounds are the digits', and what is left is more: what is known is so much worse.
    fit.known_to.iter_mut().for_each(|to| *to *= libm::fmax(1.0, fit.mean));
    Some(fit)
}

/// Mistakes that make the same rows as a fit with another k: of half the force, of a step squared
/// and the like.
pub fn relatives(data: &Data, best: &Fit, steps: u32) -> Vec<(String, f64)> {
    let h = data.spacing / f64::from(steps);
    let damped = best.equation.c > 0.0;
    let wrong = all().iter().filter(|one| !one.right && one.suits(damped, false));
    wrong
        .filter_map(|one| {
            [1.0, 0.5, 2.0, h, 1.0 / h].into_iter().find_map(|factor| {
                let equation = Equation { k: best.equation.k * factor, ..best.equation };
                let other = Fit { map: Map::Steps(one, steps), equation, ..*best };
                same(data, best, &other).map(|k| (one.name.to_string(), k))
            })
        })
        .collect()
}
