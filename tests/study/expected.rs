//! What each figure should show: the series of its charts, computed again.

use std::f64::consts::PI;

use pendula::systems::{DoublePhase, Ellipse, Kepler, PlanePhase};
use pendula::{
    AnyMethod, Grid, Hamiltonian, METHODS, Motion, Pendulum, Phase, exact, method_named,
};
use pendula_study::experiments::{
    STEPS, beyond, convergence, enclosure, in_paper, level_curves, phase_portrait, readings,
    resonance, rounding_walk, small_angle, standard_map, truncation,
};

use crate::STUDY;
use crate::choosing::MAP;

pub type Point = (f64, f64);

/// A series: words of the heading of its chart or of its y axis, its label, and its values.
pub struct Expected {
    pub chart: String,
    pub label: String,
    pub values: Vec<Point>,
}

pub fn expect(
    chart: impl Into<String>,
    label: impl Into<String>,
    values: impl IntoIterator<Item = Point>,
) -> Expected {
    let (chart, label) = (chart.into(), label.into());
    Expected { chart, label, values: values.into_iter().collect() }
}

pub type Method = &'static dyn AnyMethod;

pub fn of(name: &str) -> Method {
    method_named(name).expect("a method of the library")
}

pub fn title(method: Method) -> &'static str {
    method.info().title
}

pub fn papers() -> impl Iterator<Item = Method> {
    METHODS.iter().copied().filter(|method| in_paper(*method))
}

/// Every sample of a run from rest: time and state.
pub fn run(method: Method, theta_0: f64, step: f64, duration: f64) -> Vec<(f64, Phase)> {
    let grid = Grid::with_duration(step, duration).unwrap();
    let mut samples = Vec::new();
    let mut keep = |_: u64, t: f64, z: Phase| samples.push((t, z));
    method.run(&Pendulum::PAPER, Phase::at_rest(theta_0), &grid, &mut keep);
    samples
}

/// H − H₀ along a run.
pub fn energy_error(run: &[(f64, Phase)]) -> impl Iterator<Item = Point> {
    let initial = Pendulum::PAPER.energy(run[0].1);
    run.iter().map(move |(t, z)| (*t, Pendulum::PAPER.energy(*z) - initial))
}

pub fn plane(z: Phase) -> Point {
    (z.theta, z.omega)
}

pub fn figure_2() -> Vec<Expected> {
    let row = |row: &convergence::Row| {
        expect("energy error", title(row.method), STEPS.into_iter().zip(row.drift))
    };
    STUDY.convergence.iter().map(row).collect()
}

