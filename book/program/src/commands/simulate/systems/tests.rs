//! What is asked of every system on the list.

use std::ptr;

use super::*;
use crate::cli::{self, Command};
use crate::commands::simulate;

/// What `pendula simulate --system` prints with the `options`, each with its number, and the
/// `others`; or its refusal.
fn run(
    system: &dyn Registration,
    options: &[(&Parameter, f64)],
    others: &str,
) -> Result<String, String> {
    let mut words = vec!["pendula".to_owned(), "simulate".to_owned()];
    words.push(format!("--system={}", system.name()));
    words.extend(options.iter().map(|(option, value)| format!("--{}={value}", option.name)));
    words.extend(others.split(' ').map(str::to_owned));
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let Ok(Command::Simulate(arguments)) = cli::parse(&words) else { panic!("{words:?}") };
    match simulate::run(&arguments, Streams { out: &mut out, err: &mut err }) {
        Ok(()) => Ok(String::from_utf8(out).unwrap()),
        Err(Failure::Refused(why)) => Err(why),
        Err(Failure::Failed(why)) => Err(why.to_string()),
        Err(other) => panic!("{words:?}: {other:?}"),
    }
}

/// Each option of a system at one half.
fn halves(system: &dyn Registration) -> Vec<(&'static Parameter, f64)> {
    system.parameters().iter().map(|option| (*option, 0.5)).collect()
}

/// Steps that every system can take from there.
const STEPS: &str = "--method rk4 --dt 0.1 --steps 3";

/// Catches: an option that the system does not read; one that may be left out though the help names
/// no default, or whose default is another; rows that do not begin with t.
#[test]
fn each_option_of_a_system_counts() {
    for system in SYSTEMS {
        let name = system.name();
        let all = halves(*system);
        let rows = run(*system, &all, STEPS).unwrap();
        assert!(rows.starts_with("t,") && rows.contains("\n0.1,"), "{name}: {rows}");
        let mut seen = vec![rows];
        for (n, &(option, half)) in all.iter().enumerate() {
            let mut other = all.clone();
            other[n].1 = 1.5 * half;
            let rows = run(*system, &other, STEPS).unwrap();
            assert!(!seen.contains(&rows), "{name}: --{} changes nothing", option.name);
            seen.push(rows);

            other.remove(n);
            match run(*system, &other, STEPS) {
                Err(why) => {
                    let missing =
                        format!("--system {name} needs --{}, which is missing", option.name);
                    assert_eq!(why, missing);
                }
                Ok(rows) if option.default.is_some() => {
                    other.push((option, option.default.unwrap()));
                    assert_eq!(run(*system, &other, STEPS), Ok(rows), "{name}: {option:?}");
                }
                Ok(_) => assert!(option.help.contains("default"), "{name}: {option:?}"),
            }
        }
    }
}

/// Catches: an option of another system that is taken in silence, also where it has a default, as
/// `--gravity`; a refusal that does not say whose it is.
#[test]
fn each_option_of_another_system_is_refused() {
    for system in SYSTEMS {
        let own = system.parameters();
        for other in parameters::parameters().filter(|it| !own.iter().any(|own| own.is(it))) {
            let has = |it: &&&dyn Registration| it.parameters().iter().any(|own| own.is(other));
            let of: Vec<&str> = SYSTEMS.iter().filter(has).map(|it| it.name()).collect();
            let all = [halves(*system), vec![(other, 0.5)]].concat();
            let refused = format!(
                "--{} is an option of --system {}, but the system is {}",
                other.name,
                of.join(" or "),
                system.name()
            );
            assert_eq!(run(*system, &all, STEPS), Err(refused));
        }
    }
}

/// Catches: an option that two systems describe for themselves, of which only one would be in the
/// help.
#[test]
fn an_option_of_two_systems_is_one() {
    let all = SYSTEMS.iter().flat_map(|system| system.parameters());
    for option in all {
        let shown = parameters::parameters().find(|shown| shown.is(option)).unwrap();
        assert!(ptr::eq(shown, *option), "{} has two descriptions", option.name);
    }
}

/// Within 0.3 s DOP853 takes a few steps, each off by 1e-9 at most. RK4 is off by t h⁴ω⁵/120 in a
/// motion of frequency ω: 3e-10 for ω = 10/s, ten times what the systems have here.
///
/// Catches: a system whose steps that vary begin elsewhere, have other columns or go another way;
/// a plot of another system, or that ends early.
#[test]
fn each_system_is_walked_and_drawn() {
    let numbers = |rows: &str| -> Vec<f64> {
        rows.lines().last().unwrap().split(',').map(|value| value.parse().unwrap()).collect()
    };
    for system in SYSTEMS {
        let (name, all) = (system.name(), halves(*system));
        let steps = run(*system, &all, "--method rk4 --dt 0.001 --steps 300").unwrap();
        let walk = run(*system, &all, "--method dop853 --tolerance 1e-9 --duration 0.3").unwrap();
        assert!(steps.lines().take(2).eq(walk.lines().take(2)), "{name}: {walk}");
        for (one, other) in numbers(&steps).iter().zip(numbers(&walk)) {
            assert!((one - other).abs() < 1e-7, "{name}: {one} and {other}");
        }
        let plot = run(*system, &all, &format!("{STEPS} --plot -")).unwrap();
        let called = if name == SYSTEMS[0].name() { "" } else { &system.called()["the ".len()..] };
        assert!(plot.to_lowercase().starts_with(&called.to_lowercase()), "{name}: {plot}");
        assert!(plot.contains("\nt (s) from 0 to 0.3"), "{name}: {plot}");
    }
}
