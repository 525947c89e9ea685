//! `pendula review`: what it says of changes that are known, and how it fails.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;

use clap::Parser;
use pendula_book::commands::study::review::{Arguments, run_in};
use pendula_book::review::causes::{Group, Item, groups};
use pendula_book::review::cells::{Value, differences};
use pendula_book::review::claims::Claims;
use pendula_book::review::markdown::Document;
use pendula_book::review::verdict::{Weight, sentences};
use pendula_book::review::working_tree::{WorkingTree, contents};
use pendula_book::review::{Review, drawings, render};
use pendula_book::versions::{Content, Version, on_disk};
use pendula_study::report::snapshots::Kind;
use pendula_study::report::table::Table;
use proptest::prelude::*;
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
    let sentences = sentences(review).into_iter().filter(|sentence| sentence.0 == weight);
    sentences.map(|(_, text)| text).collect()
}

/// Catches: a verdict that leaves out what no longer is as it should be, or counts a cell for each
/// table that repeats it; good news before bad.
#[test]
fn the_worst_comes_first() {
    let review = review(&HALF_KICKS);
    assert_eq!(
        said(&review, Weight::Alarm),
        [
            "1 method with slopes that leave the order: Störmer–Verlet (2.00 → 2.11)",
            "1 cell no longer as the paper prints: T4.vv.0.001 (stated 1.10 × 10⁻⁵, now 1.11730 × \
             10⁻⁵)",
            "1 prediction of theory not met any more: T4.vv.0.001",
        ]
    );
    assert_eq!(
        said(&review, Weight::Moved),
        [
            "2 values moved, by up to +1.32 % of Störmer–Verlet",
            "1 result with other bits: stormer-verlet in steps",
        ]
    );
    let weights: Vec<Weight> = sentences(&review).into_iter().map(|(weight, _)| weight).collect();
    assert!(weights.is_sorted(), "{weights:?}");
}

/// What two digits exchanged in Suzuki's cube root of 4 do.
const SUZUKI: [(&str, &str, &str); 2] = [
    (
        "orders",
        "| Suzuki 4          |     4 |       0.021094 |    4.00 |    4.00 |    4.00 |    4.00 |",
        "| Suzuki 4          |     4 |       0.021094 |  ≠ 3.82 |  ≠ 3.45 |  ≠ 2.82 |  ≠ 2.28 |",
    ),
    ("methods", "| Suzuki 4          |      4 |", "| Suzuki 4          |      2 |"),
];

/// Catches: a headline of anything less than an order that is lost; an order with a percentage;
/// slopes without their steps, or without what they are a sign of; a column in which nothing
/// stands; an acceptance without a warning under a failure, or one that does not come last.
#[test]
fn an_order_that_is_lost_is_the_headline() {
    let mut review = review(&SUZUKI);
    review.acceptable = vec!["orders".to_string()];
    let document = Document::new(&review).unwrap();
    assert_eq!(document.headline, "Suzuki 4 lost its order (4 → 2)");
    let body = &document.body;
    let slopes = "| from step to step | before | now |\n| --- | --: | --: |\n\
                  | 0.021 → 0.011 s | 4.00 | ≠ 3.82 |\n| 0.011 → 0.0053 s | 4.00 | ≠ 3.45 |\n";
    assert!(body.contains(slopes), "{body}");
    assert!(body.contains("a coefficient has too few digits"), "{body}");
    // Neither theory nor the paper knows of it.
    assert!(
        body.contains("|  | before | now |\n| --- | --: | --: |\n| order | 4 | 2 |\n"),
        "{body}"
    );
    assert!(!body.contains('%'), "{body}");
    let last = body.rsplit("\n## ").next().unwrap();
    assert!(last.starts_with("Accept\n\n**Take care"), "{body}");
    // The other way round it is good news, and the last before the acceptance.
    let changed = changed(&SUZUKI);
    let versions = ["then".to_string(), "now".to_string()];
    let chapters = root().join("book/src");
    let mut repaired = Review::new(versions, &changed, &REVIEWED, &chapters).unwrap();
    repaired.acceptable = vec!["orders".to_string()];
    let body = Document::new(&repaired).unwrap().body;
    let [.., good, last] = &body.split("\n## ").collect::<Vec<_>>()[..] else { panic!("{body}") };
    assert!(good.contains("1 order there again: Suzuki 4 (2 → 4)"), "{body}");
    assert!(last.starts_with("Accept\n\nA snapshot"), "{body}");
    // Another claim is no other order.
    let claims = [("orders", "| Suzuki 4          |     4 |", "| Suzuki 4          |     2 |")];
    let claims = Document::new(&self::review(&claims)).unwrap();
    assert_eq!(claims.headline, "1 value moved");
    assert!(claims.body.contains("| claimed order | 4 | 2 |"), "{}", claims.body);
}

