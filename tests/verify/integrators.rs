//! The judge, on integrators written as their users would: closures with the platform's sine, right
//! ones and wrong ones.

use std::f64::consts::{PI, TAU};

use pendula::{Hamiltonian, Motion, Pendulum, Phase};
use pendula_judge::{Claims, FromFn, Property, Verdict, judge};
use rstest::rstest;

use crate::looks::{self, Run};
use crate::programs::{State, kick_drift, leapfrog, steps};

/// A step of h (s) with g/L (1/s²).
type Step = fn(f64, State, f64) -> State;

/// A one-step method as an integrator.
fn stepping(
    step: impl Fn(f64, State, f64) -> State,
) -> impl Fn(f64, f64, f64, f64, u64) -> Vec<State> {
    move |g, theta, omega, h, n| steps(theta, omega, n, |z| step(g, z, h))
}

fn rate(g: f64, (theta, omega): State) -> State {
    (omega, -g * theta.sin())
}

fn along(z: State, rate: State, h: f64) -> State {
    (z.0 + h * rate.0, z.1 + h * rate.1)
}

/// One step of a program of `looks.rs`.
fn one_of(run: Run, g: f64, (theta, omega): State, h: f64) -> State {
    let end = run(&|_, theta| -g * theta.sin(), Phase { theta, omega }, h, 1)[0];
    (end.theta, end.omega)
}

fn velocity_verlet_by_the_book(g: f64, (theta, omega): State, h: f64) -> State {
    let a = -g * theta.sin();
    let next = theta + h * omega + 0.5 * h * h * a;
    (next, omega + 0.5 * h * (a - g * next.sin()))
}

fn position_verlet(g: f64, (theta, omega): State, h: f64) -> State {
    let middle = theta + 0.5 * h * omega;
    let omega = omega - h * g * middle.sin();
    (middle + 0.5 * h * omega, omega)
}

fn drift_kick(g: f64, (theta, omega): State, h: f64) -> State {
    let theta = theta + h * omega;
    (theta, omega - h * g * theta.sin())
}

fn forward(g: f64, z: State, h: f64) -> State {
    along(z, rate(g, z), h)
}

fn rk4(g: f64, z: State, h: f64) -> State {
    one_of(looks::rk4, g, z, h)
}

fn heun(g: f64, z: State, h: f64) -> State {
    let ahead = forward(g, z, h);
    along(along(z, rate(g, z), 0.5 * h), rate(g, ahead), 0.5 * h)
}

/// The state that `better` leaves as it is, from `next` on.
fn settled(mut next: State, better: impl Fn(State) -> State) -> State {
    for _ in 0..100 {
        let before = next;
        next = better(before);
        if next == before {
            break;
        }
    }
    next
}

/// z' = z + h (f(z) + f(z'))/2, to the last digit.
fn trapezoidal(g: f64, z: State, h: f64) -> State {
    let known = along(z, rate(g, z), 0.5 * h);
    settled(forward(g, z, h), |next| along(known, rate(g, next), 0.5 * h))
}

/// The midpoint rule with the force times sin δ/δ, where δ is half the way, to the last digit.
fn discrete_gradient(g: f64, z: State, h: f64) -> State {
    let mean_rate = |next: State| {
        let (half, omega) = (0.5 * (next.0 - z.0), 0.5 * (z.1 + next.1));
        let ratio = if half == 0.0 { 1.0 } else { half.sin() / half };
        (omega, -g * (z.0 + half).sin() * ratio)
    };
    settled(forward(g, z, h), |next| along(z, mean_rate(next), h))
}

/// The same in steps of (2/ω₀) tan(ω₀h/2).
fn cieslinski_ratkiewicz(g: f64, z: State, h: f64) -> State {
    let half = 0.5 * g.sqrt();
    discrete_gradient(g, z, (half * h).tan() / half)
}

/// The bottom that is nearest.
fn nearest(theta: f64) -> f64 {
    TAU * (theta / TAU).round()
}

/// Half a kick by θ − sin θ, a rotation by ω₀h, half a kick: about the nearest bottom; between two
/// bottoms the rotation is a kick, a drift and a kick.
fn deuflhard(g: f64, (theta, omega): State, h: f64) -> State {
    let frequency = g.sqrt();
    let tangent = (0.5 * frequency * h).tan() / frequency;
    let kick = |theta: f64| {
        let rest = theta - nearest(theta);
        g * (0.5 * h * (rest - theta.sin()) - tangent * rest)
    };
    let omega = omega + kick(theta);
    let theta = theta + omega * (frequency * h).sin() / frequency;
    (theta, omega + kick(theta))
}

