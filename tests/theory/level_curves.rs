//! The drawn level curves of the energies that the symplectic methods conserve.

use pendula::{Pendulum, Phase};
use pendula_study::experiments::level_curves::{THETA_0, own};
use pendula_study::theory::{Dimensionless, stormer_verlet, symplectic_euler};

/// How far `z` is from the closed curve through `corners` (rad), in coordinates in which small
/// swings are circles.
fn distance(z: Phase, corners: &[Phase]) -> f64 {
    let frequency = Pendulum::PAPER.small_angle_frequency();
    let from_z = |corner: &Phase| (corner.theta - z.theta, (corner.omega - z.omega) / frequency);
    let to_segment = |pair: &[Phase]| {
        let (a, b) = (from_z(&pair[0]), from_z(&pair[1]));
        let (ux, uy) = (b.0 - a.0, b.1 - a.1);
        let along = (-(a.0 * ux + a.1 * uy) / (ux * ux + uy * uy)).clamp(0.0, 1.0);
        (a.0 + along * ux).hypot(a.1 + along * uy)
    };
    corners.windows(2).map(to_segment).fold(f64::INFINITY, f64::min)
}

fn farthest(points: &[Phase], corners: &[Phase]) -> f64 {
    points.iter().map(|z| distance(*z, corners)).fold(0.0, f64::max)
}

/// A point is on the curve if it is within the drawn line, 2.2 units wide in a drawing of 206 units
/// a radian. The terms of H̃ from x⁸ on, which the series leaves out, are a fifth of that for
/// Störmer–Verlet, and would be all of it at h = 0.35 s.
const HALF_A_LINE: f64 = 1.1 / 206.0;

/// Catches: the curve of the other method, of drift before kick, or of another step; ω/ω₀ drawn for
/// ω; points of another start; a step so small that the curves look alike, or so large that the
/// series fails.
#[test]
fn the_methods_follow_their_curves_and_not_the_orbit() {
    let rows = own();
    for row in &rows {
        let [far, near] = [0, 1].map(|curve| farthest(&row.points, &row.curves[curve]));
        assert!(near < HALF_A_LINE, "{:?} leaves its curve by {near} rad", row.method);
        assert!(far > 8.0 * HALF_A_LINE, "{:?} leaves the orbit by {far} rad only", row.method);
    }
    for (row, other) in rows.iter().zip(rows.iter().rev()) {
        assert!(farthest(&row.points, &other.curves[1]) > 8.0 * HALF_A_LINE);
    }
}

/// H̃ is the same all along the curve, to the rounding of numbers of order 1; the release from rest
/// is a quarter of the way along it; and the curve is closed. With L ≠ 1 and m ≠ 1.
///
/// Catches: a fixed-point iteration that stops too early; a curve through another point; one that
/// does not close, or does not go round exactly once; a dimension lost.
#[test]
fn the_curve_is_level() {
    let pendulum = Pendulum::new(9.81, 2.5, 0.7).unwrap();
    let h = 0.3;
    let x = pendulum.small_angle_frequency() * h;
    let euler: Vec<Phase> = symplectic_euler::level_curve(&pendulum, THETA_0, h, 40).collect();
    let verlet: Vec<Phase> = stormer_verlet::level_curve(&pendulum, THETA_0, h, 40).collect();
    let corrections: [fn(Dimensionless, f64) -> f64; 2] =
        [symplectic_euler::correction, stormer_verlet::correction];
    for (curve, correction) in [euler, verlet].iter().zip(corrections) {
        let conserved = |z: Dimensionless| z.energy() + correction(z, x);
        let initial = conserved(Dimensionless::new(THETA_0, 0.0));
        for z in curve {
            let energy = conserved(Dimensionless::from_phase(&pendulum, *z));
            assert!((energy - initial).abs() < 1e-14, "{energy} for {initial} at {z:?}");
        }
        let release = curve[10];
        assert!((release.theta - THETA_0).abs() < 1e-14 && release.omega.abs() < 1e-14);
        assert!(curve.len() == 41 && curve[0] == curve[40]);
        let turns = curve.windows(2).filter(|pair| pair[0].omega > 0.0 && pair[1].omega <= 0.0);
        assert_eq!(turns.count(), 1);
    }
}
