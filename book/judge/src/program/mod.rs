//! The side of the protocol that asks: a program that is not ours, as a [`Stranger`] and as a
//! [`Solver`].

mod process;

use std::ffi::OsString;
use std::io::{self, Read, Write};
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender};
use std::sync::{Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use pendula::Phase;

use self::process::{Group, LONGEST, LastLines, Line};
use crate::printable::printable;
use crate::protocol::{Answer, BYE, HELLO, Row, answer, greeting};
use crate::{Crossings, CrossingsRequest, Fault, Reply, Request, SolveRequest, Solver, Stranger};

/// How many times as long as for an answer a program is waited for in all. Some 400 questions are
/// asked, most of which take a small part of the patience: see [`Program::longest_run`].
const ALL: u32 = 120;

/// How long a program that was told `bye` may take to end.
const GRACE: Duration = Duration::from_millis(500);

/// A program that speaks the protocol over its standard input and output. Dropped, it is told
/// `bye`, and ended a moment later with all that it has started, if it has not ended by itself.
///
/// Whatever it writes, little of it is kept: a line longer than 1000 bytes is a fault, and so is
/// one more than the answer has, or than 10 000 crossings; beyond a thousand lines that nobody has
/// read, it waits.
#[derive(Debug)]
pub struct Program {
    command: String,
    name: String,
    patience: Duration,
    /// When all answers have to be there.
    end: Instant,
    /// An error once the program was at fault, and has been ended.
    talk: Mutex<Result<Conversation, String>>,
}

impl Program {
    /// Starts `command`, its name and its arguments, and greets it. It has `patience` for each
    /// answer, and 120 times as long for all.
    ///
    /// # Errors
    /// One line that says why it cannot be started, or how it answered.
    pub fn start(command: &[OsString], patience: Duration) -> Result<Self, String> {
        static NEVER: AtomicBool = AtomicBool::new(false);
        Self::start_until(command, patience, &NEVER)
    }

    /// As [`start`](Self::start); once `interrupted` is set, the program is waited for no longer.
    ///
    /// # Errors
    /// As there.
    pub fn start_until(
        command: &[OsString],
        patience: Duration,
        interrupted: &'static AtomicBool,
    ) -> Result<Self, String> {
        let words: Vec<_> = command.iter().map(|word| word.to_string_lossy()).collect();
        let shown = shortened(&words.join(" "), EXPLAINED);
        let conversation = Conversation::start(command, interrupted)
            .map_err(|error| format!("{shown} cannot be started: {error}"))?;
        Self::greeted(shown, conversation, patience)
    }

    /// As [`start_until`](Self::start_until), of a program that runs already, and has started this
    /// one perhaps: what it says comes from `answers`, and what it is asked goes to `questions`. It
    /// is not ended. When this is dropped, `bye` has been written, unless nobody reads for half a
    /// second.
    ///
    /// # Errors
    /// One line that says how it answered.
    pub fn at_streams(
        answers: impl Read + Send + 'static,
        questions: impl Write + Send + 'static,
        patience: Duration,
        interrupted: &'static AtomicBool,
    ) -> Result<Self, String> {
        let conversation = Conversation::of(answers, questions, None, interrupted);
        Self::greeted("standard input".to_string(), conversation, patience)
    }

    fn greeted(command: String, talk: Conversation, patience: Duration) -> Result<Self, String> {
        let talk = Mutex::new(Ok(talk));
        Self { command, name: String::new(), patience, end: Instant::now(), talk }.again()
    }

    /// Greets it, again if it was before, and gives it all the time once more.
    ///
    /// # Errors
    /// One line that says how it answered.
    pub fn again(mut self) -> Result<Self, String> {
        self.end = Instant::now() + ALL * self.patience;
        self.name = self.ask(HELLO, |talk| {
            let line = talk.line(|| "without an answer".to_string())?;
            greeting(&line).map_err(|why| Trouble::came(&line, &why))
        })?;
        Ok(self)
    }

    /// The name that the program gives itself, which may be empty.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Whether it knows `pendulum`, and so can be judged by its equal steps.
    ///
    /// # Errors
    /// [`Fault::Broken`] if it breaks the protocol.
    pub fn knows_pendulum(&self) -> Result<bool, Fault> {
        known(self.answer(&steps(200)))
    }

    /// Whether it knows `solve`, and so can be judged as a solver.
    ///
    /// # Errors
    /// [`Fault::Broken`] if it breaks the protocol.
    pub fn knows_solve(&self) -> Result<bool, Fault> {
        known(self.solve(&SolveRequest::new(9.81, START, 1e-3).to(&[1.0])))
    }

    /// Sends `question` and lets `read` read the answer.
    fn ask<T>(
        &self,
        question: &str,
        read: impl FnOnce(&Conversation) -> Result<T, Trouble>,
    ) -> Result<T, String> {
        let mut talk = self.talk.lock().unwrap_or_else(PoisonError::into_inner);
        let conversation = match &mut *talk {
            Ok(conversation) => conversation,
            Err(why) => return Err(why.clone()),
        };
        conversation.deadline = self.end.min(Instant::now() + self.patience);
        // A program may greet before it is greeted.
        let silent = if question == HELLO { Ok(()) } else { conversation.nothing_waits() };
        let answer = silent.and_then(|()| {
            // That a program has ended is seen when it does not answer.
            let _ = conversation.questions.send(format!("{question}\n"));
            read(conversation)
        });
        let why = match answer {
            Ok(answer) => return Ok(answer),
            Err(trouble) => {
                let waited = match Instant::now() < self.end {
                    true => format!("{} s", self.patience.as_secs_f64()),
                    false => format!("{} s of questions", (ALL * self.patience).as_secs_f64()),
                };
                let happened = conversation.inquest(trouble, &waited);
                // A solver is asked for a hundred thousand times in one line.
                let asked = shortened(question, EXPLAINED);
                format!("{}: asked \"{asked}\": {happened}", self.command)
            }
        };
        *talk = Err(why.clone());
        Err(why)
    }

    /// The rows of the answer to `question`, and the evaluations if the program counts. Each row is
    /// passed to `check` with the one before it.
    fn rows<R: Row>(
        &self,
        question: &str,
        asked: Asked,
        check: impl Fn(&R, &R) -> Result<(), String>,
    ) -> Result<(Vec<R>, Option<u64>), Fault> {
        let answer = self.ask(question, |talk| {
            let mut rows: Vec<R> = Vec::new();
            loop {
                let came = rows.len() as u64;
                let line = talk.line(|| match came {
                    0 => "without an answer".to_string(),
                    _ => format!("with {}", asked.so_far(came)),
                })?;
                let wrong = |why: String| Err(Trouble::came(&line, &why));
                match answer(&line) {
                    Ok(Answer::Row(_)) if came == asked.most() => {
                        let all = asked.all();
                        return wrong(format!("it had sent {all}, and does not say done"));
                    }
                    Ok(Answer::Row(row)) => {
                        let checked = rows.last().map_or(Ok(()), |last| check(last, &row));
                        if let Err(why) = checked {
                            return wrong(format!("{why} (line {} of the answer)", came + 1));
                        }
                        rows.push(row);
                    }
                    Ok(Answer::Done(_)) if came < asked.least() => {
                        return wrong(format!("it has sent {}", asked.so_far(came)));
                    }
                    Ok(Answer::Done(evaluations)) => return Ok(Ok((rows, evaluations))),
                    Ok(Answer::Error(why)) => {
                        return Ok(Err(Fault::Refused(shortened(&why, EXPLAINED))));
                    }
                    Ok(Answer::Unsupported) if came == 0 => return Ok(Err(Fault::Unsupported)),
                    Ok(Answer::Unsupported) => {
                        return wrong(format!("it has sent {}", asked.so_far(came)));
                    }
                    Err(why) => return wrong(format!("{why} (line {} of the answer)", came + 1)),
                }
            }
        });
        answer.map_err(Fault::Broken)?
    }

    /// The reply to a question for so many states.
    fn states(&self, question: &str, states: u64) -> Result<Reply, Fault> {
        let (states, evaluations) = self.rows(question, Asked::States(states), |_, _| Ok(()))?;
        Ok(Reply { states, evaluations })
    }
}

/// Where runs begin that are asked for before anything is measured.
const START: Phase = Phase::at_rest(1.0);

/// So many steps, of which the last state is asked for.
fn steps(count: u64) -> Request {
    Request::new(9.81, START, 0.01, count).every(count)
}

/// Whether the word of a question is known that was answered so.
fn known(reply: Result<Reply, Fault>) -> Result<bool, Fault> {
    match reply {
        Err(Fault::Unsupported) => Ok(false),
        Err(fault @ Fault::Broken(_)) => Err(fault),
        _ => Ok(true),
    }
}

/// The rows that a question asks for.
#[derive(Clone, Copy, Debug)]
enum Asked {
    /// So many states.
    States(u64),
    /// As many crossings as there are.
    Crossings,
}

impl Asked {
    /// The most crossings of an answer: of a longer run nobody asks for them.
    const CROSSINGS: u64 = 10_000;

    const fn least(self) -> u64 {
        match self {
            Self::States(states) => states,
            Self::Crossings => 0,
        }
    }

    const fn most(self) -> u64 {
        match self {
            Self::States(states) => states,
            Self::Crossings => Self::CROSSINGS,
        }
    }

    /// So many of them, in words.
    fn so_far(self, came: u64) -> String {
        match self {
            Self::States(states) => format!("{came} of {states} states"),
            Self::Crossings if came == 1 => "1 crossing".to_string(),
            Self::Crossings => format!("{came} crossings"),
        }
    }

    /// As many as may be, in words.
    fn all(self) -> String {
        match self {
            Self::States(states) => format!("all {states} states"),
            Self::Crossings => format!("{} crossings", Self::CROSSINGS),
        }
    }
}

impl Stranger for Program {
    /// As many steps as take a quarter of the patience, by requests that become longer until one
    /// takes a twentieth of it. The first may have to compile.
    fn longest_run(&self) -> u64 {
        let timed = |count: u64| {
            let begun = Instant::now();
            // Whatever is wrong with the answer shows when the judge asks.
            let answered = self.answer(&steps(count)).is_ok();
            (answered, begun.elapsed().as_secs_f64())
        };
        let patience = self.patience.as_secs_f64();
        let (mut steps, (mut answered, mut took)) = (200, timed(200));
        (answered, took) = if answered { timed(200) } else { (answered, took) };
        while answered && took < 0.05 * patience && steps < 100_000 {
            steps *= 5;
            (answered, took) = timed(steps);
        }
        longest(steps, took, patience)
    }

    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        self.states(&request.to_string(), request.states())
    }
}

