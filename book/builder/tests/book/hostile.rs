//! What others wrote: chapters, numbers and programs that nobody has looked at. Whatever they are,
//! there is an answer or a reason in one line, and no panic.
//!
//! The cases are the same on each run; those that failed once are kept beside this file, and tried
//! first. `PROPTEST_CASES=100000 cargo test -p pendula-book --test book hostile` tries more.

use std::collections::BTreeSet;
use std::ffi::OsString;
use std::io::Write;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, LazyLock};
use std::time::Duration;

use pendula::Phase;
use pendula::verify::{Fault, Request, Stranger};
use pendula_book::failure::Failure;
use pendula_book::ledger::{Entry, Ledger};
use pendula_book::number;
use pendula_book::preprocess::chapter::Setter;
use pendula_book::preprocess::sources::Tests;
use pendula_book::preprocess::{captions, claims};
use pendula_book::verify::Program;
use pendula_book::verify::protocol::{Answer, Question, answer, greeting, question};
use proptest::prelude::*;
use proptest::test_runner::{FileFailurePersistence, RngSeed};

use crate::chapters::chapters;

/// As many cases as this, or as the environment asks for, if that is more.
fn config(cases: u32) -> ProptestConfig {
    let usual = ProptestConfig { cases: 0, ..ProptestConfig::default() };
    let asked = std::env::var("PROPTEST_CASES").ok().and_then(|cases| cases.parse().ok());
    ProptestConfig {
        cases: asked.unwrap_or(0).max(cases),
        rng_seed: RngSeed::Fixed(0x0050_E4D0_1A01),
        failure_persistence: Some(Box::new(FileFailurePersistence::WithSource("regressions"))),
        ..usual
    }
}

/// What a failed command prints: one line, with something in it.
fn is_one_line(error: anyhow::Error) -> bool {
    let line = Failure::from(error).line().unwrap_or_default();
    line.lines().count() == 1 && line.len() > "pendula: ".len()
}

// -------------------------------------------------------------------------------------------------
// Chapters
// -------------------------------------------------------------------------------------------------

/// A claim with values of every kind, and one with none.
fn ledger(id: &str) -> Option<Entry> {
    let entry = |value: Option<&str>| Entry {
        stated: value.map(str::to_string),
        measured: value.map(str::to_string),
        verdict: Some("reproduced".to_string()),
        kind: "cell".to_string(),
    };
    match id {
        "T4.rk4.0.01" => Some(entry(Some("2.34e-7"))),
        "T5.fe.dH" => Some(entry(None)),
        _ => None,
    }
}

static TESTS: LazyLock<Tests> = LazyLock::new(|| {
    let source = "/// Catches: `a` < b, and $x$.\n#[test]\nfn a() {}\n#[test]\nfn b() {}\n";
    Tests::from_sources([("x", source)]).unwrap()
});

static CHAPTERS: LazyLock<Vec<String>> =
    LazyLock::new(|| chapters().into_iter().map(|(_, text)| text).collect());

/// What authors type, and what they should not.
const SNIPPETS: &[&str] = &[
    "{{",
    "}}",
    "{{measured T4.rk4.0.01}}",
    "{{stated T5.fe.dH}}",
    "{{verdict nobody}}",
    "{{test x::a}}",
    "* {{catches x::a}}.",
    "{{catches x::b}}",
    "{{verdicts}}",
    "{{}}",
    "{{ }}",
    "{{work-precision}}",
    "{{measured}}",
    "{{#include x}}",
    "\\{{",
    "$",
    "$$",
    "\\$",
    "\\(",
    "$x^2$",
    "$\\frac{1$",
    "$\\begin{matrix}$",
    "$\\unknown$",
    "${{measured T4.rk4.0.01}}$",
    "`",
    "```",
    "```rust\n",
    "~~~",
    "    ",
    "\t",
    "\n",
    "\n\n",
    "\r\n",
    "> ",
    "* ",
    "1. ",
    "- [ ] ",
    "|",
    "|---|\n",
    "| Claim | verdict |\n|---|---|\n| `T4.rk4.0.01` | reproduced |\n",
    "| Claim |\n|--:|\n| `no` |\n",
    "Table: A caption.\n\n",
    "Table[RK4]: x\n\n",
    "Table[]:",
    "<div>",
    "</main>",
    "<script>x</script>",
    "<!-- ",
    " -->",
    "[a](b.md",
    "![](",
    "[^1]",
    "[^1]: note",
    "# ",
    "## \n",
    "10⁻⁷",
    "10⁻",
    "1 000 000",
    "\u{a0}",
    "\u{0}",
    "\u{202e}",
    "\u{feff}",
    "é",
    "🙂",
    "θ₀",
    "\\",
    "&",
    "&nbsp;",
    "&#0;",
    "*",
    "**",
    "_",
];

