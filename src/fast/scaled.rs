//! The pendulum with its step as the unit of time: the same motion in less time.
//!
//! With u = hω (rad a step) and K = h² g/L the pendulum is θ̈ + K sin θ = 0 and every step has
//! length 1, so that no method multiplies by h; symplectic Euler, u ← u − K sin θ, θ ← θ + u, is
//! then exactly Chirikov's standard map. Three things make it fast, all in this file and none in
//! the methods: the unit of time, the angle stored as half turns and a remainder, so that a sine
//! needs no reduction, and [deferred sums](Deferred).

use core::ops::{Add, Mul};

use super::deferred::Deferred;
use crate::arithmetic::sine::half_turn::{PI_PARTS, from_the_bottom, reduce, series, sin};
use crate::arithmetic::sine::{self, ROUNDER, sinc};
use crate::integrate::{Grid, Method};
use crate::systems::{
    Analytic, Components, MeanForce, NearlyLinear, Numbers, Pendulum, Phase, RateOf, Separable,
    State, System, Vector, growth,
};

/// The pendulum with time in steps.
///
/// `BRANCH` says how its angles are reduced: with a branch, for a single trajectory, or without,
/// for lanes. The bits are the same.
#[derive(Clone, Copy, Debug)]
pub struct ScaledPendulum<const BRANCH: bool = true> {
    /// −K = −h² g/L.
    pub(crate) minus_k: f64,
    /// The step h (s).
    pub(crate) step: f64,
}

/// The state: the angle as a remainder in [−π/2, π/2] and a number of half turns, and the velocity
/// in rad a step.
#[derive(Clone, Copy, Debug)]
pub struct ReducedPhase<const BRANCH: bool = true> {
    /// The remainder of the angle (rad).
    pub(crate) rest: f64,
    /// 1.5 · 2⁵² + n for n half turns: the lowest bit is that of n, and says whether the sine
    /// changes sign.
    pub(crate) turns: f64,
    pub(crate) velocity: Deferred,
}

/// A displacement of the state, or its rate of change.
#[derive(Clone, Copy, Debug)]
pub struct ReducedRate {
    pub(crate) angle: Deferred,
    pub(crate) velocity: Deferred,
}

impl<const BRANCH: bool> ScaledPendulum<BRANCH> {
    /// `pendulum` with its time in steps, for a run of the method `M` along `grid` that begins with
    /// the angle and angular velocity of `start`; `None` where the change of units could overflow
    /// or underflow, or the half turns could become too many to count, and for a grid without
    /// steps: there and back the start would be rounded.
    pub fn new<M: Method<Self>>(pendulum: &Pendulum, grid: &Grid, start: Phase) -> Option<Self> {
        let step = grid.step();
        // K and h, and what is computed from them, stay far from the ends of the range of f64: the
        // square of 1e-200 underflows, 1e-100 leaves room.
        let moderate = |x: f64| (1e-100..1e100).contains(&x);
        let k = pendulum.frequency_squared() * step * step;
        // The rounder counts 2⁵¹ half turns; the angle at the start is reduced exactly below 2²⁰,
        // and kept to half a rounding.
        let reach = grid.steps() as f64 * M::REACH;
        let fastest = (start.omega * step).abs() + reach * k;
        let farthest = start.theta.abs() + reach * fastest;
        let fits = grid.steps() > 0
            && moderate(k)
            && moderate(step)
            && (start.omega == 0.0 || moderate(start.omega.abs()))
            && start.theta.abs() < 1e6
            && farthest < 1e15;
        fits.then_some(Self { minus_k: -k, step })
    }

    /// Converts `z` from rad and rad/s.
    pub fn from_phase(&self, z: Phase) -> ReducedPhase<BRANCH> {
        let (n, rest) = reduce::<BRANCH>(z.theta);
        ReducedPhase { rest, turns: ROUNDER + n, velocity: (z.omega * self.step).into() }
    }

    /// Angle (rad) and angular velocity (rad/s) of the state `z`.
    #[inline]
    pub fn to_phase(&self, z: ReducedPhase<BRANCH>) -> Phase {
        let n = z.turns - ROUNDER;
        let theta = n * PI_PARTS[0] + (n * PI_PARTS[1] + (n * PI_PARTS[2] + z.rest));
        Phase { theta, omega: z.velocity.value() / self.step }
    }
}

impl<const BRANCH: bool> ReducedPhase<BRANCH> {
    /// Sine and cosine of the angle. An odd number of half turns changes the sign of both.
    #[inline]
    pub(crate) fn sine_and_cosine(self) -> (f64, f64) {
        let sign = self.turns.to_bits() << 63;
        let signed = |x: f64| f64::from_bits(x.to_bits() ^ sign);
        (signed(sine::sin(self.rest)), signed(sine::cos(self.rest)))
    }

    /// Moves the angle and reduces it again.
    #[inline]
    fn turn(self, by: Deferred) -> Self {
        let (n, rest) = reduce::<BRANCH>((self.rest + by.sum) + by.factor * by.series);
        Self { rest, turns: self.turns + n, ..self }
    }
}

