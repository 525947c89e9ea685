//! The commands as a user sees them: what they print and draw, and what they leave behind when
//! something is wrong.

use std::fs;
use std::io::{Read, Seek, Write};
use std::path::Path;
use std::process::{self, Output, Stdio};

use pendula::METHODS;
use pendula_program::cli::{self, Command};
use pendula_program::commands::study::{self, work_precision};
use pendula_program::work_precision::Budget;
use pendula_study::claims::Verdict;
use roxmltree::Document;
use serde_json::Value;

use crate::listed::LEDGER;
use crate::{
    PENDULA, assert_refused, json, names, numbers, pendula, printed, refused, shell, words,
};

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

/// `pendula bench` with these words, measured with runs up to the first of more than so many steps:
/// how many runs there is time for depends on what else the machine does.
fn bench(words: &[&str], steps: u64) -> String {
    let command = cli::parse([&["pendula", "bench"], words].concat()).unwrap();
    let Command::Study(study::Command::Bench(arguments)) = command else { panic!("{words:?}") };
    let mut printed = Vec::new();
    work_precision::run_with(&arguments, Budget::Steps(steps), &mut printed).unwrap();
    String::from_utf8(printed).unwrap()
}

/// Catches: a method or a scene left out, of the table or of the figure; a number under another
/// heading, or in another unit than its heading or the file says; digits cut off; a line of one
/// that the other lacks; a figure that names no machine; missing files.
#[test]
fn work_against_precision_is_printed_and_drawn() {
    assert_refused(&["bench", "--output", "/no/such/folder"], "--output");
    let folder = tempfile::tempdir().unwrap();
    let run = ["--output", folder.path().to_str().unwrap()];
    let text = bench(&run, 1_000);
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
    let objects = bench(&[&run[..], &["--format", "json"]].concat(), 300);
    let objects: Value = serde_json::from_str(&objects).unwrap();
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

/// Catches: an option that does not reach the measurement, so that it takes fifteen seconds, or
/// hours; a figure or a table that cannot be made where there was time for nothing.
#[test]
fn a_moment_is_enough_for_files_without_measurements() {
    let folder = tempfile::tempdir().unwrap();
    let run = ["bench", "--output", folder.path().to_str().unwrap(), "--seconds", "1e-9"];
    let text = printed(&run);
    // The first rung of each ladder has no finer one to be held against.
    assert_eq!(text.matches(" — ").count(), 3 * 3 * METHODS.len(), "{text}");
    let csv = fs::read_to_string(folder.path().join("work-precision.csv")).unwrap();
    assert_eq!(csv.lines().count(), 1);
    assert!(fs::read_to_string(folder.path().join("work-precision.svg")).unwrap().contains("<svg"));
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

/// Where a run is lost does not depend on which of its rows are printed: by an iteration that does
/// not converge, and by numbers that overflow, both after the last of the rows.
///
/// Catches: a run of which only the printed rows are looked at; a method of the double pendulum
/// that is another than was asked for.
#[test]
fn a_run_that_is_lost_after_its_last_row_is_refused() {
    let scenes = [
        (
            "simulate --system double-pendulum --method gauss-4 --theta1 2 --theta2 1 --dt 0.3 \
             --steps 9",
            "gauss-4 did not converge in step",
        ),
        (
            "simulate --method gauss-4 --theta0 3 --omega0 6 --dt 0.8 --steps 399",
            "did not converge in step",
        ),
        (
            "simulate --system double-pendulum --theta1 10 --theta2 16 --omega2 20 --dt 2 \
             --steps 390",
            "the range",
        ),
    ];
    for (scene, because) in scenes {
        for every in ["1", "100", "4068"] {
            let line = format!("{scene} --every {every}");
            let lost = pendula(words(&line));
            let reason = String::from_utf8(lost.stderr).unwrap();
            assert_eq!(lost.status.code(), Some(2), "{line}: {reason}");
            assert!(reason.contains(because), "{line}: {reason}");
        }
    }
}

/// Catches: `pendula simulate … | head` that complains about the closed pipe, or continues to
/// compute for hours.
#[test]
fn a_closed_pipe_ends_it_quietly() {
    let mut run = if cfg!(unix) {
        // A run that goes on is killed after 20 s of the processor's time, and so fails.
        shell("ulimit -t 20; exec \"$0\" \"$@\"")
    } else {
        process::Command::new(PENDULA)
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

/// Catches: a cell without its id, value, verdict or definition, and formats that disagree; a
/// definition whose comma splits a line of CSV; a table to read that does not say what is measured.
#[test]
fn tables_have_every_cell_in_every_format() {
    let cells = json(&["paper", "tables", "--format", "json"]);
    let cells = cells.as_array().unwrap();
    let csv = printed(&["paper", "tables", "--format", "csv"]);
    assert_eq!(csv.lines().next(), Some("id,stated,measured,verdict,definition"));
    assert_eq!(csv.lines().count(), cells.len() + 1);
    for (cell, line) in cells.iter().zip(csv.lines().skip(1)) {
        let fields: Vec<&str> = line.splitn(5, ',').collect();
        assert_eq!(cell["id"], fields[0]);
        assert_eq!(cell["verdict"], fields[3]);
        // Of the definitions some have commas, and none a quotation mark.
        let definition = fields[4].trim_matches('"');
        assert_eq!(cell["definition"], definition);
        assert_eq!(fields[4] != definition, definition.contains(','), "{line}");
    }
    let cell = cells.iter().find(|cell| cell["id"] == "T4.rk4.0.01").unwrap();
    assert_eq!(cell["stated"], 2.34e-7);
    let text = printed(&["paper", "tables", "--table", "4"]);
    assert!(
        text.starts_with("Table 4\nmax |Hₙ − H₀|") && text.contains("2.33759 × 10⁻⁷"),
        "{text}"
    );
}

/// The verdict is judged here too: it does not matter what the command prints it from.
///
/// Catches: claims lost on the way to the terminal, Markdown in it, a count that does not add up; a
/// verdict that the measurement no longer supports, and the one on record printed in its place.
#[test]
fn every_claim_is_upheld_and_counted() {
    let text = printed(&["paper", "claims"]);
    assert!(!text.contains("**") && !text.contains('`'), "{text}");
    let [readings, summary] = [0, 1].map(|line| text.lines().rev().nth(line).unwrap());
    let (total, counts) = summary.split_once(" claims: ").expect("a summary");
    let number = |words: &str| words.split(' ').next().unwrap().parse::<u32>().unwrap();
    assert_eq!(number(total), counts.split(", ").map(number).sum::<u32>());
    let claims = json(&["paper", "claims", "--format", "json"]);
    let claims = claims.as_array().unwrap();
    assert_eq!(claims.len() as u32, number(total) + number(readings));
    let of_kind = |kind| claims.iter().filter(|claim| claim["kind"] == kind).count();
    assert_eq!(of_kind("reading") as u32, number(readings));
    assert_eq!((of_kind("cell") + of_kind("sentence")) as u32, number(total));
    let stated: Vec<_> =
        LEDGER.claims().iter().filter(|claim| claim.verdict != Verdict::NotStated).collect();
    assert_eq!(claims.len(), stated.len());
    for (claim, object) in stated.into_iter().zip(claims) {
        assert_eq!(claim.judged(), claim.verdict, "{claim:?}");
        assert_eq!(object["id"], claim.id);
        assert_eq!(object["verdict"], claim.judged().to_string(), "{object}");
        assert_eq!(object["recorded"], claim.verdict.to_string(), "{object}");
    }
}

/// Catches: a preprocessor that accepts anything as a book.
#[test]
fn bad_protocol_input_is_refused_in_one_line() {
    let mut input = tempfile::tempfile().unwrap();
    input.write_all(b"{}").unwrap();
    input.rewind().unwrap();
    let line =
        refused(&process::Command::new(PENDULA).arg("preprocess").stdin(input).output().unwrap());
    assert!(line.contains("[context, book]"), "{line}");
}

/// Catches: a `supports` that mdBook reads the wrong way round.
#[test]
fn only_html_is_supported() {
    assert_eq!(pendula(["preprocess", "supports", "html"]).status.code(), Some(0));
    let output = pendula(["preprocess", "supports", "epub"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(output.stderr.is_empty());
}

/// Catches: a book that is not where the command says, or not without a word more.
#[test]
fn the_book_is_where_the_command_says() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    for (name, text) in [
        ("book/book.toml", "[build]\nbuild-dir = \"../target/book\"\n[preprocessor.pendula]\n"),
        ("book/src/SUMMARY.md", "# Summary\n\n* [One](one.md)\n"),
        ("book/src/one.md", "# One\n"),
        ("benches/work-precision.svg", "<svg></svg>\n"),
    ] {
        fs::create_dir_all(at(name).parent().unwrap()).unwrap();
        fs::write(at(name), text).unwrap();
    }
    let mut command = process::Command::new(PENDULA);
    let Output { status, stdout, stderr } =
        command.arg("book").current_dir(at("book/src")).output().unwrap();
    let printed = String::from_utf8(stdout).unwrap();
    assert!(status.success() && stderr.is_empty(), "{}", String::from_utf8_lossy(&stderr));
    let index = fs::canonicalize(at("target/book/index.html")).unwrap();
    assert_eq!(printed, format!("{}\n", index.display()));
}

/// A swing that is drawn.
const RUN: [&str; 9] =
    ["simulate", "--method", "rk4", "--theta0", "pi/3", "--dt", "0.1", "--duration", "20"];

/// Catches: rows lost or changed by the picture; a file that is no SVG, or without title,
/// description, unit or paper; columns exchanged; energies for changes of energy; a file left
/// beside it.
#[test]
fn a_plot_shows_the_rows() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("swing.svg");
    let text = printed(&[&RUN[..], &["--plot", path.to_str().unwrap()]].concat());
    assert_eq!(text, printed(&RUN));
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    let svg = fs::read_to_string(&path).unwrap();
    let document = Document::parse(&svg).unwrap();
    let of = |name: &str| {
        let nodes = document.descendants().filter(|node| node.has_tag_name(name));
        let texts = nodes.flat_map(|node| node.descendants().filter(|node| node.is_text()));
        let text = texts.filter_map(|node| node.text());
        text.map(|text| text.split_whitespace().collect::<Vec<_>>().join(" ")).collect::<Vec<_>>()
    };
    insta::assert_snapshot!([of("title"), of("desc"), of("text")].concat().join("\n"));
    assert!(svg.contains("class=\"paper\"") && svg.contains("prefers-color-scheme:dark"));
}

/// Catches: a plot that a command does not draw, or not of its rows: a sweep over steps on a linear
/// axis, or one over angles against the step; one of two rods left out; rows printed among the
/// dots; a picture without its axes, upside down or mirrored; a line that jumps, or bridges what
/// has no place on a logarithmic axis, as the error of a pendulum at rest.
#[test]
fn each_command_that_integrates_draws() {
    let drawn = [
        "simulate --method dop853 --theta0 3 --duration -5 --tolerance 1e-6",
        "simulate --system double-pendulum --theta1 2 --theta2 1 --dt 0.01 --steps 300",
        "sweep --method rk4 --duration 1 --theta0 -1:2:7 --dt 0.1",
        "sweep --method rk4 --duration 1 --theta0 1 --dt 0.1:0.001:5",
    ]
    .map(|line| format!("$ pendula {line}\n{}\n", printed(&words(&format!("{line} --plot -")))));
    insta::assert_snapshot!(drawn.concat());
}

/// A double pendulum in steps that vary beside the same in steps of 1 ms. Both are off by some 1e-9
/// a second, and in 2 s neighbours part by less than a hundredfold.
///
/// Catches: a tolerance that is refused where it matters most; one that is not kept; another
/// system.
#[test]
fn two_rods_keep_a_tolerance() {
    let scene = "simulate --system double-pendulum --theta1 2 --theta2 1 --omega2 -1 --mass2 3";
    let end = |line: &str| numbers(&printed(&words(&format!("{scene} {line}")))).pop().unwrap();
    let right = end("--dt 0.001 --duration 2");
    for method in ["dop853", "dormand-prince"] {
        let row = end(&format!("--method {method} --tolerance 1e-9 --duration 2"));
        let far = row.iter().zip(&right).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
        assert!(far < 1e-6, "{method}: {far:e}");
    }
}

/// Catches: as many threads as the environment asks for, which takes minutes and all memory.
#[test]
fn too_many_threads_are_refused() {
    for count in ["100000", "-1", "many"] {
        let mut sweep = process::Command::new(PENDULA);
        sweep.args(words("sweep --method rk4 --theta0 0:1:3 --dt 0.1 --duration 1"));
        let line = refused(&sweep.env("RAYON_NUM_THREADS", count).output().unwrap());
        assert!(line.contains("it must be a whole number, at most"), "{line}");
    }
}

/// Catches: rows lost where there is a file for them; a picture left by a run that fails; rows that
/// appear although their picture cannot.
#[test]
fn a_plot_in_the_terminal_stands_for_the_rows() {
    let text = printed(&[&RUN[..], &["--plot", "-"]].concat());
    assert!(text.starts_with("RK4, Δt = 0.1 s\n\nangle θ (rad)\n"), "{text}");
    assert!(text.ends_with("\nt (s) from 0 to 20\n") && !text.contains("t,theta"), "{text}");
    let folder = tempfile::tempdir().unwrap();
    let [rows, plot] = ["rows.csv", "plot.svg"].map(|name| folder.path().join(name));
    let to_file = [&RUN[..], &["--plot", "-", "--output", rows.to_str().unwrap()]].concat();
    assert_eq!(printed(&to_file), text);
    assert_eq!(fs::read_to_string(&rows).unwrap(), printed(&RUN));

    let failing = ["simulate", "--method", "forward-euler", "--theta0", "1", "--dt", "1e200"];
    let to_plot = ["--steps", "9", "--plot", plot.to_str().unwrap()];
    assert_eq!(pendula([&failing[..], &to_plot].concat()).status.code(), Some(2));
    assert!(!plot.exists());
    if Path::new("/dev/full").exists() {
        let whole = folder.path().join("whole.csv");
        let to_both = ["--plot", "/dev/full", "--output", whole.to_str().unwrap()];
        assert_eq!(pendula([&RUN[..], &to_both].concat()).status.code(), Some(2));
        assert!(!whole.exists());
    }
}
