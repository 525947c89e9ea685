//! What the judge says is to be looked at, of programs that commit exactly one mistake, and of
//! right ones.

use std::cell::RefCell;
use std::collections::HashMap;

use pendula::Phase;
use pendula_judge::{
    Claims, Fault, Integrator, Property, Reply, Request, Verdict, judge, known_answers,
};
use rstest::rstest;

/// A run as a user would write it, with the drive's force at the times that it likes: the states
/// after 1, 2, … n steps.
pub type Run = fn(Force<'_>, Phase, f64, u64) -> Vec<Phase>;

/// The force at a time and an angle.
pub type Force<'a> = &'a dyn Fn(f64, f64) -> f64;

/// A run as an integrator that can be driven.
pub struct Driven {
    pub run: Run,
    /// What it takes g/L for, by what it is told.
    pub g_over_l: fn(f64) -> f64,
}

impl Integrator for Driven {
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        let g = (self.g_over_l)(request.g_over_l);
        let force = |t: f64, theta: f64| {
            let drive = request.drive.map_or(0.0, |d| d.amplitude * (d.frequency * t).cos());
            drive - g * theta.sin()
        };
        let all = (self.run)(&force, request.start, request.step, request.steps);
        let every = request.every as usize;
        let states = all.into_iter().skip(every - 1).step_by(every).collect();
        Ok(Reply { states, evaluations: None })
    }
}

/// n steps, each a function of the time.
fn steps(z: Phase, h: f64, n: u64, step: impl Fn(f64, Phase) -> Phase) -> Vec<Phase> {
    let mut z = z;
    (0..n)
        .map(|k| {
            z = step(k as f64 * h, z);
            z
        })
        .collect()
}

/// Kick, drift, kick, with these parts of h.
fn kicks(force: Force<'_>, z: Phase, h: f64, n: u64, [first, second]: [f64; 2]) -> Vec<Phase> {
    steps(z, h, n, |t, Phase { theta, omega }| {
        let omega = omega + first * h * force(t, theta);
        let theta = theta + h * omega;
        Phase { theta, omega: omega + second * h * force(t + h, theta) }
    })
}

fn verlet(force: Force<'_>, z: Phase, h: f64, n: u64) -> Vec<Phase> {
    kicks(force, z, h, n, [0.5, 0.5])
}

/// A Runge–Kutta method of four stages, whose times are its nodes times `share`.
fn runge_kutta(
    force: Force<'_>,
    z: Phase,
    h: f64,
    n: u64,
    (a, b, share): ([[f64; 4]; 4], [f64; 4], f64),
) -> Vec<Phase> {
    steps(z, h, n, |t, z| {
        let mut slopes = [Phase::default(); 4];
        for i in 0..4 {
            let at = (0..i).fold(z, |at, j| at + slopes[j] * (h * a[i][j]));
            let node: f64 = a[i][..i].iter().sum();
            slopes[i] = Phase { theta: at.omega, omega: force(t + share * node * h, at.theta) };
        }
        (0..4).fold(z, |at, i| at + slopes[i] * (h * b[i]))
    })
}

