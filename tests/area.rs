//! Area in phase space: the determinant of the Jacobian of one step.

mod common;

use common::each_method;
use pendula::methods::{forward_euler::ForwardEuler, rk4::Rk4};
use pendula::study::properties::{AREA_TOLERANCE, area_defect};
use pendula::{AnyMethod, Pendulum, Phase};
use rstest_reuse::apply;

/// Below and above the horizontal, moving and at rest; L ≠ 1 so that no g can stand for g/L.
fn cases() -> impl Iterator<Item = (Pendulum, Phase)> {
    let long = Pendulum::new(9.81, 3.0, 1.0).unwrap();
    [(0.0, 0.0), (0.5, 1.0), (1.0, -2.0), (2.5, 0.3), (-3.0, 0.0)].into_iter().flat_map(
        move |(theta, omega)| {
            [Pendulum::PAPER, long].map(|pendulum| (pendulum, Phase { theta, omega }))
        },
    )
}

/// Catches: forward Euler posing as symplectic Euler, and every other step that is not built of shears.
#[apply(each_method)]
fn symplectic_methods_preserve_area<M: AnyMethod>(#[case] method: M) {
    let largest = cases()
        .map(|(pendulum, z)| area_defect(&method, &pendulum, z, 0.1).abs())
        .fold(0.0, f64::max);
    if method.properties().symplectic {
        assert!(largest < AREA_TOLERANCE, "det J − 1 = {largest:e}");
    } else {
        // The smallest defect among these methods is RK4's, x⁶/72 = 5e-7 at the bottom of the long pendulum.
        assert!(largest > 100.0 * AREA_TOLERANCE, "symplectic after all: det J − 1 = {largest:e}");
    }
}

/// det J = 1 + h² (g/L) cos θ, exactly: the Jacobian is (1, h; −h (g/L) cos θ, 1).
///
/// Catches: a forward Euler that looks at the new angle or velocity anywhere.
#[test]
fn forward_euler_grows_area_by_its_exact_defect() {
    for (pendulum, z) in cases() {
        for h in [0.1, 0.01] {
            let defect = area_defect(&ForwardEuler, &pendulum, z, h);
            let exact = h * h * pendulum.stiffness() * z.theta.cos();
            assert!((defect - exact).abs() < AREA_TOLERANCE, "{defect:e} for {exact:e} at {z:?}");
        }
    }
}

/// At the bottom det J = |R(ix)|² = 1 − x⁶/72 + x⁸/576 with x = ω₀h, from RK4's stability polynomial R.
///
/// Catches: any change of RK4 that shows on the linear oscillator.
#[test]
fn rk4_shrinks_area_at_the_bottom_as_its_polynomial_says() {
    for (pendulum, _) in cases() {
        for h in [0.3, 0.2, 0.1] {
            let x2 = pendulum.stiffness() * h * h;
            let exact = -x2.powi(3) / 72.0 + x2.powi(4) / 576.0;
            let defect = area_defect(&Rk4, &pendulum, Phase::at_rest(0.0), h);
            assert!((defect - exact).abs() < AREA_TOLERANCE, "{defect:e} for {exact:e} at h = {h}");
        }
    }
}
