//! The claims in the paper's sentences, measured: one file for each part of the paper.

mod background;
mod discussion;
mod results;
mod runs;

use std::sync::LazyLock;

use pendula::arithmetic::sine::{cos, sin};
use pendula::methods::{
    BlanesMoanSrkn6b, ForestRuth, ForwardEuler, Gauss4, PositionVerlet, Rk4, StormerVerlet,
    SymplecticEuler,
};
use pendula::metrics::order::slopes;
use pendula::metrics::{AngleError, CrossingPeriod, EnergyDrift};
use pendula::registry::InSteps;
use pendula::systems::System;
use pendula::{
    AnyMethod, Grid, Hamiltonian, LinearOscillator, Motion, Observer, Pendulum, Phase, exact,
};
use pendula_judge::properties::Ladder;
use pendula_judge::properties::area::{AREA_STEP, AREA_TOLERANCE, area_defect, cases};
use pendula_judge::zoo::euler::DriftKick;

use self::runs::*;

use super::stated::{CELLS, SENTENCES};
use super::{Claim, Measured, Tolerance, Verdict, row, stated};
use crate::digits::Digits::{self, Fixed, Scientific, Significant};
use crate::digits::rounds_to;
use crate::experiments::PaperMethod;
use crate::experiments::characteristics::EnergyBehaviour;
use crate::experiments::{
    STEPS, Study, convergence, energy_error, findings, grid, large_angle, level_curves, long_run,
    small_angle, work,
};

/// What is measured, and how it compares with what is stated.
type Finding = (Measured, Tolerance);

/// How a sentence is measured.
type Measure = fn(&Study) -> Finding;

/// A number that has to meet the printed digits.
const fn number(value: f64, format: Digits) -> Finding {
    (Measured::Number(value, format), Tolerance::PrintedDigits)
}

/// A number that decides by a comparison.
const fn shows(value: f64, format: Digits, holds: bool) -> Finding {
    (Measured::Number(value, format), Tolerance::Decided(holds))
}

/// Numbers that decide by a comparison.
fn show_all<const N: usize>(values: [f64; N], format: Digits, holds: bool) -> Finding {
    let between = if N == 2 { " and " } else { ", " };
    says(values.map(|value| format.print(value)).join(between), holds)
}

/// Words that decide by a comparison.
const fn says(text: String, holds: bool) -> Finding {
    (Measured::Text(text), Tolerance::Decided(holds))
}

/// The sentences that can be measured, and how.
const MEASURED: [&[(&str, Measure)]; 3] =
    [background::MEASURED, results::MEASURED, discussion::MEASURED];

/// All claims in sentences, measured.
pub(super) fn claims(study: &Study) -> impl Iterator<Item = Claim> {
    SENTENCES.iter().map(|sentence| {
        let known = MEASURED.into_iter().flatten().find(|(id, _)| *id == sentence.id);
        let nothing = (Measured::Nothing, Tolerance::PrintedDigits);
        let (measured, tolerance) = known.map_or(nothing, |(_, measure)| measure(study));
        Claim {
            id: sentence.id.clone(),
            place: &sentence.place,
            gist: sentence.gist.clone(),
            definition: &sentence.definition,
            stated: Some(&sentence.stated),
            measured,
            tolerance,
            verdict: sentence.verdict,
            because: &sentence.because,
        }
    })
}

/// Whether a value is no further from another than this.
fn is_near(value: f64, other: f64, distance: f64) -> bool {
    (value - other).abs() <= distance
}

/// Whether a value rounds to what the paper prints in the cell of this id.
fn prints_as(cell: &str, value: f64) -> bool {
    let cell = stated::cell(cell).expect("a cell of the paper");
    rounds_to(value, &cell.stated) == Some(true)
}

/// The number that the paper prints in the cell of this id.
fn printed(cell: &str) -> f64 {
    let cell = stated::cell(cell).expect("a cell of the paper");
    cell.stated.parse().expect("a number")
}

