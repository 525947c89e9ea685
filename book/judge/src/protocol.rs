//! The lines that `pendula` and a program exchange, version 1. A [`Request`] writes its own line.

use pendula::Phase;

use crate::{Drive, Request};

/// The first line of `pendula`.
pub const HELLO: &str = "hello 1";
/// Its last line.
pub const BYE: &str = "bye";

/// A line of `pendula`.
#[derive(Clone, Debug, PartialEq)]
pub enum Question {
    /// Which version is spoken, and by whom?
    Hello,
    /// Which states come after these steps?
    Run(Request),
    /// Nothing more.
    Bye,
}

/// Reads a line of `pendula`. An error is the answer to one that cannot be read.
pub fn question(line: &str) -> Result<Question, String> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let question = match words.split_first() {
        Some((&"hello", ["1"])) => Ok(Question::Hello),
        Some((&"hello", _)) => Err("only version 1 is spoken here".to_string()),
        Some((&"bye", [])) => Ok(Question::Bye),
        Some((&"pendulum", words)) => request(words, false),
        Some((&"driven", words)) => request(words, true),
        // Nobody knows its first word.
        _ => return Err("unsupported".to_string()),
    };
    question.map_err(|why| format!("error {why}"))
}

/// Reads the numbers of a request.
fn request(words: &[&str], driven: bool) -> Result<Question, String> {
    let (words, drive) = match words {
        &[g_over_l, amplitude, frequency, ref rest @ ..] if driven => {
            let amplitude = number("the amplitude", amplitude)?;
            let frequency = number("the frequency", frequency)?;
            ([&[g_over_l], rest].concat(), Some(Drive { amplitude, frequency }))
        }
        words => (words.to_vec(), None),
    };
    let &[g_over_l, theta, omega, step, steps, every] = &words[..] else {
        let wanted = if driven { "g/L A Ω θ ω h n k" } else { "g/L θ ω h n k" };
        return Err(format!("the numbers are {wanted}"));
    };
    let start = Phase { theta: number("θ", theta)?, omega: number("ω", omega)? };
    let [steps, every] = [count("n", steps)?, count("k", every)?];
    if steps % every != 0 {
        return Err(format!("k = {every} does not divide n = {steps}"));
    }
    let [g_over_l, step] = [number("g/L", g_over_l)?, number("h", step)?];
    if step == 0.0 {
        return Err("h is zero".to_string());
    }
    let request = Request::new(g_over_l, start, step, steps).every(every);
    Ok(Question::Run(drive.map_or(request, |drive| request.driven(drive))))
}

/// A line of an answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer {
    /// The next state.
    State(Phase),
    /// The end, with the force evaluations if somebody counts.
    Done(Option<u64>),
    /// There will be no answer, for this reason.
    Error(String),
    /// The kind of request is not known.
    Unsupported,
}

/// Reads a line of an answer.
pub fn answer(line: &str) -> Result<Answer, String> {
    let words: Vec<&str> = line.split_whitespace().collect();
    match words[..] {
        ["unsupported"] => Ok(Answer::Unsupported),
        ["error"] => Ok(Answer::Error("no reason is given".to_string())),
        ["error", ..] => Ok(Answer::Error(words[1..].join(" "))),
        ["done"] => Ok(Answer::Done(None)),
        ["done", evaluations] => match whole(evaluations) {
            Some(evaluations) => Ok(Answer::Done(Some(evaluations))),
            None => Err("after done stands a whole number of evaluations, or nothing".to_string()),
        },
        [theta, omega] => {
            let omega = |theta| Ok(Phase { theta, omega: number("ω", omega)? });
            number("θ", theta).and_then(omega).map(Answer::State)
        }
        _ => Err("neither two numbers, θ and ω, nor done, error or unsupported".to_string()),
    }
}

/// Reads the answer to [`HELLO`]: the name that the program gives itself, which may be empty.
pub fn greeting(line: &str) -> Result<String, String> {
    let mut words = line.split_whitespace();
    match (words.next(), words.next()) {
        (Some("hello"), Some("1")) => Ok(words.collect::<Vec<_>>().join(" ")),
        (Some("hello"), Some(version)) if whole(version).is_some() => {
            Err("it speaks another version than 1".to_string())
        }
        _ => Err("not hello 1 and a name".to_string()),
    }
}

/// A finite number.
fn number(name: &str, word: &str) -> Result<f64, String> {
    match word.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        // "inf" and 1e999 are numbers to Rust.
        Ok(_) => Err(format!("{name} is not finite")),
        Err(_) => Err(format!("{name} is no number")),
    }
}

