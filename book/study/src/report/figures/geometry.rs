//! What a method does in phase space: the parts of its step, the area that it carries, the curve
//! that it follows.

use pendula::exact::Motion;
use pendula::methods::{ForestRuth, Rk4, Splitting, StormerVerlet, Suzuki4};
use pendula::{AnyMethod, Grid, METHODS, Method, Pendulum, Phase, System};

use super::{named, phase_plane, style, title};
use crate::charts::{Axis, Chart, Figure, Style};
use crate::experiments::parts::{Kind, Noting, Parts};
use crate::experiments::shapes::{CAT, Place, Polygon, SQUARE, area};
use crate::experiments::{MethodRef, Study, carried, in_paper, level_curves};

const PENDULUM: Pendulum = Pendulum::PAPER;

fn point(z: Phase) -> (f64, f64) {
    (z.theta, z.omega)
}

fn true_motion(start: Phase) -> Motion {
    Motion::new(&PENDULUM, start).expect("a finite start")
}

fn period_of(start: Phase) -> f64 {
    true_motion(start).period().expect("it does not stop at the top")
}

/// The true motion from `start` for the time `duration` (s), in enough points for a smooth curve.
fn truth(start: Phase, duration: f64) -> impl Iterator<Item = (f64, f64)> {
    const POINTS: u32 = 400;
    let motion = true_motion(start);
    let time = move |n: u32| duration * (f64::from(n) / f64::from(POINTS));
    (0..=POINTS).map(move |n| point(motion.at(time(n))))
}

// -------------------------------------------------------------------------------------------------
// One step taken apart
// -------------------------------------------------------------------------------------------------

/// On the way down to the bottom: neither the velocity nor the force is zero or at its maximum.
const START: Phase = Phase { theta: -1.2, omega: 1.0 };
/// A sixth of a period (s): long enough to show each part of the step.
const STEP: f64 = 0.35;
/// RK4's step (s): with the step of the others its end could hardly be told from the true
/// motion's.
const RK4_STEP: f64 = 0.55;

/// A step taken apart, each slope followed for the time `along` (s).
fn parts<M>(method: &M, start: Phase, h: f64, along: f64) -> Parts<Phase>
where
    M: for<'a> Method<Noting<'a, Pendulum>>,
{
    Parts::of(method, &PENDULUM, start, h, along).expect("no more parts than can be drawn")
}

/// The true orbit; the parts of the step are drawn over it.
fn orbit() -> Chart {
    phase_plane((-1.6, 1.6), (0.0, 5.0)).height(320.0).series(
        "true orbit",
        Style::REFERENCE,
        truth(START, period_of(START)),
    )
}

/// With the ends of the step, and where the true motion is then.
fn with_ends(chart: Chart, method: MethodRef, step: f64, end: Phase) -> Chart {
    chart
        .series(
            format!("true motion after {step} s"),
            Style::TRUE_POINT,
            [point(true_motion(START).at(step))],
        )
        .series(title(method), style(method).markers_only(), [point(START), point(end)])
}

/// A point of an arrow, after this share of it.
fn between(from: Phase, to: Phase, share: f64) -> (f64, f64) {
    let at = |from: f64, to: f64| from + share * (to - from);
    (at(from.theta, to.theta), at(from.omega, to.omega))
}

/// The chart with the parts of a step of [`STEP`] as arrows, and their names beside them.
fn with_arrows(chart: Chart, method: MethodRef, parts: Parts<Phase>) -> Chart {
    parts.in_order().fold(chart, |chart, part| {
        let share = |kind: &str| match part.duration / STEP {
            1.0 => kind.to_string(),
            0.5 => format!("½ {kind}"),
            share => format!("{share:.2} {kind}"),
        };
        let name = match part.kind {
            Kind::Slope => "tangent".into(),
            Kind::Kick => share("kick"),
            Kind::Drift => share("drift"),
        };
        let (from, to) = (part.from, part.to);
        let (theta, omega) = between(from, to, 0.5);
        chart.series("", style(method).arrow(), [from, to].map(point)).note(theta, omega, name)
    })
}

