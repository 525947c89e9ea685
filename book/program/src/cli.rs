//! The command line: the definition of all commands, and which code runs for each. The code is in
//! [`crate::commands`].

use std::any::TypeId;
use std::ffi::OsString;
use std::num::{NonZeroU64, NonZeroUsize};
use std::thread;

use anyhow::Context;
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{ArgMatches, CommandFactory, FromArgMatches, Parser, Subcommand};
use rayon::ThreadPoolBuilder;

use crate::commands::number::{Part, Sweep};
use crate::commands::output::Streams;
use crate::commands::{
    exact, examples, identify, installed, methods, serve, simulate, sweep, verify,
};
use crate::output::failure::{Failure, shortened};

#[derive(Debug, Parser)]
#[command(name = "pendula", version, about = ABOUT)]
#[command(disable_help_subcommand = true)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

/// What the program does.
const ABOUT: &str = if cfg!(feature = "book") {
    "Numerical integrators on the pendulum: test your own, build the book, simulate"
} else {
    "Numerical integrators on the pendulum: test your own, simulate"
};

/// What scripts want to know, and the names of the commands that the help does not list.
fn after_help(command: &clap::Command) -> String {
    let further = command.get_subcommands().filter(|command| command.is_hide_set());
    let further: Vec<_> = further.map(clap::Command::get_name).collect();
    format!(
        "`pendula COMMAND --help` has examples. Further commands: {}\n\n\
         Exit status: 0 if all is well, 1 if the answer is no, 2 if something is wrong with the \
         input or fails",
        further.join(", ")
    )
}

/// One variant a command; its arguments and its code are a file or a folder of
/// [`crate::commands`].
#[derive(Debug, Subcommand)]
pub enum Command {
    /// The commands that need the study
    #[cfg(feature = "book")]
    #[command(flatten)]
    Study(crate::commands::study::Command),
    /// Test whether an integrator, in any language, does what is claimed of it; exit status 1 if a
    /// claim fails, 2 if the program can't be tested
    #[command(display_order = 2, after_help = examples(&[
        "pendula verify --claims \"order=2 symplectic\" -- pendula serve stormer-verlet",
        "pendula verify --claims \"order=8 estimate=8 crossings\" -- pendula serve dop853",
        "pendula verify --example python > verlet.py",
    ]))]
    Verify(verify::Arguments),
    /// Say which equation and which method a table of a run was made with
    #[command(display_order = 3, after_help = examples(&[
        "pendula simulate --method heun --theta0 1 --dt 0.1 --steps 99 | pendula identify",
        "pendula simulate --method rk4 --theta0 2 --dt 0.1 --steps 99 | \
         pendula identify --format json",
    ]))]
    Identify(identify::Arguments),
    /// Integrate a system, and print a row of each time and state
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
    /// Integrate from many starts, or with many step sizes, and print where each run ends
    #[command(display_order = 6, after_help = examples(&[
        "pendula sweep --method rk4 --theta0 0.1:3.1:31 --dt 0.01 --duration 10",
        "pendula sweep --method rk4 --theta0 pi/3 --dt 0.1:0.001:9 --duration 9 --plot -",
    ]))]
    Sweep(Box<sweep::Arguments>),
    /// List the methods: their order, what each preserves, what a step costs, and where the book
    /// explains it
    #[command(display_order = 7, after_help = examples(&[
        "pendula methods",
        "pendula methods --format csv > methods.csv",
    ]))]
    Methods(methods::Arguments),
    /// Offer a method on standard input and output, as a program that `pendula verify` can test
    #[command(hide = true, after_help = examples(&[
        "pendula verify -- pendula serve rk4",
    ]))]
    Serve(serve::Arguments),
    /// Print a script that completes this command line in a shell
    #[command(hide = true, after_help = examples(&[
        "pendula completions bash > pendula.bash",
        "pendula completions zsh > _pendula",
    ]))]
    Completions(installed::CompletionsArguments),
    /// Print the manual page, or write those of all commands
    #[command(hide = true, after_help = examples(&[
        "pendula man > pendula.1",
        "pendula man --output man",
    ]))]
    Man(installed::ManArguments),
}

