//! The table of all solvers.

use super::text::number;
use super::{JUDGED, Library};
use crate::report::table::Table;

/// A table with a row for each solver.
pub fn table() -> Table {
    let mut table = Table::new([
        "library",
        "solver",
        "verdict",
        "error",
        "order",
        "estimate",
        "outputs",
        "crossings",
        "× 5(4)",
        "× 853",
        "language",
        "of what",
    ])
    .with_remarks(1);
    for it in JUDGED.iter() {
        let Library { name, id, language, version, .. } = it.library;
        table.push([
            format!("[{name}](solver-reports.md#{id}) {version}"),
            format!("[`{}`](solver-reports.md#{})", it.entry.name, it.anchor()),
            it.outcome().name().to_string(),
            number(it.over_tolerance()),
            it.beside_claim("order"),
            it.beside_claim("estimate"),
            it.value("output", 0),
            it.crossings().to_string(),
            it.value("effort", 0),
            it.value("effort", 1),
            language.clone(),
            it.why(),
        ]);
    }
    table
}
