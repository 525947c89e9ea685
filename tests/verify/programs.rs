//! Programs of equal steps as their users write them: right ones, and wrong in one place.

use std::f64::consts::PI;
use std::fmt;
use std::io::Write;

/// (θ, ω).
pub type State = (f64, f64);
/// The states after 1, 2, … n steps of h (s), from g/L (1/s²) and the start.
pub type Program = fn(f64, f64, f64, f64, u64) -> Vec<State>;

/// n steps of one kind.
pub fn steps(theta: f64, omega: f64, n: u64, mut step: impl FnMut(State) -> State) -> Vec<State> {
    let mut z = (theta, omega);
    let next = |_| {
        z = step(z);
        z
    };
    (0..n).map(next).collect()
}

/// Kick, drift, kick.
pub fn leapfrog(g: f64, (theta, omega): State, h: f64) -> State {
    let omega = omega - 0.5 * h * g * theta.sin();
    let theta = theta + h * omega;
    (theta, omega - 0.5 * h * g * theta.sin())
}

pub fn verlet(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    steps(theta, omega, n, |z| leapfrog(g, z, h))
}

/// Kick, then drift.
pub fn kick_drift(g: f64, (theta, omega): State, h: f64) -> State {
    let omega = omega - h * g * theta.sin();
    (theta + h * omega, omega)
}

pub fn symplectic_euler(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    steps(theta, omega, n, |z| kick_drift(g, z, h))
}

pub fn forward_euler(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    steps(theta, omega, n, |(theta, omega)| (theta + h * omega, omega - h * g * theta.sin()))
}

/// An explicit Runge–Kutta step by the rows of its table, of a force of the angle.
pub fn runge_kutta(
    a: &[&[f64]],
    b: &[f64],
    force: impl Fn(f64) -> f64,
    (theta, omega): State,
    h: f64,
) -> State {
    let mut slopes: Vec<State> = Vec::new();
    let sum = |row: &[f64], slopes: &[State]| {
        row.iter()
            .zip(slopes)
            .fold((theta, omega), |at, (a, k)| (at.0 + h * a * k.0, at.1 + h * a * k.1))
    };
    for row in a {
        let at = sum(row, &slopes);
        slopes.push((at.1, force(at.0)));
    }
    sum(b, &slopes)
}

pub fn rk4(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    steps(theta, omega, n, |z| rk4_step(g, z, h))
}

// -------------------------------------------------------------------------------------------------
// Right ones
// -------------------------------------------------------------------------------------------------

/// Velocity Verlet with the angle from the top inside, φ = θ + π, where sin φ has the other sign.
pub fn from_the_top(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    let a = |phi: f64| g * phi.sin();
    let states = steps(theta + PI, omega, n, |(phi, omega)| {
        let next = phi + h * omega + 0.5 * h * h * a(phi);
        (next, omega + 0.5 * h * (a(phi) + a(next)))
    });
    states.into_iter().map(|(phi, omega)| (phi - PI, omega)).collect()
}

/// Position Verlet with the angle from the top inside, by the platform's cosine.
pub fn position_from_the_top(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    let states = steps(theta + 1.5 * PI, omega, n, |(phi, omega)| {
        let middle = phi + 0.5 * h * omega;
        let omega = omega - h * g * middle.cos();
        (middle + 0.5 * h * omega, omega)
    });
    states.into_iter().map(|(phi, omega)| (phi - 1.5 * PI, omega)).collect()
}

/// Störmer–Verlet in a frame that turns at 1 rad/s.
pub fn rotating_frame(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    turning(1.0, g, theta, omega, h, n)
}

/// And in one that turns at 50 rad/s, in which angles are ever larger.
pub fn fast_rotating_frame(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    turning(50.0, g, theta, omega, h, n)
}

fn turning(by: f64, g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    let mut t = 0.0;
    let mut z = (theta, omega - by);
    let mut states = Vec::new();
    for _ in 0..n {
        let half = z.1 - 0.5 * h * g * (z.0 + by * t).sin();
        let theta = z.0 + h * half;
        t += h;
        z = (theta, half - 0.5 * h * g * (theta + by * t).sin());
        states.push((z.0 + by * t, z.1 + by));
    }
    states
}

/// Tsitouras's coefficients, as published to 16 digits and more (Comput. Math. Appl. 62, 2011).
pub fn tsit5(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    let a: [&[f64]; 6] = [
        &[],
        &[0.161],
        &[-0.008480655492356989, 0.335480655492357],
        &[2.8971530571054935, -6.359448489975075, 4.3622954328695815],
        &[5.325864828439257, -11.748883564062828, 7.4955393428898365, -0.09249506636175525],
        &[
            5.86145544294642,
            -12.92096931784711,
            8.159367898576159,
            -0.071584973281401,
            -0.028269050394068383,
        ],
    ];
    let b = [
        0.09646076681806523,
        0.01,
        0.4798896504144996,
        1.379008574103742,
        -3.290069515436081,
        2.324710524099774,
    ];
    steps(theta, omega, n, |z| runge_kutta(&a, &b, |theta| -g * theta.sin(), z, h))
}

