//! The paper's numbers as they were read off its text a second time, against those of the ledger.

use std::collections::BTreeSet;

use pendula_study::claims::{Claim, ClaimKind};
use pendula_study::report::table::Table;

use crate::LEDGER;

/// A cell of a table or a number of a sentence, and the ids of the claims that say it.
#[derive(Debug)]
struct Printed {
    claims: &'static str,
    place: &'static str,
    column: &'static str,
    text: &'static str,
}

fn transcription() -> impl Iterator<Item = Printed> {
    let lines = include_str!("../data/paper.csv").lines().filter(|line| !line.starts_with('#'));
    lines.skip(1).map(|line| {
        let fields: Vec<&str> = line.splitn(5, ',').collect();
        let [claims, place, _row, column, text] = fields[..] else { panic!("{line}") };
        Printed { claims, place, column, text: text.trim_matches('"') }
    })
}

/// Whether it is a cell.
fn is_cell(printed: &Printed) -> bool {
    printed.place.starts_with("Table ")
}

fn claim_with(id: &str) -> &'static Claim {
    LEDGER.get(id).unwrap_or_else(|| panic!("{id} is not in the ledger"))
}

/// A cell as the ledger writes it: no unit, no separator of thousands, and `e` for powers of ten.
fn as_stated(printed: &str) -> String {
    let number = printed.trim_end_matches(" s").trim_end_matches('%').replace(',', "");
    number.replace("×10^", "e").replace(['{', '}'], "")
}

/// Catches: a cell misquoted in the ledger, whose verdict may be the same by chance; one left out,
/// or put under another method, step or quantity.
#[test]
fn every_cell_of_the_ledger_is_as_the_paper_prints_it() {
    let mut read = BTreeSet::new();
    for printed in transcription().filter(is_cell) {
        let claim = claim_with(printed.claims);
        assert_eq!(claim.stated, Some(as_stated(printed.text).as_str()), "{printed:?}");
        assert_eq!(claim.place, printed.place, "{printed:?}");
        assert!(read.insert(printed.claims), "{printed:?} stands twice");
    }
    assert_eq!(read.len(), 92);
    for claim in LEDGER.claims().iter().filter(|claim| claim.kind() == ClaimKind::Cell) {
        assert!(read.contains(claim.id.as_str()), "{} is not printed in the paper", claim.id);
    }
}

/// The numbers in a text, each once: `O(Δt^4)` is 4, `three` orders of magnitude are `10³`, `< 10⁵`
/// is 10⁵.
fn numbers(text: &str, column: &str) -> BTreeSet<String> {
    let mut text = text.replace("O(Δt)", "1").replace("O(Δt^", "(").replace(['%', '+'], "");
    for (word, number) in [("two", "2"), ("three", "3"), ("four", "4"), ("five", "5")] {
        text = text.replace(word, number);
    }
    let superscripts = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻";
    let raised = |c: char| superscripts.chars().position(|s| s == c);
    // Powers of ten as exponents.
    for power in ["×10^", "10^", "10"] {
        let next = text.split_once(power).map(|(_, rest)| rest.chars().next());
        let is_power = power != "10" || matches!(next, Some(Some(c)) if raised(c).is_some());
        if is_power {
            text = text.replace(power, if power == "×10^" { "e" } else { "1e" });
        }
    }
    let text: String = text
        .chars()
        .map(|c| raised(c).map_or(c, |digit| "0123456789-".chars().nth(digit).unwrap()))
        .filter(|c| !"{}".contains(*c))
        .collect();
    let text = text.replace("9,090", "9090");
    let parts = text.split(|c: char| !(c.is_ascii_digit() || ".e-".contains(c)));
    let values = parts.filter_map(|part| part.parse::<f64>().ok());
    let power =
        |value: f64| if column == "orders of magnitude" { 10_f64.powf(value) } else { value };
    values.map(|value| power(value).to_string()).collect()
}

