//! `--plot`: the rows as a picture, in a file or in the terminal, in constant memory.

use std::io::{self, Write};
use std::path::PathBuf;

use clap::Args;
use pendula_charts::{Axis, Chart, Figure, Style};

use super::destination::Destination;
use crate::colour;
use pendula_output::failure::Failure;

mod braille;
mod thinned;

use thinned::Thinned;

/// Where the rows are drawn.
#[derive(Args, Debug)]
pub struct PlotArguments {
    /// Draw the rows too, as an SVG in this file; as - in the terminal, where they are then not
    /// printed
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
    /// The plot, if it was asked for, and where rows that have no file go: to `out`, unless the
    /// plot stands there in their place.
    pub fn begin<'o>(
        self,
        out: &'o mut dyn Write,
    ) -> Result<(Option<Plot<'o>>, Destination<'o>), Failure> {
        let Self { asked, title, across, panels } = self;
        let (out, rows) = match &asked.plot {
            None => return Ok((None, Destination::Caller(out))),
            Some(path) if path.as_os_str() == "-" => {
                (Destination::Caller(out), Destination::Nowhere)
            }
            Some(path) => (Destination::file("--plot", path)?, Destination::Caller(out)),
        };
        let lines = panels.iter().flat_map(|panel| panel.columns).map(|_| Thinned::default());
        let (title, lines) = (capital(title), lines.collect());
        Ok((Some(Plot { out, across, title, panels, lines, first: None }), rows))
    }
}

impl Plot<'_> {
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

    /// Writes the picture: to the terminal as text, to a file as SVG.
    pub fn finish(mut self) -> Result<(), Failure> {
        let mut picture = Vec::new();
        match self.out {
            Destination::Caller(_) => self.write_text(&mut picture)?,
            _ => picture.extend_from_slice(self.figure().to_file("plot").as_bytes()),
        }
        self.out.write_all(&picture)?;
        self.out.finish()
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
                let style = Style::numbered(index);
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
                braille::draw(&points, [log, panel.log], out)?;
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
