//! Tests that every method must pass, and tests of single methods.

#[macro_use]
#[path = "../common/each_method.rs"]
mod common;

mod area;
mod changes_of_variables;
mod error_constant;
mod known_answers;
mod linear;
mod order;
mod order_conditions;
mod pendulum_symmetries;
mod registry;
mod step;
mod step_matrix;
mod taylor;
mod time_reversal;
mod work;
