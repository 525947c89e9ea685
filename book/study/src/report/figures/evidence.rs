//! What cancelling errors, the reading of the period, chaos and rounding do to measurements, and
//! what long runs show: resonances of the step, how many terms of a modified energy's series are
//! best, and how the width of a proved enclosure grows.

use core::f64::consts::PI;

use pendula::Pendulum;

use super::{named, of_the_paper, style, title};
use crate::charts::{Axis, Chart, Figure, Style};
use crate::experiments::enclosure::{self, Shape};
use crate::experiments::{
    STEPS, Study, large_angle, resonance, rounding_walk, small_angle, standard_map, truncation,
};
use crate::theory;

/// Störmer–Verlet's error and the formula's: where they cancel, its errors in the paper's table
/// are smallest.
pub(super) fn cancellation(study: &Study, figure: Figure) -> Figure {
    let (pendulum, verlet) = (Pendulum::PAPER, named("stormer-verlet"));
    let (theta_0, duration) = (small_angle::THETA_0, small_angle::DURATION);
    let own = |h| theory::small_angle::own_error_of_stormer_verlet(&pendulum, theta_0, h, duration);
    let floor = theory::small_angle::floor(&pendulum, theta_0, duration);
    let ends = [STEPS[0], STEPS[STEPS.len() - 1]];
    let ladder = small_angle::ladder(verlet);
    let truth = of_the_paper(&study.small_angle, |row| row.method)
        .filter(|row| title(row.method) == title(verlet))
        .flat_map(|row| STEPS.into_iter().zip(row.errors.map(|errors| errors.truth)));
    let chart = Chart::new(Axis::log("Δt (s)"), Axis::log("RMS angle error (rad)"))
        .vertical(theory::small_angle::cancelling_step(&pendulum, theta_0), "θ_{0}√(3/2)/ω_{0}")
        .series("the method's own, by theory", Style::REFERENCE.dashed(), ends.map(|h| (h, own(h))))
        .series("the formula's own, by theory", Style::REFERENCE, ends.map(|h| (h, floor)))
        .series(
            "measured against the formula",
            style(verlet).line_only().solid(),
            ladder.iter().map(|(h, errors)| (*h, errors.formula)),
        )
        .series("measured against the truth", style(verlet).markers_only(), truth);
    figure.panel(chart)
}

/// The error of the period by the five ways of reading it, from RK4's samples and from the exact
/// motion's.
pub(super) fn five_periods(_: &Study, figure: Figure) -> Figure {
    let axes = |samples| {
        let error = Axis::log(format!("error of the period (s), {samples}")).range(1e-16, 1.0);
        Chart::new(Axis::log("h (s)").range(8e-5, 0.14), error)
    };
    // Where the two best coincide, one is seen inside the other.
    let look = |reading: &str, i| match reading {
        "Hermite's cubic" => Style::series(i).solid().bold(),
        "Hénon's step" => Style::series(i).dashed(),
        _ => Style::series(i),
    };
    let draw = |chart: Chart, ladder: &[large_angle::Errors]| {
        large_angle::READINGS.into_iter().enumerate().fold(chart, |chart, (i, reading)| {
            let line = ladder.iter().map(|errors| (errors.step, errors.by[i]));
            chart.series(reading, look(reading, i), line)
        })
    };
    // RK4's error of the period is known: a term in h⁴, and one in h⁵ from the energy lost.
    let own = (0..=60).map(|k| 2e-4 * libm::exp10(f64::from(k) / 30.0));
    let own = own.map(|h| {
        let terms = theory::rk4::period_error_terms(&Pendulum::PAPER, large_angle::THETA_0, h);
        (h, terms.iter().sum::<f64>().abs())
    });
    let own: Vec<_> = own.collect();
    let beginning = own[0];
    let rk4 = axes("read off RK4’s samples")
        .series("", style(named("rk4")).line_only(), own)
        .note(beginning.0, beginning.1, "RK4’s own, by theory")
        .note(4e-3, 3e-10, "Hénon’s on Hermite’s line");
    let exact = axes("read off the exact motion")
        .slope(1.0, (0.1, 0.2), 1e-4, "slope 1")
        .slope(3.0, (0.1, 1e-2), 2e-4, "slope 3")
        .slope(5.0, (0.1, 1e-7), 5e-3, "slope 5");
    figure
        .with_legend()
        .panel(draw(rk4, &large_angle::of_rk4()))
        .panel(draw(exact, &large_angle::of_the_exact_motion()))
}

/// Phase portraits of symplectic Euler as the standard map.
pub(super) fn standard_map(_: &Study, figure: Figure) -> Figure {
    let method = named("symplectic-euler");
    let turn = |label: String| {
        Axis::linear(label).range(-PI, PI).ticks([(-PI, "−π"), (0.0, "0"), (PI, "π")])
    };
    let portrait = |k: f64| {
        let mut chart = Chart::new(turn("θ (rad)".into()), turn("u = hω (rad a step)".into()))
            .height(250.0)
            .heading(format!("K = {k}, h = {:.3} s", standard_map::step(k)));
        let golden = standard_map::golden(k);
        if !golden.escapes {
            let mirrored = golden.points.iter().map(|(theta, u)| (-theta, -u));
            let label = "the last curve to break";
            chart = chart.series(label, Style::REFERENCE, mirrored);
            chart = chart.series(label, Style::REFERENCE, golden.points.clone());
        }
        for (label, style, escaped) in [
            ("orbits that stay", style(method).dots(), false),
            ("orbits that escape", Style::REFERENCE.dots(), true),
        ] {
            let orbits = standard_map::orbits(k).into_iter();
            let points = orbits.filter(|orbit| orbit.escapes == escaped);
            chart = chart.series(label, style, points.flat_map(|orbit| orbit.points));
        }
        chart
    };
    let figure = figure.columns(2);
    standard_map::PARAMETERS.into_iter().fold(figure, |figure, k| figure.panel(portrait(k)))
}

