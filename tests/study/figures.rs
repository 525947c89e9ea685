//! The figures show what the experiments measured: the values of each series, by its label and the
//! heading of its chart, are computed again. That a chart is drawn as it says, `charts` tests.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;
use std::sync::{LazyLock, OnceLock};

use approx::{assert_relative_eq, relative_eq};
use pendula::{METHODS, Pendulum, exact};
use pendula_study::charts::{Axis, Cell, Chart, Figure, Style};
use pendula_study::experiments::choosing;
use pendula_study::report::figures::figures;
use rstest::rstest;

use crate::STUDY;
use crate::choosing::MAP;
use crate::expected::*;

/// A figure of the book, drawn once for all tests.
fn drawn(name: &str) -> &'static Figure {
    static DRAWN: LazyLock<Vec<OnceLock<Figure>>> =
        LazyLock::new(|| figures().map(|_| OnceLock::new()).collect());
    let (index, drawing) =
        figures().enumerate().find(|(_, figure)| figure.name == name).expect("a figure");
    DRAWN[index].get_or_init(|| drawing.figure(&STUDY))
}

/// The values that are on the chart, sorted, each once.
fn on(chart: &Chart, values: impl Iterator<Item = Point>) -> Vec<Point> {
    let is_on = |axis: &Axis, value: f64| {
        axis.range.is_none_or(|(low, high)| (low.min(high)..=low.max(high)).contains(&value))
    };
    let mut all: Vec<Point> =
        values.filter(|(x, y)| is_on(&chart.x, *x) && is_on(&chart.y, *y)).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    all.dedup();
    all
}

/// Compares the series of a chart that have this label with all that they should show: where it is
/// empty, those without a label that are no guides. What is computed in another order may differ by
/// a few roundings, of numbers as large as the largest.
fn compare(what: &str, chart: &Chart, label: &str, expected: &[&Expected]) {
    let own = chart.series.iter().filter(|it| it.label == label && !it.style.is_guide());
    let drawn = on(chart, own.flat_map(|series| series.points.iter().copied()));
    let expected = on(chart, expected.iter().flat_map(|series| series.values.iter().copied()));
    assert!(!expected.is_empty(), "{what}: nothing to show");
    assert_eq!(drawn.len(), expected.len(), "{what}: as many values");
    let largest =
        |pick: fn(&Point) -> f64| expected.iter().map(pick).fold(0.0, |a: f64, b| a.max(b.abs()));
    let (x, y) = (1e-15 * largest(|p| p.0), 1e-15 * largest(|p| p.1));
    for (drawn, expected) in drawn.iter().zip(&expected) {
        let same = relative_eq!(drawn.0, expected.0, max_relative = 1e-9, epsilon = x)
            && relative_eq!(drawn.1, expected.1, max_relative = 1e-9, epsilon = y);
        assert!(same, "{what}: {drawn:?} for {expected:?}");
    }
}

/// Of these no series is measured: the forces are drawn as they act, in the triple jump the arrows
/// are the substeps, and the images of the square and of the cat have no labels.
const NOT_MEASURED: [&str; 4] = ["forces", "triple_jump", "area", "cat"];

