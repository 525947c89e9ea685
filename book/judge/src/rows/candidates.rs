//! The known methods and mistakes, taken from their tables step by step.

use std::cell::Cell;
use std::sync::LazyLock;

use super::lanes::Four;
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
    /// How fast it changes at most (1/s).
    pub fn rate(&self) -> f64 {
        let rate = libm::sqrt(self.k.abs()) * self.force.stiffness();
        libm::fmax(rate, libm::fmax(self.drive[2], self.c.abs()))
    }
}

/// The equations of four pairs: k and c may differ.
#[derive(Clone, Copy, Debug)]
pub struct Equations {
    force: Force,
    k: Four,
    c: Four,
    drive: [f64; 3],
}

impl Equations {
    /// Of the same force and drive.
    pub fn of(each: [Equation; 4]) -> Self {
        let [Equation { force, drive, .. }, ..] = each;
        Self { force, k: Four(each.map(|one| one.k)), c: Four(each.map(|one| one.c)), drive }
    }

    /// One of them.
    pub fn one(&self, lane: usize) -> Equation {
        let Self { force, k, c, drive } = *self;
        Equation { force, k: k.0[lane], c: c.0[lane], drive }
    }

    /// The accelerations.
    #[inline]
    fn acceleration(&self, t: Four, theta: Four, omega: Four) -> Four {
        let [a, b, frequency] = self.drive;
        let free = self.k * self.force.of(theta) * -1.0 - self.c * omega;
        if frequency == 0.0 {
            return free;
        }
        let phase = t * frequency;
        free + phase.cosine() * a + phase.sine() * b
    }
}

impl Force {
    /// What programs have.
    pub const USUAL: [Self; 2] = [Self::Sine, Self::Linear];
    /// What else is looked for, where nothing is found with those.
    pub const OTHERS: [Self; 4] = [Self::Cubic, Self::Cosine, Self::SineCosine, Self::Degrees];

    /// f(θ).
    pub fn at(self, theta: f64) -> f64 {
        self.of(Four([theta; 4])).0[0]
    }

