//! Runs that are interrupted and resumed, and what a summary says of them.

use std::fs;
use std::path::{Path, PathBuf};

use pendula::metrics::EnergyDrift;
use pendula::{Grid, Hamiltonian, METHODS, Motion, Observer, Pendulum, Phase};
use pendula_output::failure::Failure;
use pendula_output::interrupt::Lookout;
use pendula_program::cli::{self, Command};
use pendula_program::commands::output::Streams;
use pendula_program::commands::{simulate, sweep};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use serde_json::Value;

use crate::{names, numbers, shell, words};

/// What a command has printed, and said.
#[derive(Debug)]
pub struct Printed {
    pub out: String,
    pub err: String,
    pub outcome: Result<(), String>,
}

/// Runs a command line in this process; it is interrupted after so many steps, or runs.
pub fn interrupted(arguments: &[&str], after: u64) -> Printed {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let command = cli::parse([&["pendula"], arguments].concat());
    let outcome = command.and_then(|command| {
        let lookout = &|| Lookout::after(after);
        let streams = Streams { out: &mut out, err: &mut err, lookout };
        match command {
            Command::Simulate(arguments) => simulate::run(&arguments, streams),
            Command::Sweep(arguments) => sweep::run(&arguments, streams),
            other => panic!("{other:?} does not run long"),
        }
    });
    let text = |bytes| String::from_utf8(bytes).unwrap();
    let line = |failure: Failure| failure.line().unwrap();
    Printed { out: text(out), err: text(err), outcome: outcome.map_err(line) }
}

/// The same to its end.
pub fn whole(arguments: &[&str]) -> Printed {
    let printed = interrupted(arguments, u64::MAX);
    assert_eq!(printed.outcome, Ok(()), "{arguments:?}");
    printed
}

fn text(path: &Path) -> &str {
    path.to_str().unwrap()
}

/// A folder with the paths of a result and of its state.
struct Folder {
    folder: tempfile::TempDir,
    file: PathBuf,
    state: PathBuf,
}

impl Folder {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let [file, state] = ["run.csv", "run.csv.state"].map(|name| folder.path().join(name));
        Self { folder, file, state }
    }

    /// Interrupts a run after each of `parts`, and lets it come to its end; returns all rows, and
    /// what is said at the end. A file is not touched before.
    fn in_parts(&self, run: &[&str], parts: &[u64], to_file: bool) -> (String, String) {
        let keep = ["--output", text(&self.file)];
        let keep = if to_file { keep } else { ["--state", text(&self.state)] };
        let resume = [run[0], "--resume", text(&self.state)];
        fs::write(&self.file, "old").unwrap();
        let (mut command, mut rows) = ([run, &keep].concat(), String::new());
        for &at in parts {
            let left = interrupted(&command, at);
            let line = left.outcome.unwrap_err();
            assert!(line.contains(&format!("interrupted after {at} ")), "{line}");
            assert!(line.contains(&resume.join(" ")) && left.err.is_empty(), "{line} {}", left.err);
            assert_eq!(names(self.folder.path()), ["run.csv", "run.csv.state"]);
            assert_eq!(fs::read_to_string(&self.file).unwrap(), "old");
            rows += &left.out;
            command = resume.to_vec();
        }
        let end = whole(&command);
        assert_eq!(names(self.folder.path()), ["run.csv"]);
        if to_file {
            assert_eq!(rows + &end.out, "");
            return (fs::read_to_string(&self.file).unwrap(), end.err);
        }
        (rows + &end.out, end.err)
    }
}

/// The objects of arrays that follow each other.
fn objects(arrays: &str) -> Vec<Value> {
    let arrays = serde_json::Deserializer::from_str(arrays).into_iter::<Vec<Value>>();
    arrays.flat_map(|array| array.expect("an array")).collect()
}

