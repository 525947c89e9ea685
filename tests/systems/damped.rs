//! The damped pendulum: decay, energy balance, and the contraction of area.

use approx::assert_abs_diff_eq;
use pendula::methods::{Rk4, StormerVerlet};
use pendula::systems::Damped;
use pendula::{
    AnyMethod, Error, Grid, Info, LinearOscillator, Method, Pendulum, Phase, Separable, System,
    integrate, integrate_with,
};
use pendula_dynamics::shapes;
use rstest::rstest;

use crate::common::{in_seconds, on};

/// g/L = 2.5, L ≠ 1, m ≠ 1, so that a missing factor shows.
fn damped(beta: f64) -> Damped {
    Damped::new(Pendulum::new(5.0, 2.0, 3.0).unwrap(), beta).unwrap()
}

/// The critical damping √(g/L) (1/s).
fn critical() -> f64 {
    2.5_f64.sqrt()
}

/// The state at time `t` ≥ 0 (s) after `start` in the limit of small swings, θ̈ + 2β θ̇ + ω₀² θ =
/// 0: in closed form, whether the damping is weak (β < ω₀), critical or strong.
fn small_swing(damped: &Damped, start: Phase, t: f64) -> Phase {
    let (beta, square) = (damped.damping(), damped.pendulum().frequency_squared());
    let Phase { theta, omega } = start;
    // The two solutions that begin as (1, 0) and (0, 1) in z and ż of z̈ = (β² − ω₀²) z, times
    // exp(−βt).
    let below = square - beta * beta;
    let (even, odd) = if below > 0.0 {
        let frequency = below.sqrt();
        let decay = (-beta * t).exp();
        (decay * (frequency * t).cos(), decay * (frequency * t).sin() / frequency)
    } else if below < 0.0 {
        let split = (-below).sqrt();
        // exp(−βt) times cosh and sinh, without the overflow of the one or the cancellation in the
        // other.
        let decay = (-square / (beta + split) * t).exp();
        let lost = -(-2.0 * split * t).exp_m1();
        (decay * (1.0 - 0.5 * lost), decay * lost / (2.0 * split))
    } else {
        let decay = (-beta * t).exp();
        (decay, decay * t)
    };
    Phase {
        theta: theta * even + (omega + beta * theta) * odd,
        omega: omega * even - (beta * omega + square * theta) * odd,
    }
}

/// The pendulum's sine differs from θ₀ by θ₀³/6, which over t shifts the phase by θ₀² ω₀t/16: with
/// θ₀ = 1e-5 and ω₀t = 10, 6e-11. RK4's own error is (hλ)⁴/120 of a decay at the rate λ, 3e-11
/// at h = 0.001 for the fastest, λ = 2β = 8.
const LINEAR: f64 = 1e-10;

/// Catches: a wrong sign of the damping, 2β for β, g·L for g/L, the formula for weak damping used
/// above critical damping.
#[rstest]
#[case::none(0.0)]
#[case::weak(0.1)]
#[case::half(0.8)]
#[case::critical(critical())]
#[case::strong(4.0)]
fn small_swings_decay_as_the_linear_equation_says(#[case] beta: f64) {
    let damped = damped(beta);
    for start in [Phase::at_rest(1e-5), Phase { theta: -0.3e-5, omega: 1e-5 }] {
        let grid = Grid::with_duration(0.001, 6.0).unwrap();
        integrate_with(&damped, &Rk4, start, &grid, &mut |_, t, z: Phase| {
            let exact = small_swing(&damped, start, t);
            assert_abs_diff_eq!(z.theta, exact.theta, epsilon = LINEAR * 1e-5);
            assert_abs_diff_eq!(z.omega, exact.omega, epsilon = LINEAR * 1e-5 * 4.0);
        });
    }
}

/// The closed form solves its equation for all dampings, also far above critical and next to it,
/// and for long times.
///
/// Catches: cosh that overflows, a cancellation next to critical.
#[rstest]
fn the_closed_form_is_smooth_across_critical(
    #[values(1.0 - 1e-9, 1.0, 1.0 + 1e-9)] share: f64,
    #[values(0.5, 3.0, 1e4)] t: f64,
) {
    let start = Phase { theta: 1.0, omega: 0.5 };
    let here = small_swing(&damped(share * critical()), start, t);
    // The formula at critical damping: (θ₀ + (ω₀ + βθ₀) t) exp(−βt). A relative change of β by 1e-9
    // changes it by less than 1e-9 (βt)² exp(−βt) < 1e-9.
    let beta = critical();
    let exact = (1.0 + (0.5 + beta) * t) * (-beta * t).exp();
    assert_abs_diff_eq!(here.theta, exact, epsilon = 2e-9);
    let strong = small_swing(&damped(1e6), start, 1e6);
    // Slow decay at ω₀²/(2β) = 1.25e-6 (1/s), of θ₀ + ω₀/(2β).
    assert_abs_diff_eq!(strong.theta, (-1.25_f64).exp(), epsilon = 1e-6);
}