impl Solver for Program {
    fn solve(&self, request: &SolveRequest) -> Result<Reply, Fault> {
        self.states(&request.to_string(), request.times.len() as u64)
    }

    /// At most 10 000, in the order of the run; more are a fault, and others.
    fn crossings(&self, request: &CrossingsRequest) -> Result<Crossings, Fault> {
        let [from, until] = request.span;
        let check = |&(last, _): &(f64, Phase), &(t, _): &(f64, Phase)| {
            let is_before = if until < from { t > last } else { t < last };
            match is_before {
                true => Err(format!("it comes before {last:?} s in the order of the run")),
                false => Ok(()),
            }
        };
        let (crossings, _) = self.rows(&request.to_string(), Asked::Crossings, check)?;
        Ok(crossings)
    }

    fn patience(&self) -> Duration {
        self.patience
    }
}

/// As many steps as take a quarter of `patience` (s), where `steps` of them took `took` (s); at
/// least one.
fn longest(steps: u64, took: f64, patience: f64) -> u64 {
    ((steps as f64 * 0.25 * patience / took) as u64).max(1)
}

/// Why an answer cannot be used.
#[derive(Debug)]
enum Trouble {
    /// What came, in words.
    Came(String),
    /// Its output has ended; what had come until then.
    Ended(String),
    /// Nothing more came in time; what had come until then.
    Late(String),
    /// The user has had enough.
    Interrupted,
}

