//! Impostors of symplectic Euler.

use pendula::Phase;
use pendula::methods::symplectic_euler::SymplecticEuler;

use super::impostor;

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
    /// The angle moves with the mean of the old and the new velocity: more accurate, and not symplectic.
    MeanVelocity poses as SymplecticEuler, |system, h, z| {
        let kicked = system.kick(z, system.force(0.0, z), h);
        Phase { theta: z.theta + 0.5 * h * (z.omega + kicked.omega), ..kicked }
    }
}
