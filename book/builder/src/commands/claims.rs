//! `pendula claims`: the whole ledger, and whether what is measured still supports it.

use std::io::Write;

use anyhow::Context;
use clap::{Args, ValueEnum};
use pendula::paper::{Claim, Ledger, Verdict};
use pendula::report::tables;
use pendula::study::Study;
use serde_json::{Value, json};

use super::tables::cell;
use crate::failure::Failure;

/// Arguments of `pendula claims`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// How the claims are printed
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// How the claims are printed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Format {
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
    let ledger = Ledger::of(&Study::run(|_| {}));
    match arguments.format {
        Format::Text => {
            let [cells, sentences] = [tables::cells(&ledger), tables::sentences(&ledger)];
            write!(out, "{}\n{}", cells.to_text(), sentences.to_text())?;
        }
        Format::Json => {
            let stated = |claim: &&Claim| claim.verdict != Verdict::NotStated;
            let claims: Vec<Value> = ledger.claims().iter().filter(stated).map(object).collect();
            serde_json::to_writer_pretty(&mut *out, &claims)
                .context("the claims cannot be written")?;
            writeln!(out)?;
        }
    }
    out.flush()?;
    let upheld = ledger.claims().iter().all(|claim| claim.judged() == claim.verdict);
    if upheld { Ok(()) } else { Err(Failure::No) }
}

fn object(claim: &Claim) -> Value {
    let mut object = cell(claim);
    object["gist"] = json!(claim.gist);
    object["recorded"] = json!(claim.verdict.to_string());
    object["place"] = json!(claim.place);
    object["definition"] = json!(claim.definition);
    object["because"] = json!(claim.because);
    object
}
