//! `pendula review`: what it says of changes that are known, and how it fails.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;

use pendula_book::review::rows::Row;
use pendula_book::review::verdict::{Weight, sentences};
use pendula_book::review::versions::{Version, on_disk};
use pendula_book::review::working_tree::{WorkingTree, contents};
use pendula_book::review::{Review, markdown, page, text};
use tempfile::TempDir;

use crate::chapters::chapters;
use crate::pages::Page;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

static REVIEWED: LazyLock<Version> =
    LazyLock::new(|| contents(&on_disk(&root().join("snapshots"), ".snap").unwrap()));

/// The reviewed snapshots with other texts in some of them.
fn changed(edits: &[(&str, &str, &str)]) -> Version {
    let mut version = REVIEWED.clone();
    for (name, from, to) in edits {
        let content = version.get_mut(*name).unwrap();
        assert!(content.text.contains(from), "{name} has no {from}");
        content.text = content.text.replace(from, to);
    }
    version
}

fn review(edits: &[(&str, &str, &str)]) -> Review {
    let versions = ["then".to_string(), "now".to_string()];
    let chapters = root().join("book/src");
    Review::new(versions, &REVIEWED, &changed(edits), &chapters).unwrap()
}

/// What half kicks of 0.4999 h do to one of Störmer–Verlet's cells, wherever it stands, and to a
/// slope.
const HALF_KICKS: [(&str, &str, &str); 5] = [
    ("table_4", "  1.10271 × 10⁻⁵", "≠ 1.11730 × 10⁻⁵"),
    ("predictions", "1.10271 × 10⁻⁵ |   1.10271 × 10⁻⁵ |", "1.10271 × 10⁻⁵ | ≠ 1.11730 × 10⁻⁵ |"),
    (
        "ledger_cells",
        "1.10271 × 10⁻⁵ | reproduced |",
        "1.11730 × 10⁻⁵ | ≠ **wrong** (on record: reproduced) |",
    ),
    (
        "orders",
        "| Störmer–Verlet    |     2 |       0.010547 |    2.00 |    2.00 |    2.00 |    2.00 |",
        "| Störmer–Verlet    |     2 |       0.010547 |    2.00 |    2.00 |    2.00 |  ≠ 2.11 |",
    ),
    ("bits", "c2c47d4665baff4a", "c2c47d4665baff4b"),
];

fn said(review: &Review, weight: Weight) -> Vec<String> {
    let sentences = sentences(review).into_iter().filter(|sentence| sentence.weight == weight);
    sentences.map(|sentence| sentence.text).collect()
}

/// Catches: a verdict that leaves out what no longer is as it should be, or counts a cell for each
/// table that repeats it.
#[test]
fn the_verdict_comes_first() {
    assert_eq!(
        said(&review(&HALF_KICKS), Weight::Alarm),
        [
            "1 cell no longer meets the paper: T4.vv.0.001 (stated 1.10 × 10⁻⁵, now 1.11730 × \
             10⁻⁵).",
            "1 slope left the window around the order: Störmer–Verlet, slope 4 (2.00 → 2.11).",
            "1 cell that theory predicts moved, 1 out of the tolerance: T4.vv.0.001.",
        ]
    );
    assert_eq!(
        said(&review(&HALF_KICKS), Weight::Moved),
        [
            "2 quantities moved, for 2 causes, the largest change +5.50 % (Störmer–Verlet: order \
             of the state's error, slope 4).",
            "The bits of 1 result moved: stormer-verlet in steps.",
        ]
    );
}

/// Catches: a row that is shown once for each table it is in, with digits that its first table
/// rounds away, or without what theory and the paper say of it.
#[test]
fn each_quantity_is_shown_once() {
    let review = review(&HALF_KICKS);
    let titles: Vec<String> = review.groups.iter().map(|group| group.cause.title()).collect();
    assert_eq!(
        titles,
        [
            "Störmer–Verlet: order of the state's error",
            "Störmer–Verlet: energy error over 50 s (Table 4)"
        ]
    );
    let [item] = &review.groups[1].items[..] else { panic!("{:?}", review.groups[1]) };
    let row = Row::new(item);
    assert_eq!((row.label.as_str(), row.claim.as_str()), ("Δt = 0.001 s", "T4.vv.0.001"));
    assert_eq!((row.old.as_str(), row.new.as_str()), ("1.10271 × 10⁻⁵", "≠ 1.11730 × 10⁻⁵"));
    // (1.11730 − 1.10271)/1.11730 is 435 times 3e-5; 1.11730 is 3.46 halves of 0.01 from 1.10.
    assert_eq!((row.change.as_str(), row.theory.as_str()), ("+1.32 %", "0 → 435"));
    assert_eq!(row.paper, "0.54 → 3.46");
    let also: Vec<&str> = row.also.iter().map(|place| place.snapshot.as_str()).collect();
    assert_eq!(also, ["predictions", "ledger_cells"]);
}

