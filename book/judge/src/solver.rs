//! What is judged by its tolerance: anything that maps a state to the states at given times, with
//! steps of its own choice.

use core::fmt;
use core::time::Duration;
use std::sync::LazyLock;
use std::time::Instant;

use pendula::adaptive::{Adaptive, Controlled, Direction, Tolerance};
use pendula::systems::{Driven, Pendulum, Phase, System};

use super::integrator::{Drive, Fault, Reply, driven};

/// A run that a solver is asked for: θ̈ + (g/L) sin θ = 0, or with a drive.
///
/// ```
/// use pendula::{Phase, methods::Dop853};
/// use pendula_judge::{ByTolerance, SolveRequest, Solver};
///
/// // Where the pendulum from 2 rad is after 2.5, 5 and 10 s.
/// let times = [2.5, 5.0, 10.0];
/// let request = SolveRequest::new(9.81, Phase::at_rest(2.0), 1e-8).to(&times);
/// let reply = ByTolerance::new(Dop853).solve(&request).expect("the numbers are in range");
/// assert_eq!(reply.states.len(), 3);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct SolveRequest {
    /// g/L (1/s²).
    pub g_over_l: f64,
    /// The drive, A cos Ωt, if there is one.
    pub drive: Option<Drive>,
    /// The state at t₀ (rad, rad/s).
    pub start: Phase,
    /// The time t₀ of the start (s).
    pub from: f64,
    /// The tolerance: relative, and absolute for θ (rad); for ω absolute times √(g/L).
    pub tolerance: f64,
    /// The times (s) at which states are asked for, in the order of the run: all of them after t₀
    /// or at it, or all before. Some may be equal.
    pub times: Vec<f64>,
}

impl SolveRequest {
    /// From `start` at t = 0 with this `tolerance`, of the pendulum of this g/L (1/s²), which is
    /// not driven. Nothing is asked for yet.
    pub const fn new(g_over_l: f64, start: Phase, tolerance: f64) -> Self {
        Self { g_over_l, drive: None, start, from: 0.0, tolerance, times: Vec::new() }
    }

    /// The same, asked for the states at these `times` (s).
    #[must_use]
    pub fn to(self, times: &[f64]) -> Self {
        Self { times: times.to_vec(), ..self }
    }

    /// The same, with the start at the time `from` (s).
    #[must_use]
    pub fn from(self, from: f64) -> Self {
        Self { from, ..self }
    }

    /// The same under `drive`.
    #[must_use]
    pub fn driven(self, drive: Drive) -> Self {
        Self { drive: Some(drive), ..self }
    }
}

/// The line of the protocol that asks for it.
impl fmt::Display for SolveRequest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { g_over_l, drive, start: Phase { theta, omega }, from, tolerance, times } = self;
        match drive {
            None => write!(f, "solve {g_over_l:?}")?,
            Some(Drive { amplitude, frequency }) => {
                write!(f, "driven-solve {g_over_l:?} {amplitude:?} {frequency:?}")?;
            }
        }
        write!(f, " {theta:?} {omega:?} {from:?} {tolerance:?}")?;
        times.iter().try_for_each(|t| write!(f, " {t:?}"))
    }
}

/// A run on which a solver is asked where θ passes zero, either way.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct CrossingsRequest {
    /// g/L (1/s²).
    pub g_over_l: f64,
    /// The state at t₀ (rad, rad/s).
    pub start: Phase,
    /// The times t₀ and t₁ of start and end (s).
    pub span: [f64; 2],
    /// The tolerance, as in [`SolveRequest`].
    pub tolerance: f64,
}

impl CrossingsRequest {
    /// From `start` at the first time of `span` to the second (s), with this `tolerance`.
    pub const fn new(g_over_l: f64, start: Phase, span: [f64; 2], tolerance: f64) -> Self {
        Self { g_over_l, start, span, tolerance }
    }
}

