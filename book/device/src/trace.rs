//! A number that records what is done with it.
//!
//! The methods of the library are written for every [`Number`]. Given this one, a step is taken
//! once, and leaves behind the list of its operations: additions, multiplications and a few others,
//! each of which rounds on a device as it does here. So a kernel is a recording of the method
//! itself, and no method is written twice.

use std::cell::RefCell;
use std::collections::HashMap;
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Sub};

use pendula::internals::sine::sin_and_cos_within;
use pendula::internals::{Apart, Many, Mask, Number};

/// The place of a value on the tape.
pub type Place = usize;

// ANCHOR: value
/// A value: a number, or for the last three what a comparison says.
#[derive(Clone, Copy, Debug, Eq, Hash, PartialEq)]
pub enum Value {
    /// A variable of the kernel, by its index.
    Variable(usize),
    /// A constant, by its bits.
    Constant(u64),
    /// a + b
    Sum(Place, Place),
    /// a − b
    Difference(Place, Place),
    /// a · b
    Product(Place, Place),
    /// a / b
    Quotient(Place, Place),
    /// −a
    Negative(Place),
    /// |a|
    Size(Place),
    /// |a| with the sign of b.
    WithSign(Place, Place),
    /// a with its sign changed where the lowest bit of b is set.
    SignedBy(Place, Place),
    /// b where the comparison a is true, c elsewhere.
    Choice(Place, Place, Place),
    /// a ≤ b
    AtMost(Place, Place),
    /// a and b
    Both(Place, Place),
    /// a or b
    Either(Place, Place),
}
// ANCHOR_END: value

/// What has been recorded: each value once, after those that it is made of.
#[derive(Debug, Default)]
pub struct Tape {
    values: Vec<Value>,
    places: HashMap<Value, Place>,
    depends_on_values: bool,
}

thread_local! {
    static TAPE: RefCell<Tape> = RefCell::default();
}

/// Records what `function` does with numbers on this thread. Returns the tape and what the function
/// returns; `None` if it looks at the value of a number, to branch or to end a loop: a kernel
/// cannot.
pub fn record<R>(function: impl FnOnce() -> R) -> Option<(Tape, R)> {
    let outer = TAPE.take();
    let result = function();
    let tape = TAPE.replace(outer);
    (!tape.depends_on_values).then_some((tape, result))
}

impl Tape {
    /// The values, each after those that it is made of.
    pub fn values(&self) -> &[Value] {
        &self.values
    }

    fn push(&mut self, value: Value) -> Place {
        *self.places.entry(value).or_insert_with(|| {
            self.values.push(value);
            self.values.len() - 1
        })
    }

    fn constant(&self, place: Place) -> Option<f64> {
        match self.values[place] {
            Value::Constant(bits) => Some(f64::from_bits(bits)),
            _ => None,
        }
    }
}

/// A number that records what is done with it.
#[derive(Clone, Copy, Debug)]
pub struct Traced(Place);

/// What a comparison of such numbers says.
#[derive(Clone, Copy, Debug)]
pub struct TracedMask(Place);

impl Traced {
    /// The variable of this index.
    pub fn variable(index: usize) -> Self {
        Self(push(Value::Variable(index)))
    }

    /// A constant.
    pub fn constant(x: f64) -> Self {
        Self(push(Value::Constant(x.to_bits())))
    }

    /// Where it stands on the tape.
    pub fn place(self) -> Place {
        self.0
    }
}

// Inlined, it would be compiled for each operation of each method.
#[inline(never)]
fn push(value: Value) -> Place {
    TAPE.with_borrow_mut(|tape| tape.push(value))
}

/// The place of the result of an operation on `a` and `b`: computed now if both are constants, and
/// `a` itself where it is multiplied by 1.
// Not inlined, as `push`.
#[inline(never)]
fn operation(
    a: Place,
    b: Place,
    value: fn(Place, Place) -> Value,
    now: fn(f64, f64) -> f64,
) -> Traced {
    TAPE.with_borrow_mut(|tape| {
        let value = match (tape.constant(a), tape.constant(b)) {
            (Some(a), Some(b)) => Value::Constant(now(a, b).to_bits()),
            (None, Some(1.0)) if matches!(value(a, b), Value::Product(..)) => return Traced(a),
            _ => value(a, b),
        };
        Traced(tape.push(value))
    })
}

macro_rules! operations {
    ($($Trait:ident, $function:ident, $Value:ident;)+) => {$(
        impl $Trait for Traced {
            type Output = Self;

            fn $function(self, other: Self) -> Self {
                operation(self.0, other.0, Value::$Value, $Trait::$function)
            }
        }

        impl $Trait<f64> for Traced {
            type Output = Self;

            fn $function(self, x: f64) -> Self {
                $Trait::$function(self, Self::constant(x))
            }
        }
    )+};
}
operations! {
    Add, add, Sum;
    Sub, sub, Difference;
    Mul, mul, Product;
    Div, div, Quotient;
}

impl Neg for Traced {
    type Output = Self;

    fn neg(self) -> Self {
        Self(push(Value::Negative(self.0)))
    }
}

impl Number for Traced {
    type Mask = TracedMask;
    type Two = Apart<Self>;

    const COUNT: usize = 2;

    fn splat(self, x: f64) -> Self {
        Self::constant(x)
    }

    /// What `f` looks at is unknown.
    fn map(self, _f: impl FnMut(f64) -> f64) -> Self {
        TAPE.with_borrow_mut(|tape| tape.depends_on_values = true);
        self
    }

    fn abs(self) -> Self {
        Self(push(Value::Size(self.0)))
    }

    fn copysign(self, sign: Self) -> Self {
        Self(push(Value::WithSign(self.0, sign.0)))
    }

    fn signed_by(self, count: Self) -> Self {
        Self(push(Value::SignedBy(self.0, count.0)))
    }

    fn at_most(self, bound: Self) -> TracedMask {
        TracedMask(push(Value::AtMost(self.0, bound.0)))
    }

    fn select(mask: TracedMask, yes: Self, no: Self) -> Self {
        Self(push(Value::Choice(mask.0, yes.0, no.0)))
    }

    /// Beyond a size of the angle another sine is called.
    fn sine(self) -> Self {
        self.map(|x| x)
    }

    /// Within 2²⁰ quarter turns: whoever records it keeps the angle there.
    fn sin_and_cos(self) -> (Self, Self) {
        sin_and_cos_within(self)
    }
}

impl Many for Traced {}

impl BitAnd for TracedMask {
    type Output = Self;

    fn bitand(self, other: Self) -> Self {
        Self(push(Value::Both(self.0, other.0)))
    }
}

impl BitOr for TracedMask {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        Self(push(Value::Either(self.0, other.0)))
    }
}

impl Mask for TracedMask {
    /// Whether it holds is unknown; `true` ends the loops that ask.
    fn all(self) -> bool {
        TAPE.with_borrow_mut(|tape| tape.depends_on_values = true);
        true
    }
}
