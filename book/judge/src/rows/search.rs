//! Which candidates make the rows, with which numbers and how many steps from row to row.

use super::candidates::{Candidate, Equation, all, work};
use super::fit::{
    Active, Applied, Data, Fit, Map, Pair, exact, first_guess, fit, mean, refine, worst,
};
use super::lanes::{cosine, sine};
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
/// A fit agrees that is off by no more bounds: what is left above 1 are numbers that are not quite
/// those that would make the worst pair least.
pub const AGREES: f64 = 1.1;
/// A candidate's error that is a larger part of what the states move is not judged to first order:
/// it is fitted.
const CRUDE: f64 = 0.01;
/// One that is a larger part is of another motion.
const FAR: f64 = 0.3;
/// More forces are not computed in a search: as many methods are near then that none can be told.
pub const MOST_WORK: u64 = 40_000_000;
/// As many are too many for a list.
const MANY: usize = 40;
/// Two maps are the same that differ by no more bounds, in doubles.
const LIKE: f64 = 2.0;
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
    /// Whether there are more that agree than were looked at.
    pub many: bool,
    /// The exact motion, if it is not ten times as far off.
    pub motion: Option<Fit>,
    /// In how many pairs at most all that agree were compared.
    pub compared: usize,
}

/// Which numbers are fitted.
pub fn active(data: &Data, damped: bool, driven: bool) -> Active {
    let loose = data.spacing_known_to > 1e-10 * data.spacing;
    [true, damped, loose && data.has_velocities(), driven, driven, driven]
}

