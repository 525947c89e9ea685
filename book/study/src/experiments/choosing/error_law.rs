//! The law of a method's angle error, measured on a ladder of steps.

use std::sync::{LazyLock, OnceLock};

use pendula::exact::Motion;
use pendula::{METHODS, Pendulum, Phase};

use super::{COARSE, Curve, MethodRef, Release};

/// The longest run that is measured (periods); it is shorter where the step is small or the error
/// large.
pub const LONGEST: u64 = 256;

/// The most steps in a run that is measured.
const STEPS: u64 = 1 << 17;

/// Steps a period on the ladder: two rungs to an octave, from 4 to 16 384.
const RUNGS: core::ops::RangeInclusive<u32> = 0..=24;

/// Extrapolated rungs, finer than the last that was measured: thirty octaves.
const EXTRAPOLATED: u32 = 60;

/// At least this many phases of a period are kept, or all if there are fewer. On average the one
/// nearest to the maximum misses it by a quarter of their spacing, π/256; an error of three humps,
/// as these are, is then too small by ½(3π/256)², less than 0.001 of itself.
const PHASES: usize = 128;

/// An error (rad) beyond which the coefficients are taken from a shorter run, since the law is one
/// of small errors.
const LARGE: f64 = 0.03;

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
    pub steps: u64,
    /// The number of periods from which it was measured.
    pub periods: u64,
    /// e₀, e₁, e₂ (rad) at each phase.
    pub growth: Vec<[f64; 3]>,
    /// Where the steps are coarse: the largest error measured (rad) in the first period, the first
    /// two, ….
    pub seen: Vec<f64>,
}

/// The law of every method of the library, each measured when it is first asked for.
pub fn profiles() -> impl Iterator<Item = &'static Profile> {
    (0..METHODS.len()).map(profile)
}

/// The law of a method of the library.
pub fn profile_of(method: MethodRef) -> &'static Profile {
    let is_it = |other: &MethodRef| other.info().name == method.info().name;
    profile(METHODS.iter().position(is_it).expect("one of the library's methods"))
}

fn profile(index: usize) -> &'static Profile {
    static PROFILES: [OnceLock<Profile>; METHODS.len()] =
        [const { OnceLock::new() }; METHODS.len()];
    PROFILES[index].get_or_init(|| Profile::measure(METHODS[index]))
}

/// For each rung the exact motion over a period.
fn truth() -> impl Iterator<Item = &'static [Phase]> {
    static TRUTH: LazyLock<Vec<Vec<Phase>>> = LazyLock::new(|| {
        let release = Release::new();
        let motion = Motion::new(&Pendulum::PAPER, release.start).expect("a finite start");
        let states = RUNGS.map(|rung| {
            let steps = libm::round(4.0 * libm::exp2(0.5 * f64::from(rung))) as u64;
            let grid = release.grid(steps, 1);
            (1..=steps).map(|n| motion.at(grid.time(n))).collect()
        });
        states.collect()
    });
    TRUTH.iter().map(Vec::as_slice)
}

impl Rung {
    /// Runs the method with a step for each state of `truth`, which is the exact motion over a
    /// period.
    pub fn measure(method: MethodRef, release: &Release, truth: &[Phase]) -> Self {
        let steps = truth.len() as u64;
        // An even number of periods between the first and the last, so that one is half-way.
        let half = (STEPS / steps).min(LONGEST) / 2;
        let grid = release.grid(steps, 2 * half + 1);
        let mut errors = Vec::with_capacity(grid.steps() as usize);
        method.run(&Pendulum::PAPER, release.start, &grid, &mut |n: u64, _, z: Phase| {
            if n > 0 {
                errors.push(z.theta - truth[((n - 1) % steps) as usize].theta);
            }
        });
        let info = method.info();
        Self::fit(&errors, truth.len(), !(info.symplectic || info.symmetric))
    }

