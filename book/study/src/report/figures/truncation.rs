//! How many terms of the modified energy's series are best, and what is left then.

use super::Drawing;
use crate::charts::{Axis, Chart, Figure, Style};
use crate::experiments::{Study, truncation};

pub(super) const FIGURES: &[Drawing] = &[
    Drawing {
        name: "truncation",
        caption: "How well Störmer–Verlet from 1 rad conserves its modified energy if the series \
                  ends with the power N of x = ω₀h. Each curve turns upwards after its best N, \
                  and the shorter the step, the later: none of the series converges.",
        draw: lengths,
    },
    Drawing {
        name: "least_change",
        caption: "What is left with the best N, against 1/x, and how far the separatrix splits: \
                  both fall exponentially. The lines are theory without a constant fitted; all of \
                  it is computed in double-double.",
        draw: least,
    },
];

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
