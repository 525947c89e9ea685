//! Figures compared as they are seen: how far their lines and labels have moved. All else is
//! compared as it is written.

use std::collections::{BTreeMap, BTreeSet, HashSet};

use crate::book::{Pattern, pattern};

/// Below this displacement (px) a difference cannot be seen.
pub const VISIBLE: f64 = 0.5;

/// How a figure differs.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The largest distance (px, of 600 across the figure) from a point of either drawing to the
    /// nearest of the other.
    pub displacement: f64,
    /// Where that point is.
    pub place: Option<Point>,
    /// What else differs, in sentences.
    pub notes: Vec<String>,
    /// Whether a reader can see it.
    pub visible: bool,
}

/// A point (px).
pub type Point = (f64, f64);
/// A line through points; a dot is a line of one point, and so is the place of a label.
type Stroke = Vec<Point>;

/// A figure, taken apart.
#[derive(Debug, Default)]
struct Picture {
    /// What it consists of, in order, without the places of paths and labels.
    parts: Vec<String>,
    /// The strokes of each part, those of a path or a label alone, as often as it stands there.
    strokes: BTreeMap<String, Vec<Vec<Stroke>>>,
}

/// Compares two figures.
pub fn compare(old: &str, new: &str) -> Difference {
    let [old, new] = [old, new].map(Picture::read);
    let mut notes = counted(&old, &new);
    if notes.is_empty() && old.parts != new.parts {
        notes.push("its parts stand in another order".to_string());
    }
    let mut displacement = 0.0_f64;
    let mut place = None;
    for (part, before) in &old.strokes {
        // Where there are more or fewer now a note says so.
        let after = new.strokes.get(part).filter(|now| now.len() == before.len());
        for (a, b) in before.iter().zip(after.into_iter().flatten()) {
            let ((there, from), (back, to)) = (one_way(a, b), one_way(b, a));
            let (by, at) = if there > back { (there, from) } else { (back, to) };
            if by.is_finite() {
                if by > displacement {
                    place = Some(at);
                }
                displacement = displacement.max(by);
            } else {
                notes.push("of two lines one is empty".to_string());
            }
        }
    }
    let visible = !notes.is_empty() || displacement >= VISIBLE;
    Difference { displacement, place, notes, visible }
}

/// The elements that are read as they are written, with all that stands in them.
const WORDS: [&str; 5] = ["figcaption", "title", "desc", "style", "text"];

impl Picture {
    fn read(figure: &str) -> Self {
        let (mut picture, mut part, mut open) = (Self::default(), String::new(), None);
        for piece in figure.split_inclusive('>') {
            part += piece;
            let tag = piece.rsplit('<').next().unwrap_or_default();
            let name = tag.split([' ', '\n', '>']).next().unwrap_or_default();
            let words = open.or_else(|| WORDS.into_iter().find(|words| *words == name));
            open = words.filter(|words| name.strip_prefix('/') != Some(words));
            if open.is_none() {
                picture.push(&part);
                part.clear();
            }
        }
        picture.push(&part);
        picture
    }

    /// Adds a tag, or words with their tags.
    fn push(&mut self, part: &str) {
        let part = part.split_whitespace().collect::<Vec<_>>().join(" ");
        let mut rest = part.clone();
        let strokes = match part.split(' ').next() {
            Some("<path") => strokes(&cut(&mut rest, " d=\"").unwrap_or_default()),
            Some("<text") => place(&mut rest).map(|at| vec![vec![at]]),
            _ => None,
        };
        // What is not understood is compared as it is written.
        let part = if strokes.is_some() { rest } else { part };
        self.strokes.entry(part.clone()).or_default().push(strokes.unwrap_or_default());
        self.parts.push(part);
    }
}

/// Takes the place of a label out of its tag.
fn place(label: &mut String) -> Option<Point> {
    let mut at = |name| number(&cut(label, name)?);
    at(" x=\"").zip(at(" y=\""))
}

/// Takes the value of an attribute out of the first tag.
fn cut(part: &mut String, attribute: &str) -> Option<String> {
    let from = part[..part.find('>')?].find(attribute)? + attribute.len();
    let to = from + part[from..].find('"')?;
    let value = part[from..to].to_string();
    part.replace_range(from..to, "");
    Some(value)
}

