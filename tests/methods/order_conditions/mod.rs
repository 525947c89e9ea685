//! The coefficient tables of the methods against the conditions of their order: a file for each
//! family.

mod implicit;
mod processed;
mod runge_kutta;
mod splitting;