/// Catches: a row that is shown once for each table it is in, with digits that its first table
/// rounds away, or without what theory and the paper say of it.
#[test]
fn each_quantity_is_shown_once() {
    let review = review(&HALF_KICKS);
    let [group] = &review.groups[..] else { panic!("{:?}", review.groups) };
    assert_eq!(group.method.as_deref(), Some("Störmer–Verlet"));
    let quantities: Vec<_> = group.parts.iter().map(|part| part.quantity).collect();
    assert_eq!(quantities, ["energy error over 50 s", "slopes of the state's error"]);
    let [item] = &group.parts[0].items[..] else { panic!("{group:?}") };
    let also: Vec<&str> = item.also.iter().map(|place| place.snapshot.as_str()).collect();
    assert_eq!(also, ["predictions", "ledger_cells"]);
    // (1.11730 − 1.10271)/1.11730 is 435 times 3e-5; 1.11730 is 3.46 halves of 0.01 from 1.10.
    let row = "| Δt = 0.001 s `T4.vv.0.001` | 1.10271 × 10⁻⁵ | ≠ 1.11730 × 10⁻⁵ | +1.32 % | \
               0 → 435 | 0.54 → 3.46 |";
    let body = Document::new(&review).unwrap().body;
    assert!(body.contains(row), "{body}");
}

