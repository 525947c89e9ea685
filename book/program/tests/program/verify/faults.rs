//! Programs at fault: each is told in one line, in time, and leaves no process behind.
//!
//! Tests that wait for a program that hangs are left to `.ci/run`, which runs them side by side.

use std::fmt::Debug;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use pendula::Phase;
use pendula_judge::{
    Claims, CrossingsRequest, Drive, Fault, Integrator, Program, Property, Request, SolveRequest,
    Solver, Verdict, try_judge_solver,
};
use rstest::rstest;
use tempfile::TempDir;

use super::{PENDULA, both, pendula, refused, request, started};

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
        let patience = patience(&fs::read_to_string(self.path("fault.sh")).unwrap()).to_string();
        let options = ["verify", "--patience", &patience, "--"].map(str::to_string);
        pendula(options.iter().chain(&self.words()))
    }

    /// The numbers of the processes.
    fn numbers(&self) -> Vec<String> {
        let numbers = fs::read_to_string(PathBuf::from(self.path("numbers"))).unwrap_or_default();
        numbers.lines().map(str::to_string).collect()
    }

    /// Fails if one of its processes is left. Killed, they are gone in an instant, which is minutes
    /// on no machine; a zombie waits for the system alone.
    #[track_caller]
    fn leaves_nothing(&self) {
        let numbers = self.numbers();
        assert!(!numbers.is_empty());
        let deadline = Instant::now() + MINUTES;
        for number in numbers {
            while runs(&number) {
                assert!(Instant::now() < deadline, "{number} still runs");
                thread::sleep(Duration::from_millis(5));
            }
        }
    }
}

/// Longer than anything takes on a machine that is busy with other work.
const MINUTES: Duration = Duration::from_secs(600);

/// What is at the end of a script that the judge gives up; nothing for the shell.
const GIVEN_UP: &str = "# given up";

/// How long a script is waited for (s). One that is given up has to be quick to greet; of any other
/// it is told by what it does that it is not waited for, however busy the machine is.
fn patience(script: &str) -> f64 {
    if script.trim_end().ends_with(GIVEN_UP) { 3.0 } else { MINUTES.as_secs_f64() }
}

/// What is told of each script, all at once: some are waited for.
fn told_of_each(scripts: &[&str], told_of: impl Fn(&str) -> String + Sync) -> String {
    thread::scope(|scope| {
        let told_of = &told_of;
        let started = scripts.iter().map(|script| scope.spawn(move || told_of(script)));
        let started: Vec<_> = started.collect();
        started.into_iter().map(|told| told.join().unwrap()).collect()
    })
}

/// Whether the process runs. A zombie does not.
fn runs(number: &str) -> bool {
    let output = Command::new("ps").args(["-o", "stat=", "-p", number]).output().unwrap();
    let state = String::from_utf8(output.stdout).unwrap();
    !state.trim().is_empty() && !state.trim().starts_with('Z')
}

/// What is wrong with the reply.
#[track_caller]
fn none(program: &Program, request: &Request) -> String {
    why_none(program.answer(request))
}

#[track_caller]
fn why_none<T: Debug>(reply: Result<T, Fault>) -> String {
    match reply {
        Err(Fault::Lost(why) | Fault::Refused(why)) => why,
        other => panic!("{other:?}"),
    }
}

/// Programs at fault when they are greeted.
const AT_ONCE: [&str; 7] = [
    "seq 9 >&2\nexit 3",
    // What it has started holds its output open.
    "sleep 1000 &\necho $! >> \"$1\"\nexit 4 # given up",
    "exec sleep 1000 # given up",
    "exec 1>&-\nexec sleep 1000",
    "echo ready\ncat",
    "echo hello 2 x\ncat",
    "yes too much >&2 &\necho $! >> \"$1\"\nexec sleep 1000 # given up",
];

/// Programs at fault when they are asked.
const OVER_A_REQUEST: [&str; 14] = [
    "exec sleep 1000 # given up",
    "echo \"I am fine, thanks\"\nexec sleep 1000",
    "echo '1.0 2.0 3.0'\ncat",
    "echo '0x1p-1 0'\ncat",
    "echo '0.5 nan'\ncat",
    "echo '-inf 0.5'\ncat",
    "echo 0.5 0.5\nkill -9 $$",
    "printf '0.5 0.'",
    "exec cat /dev/zero",
    "exec yes 0.5 0.5",
    "echo done 1\ncat",
    "echo \"$line\" | awk '{ while (i++ <= $(NF - 1) / $NF) print 0.5, 0.5; print \"done\" }'\ncat",
    "printf '\\377\\001\\033[31m\\r\\n'\ncat",
    "sh -c 'trap \"\" TERM HUP; sleep 1000' &\necho $! >> \"$1\"\necho garbage\ncat",
];

