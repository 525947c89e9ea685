//! What a method does in phase space: the parts of its step, the area that it carries, the curve
//! that it follows.

use pendula::exact::Motion;
use pendula::methods::{ForwardEuler, Rk4, StormerVerlet, SymplecticEuler};
use pendula::{AnyMethod, Grid, METHODS, Method, Pendulum, Phase};

use super::{Drawing, style, title};
use crate::charts::{Axis, Chart, Figure, Style};
use crate::experiments::area::carried;
use crate::experiments::parts::{Kind, Noting, Parts};
use crate::experiments::shapes::{CAT, Place, Polygon, SQUARE, area};
use crate::experiments::{MethodRef, Study, in_paper, level_curves};

pub(super) const FIGURES: &[Drawing] = &[
    Drawing {
        name: "stencil_forward_euler",
        caption: "One step of forward Euler in phase space. The arrow is tangent to the orbit, and \
                  so it leaves it to the outside.",
        draw: stencil_forward_euler,
    },
    Drawing {
        name: "stencil_symplectic_euler",
        caption: "One step of symplectic Euler, from the same point as forward Euler's. The kick \
                  leaves the angle alone, the drift the velocity.",
        draw: stencil_symplectic_euler,
    },
    Drawing {
        name: "stencil_stormer_verlet",
        caption: "One step of Störmer–Verlet, from the same point as symplectic Euler's. With half \
                  of the kick at either end it lands far closer to the truth.",
        draw: stencil_stormer_verlet,
    },
    Drawing {
        name: "stencil_rk4",
        caption: "One step of RK4, from the same point as forward Euler's, and longer, as its \
                  error could not be seen otherwise. Each slope is an arrow a quarter of a step \
                  long, where it is looked at; the dotted lines lead there.",
        draw: stencil_rk4,
    },
    Drawing {
        name: "area",
        caption: "A square of initial conditions carried round the bottom by each method, in steps \
                  of h = 0.14 s, and drawn every 0.56 s. RK4's steps are of 0.56 s, as each costs \
                  it four force evaluations. None keeps the shape, and not even the truth does; \
                  the two symplectic methods keep the area, and so does the truth.",
        draw: area_carried,
    },
    Drawing {
        name: "cat",
        caption: "A cat in phase space, made of nearly a thousand starts, carried round the bottom \
                  by each method. RK4 takes steps four times as long, as each costs it four force \
                  evaluations. With forward Euler the cat grows to more than twice its area, with \
                  RK4 it loses a third; with the symplectic methods it is bent as by the true \
                  motion, and stays as large as it was.",
        draw: cat,
    },
    Drawing {
        name: "tilted_curve",
        caption: "Symplectic Euler from rest at 1 rad, in steps of 0.25 s: its points, the true \
                  orbit, and the level curve of H̃ built from more and more terms of its series. \
                  The first term tilts the curve; the others bring it onto the points.",
        draw: tilted,
    },
    Drawing {
        name: "level_curves",
        caption: "Large steps of the two symplectic methods. Their points leave the true orbit at \
                  once, and stay on the level curve of their own energy.",
        draw: level_curves,
    },
];

pub(super) const PENDULUM: Pendulum = Pendulum::PAPER;

pub(super) fn point(z: Phase) -> (f64, f64) {
    (z.theta, z.omega)
}

pub(super) fn true_motion(start: Phase) -> Motion {
    Motion::new(&PENDULUM, start).expect("a finite start")
}

fn period_of(start: Phase) -> f64 {
    true_motion(start).period().expect("it does not stop at the top")
}

/// The true motion from `start` for the time `duration` (s), in enough points for a smooth curve.
pub(super) fn truth(start: Phase, duration: f64) -> impl Iterator<Item = (f64, f64)> {
    const POINTS: u32 = 400;
    let motion = true_motion(start);
    let time = move |n: u32| duration * (f64::from(n) / f64::from(POINTS));
    (0..=POINTS).map(move |n| point(motion.at(time(n))))
}

// -------------------------------------------------------------------------------------------------
// One step taken apart
// -------------------------------------------------------------------------------------------------

/// On the way down to the bottom: neither the velocity nor the force is zero or at its maximum.
pub(super) const START: Phase = Phase { theta: -1.2, omega: 1.0 };
/// A sixth of a period (s): long enough to show each part of the step.
const STEP: f64 = 0.35;
/// RK4's step (s): with the step of the others its end could hardly be told from the true
/// motion's.
const RK4_STEP: f64 = 0.55;