/// Forward Euler's gain in the long run is quoted in several chapters.
///
/// Catches: a quote whose place is no file, or a line of it where something else stands; a chapter
/// that quotes what moved and is overlooked.
#[test]
fn a_quote_stands_where_it_says() {
    let review = review(&[("ledger_cells", "481.797 | reproduced |", "482.001 | reproduced |")]);
    let mut quoting = BTreeSet::new();
    for quote in &review.quotes {
        let source = root().join("book/src").join(&quote.chapter).with_extension("md");
        let source = fs::read_to_string(&source).unwrap_or_else(|_| panic!("no {source:?}"));
        let line = source.lines().nth(quote.line - 1).unwrap();
        let quotes = line.contains("{{measured T5.fe.dH}}") || line.contains("481.797");
        assert!(quotes, "{quote:?}: {line}");
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
    assert_eq!(said(&review, Weight::Moved), ["1 figure moved visibly: `figure_3`"]);
    for (name, content) in REVIEWED.iter().filter(|(_, content)| content.kind == Kind::Figure) {
        drawings::check(&content.text).unwrap_or_else(|error| panic!("{name}: {error:#}"));
    }
    let text = render::text(&Document::new(&review).unwrap());
    assert!(text.contains("\nNot visibly: area, figure_2.\n"), "{text}");
}

/// Catches: a review of nothing that finds something, or says that it does.
#[test]
fn nothing_moves_by_nothing() {
    let review = review(&[]);
    assert!(review.is_empty() && review.quotes.is_empty());
    let nothing = format!("Nothing moved: all {} snapshots are the same", REVIEWED.len());
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
        HALF_KICKS[3],
        HALF_KICKS[4],
        ("figure_3", "</text>", "!</text>"),
        ("figure_2", "M397.2,97.8l", "M397.2,117.8l"),
    ]);
    review.acceptable = vec!["table_4".to_string()];
    let document = Document::new(&review).unwrap();
    let html = render::html(&document).unwrap();
    let parsed = Page::parse(&html);
    assert_eq!(parsed.repeated_ids(), [""; 0]);
    let loaded = parsed.references.iter().find(|(tag, _)| tag != "a");
    assert!(loaded.is_none() && !html.contains("@import"), "{loaded:?}");
    assert!(html.contains("default-src 'none'"));
    let drawn = |id: &str| {
        let (_, drawing) = html.split_once(id).unwrap_or_else(|| panic!("no {id}"));
        let (drawing, _) = drawing.split_once("</svg>").unwrap();
        ["M397.2,97.8l", "M397.2,117.8l"].map(|path| drawing.contains(path))
    };
    assert_eq!(drawn("id=\"old-fig-figure-2\""), [true, false]);
    assert_eq!(drawn("id=\"new-fig-figure-2\""), [false, true]);
    assert!(html.contains("id=\"old-fig-figure-3\"") && html.contains("id=\"fig-slopes-0\""));
    let texts = [html, document.to_markdown(), render::text(&document)];
    for text in texts {
        for part in ["T4.vv.0.001", "1.11730 × 10⁻⁵", "+1.32 %", "figure_3", "review --accept"]
        {
            assert!(text.contains(part), "{part} is not in {text}");
        }
    }
}

/// Catches: a word of a snapshot, of a file or of git that becomes markup, of Markdown or of the
/// page.
#[test]
fn no_text_becomes_markup() {
    const HOSTILE: [&str; 9] = [
        "<b>x</b>",
        "<!-- drawing 0 -->",
        "</details>",
        "`</code><i>y</i>",
        "``` <u>z</u>",
        "[a](javascript:b)",
        "![a](b)",
        "**c** _d_ # e",
        "&lt;i&gt; \\<s>",
    ];
    for hostile in HOSTILE {
        let mut review = review(&[
            ("methods", "| Suzuki 4          |      4 |", &format!("| {hostile} | 7 {hostile} |")),
            ("ledger_sentences", "Table 3 has the same.", hostile),
        ]);
        review.versions[0] = hostile.to_string();
        review.warnings = vec![hostile.to_string()];
        review.outdated = Some(hostile.to_string());
        review.bits = vec![hostile.to_string()];
        review.acceptable = vec![hostile.to_string()];
        review.failed = [(hostile.to_string(), hostile.to_string())].into();
        let document = Document::new(&review).unwrap();
        assert!(document.drawings.is_empty());
        let html = render::html(&document).unwrap();
        let (_, body) = html.split_once("<h1>").unwrap();
        for tag in ["<b>", "<i>", "<u>", "<s>", "<img", "<em>", "<!--", "javascript:b\""] {
            assert!(!body.contains(tag), "{hostile}: {tag} in {body}");
        }
        let folds = body.matches("<details>").count();
        assert_eq!(body.matches("</details>").count(), folds, "{hostile}: {body}");
    }
}

// -------------------------------------------------------------------------------------------------
// Made-up versions
// -------------------------------------------------------------------------------------------------

/// A block of rows: one with a name of its own, and what is said of it in rows without.
#[derive(Clone, Debug)]
struct Block {
    name: usize,
    values: [u8; 2],
    of_it: Vec<[u8; 2]>,
}

/// Few values of few digits, so that many coincide.
fn block(name: usize) -> impl Strategy<Value = Block> {
    let values = || [0..4_u8, 0..4_u8];
    (values(), prop::collection::vec(values(), 0..3)).prop_map(move |(values, of_it)| Block {
        name,
        values,
        of_it,
    })
}

