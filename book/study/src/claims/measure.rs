//! How each number of the paper is measured: from the rows of the study to claims.

use pendula::methods::{BlanesMoan6, Dop853, ForwardEuler, Rk4};
use pendula::registry::InSteps;

use super::stated::{FINDINGS, TABLES};
use super::{Claim, Measured, Tolerance, Verdict, cell_id, row, stated};
use crate::digits::Digits::{self, Fixed, Scientific, Significant};
use crate::experiments::{
    MethodRef, PaperMethod, STEPS, Study, findings, long_run, small_angle, work,
};

/// All claims, measured, in the order of the tables.
pub(super) fn claims(study: &Study) -> Vec<Claim> {
    let mut claims = Vec::new();
    table_2(study, &mut claims);
    table_4(study, &mut claims);
    table_5(study, &mut claims);
    table_6(study, &mut claims);
    table_7(study, &mut claims);
    table_8(study, &mut claims);
    found_besides(study, &mut claims);
    claims
}

/// A claim about a number in a cell.
fn number(id: String, gist: String, value: f64, digits: Digits) -> Claim {
    cell(id, gist, Measured::Number(value, digits))
}

/// A claim about a property in words.
fn text(id: String, gist: String, measured: impl ToString) -> Claim {
    cell(id, gist, Measured::Text(measured.to_string()))
}

/// Joins what is measured with what the paper prints in the cell of that id.
fn cell(id: String, gist: String, measured: Measured) -> Claim {
    let table = id.split_once('.').and_then(|(table, _)| TABLES.get(table));
    let printed = stated::cell(&id);
    Claim {
        place: table.map_or("", |table| &table.place),
        gist,
        definition: table.map_or("", |table| &table.definition),
        stated: printed.map(|cell| cell.stated.as_str()),
        measured,
        tolerance: Tolerance::PrintedDigits,
        verdict: printed.map_or(Verdict::NotStated, |cell| cell.verdict),
        because: printed.map_or("", |cell| &cell.because),
        id,
    }
}

/// The rows of the paper's methods, each with its method.
fn of_the_paper<R>(
    rows: &[R],
    method: impl Fn(&R) -> MethodRef,
) -> impl Iterator<Item = (PaperMethod, &R)> {
    rows.iter().filter_map(move |row| Some((PaperMethod::of(method(row))?, row)))
}

fn table_2(study: &Study, claims: &mut Vec<Claim>) {
    for (method, row) in of_the_paper(&study.characteristics, |row| row.method) {
        let (id, title) = (|quantity| cell_id(2, method, quantity), method.title());
        let yes_or_no = if row.symplectic() { "Yes" } else { "No" };
        claims.extend([
            // An order is an integer. The slope itself is in the tests, to ±0.05.
            number(id("order"), format!("order of {title}"), row.order(), Fixed(0)),
            text(id("sympl"), format!("{title} symplectic"), yes_or_no),
            number(
                id("evals"),
                format!("force evaluations of one step of {title}"),
                row.evaluations_alone,
                Fixed(0),
            ),
            text(id("behav"), format!("energy of {title} over 1000 s"), row.energy),
        ]);
    }
}

fn table_4(study: &Study, claims: &mut Vec<Claim>) {
    for (method, row) in of_the_paper(&study.convergence, |row| row.method) {
        let title = method.title();
        for (step, drift) in STEPS.iter().zip(row.drift) {
            let gist = format!("largest energy error of {title} at Δt = {step} s (J)");
            let id = cell_id(4, method, step);
            let mut cell = number(id, gist, drift, Scientific(digits(method, *step)));
            if method == PaperMethod::Rk4 && *step == 0.001 {
                cell.tolerance = Tolerance::Around { value: 3.2e-12, relative: 0.1 };
            }
            claims.push(cell);
        }
    }
}

/// Digits of Table 4 that do not change with the sine of another platform, off by one ulp: seven
/// or more except in RK4's row, where the energy error approaches the rounding of the energy.
fn digits(method: PaperMethod, step: f64) -> usize {
    match (method, step) {
        (PaperMethod::Rk4, 0.005) => 4,
        (PaperMethod::Rk4, 0.001) => 1,
        _ => 6,
    }
}

fn table_5(study: &Study, claims: &mut Vec<Claim>) {
    for (method, row) in of_the_paper(&study.long_run, |row| row.method) {
        let title = method.title();
        let cell = |quantity, what: &str, value, digits| {
            let id = cell_id(5, method, quantity);
            number(id, format!("{what} of {title}"), value, digits)
        };
        let percent = row.percent_of_initial();
        claims.extend([
            cell("dH", "largest energy error (J)", row.drift, Significant(6)),
            cell("pct", "the same in per cent of |H(0)|", percent, Significant(5)),
            cell("H0", "H at the start (J)", row.initial, Fixed(6)),
            cell("Hend", "H after 1000 s (J)", row.last, Fixed(6)),
            cell(
                "well",
                "largest energy error in per cent of the energy above the bottom",
                row.percent_above_bottom(),
                Significant(5),
            ),
        ]);
    }
}

fn table_6(study: &Study, claims: &mut Vec<Claim>) {
    for (method, row) in of_the_paper(&study.small_angle, |row| row.method) {
        let title = method.title();
        for (step, errors) in STEPS.iter().zip(row.errors) {
            let gist =
                format!("RMS angle error of {title} against θ₀ cos ω₀t at Δt = {step} s (rad)");
            let id = cell_id(6, method, step);
            claims.push(number(id, gist, errors.formula, Scientific(6)));
        }
    }
}

