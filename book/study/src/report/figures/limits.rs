//! What long runs show: resonances of the step, how many terms of a modified energy's series are
//! best, and how the width of a proved enclosure grows.

use super::{Drawing, named, style, title};
use crate::charts::{Axis, Chart, Figure, Style};
use crate::experiments::enclosure::{self, Shape};
use crate::experiments::{Study, resonance, truncation};

pub(super) const FIGURES: &[Drawing] = &[
    Drawing {
        name: "resonances",
        caption: "The largest energy error over 400 swings from 1 rad, against the number of steps \
                  to a period. Dashed is where theory has a numerical swing of just 6, 8, 10 or 12 \
                  steps: Blanes–Moan 6 has peaks there, up to tens of times as high as its error \
                  beside them, and none at odd numbers. Of Störmer–Verlet's only the first stands \
                  out of an error that is large anyway.",
        draw: resonances,
    },
    Drawing {
        name: "truncation",
        caption: "How well Störmer–Verlet from 1 rad conserves its modified energy if the series \
                  ends with the power N of x = ω₀h. Each curve turns upwards after its best N, and \
                  the shorter the step, the later: none of the series converges.",
        draw: lengths,
    },
    Drawing {
        name: "least_change",
        caption: "What is left with the best N, against 1/x, and how far the separatrix splits: \
                  both fall exponentially. The lines are theory without a constant fitted; all of \
                  it is computed in double-double.",
        draw: least,
    },
    Drawing {
        name: "widths",
        caption: "The width of what is proved of the angle, from rest at 1 rad. If each step hands \
                  on a box along the axes, the next one has to enclose a turned box by a larger \
                  one, and the width grows exponentially. Rectangles that turn with the motion \
                  grow as the square of time, along the guide.",
        draw: widths,
    },
];

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

/// The error against the length of the series.
fn lengths(_: &Study) -> Figure {
    let axis = Axis::log("largest change of H̃_{N} (m g L)").range(1e-12, 1e4);
    let chart =
        Chart::new(Axis::linear("last power N of x").range(0.0, truncation::ORDER as f64), axis)
            .height(280.0);
    let chart = truncation::STEPS.into_iter().enumerate().fold(chart, |chart, (i, x)| {
        let errors = truncation::errors(truncation::THETA_0, x).into_iter().enumerate();
        let line = errors.map(|(k, error)| (2.0 * k as f64, error));
        let (power, least) = truncation::best(truncation::THETA_0, x);
        let (style, best) = (Style::series(i), (power as f64, least));
        chart
            .series(format!("x = {x}"), style.line_only().solid(), line)
            .series("", style.markers_only(), [best])
            .note(best.0, best.1, format!("best: {power}"))
    });
    Figure::new(
        "Optimal truncation",
        "The largest change of the modified energy, on a logarithmic axis, against the last power \
         N of its series, from 0 to 40, for three steps. Each curve falls to a marker, the best N, \
         and rises again: for x = 1 from a tenth to 0.003 near N = 14, and up to ten thousand; for \
         x = 0.6 to a millionth; for x = 0.4 down to 10⁻¹¹ near N = 36.",
    )
    .panel(chart)
}

/// The smallest error against the step.
fn least(_: &Study) -> Figure {
    let chart = Chart::new(
        Axis::linear("1/x").range(1.0, truncation::FINEST),
        Axis::log("smallest change, of the best N (m g L)").range(1e-18, 1.0),
    )
    .height(260.0);
    let chart = truncation::STARTS.iter().enumerate().fold(chart, |chart, (i, theta_0)| {
        let (label, style) = (format!("from {theta_0} rad"), Style::series(3 + i));
        let law = truncation::inverse_steps();
        let law = law.map(|inverse| (inverse, truncation::law(*theta_0, 1.0 / inverse)));
        chart.series("theory", Style::REFERENCE, law).series(
            label,
            style.markers_only(),
            truncation::least(*theta_0),
        )
    });
    let split = Style::series(5).markers_only();
    Figure::new(
        "What the best number of terms leaves",
        "The lowest points of the curves of optimal truncation against 1/x, from 1 to 5, on a \
         logarithmic axis: two rows of markers scattered by a factor of two about straight lines, \
         from 1 rad a steeper one than from 3 rad. A third row of markers, the splitting of the \
         separatrix, goes down the line of 3 rad to 10⁻¹⁷.",
    )
    .panel(chart.series("splitting of the separatrix", split, truncation::split()))
}

/// Widths of the bounds of the angle against time, for both shapes.
fn widths(_: &Study) -> Figure {
    let series = |shape| enclosure::widths(shape);
    let chart = Chart::new(
        Axis::log("t (s)").range(0.2, 60.0),
        Axis::log("width of the bounds of θ (rad)"),
    )
    .series("rectangles, turned", Style::series(0).line_only(), series(Shape::Turned))
    .series("boxes", Style::series(1).line_only(), series(Shape::Box))
    .slope(2.0, (2.0, 1e-12), 40.0, "slope 2");
    Figure::new(
        "The width of an enclosure",
        "The width of the bounds of the angle against time, both axes logarithmic, from some \
         10⁻¹⁵ radians at a quarter of a second. One line, of boxes, bends upwards and leaves the \
         chart at a tenth of a radian after 15 seconds. The other, of turned rectangles, jagged, \
         rises along a guide of slope two to some 10⁻¹⁰ radians after 50 seconds.",
    )
    .panel(chart)
}
