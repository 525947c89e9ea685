//! The paper's tables, stated and measured, from the ledger.

use pendula::metrics::order::slopes;
use pendula_judge::properties::{PROPERTIES, Property};
use pendula_judge::zoo::{Impostor, impostors};

use super::table::{Cell, Column, Quantity, Table};
use crate::claims::{Claim, ClaimKind, Ledger, Measured};
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
        _ => Some(by_method(ledger, columns(number)?)),
    }
}

/// The columns of Table `number`; `None` if it has no row for each method.
fn columns(number: u32) -> Option<Vec<Column>> {
    use Quantity::{Energy, Order, Symplectic};
    let of = |name: &str, title: &str| Column::from(title).of(format!("T{number}.*.{name}"));
    Some(match number {
        2 => vec![
            of("order", "Order").is(Order),
            of("sympl", "Symplectic").is(Symplectic),
            of("evals", "Evaluations in one step"),
            of("behav", "Energy over 1000 s").is(Energy),
        ],
        4 | 6 => STEPS.map(|step| of(&step.to_string(), &format!("Δt = {step} s"))).to_vec(),
        5 => vec![
            of("dH", "ΔH (J)"),
            of("pct", "ΔH in % of H(0)"),
            of("H0", "H(0) (J)"),
            of("Hend", "H(1000 s) (J)"),
        ],
        8 => vec![of("evals", "Evaluations"), of("rms", "RMS error (rad)"), of("dH", "ΔH (J)")],
        _ => return None,
    })
}

/// Below this, rounding moves the second digit of an energy error (J), and with it the second
/// decimal of a slope: one cell of Table 4, RK4's at the finest step, 3.2e-12 ± 10 %.
const ENERGY_FLOOR: f64 = 1e-11;

/// The slopes of Table 4's energy errors between neighbouring steps.
pub fn energy_slopes(study: &Study) -> Table {
    let slope = |h: &[f64]| Column::from(format!("{} → {} s", h[0], h[1])).is(Quantity::Slope);
    let columns = STEPS.windows(2).map(slope);
    let mut table = Table::new([Column::from("Method")].into_iter().chain(columns));
    for row in &study.convergence {
        let slopes = slopes(&STEPS, &row.drift, ENERGY_FLOOR);
        let cells = slopes.map(|slope| slope.map_or("…".to_string(), |p| Fixed(2).literal(p)));
        table.push([row.method.info().title.to_string()].into_iter().chain(cells));
    }
    table
}

/// The slopes of the largest error of the state on each method's ladder, from the coarsest rung to
/// the finest above the rounding floor.
pub fn state_slopes(study: &Study) -> Table {
    let slopes = [1, 2, 3, 4].map(|n| Column::from(format!("slope {n}")).is(Quantity::Slope));
    let order = Column::from("order").is(Quantity::Claimed);
    let columns = ["Method".into(), order, "first step (s)".into()];
    let mut table = Table::new(columns.into_iter().chain(slopes));
    for row in &study.characteristics {
        let entry = row.method.info();
        let first = Fixed(6).literal(row.ladder.steps[0]);
        let lead = [entry.title.to_string(), entry.order.to_string(), first].map(Cell::from);
        let order = f64::from(entry.order);
        let slopes = row.ladder.slopes_and_windows().map(|(slope, window)| {
            // A NaN is in no window.
            let within = (slope - order).abs() <= window;
            Cell { text: Fixed(2).literal(slope), differs: !within }
        });
        table.push(lead.into_iter().chain(slopes));
    }
    table
}

