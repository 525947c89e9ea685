//! Impostors of RK4: its tableau with an entry changed.

use pendula::methods::Rk4;
use pendula::{Method, Phase};

use super::{Plain, poses_as};

/// Four stages, each built on the one before, the third on the first as well.
#[derive(Clone, Copy)]
pub struct Tableau {
    /// How much of the first slope leads to the second stage.
    pub a21: f64,
    /// Of the first to the third.
    pub a31: f64,
    /// Of the second to the third.
    pub a32: f64,
    /// Of the third to the fourth.
    pub a43: f64,
    /// Weights.
    pub b: [f64; 4],
    /// Times of the stages, in steps.
    pub c: [f64; 4],
}

impl Tableau {
    /// RK4.
    pub const RIGHT: Self = Self {
        a21: 0.5,
        a31: 0.0,
        a32: 0.5,
        a43: 1.0,
        b: [1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0],
        c: [0.0, 0.5, 0.5, 1.0],
    };

    /// RK4's stages with the weights `b`.
    pub const fn weighing(b: [f64; 4]) -> Self {
        Self { b, ..Self::RIGHT }
    }
}

poses_as!(Tableau, Rk4);

impl<S: Plain> Method<S> for Tableau {
    type Carry = ();

    fn start(&self, _system: &S, _t: f64, _h: f64, _z: Phase) {}

    fn step(&self, system: &S, t: f64, h: f64, z: Phase, _carry: &mut ()) -> Phase {
        let Self { a21, a31, a32, a43, b, c } = *self;
        let k1 = system.rate(t + c[0] * h, z);
        let k2 = system.rate(t + c[1] * h, z + k1 * (a21 * h));
        let k3 = system.rate(t + c[2] * h, z + (k1 * a31 + k2 * a32) * h);
        let k4 = system.rate(t + c[3] * h, z + k3 * (a43 * h));
        z + (k1 * b[0] + k2 * b[1] + k3 * b[2] + k4 * b[3]) * h
    }
}
