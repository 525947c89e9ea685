//! The coefficients of the methods that are tables, held to the conditions of their order: a file
//! for each family.

mod gauss;
mod runge_kutta;
mod splitting;
