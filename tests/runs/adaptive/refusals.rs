//! What has no adaptive steps is refused, and says so.

use super::*;

/// Catches: an accepted tolerance that is NaN, zero, negative, or finer than f64.
#[test]
fn a_tolerance_that_cannot_be_met_is_refused() {
    for bad in [0.0, -1e-6, f64::NAN, f64::INFINITY] {
        assert!(matches!(Tolerance::new(bad, 1e-6), Err(Error::Parameter { .. })), "{bad}");
    }
    for bad in [0.0, -1e-6, f64::NAN, f64::INFINITY, 1.0, SMALLEST_RELATIVE.next_down()] {
        assert!(matches!(Tolerance::new(1e-6, bad), Err(Error::Parameter { .. })), "{bad}");
    }
    assert_eq!(SMALLEST_RELATIVE, 10.0 * f64::EPSILON);
    assert!(Tolerance::new(5e-324, SMALLEST_RELATIVE).is_ok());
    assert_eq!(
        Tolerance::uniform(1e-16).unwrap_err().to_string(),
        "relative tolerance = 1e-16 is refused: it must be at least 2.22e-15, ten roundings of an \
         f64, and less than 1"
    );
}

/// Catches: an accepted tolerance so fine that no step meets it; an error of more than 1000
/// tolerances there.
fn the_finest_tolerance_can_be_met<M: Controlled<Pendulum>>(method: M) {
    let finest = Tolerance::uniform(SMALLEST_RELATIVE).unwrap();
    let adaptive = Adaptive::new(method, finest);
    let (end, _) = adaptive.integrate(&Pendulum::PAPER, START, 0.0, 2.0, &mut ()).unwrap();
    let right = Motion::new(&Pendulum::PAPER, START).unwrap().at(2.0);
    // As everywhere here, less than 1000 tolerances.
    assert!((end.theta - right.theta).abs() < 1000.0 * SMALLEST_RELATIVE);
}
each_controlled!(the_finest_tolerance_can_be_met);

/// Catches: an accepted time that is not finite, or an infinite duration.
fn a_time_that_is_none_is_refused<M: Controlled<Pendulum>>(method: M) {
    let adaptive = Adaptive::new(method, tolerance(1e-6));
    for (from, until) in
        [(f64::NAN, 1.0), (0.0, f64::INFINITY), (f64::NEG_INFINITY, 0.0), (-1e308, 1e308)]
    {
        let walk = adaptive.steps(&Pendulum::PAPER, START, from, until);
        assert!(matches!(walk.err(), Some(Error::Parameter { .. })), "{from} to {until}");
    }
}
each_controlled!(a_time_that_is_none_is_refused);

/// ẏ = y² from 1 has the solution 1/(1 − t). Towards its pole the steps become shorter and shorter,
/// and stop where they are lost in the rounding of the time, at 10 ε. Every step is off by a
/// tolerance of 1e-9, and so the computed pole lies within a thousand tolerances of t = 1.
///
/// Catches: steps that never end, or jump over the pole; an error without the time at which it
/// occurred.
fn a_pole_is_not_crossed<M: Embedded>(method: M) {
    let pole = Law(|_, y| y * y);
    let adaptive = Adaptive::new(method, tolerance(1e-9));
    let mut walk = adaptive.steps(&pole, Number { y: 1.0 }, 0.0, 2.0).unwrap();
    let error = walk.find_map(|step| step.err());
    let Some(Error::StepTooSmall { t, step }) = error else { panic!("{error:?}") };
    assert!((t - 1.0).abs() < 1e-6 && (t, walk.time()) == (walk.time(), t), "{t}");
    assert!(step > 0.0 && step <= 10.0 * f64::EPSILON, "{step:e}");
    assert!(walk.next().is_none(), "it has ended");
    let message = error.unwrap().to_string();
    assert!(
        message.contains("no step meets the tolerance") && !message.contains('\n'),
        "{message}"
    );
}
each_pair!(a_pole_is_not_crossed);

