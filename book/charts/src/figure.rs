//! A figure: its charts in rows, each row under the legend of what is new in it.

use super::axis::Scale;
use super::chart::{Chart, Series};
use super::ends::{self, End};
use super::path::{self, Num, Point};
use super::plot::Plot;
use super::regions::Fill;
use super::style::{Style, style_sheet};
use super::text::{draw_text, escape, line, width, wrapped};
use super::{GAP, RIGHT, ROW};

const WIDTH: f64 = 600.0;
/// Around a figure that is a file of its own, and the height of its title.
const MARGIN: f64 = 16.0;
const HEAD: f64 = 1.5 * ROW;

/// A picture: one chart, or several below or beside each other with one legend.
#[derive(Clone, Debug)]
pub struct Figure {
    title: String,
    description: String,
    /// Its charts, row by row.
    pub panels: Vec<Chart>,
    columns: usize,
    legend: bool,
}

impl Figure {
    /// An empty figure. Title and description are for readers who cannot see it: the description
    /// says in words what the picture shows.
    pub fn new(title: impl Into<String>, description: impl Into<String>) -> Self {
        let (title, description) = (title.into(), description.into());
        Self { title, description, panels: Vec::new(), columns: 1, legend: false }
    }

    /// With one more sentence in its description.
    pub fn saying(mut self, sentence: &str) -> Self {
        self.description += &format!(" {sentence}");
        self
    }

    /// With one more chart below the others. Charts with the same x axis share its label.
    pub fn panel(mut self, chart: Chart) -> Self {
        self.panels.push(chart);
        self
    }

    /// The charts stand in rows of `count`, filled from the left. A chart whose left neighbour has
    /// the same y axis does not repeat what is written on it.
    pub fn columns(self, count: usize) -> Self {
        Self { columns: count.max(1), ..self }
    }

    /// All lines are named in legends, and none at its end: where those of the first chart lie on
    /// each other, a reader looks for their names above it.
    pub fn with_legend(self) -> Self {
        Self { legend: true, ..self }
    }

    /// The `<svg>` element, without a blank line and in short lines, each element on its own.
    ///
    /// Its id is `fig-{id}`, with all but ASCII letters and digits replaced by hyphens; each figure
    /// of a page needs its own.
    pub fn to_svg(&self, id: &str) -> String {
        self.drawn(id, false)
    }

    /// The same as a file of its own: under its title, with a margin, on paper that is light or
    /// dark as the reader prefers.
    pub fn to_file(&self, id: &str) -> String {
        self.drawn(id, true)
    }

    fn drawn(&self, id: &str, alone: bool) -> String {
        let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '-' };
        let id = format!("fig-{}", id.chars().map(plain).collect::<String>());
        let styles: Vec<Style> =
            self.panels.iter().flat_map(|chart| &chart.series).map(|series| series.style).collect();
        let maps = self.panels.iter().filter_map(|chart| chart.map.as_ref());
        let fills: Vec<Fill> = maps.flat_map(|map| &map.names).map(|name| name.fill).collect();
        let scales: Vec<_> = self.panels.iter().map(Chart::scales).collect();
        let (body, height) = Layout::new(self, &scales).draw(&id);
        let (frame, above) = if alone {
            let mut above = String::new();
            let [left, top, width, height] =
                [-MARGIN, -MARGIN - HEAD, WIDTH + 2.0 * MARGIN, height + 2.0 * MARGIN + HEAD];
            let place = format!(r#"x="{left}" y="{top}" width="{width}" height="{height}""#);
            line(&mut above, format!(r#"<rect class="paper" {place}/>"#));
            draw_text(&mut above, "", (0.0, -ROW), "start", &self.title);
            let frame = format!(
                "width=\"{width}\" height=\"{height}\" viewBox=\"{left} {top} {width} {height}\""
            );
            (frame, above)
        } else {
            (format!("width=\"100%\" viewBox=\"0 0 {WIDTH} {}\"", Num(height)), String::new())
        };
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" id=\"{id}\" class=\"pendula {id}\"\n{frame} \
             role=\"img\"\naria-labelledby=\"{id}-title {id}-desc\">\n<title \
             id=\"{id}-title\">{}</title>\n<desc \
             id=\"{id}-desc\">{}</desc>\n{}{above}{body}</svg>\n",
            escape(&self.title),
            wrapped(&escape(&self.description)),
            style_sheet(&id, &styles, &fills, alone),
        )
    }
}

/// Where the charts of a figure stand: row by row, each row under the legend of what is new in it.
struct Layout<'a> {
    panels: &'a [Chart],
    columns: usize,
    scales: &'a [(Scale<'a>, Scale<'a>)],
    /// The labels beside each chart.
    ends: Vec<Vec<End<'a>>>,
    /// Left of a chart, for the numbers of its y axis.
    margin: f64,
}

