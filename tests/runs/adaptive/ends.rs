//! Where a walk ends, and what has no adaptive steps: it is refused, and says so.

use super::*;

/// Short walks from anywhere to anywhere, either way, with tolerances of 1e-3 to 1e-12: the last
/// time is the end to the bit, each step begins where the one before ended, and none is a scrap of
/// the walk. What is left after a step is more than a hundredth of it, so that a last step that was
/// not refused is no shorter than that.
///
/// Catches: a last step that stops short of the end by a rounding, or beyond it; a tiny step left
/// over for the end, which costs as much as any and is mostly rounding.
fn a_walk_ends_where_it_should<M: Controlled<Pendulum>>(method: M) {
    let mut random = Random::new(7);
    let mut last_steps = 0;
    for n in 0..2000 {
        let from = random.one_of(&[0.0, 1.0, -1e3, 1e6]) * random.between(0.5, 1.0);
        let until = from + random.between(-3.0, 3.0);
        let start = Phase { theta: random.between(-4.0, 4.0), omega: random.between(-4.0, 4.0) };
        let tol = 10_f64.powf(random.between(-12.0, -3.0));
        let adaptive = Adaptive::new(method, tolerance(tol));
        let mut walk = adaptive.steps(&Pendulum::PAPER, start, from, until).unwrap();
        let (mut t, mut z, mut before) = (from, start, None);
        while let Some(step) = walk.next() {
            let step = step.unwrap();
            assert!(step.start_time() == t && step.start() == z, "walk {n}");
            let rejected = walk.counts().rejected;
            assert!(
                step.size().abs() > 1e-12 * (until - from).abs(),
                "walk {n}: {} s",
                step.size()
            );
            if let Some((size, refused)) = before
                && step.end_time() == until
                && rejected == refused
            {
                let share: f64 = step.size() / size;
                assert!(share > 0.0099, "walk {n}: a last step of {share} of the one before");
                last_steps += 1;
            }
            before = Some((step.size(), rejected));
            (t, z) = (step.end_time(), step.end());
        }
        assert!(t == until && walk.time() == until && walk.state() == z, "walk {n}: {t}");
    }
    assert!(last_steps > 500, "{last_steps}");
}
each_controlled!(a_walk_ends_where_it_should);

/// Catches: a last step past the end, short of it, or split in two; a step taken after the end, or
/// when the end is the start.
fn the_last_step_ends_at_the_end<M: Controlled<Pendulum>>(method: M) {
    let pendulum = Pendulum::PAPER;
    let adaptive = Adaptive::new(method, tolerance(1e-9));
    for end in [1e-300, 1e-3, 0.7, 5.0, -5.0] {
        let mut times = vec![];
        let mut watch = |n, t, z: Phase| times.push((n, t, z));
        let (last, counts) =
            adaptive.integrate_with(&pendulum, START, 0.0, end, &mut watch).unwrap();
        assert_eq!(times[0], (0, 0.0, START));
        assert_eq!(times.last(), Some(&(counts.accepted, end, last)));
        assert!(times.iter().enumerate().all(|(n, time)| time.0 == n as u64));
        assert!(times.windows(2).all(|pair| pair[0].1 != pair[1].1));
        assert!(times.windows(2).all(|pair| (pair[1].1 - pair[0].1).signum() == end.signum()));
    }

    let mut walk = adaptive.steps(&pendulum, START, 3.0, 3.0).unwrap();
    assert!(walk.next().is_none() && walk.next().is_none());
    assert_eq!((walk.time(), walk.state()), (3.0, START));
}
each_controlled!(the_last_step_ends_at_the_end);

/// Catches: a force evaluated beyond the end, where it may not be defined; a refusal of the
/// shortest possible step.
fn nothing_is_asked_beyond_the_end<M: Embedded>(method: M) {
    let latest = std::cell::Cell::new(0.0_f64);
    let law = Law(|t: f64, y: f64| {
        latest.set(latest.get().max(t));
        -4.0 * y
    });
    let adaptive = Adaptive::new(method, tolerance(1e-6));
    adaptive.integrate(&law, Number { y: 1.0 }, 0.0, 1e-3).unwrap();
    assert_eq!(latest.get(), 1e-3);
    let (_, counts) = adaptive.integrate(&law, Number { y: 1.0 }, 1e6, 1e6_f64.next_up()).unwrap();
    assert_eq!((counts.accepted, latest.get()), (1, 1e6_f64.next_up()));
}
each_pair!(nothing_is_asked_beyond_the_end);

