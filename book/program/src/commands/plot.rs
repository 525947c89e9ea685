//! `--plot`: the rows as a picture, in a file or in the terminal, in constant memory.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use clap::Args;
use pendula_charts::{Axis, Chart, Figure, Style};

use super::output::{Destination, Stream};
use crate::colour;
use crate::output::failure::Failure;

/// Where the rows are drawn.
#[derive(Args, Debug)]
pub struct PlotArguments {
    /// Also draw the rows, as an SVG in this file, or with - in the terminal, in place of the rows
    #[arg(long, value_name = "FILE.svg|-")]
    plot: Option<PathBuf>,
}

/// What one panel of a plot shows.
#[derive(Clone, Copy, Debug)]
pub struct Panel {
    /// What is on its y axis, with its unit.
    label: &'static str,
    /// The columns of the rows, each with the name of its line, empty if it is the only one.
    columns: &'static [(usize, &'static str)],
    /// Whether it is the change since the first row.
    since_the_start: bool,
    log: bool,
}

impl Panel {
    /// A panel of these columns.
    pub const fn new(label: &'static str, columns: &'static [(usize, &'static str)]) -> Self {
        Self { label, columns, since_the_start: false, log: false }
    }

    /// The same with the changes since the first row.
    pub const fn since_the_start(self) -> Self {
        Self { since_the_start: true, ..self }
    }

    /// The same with a logarithmic axis.
    pub const fn logarithmic(self) -> Self {
        Self { log: true, ..self }
    }

    /// Whether rows of `count` columns have those that it shows.
    pub const fn shows_only(&self, count: usize) -> bool {
        let mut shown = 0;
        while shown < self.columns.len() {
            if self.columns[shown].0 >= count {
                return false;
            }
            shown += 1;
        }
        true
    }
}

/// What is on the x axis.
#[derive(Clone, Copy, Debug)]
pub struct Across {
    /// The column of the rows.
    pub column: usize,
    /// What it is, with its unit.
    pub label: &'static str,
    /// Whether its axis is logarithmic.
    pub log: bool,
}

/// Time, the first column of every trajectory.
pub const TIME: Across = Across { column: 0, label: "t (s)", log: false };

/// What a plot shows, if it was asked for.
pub struct Drawing<'t> {
    pub asked: &'t PlotArguments,
    pub title: &'t str,
    pub across: Across,
    pub panels: &'static [Panel],
    /// Whether a summary comes on standard error.
    pub summary: bool,
}

/// A plot that is being drawn.
pub struct Plot<'o> {
    /// A file, or the caller's writer for the terminal.
    out: Destination<'o>,
    across: Across,
    title: String,
    panels: &'static [Panel],
    /// One for each line: those of the first panel, then those of the next.
    lines: Vec<Thinned>,
    first: Option<Vec<f64>>,
}

impl Drawing<'_> {
    /// The plot, if it was asked for, and where the rows go: to the file `output`, or else to
    /// `out`, unless the plot stands there in their place.
    pub fn begin<'o>(
        self,
        output: Option<&Path>,
        out: &'o mut dyn Write,
    ) -> Result<(Option<Plot<'o>>, Destination<'o>), Failure> {
        let Self { asked, title, across, panels, summary } = self;
        let rows = output.map(|path| Destination::file("--output", path)).transpose()?;
        let (plot, rows) = match (&asked.plot, rows) {
            (None, rows) => (None, rows.unwrap_or(Destination::Caller(out))),
            (Some(path), rows) if path.as_os_str() == "-" => {
                (Some(Destination::Caller(out)), rows.unwrap_or(Destination::Nowhere))
            }
            (Some(path), rows) => {
                let plot = Destination::file("--plot", path)?;
                (Some(plot), rows.unwrap_or(Destination::Caller(out)))
            }
        };
        let files = [("--output", Some(&rows)), ("--plot", plot.as_ref())];
        let files = || files.iter().filter_map(|(option, file)| Some((*option, (*file)?)));
        let prints = files().any(|(_, file)| matches!(file, Destination::Caller(_)));
        for (stream, is_written) in [(Stream::Output, prints), (Stream::Error, summary)] {
            for (option, file) in files().filter(|_| is_written) {
                file.apart_from(option, stream)?;
            }
        }
        let Some(plot) = plot else { return Ok((None, rows)) };
        if let (Some(rows), Some(plot)) = (rows.target(), plot.target())
            && rows == plot
        {
            let (plot, name) = (plot.display(), "--plot and --output");
            return Err(Failure::refused(format!("{name}: both cannot be written to {plot}")));
        }
        let lines = panels.iter().flat_map(|panel| panel.columns).map(|_| Thinned::default());
        let (title, lines) = (capital(title), lines.collect());
        Ok((Some(Plot { out: plot, across, title, panels, lines, first: None }), rows))
    }
}