/// Catches: a panic, or a message that does not name the program; a wait without an end, for a
/// program that has ended or for its standard error; its last words lost, or what it has started
/// left running; a quotation that hides what was asked or what came; words taken for numbers, half
/// a number, a part of an answer or one of another length taken for the whole; NaN or infinity that
/// reaches the judge; gigabytes kept, or read to their end; an escape sequence that reaches the
/// terminal, a panic over what is no UTF-8; a version that is not spoken here.
#[test]
#[ignore = "waits for a program that hangs: .ci/run runs it"]
fn a_fault_is_told_in_one_line() {
    let mut told = refused(&pendula(["verify", "--", "/no/such/program", "x"]));
    let told_of = |script: Script| {
        let line = refused(&script.verified());
        script.leaves_nothing();
        line.replace(script.0.path().to_str().unwrap(), "FOLDER")
    };
    told += &both(
        || told_of_each(&AT_ONCE, |script| told_of(Script::new(script))),
        || told_of_each(&OVER_A_REQUEST, |script| told_of(Script::greeting(script))),
    )
    .concat();
    // Where an endless complaint is cut off depends on how it comes in.
    let cut = |told: String, end| {
        let whole = "too much";
        told.replace(&format!("{whole} | {}\"", &whole[..end]), &format!("{whole} | {whole}\""))
    };
    let told = (1..8).fold(told, cut);
    insta::assert_snapshot!(told);
    // It depends on how soon it comes what is said of its second line.
    let eager = refused(&Script::new("exec yes hello 1 x").verified());
    assert!(eager.contains("\"hello 1 x\" came: "), "{eager}");
}

/// Programs at fault when they are asked for two states.
const OVER_TWO_STATES: [&str; 13] = [
    "exec sleep 1000 # given up",
    "exec yes 0.5 0.5",
    "exec cat /dev/zero",
    "echo 0.5 0.5\nkill -9 $$",
    "echo 0.5 0.5\nexec sleep 1000 # given up",
    "echo 0.5 0.5\nprintf '0.5 0.'",
    "echo 0.5 0.5\necho done 7\ncat",
    "echo done 7\ncat",
    "echo 0.5 0.5\necho 0.5 0.5\necho 0.5 0.5\necho done 7\ncat",
    "echo 0.5 0.5\necho nan nan\necho done 7\ncat",
    "echo 0.5 inf\ncat",
    "echo 2.5 0.5 0.5\ncat",
    "echo 0.5 0.5\necho unsupported\ncat",
];

/// Programs at fault when they are asked for the crossings from 0 to 10 s.
const OVER_CROSSINGS: [&str; 9] = [
    "exec sleep 1000 # given up",
    "exec yes 0.5 0.0 0.5",
    "echo 0.5 0.0 0.5\nkill -9 $$",
    "echo 0.5 0.0 0.5\nexec sleep 1000 # given up",
    "echo 0.5 0.0 0.5\necho 0.25 0.0 -0.5\necho done 7\ncat",
    "echo nan 0.0 0.5\necho done 7\ncat",
    "echo 0.5 0.0 nan\ncat",
    "echo 0.0 0.5\ncat",
    "echo 0.5 0.0 0.5\necho unsupported\ncat",
];

/// What is told of the program that goes on with `rest` when it is asked so, in one line.
#[track_caller]
fn told_of<T: Debug>(rest: &str, ask: impl Fn(&Program) -> Result<T, Fault>) -> String {
    let script = Script::greeting(rest);
    let program = script.started(patience(rest));
    let why = why_none(ask(&program));
    assert_eq!(why_none(ask(&program)), why);
    assert!(!why.contains(char::is_control) && why.len() < 1000, "{why:?}");
    script.leaves_nothing();
    why.replace(script.0.path().to_str().unwrap(), "FOLDER") + "\n"
}

/// Catches: a solver that is waited for without an end, is left running, or ends the judge; a part
/// of an answer, or one of another length, taken for the whole; NaN, or a state, for a crossing;
/// crossings without an end, or in another order than that of the run, that reach the judge; what
/// was asked left out of the message.
#[test]
#[ignore = "waits for a program that hangs: .ci/run runs it"]
fn a_fault_of_a_solver_is_told_in_one_line() {
    let solve = SolveRequest::new(9.81, Phase::at_rest(2.0), 1e-8).to(&[2.5, 5.0]);
    let solved = |rest: &str| told_of(rest, |program| program.solve(&solve));
    let crossings = CrossingsRequest::new(9.81, Phase::at_rest(2.0), [0.0, 10.0], 1e-8);
    let crossed = |rest: &str| told_of(rest, |program| program.crossings(&crossings));
    let told =
        both(|| told_of_each(&OVER_TWO_STATES, solved), || told_of_each(&OVER_CROSSINGS, crossed));
    insta::assert_snapshot!(told.concat());
}

