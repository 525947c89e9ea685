//! The Taylor series that chooses its step: its order, its step, its dense output, extreme scales.
//! What holds for every method with a tolerance is in `adaptive.rs`.

use pendula::adaptive::{Adaptive, SMALLEST_RELATIVE, TaylorSeries, Tolerance};
use pendula::exact::complete_elliptic_k;
use pendula::internals::{exp2, log2, order};
use pendula::systems::Analytic;
use pendula::{Compensated, CompensatedPhase, LinearOscillator, Motion, Pendulum, Phase, System};

use crate::adaptive::Number;
use crate::common::pendulum;

fn series(tolerance: f64) -> Adaptive<TaylorSeries> {
    Adaptive::new(TaylorSeries, Tolerance::uniform(tolerance).unwrap())
}

/// ẏ = y², whose motion from y is y/(1 − yt): the radius of convergence is 1/|y|, and the terms of
/// its mean rate are y² (yh)ᵏ.
struct Pole;

impl System for Pole {
    type State = Number;

    fn rate(&self, _t: f64, z: Number) -> Number {
        Number { y: z.y * z.y }
    }
}

impl Analytic for Pole {
    fn terms<const P: usize>(&self, h: f64, z: Number) -> [Number; P] {
        std::array::from_fn(|k| Number { y: z.y * z.y * (z.y * h).powi(k as i32) })
    }
}

/// The power p − i is y (yh)^(p−i), and the tolerance a = ε (1 + |y|): it is eⁱ⁻² tolerances at h =
/// ρ (eⁱ⁻² a/|y|)^(1/(p−i)), and the shortest of the six steps counts, but for 0.7 · 2^(−2/p) of
/// the radius ρ, which their ratios give exactly. The order p is 4 ⌈(2 − ln ε)/4⌉. The root is good
/// to 1 %, and its argument to 7 %, of which the root is 1 % more at p = 8 and less beyond: 2 % in
/// all; of a ratio of two it is twice that.
///
/// Catches: a wrong radius: by other powers than these, or by one of them alone; a root of the
/// wrong degree; a size in other units than tolerances; ρ/e² whatever the tolerance; a factor for
/// safety forgotten or added; a step beyond the pole, where |y| is less than a tolerance.
#[test]
fn a_step_is_as_long_as_the_known_radius_allows() {
    for (tolerance, order) in [(1e-2, 8), (1e-4, 12), (1e-6, 16), (1e-9, 24), (1e-12, 32)] {
        for y in [1e-9_f64, 1e-3, 1.0, -1.0, 40.0] {
            for way in [1.0, -1.0] {
                let end = 100.0 * way / y.abs();
                let mut walk = series(tolerance).steps(&Pole, Number { y }, 0.0, end).unwrap();
                let size = walk.next().unwrap().unwrap().size();
                let share = tolerance * (1.0 + y.abs()) / y.abs();
                let by_size =
                    |i: i32| (share * f64::from(i - 2).exp()).powf(1.0 / f64::from(order - i));
                let by_radius = 0.5_f64.powf(0.5 + 2.0 / f64::from(order));
                let expected = way * (0..6).map(by_size).fold(by_radius, f64::min) / y.abs();
                assert!(
                    (size / expected - 1.0).abs() < 0.04,
                    "{tolerance:e}, {y}: {size} s, not {expected} s"
                );
            }
        }
    }
}

