//! Every number for every option; what is said of a line that is wrong.

use std::any::TypeId;

use super::*;
use crate::commands::arguments::number::Sweep;

fn refusal(arguments: &[&str]) -> String {
    match parse(arguments) {
        Err(Failure::Refused(reason)) => reason,
        other => panic!("expected a refusal, got {other:?}"),
    }
}

/// Catches: a bare `pendula` that prints help instead of building the book.
#[test]
#[cfg(feature = "book")]
fn no_command_means_the_book() {
    use crate::commands::study::Command::Book;
    let command = parse(["pendula"]).unwrap();
    assert!(matches!(command, Command::Study(Book(arguments)) if !arguments.open));
}

/// Catches: a bare `pendula` without the book that is refused, or does something.
#[test]
#[cfg(not(feature = "book"))]
fn no_command_means_help() {
    assert!(matches!(parse(["pendula"]), Err(Failure::Answered)));
}

/// A program without the book has not all of the new commands, and then it refuses them by their
/// new names.
///
/// Catches: an old name that is gone before its time, or leads to another command; a new name
/// that is none; an old name that nobody knows in a program without a feature.
#[test]
fn an_old_name_is_the_new_one() {
    let definition = definition();
    assert_eq!(RENAMED.len(), 9, "whatever the features");
    for (old, new) in RENAMED {
        assert!(definition.find_subcommand(old).is_none(), "{old}");
        let mut words = ["pendula", old, "--help"].map(OsString::from).to_vec();
        rename(&mut words);
        let inner: Vec<_> = words[1..words.len() - 1].iter().collect();
        assert_eq!(inner, *new);
        let is_there = cfg!(feature = "book") || !["paper", "bench"].contains(&new[0]);
        match matches(&words) {
            Err(Failure::Answered) => assert!(is_there, "{old}"),
            Err(Failure::Refused(reason)) => {
                let named = new.iter().any(|word| reason.contains(&format!("'{word}'")));
                assert!(!is_there && named, "{old}: {reason}");
            }
            other => panic!("{old}: {other:?}"),
        }
    }
}

/// A valid line for each command with numbers.
const LINES: &[&[&str]] = &[
    &["simulate", "--method", "rk4", "--theta0", "1", "--dt", "1", "--duration", "1"],
    &["sweep", "--method", "rk4", "--theta0", "1", "--dt", "1", "--duration", "1"],
    &["exact", "--theta0", "1", "--t", "1"],
    &["verify", "--", "program"],
    #[cfg(feature = "book")]
    &["bench"],
];

/// Every option of a command that takes a number: its name, and that of its field.
fn numeric_options(command: &str) -> Vec<(String, String)> {
    let cli = Cli::command();
    let of = cli.find_subcommand(command).unwrap();
    let numbers = [TypeId::of::<f64>(), TypeId::of::<Sweep>()];
    let options = of
        .get_arguments()
        .filter(|o| numbers.iter().any(|number| o.get_value_parser().type_id() == *number));
    options.map(|o| (format!("--{}", o.get_long().unwrap()), o.get_id().to_string())).collect()
}

/// The line with `value` for the option, as one word or as two.
fn with(line: &[&str], option: &str, value: &str, one_word: bool) -> Vec<String> {
    let mut words: Vec<String> = vec!["pendula".to_owned(), line[0].to_owned()];
    words.extend(if one_word {
        vec![format!("{option}={value}")]
    } else {
        vec![option.to_owned(), value.to_owned()]
    });
    let mut rest = line[1..].iter();
    while let Some(word) = rest.next() {
        // Of the two only one may be there.
        if *word == option || *word == "--dt" && option == "--tolerance" {
            rest.next();
        } else {
            words.push((*word).to_owned());
        }
    }
    words
}

/// Numbers from all over the range of f64, by their bits; both zeros, the smallest, the
/// largest.
fn all_sorts_of_numbers() -> impl Iterator<Item = f64> {
    let special = [0.0, 5e-324, f64::MIN_POSITIVE, 0.5, 1e-3, 0.1, 1e16, 1e15, f64::MAX];
    let mut bits = 1_u64;
    let any = std::iter::repeat_with(move || {
        // Knuth's generator, of which every bit pattern is a number.
        bits = bits.wrapping_mul(6_364_136_223_846_793_005);
        bits = bits.wrapping_add(1_442_695_040_888_963_407);
        f64::from_bits(bits)
    });
    special.into_iter().chain(any.filter(|x| x.is_finite()).take(8)).flat_map(|x| [x, -x])
}

/// Every number that the program can print is understood by every option that takes one, with
/// the same bits.
///
/// Catches: a negative number, with or without an exponent, taken for an option; an option that
/// was forgotten; digits lost in reading.
#[test]
fn every_number_is_understood_by_every_option() {
    let mut options = 0;
    for line in LINES {
        for (option, field) in numeric_options(line[0]) {
            options += 1;
            for number in all_sorts_of_numbers() {
                let text = ryu::Buffer::new().format_finite(number).to_owned();
                for one_word in [false, true] {
                    let words = with(line, &option, &text, one_word);
                    let command = parse(&words).unwrap_or_else(|e| panic!("{words:?}: {e:?}"));
                    // `{:?}` prints the shortest number that reads back to the same bits.
                    let shown = format!("{command:?}");
                    let is = [
                        format!("{field}: {number:?}"),
                        format!("{field}: Some({number:?})"),
                        format!("{field}: One({number:?})"),
                        format!("{field}: [{number:?}]"),
                    ];
                    assert!(is.iter().any(|is| shown.contains(is)), "{words:?}: {shown}");
                }
            }
        }
    }
    assert_eq!(options, 34 + usize::from(cfg!(feature = "book")), "the options that take a number");
    let t = parse(["pendula", "exact", "--theta0", "-1e-3", "--t", "-1,2,-3e-5"]).unwrap();
    assert!(format!("{t:?}").contains("t: [-1.0, 2.0, -3e-5]"), "{t:?}");
    for range in ["-1:2:5", "-1e-3:-.5:3"] {
        assert!(parse(with(LINES[1], "--theta0", range, false)).is_ok(), "{range}");
    }
}

/// Catches: a line that says of a forgotten value only that the option behind it is no number,
/// or that is refused by another option; a wrong number that is called an option.
#[test]
fn a_forgotten_value_is_explained() {
    for line in LINES {
        for (option, _) in numeric_options(line[0]) {
            let words = with(line, &option, "--summary", false);
            let words: Vec<&str> = words.iter().map(String::as_str).collect();
            let reason = refusal(&words);
            assert!(reason.contains("value before it is missing"), "{words:?}: {reason}");
            assert!(reason.contains(&option), "{words:?}: {reason}");
        }
    }
    for (words, expected) in [(["--dt", "-h", "--", "-"], true), (["-1e", "-pix", "-.", ""], false)]
    {
        assert!(words.iter().all(|word| is_option(word) == expected), "{words:?}");
    }
    for option in ["--steps", "--every"] {
        let reason = refusal(&["pendula", "simulate", option, "--dt", "1"]);
        assert!(reason.contains("value before it is missing"), "{reason}");
        let reason = refusal(&["pendula", "simulate", option, "-3"]);
        assert!(reason.contains("'-3'") && reason.contains(option), "{reason}");
    }
}

/// Catches: an invalid definition of the command line that clap reports only when it is used.
#[test]
fn the_definition_is_sound() {
    Cli::command().debug_assert();
}
