//! The commands as a user sees them: what they print, and what they leave behind when something is
//! wrong.

use std::fs;
use std::io::Read;
use std::path::Path;
use std::process::{Command, Stdio};
use std::sync::LazyLock;

use pendula::methods::Rk4;
use pendula::systems::Joint;
use pendula::{DoublePendulum, Grid, Hamiltonian, METHODS, Motion, Pendulum, Phase, integrate};
use pendula_study::claims::Verdict;
use serde_json::Value;

use crate::call::{
    PENDULA, assert_refused, json, names, numbers, pendula, printed, refused, shell, words,
};
use crate::listed::LEDGER;

/// Catches: a format that a command does not pass on; objects under other names than the columns,
/// in another order, with other digits, or more or fewer than there are rows.
#[test]
fn every_command_prints_the_same_rows_in_both_formats() {
    for line in [
        "simulate --method stormer-verlet --theta0 1 --dt 0.01 --steps 10",
        "simulate --method dop853 --theta0 3 --duration 10 --tolerance 1e-8",
        "simulate --system double-pendulum --theta1 2 --theta2 -0.5 --dt 0.01 --steps 10",
        "exact --theta0 1 --t 0,0.1,-3",
        "sweep --method rk4 --theta0 0:1:5 --dt 0.1 --duration 1",
    ] {
        let csv = printed(&words(line));
        let names: Vec<&str> = csv.lines().next().unwrap().split(',').collect();
        let rows = numbers(&csv);
        assert!(rows.len() > 2, "{csv}");
        let objects = rows.iter().map(|row| {
            let fields = names.iter().zip(row).map(|(name, value)| (*name, Value::from(*value)));
            fields.map(|(name, value)| (name.to_string(), value)).collect()
        });
        let printed = json(&words(&format!("{line} --format json")));
        assert_eq!(printed, Value::Array(objects.collect()), "{line}");
    }
}

/// Catches: upper and lower exchanged, momenta printed for velocities, a y that points down, rows
/// that an animation cannot read.
#[test]
fn the_double_pendulum_is_printed_ready_to_be_drawn() {
    let text = printed(&words(
        "simulate --system double-pendulum --theta1 2 --theta2 -0.5 --omega2 1.5 --dt 0.01 \
         --steps 200 --gravity 3 --length1 1.3 --length2 0.6 --mass1 0.7 --mass2 1.9",
    ));
    assert!(text.starts_with("t,theta1,theta2,omega1,omega2,x1,y1,x2,y2,energy\n"));
    let rows = numbers(&text);
    assert_eq!(rows.len(), 201);
    let upper = Joint { length: 1.3, mass: 0.7 };
    let double = DoublePendulum::new(3.0, upper, Joint { length: 0.6, mass: 1.9 }).unwrap();
    let start = double.start([2.0, -0.5], [0.0, 1.5]).unwrap();
    let end = integrate(&double, &Rk4, start, &Grid::new(0.01, 200).unwrap(), &mut ());
    let last = &rows[200];
    assert_eq!(last[..3], [2.0, end.theta1, end.theta2]);
    assert_eq!(last[3..5], double.velocities(end));
    assert_eq!(last[9], double.energy(end));
    // By hand, at the start: to a few roundings.
    let places = [1.3 * 2_f64.sin(), -1.3 * 2_f64.cos()];
    let lower = [places[0] - 0.6 * 0.5_f64.sin(), places[1] - 0.6 * 0.5_f64.cos()];
    for (place, by_hand) in rows[0][5..9].iter().zip(places.into_iter().chain(lower)) {
        assert!((place - by_hand).abs() < 1e-15, "{place} {by_hand}");
    }
}

/// The row of a sweep, computed from one run of `simulate`.
fn row_of_one_run(theta0: f64, dt: f64) -> Vec<f64> {
    let run = format!("simulate --method rk4 --theta0 {theta0} --dt {dt} --duration 10");
    let rows = numbers(&printed(&words(&run)));
    let energy = |row: &Vec<f64>| Pendulum::PAPER.energy(Phase { theta: row[1], omega: row[2] });
    let largest = rows.iter().map(|row| (energy(row) - energy(&rows[0])).abs()).fold(0.0, f64::max);
    let last = rows.last().unwrap();
    vec![theta0, dt, last[1], last[2], largest]
}

/// Catches: a step in the rows that is not the one that was taken, rows in the order in which runs
/// finish.
#[test]
fn a_sweep_over_steps_is_a_run_with_each() {
    let rows =
        numbers(&printed(&words("sweep --method rk4 --theta0 1 --dt 0.1:0.001:5 --duration 10")));
    let steps: Vec<f64> = rows.iter().map(|row| row[1]).collect();
    assert_eq!(steps, [100, 316, 1000, 3162, 10000].map(|n| 10.0 / f64::from(n)));
    assert_eq!(rows, steps.iter().map(|dt| row_of_one_run(1.0, *dt)).collect::<Vec<_>>());
}

