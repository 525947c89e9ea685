//! When many double pendulums first turn over, in lanes.

use core::f64::consts::PI;
use core::marker::PhantomData;
use core::num::NonZeroU64;
use core::ops::{Add, Mul};

use super::block::LANES;
use super::instructions::{Instructions, Work, vectors};
use crate::arithmetic::lanes::Lanes;
use crate::arithmetic::number::Number;
use crate::integrate::{Grid, Method};
use crate::systems::{DoublePendulum, DoublePhase, Numbers, System, Vector};

/// The double pendulum with a [`Number`] for each of θ₁, θ₂, p₁, p₂: with lanes, one in each.
#[derive(Clone, Copy, Debug)]
#[doc(hidden)]
pub struct DoublePendulums<N> {
    double: DoublePendulum,
    numbers: PhantomData<N>,
}

/// θ₁, θ₂ (rad), p₁, p₂ (kg m²/s), or their rates of change.
#[derive(Clone, Copy, Debug)]
#[doc(hidden)]
pub struct DoublePhases<N>(pub [N; 4]);

impl<N> DoublePendulums<N> {
    /// Each of them `double`.
    pub const fn new(double: DoublePendulum) -> Self {
        Self { double, numbers: PhantomData }
    }
}

impl<N: Number> System for DoublePendulums<N> {
    type State = DoublePhases<N>;

    #[inline(always)]
    fn rate(&self, _t: f64, DoublePhases(z): DoublePhases<N>) -> DoublePhases<N> {
        DoublePhases(self.double.rates(z))
    }
}

impl<N: Number> Add for DoublePhases<N> {
    type Output = Self;

    #[inline(always)]
    fn add(self, Self([a, b, c, d]): Self) -> Self {
        let Self([theta1, theta2, p1, p2]) = self;
        Self([theta1 + a, theta2 + b, p1 + c, p2 + d])
    }
}

impl<N: Number> Mul<f64> for DoublePhases<N> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        Self(self.0.map(|x| x * factor))
    }
}

impl<N: Number> Vector for DoublePhases<N> {}

impl<N: Number> Numbers<N> for DoublePhases<N> {
    const COUNT: usize = 4;

    fn write(self, write: &mut impl FnMut(N)) {
        self.0.into_iter().for_each(write);
    }

    fn read(next: &mut impl FnMut() -> N) -> Self {
        Self(core::array::from_fn(|_| next()))
    }
}

/// Whether both rods are on their first way round, |θ₁| ≤ π and |θ₂| ≤ π. NaN is beyond.
#[inline(always)]
#[doc(hidden)]
pub fn is_below<N: Number>(DoublePhases([theta1, theta2, ..]): DoublePhases<N>) -> N::Mask {
    let pi = theta1.splat(PI);
    theta1.abs().at_most(pi) & theta2.abs().at_most(pi)
}

