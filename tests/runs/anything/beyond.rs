//! Adaptive steps, other systems, and the arithmetic below.

use pendula::adaptive::{Adaptive, Controlled, Direction, SymmetricSteps, TaylorSeries, Tolerance};
use pendula::arithmetic::sine::{cos, sin};
use pendula::internals::double_double::DoubleDouble;
use pendula::methods::{Dop853, DormandPrince, Gauss6, Rk4, StormerVerlet};
use pendula::systems::{DoublePendulum, DoublePhase, Joint, Shaken};
use pendula::{
    Damped, Driven, Grid, Hamiltonian, LinearOscillator, Pendulum, Phase, Separable, integrate,
};

use super::*;

// -------------------------------------------------------------------------------------------------
// Adaptive steps
// -------------------------------------------------------------------------------------------------

pub fn adaptive_steps(any: &mut Any, tally: &mut Tally) {
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

pub fn variable_steps(any: &mut Any, tally: &mut Tally) {
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

pub fn systems_beyond(any: &mut Any, tally: &mut Tally) {
    let pendulum = any.pendulum();
    let grid = any.grid(&pendulum, 5);
    let (z, t) = (any.phase(), any.number());
    let damped = tally.accepted(Damped::new(pendulum, any.number()));
    if let Some(damped) = damped {
        assert!((2.0 * damped.damping()).is_finite());
        damped.power(z);
        damped.kick(z, any.number(), any.number());
        integrate(&damped, &StormerVerlet, z, &grid);
    }
    let damped = damped.unwrap_or_else(|| Damped::new(pendulum, 0.0).unwrap());
    if let Some(driven) = tally.accepted(Driven::new(damped, any.number(), any.number())) {
        assert!(driven.period().is_finite() && driven.period() > 0.0, "{driven:?}");
        integrate(&driven, &Rk4, z, &grid);
    }
    if let Some(shaken) = tally.accepted(Shaken::new(pendulum, any.number(), any.number())) {
        let mathieu = shaken.mathieu();
        assert!(mathieu.a.is_finite() && mathieu.a <= 0.0, "{shaken:?} {mathieu:?}");
        assert!(mathieu.q.is_finite() && mathieu.q >= 0.0, "{shaken:?} {mathieu:?}");
        assert!(shaken.period().is_finite() && shaken.period() > 0.0, "{shaken:?}");
        integrate(&shaken, &Gauss6, z, &grid);
    }
    let linear = LinearOscillator::new(pendulum);
    let exact = linear.exact(z, 0.0);
    let small = z.theta.abs() < 1e150 && z.omega.abs() < 1e150;
    assert!(!small || exact == z, "{pendulum:?} {z:?}: {exact:?}");
    linear.exact(z, t);

    let mut joint = || Joint { length: any.number(), mass: any.number() };
    let (upper, lower) = (joint(), joint());
    if let Some(double) = tally.accepted(DoublePendulum::new(any.number(), upper, lower)) {
        let [one, two, three, four] = [0; 4].map(|_| any.number());
        tally.accepted(double.start([one, two], [three, four]));
        let state = DoublePhase { theta1: one, theta2: two, p1: three, p2: four };
        double.energy(state);
        integrate(&double, &Gauss6, state, &Grid::new(any.positive(), 3).unwrap_or(grid));
    }
}

// -------------------------------------------------------------------------------------------------
// Arithmetic
// -------------------------------------------------------------------------------------------------

pub fn arithmetic(any: &mut Any, tally: &mut Tally) {
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
