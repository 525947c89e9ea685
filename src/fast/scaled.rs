//! The pendulum with its step as the unit of time: the same motion in less time.
//!
//! With u = hω (rad a step) and K = h² g/L the pendulum is θ̈ + K sin θ = 0 and every step has
//! length 1, so that no method multiplies by h; symplectic Euler, u ← u − K sin θ, θ ← θ + u, is
//! then exactly Chirikov's standard map. Three things make it fast, all in this file and none in
//! the methods: the unit of time, the angle stored as half turns and a remainder, so that a sine
//! needs no reduction, and [deferred sums](Deferred).

use core::f64::consts::TAU;
use core::ops::{Add, Mul};

use super::deferred::Deferred;
use crate::arithmetic::number::{Many, Number};
use crate::arithmetic::sine::half_turn::{
    PI_PARTS, cosine_of_rest, cosine_series, from_the_bottom, of_rest, series,
};
use crate::arithmetic::sine::{ROUNDER, sinc};
use crate::integrate::{Grid, Method};
use crate::systems::{
    Analytic, Components, ForceGradient, MeanForce, Measurable, NearlyLinear, Pendulum, Phase,
    Processor, RateOf, Separable, State, System, Vector, growth, terms,
};

/// The pendulum with time in steps; or, where a [`Number`] has lanes, a pendulum in each.
#[derive(Clone, Copy, Debug)]
pub struct ScaledPendulum<N = f64> {
    /// −K = −h² g/L.
    pub(crate) minus_k: N,
    /// The step h (s).
    pub(crate) step: f64,
}

/// The state: the angle as a remainder in [−π/2, π/2] and a number of half turns, and the velocity
/// in rad a step.
#[derive(Clone, Copy, Debug)]
pub struct ReducedPhase<N = f64> {
    /// The remainder of the angle (rad).
    pub rest: N,
    /// 1.5 · 2⁵² + n for n half turns: the lowest bit is that of n, and says whether the sine
    /// changes sign.
    pub turns: N,
    /// The velocity (rad a step).
    pub velocity: Deferred<N>,
}

/// A displacement of the state, or its rate of change.
#[derive(Clone, Copy, Debug)]
pub struct ReducedRate<N = f64> {
    /// That of the angle (rad).
    pub angle: Deferred<N>,
    /// That of the velocity (rad a step).
    pub velocity: Deferred<N>,
}

impl ScaledPendulum {
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
        // The rounder counts 2⁵¹ half turns, 7e15 rad: a seventieth of that leaves room for a reach
        // of 8 in place of 1. The angle at the start is reduced exactly below 2²⁰, and kept to half
        // a rounding.
        let reach = grid.steps() as f64 * M::REACH;
        let kick = k * (1.0 + M::GRADIENT * k);
        let fastest = (start.omega * step).abs() + reach * kick;
        let farthest = start.theta.abs() + reach * fastest;
        // In longer steps, or by rotations of more than a turn in each, the change of variables of
        // a processed method is not near the identity, and its displacements have no bound.
        let turn = (start.omega * step).abs();
        let has_inverse = M::GRADIENT == 0.0 || (M::GRADIENT * k <= 1.0 && turn <= TAU);
        let fits = grid.steps() > 0
            && moderate(k)
            && has_inverse
            && moderate(step)
            && (start.omega == 0.0 || moderate(start.omega.abs()))
            && start.theta.abs() < 1e6
            && farthest < 1e14;
        fits.then_some(Self { minus_k: -k, step })
    }

    /// Converts `z` from rad and rad/s.
    pub fn from_phase(&self, z: Phase) -> ReducedPhase {
        let (n, rest) = z.theta.half_turns();
        ReducedPhase { rest, turns: ROUNDER + n, velocity: (z.omega * self.step).into() }
    }

    /// Angle (rad) and angular velocity (rad/s) of the state `z`.
    #[inline]
    pub fn to_phase(&self, z: ReducedPhase) -> Phase {
        let (theta, omega) = self.angle_and_velocity(z);
        Phase { theta, omega }
    }
}

impl<N: Number> ScaledPendulum<N> {
    /// The pendulum with this −K = −h² g/L and the step h (s).
    #[inline(always)]
    pub fn from_parameter(minus_k: N, step: f64) -> Self {
        Self { minus_k, step }
    }

    /// −K = −h² g/L.
    #[inline(always)]
    pub fn minus_k(&self) -> N {
        self.minus_k
    }

    /// Angle (rad) and angular velocity (rad/s) of the state `z`.
    #[inline(always)]
    pub(crate) fn angle_and_velocity(&self, z: ReducedPhase<N>) -> (N, N) {
        (z.angle(), z.velocity() / self.step)
    }
}

