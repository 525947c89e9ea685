//! The figures that a reader moves run the library, and the study's own formulas: what the lab
//! writes into the shared points, compared with both.

use pendula::methods::{ForwardEuler, Rk4, StormerVerlet, SymplecticEuler};
use pendula::{Grid, METHODS, Motion, Pendulum, Phase, methods::Info};
use pendula_dynamics::parts::Parts;
use pendula_dynamics::shapes::{CAT, Place, SQUARE, area};
use pendula_study::theory::Dimensionless;
use pendula_study::theory::symplectic_euler::{correction_to_order, level_curve_to_order};

use crate::labs::{Lab, assert_bits, labs};

/// Pendulum and step: g, L, Δt. L ≠ 1 and ω₀ ≠ 1.
type Scene = (f64, f64, f64);
const SCENES: [Scene; 3] = [(9.81, 1.0, 0.1), (1.62, 2.5, 0.02), (9.81, 0.7, 0.35)];

const STARTS: [Phase; 4] = [
    Phase { theta: 1.0, omega: 0.0 },
    Phase { theta: -1.2, omega: 1.0 },
    // Over the top, and where the force is zero.
    Phase { theta: 2.9, omega: 5.0 },
    Phase { theta: 0.0, omega: -2.0 },
];

fn pendulum((g, length, _): Scene) -> Pendulum {
    Pendulum::new(g, length, 1.0).unwrap()
}

fn set_scene(lab: &mut dyn Lab, method: &str, (g, length, h): Scene, z: Phase) {
    let index = METHODS.iter().position(|known| known.info().name == method).unwrap() as u32;
    assert_eq!(lab.scene(index, g, length, z.theta, z.omega, h), 1);
}

#[track_caller]
fn assert_same(seen: &[Phase], expected: &[Phase], what: &str) {
    assert_eq!(seen.len(), expected.len(), "{what}");
    for (i, (seen, expected)) in seen.iter().zip(expected).enumerate() {
        assert_bits(seen.theta, expected.theta, || format!("{what}, θ of point {i}"));
        assert_bits(seen.omega, expected.omega, || format!("{what}, ω of point {i}"));
    }
}

/// Each method moves each point as a run from there: one step, several, and none; and a run visits
/// the states of the library's.
///
/// Catches: the scene's start for the point's own, a point left out or moved twice, a carry handed
/// from one point to the next, a step too many, a method under another's number.
#[test]
fn points_are_carried_by_the_librarys_steps() {
    for lab in &mut labs() {
        let mut compared = 0;
        for method in METHODS {
            let name = method.info().name;
            for scene in SCENES {
                set_scene(lab.as_mut(), name, scene, STARTS[1]);
                for steps in [0, 1, 7] {
                    let grid = Grid::new(scene.2, steps).unwrap();
                    let end = |z: &Phase| method.end(&pendulum(scene), *z, &grid);
                    let expected: Vec<_> = match steps {
                        0 => STARTS.to_vec(),
                        _ => STARTS.iter().map(end).collect(),
                    };
                    lab.write(&[STARTS, STARTS].concat());
                    lab.carry(steps as u32, 4);
                    let what = format!("{name}, {steps} steps");
                    assert_same(&lab.points(4), &expected, &what);
                    // The others are where they were.
                    assert_same(&lab.points(8)[4..], &STARTS, &what);
                    compared += 4;
                }
                let mut run = Vec::new();
                let mut keep = |_: u64, _: f64, z: Phase| run.push(z);
                let grid = Grid::new(scene.2, 11).unwrap();
                method.run(&pendulum(scene), STARTS[1], &grid, &mut keep);
                assert_eq!(lab.orbit(12), 12);
                assert_same(&lab.points(12), &run, &format!("a run of {name}"));
            }
        }
        assert_eq!(compared, 36 * METHODS.len());
    }
}