/// Catches: a NaN that is accepted, or retried for ever.
fn a_rate_that_is_no_number_is_an_error<M: Embedded>(method: M) {
    let adaptive = Adaptive::new(method, tolerance(1e-9));
    for (law, from) in [(f64::NAN, 0.0), (f64::INFINITY, 0.0), (f64::NAN, 1.0)] {
        let law = Law(move |_, _| law);
        let end = adaptive.integrate(&law, Number { y: 1.0 }, from, 2.0, &mut ());
        let Err(Error::StepTooSmall { t, .. }) = end else { panic!("{end:?}") };
        assert_eq!(t, from);
    }
    // A rate that becomes NaN on the way is found there.
    let law = Law(|t, _| if t < 1.0 { 1.0 } else { f64::NAN });
    let end = adaptive.integrate(&law, Number { y: 1.0 }, 0.0, 2.0, &mut ());
    let Err(Error::StepTooSmall { t, .. }) = end else { panic!("{end:?}") };
    assert!(t < 1.0 && t > 0.999, "{t}");
}
each_pair!(a_rate_that_is_no_number_is_an_error);

/// Catches: a limit that is off by one, counts only accepted steps, or ends the run without an
/// error.
fn a_limit_is_kept<M: Controlled<Pendulum>>(method: M) {
    let pendulum = Pendulum::PAPER;
    let adaptive = Adaptive::new(method, tolerance(1e-6));
    let (_, Counts { accepted, rejected, .. }) =
        adaptive.integrate(&pendulum, START, 0.0, 20.0, &mut ()).unwrap();
    let attempts = accepted + rejected;
    assert!(
        adaptive.max_attempts(attempts).integrate(&pendulum, START, 0.0, 20.0, &mut ()).is_ok()
    );
    let error = adaptive
        .max_attempts(attempts - 1)
        .integrate(&pendulum, START, 0.0, 20.0, &mut ())
        .unwrap_err();
    let Error::OutOfSteps { t, limit } = error else { panic!("{error:?}") };
    assert!(limit == attempts - 1 && t > 15.0 && t < 20.0, "{error}");
    assert!(error.to_string().starts_with(&format!("{limit} steps have led no further")));
}
each_controlled!(a_limit_is_kept);

/// ẏ = −100 y + 100 cos t is smooth after a short transient, and then the step is limited by
/// stability alone: |R(−100 h)| ≤ 1 up to h = 0.033 for Dormand and Prince's method of order 5,
/// 0.061 for DOP853. The controller keeps the steps near that bound. At order 5 it refuses less
/// than one step for every 50 it takes; at order 8, where a step slightly too long is off by much
/// more, one for every 4.
///
/// Catches: a controller that ignores the error of the step before, whose steps oscillate there;
/// one that lets them grow after a refusal.
#[rstest]
#[case::dormand_prince(DormandPrince, 0.033, 50)]
#[case::dop853(Dop853, 0.061, 4)]
fn at_the_limit_of_stability_few_steps_are_refused<M: Embedded>(
    #[case] method: M,
    #[case] bound: f64,
    #[case] one_in: u64,
) {
    let law = Law(|t: f64, y: f64| -100.0 * y + 100.0 * t.cos());
    let adaptive = Adaptive::new(method, tolerance(1e-4));
    let (end, counts) = adaptive.integrate(&law, Number { y: 0.0 }, 0.0, 20.0, &mut ()).unwrap();
    // y = (cos t + 0.01 sin t)/1.0001 once the transient has decayed.
    let right = (20_f64.cos() + 0.01 * 20_f64.sin()) / 1.0001;
    assert!((end.y - right).abs() < 1e-3, "{}", end.y);
    assert!(counts.rejected * one_in < counts.accepted, "{counts:?}");
    let mean = 20.0 / counts.accepted as f64;
    assert!(mean < bound && mean > 0.8 * bound, "{mean}");
}
