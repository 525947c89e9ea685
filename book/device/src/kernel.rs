//! The program for a device: the steps of a method, recorded, as OpenCL C.

use std::collections::BTreeSet;
use std::fmt::Write as _;

use pendula::fast::{ReducedPhase, ScaledPendulum};
use pendula::systems::{Numbers, energy_in_lanes};
use pendula::{Grid, Method, Pendulum, Phase};

use crate::trace::{Place, Tape, Traced, Value, record};

/// What each pendulum has of its own: −K, and for its energy m L² (kg m²), m g L (J) and the energy
/// at the start (J).
pub const CONSTANTS: [&str; 4] = ["minus_k", "inertia", "depth", "initial"];

/// The step h (s), which all have in common.
const STEP: &str = "h";

/// What a method needs to run on a device: steps that can be recorded, and a carry that can be
/// copied.
pub trait Recordable:
    Method<ScaledPendulum, Carry: Numbers> + Method<ScaledPendulum<Traced>, Carry: Numbers<Traced>>
{
}

impl<M> Recordable for M where
    M: Method<ScaledPendulum, Carry: Numbers>
        + Method<ScaledPendulum<Traced>, Carry: Numbers<Traced>>
{
}

/// A program with two kernels: `steps` takes steps, `watched_steps` looks at the energy after each.
#[derive(Clone, Debug, Eq, PartialEq)]
pub struct Program {
    /// OpenCL C 1.2.
    pub source: String,
    /// The numbers of a state and what a step carries to the next.
    pub numbers: usize,
    /// The additions, subtractions, multiplications and divisions of a step that is not looked at.
    pub operations: usize,
}

/// A pendulum where it begins: its [`CONSTANTS`], and the numbers of its state and its carry.
#[derive(Clone, Debug)]
pub struct Begun {
    /// As the list of their names.
    pub constants: [f64; CONSTANTS.len()],
    /// As many as [`Program::numbers`].
    pub numbers: Vec<f64>,
}

/// `pendulum` at `start`, before the first step of `method` along `grid`; `None` where the library
/// does not run it in steps either, see [`ScaledPendulum::new`].
pub fn begin<M: Recordable>(
    method: &M,
    pendulum: &Pendulum,
    start: Phase,
    grid: &Grid,
) -> Option<Begun> {
    use pendula::Hamiltonian;

    let scaled = ScaledPendulum::new::<M>(pendulum, grid, start)?;
    let state = scaled.from_phase(start);
    let carry = method.start(&scaled, 0.0, 1.0, state);
    let mut numbers = Vec::new();
    state.write(&mut |x| numbers.push(x));
    carry.write(&mut |x| numbers.push(x));
    let constants =
        [scaled.minus_k(), pendulum.inertia(), pendulum.depth(), pendulum.energy(start)];
    Some(Begun { constants, numbers })
}

/// A step, recorded: what becomes of the numbers, and what is looked at.
struct Recording {
    tape: Tape,
    names: Vec<String>,
    /// The numbers after the step: state, then carry.
    next: Vec<Place>,
    theta: Place,
    omega: Place,
    energy: Place,
}

/// The program for `method`; `None` if its steps depend on values, as those of an implicit method
/// do, which sweeps until its equations are solved.
pub fn program<M: Recordable>(method: &M) -> Option<Program> {
    let recording = Recording::of(method)?;
    let mut source = String::from(
        "// Made from a recorded step. Each operation is rounded by itself, as on a processor.\n\
         #pragma OPENCL EXTENSION cl_khr_fp64 : enable\n\
         #pragma OPENCL FP_CONTRACT OFF\n\n",
    );
    recording.write_steps(&mut source);
    recording.write_watched_steps(&mut source);
    let (numbers, operations) = (recording.next.len(), recording.operations());
    Some(Program { source, numbers, operations })
}

impl Recording {
    fn of<M: Recordable>(method: &M) -> Option<Self> {
        let mut names: Vec<String> = CONSTANTS.iter().map(|name| (*name).into()).collect();
        names.push(STEP.into());
        let first = names.len();
        let (tape, (next, [theta, omega, energy])) = record(|| {
            let [minus_k, inertia, depth, _, h] = [0, 1, 2, 3, 4].map(Traced::variable);
            let mut variables = first..;
            let mut variable = || Traced::variable(variables.next().expect("there is no end"));
            let state = ReducedPhase::read(&mut variable);
            let mut carry = <<M as Method<ScaledPendulum<Traced>>>::Carry as Numbers<Traced>>::read(
                &mut variable,
            );
            let system = ScaledPendulum::from_parameter(minus_k, f64::NAN);
            let state = method.step(&system, 0.0, 1.0, state, &mut carry);
            let mut next = Vec::new();
            state.write(&mut |x: Traced| next.push(x.place()));
            carry.write(&mut |x: Traced| next.push(x.place()));
            let (theta, omega) = (state.angle(), state.velocity() / h);
            let energy = energy_in_lanes([inertia, depth], theta, omega);
            (next, [theta, omega, energy].map(Traced::place))
        })?;
        names.extend((0..next.len()).map(|i| format!("z{i}")));
        Some(Self { tape, names, next, theta, omega, energy })
    }

