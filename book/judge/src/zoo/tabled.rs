//! Embedded pairs in numbers that can be changed, with a loop that can be given other habits: right
//! solvers of many kinds, and wrong ones, each with one change.

use core::cell::Cell;
use core::time::Duration;

use pendula::internals::runge_kutta::Row;
use pendula::internals::runge_kutta::dormand_prince::TABLEAU;
use pendula::systems::Phase;

use crate::integrator::{Fault, Reply};
use crate::solver::{Crossings, CrossingsRequest, SolveRequest, Solver};

/// An explicit pair: nodes, stages, the weights of the step and of its estimate.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    /// Where the stages are, in steps.
    pub nodes: Vec<f64>,
    /// What each stage adds of those before it.
    pub stages: Vec<Vec<f64>>,
    /// The weights of the step.
    pub step: Vec<f64>,
    /// Those of the step less those of the other result.
    pub estimate: Vec<f64>,
    /// The order of the step.
    pub order: u32,
    /// The power of the step with which the estimate falls.
    pub power: u32,
}

/// A pair of these stages, whose nodes are the sums of their rows, and of these weights.
fn pair(stages: &[&[f64]], [step, other]: [&[f64]; 2], order: u32, power: u32) -> Table {
    Table {
        nodes: stages.iter().map(|row| row.iter().sum()).collect(),
        stages: stages.iter().map(|row| row.to_vec()).collect(),
        step: step.to_vec(),
        estimate: step.iter().zip(other).map(|(a, b)| a - b).collect(),
        order,
        power,
    }
}

impl Table {
    /// Heun's method with Euler's.
    pub fn heun_euler() -> Self {
        pair(&[&[], &[1.0]], [&[0.5, 0.5], &[1.0, 0.0]], 2, 2)
    }

    /// That of Bogacki and Shampine, of order 3.
    pub fn bogacki_shampine() -> Self {
        let step = [2.0 / 9.0, 1.0 / 3.0, 4.0 / 9.0, 0.0];
        let other = [7.0 / 24.0, 0.25, 1.0 / 3.0, 0.125];
        pair(&[&[], &[0.5], &[0.0, 0.75], &step[..3]], [&step, &other], 3, 3)
    }

    /// Fehlberg's, which goes on with the result of order 5.
    pub fn fehlberg() -> Self {
        let stages: [&[f64]; 6] = [
            &[],
            &[0.25],
            &[3.0 / 32.0, 9.0 / 32.0],
            &[1932.0 / 2197.0, -7200.0 / 2197.0, 7296.0 / 2197.0],
            &[439.0 / 216.0, -8.0, 3680.0 / 513.0, -845.0 / 4104.0],
            &[-8.0 / 27.0, 2.0, -3544.0 / 2565.0, 1859.0 / 4104.0, -11.0 / 40.0],
        ];
        let five =
            [16.0 / 135.0, 0.0, 6656.0 / 12_825.0, 28_561.0 / 56_430.0, -9.0 / 50.0, 2.0 / 55.0];
        let four = [25.0 / 216.0, 0.0, 1408.0 / 2565.0, 2197.0 / 4104.0, -0.2, 0.0];
        pair(&stages, [&five, &four], 5, 5)
    }

    /// That of Cash and Karp, of order 5.
    pub fn cash_karp() -> Self {
        let stages: [&[f64]; 6] = [
            &[],
            &[0.2],
            &[0.075, 0.225],
            &[0.3, -0.9, 1.2],
            &[-11.0 / 54.0, 2.5, -70.0 / 27.0, 35.0 / 27.0],
            &[
                1631.0 / 55_296.0,
                175.0 / 512.0,
                575.0 / 13_824.0,
                44_275.0 / 110_592.0,
                253.0 / 4096.0,
            ],
        ];
        let five = [37.0 / 378.0, 0.0, 250.0 / 621.0, 125.0 / 594.0, 0.0, 512.0 / 1771.0];
        let four = [
            2825.0 / 27_648.0,
            0.0,
            18_575.0 / 48_384.0,
            13_525.0 / 55_296.0,
            277.0 / 14_336.0,
            0.25,
        ];
        pair(&stages, [&five, &four], 5, 5)
    }

