//! The lines that `pendula` and a program exchange, version 1. A [`Request`] writes its own line,
//! and so do a [`SolveRequest`] and a [`CrossingsRequest`].

use pendula::Phase;

use crate::{CrossingsRequest, Drive, Request, SolveRequest};

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
    /// Which states come at these times, within this tolerance?
    Solve(SolveRequest),
    /// Where does θ pass zero?
    Crossings(CrossingsRequest),
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
        Some((&"solve", words)) => solve(words, false),
        Some((&"driven-solve", words)) => solve(words, true),
        Some((&"crossings", words)) => crossings(words),
        // Nobody knows its first word.
        _ => return Err("unsupported".to_string()),
    };
    question.map_err(|why| format!("error {why}"))
}

/// Reads the numbers of a request for steps.
fn request(words: &[&str], is_driven: bool) -> Result<Question, String> {
    let (words, drive) = without_drive(words, is_driven)?;
    let &[g_over_l, theta, omega, step, steps, every] = &words[..] else {
        return Err(wanted(is_driven, "θ ω h n k"));
    };
    let start = phase(theta, omega)?;
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

/// Reads the numbers of a request for states at times. Tolerance and times may be any f64: a solver
/// is asked for the impossible too, and has to refuse it by itself.
fn solve(words: &[&str], is_driven: bool) -> Result<Question, String> {
    let (words, drive) = without_drive(words, is_driven)?;
    let &[g_over_l, theta, omega, from, tolerance, ref times @ ..] = &words[..] else {
        return Err(wanted(is_driven, "θ ω t₀ tolerance, and one time or more"));
    };
    let (g_over_l, start) = (number("g/L", g_over_l)?, phase(theta, omega)?);
    let (from, tolerance) = (number("t₀", from)?, any_number("the tolerance", tolerance)?);
    let times = times.iter().map(|time| any_number("a time", time));
    let times = times.collect::<Result<Vec<f64>, String>>()?;
    if times.is_empty() {
        return Err("no time is asked for".to_string());
    }
    let before = [&[from], &times[..]].concat();
    let is_any = |earlier: fn(f64, f64) -> bool| before.windows(2).any(|t| earlier(t[0], t[1]));
    if is_any(|one, next| one < next) && is_any(|one, next| one > next) {
        return Err("the times are not in the order of a run from t₀".to_string());
    }
    let request = SolveRequest::new(g_over_l, start, tolerance).from(from).to(&times);
    Ok(Question::Solve(match drive {
        Some(drive) => request.driven(drive),
        None => request,
    }))
}

/// Reads the numbers of a request for crossings. Tolerance and end may be any f64, as above.
fn crossings(words: &[&str]) -> Result<Question, String> {
    let &[g_over_l, theta, omega, from, until, tolerance] = words else {
        return Err(wanted(false, "θ ω t₀ t₁ tolerance"));
    };
    let (g_over_l, start) = (number("g/L", g_over_l)?, phase(theta, omega)?);
    let span = [number("t₀", from)?, any_number("t₁", until)?];
    let tolerance = any_number("the tolerance", tolerance)?;
    Ok(Question::Crossings(CrossingsRequest::new(g_over_l, start, span, tolerance)))
}

/// The words without the numbers of the drive, which stand behind g/L, and the drive.
fn without_drive<'a>(
    words: &[&'a str],
    is_driven: bool,
) -> Result<(Vec<&'a str>, Option<Drive>), String> {
    match words {
        &[g_over_l, amplitude, frequency, ref rest @ ..] if is_driven => {
            let amplitude = number("the amplitude", amplitude)?;
            let frequency = number("the frequency", frequency)?;
            Ok(([&[g_over_l], rest].concat(), Some(Drive { amplitude, frequency })))
        }
        words => Ok((words.to_vec(), None)),
    }
}

/// What is said of a request with other numbers than g/L, those of the drive, and these.
fn wanted(is_driven: bool, others: &str) -> String {
    let drive = if is_driven { "A Ω " } else { "" };
    format!("the numbers are g/L {drive}{others}")
}

fn phase(theta: &str, omega: &str) -> Result<Phase, String> {
    Ok(Phase { theta: number("θ", theta)?, omega: number("ω", omega)? })
}

/// A row of an answer.
pub trait Row: Sized {
    /// The numbers of a row, as a message names them.
    const NUMBERS: &'static str;

    /// Reads a row of as many words; `None` if they are more or fewer.
    ///
    /// # Errors
    /// One of the words is no finite number.
    fn read(words: &[&str]) -> Result<Option<Self>, String>;
}

/// A state.
impl Row for Phase {
    const NUMBERS: &'static str = "two numbers, θ and ω";

    fn read(words: &[&str]) -> Result<Option<Self>, String> {
        let &[theta, omega] = words else { return Ok(None) };
        phase(theta, omega).map(Some)
    }
}

/// The time and the state at which θ passes zero.
impl Row for (f64, Phase) {
    const NUMBERS: &'static str = "three numbers, t, θ and ω";

    fn read(words: &[&str]) -> Result<Option<Self>, String> {
        let &[t, theta, omega] = words else { return Ok(None) };
        Ok(Some((number("t", t)?, phase(theta, omega)?)))
    }
}

/// A line of an answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Answer<R> {
    /// The next row.
    Row(R),
    /// The end, with the force evaluations if somebody counts.
    Done(Option<u64>),
    /// There will be no answer, for this reason.
    Error(String),
    /// The kind of request is not known.
    Unsupported,
}

