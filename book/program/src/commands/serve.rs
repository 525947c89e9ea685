//! `pendula serve`: a method of the library as a program that answers on standard input and output:
//! the other side of `pendula verify`. Those that can choose their steps answer as solvers too.

use std::io::{self, BufRead, Write};

use clap::Args;
use pendula::adaptive::TaylorSeries;
use pendula::methods::{Dop853, DormandPrince};
use pendula::{AnyMethod, Info, method_named};
use pendula_judge::protocol::{Question, question};
use pendula_judge::{ByTolerance, Chosen, Crossings, Fault, Integrator, Reply, Solver};

use super::system::{SERIES, methods_and_series};
use crate::output::failure::Failure;

/// Arguments of `pendula serve`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The method
    #[arg(value_name = "METHOD", value_parser = methods_and_series())]
    method: String,
}

/// Answers the requests on standard input until `bye`, or until they end.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let served = Served::named(&arguments.method)
        .ok_or_else(|| Failure::refused(format!("{}: no such method", arguments.method)))?;
    Ok(served.serve(io::stdin().lock(), out)?)
}

/// A method that is served: in equal steps, in steps of its own choice, or both.
struct Served {
    name: &'static str,
    method: Option<&'static dyn AnyMethod>,
    solver: Option<Box<dyn Solver>>,
}

impl Served {
    /// The method of this name.
    fn named(name: &str) -> Option<Self> {
        if name == SERIES {
            let solver = Box::new(ByTolerance::undriven(TaylorSeries));
            return Some(Self { name: SERIES, method: None, solver: Some(solver) });
        }
        let method = method_named(name)?;
        let name = method.info().name;
        let solver: Option<Box<dyn Solver>> = match name {
            name if name == Dop853.info().name => Some(Box::new(ByTolerance::new(Dop853))),
            name if name == DormandPrince.info().name => {
                Some(Box::new(ByTolerance::new(DormandPrince)))
            }
            _ => None,
        };
        Some(Self { name, method: Some(method), solver })
    }

    /// Answers the lines of `input` until `bye`, or until they end.
    fn serve(&self, mut input: impl BufRead, out: &mut dyn Write) -> io::Result<()> {
        let mut line = Vec::new();
        loop {
            line.clear();
            if input.read_until(b'\n', &mut line)? == 0 {
                return Ok(());
            }
            match question(&String::from_utf8_lossy(&line)) {
                Ok(Question::Bye) => return Ok(()),
                Ok(Question::Hello) => writeln!(out, "hello 1 pendula {}", self.name)?,
                Ok(Question::Run(request)) => {
                    self.states(self.integrator().and_then(|one| one.answer(&request)), out)?;
                }
                Ok(Question::Solve(request)) => {
                    self.states(self.solver().and_then(|one| one.solve(&request)), out)?;
                }
                Ok(Question::Crossings(request)) => {
                    self.crossings(self.solver().and_then(|one| one.crossings(&request)), out)?;
                }
                Err(answer) => writeln!(out, "{answer}")?,
            }
            out.flush()?;
        }
    }

    /// The method as an integrator: with a drive if it suits the driven pendulum.
    fn integrator(&self) -> Result<Chosen<'static>, Fault> {
        let pendulum = self.method.ok_or(Fault::Unsupported)?;
        Ok(Chosen { pendulum, driven: method_named(self.name) })
    }

    fn solver(&self) -> Result<&dyn Solver, Fault> {
        self.solver.as_deref().ok_or(Fault::Unsupported)
    }

    /// Answers by states.
    fn states(&self, reply: Result<Reply, Fault>, out: &mut dyn Write) -> io::Result<()> {
        match reply {
            Ok(Reply { states, evaluations }) => {
                self.rows(states.iter().map(|z| [z.theta, z.omega]), evaluations, out)
            }
            Err(fault) => refuse(fault, out),
        }
    }

    /// Answers by crossings.
    fn crossings(&self, reply: Result<Crossings, Fault>, out: &mut dyn Write) -> io::Result<()> {
        match reply {
            Ok(crossings) => {
                self.rows(crossings.iter().map(|(t, z)| [*t, z.theta, z.omega]), None, out)
            }
            Err(fault) => refuse(fault, out),
        }
    }

    /// Prints the rows of an answer, and that it is done.
    fn rows<const N: usize>(
        &self,
        rows: impl Iterator<Item = [f64; N]> + Clone,
        evaluations: Option<u64>,
        out: &mut dyn Write,
    ) -> io::Result<()> {
        if !rows.clone().flatten().all(f64::is_finite) {
            return match self.method.is_some_and(|method| method.info().implicit) {
                true => writeln!(out, "error the step did not converge"),
                false => writeln!(out, "error the states leave the range of numbers"),
            };
        }
        for row in rows {
            writeln!(out, "{}", row.map(|number| format!("{number:?}")).join(" "))?;
        }
        match evaluations {
            Some(evaluations) => writeln!(out, "done {evaluations}"),
            None => writeln!(out, "done"),
        }
    }
}

