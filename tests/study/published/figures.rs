//! Figures of some solvers.

use pendula::{Motion, Pendulum, Phase};
use pendula_study::charts::{Axis, Chart, Figure, Style};
use pendula_study::report::figures::captioned;

use super::defects::reports_on_defects;
use super::judged::{JUDGED, Judged};

/// The judgement of this recording.
fn of(recording: &str) -> &'static Judged {
    let found = JUDGED.iter().find(|it| it.entry.recording == recording);
    found.unwrap_or_else(|| panic!("{recording} is not recorded"))
}

/// Error at the end against evaluations, of solvers that this chart names.
fn by_work(series: &[(&str, &str)], y: (f64, f64), x: (f64, f64)) -> Chart {
    let chart = Chart::new(
        Axis::log("evaluations for three runs of 10 s").range(x.0, x.1),
        Axis::log("largest error at the end (rad)").range(y.0, y.1),
    );
    series.iter().enumerate().fold(chart.height(320.0), |chart, (k, (label, recording))| {
        let ladder = of(recording).report.evidence.tolerances.iter();
        let points = ladder.filter_map(|&(_, error, count)| Some((count? as f64, error)));
        chart.series(*label, Style::series([1, 2, 4, 3][k]).solid(), points)
    })
}

/// Twentieths of a run: a record has the largest and the smallest error of each, and not when.
const TWENTIETHS: usize = 20;

