//! `pendula sweep flips`: its rows against runs one by one, its picture against its rows, and the
//! picture that the book shows; `pendula sweep devices` and `pendula sweep --device`.

use std::collections::BTreeSet;
use std::f64::consts::PI;
use std::fs;
use std::io::Cursor;
use std::path::Path;
use std::process::{Command, Output};

use pendula::fast::first_flips;
use pendula::integrate::Record;
use pendula::methods::table::RK4_IN_LANES;
use pendula::systems::{DoublePhase, Joint};
use pendula::{DoublePendulum, Grid, Rk4, integrate};

use crate::long_runs::interrupted;
use crate::{PENDULA, assert_refused, printed, words};

/// The dots of a picture, row after row from the top: red, green, blue, opacity.
fn dots(png: &[u8]) -> (usize, Vec<[u8; 4]>) {
    let mut decoder = png::Decoder::new(Cursor::new(png));
    decoder.set_transformations(png::Transformations::ALPHA);
    let mut reader = decoder.read_info().expect("a picture");
    let mut bytes = vec![0; reader.output_buffer_size().expect("it fits")];
    let frame = reader.next_frame(&mut bytes).expect("a picture");
    let (dots, _) = bytes.as_chunks::<4>();
    (frame.width as usize, dots.to_vec())
}

/// The times in the last column; none where it is empty.
fn times(csv: &str) -> Vec<Option<f64>> {
    let cell = |line: &str| line.rsplit(',').next().and_then(|cell| cell.parse().ok());
    csv.lines().skip(1).map(cell).collect()
}

fn equals() -> DoublePendulum {
    DoublePendulum::of_equals(9.81, Joint { length: 1.0, mass: 1.0 }).expect("positive")
}

/// The angles (rad) are the middles of the parts of a turn, and the time is that of the first state
/// beyond π, also where no step was taken for want of energy or since a mirrored motion was known.
///
/// Catches: rows in another order, angles at the ends of the parts, a mirror that exchanges the
/// rods or turns one alone, a time one step off, a release without enough energy that has it.
#[test]
fn each_row_is_a_run() {
    let csv = printed(&["sweep", "flips", "--size", "12", "--duration", "6"]);
    let mut rows = csv.lines();
    assert_eq!(rows.next(), Some("theta1,theta2,t"));
    let (double, grid) = (equals(), Grid::with_duration(0.01, 6.0).expect("positive"));
    let middle = |i: usize| PI * (2.0 * i as f64 - 11.0) / 12.0;
    for (index, row) in rows.by_ref().take(144).enumerate() {
        let theta = [middle(index % 12), middle(index / 12)];
        let start = double.start(theta, [0.0; 2]).expect("finite");
        let mut states = [DoublePhase::default(); 601];
        integrate(&double, &Rk4, start, &grid, &mut Record::new(&mut states));
        let is_past = |z: &DoublePhase| z.theta1.abs() > PI || z.theta2.abs() > PI;
        let time = states.iter().position(is_past).map(|n| format!("{:?}", grid.time(n as u64)));
        let [theta1, theta2] = theta;
        assert_eq!(row, format!("{theta1:?},{theta2:?},{}", time.unwrap_or_default()));
    }
    assert_eq!(rows.next(), None);
}

/// Catches: a picture upside down or mirrored, colours that do not go with the time, a band left
/// out, a release that never turns over drawn in a colour; rows packed without their own bytes.
#[test]
fn the_later_the_darker() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("flips.png");
    let path = file.to_str().expect("UTF-8");
    let csv = printed(&["sweep", "flips", "--size", "50", "--duration", "20", "--picture", path]);
    let times = times(&csv);
    let (width, dots) = dots(&fs::read(&file).expect("a file"));
    assert_eq!((width, dots.len()), (50, 2500));
    let lightness = |[red, green, blue, _]: [u8; 4]| {
        0.2126 * f64::from(red) + 0.7152 * f64::from(green) + 0.0722 * f64::from(blue)
    };
    let mut seen = Vec::new();
    for (row, dots) in dots.chunks(50).rev().enumerate() {
        for (column, dot) in dots.iter().enumerate() {
            let time = times[row * 50 + column];
            assert_eq!(dot[3], if time.is_some() { 255 } else { 0 }, "{row}, {column}");
            seen.extend(time.map(|time| (time, lightness(*dot))));
        }
    }
    seen.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert!(seen.is_sorted_by(|a, b| a.1 >= b.1), "a later one is lighter");
    let bands: BTreeSet<u64> = seen.iter().map(|(_, light)| light.to_bits()).collect();
    // Between the rods that fall over at once and those of the next swing there is hardly a time.
    assert!(bands.len() >= 14, "{bands:?}");
}

