//! The known methods and mistakes, taken from their tables step by step.

use std::cell::Cell;
use std::sync::LazyLock;

use super::packed::{A_THETA, B_THETA, NAMES as NAMES_OF_ALL, OLD_FORCE, Packed, TIMES, WRONG};
use super::report::Force;

/// θ̈ = -k f(θ) - c ω + a cos Ωt + b sin Ωt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equation {
    /// f.
    pub force: Force,
    /// k.
    pub k: f64,
    /// c.
    pub c: f64,
    /// a, b and Ω.
    pub drive: [f64; 3],
}

impl Equation {
    /// The acceleration.
    #[inline]
    pub fn acceleration(&self, t: f64, theta: f64, omega: f64) -> f64 {
        let [a, b, frequency] = self.drive;
        let free = -self.k * self.force.at(theta) - self.c * omega;
        if frequency == 0.0 {
            return free;
        }
        free + a * libm::cos(frequency * t) + b * libm::sin(frequency * t)
    }

    /// How fast it changes at most (1/s).
    pub fn rate(&self) -> f64 {
        let rate = libm::sqrt(self.k.abs()) * self.force.stiffness();
        libm::fmax(rate, libm::fmax(self.drive[2], self.c.abs()))
    }
}

impl Force {
    /// What programs have.
    pub const USUAL: [Self; 2] = [Self::Sine, Self::Linear];
    /// What else is looked for, where nothing is found with those.
    pub const OTHERS: [Self; 4] = [Self::Cubic, Self::Cosine, Self::SineCosine, Self::Degrees];

    /// f(θ).
    #[inline]
    pub fn at(self, theta: f64) -> f64 {
        match self {
            Self::Sine => libm::sin(theta),
            Self::Linear => theta,
            Self::Cubic => theta - theta * theta * theta / 6.0,
            Self::Cosine => libm::cos(theta),
            Self::SineCosine => libm::sin(theta) * libm::cos(theta),
            Self::Degrees => libm::sin(theta.to_radians()),
        }
    }

    fn stiffness(self) -> f64 {
        if self == Self::Degrees { 0.14 } else { 1.0 }
    }
}

/// A method or a mistake of the tables.
#[derive(Debug)]
pub struct Candidate {
    /// Its name among the known answers.
    pub name: &'static str,
    /// Whether it is a method of the known answers, not a mistake.
    pub right: bool,
    kind: Kind,
    /// How much the sums of a step may magnify the rounding of one number.
    pub weight: f64,
    /// How many forces a step takes, about.
    cost: u64,
}

thread_local! {
    static WORK: Cell<u64> = const { Cell::new(0) };
}

/// How many forces were computed, about, by this thread.
pub fn work() -> u64 {
    WORK.get()
}

#[derive(Debug)]
enum Kind {
    RungeKutta(Stages),
    Nystrom(Stages),
    Splitting { moves: Vec<Move>, old_force: bool, gradients: bool, timed: bool },
    Multistep { values: Vec<f64>, explicit: Vec<f64>, implicit: Vec<f64> },
    Formula { lines: Vec<(usize, Vec<Word>)>, damped: bool },
}

#[derive(Debug)]
struct Stages {
    explicit: bool,
    /// When a stage is computed, in steps: its own time where a mistake has another.
    times: Vec<f64>,
    c: Vec<f64>,
    a: Vec<Vec<f64>>,
    a_theta: Option<Vec<Vec<f64>>>,
    b: Vec<f64>,
    b_theta: Vec<f64>,
    /// Whether the times are not those of the stages.
    otherwise_timed: bool,
}

#[derive(Clone, Copy, Debug)]
enum Move {
    Drift(f64),
    Kick { length: f64, at: f64, gradient: f64 },
}

#[derive(Clone, Copy, Debug)]
enum Word {
    Number(f64),
    Name(usize),
    Force,
    Plus,
    Minus,
    Times,
    Over,
}