/// After every number of steps, and once more later on, for a run with time in seconds, because its
/// angles are large, for other systems and for both kinds of sweep; in files, which are those of
/// the run at once, and on standard output, where each part of JSON is an array of its own. (Parts
/// of CSV are joined below, for any run.)
///
/// Catches: a state that is resumed in another unit of time; a command whose state is not kept
/// whole, or that loses the system's parameters; a sweep that repeats a run or leaves one out; a
/// header in the middle; an array that is closed too early or has a comma too many; a file touched
/// before it is whole; a state left when it is no longer needed; a run without a state that says it
/// can be resumed.
#[test]
fn every_kind_of_run_can_be_resumed() {
    let folder = Folder::new();
    let rest = ["--dt", "0.05", "--duration", "0.3"];
    let large = ["simulate", "--method", "stormer-verlet", "--theta0", "2e6", "--every", "4"];
    let array =
        ["simulate", "--method", "rk4", "--theta0", "1", "--every", "2", "--format", "json"];
    let double = words(
        "simulate --system double-pendulum --method gauss-6 --theta1 2 --theta2 -0.5 --omega2 1.5 \
         --mass1 0.7 --length2 0.6 --gravity 3",
    );
    let driven = words(
        "simulate --system driven --damping 0.3 --drive-strength 1.1 --drive-frequency 2.5 \
         --method stormer-verlet --theta0 1.2",
    );
    let angles = words(
        "sweep --method rk4 --theta0 -1:2:7 --omega0 0.5 --dt 0.1 --duration 0.4 --gravity 5 \
         --length 2 --mass 3",
    );
    let steps =
        words("sweep --method gauss-4 --theta0 1 --dt 0.1:0.01:7 --duration 0.4 --format json");
    for run in [
        [&large[..], &rest].concat(),
        [&array[..], &rest].concat(),
        [&double[..], &rest].concat(),
        [&driven[..], &rest].concat(),
        angles.to_vec(),
        steps.to_vec(),
    ] {
        let expected = whole(&run).out;
        assert!(expected.lines().count() > 2, "{expected}");
        for first in 0..6 {
            let (rows, _) = folder.in_parts(&run, &[first, (first + 6) / 2], true);
            assert_eq!(rows, expected, "{run:?}");
        }
        if run.contains(&"json") {
            let (parts, _) = folder.in_parts(&run, &[3, 4], false);
            assert_eq!(objects(&parts), objects(&expected), "{run:?}");
        }
        let line = interrupted(&run, 3).outcome.unwrap_err();
        assert!(line.contains("--state FILE") && !line.contains("--resume"), "{line}");
    }
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
    let folder = Folder::new();
    fs::write(&folder.file, "old").unwrap();
    let sweep = words("sweep --method rk4 --theta0 0:3:8 --dt 0.1 --duration 0.4 --part 9/9");
    let printed = whole(&[&sweep[..], &["--summary", "--output", text(&folder.file)]].concat());
    assert_eq!((printed.out.as_str(), summary_value(&printed.err, "runs")), ("", 0.0));
    assert!(printed.err.contains("part 9/9 is empty"), "{}", printed.err);
    let mut said = printed.err.lines();
    assert!(said.any(|line| line.split_whitespace().eq(["part", "9/9"])), "{}", printed.err);
    assert_eq!(fs::read_to_string(&folder.file).unwrap(), "");
}

