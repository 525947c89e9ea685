//! Choosing an integrator: for a run so long and an error so small, which method needs the fewest force evaluations, and at
//! which step?
//!
//! Each method is measured on a ladder of steps that divide the period, so that every period has its samples at the same
//! phases. At each phase the error of the angle is then a slow function of the number n of periods, and theory says which: the
//! method follows, to all powers of h, an equation of its own, whose solutions are near those of the pendulum in action and
//! angle. What a step adds to the action on the mean makes it drift as n; an action that is off changes the frequency, and the
//! angle by the sum of that. So the error is
//!
//! e(n) = e₀ + e₁n + e₂n²,
//!
//! with e₂ = 0 for methods that are symplectic, or symmetric on a reversible motion as this one: their action does not drift
//! (Hairer, Lubich, Wanner, *Geometric Numerical Integration* (2006), Theorems X.3.1 and XI.3.1). The coefficients are taken
//! from the first period, the last and the one half-way of a run of up to [`LONGEST`]; beyond, the error is extrapolated by
//! this law, and at steps too small to be measured clear of rounding e₀ and e₁ by the method's order, and e₂ by its order or one
//! more, as measured.
//!
//! The pendulum is released at 1 rad but watched from an eighth of a period on. From rest, at a point of symmetry, a
//! method that is not symmetric looks better than it is: symplectic Euler would be of order two there.

use pendula::exact::{Motion, period};
use pendula::methods::registry::METHODS;
use pendula::{Grid, Pendulum, Phase};

use super::{MethodRef, released};

/// Amplitude of the swing (rad).
pub const THETA_0: f64 = 1.0;

/// The longest run that is measured (periods); it is shorter where the step is small or the error large.
pub const LONGEST: u64 = 256;

/// The most steps in a run that is measured.
const STEPS: u64 = 1 << 17;

/// Steps a period on the ladder: two rungs to an octave, from 4 to 16 384.
const RUNGS: core::ops::RangeInclusive<u32> = 0..=24;

/// Rungs below the last that was measured, where the error is extrapolated: as far as thirty octaves.
const EXTRAPOLATED: u32 = 60;

/// Of the phases of a period at least so many are looked at. Its highest is missed by a quarter of their distance on the mean,
/// π/256, and an error of three humps, as these are, by ½(3π/256)², less than 0.001 of itself.
const PHASES: usize = 128;

/// An error (rad) beyond which the coefficients are taken from a shorter run, since the law is one of small errors.
const LARGE: f64 = 0.03;

/// Steps a period from which the error follows the law; of coarser steps the map knows no more than it has seen.
///
/// Each period meets the same phases again, and what a step does to the action beyond all powers of h, e^{−c/h}, adds up
/// where it should cancel: with ten steps a period Blanes and Moan's method of order 6 is a hundred times worse after 5000
/// periods than its first 256 say.
pub const COARSE: u64 = 24;

/// How many times more than what rounding may have to do with it a measured error must be to count.
const CLEAR: f64 = 10.0;

/// Lengths of runs (periods), three to a decade.
pub const PERIODS: [u64; 16] =
    [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10_000, 20_000, 50_000, 100_000];

/// Largest errors of the angle (rad) allowed over the run, two to a decade: from 1e-1 down to 1e-10.
pub fn allowed() -> [f64; 19] {
    core::array::from_fn(|i| libm::exp10(-1.0 - 0.5 * i as f64))
}

// ---------------------------------------------------------------------------------------------------------------------
// The swing
// ---------------------------------------------------------------------------------------------------------------------

/// The swing that every method is measured on.
#[derive(Clone, Copy, Debug)]
pub struct Release {
    /// The start, an eighth of a period after the release.
    pub start: Phase,
    /// The period T (s).
    pub period: f64,
    /// The largest angular velocity (rad/s).
    fastest: f64,
    /// d ln T / d ln E, with the energy E above the bottom: how much an energy that is off spoils the period.
    sensitivity: f64,
}

