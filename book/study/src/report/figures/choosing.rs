//! A map for choosing an integrator.

use pendula::METHODS;

use super::{Drawing, title};
use crate::charts::{Axis, Cell, Chart, Figure, Map, Name};
use crate::digits::Digits;
use crate::experiments::{MethodRef, Study, choosing};

pub(super) const FIGURES: &[Drawing] = &[Drawing {
    name: "decision",
    caption: "Which method keeps the angle within an error allowed, over a run of a given length, \
              with the fewest force evaluations. The fuller the colour, the more evaluations the \
              second best needs; where it is pale, any of the neighbours will do. In the corner at \
              the lower right the rounding of an f64 alone may be larger than what is allowed. A \
              mouse that rests on a cell shows its step and its evaluations.",
    noise: false,
    draw: decision,
}];

/// How many more evaluations the second best needs, as a share of those of the best: from where on,
/// how opaque, and what the legend says.
const SHADES: [(f64, f64, &str); 4] = [
    (0.0, 0.25, "second best within 5 %"),
    (0.05, 0.5, "25 %"),
    (0.25, 0.75, "60 %"),
    (0.6, 1.0, "more"),
];

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

/// The methods that are the best in a cell, in the order of the library.
fn winners(map: &[choosing::Cell]) -> Vec<MethodRef> {
    let is_best = |method: &MethodRef| {
        let mut best = map.iter().filter_map(|cell| cell.ranking.first());
        best.any(|best| title(best.method) == title(*method))
    };
    METHODS.iter().copied().filter(is_best).collect()
}

/// What stands on the map where a cell is.
fn cell(winners: &[MethodRef], cell: &choosing::Cell) -> Cell {
    let periods = if cell.periods == 1 { "period" } else { "periods" };
    let allowed = Digits::Scientific(2).print(cell.allowed);
    let place = format!("{} {periods}, error {allowed} rad", cell.periods);
    let Some(best) = cell.ranking.first() else {
        return Cell { name: winners.len(), shade: 0, hover: format!("{place}: lost in rounding") };
    };
    let name = winners.iter().position(|winner| title(*winner) == title(best.method));
    let second = cell.ranking.get(1);
    let lead = second
        .map_or(f64::INFINITY, |second| second.evaluations as f64 / best.evaluations as f64 - 1.0);
    let shade = SHADES.iter().rposition(|(from, ..)| lead >= *from);
    let second = second.map_or("no other can".into(), |second| {
        format!("{} needs {:.0} % more", title(second.method), 100.0 * lead)
    });
    let hover = format!(
        "{place}: {}, {} steps a period, {} evaluations; {second}",
        title(best.method),
        best.steps,
        best.evaluations
    );
    Cell { name: name.expect("a winner"), shade: shade.unwrap_or(0), hover }
}

/// The regions in which each of the methods is the cheapest.
fn decision(_: &Study) -> Figure {
    let map = choosing::map();
    let winners = winners(&map);
    let (x, y) =
        (edges(&choosing::PERIODS.map(|periods| periods as f64)), edges(&choosing::allowed()));
    let named = winners.iter().enumerate().map(|(i, method)| Name {
        title: title(*method).into(),
        short: (i + 1).to_string(),
        colour: Some(i),
    });
    let lost = Name { title: "lost in rounding".into(), short: String::new(), colour: None };
    let ends = |edges: &[f64]| (edges[0], edges[edges.len() - 1]);
    let ((shortest, longest), (largest, smallest)) = (ends(&x), ends(&y));
    let regions =
        Map::new(x, y, named.chain([lost]), map.iter().map(|place| cell(&winners, place)))
            .shades(SHADES.map(|(_, opacity, label)| (opacity, label.into())));
    let chart = Chart::new(
        Axis::log("length of the run (periods)").range(shortest, longest),
        Axis::log("largest angle error allowed (rad)").range(smallest, largest),
    )
    .height(420.0)
    .map(regions);
    Figure::new(
        "Which method needs the fewest force evaluations",
        "A map of areas on logarithmic axes: the length of the run, from one period to a hundred \
         thousand, across, and the largest angle error allowed, from a tenth to a \
         ten-thousand-millionth of a radian, upwards. Each area is that of the cheapest method. \
         Deuflhard's has the upper left corner, where runs are short and errors large; the \
         processed method of order 4 the upper edge; that of order 6 a broad band below it, from \
         the left to the lower right; Blanes and Moan's of order 6 most of what is below that, and \
         Taylor series the lower middle. Single cells of DOP853 and of Blanes and Moan's method of \
         order 4 lie between. The lower right corner, small errors over long runs, is empty: \
         rounding does not let any method be so exact.",
    )
    .panel(chart)
}
