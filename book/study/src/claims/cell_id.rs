//! The ids of the cells of the paper's tables.

use core::fmt;

use crate::experiments::PaperMethod;

/// A cell of a table of the paper. It prints as the id that the ledger, the book and the command
/// line use: `T4.rk4.0.01`, `T5.fe.dH`, `T7.Texact`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellId {
    /// The number of the table.
    pub table: u32,
    /// The method of its row; `None` in a table without a row for each method.
    pub row: Option<PaperMethod>,
    /// Its column.
    pub column: Column,
}

/// A column of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Column {
    /// That of a step Δt (s).
    Step(f64),
    /// That of a quantity.
    Quantity(&'static str),
}

impl CellId {
    /// The cell of `row` at the step `dt` (s).
    pub const fn at_step(table: u32, row: PaperMethod, dt: f64) -> Self {
        Self { table, row: Some(row), column: Column::Step(dt) }
    }

    /// The cell of `row` in the column of a quantity.
    pub const fn of_row(table: u32, row: PaperMethod, quantity: &'static str) -> Self {
        Self { table, row: Some(row), column: Column::Quantity(quantity) }
    }

    /// The cell of a quantity in a table without a row for each method.
    pub const fn of_table(table: u32, quantity: &'static str) -> Self {
        Self { table, row: None, column: Column::Quantity(quantity) }
    }
}

impl fmt::Display for CellId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "T{}.", self.table)?;
        if let Some(row) = self.row {
            write!(f, "{}.", row.id())?;
        }
        match self.column {
            Column::Step(dt) => write!(f, "{dt}"),
            Column::Quantity(quantity) => f.write_str(quantity),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: an id that the command line and the chapters do not know.
    #[test]
    fn ids_are_those_of_the_contract() {
        let printed = [
            CellId::at_step(4, PaperMethod::Rk4, 0.01),
            CellId::of_row(5, PaperMethod::ForwardEuler, "dH"),
            CellId::at_step(6, PaperMethod::SymplecticEuler, 0.1),
            CellId::of_row(8, PaperMethod::StormerVerlet, "rms"),
            CellId::of_table(7, "Texact"),
        ]
        .map(|id| id.to_string());
        assert_eq!(printed, ["T4.rk4.0.01", "T5.fe.dH", "T6.se.0.1", "T8.vv.rms", "T7.Texact"]);
    }
}
