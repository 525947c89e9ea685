//! The finished figures, read back: what a reader measures off a drawing, by the labels of its
//! legend, its headings and its ticks, is what the experiments measured.
//!
//! Nothing of `charts` is used: a drawing is taken for an SVG of anybody's.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::f64::consts::PI;
use std::sync::{LazyLock, OnceLock};

use pendula::systems::{DoublePhase, Ellipse, Kepler, PlanePhase};
use pendula::{
    AnyMethod, Grid, Hamiltonian, METHODS, Motion, Pendulum, Phase, exact, method_named,
};
use pendula_study::claims::predictions;
use pendula_study::experiments::{
    STEPS, beyond, enclosure, in_paper, level_curves, phase_portrait, readings, resonance,
    rounding_walk, small_angle, standard_map, tilted_curve, truncation,
};
use pendula_study::report::figures::figures;
use pendula_study::theory;
use roxmltree::{Document, Node};
use rstest::rstest;

use crate::STUDY;
use crate::choosing::MAP;

/// The figures, each drawn once for all tests.
static DRAWN: LazyLock<BTreeMap<&str, OnceLock<String>>> =
    LazyLock::new(|| figures().map(|figure| (figure.name, OnceLock::new())).collect());

fn svg(name: &str) -> &'static str {
    let figure = figures().find(|figure| figure.name == name).expect("a figure");
    DRAWN[name].get_or_init(|| figure.svg(&STUDY))
}

type Point = (f64, f64);

// -------------------------------------------------------------------------------------------------
// A drawing
// -------------------------------------------------------------------------------------------------

/// Coordinates have one decimal, so that a point is off by 0.05 units each way; so are the two
/// ticks from which an axis is read, which beyond them is off by as much again, and more where they
/// are close.
const PLACE: f64 = 0.5;
/// A line may stray by 0.1 units from what it shows, and where it goes up and down several times
/// within 2 units, it does so in their middle.
const LINE: f64 = 1.6;
/// Dots that are within a square unit are one.
const DOT: f64 = 1.5;
/// A line with more points than this has only a few of them marked.
const MARKED: usize = 40;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Line,
    Marker,
    Dots,
}
use Kind::{Dots, Line, Marker};

/// What tells the series of a drawing apart: class, dash, and shape of the marker.
#[derive(Clone, Debug, PartialEq)]
struct Look {
    kind: Kind,
    class: String,
    detail: String,
}

/// How values are spread along an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Scale {
    Linear,
    Log,
    /// By factors to either side of zero, where it is linear up to a millionth.
    Signed,
}

/// From units to values: two ticks, and how values grow between them.
#[derive(Clone, Copy, Debug)]
struct Axis {
    from: (f64, f64),
    to: (f64, f64),
    scale: Scale,
}

impl Axis {
    /// The unit of a value; `None` where it has no place.
    fn unit(&self, value: f64) -> Option<f64> {
        let place = |value: f64| match self.scale {
            Scale::Linear => value,
            Scale::Log => value.log10(),
            Scale::Signed => value.signum() * (1.0 + value.abs() / 1e-6).log10(),
        };
        let share = (place(value) - place(self.from.1)) / (place(self.to.1) - place(self.from.1));
        let unit = self.from.0 + share * (self.to.0 - self.from.0);
        unit.is_finite().then_some(unit)
    }

    /// Reads an axis off its labelled ticks; each has to be where the two outermost put it.
    fn read(mut ticks: Vec<(f64, f64, bool)>, name: &str) -> Option<Self> {
        ticks.sort_by(|a, b| a.0.total_cmp(&b.0));
        let ((first, last), count) = ((*ticks.first()?, *ticks.last()?), ticks.len());
        assert!(count >= 2, "{name}: one tick is no axis");
        // Powers of ten that differ; a linear axis may have one that is common to all.
        let powers: BTreeSet<i64> =
            ticks.iter().filter(|t| t.1 > 0.0).map(|t| t.1.log10().floor() as i64).collect();
        let is_power =
            |value: f64| (value.abs().log10() - value.abs().log10().round()).abs() < 1e-9;
        let scale = match powers.len() > 1 {
            true if ticks.iter().all(|tick| tick.2) => Scale::Log,
            true if ticks.iter().all(|tick| tick.1 == 0.0 || is_power(tick.1)) => Scale::Signed,
            // Linear ticks are even; 1, 2, 5 are not.
            _ if ticks.iter().all(|tick| tick.1 > 0.0) && !are_even(&ticks) => Scale::Log,
            _ => Scale::Linear,
        };
        let axis = Self { from: (first.0, first.1), to: (last.0, last.1), scale };
        for (unit, value, _) in ticks {
            let there = axis.unit(value).expect("a tick has a place");
            assert!((there - unit).abs() < 0.25, "{name}: the tick {value} is at {unit}");
        }
        Some(axis)
    }
}

