//! The paper's claims, each with what was stated, what is measured, and a verdict.
//!
//! [`stated`] holds what the paper says, from two files of data; `measure` says how each cell of
//! its tables is measured, and `sentences` each of its sentences. A [`Ledger`] joins them. Tables,
//! tests and the book read the ledger, so that no number stands in two places.

mod measure;
mod predictions;
mod sentences;
pub mod stated;

use core::fmt::{self, Display};

pub use predictions::{Prediction, predictions};
use serde::Deserialize;

use crate::digits::{Digits, rounds_to, typeset};
use crate::experiments::{PaperMethod, Study};

/// What became of a claim. [`Verdict::meaning`] says what each is: to who asks the program, in the
/// book and in a review.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
#[expect(missing_docs, reason = "their meaning is said once")]
pub enum Verdict {
    Reproduced,
    ReproducedWithDefinition,
    DependsOnPlatform,
    NotSupported,
    Wrong,
    NotCheckable,
    NotStated,
}

impl Verdict {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Reproduced,
        Self::ReproducedWithDefinition,
        Self::DependsOnPlatform,
        Self::NotSupported,
        Self::Wrong,
        Self::NotCheckable,
        Self::NotStated,
    ];

    /// What it says of a claim.
    pub const fn meaning(self) -> &'static str {
        match self {
            Self::Reproduced => {
                "every printed digit is met, to half a unit of the last one; or the sentence is \
                 true as it stands"
            }
            Self::ReproducedWithDefinition => {
                "met, or true, once something is added that the paper leaves open and that is \
                 named beside it: what exactly was measured, or a condition that the paper's own \
                 runs satisfy"
            }
            Self::DependsOnPlatform => {
                "no property of the method: another machine, interpreter or sine gives another \
                 number, as for every time on a clock"
            }
            Self::NotSupported => {
                "what the paper gives as evidence would look the same if the claim were false; \
                 what else looks so was measured"
            }
            Self::Wrong => "the measurement contradicts it",
            Self::NotCheckable => "no measurement bears on it",
            Self::NotStated => "the paper leaves it out, and we added it",
        }
    }

    /// The verdict that is printed so.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|verdict| verdict.to_string() == name)
    }

    /// Whether a claim with this verdict has to hold (`true`) or to fail (`false`); `None` where
    /// it requires no measurement.
    pub const fn demands(self) -> Option<bool> {
        match self {
            Self::Reproduced | Self::ReproducedWithDefinition => Some(true),
            Self::NotSupported | Self::Wrong => Some(false),
            Self::DependsOnPlatform | Self::NotCheckable | Self::NotStated => None,
        }
    }
}

impl Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Reproduced => "reproduced",
            Self::ReproducedWithDefinition => "reproduced with a definition",
            Self::DependsOnPlatform => "depends on the platform",
            Self::NotSupported => "not supported",
            Self::Wrong => "wrong",
            Self::NotCheckable => "not checkable",
            Self::NotStated => "not stated",
        })
    }
}

/// What a claim is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ClaimKind {
    /// A cell of a table of results.
    Cell,
    /// A sentence of the paper, or a cell of its tables of parameters.
    Sentence,
    /// A question that the paper's text leaves open and its numbers decide: no claim of the paper,
    /// and not counted as one.
    Reading,
    /// A number that the paper does not have, and that the book quotes.
    Finding,
}

impl Display for ClaimKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Cell => "cell",
            Self::Sentence => "sentence",
            Self::Reading => "reading",
            Self::Finding => "finding",
        })
    }
}

/// What was measured.
#[derive(Clone, Debug, PartialEq)]
pub enum Measured {
    /// A number, and the digits of it that can be defended.
    Number(f64, Digits),
    /// A property in words.
    Text(String),
    /// Nothing: there is nothing to compute, or it is no property of the method.
    Nothing,
}

/// How close is close enough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tolerance {
    /// Half a unit in the last digit that the paper prints; words have to be the same words.
    PrintedDigits,
    /// A relative distance from a value, for a number that rounding moves by more than the paper's
    /// last digit.
    Around {
        /// The value that truncation alone would give.
        value: f64,
        /// How far rounding moves it, relatively.
        relative: f64,
    },
    /// A comparison in code has decided whether the claim holds.
    Decided(bool),
}

