//! Answers of solvers, recorded: so that a judgement can be repeated where the solver is not.
//!
//! Of an answer of a few rows all bits are kept; of a long one the size of each error, to a fifth
//! of a decade, and the bits of the last row; of a very long one the largest error alone. What is
//! read back differs from what was recorded by no more than that, along θ.

use std::cell::RefCell;
use std::collections::HashMap;
use std::fmt::Display;

use pendula::systems::Phase;

use crate::judge::probe::exact;
use crate::solver::{Crossings, CrossingsRequest, SolveRequest, Solver};
use crate::solver_judge::errors;
use crate::stranger::{Fault, Reply};

/// Up to so many rows are kept to the bit.
const SHORT: usize = 12;
/// Of more than so many only the largest error is kept.
const LONG: usize = 2000;

/// The characters that stand for errors: from '!' for 10⁻¹⁸ rad on, five to the decade.
fn character(error: f64) -> char {
    let fifths = libm::round(5.0 * (libm::log10(error.max(1e-18)) + 18.0)).clamp(0.0, 93.0);
    char::from(b'!' + fifths as u8)
}

fn size(character: char) -> f64 {
    libm::pow(10.0, (f64::from(u32::from(character)) - f64::from(b'!')) / 5.0 - 18.0)
}

/// A number that tells requests apart (FNV-1a).
fn key(request: &impl Display) -> String {
    let mix = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    let hash = request.to_string().bytes().fold(0xcbf2_9ce4_8422_2325, mix);
    format!("{hash:016x}")
}

/// A solver whose answers are recorded.
pub struct Recording<'s> {
    solver: &'s dyn Solver,
    lines: RefCell<Vec<String>>,
}

impl<'s> Recording<'s> {
    /// Nothing is recorded yet.
    pub fn of(solver: &'s dyn Solver) -> Self {
        Self { solver, lines: RefCell::new(Vec::new()) }
    }

    /// The lines to keep.
    pub fn lines(self) -> String {
        self.lines.into_inner().concat()
    }

    /// Notes an answer, or why there is none, and hands it on.
    fn note<T>(
        &self,
        request: &impl Display,
        answer: Result<T, Fault>,
        told: impl FnOnce(&T) -> String,
    ) -> Result<T, Fault> {
        let told = match &answer {
            Ok(answer) => told(answer),
            Err(Fault::Unsupported) => "?".to_string(),
            Err(fault) => format!("! {fault}").replace('\n', " "),
        };
        self.lines.borrow_mut().push(format!("{} {told}\n", key(request)));
        answer
    }
}

impl Solver for Recording<'_> {
    fn solve(&self, request: &SolveRequest) -> Result<Reply, Fault> {
        self.note(request, self.solver.solve(request), |reply| {
            let counted = reply.evaluations.map_or("-".to_string(), |n| n.to_string());
            let states = &reply.states;
            if states.len() <= SHORT {
                let bits = states.iter().map(|z| format!(" {:e} {:e}", z.theta, z.omega));
                return format!("= {counted}{}", bits.collect::<String>());
            }
            let errors = errors(request, states);
            let last = states.last().copied().unwrap_or_default();
            let last = format!("{:e} {:e}", last.theta, last.omega);
            if states.len() > LONG {
                let largest = errors.into_iter().fold(0.0, f64::max);
                return format!("^ {counted} {last} {}", character(largest));
            }
            let errors: String = errors.into_iter().map(character).collect();
            format!("~ {counted} {last} {errors}")
        })
    }

    fn crossings(&self, request: &CrossingsRequest) -> Result<Crossings, Fault> {
        self.note(request, self.solver.crossings(request), |found| {
            let rows = found.iter().map(|(t, z)| format!(" {t:e} {:e} {:e}", z.theta, z.omega));
            format!("x{}", rows.collect::<String>())
        })
    }

    fn patience(&self) -> std::time::Duration {
        self.solver.patience()
    }
}

/// What was recorded, as a solver.
pub struct Recorded<'t>(HashMap<&'t str, &'t str>);

impl<'t> Recorded<'t> {
    /// Reads the lines of a [`Recording`].
    pub fn read(lines: &'t str) -> Self {
        Self(lines.lines().filter_map(|line| line.split_once(' ')).collect())
    }

    /// The words of an answer.
    fn words(&self, request: &impl Display) -> Result<Vec<&'t str>, Fault> {
        let told = self.0.get(key(request).as_str()).copied().unwrap_or("! not recorded");
        match told.split_once(' ') {
            Some(("!", why)) => Err(Fault::Refused(why.to_string())),
            None if told == "?" => Err(Fault::Unsupported),
            _ => Ok(told.split(' ').collect()),
        }
    }
}

/// The numbers of these words, in groups of N.
fn groups<const N: usize>(words: &[&str]) -> Vec<[f64; N]> {
    let number = |word: &str| word.parse().unwrap_or(f64::NAN);
    words.chunks_exact(N).map(|group| core::array::from_fn(|k| number(group[k]))).collect()
}

impl Solver for Recorded<'_> {
    fn solve(&self, request: &SolveRequest) -> Result<Reply, Fault> {
        let words = self.words(request)?;
        let broken = || Fault::Refused("a recorded line cannot be read".to_string());
        let [kind, counted, ref rest @ ..] = words[..] else { return Err(broken()) };
        let evaluations = counted.parse().ok();
        let pairs = groups::<2>(if kind == "=" { rest } else { &rest[..2] });
        let mut states: Vec<Phase> =
            pairs.into_iter().map(|[theta, omega]| Phase { theta, omega }).collect();
        if kind != "=" {
            let [_, _, errors] = rest[..] else { return Err(broken()) };
            let motion = exact(request.g_over_l, request.start);
            let all =
                errors.chars().chain(core::iter::repeat(errors.chars().last().unwrap_or('~')));
            let off = |(t, error): (&f64, char)| {
                let z = motion.at(t - request.from);
                Phase { theta: z.theta + size(error), ..z }
            };
            let last = states.pop();
            states = request.times.iter().zip(all).map(off).collect();
            states.pop();
            states.extend(last);
        }
        Ok(Reply { states, evaluations })
    }

    fn crossings(&self, request: &CrossingsRequest) -> Result<Crossings, Fault> {
        let words = self.words(request)?;
        let rows = groups::<3>(&words[1..]).into_iter();
        Ok(rows.map(|[t, theta, omega]| (t, Phase { theta, omega })).collect())
    }

    /// Nobody waits for it.
    fn patience(&self) -> std::time::Duration {
        std::time::Duration::from_secs(1_000_000)
    }
}
