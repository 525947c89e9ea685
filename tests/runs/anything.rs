//! The whole public interface with any numbers: every exponent of an f64 is as likely as any other,
//! and zeros, infinities, NaN, and the ends of its range are frequent.
//!
//! A scene asks one part of the library with such numbers. It is refused with an error of one line,
//! or what comes out is finite where the documentation says so; no scene panics or goes on for
//! ever; and what is computed for many at once has the bits of what is computed for one.

use std::num::NonZeroU64;

use pendula::adaptive::{Adaptive, Controlled, Direction, SymmetricSteps, TaylorSeries, Tolerance};
use pendula::arithmetic::double_double::DoubleDouble;
use pendula::arithmetic::sine::{cos, sin};
use pendula::dynamics::floquet::monodromy;
use pendula::dynamics::lyapunov::Watch;
use pendula::dynamics::{
    Linearised, Monodromy, PeriodicOrbit, Stroboscope, largest_exponent, period_doubling,
    periodic_orbit, root,
};
use pendula::exact::{Swing, complete_elliptic_k, period};
use pendula::fast::{InLanes, ScaledPendulum};
use pendula::integrate::{Every, Steps};
use pendula::methods::{Dop853, DormandPrince, Gauss6, Implicit, Iteration, Rk4, StormerVerlet};
use pendula::metrics::order::{is_asymptotic, is_floor, slopes};
use pendula::metrics::{
    AngleError, CrossingPeriod, CrossingRule, EndError, EnergyDrift, Henon, Hermite, Linear,
    PeakPeriod, polygon_area,
};
use pendula::systems::{
    CompensatedPhase, DoublePendulum, DoublePhase, Ellipse, Joint, Kepler, PlanePhase, Shaken,
};
use pendula::verify::{Claims, Fault, Reply, Request, Stranger, try_judge};
use pendula::{
    AnyMethod, Compensated, Counting, Damped, Driven, Ensemble, Error, Grid, Hamiltonian,
    LinearOscillator, METHODS, Method, Motion, MotionKind, Observer, Pendulum, Phase, Separable,
    System, integrate, integrate_fast, method_named, try_integrate_fast,
};

use crate::common::{lanes, steps, steps_on, try_integrate};
use crate::extremes::{is_as_promised, is_bounded};
use crate::random::Random;

/// Ten thousand scenes, a second or two.
///
/// Catches: a panic, an overflow of an integer, a loop without an end; a number out of range
/// accepted and NaN later; a batch or a lane with other bits than a run alone.
#[test]
fn ten_thousand_scenes_are_sound_or_refused() {
    let tally = Tally::of(10_000, 1);
    assert!(tally.refused > 1000 && tally.computed > 1000, "{tally:?}");
}

/// A million other scenes, which take minutes:
///
/// ```text
/// cargo test --release -p pendula --test runs -- --ignored --nocapture a_million_scenes
/// ```
///
/// with `CARGO_PROFILE_RELEASE_DEBUG_ASSERTIONS=true CARGO_PROFILE_RELEASE_OVERFLOW_CHECKS=true`
/// before it, so that an overflow of an integer shows.
///
/// Catches: the same, where it is rare.
#[test]
#[ignore = "takes minutes: the comment above has the command"]
fn a_million_scenes_are_sound_or_refused() {
    let tally = Tally::of(1_000_000, 2);
    println!("{tally:?}");
    assert!(tally.refused > 100_000 && tally.computed > 100_000, "{tally:?}");
}

/// How many requests were refused, and how many computed.
#[derive(Debug, Default)]
struct Tally {
    refused: u64,
    computed: u64,
}

impl Tally {
    /// The tally of `scenes` scenes of the sequence `seed`. A scene that fails says which it was.
    fn of(scenes: u64, seed: u64) -> Self {
        const PARTS: [fn(&mut Any, &mut Tally); 14] = [
            a_pendulum,
            a_grid,
            a_run,
            a_run,
            a_run,
            a_motion,
            a_period,
            metrics,
            readings,
            adaptive_steps,
            variable_steps,
            systems_beyond,
            dynamics,
            arithmetic,
        ];
        let mut tally = Self::default();
        for scene in 0..scenes {
            let mut any = Any(Random::new(seed.wrapping_mul(0x1000_0000_0001).wrapping_add(scene)));
            let said = Said { seed, scene };
            // Judging takes a thousand times as long as any other scene.
            if scene % 2500 == 2499 {
                a_stranger(&mut any, &mut tally);
            } else {
                PARTS[any.0.below(PARTS.len())](&mut any, &mut tally);
            }
            std::mem::forget(said);
        }
        tally
    }

