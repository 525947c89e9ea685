//! Figures of adaptive steps and of the systems beyond the simple pendulum.

use core::f64::consts::{PI, SQRT_2};

use pendula::systems::DoublePhase;
use pendula_dynamics::kepler::{Ellipse, Kepler, PlanePhase};

use super::{named, phase_plane, style};
use crate::charts::{Axis, Chart, Figure, Style};
use crate::experiments::Study;
use crate::experiments::adaptive_steps::{self, Control};
use crate::experiments::beyond::{self, Boundary, Trial};

/// How wide a plot is beside labels such as −1.5, in the units of its height.
const WIDTH: f64 = 525.5;

/// How far the energy of a planet has been off, with steps chosen in three ways.
pub(super) fn adaptive_steps(_: &Study, figure: Figure) -> Figure {
    let revolutions = f64::from(adaptive_steps::REVOLUTIONS);
    let chart = Chart::new(
        Axis::linear("revolutions").range(0.0, revolutions),
        Axis::log("largest energy error so far, as a part of the energy").range(1e-3, 1.0),
    )
    .height(260.0);
    let ways = [
        ("fixed steps", Control::Equal),
        ("naive control", Control::Naive),
        ("symmetric control", Control::Symmetric),
    ];
    figure.panel(ways.into_iter().enumerate().fold(chart, |chart, (i, (label, control))| {
        let so_far = adaptive_steps::run(control).so_far.into_iter().zip(1_u32..);
        let line = so_far.map(|(error, n)| (f64::from(n), error));
        chart.series(label, Style::series(i + 1).line_only().solid(), line)
    }))
}

/// A chart of a plane in which a metre is as long upwards as across.
fn plane(x: (f64, f64), y: (f64, f64)) -> Chart {
    Chart::new(Axis::linear("x (m)").range(x.0, x.1), Axis::linear("y (m)").range(y.0, y.1))
        .height(WIDTH * (y.1 - y.0) / (x.1 - x.0))
}

/// States on the section; dots that coincide on the drawing are drawn once.
const STATES: usize = 8_000;

/// The strange attractor of the driven pendulum.
pub(super) fn poincare(_: &Study, figure: Figure) -> Figure {
    let dots = beyond::poincare(STATES);
    let chart = phase_plane((-PI, PI), (-10.0, 30.0)).height(360.0).series(
        "",
        Style::series(1).dots(),
        dots.into_iter().map(|z| (z.theta, z.omega)),
    );
    figure.panel(chart)
}

/// The angles at which the driven pendulum is seen once per period, for each drive.
pub(super) fn road_to_chaos(_: &Study, figure: Figure) -> Figure {
    let [least, largest] = beyond::DRIVES;
    let chart = Chart::new(
        Axis::linear("strength of the drive, γ").range(least, largest),
        Axis::linear("θ once per period (rad)").range(-0.8, 0.0),
    )
    .height(300.0)
    .series("", Style::numbered(1).dots(), beyond::road_to_chaos(241, 48));
    figure.panel(chart)
}

/// How quickly two double pendulums part, released high and low.
pub(super) fn separation(_: &Study, figure: Figure) -> Figure {
    let double = beyond::equals();
    let run = |theta| beyond::separation(&double, theta, 1e-9, (0.002, 10_000));
    let chart = Chart::new(Axis::linear("t (s)").range(0.0, 20.0), Axis::log("distance (rad)"))
        .series("released at 2 and 2.5 rad", Style::series(0).line_only(), run([2.0, 2.5]))
        .series("released at 0.2 and 0.25 rad", Style::series(1).line_only(), run([0.2, 0.25]));
    figure.panel(chart)
}

