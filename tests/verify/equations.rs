//! Programs whose equation, units or output are wrong, as people write them: what the judge says.

use std::f64::consts::{PI, TAU};

use pendula::Phase;
use pendula_judge::{
    Claims, Departure, Fault, FromFn, Integrator, Kind, Reply, Report, Request, Verdict, judge,
    try_judge,
};
use rstest::rstest;

use crate::programs::{Program, State, decimals, digits, steps, verlet};

/// Symplectic Euler, kick and then drift, with a force of the angle and the velocity.
fn euler(theta: f64, omega: f64, h: f64, n: u64, force: impl Fn(f64, f64) -> f64) -> Vec<State> {
    steps(theta, omega, n, |(theta, omega)| {
        let omega = omega + h * force(theta, omega);
        (theta + h * omega, omega)
    })
}

fn right(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    euler(theta, omega, h, n, |theta, _| -g * theta.sin())
}

fn linear(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    euler(theta, omega, h, n, |theta, _| -g * theta)
}

fn degrees_in(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    euler(theta, omega, h, n, |theta, _| -g * theta.to_radians().sin())
}

fn degrees_out(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    let states = right(g, theta, omega, h, n).into_iter();
    states.map(|(theta, omega)| (theta.to_degrees(), omega.to_degrees())).collect()
}

fn friction(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    euler(theta, omega, h, n, |theta, omega| -g * theta.sin() - 0.1 * omega)
}

fn fixed_g(_: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    right(9.81, theta, omega, h, n)
}

fn fixed_step(g: f64, theta: f64, omega: f64, _: f64, n: u64) -> Vec<State> {
    right(g, theta, omega, 0.01, n)
}

fn upside_down(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    right(-g, theta, omega, h, n)
}

fn rod(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    right(1.5 * g, theta, omega, h, n)
}

fn wrapped(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    let states = right(g, theta, omega, h, n).into_iter();
    states.map(|(theta, omega)| (theta.sin().atan2(theta.cos()), omega)).collect()
}

fn wrapped_state(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    steps(theta, omega, n, |(theta, omega)| {
        let omega = omega - h * g * theta.sin();
        ((theta + h * omega + PI).rem_euclid(TAU) - PI, omega)
    })
}

fn drag_each_step(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    steps(theta, omega, n, |(theta, omega)| {
        let omega = 0.999 * (omega - h * g * theta.sin());
        (theta + h * omega, omega)
    })
}

/// A point of a rope, as games have them: the last position for the velocity, in single precision,
/// in which a thousandth of the velocity is hardly more than rounding.
fn rope(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    let (mut x, mut old) = (theta as f32, (theta - omega * h) as f32);
    let mut step = |_| {
        let force = (-g * f64::from(x).sin()) as f32;
        (x, old) = (x + ((x - old) * 0.999 + force * h as f32 * h as f32), x);
        (f64::from(x), f64::from(x - old) / h)
    };
    (0..n).map(&mut step).collect()
}

fn divides(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    steps(theta, omega, n, |(theta, omega)| (theta + omega / h, omega - g * theta.sin() / h))
}

fn step_squared(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    steps(theta, omega, n, |(theta, omega)| {
        let a = -g * theta.sin();
        (theta + h * omega + h * h / 2.0 * a, omega + h * h * a)
    })
}

/// Velocity Verlet with `0*5` where 0.5 was meant.
fn no_kick(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    steps(theta, omega, n, |(theta, omega)| {
        let a = -g * theta.sin();
        let next = theta + h * omega + 0.5 * h * h * a;
        (next, omega + 0.0 * 5.0 * (a - g * next.sin()) * h)
    })
}

fn row_late(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    let states = right(g, theta, omega, h, n).into_iter();
    [(theta, omega)].into_iter().chain(states).take(n as usize).collect()
}

fn six_decimals(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    let states = verlet(g, theta, omega, h, n).into_iter();
    states.map(|(theta, omega)| (decimals(6, theta), decimals(6, omega))).collect()
}

/// Position Verlet of two positions, its velocity from the last two.
fn backward_velocity(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    let mut before = theta - h * omega - h * h / 2.0 * g * theta.sin();
    let mut now = theta;
    (0..n)
        .map(|_| {
            (before, now) = (now, 2.0 * now - before - h * h * g * now.sin());
            (now, (now - before) / h)
        })
        .collect()
}