    /// What came out, if it was not refused. A refusal has one line.
    fn accepted<T>(&mut self, result: Result<T, Error>) -> Option<T> {
        match result {
            Ok(value) => {
                self.computed += 1;
                Some(value)
            }
            Err(error) => {
                self.refused += 1;
                let text = error.to_string();
                assert!(!text.is_empty() && !text.contains('\n'), "{text}");
                None
            }
        }
    }
}

/// Says in which scene it was dropped: by a panic.
struct Said {
    seed: u64,
    scene: u64,
}

impl Drop for Said {
    fn drop(&mut self) {
        eprintln!("scene {} of the sequence {}", self.scene, self.seed);
    }
}

/// Any numbers.
struct Any(Random);

impl Any {
    /// Any f64: in one of four cases a special one, otherwise 64 random bits or an ordinary number.
    fn number(&mut self) -> f64 {
        const SPECIAL: [f64; 16] = [
            0.0,
            -0.0,
            5e-324,
            -5e-324,
            2.225_073_858_507_201e-308,
            f64::MIN_POSITIVE,
            1e-160,
            1.0,
            -1.0,
            1e15,
            1e160,
            f64::MAX,
            f64::MIN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::NAN,
        ];
        match self.0.below(4) {
            0 => self.0.one_of(&SPECIAL),
            1 => self.0.between(-10.0, 10.0),
            _ => f64::from_bits(self.0.bits()),
        }
    }

    /// Any number greater than zero and finite.
    fn positive(&mut self) -> f64 {
        loop {
            let number = self.number().abs();
            if number > 0.0 && number.is_finite() {
                return number;
            }
        }
    }

    /// Any numbers, `count` of them.
    fn numbers(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.number()).collect()
    }

    fn phase(&mut self) -> Phase {
        Phase { theta: self.number(), omega: self.number() }
    }

    fn phases(&mut self, count: usize) -> Vec<Phase> {
        (0..count).map(|_| self.phase()).collect()
    }

    /// Any pendulum that is not refused; half of them are ordinary.
    fn pendulum(&mut self) -> Pendulum {
        if self.0.below(2) == 0 {
            let [gravity, length, mass] = [0, 1, 2].map(|_| self.0.between(0.1, 10.0));
            return Pendulum::new(gravity, length, mass).unwrap();
        }
        loop {
            let [gravity, length, mass] = [0, 1, 2].map(|_| self.positive());
            if let Ok(pendulum) = Pendulum::new(gravity, length, mass) {
                return pendulum;
            }
        }
    }

    /// A grid of up to `most` steps, in half of the cases with a step that suits the pendulum.
    fn grid(&mut self, pendulum: &Pendulum, most: usize) -> Grid {
        let steps = self.0.below(most + 1) as u64;
        let natural = self.0.between(1e-4, 3.0) / pendulum.small_angle_frequency();
        let step = if self.0.below(2) == 0 { natural } else { self.positive() };
        Grid::new(step, steps).unwrap_or_else(|_| Grid::new(1.0, steps).unwrap())
    }
}

/// The bits of a number; those of all NaNs are the same.
fn bits(x: f64) -> u64 {
    if x.is_nan() { f64::NAN.to_bits() } else { x.to_bits() }
}

fn bits_of(z: Phase) -> [u64; 2] {
    [bits(z.theta), bits(z.omega)]
}

fn is_finite(z: Phase) -> bool {
    z.theta.is_finite() && z.omega.is_finite()
}

// -------------------------------------------------------------------------------------------------
// The pendulum and its grid
// -------------------------------------------------------------------------------------------------

