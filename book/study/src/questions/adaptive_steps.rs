//! Questions of "Adaptive steps".

use pendula::adaptive::SymmetricSteps;
use pendula::methods::StormerVerlet;
use pendula::{Grid, Hamiltonian, integrate};
use pendula_dynamics::kepler::{Ellipse, Kepler, PlanePhase};

use super::{Compute, Truth};

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] = &[("adaptive-steps-drift", drift)];

/// The revolutions after which the energy errors are looked at.
const REVOLUTIONS: [f64; 2] = [100.0, 1000.0];

/// The largest energy error (J/kg) of `run`, pairs of time and state, up to each of the two times.
fn largest(
    energy: impl Fn(PlanePhase) -> f64,
    times: [f64; 2],
    run: impl Iterator<Item = (f64, PlanePhase)>,
) -> [f64; 2] {
    let mut largest = [0.0_f64; 2];
    for (t, z) in run.take_while(|(t, _)| *t < times[1]) {
        let off = energy(z).abs();
        for (largest, time) in largest.iter_mut().zip(times) {
            if t < time {
                *largest = largest.max(off);
            }
        }
    }
    largest
}

/// The powers of the time with which the energy errors of the chapter's two runs grow, in steps
/// twice as long: with steps chosen from one end and with symmetric ones.
fn powers() -> [f64; 2] {
    let (sun, first) = (Kepler::new(1.0).expect("an attraction"), 0.006);
    let ellipse = Ellipse::new(&sun, 1.0, 0.8).expect("an ellipse");
    let start = ellipse.at(0.0);
    let square = |z: PlanePhase| z.x * z.x + z.y * z.y;
    let kappa = |z: PlanePhase| -1.5 * (z.x * z.vx + z.y * z.vy) / square(z);
    let naive = core::iter::successors(Some((0.0, start)), |&(t, z)| {
        // In proportion to the distance to the power 3/2.
        let h = first * libm::pow(square(z) / square(start), 0.75);
        let step = Grid::new(h, 1).expect("a positive step");
        Some((t + h, integrate(&sun, &StormerVerlet, z, &step)))
    });
    let symmetric = SymmetricSteps::new(&sun, start, first, kappa).expect("a first step");
    let symmetric = symmetric.map(|sample| sample.map(|sample| (sample.t, sample.z)));
    let symmetric = symmetric.map(|sample| sample.expect("a positive density"));
    let times = REVOLUTIONS.map(|revolutions| revolutions * ellipse.period());
    let off = |z| sun.energy(z) - sun.energy(start);
    [largest(off, times, naive), largest(off, times, symmetric)]
        .map(|[short, long]| libm::log(long / short) / libm::log(times[1] / times[0]))
}

/// How the energy errors grow.
fn drift() -> Truth {
    let powers = powers();
    let are = |expected: [f64; 2]| powers.iter().zip(expected).all(|(p, e)| (p - e).abs() < 0.1);
    Truth::Which(vec![
        ("neither", are([0.0, 0.0])),
        ("walk", are([0.5, 0.0])),
        ("line", are([1.0, 0.0])),
        ("both", are([1.0, 1.0])),
    ])
}