impl<'o> Plot<'o> {
    /// Adds a row.
    pub fn add(&mut self, row: &[f64]) {
        let first = self.first.get_or_insert_with(|| row.to_vec());
        let mut lines = self.lines.iter_mut();
        for panel in self.panels {
            for (&(column, _), line) in panel.columns.iter().zip(&mut lines) {
                let from = if panel.since_the_start { first[column] } else { 0.0 };
                line.add(row[self.across.column], row[column] - from);
            }
        }
    }

    /// Writes the picture, to the terminal as text and to a file as SVG, and returns what it was
    /// written to, which is to be [finished](Destination::finish).
    pub fn written(mut self) -> Result<Destination<'o>, Failure> {
        let mut picture = Vec::new();
        match self.out {
            Destination::Caller(_) => self.write_text(&mut picture)?,
            _ => picture.extend_from_slice(self.figure().to_file("plot").as_bytes()),
        }
        self.out.write_all(&picture)?;
        Ok(self.out)
    }

    /// Each panel with its lines.
    fn drawn(&self) -> impl Iterator<Item = (&Panel, &[Thinned])> {
        let mut rest = &self.lines[..];
        self.panels.iter().map(move |panel| {
            let (lines, others) = rest.split_at(panel.columns.len());
            rest = others;
            (panel, lines)
        })
    }

    fn figure(&self) -> Figure {
        let axis = |label: &str, log| if log { Axis::log(label) } else { Axis::linear(label) };
        let Across { label, log, .. } = self.across;
        let figure = Figure::new(&self.title, self.description());
        self.drawn().fold(figure, |figure, (panel, lines)| {
            let chart = Chart::new(axis(label, log), axis(panel.label, panel.log)).height(220.0);
            let lines = panel.columns.iter().zip(lines).enumerate();
            figure.panel(lines.fold(chart, |chart, (index, ((_, name), line))| {
                // Thousands of points: a dash for each line, and markers where they are few.
                let style = Style::series(index);
                let few = line.points().count() <= 40;
                let style = if few { style } else { style.line_only() };
                chart.series(*name, style, line.points())
            }))
        })
    }

    /// What the picture shows, in words.
    fn description(&self) -> String {
        let across = plain(self.across.label);
        let panels = self.drawn().map(|(panel, lines)| {
            let (low, high) = ends(lines.iter().flat_map(Thinned::points).map(|point| point.1));
            format!("{} between {} and {}", plain(panel.label), short(low), short(high))
        });
        let panels: Vec<String> = panels.collect();
        let points = || self.lines.iter().flat_map(Thinned::points);
        let (from, to) = ends(points().map(|point| point.0));
        format!("Over {across} from {} to {}: {}.", short(from), short(to), panels.join("; "))
    }

    fn write_text(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "{}", colour::output(colour::HEAD, &self.title))?;
        let Across { label, log, .. } = self.across;
        for (panel, lines) in self.drawn() {
            for ((_, name), line) in panel.columns.iter().zip(lines) {
                let comma = if name.is_empty() { "" } else { ", " };
                let (name, label) = (plain(name), plain(panel.label));
                writeln!(out, "\n{name}{comma}{label}{}", logarithmic(panel.log))?;
                let points: Vec<(f64, f64)> = line.points().collect();
                draw_in_braille(&points, [log, panel.log], out)?;
            }
        }
        let (from, to) = ends(self.lines.iter().flat_map(Thinned::points).map(|point| point.0));
        let (label, from, to) = (plain(label), short(from), short(to));
        writeln!(out, "{label}{} from {from} to {to}", logarithmic(log))
    }
}