/// g/L = 4 and β = 2: critical to the last bit, which √2.5 never is.
///
/// Catches: a division by a frequency of zero, a decay without its sign or its time.
#[test]
fn where_damping_is_critical_there_is_a_formula_too() {
    let critical = Damped::new(Pendulum::new(8.0, 2.0, 3.0).unwrap(), 2.0).unwrap();
    for t in [0.0, 0.25, 1.5] {
        let end = small_swing(&critical, Phase { theta: 1.0, omega: 0.5 }, t);
        // θ = (θ₀ + s t) exp(−βt) with s = ω₀ + βθ₀, and its derivative; a few roundings of numbers
        // below 3.
        let (s, decay) = (2.5, (-2.0 * t).exp());
        assert_abs_diff_eq!(end.theta, (1.0 + s * t) * decay, epsilon = 3e-15);
        assert_abs_diff_eq!(end.omega, (s - 2.0 * (1.0 + s * t)) * decay, epsilon = 3e-15);
    }
}

/// E(t) − E(0) = ∫ −2β m L² ω² dt along a wide swing, the integral by Simpson's rule over the
/// samples.
///
/// Catches: m or L² left out of the power, β for 2β in it, a wrong energy.
#[test]
fn what_the_energy_loses_friction_takes() {
    let damped = damped(0.2);
    let (h, steps) = (0.005, 2000);
    let grid = Grid::new(h, steps).unwrap();
    let start = Phase { theta: 2.5, omega: 1.0 };
    let (mut taken, mut energy) = (0.0, Vec::new());
    integrate_with(&damped, &Rk4, start, &grid, &mut |n, _, z: Phase| {
        let weight = if n == 0 || n == steps { 1.0 } else { 2.0 + 2.0 * (n % 2) as f64 };
        taken += weight * h / 3.0 * damped.power(z);
        energy.push(damped.energy(z));
    });
    let lost = energy.last().unwrap() - energy[0];
    assert!(lost < -30.0, "most of the 59 J: {lost}");
    assert!(energy.windows(2).all(|pair| pair[1] <= pair[0]), "never gains");
    // Simpson: h⁴/180 times the fourth derivative of the power, (2ω₀)⁴ · 30 W, times 10 s: 1e-7 at
    // worst; RK4 less.
    assert_abs_diff_eq!(lost, taken, epsilon = 1e-7);
}

/// Without damping it is the pendulum, to the bit.
///
/// Catches: a kick that rounds differently when there is no damping.
fn without_damping_it_is_the_pendulum(method: &dyn AnyMethod) {
    let damped = damped(0.0);
    let grid = Grid::new(0.01, 1000).unwrap();
    let start = Phase { theta: 1.0, omega: 0.5 };
    let end = on(method).try_run(&damped, start, &grid, &mut ());
    assert_eq!(end, in_seconds(method).try_run(damped.pendulum(), start, &grid, &mut ()));
}
each_general_method!(without_damping_it_is_the_pendulum);

/// The kick solves ω̇ = α − 2βω: two kicks equal one of the total duration, a kick back undoes it,
/// and its time derivative is the rate.
///
/// Catches: friction by Euler's rule within the kick, a rate and a force that disagree.
#[rstest]
fn kick_force_and_rate_agree(#[values(0.0, 1e-12, 0.2, 5.0)] beta: f64) {
    let damped = damped(beta);
    let z = Phase { theta: 0.7, omega: -1.3 };
    let alpha = damped.force(0.0, z);
    let omega = |z, h| damped.kick(z, alpha, h).omega;
    // A few roundings of numbers below 2, and of exp(2βh) = e for the way back.
    assert_abs_diff_eq!(omega(damped.kick(z, alpha, 0.06), 0.04), omega(z, 0.1), epsilon = 2e-15);
    assert_abs_diff_eq!(omega(damped.kick(z, alpha, 0.1), -0.1), z.omega, epsilon = 4e-15);
    // A central difference of δ = 1e-4: δ²/6 times (2β)² times 2βω + α ≤ 15, 2.5e-6; rounding ε/δ =
    // 2e-12.
    let slope = (omega(z, 1e-4) - omega(z, -1e-4)) / 2e-4;
    let rate = damped.rate(0.0, z);
    assert_abs_diff_eq!(slope, rate.omega, epsilon = 3e-6 * (beta * beta / 25.0) + 1e-11);
    assert_eq!(rate.theta, z.omega);
    assert_eq!(damped.drift(z, 0.1), Phase { theta: 0.7 + 0.1 * -1.3, ..z });
}

