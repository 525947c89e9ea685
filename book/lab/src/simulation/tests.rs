//! The lab's source against the library, compiled for this machine. The compiled file is compared
//! in `book/lab/tests/compiled/lab.rs`, which cannot see a source that has moved on from it.

use pendula::systems::{DoublePhase, Driven, Joint, Shaken};
use pendula::{
    AnyMethod, Damped, DoublePendulum, Grid, Hamiltonian, Info, METHODS, Method, Motion, Observer,
    Pendulum, Phase, integrate, methods,
};

use super::Simulation;
use crate::trajectory::{self, Kind, Setup};

/// Within the range of the page's sliders, at its corners and beyond: g, L, β, θ₀, ω₀, Δt.
const PENDULUMS: [(f64, f64, f64, f64, f64, f64); 6] = [
    (9.81, 1.0, 0.0, 1.0, 0.0, 0.01),
    (1.62, 2.5, 0.0, -0.3, 4.5, 0.001),
    (24.8, 0.1, 0.0, 0.0, -40.0, 0.0025),
    // Beyond the limits of stability, where energies reach far.
    (9.81, 1.0, 0.0, 0.5, 0.0, 1.5),
    (9.81, 1.0, 0.3, 2.5, 1.0, 0.02),
    (3.71, 0.7, 2.0, -3.1, 9.0, 0.2),
];

/// The steps of a run, and after how many of them the page looks.
const STEPS: u64 = 150;
const LOOK: u64 = 7;

/// Compares the bits, except for a NaN, of an implicit step that is not solved, which has many bit
/// patterns.
#[track_caller]
fn assert_bits(lab: f64, library: f64, what: impl FnOnce() -> String) {
    assert!(
        lab.to_bits() == library.to_bits() || (lab.is_nan() && library.is_nan()),
        "{}: {lab:e}, and in the library {library:e}",
        what()
    );
}

/// Takes a step for each of the library's, and compares every quantity that the page reads.
struct Beside {
    lab: Simulation,
    pendulum: Pendulum,
    name: &'static str,
    initial: f64,
    lowest: f64,
    highest: f64,
    largest: f64,
}

impl Observer<Phase> for Beside {
    fn observe(&mut self, n: u64, t: f64, z: Phase) {
        if n > 0 {
            assert_eq!(self.lab.advance(1), 1);
        }
        let error = self.pendulum.energy(z) - self.initial;
        self.lowest = self.lowest.min(error);
        self.highest = self.highest.max(error);
        self.largest = self.largest.max(error.abs());
        let expected = [
            (0, "θ", z.theta),
            (1, "ω", z.omega),
            (2, "t", t),
            (3, "the number of steps", n as f64),
            (5, "the energy", self.pendulum.energy_from_pivot(z)),
            (6, "the energy error", error),
            (7, "the lowest energy error since a look", self.lowest),
            (8, "the highest energy error since a look", self.highest),
            (9, "the largest energy error", self.largest),
            (12, "the energy at the start", self.initial),
        ];
        for (quantity, words, expected) in expected {
            let seen = self.lab.read(quantity);
            assert_bits(seen, expected, || format!("{}, {words} after {n} steps", self.name));
        }
        if n.is_multiple_of(LOOK) {
            self.lab.look();
            (self.lowest, self.highest) = (error, error);
        }
    }
}

macro_rules! damped_run {
    ($($module:ident::$method:ident,)+) => {
        /// The run of a method that suits every system; `None` if the method is not one of those.
        fn damped_run(
            name: &str,
            system: &Damped,
            start: Phase,
            grid: &Grid,
            observer: &mut impl Observer<Phase>,
        ) -> Option<Phase> {
            use pendula::{Info, methods};
            $(
                let method = methods::$method;
                if method.info().name == name {
                    return Some(integrate(system, &method, start, grid, observer));
                }
            )+
            None
        }
    };
}
pendula::for_each_general_method!(damped_run);

/// Every method of the library on each of those pendulums, bit for bit after each step.
///
/// Catches: source that has changed and was not compiled, such as an energy with another zero, a
/// largest error that is the largest gain, extremes that `look` does not reset; a method or a
/// system under another's number; a carry lost between two calls; an error before the first step.
#[test]
fn the_source_has_the_bits_of_the_library() {
    assert_eq!(trajectory::METHODS, METHODS.len());
    let (mut runs, mut damped_runs) = (0, 0);
    for (index, method) in METHODS.iter().enumerate() {
        let info = method.info();
        assert_eq!(trajectory::names(index), Some([info.name, info.title]));
        for scene in PENDULUMS {
            match compare(index, *method, scene) {
                true if scene.2 == 0.0 => runs += 1,
                true => damped_runs += 1,
                false => {}
            }
        }
    }
    // One of the four has steps too long for the two processed methods.
    assert_eq!(runs, 4 * METHODS.len() - 2);
    assert!(damped_runs > METHODS.len(), "only {damped_runs} runs with damping");
}

