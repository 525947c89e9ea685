//! Programs at fault: each is told in one line, in time, and leaves no process behind.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use pendula::verify::{Drive, Fault, Request, Stranger};
use pendula_program::verify::Program;
use tempfile::TempDir;

use super::{PENDULA, pendula, refused, request, started};

/// A shell script as a program. It writes its number, and that of what it starts, to `$1`.
struct Script(TempDir);

impl Script {
    /// Greets as it should, and goes on with `rest`, the first request being in `$line`.
    fn greeting(rest: &str) -> Self {
        Self::new(&format!("read -r line\necho hello 1 a fault\nread -r line\n{rest}"))
    }

    fn new(text: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let script = format!("echo $$ >> \"$1\"\n{text}\n");
        fs::write(folder.path().join("fault.sh"), script).unwrap();
        Self(folder)
    }

    fn path(&self, name: &str) -> String {
        self.0.path().join(name).to_str().unwrap().to_string()
    }

    /// The words that start it.
    fn words(&self) -> [String; 3] {
        ["sh".to_string(), self.path("fault.sh"), self.path("numbers")]
    }

    /// Starts it, to be asked one request after the other.
    fn started(&self, patience: f64) -> Program {
        started(self.words(), patience).unwrap()
    }

    /// What `pendula verify` makes of it.
    fn verified(&self) -> Output {
        let options = ["verify", "--patience", "0.5", "--"].map(str::to_string);
        pendula(options.iter().chain(&self.words()))
    }

    /// The numbers of the processes.
    fn numbers(&self) -> Vec<String> {
        let numbers = fs::read_to_string(PathBuf::from(self.path("numbers"))).unwrap_or_default();
        numbers.lines().map(str::to_string).collect()
    }

    /// Fails if one of the `count` processes is left. Killed, they are gone in an instant; a zombie
    /// waits for the system alone.
    #[track_caller]
    fn leaves_nothing(&self, count: usize) {
        let numbers = self.numbers();
        assert_eq!(numbers.len(), count);
        let deadline = Instant::now() + Duration::from_secs(10);
        for number in numbers {
            while runs(&number) {
                assert!(Instant::now() < deadline, "{number} still runs");
                thread::sleep(Duration::from_millis(5));
            }
        }
    }

    /// Has it judged, and expects one line that contains `because`, long before the default
    /// patience ends.
    #[track_caller]
    fn is_refused(&self, processes: usize, because: &str) {
        let begin = Instant::now();
        let line = refused(&self.verified());
        assert!(begin.elapsed() < Duration::from_secs(8), "{line}");
        assert!(line.contains("fault.sh") && line.contains(because), "{line}");
        assert!(line.chars().count() < 800, "{line}");
        println!("{line}");
        self.leaves_nothing(processes);
    }
}

/// Whether the process runs. A zombie does not.
fn runs(number: &str) -> bool {
    let output = Command::new("ps").args(["-o", "stat=", "-p", number]).output().unwrap();
    let state = String::from_utf8(output.stdout).unwrap();
    !state.trim().is_empty() && !state.trim().starts_with('Z')
}

/// What is wrong with the reply.
#[track_caller]
fn broken(program: &Program, request: &Request) -> String {
    match program.answer(request) {
        Err(Fault::Broken(why)) => {
            println!("{why}");
            why
        }
        other => panic!("{other:?}"),
    }
}

/// Catches: a panic, or a message that does not name the program.
#[test]
fn a_program_that_cannot_be_started() {
    let line = refused(&pendula(["verify", "--", "/no/such/program", "x"]));
    println!("{line}");
    assert!(line.contains("/no/such/program x cannot be started: No such file"), "{line}");
}

/// Catches: a wait for a program that has ended, its last words lost.
#[test]
fn a_program_that_ends_at_once() {
    Script::new("seq 9 >&2\nexit 3").is_refused(
        1,
        "asked \"hello 1\": it ended (exit status: 3), without an answer; its standard error ends \
         \"7 | 8 | 9\"",
    );
    // What it has started holds its output open.
    Script::new("sleep 1000 &\necho $! >> \"$1\"\nexit 4")
        .is_refused(2, "it ended (exit status: 4), but not what it had started, without an answer");
}

/// Catches: a wait without an end; a wait for an end of standard error that does not come.
#[test]
fn a_program_that_is_silent() {
    Script::new("exec sleep 1000")
        .is_refused(1, "asked \"hello 1\": given up after 0.5 s, without");
    Script::greeting("exec sleep 1000").is_refused(1, "given up after 0.5 s, without an answer");
    Script::new("exec 1>&-\nexec sleep 1000")
        .is_refused(1, "it closed its output, without an answer");
}