/// Blocks of some of six names, in any order.
fn blocks() -> impl Strategy<Value = Vec<Block>> {
    let all: Vec<_> = (0..6).map(block).collect();
    (all, prop::collection::vec(any::<bool>(), 6)).prop_flat_map(|(all, kept)| {
        let kept = all.into_iter().zip(kept).filter(|(_, kept)| *kept);
        Just(kept.map(|(block, _)| block).collect::<Vec<_>>()).prop_shuffle()
    })
}

/// The cells of the blocks, by what they are.
fn cells(blocks: &[Block]) -> BTreeMap<(usize, usize, usize), String> {
    let mut cells = BTreeMap::new();
    for Block { name, values, of_it } in blocks {
        for (row, values) in [values].into_iter().chain(of_it).enumerate() {
            for (column, value) in values.iter().enumerate() {
                cells.insert((*name, row, column), format!("{value}.0"));
            }
        }
    }
    cells
}

fn table(blocks: &[Block]) -> Table {
    let mut table = Table::new(["Quantity", "found", "known"]);
    for Block { name, values, of_it } in blocks {
        let row = |name: String, values: &[u8; 2]| {
            let values = values.map(|value| format!("{value}.0"));
            [name].into_iter().chain(values).collect::<Vec<_>>()
        };
        table.push(row(format!("quantity {name}"), values));
        of_it.iter().for_each(|values| table.push(row("its error".to_string(), values)));
    }
    table
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..Default::default() })]

    /// Catches: a cell that is compared with that of another row where rows are inserted, left out
    /// or exchanged and short numbers coincide; one that is named after another row, left out, or
    /// shown twice.
    #[test]
    fn each_moved_cell_is_shown_once_under_its_own_name(old in blocks(), new in blocks()) {
        let differ = differences("made_up", Some(&table(&old)), Some(&table(&new)));
        let (before, after) = (cells(&old), cells(&new));
        let places: BTreeSet<_> = before.keys().chain(after.keys()).collect();
        let repeats = [&old, &new].map(|v| v.iter().map(|block| block.of_it.len()).sum::<usize>());
        let mut expected: Vec<_> = places
            .into_iter()
            .filter(|place| before.get(place) != after.get(place))
            .map(|place| {
                let (name, row, column) = *place;
                let own = match row {
                    0 => format!("quantity {name}"),
                    _ => format!("its error, of quantity {name}"),
                };
                (own, ["found", "known"][column], before.get(place), after.get(place))
            })
            .collect();
        let text = |value: &Option<Value>| value.as_ref().map(|value| value.text.clone());
        let said: Vec<_> = differ
            .iter()
            .map(|cell| (cell.row.clone(), cell.column.clone(), text(&cell.old), text(&cell.new)))
            .collect();
        let mut found: Vec<_> = said
            .iter()
            .map(|(row, column, old, new)| (row.clone(), &**column, old.as_ref(), new.as_ref()))
            .collect();
        // A row that stands alone with its name needs no other.
        if repeats.iter().any(|repeats| *repeats > 1) {
            expected.sort();
            found.sort();
            prop_assert_eq!(found, expected);
        }
        let groups = groups(differ.clone(), &Claims::default(), &Claims::default());
        let items = groups.iter().flat_map(Group::items);
        let mut shown: Vec<_> = items.flat_map(Item::cells).collect();
        shown.sort_by_key(|cell| cell.position);
        let mut differ: Vec<_> = differ.iter().collect();
        differ.sort_by_key(|cell| cell.position);
        prop_assert_eq!(shown.len(), differ.len());
        prop_assert!(differ.iter().all(|cell| shown.contains(cell)));
    }
}