/// Compares a run; whether the method suits the pendulum.
fn compare(
    index: usize,
    method: &dyn AnyMethod,
    (g, length, damping, theta, omega, step): (f64, f64, f64, f64, f64, f64),
) -> bool {
    let name = method.info().name;
    let pendulum = Pendulum::new(g, length, 1.0).unwrap();
    let start = pendulum.start(theta, omega).unwrap();
    let grid = Grid::new(step, STEPS).unwrap();
    let initial = pendulum.energy(start);
    let lab = Simulation::new(Setup {
        method: index,
        pendulum,
        kind: Kind::Damped(damping),
        start,
        step,
    });
    let damped = Damped::new(pendulum, damping).unwrap();
    let Some(lab) = lab else {
        // In steps of x² > 12 the library takes a processed method's steps in seconds.
        if damping == 0.0 {
            let is_too_long = name.starts_with("processed") && g / length * step * step > 12.0;
            assert!(is_too_long, "{name} is refused");
        } else {
            let none = damped_run(name, &damped, start, &grid, &mut ()).is_none();
            assert!(none, "{name} is refused");
        }
        return false;
    };
    let (lowest, highest, largest) = (0.0, 0.0, 0.0);
    let mut beside = Beside { lab, pendulum, name, initial, lowest, highest, largest };
    if damping == 0.0 {
        method.run(&pendulum, start, &grid, &mut beside);
        // The number of iterations of an implicit method depends on its rounding, which differs
        // between steps and seconds as the unit of time.
        if !method.info().implicit {
            let counted = method.count_evaluations(&pendulum, start, &grid);
            assert_eq!(beside.lab.read(4), counted as f64, "{name}");
        }
        let motion = Motion::new(&pendulum, start).unwrap();
        let begun = beside.lab.exact(0.0);
        assert_bits(begun.theta, start.theta, || "the exact θ at the start".to_string());
        assert_bits(begun.omega, start.omega, || "the exact ω at the start".to_string());
        for t in [0.37, 40.0] {
            let (seen, exact) = (beside.lab.exact(t), motion.at(t));
            assert_bits(seen.theta, exact.theta, || format!("the exact θ at {t} s"));
            assert_bits(seen.omega, exact.omega, || format!("the exact ω at {t} s"));
        }
        assert_bits(beside.lab.read(11), motion.period().unwrap(), || "the period".to_string());
    } else {
        let end = damped_run(name, &damped, start, &grid, &mut beside);
        assert!(end.is_some(), "{name} is for the undamped pendulum, and runs on this one");
        assert!(beside.lab.read(11).is_nan() && beside.lab.exact(1.0).theta.is_nan());
    }
    assert!(beside.lab.read(10) >= 8_192.0);
    assert!([13, 14, 15].iter().all(|&none| beside.lab.read(none).is_nan()));
    true
}

/// On the separatrix ω = 2ω₀ cos(θ/2), to a few roundings of the largest ω, and at the bottom at
/// t = 0. Here 2ω₀ = 8 rad/s.
///
/// Catches: another curve, or one that is at the bottom at another time.
#[test]
fn the_separatrix_is_the_pendulums() {
    let pendulum = Pendulum::new(4.0, 0.25, 1.0).unwrap();
    let start = Phase::at_rest(1.0);
    let scene = Setup { method: 0, pendulum, kind: Kind::Damped(0.0), start, step: 0.01 };
    let lab = Simulation::new(scene).unwrap();
    assert_eq!(lab.separatrix(0.0).theta, 0.0);
    for i in -40_i32..=40 {
        let Phase { theta, omega } = lab.separatrix(f64::from(i) * 0.1);
        assert!((omega - 8.0 * libm::cos(0.5 * theta)).abs() < 8.0 * 1e-15, "{i}: {theta} {omega}");
    }
}

/// Catches: more steps than there are, or fewer said than taken; extremes of the last step alone.
#[test]
fn many_steps_at_once_are_the_same_steps() {
    // Symplectic Euler, whose energy error changes its sign.
    let pendulum = Pendulum::new(9.81, 2.0, 1.0).unwrap();
    let start = Phase::at_rest(1.0);
    let scene = Setup { method: 1, pendulum, kind: Kind::Damped(0.0), start, step: 0.05 };
    let (mut one, mut many) = (Simulation::new(scene).unwrap(), Simulation::new(scene).unwrap());
    for _ in 0..10 {
        (0..30).for_each(|_| assert_eq!(one.advance(1), 1));
        assert_eq!(many.advance(30), 30);
        for quantity in 0..=12 {
            assert_eq!(one.read(quantity).to_bits(), many.read(quantity).to_bits(), "{quantity}");
        }
    }
    assert!(many.read(7) < 0.0 && many.read(8) > 0.0);
    // With kicks this large the half turns soon become too many to count, and the run has an end.
    let pendulum = Pendulum::new(1e7, 1.0, 1.0).unwrap();
    let mut short = Simulation::new(Setup { pendulum, step: 1.0, ..scene }).unwrap();
    let limit = short.read(10) as u32;
    assert!((1..1000).contains(&limit), "{limit}");
    assert_eq!((short.advance(u32::MAX), short.advance(1)), (limit, 0));
    assert_eq!(short.read(3), f64::from(limit));
}

