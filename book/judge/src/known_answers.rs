//! What named integrators, and known mistakes in them, lead to in one, two or eight steps; and what
//! the right-hand sides are that they are given, [`right_hand_side`].
//!
//! The steps are those of `book/judge/known-answers/known-answers.json`, which a program that knows
//! nothing of this library has computed to 25 digits; `book/judge/known-answers/README.md` has the
//! conventions. The right-hand sides are formulas.
//!
//! ```
//! use pendula_judge::known_answers;
//!
//! let rk4 = known_answers::method("RK4").unwrap();
//! let first = &rk4.answers[0];
//! assert_eq!((rk4.name.as_str(), first.steps, first.scene.step), ("rk4", 1, 0.125));
//! ```

use std::sync::LazyLock;

use serde_json::Value;

use super::integrator::Drive;
use pendula::systems::Phase;

mod formula;
mod right_hand_sides;

pub use right_hand_sides::{
    Comparison, Point, RightHandSide, Wrong, right_hand_side, right_hand_sides,
};

/// A right method of the file, or a mistake in one.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Known {
    /// Its name.
    pub name: String,
    /// Its other names.
    pub also: Vec<String>,
    /// Its order; of a mistake 0.
    pub order: u32,
    /// What is wrong, in a mistake.
    pub mistake: Option<Mistake>,
    /// What it leads to.
    pub answers: Vec<Answer>,
}

/// What is wrong with a wrong method.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Mistake {
    /// The name of the method in which it is made.
    pub of: String,
    /// What is done, in a few words.
    pub what: String,
    /// What comes of it.
    pub effect: String,
    /// Where it was seen.
    pub seen: String,
}

/// The state after some steps.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Answer {
    /// From where and with what step.
    pub scene: &'static Scene,
    /// The number of steps.
    pub steps: u64,
    /// The state then (rad, rad/s).
    pub state: Phase,
    /// How far off a right program may be, in ε of its type times the larger of |θ| and |ω|.
    pub tolerance: f64,
}

impl Mistake {
    /// Whether its error vanishes with the step: the equation is the pendulum's, and the method is
    /// another one.
    pub(crate) fn converges(&self) -> bool {
        const OTHERWISE: [&str; 11] = [
            "does not converge",
            "order 0",
            "twice the",
            "half the",
            "runs at twice",
            "solves",
            "swings about",
            "another problem",
            "almost no force",
            "right only where",
            "right for a uniform",
        ];
        !OTHERWISE.iter().any(|begins| self.effect.starts_with(begins))
    }
}

/// The ε of a type of numbers. With any other all would be right, or nothing.
fn checked(epsilon: f64) -> f64 {
    // Half of that of f64, as others define it, and that of numbers with two digits.
    let allowed = f64::EPSILON / 2.0..=0.01;
    assert!(allowed.contains(&epsilon), "ε = {epsilon:?}: it must be at least 2⁻⁵³, at most 0.01");
    epsilon
}

impl Answer {
    /// How far off `state` is, in tolerances, for a program whose ε is `epsilon`: at most 1 for a
    /// right one, NaN for a NaN.
    ///
    /// # Panics
    /// If no type of numbers has this ε: it must be at least 2⁻⁵³ and at most 0.01.
    pub fn off(&self, state: Phase, epsilon: f64) -> f64 {
        let epsilon = checked(epsilon);
        let Phase { theta, omega } = self.state;
        let size = theta.abs().max(omega.abs());
        let off = libm::fmaximum((state.theta - theta).abs(), (state.omega - omega).abs());
        off / (self.tolerance * epsilon * size)
    }
}

/// A pendulum, θ̈ = −(g/L) sin θ + A cos Ωt, its start, and a step.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Scene {
    /// Its name in the file.
    pub name: String,
    /// g/L (1/s²).
    pub g_over_l: f64,
    /// The drive, if there is one.
    pub drive: Option<Drive>,
    /// The time at the start (s).
    pub time: f64,
    /// The state at the start (rad, rad/s).
    pub start: Phase,
    /// The step (s).
    pub step: f64,
}

/// The scenes of the file.
#[doc(hidden)]
pub fn scenes() -> &'static [Scene] {
    &SCENES
}

/// The right methods of the file.
#[doc(hidden)]
pub fn methods() -> &'static [Known] {
    &METHODS
}

/// The mistakes of the file.
#[doc(hidden)]
pub fn mistakes() -> &'static [Known] {
    &MISTAKES
}

/// A name as names are compared: in small letters, and without blanks, hyphens and underscores.
fn bare(name: &str) -> String {
    let is_kept = |c: &char| !(c.is_whitespace() || ['-', '–', '_'].contains(c));
    name.chars().filter(is_kept).collect::<String>().to_lowercase()
}

