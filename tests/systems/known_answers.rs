//! The library's systems beside the judge's formulas of right-hand sides, which do not share their
//! code.

use std::panic::{AssertUnwindSafe, catch_unwind};

use pendula::systems::{Damped, DoublePendulum, DoublePhase, Driven, Joint, Pendulum, Phase};
use pendula::{Hamiltonian, System};
use pendula_judge::known_answers::{self, Comparison, Point, RightHandSide};

fn known(system: &str) -> &'static RightHandSide {
    known_answers::right_hand_side(system).unwrap()
}

/// The numbers of these names.
fn numbers<const N: usize>(point: &Point, names: [&str; N]) -> [f64; N] {
    names.map(|name| point.number(name))
}

fn pendulum(point: &Point) -> Pendulum {
    let [g, l, m] = numbers(point, ["g", "l", "m"]);
    Pendulum::new(g, l, m).unwrap()
}

fn damped(point: &Point) -> Damped {
    Damped::new(pendulum(point), point.number("beta")).unwrap()
}

fn driven(point: &Point) -> Driven {
    let [amplitude, frequency] = numbers(point, ["amplitude", "frequency"]);
    // The library has the drive in units of g/L.
    let strength = amplitude / pendulum(point).frequency_squared();
    Driven::new(damped(point), strength, frequency).unwrap()
}

fn double(point: &Point) -> DoublePendulum {
    let [g, l1, l2, m1, m2] = numbers(point, ["g", "l1", "l2", "m1", "m2"]);
    let (upper, lower) = (Joint { length: l1, mass: m1 }, Joint { length: l2, mass: m2 });
    DoublePendulum::new(g, upper, lower).unwrap()
}

fn phase(point: &Point) -> Phase {
    let [theta, omega] = numbers(point, ["theta", "omega"]);
    Phase { theta, omega }
}

fn double_phase(point: &Point) -> DoublePhase {
    let [theta1, theta2, p1, p2] = numbers(point, ["theta1", "theta2", "p1", "p2"]);
    DoublePhase { theta1, theta2, p1, p2 }
}

/// Asserts that `rates` and `energies` are those of the formulas. The tolerances come with these;
/// `test_formulas.py` of the package for Python derives them.
fn assert_known(system: &str, rates: impl Fn(&Point) -> Vec<f64>, energy: impl Fn(&Point) -> f64) {
    let known = known(system);
    assert!(known.points.len() >= 12, "{system}: {} states", known.points.len());
    for point in &known.points {
        let found = rates(point);
        let off = point.off(&found, f64::EPSILON);
        assert!(off <= 1.0, "{system}: {found:?} is {off} tolerances off at {point:?}");
        // The library's energy is 0 at rest.
        let off = point.energy_off(energy(point), f64::EPSILON);
        assert!(off <= 1.0, "{system}: the energy is {off} tolerances off at {point:?}");
    }
    assert_eq!(known.compare(f64::EPSILON, rates), Comparison::Right);
}

/// Catches: a force with l/g, a length that is not squared, or without its mass; a drag that is not
/// doubled, or divided by the mass; a drive in other units, or at another time.
#[test]
fn a_pendulum_is_as_the_formulas_have_it() {
    let energy = |point: &Point| pendulum(point).energy(phase(point));
    let rate = |point: &Point| pendulum(point).rate(0.0, phase(point));
    assert_known("pendulum", |point| vec![rate(point).omega], energy);
    let rate = |point: &Point| damped(point).rate(0.0, phase(point));
    assert_known("damped-pendulum", |point| vec![rate(point).omega], energy);
    let rate = |point: &Point| driven(point).rate(point.number("t"), phase(point));
    assert_known("driven-pendulum", |point| vec![rate(point).omega], energy);
}

/// Catches: a sign or a mass in Hamilton's equations, lengths or masses exchanged.
#[test]
fn a_double_pendulum_is_as_the_formulas_have_it() {
    let rates = |point: &Point| {
        let DoublePhase { theta1, theta2, p1, p2 } = double(point).rate(0.0, double_phase(point));
        vec![theta1, theta2, p1, p2]
    };
    let energy = |point: &Point| double(point).energy(double_phase(point));
    assert_known("double-pendulum-momenta", rates, energy);
}

/// The accelerations by the library's rates: with the mass matrix M of p = Mω, α is what solves
/// Mα = ṗ − Ṁω.
fn accelerations(point: &Point) -> Vec<f64> {
    let double = double(point);
    let [theta1, theta2, omega1, omega2] = numbers(point, ["theta1", "theta2", "omega1", "omega2"]);
    let z = double.start([theta1, theta2], [omega1, omega2]).unwrap();
    let rate = double.rate(0.0, z);
    let (upper, lower) = (double.upper(), double.lower());
    let coupling = lower.mass * upper.length * lower.length;
    let (sin, cos) = (libm::sin(theta1 - theta2), libm::cos(theta1 - theta2));
    // The rate of the off-diagonal entry, coupling cos Δ.
    let turning = -coupling * sin * (omega1 - omega2);
    let (b1, b2) = (rate.p1 - turning * omega2, rate.p2 - turning * omega1);
    let m11 = (upper.mass + lower.mass) * upper.length * upper.length;
    let (m12, m22) = (coupling * cos, lower.mass * lower.length * lower.length);
    let determinant = m11 * m22 - m12 * m12;
    vec![(b1 * m22 - m12 * b2) / determinant, (m11 * b2 - m12 * b1) / determinant]
}