/// Catches: a sweep of several batches that loses or repeats one, a file that differs from standard
/// output, or is left by a sweep that fails.
#[test]
fn a_large_sweep_is_whole_in_its_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("sweep.csv");
    let sweep = words("sweep --method rk4 --theta0 0:1:10001 --dt 0.1 --duration 0.2");
    let to_file = ["--output", path.to_str().unwrap()];
    assert_eq!(printed(&[&sweep[..], &to_file].concat()), "");
    let text = fs::read_to_string(&path).unwrap();
    assert_eq!(text, printed(&sweep));
    let starts: Vec<f64> = numbers(&text).iter().map(|row| row[0]).collect();
    assert_eq!(starts, (0..=10_000).map(|i| f64::from(i) / 1e4).collect::<Vec<_>>());

    let failing = "sweep --method forward-euler --theta0 0:1:5 --dt 1e200 --duration 1e201";
    let failing = [&words(failing)[..], &to_file].concat();
    assert_eq!(pendula(failing).status.code(), Some(2));
    assert_eq!(names(folder.path()), ["sweep.csv"]);
    assert_eq!(fs::read_to_string(&path).unwrap(), text);
}

/// Catches: rows in the book that the command beside them does not print.
#[test]
fn the_book_shows_the_parts_as_they_are_printed() {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../src/appendix-changing.md");
    let page = fs::read_to_string(page).unwrap();
    let (_, listing) = page.split_once("$ sweep=\"").unwrap();
    let (sweep, listing) = listing.split_once("\"\n").unwrap();
    let (shown, _) = listing.split_once("```").unwrap();
    let mut shown = shown.split("$ pendula sweep $sweep ");
    assert_eq!(shown.next(), Some(""));
    let mut parts = 0;
    for (part, rows) in shown.map(|part| part.split_once('\n').unwrap()) {
        assert_eq!(printed(&words(&format!("sweep {sweep} {part}"))), rows, "{part}");
        parts += 1;
    }
    assert_eq!(parts, 2);
}

/// In two seconds every method comes to errors that count, ten times over on an idle machine.
///
/// Catches: a method or a scene left out, of the table or of the figure; a number under another
/// heading, or in another unit than its heading or the file says; digits cut off; a line of one
/// that the other lacks; a figure that names no machine; missing files.
#[test]
fn work_against_precision_is_printed_and_drawn() {
    assert_refused(&["bench", "--output", "/no/such/folder"], "--output");
    let folder = tempfile::tempdir().unwrap();
    let run = ["bench", "--output", folder.path().to_str().unwrap(), "--seconds"];
    let text = printed(&[&run[..], &["2"]].concat());
    let csv = fs::read_to_string(folder.path().join("work-precision.csv")).unwrap();
    let headings = text.lines().find(|line| line.starts_with("Method")).unwrap();
    let headings = headings.split("  ").map(str::trim).filter(|name| !name.is_empty());
    assert!(headings.eq(["Method", "steps", "Δt (s)", "error (rad)", "time (s)"]), "{text}");
    // The last four fields of the lines that have them, as numbers.
    let cells = text.lines().filter_map(|line| {
        let mut fields = line.split_whitespace().rev().map(|field| field.parse::<f64>().ok());
        let [seconds, error, dt, steps] = [(); 4].map(|()| fields.next().flatten());
        Some([steps?, dt?, error?, seconds?])
    });
    let cells: Vec<[f64; 4]> = cells.collect();
    let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows[0][3..7], ["dt", "steps", "error", "seconds"]);
    assert_eq!(cells.len(), rows.len() - 1);
    // Half a unit in the last printed digit, of a number whose first digit is 1: 1.00 and 1.0.
    let within = [0.0, 0.005, 0.05, 0.005];
    for (cell, row) in cells.iter().zip(&rows[1..]) {
        let row = [row[4], row[3], row[5], row[6]].map(|field| field.parse::<f64>().unwrap());
        for ((printed, value), within) in cell.iter().zip(row).zip(within) {
            assert!((printed / value - 1.0).abs() <= within, "{printed}, {value}\n{text}");
        }
    }
    for theta0 in ["1.0", "3.0"] {
        assert!(rows.iter().any(|row| row[0] == theta0 && row[2] == "rk4"), "{csv}");
    }
    assert_eq!(text.matches("\nFrom ").count(), 3);
    let svg = fs::read_to_string(folder.path().join("work-precision.svg")).unwrap();
    assert!(METHODS.iter().all(|method| svg.contains(method.info().title)));
    assert_eq!(svg.matches("class=\"axis\"").count(), 3);
    assert!(svg.contains(&format!("run time (s), {}", rows[1][7])) && !svg.contains("\n\n"));
    let objects = json(&[&run[..], &["0.5", "--format", "json"]].concat());
    let csv = fs::read_to_string(folder.path().join("work-precision.csv")).unwrap();
    let objects = objects.as_array().unwrap();
    assert_eq!(csv.lines().count(), objects.len() + 1);
    for (line, object) in csv.lines().skip(1).zip(objects) {
        let fields: Vec<&str> = line.split(',').collect();
        assert_eq!(object["method"], fields[2]);
        assert_eq!(object["error"].as_f64(), fields[5].parse().ok());
    }
    assert_eq!(names(folder.path()), ["work-precision.csv", "work-precision.svg"]);
}

