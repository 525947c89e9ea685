//! The command line: the definition of all commands, and which code runs for each. The code is in
//! [`crate::commands`].

use std::ffi::OsString;
use std::io::{self, Write};

use clap::error::ErrorKind;
use clap::{ArgMatches, CommandFactory, FromArgMatches, Parser, Subcommand};

use crate::commands::arguments::number;
use crate::commands::state::{self, KeptArguments, Resumed};
use crate::commands::{completions, exact, examples, man, methods, serve, simulate, sweep, verify};
use crate::threads;
use pendula_output::failure::Failure;

#[derive(Debug, Parser)]
#[command(name = "pendula", version, about = ABOUT)]
#[command(disable_help_subcommand = true, after_help = STATUS)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

/// What the program does.
const ABOUT: &str = if cfg!(feature = "book") {
    "Numerical integrators on the pendulum: verify yours, build the book about ours, simulate"
} else {
    "Numerical integrators on the pendulum: verify yours, simulate with ours"
};

/// What scripts want to know.
const STATUS: &str = "\
`pendula COMMAND --help` has examples. Also there: serve, preprocess, completions, man

Exit status: 0 if all is well, 1 if the answer is no, 2 if a request is refused or fails";

/// One variant a command; its arguments and its code are a file or a folder of
/// [`crate::commands`].
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Those that need the study
    #[cfg(feature = "book")]
    #[command(flatten)]
    Study(crate::commands::study::Command),
    /// Judge a program that is not ours against what it claims; exit status 1 if a claim fails, 2
    /// if the program is at fault
    #[command(display_order = 2, after_help = examples(&[
        "pendula verify --claims \"order=2 symplectic\" -- pendula serve stormer-verlet",
        "pendula verify --example python > verlet.py",
    ]))]
    Verify(verify::Arguments),
    /// Integrate and print rows t, theta, omega, energy
    #[command(display_order = 4, after_help = examples(&[
        "pendula simulate --method stormer-verlet --theta0 pi/3 --dt 0.01 --steps 1000 --summary",
        "pendula simulate --method rk4 --theta0 170deg --dt 0.01 --duration 10 --plot -",
        "pendula simulate --method rk4 --theta0 1 --dt 0.01 --steps 900 --plot a.svg > a.csv",
        "pendula simulate --method dop853 --theta0 3 --tolerance 1e-9 --duration 10 --summary",
        "pendula simulate --system damped --damping 0.2 --method rk4 --theta0 1 --dt 0.1 --steps 9",
        "pendula simulate --system double-pendulum --theta1 2pi/3 --theta2 2 --dt 0.01 --steps 9",
    ]))]
    Simulate(Box<simulate::Arguments>),
    /// Print the exact state at given times, or the exact period
    #[command(display_order = 5, after_help = examples(&[
        "pendula exact --theta0 pi/3",
        "pendula exact --theta0 pi/3 --t 1,10,100",
        "pendula exact --theta0 0 --omega0 7 --t 1 --format json",
    ]))]
    Exact(exact::Arguments),
    /// Integrate from many starts, or with many steps, and print where each ends
    #[command(display_order = 6, after_help = examples(&[
        "pendula sweep --method rk4 --theta0 0.1:3.1:31 --dt 0.01 --duration 10",
        "pendula sweep --method rk4 --theta0 pi/3 --dt 0.1:0.001:9 --duration 9 --plot -",
    ]))]
    Sweep(Box<sweep::Arguments>),
    /// Print the methods: order, what each keeps, what a step costs, and where the book has it
    #[command(display_order = 7, after_help = examples(&[
        "pendula methods",
        "pendula methods --format csv > methods.csv",
    ]))]
    Methods(methods::Arguments),
    /// Serve a method on standard input and output, as a program that `pendula verify` can judge
    #[command(hide = true, after_help = examples(&[
        "pendula verify -- pendula serve rk4",
    ]))]
    Serve(serve::Arguments),
    /// Print a script that completes this command line in a shell
    #[command(hide = true, after_help = examples(&[
        "pendula completions bash > pendula.bash",
        "pendula completions zsh > _pendula",
    ]))]
    Completions(completions::Arguments),
    /// Print the manual page, or write those of all commands
    #[command(hide = true, after_help = examples(&[
        "pendula man > pendula.1",
        "pendula man --output man",
    ]))]
    Man(man::Arguments),
}