impl Release {
    /// The paper's pendulum at the amplitude [`THETA_0`].
    pub fn new() -> Self {
        /// For a central difference: δ² is all it errs by.
        const DELTA: f64 = 1e-4;
        let pendulum = Pendulum::PAPER;
        let motion = Motion::new(&pendulum, released(THETA_0)).expect("a finite start");
        let at = |theta| period(&pendulum, theta).expect("a finite angle");
        let versine = |theta: f64| {
            let s = pendula::arithmetic::sine::sin(0.5 * theta);
            s * s
        };
        let (low, high) = (THETA_0 - DELTA, THETA_0 + DELTA);
        let period = at(THETA_0);
        Self {
            start: motion.at(0.125 * period),
            period,
            fastest: motion.at(0.25 * period).omega.abs(),
            sensitivity: libm::log(at(high) / at(low)) / libm::log(versine(high) / versine(low)),
        }
    }

    /// The grid of `periods` periods in `steps` steps each.
    pub fn grid(&self, steps: u64, periods: u64) -> Grid {
        Grid::new(self.period / steps as f64, steps * periods).expect("a positive step")
    }

    /// What rounding may add to the angle (rad) in `periods` periods of `steps` steps: twice the standard deviation of two
    /// random walks.
    ///
    /// At each rounding of θ and ω, of which there are as many as force evaluations, the energy moves by 0.6 ε of itself at
    /// most (tests/long_time.rs), and so does the angle. After n roundings the energy is off by 0.6 ε√n; the period
    /// by d ln T/d ln E of that, and the time by the sum over all periods, 1/√3 of what it would be had the last
    /// one's error held from the start (Brouwer, *Astronomical Journal* 46 (1937) 149).
    ///
    /// A method that errs by less than a rounding in a period, in steps that divide the period, rounds alike in each, and its
    /// walk goes straight. A step a little off walks as it should; and where the map looks, the methods err by more.
    pub fn rounding(&self, method: MethodRef, steps: u64, periods: u64) -> f64 {
        const ROUNDING: f64 = 0.6 * f64::EPSILON;
        let evaluations = method.info().force_evaluations as f64;
        let walk = ROUNDING * libm::sqrt(evaluations * steps as f64 * periods as f64);
        let late = self.sensitivity * self.period * periods as f64 / libm::sqrt(3.0);
        let angle = self.fastest * late;
        2.0 * walk * libm::hypot(THETA_0, angle)
    }
}

impl Default for Release {
    fn default() -> Self {
        Self::new()
    }
}

// ---------------------------------------------------------------------------------------------------------------------
// What a method's error does
// ---------------------------------------------------------------------------------------------------------------------

/// What a method's angle error does on each rung of the ladder.
#[derive(Clone, Debug)]
pub struct Profile {
    /// The method.
    pub method: MethodRef,
    scene: Release,
    rungs: Vec<Rung>,
}

/// The growth of the error at one step.
#[derive(Clone, Debug)]
struct Rung {
    /// Steps a period.
    steps: u64,
    /// The number of periods from which it was taken.
    periods: u64,
    /// e₀, e₁, e₂ (rad) at each phase.
    growth: Vec<[f64; 3]>,
    /// Where the steps are coarse: the largest error (rad) in the first, the first two … periods, as measured.
    seen: Vec<f64>,
}

/// Measures every method of the library.
pub fn profiles(scene: &Release) -> Vec<Profile> {
    let motion = Motion::new(&Pendulum::PAPER, scene.start).expect("a finite start");
    let mut profiles: Vec<Profile> = METHODS
        .iter()
        .map(|method| Profile { method: *method, scene: *scene, rungs: Vec::new() })
        .collect();
    for rung in RUNGS {
        let steps = libm::round(4.0 * libm::exp2(0.5 * f64::from(rung))) as u64;
        let grid = scene.grid(steps, 1);
        let times: Vec<f64> = (1..=steps).map(|n| grid.time(n)).collect();
        let mut truth = vec![Phase::default(); times.len()];
        motion.at_each(&times, &mut truth);
        for profile in profiles.iter_mut().filter(|profile| !profile.is_exhausted()) {
            profile.rungs.push(Rung::measure(profile.method, scene, &truth));
        }
    }
    profiles
}