const RK4_A: [[f64; 4]; 4] =
    [[0.0; 4], [0.5, 0.0, 0.0, 0.0], [0.0, 0.5, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
const RK4_B: [f64; 4] = [1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0];

pub fn rk4(force: Force<'_>, z: Phase, h: f64, n: u64) -> Vec<Phase> {
    runge_kutta(force, z, h, n, (RK4_A, RK4_B, 1.0))
}

pub fn three_eighths(force: Force<'_>, z: Phase, h: f64, n: u64) -> Vec<Phase> {
    let third = 1.0 / 3.0;
    let a = [[0.0; 4], [third, 0.0, 0.0, 0.0], [-third, 1.0, 0.0, 0.0], [1.0, -1.0, 1.0, 0.0]];
    runge_kutta(force, z, h, n, (a, [0.125, 0.375, 0.375, 0.125], 1.0))
}

pub fn ralston(force: Force<'_>, z: Phase, h: f64, n: u64) -> Vec<Phase> {
    let a = [[0.0; 4], [2.0 / 3.0, 0.0, 0.0, 0.0], [0.0; 4], [0.0; 4]];
    runge_kutta(force, z, h, n, (a, [0.25, 0.75, 0.0, 0.0], 1.0))
}

/// Forest and Ruth's method with the middle kick's coefficient as it is, or rounded.
fn forest_ruth(force: Force<'_>, z: Phase, h: f64, n: u64, digits: Option<i32>) -> Vec<Phase> {
    let exact = 1.0 / (2.0 - 2.0_f64.cbrt());
    let outer = digits.map_or(exact, |digits| {
        let power = 10.0_f64.powi(digits);
        (exact * power).round() / power
    });
    let parts = [outer, 1.0 - 2.0 * outer, outer];
    steps(z, h, n, |t, z| {
        let mut t = t;
        parts.iter().fold(z, |z, part| {
            let end = verlet(&|s, theta| force(t + s, theta), z, part * h, 1)[0];
            t += part * h;
            end
        })
    })
}

fn right_forest_ruth(f: Force<'_>, z: Phase, h: f64, n: u64) -> Vec<Phase> {
    forest_ruth(f, z, h, n, None)
}

pub fn told(g_over_l: f64) -> f64 {
    g_over_l
}

fn leapfrog() -> Claims {
    Claims::order(2).symplectic().symmetric()
}

fn a_truncated_coefficient(f: Force<'_>, z: Phase, h: f64, n: u64) -> Vec<Phase> {
    runge_kutta(f, z, h, n, (RK4_A, [0.1667, 0.3333, 0.3333, 0.1667], 1.0))
}

fn a_missing_first_half_kick(f: Force<'_>, z: Phase, h: f64, n: u64) -> Vec<Phase> {
    steps(z, h, n, |t, z| {
        let theta = z.theta + h * z.omega;
        Phase { theta, omega: z.omega + h * f(t + h, theta) }
    })
}

fn velocities_at_half_steps(f: Force<'_>, z: Phase, h: f64, n: u64) -> Vec<Phase> {
    let begun = Phase { omega: z.omega + 0.5 * h * f(0.0, z.theta), ..z };
    let mut t = 0.0;
    let mut first = true;
    let mut z = begun;
    (0..n)
        .map(|_| {
            if !first {
                z.omega += h * f(t, z.theta);
            }
            first = false;
            z.theta += h * z.omega;
            t += h;
            z
        })
        .collect()
}

fn angles_at_half_steps(f: Force<'_>, z: Phase, h: f64, n: u64) -> Vec<Phase> {
    let ahead = |z: Phase| Phase { theta: z.theta + 0.5 * h * z.omega, ..z };
    verlet(f, z, h, n).into_iter().map(ahead).collect()
}

fn the_old_force_in_the_second_kick(f: Force<'_>, z: Phase, h: f64, n: u64) -> Vec<Phase> {
    steps(z, h, n, |t, z| {
        let old = f(t, z.theta);
        let omega = z.omega + 0.5 * h * old;
        Phase { theta: z.theta + h * omega, omega: omega + 0.5 * h * old }
    })
}

fn the_fourth_stage_from_the_second_slope(f: Force<'_>, z: Phase, h: f64, n: u64) -> Vec<Phase> {
    let mut a = RK4_A;
    a[3] = [0.0, 1.0, 0.0, 0.0];
    runge_kutta(f, z, h, n, (a, RK4_B, 1.0))
}

pub fn the_drive_at_the_steps_start(f: Force<'_>, z: Phase, h: f64, n: u64) -> Vec<Phase> {
    runge_kutta(f, z, h, n, (RK4_A, RK4_B, 0.0))
}

fn a_kick_in_the_fifth_digit(f: Force<'_>, z: Phase, h: f64, n: u64) -> Vec<Phase> {
    kicks(f, z, h, n, [0.50001, 0.5])
}

fn a_kick_missing_in_each_step(f: Force<'_>, z: Phase, h: f64, n: u64) -> Vec<Phase> {
    kicks(f, z, h, n, [0.0, 0.5])
}

fn a_step_of_another_length(f: Force<'_>, z: Phase, h: f64, n: u64) -> Vec<Phase> {
    rk4(f, z, 1.001 * h, n)
}

fn backwards(f: Force<'_>, z: Phase, h: f64, n: u64) -> Vec<Phase> {
    rk4(f, z, -h, n)
}

fn a_commutator_left(f: Force<'_>, z: Phase, h: f64, n: u64) -> Vec<Phase> {
    kicks(f, z, h, n, [1.0 / 3.0, 2.0 / 3.0])
}

fn a_splitting_of_few_digits(f: Force<'_>, z: Phase, h: f64, n: u64) -> Vec<Phase> {
    forest_ruth(f, z, h, n, Some(4))
}

fn single_precision(f: Force<'_>, z: Phase, h: f64, n: u64) -> Vec<Phase> {
    steps(z, h, n, |t, z| {
        let z = verlet(&|s, theta| f(t + s, theta), z, h, 1)[0];
        Phase { theta: f64::from(z.theta as f32), omega: f64::from(z.omega as f32) }
    })
}

/// Each case: the run, g/L, the claims, what fails, and how the first sentences begin, with a bar
/// between them.
///
/// Catches: a cause that is not told, told of another mistake, or with a wrong number.
#[rstest]
// RK4 with 0.1667 and 0.3333: Σ b a c = 0.3333 · 1/4 + 0.1667 · 1/2 = 0.166675.
#[case::a_truncated_coefficient(
    a_truncated_coefficient, told,
    Claims::order(4), &["order"],
    "This is the known mistake rk4-weights-to-four-digits of rk4: .1667 and .3333 for 1/6 and 1/3 \
     (order 2, small at first). This explains the failures in order and stage-times.|A \
     coefficient has too few digits, about 4: Σ bᵢ aᵢⱼ cⱼ is 0.166675, not 1/6.",
)]
#[case::g_over_l_of_another_place(
    verlet, |g| g * 9.8 / 9.81, leapfrog(), &["order"],
    "It is Störmer–Verlet, but the force acts as if g/L were 0.99898 times as large",
)]
#[case::g_over_l_that_does_not_listen(
    verlet, |_| 9.8, leapfrog(), &["order", "units"],
    "It is Störmer–Verlet, but its g/L is 9.8 1/s², whatever is asked for.",
)]
#[case::a_missing_first_half_kick(
    a_missing_first_half_kick, told,
    leapfrog(), &["order", "reversal"],
    "It is the other symplectic Euler, which is Störmer–Verlet with states that lie half a kick \
     ahead",
)]
#[case::velocities_at_half_steps(
    velocities_at_half_steps, told,
    leapfrog(), &["order", "reversal", "clock"],
    "This is the known mistake stormer-verlet-velocity-at-the-half-step of stormer-verlet: ",
)]
#[case::angles_at_half_steps(
    angles_at_half_steps, told,
    leapfrog(), &["order", "reversal"],
    "It is Störmer–Verlet, but the states that it reports lie half a drift ahead, compared with \
     those it computes.",
)]
#[case::the_old_force_in_the_second_kick(
    the_old_force_in_the_second_kick, told,
    leapfrog(), &["order", "area", "reversal"],
    "This is the known mistake stormer-verlet-old-force-twice of stormer-verlet: the second half \
     kick uses the force before the drift; also: symplectic Euler with the mean of both velocities \
     (order 1, energy grows; seen in oxiphysics-gpu 0.1.2",
)]
// Σ b a c² = 1/3 · 1/2 · 1/4 + 1/6 · 1 · 1/4, with the fourth stage at z + h k₂.
#[case::the_fourth_stage_from_the_second_slope(
    the_fourth_stage_from_the_second_slope, told,
    Claims::order(4), &["order"],
    "This is the known mistake rk4-fourth-stage-from-second-slope of rk4: k4 is built on k2, not \
     on k3 (order 3). This explains the failure in order.|Its order is 3, not 4: the error of a \
     step begins with h⁴, where Σ bᵢ aᵢⱼ aⱼₖ cₖ is 0, not 1/24",
)]
#[case::the_drive_at_the_steps_start(
    the_drive_at_the_steps_start, told,
    Claims::order(4), &["stage-times"],
    "This is the known mistake rk4-times-at-the-start of rk4: |Only with a drive is the order 1",
)]
#[case::a_kick_in_the_fifth_digit(
    a_kick_in_the_fifth_digit, told,
    leapfrog(), &["order", "reversal"],
    "It solves another equation: the force acts as if g/L were 1.00001 times as large; a \
     coefficient, or g or L, is right to only 5 digits",
)]
#[case::a_kick_missing_in_each_step(
    a_kick_missing_in_each_step, told,
    leapfrog(), &["order", "reversal"],
    "It is Störmer–Verlet, but each step lacks its first half kick.",
)]
#[case::a_step_of_another_length(
    a_step_of_another_length, told, Claims::order(4), &["order"],
    "It is RK4, but its step is 1.001 h; a coefficient, or g or L, is right to only 3 digits",
)]
#[case::backwards(
    backwards, told, Claims::order(4), &["order"],
    "It is RK4, but run backwards.",
)]
#[case::a_commutator_left(
    a_commutator_left, told,
    leapfrog(), &["order", "reversal"],
    "This is the known mistake stormer-verlet-thirds of stormer-verlet: kicks of one third and two \
     thirds (order 1; seen in this book's zoo).",
)]
#[case::a_splitting_of_few_digits(
    a_splitting_of_few_digits, told,
    Claims::order(4).symplectic().symmetric(), &["stage-times"],
    "This is the known mistake forest-ruth-five-digits of forest-ruth: |A coefficient has too few \
     digits, about 4: the commutators [T, [T, V]] and [V, [T, V]] of drifts and kicks do not \
     cancel",
)]
#[case::single_precision(
    single_precision, told,
    Claims::order(2), &["precision"],
    "A step rounds by ",
)]
fn the_cause_is_told(
    #[case] run: Run,
    #[case] g_over_l: fn(f64) -> f64,
    #[case] claims: Claims,
    #[case] fails: &[&str],
    #[case] first: &str,
) {
    let report = judge(&Driven { run, g_over_l }, claims);
    assert_eq!(report.verdict, Verdict::Fails, "{report}");
    for name in fails {
        assert!(report.failures().any(|failed| failed.name() == *name), "{name}: {report}");
    }
    assert!(report.look_at().len() >= first.split('|').count(), "{report}");
    for (told, begins) in report.look_at().iter().zip(first.split('|')) {
        assert!(told.starts_with(begins), "{report}");
    }
    assert!(report.look_at().len() <= 3, "{report}");
}

