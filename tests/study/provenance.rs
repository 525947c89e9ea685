//! Where each claim is measured: on the runs of which experiment, and of which method.
//!
//! The rows of one method in one experiment are changed, and what moves in the ledger is what was
//! measured on them.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

use pendula::{Grid, Hamiltonian, Motion, Pendulum, Phase, exact, method_named};
use pendula_study::claims::{Claim, Ledger, Measured};
use pendula_study::experiments::characteristics::EnergyBehaviour;
use pendula_study::experiments::{PaperMethod, Study, small_angle};
use rstest::rstest;

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

// -------------------------------------------------------------------------------------------------
// Claims with runs of their own
// -------------------------------------------------------------------------------------------------

/// All samples of `steps` steps of the method of this name.
fn run(method: &str, start: Phase, step: f64, steps: u64) -> Vec<(f64, Phase)> {
    let method = method_named(method).unwrap();
    let mut samples = Vec::new();
    let mut keep = |_: u64, t: f64, z: Phase| samples.push((t, z));
    method.run(&Pendulum::PAPER, start, &Grid::new(step, steps).unwrap(), &mut keep);
    samples
}

/// The largest energy error from 1 rad.
fn drift(method: &str, step: f64, steps: u64) -> f64 {
    let energy = |z: Phase| Pendulum::PAPER.energy(z);
    let samples = run(method, Phase::at_rest(1.0), step, steps);
    samples.iter().map(|(_, z)| (energy(*z) - energy(samples[0].1)).abs()).fold(0.0, f64::max)
}

fn root_mean_square(errors: &[f64]) -> f64 {
    (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt()
}

/// The angle errors against the exact solution, from 1 rad over 10 s.
fn against_the_truth(method: &str, steps: u64) -> f64 {
    let start = Phase::at_rest(1.0);
    let motion = Motion::new(&Pendulum::PAPER, start).unwrap();
    let samples = run(method, start, 10.0 / steps as f64, steps);
    let errors: Vec<f64> = samples.iter().map(|(t, z)| z.theta - motion.at(*t).theta).collect();
    root_mean_square(&errors)
}

/// The angle errors against the small-angle formula over θ₀, from 1e-4 rad over 10 s.
fn against_the_formula(method: &str) -> Vec<f64> {
    let samples = run(method, Phase::at_rest(1e-4), 0.01, 1000);
    let frequency = 9.81_f64.sqrt();
    samples.iter().map(|(t, z)| (z.theta - 1e-4 * (frequency * t).cos()) / 1e-4).collect()
}

fn one_step_error(method: &str, step: f64) -> f64 {
    error_of_a_step(method, (1.0, 1.0), step)
}

fn error_of_a_step(method: &str, (theta, omega): (f64, f64), step: f64) -> f64 {
    let start = Phase { theta, omega };
    let truth = Motion::new(&Pendulum::PAPER, start).unwrap().at(step);
    let end = run(method, start, step, 1)[1].1;
    (end.theta - truth.theta).abs().max((end.omega - truth.omega).abs())
}

/// RK4's error of a step over the smallest of the paper's other methods, at its largest.
fn rk4_over_the_next() -> f64 {
    let mut largest = 0.0_f64;
    for z in [(0.05, 0.1), (1.0, 1.0), (2.0, -1.0), (3.0, 2.0)] {
        for step in [0.1, 0.01, 0.001] {
            let [rk4, others @ ..] = ["rk4", "forward-euler", "symplectic-euler", "stormer-verlet"]
                .map(|method| error_of_a_step(method, z, step));
            largest = largest.max(rk4 / others.into_iter().fold(f64::INFINITY, f64::min));
        }
    }
    largest
}

/// How far a release misses its start after one exact period, in angle or velocity.
fn missed(method: &str, theta_0: f64) -> f64 {
    let period = exact::period(&Pendulum::PAPER, theta_0).unwrap();
    let steps = (period / 0.01).round();
    let samples = run(method, Phase::at_rest(theta_0), period / steps, steps as u64);
    let end = samples.last().unwrap().1;
    (end.theta - theta_0).abs().max(end.omega.abs())
}

fn first_fall(method: &str) -> f64 {
    let samples = run(method, Phase::at_rest(0.05), 0.01, 100_000);
    let energy = |(_, z): &(f64, Phase)| Pendulum::PAPER.energy(*z);
    samples.windows(2).find(|pair| energy(&pair[1]) < energy(&pair[0])).unwrap()[1].0
}

fn over_swings(steps: f64) -> f64 {
    let step = exact::period(&Pendulum::PAPER, 1.0).unwrap() / steps;
    let drift = |swings: f64| drift("blanes-moan-6", step, (swings * steps) as u64);
    drift(4000.0) / drift(20.0)
}

fn worst(errors: &[f64]) -> f64 {
    errors.iter().fold(0.0, |worst: f64, e| worst.max(e.abs()))
}

/// What a sentence measures on runs of its own, measured again on those of the method that it
/// names. The same numbers are added in another order, and the cosine is the platform's: the errors
/// are known to ten digits, that of the formula to eight.
///
/// Catches: a sentence measured on another method, step or release than it says.
#[rstest]
#[case("P4.rk4_lte", || (one_step_error("rk4", 0.02) / one_step_error("rk4", 0.01)).log2() - 1.0)]
#[case("P6.3.norm", || worst(&against_the_formula("rk4")))]
#[case("P6.3.below", || worst(&against_the_formula("rk4")))]
#[case("P6.4.closed", || {
    [0.5, 1.5, 2.5].map(|theta_0| missed("rk4", theta_0)).into_iter().fold(0.0, f64::max)
})]
#[case("P6.6.best", || against_the_truth("stormer-verlet", 400) / against_the_truth("rk4", 100))]
#[case("P6.6.high", || against_the_truth("stormer-verlet", 4000) / against_the_truth("rk4", 1000))]
#[case("P7.4.rk4", rk4_over_the_next)]
#[case("P7.4.caveat", || drift("rk4", 0.01, 100_000) / drift("rk4", 0.01, 10_000))]
#[case("X.dop853.loss", || drift("dop853", 0.2, 2500))]
#[case("X.dop853.growth", || drift("dop853", 0.2, 10_000) / drift("dop853", 0.2, 2500))]
#[case("X.fe.first_fall", || first_fall("forward-euler"))]
#[case("X.rk4.norm_rms", || root_mean_square(&against_the_formula("rk4")))]
#[case("X.resonance.at", || over_swings(8.0))]
#[case("X.resonance.beside", || over_swings(7.8))]
fn a_sentence_is_measured_as_it_says(#[case] id: &str, #[case] again: fn() -> f64) {
    let Measured::Number(measured, _) = LEDGER.get(id).unwrap().measured else {
        panic!("{id} is no number")
    };
    approx::assert_relative_eq!(measured, again(), max_relative = 1e-8);
}
