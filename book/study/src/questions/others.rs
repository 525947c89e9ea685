//! Questions of "What published solvers do".

use super::{Compute, Truth};
use crate::report::table::Table;

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] = &[("others-order", shown_by_order)];

/// The table of solvers, as a test has judged them.
fn solvers() -> Table {
    let text = include_str!("../../../../snapshots/6_solvers.snap");
    let inner = text.split_once(" -->\n").map_or("", |(_, inner)| inner);
    let inner = inner.split_once("<!-- ANCHOR_END").map_or("", |(inner, _)| inner);
    Table::from_markdown(inner).expect("a table")
}

/// Of the solvers that do less than they say, the part of which the order at the end of a run says
/// so.
fn shown_by_order() -> Truth {
    let table = solvers();
    let column =
        |name: &str| table.header().iter().position(|head| head == name).expect("a column");
    let (verdict, what) = (column("verdict"), column("of what"));
    let short = |row: &&Vec<String>| ["fails", "documented"].contains(&row[verdict].as_str());
    let has_order = |row: &&Vec<String>| {
        let mut words = row[what].split(|c: char| !(c.is_ascii_alphabetic() || c == '-'));
        words.any(|word| word == "order")
    };
    let all = table.rows().iter().filter(short).count() as f64;
    let part = table.rows().iter().filter(short).filter(has_order).count() as f64 / all;
    Truth::Which(vec![
        ("few", part < 0.25),
        ("half", (0.4..0.6).contains(&part)),
        ("most", part > 0.75),
    ])
}