/// Catches: a loop that goes on after the observer is satisfied.
fn a_satisfied_observer_ends_the_loop<M: Controlled<Pendulum>>(method: M) {
    let mut watch = First::<10>::default();
    let adaptive = Adaptive::new(method, tolerance(1e-9));
    let (end, counts) =
        adaptive.integrate_with(&Pendulum::PAPER, START, 0.0, 5.0, &mut watch).unwrap();
    assert_eq!((watch.0.len(), counts.accepted), (10, 9));
    let ninth = walk(&Pendulum::PAPER, method, 1e-9, 5.0).nth(8).unwrap().unwrap();
    assert_eq!(end, ninth.end());
}
each_controlled!(a_satisfied_observer_ends_the_loop);

// -------------------------------------------------------------------------------------------------
// Refusals
// -------------------------------------------------------------------------------------------------

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
        "relative tolerance cannot be 1e-16. It must be at least 2.22e-15, ten roundings of an \
         f64, and less than 1"
    );
}

/// Catches: an accepted tolerance so fine that no step meets it; an error of more than 1000
/// tolerances there.
fn the_finest_tolerance_can_be_met<M: Controlled<Pendulum>>(method: M) {
    let finest = Tolerance::uniform(SMALLEST_RELATIVE).unwrap();
    let adaptive = Adaptive::new(method, finest);
    let (end, _) = adaptive.integrate(&Pendulum::PAPER, START, 0.0, 2.0).unwrap();
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
    let Some(Error::StepTooSmall { t, step, .. }) = error else { panic!("{error:?}") };
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
        let end = adaptive.integrate(&law, Number { y: 1.0 }, from, 2.0);
        let Err(Error::StepTooSmall { t, .. }) = end else { panic!("{end:?}") };
        assert_eq!(t, from);
    }
    // A rate that becomes NaN on the way is found there.
    let law = Law(|t, _| if t < 1.0 { 1.0 } else { f64::NAN });
    let end = adaptive.integrate(&law, Number { y: 1.0 }, 0.0, 2.0);
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
        adaptive.integrate(&pendulum, START, 0.0, 20.0).unwrap();
    let attempts = accepted + rejected;
    assert!(adaptive.max_attempts(attempts).integrate(&pendulum, START, 0.0, 20.0).is_ok());
    let error =
        adaptive.max_attempts(attempts - 1).integrate(&pendulum, START, 0.0, 20.0).unwrap_err();
    let Error::OutOfSteps { t, limit, .. } = error else { panic!("{error:?}") };
    assert!(limit == attempts - 1 && t > 15.0 && t < 20.0, "{error}");
    assert!(error.to_string().starts_with(&format!("{limit} steps were not enough")));
}
each_controlled!(a_limit_is_kept);

/// The rate is infinite once, at the n-th evaluation of the walk, and 1 otherwise, also at an
/// infinite state: the step with that evaluation is not taken, and the walk goes on as if nothing
/// had been.
///
/// Catches: a stage without weight in the error estimate, or the rate at the end of a step, that is
/// not looked at: the step is taken although its rate is infinite, or the walk ends at its end.
fn a_step_with_an_infinite_rate_is_not_taken<M: Embedded>(method: M) {
    /// How often the first step is tried out before it begins.
    const BEFORE: u64 = 2;
    let adaptive = Adaptive::new(method, tolerance(1e-6));
    let walk = |infinite: Option<u64>| {
        let count = std::cell::Cell::new(0);
        let law = Law(|_, _| {
            count.set(count.get() + 1);
            if infinite == Some(count.get()) { f64::INFINITY } else { 1.0 }
        });
        adaptive.integrate(&law, Number { y: 1.0 }, 0.0, 1.0).unwrap()
    };
    let (_, undisturbed) = walk(None);
    assert_eq!(undisturbed.rejected, 0);
    for n in BEFORE + 1..=undisturbed.evaluations {
        let (end, counts) = walk(Some(n));
        assert_eq!(counts.rejected, 1, "evaluation {n}");
        assert!((end.y - 2.0).abs() < 1e-6, "evaluation {n}: {end:?}");
    }
}
each_pair!(a_step_with_an_infinite_rate_is_not_taken);

