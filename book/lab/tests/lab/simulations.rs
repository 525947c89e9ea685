//! A pendulum of the lab beside that of the library, step by step.

use std::num::NonZeroU64;

use pendula::registry::ByName;
use pendula::systems::{DoublePhase, Driven, Joint, Shaken};
use pendula::{
    AnyMethod, Damped, DoublePendulum, Grid, Hamiltonian, METHODS, MethodInfo, Motion, Observer,
    Pendulum, Phase, method_named,
};

use crate::labs::{Lab, STALE, assert_bits, labs, quantity};

/// A scene: method, g, L, β, θ₀, ω₀, Δt.
type Scene = (u32, f64, f64, f64, f64, f64, f64);

/// What is done to the pendulum, or hung from it, as the page says it: the kind and two numbers.
type Kind = (u32, f64, f64);
const PLAIN: Kind = (0, 0.0, 0.0);

impl dyn Lab + '_ {
    fn put(&mut self, place: u32, scene: Scene) -> bool {
        self.put_kind(place, PLAIN, scene)
    }

    fn put_kind(&mut self, place: u32, (kind, p, q): Kind, scene: Scene) -> bool {
        let (method, g, length, damping, theta, omega, step) = scene;
        1 == self.set(place, kind, method, g, length, damping, theta, omega, step, p, q)
    }
}

/// What the library says of a state: upper bob, lower bob, and the energy (J), zero at the bottom
/// and as the program prints it.
type Seen = ([Phase; 2], [f64; 2]);

/// For a bob that there is not.
const NONE: Phase = Phase { theta: f64::NAN, omega: f64::NAN };

/// Compares each sample of a trajectory of the library with the lab's, which takes the same steps.
struct Beside<'a, F> {
    lab: &'a mut dyn Lab,
    name: &'a str,
    of: F,
    motion: Option<Motion>,
    initial: f64,
    largest: f64,
    compared: &'a mut u64,
}

impl<'a, F> Beside<'a, F> {
    fn new(lab: &'a mut dyn Lab, name: &'a str, of: F, compared: &'a mut u64) -> Self {
        Self { lab, name, of, motion: None, initial: f64::NAN, largest: 0.0, compared }
    }
}

impl<Z, F: Fn(Z) -> Seen> Observer<Z> for Beside<'_, F> {
    fn observe(&mut self, n: u64, t: f64, z: Z) {
        let ([upper, lower], [energy, printed]) = (self.of)(z);
        match n {
            0 => self.initial = energy,
            _ => assert_eq!(self.lab.advance(0, 1), 1),
        }
        let error = energy - self.initial;
        self.largest = self.largest.max(error.abs());
        let mut expected = vec![
            (quantity::THETA, upper.theta),
            (quantity::OMEGA, upper.omega),
            (quantity::LOWER_THETA, lower.theta),
            (quantity::LOWER_OMEGA, lower.omega),
            (quantity::TIME, t),
            (quantity::ERROR, error),
            (quantity::ENERGY, printed),
        ];
        if n.is_multiple_of(64) {
            expected.extend([
                (quantity::STEPS, n as f64),
                (quantity::LARGEST, self.largest),
                (quantity::INITIAL, self.initial),
            ]);
        }
        for (quantity, expected) in expected {
            let seen = self.lab.read(0, quantity);
            assert_bits(seen, expected, || format!("{}, {quantity} after {n} steps", self.name));
            *self.compared += 1;
        }
        // The closed form takes as long as ten steps, and does not depend on the method.
        if n.is_multiple_of(64) {
            // The lab begins with the start itself, which the closed form rounds.
            let exact = match self.motion {
                Some(_) if n == 0 => upper,
                Some(motion) => motion.at(t),
                None => NONE,
            };
            let seen = [self.lab.exact_theta(0, t), self.lab.exact_omega(0, t)];
            for (seen, expected) in seen.into_iter().zip([exact.theta, exact.omega]) {
                assert_bits(seen, expected, || format!("the exact motion at {t} s"));
                *self.compared += 1;
            }
        }
    }
}

