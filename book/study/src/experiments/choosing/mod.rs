//! Choosing an integrator: for a given length of the run and a given allowed error, which method
//! needs the fewest force evaluations, and at which step?
//!
//! Each method is measured on a ladder of steps that divide the period, so that every period has
//! its samples at the same phases. At each phase the error of the angle is then a slow function of
//! the number n of periods, which theory gives: the method follows, to all powers of h, a modified
//! equation, whose solutions are near those of the pendulum in action and angle. The mean change of
//! the action in a step makes it drift as n; an error of the action changes the frequency, and the
//! angle by the sum of that. So the error is
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
//! The pendulum is released at 1 rad, but each method starts an eighth of a period later. From
//! rest, at a point of symmetry, a method that is not symmetric looks better than it is: symplectic
//! Euler would be of order two there.

mod error_law;

pub use error_law::{LONGEST, Profile, Rung, profile_of, profiles};
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

/// Amplitude of the swing (rad).
pub const THETA_0: f64 = 1.0;

/// The swing that every method is measured on.
#[derive(Clone, Copy, Debug)]
pub struct Release {
    /// Where each method starts: an eighth of a period after the release.
    pub start: Phase,
    /// The period T (s).
    pub period: f64,
    /// The largest angular velocity (rad/s).
    fastest: f64,
    /// d ln T / d ln E, with the energy E above the bottom: the relative error of the period per
    /// relative error of the energy.
    sensitivity: f64,
}

impl Release {
    /// The paper's pendulum at the amplitude [`THETA_0`].
    pub fn new() -> Self {
        /// For a central difference, whose error is of order δ².
        const DELTA: f64 = 1e-4;
        let pendulum = Pendulum::PAPER;
        let motion = Motion::new(&pendulum, Phase::at_rest(THETA_0)).expect("a finite start");
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

/// Steps a period from which the error follows the law; at coarser steps the map uses only what
/// was measured.
///
/// The samples have the same phases in every period, so that the change of the action beyond all
/// powers of h, e^{−c/h}, adds up instead of cancelling: with ten steps a period the error of
/// Blanes and Moan's method of order 6 after 5000 periods is a hundred times what its first 256
/// predict.
pub const COARSE: u64 = 24;

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
    /// The fewest steps a period from which on the error stays below `allowed` (rad), rounding
    /// included; `None` where rounding alone may exceed it, or the run would have too many steps.
    pub fn advice(&self, allowed: f64) -> Option<Advice> {
        /// More steps add rounding, which may require more steps: this converges in a few
        /// iterations or never.
        const ROUNDS: usize = 100;
        let mut steps = 1;
        for _ in 0..ROUNDS {
            let left = allowed - self.release.rounding(self.method, steps, self.periods);
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

    /// Force evaluations over the whole run. An implicit method iterates, more often in longer
    /// steps and where the motion is more curved: its evaluations are counted over a period, or
    /// over some steps from each eighth of one, and scaled to the run.
    pub fn evaluations(&self, steps: u64) -> u64 {
        const COUNTED: u64 = 1024;
        const EIGHTHS: u64 = 8;
        let info = self.method.info();
        if info.implicit {
            let starts = if steps > COUNTED { EIGHTHS } else { 1 };
            let step = self.release.period / steps as f64;
            let some = Grid::new(step, steps.min(COUNTED) / starts).expect("a positive step");
            let motion = Motion::new(&Pendulum::PAPER, self.release.start).expect("a finite start");
            let count = |i| {
                let start = motion.at(self.release.period * (i as f64 / EIGHTHS as f64));
                super::evaluations(self.method, start, &some)
            };
            let counted: u64 = (0..starts).map(count).sum();
            (counted as f64 / (starts * some.steps()) as f64 * (steps * self.periods) as f64) as u64
        } else {
            info.start_evaluations + info.force_evaluations * steps * self.periods
        }
    }

    /// The error of the method, without rounding (rad), with `steps` steps a period; NaN beyond
    /// the ends of the curve.
    pub fn error(&self, steps: u64) -> f64 {
        let steps = steps as f64;
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
            // Coarse rungs are not interpolated: between them an order of 24 may become one of 30.
            if m < COARSE as f64 {
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

/// The whole map, for all methods of the library.
pub fn map() -> Vec<Cell> {
    let mut map = Vec::new();
    for periods in PERIODS {
        let curves: Vec<Curve> = profiles().map(|profile| profile.over(periods)).collect();
        for allowed in allowed() {
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
    let curve = |method: &MethodRef| profile_of(*method).over(COMPARED_PERIODS);
    methods.iter().map(|method| curve(method).advice(COMPARED_ALLOWED)).collect()
}