fn a_pendulum(any: &mut Any, tally: &mut Tally) {
    let built = Pendulum::new(any.number(), any.number(), any.number());
    let pendulum = tally.accepted(built).unwrap_or_else(|| any.pendulum());
    for derived in [
        pendulum.frequency_squared(),
        pendulum.depth(),
        2.0 * pendulum.depth(),
        pendulum.small_angle_frequency(),
        pendulum.small_angle_period(),
    ] {
        assert!(derived.is_normal() && derived > 0.0, "{pendulum:?}");
    }
    let (theta, omega) = (any.number(), any.number());
    if let Some(z) = tally.accepted(pendulum.start(theta, omega)) {
        assert!(pendulum.energy(z).is_finite() && pendulum.energy(z) >= 0.0, "{pendulum:?} {z:?}");
        assert!(pendulum.energy_from_pivot(z).is_finite(), "{pendulum:?} {z:?}");
        assert!(is_finite(pendulum.rate(0.0, z)));
    }
    // Many at once: any numbers, or angles within one turn, which are computed otherwise.
    let count = any.0.below(70);
    let within = any.0.one_of(&[3.0, 6.0, 1e3, f64::INFINITY]);
    let states: Vec<Phase> = (0..count)
        .map(|_| {
            let Phase { theta, omega } = any.phase();
            let theta = if within.is_finite() { any.0.between(-within, within) } else { theta };
            Phase { theta, omega }
        })
        .collect();
    let mut energies = vec![0.0; any.0.below(count + 2)];
    pendulum.energies(&states, &mut energies);
    for (z, energy) in states.iter().zip(energies) {
        assert_eq!(bits(energy), bits(pendulum.energy(*z)), "{pendulum:?} {z:?}");
    }
}

fn a_grid(any: &mut Any, tally: &mut Tally) {
    let (step, duration) = (any.number(), any.number());
    let steps = any.0.one_of(&[0, 1, 10, 1 << 53, (1 << 53) + 1, u64::MAX]);
    let random = any.0.bits();
    for steps in [steps, random] {
        if let Some(grid) = tally.accepted(Grid::new(step, steps)) {
            assert!(grid.time(grid.steps()).is_finite() && grid.samples() == steps + 1);
        }
    }
    let multiple = step * any.0.below(1000) as f64;
    for duration in [duration, multiple] {
        if let Some(grid) = tally.accepted(Grid::with_duration(step, duration)) {
            let end = grid.time(grid.steps());
            assert!((end / duration - 1.0).abs() < 4.0 * f64::EPSILON, "{step:e} {duration:e}");
        }
    }
}

// -------------------------------------------------------------------------------------------------
// Every method
// -------------------------------------------------------------------------------------------------

/// A method behind pointers, to what is compiled once.
#[derive(Clone, Copy)]
struct ByPointer<'a> {
    method: &'a dyn AnyMethod,
    lanes: &'a dyn InLanes,
    compensated: &'a dyn Steps<Compensated<Pendulum>>,
}

/// A method of the list: in seconds, in steps, in lanes, watched, with compensated sums, asked why.
fn a_run(any: &mut Any, tally: &mut Tally) {
    if any.0.below(20) == 0 {
        let tolerance = Iteration::default().tolerance(any.number());
        let gauss = &Gauss6.with(tally.accepted(tolerance).unwrap_or_default());
        run_of(ByPointer { method: gauss, lanes: gauss, compensated: gauss }, any, tally);
    } else {
        let method = any.0.one_of(METHODS);
        let (lanes, compensated) = (lanes(method), steps_on(method));
        run_of(ByPointer { method, lanes, compensated }, any, tally);
    }
}

