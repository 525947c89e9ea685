//! Impostors of symplectic Euler, and one of forward Euler.

use pendula::Phase;
use pendula::methods::{ForwardEuler, SymplecticEuler};

use super::impostor;

impostor! {
    /// Forward Euler: kick and drift from the same old state.
    Forward poses as SymplecticEuler, |system, _, h, z| z + system.rate(0.0, z) * h
}

impostor! {
    /// Drift, then kick: the other symplectic Euler.
    DriftKick poses as SymplecticEuler, |system, _, h, z| {
        let z = system.drift(z, h);
        system.kick(z, system.force(0.0, z), h)
    }
}

impostor! {
    /// The angle moves with the mean of the old and the new velocity: more accurate, and not
    /// symplectic.
    MeanVelocity poses as SymplecticEuler, |system, _, h, z| {
        let kicked = system.kick(z, system.force(0.0, z), h);
        Phase { theta: z.theta + 0.5 * h * (z.omega + kicked.omega), ..kicked }
    }
}

impostor! {
    /// Forward Euler that evaluates the rate of the old state at the new time.
    Late poses as ForwardEuler, |system, t, h, z| z + system.rate(t + h, z) * h
}
