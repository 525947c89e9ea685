//! A thousand random tables of right methods and a thousand of mistakes, which `rows::identify` is
//! given: no table may be given another's name. Prints how many are named, by digits, and fails if
//! one is named falsely: `cargo run --release -p pendula-judge --example identify [COUNT]`.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::process::ExitCode;

use pendula_judge::rows::candidates::{Candidate, Equation, State, all, named};
use pendula_judge::rows::{Force, Maker, identify};

/// A table, and what it was made by.
struct Made {
    text: String,
    name: &'static str,
    digits: usize,
}

/// What is said of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Said {
    Named,
    OneOf,
    AnyAccurate,
    Other,
    Falsely,
}

fn main() -> ExitCode {
    let count = std::env::args().nth(1).map_or(1000, |count| count.parse().expect("a number"));
    let mut falsely = 0;
    for (right, what) in [(true, "methods"), (false, "mistakes")] {
        let mut found: BTreeMap<usize, BTreeMap<Said, u32>> = BTreeMap::new();
        for seed in 0..count {
            let Some(made) = table(seed, right) else { continue };
            let said = said(&made);
            if said == Said::Falsely {
                println!("{what} {seed}: {} is named falsely", made.name);
                falsely += 1;
            }
            *found.entry(made.digits).or_default().entry(said).or_default() += 1;
        }
        println!("{what}: digits, named, one of a few, as exact as any, not named, named falsely");
        for (digits, counts) in found {
            let of = |said| counts.get(&said).copied().unwrap_or(0);
            let [a, b, c, d, e] =
                [Said::Named, Said::OneOf, Said::AnyAccurate, Said::Other, Said::Falsely].map(of);
            println!("{digits:2} {a:4} {b:4} {c:4} {d:4} {e:4}");
        }
    }
    if falsely == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn said(made: &Made) -> Said {
    let Ok(report) = identify(made.text.as_bytes()) else { return Said::Other };
    match report.maker {
        Maker::Method(method) => {
            let same = method.same.iter().any(|(name, _)| name == made.name);
            if method.name == made.name || same { Said::Named } else { Said::Falsely }
        }
        Maker::OneOf { exact: true, .. } => Said::AnyAccurate,
        Maker::OneOf { .. } => Said::OneOf,
        _ => Said::Other,
    }
}

/// A table by a random method: its step, k, drag, start, digits and how many steps a row.
fn table(seed: u64, right: bool) -> Option<Made> {
    let mut r = fastrand::Rng::with_seed(seed);
    let pool: Vec<&Candidate> =
        all().iter().filter(|c| c.right == right && c.suits(false, false)).collect();
    let method = pool[r.usize(..pool.len())];
    let k = [9.81, 9.8, 1.0, 0.5 * 40f64.powf(r.f64())][r.usize(..4)];
    let damped = method.suits(true, false) && r.f64() < 0.3;
    let c = if damped { (r.f64() * 40.0).round() / 100.0 + 0.05 } else { 0.0 };
    let h = (0.003 * 100f64.powf(r.f64()) / k.sqrt() * 1000.0).ceil() / 1000.0;
    let several = method.older() > 0;
    let every = [1, 1, 1, 2, 5, 10, 20, 1 + r.u32(..100)][r.usize(..8)];
    let every = if several { 1 } else { every };
    let digits = 4 + r.usize(..14);
    let rows = 40 + r.usize(..300);
    let with_velocities = several || r.f64() < 0.85;
    let force = if r.f64() < 0.1 { Force::Linear } else { Force::Sine };
    let equation = Equation { force, k, c, drive: [0.0; 3] };
    let start = [0.2 + 2.7 * r.f64(), if r.bool() { 0.0 } else { r.f64() }];
    let mut z: State = start.map(|x| (x * 100.0).round() / 100.0);
    let scientific = r.bool();
    let number = |x: f64| match digits {
        17 => format!("{x:?}"),
        _ if scientific => format!("{x:.*e}", digits - 1),
        _ => format!("{x:.*}", digits - 1),
    };
    // A method of several steps begins with the exact motion.
    let fine = named("dormand-prince-8")?;
    let back = |i: usize| fine.run(&equation, 0.0, z, -h / 16.0, 16 * i as u32);
    let mut past: Vec<State> = (0..=method.older()).map(back).collect();
    let mut text = String::from(if with_velocities { "t,theta,omega\n" } else { "t,theta\n" });
    for n in 0..rows {
        let t = n as f64 * h * f64::from(every);
        // A mistake may lead out of every range.
        if !(z[0].abs() < 1e6 && z[1].abs() < 1e6) {
            if n < 20 {
                return None;
            }
            break;
        }
        write!(text, "{},{}", (t * 1e9).round() / 1e9, number(z[0])).ok()?;
        if with_velocities {
            write!(text, ",{}", number(z[1])).ok()?;
        }
        text.push('\n');
        if several {
            z = method.step_from(&equation, t, &past, h);
            past.insert(0, z);
            past.pop();
        } else {
            z = method.run(&equation, t, z, h, every);
        }
    }
    Some(Made { text, name: method.name, digits })
}