impl Trouble {
    /// This line came.
    fn came(line: &str, why: &str) -> Self {
        Self::Came(format!("\"{}\" came: {why}", shortened(line, QUOTED)))
    }
}

/// The pipes to a program, and the threads at them.
#[derive(Debug)]
struct Conversation {
    /// The process and what it says of errors, unless somebody else has started it.
    process: Option<(Group, LastLines)>,
    /// Its standard input, which is closed when this is dropped.
    questions: Sender<String>,
    /// Ends when all of them are written.
    writer: JoinHandle<()>,
    answers: Receiver<Line>,
    /// When the answer that is read has to be there.
    deadline: Instant,
    /// Set when the user has had enough.
    interrupted: &'static AtomicBool,
}

impl Conversation {
    fn start(command: &[OsString], interrupted: &'static AtomicBool) -> io::Result<Self> {
        let (program, arguments) =
            command.split_first().ok_or_else(|| io::Error::from(io::ErrorKind::InvalidInput))?;
        let mut command = Command::new(program);
        command.args(arguments);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut group = Group::start(&mut command)?;
        let pipe = || io::Error::from(io::ErrorKind::BrokenPipe);
        let child = group.child();
        let input = child.stdin.take().ok_or_else(pipe)?;
        let output = child.stdout.take().ok_or_else(pipe)?;
        let errors = child.stderr.take().ok_or_else(pipe)?;
        Ok(Self::of(output, input, Some((group, LastLines::of(errors))), interrupted))
    }

