//! The results that the README shows must equal those of the snapshots.

use std::fs;

use pendula::arithmetic::sine::sin;
use pendula::exact::Motion;
use pendula::{Grid, Pendulum, Phase, method_named};
use pendula_judge::{Claims, FromFn, judge};
use pendula_study::claims::cell_id;
use pendula_study::experiments::PaperMethod;
use pendula_study::report::readme::{Picture, pictures};

use crate::{LEDGER, STUDY, at_root};

fn read(path: &str) -> String {
    fs::read_to_string(at_root(path)).expect(path)
}

/// Catches: a headline table that was not updated when a number changed.
#[test]
fn the_headline_table_is_table_5() {
    let readme = read("README.md");
    for method in PaperMethod::ALL {
        let claim = LEDGER.get(&cell_id(5, method, "dH")).expect("every method has a row");
        let (stated, measured) = (claim.stated_text(), claim.measured_text());
        let row = format!("| {:<16} | {stated:>10} | {measured:>14} |", method.title());
        assert!(readme.contains(&row), "the README lacks\n{row}");
    }
}

/// Of the README's function, written in Rust.
///
/// Catches: words of the judge that it no longer says.
#[test]
fn the_report_ends_as_the_readme_says() {
    let verlet = FromFn(|g: f64, mut theta: f64, mut omega: f64, h: f64, n: u64| {
        (0..n).map(move |_| {
            omega -= h / 2.0 * g * sin(theta);
            theta += h * omega;
            omega -= h / 2.0 * g * sin(theta);
            (theta, omega)
        })
    });
    let report = judge(&verlet, Claims::order(2).symplectic().symmetric()).to_string();
    let mut last = report.trim_end().lines().rev();
    let (verdict, name) = (last.next().expect("a verdict"), last.next().expect("a name"));
    let (name, how_nearly) = name.split_once("): ").expect("a name and how nearly it is that");
    assert!(how_nearly.starts_with("eight steps agree to "), "{report}");
    let readme = read("README.md").split_whitespace().collect::<Vec<_>>().join(" ");
    let says = format!("`{name})`, and ends with `{verdict}`");
    assert!(readme.contains(&says), "the README does not say {says}");
}

/// Catches: a number of claims that was not updated with the ledger, in the README or in the book.
#[test]
fn the_number_of_claims_is_that_of_the_ledger() {
    let count = LEDGER.claims().iter().filter(|claim| claim.is_of_the_paper()).count();
    for (page, says) in [
        ("README.md", format!("{count} claims of the paper")),
        ("book/src/introduction.md", format!("judges {count} claims")),
    ] {
        assert!(read(page).contains(&says), "{page} does not say {says}");
    }
}

/// Catches: a release whose citation names the one before.
#[test]
fn the_citation_is_of_this_version() {
    let says = concat!("\nversion: ", env!("CARGO_PKG_VERSION"), "\n");
    assert!(read("CITATION.cff").contains(says), "CITATION.cff does not say{says}");
}

/// To make the files again, run this test with `INSTA_UPDATE=always`, as for the snapshots.
///
/// Catches: a picture that was not made again when what it shows changed.
#[test]
fn the_pictures_are_what_the_study_draws() {
    let mut old = Vec::new();
    for Picture { path, svg } in pictures(&STUDY) {
        let file = at_root(&path);
        if std::env::var("INSTA_UPDATE").is_ok_and(|update| update == "always") {
            fs::write(&file, &svg).expect("the folder exists");
        }
        if !fs::read_to_string(&file).is_ok_and(|picture| picture == svg) {
            old.push(path);
        }
    }
    assert!(old.is_empty(), "not what the study draws: {old:?}");
}

/// The last of the values that the drawing's elements `name` take, in the order of the document.
fn last_values<'a>(drawing: &'a roxmltree::Document, name: &'a str) -> Vec<f64> {
    let elements = drawing.descendants().filter(|node| node.has_tag_name(name));
    let last = |node: roxmltree::Node| {
        let values = node.attribute("values").expect("values");
        values.rsplit(';').next().and_then(|value| value.parse().ok()).expect("a number")
    };
    elements.map(last).collect()
}

