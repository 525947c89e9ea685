//! A planet: every method on a second Hamiltonian, which conserves an angular momentum as well as
//! the energy.

use std::f64::consts::PI;

use approx::assert_abs_diff_eq;
use pendula::methods::BlanesMoan6;
use pendula::metrics::order::slopes;
use pendula::{
    Counting, Error, Grid, Hamiltonian, Info, Method, Separable, StormerVerlet, System, integrate,
    integrate_with,
};
use pendula_dynamics::kepler::{Ellipse, Kepler, PlanePhase};
use pendula_study::experiments::beyond::precession;
use pendula_study::theory::other_systems::verlet_precession;
use rstest::rstest;

use crate::common::Random;

/// μ ≠ 1, a ≠ 1, so that a missing factor shows. e is moderate, so that a ladder of even steps is
/// in its asymptotic regime.
fn planet(e: f64) -> (Kepler, Ellipse) {
    let centre = Kepler::new(2.0).unwrap();
    (centre, Ellipse::new(&centre, 1.3, e).unwrap())
}

/// The exact motion conserves energy, angular momentum and the eccentricity vector, and obeys
/// Kepler's laws.
///
/// Catches: an anomaly that has not converged, e for e², a velocity that is not the position's
/// derivative.
#[rstest]
fn the_ellipse_is_the_motion(#[values(0.0, 0.3, 0.9, 0.9999)] e: f64) {
    let (centre, ellipse) = planet(e);
    for n in -7..=20 {
        let t = ellipse.period() * f64::from(n) / 13.0;
        let z = ellipse.at(t);
        // At e = 0.9999 the pericentre is at 1e-4 a, where v² = 2e4 μ/a loses four digits in the
        // difference.
        let loss = 1.0 / (1.0 - e);
        assert_abs_diff_eq!(centre.energy(z), -2.0 / 2.6, epsilon = 1e-15 * loss * loss);
        let momentum = (2.0 * 1.3 * (1.0 - e * e)).sqrt();
        assert_abs_diff_eq!(centre.angular_momentum(z), momentum, epsilon = 1e-14);
        let towards = centre.eccentricity(z);
        assert_abs_diff_eq!(towards.x, e, epsilon = 1e-14 * loss);
        assert_abs_diff_eq!(towards.y, 0.0, epsilon = 1e-14 * loss);
    }
    // Kepler's third law, and the apocentre after half a revolution.
    assert_abs_diff_eq!(
        ellipse.period(),
        2.0 * PI * (1.3_f64.powi(3) / 2.0).sqrt(),
        epsilon = 1e-14
    );
    let apocentre = ellipse.at(0.5 * ellipse.period());
    assert_abs_diff_eq!(apocentre.x, -1.3 * (1.0 + e), epsilon = 1e-14);
    assert_abs_diff_eq!(apocentre.y, 0.0, epsilon = 1e-14);
    assert_eq!(ellipse.at(0.0).y, 0.0);
}

/// The largest distance from the exact motion in a run of `steps` steps, whose duration does not
/// divide the period.
fn largest_error<M: Method<Kepler>>(method: &M, steps: u64) -> f64 {
    let (centre, ellipse) = planet(0.2);
    let grid = Grid::new(3.7 / steps as f64, steps).unwrap();
    let mut largest = 0.0_f64;
    integrate_with(&centre, method, ellipse.at(0.3), &grid, &mut |_, t, z: PlanePhase| {
        let exact = ellipse.at(0.3 + t);
        largest = largest.max((z.x - exact.x).hypot(z.y - exact.y));
    });
    largest
}

/// The second term of the error bends a slope in proportion to the step; on the finest rungs above
/// rounding it is at most 1/30 of the first, which bends a slope between halved steps by less than
/// 0.03.
///
/// In a symmetric method it bends the slope in proportion to the step's square, and not by so
/// little where the method is designed for a small first term: that of SRKN 6b is here thirty times
/// smaller than its second over x². So of two slopes that share a rung the square's part is taken
/// out.
const SLOPE_TOLERANCE: f64 = 0.05;

