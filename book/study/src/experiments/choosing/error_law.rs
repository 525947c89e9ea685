//! The law of a method's angle error, measured on a ladder of steps.

use core::num::NonZeroU64;
use std::sync::OnceLock;

use pendula::exact::Motion;
use pendula::methods::{Projected, Rk4};
use pendula::{METHODS, Pendulum, Phase};

use super::{Curve, MethodRef, Release, SWINGS, THETA_0};

/// The longest run that is measured (periods); it is shorter where the step is small or the error
/// large, and a quarter of it in other swings than that of [`THETA_0`] and of implicit methods.
pub const LONGEST: u64 = 256;

/// After so many periods coarse steps have the phases of the first ones again: after a *turn*.
const TURNS: u64 = 8;

/// How far a method is measured.
#[derive(Clone, Copy, Debug)]
struct Extent {
    /// The longest run (periods).
    longest: u64,
    /// The most steps in a run of more than three turns.
    steps: u64,
    /// The most steps a period.
    finest: f64,
}

impl Extent {
    const FULL: Self = Self { longest: LONGEST, steps: 1 << 17, finest: 16_384.0 };

    /// For the other maps: a tenth of the work.
    const PART: Self = Self { longest: LONGEST / 4, steps: 1 << 14, finest: 2048.0 };

    /// For implicit methods, of which a step costs most, and which win nothing in short steps.
    const IMPLICIT: Self = Self { longest: LONGEST / 4, steps: 1 << 12, finest: 512.0 };

    fn of(method: MethodRef, release: &Release) -> Self {
        match (method.info().implicit, release.theta_0 == THETA_0) {
            (true, _) => Self::IMPLICIT,
            (false, true) => Self::FULL,
            (false, false) => Self::PART,
        }
    }
}

/// Steps a period on the ladder of a swing. The coarse ones are odd eighths, 24 to an octave where
/// that is more than the quarter that lies between two of them; then there are two to an octave.
fn ladder(release: &Release) -> impl Iterator<Item = f64> {
    const LEAST: f64 = 1.125;
    let coarse = release.coarse;
    let next = |steps: &f64| {
        let next = libm::floor(4.0 * steps * libm::exp2(1.0 / 24.0)) / 4.0 + 0.125;
        Some(next.max(steps + 0.25))
    };
    let coarser = core::iter::successors(Some(LEAST), next).take_while(move |it| *it < coarse);
    let finer = (0..).map(move |i: u32| libm::round(coarse * libm::exp2(0.5 * f64::from(i))));
    coarser.chain(finer)
}

/// Extrapolated rungs, finer than the last that was measured: thirty octaves where steps are not
/// coarse.
const EXTRAPOLATED: usize = 60;

/// At least this many phases of a period are kept, or all if there are fewer. On average the one
/// nearest to the maximum misses it by a quarter of their spacing, π/256; an error of three humps,
/// as these are, is then too small by ½(3π/256)², less than 0.001 of itself.
const PHASES: usize = 128;

/// An error (rad) beyond which the coefficients are taken from a shorter run, since the law is one
/// of small errors.
const LARGE: f64 = 0.03;

/// An error (rad) at which a run ends, after three turns at least: more is never allowed, and the
/// coefficients are taken from the run before it.
const ENOUGH: f64 = 10.0 * LARGE;

/// A measured error counts if it is more than this many times what rounding may add to it.
const CLEAR: f64 = 10.0;

/// The law of a method's angle error on each rung of the ladder.
#[derive(Clone, Debug)]
pub struct Profile {
    /// The method.
    pub method: MethodRef,
    /// The swing.
    pub release: Release,
    /// The growth of the error at each step, the coarsest first.
    pub rungs: Vec<Rung>,
}

