//! Figures compared as they are seen: how far their lines have moved, and not how their text
//! differs. What this does not understand, it compares as it is written.

use std::collections::{BTreeMap, BTreeSet, HashSet};

use anyhow::{Context, Result};

use super::svg::{Piece, inner, number, numbers, pieces};

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
/// If one of them is not a figure as our charts write it.
pub fn compare(old: &str, new: &str, noise: bool) -> Result<Difference> {
    let (old, new) = (Picture::read(old)?, Picture::read(new)?);
    let mut notes = Vec::new();
    // What the notes are on.
    let mut noted = BTreeSet::new();
    let mut moved: f64 = 0.0;
    let mut unlike = false;
    for key in
        old.shapes.keys().chain(new.shapes.keys().filter(|key| !old.shapes.contains_key(*key)))
    {
        let none = Vec::new();
        let [before, after] = [&old, &new].map(|picture| picture.shapes.get(key).unwrap_or(&none));
        if before.len() != after.len() {
            notes.push(format!("{}: {} before, {} now", key, before.len(), after.len()));
            noted.insert(key.clone());
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
    for (what, before) in &old.written {
        let mut pairs = before.iter().zip(new.written.get(what).into_iter().flatten());
        if let Some((before, after)) = pairs.find(|(before, after)| before != after) {
            notes.push(match *what {
                STYLE => format!("{STYLE} differ"),
                what => format!("{what} was “{before}” and is “{after}”"),
            });
            noted.insert(what.to_string());
            unlike = true;
        }
    }
    for (text, change) in texts(&old, &new) {
        notes.push(format!("{LABEL} “{text}” {change}"));
        noted.insert(text);
        unlike = true;
    }
    if old.parts != new.parts {
        let more = parts(&old, &new, &noted);
        if more.is_empty() && !unlike {
            notes.push("its parts stand in another order".to_string());
        }
        notes.extend(more);
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
    /// What is written elsewhere, by what it is, in order.
    written: BTreeMap<&'static str, Vec<String>>,
    /// All that it consists of, in order, but for what is compared above.
    parts: Vec<Part>,
}

/// The name of a text in the drawing.
const LABEL: &str = "the label";
/// The name of the first title, which is that of the figure.
const TITLE: &str = "the title";
/// What a style sheet is of.
const STYLE: &str = "its colours or strokes";
/// Where an element ends.
const END: &str = "</>";

/// The beginning of an element, its end, or a text where none is expected.
#[derive(Debug, PartialEq)]
struct Part {
    /// As it is written, without what is compared by itself.
    text: String,
    /// What it is a part of, if that is compared by itself too.
    of: Option<String>,
}

impl Picture {
    fn read(figure: &str) -> Result<Self> {
        let pieces = pieces(figure)?;
        let (mut picture, mut rest) = (Self::default(), &pieces[..]);
        while let Some((piece, after)) = rest.split_first() {
            let Some(what) = picture.what(piece) else {
                let part = match piece {
                    Piece::Begin("path", _) => picture.path(piece)?,
                    other => Part { text: as_written(other, &[]), of: None },
                };
                picture.parts.push(part);
                rest = after;
                continue;
            };
            let (inner, after) = inner(after);
            let (text, marks) = text(inner);
            let (apart, of) = if what == LABEL {
                let [x, y] = ["x", "y"].map(|name| number(attribute(piece, name)?));
                let at = x.zip(y).context("a label of a figure has no place")?;
                picture.labels.entry(text.clone()).or_default().push(at);
                (&["x", "y"][..], text)
            } else {
                picture.written.entry(what).or_default().push(text);
                (&[][..], what.to_string())
            };
            let text = as_written(piece, apart) + &marks;
            picture.parts.push(Part { text, of: Some(of) });
            rest = after;
        }
        Ok(picture)
    }

    /// What an element is, if it is one of text.
    fn what(&self, element: &Piece) -> Option<&'static str> {
        let Piece::Begin(name, _) = element else { return None };
        Some(match *name {
            "text" => LABEL,
            "title" if !self.written.contains_key(TITLE) => TITLE,
            "title" => "what is shown where a mouse rests",
            "figcaption" => "the caption",
            "desc" => "the description",
            "style" => STYLE,
            _ => return None,
        })
    }

    fn path(&mut self, path: &Piece) -> Result<Part> {
        let look = ["class", "stroke-dasharray"].map(|name| attribute(path, name));
        let look = look.into_iter().flatten().collect::<Vec<_>>().join(DASHES);
        let d = attribute(path, "d").unwrap_or_default();
        let (strokes, arcs) =
            strokes(d).with_context(|| format!("a path of a figure is broken: {d}"))?;
        self.shapes.entry(look.clone()).or_default().push(strokes);
        let arcs: Vec<String> = arcs.into_iter().collect();
        Ok(Part { text: as_written(path, &["d"]) + &arcs.join(", "), of: Some(look) })
    }
}

/// An attribute of an element.
fn attribute<'p>(element: &'p Piece, name: &str) -> Option<&'p str> {
    let Piece::Begin(_, attributes) = element else { return None };
    attributes.iter().find(|known| known.0 == name).map(|known| known.1.as_str())
}

