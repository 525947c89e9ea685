//! How each number of the paper is measured: from the rows of the study to claims.

use pendula::methods::registry::METHODS;

use super::cells::{CELLS, Cell};
use super::{Claim, Measured, Tolerance, Verdict};
use crate::digits::Digits::{self, Fixed, Scientific, Significant};
use crate::experiments::{MethodRef, STEPS, Study, in_paper, work};

/// The paper's own abbreviation of a method in the ids of its cells; one that it does not know goes by its name.
pub fn row_id(method: MethodRef) -> &'static str {
    match method.info().name {
        "forward-euler" => "fe",
        "symplectic-euler" => "se",
        "stormer-verlet" => "vv",
        name => name,
    }
}

/// The rows of the paper's tables as (id, title), in order.
pub fn row_ids() -> Vec<(&'static str, &'static str)> {
    let rows = METHODS.iter().copied().filter(|method| in_paper(*method));
    rows.map(|method| (row_id(method), method.info().title)).collect()
}

/// All claims, measured, in the order of the tables.
pub(super) fn claims(study: &Study) -> Vec<Claim> {
    let mut claims = Vec::new();
    table_2(study, &mut claims);
    table_4(study, &mut claims);
    table_5(study, &mut claims);
    table_6(study, &mut claims);
    table_7(study, &mut claims);
    table_8(study, &mut claims);
    findings(study, &mut claims);
    claims
}

/// A claim about a number.
fn number(id: String, gist: String, value: f64, format: Digits) -> Claim {
    claim(id, gist, Measured::Number(value, format))
}

/// A claim about a property in words.
fn text(id: String, gist: String, measured: impl ToString) -> Claim {
    claim(id, gist, Measured::Text(measured.to_string()))
}

/// Joins what is measured with what the paper prints in the cell of that id.
fn claim(id: String, gist: String, measured: Measured) -> Claim {
    let printed = CELLS.iter().find(|cell| cell.id == id);
    let (place, definition) = match id.split('.').next() {
        Some("T2") => {
            ("Table 2", "measured, not declared: slope, det J, count, energy over 1000 s")
        }
        Some("T4") => ("Table 4", "max |Hₙ − H₀| over all samples of 50 s from rest at π/3"),
        Some("T5") => ("Table 5", "over all samples of 1000 s from rest at 1 rad, Δt = 0.01 s"),
        Some("T6") => ("Table 6", "mean over all N + 1 samples of 10 s from rest at 0.05 rad"),
        Some("T7") => ("Table 7", "from rest at 3 rad, Δt = 0.001 s, over 30 s"),
        Some("T8") => ("Table 8", "over 10 s from rest at 0.05 rad, Δt = 0.01 s"),
        _ => ("", ""),
    };
    Claim {
        place,
        gist,
        definition,
        stated: printed.map(|cell| cell.stated),
        measured,
        tolerance: Tolerance::PrintedDigits,
        verdict: printed.map_or(Verdict::NotStated, |cell| cell.verdict),
        because: printed.map_or("", |cell: &Cell| cell.because),
        id,
    }
}

fn table_2(study: &Study, claims: &mut Vec<Claim>) {
    for row in study.characteristics.iter().filter(|row| in_paper(row.method)) {
        let (id, title) = (row_id(row.method), row.method.info().title);
        let yes_or_no = if row.symplectic() { "Yes" } else { "No" };
        claims.extend([
            // An order is an integer. The slope itself is in the tests, to ±0.05.
            number(format!("T2.{id}.order"), format!("order of {title}"), row.order(), Fixed(0)),
            text(format!("T2.{id}.sympl"), format!("{title} symplectic"), yes_or_no),
            number(
                format!("T2.{id}.evals"),
                format!("force evaluations a step of {title}"),
                row.evaluations,
                Fixed(0),
            ),
            text(format!("T2.{id}.behav"), format!("energy of {title} over 1000 s"), row.energy),
        ]);
    }
}

fn table_4(study: &Study, claims: &mut Vec<Claim>) {
    for row in &study.convergence {
        let (id, title) = (row_id(row.method), row.method.info().title);
        for (step, drift) in STEPS.iter().zip(row.drift) {
            let gist = format!("largest energy error of {title} at Δt = {step} s (J)");
            let mut cell =
                number(format!("T4.{id}.{step}"), gist, drift, Scientific(digits(id, *step)));
            if id == "rk4" && *step == 0.001 {
                cell.tolerance = Tolerance::Around { value: 3.2e-12, relative: 0.1 };
            }
            claims.push(cell);
        }
    }
}

