//! What helps with the command line: its examples, completions and manual pages, and its colours.

use std::fs;
use std::process::{Command, Output};

use pendula_program::cli;

use crate::{PENDULA, assert_refused, printed};

/// The examples in the help of each command, by its name: `verify`, `paper tables`.
fn examples() -> Vec<(String, Vec<String>)> {
    let mut found = Vec::new();
    let mut commands: Vec<_> =
        cli::definition().get_subcommands().map(|c| (c.get_name().to_owned(), c.clone())).collect();
    while let Some((name, command)) = commands.pop() {
        let help = command.get_after_help().map(ToString::to_string).unwrap_or_default();
        let lines = help.lines().filter_map(|line| line.strip_prefix("  "));
        let inner =
            command.get_subcommands().map(|c| (format!("{name} {}", c.get_name()), c.clone()));
        // mdBook's question is no command of its own.
        commands.extend(inner.filter(|(name, _)| name != "preprocess supports"));
        if !command.is_subcommand_required_set() {
            found.push((name, lines.map(str::to_owned).collect()));
        }
    }
    found
}

/// Catches: a command without an example; an example that is refused, fails, prints nothing, or
/// names an option that is gone.
#[test]
#[cfg(unix)]
fn every_example_runs() {
    let folder = tempfile::tempdir().unwrap();
    let program = std::path::Path::new(PENDULA).parent().unwrap();
    let path = std::env::join_paths(
        [program.to_path_buf()]
            .into_iter()
            .chain(std::env::split_paths(&std::env::var_os("PATH").unwrap())),
    );
    let path = path.unwrap();
    for (command, examples) in examples() {
        assert!(!examples.is_empty(), "{command} has no example");
        let words: Vec<&str> = command.split(' ').collect();
        let help = printed(&[&words[..], &["--help"]].concat());
        for example in examples {
            assert!(help.contains(&format!("\n  {example}\n")), "{help}");
            assert!(example.contains(&command), "{command}: {example}");
            match command.as_str() {
                // They measure all again, as do the tests of the study: `.ci/run` runs them.
                "book" | "review" => {
                    let parsed = cli::definition().try_get_matches_from(example.split(' '));
                    assert!(parsed.is_ok(), "{parsed:?}");
                    continue;
                }
                _ => {}
            }
            let mut shell = Command::new("sh");
            let shell = shell.args(["-c", &example]).current_dir(folder.path()).env("PATH", &path);
            let Output { status, stdout, stderr } = shell.output().unwrap();
            if command == "sweep devices" && pendula_device::devices().is_err() {
                println!("not run: there is no device to print");
                continue;
            }
            assert!(status.success(), "{example}: {status}: {}", String::from_utf8_lossy(&stderr));
            let mut words = example.split_whitespace();
            // What it writes: the file behind > or --plot, the folder behind --output.
            let written = |option| {
                let value = words.clone().skip_while(|word| *word != option).nth(1);
                value.filter(|file| *file != "-").map(|file| folder.path().join(file))
            };
            let files = [">", "--plot", "--output"].map(written);
            for file in files.iter().flatten() {
                let found = fs::metadata(file).unwrap_or_else(|_| panic!("{example}: {file:?}"));
                assert!(found.is_dir() || found.len() > 0, "{example}: {file:?} is empty");
            }
            let silent = words.any(|word| word == "supports") || files.iter().any(Option::is_some);
            assert!(silent || !stdout.is_empty(), "{example} prints nothing");
        }
    }
}