/// Catches: another time than was asked for, the exact motion from the scene's start.
#[test]
fn points_follow_the_exact_motion() {
    for lab in &mut labs() {
        for scene in SCENES {
            set_scene(lab.as_mut(), "rk4", scene, STARTS[0]);
            for t in [0.0, 0.35, -2.0, 12.5] {
                let exact = |z: &Phase| Motion::new(&pendulum(scene), *z).unwrap().at(t);
                lab.write(&STARTS);
                lab.follow(t, 4);
                let expected: Vec<_> = STARTS.iter().map(exact).collect();
                assert_same(&lab.points(4), &expected, &format!("{t} s"));
            }
        }
    }
}

/// The lab counts time in steps and the study in seconds: the states of a step differ by a few
/// roundings of what they are the sum of, which is below 16 here, 2e-15 each.
const ROUNDINGS: f64 = 1e-14;

/// The parts of a step are those that the study draws, as shares of the step, in order; the slopes
/// last a whole step. And they lead to the end that the program prints, to the bit.
///
/// Catches: what belongs to the next step drawn in this one, a part lost, kick and drift exchanged,
/// a slope at another place, half a kick as a whole one.
#[test]
fn the_parts_of_a_step_are_those_of_the_figure() {
    for lab in &mut labs() {
        for scene in SCENES {
            let (pendulum, h) = (pendulum(scene), scene.2);
            for z in STARTS {
                let methods = [
                    (ForwardEuler.info(), Parts::of(&ForwardEuler, &pendulum, z, h, h)),
                    (SymplecticEuler.info(), Parts::of(&SymplecticEuler, &pendulum, z, h, h)),
                    (StormerVerlet.info(), Parts::of(&StormerVerlet, &pendulum, z, h, h)),
                    (Rk4.info(), Parts::of(&Rk4, &pendulum, z, h, h)),
                ];
                for (method, expected) in methods {
                    set_scene(lab.as_mut(), method.name, scene, z);
                    let count = lab.step_parts();
                    let expected = expected.expect("a few parts");
                    let expected: Vec<_> = expected.in_order().collect();
                    assert_eq!(count as usize, expected.len(), "{}", method.name);
                    let points = lab.points(3 * count);
                    for (part, expected) in points.chunks_exact(3).zip(expected) {
                        let (kind, share) = (expected.kind as u8, expected.duration / h);
                        assert_eq!((part[0].theta, part[0].omega), (f64::from(kind), share));
                        for (seen, expected) in [(part[1], expected.from), (part[2], expected.to)] {
                            let off = (seen.theta - expected.theta, seen.omega - expected.omega);
                            let off = off.0.abs().max(off.1.abs());
                            assert!(off < ROUNDINGS, "{}: {seen:?}, {expected:?}", method.name);
                        }
                    }
                    if method.symplectic {
                        let grid = Grid::new(h, 1).unwrap();
                        let end = METHODS.iter().find(|known| known.info().name == method.name);
                        let end = end.unwrap().end(&pendulum, z, &grid);
                        assert_same(&points[points.len() - 1..], &[end], method.name);
                    }
                }
            }
        }
        // Of a method that has no picture of its step.
        set_scene(lab.as_mut(), "ruth-3", SCENES[0], STARTS[0]);
        assert_eq!(lab.step_parts(), 0);
    }
}