impl Rung {
    /// Runs the method with a step for each state of `truth`, which is the exact motion over a period.
    fn measure(method: MethodRef, scene: &Release, truth: &[Phase]) -> Self {
        let steps = truth.len() as u64;
        // An even number of periods between the first and the last, so that one is half-way.
        let half = (STEPS / steps).min(LONGEST) / 2;
        let grid = scene.grid(steps, 2 * half + 1);
        let mut errors = Vec::with_capacity(grid.steps() as usize);
        method.run(&Pendulum::PAPER, scene.start, &grid, &mut |n: u64, _, z: Phase| {
            if n > 0 {
                errors.push(z.theta - truth[((n - 1) % steps) as usize].theta);
            }
        });
        let info = method.info();
        Self::fit(&errors, truth.len(), !(info.symplectic || info.symmetric))
    }

    /// The law that the errors (rad) of an odd number of periods follow, each of so many `steps`; with e₂ if the action
    /// `drifts`.
    fn fit(errors: &[f64], steps: usize, drifts: bool) -> Self {
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

    /// The largest error (rad) at any phase of any of so many periods.
    fn error(&self, periods: u64) -> f64 {
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
    fn drift(&self) -> f64 {
        self.growth.iter().map(|e| e[2].abs()).fold(0.0, libm::fmaximum)
    }

    /// This rung as it must be where the step is smaller by `factor`, to a whole number of steps, if e₂ goes as h to the power
    /// `drift`.
    fn refined(&self, factor: f64, order: f64, drift: f64) -> Self {
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
    /// Whether the last rung drowned in rounding, and finer ones would tell nothing.
    fn is_exhausted(&self) -> bool {
        self.rungs.last().is_some_and(|rung| {
            rung.error(rung.periods) < self.scene.rounding(self.method, rung.steps, rung.periods)
        })
    }

    /// The error over a run of so many periods, as a function of the step.
    pub fn over(&self, periods: u64) -> Curve {
        let clear = |rung: &Rung| {
            // Rounding at the end of the measured run is carried on as what it is taken for; a second difference of three
            // errors is four times as uncertain as a first one.
            let rounding = self.scene.rounding(self.method, rung.steps, rung.periods);
            let beyond = (periods as f64 / rung.periods as f64).max(1.0);
            let carried = if rung.drift() > 0.0 { 4.0 * beyond * beyond } else { beyond };
            rung.error(periods) > CLEAR * carried * rounding
        };
        // In long steps an implicit method may find no solution, and its errors are no numbers.
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
        Curve { method: self.method, scene: self.scene, periods, points }
    }
}

/// A method's error over a run of a certain length, as a function of the number of steps a period.
#[derive(Clone, Debug)]
pub struct Curve {
    method: MethodRef,
    scene: Release,
    periods: u64,
    /// The steps a period, and the logarithm of the error (rad).
    points: Vec<(f64, f64)>,
}

/// What a method needs to keep its error within what is allowed.
#[derive(Clone, Copy, Debug)]
pub struct Advice {
    /// The method.
    pub method: MethodRef,
    /// Steps a period.
    pub steps: u64,
    /// Force evaluations over the whole run.
    pub evaluations: u64,
}

impl Curve {
    /// The fewest steps a period, and no luck, with which the error stays below `allowed` (rad), rounding included; `None`
    /// where rounding alone may exceed it.
    pub fn advice(&self, allowed: f64) -> Option<Advice> {
        /// More steps add rounding, and may so ask for more steps: a few rounds settle it, or nothing does.
        const ROUNDS: usize = 100;
        let mut steps = 1;
        for _ in 0..ROUNDS {
            let left = allowed - self.scene.rounding(self.method, steps, self.periods);
            let needed = libm::ceil(self.steps_for(left)?);
            if needed * self.periods as f64 > pendula::error::MAX_STEPS as f64 {
                return None;
            }
            if needed as u64 <= steps {
                let evaluations = self.evaluations(steps);
                return Some(Advice { method: self.method, steps, evaluations });
            }
            steps = needed as u64;
        }
        None
    }

    /// Force evaluations over the whole run. An implicit method iterates, more often in longer steps, and where the motion
    /// bends more: it is counted over a period, or over some steps from each eighth of one, and carried on.
    fn evaluations(&self, steps: u64) -> u64 {
        const COUNTED: u64 = 1024;
        const EIGHTHS: u64 = 8;
        let info = self.method.info();
        if info.implicit {
            let starts = if steps > COUNTED { EIGHTHS } else { 1 };
            let step = self.scene.period / steps as f64;
            let some = Grid::new(step, steps.min(COUNTED) / starts).expect("a positive step");
            let motion = Motion::new(&Pendulum::PAPER, self.scene.start).expect("a finite start");
            let count = |i| {
                let start = motion.at(self.scene.period * (i as f64 / EIGHTHS as f64));
                self.method.count_evaluations(&Pendulum::PAPER, start, &some)
            };
            let counted: u64 = (0..starts).map(count).sum();
            (counted as f64 / (starts * some.steps()) as f64 * (steps * self.periods) as f64) as u64
        } else {
            info.start_evaluations + info.force_evaluations * steps * self.periods
        }
    }

    /// The error of the method itself (rad) with so many steps a period; NaN beyond the ladder.
    pub fn error(&self, steps: u64) -> f64 {
        let steps = steps as f64;
        let pair = self.points.windows(2).find(|pair| (pair[0].0..=pair[1].0).contains(&steps));
        pair.map_or(f64::NAN, |pair| {
            let ((m, e), (finer, less)) = (pair[0], pair[1]);
            libm::exp(e + (less - e) * libm::log(steps / m) / libm::log(finer / m))
        })
    }

    /// The number of steps a period, a fraction perhaps, at which the error is `wanted` (rad).
    fn steps_for(&self, wanted: f64) -> Option<f64> {
        // Of what is not positive the logarithm is no number, or below all others.
        let wanted = libm::log(wanted);
        self.points.last().filter(|(_, least)| *least <= wanted)?;
        // From the finest rung upwards: a coarse step whose error is small by chance is not met.
        let above = self.points.windows(2).rfind(|pair| pair[0].1 > wanted);
        Some(above.map_or(self.points[0].0, |pair| {
            let ((m, e), (finer, less)) = (pair[0], pair[1]);
            // Between coarse rungs nothing is known: an order of 24 may turn into one of 30 there.
            if m < COARSE as f64 {
                return finer;
            }
            m * libm::pow(finer / m, (e - wanted) / (e - less))
        }))
    }
}

// ---------------------------------------------------------------------------------------------------------------------
// The map
// ---------------------------------------------------------------------------------------------------------------------

/// A cell of the map.
#[derive(Clone, Debug)]
pub struct Cell {
    /// Length of the run (periods).
    pub periods: u64,
    /// Largest error of the angle allowed over the run (rad).
    pub allowed: f64,
    /// What each method needs that can do it, the one with the fewest force evaluations first.
    pub ranking: Vec<Advice>,
}

// ANCHOR: map
/// The whole map, for all methods of the library.
pub fn map() -> Vec<Cell> {
    let profiles = profiles(&Release::new());
    let mut map = Vec::new();
    for periods in PERIODS {
        let curves: Vec<Curve> = profiles.iter().map(|profile| profile.over(periods)).collect();
        for allowed in allowed() {
            let advice = curves.iter().filter_map(|curve| curve.advice(allowed));
            let mut ranking: Vec<Advice> = advice.collect();
            ranking.sort_by_key(|advice| advice.evaluations);
            map.push(Cell { periods, allowed, ranking });
        }
    }
    map
}
// ANCHOR_END: map

#[cfg(test)]
mod tests {
    use pendula::methods::registry::method_named;

    use super::*;

    fn named(name: &str) -> MethodRef {
        method_named(name).expect("a method of the library")
    }

    fn rung(steps: u64, growth: [f64; 3]) -> Rung {
        Rung { steps, periods: 8, growth: vec![[0.0; 3], growth], seen: Vec::new() }
    }

    /// e₀ + e₁n + e₂n² at both ends of the run, and at its vertex where that lies between.
    ///
    /// Catches: a vertex elsewhere, one beside the run that counts, a sign that hides an error.
    #[test]
    fn the_largest_error_is_at_an_end_or_at_the_vertex() {
        let hump = rung(64, [0.0, 8.0, -2.0]);
        assert_eq!(
            [1, 2, 3, 4, 5, 7].map(|periods| hump.error(periods)),
            [0.0, 6.0, 8.0, 8.0, 8.0, 24.0]
        );
        let apart = rung(64, [-3.0, 4.0, 2.0]);
        assert_eq!([1, 2, 3].map(|periods| apart.error(periods)), [3.0, 3.0, 13.0]);
        let seen = Rung { seen: vec![0.5, 0.75], ..hump };
        assert_eq!([1, 2, 3].map(|periods| seen.error(periods)), [0.5, 0.75, 8.0]);
    }

    /// Catches: another first or last error, and steps between them that are not half decades.
    #[test]
    fn the_errors_allowed_go_down_by_half_decades() {
        let logarithms = allowed().map(libm::log10);
        for (i, logarithm) in logarithms.iter().enumerate() {
            // A power and a logarithm, each good to an ulp, of numbers up to ten.
            assert!((logarithm + 1.0 + 0.5 * i as f64).abs() < 1e-14, "{i}: {logarithm}");
        }
    }

    /// The errors of 2q + 1 periods, q being `half`, that follow the law with these coefficients at the first phase, and
    /// with half of them at the others.
    fn lawful(steps: usize, half: usize, [e0, e1, e2]: [f64; 3]) -> Vec<f64> {
        let period = |n: usize| {
            let error = e0 + n as f64 * (e1 + n as f64 * e2);
            core::iter::once(error).chain(core::iter::repeat_n(0.5 * error, steps - 1))
        };
        (0..=2 * half).flat_map(period).collect()
    }

    /// The numbers are binary fractions, and nothing is rounded.
    ///
    /// Catches: a coefficient off by a factor; one of a drift where there is none; phases mixed up, or left out where they
    /// are few.
    #[test]
    fn the_law_is_found_in_errors_that_follow_it() {
        let law = [1.0 / 1024.0, -3.0 / 4096.0, 1.0 / 16_384.0];
        for steps in [COARSE as usize, 100, 512] {
            let rung = Rung::fit(&lawful(steps, 8, law), steps, true);
            assert_eq!((rung.steps, rung.periods), (steps as u64, 16));
            assert_eq!(rung.growth[0], law);
            assert!(rung.growth[1..].iter().all(|e| *e == law.map(|e| 0.5 * e)));
            assert_eq!(rung.growth.len(), steps.min(PHASES));
            assert!(rung.seen.is_empty());
        }
        let straight = Rung::fit(&lawful(32, 8, [law[0], law[1], 0.0]), 32, false);
        assert_eq!(straight.growth[0], [law[0], law[1], 0.0]);
        // Without e₂ what bends is taken for its chord from the first period to the last.
        let chord = Rung::fit(&lawful(32, 8, law), 32, false);
        assert_eq!(chord.growth[0], [law[0], law[1] + 16.0 * law[2], 0.0]);
    }

    /// Catches: a law taken from errors too large for it; a run cut too short, or to nothing.
    #[test]
    fn where_the_error_is_large_a_shorter_run_is_taken() {
        let periods = |e1: f64| Rung::fit(&lawful(32, 8, [0.0, e1, 0.0]), 32, false).periods;
        assert_eq!(periods(LARGE.next_down() / 16.0), 16);
        assert_eq!(periods(LARGE / 16.0), 8);
        assert_eq!(periods(LARGE / 4.0), 2);
        assert_eq!([LARGE, f64::NAN].map(periods), [2, 2]);
    }

    /// Catches: the last error taken for the largest, and steps just fine enough taken for coarse ones.
    #[test]
    fn in_coarse_steps_the_largest_error_so_far_is_kept() {
        let rung = Rung::fit(&[1.0, -2.0, 0.0, 1.0, -3.0, 3.5], 2, false);
        assert_eq!((rung.steps, rung.periods), (2, 3));
        assert_eq!(rung.seen, [2.0, 2.0, 3.5]);
        let steps = COARSE as usize;
        assert!(Rung::fit(&lawful(steps, 1, [0.0; 3]), steps, false).seen.is_empty());
        assert_eq!(Rung::fit(&lawful(steps - 1, 1, [0.0; 3]), steps - 1, false).seen, [0.0; 3]);
    }

    /// Catches: a method whose action keeps still, by either property, fitted with a drift; one that loses action without.
    #[test]
    fn only_a_method_without_symmetry_drifts() {
        let scene = Release::new();
        let motion = Motion::new(&Pendulum::PAPER, scene.start).unwrap();
        let grid = scene.grid(32, 1);
        let truth: Vec<Phase> = (1..=32).map(|n| motion.at(grid.time(n))).collect();
        let drift = |name| Rung::measure(named(name), &scene, &truth).drift();
        assert!(drift("rk4") > 0.0);
        // Symplectic and not symmetric, and both.
        assert_eq!(["symplectic-euler", "stormer-verlet"].map(drift), [0.0, 0.0]);
    }

    /// The steps of those of two rungs that RK4's curve over so many periods is made of.
    fn kept(rungs: [Rung; 2], periods: u64) -> Vec<u64> {
        let profile =
            Profile { method: named("rk4"), scene: Release::new(), rungs: rungs.to_vec() };
        let points = profile.over(periods).points;
        points.iter().map(|(steps, _)| *steps as u64).collect()
    }

    /// Eight periods of 64 steps, whose error is ten times what rounding adds, and that many times more as it is carried
    /// beyond the run that was measured: in proportion to its length, and where the action drifts, four times its square.
    ///
    /// Catches: an error made of rounding that counts, a clear one that does not, a run cut short taken for one gone beyond.
    #[test]
    fn an_error_counts_where_it_is_clear_of_rounding() {
        let rounding = Release::new().rounding(named("rk4"), 64, 8);
        let at = |bound: f64, periods, growth: [f64; 3]| {
            let coarser = rung(32, [1.0, 0.0, 0.0]);
            let [e0, e1, e2] = growth.map(|e| e * bound);
            kept([coarser, rung(64, [e0, e1, e2])], periods)
        };
        for (periods, carried) in [(1, 1.0), (8, 1.0), (24, 3.0)] {
            let bound = CLEAR * carried * rounding;
            assert_eq!(at(bound, periods, [1.0, 0.0, 0.0]), [32], "{periods}");
            assert_eq!(at(bound.next_up(), periods, [1.0, 0.0, 0.0]), [32, 64], "{periods}");
            let drifting = [1.0, 0.0, 1e-20];
            assert_eq!(at(4.0 * carried * bound * (1.0 - 1e-9), periods, drifting), [32]);
            assert_eq!(at(4.0 * carried * bound * (1.0 + 1e-9), periods, drifting), [32, 64]);
        }
    }

    /// Catches: a law taken for granted where steps are too coarse for it, a rung lost that was seen all along, the run of
    /// an implicit method that found no solution, and one in short steps passed over as if it were coarse.
    #[test]
    fn of_coarse_steps_the_curve_knows_what_was_seen() {
        let coarse = |steps, last| Rung {
            seen: vec![0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, last],
            ..rung(steps, [0.5, 0.0, 0.0])
        };
        let fine = || rung(64, [0.25, 0.0, 0.0]);
        assert_eq!(kept([coarse(COARSE - 1, 0.5), fine()], 8), [COARSE - 1, 64]);
        assert_eq!(kept([coarse(COARSE - 1, 0.5), fine()], 9), [64]);
        assert_eq!(kept([rung(COARSE, [0.5, 0.0, 0.0]), fine()], 9), [COARSE, 64]);
        for lost in [f64::NAN, f64::INFINITY] {
            assert_eq!(kept([coarse(COARSE - 1, lost), fine()], 7), [COARSE - 1, 64]);
            assert_eq!(kept([coarse(COARSE - 1, lost), fine()], 8), [64]);
        }
        assert_eq!(kept([rung(COARSE, [f64::NAN, 0.0, 0.0]), fine()], 8), []);
    }

    /// RK4 with a drift that falls with the fourth power of the step, and with the fifth; four octaves apart and two.
    ///
    /// Catches: a power that is not the ladder's own, or not rounded to the order or the next.
    #[test]
    fn a_drift_goes_on_with_its_own_power() {
        for power in [4, 5] {
            for octave in [2_u64, 4] {
                let drift = |k: u32| 1e-4 / (octave.pow(k * power) as f64);
                let rungs =
                    (0..3).map(|k| rung(32 * octave.pow(k), [0.0, 0.0, drift(k)])).collect();
                let profile = Profile { method: named("rk4"), scene: Release::new(), rungs };
                let curve = profile.over(11);
                let last = 32 * octave.pow(2);
                // e₂ · 10², and sixteen times as many steps.
                let expected = 100.0 * drift(2) / (16_u64.pow(power) as f64);
                let error = curve.error(16 * last);
                // Powers and logarithms of numbers up to 50.
                assert!((error / expected - 1.0).abs() < 1e-12, "{power}, {octave}: {error:e}");
            }
        }
    }

    /// The curve of a method through these steps a period and errors (rad).
    fn curve(name: &str, periods: u64, points: &[(f64, f64)]) -> Curve {
        let points = points.iter().map(|(n, e)| (*n, libm::log(*e))).collect();
        Curve { method: named(name), scene: Release::new(), periods, points }
    }

    /// Half an octave below 16 steps are 22.6 of them: 23, and their error.
    ///
    /// Catches: the error of a fraction of a step; e₂ that goes with the power of the others.
    #[test]
    fn a_rung_below_the_last_has_whole_steps() {
        let finer = rung(16, [1.0, -0.5, 0.25]).refined(core::f64::consts::SQRT_2, 4.0, 5.0);
        let (by, drift) = (libm::pow(23.0 / 16.0, -4.0), libm::pow(23.0 / 16.0, -5.0));
        assert_eq!((finer.steps, finer.periods), (23, 8));
        assert_eq!(finer.growth, [[0.0; 3], [by, -0.5 * by, 0.25 * drift]]);
    }

    /// Catches: an error read beside its chord, or beyond the curve; steps for an error that the curve does not reach.
    #[test]
    fn between_two_rungs_the_curve_is_a_chord() {
        let curve = curve("rk4", 3, &[(32.0, 1e-2), (64.0, 1e-4), (128.0, 1e-5)]);
        // Half-way between the rungs on logarithmic axes, but for rounding to whole steps.
        for (steps, expected) in [(32, 1e-2), (64, 1e-4), (128, 1e-5)] {
            assert!((curve.error(steps) / expected - 1.0).abs() < 1e-13);
        }
        let at = |n: f64, (m, e): (f64, f64), power: f64| e * libm::pow(n / m, -power);
        assert!((curve.error(45) / at(45.0, (32.0, 1e-2), libm::log2(100.0)) - 1.0).abs() < 1e-13);
        assert!((curve.error(90) / at(90.0, (64.0, 1e-4), libm::log2(10.0)) - 1.0).abs() < 1e-13);
        assert!(curve.error(31).is_nan() && curve.error(129).is_nan());
        for n in [45, 90] {
            let steps = curve.steps_for(curve.error(n)).unwrap();
            assert!((steps / n as f64 - 1.0).abs() < 1e-13, "{steps}");
        }
        for none in [f64::NAN, -1.0, 0.0, 9e-6] {
            assert_eq!(curve.steps_for(none), None);
        }
    }

    /// Catches: a chord where the rungs are too coarse for one, also at the first that is not; a step more than a rung has,
    /// by rounding.
    #[test]
    fn coarse_rungs_are_taken_as_they_are() {
        let coarse = COARSE as f64;
        let points = [(8.0, 2.0), (11.0, 1.0), (coarse, 1e-2), (2.0 * coarse, 1e-4)];
        let curve = curve("rk4", 3, &points);
        assert_eq!(
            [3.0, 1.5, 0.5].map(|wanted| curve.steps_for(wanted).unwrap()),
            [8.0, 11.0, coarse]
        );
        let between = curve.steps_for(1e-3).unwrap();
        assert!(between > 1.2 * coarse && between < 1.6 * coarse, "{between}");
    }

    /// Catches: a run of more steps than can be counted, a limit that is off.
    #[test]
    fn a_run_too_long_to_be_counted_is_not_advised() {
        let advice =
            |periods| curve("rk4", periods, &[(1024.0, 1e99), (2048.0, 1e98)]).advice(1e100);
        let most = pendula::error::MAX_STEPS / 1024;
        assert_eq!(advice(most).map(|advice| advice.steps), Some(1024));
        assert!(advice(most + 1).is_none());
    }

    /// Catches: evaluations counted once, or by the period; a count of sweeps in other steps than the run's, or in one place.
    #[test]
    fn the_force_is_counted_over_the_whole_run() {
        let of = |name, steps| curve(name, 3, &[(32.0, 1.0), (64.0, 0.1)]).evaluations(steps);
        assert_eq!((of("rk4", 50), of("stormer-verlet", 50)), (600, 151));
        let scene = Release::new();
        // From one of its eighths the second is miscounted by 3.8 %.
        for (name, steps) in [("gauss-4", 50), ("gauss-6", 3000)] {
            let grid = scene.grid(steps, 3);
            let counted = named(name).count_evaluations(&Pendulum::PAPER, scene.start, &grid);
            let carried = of(name, steps) as f64;
            // Where the number of sweeps changes, half an eighth of the period is miscounted by one sweep in five or so: 1.3 %,
            // and a swing has two such places.
            assert!((carried / counted as f64 - 1.0).abs() < 0.03, "{carried} and {counted}");
        }
    }

    /// Catches: the angle without its amplitude, or its lag.
    #[test]
    fn rounding_is_the_walks_of_angle_and_time() {
        let (scene, method) = (Release::new(), named("rk4"));
        // 4 · 25 · 100 roundings: 2 · 0.6 ε · 100 of 1 rad, and of the lag.
        let lag = scene.fastest * scene.sensitivity * scene.period * 100.0 / 3.0_f64.sqrt();
        let expected = 120.0 * f64::EPSILON * libm::hypot(THETA_0, lag);
        assert!((scene.rounding(method, 25, 100) / expected - 1.0).abs() < 1e-14);
        let brief = scene.rounding(method, 25, 1) / (12.0 * f64::EPSILON);
        let lag = 0.01 * lag;
        assert!((brief - libm::hypot(THETA_0, lag)).abs() < 1e-13, "{brief}");
    }
}
