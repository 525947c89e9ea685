//! The Taylor series of the motion, to an order that follows from the tolerance, in steps that
//! follow its radius of convergence.

use super::Tolerance;
use super::control::{GROW, SHRINK};
use super::controlled::{ChoosesSteps, Controlled, Times, time_scale};
use crate::arithmetic::rough::{exp2, log2};
use crate::methods::runge_kutta::Interpolant;
use crate::systems::{Analytic, Components, Counting, Majorant, RateOf, System, Vector};

/// The Taylor series of the motion, to an order that follows from the tolerance, in steps that
/// follow its radius of convergence ρ.
///
/// À. Jorba and M. Zou (*Experiment. Math.* 14 (2005) 99–117, doi:10.1080/10586458.2005.10128904)
/// make the powers of the motion first, and read the step off them: it is as long as their size
/// allows, and none is refused. They let the last two powers decide. From rest these two are one
/// number, the same power of the angle, and it vanishes at some amplitudes: a step was then off by
/// as much as 10¹² tolerances. Here the step is computed from a [bound](Analytic::majorant) on all
/// powers, where the system knows one: in it the bound on the power p − 2 is at most a tolerance.
/// What is left out is x³/(1 − x) of that and less, where x is the share of the bound's radius, at
/// most 0.67: so no step is off by more than a tolerance and rounding. The pendulum knows such a
/// bound, but for fast rotations and beside its equilibria. Elsewhere the last six powers decide,
/// by two conditions:
///
/// * The power p − i, for i from 0 to 5, is at most eⁱ⁻² tolerances: ‖zₚ₋ᵢ‖ hᵖ⁻ⁱ ≤ eⁱ⁻². Of a
///   series whose powers fall by e each, these are six times the same step.
/// * They do fall: h is at most 0.7 of the radius of convergence that the ratios of the last two to
///   the four before tell (at order p, 0.7 · 2^(−2/p): a branch point seems farther away than it
///   is). Beside the top, where the motion grows, powers below a tolerance may increase, and what
///   follows is larger than they are.
///
/// If all six vanish, the last power that does not decides as they would. In 3 million random steps
/// of the pendulum and the linear oscillator, and from 4600 starts at which a power vanishes, the
/// largest error of a step was 1.5 tolerances. It was above 1 at tolerances of 0.001 and more
/// alone. A system of your own may do worse: at order p nothing is known of a motion whose second
/// power is beyond the p-th.
///
/// A step in which the power p is ε of the whole is h = ρ ε^(1/p) long. Jorba and Zou take p =
/// −½ ln ε, so that h = ρ/e²: the best where the work of a step grows with p², the number of its
/// products. Here the time of a step grows with p, since each power waits for the one before and
/// the products are made meanwhile; and then p = −ln ε is best, and h = ρ/e. ε is the relative
/// tolerance. Two powers more are summed, so that what is left out is e⁻³ of the tolerance and
/// less; and the order is rounded up to a multiple of 4. It is 4 to 24: beyond, the products take
/// longer than the powers wait, and shorter steps cost less than more powers.
///
/// Dense output is the series itself. A step is one expansion, counted as an evaluation of the
/// force for each power; the unit of time in the first takes one more. Not symplectic, not
/// symmetric.
#[derive(Clone, Copy, Debug, Default)]
pub struct TaylorSeries;

/// The order is a multiple of this, and the polynomial is summed in as many independent parts.
const BLOCK: usize = 4;

/// The powers behind the one that is allowed a tolerance.
const SPARE: usize = 2;

/// The last powers, which decide: so many that of a motion that is even or odd in time, as from
/// rest or at the bottom, three are different numbers.
const DECIDE: usize = 6;

/// log₂ e: the powers of a step are expected to fall by e, one after the other.
const FALL: f64 = core::f64::consts::LOG2_E;

/// log₂ of the share of the radius of convergence that no step exceeds: 0.7, where a step of the
/// expected size takes 1/e.
const SHARE: f64 = -0.5;

/// The largest share x of a radius that is known: even in a last step, which may be 1 % longer,
/// x³/(1 − x) is at most 1.
const LARGEST_SHARE: f64 = 0.67;

/// The largest order.
const MOST: usize = 24;

// ANCHOR: order
/// The order for this tolerance.
pub fn order(tolerance: &Tolerance<'_>) -> usize {
    let powers = -libm::log(tolerance.relative()) + SPARE as f64;
    let blocks = libm::ceil(powers / BLOCK as f64) as usize;
    blocks.clamp(1, MOST / BLOCK) * BLOCK
}
// ANCHOR_END: order