/// Says why there is no answer.
fn refuse(fault: Fault, out: &mut dyn Write) -> io::Result<()> {
    match fault {
        Fault::Unsupported => writeln!(out, "unsupported"),
        Fault::Refused(why) | Fault::Lost(why) | Fault::Broken(why) => writeln!(out, "error {why}"),
        fault => writeln!(out, "error {fault}"),
    }
}

#[cfg(test)]
mod tests {
    use std::fmt;

    use pendula::adaptive::Controlled;
    use pendula::{METHODS, Pendulum, Phase};
    use pendula_judge::{CrossingsRequest, Drive, SolveRequest};
    use rstest::rstest;

    use super::*;

    /// What the method of this name answers to these lines.
    fn answers(name: &str, lines: &str) -> Vec<String> {
        let mut out = Vec::new();
        Served::named(name).unwrap().serve(lines.as_bytes(), &mut out).unwrap();
        String::from_utf8(out).unwrap().lines().map(str::to_string).collect()
    }

    /// Catches: a method that is not served, a drive that one of the general methods lacks, a drive
    /// made up for those that have none, a way back that does not lead back.
    #[test]
    fn every_method_is_served_on_the_way_out_and_back() {
        let state = |line: &String| {
            let numbers: Vec<f64> = line.split(' ').map(|word| word.parse().unwrap()).collect();
            (numbers[0], numbers[1])
        };
        for method in METHODS {
            let name = method.info().name;
            let out = answers(name, "pendulum 9.81 1 0 0.001 100 50\n");
            let [_, end, done] = &out[..] else { panic!("{name}: {out:?}") };
            assert!(done.starts_with("done ") && done.len() > "done 1".len(), "{name}: {done}");
            let (theta, omega) = state(end);
            let back = format!("pendulum 9.81 {theta:?} {omega:?} -0.001 100 100");
            let (theta, omega) = state(&answers(name, &back)[0]);
            // Forward Euler's error on either way is about h t (g/L)/2 · g/L: some 5e-3.
            assert!((theta - 1.0).abs() < 1e-2 && omega.abs() < 1e-1, "{name}: {theta} {omega}");

            let driven = answers(name, "driven 9.81 0.5 2 1 0 0.01 10 10\n");
            match name {
                "taylor-24"
                | "discrete-gradient"
                | "cieslinski-ratkiewicz"
                | "deuflhard"
                | "processed-4"
                | "processed-6" => {
                    assert_eq!(driven, ["unsupported"]);
                }
                _ => assert_eq!((driven.len(), &driven[1][..]), (2, "done"), "{name}"),
            }
        }
    }

