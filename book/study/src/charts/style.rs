//! One visual language for every figure: colour, marker and dash of a series.

use std::fmt::Write;

use super::path::{self, Num, Point};

/// `(name, on light, on dark)`: Okabe and Ito's colours, darkened or lightened until each has a
/// contrast of 3 : 1 or more against mdBook's light and rust, or coal, navy and ayu. The same
/// values stand in `book/theme/figures.css`, which can override them by custom properties.
const PALETTE: [(&str, &str, &str); 6] = [
    ("vermilion", "#b83a00", "#ff8c4d"),
    ("blue", "#0068a8", "#5cb4f0"),
    ("green", "#00805c", "#34cb9d"),
    ("purple", "#b04a88", "#e79bc8"),
    ("ochre", "#9a6a00", "#f5d04a"),
    ("sky", "#3a86b4", "#a5d8ff"),
];
const INK: (&str, &str, &str) = ("ink", "#24292f", "#d5dae0");
const PAPER: (&str, &str, &str) = ("paper", "#ffffff", "#0d1117");

/// Circle, square, diamond, triangle, plus, cross, triangle upside down, hourglass.
const MARKERS: [&str; 8] = [
    "m-5,0a5,5 0 1,0 10,0a5,5 0 1,0 -10,0z",
    "m-4.6,-4.6h9.2v9.2h-9.2z",
    "m0,-6.4l6.4,6.4 -6.4,6.4 -6.4,-6.4z",
    "m0,-6.4l6,10.4h-12z",
    "m-2,-6h4v4h4v4h-4v4h-4v-4h-4v-4h4z",
    "m0,-2.6l3.4,-3.4 2.6,2.6 -3.4,3.4 3.4,3.4 -2.6,2.6 -3.4,-3.4 -3.4,3.4 -2.6,-2.6 \
     3.4,-3.4 -3.4,-3.4 2.6,-2.6z",
    "m0,6.4l6,-10.4h-12z",
    "m-5.4,-5.4h10.8l-10.8,10.8h10.8z",
];

const DASHES: [&str; 5] = ["", "14 5", "14 4 2 4", "7 4", "2 4"];

/// How a series is drawn.
///
/// Colour, marker and dash all tell it apart, so that no one has to rely on colour alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Style {
    colour: Option<usize>,
    line: Option<usize>,
    marker: Option<usize>,
    guide: bool,
    arrow: bool,
    filled: bool,
    dots: bool,
}

impl Style {
    /// The exact solution, or what the others are compared with: a plain line in the text's
    /// colour.
    pub const REFERENCE: Self = Self {
        colour: None,
        line: Some(0),
        marker: None,
        guide: false,
        arrow: false,
        filled: false,
        dots: false,
    };

    /// A point of the exact solution: a circle in the text's colour.
    pub const TRUE_POINT: Self = Self { line: None, marker: Some(0), ..Self::REFERENCE };

    /// An auxiliary line, thin and dotted: labelled in the plot, not in the legend, and ignored by
    /// the automatic range of an axis.
    pub const GUIDE: Self = Self { line: Some(4), guide: true, ..Self::REFERENCE };

    /// The style of the method that stands at `index` in the list of methods: line and marker.
    ///
    /// The first 24 differ in colour or marker.
    pub const fn numbered(index: usize) -> Self {
        Self {
            colour: Some(index % PALETTE.len()),
            line: Some(index % (DASHES.len() - 1)),
            marker: Some(index % MARKERS.len()),
            ..Self::REFERENCE
        }
    }

    /// The style of the `index`-th of some series that are not methods, and so have no colour:
    /// they differ in marker and dash.
    ///
    /// The first 8 differ in their marker.
    pub const fn colourless(index: usize) -> Self {
        Self { colour: None, ..Self::numbered(index) }
    }

    /// The same without markers.
    pub const fn line_only(self) -> Self {
        Self { marker: None, ..self }
    }

    /// The same without the line.
    pub const fn markers_only(self) -> Self {
        Self { line: None, ..self }
    }

