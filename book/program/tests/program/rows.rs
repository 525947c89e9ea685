//! The rows of runs and of sweeps, whole and in parts, and what a summary says of them.

use std::fs;

use pendula::metrics::EnergyDrift;
use pendula::{Grid, Hamiltonian, METHODS, Motion, Observer, Pendulum, Phase};
use pendula_program::cli::{self, Command};
use pendula_program::commands::output::Streams;
use pendula_program::commands::{simulate, sweep};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use crate::{numbers, printed, shell, words};

/// What a command has printed, and said.
#[derive(Debug)]
struct Printed {
    out: String,
    err: String,
}

/// Runs a command line in this process.
fn whole(arguments: &[&str]) -> Printed {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let streams = Streams { out: &mut out, err: &mut err };
    let outcome = match cli::parse([&["pendula"], arguments].concat()) {
        Ok(Command::Simulate(arguments)) => simulate::run(&arguments, streams),
        Ok(Command::Sweep(arguments)) => sweep::run(&arguments, streams),
        other => panic!("{arguments:?}: {other:?}"),
    };
    outcome.unwrap_or_else(|failure| panic!("{arguments:?}: {failure:?}"));
    let text = |bytes| String::from_utf8(bytes).unwrap();
    Printed { out: text(out), err: text(err) }
}

/// The rows of each of `of` parts of a sweep.
fn parts(sweep: &[&str], of: u64) -> Vec<String> {
    let part = |k| whole(&[sweep, &["--part", &format!("{k}/{of}")]].concat()).out;
    (1..=of).map(part).collect()
}

/// For sweeps over angles, where lanes are and where they are not, and over steps, where neighbours
/// are equal; in as many parts as there are runs, in fewer and in more; in one of several batches.
///
/// Catches: a start of two parts or of none, a part whose ends are taken for those of the sweep, a
/// step that is run again because its equal is of the part before, a header in each part or in
/// none, parts of one and of many starts, a last bit that depends on the neighbours in lanes.
#[test]
fn parts_one_after_the_other_are_the_whole() {
    let angles = words(
        "sweep --method rk4 --theta0 -1:2.9:75 --omega0 0.5 --dt 0.1 --duration 0.4 --gravity 5 \
         --length 2 --mass 3",
    );
    // The larger ones cannot be computed in lanes.
    let large = words("sweep --method stormer-verlet --theta0 0:9e6:71 --dt 0.1 --duration 0.4");
    let steps = words("sweep --method gauss-4 --theta0 1 --dt 0.1:0.02:25 --duration 0.4");
    let repeated = whole(&steps).out.lines().count() - 1;
    assert!((6..20).contains(&repeated), "{repeated} of 25 steps differ");
    for (sweep, runs) in [(&angles, 75), (&large, 71), (&steps, 25)] {
        let expected = whole(sweep).out;
        for of in (1..8).chain([runs - 1, runs, runs + 1, runs + 30]) {
            let parts = parts(sweep, of);
            assert_eq!(parts.concat(), expected, "{sweep:?} in {of}");
            assert!(parts[0].starts_with("theta0,dt,theta,omega,energy_error\n"));
            if sweep != &steps {
                for (k, part) in parts.iter().enumerate() {
                    let rows = part.lines().count() as u64 - u64::from(k == 0);
                    assert!(rows == runs / of || rows == runs / of + 1, "{k} of {of}: {rows}");
                }
            }
        }
    }
    let batches = words("sweep --method forward-euler --theta0 0:1:9001 --dt 0.1 --duration 0.1");
    assert!(parts(&batches, 2).concat() == whole(&batches).out);
}

/// The middle of a sweep of 10¹⁵ runs, which would take weeks to count up to.
///
/// Catches: a part that generates the sweep up to it, or to its end.
#[cfg(unix)]
#[test]
fn a_part_costs_its_own_runs_alone() {
    // What goes on for 20 s of the processor's time is killed, and so fails.
    let printed = |sweep: &str| {
        let part = ["--part", "250000000000001/500000000000000"];
        let mut limited = shell("ulimit -t 20; exec \"$0\" \"$@\"");
        let output = limited.args(words(sweep)).args(part).output().unwrap();
        assert!(output.status.success(), "{output:?}");
        String::from_utf8(output.stdout).unwrap()
    };
    let rows = printed("sweep --method rk4 --theta0 0:1:1000000000000001 --dt 1 --duration 3");
    // There are three in the first part, and two in each of the others.
    let starts: Vec<&str> = rows.lines().map(|row| row.split(',').next().unwrap()).collect();
    assert_eq!(starts, ["0.500000000000001", "0.500000000000002"]);
    let steps = "sweep --method rk4 --theta0 1 --dt 1:1e-4:1000000000000000 --duration 1";
    // In the middle of the range all steps are 0.01 s to a rounding: equal to those before.
    assert_eq!(printed(steps), "");
}