const MOST_STAGES: usize = 40;
/// Of a formula: q, p, h, c, theta and omega, and those that it makes.
const MOST_NAMES: usize = 32;

/// A state, and when it is.
pub type State = [f64; 2];

impl Candidate {
    /// Whether it is told apart only under a drive, from the method that it is made of.
    pub fn only_driven(&self) -> bool {
        match &self.kind {
            Kind::RungeKutta(stages) | Kind::Nystrom(stages) => stages.otherwise_timed,
            Kind::Splitting { timed, .. } => *timed,
            _ => false,
        }
    }

    /// Whether it can be taken on this equation.
    pub fn suits(&self, damped: bool, driven: bool) -> bool {
        match &self.kind {
            Kind::Splitting { gradients: true, .. } if damped || driven => false,
            // The drag of a formula is its own; without one it is a table as well.
            Kind::Formula { damped: own, .. } => *own == damped && !driven,
            _ => driven || !self.only_driven(),
        }
    }

    /// How many older states it needs beside the newest.
    pub fn older(&self) -> usize {
        match &self.kind {
            Kind::Multistep { values, explicit, implicit } => {
                values.len().max(explicit.len()).max(implicit.len().saturating_sub(1)).max(1) - 1
            }
            _ => 0,
        }
    }

    /// The state after so many steps.
    pub fn run(&self, equation: &Equation, t: f64, z: State, h: f64, steps: u32) -> State {
        let mut z = z;
        WORK.set(WORK.get() + u64::from(steps) * self.cost);
        for i in 0..steps {
            let now = t + h * f64::from(i);
            z = match &self.kind {
                Kind::RungeKutta(stages) => stages.runge_kutta(equation, now, z, h),
                Kind::Nystrom(stages) => stages.nystrom(equation, now, z, h),
                Kind::Splitting { moves, old_force, .. } => {
                    splitting(moves, *old_force, equation, now, z, h)
                }
                Kind::Formula { lines, .. } => formula(lines, equation, now, z, h),
                Kind::Multistep { .. } => [f64::NAN; 2],
            };
            // Beyond, a sine takes as long as a step.
            if !(z[0].abs() < 1e6 && z[1].abs() < 1e9) {
                return [f64::NAN; 2];
            }
        }
        z
    }

    /// A step of a multi-step method from older states, newest first.
    pub fn step_from(&self, equation: &Equation, t: f64, past: &[State], h: f64) -> State {
        let Kind::Multistep { values, explicit, implicit } = &self.kind else {
            return self.run(equation, t, past[0], h, 1);
        };
        let slopes: Vec<State> = (0..past.len())
            .map(|i| {
                let [q, p] = past[i];
                [p, equation.acceleration(t - h * i as f64, q, p)]
            })
            .collect();
        let sum = |weights: &[f64], of: &[State]| {
            let mut sum = [0.0; 2];
            for (w, z) in weights.iter().zip(of) {
                sum = [sum[0] + w * z[0], sum[1] + w * z[1]];
            }
            sum
        };
        let old = if values.is_empty() { past[0] } else { sum(values, past) };
        let add = |[a, b]: State, [x, y]: State| [a + h * x, b + h * y];
        let mut new = if explicit.is_empty() {
            add(past[0], slopes[0])
        } else {
            add(old, sum(explicit, &slopes))
        };
        let Some((first, rest)) = implicit.split_first() else { return new };
        let known = add(old, sum(rest, &slopes));
        // A corrector once after a predictor, otherwise until it is settled.
        let sweeps = if explicit.is_empty() { 60 } else { 1 };
        for _ in 0..sweeps {
            let slope = [new[1], equation.acceleration(t + h, new[0], new[1])];
            let better = add(known, [first * slope[0], first * slope[1]]);
            let near = |i: usize| (better[i] - new[i]).abs() <= f64::EPSILON * better[i].abs();
            let settled = near(0) && near(1);
            new = better;
            if settled {
                break;
            }
        }
        new
    }
}

