//! `pendula claims`: the whole ledger, and whether the measurements still support it.

use std::io::{self, Write};

use anyhow::Context;
use clap::{Args, ValueEnum};
use pendula_study::claims::{Claim, Ledger, Verdict};
use pendula_study::experiments::Study;
use serde_json::{Value, json};

use super::tables::cell;
use crate::failure::Failure;

/// Arguments of `pendula claims`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// How the claims are printed
    #[arg(long, value_enum, default_value_t)]
    format: LedgerFormat,
}

/// How the claims are printed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum LedgerFormat {
    /// A table to read
    #[default]
    Text,
    /// An array with an object for each claim
    Json,
}

/// Runs the study and writes the ledger.
///
/// # Errors
/// [`Failure::No`] if a verdict on record is not the one that the measurement supports.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    report(&Ledger::new(&Study::run(|_| {})), arguments.format, out)
}

/// Writes a ledger.
///
/// # Errors
/// [`Failure::No`] if a verdict on record is not the one that the measurement supports.
pub fn report(ledger: &Ledger, format: LedgerFormat, out: &mut dyn Write) -> Result<(), Failure> {
    match format {
        LedgerFormat::Text => write_text(ledger, out)?,
        LedgerFormat::Json => {
            let claims: Vec<Value> = stated(ledger).map(object).collect();
            serde_json::to_writer_pretty(&mut *out, &claims)
                .context("the claims cannot be written")?;
            writeln!(out)?;
        }
    }
    out.flush()?;
    let upheld = ledger.claims().iter().all(|claim| claim.judged() == claim.verdict);
    if upheld { Ok(()) } else { Err(Failure::No) }
}

/// The claims of the paper, and the questions that it leaves open; the ledger also contains what
/// the paper leaves out.
fn stated(ledger: &Ledger) -> impl Iterator<Item = &Claim> {
    ledger.claims().iter().filter(|claim| claim.verdict != Verdict::NotStated)
}

/// Two lines a claim, and at the end the number of the paper's claims with each verdict.
fn write_text(ledger: &Ledger, out: &mut dyn Write) -> io::Result<()> {
    let mut counts: Vec<(Verdict, u32)> = Vec::new();
    let (mut claims, mut readings) = (0, 0);
    for claim in stated(ledger) {
        let (stated, measured) = (claim.stated_text(), claim.measured_text());
        let because = if claim.because.is_empty() { "" } else { ". " };
        writeln!(out, "{:<16} {} ({})", claim.id, claim.gist, claim.place)?;
        write!(out, "{:<16} stated {stated}, measured {measured}: ", "")?;
        writeln!(out, "{}{because}{}", claim.judged(), claim.because)?;
        if !claim.is_of_the_paper() {
            readings += 1;
            continue;
        }
        claims += 1;
        match counts.iter_mut().find(|(verdict, _)| *verdict == claim.judged()) {
            Some((_, count)) => *count += 1,
            None => counts.push((claim.judged(), 1)),
        }
    }
    let counts: Vec<String> =
        counts.iter().map(|(verdict, count)| format!("{count} {verdict}")).collect();
    writeln!(out, "\n{claims} claims: {}", counts.join(", "))?;
    writeln!(out, "{readings} questions that the text leaves open and its numbers decide")
}

fn object(claim: &Claim) -> Value {
    let mut object = cell(claim);
    object["kind"] = json!(claim.kind().to_string());
    object["gist"] = json!(claim.gist);
    object["recorded"] = json!(claim.verdict.to_string());
    object["place"] = json!(claim.place);
    object["definition"] = json!(claim.definition);
    object["because"] = json!(claim.because);
    object
}