/// The chart of a step of [`STEP`].
pub(super) fn step_of<M>(method: &'static M) -> Chart
where
    M: AnyMethod + for<'a> Method<Noting<'a, Pendulum>>,
{
    let parts = parts(method, START, STEP, STEP);
    let chart = with_ends(orbit(), method, STEP, parts.end);
    with_arrows(chart, method, parts)
}

/// RK4's step in two charts: where each slope is taken, and their average.
pub(super) fn stencil_rk4(_: &Study, figure: Figure) -> Figure {
    /// How long the arrow of a slope is, as a share of the step.
    const SHARE: f64 = 0.25;
    /// What part of the step each slope is followed for in the end, with its name.
    const WEIGHTS: [(f64, &str); 4] =
        [(1.0 / 6.0, "h/6"), (1.0 / 3.0, "h/3"), (1.0 / 3.0, "h/3"), (1.0 / 6.0, "h/6")];
    let method: MethodRef = &Rk4;
    let (arrow, name) = (style(method).arrow(), |i: usize| format!("k_{{{}}}", i + 1));
    let parts = parts(&Rk4, START, RK4_STEP, SHARE * RK4_STEP);
    let slopes: Vec<_> = parts.in_order().collect();

    let mut places = orbit().height(300.0).heading("Where each slope is taken");
    for (i, slope) in slopes.iter().enumerate().skip(1) {
        // The name of the first stands beyond the arrow of the slope.
        let (time, along) = [("h/2", 0.75), ("h/2", 0.5), ("h", 0.5)][i - 1];
        let (theta, omega) = between(START, slope.from, along);
        places = places
            .series("followed from the start", arrow, [START, slope.from].map(point))
            .note(theta, omega, format!("{} {time}", name(i - 1)));
    }
    for (i, slope) in slopes.iter().enumerate() {
        let line = [slope.from, slope.to].map(point);
        places = places.series("a slope", arrow.bold(), line).note(line[1].0, line[1].1, name(i));
    }
    places = places.series(title(method), style(method).markers_only(), [point(START)]);

    let mut average = orbit().height(240.0).heading("How they are averaged");
    let mut at = START;
    for (i, (slope, (weight, time))) in slopes.iter().zip(WEIGHTS).enumerate() {
        let to = at + PENDULUM.rate(0.0, slope.from) * (weight * RK4_STEP);
        // The last ends where the step does: its name stands where there is more room.
        let (theta, omega) = between(at, to, if i < 3 { 0.5 } else { 0.0 });
        average = average.series("", arrow, [at, to].map(point)).note(
            theta,
            omega,
            format!("{} {time}", name(i)),
        );
        at = to;
    }
    figure.panel(places).panel(with_ends(average, method, RK4_STEP, parts.end))
}

// -------------------------------------------------------------------------------------------------
// A step of order 4 put together from steps of order 2
// -------------------------------------------------------------------------------------------------

/// About a seventh of a period (s): the errors of the substeps can be seen, and that of the step is
/// small beside them.
const JUMP: f64 = 0.3;

/// Where steps of Störmer–Verlet by these shares of [`JUMP`] lead from [`START`], one after the
/// other, and at what time (s): the start and the end of each.
fn ends(shares: &[f64]) -> Vec<(f64, Phase)> {
    let mut ends = vec![(0.0, START)];
    let (mut t, mut z) = ends[0];
    for share in shares {
        let h = share * JUMP;
        (t, z) = (t + h, parts(&StormerVerlet, z, h, h).end);
        ends.push((t, z));
    }
    ends
}

/// A length in steps, with the true minus sign.
fn in_steps(share: f64) -> String {
    format!("{share:.2}").replace('-', "−")
}

/// The substeps of Forest–Ruth in phase space.
fn jump() -> Chart {
    let method = named("forest-ruth");
    let ends = ends(ForestRuth::DRIFTS);
    let truth_at = |t: f64| true_motion(START).at(t);
    let mut chart = phase_plane((-1.9, 0.4), (-0.5, 4.0))
        .height(300.0)
        .series("true orbit", Style::REFERENCE, truth(truth_at(-0.45 * JUMP), 2.15 * JUMP))
        .series("true motion", Style::TRUE_POINT, ends.iter().map(|(t, _)| point(truth_at(*t))))
        .series(title(method), style(method).markers_only(), ends.iter().map(|(_, z)| point(*z)));
    for pair in ends.windows(2) {
        let ends = [pair[0].1, pair[1].1].map(point);
        chart = chart.series("", style(method).arrow(), ends);
    }
    for (t, z) in ends {
        let time = match (t / JUMP * 100.0).round() / 100.0 {
            0.0 => "start".into(),
            1.0 => "h".into(),
            share => format!("{} h", in_steps(share)),
        };
        chart = chart
            .series("", Style::GUIDE, [truth_at(t), z].map(point))
            .note(z.theta, z.omega, time);
    }
    chart
}

/// The substeps of two methods in time, one below the other.
fn lengths() -> Chart {
    let methods =
        [(named("forest-ruth"), ForestRuth::DRIFTS), (named("suzuki-4"), Suzuki4::DRIFTS)];
    let (mut y, mut ticks, mut arrows) = (0.0, Vec::new(), Vec::new());
    for (method, shares) in methods {
        let mut t = 0.0;
        for share in shares {
            y -= 1.0;
            ticks.push((y, in_steps(*share)));
            arrows.push((method, [(t, y), (t + share, y)]));
            t += share;
        }
        // A gap between the methods.
        y -= 0.5;
    }
    let chart = Chart::new(
        Axis::linear("time (steps)").range(-0.5, 1.5),
        Axis::linear("substep (steps)").range(y - 0.1, -0.4).ticks(ticks),
    )
    .height(210.0)
    .vertical(0.0, "start")
    .vertical(1.0, "end");
    arrows.into_iter().fold(chart, |chart, (method, arrow)| {
        chart.series(title(method), style(method).arrow(), arrow)
    })
}

/// The triple jump in phase space, and in time beside Suzuki's five substeps.
pub(super) fn triple_jump(_: &Study, figure: Figure) -> Figure {
    figure.panel(jump()).panel(lengths())
}

// -------------------------------------------------------------------------------------------------
// The area that a method carries
// -------------------------------------------------------------------------------------------------

/// A release from rest and the states around it.
const SQUARE_AT: Place = Place { centre: Phase { theta: 1.0, omega: 0.0 }, size: 0.5 };
/// Points along each of its sides. With twice as many the areas agree in all printed digits and
/// two more.
const SIDE: u32 = 500;
/// Time between two drawings of a shape (s), one step of RK4: about a quarter of a period.
const SPAN: f64 = 0.56;
/// Drawings after the first.
const SPANS: u64 = 3;
/// Force evaluations in a [`SPAN`], the same for each method.
const EVALUATIONS: u64 = 4;

/// A shape of which the first polygon has the others in it, and the axes on which it is carried.
struct Carried<'a> {
    shape: &'a [Polygon],
    place: Place,
    /// Points on the way from each corner to the next.
    pieces: u32,
    /// One radian is drawn about as long as ω₀ rad/s, so that a square looks like one.
    theta: (f64, f64),
    omega: (f64, f64),
    /// Whether the time stands beside each image.
    says_times: bool,
}