impl<const BRANCH: bool> Add<ReducedRate> for ReducedPhase<BRANCH> {
    type Output = Self;

    #[inline]
    fn add(self, displacement: ReducedRate) -> Self {
        let velocity = self.velocity + displacement.velocity;
        Self { velocity, ..self.turn(displacement.angle) }
    }
}

impl<const BRANCH: bool> State for ReducedPhase<BRANCH> {
    type Displacement = ReducedRate;
}

impl<const BRANCH: bool> Components for ReducedPhase<BRANCH> {
    #[inline]
    fn for_each_component(
        self,
        other: Self,
        displacement: ReducedRate,
        mut each: impl FnMut(f64, f64, f64),
    ) {
        each(self.rest, other.rest, displacement.angle.value());
        each(self.velocity.value(), other.velocity.value(), displacement.velocity.value());
    }

    #[inline]
    fn map_components(self, mut each: impl FnMut(f64) -> f64) -> Self {
        Self { rest: each(self.rest), velocity: each(self.velocity.value()).into(), ..self }
    }
}

impl<const BRANCH: bool> Numbers for ReducedPhase<BRANCH> {
    #[inline]
    fn write(self, write: &mut impl FnMut(f64)) {
        write(self.rest);
        write(self.turns);
        self.velocity.write(write);
    }

    #[inline]
    fn read(next: &mut impl FnMut() -> f64) -> Self {
        Self { rest: next(), turns: next(), velocity: Deferred::read(next) }
    }
}

impl Numbers for ReducedRate {
    #[inline]
    fn write(self, write: &mut impl FnMut(f64)) {
        self.angle.write(write);
        self.velocity.write(write);
    }

    #[inline]
    fn read(next: &mut impl FnMut() -> f64) -> Self {
        Self { angle: Deferred::read(next), velocity: Deferred::read(next) }
    }
}

impl Add for ReducedRate {
    type Output = Self;

    #[inline]
    fn add(self, late: Self) -> Self {
        Self { angle: self.angle + late.angle, velocity: self.velocity + late.velocity }
    }
}

impl Mul<f64> for ReducedRate {
    type Output = Self;

    #[inline]
    fn mul(self, factor: f64) -> Self {
        Self { angle: self.angle * factor, velocity: self.velocity * factor }
    }
}

impl Vector for ReducedRate {}

impl<const BRANCH: bool> System for ScaledPendulum<BRANCH> {
    type State = ReducedPhase<BRANCH>;

    #[inline]
    fn rate(&self, t: f64, z: ReducedPhase<BRANCH>) -> RateOf<Self> {
        ReducedRate { angle: z.velocity, velocity: self.force(t, z) }
    }
}

// ANCHOR: separable
impl<const BRANCH: bool> Separable for ScaledPendulum<BRANCH> {
    type Force = Deferred;

    /// −K sin θ = ∓K (r + r³ P(r²)), where r is the remainder of θ.
    #[inline]
    fn force(&self, _t: f64, z: ReducedPhase<BRANCH>) -> Deferred {
        let sign = z.turns.to_bits() << 63;
        let sum = f64::from_bits(self.minus_k.to_bits() ^ sign) * z.rest;
        let square = z.rest * z.rest;
        Deferred { sum, factor: sum * square, series: series(square) }
    }

    #[inline]
    fn kick(&self, z: ReducedPhase<BRANCH>, force: Deferred, h: f64) -> ReducedPhase<BRANCH> {
        ReducedPhase { velocity: z.velocity + force * h, ..z }
    }

    #[inline]
    fn drift(&self, z: ReducedPhase<BRANCH>, h: f64) -> ReducedPhase<BRANCH> {
        z.turn(z.velocity * h)
    }
}
// ANCHOR_END: separable

impl<const BRANCH: bool> Analytic for ScaledPendulum<BRANCH> {
    #[inline]
    fn mean_rate<const P: usize>(&self, h: f64, z: ReducedPhase<BRANCH>) -> ReducedRate {
        let (angle, velocity) =
            growth::<P>(-self.minus_k, h, z.velocity.value(), z.sine_and_cosine());
        ReducedRate { angle: Deferred::from(angle), velocity: Deferred::from(velocity) }
    }
}

impl<const BRANCH: bool> MeanForce for ScaledPendulum<BRANCH> {
    #[inline]
    fn mean_force_rate(&self, middle: ReducedPhase<BRANCH>, h: f64) -> ReducedRate {
        let half_the_way = 0.5 * h * middle.velocity.value();
        let velocity = self.force(0.0, middle) * sinc(half_the_way, sin);
        ReducedRate { angle: middle.velocity, velocity }
    }
}

impl<const BRANCH: bool> NearlyLinear for ScaledPendulum<BRANCH> {
    #[inline]
    fn linear_frequency_squared(&self) -> f64 {
        -self.minus_k
    }

    #[inline]
    fn linear_force(&self, z: ReducedPhase<BRANCH>) -> Deferred {
        (self.minus_k * from_the_bottom(z.turns, z.rest)).into()
    }
}