/// Catches: a sentence of the ledger that is taken for a repetition of one of two numbers that both
/// moved as it did, or of one with few digits; a row of Table 7 taken for that of its neighbour
/// where a row is inserted above.
#[test]
fn a_number_that_may_be_another_stands_by_itself() {
    let made = |measured: [&str; 2], sentence: &str, first: &str| {
        let [a, b] = measured;
        let content = |text: String| Content { kind: Kind::Table, text };
        let table_7 = format!(
            "| Quantity | measured |\n| --- | --- |\n{first}| a period | {a} |\n\
             | its error | {b} |\n"
        );
        let rows = first.replace("| a new ", "| `T7.new` a new ");
        let cells = format!(
            "| Claim | measured |\n| --- | --- |\n{rows}| `T7.period` a period | {a} |\n\
             | `T7.error` its error | {b} |\n"
        );
        let sentences = format!(
            "| Claim | measured |\n| --- | --- |\n| `P1.same` as in Table 7 | {sentence} |\n"
        );
        Version::from([
            ("table_7".to_string(), content(table_7)),
            ("ledger_cells".to_string(), content(cells)),
            ("ledger_sentences".to_string(), content(sentences)),
        ])
    };
    let items = |old: Version, new: Version| -> Vec<(String, usize)> {
        let versions = ["then".to_string(), "now".to_string()];
        let review = Review::new(versions, &old, &new, &root().join("book/src")).unwrap();
        let items = review.groups.iter().flat_map(Group::items);
        items.map(|item| (item.claim.clone().unwrap_or_default(), item.also.len())).collect()
    };
    let claim = |id: &str, also: usize| (id.to_string(), also);
    let old = || made(["1.2345", "1.2345"], "1.2345", "");
    assert_eq!(
        items(old(), made(["1.2346", "1.2346"], "1.2346", "")),
        [claim("T7.period", 1), claim("T7.error", 1), claim("P1.same", 0)]
    );
    // One alone moved so: the sentence repeats it.
    let new = made(["1.2346", "1.2347"], "1.2346", "| a new row | 1.2345 |\n");
    assert_eq!(
        items(old(), new),
        [claim("T7.new", 1), claim("T7.period", 2), claim("T7.error", 1)]
    );
    let short = || made(["1.23", "1.24"], "1.23", "");
    assert_eq!(
        items(short(), made(["1.25", "1.24"], "1.25", "")),
        [claim("T7.period", 1), claim("P1.same", 0)]
    );
}

// -------------------------------------------------------------------------------------------------
// A project of its own
// -------------------------------------------------------------------------------------------------

