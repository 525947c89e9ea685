//! The finished figures, read back: what a reader measures off a drawing, by the labels of its
//! legend, its headings and its ticks, is what the experiments measured.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;
use std::sync::{LazyLock, OnceLock};

use pendula::{METHODS, Pendulum, exact};
use pendula_study::claims::predictions;
use pendula_study::experiments::STEPS;
use pendula_study::report::figures::figures;
use roxmltree::{Document, Node};
use rstest::rstest;

use crate::STUDY;
use crate::choosing::MAP;
use crate::drawing::Kind::{self, Dots, Line, Marker};
use crate::drawing::{
    DOT, Drawing, LINE, Label, Look, MARKED, PLACE, Panel, Point, Squares, dense, strokes, text,
};
use crate::expected::*;

/// The figures, each drawn once for all tests.
static DRAWN: LazyLock<BTreeMap<&str, OnceLock<String>>> =
    LazyLock::new(|| figures().map(|figure| (figure.name, OnceLock::new())).collect());

fn svg(name: &str) -> &'static str {
    let figure = figures().find(|figure| figure.name == name).expect("a figure");
    DRAWN[name].get_or_init(|| figure.svg(&STUDY))
}

impl Drawing {
    fn of(name: &str) -> Self {
        Self::read(svg(name), name)
    }
}

/// The number of the chart that a series stands in, by its heading.
fn chart_of(name: &str, drawing: &Drawing, series: &Expected) -> usize {
    let charts = drawing.panels.iter().enumerate();
    let charts: Vec<usize> =
        charts.filter(|(_, p)| p.heading.contains(&series.chart)).map(|(i, _)| i).collect();
    let [chart] = charts[..] else {
        let all: Vec<_> = drawing.panels.iter().map(|panel| &panel.heading).collect();
        panic!("{name}: {:?} is the heading of {charts:?} in {all:?}", series.chart)
    };
    chart
}

/// How the series of this label are drawn in a chart.
fn looks_of(name: &str, drawing: &Drawing, panel: &Panel, label: &str, kind: Kind) -> Vec<Look> {
    let named = || drawing.legend.iter().flat_map(|(_, looks)| looks);
    let looks: Vec<Look> = match label {
        // A series without a label is the only one of its kind.
        "" => panel.drawn.iter().map(|(look, _)| look.clone()).collect(),
        label => {
            let entry = drawing.legend.iter().find(|(other, _)| other == label);
            entry.unwrap_or_else(|| panic!("{name}: {label:?} is not in the legend")).1.clone()
        }
    };
    let is_own = |look: &Look| !label.is_empty() || named().all(|other| other != look);
    looks.into_iter().filter(|look| look.kind == kind && is_own(look)).collect()
}