fn rk4_first_order(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    let a = |theta: f64| -g * theta.sin();
    steps(theta, omega, n, |(theta, omega)| {
        let k1 = h * a(theta);
        let k2 = h * a(theta + k1 / 2.0);
        let k3 = h * a(theta + k2 / 2.0);
        let k4 = h * a(theta + k3);
        let omega = omega + (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0;
        (theta + h * omega, omega)
    })
}

fn rk4_time_added(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    let a = |theta: f64| -g * theta.sin();
    steps(theta, omega, n, |(theta, omega)| {
        let omega = omega + h * (a(theta) + 4.0 * a(theta + h / 2.0) + a(theta + h)) / 6.0;
        (theta + h * omega, omega)
    })
}

/// What the judge says of the equation, the output and the name.
fn told(report: &Report) -> String {
    let kind = report.departure.as_ref().map_or("nothing", |found| found.kind().name());
    let mut lines = vec![kind.to_string()];
    lines.extend(report.look_at().iter().map(|line| format!("• {line}")));
    lines.push(format!("What it is: {}.", report.what_it_is()));
    lines.push(report.summary());
    lines.join("\n")
}

/// Each program with one mistake that is made and reported in public.
///
/// Catches: a mistake reported as one of another kind, or not at all.
#[rstest]
#[case::linear(linear, Some(Kind::Force))]
#[case::degrees_in(degrees_in, Some(Kind::SineOfDegrees))]
#[case::degrees_out(degrees_out, Some(Kind::DegreesOut))]
#[case::friction(friction, Some(Kind::Damping))]
#[case::fixed_g(fixed_g, Some(Kind::FixedGravity))]
#[case::fixed_step(fixed_step, Some(Kind::FixedStep))]
#[case::upside_down(upside_down, Some(Kind::Sign))]
#[case::rod(rod, Some(Kind::Gravity))]
#[case::wrapped(wrapped, Some(Kind::Wrapped))]
#[case::wrapped_state(wrapped_state, Some(Kind::Wrapped))]
#[case::drag_each_step(drag_each_step, Some(Kind::DragEachStep))]
#[case::divides(divides, Some(Kind::DividedByStep))]
#[case::step_squared(step_squared, Some(Kind::SquaredStep))]
#[case::no_kick(no_kick, Some(Kind::NoKick))]
#[case::row_late(row_late, Some(Kind::RowsLate))]
#[case::six_decimals(six_decimals, Some(Kind::Decimals))]
#[case::backward_velocity(backward_velocity, None)]
#[case::rk4_first_order(rk4_first_order, Some(Kind::Units))]
#[case::rk4_time_added(rk4_time_added, Some(Kind::Units))]
fn each_mistake_is_told(#[case] program: Program, #[case] kind: Option<Kind>) {
    let report = judge(&FromFn(program), Claims::order(1));
    assert_eq!(report.verdict, Verdict::Fails, "{report}");
    assert_eq!(report.departure.as_ref().map(Departure::kind), kind, "{report}");
}

/// What is said of them, to the word: `equations.txt`.
///
/// Catches: a sentence that is another one, or has other numbers; two names in one report.
#[test]
fn the_sentences_are_these() {
    let programs: [(&str, Program); 19] = [
        ("linear", linear),
        ("degrees_in", degrees_in),
        ("degrees_out", degrees_out),
        ("friction", friction),
        ("fixed_g", fixed_g),
        ("fixed_step", fixed_step),
        ("upside_down", upside_down),
        ("rod", rod),
        ("wrapped", wrapped),
        ("wrapped_state", wrapped_state),
        ("drag_each_step", drag_each_step),
        ("divides", divides),
        ("step_squared", step_squared),
        ("no_kick", no_kick),
        ("row_late", row_late),
        ("six_decimals", six_decimals),
        ("backward_velocity", backward_velocity),
        ("rk4_first_order", rk4_first_order),
        ("rk4_time_added", rk4_time_added),
    ];
    let said = programs.map(|(name, program)| {
        format!("{name}: {}\n", told(&judge(&FromFn(program), Claims::order(1))))
    });
    crate::assert_text("equations.txt", &said.join("\n"));
}

// -------------------------------------------------------------------------------------------------
// Programs at random
// -------------------------------------------------------------------------------------------------

/// How many programs of each sort are judged: `PENDULA_PROGRAMS=1000` for more than those that a
/// test has time for.
fn programs() -> u64 {
    std::env::var("PENDULA_PROGRAMS").ok().and_then(|text| text.parse().ok()).unwrap_or(40)
}

/// Numbers as at random, the same in each run: Knuth's linear congruences, *The Art of Computer
/// Programming* 2, 3.3.4, table 1, line 26.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn below(&mut self, n: usize) -> usize {
        (self.next() * n as f64) as usize
    }

    fn of<T: Copy>(&mut self, all: &[T]) -> T {
        all[self.below(all.len())]
    }

    fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * self.next()
    }
}

