//! What a method does beside its kicks and drifts: the change of variables of the processed ones,
//! Deuflhard's rotation, and the times at which each asks for the force.

use std::cell::Cell;
use std::f64::consts::PI;

use pendula::internals::processed::{processed_4, processed_6};
use pendula::methods::{
    BlanesMoan6, Deuflhard, PositionVerlet, Processed4, Processed6, StormerVerlet,
};
use pendula::systems::{
    ForceGradient, LARGEST_ANGLE, LinearOscillator, NearlyLinear, Processor, RateOf,
};
use pendula::{Grid, Method, Pendulum, Phase, Separable, System, integrate};

/// Free flight with the velocity 1 from θ = t: wherever the force is asked for, the angle is the
/// time.
#[derive(Default)]
struct Flight {
    asked: Cell<u32>,
    largest: Cell<f64>,
}

impl System for Flight {
    type State = Phase;

    fn rate(&self, _t: f64, z: Phase) -> Phase {
        Phase { theta: z.omega, omega: 0.0 }
    }
}

impl Separable for Flight {
    type Force = f64;

    fn force(&self, t: f64, z: Phase) -> f64 {
        self.asked.set(self.asked.get() + 1);
        self.largest.set(self.largest.get().max((t - z.theta).abs()));
        0.0
    }

    fn kick(&self, z: Phase, _force: f64, _h: f64) -> Phase {
        z
    }

    fn drift(&self, z: Phase, h: f64) -> Phase {
        Phase { theta: z.theta + h * z.omega, ..z }
    }
}

impl ForceGradient for Flight {
    fn force_with_gradient(&self, t: f64, z: Phase, _c: f64) -> f64 {
        self.force(t, z)
    }

    fn processing(&self, _z: Phase, _by: &Processor) -> RateOf<Self> {
        Phase::default()
    }

    fn unprocessing(&self, _z: Phase, _by: &Processor) -> RateOf<Self> {
        Phase::default()
    }
}

/// Catches: a force asked for at the time of another kick, which nothing shows where the force does
/// not depend on the time.
#[test]
fn the_force_is_asked_for_where_the_drifts_are() {
    fn check<M: Method<Flight>>(method: &M) {
        let flight = Flight::default();
        let start = Phase { theta: 0.0, omega: 1.0 };
        integrate(&flight, method, start, &Grid::new(0.7, 3).unwrap());
        // A dozen drifts in each of three steps, rounded once each, of numbers below 3.
        assert!(flight.largest.get() < 36.0 * 2.0 * f64::EPSILON, "{:e}", flight.largest.get());
        assert!(flight.asked.get() >= 3);
    }
    check(&Processed4);
    check(&Processed6);
    check(&StormerVerlet);
    check(&PositionVerlet);
    check(&BlanesMoan6);
}

/// With a step of 0.3 s, h² g/L = 0.9, from −3 to 3 rad and at up to ±18 rad/s: there and back is
/// the start, to two roundings of 18 and some of what is added.
///
/// Catches: an iteration that is stopped too early; a term that only one of the two directions has.
#[test]
fn a_change_of_variables_leads_back() {
    for processor in [processed_4::PROCESSOR, processed_6::PROCESSOR].map(|by| by.over(0.3)) {
        let mut largest = 0.0_f64;
        for i in 0..61 * 25 {
            let [a, b] = [f64::from(i % 61), f64::from(i / 61)];
            let z = Phase { theta: 0.1 * a - 3.0, omega: 1.5 * b - 18.0 };
            let kernel = z + Pendulum::PAPER.unprocessing(z, &processor);
            let back = kernel + Pendulum::PAPER.processing(kernel, &processor);
            largest = largest.max((back.theta - z.theta).abs()).max((back.omega - z.omega).abs());
        }
        assert!(largest < 1e-14, "{largest:e}");
    }
}

/// The kick is tan(x/2)/ω₀ for steps up to x = ω₀h = 3; beyond, next to the pole at π, it would be
/// longer than any number of steps, and is half a step.
///
/// Catches: a bound that lets the pole in, or leaves out steps that rotate; the whole step for half
/// of it.
#[test]
fn deuflhards_rotation_ends_before_the_pole() {
    let pendulum = Pendulum::new(9.0, 1.0, 1.0).unwrap();
    let kick = |x: f64| Deuflhard.start(&pendulum, 0.0, x / 3.0, Phase::at_rest(0.5)).kick;
    for x in [0.1_f64, 1.0, 2.9, 2.999] {
        let expected = (0.5 * x).tan() / 3.0;
        assert!((kick(x) / expected - 1.0).abs() < 1e-13, "{x}: {}", kick(x));
    }
    for x in [3.001, 3.1, 3.2, 5.9, 6.1, 9.0] {
        assert!((kick(x) / (0.5 * x / 3.0) - 1.0).abs() < 1e-15, "{x}: {}", kick(x));
    }
}

/// Catches: an angle beyond all that is reduced, whose remainder may be any number, and with it the
/// force.
#[test]
fn the_linear_force_is_that_of_half_a_turn_at_most() {
    let pendulum = Pendulum::PAPER;
    for theta in [0.0, 1.0, -3.0, 4.0, LARGEST_ANGLE, 1e16, -3e17, 1e20, 1e300] {
        let force = pendulum.linear_force(Phase::at_rest(theta));
        let bound = pendulum.frequency_squared() * PI;
        assert!(force.abs() <= bound, "{theta}: {force}");
    }
    let oscillator = LinearOscillator::new(Pendulum::new(4.0, 1.0, 1.0).unwrap());
    assert_eq!(oscillator.linear_force(Phase::at_rest(5.0)), -20.0);
}
