//! `verify --stdio`: whoever has started the judge is asked on its output and answers on its input.

use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use rstest::rstest;
use serde_json::Value;

use super::{PATIENT, assert_valid, judged};
use crate::{PENDULA, assert_refused};

/// A process that is talked to.
struct Other {
    process: Child,
    input: Option<ChildStdin>,
    output: BufReader<ChildStdout>,
}

impl Other {
    fn started(words: &[&str]) -> Self {
        let mut command = Command::new(PENDULA);
        command.args(words).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut process = command.spawn().unwrap();
        let input = process.stdin.take();
        let output = BufReader::new(process.stdout.take().unwrap());
        Self { process, input, output }
    }

    /// The next line, with its end; empty at the end of all.
    fn line(&mut self) -> String {
        let mut line = String::new();
        self.output.read_line(&mut line).unwrap();
        line
    }

    /// Says it, and behind `GONE` nothing any more. Who has given up does not listen.
    fn say(&mut self, text: &str) {
        let (text, is_last) = text.strip_suffix(GONE).map_or((text, false), |text| (text, true));
        if let Some(input) = &mut self.input {
            let _ = input.write_all(text.as_bytes());
        }
        if is_last {
            self.input = None;
        }
    }
}

/// The last word of who closes the pipe.
const GONE: &str = "GONE";

/// How a judge ended that was answered so, without its questions.
struct Told {
    status: i32,
    report: String,
    errors: String,
    greeted: usize,
}

fn told(options: &[&str], mut answer: impl FnMut(&str) -> String) -> Told {
    let mut judge = Other::started(&[&["verify", "--stdio"], options].concat());
    let mut greeted = 0;
    loop {
        let question = judge.line();
        greeted += usize::from(question == "hello 1\n");
        match question.as_str() {
            "bye\n" => break,
            "" => panic!("it goes without a word"),
            question => judge.say(&answer(question)),
        }
    }
    let [mut report, mut errors] = [String::new(), String::new()];
    judge.output.read_to_string(&mut report).unwrap();
    judge.process.stderr.take().unwrap().read_to_string(&mut errors).unwrap();
    Told { status: judge.process.wait().unwrap().code().unwrap(), report, errors, greeted }
}

/// Answers as the method does that `pendula serve` serves.
fn served(method: &str) -> impl FnMut(&str) -> String {
    let mut other = Other::started(&["serve", method]);
    move |question| {
        other.say(question);
        let mut answer = String::new();
        loop {
            let line = other.line();
            answer += &line;
            let word = line.split_whitespace().next().unwrap();
            if ["hello", "done", "error", "unsupported"].contains(&word) {
                return answer;
            }
        }
    }
}

/// Catches: a question that is lost or comes twice; a report before the last question, in another
/// format or with other numbers; a wrong status; a solver that is not asked for its steps, or for
/// its times.
#[rstest]
#[case::steps("stormer-verlet", "order=2 symplectic", 0)]
#[case::wrong("stormer-verlet", "order=3", 1)]
#[case::nothing_claimed("rk4", "", 0)]
#[case::solver("dop853", "order=8 estimate=8", 0)]
fn it_is_judged_as_a_program_is(#[case] method: &str, #[case] claims: &str, #[case] status: i32) {
    let options = ["--claims", claims];
    let told = told(&[&options[..], &PATIENT, &["--format", "json"]].concat(), served(method));
    assert_eq!((told.status, told.errors.as_str()), (status, ""));
    let report: Value = serde_json::from_str(&told.report).unwrap();
    assert_valid(&report);
    assert_eq!(report["program"]["command"], "");
    let (expected_status, expected) = judged(&options, &[PENDULA, "serve", method]);
    assert_eq!(status, expected_status);
    // What was measured in how much time may differ.
    for what in ["/program/name", "/claims", "/summary", "/identity"] {
        assert_eq!(report.pointer(what), expected.pointer(what), "{what}");
    }
    let verdicts = |report: &Value| -> Vec<String> {
        let properties = report["properties"].as_array().unwrap().iter();
        properties.map(|it| format!("{} {} {}", it["name"], it["claimed"], it["verdict"])).collect()
    };
    assert_eq!(verdicts(&report), verdicts(&expected));
}

/// Catches: a wait without an end; a panic, or a second line, about who does not answer, is gone,
/// or says too much; a report on what was not judged.
#[rstest]
#[case::silent("", "given up after 3 s, without an answer")]
#[case::gone("GONE", "it was closed, without an answer")]
#[case::gone_in_a_line("0.5 0.GONE", "it was closed, in the middle of the line \"0.5 0.\"")]
#[case::too_many("0.5 0.5\n0.5 0.5\n", "it had sent all 1 states, and does not say done")]
#[case::a_flood("FLOOD", "it had sent all 1 states, and does not say done")]
#[case::no_answer("yes\n", "\"yes\" came: neither two numbers")]
fn a_fault_is_told_in_one_line(#[case] answer: &str, #[case] because: &str) {
    // However busy the machine is, nobody who answers is given up.
    let patience = if answer.is_empty() { "3" } else { "600" };
    let told = told(&["--patience", patience], |question| match question {
        "hello 1\n" => "hello 1 somebody\n".to_string(),
        _ if answer == "FLOOD" => "0.5 0.5\n".repeat(1_000_000),
        _ => answer.to_string(),
    });
    assert_eq!((told.status, told.report.as_str()), (2, ""), "{}", told.errors);
    assert!(told.errors.starts_with("pendula: standard input: asked \""), "{}", told.errors);
    assert!(told.errors.contains(because), "{}", told.errors);
    assert_eq!((told.errors.lines().count(), told.greeted), (1, 1), "{}", told.errors);
}

/// Catches: a program that is started, or an example printed, though somebody waits for questions.
#[test]
fn it_is_one_or_the_other() {
    assert_refused(&["verify", "--stdio", "--", "x"], "cannot be used with");
    assert_refused(&["verify", "--stdio", "--example", "python"], "cannot be used with");
}
