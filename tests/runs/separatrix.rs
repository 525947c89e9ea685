//! Between swinging and rotating: releases beside the top.

use std::f64::consts::PI;

use approx::assert_relative_eq;
use pendula::methods::{ForwardEuler, Rk4, StormerVerlet, SymplecticEuler};
use pendula::{
    AnyMethod, Grid, Info, Method, Motion, MotionKind, Observer, Pendulum, Phase, integrate_with,
};
use rstest::rstest;

use crate::common::pendulums;

/// Records the time of the first sample past the top on either side, |θ| > π.
struct OverTheTop(Option<f64>);

impl Observer<Phase> for OverTheTop {
    fn observe(&mut self, n: u64, t: f64, z: Phase) {
        if n > 0 && z.theta.abs() > PI {
            self.0.get_or_insert(t);
        }
    }

    fn is_satisfied(&self) -> bool {
        self.0.is_some()
    }
}

/// When the paper's pendulum goes over the top after a release from `theta` (rad), within
/// `duration` (s).
fn over_the_top(method: &dyn AnyMethod, theta: f64, step: f64, duration: f64) -> Option<f64> {
    let mut watch = OverTheTop(None);
    let grid = Grid::with_duration(step, duration).unwrap();
    method.run(&Pendulum::PAPER, Phase::at_rest(theta), &grid, &mut watch);
    watch.0
}

// -------------------------------------------------------------------------------------------------
// The fall from the top
// -------------------------------------------------------------------------------------------------

/// The closed form itself: a release at δ beside the top falls in √(L/g) ln(8/δ), to δ² relatively,
/// as K = ln(4/k') and k' = δ/2. π as an f64 lies 1.2246e-16 below π.
///
/// Catches: a modulus that is rounded to 1, k' from 1 − k², an exact solution that stays at the
/// top.
#[rstest]
#[case(PI - 1e-3, 9.999_999_999_998_899e-4, 1e-6)]
// The f64s near π are 4.4e-16 apart: this start is 9.999 999 939 225 29e-9 + 1.2e-16 from the top.
#[case(PI - 1e-8, 9.999_999_939_225_29e-9 + 1.224_646_799_147_353e-16, 1e-14)]
#[case(PI, 1.224_646_799_147_353e-16, 1e-14)]
fn the_exact_fall_takes_a_logarithm(
    #[case] theta: f64,
    #[case] beside: f64,
    #[case] tolerance: f64,
) {
    for pendulum in pendulums() {
        let motion = Motion::new(&pendulum, Phase::at_rest(theta)).unwrap();
        assert_eq!(motion.kind(), MotionKind::Libration);
        let fall = 0.25 * motion.period().unwrap();
        let law = (8.0 / beside).ln() / pendulum.small_angle_frequency();
        assert_relative_eq!(fall, law, max_relative = tolerance);
        assert!(motion.at(fall).theta.abs() < 1e-11, "at {fall} s it is not at the bottom");
    }
}

// -------------------------------------------------------------------------------------------------
// Over the top, or not
// -------------------------------------------------------------------------------------------------

/// 4096 releases between 1 and 2 · 10⁻⁹ rad beside the top. The gap there is δ²/4 of the energy,
/// 1e-18 and less, while the roundings on the way, of which those count that are made at full
/// speed, a hundred of 1e-16 or less at random, change it by 5e-16: so rounding decides, half of
/// them go over, and the time at which they do shows how far rounding has lifted them: √(L/g)
/// ln(8/δ) to fall, 7.06 to 7.29 s, and √(L/g) ln(4/k') to rise, where k'² is at most 3e-14 (5.3 s)
/// and at least 1e-22 (8.6 s): less than that is a chance of 3e-7 for each.
///
/// Catches: a bias of the rounding in one direction; a Störmer–Verlet with an energy drift above
/// 1e-15, which would send all of them over, or none.
#[rstest]
#[case::symplectic_euler(&SymplecticEuler)]
#[case::stormer_verlet(&StormerVerlet)]
fn beside_the_top_rounding_decides(
    #[case] method: &'static dyn AnyMethod,
    #[values(0.01, 0.02)] h: f64,
) {
    let releases = (0..4096).map(|j| PI - 1e-9 * (1.0 + f64::from(j) / 4096.0));
    let times: Vec<f64> =
        releases.filter_map(|theta| over_the_top(method, theta, h, 20.0)).collect();
    // Five standard deviations of a fair coin, √4096/2 = 32, are exceeded once in 10⁶ times.
    assert!(times.len().abs_diff(2048) < 5 * 32, "{} of 4096 go over", times.len());
    for t in times {
        assert!(t > 7.06 + 5.3 && t < 7.29 + 8.6, "over the top at {t} s");
    }
}

/// RK4 loses 1e-7 J on the way, 10⁷ times more than the gap and than rounding: it turns back.
/// Forward Euler gains 0.04 J.
///
/// Catches: an RK4 that gains energy, or is so symmetric that rounding decides.
#[test]
fn beside_the_top_rk4_always_turns_back() {
    for j in 0..32 {
        let theta = PI - 1e-8 * (1.0 + f64::from(j) / 32.0);
        assert_eq!(over_the_top(&Rk4, theta, 0.01, 60.0), None);
        // 6.55 s down, and less than 1.5 s up, as k'² is now 0.002 or more.
        let over = over_the_top(&ForwardEuler, theta, 0.01, 20.0).unwrap();
        assert!(over > 6.55 && over < 8.1, "{over} s");
    }
}

