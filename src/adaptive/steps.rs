//! The sequence of adaptive steps.

use super::control::Controller;
use super::{Adaptive, Dense};
use crate::error::Error;
use crate::methods::runge_kutta::Embedded;
use crate::systems::{Components, Counting, RateOf, System};

/// The cost of a sequence of steps so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Steps taken.
    pub accepted: u64,
    /// Attempts whose error was too large.
    pub rejected: u64,
    /// Force evaluations, counted, including those for the size of the first step, for rejected
    /// attempts and for dense output.
    pub evaluations: u64,
}

/// An accepted step.
#[derive(Clone, Copy, Debug)]
pub struct Step<Z, K, D> {
    t: f64,
    h: f64,
    z: Z,
    end_time: f64,
    end: Z,
    stages: K,
    end_slope: D,
}

impl<Z: Copy, K, D> Step<Z, K, D> {
    /// The time at which it begins (s).
    pub const fn start_time(&self) -> f64 {
        self.t
    }

    /// The state from which it begins.
    pub const fn start(&self) -> Z {
        self.z
    }

    /// The time at which it ends (s).
    pub const fn end_time(&self) -> f64 {
        self.end_time
    }

    /// The state to which it leads.
    pub const fn end(&self) -> Z {
        self.end
    }

    /// Its size h (s): negative backwards in time.
    pub const fn size(&self) -> f64 {
        self.h
    }
}

/// A step of the method `M` for the system `S`.
type StepOf<S, M> = Step<<S as System>::State, <M as Embedded>::Stages<RateOf<S>>, RateOf<S>>;

/// Its dense output.
pub(super) type DenseOf<S, M> = Dense<<S as System>::State, <M as Embedded>::Dense<RateOf<S>>>;

/// An iterator over the steps from one time to another.
///
/// It ends after an error. It also holds what a step carries to the next: the slope at its end.
pub struct AdaptiveSteps<'a, S: System, M> {
    adaptive: Adaptive<M>,
    system: Counting<&'a S>,
    controller: Controller,
    t: f64,
    until: f64,
    z: S::State,
    /// The slope at z.
    slope: RateOf<S>,
    /// The size of the next attempt (s).
    h: f64,
    accepted: u64,
    rejected: u64,
    failed: bool,
}

impl<'a, S, M> AdaptiveSteps<'a, S, M>
where
    S: System<State: Components>,
    M: Embedded,
{
    pub(super) fn new(
        adaptive: Adaptive<M>,
        system: &'a S,
        z: S::State,
        t: f64,
        until: f64,
    ) -> Result<Self, Error> {
        for (name, value) in
            [("start time (s)", t), ("end time (s)", until), ("duration (s)", until - t)]
        {
            if !value.is_finite() {
                return Err(Error::Parameter { name, value, allowed: "finite" });
            }
        }
        let system = Counting::new(system);
        let slope = system.rate(t, z);
        let controller = Controller::new(M::ESTIMATE_ORDER);
        let (h, accepted, rejected, failed) = (0.0, 0, 0, false);
        let mut walk = Self {
            adaptive,
            system,
            controller,
            t,
            until,
            z,
            slope,
            h,
            accepted,
            rejected,
            failed,
        };
        walk.h = walk.first_step();
        Ok(walk)
    }

    /// The size of the first attempt (s).
    ///
    /// It follows from the size of the state, the size of its rate of change, and, with a small
    /// step of forward Euler, how fast that rate changes (Hairer, Nørsett, Wanner, *Solving
    /// Ordinary Differential Equations I*, Sect. II.4).
    fn first_step(&self) -> f64 {
        let Self { t, z, slope, .. } = *self;
        let duration = self.until - t;
        if duration == 0.0 {
            return 0.0;
        }
        let tolerance = &self.adaptive.tolerance;
        let size = |displacement| tolerance.error_norm(z, z, displacement);
        let (state, rate) = (tolerance.state_norm(z, slope), size(slope));
        // A state or a rate close to zero says nothing about the time scale.
        let meaningful = |ratio: f64| ratio >= 1e-5;
        let guess = if meaningful(state) && meaningful(rate) {
            0.01 * (state / rate)
        } else {
            1e-6 * libm::fabs(duration)
        };
        let euler = libm::copysign(libm::fmin(guess, libm::fabs(duration)), duration);
        let ahead = self.system.rate(t + euler, z + slope * euler);
        let bend = size(ahead + slope * -1.0) / libm::fabs(euler);
        let fastest = libm::fmax(rate, bend);
        let fits = if fastest <= 1e-15 {
            libm::fmax(1e-6 * libm::fabs(duration), 1e-3 * guess)
        } else {
            libm::pow(0.01 / fastest, 1.0 / f64::from(M::ESTIMATE_ORDER))
        };
        let most = libm::fmin(100.0 * guess, libm::fabs(duration));
        // A system without a finite rate gets the largest step, which is then rejected.
        libm::copysign(libm::fmin(fits, most), duration)
    }

    /// The present time (s).
    pub const fn time(&self) -> f64 {
        self.t
    }

    /// The present state.
    pub const fn state(&self) -> S::State {
        self.z
    }

    /// The cost so far.
    pub fn counts(&self) -> Counts {
        let Self { accepted, rejected, .. } = *self;
        Counts { accepted, rejected, evaluations: self.system.evaluations() }
    }

    /// The dense output of `step`, which may need more evaluations of the force.
    pub fn dense(&self, step: &StepOf<S, M>) -> DenseOf<S, M> {
        let Step { t, h, z, end_slope, .. } = *step;
        let coefficients =
            self.adaptive.method.dense(&self.system, t, h, z, &step.stages, end_slope);
        Dense::new(t, h, z, coefficients)
    }

    // ANCHOR: advance
    fn advance(&mut self) -> Result<StepOf<S, M>, Error> {
        let Self { t, z, slope, until, .. } = *self;
        let Adaptive { method, tolerance, limit } = self.adaptive;
        loop {
            if self.accepted + self.rejected >= limit {
                return Err(Error::OutOfSteps { t, limit });
            }
            // A step that would end just short of the end time is stretched to it, so that no tiny
            // step is left.
            let left = until - t;
            let last = libm::fabs(1.01 * self.h) >= libm::fabs(left);
            let (h, end_time) = if last { (left, until) } else { (self.h, t + self.h) };
            if t + 0.1 * h == t && !last {
                return Err(Error::StepTooSmall { t, step: h });
            }
            let (end, stages) = method.attempt(&self.system, t, h, z, slope);
            let error = method.error(&stages, |rate| tolerance.error_norm(z, end, rate * h));
            let (accepted, factor) = self.controller.judge(error);
            self.h = h * factor;
            if accepted {
                self.accepted += 1;
                let end_slope = method.end_slope(&self.system, end_time, end, &stages);
                (self.t, self.z, self.slope) = (end_time, end, end_slope);
                return Ok(Step { t, h, z, end_time, end, stages, end_slope });
            }
            self.rejected += 1;
        }
    }
    // ANCHOR_END: advance
}

impl<S, M> Iterator for AdaptiveSteps<'_, S, M>
where
    S: System<State: Components>,
    M: Embedded,
{
    type Item = Result<StepOf<S, M>, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.failed || self.t == self.until {
            return None;
        }
        let step = self.advance();
        self.failed = step.is_err();
        Some(step)
    }
}
