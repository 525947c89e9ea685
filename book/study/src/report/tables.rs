//! The paper's tables, stated and measured, from the ledger.

use pendula::metrics::order::slopes;
use pendula_judge::properties::{PROPERTIES, Property};
use pendula_judge::zoo::{Impostor, impostors};

use super::table::Table;
use crate::claims::{Claim, ClaimKind, Ledger, Measured, cell_id};
use crate::digits::Digits::{self, Fixed, Scientific, Significant};
use crate::experiments::characteristics::ROUNDING;
use crate::experiments::{
    PaperMethod, STEPS, Study, beyond, diffusion, enclosure, standard_map, work,
};
use crate::questions::{self, Truth, Within};

/// The numbers of the tables that the paper prints and the study measures.
pub const TABLES: [u32; 6] = [2, 4, 5, 6, 7, 8];

/// Table `number`, or `None` if it is not among [`TABLES`].
pub fn table(ledger: &Ledger, number: u32) -> Option<Table> {
    match number {
        7 => Some(by_quantity(ledger, 7)),
        _ => Some(by_method(ledger, number, &columns(number)?)),
    }
}

/// The columns of Table `number`, as the ids of its cells name them, with their headings; `None` if
/// it has no row for each method.
fn columns(number: u32) -> Option<Vec<(String, String)>> {
    let of = |columns: &[(&str, &str)]| {
        let column = |&(name, title): &(&str, &str)| (name.to_string(), title.to_string());
        Some(columns.iter().map(column).collect())
    };
    match number {
        2 => of(&[
            ("order", "Order"),
            ("sympl", "Symplectic"),
            ("evals", "Evaluations in one step"),
            ("behav", "Energy over 1000 s"),
        ]),
        4 | 6 => Some(STEPS.map(|step| (step.to_string(), format!("Δt = {step} s"))).to_vec()),
        5 => of(&[
            ("dH", "ΔH (J)"),
            ("pct", "ΔH in % of H(0)"),
            ("H0", "H(0) (J)"),
            ("Hend", "H(1000 s) (J)"),
        ]),
        8 => of(&[("evals", "Evaluations"), ("rms", "RMS error (rad)"), ("dH", "ΔH (J)")]),
        _ => None,
    }
}

/// The id of the cell of Table `number` in the row of the method with this title, in the column
/// with this heading.
pub fn cell_at(number: u32, row: &str, column: &str) -> Option<String> {
    let row = PaperMethod::ALL.into_iter().find(|method| method.title() == row)?;
    let (column, _) = columns(number)?.into_iter().find(|(_, heading)| heading == column)?;
    Some(cell_id(number, row, column))
}

/// Below this, rounding moves the second digit of an energy error (J), and with it the second
/// decimal of a slope: one cell of Table 4, RK4's at the finest step, 3.2e-12 ± 10 %.
const ENERGY_FLOOR: f64 = 1e-11;

/// The slopes of Table 4's energy errors between neighbouring steps.
pub fn energy_slopes(study: &Study) -> Table {
    let columns = STEPS.windows(2).map(|h| format!("{} → {} s", h[0], h[1]));
    let mut table = Table::new(["Method".to_string()].into_iter().chain(columns));
    for row in &study.convergence {
        let slopes = slopes(&STEPS, &row.drift, ENERGY_FLOOR);
        let cells = slopes.map(|slope| slope.map_or("…".to_string(), |p| Fixed(2).print(p)));
        table.push([row.method.info().title.to_string()].into_iter().chain(cells));
    }
    table
}