    /// That of Dormand and Prince, of order 5.
    pub fn dormand_prince() -> Self {
        let weights = |row: &Row| -> Vec<f64> {
            let name = |k| ["k1", "k2", "k3", "k4", "k5", "k6", "k7"][k];
            let term = |k: usize| row.terms.iter().find(|(stage, _)| *stage == name(k));
            (0..7).map(|k| term(k).map_or(0.0, |(_, it)| it.value)).collect()
        };
        let others = TABLEAU.stages.iter().map(weights);
        let nodes = TABLEAU.stages.iter().map(|row| row.node.map_or(0.0, |node| node.value));
        Self {
            nodes: core::iter::once(0.0).chain(nodes).collect(),
            stages: core::iter::once(Vec::new()).chain(others).collect(),
            step: weights(&TABLEAU.sums[0]),
            estimate: weights(&TABLEAU.sums[1]),
            order: 5,
            power: 5,
        }
    }

    /// Tsitouras's, of order 5.
    pub fn tsitouras() -> Self {
        let step = [
            0.096_460_766_818_065_23,
            0.01,
            0.479_889_650_414_499_57,
            1.379_008_574_103_742,
            -3.290_069_515_436_081,
            2.324_710_524_099_774,
            0.0,
        ];
        let stages: [&[f64]; 7] = [
            &[],
            &[0.161],
            &[-0.008_480_655_492_356_989, 0.335_480_655_492_357],
            &[2.897_153_057_105_493_5, -6.359_448_489_975_075, 4.362_295_432_869_581],
            &[
                5.325_864_828_439_257,
                -11.748_883_564_062_828,
                7.495_539_342_889_836_5,
                -0.092_495_066_361_755_25,
            ],
            &[
                5.861_455_442_946_42,
                -12.920_969_317_847_11,
                8.159_367_898_576_159,
                -0.071_584_973_281_401,
                -0.028_269_050_394_068_383,
            ],
            &step[..6],
        ];
        let other = [
            0.094_680_755_765_839_46,
            0.009_183_565_540_343_254,
            0.487_770_528_424_761_6,
            1.234_297_566_930_479,
            -2.707_712_349_983_525_5,
            1.866_628_418_170_587,
            1.0 / 66.0,
        ];
        pair(&stages, [&step, &other], 5, 5)
    }

    /// The same, with the other result handed on.
    #[must_use]
    pub fn lower(mut self) -> Self {
        self.step = self.step.iter().zip(&self.estimate).map(|(a, b)| a - b).collect();
        self.order -= 1;
        self
    }
}

/// How a step's error is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Norm {
    /// The larger of the two components.
    Largest,
    /// The root of the mean of their squares.
    MeanSquare,
    /// The root of the sum of their squares.
    Euclidean,
}

/// What a component is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Absolute and relative tolerance, of the larger of old and new state; the absolute one of ω
    /// in units of ω₀.
    Both,
    /// The same of the old state.
    Old,
    /// One absolute tolerance for both components, and the relative one.
    OneAbsolute,
    /// The absolute tolerance alone.
    Absolute,
}

/// How the next step is chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// By the last error.
    Last,
    /// By the last two (Gustafsson), as Hairer has it.
    Two,
    /// Halved where it is refused, and doubled where its error is small enough.
    Halves,
}

/// Where the first step comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum First {
    /// A thousandth of the run.
    Part,
    /// A millionth.
    Tiny,
    /// The tolerance and the rate, as in Hairer's book.
    Guessed,
    /// All of the run.
    Whole,
}

/// Where outputs come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outputs {
    /// A step of the same method, from the start of the step.
    Step,
    /// Steps end there.
    Stops,
    /// A cubic through states and slopes at both ends.
    Cubic,
    /// The same, with the slopes not multiplied by the step.
    CubicWithoutStep,
}

