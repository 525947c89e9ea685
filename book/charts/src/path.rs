//! Long series to short paths: only what cannot be seen is dropped.

use std::fmt::{self, Display, Write};

/// A point on the drawing, in units of the view box; y points down.
pub type Point = (f64, f64);

/// A coordinate, printed with at most one decimal and never as `-0`.
pub struct Num(pub f64);

impl Display for Num {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Tenths(tenths(self.0)).fmt(f)
    }
}

struct Tenths(i64);

impl Display for Tenths {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = if self.0 < 0 { "-" } else { "" };
        match (self.0.abs() / 10, self.0.abs() % 10) {
            (whole, 0) => write!(f, "{sign}{whole}"),
            (whole, tenth) => write!(f, "{sign}{whole}.{tenth}"),
        }
    }
}

fn tenths(value: f64) -> i64 {
    (value * 10.0).round() as i64
}

/// Width of a column, in units: about one pixel on a phone.
const COLUMN: f64 = 2.0;
/// More turns within a column than this cannot be seen one by one.
const MANY_TURNS: usize = 3;
/// How far a simplified line may stray from the true one, in units.
const STRAY: f64 = 0.1;

/// The simplified stroke, for a plot that reaches from `left` to `right`.
pub(super) fn thin(stroke: &[Point], left: f64, right: f64) -> Vec<Point> {
    simplify(&extremes(stroke, left, right))
}

/// Where the stroke goes up and down several times within a column, keeps the lowest and the
/// highest point of that column. What lies beside the plot counts as one column.
fn extremes(stroke: &[Point], left: f64, right: f64) -> Vec<Point> {
    let column = |p: &Point| (p.0.clamp(left - COLUMN, right + COLUMN) / COLUMN).floor() as i64;
    let mut kept = Vec::new();
    for run in stroke.chunk_by(|a, b| column(a) == column(b)) {
        let turns = |w: &&[Point]| (w[1].1 - w[0].1) * (w[2].1 - w[1].1) < 0.0;
        let ends = [run[0], run[run.len() - 1]];
        if ends.iter().all(|p| !(left..=right).contains(&p.0)) {
            kept.extend(ends); // the line enters the plot where it should
            continue;
        }
        if run.windows(3).filter(turns).count() <= MANY_TURNS {
            kept.extend_from_slice(run);
            continue;
        }
        let order = |&a: &usize, &b: &usize| run[a].1.total_cmp(&run[b].1);
        let mut keep: Vec<usize> = (0..run.len()).min_by(order).into_iter().collect();
        keep.extend((0..run.len()).max_by(order));
        keep.sort_unstable();
        keep.dedup();
        // At the middle of the column, so that even strokes leave no stripes between them.
        let middle = (column(&run[0]) as f64 + 0.5) * COLUMN;
        kept.extend(keep.into_iter().map(|i| (middle, run[i].1)));
    }
    kept
}

/// Drops points closer than [`STRAY`] to the line that remains (Ramer, Douglas and Peucker).
fn simplify(points: &[Point]) -> Vec<Point> {
    let mut keep = vec![false; points.len()];
    let mut spans = Vec::new();
    if let Some(last) = points.len().checked_sub(1) {
        (keep[0], keep[last]) = (true, true);
        spans.push((0, last));
    }
    while let Some((a, b)) = spans.pop() {
        let (mut worst, mut at) = (STRAY * STRAY, None);
        for i in a + 1..b {
            let distance = squared_distance(points[i], points[a], points[b]);
            if distance > worst {
                (worst, at) = (distance, Some(i));
            }
        }
        if let Some(i) = at {
            keep[i] = true;
            spans.extend([(a, i), (i, b)]);
        }
    }
    points.iter().zip(keep).filter_map(|(&p, keep)| keep.then_some(p)).collect()
}

/// Square of the distance from `p` to the segment from `a` to `b`.
fn squared_distance(p: Point, a: Point, b: Point) -> f64 {
    let (ux, uy, vx, vy) = (b.0 - a.0, b.1 - a.1, p.0 - a.0, p.1 - a.1);
    let length = ux * ux + uy * uy;
    let along = if length > 0.0 { ((ux * vx + uy * vy) / length).clamp(0.0, 1.0) } else { 0.0 };
    let (dx, dy) = (vx - along * ux, vy - along * uy);
    dx * dx + dy * dy
}