/// The id of a cell of Table 6.
fn cell_of_table_6(row: &small_angle::Row, step: usize) -> String {
    let method = PaperMethod::of(row.method).map_or("", PaperMethod::id);
    format!("T6.{method}.{}", STEPS[step])
}

/// Whether a method meets its cell of Table 6 at this one of the [`STEPS`].
fn meets_table_6(row: &small_angle::Row, step: usize) -> bool {
    prints_as(&cell_of_table_6(row, step), row.errors[step].formula)
}

/// A size of which rounding leaves no digit: that it is below a bound, or if not, how large it is.
fn below(bound: f64, size: f64) -> String {
    if size < bound {
        format!("below {}", Scientific(1).print(bound))
    } else {
        Scientific(1).print(size)
    }
}

/// Whether slopes from `low` to `high` confirm this order, each to ± 0.15.
fn confirms((low, high): (f64, f64), order: f64) -> bool {
    [low, high].into_iter().all(|slope| is_near(slope, order, 0.15))
}

/// Whether an oscillation has not grown, to a thousandth: a longer run samples its maximum more
/// closely.
fn has_not_grown(later: f64, earlier: f64) -> bool {
    later <= 1.001 * earlier
}

fn order_range(study: &Study, id: PaperMethod) -> (f64, f64) {
    let row = study.convergence.iter().find(|row| PaperMethod::of(row.method) == Some(id));
    let drift = row.map_or([f64::NAN; 5], |row| row.drift);
    let slopes = slopes(&STEPS, &drift, 1e-11).flatten();
    slopes.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)))
}

fn orders_confirmed(study: &Study) -> Finding {
    let theory = [
        (PaperMethod::ForwardEuler, 1.0),
        (PaperMethod::SymplecticEuler, 1.0),
        (PaperMethod::StormerVerlet, 2.0),
        (PaperMethod::Rk4, 4.0),
    ];
    let (rk4, fe) =
        (order_range(study, PaperMethod::Rk4), order_range(study, PaperMethod::ForwardEuler));
    says(
        format!(
            "slopes of the energy error: RK4 up to {:.2}, forward Euler {:.2} to {:.2}",
            rk4.1, fe.0, fe.1
        ),
        theory.into_iter().all(|(id, order)| confirms(order_range(study, id), order)),
    )
}

fn monotonic(study: &Study) -> Finding {
    let falls = row!(study.long_run, ForwardEuler).falls;
    let first = findings::first_fall(
        &InSteps(ForwardEuler),
        long_run::THETA_0,
        long_run::STEP,
        long_run::DURATION,
    );
    let since = first.map_or_else(String::new, |t| format!(", the first at {t:.2} s"));
    says(format!("{falls} of 100 000 steps lower the energy{since}"), falls == 0)
}

/// Whether an orbit of `method` from the chaotic layer crosses u = ω Δt = 2π, which it can only
/// where no invariant curve is left between 0 and 2π.
fn escapes(method: &dyn AnyMethod, k: f64) -> bool {
    findings::chaotic_speed(method, k, 200_000) > core::f64::consts::TAU
}

/// Of symplectic Euler and of Störmer–Verlet: whether the energy error has not grown at 0.01 s, and
/// whether no orbit escapes at K = 0.9 and at 1.5.
static BOUNDED: LazyLock<[[bool; 3]; 2]> = LazyLock::new(|| {
    let methods: [&dyn AnyMethod; 2] = [&InSteps(SymplecticEuler), &InSteps(StormerVerlet)];
    methods.map(|method| {
        let drift = |steps| findings::energy_drift(method, 1.0, 0.01, steps);
        let small = has_not_grown(drift(1_000_000), drift(100_000));
        [small, !escapes(method, 0.9), !escapes(method, 1.5)]
    })
});