/// The names of the right methods that may be meant by a name that none has: of those that have it
/// in one of their names, or else its letters up to the first digit, or else two letters at most
/// that differ. None, if there is none.
pub(crate) fn meant(name: &str) -> Vec<&'static str> {
    let name = bare(name);
    let stem: String = name.chars().take_while(|c| !c.is_ascii_digit()).collect();
    let those = |is_like: &dyn Fn(&str) -> bool| -> Vec<&'static str> {
        let names = |known: &'static Known| known.also.iter().chain([&known.name]);
        let is_meant = |known: &&'static Known| names(known).any(|other| is_like(&bare(other)));
        methods().iter().filter(is_meant).map(|known| known.name.as_str()).collect()
    };
    let has = |part: &str, least: usize| match part.chars().count() < least {
        true => Vec::new(),
        false => those(&|other| other.contains(part)),
    };
    let with_a_slip = |other: &str| other.chars().count() > 4 && apart(&name, other) <= 2;
    let kinds = [has(&name, 3), has(&stem, 4), those(&with_a_slip)];
    kinds.into_iter().find(|those| !those.is_empty()).unwrap_or_default()
}

/// How many letters have to be changed, left out or put in to make one of the other; more than two
/// are three.
fn apart(one: &str, other: &str) -> usize {
    let [one, other] = [one, other].map(|word| word.chars().collect::<Vec<_>>());
    if one.len().abs_diff(other.len()) > 2 {
        return 3;
    }
    let mut row: Vec<usize> = (0..=other.len()).collect();
    for (i, c) in one.iter().enumerate() {
        let mut before = i;
        row[0] = i + 1;
        for (j, d) in other.iter().enumerate() {
            let changed = before + usize::from(c != d);
            before = row[j + 1];
            row[j + 1] = changed.min(row[j] + 1).min(before + 1);
        }
    }
    row[other.len()].min(3)
}

/// The right method of this name, among its other names too, in capitals or not, and with or
/// without blanks, hyphens and underscores: `velocity-verlet` is "velocity Verlet".
pub fn method(name: &str) -> Option<&'static Known> {
    let name = bare(name);
    let is = |other: &str| bare(other) == name;
    let by_name = methods().iter().find(|known| is(&known.name));
    by_name.or_else(|| methods().iter().find(|known| known.also.iter().any(|other| is(other))))
}

static FILE: LazyLock<Value> = LazyLock::new(|| {
    let text = include_str!("../known-answers/known-answers.json");
    serde_json::from_str(text).expect("the file is JSON")
});
static SCENES: LazyLock<Vec<Scene>> = LazyLock::new(|| {
    let scenes = FILE["scenes"].as_object().expect("the scenes by their names");
    scenes.iter().map(|(name, scene)| read_scene(name, scene)).collect()
});
static METHODS: LazyLock<Vec<Known>> = LazyLock::new(|| list("methods"));
static MISTAKES: LazyLock<Vec<Known>> = LazyLock::new(|| list("mistakes"));

// The file is part of the library, and its form is tested: what is missing from it is a mistake of
// ours.

fn list(name: &str) -> Vec<Known> {
    entries(&FILE[name]).iter().map(read_known).collect()
}

fn entries(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn text(value: &Value) -> String {
    value.as_str().expect("a text").to_string()
}

/// A decimal in a text, as binary has no tenths.
fn number(value: &Value) -> f64 {
    value.as_str().and_then(|text| text.parse().ok()).expect("a number in a text")
}

fn state(value: &Value) -> Phase {
    Phase { theta: number(&value["theta"]), omega: number(&value["omega"]) }
}

fn read_scene(name: &str, scene: &Value) -> Scene {
    let amplitude = number(&scene["amplitude"]);
    let drive = Drive { amplitude, frequency: number(&scene["frequency"]) };
    Scene {
        name: name.to_string(),
        g_over_l: number(&scene["g_over_l"]),
        drive: (amplitude != 0.0).then_some(drive),
        time: number(&scene["t"]),
        start: state(scene),
        step: number(&scene["h"]),
    }
}

fn read_known(known: &Value) -> Known {
    let mistake = known.get("of").map(|of| Mistake {
        of: text(of),
        what: text(&known["what"]),
        effect: text(&known["effect"]),
        seen: text(&known["seen"]),
    });
    Known {
        name: text(&known["name"]),
        also: entries(&known["also"]).iter().map(text).collect(),
        order: known["order"].as_u64().unwrap_or(0) as u32,
        mistake,
        answers: entries(&known["answers"]).iter().map(read_answer).collect(),
    }
}

fn read_answer(answer: &Value) -> Answer {
    let name = answer["scene"].as_str().expect("the name of a scene");
    Answer {
        scene: SCENES.iter().find(|scene| scene.name == name).expect("a scene of the file"),
        steps: answer["steps"].as_u64().expect("a number of steps"),
        state: state(answer),
        tolerance: number(&answer["tolerance"]),
    }
}
