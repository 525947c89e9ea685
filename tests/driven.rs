//! A driven system: when a method evaluates the force.

mod common;
mod properties;

use common::each_method;
use pendula::{Described, Method};
use properties::driven::{Pushed, check};
use rstest_reuse::apply;

/// Catches: stages at the wrong times, a kick with the force of the other end of the step: the pendulum, which knows no time,
/// sees neither.
#[apply(each_method)]
fn a_push_that_grows_is_followed_to_the_order<M: Described + Method<Pushed>>(#[case] method: M) {
    check(&method).unwrap();
}