/// The title with a capital.
fn capital(title: &str) -> String {
    let mut letters = title.chars();
    let first: String = letters.next().into_iter().flat_map(char::to_uppercase).collect();
    first + letters.as_str()
}

const fn logarithmic(log: bool) -> &'static str {
    if log { ", logarithmic" } else { "" }
}

/// The least and the largest.
fn ends(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
}

/// A label without the marks for subscripts.
fn plain(label: &str) -> String {
    label.replace("_{0}", "₀").replace("_{1}", "₁").replace("_{2}", "₂")
}

/// A number in a few digits.
fn short(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        size if (1e-3..1e4).contains(&size) => {
            let text = format!("{value:.4}");
            text.trim_end_matches('0').trim_end_matches('.').to_owned()
        }
        _ => format!("{value:.3e}"),
    }
}

/// Characters of a picture in the terminal, across and down.
const SIZE: (usize, usize) = (64, 10);

/// Draws the line through `points`, with the ends of its y axis on the left. `log` says which of
/// the axes are logarithmic; what has no place there leaves a gap.
fn draw_in_braille(points: &[(f64, f64)], log: [bool; 2], out: &mut dyn Write) -> io::Result<()> {
    let place = |value: f64, log: bool| match log {
        true if value > 0.0 => libm::log10(value),
        true => f64::NAN,
        false => value,
    };
    let placed: Vec<(f64, f64)> =
        points.iter().map(|&(x, y)| (place(x, log[0]), place(y, log[1]))).collect();
    let shown = || placed.iter().filter(|(x, y)| x.is_finite() && y.is_finite());
    let (left, right) = ends(shown().map(|point| point.0));
    let (bottom, top) = ends(shown().map(|point| point.1));
    let (width, height) = (2 * SIZE.0, 4 * SIZE.1);
    let dot = |value: f64, low: f64, high: f64, dots: usize| {
        let share = if high > low { (value - low) / (high - low) } else { 0.5 };
        (share * (dots - 1) as f64).round() as i64
    };
    let mut canvas = vec![vec![0_u8; SIZE.0]; SIZE.1];
    let mut set = |x: i64, y: i64| {
        let (x, y) = (x as usize, height - 1 - y as usize);
        // The bits of a character's dots: the lowest row came later, and has the highest.
        let bit = [[0, 3], [1, 4], [2, 5], [6, 7]][y % 4][x % 2];
        canvas[y / 4][x / 2] |= 1 << bit;
    };
    let mut before: Option<(i64, i64)> = None;
    for &(x, y) in &placed {
        if !(x.is_finite() && y.is_finite()) {
            before = None;
            continue;
        }
        let here = (dot(x, left, right, width), dot(y, bottom, top, height));
        let (from_x, from_y) = before.unwrap_or(here);
        let (dx, dy) = (here.0 - from_x, here.1 - from_y);
        let steps = dx.abs().max(dy.abs()).max(1);
        for step in 0..=steps {
            let along = |from: i64, by: i64| from + (2 * by * step + steps).div_euclid(2 * steps);
            set(along(from_x, dx), along(from_y, dy));
        }
        before = Some(here);
    }
    let end =
        |value: f64, log: bool| if log { short(libm::pow(10.0, value)) } else { short(value) };
    let (low, high) = match shown().next() {
        Some(_) => (end(bottom, log[1]), end(top, log[1])),
        None => (String::new(), String::new()),
    };
    let margin = low.len().max(high.len());
    for (row, cells) in canvas.iter().enumerate() {
        let label = match row {
            0 => high.as_str(),
            _ if row == SIZE.1 - 1 => low.as_str(),
            _ => "",
        };
        let cells: String = cells
            .iter()
            .map(|&dots| char::from_u32(0x2800 + u32::from(dots)).unwrap_or(' '))
            .collect();
        writeln!(out, "{label:>margin$} ┤{cells}")?;
    }
    Ok(())
}