impl Carried<'_> {
    /// The figure with a chart for each of the paper's methods.
    fn by_each(&self, figure: Figure) -> Figure {
        let methods = METHODS.iter().copied().filter(|method| in_paper(*method));
        methods.fold(figure.columns(2), |figure, method| figure.panel(self.by(method)))
    }

    /// The shape and its images, each beside what the true motion makes of its outline.
    fn by(&self, method: MethodRef) -> Chart {
        let steps = EVALUATIONS / method.info().force_evaluations;
        let grid = Grid::new(SPAN / steps as f64, SPANS * steps).expect("a positive step");
        let polygon = |polygon: &Polygon| -> Vec<_> {
            self.place.outline(polygon, &PENDULUM, self.pieces).collect()
        };
        let starts: Vec<Vec<_>> = self.shape.iter().map(polygon).collect();
        let outline = &starts[0];
        let images: Vec<_> =
            starts.iter().map(|start| carried(method, &PENDULUM, start, &grid)).collect();
        let area = |n: u64| area(images[0][n as usize].iter().copied());
        let heading = format!("{}: area × {:.2}", title(method), area(grid.steps()) / area(0));
        let mut chart = phase_plane(self.theta, self.omega).height(260.0).heading(heading);
        for start in &starts {
            let points = start.iter().copied().map(point);
            chart = chart.series("start", Style::REFERENCE.filled(), points);
        }
        for n in 1..=SPANS {
            for image in &images {
                let points = image[(n * steps) as usize].iter().copied().map(point);
                chart = chart.series("", style(method).filled().solid(), points);
            }
            let time = n as f64 * SPAN;
            let truth = outline.iter().chain(&outline[..1]);
            let truth: Vec<_> = truth.map(|z| point(true_motion(*z).at(time))).collect();
            let by_height = |a: &&(f64, f64), b: &&(f64, f64)| a.1.abs().total_cmp(&b.1.abs());
            if self.says_times
                && let Some(&outermost) = truth.iter().max_by(by_height)
            {
                let corners = truth.iter().copied().step_by(self.pieces as usize);
                let beside = [outermost].into_iter().chain(corners).collect();
                chart = chart.note_beside(beside, format!("{time:.2} s"));
            }
            chart = chart.series("true motion", Style::REFERENCE, truth);
        }
        chart
    }
}

