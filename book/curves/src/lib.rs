//! Curves and shapes in phase space, for the study and for the lab: the energy that symplectic
//! Euler conserves, its level curves, polygons with their areas, and the parts of a step;
//! [`kepler`], a planet and its ellipse; and [`dynamics`], the analysis of motions.
//!
//! Nothing is allocated, as the lab has no heap.
#![no_std]

pub mod dynamics;
pub mod kepler;
pub mod level_curve;
pub mod parts;
pub mod point;
pub mod shapes;
pub mod symplectic_euler;

use pendula::Error;

/// Returns `value` if it `fits`; otherwise the error says what is `allowed`.
fn checked(
    name: &'static str,
    value: f64,
    fits: bool,
    allowed: &'static str,
) -> Result<f64, Error> {
    if fits { Ok(value) } else { Err(Error::Parameter { name, value, allowed }) }
}
