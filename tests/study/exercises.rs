//! The solutions of exercises that ask the reader to change a listing and to run it.
//!
//! Such a solution has the whole changed listing, which runs as a test, and shows of it the lines
//! that the reader changes. Its output stands below it, as below any other listing.

use std::fs;
use std::path::Path;

/// The Rust listings of a text, without those that do not run.
fn listings(text: &str) -> Vec<Vec<&str>> {
    let blocks = text.split("```rust\n").skip(1);
    blocks.map(|block| block.lines().take_while(|line| *line != "```").collect()).collect()
}

/// The lines of a listing but for those that hold its output to what is shown, and whether each is
/// hidden.
fn code<'a>(listing: &[&'a str]) -> Vec<(&'a str, bool)> {
    let output = listing.iter().position(|line| line.starts_with("# assert_eq!(printed()"));
    let end = listing.iter().position(|line| *line == "# \");");
    let is_output = |n: &usize| output <= Some(*n) && Some(*n) <= end;
    let lines = listing.iter().enumerate().filter(|(n, _)| !is_output(n));
    lines
        .map(|(_, &line)| match line.strip_prefix("# ") {
            Some(hidden) => (hidden, true),
            None if line == "#" => ("", true),
            None => (line, false),
        })
        .collect()
}

/// Whether a solution is this listing but for lines that it shows: its hidden lines are those of
/// the listing, one after the other, and what is left out of the listing has been replaced by lines
/// that are shown.
fn is_changed_where_shown(solution: &[(&str, bool)], listing: &[(&str, bool)]) -> bool {
    let (mut at, mut is_shown) = (0, false);
    for (line, is_hidden) in solution {
        if !is_hidden {
            is_shown = true;
            continue;
        }
        let Some(ahead) = listing[at..].iter().position(|(other, _)| other == line) else {
            return false;
        };
        if ahead > 0 && !is_shown {
            return false;
        }
        (at, is_shown) = (at + ahead + 1, false);
    }
    at == listing.len() || is_shown
}

/// Catches: a solution whose hidden lines are those of a program that the page does not show, so
/// that the reader who changes the shown ones gets something else; an exercise that asks for a run
/// and has no solution that runs.
#[test]
fn a_solution_shows_all_that_is_changed() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../src");
    let page = |name: &str| fs::read_to_string(folder.join(name)).unwrap();
    let first = page("introduction.md");
    for (name, count) in [
        ("introduction.md", 1),
        ("stormer-verlet.md", 1),
        ("order.md", 2),
        ("phase-space.md", 2),
        ("small-angle.md", 1),
        ("limits.md", 1),
    ] {
        let text = page(name);
        let (chapter, exercises) = text.split_once("\n## Exercises\n").unwrap();
        let (_, exercises) = exercises.split_once("<details>").unwrap();
        let (first, _) = first.split_once("\n## Exercises\n").unwrap();
        let shown: Vec<_> = [listings(chapter), listings(first)].concat();
        let solutions = listings(exercises).into_iter().map(|listing| code(&listing));
        let changed: Vec<_> = solutions
            .filter(|lines| lines.iter().filter(|(_, is_hidden)| *is_hidden).count() > 3)
            .collect();
        assert_eq!(changed.len(), count, "{name}");
        for lines in changed {
            let is_one = shown.iter().any(|listing| is_changed_where_shown(&lines, &code(listing)));
            assert!(is_one, "{name}: it is no listing but for what is shown: {lines:#?}");
            assert!(lines.iter().any(|(_, is_hidden)| !is_hidden), "{name}: nothing is shown");
        }
    }
}
