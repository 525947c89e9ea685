//! The paper's figures.

use pendula::Pendulum;
use pendula::arithmetic::sine::cos;

use super::{named, of_the_paper, style, title};
use crate::charts::{Axis, Chart, Figure, Style};
use crate::experiments::{
    STEPS, Study, convergence, energy_error, large_angle, level_curves, long_run, small_angle,
};

/// Energy error against step on doubly logarithmic axes.
pub(super) fn figure_2(study: &Study, figure: Figure) -> Figure {
    let mut chart = Chart::new(Axis::log("Δt (s)"), Axis::log("largest energy error ΔH (J)"))
        .slope(1.0, (0.1, 3.0), 0.001, "slope 1")
        .slope(2.0, (0.1, 3e-2), 0.001, "slope 2")
        .slope(5.0, (0.1, 6e-3), 0.0015, "slope 5");
    for convergence::Row { method, drift } in &study.convergence {
        chart = chart.series(title(*method), style(*method), STEPS.into_iter().zip(*drift));
    }
    figure.panel(chart)
}

/// Energy at the beginning and at the end of a thousand seconds, a row for each method, and the
/// largest error so far.
pub(super) fn figure_3(study: &Study, figure: Figure) -> Figure {
    /// How much of either end is shown: about nine swings (s).
    const SHOWN: f64 = 20.0;
    let end = long_run::DURATION;
    let mut growth = Chart::new(
        Axis::linear("t (s)").range(0.0, end),
        Axis::log("largest |H − H_{0}| so far (J)"),
    )
    .height(200.0);
    let mut figure = figure.columns(2);
    for (i, row) in of_the_paper(&study.long_run, |row| row.method).enumerate() {
        // Named by its axis, and below at its line's end: no dashes have to tell them apart.
        let (title, style) = (title(row.method), style(row.method).line_only().solid());
        let error = long_run::energy(row.method);
        let ends = [(0.0, SHOWN), (end - SHOWN, end)].map(|(from, to)| {
            let shown = error.iter().filter(move |(t, _)| (from..=to).contains(t));
            (from, to, shown.copied().collect::<Vec<_>>())
        });
        let values = ends.iter().flat_map(|(.., shown)| shown).map(|(_, error)| *error);
        let (low, high) = values.fold((0.0_f64, 0.0_f64), |(l, h), e| (l.min(e), h.max(e)));
        let margin = 0.25 * (high - low);
        let axis = Axis::linear(format!("{title}, H − H_{{0}} (J)"));
        for (from, to, shown) in ends {
            // The last second of the left chart and the first of the right one have one place.
            let ticks = [from, from + 0.5 * SHOWN, to].into_iter().skip(usize::from(from > 0.0));
            let time = Axis::linear("t (s)").range(from, to);
            let time = time.ticks(ticks.map(|t| (t, t.to_string())));
            let chart = Chart::new(time, axis.clone().range(low - margin, high + margin));
            let heading = match (i, from) {
                (0, 0.0) => "the first 20 s",
                (0, _) => "the last 20 s",
                _ => "",
            };
            figure = figure.panel(chart.height(66.0).heading(heading).series(title, style, shown));
        }
        growth = growth.series(title, style, long_run::growth(row.method));
    }
    figure.panel(growth)
}

/// Forward Euler's angle and energy at a small angle.
pub(super) fn figure_4(_: &Study, figure: Figure) -> Figure {
    let method = named("forward-euler");
    let run = small_angle::trajectory(method, 0.01);
    let style = style(method).line_only().solid();
    let time = || Axis::linear("t (s)").range(0.0, small_angle::DURATION);
    let frequency = Pendulum::PAPER.small_angle_frequency();
    let formula = |t: f64| small_angle::THETA_0 * cos(frequency * t);
    let angle = Chart::new(time(), Axis::linear("θ (rad)"))
        .height(220.0)
        .series("θ_{0} cos ω_{0}t", Style::REFERENCE, run.iter().map(|&(t, _)| (t, formula(t))))
        .series(title(method), style, run.iter().map(|&(t, z)| (t, z.theta)));
    let energy = Chart::new(time(), Axis::linear("H − H_{0} (J)")).height(180.0).series(
        title(method),
        style,
        energy_error(&run),
    );
    figure.panel(angle).panel(energy)
}

/// Three orbits of RK4 in phase space, inside the separatrix.
pub(super) fn figure_5(_: &Study, figure: Figure) -> Figure {
    let rk4 = named("rk4");
    let top = 2.0 * Pendulum::PAPER.small_angle_frequency();
    let separatrix = (-160..=160).map(|k| f64::from(k) / 50.0).map(|theta| (theta, theta * 0.5));
    let above: Vec<_> = separatrix.map(|(theta, half)| (theta, top * cos(half))).collect();
    let below = above.iter().map(|&(theta, omega)| (theta, -omega));
    let mut chart = Chart::new(Axis::linear("θ (rad)"), Axis::linear("ω (rad/s)").range(-7.0, 7.0))
        .height(360.0)
        .series("separatrix", Style::REFERENCE, above.clone())
        .series("separatrix", Style::REFERENCE, below);
    // Each label stands where its own orbit has room beside it.
    for (theta_0, label_at) in level_curves::PORTRAIT.into_iter().zip([0.5, 1.5, -2.5]) {
        let points = level_curves::portrait(rk4, theta_0).into_iter().map(|z| (z.theta, z.omega));
        chart = chart
            .series("swings, computed step by step", style(rk4).line_only().solid(), points)
            .note(label_at, 0.0, format!("{theta_0} rad"));
    }
    figure.panel(chart)
}

/// The waveform at a large angle, with the exact period marked.
pub(super) fn figure_6(study: &Study, figure: Figure) -> Figure {
    let rk4 = named("rk4");
    let period = study.large_angle.exact;
    let chart = Chart::new(
        Axis::linear("t (s)").range(0.0, 15.0),
        Axis::linear("θ (rad)").range(-3.3, 3.3),
    )
    .vertical(period, "T, exact")
    .series(title(rk4), style(rk4).line_only().solid(), large_angle::waveform());
    figure.panel(chart)
}

/// Error over force evaluations: against the small-angle formula, and against the exact solution.
pub(super) fn figure_7(study: &Study, figure: Figure) -> Figure {
    let work = || Axis::log("force evaluations").range(80.0, 60_000.0);
    let axis = |against| Axis::log(format!("RMS error against {against} (rad)"));
    let mut formula = Chart::new(work(), axis("formula")).height(240.0);
    let mut truth = Chart::new(work(), axis("truth"));
    for row in &study.work {
        let line = |pick: fn(&small_angle::Errors) -> f64| {
            row.points.iter().map(|(n, errors)| (*n as f64, pick(errors))).collect::<Vec<_>>()
        };
        let (label, style) = (title(row.method), style(row.method));
        formula = formula.series(label, style, line(|errors| errors.formula));
        truth = truth.series(label, style, line(|errors| errors.truth));
    }
    figure.panel(formula).panel(truth)
}