/// A state is cut off at every length, changed at every byte, and, with a checksum that is right,
/// as another version or another hand may do.
///
/// Catches: a run that goes on from what is no state, from half of one, or from another number than
/// was written; a state of another command; a place beyond the end;
/// a field that is missing, unknown or of another kind; another version; arguments beside a state;
/// a panic where there is no refusal; anything written then; a state that is written over.
#[test]
fn what_is_no_state_is_refused() {
    let folder = Folder::new();
    let run = words("simulate --method rk4 --theta0 1 --dt 0.1 --steps 9 --summary");
    let to_file = [&run[..], &["--output", text(&folder.file)]].concat();
    assert!(interrupted(&to_file, 4).outcome.is_err());
    let state = fs::read_to_string(&folder.state).unwrap();
    let resume = ["simulate", "--resume", text(&folder.state)];
    let refused = |arguments: &[&str], because: &str| {
        let printed = interrupted(arguments, u64::MAX);
        let line = printed.outcome.expect_err(because);
        assert!(line.contains(because) && printed.out.is_empty(), "{because}: {line}");
        assert_eq!(names(folder.folder.path()), ["run.csv.state"]);
    };
    let is = |changed: &str, because: &str| {
        fs::write(&folder.state, changed).unwrap();
        refused(&resume, because);
    };
    // Without its last byte, which ends the line, it is whole.
    for at in 0..state.len() - 1 {
        is(&state[..at], "no state, or not as it was written");
        let changed = char::from(state.as_bytes()[at] ^ 1);
        let changed = format!("{}{changed}{}", &state[..at], &state[at + 1..]);
        is(&changed, "no state, or not as it was written");
    }
    is(&(state.clone() + "\n"), "no state, or not as it was written");
    let summed = |changed: &str| {
        let (rows, last) = changed.trim_end().rsplit_once('\n').unwrap();
        let all = format!("{rows}\n{}", &last[8..]);
        format!("{rows}\n{:08x}{}\n", crc32fast::hash(all.as_bytes()), &last[8..])
    };
    assert_eq!(summed(&state), state);
    let version = format!("\"version\":\"{}\"", env!("CARGO_PKG_VERSION"));
    for (from, to, because) in [
        (&*version, "\"version\":\"0.0.9\"", "it is of version 0.0.9"),
        ("\"rk4\"", "\"rk5\"", "'rk5'"),
        ("\"arguments\":[\"simulate\"", "\"arguments\":[\"sweep\"", "of a run of `pendula sweep`"),
        ("\"rows\":5", "\"rows\":-5", "expected u64"),
        ("\"rows\"", "\"lines\"", "unknown field `lines`"),
        ("\"steps\":4", "\"steps\":10", "beyond the last of 9"),
        ("\"steps\":4", "\"step\":4", "unknown field `step`"),
        ("\"numbers\":[", "\"numbers\":[0.0,", "invalid length 33"),
        ("\"numbers\":[", "\"numbers\":[null,", "expected f64"),
    ] {
        assert!(state.contains(from), "{from}: {state}");
        is(&summed(&state.replacen(from, to, 1)), because);
    }
    fs::write(&folder.state, &state).unwrap();
    refused(&[&resume[..], &["--mass", "2"]].concat(), "cannot be used with");
    // A run that begins anew would overwrite it.
    refused(&to_file, "keeps a run that was interrupted");
    refused(&[&run[..], &["--state", text(&folder.state)]].concat(), "keeps a run that was");
    let elsewhere = tempfile::tempdir().unwrap();
    let elsewhere = elsewhere.path().join("elsewhere");
    refused(&["simulate", "--resume", text(&elsewhere)], "No such file");
    fs::copy(&folder.state, &elsewhere).unwrap();
    refused(&["simulate", "--resume", text(&elsewhere)], "FILE.state");
    whole(&resume);
    assert_eq!(fs::read_to_string(&folder.file).unwrap(), whole(&run).out);
}

/// Catches: a link that is replaced by a state, or removed in its place; a run that is resumed
/// through a link and goes on to a file beside the link.
#[cfg(unix)]
#[test]
fn a_state_that_is_a_link_is_the_file_it_leads_to() {
    use std::os::unix::fs::symlink;

    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("far")).unwrap();
    let run = words("simulate --method rk4 --theta0 1 --dt 0.1 --steps 9");
    let expected = whole(&run).out;
    let leads = |from: &Path, to: &Path| {
        assert_eq!(fs::read_link(from).unwrap(), to);
    };

    let (here, state) = (at("here"), at("far/state"));
    symlink(&state, &here).unwrap();
    let mut parts = interrupted(&[&run[..], &["--state", text(&here)]].concat(), 3).out;
    let resume = ["simulate", "--resume", text(&here)];
    parts += &interrupted(&resume, 6).out;
    leads(&here, &state);
    assert_eq!(names(&at("far")), ["state"]);
    parts += &whole(&resume).out;
    assert_eq!(parts, expected);
    leads(&here, &state);
    assert!(names(&at("far")).is_empty());

    let (link, file) = (at("link.csv"), at("far/run.csv"));
    symlink(&file, &link).unwrap();
    assert!(interrupted(&[&run[..], &["--output", text(&link)]].concat(), 3).outcome.is_err());
    assert_eq!(names(&at("far")), ["run.csv.state"]);
    let (other, state) = (at("other"), at("far/run.csv.state"));
    symlink(&state, &other).unwrap();
    whole(&["simulate", "--resume", text(&other)]);
    leads(&link, &file);
    leads(&other, &state);
    assert_eq!(names(&at("far")), ["run.csv"]);
    assert_eq!(fs::read_to_string(&link).unwrap(), expected);
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