/// Whether the values of neighbouring ticks are equally far apart.
fn are_even(ticks: &[(f64, f64, bool)]) -> bool {
    let step = |pair: &[(f64, f64, bool)]| pair[1].1 - pair[0].1;
    let mean = (ticks[ticks.len() - 1].1 - ticks[0].1) / (ticks.len() - 1) as f64;
    // The labels are rounded to their last digit.
    ticks.windows(2).all(|pair| (step(pair) / mean - 1.0).abs() < 0.01)
}

/// One chart of a drawing.
#[derive(Debug)]
struct Panel {
    /// What stands above it: headings, and what its y axis shows.
    heading: String,
    left: f64,
    top: f64,
    right: f64,
    bottom: f64,
    x: Axis,
    y: Axis,
    /// What its rows are, from the bottom, where its y axis has names for numbers. The lowest row
    /// is at 0.5.
    rows: Vec<String>,
    drawn: Vec<(Look, Vec<Vec<Point>>)>,
}

/// A figure: its legend and its charts.
struct Drawing {
    legend: Vec<(String, Vec<Look>)>,
    panels: Vec<Panel>,
}

/// The text of an element, raised and lowered parts in braces.
fn text(node: Node) -> String {
    let mut text = String::new();
    let mut level = 0;
    for child in node.children() {
        let shift = child.attribute("dy").map_or(0, |dy| dy.parse::<i32>().unwrap());
        level += shift;
        let inner =
            if child.is_text() { child.text() } else { child.first_child().unwrap().text() };
        let inner = inner.unwrap_or_default();
        text += &match level.signum() {
            // Above its letter, as one writes it.
            -1 if inner == "˜" => "\u{303}".to_string(),
            -1 => format!("^{{{inner}}}"),
            1 => format!("_{{{inner}}}"),
            _ => inner.to_string(),
        };
    }
    text
}

/// The value of a tick's label, and whether it is a power of ten.
fn value_of(label: &str) -> Option<(f64, bool)> {
    let label = label.replace('−', "-");
    // "top, −π" and the like.
    let label = label.rsplit(", ").next()?;
    if let Some((mantissa, exponent)) = label.split_once("10^{") {
        let exponent: i32 = exponent.trim_end_matches('}').parse().ok()?;
        let mantissa = match mantissa.trim_end_matches('×') {
            "" => 1.0,
            "-" => -1.0,
            mantissa => mantissa.parse().ok()?,
        };
        return Some((mantissa * 10_f64.powi(exponent), true));
    }
    if let Some((times, over)) = label.split_once('π') {
        let times: f64 = match times {
            "" => 1.0,
            "-" => -1.0,
            times => times.parse().ok()?,
        };
        let over: f64 = if over.is_empty() { 1.0 } else { over.strip_prefix('/')?.parse().ok()? };
        return Some((times * PI / over, false));
    }
    Some((label.parse().ok()?, false))
}

/// The commands of a path with their numbers.
fn commands(d: &str) -> Vec<(char, Vec<f64>)> {
    let mut commands: Vec<(char, String)> = Vec::new();
    for c in d.trim().chars() {
        match c {
            c if c.is_ascii_alphabetic() => commands.push((c, String::new())),
            c => commands.last_mut().expect("a command first").1.push(c),
        }
    }
    let numbers = |text: String| {
        let parts = text.split(|c: char| c == ',' || c.is_whitespace()).filter(|p| !p.is_empty());
        parts.map(|part| part.parse().unwrap_or_else(|_| panic!("{part}"))).collect()
    };
    commands.into_iter().map(|(c, text)| (c, numbers(text))).collect()
}

