//! The labels inside a plot, each where it hides least.

use super::chart::Mark;
use super::path::Point;
use super::plot::Plot;
use super::text::{draw_text, width};

/// A place for a label: its anchor point, and which part of the text is there.
type Place = (Point, &'static str);

/// The labels inside the plot, each where it hides least.
pub(super) struct Labels<'a> {
    pub plot: &'a Plot<'a>,
    /// What is drawn there.
    pub strokes: Vec<Vec<Point>>,
    /// The labels already placed: left, top, right, bottom.
    pub taken: Vec<[f64; 4]>,
}

impl Labels<'_> {
    /// Draws the labels of guides, and the notes.
    pub fn draw(&mut self, out: &mut String) {
        let plot = self.plot;
        for series in plot.chart.series.iter().filter(|series| series.style.is_guide()) {
            let ends = plot.strokes(&series.points).concat();
            let Some((a, b)) = ends.first().zip(ends.last()) else {
                continue;
            };
            let middle = ((a.0 + b.0) / 2.0, (a.1 + b.1) / 2.0);
            self.place(out, &series.label, &[*b, *a, middle].map(beside).concat());
        }
        for mark in &plot.chart.marks {
            if let Mark::Note { beside: points, text } = mark {
                let pixels = points.iter().filter_map(|&point| plot.pixel(point));
                self.place(out, text, &pixels.flat_map(beside).collect::<Vec<_>>());
            }
        }
    }

    /// Draws the label at the best of the places; the first of equals.
    fn place(&mut self, out: &mut String, label: &str, places: &[Place]) {
        let extent = |&((x, y), anchor): &Place| {
            let w = width(label);
            let before = match anchor {
                "start" => 0.0,
                "middle" => w / 2.0,
                _ => w,
            };
            [x - before, y - 15.0, x - before + w, y + 5.0]
        };
        let best = places.iter().min_by_key(|place| self.crowding(extent(place)));
        if let Some(best) = best.filter(|_| !label.is_empty()) {
            self.taken.push(extent(best));
            draw_text(out, "halo", best.0, best.1, label);
        }
    }

    /// How much of what is drawn lies under the box; far more if it hides a label, and most if it
    /// leaves the plot.
    fn crowding(&self, [left, top, right, bottom]: [f64; 4]) -> usize {
        let Plot { left: l, right: r, top: t, bottom: b, .. } = *self.plot;
        let near = |p: Point| (p.0.clamp(l - 9.0, r + 9.0), p.1.clamp(t - 9.0, b + 9.0));
        let under = |(x, y): Point| (left..=right).contains(&x) && (top..=bottom).contains(&y);
        let segment = |a: Point, b: Point| {
            let (dx, dy) = (b.0 - a.0, b.1 - a.1);
            let samples = (dx.abs().max(dy.abs()) / 4.0).ceil().max(1.0);
            let at = move |i: u32| {
                let share = f64::from(i) / samples;
                (a.0 + share * dx, a.1 + share * dy)
            };
            (0..=samples as u32).filter(|&i| under(at(i))).count()
        };
        let stroke = |stroke: &Vec<Point>| -> usize {
            let first = stroke.first().filter(|&&p| under(p)).map_or(0, |_| 1);
            first + stroke.windows(2).map(|w| segment(near(w[0]), near(w[1]))).sum::<usize>()
        };
        let over = |o: &&[f64; 4]| left < o[2] && o[0] < right && top < o[3] && o[1] < bottom;
        let outside = left < l || right > r || top < t || bottom > b;
        self.strokes.iter().map(stroke).sum::<usize>()
            + 1_000 * self.taken.iter().filter(over).count()
            + if outside { 100_000 } else { 0 }
    }
}

/// The places around a point.
fn beside((x, y): Point) -> Vec<Place> {
    vec![
        ((x + 10.0, y + 6.0), "start"),
        ((x - 10.0, y + 6.0), "end"),
        ((x, y - 11.0), "middle"),
        ((x, y + 23.0), "middle"),
        ((x + 7.0, y - 8.0), "start"),
        ((x - 7.0, y - 8.0), "end"),
        ((x + 7.0, y + 20.0), "start"),
        ((x - 7.0, y + 20.0), "end"),
    ]
}

#[cfg(test)]
mod tests {
    use super::super::plot::tests::{PLACE, chart, with_plot};
    use super::*;

    /// Catches: a second label on the first.
    #[test]
    fn two_notes_on_a_point_stand_on_either_side() {
        let mut out = String::new();
        with_plot(&chart("").note(256.0, 128.0, "a").note(256.0, 128.0, "b"), PLACE, |plot| {
            Labels { plot, strokes: Vec::new(), taken: Vec::new() }.draw(&mut out);
        });
        let mut expected = String::new();
        draw_text(&mut expected, "halo", (330.0, 134.0), "start", "a");
        draw_text(&mut expected, "halo", (310.0, 134.0), "end", "b");
        assert_eq!(out, expected);
    }

    /// Catches: a label drawn on another, or kept away from one that it only touches.
    #[test]
    fn a_label_on_another_is_a_thousand_strokes() {
        let crowding = |taken: &[[f64; 4]]| {
            with_plot(&chart(""), PLACE, |plot| {
                let labels = Labels { plot, strokes: Vec::new(), taken: taken.to_vec() };
                labels.crowding([200.0, 100.0, 300.0, 120.0])
            })
        };
        let touching = [
            [100.0, 90.0, 200.0, 130.0],
            [300.0, 90.0, 400.0, 130.0],
            [190.0, 80.0, 310.0, 100.0],
            [190.0, 120.0, 310.0, 140.0],
        ];
        let over = [[190.0, 90.0, 210.0, 110.0], [290.0, 110.0, 310.0, 130.0]];
        assert_eq!(crowding(&touching), 0);
        assert_eq!(
            [crowding(&over[..1]), crowding(&over[1..]), crowding(&over)],
            [1000, 1000, 2000]
        );
    }

    /// Catches: a stroke weighed by its length outside the plot, or not weighed up to its edge.
    #[test]
    fn strokes_weigh_by_what_is_in_the_plot() {
        // Each goes from 9 within the edge to far beyond, of which 9 count, and 120 along it: 31
        // samples, the sixteenth on the edge; and one for where it begins.
        let strokes = [
            [(73.0, 60.0), (-5e3, 180.0)],
            [(567.0, 60.0), (5e3, 180.0)],
            [(200.0, 9.0), (320.0, -5e3)],
            [(200.0, 247.0), (320.0, 5e3)],
        ];
        for stroke in strokes {
            let crowding = with_plot(&chart(""), PLACE, |plot| {
                let strokes = vec![stroke.to_vec()];
                Labels { plot, strokes, taken: Vec::new() }.crowding([64.0, 0.0, 576.0, 256.0])
            });
            assert_eq!(crowding, 17, "{stroke:?}");
        }
    }
}
