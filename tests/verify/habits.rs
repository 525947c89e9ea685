//! The judge of solvers on many right ones, whose loops have other habits, and on many wrong ones,
//! each with one number changed.

use pendula_judge::zoo::tabled::{
    Control, First, Habits, Norm, Outputs, Passage, Scale, Table, Tabled,
};
use pendula_judge::{Claims, Report, Verdict, judge_solver};

/// So many of a search, or as many as are asked for: `.ci/slow` asks for more.
fn count(usual: usize) -> usize {
    std::env::var("PENDULA_SOLVERS").ok().and_then(|n| n.parse().ok()).unwrap_or(usual)
}

/// What is claimed of a report and does not hold.
fn told(report: &Report) -> String {
    let those = report.findings.iter();
    let those = those.filter(|it| it.claimed.is_some() && it.verdict != Verdict::Holds);
    let told = those.map(|it| format!("{} {:?}: {}", it.property, it.verdict, it.measured()));
    told.chain(report.look_at()).collect::<Vec<_>>().join("\n    ")
}

/// A table by its name.
type Named = (&'static str, fn() -> Table);

const TABLES: [Named; 11] = [
    ("Heun–Euler", Table::heun_euler),
    ("Bogacki–Shampine", Table::bogacki_shampine),
    ("Fehlberg", Table::fehlberg),
    ("Cash–Karp", Table::cash_karp),
    ("Dormand–Prince", Table::dormand_prince),
    ("Tsitouras", Table::tsitouras),
    ("Bogacki–Shampine, lower", || Table::bogacki_shampine().lower()),
    ("Fehlberg, lower", || Table::fehlberg().lower()),
    ("Cash–Karp, lower", || Table::cash_karp().lower()),
    ("Dormand–Prince, lower", || Table::dormand_prince().lower()),
    ("Tsitouras, lower", || Table::tsitouras().lower()),
];

/// A right solver of this number, its name, and what it claims.
fn right(k: usize) -> (String, Tabled, Claims) {
    // Low-discrepancy choices, one sequence for each habit.
    let pick = |j: i32, n: usize| {
        let x = (0.5 + k as f64 * 1.1357241356_f64.powi(-j)).fract();
        (x * n as f64) as usize
    };
    let (name, table) = TABLES[k % TABLES.len()];
    let table = table();
    let low = table.order <= 3;
    let habits = Habits {
        norm: [Norm::Largest, Norm::MeanSquare, Norm::Euclidean][pick(1, 3)],
        scale: [Scale::Both, Scale::Old, Scale::OneAbsolute, Scale::Absolute][pick(2, 4)],
        control: [Control::Last, Control::Two, Control::Halves][pick(3, 3)],
        first: [First::Part, First::Tiny, First::Guessed, First::Whole][pick(4, 4)],
        outputs: [Outputs::Step, Outputs::Stops, if low { Outputs::Cubic } else { Outputs::Step }]
            [pick(5, 3)],
        passage: [Passage::Root, Passage::Unsupported][pick(6, 2)],
        digits: [None, Some(17), Some(16), Some(15), Some(14), Some(13), Some(12)][pick(7, 7)],
        // Of first power it would take forever.
        per_unit: pick(8, 3) == 0 && table.power > 2,
        ..Habits::default()
    };
    let power = table.power - u32::from(habits.per_unit);
    let mut claims = Claims::order(table.order).estimate(power);
    if habits.outputs != Outputs::Stops {
        claims = claims.free_outputs();
    }
    if habits.passage == Passage::Root {
        claims = claims.crossings();
    }
    (format!("{k} {name} {habits:?}"), Tabled::new(table, habits), claims)
}

/// Catches: a bound that solvers with other norms, first steps, controls or roundings do not keep.
#[test]
fn right_solvers_of_all_habits_hold() {
    let count = count(5);
    let refused: Vec<String> = (0..count)
        .filter_map(|k| {
            let (name, solver, claims) = right(k);
            let report = judge_solver(&solver, claims);
            (report.verdict != Verdict::Holds).then(|| format!("{name}\n    {}", told(&report)))
        })
        .collect();
    assert!(refused.is_empty(), "{} of {count}\n{}", refused.len(), refused.join("\n"));
}

/// All tables of this pair with one number changed, and what was changed.
fn mutants(right: &Table) -> Vec<(String, Table)> {
    let mut all = Vec::new();
    let mut with = |name: String, change: &dyn Fn(&mut Table)| {
        let mut table = right.clone();
        change(&mut table);
        if table != *right {
            all.push((name, table));
        }
    };
    for i in 0..right.stages.len() {
        for j in 0..right.stages[i].len() {
            with(format!("a{i}{j} by a thousandth"), &|it| it.stages[i][j] *= 1.001);
            with(format!("a{i}{j} with its sign turned"), &|it| it.stages[i][j] *= -1.0);
        }
        with(format!("c{i} by a hundredth"), &|it| it.nodes[i] += 0.01 * f64::from(i > 0));
        with(format!("b{i} by a thousandth"), &|it| it.step[i] *= 1.001);
        with(format!("b{i} left out"), &|it| it.step[i] = 0.0);
        with(format!("e{i} by a hundredth"), &|it| it.estimate[i] *= 1.01);
        with(format!("e{i} with its sign turned"), &|it| it.estimate[i] *= -1.0);
    }
    all
}

/// Wrong by a thousandth in what hardly counts: the last stage of Bogacki and Shampine's, which is
/// in the estimate alone, and there less than what is right in it at all tolerances that are tried;
/// the second of Fehlberg's, which has no weight, and enters in terms beyond the order.
const UNSEEN: [&str; 5] = [
    "Bogacki–Shampine: a30 by a thousandth",
    "Bogacki–Shampine: a31 by a thousandth",
    "Bogacki–Shampine: a32 by a thousandth",
    "Fehlberg: a10 by a thousandth",
    "Fehlberg: c1 by a hundredth",
];

/// Catches: a wrong coefficient that no property sees any more.
#[test]
fn wrong_coefficients_are_refused() {
    let pairs = [("Bogacki–Shampine", Table::bogacki_shampine()), ("Fehlberg", Table::fehlberg())];
    let mut all = Vec::new();
    for (pair, table) in &pairs {
        let named = |(name, table)| (format!("{pair}: {name}"), table);
        all.extend(mutants(table).into_iter().map(named));
    }
    let step = (all.len() / count(3).min(all.len())).max(1);
    let mut passed = Vec::new();
    for (name, table) in all.into_iter().step_by(step) {
        let claims = Claims::order(table.order).estimate(table.power);
        let report = judge_solver(&Tabled::new(table, Habits::default()), claims);
        if std::env::var("PENDULA_SOLVERS").is_ok() {
            println!("{name}: {:?}\n    {}", report.verdict, told(&report));
        }
        if report.verdict == Verdict::Holds && !UNSEEN.contains(&&*name) {
            passed.push(name);
        }
    }
    assert!(passed.is_empty(), "{passed:#?}");
}
