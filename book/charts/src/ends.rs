//! Labels at the ends of lines, where they are few and their ends apart, instead of a legend.

use super::axis::Scale;
use super::chart::{Chart, Series};
use super::figure::{ENTRY, Entry};
use super::path::{Num, Point};
use super::style::Style;
use super::text::{draw_text, line, width};

/// More lines than this have a legend.
const MOST: usize = 5;
/// A line has its label at its end if it ends in the last part of the plot, from this share on.
const LAST: f64 = 0.6;
/// Between two labels, one below the other.
const APART: f64 = 21.0;
/// A label stands at most this much above or below the end of its line.
const FARTHEST: f64 = 45.0;
/// A wider label stands in a legend.
const WIDEST: f64 = 170.0;
/// From the plot to where the thin lines to the labels end.
const GAP: f64 = 16.0;
/// Room for a marker between thin line and label.
const MARKER: f64 = 18.0;
/// Before the label.
const BLANK: f64 = 5.0;

/// The label of one line.
#[derive(Debug)]
pub(super) struct End<'a> {
    label: &'a str,
    /// How the line is drawn, and the markers on it.
    styles: Vec<Style>,
    /// Where the line ends: shares of the width from the left, and units below the top.
    at: Point,
    /// Where its label stands, in units below the top.
    y: f64,
}

impl<'a> End<'a> {
    /// The room before the label for what marks the line.
    fn sample(&self) -> f64 {
        if self.styles.iter().any(|style| style.has_marker()) { MARKER } else { 0.0 }
    }

    /// What a legend would show.
    pub fn entry(&self) -> Entry<'a> {
        (self.label, self.styles.clone())
    }
}

/// The labels of each chart; none for one that has too many, or whose lines do not all end at the
/// right.
pub(super) fn of<'a>(charts: &'a [Chart], scales: &[(Scale, Scale)]) -> Vec<Vec<End<'a>>> {
    let ends = charts.iter().zip(scales).map(|(chart, scales)| of_chart(chart, scales));
    ends.map(Option::unwrap_or_default).collect()
}

/// The room that the labels need to the right of the plot.
pub(super) fn room(ends: &[Vec<End>]) -> f64 {
    let needed = |end: &End| GAP + end.sample() + BLANK + width(end.label);
    ends.iter().flatten().map(needed).fold(0.0, f64::max)
}

fn of_chart<'a>(chart: &'a Chart, (x, y): &(Scale, Scale)) -> Option<Vec<End<'a>>> {
    let mut ends: Vec<End> = Vec::new();
    let mut lines = Vec::new();
    for series in chart.series.iter().filter(|series| series.has_label()) {
        let style = series.style;
        if chart.sketch || style.arrow || style.filled || style.dots {
            return None;
        }
        let points = run_of(series, x, y, chart.height)?;
        let at = *points.last()?;
        match ends.iter_mut().find(|end| end.label == series.label) {
            // Markers have the label of their line; two lines of one name have two ends.
            Some(end) => {
                if style.has_line() {
                    if end.styles.iter().any(|known| known.has_line()) {
                        return None;
                    }
                    end.at = at;
                }
                end.styles.push(style);
            }
            None => ends.push(End { label: &series.label, styles: vec![style], at, y: at.1 }),
        }
        lines.push(points);
    }
    let has_place = |end: &End| end.at.0 >= LAST && width(end.label) <= WIDEST;
    if ends.len() > MOST || !ends.iter().all(has_place) {
        return None;
    }
    ends.sort_by(|a, b| a.at.1.total_cmp(&b.at.1));
    let natural: Vec<f64> = ends.iter().map(|end| end.at.1).collect();
    for (end, y) in ends.iter_mut().zip(spread(&natural, APART, (0.0, chart.height))) {
        end.y = y;
    }
    let is_near = |end: &End| (end.y - end.at.1).abs() <= FARTHEST;
    let is_free = |end: &End| {
        let lead = [(end.at.0 + 0.01, end.at.1), (1.01, end.y)];
        !lines.iter().any(|line| line.windows(2).any(|part| cross(lead, [part[0], part[1]])))
    };
    ends.iter().all(|end| is_near(end) && is_free(end)).then_some(ends)
}

/// The points of the series in the plot, from left to right: the share of its width from the left,
/// and units from its top. `None` for a series that turns back.
fn run_of(series: &Series, x: &Scale, y: &Scale, height: f64) -> Option<Vec<Point>> {
    let inside = series.points.iter().filter(|p| x.contains(p.0) && y.contains(p.1));
    let place = |p: &Point| Some((x.fraction(p.0)?, (1.0 - y.fraction(p.1)?) * height));
    let mut points: Vec<Point> = inside.filter_map(place).collect();
    if points.first()?.0 > points.last()?.0 {
        points.reverse();
    }
    points.windows(2).all(|pair| pair[0].0 <= pair[1].0).then_some(points)
}

