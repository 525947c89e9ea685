//! Choosing an integrator: for a given length of the run and a given allowed error, which method
//! needs the fewest force evaluations, and at which step?
//!
//! Each method is measured on a ladder of steps, and its errors are compared at equal phases of the
//! period. At each phase the error of the angle is a slow function of the number n of periods,
//! which theory gives: the method follows, to all powers of h, a modified equation, whose solutions
//! are near those of the pendulum in action and angle. The mean change of the action in a step
//! makes it drift as n; an error of the action changes the frequency, and the angle by the sum of
//! that. So the error is
//!
//! e(n) = e₀ + e₁n + e₂n²,
//!
//! with e₂ = 0 for methods that are symplectic, or symmetric on a reversible motion such as this:
//! their action does not drift (Hairer, Lubich, Wanner, *Geometric Numerical Integration* (2006),
//! Theorems X.3.1 and XI.3.1, for times up to h⁻ᵖ; for longer ones Sects. X.4 to X.6 and XI.4). The
//! coefficients are taken from the first, the middle and the last
//! period of a run of up to [`LONGEST`]; for longer runs the error is extrapolated by this law. At
//! steps too small to be measured clear of rounding, e₀ and e₁ are extrapolated by the method's
//! order, and e₂ by its order or one more, as measured.
//!
//! What the modified equation leaves out, e^{−c/h}, is large in long steps. A step is a push with
//! the frequency 1/h, and resonant with the motion's harmonic j if j of them last m periods, for
//! whole numbers j and m; the strength of the resonance falls as e^{−ρj}, where ρ is the distance
//! of the motion's singularities from real times, in radians of the phase. If a period has a whole
//! number s of steps, one resonance of order s (by the pendulum's mirror symmetry 2s where s is
//! odd) pushes the same way for ever, and the action walks off: with ten steps a period the error
//! of Blanes and Moan's method of order 6 after 40 000 periods is 35 times what its first 256
//! predict; with 9.875 and with 10.125 it is what they predict. Away from a resonance the action
//! swings about a mean, once in 1/|ms − j| periods, and the motion lies on a curve that the step
//! maps to itself: on it the error is e₁n and a bounded rest for all times (Moser's theorem). So
//! coarse steps are chosen to lie between the resonances of low order: there is an odd number of
//! steps in eight periods, so that the phases repeat after those, by a resonance of order 8s; and s
//! is an eighth or more away from a whole number, and as far from a half, so that what swings does
//! so within eight periods, of which a measured run has many. Each of these rungs is measured. A
//! method is charged with the first of them from which on all finer ones are exact enough: nothing
//! is interpolated there, a step that is good by chance does not count, and no method is excluded
//! because its steps are long.
//!
//! The pendulum is released from rest, but each method starts an eighth of a period later. From
//! rest, at a point of symmetry, a method that is not symmetric looks better than it is: symplectic
//! Euler would be of order two there.

mod error_law;

use std::sync::OnceLock;

pub use error_law::{LONGEST, PROJECTED, Profile, Rung, profile_of, profiles, ranked};
use pendula::exact::{Motion, period};
use pendula::{Grid, Pendulum, Phase};

use super::MethodRef;

/// Lengths of runs (periods), three to a decade.
pub const PERIODS: [u64; 16] =
    [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10_000, 20_000, 50_000, 100_000];

/// Largest errors of the angle (rad) allowed over the run, two to a decade: from 1e-1 down to
/// 1e-10.
pub fn allowed() -> [f64; 19] {
    core::array::from_fn(|i| libm::exp10(-1.0 - 0.5 * i as f64))
}

/// Amplitudes of the swings (rad) that the methods are measured on, each a map of its own.
pub const SWINGS: [f64; 4] = [0.3, THETA_0, 2.0, 3.0];

/// The amplitude (rad) of the swing that is measured in the longest runs and on the finest ladder.
pub const THETA_0: f64 = 1.0;

/// A swing that every method is measured on.
#[derive(Clone, Copy, Debug)]
pub struct Release {
    /// Amplitude of the swing (rad).
    pub theta_0: f64,
    /// Where each method starts: an eighth of a period after the release.
    pub start: Phase,
    /// The period T (s).
    pub period: f64,
    /// Steps a period from which they may be a whole number, and from which the error is
    /// interpolated; coarser ones are chosen from a ladder.
    pub coarse: f64,
    /// The largest angular velocity (rad/s).
    fastest: f64,
    /// d ln T / d ln E, with the energy E above the bottom: the relative error of the period per
    /// relative error of the energy.
    sensitivity: f64,
}

