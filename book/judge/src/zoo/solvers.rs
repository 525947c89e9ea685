//! Wrong solvers, each close to a right one: an embedded method with the library's rules for the
//! next step, and one slip. Where a mistake was published, it is said where.

use core::cell::Cell;
use core::f64::consts::{PI, TAU};
use core::time::Duration;

use pendula::adaptive::Tolerance;
use pendula::internals::runge_kutta::Row;
use pendula::internals::runge_kutta::dormand_prince::TABLEAU;
use pendula::methods::Dop853;
use pendula::methods::runge_kutta::{Embedded, Interpolant, hermite};
use pendula::systems::{Pendulum, Phase, RateOf, System, Vector};

use super::tabled::{Habits, Mistake, Off, Outputs, Passage, Table, Tabled, When};
use crate::integrator::{Drive, Fault, Reply};
use crate::solver::{ByTolerance, Crossings, CrossingsRequest, SolveRequest, Solver};

/// What is wrong: see the list of [`wrong_solvers`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Slip {
    Nothing,
    RefusedSlopeKept,
    OutputsByLine,
    OutputsByCubic,
    EndByQuartic,
    OutputsAtStepEnds,
    OutputsByOldSlope,
    OutputsMoveTheRun,
    OutputsLate,
    EqualTimesDropped,
    StartDropped,
    OneOutputAStep,
    TimesMoved,
    ToleranceFloor,
    StepLimit,
    LastStepOver,
    LastStepShort,
    SingleTime,
    SingleStates,
    SingleOutputs,
    SmallestStep,
    FirstStepUnchecked,
    SignedError,
    NeverBackwards,
    BackwardsOutputsEarly,
    DriveAtStepStart,
    DriveAtStepStartBetween,
    DriveFromStart,
    AngleWrapped,
    StartWrapped,
    StepKept,
    CountKept,
    NanPasses,
    NeverRefused,
    RisingOnly,
    CrossingAtStepEnd,
    CrossingByLine,
    FirstCrossingOnly,
    CrossingsFromZero,
}

/// A wrong solver.
pub struct WrongSolver {
    /// Its name, as a sentence would have it.
    pub name: &'static str,
    /// Its claims, in words.
    pub claims: &'static str,
    /// It.
    pub solver: Box<dyn Solver>,
}

