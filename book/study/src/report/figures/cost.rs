//! What the same answer costs by each method.

use super::{Drawing, named, style, title};
use crate::charts::{Axis, Chart, Figure};
use crate::experiments::choosing::cost::costs;
use crate::experiments::{PaperMethod, Study};

pub(super) const FIGURES: &[Drawing] = &[Drawing {
    name: "cost",
    caption: "Force evaluations for a hundred swings from 1 rad, with the angle never off by more \
              than a thousandth of a radian: the dearest method first. From one line of the grid \
              to the next on its left there is a hundred times less work.",
    draw: cost,
}];

/// A method of each kind in the chapter on higher orders.
const HIGHER: [&str; 4] = ["forest-ruth", "gauss-6", "blanes-moan-6", "processed-6"];

/// A row for each method, the dearest at the top: a dot with the number beside it.
fn cost(_: &Study) -> Figure {
    let names = PaperMethod::ALL.map(PaperMethod::name).into_iter().chain(HIGHER);
    let methods: Vec<_> = names.map(named).collect();
    let evaluations = costs(&methods).into_iter().map(|advice| advice.map(|it| it.evaluations));
    let mut rows: Vec<_> = methods.into_iter().zip(evaluations).collect();
    rows.sort_by_key(|(_, evaluations)| evaluations.unwrap_or(u64::MAX));
    let height = |row: usize| row as f64 + 0.5;
    let ticks = rows.iter().enumerate().map(|(row, (method, _))| (height(row), title(*method)));
    let (cheapest, dearest) = (1e3, 1e11);
    let mut chart = Chart::new(
        Axis::log("force evaluations").range(cheapest, dearest),
        Axis::linear("").range(0.0, rows.len() as f64).ticks(ticks),
    )
    .height(30.0 * rows.len() as f64);
    let mut said = Vec::new();
    for (row, (method, evaluations)) in rows.into_iter().enumerate() {
        let y = height(row);
        let Some(evaluations) = evaluations.map(|evaluations| evaluations as f64) else {
            chart = chart.note(cheapest, y, "cannot, at any step");
            said.push(format!("{} cannot, at any step", title(method)));
            continue;
        };
        let dot = style(method).markers_only();
        chart = chart.series("", dot, [(evaluations, y)]);
        chart = chart.note(evaluations, y, rounded(evaluations));
        said.push(format!("{} {evaluations:.1e}", title(method)));
    }
    said.reverse();
    Figure::new(
        "What the same answer costs",
        format!("A dot for each method on a logarithmic axis. {}.", said.join("; ")),
    )
    .panel(chart)
}

/// The number to two digits, as a label.
fn rounded(evaluations: f64) -> String {
    let printed = format!("{evaluations:.1e}");
    let (mantissa, exponent) = printed.split_once('e').unwrap_or((&printed, "0"));
    format!("{mantissa} × 10^{{{exponent}}}")
}
