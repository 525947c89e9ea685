//! Questions of "Choosing an integrator".

use pendula::{Grid, Pendulum, method_named};

use super::{Compute, Truth, Within};
use crate::experiments::choosing::{Release, THETA_0, profile_of};

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] = &[("choosing-day", day), ("choosing-longer", longer)];

/// The error (rad) of a method's angle after so many periods, in so many steps each: e = Cνᵃhᵖ.
struct Law {
    steps: f64,
    periods: f64,
    error: f64,
    growth: f64,
    order: f64,
}

impl Law {
    /// From runs of 64 and of 128 periods, and one of 128 with twice the steps.
    fn measure(name: &str, steps: u64) -> Self {
        const PERIODS: u64 = 128;
        let method = method_named(name).expect("a method of the library");
        let Release { start, period, .. } = Release::new(THETA_0);
        let error = |steps: u64, periods: u64| {
            let grid = Grid::new(period / steps as f64, periods * steps).expect("a positive step");
            (method.end(&Pendulum::PAPER, start, &grid).theta - start.theta).abs()
        };
        let [half, whole, fine] = [(steps, PERIODS / 2), (steps, PERIODS), (2 * steps, PERIODS)]
            .map(|(s, p)| error(s, p));
        Self {
            steps: steps as f64,
            periods: PERIODS as f64,
            error: whole,
            growth: libm::log2(whole / half),
            order: libm::log2(whole / fine),
        }
    }

    /// The steps of so many periods whose angle is off by at most `allowed` (rad).
    fn work(&self, periods: f64, allowed: f64) -> f64 {
        let error = self.error * libm::pow(periods / self.periods, self.growth);
        periods * self.steps * libm::pow(error / allowed, 1.0 / self.order)
    }
}

/// The work of the chapter's second case.
fn day() -> Truth {
    let work = |name| {
        let method = method_named(name).expect("a method of the library");
        let advice = profile_of(method, THETA_0).over(40_000).advice(1e-2);
        advice.expect("it can").evaluations as f64
    };
    Truth::ascending(vec![
        ("order-6", work("blanes-moan-6")),
        ("jump", work("forest-ruth")),
        ("rk4", work("rk4")),
        ("verlet", work("stormer-verlet")),
    ])
}

/// How many times the work of Störmer–Verlet a run takes that is a hundred times as long.
fn longer() -> Truth {
    const LONGER: f64 = 100.0;
    let law = Law::measure("stormer-verlet", 256);
    let (short, allowed) = (1000.0, 1e-3);
    let right = law.work(LONGER * short, allowed) / law.work(short, allowed);
    // If the error were proportional to h.
    let law = Law { order: law.order - 1.0, ..law };
    let proportional = law.work(LONGER * short, allowed) / law.work(short, allowed);
    let mistakes = [("energy", LONGER), ("period", right / LONGER), ("proportional", proportional)];
    // The powers of the theory give 1000; with the measured ones the product differs by less than
    // this.
    Truth::Number { right, within: Within::Percent(1.0), mistakes: mistakes.to_vec() }
}