/// The book's picture of a million releases, a part of its dots computed again: every 89th, in all
/// columns and rows.
///
/// Catches: a picture of an older method or of other numbers than the chapter says; a key of other
/// colours.
#[test]
fn the_picture_of_the_book_is_what_the_command_draws() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let png = fs::read(root.join("book/src/assets/flips.png")).expect("the picture");
    let (width, dots) = dots(&png);
    assert_eq!((width, dots.len()), (1000, 1_000_000));
    // The key to its colours, beside it.
    let figure = fs::read_to_string(root.join("book/src/assets/flips.svg")).expect("the figure");
    let colours = dots.iter().filter(|dot| dot[3] > 0);
    let colours: BTreeSet<String> =
        colours.map(|[red, green, blue, _]| format!("#{red:02x}{green:02x}{blue:02x}")).collect();
    assert_eq!(colours.len(), 15);
    assert!(colours.iter().all(|colour| figure.contains(&format!("fill=\"{colour}\""))));
    let middle = |i: usize| PI * (2.0 * i as f64 - 999.0) / 1000.0;
    let (double, grid) = (equals(), Grid::with_duration(0.01, 20.0).expect("positive"));
    let places: Vec<usize> = (0..1_000_000).step_by(89).collect();
    let start = |place: &usize| {
        let theta = [middle(place % 1000), middle(999 - place / 1000)];
        double.start(theta, [0.0; 2]).expect("finite")
    };
    let starts: Vec<DoublePhase> = places.iter().map(start).collect();
    let mut flips = vec![None; starts.len()];
    first_flips(&double, RK4_IN_LANES, &starts, &grid, &mut flips);
    let mut drawn = Vec::new();
    let bands = pendula_program::commands::sweep::flips::Bands::of(grid.steps());
    bands.write([&flips[..]].into_iter(), &mut drawn).expect("a buffer");
    let (_, expected) = self::dots(&drawn);
    for (place, expected) in places.iter().zip(expected) {
        assert_eq!(dots[*place], expected, "{place}");
    }
}

/// Interrupted after any number of rows, it leaves the old files, and nothing beside them.
///
/// Catches: a file touched, or a temporary one left, by a search that is interrupted; a row count
/// that is not looked at.
#[test]
fn an_interrupted_search_leaves_the_old_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let files = ["a.csv", "a.png"].map(|name| folder.path().join(name));
    let [csv, png] = files.each_ref().map(|path| path.to_str().expect("UTF-8"));
    let flips = ["sweep", "flips", "--size", "4", "--output", csv, "--picture", png];
    for rows in [0, 1, 15] {
        for path in &files {
            fs::write(path, "old").expect("it can be written");
        }
        let left = interrupted(&flips, rows);
        assert_eq!(left.outcome.unwrap_err(), "pendula: interrupted", "after {rows}");
        assert!(files.iter().all(|path| fs::read(path).expect("a file") == b"old"));
        assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 2);
    }
    interrupted(&flips, 16).outcome.expect("whole");
    assert!(files.iter().all(|path| fs::read(path).expect("a file") != b"old"));
}

/// Distinct names of the devices, as they are printed. Where there is none, the tests that need one
/// say so, and do not run.
fn devices() -> Vec<String> {
    if let Err(error) = pendula_device::devices() {
        println!("not run: {error}");
        return Vec::new();
    }
    let lines = printed(&["sweep", "devices"]);
    let of = |line: &str| line.split("  ").next().map(str::to_owned);
    lines.lines().map(|line| of(line).expect("a name")).collect()
}

/// Every method, from all sorts of starts, is compared in `tests/device/bits.rs`.
///
/// Catches: a device that has other bits than the lanes; another order of the rows; an energy error
/// of other samples.
#[test]
fn a_sweep_on_a_device_is_the_same_to_the_byte() {
    for name in devices() {
        // Half a name, in the other case.
        let half: String = name.chars().take(name.chars().count() / 2).collect();
        let half = half.to_uppercase();
        for method in ["rk4", "stormer-verlet", "processed-6"] {
            let sweep = "--theta0 -3.1:3.14:4096 --dt 0.05 --duration 2";
            let lanes = format!("sweep --method {method} {sweep}");
            let on_device = [&words(&lanes)[..], &["--device", &half]].concat();
            assert_eq!(printed(&on_device), printed(&words(&lanes)), "{method} on {name}");
        }
    }
}

/// Catches: a sweep that runs in lanes after all; a file that is begun before the device is known.
#[test]
fn what_a_device_cannot_do_is_refused() {
    let sweep = ["sweep", "--theta0", "0:3:9", "--dt", "0.1", "--duration", "1", "--method"];
    let with = |more: &[&'static str]| [&sweep[..], more].concat();
    if let Some(name) = devices().first() {
        assert_refused(&with(&["gauss-4", "--device", "p"]), "gauss-4 does not run on a device");
        assert_refused(&with(&["rk4", "--device", "no such"]), name);
    }
}

/// Catches: a program that cannot start where there is no driver, that panics, or that runs in
/// lanes; an empty list that is a failure, or says nothing.
#[test]
#[cfg(target_os = "linux")]
fn where_there_is_no_platform_one_line_says_so() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("rows.csv");
    let sweep = ["sweep", "--method", "rk4", "--theta0", "0:3:9", "--dt", "0.1", "--duration", "1"];
    let output = ["--device", "x", "--output", file.to_str().expect("UTF-8")];
    for (arguments, expected) in
        [(&["sweep", "devices"][..], 0), (&[&sweep[..], &output].concat(), 2)]
    {
        let Output { status, stdout, stderr } = Command::new(PENDULA)
            .args(arguments)
            .env("OCL_ICD_VENDORS", folder.path())
            .output()
            .expect("it starts");
        assert_eq!(status.code(), Some(expected));
        let expected =
            "pendula: there is no OpenCL platform on this machine, or no driver for one\n";
        assert_eq!(String::from_utf8_lossy(&stderr), expected);
        assert!(stdout.is_empty() && !file.exists());
    }
}