/// The growth of the error at one step.
#[derive(Clone, Debug)]
pub struct Rung {
    /// Steps a period.
    pub steps: f64,
    /// The number of periods from which it was measured.
    pub periods: u64,
    /// e₀, e₁, e₂ (rad) at each phase, with n counted from the first period.
    pub growth: Vec<[f64; 3]>,
    /// Where the steps are coarse: the largest error measured (rad) in the first period, the first
    /// two, ….
    pub seen: Vec<f64>,
}

/// RK4 with each step put back onto the energy of the start. It isn't on the library's list,
/// because it has to know the energy, and on the pendulum alone it does.
pub const PROJECTED: MethodRef = &Projected(Rk4);

const RANKED: usize = METHODS.len() + 1;

/// The methods that the maps rank: those of the library, and the [`PROJECTED`] one.
pub fn ranked() -> impl Iterator<Item = MethodRef> {
    METHODS.iter().copied().chain([PROJECTED])
}

/// The law of every ranked method on a swing, each measured when it is first asked for.
pub fn profiles(theta_0: f64) -> impl Iterator<Item = &'static Profile> {
    ranked().map(move |method| profile_of(method, theta_0))
}

/// The law of a ranked method on one of [`SWINGS`].
pub fn profile_of(method: MethodRef, theta_0: f64) -> &'static Profile {
    static PROFILES: [[OnceLock<Profile>; RANKED]; SWINGS.len()] =
        [const { [const { OnceLock::new() }; RANKED] }; SWINGS.len()];
    let is_it = |other: MethodRef| other.info().name == method.info().name;
    let (swing, index) = (super::swing(theta_0), ranked().position(is_it));
    let profile = &PROFILES[swing][index.expect("a ranked method")];
    profile.get_or_init(|| Profile::measure(method, swing))
}

/// For each rung of a swing the exact motion until its phases repeat: of coarse ones over
/// [`TURNS`] periods, of the others over one.
fn truth(swing: usize) -> impl Iterator<Item = (f64, &'static [Phase])> {
    type Ladder = Vec<(f64, Vec<Phase>)>;
    static TRUTH: [OnceLock<Ladder>; SWINGS.len()] = [const { OnceLock::new() }; SWINGS.len()];
    let truth = TRUTH[swing].get_or_init(|| {
        let release = Release::new(SWINGS[swing]);
        let finest = if release.theta_0 == THETA_0 { Extent::FULL } else { Extent::PART }.finest;
        let rungs = ladder(&release).take_while(|steps| *steps <= finest);
        rungs.map(|steps| (steps, release.exact(steps))).collect()
    });
    truth.iter().map(|(steps, states)| (*steps, states.as_slice()))
}

impl Release {
    /// The exact motion in so many steps a period, until the phases repeat.
    pub fn exact(&self, steps: f64) -> Vec<Phase> {
        let motion = Motion::new(&Pendulum::PAPER, self.start).expect("a finite start");
        let grid = self.grid(steps, self.turns(steps));
        (1..=grid.steps()).map(|n| motion.at(grid.time(n))).collect()
    }

    /// After how many periods the phases repeat.
    fn turns(&self, steps: f64) -> u64 {
        if steps < self.coarse { TURNS } else { 1 }
    }
}

impl Rung {
    /// Runs the method with `steps` steps a period, and compares it with `truth`, the exact motion
    /// until its phases repeat.
    pub fn measure(method: MethodRef, release: &Release, steps: f64, truth: &[Phase]) -> Self {
        let Extent { longest, steps: most, .. } = Extent::of(method, release);
        let (turn, turns) = (truth.len(), release.turns(steps));
        // An even number of turns between the first and the last, so that one is half-way.
        let half = ((most / turn as u64).min(longest / turns) / 2).max(1);
        let grid = release.grid(steps, (2 * half + 1) * turns);
        let mut errors = Vec::with_capacity(grid.steps() as usize);
        let mut run = method.begin(&Pendulum::PAPER, release.start, &grid);
        for end in (1..=2 * half as usize + 1).map(|turns| turns * turn) {
            let solved = run.advance(end as u64, NonZeroU64::MIN, &mut |n: u64, _, z: Phase| {
                errors.push(z.theta - truth[(n as usize - 1) % turn].theta);
            });
            // After a step without a solution there are no states.
            errors.resize(if solved.is_ok() { end } else { end.max(3 * turn) }, f64::NAN);
            let is_small = errors[end - turn..].iter().all(|error| error.abs() < ENOUGH);
            if solved.is_err() || end >= 3 * turn && !is_small {
                break;
            }
        }
        let info = method.info();
        Self::fit(&errors, steps, turns, !(info.symplectic || info.symmetric))
    }

