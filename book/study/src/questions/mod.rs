//! What is right in the questions of the book, computed.
//!
//! A chapter asks, and has a sentence for each answer that readers believe, which says why it is
//! right or wrong. Which answer is right is computed here, and so are the numbers to which usual
//! mistakes lead. A question is known by its id, which begins with its chapter's name.

mod adaptive_steps;
mod choosing;
mod exam;
mod forward_euler;
mod friction_and_drives;
mod higher_order;
mod introduction;
mod judging;
mod limits;
mod long_run;
mod order;
mod other_systems;
mod others;
mod pendulum;
mod phase_space;
mod rk4;
mod small_angle;
mod stormer_verlet;
mod symplectic_euler;
mod tolerance;

/// What is right.
#[derive(Clone, Debug, PartialEq)]
pub enum Truth {
    /// Of each choice whether it is right: of one alone.
    Which(Vec<(&'static str, bool)>),
    /// The right number, in the question's unit, and those to which usual mistakes lead.
    Number {
        /// What a reader should answer.
        right: f64,
        /// How far from it an answer may be.
        within: Within,
        /// What each mistake gives in its place.
        mistakes: Vec<(&'static str, f64)>,
    },
    /// All items in the order that is asked for.
    Order(Vec<&'static str>),
}

impl Truth {
    /// The items from the smallest value to the largest.
    ///
    /// # Panics
    ///
    /// If two values are so close, within a fifth, that no reader could tell them apart.
    pub fn ascending(mut items: Vec<(&'static str, f64)>) -> Self {
        items.sort_by(|one, other| one.1.total_cmp(&other.1));
        for pair in items.windows(2) {
            assert!(pair[1].1 > 1.2 * pair[0].1, "{pair:?} are too close to be put in order");
        }
        Self::Order(items.into_iter().map(|(name, _)| name).collect())
    }

    /// The choice to whose number the measured one comes nearest, by ratio; each must be positive.
    /// Right is the one within a tenth of it, so that none is if the measurement has moved away
    /// from all.
    pub fn nearest(measured: f64, choices: &[(&'static str, f64)]) -> Self {
        let is_it = |expected: f64| libm::log(measured / expected).abs() < 0.1;
        Self::Which(choices.iter().map(|&(name, expected)| (name, is_it(expected))).collect())
    }
}

/// How far from the right number an answer still counts as right. Each question has its own, for a
/// reason that stands beside it: so much that whoever works with the numbers of the question, in
/// the head or to two digits, is right, and no more.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Within {
    /// So many per cent of it.
    Percent(f64),
    /// So many more or fewer, of what is counted.
    Count(u32),
}

/// How near (per cent) to the number of a mistake an answer is taken for that mistake.
pub const MISTAKEN: Within = Within::Percent(10.0);

impl Within {
    /// From where to where an answer counts.
    pub fn range(self, number: f64) -> [f64; 2] {
        let off = match self {
            Self::Percent(percent) => percent / 100.0 * number,
            Self::Count(count) => count.into(),
        };
        [number - off, number + off]
    }

    /// What the reader is told, beside the field.
    pub fn said(self) -> String {
        match self {
            Self::Percent(percent) => format!("within {percent} % counts"),
            Self::Count(count) => format!("{count} more or less counts"),
        }
    }
}

/// Where a question's truth comes from.
pub type Compute = fn() -> Truth;

/// The questions of each chapter.
const CHAPTERS: &[&[(&str, Compute)]] = &[
    introduction::QUESTIONS,
    pendulum::QUESTIONS,
    forward_euler::QUESTIONS,
    symplectic_euler::QUESTIONS,
    stormer_verlet::QUESTIONS,
    rk4::QUESTIONS,
    order::QUESTIONS,
    long_run::QUESTIONS,
    phase_space::QUESTIONS,
    small_angle::QUESTIONS,
    limits::QUESTIONS,
    higher_order::QUESTIONS,
    adaptive_steps::QUESTIONS,
    tolerance::QUESTIONS,
    friction_and_drives::QUESTIONS,
    other_systems::QUESTIONS,
    choosing::QUESTIONS,
    judging::QUESTIONS,
    others::QUESTIONS,
    exam::QUESTIONS,
];

/// The questions by their ids, and what computes what is right in each.
pub fn all() -> impl Iterator<Item = (&'static str, Compute)> {
    CHAPTERS.iter().copied().flatten().copied()
}

/// What is right in the question with this id; nothing if there is none.
pub fn truth(id: &str) -> Option<Truth> {
    all().find(|(known, _)| *known == id).map(|(_, truth)| truth())
}
