//! The image of a square of phase space: its measured area against the determinants of the steps.

use pendula::{AnyMethod, Grid, METHODS, Motion, Pendulum, Phase, method_named};
use pendula_judge::properties::area::{AREA_TOLERANCE as DETERMINANT, area_defect};
use pendula_study::experiments::carried;
use pendula_study::experiments::shapes::{self, CAT, Place};
use quadrature::clenshaw_curtis::integrate;

/// L ≠ 1 and ω₀ ≠ 1.
fn pendulum() -> Pendulum {
    Pendulum::new(9.81, 1.3, 0.7).unwrap()
}

const SQUARE: Place = Place { centre: Phase { theta: 1.0, omega: 0.4 }, size: 0.3 };
const SIDE: u32 = 200;

fn grid() -> Grid {
    grid_of(0.2)
}

fn grid_of(step: f64) -> Grid {
    Grid::new(step, 6).unwrap()
}

fn area(corners: &[Phase]) -> f64 {
    shapes::area(corners.iter().copied())
}

/// The ratio of the areas of image and square, as polygons of `side` points a side.
fn ratio_of_polygons(method: &str, side: u32, grid: &Grid) -> f64 {
    let method = method_named(method).unwrap();
    let outline: Vec<_> = SQUARE.outline(shapes::SQUARE, &pendulum(), side).collect();
    let images = carried(method, &pendulum(), &outline, grid);
    area(&images[6]) / area(&images[0])
}

/// The same, with the area between chords and arcs, which falls as the inverse square of the number
/// of points, removed by extrapolation.
fn measured_ratio(method: &str, grid: &Grid) -> f64 {
    let ratio = |side| ratio_of_polygons(method, side, grid);
    let (coarse, fine) = (ratio(SIDE), ratio(2 * SIDE));
    fine + (fine - coarse) / 3.0
}

/// The product of the determinants along each path, averaged over the square: the area of its image
/// over its own.
fn ratio_by_determinants(method: &dyn AnyMethod, grid: &Grid) -> f64 {
    let (pendulum, h) = (pendulum(), grid.step());
    let frequency = pendulum.small_angle_frequency();
    let one_step = Grid::new(h, 1).unwrap();
    let product = |u: f64, v: f64| {
        let mut z = Phase {
            theta: SQUARE.centre.theta + SQUARE.size * u,
            omega: SQUARE.centre.omega + SQUARE.size * frequency * v,
        };
        (0..grid.steps()).fold(1.0, |product, _| {
            let determinant = 1.0 + area_defect(method, &pendulum, z, h);
            z = method.end(&pendulum, z, &one_step);
            product * determinant
        })
    };
    let along = |v: f64| integrate(|u| product(u, v), -0.5, 0.5, 1e-9).integral;
    integrate(along, -0.5, 0.5, 1e-9).integral
}

/// Each of the six determinants is measured to twice `DETERMINANT`, as h² g/L is 0.3 here and not
/// 0.1, and the product of the others is at most 3. The error of the chords, 1e-7 before the
/// extrapolation, is then of the next order, its square.
const TOLERANCE: f64 = 6.0 * 2.0 * 3.0 * DETERMINANT;

/// The smallest change of area of the paper's methods in these six steps is RK4's, a thousandth.
/// The higher the order, the longer the steps needed to show a change: beyond order 4 it is more
/// than a hundred times the tolerance in six steps of 0.4 s, and at order 24 in six of 0.5 s. The
/// tolerance grows in proportion to h² g/L.
///
/// Catches: the ratio of another method or another number of steps, or its inverse; a polygon whose
/// points are out of order; an image taken at the wrong step.
fn the_image_of_a_square_is_as_large_as_the_determinants_say(method: &dyn AnyMethod) {
    let info = method.info();
    let changed = |step: f64| {
        let (grid, tolerance) = (grid_of(step), TOLERANCE * (step / 0.2).powi(2));
        let (measured, expected) =
            (measured_ratio(info.name, &grid), ratio_by_determinants(method, &grid));
        assert!((measured - expected).abs() < tolerance, "{measured} for {expected}");
        (measured - 1.0).abs() / tolerance
    };
    let in_short_steps = changed(0.2);
    if info.symplectic {
        assert!(in_short_steps < 1.0, "{in_short_steps}");
    } else if info.order <= 4 {
        assert!(in_short_steps > 1e4, "{in_short_steps}");
    } else {
        let long = if info.order <= 8 { 0.4 } else { 0.5 };
        assert!(changed(long) > 100.0);
    }
}
each_method!(the_image_of_a_square_is_as_large_as_the_determinants_say);

/// Catches: a sign that is wrong both in the areas and in the determinants.
#[test]
fn forward_euler_grows_and_rk4_shrinks() {
    assert!(measured_ratio("forward-euler", &grid()) > 2.0);
    assert!(measured_ratio("rk4", &grid()) < 0.999);
}