/// A step taken apart, each slope followed for the time `along` (s).
pub(super) fn parts<M>(method: &M, start: Phase, h: f64, along: f64) -> Parts<Phase>
where
    M: for<'a> Method<Noting<'a, Pendulum>>,
{
    Parts::of(method, &PENDULUM, start, h, along).expect("no more parts than can be drawn")
}

/// The true orbit and the ends of the step; the parts of the step are drawn over it.
fn over_the_orbit(method: MethodRef, step: f64, end: Phase) -> Chart {
    Chart::new(Axis::linear("θ (rad)").range(-1.6, 1.6), Axis::linear("ω (rad/s)").range(0.0, 5.0))
        .height(320.0)
        .series("true orbit", Style::REFERENCE, truth(START, period_of(START)))
        .series(
            format!("true motion after {step} s"),
            Style::TRUE_POINT,
            [point(true_motion(START).at(step))],
        )
        .series(title(method), style(method).markers_only(), [point(START), point(end)])
}

/// The chart with the parts of a step as arrows and their names beside them: kicks and drifts of a
/// step of [`STEP`], or slopes by their number.
fn with_arrows(
    chart: Chart,
    method: MethodRef,
    parts: Parts<Phase>,
    slope: impl Fn(usize) -> String,
) -> Chart {
    parts.in_order().enumerate().fold(chart, |chart, (i, part)| {
        let share = |kind: &str| match part.duration / STEP {
            1.0 => kind.to_string(),
            0.5 => format!("½ {kind}"),
            share => format!("{share:.2} {kind}"),
        };
        let name = match part.kind {
            Kind::Slope => slope(i + 1),
            Kind::Kick => share("kick"),
            Kind::Drift => share("drift"),
        };
        let (from, to) = (part.from, part.to);
        let (theta, omega) = (0.5 * (from.theta + to.theta), 0.5 * (from.omega + to.omega));
        chart.series("", style(method).arrow(), [from, to].map(point)).note(theta, omega, name)
    })
}