fn dot(a: &[f64], x: &[f64]) -> f64 {
    a.iter().zip(x).map(|(a, x)| a * x).sum()
}

impl Stages {
    #[expect(clippy::needless_range_loop, reason = "a stage is a row of several arrays")]
    fn runge_kutta(&self, equation: &Equation, t: f64, [q, p]: State, h: f64) -> State {
        let size = self.c.len();
        let a_theta = self.a_theta.as_ref().unwrap_or(&self.a);
        let (mut v, mut f) = ([0.0; MOST_STAGES], [0.0; MOST_STAGES]);
        if self.explicit {
            for i in 0..size {
                let stage = q + h * dot(&a_theta[i], &v);
                v[i] = p + h * dot(&self.a[i], &f);
                f[i] = equation.acceleration(t + self.times[i] * h, stage, v[i]);
            }
        } else {
            let first = equation.acceleration(t, q, p);
            f[..size].fill(first);
            let scale = equation.k.abs() * (q.abs() + h.abs() * p.abs());
            let solved = settle(&mut f, size, scale, |f, new| {
                for i in 0..size {
                    v[i] = p + h * dot(&self.a[i], f);
                }
                for i in 0..size {
                    let stage = q + h * dot(&a_theta[i], &v);
                    new[i] = equation.acceleration(t + self.times[i] * h, stage, v[i]);
                }
            });
            if !solved {
                return [f64::NAN; 2];
            }
            for i in 0..size {
                v[i] = p + h * dot(&self.a[i], &f);
            }
        }
        [q + h * dot(&self.b_theta, &v), p + h * dot(&self.b, &f)]
    }

    /// Of a force with a drag each stage takes the velocity at the start of the step: Nyström's
    /// methods say nothing of it.
    fn nystrom(&self, equation: &Equation, t: f64, [q, p]: State, h: f64) -> State {
        let size = self.c.len();
        let mut f = [0.0; MOST_STAGES];
        let stage = |i: usize, f: &[f64]| {
            let angle = q + self.c[i] * h * p + h * h * dot(&self.a[i], f);
            equation.acceleration(t + self.times[i] * h, angle, p)
        };
        if self.explicit {
            for i in 0..size {
                f[i] = stage(i, &f);
            }
        } else {
            f[..size].fill(equation.acceleration(t, q, p));
            let scale = equation.k.abs() * (q.abs() + h.abs() * p.abs());
            if !settle(&mut f, size, scale, |f, new| {
                (0..size).for_each(|i| new[i] = stage(i, f));
            }) {
                return [f64::NAN; 2];
            }
        }
        [q + h * p + h * h * dot(&self.b_theta, &f), p + h * dot(&self.b, &f)]
    }
}

/// Improves the slopes until they are settled; false if they do not.
fn settle(
    f: &mut [f64; MOST_STAGES],
    size: usize,
    scale: f64,
    mut improve: impl FnMut(&[f64], &mut [f64; MOST_STAGES]),
) -> bool {
    let mut before = f64::INFINITY;
    for sweep in 0..80 {
        let mut new = [0.0; MOST_STAGES];
        improve(&f[..], &mut new);
        // Where the forces pass through zero, what they round is that of the angle.
        let largest = new[..size].iter().fold(scale, |a: f64, b| a.max(b.abs()));
        let change = (0..size).fold(0.0, |a: f64, i| a.max((new[i] - f[i]).abs()));
        *f = new;
        let small = change <= 4.0 * f64::EPSILON * largest;
        if change == 0.0 || (small && change >= before) || (small && sweep > 20) {
            return true;
        }
        if !change.is_finite() {
            return false;
        }
        before = change;
    }
    false
}