/// Gragg's modified midpoint rule extrapolated from 2, 4, 6 and 8 substeps: order 8.
pub fn gragg_8(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    let rate = |z: State| (z.1, -g * z.0.sin());
    let midpoint = |z: State, count: u32| {
        let part = h / f64::from(count);
        let k = rate(z);
        let (mut before, mut now) = (z, (z.0 + part * k.0, z.1 + part * k.1));
        for _ in 1..count {
            let k = rate(now);
            (before, now) = (now, (before.0 + 2.0 * part * k.0, before.1 + 2.0 * part * k.1));
        }
        let k = rate(now);
        (0.5 * (before.0 + now.0 + part * k.0), 0.5 * (before.1 + now.1 + part * k.1))
    };
    steps(theta, omega, n, |z| {
        let counts = [2_u32, 4, 6, 8];
        let mut row: Vec<State> = counts.iter().map(|count| midpoint(z, *count)).collect();
        for column in 1..4 {
            for k in (column..4).rev() {
                let ratio = f64::from(counts[k]) / f64::from(counts[k - column]);
                let by = 1.0 / (ratio * ratio - 1.0);
                let (now, above) = (row[k], row[k - 1]);
                row[k] = (now.0 + by * (now.0 - above.0), now.1 + by * (now.1 - above.1));
            }
        }
        row[3]
    })
}

/// Gautschi's method with Hairer and Lubich's filters about the one bottom at θ = 0:
/// θ₊ = cos(hω₀) θ + … + h²/2 sinc²(hω₀/2) (ω₀²θ − (g/L) sin θ).
pub fn gautschi(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    let frequency = g.sqrt();
    let sinc = |x: f64| if x == 0.0 { 1.0 } else { x.sin() / x };
    let x = frequency * h;
    let rest = |theta: f64| g * (theta - theta.sin());
    let psi = sinc(0.5 * x).powi(2);
    let (psi_0, psi_1) = (psi * x.cos() / sinc(x), psi / sinc(x));
    steps(theta, omega, n, |(theta, omega)| {
        let now = rest(theta);
        let next = x.cos() * theta + h * sinc(x) * omega + 0.5 * h * h * psi * now;
        let there = rest(next);
        let omega = -frequency * x.sin() * theta
            + x.cos() * omega
            + 0.5 * h * (psi_0 * now + psi_1 * there);
        (next, omega)
    })
}

/// The implicit midpoint rule by fixed-point iteration, ended when a change is below this.
pub fn midpoint_to(tolerance: f64, g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    steps(theta, omega, n, |z| {
        let mut next = z;
        for _ in 0..500 {
            let middle = (0.5 * (z.0 + next.0), 0.5 * (z.1 + next.1));
            let better = (z.0 + h * middle.1, z.1 - h * g * middle.0.sin());
            let change = (better.0 - next.0).abs().max((better.1 - next.1).abs());
            next = better;
            if change <= tolerance {
                break;
            }
        }
        next
    })
}

/// Forest and Ruth's method, each coefficient to so many decimals.
pub fn forest_ruth_to(decimals: i32, g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    let round = |x: f64| (x * 10f64.powi(decimals)).round() / 10f64.powi(decimals);
    let s = 1.0 / (2.0 - 2f64.cbrt());
    let c = [0.5 * s, 0.5 * (1.0 - s), 0.5 * (1.0 - s), 0.5 * s].map(round);
    let d = [s, 1.0 - 2.0 * s, s, 0.0].map(round);
    steps(theta, omega, n, |(mut theta, mut omega)| {
        for (c, d) in c.iter().zip(d) {
            theta += c * h * omega;
            omega -= d * h * g * theta.sin();
        }
        (theta, omega)
    })
}

/// A number as a program prints it, read again: so many significant digits.
pub fn digits(count: usize, x: f64) -> f64 {
    read_again(format_args!("{x:.*e}", count - 1))
}

/// The same with decimals.
pub fn decimals(count: usize, x: f64) -> f64 {
    read_again(format_args!("{x:.count$}"))
}

/// The number that is printed. It's printed where no memory is asked for, because millions are.
fn read_again(printed: fmt::Arguments<'_>) -> f64 {
    // As long as the largest number with 17 decimals.
    let mut text = [0; 330];
    let mut rest = &mut text[..];
    rest.write_fmt(printed).expect("there is room");
    let unused = rest.len();
    let text = str::from_utf8(&text[..text.len() - unused]).expect("digits");
    text.parse().expect("a number")
}

// -------------------------------------------------------------------------------------------------
// Others
// -------------------------------------------------------------------------------------------------

/// Deuflhard's method with its linear part about θ = 0 alone, as it stands in books.
pub fn deuflhard_about_one_bottom(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    let frequency = g.sqrt();
    let (sin, cos) = (frequency * h).sin_cos();
    let rest = |theta: f64| g * (theta - theta.sin());
    steps(theta, omega, n, |(theta, omega)| {
        let omega = omega + 0.5 * h * rest(theta);
        let turned = (cos * theta + sin / frequency * omega, cos * omega - frequency * sin * theta);
        (turned.0, turned.1 + 0.5 * h * rest(turned.0))
    })
}