/// The command alone.
#[derive(Parser)]
struct Call {
    #[command(flatten)]
    arguments: Arguments,
}

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
        project.git(&["init", "--quiet"]);
        project.commit();
        project
    }

    fn git(&self, arguments: &[&str]) {
        let git = Command::new("git").arg("-C").arg(self.0.path()).args(arguments).status();
        assert!(git.unwrap().success());
    }

    fn commit(&self) {
        self.git(&["add", "."]);
        self.git(&["-c", "user.name=a", "-c", "user.email=a@b", "commit", "--quiet", "-m", "one"]);
    }

    /// The status and the output of a call where the code gives the snapshots as reviewed, but for
    /// a slope.
    fn gives(&self, words: &str, slope: &str) -> (i32, String) {
        let call = Call::parse_from(["review"].into_iter().chain(words.split_whitespace()));
        let mut version = changed(&[("slopes", "0.72", slope)]);
        version.retain(|name, _| ["table_4", "slopes", "figure_2"].contains(&name.as_str()));
        let mut out = Vec::new();
        let compute = || Ok((version.clone(), BTreeMap::new()));
        let result = run_in(self.0.path(), &call.arguments, &compute, &mut out);
        let status = result.as_ref().map_or_else(|failure| failure.status().into(), |()| 0);
        assert!(status < 2, "{result:?}");
        (status, String::from_utf8(out).unwrap())
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

/// The code gives 0.72, or 0.73 after a change of it.
///
/// Catches: `--since` that compares what is recorded, and so calls a change nothing until it is
/// accepted, or until it is not committed; an acceptance that is taken for the change; hashes that
/// are not computed, without a word.
#[test]
fn a_change_is_seen_since_a_commit_whether_or_not_it_is_accepted() {
    let project = Project::new();
    let since = |revision: &str, code: &str| {
        project.gives(&format!("--since {revision} --format text"), code)
    };
    let moved = |(status, out): (i32, String)| {
        let row = out.lines().find(|line| line.starts_with("0.1 → 0.05 s"));
        let row = row.map(|row| row.ends_with("0.72  0.73"));
        (status, row, out.contains("not yet accepted: slopes"))
    };
    let nothing = since("HEAD", "0.72");
    assert!(nothing.1.starts_with("Nothing moved: all 4 snapshots are the same\n"), "{nothing:?}");
    let recorded = "Not computed, but compared as their files stand: bits.";
    assert!(nothing.1.contains(recorded), "{nothing:?}");
    assert_eq!(moved(nothing), (0, None, false));
    assert_eq!(moved(since("HEAD", "0.73")), (1, Some(true), true), "not accepted");
    project.edit("snapshots/1_slopes.snap", "0.72", "0.73");
    assert_eq!(moved(since("HEAD", "0.73")), (1, Some(true), false), "accepted");
    assert_eq!(moved(since("HEAD", "0.72")), (0, None, true), "accepted, but no change");
    project.commit();
    assert_eq!(moved(since("HEAD", "0.73")), (0, None, false), "committed");
    assert_eq!(moved(since("HEAD~1", "0.73")), (1, Some(true), false), "committed");
    project.edit("snapshots/3_bits.snap", "c2c47d4665baff4a", "c2c47d4665baff4b");
    let (status, out) = since("HEAD", "0.73");
    assert!(status == 1 && out.starts_with("1 result with other bits"), "{out}");
    let (status, page) = project.gives("--since HEAD~1", "0.73");
    assert!(status == 1 && page.ends_with("target/review/index.html\n"), "{page}");
    let page = fs::read_to_string(project.path("target/review/index.html")).unwrap();
    assert!(!page.contains("--accept"), "what is committed is not accepted");
}

/// The same with what the code really gives.
///
/// Catches: a program that computes something else than what is reviewed, or nothing.
#[test]
fn what_the_code_gives_is_computed() {
    let project = Project::new();
    for entry in fs::read_dir(root().join("snapshots")).unwrap() {
        let entry = entry.unwrap();
        fs::copy(entry.path(), project.path("snapshots").join(entry.file_name())).unwrap();
    }
    project.edit("snapshots/1_slopes.snap", "0.72", "0.73");
    project.commit();
    let output = project.command(&["--since", "HEAD", "--format", "text"]).output().unwrap();
    let out = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(1), "{out}");
    assert!(out.contains("\nSnapshots that moved: slopes.\n"), "{out}");
}