fn splitting(
    moves: &[Move],
    old_force: bool,
    equation: &Equation,
    t: f64,
    [mut q, mut p]: State,
    h: f64,
) -> State {
    let mut kicked: Option<f64> = None;
    for step in moves {
        match *step {
            Move::Drift(length) => q += length * h * p,
            Move::Kick { length, at, gradient } => {
                let mut force = equation.acceleration(t + at * h, q, p);
                if let Some(old) = kicked.filter(|_| old_force) {
                    force = old;
                }
                kicked = Some(force);
                if gradient != 0.0 {
                    // The derivative of the sine; of other forces by a difference.
                    let slope = match equation.force {
                        Force::Sine => libm::cos(q),
                        Force::Linear => 1.0,
                        other => (other.at(q + 1e-5) - other.at(q - 1e-5)) / 2e-5,
                    };
                    force *= 1.0 - gradient * h * h * equation.k * slope;
                }
                p += length * h * force;
            }
        }
    }
    [q, p]
}

fn formula(
    lines: &[(usize, Vec<Word>)],
    equation: &Equation,
    t: f64,
    [q, p]: State,
    h: f64,
) -> State {
    let mut names = [0.0; MOST_NAMES];
    names[..4].copy_from_slice(&[q, p, h, equation.c]);
    let mut stack = [0.0; 16];
    for (name, words) in lines {
        let mut top = 0;
        for word in words {
            match *word {
                Word::Number(x) => (stack[top], top) = (x, top + 1),
                Word::Name(i) => (stack[top], top) = (names[i], top + 1),
                Word::Force => {
                    let free = Equation { c: 0.0, ..*equation };
                    stack[top - 1] = free.acceleration(t, stack[top - 1], 0.0);
                }
                Word::Plus | Word::Minus | Word::Times | Word::Over => {
                    let (a, b) = (stack[top - 2], stack[top - 1]);
                    top -= 1;
                    stack[top - 1] = match word {
                        Word::Plus => a + b,
                        Word::Minus => a - b,
                        Word::Times => a * b,
                        _ => a / b,
                    };
                }
            }
        }
        names[*name] = stack[0];
    }
    [names[4], names[5]]
}

/// All candidates, in the order of the tables.
pub fn all() -> &'static [Candidate] {
    &ALL
}

/// The candidate of this name.
pub fn named(name: &str) -> Option<&'static Candidate> {
    ALL.iter().find(|candidate| candidate.name == name)
}

static ALL: LazyLock<Vec<Candidate>> = LazyLock::new(|| {
    let mut packed = Packed::new();
    NAMES_OF_ALL.lines().map(|name| candidate(name, &mut packed)).collect()
});

// What is read here is written by the build script, in this order.

fn candidate(name: &'static str, packed: &mut Packed) -> Candidate {
    let has = packed.whole();
    let kind = match packed.whole() {
        0 => Kind::RungeKutta(stages(packed, has)),
        1 => Kind::Nystrom(stages(packed, has)),
        2 => {
            let moves = packed.list(one_move);
            let gradient = |m: &Move| matches!(m, Move::Kick { gradient, .. } if *gradient != 0.0);
            let gradients = moves.iter().any(gradient);
            let [old_force, timed] = [OLD_FORCE, TIMES].map(|bit| has & bit != 0);
            Kind::Splitting { moves, old_force, gradients, timed }
        }
        3 => {
            let [values, explicit, implicit] = core::array::from_fn(|_| packed.numbers());
            Kind::Multistep { values, explicit, implicit }
        }
        _ => {
            let lines = packed.list(|packed| (packed.whole(), packed.list(word)));
            let drag = |word: &Word| matches!(word, Word::Name(3));
            let damped = lines.iter().any(|(_, words)| words.iter().any(drag));
            Kind::Formula { lines, damped }
        }
    };
    let weight = weight(&kind);
    let cost = match &kind {
        Kind::RungeKutta(stages) | Kind::Nystrom(stages) => {
            let size = stages.c.len() as u64;
            if stages.explicit { size } else { 12 * size }
        }
        Kind::Splitting { moves, .. } => moves.len() as u64,
        Kind::Multistep { .. } | Kind::Formula { .. } => 4,
    };
    Candidate { name, right: has & WRONG == 0, kind, weight, cost }
}