/// How it locates a passage.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Passage {
    /// By bisection.
    Root,
    /// On a straight line between the ends of a step; the state is that of the time.
    Line,
    /// The same, with the state on the line as well.
    LineAndState,
    /// None.
    Unsupported,
}

/// One mistake in the loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mistake {
    /// None.
    Nothing,
    /// The time goes on by a refused step, and the state does not.
    TimeOfRefused,
    /// The time goes on by the next step instead of this one, if a step was refused.
    TimeOfNext,
    /// The state of a refused step is kept, and its time is not.
    StateOfRefused,
    /// Every step is accepted.
    AllAccepted,
    /// Steps are accepted up to ten times the tolerance.
    LooselyAccepted,
    /// The next step is chosen by the wrong power of the error.
    WrongPower,
    /// The estimate has its sign, and passes if it is negative.
    Signed,
    /// The estimate has no factor of the step.
    WithoutStep,
    /// The first component alone is held to the tolerance.
    FirstAlone,
    /// The slope at the start of the step is that of the last accepted one but one.
    OldSlope,
    /// The step may grow after a refusal.
    NoGrowthAtAll,
}

/// What a loop may do otherwise and be right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Habits {
    /// How a step's error is measured.
    pub norm: Norm,
    /// What it is compared with.
    pub scale: Scale,
    /// How the next step is chosen.
    pub control: Control,
    /// Where the first comes from.
    pub first: First,
    /// Where outputs come from.
    pub outputs: Outputs,
    /// How a passage is located.
    pub passage: Passage,
    /// The digits of what is returned, if it is rounded.
    pub digits: Option<usize>,
    /// Whether the error of a step over its size is held to the tolerance.
    pub per_unit: bool,
    /// A tolerance that replaces the one that is asked for.
    pub fixed: Option<f64>,
    /// What g/L is multiplied by.
    pub gravity: f64,
}

impl Default for Habits {
    fn default() -> Self {
        Self {
            norm: Norm::Largest,
            scale: Scale::Both,
            control: Control::Last,
            first: First::Part,
            outputs: Outputs::Step,
            passage: Passage::Root,
            digits: None,
            per_unit: false,
            fixed: None,
            gravity: 1.0,
        }
    }
}

/// A solver made of a table.
#[derive(Debug)]
pub struct Tabled {
    /// The numbers.
    pub table: Table,
    /// The loop.
    pub habits: Habits,
    /// What is wrong in the loop.
    pub mistake: Mistake,
    /// What all requests took, by its own clock (ns).
    spent: Cell<u64>,
}

type State = [f64; 2];

/// A step: its start, the state there and at its end, the slopes there, and its size.
struct Step {
    t: f64,
    h: f64,
    z: [State; 2],
    slope: [State; 2],
}

/// An equation: θ̈ = −k sin θ + A cos Ωt.
struct Equation {
    k: f64,
    drive: [f64; 2],
    evaluations: Cell<u64>,
}

impl Equation {
    fn rate(&self, t: f64, [theta, omega]: State) -> State {
        self.evaluations.set(self.evaluations.get() + 1);
        let [amplitude, frequency] = self.drive;
        let push = if amplitude == 0.0 { 0.0 } else { amplitude * libm::cos(frequency * t) };
        [omega, push - self.k * libm::sin(theta)]
    }
}

fn ahead(z: State, slopes: &[State], weights: &[f64], h: f64) -> State {
    [0, 1].map(|i| {
        z[i] + h * slopes.iter().zip(weights).map(|(slope, weight)| slope[i] * weight).sum::<f64>()
    })
}

impl Tabled {
    /// A solver of this table and these habits.
    pub const fn new(table: Table, habits: Habits) -> Self {
        Self { table, habits, mistake: Mistake::Nothing, spent: Cell::new(0) }
    }

    /// The same with a mistake in its loop.
    #[must_use]
    pub fn with(self, mistake: Mistake) -> Self {
        Self { mistake, ..self }
    }

