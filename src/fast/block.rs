//! A block of pendulums in lanes, and the loop over its steps.

use core::fmt;
use core::ops::ControlFlow;

use super::deferred::Deferred;
use super::instructions::Work;
use super::{ReducedPhase, ScaledPendulum};
use crate::arithmetic::lanes::Lanes;
use crate::integrate::Method;
use crate::systems::Phase;

/// Pendulums in a block: enough for the sines of some to hide the latency of others.
pub const LANES: usize = 32;

/// Up to [`LANES`] pendulums and the steps that they take together. It knows neither the method nor
/// the observers, so that the steps of a method are compiled once, whoever looks at them.
pub struct Block<'a> {
    /// The pendulums and where they begin, at least one; the last of them fills the idle lanes.
    pub(super) starts: &'a [(ScaledPendulum, ReducedPhase)],
    /// The number of steps.
    pub(super) steps: u64,
    /// Every k-th state is asked for.
    pub(super) every: u64,
    pub(super) each: &'a mut Each<'a>,
}

impl fmt::Debug for Block<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { starts, steps, every, .. } = self;
        f.debug_struct("Block")
            .field("starts", starts)
            .field("steps", steps)
            .field("every", every)
            .finish_non_exhaustive()
    }
}

/// What is told the number of steps taken and the states then, and may end the run.
pub type Each<'a> = dyn FnMut(u64, &[Phase; LANES]) -> ControlFlow<()> + 'a;

/// Pendulums in a vector, and what a step carries to the next.
#[derive(Clone, Copy)]
struct Group<N, C> {
    system: ScaledPendulum<N>,
    state: ReducedPhase<N>,
    carry: C,
}

/// A block and the method that takes its steps.
pub(super) struct Taking<'a, 'b, M>(pub &'a M, pub Block<'b>);

impl<N: Lanes, M: Method<ScaledPendulum<N>>> Work<N> for Taking<'_, '_, M> {
    /// Takes the steps and passes the number of steps taken and the states then to `each`, until it
    /// breaks.
    ///
    /// A team of `TEAM` groups takes its steps side by side, so that they overlap.
    #[inline(always)]
    fn run<const TEAM: usize>(self, simd: N::Simd) {
        let Self(method, block) = self;
        let mut groups = [const { None }; LANES];
        let used = block.starts.len().div_ceil(N::COUNT * TEAM) * TEAM;
        for (index, group) in groups[..used].iter_mut().enumerate() {
            *group = Some(block.group(method, simd, index * N::COUNT));
        }
        let mut phases = [Phase::default(); LANES];
        let mut n = 0;
        while block.steps - n >= block.every {
            for team in groups[..used].chunks_exact_mut(TEAM) {
                advance::<N, M, TEAM>(method, block.every, team);
            }
            n += block.every;
            for (group, phases) in groups.iter().flatten().zip(phases.chunks_exact_mut(N::COUNT)) {
                let (theta, omega) = group.system.angle_and_velocity(group.state);
                for (lane, phase) in phases.iter_mut().enumerate() {
                    *phase = Phase { theta: theta.lane(lane), omega: omega.lane(lane) };
                }
            }
            if (block.each)(n, &phases).is_break() {
                return;
            }
        }
    }
}

impl Block<'_> {
    /// The pendulums from the one of index `first` on, before the first step.
    #[inline(always)]
    fn group<N: Lanes, M: Method<ScaledPendulum<N>>>(
        &self,
        method: &M,
        simd: N::Simd,
        first: usize,
    ) -> Group<N, M::Carry> {
        let last = self.starts.len() - 1;
        let start = |lane: usize| self.starts[last.min(first + lane)];
        let column = |of: fn((ScaledPendulum, ReducedPhase)) -> f64| {
            N::from_lanes(simd, |lane| of(start(lane)))
        };
        let system = ScaledPendulum {
            minus_k: column(|(system, _)| system.minus_k),
            step: self.starts[0].0.step,
        };
        let state = ReducedPhase {
            rest: column(|(_, z)| z.rest),
            turns: column(|(_, z)| z.turns),
            velocity: Deferred::from(column(|(_, z)| z.velocity.value())),
        };
        Group { system, state, carry: method.start(&system, 0.0, 1.0, state) }
    }
}

/// Takes the steps up to the next state that is asked for.
#[inline(always)]
fn advance<N: Lanes, M: Method<ScaledPendulum<N>>, const TEAM: usize>(
    method: &M,
    steps: u64,
    team: &mut [Option<Group<N, M::Carry>>],
) {
    const { assert!(TEAM == 1 || TEAM == 2) };
    let used = "the groups of a team are all in use";
    // Copies, which the compiler can keep in registers, and of which it removes what nobody reads;
    // in an array of two it would not.
    let mut first = team[0].expect(used);
    if TEAM == 1 {
        for _ in 0..steps {
            first.step(method);
        }
    } else {
        let mut second = team[1].expect(used);
        for _ in 0..steps {
            first.step(method);
            second.step(method);
        }
        team[1] = Some(second);
    }
    team[0] = Some(first);
}

impl<N: Lanes, C: Copy> Group<N, C> {
    #[inline(always)]
    fn step<M: Method<ScaledPendulum<N>, Carry = C>>(&mut self, method: &M) {
        self.state = method.step(&self.system, 0.0, 1.0, self.state, &mut self.carry);
    }
}