/// Fits the exact motion of each of these forces; the best first.
pub fn motions(data: &Data, driven: Option<[f64; 3]>, forces: &[Force]) -> Vec<Motion> {
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
    let mut found: Vec<Motion> = forces.iter().filter_map(|&force| of(force)).collect();
    // Rows that are far apart: no difference of two rows is near a rate.
    let bad = found.iter().all(|motion| motion.fraction.is_nan() || motion.fraction >= 0.01);
    if bad && data.has_velocities() && driven.is_none() {
        let scan = |&force: &Force| from_a_scan(data, force, &numbers).map(whole);
        let usual = forces.iter().filter(|force| Force::USUAL.contains(force));
        found.extend(usual.filter_map(scan));
    }
    found.sort_by(|a, b| a.middle.total_cmp(&b.middle));
    let mut seen = Vec::new();
    found.retain(|motion| {
        let new = !seen.contains(&motion.fit.equation.force);
        seen.push(motion.fit.equation.force);
        new
    });
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
            let mut off = here.residuals(&pairs);
            // Of the velocities.
            off.iter_mut().skip(1).step_by(2).for_each(|x| *x /= libm::sqrt(k));
            (mean(&off), k)
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
    for (pair, residual) in pairs.iter().zip(here.residuals(pairs).chunks(data.entries())) {
        let [i, j, k] = pair.rows;
        if !residual.iter().all(|x| x.is_finite()) {
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

/// A candidate with a number of steps that is worth a fit, and how far off it seems.
struct Wanted {
    left: f64,
    candidate: &'static Candidate,
    steps: u32,
    /// The equation to begin with.
    equation: Equation,
}

/// The exact motion over some pairs, and all that candidates are held against there.
struct About<'a> {
    here: Applied<'a>,
    few: Vec<Pair>,
    bounds: Vec<f64>,
    /// How far off it is, in bounds.
    off: Vec<f64>,
    /// That without what other numbers would make of it.
    away: Vec<f64>,
    flat: Flat,
    moved: f64,
    numbers: Active,
}

impl<'a> About<'a> {
    fn new(here: Applied<'a>, few: Vec<Pair>, numbers: &Active) -> Self {
        let base = here.linear(&few, numbers, here.bounds(&few));
        let flat = Flat::new(&base.slopes);
        let away = flat.project(&base.off);
        let moved = mean(&here.moves(&few, &base.bounds));
        let numbers = *numbers;
        Self { here, few, bounds: base.bounds, off: base.off, away, flat, moved, numbers }
    }

    /// The steps of a candidate that are worth a fit.
    ///
    /// Of the maker, with its own numbers, the pairs are off by at most 1. The exact motion was
    /// fitted to them, so its numbers are others: by δ, which moves the states about as far as the
    /// maker's error e does. At the exact motion's numbers the maker is then off by what δ does to
    /// first order, which the projection takes away, and by the second order and the change of the
    /// derivative, each of which is |e| times e's part of what the states move, `crude`, times a
    /// factor of some units (the period's power in k, and the angle in radians that a pair goes).
    /// So much, tenfold, is allowed for.
    ///
    /// The error of steps in between is that of their neighbours on the ladder, linear in a power
    /// of their length that the neighbours show; a tenth of their difference is allowed for, or a
    /// third of itself.
    fn wanted(&self, candidate: &'static Candidate, exact: bool) -> Vec<Wanted> {
        let mut wanted = Vec::new();
        let mut before: Option<Error> = None;
        let (mut least, mut factors) = (0, 0);
        for steps in LADDER {
            if steps < least {
                continue;
            }
            // The older states are rows.
            if steps > 1 && candidate.older() > 0 {
                break;
            }
            let mut there = Applied { map: Map::Steps(candidate, steps), ..self.here };
            let mut off = there.off(&self.few, &self.bounds);
            let crude_of = |off: &[f64]| {
                let raw = self.off.iter().zip(off).map(|(a, b)| a - b);
                mean(&raw.collect::<Vec<_>>()) / self.moved
            };
            let mut crude = crude_of(&off);
            // Not this motion with these numbers: perhaps with another k.
            if crude.is_nan() || crude > FAR {
                if steps <= 4 && self.refined(&there, steps).is_some_and(|error| error.fits(self)) {
                    let equation = there.equation;
                    wanted.push(Wanted { left: crude, candidate, steps, equation });
                }
                factors += 1;
                let other = if factors <= 8 { self.with_another_k(&there) } else { None };
                let Some(other) = other else {
                    before = None;
                    continue;
                };
                there = other;
                off = there.off(&self.few, &self.bounds);
                crude = crude_of(&off);
                if crude.is_nan() || crude > FAR {
                    before = None;
                    continue;
                }
            }
            let mut error = self.error(&there, steps, &off, crude);
            // To first order it cannot be said: with numbers that are nearer.
            let unsure = error.left(&self.away) <= error.allowed() && error.allowed() > 6.0;
            if unsure && let Some(better) = self.refined(&there, steps) {
                error = better;
            }
            let left = error.left(&self.away);
            if left <= error.allowed() {
                let equation = error.equation;
                wanted.push(Wanted { left, candidate, steps, equation });
                // Of those that are accurate enough an example is enough.
                if exact {
                    break;
                }
            }
            let crude = error.crude;
            let small = mean(&error.flat);
            if let Some(old) = before.as_ref().filter(|_| !exact) {
                wanted.extend(self.between(candidate, old, &error));
                // Smaller than what the rows have, and still shrinking.
                let shrinks = small < 0.8 * mean(&old.flat);
                if shrinks && crude < CRUDE && left > 0.5 * mean(&self.away) && self.past(&error) {
                    break;
                }
            }
            if small < 0.03 && crude < CRUDE {
                break;
            }
            least = self.next(before.as_ref(), &error);
            before = Some(error);
        }
        wanted
    }

    fn error(&self, there: &Applied<'a>, steps: u32, off: &[f64], crude: f64) -> Error {
        let raw: Vec<f64> = self.off.iter().zip(off).map(|(a, b)| a - b).collect();
        let size = crude * self.moved;
        Error { steps, flat: self.flat.project(&raw), size, crude, equation: there.equation }
    }

    /// The error with numbers that are nearer to those that the candidate would have.
    fn refined(&self, there: &Applied<'a>, steps: u32) -> Option<Error> {
        let some: Vec<Pair> = self.few.iter().step_by(2).copied().collect();
        let entries = self.here.data.entries();
        let bounds: Vec<f64> = self.bounds.chunks(entries).step_by(2).flatten().copied().collect();
        let (there, effect) = refine(*there, &some, &self.numbers, &bounds, self.moved)?;
        let off = there.off(&self.few, &self.bounds);
        worst(&off).is_finite().then(|| self.error(&there, steps, &off, effect / self.moved))
    }

    /// With the k that a mistake has, of half the force, of a step squared and the like, if that is
    /// nearer to the motion.
    fn with_another_k(&self, there: &Applied<'a>) -> Option<Applied<'a>> {
        let Map::Steps(_, steps) = there.map else { return None };
        let h = self.here.data.spacing / f64::from(steps);
        let some = &self.few[..self.few.len().min(4)];
        let entries = self.here.data.entries() * some.len();
        let with = |factor: f64| {
            let equation = Equation { k: there.equation.k * factor, ..there.equation };
            let other = Applied { equation, ..*there };
            let off = other.off(some, &self.bounds[..entries]);
            let raw = self.off.iter().zip(&off).map(|(a, b)| a - b);
            (mean(&raw.collect::<Vec<_>>()), other)
        };
        let tried = [0.5, 2.0, h, 1.0 / h, h * h, 1.0 / (h * h)].map(with);
        let finite = tried.into_iter().filter(|(off, _)| off.is_finite());
        let (off, other) = finite.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (off <= FAR * self.moved).then_some(other)
    }

    /// Whether the error is less than half of what it would have to be, and so are those of shorter
    /// steps.
    fn past(&self, error: &Error) -> bool {
        mean(&error.flat) < 0.4 * mean(&self.away) && mean(&self.away) > 10.0
    }

    /// From how many steps on it goes on: where the error goes with a power of the steps' length,
    /// those are left out that are twice as long as what the rows would have.
    fn next(&self, before: Option<&Error>, error: &Error) -> u32 {
        let Some(old) = before.filter(|_| error.crude < CRUDE) else { return 0 };
        let (oo, oe, ee) =
            (dot(&old.flat, &old.flat), dot(&old.flat, &error.flat), dot(&error.flat, &error.flat));
        let power = error.power(old);
        if oe < 0.98 * libm::sqrt(oo * ee) || power < 0.7 {
            return 0;
        }
        let ratio = mean(&error.flat) / libm::fmax(mean(&self.away), 1.0);
        let half = 0.5 * f64::from(error.steps) * libm::pow(ratio, 1.0 / power);
        // Far from there the power itself still changes.
        if half > f64::from(MOST_STEPS) && error.steps >= 4 {
            return MOST_STEPS + 1;
        }
        libm::fmin(half, 3.0 * f64::from(error.steps)) as u32
    }

    fn between(&self, candidate: &'static Candidate, old: &Error, new: &Error) -> Vec<Wanted> {
        let power = new.power(old).clamp(0.3, 16.0);
        let at = |steps: u32| libm::pow(f64::from(steps), -power);
        let apart: Vec<f64> = old.flat.iter().zip(&new.flat).map(|(a, b)| a - b).collect();
        let spread = 0.1 * mean(&apart);
        let of = |steps| {
            let part = (at(steps) - at(new.steps)) / (at(old.steps) - at(new.steps));
            let flat: Vec<f64> =
                new.flat.iter().zip(&apart).map(|(error, apart)| error + part * apart).collect();
            let loose = libm::fmin(spread, 0.3 * mean(&flat));
            let Error { size, crude, equation, .. } = *old;
            let error = Error { steps, flat, size, crude, equation };
            let mut error = error;
            if error.left(&self.away) > error.allowed() + loose {
                return None;
            }
            let map = Map::Steps(candidate, steps);
            error = self.refined(&Applied { map, equation, ..self.here }, steps)?;
            let left = error.left(&self.away);
            error.fits(self).then_some(Wanted { left, candidate, steps, equation: error.equation })
        };
        (old.steps + 1..new.steps).filter_map(of).collect()
    }
}

/// The error of so many steps of a candidate, in bounds.
struct Error {
    steps: u32,
    /// What no other numbers would make of it.
    flat: Vec<f64>,
    size: f64,
    crude: f64,
    equation: Equation,
}

impl Error {
    fn fits(&self, about: &About<'_>) -> bool {
        self.left(&about.away) <= self.allowed()
    }

    fn left(&self, away: &[f64]) -> f64 {
        mean(&away.iter().zip(&self.flat).map(|(a, b)| a - b).collect::<Vec<_>>())
    }

    /// How far off the maker may seem; see [`About::wanted`].
    fn allowed(&self) -> f64 {
        3.0 + 10.0 * self.crude * self.size
    }

    /// The power of the steps' length that the error goes with.
    fn power(&self, old: &Self) -> f64 {
        libm::log(mean(&old.flat) / mean(&self.flat))
            / libm::log(f64::from(self.steps) / f64::from(old.steps))
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Searches all candidates about one motion.
pub fn search(data: &Data, motion: &Motion, found: &mut Found) {
    let begun = work();
    let lag = lag(data, motion);
    found.lag = found.lag.max(lag);
    let driven = motion.fit.equation.drive[2] != 0.0;
    let damped = motion.fit.equation.c > 0.0;
    let numbers = active(data, true, driven);
    // With the rows before them that methods of several steps need, if there are so many.
    let pairs = |most| {
        let all = data.pairs(lag, most);
        let with_past: Vec<Pair> =
            all.iter().copied().filter(|pair| data.has_past(pair.rows[0])).collect();
        if with_past.len() * 2 > all.len() { with_past } else { all }
    };
    let (few, many) = (pairs(FEW), pairs(PAIRS));
    // The exact motion over these spans.
    let Some(whole) = fit(applied(data, &motion.fit), &few, &numbers, false) else { return };
    let here = applied(data, &whole);
    if let Some(best) = best_of(data, Map::Exact, here.equation, &many, &numbers) {
        // What the exact motion is not ten times as far off as is no method's alone.
        found.exact |= best.worst < APART;
        found.motion = found.motion.or(Some(best).filter(|fit| fit.worst < APART));
    }
    // No steps of one length lead from row to row.
    if !data.even {
        return;
    }
    // Where the exact motion agrees some examples are enough.
    let looked_at = |candidate: &&Candidate| {
        candidate.suits(damped, driven) && (!found.exact || USUAL.contains(&candidate.name))
    };
    let about = About::new(here, few, &numbers);
    let mut wanted: Vec<Wanted> = Vec::new();
    for candidate in all().iter().filter(looked_at) {
        if work() - begun > MOST_WORK {
            found.many = true;
            break;
        }
        if candidate.older() == 0 || data.has_velocities() {
            wanted.extend(about.wanted(candidate, found.exact));
        }
    }
    wanted.sort_by(|a, b| a.left.total_cmp(&b.left));
    if found.exact {
        wanted.sort_by_key(|wanted| (!wanted.candidate.right, wanted.steps));
        wanted.truncate(2 * ENOUGH);
    }
    for Wanted { candidate, steps, equation, .. } in wanted {
        // Where the exact motion agrees, every method does that is accurate enough; and a list of
        // many says no more than that it cannot be told.
        if found.exact && found.agree.len() >= ENOUGH
            || found.agree.len() + found.near.len() >= MANY
            || work() - begun > 2 * MOST_WORK
        {
            found.many = true;
            break;
        }
        let map = Map::Steps(candidate, steps);
        // Few pairs say whether all are worth it.
        let pairs = &about.few;
        let free = Equation { c: 0.0, ..equation };
        let from = |equation| fit(Applied { map, equation, ..here }, pairs, &numbers, false);
        let mut first = from(equation);
        if first.is_none_or(|fit| fit.mean > APART) {
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
        let pairs = if found.exact { pairs } else { &many };
        let Some(best) = best_of(data, map, first.equation, pairs, &numbers) else { continue };
        found.sort_in(best);
    }
    for list in [&mut found.agree, &mut found.near] {
        list.sort_by(|a, b| a.worst.total_cmp(&b.worst));
        let mut seen = Vec::new();
        list.retain(|fit| {
            let key = name_and_steps(fit);
            let new = key.is_none() || !seen.contains(&key);
            seen.push(key);
            new
        });
    }
}

impl Found {
    /// Puts a fit where it belongs.
    pub fn sort_in(&mut self, fit: Fit) {
        if fit.worst <= AGREES {
            self.agree.push(fit);
        } else if fit.worst < APART {
            self.near.push(fit);
        } else {
            keep(&mut self.nearest, fit);
        }
    }
}

/// Methods before mistakes, sine before others, no drag before one, as forward Euler with a drag
/// has some of symplectic Euler's rows, and then what has the fewest steps.
pub fn rank(fit: &Fit) -> (bool, usize, bool, u32) {
    let Equation { force, c, .. } = fit.equation;
    match fit.map {
        Map::Steps(candidate, steps) => (!candidate.right, force as usize, c != 0.0, steps),
        Map::Exact => (true, 0, false, 0),
    }
}

/// Compares what is left over more rows, in which the methods' errors add up and the digits' do not
/// as fast, until one is left or no more rows can be had.
///
/// Maps that are the same on these rows are so over more of them: one of them stands for all.
pub fn sharpen(data: &Data, found: &mut Found) {
    let Some(first) = found.agree.iter().min_by_key(|fit| rank(fit)).copied() else { return };
    let is_first = |fit: &Fit| name_and_steps(fit) == name_and_steps(&first);
    let mut twins = Vec::new();
    if found.agree.len() > 1 && !found.exact && !found.many {
        let is_twin = |fit: &mut Fit| !is_first(fit) && same(data, &first, fit).is_some();
        twins.extend(found.agree.extract_if(.., is_twin));
    }
    for _ in 0..3 {
        if !sharpen_once(data, found, twins.is_empty()) {
            break;
        }
    }
    let fallen = found.near.iter().find(|fit| is_first(fit)).copied();
    if found.agree.iter().any(is_first) {
        found.agree.append(&mut twins);
    } else if let Some(Fit { worst, .. }) = fallen {
        found.near.extend(twins.into_iter().map(|twin| Fit { worst, ..twin }));
    }
}

fn name_and_steps(fit: &Fit) -> Option<(&'static str, u32, Force)> {
    let Map::Steps(candidate, steps) = fit.map else { return None };
    Some((candidate.name, steps, fit.equation.force))
}

/// Whether there were more rows, and more than one to be compared, perhaps with twins.
fn sharpen_once(data: &Data, found: &mut Found, alone: bool) -> bool {
    let lag = 5 * found.lag;
    let Some(best) = found.agree.first().copied() else { return false };
    let here = applied(data, &best);
    let time = f64::from(lag) * data.spacing * here.equation.rate();
    let too_long = if data.has_velocities() { time > 30.0 } else { time > 1.0 };
    let pairs = data.pairs(lag, 2 * FEW);
    let short = pairs.len() < FEW || lag as usize * 3 > data.row.len();
    let one = found.agree.len() == 1 && found.near.is_empty() && alone;
    if one || found.exact || found.many || too_long || short || worst(&here.bounds(&pairs)) >= 0.03
    {
        return false;
    }
    found.lag = lag;
    let numbers = active(data, true, here.equation.drive[2] != 0.0);
    let all: Vec<Fit> = found.agree.drain(..).chain(found.near.drain(..)).collect();
    for fit in all {
        let mut pairs = pairs.clone();
        pairs.retain(|pair| pair.rows[0] >= fit.older());
        if let Some(best) = best_of(data, fit.map, fit.equation, &pairs, &numbers) {
            found.sort_in(best);
        }
    }
    true
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
    // The worst is never less than the least mean.
    if best.worst > 1.0 && best.mean <= AGREES {
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
        let i = pair.rows[0];
        let omega = match data.omega.get(i) {
            Some(omega) => *omega,
            None => here.velocity(pair)?,
        };
        // The span is the difference of two times, which are small to have no rounding of their
        // own.
        let t = if one.equation.drive[2] == 0.0 { 0.0 } else { data.t[i] };
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
    // No numbers make the largest residual of some pairs less than the least mean: so most maps are
    // seen to be others in four of them.
    let few = fit(from, &pairs[..pairs.len().min(4)], &numbers, false)?;
    if few.mean > LIKE {
        return None;
    }
    let best = fit(from, &pairs, &numbers, false)?;
    (best.worst <= LIKE).then_some(best.equation.k)
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
            (t, (b - a) / span, 0.5 * (sine(th[i]) + sine(th[j])), 0.5 * (a + b))
        } else {
            let span = data.t[j] - data.t[i];
            let bend = (th[i] - 2.0 * th[j] + th[k]) / (span * span);
            (data.t[j], bend, sine(th[j]), (th[k] - th[i]) / (2.0 * span))
        };
        rows.push([t, bend, -force, -rate]);
    }
    let length = data.t.last()? - data.t.first()?;
    let misfit = |frequency: f64| {
        let columns: Vec<Vec<f64>> = vec![
            rows.iter().map(|x| x[2]).collect(),
            rows.iter().map(|x| x[3]).collect(),
            rows.iter().map(|x| cosine(frequency * x[0])).collect(),
            rows.iter().map(|x| sine(frequency * x[0])).collect(),
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
    exact(equation, start, z, time, 0.15, 1e7)
}

/// The fraction of a row of numbers that a combination of others does not explain.
pub fn unexplained(columns: &[Vec<f64>], of: &[f64]) -> f64 {
    mean(&Flat::new(columns).project(of)) / mean(of)
}

/// Mistakes that make the same rows as a fit with another k: of half the force, of a step squared
/// and the like.
pub fn relatives(data: &Data, best: &Fit, steps: u32) -> Vec<(&'static str, f64)> {
    let h = data.spacing / f64::from(steps);
    let damped = best.equation.c > 0.0;
    let wrong = all().iter().filter(|one| !one.right && one.suits(damped, false));
    wrong
        .filter_map(|one| {
            [1.0, 0.5, 2.0, 0.25, 4.0, h, 1.0 / h].into_iter().find_map(|factor| {
                let equation = Equation { k: best.equation.k * factor, ..best.equation };
                let other = Fit { map: Map::Steps(one, steps), equation, ..*best };
                same(data, best, &other).map(|k| (one.name, k))
            })
        })
        .collect()
}