    /// The same with a dot for each point, as wide as a line: for thousands of points that are not
    /// joined. Dots that a pixel cannot tell apart are one.
    pub const fn dots(self) -> Self {
        Self { line: None, marker: None, dots: true, ..self }
    }

    /// The same with an unbroken line: for strokes that turn to and fro too quickly for dashes.
    pub const fn solid(self) -> Self {
        Self { line: Some(0), ..self }
    }

    /// The same with a dashed line.
    pub const fn dashed(self) -> Self {
        Self { line: Some(3), ..self }
    }

    /// The same as an arrow: an unbroken line with a head where it ends, and no markers.
    pub const fn arrow(self) -> Self {
        Self { arrow: true, ..self.line_only().solid() }
    }

    /// The same with the line closed and the area inside it shaded, and no markers.
    pub const fn filled(self) -> Self {
        Self { filled: true, ..self.line_only() }
    }

    pub(super) const fn is_arrow(self) -> bool {
        self.arrow
    }

    pub(super) const fn is_filled(self) -> bool {
        self.filled
    }

    pub(super) const fn has_line(self) -> bool {
        self.line.is_some()
    }

    pub(super) const fn has_marker(self) -> bool {
        self.marker.is_some()
    }

    pub(super) const fn is_dots(self) -> bool {
        self.dots
    }

    pub(super) const fn is_guide(self) -> bool {
        self.guide
    }

