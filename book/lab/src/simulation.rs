//! A pendulum with its observed energy.

use pendula::{Motion, Phase};

use crate::trajectory::{Kind, Setup, Trajectory};

/// One pendulum, the extremes of its energy since the last [`look`](Simulation::look), and its
/// exact motion.
pub struct Simulation {
    scene: Setup,
    trajectory: Trajectory,
    /// The exact motion, in closed form, if there is one.
    motion: Option<Motion>,
    /// Energy above the bottom at the start (J).
    initial: f64,
    /// Energy above the bottom (J), the present one, and its extremes since the last `look`.
    energy: f64,
    lowest: f64,
    highest: f64,
    /// max |Hₙ − H₀| over all steps (J).
    largest: f64,
}

impl Simulation {
    /// The scene at its start; `None` if the library refuses it.
    pub fn new(scene: Setup) -> Option<Self> {
        let trajectory = Trajectory::new(&scene)?;
        let motion = match scene.kind {
            Kind::Damped(0.0) => Some(Motion::new(&scene.pendulum, scene.start).ok()?),
            _ => None,
        };
        let energy = trajectory.energy();
        Some(Self {
            scene,
            trajectory,
            motion,
            initial: energy,
            energy,
            lowest: energy,
            highest: energy,
            largest: 0.0,
        })
    }

    /// Takes up to `count` steps, observes the energy at each, and returns the number of steps
    /// taken.
    pub fn advance(&mut self, count: u32) -> u32 {
        for n in 0..count {
            if !self.trajectory.step() {
                return n;
            }
            self.energy = self.trajectory.energy();
            self.lowest = self.lowest.min(self.energy);
            self.highest = self.highest.max(self.energy);
            self.largest = self.largest.max((self.energy - self.initial).abs());
        }
        count
    }

    /// Resets the extremes of the energy to the present value.
    pub fn look(&mut self) {
        (self.lowest, self.highest) = (self.energy, self.energy);
    }

    /// The value of a quantity, by its number; NaN for an unknown number.
    pub fn read(&mut self, quantity: u32) -> f64 {
        let [Phase { theta, omega }, lower] = self.trajectory.bobs();
        match quantity {
            0 => theta,
            1 => omega,
            2 => self.trajectory.time(),
            3 => self.trajectory.taken() as f64,
            4 => self.trajectory.evaluations() as f64,
            5 => self.trajectory.energy_as_printed(),
            6 => self.energy - self.initial,
            7 => self.lowest - self.initial,
            8 => self.highest - self.initial,
            9 => self.largest,
            10 => self.trajectory.limit() as f64,
            11 => self.motion.and_then(|motion| motion.period()).unwrap_or(f64::NAN),
            12 => self.initial,
            13 => lower.theta,
            14 => lower.omega,
            _ => f64::NAN,
        }
    }

    /// The exact state at the time `t` (s); NaN if there is no closed form. At t = 0 it is the
    /// start, which the closed form rounds: nobody is wrong before the first step.
    pub fn exact(&self, t: f64) -> Phase {
        match t {
            0.0 if self.motion.is_some() => self.scene.start,
            _ => state(self.motion, t),
        }
    }

    /// The state at `t` (s) on the separatrix of this pendulum, which is at the bottom at t = 0.
    pub fn separatrix(&self, t: f64) -> Phase {
        state(Motion::on_separatrix(&self.scene.pendulum, 0.0).ok(), t)
    }
}

fn state(motion: Option<Motion>, t: f64) -> Phase {
    motion.map_or(Phase { theta: f64::NAN, omega: f64::NAN }, |motion| motion.at(t))
}
