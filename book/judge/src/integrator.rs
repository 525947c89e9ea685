//! What is judged: anything that maps a state to the states some steps later.

use core::fmt;
use core::num::NonZeroU64;

use pendula::systems::{Counting, Damped, Driven, Phase, System};
use pendula::{AnyMethod, Grid, Method, Pendulum, method_named};

/// A cosine drive, θ̈ + (g/L) sin θ = A cos Ωt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// Amplitude A (1/s²).
    pub amplitude: f64,
    /// Angular frequency Ω (1/s).
    pub frequency: f64,
}

/// A run that an integrator is asked for: θ̈ + (g/L) sin θ = 0, or with a drive, from t = 0.
///
/// ```
/// use pendula_judge::{Request, Integrator};
/// use pendula::{Phase, StormerVerlet};
///
/// // Ten seconds of the pendulum from 1 rad, a state each second.
/// let request = Request::new(9.81, Phase::at_rest(1.0), 0.01, 1000).every(100);
/// let reply = StormerVerlet.answer(&request).expect("all methods answer it");
/// assert_eq!((reply.states.len(), reply.evaluations), (10, Some(1001)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Request {
    /// g/L (1/s²).
    pub g_over_l: f64,
    /// The drive, if there is one.
    pub drive: Option<Drive>,
    /// The state at t = 0 (rad, rad/s).
    pub start: Phase,
    /// The step h (s). Negative, it leads back.
    pub step: f64,
    /// The number n of steps.
    pub steps: u64,
    /// The states after k, 2k, … n steps are asked for; k divides n.
    pub every: u64,
}

/// The most steps of a request that a method of the library, or a function, is asked for: some ten
/// seconds.
const MOST_STEPS: u64 = 1_000_000_000;
/// The most states of an answer of theirs, which are kept until it is known that there is one.
const MOST_STATES: u64 = 10_000_000;

impl Request {
    /// `steps` steps of `step` (s) from `start`, of the pendulum of this g/L (1/s²), which is not
    /// driven; each state is asked for.
    pub const fn new(g_over_l: f64, start: Phase, step: f64, steps: u64) -> Self {
        Self { g_over_l, drive: None, start, step, steps, every: 1 }
    }

    /// The same under `drive`.
    #[must_use]
    pub const fn driven(self, drive: Drive) -> Self {
        Self { drive: Some(drive), ..self }
    }

    /// The same, of which every k-th state is asked for, where k is `every`.
    #[must_use]
    pub const fn every(self, every: u64) -> Self {
        Self { every, ..self }
    }

    /// The number of states that the answer has; 0 if k is 0.
    pub const fn states(&self) -> u64 {
        match self.every {
            0 => 0,
            every => self.steps / every,
        }
    }

    /// A fault that says what is allowed, if a number is out of its range. g/L and the drive are
    /// checked by the system.
    pub(crate) fn check(&self) -> Result<(), Fault> {
        let Self { start: Phase { theta, omega }, step, steps, every, .. } = *self;
        let why = if !(theta.is_finite() && omega.is_finite()) {
            format!("θ = {theta:?}, ω = {omega:?}: the start must be finite")
        } else if !step.is_finite() || step == 0.0 {
            format!("h = {step:?}: it must be finite and not zero")
        } else if steps == 0 || every == 0 || !steps.is_multiple_of(every) {
            format!("n = {steps}, k = {every}: they must be 1 or more, and k divide n")
        } else if steps > MOST_STEPS {
            format!("more than {MOST_STEPS} steps")
        } else if self.states() > MOST_STATES {
            format!("more than {MOST_STATES} states")
        } else {
            return Ok(());
        };
        Err(Fault::Refused(why))
    }
}

/// The line of the protocol that asks for it.
impl fmt::Display for Request {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { g_over_l, drive, start: Phase { theta, omega }, step, steps, every } = self;
        match drive {
            None => write!(f, "pendulum {g_over_l:?}")?,
            Some(Drive { amplitude, frequency }) => {
                write!(f, "driven {g_over_l:?} {amplitude:?} {frequency:?}")?;
            }
        }
        write!(f, " {theta:?} {omega:?} {step:?} {steps} {every}")
    }
}

