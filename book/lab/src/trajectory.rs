//! A trajectory in progress: the state, the carry of the method, and the counts.

use pendula::fast::ScaledPendulum;
use pendula::{Damped, Grid, Info, Method, Pendulum, Phase, methods};

use crate::shared::{Shared, SharedState};

/// A pendulum, its start, a method and a step.
#[derive(Clone, Copy, Debug)]
pub struct Setup {
    /// Index of the method in [`METHODS`](pendula::METHODS).
    pub method: usize,
    /// The pendulum.
    pub pendulum: Pendulum,
    /// Damping β (1/s); zero for none.
    pub damping: f64,
    /// The start.
    pub start: Phase,
    /// The step Δt (s).
    pub step: f64,
}

macro_rules! all {
    ($($module:ident::$method:ident,)+) => {
        /// The method, and what its last step carries to the next.
        enum Carry {
            $($method(<methods::$method as Method<Shared>>::Carry),)+
        }

        impl Carry {
            /// [`Method::start`] of the method at `index` in the library's list.
            fn start(index: usize, system: &Shared, h: f64, z: SharedState) -> Option<Self> {
                let mut number = 0..;
                $(if number.next() == Some(index) {
                    return Some(Self::$method(methods::$method.start(system, 0.0, h, z)));
                })+
                None
            }

            /// [`Method::step`].
            fn step(&mut self, system: &Shared, t: f64, h: f64, z: SharedState) -> SharedState {
                match self {
                    $(Self::$method(carry) => {
                        methods::$method.step(system, t, h, z, carry)
                    })+
                }
            }
        }

        /// Number of methods.
        pub const METHODS: usize = [$(stringify!($method)),+].len();

        /// Name and title of the method at `index` in the library's list. Read one by one, so that
        /// the rest of their `MethodInfo` is not compiled into the file.
        pub fn names(index: usize) -> Option<[&'static str; 2]> {
            let mut number = 0..;
            $(if number.next() == Some(index) {
                let info = methods::$method.info();
                return Some([info.name, info.title]);
            })+
            None
        }

        /// [`ScaledPendulum::new`] for the method at `index`, or one that reaches farther.
        fn scaled(
            index: usize,
            scene: &Setup,
            grid: &Grid,
            start: Phase,
        ) -> Option<ScaledPendulum> {
            let mut number = 0..;
            // A constant: the others are not compiled into the file.
            $(if number.next() == Some(index)
                && <methods::$method as Method<ScaledPendulum>>::GRADIENT > 0.0
            {
                return ScaledPendulum::new::<methods::$method>(&scene.pendulum, grid, start);
            })+
            ScaledPendulum::new::<Farthest>(&scene.pendulum, grid, start)
        }

        $(const _: () = assert!(
            <methods::$method as Method<ScaledPendulum>>::REACH <= FARTHEST,
            "`longest` has to ask for a method that reaches as far",
        );)+
    };
}
pendula::for_each_method!(all);

macro_rules! general {
    ($($module:ident::$method:ident,)+) => {
        /// Number of methods that suit every system; they are the first in the list.
        const GENERAL: usize = [$(stringify!($method)),+].len();
    };
}
pendula::for_each_general_method!(general);

/// No method has a larger [`REACH`](Method::REACH).
type Farthest = methods::Dop853;
const FARTHEST: f64 = <Farthest as Method<ScaledPendulum>>::REACH;

/// An hour in steps of a tenth of a millisecond: more than anybody waits for.
const MOST_STEPS: u64 = 36_000_000;

/// The trajectory of a [`Setup`].
pub struct Trajectory {
    system: Shared,
    /// In seconds, and in the system's unit of time.
    grid: Grid,
    inner: Grid,
    z: SharedState,
    carry: Carry,
    taken: u64,
    phase: Phase,
}

impl Trajectory {
    /// The trajectory at its start; `None` if the library refuses the scene, or if the method does
    /// not apply to a damped pendulum or to steps so long.
    pub fn new(scene: &Setup) -> Option<Self> {
        let start = scene.pendulum.start(scene.start.theta, scene.start.omega).ok()?;
        let ((system, z), grid, inner) = if scene.damping == 0.0 {
            let (scaled, grid) = longest(scene, start)?;
            (Shared::scaled(scaled, start), grid, grid.in_steps())
        } else if scene.method < GENERAL {
            let damped = Damped::new(scene.pendulum, scene.damping).ok()?;
            let grid = Grid::new(scene.step, MOST_STEPS).ok()?;
            (Shared::damped(damped, start), grid, grid)
        } else {
            return None;
        };
        let carry = Carry::start(scene.method, &system, inner.step(), z)?;
        Some(Self { system, grid, inner, z, carry, taken: 0, phase: start })
    }

    /// Takes a step, if one is left, and returns whether it did: one iteration of the loop in
    /// `pendula::integrate`.
    pub fn step(&mut self) -> bool {
        if self.taken == self.grid.steps() {
            return false;
        }
        let (t, h) = (self.inner.time(self.taken), self.inner.step());
        self.z = self.carry.step(&self.system, t, h, self.z);
        self.phase = self.system.phase(self.z);
        self.taken += 1;
        true
    }

    /// The state: at first the start as it was given.
    pub const fn phase(&self) -> Phase {
        self.phase
    }

    /// The number of steps taken.
    pub const fn taken(&self) -> u64 {
        self.taken
    }

    /// The total number of steps.
    pub const fn limit(&self) -> u64 {
        self.grid.steps()
    }

    /// The time (s).
    pub const fn time(&self) -> f64 {
        self.grid.time(self.taken)
    }

    /// Force evaluations so far, counted.
    pub fn evaluations(&self) -> u64 {
        self.system.evaluations()
    }
}

/// The longest grid, up to halving, for which [`ScaledPendulum::new`] accepts the method, and the
/// scaled pendulum; on shorter grids `pendula::integrate_fast` computes the same, bit for bit. None
/// for steps in which a processed method has no inverse change of variables.
fn longest(scene: &Setup, start: Phase) -> Option<(ScaledPendulum, Grid)> {
    let mut steps = MOST_STEPS;
    while steps > 0 {
        let grid = Grid::new(scene.step, steps).ok()?;
        if let Some(scaled) = scaled(scene.method, scene, &grid, start) {
            return Some((scaled, grid));
        }
        steps /= 2;
    }
    None
}
