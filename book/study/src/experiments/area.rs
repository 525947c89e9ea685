//! Points of a shape, carried by a method.

use pendula::{Grid, Pendulum, Phase};

use super::MethodRef;

/// The images of the points of `outline` at each sample of `grid`, from the outline itself on.
pub fn carried(
    method: MethodRef,
    pendulum: &Pendulum,
    outline: &[Phase],
    grid: &Grid,
) -> Vec<Vec<Phase>> {
    let mut images = vec![Vec::with_capacity(outline.len()); grid.samples() as usize];
    for start in outline {
        let mut note = |n: u64, _: f64, z: Phase| images[n as usize].push(z);
        method.run(pendulum, *start, grid, &mut note);
    }
    images
}
