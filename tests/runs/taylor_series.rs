//! The Taylor series that chooses its step: its order, its step, its dense output, extreme scales.
//! What holds for every method with a tolerance is in `adaptive.rs`.

use pendula::adaptive::{Adaptive, SMALLEST_RELATIVE, TaylorSeries, Tolerance};
use pendula::exact::complete_elliptic_k;
use pendula::internals::{exp2, log2, order};
use pendula::systems::{Analytic, Majorant};
use pendula::{
    Compensated, CompensatedPhase, LinearOscillator, Motion, Pendulum, Phase, RateOf, System,
};

use crate::adaptive::Number;
use crate::common::pendulum;

fn series(tolerance: f64) -> Adaptive<'static, TaylorSeries> {
    Adaptive::new(TaylorSeries, Tolerance::uniform(tolerance).unwrap())
}

/// The same system, of which no bound on the powers is known.
pub struct WithoutMajorant<'a, S>(pub &'a S);

impl<S: System> System for WithoutMajorant<'_, S> {
    type State = S::State;

    fn rate(&self, t: f64, z: S::State) -> RateOf<S> {
        self.0.rate(t, z)
    }
}

impl<S: Analytic> Analytic for WithoutMajorant<'_, S> {
    fn terms<const P: usize>(&self, h: f64, z: S::State) -> [RateOf<S>; P] {
        self.0.terms::<P>(h, z)
    }
}

/// The system with a bound on its powers, which a function tells.
struct WithMajorant<'a, S: System, F: Fn(S::State) -> Majorant<RateOf<S>>>(&'a S, F);

impl<S: System, F: Fn(S::State) -> Majorant<RateOf<S>>> System for WithMajorant<'_, S, F> {
    type State = S::State;

    fn rate(&self, t: f64, z: S::State) -> RateOf<S> {
        self.0.rate(t, z)
    }
}