/// What a claim states, in words or numbers of its own.
fn has_a_number(claim: &Claim) -> bool {
    let stated = claim.stated.unwrap_or_default().replace("RK4", "");
    // A reference to an equation is no number of the paper's.
    claim.kind() == ClaimKind::Sentence
        && !claim.id.starts_with('T')
        && !stated.starts_with("Eq. ")
        && !numbers(&stated, "").is_empty()
}

/// Catches: a number of a sentence misquoted in the ledger, or one that the paper does not have.
#[test]
fn every_number_of_a_sentence_is_the_papers() {
    let mut read = BTreeSet::new();
    for printed in transcription().filter(|printed| !is_cell(printed)) {
        for id in printed.claims.split(' ') {
            let stated = numbers(claim_with(id).stated.unwrap(), "");
            assert!(!stated.is_empty(), "{id} states no number");
            assert_eq!(stated, numbers(printed.text, printed.column), "{id}: {printed:?}");
            read.insert(id);
        }
    }
    for claim in LEDGER.claims().iter().filter(|claim| has_a_number(claim)) {
        assert!(read.contains(claim.id.as_str()), "{} is in no sentence of paper.csv", claim.id);
    }
}

/// The tables of `sentences.md`: what is judged, what is not, and what claims nothing.
fn sentences() -> [Table; 3] {
    let parts = include_str!("../data/sentences.md").split("\n# ").skip(1);
    let tables = parts.map(|part| {
        let lines = part.lines().filter(|line| line.starts_with('|'));
        let rows: String = lines.map(|line| format!("{line}\n")).collect();
        Table::read(&rows).expect("even rows")
    });
    tables.collect::<Vec<_>>().try_into().expect("three tables")
}

/// The claims of the paper that an id names, or `T4.*`.
fn named(id: &str) -> Vec<&'static Claim> {
    let claims = LEDGER.claims().iter().filter(|claim| claim.is_of_the_paper());
    let is_named = |claim: &&Claim| match id.strip_suffix('*') {
        Some(start) => claim.id.starts_with(start),
        None => claim.id == id,
    };
    claims.filter(is_named).collect()
}

/// Catches: a claim of the ledger that no sentence of the paper makes; a sentence that is judged by
/// a claim which there is not; one that is judged in part, without the rest; a page that counts
/// other sentences.
#[test]
fn every_sentence_is_judged_or_said_not_to_be() {
    let [judged, unjudged, nothing] = sentences();
    let mut made = BTreeSet::new();
    let mut in_part = Vec::new();
    for row in judged.rows() {
        let [place, _, ids] = row.cells else { panic!("{row:?}") };
        let (place, ids) = (&place.text, &ids.text);
        let whole = ids.trim_end_matches("in part");
        if whole != ids {
            in_part.push(format!("{place}, rest"));
        }
        for id in whole.split_whitespace() {
            let claims = named(id);
            assert!(!claims.is_empty(), "{row:?}: {id} is not in the ledger");
            made.extend(claims.into_iter().map(|claim| claim.id.as_str()));
        }
    }
    for claim in LEDGER.claims().iter().filter(|claim| claim.kind() == ClaimKind::Sentence) {
        assert!(made.contains(claim.id.as_str()), "no sentence makes {}", claim.id);
    }

    let places = unjudged.rows().map(|row| row.id().to_string());
    let (rests, whole): (Vec<String>, Vec<String>) =
        places.partition(|place| place.ends_with(", rest"));
    assert_eq!(rests, in_part, "the rests of sentences that are judged in part");
    let claiming = judged.rows().len() + whole.len();
    let all = claiming + nothing.rows().len();
    let page = include_str!("../../book/src/appendix-claims.md");
    let page = page.split_whitespace().collect::<Vec<_>>().join(" ");
    let says = format!(
        "{claiming} of the paper's {all} sentences claim something. The rows judge {} of them, {} \
         of these in part; they leave out {} sentences",
        judged.rows().len(),
        rests.len(),
        whole.len()
    );
    assert!(page.contains(&says), "the page does not say: {says}");
}