/// Compares a drawing with all that it should show, and with nothing besides.
fn compare(name: &str, drawing: &Drawing, expected: &[Expected]) {
    let mut together: BTreeMap<(usize, &str, String), Vec<&Expected>> = BTreeMap::new();
    for series in expected {
        let chart = chart_of(name, drawing, series);
        let key = (chart, series.label.as_str(), format!("{:?}", series.kind));
        together.entry(key).or_default().push(series);
    }
    for ((chart, label, kind), all) in &together {
        let panel = &drawing.panels[*chart];
        let what = format!("{name}, {:?}, {label:?}, {kind}", panel.heading);
        let kind = all[0].kind;
        let looks = looks_of(name, drawing, panel, label, kind);
        let drawn = panel.drawn.iter().filter(|(look, _)| looks.contains(look));
        let strokes: Vec<&Vec<Point>> = drawn.flat_map(|(_, strokes)| strokes).collect();
        let values: Vec<Point> = all.iter().flat_map(|series| series.values.clone()).collect();
        let tolerance = match kind {
            Line => LINE,
            Marker => PLACE,
            Dots => DOT,
        };
        // Each value is drawn. On a line with many points only a few have a marker.
        let points: Vec<Point> = match kind {
            Line => strokes.iter().flat_map(|stroke| dense(stroke)).collect(),
            _ => strokes.iter().flat_map(|stroke| stroke.iter().copied()).collect(),
        };
        let places = panel.places(&values, -0.5);
        assert!(!places.is_empty(), "{what}: nothing to show");
        let few = kind == Marker && values.len() > MARKED && all.iter().any(|s| s.kind == Line);
        let squares = Squares::new(&points, tolerance);
        let missing: Vec<_> = places.iter().filter(|place| !squares.has_near(**place)).collect();
        assert!(
            few || missing.is_empty(),
            "{what}: {} of {} are not drawn, the first at {:?}",
            missing.len(),
            places.len(),
            missing[0]
        );
        // And what is drawn is a value. Lines that differ in their markers alone are read as one.
        let alike = together.iter().filter(|((other, label, _), series)| {
            other == chart
                && series[0].kind == kind
                && looks_of(name, drawing, panel, label, kind)
                    .iter()
                    .any(|look| looks.contains(look))
        });
        let values: Vec<Point> = alike
            .flat_map(|(_, all)| all.iter().flat_map(|series| series.values.clone()))
            .collect();
        let places = Squares::new(&panel.places(&values, 3.0), tolerance);
        let corners = strokes.iter().flat_map(|stroke| stroke.iter());
        let corners: Vec<_> = corners.filter(|point| panel.contains(**point, 0.0)).collect();
        let foreign: Vec<_> = corners.iter().filter(|at| !places.has_near(***at)).collect();
        assert!(
            foreign.is_empty(),
            "{what}: {} of {} that are drawn were not measured, the first at {:?}",
            foreign.len(),
            corners.len(),
            foreign[0]
        );
    }
}

/// Catches: a name at the row of another method; a chapter whose bar is that of another method.
#[rstest]
#[case("cost_forward_euler", &["forward-euler"])]
#[case("cost_symplectic_euler", &["symplectic-euler"])]
#[case("cost_stormer_verlet", &["stormer-verlet"])]
#[case("cost_rk4", &["rk4"])]
#[case("cost_higher_order", &["forest-ruth", "gauss-6", "blanes-moan-6", "processed-6"])]
fn the_bars_are_those_of_the_chapter(#[case] name: &str, #[case] bars: &[&str]) {
    let panel = &Drawing::of(name).panels[0];
    let methods = compared(name);
    let titles: Vec<&str> = methods.iter().rev().map(|method| title(of(method))).collect();
    assert_eq!(panel.rows, titles);
    for (row, method) in methods.iter().rev().enumerate() {
        let there = panel.y.unit(row as f64 + 0.5).unwrap();
        let (mut lines, mut areas) = (0, 0);
        for (look, strokes) in panel.drawn.iter().filter(|(look, _)| look.kind == Line) {
            let middle = strokes[0].iter().map(|point| point.1);
            let (low, high) = middle.fold((f64::MAX, f64::MIN), |(l, h), y| (l.min(y), h.max(y)));
            if ((low + high) / 2.0 - there).abs() < 1.0 {
                *(if look.class.contains("fill") { &mut areas } else { &mut lines }) += 1;
            }
        }
        let is_own = bars.contains(method);
        assert_eq!((lines, areas), (usize::from(!is_own), usize::from(is_own)), "{method}");
    }
}

/// Of these no series is measured: the forces are drawn as they act, in the triple jump the arrows
/// are the substeps, and the images of the square and of the cat have no labels.
const NOT_MEASURED: [&str; 4] = ["forces", "triple_jump", "area", "cat"];

