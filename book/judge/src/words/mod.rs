//! What is said of findings: the only place where data become sentences. No verdict depends on
//! what stands here.

mod advice;
mod causes;
mod departure;
mod equation;
mod expansion;
mod finding;
mod identity;
pub mod numbers;
mod report;
mod rows;
pub mod solver_cause;
mod solver_finding;
mod trouble;

pub use advice::sign_of_slopes;
