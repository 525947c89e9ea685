//! The claims and the predictions of a version, read from its snapshots.

use std::collections::BTreeMap;

use anyhow::{Context, Result};
use pendula_study::report::table::Table;

use super::number::{Number, leading};
use super::versions::Version;

/// A claim, as the ledger of a version has it.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// What is claimed.
    pub gist: String,
    /// What the paper prints.
    pub stated: String,
    /// What is measured.
    pub measured: String,
    /// The verdict in a word or a few.
    pub verdict: String,
    /// The reason, or what is on record instead.
    pub remark: String,
    /// Whether the verdict contradicts the one on record.
    pub contradicts: bool,
}

/// What theory predicts for a claim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prediction {
    /// The predicted value.
    pub value: f64,
    /// How far, relatively, a measured value may lie from it.
    pub tolerance: f64,
    /// What is measured.
    pub measured: f64,
    /// How far the two may be from what is printed of them.
    pub rounding: f64,
    /// Whether the row is marked: then it lies outside its tolerance, whatever its digits say.
    pub marked: bool,
}

impl Prediction {
    /// The distance of the prediction from the measurement in units of the tolerance: the least
    /// that their printed digits allow.
    pub fn distance(&self) -> f64 {
        let apart = ((self.value - self.measured).abs() - self.rounding).max(0.0);
        apart / self.measured.abs() / self.tolerance
    }

    /// Whether the measurement lies within the tolerance.
    pub fn agrees(&self) -> bool {
        !self.marked && self.distance() <= 1.0
    }
}

/// The claims and predictions of a version.
#[derive(Clone, Debug, Default)]
pub struct Claims {
    /// Each claim by its id, in the order of the ledger.
    pub claims: BTreeMap<String, Claim>,
    /// The ids in the order of the ledger.
    pub order: Vec<String>,
    /// Each prediction by the id of its claim.
    pub predictions: BTreeMap<String, Prediction>,
}

impl Claims {
    /// Reads them; a version may lack a ledger.
    ///
    /// # Errors
    /// If a ledger or the predictions are no table.
    pub fn read(version: &Version) -> Result<Self> {
        let mut read = Self::default();
        for name in ["ledger_cells", "ledger_sentences"] {
            let Some(table) = table(version, name)? else { continue };
            for row in table.rows() {
                let Some((id, gist)) = id_and_gist(&row[0]) else { continue };
                let column = |heading: &str| {
                    let column = table.header().iter().position(|known| known == heading);
                    column.map(|column| row[column].clone()).unwrap_or_default()
                };
                let (verdict, remark, contradicts) = verdict(&column("verdict"));
                let (stated, measured) = (column("stated"), column("measured"));
                let gist = gist.to_string();
                let claim = Claim { gist, stated, measured, verdict, remark, contradicts };
                read.order.push(id.to_string());
                read.claims.insert(id.to_string(), claim);
            }
        }
        if let Some(table) = table(version, "predictions")? {
            for row in table.rows() {
                let [cell, _, predicted, measured, tolerance, ..] = &row[..] else { continue };
                let number = |cell: &String| leading(cell.trim_start_matches(['≠', ' ']));
                let numbers = [predicted, measured, tolerance].map(number);
                if let [Some(value), Some(found), Some(tolerance)] = numbers {
                    let prediction = Prediction {
                        value: value.value,
                        tolerance: tolerance.value,
                        measured: found.value,
                        rounding: value.half_unit + found.half_unit,
                        marked: measured.contains('≠'),
                    };
                    read.predictions.insert(cell.trim_matches('`').to_string(), prediction);
                }
            }
        }
        Ok(read)
    }

    /// The distance of a claim's measurement from what the paper prints, in half units of its last
    /// digit.
    pub fn half_units(&self, id: &str) -> Option<f64> {
        let claim = self.claims.get(id)?;
        let Number { value: stated, half_unit, .. } = leading(&claim.stated)?;
        Some((value(&claim.measured)? - stated).abs() / half_unit)
    }
}

/// The table of a snapshot; `None` if the version has no such snapshot.
///
/// # Errors
/// If it is no table.
pub fn table(version: &Version, name: &str) -> Result<Option<Table>> {
    let Some(content) = version.get(name) else { return Ok(None) };
    let table = Table::from_markdown(&content.text);
    table.map(Some).with_context(|| format!("{name}: corrupt: not a table of even rows"))
}

/// The id and the rest of a ledger's first cell.
pub fn id_and_gist(cell: &str) -> Option<(&str, &str)> {
    let (id, gist) = cell.strip_prefix('`')?.split_once('`')?;
    Some((id, gist.trim()))
}

fn value(cell: &str) -> Option<f64> {
    Some(leading(cell.trim_start_matches(['≠', ' ']))?.value)
}

/// The word, the remark, and whether it contradicts the record.
fn verdict(cell: &str) -> (String, String, bool) {
    let (contradicts, cell) = match cell.strip_prefix("≠ ") {
        Some(rest) => (true, rest),
        None => (false, cell),
    };
    let (word, remark) = match cell.strip_prefix("**").and_then(|rest| rest.split_once("**")) {
        Some((word, remark)) => (word, remark.trim_start_matches('.').trim()),
        None => (cell, ""),
    };
    (word.to_string(), remark.to_string(), contradicts)
}

#[cfg(test)]
mod tests {
    use pendula_study::report::snapshots::Kind;

    use super::super::versions::Content;
    use super::*;

    fn version(tables: &[(&str, &str)]) -> Version {
        let content = |text: &str| Content { kind: Kind::Table, text: text.to_string() };
        tables.iter().map(|(name, text)| (name.to_string(), content(text))).collect()
    }

    /// Catches: a verdict with its mark or its reason in it, a contradiction that is overlooked, a
    /// prediction whose columns are mixed up, half a unit taken for a whole one.
    #[test]
    fn a_ledger_is_read() {
        let version = version(&[
            (
                "ledger_cells",
                "| Claim | stated | measured | verdict |\n| --- | --- | --- | --- |\n\
                 | `T4.vv.0.1` an error | 1.10 × 10⁻¹ | 1.12 × 10⁻¹ | ≠ **wrong** (on record: \
                 reproduced) |\n| `T5.x` else | 2 | 2 | **wrong**. Because. |\n",
            ),
            (
                "predictions",
                "| Cell | stated | predicted | measured | to within | law |\n\
                 | --- | --- | --- | --- | --- | --- |\n\
                 | `T4.vv.0.1` | 1 | 1.10 × 10⁻¹ | ≠ 1.00 × 10⁻¹ | 1 × 10⁻² | a law |\n",
            ),
        ]);
        let claims = Claims::read(&version).unwrap();
        let claim = &claims.claims["T4.vv.0.1"];
        assert_eq!((claim.verdict.as_str(), claim.contradicts), ("wrong", true));
        assert_eq!(claims.claims["T5.x"].remark, "Because.");
        assert_eq!(claims.order, ["T4.vv.0.1", "T5.x"]);
        let near = |value: f64, expected: f64| assert!((value - expected).abs() < 1e-9, "{value}");
        near(claims.half_units("T4.vv.0.1").unwrap(), 4.0);
        // (1.10 − 1.00 − 2 · 0.005)/1.00 over 0.01: either may be off by half a unit.
        near(claims.predictions["T4.vv.0.1"].distance(), 9.0);
        assert!(!claims.predictions["T4.vv.0.1"].agrees());
    }

    /// Catches: a corrupt ledger read as an empty one.
    #[test]
    fn what_is_no_table_is_refused() {
        assert!(Claims::read(&version(&[("predictions", "| a |\nb\n")])).is_err());
    }
}
