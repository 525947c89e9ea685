//! What cancelling errors, the reading of the period, chaos and rounding do to measurements.

use core::f64::consts::PI;

use pendula::Pendulum;

use super::{Drawing, named, of_the_paper, style, title};
use crate::charts::{Axis, Chart, Figure, Style};
use crate::experiments::{
    STEPS, Study, large_angle, readings, rounding_walk, small_angle, standard_map,
};
use crate::theory;

pub(super) const FIGURES: &[Drawing] = &[
    Drawing {
        name: "cancellation",
        caption: "Störmer–Verlet's own error falls with the step; that of the small-angle formula \
                  stays. What the paper measures is their difference, and where the two lines \
                  cross it all but vanishes.",
        draw: cancellation,
    },
    Drawing {
        name: "five_periods",
        caption: "One trajectory, five periods. Above, two of the readings are good enough to show \
                  RK4's own error, which changes its sign near 2 ms. Below, off the exact motion, \
                  each reading shows its own, down to rounding; a line that ends has reached zero.",
        draw: five_periods,
    },
    Drawing {
        name: "standard_map",
        caption: "Symplectic Euler at four large steps. A curve that crosses the picture bars the \
                  way up. The last to break, drawn here with its mirror image, still holds at K = \
                  0.97; at 1.2 it is gone, and the orbits that began beside the upper equilibrium \
                  are everywhere but in the islands, which shrink as K grows.",
        draw: standard_map,
    },
    Drawing {
        name: "rounding_walk",
        caption: "What is left of Störmer–Verlet's conserved energy is rounding. Above, eight runs \
                  wander to either side; below, they wander twice as far in four times the steps. \
                  A biased rounding would follow the steeper guide.",
        draw: rounding_walk,
    },
];

/// Störmer–Verlet's error and the formula's: where they cancel, its errors in the paper's table
/// are smallest.
fn cancellation(study: &Study) -> Figure {
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
    Figure::new(
        "Two errors that cancel",
        "The error of Störmer–Verlet against step, both axes logarithmic. Two straight lines are \
         theory: the method's own error, of slope 2, and the formula's, level at a ten-thousandth \
         of a radian. They cross near a step of 0.02 seconds. The error measured against the \
         formula follows the first above the crossing and the second below it; at the crossing it \
         dips to almost nothing. Markers, the error measured against the exact solution, lie on \
         the line of slope 2 throughout.",
    )
    .panel(chart)
}

/// The error of the period by the five ways of reading it, from RK4's samples and from the exact
/// motion's.
fn five_periods(_: &Study) -> Figure {
    let axes = |samples| {
        let error = Axis::log(format!("error of the period (s), {samples}")).range(1e-16, 1.0);
        Chart::new(Axis::log("h (s)").range(8e-5, 0.14), error)
    };
    let draw = |chart: Chart, ladder: &[readings::Errors]| {
        readings::READINGS.into_iter().enumerate().fold(chart, |chart, (i, reading)| {
            let line = ladder.iter().map(|errors| (errors.step, errors.by[i]));
            chart.series(reading, Style::series(i), line)
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
    let rk4 = axes("of RK4").series("", style(named("rk4")).line_only(), own).note(
        beginning.0,
        beginning.1,
        "RK4’s own, by theory",
    );
    let exact = axes("of the exact motion")
        .slope(1.0, (0.1, 0.2), 1e-4, "slope 1")
        .slope(3.0, (0.1, 1e-2), 2e-4, "slope 3")
        .slope(5.0, (0.1, 1e-6), 4e-3, "slope 5");
    Figure::new(
        "Five readings of one period",
        "Two charts of the error of the period against the step, on logarithmic axes, with a line \
         for each of five readings. In both, the highest sample falls with slope 1, and parabola \
         and straight line with slope 3 at small steps. Above, where RK4 made the samples, \
         Hermite's cubic and Hénon's step lie on the one line, without markers, that theory \
         predicts for RK4, with a dip near two thousandths of a second; below, off the exact \
         motion, each falls with slope 5 until rounding holds it up.",
    )
    .panel(draw(rk4, &readings::of_rk4()))
    .panel(draw(exact, &readings::of_the_exact_motion()))
}

/// Phase portraits of symplectic Euler as the standard map.
fn standard_map(_: &Study) -> Figure {
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
    let figure = Figure::new(
        "Symplectic Euler as the standard map",
        "Four phase portraits of dots, angle across and turn a step upwards. At K = 0.5 the dots \
         lie on closed curves around the middle and on curves that cross the picture from left to \
         right, above and below. At K = 0.97 there are chains of islands, and a cloud of dots \
         around the middle, held in by one last curve above and its mirror image below. At K = 1.2 \
         there is no such curve: dots of orbits that have escaped fill all but some islands \
         evenly. At K = 2 the islands are smaller.",
    )
    .columns(2);
    standard_map::PARAMETERS.into_iter().fold(figure, |figure, k| figure.panel(portrait(k)))
}

/// The random walk of the modified energy by rounding, and how far it moves in n steps.
fn rounding_walk(_: &Study) -> Figure {
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
    Figure::new(
        "Rounding walks at random",
        "Above, the relative error of Störmer–Verlet's modified energy over ten million steps: \
         eight jagged lines wander from zero to either side, about as far as a parabola lying on \
         its side. Below, on logarithmic axes, how far they move in n steps: markers on a line of \
         slope one half, far below a guide of slope one.",
    )
    .panel(wander)
    .panel(moved)
}