/// Catches: labels or charts exchanged, half of the data, the beginning of a run where its end
/// should be, the wrong column of a table.
#[rstest]
#[case("figure_2", figure_2)]
#[case("figure_3", figure_3)]
#[case("figure_4", figure_4)]
#[case("figure_5", figure_5)]
#[case("figure_6", figure_6)]
#[case("figure_7", figure_7)]
#[case("cancellation", cancellation)]
#[case("two_eulers", two_eulers)]
#[case("level_curves", level_curves_expected)]
#[case("tilted_curve", tilted_curve_expected)]
#[case("five_periods", five_periods)]
#[case("standard_map", standard_map_expected)]
#[case("rounding_walk", rounding_walk_expected)]
#[case("cost", cost)]
#[case("poincare", poincare)]
#[case("separation", separation)]
#[case("kapitza", kapitza)]
#[case("double_pendulum_trace", double_pendulum_trace)]
#[case("turning_ellipse", turning_ellipse)]
#[case("stencil_forward_euler", || stencil("forward-euler", 0.35))]
#[case("stencil_symplectic_euler", || stencil("symplectic-euler", 0.35))]
#[case("stencil_stormer_verlet", || stencil("stormer-verlet", 0.35))]
#[case("stencil_rk4", || stencil("rk4", 0.55))]
#[case("resonances", resonances)]
#[case("truncation", truncation)]
#[case("least_change", least_change)]
#[case("widths", widths)]
#[case("swings", swings)]
fn a_figure_shows_what_was_measured(#[case] name: &str, #[case] expected: fn() -> Vec<Expected>) {
    let (figure, expected) = (drawn(name), expected());
    let mut together: BTreeMap<(usize, &str), Vec<&Expected>> = BTreeMap::new();
    for series in &expected {
        let says = |chart: &Chart| format!("{} {}", chart.heading, chart.y.label);
        let charts = figure.panels.iter().enumerate();
        let charts: Vec<usize> = charts
            .filter(|(_, chart)| says(chart).contains(&series.chart))
            .map(|(number, _)| number)
            .collect();
        assert!(!charts.is_empty(), "{name}: no chart is headed {:?}", series.chart);
        for chart in charts {
            together.entry((chart, series.label.as_str())).or_default().push(series);
        }
    }
    for ((chart, label), all) in together {
        compare(&format!("{name}, {chart}, {label:?}"), &figure.panels[chart], label, &all);
    }
}

/// Catches: a name at the row of another method.
#[test]
fn the_rows_of_costs_have_their_names() {
    let ticks = drawn("cost").panels[0].y.ticks.as_ref().expect("a tick a row");
    let names: Vec<&str> = compared().into_iter().map(|(method, _)| title(of(method))).collect();
    assert_eq!(ticks.iter().filter_map(|tick| tick.label.as_deref()).collect::<Vec<_>>(), names);
}

/// The two curves of the periods have no entry in the legend but notes beside them.
///
/// Catches: another coefficient than the note says, 1/12 for 1/16; the exact curve dashed and the
/// correction not.
#[test]
fn the_dashed_curve_of_the_periods_is_the_first_correction() {
    let periods = &drawn("swings").panels[1].series;
    let curve = |style: Style| {
        let series = periods.iter().find(|series| series.style == style).expect("a curve");
        series.points.iter().filter(|(theta_0, _)| (0.1..3.0).contains(theta_0))
    };
    let small = 2.0 * PI / 9.81_f64.sqrt();
    for (theta_0, ratio) in curve(Style::REFERENCE) {
        let expected = exact::period(&Pendulum::PAPER, *theta_0).unwrap() / small;
        assert_relative_eq!(*ratio, expected, max_relative = 1e-12);
    }
    for (theta_0, ratio) in curve(Style::REFERENCE.dashed()) {
        assert_relative_eq!(*ratio, 1.0 + theta_0 * theta_0 / 16.0, max_relative = 1e-12);
    }
}

/// The title of who is ahead in a cell of the map, and by how many hundredths.
fn ahead(cell: &choosing::Cell) -> (&'static str, f64) {
    let [best, rest @ ..] = &cell.ranking[..] else { return ("lost in rounding", 0.0) };
    let lead = rest.first().map_or(f64::INFINITY, |second| {
        (second.evaluations as f64 / best.evaluations as f64 - 1.0) * 100.0
    });
    (if lead < 25.0 { "no clear winner" } else { title(best.method) }, lead)
}