    fn of(
        answers: impl Read + Send + 'static,
        questions: impl Write + Send + 'static,
        process: Option<(Group, LastLines)>,
        interrupted: &'static AtomicBool,
    ) -> Self {
        let (questions, writer) = process::writer(questions);
        let answers = process::lines(answers);
        Self { process, questions, writer, answers, deadline: Instant::now(), interrupted }
    }

    /// An error if the program has said something that nobody has asked for.
    fn nothing_waits(&self) -> Result<(), Trouble> {
        match self.answers.try_recv() {
            Err(_) => Ok(()),
            Ok(Line::Whole(line)) => {
                Err(Trouble::came(&line, "it was there before the question, unasked for"))
            }
            Ok(line) => self.whole(line).map(drop),
        }
    }

    /// The next line. `so_far` says what has come of the answer.
    fn line(&self, so_far: impl Fn() -> String) -> Result<String, Trouble> {
        const LISTEN: Duration = Duration::from_millis(20);
        loop {
            if self.interrupted.load(Ordering::Relaxed) {
                return Err(Trouble::Interrupted);
            }
            let left = self.deadline.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return Err(Trouble::Late(so_far()));
            }
            match self.answers.recv_timeout(left.min(LISTEN)) {
                Ok(line) => return self.whole(line),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(Trouble::Ended(so_far()));
                }
            }
        }
    }

    /// The line, if it is a whole one.
    fn whole(&self, line: Line) -> Result<String, Trouble> {
        match line {
            Line::Whole(line) => Ok(line),
            Line::TooLong(begin) => {
                let why = format!("a line of more than {LONGEST} bytes");
                Err(Trouble::came(&begin, &why))
            }
            Line::Unended(line) => Err(Trouble::Ended(format!(
                "in the middle of the line \"{}\"",
                shortened(&line, QUOTED)
            ))),
        }
    }

    /// Ends the program, and says what happened and what it wrote on standard error.
    fn inquest(&mut self, trouble: Trouble, waited: &str) -> String {
        if self.process.is_some() && matches!(trouble, Trouble::Ended(_)) {
            self.wait_for_end(GRACE);
        }
        let Some((group, errors)) = &mut self.process else {
            return match trouble {
                Trouble::Came(what) => what,
                Trouble::Ended(so_far) => format!("it was closed, {so_far}"),
                Trouble::Late(so_far) => late(waited, &so_far),
                Trouble::Interrupted => INTERRUPTED.to_string(),
            };
        };
        let by_itself = group.has_ended();
        let status = group.end();
        let mut happened = match (trouble, status) {
            (Trouble::Came(what), _) => what,
            (Trouble::Ended(so_far), Ok(status)) if by_itself => {
                format!("it ended ({status}), {so_far}")
            }
            (Trouble::Ended(so_far), _) => format!("it closed its output, {so_far}"),
            (Trouble::Late(so_far), Ok(status)) if by_itself => {
                format!("it ended ({status}), but not what it had started, {so_far}")
            }
            (Trouble::Late(so_far), _) => late(waited, &so_far),
            (Trouble::Interrupted, _) => INTERRUPTED.to_string(),
        };
        let lines: Vec<String> =
            errors.at_the_end().iter().map(|x| shortened(x, EXPLAINED)).collect();
        if !lines.is_empty() {
            happened += &format!("; its standard error ends \"{}\"", lines.join(" | "));
        }
        happened
    }

    /// Waits until the program has ended, for at most so long; or, if that is not ours to wait for,
    /// until all questions are written.
    fn wait_for_end(&mut self, at_most: Duration) {
        const LISTEN: Duration = Duration::from_millis(5);
        let deadline = Instant::now() + at_most;
        let mut has_ended = || match &mut self.process {
            Some((group, _)) => group.has_ended(),
            None => self.writer.is_finished(),
        };
        while !has_ended() && Instant::now() < deadline {
            thread::sleep(LISTEN);
        }
    }
}