/// The line of the protocol that asks for it.
impl fmt::Display for CrossingsRequest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { g_over_l, start: Phase { theta, omega }, span: [from, until], tolerance } = self;
        write!(f, "crossings {g_over_l:?} {theta:?} {omega:?} {from:?} {until:?} {tolerance:?}")
    }
}

/// Passages of θ through zero, in order: the time (s) and the state of each.
pub type Crossings = Vec<(f64, Phase)>;

/// A solver to be judged. Each request starts afresh.
pub trait Solver {
    /// The states at the times that the request asks for.
    ///
    /// # Errors
    /// A [`Fault`] says why there are none.
    fn solve(&self, request: &SolveRequest) -> Result<Reply, Fault>;

    /// Where θ passes zero.
    ///
    /// # Errors
    /// A [`Fault`] says why nothing is told; [`Fault::Unsupported`] of a solver that finds no
    /// crossings.
    fn crossings(&self, request: &CrossingsRequest) -> Result<Crossings, Fault> {
        let _ = request;
        Err(Fault::Unsupported)
    }

    /// How long an answer may take: the judge asks for smaller tolerances as long as it can expect
    /// them in a quarter of it.
    fn patience(&self) -> Duration {
        Duration::from_secs(10)
    }

    /// Whether it may be asked what a right solver may never answer, such as for a tolerance of
    /// zero: a program may, which is ended when it is late. A function cannot be ended, and is
    /// asked only if it is [claimed](crate::Claims::refuses) that it refuses.
    fn may_hang(&self) -> bool {
        false
    }

    /// The time by which the judge sees how long answers take, since some moment: that of the
    /// machine. A solver of a test counts its work instead, so that what is said of it does not
    /// depend on what else the machine does.
    #[doc(hidden)]
    fn clock(&self) -> Duration {
        static BEGUN: LazyLock<Instant> = LazyLock::new(Instant::now);
        BEGUN.elapsed()
    }
}

// -------------------------------------------------------------------------------------------------
// The library's
// -------------------------------------------------------------------------------------------------

type Drives<M> = fn(&Adaptive<M>, &Driven, &SolveRequest) -> Result<Reply, Fault>;

/// A method of the library that chooses its steps.
pub struct ByTolerance<M> {
    method: M,
    driven: Option<Drives<M>>,
}

impl<M> fmt::Debug for ByTolerance<M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ByTolerance").field("is_driven", &self.driven.is_some()).finish()
    }
}

impl<M: Controlled<Pendulum> + Controlled<Driven>> ByTolerance<M> {
    /// `method`, which can be driven.
    pub const fn new(method: M) -> Self {
        Self { method, driven: Some(states_at) }
    }
}

impl<M: Controlled<Pendulum>> ByTolerance<M> {
    /// `method`, which is not asked for a driven pendulum.
    pub const fn undriven(method: M) -> Self {
        Self { method, driven: None }
    }

    /// It with the tolerance of a request. The absolute tolerance of the library is one number for
    /// all components, here the smaller of those for θ and ω.
    fn adaptive(&self, pendulum: &Pendulum, tolerance: f64) -> Result<Adaptive<'static, M>, Fault> {
        let smaller = tolerance * libm::fmin(1.0, pendulum.small_angle_frequency());
        let tolerance = Tolerance::new(smaller, tolerance).map_err(refused)?;
        Ok(Adaptive::new(self.method, tolerance))
    }
}

fn refused(error: pendula::Error) -> Fault {
    Fault::Refused(error.to_string())
}

/// The states at the times of a request.
fn states_at<S, M>(
    adaptive: &Adaptive<M>,
    system: &S,
    request: &SolveRequest,
) -> Result<Reply, Fault>
where
    S: System<State = Phase>,
    M: Controlled<S>,
{
    let until = request.times.last().copied().unwrap_or(request.from);
    let mut walk = adaptive.steps(system, request.start, request.from, until).map_err(refused)?;
    let states = walk.states_at(request.times.iter().copied()).collect::<Result<_, _>>();
    let states = states.map_err(refused)?;
    Ok(Reply { states, evaluations: Some(walk.counts().evaluations) })
}