/// What a run of the library is at each step, and the lab's.
struct Same<'a, F> {
    lab: Simulation,
    name: &'a str,
    /// Upper bob, lower bob, energy (J).
    of: F,
    initial: f64,
}

impl<Z, F: Fn(Z) -> ([Phase; 2], f64)> Observer<Z> for Same<'_, F> {
    fn observe(&mut self, n: u64, t: f64, z: Z) {
        if n > 0 {
            assert_eq!(self.lab.advance(1), 1);
        }
        let ([upper, lower], energy) = (self.of)(z);
        if n == 0 {
            self.initial = energy;
        }
        let expected = [
            (0, upper.theta),
            (1, upper.omega),
            (2, t),
            (6, energy - self.initial),
            (13, lower.theta),
            (14, lower.omega),
        ];
        for (quantity, expected) in expected {
            let seen = self.lab.read(quantity);
            assert_bits(seen, expected, || format!("{}, {quantity} after {n} steps", self.name));
        }
    }
}

/// A method on a double pendulum, if it suits it: its own function goes before that of the trait.
struct Asked<M>(M);

impl<M: Method<DoublePendulum>> Asked<M> {
    fn runs(&self, of: &DoublePendulum, z: DoublePhase, grid: &Grid, by: &mut Doubles<'_>) -> bool {
        integrate(of, &self.0, z, grid, by);
        true
    }
}

trait Otherwise {
    fn runs(&self, _: &DoublePendulum, _: DoublePhase, _: &Grid, _: &mut Doubles<'_>) -> bool {
        false
    }
}

impl<M> Otherwise for Asked<M> {}

type Doubles<'a> = Same<'a, &'a dyn Fn(DoublePhase) -> ([Phase; 2], f64)>;

/// A pendulum of L = 1.3 m from 2.1 rad with 0.7 rad/s, in steps of 0.02 s: driven, shaken, and two
/// of them one below the other, with every method that suits, bit for bit after each step.
///
/// Catches: strength and frequency, or angle and velocity of the lower bob, exchanged; one system
/// taken for another; a method offered that does not suit; energies of the upper bob alone.
#[test]
fn other_systems_have_the_bits_of_the_library() {
    let none = Phase { theta: f64::NAN, omega: f64::NAN };
    let pendulum = Pendulum::new(9.81, 1.3, 1.0).unwrap();
    let start = pendulum.start(2.1, 0.7).unwrap();
    let grid = Grid::new(0.02, STEPS).unwrap();
    let driven = Driven::new(Damped::new(pendulum, 0.3).unwrap(), 1.2, 2.5).unwrap();
    let shaken = Shaken::new(pendulum, 0.15, 31.0).unwrap();
    let joint = Joint { length: 1.3, mass: 1.0 };
    let double = DoublePendulum::of_equals(9.81, joint).unwrap();
    let both = double.start([2.1, -0.4], [0.7, 1.9]).unwrap();
    let one = |z| ([z, none], pendulum.energy(z));
    let two = |z: DoublePhase| {
        let [upper, lower] = double.velocities(z);
        let bobs =
            [Phase { theta: z.theta1, omega: upper }, Phase { theta: z.theta2, omega: lower }];
        (bobs, double.energy(z))
    };
    let lab =
        |method: usize, kind| Simulation::new(Setup { method, pendulum, kind, start, step: 0.02 });
    let (mut method, mut doubles) = (0, 0);
    macro_rules! each {
        ($($module:ident::$method:ident,)+) => {$({
            let it = methods::$method;
            let name = it.info().name;
            let same = |kind| {
                Same { lab: lab(method, kind).unwrap(), name, of: one, initial: f64::NAN }
            };
            let kind = Kind::Driven(0.3, 1.2, 2.5);
            integrate(&driven, &it, start, &grid, &mut same(kind));
            integrate(&shaken, &it, start, &grid, &mut same(Kind::Shaken(0.15, 31.0)));
            let kind = Kind::Double(-0.4, 1.9);
            let stands = lab(method, kind);
            let asked = stands.is_some();
            // In its place, where there is none, one that is not used.
            let lab = stands.unwrap_or_else(|| lab(2, kind).unwrap());
            let mut same = Doubles { lab, name, of: &two, initial: f64::NAN };
            assert_eq!(Asked(it).runs(&double, both, &grid, &mut same), asked, "{name}");
            doubles += usize::from(asked);
            method += 1;
        })+};
    }
    pendula::for_each_general_method!(each);
    assert_eq!(doubles, 11);
    for kind in [Kind::Driven(0.3, 1.2, 2.5), Kind::Shaken(0.15, 31.0), Kind::Double(0.0, 0.0)] {
        assert!((method..METHODS.len()).all(|special| lab(special, kind).is_none()), "{kind:?}");
    }
    for refused in [Kind::Driven(0.3, 1.2, 0.0), Kind::Shaken(-1.0, 1.0), Kind::Double(1e300, 0.0)]
    {
        assert!(lab(2, refused).is_none(), "{refused:?}");
    }
}
