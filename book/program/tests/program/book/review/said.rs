//! What is said of changes that are known.

use std::collections::BTreeSet;
use std::fs;

use pendula_program::book::review::markdown::Document;
use pendula_program::book::review::verdict::{Weight, sentences};
use pendula_program::book::review::{Review, drawings, render};
use pendula_program::book::versions::{Content, Version};
use pendula_study::claims::Verdict;
use pendula_study::report::snapshots::Kind;

use super::{REVIEWED, between, changed, review};
use crate::book::chapters::chapters;
use crate::book::pages::Page;
use crate::book::root;

/// What half kicks of 0.4999 h do to one of Störmer–Verlet's cells, wherever it stands, and to a
/// slope.
const HALF_KICKS: [(&str, &str, &str); 5] = [
    ("table_4", "  1.10271e-5", "≠ 1.11730e-5"),
    ("predictions", "1.10271e-5 |   1.10271e-5 |", "1.10271e-5 | ≠ 1.11730e-5 |"),
    (
        "ledger_cells",
        "1.10271e-5 | reproduced |         |",
        "1.11730e-5 | ≠ wrong | (on record: reproduced) |",
    ),
    (
        "orders",
        "| Störmer–Verlet        |       2 |       0.010547 \
         |    2.00 |    2.00 |    2.00 |    2.00 |",
        "| Störmer–Verlet        |       2 |       0.010547 \
         |    2.00 |    2.00 |    2.00 |  ≠ 2.11 |",
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

/// Catches: a rise for the largest change where another value fell by more; symplecticity that is
/// lost and said calmly.
#[test]
fn what_falls_and_what_is_lost_counts() {
    let fallen = ("table_4", "7.29789e-2", "7.00000e-2");
    let fallen = said(&review(&[HALF_KICKS[0], fallen]), Weight::Moved);
    assert_eq!(fallen[0], "2 values moved, by up to −4.08 % of Symplectic Euler");
    let with =
        |is| format!("| Symplectic Euler      |                1 |                   {is} |");
    let [yes, no] = ["yes", " no"].map(with);
    let lost = said(&review(&[("methods", &yes, &no)]), Weight::Alarm);
    assert_eq!(lost, ["Symplectic Euler: symplectic (yes → no)"]);
}

/// Catches: a method that is new called one that has its order again, or one whose energy has
/// become something else.
#[test]
fn a_new_method_is_said_to_be_new() {
    let mut before = REVIEWED.clone();
    for name in ["methods", "orders"] {
        let text = &mut before.get_mut(name).unwrap().text;
        *text = text
            .lines()
            .filter(|line| !line.contains("| Suzuki 4 "))
            .fold(String::new(), |text, line| text + line + "\n");
    }
    let review = between(&before, &REVIEWED);
    let of_it = |weight| said(&review, weight).into_iter().filter(|it| it.contains("Suzuki 4"));
    assert!(of_it(Weight::Moved).any(|it| it == "1 method new: Suzuki 4"));
    let others: Vec<String> = of_it(Weight::Alarm).chain(of_it(Weight::Calm)).collect();
    assert!(others.is_empty(), "{others:?}");
}

/// What two digits exchanged in Suzuki's cube root of 4 do.
const SUZUKI: [(&str, &str, &str); 2] = [
    (
        "orders",
        "| Suzuki 4              |       4 |       0.021094 \
         |    4.00 |    4.00 |    4.00 |    4.00 |",
        "| Suzuki 4              |       4 |       0.021094 \
         |  ≠ 3.82 |  ≠ 3.45 |  ≠ 2.82 |  ≠ 2.28 |",
    ),
    (
        "methods",
        "| Suzuki 4              |                4 |",
        "| Suzuki 4              |                2 |",
    ),
];

/// Catches: a headline of anything less than an order that is lost; an order with a percentage;
/// slopes without what they are a sign of; a slope between long steps for that between the
/// shortest; a column in which nothing stands; an acceptance without a warning under a failure, or
/// one that does not come last.
#[test]
fn an_order_that_is_lost_is_the_headline() {
    let mut review = review(&SUZUKI);
    review.acceptable = vec!["orders".to_string()];
    let document = Document::new(&review).unwrap();
    assert_eq!(document.headline, "Suzuki 4 lost its order (4 → 2)");
    let body = &document.body;
    // Of its four slopes the last, between the shortest steps.
    assert!(body.contains("slopes that leave the order: Suzuki 4 (4.00 → 2.28)"), "{body}");
    let slopes = "|  | before | now |\n| --- | --: | --: |\n\
                  | slope 1 | 4.00 | ≠ 3.82 |\n| slope 2 | 4.00 | ≠ 3.45 |\n";
    assert!(body.contains(slopes), "{body}");
    let sign = "The slopes fall from 4 to 2.28 as the steps become short: a coefficient has too \
                few digits.";
    assert!(body.contains(sign), "{body}");
    // Neither theory nor the paper knows of it.
    assert!(
        body.contains("|  | before | now |\n| --- | --: | --: |\n| order | 4 | 2 |\n"),
        "{body}"
    );
    assert!(!body.contains('%'), "{body}");
    let last = body.rsplit("\n## ").next().unwrap();
    assert!(last.starts_with("Accept\n\n**Take care"), "{body}");
    // The other way round it is good news, and the last before the acceptance.
    let mut repaired = between(&changed(&SUZUKI), &REVIEWED);
    repaired.acceptable = vec!["orders".to_string()];
    let body = Document::new(&repaired).unwrap().body;
    let [.., good, last] = &body.split("\n## ").collect::<Vec<_>>()[..] else { panic!("{body}") };
    assert!(good.contains("1 order there again: Suzuki 4 (2 → 4)"), "{body}");
    assert!(last.starts_with("Accept\n\nA snapshot"), "{body}");
    // A higher order than claimed is none that the method should have, either.
    let heun = |order| format!("| Heun                  |                {order} |");
    let [second, third] = [2, 3].map(heun);
    let higher = [("methods", second.as_str(), third.as_str())];
    let higher = Document::new(&super::review(&higher)).unwrap();
    assert_eq!(higher.headline, "Heun lost its order (2 → 3)");
    // Another claim is no other order.
    let suzuki = |order| format!("| Suzuki 4              |       {order} |");
    let [fourth, second] = [4, 2].map(suzuki);
    let claims = [("orders", fourth.as_str(), second.as_str())];
    let claims = Document::new(&super::review(&claims)).unwrap();
    assert_eq!(claims.headline, "1 value moved");
    assert!(claims.body.contains("| claimed order | 4 | 2 |"), "{}", claims.body);
}

/// Catches: a row that is shown once for each table it is in, or with digits that its first table
/// rounds away.
#[test]
fn each_quantity_is_shown_once() {
    let review = review(&HALF_KICKS);
    let [group] = &review.groups[..] else { panic!("{:?}", review.groups) };
    assert_eq!(group.method.as_deref(), Some("Störmer–Verlet"));
    let snapshots: Vec<_> = group.items.iter().map(|item| &item.shown.snapshot[..]).collect();
    assert_eq!(snapshots, ["table_4", "orders"]);
    let also: Vec<&str> = group.items[0].also.iter().map(|place| place.snapshot.as_str()).collect();
    assert_eq!(also, ["predictions", "ledger_cells"]);
    let row = "| Δt = 0.001 s `T4.vv.0.001` | 1.10271 × 10⁻⁵ | ≠ 1.11730 × 10⁻⁵ | +1.32 % |\n\n\
               Also in `ledger_cells`, `predictions`.\n";
    let body = Document::new(&review).unwrap().body;
    assert!(body.contains(row), "{body}");
}

/// Catches: a claim of the ledger that is taken for a repetition of one of two numbers that both
/// moved as it did, or of one with few digits; a row of Table 7 taken for that of its neighbour
/// where a row is inserted above.
#[test]
fn a_number_that_may_be_another_stands_by_itself() {
    let made = |measured: [&str; 2], sentence: &str, first: &str| {
        let [a, b] = measured;
        let content = |text: String| Content { kind: Kind::Table, text };
        let table = |names: &str, rows: &str| {
            format!("| {names} | measured |\n| -- | -- | -- |\n| * |  | * |\n{rows}")
        };
        let rows =
            format!("{first}| T7.period | a period | {a} |\n| T7.error | its error | {b} |\n");
        let (table_7, cells) = (table("id | Quantity", &rows), table("Claim | gist", &rows));
        let sentences = format!("| P1.same | as in Table 7 | {sentence} |\n");
        let sentences = table("Claim | gist", &sentences);
        Version::from([
            ("table_7".to_string(), content(table_7)),
            ("ledger_cells".to_string(), content(cells)),
            ("ledger_sentences".to_string(), content(sentences)),
        ])
    };
    let items = |old: Version, new: Version| -> Vec<(String, usize)> {
        let review = between(&old, &new);
        let items = review.groups.iter().flat_map(|group| &group.items);
        items.map(|item| (item.claim.clone().unwrap_or_default(), item.also.len())).collect()
    };
    let claim = |id: &str, also: usize| (id.to_string(), also);
    let old = || made(["1.2345", "1.2345"], "1.2345", "");
    let alone = [claim("T7.period", 1), claim("T7.error", 1), claim("P1.same", 0)];
    assert_eq!(items(old(), made(["1.2346", "1.2346"], "1.2346", "")), alone);
    // One alone moved so: the sentence repeats it.
    let new = made(["1.2346", "1.2347"], "1.2346", "| T7.new | a new row | 1.2345 |\n");
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

/// Forward Euler's energy error in the long run is quoted where the book says what the paper does.
///
/// Catches: a quote whose place is no file, or a line of it where something else stands; a chapter
/// that quotes what moved and is overlooked.
#[test]
fn a_quote_stands_where_it_says() {
    let review = review(&[("ledger_cells", "481.797 | reproduced", "481.801 | reproduced")]);
    let mut quoting = BTreeSet::new();
    for quote in &review.quotes {
        let source = root().join("book/src").join(&quote.chapter).with_extension("md");
        let source = fs::read_to_string(&source).unwrap_or_else(|_| panic!("no {source:?}"));
        let line = source.lines().nth(quote.line - 1).unwrap();
        assert!(line.contains("{{measured T5.fe.dH}}"), "{quote:?}: {line}");
        quoting.insert(quote.chapter.clone() + ".md");
    }
    let quotes = |text: &str| text.contains("{{measured T5.fe.dH}}");
    let expected = chapters().into_iter().filter(|(_, text)| quotes(text)).map(|(file, _)| file);
    assert_eq!(quoting, expected.collect());
    assert!(!quoting.is_empty());
}

/// Catches: a claim that turns unseen, and one whose reason alone was changed taken for one that
/// turned; a verdict to which none turned explained, or one to which one did not.
#[test]
fn claims_that_turn_are_told_from_new_reasons() {
    let review = review(&[
        (
            "ledger_sentences",
            "not checkable | The code is not supplied, and Section 8",
            "wrong | The code, says Section 8,",
        ),
        ("ledger_sentences", "Table 3 has the same.", "So has Table 3."),
    ]);
    let turns: Vec<_> = review.claims.iter().map(|t| (t.claim.id.as_str(), t.flips())).collect();
    assert_eq!(turns, [("P1.lines200", true), ("T1.g", false)]);
    let text = render::text(&Document::new(&review).unwrap());
    let meant = |verdict: Verdict| text.contains(&format!("{verdict}: {}", verdict.meaning()));
    assert_eq!([Verdict::Wrong, Verdict::Reproduced].map(meant), [true, false], "{text}");
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
        assert!(!drawings::compare(&content.text, &content.text).visible, "{name}");
    }
    let text = render::text(&Document::new(&review).unwrap());
    assert!(text.contains("\nNot visibly: area, figure_2.\n"), "{text}");
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
    let html = render::html(&document);
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
    assert!(html.contains("id=\"old-fig-figure-3\""));
    let texts = [html, document.to_markdown(), render::text(&document)];
    for text in texts {
        for part in ["T4.vv.0.001", "1.11730 × 10⁻⁵", "+1.32 %", "figure_3", "review --accept"]
        {
            assert!(text.contains(part), "{part} is not in {text}");
        }
    }
}

/// Catches: a word of a snapshot, of a file or of git that becomes markup, of Markdown or of the
/// page, or that a terminal obeys.
#[test]
fn no_text_becomes_markup() {
    const HOSTILE: [&str; 10] = [
        "<b>x</b>",
        "<!-- drawing 0 -->",
        "</details>",
        "`</code><i>y</i>",
        "``` <u>z</u>",
        "[a](javascript:b)",
        "![a](b)",
        "**c** _d_ # e",
        "&lt;i&gt; \\<s>",
        "\u{1b}[2J \u{202e}x \r",
    ];
    for hostile in HOSTILE {
        let mut review = review(&[
            (
                "methods",
                "| Suzuki 4              |                4 |",
                &format!("| {hostile} | 7 {hostile} |"),
            ),
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
        let html = render::html(&document);
        let (_, body) = html.split_once("<h1>").unwrap();
        for tag in ["<b>", "<i>", "<u>", "<s>", "<img", "<em>", "<!--", "javascript:b\""] {
            assert!(!body.contains(tag), "{hostile}: {tag} in {body}");
        }
        assert!(!body.contains("details>"), "{hostile}: {body}");
        let said =
            [html, document.headline.clone(), document.to_markdown(), render::text(&document)];
        let obeyed = |c| ['\u{1b}', '\u{202e}', '\r'].contains(&c);
        assert!(said.iter().all(|text| !text.contains(obeyed)), "{hostile:?}: {said:?}");
    }
}
