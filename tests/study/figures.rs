//! The figures show what they say: the values of those series that the library alone can compute
//! again, by the label and the heading of their chart, and the map for choosing. That no figure
//! changes unseen, `snapshots` tests, and that a chart is drawn as it says, `charts`.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;
use std::sync::{LazyLock, OnceLock};

use approx::{assert_relative_eq, relative_eq};
use pendula::adaptive::SymmetricSteps;
use pendula::methods::StormerVerlet;
use pendula::{
    AnyMethod, Grid, Hamiltonian, METHODS, Motion, Pendulum, Phase, System, exact, integrate_with,
    method_named,
};
use pendula_dynamics::kepler::{Kepler, PlanePhase};
use pendula_study::charts::{Axis, Chart, Figure, Style};
use pendula_study::experiments::adaptive_steps::{Control, run as run_of};
use pendula_study::experiments::{choosing, in_paper, level_curves};
use pendula_study::report::figures::figures;
use rstest::rstest;

use crate::STUDY;

/// A figure of the book, drawn once for all tests.
pub fn drawn(name: &str) -> &'static Figure {
    static DRAWN: LazyLock<Vec<OnceLock<Figure>>> =
        LazyLock::new(|| figures().map(|_| OnceLock::new()).collect());
    let (index, drawing) =
        figures().enumerate().find(|(_, figure)| figure.name == name).expect("a figure");
    DRAWN[index].get_or_init(|| drawing.figure(&STUDY))
}

/// The values that are on the chart, sorted, each once.
fn on(chart: &Chart, values: impl Iterator<Item = Point>) -> Vec<Point> {
    let is_on = |axis: &Axis, value: f64| {
        axis.range.is_none_or(|(low, high)| (low.min(high)..=low.max(high)).contains(&value))
    };
    let mut all: Vec<Point> =
        values.filter(|(x, y)| is_on(&chart.x, *x) && is_on(&chart.y, *y)).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    all.dedup();
    all
}

type Point = (f64, f64);

/// A series: words of the heading of its chart or of its y axis, its label, and its values.
struct Expected {
    chart: String,
    label: String,
    values: Vec<Point>,
}

fn expect(
    chart: impl Into<String>,
    label: impl Into<String>,
    values: impl IntoIterator<Item = Point>,
) -> Expected {
    let (chart, label) = (chart.into(), label.into());
    Expected { chart, label, values: values.into_iter().collect() }
}

type Method = &'static dyn AnyMethod;

fn of(name: &str) -> Method {
    method_named(name).expect("a method of the library")
}

fn title(method: Method) -> &'static str {
    method.info().title
}

/// Every sample of a run from rest: time and state.
fn run(method: Method, theta_0: f64, step: f64, duration: f64) -> Vec<(f64, Phase)> {
    let grid = Grid::with_duration(step, duration).unwrap();
    let mut samples = Vec::new();
    let mut keep = |_: u64, t: f64, z: Phase| samples.push((t, z));
    method.run(&Pendulum::PAPER, Phase::at_rest(theta_0), &grid, &mut keep);
    samples
}

/// H − H₀ along a run.
fn energy_error(run: &[(f64, Phase)]) -> impl Iterator<Item = Point> {
    let initial = Pendulum::PAPER.energy(run[0].1);
    run.iter().map(move |(t, z)| (*t, Pendulum::PAPER.energy(*z) - initial))
}

fn figure_3() -> Vec<Expected> {
    let mut expected = Vec::new();
    for method in METHODS.iter().copied().filter(|method| in_paper(*method)) {
        let samples = run(method, 1.0, 0.01, 1000.0);
        let error: Vec<Point> = energy_error(&samples).collect();
        let heading = format!("{}, H − H_{{0}} (J)", title(method));
        expected.push(expect(heading, title(method), error.clone()));
        let mut largest = 0.0_f64;
        let so_far = error.iter().enumerate().filter_map(|(n, (t, error))| {
            largest = largest.max(error.abs());
            (n > 0 && n % 100 == 0).then_some((*t, largest))
        });
        let so_far: Vec<Point> = so_far.collect();
        let row = STUDY.long_run.iter().find(|row| title(row.method) == title(method)).unwrap();
        assert_eq!((so_far[99].1, so_far[999].1), (row.early_drift, row.drift));
        expected.push(expect("so far (J)", title(method), so_far));
    }
    expected
}