impl<N: Number> ReducedPhase<N> {
    /// The angle (rad).
    #[inline(always)]
    pub fn angle(self) -> N {
        let n = self.turns - ROUNDER;
        n * PI_PARTS[0] + (n * PI_PARTS[1] + (n * PI_PARTS[2] + self.rest))
    }

    /// The angular velocity (rad a step).
    #[inline(always)]
    pub fn velocity(self) -> N {
        self.velocity.value()
    }

    /// Sine and cosine of the angle. An odd number of half turns changes the sign of both.
    #[inline(always)]
    pub(crate) fn sine_and_cosine(self) -> (N, N) {
        let (sine, cosine) = self.rest.sine_and_cosine();
        (sine.signed_by(self.turns), cosine.signed_by(self.turns))
    }

    /// Moves the angle and reduces it again.
    #[inline(always)]
    fn turn(self, by: Deferred<N>) -> Self {
        let (n, rest) = ((self.rest + by.sum) + by.factor * by.series).half_turns();
        Self { rest, turns: self.turns + n, ..self }
    }
}

impl<N: Number> Add<ReducedRate<N>> for ReducedPhase<N> {
    type Output = Self;

    #[inline(always)]
    fn add(self, displacement: ReducedRate<N>) -> Self {
        let velocity = self.velocity + displacement.velocity;
        Self { velocity, ..self.turn(displacement.angle) }
    }
}

impl<N: Number> State for ReducedPhase<N> {
    type Displacement = ReducedRate<N>;
}

impl Components for ReducedPhase {
    #[inline(always)]
    fn for_each_component(
        self,
        other: Self,
        displacement: ReducedRate,
        mut each: impl FnMut(f64, f64, f64),
    ) {
        each(self.rest, other.rest, displacement.angle.value());
        each(self.velocity.value(), other.velocity.value(), displacement.velocity.value());
    }

    #[inline(always)]
    fn map_components(self, mut each: impl FnMut(f64) -> f64) -> Self {
        Self { rest: each(self.rest), velocity: each(self.velocity.value()).into(), ..self }
    }
}

impl<N: Many> Measurable for ReducedPhase<N> {
    type Number = N;

    #[inline(always)]
    fn size(self, _displacement: ReducedRate<N>) -> N {
        self.rest.abs() + self.velocity.value().abs()
    }

    #[inline(always)]
    fn size_of(self, displacement: ReducedRate<N>) -> N {
        displacement.angle.value().abs() + displacement.velocity.value().abs()
    }

    #[inline(always)]
    fn times(displacement: ReducedRate<N>, factor: N) -> ReducedRate<N> {
        let ReducedRate { angle, velocity } = displacement;
        ReducedRate { angle: angle.scaled(factor), velocity: velocity.scaled(factor) }
    }

    #[inline(always)]
    fn select(mask: N::Mask, yes: ReducedRate<N>, no: ReducedRate<N>) -> ReducedRate<N> {
        ReducedRate {
            angle: Deferred::select(mask, yes.angle, no.angle),
            velocity: Deferred::select(mask, yes.velocity, no.velocity),
        }
    }

    #[inline(always)]
    fn unless(mask: N::Mask, old: ReducedRate<N>, new: ReducedRate<N>) -> ReducedRate<N> {
        Self::select(mask, old, new)
    }

    fn components(self, _displacement: ReducedRate<N>) -> usize {
        2
    }

    fn with_scaled(self, component: usize, factor: f64) -> Self {
        let velocity = self.velocity.value();
        if component == 0 {
            Self { rest: self.rest * factor, velocity: velocity.into(), ..self }
        } else {
            Self { velocity: (velocity * factor).into(), ..self }
        }
    }
}

impl<N: Number> Add for ReducedRate<N> {
    type Output = Self;

    #[inline(always)]
    fn add(self, late: Self) -> Self {
        Self { angle: self.angle + late.angle, velocity: self.velocity + late.velocity }
    }
}

impl<N: Number> Mul<f64> for ReducedRate<N> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        Self { angle: self.angle * factor, velocity: self.velocity * factor }
    }
}

impl<N: Number> Vector for ReducedRate<N> {}

impl<N: Number> System for ScaledPendulum<N> {
    type State = ReducedPhase<N>;

    #[inline(always)]
    fn rate(&self, t: f64, z: ReducedPhase<N>) -> RateOf<Self> {
        ReducedRate { angle: z.velocity, velocity: self.force(t, z) }
    }
}

impl<N: Number> Separable for ScaledPendulum<N> {
    type Force = Deferred<N>;