/// Catches: labels or charts exchanged, half of the data, the beginning of a run where its end
/// should be, the wrong column of a table, a value that is not where its tick says, an axis whose
/// ticks are elsewhere.
#[rstest]
#[case("figure_2", figure_2)]
#[case("figure_3", figure_3)]
#[case("figure_4", figure_4)]
#[case("figure_5", figure_5)]
#[case("figure_6", figure_6)]
#[case("figure_7", figure_7)]
#[case("energy_predicted", energy_predicted)]
#[case("cancellation", cancellation)]
#[case("two_eulers", two_eulers)]
#[case("level_curves", level_curves_expected)]
#[case("tilted_curve", tilted_curve_expected)]
#[case("five_periods", five_periods)]
#[case("standard_map", standard_map_expected)]
#[case("rounding_walk", rounding_walk_expected)]
#[case("cost_forward_euler", || cost("cost_forward_euler"))]
#[case("cost_symplectic_euler", || cost("cost_symplectic_euler"))]
#[case("cost_stormer_verlet", || cost("cost_stormer_verlet"))]
#[case("cost_rk4", || cost("cost_rk4"))]
#[case("cost_higher_order", || cost("cost_higher_order"))]
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
#[case("widths", widths)]
#[case("swings", swings)]
fn a_figure_shows_what_was_measured(#[case] name: &str, #[case] expected: fn() -> Vec<Expected>) {
    compare(name, &Drawing::of(name), &expected());
}

/// The band of each chart is read back at the steps of the table, and so is where its markers are.
///
/// Catches: a marker outside of its band, a band of another method, one that is too wide by the
/// factor of ten that makes every theory true.
#[test]
fn what_is_predicted_lies_in_its_band() {
    let (drawing, all) = (Drawing::of("energy_predicted"), predictions());
    for (method, id) in papers().zip(["fe", "se", "rk4", "vv"]) {
        let panel =
            drawing.panels.iter().find(|panel| panel.heading.contains(title(method))).unwrap();
        let is_band = |look: &Look| look.kind == Line && look.class == "fill";
        let (_, band) = panel.drawn.iter().find(|(look, _)| is_band(look)).expect("a band");
        let (_, marks) = panel.drawn.iter().find(|(look, _)| look.kind == Marker).unwrap();
        for (h, (x, y)) in STEPS.into_iter().zip(&marks[0]) {
            let cell = all.iter().find(|cell| cell.id == format!("T4.{id}.{h}")).unwrap();
            let at = panel.x.unit(h).unwrap();
            assert!((at - x).abs() < 0.5, "{id}: {h}");
            // Where a side of the polygon passes over the step.
            let sides = band[0].windows(2).filter(|side| {
                (side[0].0.min(side[1].0) - 0.06..=side[0].0.max(side[1].0) + 0.06).contains(&at)
            });
            let heights = sides.map(|side| {
                let share = ((at - side[0].0) / (side[1].0 - side[0].0)).clamp(0.0, 1.0);
                let share = if share.is_finite() { share } else { 0.0 };
                side[0].1 + share * (side[1].1 - side[0].1)
            });
            let (top, bottom) =
                heights.fold((f64::MAX, f64::MIN), |(l, h), y| (l.min(y), h.max(y)));
            for (drawn, sign) in [(top, 1.0), (bottom, -1.0)] {
                let there = panel.y.unit(sign * cell.tolerance).unwrap();
                assert!((drawn - there).abs() < 1.0, "{id}, {h}: {drawn}, not {there}");
            }
            assert!((top - 0.1..=bottom + 0.1).contains(y), "{id}, {h}: {y}");
        }
    }
}