fn figure_4() -> Vec<Expected> {
    let samples = run(of("forward-euler"), 0.05, 0.01, 10.0);
    let frequency = 9.81_f64.sqrt();
    let label = "Forward Euler";
    vec![
        expect(
            "θ (rad)",
            "θ_{0} cos ω_{0}t",
            samples.iter().map(|(t, _)| (*t, 0.05 * (frequency * t).cos())),
        ),
        expect("θ (rad)", label, samples.iter().map(|(t, z)| (*t, z.theta))),
        expect("H − H", label, energy_error(&samples)),
    ]
}

fn figure_5() -> Vec<Expected> {
    let orbits = level_curves::PORTRAIT.into_iter().map(|theta_0| {
        let period = exact::period(&Pendulum::PAPER, theta_0).unwrap();
        // Once round, and the step that closes it.
        let orbit = run(of("rk4"), theta_0, 0.01, 0.01 * (period / 0.01).ceil());
        let label = "swings, computed step by step";
        expect("ω (rad/s)", label, orbit.into_iter().map(|(_, z)| (z.theta, z.omega)))
    });
    orbits.collect()
}

fn figure_6() -> Vec<Expected> {
    let samples = run(of("rk4"), 3.0, 0.001, 15.0);
    vec![expect("θ (rad)", "RK4", samples.iter().step_by(10).map(|(t, z)| (*t, z.theta)))]
}

fn two_eulers() -> Vec<Expected> {
    let mut expected = Vec::new();
    for name in ["forward-euler", "symplectic-euler"] {
        let samples = run(of(name), 1.0, 0.01, 1000.0);
        for (heading, from) in [("the first second", 0.0), ("the thousandth second", 999.0)] {
            let second = samples.iter().filter(|(t, _)| (from - 0.005..from + 1.005).contains(t));
            // The curve of each turn goes a little over the top.
            let turns = second.flat_map(|(t, z)| {
                let nearest = (z.theta / (2.0 * PI)).round();
                [-1.0, 0.0, 1.0].map(|turn| (*t, z.theta - 2.0 * PI * (nearest + turn)))
            });
            expected.push(expect(heading, title(of(name)), turns));
        }
    }
    expected
}

/// What each method needs for a hundred swings to a thousandth of a radian, the cheapest first:
/// a cell of the map.
fn compared() -> Vec<(&'static str, u64)> {
    let mut cells = choosing::map(1.0).iter().filter(|cell| cell.periods == 100);
    let cell = cells.find(|cell| (cell.allowed / 1e-3 - 1.0).abs() < 1e-9).expect("a cell");
    let paper = ["forward-euler", "symplectic-euler", "rk4", "stormer-verlet"];
    let higher = ["forest-ruth", "gauss-6", "blanes-moan-6", "processed-6"];
    let mut rows = [paper, higher].concat();
    let evaluations = |method: &str| {
        let mut ranking = cell.ranking.iter();
        let advice = ranking.find(|advice| advice.method.info().name == method);
        advice.expect("an advice").evaluations
    };
    rows.sort_by_key(|method| evaluations(method));
    rows.into_iter().map(|method| (method, evaluations(method))).collect()
}

fn cost() -> Vec<Expected> {
    let rows = compared().into_iter().zip(0..);
    let place = |((_, evaluations), row)| (evaluations as f64, f64::from(row) + 0.5);
    vec![expect("", "", rows.map(place))]
}

/// One step from where all the stencils begin: its ends.
fn stencil(name: &'static str, step: f64) -> Vec<Expected> {
    let (pendulum, start) = (Pendulum::PAPER, Phase { theta: -1.2, omega: 1.0 });
    let mut ends = Vec::new();
    let mut keep = |_: u64, _: f64, z: Phase| ends.push((z.theta, z.omega));
    of(name).run(&pendulum, start, &Grid::new(step, 1).unwrap(), &mut keep);
    let truth = Motion::new(&pendulum, start).unwrap().at(step);
    vec![
        expect("ω (rad/s)", title(of(name)), ends),
        expect("ω (rad/s)", format!("true motion after {step} s"), [(truth.theta, truth.omega)]),
    ]
}

