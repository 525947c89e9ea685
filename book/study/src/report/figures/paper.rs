//! The paper's figures.

use pendula::Pendulum;

use super::{Drawing, named, of_the_paper, style, title};
use crate::charts::{Axis, Chart, Figure, Style};
use crate::experiments::{
    STEPS, Study, convergence, energy_error, large_angle, long_run, phase_portrait, small_angle,
};

pub(super) const FIGURES: &[Drawing] = &[
    Drawing {
        name: "figure_2",
        caption: "The paper's Figure 2, measured. RK4's energy error falls with slope 5, not 4; \
                  forward Euler's has no one slope.",
        draw: figure_2,
    },
    Drawing {
        name: "figure_3",
        caption: "The paper's Figure 3, with RK4 added: the energy's error at first and a thousand \
                  seconds later, each method on a scale of its own. That of the two symplectic \
                  methods comes and goes with each swing, as at first; forward Euler's and RK4's \
                  add up. Below, the largest error so far, on one scale for all.",
        draw: figure_3,
    },
    Drawing {
        name: "figure_4",
        caption: "The paper's Figure 4. Forward Euler lands outside the true orbit at every step.",
        draw: figure_4,
    },
    Drawing {
        name: "figure_5",
        caption: "The paper's Figure 5, with the separatrix around it. The curves look closed.",
        draw: figure_5,
    },
    Drawing {
        name: "figure_6",
        caption: "The paper's Figure 6. Broad crests: near the top the pendulum lingers.",
        draw: figure_6,
    },
    Drawing {
        name: "figure_7",
        caption: "The paper's Figure 7 over force evaluations. Above, the floor belongs to the \
                  formula; below, against the truth, there is none.",
        draw: figure_7,
    },
];

/// Energy error against step on doubly logarithmic axes.
fn figure_2(study: &Study) -> Figure {
    let mut chart = Chart::new(Axis::log("Δt (s)"), Axis::log("largest energy error ΔH (J)"))
        .slope(1.0, (0.1, 3.0), 0.001, "slope 1")
        .slope(2.0, (0.1, 3e-2), 0.001, "slope 2")
        .slope(5.0, (0.1, 6e-3), 0.0015, "slope 5");
    for convergence::Row { method, drift } in &study.convergence {
        chart = chart.series(title(*method), style(*method), STEPS.into_iter().zip(*drift));
    }
    Figure::new(
        "Energy error against step",
        "Four lines on doubly logarithmic axes. Störmer–Verlet falls with slope 2 and symplectic \
         Euler with slope 1. Forward Euler lies far above both with uneven slopes. RK4 falls with \
         slope 5, not 4, and flattens a little at the finest step.",
    )
    .panel(chart)
}