fn run_of(by_pointer: ByPointer<'_>, any: &mut Any, tally: &mut Tally) {
    let ByPointer { method, lanes, compensated } = by_pointer;
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
        let end = match try_integrate(&pendulum, steps(method), *start, &grid, &mut ()) {
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
        let summed = try_integrate(&Compensated::new(pendulum), compensated, from, &grid, &mut ());
        let bounded = is_bounded(method, &pendulum, *start, grid.step());
        if moderate && !method.info().implicit && bounded {
            let finite = summed.is_ok_and(|end| is_finite(end.phase));
            assert!(finite, "compensated: {}", case(*start));
        }
    }

    let mut ends = vec![Phase::default(); count];
    Ensemble::new(&pendulum, &starts, grid).ends(lanes, &mut ends);
    let every = any.0.one_of(&[1, 2, 3, 5, 1 << 32, u64::MAX]);
    let every = NonZeroU64::new(every).unwrap();
    let mut seen = vec![Samples::default(); count];
    Ensemble::new(&pendulum, &starts, grid).watch(lanes, every, &mut seen);
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
    M: AnyMethod + Method<ScaledPendulum> + Method<Pendulum> + Method<Counting<Pendulum>>,
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
        let end = integrate_fast(&pendulum, method, start, &grid, one);
        assert_eq!(bits_of(listed.run(&pendulum, start, &grid, two)), bits_of(end), "{case}");
        let tried = try_integrate_fast(&pendulum, method, start, &grid, three);
        let listed_tried = listed.try_run(&pendulum, start, &grid, four);
        assert_eq!(format!("{listed_tried:?}"), format!("{tried:?}"), "{case}");
        let counting = Counting::new(pendulum);
        let in_seconds = pendula::try_integrate(&counting, method, start, &grid, five);
        let listed_in_seconds = try_integrate(&pendulum, steps(listed), start, &grid, six);
        assert_eq!(format!("{listed_in_seconds:?}"), format!("{in_seconds:?}"), "{case}");
        let counted = listed.count_evaluations(&pendulum, start, &grid);
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
fn loops_agree_on_the_time<M: AnyMethod + Method<Driven>>(method: &M) {
    let driven = Driven::taylor(1.07).unwrap();
    let (start, grid) = (Phase { theta: -0.4, omega: 1.2 }, Grid::new(0.01, 150).unwrap());
    let (mut seen, mut listed) = (Samples::default(), Samples::default());
    let end = integrate(&driven, method, start, &grid, &mut seen);
    assert_eq!(try_integrate(&driven, steps_on(method), start, &grid, &mut listed), Ok(end));
    assert_eq!(seen.0, listed.0);
}
each_general_method_type!(loops_agree_on_the_time);

/// n, t and state of every sample, as bits.
#[derive(Clone, Default)]
struct Samples(Vec<(u64, u64, [u64; 2])>);

impl Observer<Phase> for Samples {
    fn observe(&mut self, n: u64, t: f64, z: Phase) {
        self.0.push((n, t.to_bits(), bits_of(z)));
    }
}

// -------------------------------------------------------------------------------------------------
// The exact solution
// -------------------------------------------------------------------------------------------------

fn a_motion(any: &mut Any, tally: &mut Tally) {
    let pendulum = any.pendulum();
    let start = any.phase();
    let motion = if any.0.below(8) == 0 {
        Motion::on_separatrix(&pendulum, start.theta)
    } else {
        Motion::new(&pendulum, start)
    };
    let Some(motion) = tally.accepted(motion) else { return };
    let case = || format!("{pendulum:?} {start:?} {motion:?}");
    assert!(motion.modulus().is_finite() && motion.modulus() >= 0.0, "{}", case());
    assert!(motion.horizon() > 0.0, "{}", case());
    match motion.kind() {
        MotionKind::Libration | MotionKind::Rotation => {
            let period = motion.period().unwrap();
            assert!(period > 0.0 && period.is_finite(), "{}", case());
        }
        MotionKind::Rest | MotionKind::Separatrix => assert_eq!(motion.period(), None),
    }
    let count = any.0.below(80);
    let mut times = any.numbers(count);
    times.push(0.0);
    for t in &times {
        let z = motion.at(*t);
        let inside = t.abs() <= motion.horizon();
        assert_eq!(is_finite(z), inside, "{t:e}: {z:?}, {}", case());
        assert!(inside || (z.theta.is_nan() && z.omega.is_nan()), "{t:e}: {z:?}, {}", case());
    }
    let mut states = vec![Phase::default(); times.len()];
    motion.at_each(&times, &mut states);
    let within = |horizon: f64| times.iter().all(|t| t.abs() <= horizon);
    let series = motion.series().filter(|series| times.len() >= 64 && within(series.horizon()));
    for (t, z) in times.iter().zip(states) {
        let one = series.as_ref().map_or_else(|| motion.at(*t), |series| series.at(*t));
        assert_eq!(bits_of(z), bits_of(one), "{t:e}: {}", case());
        assert_eq!(is_finite(z), t.abs() <= motion.horizon(), "{t:e}: {z:?}, {}", case());
    }
}

fn a_period(any: &mut Any, tally: &mut Tally) {
    let (pendulum, theta) = (any.pendulum(), any.number());
    if let Some(swing) = tally.accepted(Swing::released_at(&pendulum, theta)) {
        assert!(swing.ratio() >= 1.0 && swing.ratio() < 50.0, "{theta:e}: {swing:?}");
        assert!((0.0..=1.0).contains(&swing.modulus()), "{theta:e}: {swing:?}");
        assert!((0.0..=1.0).contains(&swing.complementary_modulus()), "{theta:e}: {swing:?}");
        assert!(swing.period().is_finite(), "{pendulum:?} {theta:e}");
        assert_eq!(period(&pendulum, theta), Ok(swing.period()));
    }
    let k = any.number();
    let integral = complete_elliptic_k(k);
    if k == 0.0 {
        assert_eq!(integral, f64::INFINITY);
    } else if (0.0..=1.0).contains(&k) {
        assert!((std::f64::consts::FRAC_PI_2..750.0).contains(&integral), "{k:e}: {integral}");
    } else {
        assert!(integral.is_nan(), "{k:e}: {integral}");
    }
}

// -------------------------------------------------------------------------------------------------
// Metrics
// -------------------------------------------------------------------------------------------------

fn metrics(any: &mut Any, tally: &mut Tally) {
    tally.computed += 1;
    let pendulum = any.pendulum();
    let count = any.0.below(200);
    let states = any.phases(count);
    let mut drift = EnergyDrift::new(&pendulum);
    let mut largest = 0.0_f64;
    for (n, z) in (0..).zip(&states) {
        drift.observe(n, 0.0, *z);
        let off = (pendulum.energy(*z) - pendulum.energy(states[0])).abs();
        largest = if off.is_nan() || largest.is_nan() { f64::NAN } else { largest.max(off) };
    }
    assert_eq!(bits(drift.largest()), bits(largest), "{pendulum:?} {states:?}");

    let mut angle = AngleError::new(|t| t);
    for (n, z) in (0..).zip(&states) {
        angle.observe(n, z.omega, *z);
    }
    let off = states.iter().map(|z| (z.theta - z.omega).abs());
    let worst =
        off.fold(0.0, |a: f64, b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) });
    assert_eq!(bits(angle.largest()), bits(worst), "{states:?}");
    let root = angle.root_mean_square();
    assert!(count == 0 || root.is_nan() || root >= 0.0);

    polygon_area(&states);
    let (steps, errors) = (any.numbers(5), any.numbers(5));
    let floor = any.number();
    for slope in slopes(&steps, &errors, floor) {
        let positive = steps.iter().all(|h| *h > 0.0 && h.is_finite());
        assert!(!positive || slope.is_none_or(|slope| !slope.is_nan() || has_twins(&steps)));
    }
    is_asymptotic(any.0.bits() as u32, errors[0], errors[1], floor);
    is_floor(errors[0], floor, errors[1]);

    let (start, t) = (any.phase(), any.number());
    if let Some(error) = tally.accepted(EndError::new(&pendulum, start, t)) {
        let steps = any.0.bits();
        error.rounding(steps);
        let end = any.phase();
        let of = error.of(end);
        assert!(of.is_nan() || of >= 0.0);
        assert!(!end.theta.is_nan() && !end.omega.is_nan() || of.is_nan(), "{end:?}: {of}");
    }
}