/// A method whose steps of the double pendulum can be taken in lanes, behind a pointer: an explicit
/// Runge–Kutta method.
///
/// With the feature `table` the library has those of RK4 compiled: `methods::table::RK4_IN_LANES`.
#[doc(hidden)]
pub trait DoubleInLanes: Sync {
    /// Takes the steps with these instructions.
    #[doc(hidden)]
    fn find_flips(&self, instructions: Instructions, flips: Flips<'_>);
}

impl<M> DoubleInLanes for M
where
    M: Method<DoublePendulums<vectors::OfBaseline>>
        + Method<DoublePendulums<vectors::OfAvx2>>
        + Method<DoublePendulums<vectors::OfAvx512>>
        + Method<DoublePendulums<vectors::OfAvx512InLongSteps>>
        + Sync,
{
    fn find_flips(&self, instructions: Instructions, flips: Flips<'_>) {
        instructions.run::<true, _>(Taking(self, flips));
    }
}

/// Writes for each of `starts` to `flips` the number of the first step of `method` along `grid`
/// after which a rod is past the upward vertical, |θ₁| > π or |θ₂| > π; `None` if both are below it
/// to the end. A start is not looked at.
///
/// Each has the bits of a run by itself. A lane that is done goes on with the next start.
///
/// ```
/// use pendula::fast::first_flips;
/// use pendula::systems::Joint;
/// use pendula::{DoublePendulum, Grid, Rk4};
///
/// let double = DoublePendulum::of_equals(9.81, Joint { length: 1.0, mass: 1.0 })?;
/// let starts = [1.0, 2.0, 3.0].map(|theta| double.start([theta, theta], [0.0; 2]));
/// let starts = starts.into_iter().collect::<Result<Vec<_>, _>>()?;
/// let mut flips = vec![None; 3];
/// first_flips(&double, &Rk4, &starts, &Grid::with_duration(0.01, 10.0)?, &mut flips);
/// // From 1 rad the energy does not suffice.
/// assert_eq!(flips[0], None);
/// assert!(flips[1].is_some() && flips[2].is_some());
/// # Ok::<(), pendula::Error>(())
/// ```
///
/// # Panics
/// If there are not as many slots as starts.
pub fn first_flips<M: DoubleInLanes + ?Sized>(
    double: &DoublePendulum,
    method: &M,
    starts: &[DoublePhase],
    grid: &Grid,
    flips: &mut [Option<NonZeroU64>],
) {
    first_flips_with(Instructions::Best, double, method, starts, grid, flips);
}

/// The same with these instructions: to show that the bits are the same.
///
/// # Panics
/// As [`first_flips`].
#[doc(hidden)]
pub fn first_flips_with<M: DoubleInLanes + ?Sized>(
    instructions: Instructions,
    double: &DoublePendulum,
    method: &M,
    starts: &[DoublePhase],
    grid: &Grid,
    flips: &mut [Option<NonZeroU64>],
) {
    assert_eq!(flips.len(), starts.len(), "one slot for each start");
    let one = |(starts, flips): (&[DoublePhase], &mut [Option<NonZeroU64>])| {
        method.find_flips(instructions, Flips { double: *double, starts, grid, flips });
    };
    #[cfg(feature = "parallel")]
    {
        use rayon::prelude::*;
        starts.par_chunks(CHUNK).zip(flips.par_chunks_mut(CHUNK)).for_each(one);
    }
    #[cfg(not(feature = "parallel"))]
    starts.chunks(CHUNK).zip(flips.chunks_mut(CHUNK)).for_each(one);
}

/// Starts that a core takes at a time: so many that its lanes are seldom idle at the end.
const CHUNK: usize = 4096;

/// Steps between two looks at which lanes are done.
const BLOCK: u64 = 64;

/// What [`first_flips`] is asked for.
#[derive(Debug)]
pub struct Flips<'a> {
    double: DoublePendulum,
    starts: &'a [DoublePhase],
    grid: &'a Grid,
    flips: &'a mut [Option<NonZeroU64>],
}

/// What is in a lane: the index of the start, the numbers of the state, and the steps taken.
#[derive(Clone, Copy)]
struct Lane {
    start: usize,
    state: [f64; 4],
    taken: u64,
}

/// What is asked for, and the method that takes the steps.
struct Taking<'a, 'b, M>(&'a M, Flips<'b>);

impl<N: Lanes, M: Method<DoublePendulums<N>>> Work<N> for Taking<'_, '_, M> {
    #[inline(always)]
    fn run<const TEAM: usize>(self, simd: N::Simd) {
        let Self(method, Flips { double, starts, grid, flips }) = self;
        let (system, h) = (DoublePendulums::<N>::new(double), grid.step());
        let mut starts = starts.iter().enumerate();
        let mut lanes = [None; LANES];
        loop {
            for lane in lanes[..N::COUNT].iter_mut().filter(|lane| lane.is_none()) {
                *lane = starts.next().map(|(start, z)| {
                    let state = [z.theta1, z.theta2, z.p1, z.p2];
                    Lane { start, state, taken: 0 }
                });
            }
            if lanes[..N::COUNT].iter().all(Option::is_none) {
                return;
            }
            let column = |of: usize| {
                N::from_lanes(simd, |lane| lanes[lane].map_or(0.0, |lane: Lane| lane.state[of]))
            };
            let mut z = DoublePhases(core::array::from_fn(column));
            let mut carry = method.start(&system, 0.0, h, z);
            // 1 while both rods are below, 0 from the first flip on; and the number of steps after
            // which they were.
            let zero = z.0[0].splat(0.0);
            let (mut below, mut steps) = (zero + 1.0, zero);
            for _ in 0..BLOCK {
                z = method.step(&system, 0.0, h, z, &mut carry);
                below = N::select(is_below(z), below, zero);
                steps = steps + below;
            }
            for (index, slot) in lanes[..N::COUNT].iter_mut().enumerate() {
                let Some(lane) = slot else { continue };
                lane.state = z.0.map(|column| column.lane(index));
                lane.taken += steps.lane(index) as u64;
                let is_over = lane.taken >= grid.steps();
                if is_over || below.lane(index) == 0.0 {
                    let flip = NonZeroU64::new(lane.taken + 1).filter(|_| !is_over);
                    flips[lane.start] = flip;
                    *slot = None;
                }
            }
        }
    }
}