fn table_7(study: &Study, claims: &mut Vec<Claim>) {
    let periods = &study.large_angle;
    let cell = |quantity, gist: &str, value, digits| {
        number(format!("T7.{quantity}"), gist.to_string(), value, digits)
    };
    claims.extend([
        cell("Texact", "exact period 4√(L/g) K(k) (s)", periods.exact, Fixed(12)),
        cell("Tnum", "RK4's period, highest sample on the grid (s)", periods.by_peak, Fixed(12)),
        cell("relerr", "its relative error (%)", periods.percent(periods.by_peak), Significant(6)),
        cell(
            "Thermite",
            "RK4's period, cubic Hermite crossings (s)",
            periods.by_crossing,
            // Rounding of the crossings moves the next digit but one.
            Fixed(10),
        ),
        cell(
            "hermite",
            "its relative error (%)",
            periods.percent(periods.by_crossing),
            Scientific(1),
        ),
        cell("T0", "small-angle period T₀ (s)", periods.small_angle, Fixed(12)),
        cell("ratio", "period ratio T/T₀", periods.exact / periods.small_angle, Fixed(9)),
        cell("k", "elliptic modulus k = sin(θ₀/2)", periods.modulus, Fixed(12)),
        cell("caption_k", "the same in the caption", periods.modulus, Fixed(12)),
    ]);
}

fn table_8(study: &Study, claims: &mut Vec<Claim>) {
    for (method, row) in of_the_paper(&study.work, |row| row.method) {
        let title = method.title();
        let column = |quantity, what: &str, measured| {
            cell(cell_id(8, method, quantity), format!("{what} of {title}"), measured)
        };
        let (evaluations, errors) = row.points[work::TABLE_8];
        claims.extend([
            column("ms", "wall time for 1000 steps (ms)", Measured::Nothing),
            column("evals", "force evaluations", Measured::Number(evaluations as f64, Fixed(0))),
            column("rms", "RMS angle error (rad)", Measured::Number(errors.formula, Scientific(6))),
            column(
                "dH",
                "largest energy error (J)",
                // RK4's error is 10⁸ units in the last place of the energy, and 1000 steps move it
                // by about ten of them: four digits are safe.
                Measured::Number(
                    errors.energy,
                    Scientific(if method == PaperMethod::Rk4 { 4 } else { 6 }),
                ),
            ),
        ]);
    }
}

/// Numbers that no table of the paper has, but that the chapters quote.
fn found_besides(study: &Study, claims: &mut Vec<Claim>) {
    let fe = row!(study.long_run, ForwardEuler);
    let rk4 = row!(study.long_run, Rk4);
    let vv = row!(study.long_run, StormerVerlet);
    let verlet = row!(study.convergence, StormerVerlet).drift;
    let start = small_angle::THETA_0;
    let first_fall =
        findings::first_fall(&InSteps(ForwardEuler), start, long_run::STEP, long_run::DURATION);
    let norm = findings::normalised_formula_error(&InSteps(Rk4), 1e-4, 0.01);
    let loss = |steps| findings::energy_drift(&InSteps(Dop853), 1.0, 0.2, steps);
    let growth = |steps| findings::growth_over_swings(&InSteps(BlanesMoan6), steps, [20.0, 4000.0]);
    let finding =
        |id: &str, value, digits| number(id.to_string(), FINDINGS[id].clone(), value, digits);
    claims.extend([
        finding("X.fe.falls", fe.falls as f64, Fixed(0)),
        finding("X.fe.omega", fe.end.omega.abs(), Fixed(2)),
        finding("X.fe.first_fall", first_fall.unwrap_or(f64::NAN), Fixed(2)),
        finding("X.rk4.norm_rms", norm.1, Scientific(2)),
        finding("X.dop853.loss", loss(2500), Scientific(2)),
        finding("X.dop853.growth", loss(10_000) / loss(2500), Fixed(1)),
        finding("X.resonance.at", growth(8.0), Fixed(0)),
        finding("X.resonance.beside", growth(7.8), Fixed(1)),
        finding("X.fe.over_vv", fe.drift / vv.drift, Scientific(3)),
        finding("X.rk4.advantage", vv.drift / rk4.drift, Fixed(0)),
        finding("X.vv.ratio", verlet[2] / verlet[3], Fixed(5)),
    ]);
}

#[cfg(test)]
mod tests {
    use rstest::rstest;

    use super::number;
    use crate::digits::Digits::Fixed;

    /// Each table states the condition under which it is measured, here tested by words that no
    /// other table has.
    ///
    /// Catches: a table whose cells have no place or definition, or those of another table.
    #[rstest]
    #[case("T2.vv.order", "Table 2", "slope")]
    #[case("T4.rk4.0.01", "Table 4", "π/3")]
    #[case("T5.fe.dH", "Table 5", "from rest at 1 rad")]
    #[case("T6.se.0.05", "Table 6", "all N + 1 samples")]
    #[case("T7.Texact", "Table 7", "3 rad")]
    #[case("T8.fe.rms", "Table 8", "0.05 rad, Δt = 0.01 s")]
    fn a_cell_says_where_it_stands_and_how_it_is_measured(
        #[case] id: &str,
        #[case] place: &str,
        #[case] condition: &str,
    ) {
        let cell = number(id.to_string(), String::new(), 1.0, Fixed(0));
        assert_eq!(cell.place, place);
        assert!(cell.definition.contains(condition), "{}", cell.definition);
        assert!(cell.stated.is_some(), "{id} is printed");
    }

    /// Catches: a number of our own presented as one of the paper's.
    #[test]
    fn what_is_not_printed_stands_nowhere() {
        let finding = number("X.fe.falls".to_string(), String::new(), 1.0, Fixed(0));
        assert_eq!((finding.place, finding.definition, finding.stated), ("", "", None));
    }
}
