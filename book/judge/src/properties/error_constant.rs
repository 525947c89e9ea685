//! The error constant: the error at a given time over hᵖ, as h → 0, against theory.
//!
//! One step misses the exact flow by xᵖ⁺¹ d(z) + …, with x = ω₀h and the state in θ and q = ω/ω₀.
//! The flow carries these errors along, and they add up: at the end the error over xᵖ is δ, where
//! δ' = J(z) δ + d(z) along the exact motion (Hairer, Nørsett, Wanner, *Solving Ordinary
//! Differential Equations I* (1993), Sect. II.3 and II.8).

use core::f64::consts::TAU;

use super::order::has_small_first_term;
use super::{CheckResult, beyond, near, pendulum, run};
use pendula::arithmetic::sine::{cos, sin};
use pendula::{AnyMethod, Motion, Pendulum, Phase};

/// θ and q, or their rates.
type Pair = [f64; 2];

/// The leading local error d, by the method's name: step minus exact flow, as Taylor series in x.
/// With s = sin θ and c = cos θ the exact flow is
///
/// θ + xq − x²s/2 − x³cq/6 + …, q − xs − x²cq/2 + x³(cs + sq²)/6 + ….
pub fn leading_local_error(name: &str, [theta, q]: Pair) -> Option<Pair> {
    let (s, c) = (sin(theta), cos(theta));
    Some(match name {
        // θ + xq, q − xs.
        "forward-euler" => [s / 2.0, c * q / 2.0],
        // θ + xq − x²s, q − xs.
        "symplectic-euler" => [-s / 2.0, c * q / 2.0],
        // θ + xq − x²s/2, q − (x/2)(s + sin of that) = … + x³(cs + sq²)/4: ¼ − ⅙ is left.
        "stormer-verlet" => [c * q / 6.0, (c * s + s * q * q) / 12.0],
        "rk4" => rk4(s, c, q),
        // With the slope f the exact flow has f'f'f/6 + f''ff/6 in x³, with f'f'f = (−cq, cs) and
        // f''ff = (0, sq²). The trapezoidal rule has a quarter of each; the mean slope along the
        // step a quarter of the first and, like the flow, a sixth of the second.
        "trapezoidal" => [-c * q / 12.0, (c * s + s * q * q) / 12.0],
        "discrete-gradient" => [-c * q / 12.0, c * s / 12.0],
        // The same in steps longer by x³/12.
        "cieslinski-ratkiewicz" => [(1.0 - c) * q / 12.0, (c - 1.0) * s / 12.0],
        // Störmer–Verlet's less that on the linear oscillator, which rotates exactly.
        "deuflhard" => {
            let rest = theta - TAU * libm::round(theta / TAU);
            [(c - 1.0) * q / 6.0, (c * s + s * q * q - rest) / 12.0]
        }
        "processed-4" => processed_4(s, c, q),
        _ => return None,
    })
}

/// The leading local error of RK4, with s = sin θ and c = cos θ: the term in x⁵, expanded in exact
/// rational arithmetic.
pub fn rk4(s: f64, c: f64, q: f64) -> [f64; 2] {
    let (q2, c2) = (q * q, c * c);
    [
        q * (3.0 - 9.0 * c2 - q2 * c) / 720.0,
        s * (18.0 + 6.0 * c2 - 36.0 * q2 * c - q2 * q2) / 2880.0,
    ]
}

/// The leading local error of the processed method of order 4, with s = sin θ and c = cos θ: the
/// motion in the term in x⁴ of its modified energy,
///
/// (−7q⁴c + 52q²s² − 19q²c² + 11s²c)/5760.
pub fn processed_4(s: f64, c: f64, q: f64) -> [f64; 2] {
    let (s2, c2, q2) = (s * s, c * c, q * q);
    [
        q * (104.0 * s2 - 38.0 * c2 - 28.0 * q2 * c) / 5760.0,
        s * (11.0 * s2 - 22.0 * c2 - 142.0 * q2 * c - 7.0 * q2 * q2) / 5760.0,
    ]
}

/// Extrapolates to h = 0 what was measured at h, h/2 and h/4, as a quadratic in h.
pub(crate) fn extrapolated(at: [f64; 3]) -> f64 {
    let (first, second) = (2.0 * at[1] - at[0], 2.0 * at[2] - at[1]);
    (4.0 * second - first) / 3.0
}

