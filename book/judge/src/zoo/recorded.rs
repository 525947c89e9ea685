//! Answers of solvers, recorded: so that a judgement can be repeated where the solver is not.
//!
//! Of an answer of a few rows all bits are kept. Of a long one the judge looks at the smallest and
//! the largest error of each twentieth, at the last row, and at whether the others are numbers of
//! single precision; so these are kept, errors to a fifth of a decade. Of an answer of too few or
//! too many rows, or with one that is not finite, their number is kept. Passages through zero are
//! kept to 10⁻¹⁴, a hundredth of the least that they are held to. What is read back differs from
//! what was recorded by no more than that.

use std::cell::{Cell, RefCell};
use std::collections::HashMap;
use std::fmt::Display;
use std::time::Duration;

use pendula::systems::Phase;

use crate::integrator::{Fault, Reply};
use crate::judge::probe::exact;
use crate::solver::{Crossings, CrossingsRequest, SolveRequest, Solver};
use crate::solver_judge::{PARTS, errors, single};

/// Up to so many rows are kept to the bit.
const SHORT: usize = 12;

/// The characters that stand for errors: from '!' for 10⁻¹⁸ rad on, five to the decade.
fn character(error: f64) -> char {
    let fifths = libm::round(5.0 * (libm::log10(error.max(1e-18)) + 18.0)).clamp(0.0, 93.0);
    char::from(b'!' + fifths as u8)
}

fn size(character: char) -> f64 {
    libm::pow(10.0, (f64::from(u32::from(character)) - f64::from(b'!')) / 5.0 - 18.0)
}

/// A number that tells requests apart (FNV-1a, folded to half).
fn key(request: &str) -> String {
    let mix = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    let hash = request.bytes().fold(0xcbf2_9ce4_8422_2325, mix);
    format!("{:08x}", (hash >> 32) as u32 ^ hash as u32)
}

/// The request with thirteen digits of each number: an answer is found by them, so that it is still
/// found after the exact solution, where some runs begin, has changed in its last bits.
fn roughly(request: &str) -> String {
    let word = |word: &str| match word.parse::<f64>() {
        Ok(number) => format!("{number:.12e}"),
        Err(_) => word.to_string(),
    };
    request.split(' ').map(word).collect::<Vec<_>>().join(" ")
}

/// A number as it reads back to the bit, in the shorter of two forms.
fn exactly(x: f64) -> String {
    let [plain, scientific] = [format!("{x}"), format!("{x:e}")];
    if plain.len() <= scientific.len() { plain } else { scientific }
}

/// A number to 10⁻¹⁴.
fn rounded(x: f64) -> String {
    exactly(format!("{x:.14}").parse().unwrap_or(x))
}

/// A long answer, but for its last row, in twentieths.
fn parts<T>(rows: &[T]) -> impl Iterator<Item = &[T]> {
    let others = &rows[..rows.len() - 1];
    others.chunks(rows.len().div_ceil(PARTS))
}

/// A solver whose answers are recorded.
pub struct Recording<'s> {
    solver: &'s dyn Solver,
    /// Requests and answers.
    notes: RefCell<Vec<(String, String)>>,
}

impl<'s> Recording<'s> {
    /// Nothing is recorded yet.
    pub fn of(solver: &'s dyn Solver) -> Self {
        Self { solver, notes: RefCell::new(Vec::new()) }
    }

    /// The lines to keep: of equal answers at the end one, as the last is given again.
    ///
    /// # Panics
    /// If two requests have one key.
    pub fn lines(self) -> String {
        // Of each key the request, the last answer, and how often that was given again.
        let mut keys = HashMap::<String, (String, String, usize)>::new();
        let mut lines = String::new();
        for (request, told) in self.notes.into_inner() {
            // Two requests that differ beyond the thirteenth digit: the second has all its digits.
            let rough = key(&roughly(&request));
            let is_taken = keys.get(&rough).is_some_and(|(first, ..)| *first != request);
            let key = if is_taken { key(&request) } else { rough };
            let known =
                keys.entry(key.clone()).or_insert_with(|| (request.clone(), String::new(), 0));
            let (first, last, again) = known;
            assert_eq!(*first, request, "two requests of one key");
            if told == *last {
                *again += 1;
                continue;
            }
            lines += &format!("{key} {last}\n").repeat(*again);
            lines += &format!("{key} {told}\n");
            (*last, *again) = (told, 0);
        }
        lines
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
        self.notes.borrow_mut().push((request.to_string(), told));
        answer
    }
}