/// Catches: a half-written file, or an old one destroyed, by a request that is refused or fails.
#[test]
fn a_request_that_fails_leaves_files_alone() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.csv");
    fs::write(&path, "old").unwrap();
    let run = |more: &str, path: &Path| {
        let run = format!("simulate --method rk4 --theta0 1 {more} --output");
        pendula([&words(&run)[..], &[path.to_str().unwrap()]].concat())
    };
    assert!(refused(&run("--dt 0.01 --duration 0.015", &path)).contains("whole number"));
    assert_eq!(run("--dt 1e200 --steps 9", &path).status.code(), Some(2));
    assert!(refused(&run("--dt 0.01 --steps 1", folder.path())).contains("--output"));
    assert_eq!(names(folder.path()), ["run.csv"]);
    assert_eq!(fs::read_to_string(path).unwrap(), "old");
}

/// Catches: NaN printed by a method that finds no solution; a step too long for it reported as an
/// overflow, or as a failure that no other step would avoid; a file left behind.
#[test]
fn a_step_whose_equations_are_not_solved_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("run.csv");
    for method in ["implicit-midpoint", "gauss-4", "gauss-6", "gauss-16"] {
        for run in ["simulate --theta0 1", "sweep --theta0 1:2:3"] {
            let run = format!("{run} --dt 5 --duration 20 --method {method} --output");
            let run = [&words(&run)[..], &[path.to_str().unwrap()]].concat();
            assert_refused(&run, &format!("a step of 5.0 s is refused: the iteration of {method}"));
            assert!(names(folder.path()).is_empty());
        }
    }
    let short = "simulate --method gauss-4 --theta0 1 --dt 0.1 --steps 5";
    assert!(!printed(&words(short)).contains("NaN"));
}

/// Catches: `pendula simulate … | head` that complains about the closed pipe, or continues to
/// compute for hours.
#[test]
fn a_closed_pipe_ends_it_quietly() {
    let mut run = if cfg!(unix) {
        // A run that goes on is killed after 20 s of the processor's time, and so fails.
        shell("ulimit -t 20; exec \"$0\" \"$@\"")
    } else {
        Command::new(PENDULA)
    };
    let mut run = run
        .args(words("simulate --method rk4 --theta0 1 --dt 0.01 --steps 1000000000000"))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut head = [0; 100];
    run.stdout.take().unwrap().read_exact(&mut head).unwrap();
    let output = run.wait_with_output().unwrap();
    assert!(output.status.success() && output.stderr.is_empty(), "{output:?}");
}

/// Catches: times in another order, θ wrapped, arguments that are not passed to the closed form.
#[test]
fn exact_prints_the_closed_form() {
    let scene = ["exact", "--theta0", "-0.5", "--omega0", "7", "--gravity", "3", "--length", "2"];
    let text = printed(&[&scene[..], &["--t", "-3,0,1e3,0.1"]].concat());
    let pendulum = Pendulum::new(3.0, 2.0, 1.0).unwrap();
    let motion = Motion::new(&pendulum, Phase { theta: -0.5, omega: 7.0 }).unwrap();
    let row = |t| vec![t, motion.at(t).theta, motion.at(t).omega];
    assert_eq!(numbers(&text), [-3.0, 0.0, 1e3, 0.1].map(row));
}