/// What an integrator answers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reply {
    /// The states after k, 2k, … n steps (rad, rad/s); θ counts turns.
    pub states: Vec<Phase>,
    /// Force evaluations of this request, where somebody counts.
    pub evaluations: Option<u64>,
}

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Fault {
    /// The integrator does not know this kind of request.
    Unsupported,
    /// The integrator refuses this request, and says why.
    Refused(String),
    /// No answer that can be used: it was late, was none, or ended the integrator, which begins
    /// anew. Other requests may be answered.
    Lost(String),
    /// The integrator broke the protocol: nothing more can be asked of it.
    Broken(String),
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unsupported => f.write_str("this kind of request is not known"),
            Self::Refused(why) => write!(f, "the request is refused: {why}"),
            Self::Lost(why) => write!(f, "no answer that can be used: {why}"),
            Self::Broken(why) => write!(f, "the protocol is broken: {why}"),
        }
    }
}

impl core::error::Error for Fault {}

#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot be asked for the states that the judge needs",
    note = "a method is judged if it is one for every system: `impl<S: System> Method<S>`",
    note = "a function for one step is judged as `FromStep::new(|force, theta, omega, h| …)`",
    note = "a function for a whole run, of (g/L, θ, ω, h, n), is judged as `FromFn(function)`"
)]
/// An integrator to be judged. Each request starts afresh.
pub trait Integrator {
    /// The states that the request asks for.
    ///
    /// # Errors
    /// A [`Fault`] says why there are none. Methods of the library, and functions, refuse numbers
    /// that are out of range, more than a billion steps, and more than ten million states.
    fn answer(&self, request: &Request) -> Result<Reply, Fault>;

    /// The most steps of a request that it answers in time. Of the runs of more than 2000 steps the
    /// judge asks for no longer ones, and says what it cannot tell without.
    fn longest_run(&self) -> u64 {
        u64::MAX
    }
}

/// Every method for the pendulum and the driven pendulum.
#[diagnostic::do_not_recommend]
impl<M: Method<Counting<Pendulum>> + Method<Counting<Driven>>> Integrator for M {
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        request.check()?;
        let pendulum = pendulum(request)?;
        let Some(drive) = request.drive else {
            let (states, evaluations) = states(self, &pendulum, request);
            return Ok(Reply { states, evaluations: Some(evaluations) });
        };
        let (states, _) = states(self, &driven(pendulum, drive)?, request);
        Ok(Reply { states, evaluations: None })
    }
}

/// The states that are asked for, and the force evaluations. The steps may be negative, which those
/// of a [`Grid`] cannot be. After a step that has no solution there are no numbers.
fn states<S, M>(method: &M, system: &S, request: &Request) -> (Vec<Phase>, u64)
where
    S: System<State = Phase> + Copy,
    M: Method<Counting<S>>,
{
    let (system, h) = (Counting::new(*system), request.step);
    let mut z = request.start;
    let mut carry = method.start(&system, 0.0, h, z);
    let mut states = vec![NOTHING; request.states() as usize];
    for n in 0..request.steps {
        match method.try_step(&system, n as f64 * h, h, z, &mut carry) {
            Ok(next) => z = next,
            Err(_) => break,
        }
        if (n + 1) % request.every == 0 {
            states[(n / request.every) as usize] = z;
        }
    }
    (states, system.evaluations())
}

/// After a step that has no solution.
pub(crate) const NOTHING: Phase = Phase { theta: f64::NAN, omega: f64::NAN };

pub(crate) fn pendulum(request: &Request) -> Result<Pendulum, Fault> {
    Pendulum::new(request.g_over_l, 1.0, 1.0).map_err(|error| Fault::Refused(error.to_string()))
}

/// `pendulum` without damping, under `drive`.
pub(crate) fn driven(pendulum: Pendulum, drive: Drive) -> Result<Driven, Fault> {
    let driven = Damped::new(pendulum, 0.0).and_then(|undamped| {
        Driven::new(undamped, drive.amplitude / pendulum.frequency_squared(), drive.frequency)
    });
    driven.map_err(|error| Fault::Refused(error.to_string()))
}

/// A method that is chosen at run time. For negative steps the velocity is reversed on the way: a
/// pendulum's motion back in time is its motion with the velocity reversed, and so is that of one
/// driven by a cosine.
#[derive(Clone, Copy, Debug)]
pub struct Chosen<'a> {
    /// On the pendulum.
    pub pendulum: &'a dyn AnyMethod,
    /// On the driven pendulum, if it is a method for that too.
    pub driven: Option<&'a dyn AnyMethod<Driven>>,
}

impl<'a> Chosen<'a> {
    /// The method that is known on the pendulum alone.
    pub const fn new(pendulum: &'a dyn AnyMethod) -> Self {
        Self { pendulum, driven: None }
    }