/// Whether two successive steps are the same, between which there is no slope.
fn has_twins(steps: &[f64]) -> bool {
    steps.windows(2).any(|pair| pair[0] == pair[1] || !(pair[1] / pair[0]).is_normal())
}

fn readings(any: &mut Any, tally: &mut Tally) {
    tally.computed += 1;
    let pendulum = any.pendulum();
    let mut peaks = [PeakPeriod::default(), PeakPeriod::parabola()];
    fn crossing(rule: impl CrossingRule, samples: &[(f64, Phase)]) -> Option<f64> {
        let mut reading = CrossingPeriod::new(rule);
        for (n, (t, z)) in (0..).zip(samples) {
            reading.observe(n, *t, *z);
        }
        reading.period()
    }
    let count = any.0.below(60);
    let mut samples: Vec<(f64, Phase)> = (0..count).map(|_| (any.number(), any.phase())).collect();
    if any.0.below(2) == 0 {
        // In the order of time, with angles of both signs.
        for (n, (t, z)) in samples.iter_mut().enumerate() {
            (*t, z.theta) = (n as f64, any.0.between(-3.0, 3.0));
        }
        let line = crossing(Linear, &samples);
        assert!(line.is_none_or(|period| period > 0.0), "{samples:?}");
    }
    for peak in &mut peaks {
        for (n, (t, z)) in (0..).zip(&samples) {
            peak.observe(n, *t, *z);
        }
        let _ = peak.period();
    }
    crossing(Linear, &samples);
    crossing(Hermite, &samples);
    crossing(Henon(&pendulum), &samples);
}