/// Catches: a part without runs that leaves an old file as it was, is no success, says nothing, or
/// spoils the whole by a line among its rows.
#[test]
fn a_part_without_runs_is_an_empty_file_and_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("part.csv");
    fs::write(&file, "old").unwrap();
    let sweep = words("sweep --method rk4 --theta0 0:3:8 --dt 0.1 --duration 0.4 --part 9/9");
    let output = ["--summary", "--output", file.to_str().unwrap()];
    let printed = whole(&[&sweep[..], &output].concat());
    assert_eq!((printed.out.as_str(), summary_value(&printed.err, "runs")), ("", 0.0));
    assert!(printed.err.contains("part 9/9 is empty"), "{}", printed.err);
    let mut said = printed.err.lines();
    assert!(said.any(|line| line.split_whitespace().eq(["part", "9/9"])), "{}", printed.err);
    assert_eq!(fs::read_to_string(&file).unwrap(), "");
}

/// The value of a line of a summary.
fn summary_value(err: &str, name: &str) -> f64 {
    let line = err.lines().find(|line| line.starts_with(name));
    let line = line.unwrap_or_else(|| panic!("no {name} in {err}"));
    line[name.len()..].split_whitespace().next().unwrap().parse().unwrap()
}

/// The numbers of a summary are printed with seven digits.
#[track_caller]
fn assert_seven_digits(printed: f64, value: f64) {
    assert!((printed - value).abs() <= 5.1e-7 * value.abs(), "{printed} {value}");
}

