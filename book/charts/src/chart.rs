//! A chart: its axes, series and marks.

use super::axis::{Axis, Scale};
use super::path::Point;
use super::regions::Map;
use super::style::Style;

/// Axes with series and marks, or a sketch without axes.
#[derive(Clone, Debug)]
pub struct Chart {
    /// The axis across.
    pub x: Axis,
    /// The axis upwards.
    pub y: Axis,
    pub(super) sketch: bool,
    /// The line of text above all else.
    pub heading: String,
    pub(super) height: f64,
    /// In the order in which they are drawn.
    pub series: Vec<Series>,
    pub(super) marks: Vec<Mark>,
    /// The regions behind the series.
    pub map: Option<Map>,
}

/// Points, and how they are drawn.
#[derive(Clone, Debug)]
pub struct Series {
    /// Its name in the legend, if it has one.
    pub label: String,
    /// Shown where a mouse rests on the line.
    pub(super) hover: String,
    /// How it is drawn.
    pub style: Style,
    /// In values of the axes.
    pub points: Vec<Point>,
}

impl Series {
    /// Whether it is named, in a legend or at its end.
    pub(super) fn has_label(&self) -> bool {
        !self.label.is_empty() && !self.style.is_guide() && !self.points.is_empty()
    }
}

#[derive(Clone, Debug)]
pub(super) enum Mark {
    /// A line of constant x.
    Vertical { at: f64, label: String },
    /// A text beside one of the points.
    Note { beside: Vec<(f64, f64)>, text: String },
}

impl Chart {
    /// An empty chart, 300 units high (600 are its width).
    pub const fn new(x: Axis, y: Axis) -> Self {
        Self {
            x,
            y,
            sketch: false,
            heading: String::new(),
            height: 300.0,
            series: Vec::new(),
            marks: Vec::new(),
            map: None,
        }
    }

    /// An empty sketch of what lies between these two values of x and of y: it has no axes, and one
    /// scale for both, so that a circle is round. Its height follows from its width.
    pub fn sketch(x: (f64, f64), y: (f64, f64)) -> Self {
        let side = |(low, high)| Axis::linear("").range(low, high);
        Self { sketch: true, ..Self::new(side(x), side(y)) }
    }

    /// With a line of text above all else, to tell the chart from its neighbours.
    pub fn heading(self, text: impl Into<String>) -> Self {
        Self { heading: text.into(), ..self }
    }

    /// The plot is this many units high, unless it is a sketch.
    pub fn height(self, units: f64) -> Self {
        Self { height: units, ..self }
    }

    /// With a series. Those of the same label share an entry of the legend, such as a line of
    /// theory and the markers on it; those with an empty label have none.
    ///
    /// Points that are not finite (or beyond 1e300), or not positive on a logarithmic axis, leave a
    /// gap. A line may have any number of points; of more than 40 only a few are marked.
    pub fn series(
        mut self,
        label: impl Into<String>,
        style: Style,
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        let points = points.into_iter().collect();
        self.series.push(Series { label: label.into(), hover: String::new(), style, points });
        self
    }

    /// With a thin line in the background that has no label, but names itself where a mouse rests
    /// on it.
    pub fn background(
        mut self,
        name: impl Into<String>,
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> Self {
        let (label, hover) = (String::new(), name.into());
        let points = points.into_iter().collect();
        self.series.push(Series { label, hover, style: Style::BACKGROUND, points });
        self
    }

    /// With a guide y ∝ xᵖ with p = `order` from the point `from` to x = `to`: on two logarithmic
    /// axes a straight line of that slope.
    pub fn slope(self, order: f64, from: (f64, f64), to: f64, label: impl Into<String>) -> Self {
        let end = (to, from.1 * libm::pow(to / from.0, order));
        self.series(label, Style::GUIDE, [from, end])
    }

    /// With a dashed line at `x`, labelled above the plot.
    pub fn vertical(mut self, x: f64, label: impl Into<String>) -> Self {
        self.marks.push(Mark::Vertical { at: x, label: label.into() });
        self
    }

    /// With a map, whose regions are named in it, and a legend of it below.
    pub fn map(self, map: Map) -> Self {
        Self { map: Some(map), ..self }
    }

    /// With a text beside the point (`x`, `y`), on the side where there is most room.
    pub fn note(self, x: f64, y: f64, text: impl Into<String>) -> Self {
        self.note_beside(vec![(x, y)], text)
    }

    /// With a text beside that of the points (x, y) where there is most room, the first of equals.
    pub fn note_beside(mut self, points: Vec<(f64, f64)>, text: impl Into<String>) -> Self {
        self.marks.push(Mark::Note { beside: points, text: text.into() });
        self
    }

    /// The scales, from the data and the vertical lines, but not from guides. Curves fill the x
    /// axis; the y axis ends at round numbers.
    pub(super) fn scales(&self) -> (Scale<'_>, Scale<'_>) {
        let series = || self.series.iter().filter(|series| !series.style.is_guide());
        let points = || series().flat_map(|series| &series.points);
        let lines = self.marks.iter().filter_map(|mark| match mark {
            Mark::Vertical { at, .. } => Some(*at),
            Mark::Note { .. } => None,
        });
        let xs = points().map(|p| p.0);
        let x = self.x.scale(xs.chain(lines), None);
        let ys = points().filter(|p| x.contains(p.0)).map(|p| p.1);
        let y = self.y.scale(ys, Some(self.y_ticks()));
        (x, y)
    }

    /// How high the plot is if it is `width` wide.
    pub(super) fn height_for(&self, width: f64) -> f64 {
        match (self.sketch, self.x.span().zip(self.y.span())) {
            (true, Some((x, y))) => width * y / x,
            _ => self.height,
        }
    }

    pub(super) fn y_ticks(&self) -> usize {
        (self.height / 45.0).clamp(2.0, 6.0) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: an axis that ends before a line across it; ticks that crowd a low plot.
    #[test]
    fn lines_stretch_an_axis() {
        let axis = Axis::linear;
        let plain = || {
            Chart::new(axis("x"), axis("y")).series("", Style::REFERENCE, [(0.0, 0.0), (2.0, 4.0)])
        };
        let ends = |chart: Chart| {
            let (x, y) = chart.scales();
            let reaches = |scale: &Scale, far: f64| [-far, far].map(|value| scale.contains(value));
            [reaches(&x, 3.0), reaches(&y, 30.0)]
        };
        let none = [[false; 2]; 2];
        assert_eq!(ends(plain()), none);
        assert_eq!(ends(plain().vertical(3.0, "")), [[false, true], [false; 2]]);
        assert_eq!(
            [50.0, 100.0, 200.0, 300.0, 900.0].map(|high| plain().height(high).y_ticks()),
            [2, 2, 4, 6, 6]
        );
    }
}