/// The lines of a summary that do not tell the time it took.
fn lines(err: &str) -> Vec<&str> {
    let times = ["wall time", "steps per second"];
    err.lines().filter(|line| !times.iter().any(|name| line.starts_with(name))).collect()
}

proptest! {
    #![proptest_config(ProptestConfig {
        rng_seed: RngSeed::Fixed(0x0051_3A17),
        failure_persistence: None,
        ..ProptestConfig::with_cases(80)
    })]

    /// All rows and all of the summary, in parts and at once, are what the library computes: for
    /// any method, pendulum, start, stride and parts.
    ///
    /// Catches: a largest error lost between the parts; a stride that begins again, or decides what
    /// is measured; a sign lost.
    #[test]
    fn any_run_in_parts_is_the_run_at_once(
        (which, steps, every) in (0..METHODS.len(), 0..40_u64, 1..9_u64),
        (theta, omega) in (-3.0..3.0, -4.0..4.0),
        (gravity, length, mass, dt) in (1.0..9.0, 0.6..3.0, 0.2..5.0, 0.01..0.2),
        cuts in prop::collection::vec(0..40_u64, 0..4),
        (summary, to_file) in any::<(bool, bool)>(),
    ) {
        let method = METHODS[which];
        let pendulum = Pendulum::new(gravity, length, mass).unwrap();
        let (start, grid) = (Phase { theta, omega }, Grid::new(dt, steps).unwrap());
        let mut parts: Vec<_> = cuts.into_iter().filter(|at| *at < steps).collect();
        parts.sort_unstable();
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
        let at_once = whole(&run);
        let (rows, err) = Folder::new().in_parts(&run, &parts, to_file);
        prop_assert_eq!(&rows, &at_once.out);
        prop_assert!(rows.starts_with("t,theta,omega,energy\n"), "{rows}");
        prop_assert_eq!(numbers(&rows), expected);
        prop_assert_eq!(lines(&err), lines(&at_once.err));
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
    /// Catches: a row, a run of the summary or its largest error lost where a sweep goes on; the
    /// largest of another column or of the last run, or the place of another run; a start or a
    /// velocity without its sign; a part that goes on as the whole or as another part, or with a
    /// header of its own; a summary of all parts.
    #[test]
    fn any_sweep_in_parts_is_the_sweep_at_once(
        (which, count, angles) in (0..METHODS.len(), 2..40_u64, any::<bool>()),
        (theta, span, omega) in (-3.0..0.0, 0.1..3.0, -4.0..4.0),
        (gravity, length, mass, dt) in (1.0..9.0, 0.6..3.0, 0.2..5.0, 0.01..0.1),
        cuts in prop::collection::vec(0..40_u64, 0..3),
        (k, of, to_file) in (1..4_u64, 1..4_u64, any::<bool>()),
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
        let at_once = whole(&run);
        let rows: Vec<_> = at_once.out.lines().filter(|row| !row.starts_with('t')).collect();
        let mut parts: Vec<_> = cuts.into_iter().filter(|at| *at < rows.len() as u64).collect();
        parts.sort_unstable();
        let (out, err) = Folder::new().in_parts(&run, &parts, to_file);
        prop_assert_eq!(&out, &at_once.out);
        prop_assert_eq!(lines(&err), lines(&at_once.err));
        prop_assert_eq!(summary_value(&err, "runs"), rows.len() as f64);
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

/// Catches: an interruption of steps that vary that leaves a file, an open array or no line.
#[test]
fn steps_that_vary_are_interrupted_cleanly() {
    let folder = Folder::new();
    let run =
        words("simulate --method dop853 --theta0 3 --duration 10 --tolerance 1e-8 --format json");
    let left = interrupted(&run, 3);
    assert!(left.outcome.unwrap_err().contains("interrupted after 3 steps"));
    assert_eq!(serde_json::from_str::<Vec<Value>>(&left.out).unwrap().len(), 4);
    fs::write(&folder.file, "old").unwrap();
    let to_file = [&run[..], &["--output", text(&folder.file)]].concat();
    assert!(interrupted(&to_file, 3).outcome.is_err());
    assert_eq!(names(folder.folder.path()), ["run.csv"]);
    assert_eq!(fs::read_to_string(&folder.file).unwrap(), "old");
}