impl<S: Analytic, F: Fn(S::State) -> Majorant<RateOf<S>>> Analytic for WithMajorant<'_, S, F> {
    fn terms<const P: usize>(&self, h: f64, z: S::State) -> [RateOf<S>; P] {
        self.0.terms::<P>(h, z)
    }

    fn majorant(&self, z: S::State) -> Option<Majorant<RateOf<S>>> {
        Some((self.1)(z))
    }
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
    for (tolerance, order) in [(1e-2, 8), (1e-4, 12), (1e-6, 16), (1e-9, 24), (1e-12, 24)] {
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

/// The same motion with its majorant: the power k is y (y t)ᵏ. In tolerances its size is |y|/a, and
/// the step the share (a/|y|)^(1/(p−2)) of 1/|y|, at most 0.67 of it. The logarithm is good to 7 %,
/// and its root to 1 %, as above. The last step, which ends at a given time, is as good as the
/// others, and so is dense output.
///
/// Catches: a step that is read off the powers although they are bounded, or a bound in other units
/// than tolerances; a share beyond the one to which the bound is one of the error; a unit that the
/// steps drag along; a displacement that was kept for another step.
#[test]
fn a_step_is_as_long_as_a_majorant_allows() {
    let known = WithMajorant(&Pole, |z: Number| Majorant {
        radius: 1.0 / z.y.abs(),
        size: Number { y: z.y.abs() },
    });
    for (tolerance, order) in [(0.5, 4), (1e-2, 8), (1e-4, 12), (1e-6, 16), (1e-9, 24)] {
        for y in [1e-3_f64, 1.0, -1.0, 40.0] {
            for way in [1.0, -1.0] {
                let end = way * 0.9 / y.abs();
                let exact = |from: f64, t: f64| from / (1.0 - from * t);
                let mut walk = series(tolerance).steps(&known, Number { y }, 0.0, end).unwrap();
                let mut is_first = true;
                while let Some(step) = walk.next() {
                    let step = step.unwrap();
                    let from = step.start().y;
                    let allowed = tolerance * (1.0 + from.abs()) / from.abs();
                    let share = allowed.powf(1.0 / f64::from(order - 2)).min(0.67);
                    let ratio = step.size() * from.abs() / (way * share);
                    let is_last = step.end_time() == end;
                    assert!(
                        ratio < 1.03 && (is_last || ratio > 0.96),
                        "{tolerance:e}, {y}: {ratio}"
                    );
                    let dense = walk.dense(&step);
                    for part in [0.3, 1.0] {
                        let off = dense.after(part).y - exact(from, part * step.size());
                        let most = tolerance * (1.0 + from.abs().max(dense.after(part).y.abs()));
                        assert!(off.abs() < most, "{tolerance:e}, {y}: {off:e} at {part}");
                    }
                    assert_eq!(dense.after(1.0), step.end());
                    is_first = false;
                }
                assert!(!is_first);
            }
        }
    }
}

/// In the first step the unit of time is the time in which the state would change by as much as it
/// is, and a step may be ten of them; so is any step ten of the one before.
///
/// Catches: a majorant that is so generous that a step jumps over what follows.
#[test]
fn a_majorant_does_not_make_a_step_grow_more_than_tenfold() {
    let uniform = Uniform(1e-9);
    let known = WithMajorant(&uniform, |_| Majorant { radius: 1e9, size: Number { y: 0.0 } });
    let mut walk = series(1e-6).steps(&known, Number { y: 1e-9 }, 0.0, 1e6).unwrap();
    for n in 1..6 {
        let step = walk.next().unwrap().unwrap();
        assert!((step.size() / 10_f64.powi(n) - 1.0).abs() < 1e-12, "{}", step.size());
    }
}

/// A state at which the pendulum knows its majorant: any, but for fast rotations and a surrounding
/// of the equilibria.
fn states() -> impl Iterator<Item = Phase> {
    let frequency = pendulum().small_angle_frequency();
    (0..=400).flat_map(move |i| {
        let theta = std::f64::consts::PI * f64::from(i) / 400.0;
        (0..=100).map(move |j| Phase { theta, omega: frequency * 0.05 * f64::from(j) })
    })
}

/// The majorant is one: no power from the fifth on is larger, in either component, of any state and
/// up to the 40th; and it isn't much too large either, since some power comes near to it.
///
/// Catches: a size found from some motions, as of the passage through the bottom, 4; a size in
/// units of 1/ω₀, or the one of θ for ω.
#[test]
fn no_power_of_the_pendulum_is_beyond_its_majorant() {
    let pendulum = pendulum();
    let (mut count, mut largest) = (0, [0.0_f64; 2]);
    for z in states() {
        let Some(Majorant { radius, size }) = pendulum.majorant(z) else { continue };
        count += 1;
        let terms = pendulum.terms::<40>(radius, z);
        for term in &terms[4..] {
            let ratio = [term.theta * radius / size.theta, term.omega * radius / size.omega];
            for (largest, ratio) in largest.iter_mut().zip(ratio) {
                *largest = largest.max(ratio.abs());
            }
        }
    }
    assert!(count > 40_000, "{count}");
    assert!(largest.iter().all(|largest| (0.95..1.0).contains(largest)), "{largest:?}");
}

/// It bends with ω = 5 ω₀ and at sin² θ + ω²/ω₀² = 0.01, and depends on θ by its sine alone.
///
/// Catches: a bound where it would make the steps several times shorter; none where the pendulum
/// swings as widely as anyone would let it.
#[test]
fn the_pendulum_knows_its_majorant_where_it_is_close() {
    let pendulum = pendulum();
    let frequency = pendulum.small_angle_frequency();
    let knows =
        |theta, omega: f64| pendulum.majorant(Phase { theta, omega: frequency * omega }).is_some();
    assert!(knows(0.1002, 0.0) && knows(0.0, 0.1001) && knows(1.0, -4.99) && knows(3.04, 0.0));
    assert!(!knows(0.0999, 0.0) && !knows(0.0, 0.0999) && !knows(1.0, -5.01) && !knows(3.043, 0.0));
    let with_errors = Compensated::new(pendulum);
    let z = Phase { theta: 1.0, omega: 2.0 };
    assert_eq!(with_errors.majorant(CompensatedPhase::from(z)), pendulum.majorant(z));
    let (once, turned) =
        (pendulum.majorant(z).unwrap(), Phase { theta: 1.0 + 6.0 * std::f64::consts::PI, ..z });
    assert!((pendulum.majorant(turned).unwrap().radius / once.radius - 1.0).abs() < 1e-14);
    for wrong in [f64::NAN, f64::INFINITY] {
        assert_eq!(pendulum.majorant(Phase { theta: 1.0, omega: wrong }), None);
        assert_eq!(pendulum.majorant(Phase { theta: wrong, omega: 1.0 }), None);
    }
}

/// The angular velocity of a swing, 2 k ω₀ cn, has poles at a distance K'/ω₀ beside each passage of
/// the bottom, where it is ±2i/(t − t₀); so its power q is at most 4 ρ^(−q−1), by both of them, and
/// is less by the cosine of an angle that is different for each q. With the root mean square of two
/// components the step is h = ρ (√2/4 · ε (1 + |ω|) ρ/|cos|)^(1/q). Of two neighbouring cosines
/// one is above 0.3 where the angle is not near 0 or π, and there both are: the root with q = 21 is
/// at most 6 % longer, and 2 % as above. At a turning point the passage before is as near as the
/// one after, and both together make the root 3.3 % shorter. The power of θ is smaller by q/ρ. The
/// pendulum's own majorant is not used.
///
/// Catches: a step that follows the previous step and not the motion; a radius from one power,
/// which from rest is zero every second time; a wrong tolerance for one of the components.
#[test]
fn a_step_follows_the_distance_to_the_pole() {
    let pendulum = pendulum();
    let (hidden, frequency) = (WithoutMajorant(&pendulum), pendulum.small_angle_frequency());
    for theta_0 in [0.5_f64, 1.0, 2.0, 3.0, 3.1] {
        let motion = Motion::new(&pendulum, Phase::at_rest(theta_0)).unwrap();
        let quarter = 0.25 * motion.period().unwrap();
        let beside = complete_elliptic_k((0.5 * theta_0).sin()) / frequency;
        let (tolerance, q) = (1e-12, 21.5);
        let walk = series(tolerance);
        let start = Phase::at_rest(theta_0);
        let walk = walk.steps(&hidden, start, 0.0, 8.1 * quarter).unwrap();
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
            assert!(ratio > 0.94 && ratio < 1.08, "{theta_0}, {} s: {ratio}", step.start_time());
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
    for (tolerance, order) in [(1e-3, 12), (1e-7, 20), (SMALLEST_RELATIVE, 24)] {
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
    let (end, counts) = series(1e-9).integrate(&pendulum, bottom, 0.0, 1e6).unwrap();
    assert_eq!((end, counts.accepted), (bottom, 1));
    let top = Phase::at_rest(std::f64::consts::PI);
    let right = Motion::new(&pendulum, top).unwrap();
    let (end, _) = series(1e-9).integrate(&pendulum, top, 0.0, 4.0).unwrap();
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
    let (end, counts) = series(1e-12).integrate(&linear, start, 0.0, 30.0).unwrap();
    // Less than 100 steps, each off by a tolerance at most, and none grows.
    assert!((end.theta - phase.cos()).abs() < 1e-10, "{end:?}");
    assert!((counts.accepted as f64) < phase, "{counts:?}");

    let (plain, steps) = series(1e-12).integrate(&pendulum, start, 0.0, 30.0).unwrap();
    let (kept, same) = series(1e-12)
        .integrate(&Compensated::new(pendulum), CompensatedPhase::from(start), 0.0, 30.0)
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

/// ⌈(2 − ln ε)/4⌉ blocks of four, and six at most; by hand: 2 − ln 1e-6 = 15.8.
///
/// Catches: Jorba and Zou's order, half of it; a decimal or binary logarithm; an order that
/// there are no terms for.
#[test]
fn the_order_follows_from_the_tolerance() {
    for (relative, expected) in [
        (SMALLEST_RELATIVE, 24),
        (1e-10, 24),
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