/// Forward Euler's gain in the long run is quoted in several chapters.
///
/// Catches: a quote whose place is no file, or a line of it where another sentence stands; a
/// chapter that quotes what moved and is overlooked.
#[test]
fn a_quote_stands_where_it_says() {
    let review = review(&[("ledger_cells", "481.797 | reproduced |", "482.001 | reproduced |")]);
    let mut quoting = BTreeSet::new();
    for quote in &review.quotes {
        let source = root().join("book/src").join(&quote.chapter).with_extension("md");
        let source = fs::read_to_string(&source).unwrap_or_else(|_| panic!("no {source:?}"));
        let heading =
            source.lines().find(|line| line.starts_with('#') && line.ends_with(&quote.heading));
        assert!(heading.is_some(), "{quote:?}");
        // The line where it begins, and the next, without what the quote leaves out.
        let lines = source.lines().skip(quote.line - 1).take(2).collect::<Vec<_>>().join(" ");
        let lines = lines.replace(['*', '[', ']'], "");
        let begins = quote.sentence.split(' ').take(3).collect::<Vec<_>>().join(" ");
        assert!(lines.contains(&begins), "{quote:?}\n{lines}");
        quoting.insert(quote.chapter.clone() + ".md");
    }
    let quotes = |text: &str| text.contains("{{measured T5.fe.dH}}");
    let expected = chapters().into_iter().filter(|(_, text)| quotes(text)).map(|(file, _)| file);
    assert_eq!(quoting, expected.collect());
    assert!(quoting.len() > 1, "{quoting:?}");
}

/// Catches: a claim that turns unseen, and one whose reason alone was changed taken for one that
/// turned.
#[test]
fn claims_that_turn_are_told_from_new_reasons() {
    let review = review(&[
        (
            "ledger_sentences",
            "**not checkable**. The code is not supplied, and Section 8",
            "**wrong**. The code, says Section 8,",
        ),
        ("ledger_sentences", "Table 3 has the same.", "So has Table 3."),
    ]);
    let turns: Vec<_> = review.claims.iter().map(|t| (t.id.as_str(), t.flips())).collect();
    assert_eq!(turns, [("P1.lines200", true), ("T1.g", false)]);
}

/// Catches: a figure that moved by less than one can see shown among those that did, and a figure
/// whose label is another taken for one that did not move.
#[test]
fn figures_are_shown_if_one_can_see_the_difference() {
    let review = review(&[
        ("figure_2", "M397.2,97.8l", "M397.2,97.6l"),
        ("figure_3", "</text>", "!</text>"),
        ("area", "M", " M"),
    ]);
    let seen: Vec<_> = review.figures.iter().map(|f| (f.name.as_str(), f.is_visible())).collect();
    assert_eq!(seen, [("figure_3", true), ("area", false), ("figure_2", false)]);
    assert!(
        said(&review, Weight::Moved)[0].starts_with("Of 3 figures that differ 1 moved visibly")
    );
}

/// Catches: a review of nothing that finds something, or says that it does.
#[test]
fn nothing_moves_by_nothing() {
    let review = review(&[]);
    assert!(review.is_empty() && review.quotes.is_empty());
    let nothing = format!("Nothing moved: all {} snapshots are the same.", REVIEWED.len());
    assert_eq!(said(&review, Weight::Calm), [nothing]);
}