/// The definition of the command line.
pub fn definition() -> clap::Command {
    let command = Cli::command();
    let after_help = after_help(&command);
    with_negative_numbers(command.after_help(after_help))
}

/// clap takes what begins with a hyphen for an option, or, if asked, lets pass what it takes for a
/// negative number; it does not know all exponents. So every numeric option allows hyphens, and
/// [`forgotten_value`] says what a forgotten number led to.
fn with_negative_numbers(command: clap::Command) -> clap::Command {
    let numbers = [
        TypeId::of::<f64>(),
        TypeId::of::<u32>(),
        TypeId::of::<u64>(),
        TypeId::of::<NonZeroU64>(),
        TypeId::of::<Sweep>(),
        TypeId::of::<Part>(),
    ];
    let command = command.mut_args(|option| {
        let value = option.get_value_parser().type_id();
        let is_number = numbers.iter().any(|number| value == *number);
        option.allow_hyphen_values(is_number)
    });
    command.mut_subcommands(with_negative_numbers)
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
    let words: Vec<OsString> = arguments.into_iter().map(Into::into).collect();
    let cli = Cli::from_arg_matches(&matches(&words)?);
    let cli = cli.map_err(|error| Failure::Refused(explain(&error)))?;
    cli.command.map_or_else(without_a_command, Ok)
}

fn matches(words: &[OsString]) -> Result<ArgMatches, Failure> {
    definition().try_get_matches_from(words).or_else(|error| {
        if error.use_stderr() {
            let reason = forgotten_value(words).unwrap_or_else(|| explain(&error));
            return Err(Failure::Refused(reason));
        }
        // Help and version are answers, for standard output.
        error.print()?;
        Err(Failure::Answered)
    })
}

/// The book, where there is one.
fn without_a_command() -> Result<Command, Failure> {
    #[cfg(feature = "book")]
    if crate::book::locate::book(&std::env::current_dir()?).is_ok() {
        use crate::commands::study;
        return Ok(Command::Study(study::Command::Book(study::BookArguments::default())));
    }
    definition().print_help()?;
    Err(Failure::Answered)
}

/// Runs a command; its output goes to the streams.
pub fn run(command: Command, streams: Streams<'_>) -> Result<(), Failure> {
    // They are started here, because rayon panics where they are needed and cannot be had.
    ThreadPoolBuilder::new()
        .num_threads(threads(std::env::var("RAYON_NUM_THREADS").ok().as_deref())?)
        .build_global()
        .context("threads cannot be had: set RAYON_NUM_THREADS to a smaller number")?;
    match command {
        #[cfg(feature = "book")]
        Command::Study(command) => crate::commands::study::run(command, streams.out),
        Command::Verify(arguments) => verify::run(&arguments, streams.out),
        Command::Identify(arguments) => identify::run(&arguments, streams.out),
        Command::Simulate(arguments) => simulate::run(&arguments, streams),
        Command::Exact(arguments) => exact::run(&arguments, streams.out),
        Command::Sweep(arguments) => sweep::run(&arguments, streams),
        Command::Methods(arguments) => methods::run(&arguments, streams.out),
        Command::Serve(arguments) => serve::run(&arguments, streams.out),
        Command::Completions(arguments) => {
            installed::completions(&arguments, definition(), streams.out)
        }
        Command::Man(arguments) => installed::man(&arguments, definition(), streams.out),
    }
}

