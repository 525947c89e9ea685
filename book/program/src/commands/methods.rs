//! `pendula methods`: the methods, and what is known of each.

use std::io::{self, Write};

use clap::Args;
use pendula::{AnyMethod, METHODS, MethodInfo};
use serde_json::{Value, json};

use super::output::{TableFormat, csv};
use crate::colour;
use crate::output::failure::Failure;

/// Arguments of `pendula methods`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// How the methods are printed
    #[arg(long, value_enum, default_value_t)]
    format: TableFormat,
}

/// Writes a line for each method. Evaluations are those of the force a step; for an implicit
/// method, those of one sweep of its iteration.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let objects = || METHODS.iter().map(|method| object(*method)).collect::<Vec<Value>>();
    match arguments.format {
        TableFormat::Text => write_text(out)?,
        TableFormat::Json => writeln!(out, "{:#}", json!(objects()))?,
        TableFormat::Csv => out.write_all(csv(COLUMNS, &objects()).as_bytes())?,
    }
    Ok(())
}

/// Of the CSV.
const COLUMNS: &str = "name,title,order,symplectic,energy,reversible,implicit,evaluations,chapter";

fn write_text(out: &mut dyn Write) -> io::Result<()> {
    let headings = ["name", "title", "order", "keeps", "evaluations", "chapter"];
    let rows: Vec<[String; 6]> = METHODS.iter().map(|method| row(*method)).collect();
    let width = |column: usize| {
        let cells = rows.iter().map(|row| row[column].as_str()).chain([headings[column]]);
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..headings.len()).map(width).collect();
    let line = |cells: [&str; 6]| {
        let padded = cells.iter().zip(&widths).enumerate().map(|(column, (cell, width))| {
            let is_number = headings[column] == "order";
            if is_number { format!("{cell:>width$}") } else { format!("{cell:<width$}") }
        });
        padded.collect::<Vec<_>>().join("  ").trim_end().to_owned()
    };
    writeln!(out, "{}", colour::output(colour::HEAD, line(headings)))?;
    for row in &rows {
        writeln!(out, "{}", line(row.each_ref().map(String::as_str)))?;
    }
    writeln!(out, "\nevaluations of the force a step; of an implicit method, a sweep")
}

fn row(method: &'static dyn AnyMethod) -> [String; 6] {
    let info = method.info();
    let sweep = if info.implicit { " a sweep" } else { "" };
    let kept = kept(&info);
    [
        info.name.to_owned(),
        info.title.to_owned(),
        info.order.to_string(),
        if kept.is_empty() { "–".to_owned() } else { kept.join(", ") },
        format!("{}{sweep}", info.force_evaluations),
        chapter(method).title.to_owned(),
    ]
}

/// What a step keeps, in words.
fn kept(info: &MethodInfo) -> Vec<&'static str> {
    let all = [
        (info.symplectic, "symplectic"),
        (info.conserves_energy, "energy"),
        (info.symmetric, "reversible"),
    ];
    all.into_iter().filter_map(|(kept, word)| kept.then_some(word)).collect()
}

fn object(method: &'static dyn AnyMethod) -> Value {
    let info = method.info();
    let Chapter { title, file } = chapter(method);
    json!({
        "name": info.name,
        "title": info.title,
        "aliases": info.aliases,
        "order": info.order,
        "symplectic": info.symplectic,
        "energy": info.conserves_energy,
        "reversible": info.symmetric,
        "implicit": info.implicit,
        "evaluations": info.force_evaluations,
        "start_evaluations": info.start_evaluations,
        "chapter": title,
        "page": file.replace(".md", ".html"),
        "reference": info.reference,
    })
}

/// A chapter of the book.
struct Chapter {
    title: &'static str,
    file: &'static str,
}

/// The chapter that has the method: the paper's methods have one each, of the same name; the
/// appendix of the methods has all others.
fn chapter(method: &'static dyn AnyMethod) -> Chapter {
    let named = |name: &str| {
        let mut chapters = CONTENTS.lines().filter_map(|line| {
            let entry = line.trim_start_matches(['-', ' ']).strip_prefix('[')?.strip_suffix(')')?;
            let (title, file) = entry.split_once("](")?;
            Some(Chapter { title, file })
        });
        chapters.find(|chapter| chapter.file.strip_suffix(".md") == Some(name))
    };
    let own = named(method.info().name);
    own.or_else(|| named("methods")).expect("a chapter in the table of contents")
}

/// The book's table of contents.
const CONTENTS: &str = include_str!("../../../src/SUMMARY.md");