/// The strokes of a path: of lines, absolute and relative.
fn strokes(d: &str) -> Vec<Vec<Point>> {
    let mut strokes: Vec<Vec<Point>> = Vec::new();
    let mut at = (0.0, 0.0);
    for (command, numbers) in commands(d) {
        let pairs = numbers.chunks(2);
        match command {
            'M' => {
                at = (numbers[0], numbers[1]);
                strokes.push(vec![at]);
            }
            'm' => {
                at = (at.0 + numbers[0], at.1 + numbers[1]);
                strokes.push(vec![at]);
            }
            'l' => pairs.for_each(|pair| {
                at = (at.0 + pair[0], at.1 + pair[1]);
                strokes.last_mut().expect("moved first").push(at);
            }),
            'h' if numbers == [0.0] => {}
            'z' => {
                let first = strokes.last().expect("moved first")[0];
                strokes.last_mut().expect("moved first").push(first);
            }
            _ => {
                at = match command {
                    'h' => (at.0 + numbers[0], at.1),
                    'v' => (at.0, at.1 + numbers[0]),
                    'H' => (numbers[0], at.1),
                    'V' => (at.0, numbers[0]),
                    'L' => (numbers[0], numbers[1]),
                    other => panic!("a path with {other}"),
                };
                strokes.last_mut().expect("moved first").push(at);
            }
        }
    }
    strokes
}

/// What a path shows; `None` for the parts of a chart that are no series.
fn series(node: Node) -> Option<(Look, Vec<Vec<Point>>)> {
    let class = node.attribute("class")?;
    let d = node.attribute("d")?.replace('\n', " ");
    let (kind, rest) = class.split_once(' ').unwrap_or((class, ""));
    let look = |kind, detail: &str| Look { kind, class: rest.into(), detail: detail.into() };
    match kind {
        "line" if d.trim_start().starts_with('m') => Some((look(Dots, ""), strokes(&d))),
        // Thin from the end of a line to its label.
        "line" | "lead" => {
            let dash = node.attribute("stroke-dasharray").unwrap_or_default();
            Some((look(Line, dash), strokes(&d)))
        }
        // Markers: each begins where it stands. The head of an arrow has corners.
        "dot" if !d.contains('L') => {
            let marks = d.split('M').skip(1).filter(|mark| !mark.trim().is_empty());
            let marks = marks.map(|mark| {
                let (place, shape) = mark.split_once('m').expect("a marker has a shape");
                let (x, y) = place.trim().split_once(',').expect("a place");
                (shape.trim().to_string(), (x.parse().unwrap(), y.parse().unwrap()))
            });
            let (shapes, places): (Vec<String>, Vec<Point>) = marks.unzip();
            Some((look(Marker, shapes.first()?), vec![places]))
        }
        _ => None,
    }
}

impl Drawing {
    fn of(name: &str) -> Self {
        Self::read(svg(name), name)
    }