/// The two curves of the periods have no entry in the legend but notes beside them. Corners and
/// ticks have one decimal, so that a corner is within 0.1 units of the axes' value. A unit is a
/// pixel, ten times that; where the exact curve is steep, from 2.5 rad on, it is not held to it.
///
/// Catches: another coefficient than the note says, 1/12 for 1/16; the exact curve dashed and the
/// correction not.
#[test]
fn the_dashed_curve_of_the_periods_is_the_first_correction() {
    let drawing = Drawing::of("swings");
    let panel = drawing.panels.iter().find(|panel| panel.heading.contains("period T/T")).unwrap();
    let corners = |dashed: bool| -> Vec<Point> {
        let is_it = |look: &Look| look.kind == Line && look.detail.is_empty() != dashed;
        let series: Vec<_> = panel.drawn.iter().filter(|(look, _)| is_it(look)).collect();
        let [(_, strokes)] = series[..] else { panic!("{} curves", series.len()) };
        strokes.concat()
    };
    let is_at = |(x, y): Point, theta_0: f64, ratio: f64| {
        let there = panel.y.unit(ratio).unwrap();
        assert!((y - there).abs() < 1.0, "{theta_0} rad, {x}: at {y} and not {there}");
    };
    let angle = |x: f64| {
        let share = (x - panel.x.from.0) / (panel.x.to.0 - panel.x.from.0);
        panel.x.from.1 + share * (panel.x.to.1 - panel.x.from.1)
    };
    let correction = corners(true);
    assert!((correction[0].0 - panel.left).abs() < 1.0);
    assert!((correction[correction.len() - 1].0 - panel.right).abs() < 1.0);
    for corner in correction {
        let theta_0 = angle(corner.0);
        is_at(corner, theta_0, 1.0 + theta_0 * theta_0 / 16.0);
    }
    let small = 2.0 * PI / 9.81_f64.sqrt();
    for corner in corners(false).into_iter().filter(|corner| angle(corner.0) < 2.5) {
        let theta_0 = angle(corner.0).max(1e-3);
        is_at(corner, theta_0, exact::period(&Pendulum::PAPER, theta_0).unwrap() / small);
    }
}

/// The share of opacity by how many more evaluations the second best needs, in hundredths.
fn opacity_of(lead: f64) -> &'static str {
    match lead {
        lead if lead < 5.0 => "0.25",
        lead if lead < 25.0 => "0.5",
        lead if lead < 60.0 => "0.75",
        _ => "1",
    }
}

/// Each cell is read off the axes: it lies where its length and its error are, in the colour that
/// the legend gives the cheapest method, as opaque as its lead says; the text that a mouse shows
/// has its numbers.
///
/// Catches: rows exchanged for columns, a cell in the colour of the second best, a lead of the
/// wrong pair, a cell that is missing or drawn twice, the steps of another method.
#[test]
fn the_decision_map_shows_each_winner_in_its_cell() {
    let document = Document::parse(svg("decision")).expect("an SVG");
    let panel = &Drawing::of("decision").panels[0];
    let is_cell = |node: &Node| node.attribute("class").is_some_and(|c| c.starts_with("cell"));
    let cells: Vec<Node> =
        document.root_element().children().filter(Node::is_element).filter(is_cell).collect();
    let entries = document.descendants().filter(|node| node.attribute("class") == Some("entry"));
    let mut legend: BTreeMap<String, String> = BTreeMap::new();
    for entry in entries {
        let sample = entry.children().find(is_cell).expect("a sample");
        let label = entry.children().rfind(|node| node.tag_name().name() == "text");
        let class = sample.attribute("class").unwrap().to_string();
        legend.insert(text(label.expect("a label")), class);
    }
    assert_eq!(cells.len(), MAP.len());
    for cell in MAP.iter() {
        let (x, y) =
            (panel.x.unit(cell.periods as f64).unwrap(), panel.y.unit(cell.allowed).unwrap());
        let there = |node: &&Node| {
            let corners = strokes(node.attribute("d").unwrap()).concat();
            let spans = |pick: fn(&Point) -> f64, at: f64| {
                let values = corners.iter().map(pick);
                let (low, high) =
                    values.fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(v), h.max(v)));
                (low..high).contains(&at)
            };
            spans(|p| p.0, x) && spans(|p| p.1, y)
        };
        let mut found = cells.iter().filter(there);
        let (Some(drawn), None) = (found.next(), found.next()) else {
            panic!("not one cell at {} periods, {}", cell.periods, cell.allowed)
        };
        let hover = text(drawn.first_element_child().expect("a text for the mouse"));
        assert!(hover.starts_with(&format!("{} period", cell.periods)), "{hover}");
        let (class, opacity) =
            (drawn.attribute("class").unwrap(), drawn.attribute("fill-opacity").unwrap());
        let Some(best) = cell.ranking.first() else {
            assert!(class == "cell" && opacity == "0" && hover.contains("rounding"), "{hover}");
            continue;
        };
        assert_eq!(legend[title(best.method)], class, "{hover}");
        let of_best = format!(
            ": {}, {} steps a period, {} evaluations; ",
            title(best.method),
            best.steps,
            best.evaluations
        );
        assert!(hover.contains(&of_best), "{hover}, not {of_best}");
        if let Some(second) = cell.ranking.get(1) {
            let lead = (second.evaluations as f64 / best.evaluations as f64 - 1.0) * 100.0;
            assert_eq!(opacity, opacity_of(lead), "{hover}");
            let of_second = format!("; {} needs {lead:.0} % more", title(second.method));
            assert!(hover.ends_with(&of_second), "{hover}, not {of_second}");
        }
    }
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

