//! The point in phase space.

use core::ops::{Add, Mul};

/// A rate of change, or a small displacement: it can be added and scaled.
///
/// That is all a Runge–Kutta method asks of it. Components keep their names in the type that implements this trait.
pub trait Vector: Copy + Add<Output = Self> + Mul<f64, Output = Self> {}

/// A state: a displacement can be added to it.
///
/// Where states themselves form a vector space they are their own displacements. An angle kept as turns and a rest is
/// a point and no vector: half of it means nothing.
pub trait Point: Copy + Add<Self::Displacement, Output = Self> {
    /// What is between two states.
    type Displacement: Vector;
}

impl<V: Vector> Point for V {
    type Displacement = V;
}

/// A state whose components are numbers, so that an error in each can be held against what is allowed there.
pub trait Components: Point {
    /// Hands to `each`, one component after the other, what it is in this state, in the state `other`, and in the
    /// `displacement`.
    fn compare(
        self,
        other: Self,
        displacement: Self::Displacement,
        each: impl FnMut(f64, f64, f64),
    );
}

/// A point (θ, ω) in the phase space of the pendulum, or a rate of change of one.
///
/// As a state, `theta` is in rad and `omega` in rad/s; as a rate, both are per second.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Phase {
    /// Angle from the downward vertical, unwrapped: it counts turns.
    pub theta: f64,
    /// Angular velocity, dθ/dt.
    pub omega: f64,
}

impl Phase {
    /// The pendulum held still at the angle `theta` (rad).
    pub const fn at_rest(theta: f64) -> Self {
        Self { theta, omega: 0.0 }
    }
}

impl Add for Phase {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        Self { theta: self.theta + other.theta, omega: self.omega + other.omega }
    }
}

impl Mul<f64> for Phase {
    type Output = Self;

    #[inline]
    fn mul(self, factor: f64) -> Self {
        Self { theta: self.theta * factor, omega: self.omega * factor }
    }
}

impl Vector for Phase {}

impl Components for Phase {
    #[inline]
    fn compare(self, other: Self, displacement: Self, mut each: impl FnMut(f64, f64, f64)) {
        each(self.theta, other.theta, displacement.theta);
        each(self.omega, other.omega, displacement.omega);
    }
}