/// RK4 with a force of the angle, from one state.
pub fn rk4_step(g: f64, z: State, h: f64) -> State {
    let (a, b): ([&[f64]; 4], _) = (
        [&[], &[0.5], &[0.0, 0.5], &[0.0, 0.0, 1.0]],
        [1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0],
    );
    runge_kutta(&a, &b, |theta| -g * theta.sin(), z, h)
}

/// What Adams and Bashforth's methods begin with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Begin {
    /// Slopes of zero before the start.
    Zero,
    /// Steps of forward Euler.
    Euler,
    /// Steps of RK4.
    Rk4,
}

/// Adams and Bashforth's method with these weights, the newest first.
pub fn adams(
    weights: &[f64],
    begin: Begin,
    g: f64,
    theta: f64,
    omega: f64,
    h: f64,
    n: u64,
) -> Vec<State> {
    let rate = |z: State| (z.1, -g * z.0.sin());
    let along = |z: State, k: State, h: f64| (z.0 + h * k.0, z.1 + h * k.1);
    let mut slopes: Vec<State> = match begin {
        Begin::Zero => vec![(0.0, 0.0); weights.len() - 1],
        _ => Vec::new(),
    };
    steps(theta, omega, n, |z| {
        slopes.push(rate(z));
        if slopes.len() < weights.len() {
            return match begin {
                Begin::Rk4 => rk4_step(g, z, h),
                _ => along(z, rate(z), h),
            };
        }
        let newest = slopes.iter().rev();
        newest.zip(weights).fold(z, |at, (k, w)| along(at, *k, h * w))
    })
}

pub const AB2: [f64; 2] = [1.5, -0.5];
pub const AB3: [f64; 3] = [23.0 / 12.0, -16.0 / 12.0, 5.0 / 12.0];
pub const AB5: [f64; 5] =
    [1901.0 / 720.0, -2774.0 / 720.0, 2616.0 / 720.0, -1274.0 / 720.0, 251.0 / 720.0];

/// What a program does to the states that it returns, the start among them.
pub fn handed_out(
    program: Program,
    change: impl Fn(&[State], usize) -> State,
) -> impl Fn(f64, f64, f64, f64, u64) -> Vec<State> {
    move |g, theta, omega, h, n| {
        let mut all = vec![(theta, omega)];
        all.extend(program(g, theta, omega, h, n));
        (1..all.len()).map(|k| change(&all, k)).collect()
    }
}

/// The sine from a table of `count` values a turn, with straight lines between them.
pub fn table_sine(count: usize, theta: f64) -> f64 {
    let place = theta.rem_euclid(2.0 * PI) / (2.0 * PI) * count as f64;
    let (k, part) = (place.floor(), place.fract());
    let at = |k: f64| (2.0 * PI * k / count as f64).sin();
    at(k) * (1.0 - part) + at(k + 1.0) * part
}

/// A number in half precision: eleven binary digits.
pub fn half_precision(x: f64) -> f64 {
    if x == 0.0 {
        return 0.0;
    }
    let power = 2f64.powi(10 - x.abs().log2().floor() as i32);
    (x * power).round() / power
}

/// As at random, by a count.
pub fn random(k: u64) -> f64 {
    let x = (k + 1)
        .wrapping_mul(6_364_136_223_846_793_005)
        .rotate_left(31)
        .wrapping_mul(0x9E37_79B9_7F4A_7C15);
    (x >> 11) as f64 / (1u64 << 53) as f64 - 0.5
}

/// Störmer–Verlet that is put to sleep, as game engines do: its velocity is 0 once it has been slow
/// near the bottom for thirty steps.
pub fn sleeping(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    let mut quiet = 0;
    steps(theta, omega, n, |z| {
        let (theta, omega) = leapfrog(g, z, h);
        quiet = if theta.abs() < 0.05 && omega.abs() < 0.01 { quiet + 1 } else { 0 };
        (theta, if quiet >= 30 { 0.0 } else { omega })
    })
}

/// García-Archilla, Sanz-Serna and Skeel's method about θ = 0: kicks by ψ = sinc² at φ = sinc of
/// the angle, and the exact linear motion.
pub fn filtered_about_one_bottom(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    let frequency = g.sqrt();
    let (sin, cos) = (frequency * h).sin_cos();
    let sinc = sin / (frequency * h);
    let rest = |theta: f64| sinc * g * (sinc * theta - (sinc * theta).sin());
    steps(theta, omega, n, |(theta, omega)| {
        let omega = omega + 0.5 * h * rest(theta);
        let turned = (cos * theta + sin / frequency * omega, cos * omega - frequency * sin * theta);
        (turned.0, turned.1 + 0.5 * h * rest(turned.0))
    })
}