/// Catches: a judge of solvers that holds an answer which breaks the protocol for one, goes on
/// asking, or does not say what came; a program that knows no solvers taken for one at fault.
#[test]
#[ignore = "waits for a program that hangs: .ci/run runs it"]
fn the_judge_of_solvers_tells_a_fault() {
    let judged = |program: &Program| try_judge_solver(program, Claims::order(5).crossings());
    let tolerance = |program: &Program| -> Result<(), Fault> {
        let report = judged(program)?;
        assert!(report.findings.iter().all(|it| it.verdict == Verdict::NotMeasured), "{report}");
        Err(Fault::Lost(report.finding(Property::Tolerance).unwrap().why()))
    };
    for (rest, because) in [
        ("exec sleep 1000 # given up", "given up after 3 s"),
        ("exec yes 0.5 0.5", "and does not say done"),
        ("echo 0.5 0.5\nkill -9 $$", "it ended (signal: 9 (SIGKILL))"),
        ("echo done 7\ncat", "\"done 7\" came: it has sent 0 of"),
        ("echo nan nan\ncat", "\"nan nan\" came: θ is not finite"),
    ] {
        let why = told_of(rest, tolerance);
        assert!(why.contains(because) && why.contains("asked \"solve "), "{why}");
    }
    let script = Script::greeting("echo unsupported\nread -r line");
    assert_eq!(judged(&script.started(600.0)), Err(Fault::Unsupported));
    script.leaves_nothing();
}

/// Catches: the way back held for a wrong order, or the way out for it; two crossings at the same
/// time, or none, refused.
#[test]
fn crossings_have_the_order_of_the_run() {
    let script = "echo 0.5 0 1\necho 0.5 0 1\necho 0.25 0 1\necho done";
    let back = CrossingsRequest::new(9.81, Phase::at_rest(2.0), [1.0, 0.0], 1e-8);
    let program = Script::greeting(script);
    let crossings = program.started(600.0).crossings(&back).unwrap();
    assert_eq!(crossings.iter().map(|(t, _)| *t).collect::<Vec<_>>(), [0.5, 0.5, 0.25]);
    let out = CrossingsRequest::new(9.81, Phase::at_rest(2.0), [0.0, 1.0], 1e-8);
    let why = told_of(script, |program| program.crossings(&out));
    assert!(why.contains("\"0.25 0 1\" came: it comes before 0.5 s"), "{why}");
    let none = Script::greeting("echo done 12");
    assert_eq!(none.started(600.0).crossings(&out), Ok(Vec::new()));
}

/// Catches: a wait for a program that does not read a question of megabytes, or has ended before
/// it; a message that quotes all of it.
#[test]
#[ignore = "waits for a program that hangs: .ci/run runs it"]
fn a_long_question_does_not_keep_the_judge() {
    let times: Vec<f64> = (1..=100_000).map(|k| f64::from(k) / 30_001.0).collect();
    let request = SolveRequest::new(9.81, Phase::at_rest(2.0), 1e-8).to(&times);
    for (patience, then, because) in [
        (3.0, "exec sleep 1000", "given up after 3 s, without an answer"),
        (600.0, "exit 3", "it ended (exit status: 3), without an answer"),
        (
            600.0,
            "head -n 1 > /dev/null\necho 1 2\necho done\ncat",
            "it has sent 1 of 100000 states",
        ),
        (600.0, "echo 1 2\necho done\ncat > /dev/null", "it has sent 1 of 100000 states"),
    ] {
        let script = Script::new(&format!("read -r line\necho hello 1 x\n{then}"));
        let why = why_none(script.started(patience).solve(&request));
        let is_told = why.contains(because) || why.contains("before the question");
        assert!(is_told && why.contains("asked \"solve 9.81 2.0 0.0 0.0 1e-8 3.3"), "{why}");
        assert!(why.len() < 1000, "{why}");
        script.leaves_nothing();
    }
}