/// Methods as a beginner writes them, for a force of angle and velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Method {
    Forward,
    KickDrift,
    DriftKick,
    Verlet,
    PositionVerlet,
    Midpoint,
    Heun,
    Rk4,
}

const ALL: [Method; 8] = [
    Method::Forward,
    Method::KickDrift,
    Method::DriftKick,
    Method::Verlet,
    Method::PositionVerlet,
    Method::Midpoint,
    Method::Heun,
    Method::Rk4,
];

impl Method {
    /// Its name in the known answers.
    const fn name(self) -> &'static str {
        match self {
            Self::Forward => "forward-euler",
            Self::KickDrift => "symplectic-euler",
            Self::DriftKick => "symplectic-euler-drift-first",
            Self::Verlet => "stormer-verlet",
            Self::PositionVerlet => "position-verlet",
            Self::Midpoint => "explicit-midpoint",
            Self::Heun => "heun",
            Self::Rk4 => "rk4",
        }
    }

    const fn order(self) -> u32 {
        match self {
            Self::Forward | Self::KickDrift | Self::DriftKick => 1,
            Self::Rk4 => 4,
            _ => 2,
        }
    }

    /// A step by the rate of the angle and the force.
    fn step(
        self,
        (theta, omega): State,
        h: f64,
        rate: &dyn Fn(f64, f64) -> f64,
        force: &dyn Fn(f64, f64) -> f64,
    ) -> State {
        let both = |(theta, omega): State| (rate(theta, omega), force(theta, omega));
        let along = |z: State, (a, b): State, h: f64| (z.0 + h * a, z.1 + h * b);
        let z = (theta, omega);
        match self {
            Self::Forward => along(z, both(z), h),
            Self::KickDrift => {
                let omega = omega + h * force(theta, omega);
                (theta + h * rate(theta, omega), omega)
            }
            Self::DriftKick => {
                let theta = theta + h * rate(theta, omega);
                (theta, omega + h * force(theta, omega))
            }
            Self::Verlet => {
                let omega = omega + 0.5 * h * force(theta, omega);
                let theta = theta + h * rate(theta, omega);
                (theta, omega + 0.5 * h * force(theta, omega))
            }
            Self::PositionVerlet => {
                let theta = theta + 0.5 * h * rate(theta, omega);
                let omega = omega + h * force(theta, omega);
                (theta + 0.5 * h * rate(theta, omega), omega)
            }
            Self::Midpoint => along(z, both(along(z, both(z), 0.5 * h)), h),
            Self::Heun => {
                let (k1, k2) = (both(z), both(along(z, both(z), h)));
                along(z, (0.5 * (k1.0 + k2.0), 0.5 * (k1.1 + k2.1)), h)
            }
            Self::Rk4 => {
                let k1 = both(z);
                let k2 = both(along(z, k1, 0.5 * h));
                let k3 = both(along(z, k2, 0.5 * h));
                let k4 = both(along(z, k3, h));
                let mean = |a: f64, b: f64, c: f64, d: f64| (a + 2.0 * b + 2.0 * c + d) / 6.0;
                along(z, (mean(k1.0, k2.0, k3.0, k4.0), mean(k1.1, k2.1, k3.1, k4.1)), h)
            }
        }
    }
}

/// How a program computes and prints.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Numbers {
    Double,
    /// States in single precision.
    Single,
    /// So many significant digits are printed.
    Digits(usize),
    /// So many decimals.
    Decimals(usize),
}

impl Numbers {
    fn of_a_step(self, (theta, omega): State) -> State {
        match self {
            Self::Single => (f64::from(theta as f32), f64::from(omega as f32)),
            _ => (theta, omega),
        }
    }

    fn printed(self, (theta, omega): State) -> State {
        let print = |x: f64| match self {
            Self::Digits(count) => digits(count, x),
            Self::Decimals(count) => decimals(count, x),
            _ => x,
        };
        (print(theta), print(omega))
    }
}

