//! One visual language for every figure: colour, marker and dash of a series.

use std::fmt::Write;

use super::path::{self, Num, Point};
use super::regions::Fill;

/// `(name, on light, on dark)`, each with a contrast of 3 : 1 or more against mdBook's light and
/// rust, or coal, navy and ayu. The first four, after Okabe and Ito, are the paper's methods' and
/// nobody else's. The same values stand in `book/theme/figures.css`, which can override them by
/// custom properties.
const PALETTE: [(&str, &str, &str); 10] = [
    ("vermilion", "#b83a00", "#ff8c4d"),
    ("blue", "#0068a8", "#5cb4f0"),
    ("green", "#00805c", "#34cb9d"),
    ("purple", "#b04a88", "#e79bc8"),
    ("indigo", "#5a48c0", "#b4a5ff"),
    ("ochre", "#9a6a00", "#f5d04a"),
    ("sky", "#00859b", "#8ce3ee"),
    ("brown", "#7d4b2a", "#d8a17a"),
    ("olive", "#66701a", "#c5d15a"),
    ("slate", "#5c6670", "#aab3bd"),
];
/// How many of them are the paper's.
const OWN: usize = 4;
/// The colours of areas, `(on light, on dark)`, under black or white text, by what their hue is in
/// [`PALETTE`]: from purple on. As seen by readers without one of the three cones, too, each pair
/// of them is 20 or more apart in CIELAB.
const AREAS: [(&str, &str); 7] = [
    ("#f077bf", "#3a1a3d"),
    ("#d899fd", "#1b0252"),
    ("#efd483", "#a26812"),
    ("#baf9fd", "#117a94"),
    ("#cc933f", "#5f2005"),
    ("#f4f6cd", "#837446"),
    ("#a39f8f", "#495a53"),
];
/// Of the text on an area.
const ON_AREA: (&str, &str, &str) = ("on-area", "#000000", "#ffffff");
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

/// How wide a line is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Weight {
    Thin,
    Plain,
    Bold,
}

