//! `pendula paper tables`: the paper's tables, stated and measured.

use std::io::Write;

use clap::Args;
use pendula_study::claims::{Claim, Ledger, Measured};
use pendula_study::experiments::Study;
use pendula_study::report::tables::{TABLES, table};
use serde_json::{Value, json};

use crate::colour;
use crate::commands::rows::{TableFormat, csv};
use pendula_output::failure::Failure;

/// Arguments of `pendula paper tables`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// Only this table
    #[arg(long, value_name = "N", value_parser = table_number)]
    table: Option<u32>,
    /// How the cells are printed
    #[arg(long, value_enum, default_value_t)]
    format: TableFormat,
}

/// The number of a table; which ones there are is checked later.
fn table_number(text: &str) -> Result<u32, &'static str> {
    text.parse().or(Err("it must be the number of a table"))
}

/// Runs the study and writes its tables.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let numbers = match arguments.table {
        None => TABLES.to_vec(),
        Some(number) if TABLES.contains(&number) => vec![number],
        Some(number) => {
            let known = TABLES.map(|n| n.to_string()).join(", ");
            return Err(Failure::refused(format!("--table {number}: the tables are {known}")));
        }
    };
    let ledger = Ledger::of_the_tables(&Study::of_the_paper());
    let cells = || -> Vec<Value> {
        numbers.iter().flat_map(|&number| ledger.table(number)).map(cell).collect()
    };
    match arguments.format {
        TableFormat::Text => {
            for (index, &number) in numbers.iter().enumerate() {
                let gap = if index == 0 { "" } else { "\n" };
                let text = table(&ledger, number).map(|table| table.to_text()).unwrap_or_default();
                let title = colour::output(colour::HEAD, format!("Table {number}"));
                let (head, rows) = text.split_once('\n').unwrap_or((&text, ""));
                let head = colour::output(colour::HEAD, head);
                write!(out, "{gap}{title}\n{head}\n{rows}")?;
            }
        }
        TableFormat::Json => writeln!(out, "{:#}", json!(cells()))?,
        TableFormat::Csv => {
            out.write_all(csv("id,stated,measured,verdict", &cells()).as_bytes())?;
        }
    }
    Ok(())
}

/// A cell: numbers as numbers, with all their digits.
pub fn cell(claim: &Claim) -> Value {
    json!({
        "id": claim.id,
        "stated": stated(claim),
        "measured": measured(claim),
        "verdict": claim.judged().to_string(),
    })
}

fn stated(claim: &Claim) -> Value {
    match claim.stated {
        Some(text) => text.parse::<f64>().map_or_else(|_| text.into(), Value::from),
        None => Value::Null,
    }
}

fn measured(claim: &Claim) -> Value {
    match &claim.measured {
        Measured::Number(value, _) => (*value).into(),
        Measured::Text(text) => text.as_str().into(),
        Measured::Nothing => Value::Null,
    }
}