impl<'a> Layout<'a> {
    fn new(
        Figure { panels, columns, legend, .. }: &'a Figure,
        scales: &'a [(Scale, Scale)],
    ) -> Self {
        // Labels beside a chart need it to be alone in its row.
        let mut ends = ends::of(panels, scales);
        for row in ends.chunks_mut(*columns).filter(|row| *legend || row.len() > 1) {
            row.iter_mut().for_each(Vec::clear);
        }
        let charts = panels.iter().zip(scales).filter(|(chart, _)| !chart.sketch);
        let labels = charts.flat_map(|(chart, (_, y))| y.ticks(chart.y_ticks()));
        let widths = labels.filter_map(|tick| tick.label).map(|label| width(&label));
        let margin = widths.fold(24.0, f64::max) + 14.0;
        Self { panels, columns: *columns, scales, ends, margin }
    }

    /// All charts with their legends, and how high they are together.
    fn draw(&self, id: &str) -> (String, f64) {
        let mut known: Vec<Entry> = self.ends.iter().flatten().map(End::entry).collect();
        let (mut out, mut top) = (String::new(), 0.0);
        for (row, charts) in self.panels.chunks(self.columns).enumerate() {
            // Charts side by side have one legend, above them all.
            let entries = match (self.columns, row) {
                (1, _) => entries(charts),
                (_, 0) => entries(self.panels),
                _ => Vec::new(),
            };
            let is_known = |(label, styles): &Entry| {
                let mut known = known.iter().filter(|entry| entry.0 == *label);
                known.any(|entry| styles.iter().all(|style| entry.1.contains(style)))
            };
            let unknown: Vec<Entry> = entries.into_iter().filter(|e| !is_known(e)).collect();
            // Where nothing else stands between two charts.
            if row > 0 && (!unknown.is_empty() || charts.iter().all(|c| c.heading.is_empty())) {
                top += GAP;
            }
            top += draw_legend(&mut out, &unknown, top);
            known.extend(unknown);
            top = self.draw_row(&mut out, id, row * self.columns, top);
        }
        (out, top.ceil())
    }

    /// Draws the row whose first chart has this number, and returns where it ends.
    fn draw_row(&self, out: &mut String, id: &str, first: usize, top: f64) -> f64 {
        let row = first..self.panels.len().min(first + self.columns);
        let charts = &self.panels[row.clone()];
        // Charts below each other end below each other.
        let in_line = if self.columns == 1 { 0..self.ends.len() } else { row.clone() };
        let beside = RIGHT.max(ends::room(&self.ends[in_line]));
        let repeats = |i: usize| i > 0 && charts[i - 1].y == charts[i].y;
        let margin = |i: usize| match charts[i].sketch {
            true => RIGHT,
            false if repeats(i) => 0.0,
            false => self.margin,
        };
        let margins: Vec<f64> = (0..charts.len()).map(margin).collect();
        // A chart that is alone in its row has all of its width.
        let count = charts.len() as f64;
        let free = WIDTH - margins.iter().sum::<f64>() - beside * count;
        let (mut edge, mut bottom) = (0.0, top);
        for (i, chart) in charts.iter().enumerate() {
            let index = first + i;
            let (x, y) = &self.scales[index];
            let below = self.panels.get(index + self.columns);
            let written = match chart.sketch {
                true => [false; 2],
                false => [below.is_none_or(|next| next.x != chart.x), !repeats(i)],
            };
            let left = edge + margins[i];
            let right = left + free / count;
            let plot = Plot::new(chart, [x, y], written, [edge, left, right], top);
            let clip = format!("{id}-clip-{index}");
            bottom = plot.draw(out, &clip, &self.ends[index]).max(bottom);
            edge = right + beside;
        }
        bottom
    }
}

/// A label and how what it names is drawn.
pub(super) type Entry<'a> = (&'a str, Vec<Style>);

/// What these charts show.
fn entries(charts: &[Chart]) -> Vec<Entry<'_>> {
    let mut entries: Vec<Entry> = Vec::new();
    let all = charts.iter().flat_map(|chart| &chart.series);
    for Series { label, style, .. } in all.filter(|series| series.has_label()) {
        match entries.iter_mut().find(|(known, _)| known == label) {
            Some((_, styles)) if styles.contains(style) => {}
            Some((_, styles)) => styles.push(*style),
            None => entries.push((label, vec![*style])),
        }
    }
    entries
}

