//! Where each claim is measured: on the runs of which experiment, and of which method.
//!
//! The rows of one method in one experiment are changed, and what moves in the ledger is what was
//! measured on them.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

use pendula_study::claims::{Claim, Ledger, Measured};
use pendula_study::experiments::characteristics::EnergyBehaviour;
use pendula_study::experiments::{PaperMethod, Study, small_angle};

use crate::{LEDGER, STUDY};

/// The study with the rows of `method` in one of its experiments changed: all numbers, each by a
/// factor or a term of its own, so that no ratio or slope of them stays.
fn changed(experiment: &str, method: PaperMethod) -> Study {
    let mut study = STUDY.clone();
    let is_own = |other| PaperMethod::of(other) == Some(method);
    let worse = |errors: &mut small_angle::Errors, i: usize| {
        let factor = 1.5 + 0.1 * i as f64;
        errors.formula *= factor;
        errors.truth *= factor + 0.03;
        errors.energy *= factor + 0.07;
    };
    match experiment {
        "characteristics" => {
            // Whatever one method is, another is not.
            let donor = match method {
                PaperMethod::StormerVerlet | PaperMethod::SymplecticEuler => PaperMethod::Rk4,
                _ => PaperMethod::StormerVerlet,
            };
            let rows = study.characteristics.iter();
            let donor = rows.copied().find(|row| PaperMethod::of(row.method) == Some(donor));
            let row = study.characteristics.iter_mut().find(|row| is_own(row.method)).unwrap();
            let donor = donor.unwrap();
            row.ladder = donor.ladder;
            row.area_defect = donor.area_defect;
            row.evaluations += 1.0;
            row.energy = EnergyBehaviour::Rounding;
        }
        "convergence" => {
            let row = study.convergence.iter_mut().find(|row| is_own(row.method)).unwrap();
            for (i, drift) in row.drift.iter_mut().enumerate() {
                *drift *= 1.5 + 0.1 * i as f64;
            }
        }
        "long_run" => {
            let row = study.long_run.iter_mut().find(|row| is_own(row.method)).unwrap();
            row.drift *= 1.5;
            row.early_drift *= 1.7;
            row.initial *= 1.1;
            row.last = row.last * 1.3 + 0.7;
            row.end.theta += 0.3;
            row.end.omega *= 1.2;
            row.falls += 7;
        }
        "small_angle" => {
            let row = study.small_angle.iter_mut().find(|row| is_own(row.method)).unwrap();
            row.errors.iter_mut().enumerate().for_each(|(i, errors)| worse(errors, i));
        }
        "work" => {
            let row = study.work.iter_mut().find(|row| is_own(row.method)).unwrap();
            for (i, (evaluations, errors)) in row.points.iter_mut().enumerate() {
                *evaluations += 3;
                worse(errors, i);
            }
        }
        other => panic!("{other}"),
    }
    study
}

const EXPERIMENTS: [&str; 5] =
    ["characteristics", "convergence", "long_run", "small_angle", "work"];

/// The study with the errors of `method` larger by `factor` wherever they stand, so that it is the
/// best or the worst of all; and in Table 4 by `tilt` more from each step to the next shorter one.
fn ranked(method: PaperMethod, factor: f64, tilt: f64) -> Study {
    let mut study = STUDY.clone();
    let is_own = |other| PaperMethod::of(other) == Some(method);
    let scale = |errors: &mut small_angle::Errors| {
        errors.formula *= factor;
        errors.truth *= factor;
        errors.energy *= factor;
    };
    for row in study.convergence.iter_mut().filter(|row| is_own(row.method)) {
        for (i, drift) in row.drift.iter_mut().enumerate() {
            *drift *= factor * tilt.powi(i as i32);
        }
    }
    for row in study.long_run.iter_mut().filter(|row| is_own(row.method)) {
        row.drift *= factor;
        row.early_drift *= factor;
    }
    for row in study.small_angle.iter_mut().filter(|row| is_own(row.method)) {
        row.errors.iter_mut().for_each(scale);
    }
    for row in study.work.iter_mut().filter(|row| is_own(row.method)) {
        row.points.iter_mut().for_each(|(_, errors)| scale(errors));
    }
    study
}