/// A claim of the paper, measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// Table, row and column, such as `T4.rk4.0.01`.
    pub id: String,
    /// Where in the paper it stands.
    pub place: &'static str,
    /// What is claimed, in our words.
    pub gist: String,
    /// What exactly is measured, where the paper leaves it open.
    pub definition: &'static str,
    /// What the paper prints, with its digits; `None` for what it leaves out.
    pub stated: Option<&'static str>,
    /// What is measured.
    pub measured: Measured,
    /// How close it has to come.
    pub tolerance: Tolerance,
    /// The verdict on record, which a test compares with the measurement.
    pub verdict: Verdict,
    /// One sentence on the verdict; empty where there is nothing to add.
    pub because: &'static str,
}

impl Claim {
    /// What it is. Its id says so.
    pub fn kind(&self) -> ClaimKind {
        match self.stated {
            None => ClaimKind::Finding,
            Some(_) if self.id.starts_with("X.") => ClaimKind::Reading,
            Some(_) if stated::cell(&self.id).is_some() => ClaimKind::Cell,
            Some(_) => ClaimKind::Sentence,
        }
    }

    /// Whether the paper makes it.
    pub fn is_of_the_paper(&self) -> bool {
        matches!(self.kind(), ClaimKind::Cell | ClaimKind::Sentence)
    }

    /// Whether the measurement agrees with what is stated; `None` where one of them is missing.
    pub fn holds(&self) -> Option<bool> {
        let stated = self.stated?;
        match (&self.measured, self.tolerance) {
            (Measured::Nothing, _) => None,
            (_, Tolerance::Decided(holds)) => Some(holds),
            (Measured::Text(text), _) => Some(text == stated),
            (Measured::Number(measured, _), Tolerance::PrintedDigits) => {
                rounds_to(*measured, stated)
            }
            (Measured::Number(measured, _), Tolerance::Around { value, relative }) => {
                Some((measured - value).abs() <= relative * value.abs())
            }
        }
    }

    /// The verdict that the measurement supports: the one on record where they agree.
    pub fn judged(&self) -> Verdict {
        match (self.holds(), self.verdict.demands()) {
            (Some(holds), Some(demanded)) if holds != demanded => {
                if holds {
                    Verdict::Reproduced
                } else {
                    Verdict::Wrong
                }
            }
            // A number that depends on the platform still has to be within its tolerance.
            (Some(false), None) => Verdict::Wrong,
            _ => self.verdict,
        }
    }

    /// What the paper prints, typeset; a dash where it prints nothing.
    pub fn stated_text(&self) -> String {
        match self.stated {
            None => "—".to_string(),
            Some(stated) if stated.parse::<f64>().is_ok() => typeset(stated),
            Some(words) => words.to_string(),
        }
    }

    /// What is measured, with the digits that can be defended, typeset; a dash where nothing is.
    pub fn measured_text(&self) -> String {
        match self.measured {
            Measured::Number(value, format) => format.print(value),
            _ => self.measured_literal(),
        }
    }

    /// The same, with a number as a program writes it.
    pub fn measured_literal(&self) -> String {
        match &self.measured {
            Measured::Number(value, format) => format.literal(*value),
            Measured::Text(text) => text.clone(),
            Measured::Nothing => "—".to_string(),
        }
    }
}

/// The id of a cell in the row of a method: `T4.rk4.0.01` is that of a step (s), `T5.fe.dH` that of
/// a quantity. The cells of Table 7, which has no such rows, are `T7.Texact` and so on.
pub fn cell_id(table: u32, row: PaperMethod, column: impl Display) -> String {
    format!("T{table}.{}.{column}", row.id())
}

/// The method of the row that the cell with this id stands in, if it is one of [`cell_id`].
pub fn method_of(id: &str) -> Option<PaperMethod> {
    let row = id.strip_prefix('T')?.split('.').nth(1)?;
    PaperMethod::ALL.into_iter().find(|method| method.id() == row)
}