/// The area inside a curve of starts after the run, as a polygon of `corners` corners.
fn area_after<M: Method<Damped>>(method: &M, damped: &Damped, grid: &Grid, corners: u32) -> f64 {
    let ring = (0..corners).map(|k| 2.0 * std::f64::consts::PI * f64::from(k) / f64::from(corners));
    let ends = ring
        .map(|turn| Phase { theta: 1.0 + 0.3 * turn.cos(), omega: 0.5 + 0.3 * turn.sin() })
        .map(|start| integrate(damped, method, start, grid));
    shapes::area(ends)
}

/// With any step, Störmer–Verlet shrinks area by exp(−2βt): the two half kicks by exp(−βh) each,
/// and the drift is a shear.
///
/// Catches: friction split off as a separate Euler step, or counted once too often in a step; a
/// polygon's area with its sign or its factor of one half lost.
#[rstest]
#[case::fine(0.01, 300)]
#[case::coarse(0.3, 10)]
fn area_shrinks_by_exactly_what_friction_takes(#[case] h: f64, #[case] steps: u64) {
    let damped = damped(0.2);
    let grid = Grid::new(h, steps).unwrap();
    let [rough, fine] = [1000, 2000].map(|n| area_after(&StormerVerlet, &damped, &grid, n));
    // The polygon is off by O(1/n²): Richardson's step leaves O(1/n⁴), 1e-12 times derivatives of
    // order 10.
    let area = (4.0 * fine - rough) / 3.0;
    let exact = std::f64::consts::PI * 0.3 * 0.3 * (-2.0_f64 * 0.2 * h * steps as f64).exp();
    assert_abs_diff_eq!(area, exact, epsilon = 1e-9);
    // The test resolves the effect of the corners: the rough polygon lies inside the curve.
    assert!((rough - exact).abs() > 1e-8);
}

/// Affine maps keep edges straight: a triangle under the exact flow of the linear oscillator keeps
/// its area.
///
/// Catches: a polygon that does not close, an edge that is counted twice, an area that depends on
/// the origin.
#[test]
fn a_triangle_keeps_its_area_on_the_linear_oscillator() {
    let corners = [(0.0, 0.0), (2.0, 0.0), (0.0, 3.0)];
    let linear = LinearOscillator::new(Pendulum::new(5.0, 2.0, 3.0).unwrap());
    for shift in [0.0, 100.0] {
        let triangle = corners.map(|(theta, omega)| Phase { theta: theta + shift, omega });
        assert_eq!(shapes::area(triangle), 3.0);
        let moved = triangle.map(|z| linear.exact(z, 1.7));
        // Coordinates of up to 160, rounded by ε/2 of themselves a few times, times edges of 4.
        assert_abs_diff_eq!(shapes::area(moved), 3.0, epsilon = 3e-15 * (1.0 + 160.0 * shift));
        let [a, b, c] = triangle;
        assert_eq!(shapes::area([a, c, b]), -3.0);
    }
    let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
    assert_eq!(shapes::area(square.map(|(theta, omega)| Phase { theta, omega })), 1.0);
    assert_eq!(shapes::area([]), 0.0);
}

/// Order against the linear equation; the damping is comparable to the frequency, so that friction
/// is not a small correction.
///
/// Catches: friction with the velocity of another stage, friction over half a kick instead of a
/// whole one.
#[rstest]
#[case(Rk4, 4.0)]
#[case(StormerVerlet, 2.0)]
fn damping_keeps_the_order<M: Method<Damped> + Info>(#[case] method: M, #[case] order: f64) {
    let damped = damped(1.0);
    let start = Phase { theta: 1e-6, omega: 1e-6 };
    let error = |steps: u64| {
        let grid = Grid::new(1.7 / steps as f64, steps).unwrap();
        let end = integrate(&damped, &method, start, &grid);
        (end.theta - small_swing(&damped, start, 1.7).theta).abs()
    };
    let coarsest = 256 >> (order as u32);
    let errors = [0, 1, 2].map(|k| error(coarsest << k));
    for pair in errors.windows(2) {
        assert_abs_diff_eq!((pair[0] / pair[1]).log2(), order, epsilon = 0.1);
    }
}

/// Catches: negative damping or NaN accepted, an error that does not give the reason.
#[rstest]
fn a_damping_that_is_none_is_refused(#[values(-0.1, f64::NAN, f64::INFINITY, f64::MAX)] beta: f64) {
    let refused = Damped::new(Pendulum::PAPER, beta).unwrap_err();
    assert!(matches!(refused, Error::Parameter { name: "damping β (1/s)", .. }), "{refused}");
    assert!(refused.to_string().contains("between 0 and 8.9e307"));
}