/// The study with another period at large angles, and other readings of it.
fn other_periods() -> Study {
    let mut study = STUDY.clone();
    let periods = &mut study.large_angle;
    periods.exact *= 1.1;
    periods.by_peak *= 1.2;
    periods.by_crossing *= 1.3;
    periods.small_angle *= 1.4;
    periods.modulus *= 0.9;
    study
}

/// Whether two measurements are the same, to the last bit.
fn same(a: &Claim, b: &Claim) -> bool {
    let value = |claim: &Claim| match claim.measured {
        Measured::Number(value, _) => Some(value.to_bits()),
        _ => None,
    };
    value(a) == value(b) && a.measured_text() == b.measured_text() && a.holds() == b.holds()
}

/// What each claim is measured on: experiment and method, or `rank` and method where only the order
/// of the methods counts.
static MEASURED_ON: LazyLock<BTreeMap<String, String>> = LazyLock::new(|| {
    let honest = &*LEDGER;
    let mut found: BTreeMap<String, BTreeSet<String>> =
        honest.claims().iter().map(|claim| (claim.id.clone(), BTreeSet::new())).collect();
    let mut note = |study: &Study, on: String, only_new: bool| {
        for (before, after) in honest.claims().iter().zip(Ledger::new(study).claims()) {
            let found = found.get_mut(&before.id).unwrap();
            let known = found.iter().any(|known| known.ends_with(on.split_once('.').unwrap().1));
            if !(same(before, after) || only_new && known) {
                found.insert(on.clone());
            }
        }
    };
    for method in PaperMethod::ALL {
        for experiment in EXPERIMENTS {
            note(&changed(experiment, method), format!("{experiment}.{}", method.id()), false);
        }
    }
    for method in PaperMethod::ALL {
        for (factor, tilt) in [(1e9, 1.0), (1e-9, 1.0), (1.0, 100.0), (1.0, 0.01)] {
            note(&ranked(method, factor, tilt), format!("rank.{}", method.id()), true);
        }
    }
    note(&other_periods(), "large_angle.periods".to_string(), false);
    let joined = |on: BTreeSet<String>| on.into_iter().collect::<Vec<_>>().join(" ");
    found.into_iter().map(|(id, on)| (id, joined(on))).collect()
});

/// The experiment of each table.
const TABLES: [(&str, &str); 5] = [
    ("T2.", "characteristics"),
    ("T4.", "convergence"),
    ("T5.", "long_run"),
    ("T6.", "small_angle"),
    ("T8.", "work"),
];

/// Catches: a cell measured on another method's run, or on another experiment's, with a verdict
/// that stays as it was.
#[test]
fn a_cell_is_measured_on_the_run_of_its_row() {
    let mut cells = 0;
    for (id, on) in MEASURED_ON.iter().filter(|(id, _)| id.starts_with('T')) {
        let method = PaperMethod::ALL.iter().find(|m| id.contains(&format!(".{}.", m.id())));
        let table = TABLES.iter().find(|(prefix, _)| id.starts_with(prefix));
        let expected = match (table, method) {
            // Times are not measured.
            (Some(_), Some(_)) if id.ends_with(".ms") => String::new(),
            (Some((_, experiment)), Some(method)) => format!("{experiment}.{}", method.id()),
            (None, None) if id.starts_with("T7.") => "large_angle.periods".to_string(),
            // The pendulum itself.
            _ if id.starts_with("T1.") || id.starts_with("T3.") => String::new(),
            other => panic!("{id}: {other:?}"),
        };
        assert_eq!(*on, expected, "{id}");
        cells += 1;
    }
    assert!(cells > 100, "{cells}");
}

