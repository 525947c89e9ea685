//! Captions of tables.
//!
//! A paragraph that begins with `Table:` is the caption of the table below it. `Table[RK4]:` shows
//! of that table the rows of RK4 alone; several names are separated by commas.

use anyhow::{Result, ensure};
use regex::Captures;

use super::markdown::splice;
use crate::book::{Pattern, pattern};

/// The text with each captioned table as a figure of its own, caption first; `{{verdicts}}` will be
/// a table too.
pub fn set(text: &str) -> Result<String> {
    static CAPTION: Pattern = Pattern::new(|| {
        pattern(concat!(
            r"(?m)^Table(?:\[(?<rows>[^\]\n]+)\])?: (?<caption>(?:.+\n)+)\n",
            r"(?<table>\{\{verdicts\}\}|(?:\|.*\n?)*)",
        ))
    });
    let edit = |found: Captures<'_>| Ok((found.get_match().range(), figure(&found)?));
    Ok(splice(text, CAPTION.captures_iter(text).map(edit).collect::<Result<Vec<_>>>()?))
}

fn figure(found: &Captures<'_>) -> Result<String> {
    let (caption, table) = (found["caption"].trim_end(), &found["table"]);
    ensure!(!table.is_empty(), "{caption}: this caption has no table below it");
    let table = match found.name("rows") {
        Some(rows) => of(table, rows.as_str())?,
        None => table.to_string(),
    };
    // Between blank lines Markdown goes on within HTML.
    Ok(format!(
        "<figure class=\"table\">\n<figcaption>\n\n{caption}\n\n</figcaption>\n\n{}\n\n</figure>\n",
        aligned(table.trim_end())
    ))
}

/// The table with each column as its cells are read: marks below each other in the middle, numbers
/// flush right, words flush left. A computed table has all but its first column flush right, for
/// the terminal. The first column stays as it is, and so does one of words and numbers.
fn aligned(table: &str) -> String {
    let cells = |line: &str| -> Vec<String> {
        let line = line.trim().trim_start_matches('|').trim_end_matches('|').replace("\\|", "/");
        line.split('|').map(|cell| cell.trim().to_string()).collect()
    };
    let lines: Vec<&str> = table.lines().collect();
    let [head, rule, rows @ ..] = &lines[..] else { return table.into() };
    let rows: Vec<Vec<String>> = rows.iter().map(|row| cells(row)).collect();
    let rule = cells(rule).into_iter().enumerate().map(|(column, rule)| {
        let column_of = rows.iter().filter_map(|row| row.get(column));
        let found: Vec<&str> =
            column_of.map(String::as_str).filter(|cell| !is_blank(cell)).collect();
        let numbers = found.iter().filter(|cell| is_number(cell)).count();
        match column {
            0 => rule,
            _ if found.iter().any(|cell| ["●", "○"].contains(cell)) => ":-:".into(),
            _ if found.is_empty() => rule,
            _ if numbers == found.len() => "--:".into(),
            // Said to be left: short words, which stay on one line.
            _ if numbers == 0 && rule.ends_with(':') => ":--".into(),
            _ => rule,
        }
    });
    let rule = format!("| {} |", rule.collect::<Vec<_>>().join(" | "));
    [&[*head, &rule], &lines[2..]].concat().join("\n")
}

/// Whether nothing is said in the cell.
fn is_blank(cell: &str) -> bool {
    cell.chars().all(|c| "–—…".contains(c))
}

/// Whether the cell is a number as they are printed: `−5.300`, `≠ 1.02 × 10^{−3}`, `15 ± 2`.
fn is_number(cell: &str) -> bool {
    let cell = cell.trim_start_matches("≠ ").trim_matches('*');
    let begins = cell.trim_start_matches(['−', '-', '±']).starts_with(|c: char| c.is_ascii_digit());
    begins && cell.chars().all(|c| c.is_ascii_digit() || "., ±×^{}−-+…⁰¹²³⁴⁵⁶⁷⁸⁹⁻".contains(c))
}

