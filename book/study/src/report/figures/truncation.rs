//! How many terms of the modified energy's series are best, and what is left then.

use super::Drawing;
use crate::charts::{Axis, Chart, Figure, Style};
use crate::experiments::{Study, truncation};

pub(super) const FIGURES: &[Drawing] = &[Drawing {
    name: "truncation",
    caption: "Above, how well Störmer–Verlet from 1 rad conserves its modified energy if the \
              series ends with the power N of x = ω₀h: the shorter the step, the more terms are \
              of use; none of the series converges. Below, what is left with the best N, against \
              1/x, and how far the separatrix splits. The lines are theory without a constant \
              fitted; all of it is computed in double-double.",
    noise: false,
    draw: truncation,
}];

/// The error against the length of the series, and the smallest one against the step.
fn truncation(_: &Study) -> Figure {
    let powers = |errors: Vec<f64>| {
        let pairs = errors.into_iter().enumerate();
        pairs.map(|(k, error)| (2.0 * k as f64, error)).collect::<Vec<_>>()
    };
    let lengths = Chart::new(
        Axis::linear("N").range(0.0, truncation::ORDER as f64),
        Axis::log("largest change of H̃_{N} (m g L)"),
    )
    .height(260.0);
    let lengths = truncation::STEPS.iter().enumerate().fold(lengths, |chart, (i, x)| {
        let errors = truncation::errors(truncation::THETA_0, *x);
        chart.series(format!("x = {x}"), Style::series(i), powers(errors))
    });
    let least = Chart::new(
        Axis::linear("1/x").range(1.0, truncation::FINEST),
        Axis::log("smallest change, of the best N (m g L)").range(1e-18, 1.0),
    )
    .height(260.0);
    let least = truncation::STARTS.iter().enumerate().fold(least, |chart, (i, theta_0)| {
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
    let least = least.series("splitting of the separatrix", split, truncation::split());
    Figure::new(
        "Optimal truncation",
        "Two charts. Above, the largest change of the modified energy, on a logarithmic axis, \
         against the last power N of its series, from 0 to 40, for three steps. Each curve falls, \
         levels off and rises again: for x = 1 from a tenth to 0.003 near N = 14, and up to \
         thousands; for x = 0.4 down to 10⁻¹¹ near N = 36. Below, the lowest points of such curves \
         against 1/x, from 1 to 5, on a logarithmic axis: two rows of markers scattered by a \
         factor of two about straight lines, from 1 rad a steeper one than from 3 rad. A third row \
         of markers, the splitting of the separatrix, goes down the line of 3 rad to 10⁻¹⁷.",
    )
    .panel(lengths)
    .panel(least)
}
