//! The source against the library, compiled for this machine. The compiled file is compared in
//! `book/lab/tests/compiled/figures.rs`, which cannot see a source that has moved on from it.

use pendula::{Grid, METHODS};

use super::*;
use crate::parts::{MOST, Part, parts};
use crate::shapes::{Place, SQUARE};
use crate::trajectory::Kind;

const START: Phase = Phase { theta: -1.2, omega: 1.0 };

/// L ≠ 1 and ω₀ ≠ 1.
fn scene(method: usize, step: f64) -> Setup {
    let pendulum = Pendulum::new(9.81, 0.7, 1.0).unwrap();
    Setup { method, pendulum, kind: Kind::Damped(0.0), start: START, step }
}

/// Catches: source that has changed and was not compiled, such as points that are carried from the
/// scene's start, or by a step more or less.
#[test]
fn points_are_carried_by_the_librarys_steps() {
    for (index, method) in METHODS.iter().enumerate() {
        let (scene, starts) = (scene(index, 0.1), [[1.0, 0.0], [2.9, 5.0], [0.0, -2.0]]);
        let mut points = starts;
        carry(&scene, 5, &mut points);
        let grid = Grid::new(scene.step, 5).unwrap();
        let ends = starts.map(|start| point(method.end(&scene.pendulum, phase(start), &grid)));
        assert_eq!(points, ends, "{}", method.info().name);
        carry(&scene, 0, &mut points);
        assert_eq!(points, ends);
    }
}

/// Half a kick, a drift, half a kick; four slopes; and none for a method without a picture.
///
/// Catches: the kick for the next step among the parts of this one, parts in the order in which
/// they are found from the end, a method without a picture that is given another's.
#[test]
fn a_step_has_its_own_parts() {
    let of = |name: &str| {
        let index = METHODS.iter().position(|method| method.info().name == name).unwrap();
        let mut taken = [Part::NONE; MOST];
        let count = parts(&scene(index, 0.3), &mut taken);
        taken[..count].iter().map(|part| (part.kind as u8, part.share)).collect::<Vec<_>>()
    };
    assert_eq!(of("forward-euler"), [(0, 1.0)]);
    assert_eq!(of("symplectic-euler"), [(1, 1.0), (2, 1.0)]);
    assert_eq!(of("stormer-verlet"), [(1, 0.5), (2, 1.0), (1, 0.5)]);
    assert_eq!(of("rk4"), [(0, 1.0); 4]);
    assert_eq!(of("gauss-4"), []);
}

/// The run is on the level curve of H̃: with each term its energy strays less. H̃ of order 0 is H,
/// for which two releases from rest say that the unit is J: m g L (1 − cos θ).
///
/// Catches: an energy in units of m g L, the step left out of the series, a stray measured from
/// another point than the first.
#[test]
fn the_run_strays_less_with_each_term() {
    let scene = Setup { start: Phase::at_rest(1.0), ..scene(1, 0.05) };
    let mut run = [[0.0; 2]; 60];
    assert_eq!(orbit(&scene, &mut run), 60);
    let off: Vec<f64> = [0, 1, 3, 5, 7].map(|order| strays(order, &scene, &run)).to_vec();
    assert!(off.windows(2).all(|pair| pair[1] < 0.3 * pair[0]), "{off:?}");
    let rest = |theta: f64| [theta, 0.0];
    let expected = 9.81 * 0.7 * (libm::cos(0.5) - libm::cos(1.0));
    let seen = strays(0, &scene, &[rest(1.0), rest(0.5)]);
    assert!((seen / expected - 1.0).abs() < 1e-14, "{seen} for {expected}");
}

/// Catches: a curve that is not closed, or through another start; a shape that is cut off where
/// there is room.
#[test]
fn what_is_written_fills_the_points() {
    let scene = Setup { start: Phase::at_rest(1.0), ..scene(1, 0.1) };
    let mut curve = [[f64::NAN; 2]; 9];
    level_curve(7, &scene, &mut curve);
    assert!(curve.iter().flatten().all(|number| number.is_finite()));
    let place = Place { centre: START, size: 0.1 };
    let mut square = [[0.0; 2]; 16];
    assert_eq!(write(&mut square, place.outline(SQUARE, &scene.pendulum, 4)), 16);
    let expected = 0.1 * 0.1 * scene.pendulum.small_angle_frequency();
    // A sum of 16 products.
    assert!((area(&square) / expected - 1.0).abs() < 1e-13);
    follow(&scene.pendulum, 0.0, &mut square[..1]);
    let off = (square[0][0] - (START.theta - 0.05)).abs();
    assert!(off < 1e-15, "{off:e}");
}