/// Beyond order 4, for a method that is not symmetric, the second term is at most this many times x
/// of the first, where x is the step times √(μ/r³) at the pericentre, where that is largest: those
/// methods are designed for a small first term. For DOP853, whose first term is the smallest, it is
/// 3 x.
const SECOND_TERM: f64 = 4.0;

/// Every method has its order on this system too. The ladder refines the step until rounding shows,
/// by rungs on which the error falls by 16, or by 2 to the power of the order if that is less; its
/// two finest slopes count, and for a symmetric method what they tend to.
///
/// Beyond order 8 the steps with errors above rounding are not short compared with the time scale
/// of the motion: the error falls by 2¹⁶ from rung to rung, only one slope counts, and errors are
/// within a factor of two of their first term.
///
/// Catches: a coefficient that is wrong, even if it is right for a force that is nearly linear.
fn each_method_has_its_order<M: Method<Kepler> + Info>(method: &M) {
    let info = method.info();
    let order = f64::from(info.order);
    let is_fine = info.order > 8;
    let (shortest, powers): (f64, f64) = if is_fine { (3.0, 16.0) } else { (8.0, 4.0) };
    let rung = |k: i32| (shortest * (powers / order).min(1.0).exp2().powi(k)).round();
    // Each evaluation of a step rounds x, y and two velocities by 2.2e-16 of a few units: at worst
    // 4 · 2.2e-16 in each of N steps. Twice that bends a slope by less than a half, and is reached
    // only if all roundings have the same sign. An implicit method adds to the state once, slopes
    // whose weights add up to one.
    let additions = if info.implicit { 1 } else { info.force_evaluations };
    let floor = |n: f64| 8.0 * 2.2e-16 * n * additions as f64;
    let ladder: Vec<(f64, f64)> = (0..)
        .map(rung)
        .take_while(|n| *n <= 40_000.0)
        .map(|n| (n, largest_error(method, n as u64)))
        .take_while(|(n, error)| *error > floor(*n))
        .collect();
    let (steps, errors): (Vec<f64>, Vec<f64>) =
        ladder.into_iter().map(|(n, error)| (3.7 / n, error)).unzip();
    let slopes: Vec<f64> = slopes(&steps, &errors, 0.0).flatten().collect();
    let counted = if is_fine || info.symmetric { 1 } else { 2 };
    assert!(slopes.len() >= counted, "too few rungs above rounding: {errors:?}");
    let rate = planet(0.2).1.mean_motion() / 0.8_f64.powf(1.5);
    for k in slopes.len() - counted..slopes.len() {
        let window = if is_fine {
            4.0_f64.ln() / (steps[k] / steps[k + 1]).ln()
        } else if info.symmetric {
            let square = (steps[k - 1] / steps[k]).powi(2);
            let limit = (square * slopes[k] - slopes[k - 1]) / (square - 1.0);
            assert!((limit - order).abs() < SLOPE_TOLERANCE, "{limit} by {slopes:?}");
            continue;
        } else if info.order <= 4 {
            SLOPE_TOLERANCE
        } else {
            SLOPE_TOLERANCE + SECOND_TERM * rate * steps[k]
        };
        assert!((slopes[k] - order).abs() < window, "{slopes:?} of {errors:?}");
    }
}
each_general_method_type!(each_method_has_its_order);

/// The largest change of the angular momentum over a hundred revolutions in coarse steps, relative.
fn momentum_drift<M: Method<Kepler>>(method: &M) -> f64 {
    let (centre, ellipse) = planet(0.5);
    let grid = Grid::new(ellipse.period() / 100.0, 10_000).unwrap();
    let start = ellipse.at(0.0);
    let (initial, mut largest) = (centre.angular_momentum(start), 0.0_f64);
    integrate_with(&centre, method, start, &grid, &mut |_, _, z: PlanePhase| {
        largest = largest.max((centre.angular_momentum(z) / initial - 1.0).abs());
    });
    largest
}