pub fn figure_3() -> Vec<Expected> {
    let mut expected = Vec::new();
    for method in papers() {
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

pub fn figure_4() -> Vec<Expected> {
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

pub fn figure_5() -> Vec<Expected> {
    let orbits = phase_portrait::THETA_0.into_iter().map(|theta_0| {
        let period = exact::period(&Pendulum::PAPER, theta_0).unwrap();
        // Once round, and the step that closes it.
        let orbit = run(of("rk4"), theta_0, 0.01, 0.01 * (period / 0.01).ceil());
        expect("ω (rad/s)", "RK4", orbit.into_iter().map(|(_, z)| plane(z)))
    });
    orbits.collect()
}

pub fn figure_6() -> Vec<Expected> {
    let samples = run(of("rk4"), 3.0, 0.001, 15.0);
    vec![expect("θ (rad)", "RK4", samples.iter().step_by(10).map(|(t, z)| (*t, z.theta)))]
}

pub fn figure_7() -> Vec<Expected> {
    let mut expected = Vec::new();
    for row in &STUDY.work {
        let pick = |pick: fn(&small_angle::Errors) -> f64| {
            row.points.iter().map(move |(n, errors)| (*n as f64, pick(errors)))
        };
        expected.push(expect("against formula", title(row.method), pick(|e| e.formula)));
        expected.push(expect("against truth", title(row.method), pick(|e| e.truth)));
    }
    expected
}

pub fn cancellation() -> Vec<Expected> {
    let verlet = of("stormer-verlet");
    let row = STUDY.small_angle.iter().find(|row| title(row.method) == title(verlet)).unwrap();
    let truth = STEPS.into_iter().zip(row.errors.map(|errors| errors.truth));
    let ladder = small_angle::ladder(verlet);
    let formula = ladder.iter().map(|(h, errors)| (*h, errors.formula));
    vec![
        expect("RMS", "measured against the formula", formula),
        expect("RMS", "measured against the truth", truth),
    ]
}

pub fn two_eulers() -> Vec<Expected> {
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

pub fn level_curves_expected() -> Vec<Expected> {
    let rows = level_curves::own().into_iter().map(|row| {
        let label = title(row.method);
        let points = level_curves::points(row.method, row.step).into_iter().map(plane);
        expect(format!("{label}, h = {} s", row.step), label, points)
    });
    rows.collect()
}

pub fn tilted_curve_expected() -> Vec<Expected> {
    let level_curves::Run { method, step, points, curves } = level_curves::tilted();
    let label = format!("{}, h = {step} s", title(method));
    let mut expected = vec![expect("ω (rad/s)", label, points.into_iter().map(plane))];
    // The curve with one term has its name beside it and not in the legend.
    for (label, curve) in ["true orbit, H", "", "H̃, 7 terms"].into_iter().zip(curves) {
        if !label.is_empty() {
            expected.push(expect("ω (rad/s)", label, curve.into_iter().map(plane)));
        }
    }
    expected
}

pub fn five_periods() -> Vec<Expected> {
    let mut expected = Vec::new();
    for (chart, ladder) in
        [("of RK4", readings::of_rk4()), ("of the exact motion", readings::of_the_exact_motion())]
    {
        for (i, reading) in readings::READINGS.into_iter().enumerate() {
            let line: Vec<Point> = ladder.iter().map(|e| (e.step, e.by[i])).collect();
            expected.push(expect(chart, reading, line));
        }
    }
    expected
}

pub fn standard_map_expected() -> Vec<Expected> {
    let mut expected = Vec::new();
    for k in standard_map::PARAMETERS {
        let orbits = standard_map::orbits(k);
        for (label, escapes) in [("orbits that stay", false), ("orbits that escape", true)] {
            let some = orbits.iter().filter(|orbit| orbit.escapes == escapes);
            let points: Vec<Point> = some.flat_map(|orbit| orbit.points.clone()).collect();
            if !points.is_empty() {
                expected.push(expect(format!("K = {k},"), label, points));
            }
        }
    }
    expected
}

pub fn rounding_walk_expected() -> Vec<Expected> {
    let walks = rounding_walk::walks();
    let label = "Störmer–Verlet";
    let growth = rounding_walk::growth(walks).into_iter().map(|(n, moved)| (n as f64, moved));
    let mut expected = vec![expect("movement in n steps", label, growth)];
    for walk in walks {
        let steps = |i: usize| (i as u64 * rounding_walk::SAMPLED) as f64;
        let line = walk.iter().enumerate().step_by(50).map(|(i, error)| (steps(i), *error));
        expected.push(expect("relative error", label, line));
    }
    expected
}

/// What each method needs for a hundred swings to a thousandth of a radian, the cheapest first:
/// a cell of the map.
pub fn compared() -> Vec<(&'static str, u64)> {
    let mut cells = MAP.iter().filter(|cell| cell.periods == 100);
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

pub fn cost() -> Vec<Expected> {
    let rows = compared().into_iter().zip(0..);
    let place = |((_, evaluations), row)| (evaluations as f64, f64::from(row) + 0.5);
    vec![expect("", "", rows.map(place))]
}

pub fn poincare() -> Vec<Expected> {
    vec![expect("ω (rad/s)", "", beyond::poincare(24_000).into_iter().map(plane))]
}

pub fn separation() -> Vec<Expected> {
    let double = beyond::equals();
    let starts = [[2.0, 2.5], [0.2, 0.25]].into_iter();
    let runs = starts.map(|start| {
        let label = format!("released at {} and {} rad", start[0], start[1]);
        let apart = beyond::separation(&double, start, 1e-9, (0.002, 10_000));
        expect("distance", label, apart)
    });
    runs.collect()
}

pub fn kapitza() -> Vec<Expected> {
    let (stands, leaves): (Vec<_>, Vec<_>) =
        beyond::trials().into_iter().partition(|trial| trial.stands);
    let at = |trial: beyond::Trial| (trial.frequency, trial.amplitude);
    vec![
        expect("amplitude", "stands", stands.into_iter().map(at)),
        expect("amplitude", "falls over or rocks", leaves.into_iter().map(at)),
    ]
}

pub fn double_pendulum_trace() -> Vec<Expected> {
    let double = beyond::equals();
    let paths = [2.0, 2.01].into_iter().map(|upper| {
        let path = beyond::path(&double, [upper, 2.5], (0.001, 6000));
        let lower = |(_, z): (f64, DoublePhase)| double.bobs(z)[1];
        expect("y (m)", format!("from {upper} rad"), path.into_iter().map(lower))
    });
    paths.collect()
}

pub fn turning_ellipse() -> Vec<Expected> {
    let centre = Kepler::new(1.0).unwrap();
    let ellipse = Ellipse::new(&centre, 1.0, 0.6).unwrap();
    let states = beyond::turning(&centre, &ellipse, 100, 30);
    let at = |z: &PlanePhase| (z.x, z.y);
    // The 3rd, 6th, … revolution.
    let thirds = (3..=30).step_by(3).flat_map(|n| states[100 * n - 100..100 * n].iter().map(at));
    let thirds: Vec<Point> = thirds.collect();
    vec![
        expect("y (m)", "each third revolution", thirds),
        expect("y (m)", "the thirtieth", states[2898..].iter().map(at)),
    ]
}

pub fn resonances() -> Vec<Expected> {
    let line = |name| {
        let label = title(of(name));
        expect(format!("(J), {label}"), "", resonance::line(of(name)))
    };
    vec![line("blanes-moan-6"), line("stormer-verlet")]
}

pub fn truncation() -> Vec<Expected> {
    let mut expected = Vec::new();
    for x in truncation::STEPS {
        let errors = truncation::errors(1.0, x).into_iter().enumerate();
        let line: Vec<Point> = errors.map(|(k, error)| (2.0 * k as f64, error)).collect();
        let lowest = line.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1));
        expected.push(expect("largest change", format!("x = {x}"), line));
        expected.push(expect("largest change", "", lowest));
    }
    expected
}

pub fn least_change() -> Vec<Expected> {
    let mut expected = vec![expect("smallest", "splitting of the separatrix", truncation::split())];
    for theta_0 in truncation::STARTS {
        let label = format!("from {theta_0} rad");
        expected.push(expect("smallest", label, truncation::least(theta_0)));
    }
    expected
}

pub fn widths() -> Vec<Expected> {
    use enclosure::{Shape, widths};
    let shapes = [("rectangles, turned", Shape::Turned), ("boxes", Shape::Box)];
    shapes.map(|(label, shape)| expect("width", label, widths(shape))).into()
}

/// One step from where all the stencils begin: its ends.
pub fn stencil(name: &'static str, step: f64) -> Vec<Expected> {
    let (pendulum, start) = (Pendulum::PAPER, Phase { theta: -1.2, omega: 1.0 });
    let mut ends = Vec::new();
    let mut keep = |_: u64, _: f64, z: Phase| ends.push(plane(z));
    of(name).run(&pendulum, start, &Grid::new(step, 1).unwrap(), &mut keep);
    let truth = plane(Motion::new(&pendulum, start).unwrap().at(step));
    vec![
        expect("ω (rad/s)", title(of(name)), ends),
        expect("ω (rad/s)", format!("true motion after {step} s"), [truth]),
    ]
}

pub fn swings() -> Vec<Expected> {
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