/// What [`BOUNDED`] says in such words. Whoever says that an energy error is bounded is judged by
/// it alike: what is asked for are short steps, as the paper's are.
fn is_bounded(in_words: impl Fn(usize) -> &'static str, methods: &[[bool; 3]]) -> Finding {
    let [small, below, beyond] = [0, 1, 2].map(in_words);
    says(
        format!("at 0.01 s {small} over 10⁶ steps; at K = 0.9 {below}; at K = 1.5 {beyond}"),
        methods.iter().all(|[small, below, _]| *small && *below),
    )
}

fn bounded(_: &Study) -> Finding {
    let [euler, verlet] = *BOUNDED;
    let words = |at: usize| match (euler[at], verlet[at]) {
        (true, true) => "both bounded",
        (false, false) => "both unbounded",
        (true, false) => "symplectic Euler bounded",
        (false, true) => "Störmer–Verlet bounded",
    };
    is_bounded(words, &[euler, verlet])
}

/// Of one of the two alone.
fn alone_bounded(method: [bool; 3]) -> Finding {
    is_bounded(|at| if method[at] { "bounded" } else { "unbounded" }, &[method])
}

/// The numbers of Tables 4 to 8 that are no property of a machine, and how many of them are met, as
/// the cells are judged.
fn numbers_met() -> Finding {
    let cells = || {
        let cells = CELLS.iter().filter(|cell| !cell.id.starts_with("T2."));
        cells.filter(|cell| cell.verdict != Verdict::DependsOnPlatform)
    };
    let met = cells().filter(|cell| cell.verdict.demands() == Some(true)).count();
    says(format!("{met} of {}", cells().count()), met == cells().count())
}

/// Störmer–Verlet's RMS angle error over RK4's for so many evaluations each, from 1 rad over 10 s.
fn verlet_over_rk4(evaluations: u64) -> f64 {
    work::error(&InSteps(StormerVerlet), 1.0, evaluations)
        / work::error(&InSteps(Rk4), 1.0, evaluations)
}

fn largest_formula_error(theta_0: f64, step: f64) -> f64 {
    findings::normalised_formula_error(&InSteps(Rk4), theta_0, step).0
}

#[cfg(test)]
mod tests {
    use rstest::rstest;

    use super::{MEASURED, SENTENCES, below, confirms, has_not_grown};

    /// Catches: a measurement under an id that no sentence has, and two under one.
    #[test]
    fn every_measurement_is_that_of_a_sentence() {
        let mut ids: Vec<&str> = MEASURED.into_iter().flatten().map(|(id, _)| *id).collect();
        for id in &ids {
            assert!(SENTENCES.iter().any(|sentence| sentence.id == *id), "{id}");
        }
        let count = ids.len();
        ids.sort_unstable();
        ids.dedup();
        assert_eq!(ids.len(), count, "an id stands twice");
    }

    /// Catches: an order confirmed by one of its slopes, or by none.
    #[rstest]
    #[case((1.86, 2.14), true)]
    #[case((1.84, 2.0), false)]
    #[case((2.0, 2.16), false)]
    #[case((-2.0, 2.0), false)]
    #[case::no_slopes((f64::INFINITY, f64::NEG_INFINITY), false)]
    fn an_order_is_confirmed_by_every_slope(#[case] range: (f64, f64), #[case] confirmed: bool) {
        assert_eq!(confirms(range, 2.0), confirmed);
    }

    /// Catches: a bound that is printed though it is not kept, and a size for a bound.
    #[test]
    fn a_bound_is_printed_where_it_is_kept() {
        assert_eq!(below(1e-10, 3e-12), "below 1 × 10⁻¹⁰");
        assert_eq!(below(1e-10, 3e-9), "3 × 10⁻⁹");
        assert_eq!(below(1e-10, f64::NAN), "NaN");
    }

    /// Catches: a slow growth that goes undetected.
    #[test]
    fn a_growth_shows_beyond_a_thousandth() {
        assert!(has_not_grown(3.0, 3.0) && has_not_grown(3.002, 3.0) && has_not_grown(2.0, 3.0));
        assert!(!has_not_grown(3.004, 3.0), "by more than a thousandth");
    }
}