/// Catches: patience for the first request alone, or for each line instead of each answer; a
/// question that was not answered asked again; a program that is not begun anew for another.
#[test]
#[ignore = "waits for a program that hangs: .ci/run runs it"]
fn a_program_that_hangs_at_a_later_request() {
    let later = || {
        let script = Script::greeting("echo 0.5 0.5\necho done 2\nread -r line\nexec sleep 1000");
        let program = script.started(3.0);
        assert_eq!(program.answer(&request(0.1, 1)).unwrap().evaluations, Some(2));
        let why = none(&program, &request(0.1, 1));
        assert!(why.contains("given up after 3 s, without an answer"), "{why}");
        script.leaves_nothing();
        assert_eq!(none(&program, &request(0.1, 1)), why);
        assert_eq!(script.numbers().len(), 1);
        assert_eq!(program.answer(&request(0.2, 1)).unwrap().evaluations, Some(2));
        assert_eq!(script.numbers().len(), 2);
        drop(program);
        script.leaves_nothing();
    };
    let trickle = || {
        let script = Script::greeting("while :; do echo 0.5 0.5; sleep 0.1; done");
        let why = none(&script.started(3.0), &request(0.1, 1000));
        assert!(why.contains("given up after 3 s, with "), "{why}");
        script.leaves_nothing();
    };
    both(later, trickle);
}

/// Catches: a program that greets at its start taken for one at fault, now and then.
#[test]
fn a_program_may_greet_first() {
    let eager = Script::new("echo hello 1 eager\nread -r line\nread -r line\necho 1 2\necho done");
    let program = eager.started(600.0);
    assert_eq!(program.answer(&request(0.1, 1)).unwrap().states.len(), 1);
    drop(program);
    eager.leaves_nothing();
}

/// Catches: a refusal that ends the conversation, or is taken for a fault; an answer to one request
/// taken for that to the next.
#[test]
#[ignore = "waits for a program that hangs: .ci/run runs it"]
fn a_program_may_refuse_and_go_on() {
    let text = "echo error too long\nread -r line\necho unsupported\nread -r line\necho 1 2\n\
                echo error after all\nread -r line\necho 0.5 0.5\necho done\necho 0.5 0.5\n\
                echo done 3\necho written >> \"$1\"\nread -r line";
    let script = Script::greeting(text);
    let program = script.started(600.0);
    let driven = request(0.1, 1).driven(Drive { amplitude: 1.0, frequency: 1.0 });
    assert_eq!(program.answer(&request(9.0, 1)), Err(Fault::Refused("too long".to_string())));
    assert_eq!(program.answer(&driven), Err(Fault::Unsupported));
    assert_eq!(program.answer(&request(0.1, 20)), Err(Fault::Refused("after all".to_string())));
    assert_eq!(program.answer(&request(0.1, 1)).unwrap().evaluations, None);
    // The second answer to the last request is on its way, and then needs a moment to arrive.
    while !script.numbers().contains(&"written".to_string()) {
        thread::sleep(Duration::from_millis(5));
    }
    thread::sleep(Duration::from_secs(1));
    let why = none(&program, &request(0.1, 1));
    assert!(why.contains("\"0.5 0.5\" came: it was there before the question"), "{why}");
    script.leaves_nothing();
}

/// Catches: a program that outlives the judge because it ends neither by itself nor when asked to,
/// or what it has started; one that is killed though it would have ended.
#[rstest]
#[case::stubborn("trap '' TERM INT HUP", "while :; do sleep 1; done", false)]
#[case::polite("", "echo $line >> \"$1\"", true)]
#[case::leaves_others(
    "sh -c 'trap \"\" TERM HUP; sleep 1000' &\necho $! >> \"$1\"",
    "echo $line >> \"$1\"",
    true
)]
fn a_program_takes_its_leave(#[case] before: &str, #[case] then: &str, #[case] hears: bool) {
    let answers = "echo 0.5 0.5\necho done 2\nread -r line";
    let script = Script::greeting(&format!("{before}\n{answers}\n{then}"));
    let program = script.started(600.0);
    program.answer(&request(0.1, 1)).unwrap();
    drop(program);
    assert_eq!(script.numbers().contains(&"bye".to_string()), hears);
    script.leaves_nothing();
}

/// Catches: a program left running by a panic of the judge.
#[test]
fn a_panic_leaves_nothing_behind() {
    let silent = Script::greeting("exec sleep 1000");
    let panic = catch_unwind(AssertUnwindSafe(|| {
        let _program = silent.started(600.0);
        std::panic::resume_unwind(Box::new("the judge panics"));
    }));
    assert!(panic.is_err());
    silent.leaves_nothing();
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
    let deadline = Instant::now() + MINUTES;
    while silent.numbers().is_empty() {
        assert!(Instant::now() < deadline, "it does not start");
        thread::sleep(Duration::from_millis(5));
    }
    let kill = Command::new("kill").args(["-INT", &run.id().to_string()]).status().unwrap();
    assert!(kill.success());
    let line = refused(&run.wait_with_output().unwrap());
    assert_eq!(line, "pendula: interrupted\n");
    silent.leaves_nothing();
    let left: Vec<_> = fs::read_dir(silent.0.path()).unwrap().collect();
    assert_eq!(left.len(), 2, "{left:?}");
}