/// The largest and the smallest error in each twentieth of a run.
fn along(series: &[(&str, &str)], y: (f64, f64)) -> Chart {
    let chart = Chart::new(
        Axis::linear("t (s)").range(0.0, 10.0),
        Axis::log("error (rad)").range(y.0, y.1),
    );
    series.iter().enumerate().fold(chart.height(300.0), |chart, (k, (label, recording))| {
        let outputs = &of(recording).report.evidence.outputs;
        let parts = outputs.chunks(outputs.len().div_ceil(TWENTIETHS));
        let (mut largest, mut smallest) = (Vec::new(), Vec::new());
        for part in parts {
            let middle = 0.5 * (part[0].0 + part[part.len() - 1].0);
            let errors = part.iter().map(|&(_, error)| error);
            largest.push((middle, errors.clone().fold(0.0, f64::max)));
            smallest.push((middle, errors.fold(f64::INFINITY, f64::min)));
        }
        let style = Style::series([4, 2][k]);
        chart.series(format!("{label}, largest"), style.solid(), largest).series(
            format!("{label}, smallest"),
            style.dashed(),
            smallest,
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
        let ladder = of(recording).report.evidence.tolerances.iter();
        let points = ladder.map(|&(tolerance, error, _)| (tolerance, error));
        chart.series(*label, Style::series([1, 2, 4, 3][k]).solid(), points)
    })
}

/// Of each solver an error (rad) that should be like its usual one at the same tolerance.
fn beside_usual(property: &str, what: &str) -> Chart {
    let points = JUDGED.iter().filter_map(|it| {
        let (_, usual, _) = it.usual()?;
        let error = *it.report.finding(property)?.values.first()?;
        (usual > 0.0 && error > 0.0).then_some((usual, error.min(100.0)))
    });
    let line = [1e-10, 1.0].map(|x| (x, x));
    Chart::new(
        Axis::log("error of runs forward (rad), at a tolerance of 10⁻⁷").range(1e-10, 1.0),
        Axis::log(what).range(1e-10, 100.0),
    )
    .height(320.0)
    .series("the same", Style::REFERENCE.dashed(), line)
    .series("solvers", Style::series(1).markers_only(), points)
}

/// What the output of a report says, line by line: the numbers of each line that begins so.
fn output_of(report: &str, begins: &str) -> Vec<Vec<f64>> {
    let reports = reports_on_defects();
    let text = reports.get(report).unwrap_or_else(|| panic!("no report {report}"));
    let output = text.split_once("<!-- ANCHOR: output -->").expect("an output").1;
    let output = output.split_once("<!-- ANCHOR_END: output -->").expect("its end").0;
    let lines = output.lines().filter(|line| line.starts_with(begins));
    let numbers = |line: &str| {
        let words = line.split(|c: char| !(c.is_ascii_digit() || ".e-".contains(c)));
        words.filter_map(|word| word.parse().ok()).collect::<Vec<f64>>()
    };
    let found: Vec<Vec<f64>> = lines.map(numbers).collect();
    assert!(found.len() > 2, "{report} prints no lines that begin with {begins}");
    found
}

/// What becomes of a call that is made again and again: evaluations, and errors.
fn again_and_again(figure: Figure) -> Figure {
    let motion = exact(Phase::at_rest(2.0), 1.0);
    let rows = output_of("extensisq-mu5nmb-weights-shrink", "call");
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

/// A figure: its name, title, caption and description, and what draws it.
pub struct Drawing {
    pub name: &'static str,
    pub title: &'static str,
    caption: &'static str,
    description: &'static str,
    draw: fn(Figure) -> Figure,
}

impl Drawing {
    pub fn html(&self) -> String {
        let figure = (self.draw)(Figure::new(self.title, self.description));
        captioned(&figure.to_svg(self.name), self.caption)
    }
}

pub const DRAWINGS: [Drawing; 5] = [
    Drawing {
        name: "solver_ends",
        title: "One method of order 8, with its end interpolated and not",
        caption: "Error against work, from loose to tight tolerances. As the steps become short, \
                  torchdiffeq's line is that of the quartic.",
        description: "Three lines on doubly logarithmic axes: the largest error at the end \
                      against the evaluations. Those of diffrax's Dopri8 and SciPy's DOP853 fall \
                      steeply, and together, to 10⁻¹¹ radians. That of torchdiffeq's dopri8 \
                      leaves them at about 10⁻⁵, falls half as steeply, and ends at 3 · 10⁻⁹ \
                      with as many evaluations.",
        draw: |figure| {
            figure.panel(by_work(
                &[
                    ("torchdiffeq dopri8", "torchdiffeq-dopri8"),
                    ("diffrax Dopri8", "diffrax-Dopri8"),
                    ("SciPy DOP853", "SciPy-DOP853"),
                ],
                (1e-13, 1.0),
                (5e2, 3e4),
            ))
        },
    },
    Drawing {
        name: "solver_outputs",
        title: "Two factors exchanged, between the steps",
        caption: "The largest and the smallest error in each twentieth of a run with a tolerance \
                  of 10⁻⁷, of two programs for DOP853.",
        description: "Four lines on a logarithmic axis, errors against time. The largest errors \
                      of differential-equations stand a hundred times above those of SciPy; its \
                      smallest are below SciPy's largest.",
        draw: |figure| {
            figure.panel(along(
                &[
                    ("differential-equations", "differential-equations-dop853"),
                    ("SciPy", "SciPy-DOP853"),
                ],
                (1e-10, 1e-2),
            ))
        },
    },
    Drawing {
        name: "solver_again",
        title: "The same call, again and again",
        caption: "Evaluations, and the error at the end, of one and the same call.",
        description: "Two charts, one below the other. Above, the evaluations fall from 1292 at \
                      the first call to 77 at the sixtieth. Below, the error rises meanwhile by \
                      seven orders of magnitude.",
        draw: again_and_again,
    },
    Drawing {
        name: "solver_back",
        title: "Forwards and backwards",
        caption: "Each point is a solver: the largest error of runs forward and of runs back, \
                  with the same tolerance. On the dashed line both are the same. Errors of more \
                  than 100 rad stand at the upper edge.",
        description: "A chart with a point for each solver, on doubly logarithmic axes. Nearly \
                      all lie near the dashed diagonal; a few stand at the upper edge.",
        draw: |figure| figure.panel(beside_usual("back", "of runs back (rad)")),
    },
    Drawing {
        name: "solver_clock",
        title: "A clock that runs ahead",
        caption: "Error against tolerance, beside SciPy's. On the dashed line an error is the \
                  tolerance.",
        description: "Two lines and a dashed diagonal on doubly logarithmic axes. SciPy's RK45 \
                      runs parallel to the diagonal, a hundred times above it. peroxide's RKF45 \
                      falls from ten radians to a few thousandths, while the tolerance falls by \
                      ten powers of ten.",
        draw: |figure| {
            figure.panel(by_tolerance(
                &[("peroxide RKF45", "peroxide-RKF45"), ("SciPy RK45", "SciPy-RK45")],
                (1e-13, 100.0),
                (1e-13, 1e-3),
            ))
        },
    },
];
