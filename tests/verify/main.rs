//! The suite against itself: wrong methods and wrong metrics have to be caught.

#[path = "../common/each_method.rs"]
mod common;

mod discrimination;
mod each_impostor;
mod end_error;
mod judged;
mod metric_checks;
mod metrics;
mod slope_estimator;
mod strangers;
mod wrong_metrics;