/// The row of the method `id` in a table of rows.
macro_rules! row {
    ($rows:expr, $id:ident) => {
        $rows
            .iter()
            .find(|row| PaperMethod::of(row.method) == Some(PaperMethod::$id))
            .expect("one of the paper's methods")
    };
}
use row;

/// Claims of the paper that state one thing several times: each list is one error, if it is wrong.
const ONE_DEFECT: &[&[&str]] = &[
    // RK4's energy error falls with slope 5 where 4 is stated.
    &["P1.orders", "P6.1.slope", "P7.2.precise", "P8.order"],
    // A symplectic method's energy error is bounded in short steps and bounded regions only.
    &["P2.alltime", "P4.se_symp"],
    // Forward Euler's energy does not grow monotonically.
    &["P6.2.mono", "T2.fe.behav"],
];

/// Every claim, measured by one run of the study.
#[derive(Clone, Debug, PartialEq)]
pub struct Ledger {
    claims: Vec<Claim>,
}

impl Ledger {
    /// Measures every claim.
    pub fn new(study: &Study) -> Self {
        let Self { mut claims } = Self::of_the_tables(study);
        claims.extend(sentences::claims(study));
        Self { claims }
    }

    /// Measures the claims of the tables alone.
    pub fn of_the_tables(study: &Study) -> Self {
        Self { claims: measure::claims(study) }
    }

    /// All claims: table by table, then sentence by sentence.
    pub fn claims(&self) -> &[Claim] {
        &self.claims
    }

    /// The claim with this id.
    pub fn get(&self, id: &str) -> Option<&Claim> {
        self.claims.iter().find(|claim| claim.id == id)
    }

    /// How many claims of the paper are wrong, and how many different errors that is: what is said
    /// several times is wrong once.
    pub fn wrong(&self) -> (usize, usize) {
        let wrong: Vec<&str> = self
            .claims
            .iter()
            .filter(|claim| claim.is_of_the_paper() && claim.verdict == Verdict::Wrong)
            .map(|claim| claim.id.as_str())
            .collect();
        let repeated = ONE_DEFECT
            .iter()
            .map(|ids| ids.iter().filter(|id| wrong.contains(id)).count().saturating_sub(1));
        (wrong.len(), wrong.len() - repeated.sum::<usize>())
    }

    /// The claims of one table.
    pub fn table(&self, number: u32) -> impl Iterator<Item = &Claim> {
        let prefix = format!("T{number}.");
        self.claims.iter().filter(move |claim| claim.id.starts_with(&prefix))
    }
}

#[cfg(test)]
mod tests {
    use rstest::rstest;

    use super::Tolerance::{Around, Decided, PrintedDigits};
    use super::Verdict::{
        DependsOnPlatform, NotCheckable, NotStated, NotSupported, Reproduced,
        ReproducedWithDefinition, Wrong,
    };
    use super::{Claim, Digits, Ledger, Measured, Tolerance, Verdict};

    /// From 1.5 to 2.5.
    const NEAR_2: Tolerance = Around { value: 2.0, relative: 0.25 };
    const NEAR_MINUS_2: Tolerance = Around { value: -2.0, relative: 0.25 };

    fn claim(stated: &'static str, measured: Measured, tolerance: Tolerance) -> Claim {
        Claim {
            id: "T0".to_string(),
            place: "Table 0",
            gist: String::new(),
            definition: "",
            stated: Some(stated),
            measured,
            tolerance,
            verdict: Reproduced,
            because: "",
        }
    }

    fn number(value: f64) -> Measured {
        Measured::Number(value, Digits::Fixed(1))
    }

    fn text(words: &str) -> Measured {
        Measured::Text(words.to_string())
    }

