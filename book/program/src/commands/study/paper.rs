//! `pendula paper`: its tables, stated and measured, and the whole ledger of what it claims, and
//! whether the measurements still support it.

use std::collections::BTreeSet;
use std::io::{self, Write};

use clap::builder::PossibleValue;
use clap::{Args, ValueEnum};
use pendula_study::claims::{Claim, Ledger, Measured, Verdict};
use pendula_study::experiments::Study;
use pendula_study::report::tables::{TABLES, table};
use serde_json::{Value, json};

use crate::colour;
use crate::commands::output::{TableFormat, csv};
use crate::output::failure::Failure;

/// Arguments of `pendula paper tables`.
#[derive(Args, Debug)]
pub struct TablesArguments {
    /// Print only this table
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
pub fn tables(arguments: &TablesArguments, out: &mut dyn Write) -> Result<(), Failure> {
    let numbers = match arguments.table {
        None => TABLES.to_vec(),
        Some(number) if TABLES.contains(&number) => vec![number],
        Some(number) => {
            let known = TABLES.map(|n| n.to_string()).join(", ");
            return Err(Failure::refused(format!(
                "there is no table {number} with numbers in the paper. The tables are {known}"
            )));
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
                let text = table(&ledger, number).map(|table| table.typeset().to_text());
                let text = text.unwrap_or_default();
                let title = colour::output(colour::HEAD, format!("Table {number}"));
                let definition = ledger.table(number).next().map_or("", |claim| claim.definition);
                let (head, rows) = text.split_once('\n').unwrap_or((&text, ""));
                let head = colour::output(colour::HEAD, head);
                write!(out, "{gap}{title}\n{definition}\n\n{head}\n{rows}")?;
            }
        }
        TableFormat::Json => writeln!(out, "{:#}", json!(cells()))?,
        TableFormat::Csv => {
            out.write_all(csv("id,stated,measured,verdict,definition", &cells()).as_bytes())?;
        }
    }
    Ok(())
}

