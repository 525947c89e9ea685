//! Steps of a density that is a variable with a rate of its own, on the pendulum: what such steps
//! are. What they are good for stands in the repository's `tests/systems/symmetric_steps.rs`.

use pendula::adaptive::SymmetricSteps;
use pendula::methods::StormerVerlet;
use pendula::{Counting, Error, Grid, Pendulum, Phase, Separable, Shaken, integrate};

use crate::common::pendulum;

const START: Phase = Phase::at_rest(2.0);

/// For steps proportional to 1/√(ω² + ω₀²): long where the motion is slow, short where it is fast.
fn of_speed(pendulum: &Pendulum) -> impl Fn(Phase) -> f64 + Copy + use<'_> {
    move |z| z.omega * pendulum.force(0.0, z) / (z.omega * z.omega + pendulum.frequency_squared())
}

/// With a constant density each step is Störmer–Verlet's, which merges the two half kicks between
/// drifts into one and so rounds differently; with a shaken pivot, each with the force at its own
/// two ends. 1000 steps with a rounding of an ε or two each, none of which grows by more than the
/// duration of the swing: 1e-11.
///
/// Catches: a kick or a drift by ε and not by ε/ρ, or by half of it; a stale force, or one at
/// another time than that of the step's end; time that is not the sum of the steps.
#[test]
fn with_a_constant_density_it_is_stormer_verlet() {
    let shaken = Shaken::new(pendulum(), 0.3, 7.0).unwrap();
    let start = Phase { theta: 1.0, omega: 0.4 };
    let grid = Grid::new(0.01, 1000).unwrap();
    let end = integrate(&shaken, &StormerVerlet, start, &grid);
    let mut steps = SymmetricSteps::new(&shaken, start, 0.01, |_| 0.0).unwrap();
    let sample = steps.nth(999).unwrap().unwrap();
    assert_eq!(sample, steps.sample());
    assert_eq!(sample.density, 1.0);
    assert!((sample.t - 10.0).abs() < 1e-11, "{}", sample.t);
    let off = sample.z + end * -1.0;
    assert!(off.theta.abs() < 1e-11 && off.omega.abs() < 1e-11, "{off:?}");
}

/// 100 s forward, 100 back. Only rounding keeps the bob from returning to the start exactly: 4000
/// steps each way, with an ε each of numbers up to ω = 2ω₀ sin 1 = 3.3. As an error of the energy
/// shifts the bob along its path for all the time that is left, that is 4000 · 8000 · ε · 3.3 · h
/// at worst, with steps of 0.025 s: 6e-10.
///
/// Catches: a density updated from the past alone, or by a whole ε on one side; a way back that
/// differs from the way there.
#[test]
fn the_way_back_is_the_way_there() {
    let pendulum = pendulum();
    let density_rate = of_speed(&pendulum);
    let mut there = SymmetricSteps::new(&pendulum, START, 0.036, density_rate).unwrap();
    let far = there.by_ref().nth(3999).unwrap().unwrap();
    assert!((90.0..110.0).contains(&far.t), "{} s", far.t);
    let mut back = there.turned_back();
    let start = back.nth(3999).unwrap().unwrap();
    let off = start.z + START * -1.0;
    let off = [off.theta, off.omega, start.t, start.density - 1.0];
    let largest = off.into_iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
    assert!(largest < 6e-10, "{largest:e}");
}

/// Catches: a force evaluated twice a step.
#[test]
fn it_takes_one_evaluation_a_step() {
    let counting = Counting::new(pendulum());
    let mut steps = SymmetricSteps::new(&counting, START, 0.01, |_| 0.3).unwrap();
    assert!(steps.nth(99).unwrap().is_ok());
    assert_eq!(counting.evaluations(), 101);
}

/// Catches: an accepted first step that is not finite and positive; an accepted density that is
/// NaN, or below zero, with which time would run backward.
#[test]
fn what_has_no_step_is_refused() {
    let pendulum = pendulum();
    for bad in [0.0, -0.01, f64::NAN, f64::INFINITY] {
        let refused = SymmetricSteps::new(&pendulum, START, bad, of_speed(&pendulum));
        assert!(matches!(refused.err(), Some(Error::Parameter { .. })), "{bad}");
    }
    for rate in [-1000.0, f64::NAN] {
        let mut steps = SymmetricSteps::new(&pendulum, START, 0.01, move |_| rate).unwrap();
        let error = steps.next().unwrap().unwrap_err();
        assert!(
            matches!(error, Error::Parameter { name: "density ρ of the steps", .. }),
            "{error}"
        );
        assert!(steps.next().is_none(), "it has ended");
    }
}

/// Catches: an iterator that stays failed after its direction has been reversed.
#[test]
fn there_is_a_way_back_from_where_none_leads_on() {
    // ρ falls from 1 by half of ε |G|, which is 0.3, twice a step; the third step would begin with
    // ρ below zero.
    let pendulum = pendulum();
    let mut steps = SymmetricSteps::new(&pendulum, START, 0.002, |_| -300.0).unwrap();
    assert!(steps.by_ref().take(2).all(|step| step.is_ok()));
    assert!(steps.next().unwrap().is_err() && steps.next().is_none());
    let mut back = steps.turned_back();
    assert!(back.next().is_some_and(|step| step.is_ok()));
}