    /// Catches: one bad line that ends the service or changes the next answer, an answer to `bye`,
    /// an answer after it, NaN served as a state, a run that takes for ever.
    #[test]
    fn each_line_has_its_own_answer() {
        let request = "pendulum 9.81 1 0 0.01 4 2\n";
        let alone = answers("gauss-4", request);
        assert_eq!(alone.len(), 3);
        let lines = ["hello 1\r\n", "\n", "pendulum 9.81\n", "\u{ff}\n", request].concat();
        let lines = lines + "pendulum 9.81 1 0 5 4 2\n" + request + "bye\nhello 1\n";
        let mut expected =
            ["hello 1 pendula gauss-4", "unsupported", "error the numbers are g/L θ ω h n k"]
                .map(str::to_string)
                .to_vec();
        expected.push("unsupported".to_string());
        expected.extend_from_slice(&alone);
        expected.push("error the step did not converge".to_string());
        expected.extend_from_slice(&alone);
        assert_eq!(answers("gauss-4", &lines), expected);
        let refused = |line| answers("stormer-verlet", line).concat();
        assert!(refused("pendulum -1 1 0 0.01 4 2").starts_with("error "));
        assert_eq!(refused("pendulum 1 1 0 0.1 100000000 1"), "error more than 10000000 states");
        let for_ever = format!("pendulum 1 1 0 0.1 {0} {0}", u64::MAX);
        assert_eq!(refused(&for_ever), "error more than 1000000000 steps");
        let overflow = answers("forward-euler", "pendulum 1 1 0 1e200 4 1");
        assert_eq!(overflow, ["error the states leave the range of numbers"]);
    }

    /// A request for states of the pendulum from 2 rad, with ω₀ other than 1.
    fn solve() -> SolveRequest {
        SolveRequest::new(9.81, Phase { theta: 2.0, omega: 0.3 }, 1e-8)
    }

    /// The rows of an answer by one of these names, and its last line.
    fn rows<const N: usize>(name: &str, question: &dyn fmt::Display) -> (Vec<[f64; N]>, String) {
        let mut lines = answers(name, &format!("{question}\n"));
        let done = lines.pop().unwrap();
        let row = |line: &String| {
            let numbers: Vec<f64> = line.split(' ').map(|word| word.parse().unwrap()).collect();
            numbers.try_into().unwrap()
        };
        (lines.iter().map(row).collect(), done)
    }

    /// Catches: another method or another tolerance than was asked for, a time that is left out or
    /// told twice, one equal to the start or to the time before it that is refused; a run that does
    /// not lead back, or does not begin at its own time; bits that are lost on the way.
    #[rstest]
    #[case::dop853("dop853", Dop853)]
    #[case::dormand_prince("dormand-prince", DormandPrince)]
    #[case::series(SERIES, TaylorSeries)]
    fn a_solver_is_served<M: Controlled<Pendulum>>(#[case] name: &str, #[case] method: M) {
        let solver = ByTolerance::undriven(method);
        let thousand: Vec<f64> = (1..=1000).map(|k| 1e-4 * f64::from(k)).collect();
        for request in [
            solve().to(&[10.0]),
            solve().to(&[0.0, 2.5, 2.5, 5.0, 10.0, 10.0]),
            solve().to(&[-0.0, -2.5, -10.0]),
            solve().to(&thousand),
            solve().from(1e6).to(&[1e6, 1_000_002.5]),
        ] {
            let reply = solver.solve(&request).unwrap();
            let (states, done) = rows(name, &request);
            assert_eq!(states.len(), request.times.len(), "{request}");
            for (state, z) in states.iter().zip(&reply.states) {
                assert_eq!(state.map(f64::to_bits), [z.theta, z.omega].map(f64::to_bits));
            }
            assert_eq!(done, format!("done {}", reply.evaluations.unwrap()), "{request}");
        }
        let equal = rows::<2>(name, &solve().to(&[0.0, 2.5, 2.5])).0;
        assert_eq!((equal[0], equal[1]), ([2.0, 0.3], equal[2]));
        let here = rows::<2>(name, &solve().from(3.0).to(&[3.0, 3.0])).0;
        assert_eq!(here, [[2.0, 0.3]; 2]);

        for span in [[0.0, 10.0], [10.0, 0.0], [5.0, 5.0]] {
            let request = CrossingsRequest::new(9.81, Phase::at_rest(2.0), span, 1e-8);
            let expected = solver.crossings(&request).unwrap();
            let (crossings, done) = rows(name, &request);
            let of_library = expected.iter().map(|(t, z)| [*t, z.theta, z.omega]);
            assert_eq!(crossings, of_library.collect::<Vec<[f64; 3]>>());
            // The period is 2.67 s.
            assert_eq!((crossings.len(), &*done), (if span[0] == 5.0 { 0 } else { 8 }, "done"));
        }
    }

