//! The command line. What each command does is in [`crate::commands`].

use std::ffi::OsString;

use clap::builder::{StyledStr, Styles};
use clap::error::ErrorKind;
use clap::{ArgMatches, CommandFactory, FromArgMatches, Parser, Subcommand};

use crate::commands::state::{self, KeptArguments, Resumed};
use crate::commands::{
    adaptive, completions, double_pendulum, ensemble, exact, flips, man, methods, number, period,
    serve, simulate, verify,
};
use crate::failure::Failure;

#[derive(Debug, Parser)]
#[command(name = "pendula", version, about = ABOUT)]
#[command(disable_help_subcommand = true, after_help = STATUS)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

/// What the program does.
const ABOUT: &str = if cfg!(feature = "book") {
    "Numerical integrators on the pendulum: build the book, print its tables, simulate"
} else {
    "Numerical integrators on the pendulum: simulate, and judge other integrators"
};

/// What scripts want to know.
const STATUS: &str =
    "Exit status: 0 if all is well, 1 if the answer is no, 2 if a request is refused or fails";

/// One variant a command; its arguments and its code are one file of [`crate::commands`].
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Those that need the study
    #[cfg(feature = "book")]
    #[command(flatten)]
    Study(crate::commands::study::Command),
    /// Print the methods: order, what each keeps, what a step costs, and where the book has it
    #[command(after_help = examples(&[
        "pendula methods",
        "pendula methods --format csv > methods.csv",
    ]))]
    Methods(methods::Arguments),
    /// Integrate and print rows t, theta, omega, energy
    #[command(after_help = examples(&[
        "pendula simulate --method stormer-verlet --theta0 pi/3 --dt 0.01 --steps 1000 --summary",
        "pendula simulate --method rk4 --theta0 170deg --dt 0.01 --duration 10 --plot -",
        "pendula simulate --method rk4 --theta0 1 --dt 0.01 --steps 900 --plot a.svg > a.csv",
        "pendula simulate --system damped --damping 0.2 --method rk4 --theta0 1 --dt 0.1 --steps 9",
    ]))]
    Simulate(simulate::Arguments),
    /// Integrate in steps whose size follows the motion and print rows t, theta, omega, energy
    #[command(after_help = examples(&[
        "pendula adaptive --method dop853 --theta0 3 --duration 10 --tolerance 1e-9 --summary",
        "pendula adaptive --method taylor-series --theta0 3 --duration 9 --tolerance 1e-9 --plot -",
    ]))]
    Adaptive(adaptive::Arguments),
    /// Integrate the double pendulum and print rows with the places of its bobs
    #[command(after_help = examples(&[
        "pendula double-pendulum --theta1 2pi/3 --theta2 90deg --dt 0.01 --duration 9 --every 9",
        "pendula double-pendulum --theta1 2 --theta2 1 --dt .1 --steps 99 --method dop853 --plot -",
    ]))]
    DoublePendulum(double_pendulum::Arguments),
    /// Print when a double pendulum first turns over, for every release from rest
    #[command(after_help = examples(&[
        "pendula flips --size 40 --duration 5 > flips.csv",
        "pendula flips --size 60 --duration 9 --picture flips.png --output flips.csv",
    ]))]
    Flips(flips::Arguments),
    /// Integrate from many starts, or with many steps, and print where each ends
    #[command(after_help = examples(&[
        "pendula ensemble --method rk4 --theta0 0.1:3.1:31 --dt 0.01 --duration 10",
        "pendula ensemble --method rk4 --theta0 pi/3 --dt 0.1:0.001:9 --duration 9 --plot -",
    ]))]
    Ensemble(ensemble::Arguments),
    /// Print the OpenCL devices of this machine, for `ensemble --device`
    #[cfg(feature = "device")]
    #[command(after_help = examples(&[
        "pendula devices",
    ]))]
    Devices(crate::commands::devices::Arguments),
    /// Print the exact state at given times
    #[command(after_help = examples(&[
        "pendula exact --theta0 pi/3 --t 1,10,100",
        "pendula exact --theta0 0 --omega0 7 --t 1 --format json",
    ]))]
    Exact(exact::Arguments),
    /// Print the exact period of a release from rest
    #[command(after_help = examples(&[
        "pendula period --theta0 pi/3",
        "pendula period --theta0 0 --omega0 7",
    ]))]
    Period(period::Arguments),
    /// Judge a program that is not ours against what it claims; exit status 1 if a claim fails, 2
    /// if the program is at fault
    #[command(after_help = examples(&[
        "pendula verify --claims \"order=2 symplectic\" -- pendula serve stormer-verlet",
        "pendula verify --example python > verlet.py",
    ]))]
    Verify(verify::Arguments),
    /// Serve a method on standard input and output, as a program that `pendula verify` can judge
    #[command(after_help = examples(&[
        "pendula verify -- pendula serve rk4",
    ]))]
    Serve(serve::Arguments),
    /// Print a script that completes this command line in a shell
    #[command(after_help = examples(&[
        "pendula completions bash > pendula.bash",
        "pendula completions zsh > _pendula",
    ]))]
    Completions(completions::Arguments),
    /// Print the manual page, or write those of all commands
    #[command(after_help = examples(&[
        "pendula man > pendula.1",
        "pendula man --output man",
    ]))]
    Man(man::Arguments),
}