/// Within the range of the page's sliders, at its corners and beyond: g, L, β, θ₀, ω₀, Δt.
type Numbers = (f64, f64, f64, f64, f64, f64);
const PLAIN_ONES: [Numbers; 6] = [
    (9.81, 1.0, 0.0, 1.0, 0.0, 0.01),
    (9.81, 1.0, 0.0, 3.0, 0.0, 0.05),
    (1.62, 2.5, 0.0, -0.3, 4.5, 0.001),
    (24.8, 0.1, 0.0, 0.0, -40.0, 0.0025),
    // The last torus, and beyond each limit of stability.
    (9.81, 1.0, 0.0, 0.1, 3.0, 0.31471),
    (9.81, 1.0, 0.0, 0.5, 0.0, 1.5),
];
/// Of the other systems, with the numbers of the kind.
const OTHERS: [(Kind, Numbers); 9] = [
    // Damped.
    ((0, 0.0, 0.0), (9.81, 1.0, 0.3, 2.5, 1.0, 0.02)),
    ((0, 0.0, 0.0), (3.71, 0.7, 2.0, -3.1, 9.0, 0.2)),
    // Quick, where the iteration of an implicit step ends by its noise.
    ((0, 0.0, 0.0), (108.89, 0.003417, 0.8452, 18.262, 0.0, 0.004037)),
    // Driven: beyond the first period doublings.
    ((1, 1.105, 6.25), (88.8, 1.0, 2.35, 0.0, 0.0, 0.005)),
    ((1, 3.0, 0.1), (3.71, 0.7, 0.0, -3.1, 9.0, 0.2)),
    // Shaken: upright, where it is stable.
    ((2, 0.1, 60.0), (9.81, 1.0, 0.0, 3.0, 0.0, 0.002)),
    ((2, 0.5, 3.3), (24.8, 0.1, 0.0, 0.0, -40.0, 0.0025)),
    // Double.
    ((3, -1.2, 0.0), (9.81, 1.0, 0.0, 2.0, 0.0, 0.01)),
    ((3, 3.1, -7.0), (1.62, 2.5, 0.0, -0.3, 4.5, 0.05)),
];

/// An interpreter is slow; so most of the values come from methods with few force evaluations a
/// step.
fn steps(info: &MethodInfo) -> u64 {
    match info {
        MethodInfo { implicit: true, .. } => 30,
        MethodInfo { force_evaluations: 0..=4, .. } => 400,
        _ => 60,
    }
}

/// Every method of the library, on each of those pendulums, step by step, in angle, velocity, time,
/// energy and its error; the closed form; and the counts.
///
/// Catches: a file compiled before the library changed; a compiler that contracts, reorders or
/// rounds differently; a step that differs from that of `integrate_fast`; a carry lost between two
/// calls; an error before the first step; a bob that there is not.
#[test]
fn the_lab_has_the_bits_of_the_library() {
    for lab in &mut labs() {
        let mut compared = 0;
        for (index, method) in METHODS.iter().enumerate() {
            for numbers in PLAIN_ONES {
                compare(lab.as_mut(), (index as u32, *method), numbers, &mut compared);
            }
        }
        assert!(compared >= 200_000, "only {compared} values");
    }
}

fn compare(
    lab: &mut dyn Lab,
    (index, method): (u32, &dyn AnyMethod),
    (g, length, damping, theta, omega, step): Numbers,
    compared: &mut u64,
) {
    let info = method.info();
    let pendulum = Pendulum::new(g, length, 1.0).unwrap();
    let start = pendulum.start(theta, omega).unwrap();
    let grid = Grid::new(step, steps(&info)).unwrap();
    let stands = lab.put(0, (index, g, length, damping, theta, omega, step));
    // In steps of x² > 12 the library takes a processed method's steps in seconds; the lab has none
    // such.
    let is_too_long = info.name.starts_with("processed") && g / length * step * step > 12.0;
    assert_eq!(stands, !is_too_long, "{STALE}");
    if !stands {
        return;
    }
    let motion = Motion::new(&pendulum, start).unwrap();
    let one = |z| ([z, NONE], [pendulum.energy(z), pendulum.energy_from_pivot(z)]);
    let beside = Beside::new(lab, info.name, one, compared);
    method.run(&pendulum, start, &grid, &mut Beside { motion: Some(motion), ..beside });
    assert!(lab.read(0, quantity::LOWER_OMEGA + 1).is_nan());
    let limit = lab.read(0, quantity::LIMIT);
    assert!(limit >= 8_192.0, "{}: only {limit} steps", info.name);
    // The number of iterations of an implicit method depends on its rounding, which differs between
    // steps and seconds as the unit of time.
    if !info.implicit {
        let counted = method.count_evaluations(&pendulum, start, &grid);
        assert_eq!(lab.read(0, quantity::EVALUATIONS), counted as f64, "{}\n{STALE}", info.name);
    }
    let period = motion.period().unwrap();
    assert_bits(lab.read(0, quantity::PERIOD), period, || "the period".to_string());
}