/// A cell: numbers as numbers, with all their digits.
fn cell(claim: &Claim) -> Value {
    json!({
        "id": claim.id,
        "stated": stated(claim),
        "measured": measured(claim),
        "verdict": claim.judged().to_string(),
        "definition": claim.definition,
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

/// Arguments of `pendula paper claims`.
#[derive(Args, Debug)]
pub struct ClaimsArguments {
    /// How the claims are printed
    #[arg(long, value_enum, default_value_t)]
    format: TableFormat,
    #[command(flatten)]
    filter: Filter,
}

/// Which claims are printed: those that satisfy all that is asked.
#[derive(Args, Debug, Default)]
pub struct Filter {
    /// Only the claims with these ids, such as T4.rk4.0.01
    #[arg(value_name = "ID")]
    ids: Vec<String>,
    /// Only those with one of these verdicts
    #[arg(long, value_name = "V", value_enum, value_delimiter = ',')]
    verdict: Vec<VerdictWord>,
    /// Only those of this section of the paper, subsections included: 7, 7.1, abstract
    #[arg(long, value_name = "N")]
    section: Option<String>,
    /// Only those of this table of the paper
    #[arg(long, value_name = "N")]
    table: Option<String>,
}

/// A verdict on a claim of the paper, asked for in a word. The help says of each what the study
/// says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct VerdictWord(Verdict, &'static str);

impl ValueEnum for VerdictWord {
    fn value_variants<'a>() -> &'a [Self] {
        &[
            Self(Verdict::Reproduced, "reproduced"),
            Self(Verdict::ReproducedWithDefinition, "definition"),
            Self(Verdict::DependsOnPlatform, "platform"),
            Self(Verdict::NotSupported, "unsupported"),
            Self(Verdict::Wrong, "wrong"),
            Self(Verdict::NotCheckable, "uncheckable"),
        ]
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        // As the help of every other value, it begins with a capital.
        let (first, rest) = self.0.meaning().split_at(1);
        Some(PossibleValue::new(self.1).help(first.to_uppercase() + rest))
    }
}

impl Filter {
    fn is_empty(&self) -> bool {
        let Self { ids, verdict, section, table } = self;
        ids.is_empty() && verdict.is_empty() && section.is_none() && table.is_none()
    }

    /// Refuses ids, sections and tables that no claim has, with those that are nearest.
    fn check(&self, claims: &[&Claim]) -> Result<(), Failure> {
        for id in &self.ids {
            if !claims.iter().any(|claim| claim.id == *id) {
                let near = nearest(id, claims.iter().map(|claim| claim.id.as_str())).join(", ");
                return Err(Failure::refused(format!(
                    "there is no claim {id}. The nearest names are {near}"
                )));
            }
        }
        for (kind, option, asked) in
            [(SECTION, "section", &self.section), (TABLE, "table", &self.table)]
        {
            let Some(asked) = asked else { continue };
            if !claims.iter().any(|claim| stands_in(claim.place, kind, asked)) {
                let known: BTreeSet<String> = claims
                    .iter()
                    .flat_map(|claim| places(claim.place))
                    .filter_map(|(of, number)| (of == kind).then_some(number))
                    .collect();
                let known = known.into_iter().collect::<Vec<_>>().join(", ");
                return Err(Failure::refused(format!(
                    "there is no claim of {option} {asked}. There are claims of {known}"
                )));
            }
        }
        Ok(())
    }

    fn accepts(&self, claim: &Claim) -> bool {
        let stands_in = |kind, number: &Option<String>| {
            number.as_ref().is_none_or(|number| stands_in(claim.place, kind, number))
        };
        let judged = claim.judged();
        (self.ids.is_empty() || self.ids.contains(&claim.id))
            && (self.verdict.is_empty() || self.verdict.iter().any(|word| word.0 == judged))
            && stands_in(SECTION, &self.section)
            && stands_in(TABLE, &self.table)
    }
}

const SECTION: &str = "Section";
const TABLE: &str = "Table";

/// Whether `place` names the section or table with this `number`, or a part of it.
fn stands_in(place: &str, kind: &str, number: &str) -> bool {
    let number = number.to_lowercase();
    places(place).into_iter().any(|(of, place)| {
        let rest = place.strip_prefix(number.as_str());
        of == kind && rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
    })
}

/// The places that a claim's place names: "Abstract, Sections 1 and 8" are three.
fn places(place: &str) -> Vec<(&'static str, String)> {
    let mut kind = "";
    let mut places = Vec::new();
    for word in place.split([',', ' ']).filter(|word| !word.is_empty() && *word != "and") {
        match word {
            "Abstract" => places.push((SECTION, word.to_lowercase())),
            "Section" | "Sections" => kind = SECTION,
            "Table" | "Tables" => kind = TABLE,
            number if number.starts_with(|c: char| c.is_ascii_digit()) => {
                places.push((kind, number.to_owned()));
            }
            // A figure or an equation.
            _ => kind = "",
        }
    }
    places
}

/// The five ids that differ least from `id`, those that begin as it does first.
fn nearest<'a>(id: &str, ids: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let asked = id.to_lowercase();
    let mut ids: Vec<_> = ids
        .map(|id| {
            let known = id.to_lowercase();
            (!known.starts_with(&asked), strsim::levenshtein(&asked, &known), id)
        })
        .collect();
    ids.sort();
    ids.into_iter().map(|(.., id)| id).take(5).collect()
}

/// Runs the study and writes the ledger.
///
/// # Errors
/// [`Failure::Refused`] for an id, section or table that no claim has; [`Failure::No`] if one of
/// the claims asked for has a verdict on record that is not the one that the measurement supports.
pub fn claims(arguments: &ClaimsArguments, out: &mut dyn Write) -> Result<(), Failure> {
    report(&Ledger::new(&Study::of_the_paper()), &arguments.filter, arguments.format, out)
}

/// The columns of the ledger as CSV: all that [`object`] has.
const COLUMNS: &str = "id,kind,place,gist,stated,measured,definition,verdict,recorded,because";

/// Writes the claims of `ledger` that `filter` asks for.
pub fn report(
    ledger: &Ledger,
    filter: &Filter,
    format: TableFormat,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    // Those of the paper, and the questions that it leaves open; the ledger also contains what the
    // paper leaves out.
    let stated: Vec<&Claim> =
        ledger.claims().iter().filter(|claim| claim.verdict != Verdict::NotStated).collect();
    filter.check(&stated)?;
    let claims: Vec<&Claim> = stated.into_iter().filter(|claim| filter.accepts(claim)).collect();
    let objects = || claims.iter().map(|claim| object(claim)).collect::<Vec<Value>>();
    match format {
        TableFormat::Text => write_text(&claims, out)?,
        TableFormat::Json => writeln!(out, "{:#}", json!(objects()))?,
        TableFormat::Csv => out.write_all(csv(COLUMNS, &objects()).as_bytes())?,
    }
    out.flush()?;
    let upheld = |claim: &Claim| claim.judged() == claim.verdict;
    // What the book quotes beside the paper's numbers counts as well, unless some are asked for.
    let all_upheld = match filter.is_empty() {
        true => ledger.claims().iter().all(upheld),
        false => claims.into_iter().all(upheld),
    };
    if all_upheld { Ok(()) } else { Err(Failure::No) }
}

/// Two or three lines a claim: what is claimed, what came of it, and what exactly was measured,
/// where the paper leaves that open. At the end the number of the paper's claims with each verdict.
fn write_text(shown: &[&Claim], out: &mut dyn Write) -> io::Result<()> {
    let mut counts: Vec<(Verdict, u32)> = Vec::new();
    let (mut claims, mut readings) = (0, 0);
    for claim in shown {
        let (stated, measured) = (claim.stated_text(), claim.measured_text());
        let because = if claim.because.is_empty() { "" } else { ". " };
        let id = colour::output(colour::HEAD, format!("{:<16}", claim.id));
        writeln!(out, "{id} {} ({})", claim.gist, claim.place)?;
        write!(out, "{:<16} stated {stated}, measured {measured}: ", "")?;
        writeln!(out, "{}{because}{}", coloured(claim.judged()), claim.because)?;
        if !claim.definition.is_empty() {
            writeln!(out, "{:<16} definition: {}", "", claim.definition)?;
        }
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
    let colon = if counts.is_empty() { "" } else { ": " };
    writeln!(out, "\n{claims} claims{colon}{}", counts.join(", "))?;
    writeln!(out, "{readings} questions that the text leaves open and its numbers decide")
}

/// The verdict in its colour.
fn coloured(verdict: Verdict) -> String {
    let style = match verdict {
        Verdict::Reproduced => colour::GOOD,
        Verdict::ReproducedWithDefinition | Verdict::DependsOnPlatform | Verdict::NotSupported => {
            colour::DOUBTFUL
        }
        Verdict::Wrong => colour::BAD,
        Verdict::NotCheckable | Verdict::NotStated => colour::FAINT,
    };
    colour::output(style, verdict)
}

fn object(claim: &Claim) -> Value {
    let mut object = cell(claim);
    object["kind"] = json!(claim.kind().to_string());
    object["gist"] = json!(claim.gist);
    object["recorded"] = json!(claim.verdict.to_string());
    object["place"] = json!(claim.place);
    object["because"] = json!(claim.because);
    object
}