/// Draws a legend below `top`, in even columns, or in two uneven ones if a single one would do
/// otherwise, and returns how high it is.
fn draw_legend(out: &mut String, entries: &[Entry], top: f64) -> f64 {
    const SWATCH: f64 = 46.0;
    let needed =
        |entries: &[Entry]| entries.iter().map(|e| width(e.0)).fold(0.0, f64::max) + SWATCH + 18.0;
    let widest = needed(entries);
    let (first, second) = entries.split_at(entries.len().div_ceil(2));
    let (columns, step) = match ((WIDTH / widest).floor() as usize).clamp(1, 4) {
        1 if needed(first) + needed(second) - 18.0 <= WIDTH => (2, needed(first)),
        columns => (columns, widest),
    };
    let rows = entries.len().div_ceil(columns);
    for (i, (label, styles)) in entries.iter().enumerate() {
        // Down the columns, so that the order of the list is kept within each.
        let (x, y) = ((i / rows) as f64 * step, top + (i % rows) as f64 * ROW + 13.0);
        line(out, ENTRY.into());
        key(out, styles, (x + 1.0, y), 36.0);
        draw_text(out, "", (x + SWATCH, y + 6.0), "start", label);
        line(out, "</g>".into());
    }
    if rows == 0 { 0.0 } else { rows as f64 * ROW + 6.0 }
}

/// An entry of a legend, or the label at the end of a line: samples and their text.
pub(super) const ENTRY: &str = r#"<g class="entry">"#;

