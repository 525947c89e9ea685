//! Shared by the tests: a function as a test for each method, its steps behind a pointer, and what
//! several files need.
//!
//! A test takes a method as `&dyn AnyMethod`, and looks up what else it needs of it by its name, so
//! that the loops of all methods are compiled once, with the library, and not with each program of
//! tests again.
#![allow(dead_code, unused_macros, reason = "not every program of tests needs all")]

use std::num::NonZeroU64;

use pendula::fast::{InLanes, PendulumSteps};
use pendula::integrate::{Run, Steps};
use pendula::methods::table::{Listed, in_lanes};
use pendula::systems::Numbers;
use pendula::{AnyMethod, Error, Grid, Observer, Pendulum, Phase, System, method_named};

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

/// The paper's, and one with L ≠ 1, m ≠ 1 and another ω₀.
pub fn pendulums() -> [Pendulum; 2] {
    [Pendulum::PAPER, Pendulum::new(9.81, 2.5, 0.7).unwrap()]
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

/// The steps of the method on the pendulum.
pub fn steps(method: &dyn AnyMethod) -> &dyn PendulumSteps {
    method.steps().expect("a method of the library")
}

/// The steps of the method on another system.
pub fn steps_on<S: Listed>(method: &dyn AnyMethod) -> &'static dyn Steps<S> {
    S::steps(method.info().name).expect("a method that suits the system")
}

/// The steps of the method in lanes.
pub fn lanes(method: &dyn AnyMethod) -> &'static dyn InLanes {
    in_lanes(method.info().name).expect("a method of the library")
}

/// [`pendula::try_integrate`] with the method behind a pointer.
pub fn try_integrate<S: System<State: Numbers> + Copy>(
    system: &S,
    method: &dyn Steps<S>,
    start: S::State,
    grid: &Grid,
    observer: &mut dyn Observer<S::State>,
) -> Result<S::State, Error> {
    observer.observe(0, 0.0, start);
    Run::start(system, method, start, grid).advance(grid.steps(), NonZeroU64::MIN, observer)
}