/// A change of a text: where, how much of it goes, and what comes.
#[derive(Clone, Debug)]
struct Edit {
    at: prop::sample::Index,
    length: usize,
    new: String,
}

fn edit() -> impl Strategy<Value = Edit> {
    let new = prop_oneof![
        6 => prop::sample::select(SNIPPETS).prop_map(str::to_string),
        2 => Just(String::new()),
        1 => "\\PC{0,8}",
        1 => any::<String>(),
    ];
    (any::<prop::sample::Index>(), 0..12_usize, new).prop_map(|(at, length, new)| Edit {
        at,
        length,
        new,
    })
}

/// The nearest place before `at` between two characters.
fn boundary(text: &str, mut at: usize) -> usize {
    at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

fn edited(mut text: String, edits: &[Edit]) -> String {
    for edit in edits {
        let from = boundary(&text, edit.at.index(text.len() + 1));
        let to = boundary(&text, from + edit.length);
        text.replace_range(from..to, &edit.new);
    }
    text
}

/// A piece of one of the book's chapters, with some of it changed.
fn spoilt_chapter() -> impl Strategy<Value = String> {
    let place = (any::<prop::sample::Index>(), any::<prop::sample::Index>());
    (place, 0..900_usize, prop::collection::vec(edit(), 0..6)).prop_map(
        |((chapter, from), length, edits)| {
            let text = &CHAPTERS[chapter.index(CHAPTERS.len())];
            let from = boundary(text, from.index(text.len()));
            let to = boundary(text, from + length);
            edited(text[from..to].to_string(), &edits)
        },
    )
}

/// All that is done to the text of a chapter.
fn set(text: &str) -> anyhow::Result<String> {
    let setter = Setter::new(&ledger, &TESTS, "<figure>".to_string());
    let mut quoted = BTreeSet::new();
    let text = setter.set(&captions::set(text)?, "../", &mut quoted)?;
    claims::set(&text, &ledger, &claims::Quotes::new())
}

proptest! {
    #![proptest_config(config(1000))]

    /// Catches: a text cut between the bytes of a character; a passage that ends before it begins;
    /// a directive left open, nested or empty that is more than an error; an error of many lines.
    #[test]
    fn a_chapter_is_set_or_refused(text in spoilt_chapter()) {
        if let Err(error) = set(&text) {
            prop_assert!(is_one_line(error));
        }
    }
}

// -------------------------------------------------------------------------------------------------
// Numbers
// -------------------------------------------------------------------------------------------------

/// Numbers in every notation that programs print, and what only looks like one.
fn word() -> impl Strategy<Value = String> {
    let number =
        prop_oneof![any::<f64>(), (-10.0_f64..10.0).boxed(), Just(0.1 + 0.2), Just(5e-324)];
    let printed = (number, 0..9_u8, 0..25_usize).prop_map(|(x, how, digits)| match how {
        0 => format!("{x}"),
        1 => format!("{x:?}"),
        2 => format!("{x:e}"),
        3 => format!("{x:E}"),
        4 => format!("{x:+.digits$e}"),
        5 => format!("{x:.digits$}"),
        6 => format!("{x:e}").replace('e', "e+"),
        7 => format!("0{x}"),
        _ => format!("{x}").replace('.', ","),
    });
    let odd = prop::sample::select(&[
        "",
        "-",
        "+",
        ".",
        "e",
        "e5",
        ".5",
        "5.",
        "-.5",
        "1e",
        "1e+",
        "1e5.5",
        "0x10",
        "1_000",
        "1,5",
        "NaN",
        "nan",
        "-nan",
        "inf",
        "-inf",
        "infinity",
        "+Infinity",
        "1e999",
        "-1e999",
        "1e-999",
        "1.5e-2147483648",
        "1e2147483647",
        "1e-2147483649",
        "18446744073709551616",
        "１",
        "١",
        "−1",
        "1f",
        "1d0",
        "1.0.0",
        "--1",
        "+-1",
        "1e5e5",
        "0e0",
        "-0",
        "-0.0",
        "1\u{0}",
        "9007199254740993",
        "2.2250738585072011e-308",
        "0.1000000000000000055511151231257827021181583404541015625",
    ])
    .prop_map(str::to_string);
    prop_oneof![5 => printed, 2 => odd, 1 => "[-+0-9.eE]{0,12}", 1 => any::<String>()]
}

/// Words of the protocol among them, with any white space between.
fn line() -> impl Strategy<Value = String> {
    let known = prop::sample::select(&[
        "hello",
        "1",
        "bye",
        "pendulum",
        "driven",
        "done",
        "error",
        "unsupported",
        "10",
        "1000",
        "0.01",
    ]);
    let word = prop_oneof![3 => word(), 2 => known.prop_map(str::to_string)];
    let space = prop::sample::select(&[" ", "  ", "\t", "\r", "\u{a0}", "\n"]);
    prop::collection::vec((word, space), 0..10).prop_map(|words| {
        words.into_iter().flat_map(|(word, space)| [word, space.to_string()]).collect()
    })
}

/// The finite number that a word is to Rust, as bits.
fn finite(word: &str) -> Option<u64> {
    word.parse::<f64>().ok().filter(|x| x.is_finite()).map(f64::to_bits)
}

proptest! {
    #![proptest_config(config(4000))]

    /// Catches: a number of a stranger's answer that is rounded, cut off or read where there is
    /// none; a panic.
    #[test]
    fn an_answer_is_the_numbers_that_rust_reads(line in line()) {
        let words: Vec<&str> = line.split_whitespace().collect();
        match answer(&line) {
            Ok(Answer::State(Phase { theta, omega })) => {
                prop_assert_eq!(words.len(), 2);
                prop_assert_eq!(finite(words[0]), Some(theta.to_bits()));
                prop_assert_eq!(finite(words[1]), Some(omega.to_bits()));
            }
            Ok(Answer::Done(Some(count))) => {
                prop_assert_eq!(words[1].parse::<u64>(), Ok(count));
            }
            Ok(Answer::Done(None)) => prop_assert_eq!(&words[..], ["done"]),
            Ok(Answer::Unsupported) => prop_assert_eq!(&words[..], ["unsupported"]),
            Ok(Answer::Error(why)) if words.len() > 1 => prop_assert_eq!(words[1..].join(" "), why),
            Ok(Answer::Error(why)) => prop_assert!(!why.is_empty()),
            Err(why) => {
                let two = words.len() == 2 && words.iter().all(|word| finite(word).is_some());
                prop_assert!(!two, "{} is refused: {}", line, why);
                prop_assert_eq!(why.lines().count(), 1);
            }
        }
        if let Ok(name) = greeting(&line) {
            prop_assert_eq!(&words[..2], ["hello", "1"]);
            prop_assert_eq!(name, words[2..].join(" "));
        }
    }

    /// Catches: a request understood in part, or with other numbers than it has.
    #[test]
    fn a_request_is_the_numbers_that_rust_reads(line in line()) {
        let words: Vec<&str> = line.split_whitespace().collect();
        if let Ok(Question::Run(request)) = question(&line) {
            let Request { g_over_l, drive, start, step, steps, every } = request;
            let drive = drive.map(|drive| [drive.amplitude, drive.frequency]);
            let numbers = [g_over_l].into_iter().chain(drive.into_iter().flatten());
            let numbers = numbers.chain([start.theta, start.omega, step]);
            let read: Vec<_> = numbers.map(|x| Some(x.to_bits())).collect();
            let last = words.len() - 2;
            let said: Vec<_> = words[1..last].iter().map(|word| finite(word)).collect();
            prop_assert_eq!(read, said);
            prop_assert!(steps % every == 0 && every > 0 && step != 0.0);
            let counts: Vec<_> = words[last..].iter().map(|word| word.parse().ok()).collect();
            prop_assert_eq!(counts, [Some(steps), Some(every)]);
            prop_assert_eq!(question(&request.to_string()), Ok(Question::Run(request)));
        }
    }

    /// Catches: a cell of a snapshot read as another number than it prints; a sign, an exponent or
    /// a digit lost; an exponent that nobody can add to.
    #[test]
    fn a_cell_is_the_number_that_it_prints(word in word(), remark in "[ ±(a-z)0-9]{0,8}") {
        if let Some(parsed) = number::parse(&word) {
            let value = word.parse::<f64>().ok();
            prop_assert_eq!(value.map(f64::to_bits), Some(parsed.value.to_bits()));
            prop_assert!(parsed.half_unit >= 0.0);
        }
        let cell = format!("{} {remark}", word.replace('-', "−"));
        if let Some(read) = number::leading(&cell) {
            let literal = cell.split_whitespace().next().unwrap().replace('−', "-");
            prop_assert_eq!(finite(&literal), Some(read.value.to_bits()), "{}", cell);
        }
    }
}

// -------------------------------------------------------------------------------------------------
// Programs
// -------------------------------------------------------------------------------------------------

/// What a program writes that asks nothing.
fn monologue() -> impl Strategy<Value = Vec<u8>> {
    let piece = prop_oneof![
        3 => line().prop_map(|line| (line + "\n").into_bytes()),
        1 => Just(b"0.5 1e-3\n".to_vec()),
        1 => Just(b"done 4\n".to_vec()),
        1 => prop::collection::vec(any::<u8>(), 0..40),
        1 => Just(vec![b'9'; 2000]),
    ];
    let greets = prop_oneof![3 => Just(b"hello 1 x\n".to_vec()), 1 => Just(Vec::new())];
    (greets, prop::collection::vec(piece, 0..6)).prop_map(|(mut all, pieces)| {
        all.extend(pieces.concat());
        all
    })
}

#[cfg(unix)]
proptest! {
    #![proptest_config(config(100))]

    /// A program that writes this and ends.
    ///
    /// Catches: bytes of a stranger that panic or hang, an answer made up for one that is missing,
    /// a fault of many lines.
    #[test]
    fn a_program_is_at_fault_in_one_line(bytes in monologue()) {
        let mut file = tempfile::NamedTempFile::new().unwrap();
        file.write_all(&bytes).unwrap();
        let command = ["cat".into(), OsString::from(file.path())];
        let patience = Duration::from_secs(20);
        let started = Program::start(&command, patience, &Arc::new(AtomicBool::new(false)));
        let program = match started {
            Ok(program) => program,
            Err(why) => {
                prop_assert_eq!(why.lines().count(), 1, "{}", why);
                return Ok(());
            }
        };
        let start = Phase { theta: 1.0, omega: 0.0 };
        let request =
            Request { g_over_l: 9.81, drive: None, start, step: 0.01, steps: 1, every: 1 };
        match program.answer(&request) {
            Ok(reply) => {
                prop_assert_eq!(reply.states.len(), 1);
                let Phase { theta, omega } = reply.states[0];
                prop_assert!(theta.is_finite() && omega.is_finite());
            }
            Err(Fault::Refused(why) | Fault::Broken(why)) => {
                prop_assert_eq!(why.lines().count(), 1, "{}", why);
            }
            Err(Fault::Unsupported) => {}
        }
    }
}

/// Catches: a ledger that the chapters do not ask.
#[test]
fn the_ledger_here_is_one() {
    let ledger: &dyn Ledger = &ledger;
    assert!(ledger.entry("T4.rk4.0.01").is_some() && ledger.entry("T9").is_none());
    assert!(set("{{measured T4.rk4.0.01}}").unwrap().contains("class=\"measured\""));
    assert!(set("{{measured T5.fe.dH}}").is_err() && set("{{measured T9}}").is_err());
}
