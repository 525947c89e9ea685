//! A method on its way: the state, what the method remembers, and the count of what it took.

use pendula::methods;
use pendula::stepped::{Stepped, Turned};
use pendula::{
    Counting, Damped, Described, Grid, Method, Pendulum, Phase, Rate, Separable, System,
};

/// What is asked for: a pendulum, its start, a method and a step.
#[derive(Clone, Copy, Debug)]
pub struct Scene {
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

macro_rules! lists {
    ($($module:ident::$method:ident,)+) => {
        /// Which method it is, and what its last step left for the next.
        enum AnyMemo<S: Separable> {
            $($method(<methods::$module::$method as Method<S>>::Memo),)+
        }

        impl<S: Separable> AnyMemo<S> {
            /// [`Method::start`] of the method at `index` in the library's list.
            fn start(index: usize, system: &S, h: f64, z: S::State) -> Option<Self> {
                let mut number = 0..;
                $(if number.next() == Some(index) {
                    return Some(Self::$method(methods::$module::$method.start(system, 0.0, h, z)));
                })+
                None
            }

            /// [`Method::step`].
            fn step(&mut self, system: &S, t: f64, h: f64, z: S::State) -> S::State {
                match self {
                    $(Self::$method(memo) => {
                        methods::$module::$method.step(system, t, h, z, memo)
                    })+
                }
            }
        }

        /// Number of methods.
        pub const METHODS: usize = [$(stringify!($method)),+].len();

        /// Name and title of the method at `index` in the library's list. Asked for one by one, so that the rest of what is
        /// known of them stays out of the page.
        pub fn names(index: usize) -> Option<[&'static str; 2]> {
            let mut number = 0..;
            $(if number.next() == Some(index) {
                let properties = methods::$module::$method.properties();
                return Some([properties.name, properties.title]);
            })+
            None
        }
    };
}
pendula::methods!(lists);

/// A system that is compiled once for all methods, and not into each of their steps: a page is short of room, not of time.
struct Shared<S>(Counting<S>);

impl<S: System> System for Shared<S> {
    type State = S::State;

    #[inline(never)]
    fn rate(&self, t: f64, z: S::State) -> Rate<S> {
        self.0.rate(t, z)
    }
}

impl<S: Separable> Separable for Shared<S> {
    type Force = S::Force;

    #[inline(never)]
    fn force(&self, t: f64, z: S::State) -> S::Force {
        self.0.force(t, z)
    }

    #[inline(never)]
    fn kick(&self, z: S::State, force: S::Force, h: f64) -> S::State {
        self.0.kick(z, force, h)
    }

    #[inline(never)]
    fn drift(&self, z: S::State, h: f64) -> S::State {
        self.0.drift(z, h)
    }
}

/// A run on one system, between two steps.
struct Run<S: Separable> {
    system: Shared<S>,
    /// In the system's unit of time.
    grid: Grid,
    z: S::State,
    memo: AnyMemo<Shared<S>>,
}

impl<S: Separable> Run<S> {
    fn new(method: usize, system: S, grid: Grid, z: S::State) -> Option<Self> {
        let system = Shared(Counting::new(system));
        let memo = AnyMemo::start(method, &system, grid.step(), z)?;
        Some(Self { system, grid, z, memo })
    }

    /// One turn of the loop in `pendula::integrate`.
    fn step(&mut self, n: u64) {
        self.z = self.memo.step(&self.system, self.grid.time(n), self.grid.step(), self.z);
    }
}

/// A run of either system.
enum AnyRun {
    /// As in `pendula::swing`: with the step as the unit of time.
    Swing(Stepped, Run<Stepped>),
    Damped(Run<Damped>),
}

/// As many steps as an hour of a tenth of a millisecond each: more than anybody waits for.
const MOST_STEPS: u64 = 36_000_000;

/// A method on its way through a [`Scene`].
pub struct Walk {
    run: AnyRun,
    grid: Grid,
    taken: u64,
    phase: Phase,
}

impl Walk {
    /// The beginning of the walk; `None` for a scene that the library refuses.
    pub fn new(scene: &Scene) -> Option<Self> {
        let start = scene.pendulum.start(scene.start.theta, scene.start.omega).ok()?;
        let (run, grid) = if scene.damping == 0.0 {
            let (stepped, grid) = longest(&scene.pendulum, scene.step, start)?;
            let z: Turned = stepped.enter(start);
            let run = Run::new(scene.method, stepped, grid.in_steps(), z)?;
            (AnyRun::Swing(stepped, run), grid)
        } else {
            let damped = Damped::new(scene.pendulum, scene.damping).ok()?;
            let grid = Grid::new(scene.step, MOST_STEPS).ok()?;
            (AnyRun::Damped(Run::new(scene.method, damped, grid, start)?), grid)
        };
        Some(Self { run, grid, taken: 0, phase: start })
    }

    /// Takes a step, and says whether there was one left.
    pub fn step(&mut self) -> bool {
        if self.taken == self.grid.steps() {
            return false;
        }
        self.phase = match &mut self.run {
            AnyRun::Swing(stepped, run) => {
                run.step(self.taken);
                stepped.leave(run.z)
            }
            AnyRun::Damped(run) => {
                run.step(self.taken);
                run.z
            }
        };
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

    /// The number of steps there are in all.
    pub const fn limit(&self) -> u64 {
        self.grid.steps()
    }

    /// The time (s).
    pub const fn time(&self) -> f64 {
        self.grid.time(self.taken)
    }

    /// Force evaluations so far, counted.
    pub fn evaluations(&self) -> u64 {
        match &self.run {
            AnyRun::Swing(_, run) => run.system.0.evaluations(),
            AnyRun::Damped(run) => run.system.0.evaluations(),
        }
    }
}

/// The longest grid on which `pendula::swing` counts time in steps, and the pendulum that does: on every shorter one it
/// does the same, bit for bit.
fn longest(pendulum: &Pendulum, step: f64, start: Phase) -> Option<(Stepped, Grid)> {
    let mut steps = MOST_STEPS;
    while steps > 0 {
        let grid = Grid::new(step, steps).ok()?;
        if let Some(stepped) = Stepped::new(pendulum, step, steps, start) {
            return Some((stepped, grid));
        }
        steps /= 2;
    }
    None
}
