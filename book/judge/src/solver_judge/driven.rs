//! Runs under a drive: whether the force knows the time wherever a solver asks for it.

use super::asked::Asked;
use super::cause::DrivenCause;
use super::found::OfSolver;
use super::ladder::{Ladder, RUNS};
use super::outputs::Outputs;
use crate::finding::{Finding, Measurement};
use crate::integrator::{Drive, driven as system};
use crate::judge::probe::pendulum;
use crate::judge::verdict::{Measured, Trouble, Verdict};
use pendula::adaptive::{Adaptive, Tolerance};
use pendula::methods::Dop853;
use pendula::systems::Phase;

/// The force A cos Ωt of these runs, A in units of g/L and Ω in units of ω₀: nearly half as strong
/// as gravity, and off resonance.
const DRIVE: [f64; 2] = [0.4, 0.65];
/// θ and ω/ω₀ at t = 0.
const START: [f64; 2] = [-0.7, 0.6];
/// All runs are parts of one motion, whose states are known at so many times after the first, so
/// far apart (ω₀t).
const KNOTS: usize = 6;
const APART: f64 = 3.0;

/// A part of the motion that is asked for, and the cause where it is wrong and those before it are
/// right.
struct Part {
    name: &'static str,
    /// The first of its knots, and those that are asked for.
    from: usize,
    to: &'static [usize],
    cause: DrivenCause,
}

impl Part {
    fn is_back(&self) -> bool {
        self.to[0] < self.from
    }
}

/// The part in which the last of several outputs is asked for.
const BETWEEN: usize = 3;

const PARTS: [Part; 4] = [
    Part { name: "", from: 0, to: &[6], cause: DrivenCause::Wrong },
    Part { name: " from another t₀ on", from: 2, to: &[6], cause: DrivenCause::Elsewhere },
    Part { name: " backwards", from: 6, to: &[0], cause: DrivenCause::Backwards },
    Part { name: " between steps", from: 0, to: &[1, 3, 5, 6], cause: DrivenCause::BetweenSteps },
];

/// The worst error of a part (rad).
#[derive(Clone, Copy, Debug)]
struct Worst {
    error: f64,
    /// What it may be.
    bound: f64,
    tolerance: f64,
    /// Whether the last of several outputs has it, and the others are right.
    only_last: bool,
}

/// How many times the evaluations of a free run, for the same time, a driven one may need.
///
/// A step is as long as its estimate allows, whose power is q: if the derivatives in it are D times
/// as large, it is D^(1/q) times as short. The force adds 0.4 to g/L, and its own derivatives are
/// smaller, as it is slower than the swing: D is 1.4 at most, and steps are shorter by a fifth at
/// most, with q = 2. Right solvers come to 0.8 to 1.2. A stage that asks for the force at another
/// time than its own makes an estimate of first or second power, whose steps are ever so much
/// shorter at small tolerances: with a node that is off by a hundredth, 2 to 30 times at 10⁻¹⁰.
const MORE_WORK: f64 = 1.5;

/// The most work of driven runs.
#[derive(Clone, Copy, Debug)]
struct Work {
    /// Evaluations for the same time, over those of free runs.
    ratio: f64,
    tolerance: f64,
}

impl Worst {
    fn verdict(&self) -> Verdict {
        Verdict::of(self.error, self.bound, 10.0 * self.bound)
    }
}

/// The worst errors of the parts, where any run is accurate enough to tell.
#[derive(Clone, Debug)]
pub struct Driven {
    worst: [Option<Worst>; PARTS.len()],
    /// Why a part is not answered.
    refused: [Option<String>; PARTS.len()],
    /// The most work, where it is counted.
    work: Option<Work>,
}

impl Driven {
    /// Asks for each part at several tolerances. A drive makes steps shorter, and errors of the
    /// same tolerance somewhat larger: thirty times those of free runs are allowed, at the ends of
    /// runs those of ends and elsewhere those of outputs.
    pub fn of(asked: Asked<'_>, ladder: &Ladder, outputs: Option<&Outputs>) -> Measured<Self> {
        let scenes = asked.scenes;
        let frequency = scenes.frequency();
        let [amplitude, of_drive] = DRIVE;
        let drive =
            Drive { amplitude: amplitude * scenes.g_over_l, frequency: of_drive * frequency };
        let truth = exact()?.map(|z| scenes.state(z.theta, z.omega));
        let time = |knot: usize| APART * knot as f64 / frequency;
        let mut worst = [None; PARTS.len()];
        let mut refused = PARTS.map(|_| None);
        let mut work: Option<Work> = None;
        for tolerance in [1e-4, 1e-7, 1e-10] {
            let at_ends = ladder.error_at(tolerance);
            let elsewhere = outputs.map_or(0.0, |outputs| outputs.error_at(tolerance));
            for (k, part) in PARTS.into_iter().enumerate() {
                let allowed =
                    if part.to.len() == 1 { at_ends } else { libm::fmaximum(at_ends, elsewhere) };
                // Not reached, or nothing to compare with; or late before, which costs the
                // patience.
                if !(at_ends > 0.0 && allowed < 0.1) || refused[k].is_some() {
                    continue;
                }
                let times: Vec<f64> = part.to.iter().map(|knot| time(*knot)).collect();
                let run = scenes.run(truth[part.from], tolerance).from(time(part.from));
                let states = match asked.reply(&run.driven(drive).to(&times)) {
                    Ok(reply) => {
                        let long = time(KNOTS);
                        let ratio = (k == 0 && tolerance < 1e-5)
                            .then(|| ratio(ladder, tolerance, reply.evaluations?, long))
                            .flatten();
                        let more = ratio.filter(|it| work.is_none_or(|work| *it > work.ratio));
                        work = more.map(|ratio| Work { ratio, tolerance }).or(work);
                        reply.states
                    }
                    // Who answers the first knows drives, if not in every run.
                    Err(Trouble::NoAnswer(why) | Trouble::Lost(why)) if k > 0 => {
                        refused[k] = Some(why);
                        continue;
                    }
                    Err(trouble) => return Err(trouble),
                };
                let errors = part.to.iter().zip(states).map(|(k, z)| scenes.apart(z, truth[*k]));
                let errors: Vec<f64> = errors.collect();
                let others = errors[..errors.len() - 1].iter().copied();
                let others = others.fold(0.0, libm::fmaximum);
                let error = libm::fmaximum(others, errors[errors.len() - 1]);
                let bound = 30.0 * allowed + 1e-11;
                let only_last = k == BETWEEN && others <= bound && error > bound;
                let found = Worst { error, bound, tolerance, only_last };
                if worst[k].is_none_or(|it: Worst| error / found.bound > it.error / it.bound) {
                    worst[k] = Some(found);
                }
            }
        }
        match worst.iter().any(Option::is_some) {
            true => Ok(Self { worst, refused, work }),
            false => Err(Trouble::NoAnswer("no run is accurate enough to tell".to_string())),
        }
    }

