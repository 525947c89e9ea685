//! Between swinging and rotating: releases beside the top; and fast rotation.

use std::f64::consts::PI;

use approx::assert_relative_eq;
use pendula::methods::{ForwardEuler, Heun, Rk4, StormerVerlet, SymplecticEuler};
use pendula::{
    AnyMethod, Grid, Info, METHODS, Method, MethodInfo, Motion, MotionKind, Observer, Pendulum,
    Phase, System, integrate,
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

/// How late (s) the method is in so many steps to the exact fall from π − `beside` to the bottom.
fn delay(method: &dyn AnyMethod, pendulum: &Pendulum, beside: f64, steps: u64) -> f64 {
    let start = Phase::at_rest(PI - beside);
    let motion = Motion::new(pendulum, start).unwrap();
    let fall = 0.25 * motion.period().unwrap();
    let grid = Grid::new(fall / steps as f64, steps).unwrap();
    let end = method.run(pendulum, start, &grid, &mut ());
    let truth = motion.at(grid.time(steps));
    (truth.theta - end.theta) / truth.omega
}

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

/// The fall of each method is late, or early, by an error of its order: at the finest steps in
/// which rounding, some 1e-12 s, is less than a tenth of the error. The steps divide the fall, so
/// that the errors of a step are at the same phases.
///
/// Deuflhard's method has no order so near the top that its own force there, of πx²/12, is larger
/// than the pendulum's: that is 6e-5 here.
///
/// Catches: a start nudged off the top; a method whose order is lost where the force is almost
/// zero.
fn the_fall_is_late_by_the_methods_order(method: &dyn AnyMethod) {
    const VISIBLE: f64 = 1e-11;
    let info = method.info();
    for (pendulum, beside) in pendulums().iter().flat_map(|p| [(p, 1e-3), (p, 1e-8)]) {
        if info.name == "deuflhard" && beside < 1e-4 {
            continue;
        }
        // In 2048 steps, 1024, …, 8.
        let errors = (3..=11).rev().map(|k| delay(method, pendulum, beside, 1 << k).abs());
        let errors: Vec<f64> = errors.collect();
        let order = f64::from(info.order);
        if order > 8.0 {
            // In 32 steps already nothing is to be seen.
            assert!(errors[..=6].iter().all(|error| *error < VISIBLE), "{errors:?}");
            continue;
        }
        let finest = errors.iter().position(|error| *error > VISIBLE).expect("in a few steps");
        // The next term, of relative order h or h², bends the slopes by 0.025 at most, and those
        // of orders 5 and 6, which are seen at coarser steps only, by 0.12. Order 8 is seen in 128
        // steps and fewer, where slopes vary, but not by much over all of them.
        let (coarsest, tolerance) = match info.order {
            1..=4 => (finest + 1, 0.05),
            5..=7 => (finest + 1, 0.15),
            _ => (errors.len() - 1, 1.3),
        };
        let slope = (errors[coarsest] / errors[finest]).log2() / (coarsest - finest) as f64;
        assert!((slope - order).abs() < tolerance, "{slope} beside {beside:e}: {errors:?}");
    }
}
each_method!(the_fall_is_late_by_the_methods_order);

/// Symplectic Euler is Störmer–Verlet half a step on: it is early by h/2, to order h².
///
/// Catches: drift before kick, which would be half a step late; forward Euler, which is late by 8
/// h.
#[test]
fn symplectic_euler_falls_half_a_step_early() {
    for pendulum in pendulums() {
        let fall =
            0.25 * Motion::new(&pendulum, Phase::at_rest(PI - 1e-3)).unwrap().period().unwrap();
        for steps in [400, 800] {
            let h = fall / steps as f64;
            let early = -delay(&SymplecticEuler, &pendulum, 1e-3, steps);
            // Verlet itself is late by h² ω₀ ln(8/δ)/24, at most 1.17 h² here; ω₀ is below 4.
            assert!((early - 0.5 * h).abs() < 1.5 * h * h, "{early} for {}", 0.5 * h);
        }
    }
}

// -------------------------------------------------------------------------------------------------
// Over the top, or not
// -------------------------------------------------------------------------------------------------

/// From 10⁻³ the gap to the top, g L δ²/2 = 5e-6 J, is 10⁹ roundings of the energy. The symplectic
/// methods never cross it, as their energies are those of the pendulum at rest, and no more do the
/// symmetric ones, whose way down is their way up; RK4 and
/// Dormand–Prince lose energy, and what methods of higher order gain or lose at this step, x⁹ of it
/// and less, is negligible beside the gap; forward Euler gains energy and goes over at once, and
/// the other methods of order 2 that are neither go over in the end.
///
/// Catches: energy that a symplectic method gains or loses, at the amplitude where it is easiest to
/// see.
#[test]
fn from_a_thousandth_only_low_orders_go_over() {
    for method in METHODS.iter().copied() {
        let entry = method.info();
        for step in [0.01, 0.005] {
            let over = over_the_top(method, PI - 1e-3, step, 200.0);
            let stays = entry.symplectic || entry.symmetric || entry.order >= 4;
            assert_eq!(over.is_none(), stays, "{method:?}: {over:?}");
        }
    }
    // The exact fall takes 2.87 s, and the rise on the other side as long. Forward Euler gains so
    // much that it is over in 3.9 s.
    let over = over_the_top(&ForwardEuler, PI - 1e-3, 0.01, 10.0).unwrap();
    assert!(over > 2.87 && over < 2.0 * 2.87, "{over} s");
}

/// 4096 releases between 1 and 2 · 10⁻⁹ rad beside the top. The gap there is δ²/4 of the energy,
/// 1e-18 and less, while the roundings on the way, of which those count that are made at full
/// speed, a hundred of 1e-16 or less at random, change it by 5e-16: so rounding decides, half of
/// them go over, and the time at which they do shows how far rounding has lifted them: √(L/g)
/// ln(8/δ) to fall, 7.06 to 7.29 s, and √(L/g) ln(4/k') to rise, where k'² is at most 3e-14 (5.3 s)
/// and at least 1e-22 (8.6 s): less than that is a chance of 3e-7 for each.
///
/// Catches: a bias of the rounding in one direction; a Verlet with any drift of energy above 1e-15,
/// which would send all of them over, or none.
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
        integrate(&pendulum, &method, Phase::at_rest(PI), &grid, &mut fall);
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

// -------------------------------------------------------------------------------------------------
// Fast rotation
// -------------------------------------------------------------------------------------------------

/// A hundred and sixty turns a second.
const FAST: Phase = Phase { theta: 0.3, omega: 1e3 };

/// The mean rate is √(Ω² − 2(g/L) cos θ₀) less 3(g/L)²/(4Ω³), 7.2e-8, to terms of g³/Ω⁵. After n
/// periods the angle has grown by n turns, to the last digit of n turns.
///
/// Catches: a rotation unwrapped with a turn too many or too few; the rate at the start in place of
/// the mean.
#[test]
fn the_exact_rotation_has_its_mean_rate() {
    for pendulum in pendulums() {
        let motion = Motion::new(&pendulum, FAST).unwrap();
        assert_eq!(motion.kind(), MotionKind::Rotation);
        let period = motion.period().unwrap();
        let g = pendulum.frequency_squared();
        let square = FAST.omega * FAST.omega - 2.0 * g * FAST.theta.cos();
        let rate = square.sqrt() - 0.75 * g * g / FAST.omega.powi(3);
        assert_relative_eq!(2.0 * PI / period, rate, max_relative = 1e-13);
        for turns in [1.0, 10.0, 1e3, 1e6] {
            let z = motion.at(turns * period);
            // The rounding of the time, ε/2 of it, and of the angle: each 1.1e-16 of 2π turns.
            let rounding = 4.0 * f64::EPSILON * 2.0 * PI * turns + 1e-14;
            assert!((z.theta - FAST.theta - 2.0 * PI * turns).abs() < rounding, "{turns} turns");
        }
    }
}

/// Every method follows the rotation to its order, and counts the 1592 turns of 10 s correctly.
///
/// Whether it is the order or that of a better quadrature is for the test of the order to say.
///
/// Catches: an angle wrapped within the step; an order that holds for a swing only.
fn every_method_rotates_by_its_order(method: &dyn AnyMethod) {
    rotates_by_its_order(method, 0).or_else(|_| rotates_by_its_order(method, 1)).unwrap();
}
each_method!(every_method_rotates_by_its_order);

/// Ralston's method, of order 2, whose weights are a quadrature of order 3; or what poses as it.
struct Ralston {
    order: u32,
    /// The second stage, in steps: 2/3.
    node: f64,
    /// Whether each step is too long by 1e-7 of itself.
    drifts: bool,
}

impl Info for Ralston {
    fn info(&self) -> MethodInfo {
        MethodInfo { name: "ralston", order: self.order, ..Heun.info() }
    }
}

impl<S: System> Method<S> for Ralston {
    type Carry = ();

    fn start(&self, _system: &S, _t: f64, _h: f64, _z: S::State) {}

    fn step(&self, system: &S, t: f64, h: f64, z: S::State, _carry: &mut ()) -> S::State {
        let (k1, weight) = (system.rate(t, z), 0.5 / self.node);
        let k2 = system.rate(t + h * self.node, z + k1 * (h * self.node));
        let step = k1 * (1.0 - weight) + k2 * weight;
        z + step * if self.drifts { h * (1.0 + 1e-7) } else { h }
    }
}

/// Catches: a test that refuses a method whose weights are better than its order, or one that takes
/// any slope.
#[test]
fn a_quadrature_may_be_better_than_its_method() {
    let ralston = Ralston { order: 2, node: 2.0 / 3.0, drifts: false };
    rotates_by_its_order(&ralston, 1).unwrap();
    rotates_by_its_order(&Ralston { node: 0.75, ..ralston }, 0).unwrap();
    for (wrong, better) in [
        (Ralston { order: 4, ..ralston }, 0),
        (Ralston { order: 1, ..ralston }, 0),
        (Ralston { drifts: true, ..ralston }, 1),
        // Heun's, of order 2, posing as a method of order 1.
        (Ralston { order: 1, node: 1.0, ..ralston }, 0),
    ] {
        let refused = rotates_by_its_order(&wrong, better);
        assert!(refused.is_err(), "order {}, drifts: {}", wrong.order, wrong.drifts);
    }
}

/// In so fast a rotation a method sums the force along a straight line, and the error of the sum
/// is, by Euler and Maclaurin, hᵖ times a derivative of sin θ at the start, of the order p − 1: cos
/// θ for an even p and sin θ for an odd one. The sum may be a quadrature of an order higher by one
/// than the method's, as Ralston's is; what the method itself is off by is then less by g/(LΩ²).
///
/// The error of Dormand–Prince is small beside the others even where that sine is not, down to
/// steps of 0.4 rad, where it is below rounding after a thousand turns, but not after sixteen.
fn rotates_by_its_order(method: &dyn AnyMethod, better: u32) -> Result<(), String> {
    /// At Ωh = 0.05, or 0.4 for RK4, the next term bends a slope by as much: measured 0.02 and
    /// 0.07.
    const TOLERANCE: f64 = 0.1;
    let order = f64::from(method.info().order);
    let is_dormand_prince = method.info().name == "dormand-prince";
    let (fast, duration) =
        if is_dormand_prince { (Phase { theta: 1.5, omega: 1e2 }, 1.0) } else { (FAST, 10.0) };
    // Slopes are taken only from errors above this: 1e4 rad rounded by 2e-12, or 1e2 by as much
    // less, in each of N steps, at random.
    // A sixteenth of it bends a slope by 0.09, and a half by 0.6.
    let above = if order > 4.0 { 2.0 } else { 16.0 };
    let rounding = |h: f64| 4.0 * 1.8e-16 * fast.omega * duration * (duration / h).sqrt();
    for pendulum in pendulums() {
        let motion = Motion::new(&pendulum, fast).unwrap();
        let error = |h: f64| {
            let grid = Grid::with_duration(h, duration).unwrap();
            let z = method.run(&pendulum, fast, &grid, &mut ());
            (z.theta - motion.at(duration).theta).abs()
        };
        // Above order 4 nothing is above rounding in steps below 0.2 rad.
        let finest = if order > 4.0 { 4 } else { 7 };
        let steps = (0..=finest).map(|k| 10.0 / 3.0 / fast.omega / f64::from(1 << k));
        let steps: Vec<f64> = steps.collect();
        let errors: Vec<f64> = steps.iter().map(|h| error(*h)).collect();
        let slopes: Vec<f64> = (steps.windows(2).zip(errors.windows(2)))
            .filter(|(h, e)| e[0] < 1e-3 && e[1] > above * rounding(h[1]))
            .map(|(_, e)| (e[0] / e[1]).log2())
            .collect();
        // Above order 4 a single halving lies between steps of 3.3 rad, with their next terms, and
        // rounding: that tells an even order from the next.
        let tolerance = if order > 4.0 { 0.8 } else { TOLERANCE };
        let shown = order + f64::from(better);
        let is_order = |slope: &f64| (slope - shown).abs() < tolerance;
        // Order 8 and more follow it to rounding in steps of 3.3 rad, half a turn.
        let follows = if order > 8.0 {
            steps.iter().zip(&errors).all(|(h, error)| *error < rounding(*h))
        } else {
            // The finest, and with it whatever lies before it within rounding's reach.
            slopes.last().is_some_and(is_order)
        };
        if !follows {
            return Err(format!("{slopes:?} from {errors:?}"));
        }
    }
    Ok(())
}

/// In steps of 10 and of 100 rad no method follows the motion any more, and none breaks down: a
/// step changes ω by h g/L at most. The symplectic methods with one kick a step stay within the
/// width of a resonance of the standard map, |Δω| ≤ 4√(g/L), as K = h² g/L ≤ 0.098 is far below the
/// value at which the last torus breaks.
///
/// Taylor series are left out: they use the motion only at the start of the step, and do not
/// converge for a step of 10 rad.
///
/// Catches: NaN from a large argument of the sine; a method that stops, or turns by another angle
/// than its velocity says; energy that grows where a symplectic method cannot gain any.
fn in_coarse_steps_fast_rotation_stays_finite(method: &dyn AnyMethod) {
    // The kicks of Yoshida's method of order 8 add up to 17 steps.
    let info = method.info();
    let kicks = if info.force_evaluations > 1 { 17.0 } else { 1.0 };
    for pendulum in pendulums() {
        for h in [0.01, 0.1] {
            let (mut farthest, mut before) = (0.0_f64, FAST);
            // What a step's kicks add to ω, and half a step's way to θ; and the roundings of 1e3
            // rad/s and of 1e5 rad, a few in a step. Kicks of a composition have both signs.
            let kick = kicks * h * pendulum.frequency_squared() + 1e4 * f64::EPSILON;
            let way = kicks * h * kick + 1e6 * f64::EPSILON;
            let mut watch = |n: u64, t: f64, z: Phase| {
                if n > 0 {
                    let turned = z.theta - before.theta - h * before.omega;
                    let sped_up = z.omega - before.omega;
                    assert!(turned.abs() <= way && sped_up.abs() <= kick, "{z:?} after {t} s");
                }
                farthest = farthest.max((z.omega - FAST.omega).abs());
                before = z;
            };
            method.run(&pendulum, FAST, &Grid::with_duration(h, 100.0).unwrap(), &mut watch);
            if info.symplectic && !info.implicit && kicks == 1.0 {
                assert!(farthest < 4.0 * pendulum.small_angle_frequency(), "{farthest} rad/s");
            }
        }
    }
}
each_general_method!(in_coarse_steps_fast_rotation_stays_finite);