/// The wrong solvers, after the two right ones of which they are made.
pub fn wrong_solvers() -> Vec<WrongSolver> {
    use Slip::*;
    const FIVE: &str = "order=5 estimate=5 free-outputs crossings refuses";
    const EIGHT: &str = "order=8 estimate=8 free-outputs crossings refuses";
    let of = |name, solver| WrongSolver { name, claims: FIVE, solver };
    let pair =
        |name, pair: Pair| of(name, Box::new(Slipping::new(pair, Nothing)) as Box<dyn Solver>);
    let five =
        |name, slip| of(name, Box::new(Slipping::new(Pair::right(), slip)) as Box<dyn Solver>);
    let eight = |name, slip| WrongSolver {
        claims: EIGHT,
        ..of(name, Box::new(Slipping::new(Dop853, slip)) as Box<dyn Solver>)
    };
    let tabled = |name, table: Table, habits: Habits, mistake| {
        of(name, Box::new(Tabled::new(table, habits).with(mistake)) as Box<dyn Solver>)
    };
    let table = |change: fn(&mut Table)| {
        let mut table = Table::fehlberg();
        change(&mut table);
        table
    };
    let habits = Habits::default();
    let off = |name, when| WrongSolver {
        name,
        claims: "order=8 estimate=8",
        solver: Box::new(Off { right: ByTolerance::new(Dop853), by: 1e-3, when }),
    };
    vec![
        five("nothing wrong, order 5", Nothing),
        eight("nothing wrong, order 8", Nothing),
        pair("the sign of 1/40 turned", Pair::with_estimate(6, 1.0 / 40.0)),
        // SUNDIALS 850 had a wrong one.
        pair("a weight of the estimate left out", Pair::with_estimate(4, 0.0)),
        pair("two weights of the step exchanged", Pair::right().with_step_weights_exchanged()),
        pair("a stage mistyped", Pair::right().with_stage_mistyped()),
        pair("the result of order 4 handed on", Pair::right().of_lower_order()),
        // ODE.jl 15.
        five("the slope of a refused step kept", RefusedSlopeKept),
        five("outputs by a straight line", OutputsByLine),
        // Kvaerno5 of diffrax has a cubic in an order of 5.
        eight("outputs by a cubic", OutputsByCubic),
        // dopri8 of torchdiffeq.
        eight("the end by a quartic", EndByQuartic),
        five("outputs at the ends of steps", OutputsAtStepEnds),
        five("outputs by the old slope", OutputsByOldSlope),
        // OrdinaryDiffEq 556.
        five("outputs that move the run", OutputsMoveTheRun),
        five("outputs one row late", OutputsLate),
        five("equal times dropped", EqualTimesDropped),
        five("the time of the start dropped", StartDropped),
        // OrdinaryDiffEq 4139: outputs that are left out.
        five("one output a step", OneOutputAStep),
        five("times moved one by one", TimesMoved),
        five("a floor under the tolerance", ToleranceFloor),
        five("a limit of steps that is silent", StepLimit),
        five("the last step over the end", LastStepOver),
        five("the last step left out", LastStepShort),
        five("time in single precision", SingleTime),
        five("states in single precision", SingleStates),
        five("outputs in single precision", SingleOutputs),
        five("a smallest step", SmallestStep),
        five("a first step unchecked", FirstStepUnchecked),
        five("an error with a sign", SignedError),
        five("never backwards", NeverBackwards),
        five("outputs too early backwards", BackwardsOutputsEarly),
        five("the drive as at the start of a step", DriveAtStepStart),
        eight("the drive as at the start of a step between steps", DriveAtStepStartBetween),
        five("the drive as at the time since the start", DriveFromStart),
        five("the angle wrapped", AngleWrapped),
        five("the angle of the start wrapped", StartWrapped),
        five("a step kept from the last request", StepKept),
        five("a count kept from the last request", CountKept),
        five("an error that is no number passes", NanPasses),
        five("a time that never comes is the start", NeverRefused),
        five("passages from below only", RisingOnly),
        // diffrax 416.
        five("passages at the ends of steps", CrossingAtStepEnd),
        five("passages on a straight line", CrossingByLine),
        five("the first passage only", FirstCrossingOnly),
        five("passages always from t = 0 on", CrossingsFromZero),
        tabled("a node mistyped", table(|it| it.nodes[5] = 1.0), habits, Mistake::Nothing),
        tabled(
            "the result of order 4 handed on by Fehlberg's",
            Table::fehlberg().lower(),
            habits,
            Mistake::Nothing,
        ),
        tabled(
            "passages on a straight line by Fehlberg's",
            Table::fehlberg(),
            Habits { passage: Passage::Line, ..habits },
            Mistake::Nothing,
        ),
        tabled(
            "a tolerance that is not heeded",
            Table::fehlberg(),
            Habits { fixed: Some(1e-3), ..habits },
            Mistake::Nothing,
        ),
        tabled(
            "a g of two digits",
            Table::fehlberg(),
            Habits { gravity: 9.8 / 9.81, ..habits },
            Mistake::Nothing,
        ),
        tabled(
            "slopes of a cubic without the step",
            Table::fehlberg(),
            Habits { outputs: Outputs::CubicWithoutStep, ..habits },
            Mistake::Nothing,
        ),
        tabled(
            "the time moved on a refused step",
            Table::fehlberg(),
            habits,
            Mistake::TimeOfRefused,
        ),
        tabled(
            "the state of a refused step kept",
            Table::fehlberg(),
            habits,
            Mistake::StateOfRefused,
        ),
        tabled(
            "an error that is not multiplied by the step",
            Table::fehlberg(),
            habits,
            Mistake::WithoutStep,
        ),
        off("a thousandth off backwards", When::Backwards),
        off("a thousandth off in the last output", When::Last),
        off("a thousandth off with many outputs", When::Many),
        off("a thousandth off from another t₀", When::Elsewhere),
        off("a thousandth off from an earlier t₀", When::Earlier),
    ]
}

