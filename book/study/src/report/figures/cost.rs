//! What the same answer costs by each method, one figure for each chapter on methods.

use super::{Drawing, named, style, title};
use crate::charts::{Axis, Chart, Figure, Style};
use crate::experiments::choosing::cost::costs;
use crate::experiments::{PaperMethod, Study};

pub(super) const FIGURES: &[Drawing] = &[
    Drawing {
        name: "cost_forward_euler",
        caption: CAPTION,
        noise: false,
        draw: |_| of_the_paper("forward-euler"),
    },
    Drawing {
        name: "cost_symplectic_euler",
        caption: CAPTION,
        noise: false,
        draw: |_| of_the_paper("symplectic-euler"),
    },
    Drawing {
        name: "cost_stormer_verlet",
        caption: CAPTION,
        noise: false,
        draw: |_| of_the_paper("stormer-verlet"),
    },
    Drawing { name: "cost_rk4", caption: CAPTION, noise: false, draw: |_| of_the_paper("rk4") },
    Drawing { name: "cost_higher_order", caption: CAPTION, noise: false, draw: higher_order },
];

const CAPTION: &str = "Force evaluations for a hundred swings from 1 rad, with the angle never off \
                       by more than a thousandth of a radian, on a logarithmic axis. The bars \
                       are those of this chapter.";

/// A method of each kind in the chapter on higher orders.
const HIGHER: [&str; 4] = ["forest-ruth", "gauss-6", "blanes-moan-6", "processed-6"];

fn of_the_paper(chapter: &str) -> Figure {
    let names = PaperMethod::ALL.map(PaperMethod::name);
    draw(&names, |name| name == chapter)
}

fn higher_order(_: &Study) -> Figure {
    let names = [&PaperMethod::ALL.map(PaperMethod::name)[..], &HIGHER].concat();
    draw(&names, |name| HIGHER.contains(&name))
}

/// Where the axis begins and ends (force evaluations).
const AXIS: (f64, f64) = (1e3, 1e12);

/// A row for each method, from the top: a bar for those of the chapter and a line for the others,
/// both with a marker at the end and the number beside it.
fn draw(names: &[&str], is_of_the_chapter: impl Fn(&str) -> bool) -> Figure {
    let methods: Vec<_> = names.iter().map(|name| named(name)).collect();
    let costs = costs(&methods);
    let rows = names.len() as f64;
    let height = |row: usize| rows - 0.5 - row as f64;
    let ticks = methods.iter().enumerate().map(|(row, method)| (height(row), title(*method)));
    let mut chart = Chart::new(
        Axis::log("force evaluations").range(AXIS.0, AXIS.1),
        Axis::linear("").range(0.0, rows).ticks(ticks),
    )
    .height(34.0 * rows);
    let mut said = Vec::new();
    for (row, (method, cost)) in methods.iter().zip(&costs).enumerate() {
        let (own, y) = (style(*method), height(row));
        let Some(advice) = cost else {
            said.push(format!("{} cannot, at any step", title(*method)));
            chart = chart.note(AXIS.0, y, "cannot, at any step");
            continue;
        };
        let evaluations = advice.evaluations as f64;
        chart = if is_of_the_chapter(names[row]) {
            let corners = [(AXIS.0, 0.3), (evaluations, 0.3), (evaluations, -0.3), (AXIS.0, -0.3)];
            let bar = corners.map(|(x, up)| (x, y + up));
            chart.series("", own.solid().filled(), bar)
        } else {
            chart.series("", Style::REFERENCE, [(AXIS.0, y), (evaluations, y)])
        };
        let end = own.markers_only();
        chart =
            chart.series("", end, [(evaluations, y)]).note(evaluations, y, rounded(evaluations));
        said.push(format!("{} {evaluations:.1e}", title(*method)));
    }
    Figure::new(
        "What the same answer costs",
        format!("A bar or a line for each method on a logarithmic axis. {}.", said.join("; ")),
    )
    .panel(chart)
}

/// The number to two digits, as a label.
fn rounded(evaluations: f64) -> String {
    let printed = format!("{evaluations:.1e}");
    let (mantissa, exponent) = printed.split_once('e').unwrap_or((&printed, "0"));
    format!("{mantissa} × 10^{{{exponent}}}")
}
