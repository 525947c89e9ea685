//! Figures compared as they are seen: how far their lines have moved, and not how their text
//! differs.

use std::collections::{BTreeMap, HashSet};

use anyhow::{Context, Result};
use roxmltree::{Document, Node};
use svgtypes::{SimplePathSegment, SimplifyingPathParser};

/// Below this displacement (px) a difference cannot be seen.
pub const VISIBLE: f64 = 0.5;

/// A walk of rounding errors goes elsewhere each time. Of 1 500 pairs of sets of eight random
/// walks, as the figure of the rounding walk draws them, the root-mean-square excursions of no pair
/// differed by a factor of more than 2.8.
const WALKS_DIFFER_BY: f64 = 3.0;

/// How a figure differs.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The largest distance (px, of 600 across the figure) from a point of either drawing to the
    /// nearest of the other; `None` for a figure of noise of which nothing else moved.
    pub displacement: Option<f64>,
    /// What else differs, or how noise does, in sentences.
    pub notes: Vec<String>,
    /// Whether a reader can see it.
    pub visible: bool,
}

/// Compares two figures; one that is `noise` has lines that are sums of rounding errors.
///
/// # Errors
/// If one of them is not a figure in SVG.
pub fn compare(old: &str, new: &str, noise: bool) -> Result<Difference> {
    let (old, new) = (Picture::read(old)?, Picture::read(new)?);
    let mut notes = Vec::new();
    let mut moved: f64 = 0.0;
    let mut unlike = false;
    for key in
        old.shapes.keys().chain(new.shapes.keys().filter(|key| !old.shapes.contains_key(*key)))
    {
        let none = Vec::new();
        let [before, after] = [&old, &new].map(|picture| picture.shapes.get(key).unwrap_or(&none));
        if before.len() != after.len() {
            notes.push(format!("{}: {} before, {} now", key, before.len(), after.len()));
            unlike = true;
            continue;
        }
        // Where they are dashed they are theory, and not noise.
        if noise && key.starts_with("line") && !key.contains(DASHES) {
            let ratio = excursion(after) / excursion(before);
            if before != after {
                notes.push(format!(
                    "noise: the excursions of its {} lines are {ratio:.2} times what they were, \
                     root mean square",
                    before.len()
                ));
            }
            unlike |= !(1.0 / WALKS_DIFFER_BY..=WALKS_DIFFER_BY).contains(&ratio);
        } else if !(noise && key.starts_with("dot")) {
            let pairs = before.iter().zip(after);
            let by = pairs.map(|(before, after)| displacement(before, after)).fold(0.0, f64::max);
            if by.is_finite() {
                moved = moved.max(by);
            } else {
                notes.push(format!("{key}: one of the two draws nothing"));
                unlike = true;
            }
        }
    }
    for (part, before, after) in [
        ("the title", &old.title, &new.title),
        ("the caption", &old.caption, &new.caption),
        ("the description", &old.description, &new.description),
    ] {
        if before != after {
            notes.push(format!("{part} was “{before}” and is “{after}”"));
            unlike = true;
        }
    }
    if old.style != new.style {
        notes.push("its colours or strokes differ".to_string());
        unlike = true;
    }
    for (text, change) in texts(&old, &new) {
        notes.push(format!("the label “{text}” {change}"));
        unlike = true;
    }
    let displacement = (!noise || moved >= VISIBLE).then_some(moved);
    Ok(Difference { displacement, notes, visible: unlike || moved >= VISIBLE })
}

/// What stands before the dashes of a line in its key.
const DASHES: &str = ", dashes ";

/// A point (px).
type Point = (f64, f64);
/// A line through points; a dot is a line of one point.
type Stroke = Vec<Point>;

/// What is drawn, by what it looks like.
#[derive(Debug, Default)]
struct Picture {
    /// The strokes of each path with a class and dashes, in order.
    shapes: BTreeMap<String, Vec<Vec<Stroke>>>,
    /// Each label with the places where it stands.
    labels: BTreeMap<String, Vec<Point>>,
    title: String,
    caption: String,
    description: String,
    style: String,
}

