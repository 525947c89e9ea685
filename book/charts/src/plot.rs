//! One chart on the drawing: headings, axes, curves, marks and labels.

use std::fmt::Write;

use super::axis::Scale;
use super::chart::{Chart, Mark, Series};
use super::ends::{self, End};
use super::figure::ENTRY;
use super::labels::Labels;
use super::path::{self, Num, Point};
use super::regions::{self, Map, Name};
use super::style;
use super::text::{draw_text, escape, line, width};
use super::{GAP, RIGHT, ROW};

/// Above this many points a line has only [`FEW`] of them marked.
const MANY: usize = 40;
const FEW: usize = 7;
/// An arrow that ends at a marker stops this far from its middle.
const MARKER: f64 = 7.0;
/// Coordinates beyond this are of no use to a browser.
const FAR: f64 = 1e6;

/// A chart's place on the drawing.
pub(super) struct Plot<'a> {
    pub chart: &'a Chart,
    x: &'a Scale<'a>,
    y: &'a Scale<'a>,
    /// Whether the label of the x axis is written, and the numbers and label of the y axis.
    written: [bool; 2],
    /// Where the room for them begins.
    edge: f64,
    pub left: f64,
    pub right: f64,
    pub top: f64,
    pub bottom: f64,
}

/// What stands above the plot: where it begins, and the text.
type Heading<'a> = (f64, &'a str);

impl<'a> Plot<'a> {
    pub fn new(
        chart: &'a Chart,
        [x, y]: [&'a Scale<'a>; 2],
        written: [bool; 2],
        [edge, left, right]: [f64; 3],
        top: f64,
    ) -> Self {
        let bottom = top + chart.height_for(right - left);
        Self { chart, x, y, written, edge, left, right, top, bottom }
    }

