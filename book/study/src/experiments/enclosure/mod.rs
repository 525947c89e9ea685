//! A proved enclosure of a trajectory: bounds of the angle and the velocity between which the exact
//! motion lies, whatever the roundings.
//!
//! A step is a Taylor series with a remainder, in [`Interval`]s, after Löhner (*Einschließung der
//! Lösung gewöhnlicher Anfangs- und Randwertaufgaben und Anwendungen*, dissertation, Karlsruhe
//! 1988; Nedialkov, Jackson, Corliss, *Appl. Math. Comput.* 105 (1999) 21). What is known after it
//! is a parallelogram, not a box: a box about a turned and sheared box is larger, and a box about
//! that is larger again, and so on, exponentially.

mod interval;

pub use interval::Interval;
use pendula::{Motion, Pendulum, Phase};

use core::ops::{Add, Mul, Neg};

/// The step (s), a power of two: n steps take exactly n times as long.
pub const STEP: f64 = 0.125;
/// The highest power of the table's series. The motion from 1 rad is analytic for 0.70 s either
/// way, and (0.125/0.70)²⁵ is 2e-19.
pub const POWERS: usize = 24;

/// The shape in which a step hands its enclosure on to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// A rectangle, turned as the motion turns it.
    Turned,
    /// A rectangle along the axes.
    Box,
}

/// What is known of a state: it lies in both intervals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Known {
    /// The angle (rad).
    pub theta: Interval,
    /// The angular velocity (rad/s).
    pub omega: Interval,
}

impl Known {
    /// Whether `z` is possible.
    pub fn contains(&self, z: Phase) -> bool {
        self.theta.contains(z.theta.into()) && self.omega.contains(z.omega.into())
    }
}

/// A number of a series: an interval, or one with its derivatives.
trait Number: Copy + Add<Output = Self> + Mul<Output = Self> + Neg<Output = Self> {
    /// Times `factor`, a constant.
    fn times(self, factor: Interval) -> Self;
}

impl Number for Interval {
    fn times(self, factor: Interval) -> Self {
        self * factor
    }
}

/// A quantity and its derivatives by θ and ω at the start of the step.
#[derive(Clone, Copy, Debug)]
struct Dual {
    value: Interval,
    by: [Interval; 2],
}

impl Add for Dual {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let by = [self.by[0] + other.by[0], self.by[1] + other.by[1]];
        Self { value: self.value + other.value, by }
    }
}

impl Mul for Dual {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let values = [self.value, other.value];
        let by = [0, 1].map(|i| dot([other.by[i], self.by[i]], values));
        Self { value: self.value * other.value, by }
    }
}

impl Neg for Dual {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, by: self.by.map(Neg::neg) }
    }
}

impl Number for Dual {
    fn times(self, factor: Interval) -> Self {
        Self { value: self.value * factor, by: self.by.map(|by| by * factor) }
    }
}

/// The coefficients of the motion's power series in t, of θ and of ω, from 1 up to `powers`.
///
/// (k + 1) θₖ₊₁ = ωₖ, (k + 1) ωₖ₊₁ = −(g/L) sₖ, and from s' = cω and c' = −sω the sums for the sine
/// and the cosine.
fn series<N: Number>(g_over_l: Interval, start: [N; 4], powers: usize) -> Vec<[N; 2]> {
    let [theta, omega, sine, cosine] = start;
    let (mut angle, mut speed) = (vec![theta], vec![omega]);
    let (mut sines, mut cosines) = (vec![sine], vec![cosine]);
    for k in 0..powers {
        let over = Interval::from(1.0) / Interval::from((k + 1) as f64);
        let product = |waves: &[N]| {
            let terms = waves.iter().zip(speed.iter().rev()).map(|(wave, speed)| *wave * *speed);
            terms.reduce(|sum, term| sum + term).expect("a term").times(over)
        };
        let next = [product(&cosines), -product(&sines)];
        angle.push(speed[k].times(over));
        speed.push(-sines[k].times(g_over_l * over));
        sines.push(next[0]);
        cosines.push(next[1]);
    }
    angle.into_iter().zip(speed).map(<[N; 2]>::from).collect()
}