/// The angular velocity of a swing, 2 k ω₀ cn, has poles at a distance K'/ω₀ beside each passage of
/// the bottom, where it is ±2i/(t − t₀); so its power q is at most 4 ρ^(−q−1), by both of them, and
/// is less by the cosine of an angle that is different for each q. With the root mean square of two
/// components the step is h = ρ (√2/4 · ε (1 + |ω|) ρ/|cos|)^(1/q). Of two neighbouring cosines
/// one is above 0.3 where the angle is not near 0 or π, and there both are: the root with q = 29 is
/// at most 4 % longer, and 2 % as above. At a turning point the passage before is as near as the
/// one after, and both together make the root 2.4 % shorter. The power of θ is smaller by q/ρ.
///
/// Catches: a step that follows the previous step and not the motion; a radius from one power,
/// which from rest is zero every second time; a wrong tolerance for one of the components.
#[test]
fn a_step_follows_the_distance_to_the_pole() {
    let pendulum = pendulum();
    let frequency = pendulum.small_angle_frequency();
    for theta_0 in [0.5_f64, 1.0, 2.0, 3.0, 3.1] {
        let motion = Motion::new(&pendulum, Phase::at_rest(theta_0)).unwrap();
        let quarter = 0.25 * motion.period().unwrap();
        let beside = complete_elliptic_k((0.5 * theta_0).sin()) / frequency;
        let (tolerance, q) = (1e-12, 29.5);
        let walk = series(tolerance);
        let walk = walk.steps(&pendulum, Phase::at_rest(theta_0), 0.0, 8.1 * quarter).unwrap();
        let mut count = 0;
        for step in walk {
            let step = step.unwrap();
            if step.end_time() == 8.1 * quarter {
                break;
            }
            // The time from the nearest passage.
            let along = (step.start_time() / quarter + 1.0).rem_euclid(2.0);
            let along = along.min(2.0 - along) * quarter;
            let radius = along.hypot(beside);
            let allowed = tolerance * (1.0 + step.start().omega.abs());
            let expected = radius * (0.25 * 2.0_f64.sqrt() * allowed * radius).powf(1.0 / q);
            let ratio = step.size() / expected;
            assert!(ratio > 0.95 && ratio < 1.06, "{theta_0}, {} s: {ratio}", step.start_time());
            count += 1;
        }
        assert!(count > 8, "{count}");
    }
}

/// No step is off by a tolerance, at any scale: what is left out is some e⁻² of it and less, and
/// the rounding of a few ε is much less than 1e-10. Each step is compared with the closed form from
/// its own start, half-way too, on the dense output.
///
/// Catches: a unit of time in which the terms overflow or vanish; a step that grows without limit
/// where nothing seems to happen; dense output of another series or in another unit.
#[test]
fn no_step_is_off_at_any_scale() {
    let tolerance = Tolerance::uniform(1e-10).unwrap();
    let adaptive = Adaptive::new(TaylorSeries, tolerance);
    let below_the_top = |below: f64| Phase::at_rest(std::f64::consts::PI - below);
    for length in [1e-12, 0.8, 1e12] {
        let pendulum = Pendulum::new(9.81, length, 1.7).unwrap();
        let frequency = pendulum.small_angle_frequency();
        for start in [
            Phase::at_rest(1e-9),
            Phase::at_rest(1e-3),
            Phase::at_rest(2.0),
            below_the_top(1e-3),
            below_the_top(1e-9),
            Phase { theta: 0.0, omega: 2.0 * frequency * (1.0 + 1e-9) },
            Phase { theta: 0.0, omega: 2.0 * frequency * (1.0 - 1e-9) },
            Phase { theta: 1.0, omega: 1e4 * frequency },
            Phase { theta: 1.0, omega: -30.0 * frequency },
        ] {
            let end = 20.0 / frequency.max(0.1 * start.omega.abs());
            let mut walk = adaptive.steps(&pendulum, start, 0.0, end).unwrap();
            while let Some(step) = walk.next() {
                let step = step.unwrap();
                let right = Motion::new(&pendulum, step.start()).unwrap();
                let dense = walk.dense(&step);
                for part in [0.5, 1.0] {
                    let off = dense.after(part) + right.at(part * step.size()) * -1.0;
                    let size = tolerance.error_norm(step.start(), step.end(), off);
                    assert!(size < 1.0, "{length:e}, {start:?}: {size} at {}", step.start_time());
                }
            }
            assert!(walk.counts().rejected == 0 && walk.counts().accepted < 2000);
        }
    }
}

