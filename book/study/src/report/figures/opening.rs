//! Figures of the first chapters: why it matters how one integrates, what acts on the pendulum, and
//! how it swings.

use core::f64::consts::PI;

use pendula::arithmetic::sine::{cos, sin};
use pendula::exact::{Motion, Swing, period};
use pendula::{Pendulum, Phase};

use super::{named, style, title};
use crate::charts::{Axis, Chart, Figure, Style};
use crate::experiments::{Study, long_run};

const PENDULUM: Pendulum = Pendulum::PAPER;

/// `n` + 1 points, evenly from `low` to `high`.
fn spread(low: f64, high: f64, n: u32) -> impl Iterator<Item = f64> + Clone {
    (0..=n).map(move |k| low + (high - low) * (f64::from(k) / f64::from(n)))
}

// -------------------------------------------------------------------------------------------------
// The same second, twice
// -------------------------------------------------------------------------------------------------

/// The angle by the two methods of Euler in the first second of the long run, and in its last.
pub(super) fn two_eulers(_: &Study, figure: Figure) -> Figure {
    let end = long_run::DURATION;
    let panel = |heading: &str, (from, to): (f64, f64), ticks: &[f64]| {
        let ticks = ticks.iter().map(|t| (*t, t.to_string()));
        let time = Axis::linear("t (s)").range(from, to).ticks(ticks);
        let angle = Axis::linear("angle θ (rad)").range(-PI, PI);
        let angle = angle.ticks([(-PI, "top, −π"), (0.0, "bottom, 0"), (PI, "top, π")]);
        let chart = Chart::new(time, angle).height(240.0).heading(heading);
        let methods = ["forward-euler", "symplectic-euler"].map(named);
        methods.into_iter().fold(chart, |chart, method| {
            let run = long_run::angle(method, (from, to));
            turns(&run).into_iter().fold(chart, |chart, turn| {
                chart.series(title(method), style(method).line_only(), turn)
            })
        })
    };
    figure
        .columns(2)
        .panel(panel("the first second", (0.0, 1.0), &[0.0, 0.5, 1.0]))
        // The beginning has no label: it would run into the end of the first.
        .panel(panel("the thousandth second", (end - 1.0, end), &[end - 0.5, end]))
}

/// The run, once for each turn that it enters, with the angle from −π to π and a little beyond, so
/// that each curve reaches the edge of the chart.
fn turns(run: &[(f64, f64)]) -> Vec<Vec<(f64, f64)>> {
    let turn = |theta: f64| (theta / (2.0 * PI)).round() as i64;
    let entered = run.iter().map(|&(_, theta)| turn(theta));
    let (first, last) = (entered.clone().min(), entered.max());
    let (first, last) = first.zip(last).unwrap_or((0, -1));
    let within = |n: i64| {
        let from_bottom = run.iter().map(move |&(t, theta)| (t, theta - 2.0 * PI * n as f64));
        from_bottom.filter(|(_, theta)| theta.abs() < 1.2 * PI).collect()
    };
    (first..=last).map(within).collect()
}

// -------------------------------------------------------------------------------------------------
// What acts on the bob
// -------------------------------------------------------------------------------------------------

/// A newton is drawn as long as this (m).
const NEWTON: f64 = 0.056;