/// The series at the time [`STEP`], the highest power first.
fn at_the_end<N: Number>(coefficients: &[[N; 2]]) -> [N; 2] {
    let h = Interval::from(STEP);
    let last = *coefficients.last().expect("a series");
    let lower = coefficients.iter().rev().skip(1);
    lower.fold(last, |sum, next| [0, 1].map(|i| sum[i].times(h) + next[i]))
}

type Vector = [Interval; 2];
type Matrix = [[f64; 2]; 2];

/// A set of states: the middle plus the `shape` times what is in `rest`.
#[derive(Clone, Copy, Debug)]
struct Set {
    middle: [f64; 2],
    shape: Matrix,
    rest: Vector,
}

impl Set {
    /// The box about it, in which the middle lies: 0 is in the rest.
    fn hull(&self) -> Vector {
        [0, 1].map(|i| {
            let [a, b] = self.shape[i].map(Interval::from);
            Interval::from(self.middle[i]) + (a * self.rest[0] + b * self.rest[1])
        })
    }
}

/// The enclosures of all motions of `pendulum` from rest at an angle in `start` (rad, at most 3),
/// after each of `steps` steps, the start first, by series up to t to the power `powers`. The
/// pendulum is the one whose g/L is the f64 of [`Pendulum::frequency_squared`]. An enclosure that
/// is wider than a tenth is the last one.
pub fn enclosures(
    pendulum: &Pendulum,
    start: Interval,
    steps: usize,
    powers: usize,
    shape: Shape,
) -> Vec<Known> {
    let g_over_l = Interval::from(pendulum.frequency_squared());
    let start = Set {
        middle: [start.middle(), 0.0],
        shape: [[1.0, 0.0], [0.0, 1.0]],
        rest: [start - start.middle().into(), Interval::ZERO],
    };
    let sets = core::iter::successors(Some(start), |set| {
        let wide = set.hull().iter().any(|x| x.width() > 0.1);
        (!wide).then(|| step(g_over_l, set, powers, shape))
    });
    let known = |set: Set| {
        let [theta, omega] = set.hull();
        Known { theta, omega }
    };
    sets.take(steps + 1).map(known).collect()
}

/// One step, for every state of the set.
fn step(g_over_l: Interval, set: &Set, powers: usize, shape: Shape) -> Set {
    let waves = |[theta, omega]: Vector| {
        let (sine, cosine) = theta.sine_cosine();
        [theta, omega, sine, cosine]
    };
    let all = set.hull();
    // The series at the middle, and its remainder: the next coefficient at some time in the step.
    let middle = at_the_end(&series(g_over_l, waves(set.middle.map(Interval::from)), powers));
    let beyond = series(g_over_l, waves(during(g_over_l, all)), powers + 1)[powers + 1];
    let power = (0..=powers).fold(Interval::from(1.0), |power, _| power * Interval::from(STEP));
    let middle = [0, 1].map(|i| middle[i] + beyond[i] * power);
    // How the series' value moves with its start, somewhere in the set.
    let jacobian = at_the_end(&series(g_over_l, with_derivatives(waves(all)), powers));
    let turned = jacobian.map(|row| product(row.by, set.shape));
    // The next shape, and what is left in its coordinates.
    let shape = match shape {
        Shape::Turned => turn(turned.map(|row| row.map(Interval::middle)), set.rest),
        Shape::Box => [[1.0, 0.0], [0.0, 1.0]],
    };
    let next = middle.map(Interval::middle);
    let error = [0, 1].map(|i| middle[i] - Interval::from(next[i]));
    let inverse = inverse(shape);
    let rest = inverse.map(|row| {
        let moved = [0, 1].map(|j| row[0] * turned[0][j] + row[1] * turned[1][j]);
        dot(moved, set.rest) + dot(row, error)
    });
    Set { middle: next, shape, rest }
}

/// A box that no motion leaves that begins in `all`, within a step.
///
/// If all + [0, h] f(guess) lies in the guess, so does the motion (Picard's iteration maps the
/// curves within the guess into themselves).
fn during(g_over_l: Interval, all: Vector) -> Vector {
    let within = Interval::new(0.0, STEP);
    let picard = |guess: Vector| {
        let rate = [guess[1], -(g_over_l * guess[0].sine_cosine().0)];
        [0, 1].map(|i| all[i] + within * rate[i])
    };
    let mut guess = all;
    loop {
        let next = picard(guess);
        if (0..2).all(|i| guess[i].contains(next[i])) {
            return next;
        }
        // A little more than what is needed now.
        guess = [0, 1].map(|i| {
            let wider = next[i].hull(guess[i]);
            wider + Interval::about_zero(0.05 * wider.width())
        });
    }
}

