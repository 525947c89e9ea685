//! An SVG, read back as who looks at it would: legend, headings and ticks, lines and markers.
//!
//! Nothing of `charts` is used: a drawing is taken for an SVG of anybody's.

use std::collections::{BTreeSet, HashMap};
use std::f64::consts::PI;

use roxmltree::{Document, Node};

pub type Point = (f64, f64);

/// Coordinates have one decimal, so that a point is off by 0.05 units each way; so are the two
/// ticks from which an axis is read, which beyond them is off by as much again, and more where they
/// are close.
pub const PLACE: f64 = 0.5;
/// A line may stray by 0.1 units from what it shows, and where it goes up and down several times
/// within 2 units, it does so in their middle.
pub const LINE: f64 = 1.6;
/// Dots that are within a square unit are one.
pub const DOT: f64 = 1.5;
/// A line with more points than this has only a few of them marked.
pub const MARKED: usize = 40;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Line,
    Marker,
    Dots,
}
use Kind::{Dots, Line, Marker};

/// What tells the series of a drawing apart: class, dash, and shape of the marker.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    pub kind: Kind,
    pub class: String,
    pub detail: String,
}

/// How values are spread along an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scale {
    Linear,
    Log,
}

/// From units to values: two ticks, and how values grow between them.
#[derive(Clone, Copy, Debug)]
pub struct Axis {
    pub from: (f64, f64),
    pub to: (f64, f64),
    pub scale: Scale,
}

impl Axis {
    /// The unit of a value; `None` where it has no place.
    pub fn unit(&self, value: f64) -> Option<f64> {
        let place = |value: f64| match self.scale {
            Scale::Linear => value,
            Scale::Log => value.log10(),
        };
        let share = (place(value) - place(self.from.1)) / (place(self.to.1) - place(self.from.1));
        let unit = self.from.0 + share * (self.to.0 - self.from.0);
        unit.is_finite().then_some(unit)
    }