impl Picture {
    fn read(figure: &str) -> Result<Self> {
        let document = Document::parse(figure).context("a figure is not well-formed")?;
        let mut picture = Self::default();
        for node in document.descendants().filter(Node::is_element) {
            match node.tag_name().name() {
                "path" => {
                    let look = ["class", "stroke-dasharray"].map(|name| node.attribute(name));
                    let look: Vec<&str> = look.into_iter().flatten().collect();
                    let strokes = strokes(node.attribute("d").unwrap_or_default())?;
                    picture.shapes.entry(look.join(DASHES)).or_default().push(strokes);
                }
                "text" => {
                    let [x, y] = ["x", "y"].map(|name| node.attribute(name)?.parse().ok());
                    let at = x.zip(y).context("a label of a figure has no place")?;
                    picture.labels.entry(text(node)).or_default().push(at);
                }
                "title" => picture.title = text(node),
                "figcaption" => picture.caption = text(node),
                "desc" => picture.description = text(node),
                "style" => picture.style = text(node),
                _ => {}
            }
        }
        Ok(picture)
    }
}

/// The text of a node and all in it, its line breaks as blanks.
fn text(node: Node<'_, '_>) -> String {
    let parts = node.descendants().filter(Node::is_text).filter_map(|node| node.text());
    let text: String = parts.collect();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The strokes of path data. Of arcs, which are markers, the ends are kept.
fn strokes(d: &str) -> Result<Vec<Stroke>> {
    let mut strokes: Vec<Stroke> = Vec::new();
    for segment in SimplifyingPathParser::from(d) {
        match segment.with_context(|| format!("a path of a figure is broken: {d}"))? {
            SimplePathSegment::MoveTo { x, y } => strokes.push(vec![(x, y)]),
            SimplePathSegment::LineTo { x, y }
            | SimplePathSegment::Quadratic { x, y, .. }
            | SimplePathSegment::CurveTo { x, y, .. } => {
                strokes.last_mut().context("a path begins without a point")?.push((x, y));
            }
            SimplePathSegment::ClosePath => {
                if let Some(stroke) = strokes.last_mut() {
                    stroke.push(stroke[0]);
                }
            }
        }
    }
    Ok(strokes)
}

/// The Hausdorff distance of two drawings, each of its points as near as it gets to the other's
/// lines.
fn displacement(a: &[Stroke], b: &[Stroke]) -> f64 {
    one_way(a, b).max(one_way(b, a))
}

/// The largest distance from a corner of `a` to the nearest point of `b`.
fn one_way(a: &[Stroke], b: &[Stroke]) -> f64 {
    let bits = |p: &Point| (p.0.to_bits(), p.1.to_bits());
    // Most corners have not moved at all.
    let known: HashSet<_> = b.iter().flatten().map(bits).collect();
    let moved = a.iter().flatten().filter(|p| !known.contains(&bits(p)));
    moved.map(|p| distance(*p, b)).fold(0.0, f64::max)
}

/// The distance from `p` to the nearest point of the strokes.
fn distance(p: Point, strokes: &[Stroke]) -> f64 {
    let to_dot = |stroke: &Stroke| match stroke[..] {
        [dot] => (p.0 - dot.0).hypot(p.1 - dot.1),
        _ => stroke.windows(2).map(|s| to_segment(p, s[0], s[1])).fold(f64::INFINITY, f64::min),
    };
    strokes.iter().map(to_dot).fold(f64::INFINITY, f64::min)
}

/// The distance from `p` to the segment from `a` to `b`.
fn to_segment(p: Point, a: Point, b: Point) -> f64 {
    let (ux, uy, vx, vy) = (b.0 - a.0, b.1 - a.1, p.0 - a.0, p.1 - a.1);
    let length = ux * ux + uy * uy;
    let along = if length > 0.0 { ((ux * vx + uy * vy) / length).clamp(0.0, 1.0) } else { 0.0 };
    (vx - along * ux).hypot(vy - along * uy)
}

/// The root-mean-square distance, up or down, of the points of lines from where their line begins.
fn excursion(lines: &[Vec<Stroke>]) -> f64 {
    let mut sum = (0.0, 0.0);
    for stroke in lines.iter().flatten() {
        for point in stroke {
            sum = (sum.0 + (point.1 - stroke[0].1).powi(2), sum.1 + 1.0);
        }
    }
    (sum.0 / sum.1).sqrt()
}

/// Labels that are in one of the pictures only, or have moved visibly.
fn texts(old: &Picture, new: &Picture) -> Vec<(String, String)> {
    let mut changes = Vec::new();
    for (label, places) in &old.labels {
        match new.labels.get(label) {
            None => changes.push((label.clone(), "has gone".to_string())),
            Some(now) if now.len() != places.len() => {
                let change = format!("stood {} times and stands {}", places.len(), now.len());
                changes.push((label.clone(), change));
            }
            Some(now) => {
                let moved = places.iter().zip(now).map(|(a, b)| (a.0 - b.0).hypot(a.1 - b.1));
                let moved = moved.fold(0.0, f64::max);
                if moved >= VISIBLE {
                    changes.push((label.clone(), format!("has moved by {moved:.1} px")));
                }
            }
        }
    }
    let fresh = new.labels.keys().filter(|label| !old.labels.contains_key(*label));
    changes.extend(fresh.map(|label| (label.clone(), "is new".to_string())));
    changes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure(d: &str, label: &str) -> String {
        format!(
            "<figure><svg><title>T</title><desc>D</desc><style>s</style><path class=\"line\" \
             d=\"{d}\"/><text x=\"1\" y=\"2\">{label}</text></svg><figcaption>C</figcaption>\
             </figure>"
        )
    }

    fn moved(old: &str, new: &str) -> f64 {
        let difference = compare(&figure(old, "a"), &figure(new, "a"), false).unwrap();
        assert_eq!(difference.notes, [""; 0]);
        assert_eq!(difference.visible, difference.displacement.unwrap() >= VISIBLE);
        difference.displacement.unwrap()
    }

    /// Catches: a displacement seen where only the text differs; one measured between corners
    /// where the lines pass each other more closely; one that looks one way only.
    #[test]
    fn what_is_drawn_is_compared_and_not_its_text() {
        assert_eq!(moved("M0,0l10,0 10,0", "M0,0\nL20,0"), 0.0);
        assert_eq!(moved("M0,0l20,0", "M0,0.4l20,0"), 0.4);
        assert_eq!(moved("M0,0l20,0", "M0,0l10,3 10,-3"), 3.0);
        assert_eq!(moved("M0,0l10,3 10,-3", "M0,0l20,0"), 3.0);
        assert_eq!(moved("m5,5h0m7,0h0", "M5,5h0M12,6h0"), 1.0);
    }

    /// Shapes that look alike are compared together, in the order of their classes.
    ///
    /// Catches: the displacement of the last kind of shape, or of the first, taken for that of the
    /// whole figure.
    #[test]
    fn one_kind_of_shape_that_moves_is_enough() {
        let drawn = |line: f64, others: f64| {
            let mut figure = figure(&format!("M0,{line}h20"), "a");
            for class in ["dot", "mark"] {
                let path = format!("<path class=\"{class}\" d=\"M50,{others}v9\"/><text");
                figure = figure.replace("<text", &path);
            }
            figure
        };
        for after in [drawn(5.0, 0.0), drawn(0.0, 5.0)] {
            let difference = compare(&drawn(0.0, 0.0), &after, false).unwrap();
            assert!(difference.visible && difference.notes.is_empty(), "{difference:?}");
            assert_eq!(difference.displacement, Some(5.0));
        }
    }

    /// Catches: a label, a caption or a line that appears unseen where no line moves.
    #[test]
    fn what_is_written_is_compared_too() {
        let (a, b) = (figure("M0,0h9", "a"), figure("M0,0h9", "b"));
        let difference = compare(&a, &b, false).unwrap();
        assert!(difference.visible && difference.displacement == Some(0.0), "{difference:?}");
        assert_eq!(difference.notes, ["the label “a” has gone", "the label “b” is new"]);
        let more = a.replace("<text", "<path class=\"line\" d=\"M0,0h9\"/><text");
        assert_eq!(compare(&a, &more, false).unwrap().notes, ["line: 1 before, 2 now"]);
        let caption = a.replace(">C<", ">K<");
        assert!(compare(&a, &caption, false).unwrap().visible);
        assert!(compare("<figure>", &a, false).is_err());
        let nothing = a.replace("M0,0h9", "");
        let difference = compare(&a, &nothing, false).unwrap();
        assert_eq!(difference.notes, ["line: one of the two draws nothing"]);
        assert!(difference.visible && difference.displacement == Some(0.0), "{difference:?}");
    }

    /// Catches: a walk of rounding errors reported as a change because it went elsewhere; one that
    /// has grown tenfold and is not.
    #[test]
    fn noise_is_compared_by_its_size() {
        let walk = |by: f64| figure(&format!("M0,0l1,{by} 1,{} 1,{by}", -2.0 * by), "a");
        let difference = compare(&walk(1.0), &walk(-1.2), true).unwrap();
        assert!(!difference.visible && difference.displacement.is_none(), "{difference:?}");
        assert!(difference.notes[0].contains("1.20 times"), "{difference:?}");
        assert!(compare(&walk(1.0), &walk(10.0), true).unwrap().visible);
    }
}
