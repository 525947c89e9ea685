//! A step of the Taylor series whose end is beyond the range of f64, although the motion is not.

use pendula::adaptive::{Adaptive, TaylorSeries, Tolerance};
use pendula::systems::Analytic;
use pendula::{LinearOscillator, Pendulum, Phase, System};

use crate::adaptive::Number;

/// A walk that overflows takes a few attempts more, and not a million.
const ATTEMPTS: u64 = 1000;

/// Steps that are off by no more than this share of a component, or of `size` where it is small.
fn series(share: f64, size: f64) -> Adaptive<'static, TaylorSeries> {
    let tolerance = Tolerance::new(share * size, share).unwrap();
    Adaptive::new(TaylorSeries, tolerance).max_attempts(ATTEMPTS)
}

/// The linear pendulum with ω₀ = 1/s and an amplitude A near the end of the range. At these
/// tolerances a step is so long that it leads from one side to the other, by more than the largest
/// f64: the displacement overflows, where the angle would not. Each step is off by a tolerance of
/// the amplitude at most, and keeps what the ones before were off by.
///
/// Catches: the same step tried again after an overflow, until no attempt is left; a step so much
/// shorter that the walk creeps on; a state that is off where it has been.
#[test]
fn a_walk_goes_on_after_a_displacement_that_overflows() {
    const A: f64 = 1.75e308;
    let linear = LinearOscillator::new(Pendulum::new(1.0, 1.0, 1.0).unwrap());
    for tolerance in [1e-5, 1e-6, 1e-8] {
        for start in [Phase::at_rest(-A), Phase::at_rest(A)] {
            for until in [20.0, -20.0] {
                let mut walk = series(tolerance, A).steps(&linear, start, 0.0, until).unwrap();
                let mut taken = 0.0;
                while let Some(step) = walk.next() {
                    let (step, right) = (step.unwrap(), linear.exact(start, walk.time()));
                    taken += 1.0;
                    let off = |x: f64, y: f64| (x / A - y / A).abs();
                    let end = step.end();
                    let off = off(end.theta, right.theta).max(off(end.omega, right.omega));
                    // The root mean square of two components, of which one alone may be off.
                    let allowed = taken * 2.0_f64.sqrt() * tolerance;
                    assert!(off <= allowed, "{off:e} after {taken} steps at {tolerance:e}");
                }
                let counts = walk.counts();
                assert!(counts.rejected > 0, "nothing overflows at {tolerance:e}: {counts:?}");
                // 20 s in steps of some 0.4 s, each after an attempt that was too long.
                assert!(counts.accepted + counts.rejected < 200, "{counts:?}");
            }
        }
    }
}

/// A constant rate: no step is too long for the tolerance, and one that leads from −1.5e308 to
/// 1.5e308 overflows.
struct Uniform;

impl System for Uniform {
    type State = Number;

    fn rate(&self, _t: f64, _z: Number) -> Number {
        Number { y: 1e300 }
    }
}

impl Analytic for Uniform {
    fn terms<const P: usize>(&self, h: f64, z: Number) -> [Number; P] {
        let first = self.rate(h, z);
        std::array::from_fn(|k| if k == 0 { first } else { Number { y: 0.0 } })
    }
}

/// The sums are rounded once a step.
///
/// Catches: the same step tried again after an overflow; one that is not finite taken.
#[test]
fn a_uniform_motion_crosses_the_whole_range() {
    let start = Number { y: -1.5e308 };
    let mut walk = series(1e-9, 1e300).steps(&Uniform, start, 0.0, 3e8).unwrap();
    let last = walk.by_ref().map(|step| step.unwrap().end().y).last().unwrap();
    let counts = walk.counts();
    assert!(counts.rejected > 0 && counts.accepted < 20, "{counts:?}");
    let off = (last / 1.5e308 - 1.0).abs();
    assert!(off <= counts.accepted as f64 * f64::EPSILON, "{off:e}");
}

/// Where the motion itself leaves the range there is no step, and the walk says so.
///
/// Catches: an infinite state as the end of a walk; attempts without an end.
#[test]
fn a_motion_that_leaves_the_range_ends_in_an_error() {
    let start = Number { y: 1e308 };
    let mut walk = series(1e-9, 1e300).steps(&Uniform, start, 0.0, 3e8).unwrap();
    let ended = walk.by_ref().find_map(Result::err);
    assert!(matches!(ended, Some(pendula::Error::StepTooSmall { .. })), "{ended:?}");
    let (reached, t) = (walk.state().y, walk.time());
    // 7.98e7 s from the start it has reached the largest f64.
    assert!(reached.is_finite() && reached > 1.79e308 && t < 7.977e7, "{reached:e} at {t} s");
}
