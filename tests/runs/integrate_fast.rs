//! Time in steps against time in seconds: the same method, the same steps, another rounding.

use pendula::internals::{Deferred, ScaledPendulum};
use pendula::methods::{Rk4, StormerVerlet, SymplecticEuler, Yoshida8};
use pendula::registry::InSteps;
use pendula::{
    AnyMethod, Ensemble, Grid, Observer, Pendulum, Phase, integrate, integrate_fast,
    integrate_fast_with,
};
use rstest::rstest;

use crate::common::{First, Random, bits, in_seconds};

/// g/L = 2.5, L ≠ 1, m ≠ 1.
fn pendulum() -> Pendulum {
    Pendulum::new(5.0, 2.0, 3.0).unwrap()
}

/// The states of one run.
fn states(run: impl FnOnce(&mut dyn Observer<Phase>) -> Phase) -> (Vec<(u64, f64, Phase)>, Phase) {
    let mut seen = vec![];
    let end = run(&mut |n, t, z| seen.push((n, t, z)));
    (seen, end)
}

/// One step differs by the rounding of a dozen operations on numbers of the size of θ, ω and h g/L;
/// and on a regular orbit an error of one step grows by a factor of at most the number of steps, so
/// that n steps differ by n² times that at the most.
///
/// Catches: a factor h lost in the change of units, half turns counted wrongly, a sign of the sine,
/// a deferred product added twice or never, samples at other times, a start that is observed
/// rounded.
fn in_steps_is_in_seconds(method: &dyn AnyMethod) {
    let pendulum = pendulum();
    for h in [0.01, 0.1, 0.37] {
        let grid = Grid::new(h, 50).unwrap();
        for (theta, omega) in [(1.0, 0.0), (3.0, 0.1), (-0.3, 9.0), (100.0, -7.0), (0.0, 0.0)] {
            let start = Phase { theta, omega };
            let (quick, end) = states(|watch| method.run(&pendulum, start, &grid, watch));
            let (plain, _) =
                states(|watch| in_seconds(method).try_run(&pendulum, start, &grid, watch).unwrap());
            assert_eq!(quick.len(), plain.len());
            assert_eq!(quick[0], (0, 0.0, start));
            assert_eq!(quick[50].2, end);
            for ((n, t, z), (m, s, w)) in quick.into_iter().zip(plain) {
                assert_eq!((n, t), (m, s));
                let rounding = 12.0 * f64::EPSILON * ((n * n) as f64 + 1.0);
                let theta = rounding * (w.theta.abs() + h * w.omega.abs() + 1.0);
                assert!((z.theta - w.theta).abs() <= theta, "θ after {n} of {h}: {z:?} {w:?}");
                let omega = rounding * (w.omega.abs() + 2.5 * h + theta / h);
                assert!((z.omega - w.omega).abs() <= omega, "ω after {n} of {h}: {z:?} {w:?}");
            }
        }
    }
}
each_method!(in_steps_is_in_seconds);

/// A run without steps, or one that its observer ends before the first, ends where it begins, to
/// the bit: also where the velocity in rad a step, or the angle in half turns, would be rounded.
///
/// Catches: a state that is converted there and back, by which one in four changes its last bit.
fn no_step_changes_no_bit(method: &dyn AnyMethod) {
    let mut random = Random::new(5);
    let starts: Vec<Phase> = (0..100)
        .map(|_| Phase { theta: random.between(-1e3, 1e3), omega: random.between(-9.0, 9.0) })
        .collect();
    let [none, ten] = [0, 10].map(|steps| Grid::new(0.017, steps).unwrap());
    let mut ends = vec![Phase::default(); starts.len()];
    Ensemble::new(&pendulum(), &starts, none).ends(method, &mut ends);
    for (start, end) in starts.into_iter().zip(ends) {
        assert_eq!(bits(end), bits(start), "in lanes");
        let end = method.end(&pendulum(), start, &none);
        assert_eq!(bits(end), bits(start), "no steps");
        let end = method.run(&pendulum(), start, &ten, &mut First::<1>::default());
        assert_eq!(bits(end), bits(start), "ended at once");
        let end = method.try_run(&pendulum(), start, &ten, &mut First::<1>::default()).unwrap();
        assert_eq!(bits(end), bits(start), "ended at once, and asked why");
    }
}
each_method!(no_step_changes_no_bit);

/// Catches: a change of units that overflows or underflows where seconds would do, and half turns
/// too many to count.
#[rstest]
#[case::tiny_step(1e-150, 1.0, 1.0)]
#[case::tiny_velocity(0.01, 0.0, 1e-200)]
#[case::fast(1e-3, 1.0, 1e17)]
#[case::far(0.01, 1e14, 1.0)]
fn where_units_cannot_be_changed_time_is_in_seconds(
    #[case] h: f64,
    #[case] theta: f64,
    #[case] omega: f64,
) {
    let (grid, start) = (Grid::new(h, 100).unwrap(), Phase { theta, omega });
    assert!(ScaledPendulum::new::<Rk4>(&pendulum(), &grid, start).is_none());
    let quick = integrate_fast(&pendulum(), &Rk4, start, &grid);
    assert_eq!(quick, integrate(&pendulum(), &Rk4, start, &grid));
}