/// The slopes of the largest error of the state on each method's ladder, from the coarsest rung to
/// the finest above the rounding floor.
pub fn state_slopes(study: &Study) -> Table {
    let mut table = Table::new([
        "Method",
        "order",
        "first step (s)",
        "slope 1",
        "slope 2",
        "slope 3",
        "slope 4",
    ]);
    for row in &study.characteristics {
        let entry = row.method.info();
        let lead =
            [entry.title.to_string(), entry.order.to_string(), Fixed(6).print(row.ladder.steps[0])];
        let order = f64::from(entry.order);
        let slopes = row.ladder.slopes_and_windows().map(|(slope, window)| {
            // A NaN is in no window.
            let within = (slope - order).abs() <= window;
            after_mark(!within, &Fixed(2).print(slope))
        });
        table.push(lead.into_iter().chain(slopes));
    }
    table
}

/// Every method of the library with its measured properties, not the declared ones.
pub fn methods(study: &Study) -> Table {
    let header =
        ["Method", "order", "symplectic", "evaluations a step", "ΔH over 1000 s (J)", "energy"];
    let mut table = Table::new(header);
    for row in &study.characteristics {
        let drift = study.long_run.iter().find(|run| run.method.info() == row.method.info());
        table.push([
            row.method.info().title.to_string(),
            observed_order(row),
            (if row.symplectic() { "yes" } else { "no" }).to_string(),
            Fixed(0).print(row.evaluations),
            drift.map_or(String::new(), |run| below_rounding(run.drift)),
            row.energy.to_string(),
        ]);
    }
    table
}

/// The slope at the fine end of the ladder, with its uncertainty where that exceeds ½.
fn observed_order(row: &crate::experiments::characteristics::Row) -> String {
    match row.ladder.slopes_and_windows().last() {
        Some((slope, window)) if window > 0.5 => {
            format!("{} ± {}", Fixed(0).print(slope), Fixed(0).print(window))
        }
        _ => Fixed(0).print(row.order()),
    }
}

/// A long run's energy error (J) to two digits, or "rounding" where it is no larger than that.
fn below_rounding(drift: f64) -> String {
    if drift < ROUNDING { "rounding".to_string() } else { Scientific(2).print(drift) }
}

/// What theory predicts for the cells of the tables, beside what the paper states and what is
/// measured.
pub fn predictions(ledger: &Ledger) -> Table {
    let header = ["Cell", "stated", "predicted", "measured", "to within", "law"];
    let mut table = Table::new(header).with_remarks(1);
    for prediction in crate::claims::predictions() {
        let Some(claim) = ledger.get(&prediction.id) else { continue };
        let agrees = match claim.measured {
            Measured::Number(measured, _) => prediction.agrees_with(measured),
            _ => false,
        };
        table.push([
            format!("`{}`", prediction.id),
            claim.stated_text(),
            Scientific(6).print(prediction.value),
            after_mark(!agrees, &claim.measured_text()),
            Scientific(1).print(prediction.tolerance),
            prediction.law.to_string(),
        ]);
    }
    table
}

/// The claims that are cells of tables, and what the chapters quote beside them.
pub fn cells(ledger: &Ledger) -> Table {
    let header = ["Claim", "stated", "measured", "verdict", "where"];
    let mut table = Table::new(header).with_remarks(2);
    for claim in ledger.claims().iter().filter(|claim| !is_sentence(claim)) {
        let place = match claim.definition {
            "" => claim.place.to_string(),
            definition => format!("{}: {definition}", claim.place),
        };
        let (stated, measured) = (claim.stated_text(), claim.measured_text());
        table.push([name(claim), stated, measured, judgement(claim), place]);
    }
    table
}

/// The claims that are sentences.
pub fn sentences(ledger: &Ledger) -> Table {
    let header = ["Claim", "where", "stated", "measured", "verdict"];
    let mut table = Table::new(header).with_remarks(4);
    for claim in ledger.claims().iter().filter(|claim| is_sentence(claim)) {
        let measured = match claim.definition {
            "" => claim.measured_text(),
            definition => format!("{} ({definition})", claim.measured_text()),
        };
        let row =
            [name(claim), claim.place.to_string(), claim.stated_text(), measured, judgement(claim)];
        table.push(row);
    }
    table
}