    /// The parts that were asked for, with the worst of each.
    fn parts(&self) -> impl Iterator<Item = (Part, Worst)> {
        PARTS.into_iter().zip(self.worst).filter_map(|(part, worst)| Some((part, worst?)))
    }

    /// The first part that is wrong.
    fn wrong(&self) -> Option<(Part, Worst)> {
        self.parts().find(|(_, worst)| worst.verdict() == Verdict::Fails)
    }

    /// Why it is wrong, beside the errors (rad) of free runs `from_elsewhere` and `backwards`,
    /// which may be as large.
    pub fn cause(&self, from_elsewhere: f64, backwards: f64) -> Option<DrivenCause> {
        let Some((part, worst)) = self.wrong() else {
            let Work { ratio, tolerance } = self.too_much()?;
            return Some(DrivenCause::Work { tolerance, times: ratio });
        };
        if worst.only_last {
            return Some(DrivenCause::LastOutput);
        }
        let as_large = |free: f64| free > 0.3 * worst.error;
        Some(if part.is_back() && as_large(backwards) {
            DrivenCause::BackwardsAnyway(worst.error)
        } else if part.from > 0 && as_large(from_elsewhere) {
            DrivenCause::ElsewhereAnyway(worst.error)
        } else {
            part.cause
        })
    }

    /// The work, if it is too much.
    fn too_much(&self) -> Option<Work> {
        self.work.filter(|work| work.ratio > MORE_WORK)
    }

    pub fn finding(&self) -> Finding {
        let ratio = |worst: &Worst| worst.error / worst.bound;
        let worst = self.parts().max_by(|a, b| ratio(&a.1).total_cmp(&ratio(&b.1)));
        let Some((part, worst)) = worst else { return Finding::default() };
        if let (Some(work), false) = (self.too_much(), worst.verdict() == Verdict::Fails) {
            return work.finding();
        }
        let Worst { error, bound, tolerance, .. } = worst;
        let refused = PARTS.iter().zip(&self.refused);
        let refused = || refused.clone().filter_map(|(part, why)| Some((part, why.as_ref()?)));
        // Whether it runs backwards at all is another property.
        let verdict = match worst.verdict() {
            Verdict::Holds if refused().any(|(part, _)| !part.is_back()) => Verdict::Unclear,
            verdict => verdict,
        };
        let refused = refused().map(|(part, why)| (part.name, why.clone())).collect();
        let measurement = OfSolver::Driven { run: part.name, tolerance, refused };
        Finding {
            measurement: Measurement::OfSolver(measurement),
            ..Finding::number(error, "rad", bound, verdict)
        }
    }
}

impl Work {
    fn finding(&self) -> Finding {
        let Self { ratio, tolerance } = *self;
        let verdict = Verdict::of(ratio, MORE_WORK, 2.0);
        Finding {
            measurement: Measurement::OfSolver(OfSolver::DrivenWork { tolerance }),
            ..Finding::number(ratio, "", MORE_WORK, verdict)
        }
    }
}

/// How many times the evaluations of free runs these are, for a run of that length (s).
fn ratio(ladder: &Ladder, tolerance: f64, evaluations: u64, long: f64) -> Option<f64> {
    let rung = ladder.at(tolerance)?;
    let free = rung.evaluations? as f64 / RUNS as f64 / ladder.scenes.duration;
    (free > 0.0).then(|| evaluations as f64 / long / free)
}

/// The driven motion at the knots, in units of time in which ω₀ is 1, by the library's method of
/// order 8 with a tolerance of 10⁻¹⁴: off by less than 10⁻¹² rad, as runs at tighter tolerances
/// show.
fn exact() -> Measured<[Phase; KNOTS + 1]> {
    let unknown = |error: &dyn core::fmt::Display| Trouble::NoAnswer(error.to_string());
    let drive = Drive { amplitude: DRIVE[0], frequency: DRIVE[1] };
    let driven = system(pendulum(1.0), drive).map_err(|fault| unknown(&fault))?;
    let tolerance = Tolerance::uniform(1e-14).map_err(|error| unknown(&error))?;
    let adaptive = Adaptive::new(Dop853, tolerance);
    let mut states = [Phase { theta: START[0], omega: START[1] }; KNOTS + 1];
    for k in 0..KNOTS {
        let [from, until] = [k, k + 1].map(|knot| APART * knot as f64);
        let end = adaptive.integrate(&driven, states[k], from, until);
        states[k + 1] = end.map_err(|error| unknown(&error))?.0;
    }
    Ok(states)
}