/// The start of a series with derivatives: sin θ changes by cos θ, cos θ by −sin θ.
fn with_derivatives([theta, omega, sine, cosine]: [Interval; 4]) -> [Dual; 4] {
    let (zero, one) = (Interval::ZERO, Interval::from(1.0));
    [
        Dual { value: theta, by: [one, zero] },
        Dual { value: omega, by: [zero, one] },
        Dual { value: sine, by: [cosine, zero] },
        Dual { value: cosine, by: [-sine, zero] },
    ]
}

/// A right-angled frame along what `moved` makes of the longer side of the set (any frame is right;
/// this one is tight).
fn turn(moved: Matrix, rest: Vector) -> Matrix {
    let length = |j: usize| libm::hypot(moved[0][j], moved[1][j]) * rest[j].width();
    let long = if length(0) >= length(1) { 0 } else { 1 };
    let size = libm::hypot(moved[0][long], moved[1][long]);
    let (a, b) = (moved[0][long] / size, moved[1][long] / size);
    [[a, -b], [b, a]]
}

/// A matrix that contains the inverse.
fn inverse([[a, b], [c, d]]: Matrix) -> [Vector; 2] {
    let [a, b, c, d] = [a, b, c, d].map(Interval::from);
    let determinant = a * d - b * c;
    [[d, -b], [-c, a]].map(|row| row.map(|x| x / determinant))
}

fn product(row: Vector, matrix: Matrix) -> Vector {
    [0, 1].map(|j| dot(row, [matrix[0][j], matrix[1][j]].map(Interval::from)))
}

fn dot(a: Vector, b: Vector) -> Interval {
    a[0] * b[0] + a[1] * b[1]
}

/// The angle of release (rad) of the table.
pub const THETA_0: f64 = 1.0;
/// The times (s) of the table's rows, whole numbers of steps.
pub const TIMES: [u32; 6] = [1, 2, 5, 10, 20, 50];

/// The digits that both ends of `x` begin with: those of every number in it.
pub fn proved_digits(x: Interval) -> String {
    // Forty decimals, of which all are the number's own.
    let [low, high] = [x.low, x.high].map(|end| format!("{end:.40}"));
    let common = low.chars().zip(high.chars()).take_while(|(a, b)| a == b);
    common.map(|(digit, _)| digit).collect::<String>().replace('-', "−") + "…"
}

/// A row of the table.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// The time (s).
    pub time: u32,
    /// What is proved of the state.
    pub known: Known,
    /// The library's closed form.
    pub closed_form: Phase,
}

/// What is known of the paper's pendulum from rest at [`THETA_0`], at each of [`TIMES`].
pub fn run() -> Vec<Row> {
    let pendulum = Pendulum::PAPER;
    let steps = |time: u32| (f64::from(time) / STEP) as usize;
    let all =
        enclosures(&pendulum, THETA_0.into(), steps(TIMES[TIMES.len() - 1]), POWERS, Shape::Turned);
    let motion = Motion::new(&pendulum, Phase::at_rest(THETA_0)).expect("a finite start");
    let row = |time: u32| {
        let closed_form = motion.at(f64::from(time));
        Row { time, known: all[steps(time)], closed_form }
    };
    TIMES.into_iter().map(row).collect()
}

/// Pairs of the time (s) and the width of the angle's bounds (rad), over the last row's time, in
/// steps of a quarter of a second.
pub fn widths(shape: Shape) -> Vec<(f64, f64)> {
    let last = f64::from(TIMES[TIMES.len() - 1]);
    let all = enclosures(&Pendulum::PAPER, THETA_0.into(), (last / STEP) as usize, POWERS, shape);
    let at = |(n, known): (usize, Known)| (n as f64 * STEP, known.theta.width());
    all.into_iter().enumerate().skip(2).step_by(2).map(at).collect()
}
