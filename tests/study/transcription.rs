//! The paper's numbers as they were read off its text a second time, against those of the ledger.

use std::collections::BTreeSet;

use pendula_study::claims::{Claim, ClaimKind};

use crate::LEDGER;

/// A cell of a table or a number of a sentence.
#[derive(Debug)]
struct Printed {
    place: &'static str,
    row: &'static str,
    column: &'static str,
    text: &'static str,
}

fn transcription() -> Vec<Printed> {
    let lines = include_str!("../data/paper.csv").lines().filter(|line| !line.starts_with('#'));
    let printed = lines.skip(1).map(|line| {
        let mut fields = line.splitn(4, ',');
        let mut next = || fields.next().unwrap_or_else(|| panic!("{line}"));
        let (place, row, column) = (next(), next(), next());
        Printed { place, row, column, text: next().trim_matches('"') }
    });
    printed.collect()
}

/// The ledger's id of a cell, by the headings of its table.
fn cell_id(Printed { place, row, column, .. }: &Printed) -> String {
    let table = place.strip_prefix("Table ").expect("a table");
    let row = match *row {
        "Forward Euler" => "fe.",
        "Symplectic Euler" => "se.",
        "RK4" => "rk4.",
        "Störmer–Verlet" => "vv.",
        _ => row,
    };
    let column = match (table, row, *column) {
        ("1", "g", _) | ("3", "Gravitational acceleration", _) => return format!("T{table}.g"),
        ("3", "Pendulum length", _) => return "T3.L".to_string(),
        ("3", "Bob mass", _) => return "T3.m".to_string(),
        ("3", "Initial angular velocity", _) => return "T3.omega0".to_string(),
        ("7", "Exact period", _) => return "T7.Texact".to_string(),
        ("7", "Numerical period", _) => return "T7.Tnum".to_string(),
        ("7", "Relative error", _) => return "T7.relerr".to_string(),
        ("7", "Small-angle period", _) => return "T7.T0".to_string(),
        ("7", "Period ratio", _) => return "T7.ratio".to_string(),
        ("7", "Elliptic modulus", "Value") => return "T7.k".to_string(),
        ("7", "Elliptic modulus", "Caption") => return "T7.caption_k".to_string(),
        ("2", _, "Order") => "order",
        ("2", _, "Symplectic") => "sympl",
        ("2", _, "Evals/Step") => "evals",
        ("2", _, "Energy Behavior") => "behav",
        ("5", _, "ΔH (J)") | ("8", _, "Energy Drift (J)") => "dH",
        ("5", _, "ΔH%") => "pct",
        ("5", _, "H(0) (J)") => "H0",
        ("5", _, "H(1000) (J)") => "Hend",
        ("8", _, "Time (ms)") => "ms",
        ("8", _, "RMS Error (rad)") => "rms",
        (_, _, step) => step,
    };
    format!("T{table}.{row}{column}")
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
    let transcription = transcription();
    let tables = || transcription.iter().filter(|printed| printed.place.starts_with("Table "));
    assert_eq!(tables().count(), 92);
    for printed in tables() {
        let id = cell_id(printed);
        let claim = LEDGER.get(&id).unwrap_or_else(|| panic!("{id} is not in the ledger"));
        assert_eq!(claim.stated, Some(as_stated(printed.text).as_str()), "{id}: {printed:?}");
    }
    let read: BTreeSet<String> = tables().map(cell_id).collect();
    for claim in LEDGER.claims().iter().filter(|claim| claim.kind() == ClaimKind::Cell) {
        assert!(read.contains(&claim.id), "{} is not printed in the paper", claim.id);
    }
}