/// Catches: a change in a method's file that is not shown, or one of another commit; a file that
/// git does not know and that is not shown either; the file of another method.
#[test]
fn a_group_shows_the_change_in_its_file() {
    let project = Project::new();
    let file = "src/methods/runge_kutta/forward_euler.rs";
    let write = |text: &str| {
        fs::create_dir_all(project.path(file).parent().unwrap()).unwrap();
        fs::write(project.path(file), text).unwrap();
    };
    let body = |words: &str| project.gives(&format!("{words} --format markdown"), "0.73").1;
    write("title: \"Forward Euler\", // one\n");
    let untracked = body("");
    let link = format!("[`{file}`]({file})");
    let text = format!("{link}, which git does not know yet:");
    assert!(untracked.contains(&text) && untracked.contains("// one\n```"), "{untracked}");
    project.commit();
    // Nothing is left to commit, and no snapshot came with it.
    let committed = body("");
    assert!(committed.contains("(the last commit of a snapshot):"), "{committed}");
    assert!(committed.contains("+title: \"Forward Euler\", // one\n```"), "{committed}");
    assert!(body("--since HEAD").contains(&format!("Its file {link} is as it was.")));
    write("title: \"Forward Euler\", // two\n");
    for words in ["", "--since HEAD"] {
        let changed = body(words);
        let text = "-title: \"Forward Euler\", // one\n+title: \"Forward Euler\", // two\n```";
        assert!(changed.contains(&link) && changed.contains(text), "{changed}");
        let outdated = "### This program was not compiled from the code in";
        assert!(changed.starts_with(outdated), "{changed}");
    }
    fs::write(project.path("src/methods/other.rs"), "fn other() {}\n").unwrap();
    let accept = Call::parse_from(["review", "--accept", "slopes"]);
    let compute = || panic!("nothing to compute");
    let refused = run_in(project.0.path(), &accept.arguments, &compute, &mut Vec::new());
    let refused = refused.unwrap_err();
    assert!(refused.line().unwrap().contains("was not compiled from"), "{refused:?}");
    let changed = body("");
    let (_, elsewhere) = changed.split_once("## What else changed in the code").unwrap();
    assert!(elsewhere.contains("src/methods/other.rs") && !elsewhere.contains(file), "{changed}");
    fs::remove_dir_all(project.path(".git")).unwrap();
    let text = format!("{link}, all of it, as git does not say what changed in it:");
    assert!(body("").contains(&text), "{}", body(""));
}

/// Catches: bad input that is not refused, in more than a line, or with the status that says that
/// something moved.
#[test]
fn bad_input_is_refused_in_one_line() {
    let project = Project::new();
    project.refuses(
        project.command(&["--since", "no-such-thing"]),
        "--since no-such-thing: git says: there is no such revision",
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
        recorded: Vec::new(),
        stale: Vec::new(),
        failed: BTreeMap::new(),
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

/// Catches: a pending file of an older run that is taken for what the code gives, or passed over
/// without a word; one of hashes, which are not computed, that is; a snapshot that cannot be
/// computed called unmoved.
#[test]
fn what_the_code_does_not_give_is_told() {
    let project = Project::new();
    for (name, from, to) in [("1_slopes", "0.72", "0.74"), ("3_bits", "c2c4", "c2c5")] {
        let text = fs::read_to_string(project.path(&format!("snapshots/{name}.snap"))).unwrap();
        let pending = project.path(&format!("snapshots/{name}.snap.new"));
        fs::write(pending, text.replace(from, to)).unwrap();
    }
    let code = changed(&[("slopes", "0.72", "0.73")]);
    let made = || {
        let given = |name: &str| (name.to_string(), code[name].clone());
        let failed = BTreeMap::from([("figure_2".to_string(), "no result".to_string())]);
        Ok((Version::from(["slopes", "table_4"].map(given)), failed))
    };
    let tree = WorkingTree::read(&project.path("snapshots"), made).unwrap();
    assert_eq!(
        (&tree.stale[..], &tree.recorded[..]),
        (&["slopes".into()][..], &["bits".into()][..])
    );
    assert_eq!(tree.moved(), ["bits", "slopes"]);
    assert!(tree.now["slopes"].text.contains("0.73") && tree.now["bits"].text.contains("c2c5"));
    let call = Call::parse_from(["review", "--format", "text"]);
    let mut out = Vec::new();
    let result = run_in(project.0.path(), &call.arguments, &made, &mut out);
    assert_eq!(result.unwrap_err().status(), 1);
    let out = String::from_utf8(out).unwrap();
    let failed = "figure_2 cannot be computed any more, and is left out: no result\n";
    assert!(out.starts_with(failed), "{out}");
    let stale = "slopes: its pending file is not what the code gives now; run the tests again, or";
    assert!(out.contains(stale), "{out}");
}
