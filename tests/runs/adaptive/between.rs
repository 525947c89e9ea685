//! Between the steps: dense output, states at given times, and crossings.

use super::*;

// -------------------------------------------------------------------------------------------------
// Dense output
// -------------------------------------------------------------------------------------------------

/// Within one step dense output of order q is off by O(h^(q+1)): the largest error of 40 steps
/// spread over a swing, each evaluated at 4 points.
///
/// Where the error is largest moves a little with h: over a factor of √2 that changes a slope by
/// ±0.2 at DOP853's long steps; over the factor of 4 here it is less.
///
/// Catches: dense output of a lower order, as Hermite's cubic alone would be (of order 3); a
/// coefficient that only matters in the middle of a step.
#[rstest]
#[case::dormand_prince(DormandPrince, 4, 0.04, 0.05)]
#[case::dop853(Dop853, 7, 0.11, 0.15)]
fn dense_output_has_its_order<M: Embedded>(
    #[case] method: M,
    #[case] order: u32,
    #[case] longest: f64,
    #[case] tolerance: f64,
) {
    for pendulum in pendulums() {
        let motion = Motion::new(&pendulum, START).unwrap();
        let largest = |h: f64| {
            let mut largest = 0.0_f64;
            for n in 0..40 {
                let z = motion.at(0.17 * f64::from(n));
                let right = Motion::new(&pendulum, z).unwrap();
                let dense = one_step(&pendulum, method, z, h);
                for s in [0.2, 0.4, 0.6, 0.8] {
                    largest = largest.max((dense.after(s).theta - right.at(s * h).theta).abs());
                }
            }
            largest
        };
        let slope = (largest(longest) / largest(longest / 4.0)).log2() / 2.0;
        assert!((slope - f64::from(order + 1)).abs() < tolerance, "{slope}");
    }
}

fn one_step<M: Embedded>(
    pendulum: &Pendulum,
    method: M,
    z: Phase,
    h: f64,
) -> Dense<Phase, M::Dense<Phase>> {
    let (end, stages) = method.attempt(pendulum, 0.0, h, z, pendulum.rate(0.0, z));
    let slope = method.end_slope(pendulum, h, end, &stages);
    Dense::new(0.0, h, z, method.dense(pendulum, 0.0, h, z, &stages, slope))
}

/// Catches: dense output of another step; a time not converted to the fraction of the step.
fn dense_output_meets_both_ends_of_each_step<M: Controlled<Pendulum>>(method: M) {
    let pendulum = Pendulum::PAPER;
    let mut walk = walk(&pendulum, method, 1e-8, 5.0);
    let mut last = (0.0, START);
    while let Some(step) = walk.next() {
        let step = step.unwrap();
        assert_eq!((step.start_time(), step.start()), last);
        last = (step.end_time(), step.end());
        let dense = walk.dense(&step);
        assert_eq!((dense.at(step.start_time()), dense.after(1.0)), (step.start(), step.end()));
        assert_eq!([0.0, 1.0].map(|s| dense.time(s)), [step.start_time(), step.end_time()]);
    }
}
each_controlled!(dense_output_meets_both_ends_of_each_step);

// -------------------------------------------------------------------------------------------------
// States at given times
// -------------------------------------------------------------------------------------------------

/// DOP853 takes 59 steps, Dormand and Prince 296, the series 17. Each is off by at most 3e-10 in θ;
/// that adds up like √296, and grows with the phase, at most (1 + ω₀ t)-fold, 15: 8e-8. The end of
/// the step in place of the state 1 ms before it, at 6.999 s, is off by 2e-3. The polynomial of a
/// neighbouring step may be off by 1e-9 only: so one state is compared to the bit.
///
/// Catches: the state at an end of the step, or on the polynomial of another; the walk's order of
/// times forgotten where it leads back; a time at the start, at the end or twice that is left out.
fn states_at_given_times_are_those_of_the_motion<M: Controlled<Pendulum>>(method: M) {
    let [_, pendulum] = pendulums();
    let motion = Motion::new(&pendulum, START).unwrap();
    for until in [7.0, -7.0_f64] {
        let times = [0.0, 1e-9, 0.5, 0.5, 0.6, 3.3, 6.999, 7.0].map(|t| t * until.signum());
        let mut walk = walk(&pendulum, method, 1e-10, until);
        let states: Vec<Phase> = walk.states_at(times).map(Result::unwrap).collect();
        assert_eq!(states.len(), times.len());
        let mut alone = self::walk(&pendulum, method, 1e-10, until);
        let is_beyond = |end: f64| (times[5] - end) * until < 0.0;
        let step = alone.by_ref().map(Result::unwrap).find(|step| is_beyond(step.end_time()));
        assert_eq!(states[5], alone.dense(&step.unwrap()).at(times[5]));
        for (t, z) in times.into_iter().zip(states) {
            let off = z - motion.at(t);
            assert!(off.theta.abs() < 1e-7 && off.omega.abs() < 3e-7, "{t} s: {off:?}");
        }
    }
}
each_controlled!(states_at_given_times_are_those_of_the_motion);

