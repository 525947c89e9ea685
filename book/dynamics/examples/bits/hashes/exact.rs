//! Sine and cosine, the elliptic integral, the exact motion, and what is measured along a run.

use std::f64::consts::PI;

use pendula::arithmetic::sine::{cos, sin};
use pendula::exact::{Swing, complete_elliptic_k};
use pendula::internals::double_double::reduced_sine_cosine;
use pendula::metrics::{AngleError, CrossingPeriod, EndError, EnergyDrift, Linear, PeakPeriod};
use pendula::{Grid, Motion, Pendulum, Phase, StormerVerlet, integrate_with};
use pendula_dynamics::Henon;
use pendula_dynamics::shapes::area;

use super::Hash;

/// How often each function is evaluated.
const SAMPLES: u64 = 30_000;

/// 2²⁰ quarter turns (rad), up to which the library reduces an angle itself.
const MANY_TURNS: f64 = 1_647_099.0;

/// The `n`-th of a sequence of words without order (SplitMix64: Steele, Lea, Flood, *OOPSLA 2014*).
const fn scattered(n: u64) -> u64 {
    let z = n.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// The `n`-th of a sequence of numbers in [0, 1).
fn share(n: u64) -> f64 {
    (scattered(n) >> 11) as f64 / (1_u64 << 53) as f64
}

/// The `n`-th of a sequence of numbers in [−1, 1).
fn signed(n: u64) -> f64 {
    2.0 * share(n) - 1.0
}

/// The `n`-th of a sequence of powers of two, from 2⁻¹⁰⁰ to 1.
fn small(n: u64) -> f64 {
    f64::from_bits((1023 - scattered(!n) % 101) << 52)
}

/// Angles (rad): by turns of any finite size, of many turns, and of two at most.
fn angle(n: u64) -> f64 {
    match n % 3 {
        0 => {
            let any = scattered(n);
            // The bit that makes an exponent that of infinity or NaN.
            let finite = f64::from_bits(any).is_finite();
            f64::from_bits(if finite { any } else { any & !(1 << 62) })
        }
        1 => signed(n) * MANY_TURNS,
        _ => signed(n) * 4.0 * PI,
    }
}

/// The hash of the `samples` first values of `f`.
fn of_each<const N: usize>(samples: u64, f: impl Fn(u64) -> [f64; N]) -> u64 {
    let mut hash = Hash::new();
    (1..=samples).for_each(|n| hash.add_all(f(n)));
    hash.value()
}

fn in_double_double(x: f64) -> [f64; 5] {
    let (s, c, quarters) = reduced_sine_cosine(x);
    [s.rounded(), s.remainder(), c.rounded(), c.remainder(), quarters]
}

fn pendulum() -> Pendulum {
    Pendulum::new(9.81, 1.3, 0.7).expect("parameters in range")
}

fn swing(theta0: f64) -> [f64; 5] {
    let swing = Swing::released_at(&pendulum(), theta0).expect("a finite angle");
    let moduli = [swing.modulus(), swing.complementary_modulus()];
    [moduli[0], moduli[1], swing.elliptic_k(), swing.period(), swing.ratio()]
}

/// Starts by turns of all sizes, tiny, at the bottom with about the velocity that ends on top, and
/// at rest near the top.
fn start(n: u64) -> Phase {
    let (theta, omega) = (signed(n), signed(!n));
    match n % 4 {
        0 => Phase { theta: 40.0 * theta, omega: 20.0 * omega },
        1 => Phase { theta: small(n) * theta, omega: small(n) * omega },
        2 => Phase { theta: 0.0, omega: 2.0 * pendulum().small_angle_frequency() + small(n) },
        _ => Phase::at_rest(PI - small(n)),
    }
}

/// The motion from each of many starts, and along the separatrix.
fn motions() -> u64 {
    let mut hash = Hash::new();
    for n in 1..=2000 {
        let motion = if n % 100 == 0 {
            Motion::on_separatrix(&pendulum(), 20.0 * signed(n))
        } else {
            Motion::new(&pendulum(), start(n))
        };
        let motion = motion.expect("a start in range");
        hash.add_all([motion.modulus(), motion.period().unwrap_or(0.0), motion.horizon()]);
        for t in [-3.7, 0.0, 0.1, 4.9, 1234.5, 1e5] {
            hash.add_state(motion.at(t));
        }
    }
    hash.value()
}

/// What is measured along a run of Störmer–Verlet.
fn metrics() -> u64 {
    let (pendulum, start) = (pendulum(), Phase::at_rest(2.5));
    let grid = Grid::new(0.01, 20_000).expect("a positive step");
    let motion = Motion::new(&pendulum, start).expect("a start in range");
    let mut corners = Vec::new();
    let watch = |n: u64, _: f64, z: Phase| {
        if n < 200 {
            corners.push(z);
        }
    };
    let errors = (EnergyDrift::new(&pendulum), AngleError::new(|t| motion.at(t).theta));
    let periods = (
        PeakPeriod::parabola(),
        CrossingPeriod::new(Linear),
        CrossingPeriod::default(),
        CrossingPeriod::new(Henon(&pendulum)),
    );
    let mut observers = (errors, periods, watch);
    let end = integrate_with(&pendulum, &StormerVerlet, start, &grid, &mut observers);
    let ((energy, angle), (peak, linear, hermite, henon), _) = observers;
    let mut hash = Hash::new();
    hash.add_all([energy.largest(), angle.root_mean_square(), angle.largest()]);
    let periods = [peak.period(), linear.period(), hermite.period(), henon.period()];
    periods.into_iter().for_each(|period| hash.add(period.expect("many periods")));
    hash.add(area(corners));
    let end_error = EndError::new(&pendulum, start, grid.time(grid.steps()));
    hash.add(end_error.expect("a start in range").of(end));
    hash.value()
}

/// A line for each.
pub fn lines() -> [(&'static str, u64); 7] {
    [
        ("sine", of_each(SAMPLES, |n| [sin(angle(n))])),
        ("cosine", of_each(SAMPLES, |n| [cos(angle(n))])),
        (
            "sine and cosine in twice the digits",
            of_each(SAMPLES / 10, |n| in_double_double(signed(n) * MANY_TURNS)),
        ),
        ("elliptic integral K", of_each(SAMPLES, |n| [complete_elliptic_k(share(n) * small(n))])),
        ("periods", of_each(SAMPLES, |n| swing(4.0 * PI * signed(n) * small(n)))),
        ("exact motion", motions()),
        ("metrics", metrics()),
    ]
}