/// A line of any number of points, thinned to a few that look the same: of groups of neighbours the
/// lowest and the highest point are kept. A line through them covers what the line through all
/// would cover, to the width of a group.
#[derive(Debug, Default)]
struct Thinned {
    groups: Vec<Group>,
    /// Points in a group, a power of two; 0 before the first.
    size: u64,
    /// Points so far.
    count: u64,
    last: Option<(f64, f64)>,
}

/// More than a plot has pixels across, when they are halved.
const MOST: usize = 2048;

#[derive(Clone, Copy, Debug)]
struct Group {
    low: Point,
    high: Point,
}

#[derive(Clone, Copy, Debug)]
struct Point {
    /// Which point it is, in the order of the line.
    n: u64,
    x: f64,
    y: f64,
}

impl Group {
    fn with(self, other: Self) -> Self {
        Self {
            low: if other.low.y < self.low.y { other.low } else { self.low },
            high: if other.high.y > self.high.y { other.high } else { self.high },
        }
    }
}

impl Thinned {
    /// Adds the next point.
    fn add(&mut self, x: f64, y: f64) {
        let point = Point { n: self.count, x, y };
        let group = Group { low: point, high: point };
        self.size = self.size.max(1);
        if self.count.is_multiple_of(self.size) {
            if self.groups.len() == MOST {
                let pairs = self.groups.chunks(2);
                self.groups = pairs.map(|pair| pair[0].with(pair[pair.len() - 1])).collect();
                self.size *= 2;
            }
            self.groups.push(group);
        } else if let Some(last) = self.groups.last_mut() {
            *last = last.with(group);
        }
        self.count += 1;
        self.last = Some((x, y));
    }

    /// The points that are kept, in order; the last one of all among them.
    fn points(&self) -> impl Iterator<Item = (f64, f64)> {
        let kept = self.groups.iter().flat_map(|&Group { low, high }| {
            let (one, other) = if low.n <= high.n { (low, high) } else { (high, low) };
            let other = (other.n != one.n).then_some(other);
            [Some(one), other].into_iter().flatten()
        });
        let last = self.groups.last().map(|group| group.low.n.max(group.high.n));
        let end = self.last.filter(|_| last.is_some_and(|n| n + 1 < self.count));
        kept.map(|Point { x, y, .. }| (x, y)).chain(end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: memory that grows with the run; an extreme that is lost, or moved; points out of
    /// order; a line that ends before its last point.
    #[test]
    fn a_long_line_keeps_its_extremes_in_order() {
        let wave = |i: u32| (f64::from(i), f64::from(i.wrapping_mul(2_654_435_761) >> 8));
        for count in [1, 2, 2047, 2048, 2049, 5000, 1_000_000] {
            let mut line = Thinned::default();
            (0..count).for_each(|i| {
                let (x, y) = wave(i);
                line.add(x, y);
            });
            let points: Vec<(f64, f64)> = line.points().collect();
            assert!(points.len() <= 2 * MOST + 1, "{}", points.len());
            assert!(points.windows(2).all(|pair| pair[0].0 < pair[1].0));
            assert!(points.iter().all(|&(x, y)| wave(x as u32) == (x, y)));
            assert_eq!(points.last(), Some(&wave(count - 1)));
            if count <= MOST as u32 {
                assert_eq!(points.len(), count as usize);
            }
            // Of each thousandth of the line, the extremes are no further away than a group.
            let all: Vec<f64> = (0..count).map(|i| wave(i).1).collect();
            for highest in [true, false] {
                let best = |a: f64, b: f64| if highest { a.max(b) } else { a.min(b) };
                let all = all.iter().copied().reduce(best);
                assert_eq!(points.iter().map(|point| point.1).reduce(best), all);
            }
        }
    }
}