/// The chart of a step of [`STEP`].
fn step_of<M>(method: &'static M) -> Chart
where
    M: AnyMethod + for<'a> Method<Noting<'a, Pendulum>>,
{
    let parts = parts(method, START, STEP, STEP);
    let chart = over_the_orbit(method, STEP, parts.end);
    with_arrows(chart, method, parts, |_| "tangent".into())
}

fn stencil_forward_euler(_: &Study) -> Figure {
    Figure::new(
        "One step of forward Euler",
        "The upper half of a swing's orbit in phase space, an arch. From a point on its left flank \
         a straight arrow, tangent to the arch, ends far above it, where the true motion over the \
         same time stays on the arch.",
    )
    .panel(step_of(&ForwardEuler))
}

fn stencil_symplectic_euler(_: &Study) -> Figure {
    Figure::new(
        "One step of symplectic Euler",
        "The upper half of a swing's orbit in phase space, an arch. From a point on its left flank \
         a vertical arrow, the kick, leads far above the arch; from its tip a horizontal arrow, \
         the drift, leads to the right.",
    )
    .panel(step_of(&SymplecticEuler))
}

fn stencil_stormer_verlet(_: &Study) -> Figure {
    Figure::new(
        "One step of Störmer–Verlet",
        "The upper half of a swing's orbit in phase space, an arch. From a point on its left flank \
         a vertical arrow, half a kick; from its tip a horizontal one, the drift; from there a \
         vertical one, the other half kick, which ends close to the arch and to where the true \
         motion is.",
    )
    .panel(step_of(&StormerVerlet))
}

fn stencil_rk4(_: &Study) -> Figure {
    /// How long the arrows are, as a share of the step.
    const SHARE: f64 = 0.25;
    let method: MethodRef = &Rk4;
    let parts = parts(&Rk4, START, RK4_STEP, SHARE * RK4_STEP);
    let mut chart = over_the_orbit(method, RK4_STEP, parts.end);
    for slope in parts.in_order().skip(1) {
        chart = chart.series("", Style::GUIDE, [START, slope.from].map(point));
    }
    Figure::new(
        "One step of RK4",
        "The upper half of a swing's orbit in phase space, an arch. Four arrows: the first at a \
         point on its left flank, along the arch; the others at the ends of dotted lines from \
         there, the second outside the arch, half a step along the first; the third just inside \
         it, half a step along the second; the fourth further on, a whole step along the third, \
         and turned downwards. The end of the step lies just inside the arch, close to where the \
         true motion is.",
    )
    .panel(with_arrows(chart, method, parts, |i| format!("k_{{{i}}}")))
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
        let axes = (
            Axis::linear("θ (rad)").range(self.theta.0, self.theta.1),
            Axis::linear("ω (rad/s)").range(self.omega.0, self.omega.1),
        );
        let mut chart = Chart::new(axes.0, axes.1).height(260.0).heading(heading);
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

fn area_carried(_: &Study) -> Figure {
    let square = Carried {
        shape: &[SQUARE],
        place: SQUARE_AT,
        pieces: SIDE,
        theta: (-2.8, 1.5),
        omega: (-6.0, 7.0),
        says_times: true,
    };
    square.by_each(Figure::new(
        "The area that a method carries",
        "Four charts of phase space, one a method. In each a square to the right of the middle is \
         carried clockwise around it, and drawn three more times, together with the outline of \
         what the true motion makes of it. With forward Euler it moves outwards and has twice its \
         area in the end, drawn out to a long crescent. With RK4 it moves inwards and shrinks to \
         two thirds. With symplectic Euler it lags or leads and is slanted, with Störmer–Verlet it \
         hardly differs from the truth; both keep its area.",
    ))
}

/// Where the cat sits, also in the figure that the reader moves.
const CAT_AT: Place = Place { centre: Phase { theta: 0.9, omega: 0.0 }, size: 0.5 };
/// Points on the way from each of its corners to the next: with twice as many the areas agree in
/// all printed digits and one more.
const CAT_PIECES: u32 = 8;

fn cat(_: &Study) -> Figure {
    let cat = Carried {
        shape: CAT,
        place: CAT_AT,
        pieces: CAT_PIECES,
        theta: (-3.2, 3.2),
        omega: (-7.5, 7.5),
        says_times: false,
    };
    cat.by_each(Figure::new(
        "A cat that four methods carry through phase space",
        "Four charts of phase space, one a method. In each a cat sits to the right of the middle, \
         is carried clockwise around it, and is drawn three more times, bent more and more, \
         together with the outline of what the true motion makes of it. With forward Euler it \
         moves outwards and grows. With RK4 it moves inwards and shrinks. With symplectic Euler \
         it is slanted, with Störmer–Verlet it hardly differs from the truth; both keep its area.",
    ))
}

// -------------------------------------------------------------------------------------------------
// The curve that a method follows
// -------------------------------------------------------------------------------------------------

fn level_curves(_: &Study) -> Figure {
    let figure = Figure::new(
        "The curve that a symplectic method follows",
        "Two charts of phase space, each with the true orbit, an oval, and a dashed curve on which \
         all points of the method lie. For symplectic Euler the dashed curve is a slanted oval, \
         outside the true one at the upper right and lower left and inside it at the upper left \
         and lower right. For Störmer–Verlet it is an upright oval, lower than the true one and as \
         wide.",
    )
    .columns(2);
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
fn tilted(_: &Study) -> Figure {
    let run = level_curves::tilted();
    let label = format!("{}, h = {} s", title(run.method), run.step);
    let curves = [
        ("true orbit, H", Style::REFERENCE),
        ("H̃, one term", Style::GUIDE),
        ("H̃, 7 terms", Style::REFERENCE.dashed()),
    ];
    Figure::new(
        "The tilted curve of symplectic Euler",
        "A chart of phase space with three ovals about the middle and many points. The true orbit \
         is upright. The points lie on an oval that is slanted to the upper right and lower left: \
         that of H̃ with seven terms. With one term alone the oval is slanted in the same way, and \
         stands a little off the points.",
    )
    .panel(followed(run, (1.3, 3.6), curves, &label).height(330.0))
}

/// The curves of a run under these names, as far as this corner, and the points of its method.
fn followed<const N: usize>(
    run: level_curves::Run,
    (theta, omega): (f64, f64),
    curves: [(&str, Style); N],
    label: &str,
) -> Chart {
    let chart = Chart::new(
        Axis::linear("θ (rad)").range(-theta, theta),
        Axis::linear("ω (rad/s)").range(-omega, omega),
    );
    let points = (label, style(run.method).markers_only());
    let all = curves.into_iter().zip(run.curves).chain([(points, run.points)]);
    all.fold(chart, |chart, ((label, style), points)| {
        chart.series(label, style, points.into_iter().map(point))
    })
}