/// All texts of a figure that end in a unit are axes or what stands above them.
///
/// Catches: the units of two axes exchanged, an angle in rad/s.
#[test]
fn every_axis_says_the_unit_of_its_quantity() {
    let mut seen: BTreeMap<&str, usize> = BTreeMap::new();
    for figure in figures() {
        let document = Document::parse(svg(figure.name)).expect("an SVG");
        let nodes: Vec<Node> = document.descendants().filter(Node::is_element).collect();
        for Label { text, .. } in Label::all(&nodes) {
            let Some((quantity, unit)) = text.rsplit_once(" (") else { continue };
            let Some(unit) = unit.strip_suffix(')') else { continue };
            if let Some(own) = unit_of(quantity) {
                assert_eq!(unit, own, "{}: {text:?}", figure.name);
                *seen.entry(own).or_default() += 1;
            }
        }
    }
    assert_eq!(seen.keys().copied().collect::<Vec<_>>(), ["J", "m", "rad", "rad/s", "s"]);
    assert!(seen["rad"] > 12 && seen["rad/s"] > 8, "{seen:?}");
}

/// Catches: a figure that nobody reads back.
#[test]
fn every_figure_is_read_back() {
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
        for (label, looks) in Drawing::of(name).legend {
            if titles.contains(label.as_str()) {
                let colour = colours.entry(label.clone()).or_insert(looks[0].class.clone());
                assert_eq!(*colour, looks[0].class, "{name}: {label}");
            }
        }
    }
    assert_eq!(colours.values().collect::<BTreeSet<_>>().len(), 4, "{colours:?}");
}

/// Figure 2 as it is, and spoilt in the ways of those who draw.
///
/// Catches: a reader of drawings that sees what it expects.
#[test]
fn a_spoilt_figure_is_noticed() {
    let sound = svg("figure_2");
    let noticed = |svg: &str, expected: &[Expected]| {
        let drawing = Drawing::read(svg, "spoilt");
        let compared = std::panic::AssertUnwindSafe(|| compare("spoilt", &drawing, expected));
        std::panic::catch_unwind(compared).is_err()
    };
    assert!(!noticed(sound, &figure_2()));
    let exchanged = sound
        .replace(">RK4<", ">?<")
        .replace(">Störmer–Verlet<", ">RK4<")
        .replace(">?<", ">Störmer–Verlet<");
    assert!(noticed(&exchanged, &figure_2()), "labels exchanged");
    let moved = sound.replace("−3</tspan>", "−4</tspan>");
    assert!(moved != sound, "a tick to move");
    let result = std::panic::catch_unwind(|| noticed(&moved, &figure_2()));
    assert!(result.unwrap_or(true), "a tick moved");
    let mut half = figure_2();
    half.iter_mut().for_each(|series| series.values.truncate(3));
    assert!(noticed(sound, &half), "more drawn than measured");
    let mut more = figure_2();
    more.iter_mut().for_each(|series| series.values.push((0.02, 1.0)));
    assert!(noticed(sound, &more), "half of the data");
}
