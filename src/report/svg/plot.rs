//! One chart on the drawing: headings, axes, curves, marks and labels.

use super::path::{self, Num, Point};
use super::text::{draw_text, line, width};
use super::{Chart, Mark, RIGHT, ROW, Scale, Series};
use std::fmt::Write;

/// Above this many points a line has only [`FEW`] of them marked.
const MANY: usize = 40;
const FEW: usize = 7;
/// An arrow that ends at a marker stops this far from its middle.
const MARKER: f64 = 7.0;
/// Between a heading and the chart above.
const GAP: f64 = 10.0;
/// Coordinates beyond this are of no use to a browser.
const FAR: f64 = 1e6;

/// A chart's place on the drawing.
pub(super) struct Plot<'a> {
    chart: &'a Chart,
    x: &'a Scale<'a>,
    y: &'a Scale<'a>,
    /// Whether the label of the x axis is written, and the numbers and label of the y axis.
    written: [bool; 2],
    /// Where the room for them begins.
    edge: f64,
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
}

/// What stands above the plot: where it begins, and the text.
type Heading<'a> = (f64, &'a str);

/// A place for a label: its anchor point, and which part of the text is there.
type Place = (Point, &'static str);

impl<'a> Plot<'a> {
    pub fn new(
        chart: &'a Chart,
        [x, y]: [&'a Scale<'a>; 2],
        written: [bool; 2],
        [edge, left, right]: [f64; 3],
        top: f64,
    ) -> Self {
        Self { chart, x, y, written, edge, left, right, top, bottom: top + chart.height }
    }

    /// Draws the chart and returns where it ends.
    pub fn draw(mut self, out: &mut String, clip: &str) -> f64 {
        let mut headings = self.headings();
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
        let Self { chart, left, right, top, bottom, .. } = self;
        let (x, y) = (Num(left - 2.0), Num(top - 2.0));
        let (w, h) = (Num(right - left + 4.0), Num(bottom - top + 4.0));
        let rect = format!(r#"<rect x="{x}" y="{y}" width="{w}" height="{h}"/>"#);
        line(out, format!(r#"<clipPath id="{clip}">{rect}</clipPath>"#));
        let mut strokes = self.draw_marks(out);
        self.draw_axes(out);
        let dotted = chart.series.iter().enumerate().filter(|(_, s)| s.style.has_marker());
        let dotted: Vec<_> = dotted.map(|(i, s)| (s.style, self.marked(s, i))).collect();
        let under_marker = |end: &Point| {
            let near = |p: &Point| (p.0 - end.0).abs() < 0.1 && (p.1 - end.1).abs() < 0.1;
            dotted.iter().any(|(_, marked)| marked.iter().any(near))
        };
        for Series { points, style, .. } in chart.series.iter().filter(|s| s.style.has_line()) {
            let mut drawn = self.strokes(points);
            let last = drawn.last_mut().filter(|_| style.is_arrow());
            let head = last.and_then(|stroke| {
                let short = if stroke.last().is_some_and(under_marker) { MARKER } else { 0.0 };
                path::head(stroke, short)
            });
            let clipped = format!(r#" clip-path="url(#{clip})""#);
            let attributes = style.line_attributes();
            let d = match style.is_filled() {
                true => drawn.iter().map(|stroke| path::polyline([stroke]) + "z").collect(),
                false => path::polyline(&drawn),
            };
            line(out, format!(r#"<path {attributes}{clipped} d="{d}"/>"#));
            if let Some(corners) = head {
                line(out, style.head(corners, &clipped));
                strokes.push(corners.to_vec());
            }
            strokes.extend(drawn);
        }
        for series in chart.series.iter().filter(|s| s.style.is_dots()) {
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
        Labels { plot: &self, strokes, taken: Vec::new() }.draw(out);
        if self.written[0] {
            draw_text(out, "", ((left + right) / 2.0, bottom + 44.0), "middle", &chart.x.label);
        }
        bottom + if self.written[0] { 56.0 } else { 28.0 }
    }

    fn x_pixel(&self, value: f64) -> Option<f64> {
        let fraction = self.x.fraction(value)?;
        Some((self.left + fraction * (self.right - self.left)).clamp(-FAR, FAR))
    }

    fn y_pixel(&self, value: f64) -> Option<f64> {
        let fraction = self.y.fraction(value)?;
        Some((self.bottom - fraction * (self.bottom - self.top)).clamp(-FAR, FAR))
    }

    fn pixel(&self, (x, y): (f64, f64)) -> Option<Point> {
        self.x_pixel(x).zip(self.y_pixel(y))
    }

    /// The visible part of a line or band, unless all of it is outside.
    fn x_extent(&self, from: f64, to: f64) -> Option<(f64, f64)> {
        visible(self.x_pixel(from)?, self.x_pixel(to)?, self.left, self.right)
    }

    fn y_extent(&self, from: f64, to: f64) -> Option<(f64, f64)> {
        visible(self.y_pixel(from)?, self.y_pixel(to)?, self.top, self.bottom)
    }

    /// The series as simplified strokes, cut where a point has no place.
    fn strokes(&self, points: &[(f64, f64)]) -> Vec<Vec<Point>> {
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

    /// Where the markers of the chart's `i`-th series go: all its points in the plot, or of many
    /// on a line a few, not the same ones as of the series before.
    fn marked(&self, series: &Series, i: usize) -> Vec<Point> {
        let points = self.inside(series);
        if points.len() <= MANY || !series.style.has_line() {
            return points;
        }
        few(points.len(), i).map(|k| points[k]).collect()
    }

    /// The labels of vertical lines and bands and of the y axis, in as few rows as they fit into,
    /// from the row next to the plot upwards.
    fn headings(&self) -> Vec<Vec<Heading<'a>>> {
        let heading = |mark: &'a Mark| match mark {
            Mark::Vertical { from, to, label } if !label.is_empty() => {
                let (a, b) = self.x_extent(*from, *to)?;
                let half = width(label) / 2.0;
                let last = self.right + RIGHT - 2.0 * half;
                Some((((a + b) / 2.0 - half).min(last).max(self.edge), label.as_str()))
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

    /// Draws lines and bands, and returns the lines as strokes, for labels to avoid.
    fn draw_marks(&self, out: &mut String) -> Vec<Vec<Point>> {
        let mut strokes = Vec::new();
        for mark in &self.chart.marks {
            let (is_line, corners) = match mark {
                Mark::Vertical { from, to, .. } => {
                    let extent = self.x_extent(*from, *to);
                    (from == to, extent.map(|(a, b)| ((a, self.top), (b, self.bottom))))
                }
                Mark::Horizontal { from, to, .. } => {
                    let extent = self.y_extent(*from, *to);
                    (from == to, extent.map(|(a, b)| ((self.left, a), (self.right, b))))
                }
                Mark::Note { .. } => continue,
            };
            let Some((a, b)) = corners else { continue };
            let (x0, y0, x1, y1) = (Num(a.0), Num(a.1), Num(b.0), Num(b.1));
            if is_line {
                line(out, format!(r#"<path class="mark" d="M{x0},{y0}L{x1},{y1}"/>"#));
                strokes.push(vec![a, b]);
            } else {
                line(out, format!(r#"<path class="band" d="M{x0},{y0}H{x1}V{y1}H{x0}z"/>"#));
            }
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
        line(out, format!(r#"<path class="grid" d="{grid}"/>"#));
        line(out, format!(r#"<path class="axis" d="{axis}"/>"#));
        out.push_str(&labels);
    }
}

fn visible(a: f64, b: f64, low: f64, high: f64) -> Option<(f64, f64)> {
    let (a, b) = (a.min(b), a.max(b));
    (b > low - 0.01 && a < high + 0.01).then_some((a.clamp(low, high), b.clamp(low, high)))
}

/// The labels inside the plot, each where it hides least.
struct Labels<'a> {
    plot: &'a Plot<'a>,
    /// What is drawn there.
    strokes: Vec<Vec<Point>>,
    /// The labels already placed: left, top, right, bottom.
    taken: Vec<[f64; 4]>,
}

impl Labels<'_> {
    /// Draws the labels of guides, horizontal lines and bands, and the notes.
    fn draw(&mut self, out: &mut String) {
        let plot = self.plot;
        for series in plot.chart.series.iter().filter(|series| series.style.is_guide()) {
            let ends = plot.strokes(&series.points).concat();
            let Some((a, b)) = ends.first().zip(ends.last()) else {
                continue;
            };
            let middle = ((a.0 + b.0) / 2.0, (a.1 + b.1) / 2.0);
            self.place(out, &series.label, &[*b, *a, middle].map(beside).concat());
        }
        for mark in &plot.chart.marks {
            match mark {
                Mark::Note { at, text } => {
                    let places = plot.pixel(*at).map(beside).unwrap_or_default();
                    self.place(out, text, &places);
                }
                Mark::Horizontal { from, to, label } => {
                    let Some((a, b)) = plot.y_extent(*from, *to) else {
                        continue;
                    };
                    // Inside a band that is high enough, else above or below.
                    let inside = (b - a > ROW).then_some((a + b) / 2.0 + 6.0);
                    let rows = inside.map_or(vec![a - 8.0, b + 20.0], |y| vec![y]);
                    let ends = [(plot.right - 6.0, "end"), (plot.left + 6.0, "start")];
                    let row = |y: f64| ends.map(|(x, anchor)| ((x, y), anchor));
                    self.place(out, label, &rows.into_iter().flat_map(row).collect::<Vec<_>>());
                }
                Mark::Vertical { .. } => {}
            }
        }
    }

    /// Draws the label at the best of the places; the first of equals.
    fn place(&mut self, out: &mut String, label: &str, places: &[Place]) {
        let extent = |&((x, y), anchor): &Place| {
            let w = width(label);
            let before = match anchor {
                "start" => 0.0,
                "middle" => w / 2.0,
                _ => w,
            };
            [x - before, y - 15.0, x - before + w, y + 5.0]
        };
        let best = places.iter().min_by_key(|place| self.crowding(extent(place)));
        if let Some(best) = best.filter(|_| !label.is_empty()) {
            self.taken.push(extent(best));
            draw_text(out, "halo", best.0, best.1, label);
        }
    }

    /// How much of what is drawn lies under the box; far more if it hides a label, and most if it
    /// leaves the plot.
    fn crowding(&self, [left, top, right, bottom]: [f64; 4]) -> usize {
        let Plot { left: l, right: r, top: t, bottom: b, .. } = *self.plot;
        let near = |p: Point| (p.0.clamp(l - 9.0, r + 9.0), p.1.clamp(t - 9.0, b + 9.0));
        let under = |(x, y): Point| (left..=right).contains(&x) && (top..=bottom).contains(&y);
        let segment = |a: Point, b: Point| {
            let (dx, dy) = (b.0 - a.0, b.1 - a.1);
            let samples = (dx.abs().max(dy.abs()) / 4.0).ceil().max(1.0);
            let at = move |i: u32| {
                let share = f64::from(i) / samples;
                (a.0 + share * dx, a.1 + share * dy)
            };
            (0..=samples as u32).filter(|&i| under(at(i))).count()
        };
        let stroke = |stroke: &Vec<Point>| -> usize {
            let first = stroke.first().filter(|&&p| under(p)).map_or(0, |_| 1);
            first + stroke.windows(2).map(|w| segment(near(w[0]), near(w[1]))).sum::<usize>()
        };
        let over = |o: &&[f64; 4]| left < o[2] && o[0] < right && top < o[3] && o[1] < bottom;
        let outside = left < l || right > r || top < t || bottom > b;
        self.strokes.iter().map(stroke).sum::<usize>()
            + 1_000 * self.taken.iter().filter(over).count()
            + if outside { 100_000 } else { 0 }
    }
}

/// The places around a point.
fn beside((x, y): Point) -> Vec<Place> {
    vec![
        ((x + 10.0, y + 6.0), "start"),
        ((x - 10.0, y + 6.0), "end"),
        ((x, y - 11.0), "middle"),
        ((x, y + 23.0), "middle"),
        ((x + 7.0, y - 8.0), "start"),
        ((x - 7.0, y - 8.0), "end"),
        ((x + 7.0, y + 20.0), "start"),
        ((x - 7.0, y + 20.0), "end"),
    ]
}

/// A few of `count` points, evenly, and of four series in a row not the same ones.
fn few(count: usize, series: usize) -> impl Iterator<Item = usize> {
    (0..FEW).map(move |k| (count - 1) * (4 * k + 1 + series % 4) / (4 * FEW))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: a marker beside the curve's end, two series marked at the same points, points bunched.
    #[test]
    fn a_few_of_many_are_spread() {
        // 28 shares for seven markers of four series.
        let marked = |series| few(281, series).collect::<Vec<_>>();
        assert_eq!(marked(0), [10, 50, 90, 130, 170, 210, 250]);
        assert_eq!(marked(3), [40, 80, 120, 160, 200, 240, 280]);
        assert_eq!(marked(5), [20, 60, 100, 140, 180, 220, 260]);
    }
}
