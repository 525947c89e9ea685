//! How far off a single step may be, in tolerances: a search at random, and where the powers of a
//! series vanish.
//!
//! The error of a step is known only by an estimate, and an estimate may vanish by chance. So no
//! bound can be derived for every system; what is found here stands in the documentation of each
//! method.

use std::fmt::Debug;

use pendula::integrate::Method;
use pendula::internals::order;
use pendula::systems::{Analytic, Components, Joint, Vector};
use pendula::{Damped, DoublePendulum, Driven, LinearOscillator, Shaken};

use super::*;
use crate::taylor_series::WithoutMajorant;

/// The largest error of the steps that were looked at.
#[derive(Debug, Default)]
struct Search {
    steps: u64,
    /// In tolerances.
    largest: f64,
    /// The step that has it.
    which: String,
}

impl Search {
    /// Looks at up to 50 steps from a state at a time (s) for `span` (s), each compared with the
    /// motion from its own start, by DOP853 in equal parts.
    fn walk<S, M>(&mut self, system: &S, method: M, tol: f64, from: (f64, S::State), span: f64)
    where
        S: System<State: Components<Displacement = S::State> + Vector + Debug>,
        M: Controlled<S>,
    {
        let parts = |t: f64, h: f64, start: S::State, parts: u32| {
            let part = h / f64::from(parts);
            (0..parts)
                .fold(start, |z, n| Dop853.step(system, t + f64::from(n) * part, part, z, &mut ()))
        };
        self.compare(system, method, tol, from, span, |t, h, start, end| {
            // What a step of a 16th is off by is 10⁻⁹ of what DOP853's step is off by; where the
            // motion is rough, a 100th decides.
            let right = parts(t, h, start, 16);
            let off = tolerance(tol).error_norm(start, end, end + right * -1.0);
            if off < 0.3 { right } else { parts(t, h, start, 100) }
        });
    }

    /// The pendulum by the series, in steps from its majorant and in steps that are read off the
    /// powers, compared with the closed form.
    fn series(&mut self, pendulum: &Pendulum, tol: f64, start: Phase, span: f64) {
        let (hidden, from) = (WithoutMajorant(pendulum), (0.0, start));
        let exact = |_, h, start, _| Motion::new(pendulum, start).unwrap().at(h);
        self.compare(pendulum, TaylorSeries, tol, from, span, exact);
        self.compare(&hidden, TaylorSeries, tol, from, span, exact);
    }

    /// The same with the state to which `right` leads from a time, in a time, from a state; it is
    /// told where the step ends, too.
    fn compare<S, M>(
        &mut self,
        system: &S,
        method: M,
        tol: f64,
        (t, start): (f64, S::State),
        span: f64,
        right: impl Fn(f64, f64, S::State, S::State) -> S::State,
    ) where
        S: System<State: Components<Displacement = S::State> + Vector + Debug>,
        M: Controlled<S>,
    {
        let tolerance = tolerance(tol);
        let walk = Adaptive::new(method, tolerance).steps(system, start, t, t + span).unwrap();
        for step in walk.take(50) {
            let step = step.unwrap();
            let right = right(step.start_time(), step.size(), step.start(), step.end());
            let off = tolerance.error_norm(step.start(), step.end(), step.end() + right * -1.0);
            self.steps += 1;
            if off > self.largest || off.is_nan() {
                self.largest = off;
                self.which = format!("{tol:e}, {} s from {:?}", step.size(), step.start());
            }
        }
    }
}

/// e to a number between the logarithms of `low` and `high`.
fn any_scale(random: &mut Random, low: f64, high: f64) -> f64 {
    random.between(low.ln(), high.ln()).exp()
}

/// A start at rest, at the bottom, at the top or beside it, or anywhere, of a pendulum with this
/// frequency (1/s): where the motion is even or odd in time every second power vanishes.
fn any_start(random: &mut Random, frequency: f64) -> Phase {
    let anywhere = random.between(-3.2, 3.2);
    let (theta, omega) = match random.below(6) {
        0 => (random.between(0.0, PI), 0.0),
        1 => (0.0, random.between(0.0, 5.0)),
        2 => (PI, any_scale(random, 1e-6, 5.0)),
        3 => (PI - any_scale(random, 1e-17, 1.0), 0.0),
        4 => (anywhere, any_scale(random, 1e-6, 10.0)),
        _ => (anywhere, random.between(-4.0, 4.0)),
    };
    Phase { theta, omega: frequency * omega }
}

fn any_pendulum(random: &mut Random) -> (Pendulum, f64) {
    let pendulum = Pendulum::new(any_scale(random, 0.1, 1000.0), 1.0, 1.0).unwrap();
    (pendulum, pendulum.small_angle_frequency())
}