    /// Fits the law to the errors (rad) of an odd number of periods of `steps` steps each; with e₂
    /// if the action `drifts`.
    pub(super) fn fit(errors: &[f64], steps: usize, drifts: bool) -> Self {
        let largest = |largest: &mut f64, period: &[f64]| {
            *largest = period.iter().fold(*largest, |largest, e| libm::fmaximum(largest, e.abs()));
            Some(*largest)
        };
        let seen = if (steps as u64) < COARSE {
            errors.chunks(steps).scan(0.0, largest).collect()
        } else {
            Vec::new()
        };
        let period = |n: usize| &errors[n * steps..][..steps];
        let small = |n: usize| period(n).iter().all(|error| error.abs() < LARGE);
        let mut half = errors.len() / steps / 2;
        while half > 1 && !small(2 * half) {
            half /= 2;
        }
        let q = half as f64;
        let coefficients = |((first, middle), last): ((&f64, &f64), &f64)| {
            let bend = if drifts { (first - 2.0 * middle + last) / (2.0 * q * q) } else { 0.0 };
            [*first, (last - first) / (2.0 * q) - 2.0 * q * bend, bend]
        };
        let growth = period(0).iter().zip(period(half)).zip(period(2 * half)).map(coefficients);
        let growth = growth.step_by((steps / PHASES).max(1)).collect();
        let periods = if seen.is_empty() { 2 * half } else { seen.len() };
        Self { steps: steps as u64, periods: periods as u64, growth, seen }
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
        self.growth.iter().map(largest).fold(0.0, libm::fmaximum)
    }

    /// The largest of the coefficients e₂ (rad): zero for a method whose action does not drift.
    pub fn drift(&self) -> f64 {
        self.growth.iter().map(|e| e[2].abs()).fold(0.0, libm::fmaximum)
    }

    /// This rung extrapolated to a step smaller by `factor`, to a whole number of steps: e₀ and e₁
    /// go as h to the power `order`, and e₂ to the power `drift`.
    pub(super) fn refined(&self, factor: f64, order: f64, drift: f64) -> Self {
        let steps = libm::round(self.steps as f64 * factor);
        let factor = steps / self.steps as f64;
        let (by, drift) = (libm::pow(factor, -order), libm::pow(factor, -drift));
        let growth = self.growth.iter().map(|[e0, e1, e2]| [e0 * by, e1 * by, e2 * drift]);
        Self {
            steps: steps as u64,
            periods: self.periods,
            growth: growth.collect(),
            seen: Vec::new(),
        }
    }
}

impl Profile {
    fn measure(method: MethodRef) -> Self {
        let release = Release::new();
        let mut profile = Self { method, release, rungs: Vec::new() };
        for truth in truth() {
            if profile.is_exhausted() {
                break;
            }
            profile.rungs.push(Rung::measure(method, &release, truth));
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
            // Rounding at the end of the measured run ends up in e₁ or in e₂, and is extrapolated
            // with it; a second difference of three errors is four times as uncertain as a first
            // one.
            let rounding = self.release.rounding(self.method, rung.steps, rung.periods);
            let beyond = (periods as f64 / rung.periods as f64).max(1.0);
            let carried = if rung.drift() > 0.0 { 4.0 * beyond * beyond } else { beyond };
            rung.error(periods) > CLEAR * carried * rounding
        };
        // In long steps an implicit method may find no solution, and its errors are not finite.
        let useless = |rung: &&Rung| {
            rung.steps < COARSE && (rung.periods < periods || !rung.error(periods).is_finite())
        };
        let rungs = self.rungs.iter().skip_while(useless);
        let mut rungs: Vec<Rung> = rungs.take_while(|rung| clear(rung)).cloned().collect();
        let order = f64::from(self.method.info().order);
        if let [.., coarse, _, last] = &rungs[..] {
            let octaves = libm::log2(last.steps as f64 / coarse.steps as f64);
            let power = libm::round(libm::log2(coarse.drift() / last.drift()) / octaves);
            let power = if power > order { order + 1.0 } else { order };
            let finer = |k| last.refined(libm::exp2(0.5 * f64::from(k)), order, power);
            let finer: Vec<Rung> = (1..=EXTRAPOLATED).map(finer).collect();
            rungs.extend(finer);
        }
        let points = rungs.iter().map(|rung| (rung.steps as f64, libm::log(rung.error(periods))));
        let points = points.collect();
        Curve { method: self.method, release: self.release, periods, points }
    }
}