/// A step: time (s) and state at each fraction of it.
type Step<'s> = &'s dyn Fn(f64) -> (f64, Phase);

/// An embedded method with one slip in its loop.
struct Slipping<M> {
    method: M,
    slip: Slip,
    /// The size of the last step of the last request (s).
    kept: Cell<f64>,
    /// The evaluations of all requests.
    counted: Cell<u64>,
    /// The time that all requests have taken, by its own clock (ns): so much for each evaluation
    /// and for each number that is moved, whatever the machine does.
    spent: Cell<u64>,
}

/// What an evaluation takes (ns).
const EVALUATION: u64 = 20;

impl<M: Embedded> Slipping<M> {
    const fn new(method: M, slip: Slip) -> Self {
        let (kept, counted, spent) = (Cell::new(0.0), Cell::new(0), Cell::new(0));
        Self { method, slip, kept, counted, spent }
    }

    /// Runs `system` to the times of a request, and hands each step to `look`.
    fn run(
        &self,
        system: &Pushed,
        request: &SolveRequest,
        look: &mut dyn FnMut(Step<'_>),
    ) -> Result<Vec<Phase>, Fault> {
        use Slip::*;
        let is = |slip| self.slip == slip;
        let (until, duration) = self.end_of(request)?;
        let tolerance =
            if is(ToleranceFloor) { request.tolerance.max(1e-6) } else { request.tolerance };
        let scale = libm::fmin(1.0, libm::sqrt(request.g_over_l));
        let allowed =
            Tolerance::new(tolerance * scale, tolerance).or_else(|error| match is(NanPasses) {
                true => Tolerance::uniform(0.5),
                false => Err(error),
            });
        let allowed = allowed.map_err(|error| Fault::Refused(error.to_string()))?;
        let order = f64::from(M::ESTIMATE_ORDER);
        let (mut t, mut z) = (request.from, request.start);
        if is(StartWrapped) {
            z = wrapped(z);
        }
        let times = &request.times;
        let mut done = 0;
        let mut rows = Vec::new();
        while done < times.len() && times[done] == t {
            rows.extend((!is(StartDropped)).then_some(z));
            done += 1;
        }
        let mut slope = system.rate(t, z);
        let mut h = 1e-3 * duration;
        if is(FirstStepUnchecked) {
            h = libm::copysign(0.25, duration);
        }
        if is(StepKept) && self.kept.get() != 0.0 {
            h = libm::copysign(self.kept.get(), duration);
        }
        let mut steps = 0;
        while done < times.len() {
            if is(NeverBackwards) && duration < 0.0 {
                rows.resize(times.len(), z);
                break;
            }
            let left = until - t;
            let is_last = h.abs() >= left.abs();
            let step = if is_last && !is(LastStepOver) && !is(EndByQuartic) { left } else { h };
            if is_last && is(LastStepShort) || is(StepLimit) && steps >= 200 {
                rows.resize(times.len(), z);
                break;
            }
            steps += 1;
            system.frozen.set(is(DriveAtStepStart).then_some(t));
            let (end, stages) = self.method.attempt(system, t, step, z, slope);
            system.frozen.set(None);
            let mut error = self.method.error(&stages, |rate| {
                let error = rate * step;
                let sign = if is(SignedError) { signed(z + error, z) } else { 1.0 };
                sign * allowed.error_norm(z, end, error)
            });
            if is(NanPasses) && request.tolerance.is_nan() {
                error = f64::NAN;
            }
            let wanted = 0.9 * libm::pow(error.abs().max(1e-10), -1.0 / order);
            let factor = if wanted.is_nan() { 5.0 } else { wanted.clamp(0.2, 5.0) };
            let is_first = is(FirstStepUnchecked) && steps == 1;
            let is_smallest = is(SmallestStep) && step.abs() <= 1e-3;
            h = step * factor;
            if is_smallest && factor < 1.0 {
                h = libm::copysign(1e-3, step);
            }
            if error > 1.0 && !is_first && !is_smallest {
                if is(RefusedSlopeKept) {
                    slope = self.method.end_slope(system, t + step, end, &stages);
                }
                if t + 0.1 * h == t {
                    return Err(Fault::Refused("the step becomes too small".to_string()));
                }
                continue;
            }
            if steps > 5_000_000 {
                return Err(Fault::Refused("more than five million steps".to_string()));
            }
            let mut end = end;
            if is(SingleStates) {
                end = single(end);
            }
            let mut time = if step == left { until } else { t + step };
            if is(SingleTime) {
                time = f64::from(time as f32);
                if is_last {
                    time = until;
                }
            }
            let end_slope = self.method.end_slope(system, time, end, &stages);
            let cubic = hermite(
                end + z * -1.0,
                slope * step,
                if is(OutputsByOldSlope) { slope * step } else { end_slope * step },
            );
            let full = core::cell::OnceCell::new();
            let within = |s: f64| -> Phase {
                let dense = full.get_or_init(|| {
                    system.frozen.set(is(DriveAtStepStartBetween).then_some(t));
                    let dense = self.method.dense(system, t, step, z, &stages, end_slope);
                    system.frozen.set(None);
                    dense
                });
                let coefficients = dense.as_ref();
                let displacement = match self.slip {
                    OutputsByLine => [coefficients[0]].displacement(s),
                    OutputsByCubic | OutputsByOldSlope => cubic.displacement(s),
                    EndByQuartic => {
                        [coefficients[0], coefficients[1], coefficients[2], coefficients[3]]
                            .displacement(s)
                    }
                    OutputsAtStepEnds => return end,
                    _ => dense.displacement(s),
                };
                displacement.map_or(z, |displacement| z + displacement)
            };
            look(&|s| if s == 1.0 { (time, end) } else { (t + s * step, within(s)) });
            let mut moved = None;
            while done < times.len() {
                let due = times[done];
                let is_due = match is(BackwardsOutputsEarly) {
                    true => due <= time,
                    false => (due - time) * duration.signum() <= 0.0,
                };
                if !is_due {
                    break;
                }
                let is_end = due == time && !is(EndByQuartic);
                let last_is_over = is(LastStepOver) && due == until;
                let row = if is_end || last_is_over { end } else { within((due - t) / step) };
                let row = if is(SingleOutputs) && !is_end { single(row) } else { row };
                let late = is(OutputsLate).then_some(()).and(rows.last().copied());
                let equal = is(EqualTimesDropped) && done > 0 && times[done - 1] == due;
                rows.extend((!equal).then_some(late.unwrap_or(row)));
                done += 1;
                if is(TimesMoved) {
                    // All times that are left move up by one place. To do so would take seconds.
                    self.spend((times.len() - done) as u64);
                }
                if is(OutputsMoveTheRun) && !is_end {
                    moved = Some((due, row));
                }
                if is(OneOutputAStep) {
                    break;
                }
            }
            (t, z, slope) = (time, end, end_slope);
            if let Some((due, row)) = moved {
                (t, z) = (due, row);
                slope = system.rate(t, z);
            }
            self.kept.set(h.abs());
            if is(OneOutputAStep) && t == until {
                break;
            }
        }
        if is(AngleWrapped) {
            rows.iter_mut().for_each(|z| *z = wrapped(*z));
        }
        Ok(rows)
    }

    fn spend(&self, nanoseconds: u64) {
        self.spent.set(self.spent.get() + nanoseconds);
    }

    /// The end of a run and its duration (s).
    fn end_of(&self, request: &SolveRequest) -> Result<(f64, f64), Fault> {
        let until = request.times.last().copied().unwrap_or(request.from);
        if (until - request.from).is_finite() {
            return Ok((until, until - request.from));
        }
        match self.slip {
            Slip::NeverRefused => Ok((request.from, 0.0)),
            _ => Err(Fault::Refused("a time is not finite".to_string())),
        }
    }
}

/// A state with its angle within half a turn.
fn wrapped(z: Phase) -> Phase {
    Phase { theta: z.theta - TAU * libm::floor((z.theta + PI) / TAU), ..z }
}

/// A state in single precision.
fn single(z: Phase) -> Phase {
    Phase { theta: f64::from(z.theta as f32), omega: f64::from(z.omega as f32) }
}

/// The sign of the first component of a difference.
fn signed(a: Phase, b: Phase) -> f64 {
    if a.theta < b.theta { -1.0 } else { 1.0 }
}

/// A pendulum under a drive or none, its evaluations counted. (One type for all keeps the loop from
/// being compiled for each.)
struct Pushed {
    pendulum: Pendulum,
    drive: Drive,
    /// The time that the drive takes for 0 (s).
    origin: f64,
    /// A time that stands still (s).
    frozen: Cell<Option<f64>>,
    evaluations: Cell<u64>,
}

impl Pushed {
    fn new(g_over_l: f64, drive: Option<Drive>) -> Result<Self, Fault> {
        let refused = |error: pendula::Error| Fault::Refused(error.to_string());
        let pendulum = Pendulum::new(g_over_l, 1.0, 1.0).map_err(refused)?;
        let drive = drive.unwrap_or(Drive { amplitude: 0.0, frequency: 0.0 });
        let (frozen, evaluations) = (Cell::new(None), Cell::new(0));
        Ok(Self { pendulum, drive, origin: 0.0, frozen, evaluations })
    }
}

impl System for Pushed {
    type State = Phase;