    /// The method of that [name](pendula::MethodInfo::name).
    pub fn named(name: &str) -> Option<Chosen<'static>> {
        Some(Chosen { pendulum: method_named(name)?, driven: method_named(name) })
    }
}

impl Integrator for Chosen<'_> {
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        request.check()?;
        let pendulum = pendulum(request)?;
        let Some(drive) = request.drive else {
            let (states, evaluations) = chosen_states(self.pendulum, &pendulum, request)?;
            return Ok(Reply { states, evaluations: Some(evaluations) });
        };
        let method = self.driven.ok_or(Fault::Unsupported)?;
        let (states, _) = chosen_states(method, &driven(pendulum, drive)?, request)?;
        Ok(Reply { states, evaluations: None })
    }
}

/// A method of the library as an integrator, on a pendulum whose length is not 1 m and whose mass
/// is not 1 kg: a force with g·L, or with the mass in it, shows.
#[derive(Clone, Copy)]
pub(crate) struct Ours<'a>(pub &'a dyn AnyMethod);

impl Integrator for Ours<'_> {
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        request.check()?;
        // A power of two, so that g/L is what was asked for, to the last digit.
        let pendulum = Pendulum::new(2.0 * request.g_over_l, 2.0, 3.0)
            .map_err(|error| Fault::Refused(error.to_string()))?;
        let (states, evaluations) = chosen_states(self.0, &pendulum, request)?;
        Ok(Reply { states, evaluations: Some(evaluations) })
    }
}

/// The states that are asked for, and the force evaluations.
fn chosen_states<S: System<State = Phase> + 'static>(
    method: &dyn AnyMethod<S>,
    system: &S,
    request: &Request,
) -> Result<(Vec<Phase>, u64), Fault> {
    let sign = request.step.signum();
    let along = |z: Phase| Phase { omega: sign * z.omega, ..z };
    let grid = Grid::new(request.step.abs(), request.steps)
        .map_err(|error| Fault::Refused(error.to_string()))?;
    let every = NonZeroU64::new(request.every).unwrap_or(NonZeroU64::MIN);
    let mut states = Vec::with_capacity(request.states() as usize);
    let mut run = method.begin(system, along(request.start), &grid);
    let mut keep = |_: u64, _: f64, z: Phase| states.push(along(z));
    // To the end of its own grid: a run may be wrong in its length.
    if run.advance(u64::MAX, every, &mut keep).is_err() {
        states.resize(request.states() as usize, NOTHING);
    }
    Ok((states, run.evaluations()))
}

/// An integrator that is a function of g/L (1/s²), θ (rad), ω (rad/s), h (s) and n, which returns
/// the pairs (θ, ω) after 1, 2, … n steps: in a vector, or one after the other. Of more than n no
/// more than tells so is looked at.
///
/// ```
/// use pendula_judge::{Claims, FromFn, judge};
///
/// let leapfrog = FromFn(|g_over_l: f64, mut theta: f64, mut omega: f64, h: f64, n: u64| {
///     (0..n).map(move |_| {
///         omega -= 0.5 * h * g_over_l * theta.sin();
///         theta += h * omega;
///         omega -= 0.5 * h * g_over_l * theta.sin();
///         (theta, omega)
///     })
/// });
/// let report = judge(&leapfrog, Claims::order(2).symplectic().symmetric());
/// report.assert();
/// assert_eq!(report.identity.unwrap().method, "stormer-verlet");
/// ```
#[derive(Clone, Copy)]
pub struct FromFn<F>(pub F);

impl<F> fmt::Debug for FromFn<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("FromFn").finish_non_exhaustive()
    }
}

impl<F, I> Integrator for FromFn<F>
where
    F: Fn(f64, f64, f64, f64, u64) -> I,
    I: IntoIterator<Item = (f64, f64)>,
{
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        if request.drive.is_some() {
            return Err(Fault::Unsupported);
        }
        request.check()?;
        let Phase { theta, omega } = request.start;
        let all = (self.0)(request.g_over_l, theta, omega, request.step, request.steps);
        let every = request.every as usize;
        let asked = all.into_iter().skip(every - 1).step_by(every);
        // One more would be one too many: the function may never end.
        let told = asked.take(request.states() as usize + 1);
        let states = told.map(|(theta, omega)| Phase { theta, omega }).collect();
        Ok(Reply { states, evaluations: None })
    }
}