/// Digits of Table 4 that a sine of another platform, off by one ulp, leaves alone: seven or more everywhere but in
/// RK4's row, where the energy error nears the rounding of the energy itself.
fn digits(id: &str, step: f64) -> usize {
    match (id, step) {
        ("rk4", 0.005) => 4,
        ("rk4", 0.001) => 1,
        _ => 6,
    }
}

fn table_5(study: &Study, claims: &mut Vec<Claim>) {
    for row in study.long_run.iter().filter(|row| in_paper(row.method)) {
        let (id, title) = (row_id(row.method), row.method.info().title);
        let cell = |column: &str, what: &str, value, format| {
            number(format!("T5.{id}.{column}"), format!("{what} of {title}"), value, format)
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
    let shown =
        study.long_run.iter().filter(|row| ["fe", "se", "vv"].contains(&row_id(row.method)));
    let best = shown.min_by(|a, b| a.drift.total_cmp(&b.drift));
    let title = best.map_or("", |row| row.method.info().title);
    claims.push(text("T5.best".to_string(), "the best of the rows shown".to_string(), title));
}

fn table_6(study: &Study, claims: &mut Vec<Claim>) {
    for row in &study.small_angle {
        let (id, title) = (row_id(row.method), row.method.info().title);
        for (step, errors) in STEPS.iter().zip(row.errors) {
            let gist =
                format!("RMS angle error of {title} against θ₀ cos ω₀t at Δt = {step} s (rad)");
            claims.push(number(format!("T6.{id}.{step}"), gist, errors.formula, Scientific(6)));
        }
    }
}

fn table_7(study: &Study, claims: &mut Vec<Claim>) {
    let periods = &study.large_angle;
    let cell = |column: &str, gist: &str, value, format| {
        number(format!("T7.{column}"), gist.to_string(), value, format)
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
    for row in &study.work {
        let (id, title) = (row_id(row.method), row.method.info().title);
        let column = |name: &str, what: &str, measured| {
            claim(format!("T8.{id}.{name}"), format!("{what} of {title}"), measured)
        };
        let (evaluations, errors) = row.points[work::TABLE_8];
        claims.extend([
            column("ms", "wall time for 1000 steps (ms)", Measured::Nothing),
            column("evals", "force evaluations", Measured::Number(evaluations as f64, Fixed(0))),
            column("rms", "RMS angle error (rad)", Measured::Number(errors.formula, Scientific(6))),
            column(
                "dH",
                "largest energy error (J)",
                // RK4's error is 10⁵ quanta of the energy: five digits are there, four are safe.
                Measured::Number(errors.energy, Scientific(if id == "rk4" { 4 } else { 6 })),
            ),
        ]);
    }
}

/// Numbers that no table of the paper has, but that the chapters quote.
fn findings(study: &Study, claims: &mut Vec<Claim>) {
    let long_run = |id| study.long_run.iter().find(|row| row_id(row.method) == id);
    let verlet = study.convergence.iter().find(|row| row_id(row.method) == "vv");
    let (Some(fe), Some(rk4), Some(vv), Some(verlet)) =
        (long_run("fe"), long_run("rk4"), long_run("vv"), verlet)
    else {
        return;
    };
    let finding = |id: &str, gist: &str, value, format| {
        number(format!("X.{id}"), gist.to_string(), value, format)
    };
    claims.extend([
        finding(
            "fe.falls",
            "steps of forward Euler that lower the energy, of the 100 000 of Table 5",
            fe.falls as f64,
            Fixed(0),
        ),
        finding(
            "fe.omega",
            "forward Euler's speed at the end of Table 5 (rad/s)",
            fe.end.omega.abs(),
            Fixed(2),
        ),
        finding(
            "fe.over_vv",
            "energy error of forward Euler over that of Störmer–Verlet in Table 5",
            fe.drift / vv.drift,
            Scientific(3),
        ),
        finding(
            "rk4.advantage",
            "energy error of Störmer–Verlet over that of RK4 in Table 5",
            vv.drift / rk4.drift,
            Fixed(0),
        ),
        finding(
            "vv.ratio",
            "energy error of Störmer–Verlet at 0.01 s over that at 0.005 s in Table 4",
            verlet.drift[2] / verlet.drift[3],
            Fixed(5),
        ),
    ]);
}

#[cfg(test)]
mod tests {
    use rstest::rstest;

    use super::number;
    use crate::digits::Digits::Fixed;

    /// The condition that each table is measured under is what its reader needs most: here by a word that no other table has.
    ///
    /// Catches: a table whose cells go without a place or a definition, or under those of another.
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

    /// Catches: a number of our own that is passed off as one of the paper's.
    #[test]
    fn what_is_not_printed_stands_nowhere() {
        let finding = number("X.fe.falls".to_string(), String::new(), 1.0, Fixed(0));
        assert_eq!((finding.place, finding.definition, finding.stated), ("", "", None));
    }
}