/// RK4's step in two charts: the places of the slopes and the slopes there, and the sum of their
/// shares, which ends where the step does.
fn stencil_rk4() -> Vec<Expected> {
    const STEP: f64 = 0.55;
    let (pendulum, start) = (Pendulum::PAPER, Phase { theta: -1.2, omega: 1.0 });
    let rate = |z: Phase| pendulum.rate(0.0, z);
    let k1 = rate(start);
    let k2 = rate(start + k1 * (STEP / 2.0));
    let k3 = rate(start + k2 * (STEP / 2.0));
    let places = [k1 * (STEP / 2.0), k2 * (STEP / 2.0), k3 * STEP].map(|by| start + by);
    let all = [start, places[0], places[1], places[2]];
    let point = |z: Phase| (z.theta, z.omega);
    let slopes = all.iter().flat_map(|&z| [z, z + rate(z) * (STEP / 4.0)]).map(point);
    let shares = [k1 * (STEP / 6.0), k2 * (STEP / 3.0), k3 * (STEP / 3.0)];
    let corners = shares.iter().scan(start, |at, by| {
        *at = *at + *by;
        Some(*at)
    });
    let ends = stencil("rk4", STEP);
    let corners: Vec<Point> = corners.map(point).chain(ends[0].values.clone()).collect();
    let (first, second) = ("Where each slope is taken", "How they are averaged");
    let ends = ends.into_iter().map(|it| Expected { chart: second.into(), ..it });
    let mut expected = vec![
        expect(first, "RK4", [point(start)]),
        expect(first, "followed from the start", all.map(point)),
        expect(first, "a slope", slopes),
        expect(second, "", corners),
    ];
    expected.extend(ends);
    expected
}

fn swings() -> Vec<Expected> {
    let mut expected = Vec::new();
    for theta_0 in [0.5, 1.5, 2.5, 3.1] {
        let label = format!("{theta_0} rad");
        let motion = Motion::new(&Pendulum::PAPER, Phase::at_rest(theta_0)).unwrap();
        let curve = (0..=800).map(|k| 0.01 * f64::from(k)).map(|t| (t, motion.at(t).theta));
        let period = motion.period().unwrap();
        let ratio = period / (2.0 * PI / 9.81_f64.sqrt());
        expected.push(expect("angle θ (rad)", &label, curve));
        expected.push(expect("angle θ (rad)", &label, [(period, theta_0)]));
        expected.push(expect("period T/T", &label, [(theta_0, ratio)]));
    }
    expected
}

/// The largest energy error of a planet so far, revolution by revolution, with the steps that the
/// library takes by itself: all equal, and symmetric ones.
fn adaptive_steps() -> Vec<Expected> {
    let centre = Kepler::new(2.5).unwrap();
    let start = PlanePhase { x: 1.0 - 0.8, y: 0.0, vx: 0.0, vy: (2.5_f64 * 1.8 / 0.2).sqrt() };
    let year = 2.0 * PI / 2.5_f64.sqrt();
    let initial = centre.energy(start);
    let so_far = |samples: &[(f64, PlanePhase)]| {
        let mut largest = 0.0_f64;
        let mut samples = samples.iter().peekable();
        let years = (1..=1000_u32).map(|n| {
            while let Some((_, z)) = samples.next_if(|(t, _)| *t <= f64::from(n) * year) {
                largest = largest.max((centre.energy(*z) / initial - 1.0).abs());
            }
            (f64::from(n), largest)
        });
        years.collect::<Vec<Point>>()
    };
    let rate = |z: PlanePhase| -1.5 * (z.x * z.vx + z.y * z.vy) / (z.x * z.x + z.y * z.y);
    let symmetric = SymmetricSteps::new(&centre, start, 0.002, rate).unwrap();
    let symmetric: Vec<_> = symmetric
        .map(|sample| sample.map(|it| (it.t, it.z)).unwrap())
        .take_while(|(t, _)| *t <= 1000.0 * year)
        .collect();
    let count = symmetric.len() as u64;
    let grid = Grid::new(1000.0 * year / count as f64, count).unwrap();
    let mut equal = Vec::new();
    let mut keep = |_: u64, t: f64, z: PlanePhase| equal.push((t, z));
    integrate_with(&centre, &StormerVerlet, start, &grid, &mut keep);
    vec![
        expect("energy error", "fixed steps", so_far(&equal)),
        expect("energy error", "symmetric control", so_far(&symmetric)),
    ]
}

