//! How the width of a proved enclosure grows.

use super::Drawing;
use crate::charts::{Axis, Chart, Figure, Style};
use crate::experiments::Study;
use crate::experiments::enclosure::{self, Shape};

pub(super) const FIGURES: &[Drawing] = &[Drawing {
    name: "widths",
    caption: "The width of what is proved of the angle, from rest at 1 rad. If each step hands on \
              a box along the axes, the next one has to enclose a turned box by a larger one, and \
              the width grows exponentially. Rectangles that turn with the motion grow as the \
              square of time, along the guide.",
    draw: widths,
}];

/// Widths of the bounds of the angle against time, for both shapes.
fn widths(_: &Study) -> Figure {
    let series = |shape| enclosure::widths(shape);
    let chart = Chart::new(
        Axis::log("t (s)").range(0.2, 60.0),
        Axis::log("width of the bounds of θ (rad)"),
    )
    .series("rectangles, turned", Style::series(0).line_only(), series(Shape::Turned))
    .series("boxes", Style::series(1).line_only(), series(Shape::Box))
    .slope(2.0, (2.0, 1e-12), 40.0, "slope 2");
    Figure::new(
        "The width of an enclosure",
        "The width of the bounds of the angle against time, both axes logarithmic, from some \
         10⁻¹⁵ radians at a quarter of a second. One line, of boxes, bends upwards and leaves the \
         chart at a tenth of a radian after 15 seconds. The other, of turned rectangles, jagged, \
         rises along a guide of slope two to some 10⁻¹⁰ radians after 50 seconds.",
    )
    .panel(chart)
}