    /// Fits the law to the errors (rad) of three turns or more of `steps` steps a period, each of
    /// `turns` periods; with e₂ if the action `drifts`.
    pub(super) fn fit(errors: &[f64], steps: f64, turns: u64, drifts: bool) -> Self {
        let turn = libm::round(steps * turns as f64) as usize;
        let all = errors.len() / turn;
        let mut seen = Vec::new();
        if turns > 1 {
            let (mut n, mut largest) = (0, 0.0);
            while n < errors.len() {
                // With the step that ends the period, or goes beyond its end.
                let end = libm::ceil(steps * (seen.len() + 1) as f64) as usize;
                let end = end.min(errors.len());
                largest = errors[n..end].iter().fold(largest, |a, e| libm::fmaximum(a, e.abs()));
                seen.push(largest);
                n = end;
            }
        }
        let turn_at = |n: usize| &errors[n * turn..][..turn];
        let small = |n: usize| turn_at(n).iter().all(|error| error.abs() < LARGE);
        let mut half = (all - 1) / 2;
        while half > 1 && !small(2 * half) {
            half /= 2;
        }
        let q = (half as u64 * turns) as f64;
        let coefficients = |(i, ((first, middle), last)): (usize, ((&f64, &f64), &f64))| {
            let bend = if drifts { (first - 2.0 * middle + last) / (2.0 * q * q) } else { 0.0 };
            let slope = (last - first) / (2.0 * q) - 2.0 * q * bend;
            // The first turn is so many periods after the first period.
            let late = libm::floor(i as f64 / steps);
            [first - late * (slope - late * bend), slope - 2.0 * late * bend, bend]
        };
        let turns_apart = turn_at(0).iter().zip(turn_at(half)).zip(turn_at(2 * half));
        let growth = turns_apart.enumerate().map(coefficients);
        let growth = growth.step_by((turn / PHASES).max(1)).collect();
        let periods = if seen.is_empty() { 2 * half as u64 } else { seen.len() as u64 };
        Self { steps, periods, growth, seen }
    }

    /// The largest error (rad) at any phase of the first `periods` periods.
    pub fn error(&self, periods: u64) -> f64 {
        if let Some(largest) = self.seen.get(periods as usize - 1) {
            return *largest;
        }
        let last = periods as f64 - 1.0;
        let largest = |[e0, e1, e2]: &[f64; 3]| {
            let at = |n: f64| (e0 + n * (e1 + n * e2)).abs();
            let vertex = -0.5 * e1 / e2;
            let between = if vertex > 0.0 && vertex < last { at(vertex) } else { 0.0 };
            at(0.0).max(at(last)).max(between)
        };
        let seen = self.seen.last().copied().unwrap_or(0.0);
        self.growth.iter().map(largest).fold(seen, libm::fmaximum)
    }

    /// The largest of the coefficients e₂ (rad): zero for a method whose action does not drift.
    pub fn drift(&self) -> f64 {
        self.growth.iter().map(|e| e[2].abs()).fold(0.0, libm::fmaximum)
    }