/// Catches: a right method of which something is said to be looked at.
#[rstest]
#[case::verlet(verlet, leapfrog())]
#[case::rk4(rk4, Claims::order(4))]
#[case::three_eighths(three_eighths, Claims::order(4))]
#[case::ralston(ralston, Claims::order(2))]
#[case::forest_ruth(
    right_forest_ruth, Claims::order(4).symplectic().symmetric(),
)]
fn of_a_right_program_nothing_is_told(#[case] run: Run, #[case] claims: Claims) {
    let report = judge(&Driven { run, g_over_l: told }, claims);
    assert_eq!((report.verdict, &report.look_at()[..]), (Verdict::Holds, &[][..]), "{report}");
}

/// Catches: several causes told of one, or a failure that is said to follow from two.
#[test]
fn each_failure_follows_from_one_cause() {
    let run = Driven { run: a_kick_missing_in_each_step, g_over_l: told };
    let report = judge(&run, leapfrog());
    let told = report.look_at().concat();
    // The sentence on the equation is itself what is said of it.
    for name in report.failures().filter(|name| *name != Property::Equation) {
        assert_eq!(told.matches(name.name()).count(), 1, "{name}: {report}");
    }
}

/// An integrator that is asked the same by each judge and runs once.
struct Remembered<S>(S, RefCell<HashMap<String, Reply>>);