/// One expansion a step, of as many powers as the order, and one slope before the first. The dense
/// output of the last step costs nothing; that of an earlier one expands again, with the same bits.
///
/// Catches: a series made twice; dense output of the step that came last for another.
#[test]
fn dense_output_is_the_series_itself() {
    let pendulum = pendulum();
    for (tolerance, order) in [(1e-3, 12), (1e-7, 20), (SMALLEST_RELATIVE, 36)] {
        let start = Phase { theta: 2.0, omega: 0.3 };
        let mut walk = series(tolerance).steps(&pendulum, start, 0.0, 10.0).unwrap();
        let (mut steps, mut seen) = (vec![], vec![]);
        while let Some(step) = walk.next() {
            let step = step.unwrap();
            let dense = walk.dense(&step);
            seen.push([0.0, 0.1, 0.7, 1.0].map(|part| dense.after(part)));
            assert_eq!((dense.after(0.0), dense.after(1.0)), (step.start(), step.end()));
            steps.push(step);
        }
        let evaluations = 1 + order * steps.len() as u64;
        assert_eq!(walk.counts().evaluations, evaluations);
        for (step, seen) in steps.iter().zip(&seen) {
            let dense = walk.dense(step);
            assert_eq!([0.0, 0.1, 0.7, 1.0].map(|part| dense.after(part)), *seen);
        }
        let again = order * (steps.len() as u64 - 1);
        assert_eq!(walk.counts().evaluations, evaluations + again);
    }
}

/// Uniform motion at a rate (1/s) has one term, whatever the step.
struct Uniform(f64);

impl System for Uniform {
    type State = Number;

    fn rate(&self, _t: f64, _z: Number) -> Number {
        Number { y: self.0 }
    }
}

impl Analytic for Uniform {
    fn terms<const P: usize>(&self, _h: f64, _z: Number) -> [Number; P] {
        std::array::from_fn(|k| Number { y: if k == 0 { self.0 } else { 0.0 } })
    }
}

/// From 1e-9 at the rate 1e-9/s the unit of time is 1 s. The one power that there is is so small
/// that it allows 4e8 s, and each step is ten times as long as the last.
///
/// Catches: a step that grows without limit where nothing changes, and jumps over what follows.
#[test]
fn no_step_grows_more_than_tenfold() {
    let mut walk = series(1e-6).steps(&Uniform(1e-9), Number { y: 1e-9 }, 0.0, 1e6).unwrap();
    for n in 1..6 {
        let step = walk.next().unwrap().unwrap();
        assert!((step.size() / 10_f64.powi(n) - 1.0).abs() < 1e-12, "{}", step.size());
    }
    let end = walk.last().unwrap().unwrap().end();
    assert!((end.y - 1e-9 - 1e-3).abs() < 1e-15, "{end:?}");
}

/// Of uniform motion from 1 at the rate 1 all powers but the first vanish, and it decides as the
/// six would that follow it if they fell by e each: e^(p−3) tolerances of 2e-6, at p = 16.
///
/// Catches: powers that vanish taken for a series that has ended, so that a motion that lacks more
/// of them than are looked at gets a step without limit.
#[test]
fn where_six_powers_vanish_the_last_that_does_not_decides() {
    let mut walk = series(1e-6).steps(&Uniform(1.0), Number { y: 1.0 }, 0.0, 1e6).unwrap();
    let size = walk.next().unwrap().unwrap().size();
    let expected = 13.0_f64.exp() * 2e-6;
    assert!((size / expected - 1.0).abs() < 0.08, "{size} s, not {expected} s");
    assert_eq!(walk.last().unwrap().unwrap().end_time(), 1e6);
}

