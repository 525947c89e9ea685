//! Tests that every method must pass, and tests of single methods.

#[macro_use]
#[path = "../common/each_method.rs"]
mod common;

mod changes_of_variables;
mod known_answers;
mod linear;
mod order;
mod order_conditions;
mod projected;
mod properties;
mod registry;
mod step;
mod taylor;
