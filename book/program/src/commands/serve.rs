//! `pendula serve`: a method of the library as a program that answers on standard input and output:
//! the other side of `pendula verify`.

use std::io::{self, BufRead, Write};

use clap::Args;
use pendula::registry::ByName;
use pendula::{AnyMethod, Driven, method_named};
use pendula_judge::protocol::{Question, question};
use pendula_judge::{Chosen, Fault, Request, Stranger};

use super::system::methods;
use pendula_output::failure::Failure;

/// Arguments of `pendula serve`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The method
    #[arg(value_name = "METHOD", value_parser = methods())]
    method: String,
}

/// Answers the requests on standard input until `bye`, or until they end.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let method = method_named(&arguments.method)
        .ok_or_else(|| Failure::refused(format!("{}: no such method", arguments.method)))?;
    Ok(serve(method, io::stdin().lock(), out)?)
}

/// Answers the lines of `input` by `method` until `bye`, or until they end.
fn serve(
    method: &'static dyn AnyMethod,
    mut input: impl BufRead,
    out: &mut dyn Write,
) -> io::Result<()> {
    let stranger = stranger(method);
    let mut line = Vec::new();
    loop {
        line.clear();
        if input.read_until(b'\n', &mut line)? == 0 {
            return Ok(());
        }
        match question(&String::from_utf8_lossy(&line)) {
            Ok(Question::Bye) => return Ok(()),
            Ok(Question::Hello) => writeln!(out, "hello 1 pendula {}", method.info().name)?,
            Ok(Question::Run(request)) => answer(method, &stranger, &request, out)?,
            Err(answer) => writeln!(out, "{answer}")?,
        }
        out.flush()?;
    }
}

/// Answers one request.
fn answer(
    method: &dyn AnyMethod,
    stranger: &dyn Stranger,
    request: &Request,
    out: &mut dyn Write,
) -> io::Result<()> {
    let reply = match stranger.answer(request) {
        Ok(reply) => reply,
        Err(Fault::Unsupported) => return writeln!(out, "unsupported"),
        Err(Fault::Refused(why) | Fault::Broken(why)) => return writeln!(out, "error {why}"),
        Err(fault) => return writeln!(out, "error {fault}"),
    };
    if !reply.states.iter().all(|z| z.theta.is_finite() && z.omega.is_finite()) {
        return match method.info().implicit {
            true => writeln!(out, "error the step did not converge"),
            false => writeln!(out, "error the states leave the range of numbers"),
        };
    }
    for z in &reply.states {
        writeln!(out, "{:?} {:?}", z.theta, z.omega)?;
    }
    match reply.evaluations {
        Some(evaluations) => writeln!(out, "done {evaluations}"),
        None => writeln!(out, "done"),
    }
}

/// The method as a stranger: with a drive if it suits the driven pendulum.
fn stranger(method: &dyn AnyMethod) -> Chosen<'_> {
    Chosen { pendulum: method, driven: Driven::method_named(method.info().name) }
}

#[cfg(test)]
mod tests {
    use pendula::{METHODS, method_named};

    use super::*;

    /// What the method of this name answers to these lines.
    fn answers(name: &str, lines: &str) -> Vec<String> {
        let mut out = Vec::new();
        serve(method_named(name).unwrap(), lines.as_bytes(), &mut out).unwrap();
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
}
