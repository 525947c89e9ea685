//! What runs forward only, and is asked for nothing else.

use core::time::Duration;

use crate::integrator::{Fault, Integrator, Reply, Request};
use crate::solver::{Crossings, CrossingsRequest, SolveRequest, Solver};

/// What is claimed to run forward only: of a run backwards it is not asked, as it may never return.
#[derive(Clone, Copy)]
pub struct Forward<'s, T: ?Sized>(pub &'s T);

impl<T: ?Sized> Forward<'_, T> {
    fn unless(is_backwards: bool) -> Result<(), Fault> {
        match is_backwards {
            true => Err(Fault::Refused(
                "it is not asked for runs backwards, as forward-only is claimed".to_string(),
            )),
            false => Ok(()),
        }
    }
}

impl Integrator for Forward<'_, dyn Integrator + '_> {
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        Self::unless(request.step < 0.0)?;
        self.0.answer(request)
    }

    fn longest_run(&self) -> u64 {
        self.0.longest_run()
    }
}

impl Solver for Forward<'_, dyn Solver + '_> {
    fn solve(&self, request: &SolveRequest) -> Result<Reply, Fault> {
        Self::unless(request.times.iter().any(|time| *time < request.from))?;
        self.0.solve(request)
    }

    fn crossings(&self, request: &CrossingsRequest) -> Result<Crossings, Fault> {
        Self::unless(request.span[1] < request.span[0])?;
        self.0.crossings(request)
    }

    fn patience(&self) -> Duration {
        self.0.patience()
    }

    fn may_hang(&self) -> bool {
        self.0.may_hang()
    }

    fn clock(&self) -> Duration {
        self.0.clock()
    }
}