impl<M: Controlled<Pendulum>> Solver for ByTolerance<M> {
    fn solve(&self, request: &SolveRequest) -> Result<Reply, Fault> {
        let pendulum = Pendulum::new(request.g_over_l, 1.0, 1.0).map_err(refused)?;
        let adaptive = self.adaptive(&pendulum, request.tolerance)?;
        match (request.drive, self.driven) {
            (None, _) => states_at(&adaptive, &pendulum, request),
            (Some(drive), Some(states_at)) => {
                states_at(&adaptive, &driven(pendulum, drive)?, request)
            }
            (Some(_), None) => Err(Fault::Unsupported),
        }
    }

    fn crossings(&self, request: &CrossingsRequest) -> Result<Crossings, Fault> {
        let CrossingsRequest { g_over_l, start, span: [from, until], tolerance } = *request;
        let pendulum = Pendulum::new(g_over_l, 1.0, 1.0).map_err(refused)?;
        let adaptive = self.adaptive(&pendulum, tolerance)?;
        let mut walk = adaptive.steps(&pendulum, start, from, until).map_err(refused)?;
        let all = walk.crossings(Direction::Either, |_, z: Phase| z.theta);
        all.map(|found| found.map(|found| (found.t, found.z)).map_err(refused)).collect()
    }

    /// It refuses all that is impossible.
    fn may_hang(&self) -> bool {
        true
    }
}

// -------------------------------------------------------------------------------------------------
// Functions
// -------------------------------------------------------------------------------------------------

/// What a function returns that solves: the pairs (θ, ω), with the number of force evaluations or
/// without; or an error and its reason.
pub trait IntoReply {
    /// As a reply.
    ///
    /// # Errors
    /// [`Fault::Refused`] with the reason.
    fn into_reply(self) -> Result<Reply, Fault>;
}

impl IntoReply for Vec<(f64, f64)> {
    fn into_reply(self) -> Result<Reply, Fault> {
        let states = self.into_iter().map(|(theta, omega)| Phase { theta, omega }).collect();
        Ok(Reply { states, evaluations: None })
    }
}

impl IntoReply for (Vec<(f64, f64)>, u64) {
    fn into_reply(self) -> Result<Reply, Fault> {
        Ok(Reply { evaluations: Some(self.1), ..self.0.into_reply()? })
    }
}

impl<R: IntoReply, E: fmt::Display> IntoReply for Result<R, E> {
    fn into_reply(self) -> Result<Reply, Fault> {
        self.map_err(|why| Fault::Refused(why.to_string()))?.into_reply()
    }
}

/// A solver that is a function of g/L (1/s²), θ (rad), ω (rad/s), t₀ (s), the tolerance and the
/// times (s), which returns a pair (θ, ω) for each of them: see [`IntoReply`]. If it is
/// [claimed](crate::Claims::refuses) that it refuses the impossible (a tolerance of zero, a time
/// that never comes), it is asked for that too, and has to answer it with an error.
///
/// A function cannot be interrupted: one that never returns keeps its caller. Many solvers never
/// return from a run backwards; of those [`Claims::forward_only`](crate::Claims::forward_only) is
/// claimed.
#[derive(Clone, Copy)]
pub struct SolveFn<F>(pub F);

impl<F> fmt::Debug for SolveFn<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("SolveFn").finish_non_exhaustive()
    }
}

impl<F, R> Solver for SolveFn<F>
where
    F: Fn(f64, f64, f64, f64, f64, &[f64]) -> R,
    R: IntoReply,
{
    fn solve(&self, request: &SolveRequest) -> Result<Reply, Fault> {
        if request.drive.is_some() {
            return Err(Fault::Unsupported);
        }
        let SolveRequest { g_over_l, start: Phase { theta, omega }, from, tolerance, .. } =
            *request;
        (self.0)(g_over_l, theta, omega, from, tolerance, &request.times).into_reply()
    }
}
