//! The stranger beside `snapshots/known-answers.json`: which method it is, or which mistake.

use super::claims::Claims;
use super::probe::Probe;
use super::verdict::{Measured, told};
use crate::known_answers::{self, Answer, Known, Scene};
use crate::stranger::Request;
use pendula::systems::Phase;

/// The stranger's states in the scenes of the file.
pub struct Answers {
    /// Scene, and the states after 1, 2, … steps.
    runs: Vec<(&'static Scene, Vec<Phase>)>,
    /// What a step rounds by, relative to a state of order 1.
    rounding: f64,
    /// What a tolerance inside the stranger may make of a step (rad).
    tolerance: f64,
}

/// A method of the file that the stranger is, and how far it is off.
#[derive(Clone, Copy, Debug)]
pub struct Match {
    pub known: &'static Known,
    /// In the file's tolerances, at most.
    tolerances: f64,
    /// In rad or rad/s, at most.
    pub apart: f64,
    /// Whether it is so in driven scenes, too.
    pub driven: bool,
}

impl Answers {
    /// Asks. What a stranger does not answer is left out, and so is what begins later than t = 0:
    /// a request has no time.
    pub fn of(probe: &Probe<'_>) -> Measured<Self> {
        let mut runs = Vec::new();
        for scene in known_answers::scenes().iter().filter(|scene| scene.time == 0.0) {
            // In large steps an implicit method may have no solution after the second.
            let steps = if scene.step.abs() < 0.5 { 8 } else { 2 };
            let Scene { g_over_l, drive, start, step, .. } = *scene;
            let request = Request { g_over_l, drive, start, step, steps, every: 1 };
            runs.extend(told(probe.ask(&request))?.map(|reply| (scene, reply.states)));
        }
        // As where library methods are compared: neighbours part by less than a hundred times.
        let tolerance = 100.0 * probe.tolerance_a_step();
        Ok(Self { runs, rounding: probe.rounding, tolerance })
    }

    /// The largest distance of the answers of `known` that `asked` picks, in tolerances and in rad;
    /// `None` if it is more than a tolerance, or if none of them is had.
    fn off(&self, known: &Known, asked: impl Fn(&Scene) -> bool) -> Option<(f64, f64)> {
        let mut largest: Option<(f64, f64)> = None;
        for answer in known.answers.iter().filter(|answer| asked(answer.scene)) {
            let run = self.runs.iter().find(|(scene, _)| scene.name == answer.scene.name);
            let Some(state) = run.and_then(|(_, states)| states.get(answer.steps as usize - 1))
            else {
                continue;
            };
            let (off, apart) = self.distance(answer, *state);
            if off.is_nan() || off > 1.0 {
                return None;
            }
            let (before, further) = largest.unwrap_or_default();
            largest = Some((before.max(off), further.max(apart)));
        }
        largest
    }

    fn distance(&self, answer: &Answer, state: Phase) -> (f64, f64) {
        let Phase { theta, omega } = answer.state;
        let apart = libm::fmaximum((state.theta - theta).abs(), (state.omega - omega).abs());
        let size = theta.abs().max(omega.abs());
        let allowed =
            answer.tolerance * self.rounding * size + answer.steps as f64 * self.tolerance;
        (apart / allowed, apart)
    }

    /// The method that it is: one that is so in driven scenes, too, if there is one, and the one of
    /// the name that is claimed, and the nearest. In single precision more than one may fit.
    pub fn method(&self, claims: &Claims) -> Option<Match> {
        let claimed = claims.method().map(|known| known.name.as_str());
        let all = known_answers::methods().iter().filter_map(|known| {
            let (tolerances, apart) = self.off(known, |scene| scene.drive.is_none())?;
            let driven = self.off(known, |scene| scene.drive.is_some()).is_some();
            Some(Match { known, tolerances, apart, driven })
        });
        all.min_by(|a, b| {
            let rank = |x: &Match| (!x.driven, Some(x.known.name.as_str()) != claimed);
            rank(a).cmp(&rank(b)).then(a.tolerances.total_cmp(&b.tolerances))
        })
    }

    /// The mistake that it makes, if it is not right in all scenes: the nearest, first of those in
    /// the method that is claimed. Single precision does not tell one from another.
    pub fn mistake(&self, claims: &Claims) -> Option<&'static Known> {
        if self.rounding > 1e-12 || self.method(claims).is_some_and(|found| found.driven) {
            return None;
        }
        let claimed = claims.method().map(|known| known.name.as_str());
        let all = known_answers::mistakes().iter().filter_map(|known| {
            let (tolerances, _) = self.off(known, |_| true)?;
            Some((known, tolerances))
        });
        let other = |known: &Known| {
            let of = known.mistake.as_ref().map(|mistake| mistake.of.as_str());
            claimed.is_some() && of != claimed
        };
        let best = all.min_by(|a, b| other(a.0).cmp(&other(b.0)).then(a.1.total_cmp(&b.1)));
        best.map(|(known, _)| known)
    }
}