/// The tolerance is for formulas in the velocities. By the momenta p = Mω and M again, terms
/// are rounded twice as often, and the velocities that come back are off by some ε of the sum of
/// their speeds: four tolerances allow for it. A mistake is 10¹² tolerances off.
///
/// Catches: momenta of other velocities than those that were asked for; as above.
#[test]
fn the_accelerations_of_a_double_pendulum_are_known() {
    let known = known("double-pendulum");
    for point in &known.points {
        let off = point.off(&accelerations(point), 4.0 * f64::EPSILON);
        assert!(off <= 1.0, "{off} at {point:?}");
        let [theta1, theta2, omega1, omega2] =
            numbers(point, ["theta1", "theta2", "omega1", "omega2"]);
        let double = double(point);
        let energy = double.energy(double.start([theta1, theta2], [omega1, omega2]).unwrap());
        let off = point.energy_off(energy, f64::EPSILON);
        assert!(off <= 1.0, "energy: {off} at {point:?}");
    }
    assert_eq!(known.compare(4.0 * f64::EPSILON, accelerations), Comparison::Right);
}

/// Two programs as people write them, one with the sign of the second mass wrong in its
/// denominators; one with lengths exchanged, which no program with equal lengths shows.
///
/// Catches: a comparison that calls a mistake right, gives another mistake's name, or takes
/// something that no one has written for one.
#[test]
fn mistakes_have_their_names() {
    let known = known("double-pendulum");
    let with = |sign: f64, exchanged: bool, g: f64| {
        known.compare(f64::EPSILON, move |point| {
            let [t1, t2, w1, w2] = numbers(point, ["theta1", "theta2", "omega1", "omega2"]);
            let [mut l1, mut l2, m1, m2] = numbers(point, ["l1", "l2", "m1", "m2"]);
            let g = g * point.number("g");
            if exchanged {
                (l1, l2) = (l2, l1);
            }
            let (sin, cos) = (libm::sin, libm::cos);
            let d = t1 - t2;
            let below = 2.0 * m1 + sign * m2 - m2 * cos(2.0 * d);
            let weight = g * (2.0 * m1 + m2) * sin(t1) + m2 * g * sin(t1 - 2.0 * t2);
            let turning = w2 * w2 * l2 + w1 * w1 * l1 * cos(d);
            let lower = w1 * w1 * l1 * (m1 + m2) + g * (m1 + m2) * cos(t1);
            vec![
                -(weight + 2.0 * sin(d) * m2 * turning) / (l1 * below),
                2.0 * sin(d) * (lower + w2 * w2 * l2 * m2 * cos(d)) / (l2 * below),
            ]
        })
    };
    let name = |comparison| match comparison {
        Comparison::Mistakes(found) => found.iter().map(|wrong| wrong.name.as_str()).collect(),
        other => vec![if other == Comparison::Right { "right" } else { "unknown" }],
    };
    assert_eq!(name(with(1.0, false, 1.0)), ["right"]);
    assert_eq!(name(with(-1.0, false, 1.0)), ["second-mass-of-wrong-sign"]);
    assert_eq!(name(with(1.0, true, 1.0)), ["lengths-exchanged"]);
    assert_eq!(name(with(1.0, false, 1.0001)), ["unknown"]);
    assert_eq!(name(with(f64::NAN, false, 1.0)), ["unknown"]);
}

/// Catches: a zero of the energy that is taken for a mistake, or a mistake in the energy for right.
#[test]
fn energies_are_compared_from_rest() {
    let pendulum = known("pendulum");
    let energy = |point: &Point, half: f64, theta: f64, omega: f64| {
        let [g, l, m] = numbers(point, ["g", "l", "m"]);
        half * m * (l * omega) * (l * omega) - m * g * l * libm::cos(theta)
    };
    let compare = |half| {
        pendulum.compare_energy(f64::EPSILON, |point| {
            let Phase { theta, omega } = phase(point);
            energy(point, half, theta, omega) - energy(point, half, 0.0, 0.0)
        })
    };
    assert_eq!(compare(0.5), Comparison::Right);
    let Comparison::Mistakes(found) = compare(1.0) else { panic!("it is wrong") };
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].name, "half-left-out");
    assert_eq!(compare(0.75), Comparison::Unknown);
}

/// Catches: the bits of a precision for its ε, or a number by accident, with which all that is
/// wrong is right.
#[test]
fn what_is_no_precision_is_refused() {
    let pendulum = known("pendulum");
    let answer = &known_answers::method("rk4").unwrap().answers[0];
    for epsilon in [-1.0, 0.0, 1e-17, 0.5, 23.0, 53.0, f64::INFINITY, f64::NAN] {
        let asked: [&dyn Fn(); 3] = [
            &|| drop(pendulum.compare(epsilon, |_| vec![0.0])),
            &|| drop(pendulum.compare_energy(epsilon, |_| 0.0)),
            &|| assert!(answer.off(Phase::at_rest(9.0), epsilon) > 1.0),
        ];
        for ask in asked {
            let panic = catch_unwind(AssertUnwindSafe(ask)).unwrap_err();
            let told = panic.downcast_ref::<String>().unwrap();
            assert!(told.contains("it must be at least 2⁻⁵³"), "{told}");
        }
    }
    let wrong = pendulum.compare(0.01, |_| vec![0.0]);
    assert_ne!(wrong, Comparison::Right);
}
