//! The integrator beside `known-answers/known-answers.json`: which method it is, or which mistake.

use super::claims::Claims;
use super::probe::Probe;
use super::verdict::{Measured, told};
use crate::integrator::Request;
use crate::known_answers::{self, Answer, Known, Scene};
use pendula::systems::Phase;

/// The integrator's states in the scenes of the file.
pub struct Answers {
    /// Scene, and the states after 1, 2, … steps.
    runs: Vec<(&'static Scene, Vec<Phase>)>,
    /// What a step rounds by, relative to a state of order 1.
    rounding: f64,
    /// What a tolerance inside the integrator may make of a step (rad).
    tolerance: f64,
}

/// A method of the file that the integrator can be, and how far it is off.
#[derive(Clone, Copy, Debug)]
pub struct Match {
    pub known: &'static Known,
    /// In the integrator's own roundings, at most.
    roundings: f64,
    /// In rad or rad/s, at most.
    pub apart: f64,
    /// Whether it is so in driven scenes, too.
    pub driven: bool,
}

/// What the file says of the integrator's name.
#[derive(Clone, Debug)]
pub enum Name {
    /// It is this method, and no other one is near.
    One(Match),
    /// It can be any of these, the nearest first, for all that its digits tell.
    OneOf(Vec<Match>),
    /// It is none of them.
    None,
}

impl Name {
    /// The method, if it is one.
    pub const fn one(&self) -> Option<Match> {
        match self {
            Self::One(found) => Some(*found),
            _ => None,
        }
    }
}

/// How far off an integrator is from an entry.
#[derive(Clone, Copy, Debug, Default)]
struct Off {
    /// In the file's tolerances, which allow for what the method makes of a rounding.
    tolerances: f64,
    /// In the integrator's own roundings.
    roundings: f64,
    /// In rad or rad/s.
    apart: f64,
}

/// Another entry has to be so many times as far off before one is named.
const ALONE: f64 = 10.0;

impl Answers {
    /// Asks. What an integrator does not answer is left out, and so is what begins later than t =
    /// 0: a request has no time.
    pub fn of(probe: &Probe<'_>) -> Measured<Self> {
        let mut runs = Vec::new();
        for scene in known_answers::scenes().iter().filter(|scene| scene.time == 0.0) {
            // In large steps an implicit method may have no solution after the second.
            let steps = if scene.step.abs() < 0.5 { 8 } else { 2 };
            let Scene { g_over_l, drive, start, step, .. } = *scene;
            let request = Request { g_over_l, drive, start, step, steps, every: 1 };
            runs.extend(told(probe.ask(&request))?.map(|reply| (scene, reply.states)));
        }
        let tolerance = probe.tolerance_a_step();
        Ok(Self { runs, rounding: probe.rounding, tolerance: 0.0 }
            .with_tolerance(200.0 * tolerance))
    }