/// Half a rotation about the `bottom`, a kick by θ − sin θ, half a rotation.
fn rotation_kick_rotation(g: f64, (theta, omega): State, h: f64, bottom: fn(f64) -> f64) -> State {
    let frequency = g.sqrt();
    let turn = |(theta, omega): State| {
        let (sin, cos) = (0.5 * frequency * h).sin_cos();
        let rest = theta - bottom(theta);
        let turned = rest * cos + omega / frequency * sin;
        (theta + (turned - rest), omega * cos - rest * frequency * sin)
    };
    let (theta, omega) = turn((theta, omega));
    turn((theta, omega + g * h * (theta - bottom(theta) - theta.sin())))
}

/// Adams and Bashforth's method of order 2, with a step of Heun's to begin.
fn adams_bashforth(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    let (mut before, mut z) = (rate(g, (theta, omega)), heun(g, (theta, omega), h));
    let mut states = vec![z];
    for _ in 1..n {
        let now = rate(g, z);
        z = along(z, (1.5 * now.0 - 0.5 * before.0, 1.5 * now.1 - 0.5 * before.1), h);
        before = now;
        states.push(z);
    }
    states
}

/// Störmer's form, θ₊ = 2θ − θ₋ + h²α, with the velocity by central differences.
fn stormers_form(g: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<State> {
    let a = |theta: f64| -g * theta.sin();
    let (mut before, mut now) = (theta, theta + h * omega + 0.5 * h * h * a(theta));
    let mut states = Vec::new();
    for _ in 0..n {
        let next = 2.0 * now - before + h * h * a(now);
        states.push((now, (next - before) / (2.0 * h)));
        (before, now) = (now, next);
    }
    states
}

/// Catches: a judge that refuses a right method, whose sine, sums and way of writing are not the
/// library's; an identity that is not recognised.
#[rstest]
#[case::verlet(
    leapfrog, Claims::order(2).symplectic().symmetric().bounded_energy(), "stormer-verlet",
)]
#[case::velocity_verlet(
    velocity_verlet_by_the_book, Claims::order(2).symplectic().symmetric(), "stormer-verlet",
)]
#[case::position_verlet(
    position_verlet, Claims::order(2).symplectic().symmetric(), "position-verlet",
)]
#[case::semi_implicit(
    kick_drift, Claims::order(1).symplectic().bounded_energy(), "symplectic-euler",
)]
#[case::drift_kick(drift_kick, Claims::order(1).symplectic(), "symplectic-euler-drift-first")]
#[case::forward(forward, Claims::order(1), "forward-euler")]
#[case::rk4(rk4, Claims::order(4), "rk4")]
#[case::three_eighths(
    |g, z, h| one_of(looks::three_eighths, g, z, h), Claims::order(4), "three-eighths",
)]
#[case::ralston(|g, z, h| one_of(looks::ralston, g, z, h), Claims::order(2), "ralston-2")]
#[case::heun(heun, Claims::order(2), "heun")]
#[case::trapezoidal(
    trapezoidal, Claims::order(2).symmetric().bounded_energy(), "trapezoidal",
)]
#[case::discrete_gradient(
    discrete_gradient, Claims::order(2).symmetric(), "discrete-gradient",
)]
#[case::cieslinski_ratkiewicz(
    cieslinski_ratkiewicz, Claims::order(2).symmetric(), "cieslinski-ratkiewicz",
)]
#[case::deuflhard(
    deuflhard, Claims::order(2).symplectic().symmetric().bounded_energy(), "deuflhard",
)]
#[case::rotation_kick_rotation(
    |g, z, h| rotation_kick_rotation(g, z, h, nearest), Claims::order(2).symplectic(), "",
)]
fn right_ones_are_accepted(#[case] step: Step, #[case] claims: Claims, #[case] identity: &str) {
    let report = judge(&FromFn(stepping(step)), claims);
    assert_eq!(report.verdict, Verdict::Holds, "{report}");
    assert_eq!(report.identity.as_ref().map_or("", |found| found.method), identity, "{report}");
}

/// Catches: a judge that takes what a method keeps of the past for a wrong clock, or refuses
/// velocities that are differences.
#[rstest]
#[case::adams_bashforth(adams_bashforth, Claims::order(2))]
#[case::stormers_form(stormers_form, Claims::order(2))]
fn methods_of_several_steps_are_accepted(
    #[case] run: fn(f64, f64, f64, f64, u64) -> Vec<State>,
    #[case] claims: Claims,
) {
    let report = judge(&FromFn(run), claims);
    assert_eq!(report.verdict, Verdict::Holds, "{report}");
}