/// Draws a sample of each of the styles, `length` long from (`x`, `y`) to the right.
fn key(out: &mut String, styles: &[Style], (x, y): Point, length: f64) {
    for style in styles.iter().filter(|style| style.has_line()) {
        let mut ends = [(x, y), (x + length, y)];
        let head = style.arrow.then(|| path::head(&mut ends, 0.0)).flatten();
        let d = match style.filled {
            true => format!("M{},{}h{length}v14h-{length}z", Num(x), Num(y - 7.0)),
            false => format!("M{},{}h{}", Num(x), Num(y), Num(ends[1].0 - x)),
        };
        line(out, format!(r#"<path {} d="{d}"/>"#, style.line_attributes()));
        if let Some(head) = head {
            line(out, style.head(head, ""));
        }
    }
    for style in styles.iter().filter(|style| style.dots) {
        let sprinkle = [(3.0, -2.0), (9.0, 4.0), (18.0, 0.0), (26.0, -4.0), (32.0, 3.0)];
        line(out, style.dotted(sprinkle.map(|(dx, dy)| (x + dx, y + dy)).to_vec()));
    }
    for style in styles.iter().filter(|style| style.has_marker()) {
        line(out, style.markers([(x + length / 2.0, y)]));
    }
}

#[cfg(test)]
mod tests {
    use super::super::Axis;
    use super::*;

    fn sample() -> Figure {
        let chart = Chart::new(Axis::linear("t (s)"), Axis::log("error <J>"))
            .series(
                "a & b",
                Style::numbered(0),
                [(0.0, 1.0), (1.0, 0.0), (2.0, 1e-3), (f64::NAN, 1.0)],
            )
            .series("", Style::REFERENCE, [(0.0, 1e-2), (f64::INFINITY, 1.0), (2.0, 1e-2)])
            .vertical(1.0, "T")
            .slope(2.0, (0.5, 1e-2), 2.0, "slope 2")
            .note(2.0, 1e-3, "here");
        Figure::new("Title\n\nof <two>", "says \"so\"").panel(chart)
    }

    /// The elements, each of which begins a line.
    fn elements(svg: &str) -> impl Iterator<Item = &str> {
        svg.split("\n<")
    }

    /// Catches: a file whose text is light on the white of a browser, or cut off at its edges;
    /// without its title; paper in the figures of the book, whose themes have their own.
    #[test]
    fn a_file_of_its_own_has_paper() {
        let (file, part) = (sample().to_file("f"), sample().to_svg("f"));
        assert_eq!(file.matches("class=\"paper\"").count(), 1);
        assert_eq!(file.matches(".fig-f .paper {fill:var(--pendula-paper,").count(), 2);
        assert!(!part.contains("paper\"") && !part.contains(".paper"));
        let quoted = |name: &str, of: &str| -> String {
            let (_, rest) = of.split_once(&format!("{name}=\"")).unwrap();
            rest.split_once('"').unwrap().0.to_string()
        };
        let inner: Vec<f64> =
            quoted("viewBox", &part).split(' ').map(|x| x.parse().unwrap()).collect();
        let outer: Vec<f64> =
            quoted("viewBox", &file).split(' ').map(|x| x.parse().unwrap()).collect();
        assert!(outer[0] < 0.0 && outer[1] < 0.0, "{outer:?}");
        assert!(outer[0] + outer[2] > inner[2] && outer[1] + outer[3] > inner[3], "{outer:?}");
        let paper = &file[file.find("<rect").unwrap()..];
        let place = ["x", "y", "width", "height"].map(|name| quoted(&format!(" {name}"), paper));
        assert_eq!(place.join(" "), quoted("viewBox", &file));
        assert!(file.contains(">Title  of &lt;two&gt;</text>"), "{file}");
        roxmltree::Document::parse(&file).expect("well-formed XML");
    }

    /// Catches: NaN, infinity or a logarithm of zero in a coordinate; a line drawn across the gap
    /// such a point leaves.
    #[test]
    fn points_without_a_place_leave_a_gap() {
        let svg = sample().to_svg("gap");
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
        let strokes: Vec<usize> = elements(&svg)
            .filter(|line| line.contains("class=\"line") && line.contains("clip-path"))
            .map(|line| line.matches('M').count())
            .collect();
        assert_eq!(strokes, [2, 2]);
        let dots = elements(&svg).find(|element| element.contains("class=\"dot")).unwrap();
        assert_eq!(dots.matches('M').count(), 2);
    }

    /// Catches: a marker outside the plot, over the axis labels; a line without a clip path.
    #[test]
    fn what_is_outside_the_range_is_not_drawn() {
        let chart =
            Chart::new(Axis::linear("x").range(0.0, 1.0), Axis::linear("y").range(0.0, 1.0))
                .series("", Style::numbered(0), [(0.5, 0.5), (0.6, 7.0), (1e300, -1e300)]);
        let svg = Figure::new("t", "d").panel(chart).to_svg("x");
        let dots: Vec<&str> =
            elements(&svg).filter(|element| element.contains("class=\"dot")).collect();
        assert_eq!((dots.len(), dots[0].matches('M').count()), (1, 1));
        assert!(
            svg.contains("clip-path=\"url(#fig-x-clip-0)\"") && svg.contains("id=\"fig-x-clip-0\"")
        );
    }

    /// Catches: a label that hides a curve though there is free room beside it.
    #[test]
    fn labels_avoid_the_data() {
        let flat = |y: f64| (0..=10).map(move |i| (f64::from(i), y));
        let chart =
            Chart::new(Axis::linear("x").range(0.0, 10.0), Axis::linear("y").range(0.0, 10.0))
                .series("", Style::REFERENCE, flat(5.2))
                .note(5.0, 5.0, "limit");
        let svg = Figure::new("t", "d").panel(chart).to_svg("x");
        let y = |tag: &str, cut: &str| -> f64 {
            let line = svg.lines().find(|line| line.contains(tag)).unwrap();
            line.split(cut).nth(1).unwrap().split(['"', 'l']).next().unwrap().parse().unwrap()
        };
        // The point is 6 units below the curve, and the letters of the label are 15 high.
        assert!(y("halo\" x", " y=\"") > y("class=\"line\"", ",") + 6.0 + 15.0);
    }

    /// Catches: a legend that is asked for and comes below the first chart, or twice; a label that
    /// stands at the end of its line as well.
    #[test]
    fn a_legend_stands_above_the_first_chart_if_asked() {
        let chart = |last: f64| {
            Chart::new(Axis::linear("x"), Axis::linear("y"))
                .series("rising", Style::numbered(0).line_only(), [(0.0, 0.0), (1.0, last)])
                .series("level", Style::numbered(1).line_only(), [(0.0, 9.0), (1.0, 9.0)])
        };
        let figure = Figure::new("t", "d").panel(chart(9.0)).panel(chart(1.0));
        let places = |svg: String| {
            let entry = svg.find(ENTRY).expect("a legend, or a label");
            (svg.matches(ENTRY).count(), entry < svg.find("<clipPath").expect("a chart"))
        };
        assert_eq!(places(figure.to_svg("x")), (4, false));
        assert_eq!(places(figure.with_legend().to_svg("x")), (2, true));
    }

    /// Catches: an empty figure or chart that panics.
    #[test]
    fn nothing_is_drawn_without_a_panic() {
        let svg = Figure::new("", "").to_svg("");
        assert!(svg.ends_with("</svg>\n"));
        let empty = Chart::new(Axis::log(""), Axis::linear("")).series("", Style::numbered(9), []);
        assert!(Figure::new("", "").panel(empty).to_svg("").contains("class=\"axis\""));
    }
}