/// What the sentences are measured on, where it is a run of the study: the methods are those that
/// the sentence names.
const SENTENCES: &[(&str, &str)] = &[
    ("A.dt2", "convergence.vv"),
    ("A.dts", "small_angle.fe small_angle.rk4 small_angle.se small_angle.vv"),
    ("A.optimal", "long_run.vv"),
    ("A.period", "large_angle.periods"),
    ("A.rk4_order", "characteristics.rk4"),
    ("A.tspan", "long_run.fe"),
    ("A.verlet_pct", "long_run.vv"),
    ("F4b", "long_run.fe long_run.rk4"),
    ("P1.orders", "convergence.fe convergence.rk4"),
    ("P1.qualitative", "long_run.fe"),
    ("P1.three_orders", "long_run.fe long_run.se long_run.vv"),
    ("P4.fe_nonsymp", "characteristics.fe"),
    ("P4.rk4_evals", "characteristics.rk4"),
    ("P4.se_change", "characteristics.fe characteristics.se"),
    ("P4.vv_evals", "characteristics.vv"),
    ("P5.metric_pct", "long_run.fe long_run.se long_run.vv"),
    ("P5.metric_rms", "small_angle.fe small_angle.rk4 small_angle.se small_angle.vv"),
    ("P6.1.bounded", "characteristics.se characteristics.vv convergence.se convergence.vv"),
    ("P6.1.exact", "convergence.vv"),
    ("P6.1.fe200", "convergence.fe"),
    ("P6.1.fe_order", "convergence.fe"),
    ("P6.1.highest", "convergence.rk4 convergence.vv rank.fe rank.se"),
    ("P6.1.machine", "rank.rk4"),
    ("P6.1.ratio", "convergence.vv"),
    ("P6.1.slope", "convergence.rk4"),
    ("P6.2.corresponds", "long_run.fe"),
    ("P6.2.escape", "long_run.fe"),
    ("P6.2.final", "long_run.fe"),
    ("P6.2.five_orders", "long_run.fe long_run.vv"),
    ("P6.2.mono", "long_run.fe"),
    ("P6.2.omit", "long_run.rk4 long_run.vv"),
    ("P6.2.se_pct", "long_run.se"),
    (
        "P6.2.stark",
        "characteristics.fe characteristics.rk4 characteristics.se \
         long_run.rk4 long_run.se rank.vv",
    ),
    ("P6.3.converge", "small_angle.rk4 small_angle.vv"),
    ("P6.5.T", "large_angle.periods"),
    ("P6.5.ratio", "large_angle.periods"),
    ("P6.5.within", "large_angle.periods"),
    ("P6.6.120", "work.fe work.rk4"),
    ("P7.1.fe1000", "long_run.fe"),
    ("P7.1.kin", "long_run.fe"),
    ("P7.1.surface", "long_run.se long_run.vv"),
    ("P7.2.accuracy", "convergence.rk4 convergence.vv"),
    ("P7.2.precise", "convergence.fe convergence.rk4"),
    ("P7.3.all", "small_angle.fe small_angle.se"),
    ("P7.4.se", "characteristics.se"),
    ("P7.5.primary", "characteristics.fe characteristics.se"),
    ("P8.equations", "large_angle.periods"),
    ("P8.order", "convergence.fe convergence.rk4"),
    ("P8.validates", "large_angle.periods"),
    ("X.bold", "rank.fe rank.rk4 small_angle.se small_angle.vv"),
    ("X.fe.falls", "long_run.fe"),
    ("X.fe.omega", "long_run.fe"),
    ("X.fe.over_vv", "long_run.fe long_run.vv"),
    ("X.rk4.advantage", "long_run.rk4 long_run.vv"),
    ("X.vv.ratio", "convergence.vv"),
];

/// Catches: a sentence measured on another method's run than the one it names, with a verdict that
/// stays as it was.
#[test]
fn a_sentence_is_measured_on_the_runs_that_it_names() {
    let prose = MEASURED_ON.iter().filter(|(id, on)| !id.starts_with('T') && !on.is_empty());
    let prose: Vec<(&str, &str)> = prose.map(|(id, on)| (id.as_str(), on.as_str())).collect();
    assert_eq!(prose, SENTENCES);
}