/// A right program is told nothing of an equation, and has its own name or none.
///
/// Catches: an equation or an output that is found where none is; a name beyond what the digits
/// tell.
#[test]
fn right_programs_are_told_nothing_false() {
    let mut random = Random(1);
    let numbers = [
        Numbers::Double,
        Numbers::Single,
        Numbers::Digits(12),
        Numbers::Digits(9),
        Numbers::Digits(6),
        Numbers::Digits(4),
        Numbers::Decimals(9),
        Numbers::Decimals(6),
        Numbers::Decimals(4),
    ];
    // These are judged in all properties, and take longer than wrong ones.
    let count = programs() / 3;
    let mut named = 0;
    let mut wrong = Vec::new();
    for _ in 0..count {
        let (method, numbers) = (random.of(&ALL), random.of(&numbers));
        let length = random.between(0.1, 20.0);
        let run = |g_over_l: f64, theta: f64, omega: f64, h: f64, n: u64| {
            // As a program that has g and L, and an adapter that is told g/L.
            let g = g_over_l * length;
            let states = steps(theta, omega, n, |z| {
                let force = |theta: f64, _: f64| -g / length * theta.sin();
                numbers.of_a_step(method.step(z, h, &|_, omega| omega, &force))
            });
            states.into_iter().map(|z| numbers.printed(z)).collect::<Vec<_>>()
        };
        let report = judge(&FromFn(run), Claims::order(method.order()));
        let kind = report.departure.as_ref().map(Departure::kind);
        let cut_off = matches!(numbers, Numbers::Digits(_) | Numbers::Decimals(_));
        let nothing = match kind {
            None => true,
            Some(Kind::Digits | Kind::Decimals) => cut_off,
            Some(_) => false,
        };
        let name = report.identity.as_ref().map(|identity| identity.method);
        named += usize::from(name == Some(method.name()));
        let its_own = name.is_none_or(|name| name == method.name());
        if !nothing || !its_own || report.resembles.is_some() || report.mistake.is_some() {
            wrong.push(format!("{method:?} {numbers:?} {length}: {}", told(&report)));
        }
    }
    println!("{named} of {count} are named");
    assert!(wrong.is_empty(), "{} of {count}:\n{}", wrong.len(), wrong.join("\n"));
}

/// A run of g/L (1/s²), the start, h (s) and n.
type Run = Box<dyn Fn(f64, f64, f64, f64, u64) -> Vec<State>>;

/// A wrong program at random.
struct Wrong {
    what: String,
    kind: Kind,
    run: Run,
}

/// How many sorts there are.
const SORTS: usize = 37;