    /// The index of the variable of the number `i`.
    fn variable(&self, i: usize) -> usize {
        CONSTANTS.len() + 1 + i
    }

    /// The steps, without a look at them: before the last one only what later steps need.
    fn write_steps(&self, out: &mut String) {
        self.write_head(out, "steps", "");
        out.push_str("    double theta, omega;\n    for (ulong n = 1; n < count; n++) {\n");
        let read = self.read_by_later_steps();
        let next: Vec<Place> = read.iter().map(|&i| self.next[i]).collect();
        self.write_values(out, &next, "        ");
        self.write_moves(out, &read, "        ");
        out.push_str("    }\n    {\n");
        let all: Vec<usize> = (0..self.next.len()).collect();
        self.write_values(out, &self.looked_at(), "        ");
        self.write_angle_and_velocity(out);
        self.write_moves(out, &all, "        ");
        out.push_str("    }\n");
        self.write_stores(out);
    }

    /// The steps, with a look at the energy after each.
    fn write_watched_steps(&self, out: &mut String) {
        self.write_head(out, "watched_steps", ", global double *watched");
        out.push_str(
            "    double theta, omega;\n    double largest = watched[i], farthest = \
             watched[pendulums + i];\n    for (ulong n = 0; n < count; n++) {\n",
        );
        let mut places = self.looked_at();
        places.push(self.energy);
        self.write_values(out, &places, "        ");
        self.write_angle_and_velocity(out);
        // A NaN stays.
        out.push_str("        const double error = fabs(");
        out.push_str(&self.term(self.energy));
        out.push_str(" - initial);\n");
        out.push_str("        largest = error > largest || isnan(error) ? error : largest;\n");
        out.push_str("        farthest = fabs(theta) > farthest ? fabs(theta) : farthest;\n");
        let all: Vec<usize> = (0..self.next.len()).collect();
        self.write_moves(out, &all, "        ");
        out.push_str("    }\n    watched[i] = largest;\n    watched[pendulums + i] = farthest;\n");
        self.write_stores(out);
    }

    /// The additions, subtractions, multiplications and divisions of a step before the last one.
    fn operations(&self) -> usize {
        let next: Vec<Place> =
            self.read_by_later_steps().into_iter().map(|i| self.next[i]).collect();
        let is_operation = |place: &Place| {
            matches!(
                self.value(*place),
                Value::Sum(..) | Value::Difference(..) | Value::Product(..) | Value::Quotient(..)
            )
        };
        self.live(&next).iter().filter(|place| is_operation(place)).count()
    }

    /// What the last step of all leaves: the numbers, angle and angular velocity.
    fn looked_at(&self) -> Vec<Place> {
        self.next.iter().copied().chain([self.theta, self.omega]).collect()
    }

    fn write_angle_and_velocity(&self, out: &mut String) {
        let [theta, omega] = [self.theta, self.omega].map(|place| self.term(place));
        let _ = writeln!(out, "        theta = {theta};\n        omega = {omega};");
    }

    fn write_head(&self, out: &mut String, name: &str, more: &str) {
        let _ = writeln!(
            out,
            "kernel void {name}(const ulong pendulums, const ulong count, const double {STEP}, \
             global const double *constants, global double *numbers, global double \
             *phases{more}) {{\n    const ulong i = get_global_id(0);\n    if (i >= pendulums) \
             return;"
        );
        for (index, name) in CONSTANTS.iter().enumerate() {
            let _ = writeln!(out, "    const double {name} = constants[{index} * pendulums + i];");
        }
        for i in 0..self.next.len() {
            let name = &self.names[self.variable(i)];
            let _ = writeln!(out, "    double {name} = numbers[{i} * pendulums + i];");
        }
    }

    fn write_stores(&self, out: &mut String) {
        for i in 0..self.next.len() {
            let name = &self.names[self.variable(i)];
            let _ = writeln!(out, "    numbers[{i} * pendulums + i] = {name};");
        }
        out.push_str("    phases[i] = theta;\n    phases[pendulums + i] = omega;\n}\n\n");
    }