/// The first five against the arithmetic–geometric mean, in f64: K = π/(2 agm(1, k')), which
/// converges quadratically, with sine and cosine of the platform. Each value is a few operations
/// from numbers that are off by at most an ε; 1e-15 is five of them.
///
/// Catches: a quantity missing or under another name, the parameter k² or the complementary modulus
/// for the modulus, T₀/T for T/T₀, g and L exchanged or ignored.
#[test]
fn period_prints_what_it_is_made_of() {
    for theta0 in ["3", "-1e-3", "0.5"] {
        let text = printed(&["exact", "--theta0", theta0, "--gravity", "3", "--length", "2"]);
        let lines: Vec<Vec<&str>> =
            text.lines().map(|line| line.split_whitespace().collect()).collect();
        let half = 0.5 * theta0.parse::<f64>().unwrap();
        let (mut a, mut b) = (1.0_f64, half.cos());
        for _ in 0..8 {
            (a, b) = (0.5 * (a + b), (a * b).sqrt());
        }
        let k = std::f64::consts::FRAC_PI_2 / a;
        let root = (2.0_f64 / 3.0).sqrt();
        let expected = [
            ("T", 4.0 * root * k, Some("s")),
            ("T0", 2.0 * std::f64::consts::PI * root, Some("s")),
            ("T/T0", 1.0 / a, None),
            ("K", k, None),
            ("modulus", half.sin().abs(), None),
        ];
        assert_eq!(lines.len(), expected.len() + 1, "{text}");
        for (line, (name, value, unit)) in lines.iter().zip(expected) {
            assert_eq!((line[0], line.get(2).copied()), (name, unit), "{text}");
            let printed: f64 = line[1].parse().unwrap();
            assert!((printed / value - 1.0).abs() < 1e-15, "{name}: {printed} {value}");
        }
    }
}

/// Catches: a cell without its id, value or verdict, and formats that disagree.
#[test]
fn tables_have_every_cell_in_every_format() {
    let cells = json(&["paper", "tables", "--format", "json"]);
    let cells = cells.as_array().unwrap();
    let csv = printed(&["paper", "tables", "--format", "csv"]);
    assert_eq!(csv.lines().next(), Some("id,stated,measured,verdict"));
    assert_eq!(csv.lines().count(), cells.len() + 1);
    for (cell, line) in cells.iter().zip(csv.lines().skip(1)) {
        let fields: Vec<&str> = line.split(',').collect();
        assert_eq!(fields.len(), 4, "{line}");
        assert_eq!(cell["id"], fields[0]);
        assert_eq!(cell["verdict"], fields[3]);
    }
    let cell = cells.iter().find(|cell| cell["id"] == "T4.rk4.0.01").unwrap();
    assert_eq!(cell["stated"], 2.34e-7);
    let text = printed(&["paper", "tables", "--table", "4"]);
    assert!(text.starts_with("Table 4\n") && text.contains("2.33759 × 10⁻⁷"), "{text}");
}

/// All claims, as they are printed.
static CLAIMS: LazyLock<Value> = LazyLock::new(|| json(&["paper", "claims", "--format", "json"]));

/// Catches: claims lost on the way to the terminal, Markdown in it, a count that does not add up.
#[test]
fn claims_are_counted_by_verdict() {
    let text = printed(&["paper", "claims"]);
    assert!(!text.contains("**") && !text.contains('`'), "{text}");
    let [readings, summary] = [0, 1].map(|line| text.lines().rev().nth(line).unwrap());
    let (total, counts) = summary.split_once(" claims: ").expect("a summary");
    let number = |words: &str| words.split(' ').next().unwrap().parse::<u32>().unwrap();
    assert_eq!(number(total), counts.split(", ").map(number).sum::<u32>());
    let claims = CLAIMS.as_array().unwrap();
    assert_eq!(claims.len() as u32, number(total) + number(readings));
    let of_kind = |kind| claims.iter().filter(|claim| claim["kind"] == kind).count();
    assert_eq!(of_kind("reading") as u32, number(readings));
    assert_eq!((of_kind("cell") + of_kind("sentence")) as u32, number(total));
}

/// The verdict is judged here too: it does not matter what the command prints it from.
///
/// Catches: a verdict that the measurement no longer supports, and the one on record printed in its
/// place.
#[test]
fn every_claim_is_upheld() {
    let printed = CLAIMS.as_array().unwrap();
    let stated: Vec<_> =
        LEDGER.claims().iter().filter(|claim| claim.verdict != Verdict::NotStated).collect();
    assert_eq!(printed.len(), stated.len());
    for (claim, object) in stated.into_iter().zip(printed) {
        assert_eq!(claim.judged(), claim.verdict, "{claim:?}");
        assert_eq!(object["id"], claim.id);
        assert_eq!(object["verdict"], claim.judged().to_string(), "{object}");
        assert_eq!(object["recorded"], claim.verdict.to_string(), "{object}");
    }
}
