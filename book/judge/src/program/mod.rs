//! The side of the protocol that asks: a program that is not ours, as an [`Integrator`] and as a
//! [`Solver`].

mod process;

use std::cell::Cell;
use std::collections::{HashMap, HashSet};
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
use crate::{Crossings, CrossingsRequest, Fault, Integrator, Reply, Request, SolveRequest, Solver};

/// How many times as long as for an answer a program is waited for in all. Some 400 questions are
/// asked, most of which take a small part of the patience: see [`Program::longest_run`].
const ALL: u32 = 120;

/// And how many times as long with answers that cannot be used: with so many that are late, each of
/// which costs the patience, and the program is begun anew for the next question. Beyond that
/// nothing more is asked.
const LOST: u32 = 20;

/// As good as for ever.
const YEAR: Duration = Duration::from_secs(365 * 86_400);

/// How long a program that was told `bye` may take to end.
const GRACE: Duration = Duration::from_millis(500);

/// A program that speaks the protocol over its standard input and output. Dropped, it is told
/// `bye`, and ended a moment later with all that it has started, if it has not ended by itself.
///
/// An answer that is late, that breaks the protocol or that ends the program is a [`Fault::Lost`]:
/// the program is ended, and begun anew for the next question. The same question is not asked
/// again. A word of the protocol whose first answer is lost counts as one that the program does not
/// know.
///
/// Whatever it writes, little of it is kept: a line longer than 1000 bytes is a fault, and so is
/// one more than the answer has, or than 10 000 crossings; beyond a thousand lines that nobody has
/// read, it waits.
#[derive(Debug)]
pub struct Program {
    command: String,
    name: String,
    /// The words that start it, unless somebody else has started it.
    words: Option<Vec<OsString>>,
    interrupted: &'static AtomicBool,
    patience: Duration,
    /// Whether whoever has started it ends what is late.
    is_watched: bool,
    /// When all answers have to be there.
    end: Instant,
    talk: Mutex<Talk>,
}

/// What was said so far.
#[derive(Debug)]
struct Talk {
    now: Now,
    /// The words of the protocol of which a question was answered.
    known: HashSet<String>,
    /// The words of which none was, and why.
    unknown: HashMap<String, String>,
    /// The questions whose answers were lost, and why.
    lost: HashMap<String, String>,
    /// How long those took.
    took: Duration,
}

/// Whether a program can be asked.
#[derive(Debug)]
enum Now {
    /// It runs.
    Runs(Conversation),
    /// It was ended, and is begun anew when it is asked again.
    Anew,
    /// It cannot be asked any more.
    Gone(String),
}