impl<S: Integrator> Integrator for Remembered<S> {
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        let known = self.1.borrow().get(&request.to_string()).cloned();
        known.map_or_else(|| self.0.answer(request), Ok).inspect(|reply| {
            self.1.borrow_mut().entry(request.to_string()).or_insert_with(|| reply.clone());
        })
    }
}

/// RK4 with states in single precision.
fn rk4_in_single_precision(f: Force<'_>, z: Phase, h: f64, n: u64) -> Vec<Phase> {
    steps(z, h, n, |t, z| {
        let z = rk4(&|s, theta| f(t + s, theta), z, h, 1)[0];
        Phase { theta: f64::from(z.theta as f32), omega: f64::from(z.omega as f32) }
    })
}

/// In single precision some methods, of large coefficients and so of large tolerances, allow for
/// the steps of RK4; but these are a thousand times as near to its own.
///
/// Catches: a name that is given for its large tolerance; a right program refused its own.
#[test]
fn of_the_methods_that_fit_it_is_the_one_that_is_near() {
    let integrator = Driven { run: rk4_in_single_precision, g_over_l: told };
    let integrator = Remembered(integrator, RefCell::default());
    let names = known_answers::methods().iter().map(|known| known.name.as_str());
    let holds = |name: &&str| {
        let report = judge(&integrator, Claims::none().name(*name));
        report.finding(Property::Name).is_some_and(|finding| finding.verdict == Verdict::Holds)
    };
    let fit: Vec<&str> = names.filter(holds).collect();
    assert_eq!(fit, ["rk4"]);
}