/// Störmer–Verlet under a small torque (1/s²), which no unit of time can explain away.
fn pushed(torque: f64, g: f64, z: State, h: f64) -> State {
    let (theta, omega) = leapfrog(g, z, h);
    (theta, omega + torque * h)
}

/// Störmer–Verlet under a small friction (1/s).
fn rubbed(friction: f64, g: f64, z: State, h: f64) -> State {
    let (theta, omega) = leapfrog(g, z, h);
    (theta, omega * (1.0 - friction * h))
}

/// Störmer–Verlet that loses this share of the velocity in each step.
fn losing(share: f64, g: f64, z: State, h: f64) -> State {
    let (theta, omega) = leapfrog(g, z, h);
    (theta, omega * (1.0 - share))
}

/// Störmer–Verlet that takes off whole turns with nine digits of π, and adds them again.
fn verlet_with_a_short_pi(g: f64, (theta, omega): State, h: f64) -> State {
    let turn = 2.0 * 314_159_265.0 / 1e8;
    let turns = (theta / turn).round() * turn;
    let (theta, omega) = leapfrog(g, (theta - turns, omega), h);
    (theta + turns, omega)
}

fn to_seven_digits(z: State) -> State {
    (f64::from(z.0 as f32), f64::from(z.1 as f32))
}

/// Catches: a judge that lets a wrong method pass, or refuses it for a reason that is not its own.
#[rstest]
#[case::a_half_in_the_fifth_digit(
    |g: f64, (theta, omega): State, h: f64| {
        let half = omega - 0.50001 * h * g * theta.sin();
        let theta = theta + h * half;
        (theta, half - 0.5 * h * g * theta.sin())
    },
    Claims::order(2), "order",
)]
#[case::a_stale_force(
    |g: f64, (theta, omega): State, h: f64| {
        let a = -g * theta.sin();
        (theta + h * omega + 0.5 * h * h * a, omega + h * a)
    },
    Claims::order(2), "order",
)]
#[case::single_precision(
    |g: f64, z, h: f64| to_seven_digits(leapfrog(g, z, h)), Claims::order(2), "precision",
)]
#[case::a_billionth_lost(
    |g: f64, z, h: f64| losing(1e-9, g, z, h), Claims::order(2).symmetric(), "loss",
)]
#[case::a_trillionth_lost(
    |g: f64, z: State, h: f64| {
        let (theta, omega) = kick_drift(g, z, h);
        (theta, omega * (1.0 - 1e-12))
    },
    Claims::order(1).symplectic(), "loss",
)]
#[case::heun_for_the_midpoint(heun, Claims::order(2).name("explicit-midpoint"), "name")]
#[case::position_for_velocity_verlet(
    position_verlet, Claims::order(2).name("stormer-verlet"), "name",
)]
#[case::drift_kick_for_kick_drift(drift_kick, Claims::order(1).name("symplectic-euler"), "name")]
#[case::trapezoidal_claimed_symplectic(trapezoidal, Claims::order(2).symplectic(), "area")]
#[case::rk4_claimed_symmetric(rk4, Claims::order(4).symmetric(), "reversal")]
#[case::forward_claimed_bounded(forward, Claims::order(1).bounded_energy(), "energy")]
#[case::wrapped(
    |g: f64, z, h: f64| {
        let (theta, omega) = leapfrog(g, z, h);
        ((theta + PI).rem_euclid(TAU) - PI, omega)
    },
    Claims::order(2), "turn",
)]
#[case::a_rotation_about_one_bottom_alone(
    |g, z, h| rotation_kick_rotation(g, z, h, |_| 0.0), Claims::order(2).symplectic(), "turn",
)]
#[case::trapezoidal_for_the_midpoint(
    trapezoidal, Claims::order(2).symmetric().name("implicit-midpoint"), "name",
)]
#[case::a_pi_of_nine_digits(verlet_with_a_short_pi, Claims::order(2), "turn")]
#[case::a_torque(|g: f64, z, h: f64| pushed(1e-12, g, z, h), Claims::order(2), "mirror")]
#[case::a_torque_as_large_as_a_tolerance(
    |g: f64, z, h: f64| pushed(1e-8, g, z, h), Claims::order(2), "mirror",
)]
#[case::a_loss_with_the_step(|g: f64, z, h: f64| rubbed(1e-6, g, z, h), Claims::order(2), "units")]
#[case::g_of_the_earth(|_, z, h: f64| leapfrog(9.81, z, h), Claims::order(2), "units")]
fn wrong_ones_are_refused(#[case] step: Step, #[case] claims: Claims, #[case] by: &str) {
    let report = judge(&FromFn(stepping(step)), claims);
    assert_eq!(report.verdict, Verdict::Fails, "{report}");
    assert!(report.failures().any(|property| property.name() == by), "{report}");
}

