//! The largest energy error against the number of steps a period.

use super::{Drawing, named, style, title};
use crate::charts::{Axis, Chart, Figure};
use crate::experiments::{Study, resonance};

pub(super) const FIGURES: &[Drawing] = &[Drawing {
    name: "resonances",
    caption: "The largest energy error over 400 swings from 1 rad, against the number of \
              steps to a period. Dashed is where theory has a numerical swing of just 6, 8, 10 or \
              12 steps: Blanes–Moan 6 has peaks there, up to tens of times as high as its error \
              beside them, and none at odd numbers. Of Störmer–Verlet's only the first stands out \
              of an error that is large anyway.",
    draw: resonances,
}];

/// A chart for each of two methods, with the places that theory gives.
fn resonances(_: &Study) -> Figure {
    let (from, to) = resonance::STEPS;
    let chart = |name: &str| {
        let method = named(name);
        let chart = Chart::new(
            Axis::linear("steps to a period").range(from, to),
            Axis::log(format!("largest energy error ΔH (J), {}", title(method))),
        )
        .height(240.0)
        .series("", style(method).line_only().solid(), resonance::line(method));
        resonance::EVEN.into_iter().fold(chart, |chart, count| {
            let place = resonance::place(count, resonance::tau(method));
            chart.vertical(place, format!("{count} a swing"))
        })
    };
    Figure::new(
        "Step-size resonances",
        "Two charts of the largest energy error, on a logarithmic axis, against the number of \
         steps to a period, from 5 to 12.5. Above, the line of Blanes and Moan's method of order 6 \
         falls from 10⁻⁴ to 10⁻⁸ joules, with sharp peaks at 6, 8 and 10 steps and a small one at \
         12, each on a dashed line; exactly on the line there is a narrow notch. Below, \
         Störmer–Verlet's falls smoothly from two joules to three tenths, but for two narrow peaks \
         with a notch between them, on the dashed line of a swing of six steps near 6.26, and a \
         small notch on that of ten.",
    )
    .panel(chart("blanes-moan-6"))
    .panel(chart("stormer-verlet"))
}