/// The claims that say what a sentence says.
const SENTENCES: &[(&str, &str, &[&str])] = &[
    ("Abstract", "across five timestep sizes", &["A.dts"]),
    ("Abstract", "long-time stability tests spanning 10^3 seconds", &["A.tspan"]),
    ("Abstract", "Verlet achieves 0.02% energy drift over 1000 s", &["A.verlet_pct"]),
    ("Abstract", "convergence of RK4", &["A.rk4_order"]),
    ("Abstract", "elliptic integral period formula", &["A.period"]),
    ("Abstract", "energy scaling of Verlet integration", &["A.dt2"]),
    ("Section 1", "convergence orders confirmed", &["P1.orders"]),
    ("Section 1", "totaling fewer than", &["P1.lines200"]),
    ("Section 1", "energy conservation improvement with symplectic methods", &["P1.three_orders"]),
    ("Section 4.4", "RK4 local truncation error", &["P4.rk4_lte"]),
    ("Section 4.4", "RK4 function evaluations per step", &["P4.rk4_evals"]),
    ("Section 4.5", "Störmer–Verlet force evaluations per step", &["P4.vv_evals"]),
    ("Section 6.1", "forward Euler drift exceeding at Δt = 0.1 s", &["P6.1.fe200"]),
    ("Section 6.1", "forward Euler scaling", &["P6.1.fe_order"]),
    ("Figure 2", "reference slope of RK4", &["P6.1.slope"]),
    ("Section 6.1", "Störmer–Verlet drift ratio", &["P6.1.ratio"]),
    ("Figure 3", "symplectic Euler drift", &["P6.2.se_pct"]),
    ("Section 6.2", "forward Euler final energy", &["P6.2.final"]),
    (
        "Section 6.2",
        "orders of magnitude between forward Euler and Störmer–Verlet",
        &["P6.2.five_orders"],
    ),
    ("Section 6.3", "floor of RK4 and Verlet", &["P6.3.floor"]),
    ("Section 6.3", "RK4 normalized error at θ₀ = 10^{-4} rad", &["P6.3.norm"]),
    ("Section 6.3", "well below", &["P6.3.below"]),
    ("Section 6.5", "numerical period", &["P6.5.T"]),
    ("Section 6.5", "ratio T/T₀", &["P6.5.ratio"]),
    ("Section 6.6", "RK4 wall-clock time per step", &["P6.6.34"]),
    ("Section 6.6", "RK4 overhead over forward Euler", &["P6.6.33"]),
    ("Section 6.6", "improvement in RMS error", &["P6.6.120"]),
    ("Section 7.1", "forward Euler energy drift over 1000 s", &["P7.1.fe1000"]),
    ("Section 7.1", "timesteps of molecular dynamics", &["P7.1.md"]),
    ("Section 7.4", "Symplectic Euler function evaluation per step", &["P7.4.se"]),
    // Section 7.2 says that the orders match, and Section 8 which they are.
    ("Section 8", "convergence orders match theory", &["P8.order", "P7.2.precise"]),
    ("Section 8", "fewer than", &["P8.lines300"]),
];

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
    let transcription = transcription();
    let sentences = transcription.iter().filter(|printed| !printed.place.starts_with("Table "));
    let mut read = BTreeSet::new();
    for printed in sentences {
        let known =
            SENTENCES.iter().find(|(place, row, _)| (*place, *row) == (printed.place, printed.row));
        let (_, _, ids) = known.unwrap_or_else(|| panic!("no claim for {printed:?}"));
        for id in *ids {
            let claim = LEDGER.get(id).unwrap_or_else(|| panic!("{id} is not in the ledger"));
            let stated = numbers(claim.stated.unwrap(), "");
            assert!(!stated.is_empty(), "{id} states no number");
            assert_eq!(stated, numbers(printed.text, printed.column), "{id}: {printed:?}");
            read.insert(*id);
        }
    }
    assert_eq!(read.len(), SENTENCES.iter().map(|(_, _, ids)| ids.len()).sum::<usize>());
    for claim in LEDGER.claims().iter().filter(|claim| has_a_number(claim)) {
        assert!(read.contains(claim.id.as_str()), "{} is in no sentence of paper.csv", claim.id);
    }
}
