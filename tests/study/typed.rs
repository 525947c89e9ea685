//! Numbers that the chapters' sentences state without a directive that fills them in, computed
//! again.

use std::f64::consts::{FRAC_PI_3, PI, TAU};
use std::fs;

use pendula::arithmetic::sine::sin;
use pendula::{AnyMethod, Grid, Motion, Pendulum, Phase, Rk4, StormerVerlet, exact, method_named};
use pendula_dynamics::kepler::{Ellipse, Kepler};
use pendula_judge::known_answers;
use pendula_study::digits::rounds_to;
use pendula_study::dynamics::root;
use pendula_study::experiments::{
    beyond, choosing, long_run, small_angle, standard_map, tolerance, truncation,
};
use pendula_study::theory;

use crate::measured;

const PAPER: Pendulum = Pendulum::PAPER;

/// A number as typed: the chapter, the words around it (without line breaks), the same number with
/// the digits that it claims, and what it should be.
type Typed = (&'static str, &'static str, &'static str, fn() -> f64);

const TYPED: &[Typed] = &[
    ("exact-motion", "falls after about 12 s", "12", || 0.25 * period(PI)),
    ("exact-motion", "up to 3.1 rad, 6 steps", "6", || steps_of_the_mean(3.1)),
    ("exact-motion", "it takes 7 to 9", "7", || steps_of_the_mean(PI - 1e-3)),
    ("exact-motion", "it takes 7 to 9", "9", || steps_of_the_mean(PI)),
    ("small-angle", "pendulum is 8° short", "8", || 180.0 - 3_f64.to_degrees()),
    ("lab", "0.35 s, where $x^2$ is 1.2:", "1.2", || x_squared(0.35)),
    ("pendulum", r"\approx 0.105$ rad", "0.105", || 4.0 / 1440_f64.sqrt()),
    ("forward-euler", r"-9.81\sin 1 \approx -8.2548$", "-8.2548", || -9.81 * sin(1.0)),
    ("forward-euler", r"\approx e^{46.8}$", "46.8", || 500.0 * 1.0981_f64.ln()),
    ("rk4", "a step of 0.78 s", "0.78", || seconds(6_f64.sqrt())),
    ("stormer-verlet", "2.745 rad, and beyond that", "2.745", true_period_of_stormer_verlet),
    ("methods", "up to 1.50 rad", "1.50", as_far_as_the_discrete_gradient),
    ("choosing", "Near 2.745 rad", "2.745", true_period_of_stormer_verlet),
    ("choosing", r"\approx 3.1\cdot10^{-4}$ s", "3.1e-4", step_to_a_millionth),
    ("choosing", "about 280 million", "2.8e2", || 86_400.0 / step_to_a_millionth() / 1e6),
    ("choosing", "about 40 000 periods", "4.0e4", || 86_400.0 / period(1.0)),
    ("choosing", "is off by 0.32 rad in the day", "0.32", || blanes_moan_6_in_a_day(10.0)),
    ("choosing", "or 10.125 by 0.002", "0.002", || blanes_moan_6_in_a_day(9.875)),
    ("choosing", "or 10.125 by 0.002", "0.002", || blanes_moan_6_in_a_day(10.125)),
    ("choosing", "up to 2.0 times the", "2.0", || work_without_a_gradient(2.0)),
    ("choosing", "up to 2.0 times", "2.0", || work_without_a_gradient(3.0)),
    ("choosing", "take RK4 about 28 000", "2.8e4", || hundred_swings("rk4")),
    ("choosing", "Störmer–Verlet about 94 000.", "9.4e4", || hundred_swings("stormer-verlet")),
    ("small-angle", "a step of about 0.01955 s", "0.01955", cancelling_step),
    ("small-angle", r"$\Delta t$ = 0.01955 s", "0.01955", cancelling_step),
    ("order", r"$45.2\,h^5\,t$", "45.2", || -loss(FRAC_PI_3)),
    ("order", r"$0.94\,h^4$", "0.94", oscillation),
    ("long-run", "is about 240 000 s,", "2.40e5", energy_overtakes),
    ("long-run", "after about 1070 s.", "1.07e3", angle_overtakes),
    ("long-run", "to about 4 minutes.", "4", || energy_overtakes() / 4_f64.powi(5) / 60.0),
    ("long-run", "some 15 800:", "1.58e4", symplectic_euler_over_rk4),
    ("long-run", r"$1.6\cdot10^7$ s", "1.6e7", || 1000.0 * symplectic_euler_over_rk4()),
    ("phase-space", "The 13.8 comes from", "13.8", || truncation::exponent(1.0)),
    ("limits", "that is a step of 0.63855 s", "0.63855", || seconds(2.0)),
    ("limits", "The number 0.63855 s is right", "0.63855", || seconds(2.0)),
    ("limits", "a step of 0.9030 s", "0.9030", || seconds(8_f64.sqrt())),
    ("limits", r"h = 0.3147\ \text{s", "0.3147", || standard_map::step(0.971635)),
    ("speed", r"it is $3.5\cdot10^{-13}$", "3.5e-13", || 0.5 * f64::EPSILON * 1e7_f64.sqrt()),
    ("speed", r"$2\pi\sigma$ is 13.8;", "13.8", || truncation::exponent(1.0)),
    ("higher-order", r"{2}} \approx 1.35,", "1.35", || 1.0 / (2.0 - 2_f64.cbrt())),
    ("higher-order", r"\approx -1.70.", "-1.70", || 1.0 - 2.0 / (2.0 - 2_f64.cbrt())),
    ("higher-order", r"\approx 0.41$, and", "0.41", || 1.0 / (4.0 - 4_f64.cbrt())),
    ("higher-order", "is $-0.66$.", "-0.66", || 1.0 - 4.0 / (4.0 - 4_f64.cbrt())),
    ("higher-order", r"\approx 0.239$,", "0.239", || 1.0 / (6.0 - 6_f64.cbrt())),
    ("higher-order", r"\approx -0.434$.", "-0.434", || 1.0 - 6.0 / (6.0 - 6_f64.cbrt())),
    ("tolerance", "off by about 80 tolerances", "8e1", || multiple(0)),
    ("tolerance", "DOP853 by 10,", "1.0e1", || multiple(1)),
    ("tolerance", "series by 0.5. The height", "0.5", || multiple(2)),
    ("tolerance", "$q = 5.2$ for", "5.2", || power_of_estimate(0)),
    ("tolerance", "and 9.2 for DOP853", "9.2", || power_of_estimate(1)),
    ("tolerance", "turned it is 1.0.", "1.0", || {
        let turned = tolerance::of_the_zoo(tolerance::SIGN_TURNED);
        let runs = tolerance::tolerances(5).map(|tol| tolerance::run(&*turned, tol));
        tolerance::power_of_estimate(&runs.collect::<Vec<_>>())
    }),
    ("tolerance", "it takes 1.6 million", "1.6", || {
        tolerance::run(&*tolerance::of_the_zoo(tolerance::SIGN_TURNED), 1e-5).evaluations / 1e6
    }),
    ("tolerance", "and Dormand–Prince 480.", "4.8e2", || of_the_library(0, 1e-5).evaluations),
    ("tolerance", "is 15 000 times as far off", "1.5e4", || {
        let worst = |name| {
            let along = tolerance::along(&*tolerance::of_the_zoo(name), 1e-8, 2000);
            along.into_iter().map(|(_, error)| error).fold(0.0, f64::max)
        };
        worst(tolerance::CUBIC) / worst(tolerance::OWN_INTERPOLANT)
    }),
    ("tolerance", r"off by $1.1\cdot10^{-4}$ rad", "1.1e-4", || of_the_library(0, 1e-6).error),
    ("tolerance", "The error is 110 times the", "1.1e2", || of_the_library(0, 1e-6).error / 1e-6),
    ("friction-and-drives", r"$h \approx 0.38$ s", "0.38", || {
        (144.0 * 0.05 / PAPER.frequency_squared().powi(3)).powf(0.2)
    }),
    ("judging", "for 159 methods; then", "159", || known_answers::methods().len() as f64),
    ("judging", "one of 172 known mistakes", "172", || known_answers::mistakes().len() as f64),
    ("other-systems", "gives $0.0258$ rad", "0.0258", precession),
    ("other-systems", "itself turns by $0.0254$", "0.0254", precession_of_the_run),
    ("other-systems", "full circle in about 250", "2.5e2", || TAU / precession_of_the_run()),
    ("speed", "up to 88 times as fast again", "88", || {
        let code = measured_row("scenes", |cells| cells[0] == "RK4, from 1 rad");
        let times = measured_rows("front").into_iter().filter(|cells| !cells[8].contains('*'));
        times.map(|cells| number(&cells[9])).fold(0.0, f64::max) / number(&code[3])
    }),
    ("speed", "it takes 0.8 to 1.2 times", "0.8", || front([7, 6])[0]),
    ("speed", "it takes 0.8 to 1.2 times", "1.2", || front([7, 6])[1]),
    ("speed", "crates take 9 to 22 times", "9", || front([6, 3])[0]),
    ("speed", "crates take 9 to 22 times", "22", || front([6, 3])[1]),
    ("speed", "takes 2.2 to 4.5 times", "2.2", || front([4, 3])[0]),
    ("speed", "takes 2.2 to 4.5 times", "4.5", || front([4, 3])[1]),
];

/// x² = (ω₀h)².
fn x_squared(h: f64) -> f64 {
    PAPER.frequency_squared() * h * h
}

fn period(theta_0: f64) -> f64 {
    exact::period(&PAPER, theta_0).unwrap()
}

/// The step (s) at which ω₀h is `x`.
fn seconds(x: f64) -> f64 {
    x / PAPER.small_angle_frequency()
}

/// The amplitude (rad) at which Störmer–Verlet's period errs by a higher power of the step only.
fn true_period_of_stormer_verlet() -> f64 {
    root(|theta_0| Some(theory::period::of_stormer_verlet(&PAPER, theta_0)), 2.5, 3.0).unwrap()
}

/// The amplitude (rad) at which Cieśliński's and Ratkiewicz's period is as far off as the discrete
/// gradient's, to the other side.
fn as_far_as_the_discrete_gradient() -> f64 {
    let [longer, shorter] =
        [theory::period::of_discrete_gradient, theory::period::of_cieslinski_ratkiewicz];
    root(|theta_0| Some(longer(&PAPER, theta_0) + shorter(&PAPER, theta_0)), 1.0, 2.0).unwrap()
}

/// Störmer–Verlet's step (s) for an energy error of 1e-6 J from 1 rad; the error goes with h².
fn step_to_a_millionth() -> f64 {
    let h = 1e-4;
    h * (1e-6 / theory::stormer_verlet::energy_error(&PAPER, 1.0, h)).sqrt()
}

fn cancelling_step() -> f64 {
    theory::small_angle::cancelling_step(&PAPER, small_angle::THETA_0)
}

/// RK4's change of energy over h⁵ (J/s⁶) from rest at `theta_0` (rad).
fn loss(theta_0: f64) -> f64 {
    let h = 0.001_f64;
    theory::rk4::secular_rate(&PAPER, theta_0, h) / h.powi(5)
}

/// RK4's energy error over h⁴ (J/s⁴) in a swing from rest at π/3, in steps so short that its loss
/// is below a thousandth of it.
fn oscillation() -> f64 {
    let h = 1e-5_f64;
    let steps = (period(FRAC_PI_3) / h) as u64;
    theory::rk4::largest_energy_error(&PAPER, FRAC_PI_3, h, steps) / h.powi(4)
}

/// When (s) RK4's loss reaches Störmer–Verlet's oscillation in equal steps.
fn energy_overtakes() -> f64 {
    let (theta_0, h) = (long_run::THETA_0, long_run::STEP);
    let oscillation = theory::stormer_verlet::energy_error(&PAPER, theta_0, h);
    oscillation / -theory::rk4::secular_rate(&PAPER, theta_0, h)
}

/// When (s) RK4's largest angle error becomes the greater one for equal work: steps of 0.04 s
/// against Störmer–Verlet's of 0.01 s.
fn angle_overtakes() -> f64 {
    let start = Phase::at_rest(long_run::THETA_0);
    let motion = Motion::new(&PAPER, start).unwrap();
    // The largest error so far, every 0.04 s.
    let largest = |method: &dyn AnyMethod, every: u64| {
        let (mut largest, mut series) = (0.0_f64, Vec::new());
        let grid = Grid::with_duration(0.04 / every as f64, 1200.0).unwrap();
        method.run(&PAPER, start, &grid, &mut |n: u64, t: f64, z: Phase| {
            largest = largest.max((z.theta - motion.at(t).theta).abs());
            if n.is_multiple_of(every) {
                series.push((t, largest));
            }
        });
        series
    };
    let pairs = largest(&StormerVerlet, 4).into_iter().zip(largest(&Rk4, 1));
    let mut ahead = pairs.filter(|(verlet, rk4)| verlet.1 >= rk4.1).map(|((t, _), _)| t);
    ahead.next_back().unwrap()
}

/// The evaluations with which a method keeps the angle within a thousandth of a radian over a
/// hundred swings from 1 rad, as in the figure of costs.
fn hundred_swings(method: &str) -> f64 {
    let costs = choosing::costs(&[method_named(method).unwrap()]);
    costs[0].unwrap().evaluations as f64
}

/// The largest error of the angle (rad) in 40 000 periods of so many steps each.
fn blanes_moan_6_in_a_day(steps: f64) -> f64 {
    let release = choosing::Release::new(choosing::THETA_0);
    let motion = Motion::new(&PAPER, release.start).unwrap();
    let method = method_named("blanes-moan-6").unwrap();
    let (grid, mut largest) = (release.grid(steps, 40_000), 0.0_f64);
    method.run(&PAPER, release.start, &grid, &mut |n: u64, t: f64, z: Phase| {
        // A number that has no divisor in common with the steps of eight periods.
        if n.is_multiple_of(13) {
            largest = largest.max((z.theta - motion.at(t).theta).abs());
        }
    });
    largest
}

/// The most evaluations that the best method without a gradient needs in a cell of the swing's map,
/// over those of the best processed one.
fn work_without_a_gradient(theta_0: f64) -> f64 {
    let map = choosing::map(theta_0);
    let ratio = |cell: &choosing::Cell| {
        let best = |processed: bool| {
            let is_it = |it: &&choosing::Advice| {
                it.method.info().name.starts_with("processed-") == processed
            };
            cell.ranking.iter().find(is_it).map(|it| it.evaluations as f64)
        };
        Some(best(false)? / best(true)?)
    };
    map.iter().filter_map(ratio).fold(0.0, f64::max)
}

/// Symplectic Euler's energy error over RK4's in the long run.
fn symplectic_euler_over_rk4() -> f64 {
    measured("T5.se.dH") / measured("T5.rk4.dH")
}

/// The run from 2 rad of one of the chapter's solvers with this tolerance.
fn of_the_library(solver: usize, tol: f64) -> tolerance::Run {
    tolerance::run(&*tolerance::solvers()[solver].1, tol)
}

/// How many tolerances a solver is off by: the mean over swings, and over tolerances below 10⁻⁵.
fn multiple(solver: usize) -> f64 {
    let solver = &tolerance::solvers()[solver].1;
    let tolerances = tolerance::tolerances(12).filter(|tol| *tol < 2e-5);
    let logs = tolerances.map(|tol| (tolerance::mean_error(&**solver, tol) / tol).ln());
    let logs: Vec<f64> = logs.collect();
    (logs.iter().sum::<f64>() / logs.len() as f64).exp()
}

/// The power of a solver's estimate, from its evaluations with tolerances up to 10⁻⁶.
fn power_of_estimate(solver: usize) -> f64 {
    let tolerances = tolerance::tolerances(12).filter(|tol| *tol < 2e-6);
    let runs = tolerances.map(|tol| of_the_library(solver, tol));
    tolerance::power_of_estimate(&runs.collect::<Vec<_>>())
}

/// The turn (rad) of an ellipse of eccentricity 0.6 in a revolution of 100 steps.
fn precession() -> f64 {
    let ellipse = Ellipse::new(&Kepler::new(1.0).unwrap(), 1.0, 0.6).unwrap();
    theory::other_systems::verlet_precession(&ellipse, ellipse.period() / 100.0).abs()
}

/// The same, as the run turns it.
fn precession_of_the_run() -> f64 {
    let centre = Kepler::new(1.0).unwrap();
    let ellipse = Ellipse::new(&centre, 1.0, 0.6).unwrap();
    beyond::precession(&centre, &ellipse, 100).abs()
}

/// The steps of the arithmetic–geometric mean from 1 and k', for a release at `theta_0` (rad),
/// until the first number is the limit to two units in the last place.
fn steps_of_the_mean(theta_0: f64) -> f64 {
    let mut means = vec![(1.0_f64, (0.5 * theta_0).cos())];
    for n in 0..12 {
        let (a, g) = means[n];
        means.push((0.5 * (a + g), (a * g).sqrt()));
    }
    let limit = means[12].0;
    let there = |(a, _): &(f64, f64)| (a / limit - 1.0).abs() <= 2.0 * f64::EPSILON;
    means.iter().position(there).unwrap() as f64
}

/// The cells of a table of `benches/measured.md`, row by row.
fn measured_rows(table: &str) -> Vec<Vec<String>> {
    let file = include_str!("../../benches/measured.md");
    let (_, text) = file.split_once(&format!("<!-- ANCHOR: {table} -->\n")).expect(table);
    let (text, _) = text.split_once("<!-- ANCHOR_END").expect(table);
    let cells = |row: &str| row.trim_matches('|').split('|').map(|it| it.trim().into()).collect();
    text.lines().skip(2).map(cells).collect()
}

fn measured_row(table: &str, is: impl Fn(&[String]) -> bool) -> Vec<String> {
    measured_rows(table).into_iter().find(|cells| is(cells)).expect("a row")
}

/// 20 874: a time in a table of `benches/measured.md`.
fn number(cell: &str) -> f64 {
    cell.replace(' ', "").parse().expect("a number")
}

/// The least and the largest ratio of two columns of the front, where the error is small and there
/// are times in both.
fn front([column, base]: [usize; 2]) -> [f64; 2] {
    let small = |cells: &Vec<String>| !["$10^{-2}$", "$10^{-4}$"].contains(&cells[1].as_str());
    let rows = measured_rows("front").into_iter().filter(small);
    let measured = rows.filter(|cells| cells[column] != "–" && cells[base] != "–");
    let times = measured.map(|cells| number(&cells[column]) / number(&cells[base]));
    times.fold([f64::INFINITY, 0.0], |[least, most], it| [least.min(it), most.max(it)])
}

/// The numbers in a text: 240 000 is one, and so is 2.4\cdot10^{-4}.
fn numbers(words: &str) -> Vec<f64> {
    let words: Vec<char> = words.replace(r"\cdot10^", "e").chars().collect();
    let mut plain = String::new();
    for (i, c) in words.iter().enumerate() {
        let digit =
            |at: Option<usize>| at.and_then(|at| words.get(at)).is_some_and(char::is_ascii_digit);
        match c {
            ' ' if digit(i.checked_sub(1)) && digit(Some(i + 1)) => {}
            '{' if i > 0 && words[i - 1] == 'e' => {}
            c if c.is_ascii_digit() || ".-e".contains(*c) => plain.push(*c),
            _ => plain.push(' '),
        }
    }
    let parts = plain.split_whitespace().map(|part| part.trim_end_matches('.'));
    parts.filter_map(|part| part.parse().ok()).collect()
}

/// Catches: a number typed from memory, or left from an older run: 1700 s for 1070 s.
#[test]
fn a_number_typed_by_hand_is_the_one_computed() {
    let mut wrong = Vec::new();
    for (chapter, words, literal, value) in TYPED {
        let path = format!("{}/../src/{chapter}.md", env!("CARGO_MANIFEST_DIR"));
        let text = fs::read_to_string(&path).expect("a chapter");
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        if !text.contains(words) {
            wrong.push(format!("{chapter} does not say {words:?}"));
        }
        if !numbers(words).contains(&literal.parse().unwrap()) {
            wrong.push(format!("{chapter}: {literal} is not in {words:?}"));
        }
        let value = value();
        if rounds_to(value, literal) != Some(true) {
            wrong.push(format!("{chapter}: {words:?} for {value}"));
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Catches: a file of the book's first program that is another than the one that the book shows,
/// which runs as a listing.
#[test]
fn the_first_program_is_its_file() {
    let chapter = include_str!("../../book/src/introduction.md");
    let (_, listing) = chapter.split_once("```rust\n").expect("a listing");
    let (listing, _) = listing.split_once("```").expect("its end");
    let hidden = |line: &&str| line.starts_with('#');
    let shown: Vec<&str> = listing.lines().filter(|line| !hidden(line)).collect();
    let file = include_str!("../../book/study/examples/explode.rs");
    let (_, file) = file.split_once("\n\n").expect("its documentation");
    assert_eq!(shown, file.lines().collect::<Vec<_>>());
}
