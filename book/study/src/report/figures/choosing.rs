//! A map for choosing an integrator.

use pendula::METHODS;

use super::{Drawing, style, title};
use crate::charts::{Axis, Chart, Figure, Style};
use crate::experiments::{Study, choosing};

pub(super) const FIGURES: &[Drawing] = &[Drawing {
    name: "decision",
    caption: "Which method keeps the angle within an error allowed, over a run of a given length, \
              with the fewest force evaluations: its mark stands there. Where there are only dots \
              the rounding of an f64 alone may be larger than what is allowed.",
    noise: false,
    draw: decision,
}];

/// Each cell of the map with the marker of the cheapest method.
fn decision(_: &Study) -> Figure {
    let map = choosing::map();
    let mut chart = Chart::new(
        Axis::log("length of the run (periods)").range(0.7, 1.5e5),
        Axis::log("largest angle error allowed (rad)").range(5e-11, 2e-1),
    )
    .height(380.0);
    for method in METHODS {
        let wins = |cell: &&choosing::Cell| {
            cell.ranking.first().is_some_and(|best| title(best.method) == title(*method))
        };
        let cells: Vec<_> = map.iter().filter(wins).map(at).collect();
        if !cells.is_empty() {
            chart = chart.series(title(*method), style(*method).markers_only(), cells);
        }
    }
    let lost = map.iter().filter(|cell| cell.ranking.is_empty()).map(at);
    chart = chart.series("lost in rounding", Style::REFERENCE.dots(), lost);
    Figure::new(
        "Which method needs the fewest force evaluations",
        "A map of marks on logarithmic axes: the length of the run, from one period to a hundred \
         thousand, across, and the largest angle error allowed, from a tenth to a \
         ten-thousand-millionth of a radian, upwards. Each mark is that of the cheapest method. \
         Methods of low order hold the upper edge, where errors are large; Blanes and Moan's of \
         order 6 holds most of the rest, and Taylor series the smallest errors of middling runs. \
         In the lower right corner, small errors over long runs, there are only dots: rounding \
         does not let any method be so exact.",
    )
    .panel(chart)
}

fn at(cell: &choosing::Cell) -> (f64, f64) {
    (cell.periods as f64, cell.allowed)
}