/// A piece as it is written, `without` these attributes.
fn as_written(piece: &Piece, without: &[&str]) -> String {
    match piece {
        Piece::Begin(name, attributes) => {
            let kept = attributes.iter().filter(|(name, _)| !without.contains(name));
            let kept: String = kept.map(|(name, value)| format!(" {name}=\"{value}\"")).collect();
            format!("<{name}{kept}>")
        }
        Piece::Text(text) => text.clone(),
        Piece::End => END.to_string(),
    }
}

/// The text of these pieces; and all of them as they are written, if they are not text alone. Line
/// breaks are blanks.
fn text(pieces: &[Piece]) -> (String, String) {
    let is_text = |piece: &&Piece| matches!(piece, Piece::Text(_));
    let write = |piece: &Piece| as_written(piece, &[]);
    let on_a_line = |text: String| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let text = pieces.iter().filter(is_text).map(write).collect();
    let is_plain = pieces.iter().all(|piece| is_text(&piece));
    let all = if is_plain { String::new() } else { pieces.iter().map(write).collect() };
    (on_a_line(text), on_a_line(all))
}

/// The strokes of path data, and what its arcs are beside their ends. Nothing of data that our
/// charts do not write.
fn strokes(d: &str) -> Option<(Vec<Stroke>, BTreeSet<String>)> {
    let (mut strokes, mut arcs) = (Vec::<Stroke>::new(), BTreeSet::new());
    let (mut at, mut rest) = ((0.0, 0.0), d.trim_start());
    while let Some(command) = rest.chars().next() {
        let after = &rest[command.len_utf8()..];
        let (list, next) = after.split_at(after.find(char::is_alphabetic).unwrap_or(after.len()));
        rest = next;
        let numbers = numbers(list)?;
        let count = match command {
            'M' | 'm' | 'L' | 'l' => 2,
            'H' | 'h' | 'V' | 'v' => 1,
            'a' => 7,
            'z' if numbers.is_empty() => {
                let stroke = strokes.last_mut()?;
                at = stroke[0];
                stroke.push(at);
                continue;
            }
            _ => return None,
        };
        if numbers.is_empty() || numbers.len() % count != 0 {
            return None;
        }
        for (i, numbers) in numbers.chunks(count).enumerate() {
            let from = if command.is_lowercase() { at } else { (0.0, 0.0) };
            at = match (command, numbers) {
                ('H' | 'h', [x]) => (from.0 + x, at.1),
                ('V' | 'v', [y]) => (at.0, from.1 + y),
                (_, [arc @ .., x, y]) => {
                    if !arc.is_empty() {
                        arcs.insert(format!("{arc:?}"));
                    }
                    (from.0 + x, from.1 + y)
                }
                _ => return None,
            };
            if i == 0 && matches!(command, 'M' | 'm') {
                strokes.push(vec![at]);
            } else {
                strokes.last_mut()?.push(at);
            }
        }
    }
    Some((strokes, arcs))
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

/// Parts of which there are more or fewer, without those of what has been `noted`.
fn parts(old: &Picture, new: &Picture, noted: &BTreeSet<String>) -> Vec<String> {
    let mut counts = BTreeMap::<&str, [usize; 2]>::new();
    for (version, picture) in [old, new].into_iter().enumerate() {
        let is_noted = |part: &&Part| part.of.as_ref().is_some_and(|of| noted.contains(of));
        for part in picture.parts.iter().filter(|part| part.text != END && !is_noted(part)) {
            counts.entry(&part.text).or_default()[version] += 1;
        }
    }
    let differ = counts.into_iter().filter(|(_, [before, now])| before != now);
    differ.map(|(text, [before, now])| format!("{text}: {before} before, {now} now")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure(d: &str, label: &str) -> String {
        format!(
            "<figure><svg viewBox=\"0 0 9 9\"><title>T</title><desc>D</desc><style>s</style>\
             <path class=\"line\" d=\"{d}\"/><text x=\"1\" y=\"2\">{label}</text></svg>\
             <figcaption>C</figcaption></figure>"
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

    /// Each change of a figure whose lines and labels stay as they are, with what is said of it.
    ///
    /// Catches: what covers, hides, moves or adds to a drawing without a change of its lines and
    /// labels, called invisible.
    #[test]
    fn whatever_is_not_understood_is_visible() {
        let drawn = figure("M0,0h9m1,1a5,5 0 1,0 10,0z", "a<tspan dy=\"5\">b e</tspan>c").replace(
            "\"/><text",
            "\"><title>H</title></path><path class=\"dot\" d=\"M9,9v1\"/><text",
        );
        let all = |from: &str, to: &str| drawn.replace(from, to);
        for (changed, says) in [
            (all("</svg>", "<rect fill=\"red\"/></svg>"), "<rect fill=\"red\">: 0 before, 1 now"),
            (all("</svg>", "<circle r=\"9\"/></svg>"), "<circle r=\"9\">: 0 before, 1 now"),
            (all("</svg>", "<script>b()</script></svg>"), "<script>: 0 before, 1 now"),
            (all("</svg>", "<script>b()</script></svg>"), "b(): 0 before, 1 now"),
            (all("</svg>", "<foreignObject>words</foreignObject></svg>"), "words: 0 before, 1 now"),
            (all("</style>", "</style>words"), "words: 0 before, 1 now"),
            (all("</svg>", "<style>t</style></svg>"), "<style>: 1 before, 2 now"),
            (all(" 9 9\"", " 90 90\""), "<svg viewBox=\"0 0 90 90\">: 0 before, 1 now"),
            (
                all("<path class=\"line", "<path style=\"display:none\" class=\"line"),
                "<path style=\"display:none\" class=\"line\">",
            ),
            (all("class=\"dot", "opacity=\"0\" class=\"dot"), "opacity=\"0\""),
            (all("<text", "<text visibility=\"hidden\""), "visibility"),
            (
                all("<path class=\"line", "<g transform=\"scale(2)\"><path class=\"line")
                    .replace("</svg>", "</g></svg>"),
                "<g transform=\"scale(2)\">: 0 before, 1 now",
            ),
            (all("a5,5", "a9,9"), "9.0"),
            (all("e</tspan>c", "ec</tspan>"), "<tspan dy=\"5\">b ec"),
            (all(">H<", ">K<"), "what is shown where a mouse rests was “H” and is “K”"),
            (all(">T<", ">K<"), "the title was “T” and is “K”"),
            (all(">s<", ">t<"), "its colours or strokes differ"),
            (all("<title>H</title></path>", "</path><title>H</title>"), "in another order"),
        ] {
            assert_ne!(changed, drawn, "{says}");
            let difference = compare(&drawn, &changed, false).unwrap();
            assert!(difference.visible && difference.displacement == Some(0.0), "{difference:?}");
            let notes = difference.notes.join("; ");
            assert!(notes.contains(says), "{notes}");
        }
        assert!(!compare(&drawn, &all("b e", "b\ne"), false).unwrap().visible);
    }

    /// Catches: a note for each part of what is noted already.
    #[test]
    fn what_is_noted_is_noted_once() {
        let drawn = figure("M0,0h9", "a");
        let more = "<path class=\"line\" d=\"M0,0h9\"/><text x=\"1\" y=\"2\">b</text></svg>";
        let changed = drawn.replace("</svg>", more);
        let notes = compare(&drawn, &changed, false).unwrap().notes;
        assert_eq!(notes, ["line: 1 before, 2 now", "the label “b” is new"]);
    }

    /// Catches: a path that is read otherwise than it is drawn; one in part, where the rest is what
    /// our charts do not write.
    #[test]
    fn a_path_is_read_as_a_whole_or_not_at_all() {
        let marker = "M1,2m-5,0a5,5 0 1,0 10,0a5,5 0 1,0 -10,0z\nm9,9H3V4h1v-1z";
        let expected = vec![
            vec![(1.0, 2.0)],
            vec![(-4.0, 2.0), (6.0, 2.0), (-4.0, 2.0), (-4.0, 2.0)],
            vec![(5.0, 11.0), (3.0, 11.0), (3.0, 4.0), (4.0, 4.0), (4.0, 3.0), (5.0, 11.0)],
        ];
        let (strokes_of_it, arcs) = strokes(marker).unwrap();
        assert_eq!((strokes_of_it, arcs.len()), (expected, 1));
        assert_eq!(strokes("").unwrap().0.len(), 0);
        assert_eq!(strokes("M1,1 2,2").unwrap().0, [[(1.0, 1.0), (2.0, 2.0)]]);
        for broken in [
            "L1,2",
            "z",
            "M",
            "M1",
            "M1,2,3",
            "1,2",
            "M0,0c1,1 2,2 3,3",
            "M0,0z1",
            "M0,0l1-2",
            "M0,0e",
            "M0,0a1,1 0 1,0 2,2 3,3",
        ] {
            assert_eq!(strokes(broken), None, "{broken}");
            assert!(compare(&figure("M0,0", "a"), &figure(broken, "a"), false).is_err());
        }
        let nowhere = figure("M0,0", "a").replace("x=\"1\"", "x=\"nan\"");
        assert!(compare(&nowhere, &nowhere, false).is_err());
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