/// The series at a state: what a walk with [`TaylorSeries`] keeps.
#[derive(Clone, Copy, Debug)]
pub struct Expansion<D> {
    /// The terms of the mean rate, as many as the order; what is behind them is not used.
    terms: [D; MOST],
    order: usize,
    /// −½/(p − 2): the power of a squared size that is a share of the radius.
    root: f64,
    /// The unit of time of the terms, and of those of the next expansion (s): the step before.
    unit: f64,
    next_unit: f64,
    /// The time at which the series begins (s).
    start: f64,
    /// The step that a majorant allows (s), and the displacement in it; NaN where there is none.
    ahead: (f64, D),
}

impl<D: Vector> Expansion<D> {
    /// The displacement in the time `h` (s).
    #[inline]
    fn displacement(&self, h: f64) -> D {
        let (step, displacement) = self.ahead;
        if h == step { displacement } else { sum(&self.terms[..self.order], h / self.unit) * h }
    }

    /// Expands the motion of `system` from `z`. Where there is a majorant, returns the longest step
    /// that it allows, in units, and has the displacement in that step ready: this costs less here,
    /// where the terms are still in registers.
    // Not inlined: there are six series in it.
    #[inline(never)]
    fn expand<S>(&mut self, system: &S, tolerance: &Tolerance<'_>, z: S::State) -> Option<f64>
    where
        S: Analytic<State: Components<Displacement = D>>,
    {
        // Before the terms, which do not wait for it.
        let longest = system.majorant(z).map(|majorant| self.within(tolerance, &majorant, z));
        self.ahead.0 = f64::NAN;
        macro_rules! to_order {
            ($($order:literal)+) => {
                match self.order {
                    $($order => {
                        let terms = system.terms::<$order>(self.unit, z);
                        if let Some(longest) = longest {
                            let step = self.unit * longest;
                            self.ahead = (step, sum(&terms, longest) * step);
                        }
                        self.terms[..$order].copy_from_slice(&terms);
                    })+
                    _ => unreachable!("a multiple of four, up to 24"),
                }
            };
        }
        to_order!(4 8 12 16 20 24);
        longest
    }

    /// The longest step, in units, that the `majorant` allows.
    #[inline(always)]
    fn within<Z>(&self, tolerance: &Tolerance<'_>, majorant: &Majorant<D>, z: Z) -> f64
    where
        Z: Components<Displacement = D>,
    {
        let square = tolerance.square_norm(z, z, majorant.size);
        let share = exp2(self.root * log2(square)).min(LARGEST_SHARE);
        (majorant.radius / self.unit.abs() * share).min(GROW)
    }

    /// The longest step, in units, that the powers allow; none where they are not finite.
    #[inline]
    fn longest<Z>(&self, tolerance: &Tolerance<'_>, z: Z) -> Option<f64>
    where
        Z: Components<Displacement = D>,
    {
        let order = self.order;
        // ‖zₚ₋ᵢ‖² for a step of one unit.
        let square = |i| tolerance.square_norm(z, z, self.terms[order - 1 - i] * self.unit);
        let mut squares = [0.0; DECIDE];
        for (i, size) in squares[..order.min(DECIDE)].iter_mut().enumerate() {
            *size = square(i);
        }
        let sum = squares.iter().sum::<f64>();
        if !sum.is_finite() {
            return None;
        }
        if sum == 0.0 {
            let last = (DECIDE..order).map(|i| (i, square(i))).find(|(_, size)| *size > 0.0);
            let longest = last.map_or(f64::INFINITY, |(i, size)| exp2(self.by_size(i, log2(size))));
            return Some(longest.min(GROW));
        }
        let logarithms = squares.map(log2);
        let mut longest = f64::INFINITY;
        for (i, &logarithm) in logarithms.iter().enumerate().take(order) {
            longest = longest.min(self.by_size(i, logarithm));
        }
        for i in 0..SPARE {
            // log₂ of the radius, by the ratios to the powers before.
            let mut radius = f64::NEG_INFINITY;
            for j in SPARE..DECIDE {
                if squares[j] > 0.0 {
                    radius = radius.max((logarithms[j] - logarithms[i]) * (0.5 / (j - i) as f64));
                }
            }
            if squares[i] > 0.0 && radius > f64::NEG_INFINITY {
                longest = longest.min(radius + SHARE - 2.0 / order as f64);
            }
        }
        Some(exp2(longest).min(GROW))
    }

    /// log₂ of the step, in units, in which the power p − i is eⁱ⁻² tolerances, where `logarithm`
    /// is log₂ of its square for a step of one unit.
    #[inline]
    fn by_size(&self, i: usize, logarithm: f64) -> f64 {
        let allowed = (i as f64 - SPARE as f64) * FALL;
        (allowed - 0.5 * logarithm) / (self.order - i) as f64
    }
}

/// The terms times the powers of x, in blocks. The first block, by far the largest, is added last,
/// so that the others are not lost to rounding one by one.
#[inline(always)]
fn sum<D: Vector>(terms: &[D], x: f64) -> D {
    let square = x * x;
    let fourth = square * square;
    let of_block = |[a, b, c, d]: &[D; BLOCK]| (*a + *b * x) + (*c + *d * x) * square;
    let (blocks, _) = terms.as_chunks::<BLOCK>();
    let [first, others @ ..] = blocks else { unreachable!("at least one block") };
    let mut power = 1.0;
    let rest = others.iter().map(|block| {
        power *= fourth;
        of_block(block) * power
    });
    let first = of_block(first);
    rest.reduce(|sum, block| sum + block).map_or(first, |rest| first + rest)
}

impl ChoosesSteps for TaylorSeries {}

impl<S: Analytic<State: Components>> Controlled<S> for TaylorSeries {
    type Memory = Expansion<RateOf<S>>;
    /// The unit of time of the step's series (s).
    type Record = f64;
    type Dense = Within<RateOf<S>>;

    fn begin(
        &self,
        system: &Counting<&S>,
        tolerance: &Tolerance<'_>,
        t: f64,
        z: S::State,
        duration: f64,
        _first: Option<f64>,
    ) -> Self::Memory {
        let slope = system.rate(t, z);
        let scale = time_scale(tolerance, z, slope).unwrap_or(f64::INFINITY);
        let unit = libm::copysign(libm::fmin(scale, libm::fabs(duration)), duration);
        let order = order(tolerance);
        Expansion {
            terms: [slope; MOST],
            order,
            root: -0.5 / (order - SPARE) as f64,
            unit,
            next_unit: unit,
            start: t,
            ahead: (f64::NAN, slope),
        }
    }

    /// The terms are made in the unit of the step before, so that they neither overflow nor
    /// underflow as long as steps change by less than a factor of 10⁸.
    #[inline]
    fn propose(
        &self,
        system: &Counting<&S>,
        tolerance: &Tolerance<'_>,
        series: &mut Self::Memory,
        t: f64,
        z: S::State,
    ) -> f64 {
        (series.start, series.unit) = (t, series.next_unit);
        loop {
            let longest =
                series.expand(system, tolerance, z).or_else(|| series.longest(tolerance, z));
            if let Some(longest) = longest {
                return series.unit * longest;
            }
            // No step is short enough, which the walk reports.
            if t + 0.1 * series.unit == t {
                return 0.0;
            }
            series.unit *= SHRINK;
        }
    }

    #[inline]
    fn attempt_step(
        &self,
        _system: &Counting<&S>,
        _tolerance: &Tolerance<'_>,
        series: &mut Self::Memory,
        Times { step, .. }: Times,
        z: S::State,
    ) -> Option<(S::State, Self::Record)> {
        let displacement = series.displacement(step);
        let end = z + displacement;
        // Only a state that overflows is refused.
        let mut is_finite = true;
        end.for_each_component(end, displacement, |x, _, _| is_finite &= x.is_finite());
        series.next_unit = if is_finite { step } else { SHRINK / GROW * step };
        is_finite.then_some((end, series.unit))
    }

    fn interpolant(
        &self,
        system: &Counting<&S>,
        tolerance: &Tolerance<'_>,
        series: &Self::Memory,
        Times { start, step, .. }: Times,
        z: S::State,
        unit: &f64,
    ) -> Self::Dense {
        let mut series = *series;
        // The walk has gone on, and has the series of a later step.
        if series.start != start {
            (series.start, series.unit) = (start, *unit);
            series.expand(system, tolerance, z);
        }
        Within { series, step }
    }
}

/// The series within a step.
#[derive(Clone, Copy, Debug)]
pub struct Within<D> {
    series: Expansion<D>,
    /// (s)
    step: f64,
}

impl<D: Vector> Interpolant<D> for Within<D> {
    fn displacement(&self, s: f64) -> Option<D> {
        Some(self.series.displacement(s * self.step))
    }
}
