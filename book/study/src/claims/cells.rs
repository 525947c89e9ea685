//! What the paper prints in its tables, cell by cell, and the verdict on each.

use super::Verdict::{
    self, DependsOnPlatform, DependsOnRounding, Reproduced, ReproducedWithDefinition, Wrong,
};

/// A printed cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cell {
    /// Table, row and column: the rows are `fe` forward Euler, `se` symplectic Euler, `rk4`, `vv`
    /// Störmer–Verlet.
    pub id: &'static str,
    /// What is printed, digit for digit; units are those of the table.
    pub stated: &'static str,
    /// The verdict on record.
    pub verdict: Verdict,
    /// One sentence on it, where there is something to say.
    pub because: &'static str,
}

const fn cell(
    id: &'static str,
    stated: &'static str,
    verdict: Verdict,
    because: &'static str,
) -> Cell {
    Cell { id, stated, verdict, because }
}

/// The cells of Tables 2 and 4 to 8.
pub const CELLS: &[Cell] = &[
    cell("T2.fe.order", "1", Reproduced, ""),
    cell("T2.fe.sympl", "No", Reproduced, ""),
    cell("T2.fe.evals", "1", Reproduced, ""),
    cell(
        "T2.fe.behav",
        "Monotonic drift",
        Wrong,
        "Nearly half the steps of the 1000 s run lower the energy.",
    ),
    cell("T2.se.order", "1", Reproduced, ""),
    cell("T2.se.sympl", "Yes", Reproduced, ""),
    cell("T2.se.evals", "1", Reproduced, ""),
    cell("T2.se.behav", "Bounded oscillation", Reproduced, ""),
    cell(
        "T2.rk4.order",
        "4",
        ReproducedWithDefinition,
        "The trajectory is of order 4; the energy error that the paper plots falls as Δt⁵.",
    ),
    cell("T2.rk4.sympl", "No", Reproduced, ""),
    cell("T2.rk4.evals", "4", Reproduced, ""),
    cell("T2.rk4.behav", "Slow secular drift", Reproduced, ""),
    cell("T2.vv.order", "2", Reproduced, ""),
    cell("T2.vv.sympl", "Yes", Reproduced, ""),
    cell(
        "T2.vv.evals",
        "2",
        Wrong,
        "The force at the end of a step is the force at the start of the next: one evaluation a \
         step, and one before the first. The paper's own program may well take two.",
    ),
    cell("T2.vv.behav", "Bounded oscillation", Reproduced, ""),
    cell("T4.fe.0.1", "2.01e2", Reproduced, ""),
    cell("T4.fe.0.05", "1.22e2", Reproduced, ""),
    cell("T4.fe.0.01", "2.58e1", Reproduced, ""),
    cell("T4.fe.0.005", "1.45e1", Reproduced, ""),
    cell("T4.fe.0.001", "2.36e0", Reproduced, ""),
    cell("T4.se.0.1", "8.28e-1", Reproduced, ""),
    cell("T4.se.0.05", "3.85e-1", Reproduced, ""),
    cell("T4.se.0.01", "7.30e-2", Reproduced, ""),
    cell("T4.se.0.005", "3.63e-2", Reproduced, ""),
    cell("T4.se.0.001", "7.21e-3", Reproduced, ""),
    cell("T4.rk4.0.1", "2.21e-2", Reproduced, ""),
    cell("T4.rk4.0.05", "7.04e-4", Reproduced, ""),
    cell("T4.rk4.0.01", "2.34e-7", Reproduced, ""),
    cell("T4.rk4.0.005", "7.60e-9", Reproduced, ""),
    cell(
        "T4.rk4.0.001",
        "3.14e-12",
        DependsOnPlatform,
        "Truncation alone gives 3.18e-12; rounding moves the second digit, on every platform \
         differently.",
    ),
    cell("T4.vv.0.1", "1.10e-1", Reproduced, ""),
    cell("T4.vv.0.05", "2.76e-2", Reproduced, ""),
    cell("T4.vv.0.01", "1.10e-3", Reproduced, ""),
    cell("T4.vv.0.005", "2.76e-4", Reproduced, ""),
    cell("T4.vv.0.001", "1.10e-5", Reproduced, ""),
    cell("T5.fe.dH", "481.8", Reproduced, ""),
    cell("T5.fe.pct", "9090", Reproduced, ""),
    cell("T5.fe.H0", "-5.300", Reproduced, ""),
    cell("T5.fe.Hend", "475.7", Reproduced, ""),
    cell(
        "T5.se.dH",
        "0.067",
        DependsOnRounding,
        "0.067468 rounds to 0.067; rounded twice, by way of 0.0675, it would be 0.068.",
    ),
    cell("T5.se.pct", "1.27", Reproduced, ""),
    cell("T5.se.H0", "-5.300", Reproduced, ""),
    cell("T5.se.Hend", "-5.292", Reproduced, ""),
    cell("T5.vv.dH", "0.001", Reproduced, ""),
    cell("T5.vv.pct", "0.019", Reproduced, ""),
    cell("T5.vv.H0", "-5.300", Reproduced, ""),
    cell("T5.vv.Hend", "-5.300", Reproduced, ""),
    cell("T6.fe.0.1", "9.19e-1", ReproducedWithDefinition, OVER_ALL_SAMPLES),
    cell("T6.fe.0.05", "1.48e-1", Reproduced, ""),
    cell("T6.fe.0.01", "1.21e-2", Reproduced, ""),
    cell("T6.fe.0.005", "5.47e-3", Reproduced, ""),
    cell("T6.fe.0.001", "1.02e-3", Reproduced, ""),
    cell("T6.se.0.1", "7.86e-3", ReproducedWithDefinition, OVER_ALL_SAMPLES),
    cell(
        "T6.se.0.05",
        "3.26e-3",
        DependsOnRounding,
        "It lies within 2e-5, relatively, of a rounding boundary, and only with N + 1 samples in \
         the mean.",
    ),
    cell("T6.se.0.01", "4.91e-4", ReproducedWithDefinition, OVER_ALL_SAMPLES),
    cell("T6.se.0.005", "2.01e-4", Reproduced, ""),
    cell("T6.se.0.001", "5.88e-5", Reproduced, ""),
    cell("T6.rk4.0.1", "1.50e-4", ReproducedWithDefinition, OVER_ALL_SAMPLES),
    cell("T6.rk4.0.05", "1.03e-4", Reproduced, ""),
    cell("T6.rk4.0.01", "1.00e-4", Reproduced, ""),
    cell("T6.rk4.0.005", "1.00e-4", Reproduced, ""),
    cell("T6.rk4.0.001", "1.00e-4", Reproduced, ""),
    cell("T6.vv.0.1", "2.53e-3", ReproducedWithDefinition, OVER_ALL_SAMPLES),
    cell("T6.vv.0.05", "5.55e-4", ReproducedWithDefinition, OVER_ALL_SAMPLES),
    cell("T6.vv.0.01", "7.40e-5", Reproduced, ""),
    cell("T6.vv.0.005", "9.37e-5", Reproduced, ""),
    cell("T6.vv.0.001", "1.00e-4", Reproduced, ""),
    cell("T7.Texact", "5.1581", Reproduced, ""),
    cell(
        "T7.Tnum",
        "5.1580",
        ReproducedWithDefinition,
        "Only the highest sample on the grid gives 5.1580; the trajectory's own period agrees with \
         the exact one to 3e-12 s.",
    ),
    cell(
        "T7.relerr",
        "0.001",
        ReproducedWithDefinition,
        "It measures the spacing of the grid, not the method.",
    ),
    cell("T7.T0", "2.0061", Reproduced, ""),
    cell("T7.ratio", "2.57", Reproduced, ""),
    cell("T7.k", "0.9975", Reproduced, ""),
    cell(
        "T7.caption_k",
        "0.997",
        DependsOnRounding,
        "0.997 and 0.9975 are both right roundings of 0.99749499; as an input, 0.997 gives a \
         period of 5.04 s.",
    ),
    cell("T8.fe.ms", "1.80", DependsOnPlatform, ONE_CLOCK),
    cell("T8.fe.rms", "1.21e-2", Reproduced, ""),
    cell("T8.fe.dH", "2.04e-2", Reproduced, ""),
    cell("T8.se.ms", "1.89", DependsOnPlatform, ONE_CLOCK),
    cell("T8.se.rms", "4.91e-4", Reproduced, ""),
    cell("T8.se.dH", "1.95e-4", Reproduced, ""),
    cell("T8.rk4.ms", "5.89", DependsOnPlatform, ONE_CLOCK),
    cell("T8.rk4.rms", "1.00e-4", Reproduced, ""),
    cell("T8.rk4.dH", "1.61e-10", Reproduced, ""),
    cell("T8.vv.ms", "2.87", DependsOnPlatform, ONE_CLOCK),
    cell("T8.vv.rms", "7.40e-5", Reproduced, ""),
    cell("T8.vv.dH", "3.01e-6", Reproduced, ""),
];

const OVER_ALL_SAMPLES: &str =
    "The mean runs over all N + 1 samples, the start included; over N it misses.";
const ONE_CLOCK: &str = "The clock of one machine and one interpreter.";