/// Catches: a walk whose steps follow the times that are asked for; dense output where a step ends
/// on the time, or computed again for each time in a step; a walk that goes on further than asked.
fn states_at_given_times_leave_the_steps_alone<M: Controlled<Pendulum>>(method: M) {
    let pendulum = Pendulum::PAPER;
    let mut alone = walk(&pendulum, method, 1e-9, 5.0);
    let steps: Vec<_> = alone.by_ref().take(6).map(Result::unwrap).collect();
    let before = alone.counts();

    let mut at_ends = walk(&pendulum, method, 1e-9, 5.0);
    let ends: Vec<Phase> =
        at_ends.states_at(steps.iter().map(|step| step.end_time())).map(Result::unwrap).collect();
    assert!(ends.iter().eq(steps.iter().map(|step| step.end()).collect::<Vec<_>>().iter()));
    assert_eq!(at_ends.counts(), before);

    let (last, mut within) = (&steps[5], walk(&pendulum, method, 1e-9, 5.0));
    let times = [0.25, 0.75].map(|part| last.start_time() + part * last.size());
    let states: Vec<Phase> = within.states_at(times).map(Result::unwrap).collect();
    let dense = alone.dense(last);
    assert_eq!(states, times.map(|t| dense.at(t)));
    assert_eq!(within.counts(), alone.counts(), "the dense output of one step, once");
}
each_controlled!(states_at_given_times_leave_the_steps_alone);

/// Catches: a step looked up beside the one that a time lies in, or in the wrong order where the
/// walk leads back; the ends left out; a state where there is none.
fn a_walk_that_is_kept_has_the_same_states<M: Controlled<Pendulum>>(method: M) {
    let pendulum = Pendulum::PAPER;
    for until in [5.0, -5.0, 0.0_f64] {
        let kept = walk(&pendulum, method, 1e-9, until).solution().unwrap();
        let ends: Vec<f64> =
            walk(&pendulum, method, 1e-9, until).map(|step| step.unwrap().end_time()).collect();
        let all = (0..=1000).map(|n| until * f64::from(n) / 1000.0).chain(ends);
        let mut times: Vec<f64> = all.collect();
        times.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
        let mut alone = walk(&pendulum, method, 1e-9, until);
        for (&t, z) in times.iter().zip(alone.states_at(times.iter().copied())) {
            assert_eq!(kept.at(t), Some(z.unwrap()), "{t} s");
        }
        assert_eq!((kept.start_time(), kept.end_time()), (0.0, until));
        assert_eq!((kept.at(0.0), kept.at(until)), (Some(START), Some(alone.state())));
        for t in [until.next_up().max(f64::MIN_POSITIVE), until.next_down().min(-1e-300)] {
            let is_between = (0.0..=until).contains(&t) || (until..=0.0).contains(&t);
            assert_eq!(kept.at(t).is_some(), is_between, "{t} s of {until} s");
        }
        assert_eq!(kept.at(f64::NAN), None);
    }
}
each_controlled!(a_walk_that_is_kept_has_the_same_states);

/// Catches: a kept walk that begins with the next step, or again at the start, where a step has
/// been read in part; an error that is lost; a clone that moves with the walk.
fn what_is_kept_is_the_rest_of_a_walk<M: Controlled<Pendulum>>(method: M) {
    let pendulum = Pendulum::PAPER;
    let mut read = walk(&pendulum, method, 1e-9, 5.0);
    let crossing = read.crossings(Direction::Either, |_, z| z.theta).next().unwrap().unwrap();
    let mut copy = read.clone();
    let kept = read.solution().unwrap();
    assert_eq!((kept.start_time(), kept.end_time(), read.time()), (crossing.t, 5.0, 5.0));
    assert!(kept.at(crossing.t).unwrap().theta.abs() < 1e-14);
    assert_eq!(kept.at(crossing.t - 1e-9), None);
    assert!(read.next().is_none());
    assert!(copy.time() < 5.0);
    for t in [crossing.t + 1e-9, crossing.t + 0.001, 4.0, 5.0] {
        assert_eq!(copy.states_at([t]).next().unwrap().unwrap(), kept.at(t).unwrap());
    }
    assert_eq!(copy.counts().accepted, read.counts().accepted);

    let few = Adaptive::new(method, tolerance(1e-9)).max_attempts(3);
    let kept = few.steps(&pendulum, START, 0.0, 50.0).unwrap().solution();
    assert!(matches!(kept, Err(Error::OutOfSteps { limit: 3, .. })), "{kept:?}");
}
each_controlled!(what_is_kept_is_the_rest_of_a_walk);

