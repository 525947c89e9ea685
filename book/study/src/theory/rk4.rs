//! RK4: the energy that a step loses, and the equation it follows.
//!
//! RK4 conserves no energy. One step changes the pendulum's energy by H(n+1) − H(n) = x⁵e₅ +
//! x⁶e₆ + …, the Taylor series of H(step(z)) − H(z) in x, expanded in exact rational arithmetic.
//! The lower powers vanish, as the method is of order 4. e₅ and e₇ are odd in q: they cancel over
//! a swing and leave a bounded oscillation of order h⁴; e₆ and e₈ add up. So the secular energy
//! error is of order h⁵, one better than the angle's. Backward error analysis of Runge–Kutta
//! methods: Hairer, Lubich, Wanner, Sect. IX.1–2.

use pendula::exact::Motion;
use pendula::{Pendulum, Phase};
use pendula_judge::properties::error_constant;

use super::tools::flow;
use super::{Dimensionless, average, polynomial, scaled};

/// The terms e₅, e₆, e₇, e₈ of the energy change of one step, H(n+1) − H(n) = x⁵e₅ + x⁶e₆ + …, in
/// units of m g L.
pub fn energy_change_terms(z: Dimensionless) -> [f64; 4] {
    let Dimensionless { q, s, c, .. } = z;
    let (q2, s2, c2) = (q * q, s * s, c * c);
    let e5 = q * s * polynomial(q2, &[30.0 * s2, -40.0 * c, -1.0]) / 2880.0;
    let e6 = polynomial(
        q2,
        &[-10.0 * s2 * (c2 + 3.0), 40.0 * c * (4.0 - 5.0 * c2), 5.0 * (7.0 - 17.0 * c2), -c],
    ) / 5760.0;
    let e7 =
        q * s * polynomial(q2, &[-3360.0 * c * s2, 210.0 * (109.0 * c2 - 25.0), 3948.0 * c, 23.0])
            / 483_840.0;
    let e8 = -c * s2 * (3.0 - 5.0 * c2) / 2304.0
        + q2 * (polynomial(c2, &[21.0, -142.0, 125.0]) / 4608.0)
        + q2 * q2 * c * (1043.0 * c2 - 763.0) / 27648.0
        + q2 * q2 * q2 * (433.0 * c2 - 206.0) / 138_240.0
        + q2 * q2 * q2 * q2 * c / 107_520.0;
    [e5, e6, e7, e8]
}

/// The energy change of one step (units of m g L) to order x⁸.
fn energy_change(z: Dimensionless, x: f64) -> f64 {
    let x5 = x * x * x * x * x;
    x5 * polynomial(x, &energy_change_terms(z))
}

/// Largest energy error (J) of a release from rest at `theta_0` (rad) over `steps` steps of `h`
/// (s): the sum of the changes of the single steps along the exact orbit.
///
/// The method's deviation from that orbit changes the sum, relatively, by about as much as the
/// energy.
pub fn largest_energy_error(pendulum: &Pendulum, theta_0: f64, h: f64, steps: u64) -> f64 {
    let Ok(motion) = Motion::new(pendulum, Phase::at_rest(theta_0)) else {
        return f64::NAN;
    };
    let x = scaled(pendulum, h);
    let (mut sum, mut largest) = (0.0, 0.0);
    for n in 0..steps {
        sum += energy_change(Dimensionless::from_phase(pendulum, motion.at(n as f64 * h)), x);
        largest = f64::max(largest, libm::fabs(sum));
    }
    pendulum.depth() * largest
}

/// The rate of change of the energy, averaged over the exact swing from rest at `theta_0` (rad), in
/// W: m g L ω₀ (x⁵⟨e₆⟩ + x⁷⟨e₈⟩). The odd terms average to zero. It is negative. For a small swing
/// of the energy E above the bottom it is −E ω₀ x⁵/72.
pub fn secular_rate(pendulum: &Pendulum, theta_0: f64, h: f64) -> f64 {
    let x = scaled(pendulum, h);
    let [e6, e8] = [1, 3].map(|k| average(pendulum, theta_0, |z| energy_change_terms(z)[k]));
    let x2 = x * x;
    pendulum.depth() * pendulum.small_angle_frequency() * x2 * x2 * x * (e6 + x2 * e8)
}

/// The relative change of the period divided by h⁴ (1/s⁴), from rest at `theta_0` (rad): T̃/T = 1 +
/// h⁴ τ₄ + O(h⁵).
///
/// RK4 follows the equation (θ', q') = (q, −s) + x⁴ f₄ + …, where f₄ is the x⁵ term of its local
/// error. To first order the perturbed orbit is z + x⁴δ with δ' = J(z)δ + f₄(z), J the Jacobian of
/// the pendulum's equation. It reaches the bottom late by the time −δθ/q. RK4's even corrections
/// are reversible in time, as the pendulum is, so that four such quarters make a period (Hairer,
/// Lubich, Wanner, Sect. V.1, IX.2).
pub fn period_shift(pendulum: &Pendulum, theta_0: f64) -> f64 {
    /// Even near the top a step of the solver is then below 0.02 rad, and its error is rounding.
    const STEPS: u32 = 1000;
    let Ok(period) = pendula::exact::period(pendulum, theta_0) else {
        return f64::NAN;
    };
    let quarter = 0.25 * period * pendulum.small_angle_frequency();
    let mut state = [theta_0, 0.0, 0.0, 0.0];
    for _ in 0..STEPS {
        state = flow(
            |[theta, q, delta_theta, delta_q]| {
                let z = Dimensionless::new(theta, q);
                let [f_theta, f_q] = error_constant::rk4(z.s, z.c, z.q);
                [q, -z.s, delta_q + f_theta, -z.c * delta_theta + f_q]
            },
            state,
            quarter / f64::from(STEPS),
        );
    }
    let [_, q, delta_theta, _] = state;
    let frequency_squared = pendulum.frequency_squared();
    frequency_squared * frequency_squared * (-delta_theta / q / quarter)
}

/// The two terms of RK4's period error (s), from rest at `theta_0` (rad) in steps of `h` (s),
/// measured between the first two downward crossings of zero: h⁴τ₄T, and dT/dE times the energy
/// lost by the middle between them, at 3T/4. They have opposite signs, and at some step they
/// cancel.
///
/// Left out are the square of the loss, and x² of each term.
pub fn period_error_terms(pendulum: &Pendulum, theta_0: f64, h: f64) -> [f64; 2] {
    /// For a central difference, whose relative error is of order δ² or ε/δ.
    const DELTA: f64 = 1e-5;
    let period = |theta| pendula::exact::period(pendulum, theta).unwrap_or(f64::NAN);
    let exact = period(theta_0);
    let slope = (period(theta_0 + DELTA) - period(theta_0 - DELTA)) / (2.0 * DELTA);
    let per_energy = slope / (pendulum.depth() * pendula::arithmetic::sine::sin(theta_0));
    let h2 = h * h;
    let lost = secular_rate(pendulum, theta_0, h) * 0.75 * exact;
    [exact * period_shift(pendulum, theta_0) * h2 * h2, per_energy * lost]
}
