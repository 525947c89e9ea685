//! What long runs show: resonances of the step, how many terms of a modified energy's series are
//! best, and how the width of a proved enclosure grows.

use super::{named, style, title};
use crate::charts::{Axis, Chart, Figure, Style};
use crate::experiments::enclosure::{self, Shape};
use crate::experiments::{Study, resonance, truncation};

/// A chart for each of two methods, with the places that theory gives.
pub(super) fn resonances(_: &Study, figure: Figure) -> Figure {
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
    figure.panel(chart("blanes-moan-6")).panel(chart("stormer-verlet"))
}

/// The error against the length of the series.
pub(super) fn truncation(_: &Study, figure: Figure) -> Figure {
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
    figure.panel(chart)
}

/// The smallest error against the step.
pub(super) fn least_change(_: &Study, figure: Figure) -> Figure {
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
    figure.panel(chart.series("splitting of the separatrix", split, truncation::split()))
}

/// Widths of the bounds of the angle against time, for both shapes.
pub(super) fn widths(_: &Study, figure: Figure) -> Figure {
    let series = |shape| enclosure::widths(shape);
    let chart = Chart::new(
        Axis::log("t (s)").range(0.2, 60.0),
        Axis::log("width of the bounds of θ (rad)"),
    )
    .series("rectangles, turned", Style::series(0).line_only(), series(Shape::Turned))
    .series("boxes", Style::series(1).line_only(), series(Shape::Box))
    .slope(2.0, (2.0, 1e-12), 40.0, "slope 2");
    figure.panel(chart)
}
