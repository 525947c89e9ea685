//! A square of initial conditions and its images under a method.

use pendula::{Grid, Pendulum, Phase};

use super::MethodRef;

/// A square of phase space in the coordinates (θ, ω/ω₀), in which small swings are circles.
#[derive(Clone, Copy, Debug)]
pub struct Square {
    /// Its centre.
    pub centre: Phase,
    /// Its side (rad).
    pub side: f64,
}

impl Square {
    /// `count` points along each side, evenly spaced and anticlockwise from the lower left corner.
    pub fn outline(&self, pendulum: &Pendulum, count: u32) -> Vec<Phase> {
        let frequency = pendulum.small_angle_frequency();
        let point = |u: f64, v: f64| Phase {
            theta: self.centre.theta + self.side * (u - 0.5),
            omega: self.centre.omega + frequency * self.side * (v - 0.5),
        };
        let shares = || (0..count).map(|n| f64::from(n) / f64::from(count));
        let lower = shares().map(|s| point(s, 0.0));
        let right = shares().map(|s| point(1.0, s));
        let upper = shares().map(|s| point(1.0 - s, 1.0));
        let left = shares().map(|s| point(0.0, 1.0 - s));
        lower.chain(right).chain(upper).chain(left).collect()
    }
}

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

/// The area (rad²/s) of the polygon with these corners: positive if they go round it anticlockwise.
pub fn area(corners: &[Phase]) -> f64 {
    // Relative to the first corner, so that a small polygon far from the origin keeps its digits.
    let Some(first) = corners.first() else { return 0.0 };
    let from_first = |z: &Phase| (z.theta - first.theta, z.omega - first.omega);
    let twice = |pair: &[Phase]| {
        let ((a, b), (c, d)) = (from_first(&pair[0]), from_first(&pair[1]));
        a * d - b * c
    };
    0.5 * corners.windows(2).map(twice).sum::<f64>()
}
