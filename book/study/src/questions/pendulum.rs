//! Questions of "The pendulum".

use std::f64::consts::PI;

use pendula::arithmetic::sine::{cos, sin};
use pendula::exact::period;
use pendula::{Grid, Motion, Pendulum, Phase, StormerVerlet, integrate};
use pendula_dynamics::shapes;

use super::{Compute, Truth, Within};

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] = &[
    ("pendulum-longer-rod", longer_rod),
    ("pendulum-area", area),
    ("pendulum-near-the-top", near_the_top),
];

const PENDULUM: Pendulum = Pendulum::PAPER;

/// The step (s) with which a rod of 4 m is, after as many steps, at the angle of a rod of 1 m in
/// steps of 0.01 s.
fn longer_rod() -> Truth {
    const STEP: f64 = 0.01;
    const LENGTH: f64 = 4.0;
    let long = Pendulum::new(PENDULUM.gravity(), LENGTH, PENDULUM.mass()).expect("a pendulum");
    let angle = |pendulum: &Pendulum, step: f64| {
        let grid = Grid::new(step, 50).expect("a grid");
        integrate(pendulum, &StormerVerlet, Phase::at_rest(1.0), &grid).theta
    };
    let wanted = angle(&PENDULUM, STEP);
    // 50 steps are less than half a swing, so that a longer step leads to a smaller angle.
    let (mut low, mut high) = (0.1 * STEP, 4.0 * STEP);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if angle(&long, middle) > wanted {
            low = middle;
        } else {
            high = middle;
        }
    }
    let right = 0.5 * (low + high);
    let factor = right / STEP;
    Truth::Number {
        right,
        // Exactly twice: nothing has to be rounded.
        within: Within::Percent(1.0),
        mistakes: vec![("same", STEP), ("length", STEP * LENGTH), ("inverse", STEP / factor)],
    }
}

/// What a minute of the exact motion makes of a small disc of phase space.
fn area() -> Truth {
    const CORNERS: u32 = 1_000;
    let frequency = PENDULUM.small_angle_frequency();
    let on_circle = |n: u32| {
        let angle = 2.0 * PI * f64::from(n) / f64::from(CORNERS);
        Phase { theta: 1.0 + 0.1 * cos(angle), omega: 0.1 * frequency * sin(angle) }
    };
    let circle: Vec<Phase> = (0..CORNERS).map(on_circle).collect();
    let after = |z: &Phase| Motion::new(&PENDULUM, *z).expect("a swing").at(60.0);
    let image: Vec<Phase> = circle.iter().map(after).collect();
    // How far the farthest corner is from the first.
    let length = |corners: &[Phase]| {
        let from_first = |z: &Phase| {
            let (theta, q) = (z.theta - corners[0].theta, (z.omega - corners[0].omega) / frequency);
            libm::sqrt(theta * theta + q * q)
        };
        corners.iter().map(from_first).fold(0.0, libm::fmax)
    };
    let grown = shapes::area(image.iter().copied()) / shapes::area(circle.iter().copied());
    let keeps_area = (grown - 1.0).abs() < 0.01;
    let keeps_shape = length(&image) < 1.1 * length(&circle);
    Truth::Which(vec![
        ("shrinks", grown < 0.9),
        ("grows", grown > 1.1),
        ("rigid", keeps_area && keeps_shape),
        ("area", keeps_area && !keeps_shape),
    ])
}

/// What a tenth of the distance from the top does to the period.
fn near_the_top() -> Truth {
    let swing = |degrees: f64| period(&PENDULUM, PI * (1.0 - degrees / 180.0)).expect("a swing");
    let [first, second, third] = [1.0, 0.1, 0.01].map(swing);
    let ratio = third / second;
    let is_near = |expected: f64| libm::log(ratio / expected).abs() < 0.1;
    let added = third - second;
    let adds_the_same = added > 0.1 * first && (added / (second - first) - 1.0).abs() < 0.01;
    Truth::Which(vec![
        ("ten", is_near(10.0)),
        ("seconds", adds_the_same),
        ("nothing", is_near(1.0)),
    ])
}