fn stages(packed: &mut Packed, has: usize) -> Stages {
    let mut c = packed.numbers();
    let a = packed.rows();
    let size = a.len();
    assert!(size <= MOST_STAGES, "{size} stages");
    let full = |mut row: Vec<f64>| {
        row.resize(size, 0.0);
        row
    };
    c = full(c);
    let b = full(packed.numbers());
    let a_theta = (has & A_THETA != 0).then(|| packed.rows());
    let b_theta = (has & B_THETA != 0).then(|| full(packed.numbers()));
    let times = (has & TIMES != 0).then(|| full(packed.numbers()));
    let explicit = |a: &[Vec<f64>]| a.iter().enumerate().all(|(i, row)| row.len() <= i);
    Stages {
        explicit: explicit(&a) && a_theta.as_deref().is_none_or(explicit),
        otherwise_timed: times.is_some(),
        times: times.unwrap_or_else(|| c.clone()),
        b_theta: b_theta.unwrap_or_else(|| b.clone()),
        c,
        a,
        a_theta,
        b,
    }
}

fn one_move(packed: &mut Packed) -> Move {
    match packed.whole() {
        1 => Move::Drift(packed.number()),
        _ => {
            let [length, at, gradient] = core::array::from_fn(|_| packed.number());
            Move::Kick { length, at, gradient }
        }
    }
}

fn word(packed: &mut Packed) -> Word {
    match packed.whole() {
        0 => Word::Force,
        1 => Word::Plus,
        2 => Word::Minus,
        3 => Word::Times,
        4 => Word::Over,
        5 => Word::Number(packed.number()),
        name => Word::Name(name - 6),
    }
}

