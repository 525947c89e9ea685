//! Impostors of the trapezoidal rule, the discrete gradient and Deuflhard's method.

use std::f64::consts::TAU;

use pendula::arithmetic::sine::{cos, sin};
use pendula::methods::{Deuflhard, DiscreteGradient, ImplicitMidpoint, Iteration, Trapezoidal};
use pendula::systems::{MeanForce, NearlyLinear};
use pendula::{Info, Method, MethodInfo, Phase, RateOf, System};

use super::{Plain, impostor};

/// The implicit midpoint rule under the entry of `M`: of the same order, symmetric, and on the
/// linear oscillator the same map.
pub struct Midpoint<M>(pub M);

impl<M: Info> Info for Midpoint<M> {
    fn info(&self) -> MethodInfo {
        self.0.info()
    }
}

impl<M, S: Plain> Method<S> for Midpoint<M> {
    type Carry = ();

    fn start(&self, _system: &S, _t: f64, _h: f64, _z: Phase) {}

    fn step(&self, system: &S, t: f64, h: f64, z: Phase, carry: &mut ()) -> Phase {
        ImplicitMidpoint.step(system, t, h, z, carry)
    }
}

impostor! {
    /// The trapezoidal rule after a single sweep of its iteration: Heun's method.
    SweptOnce poses as Trapezoidal, |system, _, h, z| {
        let k1 = system.rate(0.0, z);
        let k2 = system.rate(0.0, z + k1 * h);
        z + (k1 + k2) * (0.5 * h)
    }
}

impostor! {
    /// The discrete gradient with the mean of the force over twice the way: the whole difference of
    /// the angles where half of it belongs.
    TwiceTheWay poses as DiscreteGradient needing MeanForce, |system, t, h, z| {
        let along = AlongTwice { system, h };
        let (first, iteration) = (along.rate(t, z), Iteration::TO_ROUNDING);
        ImplicitMidpoint::TABLEAU.attempt(&along, t, h, z, first, iteration).0
    }
}

/// A system with that mean for its force.
struct AlongTwice<'s, S> {
    system: &'s S,
    h: f64,
}

impl<S: Plain + MeanForce> System for AlongTwice<'_, S> {
    type State = S::State;

    fn rate(&self, _t: f64, middle: S::State) -> RateOf<S> {
        self.system.mean_force_rate(middle, 2.0 * self.h)
    }
}

/// The angle (rad) from the nearest bottom.
fn from_the_nearest(theta: f64) -> f64 {
    theta - TAU * (theta / TAU).round()
}

/// `z` after the linear pendulum has turned for the time `h` (s), where `rest` (rad) is its angle
/// from the bottom.
fn turned(system: &impl NearlyLinear<Time = f64>, h: f64, z: Phase, rest: f64) -> Phase {
    let frequency = system.linear_frequency_squared().sqrt();
    let (sin, cos) = (sin(frequency * h), cos(frequency * h));
    let moved = rest * cos + z.omega / frequency * sin - rest;
    Phase { theta: z.theta + moved, omega: z.omega * cos - rest * frequency * sin }
}

impostor! {
    /// Half a rotation, a kick, half a rotation: Deuflhard's method half a step on.
    RotationFirst poses as Deuflhard needing NearlyLinear<Force = f64, Time = f64>,
    |system, _, h, z| {
        let z = turned(system, 0.5 * h, z, from_the_nearest(z.theta));
        let z = system.kick(z, system.force(0.0, z) - system.linear_force(z), h);
        turned(system, 0.5 * h, z, from_the_nearest(z.theta))
    }
}

impostor! {
    /// Every angle is taken from the bottom at 0, however many turns away.
    OneBottom poses as Deuflhard needing NearlyLinear<Force = f64, Time = f64>,
    |system, _, h, z| {
        let square = system.linear_frequency_squared();
        let beyond = |z: Phase| system.force(0.0, z) + square * z.theta;
        let z = system.kick(z, beyond(z), 0.5 * h);
        let z = turned(system, h, z, z.theta);
        system.kick(z, beyond(z), 0.5 * h)
    }
}