fn is_sentence(claim: &Claim) -> bool {
    claim.stated.is_some() && claim.kind() != ClaimKind::Cell
}

/// The systems beyond the simple pendulum: what is known of them, and what the library finds.
pub fn beyond() -> Table {
    let mut table = Table::new(["Quantity", "known", "found", "Source"]).with_remarks(1);
    for row in beyond::rows() {
        let text = |(value, format): (f64, Digits)| format.print(value);
        let known = row.known.map_or_else(String::new, text);
        let mut found = row.format.print(row.found);
        if let Some(error) = row.error.map(text) {
            found += &format!(" ± {error}");
        }
        table.push([row.quantity, &known, &found, row.source]);
    }
    table
}

/// Where RK4 overtakes Störmer–Verlet, by amplitude.
pub fn crossings() -> Table {
    let mut table = Table::new(["From rest at (rad)", "evaluations", "RMS angle error (rad)"]);
    for (theta_0, crossing) in work::crossings() {
        let dash = || "—".to_string();
        table.push([
            theta_0.to_string(),
            crossing.map_or_else(dash, |crossing| crossing.evaluations.to_string()),
            crossing.map_or_else(dash, |crossing| Scientific(2).print(crossing.error)),
        ]);
    }
    table
}

/// The zoo: each wrong method, the method that it poses as, and the properties that catch it; in
/// the last row how many each of them catches.
pub fn zoo() -> Table {
    let mut header = vec!["a wrong method".to_string(), "poses as".to_string()];
    header.extend(PROPERTIES.iter().map(|property| property.name.replace('_', " ")));
    let mut table = Table::new(header);
    let zoo = impostors();
    let catches = |impostor: &Impostor, property: &Property| {
        impostor.caught_by.iter().any(|catching| catching.name == property.name)
    };
    for impostor in &zoo {
        let mut row = vec![impostor.title(), impostor.poses_as.title.to_string()];
        let mark = |property| if catches(impostor, property) { "●" } else { "" };
        row.extend(PROPERTIES.iter().map(|property| mark(property).to_string()));
        table.push(row);
    }
    let mut last = vec![format!("**of {}, caught**", zoo.len()), String::new()];
    last.extend(PROPERTIES.iter().map(|property| {
        zoo.iter().filter(|impostor| catches(impostor, property)).count().to_string()
    }));
    table.push(last);
    table
}

/// The digits in which both ends of a band agree when they are rounded, three at most.
///
/// # Panics
///
/// If they agree in none.
fn agreed(band: [f64; 2]) -> String {
    let printed = |digits| band.map(|end| Significant(digits).print(end));
    let alike = (1..=3).rev().map(printed).find(|[least, most]| least == most);
    let [text, _] = alike.unwrap_or_else(|| panic!("no digit of {band:?} holds"));
    text
}

/// What becomes of Störmer–Verlet's orbits at large steps.
pub fn diffusion() -> Table {
    let header = ["K", "Δt (s)", "from 1 rad: ΔH (J)", "from 3 rad: ΔH (J)", "spread"];
    let mut table = Table::new(header);
    for row in diffusion::run() {
        let drift = |drift: Option<[f64; 2]>| drift.map_or_else(|| "escapes".to_string(), agreed);
        table.push([
            row.k.to_string(),
            Fixed(4).print(standard_map::step(row.k)),
            drift(row.from_1_rad),
            drift(row.from_3_rad),
            // Another last digit of the sine makes another orbit of each in the chaotic sea: of
            // 10⁴ starts the mean is good to some per cent.
            Significant(1).print(row.spread),
        ]);
    }
    table
}