/// The damped, the driven, the shaken and the double pendulum with every method that suits them,
/// step by step, in angles, velocities, time and energy; and the counts.
///
/// Catches: a file compiled before the library changed; a step that differs from that of
/// `integrate`; numbers of one system that arrive as another's; a method offered that does not
/// suit; the energy of the upper bob alone; evaluations that are not counted.
#[test]
fn other_systems_have_the_bits_of_the_library() {
    for lab in &mut labs() {
        let (mut compared, mut doubles) = (0, 0);
        for (index, method) in METHODS.iter().enumerate() {
            for (kind, numbers) in OTHERS {
                let method = (index as u32, method.info());
                let suits = compare_other(lab.as_mut(), method, kind, numbers, &mut compared);
                doubles += u64::from(suits && kind.0 == 3);
            }
        }
        // Of the 22 that suit every system that splits, the splitting methods do not suit it.
        assert_eq!(doubles, 2 * 11);
        assert!(compared >= 200_000, "only {compared} values");
    }
}

/// Compares a run; whether the method suits the system.
fn compare_other(
    lab: &mut dyn Lab,
    (index, info): (u32, MethodInfo),
    kind: Kind,
    (g, length, beta, theta, omega, step): Numbers,
    compared: &mut u64,
) -> bool {
    let stands = lab.put_kind(0, kind, (index, g, length, beta, theta, omega, step));
    let (which, p, q) = kind;
    let name = format!("{} on {which}", info.name);
    let pendulum = Pendulum::new(g, length, 1.0).unwrap();
    let start = pendulum.start(theta, omega).unwrap();
    let grid = Grid::new(step, steps(&info)).unwrap();
    let one = |z| ([z, NONE], [pendulum.energy(z), pendulum.energy_from_pivot(z)]);
    let damped = Damped::new(pendulum, beta).unwrap();
    let run = (start, &grid);
    let counted = match which {
        0 => run_on(&damped, &info, run, Beside::new(lab, &name, one, compared)),
        1 => {
            let driven = Driven::new(damped, p, q).unwrap();
            run_on(&driven, &info, run, Beside::new(lab, &name, one, compared))
        }
        2 => {
            let shaken = Shaken::new(pendulum, p, q).unwrap();
            run_on(&shaken, &info, run, Beside::new(lab, &name, one, compared))
        }
        _ => {
            let double = DoublePendulum::of_equals(g, Joint { length, mass: 1.0 }).unwrap();
            let two = |z: DoublePhase| {
                let [upper, lower] = double.velocities(z);
                let bobs = [(z.theta1, upper), (z.theta2, lower)];
                (bobs.map(|(theta, omega)| Phase { theta, omega }), [double.energy(z); 2])
            };
            let z = double.start([theta, p], [omega, q]).unwrap();
            run_on(&double, &info, (z, &grid), Beside::new(lab, &name, two, compared))
        }
    };
    assert_eq!(stands, counted.is_some(), "{name}\n{STALE}");
    if let Some(counted) = counted {
        let seen = lab.read(0, quantity::EVALUATIONS);
        assert!(counted.is_none_or(|counted| seen == counted as f64), "{name}: {seen}\n{STALE}");
        assert!(lab.read(0, quantity::PERIOD).is_nan(), "{name} has a period");
    }
    stands
}

/// Runs the method on a system beside the lab; `None` if it does not suit the system.
/// Its force evaluations; none if a step has no solution, where the lab has NaN and goes on.
fn run_on<S: ByName>(
    system: &S,
    info: &MethodInfo,
    (start, grid): (S::State, &Grid),
    mut beside: Beside<'_, impl Fn(S::State) -> Seen>,
) -> Option<Option<u64>> {
    let mut run = method_named::<S>(info.name)?.begin(system, start, grid);
    beside.observe(0, 0.0, start);
    let solved = run.advance(u64::MAX, NonZeroU64::MIN, &mut beside);
    Some(solved.ok().map(|_| run.evaluations()))
}

/// Catches: a list of methods that is not the library's, or in another order; a title cut in the
/// middle of a character.
#[test]
fn the_page_offers_the_methods_of_the_library() {
    for lab in &mut labs() {
        let count = lab.methods();
        let names: Vec<_> = (0..count).map(|i| [lab.text(i, 0), lab.text(i, 1)]).collect();
        let infos = METHODS.iter().map(|method| method.info());
        let known: Vec<_> = infos.map(|p| [p.name.to_string(), p.title.to_string()]).collect();
        assert_eq!(names, known, "{STALE}");
        assert_eq!(lab.text(count, 0) + &lab.text(0, 2), "");
    }
}