proptest! {
    #![proptest_config(ProptestConfig {
        rng_seed: RngSeed::Fixed(0x0051_3A17),
        failure_persistence: None,
        ..ProptestConfig::with_cases(80)
    })]

    /// All rows and all of the summary are what the library computes: for any method, pendulum,
    /// start and stride.
    ///
    /// Catches: a largest error of the rows alone; a stride that decides what is measured; a sign
    /// lost; a summary that nobody has asked for.
    #[test]
    fn any_run_is_that_of_the_library(
        (which, steps, every) in (0..METHODS.len(), 0..40_u64, 1..9_u64),
        (theta, omega) in (-3.0..3.0, -4.0..4.0),
        (gravity, length, mass, dt) in (1.0..9.0, 0.6..3.0, 0.2..5.0, 0.01..0.2),
        summary in any::<bool>(),
    ) {
        let method = METHODS[which];
        let pendulum = Pendulum::new(gravity, length, mass).unwrap();
        let (start, grid) = (Phase { theta, omega }, Grid::new(dt, steps).unwrap());
        let mut expected = vec![];
        let mut drift = EnergyDrift::new(&pendulum);
        let mut watch = |n: u64, t: f64, z: Phase| {
            if n.is_multiple_of(every) {
                expected.push(vec![t, z.theta, z.omega, pendulum.energy_from_pivot(z)]);
            }
            drift.observe(n, t, z);
        };
        let end = method.run(&pendulum, start, &grid, &mut watch);
        let line = format!(
            "simulate --method {} --theta0 {theta:?} --omega0 {omega:?} --gravity {gravity:?} \
             --length {length:?} --mass {mass:?} --dt {dt:?} --steps {steps} --every {every}",
            method.info().name,
        );
        let mut run = words(&line);
        run.extend(summary.then_some("--summary"));
        let Printed { out: rows, err } = whole(&run);
        prop_assert!(rows.starts_with("t,theta,omega,energy\n"), "{rows}");
        prop_assert_eq!(numbers(&rows), expected);
        if !summary {
            prop_assert_eq!(err, "");
            return Ok(());
        }
        let value = |name| summary_value(&err, name);
        prop_assert_eq!(value("steps "), steps as f64);
        if !method.info().implicit {
            let evaluations = method.count_evaluations(&pendulum, start, &grid);
            prop_assert_eq!(value("force evaluations"), evaluations as f64);
        }
        let (of, energy) = (drift.largest(), pendulum.energy(start));
        let said = format!("{of:.6e} J, {:.6e} of the first\n", of / energy);
        prop_assert!(err.contains(&said), "{err}: {said}");
        let exact = Motion::new(&pendulum, start).unwrap().at(steps as f64 * dt);
        assert_seven_digits(value("error of θ at the end"), end.theta - exact.theta);
        assert_seven_digits(value("error of ω at the end"), end.omega - exact.omega);
    }

    /// The same for sweeps, of angles and of steps, whole and in part.
    ///
    /// Catches: a run of the summary or its largest error lost; the largest of another column or of
    /// the last run, or the place of another run; a start or a velocity without its sign; a summary
    /// of all parts.
    #[test]
    fn any_sweep_is_that_of_the_library(
        (which, count, angles) in (0..METHODS.len(), 2..40_u64, any::<bool>()),
        (theta, span, omega) in (-3.0..0.0, 0.1..3.0, -4.0..4.0),
        (gravity, length, mass, dt) in (1.0..9.0, 0.6..3.0, 0.2..5.0, 0.01..0.1),
        (k, of) in (1..4_u64, 1..4_u64),
    ) {
        let name = METHODS[which].info().name;
        let duration = 4.0 * dt;
        let sweep = match angles {
            true => format!("--theta0 {theta:?}:{:?}:{count} --dt {dt:?}", theta + span),
            false => format!("--theta0 {theta:?} --dt {dt:?}:{:?}:{count}", 0.1 * dt),
        };
        let line = format!(
            "sweep --method {name} {sweep} --duration {duration:?} --omega0 {omega:?} \
             --gravity {gravity:?} --length {length:?} --mass {mass:?} --part {}/{of}",
            k.min(of),
        );
        let run = [&words(&line)[..], &["--summary"]].concat();
        let Printed { out, err } = whole(&run);
        let rows: Vec<_> = out.lines().filter(|row| !row.starts_with('t')).collect();
        prop_assert_eq!(summary_value(&err, "runs"), rows.len() as f64);
        if rows.is_empty() {
            return Ok(());
        }
        // Each row is a run by itself.
        let pendulum = Pendulum::new(gravity, length, mass).unwrap();
        let (mut steps, mut energy, mut angle) = (0, (0.0, String::new()), (0.0, String::new()));
        for row in rows {
            let row: Vec<f64> = row.split(',').map(|x| x.parse().unwrap()).collect();
            let grid = Grid::with_duration(row[1], duration).unwrap();
            let mut drift = EnergyDrift::new(&pendulum);
            let start = Phase { theta: row[0], omega };
            let end = METHODS[which].run(&pendulum, start, &grid, &mut drift);
            prop_assert_eq!(&row[2..], [end.theta, end.omega, drift.largest()]);
            steps += grid.steps();
            let exact = Motion::new(&pendulum, start).unwrap().at(duration);
            let errors = [drift.largest(), end.theta - exact.theta];
            for (worst, error) in [&mut energy, &mut angle].into_iter().zip(errors) {
                if error.abs() > f64::abs(worst.0) {
                    *worst = (error, format!(" at θ₀ = {:?} rad, Δt = {:?} s\n", row[0], row[1]));
                }
            }
        }
        prop_assert_eq!(summary_value(&err, "steps "), steps as f64);
        for (name, (worst, place)) in
            [("largest energy error", energy), ("largest error of θ", angle)]
        {
            assert_seven_digits(summary_value(&err, name), worst);
            prop_assert!(err.split_once(name).unwrap().1.contains(&place), "{err}: {place}");
        }
    }
}

/// The appendix of the book says so.
///
/// Catches: a number that is printed with a digit too few, or that is read as another one.
#[test]
fn a_run_goes_on_from_its_last_row() {
    let run = |theta: &str, omega: &str, steps: &str| {
        let line = "simulate --method rk4 --length 2.5 --dt 0.02";
        let start = ["--theta0", theta, "--omega0", omega, "--steps", steps];
        printed(&[&words(line)[..], &start].concat())
    };
    let (all, first) = (run("3.1", "0.0", "500"), run("3.1", "0.0", "200"));
    let last: Vec<&str> = first.lines().last().unwrap().split(',').collect();
    let then = run(last[1], last[2], "300");
    let states = |csv: &str| -> Vec<Vec<f64>> {
        numbers(csv).into_iter().map(|row| row[1..].to_vec()).collect()
    };
    let (all, then) = (states(&all), states(&then));
    assert_eq!(then[0], all[200]);
    // With the step as the unit of time the last bit of a state is rounded once more.
    for (then, all) in then.iter().zip(&all[200..]) {
        for (a, b) in then.iter().zip(all) {
            assert!((a - b).abs() < 1e-12, "{then:?} {all:?}");
        }
    }
}
