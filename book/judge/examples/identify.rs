//! Random tables of right methods, and as many of mistakes, which `rows::identify` is given: no
//! table may be given another's name, or a fault that it has not. Prints how many are named, by
//! digits, and fails if something false is said of one. The tables are the same on every machine.
//!
//! The chapter has what `cargo run --example identify 2000` prints, in
//! some twenty minutes; `identify COUNT FROM` takes as many of each from another seed on.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::process::ExitCode;

use pendula_judge::rows::candidates::{Candidate, Equation, State, all, named};
use pendula_judge::rows::{Force, Maker, identify};

/// A table, and what it was made by.
struct Made {
    text: String,
    name: &'static str,
    steps: u32,
    equation: Equation,
    digits: usize,
}

/// What is said of a table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Said {
    Named,
    /// It cannot be told, and the maker is among the examples, or is not.
    AnyWith,
    AnyWithout,
    Other,
    Falsely,
}

/// The digits, and what is said of the tables with so many: of methods, and of mistakes.
type Counts = BTreeMap<usize, [BTreeMap<Said, u32>; 2]>;

fn main() -> ExitCode {
    let mut numbers = std::env::args().skip(1).map(|count| count.parse::<u64>().expect("a number"));
    let (count, from) = (numbers.next().unwrap_or(1000), numbers.next().unwrap_or(0));
    let mut falsely = 0;
    let mut found = Counts::new();
    for (which, right) in [true, false].into_iter().enumerate() {
        for seed in from..from + count {
            let Some(made) = table(seed, right) else { continue };
            let said = said(&made).unwrap_or_else(|false_word| {
                eprintln!("{right} {seed}: {} in {}: {false_word}", made.name, made.steps);
                falsely += 1;
                Said::Falsely
            });
            *found.entry(made.digits).or_default()[which].entry(said).or_default() += 1;
        }
    }
    print!("{}", page(&found));
    let all = |said| found.values().flatten().filter_map(|counts| counts.get(&said)).sum::<u32>();
    let (with, without) = (all(Said::AnyWith), all(Said::AnyWithout));
    eprintln!(
        "Of {} that cannot be told, {without} have not the maker as example.",
        with + without
    );
    if falsely == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// The counts as a table in Markdown.
fn page(found: &Counts) -> String {
    let mut page = String::from(
        "| Digits | A method: named | left open | not found | A mistake: named | left open | not \
         found |\n\
         |---:|---:|---:|---:|---:|---:|---:|\n",
    );
    for (digits, counts) in found {
        write!(page, "| {digits} |").expect("a text takes it");
        for counts in counts {
            let count = |said| counts.get(&said).copied().unwrap_or(0);
            let open = [Said::AnyWith, Said::AnyWithout].map(count).iter().sum();
            let cells = [count(Said::Named), open, count(Said::Other)];
            for cell in cells {
                write!(page, " {cell} |").expect("a text takes it");
            }
        }
        page.push('\n');
    }
    page
}

/// What is said of a table, or what is false in it.
///
/// A name is right with its steps, or if the maker is among those that are said to have the same
/// rows. Numbers are right within what they are said to be known to.
/// Rows that no one has touched have no faults, and no noise.
fn said(made: &Made) -> Result<Said, String> {
    let Ok(report) = identify(made.text.as_bytes()) else { return Ok(Said::Other) };
    if let Some(fault) = report.faults.first() {
        return Err(format!("there is no such fault: {fault}"));
    }
    let is_it = |method: &pendula_judge::rows::Made| {
        let own = method.name == made.name && method.steps == made.steps;
        own || method.same.iter().any(|(name, _)| *name == made.name)
    };
    let numbers = |method: &pendula_judge::rows::Made| {
        if method.name != made.name || method.steps != made.steps {
            return Ok(());
        }
        let (k, c) = (method.equation.k, method.equation.damping);
        let off = (k.value - made.equation.k).abs();
        let damping = c.map_or(0.0, |c| c.value) - made.equation.c;
        let c_known_to = c.map_or(1e-9, |c| c.known_to);
        if method.equation.force != made.equation.force {
            return Err(format!("another force, {:?}", method.equation.force));
        }
        if off > k.known_to.max(1e-12 * made.equation.k) {
            return Err(format!("k is off: {k:?}, not {}", made.equation.k));
        }
        if damping.abs() > c_known_to {
            return Err(format!("c is off: {c:?}, not {}", made.equation.c));
        }
        Ok(())
    };
    match &report.maker {
        Maker::Method(method) if is_it(method) => numbers(method).map(|()| Said::Named),
        Maker::Method(method) => Err(format!("is said to be {} in {}", method.name, method.steps)),
        Maker::Several { methods, .. } => {
            Ok(if methods.iter().any(is_it) { Said::AnyWith } else { Said::AnyWithout })
        }
        Maker::Measured { noise } => Err(format!("there is no noise of {noise}")),
        _ => Ok(Said::Other),
    }
}

/// A table by a random method: its step, k, drag, start, digits and how many steps a row.
fn table(seed: u64, right: bool) -> Option<Made> {
    let mut r = fastrand::Rng::with_seed(seed);
    let pool: Vec<&Candidate> =
        all().iter().filter(|c| c.right == right && c.suits(false, false)).collect();
    let method = pool[r.usize(..pool.len())];
    let k = [9.81, 9.8, 1.0, 0.5 * libm::pow(40.0, r.f64())][r.usize(..4)];
    let damped = method.suits(true, false) && r.f64() < 0.3;
    let c = if damped { (r.f64() * 40.0).round() / 100.0 + 0.05 } else { 0.0 };
    let h = (0.003 * libm::pow(100.0, r.f64()) / k.sqrt() * 1000.0).ceil() / 1000.0;
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
    Some(Made { text, name: method.name, steps: every, equation, digits })
}