    /// The numbers that a later step reads, directly or through the step after it.
    fn read_by_later_steps(&self) -> Vec<usize> {
        let mut read = BTreeSet::new();
        // The last step is asked for everything.
        let mut places = self.next.clone();
        loop {
            let before = read.len();
            read.extend(self.live(&places).into_iter().filter_map(
                |place| match self.value(place) {
                    Value::Variable(index) => index.checked_sub(self.variable(0)),
                    _ => None,
                },
            ));
            if read.len() == before {
                return read.into_iter().collect();
            }
            places = read.iter().map(|&i| self.next[i]).collect();
        }
    }

    /// The places of the values of which those at `places` are made, and these themselves.
    fn live(&self, places: &[Place]) -> BTreeSet<Place> {
        let (mut live, mut waiting) = (BTreeSet::new(), places.to_vec());
        while let Some(place) = waiting.pop() {
            if live.insert(place) {
                waiting.extend(made_of(self.value(place)));
            }
        }
        live
    }

    /// Declares all values that those at `places` are made of.
    fn write_values(&self, out: &mut String, places: &[Place], indent: &str) {
        for place in self.live(places) {
            let value = self.value(place);
            if !matches!(value, Value::Variable(_) | Value::Constant(_)) {
                let is_mask =
                    matches!(value, Value::AtMost(..) | Value::Both(..) | Value::Either(..));
                let (kind, text) = (if is_mask { "int" } else { "double" }, self.operation(value));
                let _ = writeln!(out, "{indent}const {kind} v{place} = {text};");
            }
        }
    }

    /// Gives the numbers `which` their next values, all at once: one may be the value that another
    /// had before the step.
    fn write_moves(&self, out: &mut String, which: &[usize], indent: &str) {
        let is_variable = |i: usize| matches!(self.value(self.next[i]), Value::Variable(_));
        for &i in which.iter().filter(|i| is_variable(**i)) {
            let _ = writeln!(out, "{indent}const double old{i} = {};", self.term(self.next[i]));
        }
        for &i in which {
            let next = if is_variable(i) { format!("old{i}") } else { self.term(self.next[i]) };
            let _ = writeln!(out, "{indent}{} = {next};", self.names[self.variable(i)]);
        }
    }

    fn value(&self, place: Place) -> Value {
        self.tape.values()[place]
    }

    /// The value at a place, where it is used.
    fn term(&self, place: Place) -> String {
        match self.value(place) {
            Value::Variable(index) => self.names[index].clone(),
            Value::Constant(bits) => constant(f64::from_bits(bits)),
            _ => format!("v{place}"),
        }
    }

    fn operation(&self, value: Value) -> String {
        let term = |place| self.term(place);
        match value {
            Value::Variable(_) | Value::Constant(_) => unreachable!("not declared"),
            Value::Sum(a, b) => format!("{} + {}", term(a), term(b)),
            Value::Difference(a, b) => format!("{} - {}", term(a), term(b)),
            Value::Product(a, b) => format!("{} * {}", term(a), term(b)),
            Value::Quotient(a, b) => format!("{} / {}", term(a), term(b)),
            Value::Negative(a) => format!("-{}", term(a)),
            Value::Size(a) => format!("fabs({})", term(a)),
            Value::WithSign(a, b) => format!("copysign({}, {})", term(a), term(b)),
            Value::SignedBy(a, b) => {
                format!("as_double(as_ulong({}) ^ (as_ulong({}) << 63))", term(a), term(b))
            }
            Value::Choice(a, b, c) => format!("{} ? {} : {}", term(a), term(b), term(c)),
            Value::AtMost(a, b) => format!("{} <= {}", term(a), term(b)),
            Value::Both(a, b) => format!("{} && {}", term(a), term(b)),
            Value::Either(a, b) => format!("{} || {}", term(a), term(b)),
        }
    }
}

/// The values that a value is made of.
fn made_of(value: Value) -> impl Iterator<Item = Place> {
    let places = match value {
        Value::Variable(_) | Value::Constant(_) => [None; 3],
        Value::Negative(a) | Value::Size(a) => [Some(a), None, None],
        Value::Sum(a, b)
        | Value::Difference(a, b)
        | Value::Product(a, b)
        | Value::Quotient(a, b)
        | Value::WithSign(a, b)
        | Value::SignedBy(a, b)
        | Value::AtMost(a, b)
        | Value::Both(a, b)
        | Value::Either(a, b) => [Some(a), Some(b), None],
        Value::Choice(a, b, c) => [Some(a), Some(b), Some(c)],
    };
    places.into_iter().flatten()
}

/// A constant in OpenCL C, which reads a decimal number of enough digits back as the same f64.
fn constant(x: f64) -> String {
    if x.is_finite() { format!("({x:?})") } else { format!("as_double({:#x}UL)", x.to_bits()) }
}