/// The threads that compute: as many as `asked` says, the value of RAYON_NUM_THREADS, or as there
/// are processors, for which 0 stands. Many more than there are processors would only wait for each
/// other, and take the memory of the machine while they start.
fn threads(asked: Option<&str>) -> Result<usize, Failure> {
    const EACH: usize = 16;
    let Some(asked) = asked.filter(|asked| !asked.trim().is_empty()) else { return Ok(0) };
    let most = EACH * thread::available_parallelism().map_or(1, NonZeroUsize::get);
    match asked.trim().parse() {
        Ok(count) if count <= most => Ok(count),
        _ => Err(Failure::refused(format!(
            "RAYON_NUM_THREADS={asked}: it must be a whole number, at most {most} on this machine"
        ))),
    }
}

/// The option whose value was forgotten, if there is one. clap takes the option behind it for the
/// value, as it might be a negative number, and complains of what comes next.
fn forgotten_value(words: &[OsString]) -> Option<String> {
    let mut command = &definition();
    let words: Vec<&str> = words.iter().map_while(|word| word.to_str()).collect();
    // What comes behind -- is not ours.
    let words = words.split_inclusive(|word| *word == "--").next()?;
    for word in &words[1..] {
        match command.find_subcommand(word) {
            Some(inner) => command = inner,
            None => break,
        }
    }
    words.windows(2).find_map(|pair| {
        let name = pair[0].strip_prefix("--")?;
        let option = command.get_arguments().find(|option| option.get_long() == Some(name))?;
        (option.is_allow_hyphen_values_set() && is_option(pair[1])).then(|| {
            format!("--{name}: {} is an option, and the value before it is missing", pair[1])
        })
    })
}

/// `--dt`, `-h` or `-`, and not `-pi/3`.
fn is_option(word: &str) -> bool {
    match word.as_bytes() {
        [b'-', b'-', ..] | [b'-'] => true,
        [b'-', letter] => letter.is_ascii_alphabetic(),
        _ => false,
    }
}

/// What is wrong and what is allowed, in one line.
fn explain(error: &clap::Error) -> String {
    let folded = fold(&told(error));
    match error.kind() {
        // clap names a similar command, if there is one, but does not list the commands.
        ErrorKind::InvalidSubcommand => {
            let cli = Cli::command();
            let shown = cli.get_subcommands().filter(|command| !command.is_hide_set());
            let names: Vec<_> = shown.map(clap::Command::get_name).collect();
            format!("{folded}; commands: {}", names.join(", "))
        }
        // Its tip goes by single letters: for euler it is deuflhard.
        ErrorKind::InvalidValue => {
            let context = |kind| error.get(kind).map(ToString::to_string).unwrap_or_default();
            let given = context(ContextKind::InvalidValue).to_lowercase();
            let valid = context(ContextKind::ValidValue);
            let is_near = |name: &&str| !given.is_empty() && name.contains(&given);
            let near: Vec<_> = valid.split(", ").filter(is_near).collect();
            match folded.split("; tip:").next() {
                Some(first) if !near.is_empty() => format!("{first}; tip: {}", near.join(" or ")),
                _ => folded,
            }
        }
        _ => folded,
    }
}

/// What clap says, with the words that it quotes at a length that can be read.
fn told(error: &clap::Error) -> String {
    const LONGEST: usize = 80;
    error.context().fold(error.to_string(), |told, (_, quoted)| match quoted {
        ContextValue::String(quoted) if quoted.chars().count() > LONGEST => {
            told.replace(quoted, &shortened(quoted, LONGEST))
        }
        _ => told,
    })
}

/// Folds clap's paragraphs into one line, for scripts that read standard error.
fn fold(message: &str) -> String {
    let lines = message.trim_start_matches("error:").lines().map(str::trim);
    let told = lines.filter(|line| !line.is_empty() && !line.starts_with("For more information"));
    let folded = told.map(str::to_owned).reduce(|folded, line| {
        let is_apart = line.starts_with("Usage:") || line.starts_with("tip:");
        folded + if is_apart { "; " } else { " " } + &line
    });
    folded.unwrap_or_default()
}

#[cfg(test)]
mod tests;