/// The head of a table and the rows with these names in the first column, with the rows below that
/// have none.
fn of(table: &str, names: &str) -> Result<String> {
    let mut lines = table.lines();
    let mut kept: Vec<&str> = lines.by_ref().take(2).collect();
    let names: Vec<&str> = names.split(',').map(str::trim).collect();
    let mut known = Vec::new();
    for line in lines {
        let name = line.split('|').nth(1).unwrap_or_default().trim();
        if !name.is_empty() {
            known.push(name);
        }
        if known.last().is_some_and(|name| names.contains(name)) {
            kept.push(line);
        }
    }
    for name in names {
        ensure!(
            known.contains(&name),
            "Table[{name}]: there is no such row, but {}",
            known.join(", ")
        );
    }
    Ok(kept.join("\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = "| Method | value |\n| --- | --: |\n| A | 1 |\n|   | 2 |\n| B | 3 |\n";

    /// Catches: a caption that is not bound to its table, or swallows the text around it.
    #[test]
    fn a_caption_and_its_table_are_a_figure() {
        let set =
            set(&format!("Before.\n\nTable: Some *values*\n(J).\n\n{TABLE}\nAfter.\n")).unwrap();
        let expected = format!(
            "Before.\n\n<figure class=\"table\">\n<figcaption>\n\nSome *values*\n(J).\n\n\
             </figcaption>\n\n{TABLE}\n</figure>\n\nAfter.\n"
        );
        assert_eq!(set, expected);
        assert_eq!(
            super::set("Tables: no.\n\nA Table: no.\n").unwrap(),
            "Tables: no.\n\nA Table: no.\n"
        );
    }

    /// Catches: words that stand flush right as in the terminal, numbers that do not; marks beside
    /// the middle of their column; a rule that is lost where words and numbers are mixed.
    #[test]
    fn columns_stand_as_they_are_read() {
        let rule = |cells: &[&str]| {
            let rows: Vec<String> = cells.iter().map(|cell| format!("| A | {cell} |\n")).collect();
            let set = set(&format!("Table: T.\n\n| M | v |\n| --- | -: |\n{}", rows.concat()));
            let set = set.unwrap();
            let rule = set.lines().find(|line| line.starts_with("| --- |")).unwrap().to_string();
            rule.split('|').nth(2).unwrap().trim().to_string()
        };
        assert_eq!(rule(&["stated", "measured"]), ":--");
        assert_eq!(rule(&["RK4", "DOP853", "–"]), ":--");
        assert_eq!(rule(&["≠ 1.02 × 10^{−3}", "−5.300", "15 ± 2", "—", "**328**"]), "--:");
        assert_eq!(rule(&["●", "", "38"]), ":-:");
        // As it was: words and numbers, units, nothing.
        for cells in [&["0.03", "escapes"][..], &["1/s", "3"], &["", "…"]] {
            assert_eq!(rule(cells), "-:", "{cells:?}");
        }
        assert_eq!(rule(&["a \\| 1", "b"]), ":--");
    }

    /// Catches: rows of another method, the second row of one lost, a misspelt name that shows an
    /// empty table.
    #[test]
    fn rows_are_chosen_by_name() {
        let rows = |names: &str| set(&format!("Table[{names}]: Some.\n\n{TABLE}"));
        let a = rows("A").unwrap();
        assert!(a.contains("| A | 1 |\n|   | 2 |\n") && !a.contains("| B |"), "{a}");
        assert!(rows("A, B").unwrap().contains("| B | 3 |"));
        assert!(rows("C").unwrap_err().to_string().contains("no such row, but A, B"));
    }

    /// Catches: a caption that is left over when its table was moved.
    #[test]
    fn a_caption_without_a_table_is_refused() {
        assert!(set("Table: Some.\n\nText.\n").unwrap_err().to_string().contains("no table"));
    }
}