    /// The stages of a step.
    fn slopes(&self, equation: &Equation, t: f64, z: State, h: f64, first: State) -> Vec<State> {
        let Table { nodes, stages, .. } = &self.table;
        let mut slopes = vec![first];
        for (node, stage) in nodes.iter().zip(stages).skip(1) {
            slopes.push(equation.rate(t + node * h, ahead(z, &slopes, stage, h)));
        }
        slopes
    }

    /// The error of a step, over what it may be.
    fn error(&self, k: f64, slopes: &[State], [z, end]: [State; 2], h: f64, tol: f64) -> f64 {
        let Habits { norm, scale, per_unit, .. } = self.habits;
        let size = if per_unit || self.mistake == Mistake::WithoutStep { 1.0 } else { h };
        let size = if per_unit { size / libm::sqrt(k) } else { size };
        let error = ahead([0.0; 2], slopes, &self.table.estimate, size);
        let unit = [1.0, libm::sqrt(k)];
        let over = [0, 1].map(|i| {
            let absolute = if scale == Scale::OneAbsolute { 1.0 } else { unit[i] };
            let relative = match scale {
                Scale::Absolute => 0.0,
                Scale::Old => z[i].abs(),
                Scale::Both | Scale::OneAbsolute => z[i].abs().max(end[i].abs()),
            };
            error[i] / (tol * (absolute + relative))
        });
        if self.mistake == Mistake::FirstAlone {
            return over[0].abs();
        }
        if self.mistake == Mistake::Signed {
            return over[0].max(over[1]);
        }
        match norm {
            Norm::Largest => over[0].abs().max(over[1].abs()),
            Norm::MeanSquare => libm::sqrt(0.5 * (over[0] * over[0] + over[1] * over[1])),
            Norm::Euclidean => libm::hypot(over[0], over[1]),
        }
    }

    fn run(
        &self,
        equation: &Equation,
        start: State,
        [from, until]: [f64; 2],
        tolerance: f64,
        stops: &[f64],
        look: &mut dyn FnMut(&Step),
    ) -> Result<(), Fault> {
        let habits = self.habits;
        let refused = |why: &str| Fault::Refused(why.to_string());
        if !(tolerance > 0.0 && (until - from).is_finite()) {
            return Err(refused("no such run"));
        }
        let tol = habits.fixed.unwrap_or(tolerance);
        let power = f64::from(self.table.power) - f64::from(u8::from(habits.per_unit));
        let power = if self.mistake == Mistake::WrongPower { 1.0 } else { power };
        let (mut t, mut z) = (from, start);
        let mut slope = equation.rate(t, z);
        let duration = until - from;
        let guessed = 0.01 / libm::sqrt(equation.k) * libm::pow(tol, 1.0 / power);
        let mut size = match habits.first {
            First::Part => 1e-3 * duration.abs(),
            First::Tiny => 1e-6 * duration.abs(),
            First::Guessed => guessed.min(duration.abs()),
            First::Whole => duration.abs(),
        };
        let (mut before, mut steps, mut stopped, mut was_refused) = (1e-4, 0_u32, 0, false);
        while t != until {
            steps += 1;
            if steps > 2_000_000 {
                return Err(refused("too many steps"));
            }
            while stopped < stops.len() && (stops[stopped] - t) * duration.signum() <= 0.0 {
                stopped += 1;
            }
            let next = stops.get(stopped).copied().unwrap_or(until);
            let left = next - t;
            let is_cut = size >= left.abs();
            let h = if is_cut { left } else { libm::copysign(size, duration) };
            let slopes = self.slopes(equation, t, z, h, slope);
            let end = ahead(z, &slopes, &self.table.step, h);
            let error = self.error(equation.k, &slopes, [z, end], h, tol);
            let limit = if self.mistake == Mistake::LooselyAccepted { 10.0 } else { 1.0 };
            let accepted = error <= limit || self.mistake == Mistake::AllAccepted;
            let safe = error.max(1e-10);
            let factor = match habits.control {
                Control::Last => (0.9 * libm::pow(safe, -1.0 / power)).clamp(0.2, 5.0),
                Control::Two if accepted => {
                    let beta = 0.04;
                    let exponent = 1.0 / power - 0.75 * beta;
                    let raw = 0.9 * libm::pow(safe, -exponent) * libm::pow(before, beta);
                    raw.clamp(0.2, 10.0)
                }
                Control::Two => (0.9 * libm::pow(safe, -1.0 / power)).clamp(0.2, 1.0),
                Control::Halves if !accepted => 0.5,
                Control::Halves if error < 0.3 * libm::pow(0.5, power) => 2.0,
                Control::Halves => 1.0,
            };
            let factor =
                if self.mistake == Mistake::NoGrowthAtAll { factor.min(1.0) } else { factor };
            let wanted = h.abs() * factor;
            if !accepted {
                if self.mistake == Mistake::TimeOfRefused && !is_cut {
                    t += h * 0.01;
                }
                if self.mistake == Mistake::StateOfRefused {
                    z = end;
                    slope = equation.rate(t, z);
                }
                was_refused = true;
                size = wanted;
                if t + libm::copysign(0.1 * size, duration) == t {
                    return Err(refused("the step becomes too small"));
                }
                continue;
            }
            before = safe;
            let mut time = if is_cut { next } else { t + h };
            if self.mistake == Mistake::TimeOfNext && was_refused && !is_cut {
                time = t + libm::copysign(wanted.min(left.abs()), duration);
            }
            was_refused = false;
            let is_old = self.mistake == Mistake::OldSlope;
            let end_slope =
                if is_old { slopes[slopes.len() - 1] } else { equation.rate(time, end) };
            look(&Step { t, h, z: [z, end], slope: [slope, end_slope] });
            (t, z, slope) = (time, end, end_slope);
            // A step that was cut says little about the next.
            size = if is_cut { wanted.max(size) } else { wanted };
        }
        Ok(())
    }