/// The error of `method` at the dimensionless time `end`, in `steps` steps from `z`.
fn error_at(
    method: &dyn AnyMethod,
    pendulum: &Pendulum,
    z: Pair,
    (end, steps): (f64, u64),
) -> Pair {
    let frequency = pendulum.small_angle_frequency();
    let start = Phase { theta: z[0], omega: z[1] * frequency };
    let truth = Motion::new(pendulum, start).expect("a start in range").at(end / frequency);
    let end = run(method, pendulum, start, end / steps as f64 / frequency, steps);
    [end.theta - truth.theta, (end.omega - truth.omega) / frequency]
}

/// d as measured: the error of single steps at x, x/2 and x/4, extrapolated.
pub fn measured_local_error(method: &dyn AnyMethod, pendulum: &Pendulum, z: Pair) -> Pair {
    let order = method.info().order;
    let coarsest = if order > 4 { 0.4 } else { 0.2 };
    let errors = [coarsest, coarsest / 2.0, coarsest / 4.0].map(|x: f64| {
        let scale = libm::pow(x, f64::from(order + 1));
        error_at(method, pendulum, z, (x, 1)).map(|error| error / scale)
    });
    [0, 1].map(|i| extrapolated(errors.map(|error| error[i])))
}

/// δ after the dimensionless time `end`: classical Runge–Kutta on (z, δ), written out here.
fn transported(z: Pair, end: f64, local: &dyn Fn(Pair) -> Pair) -> Pair {
    /// Steps of 0.01: an error of 1e-10.
    const STEPS: u32 = 400;
    let rate = |[theta, q, delta_theta, delta_q]: [f64; 4]| {
        let [d_theta, d_q] = local([theta, q]);
        [q, -sin(theta), delta_q + d_theta, -cos(theta) * delta_theta + d_q]
    };
    let along = |z: [f64; 4], k: [f64; 4], h: f64| core::array::from_fn(|i| z[i] + h * k[i]);
    let h = end / f64::from(STEPS);
    let mut z = [z[0], z[1], 0.0, 0.0];
    for _ in 0..STEPS {
        let k1 = rate(z);
        let k2 = rate(along(z, k1, h / 2.0));
        let k3 = rate(along(z, k2, h / 2.0));
        let k4 = rate(along(z, k3, h));
        z = core::array::from_fn(|i| z[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
    }
    [z[2], z[3]]
}

/// The dimensionless time at which the error is measured: not a whole number of quarter periods.
const END: f64 = 4.0;

/// The constants of the methods given by tables of coefficients, from runs in arithmetic of 60
/// digits: see `tests/data/README.md`.
const ON_FILE: &str = include_str!("data/error_constants.csv");

/// The rows of `file` for the method `name` from `z`: what follows the name and the start.
fn on_file(file: &'static str, name: &str, z: Pair) -> impl Iterator<Item = Vec<f64>> {
    file.lines().skip(1).filter_map(move |line| {
        let (method, numbers) = line.split_once(',')?;
        let numbers: Vec<f64> = numbers.split(',').map(|x| x.parse().expect("a number")).collect();
        (method == name && numbers[..2] == z).then(|| numbers[2..].to_vec())
    })
}

/// The error at [`END`] in so many steps, over xᵖ.
fn scaled_error(method: &dyn AnyMethod, pendulum: &Pendulum, z: Pair, steps: u64) -> Pair {
    let scale = libm::pow(END / steps as f64, f64::from(method.info().order));
    error_at(method, pendulum, z, (END, steps)).map(|error| error / scale)
}

/// The error over xᵖ, extrapolated from 100, 200 and 400 steps.
fn extrapolated_constant(method: &dyn AnyMethod, pendulum: &Pendulum, z: Pair) -> Pair {
    let errors = [100, 200, 400].map(|steps| scaled_error(method, pendulum, z, steps));
    [0, 1].map(|i| extrapolated(errors.map(|error| error[i])))
}

/// The extrapolation leaves out x³/8 of the leading term, with x = 4/100 at the coarsest: 8e-6,
/// with a coefficient that grows like END³/3! = 11. RK4's error at the finest, 2e-10, is rounded by
/// 1e-14 at worst.
const TOLERANCE: f64 = 2e-4;

/// The tolerance for a method whose d is not on file but measured: x³/8 is then 1e-3, with a
/// coefficient up to 5.
const TOLERANCE_IF_MEASURED: f64 = 4e-2;

/// The error over xᵖ of a symmetric method at the finest step whose error is three digits above
/// rounding, 1e-14; and its relative tolerance: twice the square of the longest substep, which is
/// below 2x, as the next term of the error is of that order; three times that for a method designed
/// for a small first term. (For SRKN 6b it is 2.5 times.)
fn finest_constant(method: &dyn AnyMethod, pendulum: &Pendulum, z: Pair) -> (Pair, f64) {
    const ROUNDED: f64 = 1e-11;
    let order = method.info().order;
    let steps = [1600_u64, 800, 400, 200, 100, 80, 64, 50, 40, 32, 25, 20, 16];
    let measured = steps.map(|steps| (steps, scaled_error(method, pendulum, z, steps)));
    let x = |steps| END / steps as f64;
    let rounded = |steps: u64, e: &Pair| {
        libm::hypot(e[0], e[1]) * libm::pow(x(steps), f64::from(order)) < ROUNDED
    };
    let finest = measured.iter().find(|(steps, error)| !rounded(*steps, error));
    let (steps, error) = finest.unwrap_or(&measured[steps.len() - 1]);
    let is_small = has_small_first_term(libm::hypot(error[0], error[1]), 1.0, f64::from(order));
    let next = if is_small { 3.0 } else { 2.0 };
    (*error, next * libm::pow(2.0 * x(*steps), 2.0) + 1e-3)
}

/// The errors at [`END`] in few, long steps, from runs in arithmetic of 60 digits: see
/// `tests/data/README.md`.
const IN_LONG_STEPS: &str = include_str!("data/long_steps.csv");

/// What rounding may add to an error in each step: some forty roundings of ε. A step rounds the
/// state, of up to 3, and its slopes, whose weights add up to at most 15, in DOP853; by the end
/// that has grown with the phase, at most tenfold, and there are few steps.
const ROUNDED_A_STEP: f64 = 1e-14;

/// Compares the error itself and not its limit, for methods so accurate that rounding leaves no
/// room for a limit: with each number of steps on file for the method from `z`, if there are any.
fn check_in_long_steps(
    method: &dyn AnyMethod,
    pendulum: &Pendulum,
    z: Pair,
) -> Option<CheckResult> {
    let rows = on_file(IN_LONG_STEPS, method.info().name, z);
    let laws: Vec<(u64, Pair)> = rows.map(|row| (row[0] as u64, [row[1], row[2]])).collect();
    let compare = |&(steps, law): &(u64, Pair)| {
        let error = error_at(method, pendulum, z, (END, steps));
        let tolerance = ROUNDED_A_STEP * steps as f64;
        near(format_args!("error of θ in {steps} steps from {z:?}"), error[0], law[0], tolerance)?;
        near(format_args!("error of q in {steps} steps from {z:?}"), error[1], law[1], tolerance)
    };
    let (steps, coarsest) = *laws.first()?;
    // Otherwise rounding would hide the error.
    let seen = beyond(
        "the largest error on file",
        libm::hypot(coarsest[0], coarsest[1]),
        1e4 * ROUNDED_A_STEP * steps as f64,
    );
    Some(seen.and_then(|()| laws.iter().try_for_each(compare)))
}

/// Whether the error over hᵖ is the constant known for the method, or the one that follows from its
/// single steps.
pub fn check(method: &dyn AnyMethod) -> CheckResult {
    let info = method.info();
    let name = info.name;
    let pendulum = pendulum();
    for z in [[1.0, 0.0], [-2.0, 0.5], [0.5, 2.5]] {
        if let Some(verdict) = check_in_long_steps(method, &pendulum, z) {
            verdict?;
            continue;
        }
        let of_file = on_file(ON_FILE, name, z).next().map(|row| [row[0], row[1]]);
        let (measured, relative) = if of_file.is_some() && info.symmetric {
            finest_constant(method, &pendulum, z)
        } else {
            let is_law = of_file.is_some() || leading_local_error(name, z).is_some();
            let relative = if is_law { TOLERANCE } else { TOLERANCE_IF_MEASURED };
            (extrapolated_constant(method, &pendulum, z), relative)
        };
        let local = |z| {
            leading_local_error(name, z)
                .unwrap_or_else(|| measured_local_error(method, &pendulum, z))
        };
        let law = of_file.unwrap_or_else(|| transported(z, END, &local));
        let tolerance = relative * libm::hypot(law[0], law[1]);
        near(format_args!("error of θ over xᵖ from {z:?}"), measured[0], law[0], tolerance)?;
        near(format_args!("error of q over xᵖ from {z:?}"), measured[1], law[1], tolerance)?;
    }
    Ok(())
}
