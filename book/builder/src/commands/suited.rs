//! The library's methods on systems other than the pendulum: which of them suit, and their runs.
//!
//! Whether a method suits a system is for the types to say: a splitting method steps a separable
//! one, a method with a series one that has a series. So there is no list here that could be wrong.

use std::marker::PhantomData;
use std::num::NonZeroU64;

use pendula::integrate::{Checkpoint, try_integrate};
use pendula::systems::{Damped, Driven, Numbers, Shaken};
use pendula::{
    Counting, DoublePendulum, Error, Grid, Info, METHODS, Method, Observer, System,
    for_each_method, methods,
};

use super::trajectory::Run;
use crate::failure::Failure;

/// A system that some of the library's methods integrate.
pub trait Suited: System<State: Numbers> + Copy + 'static {
    /// What it is called in a refusal.
    const NAME: &'static str;

    /// Whether the method `name` suits it.
    fn suits(name: &str) -> bool;

    /// A run of the method `name`, if it suits: from `start`, or from the checkpoint `at`.
    fn begin(
        &self,
        name: &str,
        start: Self::State,
        grid: &Grid,
        at: Option<Checkpoint>,
    ) -> Option<Box<dyn Run<Self::State>>>;

    /// Why the method `name` finds no solution along `grid`, if it does not.
    fn unsolved(&self, name: &str, start: Self::State, grid: &Grid) -> Option<Error>;
}

/// Refuses a method that does not suit the system, with those that do.
///
/// # Errors
/// [`Failure::Refused`].
pub fn check<S: Suited>(name: &str) -> Result<(), Failure> {
    if S::suits(name) {
        return Ok(());
    }
    let suited = names::<S>().collect::<Vec<_>>().join(", ");
    let why = "it needs more of a system than this one has";
    Err(Failure::refused(format!(
        "--method {name}: {why}, {}; those that suit are {suited}",
        S::NAME
    )))
}

/// The names of the methods that suit.
pub fn names<S: Suited>() -> impl Iterator<Item = &'static str> {
    METHODS.iter().map(|method| method.info().name).filter(|name| S::suits(name))
}

/// A run of any method, which counts its evaluations.
struct InSteps<S, M> {
    system: Counting<S>,
    method: M,
    grid: Grid,
    at: Checkpoint,
}

impl<S, M> Run<S::State> for InSteps<S, M>
where
    S: System<State: Numbers>,
    Counting<S>: System<State = S::State>,
    M: Method<Counting<S>, Carry: Numbers>,
{
    fn checkpoint(&self) -> &Checkpoint {
        &self.at
    }

    fn evaluations(&self) -> u64 {
        self.system.evaluations()
    }

    fn advance(
        &mut self,
        until: u64,
        every: NonZeroU64,
        observer: &mut dyn Observer<S::State>,
    ) -> S::State {
        self.at.advance(&self.system, &self.method, &self.grid, until, every, observer)
    }
}

/// A method, asked whether it steps the system `S`. The compiler prefers what holds for the method
/// itself ([`Steps`]) to what holds for a reference to it ([`DoesNotStep`]).
struct Candidate<M, S>(M, PhantomData<S>);

trait Steps<S: System> {
    fn suits(&self) -> bool {
        true
    }

    fn begin(
        &self,
        system: &S,
        start: S::State,
        grid: &Grid,
        at: Option<Checkpoint>,
    ) -> Option<Box<dyn Run<S::State>>>;

    fn unsolved(&self, system: &S, start: S::State, grid: &Grid) -> Option<Error>;
}

impl<S, M> Steps<S> for Candidate<M, S>
where
    S: System<State: Numbers> + Copy + 'static,
    Counting<S>: System<State = S::State>,
    M: Method<S> + Method<Counting<S>, Carry: Numbers> + Copy + 'static,
{
    fn begin(
        &self,
        system: &S,
        start: S::State,
        grid: &Grid,
        at: Option<Checkpoint>,
    ) -> Option<Box<dyn Run<S::State>>> {
        let system = Counting::new(*system);
        let at = at.unwrap_or_else(|| Checkpoint::start(&system, &self.0, start, grid));
        Some(Box::new(InSteps { system, method: self.0, grid: *grid, at }))
    }

    fn unsolved(&self, system: &S, start: S::State, grid: &Grid) -> Option<Error> {
        try_integrate(system, &self.0, start, grid, &mut ()).err()
    }
}

trait DoesNotStep<S: System> {
    fn suits(&self) -> bool {
        false
    }

    fn begin(
        &self,
        _: &S,
        _: S::State,
        _: &Grid,
        _: Option<Checkpoint>,
    ) -> Option<Box<dyn Run<S::State>>> {
        None
    }

    fn unsolved(&self, _: &S, _: S::State, _: &Grid) -> Option<Error> {
        None
    }
}

impl<M, S: System> DoesNotStep<S> for &Candidate<M, S> {}

/// Asks each of the methods, by its type, about each of the systems.
macro_rules! suited {
    ([$($method:ident)+]) => {};
    ([$($method:ident)+] $System:ident: $name:literal, $($more:tt)*) => {
        impl Suited for $System {
            const NAME: &'static str = $name;

            fn suits(name: &str) -> bool {
                $(if name == methods::$method.info().name {
                    return (&Candidate(methods::$method, PhantomData::<Self>)).suits();
                })+
                false
            }

            fn begin(
                &self,
                name: &str,
                start: Self::State,
                grid: &Grid,
                at: Option<Checkpoint>,
            ) -> Option<Box<dyn Run<Self::State>>> {
                $(if name == methods::$method.info().name {
                    let candidate = &Candidate(methods::$method, PhantomData::<Self>);
                    return candidate.begin(self, start, grid, at);
                })+
                None
            }

            fn unsolved(&self, name: &str, start: Self::State, grid: &Grid) -> Option<Error> {
                $(if name == methods::$method.info().name {
                    let candidate = &Candidate(methods::$method, PhantomData::<Self>);
                    return candidate.unsolved(self, start, grid);
                })+
                None
            }
        }

        suited! { [$($method)+] $($more)* }
    };
}

macro_rules! each {
    ($($module:ident::$method:ident,)+) => {
        suited! {
            [$($method)+]
            Damped: "the damped pendulum",
            Driven: "the driven pendulum",
            Shaken: "the shaken pendulum",
            DoublePendulum: "the double pendulum",
        }
    };
}
for_each_method!(each);