/// The element `path` with these attributes and this `d`. Long data begins on a line of its own.
pub(super) fn element(attributes: &str, d: &str) -> String {
    let begin = if d.contains('\n') { "\n" } else { "" };
    format!(r#"<path {attributes} d="{begin}{d}"/>"#)
}

/// Where a line of the text of a path ends, in characters, if it has not ended before.
const LINE: usize = 90;
/// Where the path leaves a strip of the drawing as wide as this (tenths of a unit), a line of its
/// text ends: after a change, the lines of the other strips are as they were.
const STRIP: i64 = 250;

/// Whether a line of text that began at the byte `begin` of `d` ends between two points.
fn line_ends(d: &str, begin: usize, (from, to): (i64, i64)) -> bool {
    d.len() - begin >= LINE || from.div_euclid(STRIP) != to.div_euclid(STRIP)
}

/// The same path data, each of its strokes on a line of its own if they do not fit on one.
pub(super) fn stroke_by_stroke(d: &str) -> String {
    if d.len() < LINE { d.to_string() } else { d[..1].to_string() + &d[1..].replace('M', "\nM") }
}

/// The attribute `d` for the strokes: relative moves in lines of text strip by strip, so that a
/// local change stays a local diff. A stroke of a single point becomes a dot.
pub(super) fn polyline<'a>(strokes: impl IntoIterator<Item = &'a Vec<Point>>) -> String {
    let mut d = String::new();
    for stroke in strokes {
        let mut grid = stroke.iter().map(|p| (tenths(p.0), tenths(p.1)));
        let Some(mut at) = grid.next() else { continue };
        if !d.is_empty() {
            d.push('\n');
        }
        let mut begin = d.len();
        let _ = write!(d, "M{},{}", Tenths(at.0), Tenths(at.1));
        let mut separator = 'l';
        for to in grid {
            if to != at {
                if separator == ' ' && line_ends(&d, begin, (at.0, to.0)) {
                    separator = '\n';
                    begin = d.len() + 1;
                }
                let _ = write!(d, "{separator}{},{}", Tenths(to.0 - at.0), Tenths(to.1 - at.1));
                (at, separator) = (to, ' ');
            }
        }
        if separator == 'l' {
            d.push_str("h0");
        }
    }
    d
}

/// Length and half the width of an arrow's head.
const HEAD: (f64, f64) = (14.0, 5.0);

/// The corners of the arrow head at the end of the stroke, the tip first, `short` units before the
/// end. The stroke is cut off inside the head, so that its round end does not blunt the tip. `None`
/// where its last segment is too short.
pub(super) fn head(stroke: &mut [Point], short: f64) -> Option<[Point; 3]> {
    let [.., from, end] = stroke else {
        return None;
    };
    let (dx, dy) = (end.0 - from.0, end.1 - from.1);
    let length = libm::sqrt(dx * dx + dy * dy) - short;
    if length < STRAY {
        return None;
    }
    let (ux, uy) = (dx / (length + short), dy / (length + short));
    let tip = (end.0 - short * ux, end.1 - short * uy);
    // The head of a short arrow is at most 0.6 of its length.
    let size = (0.6 * length / HEAD.0).min(1.0);
    let (long, wide) = (size * HEAD.0, size * HEAD.1);
    let back = |by: f64, aside: f64| (tip.0 - by * ux - aside * uy, tip.1 - by * uy + aside * ux);
    *end = back(0.7 * long, 0.0);
    Some([tip, back(long, wide), back(long, -wide)])
}

/// The attribute `d` for dots, one in each square unit at most, column by column: relative moves
/// between neighbours are short, and lines of text end as those of [`polyline`] do.
pub(super) fn dots(mut points: Vec<Point>) -> String {
    let cell = |p: &Point| (p.0.floor() as i64, p.1.floor() as i64);
    points.sort_by_key(cell);
    points.dedup_by_key(|p| cell(p));
    let mut d = String::new();
    let (mut at, mut begin) = ((0, 0), 0);
    for (x, y) in points {
        let to = (tenths(x), tenths(y));
        if !d.is_empty() && line_ends(&d, begin, (at.0, to.0)) {
            d.push('\n');
            begin = d.len();
        }
        let _ = write!(d, "m{},{}h0", Tenths(to.0 - at.0), Tenths(to.1 - at.1));
        at = to;
    }
    d
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: the later of two points equally far from the line kept, so that a path changes
    /// where nothing moved; a point kept that is within the tolerance.
    #[test]
    fn the_first_of_the_farthest_is_kept() {
        // Once one of the two is kept, the other is at half that height.
        let low = |y: f64| [(0.0, 0.0), (10.0, y), (20.0, y), (30.0, 0.0)];
        assert_eq!(simplify(&low(1.5 * STRAY)), [(0.0, 0.0), (10.0, 1.5 * STRAY), (30.0, 0.0)]);
        assert_eq!(simplify(&low(STRAY)), [(0.0, 0.0), (30.0, 0.0)]);
    }

    /// Catches: a head that points elsewhere, a line that shows beyond the tip, a head longer than
    /// its arrow, a division by a length of zero.
    #[test]
    fn an_arrow_ends_in_its_tip() {
        let mut stroke = vec![(0.0, 0.0), (10.0, 0.0), (10.0, 100.0)];
        assert_eq!(head(&mut stroke, 8.0), Some([(10.0, 92.0), (5.0, 78.0), (15.0, 78.0)]));
        assert!(stroke[2].0 == 10.0 && (78.0..92.0).contains(&stroke[2].1), "{stroke:?}");
        let [tip, a, b] = head(&mut [(0.0, 0.0), (-5.0, 0.0)], 0.0).unwrap();
        assert!(tip == (-5.0, 0.0) && a.0 == b.0 && (-3.0..=-1.0).contains(&a.0), "{a:?}");
        assert_eq!(head(&mut [(1.0, 1.0), (1.0, 1.0)], 0.0), None);
        assert_eq!(head(&mut [(1.0, 1.0), (9.0, 1.0)], 8.0), None);
        assert_eq!(head(&mut [(1.0, 1.0)], 0.0), None);
    }
}
