//! Figures of other people's solvers.

use pendula::{Motion, Pendulum, Phase};

use crate::charts::{Axis, Chart, Figure, Style};
use crate::experiments::Study;
use crate::solvers::{Found, JUDGED};

/// What was found of this solver, whose answers are kept.
fn of(recording: &str) -> &'static Found {
    let found = JUDGED.iter().find(|it| it.entry.recording == recording);
    let found = found.filter(|it| it.entry.kept.is_some());
    &found.unwrap_or_else(|| panic!("{recording} is not kept")).found
}

/// Error at the end against evaluations, of solvers that this chart names.
fn by_work(series: &[(&str, &str)], y: (f64, f64), x: (f64, f64)) -> Chart {
    let chart = Chart::new(
        Axis::log("evaluations for three runs of 10 s").range(x.0, x.1),
        Axis::log("largest error at the end (rad)").range(y.0, y.1),
    );
    series.iter().enumerate().fold(chart.height(320.0), |chart, (k, (label, recording))| {
        let ladder = of(recording).at_tolerances.iter();
        let points = ladder.map(|row| (row[2], row[1]));
        chart.series(*label, Style::series([1, 2, 4, 3][k]).solid(), points)
    })
}

/// The largest and the smallest error in each twentieth of a run.
fn along(series: &[(&str, &str)], y: (f64, f64)) -> Chart {
    let chart = Chart::new(
        Axis::linear("t (s)").range(0.0, 10.0),
        Axis::log("error (rad)").range(y.0, y.1),
    );
    series.iter().enumerate().fold(chart.height(300.0), |chart, (k, (label, recording))| {
        let parts = || of(recording).along_a_run.iter();
        let style = Style::series([4, 2][k]);
        chart
            .series(format!("{label}, largest"), style.solid(), parts().map(|row| (row[0], row[1])))
            .series(
                format!("{label}, smallest"),
                style.dashed(),
                parts().map(|row| (row[0], row[2])),
            )
    })
}

/// Error at the end against the tolerance.
fn by_tolerance(series: &[(&str, &str)], y: (f64, f64), x: (f64, f64)) -> Chart {
    let chart = Chart::new(
        Axis::log("tolerance").range(x.0, x.1),
        Axis::log("largest error at the end (rad)").range(y.0, y.1),
    )
    .series("the tolerance itself", Style::REFERENCE.dashed(), [(x.0, x.0), (x.1, x.1)]);
    series.iter().enumerate().fold(chart.height(320.0), |chart, (k, (label, recording))| {
        let points = of(recording).at_tolerances.iter().map(|row| (row[0], row[1]));
        chart.series(*label, Style::series([1, 2, 4, 3][k]).solid(), points)
    })
}

/// Of each solver an error (rad) that should be like its usual one at the same tolerance.
fn beside_usual(property: &str, what: &str) -> Chart {
    let points = JUDGED.iter().filter_map(|it| {
        let [_, usual] = it.found.usual?;
        let error = *it.found.finding(property)?.values.first()?;
        (usual > 0.0 && error > 0.0).then_some((usual, error.min(100.0)))
    });
    let line = [1e-10, 1.0].map(|x| (x, x));
    Chart::new(
        Axis::log("error of runs forward (rad), at a tolerance of 10⁻⁷").range(1e-10, 1.0),
        Axis::log(what).range(1e-10, 100.0),
    )
    .height(320.0)
    .series("as forwards", Style::REFERENCE.dashed(), line)
    .series("solvers", Style::series(0).dots().bold(), points)
}

/// The numbers of each line of this report's output that begins so.
fn output_of(report: &str, begins: &str) -> Vec<Vec<f64>> {
    let output = report.split_once("<!-- ANCHOR: output -->").expect("an output").1;
    let output = output.split_once("<!-- ANCHOR_END: output -->").expect("its end").0;
    let lines = output.lines().filter(|line| line.starts_with(begins));
    let numbers = |line: &str| {
        let words = line.split(|c: char| !(c.is_ascii_digit() || ".e-".contains(c)));
        words.filter_map(|word| word.parse().ok()).collect::<Vec<f64>>()
    };
    let found: Vec<Vec<f64>> = lines.map(numbers).collect();
    assert!(found.len() > 2, "no lines that begin with {begins}");
    found
}

/// What becomes of a call that is made again and again: evaluations, and errors.
pub(super) fn again(_: &Study, figure: Figure) -> Figure {
    let motion = exact(Phase::at_rest(2.0), 1.0);
    let report = include_str!("../../../../strangers/reports/extensisq-mu5nmb-weights-shrink.md");
    let rows = output_of(report, "call");
    let call = || Axis::linear("call");
    let work = rows.iter().map(|row| (row[0], row[1]));
    // The third number is that of y(10).
    let errors = rows.iter().map(|row| (row[0], (row[3] - motion.at(10.0).theta).abs()));
    let style = Style::series(1).solid();
    figure
        .panel(Chart::new(call(), Axis::log("evaluations")).height(150.0).series("", style, work))
        .panel(Chart::new(call(), Axis::log("error (rad)")).height(150.0).series("", style, errors))
}

fn exact(start: Phase, g_over_l: f64) -> Motion {
    let pendulum = Pendulum::new(g_over_l, 1.0, 1.0).expect("a pendulum");
    Motion::new(&pendulum, start).expect("a finite start")
}

/// Error against work, with the end of a run interpolated and not.
pub(super) fn ends(_: &Study, figure: Figure) -> Figure {
    figure.panel(by_work(
        &[
            ("torchdiffeq dopri8", "torchdiffeq-dopri8"),
            ("diffrax Dopri8", "diffrax-Dopri8"),
            ("SciPy DOP853", "SciPy-DOP853"),
        ],
        (1e-13, 1.0),
        (5e2, 3e4),
    ))
}

/// The errors along a run, with two factors of an interpolant exchanged and not.
pub(super) fn outputs(_: &Study, figure: Figure) -> Figure {
    figure.panel(along(
        &[("differential-equations", "differential-equations-dop853"), ("SciPy", "SciPy-DOP853")],
        (1e-10, 1e-2),
    ))
}

/// The error of runs backwards beside that of runs forward.
pub(super) fn back(_: &Study, figure: Figure) -> Figure {
    figure.panel(beside_usual("back", "error of runs back (rad)"))
}

/// The error against the tolerance, with a clock that runs ahead and with a right one.
pub(super) fn clock(_: &Study, figure: Figure) -> Figure {
    figure.panel(by_tolerance(
        &[("peroxide RKF45", "peroxide-RKF45"), ("SciPy RK45", "SciPy-RK45")],
        (1e-13, 100.0),
        (1e-13, 1e-3),
    ))
}
