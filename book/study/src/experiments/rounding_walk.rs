//! The effect of rounding on a conserved energy.
//!
//! Störmer–Verlet conserves its modified energy so well that over millions of steps the only thing
//! left to change it is the rounding of each step: a random walk (Brouwer, *Astronomical Journal*
//! 46 (1937) 149).

use std::sync::LazyLock;

use pendula::methods::StormerVerlet;
use pendula::{Grid, Pendulum, Phase, integrate_fast_with};

use crate::theory::Dimensionless;
use crate::theory::stormer_verlet::correction;

/// The step (s).
pub const STEP: f64 = 0.01;
/// Steps of each run.
pub const STEPS: u64 = 10_000_000;
/// Steps from one sample to the next.
pub const SAMPLED: u64 = 1000;
/// Number of starts, a fiftieth of a radian apart.
pub const STARTS: usize = 8;

/// One start's relative error of the modified energy, H̃/H̃₀ − 1, at every [`SAMPLED`]-th step from
/// the first on.
pub type Walk = Vec<f64>;

/// The walks from all the starts, at rest at 1 rad and a little above, walked once.
pub fn walks() -> &'static [Walk; STARTS] {
    static WALKS: LazyLock<[Walk; STARTS]> =
        LazyLock::new(|| core::array::from_fn(|i| walk(1.0 + 0.02 * i as f64)));
    &WALKS
}

fn walk(theta_0: f64) -> Walk {
    let pendulum = Pendulum::PAPER;
    let x = pendulum.small_angle_frequency() * STEP;
    // What the correction leaves out, of order x⁸, is 1e-18 of the energy.
    let energy = |z| {
        let z = Dimensionless::from_phase(&pendulum, z);
        z.energy() + correction(z, x)
    };
    let start = Phase::at_rest(theta_0);
    let initial = energy(start);
    let mut walk = Vec::with_capacity((STEPS / SAMPLED + 1) as usize);
    let grid = Grid::new(STEP, STEPS).expect("a positive step");
    integrate_fast_with(
        &pendulum,
        &StormerVerlet,
        start,
        &grid,
        &mut |n: u64, _: f64, z: Phase| {
            if n.is_multiple_of(SAMPLED) {
                walk.push(energy(z) / initial - 1.0);
            }
        },
    );
    walk
}

/// The root mean square of the walks' movement in n steps, over all consecutive stretches of n
/// steps that do not overlap: pairs (n, movement), two to an octave.
pub fn growth(walks: &[Walk]) -> Vec<(u64, f64)> {
    let samples = (STEPS / SAMPLED) as usize;
    let lags = (0..).map(|k| libm::round(libm::exp2(0.5 * f64::from(k))) as usize);
    let mut lags: Vec<usize> = lags.take_while(|lag| *lag <= samples).collect();
    lags.dedup();
    let movement = |lag: usize| {
        let stretches = walks.iter().flat_map(|walk| {
            walk.iter().step_by(lag).zip(walk.iter().skip(lag).step_by(lag)).map(|(a, b)| b - a)
        });
        let (sum, count) = stretches.fold((0.0, 0_u32), |(sum, n), d| (sum + d * d, n + 1));
        (lag as u64 * SAMPLED, libm::sqrt(sum / f64::from(count)))
    };
    lags.into_iter().map(movement).collect()
}