fn wrong_program(random: &mut Random, which: usize, method: Method, numbers: Numbers) -> Wrong {
    let made = |kind: Kind,
                what: String,
                step: Box<dyn Fn(f64, State, f64) -> State>,
                handed_out: Box<dyn Fn(State) -> State>| {
        let what = format!("{what}, {method:?}, {numbers:?}");
        let run = move |g: f64, theta: f64, omega: f64, h: f64, n: u64| {
            let states = steps(theta, omega, n, |z| numbers.of_a_step(step(g, z, h)));
            states.into_iter().map(&handed_out).collect()
        };
        Wrong { what, kind, run: Box::new(run) }
    };
    let as_it_is = || -> Box<dyn Fn(State) -> State> { Box::new(|z| z) };
    // A right method on another force.
    let with_force = |kind: Kind, what: String, force: Box<dyn Fn(f64, f64, f64) -> f64>| {
        let step = move |g: f64, z: State, h: f64| {
            method.step(z, h, &|_, omega| omega, &|theta, omega| force(g, theta, omega))
        };
        made(kind, what, Box::new(step), as_it_is())
    };
    let right_step = move |g: f64, z: State, h: f64| {
        method.step(z, h, &|_, omega| omega, &|theta, _| -g * theta.sin())
    };
    let with_output = |kind: Kind, what: String, handed_out: Box<dyn Fn(State) -> State>| {
        made(kind, what, Box::new(right_step), handed_out)
    };
    // A right method that takes and returns otherwise.
    match which {
        0 => with_force(Kind::Force, "θ".into(), Box::new(|g, t, _| -g * t)),
        1 => with_force(Kind::Force, "cos θ".into(), Box::new(|g, t, _| -g * t.cos())),
        2 => with_force(
            Kind::Force,
            "sin θ cos θ".into(),
            Box::new(|g, t, _| -g * t.sin() * t.cos()),
        ),
        3 => with_force(Kind::Force, "tan θ".into(), Box::new(|g, t, _| -g * t.tan())),
        4 => with_force(
            Kind::Force,
            "θ − θ³/6".into(),
            Box::new(|g, t, _| -g * (t - t.powi(3) / 6.0)),
        ),
        5 => with_force(
            Kind::SineOfDegrees,
            "degrees".into(),
            Box::new(|g, t, _| -g * t.to_radians().sin()),
        ),
        6 => with_force(Kind::Sign, "sign".into(), Box::new(|g, t, _| g * t.sin())),
        7 => {
            let times = random.of(&[1.5, 2.0, 0.5, 2.0 / 3.0, 9.8 / 9.81, 1.0 / 9.81]);
            with_force(
                Kind::Gravity,
                format!("{times} g/L"),
                Box::new(move |g, t, _| -times * g * t.sin()),
            )
        }
        8 => {
            with_force(Kind::GravityPower, "√(g/L)".into(), Box::new(|g, t, _| -g.sqrt() * t.sin()))
        }
        9 => {
            let own = random.of(&[9.81, 9.8, 1.0, 4.905]);
            with_force(
                Kind::FixedGravity,
                format!("g/L = {own}"),
                Box::new(move |_, t, _| -own * t.sin()),
            )
        }
        10 => {
            let by = random.of(&[0.05, 0.1, 0.25, 0.5]);
            with_force(
                Kind::Damping,
                format!("−{by} ω"),
                Box::new(move |g, t, w| -g * t.sin() - by * w),
            )
        }
        11 => {
            let by = random.of(&[0.05, 0.1, 0.5]);
            with_force(
                Kind::QuadraticDamping,
                format!("−{by} ω|ω|"),
                Box::new(move |g, t, w| -g * t.sin() - by * w * w.abs()),
            )
        }
        12 => {
            let left = random.of(&[0.9, 0.99, 0.995, 0.999]);
            let step = move |g: f64, z: State, h: f64| {
                let (theta, omega) = right_step(g, z, h);
                (theta, left * omega)
            };
            made(Kind::DragEachStep, format!("{left} ω a step"), Box::new(step), as_it_is())
        }
        13 => {
            let own = random.of(&[0.01, 0.001, 0.02, 1.0 / 60.0]);
            let step = move |g: f64, z: State, _: f64| right_step(g, z, own);
            made(Kind::FixedStep, format!("h = {own}"), Box::new(step), as_it_is())
        }
        14 => {
            let times = random.of(&[0.001, 1000.0, 0.5, 3.0, -1.0]);
            let step = move |g: f64, z: State, h: f64| right_step(g, z, times * h);
            made(Kind::Step, format!("{times} h"), Box::new(step), as_it_is())
        }
        15 => {
            let (drift, kick) = random.of(&[(true, true), (true, false), (false, true)]);
            let step = move |g: f64, (theta, omega): State, h: f64| {
                let by = |divides: bool| if divides { 1.0 / h } else { h };
                let omega_then = omega - by(kick) * g * theta.sin();
                (theta + by(drift) * omega, omega_then)
            };
            made(Kind::DividedByStep, format!("/h {drift} {kick}"), Box::new(step), as_it_is())
        }
        16 => {
            let kick = random.of(&[true, false]);
            let step = move |g: f64, (theta, omega): State, h: f64| {
                let (a, b) = if kick { (h, h * h) } else { (h * h, h) };
                let omega = omega - b * g * theta.sin();
                (theta + a * omega, omega)
            };
            made(Kind::SquaredStep, format!("h² {kick}"), Box::new(step), as_it_is())
        }
        17 => {
            let step = move |_: f64, (theta, omega): State, h: f64| (theta + h * omega, omega);
            made(Kind::NoKick, "no kick".into(), Box::new(step), as_it_is())
        }
        18 => {
            let step =
                move |g: f64, (theta, omega): State, h: f64| (theta, omega - h * g * theta.sin());
            made(Kind::NoDrift, "no drift".into(), Box::new(step), as_it_is())
        }
        19 => with_output(
            Kind::DegreesOut,
            "degrees out".into(),
            Box::new(|(t, w)| (t.to_degrees(), w.to_degrees())),
        ),
        20 => with_output(
            Kind::DegreesOut,
            "angle in degrees out".into(),
            Box::new(|(t, w)| (t.to_degrees(), w)),
        ),
        21 => with_output(Kind::Swapped, "swapped".into(), Box::new(|(t, w)| (w, t))),
        22 => with_output(
            Kind::Wrapped,
            "(−π, π]".into(),
            Box::new(|(t, w)| (t.sin().atan2(t.cos()), w)),
        ),
        23 => {
            with_output(Kind::Wrapped, "[0, 2π)".into(), Box::new(|(t, w)| (t.rem_euclid(TAU), w)))
        }
        24 => {
            let step = move |g: f64, z: State, h: f64| {
                let a = |theta: f64| -g * theta.sin();
                let k1 = h * a(z.0);
                let k2 = h * a(z.0 + k1 / 2.0);
                let k3 = h * a(z.0 + k2 / 2.0);
                let k4 = h * a(z.0 + k3);
                let omega = z.1 + (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0;
                (z.0 + h * omega, omega)
            };
            made(Kind::Units, "RK4 of first order".into(), Box::new(step), as_it_is())
        }
        25 => {
            let step = move |g: f64, z: State, h: f64| {
                let a = |theta: f64| -g * theta.sin();
                let k1 = h * a(z.0);
                let omega = z.1 + h * a(z.0 + k1 / 2.0);
                (z.0 + h * z.1, omega)
            };
            made(Kind::Units, "midpoint of first order".into(), Box::new(step), as_it_is())
        }
        26 => {
            let step = move |g: f64, z: State, h: f64| {
                let a = |theta: f64| -g * theta.sin();
                let omega = z.1 + h * (a(z.0) + 4.0 * a(z.0 + h / 2.0) + a(z.0 + h)) / 6.0;
                (z.0 + h * omega, omega)
            };
            made(Kind::Units, "time added".into(), Box::new(step), as_it_is())
        }
        27 => with_force(
            Kind::Values,
            "another force".into(),
            Box::new(|g, t, _| -g * t.sin() * (1.0 + 0.1 * t * t)),
        ),
        28 => {
            let run = move |g: f64, theta: f64, omega: f64, h: f64, n: u64| {
                let states = steps(theta, omega, n, |z| numbers.of_a_step(right_step(g, z, h)));
                [(theta, omega)].into_iter().chain(states).take(n as usize).collect()
            };
            let what = format!("late, {method:?}, {numbers:?}");
            Wrong { what, kind: Kind::RowsLate, run: Box::new(run) }
        }
        29 => {
            let run = move |g: f64, theta: f64, omega: f64, h: f64, n: u64| {
                let states = steps(theta, omega, n + 1, |z| numbers.of_a_step(right_step(g, z, h)));
                states.into_iter().skip(1).collect()
            };
            let what = format!("early, {method:?}, {numbers:?}");
            Wrong { what, kind: Kind::RowsEarly, run: Box::new(run) }
        }
        30 => {
            let run = move |g: f64, theta: f64, omega: f64, h: f64, n: u64| {
                let (theta, omega) = (theta.to_radians(), omega.to_radians());
                steps(theta, omega, n, |z| numbers.of_a_step(right_step(g, z, h)))
            };
            let what = format!("start in degrees, {method:?}, {numbers:?}");
            Wrong { what, kind: Kind::DegreesIn, run: Box::new(run) }
        }
        31 => {
            let run = move |g: f64, theta: f64, omega: f64, h: f64, n: u64| {
                let (theta, omega) = (theta.to_radians(), omega.to_radians());
                let states = steps(theta, omega, n, |z| numbers.of_a_step(right_step(g, z, h)));
                states.into_iter().map(|(t, w)| (t.to_degrees(), w.to_degrees())).collect()
            };
            let what = format!("all in degrees, {method:?}, {numbers:?}");
            Wrong { what, kind: Kind::DegreesInAndOut, run: Box::new(run) }
        }
        32 => {
            let run = move |g: f64, theta: f64, omega: f64, h: f64, n: u64| {
                let states = steps(omega, theta, n, |z| numbers.of_a_step(right_step(g, z, h)));
                states.into_iter().map(|(t, w)| (w, t)).collect()
            };
            let what = format!("swapped in and out, {method:?}, {numbers:?}");
            Wrong { what, kind: Kind::Swapped, run: Box::new(run) }
        }
        33 => {
            let by = random.of(&[0.1, 0.5, 1.0]);
            with_force(
                Kind::Torque,
                format!("torque {by}"),
                Box::new(move |g, t, _| -g * t.sin() + by),
            )
        }
        34 => {
            let digits = random.of(&[4, 6, 8]);
            let kind = random.of(&[Kind::Digits, Kind::Decimals]);
            let as_printed = match kind {
                Kind::Digits => Numbers::Digits(digits),
                _ => Numbers::Decimals(digits),
            };
            with_output(kind, format!("{as_printed:?}"), Box::new(move |z| as_printed.printed(z)))
        }
        35 => {
            let step = move |g: f64, (theta, omega): State, h: f64| {
                let omega = omega - g * theta.sin();
                (theta + h * omega, omega)
            };
            made(Kind::WithoutStep, "a kick without h".into(), Box::new(step), as_it_is())
        }
        _ => {
            let times = random.of(&[0.5, 2.0]);
            with_force(Kind::Force, format!("{times} θ"), Box::new(move |g, t, _| -times * g * t))
        }
    }
}

/// A wrong program is told its kind, and nothing that is false.
///
/// Catches: a kind that is not told, or told of another.
#[test]
fn wrong_programs_are_told_their_kind() {
    let mut random = Random(2);
    let (mut right, mut untold, mut false_kind) = (0, Vec::new(), Vec::new());
    for k in 0..programs() {
        let method = random.of(&ALL);
        let numbers = random.of(&[Numbers::Double, Numbers::Double, Numbers::Single]);
        let which = k as usize % SORTS;
        let Wrong { what, kind, run } = wrong_program(&mut random, which, method, numbers);
        let report = judge(&FromFn(run), Claims::order(1));
        let found = report.departure.as_ref().map(Departure::kind);
        if found == Some(kind) {
            right += 1;
        } else if matches!(found, None | Some(Kind::Values)) {
            untold.push(format!("{what}: {}", told(&report)));
        } else {
            false_kind.push(format!("{what}: {}", told(&report)));
        }
    }
    println!("{right} of {} are told right\nnot told:\n{}", programs(), untold.join("\n"));
    assert!(false_kind.is_empty(), "told falsely:\n{}", false_kind.join("\n"));
    assert!(right * 100 >= programs() * 95, "{right} of {}", programs());
}

/// Each sort on two methods, once in single precision.
///
/// Catches: a sort that is told on one method alone, or in double precision alone.
#[rstest]
fn each_sort_is_told(#[values(0, 1, 2, 3, 4, 5)] part: usize) {
    let mut random = Random(3);
    let programs = [(Method::KickDrift, Numbers::Double), (Method::Rk4, Numbers::Single)];
    for which in (0..SORTS).filter(|which| which % 6 == part) {
        for (method, numbers) in programs {
            let Wrong { what, kind, run } = wrong_program(&mut random, which, method, numbers);
            let report = judge(&FromFn(run), Claims::order(1));
            let found = report.departure.as_ref().map(Departure::kind);
            assert_eq!(found, Some(kind), "{what}: {report}");
        }
    }
}

// -------------------------------------------------------------------------------------------------
// What single steps from one pendulum cannot tell
// -------------------------------------------------------------------------------------------------

fn saturated(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    euler(theta, omega, h, n, |theta, _| -g * theta.clamp(-1.0, 1.0))
}

fn half_of_both(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    right(g, theta, omega, h, n).into_iter().map(|(a, b)| (0.5 * a, 0.5 * b)).collect()
}

fn velocity_taken_for_a_tenth(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    right(g, theta, 0.1 * omega, h, n)
}

fn late_and_linear(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    let states = linear(g, theta, omega, h, n).into_iter();
    [(theta, omega)].into_iter().chain(states).take(n as usize).collect()
}

fn damped_with_its_frequency(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    euler(theta, omega, h, n, |theta, omega| -g * theta.sin() - 0.1 * g.sqrt() * omega)
}

fn pushed_with_its_gravity(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    euler(theta, omega, h, n, |theta, _| -g * (theta.sin() - 0.1))
}

fn pushed_to_and_fro(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    let mut z = (theta, omega);
    (0..n)
        .map(|k| {
            let omega = z.1 + h * (0.3 * (k as f64 * h).cos() - g * z.0.sin());
            z = (z.0 + h * omega, omega);
            z
        })
        .collect()
}

fn linear_near_the_bottom(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    euler(
        theta,
        omega,
        h,
        n,
        |theta, _| {
            if theta.abs() < 0.3 { -g * theta } else { -g * theta.sin() }
        },
    )
}

fn ten_seconds(g: f64, theta: f64, omega: f64, _: f64, n: u64) -> Vec<State> {
    right(g, theta, omega, 10.0 / n as f64, n)
}

/// Catches: a mistake named since one of its answers is met; a number that holds at one g/L handed
/// on for all; a factor of what is taken told of what is returned; what acts at t = 0 taken for
/// what acts always; an equation behind another output that is not looked for.
#[rstest]
#[case::saturated(
    saturated,
    Kind::Values,
    "It solves another equation: at θ = 1 rad and ω = 0 the force is −12.26, not −10.32 1/s²"
)]
#[case::half_of_both(
    half_of_both,
    Kind::Scaled,
    "At g/L = 12.2625 1/s² it returns 0.5 times the angle and the velocity"
)]
#[case::velocity_taken_for_a_tenth(
    velocity_taken_for_a_tenth,
    Kind::Scaled,
    "At g/L = 12.2625 1/s² it takes the start for 0.1 times the velocity"
)]
#[case::late_and_linear(
    late_and_linear,
    Kind::Force,
    "It solves θ̈ = −(g/L) θ: the angle stands in place of its sine"
)]
#[case::damped_with_its_frequency(
    damped_with_its_frequency,
    Kind::Damping,
    "It solves another pendulum: ω is damped at a rate of 0.1 √(g/L)"
)]
#[case::pushed_with_its_gravity(
    pushed_with_its_gravity,
    Kind::Torque,
    "It solves another pendulum: a torque of 0.1 (g/L) acts on the pendulum"
)]
#[case::pushed_to_and_fro(
    pushed_to_and_fro,
    Kind::Values,
    "The force depends on the time, or on what was before: in the first step a torque of 0.3 1/s² \
     acts on the pendulum"
)]
#[case::linear_near_the_bottom(
    linear_near_the_bottom,
    Kind::Values,
    "It solves another equation: at θ = 0.15 rad and ω = 4.9 rad/s the force is −1.8394, not \
     −1.8325 1/s²"
)]
#[case::rope(
    rope,
    Kind::Values,
    "However short a step is, it leads from (−0.1 rad, −5.2527 rad/s) to (−0.1 rad, −5.2474 rad/s)"
)]
#[case::ten_seconds(
    ten_seconds,
    Kind::FixedStep,
    "A run takes 10 s, however many steps of whatever length are asked for"
)]
fn no_more_is_told_than_is_found(
    #[case] program: Program,
    #[case] kind: Kind,
    #[case] sentence: &str,
) {
    let report = judge(&FromFn(program), Claims::order(1));
    let found = report.departure.as_ref().unwrap_or_else(|| panic!("{report}"));
    assert_eq!((found.kind(), found.sentence().as_str()), (kind, sentence), "{report}");
    let of_another = |line: &String| line.contains("known mistake in") && kind != Kind::Force;
    assert!(!report.look_at().iter().any(of_another), "{report}");
}

