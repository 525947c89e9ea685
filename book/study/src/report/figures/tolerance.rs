//! Figures of what a tolerance promises.

use crate::charts::{Axis, Chart, Figure, Style};
use crate::experiments::Study;
use crate::experiments::tolerance::{
    CUBIC, OWN_INTERPOLANT, SIGN_TURNED, along, mean_error, of_the_zoo, run, solvers, tolerances,
};

fn tolerance(range: (f64, f64)) -> Axis {
    Axis::log("tolerance").range(range.0, range.1)
}

/// The error at the end against the tolerance.
pub(super) fn error(_: &Study, figure: Figure) -> Figure {
    const LAST: u32 = 12;
    let ends = [1e-3, 1e-12].map(|tol| (tol, tol));
    let chart = Chart::new(
        tolerance((5e-13, 2e-3)),
        Axis::log("error at the end of 10 s (rad)").range(1e-13, 10.0),
    )
    .height(340.0)
    .series("the tolerance itself", Style::REFERENCE.dashed(), ends);
    figure.panel(solvers().iter().enumerate().fold(chart, |chart, (i, (name, solver))| {
        let mean = tolerances(LAST).map(|tol| (tol, mean_error(&**solver, tol)));
        let one = tolerances(LAST).map(|tol| (tol, run(&**solver, tol).error));
        chart.series(*name, Style::series(i + 1).line_only().solid(), mean).series(
            *name,
            Style::series(i + 1).markers_only(),
            one,
        )
    }))
}

/// The evaluations against the tolerance.
pub(super) fn work(_: &Study, figure: Figure) -> Figure {
    let [(five, dormand_prince), (eight, dop853), _] = solvers();
    let turned = of_the_zoo(SIGN_TURNED);
    let of = [(five, dormand_prince, 12), (eight, dop853, 12), ("one sign turned", turned, 5)];
    let chart =
        Chart::new(tolerance((5e-13, 2e-3)), Axis::log("evaluations for 10 s").range(100.0, 3e6))
            .height(340.0);
    let chart = of.iter().enumerate().fold(chart, |chart, (i, (name, solver, last))| {
        let points = tolerances(*last).map(|tol| (tol, run(&**solver, tol).evaluations));
        chart.series(*name, Style::series([1, 2, 4][i]).solid(), points)
    });
    figure.panel(
        chart
            .slope(-1.0, (2e-4, 3e4), 2e-5, "slope −1")
            .slope(-0.2, (1e-8, 3.5e3), 1e-11, "slope −1/5")
            .slope(-0.125, (1e-8, 700.0), 1e-11, "slope −1/8"),
    )
}

/// The errors along a run, with two interpolants.
pub(super) fn outputs(_: &Study, figure: Figure) -> Figure {
    // Some steps from the middle of a run.
    let (from, until) = (3.0, 5.0);
    let chart = Chart::new(
        Axis::linear("t (s)").range(from, until),
        Axis::log("error (rad)").range(1e-10, 1e-2),
    )
    .height(300.0);
    let of = [("a cubic", CUBIC), ("its own interpolant", OWN_INTERPOLANT)];
    figure.panel(of.into_iter().enumerate().fold(chart, |chart, (i, (label, name))| {
        let run = along(&*of_the_zoo(name), 1e-8, 100_000);
        let run: Vec<_> = run.into_iter().filter(|(t, _)| (from..=until).contains(t)).collect();
        // Of every forty the first, and the smallest: beside the end of a step.
        let line = run.chunks(40).flat_map(|part| {
            let least = part.iter().min_by(|a, b| a.1.total_cmp(&b.1));
            let least = *least.expect("a part is not empty");
            [part[0], least].into_iter().take(if least.0 == part[0].0 { 1 } else { 2 })
        });
        chart.series(label, Style::series([4, 2][i]).line_only().solid(), line)
    }))
}