    /// f(θ) of each.
    #[inline]
    fn of(self, theta: Four) -> Four {
        match self {
            Self::Sine => theta.sine(),
            Self::Linear => theta,
            Self::Cubic => theta - theta * theta * theta / 6.0,
            Self::Cosine => theta.cosine(),
            Self::SineCosine => theta.sine() * theta.cosine(),
            Self::Degrees => theta.map(f64::to_radians).sine(),
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
/// Four of them.
pub type States = [Four; 2];

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
        let [t, q, p, h] = [t, z[0], z[1], h].map(|x| Four([x; 4]));
        let [q, p] = self.run_four(&Equations::of([*equation; 4]), t, [q, p], h, [steps, 0, 0, 0]);
        [q.0[0], p.0[0]]
    }

    /// The states after so many steps of each.
    pub fn run_four(
        &self,
        equations: &Equations,
        t: Four,
        z: States,
        h: Four,
        steps: [u32; 4],
    ) -> States {
        WORK.set(WORK.get() + steps.iter().map(|&n| u64::from(n)).sum::<u64>() * self.cost);
        match &self.kind {
            Kind::RungeKutta(stages) => {
                let mut room = [[Four::default(); MOST_STAGES]; 2];
                repeat(t, z, h, steps, |t, z| stages.runge_kutta(equations, t, z, h, &mut room))
            }
            Kind::Nystrom(stages) => {
                let mut room = [Four::default(); MOST_STAGES];
                repeat(t, z, h, steps, |t, z| stages.nystrom(equations, t, z, h, &mut room))
            }
            Kind::Splitting { moves, old_force, .. } => {
                repeat(t, z, h, steps, |t, z| splitting(moves, *old_force, equations, t, z, h))
            }
            Kind::Formula { lines, .. } => {
                repeat(t, z, h, steps, |t, z| formula(lines, equations, t, z, h))
            }
            Kind::Multistep { .. } => [Four([f64::NAN; 4]); 2],
        }
    }

    /// A step of a multi-step method from older states, newest first.
    pub fn step_from(&self, equation: &Equation, t: f64, past: &[State], h: f64) -> State {
        let past: Vec<States> = past.iter().map(|z| z.map(|x| Four([x; 4]))).collect();
        let equations = Equations::of([*equation; 4]);
        let [q, p] = self.step_four_from(&equations, Four([t; 4]), &past, Four([h; 4]));
        [q.0[0], p.0[0]]
    }

    /// A step of each.
    #[expect(clippy::needless_range_loop, reason = "a lane is an entry of several arrays")]
    pub fn step_four_from(
        &self,
        equations: &Equations,
        t: Four,
        past: &[States],
        h: Four,
    ) -> States {
        let Kind::Multistep { values, explicit, implicit } = &self.kind else {
            return self.run_four(equations, t, past[0], h, [1; 4]);
        };
        let slopes: Vec<States> = (0..past.len())
            .map(|i| {
                let [q, p] = past[i];
                [p, equations.acceleration(t - h * i as f64, q, p)]
            })
            .collect();
        let sum = |weights: &[f64], of: &[States]| {
            let mut sum = [Four::default(); 2];
            for (&w, z) in weights.iter().zip(of) {
                sum = [sum[0] + z[0] * w, sum[1] + z[1] * w];
            }
            sum
        };
        let old = if values.is_empty() { past[0] } else { sum(values, past) };
        let add = |[a, b]: States, [x, y]: States| [a + h * x, b + h * y];
        let mut new = if explicit.is_empty() {
            add(past[0], slopes[0])
        } else {
            add(old, sum(explicit, &slopes))
        };
        let Some((&first, rest)) = implicit.split_first() else { return new };
        let known = add(old, sum(rest, &slopes));
        // A corrector once after a predictor, otherwise until it is settled.
        let sweeps = if explicit.is_empty() { 60 } else { 1 };
        let mut settled = [false; 4];
        for _ in 0..sweeps {
            let slope = [new[1], equations.acceleration(t + h, new[0], new[1])];
            let better = add(known, [slope[0] * first, slope[1] * first]);
            for lane in 0..4 {
                if settled[lane] {
                    continue;
                }
                let near = |i: usize| {
                    let (a, b): (f64, f64) = (better[i].0[lane], new[i].0[lane]);
                    (a - b).abs() <= f64::EPSILON * a.abs()
                };
                settled[lane] = near(0) && near(1);
                (0..2).for_each(|i| new[i].0[lane] = better[i].0[lane]);
            }
            if settled == [true; 4] {
                break;
            }
        }
        new
    }
}

/// So many steps of each; what leads out of every range has no state.
#[inline(always)]
fn repeat(
    t: Four,
    mut z: States,
    h: Four,
    mut steps: [u32; 4],
    mut step: impl FnMut(Four, States) -> States,
) -> States {
    let mut i = 0;
    while steps.iter().any(|&steps| i < steps) {
        let [q, p] = step(t + h * f64::from(i), z);
        for (lane, steps) in steps.iter_mut().enumerate().filter(|(_, steps)| i < **steps) {
            let mut new: State = [q.0[lane], p.0[lane]];
            // Beyond, a sine has no value.
            if !(new[0].abs() < 1e6 && new[1].abs() < 1e9) {
                (new, *steps) = ([f64::NAN; 2], 0);
            }
            (z[0].0[lane], z[1].0[lane]) = (new[0], new[1]);
        }
        i += 1;
    }
    z
}

#[inline]
fn dot(a: &[f64], x: &[Four]) -> Four {
    a.iter().zip(x).fold(Four::default(), |sum, (&a, &x)| sum + x * a)
}

impl Stages {
    #[expect(clippy::needless_range_loop, reason = "a stage is a row of several arrays")]
    fn runge_kutta(
        &self,
        equations: &Equations,
        t: Four,
        [q, p]: States,
        h: Four,
        [v, f]: &mut [[Four; MOST_STAGES]; 2],
    ) -> States {
        let size = self.c.len();
        let a_theta = self.a_theta.as_ref().unwrap_or(&self.a);
        let mut solved = [true; 4];
        if self.explicit {
            for i in 0..size {
                let stage = q + h * dot(&a_theta[i], &v[..]);
                v[i] = p + h * dot(&self.a[i], &f[..]);
                f[i] = equations.acceleration(t + h * self.times[i], stage, v[i]);
            }
        } else {
            f[..size].fill(equations.acceleration(t, q, p));
            solved = settle(&mut f[..size], scale(equations, [q, p], h), |f, new| {
                for i in 0..size {
                    v[i] = p + h * dot(&self.a[i], f);
                }
                for i in 0..size {
                    let stage = q + h * dot(&a_theta[i], &v[..]);
                    new[i] = equations.acceleration(t + h * self.times[i], stage, v[i]);
                }
            });
            for i in 0..size {
                v[i] = p + h * dot(&self.a[i], &f[..]);
            }
        }
        let (v, f) = (&v[..], &f[..]);
        only(solved, [q + h * dot(&self.b_theta, v), p + h * dot(&self.b, f)])
    }