    fn read(svg: &str, name: &str) -> Self {
        let document = Document::parse(svg).expect("an SVG");
        let nodes: Vec<Node> =
            document.root_element().children().filter(Node::is_element).collect();
        let is_panel = |node: &Node| node.tag_name().name() == "clipPath";
        // Of legends, and the labels at the ends of lines.
        let mut legend: Vec<(String, Vec<Look>)> = Vec::new();
        for entry in nodes.iter().filter(|node| node.attribute("class") == Some("entry")) {
            let parts: Vec<Node> = entry.children().filter(Node::is_element).collect();
            let [samples @ .., label] = &parts[..] else { panic!("{name}: an empty entry") };
            assert_eq!(label.tag_name().name(), "text", "{name}: an entry without a label");
            let looks = samples.iter().filter_map(|node| series(*node)).map(|(look, _)| look);
            let label = text(*label);
            match legend.iter_mut().find(|(known, _)| *known == label) {
                Some((_, known)) => known.extend(looks),
                None => legend.push((label, looks.collect())),
            }
        }
        let starts: Vec<usize> = (0..nodes.len()).filter(|i| is_panel(&nodes[*i])).collect();
        let mut panels: Vec<Panel> = Vec::new();
        for (i, start) in starts.iter().enumerate() {
            let end = starts.get(i + 1).copied().unwrap_or(nodes.len());
            let number = |name: &str| {
                let rect = nodes[*start].first_element_child().expect("a rectangle");
                rect.attribute(name).unwrap().parse::<f64>().unwrap()
            };
            // The plot and two units around it.
            let (left, top) = (number("x") + 2.0, number("y") + 2.0);
            let (right, bottom) = (left + number("width") - 4.0, top + number("height") - 4.0);
            let inside = &nodes[*start..end];
            let since = if i == 0 { 0 } else { starts[i - 1] };
            let heading = Label::all(&nodes[since..*start]).into_iter().filter(|label| {
                let above = panels.last().filter(|last| last.top < top - 1.0);
                label.anchor == "start"
                    && label.y < top
                    && above.is_none_or(|last| label.y > last.bottom)
            });
            let heading = heading.map(|label| label.text).collect::<Vec<_>>().join(" | ");
            let labels = Label::all(inside);
            let label_of = |near: &dyn Fn(&Label) -> bool| labels.iter().find(|label| near(label));
            let label = |near: &dyn Fn(&Label) -> bool| {
                label_of(near).and_then(|label| value_of(&label.text))
            };
            let mut names: Vec<(f64, String)> = Vec::new();
            let axis = inside.iter().find(|node| node.attribute("class") == Some("axis"));
            let (mut x_ticks, mut y_ticks) = (Vec::new(), Vec::new());
            let mut at = (0.0, 0.0);
            for (command, numbers) in axis.map_or(vec![], |a| commands(a.attribute("d").unwrap())) {
                match (command, &numbers[..]) {
                    ('M', [x, y]) => at = (*x, *y),
                    ('v', [6.0]) => {
                        let near = label(&|label| {
                            label.anchor == "middle"
                                && (label.y - bottom - 22.0).abs() < 0.2
                                && (label.x - at.0).abs() < 20.0
                        });
                        x_ticks.extend(near.map(|(value, power)| (at.0, value, power)));
                    }
                    ('h', [-6.0]) => {
                        let near = label_of(&|label| {
                            label.anchor == "end" && (label.y - at.1 - 6.0).abs() < 0.2
                        });
                        match near.map(|label| (value_of(&label.text), &label.text)) {
                            Some((Some((value, power)), _)) => y_ticks.push((at.1, value, power)),
                            Some((None, text)) => names.push((at.1, text.clone())),
                            None => {}
                        }
                    }
                    _ => {}
                }
            }
            let Some(x) = Axis::read(x_ticks, name) else { continue };
            names.sort_by(|a, b| b.0.total_cmp(&a.0));
            let rows = names.iter().zip(0..);
            y_ticks.extend(rows.map(|((unit, _), row)| (*unit, f64::from(row) + 0.5, false)));
            let rows = names.into_iter().map(|(_, name)| name).collect();
            // A chart whose left neighbour has the same axis does not repeat its numbers.
            let y = Axis::read(y_ticks, name).or_else(|| panels.last().map(|last| last.y));
            let drawn = inside.iter().filter_map(|node| series(*node)).collect();
            let y = y.expect("a y axis");
            panels.push(Panel { heading, left, top, right, bottom, x, y, rows, drawn });
        }
        Self { legend, panels }
    }
}

/// A text, and where it stands.
struct Label {
    x: f64,
    y: f64,
    /// `start`, `middle` or `end`.
    anchor: String,
    text: String,
}

impl Label {
    fn all(nodes: &[Node]) -> Vec<Self> {
        let texts = nodes.iter().filter(|node| node.tag_name().name() == "text");
        texts
            .map(|node| {
                let at = |name| node.attribute(name).unwrap().parse().unwrap();
                let anchor = node.attribute("text-anchor").unwrap_or("start").to_string();
                Self { x: at("x"), y: at("y"), anchor, text: text(*node) }
            })
            .collect()
    }
}

impl Panel {
    fn contains(&self, (x, y): Point, margin: f64) -> bool {
        (self.left - margin..=self.right + margin).contains(&x)
            && (self.top - margin..=self.bottom + margin).contains(&y)
    }

    /// The values as points of the drawing, as far as they are on it.
    fn places(&self, values: &[Point], margin: f64) -> Vec<Point> {
        let place = |&(x, y): &Point| Some((self.x.unit(x)?, self.y.unit(y)?));
        values.iter().filter_map(place).filter(|place| self.contains(*place, margin)).collect()
    }
}

/// Points in squares, to find those near another.
struct Squares {
    side: f64,
    points: HashMap<(i64, i64), Vec<Point>>,
}

impl Squares {
    fn new(points: &[Point], side: f64) -> Self {
        let mut squares = Self { side, points: HashMap::new() };
        for point in points {
            squares.points.entry(squares.square(*point)).or_default().push(*point);
        }
        squares
    }

    fn square(&self, (x, y): Point) -> (i64, i64) {
        ((x / self.side).floor() as i64, (y / self.side).floor() as i64)
    }

    /// Whether a point is within a side of this one.
    fn has_near(&self, at: Point) -> bool {
        let (i, j) = self.square(at);
        let near = |p: &Point| (p.0 - at.0).hypot(p.1 - at.1) <= self.side;
        (i - 1..=i + 1).any(|i| {
            (j - 1..=j + 1)
                .any(|j| self.points.get(&(i, j)).is_some_and(|points| points.iter().any(near)))
        })
    }
}

