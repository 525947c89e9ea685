//! Programs for a device: recorded steps, as OpenCL C.

pub mod steps;

use std::collections::BTreeSet;
use std::fmt::Write as _;

use crate::numbers::Numbers;
use crate::trace::{Place, Tape, Traced, Value, record};

/// A program.
#[derive(Clone, Debug, Eq, PartialEq)]
pub struct Program {
    /// OpenCL C 1.2.
    pub source: String,
    /// The numbers of a state and what a step carries to the next.
    pub numbers: usize,
    /// The additions, subtractions, multiplications and divisions of a step that is not looked at.
    pub operations: usize,
}

/// How a program begins.
const HEAD: &str = "// Made from a recorded step. Each operation is rounded by itself, as on a \
                    processor.\n#pragma OPENCL EXTENSION cl_khr_fp64 : enable\n#pragma OPENCL \
                    FP_CONTRACT OFF\n\n";

/// A step, recorded: what becomes of the numbers of a state and a carry, and of what else is
/// looked at.
struct Recording<const LOOKS: usize> {
    tape: Tape,
    /// The names of the variables: first those that a step only reads, then its numbers.
    names: Vec<String>,
    /// The numbers after the step: state, then carry.
    next: Vec<Place>,
    /// What is looked at after the step.
    looks: [Place; LOOKS],
}

/// A step that is given parameters and the next of its variables, as often as it asks for one, and
/// returns the numbers after it and what is looked at.
type Numbered<'a, const LOOKS: usize> =
    dyn FnOnce(&[Traced], &mut dyn FnMut() -> Traced) -> (Vec<Place>, [Place; LOOKS]) + 'a;

impl<const LOOKS: usize> Recording<LOOKS> {
    /// Records `step`, which is given the variables with the names `parameters`, a state and a
    /// carry, and returns the state after the step, its carry, and what is looked at; `None` if it
    /// depends on values.
    fn of<Z: Numbers<Traced>, C: Numbers<Traced>>(
        parameters: &[&str],
        step: impl FnOnce(&[Traced], Z, C) -> (Z, C, [Place; LOOKS]),
    ) -> Option<Self> {
        Self::of_numbers(
            parameters,
            Box::new(|parameters, mut variable| {
                let (z, carry) = (Z::read(&mut variable), C::read(&mut variable));
                let (z, carry, looks) = step(parameters, z, carry);
                (numbers(z, carry).into_iter().map(Traced::place).collect(), looks)
            }),
        )
    }

    /// The same for a step of numbers, compiled once for all methods.
    fn of_numbers(parameters: &[&str], step: Box<Numbered<'_, LOOKS>>) -> Option<Self> {
        let (tape, (next, looks)) = record(|| {
            let mut variables = (0..).map(Traced::variable);
            let parameters: Vec<Traced> = variables.by_ref().take(parameters.len()).collect();
            step(&parameters, &mut || variables.next().expect("there is no end"))
        })?;
        let numbers = (0..next.len()).map(|i| format!("z{i}"));
        let names = parameters.iter().map(|name| (*name).to_string()).chain(numbers).collect();
        Some(Self { tape, names, next, looks })
    }

    /// The index of the variable of the number `i`.
    fn variable(&self, i: usize) -> usize {
        self.names.len() - self.next.len() + i
    }

    /// The indices of the numbers.
    fn all(&self) -> Vec<usize> {
        (0..self.next.len()).collect()
    }

    /// The name of the number `i`.
    fn name(&self, i: usize) -> &str {
        &self.names[self.variable(i)]
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

    /// Declares the numbers, read from their buffer.
    fn write_loads(&self, out: &mut String) {
        for i in 0..self.next.len() {
            let _ = writeln!(out, "    double {} = numbers[{i} * pendulums + i];", self.name(i));
        }
    }

    /// Writes the numbers back to their buffer.
    fn write_stores(&self, out: &mut String) {
        for i in 0..self.next.len() {
            let _ = writeln!(out, "    numbers[{i} * pendulums + i] = {};", self.name(i));
        }
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
    fn write_values(&self, out: &mut String, places: &[Place]) {
        for place in self.live(places) {
            let value = self.value(place);
            if !matches!(value, Value::Variable(_) | Value::Constant(_)) {
                let is_mask =
                    matches!(value, Value::AtMost(..) | Value::Both(..) | Value::Either(..));
                let (kind, text) = (if is_mask { "int" } else { "double" }, self.operation(value));
                let _ = writeln!(out, "        const {kind} v{place} = {text};");
            }
        }
    }

    /// Gives the numbers `which` their next values, all at once: one may be the value that another
    /// had before the step.
    fn write_moves(&self, out: &mut String, which: &[usize]) {
        let is_variable = |i: usize| matches!(self.value(self.next[i]), Value::Variable(_));
        for &i in which.iter().filter(|i| is_variable(**i)) {
            let _ = writeln!(out, "        const double old{i} = {};", self.term(self.next[i]));
        }
        for &i in which {
            let next = if is_variable(i) { format!("old{i}") } else { self.term(self.next[i]) };
            let _ = writeln!(out, "        {} = {next};", self.name(i));
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

/// The numbers of a state and a carry, one after the other.
fn numbers<N>(state: impl Numbers<N>, carry: impl Numbers<N>) -> Vec<N> {
    let mut numbers = Vec::new();
    let mut write = |x| numbers.push(x);
    state.write(&mut write);
    carry.write(&mut write);
    numbers
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