    /// The bounds are binary fractions, so that a number can lie on them, and its neighbour
    /// beyond. A relative distance is from `value`, not from what is printed.
    ///
    /// Catches: a tolerance wider, narrower or one-sided, and one kind of tolerance taken for
    /// another.
    #[rstest]
    #[case::on_the_bound("3", number(3.5), PrintedDigits, Some(true))]
    #[case::past_it("3", number(3.5_f64.next_up()), PrintedDigits, Some(false))]
    #[case::no_number("three", number(3.0), PrintedDigits, None)]
    #[case::on_top("9", number(2.5), NEAR_2, Some(true))]
    #[case::over_it("9", number(2.5_f64.next_up()), NEAR_2, Some(false))]
    #[case::at_the_bottom("9", number(1.5), NEAR_2, Some(true))]
    #[case::under_it("9", number(1.5_f64.next_down()), NEAR_2, Some(false))]
    #[case::negative("9", number(-2.5), NEAR_MINUS_2, Some(true))]
    #[case::the_wrong_sign("9", number(2.0), NEAR_MINUS_2, Some(false))]
    #[case::the_same_words("Yes", text("Yes"), PrintedDigits, Some(true))]
    #[case::other_words("Yes", text("No"), PrintedDigits, Some(false))]
    #[case::decided_for_a_number("3", number(9.0), Decided(true), Some(true))]
    #[case::decided_against_one("3", number(3.0), Decided(false), Some(false))]
    #[case::decided_for_words("Yes", text("No"), Decided(true), Some(true))]
    #[case::decided_on_nothing("3", Measured::Nothing, Decided(true), None)]
    #[case::nothing("3", Measured::Nothing, PrintedDigits, None)]
    fn a_claim_holds_within_its_tolerance(
        #[case] stated: &'static str,
        #[case] measured: Measured,
        #[case] tolerance: Tolerance,
        #[case] holds: Option<bool>,
    ) {
        let mut claim = claim(stated, measured, tolerance);
        assert_eq!(claim.holds(), holds);
        claim.stated = None;
        assert_eq!(claim.holds(), None, "nothing is stated");
    }

    /// What each verdict becomes where the measurement holds, where it fails, and where there is
    /// none.
    ///
    /// Catches: a verdict that demands too much, too little or the opposite, and one kept against
    /// its measurement.
    #[rstest]
    #[case(Reproduced, Some(true), Reproduced)]
    #[case(ReproducedWithDefinition, Some(true), ReproducedWithDefinition)]
    #[case(NotSupported, Some(false), Reproduced)]
    #[case(Wrong, Some(false), Reproduced)]
    #[case(DependsOnPlatform, None, DependsOnPlatform)]
    #[case(NotCheckable, None, NotCheckable)]
    #[case(NotStated, None, NotStated)]
    fn a_verdict_is_judged_by_what_it_demands(
        #[case] verdict: Verdict,
        #[case] demands: Option<bool>,
        #[case] where_it_holds: Verdict,
    ) {
        assert_eq!(verdict.demands(), demands);
        let judged =
            |measured, tolerance| Claim { verdict, ..claim("3", measured, tolerance) }.judged();
        assert_eq!(judged(number(3.0), Decided(true)), where_it_holds);
        let where_it_fails = if verdict == NotSupported { NotSupported } else { Wrong };
        assert_eq!(judged(number(3.0), Decided(false)), where_it_fails);
        assert_eq!(judged(Measured::Nothing, PrintedDigits), verdict);
        assert_eq!(Verdict::named(&verdict.to_string()), Some(verdict));
    }

    /// Catches: a question of ours counted among the errors of the paper; what it says twice
    /// counted as two errors, or two errors as one.
    #[test]
    fn errors_are_those_of_the_paper_and_counted_once() {
        let wrong = |id: &str| {
            let claim = claim("1", number(2.0), PrintedDigits);
            Claim { id: id.to_string(), verdict: Wrong, ..claim }
        };
        let of = |ids: &[&str]| Ledger { claims: ids.iter().map(|id| wrong(id)).collect() }.wrong();
        assert_eq!(of(&["P1.orders", "X.bold"]), (1, 1));
        assert_eq!(of(&["P1.orders", "P8.order"]), (2, 1));
        assert_eq!(of(&["P1.orders", "P6.2.mono", "T2.fe.behav"]), (3, 2));
    }
}