/// A program that ends, as many do, where its numbers are too large.
struct Ending(Program);

impl Integrator for Ending {
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        let reply = FromFn(self.0).answer(request)?;
        let large = |z: &Phase| !(z.theta.abs() < 30.0 && z.omega.abs() < 30.0);
        match reply.states.iter().any(large) && request.start.theta.abs() < 10.0 {
            true => Err(Fault::Broken("OverflowError".to_string())),
            false => Ok(reply),
        }
    }
}

fn series(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    euler(theta, omega, h, n, |theta, _| -g * (theta - theta.powi(3) / 6.0))
}

/// Catches: an equation that is found and lost, since the program breaks off where a property is
/// measured; a right program that breaks off taken for one that was judged.
#[test]
fn a_program_that_breaks_off_is_told_its_equation() {
    let report = judge(&Ending(series), Claims::order(1));
    let found = report.departure.as_ref().map(Departure::kind);
    assert_eq!((found, report.verdict), (Some(Kind::Force), Verdict::Fails), "{report}");
    assert!(report.look_at()[1].starts_with("It broke off: "), "{report}");
    let of_a_right_one = try_judge(&Ending(right), Claims::order(1));
    assert_eq!(of_a_right_one.err(), Some(Fault::Broken("OverflowError".to_string())));
}