/// A stroke as points a quarter of a unit apart.
fn dense(stroke: &[Point]) -> Vec<Point> {
    let mut points = stroke[..1].to_vec();
    for pair in stroke.windows(2) {
        let (dx, dy) = (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
        // What is far outside the drawing is not followed.
        let parts = (dx.hypot(dy) * 4.0).ceil().clamp(1.0, 20_000.0);
        let at = |k: u32| f64::from(k) / parts;
        points.extend((1..=parts as u32).map(|k| (pair[0].0 + dx * at(k), pair[0].1 + dy * at(k))));
    }
    points
}

// -------------------------------------------------------------------------------------------------
// What a drawing should show
// -------------------------------------------------------------------------------------------------

/// A series: words of the heading of its chart, its label in the legend, how it is drawn, and its
/// values.
struct Expected {
    chart: String,
    label: String,
    kind: Kind,
    values: Vec<Point>,
}

fn expect(
    chart: impl Into<String>,
    label: impl Into<String>,
    kind: Kind,
    values: impl IntoIterator<Item = Point>,
) -> Expected {
    let (chart, label) = (chart.into(), label.into());
    Expected { chart, label, kind, values: values.into_iter().collect() }
}

/// Compares a drawing with all that it should show, and with nothing besides.
fn compare(name: &str, drawing: &Drawing, expected: &[Expected]) {
    let mut together: BTreeMap<(usize, &str, String), Vec<&Expected>> = BTreeMap::new();
    for series in expected {
        let charts = drawing.panels.iter().enumerate();
        let charts: Vec<usize> =
            charts.filter(|(_, p)| p.heading.contains(&series.chart)).map(|(i, _)| i).collect();
        let [chart] = charts[..] else {
            let all: Vec<_> = drawing.panels.iter().map(|panel| &panel.heading).collect();
            panic!("{name}: {:?} is the heading of {charts:?} in {all:?}", series.chart)
        };
        let key = (chart, series.label.as_str(), format!("{:?}", series.kind));
        together.entry(key).or_default().push(series);
    }
    let looks_of = |panel: &Panel, label: &str, kind: Kind| -> Vec<Look> {
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
    };
    for ((chart, label, kind), all) in &together {
        let panel = &drawing.panels[*chart];
        let what = format!("{name}, {:?}, {label:?}, {kind}", panel.heading);
        let kind = all[0].kind;
        let looks = looks_of(panel, label, kind);
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
                && looks_of(panel, label, kind).iter().any(|look| looks.contains(look))
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

type Method = &'static dyn AnyMethod;

fn of(name: &str) -> Method {
    method_named(name).expect("a method of the library")
}

fn title(method: Method) -> &'static str {
    method.info().title
}

fn papers() -> impl Iterator<Item = Method> {
    METHODS.iter().copied().filter(|method| in_paper(*method))
}

/// Every sample of a run from rest: time and state.
fn run(method: Method, theta_0: f64, step: f64, duration: f64) -> Vec<(f64, Phase)> {
    let grid = Grid::with_duration(step, duration).unwrap();
    let mut samples = Vec::new();
    let mut keep = |_: u64, t: f64, z: Phase| samples.push((t, z));
    method.run(&Pendulum::PAPER, Phase::at_rest(theta_0), &grid, &mut keep);
    samples
}

/// H − H₀ along a run.
fn energy_error(run: &[(f64, Phase)]) -> impl Iterator<Item = Point> {
    let initial = Pendulum::PAPER.energy(run[0].1);
    run.iter().map(move |(t, z)| (*t, Pendulum::PAPER.energy(*z) - initial))
}

fn plane(z: Phase) -> Point {
    (z.theta, z.omega)
}

fn figure_2() -> Vec<Expected> {
    let rows = STUDY.convergence.iter().flat_map(|row| {
        let points: Vec<Point> = STEPS.into_iter().zip(row.drift).collect();
        [Line, Marker].map(|kind| (title(row.method), kind, points.clone()))
    });
    rows.map(|(label, kind, points)| expect("energy error", label, kind, points)).collect()
}

fn figure_3() -> Vec<Expected> {
    let mut expected = Vec::new();
    for method in papers() {
        let samples = run(method, 1.0, 0.01, 1000.0);
        let error: Vec<Point> = energy_error(&samples).collect();
        let drawn = error.iter().copied().step_by(50);
        let heading = format!("{}, H − H_{{0}} (J)", title(method));
        expected.push(expect(heading, title(method), Line, drawn));
        let mut largest = 0.0_f64;
        let so_far = error.iter().enumerate().filter_map(|(n, (t, error))| {
            largest = largest.max(error.abs());
            (n > 0 && n % 100 == 0).then_some((*t, largest))
        });
        let so_far: Vec<Point> = so_far.collect();
        let row = STUDY.long_run.iter().find(|row| title(row.method) == title(method)).unwrap();
        assert_eq!(so_far.last().unwrap().1, row.drift);
        expected.push(expect("so far (J)", title(method), Line, so_far));
    }
    expected
}

fn figure_4() -> Vec<Expected> {
    let samples = run(of("forward-euler"), 0.05, 0.01, 10.0);
    let frequency = 9.81_f64.sqrt();
    let label = "Forward Euler";
    vec![
        expect(
            "θ (rad)",
            "θ_{0} cos ω_{0}t",
            Line,
            samples.iter().map(|(t, _)| (*t, 0.05 * (frequency * t).cos())),
        ),
        expect("θ (rad)", label, Line, samples.iter().map(|(t, z)| (*t, z.theta))),
        expect("H − H", label, Line, energy_error(&samples)),
    ]
}

fn figure_5() -> Vec<Expected> {
    let orbits = phase_portrait::THETA_0.into_iter().map(|theta_0| {
        let period = exact::period(&Pendulum::PAPER, theta_0).unwrap();
        // Once round, and the step that closes it.
        let orbit = run(of("rk4"), theta_0, 0.01, 0.01 * (period / 0.01).ceil());
        expect("ω (rad/s)", "RK4", Line, orbit.into_iter().map(|(_, z)| plane(z)))
    });
    orbits.collect()
}

fn figure_6() -> Vec<Expected> {
    let samples = run(of("rk4"), 3.0, 0.001, 15.0);
    vec![expect("θ (rad)", "RK4", Line, samples.iter().map(|(t, z)| (*t, z.theta)))]
}

fn figure_7() -> Vec<Expected> {
    let mut expected = Vec::new();
    for row in &STUDY.work {
        let pick = |pick: fn(&small_angle::Errors) -> f64| {
            row.points.iter().map(move |(n, errors)| (*n as f64, pick(errors)))
        };
        for kind in [Line, Marker] {
            let label = title(row.method);
            expected.push(expect("against formula", label, kind, pick(|e| e.formula)));
            expected.push(expect("against truth", label, kind, pick(|e| e.truth)));
        }
    }
    expected
}

fn energy_predicted() -> Vec<Expected> {
    let all = predictions();
    let ids = ["fe", "se", "rk4", "vv"];
    let rows = STUDY.convergence.iter().zip(ids).map(|(row, id)| {
        let ratios = STEPS.into_iter().zip(row.drift).map(|(h, drift)| {
            let cell = all.iter().find(|cell| cell.id == format!("T4.{id}.{h}")).unwrap();
            (h, drift / cell.value - 1.0)
        });
        expect(title(row.method), "", Marker, ratios)
    });
    rows.collect()
}

fn cancellation() -> Vec<Expected> {
    let verlet = of("stormer-verlet");
    let row = STUDY.small_angle.iter().find(|row| title(row.method) == title(verlet)).unwrap();
    let truth = STEPS.into_iter().zip(row.errors.map(|errors| errors.truth));
    let ladder = small_angle::ladder(verlet);
    let formula = ladder.iter().map(|(h, errors)| (*h, errors.formula));
    vec![
        expect("RMS", "measured against the formula", Line, formula),
        expect("RMS", "measured against the truth", Marker, truth),
    ]
}

fn two_eulers() -> Vec<Expected> {
    let mut expected = Vec::new();
    for name in ["forward-euler", "symplectic-euler"] {
        let samples = run(of(name), 1.0, 0.01, 1000.0);
        for (heading, from) in [("the first second", 0.0), ("the thousandth second", 999.0)] {
            let second = samples.iter().filter(|(t, _)| (from - 0.005..from + 1.005).contains(t));
            // The curve of each turn goes a little over the top.
            let turns = second.flat_map(|(t, z)| {
                let nearest = (z.theta / (2.0 * PI)).round();
                [-1.0, 0.0, 1.0].map(|turn| (*t, z.theta - 2.0 * PI * (nearest + turn)))
            });
            expected.push(expect(heading, title(of(name)), Line, turns));
        }
    }
    expected
}

fn level_curves_expected() -> Vec<Expected> {
    let rows = level_curves::run().into_iter().map(|row| {
        let label = title(row.method);
        let points = level_curves::points(row.method, row.step).into_iter().map(plane);
        expect(format!("{label}, h = {} s", row.step), label, Marker, points)
    });
    rows.collect()
}

fn tilted_curve_expected() -> Vec<Expected> {
    let tilted_curve::Run { method, step, points, curves } = tilted_curve::run();
    let label = format!("{}, h = {step} s", title(method));
    let mut expected = vec![expect("ω (rad/s)", label, Marker, points.into_iter().map(plane))];
    for (order, curve) in curves {
        // The curve with one term has its name beside it and not in the legend.
        let label = match order {
            0 => "true orbit, H",
            7 => "H̃, 7 terms",
            _ => continue,
        };
        expected.push(expect("ω (rad/s)", label, Line, curve.into_iter().map(plane)));
    }
    expected
}

fn five_periods() -> Vec<Expected> {
    let mut expected = Vec::new();
    for (chart, ladder) in
        [("of RK4", readings::of_rk4()), ("of the exact motion", readings::of_the_exact_motion())]
    {
        for (i, reading) in readings::READINGS.into_iter().enumerate() {
            let line: Vec<Point> = ladder.iter().map(|e| (e.step, e.by[i])).collect();
            expected.push(expect(chart, reading.replace('\'', "’"), Line, line));
        }
    }
    expected
}

fn standard_map_expected() -> Vec<Expected> {
    let mut expected = Vec::new();
    for k in standard_map::PARAMETERS {
        let orbits = standard_map::orbits(k);
        for (label, escapes) in [("orbits that stay", false), ("orbits that escape", true)] {
            let some = orbits.iter().filter(|orbit| orbit.escapes == escapes);
            let points: Vec<Point> = some.flat_map(|orbit| orbit.points.clone()).collect();
            if !points.is_empty() {
                expected.push(expect(format!("K = {k},"), label, Dots, points));
            }
        }
    }
    expected
}

fn rounding_walk_expected() -> Vec<Expected> {
    let pendulum = Pendulum::PAPER;
    let x = pendulum.small_angle_frequency() * rounding_walk::STEP;
    let walks = rounding_walk::walks(|z| {
        let z = theory::Dimensionless::from_phase(&pendulum, z);
        z.energy() + theory::stormer_verlet::correction(z, x)
    });
    let label = "Störmer–Verlet";
    let growth = rounding_walk::growth(&walks).into_iter().map(|(n, moved)| (n as f64, moved));
    let mut expected = vec![expect("movement in n steps", label, Marker, growth)];
    for walk in &walks {
        let steps = |i: usize| (i as u64 * rounding_walk::SAMPLED) as f64;
        let line = walk.iter().enumerate().step_by(50).map(|(i, error)| (steps(i), *error));
        expected.push(expect("relative error", label, Line, line));
    }
    expected
}

/// The methods of a figure of costs, from the top.
fn compared(name: &str) -> Vec<&'static str> {
    let higher: &[&str] = match name {
        "cost_higher_order" => &["forest-ruth", "gauss-6", "blanes-moan-6", "processed-6"],
        _ => &[],
    };
    [&["forward-euler", "symplectic-euler", "rk4", "stormer-verlet"], higher].concat()
}

/// A hundred swings to a thousandth of a radian: a cell of the map.
fn cost(name: &str) -> Vec<Expected> {
    let mut cells = MAP.iter().filter(|cell| cell.periods == 100);
    let cell = cells.find(|cell| (cell.allowed / 1e-3 - 1.0).abs() < 1e-9).expect("a cell");
    let rows = compared(name).into_iter().rev().zip(0..);
    let markers = rows.map(|(method, row)| {
        let advice = cell.ranking.iter().find(|advice| advice.method.info().name == method);
        (advice.expect("an advice").evaluations as f64, f64::from(row) + 0.5)
    });
    vec![expect("", "", Marker, markers)]
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

fn poincare() -> Vec<Expected> {
    vec![expect("ω (rad/s)", "", Dots, beyond::poincare(24_000).into_iter().map(plane))]
}

fn separation() -> Vec<Expected> {
    let double = beyond::equals();
    let starts = [[2.0, 2.5], [0.2, 0.25]].into_iter();
    let runs = starts.map(|start| {
        let label = format!("released at {} and {} rad", start[0], start[1]);
        let apart = beyond::separation(&double, start, 1e-9, (0.002, 10_000));
        expect("distance", label, Line, apart)
    });
    runs.collect()
}

fn kapitza() -> Vec<Expected> {
    let (stands, leaves): (Vec<_>, Vec<_>) =
        beyond::trials().into_iter().partition(|trial| trial.stands);
    let at = |trial: beyond::Trial| (trial.frequency, trial.amplitude);
    vec![
        expect("amplitude", "stands", Marker, stands.into_iter().map(at)),
        expect("amplitude", "falls over or rocks", Marker, leaves.into_iter().map(at)),
    ]
}

fn double_pendulum_trace() -> Vec<Expected> {
    let double = beyond::equals();
    let paths = [2.0, 2.01].into_iter().map(|upper| {
        let path = beyond::path(&double, [upper, 2.5], (0.001, 6000));
        let lower = |(_, z): (f64, DoublePhase)| double.bobs(z)[1];
        expect("y (m)", format!("from {upper} rad"), Line, path.into_iter().map(lower))
    });
    paths.collect()
}

fn turning_ellipse() -> Vec<Expected> {
    let centre = Kepler::new(1.0).unwrap();
    let ellipse = Ellipse::new(&centre, 1.0, 0.6).unwrap();
    let states = beyond::turning(&centre, &ellipse, 100, 30);
    let at = |z: &PlanePhase| (z.x, z.y);
    // The 3rd, 6th, … revolution.
    let thirds = (3..=30).step_by(3).flat_map(|n| states[100 * n - 100..100 * n].iter().map(at));
    let thirds: Vec<Point> = thirds.collect();
    vec![
        expect("y (m)", "each third revolution", Dots, thirds),
        expect("y (m)", "the thirtieth", Line, states[2898..].iter().map(at)),
    ]
}

fn resonances() -> Vec<Expected> {
    let line = |name| {
        let label = title(of(name));
        expect(format!("(J), {label}"), "", Line, resonance::line(of(name)))
    };
    vec![line("blanes-moan-6"), line("stormer-verlet")]
}

fn truncation() -> Vec<Expected> {
    let mut expected =
        vec![expect("smallest", "splitting of the separatrix", Marker, truncation::split())];
    for x in truncation::STEPS {
        let errors = truncation::errors(1.0, x).into_iter().enumerate();
        let line: Vec<Point> = errors.map(|(k, error)| (2.0 * k as f64, error)).collect();
        expected.push(expect("largest change", format!("x = {x}"), Line, line));
    }
    for theta_0 in truncation::STARTS {
        let label = format!("from {theta_0} rad");
        expected.push(expect("smallest", label, Marker, truncation::least(theta_0)));
    }
    expected
}

fn widths() -> Vec<Expected> {
    use enclosure::{Shape, widths};
    let shapes = [("rectangles, turned", Shape::Turned), ("boxes", Shape::Box)];
    shapes.map(|(label, shape)| expect("width", label, Line, widths(shape))).into()
}

/// One step from where all the stencils begin: its ends.
fn stencil(name: &'static str, step: f64) -> Vec<Expected> {
    let (pendulum, start) = (Pendulum::PAPER, Phase { theta: -1.2, omega: 1.0 });
    let mut ends = Vec::new();
    let mut keep = |_: u64, _: f64, z: Phase| ends.push(plane(z));
    of(name).run(&pendulum, start, &Grid::new(step, 1).unwrap(), &mut keep);
    let truth = plane(Motion::new(&pendulum, start).unwrap().at(step));
    vec![
        expect("ω (rad/s)", title(of(name)), Marker, ends),
        expect("ω (rad/s)", format!("true motion after {step} s"), Marker, [truth]),
    ]
}

fn swings() -> Vec<Expected> {
    let mut expected = Vec::new();
    for theta_0 in [0.5, 1.5, 2.5, 3.1] {
        let label = format!("{theta_0} rad");
        let motion = Motion::new(&Pendulum::PAPER, Phase::at_rest(theta_0)).unwrap();
        let curve = (0..=800).map(|k| 0.01 * f64::from(k)).map(|t| (t, motion.at(t).theta));
        let period = motion.period().unwrap();
        let ratio = period / (2.0 * PI / 9.81_f64.sqrt());
        expected.push(expect("angle θ (rad)", &label, Line, curve));
        expected.push(expect("angle θ (rad)", &label, Marker, [(period, theta_0)]));
        expected.push(expect("period T/T", &label, Marker, [(theta_0, ratio)]));
    }
    expected
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
