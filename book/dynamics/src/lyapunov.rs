//! How quickly neighbouring trajectories separate.

use pendula::{Error, Method, Phase};

use crate::checked;
use crate::linearised::Linearised;
use crate::stroboscope::Stroboscope;
use crate::variation::{Bundle, Variational};

/// A Lyapunov exponent (1/s): the mean rate at which the logarithm of a small distance grows.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Exponent {
    /// The mean over all blocks (1/s).
    pub value: f64,
    /// Its standard error (1/s): the scatter of the blocks over the root of their number.
    pub error: f64,
}

/// How long to average, in periods.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Watch {
    settling: u32,
    blocks: u32,
    periods: u32,
}

impl Watch {
    /// The average over a number of `blocks` of some `periods` each, long enough that blocks are
    /// hardly correlated, after the periods of `settling`, in which transients decay.
    ///
    /// # Errors
    /// [`Error::Parameter`] for fewer than two blocks, which have no scatter, and for blocks
    /// without a period.
    pub fn new(settling: u32, blocks: u32, periods: u32) -> Result<Self, Error> {
        checked("number of blocks", blocks.into(), blocks >= 2, "at least 2")?;
        checked("periods of a block", periods.into(), periods >= 1, "at least 1")?;
        Ok(Self { settling, blocks, periods })
    }
}

/// The largest Lyapunov exponent of the motion from `start`: a displacement follows the variational
/// equation, is rescaled to unit size each period, and the logarithms of its growth are averaged
/// (Benettin, Galgani, Giorgilli, Strelcyn, *Meccanica* 15 (1980) 21–30).
///
/// The error bar is that of the block averages: successive periods are correlated, long blocks
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
    // The logarithm of the growth of the displacement over `periods` periods.
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