/// What is said of a program that was waited for so long.
fn late(waited: &str, so_far: &str) -> String {
    format!("given up after {waited}, {so_far} (are its answers flushed?)")
}

const INTERRUPTED: &str = "interrupted";

impl Drop for Conversation {
    fn drop(&mut self) {
        let _ = self.questions.send(format!("{BYE}\n"));
        // Dropped, the sender closes the program's input behind it.
        self.questions = std::sync::mpsc::channel().0;
        self.wait_for_end(GRACE);
        // The group ends what is left when it is dropped.
    }
}

/// The most characters of a line that are quoted: a state takes fifty.
const QUOTED: usize = 60;
/// The most of one that says what is wrong, or of a question.
const EXPLAINED: usize = 160;

/// At most so many characters of the text, with those that cannot be printed escaped.
fn shortened(text: &str, most: usize) -> String {
    let mut short = String::new();
    let mut length = 0;
    for c in text.chars() {
        let shown = printable(c.encode_utf8(&mut [0; 4]));
        length += shown.chars().count();
        if length > most {
            return short + "…";
        }
        short += &shown;
    }
    short
}

#[cfg(test)]
mod tests {
    use super::*;

    /// All numbers are such that each product and quotient is exact.
    ///
    /// Catches: a patience that is ignored, so that a longer one lengthens no run and a shorter one
    /// makes a program late; a time for one step taken for that of all; a run of no step.
    #[test]
    fn a_run_takes_a_quarter_of_the_patience() {
        assert_eq!(longest(200, 1.0, 10.0), 500);
        assert_eq!([2.0, 20.0].map(|patience| longest(200, 0.5, patience)), [200, 2000]);
        assert_eq!(longest(100_000, 0.25, 10.0), 1_000_000);
        assert_eq!(longest(200, 1024.0, 2.0), 1);
    }

    /// Catches: a program that answers each question just in time, and so keeps its judge for an
    /// hour.
    #[cfg(unix)]
    #[test]
    fn there_is_an_end_to_all_answers() {
        let words = ["sh", "-c", "read x; echo hello 1; while read x; do echo done 0; done"];
        let patience = Duration::from_secs(1000);
        let mut program = Program::start(&words.map(OsString::from), patience).unwrap();
        assert!(program.end > Instant::now() + 100 * patience);
        program.end = Instant::now();
        let late = program.ask("pendulum", |talk| talk.line(String::new)).unwrap_err();
        assert!(late.contains("given up after 120000 s of questions"), "{late}");
    }

    /// Catches: an escape sequence that reaches the terminal, a fault of megabytes, a blank lost.
    #[test]
    fn what_came_is_quoted_in_a_short_line() {
        assert_eq!(shortened("θ is \"1\"", 60), "θ is \"1\"");
        assert_eq!(shortened("a\u{1b}[31m b\u{202e}", 60), "a\\u{1b}[31m b\\u{202e}");
        assert_eq!(shortened(&"x".repeat(60), 60), "x".repeat(60));
        assert_eq!(shortened(&"x".repeat(1_000_000), 60), "x".repeat(60) + "…");
        assert_eq!(shortened(&"\u{1}".repeat(1000), 60), "\\u{1}".repeat(12) + "…");
    }
}
