//! Solvers that choose their steps by a tolerance: one solver a program.

use crate::Pendulum;
use std::io::{stdin, stdout, BufRead, Write};
use std::panic::{catch_unwind, set_hook, AssertUnwindSafe};

/// One request.
pub struct Run {
    pub pendulum: Pendulum,
    /// theta and omega.
    pub start: [f64; 2],
    pub tol: f64,
    /// The tolerance of theta and of omega, for a library that takes two.
    pub each: [f64; 2],
    /// Where the run begins, and then each of the times once.
    pub grid: Vec<f64>,
    asked: Vec<f64>,
}

impl Run {
    fn new(verb: &str, mut numbers: Vec<f64>) -> Result<Self, String> {
        let (most, driven) = (numbers.len(), verb == "driven-solve");
        if most < if driven { 8 } else { 6 } {
            return Err("numbers are missing".into());
        }
        if !driven {
            numbers.splice(1..1, [0.0, 0.0]);
        }
        let &[gl, a, w, theta, omega, t0, ref rest @ ..] = &numbers[..] else {
            return Err("numbers are missing".into());
        };
        // The end of crossings stands before the tolerance.
        let (tol, asked) = if verb == "crossings" {
            (rest[1], vec![rest[0]])
        } else {
            (rest[0], rest[1..].to_vec())
        };
        let mut grid = vec![t0];
        for t in &asked {
            if grid.last() != Some(t) {
                grid.push(*t);
            }
        }
        // A library that hangs with these, or takes them for others, is not asked.
        if grid.iter().any(|t| !t.is_finite()) {
            return Err("a time is not finite".into());
        }
        if grid.windows(2).any(|two| (two[1] > two[0]) != (grid[1] > grid[0])) {
            return Err("the times turn round".into());
        }
        let pendulum = Pendulum { gl, a, w, ..Default::default() };
        let each = [tol, tol * gl.abs().sqrt()];
        Ok(Run { pendulum, start: [theta, omega], tol, each, grid, asked })
    }

    pub fn from(&self) -> f64 {
        self.grid[0]
    }

    pub fn end(&self) -> f64 {
        self.grid[self.grid.len() - 1]
    }

    /// The derivatives of angle and velocity, counted.
    pub fn rate(&self, t: f64, y: [f64; 2]) -> [f64; 2] {
        [y[1], self.pendulum.force(y[0], t)]
    }

    /// A thousandth of the time of a radian of small swings, for a library that takes a first step.
    pub fn first(&self) -> f64 {
        (1e-3 / self.pendulum.gl.abs().sqrt()).copysign(self.end() - self.from())
    }
}

/// theta and omega at the times of the grid after its first, which is the start.
pub type States = Result<Vec<[f64; 2]>, String>;

/// t, theta and omega where theta passes zero.
pub type Crossings = Result<Vec<[f64; 3]>, String>;

/// A solver: its name, its states, and its crossings where the library looks for events.
pub struct Solver {
    pub name: &'static str,
    pub solve: fn(&Run) -> States,
    pub crossings: Option<fn(&Run) -> Crossings>,
}

fn lines<const N: usize>(rows: &[[f64; N]]) -> String {
    let line = |row: &[f64; N]| row.map(|x| format!("{x:e}")).join(" ") + "\n";
    rows.iter().map(line).collect()
}

fn answer(solver: &Solver, verb: &str, numbers: Vec<f64>) -> Result<String, String> {
    let run = Run::new(verb, numbers)?;
    // A run of no length is left to no library.
    let none = run.grid.len() == 1;
    let text = if verb == "crossings" {
        let crossings = solver.crossings.ok_or("unsupported")?;
        lines(&if none { vec![] } else { crossings(&run)? })
    } else {
        let mut states = vec![run.start];
        if !none {
            states.extend((solver.solve)(&run)?);
        }
        if states.len() != run.grid.len() {
            return Err(format!("{} states of {}", states.len() - 1, run.grid.len() - 1));
        }
        let mut at = 0;
        let mut rows = Vec::with_capacity(run.asked.len());
        for t in &run.asked {
            at += usize::from(*t != run.grid[at]);
            rows.push(states[at]);
        }
        lines(&rows)
    };
    Ok(format!("{text}done {}", run.pendulum.forces.get()))
}

/// Answers requests until `bye`. The solver's name is the program's argument.
pub fn serve(solvers: Vec<Solver>) {
    let name = std::env::args().nth(1).unwrap_or_default();
    let Some(solver) = solvers.iter().find(|known| known.name == name) else {
        for known in &solvers {
            println!("{}", known.name);
        }
        std::process::exit(2);
    };
    // A panic is an answer, too.
    set_hook(Box::new(|_| {}));
    for line in stdin().lock().lines().map_while(Result::ok) {
        let mut words = line.split_whitespace();
        let verb = words.next().unwrap_or_default();
        let numbers = words.map_while(|word| word.parse().ok()).collect();
        let reply = match verb {
            "bye" => return,
            "hello" => format!("hello 1 {name}"),
            "crossings" if solver.crossings.is_none() => "unsupported".into(),
            "solve" | "driven-solve" | "crossings" => {
                let asked = AssertUnwindSafe(|| answer(solver, verb, numbers));
                let told = catch_unwind(asked).unwrap_or_else(|why| {
                    let said = why.downcast_ref::<String>().map(String::as_str);
                    let said = said.or(why.downcast_ref::<&str>().copied());
                    Err(format!("a panic: {}", said.unwrap_or("without words")))
                });
                told.unwrap_or_else(|why| format!("error {}", why.replace('\n', " ")))
            }
            _ => "unsupported".into(),
        };
        let mut out = stdout().lock();
        if writeln!(out, "{reply}").and_then(|()| out.flush()).is_err() {
            return;
        }
    }
}
