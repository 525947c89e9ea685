//! Right methods spoilt from outside: in their step, in the loop, or by a wrong pendulum.

use std::f64::consts::{PI, TAU};

use pendula::methods::StormerVerlet;
use pendula::{
    AnyMethod, Counting, Grid, Info, Method, MethodInfo, Observer, Pendulum, Phase, Separable,
    System, integrate,
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
                // The carry belongs to the spoilt state.
                *carry = self.0.start(system, t + $h, $step, z);
                z
            }
        }

        super::runs_in_seconds!($name<M>, M.0);
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
    /// The state is kept in single precision.
    SinglePrecision, |h| h, |z| {
        Phase { theta: f64::from(z.theta as f32), omega: f64::from(z.omega as f32) }
    }
}

spoilt_step! {
    /// The angle is wrapped to −π … π.
    AngleWrapped, |h| h, |z| Phase { theta: (z.theta + PI).rem_euclid(TAU) - PI, ..z }
}

/// Implements a method whose loop is spoilt: what it does with the run of a right one, `$method`.
macro_rules! spoilt_loop {
    (
        $(#[$doc:meta])*
        $name:ident, |$method:ident, $pendulum:ident, $start:ident, $grid:ident, $observer:ident|
        $run:block
    ) => {
        $(#[$doc])*
        pub struct $name<M>(pub M);

        impl<M: AnyMethod> Info for $name<M> {
            fn info(&self) -> MethodInfo {
                self.0.info()
            }
        }

        impl<M: AnyMethod> AnyMethod for $name<M> {
            fn run(
                &self,
                $pendulum: &Pendulum,
                $start: Phase,
                $grid: &Grid,
                $observer: &mut dyn Observer<Phase>,
            ) -> Phase {
                let $method = &self.0;
                $run
            }

            fn count_evaluations(&self, pendulum: &Pendulum, start: Phase, grid: &Grid) -> u64 {
                self.0.count_evaluations(pendulum, start, grid)
            }
        }
    };
}

spoilt_loop! {
    /// One step is left out: N points are taken for N steps.
    OneStepShort, |method, pendulum, start, grid, observer| {
        let short = Grid::new(grid.step(), grid.steps().saturating_sub(1)).expect("a shorter grid");
        method.run(pendulum, start, &short, observer)
    }
}

spoilt_loop! {
    /// Time is added up, `while t < end { t += h }`: after ten steps of 0.1 it is
    /// 0.9999999999999999, and one more is taken.
    TimeAccumulated, |method, pendulum, start, grid, observer| {
        let (end, mut times) = (grid.time(grid.steps()), vec![0.0]);
        while times[times.len() - 1] < end {
            times.push(times[times.len() - 1] + grid.step());
        }
        let steps = times.len() as u64 - 1;
        let longer = Grid::new(grid.step(), steps).expect("a grid");
        let mut watch = |n: u64, _, z: Phase| observer.observe(n, times[n as usize], z);
        method.run(pendulum, start, &longer, &mut watch)
    }
}

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

poses_as!(Accelerated, StormerVerlet);

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
