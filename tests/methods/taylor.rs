//! Taylor series of the motion, at orders other than the one on the list.

use pendula::{
    Counting, Grid, Method, Motion, Pendulum, Phase, Taylor, integrate, integrate_fast,
    integrate_with,
};
use rstest::rstest;

/// L ≠ 1, m ≠ 1, ω₀ ≠ 1.
fn pendulum() -> Pendulum {
    Pendulum::new(9.81, 0.8, 1.7).unwrap()
}

const STARTS: [Phase; 3] = [
    Phase { theta: 1.0, omega: 0.0 },
    Phase { theta: -2.0, omega: 1.5 },
    Phase { theta: 0.5, omega: 9.0 },
];

/// The duration of the runs on which errors are measured (s): not a whole number of periods.
const END: f64 = 2.3;

/// The largest error of `method` up to [`END`] in `steps` steps: the norm of θ and ω/ω₀ (rad).
fn largest_error<M: Method<Pendulum>>(method: &M, start: Phase, steps: u64) -> f64 {
    let pendulum = pendulum();
    let frequency = pendulum.small_angle_frequency();
    let motion = Motion::new(&pendulum, start).unwrap();
    let grid = Grid::new(END / steps as f64, steps).unwrap();
    let mut largest = 0.0_f64;
    integrate_with(&pendulum, method, start, &grid, &mut |_, t: f64, z: Phase| {
        let truth = motion.at(t);
        let error = (z.theta - truth.theta).hypot((z.omega - truth.omega) / frequency);
        assert!(error.is_finite());
        largest = largest.max(error);
    });
    largest
}

/// The series to the power P is a method of order P. Its steps are halved until rounding, 2e-16 of
/// 10 rad a step with a margin of 10, would show in the error; the two finest slopes are checked.
/// The second term of the error is smaller than the first by h times a rate of change of the
/// motion: ω₀ for a swing, ω for a rotation; at most twice that here.
///
/// Catches: one power too few or too many, a factor j or k in the recurrence that is off by one, a
/// sign.
#[rstest]
fn the_slope_is_the_power(#[values(0, 1, 2)] start: usize) {
    check::<2>(STARTS[start]);
    check::<3>(STARTS[start]);
    check::<4>(STARTS[start]);
    check::<5>(STARTS[start]);
    check::<6>(STARTS[start]);
    check::<7>(STARTS[start]);
    check::<8>(STARTS[start]);

    fn check<const P: usize>(start: Phase) {
        let ladder: Vec<(u64, f64)> = (3..15)
            .map(|k| (1 << k, largest_error(&Taylor::<P>, start, 1 << k)))
            .take_while(|(steps, error)| *error > 2e-14 * *steps as f64)
            .collect();
        let (last, rungs) = (ladder.len() - 1, &ladder);
        assert!(last >= 3, "{ladder:?}");
        for k in [last - 1, last] {
            let slope = (rungs[k - 1].1 / rungs[k].1).log2();
            let rate = pendulum().small_angle_frequency().max(start.omega);
            let x = rate * END / rungs[k - 1].0 as f64;
            assert!((slope - P as f64).abs() < 0.01 + 2.0 * x, "{slope} of {ladder:?}");
        }
    }
}

/// The series to the power P leaves out its next term and those after it, each smaller by h: so in
/// a single step one more power adds what was missing, to O(h).
///
/// Catches: a coefficient that is wrong from some power on, even if the order of the method does
/// not show it.
#[rstest]
fn one_power_more_is_what_was_missing(#[values(0, 1, 2)] start: usize) {
    check::<1, 2>(STARTS[start]);
    check::<2, 3>(STARTS[start]);
    check::<5, 6>(STARTS[start]);
    check::<8, 9>(STARTS[start]);
    check::<11, 12>(STARTS[start]);

    fn check<const P: usize, const NEXT: usize>(start: Phase) {
        let pendulum = pendulum();
        let motion = Motion::new(&pendulum, start).unwrap();
        let frequency = pendulum.small_angle_frequency();
        let missing = |h: f64| {
            let grid = Grid::new(h, 1).unwrap();
            let truth = motion.at(h);
            let low = integrate(&pendulum, &Taylor::<P>, start, &grid);
            let high = integrate(&pendulum, &Taylor::<NEXT>, start, &grid);
            let size =
                |z: Phase, w: Phase| (z.theta - w.theta).hypot((z.omega - w.omega) / frequency);
            (size(truth, high), size(truth, low))
        };
        // So long that xᴾ⁺¹ is about 1e-7 at the last power too, far above rounding.
        let h = 0.25 / frequency;
        let (left, before) = missing(h);
        // From rest, by symmetry, each power adds to only one of θ and ω, and the ratio is x and
        // not less.
        assert!(left < 2.0 * h * frequency * before + 1e-15, "{left:e} of {before:e} are left");
        assert!(before > 0.0);
    }
}

/// With the step as the unit of time the same series takes the same steps, up to rounding; and each
/// power counts as one evaluation.
///
/// Catches: a power of h missing in one of the two; a series counted as one evaluation.
#[test]
fn the_step_may_be_the_unit_of_time() {
    let (pendulum, grid) = (pendulum(), Grid::new(0.1, 50).unwrap());
    for start in STARTS {
        let plain = integrate(&pendulum, &Taylor::<12>, start, &grid);
        let quick = integrate_fast(&pendulum, &Taylor::<12>, start, &grid);
        // 50 steps of a few roundings of up to 50 rad, each carried on by 50 steps more.
        assert!((plain.theta - quick.theta).abs() < 1e-11, "{plain:?}, {quick:?}");
        assert!((plain.omega - quick.omega).abs() < 1e-11, "{plain:?}, {quick:?}");
    }
    let counting = Counting::new(pendulum);
    integrate(&counting, &Taylor::<12>, STARTS[0], &grid);
    assert_eq!(counting.evaluations(), 12 * 50);
}