/// Catches: steps that depend on how many are taken at once; extremes that miss a step or are not
/// reset by `look`.
#[test]
fn many_steps_at_once_are_the_same_steps() {
    for lab in &mut labs() {
        let scene = (2, 9.81, 1.0, 0.0, 1.0, 0.0, 0.05);
        assert!(lab.put(0, scene) && lab.put(7, scene));
        for _ in 0..50 {
            assert_eq!(lab.advance(0, 20), 20);
            let (mut lowest, mut highest) = (f64::INFINITY, f64::NEG_INFINITY);
            // The last sample belongs to the next span too, so that the spans touch.
            for _ in 0..=20 {
                let error = lab.read(7, quantity::ERROR);
                (lowest, highest) = (lowest.min(error), highest.max(error));
                if lab.read(7, quantity::STEPS) < lab.read(0, quantity::STEPS) {
                    lab.advance(7, 1);
                }
            }
            for one in [quantity::THETA, quantity::OMEGA, quantity::LARGEST, quantity::EVALUATIONS]
            {
                assert_eq!(lab.read(0, one), lab.read(7, one));
            }
            assert_eq!(lab.read(0, quantity::LOWEST), lowest);
            assert_eq!(lab.read(0, quantity::HIGHEST), highest);
            lab.look(0);
        }
    }
}

/// Catches: a number from the page that leads to NaN or a trap, a place that keeps its pendulum
/// after a refusal, steps beyond the last.
#[test]
fn what_the_library_refuses_leaves_an_empty_place() {
    for lab in &mut labs() {
        let places = lab.places();
        let fine = (0, 9.81, 1.0, 0.0, 1.0, 0.0, 0.01);
        assert!(places >= 5 && lab.put(places - 1, fine) && !lab.put(places, fine));
        let (nan, infinity) = (f64::NAN, f64::INFINITY);
        for refused in [
            (METHODS.len() as u32, 9.81, 1.0, 0.0, 1.0, 0.0, 0.01),
            (0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.01),
            (0, 9.81, -1.0, 0.0, 1.0, 0.0, 0.01),
            (0, 9.81, 1.0, -0.1, 1.0, 0.0, 0.01),
            (0, 9.81, 1.0, nan, 1.0, 0.0, 0.01),
            (0, 9.81, 1.0, 0.0, nan, 0.0, 0.01),
            (0, 9.81, 1.0, 0.0, 1.0, infinity, 0.01),
            (0, 9.81, 1.0, 0.0, 1.0, 0.0, 0.0),
        ] {
            assert!(lab.put(0, fine) && !lab.put(0, refused), "{refused:?}");
            assert_eq!(lab.advance(0, 1), 0);
            assert!(lab.read(0, quantity::THETA).is_nan());
        }
        for refused in
            [(1, 1.0, 0.0), (1, nan, 1.0), (2, -0.1, 1.0), (2, 0.1, infinity), (3, nan, 0.0)]
                .into_iter()
                .chain([(3, 0.0, infinity), (4, 0.0, 0.0)])
        {
            let rk4 = (2, 9.81, 1.0, 0.0, 1.0, 0.0, 0.01);
            assert!(lab.put(0, rk4) && !lab.put_kind(0, refused, rk4), "{refused:?}");
            assert!(lab.read(0, quantity::THETA).is_nan());
        }
        assert!(lab.read(places, quantity::THETA).is_nan());
        // A run has `limit` steps and no more: with kicks this large its half turns soon become too
        // many to count.
        assert!(lab.put(0, (0, 1e7, 1.0, 0.0, 1.0, 0.0, 1.0)));
        let limit = lab.read(0, quantity::LIMIT) as u32;
        assert!((1..1000).contains(&limit), "{limit}");
        assert_eq!(lab.advance(0, u32::MAX), limit);
        assert_eq!(lab.advance(0, 1), 0);
    }
}

/// On the separatrix ω = 2ω₀ cos(θ/2), to a few roundings of the largest ω; and θ goes from −π to
/// π.
///
/// Catches: another curve, or one that is at the bottom at another time than 0.
#[test]
fn the_separatrix_is_the_pendulums() {
    for lab in &mut labs() {
        assert!(lab.put(0, (0, 4.0, 0.25, 0.0, 1.0, 0.0, 0.01)));
        assert_eq!(lab.separatrix_theta(0, 0.0), 0.0);
        for i in -40_i32..=40 {
            let t = f64::from(i) * 0.1;
            let (theta, omega) = (lab.separatrix_theta(0, t), lab.separatrix_omega(0, t));
            assert!(
                (omega - 8.0 * libm::cos(0.5 * theta)).abs() < 8.0 * 1e-15,
                "{t}: {theta} {omega}"
            );
            assert!(i.abs() < 40 || (theta.abs() - std::f64::consts::PI).abs() < 1e-6);
        }
    }
}