/// Compares the series of a chart that have this label with all that they should show: where it is
/// empty, those without a label that are no guides. What is computed in another order may differ by
/// a few roundings, of numbers as large as the largest.
fn compare(what: &str, chart: &Chart, label: &str, expected: &[&Expected]) {
    let own = chart.series.iter().filter(|it| it.label == label && !it.style.is_guide());
    let drawn = on(chart, own.flat_map(|series| series.points.iter().copied()));
    let expected = on(chart, expected.iter().flat_map(|series| series.values.iter().copied()));
    assert!(!expected.is_empty(), "{what}: nothing to show");
    assert_eq!(drawn.len(), expected.len(), "{what}: as many values");
    let largest =
        |pick: fn(&Point) -> f64| expected.iter().map(pick).fold(0.0, |a: f64, b| a.max(b.abs()));
    let (x, y) = (1e-15 * largest(|p| p.0), 1e-15 * largest(|p| p.1));
    for (drawn, expected) in drawn.iter().zip(&expected) {
        let same = relative_eq!(drawn.0, expected.0, max_relative = 1e-9, epsilon = x)
            && relative_eq!(drawn.1, expected.1, max_relative = 1e-9, epsilon = y);
        assert!(same, "{what}: {drawn:?} for {expected:?}");
    }
}

/// Catches: labels or charts exchanged, half of the data, the beginning of a run where its end
/// should be, the wrong column of a table.
#[rstest]
#[case("figure_3", figure_3)]
#[case("figure_4", figure_4)]
#[case("figure_5", figure_5)]
#[case("figure_6", figure_6)]
#[case("two_eulers", two_eulers)]
#[case("cost", cost)]
#[case("stencil_forward_euler", || stencil("forward-euler", 0.35))]
#[case("stencil_symplectic_euler", || stencil("symplectic-euler", 0.35))]
#[case("stencil_stormer_verlet", || stencil("stormer-verlet", 0.35))]
#[case("stencil_rk4", stencil_rk4)]
#[case("swings", swings)]
#[case("adaptive_steps", adaptive_steps)]
fn a_figure_shows_what_the_library_computes(
    #[case] name: &str,
    #[case] expected: fn() -> Vec<Expected>,
) {
    let (figure, expected) = (drawn(name), expected());
    let mut together: BTreeMap<(usize, &str), Vec<&Expected>> = BTreeMap::new();
    for series in &expected {
        let says = |chart: &Chart| format!("{} {}", chart.heading, chart.y.label);
        let charts = figure.panels.iter().enumerate();
        let charts: Vec<usize> = charts
            .filter(|(_, chart)| says(chart).contains(&series.chart))
            .map(|(number, _)| number)
            .collect();
        assert!(!charts.is_empty(), "{name}: no chart is headed {:?}", series.chart);
        for chart in charts {
            together.entry((chart, series.label.as_str())).or_default().push(series);
        }
    }
    for ((chart, label), all) in together {
        compare(&format!("{name}, {chart}, {label:?}"), &figure.panels[chart], label, &all);
    }
}

/// The figure shows what the chapter says of `symmetric_steps`, in about as many steps each.
///
/// Catches: a naive control that does not drift, or that has fewer steps to do it in; the labels of
/// two of the runs exchanged.
#[test]
fn only_the_naive_control_drifts() {
    let chart = &drawn("adaptive_steps").panels[0];
    let so_far = |label: &str| {
        let series = chart.series.iter().find(|it| it.label == label).expect("a run");
        assert_eq!(series.points.len(), 1000);
        [100, 1000].map(|n| series.points[n - 1].1)
    };
    let [equal, naive, symmetric] =
        ["fixed steps", "naive control", "symmetric control"].map(so_far);
    assert!(naive[1] > 5.0 * naive[0], "{naive:?}");
    assert!(symmetric[1] < 1.0001 * symmetric[0] && equal[1] < 1.01 * equal[0], "{equal:?}");
    assert!(equal[1] > 40.0 * symmetric[1] && naive[1] > 10.0 * symmetric[1]);
    let steps = |control| run_of(control).steps;
    let (naive, symmetric) = (steps(Control::Naive), steps(Control::Symmetric));
    assert!(naive > symmetric * 9 / 10 && naive < symmetric * 11 / 10, "{naive}, {symmetric}");
    assert!(steps(Control::Equal).abs_diff(symmetric) <= 1);
}