    fn rate(&self, t: f64, z: Phase) -> Phase {
        self.evaluations.set(self.evaluations.get() + 1);
        let Drive { amplitude, frequency } = self.drive;
        let push =
            amplitude * libm::cos(frequency * (self.frozen.get().unwrap_or(t) - self.origin));
        let rate = self.pendulum.rate(t, z);
        Phase { omega: rate.omega + push, ..rate }
    }
}

impl<M: Embedded> Solver for Slipping<M> {
    fn solve(&self, request: &SolveRequest) -> Result<Reply, Fault> {
        let mut system = Pushed::new(request.g_over_l, request.drive)?;
        if self.slip == Slip::DriveFromStart {
            system.origin = request.from;
        }
        if self.slip == Slip::NeverRefused && self.end_of(request)?.1 == 0.0 {
            let states = vec![request.start; request.times.len()];
            return Ok(Reply { states, evaluations: None });
        }
        let states = self.run(&system, request, &mut |_| {})?;
        let evaluations = system.evaluations.get();
        self.spend(EVALUATION * evaluations);
        let before = self.counted.replace(self.counted.get() + evaluations);
        let kept = if self.slip == Slip::CountKept { before } else { 0 };
        Ok(Reply { states, evaluations: Some(kept + evaluations) })
    }

