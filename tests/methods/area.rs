//! Area in phase space: the determinant of the Jacobian of one step.

use pendula::methods::{ForwardEuler, Rk4};
use pendula::verify::properties::AREA;
use pendula::verify::properties::area::{AREA_TOLERANCE, area_defect, cases};
use pendula::{AnyMethod, Phase};

/// det J by central differences at five states of two pendulums: within 5e-10 of 1 in steps of 0.1
/// s if the method is symplectic. If not, it is off by a hundred times the error of the
/// measurement, which grows with h², in steps of 0.1, 0.2 or 0.4 s.
/// `src/verify/properties/area.rs` derives the error of the differences.
///
/// Catches: forward Euler posing as symplectic Euler, and every other step that is claimed to
/// preserve area and does not.
fn symplectic_methods_preserve_area(method: &dyn AnyMethod) {
    AREA.assert(method);
}
each_method!(symplectic_methods_preserve_area);

/// det J = 1 + h² (g/L) cos θ, exactly: the Jacobian is (1, h; −h (g/L) cos θ, 1).
///
/// Catches: a forward Euler that uses the new angle or velocity anywhere.
#[test]
fn forward_euler_grows_area_by_its_exact_defect() {
    for (pendulum, z) in cases() {
        for h in [0.1, 0.01] {
            let defect = area_defect(&ForwardEuler, &pendulum, z, h);
            let exact = h * h * pendulum.frequency_squared() * z.theta.cos();
            assert!((defect - exact).abs() < AREA_TOLERANCE, "{defect:e} for {exact:e} at {z:?}");
        }
    }
}

/// At the bottom det J = |R(ix)|² = 1 − x⁶/72 + x⁸/576 with x = ω₀h, from RK4's stability
/// polynomial R.
///
/// Catches: any change of RK4 that shows on the linear oscillator.
#[test]
fn rk4_shrinks_area_at_the_bottom_as_its_polynomial_says() {
    for (pendulum, _) in cases() {
        for h in [0.3, 0.2, 0.1] {
            let x2 = pendulum.frequency_squared() * h * h;
            let exact = -x2.powi(3) / 72.0 + x2.powi(4) / 576.0;
            let defect = area_defect(&Rk4, &pendulum, Phase::at_rest(0.0), h);
            assert!((defect - exact).abs() < AREA_TOLERANCE, "{defect:e} for {exact:e} at h = {h}");
        }
    }
}