/// The pendulum, deflected, with gravity and its parts along the circle and along the rod.
pub(super) fn forces(_: &Study, figure: Figure) -> Figure {
    let (theta, length) = (0.7, PENDULUM.length());
    // From the pivot, to the right and up.
    let at = |radius: f64, angle: f64| (radius * sin(angle), -radius * cos(angle));
    let bob = at(length, theta);
    let from_bob = |(x, y): (f64, f64)| [bob, (bob.0 + x, bob.1 + y)];
    let weight = NEWTON * PENDULUM.mass() * PENDULUM.gravity();
    let along_circle = at(weight * sin(theta), theta - 0.5 * PI);
    let along_rod = at(weight * cos(theta), theta);
    let down = (0.0, -weight);
    let [tip_circle, tip_rod, tip_down] = [along_circle, along_rod, down].map(|f| from_bob(f)[1]);
    // The arc of the angle ends with a straight piece, long enough for the head of its arrow.
    let radius = 0.4 * length;
    let arc = spread(0.0, theta - 0.25, 20).chain([theta]).map(|angle| at(radius, angle));
    let path = spread(-0.5, 1.2, 60).map(|angle| at(length, angle));
    let (driving, held) = (Style::series(0).arrow(), Style::series(1).arrow());
    let chart = Chart::sketch((-0.65, 1.45), (-1.4, 0.12))
        .series("", Style::GUIDE, path)
        .series("θ = 0", Style::GUIDE, [(0.0, 0.0), at(1.25 * length, 0.0)])
        .series("", Style::GUIDE, [tip_circle, tip_down])
        .series("", Style::GUIDE, [tip_rod, tip_down])
        .series("", Style::REFERENCE, [(0.0, 0.0), bob])
        .series("", Style::REFERENCE.arrow(), arc)
        .series("", driving, from_bob(along_circle))
        .series("", held, from_bob(along_rod))
        .series("", Style::REFERENCE.arrow(), from_bob(down))
        .series("", Style::TRUE_POINT, [(0.0, 0.0), bob]);
    let notes = [
        ("pivot", (0.0, 0.04)),
        ("m", bob),
        ("L", at(0.6 * length, theta)),
        ("θ", at(radius, 0.4 * theta)),
        ("mg", tip_down),
        ("mg sin θ", tip_circle),
        ("mg cos θ", tip_rod),
    ];
    let chart = notes.into_iter().fold(chart, |chart, (text, (x, y))| chart.note(x, y, text));
    figure.panel(chart)
}

// -------------------------------------------------------------------------------------------------
// How long a swing takes
// -------------------------------------------------------------------------------------------------

/// The releases that are drawn (rad).
const RELEASES: [f64; 4] = [0.5, 1.5, 2.5, 3.1];
/// For this long (s).
const SWINGING: f64 = 8.0;

/// The exact motion after four releases, and the period against the amplitude.
pub(super) fn swings(_: &Study, figure: Figure) -> Figure {
    let ratio = |theta_0: f64| {
        let swing = Swing::released_at(&PENDULUM, theta_0).expect("a finite angle");
        (theta_0, swing.ratio())
    };
    let corrected = |theta_0: f64| (theta_0, 1.0 + theta_0 * theta_0 / 16.0);
    let angles = || spread(0.0, PI, 400);
    let quarters = [(0.0, "0"), (0.25, "π/4"), (0.5, "π/2"), (0.75, "3π/4"), (1.0, "π")];
    let halves = [(-1.0, "−π"), (-0.5, "−π/2"), (0.0, "0"), (0.5, "π/2"), (1.0, "π")];
    let ticks = |axis: Axis, ticks: [(f64, &'static str); 5]| {
        axis.ticks(ticks.map(|(turn, label)| (turn * PI, label)))
    };
    let mut motions = Chart::new(
        Axis::linear("t (s)").range(0.0, SWINGING),
        ticks(Axis::linear("angle θ (rad)").range(-3.4, 3.4), halves),
    )
    .height(250.0);
    let mut periods = Chart::new(
        ticks(Axis::linear("amplitude θ_{0} (rad)").range(0.0, PI), quarters),
        Axis::linear("period T/T_{0}").range(0.5, 3.6),
    )
    .height(220.0)
    .series("", Style::GUIDE, [(0.0, 1.0), (PI, 1.0)])
    .series("", Style::REFERENCE.dashed(), angles().map(corrected))
    .series("", Style::REFERENCE, angles().map(ratio));
    for (i, theta_0) in RELEASES.into_iter().enumerate() {
        let label = format!("{theta_0} rad");
        let (line, mark) = (Style::series(i).line_only(), Style::series(i).markers_only());
        let motion = Motion::new(&PENDULUM, Phase::at_rest(theta_0)).expect("a finite start");
        let curve = spread(0.0, SWINGING, 800).map(|t| (t, motion.at(t).theta));
        let back = period(&PENDULUM, theta_0).expect("a finite angle");
        motions = motions.series(&label, line, curve).series(&label, mark, [(back, theta_0)]);
        periods = periods.series(&label, mark, [ratio(theta_0)]);
    }
    let labelled =
        [("exact", ratio(3.0)), ("1 + θ_{0}²/16", corrected(2.8)), ("small angles", (2.2, 1.0))];
    for (text, (x, y)) in labelled {
        periods = periods.note(x, y, text);
    }
    figure.panel(motions).panel(periods)
}