/// At rest at the bottom nothing changes; at the top it does, by what π is rounded.
///
/// Catches: a division by the size of a series that is zero; a first unit of zero or infinity.
#[test]
fn an_equilibrium_is_no_trouble() {
    let pendulum = pendulum();
    let bottom = Phase::at_rest(0.0);
    let (end, counts) = series(1e-9).integrate(&pendulum, bottom, 0.0, 1e6, &mut ()).unwrap();
    assert_eq!((end, counts.accepted), (bottom, 1));
    let top = Phase::at_rest(std::f64::consts::PI);
    let right = Motion::new(&pendulum, top).unwrap();
    let (end, _) = series(1e-9).integrate(&pendulum, top, 0.0, 4.0, &mut ()).unwrap();
    // e^(ω₀ · 4 s) = 1.2e6 times 1.2e-16; each step is off by 1e-9 · e⁻³ at most, and that grows as
    // much, from the first step on, of which there are a few.
    assert!((end.theta - right.at(4.0).theta).abs() < 1e-3, "{end:?}");
}

/// The linear oscillator is a cosine, whose series converges everywhere: the steps are longer than
/// a radian. With compensated sums the pendulum takes the same steps, up to rounding.
///
/// Catches: a series that is made for the pendulum alone.
#[test]
fn any_analytic_system_will_do() {
    let pendulum = pendulum();
    let start = Phase { theta: 1.0, omega: 0.0 };
    let phase = 30.0 * pendulum.small_angle_frequency();
    let linear = LinearOscillator::new(pendulum);
    let (end, counts) = series(1e-12).integrate(&linear, start, 0.0, 30.0, &mut ()).unwrap();
    // Less than 100 steps, each off by a tolerance at most, and none grows.
    assert!((end.theta - phase.cos()).abs() < 1e-10, "{end:?}");
    assert!((counts.accepted as f64) < phase, "{counts:?}");

    let (plain, steps) = series(1e-12).integrate(&pendulum, start, 0.0, 30.0, &mut ()).unwrap();
    let (kept, same) = series(1e-12)
        .integrate(&Compensated::new(pendulum), CompensatedPhase::from(start), 0.0, 30.0, &mut ())
        .unwrap();
    assert_eq!(steps, same);
    // 100 steps of a few roundings, each carried on by 100 steps more.
    assert!((kept.phase.theta - plain.theta).abs() < 1e-11, "{kept:?}, {plain:?}");
}

/// From the exponents at both ends and the mantissas between: log₂(1 + f) − f is at most
/// 0.0861, at f = 1/ln 2 − 1; and 2ᶠ, for |f| ≤ ½, is within 0.9 % of its parabola.
///
/// Catches: an exponent off by one, a mantissa that is not in it, a fraction rounded the wrong
/// way: steps that are wrong by up to 9 %, which the tolerance would hide.
#[test]
fn roots_are_good_to_a_hundredth() {
    for n in 0..40_000 {
        let y = f64::from(n - 20_000) / 20.0 + 0.013;
        let power = libm::exp2(y);
        let short = y - log2(power);
        assert!((-1e-9..0.0861).contains(&short), "{y}: {short}");
        assert!((exp2(y) / power - 1.0).abs() < 0.0095, "{y}: {}", exp2(y));
    }
    assert_eq!((log2(0.0), log2(1.0), exp2(0.0), exp2(-3.0)), (-1023.0, 0.0, 1.0, 0.125));
}

/// ⌈(2 − ln ε)/4⌉ blocks of four, by hand: 2 − ln 1e-12 = 29.6.
///
/// Catches: Jorba and Zou's order, half of it; a decimal or binary logarithm; an order that
/// there are no terms for.
#[test]
fn the_order_follows_from_the_tolerance() {
    for (relative, expected) in [
        (SMALLEST_RELATIVE, 36),
        (1e-14, 36),
        (1e-12, 32),
        (1e-10, 28),
        (1e-8, 24),
        (1e-6, 16),
        (1e-4, 12),
        (1e-2, 8),
        (0.5, 4),
        (1.0_f64.next_down(), 4),
    ] {
        assert_eq!(order(&Tolerance::new(1.0, relative).unwrap()), expected, "{relative}");
    }
}