impl Solver for Recording<'_> {
    fn solve(&self, request: &SolveRequest) -> Result<Reply, Fault> {
        self.note(request, self.solver.solve(request), |reply| {
            let counted = reply.evaluations.map_or("-".to_string(), |n| n.to_string());
            let states = &reply.states;
            let is_finite = |z: &Phase| z.theta.is_finite() && z.omega.is_finite();
            // All that the judge asks of such an answer.
            if states.len() != request.times.len() || !states.iter().all(is_finite) {
                return format!("# {counted} {}", states.len());
            }
            let row = |z: &Phase| format!(" {} {}", exactly(z.theta), exactly(z.omega));
            if states.len() <= SHORT {
                return format!("= {counted}{}", states.iter().map(row).collect::<String>());
            }
            let (last, others) = (row(&states[states.len() - 1]), &states[..states.len() - 1]);
            let kind = if single(others) { 's' } else { '~' };
            let errors = errors(request, states);
            let extremes = parts(&errors).flat_map(|part| {
                let least = part.iter().copied().fold(f64::INFINITY, f64::min);
                [least, part.iter().copied().fold(0.0, f64::max)].map(character)
            });
            format!("{kind} {counted}{last} {}", extremes.collect::<String>())
        })
    }

    fn crossings(&self, request: &CrossingsRequest) -> Result<Crossings, Fault> {
        self.note(request, self.solver.crossings(request), |found| {
            let rows = found.iter().flat_map(|(t, z)| [*t, z.theta, z.omega]);
            format!("x{}", rows.map(|x| format!(" {}", rounded(x))).collect::<String>())
        })
    }

    fn patience(&self) -> Duration {
        self.solver.patience()
    }

    fn may_hang(&self) -> bool {
        self.solver.may_hang()
    }

    fn clock(&self) -> Duration {
        self.solver.clock()
    }
}

/// What was recorded, as a solver: of each request the answers, in their order, and how many of
/// them were given. The last is given again.
pub struct Recorded<'t>(HashMap<&'t str, (Vec<&'t str>, Cell<usize>)>);

impl<'t> Recorded<'t> {
    /// Reads the lines of a [`Recording`].
    pub fn read(lines: &'t str) -> Self {
        let mut answers = HashMap::<_, (Vec<_>, _)>::new();
        for (key, told) in lines.lines().filter_map(|line| line.split_once(' ')) {
            answers.entry(key).or_default().0.push(told);
        }
        Self(answers)
    }

    /// The words of an answer.
    fn words(&self, request: &impl Display) -> Result<Vec<&'t str>, Fault> {
        // The judge asks something else than when the record was made.
        let not_recorded =
            || Fault::Refused("its record has no answer to this question".to_string());
        let request = request.to_string();
        let with_key = |request: &str| self.0.get(key(request).as_str());
        let found = with_key(&request).or_else(|| with_key(&roughly(&request)));
        let (answers, given) = found.ok_or_else(not_recorded)?;
        let index = given.replace(given.get() + 1).min(answers.len() - 1);
        match answers[index].split_once(' ') {
            Some(("!", why)) => Err(Fault::Refused(why.to_string())),
            None if answers[index] == "?" => Err(Fault::Unsupported),
            _ => Ok(answers[index].split(' ').collect()),
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
        let phase = |[theta, omega]: [f64; 2]| Phase { theta, omega };
        if let ("#", [came]) = (kind, rest) {
            let nothing = phase([f64::NAN; 2]);
            let states = vec![nothing; came.parse().map_err(|_| broken())?];
            return Ok(Reply { states, evaluations });
        }
        if kind == "=" {
            let states = groups::<2>(rest).into_iter().map(phase).collect();
            return Ok(Reply { states, evaluations });
        }
        let (&[ref last @ .., extremes], [.., _]) = (rest, &request.times[..]) else {
            return Err(broken());
        };
        let motion = exact(request.g_over_l, request.start);
        let extremes: Vec<f64> = extremes.chars().map(size).collect();
        let mut states = Vec::new();
        for (times, extremes) in parts(&request.times).zip(extremes.chunks(2)) {
            // The first has the least error, and the others the largest.
            let all = extremes.iter().chain(core::iter::repeat(&extremes[extremes.len() - 1]));
            states.extend(times.iter().zip(all).map(|(t, error)| {
                let z = motion.at(t - request.from);
                Phase { theta: z.theta + error, ..z }
            }));
        }
        if kind == "s" {
            states
                .iter_mut()
                .for_each(|z| *z = phase([z.theta, z.omega].map(|x| f64::from(x as f32))));
        }
        states.extend(groups::<2>(last).into_iter().map(phase));
        Ok(Reply { states, evaluations })
    }

    fn crossings(&self, request: &CrossingsRequest) -> Result<Crossings, Fault> {
        let words = self.words(request)?;
        let rows = groups::<3>(&words[1..]).into_iter();
        Ok(rows.map(|[t, theta, omega]| (t, Phase { theta, omega })).collect())
    }

    /// Nobody waits for it.
    fn patience(&self) -> Duration {
        Duration::from_secs(1_000_000)
    }

    fn may_hang(&self) -> bool {
        true
    }
}