// -------------------------------------------------------------------------------------------------
// Steps that vary
// -------------------------------------------------------------------------------------------------

fn adaptive_steps(any: &mut Any, tally: &mut Tally) {
    match any.0.below(3) {
        0 => walk_of(DormandPrince, any, tally),
        1 => walk_of(Dop853, any, tally),
        _ => walk_of(TaylorSeries, any, tally),
    }
}

fn walk_of<M: Controlled<Pendulum>>(method: M, any: &mut Any, tally: &mut Tally) {
    let tolerance = tally.accepted(Tolerance::new(any.number(), any.number()));
    let tolerance = tolerance.unwrap_or_else(|| {
        let [absolute, relative] = [0, 1].map(|_| 10_f64.powf(any.0.between(-14.0, -1.0)));
        Tolerance::new(absolute, relative).unwrap()
    });
    let pendulum = any.pendulum();
    let limit = any.0.below(60) as u64;
    let adaptive = Adaptive::new(method, tolerance).max_attempts(limit);
    let natural = any.0.between(-5.0, 5.0) * pendulum.small_angle_period();
    let (start, from) = (any.phase(), any.number());
    let until = if any.0.below(2) == 0 { from + natural } else { any.number() };
    let case = || format!("{pendulum:?} {tolerance:?} {start:?} from {from:e} to {until:e}");

    let Some(mut walk) = tally.accepted(adaptive.steps(&pendulum, start, from, until)) else {
        return;
    };
    let (mut t, mut failed) = (from, false);
    while let Some(step) = walk.next() {
        let Some(step) = tally.accepted(step) else {
            failed = true;
            break;
        };
        assert!(step.start_time() == t, "{}", case());
        t = step.end_time();
        assert!(t != step.start_time() && (t - from) / (until - from) <= 1.0, "{}", case());
        assert!(is_finite(step.end()), "{:?}: {}", step.end(), case());
        let dense = walk.dense(&step);
        dense.at(any.number());
        dense.after(any.number());
    }
    assert!(walk.next().is_none() && walk.counts().accepted + walk.counts().rejected <= limit);
    assert!(failed || t == until, "{}", case());

    let direction = any.0.one_of(&[Direction::Rising, Direction::Falling, Direction::Either]);
    let wild = any.0.below(2) == 0;
    let mut walk = adaptive.steps(&pendulum, start, from, until).unwrap();
    let (low, high) = (from.min(until), from.max(until));
    let mut random = any.0.clone();
    let function = |_, z: Phase| if wild { f64::from_bits(random.bits()) } else { z.theta };
    for crossing in walk.crossings(direction, function) {
        let Some(crossing) = tally.accepted(crossing) else { break };
        assert!((low..=high).contains(&crossing.t), "{crossing:?}: {}", case());
    }
}

fn variable_steps(any: &mut Any, tally: &mut Tally) {
    let pendulum = any.pendulum();
    let (start, first, wild) = (any.phase(), any.number(), any.0.below(2) == 0);
    let factor = any.number();
    let density = |z: Phase| if wild { factor } else { z.omega * sin(z.theta) };
    let steps = SymmetricSteps::new(&pendulum, start, first, density);
    let Some(mut steps) = tally.accepted(steps) else { return };
    for sample in steps.by_ref().take(20) {
        let Some(sample) = tally.accepted(sample) else { break };
        assert!(!sample.density.is_nan() || !is_finite(sample.z) || wild, "{sample:?}");
    }
    let _ = steps.turned_back().next();
}

// -------------------------------------------------------------------------------------------------
// Systems beyond the pendulum
// -------------------------------------------------------------------------------------------------

