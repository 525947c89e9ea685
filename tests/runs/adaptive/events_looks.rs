//! How finely a step is looked at for changes of sign: at eighths.

use super::*;

/// A walk whose steps are long beside its tolerance: DOP853 on the pendulum.
fn long_steps(pendulum: &Pendulum) -> AdaptiveSteps<'_, Pendulum, Dop853> {
    walk(pendulum, Dop853, 1e-6, 5.0)
}

/// The crossings of (t − a)(t − b), for zeros at these shares of the third step, each as a share of
/// it too.
fn seen(pendulum: &Pendulum, [a, b]: [f64; 2], direction: Direction) -> Vec<f64> {
    let step = long_steps(pendulum).nth(2).expect("it takes more steps").unwrap();
    let (start, size) = (step.start_time(), step.size());
    assert!(size > 0.1, "a step of {size} s");
    let zero = |share: f64| start + share * size;
    let (a, b) = (zero(a), zero(b));
    let mut walk = long_steps(pendulum);
    let crossings = walk.crossings(direction, |t, _| (t - a) * (t - b));
    crossings.map(|crossing| (crossing.unwrap().t - start) / size).collect()
}

/// Two zeros a sixth of a step apart, between the quarters at 1/4 and 1/2 and on both sides of the
/// eighth between them.
///
/// Catches: a step that is looked at four times, or at its ends alone.
#[test]
fn two_zeros_a_sixth_of_a_step_apart_are_seen() {
    for pendulum in pendulums() {
        let zeros = [0.29, 0.29 + 1.0 / 6.0];
        assert!(zeros.iter().all(|zero| (0.25..0.5).contains(zero)));
        for (direction, expected) in [
            (Direction::Either, &zeros[..]),
            (Direction::Falling, &zeros[..1]),
            (Direction::Rising, &zeros[1..]),
        ] {
            let found = seen(&pendulum, zeros, direction);
            assert_eq!(found.len(), expected.len(), "{direction:?}: {found:?}");
            // A time of some seconds is rounded by 4e-16 s of a step of more than 0.1 s, and the
            // zeros and their shares a few times.
            let near = |(x, y): (&f64, &f64)| (x - y).abs() < 1e-13;
            assert!(found.iter().zip(expected).all(near), "{direction:?}: {found:?}");
        }
    }
}

/// Wherever they lie, and however little they are farther apart than an eighth.
///
/// Catches: looks that are fewer than eight, or not evenly spread; the last part of a step, or its
/// first, left out.
#[test]
fn zeros_more_than_an_eighth_of_a_step_apart_do_not_hide_each_other() {
    const APART: f64 = 0.126;
    for k in 0..=200 {
        let first = 1e-3 + (1.0 - APART - 2e-3) * f64::from(k) / 200.0;
        let found = seen(&Pendulum::PAPER, [first, first + APART], Direction::Either);
        assert_eq!(found.len(), 2, "from {first} on: {found:?}");
    }
}

/// As the documentation says: closer than an eighth they can hide each other, if no look falls
/// between them.
///
/// Catches: a documentation that promises too little; zeros made up.
#[test]
fn closer_zeros_can_hide_each_other() {
    let either = |zeros| seen(&Pendulum::PAPER, zeros, Direction::Either).len();
    assert_eq!(either([0.255, 0.37]), 0, "between two looks");
    assert_eq!(either([0.37, 0.38]), 2, "on both sides of one");
}