    /// The state within a step.
    fn within(&self, equation: &Equation, step: &Step, time: f64) -> State {
        let Step { t, h, z: [z, end], slope } = *step;
        let s = (time - t) / h;
        if s == 1.0 {
            return end;
        }
        let cubic = |size: f64| {
            [0, 1].map(|i| {
                let (low, high) = (slope[0][i] * size, slope[1][i] * size);
                let rise = end[i] - z[i];
                z[i] + s
                    * (low + s * (3.0 * rise - 2.0 * low - high + s * (low + high - 2.0 * rise)))
            })
        };
        match self.habits.outputs {
            Outputs::Cubic => cubic(h),
            Outputs::CubicWithoutStep => cubic(1.0),
            Outputs::Step | Outputs::Stops => {
                let slopes = self.slopes(equation, t, z, s * h, slope[0]);
                ahead(z, &slopes, &self.table.step, s * h)
            }
        }
    }

    fn rounded(&self, z: State) -> Phase {
        let [theta, omega] = match self.habits.digits {
            Some(digits) => z.map(|x| format!("{x:.*e}", digits - 1).parse().unwrap_or(x)),
            None => z,
        };
        Phase { theta, omega }
    }
}

/// What an evaluation takes (ns).
const EVALUATION: u64 = 20;

impl Solver for Tabled {
    fn solve(&self, request: &SolveRequest) -> Result<Reply, Fault> {
        let drive = request.drive.map_or([0.0; 2], |it| [it.amplitude, it.frequency]);
        let k = self.habits.gravity * request.g_over_l;
        let equation = Equation { k, drive, evaluations: Cell::new(0) };
        let (from, times) = (request.from, &request.times);
        let until = times.last().copied().unwrap_or(from);
        let start = [request.start.theta, request.start.omega];
        let mut rows = Vec::new();
        while rows.len() < times.len() && times[rows.len()] == from {
            rows.push(self.rounded(start));
        }
        let stops = if self.habits.outputs == Outputs::Stops { &times[..] } else { &[] };
        self.run(&equation, start, [from, until], request.tolerance, stops, &mut |step| {
            let end = step.t + step.h;
            let is_last = |time: f64| time == until && end == until;
            while let Some(&time) = times.get(rows.len()) {
                if (time - end) * (until - from).signum() > 0.0 {
                    break;
                }
                let at_end = time == end || is_last(time);
                let z = if at_end { step.z[1] } else { self.within(&equation, step, time) };
                rows.push(self.rounded(z));
            }
        })?;
        let last = rows.last().copied();
        while let (Some(last), true) = (last, rows.len() < times.len()) {
            rows.push(last);
        }
        let evaluations = equation.evaluations.get();
        self.spent.set(self.spent.get() + EVALUATION * evaluations);
        Ok(Reply { states: rows, evaluations: Some(evaluations) })
    }