/// Catches: words taken for numbers, a quotation that hides what was asked or what came.
#[test]
fn a_program_that_answers_garbage() {
    let garbage = Script::greeting("echo \"I am fine, thanks\"\nexec sleep 1000");
    garbage.is_refused(1, "asked \"pendulum ");
    garbage.is_refused(2, "\"I am fine, thanks\" came: neither two numbers, θ and ω, nor done");
    Script::greeting("echo '1.0 2.0 3.0'\ncat").is_refused(1, "\"1.0 2.0 3.0\" came: neither");
    Script::greeting("echo '0x1p-1 0'\ncat").is_refused(1, "θ is no number");
    Script::new("echo ready\ncat").is_refused(1, "\"ready\" came: not hello 1");
}

/// Catches: NaN or infinity that reaches the judge.
#[test]
fn a_program_that_answers_nan() {
    Script::greeting("echo '0.5 nan'\ncat").is_refused(1, "\"0.5 nan\" came: ω is not finite");
    Script::greeting("echo '-inf 0.5'\ncat").is_refused(1, "θ is not finite");
}

/// Catches: a part of an answer taken for the whole, half a number taken for a number.
#[test]
fn a_program_that_dies_over_a_request() {
    Script::greeting("echo 0.5 0.5\nkill -9 $$")
        .is_refused(1, "it ended (signal: 9 (SIGKILL)), with 1");
    Script::greeting("printf '0.5 0.'").is_refused(1, "in the middle of the line \"0.5 0.\"");
}

/// Catches: gigabytes kept, or read to their end; bytes on the user's terminal.
#[test]
fn a_program_that_floods() {
    let zeros = Script::greeting("exec cat /dev/zero");
    zeros.is_refused(1, "\\0…\" came: a line of more than 1000 bytes");
    Script::greeting("exec yes 0.5 0.5").is_refused(1, "\"0.5 0.5\" came: it had sent all ");
    Script::new("exec yes hello 1 x").is_refused(1, "\"hello 1 x\" came: ");
    Script::new("yes too much >&2 &\necho $! >> \"$1\"\nexec sleep 1000")
        .is_refused(2, "its standard error ends \"too much | too much | too much\"");
}

/// Catches: an answer of another length taken for an answer.
#[test]
fn a_program_that_answers_too_little_or_too_much() {
    Script::greeting("echo done 1\ncat").is_refused(1, "\"done 1\" came: it has sent 0 of ");
    let awk = "{ for (i = 0; i <= $(NF - 1) / $NF; i++) print 0.5, 0.5; print \"done\" }";
    Script::greeting(&format!("echo \"$line\" | awk '{awk}'\ncat"))
        .is_refused(1, "states, and does not say done");
}

/// Catches: a version that is not spoken here.
#[test]
fn a_program_of_another_version() {
    Script::new("echo hello 2 x\ncat").is_refused(1, "it speaks another version than 1");
}

/// Catches: an escape sequence that reaches the terminal, a panic over what is no UTF-8.
#[test]
fn a_program_that_answers_bytes() {
    let bytes = Script::greeting("printf '\\377\\001\\033[31m\\r\\n'\ncat");
    bytes.is_refused(1, "\"\u{fffd}\\u{1}\\u{1b}[31m\" came: neither");
}

/// Catches: patience for the first request alone, or for each line instead of each answer; a
/// second question to a program that has been ended; another reason the second time.
#[test]
fn a_program_that_hangs_at_a_later_request() {
    let later = Script::greeting("echo 0.5 0.5\necho done 2\nread -r line\nexec sleep 1000");
    let program = later.started(0.5);
    assert_eq!(program.answer(&request(0.1, 1)).unwrap().evaluations, Some(2));
    let why = broken(&program, &request(0.1, 1));
    assert!(why.contains("given up after 0.5 s, without an answer"), "{why}");
    later.leaves_nothing(1);
    assert_eq!(broken(&program, &request(0.2, 1)), why);

    let trickle = Script::greeting("while :; do echo 0.5 0.5; sleep 0.1; done");
    let why = broken(&trickle.started(0.5), &request(0.1, 1000));
    assert!(why.contains("given up after 0.5 s, with "), "{why}");
    trickle.leaves_nothing(1);
}