/// Catches: a name at the row of another method.
#[test]
fn the_rows_of_costs_have_their_names() {
    let ticks = drawn("cost").panels[0].y.ticks.as_ref().expect("a tick a row");
    let names: Vec<&str> = compared().into_iter().map(|(method, _)| title(of(method))).collect();
    assert_eq!(ticks.iter().filter_map(|tick| tick.label.as_deref()).collect::<Vec<_>>(), names);
}

/// The two curves of the periods have no entry in the legend but notes beside them.
///
/// Catches: another coefficient than the note says, 1/12 for 1/16; the exact curve dashed and the
/// correction not.
#[test]
fn the_dashed_curve_of_the_periods_is_the_first_correction() {
    let periods = &drawn("swings").panels[1].series;
    let curve = |style: Style| {
        let series = periods.iter().find(|series| series.style == style).expect("a curve");
        series.points.iter().filter(|(theta_0, _)| (0.1..3.0).contains(theta_0))
    };
    let small = 2.0 * PI / 9.81_f64.sqrt();
    for (theta_0, ratio) in curve(Style::REFERENCE) {
        let expected = exact::period(&Pendulum::PAPER, *theta_0).unwrap() / small;
        assert_relative_eq!(*ratio, expected, max_relative = 1e-12);
    }
    for (theta_0, ratio) in curve(Style::REFERENCE.dashed()) {
        assert_relative_eq!(*ratio, 1.0 + theta_0 * theta_0 / 16.0, max_relative = 1e-12);
    }
}

/// Who will do in a cell of the map, the best first: without half as many evaluations again.
fn able(cell: &choosing::Cell) -> impl Iterator<Item = &choosing::Advice> {
    cell.ranking.iter().filter(|it| 2 * it.evaluations <= 3 * cell.ranking[0].evaluations)
}