/// What commands were called before, and what they are called now. The old names go with the next
/// release.
const RENAMED: &[(&str, &[&str])] = &[
    ("adaptive", &["simulate"]),
    ("claims", &["paper", "claims"]),
    ("devices", &["sweep", "devices"]),
    ("double-pendulum", &["simulate", "--system", "double-pendulum"]),
    ("ensemble", &["sweep"]),
    ("flips", &["sweep", "flips"]),
    ("period", &["exact"]),
    ("tables", &["paper", "tables"]),
    ("work-precision", &["bench"]),
];

/// The definition of the command line.
pub fn definition() -> clap::Command {
    Cli::command()
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
    rename(&mut words);
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
    let cli = cli.map_err(|error| Failure::Refused(explain(&error, &words)))?;
    let Some(mut command) = cli.command else { return without_a_command() };
    if let Some(kept) = command.kept() {
        kept.words = words.split_off(words.len().min(1));
        kept.from = resumed;
    }
    Ok(command)
}

/// Puts the new name of a command in the place of an old one, and says so.
fn rename(words: &mut Vec<OsString>) {
    let Some(word) = words.get(1) else { return };
    if let Some((old, new)) = RENAMED.iter().find(|(old, _)| word == old) {
        let told = format!("pendula: `pendula {old}` is now `pendula {}`", new.join(" "));
        // Not eprintln!, which panics when standard error is closed.
        let _ = writeln!(io::stderr(), "{told}");
        words.splice(1..2, new.iter().map(OsString::from));
    }
}

fn matches(words: &[OsString]) -> Result<ArgMatches, Failure> {
    Cli::command().try_get_matches_from(words).or_else(|error| {
        if error.use_stderr() {
            let reason = forgotten_value(words).unwrap_or_else(|| explain(&error, words));
            return Err(Failure::Refused(reason));
        }
        // Help and version are answers, for standard output.
        error.print()?;
        Err(Failure::Answered)
    })
}

/// The book, where there is one.
#[cfg(feature = "book")]
fn without_a_command() -> Result<Command, Failure> {
    use crate::commands::study;
    let here = std::env::current_dir()?;
    if pendula_book::locate::book(&here).is_err() {
        return help();
    }
    Ok(Command::Study(study::Command::Book(study::book::Arguments::default())))
}

#[cfg(not(feature = "book"))]
fn without_a_command() -> Result<Command, Failure> {
    help()
}

fn help() -> Result<Command, Failure> {
    Cli::command().print_help()?;
    Err(Failure::Answered)
}

impl Command {
    /// Where the run is kept if it is interrupted, of a command that can be.
    fn kept(&mut self) -> Option<&mut KeptArguments> {
        match self {
            Self::Simulate(arguments) => Some(&mut arguments.trajectory.kept),
            Self::Sweep(arguments) => arguments.kept(),
            _ => None,
        }
    }

    /// Whether it needs more than a thread for its computations.
    const fn computes_in_parallel(&self) -> bool {
        match self {
            Self::Sweep(_) | Self::Verify(_) => true,
            #[cfg(feature = "book")]
            Self::Study(_) => true,
            _ => false,
        }
    }
}

/// Runs a command; its output goes to `out`.
///
/// # Errors
/// Whatever the command refuses or fails at.
pub fn run(command: Command, out: &mut dyn Write) -> Result<(), Failure> {
    if command.computes_in_parallel() {
        threads::start()?;
    }
    match command {
        #[cfg(feature = "book")]
        Command::Study(command) => crate::commands::study::run(command, out),
        Command::Verify(arguments) => verify::run(&arguments, out),
        Command::Simulate(arguments) => simulate::run(&arguments, out),
        Command::Exact(arguments) => exact::run(&arguments, out),
        Command::Sweep(arguments) => sweep::run(&arguments, out),
        Command::Methods(arguments) => methods::run(&arguments, out),
        Command::Serve(arguments) => serve::run(&arguments, out),
        Command::Completions(arguments) => completions::run(&arguments, definition(), out),
        Command::Man(arguments) => man::run(&arguments, definition(), out),
    }
}