/// What is proved of a trajectory, whatever the roundings.
pub fn enclosure() -> Table {
    let header =
        ["t (s)", "θ (rad)", "width (rad)", "ω (rad/s)", "width (rad/s)", "the closed form is"];
    let mut table = Table::new(header);
    for row in enclosure::run() {
        let width = |x: enclosure::Interval| Scientific(2).print(x.width());
        table.push([
            row.time.to_string(),
            enclosure::proved_digits(row.known.theta),
            width(row.known.theta),
            enclosure::proved_digits(row.known.omega),
            width(row.known.omega),
            (if row.known.contains(row.closed_form) { "within" } else { "without" }).to_string(),
        ]);
    }
    table
}

/// What is right in each question of the book, from where to where a number counts, and the numbers
/// to which mistakes lead.
pub fn questions() -> Table {
    let mut table = Table::new(["Question", "right", "counts", "mistakes"]);
    let number = |value: f64| Significant(3).print(value);
    for (id, truth) in questions::all() {
        let mut counts = String::new();
        let (right, mistakes) = match truth() {
            Truth::Which(choices) => {
                let right = choices.into_iter().filter(|(_, is_right)| *is_right);
                (right.map(|(name, _)| name).collect::<Vec<_>>().join(" and "), Vec::new())
            }
            Truth::Number { right, within, mistakes } => {
                counts = within.range(right).map(|end| Significant(4).print(end)).join(" to ");
                let mistake = |(name, wrong)| format!("{name} {}", number(wrong));
                let right = match within {
                    Within::Count(_) => right.to_string(),
                    Within::Percent(_) => number(right),
                };
                (right, mistakes.into_iter().map(mistake).collect())
            }
            Truth::Order(items) => (items.join(", "), Vec::new()),
        };
        table.push([format!("`{id}`"), right, counts, mistakes.join(", ")]);
    }
    table
}

fn name(claim: &Claim) -> String {
    format!("`{}` {}", claim.id, claim.gist)
}

/// The verdict that the measurement supports. The reason on record belongs to the verdict on
/// record: where the two verdicts differ, the row says so instead.
fn judgement(claim: &Claim) -> String {
    match (claim.judged(), claim.because) {
        (judged, _) if judged != claim.verdict => {
            format!("≠ **{judged}** (on record: {})", claim.verdict)
        }
        (judged, "") => judged.to_string(),
        (judged, because) => format!("**{judged}**. {because}"),
    }
}

/// Two rows for each method, stated above measured; a method or column that the paper leaves out
/// has dashes above.
fn by_method(ledger: &Ledger, number: u32, columns: &[(String, String)]) -> Table {
    let titles = columns.iter().map(|(_, title)| title.clone());
    let mut table = Table::new(["Method", "value"].map(String::from).into_iter().chain(titles));
    for row in PaperMethod::ALL {
        let cells: Vec<Option<&Claim>> =
            columns.iter().map(|(column, _)| ledger.get(&cell_id(number, row, column))).collect();
        let line = |name: &str, what: &str, text: fn(&Claim) -> String| {
            let cells = cells.iter().map(|cell| cell.map_or_else(String::new, text));
            [name.to_string(), what.to_string()].into_iter().chain(cells).collect::<Vec<_>>()
        };
        table.push(line(row.title(), "stated", Claim::stated_text));
        table.push(line("", "measured", marked));
    }
    table
}

/// A row for each quantity.
fn by_quantity(ledger: &Ledger, number: u32) -> Table {
    let mut table = Table::new(["Quantity", "stated", "measured"]);
    for claim in ledger.table(number) {
        table.push([claim.gist.clone(), claim.stated_text(), marked(claim)]);
    }
    table
}

/// The measured value, marked where it contradicts what is stated.
fn marked(claim: &Claim) -> String {
    after_mark(claim.holds() == Some(false), &claim.measured_text())
}

/// A value after a ≠ where it `differs` from what it should be and after a blank elsewhere, so that
/// a cell whose mark changes does not change the width of the table.
fn after_mark(differs: bool, value: &str) -> String {
    format!("{} {value}", if differs { '≠' } else { ' ' })
}
