//! Right methods, wrong pendulums.

use pendula::methods::StormerVerlet;
use pendula::{
    AnyMethod, Counting, Grid, Info, MethodInfo, Observer, Pendulum, Phase, Separable, System,
    integrate,
};

/// Störmer–Verlet under this angular acceleration (rad/s²) of a pendulum at θ (rad).
pub struct Accelerated(pub fn(&Pendulum, f64) -> f64);

/// The pendulum with another force.
#[derive(Clone, Copy)]
struct Twisted {
    pendulum: Pendulum,
    acceleration: fn(&Pendulum, f64) -> f64,
}

impl System for Twisted {
    type State = Phase;

    fn rate(&self, t: f64, z: Phase) -> Phase {
        Phase { theta: z.omega, omega: self.force(t, z) }
    }
}

impl Separable for Twisted {
    type Force = f64;

    fn force(&self, _t: f64, z: Phase) -> f64 {
        (self.acceleration)(&self.pendulum, z.theta)
    }

    fn kick(&self, z: Phase, alpha: f64, h: f64) -> Phase {
        self.pendulum.kick(z, alpha, h)
    }

    fn drift(&self, z: Phase, h: f64) -> Phase {
        self.pendulum.drift(z, h)
    }
}

impl Accelerated {
    fn twist(&self, pendulum: &Pendulum) -> Twisted {
        Twisted { pendulum: *pendulum, acceleration: self.0 }
    }
}

impl Info for Accelerated {
    fn info(&self) -> MethodInfo {
        StormerVerlet.info()
    }
}

impl AnyMethod for Accelerated {
    fn run(
        &self,
        pendulum: &Pendulum,
        start: Phase,
        grid: &Grid,
        observer: &mut dyn Observer<Phase>,
    ) -> Phase {
        integrate(&self.twist(pendulum), &StormerVerlet, start, grid, observer)
    }

    fn count_evaluations(&self, pendulum: &Pendulum, start: Phase, grid: &Grid) -> u64 {
        let counting = Counting::new(self.twist(pendulum));
        integrate(&counting, &StormerVerlet, start, grid, &mut ());
        counting.evaluations()
    }
}