/// Catches: a program that greets at its start taken for one at fault, now and then.
#[test]
fn a_program_may_greet_first() {
    let eager = Script::new("echo hello 1 eager\nread -r line\nread -r line\necho 1 2\necho done");
    let program = eager.started(10.0);
    assert_eq!(program.answer(&request(0.1, 1)).unwrap().states.len(), 1);
    drop(program);
    eager.leaves_nothing(1);
}

/// Catches: a refusal that ends the conversation, or is taken for a fault; an answer to one request
/// taken for that to the next.
#[test]
fn a_program_may_refuse_and_go_on() {
    let text = "echo error too long\nread -r line\necho unsupported\nread -r line\necho 1 2\n\
                echo error after all\nread -r line\necho 0.5 0.5\necho done\necho 0.5 0.5\n\
                echo done 3\nread -r line";
    let script = Script::greeting(text);
    let program = script.started(10.0);
    let driven =
        Request { drive: Some(Drive { amplitude: 1.0, frequency: 1.0 }), ..request(0.1, 1) };
    assert_eq!(program.answer(&request(9.0, 1)), Err(Fault::Refused("too long".to_string())));
    assert_eq!(program.answer(&driven), Err(Fault::Unsupported));
    assert_eq!(program.answer(&request(0.1, 20)), Err(Fault::Refused("after all".to_string())));
    assert_eq!(program.answer(&request(0.1, 1)).unwrap().evaluations, None);
    // The second answer to the last request needs a moment to arrive.
    thread::sleep(Duration::from_millis(200));
    let why = broken(&program, &request(0.1, 1));
    assert!(why.contains("\"0.5 0.5\" came: it was there before the question"), "{why}");
    script.leaves_nothing(1);
}

/// Catches: a program that outlives the judge because it ends neither by itself nor when asked to;
/// one that is killed though it would have ended.
#[test]
fn a_program_that_does_not_take_its_leave() {
    let answers = "echo 0.5 0.5\necho done 2\n";
    let stubborn = Script::greeting(&format!(
        "trap '' TERM INT HUP\n{answers}read -r line\nwhile :; do sleep 1; done"
    ));
    let program = stubborn.started(10.0);
    program.answer(&request(0.1, 1)).unwrap();
    drop(program);
    stubborn.leaves_nothing(1);

    let polite = Script::greeting(&format!("{answers}read -r line\necho $line >> \"$1\""));
    let program = polite.started(10.0);
    program.answer(&request(0.1, 1)).unwrap();
    drop(program);
    assert_eq!(polite.numbers().last().unwrap(), "bye");
}

/// Catches: what a program has started left running, whether it is at fault or takes its leave.
#[test]
fn a_program_that_leaves_others_behind() {
    let start = "sh -c 'trap \"\" TERM HUP; sleep 1000' &\necho $! >> \"$1\"\n";
    Script::greeting(&format!("{start}echo garbage\ncat")).is_refused(2, "\"garbage\" came");
    let polite = Script::greeting(&format!("{start}echo 0.5 0.5\necho done 2\nread -r line"));
    let program = polite.started(10.0);
    program.answer(&request(0.1, 1)).unwrap();
    drop(program);
    polite.leaves_nothing(2);
}

/// Catches: a program left running by a panic of the judge.
#[test]
fn a_panic_leaves_nothing_behind() {
    let silent = Script::greeting("exec sleep 1000");
    let panic = catch_unwind(AssertUnwindSafe(|| {
        let _program = silent.started(10.0);
        std::panic::resume_unwind(Box::new("the judge panics"));
    }));
    assert!(panic.is_err());
    silent.leaves_nothing(1);
}

/// Catches: an interrupt that leaves the program running, whose group it does not reach, or a page
/// half written; a status that says something of the claims.
#[test]
fn an_interrupt_leaves_nothing_behind() {
    let silent = Script::new("exec sleep 1000");
    let page = silent.path("report.html");
    let run = Command::new(PENDULA)
        .args(["verify", "--patience", "1000", "--report", &page, "--"])
        .args(silent.words())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // The handler is set before the program is started.
    let deadline = Instant::now() + Duration::from_secs(60);
    while silent.numbers().is_empty() {
        assert!(Instant::now() < deadline, "it does not start");
        thread::sleep(Duration::from_millis(5));
    }
    let kill = Command::new("kill").args(["-INT", &run.id().to_string()]).status().unwrap();
    assert!(kill.success());
    let line = refused(&run.wait_with_output().unwrap());
    assert_eq!(line, "pendula: interrupted\n");
    silent.leaves_nothing(1);
    let left: Vec<_> = fs::read_dir(silent.0.path()).unwrap().collect();
    assert_eq!(left.len(), 2, "{left:?}");
}
