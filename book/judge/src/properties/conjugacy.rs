//! Conjugacy: n steps of Störmer–Verlet are half a kick back, n steps of symplectic Euler, and half
//! a kick; n steps of the trapezoidal rule and half a step of forward Euler are the half step and n
//! steps of the implicit midpoint rule; n steps of a processed method are its processor undone, n
//! steps of its kernel, and the processor.
//!
//! (K½ D K½)ⁿ = K½ (D K)ⁿ K½⁻¹, where the map on the right is applied first; with E half a step of
//! forward Euler and I half a step of backward Euler, E (I E)ⁿ = (E I)ⁿ E; (π K π⁻¹)ⁿ = π Kⁿ π⁻¹.
//! Hairer, Lubich, Wanner, *Geometric Numerical Integration* (2006), Example V.3.6; Sect. VI.8 on
//! conjugate methods in general.

use super::{CheckResult, near, pendulum, run};
use pendula::arithmetic::sine::{cos, sin};
use pendula::internals::processed::processed_6;
use pendula::methods::{ImplicitMidpoint, StormerVerlet, SymplecticEuler, Trapezoidal};
use pendula::{AnyMethod, Pendulum, Phase, Separable, System};

const STEP: f64 = 0.05;

/// 1000 steps differ by 1e-16 or so each. On an orbit the difference in phase grows linearly on
/// top: √n · n · ε = 7e-12 at worst, if every rounding changes the energy.
const ROUNDING: f64 = 7e-12;

/// The length (s) and the number of the steps that are compared.
const SHORT: [(f64, u64); 3] = [(STEP, 1), (STEP, 2), (STEP, 1000)];

/// In the long step the processor's fourth power of h is 1e-4, and not 1e-8.
const SHORT_AND_LONG: [(f64, u64); 5] = [(STEP, 1), (STEP, 2), (STEP, 1000), (0.5, 1), (0.5, 7)];

/// Whether the two `ways` lead to the same state from two starts.
fn compare(scenes: &[(f64, u64)], ways: impl Fn(Phase, f64, u64) -> [Phase; 2]) -> CheckResult {
    for start in [Phase::at_rest(1.0), Phase { theta: -2.0, omega: 3.0 }] {
        for &(h, steps) in scenes {
            let [one, other] = ways(start, h, steps);
            near(format_args!("θ after {steps} steps of {h}"), one.theta, other.theta, ROUNDING)?;
            near(format_args!("ω after {steps} steps of {h}"), one.omega, other.omega, ROUNDING)?;
        }
    }
    Ok(())
}

/// Whether `verlet` is `euler` between two half kicks.
pub fn check_pair(verlet: &dyn AnyMethod, euler: &dyn AnyMethod) -> CheckResult {
    let pendulum = pendulum();
    let half_kick = |z: Phase, h: f64| pendulum.kick(z, pendulum.force(0.0, z), 0.5 * h);
    compare(&SHORT, |start, h, steps| {
        let z = run(verlet, &pendulum, start, h, steps);
        let way = run(euler, &pendulum, half_kick(start, -h), h, steps);
        [z, half_kick(way, h)]
    })
}

/// Whether n steps of `trapezoidal` and half a step of forward Euler are the half step and n steps
/// of `midpoint`.
pub fn check_implicit_pair(trapezoidal: &dyn AnyMethod, midpoint: &dyn AnyMethod) -> CheckResult {
    let pendulum = pendulum();
    let half_a_step = |z: Phase, h: f64| z + pendulum.rate(0.0, z) * (0.5 * h);
    compare(&SHORT, |start, h, steps| {
        let way = run(trapezoidal, &pendulum, start, h, steps);
        [half_a_step(way, h), run(midpoint, &pendulum, half_a_step(start, h), h, steps)]
    })
}

/// A kernel and its processor, step by step as the formulas are written, in rad and s.
#[derive(Clone, Copy, Debug)]
pub struct Kernel {
    /// The kicks, in steps, and what stands before h² f f' in each.
    pub kicks: &'static [(f64, f64)],
    /// The drifts between them, in steps.
    pub drifts: &'static [f64],
    /// λ, μ and ν of S = Θω + h²λ ωV' + h⁴(μ ωV'V'' + ν ω³V''').
    pub processor: [f64; 3],
}

/// Half a drift, a kick with f + (h²/12) f f', half a drift; θ = Θ + (h²/24) V' and
/// Ω = ω + (h²/24) ωV''.
pub const PROCESSED_4: Kernel = Kernel {
    kicks: &[(0.0, 0.0), (1.0, 1.0 / 12.0), (0.0, 0.0)],
    drifts: &[0.5, 0.5],
    processor: [1.0 / 24.0, 0.0, 0.0],
};