    /// Reads an axis off its labelled ticks; each has to be where the two outermost put it.
    pub fn read(mut ticks: Vec<Tick>, name: &str) -> Option<Self> {
        ticks.sort_by(|a, b| a.0.total_cmp(&b.0));
        let ((first, last), count) = ((*ticks.first()?, *ticks.last()?), ticks.len());
        assert!(count >= 2, "{name}: one tick is no axis");
        // Powers of ten that differ; a linear axis may have one that is common to all.
        let powers: BTreeSet<i64> =
            ticks.iter().filter(|t| t.1 > 0.0).map(|t| t.1.log10().floor() as i64).collect();
        let scale = match powers.len() > 1 {
            true if ticks.iter().all(|tick| tick.2) => Scale::Log,
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
pub fn are_even(ticks: &[Tick]) -> bool {
    let step = |pair: &[Tick]| pair[1].1 - pair[0].1;
    let mean = (ticks[ticks.len() - 1].1 - ticks[0].1) / (ticks.len() - 1) as f64;
    // The labels are rounded to their last digit.
    ticks.windows(2).all(|pair| (step(pair) / mean - 1.0).abs() < 0.01)
}

/// One chart of a drawing.
#[derive(Debug)]
pub struct Panel {
    /// What stands above it, headings and what its y axis shows; of a chart without any, what
    /// stands above its neighbour, whose y axis it shares.
    pub heading: String,
    pub left: f64,
    pub top: f64,
    pub right: f64,
    pub bottom: f64,
    pub x: Axis,
    pub y: Axis,
    /// What its rows are, from the bottom, where its y axis has names for numbers. The lowest row
    /// is at 0.5.
    pub rows: Vec<String>,
    pub drawn: Vec<(Look, Vec<Vec<Point>>)>,
}

/// A figure: its legend and its charts.
pub struct Drawing {
    pub legend: Vec<(String, Vec<Look>)>,
    pub panels: Vec<Panel>,
}

/// The text of an element, raised and lowered parts in braces.
pub fn text(node: Node) -> String {
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
pub fn value_of(label: &str) -> Option<(f64, bool)> {
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
pub fn commands(d: &str) -> Vec<(char, Vec<f64>)> {
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
pub fn strokes(d: &str) -> Vec<Vec<Point>> {
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
pub fn series(node: Node) -> Option<(Look, Vec<Vec<Point>>)> {
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
    pub fn read(svg: &str, name: &str) -> Self {
        let document = Document::parse(svg).expect("an SVG");
        let nodes: Vec<Node> =
            document.root_element().children().filter(Node::is_element).collect();
        let is_panel = |i: &usize| nodes[*i].tag_name().name() == "clipPath";
        let starts: Vec<usize> = (0..nodes.len()).filter(is_panel).collect();
        let mut panels: Vec<Panel> = Vec::new();
        for (i, start) in starts.iter().enumerate() {
            let end = starts.get(i + 1).copied().unwrap_or(nodes.len());
            let since = if i == 0 { 0 } else { starts[i - 1] };
            let parts = (&nodes[since..*start], &nodes[*start..end]);
            panels.extend(Panel::read(parts, panels.last(), name));
        }
        Self { legend: legend(&nodes, name), panels }
    }
}

/// The entries of legends, and the labels at the ends of lines.
fn legend(nodes: &[Node], name: &str) -> Vec<(String, Vec<Look>)> {
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
    legend
}

/// A tick: where it is, its value, and whether that is written as a power of ten.
type Tick = (f64, f64, bool);

/// The labelled ticks of both axes of a chart that ends at `bottom`, and where its y axis has names
/// for numbers.
fn ticks(inside: &[Node], bottom: f64) -> (Vec<Tick>, Vec<Tick>, Vec<(f64, String)>) {
    let labels = Label::all(inside);
    let label_of = |near: &dyn Fn(&Label) -> bool| labels.iter().find(|label| near(label));
    let (mut x_ticks, mut y_ticks, mut names) = (Vec::new(), Vec::new(), Vec::new());
    let axis = inside.iter().find(|node| node.attribute("class") == Some("axis"));
    let mut at = (0.0, 0.0);
    for (command, numbers) in axis.map_or(vec![], |a| commands(a.attribute("d").unwrap())) {
        match (command, &numbers[..]) {
            ('M', [x, y]) => at = (*x, *y),
            ('v', [6.0]) => {
                let near = label_of(&|label| {
                    label.anchor == "middle"
                        && (label.y - bottom - 22.0).abs() < 0.2
                        && (label.x - at.0).abs() < 20.0
                });
                let value = near.and_then(|label| value_of(&label.text));
                x_ticks.extend(value.map(|(value, power)| (at.0, value, power)));
            }
            ('h', [-6.0]) => {
                let near =
                    label_of(&|label| label.anchor == "end" && (label.y - at.1 - 6.0).abs() < 0.2);
                match near.map(|label| (value_of(&label.text), &label.text)) {
                    Some((Some((value, power)), _)) => y_ticks.push((at.1, value, power)),
                    Some((None, text)) => names.push((at.1, text.clone())),
                    None => {}
                }
            }
            _ => {}
        }
    }
    (x_ticks, y_ticks, names)
}

/// A text, and where it stands.
pub struct Label {
    pub x: f64,
    pub y: f64,
    /// `start`, `middle` or `end`.
    pub anchor: String,
    pub text: String,
}

impl Label {
    pub fn all(nodes: &[Node]) -> Vec<Self> {
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
    /// The chart in the nodes `inside`, which begin with its clip path, below what stands `above`;
    /// `None` for a sketch. `last` is the chart before it.
    fn read((above, inside): (&[Node], &[Node]), last: Option<&Self>, name: &str) -> Option<Self> {
        let number = |name: &str| {
            let rect = inside[0].first_element_child().expect("a rectangle");
            rect.attribute(name).unwrap().parse::<f64>().unwrap()
        };
        // The plot and two units around it.
        let (left, top) = (number("x") + 2.0, number("y") + 2.0);
        let (right, bottom) = (left + number("width") - 4.0, top + number("height") - 4.0);
        let heading = Label::all(above).into_iter().filter(|label| {
            let above = last.filter(|last| last.top < top - 1.0);
            label.anchor == "start"
                && label.y < top
                && above.is_none_or(|last| label.y > last.bottom)
        });
        let mut heading = heading.map(|label| label.text).collect::<Vec<_>>().join(" | ");
        if let Some(last) = last.filter(|_| heading.is_empty()) {
            heading.clone_from(&last.heading);
        }
        let (x_ticks, mut y_ticks, mut names) = ticks(inside, bottom);
        let x = Axis::read(x_ticks, name)?;
        names.sort_by(|a, b| b.0.total_cmp(&a.0));
        let rows = names.iter().zip(0..);
        y_ticks.extend(rows.map(|((unit, _), row)| (*unit, f64::from(row) + 0.5, false)));
        let rows = names.into_iter().map(|(_, name)| name).collect();
        // A chart whose left neighbour has the same axis does not repeat its numbers.
        let y = Axis::read(y_ticks, name).or_else(|| last.map(|last| last.y)).expect("a y axis");
        let drawn = inside.iter().filter_map(|node| series(*node)).collect();
        Some(Self { heading, left, top, right, bottom, x, y, rows, drawn })
    }

    pub fn contains(&self, (x, y): Point, margin: f64) -> bool {
        (self.left - margin..=self.right + margin).contains(&x)
            && (self.top - margin..=self.bottom + margin).contains(&y)
    }

    /// The values as points of the drawing, as far as they are on it.
    pub fn places(&self, values: &[Point], margin: f64) -> Vec<Point> {
        let place = |&(x, y): &Point| Some((self.x.unit(x)?, self.y.unit(y)?));
        values.iter().filter_map(place).filter(|place| self.contains(*place, margin)).collect()
    }
}

/// Points in squares, to find those near another.
pub struct Squares {
    pub side: f64,
    pub points: HashMap<(i64, i64), Vec<Point>>,
}

impl Squares {
    pub fn new(points: &[Point], side: f64) -> Self {
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
    pub fn has_near(&self, at: Point) -> bool {
        let (i, j) = self.square(at);
        let near = |p: &Point| (p.0 - at.0).hypot(p.1 - at.1) <= self.side;
        (i - 1..=i + 1).any(|i| {
            (j - 1..=j + 1)
                .any(|j| self.points.get(&(i, j)).is_some_and(|points| points.iter().any(near)))
        })
    }
}

/// A stroke as points a quarter of a unit apart.
pub fn dense(stroke: &[Point]) -> Vec<Point> {
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