impl Release {
    /// The paper's pendulum at the amplitude `theta_0` (rad).
    pub fn new(theta_0: f64) -> Self {
        /// For a central difference, whose error is of order δ².
        const DELTA: f64 = 1e-4;
        /// A step of the imaginary period T′ over this is short. The motion is singular at the
        /// imaginary time T′/4, and so what a step resonates with is at most of the order of
        /// exp(−2π T′/4h) = e^{−48} = 10⁻²¹, which adds up over 10⁵ periods to 10¹⁰ times that,
        /// once in the action, and once more in the angle.
        const SHORT: f64 = 31.0;
        let pendulum = Pendulum::PAPER;
        let motion = Motion::new(&pendulum, Phase::at_rest(theta_0)).expect("a finite start");
        let at = |theta| period(&pendulum, theta).expect("a finite angle");
        let versine = |theta: f64| {
            let s = pendula::arithmetic::sine::sin(0.5 * theta);
            s * s
        };
        let (low, high) = (theta_0 - DELTA, theta_0 + DELTA);
        let period = at(theta_0);
        // In imaginary time the potential is upside down, and the motion has this period.
        let imaginary = at(core::f64::consts::PI - theta_0);
        Self {
            theta_0,
            start: motion.at(0.125 * period),
            period,
            coarse: libm::ceil(SHORT * period / imaginary),
            fastest: motion.at(0.25 * period).omega.abs(),
            sensitivity: libm::log(at(high) / at(low)) / libm::log(versine(high) / versine(low)),
        }
    }

    /// The grid of `periods` periods in `steps` steps each, the last of which may go beyond the
    /// end.
    pub fn grid(&self, steps: f64, periods: u64) -> Grid {
        Grid::new(self.period / steps, steps_of(steps, periods)).expect("a positive step")
    }

    /// What rounding may add to the angle (rad) in `periods` periods of `steps` steps: twice the
    /// standard deviation of two random walks.
    ///
    /// At each rounding of θ and ω, of which there are as many as force evaluations, the energy
    /// changes by 0.6 ε of itself at most (tests/theory/long_time.rs), and so does the angle. After
    /// n roundings the energy is off by 0.6 ε√n, the period by d ln T/d ln E times that, and the
    /// time by the sum over all periods: 1/√3 of what the last period's error would add up to if it
    /// held from the start (Brouwer, *Astronomical Journal* 46 (1937) 149).
    ///
    /// If a method's error in a period is below rounding and its step divides the period, every
    /// period is rounded alike, and the rounding error grows in proportion to n, not as a random
    /// walk. With a slightly different step it is a random walk; and on the map the methods' errors
    /// are larger.
    ///
    /// DOP853's roundings do not cancel: in runs of more than 10⁴ periods its error is larger than
    /// this, and grows in proportion to n² (tests/study/long_runs.rs). It is the best in none.
    pub fn rounding(&self, method: MethodRef, steps: f64, periods: u64) -> f64 {
        const ROUNDING: f64 = 0.6 * f64::EPSILON;
        let evaluations = method.info().force_evaluations as f64;
        let walk = ROUNDING * libm::sqrt(evaluations * steps * periods as f64);
        let late = self.sensitivity * self.period * periods as f64 / libm::sqrt(3.0);
        let angle = self.fastest * late;
        2.0 * walk * libm::hypot(self.theta_0, angle)
    }
}

/// How many steps `periods` periods take, if each takes `steps`.
fn steps_of(steps: f64, periods: u64) -> u64 {
    libm::ceil(steps * periods as f64) as u64
}

/// A method's error over a run of a certain length, as a function of the number of steps a period.
#[derive(Clone, Debug)]
pub struct Curve {
    /// The method.
    pub method: MethodRef,
    /// The swing.
    pub release: Release,
    /// Length of the run (periods).
    pub periods: u64,
    /// The steps a period, and the logarithm of the error (rad).
    pub points: Vec<(f64, f64)>,
    /// Up to so many steps a period the measured runs are as long as this one.
    pub known: f64,
    /// The most steps a period that were measured clear of rounding; for more, the error follows
    /// from the order.
    pub finest: f64,
}

/// What a method needs to keep its error within what is allowed.
#[derive(Clone, Copy, Debug)]
pub struct Advice {
    /// The method.
    pub method: MethodRef,
    /// Steps a period: a whole number or, where there are fewer than [`Release::coarse`], an odd
    /// number of eighths.
    pub steps: f64,
    /// Force evaluations over the whole run.
    pub evaluations: u64,
    /// Whether the error follows from the law: the run is longer than those that were measured, or
    /// its step is shorter.
    pub extrapolated: bool,
}

impl Curve {
    /// The fewest steps a period from which on the error stays below `allowed` (rad), rounding
    /// included; `None` where rounding alone may exceed it, or the run would have too many steps.
    pub fn advice(&self, allowed: f64) -> Option<Advice> {
        /// More steps add rounding, which may require more steps: this converges in a few
        /// iterations or never.
        const ROUNDS: usize = 100;
        let mut steps = 0.0;
        for _ in 0..ROUNDS {
            let left = allowed - self.release.rounding(self.method, steps, self.periods);
            let needed = self.steps_for(left)?;
            let needed = if needed < self.release.coarse { needed } else { libm::ceil(needed) };
            if needed * self.periods as f64 > pendula::error::MAX_STEPS as f64 {
                return None;
            }
            if needed <= steps {
                let (method, extrapolated) = (self.method, steps > self.known);
                let evaluations = self.evaluations(steps);
                return Some(Advice { method, steps, evaluations, extrapolated });
            }
            steps = needed;
        }
        None
    }