    /// Draws the chart, with labels at the `ends` of its lines, and returns where it ends.
    pub fn draw(mut self, out: &mut String, clip: &str, ends: &[End]) -> f64 {
        self.draw_headings(out);
        let Self { chart, left, right, top, bottom, .. } = self;
        let (x, y) = (Num(left - 2.0), Num(top - 2.0));
        let (w, h) = (Num(right - left + 4.0), Num(bottom - top + 4.0));
        let rect = format!(r#"<rect x="{x}" y="{y}" width="{w}" height="{h}"/>"#);
        line(out, format!(r#"<clipPath id="{clip}">{rect}</clipPath>"#));
        let mut strokes = self.draw_marks(out);
        if !chart.sketch {
            self.draw_axes(out);
        }
        let mut unnamed = Vec::new();
        if let Some(map) = &chart.map {
            unnamed = self.draw_map(out, map);
        }
        self.draw_series(out, clip, &mut strokes);
        Labels { plot: &self, strokes, taken: Vec::new() }.draw(out);
        ends::draw(out, ends, [left, right, top]);
        if self.written[0] {
            draw_text(out, "", ((left + right) / 2.0, bottom + 44.0), "middle", &chart.x.label);
        }
        let end = bottom
            + match self.written[0] {
                true => 56.0,
                false if chart.sketch => 0.0,
                false => 28.0,
            };
        if chart.map.is_some() { self.draw_map_key(out, &unnamed, end) } else { end }
    }

    /// Makes room for what stands above the plot, and draws it.
    fn draw_headings(&mut self, out: &mut String) {
        let mut headings = self.headings();
        if self.chart.y.label.is_empty() {
            headings.retain(|row| row.iter().any(|(_, label)| !label.is_empty()));
        }
        if !self.chart.heading.is_empty() {
            headings.push(vec![(self.left, &self.chart.heading)]);
        }
        let gap = if self.chart.heading.is_empty() { 0.0 } else { GAP };
        let offset = headings.len() as f64 * ROW + 12.0 + gap;
        (self.top, self.bottom) = (self.top + offset, self.bottom + offset);
        for (row, headings) in headings.iter().enumerate() {
            for (x, label) in headings.iter().filter(|(_, label)| !label.is_empty()) {
                draw_text(out, "", (*x, self.top - 17.0 - row as f64 * ROW), "start", label);
            }
        }
    }

    /// Draws lines, dots and markers, and adds them to the `strokes` that labels avoid.
    fn draw_series(&self, out: &mut String, clip: &str, strokes: &mut Vec<Vec<Point>>) {
        let all = &self.chart.series;
        let dotted = all.iter().enumerate().filter(|(_, s)| s.style.has_marker());
        let dotted: Vec<_> = dotted.map(|(i, s)| (s.style, self.marked(s, i))).collect();
        let under_marker = |end: &Point| {
            dotted.iter().any(|(_, marked)| marked.iter().any(|&p| same_place(p, *end)))
        };
        let clipped = format!(r#" clip-path="url(#{clip})""#);
        for Series { points, style, hover, .. } in all.iter().filter(|s| s.style.has_line()) {
            let mut drawn = self.strokes(points);
            let last = drawn.last_mut().filter(|_| style.arrow);
            let head = last.and_then(|stroke| {
                let short = if stroke.last().is_some_and(under_marker) { MARKER } else { 0.0 };
                path::head(stroke, short)
            });
            let d = match style.filled {
                true => {
                    let closed = drawn.iter().map(|stroke| path::polyline([stroke]) + "z");
                    closed.collect::<Vec<_>>().join("\n")
                }
                false => path::polyline(&drawn),
            };
            let element = path::element(&format!("{}{clipped}", style.line_attributes()), &d);
            match hover.as_str() {
                "" => line(out, element),
                name => {
                    line(out, element.replace("/>", ">"));
                    line(out, format!("<title>{}</title></path>", escape(name)));
                }
            }
            if let Some(corners) = head {
                line(out, style.head(corners, &clipped));
                strokes.push(corners.to_vec());
            }
            strokes.extend(drawn);
        }
        for series in all.iter().filter(|s| s.style.dots) {
            let dots = self.inside(series);
            line(out, series.style.dotted(dots.clone()));
            strokes.extend(dots.into_iter().map(|point| vec![point]));
        }
        for (style, marked) in dotted {
            if !marked.is_empty() {
                line(out, style.markers(marked.iter().copied()));
            }
            strokes.extend(marked.into_iter().map(|point| vec![point]));
        }
    }

    /// Draws the cells of a map, the outlines of its regions, and their names where there is room;
    /// returns the names that stand nowhere.
    fn draw_map<'m>(&self, out: &mut String, map: &'m Map) -> Vec<&'m Name> {
        let edges = |values: &[f64], to: &dyn Fn(f64) -> Option<f64>, low: f64, high: f64| {
            let pixels = values.iter().map(|v| to(*v).unwrap_or(low).clamp(low, high));
            pixels.collect::<Vec<f64>>()
        };
        let x = edges(&map.x, &|v| self.x_pixel(v), self.left, self.right);
        let y = edges(&map.y, &|v| self.y_pixel(v), self.top, self.bottom);
        for (i, cell) in map.cells.iter().enumerate() {
            let (column, row) = (i / map.rows(), i % map.rows());
            let (a, b) = (Num(x[column]), Num(y[row]));
            let d = format!("M{a},{b}H{}V{}H{a}z", Num(x[column + 1]), Num(y[row + 1]));
            let look = style::fill(map.names[cell.name].fill);
            line(out, format!(r#"<g class="cell"><path {look} d="{d}"/>"#));
            self.draw_lines(out, "", &cell.says);
            line(out, "</g>".into());
        }
        self.draw_lines(out, "prompt", &map.prompt);
        let regions = map.regions();
        for region in &regions {
            let d = regions::closed(&region.outlines(), &x, &y);
            line(out, path::element(r#"class="edge""#, &d));
        }
        let mut unnamed: Vec<&Name> = map.names.iter().collect();
        for region in &regions {
            let title = &map.names[region.name].title;
            let numbers = map.numbers(region).unwrap_or_default();
            let wide = width(title).max(width(&numbers)) + 8.0;
            let place = |wide, high| region.place(&x, &y, (wide, high));
            let two_lines = place(wide, 2.0 * ROW - 10.0).filter(|_| !numbers.is_empty());
            // A line of text stands on its base line.
            if let Some((x, y)) = two_lines {
                draw_text(out, "halo on", (x, y - 4.0), "middle", title);
                draw_text(out, "halo on", (x, y + 16.0), "middle", &numbers);
            } else if let Some((x, y)) = place(width(title) + 8.0, 19.0) {
                draw_text(out, "halo on", (x, y + 6.0), "middle", title);
            } else {
                continue;
            }
            unnamed.retain(|name| name.title != *title);
        }
        unnamed
    }

    /// Two lines of text below the chart's x axis.
    fn draw_lines(&self, out: &mut String, class: &str, lines: &[String; 2]) {
        for (row, text) in lines.iter().enumerate() {
            let y = self.bottom + 78.0 + row as f64 * ROW;
            draw_text(out, class, (self.edge, y), "start", text);
        }
    }

    /// Draws the legend of those of a map's names that stand nowhere in it, below the `top` and
    /// what the cells say there, and returns where it ends.
    fn draw_map_key(&self, out: &mut String, unnamed: &[&Name], top: f64) -> f64 {
        const BOX: (f64, f64) = (30.0, 18.0);
        let (mut x, mut y) = (self.edge, top + 2.0 * ROW + 24.0);
        for Name { title, fill } in unnamed {
            let wide = BOX.0 + 8.0 + width(title) + 16.0;
            if x + wide > self.right + RIGHT && x > self.edge {
                (x, y) = (self.edge, y + ROW);
            }
            line(out, ENTRY.into());
            let (w, h) = (Num(BOX.0), Num(BOX.1));
            let d = format!("M{},{}h{w}v{h}h-{w}z", Num(x), Num(y - 9.0));
            line(out, format!(r#"<g class="cell"><path {} d="{d}"/></g>"#, style::fill(*fill)));
            line(out, format!("<path class=\"edge\" d=\"{d}\"/>"));
            draw_text(out, "", (x + BOX.0 + 8.0, y + 6.0), "start", title);
            line(out, "</g>".into());
            x += wide;
        }
        y + if unnamed.is_empty() { -16.0 } else { 14.0 }
    }

    fn x_pixel(&self, value: f64) -> Option<f64> {
        let fraction = self.x.fraction(value)?;
        Some((self.left + fraction * (self.right - self.left)).clamp(-FAR, FAR))
    }

    fn y_pixel(&self, value: f64) -> Option<f64> {
        let fraction = self.y.fraction(value)?;
        Some((self.bottom - fraction * (self.bottom - self.top)).clamp(-FAR, FAR))
    }

    pub fn pixel(&self, (x, y): (f64, f64)) -> Option<Point> {
        self.x_pixel(x).zip(self.y_pixel(y))
    }

    /// Where a line across the plot is, unless it is outside.
    fn x_inside(&self, value: f64) -> Option<f64> {
        inside(self.x_pixel(value)?, self.left, self.right)
    }

    /// The series as simplified strokes, cut where a point has no place.
    pub fn strokes(&self, points: &[(f64, f64)]) -> Vec<Vec<Point>> {
        let pixels: Vec<Option<Point>> = points.iter().map(|&point| self.pixel(point)).collect();
        let strokes = pixels.split(Option::is_none).filter(|stroke| !stroke.is_empty());
        let stroke = |stroke: &[Option<Point>]| stroke.iter().copied().flatten().collect();
        strokes.map(stroke).map(|s: Vec<_>| path::thin(&s, self.left, self.right)).collect()
    }

    /// The points of the series that are in the plot.
    fn inside(&self, series: &Series) -> Vec<Point> {
        let inside = |p: &&(f64, f64)| self.x.contains(p.0) && self.y.contains(p.1);
        series.points.iter().filter(inside).filter_map(|&point| self.pixel(point)).collect()
    }

    /// Where the markers of the chart's `i`-th series go: at all its points in the plot, or on a
    /// line of many points at a few, other ones than for the series before.
    fn marked(&self, series: &Series, i: usize) -> Vec<Point> {
        let points = self.inside(series);
        if points.len() <= MANY || !series.style.has_line() {
            return points;
        }
        few(points.len(), i).map(|k| points[k]).collect()
    }

    /// The labels of vertical lines and of the y axis, in as few rows as they fit into,
    /// from the row next to the plot upwards.
    fn headings(&self) -> Vec<Vec<Heading<'a>>> {
        let heading = |mark: &'a Mark| match mark {
            Mark::Vertical { at, label } if !label.is_empty() => {
                let half = width(label) / 2.0;
                let last = self.right + RIGHT - 2.0 * half;
                Some(((self.x_inside(*at)? - half).min(last).max(self.edge), label.as_str()))
            }
            _ => None,
        };
        let y_label = (self.edge, if self.written[1] { self.chart.y.label.as_str() } else { "" });
        let mut rows: Vec<Vec<Heading>> = vec![];
        for heading in self.chart.marks.iter().filter_map(heading).chain([y_label]) {
            let before = |a: &Heading, b: &Heading| a.0 + width(a.1) + 10.0 < b.0;
            let clear = |other: &Heading| before(&heading, other) || before(other, &heading);
            match rows.iter_mut().find(|row| row.iter().all(clear)) {
                Some(row) => row.push(heading),
                None => rows.push(vec![heading]),
            }
        }
        rows
    }

    /// Draws the vertical lines, and returns them as strokes, for labels to avoid.
    fn draw_marks(&self, out: &mut String) -> Vec<Vec<Point>> {
        let mut strokes = Vec::new();
        for mark in &self.chart.marks {
            let Mark::Vertical { at, .. } = mark else { continue };
            let Some(x) = self.x_inside(*at) else { continue };
            let (at, top, bottom) = (Num(x), Num(self.top), Num(self.bottom));
            line(out, format!(r#"<path class="mark" d="M{at},{top}L{at},{bottom}"/>"#));
            strokes.push(vec![(x, self.top), (x, self.bottom)]);
        }
        strokes
    }

    fn draw_axes(&self, out: &mut String) {
        let Self { left, right, top, bottom, .. } = *self;
        // As many ticks as their labels have room for.
        let room = |count: usize| {
            let ticks = self.x.ticks(count);
            let labels = ticks.iter().filter_map(|tick| tick.label.as_deref());
            let needed: f64 = labels.map(|label| width(label) + 20.0).sum();
            (needed < right - left + 20.0).then_some(ticks)
        };
        let x_ticks = (1..=6).rev().find_map(room).unwrap_or_default();
        let mut grid = String::new();
        let mut axis = format!("M{},{}V{}H{}", Num(left), Num(top), Num(bottom), Num(right));
        let mut labels = String::new();
        for tick in x_ticks {
            let Some(x) = self.x_pixel(tick.value) else {
                continue;
            };
            let length = if tick.label.is_some() { 6 } else { 3 };
            let _ = write!(axis, "M{},{}v{length}", Num(x), Num(bottom));
            if let Some(label) = tick.label {
                let _ = write!(grid, "M{},{}V{}", Num(x), Num(top), Num(bottom));
                let x = x.min(right + RIGHT - width(&label) / 2.0);
                draw_text(&mut labels, "", (x, bottom + 22.0), "middle", &label);
            }
        }
        for tick in self.y.ticks(self.chart.y_ticks()) {
            let Some(y) = self.y_pixel(tick.value) else {
                continue;
            };
            let length = if tick.label.is_some() { -6 } else { -3 };
            let _ = write!(axis, "M{},{}h{length}", Num(left), Num(y));
            if let Some(label) = tick.label {
                let _ = write!(grid, "M{},{}H{}", Num(left), Num(y), Num(right));
                if self.written[1] {
                    draw_text(&mut labels, "", (left - 9.0, y + 6.0), "end", &label);
                }
            }
        }
        for (class, d) in [("grid", grid), ("axis", axis)] {
            line(out, path::element(&format!(r#"class="{class}""#), &path::stroke_by_stroke(&d)));
        }
        out.push_str(&labels);
    }
}

/// Whether the points are nearer than what the drawing can tell apart.
fn same_place(a: Point, b: Point) -> bool {
    (a.0 - b.0).abs() < 0.1 && (a.1 - b.1).abs() < 0.1
}

/// The place if it is between `low` and `high`; rounding may put it a little outside them.
fn inside(at: f64, low: f64, high: f64) -> Option<f64> {
    (low - 0.01..=high + 0.01).contains(&at).then(|| at.clamp(low, high))
}

/// A few of `count` points, evenly spaced, and different ones for four successive series.
fn few(count: usize, series: usize) -> impl Iterator<Item = usize> {
    (0..FEW).map(move |k| (count - 1) * (4 * k + 1 + series % 4) / (4 * FEW))
}

#[cfg(test)]
pub mod tests {
    use super::super::Axis;
    use super::super::regions::{Cell, Fill};
    use super::*;

    /// Powers of two, so that every pixel of a whole number is exact: x is at 64 + x, y at 256 − y.
    pub const PLACE: [f64; 3] = [0.0, 64.0, 576.0];

    pub fn chart(y_label: &str) -> Chart {
        Chart::new(Axis::linear("").range(0.0, 512.0), Axis::linear(y_label).range(0.0, 256.0))
            .height(256.0)
    }

    pub fn with_plot<T>(chart: &Chart, place: [f64; 3], ask: impl FnOnce(&Plot) -> T) -> T {
        let (x, y) = chart.scales();
        ask(&Plot::new(chart, [&x, &y], [true; 2], place, 0.0))
    }

    /// Catches: a marker beside the curve's end, two series marked at the same points, points
    /// bunched.
    #[test]
    fn a_few_of_many_are_spread() {
        // 28 shares for seven markers of four series.
        let marked = |series| few(281, series).collect::<Vec<_>>();
        assert_eq!(marked(0), [10, 50, 90, 130, 170, 210, 250]);
        assert_eq!(marked(3), [40, 80, 120, 160, 200, 240, 280]);
        assert_eq!(marked(5), [20, 60, 100, 140, 180, 220, 260]);
    }

    /// Catches: an arrow cut short of a marker that is only beside it, or not of one on its end.
    #[test]
    fn a_place_is_a_tenth_wide() {
        for (aside, same) in [(0.0, true), (0.09, true), (-0.09, true), (0.1, false), (-0.1, false)]
        {
            assert_eq!(same_place((aside, 0.0), (0.0, 0.0)), same, "{aside} to the right");
            assert_eq!(same_place((0.0, 0.0), (0.0, aside)), same, "{aside} down");
        }
    }

    /// A column of regions that are 18, 19, 39 and 40 high: a line needs 19, two of them 40. And
    /// narrower columns, just wide enough for the longest name with room for two lines, or not.
    ///
    /// Catches: a name in a region that is too low for it, or none where it has room; one line
    /// where there is room for its numbers too; a text beside the middle of its region.
    #[test]
    fn a_region_is_named_where_its_name_has_room() {
        let cell = |name| Cell { name, number: Some(7), says: Default::default() };
        let title = |title: &str| Name { title: title.into(), fill: Fill::Paper };
        let map = |x: [f64; 2]| Map {
            x: x.into(),
            y: vec![0.0, 18.0, 37.0, 76.0, 116.0],
            names: ["low", "a line", "nearly two", "two lines"].map(title).into(),
            cells: (0..4).map(cell).collect(),
            unit: "steps".into(),
            prompt: Default::default(),
        };
        let drawn = |x: [f64; 2]| {
            let map = map(x);
            let mut out = String::new();
            let unnamed = with_plot(&chart(""), PLACE, |plot| {
                let unnamed = plot.draw_map(&mut out, &map).into_iter();
                unnamed.map(|name| name.title.clone()).collect::<Vec<_>>()
            });
            let texts: String = out.lines().filter(|line| line.contains("halo")).collect();
            (texts, unnamed)
        };
        // The middles are at 256 less 27.5, 56.5 and 96; a base line is 6 below the middle of a
        // line, and those of two lines 4 above and 16 below it.
        let mut expected = String::new();
        for (y, text) in [
            (228.5 + 6.0, "a line"),
            (199.5 + 6.0, "nearly two"),
            (160.0 - 4.0, "two lines"),
            (160.0 + 16.0, "7 steps"),
        ] {
            draw_text(&mut expected, "halo on", (264.0, y), "middle", text);
        }
        let (texts, unnamed) = drawn([100.0, 300.0]);
        assert_eq!((texts, unnamed), (expected.lines().collect(), vec!["low".to_string()]));
        let wide = width("two lines") + 8.0;
        let (texts, unnamed) = drawn([100.0, 100.0 + wide + 0.5]);
        assert!(texts.contains("two lines") && !texts.contains("nearly two"), "{texts}");
        assert_eq!(unnamed, ["low", "nearly two"]);
        assert!(!drawn([100.0, 100.0 + wide - 0.5]).0.contains("two lines"));
    }

    /// Catches: a line on the very edge lost to rounding; one beside the plot drawn on its edge.
    #[test]
    fn only_what_is_inside_is_visible() {
        let of = |at| inside(at, 100.0, 200.0);
        assert_eq!([130.0, 99.995, 200.005].map(of), [Some(130.0), Some(100.0), Some(200.0)]);
        assert_eq!([50.0, 250.0, 99.98, 200.02].map(of), [None; 4]);
    }
}