/// Walks of the embedded `method` on random systems: the pendulum, damped, driven, shaken or with a
/// second one on it, and the linear oscillator.
fn of_pair<M: Embedded>(method: M, walks: u32, seed: u64) -> Search {
    let (random, mut search) = (&mut Random::new(seed), Search::default());
    for _ in 0..walks {
        let (pendulum, frequency) = any_pendulum(random);
        let start = any_start(random, frequency);
        let (t, tol) = (random.between(-10.0, 10.0), any_scale(random, 1e-12, 1e-2));
        let span = random.between(1.0, 20.0) / frequency;
        let share = any_scale(random, 1e-3, 1.0);
        match random.below(6) {
            0 => search.walk(&pendulum, method, tol, (t, start), span),
            1 => {
                let damped = Damped::new(pendulum, 10.0 * frequency * share).unwrap();
                search.walk(&damped, method, tol, (t, start), span);
            }
            2 => {
                let driven = Driven::taylor_damped(2.0 * share, 0.5).unwrap();
                search.walk(&driven, method, tol, (t, start), span);
            }
            3 => {
                let faster = frequency * any_scale(random, 0.1, 100.0);
                let shaken = Shaken::new(pendulum, share, faster).unwrap();
                search.walk(&shaken, method, tol, (t, start), span);
            }
            4 => {
                let mut joint = || Joint {
                    length: any_scale(random, 0.1, 10.0),
                    mass: any_scale(random, 0.1, 10.0),
                };
                let double = DoublePendulum::new(9.81, joint(), joint()).unwrap();
                let mut pair = |most: f64| [(); 2].map(|()| random.between(-most, most));
                let (angles, speeds) = (pair(3.2), pair(5.0));
                let start = double.start(angles, speeds).unwrap();
                search.walk(&double, method, tol, (t, start), span.min(10.0));
            }
            _ => {
                let linear = LinearOscillator::new(pendulum);
                search.walk(&linear, method, tol, (t, start), span);
            }
        }
    }
    search
}

/// Walks of the series on the systems that have one.
fn of_series(walks: u32, seed: u64) -> Search {
    let (random, mut search) = (&mut Random::new(seed), Search::default());
    for n in 0..walks {
        let (pendulum, frequency) = any_pendulum(random);
        let start = any_start(random, frequency);
        let (tol, span) = (any_scale(random, 1e-12, 0.99), random.between(1.0, 40.0) / frequency);
        if n % 8 == 0 {
            let linear = LinearOscillator::new(pendulum);
            search.walk(&linear, TaylorSeries, tol, (0.0, start), span);
        } else {
            search.series(&pendulum, tol, start, span);
        }
    }
    search
}

/// The first steps from starts at rest, at the bottom and at the top at which one of the last six
/// powers of the angle vanishes, found by halving between `looks` starts; for each order.
fn of_vanishing_powers(looks: u32) -> Search {
    let mut search = Search::default();
    let pendulum = Pendulum::PAPER;
    let frequency = pendulum.small_angle_frequency();
    let lines = [
        |x: f64, _: f64| Phase::at_rest(PI * x),
        |x: f64, frequency: f64| Phase { theta: 0.0, omega: 6.0 * frequency * x },
        |x: f64, frequency: f64| Phase { theta: PI, omega: 4.0 * frequency * x },
    ];
    for tol in [0.5, 1e-2, 1e-3, 1e-5, 1e-6, 1e-8, 1e-10, 1e-12, 1e-13] {
        let order = order(&tolerance(tol));
        for (line, back) in lines.iter().flat_map(|line| (0..order.min(6)).map(move |i| (line, i)))
        {
            let start = |x: f64| line(x, frequency);
            let power = |x: f64| pendulum.terms::<36>(0.1, start(x))[order - back - 1].theta;
            for n in 0..looks {
                let [mut low, mut high] = [n, n + 1].map(|n| f64::from(n) / f64::from(looks));
                let sign = power(low).signum();
                if power(high) * sign >= 0.0 {
                    continue;
                }
                for _ in 0..60 {
                    let middle = 0.5 * (low + high);
                    if power(middle) * sign > 0.0 { low = middle } else { high = middle }
                }
                search.series(&pendulum, tol, start(low), 3.0);
            }
        }
    }
    search
}

/// Above the largest errors of a step, in tolerances, that the million found: 3225 and 127, of the
/// series 1.46. See the documentation of the methods for the reasons.
const DORMAND_PRINCE: f64 = 4000.0;
const DOP853: f64 = 160.0;
const SERIES: f64 = 2.0;

/// The sequence for DOP853 has a step on which the first of its differences of order 5 vanishes.
///
/// Catches: an estimate that vanishes where another one would not, as that of dop853.f does (1869
/// tolerances).
#[test]
fn a_step_of_a_pair_is_seldom_off_by_more() {
    let search = of_pair(DormandPrince, 500, 1);
    assert!(search.largest < DORMAND_PRINCE && search.steps > 15_000, "{search:?}");
    let search = of_pair(Dop853, 300, 105);
    assert!(search.largest < DOP853 && search.steps > 8_000, "{search:?}");
}

/// Catches: a step chosen from two powers, which from rest are one number and may both vanish (10¹²
/// tolerances); powers that grow although each is below a tolerance (51 000, beside the top).
#[test]
fn a_step_of_the_series_keeps_its_tolerance() {
    let search = of_series(2000, 3);
    assert!(search.largest < SERIES && search.steps > 15_000, "{search:?}");
    let search = of_vanishing_powers(100);
    assert!(search.largest < SERIES && search.steps > 4_000, "{search:?}");
}

/// Over a million steps of each, which take some minutes:
///
/// ```text
/// cargo test --test runs -- --ignored --nocapture a_million_steps
/// ```
///
/// Catches: the same, where it is rare.
#[test]
#[ignore = "takes minutes: the comment above has the command"]
fn a_million_steps_keep_their_bounds() {
    const MILLION: u64 = 1_000_000;
    for (name, search, bound, steps) in [
        ("Dormand-Prince", of_pair(DormandPrince, 40_000, 11), DORMAND_PRINCE, MILLION),
        ("DOP853", of_pair(Dop853, 60_000, 12), DOP853, MILLION),
        ("series", of_series(150_000, 13), SERIES, MILLION),
        ("series, where a power vanishes", of_vanishing_powers(20_000), SERIES, 4_000),
    ] {
        println!("{name}: {search:?}");
        assert!(search.largest < bound && search.steps > steps, "{name}: {search:?}");
    }
}