/// Energy at the beginning and at the end of a thousand seconds, a row for each method, and the
/// largest error so far.
fn figure_3(study: &Study) -> Figure {
    /// How much of either end is shown: about nine swings (s).
    const SHOWN: f64 = 20.0;
    let end = long_run::DURATION;
    let mut growth = Chart::new(
        Axis::linear("t (s)").range(0.0, end),
        Axis::log("largest |H − H_{0}| so far (J)"),
    )
    .height(200.0);
    let mut figure = Figure::new(
        "Energy over a thousand seconds",
        "Four rows of two small charts of the energy's error, the first twenty seconds and the \
         last, a row for each method on a linear scale of its own. Forward Euler's is near zero on \
         the left and near 480 joules on the right. Those of symplectic Euler and Störmer–Verlet \
         are waves, some hundredths of a joule and a thousandth high, on the right as on the left. \
         RK4's is a level line, on the right four millionths below zero. Below, on a logarithmic \
         scale, the largest error so far: level for the two symplectic methods, rising for forward \
         Euler, and rising for RK4 too, but two orders of magnitude below Störmer–Verlet.",
    )
    .columns(2);
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
fn figure_4(_: &Study) -> Figure {
    let method = named("forward-euler");
    let run = small_angle::trajectory(method, 0.01);
    let style = style(method).line_only().solid();
    let time = || Axis::linear("t (s)").range(0.0, small_angle::DURATION);
    let formula =
        |t: f64| small_angle::THETA_0 * pendula::arithmetic::sine::cos(small_angle_frequency() * t);
    let angle = Chart::new(time(), Axis::linear("θ (rad)"))
        .height(220.0)
        .series("θ_{0} cos ω_{0}t", Style::REFERENCE, run.iter().map(|&(t, _)| (t, formula(t))))
        .series(title(method), style, run.iter().map(|&(t, z)| (t, z.theta)));
    let energy = Chart::new(time(), Axis::linear("H − H_{0} (J)")).height(180.0).series(
        title(method),
        style,
        energy_error(&run),
    );
    Figure::new(
        "Forward Euler gains amplitude and energy",
        "Two curves against time over ten seconds. Above, the angle of forward Euler swings wider \
         with every period while the small-angle solution keeps its amplitude. Below, its energy \
         climbs from zero ever more steeply.",
    )
    .panel(angle)
    .panel(energy)
}

fn small_angle_frequency() -> f64 {
    Pendulum::PAPER.small_angle_frequency()
}

/// Three orbits of RK4 in phase space, inside the separatrix.
fn figure_5(_: &Study) -> Figure {
    let rk4 = named("rk4");
    let top = 2.0 * small_angle_frequency();
    let separatrix = (-160..=160).map(|k| f64::from(k) / 50.0).map(|theta| (theta, theta * 0.5));
    let separatrix =
        separatrix.map(|(theta, half)| (theta, top * pendula::arithmetic::sine::cos(half)));
    let above: Vec<(f64, f64)> = separatrix.collect();
    let below = above.iter().map(|&(theta, omega)| (theta, -omega));
    let mut chart = Chart::new(Axis::linear("θ (rad)"), Axis::linear("ω (rad/s)").range(-7.0, 7.0))
        .height(360.0)
        .series("separatrix", Style::REFERENCE, above.clone())
        .series("separatrix", Style::REFERENCE, below);
    // Each label stands where its own orbit has room beside it.
    for (theta_0, label_at) in phase_portrait::THETA_0.into_iter().zip([0.5, 1.5, -2.5]) {
        let points = phase_portrait::orbit(rk4, theta_0).into_iter().map(|z| (z.theta, z.omega));
        chart = chart.series(title(rk4), style(rk4).line_only().solid(), points).note(
            label_at,
            0.0,
            format!("{theta_0} rad"),
        );
    }
    Figure::new(
        "Three orbits in phase space",
        "Three closed curves around the origin, one inside the other, for releases from 0.5, 1.5 \
         and 2.5 radians, all inside the eye of the separatrix. The smallest is nearly an ellipse; \
         the largest is pointed at its left and right ends, where the pendulum lingers.",
    )
    .panel(chart)
}

/// The waveform at a large angle, with the exact period marked.
fn figure_6(study: &Study) -> Figure {
    let rk4 = named("rk4");
    let period = study.large_angle.exact;
    let chart = Chart::new(
        Axis::linear("t (s)").range(0.0, 15.0),
        Axis::linear("θ (rad)").range(-3.3, 3.3),
    )
    .vertical(period, "T, exact")
    .series(title(rk4), style(rk4).line_only().solid(), large_angle::waveform());
    Figure::new(
        "The waveform at 3 radians",
        "The angle against time for fifteen seconds: broad, flat crests and troughs joined by \
         steep flanks, nothing like a cosine. A dashed line at the exact period, 5.158 seconds, \
         passes through the middle of the second crest.",
    )
    .panel(chart)
}

/// Error over force evaluations: against the small-angle formula, and against the exact solution.
fn figure_7(study: &Study) -> Figure {
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
    Figure::new(
        "Error against work",
        "Two charts over the number of force evaluations, both axes logarithmic. Above, against \
         the small-angle formula, RK4 and Störmer–Verlet run into a floor at a ten-thousandth of a \
         radian. Below, against the exact solution, all four methods are straight lines and RK4 is \
         far ahead.",
    )
    .panel(formula)
    .panel(truth)
}