    fn crossings(&self, request: &CrossingsRequest) -> Result<Crossings, Fault> {
        let CrossingsRequest { g_over_l, start, span: [mut from, mut until], tolerance } = *request;
        if self.slip == Slip::CrossingsFromZero {
            (from, until) = (0.0, until - from);
        }
        let system = Pushed::new(g_over_l, None)?;
        let run = SolveRequest::new(g_over_l, start, tolerance).from(from).to(&[until]);
        let mut found = Vec::new();
        self.run(&system, &run, &mut |step| {
            let (before, after) = (step(0.0).1.theta, step(1.0).1.theta);
            let rising = before < 0.0 && after >= 0.0;
            let falling = before > 0.0 && after <= 0.0 && self.slip != Slip::RisingOnly;
            if (rising || falling) && (self.slip != Slip::FirstCrossingOnly || found.is_empty()) {
                found.push(match self.slip {
                    Slip::CrossingAtStepEnd => step(1.0),
                    Slip::CrossingByLine => step(before / (before - after)),
                    _ => bisect(step, before),
                });
            }
        })?;
        Ok(found)
    }

    fn clock(&self) -> Duration {
        Duration::from_nanos(self.spent.get())
    }
}

/// Where θ has passed zero, within a step that begins at `before`.
fn bisect(step: Step<'_>, before: f64) -> (f64, Phase) {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..52 {
        let middle = 0.5 * (low + high);
        let same = step(middle).1.theta * before > 0.0;
        if same { low = middle } else { high = middle }
    }
    step(high)
}