/// Every method of the library with its measured properties, not the declared ones.
pub fn methods(study: &Study) -> Table {
    // Table 2 has the methods of the paper, too, and Table 5 their long runs.
    let mut table = Table::new([
        "id".into(),
        "Method".into(),
        Column::from("order").is(Quantity::Order).of("T2.*.order"),
        Column::from("symplectic").is(Quantity::Symplectic).of("T2.*.sympl"),
        Column::from("evaluations a step").of("T2.*.evals"),
        Column::from("ΔH over 1000 s (J)").of("T5.*.dH"),
        Column::from("energy").is(Quantity::Energy).of("T2.*.behav"),
    ]);
    for row in &study.characteristics {
        let id = PaperMethod::of(row.method).map_or(row.method.info().name, PaperMethod::id);
        let drift = study.long_run.iter().find(|run| run.method.info() == row.method.info());
        table.push([
            id.to_string(),
            row.method.info().title.to_string(),
            observed_order(row),
            (if row.symplectic() { "yes" } else { "no" }).to_string(),
            Fixed(0).literal(row.evaluations),
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
            format!("{} ± {}", Fixed(0).literal(slope), Fixed(0).literal(window))
        }
        _ => Fixed(0).literal(row.order()),
    }
}

/// A long run's energy error (J) to two digits, or "rounding" where it is no larger than that.
fn below_rounding(drift: f64) -> String {
    if drift < ROUNDING { "rounding".to_string() } else { Scientific(2).literal(drift) }
}

/// What theory predicts for the cells of the tables, beside what the paper states and what is
/// measured.
pub fn predictions(ledger: &Ledger) -> Table {
    let mut table = Table::new([
        "Cell".into(),
        "stated".into(),
        "predicted".into(),
        Column::from("measured").of("*"),
        "to within".into(),
        "law".into(),
    ])
    .with_remarks(1);
    for prediction in crate::claims::predictions() {
        let Some(claim) = ledger.get(&prediction.id) else { continue };
        let agrees = match claim.measured {
            Measured::Number(measured, _) => prediction.agrees_with(measured),
            _ => false,
        };
        table.push([
            prediction.id.as_str().into(),
            stated(claim),
            Scientific(6).literal(prediction.value).into(),
            Cell { text: claim.measured_literal(), differs: !agrees },
            Scientific(1).literal(prediction.tolerance).into(),
            prediction.law.into(),
        ]);
    }
    table
}

/// The claims that are cells of tables, and what the chapters quote beside them.
pub fn cells(ledger: &Ledger) -> Table {
    claims(ledger, |claim| !is_sentence(claim)).with_remarks(5)
}

/// The claims that are sentences.
pub fn sentences(ledger: &Ledger) -> Table {
    claims(ledger, is_sentence).with_remarks(7)
}

fn claims(ledger: &Ledger, wanted: fn(&Claim) -> bool) -> Table {
    let mut table = Table::new([
        "Claim".into(),
        Column::from("gist").in_words(),
        "stated".into(),
        Column::from("measured").of("*"),
        Column::from("verdict").is(Quantity::Verdict),
        Column::from("because").is(Quantity::Verdict),
        "kind".into(),
        "where".into(),
        "definition".into(),
    ]);
    for claim in ledger.claims().iter().filter(|claim| wanted(claim)) {
        let judged = claim.judged();
        let differs = judged != claim.verdict;
        // The reason on record belongs to the verdict on record.
        let because = match differs {
            true => format!("(on record: {})", claim.verdict),
            false => claim.because.to_string(),
        };
        table.push([
            claim.id.as_str().into(),
            claim.gist.as_str().into(),
            stated(claim),
            claim.measured_literal().into(),
            Cell { text: judged.to_string(), differs },
            because.into(),
            claim.kind().to_string().into(),
            claim.place.into(),
            claim.definition.into(),
        ]);
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
        let text = |(value, format): (f64, Digits)| format.literal(value);
        let known = row.known.map_or_else(String::new, text);
        let mut found = row.format.literal(row.found);
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
            crossing.map_or_else(dash, |crossing| Scientific(2).literal(crossing.error)),
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
    let printed = |digits| band.map(|end| Significant(digits).literal(end));
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
            Fixed(4).literal(standard_map::step(row.k)),
            drift(row.from_1_rad),
            drift(row.from_3_rad),
            // Another last digit of the sine makes another orbit of each in the chaotic sea: of
            // 10⁴ starts the mean is good to some per cent.
            Significant(1).literal(row.spread),
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
        let width = |x: enclosure::Interval| Scientific(2).literal(x.width());
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
    let number = |value: f64| Significant(3).literal(value);
    for (id, truth) in questions::all() {
        let mut counts = String::new();
        let (right, mistakes) = match truth() {
            Truth::Which(choices) => {
                let right = choices.into_iter().filter(|(_, is_right)| *is_right);
                (right.map(|(name, _)| name).collect::<Vec<_>>().join(" and "), Vec::new())
            }
            Truth::Number { right, within, mistakes } => {
                counts = within.range(right).map(|end| Significant(4).literal(end)).join(" to ");
                let mistake = |(name, wrong)| format!("{name} {}", number(wrong));
                let right = match within {
                    Within::Count(_) => right.to_string(),
                    Within::Percent(_) => number(right),
                };
                (right, mistakes.into_iter().map(mistake).collect())
            }
            Truth::Order(items) => (items.join(", "), Vec::new()),
        };
        table.push([id.to_string(), right, counts, mistakes.join(", ")]);
    }
    table
}

/// What the paper prints; a dash for what it leaves out.
fn stated(claim: &Claim) -> Cell {
    claim.stated.unwrap_or("—").into()
}

/// Two rows for each method, stated above measured; a method or column that the paper leaves out
/// has dashes above.
fn by_method(ledger: &Ledger, columns: Vec<Column>) -> Table {
    let names = ["id", "Method", "value"].map(Column::from).into_iter();
    let mut table = Table::new(names.chain(columns.iter().cloned()));
    for row in PaperMethod::ALL {
        let cell = |column: &Column| ledger.get(&column.claim(row.id())?);
        let cells: Vec<Option<&Claim>> = columns.iter().map(cell).collect();
        let mut line = |[id, name, what]: [&str; 3], cell: fn(&Claim) -> Cell| {
            let cells = cells.iter().map(|claim| claim.map_or_else(Cell::default, cell));
            table.push([id, name, what].map(Cell::from).into_iter().chain(cells));
        };
        line([&format!("{} stated", row.id()), row.title(), "stated"], stated);
        line([row.id(), "", "measured"], measured);
    }
    table
}

/// A row for each quantity.
fn by_quantity(ledger: &Ledger, number: u32) -> Table {
    let measured_column = Column::from("measured").of("*");
    let mut table = Table::new(["id".into(), "Quantity".into(), "stated".into(), measured_column]);
    for claim in ledger.table(number) {
        let names = [claim.id.as_str(), claim.gist.as_str()].map(Cell::from);
        table.push(names.into_iter().chain([stated(claim), measured(claim)]));
    }
    table
}

/// The measured value, marked where it contradicts what is stated.
fn measured(claim: &Claim) -> Cell {
    Cell { text: claim.measured_literal(), differs: claim.holds() == Some(false) }
}