/// Catches: a script for a program of another name, or that does not know a command, or an option;
/// a page that is missing, or is that of another command, or has lost its examples.
#[test]
fn completions_and_pages_have_every_command() {
    let definition = cli::definition();
    let names: Vec<&str> = definition.get_subcommands().map(clap::Command::get_name).collect();
    for (shell, of_the_program) in [
        ("bash", "-o default pendula\n"),
        ("elvish", "arg-completer[pendula]"),
        ("fish", "complete -c pendula "),
        ("powershell", "-CommandName 'pendula'"),
        ("zsh", "#compdef pendula\n"),
    ] {
        let script = printed(&["completions", shell]);
        assert!(script.contains(of_the_program), "{shell}");
        for name in &names {
            assert!(script.contains(name), "{name} for {shell}");
        }
        assert!(script.contains("drive-strength"), "{shell}");
    }

    let folder = tempfile::tempdir().unwrap();
    let man = folder.path().join("man");
    assert_eq!(printed(&["man", "--output", man.to_str().unwrap()]), "");
    let page = |file: String| fs::read_to_string(man.join(file)).unwrap().replace("\\-", "-");
    let main = page("pendula.1".to_owned());
    assert_eq!(printed(&["man"]).replace("\\-", "-"), main);
    for command in definition.get_subcommands().filter(|command| !command.is_hide_set()) {
        let name = command.get_name();
        assert!(main.contains(&format!("pendula-{name}(1)")), "{name}");
    }
    for (name, examples) in examples() {
        let page = page(format!("pendula-{}.1", name.replace(' ', "-")));
        assert!(page.contains(&format!("pendula {name}")), "{page}");
        assert!(examples.iter().all(|example| page.contains(example)), "{page}");
    }
    let file = man.join("pendula.1");
    assert_refused(&["man", "--output", file.to_str().unwrap()], "--output");
}

/// What a command prints and says, with these variables of the environment and no others that are
/// about colour.
fn with(variables: &[(&str, &str)], arguments: &[&str]) -> [String; 2] {
    let mut command = Command::new(PENDULA);
    for name in ["NO_COLOR", "CLICOLOR", "CLICOLOR_FORCE"] {
        command.env_remove(name);
    }
    let Output { stdout, stderr, .. } =
        command.args(arguments).envs(variables.iter().copied()).output().unwrap();
    [stdout, stderr].map(|bytes| String::from_utf8(bytes).unwrap())
}

/// Catches: colour in a pipe; NO_COLOR ignored, also where colour is forced; CLICOLOR_FORCE ignored
/// by a table, a verdict, a help text or an error; colour that changes a word, or that is in rows;
/// one that is not ended.
#[test]
fn colour_is_for_terminals() {
    let row = ["simulate", "--method", "rk4", "--theta0", "1", "--dt", "1", "--steps", "2"];
    for (arguments, coloured) in [
        (&["methods"][..], true),
        (&["paper", "tables", "--table", "4"], true),
        (&["exact", "--help"], true),
        (&["verify", "--", PENDULA, "serve", "heun"], true),
        (&["exact", "--theta0", "x"], true),
        (&["paper", "tables", "--table", "4", "--format", "csv"], false),
        (&["methods", "--format", "csv"], false),
        (&row, false),
    ] {
        let piped = with(&[], arguments);
        assert!(piped.iter().all(|text| !text.contains('\u{1b}')), "{piped:?}");
        let forced = ("CLICOLOR_FORCE", "1");
        assert_eq!(with(&[("NO_COLOR", "1"), forced], arguments), piped);
        let forced = with(&[forced], arguments);
        assert_eq!(forced.iter().any(|text| text.contains('\u{1b}')), coloured, "{forced:?}");
        let plain = forced.map(|text| {
            let last = text.rsplit_once('\u{1b}');
            assert!(last.is_none_or(|(_, last)| last.starts_with("[0m")), "not ended: {text}");
            anstream::adapter::strip_str(&text).to_string()
        });
        assert_eq!(plain, piped, "{arguments:?}");
    }
    let [text, _] = with(&[("CLICOLOR_FORCE", "1")], &["paper", "claims", "--verdict", "wrong"]);
    // Bold and red, whichever comes first.
    assert!(text.contains("\u{1b}[31mwrong\u{1b}[0m"), "{text}");
    let [_, error] = with(&[("CLICOLOR_FORCE", "1")], &["exact", "--theta0", "x"]);
    assert!(error.starts_with("\u{1b}[1m\u{1b}[31mpendula:\u{1b}[0m "), "{error}");
}