    fn crossings(&self, request: &CrossingsRequest) -> Result<Crossings, Fault> {
        let CrossingsRequest { g_over_l, start, span, tolerance } = *request;
        let passage = self.habits.passage;
        if passage == Passage::Unsupported {
            return Err(Fault::Unsupported);
        }
        let k = self.habits.gravity * g_over_l;
        let equation = Equation { k, drive: [0.0; 2], evaluations: Cell::new(0) };
        let mut found = Vec::new();
        let start = [start.theta, start.omega];
        self.run(&equation, start, span, tolerance, &[], &mut |step| {
            let [[before, _], [after, _]] = step.z;
            if before == 0.0 || before * after > 0.0 {
                return;
            }
            let at = |s: f64| {
                let time = step.t + s * step.h;
                (time, self.within(&equation, step, time))
            };
            let line = before / (before - after);
            let (time, z) = match passage {
                Passage::Line => at(line),
                Passage::LineAndState => {
                    let between = |i| step.z[0][i] + line * (step.z[1][i] - step.z[0][i]);
                    (step.t + line * step.h, [between(0), between(1)])
                }
                Passage::Root | Passage::Unsupported => {
                    let (mut low, mut high) = (0.0, 1.0);
                    for _ in 0..52 {
                        let middle = 0.5 * (low + high);
                        let same = at(middle).1[0] * before > 0.0;
                        if same { low = middle } else { high = middle }
                    }
                    at(high)
                }
            };
            found.push((time, self.rounded(z)));
        })?;
        self.spent.set(self.spent.get() + EVALUATION * equation.evaluations.get());
        Ok(found)
    }

    fn clock(&self) -> Duration {
        Duration::from_nanos(self.spent.get())
    }
}

// -------------------------------------------------------------------------------------------------
// Wrong in one kind of run
// -------------------------------------------------------------------------------------------------

/// The runs in which an angle is off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum When {
    /// All runs backwards.
    Backwards,
    /// The last of several outputs.
    Last,
    /// With more outputs than 2000.
    Many,
    /// From another t₀ than 0 on.
    Elsewhere,
    /// From an earlier t₀ than 0 on.
    Earlier,
}

/// A right solver whose angles are off by this much (rad) in some runs.
pub struct Off<S> {
    /// The right one.
    pub right: S,
    /// How far (rad).
    pub by: f64,
    /// In which runs.
    pub when: When,
}

impl<S> core::fmt::Debug for Off<S> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.debug_struct("Off")
            .field("by", &self.by)
            .field("when", &self.when)
            .finish_non_exhaustive()
    }
}

impl<S: Solver> Solver for Off<S> {
    fn solve(&self, request: &SolveRequest) -> Result<Reply, Fault> {
        let mut reply = self.right.solve(request)?;
        let (from, times) = (request.from, &request.times);
        let is_off = match self.when {
            When::Backwards => times.last().is_some_and(|until| *until < from),
            When::Last => times.len() > 1,
            When::Many => times.len() > 2000,
            When::Elsewhere => from != 0.0,
            When::Earlier => from < 0.0,
        };
        let first = if self.when == When::Last { times.len().saturating_sub(1) } else { 0 };
        if is_off {
            reply.states.iter_mut().skip(first).for_each(|z| z.theta += self.by);
        }
        Ok(reply)
    }

    fn crossings(&self, request: &CrossingsRequest) -> Result<Crossings, Fault> {
        self.right.crossings(request)
    }

    fn clock(&self) -> Duration {
        self.right.clock()
    }
}