/// Kicks along r and drifts along v leave r × v alone, and Gauss's methods keep every conserved
/// quadratic form of the state (Hairer, Lubich, Wanner, *Geometric Numerical Integration*, Theorem
/// IV.2.1): each symplectic method keeps the angular momentum to rounding, at a step so coarse that
/// Störmer–Verlet's energy is off by several per cent. The others change it at every step.
///
/// Catches: a force that is not central; a kick that changes the position; a drift that changes the
/// velocity; a method wrongly declared symplectic.
fn symplectic_methods_and_no_others_keep_the_angular_momentum<M>(method: &M)
where
    M: Method<Kepler> + Info,
{
    // Each kick and each drift, or each sweep, rounds x v_y by ε of itself a few times: a random
    // walk of 10 000 steps of s stages, 100 √s · 4ε, with a margin of three.
    let info = method.info();
    let rounding =
        3.0 * 100.0 * f64::from(info.force_evaluations as u32).sqrt() * 4.0 * f64::EPSILON;
    let drift = momentum_drift(method);
    assert_eq!(drift < rounding, info.symplectic, "{drift:e}, {rounding:e}");
}
each_general_method_type!(symplectic_methods_and_no_others_keep_the_angular_momentum);

/// Störmer–Verlet turns the pericentre by −(π/8)(nh)²(4 + e²)/(1 − e²)³ + O(h⁴) a revolution.
///
/// Catches: kicks half as long again, with which energy is still bounded and momentum kept.
#[rstest]
fn verlet_turns_the_ellipse_as_its_law_says(#[values(0.1, 0.4, 0.6)] e: f64) {
    let (centre, ellipse) = planet(e);
    let errors = [1000, 2000].map(|steps| {
        let law = verlet_precession(&ellipse, ellipse.period() / steps as f64);
        precession(&centre, &ellipse, steps) / law - 1.0
    });
    // The next order is about 10 (nh)² (1 − e²)⁻³ of the first, and falls with the square of the
    // step.
    let next = 4e-5 * 10.0 / (1.0 - e * e).powi(3);
    assert!(errors[0].abs() < next, "{errors:?}");
    assert!(errors[1].abs() < 0.3 * errors[0].abs(), "{errors:?}");
}

/// The direction of an ellipse of eccentricity 0.6, after a hundred revolutions of `steps` steps
/// each (rad). It is taken at the apocentre, where it is steadiest.
fn turned_by<M: Method<Kepler>>(method: &M, steps: u64) -> f64 {
    let (centre, ellipse) = planet(0.6);
    let period = ellipse.period();
    let grid = Grid::new(period / steps as f64, 100 * steps).unwrap();
    let end = integrate(&centre, method, ellipse.at(0.5 * period), &grid);
    let towards = centre.eccentricity(end);
    towards.y.atan2(towards.x)
}

/// Less than a thousandth of a radian in a hundred revolutions takes Störmer–Verlet 5100
/// evaluations in each (its law: 2.58 rad with a hundred steps, and √2580 times as many), and
/// Blanes–Moan 6 forty steps of eleven.
///
/// Catches: a method of order 6 whose error constant has grown twofold.
#[test]
fn order_six_keeps_the_ellipse_for_a_tenth_of_the_work() {
    let (_, ellipse) = planet(0.6);
    let law = 100.0 * verlet_precession(&ellipse, ellipse.period() / 5100.0);
    assert_abs_diff_eq!(law.abs(), 1e-3, epsilon = 1e-5);
    assert!(turned_by(&StormerVerlet, 5000).abs() > 1e-3);
    let evaluations = 40 * BlanesMoan6.info().force_evaluations;
    assert!(10 * evaluations < 5100, "{evaluations}");
    let turned = turned_by(&BlanesMoan6, 40).abs();
    assert!((3e-4..1e-3).contains(&turned), "{turned:e}");
}

