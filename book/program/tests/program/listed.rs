//! The commands that list what there is: the methods, and the claims that are asked for.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::ExitCode;
use std::sync::LazyLock;

use clap::FromArgMatches;
use pendula::METHODS;
use pendula_program::cli;
use pendula_program::commands::output::TableFormat;
use pendula_program::commands::study::paper::{Filter, report};
use pendula_program::output::failure::Failure;
use pendula_study::claims::{Claim, Ledger, Verdict};
use pendula_study::experiments::Study;
use rstest::rstest;
use serde_json::Value;

use crate::{json, printed};

static STUDY: LazyLock<Study> = LazyLock::new(Study::of_the_paper);
pub static LEDGER: LazyLock<Ledger> = LazyLock::new(|| Ledger::new(&STUDY));

/// The source of a page, and of the snapshots that it includes.
fn chapter_source(page: &str) -> String {
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let page = fs::read_to_string(top.join("book/src").join(page.replace(".html", ".md"))).unwrap();
    let included = page.split("{{#include ../../").skip(1).map(|rest| {
        let path = rest.split([':', '}']).next().unwrap();
        fs::read_to_string(top.join(path)).unwrap()
    });
    let included: String = included.collect();
    page + &included
}

/// Catches: a method left out of a format, or with the facts of another; a table whose columns are
/// not those of its head; a chapter that does not have the method.
#[test]
fn every_method_is_listed_with_its_facts() {
    let objects = json(&["methods", "--format", "json"]);
    let objects = objects.as_array().unwrap();
    let csv = printed(&["methods", "--format", "csv"]);
    let text = printed(&["methods"]);
    assert_eq!(objects.len(), METHODS.len());
    assert_eq!(csv.lines().count(), METHODS.len() + 1);
    let lines = csv.lines().skip(1).zip(text.lines().skip(1));
    let place = |word: &str| text.lines().next().unwrap().find(word).unwrap();
    for ((method, object), (line, row)) in METHODS.iter().zip(objects).zip(lines) {
        let info = method.info();
        for (name, fact) in [
            ("name", Value::from(info.name)),
            ("aliases", info.aliases.into()),
            ("order", info.order.into()),
            ("symplectic", info.symplectic.into()),
            ("reversible", info.symmetric.into()),
            ("energy", info.conserves_energy.into()),
            ("evaluations", info.force_evaluations.into()),
            ("start_evaluations", info.start_evaluations.into()),
            ("reference", info.reference.into()),
        ] {
            assert_eq!(object[name], fact, "{name} of {}", info.name);
        }
        assert!(row.starts_with(&format!("{} ", info.name)), "{row}");
        let facts = [info.order.to_string(), info.symplectic.to_string()].join(",");
        assert!(line.starts_with(&format!("{},{},{facts},", info.name, info.title)), "{line}");
        let at = |word| row.chars().skip(place(word)).collect::<String>();
        assert_eq!(at("keeps").contains("symplectic"), info.symplectic, "{row}");
        let evaluations =
            format!("{}{}", info.force_evaluations, if info.implicit { " a sweep" } else { "" });
        assert!(at("evaluations").starts_with(&format!("{evaluations}  ")), "{row}");
        let chapter = object["chapter"].as_str().unwrap();
        assert!(row.ends_with(chapter) && at("chapter") == chapter, "{row}");
        let page = chapter_source(object["page"].as_str().unwrap());
        assert!(page.contains(info.title) && page.contains(chapter), "{} in {chapter}", info.title);
    }
}

/// What is printed to who asks so. The command is read and answered in this process, which has
/// measured the claims.
fn claims(asked: &[&str], format: TableFormat) -> Result<String, Failure> {
    let words = [&["pendula", "paper", "claims"], asked].concat();
    let matches = cli::definition().try_get_matches_from(words).unwrap();
    let matches = matches.subcommand_matches("paper").unwrap();
    let matches = matches.subcommand_matches("claims").unwrap();
    let filter = Filter::from_arg_matches(matches).unwrap();
    let mut out = Vec::new();
    report(&LEDGER, &filter, format, &mut out)?;
    Ok(String::from_utf8(out).unwrap())
}

/// The ids that are printed to who asks so.
fn ids(asked: &[&str]) -> Vec<String> {
    let printed = claims(asked, TableFormat::Json).unwrap();
    let all: Value = serde_json::from_str(&printed).unwrap();
    let ids = all.as_array().unwrap().iter().map(|claim| claim["id"].as_str().unwrap().to_owned());
    ids.collect()
}

/// The ids of the claims that satisfy this.
fn those(satisfy: impl Fn(&Claim) -> bool) -> Vec<String> {
    let stated = LEDGER.claims().iter().filter(|claim| claim.verdict != Verdict::NotStated);
    stated.filter(|claim| satisfy(claim)).map(|claim| claim.id.clone()).collect()
}

