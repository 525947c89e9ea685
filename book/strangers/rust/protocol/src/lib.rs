//! The judge's text protocol, version 1: one integrator a program.

pub mod solver;

use std::cell::Cell;
use std::io::{BufRead, Write, stdin, stdout};

/// theta'' = -gl sin theta + a cos(w t); `forces` counts its evaluations.
#[derive(Default)]
pub struct Pendulum {
    pub gl: f64,
    pub a: f64,
    pub w: f64,
    pub forces: Cell<usize>,
}

impl Pendulum {
    pub fn force(&self, theta: f64, t: f64) -> f64 {
        self.forces.set(self.forces.get() + 1);
        let force = -self.gl * theta.sin();
        if self.a == 0.0 { force } else { force + self.a * (self.w * t).cos() }
    }
}

/// What is asked for: the start, the step and the number of steps.
pub struct Request {
    pub theta: f64,
    pub omega: f64,
    pub h: f64,
    pub n: usize,
}

/// The states after each step, theta and omega.
pub type Path = Result<Vec<[f64; 2]>, String>;

/// An integrator: its name, whether it knows the time of its stages, and its steps.
pub struct Integrator {
    pub name: &'static str,
    pub drives: bool,
    pub steps: Box<dyn Fn(&Pendulum, &Request) -> Path>,
}

impl Integrator {
    pub fn new(
        name: &'static str,
        drives: bool,
        steps: impl Fn(&Pendulum, &Request) -> Path + 'static,
    ) -> Self {
        Integrator { name, drives, steps: Box::new(steps) }
    }
}

fn answer(integrator: &Integrator, line: &str) -> Option<String> {
    let mut words = line.split_whitespace();
    let verb = words.next()?;
    let numbers: Vec<f64> = words.map_while(|word| word.parse().ok()).collect();
    let (pendulum, rest) = match (verb, numbers.as_slice()) {
        ("pendulum", [gl, rest @ ..]) => (Pendulum { gl: *gl, ..Default::default() }, rest),
        ("driven", [gl, a, w, rest @ ..]) if integrator.drives => {
            (Pendulum { gl: *gl, a: *a, w: *w, ..Default::default() }, rest)
        }
        _ => return None,
    };
    let &[theta, omega, h, n, k] = rest else { return None };
    let (n, k) = (n as usize, k as usize);
    if n == 0 || k == 0 || n % k != 0 {
        return Some("error k must divide n".into());
    }
    let mut text = String::new();
    match (integrator.steps)(&pendulum, &Request { theta, omega, h, n }) {
        Err(why) => return Some(format!("error {}", why.replace('\n', " "))),
        Ok(path) if path.len() != n => return Some(format!("error {} steps", path.len())),
        Ok(path) => {
            for [theta, omega] in path.into_iter().skip(k - 1).step_by(k) {
                text += &format!("{theta:e} {omega:e}\n");
            }
        }
    }
    Some(format!("{text}done {}", pendulum.forces.get()))
}

/// Answers requests until `bye`. The integrator's name is the program's argument.
pub fn serve(integrators: Vec<Integrator>) {
    let name = std::env::args().nth(1).unwrap_or_default();
    let Some(integrator) = integrators.iter().find(|known| known.name == name) else {
        for known in &integrators {
            println!("{}", known.name);
        }
        std::process::exit(2);
    };
    for line in stdin().lock().lines().map_while(Result::ok) {
        let reply = match line.split_whitespace().next() {
            Some("bye") => return,
            Some("hello") => format!("hello 1 {name}"),
            _ => answer(integrator, &line).unwrap_or_else(|| "unsupported".into()),
        };
        let mut out = stdout().lock();
        if writeln!(out, "{reply}").and_then(|()| out.flush()).is_err() {
            return;
        }
    }
}