    /// Of an integrator that answers as the file has it of `known`, each number off by so many of
    /// its roundings, 2⁻⁵².
    #[cfg(test)]
    pub fn as_of(known: &Known, roundings: impl Fn(&Answer) -> f64) -> Self {
        let rounding = f64::EPSILON;
        let mut runs: Vec<(&'static Scene, Vec<Phase>)> = Vec::new();
        for answer in known.answers.iter().filter(|answer| answer.scene.time == 0.0) {
            let last = runs.iter().position(|(scene, _)| scene.name == answer.scene.name);
            let place = last.unwrap_or_else(|| {
                let nothing = Phase { theta: f64::NAN, omega: f64::NAN };
                runs.push((answer.scene, vec![nothing; 8]));
                runs.len() - 1
            });
            let Phase { theta, omega } = answer.state;
            let off = roundings(answer) * rounding * theta.abs().max(omega.abs());
            let state = Phase { theta: theta + off, omega: omega - off };
            runs[place].1[answer.steps as usize - 1] = state;
        }
        Self { runs, rounding, tolerance: 0.0 }
    }

    /// Of an integrator that answered nothing.
    pub const fn none() -> Self {
        Self { runs: Vec::new(), rounding: 1.0, tolerance: 0.0 }
    }

    /// With what a tolerance inside the integrator makes of 200 steps (rad).
    pub fn with_tolerance(self, tolerance: f64) -> Self {
        // As where library methods are compared: neighbours part by less than a hundred times.
        Self { tolerance: 100.0 * tolerance / 200.0, ..self }
    }

    /// And with what it makes of a long step (rad).
    pub fn and_in_a_step(self, tolerance: f64) -> Self {
        Self { tolerance: self.tolerance + 10.0 * tolerance, ..self }
    }

    /// The largest distance of the answers of `known` that `asked` picks; `None` if it is more than
    /// `most` tolerances, or if none of them is had.
    fn off(&self, known: &Known, most: f64, asked: impl Fn(&Scene) -> bool) -> Option<Off> {
        let mut largest: Option<Off> = None;
        for answer in known.answers.iter().filter(|answer| asked(answer.scene)) {
            let run = self.runs.iter().find(|(scene, _)| scene.name == answer.scene.name);
            let Some(state) = run.and_then(|(_, states)| states.get(answer.steps as usize - 1))
            else {
                continue;
            };
            let off = self.distance(answer, *state);
            if off.tolerances.is_nan() || off.tolerances > most {
                return None;
            }
            let before = largest.unwrap_or_default();
            largest = Some(Off {
                tolerances: before.tolerances.max(off.tolerances),
                roundings: before.roundings.max(off.roundings),
                apart: before.apart.max(off.apart),
            });
        }
        largest
    }

    fn distance(&self, answer: &Answer, state: Phase) -> Off {
        let Phase { theta, omega } = answer.state;
        let apart = libm::fmaximum((state.theta - theta).abs(), (state.omega - omega).abs());
        let size = theta.abs().max(omega.abs());
        let tolerance = answer.steps as f64 * self.tolerance;
        let allowed = answer.tolerance * self.rounding * size + tolerance;
        let roundings = apart / (self.rounding * size + tolerance);
        Off { tolerances: apart / allowed, roundings, apart }
    }

    /// The method that it is: it agrees with that to its own rounding, and every other entry lies
    /// ten times as far off. Entries that are one map where there is no drive are told apart by
    /// driven scenes, or else by the name that is claimed.
    ///
    /// A program that takes no steps back is compared with the steps ahead.
    pub fn method(&self, claims: &Claims) -> Name {
        match self.method_by(claims, |_| true) {
            Name::None => self.method_by(claims, |scene| scene.step > 0.0),
            name => name,
        }
    }

    fn method_by(&self, claims: &Claims, asked: impl Fn(&Scene) -> bool) -> Name {
        let claimed = claims.method().map(|known| known.name.as_str());
        let all = known_answers::methods().iter().filter_map(|known| {
            // Whatever its tolerance is, another entry can be as near as one that fits.
            let plain = |scene: &Scene| scene.drive.is_none() && asked(scene);
            let off = self.off(known, f64::INFINITY, plain)?;
            let driven = self.off(known, 1.0, |scene| scene.drive.is_some()).is_some();
            let found = Match { known, roundings: off.roundings, apart: off.apart, driven };
            Some((found, off.tolerances <= 1.0))
        });
        let all: Vec<(Match, bool)> = all.collect();
        let nearest =
            |a: &&(Match, bool), b: &&(Match, bool)| a.0.roundings.total_cmp(&b.0.roundings);
        let Some((best, _)) = all.iter().min_by(nearest) else { return Name::None };
        let room = ALONE * best.roundings.max(1.0);
        let near = all.iter().filter(|(found, _)| found.roundings <= room);
        // An entry that allows for much may fit where another one, which does not, is nearer.
        if !near.clone().any(|(_, fits)| *fits) {
            return Name::None;
        }
        let mut near: Vec<Match> = near.map(|(found, _)| *found).collect();
        let rank = |x: &Match| (!x.driven, Some(x.known.name.as_str()) != claimed);
        near.sort_by(|a, b| a.roundings.total_cmp(&b.roundings).then(rank(a).cmp(&rank(b))));
        let (driven, not): (Vec<Match>, Vec<Match>) = near.iter().partition(|found| found.driven);
        let those = if driven.is_empty() { not } else { driven };
        // The same map has the same distance, to the bit.
        match &those[..] {
            [first, others @ ..] if others.iter().all(|x| x.roundings == first.roundings) => {
                Name::One(*first)
            }
            _ => Name::OneOf(those),
        }
    }

    /// The mistake that it makes, if it is not right in all scenes: the nearest, first of those in
    /// the method that is claimed. Single precision does not tell one from another.
    pub fn mistake(&self, claims: &Claims) -> Option<&'static Known> {
        if self.rounding > 1e-12 || self.method(claims).one().is_some_and(|found| found.driven) {
            return None;
        }
        let claimed = claims.method().map(|known| known.name.as_str());
        let all = known_answers::mistakes().iter().filter_map(|known| {
            let off = self.off(known, 1.0, |_| true)?;
            Some((known, off.tolerances))
        });
        let other = |known: &Known| {
            let of = known.mistake.as_ref().map(|mistake| mistake.of.as_str());
            claimed.is_some() && of != claimed
        };
        let best = all.min_by(|a, b| other(a.0).cmp(&other(b.0)).then(a.1.total_cmp(&b.1)));
        best.map(|(known, _)| known)
    }
}
