//! The work–precision figure, with the front of each scene: what no other method reaches sooner.

use pendula_study::charts::{Axis, Chart, Figure};
use pendula_study::experiments::MethodRef;
use pendula_study::report::figures::style;

use super::{Curve, Measured, Measurement, Problem, SCENES};

/// The figure: a chart for each scene, with the same time axis.
pub fn svg(measured: &Measured) -> String {
    let times = || measured.curves.iter().flat_map(|curve| &curve.points).map(|p| p.seconds);
    // Room for the names of those that lead, which stand to the left of them.
    let shortest = times().fold(f64::INFINITY, f64::min) / 8.0;
    let longest = times().fold(0.0, f64::max) * 1.5;
    let label = format!("run time (s), {}", measured.instructions);
    let figure = Figure::new(
        "Run time against error",
        format!(
            "A chart for each of three scenes, both axes logarithmic: the error at the end over \
             the time a run took, on {}. A thin line for each method, and a plain one for RK4; \
             wide coloured ones with names along the lower left edge of all lines, where no method \
             reaches an error sooner. The higher a method's order, the more steeply its line \
             falls, so that those of higher order lead towards smaller errors; RK4's is to the \
             right of them.",
            measured.instructions
        ),
    );
    let charts = SCENES
        .iter()
        .map(|scene| chart(measured, scene, Axis::log(label.as_str()).range(shortest, longest)));
    charts.fold(figure, Figure::panel).to_svg("work-precision")
}

fn chart(measured: &Measured, scene: &Problem, time: Axis) -> Chart {
    let Problem { theta0, duration } = scene;
    let error = Axis::log(format!("error (rad) after {duration} s from {theta0} rad"));
    let mut chart = Chart::new(time, error).height(270.0);
    let curves: Vec<&Curve> =
        measured.curves.iter().filter(|curve| curve.scene == *scene).collect();
    for Curve { method, points, .. } in &curves {
        let (info, line) = (method.info(), line(points, 1));
        chart =
            match (info.name, points.last()) {
                // What a reader knows, for comparison.
                ("rk4", Some(last)) => chart
                    .series("", style(*method).line_only().solid(), line)
                    .note(last.seconds, last.error, info.title),
                _ => chart.background(info.title, line),
            };
    }
    for part in front(&curves) {
        let title = part.method.info().title;
        let style = style(part.method).line_only().solid().bold();
        let middle = part.middle();
        chart = chart.series("", style, part.points);
        if let Some((seconds, error)) = middle {
            chart = chart.note(seconds, error, title);
        }
    }
    chart
}

/// Parts between two steps of a curve, at whose ends it is compared with the others.
const BETWEEN: u32 = 24;

/// A method's part of the front: times (s) and errors (rad), with a gap (NaN) where another is
/// ahead.
#[derive(Clone, Debug)]
struct Part {
    method: MethodRef,
    /// From the longest steps to the shortest.
    points: Vec<(f64, f64)>,
}

/// The front of the curves of one scene, method by method. A point belongs to it if no curve has
/// one that is as exact and as quick, and better in either; between two steps a curve is taken to
/// be a power law.
fn front(curves: &[&Curve]) -> Vec<Part> {
    let dense: Vec<Vec<(f64, f64)>> =
        curves.iter().map(|curve| line(&curve.points, BETWEEN)).collect();
    let is_ahead = |point: &(f64, f64)| {
        let is_behind = |other: &(f64, f64)| other.0 <= point.0 && other.1 <= point.1;
        !point.0.is_nan() && dense.iter().flatten().all(|other| other == point || !is_behind(other))
    };
    let parts = curves.iter().zip(&dense).filter_map(|(curve, points)| {
        let gap = (f64::NAN, f64::NAN);
        let points = points.iter().map(|point| if is_ahead(point) { *point } else { gap });
        let points: Vec<(f64, f64)> = points.collect();
        let has_length = points.windows(2).any(|pair| !pair[0].0.is_nan() && !pair[1].0.is_nan());
        has_length.then_some(Part { method: curve.method, points })
    });
    parts.collect()
}