/// The definition of the command line.
pub fn definition() -> clap::Command {
    Cli::command()
}

/// Examples for the end of a help text. A test runs each of them, in an empty folder.
pub(crate) fn examples(lines: &[&str]) -> StyledStr {
    let styles = Styles::default();
    let head = styles.get_header();
    let lines: String = lines.iter().map(|line| format!("\n  {line}")).collect();
    format!("{head}Examples:{head:#}{lines}").into()
}

/// Reads the command line.
///
/// # Errors
/// [`Failure::Refused`] with one line for anything that is not allowed; [`Failure::Answered`] once
/// help or version has been printed.
pub fn parse<I, T>(arguments: I) -> Result<Command, Failure>
where
    I: IntoIterator<Item = T>,
    T: Into<OsString> + Clone,
{
    let mut words: Vec<OsString> = arguments.into_iter().map(Into::into).collect();
    let mut matches = matches(&words)?;
    let resumed = match matches.subcommand() {
        Some((name, given)) => state::asked_for(given).map(|path| Resumed::read(path, name)),
        None => None,
    };
    let resumed = resumed.transpose()?;
    if let Some(from) = &resumed {
        // A run is resumed with the arguments that it was begun with.
        words.truncate(1);
        words.extend(from.arguments().iter().map(OsString::from));
        matches = self::matches(&words)?;
    }
    let cli = Cli::from_arg_matches(&matches);
    let cli = cli.map_err(|error| Failure::Refused(explain(&error)))?;
    let Some(mut command) = cli.command else { return without_a_command() };
    if let Some(kept) = command.kept() {
        kept.words = words.split_off(words.len().min(1));
        kept.from = resumed;
    }
    Ok(command)
}

fn matches(words: &[OsString]) -> Result<ArgMatches, Failure> {
    Cli::command().try_get_matches_from(words).or_else(|error| {
        if error.use_stderr() {
            let reason = forgotten_value(words).unwrap_or_else(|| explain(&error));
            return Err(Failure::Refused(reason));
        }
        // Help and version are answers, for standard output.
        error.print()?;
        Err(Failure::Answered)
    })
}

impl Command {
    /// Where the run is kept if it is interrupted, of a command that can be.
    const fn kept(&mut self) -> Option<&mut KeptArguments> {
        match self {
            Self::Simulate(arguments) => Some(&mut arguments.trajectory.kept),
            Self::DoublePendulum(arguments) => Some(&mut arguments.trajectory.kept),
            Self::Ensemble(arguments) => Some(&mut arguments.kept),
            _ => None,
        }
    }
}

/// The book.
#[cfg(feature = "book")]
fn without_a_command() -> Result<Command, Failure> {
    use crate::commands::study;
    Ok(Command::Study(study::Command::Book(study::book::Arguments::default())))
}

/// Help, where there is no book.
#[cfg(not(feature = "book"))]
fn without_a_command() -> Result<Command, Failure> {
    Cli::command().print_help()?;
    Err(Failure::Answered)
}

/// The option whose value was forgotten, if there is one. clap takes the option behind it for the
/// value, as it might be a negative number, and complains of what comes next.
fn forgotten_value(words: &[OsString]) -> Option<String> {
    let cli = Cli::command();
    let words: Vec<&str> =
        words.iter().map_while(|word| word.to_str()).take_while(|word| *word != "--").collect();
    let command = words.iter().find_map(|word| cli.find_subcommand(word))?;
    words.windows(2).find_map(|pair| {
        let name = pair[0].strip_prefix("--")?;
        let option = command.get_arguments().find(|option| option.get_long() == Some(name))?;
        let forgotten = number::forgotten(pair[1]).filter(|_| option.is_allow_hyphen_values_set());
        forgotten.map(|forgotten| format!("--{name}: {forgotten}"))
    })
}

