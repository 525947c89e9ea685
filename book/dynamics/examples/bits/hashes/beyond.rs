//! Systems beyond the pendulum, steps that vary, and the dynamics of a driven pendulum.

use std::f64::consts::PI;

use pendula::adaptive::{Adaptive, Controlled, Direction, SymmetricSteps, TaylorSeries, Tolerance};
use pendula::methods::{BlanesMoan6, Dop853, DormandPrince, Gauss4};
use pendula::systems::Joint;
use pendula::{
    Components, Damped, DoublePendulum, Driven, Error, Grid, LinearOscillator, Method, Pendulum,
    Phase, Rk4, Separable, Shaken, StormerVerlet, System, integrate_with,
};
use pendula_dynamics::kepler::{Ellipse, Kepler, PlanePhase};
use pendula_dynamics::lyapunov::Watch;
use pendula_dynamics::{
    Stroboscope, largest_exponent, mode_shapes, normal_modes, period_doubling, periodic_orbit,
};

use super::Hash;

/// Adds every state of `steps` steps to `hash`.
fn run<S, M>(hash: &mut Hash, system: &S, method: &M, start: S::State, (step, steps): (f64, u64))
where
    S: System<State: Components>,
    M: Method<S>,
{
    let grid = Grid::new(step, steps).expect("a positive step");
    integrate_with(system, method, start, &grid, &mut |_: u64, _: f64, z| hash.add_state(z));
}

/// With an explicit Runge–Kutta method and an implicit one.
fn of_system<S>(system: &S, start: S::State, along: (f64, u64)) -> Hash
where
    S: System<State: Components>,
    Rk4: Method<S>,
    Gauss4: Method<S>,
{
    let mut hash = Hash::new();
    run(&mut hash, system, &Rk4, start, along);
    run(&mut hash, system, &Gauss4, start, along);
    hash
}

/// And with splitting methods.
fn of_separable<S>(system: &S, start: S::State, along: (f64, u64)) -> u64
where
    S: Separable<State: Components>,
    Rk4: Method<S>,
    Gauss4: Method<S>,
    StormerVerlet: Method<S>,
    BlanesMoan6: Method<S>,
{
    let mut hash = of_system(system, start, along);
    run(&mut hash, system, &StormerVerlet, start, along);
    run(&mut hash, system, &BlanesMoan6, start, along);
    hash.value()
}

/// Steps in a period of the drive.
const STEPS: u64 = 100;

const START: Phase = Phase { theta: 2.5, omega: -0.7 };
const ALONG: (f64, u64) = (0.01, 5_000);

fn pendulum() -> Result<Pendulum, Error> {
    Pendulum::new(9.81, 1.3, 0.7)
}

fn damped() -> Result<Damped, Error> {
    Damped::new(pendulum()?, 0.05)
}

fn double_pendulum() -> Result<u64, Error> {
    let (upper, lower) = (Joint { length: 1.3, mass: 0.7 }, Joint { length: 0.8, mass: 1.1 });
    let double = DoublePendulum::new(9.81, upper, lower)?;
    let start = double.start([2.0, 2.5], [0.3, -0.2])?;
    let mut hash = of_system(&double, start, ALONG);
    hash.add_all(normal_modes(&double));
    hash.add_all(mode_shapes(&double));
    Ok(hash.value())
}

fn kepler() -> Result<u64, Error> {
    let centre = Kepler::new(1.7)?;
    let ellipse = Ellipse::new(&centre, 1.2, 0.6)?;
    let mut hash = Hash::new();
    hash.word(of_separable(&centre, ellipse.at(0.0), ALONG));
    (-1000..1000).for_each(|n| hash.add_state(ellipse.at(0.037 * f64::from(n))));
    Ok(hash.value())
}

