//! Right methods spoilt from outside: in their step, in the loop, or by a wrong pendulum.

use std::f64::consts::{PI, TAU};

use pendula::integrate::Run;
use pendula::methods::StormerVerlet;
use pendula::{
    AnyMethod, Counting, Grid, Info, Method, MethodInfo, Pendulum, Phase, Separable, System,
};

use super::poses_as;

macro_rules! spoilt_step {
    ($(#[$doc:meta])* $name:ident, |$h:ident| $step:expr, |$z:ident| $after:expr) => {
        $(#[$doc])*
        pub struct $name<M>(pub M);

        impl<M: Info> Info for $name<M> {
            fn info(&self) -> MethodInfo {
                self.0.info()
            }
        }

        impl<S: super::Plain, M: Method<S>> Method<S> for $name<M> {
            type Carry = M::Carry;

            fn start(&self, system: &S, t: f64, $h: f64, z: Phase) -> M::Carry {
                self.0.start(system, t, $step, z)
            }

            fn step(&self, system: &S, t: f64, $h: f64, z: Phase, carry: &mut M::Carry) -> Phase {
                let $z = self.0.step(system, t, $step, z, carry);
                let z = $after;
                // The carry belongs to the spoilt state. Only the evaluations of the right method
                // are counted.
                *carry = system.uncounted(|system| self.0.start(system, t + $h, $step, z));
                z
            }
        }
    };
}

spoilt_step! {
    /// Half the step is passed on, as when h/2 is prepared for the kicks and then used for
    /// everything else as well.
    HalfTheStep, |h| 0.5 * h, |z| z
}

spoilt_step! {
    /// A billionth of the velocity is lost in each step.
    ABillionthLost, |h| h, |z| Phase { omega: z.omega * (1.0 - 1e-9), ..z }
}

spoilt_step! {
    /// A trillionth of the velocity is lost in each step.
    ATrillionthLost, |h| h, |z| Phase { omega: z.omega * (1.0 - 1e-12), ..z }
}

spoilt_step! {
    /// A thousandth of the velocity is lost in each step, as by a drag that does not know the step.
    AThousandthLost, |h| h, |z| Phase { omega: z.omega * 0.999, ..z }
}

spoilt_step! {
    /// A step of 0.01 s is written into the program, whatever is asked for.
    ItsOwnStep, |h| 0.01 * h.signum(), |z| z
}

spoilt_step! {
    /// The state is kept in single precision.
    SinglePrecision, |h| h, |z| {
        Phase { theta: f64::from(z.theta as f32), omega: f64::from(z.omega as f32) }
    }
}

spoilt_step! {
    /// The angle is wrapped to −π … π.
    AngleWrapped, |h| h, |z| Phase { theta: (z.theta + PI).rem_euclid(TAU) - PI, ..z }
}

/// A method whose loop is spoilt: it runs along another grid than the one that is asked for.
macro_rules! spoilt_loop {
    ($(#[$doc:meta])* $name:ident, |$grid:ident| $along:expr) => {
        $(#[$doc])*
        pub struct $name<M>(pub M);

        impl<M: Info> Info for $name<M> {
            fn info(&self) -> MethodInfo {
                self.0.info()
            }
        }

        impl<M: AnyMethod> AnyMethod for $name<M> {
            fn begin(&self, pendulum: &Pendulum, start: Phase, $grid: &Grid) -> Run<'_, Phase> {
                let along = $along;
                self.0.begin(pendulum, start, &along.expect("a grid"))
            }

            fn count_evaluations(&self, pendulum: &Pendulum, start: Phase, grid: &Grid) -> u64 {
                self.0.count_evaluations(pendulum, start, grid)
            }
        }
    };
}

spoilt_loop! {
    /// One step is left out: N points are taken for N steps.
    OneStepShort, |grid| Grid::new(grid.step(), grid.steps().saturating_sub(1))
}

spoilt_loop! {
    /// Time is added up, `while t < end { t += h }`: after ten steps of 0.1 it is
    /// 0.9999999999999999, and one more is taken.
    TimeAccumulated, |grid| {
        let (end, mut t, mut steps) = (grid.time(grid.steps()), 0.0, 0);
        while t < end {
            t += grid.step();
            steps += 1;
        }
        Grid::new(grid.step(), steps)
    }
}

/// Störmer–Verlet under this angular acceleration (rad/s²) of a pendulum at θ (rad).
pub struct Accelerated(pub fn(&Pendulum, f64) -> f64);

/// The pendulum with another force.
struct Twisted<'s> {
    pendulum: &'s Counting<Pendulum>,
    acceleration: fn(&Pendulum, f64) -> f64,
}

impl System for Twisted<'_> {
    type State = Phase;

    fn rate(&self, t: f64, z: Phase) -> Phase {
        Phase { theta: z.omega, omega: self.force(t, z) }
    }
}

impl Separable for Twisted<'_> {
    type Force = f64;

    fn force(&self, t: f64, z: Phase) -> f64 {
        // It counts.
        self.pendulum.force(t, z);
        (self.acceleration)(self.pendulum.system(), z.theta)
    }

    fn kick(&self, z: Phase, alpha: f64, h: f64) -> Phase {
        self.pendulum.kick(z, alpha, h)
    }

    fn drift(&self, z: Phase, h: f64) -> Phase {
        self.pendulum.drift(z, h)
    }
}

poses_as!(Accelerated, StormerVerlet);

impl Method<Counting<Pendulum>> for Accelerated {
    type Carry = Phase;

    fn start(&self, pendulum: &Counting<Pendulum>, t: f64, h: f64, z: Phase) -> Phase {
        StormerVerlet.start(&Twisted { pendulum, acceleration: self.0 }, t, h, z)
    }

    fn step(
        &self,
        pendulum: &Counting<Pendulum>,
        t: f64,
        h: f64,
        z: Phase,
        ahead: &mut Phase,
    ) -> Phase {
        StormerVerlet.step(&Twisted { pendulum, acceleration: self.0 }, t, h, z, ahead)
    }
}
