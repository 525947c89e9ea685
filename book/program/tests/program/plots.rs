//! `--plot`: pictures in files and in the terminal.

use std::fs;

use roxmltree::Document;

use crate::{pendula, printed, words};

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
    if std::path::Path::new("/dev/full").exists() {
        let whole = folder.path().join("whole.csv");
        let to_both = ["--plot", "/dev/full", "--output", whole.to_str().unwrap()];
        assert_eq!(pendula([&RUN[..], &to_both].concat()).status.code(), Some(2));
        assert!(!whole.exists());
    }
}