/// Catches: a page that is not HTML, loads something, uses an id twice, leaves out a figure, a
/// table or a command, or shows a drawing in the other's place; text and Markdown that leave out
/// what the page shows.
#[test]
fn the_page_is_whole_and_needs_nothing_else() {
    let mut review = review(&[
        HALF_KICKS[0],
        HALF_KICKS[2],
        HALF_KICKS[4],
        ("figure_3", "</text>", "!</text>"),
        ("figure_2", "M397.2,97.8l", "M397.2,97.6l"),
    ]);
    review.acceptable = true;
    let html = page::html(&review, &root()).unwrap();
    let parsed = Page::parse(&html);
    assert_eq!(parsed.repeated_ids(), [""; 0]);
    let loaded = parsed.references.iter().find(|(tag, _)| tag != "a");
    assert!(loaded.is_none() && !html.contains("@import"), "{loaded:?}");
    assert!(html.contains("default-src 'none'"));
    let drawn = |id: &str| {
        let (_, drawing) = html.split_once(id).unwrap_or_else(|| panic!("no {id}"));
        let (drawing, _) = drawing.split_once("</svg>").unwrap();
        ["M397.2,97.8l", "M397.2,97.6l"].map(|path| drawing.contains(path))
    };
    assert_eq!(drawn("id=\"old-fig-figure-2\""), [true, false]);
    assert_eq!(drawn("id=\"new-fig-figure-2\""), [false, true]);
    for part in [
        "Störmer–Verlet: energy error over 50 s (Table 4)",
        "id=\"old-fig-figure-3\"",
        "id=\"new-fig-figure-2\"",
        "review --accept table_4 ledger_cells",
        "* Störmer–Verlet: energy error over 50 s (Table 4): 1 value, +1.32 %",
        "* stormer-verlet in steps: other last digits, because …. Moved: ",
    ] {
        assert!(html.contains(part), "the page lacks {part}");
    }
    let printed = |write: fn(&Review, &mut dyn std::io::Write) -> std::io::Result<()>| {
        let mut out = Vec::new();
        write(&review, &mut out).unwrap();
        String::from_utf8(out).unwrap()
    };
    for out in [printed(text::write), printed(markdown::write)] {
        for part in ["T4.vv.0.001", "1.11730 × 10⁻⁵", "+1.32 %", "figure_3", "review --accept"]
        {
            assert!(out.contains(part), "{part} is not in {out}");
        }
    }
}

// -------------------------------------------------------------------------------------------------
// A project of its own
// -------------------------------------------------------------------------------------------------

/// A project with some of the snapshots, in a repository with one commit.
struct Project(TempDir);

impl Project {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        let at = |path: &str| folder.path().join(path);
        fs::create_dir_all(at("book/src")).unwrap();
        fs::create_dir(at("snapshots")).unwrap();
        fs::write(at("book/book.toml"), "[preprocessor.pendula]\n").unwrap();
        for name in ["1_table_4", "1_slopes", "2_figure_2", "3_bits"] {
            let path = format!("snapshots/{name}.snap");
            fs::copy(root().join(&path), at(&path)).unwrap();
        }
        let project = Self(folder);
        for arguments in [
            &["init", "--quiet"][..],
            &["add", "."],
            &["-c", "user.name=a", "-c", "user.email=a@b", "commit", "--quiet", "-m", "first"],
        ] {
            let git = Command::new("git").arg("-C").arg(project.0.path()).args(arguments).status();
            assert!(git.unwrap().success());
        }
        project
    }

    fn path(&self, path: &str) -> PathBuf {
        self.0.path().join(path)
    }

    fn edit(&self, path: &str, from: &str, to: &str) {
        let text = fs::read_to_string(self.path(path)).unwrap();
        assert!(text.contains(from));
        fs::write(self.path(path), text.replace(from, to)).unwrap();
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_pendula"));
        command.arg("review").args(arguments).current_dir(self.0.path());
        command
    }

    #[track_caller]
    fn refuses(&self, mut command: Command, says: &str) {
        let Output { status, stdout, stderr } = command.output().unwrap();
        let error = String::from_utf8(stderr).unwrap();
        assert_eq!(status.code(), Some(2), "{error}");
        assert_eq!((error.lines().count(), stdout.len()), (1, 0), "{error}");
        assert!(error.contains(says), "{error}");
    }
}

/// Catches: a comparison of two commits that computes something, or has another exit status than
/// the comparison with the code.
#[test]
fn two_versions_are_compared_by_what_was_committed() {
    let project = Project::new();
    let run = |arguments: &[&str]| {
        let output = project.command(arguments).output().unwrap();
        (output.status.code(), String::from_utf8(output.stdout).unwrap())
    };
    let (status, out) = run(&["--since", "HEAD", "--format", "text"]);
    assert_eq!(status, Some(0), "{out}");
    assert!(out.contains("Nothing moved: all 4 snapshots"), "{out}");
    project.edit("snapshots/1_slopes.snap", "0.72", "0.73");
    let (status, out) = run(&["--since", "HEAD", "--format", "markdown"]);
    assert_eq!(status, Some(1), "{out}");
    assert!(out.contains("| slope, 0.1 → 0.05 s | 0.72 | 0.73 | +1.39 % |"), "{out}");
    let (status, out) = run(&["--since", "HEAD"]);
    assert_eq!(status, Some(1), "{out}");
    let index = project.path("target/review/index.html");
    assert!(out.ends_with("target/review/index.html\n") && index.exists(), "{out}");
    let page = fs::read_to_string(index).unwrap();
    assert!(!page.contains("--accept"), "what is committed is not accepted");
}

