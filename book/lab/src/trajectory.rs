//! A trajectory in progress: the state, the carry of the method, and the counts.

use pendula::internals::ScaledPendulum;
use pendula::systems::{Driven, Joint, Shaken};
use pendula::{Damped, DoublePendulum, Grid, Hamiltonian, Info, Method, Pendulum, Phase, methods};

use crate::shared::{Forced, NONE, One, Shared, SharedState};

/// What moves, besides a [`Pendulum`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// The pendulum with the damping β (1/s), zero for none.
    Damped(f64),
    /// The pendulum with the damping β (1/s), driven with the strength γ at the frequency Ω
    /// (rad/s).
    Driven(f64, f64, f64),
    /// The pendulum on a pivot shaken by the amplitude a (m) at the frequency Ω (rad/s).
    Shaken(f64, f64),
    /// Two pendulums of the same length and mass, one hung from the other, of which the lower one
    /// starts with the angle θ₂ (rad) and the velocity ω₂ (rad/s).
    Double(f64, f64),
}

/// A pendulum, its start, a method and a step.
#[derive(Clone, Copy, Debug)]
pub struct Setup {
    /// Index of the method in [`METHODS`](pendula::METHODS).
    pub method: usize,
    /// The pendulum.
    pub pendulum: Pendulum,
    /// What is done to it, or hung from it.
    pub kind: Kind,
    /// The start, of the upper bob if there are two.
    pub start: Phase,
    /// The step Δt (s).
    pub step: f64,
}

// By their types: for all systems as one, which the library does not have, and without a heap.
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

// By their types, which say whether a method suits the double pendulum; the library's own answer,
// `ByName`, would compile its steps into the file.
macro_rules! general {
    ($($module:ident::$method:ident,)+) => {
        /// Whether each of the methods that suit every separable system suits the double pendulum
        /// too; they are the first in the list.
        const SUIT_DOUBLE: &[bool] = &[$(Asked::<methods::$method>::SUITS_DOUBLE),+];
    };
}
pendula::for_each_general_method!(general);

/// Asks a method what it suits: its own constant goes before that of the trait.
struct Asked<M>(M);

impl<M: Method<DoublePendulum>> Asked<M> {
    const SUITS_DOUBLE: bool = true;
}

trait Otherwise {
    const SUITS_DOUBLE: bool = false;
}

impl<M> Otherwise for Asked<M> {}

/// No method has a larger [`REACH`](Method::REACH).
type Farthest = methods::Dop853;
const FARTHEST: f64 = <Farthest as Method<ScaledPendulum>>::REACH;

/// An hour in steps of a tenth of a millisecond: more than anybody waits for.
const MOST_STEPS: u64 = 36_000_000;

/// The trajectory of a [`Setup`].
pub struct Trajectory {
    pendulum: Pendulum,
    system: Shared,
    /// In seconds, and in the system's unit of time.
    grid: Grid,
    inner: Grid,
    z: SharedState,
    carry: Carry,
    taken: u64,
    bobs: [Phase; 2],
}

impl Trajectory {
    /// The trajectory at its start; `None` if the library refuses the scene, or if the method does
    /// not apply to the system or to steps so long.
    pub fn new(scene: &Setup) -> Option<Self> {
        Self::of(scene, MOST_STEPS)
    }

    /// As [`new`](Self::new), for at most `most` steps.
    pub fn of(scene: &Setup, most: u64) -> Option<Self> {
        let Setup { method, pendulum, kind, step, .. } = *scene;
        let start = pendulum.start(scene.start.theta, scene.start.omega).ok()?;
        let grid = Grid::new(step, most).ok()?;
        let suits_double = SUIT_DOUBLE.get(method);
        let damped = |beta| Damped::new(pendulum, beta).ok();
        let forced = match kind {
            Kind::Damped(0.0) | Kind::Double(..) => None,
            _ if suits_double.is_none() => return None,
            Kind::Damped(beta) => Some(Forced::Damped(damped(beta)?)),
            Kind::Driven(beta, strength, frequency) => {
                Some(Forced::Driven(Driven::new(damped(beta)?, strength, frequency).ok()?))
            }
            Kind::Shaken(amplitude, frequency) => {
                Some(Forced::Shaken(Shaken::new(pendulum, amplitude, frequency).ok()?))
            }
        };
        let ((system, z), grid, inner) = match (kind, forced) {
            (_, Some(forced)) => (Shared::forced(forced, start), grid, grid),
            (Kind::Double(theta2, omega2), _) => {
                if suits_double != Some(&true) {
                    return None;
                }
                let joint = Joint { length: pendulum.length(), mass: pendulum.mass() };
                let double = DoublePendulum::of_equals(pendulum.gravity(), joint).ok()?;
                let z = double.start([start.theta, theta2], [start.omega, omega2]).ok()?;
                (Shared::double(double, z), grid, grid)
            }
            _ => {
                let (scaled, grid) = longest(scene, start, most)?;
                (Shared::scaled(scaled, start), grid, grid.in_steps())
            }
        };
        let carry = Carry::start(method, &system, inner.step(), z)?;
        let mut new =
            Self { pendulum, system, grid, inner, z, carry, taken: 0, bobs: [start, NONE] };
        if let One::Double(_) = z {
            // Velocities have become momenta: what is shown is what these say.
            new.bobs = new.system.bobs(z);
        }
        Some(new)
    }

    /// Takes a step, if one is left, and returns whether it did: one iteration of the loop in
    /// `pendula::integrate`.
    pub fn step(&mut self) -> bool {
        if self.taken == self.grid.steps() {
            return false;
        }
        let (t, h) = (self.inner.time(self.taken), self.inner.step());
        self.z = self.carry.step(&self.system, t, h, self.z);
        self.bobs = self.system.bobs(self.z);
        self.taken += 1;
        true
    }

    /// Angles (rad) and angular velocities (rad/s): at first the start as it was given. NaN for a
    /// bob that there is not.
    pub const fn bobs(&self) -> [Phase; 2] {
        self.bobs
    }

    /// The energy (J), zero where all hangs at rest; seen from the pivot if it is shaken.
    pub fn energy(&self) -> f64 {
        match (&self.system, self.z) {
            (One::Double((double, _)), One::Double(z)) => double.energy(z),
            _ => self.pendulum.energy(self.bobs[0]),
        }
    }

    /// The same, as `pendula simulate` prints it: for one bob, zero at the height of the pivot.
    pub fn energy_as_printed(&self) -> f64 {
        match self.system {
            One::Double(_) => self.energy(),
            _ => self.pendulum.energy_from_pivot(self.bobs[0]),
        }
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

    /// The system as the methods see it, and the state of it that comes next.
    pub fn into_system(self) -> (Shared, SharedState) {
        (self.system, self.z)
    }

    /// Force evaluations so far, counted.
    pub fn evaluations(&self) -> u64 {
        self.system.evaluations()
    }
}

/// The longest grid, `most` steps or fewer by halves, for which [`ScaledPendulum::new`] accepts the
/// method, and the scaled pendulum; on shorter grids `pendula::integrate_fast` computes the same,
/// bit for bit. None for steps in which a processed method has no inverse change of variables.
fn longest(scene: &Setup, start: Phase, most: u64) -> Option<(ScaledPendulum, Grid)> {
    let mut steps = most;
    while steps > 0 {
        let grid = Grid::new(scene.step, steps).ok()?;
        if let Some(scaled) = scaled(scene.method, scene, &grid, start) {
            return Some((scaled, grid));
        }
        steps /= 2;
    }
    None
}
