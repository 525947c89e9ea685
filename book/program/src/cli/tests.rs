//! Every number for every option; what is said of a line that is wrong.

use std::any::TypeId;

use super::*;
use crate::commands::number::Sweep;

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

/// Every option that takes a number, with its command and what it is called.
fn numeric_options() -> Vec<(Vec<String>, clap::Command, clap::Arg)> {
    let numbers = [TypeId::of::<f64>(), TypeId::of::<Sweep>()];
    let (mut found, mut commands) = (Vec::new(), vec![(Vec::new(), definition())]);
    while let Some((words, command)) = commands.pop() {
        for option in command.get_arguments() {
            let value = option.get_value_parser().type_id();
            if numbers.iter().any(|number| value == *number) {
                found.push((words.clone(), command.clone(), option.clone()));
            }
        }
        commands.extend(
            command.get_subcommands().map(|inner| {
                ([&words[..], &[inner.get_name().to_owned()]].concat(), inner.clone())
            }),
        );
    }
    assert!(found.len() > 30, "{} options that take a number, though there are more", found.len());
    found
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
    for (_, command, option) in numeric_options() {
        // Those that others of its options are missing.
        let command = command.ignore_errors(true);
        let (id, name) = (option.get_id().as_str(), option.get_long().unwrap());
        for number in all_sorts_of_numbers() {
            let text = ryu::Buffer::new().format_finite(number).to_owned();
            for words in [vec![format!("--{name}={text}")], vec![format!("--{name}"), text]] {
                let words = [&["pendula".to_owned()], &words[..]].concat();
                let matches = command.clone().try_get_matches_from(&words);
                let matches = matches.unwrap_or_else(|error| panic!("{words:?}: {error}"));
                let read = match matches.try_get_one::<f64>(id) {
                    Ok(read) => read.map(|number| Sweep::One(*number)),
                    Err(_) => matches.get_one::<Sweep>(id).copied(),
                };
                // `{:?}` prints the shortest number that reads back to the same bits.
                let expected = format!("{:?}", Some(Sweep::One(number)));
                assert_eq!(format!("{read:?}"), expected, "{words:?}");
            }
        }
    }
    let t = parse(["pendula", "exact", "--theta0", "-1e-3", "--t", "-1,2,-3e-5"]).unwrap();
    assert!(format!("{t:?}").contains("t: [-1.0, 2.0, -3e-5]"), "{t:?}");
    for range in ["-1:2:5", "-1e-3:-.5:3"] {
        let sweep = ["sweep", "--method", "rk4", "--dt", "1", "--duration", "1", "--theta0", range];
        assert!(parse([&["pendula"], &sweep[..]].concat()).is_ok(), "{range}");
    }
}

/// Catches: a line that says of a forgotten value only that the option behind it is no number,
/// or that is refused by another option; a wrong number that is called an option.
#[test]
fn a_forgotten_value_is_explained() {
    for (command, _, option) in numeric_options() {
        let option = format!("--{}", option.get_long().unwrap());
        let words = command.iter().map(String::as_str).chain([&*option, "--summary"]);
        let words: Vec<&str> = ["pendula"].into_iter().chain(words).collect();
        let reason = refusal(&words);
        assert!(reason.contains("value before it is missing"), "{words:?}: {reason}");
        assert!(reason.contains(&option), "{words:?}: {reason}");
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

/// Catches: a command that the help names and that is not there, as in the program without the
/// book; one that it does not name.
#[test]
fn the_help_names_the_commands_that_there_are() {
    let help = definition().render_help().to_string();
    let (_, further) = help.split_once("Further commands: ").unwrap();
    let mut named: Vec<&str> = further.lines().next().unwrap().split(", ").collect();
    let (_, listed) = help.split_once("Commands:\n").unwrap();
    let listed = listed.lines().take_while(|line| !line.is_empty());
    named.extend(
        listed
            .filter(|line| !line.starts_with("   "))
            .map(|line| line.split_whitespace().next().unwrap()),
    );
    named.sort_unstable();
    let command = definition();
    let mut there: Vec<&str> = command.get_subcommands().map(clap::Command::get_name).collect();
    there.sort_unstable();
    assert_eq!(named, there);
}

/// Catches: an invalid definition of the command line that clap reports only when it is used.
#[test]
fn the_definition_is_sound() {
    Cli::command().debug_assert();
}
