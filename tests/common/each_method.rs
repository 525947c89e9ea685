//! Shared by the tests: a function as a test for each method, the method on other systems, and what
//! several files need.
//!
//! A test takes a method as `&dyn AnyMethod`, and looks up what else it needs of it by its name, so
//! that the loops of all methods are compiled once, with the library, and not with each program of
//! tests again.
#![allow(dead_code, unused_macros, reason = "not every program of tests needs all")]

use pendula::internals;
use pendula::registry::ByName;
use pendula::{AnyMethod, Observer, Pendulum, Phase, method_named};

/// Makes of the function `$test` a test for each case, of whatever types its arguments are, in a
/// module of the same name: `the_function::the_case`.
macro_rules! cases {
    ($test:ident: $($case:ident($($argument:expr),+),)+) => {
        mod $test {
            #[allow(unused_imports, reason = "arguments may need none of it")]
            use super::*;

            $(#[test]
            fn $case() {
                super::$test($($argument),+);
            })+
        }
    };
}

/// Makes of the function `$test` a test with a case for each method of the library's list, so that
/// every test also runs on a new method: `the_function::of::case_03_rk4`.
macro_rules! each_method {
    ($test:ident) => {
        pendula::for_each_method! { by_name, => $test }
    };
}

/// The same for the methods that also apply to systems other than the pendulum.
macro_rules! each_general_method {
    ($test:ident) => {
        pendula::for_each_general_method! { by_name, => $test }
    };
}

/// The same with the type of each method, for a system that the library's table leaves out. This
/// compiles a loop for each.
macro_rules! each_method_type {
    ($test:ident) => {
        pendula::for_each_method! { by_type, => $test }
    };
}

macro_rules! each_general_method_type {
    ($test:ident) => {
        pendula::for_each_general_method! { by_type, => $test }
    };
}

macro_rules! by_type {
    ($($module:ident::$method:ident,)+ => $test:ident) => {
        cases! { $test: $($module(&pendula::methods::$method),)+ }
    };
}

macro_rules! by_name {
    ($($module:ident::$method:ident,)+ => $test:ident) => {
        mod $test {
            #[rstest::rstest]
            $(#[case::$module(crate::common::method(stringify!($module)))])+
            fn of(#[case] method: &'static dyn pendula::AnyMethod) {
                super::$test(method);
            }
        }
    };
}

/// L ≠ 1, m ≠ 1 and ω₀ ≠ 1, so that a missing factor shows.
pub fn pendulum() -> Pendulum {
    Pendulum::new(9.81, 2.5, 0.7).unwrap()
}

/// The paper's, and that one.
pub fn pendulums() -> [Pendulum; 2] {
    [Pendulum::PAPER, pendulum()]
}

/// The bits of a state; those of all NaNs are the same.
pub fn bits(z: Phase) -> [u64; 2] {
    [z.theta, z.omega].map(|x| if x.is_nan() { f64::NAN.to_bits() } else { x.to_bits() })
}

/// Keeps n and the bits of time and state of every sample, so that a zero differs from a negative
/// zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Samples(pub Vec<(u64, u64, [u64; 2])>);

impl Observer<Phase> for Samples {
    fn observe(&mut self, n: u64, t: f64, z: Phase) {
        self.0.push((n, t.to_bits(), bits(z)));
    }
}

/// Keeps the states, and is satisfied with the first `N`.
#[derive(Clone, Default)]
pub struct First<const N: usize>(pub Vec<Phase>);

impl<const N: usize> Observer<Phase> for First<N> {
    fn observe(&mut self, _n: u64, _t: f64, z: Phase) {
        self.0.push(z);
    }

    fn is_satisfied(&self) -> bool {
        self.0.len() == N
    }
}

/// The method in the file `module`.rs.
pub fn method(module: &str) -> &'static dyn AnyMethod {
    method_named(&module.replace('_', "-")).expect("a file has the name of its method")
}

/// The method on the pendulum with the time in seconds.
pub fn in_seconds(method: &dyn AnyMethod) -> &'static dyn AnyMethod {
    internals::in_seconds(method.info().name).expect("a method of the library")
}

/// The method on another system.
pub fn on<S: ByName>(method: &dyn AnyMethod) -> &'static dyn AnyMethod<S> {
    method_named(method.info().name).expect("a method that suits the system")
}

/// The generator SplitMix64 (Steele, Lea, Flood, *OOPSLA* 2014).
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The sequence that begins at `seed`.
    pub const fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// 64 random bits.
    pub const fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let x = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        x ^ (x >> 31)
    }

    /// A number evenly between `low` and `high`.
    pub const fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.bits() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// A whole number below `count`.
    pub const fn below(&mut self, count: usize) -> usize {
        (self.bits() % count as u64) as usize
    }

    /// One of `choices`.
    pub const fn one_of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len())]
    }

    /// Any f64: in one of four cases a special one, otherwise 64 random bits or an ordinary number.
    pub fn number(&mut self) -> f64 {
        const SPECIAL: [f64; 16] = [
            0.0,
            -0.0,
            5e-324,
            -5e-324,
            2.225_073_858_507_201e-308,
            f64::MIN_POSITIVE,
            1e-160,
            1.0,
            -1.0,
            1e15,
            1e160,
            f64::MAX,
            f64::MIN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::NAN,
        ];
        match self.below(4) {
            0 => self.one_of(&SPECIAL),
            1 => self.between(-10.0, 10.0),
            _ => f64::from_bits(self.bits()),
        }
    }
}