pub(super) fn area_carried(_: &Study, figure: Figure) -> Figure {
    let square = Carried {
        shape: &[SQUARE],
        place: SQUARE_AT,
        pieces: SIDE,
        theta: (-2.8, 1.5),
        omega: (-6.0, 7.0),
        says_times: true,
    };
    square.by_each(figure)
}

/// Where the cat sits, also in the figure that the reader moves.
const CAT_AT: Place = Place { centre: Phase { theta: 0.9, omega: 0.0 }, size: 0.5 };
/// Points on the way from each of its corners to the next: with twice as many the areas agree in
/// all printed digits and one more.
const CAT_PIECES: u32 = 8;

pub(super) fn cat(_: &Study, figure: Figure) -> Figure {
    let cat = Carried {
        shape: CAT,
        place: CAT_AT,
        pieces: CAT_PIECES,
        theta: (-3.2, 1.9),
        omega: (-6.2, 6.8),
        says_times: false,
    };
    cat.by_each(figure)
}

// -------------------------------------------------------------------------------------------------
// The curve that a method follows
// -------------------------------------------------------------------------------------------------

pub(super) fn level_curves(_: &Study, figure: Figure) -> Figure {
    let figure = figure.columns(2);
    let curves = [
        ("true orbit", Style::REFERENCE),
        ("level curve of its own energy", Style::REFERENCE.dashed()),
    ];
    level_curves::own().into_iter().fold(figure, |figure, run| {
        let label = title(run.method);
        let heading = format!("{label}, h = {} s", run.step);
        let chart = followed(run, (1.25, 3.5), curves, label);
        figure.panel(chart.height(240.0).heading(heading))
    })
}

/// Symplectic Euler's points, and the level curve of H̃ to the orders 0, 1 and 7.
pub(super) fn tilted_curve(_: &Study, figure: Figure) -> Figure {
    let run = level_curves::tilted();
    let label = format!("{}, h = {} s", title(run.method), run.step);
    let curves = [
        ("true orbit, H", Style::REFERENCE),
        ("one term", Style::GUIDE),
        ("modified energy, 7 terms", Style::REFERENCE.dashed()),
    ];
    figure.panel(followed(run, (1.3, 3.6), curves, &label).height(330.0))
}

/// The curves of a run under these names, as far as this corner, and the points of its method.
fn followed<const N: usize>(
    run: level_curves::Run,
    (theta, omega): (f64, f64),
    curves: [(&str, Style); N],
    label: &str,
) -> Chart {
    let chart = phase_plane((-theta, theta), (-omega, omega));
    let points = (label, style(run.method).markers_only());
    let all = curves.into_iter().zip(run.curves).chain([(points, run.points)]);
    all.fold(chart, |chart, ((label, style), points)| {
        chart.series(label, style, points.into_iter().map(point))
    })
}