    /// This rung extrapolated to shorter `steps`: e₀ and e₁ go as h to the power `order`, and e₂ to
    /// the power `drift`.
    pub(super) fn refined(&self, steps: f64, order: f64, drift: f64) -> Self {
        let factor = steps / self.steps;
        let (by, drift) = (libm::pow(factor, -order), libm::pow(factor, -drift));
        let growth = self.growth.iter().map(|[e0, e1, e2]| [e0 * by, e1 * by, e2 * drift]);
        Self { steps, periods: self.periods, growth: growth.collect(), seen: Vec::new() }
    }
}

impl Profile {
    fn measure(method: MethodRef, swing: usize) -> Self {
        let release = Release::new(SWINGS[swing]);
        let mut profile = Self { method, release, rungs: Vec::new() };
        for (steps, truth) in truth(swing) {
            if profile.is_exhausted() || steps > Extent::of(method, &release).finest {
                break;
            }
            profile.rungs.push(Rung::measure(method, &release, steps, truth));
        }
        profile
    }

    /// Whether the error of the last rung is below rounding, so that finer rungs are useless.
    pub(super) fn is_exhausted(&self) -> bool {
        self.rungs.last().is_some_and(|rung| {
            rung.error(rung.periods) < self.release.rounding(self.method, rung.steps, rung.periods)
        })
    }

    /// The error over a run of `periods` periods, as a function of the step.
    pub fn over(&self, periods: u64) -> Curve {
        let clear = |rung: &Rung| {
            // Rounding at the end of the measured run ends up in e₁ or in e₂, and is carried to the
            // end of this one with it, which may be earlier or later; a second difference of three
            // errors is four times as uncertain as a first one. That of the first period is in e₀.
            let rounding = |periods| self.release.rounding(self.method, rung.steps, periods);
            let part = periods as f64 / rung.periods as f64;
            let carried = if rung.drift() > 0.0 { 4.0 * part.max(part * part) } else { part };
            rung.error(periods) > CLEAR * (rounding(1) + carried * rounding(rung.periods))
        };
        // In long steps an implicit method may find no solution, and its errors are not finite.
        let useless = |rung: &Rung| !rung.seen.is_empty() && !rung.error(periods).is_finite();
        let first = self.rungs.iter().rposition(useless).map_or(0, |last| last + 1);
        let rungs = self.rungs[first..].iter();
        let mut rungs: Vec<Rung> = rungs.take_while(|rung| clear(rung)).cloned().collect();
        let known =
            rungs.iter().rfind(|rung| rung.periods >= periods).map_or(0.0, |rung| rung.steps);
        let finest = rungs.last().map_or(0.0, |rung| rung.steps);
        let order = f64::from(self.method.info().order);
        let an_octave_before = |last: &Rung| {
            // Whole numbers of steps are an octave apart but for their rounding.
            let far = |rung: &&Rung| rung.steps < 0.505 * last.steps;
            rungs.iter().rfind(far).cloned()
        };
        let last = rungs.last();
        if let Some((coarse, last)) = last.and_then(an_octave_before).zip(last.cloned()) {
            let octaves = libm::log2(last.steps / coarse.steps);
            let power = libm::round(libm::log2(coarse.drift() / last.drift()) / octaves);
            let power = if power > order { order + 1.0 } else { order };
            // An error that is small by chance is not extrapolated, but the worst of three.
            let at_last = |rung: &Rung| rung.refined(last.steps, order, power).error(periods);
            let worst =
                |a: &Rung, b: &Rung| if at_last(b) > at_last(a) { b.clone() } else { a.clone() };
            let three = rungs.iter().rev().take(3).cloned();
            let from = three.reduce(|a, b| worst(&a, &b)).expect("the last");
            let beyond = ladder(&self.release).skip_while(|steps| *steps <= last.steps);
            rungs.extend(beyond.take(EXTRAPOLATED).map(|steps| from.refined(steps, order, power)));
        }
        let points = rungs.iter().map(|rung| (rung.steps, libm::log(rung.error(periods))));
        let (method, release, points) = (self.method, self.release, points.collect());
        Curve { method, release, periods, points, known, finest }
    }
}