/// Parts of which there are more or fewer.
fn counted(old: &Picture, new: &Picture) -> Vec<String> {
    let parts: BTreeSet<&String> = old.strokes.keys().chain(new.strokes.keys()).collect();
    let note = |part: &String| {
        // The text of it, or else all of it.
        let words = part.split('<').filter_map(|piece| piece.split('>').next_back());
        let what = match words.collect::<String>() {
            _ if part.starts_with("<style") => "its style".to_string(),
            words if words.is_empty() || part.starts_with("<path") => part.to_string(),
            words => format!("“{words}”"),
        };
        match [old, new].map(|picture| picture.strokes.get(part).map_or(0, Vec::len)) {
            [before, now] if before == now => None,
            [0, _] => Some(format!("{what} is new")),
            [_, 0] => Some(format!("{what} has gone")),
            [before, now] => Some(format!("{what}: {before} before, {now} now")),
        }
    };
    parts.into_iter().filter(|part| !part.starts_with("</")).filter_map(note).collect()
}

/// The strokes of path data, of arcs the ends alone. Nothing of data that our charts do not write.
fn strokes(d: &str) -> Option<Vec<Stroke>> {
    static COMMAND: Pattern = Pattern::new(|| pattern(r"([a-zA-Z]?)([^a-zA-Z]*)"));
    let (mut strokes, mut at) = (Vec::<Stroke>::new(), (0.0, 0.0));
    for found in COMMAND.captures_iter(d.trim()).filter(|found| !found[0].is_empty()) {
        let command = &found[1];
        let words = found[2].split([' ', ',', '\n']).filter(|word| !word.is_empty());
        let numbers = words.map(number).collect::<Option<Vec<f64>>>()?;
        let count = match command {
            "M" | "m" | "L" | "l" => 2,
            "H" | "h" | "V" | "v" => 1,
            "a" => 7,
            "z" if numbers.is_empty() => {
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
            let from = if "MLHV".contains(command) { (0.0, 0.0) } else { at };
            at = match (command, numbers) {
                ("H" | "h", [x]) => (from.0 + x, at.1),
                ("V" | "v", [y]) => (at.0, from.1 + y),
                (_, [.., x, y]) => (from.0 + x, from.1 + y),
                _ => return None,
            };
            if i == 0 && matches!(command, "M" | "m") {
                strokes.push(vec![at]);
            } else {
                strokes.last_mut()?.push(at);
            }
        }
    }
    Some(strokes)
}

/// A finite number.
fn number(text: &str) -> Option<f64> {
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

/// The largest distance from a corner of `a` to the nearest point of `b`, and that corner.
fn one_way(a: &[Stroke], b: &[Stroke]) -> (f64, Point) {
    let bits = |p: &Point| (p.0.to_bits(), p.1.to_bits());
    // Most corners have not moved at all.
    let known: HashSet<_> = b.iter().flatten().map(bits).collect();
    let moved = a.iter().flatten().filter(|p| !known.contains(&bits(p)));
    let farthest = |most: (f64, Point), p: &Point| {
        let distance = distance(*p, b);
        if distance > most.0 { (distance, *p) } else { most }
    };
    moved.fold((0.0, Point::default()), farthest)
}

/// The distance from `p` to the nearest point of the strokes.
fn distance(p: Point, strokes: &[Stroke]) -> f64 {
    // The last point is a segment too, as a dot has no other.
    let segments = strokes.iter().flat_map(|s| s.iter().zip(s.iter().skip(1).chain(s.last())));
    segments.map(|(a, b)| to_segment(p, *a, *b)).fold(f64::INFINITY, f64::min)
}

/// The distance from `p` to the segment from `a` to `b`.
fn to_segment(p: Point, a: Point, b: Point) -> f64 {
    let (ux, uy, vx, vy) = (b.0 - a.0, b.1 - a.1, p.0 - a.0, p.1 - a.1);
    let length = ux * ux + uy * uy;
    let along = if length > 0.0 { ((ux * vx + uy * vy) / length).clamp(0.0, 1.0) } else { 0.0 };
    (vx - along * ux).hypot(vy - along * uy)
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

    /// Catches: a displacement seen where only the text differs; one measured between corners
    /// where the lines pass each other more closely; one that looks one way only; the displacement
    /// of one path taken for that of the whole figure.
    #[test]
    fn what_is_drawn_is_compared_and_not_its_text() {
        let moved = |old: &str, new: &str| {
            let difference = compare(&figure(old, "a"), &figure(new, "a"));
            assert_eq!(difference.notes, [""; 0]);
            assert_eq!(difference.visible, difference.displacement >= VISIBLE);
            difference.displacement
        };
        assert_eq!(moved("M0,0l10,0 10,0", "M0,0\nL20,0"), 0.0);
        assert_eq!(moved("M0,0l20,0", "M0,0.4l20,0"), 0.4);
        assert_eq!(moved("M0,0l20,0", "M0,0l10,3 10,-3"), 3.0);
        assert_eq!(moved("M0,0l10,3 10,-3", "M0,0l20,0"), 3.0);
        assert_eq!(moved("m5,5h0m7,0h0", "M5,5h0M12,6h0"), 1.0);
        let [first, last] = [(5, 0), (0, 5)].map(|(line, dot)| {
            let path = format!("<path class=\"dot\" d=\"M50,{dot}v9\"/><text");
            figure(&format!("M0,{line}h20"), "a").replace("<text", &path)
        });
        assert_eq!(compare(&first, &last).displacement, 5.0);
        let label = first.replace("y=\"2\"", "y=\"9\"");
        assert_eq!(compare(&first, &label).displacement, 7.0);
    }

    /// Catches: what covers, hides, moves or adds to a drawing without a change of its lines,
    /// called invisible; a path or a label that is passed over.
    #[test]
    fn whatever_is_not_understood_is_visible() {
        let more = "\"><title>H</title></path><path class=\"dot\" d=\"M9,9v1\"/><text";
        let drawn = figure("M0,0h9m1,1a5,5 0 1,0 10,0z", "a<tspan dy=\"5\">b e</tspan>c");
        let drawn = drawn.replace("\"/><text", more);
        for (from, to, says) in [
            ("</svg>", "<rect fill=\"red\"/></svg>", "<rect fill=\"red\"/> is new"),
            (" 9 9\"", " 90 90\"", "<svg viewBox=\"0 0 90 90\"> is new"),
            ("<path class=\"line", "<path style=\"display:none\" class=\"line", "display:none"),
            ("class=\"dot", "opacity=\"0\" class=\"dot", "opacity=\"0\""),
            ("<text", "<text visibility=\"hidden\"", "“ab ec” is new"),
            ("e</tspan>c", "ec</tspan>", "“ab ec” is"),
            (">H<", ">K<", "“H” has gone; “K” is new"),
            (">T<", ">K<", "“K” is new"),
            (">C<", ">K<", "“K” is new"),
            (">s<", ">t<", "its style is new"),
            ("<title>H</title></path>", "</path><title>H</title>", "in another order"),
            ("M9,9v1", "", "of two lines one is empty"),
        ] {
            let changed = drawn.replace(from, to);
            assert_ne!(changed, drawn, "{says}");
            let difference = compare(&drawn, &changed);
            assert!(difference.visible && difference.displacement == 0.0, "{difference:?}");
            let notes = difference.notes.join("; ");
            assert!(notes.contains(says), "{notes}");
        }
        assert!(!compare(&drawn, &drawn.replace("b e", "b\ne")).visible);
        let more = "<path class=\"dot\" d=\"M0,0h9\"/></svg>";
        let notes = compare(&drawn, &drawn.replace("</svg>", more)).notes;
        assert_eq!(notes, ["<path class=\"dot\" d=\"\"/>: 1 before, 2 now"]);
    }

    /// Catches: a path that is read in part, where the rest is what our charts do not write, so
    /// that a change of that is none.
    #[test]
    fn what_our_charts_do_not_write_is_compared_as_it_is_written() {
        for path in ["L1,2", "z", "M", "M1,2,3", "1,2", "M0,0c1,1 2,2 3,3", "M0,0z1", "M0,0l1-2"] {
            assert_eq!(strokes(path), None, "{path}");
            let notes = compare(&figure(path, "a"), &figure("M0,0", "a")).notes.join("; ");
            assert!(notes.contains(&format!("d=\"{path}\"")), "{notes}");
        }
        let label = figure("M0,0", "a").replace("x=\"1\"", "x=\"nan\"");
        assert!(compare(&label, &figure("M0,0", "a")).visible);
        assert!(compare("words", "words else").visible);
        let marker = "M1,2m-5,0a5,5 0 1,0 10,0a5,5 0 1,0 -10,0z m9,9H3V4h1v-1z";
        let expected = vec![
            vec![(1.0, 2.0)],
            vec![(-4.0, 2.0), (6.0, 2.0), (-4.0, 2.0), (-4.0, 2.0)],
            vec![(5.0, 11.0), (3.0, 11.0), (3.0, 4.0), (4.0, 4.0), (4.0, 3.0), (5.0, 11.0)],
        ];
        assert_eq!(strokes(marker).unwrap(), expected);
    }
}
