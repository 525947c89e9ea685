//! Curves and shapes in phase space, for the study and for the lab: the energy that symplectic
//! Euler conserves, its level curves, polygons with their areas, and the parts of a step; and
//! [`dynamics`], the analysis of driven systems.
//!
//! Nothing is allocated, as the lab has no heap.
#![no_std]

pub mod dynamics;
pub mod level_curve;
pub mod parts;
pub mod point;
pub mod shapes;
pub mod symplectic_euler;