fn systems_beyond(any: &mut Any, tally: &mut Tally) {
    let pendulum = any.pendulum();
    let grid = any.grid(&pendulum, 5);
    let (z, t) = (any.phase(), any.number());
    let damped = tally.accepted(Damped::new(pendulum, any.number()));
    if let Some(damped) = damped {
        assert!((2.0 * damped.damping()).is_finite());
        damped.small_swing(z, t);
        damped.power(z);
        damped.kick(z, any.number(), any.number());
        integrate(&damped, &StormerVerlet, z, &grid, &mut ());
        damped.size(damped.tangent(t, z, any.phase()));
    }
    let damped = damped.unwrap_or_else(|| Damped::new(pendulum, 0.0).unwrap());
    if let Some(driven) = tally.accepted(Driven::new(damped, any.number(), any.number())) {
        assert!(driven.period().is_finite() && driven.period() > 0.0, "{driven:?}");
        assert!((0.0..=1.0).contains(&driven.contraction()), "{driven:?}");
        integrate(&driven, &Rk4, z, &grid, &mut ());
    }
    if let Some(shaken) = tally.accepted(Shaken::new(pendulum, any.number(), any.number())) {
        let mathieu = shaken.mathieu();
        assert!(mathieu.a.is_finite() && mathieu.a <= 0.0, "{shaken:?} {mathieu:?}");
        assert!(mathieu.q.is_finite() && mathieu.q >= 0.0, "{shaken:?} {mathieu:?}");
        assert!(shaken.period().is_finite() && shaken.period() > 0.0, "{shaken:?}");
        integrate(&shaken, &Gauss6, z, &grid, &mut ());
    }
    let linear = LinearOscillator::new(pendulum);
    let exact = linear.exact(z, 0.0);
    let small = z.theta.abs() < 1e150 && z.omega.abs() < 1e150;
    assert!(!small || exact == z, "{pendulum:?} {z:?}: {exact:?}");
    linear.exact(z, t);

    if let Some(centre) = tally.accepted(Kepler::new(any.number())) {
        let state =
            PlanePhase { x: any.number(), y: any.number(), vx: any.number(), vy: any.number() };
        centre.eccentricity(state);
        integrate(&centre, &Rk4, state, &grid, &mut ());
        let eccentricity = if any.0.below(2) == 0 { any.number() } else { any.0.between(0.0, 1.0) };
        let ellipse = tally.accepted(Ellipse::new(&centre, any.number(), eccentricity));
        if let Some(ellipse) = ellipse {
            assert!(ellipse.period().is_normal() && ellipse.mean_motion().is_normal());
            // Within a turn, and at any time.
            for t in [0.0, any.0.between(-1.0, 1.0) * ellipse.period(), t] {
                let z = ellipse.at(t);
                if !(ellipse.mean_motion() * t).is_finite() {
                    continue;
                }
                let PlanePhase { x, y, vx, vy } = centre.rate(0.0, z);
                let case = || format!("{centre:?} {ellipse:?} at {t:e}: {z:?}");
                assert!([x, y, vx, vy].iter().all(|x| x.is_finite()), "{}", case());
                assert!(centre.energy(z).is_finite(), "{}", case());
            }
        }
    }

    let mut joint = || Joint { length: any.number(), mass: any.number() };
    let (upper, lower) = (joint(), joint());
    if let Some(double) = tally.accepted(DoublePendulum::new(any.number(), upper, lower)) {
        let [one, two, three, four] = [0; 4].map(|_| any.number());
        tally.accepted(double.start([one, two], [three, four]));
        let state = DoublePhase { theta1: one, theta2: two, p1: three, p2: four };
        double.energy(state);
        integrate(&double, &Gauss6, state, &Grid::new(any.positive(), 3).unwrap_or(grid), &mut ());
    }
}

// -------------------------------------------------------------------------------------------------
// Dynamics
// -------------------------------------------------------------------------------------------------

