//! How a step of higher order is put together from steps of order 2.

use pendula::Phase;
use pendula::methods::{ForestRuth, Splitting, StormerVerlet, Suzuki4};

use super::geometry::{START, parts, point, true_motion, truth};
use super::{named, phase_plane, style, title};
use crate::charts::{Axis, Chart, Figure, Style};
use crate::experiments::Study;

/// About a seventh of a period (s): the errors of the substeps can be seen, and that of the step is
/// small beside them.
const STEP: f64 = 0.3;

/// Where steps of Störmer–Verlet by these shares of [`STEP`] lead from [`START`], one after the
/// other, and at what time (s): the start and the end of each.
fn ends(shares: &[f64]) -> Vec<(f64, Phase)> {
    let mut ends = vec![(0.0, START)];
    let (mut t, mut z) = ends[0];
    for share in shares {
        let h = share * STEP;
        (t, z) = (t + h, parts(&StormerVerlet, z, h, h).end);
        ends.push((t, z));
    }
    ends
}

/// A length in steps, with the true minus sign.
fn in_steps(share: f64) -> String {
    format!("{share:.2}").replace('-', "−")
}

/// The substeps of Forest–Ruth in phase space.
fn jump() -> Chart {
    let method = named("forest-ruth");
    let ends = ends(ForestRuth::DRIFTS);
    let truth_at = |t: f64| true_motion(START).at(t);
    let mut chart = phase_plane((-1.9, 0.4), (-0.5, 4.0))
        .height(300.0)
        .series("true orbit", Style::REFERENCE, truth(truth_at(-0.45 * STEP), 2.15 * STEP))
        .series("true motion", Style::TRUE_POINT, ends.iter().map(|(t, _)| point(truth_at(*t))))
        .series(title(method), style(method).markers_only(), ends.iter().map(|(_, z)| point(*z)));
    for pair in ends.windows(2) {
        let ends = [pair[0].1, pair[1].1].map(point);
        chart = chart.series("", style(method).arrow(), ends);
    }
    for (t, z) in ends {
        let time = match (t / STEP * 100.0).round() / 100.0 {
            0.0 => "start".into(),
            1.0 => "h".into(),
            share => format!("{} h", in_steps(share)),
        };
        chart = chart
            .series("", Style::GUIDE, [truth_at(t), z].map(point))
            .note(z.theta, z.omega, time);
    }
    chart
}

/// The substeps of two methods in time, one below the other.
fn lengths() -> Chart {
    let methods =
        [(named("forest-ruth"), ForestRuth::DRIFTS), (named("suzuki-4"), Suzuki4::DRIFTS)];
    let (mut y, mut ticks, mut arrows) = (0.0, Vec::new(), Vec::new());
    for (method, shares) in methods {
        let mut t = 0.0;
        for share in shares {
            y -= 1.0;
            ticks.push((y, in_steps(*share)));
            arrows.push((method, [(t, y), (t + share, y)]));
            t += share;
        }
        // A gap between the methods.
        y -= 0.5;
    }
    let chart = Chart::new(
        Axis::linear("time (steps)").range(-0.5, 1.5),
        Axis::linear("substep (steps)").range(y - 0.1, -0.4).ticks(ticks),
    )
    .height(210.0)
    .vertical(0.0, "start")
    .vertical(1.0, "end");
    arrows.into_iter().fold(chart, |chart, (method, arrow)| {
        chart.series(title(method), style(method).arrow(), arrow)
    })
}

/// The triple jump in phase space, and in time beside Suzuki's five substeps.
pub(super) fn triple_jump(_: &Study, figure: Figure) -> Figure {
    figure.panel(jump()).panel(lengths())
}