/// Catches: a state for a time that the walk has passed, or does not reach; an error of the walk
/// that is lost, or told for ever.
fn a_time_that_is_out_of_turn_is_refused<M: Controlled<Pendulum>>(method: M) {
    for (times, until) in [
        ([1.0, 0.5], 5.0),
        ([-1.0, -0.5], -5.0),
        ([1.0, 5.1], 5.0),
        ([-1.0, -5.1], -5.0),
        ([1.0, f64::NAN], 5.0),
        ([0.0, 1e-300], 0.0),
    ] {
        let mut walk = walk(&Pendulum::PAPER, method, 1e-6, until);
        let mut states = walk.states_at(times);
        assert!(states.next().unwrap().is_ok());
        let refused = states.next();
        assert!(matches!(refused, Some(Err(Error::Parameter { .. }))), "{times:?}: {refused:?}");
        assert!(states.next().is_none());
    }
    let few = Adaptive::new(method, tolerance(1e-9)).max_attempts(3);
    let mut walk = few.steps(&Pendulum::PAPER, START, 0.0, 50.0).unwrap();
    let mut states = walk.states_at([49.0, 50.0]);
    assert!(matches!(states.next(), Some(Err(Error::OutOfSteps { limit: 3, .. }))));
    assert!(states.next().is_none());
}
each_controlled!(a_time_that_is_out_of_turn_is_refused);

// -------------------------------------------------------------------------------------------------
// Crossings
// -------------------------------------------------------------------------------------------------

/// The first fall to the bottom takes a quarter of the period, and four times that is right to what
/// the tolerance allows for a number of the size of T. That is not guaranteed, as the errors of the
/// steps add up; but a fall from rest is most sensitive where it is slowest, and there the error of
/// a step is smallest. 4 ε T is the rounding of the four quarters.
///
/// Catches: a crossing put at an end of the step, or found by linear interpolation; dense output of
/// too low an order; the start time of a step forgotten.
fn the_period_is_exact_within_the_tolerance<M: Controlled<Pendulum>>(method: M) {
    let one = |pendulum: &Pendulum, theta0: f64, tol: f64| {
        let period = exact::period(pendulum, theta0).unwrap();
        let adaptive = Adaptive::new(method, tolerance(tol));
        let mut walk = adaptive.steps(pendulum, Phase::at_rest(theta0), 0.0, period).unwrap();
        let bottom = walk.crossings(Direction::Falling, |_, z| z.theta).next().unwrap().unwrap();
        let off = (4.0 * bottom.t - period).abs();
        let allowed = tol * (1.0 + period) + 4.0 * f64::EPSILON * period;
        assert!(off <= allowed, "{off:e} s, from {theta0} with {tol:e}");
        assert!(bottom.z.theta.abs() <= 1e-15, "{:?}, from {theta0} with {tol:e}", bottom.z);
    };
    for pendulum in pendulums() {
        for theta0 in [0.5, 2.0, 3.0, 3.1] {
            [1e-6, 1e-8, 1e-10, 1e-12].iter().for_each(|tol| one(&pendulum, theta0, *tol));
        }
    }
}
each_controlled!(the_period_is_exact_within_the_tolerance);

