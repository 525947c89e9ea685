//! Labels at the ends of lines, where they are few and their ends apart, instead of a legend.

use super::axis::Scale;
use super::path::{Num, Point};
use super::style::Style;
use super::text::{draw_text, line, width};
use super::{Chart, ENTRY, Entry, Series};

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
        if chart.sketch || style.is_arrow() || style.is_filled() || style.is_dots() {
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
    use super::super::{Axis, Figure};
    use super::*;

    fn chart() -> Chart {
        Chart::new(Axis::linear("x").range(0.0, 1.0), Axis::linear("y").range(0.0, 1.0))
    }

    /// With a level line at each of these heights.
    fn level(heights: &[f64]) -> Chart {
        heights.iter().enumerate().fold(chart(), |chart, (i, y)| {
            chart.series(format!("at {y}"), Style::numbered(i), [(0.0, *y), (1.0, *y)])
        })
    }

    fn labels(chart: &Chart) -> Option<Vec<(&str, f64)>> {
        let ends = of_chart(chart, &chart.scales())?;
        Some(ends.into_iter().map(|end| (end.label, end.y)).collect())
    }

    /// Places within an ulp or so of whole numbers.
    fn near(places: &[f64], expected: &[f64]) -> bool {
        places.len() == expected.len()
            && places.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9)
    }

    /// Catches: labels that overlap, that are moved though they have room, that leave the plot, or
    /// that all move one way.
    #[test]
    fn places_are_apart_and_inside() {
        let of = |wanted: &[f64]| spread(wanted, 20.0, (0.0, 300.0));
        assert!(near(&of(&[10.0, 100.0, 120.0]), &[10.0, 100.0, 120.0]));
        assert!(near(&of(&[100.0, 100.0]), &[90.0, 110.0]));
        assert!(near(&of(&[100.0, 110.0, 111.0, 290.0]), &[87.0, 107.0, 127.0, 290.0]));
        assert!(near(&of(&[0.0, 1.0, 2.0]), &[0.0, 20.0, 40.0]));
        assert!(near(&of(&[299.0, 300.0]), &[280.0, 300.0]));
        assert!(of(&[]).is_empty());
        // Whatever is wanted: apart, inside, in order.
        for seed in 0..200_u32 {
            let mut wanted: Vec<f64> =
                (0..5).map(|i| f64::from((seed * 7919 + i * i * 104_729) % 301)).collect();
            wanted.sort_by(f64::total_cmp);
            let places = of(&wanted);
            assert!(places.windows(2).all(|pair| pair[1] - pair[0] > 20.0 - 1e-9), "{places:?}");
            assert!(places[0] >= 0.0 && places[4] <= 300.0 + 1e-9, "{places:?}");
        }
    }

    /// Catches: a label beside another's line; a legend where there is room for labels, or labels
    /// where there is none.
    #[test]
    fn few_lines_whose_ends_are_apart_have_labels() {
        let chart_of_three = level(&[0.5, 0.75, 0.25]);
        let three = [("at 0.75", 75.0), ("at 0.5", 150.0), ("at 0.25", 225.0)];
        assert_eq!(labels(&chart_of_three).unwrap(), three);
        // Five at one place: the outer ones are 42 from it. A sixth is too many.
        let same = |count: usize| {
            (0..count).fold(chart(), |chart, i| {
                chart.series(format!("{i}"), Style::numbered(i), [(0.0, 0.5), (1.0, 0.5)])
            })
        };
        let five = same(5);
        let places: Vec<f64> = labels(&five).unwrap().into_iter().map(|(_, y)| y).collect();
        assert!(near(&places, &[108.0, 129.0, 150.0, 171.0, 192.0]), "{places:?}");
        assert!(labels(&same(6)).is_none());
        // At the very top the fifth would be 84 away.
        let top = (0..5).fold(chart(), |chart, i| {
            chart.series(format!("{i}"), Style::numbered(i), [(0.0, 1.0), (1.0, 1.0)])
        });
        assert!(labels(&top).is_none());
        let wide = chart().series("m".repeat(40), Style::numbered(0), [(0.0, 0.5), (1.0, 0.5)]);
        assert!(labels(&wide).is_none());
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
        assert_eq!(labels(&marked).unwrap().len(), 1);
        let short = |other: [Point; 2]| {
            let chart = chart().series("a", style, [(0.0, 0.5), (0.7, 0.5)]);
            labels(&chart.series("b", Style::numbered(1), other)).is_some()
        };
        assert!(short([(0.0, 0.2), (1.0, 0.2)]) && !short([(0.6, 0.2), (1.0, 0.9)]));
    }

    /// Catches: segments taken for the lines through them, the one or the other.
    #[test]
    fn segments_cross_where_both_are() {
        let (across, falling) = ([(0.0, 0.0), (2.0, 2.0)], [(0.0, 2.0), (2.0, 0.0)]);
        assert!(cross(across, falling) && cross(falling, across));
        let beyond = [(3.0, 4.0), (4.0, 3.0)];
        assert!(!cross(across, beyond) && !cross(beyond, across));
    }

    /// Numbers have one decimal.
    ///
    /// Catches: a thin line that begins on the plot's edge, or elsewhere than by the end of its
    /// line; one that does not lead to its label.
    #[test]
    fn a_thin_line_leads_from_the_end_to_the_label() {
        let chart = chart().series("a", Style::numbered(0), [(0.0, 0.5), (0.8, 0.5)]);
        let mut svg = String::new();
        draw(&mut svg, &of_chart(&chart, &chart.scales()).unwrap(), [50.0, 450.0, 20.0]);
        // 50 + 0.8 · 400 + 6, and 20 + half of the height of 300; then 16 beyond the plot.
        assert!(svg.contains("d=\"M376,170L466,170\""), "{svg}");
    }

    /// Catches: labels that reach beyond the drawing, that stand on the plot, or on each other; a
    /// legend that repeats them.
    #[test]
    fn labels_stand_beside_the_plot() {
        let chart = level(&[0.5, 0.52, 0.9]);
        let svg = Figure::new("t", "d").panel(chart).to_svg("x");
        let number = |text: &str, name: &str| -> f64 {
            let after = text.split_once(&format!(" {name}=\"")).unwrap().1;
            after.split('"').next().unwrap().parse().unwrap()
        };
        let plot = svg.lines().find(|line| line.contains("<rect ")).unwrap();
        let edge = number(plot, "x") + number(plot, "width") - 2.0;
        let mut heights = Vec::new();
        for label in ["at 0.5", "at 0.52", "at 0.9"] {
            let mut texts = svg.lines().filter(|line| line.contains(&format!(">{label}<")));
            let (text, None) = (texts.next().unwrap(), texts.next()) else { panic!("{svg}") };
            let x = number(text, "x");
            assert!(x > edge + GAP && x + width(label) < 600.0, "{label} at {x}");
            heights.push(number(text, "y"));
        }
        heights.sort_by(f64::total_cmp);
        assert!(heights.windows(2).all(|pair| pair[1] - pair[0] > APART - 0.2), "{heights:?}");
        assert_eq!(svg.matches(ENTRY).count(), 3);
    }
}