/// Angles are printed to a tenth of a degree.
///
/// Catches: pendulums that turn the wrong way; a ring that is not the exact motion, a rod of
/// another method's, a step or a length of the run that is not the one that is written.
#[test]
fn the_moving_picture_ends_where_the_library_does() {
    let svg = read("book/src/assets/four-pendulums.svg");
    let drawing = roxmltree::Document::parse(&svg).expect("an SVG");
    let (pendulum, start) = (Pendulum::PAPER, Phase::at_rest(-1.0));
    let exact = Motion::new(&pendulum, start).expect("a finite angle").at(12.0);
    let mut expected = Vec::new();
    for method in PaperMethod::ALL.map(|method| method_named(method.name()).expect("a method")) {
        let step = if method.info().name == "rk4" { 0.4 } else { 0.1 };
        let grid = Grid::with_duration(step, 12.0).expect("a whole number of steps");
        let end = method.run(&pendulum, start, &grid, &mut ());
        // An SVG's angles grow clockwise.
        expected.extend([-exact.theta.to_degrees(), -end.theta.to_degrees()]);
    }
    let found = last_values(&drawing, "animateTransform");
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(&expected) {
        assert!((found - expected).abs() <= 0.050_000_1, "{found} for {expected}");
    }
    // Who wants no motion sees the same, and nothing that moves.
    let svg = read("book/src/assets/four-pendulums-at-rest.svg");
    let at_rest = roxmltree::Document::parse(&svg).expect("an SVG");
    let turned = at_rest.descendants().filter_map(|node| node.attribute("transform"));
    let angle = |turn: &str| turn.strip_prefix("rotate(")?.strip_suffix(')')?.parse().ok();
    assert_eq!(turned.filter_map(angle).collect::<Vec<f64>>(), found);
    assert!(!svg.contains("<animate"));
}

/// Catches: a picture that makes the README slow to open; one whose movement cannot be stopped by
/// a reader's system; a first image that is another.
#[test]
fn the_moving_picture_is_light_and_can_be_stopped() {
    const AT_MOST: usize = 60_000;
    let (readme, svg) = (read("README.md"), read("book/src/assets/four-pendulums.svg"));
    assert!(svg.len() <= AT_MOST, "{} bytes", svg.len());
    assert!(svg.contains("@media (prefers-reduced-motion:reduce)"));
    let first = readme.split_once("<picture>").expect("a picture").1;
    let calm = "media=\"(prefers-reduced-motion: reduce)\" \
                srcset=\"book/src/assets/four-pendulums-at-rest.svg\"";
    assert!(first.contains(calm) && first.contains("src=\"book/src/assets/four-pendulums.svg\""));
    let images = readme.lines().filter(|line| line.starts_with("![") || line.contains("<img"));
    assert!(images.take(1).all(|line| line.contains("four-pendulums.svg")));
}

/// Catches: a README that names another version, licence or version of Rust than the manifest that
/// Cargo reads.
#[test]
fn the_version_is_that_of_the_manifest() {
    let (manifest, readme) = (read("Cargo.toml"), read("README.md"));
    for (key, before, after) in [
        ("version", "Version ", " "),
        ("license", "[", "]"),
        ("rust-version", "[Rust ", " or newer]"),
    ] {
        let line = manifest.lines().find_map(|line| line.strip_prefix(&format!("{key} = \"")));
        let value = line.and_then(|rest| rest.strip_suffix('"')).expect(key);
        let says = format!("{before}{value}{after}");
        assert!(readme.contains(&says), "the README does not say {says}");
    }
}

/// A forge shows a README about this many columns of code wide.
///
/// Catches: a command or its comment that is cut off there.
#[test]
fn no_line_of_code_is_cut_off() {
    const COLUMNS: usize = 80;
    let readme = read("README.md");
    let blocks: Vec<&str> = readme.split("\n```").collect();
    assert!(blocks.len() > 10, "blocks of code and what stands between");
    for line in blocks.iter().skip(1).step_by(2).flat_map(|block| block.lines().skip(1)) {
        assert!(line.chars().count() <= COLUMNS, "wider than {COLUMNS}: {line}");
    }
}