/// The steps of a walk with their dense output, the crossings of another, and what both cost.
fn adaptive<M: Controlled<Pendulum>>(method: M) -> Result<u64, Error> {
    let pendulum = pendulum()?;
    let mut hash = Hash::new();
    for tolerance in [1e-6, 1e-11] {
        let adaptive = Adaptive::new(method, Tolerance::uniform(tolerance)?);
        let mut walk = adaptive.steps(&pendulum, START, 0.0, 50.0)?;
        while let Some(step) = walk.next() {
            let step = step?;
            hash.add_all([step.end_time(), step.size()]);
            hash.add_state(step.end());
            let dense = walk.dense(&step);
            hash.add_state(dense.after(0.3));
        }
        let mut crossing = adaptive.steps(&pendulum, START, 0.0, 50.0)?;
        for crossing in crossing.crossings(Direction::Either, |_, z| z.theta) {
            let crossing = crossing?;
            hash.add(crossing.t);
            hash.add_state(crossing.z);
        }
        for counts in [walk.counts(), crossing.counts()] {
            for count in [counts.accepted, counts.rejected, counts.evaluations] {
                hash.word(count);
            }
        }
    }
    Ok(hash.value())
}

/// Steps of Störmer–Verlet that are shorter near the centre.
fn symmetric_steps() -> Result<u64, Error> {
    let centre = Kepler::new(1.7)?;
    let start = Ellipse::new(&centre, 1.2, 0.6)?.at(0.0);
    let density_rate = |z: PlanePhase| -1.5 * (z.x * z.vx + z.y * z.vy) / (z.x * z.x + z.y * z.y);
    let mut hash = Hash::new();
    for sample in SymmetricSteps::new(&centre, start, 0.01, density_rate)?.take(5_000) {
        let sample = sample?;
        hash.add_all([sample.t, sample.density]);
        hash.add_state(sample.z);
    }
    Ok(hash.value())
}

/// Where Taylor's driven pendulum is after a hundred periods.
fn settled(strength: f64) -> Result<Phase, Error> {
    let driven = Driven::taylor(strength)?;
    let strobe = Stroboscope::new(&driven, &Rk4, driven.period(), STEPS)?;
    Ok((0..100).fold(Phase::at_rest(-PI / 2.0), |z, _| strobe.map(z)))
}

/// The first orbit of Taylor's driven pendulum, its multipliers, where it doubles its period, and
/// how fast neighbours separate beyond.
fn dynamics() -> Result<u64, Error> {
    let mut hash = Hash::new();
    let orbit = |strength: f64, near: Phase| {
        let driven = Driven::taylor(strength).ok()?;
        let strobe = Stroboscope::new(&driven, &Rk4, driven.period(), STEPS).ok()?;
        periodic_orbit(&strobe, near, 1)
    };
    let first = orbit(1.06, settled(1.06)?).expect("an orbit");
    hash.add_state(first.point);
    hash.add_state(first.monodromy.of_theta);
    hash.add_state(first.monodromy.of_omega);
    hash.add_all([first.monodromy.determinant(), first.monodromy.largest_modulus()]);
    let doubling = period_doubling(orbit, first.point, (1.06, 1.07), 4);
    hash.add(doubling.expect("a doubling"));
    let driven = Driven::taylor(1.105)?;
    let strobe = Stroboscope::new(&driven, &Rk4, driven.period(), STEPS)?;
    let watch = Watch::new(20, 10, 10).expect("ten blocks of ten periods");
    let exponent = largest_exponent(&strobe, Phase::at_rest(-1.5), watch);
    hash.add_all([exponent.value, exponent.error]);
    Ok(hash.value())
}

/// A line for each.
fn all() -> Result<[(&'static str, u64); 11], Error> {
    let shaken = Shaken::new(pendulum()?, 0.12, 70.0)?;
    let driven = Driven::new(damped()?, 0.9, 2.1)?;
    let linear = LinearOscillator::new(pendulum()?);
    Ok([
        ("linear oscillator", of_separable(&linear, START, ALONG)),
        ("damped pendulum", of_separable(&damped()?, START, ALONG)),
        ("driven pendulum", of_separable(&driven, START, ALONG)),
        ("shaken pendulum", of_separable(&shaken, START, (0.001, 20_000))),
        ("double pendulum", double_pendulum()?),
        ("Kepler's problem", kepler()?),
        ("adaptive dormand-prince", adaptive(DormandPrince)?),
        ("adaptive dop853", adaptive(Dop853)?),
        ("adaptive taylor-series", adaptive(TaylorSeries)?),
        ("symmetric steps", symmetric_steps()?),
        ("periodic orbits and chaos", dynamics()?),
    ])
}

/// A line for each.
pub fn lines() -> [(&'static str, u64); 11] {
    all().expect("parameters in range")
}