fn dynamics(any: &mut Any, tally: &mut Tally) {
    tally.computed += 1;
    // A change of sign at any place in any bracket is found to the last bit.
    let (low, high, zero) = (any.number(), any.number(), any.number());
    let [below, above] = [-any.positive(), any.positive()];
    let found = root(|x| Some(if x < zero { below } else { above }), low, high);
    let (first, last) = (low.min(high), low.max(high));
    if first < zero && zero <= last && first.is_finite() && last.is_finite() {
        let found = found.unwrap();
        let beside = found == zero || found == zero.next_down();
        let narrow = (found - zero).abs() <= 4.0 * f64::EPSILON * zero.abs();
        assert!(beside || narrow, "{low:e} {high:e}: {found:e} for {zero:e}");
    }
    let mut random = any.0.clone();
    root(|_| Some(f64::from_bits(random.bits())), low, high);
    let third = |x: f64| Some(x * x * x - zero);
    root(third, low, high);

    if let Some(watch) = tally.accepted(Watch::new(1, any.0.below(4) as u32, any.0.below(3) as u32))
    {
        let driven = Driven::taylor(any.0.between(0.0, 2.0)).unwrap();
        let strobe = Stroboscope::new(&driven, &Rk4, 1.0, 20).unwrap();
        let start = Phase { theta: any.0.between(-3.0, 3.0), omega: 0.0 };
        let exponent = largest_exponent(&strobe, start, watch);
        assert!(exponent.value.is_finite() && exponent.error.is_finite(), "{watch:?} {exponent:?}");
    }
    let driven = Driven::taylor(any.0.between(0.0, 2.0)).unwrap();
    let steps = any.0.below(8) as u64;
    let Some(strobe) = tally.accepted(Stroboscope::new(&driven, &Rk4, any.number(), steps)) else {
        return;
    };
    assert!(strobe.period() > 0.0 && strobe.period().is_finite());
    let (point, periods) = (any.phase(), any.0.below(3) as u32);
    strobe.map(point);
    let (_, matrix) = monodromy(&strobe, point, periods);
    matrix.largest_modulus();
    if let Some(orbit) = periodic_orbit(&strobe, point, periods) {
        assert!(is_finite(orbit.point));
    }
    let paces = any.0.below(4) as u32;
    let doubled = period_doubling(
        |parameter, point| {
            let unit = Phase { theta: parameter, omega: 0.0 };
            let monodromy = Monodromy { of_theta: unit, of_omega: point };
            Some(PeriodicOrbit { point, periods, monodromy })
        },
        point,
        (low, high),
        paces,
    );
    assert!(doubled.is_none_or(|at| !at.is_nan()));
}

// -------------------------------------------------------------------------------------------------
// Arithmetic
// -------------------------------------------------------------------------------------------------

fn arithmetic(any: &mut Any, tally: &mut Tally) {
    tally.computed += 1;
    for _ in 0..20 {
        let x = any.number();
        for value in [sin(x), cos(x)] {
            assert!(value.abs() <= 1.0 || (!x.is_finite() && value.is_nan()), "{x:e}: {value:e}");
        }
        let [a, b] = [DoubleDouble::new(x), DoubleDouble::new(any.number())];
        let _ = (a + b, a - b, a * b, a / b, a.squared(), a.scaled(0.5));
        if x >= 0.0 {
            a.sqrt();
        }
    }
}

// -------------------------------------------------------------------------------------------------
// The judge
// -------------------------------------------------------------------------------------------------

/// A stranger that answers with garbage: any states, as many as asked for or not; or with those of
/// a method, now and then spoilt.
struct Garbage {
    random: std::cell::RefCell<Random>,
    spoils: usize,
    counts: bool,
}

impl Stranger for Garbage {
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        let mut any = Any(self.random.borrow_mut().clone());
        self.random.borrow_mut().bits();
        let evaluations = self.counts.then(|| any.0.bits() >> any.0.below(64));
        let states = request.states() as usize;
        if self.spoils > 0 {
            let mut reply = StormerVerlet.answer(request)?;
            if any.0.below(self.spoils) == 0 && states > 0 {
                let at = any.0.below(states);
                reply.states[at] = any.phase();
            }
            return Ok(reply);
        }
        match any.0.below(60) {
            0 => Err(Fault::Unsupported),
            1 => Err(Fault::Refused("no".to_string())),
            2 => Err(Fault::Broken("nonsense".to_string())),
            3 => Ok(Reply { states: vec![], evaluations }),
            4 => Ok(Reply { states: any.phases(states + 1), evaluations }),
            _ => Ok(Reply { states: any.phases(states), evaluations }),
        }
    }

    fn longest_run(&self) -> u64 {
        2000
    }
}

fn a_stranger(any: &mut Any, tally: &mut Tally) {
    let garbage = Garbage {
        random: std::cell::RefCell::new(any.0.clone()),
        spoils: any.0.one_of(&[0, 0, 3, 30]),
        counts: any.0.below(2) == 0,
    };
    let claims = Claims::order(any.0.below(20) as u32).symplectic().symmetric();
    match try_judge(&garbage, &claims) {
        Ok(report) => {
            tally.computed += 1;
            // It is written out, whatever was measured.
            assert!(!report.to_string().is_empty() && !report.findings.is_empty());
        }
        Err(fault) => {
            tally.refused += 1;
            assert!(!fault.is_empty());
        }
    }
}