/// The sum of the sizes of the coefficients: of a step's sums, and of the longest sum of a stage.
fn weight(kind: &Kind) -> f64 {
    let sum = |xs: &[f64]| xs.iter().map(|x| x.abs()).sum::<f64>();
    match kind {
        Kind::RungeKutta(stages) | Kind::Nystrom(stages) => {
            let longest = stages.a.iter().map(|row| sum(row)).fold(0.0, f64::max);
            sum(&stages.b) * (1.0 + longest) + sum(&stages.b_theta)
        }
        Kind::Splitting { moves, .. } => moves
            .iter()
            .map(|m| match m {
                Move::Drift(x) | Move::Kick { length: x, .. } => x.abs(),
            })
            .sum(),
        Kind::Multistep { values, explicit, implicit } => {
            sum(values) + sum(explicit) + sum(implicit)
        }
        Kind::Formula { lines, .. } => lines.len() as f64,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::known_answers;

    /// Catches: a coefficient that is packed or read back with another last bit, sign or place, an
    /// entry that is left out.
    #[test]
    fn what_is_packed_is_in_the_file_to_the_last_bit() {
        fn add(value: &serde_json::Value, numbers: &mut Vec<u64>) {
            match value.as_f64() {
                Some(x) => numbers.push(x.to_bits()),
                None => value.as_array().into_iter().flatten().for_each(|x| add(x, numbers)),
            }
        }
        let file = include_str!("../../known-answers/coefficients.json");
        let entries: Vec<serde_json::Value> = serde_json::from_str(file).unwrap();
        assert_eq!(entries.len(), all().len());
        for (entry, candidate) in entries.iter().zip(all()) {
            assert_eq!(entry["name"], candidate.name);
            assert_eq!(entry["wrong"] == true, !candidate.right, "{}", candidate.name);
            let mut expected = Vec::new();
            let read: Vec<f64> = match &candidate.kind {
                Kind::RungeKutta(stages) | Kind::Nystrom(stages) => {
                    let or =
                        |key: &'static str, other| if entry[key].is_null() { other } else { key };
                    let keys =
                        ["c", "a", "b", or("a_theta", "a"), or("b_theta", "b"), or("times", "c")];
                    keys.iter().for_each(|key| add(&entry[*key], &mut expected));
                    let Stages { times, c, a, a_theta, b, b_theta, .. } = stages;
                    let a_theta = a_theta.as_ref().unwrap_or(a);
                    [c, &a.concat(), b, &a_theta.concat(), b_theta, times].map(Vec::clone).concat()
                }
                Kind::Splitting { moves, .. } => {
                    add(&entry["moves"], &mut expected);
                    let numbers = |one: &Move| match *one {
                        Move::Drift(length) => vec![length],
                        Move::Kick { length, at, gradient } => vec![length, at, gradient],
                    };
                    moves.iter().flat_map(numbers).collect()
                }
                Kind::Multistep { values, explicit, implicit } => {
                    for key in ["values", "explicit", "implicit"] {
                        add(&entry[key], &mut expected);
                    }
                    [&values[..], explicit, implicit].concat()
                }
                Kind::Formula { lines, .. } => {
                    let words = entry["formula"].as_array().unwrap().iter();
                    let words = words.flat_map(|line| line.as_str().unwrap().split(' '));
                    let numbers =
                        words.filter_map(|word| Some(word.parse::<f64>().ok()?.to_bits()));
                    expected.extend(numbers);
                    let number = |word: &Word| match *word {
                        Word::Number(x) => Some(x),
                        _ => None,
                    };
                    lines.iter().flat_map(|(_, words)| words).filter_map(number).collect()
                }
            };
            // Zeros at the end of a row are not in the file.
            let bits = |x: f64| (x != 0.0).then(|| x.to_bits());
            expected.retain(|&x| x != 0);
            let read: Vec<u64> = read.into_iter().filter_map(bits).collect();
            assert_eq!(read, expected, "{}", candidate.name);
        }
    }

    /// Each table, on the equation of the known answers, against their 25 digits.
    ///
    /// Catches: a coefficient that is rounded or misplaced by the export, a list that is left out,
    /// a stage at a wrong time, a step that is interpreted otherwise than it is written.
    #[test]
    fn every_table_leads_where_the_known_answers_say() {
        let (mut compared, mut of) = (0, 0);
        for candidate in all() {
            let known = known_answers::methods().iter().chain(known_answers::mistakes());
            let known = known.into_iter().find(|known| known.name == candidate.name).unwrap();
            assert_eq!(candidate.right, known.mistake.is_none(), "{}", candidate.name);
            of += 1;
            let mut any = false;
            for answer in &known.answers {
                let scene = answer.scene;
                // Its drag is one of 0.1/s in the file, each step's of a thousandth.
                let c = match &candidate.kind {
                    Kind::Formula { damped: true, .. } if candidate.name.ends_with("-drag") => 0.1,
                    Kind::Formula { damped: true, .. } => 0.001 / scene.step,
                    _ => 0.0,
                };
                let drive = scene.drive.map_or([0.0; 3], |d| [d.amplitude, 0.0, d.frequency]);
                let k = scene.g_over_l;
                let equation = Equation { force: Force::Sine, k, c, drive };
                let start = [scene.start.theta, scene.start.omega];
                let end = match candidate.older() {
                    0 => {
                        candidate.run(&equation, scene.time, start, scene.step, answer.steps as u32)
                    }
                    older if answer.steps == 1 => {
                        let fine = named("dormand-prince-8").unwrap();
                        let back = |i: usize| {
                            let h = -scene.step / 32.0;
                            fine.run(&equation, scene.time, start, h, 32 * i as u32)
                        };
                        let past: Vec<State> = (0..=older).map(back).collect();
                        candidate.step_from(&equation, scene.time, &past, scene.step)
                    }
                    _ => continue,
                };
                let off = answer.off(pendula::Phase { theta: end[0], omega: end[1] }, f64::EPSILON);
                // The sums are taken in another order than the tolerance was measured in.
                assert!(off < 3.0, "{} in {}: {off} tolerances", candidate.name, scene.name);
                any = true;
            }
            compared += usize::from(any);
        }
        assert_eq!((compared, of), (271 - 2, 271 - 2));
    }
}