/// The level curve of H̃ and how far it strays along a run are the study's, bit for bit, to each
/// order of the series.
///
/// Catches: a series cut at another order, a step that is not the scene's, an energy that is
/// compared with another than the first, the mass or the length left out.
#[test]
fn the_tilted_curve_is_the_studys() {
    for lab in &mut labs() {
        for scene in SCENES {
            let (pendulum, h, theta_0) = (pendulum(scene), scene.2.min(0.2), 1.1);
            set_scene(
                lab.as_mut(),
                "symplectic-euler",
                (scene.0, scene.1, h),
                Phase::at_rest(theta_0),
            );
            for order in 0..=7 {
                lab.level_curve(order as u32, 100);
                let curve: Vec<_> =
                    level_curve_to_order(order, &pendulum, theta_0, h, 100).take(100).collect();
                assert_same(&lab.points(100), &curve, &format!("order {order}"));

                assert_eq!(lab.orbit(50), 50);
                let energy = |z: &Phase| {
                    let z = Dimensionless::from_phase(&pendulum, *z);
                    let x = pendulum.small_angle_frequency() * h;
                    pendulum.depth() * (z.energy() + correction_to_order(order, z, x))
                };
                let run = lab.points(50);
                let off =
                    run.iter().map(|z| (energy(z) - energy(&run[0])).abs()).fold(0.0, f64::max);
                let strays = lab.strays(order as u32, 50);
                assert_bits(strays, off, || format!("how far order {order} strays"));
            }
        }
    }
}

/// Catches: a shape with another centre or size, the polygons of the cat in another order, an area
/// without its sign.
#[test]
fn the_shapes_and_their_areas_are_the_studys() {
    for lab in &mut labs() {
        for scene in SCENES {
            let (pendulum, place) = (pendulum(scene), Place { centre: STARTS[1], size: 0.6 });
            set_scene(lab.as_mut(), "rk4", scene, place.centre);
            for (which, polygon) in [SQUARE].iter().chain(CAT).enumerate() {
                let outline: Vec<_> = place.outline(polygon, &pendulum, 5).collect();
                let count = lab.shape(which as u32, place.size, 5);
                assert_same(&lab.points(count), &outline, &format!("shape {which}"));
                let seen = lab.area(count);
                assert_bits(seen, area(outline), || format!("the area of shape {which}"));
                assert!(seen > 0.0, "shape {which} is clockwise");
            }
            assert_eq!(lab.shape(1 + CAT.len() as u32, 0.6, 5), 0);
        }
    }
}

/// Catches: a number from the page that leads to a trap, or to memory that is not the points'.
#[test]
fn what_cannot_be_computed_is_zero_or_nan() {
    for lab in &mut labs() {
        let room = lab.points_room();
        let zeros = vec![Phase { theta: 0.0, omega: 0.0 }; room as usize];
        let nothing = |lab: &mut dyn Lab, count: u32| {
            lab.carry(3, count);
            lab.follow(1.0, count);
            lab.level_curve(7, count);
            assert_eq!(lab.orbit(count), 0);
            assert!(lab.area(count).is_nan());
            assert!(lab.strays(1, count).is_nan());
            assert_same(&lab.points(room), &zeros, "what was not written");
        };
        // Before there is a scene, and of one that there is not.
        nothing(lab.as_mut(), 4);
        assert_eq!(lab.scene(0, -1.0, 1.0, 1.0, 0.0, 0.1), 0);
        nothing(lab.as_mut(), 4);
        assert_eq!(lab.shape(0, 0.6, 5), 0);
        assert_eq!(lab.step_parts(), 0);
        // More points than there are.
        set_scene(lab.as_mut(), "rk4", SCENES[0], STARTS[0]);
        nothing(lab.as_mut(), room + 1);
        // A start and a step that the library refuses.
        lab.write(&[STARTS[0], Phase { theta: f64::NAN, omega: 0.0 }]);
        lab.carry(1, 2);
        let seen = lab.points(2);
        assert!(seen[0].theta.is_finite() && seen[1].theta.is_nan() && seen[1].omega.is_nan());
        set_scene(lab.as_mut(), "rk4", (9.81, 1.0, -0.1), STARTS[0]);
        assert_eq!(lab.step_parts(), 0);
        // More pieces than there is room for.
        set_scene(lab.as_mut(), "rk4", SCENES[0], STARTS[0]);
        assert_eq!(lab.shape(1, 0.6, 1000), room);
        assert_eq!(lab.shape(1, 0.6, 0), 0);
    }
}