/// Whether two segments cross.
fn cross([a, b]: [Point; 2], [c, d]: [Point; 2]) -> bool {
    let side =
        |o: Point, p: Point, q: Point| (p.0 - o.0) * (q.1 - o.1) - (p.1 - o.1) * (q.0 - o.0) > 0.0;
    side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b)
}

/// Ascending places as near as can be to those wanted, ascending too (least squares): `apart` from
/// each other, and all between the two ends if there is room for them.
fn spread(wanted: &[f64], apart: f64, (low, high): (f64, f64)) -> Vec<f64> {
    // Less what is to lie between them, the places must only not descend. Those that would are
    // one block, at their mean.
    let mut blocks: Vec<(f64, usize)> = Vec::new();
    for (i, place) in wanted.iter().enumerate() {
        let mut block = (place - i as f64 * apart, 1);
        while let Some(before) = blocks.pop_if(|before| before.0 > block.0) {
            let count = before.1 + block.1;
            let sum = before.0 * before.1 as f64 + block.0 * block.1 as f64;
            block = (sum / count as f64, count);
        }
        blocks.push(block);
    }
    let last = high - wanted.len().saturating_sub(1) as f64 * apart;
    let places = blocks.into_iter().flat_map(|(place, count)| std::iter::repeat_n(place, count));
    places.enumerate().map(|(i, place)| place.min(last).max(low) + i as f64 * apart).collect()
}

/// Draws the labels beside a plot with these edges. A thin line leads from the end of the line to
/// its label; a marker stands by the label, and not on the line, where it would be taken for data.
pub(super) fn draw(out: &mut String, ends: &[End], [left, right, top]: [f64; 3]) {
    for end in ends {
        let (x, y) = (right + GAP, top + end.y);
        let (from, at) = (left + end.at.0 * (right - left) + 6.0, top + end.at.1);
        line(out, ENTRY.into());
        for style in &end.styles {
            if style.has_line() {
                let d = format!("M{},{}L{},{}", Num(from), Num(at), Num(x), Num(y));
                line(out, format!(r#"<path {} d="{d}"/>"#, style.lead()));
            }
            if style.has_marker() {
                line(out, style.markers([(x + MARKER / 2.0, y)]));
            }
        }
        draw_text(out, "", (x + end.sample() + BLANK, y + 6.0), "start", end.label);
        line(out, "</g>".into());
    }
}

#[cfg(test)]
mod tests {
    use super::super::Axis;
    use super::*;

    fn chart() -> Chart {
        Chart::new(Axis::linear("x").range(0.0, 1.0), Axis::linear("y").range(0.0, 1.0))
    }

    /// How many labels stand at the ends of its lines; `None` if it has a legend.
    fn labels(chart: &Chart) -> Option<usize> {
        Some(of_chart(chart, &chart.scales())?.len())
    }

    /// Catches: a label for a closed curve, for an area, for a cloud, or for a line that ends in
    /// the middle; one for each of two lines of one name; a thin line through another curve.
    #[test]
    fn what_has_no_end_at_the_right_has_a_legend() {
        let line = [(0.0, 0.5), (1.0, 0.5)];
        let with = |style: Style, points: &[Point]| {
            labels(&chart().series("a", style, points.iter().copied())).is_some()
        };
        let style = Style::numbered(0);
        assert!(with(style, &line) && with(style.markers_only(), &line));
        // The samples may come from the right.
        assert!(with(style, &[line[1], line[0]]));
        for other in [style.arrow(), style.filled(), style.dots()] {
            assert!(!with(other, &line), "{other:?}");
        }
        assert!(!with(style, &[(0.2, 0.1), (1.0, 0.5), (0.2, 0.9)]));
        assert!(!with(style, &[(0.0, 0.5), (0.5, 0.5)]));
        // What is outside of the plot is not its end.
        assert!(!with(style, &[(0.0, 0.5), (0.5, 0.5), (1.0, 7.0)]));
        let twice = chart().series("a", style, line).series("a", style, [(0.0, 0.1), (1.0, 0.1)]);
        assert!(labels(&twice).is_none());
        // Markers on a line have its label, wherever they are.
        let marked = chart().series("a", style.line_only(), line);
        let marked = marked.series("a", style.markers_only(), [(0.3, 0.5)]);
        assert_eq!(labels(&marked), Some(1));
        let short = |other: [Point; 2]| {
            let chart = chart().series("a", style, [(0.0, 0.5), (0.7, 0.5)]);
            labels(&chart.series("b", Style::numbered(1), other)).is_some()
        };
        assert!(short([(0.0, 0.2), (1.0, 0.2)]) && !short([(0.6, 0.2), (1.0, 0.9)]));
    }
}