/// Reads a line of an answer.
pub fn answer<R: Row>(line: &str) -> Result<Answer<R>, String> {
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
        _ => match R::read(&words)? {
            Some(row) => Ok(Answer::Row(row)),
            None => Err(format!("neither {}, nor done, error or unsupported", R::NUMBERS)),
        },
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
    let number = any_number(name, word)?;
    if number.is_finite() { Ok(number) } else { Err(format!("{name} is not finite")) }
}

/// Any f64: "inf", "nan" and 1e999 are numbers to Rust. Fortran writes 0.92D+00 for 0.92e+00.
fn any_number(name: &str, word: &str) -> Result<f64, String> {
    let of_fortran = || word.replace(['D', 'd'], "e").parse();
    word.parse().or_else(|_| of_fortran()).map_err(|_| format!("{name} is no number"))
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

    /// Catches: numbers in another order; a tolerance or a time that is impossible, or an equal
    /// one, which the judge asks for on purpose, refused here or changed.
    #[test]
    fn a_request_to_a_solver_is_read_as_it_was_written() {
        let start = Phase { theta: -1.0 / 3.0, omega: 5e-324 };
        let request = SolveRequest::new(9.81, start, 1e-8).from(1e6);
        let drive = Drive { amplitude: -0.1, frequency: 1e22 };
        let impossible = SolveRequest::new(1e-6, start, f64::NAN);
        let crossings =
            |span, tolerance| CrossingsRequest::new(9.81, start, span, tolerance).to_string();
        for line in [
            request.clone().to(&[1e6, 1e6, 1_000_000.5]).to_string(),
            request.clone().to(&[999_999.0, -1e300]).to_string(),
            request.driven(drive).to(&[1e7]).to_string(),
            impossible.clone().to(&[f64::INFINITY]).to_string(),
            impossible.to(&[1.0, f64::NAN, 2.0]).to_string(),
            crossings([0.0, -10.0], 1e-8),
            crossings([1e6, f64::INFINITY], -0.0),
        ] {
            // NaN is not equal to itself, and its word is.
            let read = match question(&line) {
                Ok(Question::Solve(request)) => request.to_string(),
                Ok(Question::Crossings(request)) => request.to_string(),
                other => panic!("{line}: {other:?}"),
            };
            assert_eq!(read, line);
        }
        let asked = SolveRequest::new(9.81, Phase::at_rest(2.0), 1e-8).to(&[2.5, 5.0]);
        assert_eq!(question("solve 9.81 2.0 0.0 0.0 1e-8 2.5 5.0"), Ok(Question::Solve(asked)));
        let asked = CrossingsRequest::new(9.81, Phase::at_rest(2.0), [0.0, 10.0], 1e-8);
        let line = "crossings 9.81 2.0 0.0 0.0 10.0 1e-8";
        assert_eq!(question(line), Ok(Question::Crossings(asked)));
    }

    /// Catches: a line with so many times that it is cut, or takes seconds.
    #[test]
    fn a_hundred_thousand_times_are_read() {
        let times: Vec<f64> = (0..100_000).map(|k| f64::from(k) / 3.0).collect();
        let request = SolveRequest::new(9.81, Phase::at_rest(2.0), 1e-8).to(&times);
        assert_eq!(question(&request.to_string()), Ok(Question::Solve(request)));
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
            ("solve 9.81 1 0 0", "the numbers are g/L θ ω t₀ tolerance, and one time or more"),
            ("solve 9.81 1 0 0 1e-8", "no time is asked for"),
            ("driven-solve 9.81 0.5 2 1 0 0 1e-8", "no time is asked for"),
            (
                "driven-solve 9.81 1",
                "the numbers are g/L A Ω θ ω t₀ tolerance, and one time or more",
            ),
            ("solve 9.81 1 0 inf 1e-8 1", "t₀ is not finite"),
            ("solve 9.81 1 nan 0 1e-8 1", "ω is not finite"),
            ("solve 9.81 1 0 0 small 1", "the tolerance is no number"),
            ("solve 9.81 1 0 0 1e-8 1 2,5", "a time is no number"),
            ("solve 9.81 1 0 0 1e-8 2 1", "the times are not in the order of a run from t₀"),
            ("solve 9.81 1 0 3 1e-8 1 2", "the times are not in the order of a run from t₀"),
            ("solve 9.81 1 0 0 1e-8 -1 1", "the times are not in the order of a run from t₀"),
            ("crossings 9.81 1 0 0 10", "the numbers are g/L θ ω t₀ t₁ tolerance"),
            ("crossings 9.81 1 0 0 10 1e-8 1", "the numbers are g/L θ ω t₀ t₁ tolerance"),
            ("crossings inf 1 0 0 10 1e-8", "g/L is not finite"),
            ("crossings 9.81 1 0 nan 10 1e-8", "t₀ is not finite"),
            ("crossings 9.81 1 0 0 end 1e-8", "t₁ is no number"),
        ] {
            assert_eq!(question(line), Err(format!("error {wrong}")), "{line}");
        }
        for line in ["", "double 1 2", "solve-driven 1", "bye now", "PENDULUM", "\u{0}"] {
            assert_eq!(question(line), Err("unsupported".to_string()), "{line}");
        }
    }

    /// Catches: NaN taken for a state, a count of evaluations that is rounded or negative, words
    /// behind a state ignored.
    #[test]
    fn an_answer_is_read_strictly() {
        let state = Phase { theta: -1e-7, omega: 2.0 };
        assert_eq!(answer(" -1e-07\t2. \r"), Ok(Answer::Row(state)));
        assert_eq!(answer("1e6 -1e-07 2.0"), Ok(Answer::Row((1e6, state))));
        assert_eq!(answer("-0.10000000000000000D-06 2.0d+00"), Ok(Answer::Row(state)));
        let answer = answer::<Phase>;
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

    /// Catches: a state taken for a crossing, a number behind it ignored, NaN for a time.
    #[test]
    fn a_crossing_is_read_strictly() {
        let answer = answer::<(f64, Phase)>;
        assert_eq!(answer("done 1106"), Ok(Answer::Done(Some(1106))));
        for (line, because) in [
            ("1.0 2.0", "neither three numbers, t, θ and ω, nor done"),
            ("1.0 2.0 3.0 4.0", "neither"),
            ("nan 0.0 2.0", "t is not finite"),
            ("1.0 0.0 inf", "ω is not finite"),
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