// -------------------------------------------------------------------------------------------------
// Dormand–Prince 5(4), in numbers that can be mistyped
// -------------------------------------------------------------------------------------------------

/// The library's table as arrays: where the stages are, in steps, the stages, and the weights of
/// the step, of its estimate and of the last term of the interpolant.
#[derive(Clone, Copy)]
struct Pair {
    nodes: [f64; 7],
    stages: [[f64; 7]; 7],
    step: [f64; 7],
    estimate: [f64; 7],
    fourth: [f64; 7],
}

/// The weights of the stages in a row of the library's table.
fn weights(row: &Row) -> [f64; 7] {
    core::array::from_fn(|k| {
        let name = ["k1", "k2", "k3", "k4", "k5", "k6", "k7"][k];
        let term = row.terms.iter().find(|(stage, _)| *stage == name);
        term.map_or(0.0, |(_, coefficient)| coefficient.value)
    })
}

impl Pair {
    fn right() -> Self {
        let (mut nodes, mut stages) = ([0.0; 7], [[0.0; 7]; 7]);
        for (k, row) in TABLEAU.stages.iter().enumerate() {
            nodes[k + 1] = row.node.map_or(0.0, |node| node.value);
            stages[k + 1] = weights(row);
        }
        let [step, estimate, fourth] = core::array::from_fn(|k| weights(&TABLEAU.sums[k]));
        Self { nodes, stages, step, estimate, fourth }
    }

    /// With another weight of the estimate.
    fn with_estimate(index: usize, weight: f64) -> Self {
        let mut pair = Self::right();
        pair.estimate[index] = weight;
        pair
    }

    fn with_step_weights_exchanged(mut self) -> Self {
        self.step.swap(2, 3);
        self
    }

    /// 46732/5247 as 46372/5247.
    fn with_stage_mistyped(mut self) -> Self {
        self.stages[5][2] = 46_372.0 / 5247.0;
        self
    }

    /// The step of the embedded method.
    fn of_lower_order(mut self) -> Self {
        self.step = core::array::from_fn(|k| self.step[k] - self.estimate[k]);
        self
    }
}

fn weighted<D: Vector>(stages: &[D; 7], weights: &[f64; 7]) -> D {
    let sum = |sum: D, (stage, weight): (&D, &f64)| sum + *stage * *weight;
    stages.iter().zip(weights).skip(1).fold(stages[0] * weights[0], sum)
}

impl Embedded for Pair {
    const ESTIMATE_ORDER: u32 = 5;

    type Stages<D: Vector> = [D; 7];
    type Dense<D: Vector> = [D; 4];

    fn attempt<S: System>(
        &self,
        system: &S,
        t: f64,
        h: f64,
        z: S::State,
        slope: RateOf<S>,
    ) -> (S::State, [RateOf<S>; 7]) {
        let mut stages = [slope; 7];
        for k in 1..7 {
            let ahead = weighted(&stages, &self.stages[k]);
            stages[k] = system.rate(t + self.nodes[k] * h, z + ahead * h);
        }
        (z + weighted(&stages, &self.step) * h, stages)
    }

    fn error<D: Vector>(&self, stages: &[D; 7], size: impl Fn(D) -> f64) -> f64 {
        size(weighted(stages, &self.estimate))
    }

    fn end_slope<S: System>(
        &self,
        system: &S,
        t: f64,
        z: S::State,
        _stages: &[RateOf<S>; 7],
    ) -> RateOf<S> {
        system.rate(t, z)
    }

    fn dense<S: System>(
        &self,
        _system: &S,
        _t: f64,
        h: f64,
        _z: S::State,
        stages: &[RateOf<S>; 7],
        end_slope: RateOf<S>,
    ) -> [RateOf<S>; 4] {
        let step = weighted(stages, &self.step) * h;
        let [first, second, third] = hermite(step, stages[0] * h, end_slope * h);
        [first, second, third, weighted(stages, &self.fourth) * h]
    }
}
