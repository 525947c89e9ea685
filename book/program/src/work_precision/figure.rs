//! The work–precision figure.

use pendula::METHODS;
use pendula_study::charts::{Axis, Chart, Figure, Style};

use super::{Curve, Measured, Problem, SCENES, front};

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
        let (info, line) = (method.info(), front::line(points, 1));
        chart = match (info.name, points.last()) {
            // What a reader knows, for comparison.
            ("rk4", Some(last)) => {
                chart.series("", Style::REFERENCE, line).note(last.seconds, last.error, info.title)
            }
            _ => chart.background(info.title, line),
        };
    }
    for part in front::of(&curves) {
        let title = part.method.info().title;
        let index = METHODS.iter().position(|method| method.info().title == title);
        let style = Style::numbered(index.unwrap_or(0)).line_only().solid().bold();
        let middle = part.middle();
        chart = chart.series("", style, part.points);
        if let Some((seconds, error)) = middle {
            chart = chart.note(seconds, error, title);
        }
    }
    chart
}

#[cfg(test)]
mod tests {
    use super::super::{Curve, Measurement};
    use super::*;

    fn measured() -> Measured {
        let point = |k: i32| Measurement {
            dt: 0.25 * 0.5_f64.powi(k),
            steps: 400 << k,
            error: 0.25_f64.powi(k),
            seconds: 1e-6 * 2.0_f64.powi(k),
        };
        let points: Vec<Measurement> = (1..5).map(point).collect();
        let curve = |scene| METHODS.iter().map(move |method| (scene, *method));
        let curves = SCENES.into_iter().flat_map(curve);
        let curves = curves.map(|(scene, method)| Curve { scene, method, points: points.clone() });
        Measured { instructions: "an abacus", curves: curves.collect() }
    }

    /// Catches: a scene or a method left out, a machine not named, a figure that the book cannot
    /// include.
    #[test]
    fn the_figure_shows_every_method_on_every_scene() {
        let svg = svg(&measured());
        let axes = svg.lines().filter(|line| line.contains("class=\"axis\"")).count();
        assert_eq!(axes, SCENES.len());
        for method in METHODS {
            assert!(svg.contains(method.info().title));
        }
        assert!(svg.contains("run time (s), an abacus") && !svg.contains("\n\n"));
    }
}