/// The side is in rad; along ω it is ω₀ times as long, in rad/s. A sum of 4N products of numbers
/// below 1: N roundings.
///
/// Catches: a corner counted twice or left out, the closing side forgotten, clockwise for
/// anticlockwise, ω for ω/ω₀.
#[test]
fn a_square_has_its_area() {
    let frequency = pendulum().small_angle_frequency();
    for count in [1, 2, 250] {
        let outline: Vec<_> = SQUARE.outline(shapes::SQUARE, &pendulum(), count).collect();
        assert_eq!(outline.len(), 4 * count as usize);
        let expected = SQUARE.size * SQUARE.size * frequency;
        let relative = area(&outline) / expected - 1.0;
        assert!(relative.abs() < 1e-13, "{relative:e} with {count} points a side");
        let reversed: Vec<Phase> = outline.iter().rev().copied().collect();
        assert!((area(&reversed) / expected + 1.0).abs() < 1e-13);
    }
}

/// A square with an arm to its left, which is not convex; and polygons of fewer than three points.
///
/// Catches: a formula that is right for parallelograms only.
#[test]
fn the_area_of_a_polygon_is_that_of_its_triangles() {
    let corner = |theta, omega| Phase { theta, omega };
    let hook = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (3.0, 3.0), (3.0, 1.0), (0.0, 1.0)];
    let at = |dx: f64, dy: f64| hook.map(|(x, y)| corner(x + dx, y + dy));
    assert_eq!(area(&at(0.0, 0.0)), 6.0);
    assert_eq!(area(&at(1e6, -1e6)), 6.0);
    for few in [0, 1, 2] {
        assert_eq!(area(&at(1.0, 1.0)[..few]), 0.0);
    }
}

/// Catches: an image that differs from the end of the method's own run; images in the wrong order.
#[test]
fn every_point_goes_its_own_way() {
    let outline: Vec<_> = SQUARE.outline(shapes::SQUARE, &pendulum(), 2).collect();
    for method in METHODS.iter().copied() {
        let images = carried(method, &pendulum(), &outline, &grid());
        assert_eq!((images.len(), &images[0]), (7, &outline));
        for (n, image) in images.iter().enumerate().skip(1) {
            let until = Grid::new(grid().step(), n as u64).unwrap();
            let ends: Vec<_> =
                outline.iter().map(|z| method.end(&pendulum(), *z, &until)).collect();
            assert_eq!(*image, ends);
        }
    }
}

/// The cat as it is drawn: on the paper's pendulum, with 8 pieces from corner to corner.
fn cat() -> (Pendulum, Vec<Phase>) {
    let place = Place { centre: Phase { theta: 0.9, omega: 0.0 }, size: 0.5 };
    (Pendulum::PAPER, place.outline(CAT[0], &Pendulum::PAPER, 8).collect())
}

/// The true motion keeps the cat's area, and what is lost is its polygon's, whose edges are chords:
/// over five periods, while the cat is drawn out, it stays below a thousandth, which is the last
/// digit that the figure shows.
///
/// Catches: a cat of too few points to tell who keeps its area.
#[test]
fn the_cats_polygon_errs_by_less_than_a_thousandth() {
    let (pendulum, outline) = cat();
    let first = area(&outline);
    for n in 1..=20 {
        let t = 0.535 * f64::from(n);
        let image: Vec<Phase> =
            outline.iter().map(|z| Motion::new(&pendulum, *z).unwrap().at(t)).collect();
        let error = area(&image) / first - 1.0;
        assert!(error.abs() < 1e-3, "{error:e} after {t} s");
    }
}

/// Whether the segments from `a` to `b` and from `c` to `d` cross.
fn cross([a, b]: [Phase; 2], [c, d]: [Phase; 2]) -> bool {
    let side = |p: Phase, q: Phase, r: Phase| {
        (q.theta - p.theta) * (r.omega - p.omega) - (q.omega - p.omega) * (r.theta - p.theta)
    };
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}

/// Catches: an outline that crosses itself, whose area the formula counts twice or not at all; a
/// part of the cat drawn clockwise; eyes outside its head.
#[test]
fn the_cat_is_drawn_in_one_line() {
    let (pendulum, _) = cat();
    let place = Place { centre: Phase { theta: 0.0, omega: 0.0 }, size: 1.0 };
    for polygon in CAT {
        let corners: Vec<Phase> = place.outline(polygon, &pendulum, 1).collect();
        assert_eq!(corners.len(), polygon.len());
        assert!(area(&corners) > 0.0, "{polygon:?}");
        let edge = |i: usize| [corners[i], corners[(i + 1) % corners.len()]];
        for i in 0..corners.len() {
            for j in 0..i {
                assert!(!cross(edge(i), edge(j)), "{:?} and {:?}", polygon[i], polygon[j]);
            }
        }
    }
    // A line from each corner of eyes and nose to far above crosses the outline an odd number of
    // times.
    let outline: Vec<Phase> = place.outline(CAT[0], &pendulum, 1).collect();
    for polygon in &CAT[1..4] {
        for z in place.outline(polygon, &pendulum, 1) {
            let up = [z, Phase { theta: z.theta + 1e-3, omega: 99.0 }];
            let edges = (0..outline.len()).map(|i| [outline[i], outline[(i + 1) % outline.len()]]);
            assert_eq!(edges.filter(|edge| cross(*edge, up)).count() % 2, 1, "{z:?}");
        }
    }
}
