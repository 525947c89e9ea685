//! A block of lanes, and the loop over its steps.

use core::fmt::Debug;

use multiversion::multiversion;

use super::{Deferred, ReducedRate};
use crate::integrate::Method;
use crate::methods::Rotating;
use crate::systems::Phase;

/// The pendulum and its state with branchless reduction of the angle.
pub type ScaledPendulum = super::ScaledPendulum<false>;
type ReducedPhase = super::ReducedPhase<false>;

/// Pendulums in a block: enough for the sines of some to hide the latency of others, and few enough
/// for all that a step carries to the next to stay in the L1 cache.
pub const LANES: usize = 32;

/// Up to six numbers for each lane, one array for each.
pub type Columns = [[f64; LANES]; 6];

/// What can be stored in columns: the state, and the carry of a method.
pub trait Lane: Copy {
    /// Whether a method with this carry needs nothing else for its next step, not even the last
    /// state.
    const SUFFICES: bool;

    /// Loads it from its lane.
    fn load(columns: &Columns, lane: usize) -> Self;

    /// Stores it in its lane.
    fn store(self, columns: &mut Columns, lane: usize);
}

impl Lane for () {
    const SUFFICES: bool = false;

    #[inline(always)]
    fn load(_columns: &Columns, _lane: usize) {}

    #[inline(always)]
    fn store(self, _columns: &mut Columns, _lane: usize) {}
}

impl Lane for ReducedPhase {
    const SUFFICES: bool = true;

    #[inline(always)]
    fn load(columns: &Columns, lane: usize) -> Self {
        let [rest, turns, sum, factor, series, _] = columns.each_ref().map(|column| column[lane]);
        Self { rest, turns, velocity: Deferred { sum, factor, series } }
    }

    #[inline(always)]
    fn store(self, columns: &mut Columns, lane: usize) {
        let Deferred { sum, factor, series } = self.velocity;
        for (column, x) in columns.iter_mut().zip([self.rest, self.turns, sum, factor, series]) {
            column[lane] = x;
        }
    }
}

impl Lane for Rotating<ReducedPhase> {
    const SUFFICES: bool = true;

    #[inline(always)]
    fn load(columns: &Columns, lane: usize) -> Self {
        Self { ahead: ReducedPhase::load(columns, lane), kick: columns[5][lane] }
    }

    #[inline(always)]
    fn store(self, columns: &mut Columns, lane: usize) {
        self.ahead.store(columns, lane);
        columns[5][lane] = self.kick;
    }
}

impl Lane for ReducedRate {
    const SUFFICES: bool = false;

    #[inline(always)]
    fn load(columns: &Columns, lane: usize) -> Self {
        let [s, f, r, sum, factor, series] = columns.each_ref().map(|column| column[lane]);
        let angle = Deferred { sum: s, factor: f, series: r };
        Self { angle, velocity: Deferred { sum, factor, series } }
    }

    #[inline(always)]
    fn store(self, columns: &mut Columns, lane: usize) {
        let Self { angle, velocity } = self;
        let numbers =
            [angle.sum, angle.factor, angle.series, velocity.sum, velocity.factor, velocity.series];
        for (column, x) in columns.iter_mut().zip(numbers) {
            column[lane] = x;
        }
    }
}

/// Which vector instructions the steps are compiled to. It is a type, so that a program compiles
/// those that it uses and no others. The bits are the same; the time is not.
pub trait Instructions: Copy + Debug + Default + Send + Sync {
    /// Takes `steps` steps in every lane of `block`.
    #[doc(hidden)]
    fn advance<M>(block: &mut Block, method: &M, steps: u64)
    where
        M: Method<ScaledPendulum, Carry: Lane>;
}

/// The states of a block of pendulums and the carries of their method. Aligned to cache lines, as a
/// load that crosses two of them takes twice as long.
#[repr(align(64))]
pub struct Block {
    minus_k: [f64; LANES],
    step: f64,
    state: Columns,
    carry: Columns,
}

impl Block {
    /// A block that begins at `starts`, at most [`LANES`] of them.
    pub fn new<M: Method<ScaledPendulum, Carry: Lane>>(
        method: &M,
        starts: impl Iterator<Item = (ScaledPendulum, Phase)>,
    ) -> Self {
        let zero = [[0.0; LANES]; 6];
        let mut block = Self { minus_k: [0.0; LANES], step: 1.0, state: zero, carry: zero };
        for (lane, (scaled, start)) in starts.enumerate() {
            (block.minus_k[lane], block.step) = (scaled.minus_k, scaled.step);
            let z = scaled.from_phase(start);
            z.store(&mut block.state, lane);
            method.start(&scaled, 0.0, 1.0, z).store(&mut block.carry, lane);
        }
        block
    }

    /// The state of a lane (rad, rad/s).
    #[inline]
    pub fn state(&self, lane: usize) -> Phase {
        let scaled = ScaledPendulum { minus_k: self.minus_k[lane], step: self.step };
        scaled.to_phase(ReducedPhase::load(&self.state, lane))
    }
}

macro_rules! instructions {
    ($($(#[$doc:meta])* $Name:ident, $name:ident for [$($target:literal),*],)+) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default)]
        pub struct $Name;

        impl Instructions for $Name {
            fn advance<M>(block: &mut Block, method: &M, steps: u64)
            where
                M: Method<ScaledPendulum, Carry: Lane>,
            {
                $name(block, method, steps);
            }
        }

        // A program compiled for AVX2 needs no second version for it.
        #[allow(dead_code)]
        #[multiversion(targets($($target),*))]
        fn $name<M>(block: &mut Block, method: &M, steps: u64)
        where
            M: Method<ScaledPendulum, Carry: Lane>,
        {
            steps_in_lanes(block, method, steps);
        }
    )+};
}
instructions! {
    /// The best the processor has.
    Best, best for ["x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2", "x86_64+avx"],
    /// What the program was compiled for: SSE2 on a plain x86-64.
    Baseline, baseline for [],
    /// AVX2 if the processor has it, and otherwise the baseline.
    Avx2, avx2 for ["x86_64+avx2"],
    /// AVX-512 if the processor has it, and otherwise the baseline.
    Avx512, avx512 for ["x86_64+avx512f+avx512dq+avx512vl"],
}

#[inline(always)]
fn steps_in_lanes<M: Method<ScaledPendulum, Carry: Lane>>(
    block: &mut Block,
    method: &M,
    steps: u64,
) {
    let Some(but_last) = steps.checked_sub(1) else { return };
    for _ in 0..but_last {
        step_in_lanes(block, method, !M::Carry::SUFFICES);
    }
    step_in_lanes(block, method, true);
}

/// One step in every lane; `keep` says whether the states are stored.
#[inline(always)]
fn step_in_lanes<M: Method<ScaledPendulum, Carry: Lane>>(
    block: &mut Block,
    method: &M,
    keep: bool,
) {
    let Block { minus_k, step, state, carry } = block;
    #[expect(clippy::needless_range_loop, reason = "every column is indexed by the lane")]
    for lane in 0..LANES {
        let scaled = ScaledPendulum { minus_k: minus_k[lane], step: *step };
        let mut remembered = M::Carry::load(carry, lane);
        // A step of length 1 at time 0: the pendulum is autonomous.
        let z = ReducedPhase::load(state, lane);
        let z = method.step(&scaled, 0.0, 1.0, z, &mut remembered);
        if keep {
            z.store(state, lane);
        }
        remembered.store(carry, lane);
    }
}