    /// Of a force with a drag each stage takes the velocity at the start of the step: Nyström's
    /// methods say nothing of it.
    fn nystrom(
        &self,
        equations: &Equations,
        t: Four,
        [q, p]: States,
        h: Four,
        f: &mut [Four; MOST_STAGES],
    ) -> States {
        let size = self.c.len();
        let mut solved = [true; 4];
        let stage = |i: usize, f: &[Four]| {
            let angle = q + h * self.c[i] * p + h * h * dot(&self.a[i], f);
            equations.acceleration(t + h * self.times[i], angle, p)
        };
        if self.explicit {
            for i in 0..size {
                f[i] = stage(i, f);
            }
        } else {
            f[..size].fill(equations.acceleration(t, q, p));
            solved = settle(&mut f[..size], scale(equations, [q, p], h), |f, new| {
                (0..size).for_each(|i| new[i] = stage(i, f));
            });
        }
        let end = [q + h * p + h * h * dot(&self.b_theta, f), p + h * dot(&self.b, f)];
        only(solved, end)
    }
}

/// The states of those that are solved.
fn only(solved: [bool; 4], mut z: States) -> States {
    for (lane, _) in solved.iter().enumerate().filter(|(_, solved)| !**solved) {
        z.iter_mut().for_each(|x| x.0[lane] = f64::NAN);
    }
    z
}

/// The size of the forces, where they pass through zero.
fn scale(equations: &Equations, [q, p]: States, h: Four) -> Four {
    equations.k.map(f64::abs) * (q.map(f64::abs) + h.map(f64::abs) * p.map(f64::abs))
}

/// Improves the slopes of each until they are settled; false of those that do not.
fn settle(
    f: &mut [Four],
    scale: Four,
    mut improve: impl FnMut(&[Four], &mut [Four; MOST_STAGES]),
) -> [bool; 4] {
    let mut new = [Four::default(); MOST_STAGES];
    let (mut before, mut open, mut solved) = ([f64::INFINITY; 4], [true; 4], [false; 4]);
    for sweep in 0..80 {
        improve(f, &mut new);
        for lane in 0..4 {
            if !open[lane] {
                continue;
            }
            // Where the forces pass through zero, what they round is that of the angle.
            let (mut largest, mut change): (f64, f64) = (scale.0[lane], 0.0);
            for (f, new) in f.iter_mut().zip(&new) {
                let (old, new) = (&mut f.0[lane], new.0[lane]);
                largest = largest.max(new.abs());
                change = change.max((new - *old).abs());
                *old = new;
            }
            let small = change <= 4.0 * f64::EPSILON * largest;
            solved[lane] =
                change == 0.0 || (small && change >= before[lane]) || (small && sweep > 20);
            open[lane] = !solved[lane] && change.is_finite();
            before[lane] = change;
        }
        if open == [false; 4] {
            break;
        }
    }
    solved
}

fn splitting(
    moves: &[Move],
    old_force: bool,
    equations: &Equations,
    t: Four,
    [mut q, mut p]: States,
    h: Four,
) -> States {
    let mut kicked: Option<Four> = None;
    for step in moves {
        match *step {
            Move::Drift(length) => q = q + h * length * p,
            Move::Kick { length, at, gradient } => {
                let mut force = equations.acceleration(t + h * at, q, p);
                if let Some(old) = kicked.filter(|_| old_force) {
                    force = old;
                }
                kicked = Some(force);
                if gradient != 0.0 {
                    // The derivative of the sine; of other forces by a difference.
                    let slope = match equations.force {
                        Force::Sine => q.cosine(),
                        Force::Linear => Four([1.0; 4]),
                        other => (other.of(q + 1e-5) - other.of(q - 1e-5)) / 2e-5,
                    };
                    force = force * (Four([1.0; 4]) - h * h * gradient * equations.k * slope);
                }
                p = p + h * length * force;
            }
        }
    }
    [q, p]
}

fn formula(
    lines: &[(usize, Vec<Word>)],
    equations: &Equations,
    t: Four,
    [q, p]: States,
    h: Four,
) -> States {
    let mut names = [Four::default(); MOST_NAMES];
    names[..4].copy_from_slice(&[q, p, h, equations.c]);
    let mut stack = [Four::default(); 16];
    let free = Equations { c: Four::default(), ..*equations };
    for (name, words) in lines {
        let mut top = 0;
        for word in words {
            match *word {
                Word::Number(x) => (stack[top], top) = (Four([x; 4]), top + 1),
                Word::Name(i) => (stack[top], top) = (names[i], top + 1),
                Word::Force => {
                    stack[top - 1] = free.acceleration(t, stack[top - 1], Four::default());
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