/// The option whose value was forgotten, if there is one. clap takes the option behind it for the
/// value, as it might be a negative number, and complains of what comes next.
fn forgotten_value(words: &[OsString]) -> Option<String> {
    let mut command = &Cli::command();
    let words: Vec<&str> =
        words.iter().map_while(|word| word.to_str()).take_while(|word| *word != "--").collect();
    for word in &words[1..] {
        match command.find_subcommand(word) {
            Some(inner) => command = inner,
            None => break,
        }
    }
    words.windows(2).find_map(|pair| {
        let name = pair[0].strip_prefix("--")?;
        let option = command.get_arguments().find(|option| option.get_long() == Some(name))?;
        let forgotten = number::forgotten(pair[1]).filter(|_| option.is_allow_hyphen_values_set());
        forgotten.map(|forgotten| format!("--{name}: {forgotten}"))
    })
}

/// What is wrong and what is allowed, in one line.
fn explain(error: &clap::Error, words: &[OsString]) -> String {
    let folded = fold(&error.to_string());
    match error.kind() {
        // clap names a similar command, if there is one, but does not list the commands.
        ErrorKind::InvalidSubcommand => {
            let cli = Cli::command();
            let shown = cli.get_subcommands().filter(|command| !command.is_hide_set());
            let names: Vec<_> = shown.map(clap::Command::get_name).collect();
            format!("{folded}; commands: {}", names.join(", "))
        }
        // Nor does it say which argument.
        ErrorKind::InvalidUtf8 => {
            let word = words.iter().find(|word| word.to_str().is_none());
            let word = word.map(|word| word.to_string_lossy()).unwrap_or_default();
            format!("{word}: it is not UTF-8")
        }
        _ => folded,
    }
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
    use crate::commands::arguments::range::Sweep;

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
            let is_told = reason.contains(&format!(" {}", command.get_name()));
            assert_eq!(is_told, !command.is_hide_set(), "{reason}");
        }
    }

    /// A program without the book or without devices has not all of the new commands, and then it
    /// refuses them by their new names.
    ///
    /// Catches: an old name that is gone before its time, or leads to another command; a new name
    /// that is none; an old name that nobody knows in a program without a feature.
    #[test]
    fn an_old_name_is_the_new_one() {
        let definition = definition();
        for (old, new) in RENAMED {
            assert!(definition.find_subcommand(old).is_none(), "{old}");
            let mut words = ["pendula", old, "--help"].map(OsString::from).to_vec();
            rename(&mut words);
            let inner: Vec<_> = words[1..words.len() - 1].iter().collect();
            assert_eq!(inner, *new);
            let is_there = match new[0] {
                "paper" | "bench" => cfg!(feature = "book"),
                _ => cfg!(feature = "device") || !new.contains(&"devices"),
            };
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
                            format!("{field}: One({number:?})"),
                            format!("{field}: [{number:?}]"),
                        ];
                        assert!(is.iter().any(|is| shown.contains(is)), "{words:?}: {shown}");
                    }
                }
            }
        }
        assert_eq!(
            options,
            34 + usize::from(cfg!(feature = "book")),
            "the options that take a number"
        );
        let t = parse(["pendula", "exact", "--theta0", "-1e-3", "--t", "-1,2,-3e-5"]).unwrap();
        assert!(format!("{t:?}").contains("t: [-1.0, 2.0, -3e-5]"), "{t:?}");
        for range in ["-1:2:5", "-1e-3:-.5:3"] {
            assert!(parse(with(LINES[1], "--theta0", range, false)).is_ok(), "{range}");
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
