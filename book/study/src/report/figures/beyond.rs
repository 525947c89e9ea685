//! Figures of the systems beyond the simple pendulum.

use core::f64::consts::PI;

use super::Drawing;
use crate::charts::{Axis, Chart, Figure, Style};
use crate::experiments::{Study, beyond};

pub(super) const FIGURES: &[Drawing] = &[
    Drawing {
        name: "poincare",
        caption: "The driven pendulum at γ = 1.5, seen once a period. A motion that never repeats \
                  stays on one folded curve, and the folds have folds.",
        noise: false,
        draw: poincare,
    },
    Drawing {
        name: "separation",
        caption: "Two double pendulums whose starts differ by 10⁻⁹ rad. Released high, the \
                  distance grows exponentially until they have nothing in common; released low, \
                  they stay together.",
        noise: false,
        draw: separation,
    },
];

/// States on the section; dots that coincide on the drawing are drawn once.
const STATES: usize = 24_000;

/// The strange attractor of the driven pendulum.
fn poincare(_: &Study) -> Figure {
    let (low, high) = (-10.0, 30.0);
    let dots = beyond::poincare(STATES);
    let chart = Chart::new(
        Axis::linear("θ (rad)").range(-PI, PI),
        Axis::linear("ω (rad/s)").range(low, high),
    )
    .height(360.0)
    .series("", Style::numbered(1).dots(), dots.into_iter().map(|z| (z.theta, z.omega)));
    Figure::new(
        "The strange attractor of the driven pendulum",
        "Some thousands of dots in phase space, angle from −π to π, all on a thin band. It rises \
         from the left to a crest, falls steeply through the middle, rises again to the right, \
         folds back on itself several times, and consists of finer bands side by side.",
    )
    .panel(chart)
}

/// How quickly two double pendulums part, released high and low.
fn separation(_: &Study) -> Figure {
    let double = beyond::equals();
    let run = |theta| beyond::separation(&double, theta, 1e-9, (0.002, 10_000));
    let chart = Chart::new(Axis::linear("t (s)").range(0.0, 20.0), Axis::log("distance (rad)"))
        .series("released at 2 and 2.5 rad", Style::numbered(0).line_only(), run([2.0, 2.5]))
        .series("released at 0.2 and 0.25 rad", Style::numbered(1).line_only(), run([0.2, 0.25]));
    Figure::new(
        "Two double pendulums part",
        "The distance of two neighbouring motions on a logarithmic scale over twenty seconds. From \
         a high release it climbs along a straight line, from a thousand-millionth of a radian to \
         several radians, and then levels off. From a low release it stays near where it began.",
    )
    .panel(chart)
}