    /// The attributes of the line.
    pub(super) fn line_attributes(self) -> String {
        let class = self.class(match self {
            Self { guide: true, .. } => "guide",
            Self { filled: true, .. } => "line fill",
            _ => "line",
        });
        match DASHES[self.line.unwrap_or(0)] {
            "" => class,
            dash => format!(r#"{class} stroke-dasharray="{dash}""#),
        }
    }

    /// One path with a marker at each of the points.
    pub(super) fn markers(self, points: impl IntoIterator<Item = (f64, f64)>) -> String {
        let shape = MARKERS[self.marker.unwrap_or(0)];
        let mut d = String::new();
        for (x, y) in points {
            let _ = write!(d, "M{},{}{shape}", Num(x), Num(y));
        }
        path::element(&self.class("dot"), &path::stroke_by_stroke(&d))
    }

    /// The head of an arrow with these corners, with `attributes` of its own.
    pub(super) fn head(self, [tip, a, b]: [(f64, f64); 3], attributes: &str) -> String {
        let mut d = String::new();
        for (command, (x, y)) in [("M", tip), ("L", a), ("L", b)] {
            let _ = write!(d, "{command}{},{}", Num(x), Num(y));
        }
        format!(r#"<path {}{attributes} d="{d}z"/>"#, self.class("dot"))
    }

    /// One path with a dot at each of the points.
    pub(super) fn dotted(self, points: Vec<Point>) -> String {
        path::element(&self.class("line"), &path::dots(points))
    }

    fn class(self, kind: &str) -> String {
        match self.colour {
            Some(i) => format!(r#"class="{kind} {}""#, PALETTE[i].0),
            None => format!(r#"class="{kind}""#),
        }
    }
}

/// The figure's own style sheet: its colours are the book's if the book defines them, and follow
/// the reader's preference where the figure stands alone. All of it is confined to the class `id`,
/// and not to the id: where a page shows a figure twice, mdBook gives the second another id.
pub(super) fn style_sheet(id: &str, used: &[Style], alone: bool) -> String {
    let mut colours: Vec<_> = used.iter().filter_map(|style| style.colour).collect();
    colours.sort_unstable();
    colours.dedup();
    let theme = |pick: fn((&'static str, &'static str, &'static str)) -> &'static str| {
        let var = |c: (&'static str, _, _)| format!("var(--pendula-{},{})", c.0, pick(c));
        let mut css = format!(".{id} {{color:{}}}\n", var(INK));
        css += &format!(".{id} .dot,.{id} .halo {{stroke:{}}}\n", var(PAPER));
        if alone {
            css += &format!(".{id} .paper {{fill:{}}}\n", var(PAPER));
        }
        for &i in &colours {
            css += &format!(".{id} .{} {{color:{}}}\n", PALETTE[i].0, var(PALETTE[i]));
        }
        css
    };
    let (light, dark) = (theme(|c| c.1), theme(|c| c.2));
    let shapes = [
        (" text", "fill:currentColor"),
        (" .halo", "paint-order:stroke;stroke-width:5;stroke-linejoin:round"),
        (" .line", "stroke-width:2.2"),
        (" .guide", "stroke-width:1.6;opacity:.75"),
        (" .axis", "stroke-width:1.2;opacity:.7"),
        (" .grid", "stroke-width:1;opacity:.16"),
        (" .mark", "stroke-width:1.6;stroke-dasharray:7 4"),
        (" .band", "fill:currentColor;stroke:none;opacity:.1"),
        (" .dot", "fill:currentColor;stroke-width:1"),
    ];
    let mut css = format!(
        ".{id} {{font:{}px var(--pendula-font,system-ui,sans-serif)}}\n\
         .{id} path {{fill:none;stroke:currentColor;stroke-linejoin:round;stroke-linecap:round}}\n",
        super::text::FONT
    );
    for (selector, rules) in shapes {
        css += &format!(".{id}{selector} {{{rules}}}\n");
    }
    if used.iter().any(|style| style.filled) {
        css += &format!(".{id} .fill {{fill:currentColor;fill-opacity:.2}}\n");
    }
    format!("<style>\n{css}{light}@media (prefers-color-scheme:dark) {{\n{dark}}}\n</style>\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: two methods that a reader cannot tell apart.
    #[test]
    fn numbered_styles_differ() {
        for i in 0..24 {
            for j in 0..i {
                let (a, b) = (Style::numbered(i), Style::numbered(j));
                assert!((a.colour, a.marker) != (b.colour, b.marker), "{i} and {j}");
            }
        }
    }

    /// Catches: a rule that leaks into the page or into the next figure; `{{`, which mdBook's
    /// preprocessors would read.
    #[test]
    fn every_rule_is_confined_to_its_figure() {
        let css = style_sheet("fig-a", &[Style::numbered(0), Style::REFERENCE.filled()], false);
        for rule in css.lines().filter(|line| line.ends_with('}') && line.len() > 1) {
            let (selectors, _) = rule.split_once('{').unwrap();
            assert!(selectors.split(',').all(|s| s.starts_with(".fig-a ")), "{rule}");
        }
        assert!(css.contains("vermilion") && !css.contains("blue") && !css.contains("{{"));
    }

    /// A file of the book.
    fn of_the_book(file: &str) -> String {
        let book = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        std::fs::read_to_string(book.join(file)).expect("a file of the book")
    }

    /// Catches: a stylesheet of the book whose colours differ from those of a figure by itself.
    #[test]
    fn the_book_has_the_same_colours() {
        let css = of_the_book("theme/figures.css");
        for (name, light, dark) in PALETTE {
            for colour in [light, dark] {
                assert!(css.contains(&format!("--pendula-{name}: {colour};")), "{name} {colour}");
            }
        }
    }

    /// Catches: a lab in which a method has another marker, colour or dash than in the figures
    /// beside it.
    #[test]
    fn the_lab_draws_methods_as_the_figures_do() {
        // How the lists are laid out does not matter.
        let packed = |text: &str| text.split_whitespace().collect::<String>();
        let script = packed(&of_the_book("theme/lab/sheet.js"));
        let has = |list: String| assert!(script.contains(&packed(&list)), "{list}");
        let list = |words: Vec<String>| words.join(", ");
        let colours = list(PALETTE.map(|(name, ..)| format!("'{name}'")).to_vec());
        has(format!("COLOURS = [{colours}];"));
        has(format!("MARKERS = [{}];", MARKERS.map(|marker| format!("'{marker}',")).concat()));
        // The last is the guides'.
        let dashes = DASHES.split_last().unwrap().1;
        let dashes = dashes.iter().map(|dash| format!("[{}]", dash.replace(' ', ",")));
        has(format!("DASHES = [{}];", list(dashes.collect())));
    }
}
