//! Impostors of Störmer–Verlet.

use pendula::methods::StormerVerlet;
use pendula::{Method, Phase, Separable};

use super::{Plain, impostor, poses_as};

impostor! {
    /// Position for velocity Verlet: half a drift, a kick, half a drift. It evaluates once a step,
    /// but not before the first.
    PositionForm poses as StormerVerlet, |system, _, h, z| {
        let z = system.drift(z, 0.5 * h);
        let z = system.kick(z, system.force(0.0, z), h);
        system.drift(z, 0.5 * h)
    }
}

impostor! {
    /// The force evaluated anew for each half kick, as the paper's algorithm has it: the same
    /// numbers for twice the work.
    EvaluatedTwice poses as StormerVerlet, |system, _, h, z| {
        let z = system.kick(z, system.force(0.0, z), 0.5 * h);
        let z = system.drift(z, h);
        system.kick(z, system.force(0.0, z), 0.5 * h)
    }
}

impostor! {
    /// Heun: of order 2 like Verlet, and not symplectic.
    Heun poses as StormerVerlet, |system, _, h, z| {
        let k1 = system.rate(0.0, z);
        let k2 = system.rate(0.0, z + k1 * h);
        z + (k1 + k2) * (0.5 * h)
    }
}

impostor! {
    /// Leapfrog whose velocities start at the first sample and not half a step before: symplectic
    /// Euler.
    Unstaggered poses as StormerVerlet, |system, _, h, z| {
        let z = system.kick(z, system.force(0.0, z), h);
        system.drift(z, h)
    }
}

/// Störmer–Verlet with any weights of its half kicks, and optionally with a stale force.
///
/// With both weights ½ and no stale force it is Störmer–Verlet.
pub struct Kicks {
    /// The first kick, in kicks.
    pub first: f64,
    /// The second kick, in kicks.
    pub second: f64,
    /// Whether the force of the second kick is that before the drift.
    pub stale_kick: bool,
    /// Whether the force carried to the next step is that before the drift.
    pub stale_memory: bool,
}

impl Kicks {
    /// Störmer–Verlet.
    pub const RIGHT: Self =
        Self { first: 0.5, second: 0.5, stale_kick: false, stale_memory: false };
}

poses_as!(Kicks, StormerVerlet);

impl<S: Plain + Separable<Force = f64>> Method<S> for Kicks {
    type Carry = f64;

    fn start(&self, system: &S, t: f64, _h: f64, z: Phase) -> f64 {
        system.force(t, z)
    }

    fn step(&self, system: &S, t: f64, h: f64, z: Phase, carry: &mut f64) -> Phase {
        let old = *carry;
        let z = system.drift(system.kick(z, old, self.first * h), h);
        let new = system.force(t + h, z);
        *carry = if self.stale_memory { old } else { new };
        system.kick(z, if self.stale_kick { old } else { new }, self.second * h)
    }
}