    /// Catches: a drive that is left out, is not that of the equal steps, or does not know the time
    /// of the start.
    #[test]
    fn a_solver_is_driven() {
        let drive = Drive { amplitude: 3.0, frequency: 1.0 };
        let request = solve().from(1.5).driven(drive).to(&[2.5, 4.0]);
        let expected = ByTolerance::new(Dop853).solve(&request).unwrap().states;
        let [eight, five] = ["dop853", "dormand-prince"].map(|name| rows::<2>(name, &request).0);
        assert_eq!(eight, expected.iter().map(|z| [z.theta, z.omega]).collect::<Vec<_>>());
        let undriven = rows::<2>("dop853", &solve().from(1.5).to(&[2.5, 4.0])).0;
        for k in 0..2 {
            assert!((eight[k][0] - five[k][0]).abs() < 1e-5, "{eight:?} {five:?}");
            assert!((eight[k][0] - undriven[k][0]).abs() > 0.1, "{eight:?} {undriven:?}");
        }
        let from_zero = solve().driven(drive).to(&[1.5]);
        let steps = "driven 9.81 3 1 2 0.3 0.001 1500 1500";
        let [equal, varying] = [steps, &from_zero.to_string()].map(|line| {
            let (rows, _) = rows::<2>("dop853", &line);
            rows[0]
        });
        assert!((equal[0] - varying[0]).abs() < 1e-6, "{equal:?} {varying:?}");
    }

    /// Catches: a method of equal steps that solves, a series that does not; the impossible taken
    /// for something else, or tried for ever; a refusal in more than a line, or one that
    /// ends the service.
    #[test]
    fn what_no_solver_can_answer_is_refused() {
        let questions = [
            solve().to(&[1.0]).to_string(),
            CrossingsRequest::new(9.81, Phase::at_rest(2.0), [0.0, 1.0], 1e-8).to_string(),
            solve().driven(Drive { amplitude: 3.0, frequency: 1.0 }).to(&[1.0]).to_string(),
        ];
        for name in ["rk4", "taylor-24", "stormer-verlet", "gauss-4"] {
            assert_eq!(answers(name, &questions.join("\n")), ["unsupported"; 3], "{name}");
        }
        assert_eq!(answers(SERIES, &questions[2]), ["unsupported"]);
        assert_eq!(answers(SERIES, "pendulum 9.81 1 0 0.01 4 2"), ["unsupported"]);
        assert_eq!(answers(SERIES, "hello 1"), ["hello 1 pendula taylor-series"]);

        let crossings = |until, tolerance| format!("crossings 9.81 2 0 0 {until:?} {tolerance:?}");
        let (start, infinity, nan) = (Phase::at_rest(2.0), f64::INFINITY, f64::NAN);
        let mut impossible = [0.0, -1e-8, nan, infinity, 1e-20, 2.0]
            .map(|tolerance| SolveRequest::new(9.81, start, tolerance).to(&[1.0]).to_string())
            .to_vec();
        impossible.extend(
            [vec![infinity], vec![1.0, nan, 2.0], vec![nan], vec![-infinity]]
                .map(|times| solve().to(&times).to_string()),
        );
        impossible.extend([
            crossings(infinity, 1e-8),
            crossings(nan, 1e-8),
            crossings(10.0, nan),
            crossings(10.0, 0.0),
            SolveRequest::new(-1.0, start, 1e-8).to(&[1.0]).to_string(),
            solve().to(&[2.0, 1.0]).to_string(),
            solve().to(&[]).to_string(),
        ]);
        for name in ["dop853", "dormand-prince", SERIES] {
            let lines = impossible.join("\n") + "\n" + &questions[0] + "\n";
            let told = answers(name, &lines);
            let (refused, answered) = told.split_at(impossible.len());
            for (line, question) in refused.iter().zip(&impossible) {
                assert!(line.starts_with("error "), "{name}: {question}: {line}");
            }
            assert_eq!(answered, answers(name, &questions[0]), "{name}");
        }
    }
}