/// A whole number of 1 or more.
fn count(name: &str, word: &str) -> Result<u64, String> {
    let count = whole(word).filter(|count| *count > 0);
    count.ok_or_else(|| format!("{name} is no whole number of 1 or more"))
}

/// Digits and nothing else: no sign, which Rust would read.
fn whole(word: &str) -> Option<u64> {
    word.bytes().all(|byte| byte.is_ascii_digit()).then(|| word.parse().ok()).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(step: f64, drive: Option<Drive>) -> Request {
        let start = Phase { theta: -1.0 / 3.0, omega: 5e-324 };
        let request = Request::new(9.81, start, step, 1000).every(100);
        drive.map_or(request, |drive| request.driven(drive))
    }

    /// Catches: fields in another order, bits lost on the way, a negative step refused.
    #[test]
    fn a_request_is_read_as_it_was_written() {
        let drive = Drive { amplitude: -0.1, frequency: 1e22 };
        for request in [run(0.01, None), run(-1e-7, None), run(0.01, Some(drive))] {
            assert_eq!(question(&request.to_string()), Ok(Question::Run(request)));
        }
    }

    /// Catches: a request that is half understood, a division by zero, an unknown word taken for a
    /// mistake in a known one.
    #[test]
    fn what_is_wrong_with_a_request_is_said() {
        for (line, wrong) in [
            ("hello 2", "only version 1 is spoken here"),
            ("pendulum 9.81 1 0 0.01 10", "the numbers are g/L θ ω h n k"),
            ("driven 9.81 1 0 0.01 10 1", "the numbers are g/L A Ω θ ω h n k"),
            ("pendulum 9.81 1 0 0.01 10 0", "k is no whole number of 1 or more"),
            ("pendulum 9.81 1 0 0.01 -10 1", "n is no whole number of 1 or more"),
            ("pendulum 9.81 1 0 0.01 10 3", "k = 3 does not divide n = 10"),
            ("pendulum 9.81 nan 0 0.01 10 1", "θ is not finite"),
            ("pendulum 9.81 1 o 0.01 10 1", "ω is no number"),
            ("pendulum 9.81 1 0 -0.0 10 1", "h is zero"),
        ] {
            assert_eq!(question(line), Err(format!("error {wrong}")), "{line}");
        }
        for line in ["", "double 1 2", "bye now", "PENDULUM", "\u{0}"] {
            assert_eq!(question(line), Err("unsupported".to_string()), "{line}");
        }
    }

    /// Catches: NaN taken for a state, a count of evaluations that is rounded or negative, words
    /// behind a state ignored.
    #[test]
    fn an_answer_is_read_strictly() {
        let state = Phase { theta: -1e-7, omega: 2.0 };
        assert_eq!(answer(" -1e-07\t2. \r"), Ok(Answer::State(state)));
        assert_eq!(answer("done"), Ok(Answer::Done(None)));
        assert_eq!(answer("done 1001"), Ok(Answer::Done(Some(1001))));
        assert_eq!(answer("error too  long"), Ok(Answer::Error("too long".to_string())));
        assert_eq!(answer("error"), Ok(Answer::Error("no reason is given".to_string())));
        assert_eq!(answer("unsupported"), Ok(Answer::Unsupported));
        for (line, because) in [
            ("1.0", "neither"),
            ("1.0 2.0 3.0", "neither"),
            ("", "neither"),
            ("1,0 2,0", "θ is no number"),
            ("1.0 np.float64(2.0)", "ω is no number"),
            ("1.0 -nan", "ω is not finite"),
            ("1e999 0", "θ is not finite"),
            ("done 1e3", "whole number"),
            ("done -1", "whole number"),
            ("done +1", "whole number"),
            ("done 99999999999999999999", "whole number"),
        ] {
            let wrong = answer(line).expect_err(line);
            assert!(wrong.contains(because), "{line}: {wrong}");
        }
    }

    /// Catches: another version accepted, a name refused for its blanks or for being none.
    #[test]
    fn only_version_1_is_greeted() {
        assert_eq!(greeting("hello 1 my verlet\r"), Ok("my verlet".to_string()));
        assert_eq!(greeting("hello 1"), Ok(String::new()));
        assert!(greeting("hello 2 my verlet").is_err_and(|why| why.contains("another version")));
        for line in ["hello", "hello one", "Hello 1", "1", "", "unsupported"] {
            assert!(greeting(line).is_err_and(|why| why.contains("not hello 1")), "{line}");
        }
    }
}