/// Where a shaken pendulum stays upright.
pub(super) fn kapitza(_: &Study, figure: Figure) -> Figure {
    // Each curve from beyond one edge of the chart to beyond another.
    let curve = |boundary, from: f64| {
        let parameters = (0..=400).map(move |i| from + 0.005 * f64::from(i));
        parameters.filter_map(move |q| beyond::mathieu_boundary(boundary, q))
    };
    let falling: Vec<_> = curve(Boundary::Falling, 0.1).collect();
    let region = curve(Boundary::Rocking, 0.91).chain(falling.into_iter().rev());
    let kapitza = (20..=220).map(|i| 0.1 * f64::from(i)).map(|ratio| (ratio, SQRT_2 / ratio));
    let (stands, leaves): (Vec<_>, Vec<_>) =
        beyond::trials().into_iter().partition(|trial| trial.stands);
    let at = |trial: Trial| (trial.frequency, trial.amplitude);
    let chart = Chart::new(
        Axis::linear("angular frequency of the pivot, Ω/ω_{0}").range(2.0, 22.0),
        Axis::linear("amplitude of the pivot, a/L").range(0.0, 0.65),
    )
    .height(330.0)
    .series("stable by Mathieu's curves", Style::REFERENCE.filled(), region)
    .series("Kapitza's rule, aΩ = √(2gL)", Style::REFERENCE.dashed(), kapitza)
    .series("stands", Style::series(2).markers_only(), stands.into_iter().map(at))
    .series("falls over or rocks", Style::series(5).markers_only(), leaves.into_iter().map(at));
    figure.panel(chart)
}

/// The paths of the lower bobs of two double pendulums whose starts are neighbours.
pub(super) fn double_pendulum_trace(_: &Study, figure: Figure) -> Figure {
    let double = beyond::equals();
    // With half the step no bob is elsewhere by a hundredth of a millimetre.
    let path = |upper| beyond::path(&double, [upper, 2.5], (0.001, 6000));
    let lower = |(_, z): &(f64, DoublePhase)| double.bobs(*z)[1];
    let (one, other) = (path(2.0), path(2.01));
    let [joint, bob] = double.bobs(one[0].1);
    let chart = plane((-2.4, 2.4), (-2.1, 1.5))
        .series("from 2 rad", Style::series(0).line_only(), one.iter().map(lower))
        .series("from 2.01 rad", Style::series(1).line_only(), other.iter().map(lower))
        .series("rods at the start", Style::REFERENCE, [(0.0, 0.0), joint, bob])
        .series("", Style::TRUE_POINT, [(0.0, 0.0), joint, bob]);
    figure.panel(chart)
}

/// Kepler's ellipse, and how Störmer–Verlet turns it.
pub(super) fn turning_ellipse(_: &Study, figure: Figure) -> Figure {
    const STEPS: usize = 100;
    const REVOLUTIONS: usize = 30;
    const EACH: usize = 3;
    let centre = Kepler::new(1.0).expect("an attraction");
    let ellipse = Ellipse::new(&centre, 1.0, 0.6).expect("an ellipse");
    let states = beyond::turning(&centre, &ellipse, STEPS as u64, REVOLUTIONS as u64);
    let at = |z: &PlanePhase| (z.x, z.y);
    let truth: Vec<_> =
        (0..=400).map(|i| ellipse.at(ellipse.period() * (f64::from(i) / 400.0))).collect();
    let method = named("stormer-verlet");
    let ends = (1..=REVOLUTIONS).filter(|n| n % EACH == 0).map(|n| n * STEPS);
    let dots = ends.flat_map(|end| &states[end - STEPS..end]);
    // Two steps more than a revolution, since the apocentre comes to meet the planet.
    let last = &states[(REVOLUTIONS - 1) * STEPS - 2..];
    let ray = |z: &PlanePhase| [(0.0, 0.0), at(z)];
    let [first, turned] = [states[0], states[REVOLUTIONS * STEPS]];
    let towards = centre.eccentricity(turned);
    let angle = libm::atan2(towards.y, towards.x);
    let (sine, cosine) = libm::sincos(0.5 * angle);
    let chart = plane((-1.9, 1.1), (-0.95, 1.35))
        .series("true ellipse", Style::REFERENCE, truth.iter().map(at))
        .series("each third revolution", style(method).dots(), dots.map(at))
        .series("the thirtieth", style(method).line_only().solid(), last.iter().map(at))
        .series("", Style::GUIDE, ray(&first))
        .series("", Style::GUIDE, ray(&turned))
        .series("", Style::TRUE_POINT, [(0.0, 0.0)])
        .note(-0.6 * cosine, -0.6 * sine, format!("{:.2} rad", angle.abs()));
    figure.panel(chart)
}