/// A program that refuses angles beyond half a turn, steps back and long ones.
struct Refusing(Program);

impl Integrator for Refusing {
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        let long = !(0.0..0.1).contains(&request.step);
        if long || request.start.theta.abs() > PI {
            return Err(Fault::Refused("not here".to_string()));
        }
        FromFn(self.0).answer(request)
    }
}

/// Catches: an equation that is not told of a program which refuses some of what it is asked.
#[test]
fn a_program_that_refuses_is_told_its_equation() {
    let report = judge(&Refusing(friction), Claims::order(1));
    let found = report.departure.as_ref().map(|found| (found.kind(), found.values()));
    assert_eq!(found, Some((Kind::Damping, vec![0.1])), "{report}");
    let report = judge(&Refusing(right), Claims::order(1));
    assert!(report.departure.is_none(), "{report}");
}

/// Catches: a kind that the schema of the report does not have, or one that is none.
#[test]
fn the_schema_has_every_kind() {
    let schema = include_str!("../../book/judge/src/report.schema.json");
    let schema: serde_json::Value = serde_json::from_str(schema).expect("it is JSON");
    let kinds = &schema["properties"]["departure"]["anyOf"][1]["properties"]["kind"]["enum"];
    let kinds: Vec<&str> =
        kinds.as_array().expect("a list").iter().filter_map(|kind| kind.as_str()).collect();
    let own: Vec<&str> = Kind::ALL.iter().map(|kind| kind.name()).collect();
    assert_eq!(kinds, own);
}