/// A share s of the velocity lost takes 2sK of the kinetic energy K, and so, on average over a
/// period, the share 2s⟨K⟩/E of the energy E. At the judge's start, (1.2 rad, 0.8 rad/s) with
/// g/L = 12.2625/s², that is 0.95 s: half the energy of a small swing is kinetic, and a little less
/// of a wide one. The way of 79 periods out, and as many home, ends within a period: by 1 % of the
/// mean at most; and by the end E itself has fallen by 2e-5.
///
/// Catches: the loss of the way out and home taken for that of the steps of one way.
#[test]
fn a_loss_is_told_in_its_size() {
    const SHARE: f64 = 1e-9;
    let (g_over_l, start) = (12.2625, Phase { theta: 1.2, omega: 0.8 });
    let pendulum = Pendulum::new(g_over_l, 1.0, 1.0).unwrap();
    let motion = Motion::new(&pendulum, start).unwrap();
    let period = motion.period().expect("it swings");
    // The sum over a period of a smooth periodic function is its mean to all digits.
    let kinetic = |n: u32| 0.5 * motion.at(period * f64::from(n) / 64.0).omega.powi(2);
    let mean = (0..64).map(kinetic).sum::<f64>() / 64.0;
    let expected = SHARE * 2.0 * mean / pendulum.energy(start);

    let step = |g: f64, z, h: f64| losing(SHARE, g, z, h);
    let report = judge(&FromFn(stepping(step)), Claims::order(2).symmetric());
    let loss = report.finding(Property::Loss).expect("a loss is looked for");
    let [told] = loss.values[..] else { panic!("{report}") };
    assert!((told / expected - 1.0).abs() <= 0.015, "{told:e}, not {expected:e}");
}

/// So small a friction cannot be told from a solver's tolerance inside a right method.
///
/// Catches: a judge that lets what a tolerance may do pass as rounding.
#[test]
fn a_loss_as_small_as_a_tolerance_is_unclear() {
    let step = |g: f64, z, h: f64| rubbed(1e-10, g, z, h);
    let report = judge(&FromFn(stepping(step)), Claims::order(2).symmetric());
    assert_eq!(report.verdict, Verdict::Unclear, "{report}");
    let loss = report.finding(Property::Loss).expect("a loss is looked for");
    assert_eq!(loss.verdict, Verdict::Unclear, "{report}");
}

/// Catches: a clock that is off by a step now and then.
#[rstest]
#[case::a_step_dropped_in_a_thousand(|n: u64, _: f64| (1..=n).map(|k| k - k / 1000).collect())]
#[case::time_added_up(|n: u64, h: f64| {
    let (mut t, mut steps) = (0.0, 0);
    let mut by_the_time = |k: u64| {
        while t < k as f64 * h.abs() {
            t += h.abs();
            steps += 1;
        }
        steps
    };
    (1..=n).map(&mut by_the_time).collect()
})]
fn wrong_clocks_are_refused(#[case] steps: fn(u64, f64) -> Vec<u64>) {
    let run = |g: f64, theta: f64, omega: f64, h: f64, n: u64| {
        let steps = steps(n, h);
        let taken = stepping(leapfrog)(g, theta, omega, h, steps[steps.len() - 1]);
        // As many states as are asked for, whenever they are.
        steps.into_iter().map(move |steps| taken[(steps.max(1) - 1) as usize])
    };
    let report = judge(&FromFn(run), Claims::order(2));
    assert!(report.failures().any(|property| property == Property::Clock), "{report}");
}

/// Every state number 1000, where a buffer of states is full, has the velocity of the state before.
/// Its angles are right, and so is every run shorter than that.
///
/// Catches: a judge that looks at the angles alone.
#[test]
fn a_late_velocity_is_a_wrong_clock() {
    let run = |g: f64, theta: f64, omega: f64, h: f64, n: u64| {
        let right = stepping(leapfrog)(g, theta, omega, h, n);
        let mut states = right.clone();
        for full in (999..right.len()).step_by(1000) {
            states[full].1 = right[full - 1].1;
        }
        states
    };
    let report = judge(&FromFn(run), Claims::order(2));
    let clock = report.finding(Property::Clock).expect("it is implied");
    assert_eq!(clock.verdict, Verdict::Fails, "{report}");
}