    /// Force evaluations over the whole run. An implicit method iterates, more often in longer
    /// steps and where the motion is more curved: its evaluations are counted over a period, or
    /// over some steps from each eighth of one, and scaled to the run.
    pub fn evaluations(&self, steps: f64) -> u64 {
        const COUNTED: f64 = 1024.0;
        const EIGHTHS: u64 = 8;
        let info = self.method.info();
        let all = steps_of(steps, self.periods);
        if info.implicit {
            let starts = if steps > COUNTED { EIGHTHS } else { 1 };
            let step = self.release.period / steps;
            let counted = libm::ceil(steps.min(COUNTED)) as u64 / starts;
            let some = Grid::new(step, counted).expect("a positive step");
            let motion = Motion::new(&Pendulum::PAPER, self.release.start).expect("a finite start");
            let count = |i| {
                let start = motion.at(self.release.period * (i as f64 / EIGHTHS as f64));
                super::evaluations(self.method, start, &some)
            };
            let counted: u64 = (0..starts).map(count).sum();
            (counted as f64 / (starts * some.steps()) as f64 * all as f64) as u64
        } else {
            info.start_evaluations + info.force_evaluations * all
        }
    }

    /// The error of the method, without rounding (rad), with `steps` steps a period; NaN beyond
    /// the ends of the curve.
    pub fn error(&self, steps: f64) -> f64 {
        let pair = self.points.windows(2).find(|pair| (pair[0].0..=pair[1].0).contains(&steps));
        pair.map_or(f64::NAN, |pair| {
            let ((m, e), (finer, less)) = (pair[0], pair[1]);
            libm::exp(e + (less - e) * libm::log(steps / m) / libm::log(finer / m))
        })
    }

    /// The number of steps a period, not always whole, at which the error is `wanted` (rad).
    pub fn steps_for(&self, wanted: f64) -> Option<f64> {
        // NaN or −∞, which no rung reaches, where `wanted` is not positive.
        let wanted = libm::log(wanted);
        self.points.last().filter(|(_, least)| *least <= wanted)?;
        // From the finest rung to the coarser, so that a coarse step whose error is small by
        // chance is skipped.
        let above = self.points.windows(2).rfind(|pair| pair[0].1 > wanted);
        Some(above.map_or(self.points[0].0, |pair| {
            let ((m, e), (finer, less)) = (pair[0], pair[1]);
            // Coarse rungs are not interpolated: between them there may be a resonance, or an order
            // of 24 may become one of 30.
            if m < self.release.coarse {
                return finer;
            }
            m * libm::pow(finer / m, (e - wanted) / (e - less))
        }))
    }
}

/// A cell of the map.
#[derive(Clone, Debug)]
pub struct Cell {
    /// Length of the run (periods).
    pub periods: u64,
    /// Largest error of the angle allowed over the run (rad).
    pub allowed: f64,
    /// What each method that can achieve it needs, the one with the fewest force evaluations
    /// first.
    pub ranking: Vec<Advice>,
}

/// The map of one of the [`SWINGS`], for all methods of the library: column by column, with each of
/// [`PERIODS`] and of [`allowed`] for [`THETA_0`], and for the others with one to a decade.
pub fn map(theta_0: f64) -> &'static [Cell] {
    static MAPS: [OnceLock<Vec<Cell>>; SWINGS.len()] = [const { OnceLock::new() }; SWINGS.len()];
    MAPS[swing(theta_0)].get_or_init(|| computed(theta_0))
}

/// The place of this amplitude (rad) among the [`SWINGS`].
fn swing(theta_0: f64) -> usize {
    SWINGS.iter().position(|swing| *swing == theta_0).expect("one of the swings")
}

fn computed(theta_0: f64) -> Vec<Cell> {
    let (third, second) = if theta_0 == THETA_0 { (1, 1) } else { (3, 2) };
    let mut map = Vec::new();
    for periods in PERIODS.into_iter().step_by(third) {
        let curves: Vec<Curve> = profiles(theta_0).map(|profile| profile.over(periods)).collect();
        for allowed in allowed().into_iter().step_by(second) {
            let advice = curves.iter().filter_map(|curve| curve.advice(allowed));
            let mut ranking: Vec<Advice> = advice.collect();
            ranking.sort_by_key(|advice| advice.evaluations);
            map.push(Cell { periods, allowed, ranking });
        }
    }
    map
}

/// Length of the run (periods) in [`costs`] …
const COMPARED_PERIODS: u64 = 100;
/// … and the largest error of the angle allowed over it (rad).
const COMPARED_ALLOWED: f64 = 1e-3;

/// What each of the methods needs for one answer, a cell of the map; none where a method cannot
/// achieve it.
pub fn costs(methods: &[MethodRef]) -> Vec<Option<Advice>> {
    let curve = |method: &MethodRef| profile_of(*method, THETA_0).over(COMPARED_PERIODS);
    methods.iter().map(|method| curve(method).advice(COMPARED_ALLOWED)).collect()
}
