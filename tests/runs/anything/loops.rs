//! The loops of every method.

use std::num::NonZeroU64;

use pendula::fast::InLanes;
use pendula::integrate::Every;
use pendula::internals::ScaledPendulum;
use pendula::methods::{Gauss6, Implicit, Iteration};
use pendula::registry::InSteps;
use pendula::systems::CompensatedPhase;
use pendula::{
    AnyMethod, Compensated, Counting, Driven, Ensemble, Error, Grid, Info, METHODS, Method,
    Pendulum, Phase, integrate_fast_with, integrate_with, method_named,
};

use super::*;
use crate::common::{Random, Samples, bits as bits_of, in_seconds, on};
use crate::extremes::{is_as_promised, is_bounded};

// -------------------------------------------------------------------------------------------------
// Every method
// -------------------------------------------------------------------------------------------------

/// A method in each of its loops.
struct Loops<'a, L: ?Sized> {
    in_steps: &'a dyn AnyMethod,
    in_seconds: &'a dyn AnyMethod,
    in_lanes: &'a L,
    compensated: &'a dyn AnyMethod<Compensated<Pendulum>>,
}

/// A method of the list: in seconds, in steps, in lanes, watched, with compensated sums, asked why.
pub fn a_run(any: &mut Any, tally: &mut Tally) {
    if any.0.below(20) == 0 {
        let tolerance = Iteration::default().tolerance(any.number());
        let gauss = &Gauss6.with(tally.accepted(tolerance).unwrap_or_default());
        let loops = Loops {
            in_steps: &InSteps(*gauss),
            in_seconds: gauss,
            in_lanes: gauss,
            compensated: gauss,
        };
        run_of(loops, any, tally);
    } else {
        let method = any.0.one_of(METHODS);
        let loops = Loops {
            in_steps: method,
            in_seconds: in_seconds(method),
            in_lanes: method,
            compensated: on(method),
        };
        run_of(loops, any, tally);
    }
}

fn run_of<L: InLanes + ?Sized>(loops: Loops<'_, L>, any: &mut Any, tally: &mut Tally) {
    let Loops { in_steps: method, in_lanes, compensated, .. } = loops;
    let pendulum = any.pendulum();
    let grid = any.grid(&pendulum, 12);
    let count = 1 + any.0.below(4) * any.0.below(12);
    let starts = starts(any, &pendulum, count);
    let case = |z: Phase| format!("{} {pendulum:?} {grid:?} {z:?}", method.info().name);

    let duration = grid.time(grid.steps());
    for start in &starts[..count.min(3)] {
        tally.computed += 1;
        let mut last = *start;
        let fast = method.run(&pendulum, *start, &grid, &mut |_, _, z| last = z);
        assert_eq!(bits_of(last), bits_of(fast), "{}", case(*start));
        let is_nan = |z: Phase| z.theta.is_nan() && z.omega.is_nan();
        match method.try_run(&pendulum, *start, &grid, &mut ()) {
            Ok(tried) => assert_eq!(bits_of(tried), bits_of(fast), "{}", case(*start)),
            Err(Error::NotSolved { n, .. }) => assert!(n < grid.steps() && is_nan(fast)),
            Err(other) => panic!("{other}"),
        }
        let end = match loops.in_seconds.try_run(&pendulum, *start, &grid, &mut ()) {
            Ok(end) => end,
            Err(Error::NotSolved { n, .. }) if n < grid.steps() => {
                Phase { theta: f64::NAN, omega: f64::NAN }
            }
            Err(other) => panic!("{other}"),
        };
        if grid.steps() == 0 {
            assert_eq!([bits_of(end), bits_of(fast)], [bits_of(*start); 2], "{}", case(*start));
        }
        // Finite in is finite out, as long as a thousand times the force, the velocity and the way
        // are: the coefficients of a method go up to a hundred.
        let force = 1e3 * pendulum.frequency_squared();
        let velocity = 1e3 * (start.omega.abs() + force * duration);
        let moderate = pendulum.start(start.theta, start.omega).is_ok()
            && [force, velocity, velocity * duration].iter().all(|x| *x < 1e290);
        if moderate {
            for end in [end, fast] {
                let kept = is_as_promised(method, &pendulum, *start, end, &grid);
                assert!(kept, "{end:?}: {}", case(*start));
            }
        }
        let from = CompensatedPhase::from(*start);
        let summed = compensated.try_run(&Compensated::new(pendulum), from, &grid, &mut ());
        let bounded = is_bounded(method, &pendulum, *start, grid.step());
        if moderate && !method.info().implicit && bounded {
            let finite = summed.is_ok_and(|end| is_finite(end.phase));
            assert!(finite, "compensated: {}", case(*start));
        }
    }

    let mut ends = vec![Phase::default(); count];
    Ensemble::new(&pendulum, &starts, grid).ends(in_lanes, &mut ends);
    let every = any.0.one_of(&[1, 2, 3, 5, 1 << 32, u64::MAX]);
    let every = NonZeroU64::new(every).unwrap();
    let mut seen = vec![Samples::default(); count];
    Ensemble::new(&pendulum, &starts, grid).watch(in_lanes, every, &mut seen);
    for ((start, end), seen) in starts.iter().zip(ends).zip(seen) {
        let mut watch = Every::new(every, Samples::default());
        let alone = method.run(&pendulum, *start, &grid, &mut watch);
        assert_eq!(bits_of(end), bits_of(alone), "{}", case(*start));
        assert_eq!(seen.0, watch.into_inner().0, "{}", case(*start));
    }
}