/// How a series is drawn.
///
/// Colour, marker and dash all tell it apart, so that no one has to rely on colour alone.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Style {
    colour: Option<usize>,
    line: Option<usize>,
    marker: Option<usize>,
    guide: bool,
    pub(super) arrow: bool,
    pub(super) filled: bool,
    pub(super) dots: bool,
    weight: Weight,
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
        weight: Weight::Plain,
    };

    /// A point of the exact solution: a circle in the text's colour.
    pub const TRUE_POINT: Self = Self { line: None, marker: Some(0), ..Self::REFERENCE };

    /// An auxiliary line, thin and dotted: labelled in the plot, not in the legend, and ignored by
    /// the automatic range of an axis.
    pub const GUIDE: Self = Self { line: Some(4), guide: true, ..Self::REFERENCE };

    /// What is there beside what matters: a thin, faint line.
    pub const BACKGROUND: Self = Self { weight: Weight::Thin, ..Self::REFERENCE };

    /// The style of the method that stands at `index` in a list of methods: line and marker. The
    /// first four have a colour for themselves.
    ///
    /// The first 24 differ in colour or marker.
    pub const fn numbered(index: usize) -> Self {
        let turn = OWN + (index + PALETTE.len() - 2 * OWN) % (PALETTE.len() - OWN);
        Self {
            colour: Some(if index < OWN { index } else { turn }),
            line: Some(index % (DASHES.len() - 1)),
            marker: Some(index % MARKERS.len()),
            ..Self::REFERENCE
        }
    }

    /// The style of the `index`-th of some series that are not methods.
    ///
    /// The first 6 differ in colour, and in marker; neighbours in their dash, too. None has a
    /// colour of the paper's four methods, which are the first of [`numbered`](Self::numbered).
    pub const fn series(index: usize) -> Self {
        Self {
            colour: Some(OWN + index % (PALETTE.len() - OWN)),
            line: Some(index % (DASHES.len() - 1)),
            marker: Some(index % MARKERS.len()),
            ..Self::REFERENCE
        }
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

    /// The same with a line that is as wide as two, for what matters most.
    pub const fn bold(self) -> Self {
        Self { weight: Weight::Bold, ..self }
    }

    /// The same with a dashed line.
    pub const fn dashed(self) -> Self {
        Self { line: Some(1), ..self }
    }

    /// The same as an arrow: an unbroken line with a head where it ends, and no markers.
    pub const fn arrow(self) -> Self {
        Self { arrow: true, ..self.line_only().solid() }
    }

    /// The same with the line closed and the area inside it shaded, and no markers.
    pub const fn filled(self) -> Self {
        Self { filled: true, ..self.line_only() }
    }

    pub(super) const fn has_line(self) -> bool {
        self.line.is_some()
    }

    pub(super) const fn has_marker(self) -> bool {
        self.marker.is_some()
    }

    /// Whether it is that of an auxiliary line.
    pub const fn is_guide(self) -> bool {
        self.guide
    }

    /// The attributes of the line.
    pub(super) fn line_attributes(self) -> String {
        self.dashed_as(match self {
            Self { guide: true, .. } => "guide",
            Self { filled: true, .. } => "line fill",
            Self { weight: Weight::Thin, .. } => "line thin",
            Self { weight: Weight::Bold, .. } => "line bold",
            _ => "line",
        })
    }

    /// The attributes of the thin line from the line's end to its label.
    pub(super) fn lead(self) -> String {
        self.dashed_as("lead")
    }

    fn dashed_as(self, kind: &str) -> String {
        let class = self.class(kind);
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
        let kind = if self.weight == Weight::Bold { "line bold" } else { "line" };
        path::element(&self.class(kind), &path::dots(points))
    }

    /// The attribute `class` of what is of this `kind`.
    pub fn class(self, kind: &str) -> String {
        match self.colour {
            Some(i) => format!(r#"class="{kind} {}""#, PALETTE[i].0),
            None => format!(r#"class="{kind}""#),
        }
    }
}

/// The area for the method at `index` in a list of methods, if one has its hue.
pub const fn area_of(index: usize) -> Option<usize> {
    if index + 1 >= OWN && index + 1 < OWN + AREAS.len() { Some(index + 1 - OWN) } else { None }
}

/// The class of the `index`-th colour of areas. There are as many as [`AREAS`].
fn area(index: usize) -> String {
    format!("area-{}", index % AREAS.len())
}

/// The attribute `class` of what is filled so.
pub(super) fn fill(fill: Fill) -> String {
    let class = match fill {
        Fill::Colour(index) => area(index),
        Fill::Paper => "clear".into(),
    };
    format!(r#"class="{class}""#)
}

/// The figure's own style sheet: its colours are the book's if the book defines them, and follow
/// the reader's preference where the figure stands alone. All of it is confined to the class `id`,
/// and not to the id: where a page shows a figure twice, mdBook gives the second another id.
pub fn style_sheet(id: &str, used: &[Style], fills: &[Fill], alone: bool) -> String {
    let areas = fills.iter().filter_map(|fill| match fill {
        Fill::Colour(i) => Some(*i),
        _ => None,
    });
    let mut areas: Vec<usize> = areas.collect();
    areas.sort_unstable();
    areas.dedup();
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
        if !fills.is_empty() {
            css += &format!(".{id} .on {{fill:{}}}\n", var(ON_AREA));
        }
        for &i in &areas {
            let (name, (light, dark)) = (area(i), AREAS[i % AREAS.len()]);
            let colour = pick((light, light, dark));
            css += &format!(".{id} .{name} {{color:var(--pendula-{name},{colour})}}\n");
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
        (" .dot", "fill:currentColor;stroke-width:1"),
        (" .lead", "stroke-width:1.1;opacity:.75"),
    ];
    let mut css = format!(
        ".{id} {{font:{}px var(--pendula-font,system-ui,sans-serif)}}\n\
         .{id} path {{fill:none;stroke:currentColor;stroke-linejoin:round;stroke-linecap:round}}\n",
        super::text::FONT
    );
    let rule = |(selector, rules): &(&str, &str)| format!(".{id}{selector} {{{rules}}}\n");
    let all = |rules: &[(&str, &str)]| rules.iter().map(rule).collect::<String>();
    css += &all(&shapes);
    if !fills.is_empty() {
        css += &all(&[
            (" .cell path", "fill:currentColor;stroke:none"),
            (" .cell .clear", "fill-opacity:0"),
            (" .cell:hover path", "fill-opacity:.5"),
            (" .cell text", "visibility:hidden"),
            (" .cell:hover text", "visibility:visible"),
            (":has(.cell:hover) .prompt", "visibility:hidden"),
            (" .on", "stroke-width:0"),
            (" .edge", "stroke-width:1.8"),
            (" :is(.edge,.halo)", "pointer-events:none"),
        ]);
        css += &format!("@media print {{ .{id} .prompt {{visibility:hidden}} }}\n");
    }
    if used.iter().any(|style| style.weight != Weight::Plain) {
        css += &all(&[(" .thin", "stroke-width:1.2;opacity:.35"), (" .bold", "stroke-width:4.4")]);
    }
    if used.iter().any(|style| style.filled) {
        css += &all(&[(" .fill", "fill:currentColor;fill-opacity:.2")]);
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
        for (i, (light, dark)) in AREAS.into_iter().enumerate() {
            // By itself and printed; dark by choice and by preference.
            for (colour, times) in [(light, 1), (dark, 2)] {
                let rule = format!("--pendula-{}: {colour};", area(i));
                assert_eq!(css.matches(&rule).count(), times, "{rule}");
            }
        }
    }

    /// From sRGB to linear light, as IEC 61966-2-1 has it.
    fn linear(colour: &str) -> [f64; 3] {
        core::array::from_fn(|i| {
            let byte = u8::from_str_radix(&colour[2 * i + 1..2 * i + 3], 16).unwrap();
            let c = f64::from(byte) / 255.0;
            if c <= 0.04045 { c / 12.92 } else { libm::pow((c + 0.055) / 1.055, 2.4) }
        })
    }

    fn times(matrix: [[f64; 3]; 3], v: [f64; 3]) -> [f64; 3] {
        matrix.map(|row| row[0] * v[0] + row[1] * v[1] + row[2] * v[2])
    }

    /// CIELAB with the white of D65.
    fn lab(light: [f64; 3]) -> [f64; 3] {
        const XYZ: [[f64; 3]; 3] = [
            [0.4124564, 0.3575761, 0.1804375],
            [0.2126729, 0.7151522, 0.072175],
            [0.0193339, 0.119192, 0.9503041],
        ];
        let (xyz, white) = (times(XYZ, light.map(|c| c.clamp(0.0, 1.0))), times(XYZ, [1.0; 3]));
        let [x, y, z] = core::array::from_fn(|i| {
            let t = xyz[i] / white[i];
            if t > 216.0 / 24_389.0 { libm::cbrt(t) } else { (24_389.0 / 27.0 * t + 16.0) / 116.0 }
        });
        [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
    }

    /// What a reader sees of linear light: with all cones, without those for long waves, for middle
    /// ones, for short ones (Machado, Oliveira and Fernandes, *IEEE Transactions on Visualization
    /// and Computer Graphics* 15 (2009) 1291, severity 1).
    const VISIONS: [[[f64; 3]; 3]; 4] = [
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [
            [0.152286, 1.052583, -0.204868],
            [0.114503, 0.786281, 0.099216],
            [-0.003882, -0.048116, 1.051998],
        ],
        [
            [0.367322, 0.860646, -0.227968],
            [0.280085, 0.672501, 0.047413],
            [-0.01182, 0.04294, 0.968881],
        ],
        [
            [1.255528, -0.076749, -0.178779],
            [-0.078411, 0.930809, 0.147602],
            [0.004733, 0.691367, 0.3039],
        ],
    ];

    /// Side by side a difference of about 2 can be seen; 20 is seen from one end of a map to the
    /// other.
    ///
    /// Catches: two areas that a reader who lacks a kind of cones takes for one, such as the green
    /// and the vermilion of the lines.
    #[test]
    fn areas_differ_for_every_reader() {
        let nearest = |colours: &[&str]| {
            let mut nearest = f64::INFINITY;
            for vision in VISIONS {
                let seen: Vec<_> = colours.iter().map(|c| lab(times(vision, linear(c)))).collect();
                for (i, a) in seen.iter().enumerate() {
                    for b in &seen[..i] {
                        let square = |k: usize| (a[k] - b[k]) * (a[k] - b[k]);
                        nearest = nearest.min(libm::sqrt(square(0) + square(1) + square(2)));
                    }
                }
            }
            nearest
        };
        let (light, dark) = (AREAS.map(|area| area.0), AREAS.map(|area| area.1));
        assert!(nearest(&light) > 20.0 && nearest(&dark) > 20.0);
        assert!(nearest(&PALETTE.map(|colour| colour.1)) < 10.0, "colours made for lines");
    }

    /// Catches: a name on the map that cannot be read: 4.5 : 1 is what WCAG 2.1 asks of text.
    #[test]
    fn text_on_areas_can_be_read() {
        let contrast = |a: &str, b: &str| {
            let [a, b] = [a, b].map(|colour| {
                let [red, green, blue] = linear(colour);
                0.2126 * red + 0.7152 * green + 0.0722 * blue + 0.05
            });
            if a > b { a / b } else { b / a }
        };
        for (light, dark) in AREAS {
            for (area, text) in [(light, ON_AREA.1), (dark, ON_AREA.2)] {
                assert!(contrast(area, text) >= 4.5, "{text} on {area}");
            }
        }
    }

    /// Catches: an area whose method has a line of another hue, in either theme; or a line without
    /// hue whose area has one.
    #[test]
    fn areas_have_the_hues_of_their_methods() {
        for index in 0..24 {
            let Some(area) = area_of(index) else { continue };
            let (_, light, dark) = PALETTE[Style::numbered(index).colour.unwrap()];
            for (line, area) in [(light, AREAS[area].0), (dark, AREAS[area].1)] {
                let [[_, a, b], [_, c, d]] = [lab(linear(line)), lab(linear(area))];
                if libm::hypot(a, b) < 12.0 {
                    assert!(libm::hypot(c, d) < 12.0, "{line} {area}");
                    continue;
                }
                let cosine = (a * c + b * d) / (libm::hypot(a, b) * libm::hypot(c, d));
                assert!(cosine > 0.85, "{line} {area}: {cosine}");
            }
        }
    }

    /// Catches: series that share a colour or a marker, or have the colour of one of the paper's
    /// methods; another method with such a colour.
    #[test]
    fn series_differ_from_each_other_and_from_methods() {
        for i in 0..6 {
            let a = Style::series(i);
            for j in 0..i {
                let b = Style::series(j);
                assert!(a.colour != b.colour && a.marker != b.marker, "{i} and {j}");
            }
            for j in 0..OWN {
                assert_ne!(a.colour, Style::numbered(j).colour, "{i} and the method {j}");
            }
        }
        let colours: Vec<_> = (0..40).map(|i| Style::numbered(i).colour.unwrap()).collect();
        assert_eq!(colours[..OWN + 1], [0, 1, 2, 3, 4]);
        assert!(colours[OWN..].iter().all(|colour| *colour >= OWN), "{colours:?}");
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
        has(format!("COLOURS = [{}];", PALETTE.map(|(name, ..)| format!("'{name}',")).concat()));
        has(format!("OWN_COLOURS = {OWN};"));
        has(format!("MARKERS = [{}];", MARKERS.map(|marker| format!("'{marker}',")).concat()));
        // The last is the guides'.
        let dashes = DASHES.split_last().unwrap().1;
        let dashes = dashes.iter().map(|dash| format!("[{}]", dash.replace(' ', ",")));
        has(format!("DASHES = [{}];", list(dashes.collect())));
    }
}