    /// −K sin θ = ∓K (r + r³ P(r²)), where r is the remainder of θ.
    #[inline(always)]
    fn force(&self, _t: f64, z: ReducedPhase<N>) -> Deferred<N> {
        let sum = self.minus_k.signed_by(z.turns) * z.rest;
        let square = z.rest * z.rest;
        Deferred { sum, factor: sum * square, series: series(square) }
    }

    #[inline(always)]
    fn kick(&self, z: ReducedPhase<N>, force: Deferred<N>, h: f64) -> ReducedPhase<N> {
        ReducedPhase { velocity: z.velocity + force * h, ..z }
    }

    #[inline(always)]
    fn drift(&self, z: ReducedPhase<N>, h: f64) -> ReducedPhase<N> {
        z.turn(z.velocity * h)
    }
}

impl<N: Number> Analytic for ScaledPendulum<N> {
    #[inline(always)]
    fn terms<const P: usize>(&self, h: f64, z: ReducedPhase<N>) -> [ReducedRate<N>; P] {
        terms(-self.minus_k, h, z.velocity.value(), z.sine_and_cosine())
            .map(|[angle, velocity]| ReducedRate { angle: angle.into(), velocity: velocity.into() })
    }

    #[inline(always)]
    fn mean_rate<const P: usize>(&self, h: f64, z: ReducedPhase<N>) -> ReducedRate<N> {
        let (angle, velocity) =
            growth::<P, N>(-self.minus_k, h, z.velocity.value(), z.sine_and_cosine());
        ReducedRate { angle: Deferred::from(angle), velocity: Deferred::from(velocity) }
    }
}

impl<N: Number> MeanForce for ScaledPendulum<N>
where
    ReducedPhase<N>: Measurable<Number = N, Displacement = ReducedRate<N>>,
{
    #[inline(always)]
    fn mean_force_rate(&self, middle: ReducedPhase<N>, h: N) -> ReducedRate<N> {
        let half_the_way = middle.velocity.value() * (h * 0.5);
        let velocity = self.force(0.0, middle).scaled(sinc(half_the_way));
        ReducedRate { angle: middle.velocity, velocity }
    }
}

impl<N: Number> NearlyLinear for ScaledPendulum<N> {
    type Time = N;

    #[inline(always)]
    fn linear_frequency_squared(&self) -> N {
        -self.minus_k
    }

    #[inline(always)]
    fn linear_force(&self, z: ReducedPhase<N>) -> Deferred<N> {
        (self.minus_k * from_the_bottom(z.turns, z.rest)).into()
    }

    #[inline(always)]
    fn kick_for(&self, z: ReducedPhase<N>, force: Deferred<N>, time: N) -> ReducedPhase<N> {
        ReducedPhase { velocity: z.velocity + force.scaled(time), ..z }
    }

    #[inline(always)]
    fn drift_for(&self, z: ReducedPhase<N>, time: N) -> ReducedPhase<N> {
        z.turn(z.velocity.scaled(time))
    }
}

impl<N: Number> ScaledPendulum<N> {
    /// The derivatives of V = −K cos θ.
    #[inline(always)]
    fn derivatives(&self, z: ReducedPhase<N>) -> [N; 4] {
        let minus_k = self.minus_k.signed_by(z.turns);
        let (v1, v2) = (-minus_k * of_rest(z.rest), -minus_k * cosine_of_rest(z.rest));
        [v1, v2, -v1, -v2]
    }
}

impl<N: Number> ForceGradient for ScaledPendulum<N> {
    /// The force times 1 ∓ cK cos r, as a product that is deferred: sine and cosine are ready at
    /// the same time, and all that does not wait for them comes before.
    #[inline(always)]
    fn force_with_gradient(&self, t: f64, z: ReducedPhase<N>, c: f64) -> Deferred<N> {
        let minus_ck = self.minus_k.signed_by(z.turns) * c;
        let square = z.rest * z.rest;
        let early = minus_ck * (-square * 0.5 + 1.0) + 1.0;
        let late = (minus_ck * (square * square)) * cosine_series(square);
        Deferred { sum: square.splat(-0.0), factor: self.force(t, z).value(), series: early + late }
    }

    #[inline(always)]
    fn processing(&self, z: ReducedPhase<N>, by: &Processor) -> ReducedRate<N> {
        let (angle, velocity) = by.displacement(self.derivatives(z), z.velocity.value());
        ReducedRate { angle: angle.into(), velocity: velocity.into() }
    }

    #[inline(always)]
    fn unprocessing(&self, z: ReducedPhase<N>, by: &Processor) -> ReducedRate<N> {
        let (angle, velocity) = by.inverse(
            // A closure that is called twice is inlined, and has vector instructions, only so.
            #[inline(always)]
            |by| self.derivatives(z.turn(by.into())),
            z.velocity.value(),
        );
        ReducedRate { angle: angle.into(), velocity: velocity.into() }
    }
}