/// Starts of that pendulum: any, or such as swing and rotate.
fn starts(any: &mut Any, pendulum: &Pendulum, count: usize) -> Vec<Phase> {
    let frequency = pendulum.small_angle_frequency();
    let wild = any.0.below(2) == 0;
    let mut start = || {
        if wild {
            return any.phase();
        }
        let q = any.0.between(-5.0, 5.0);
        Phase { theta: any.0.between(-10.0, 10.0), omega: q * frequency }
    };
    (0..count).map(|_| start()).collect()
}

// -------------------------------------------------------------------------------------------------
// The generic loops
// -------------------------------------------------------------------------------------------------

/// The loops that are compiled with the type of a method are those behind its pointers: the same
/// samples with the same bits, the same count, the same step that has no solution.
///
/// Here alone every method is named by its type: it compiles all loops again. All other tests ask
/// the pointers, and what they find is so true of the generic loops too.
///
/// Catches: a pointer to another method; a block of states that is left a step early or seen twice,
/// a carry lost between two of them; a time of another step; NaN where the other loop has an end.
fn loops_agree<M>(method: &M)
where
    M: Info + Copy + Sync,
    M: Method<ScaledPendulum> + Method<Counting<ScaledPendulum>>,
    M: Method<Pendulum> + Method<Counting<Pendulum>>,
{
    let listed = method_named(method.info().name).unwrap();
    let mut any = Any(Random::new(29));
    for n in 0..200 {
        let pendulum = any.pendulum();
        // More than one block of states, now and then.
        let grid = any.grid(&pendulum, if n % 10 == 0 { 150 } else { 12 });
        let [start] = starts(&mut any, &pendulum, 1)[..] else { unreachable!() };
        let case = format!("{pendulum:?} {grid:?} {start:?}");
        let mut watches = [const { Samples(Vec::new()) }; 6];
        let [one, two, three, four, five, six] = &mut watches;
        let end = integrate_fast_with(&pendulum, method, start, &grid, one);
        assert_eq!(bits_of(listed.run(&pendulum, start, &grid, two)), bits_of(end), "{case}");
        let tried = InSteps(*method).try_run(&pendulum, start, &grid, three);
        let listed_tried = listed.try_run(&pendulum, start, &grid, four);
        assert_eq!(format!("{listed_tried:?}"), format!("{tried:?}"), "{case}");
        let counting = Counting::new(pendulum);
        let typed = pendula::try_integrate_with(&counting, method, start, &grid, five);
        let listed_in_seconds = in_seconds(listed).try_run(&pendulum, start, &grid, six);
        assert_eq!(format!("{listed_in_seconds:?}"), format!("{typed:?}"), "{case}");
        let counted = in_seconds(listed).count_evaluations(&pendulum, start, &grid);
        assert_eq!(counted, counting.evaluations(), "{case}");
        for (at, pair) in watches.chunks(2).enumerate() {
            assert_eq!(pair[0].0, pair[1].0, "{at}: {case}");
        }
    }
}
each_method_type!(loops_agree);

/// The same under a drive, which depends on the time.
///
/// Catches: a time that begins anew with each block of states.
fn loops_agree_on_the_time<M: Info + Method<Driven>>(method: &M) {
    let driven = Driven::taylor(1.07).unwrap();
    let (start, grid) = (Phase { theta: -0.4, omega: 1.2 }, Grid::new(0.01, 150).unwrap());
    let (mut seen, mut listed) = (Samples::default(), Samples::default());
    let end = integrate_with(&driven, method, start, &grid, &mut seen);
    let by_name = method_named::<Driven>(method.info().name).unwrap();
    assert_eq!(by_name.try_run(&driven, start, &grid, &mut listed), Ok(end));
    assert_eq!(seen.0, listed.0);
}
each_general_method_type!(loops_agree_on_the_time);
