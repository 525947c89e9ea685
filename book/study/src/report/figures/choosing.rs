//! A map for choosing an integrator, and what the same answer costs by each method.

use pendula::METHODS;

use super::{area, named, style, title};
use crate::charts::{Axis, Cell, Chart, Figure, Fill, Map, Name};
use crate::digits::Digits;
use crate::experiments::{MethodRef, PaperMethod, Study, choosing};

/// A method will do where it needs at most this share more evaluations than the best.
const MARGIN: f64 = 0.5;

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

/// Those that will do in a cell.
fn able(cell: &choosing::Cell) -> impl Iterator<Item = &choosing::Advice> {
    let best = cell.ranking.first().map_or(0.0, |best| best.evaluations as f64);
    cell.ranking.iter().take_while(move |it| it.evaluations as f64 <= (1.0 + MARGIN) * best)
}

/// Few methods of which one will do in each cell: that which will do in most cells, then that which
/// will do in most of the others, and so on.
fn few(map: &[choosing::Cell]) -> Vec<MethodRef> {
    let will_do = |cell: &choosing::Cell, method: MethodRef| {
        able(cell).any(|advice| title(advice.method) == title(method))
    };
    let mut left: Vec<&choosing::Cell> =
        map.iter().filter(|cell| !cell.ranking.is_empty()).collect();
    let mut few = Vec::new();
    while !left.is_empty() {
        let count = |method: &MethodRef| left.iter().filter(|cell| will_do(cell, *method)).count();
        // The first of equals.
        let next = METHODS.iter().copied().rev().max_by_key(count).expect("methods");
        left.retain(|cell| !will_do(cell, next));
        few.push(next);
    }
    few
}

/// What stands on the map where a cell is. The names are those of the few methods in the order of
/// the `names`, and that of no method at all.
fn cell(few: &[MethodRef], names: &[MethodRef], cell: &choosing::Cell) -> Cell {
    let periods = if cell.periods == 1 { "period" } else { "periods" };
    let allowed = Digits::Scientific(2).print(cell.allowed);
    let place = format!("{} {periods} to {allowed} rad", cell.periods);
    let same =
        |advice: &choosing::Advice, method: &MethodRef| title(advice.method) == title(*method);
    let of = |method| able(cell).find(|advice| same(advice, method));
    let Some(taken) = few.iter().find_map(of) else {
        return Cell { name: names.len(), number: None, says: ["Lost in rounding".into(), place] };
    };
    let name = names.iter().position(|method| same(taken, method)).expect("one of the few");
    let (steps, evaluations) = (taken.steps, taken.evaluations);
    let how = if taken.extrapolated { " by the law" } else { "" };
    let other = cell.ranking.iter().find(|advice| !same(advice, &taken.method));
    let other = other.map_or("no other can".into(), |other| {
        let part = 100.0 * (other.evaluations as f64 / evaluations as f64 - 1.0);
        let word = if part < 0.0 { "less" } else { "more" };
        format!("{} needs {:.0} % {word}", title(other.method), part.abs())
    });
    let says = [
        format!("{}, {steps} steps a period, {evaluations} evaluations{how}", title(taken.method)),
        format!("{place}; {other}"),
    ];
    Cell { name, number: Some(libm::round(steps) as u64), says }
}

/// The regions in which each of a few methods will do, for the swing of the chapter.
pub(super) fn decision(_: &Study, figure: Figure) -> Figure {
    figure.panel(regions(choosing::THETA_0).height(420.0))
}

/// The same for a swing of `theta_0` (rad).
pub(super) fn other_swing(theta_0: f64, figure: Figure) -> Figure {
    figure.panel(regions(theta_0).height(300.0))
}

fn regions(theta_0: f64) -> Chart {
    let map = choosing::map(theta_0);
    let few = few(map);
    let mut ordered = few.clone();
    let place = |method: &MethodRef| METHODS.iter().position(|it| title(*it) == title(*method));
    ordered.sort_by_key(place);
    let mut columns: Vec<f64> = map.iter().map(|cell| cell.periods as f64).collect();
    columns.dedup();
    let rows: Vec<f64> = map[..map.len() / columns.len()].iter().map(|cell| cell.allowed).collect();
    let (x, y) = (edges(&columns), edges(&rows));
    let named = ordered.iter().map(|method| (title(*method), Fill::Colour(area(*method))));
    let lost = ("lost in rounding", Fill::Paper);
    let names = named.chain([lost]).map(|(title, fill)| Name { title: title.into(), fill });
    let ends = |edges: &[f64]| (edges[0], edges[edges.len() - 1]);
    let ((shortest, longest), (largest, smallest)) = (ends(&x), ends(&y));
    let prompt = [
        "A tap on a cell, or a mouse that rests there, shows here",
        "its steps, its evaluations, and what the best other method needs.",
    ];
    let regions = Map {
        x,
        y,
        names: names.collect(),
        cells: map.iter().map(|place| cell(&few, &ordered, place)).collect(),
        unit: "steps".into(),
        prompt: prompt.map(String::from),
    };
    Chart::new(
        Axis::log("length of the run (periods)").range(shortest, longest),
        Axis::log("largest angle error allowed (rad)").range(smallest, largest),
    )
    .map(regions)
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