/// K = h² g/L is 0.01, whatever the step, and the start is at rest: only the step itself is out of
/// range.
///
/// Catches: steps beyond 1e100 s, or below 1e-100 s, taken as the unit of time, so that a run in
/// them has other bits than in seconds; a limit that is off.
#[rstest]
#[case::the_longest(1e100_f64.next_down(), true)]
#[case::too_long(1e100, false)]
#[case::far_too_long(1e130, false)]
#[case::the_shortest(1e-100, true)]
#[case::too_short(1e-100_f64.next_down(), false)]
#[case::far_too_short(1e-130, false)]
fn a_step_that_is_no_unit_of_time_is_taken_in_seconds(#[case] h: f64, #[case] fits: bool) {
    // g and L share the square of the step, which alone would overflow.
    let pendulum = Pendulum::new(0.1 / h, 10.0 * h, 1.0 / h).unwrap();
    let (grid, start) = (Grid::new(h, 100).unwrap(), Phase::at_rest(1.0));
    assert_eq!(ScaledPendulum::new::<Rk4>(&pendulum, &grid, start).is_some(), fits);
    let quick = integrate_fast(&pendulum, &Rk4, start, &grid);
    let plain = integrate(&pendulum, &Rk4, start, &grid);
    assert_eq!(bits(quick) == bits(plain), !fits, "{quick:?} {plain:?}");
}

/// Ten million steps of K = 0.1 can turn a pendulum by 10¹³ rad, whose half turns can be counted;
/// kicks that add up to 17 steps can turn it 290 times as far, where they cannot.
///
/// Catches: a bound that ignores the kicks that cancel each other; a bound so wide that a long run
/// of Verlet falls back to seconds.
#[test]
fn how_far_a_run_may_lead_depends_on_the_method() {
    let grid = Grid::new(0.2, 10_000_000).unwrap();
    let start = Phase::at_rest(1.0);
    assert!(ScaledPendulum::new::<StormerVerlet>(&pendulum(), &grid, start).is_some());
    assert!(ScaledPendulum::new::<Yoshida8>(&pendulum(), &grid, start).is_none());
}

/// Catches: a run that goes on after the observer is satisfied, or begins although it is.
#[test]
fn a_satisfied_observer_ends_the_swing() {
    let (grid, start) = (Grid::new(0.1, 100).unwrap(), Phase::at_rest(1.0));
    let end = integrate_fast_with(&pendulum(), &Rk4, start, &grid, &mut First::<4>::default());
    let three = Grid::new(0.1, 3).unwrap();
    assert_eq!(end, integrate_fast(&pendulum(), &Rk4, start, &three));
    for start in (1..40).map(|i| Phase { theta: 0.3 * f64::from(i), omega: 1.0 / f64::from(i) }) {
        let mut watch = First::<1>::default();
        assert_eq!(start, integrate_fast_with(&pendulum(), &Rk4, start, &grid, &mut watch.clone()));
        let tried = InSteps(Rk4).try_run(&pendulum(), start, &grid, &mut watch);
        assert_eq!(tried, Ok(start));
    }
}

/// Catches: a deferred summand of +0, which turns −0 into +0.
#[test]
fn a_number_that_is_known_keeps_its_sign() {
    for x in [-0.0, 0.0, 1.5, f64::NEG_INFINITY] {
        assert_eq!(Deferred::from(x).value().to_bits(), x.to_bits());
    }
}

/// Symplectic Euler, whose step kicks once: after N steps from θ = 0 at ω it has gone no farther
/// than N (ωh + N K).
///
/// Catches: a bound that lacks a factor, or that includes its own limit.
#[test]
fn time_is_counted_in_steps_up_to_the_bounds_only() {
    let fits = |frequency_squared: f64, step: f64, steps, theta, omega| {
        let pendulum = Pendulum::new(frequency_squared, 1.0, 1.0).unwrap();
        let grid = Grid::new(step, steps).unwrap();
        let start = Phase { theta, omega };
        ScaledPendulum::new::<SymplecticEuler>(&pendulum, &grid, start).is_some()
    };
    // K = 1e6 and N = 9e3: N² K = 8.1e13, and ten times as many steps go a hundred times as far.
    assert!(fits(1e6, 1.0, 9_000, 0.0, 0.0) && !fits(1e6, 1.0, 90_000, 0.0, 0.0));
    // ωh = 1e13 with h = 100, beside which K is negligible: N ωh.
    assert!(fits(1e-90, 100.0, 9, 0.0, 1e11) && !fits(1e-90, 100.0, 100, 0.0, 1e11));
    // 10¹⁴ itself is too far, and so is a start at 10⁶ rad.
    assert!(fits(1e-90, 1.0, 1, 0.0, 1e14_f64.next_down()) && !fits(1e-90, 1.0, 1, 0.0, 1e14));
    assert!(fits(1.0, 1.0, 1, -1e6_f64.next_down(), 0.0) && !fits(1.0, 1.0, 1, -1e6, 0.0));
}
