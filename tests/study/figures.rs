//! The finished figures, read back: what a reader measures off a drawing, by the labels of its
//! legend, its headings and its ticks, is what the experiments measured.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;

use pendula::{METHODS, Pendulum, exact};
use pendula_study::experiments::choosing::Cell;
use pendula_study::report::figures::figures;
use roxmltree::{Document, Node};
use rstest::rstest;

use crate::choosing::MAP;
use crate::drawing::Kind::{self, Dots, Line, Marker};
use crate::drawing::{
    DOT, Drawing, LINE, Label, Look, MARKED, PLACE, Panel, Point, Squares, dense, strokes, text,
};
use crate::expected::*;
use crate::snapshots::made;

/// The drawing of a figure of the book.
fn svg(name: &str) -> &'static str {
    let (_, figure) = made(name).content().split_once("<figure>\n").expect("a figure");
    figure.split_once("<figcaption>").expect("a caption").0
}

impl Drawing {
    fn of(name: &str) -> Self {
        Self::read(svg(name), name)
    }
}

/// The numbers of the charts that a series stands in, by their heading.
fn charts_of(name: &str, drawing: &Drawing, series: &Expected) -> Vec<usize> {
    let charts = drawing.panels.iter().enumerate();
    let charts: Vec<usize> =
        charts.filter(|(_, p)| p.heading.contains(&series.chart)).map(|(i, _)| i).collect();
    let all: Vec<_> = drawing.panels.iter().map(|panel| &panel.heading).collect();
    assert!(!charts.is_empty(), "{name}: no chart of {all:?} is headed {:?}", series.chart);
    charts
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
        for chart in charts_of(name, drawing, series) {
            let key = (chart, series.label.as_str(), format!("{:?}", series.kind));
            together.entry(key).or_default().push(series);
        }
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

/// Catches: a name at the row of another method.
#[test]
fn the_rows_of_costs_have_their_names() {
    let panel = &Drawing::of("cost").panels[0];
    let names: Vec<&str> = compared().into_iter().map(|(method, _)| title(of(method))).collect();
    assert_eq!(panel.rows, names);
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
    compare(name, &Drawing::of(name), &expected());
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

/// The title of who is ahead in a cell of the map, and by how many hundredths.
fn ahead(cell: &Cell) -> (&'static str, f64) {
    let [best, rest @ ..] = &cell.ranking[..] else { return ("lost in rounding", 0.0) };
    let lead = rest.first().map_or(f64::INFINITY, |second| {
        (second.evaluations as f64 / best.evaluations as f64 - 1.0) * 100.0
    });
    (if lead < 25.0 { "no clear winner" } else { title(best.method) }, lead)
}

/// The steps in the cells about the `first` of the map that have the same one ahead.
fn steps_about(first: usize) -> Vec<u64> {
    let rows = MAP.iter().filter(|cell| cell.periods == MAP[0].periods).count();
    let (mut found, mut open) = (BTreeSet::from([first]), vec![first]);
    while let Some(at) = open.pop() {
        let beside = (0..MAP.len()).filter(|other| {
            let columns = (at / rows).abs_diff(other / rows);
            columns + (at % rows).abs_diff(other % rows) == 1
        });
        for other in beside.filter(|other| ahead(&MAP[*other]).0 == ahead(&MAP[first]).0) {
            if found.insert(other) {
                open.push(other);
            }
        }
    }
    found.into_iter().map(|at| MAP[at].ranking[0].steps).collect()
}

/// Each cell is read off the axes: it lies where its length and its error are, looks like the one
/// in which the name of the method that is ahead stands, and what it says has its numbers.
///
/// Catches: rows exchanged for columns, a cell in the colour of the second best, a lead of the
/// wrong pair, a cell that is missing or drawn twice, the steps of another method; a name on
/// another's area, or with the steps of all areas of its method.
#[test]
fn the_decision_map_shows_each_winner_in_its_cell() {
    let document = Document::parse(svg("decision")).expect("an SVG");
    let panel = &Drawing::of("decision").panels[0];
    let has_class = |node: &Node, class: &str| node.attribute("class") == Some(class);
    let nodes: Vec<Node> = document.root_element().children().filter(Node::is_element).collect();
    let cells: Vec<Node> = nodes.iter().copied().filter(|node| has_class(node, "cell")).collect();
    let look = |cell: Node| {
        let path = cell.first_element_child().unwrap();
        path.attribute("class").unwrap().to_string()
    };
    let covers = |cell: &Node, (x, y): Point| {
        let path = cell.first_element_child().unwrap();
        let corners = strokes(path.attribute("d").unwrap()).concat();
        let spans = |pick: fn(&Point) -> f64, at: f64| {
            let values = corners.iter().map(pick);
            let (low, high) = values.fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(v), h.max(v)));
            (low..high).contains(&at)
        };
        spans(|p| p.0, x) && spans(|p| p.1, y)
    };
    let place = |cell: &Cell| {
        (panel.x.unit(cell.periods as f64).unwrap(), panel.y.unit(cell.allowed).unwrap())
    };
    let index_at = |at: Point| {
        let there =
            |cell: &Cell| cells.iter().any(|node| covers(node, at) && covers(node, place(cell)));
        MAP.iter().position(there).expect("a cell at each name")
    };
    // What looks how, by the names on the map and the entries of its legend.
    let mut looks: BTreeMap<String, String> = BTreeMap::new();
    for entry in nodes.iter().filter(|node| has_class(node, "entry")) {
        let sample = entry.children().find(|node| has_class(node, "cell")).expect("a sample");
        let label = entry.children().rfind(|node| node.tag_name().name() == "text");
        looks.insert(text(label.expect("a label")), look(sample));
    }
    let names: Vec<Node> = nodes.iter().copied().filter(|node| has_class(node, "halo")).collect();
    let mut areas = 0;
    for Label { x, y, text, .. } in Label::all(&names) {
        let index = index_at((x, y - 5.0));
        if let Some(range) = text.strip_suffix(" steps") {
            let steps = steps_about(index);
            let ends = [steps.iter().min().unwrap(), steps.iter().max().unwrap()];
            assert_eq!(range, ends.map(u64::to_string).join("–"));
            areas += 1;
        } else {
            assert_eq!(text, ahead(&MAP[index]).0);
            let node = cells.iter().find(|node| covers(node, (x, y - 5.0))).unwrap();
            assert_eq!(*looks.entry(text).or_insert(look(*node)), look(*node));
        }
    }
    assert!(areas >= 3, "{areas} areas say their steps");
    assert_eq!(cells.len(), MAP.len());
    for cell in MAP.iter() {
        let mut found = cells.iter().filter(|node| covers(node, place(cell)));
        let (Some(drawn), None) = (found.next(), found.next()) else {
            panic!("not one cell at {} periods, {}", cell.periods, cell.allowed)
        };
        let texts = drawn.children().filter(|node| node.tag_name().name() == "text");
        let [first, second] = texts.map(text).collect::<Vec<_>>().try_into().unwrap();
        assert!(second.starts_with(&format!("{} period", cell.periods)), "{second}");
        let (name, lead) = ahead(cell);
        assert_eq!(looks[name], look(*drawn), "{second}");
        let Some(best) = cell.ranking.first() else {
            assert!(first.contains("rounding"), "{first}");
            continue;
        };
        let (title_of_best, steps, evaluations) =
            (title(best.method), best.steps, best.evaluations);
        let of_best = format!("{title_of_best}, {steps} steps a period, {evaluations} evaluations");
        assert_eq!(first, of_best);
        if let Some(other) = cell.ranking.get(1) {
            let of_second = format!("; {} needs {lead:.0} % more", title(other.method));
            assert!(second.ends_with(&of_second), "{second}, not {of_second}");
        }
    }
    let all: BTreeSet<&String> = looks.values().collect();
    assert_eq!(all.len(), looks.len(), "each looks like itself alone");
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
