//! Series to SVG: the charts of the book, in one visual language, with the same bytes everywhere.
//!
//! A [`Figure`] is one [`Chart`] or several, stacked or side by side. Its lines and markers carry
//! classes whose colours follow the book's theme, or the reader's preference where the SVG stands
//! alone.
//!
//! ```
//! use pendula_charts::{Axis, Chart, Figure, Style};
//!
//! let errors = [(0.1, 1.1e-1), (0.01, 1.1e-3), (0.001, 1.1e-5)];
//! let chart = Chart::new(Axis::log("Δt (s)"), Axis::log("energy error (J)"))
//!     .series("Störmer–Verlet", Style::numbered(2), errors)
//!     .slope(2.0, (0.01, 3e-4), 0.001, "slope 2");
//! let svg = Figure::new("Energy error against step", "On a log–log plot the errors fall by …")
//!     .panel(chart)
//!     .to_svg("convergence");
//! assert!(svg.starts_with("<svg") && !svg.contains("\n\n"));
//! ```
#![warn(clippy::disallowed_methods)]

mod axis;
mod chart;
mod ends;
mod figure;
mod labels;
mod path;
mod plot;
#[cfg(test)]
mod read_back;
mod regions;
mod style;
mod text;

pub use axis::{Axis, Tick};
pub use chart::{Chart, Series};
pub use figure::Figure;
pub use path::{Num, Point};
pub use regions::{Cell, Fill, Map, Name};
pub use style::{Style, area_of, style_sheet};
pub use text::{draw_text, escape, line, width, wrapped};

/// Room to the right of a plot, for half a tick label.
const RIGHT: f64 = 20.0;
/// Height of a line of text.
const ROW: f64 = 25.0;
/// Between a chart and what stands above it, where that is another chart.
const GAP: f64 = 10.0;