/// Catches: rows exchanged for columns, a cell in the colour of a method that will not do, or not
/// of the one that will do in most; a name more than needed; the steps of another method; the
/// second best told of where the best is another; a cell that is missing or drawn twice; two names
/// that look alike; an extrapolated cell that does not say so, or a measured one that does; the map
/// of another swing.
#[rstest]
#[case::small("decision_small", 0.3)]
#[case::of_the_chapter("decision", 1.0)]
#[case::large("decision_large", 2.0)]
#[case::nearly_upright("decision_near_top", 3.0)]
fn the_decision_map_shows_in_each_cell_what_will_do(#[case] name: &str, #[case] theta_0: f64) {
    let computed = choosing::map(theta_0);
    let figure = drawn(name);
    let map = figure.panels[0].map.as_ref().expect("a map");
    let rows = map.y.len() - 1;
    assert_eq!(map.cells.len(), computed.len());
    let count = |name: &str| map.cells.iter().filter(|it| map.names[it.name].title == name).count();
    let shown: BTreeMap<&str, usize> =
        map.names.iter().map(|name| (name.title.as_str(), count(&name.title))).collect();
    for (i, (cell, drawn)) in computed.iter().zip(&map.cells).enumerate() {
        let (column, row) = (i / rows, i % rows);
        assert!((map.x[column]..map.x[column + 1]).contains(&(cell.periods as f64)), "{cell:?}");
        assert!((map.y[row + 1]..map.y[row]).contains(&cell.allowed), "{cell:?}");
        let (name, [first, second]) = (&map.names[drawn.name].title, &drawn.says);
        assert!(second.starts_with(&format!("{} period", cell.periods)), "{second}");
        if cell.ranking.is_empty() {
            assert!(name == "lost in rounding" && first.contains("rounding"), "{name}: {first}");
            assert_eq!(drawn.number, None);
            continue;
        }
        let named = able(cell).filter(|advice| shown.contains_key(title(advice.method)));
        let taken = named.max_by_key(|advice| shown[title(advice.method)]).expect("one will do");
        let (steps, evaluations) = (taken.steps, taken.evaluations);
        assert_eq!(
            (name.as_str(), drawn.number),
            (title(taken.method), Some(steps.round() as u64)),
            "{cell:?}"
        );
        let how = if taken.extrapolated { " by the law" } else { "" };
        assert_eq!(
            *first,
            format!("{name}, {steps} steps a period, {evaluations} evaluations{how}")
        );
        let others = || cell.ranking.iter().filter(|advice| title(advice.method) != name);
        if let Some(other) = others().min_by_key(|advice| advice.evaluations) {
            let hundredths = (other.evaluations as f64 / evaluations as f64 - 1.0) * 100.0;
            let word = if other.evaluations < evaluations { "less" } else { "more" };
            let size = hundredths.abs();
            let says = format!("; {} needs {size:.0} % {word}", title(other.method));
            assert!(second.ends_with(&says), "{second}, not {says}");
        }
    }
    let will_do = |method: &Method| {
        let does = |it: &choosing::Advice| title(it.method) == title(*method);
        computed.iter().filter(|cell| able(cell).any(does)).count()
    };
    let most = METHODS.iter().map(will_do).max();
    assert_eq!(shown.values().copied().max(), most, "{shown:?}");
    assert!(shown.values().all(|cells| *cells > 0), "{shown:?}");
    let looks: BTreeSet<String> = map.names.iter().map(|name| format!("{:?}", name.fill)).collect();
    assert_eq!(looks.len(), map.names.len(), "each looks like itself alone");
}

/// The unit that belongs to a quantity of an axis, by the symbol or the last word before it.
fn unit_of(quantity: &str) -> Option<&'static str> {
    Some(match quantity.rsplit(' ').next()? {
        "θ" | "θ_{0}" => "rad",
        "ω" => "rad/s",
        "t" | "h" | "Δt" => "s",
        "x" | "y" => "m",
        "ΔH" | "H_{0}" => "J",
        _ => return None,
    })
}

/// Catches: the units of two axes exchanged, an angle in rad/s.
#[test]
fn every_axis_says_the_unit_of_its_quantity() {
    let mut seen: BTreeMap<&str, usize> = BTreeMap::new();
    for figure in figures() {
        for Axis { label, .. } in drawn(figure.name).panels.iter().flat_map(|it| [&it.x, &it.y]) {
            let Some((quantity, unit)) = label.rsplit_once(" (") else { continue };
            let Some(unit) = unit.strip_suffix(')') else { continue };
            if let Some(own) = unit_of(quantity) {
                assert_eq!(unit, own, "{}: {label:?}", figure.name);
                *seen.entry(own).or_default() += 1;
            }
        }
    }
    assert_eq!(seen.keys().copied().collect::<Vec<_>>(), ["J", "m", "rad", "rad/s", "s"]);
    assert!(seen["rad"] > 12 && seen["rad/s"] > 8, "{seen:?}");
}

/// A method has one colour in all figures, and two methods of one figure differ in theirs.
///
/// Catches: the styles of two methods exchanged in a figure, legend and all.
#[test]
fn a_method_looks_the_same_in_every_figure() {
    let mut colours: BTreeMap<String, String> = BTreeMap::new();
    let titles: BTreeSet<&str> = METHODS.iter().map(|method| title(*method)).collect();
    for name in ["figure_2", "figure_3", "figure_4", "figure_7", "two_eulers", "level_curves"] {
        for series in drawn(name).panels.iter().flat_map(|chart| &chart.series) {
            if titles.contains(series.label.as_str()) {
                let own = series.style.class("line");
                let colour = colours.entry(series.label.clone()).or_insert(own.clone());
                assert_eq!(*colour, own, "{name}: {}", series.label);
            }
        }
    }
    assert_eq!(colours.values().collect::<BTreeSet<_>>().len(), 4, "{colours:?}");
}