/// The step at which θ first differs from its start, and the time (s) at which it is first at or
/// past the bottom.
#[derive(Default)]
struct Fall {
    moved: Option<u64>,
    fallen: Option<f64>,
}

impl Observer<Phase> for Fall {
    fn observe(&mut self, n: u64, t: f64, z: Phase) {
        if z.theta != PI {
            self.moved.get_or_insert(n);
        }
        if z.theta <= 0.0 {
            self.fallen.get_or_insert(t);
        }
    }

    fn is_satisfied(&self) -> bool {
        self.fallen.is_some()
    }
}

/// From π as an f64 the exact pendulum falls in 12.36 s. With its angle in one f64 no method can
/// move at first: each step adds hα = h (g/L) 1.2246e-16 to ω, and θ = π stays until |ω|h exceeds
/// half an ulp of π, 2.22e-16. That is at the step 2.2204e-16/(h² g/L · 1.2246e-16), for every
/// method that changes the angle by a single sum, as the paper's four do; for forward Euler, which
/// uses the old ω, it is a step later. From there the angle moves by whole ulps, until they are
/// many and it falls like the exact one: from δ and ω, which are both growing, as from rest at δ +
/// |ω|/ω₀.
///
/// Catches: an angle accumulated in another way than the documented one; sin π taken for zero; a
/// Motion that follows the rounded methods and not the start as given.
#[rstest]
#[case::forward_euler(ForwardEuler)]
#[case::symplectic_euler(SymplecticEuler)]
#[case::rk4(Rk4)]
#[case::stormer_verlet(StormerVerlet)]
fn from_pi_rounding_holds_the_pendulum_up<M: Method<Pendulum> + Info>(#[case] method: M) {
    const REST: f64 = 1.224_646_799_147_353_2e-16;
    const ULP: f64 = 4.440_892_098_500_626e-16;
    let pendulum = Pendulum::PAPER;
    let (square, rate) = (pendulum.frequency_squared(), pendulum.small_angle_frequency());
    for h in [0.01, 0.02] {
        let mut fall = Fall::default();
        let grid = Grid::with_duration(h, 40.0).unwrap();
        integrate_with(&pendulum, &method, Phase::at_rest(PI), &grid, &mut fall);
        let held = 0.5 * ULP / (h * h * square * REST);
        let moved = fall.moved.expect("it falls in the end") as f64;
        assert!(moved >= held && moved < held + 3.0, "moves at step {moved}, not {held}");
        // The fall in whole ulps, by the linear equation.
        let (mut ulps, mut omega, mut steps) = (0.0, 0.0, 0);
        while ulps < 1e6 {
            omega += h * square * (REST + ulps * ULP);
            ulps += (h * omega / ULP).round();
            steps += 1;
        }
        let rest = (8.0 / (REST + ulps * ULP + omega / rate)).ln() / rate;
        let mut law = f64::from(steps) * h + rest;
        if method.info().order == 1 && !method.info().symplectic {
            // Its rate is less by hω₀/2 of itself, from where it moves.
            law += 0.5 * h * rate * (law - held * h);
        }
        let fallen = fall.fallen.expect("it falls in the end");
        // It is seen a step late at the most.
        assert!((fallen - law).abs() < h, "falls in {fallen} s, not {law} s");
    }
}

/// [`integrate_fast`] keeps the angle as half turns and a remainder, here −1.2246e-16 rad, and the
/// pendulum falls when the exact one does.
///
/// Beside the top the remainder grows by O(h² g/L) of itself in the first steps of any method, as
/// cosh λt does: they are exact to O(h), and the fall takes √(L/g) ln(8/δ). A method of order p has
/// a relative error of E_p h^p in the rate λ, and so in the time: hλ/2 for forward Euler
/// (symplectic Euler has the rate of Verlet), (hλ)²/24 for Verlet, plus a tenth for the next terms;
/// and the fall is seen a step late at the most. The trapezoidal rule and the discrete gradient
/// have (hλ)²/12. Deuflhard's method has a force of its own at the top, and falls as the pendulum
/// does from πx²/12 beside it.
///
/// Catches: a remainder that is lost when the angle is formed, a reduction of θ with too few digits
/// of π.
fn from_pi_a_rest_of_the_angle_is_not_held_up(method: &dyn AnyMethod) {
    let pendulum = Pendulum::PAPER;
    let exact = 0.25 * Motion::new(&pendulum, Phase::at_rest(PI)).unwrap().period().unwrap();
    assert!((exact - 12.361_754_1).abs() < 1e-7, "{exact} s");
    for h in [0.01, 0.02] {
        let mut fall = Fall::default();
        let grid = Grid::with_duration(h, 40.0).unwrap();
        method.run(&pendulum, Phase::at_rest(PI), &grid, &mut fall);
        let x = h * pendulum.small_angle_frequency();
        let share = match method.info().order {
            1 => x / 2.0,
            2 if method.info().implicit => x * x / 12.0,
            2 => x * x / 24.0,
            order => x.powi(order as i32) / 120.0,
        };
        let fallen = fall.fallen.expect("it falls in the end");
        let law = match method.info().name {
            "deuflhard" => (8.0 / (PI * x * x / 12.0)).ln() / pendulum.small_angle_frequency(),
            _ => exact,
        };
        assert!((fallen - law).abs() < 1.1 * share * law + h, "falls in {fallen} s, not {law} s");
    }
}
each_method!(from_pi_a_rest_of_the_angle_is_not_held_up);
