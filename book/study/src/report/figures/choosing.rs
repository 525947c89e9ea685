//! A map for choosing an integrator, and what the same answer costs by each method.

use pendula::METHODS;

use super::{named, style, title};
use crate::charts::{Axis, Cell, Chart, Figure, Fill, Map, Name};
use crate::digits::Digits;
use crate::experiments::{MethodRef, PaperMethod, Study, choosing};

/// Unless the second best needs more evaluations than the best by this share of them, none is said
/// to be ahead.
const TIE: f64 = 0.25;

/// Half-way between neighbours on a logarithmic axis, and as far beyond the first and the last as
/// they are from their neighbours.
fn edges(values: &[f64]) -> Vec<f64> {
    let middle = |a: f64, b: f64| libm::sqrt(a * b);
    let [first, second, .., before, last] = *values else { panic!("no axis: {values:?}") };
    let inner = values.windows(2).map(|pair| middle(pair[0], pair[1]));
    let mut edges = vec![first * first / middle(first, second)];
    edges.extend(inner);
    edges.push(last * last / middle(before, last));
    edges
}

/// How many more evaluations the second best needs, as a share of those of the best.
fn lead(ranking: &[choosing::Advice]) -> Option<f64> {
    let evaluations = |place: usize| ranking.get(place).map(|advice| advice.evaluations as f64);
    let best = evaluations(0)?;
    Some(evaluations(1).map_or(f64::INFINITY, |second| second / best - 1.0))
}

/// The methods that are ahead in a cell, in the order of the library.
fn winners(map: &[choosing::Cell]) -> Vec<MethodRef> {
    let is_ahead = |method: &MethodRef| {
        let clear = map.iter().filter(|cell| lead(&cell.ranking).is_some_and(|lead| lead >= TIE));
        clear.map(|cell| cell.ranking[0].method).any(|best| title(best) == title(*method))
    };
    METHODS.iter().copied().filter(is_ahead).collect()
}

/// What stands on the map where a cell is: the names are those of the winners, that of ties, and
/// that of no method at all.
fn cell(winners: &[MethodRef], cell: &choosing::Cell) -> Cell {
    let periods = if cell.periods == 1 { "period" } else { "periods" };
    let allowed = Digits::Scientific(2).print(cell.allowed);
    let place = format!("{} {periods} to {allowed} rad", cell.periods);
    let Some((best, lead)) = cell.ranking.first().zip(lead(&cell.ranking)) else {
        let says = ["Lost in rounding".into(), place];
        return Cell { name: winners.len() + 1, number: None, says };
    };
    let ahead = winners.iter().position(|winner| title(*winner) == title(best.method));
    let name = ahead.filter(|_| lead >= TIE);
    let second = cell.ranking.get(1).map_or("no other can".into(), |second| {
        format!("{} needs {:.0} % more", title(second.method), 100.0 * lead)
    });
    let (steps, evaluations) = (best.steps, best.evaluations);
    let says = [
        format!("{}, {steps} steps a period, {evaluations} evaluations", title(best.method)),
        format!("{place}; {second}"),
    ];
    Cell { name: name.unwrap_or(winners.len()), number: name.map(|_| steps), says }
}

/// The regions in which each of the methods is the cheapest.
pub(super) fn decision(_: &Study, figure: Figure) -> Figure {
    let map = choosing::map();
    let winners = winners(&map);
    let (x, y) =
        (edges(&choosing::PERIODS.map(|periods| periods as f64)), edges(&choosing::allowed()));
    let named = winners.iter().enumerate();
    let named = named.map(|(i, method)| (title(*method), Fill::Colour(i)));
    let others = [("no clear winner", Fill::Hatch), ("lost in rounding", Fill::Paper)];
    let names = named.chain(others).map(|(title, fill)| Name { title: title.into(), fill });
    let ends = |edges: &[f64]| (edges[0], edges[edges.len() - 1]);
    let ((shortest, longest), (largest, smallest)) = (ends(&x), ends(&y));
    let prompt = [
        "A tap on a cell, or a mouse that rests there, shows here",
        "its steps, its evaluations, and what the second best needs.",
    ];
    let regions = Map {
        x,
        y,
        names: names.collect(),
        cells: map.iter().map(|place| cell(&winners, place)).collect(),
        unit: "steps".into(),
        prompt: prompt.map(String::from),
    };
    let chart = Chart::new(
        Axis::log("length of the run (periods)").range(shortest, longest),
        Axis::log("largest angle error allowed (rad)").range(smallest, largest),
    )
    .height(420.0)
    .map(regions);
    figure.panel(chart)
}

// -------------------------------------------------------------------------------------------------
// What the same answer costs
// -------------------------------------------------------------------------------------------------

/// A method of each kind in the chapter on higher orders.
const HIGHER: [&str; 4] = ["forest-ruth", "gauss-6", "blanes-moan-6", "processed-6"];

/// A row for each method, the dearest at the top: a dot with the number beside it.
pub(super) fn cost(_: &Study, figure: Figure) -> Figure {
    let names = PaperMethod::ALL.map(PaperMethod::name).into_iter().chain(HIGHER);
    let methods: Vec<_> = names.map(named).collect();
    let evaluations =
        choosing::costs(&methods).into_iter().map(|advice| advice.map(|it| it.evaluations));
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
    figure.saying(&format!("{}.", said.join("; "))).panel(chart)
}

/// The number to two digits, as a label.
fn rounded(evaluations: f64) -> String {
    let printed = format!("{evaluations:.1e}");
    let (mantissa, exponent) = printed.split_once('e').unwrap_or((&printed, "0"));
    format!("{mantissa} × 10^{{{exponent}}}")
}
