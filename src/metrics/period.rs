//! The period, read off the samples in four ways. The reading matters more than the method.
//!
//! | reading | observer | off by |
//! |---|---|---|
//! | the highest sample | [`PeakPeriod::default`] | half a step |
//! | the parabola through it and its neighbours | [`PeakPeriod::parabola`] | O(h³) |
//! | the straight line through a crossing | [`CrossingPeriod::new`] [`Linear`] | O(h³) |
//! | the cubic through a crossing | [`CrossingPeriod::default`], by [`Hermite`] | O(h⁵) |
//!
//! In general a line and a cubic are accurate to O(h²) and O(h⁴); what they leave out begins with
//! the second and with the fourth derivative of θ. At the bottom of the pendulum both are zero,
//! which makes each better by one order there.

use crate::integrate::Observer;
use crate::systems::Phase;

// -------------------------------------------------------------------------------------------------
// Peaks
// -------------------------------------------------------------------------------------------------

/// How the time of a peak is read off the samples around it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Peak {
    /// The time of the highest sample: off by half a step at worst. It measures the grid, not the
    /// method.
    #[default]
    Sample,
    /// The vertex of the parabola through the highest sample and its neighbours: O(h³).
    Parabola,
}

/// Period as the time of the first peak of θ after the start (s): of the first sample that is
/// higher than its neighbours, or of the vertex near it.
///
/// By default it is the sample, which is how the paper reads it.
#[derive(Clone, Debug, Default)]
pub struct PeakPeriod {
    reading: Peak,
    /// Time and angle of the last two samples, the later one first.
    last: [Option<(f64, f64)>; 2],
    peak: Option<f64>,
}

impl PeakPeriod {
    /// Reads the peak off a parabola.
    pub fn parabola() -> Self {
        Self { reading: Peak::Parabola, ..Self::default() }
    }

    /// The time of the first local maximum of θ after the start, if there was one (s).
    pub const fn period(&self) -> Option<f64> {
        self.peak
    }
}

impl Observer<Phase> for PeakPeriod {
    fn observe(&mut self, _n: u64, t: f64, z: Phase) {
        if let [Some((at, highest)), Some((_, rising))] = self.last
            && self.peak.is_none()
            && rising < highest
            && highest >= z.theta
        {
            let (left, right) = (rising - highest, z.theta - highest);
            self.peak = Some(match self.reading {
                Peak::Sample => at,
                Peak::Parabola => at + 0.5 * (t - at) * (left - right) / (left + right),
            });
        }
        self.last = [Some((t, z.theta)), self.last[0]];
    }

    fn is_satisfied(&self) -> bool {
        self.peak.is_some()
    }
}

// -------------------------------------------------------------------------------------------------
// Crossings
// -------------------------------------------------------------------------------------------------

/// How the time of a downward crossing of θ = 0 is found between two samples.
pub trait CrossingRule {
    /// The time of the crossing (s), between the sample `from` at time `before`, with θ > 0, and
    /// `to` at `after`, with θ ≤ 0.
    fn time(&self, before: f64, from: Phase, after: f64, to: Phase) -> f64;
}

/// The straight line through both samples.
#[derive(Clone, Copy, Debug, Default)]
pub struct Linear;

impl CrossingRule for Linear {
    fn time(&self, before: f64, from: Phase, after: f64, to: Phase) -> f64 {
        before + (after - before) * (from.theta / (from.theta - to.theta))
    }
}

/// The cubic through both samples and their velocities (Hermite's interpolant).
#[derive(Clone, Copy, Debug, Default)]
pub struct Hermite;

impl CrossingRule for Hermite {
    fn time(&self, before: f64, from: Phase, after: f64, to: Phase) -> f64 {
        let h = after - before;
        before + h * hermite_root(from.theta, h * from.omega, to.theta, h * to.omega)
    }
}

/// Period as the time between downward crossings of θ = 0 (s), each found by a [`CrossingRule`].
///
/// By default that is [`Hermite`]'s cubic. It is accurate to O(h⁵), so that the error of the method
/// remains.
#[derive(Clone, Debug)]
pub struct CrossingPeriod<C = Hermite> {
    crossing: C,
    last: Option<(f64, Phase)>,
    first_crossing: f64,
    last_crossing: f64,
    crossings: u32,
}

impl Default for CrossingPeriod {
    fn default() -> Self {
        Self::new(Hermite)
    }
}

impl<C> CrossingPeriod<C> {
    /// Finds each crossing with `crossing`.
    pub const fn new(crossing: C) -> Self {
        Self { crossing, last: None, first_crossing: 0.0, last_crossing: 0.0, crossings: 0 }
    }

    /// Mean time between the downward crossings seen (s); `None` with fewer than two.
    pub fn period(&self) -> Option<f64> {
        (self.crossings >= 2)
            .then(|| (self.last_crossing - self.first_crossing) / f64::from(self.crossings - 1))
    }
}

impl<C: CrossingRule> Observer<Phase> for CrossingPeriod<C> {
    fn observe(&mut self, _n: u64, t: f64, z: Phase) {
        if let Some((before, from)) = self.last
            && from.theta > 0.0
            && z.theta <= 0.0
        {
            self.last_crossing = self.crossing.time(before, from, t, z);
            if self.crossings == 0 {
                self.first_crossing = self.last_crossing;
            }
            self.crossings += 1;
        }
        self.last = Some((t, z));
    }
}

/// The root in [0, 1] of the cubic with values `y0` > 0 ≥ `y1` and slopes `d0`, `d1` at 0 and 1.
fn hermite_root(y0: f64, d0: f64, y1: f64, d1: f64) -> f64 {
    // y0 + s (d0 + s (c2 + s c3))
    let rise = y1 - y0;
    let (c2, c3) = (3.0 * rise - 2.0 * d0 - d1, d0 + d1 - 2.0 * rise);
    let (mut low, mut high) = (0.0, 1.0);
    let mut s = y0 / (y0 - y1);
    // Newton's method, kept inside the bracket by bisection. It is quadratic from a good start and
    // at worst halves the bracket; 60 halvings exhaust an f64.
    for _ in 0..60 {
        let value = y0 + s * (d0 + s * (c2 + s * c3));
        if value > 0.0 {
            low = s;
        } else {
            high = s;
        }
        let slope = d0 + s * (2.0 * c2 + s * 3.0 * c3);
        let newton = s - value / slope;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - s).abs() <= f64::EPSILON * 0.5 {
            return next;
        }
        s = next;
    }
    s
}
