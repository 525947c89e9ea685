//! Deuflhard's method: the linear pendulum rotates, the rest of the force kicks.

use crate::arithmetic::number::Number;
use crate::arithmetic::sine::{cos, sin};
use crate::integrate::Method;
use crate::methods::{Info, MethodInfo};
use crate::systems::NearlyLinear;

/// Deuflhard's method: half a kick by what the force has beyond the linear one, for the pendulum
/// (g/L) (θ − sin θ); the exact motion of the linear pendulum, a rotation by x = ω₀h; half a kick.
///
/// The rotation is itself a kick, a drift and a kick, of the lengths tan(x/2)/ω₀, sin(x)/ω₀ and
/// tan(x/2)/ω₀, so that all of it is Störmer–Verlet with other lengths. No difference of nearly
/// equal numbers is formed, and no rounding makes the rotation grow or shrink, as it does with a
/// matrix of a rounded sine and cosine. Each angle is taken from its nearest bottom.
///
/// Order 2, symplectic, symmetric, exact for the linear oscillator; one force evaluation a step and
/// one before the first. The error of a step falls with the square of the amplitude, that of the
/// period with its fourth power. Over the top the nearest bottom is another one, and the linear
/// force jumps: each time the energy makes a small step at random, of order x³. At the top itself
/// the force does not vanish: the pendulum falls from there as from πx²/12 beside it. A step must
/// be shorter than half a turn of the linear pendulum, x < π, where the tangent has its pole; from
/// x = 3 on, nothing is rotated any more. Also called the impulse method. P. Deuflhard, *Z. Angew.
/// Math. Phys.* 30 (1979) 177; Hairer, Lubich, Wanner, *Geometric Numerical Integration*, Sects.
/// VIII.4.1 and XIII.1.
#[derive(Clone, Copy, Debug, Default)]
pub struct Deuflhard;

impl Info for Deuflhard {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Deuflhard",
            aliases: &["linear rotation and kicks", "impulse method"],
            symplectic: true,
            symmetric: true,
            force_evaluations: 1,
            start_evaluations: 1,
            reference: "P. Deuflhard, Z. Angew. Math. Phys. 30 (1979) 177; Hairer, Lubich, Wanner \
                        (2006), Sect. XIII.1",
            ..MethodInfo::new("deuflhard", 2)
        }
    }
}

/// What a step of [`Deuflhard`] hands on.
#[derive(Clone, Copy, Debug)]
pub struct Rotating<Z, T = f64> {
    /// The state half a kick ahead.
    pub ahead: Z,
    /// The length tan(ω₀h/2)/ω₀ (s) of the kick with which a rotation begins and ends.
    pub kick: T,
}

/// The longest x = ω₀h of a step that rotates.
const LONGEST: f64 = 3.0;

// ANCHOR: step
impl<S: NearlyLinear> Method<S> for Deuflhard {
    type Carry = Rotating<S::State, S::Time>;
    /// The kick, and at x = 3 another 8.4 steps of the linear force, up to π times as large.
    const REACH: f64 = 28.0;

    fn start(&self, system: &S, t: f64, h: f64, z: S::State) -> Rotating<S::State, S::Time> {
        let kick = system.linear_frequency_squared().map(|frequency_squared| {
            let frequency = libm::sqrt(frequency_squared);
            let half_turned = 0.5 * frequency * h;
            // Near the pole a kick would be longer than any number of steps.
            let rotates = half_turned < 0.5 * LONGEST;
            if rotates { sin(half_turned) / cos(half_turned) / frequency } else { 0.5 * h }
        });
        let ahead = system.kick(z, system.force(t, z), 0.5 * h);
        Rotating { ahead: system.kick_for(ahead, system.linear_force(z), kick - 0.5 * h), kick }
    }

    #[inline(always)]
    fn step(
        &self,
        system: &S,
        t: f64,
        h: f64,
        _z: S::State,
        carry: &mut Rotating<S::State, S::Time>,
    ) -> S::State {
        let Rotating { ahead, kick } = *carry;
        // sin x from the tangent of x/2.
        let drift = kick * 2.0 / (system.linear_frequency_squared() * kick * kick + 1.0);
        let z = system.drift_for(ahead, drift);
        let (force, linear) = (system.force(t + h, z), system.linear_force(z));
        // The half kick that ends this step and the one that begins the next are merged into one.
        carry.ahead = system.kick_for(system.kick(z, force, h), linear, kick * 2.0 - h);
        system.kick_for(system.kick(z, force, 0.5 * h), linear, kick - 0.5 * h)
    }
}
// ANCHOR_END: step