/// The random walk of the modified energy by rounding, and how far it moves in n steps.
pub(super) fn rounding_walk(_: &Study, figure: Figure) -> Figure {
    /// A step rounds θ and ω once or twice each, by ε/√48 to ε/√12 of themselves (standard
    /// deviation), which changes the energy by 0.3 to 0.6 ε of itself (tests/theory/long_time.rs).
    const SIZE: f64 = 0.5;
    /// One sample in this many is drawn: the walk changes little between them.
    const DRAWN: usize = 50;
    let verlet = named("stormer-verlet");
    let walks = rounding_walk::walks();
    let steps = rounding_walk::STEPS as f64;
    let walk_of = |n: f64| SIZE * f64::EPSILON * libm::sqrt(n);
    let mut wander = Chart::new(
        Axis::linear("steps").range(0.0, steps),
        Axis::linear("relative error of the modified energy"),
    )
    .height(240.0);
    for sign in [1.0, -1.0] {
        let parabola = (0..=100).map(|k| 0.01 * steps * f64::from(k));
        wander = wander.series(
            "±ε√n / 2",
            Style::REFERENCE.dashed(),
            parabola.map(|n| (n, sign * walk_of(n))),
        );
    }
    for walk in walks {
        let line = walk
            .iter()
            .enumerate()
            .step_by(DRAWN)
            .map(|(i, error)| ((i as u64 * rounding_walk::SAMPLED) as f64, *error));
        wander = wander.series(title(verlet), style(verlet).line_only().solid(), line);
    }
    let growth = rounding_walk::growth(walks);
    let growth = growth.into_iter().map(|(n, movement)| (n as f64, movement));
    let first = rounding_walk::SAMPLED as f64;
    let moved = Chart::new(Axis::log("steps n"), Axis::log("movement in n steps, RMS"))
        .height(240.0)
        .series("±ε√n / 2", Style::REFERENCE.dashed(), [first, steps].map(|n| (n, walk_of(n))))
        .series(title(verlet), style(verlet).markers_only(), growth)
        .slope(1.0, (first, walk_of(first)), 3e5, "∝ n");
    figure.panel(wander).panel(moved)
}

/// A chart for each of two methods, with the places that theory gives.
pub(super) fn resonances(_: &Study, figure: Figure) -> Figure {
    let (from, to) = resonance::STEPS;
    let chart = |name: &str| {
        let method = named(name);
        let chart = Chart::new(
            Axis::linear("steps to a period").range(from, to),
            Axis::log(format!("largest energy error ΔH (J), {}", title(method))),
        )
        .height(240.0)
        .series("", style(method).line_only().solid(), resonance::line(method));
        resonance::EVEN.into_iter().fold(chart, |chart, count| {
            let place = resonance::place(count, resonance::tau(method));
            chart.vertical(place, format!("{count} a swing"))
        })
    };
    figure.panel(chart("blanes-moan-6")).panel(chart("stormer-verlet"))
}

/// The error against the length of the series.
pub(super) fn truncation(_: &Study, figure: Figure) -> Figure {
    let axis = Axis::log("largest change of H̃_{N} (m g L)").range(1e-12, 1e4);
    let chart =
        Chart::new(Axis::linear("last power N of x").range(0.0, truncation::ORDER as f64), axis)
            .height(280.0);
    let chart = truncation::STEPS.into_iter().enumerate().fold(chart, |chart, (i, x)| {
        let errors = truncation::errors(truncation::THETA_0, x).into_iter().enumerate();
        let line = errors.map(|(k, error)| (2.0 * k as f64, error));
        let (power, least) = truncation::best(truncation::THETA_0, x);
        let (style, best) = (Style::series(i), (power as f64, least));
        chart
            .series(format!("x = {x}"), style.line_only().solid(), line)
            .series("", style.markers_only(), [best])
            .note(best.0, best.1, format!("best: {power}"))
    });
    figure.panel(chart)
}

/// The smallest error against the step.
pub(super) fn least_change(_: &Study, figure: Figure) -> Figure {
    let chart = Chart::new(
        Axis::linear("1/x").range(1.0, truncation::FINEST),
        Axis::log("smallest change, of the best N (m g L)").range(1e-18, 1.0),
    )
    .height(260.0);
    let chart = truncation::STARTS.iter().enumerate().fold(chart, |chart, (i, theta_0)| {
        let (label, style) = (format!("from {theta_0} rad"), Style::series(3 + i));
        let law = truncation::inverse_steps();
        let law = law.map(|inverse| (inverse, truncation::law(*theta_0, 1.0 / inverse)));
        chart.series("theory", Style::REFERENCE, law).series(
            label,
            style.markers_only(),
            truncation::least(*theta_0),
        )
    });
    let split = Style::series(5).markers_only();
    figure.panel(chart.series("splitting of the separatrix", split, truncation::split()))
}

/// Widths of the bounds of the angle against time, for both shapes.
pub(super) fn widths(_: &Study, figure: Figure) -> Figure {
    let series = |shape| enclosure::widths(shape);
    let chart = Chart::new(
        Axis::log("t (s)").range(0.2, 60.0),
        Axis::log("width of the bounds of θ (rad)"),
    )
    .series("rectangles, turned", Style::series(0).line_only(), series(Shape::Turned))
    .series("boxes", Style::series(1).line_only(), series(Shape::Box))
    .slope(2.0, (2.0, 1e-12), 40.0, "slope 2");
    figure.panel(chart)
}