/// Catches: a rate that is not the velocity and the force, a count that misses one of the two.
#[test]
fn rate_is_force_and_velocity() {
    let (centre, _) = planet(0.0);
    let counting = Counting::new(centre);
    let z = PlanePhase { x: 3.0, y: -4.0, vx: 0.5, vy: 0.25 };
    let rate = counting.rate(0.0, z);
    let force = counting.force(0.0, z);
    assert_eq!((rate.x, rate.y, rate.vx, rate.vy), (z.vx, z.vy, force.x, force.y));
    // μ/r² = 2/25 towards the centre, by hand: along (−3, 4)/5. A few roundings.
    assert_abs_diff_eq!(force.x, -2.0 / 25.0 * 0.6, epsilon = 2e-17);
    assert_abs_diff_eq!(force.y, 2.0 / 25.0 * 0.8, epsilon = 2e-17);
    assert_eq!(counting.evaluations(), 2);
    assert_eq!(centre.angular_momentum(z), 3.0 * 0.25 + 4.0 * 0.5);
    let far = PlanePhase { x: 1e300, ..PlanePhase::default() };
    assert!(centre.energy(far).abs() < 1e-299, "zero far away");
}

/// Catches: a getter that returns another number than the one used.
#[test]
fn an_orbit_is_what_it_was_made_of() {
    let centre = Kepler::new(2.5).unwrap();
    let ellipse = Ellipse::new(&centre, 1.75, 0.375).unwrap();
    assert_eq!(centre.attraction(), 2.5);
    assert_eq!((ellipse.semi_major(), ellipse.eccentricity()), (1.75, 0.375));
}

/// Ten thousand orbits of any numbers, most of which are refused: of the others the period, the
/// rate and the energy are finite.
///
/// Catches: a period, a rate or an energy out of range on an orbit that was accepted; an anomaly
/// that is looked for without an end.
#[test]
fn any_orbit_is_sound_or_refused() {
    let mut any = Random::new(1);
    let mut sound = 0;
    for _ in 0..10_000 {
        let Ok(centre) = Kepler::new(any.number()) else { continue };
        let eccentricity = if any.below(2) == 0 { any.number() } else { any.between(0.0, 1.0) };
        let Ok(ellipse) = Ellipse::new(&centre, any.number(), eccentricity) else { continue };
        sound += 1;
        assert!(ellipse.period().is_normal() && ellipse.mean_motion().is_normal());
        // Within a turn, and at any time.
        for t in [0.0, any.between(-1.0, 1.0) * ellipse.period(), any.number()] {
            let z = ellipse.at(t);
            if !(ellipse.mean_motion() * t).is_finite() {
                continue;
            }
            let PlanePhase { x, y, vx, vy } = centre.rate(0.0, z);
            let case = || format!("{centre:?} {ellipse:?} at {t:e}: {z:?}");
            assert!([x, y, vx, vy].iter().all(|x| x.is_finite()), "{}", case());
            assert!(centre.energy(z).is_finite(), "{}", case());
        }
    }
    assert!(sound > 500, "{sound}");
}

/// Catches: a hyperbola taken for an ellipse, NaN accepted, an error that does not give the reason.
#[test]
fn impossible_orbits_are_refused() {
    for attraction in [0.0, -1.0, f64::NAN] {
        assert!(Kepler::new(attraction).is_err());
    }
    let centre = Kepler::new(1.0).unwrap();
    for (a, e, because) in [
        (1.0, 1.0, "at least 0 and below 1"),
        (1.0, -0.1, "at least 0 and below 1"),
        (1.0, f64::NAN, "eccentricity e"),
        (0.0, 0.5, "semi-major axis a"),
        (1e-300, 0.5, "mean motion"),
        (1e-110, 0.5, "r³ on the orbit"),
        (1e104, 0.5, "r³ on the orbit"),
        (1e-95, 1.0_f64.next_down(), "r³ on the orbit"),
    ] {
        let refused: Error = Ellipse::new(&centre, a, e).unwrap_err();
        assert!(refused.to_string().contains(because), "{refused}");
    }
}