const A: f64 = processed_6::DRIFT;
const B: f64 = processed_6::KICK;

/// With the numbers of the method, which `tests/methods/order_conditions/processed.rs` holds to
/// their equations.
pub const PROCESSED_6: Kernel = Kernel {
    kicks: &[
        (B, processed_6::GRADIENT),
        (0.5 - B, 0.0),
        (0.5 - B, 0.0),
        (B, processed_6::GRADIENT),
    ],
    drifts: &[A, 1.0 - 2.0 * A, A],
    processor: processed_6::PROCESSOR.coefficients(),
};

impl Kernel {
    /// θ − Θ and Ω/ω − 1 for Θ and ω.
    fn sides(&self, pendulum: &Pendulum, z: Phase, h: f64) -> (f64, f64) {
        let k = pendulum.frequency_squared();
        let [v1, v2, v3, v4] = [sin(z.theta), cos(z.theta), -sin(z.theta), -cos(z.theta)];
        let [linear, mixed, cubic] = self.processor;
        let (x2, square) = (k * h * h, z.omega * z.omega * h * h);
        let theta = linear * x2 * v1 + mixed * x2 * x2 * v1 * v2 + 3.0 * cubic * x2 * square * v3;
        let omega =
            linear * x2 * v2 + mixed * x2 * x2 * (v2 * v2 + v1 * v3) + cubic * x2 * square * v4;
        (theta, omega)
    }

    /// The kernel's state of the seen `z`.
    pub fn unprocessed(&self, pendulum: &Pendulum, z: Phase, h: f64) -> Phase {
        let theta =
            settled(z.theta, |theta| z.theta - self.sides(pendulum, Phase { theta, ..z }, h).0);
        let stretch = self.sides(pendulum, Phase { theta, ..z }, h).1;
        Phase { theta, omega: z.omega + z.omega * stretch }
    }

    /// The seen state of the kernel's `z`.
    pub fn processed(&self, pendulum: &Pendulum, z: Phase, h: f64) -> Phase {
        let omega = settled(z.omega, |omega| {
            z.omega - omega * self.sides(pendulum, Phase { omega, ..z }, h).1
        });
        Phase { theta: z.theta + self.sides(pendulum, Phase { omega, ..z }, h).0, omega }
    }

    /// A step of the kernel from its state `z`.
    pub fn step(&self, pendulum: &Pendulum, z: Phase, h: f64) -> Phase {
        let kicked = |z: Phase, (kick, gradient): (f64, f64)| {
            let along = -pendulum.frequency_squared() * cos(z.theta);
            let force = pendulum.force(0.0, z) * (1.0 + gradient * (h * h) * along);
            pendulum.kick(z, force, kick * h)
        };
        let substeps = self.kicks.iter().zip(self.drifts);
        let z = substeps.fold(z, |z, (kick, by)| pendulum.drift(kicked(z, *kick), by * h));
        kicked(z, self.kicks[self.drifts.len()])
    }
}

/// The value that `sweep` leaves as it is, from `value` on. Each sweep leaves λx² or less of what
/// is wrong.
fn settled(mut value: f64, sweep: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..40 {
        let before = value;
        value = sweep(before);
        if value == before {
            break;
        }
    }
    value
}

/// Whether `method` is `kernel` between its processor undone and done.
pub fn check_processed(method: &dyn AnyMethod, kernel: &Kernel) -> CheckResult {
    let pendulum = pendulum();
    compare(&SHORT_AND_LONG, |start, h, steps| {
        let inside = kernel.unprocessed(&pendulum, start, h);
        let way = (0..steps).fold(inside, |z, _| kernel.step(&pendulum, z, h));
        [run(method, &pendulum, start, h, steps), kernel.processed(&pendulum, way, h)]
    })
}

/// Checks either of two methods with the other one of the library, and a processed method with its
/// kernel. It accepts all other methods.
pub fn check(method: &dyn AnyMethod) -> CheckResult {
    match method.info().name {
        "stormer-verlet" => check_pair(method, &SymplecticEuler),
        "symplectic-euler" => check_pair(&StormerVerlet, method),
        "trapezoidal" => check_implicit_pair(method, &ImplicitMidpoint),
        "implicit-midpoint" => check_implicit_pair(&Trapezoidal, method),
        "processed-4" => check_processed(method, &PROCESSED_4),
        "processed-6" => check_processed(method, &PROCESSED_6),
        _ => Ok(()),
    }
}