/// Motions that end, and whose rate is NaN beyond: x = √(x₀² − t), −ln(1 − t), ∛(x₀³ − 3t), and a
/// fall whose formula has a root. Each walk past the end is an error, at every tolerance.
///
/// Catches: a NaN at a stage or at the end of a step that is accepted; a step across the end.
fn the_end_of_a_motion_is_told_where_the_rate_is_no_number<M: Embedded>(method: M) {
    type Rate = fn(f64, f64) -> f64;
    type AfterEnd = fn(f64) -> f64;
    fn if_positive(x: f64, rate: f64) -> f64 {
        if x > 0.0 { rate } else { f64::NAN }
    }
    let laws: [(Rate, AfterEnd); 4] = [
        (|_, x| if_positive(x, -0.5 / x), |x| 1.05 * x * x),
        (|t, _| if_positive(1.0 - t, 1.0 / (1.0 - t)), |_| 1.05),
        (|_, x| if_positive(x, -1.0 / (x * x)), |x| 0.35 * x * x * x),
        (|_, x| -x.sqrt() - 0.01, |x| 2.1 * x.sqrt()),
    ];
    let mut random = Random::new(5);
    for n in 0..200 {
        let (x, tol) = (random.between(0.3, 3.0), 10_f64.powf(random.between(-11.0, -1.0)));
        let (past, adaptive) = (random.between(1.0, 3.0), Adaptive::new(method, tolerance(tol)));
        for (law, after_end) in laws {
            let until = past * after_end(x);
            let walk = adaptive.integrate(&Law(law), Number { y: x }, 0.0, until);
            assert!(matches!(walk, Err(Error::StepTooSmall { .. })), "{n}, {tol:e}: {walk:?}");
        }
    }
}
each_pair!(the_end_of_a_motion_is_told_where_the_rate_is_no_number);

/// Catches: a largest step that is not kept, backwards in time either; one that changes the steps
/// where it is longer than all of them; one of no length.
fn no_step_is_longer_than_the_largest<M: Controlled<Pendulum>>(method: M) {
    let adaptive = Adaptive::new(method, tolerance(1e-6));
    let sizes = |adaptive: Adaptive<M>, until: f64| -> Vec<f64> {
        let walk = adaptive.steps(&Pendulum::PAPER, START, 0.0, until).unwrap();
        walk.map(|step| step.unwrap().size().abs()).collect()
    };
    for until in [5.0, -5.0] {
        let any = sizes(adaptive, until);
        assert_eq!(sizes(adaptive.max_step(1e3).unwrap(), until), any);
        let short = sizes(adaptive.max_step(0.01).unwrap(), until);
        let (last, others) = short.split_last().unwrap();
        assert!(others.iter().all(|size| *size <= 0.01) && *last <= 0.0101, "{short:?}");
        assert!((495..=510).contains(&short.len()), "{}", short.len());
    }
    for longest in [0.0, -0.1, f64::NAN, f64::INFINITY] {
        assert!(matches!(adaptive.max_step(longest), Err(Error::Parameter { .. })));
    }
}
each_controlled!(no_step_is_longer_than_the_largest);

/// A pulse of 0.04 s in ten seconds where nothing else happens: the walk steps over it, as the
/// documentation says, unless no step is longer than the pulse. Then each is off by a tolerance.
///
/// Catches: a largest step that is forgotten when the steps grow.
fn a_largest_step_finds_a_pulse<M: Embedded>(method: M) {
    let width: f64 = 0.02;
    let pulse = Law(|t: f64, _| (-((t - 7.3) / width).powi(2)).exp());
    let adaptive = Adaptive::new(method, tolerance(1e-9));
    let end = |adaptive: Adaptive<M>| {
        adaptive.integrate(&pulse, Number { y: 1.0 }, 0.0, 10.0).unwrap().0.y
    };
    let right = 1.0 + width * PI.sqrt();
    assert_eq!(end(adaptive), 1.0);
    assert!((end(adaptive.max_step(0.04).unwrap()) - right).abs() < 1e-6);
}
each_pair!(a_largest_step_finds_a_pulse);