/// Catches: a filter that is ignored, or replaces another; a word for another verdict; Section 7
/// without its subsections, or with Section 70; a claim of two sections found in one; a count of
/// claims that are not shown.
#[test]
fn claims_are_printed_that_were_asked_for() {
    let wrong = those(|claim| claim.judged() == Verdict::Wrong);
    assert!(!wrong.is_empty());
    assert_eq!(ids(&["--verdict", "wrong"]), wrong);
    let either = [Verdict::NotSupported, Verdict::ReproducedWithDefinition];
    assert_eq!(
        ids(&["--verdict", "unsupported,definition"]),
        those(|claim| either.contains(&claim.judged()))
    );
    let of_the_seventh =
        those(|claim| claim.place.contains("7.") || claim.place.contains("Section 7"));
    assert_eq!(ids(&["--section", "7"]), of_the_seventh);
    assert_eq!(ids(&["--section", "6.3"]), those(|claim| claim.place.contains("6.3")));
    assert_eq!(ids(&["--section", "Abstract"]), those(|claim| claim.place.contains("Abstract")));
    assert_eq!(
        ids(&["--table", "8"]),
        those(|claim| claim.place.starts_with("Table") && claim.place.contains('8'))
    );
    assert_eq!(ids(&["P7.3.all", "T4.rk4.0.01"]), ["T4.rk4.0.01", "P7.3.all"]);

    let both: BTreeSet<String> =
        wrong.into_iter().filter(|id| of_the_seventh.contains(id)).collect();
    let combined = ["--section", "7", "--verdict", "wrong"];
    let text = claims(&combined, TableFormat::Text).unwrap();
    let shown: BTreeSet<String> = text
        .lines()
        .filter(|line| line.starts_with(|c: char| c.is_ascii_uppercase()))
        .map(|line| line.split_whitespace().next().unwrap().to_owned())
        .collect();
    assert_eq!(shown, both);
    assert!(
        !both.is_empty() && text.contains(&format!("\n{} claims: {0} wrong\n", both.len())),
        "{text}"
    );
}

/// Catches: a claim that is not there passed over in silence; a list of all claims for an answer; a
/// word that the help does not name, or explains as another verdict; a verdict that no claim has.
#[test]
fn what_no_claim_has_is_refused_with_what_is_near() {
    for (asked, because) in [
        (&["T4.rk.0.01"][..], "nearest names are T4.rk4.0.01"),
        (&["t4.vv"], "nearest names are T4.vv."),
        (&["--section", "9"], "There are claims of 1, 2, 3.1"),
        (&["--table", "3.1"], "no claim of table 3.1"),
    ] {
        let line = claims(asked, TableFormat::Text).unwrap_err().line().unwrap();
        assert!(line.contains(because) && line.lines().count() == 1, "{line}");
    }
    let help = printed(&["paper", "claims", "--help"]);
    let help = help.split_whitespace().collect::<Vec<_>>().join(" ");
    let words = ["reproduced", "definition", "platform", "unsupported", "wrong", "uncheckable"];
    for (word, verdict) in words.into_iter().zip(Verdict::ALL) {
        let line = format!("- {word}: {}", verdict.meaning()).to_lowercase();
        assert!(help.to_lowercase().contains(&line), "{line} is not in {help}");
        let of_one = those(|claim| claim.judged() == verdict);
        assert!(!of_one.is_empty(), "no claim is {verdict}");
        assert_eq!(ids(&["--verdict", word]), of_one);
    }
}

/// Catches: a claim "reproduced with a definition" without the definition, in one of the formats or
/// for one of the claims; a definition that splits a line of CSV.
#[rstest]
fn every_claim_is_printed_with_what_was_measured(
    #[values(TableFormat::Text, TableFormat::Json, TableFormat::Csv)] format: TableFormat,
) {
    let printed = claims(&[], format).unwrap();
    let written = |text: &str| match format {
        TableFormat::Text => text.to_string(),
        TableFormat::Json => text.replace('"', "\\\""),
        TableFormat::Csv => text.replace('"', "\"\""),
    };
    let defined: Vec<&Claim> = LEDGER
        .claims()
        .iter()
        .filter(|claim| claim.verdict != Verdict::NotStated && !claim.definition.is_empty())
        .collect();
    assert!(defined.iter().any(|claim| claim.id == "P6.3.norm"));
    let lacking: Vec<&str> = defined
        .into_iter()
        .filter(|claim| !printed.contains(&written(claim.definition)))
        .map(|claim| claim.id.as_str())
        .collect();
    assert_eq!(lacking, [""; 0]);
}

/// One cell of Table 4 is off by a hundredth, and so misses its printed digits. The ledger is
/// written whole all the same, says so, and ends with status 1.
///
/// Catches: a verdict that does not hold but ends with status 0, in one of the formats or in all;
/// one that is contradicted and printed as it is on record.
#[rstest]
fn a_contradicted_claim_ends_with_status_1(
    #[values(TableFormat::Text, TableFormat::Json, TableFormat::Csv)] format: TableFormat,
) {
    static FORGED: LazyLock<Ledger> = LazyLock::new(|| {
        let mut study = STUDY.clone();
        study.convergence[0].drift[0] *= 1.01;
        Ledger::new(&study)
    });
    let report = |ledger: &Ledger| {
        let mut out = Vec::new();
        let outcome = report(ledger, &Filter::default(), format, &mut out);
        (outcome, String::from_utf8(out).unwrap())
    };
    let (outcome, honest) = report(&LEDGER);
    assert!(outcome.is_ok());
    let (outcome, forged) = report(&FORGED);
    let failure = outcome.unwrap_err();
    assert!(matches!(failure, Failure::No), "{failure:?}");
    assert_eq!(format!("{:?}", failure.exit_code()), format!("{:?}", ExitCode::FAILURE));
    let pairs = honest.lines().zip(forged.lines());
    let moved: Vec<_> = pairs.filter(|(before, after)| before != after).collect();
    assert_eq!(honest.lines().count(), forged.lines().count());
    assert!(moved.iter().any(|(_, after)| after.contains("wrong")), "{moved:?}");
}