/// What is wrong and what is allowed, in one line.
fn explain(error: &clap::Error) -> String {
    let folded = fold(&error.to_string());
    // clap names a similar command, if there is one, but does not list the commands.
    if error.kind() == ErrorKind::InvalidSubcommand {
        let cli = Cli::command();
        let names: Vec<_> = cli.get_subcommands().map(clap::Command::get_name).collect();
        return format!("{folded}; commands: {}", names.join(", "));
    }
    folded
}

/// Folds clap's paragraphs into one line, for scripts that read standard error.
fn fold(message: &str) -> String {
    let lines = message
        .trim_start_matches("error:")
        .lines()
        .map(str::trim)
        .filter(|line| !line.is_empty() && !line.starts_with("For more information"));
    let mut folded = String::new();
    for line in lines {
        let separator = match line {
            _ if folded.is_empty() => "",
            _ if line.starts_with("Usage:") || line.starts_with("tip:") => "; ",
            _ => " ",
        };
        folded.push_str(separator);
        folded.push_str(line);
    }
    folded
}

#[cfg(test)]
mod tests {
    use std::any::TypeId;

    use super::*;
    use crate::sweep::range::Sweep;

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

    /// Catches: clap's paragraphs passed on unfolded.
    #[test]
    fn a_usage_error_is_one_line() {
        let reason = refusal(&["pendula", "vorify"]);
        assert!(!reason.contains('\n'), "{reason}");
        assert!(reason.contains("'vorify'") && reason.contains("'verify'"), "{reason}");
        assert!(!reason.contains("For more information"), "{reason}");
    }

    /// Catches: a refusal that does not say what is allowed.
    #[test]
    fn an_unknown_command_is_told_those_there_are() {
        let reason = refusal(&["pendula", "x"]);
        for command in Cli::command().get_subcommands() {
            assert!(reason.contains(command.get_name()), "{reason}");
        }
    }

    /// A valid line for each command with numbers.
    const LINES: &[&[&str]] = &[
        &["simulate", "--method", "rk4", "--theta0", "1", "--dt", "1", "--duration", "1"],
        &["adaptive", "--method", "dop853", "--theta0", "1", "--duration", "1", "--tolerance", "1"],
        &["double-pendulum", "--theta1", "1", "--theta2", "1", "--dt", "1", "--duration", "1"],
        &["ensemble", "--method", "rk4", "--theta0", "1", "--dt", "1", "--duration", "1"],
        &["exact", "--theta0", "1", "--t", "1"],
        &["period", "--theta0", "1"],
        &["verify", "--", "program"],
        #[cfg(feature = "book")]
        &["work-precision"],
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
            if *word == option {
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
        special.into_iter().chain(any.filter(|x| x.is_finite()).take(40)).flat_map(|x| [x, -x])
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
                            format!("{field}: Some(One({number:?}))"),
                            format!("{field}: [{number:?}]"),
                        ];
                        assert!(is.iter().any(|is| shown.contains(is)), "{words:?}: {shown}");
                    }
                }
            }
        }
        assert_eq!(
            options,
            47 + usize::from(cfg!(feature = "book")),
            "the options that take a number"
        );
        let t = parse(["pendula", "exact", "--theta0", "-1e-3", "--t", "-1,2,-3e-5"]).unwrap();
        assert!(format!("{t:?}").contains("t: [-1.0, 2.0, -3e-5]"), "{t:?}");
        for range in ["-1:2:5", "-1e-3:-.5:3"] {
            assert!(parse(with(LINES[3], "--theta0", range, false)).is_ok(), "{range}");
        }
    }

    /// Catches: a line that says of a forgotten value only that the option behind it is no number,
    /// or that is refused by another option.
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
        // As it is typed: what comes next is the value of the other option.
        let reason = refusal(&["pendula", "simulate", "--method", "rk4", "--theta0", "--dt", "1"]);
        assert!(reason.contains("--theta0: --dt is an option, and the value"), "{reason}");
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
}