impl Part {
    /// The middle of its longest piece, for a label.
    fn middle(&self) -> Option<(f64, f64)> {
        let pieces = self.points.split(|point| point.0.is_nan());
        let longest = pieces.rev().max_by_key(|piece| piece.len())?;
        longest.get(longest.len() / 2).copied()
    }
}

/// Times and errors along a curve, with so many `parts` between two points and a gap (NaN) where
/// steps between them do not count.
fn line(points: &[Measurement], parts: u32) -> Vec<(f64, f64)> {
    let at = |point: &Measurement| (point.seconds, point.error);
    let mut line: Vec<(f64, f64)> = points.iter().take(1).map(at).collect();
    for pair in points.windows(2) {
        let (a, b) = (at(&pair[0]), at(&pair[1]));
        if pair[1].steps != 2 * pair[0].steps {
            line.push((f64::NAN, f64::NAN));
        } else {
            let between = (1..parts).map(|k| {
                let share = f64::from(k) / f64::from(parts);
                let of = |a: f64, b: f64| a * libm::pow(b / a, share);
                (of(a.0, b.0), of(a.1, b.1))
            });
            line.extend(between);
        }
        line.push(b);
    }
    line
}

#[cfg(test)]
mod tests {
    use pendula::METHODS;

    use super::*;

    /// A curve of a method through these times (s) and errors (rad), step by halved step.
    fn curve(method: usize, points: &[(f64, f64)]) -> Curve {
        let point = |(k, &(seconds, error)): (usize, &(f64, f64))| Measurement {
            dt: 0.5_f64.powi(k as i32),
            steps: 1 << k,
            error,
            rounding: 0.0,
            seconds,
        };
        let points = points.iter().enumerate().map(point).collect();
        Curve { scene: SCENES[0], method: METHODS[method], points }
    }

    fn ends(part: &Part) -> ((f64, f64), (f64, f64)) {
        let mut there = part.points.iter().copied().filter(|point| !point.0.is_nan());
        let first = there.next().unwrap();
        (first, there.next_back().unwrap_or(first))
    }

    /// A slow start and a steep fall, against a quick start and a slow fall; they cross at a time
    /// of 10⁻² and an error of 10⁻². A third is behind both.
    ///
    /// Catches: a method left out that leads somewhere, one that leads nowhere, a part that goes on
    /// behind the crossing, the later of two points taken for the better.
    #[test]
    fn each_leads_on_its_side_of_the_crossing() {
        let flat = curve(0, &[(1e-4, 1e-1), (1.0, 1e-3)]);
        let steep = curve(1, &[(1e-3, 1.0), (1e-1, 1e-4)]);
        let behind = curve(2, &[(2e-3, 1.0), (2.0, 1e-2)]);
        let front = front(&[&flat, &steep, &behind]);
        let [first, second] = &front[..] else { panic!("{front:?}") };
        assert_eq!(
            [first, second].map(|part| part.method.info().name),
            [METHODS[0].info().name, METHODS[1].info().name]
        );
        let ((a, b), (c, d)) = (ends(first), ends(second));
        assert_eq!((a, d), ((1e-4, 1e-1), (1e-1, 1e-4)));
        // To within a twenty-fourth of a curve, which is a factor of 10^(4/24) in time.
        for crossing in [b, c] {
            assert!(libm::log10(crossing.0 / 1e-2).abs() < 0.2, "{crossing:?}");
        }
        let middle = first.middle().unwrap();
        assert!(a.0 < middle.0 && middle.0 < b.0, "{middle:?}");
    }

    /// Catches: a gap that is bridged, a curve that is its own rival, a single point drawn as a
    /// line.
    #[test]
    fn one_curve_is_the_front() {
        let mut alone = curve(0, &[(1.0, 1e-1), (2.0, 1e-2), (4.0, 1e-3), (8.0, 1e-4)]);
        let part = &front(&[&alone])[0];
        assert_eq!(part.points, line(&alone.points, BETWEEN));
        assert_eq!(part.points.len(), 3 * BETWEEN as usize + 1);
        alone.points.remove(1);
        let part = &front(&[&alone])[0];
        assert_eq!(part.points.iter().filter(|point| point.0.is_nan()).count(), 1);
        assert!(front(&[&curve(0, &[(1.0, 1.0)])]).is_empty() && front(&[]).is_empty());
    }
}