/// Catches: bad input that is not refused, in more than a line, or with the status that says that
/// something moved.
#[test]
fn bad_input_is_refused_in_one_line() {
    let project = Project::new();
    project.refuses(
        project.command(&["--since", "no-such-thing"]),
        "--since no-such-thing: there is no such revision",
    );
    project.refuses(project.command(&["--since=--output=x"]), "--since --output=x");
    project.refuses(project.command(&["--since", "HEAD", "--accept", "bits"]), "--accept");
    project
        .refuses(project.command(&["--format", "pdf"]), "[possible values: html, text, markdown]");
    let mut without_git = project.command(&["--since", "HEAD"]);
    without_git.env("PATH", "");
    project.refuses(without_git, "git");
    // A file where the folder should be: a superuser may write where others may not.
    fs::write(project.path("target"), "").unwrap();
    project.edit("snapshots/1_slopes.snap", "0.72", "0.73");
    project.refuses(project.command(&["--since", "HEAD"]), "target/review/index.html");
    project.edit("snapshots/1_slopes.snap", "---\nsource", "source");
    for arguments in [&["--since", "HEAD"][..], &[], &["--accept", "bits"]] {
        project.refuses(project.command(arguments), "1_slopes.snap: corrupt");
    }
    fs::remove_dir_all(project.path("snapshots")).unwrap();
    project.refuses(project.command(&[]), "snapshots cannot be read");
}

/// Catches: a snapshot that is accepted with another header or content than `cargo insta accept`
/// gives it, one that is accepted though it did not move, and some of several accepted although one
/// is refused.
#[test]
fn what_is_accepted_is_what_was_pending() {
    let project = Project::new();
    let snapshots = project.path("snapshots");
    let reviewed = fs::read_to_string(project.path("snapshots/1_slopes.snap")).unwrap();
    let pending = reviewed.replace("0.72", "0.73");
    let with_line = pending.replacen("---\n", "---\nassertion_line: 7\n", 1);
    fs::write(project.path("snapshots/1_slopes.snap.new"), with_line).unwrap();
    let mut tree = WorkingTree {
        reviewed: on_disk(&snapshots, ".snap").unwrap(),
        pending: on_disk(&snapshots, ".snap.new").unwrap(),
        now: Version::new(),
        stale: Vec::new(),
        failed: Default::default(),
    };
    tree.now = tree.reviewed();
    tree.now.extend(contents(&tree.pending));
    // What the code has begun to make, and what it no longer makes.
    tree.now.insert("figure_9".to_string(), REVIEWED["figure_2"].clone());
    tree.now.remove("bits");
    let accept = |names: &[&str]| {
        let names: Vec<String> = names.iter().map(ToString::to_string).collect();
        tree.accept(&snapshots, &names).map_err(|error| error.to_string())
    };
    assert_eq!(accept(&["slopes", "table_9"]), Err("--accept table_9: no such snapshot".into()));
    assert_eq!(accept(&["slopes", "table_4"]), Err("--accept table_4: it has not moved".into()));
    assert_eq!(fs::read_to_string(project.path("snapshots/1_slopes.snap")).unwrap(), reviewed);
    assert_eq!(accept(&["slopes", "figure_9", "bits"]), Ok(()));
    let mut files: Vec<_> =
        fs::read_dir(&snapshots).unwrap().map(|e| e.unwrap().file_name()).collect();
    files.sort();
    assert_eq!(files, ["1_slopes.snap", "1_table_4.snap", "2_figure_2.snap", "2_figure_9.snap"]);
    assert_eq!(fs::read_to_string(project.path("snapshots/1_slopes.snap")).unwrap(), pending);
}

/// `cargo insta accept` takes a pending file as it is, and so does the review, but says so.
///
/// Catches: a pending file of an older run that is taken for what the code gives, without a word.
#[test]
fn a_stale_pending_file_is_warned_of() {
    let project = Project::new();
    let tree = WorkingTree {
        reviewed: on_disk(&project.path("snapshots"), ".snap").unwrap(),
        pending: Default::default(),
        now: Version::new(),
        stale: vec!["slopes".to_string()],
        failed: [("bits".to_string(), "no result".to_string())].into(),
    };
    let [stale, failed] = &tree.warnings()[..] else { panic!("{:?}", tree.warnings()) };
    assert!(stale.starts_with("slopes: ") && stale.contains("cargo insta reject"), "{stale}");
    assert!(failed.starts_with("`bits` cannot be computed") && failed.contains("no result"));
}