/// Catches: rows exchanged for columns, a cell in the colour of the second best, a lead of the
/// wrong pair, a cell that is missing or drawn twice, the steps of another method; two names that
/// look alike.
#[test]
fn the_decision_map_shows_each_winner_in_its_cell() {
    let figure = drawn("decision");
    let map = figure.panels[0].map.as_ref().expect("a map");
    let rows = map.y.len() - 1;
    assert_eq!(map.cells.len(), MAP.len());
    for (i, (cell, drawn)) in MAP.iter().zip(&map.cells).enumerate() {
        let (column, row) = (i / rows, i % rows);
        assert!((map.x[column]..map.x[column + 1]).contains(&(cell.periods as f64)), "{cell:?}");
        assert!((map.y[row + 1]..map.y[row]).contains(&cell.allowed), "{cell:?}");
        let ((name, lead), Cell { says: [first, second], .. }) = (ahead(cell), drawn);
        assert_eq!(map.names[drawn.name].title, name, "{cell:?}");
        assert!(second.starts_with(&format!("{} period", cell.periods)), "{second}");
        let Some(best) = cell.ranking.first() else {
            assert!(first.contains("rounding") && drawn.number.is_none(), "{first}");
            continue;
        };
        assert_eq!(drawn.number, (lead >= 25.0).then_some(best.steps), "{cell:?}");
        let (title_of_best, steps, evaluations) =
            (title(best.method), best.steps, best.evaluations);
        let of_best = format!("{title_of_best}, {steps} steps a period, {evaluations} evaluations");
        assert_eq!(*first, of_best);
        if let Some(other) = cell.ranking.get(1) {
            let of_second = format!("; {} needs {lead:.0} % more", title(other.method));
            assert!(second.ends_with(&of_second), "{second}, not {of_second}");
        }
    }
    let looks: BTreeSet<String> = map.names.iter().map(|name| format!("{:?}", name.fill)).collect();
    assert_eq!(looks.len(), map.names.len(), "each looks like itself alone");
}

/// The unit that belongs to a quantity of an axis, by the symbol or the last word before it.
fn unit_of(quantity: &str) -> Option<&'static str> {
    Some(match quantity.rsplit(' ').next()? {
        "θ" | "θ_{0}" => "rad",
        "ω" => "rad/s",
        "t" | "h" | "Δt" => "s",
        "x" | "y" => "m",
        "ΔH" | "H_{0}" => "J",
        _ => return None,
    })
}

/// Catches: the units of two axes exchanged, an angle in rad/s.
#[test]
fn every_axis_says_the_unit_of_its_quantity() {
    let mut seen: BTreeMap<&str, usize> = BTreeMap::new();
    for figure in figures() {
        for Axis { label, .. } in drawn(figure.name).panels.iter().flat_map(|it| [&it.x, &it.y]) {
            let Some((quantity, unit)) = label.rsplit_once(" (") else { continue };
            let Some(unit) = unit.strip_suffix(')') else { continue };
            if let Some(own) = unit_of(quantity) {
                assert_eq!(unit, own, "{}: {label:?}", figure.name);
                *seen.entry(own).or_default() += 1;
            }
        }
    }
    assert_eq!(seen.keys().copied().collect::<Vec<_>>(), ["J", "m", "rad", "rad/s", "s"]);
    assert!(seen["rad"] > 12 && seen["rad/s"] > 8, "{seen:?}");
}

/// Catches: a figure that nobody computes again.
#[test]
fn every_figure_is_computed_again() {
    let source = include_str!("figures.rs");
    for figure in figures() {
        let read =
            figure.name == "decision" || source.contains(&format!("#[case(\"{}\", ", figure.name));
        assert!(read != NOT_MEASURED.contains(&figure.name), "{}", figure.name);
    }
}

/// A method has one colour in all figures, and two methods of one figure differ in theirs.
///
/// Catches: the styles of two methods exchanged in a figure, legend and all.
#[test]
fn a_method_looks_the_same_in_every_figure() {
    let mut colours: BTreeMap<String, String> = BTreeMap::new();
    let titles: BTreeSet<&str> = METHODS.iter().map(|method| title(*method)).collect();
    for name in ["figure_2", "figure_3", "figure_4", "figure_7", "two_eulers", "level_curves"] {
        for series in drawn(name).panels.iter().flat_map(|chart| &chart.series) {
            if titles.contains(series.label.as_str()) {
                let own = series.style.class("line");
                let colour = colours.entry(series.label.clone()).or_insert(own.clone());
                assert_eq!(*colour, own, "{name}: {}", series.label);
            }
        }
    }
    assert_eq!(colours.values().collect::<BTreeSet<_>>().len(), 4, "{colours:?}");
}
