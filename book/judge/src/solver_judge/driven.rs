//! Runs under a drive: whether the force knows the time wherever a solver asks for it.

use super::asked::Asked;
use super::ladder::Ladder;
use super::outputs::Outputs;
use crate::finding::Measurement;
use crate::judge::probe::pendulum;
use crate::judge::report::{Finding, about, scientific};
use crate::judge::verdict::{Measured, Trouble, Verdict};
use crate::stranger::{Drive, driven as system};
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

/// A part of the motion that is asked for, and what is to be said where it is wrong and those
/// before it are right.
struct Part {
    name: &'static str,
    /// The first of its knots, and those that are asked for.
    from: usize,
    to: &'static [usize],
    cause: &'static str,
}

impl Part {
    fn is_back(&self) -> bool {
        self.to[0] < self.from
    }
}

const PARTS: [Part; 4] = [
    Part {
        name: "",
        from: 0,
        to: &[6],
        cause: "Under a drive it is wrong: the force, or the times at which the stages ask for it.",
    },
    Part {
        name: " from another t₀ on",
        from: 2,
        to: &[6],
        cause: "Under a drive it is right from t₀ = 0 on and wrong from another: look at whether \
                the force is asked for at the time or at that since the start.",
    },
    Part {
        name: " backwards",
        from: 6,
        to: &[0],
        cause: "Under a drive it is right forwards and wrong backwards: look at the times at which \
                the stages ask for the force.",
    },
    Part {
        name: " between steps",
        from: 0,
        to: &[1, 3, 5, 6],
        cause: "Under a drive the ends of runs are right and other outputs wrong: look at the \
                times at which the force is asked for where outputs come from.",
    },
];

/// The worst error of a part (rad).
#[derive(Clone, Copy, Debug)]
struct Worst {
    error: f64,
    /// What it may be.
    bound: f64,
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
                    Ok(reply) => reply.states,
                    // Who answers the first knows drives, if not in every run.
                    Err(Trouble::NoAnswer(why) | Trouble::Lost(why)) if k > 0 => {
                        refused[k] = Some(why);
                        continue;
                    }
                    Err(trouble) => return Err(trouble),
                };
                let errors = part.to.iter().zip(states).map(|(k, z)| scenes.apart(z, truth[*k]));
                let error = errors.fold(0.0, libm::fmaximum);
                let found = Worst { error, bound: 30.0 * allowed + 1e-11, tolerance };
                if worst[k].is_none_or(|it: Worst| error / found.bound > it.error / it.bound) {
                    worst[k] = Some(found);
                }
            }
        }
        match worst.iter().any(Option::is_some) {
            true => Ok(Self { worst, refused }),
            false => Err(Trouble::NoAnswer("no run is accurate enough to tell".to_string())),
        }
    }

    /// The parts that were asked for, with the worst of each.
    fn parts(&self) -> impl Iterator<Item = (Part, Worst)> {
        PARTS.into_iter().zip(self.worst).filter_map(|(part, worst)| Some((part, worst?)))
    }

    /// The first part that is wrong.
    fn wrong(&self) -> Option<Part> {
        self.parts().find(|(_, worst)| worst.verdict() == Verdict::Fails).map(|(part, _)| part)
    }

    /// Why it is wrong, if that is not because every run `from_elsewhere` or every run `backwards`
    /// is.
    pub fn cause(&self, from_elsewhere: bool, backwards: bool) -> Option<&'static str> {
        let part = self.wrong()?;
        let is_known = part.from > 0 && (from_elsewhere || part.is_back() && backwards);
        (!is_known).then_some(part.cause)
    }

    pub fn finding(&self) -> Finding {
        let ratio = |worst: &Worst| worst.error / worst.bound;
        let worst = self.parts().max_by(|a, b| ratio(&a.1).total_cmp(&ratio(&b.1)));
        let Some((part, worst)) = worst else { return Finding::default() };
        let Worst { error, bound, tolerance } = worst;
        let refused = PARTS.iter().zip(&self.refused);
        let refused = || refused.clone().filter_map(|(part, why)| Some((part, why.as_ref()?)));
        // Whether it runs backwards at all is another property.
        let verdict = match worst.verdict() {
            Verdict::Holds if refused().any(|(part, _)| !part.is_back()) => Verdict::Unclear,
            verdict => verdict,
        };
        let not_told = refused().map(|(part, why)| format!("; no answer{}: {why}", part.name));
        let measured = format!(
            "under a force A cos Ωt off by {} rad{}, at a tolerance of {}{}",
            scientific(error),
            part.name,
            about(tolerance),
            not_told.collect::<String>()
        );
        let why = format!("thirty times what a free run errs there: {}", about(bound));
        Finding {
            measurement: Measurement::Said { measured, why },
            ..Finding::number(error, "rad", bound, verdict)
        }
    }
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
        let end = adaptive.integrate(&driven, states[k], from, until, &mut ());
        states[k + 1] = end.map_err(|error| unknown(&error))?.0;
    }
    Ok(states)
}