/// Rotation over the top. The pendulum turns at 6 rad/s or more; its angle is off by less than 100
/// tolerances after 5 s, as is that of the swing in the tests above.
///
/// Catches: crossings missed, or found twice where one step ends and the next begins; a function of
/// time alone, or of the state alone.
fn each_passage_over_the_top_is_found_once<M: Controlled<Pendulum>>(method: M) {
    for pendulum in pendulums() {
        let start = Phase { theta: -0.5, omega: 9.0 };
        let motion = Motion::new(&pendulum, start).unwrap();
        for tol in [1e-5, 1e-9] {
            let adaptive = Adaptive::new(method, tolerance(tol));
            let mut walk = adaptive.steps(&pendulum, start, 0.0, 5.0).unwrap();
            let tops = walk
                .crossings(Direction::Either, |_, z| pendula::arithmetic::sine::cos(0.5 * z.theta));
            let tops: Vec<_> = tops.map(|top| top.unwrap()).collect();
            let turns = ((motion.at(5.0).theta + PI) / (2.0 * PI)).floor() as usize;
            assert_eq!(tops.len(), turns);
            for (n, top) in tops.iter().enumerate() {
                let angle = PI * (2 * n + 1) as f64;
                assert!((motion.at(top.t).theta - angle).abs() < 100.0 * tol, "{n} at {}", top.t);
                assert!((top.z.theta - angle).abs() < 1e-14 * angle, "{n} at {:?}", top.z);
            }
        }
    }
}
each_controlled!(each_passage_over_the_top_is_found_once);

/// The angle of a swing crosses zero falling, rising, and falling again; a function of time crosses
/// zero twenty times in 3 s, more often than there are steps.
///
/// Catches: a direction ignored or reversed; a zero at the start taken for a crossing; several
/// crossings in a step of which only one is found.
fn a_crossing_has_a_direction<M: Controlled<Pendulum>>(method: M) {
    let pendulum = Pendulum::PAPER;
    let start = Phase { theta: 0.0, omega: 2.0 };
    let period = Motion::new(&pendulum, start).unwrap().period().unwrap();
    let adaptive = Adaptive::new(method, tolerance(1e-9));
    let times = |direction, until: f64| {
        let mut walk = adaptive.steps(&pendulum, start, 0.0, until).unwrap();
        let crossings = walk.crossings(direction, |_, z| z.theta);
        crossings.map(|crossing| crossing.unwrap().t / period).collect::<Vec<f64>>()
    };
    let near = |times: Vec<f64>, expected: &[f64]| {
        assert_eq!(times.len(), expected.len(), "{times:?}");
        // 100 tolerances, as above.
        assert!(times.iter().zip(expected).all(|(t, e)| (t - e).abs() < 1e-7), "{times:?}");
    };
    near(times(Direction::Rising, 2.2 * period), &[1.0, 2.0]);
    near(times(Direction::Falling, 2.2 * period), &[0.5, 1.5]);
    near(times(Direction::Either, 2.2 * period), &[0.5, 1.0, 1.5, 2.0]);
    // Backward in time, rising becomes falling.
    near(times(Direction::Rising, -2.2 * period), &[-0.5, -1.5]);
    near(times(Direction::Falling, -2.2 * period), &[-1.0, -2.0]);

    let mut walk =
        Adaptive::new(method, tolerance(1e-3)).steps(&pendulum, start, 0.0, 3.0).unwrap();
    let strikes = walk.crossings(Direction::Either, |t, _| (PI * (t - 0.075) / 0.15).sin());
    let strikes: Vec<f64> = strikes.map(|strike| strike.unwrap().t).collect();
    assert_eq!(strikes.len(), 20, "{strikes:?}");
    // The sine of the test is right to an ulp of its argument, 20 π, and the time to one of 3 s.
    let late = |(n, t): (usize, &f64)| (t - 0.15 * n as f64 - 0.075).abs();
    assert!(strikes.iter().enumerate().map(late).all(|late| late < 1e-14));
}
each_controlled!(a_crossing_has_a_direction);

/// A zero of the function exactly at the end of the walk, also where the start is so large that
/// the start and the way do not add up to the end, but to 0.
///
/// Catches: a zero missed because it is reached exactly and not crossed; one later than the walk.
fn a_zero_on_the_last_instant_is_a_crossing<M: Embedded>(method: M) {
    let law = Law(|_, _| 0.0);
    let adaptive = Adaptive::new(method, tolerance(1e-6));
    for (start, end) in [(0.0, 1.0 / 1024.0), (-1e17, -1.0), (1e17, 1.0_f64)] {
        for (direction, sign) in [(Direction::Rising, 1.0), (Direction::Falling, -1.0)] {
            let mut walk = adaptive.steps(&law, Number { y: 1.0 }, start, end).unwrap();
            let ahead = sign * (end - start).signum();
            let crossings = walk.crossings(direction, |t, _| ahead * (t - end));
            let times: Vec<f64> = crossings.map(|crossing| crossing.unwrap().t).collect();
            assert_eq!(times, [end]);
        }
    }
}
each_pair!(a_zero_on_the_last_instant_is_a_crossing);
