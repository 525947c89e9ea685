//! How quickly neighbours part.

use super::stroboscope::Stroboscope;
use super::variation::{Bundle, Linearised, Variational};
use crate::integrate::Method;
use crate::systems::Phase;

/// A Lyapunov exponent (1/s): the mean rate at which the logarithm of a small distance grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exponent {
    /// The mean over all blocks (1/s).
    pub value: f64,
    /// Its standard error (1/s): the scatter of the blocks over the root of their number.
    pub error: f64,
}

/// How long to look, in periods.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Watch {
    /// Periods before anything counts, in which motion and neighbour find their course.
    pub settling: u32,
    /// Blocks that are averaged, 2 or more.
    pub blocks: u32,
    /// Periods of a block: long enough that one block knows little of the one before.
    pub periods: u32,
}

// ANCHOR: exponent
/// The largest Lyapunov exponent of the motion from `start`: a neighbour is followed by the
/// variational equation, brought back to unit distance each period, and what it had grown by is
/// averaged (Benettin, Galgani, Giorgilli, Strelcyn, *Meccanica* 15 (1980) 9–20).
///
/// The error bar is that of the block averages: neighbouring periods are correlated, long blocks
/// hardly.
pub fn largest_exponent<'a, S, M>(
    strobe: &Stroboscope<'a, S, M>,
    start: Phase,
    watch: Watch,
) -> Exponent
where
    S: Linearised<State = Phase>,
    M: Method<Variational<'a, S, 1>>,
{
    let system = strobe.system();
    let mut neighbour = Bundle { base: start, tangents: [Phase { theta: 1.0, omega: 0.0 }] };
    // The logarithm by which the distance grows over so many periods.
    let mut growth = |periods| {
        let mut sum = 0.0;
        for _ in 0..periods {
            neighbour = strobe.map_bundle(neighbour);
            let size = system.size(neighbour.tangents[0]);
            neighbour.tangents[0] = neighbour.tangents[0] * (1.0 / size);
            sum += libm::log(size);
        }
        sum
    };
    growth(watch.settling);
    let duration = strobe.period() * f64::from(watch.periods);
    let (mut mean, mut squares) = (0.0, 0.0);
    for n in 0..watch.blocks {
        let rate = growth(watch.periods) / duration;
        // Welford's recurrence: the scatter without the difference of two large sums.
        let before = rate - mean;
        mean += before / f64::from(n + 1);
        squares += before * (rate - mean);
    }
    let blocks = f64::from(watch.blocks);
    Exponent { value: mean, error: libm::sqrt(squares / (blocks * (blocks - 1.0))) }
}
// ANCHOR_END: exponent
