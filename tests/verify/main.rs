//! The suite against itself: wrong methods have to be caught.

#[macro_use]
#[path = "../common/each_method.rs"]
mod common;

#[macro_use]
mod each_impostor;

mod discrimination;
mod end_error;
mod judged;
mod leading_error;
mod looks;
mod metrics;
mod slope_estimator;
mod strangers;
mod thresholds;
mod words;
