//! Impostors of symplectic Euler, and one of forward Euler.

use pendula::methods::{ForwardEuler, SymplecticEuler};
use pendula::{Info, Method, MethodInfo, Phase};

use super::{Plain, impostor, runs_in_seconds};

impostor! {
    /// Forward Euler: kick and drift from the same old state.
    Forward poses as SymplecticEuler, |system, h, z| z + system.rate(0.0, z) * h
}

impostor! {
    /// Drift, then kick: the other symplectic Euler.
    DriftKick poses as SymplecticEuler, |system, h, z| {
        let z = system.drift(z, h);
        system.kick(z, system.force(0.0, z), h)
    }
}

impostor! {
    /// The angle moves with the mean of the old and the new velocity: more accurate, and not
    /// symplectic.
    MeanVelocity poses as SymplecticEuler, |system, h, z| {
        let kicked = system.kick(z, system.force(0.0, z), h);
        Phase { theta: z.theta + 0.5 * h * (z.omega + kicked.omega), ..kicked }
    }
}

/// Forward Euler that evaluates the rate of the old state at the new time.
pub struct Late;

impl Info for Late {
    fn info(&self) -> MethodInfo {
        ForwardEuler.info()
    }
}

impl<S: Plain> Method<S> for Late {
    type Carry = ();

    fn start(&self, _system: &S, _t: f64, _h: f64, _z: Phase) {}

    fn step(&self, system: &S, t: f64, h: f64, z: Phase, _carry: &mut ()) -> Phase {
        z + system.rate(t + h, z) * h
    }
}

runs_in_seconds!(Late);