impl Program {
    /// Starts `command`, its name and its arguments, and greets it. It has `patience` for each
    /// answer, 20 times as long for those that are lost, and 120 times as long for all.
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
        Self::new(shown, Some(command.to_vec()), Now::Anew, patience, interrupted).greeted()
    }

    /// As [`start_until`](Self::start_until), of a program that runs already, and has started this
    /// one perhaps: what it says comes from `answers`, and what it is asked goes to `questions`. It
    /// is not ended, and not begun anew: after an answer that is lost it is asked nothing more.
    /// When this is dropped, `bye` has been written, unless nobody reads for half a second.
    ///
    /// # Errors
    /// One line that says how it answered.
    pub fn at_streams(
        answers: impl Read + Send + 'static,
        questions: impl Write + Send + 'static,
        patience: Duration,
        interrupted: &'static AtomicBool,
    ) -> Result<Self, String> {
        let runs = Now::Runs(Conversation::of(answers, questions, None, interrupted));
        Self::new("standard input".to_string(), None, runs, patience, interrupted).greeted()
    }

    fn new(
        command: String,
        words: Option<Vec<OsString>>,
        now: Now,
        patience: Duration,
        interrupted: &'static AtomicBool,
    ) -> Self {
        let (known, unknown, lost) = Default::default();
        let talk = Mutex::new(Talk { now, known, unknown, lost, took: Duration::ZERO });
        let (name, end) = (String::new(), Instant::now() + ALL * patience);
        Self { command, name, words, interrupted, patience, is_watched: false, end, talk }
    }

    fn greeted(mut self) -> Result<Self, String> {
        let talk = self.talk.get_mut().unwrap_or_else(PoisonError::into_inner);
        let now = std::mem::replace(&mut talk.now, Now::Anew);
        let (now, name) = match now {
            Now::Runs(mut conversation) => {
                let name = self.greet(&mut conversation)?;
                (conversation, name)
            }
            Now::Anew => self.begin()?,
            Now::Gone(why) => return Err(why),
        };
        self.name = name;
        self.talk.get_mut().unwrap_or_else(PoisonError::into_inner).now = Now::Runs(now);
        Ok(self)
    }

    /// Whoever has started it ends what is late, and answers in its place: it is waited for as long
    /// as that takes.
    #[must_use]
    pub fn watched(self) -> Self {
        Self { is_watched: true, ..self }
    }

    /// Begins anew, or greets it again, and gives it all the time once more.
    ///
    /// # Errors
    /// One line that says how it answered.
    pub fn again(mut self) -> Result<Self, String> {
        self.end = Instant::now() + ALL * self.patience;
        let talk = self.talk.get_mut().unwrap_or_else(PoisonError::into_inner);
        talk.took = Duration::ZERO;
        if self.words.is_some() {
            talk.now = Now::Anew;
        }
        self.greeted()
    }

    /// The words that start it, in a short line.
    pub fn command(&self) -> &str {
        &self.command
    }

    /// The name that the program gives itself, which may be empty.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Whether it knows `pendulum`, and so can be judged by its equal steps.
    ///
    /// # Errors
    /// Why it does not: [`Fault::Unsupported`] if it says so, or else what it did where it was
    /// asked for a run, and for a single step. [`Fault::Broken`] if it cannot be asked at all.
    pub fn knows_pendulum(&self) -> Result<(), Fault> {
        known([200, 1].map(steps), |request| self.answer(request))
    }

    /// Whether it knows `solve`, and so can be judged as a solver.
    ///
    /// # Errors
    /// Why it does not: [`Fault::Unsupported`] if it says so, or else what it did where it was
    /// asked for a state with a loose tolerance, and with a usual one. [`Fault::Broken`] if it
    /// cannot be asked at all.
    pub fn knows_solve(&self) -> Result<(), Fault> {
        let request = |tolerance| SolveRequest::new(9.81, START, tolerance).to(&[1.0]);
        known([1e-3, 1e-6].map(request), |request| self.solve(request))
    }

    /// The program, started and greeted, and its name.
    fn begin(&self) -> Result<(Conversation, String), String> {
        let words = self.words.as_deref().unwrap_or_default();
        let mut conversation = Conversation::start(words, self.interrupted)
            .map_err(|error| format!("{} cannot be started: {error}", self.command))?;
        let name = self.greet(&mut conversation)?;
        Ok((conversation, name))
    }

    /// The name with which it answers the greeting.
    fn greet(&self, conversation: &mut Conversation) -> Result<String, String> {
        let name = self.answered(conversation, HELLO, |talk| {
            let line = talk.line(|| "without an answer".to_string())?;
            greeting(&line).map_err(|why| Trouble::came(&line, &why))
        });
        name.map_err(|trouble| {
            format!("{}: {}", self.command, self.inquest(conversation, HELLO, trouble))
        })
    }

    /// Sends `question` and lets `read` read the answer.
    fn answered<T>(
        &self,
        conversation: &mut Conversation,
        question: &str,
        read: impl FnOnce(&Conversation) -> Result<T, Trouble>,
    ) -> Result<T, Trouble> {
        conversation.deadline = match self.is_watched {
            // Whoever watches ends with it.
            true => Instant::now() + YEAR,
            false => self.end.min(Instant::now() + self.patience),
        };
        conversation.has_come.set(false);
        // A program may greet before it is greeted.
        if question != HELLO {
            conversation.nothing_waits()?;
        }
        // That a program has ended is seen when it does not answer.
        let _ = conversation.questions.send(format!("{question}\n"));
        read(conversation)
    }

    /// Ends the program, and says what was asked and what happened.
    fn inquest(&self, conversation: &mut Conversation, question: &str, trouble: Trouble) -> String {
        let waited = match Instant::now() < self.end {
            true => format!("{} s", self.patience.as_secs_f64()),
            false => format!("{} s of questions", (ALL * self.patience).as_secs_f64()),
        };
        let happened = conversation.inquest(trouble, &waited);
        // A solver is asked for a hundred thousand times in one line.
        let asked = shortened(question, EXPLAINED);
        format!("asked \"{asked}\": {happened}")
    }

    /// Asks `question` and lets `read` read the answer. What can be asked no more, and why, is
    /// kept.
    fn ask<T>(
        &self,
        question: &str,
        read: impl Fn(&Conversation) -> Result<T, Trouble>,
    ) -> Result<T, Fault> {
        let mut talk = self.talk.lock().unwrap_or_else(PoisonError::into_inner);
        let talk = &mut *talk;
        let word = question.split(' ').next().unwrap_or_default();
        if let Some(why) = talk.unknown.get(word) {
            return Err(Fault::Refused(why.clone()));
        }
        if let Some(why) = talk.lost.get(question) {
            return Err(Fault::Lost(why.clone()));
        }
        let begun = Instant::now();
        let (trouble, why) = loop {
            let is_new = matches!(talk.now, Now::Anew);
            if is_new {
                talk.now = match self.begin() {
                    Ok((conversation, _)) => Now::Runs(conversation),
                    Err(why) => Now::Gone(nothing_more(&why)),
                };
            }
            let conversation = match &mut talk.now {
                Now::Runs(conversation) => conversation,
                Now::Gone(why) => return Err(Fault::Lost(why.clone())),
                Now::Anew => return Err(Fault::Broken(INTERRUPTED.to_string())),
            };
            let trouble = match self.answered(conversation, question, &read) {
                Ok(answer) => {
                    talk.known.insert(word.to_string());
                    return Ok(answer);
                }
                Err(trouble) => trouble,
            };
            let is_silent = matches!(trouble, Trouble::Ended(_)) && !conversation.has_come.get();
            let why = self.inquest(conversation, question, trouble.clone());
            // It may have ended at the question before, when it had answered.
            if is_new || !is_silent || self.words.is_none() {
                break (trouble, why);
            }
            talk.now = Now::Anew;
        };
        let has_had_enough = matches!(trouble, Trouble::Interrupted);
        talk.took += begun.elapsed();
        let can_begin = self.words.is_some() && !has_had_enough;
        let has_time = talk.took < LOST * self.patience && Instant::now() < self.end;
        talk.now = if can_begin && has_time { Now::Anew } else { Now::Gone(nothing_more(&why)) };
        if has_had_enough {
            return Err(Fault::Broken(why));
        }
        if !talk.known.contains(word) {
            talk.unknown.insert(word.to_string(), why.clone());
            return Err(Fault::Refused(why));
        }
        talk.lost.insert(question.to_string(), why.clone());
        Err(Fault::Lost(why))
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
        answer?
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

/// What is said of a question that is not asked, because of this.
fn nothing_more(why: &str) -> String {
    format!("nothing more is asked of it: {why}")
}

/// Whether a word is known: whether one of two questions has an answer.
fn known<Q>(questions: [Q; 2], ask: impl Fn(&Q) -> Result<Reply, Fault>) -> Result<(), Fault> {
    let [first, second] = &questions;
    match ask(first) {
        Err(Fault::Refused(why)) => match ask(second) {
            Err(Fault::Refused(_)) => Err(Fault::Refused(why)),
            other => other.map(drop),
        },
        other => other.map(drop),
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

impl Integrator for Program {
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

    /// It is waited for no longer than the patience.
    fn may_hang(&self) -> bool {
        true
    }
}

/// As many steps as take a quarter of `patience` (s), where `steps` of them took `took` (s); at
/// least one.
fn longest(steps: u64, took: f64, patience: f64) -> u64 {
    ((steps as f64 * 0.25 * patience / took) as u64).max(1)
}

/// Why an answer cannot be used.
#[derive(Clone, Debug)]
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
    /// Whether a line of the answer that is read has come.
    has_come: Cell<bool>,
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
        let (has_come, deadline) = (Cell::new(false), Instant::now());
        Self { process, questions, writer, answers, has_come, deadline, interrupted }
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
                Ok(line) => {
                    self.has_come.set(true);
                    return self.whole(line);
                }
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
        for count in [1, 2] {
            let late = program.answer(&steps(count)).unwrap_err().to_string();
            assert!(late.contains("given up after 120000 s of questions"), "{late}");
        }
        assert!(matches!(program.talk.get_mut().unwrap().now, Now::Gone(_)));
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
