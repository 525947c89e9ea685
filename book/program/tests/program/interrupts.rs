//! What the signals that interrupt do to a run.

use std::fs;
use std::io::Read;
use std::process::{Child, Command, Output, Stdio};
use std::thread;
use std::time::Duration;

use rustix::process::{Pid, Signal, kill_process};
use serde_json::Value;

use crate::{PENDULA, names, words};

fn start(line: &str) -> Child {
    let mut command = Command::new(PENDULA);
    command.args(words(line)).stdout(Stdio::piped()).stderr(Stdio::piped());
    command.spawn().expect("it starts")
}

/// The same, once it prints, and so listens.
fn printing(line: &str) -> Child {
    let mut child = start(line);
    child.stdout.as_mut().expect("a pipe").read_exact(&mut [0]).expect("a row");
    child
}

fn send(signal: Signal, to: &Child) {
    kill_process(Pid::from_child(to), signal).expect("it runs");
}

/// How the run ended after a signal: with status 2, and one line.
fn ended(run: Child) -> (Output, String) {
    let output = run.wait_with_output().expect("it ends");
    let line = String::from_utf8(output.stderr.clone()).expect("UTF-8");
    assert_eq!((output.status.code(), line.lines().count()), (Some(2), 1), "{line}");
    (output, line)
}

/// The same of a run that has noticed it.
fn interrupted(run: Child) -> Output {
    let (output, line) = ended(run);
    assert!(line.contains("interrupted after"), "{line}");
    output
}

/// A run of hours with no row between the first and the last, interrupted by each signal, and
/// resumed.
///
/// Catches: a signal that is not listened to, or is heard only at the next row; a file that is
/// touched or left half; a run that begins again.
#[test]
fn signals_are_heard_between_rows() {
    let folder = tempfile::tempdir().expect("a folder");
    let [file, state] = ["run.csv", "run.csv.state"].map(|name| folder.path().join(name));
    fs::write(&file, "old").expect("it can be written");
    let far = "simulate --method kahan-li-8 --theta0 1 --dt 0.01 --steps 1000000000";
    let mut line = format!("{far} --every 1000000000 --output {}", file.display());
    let mut before = 0;
    for signal in [Signal::INT, Signal::TERM, Signal::HUP] {
        let mut run = start(&line);
        // The temporary file shows that the run has begun and listens.
        while !names(folder.path()).iter().any(|name| name.starts_with(".pendula-")) {
            assert!(run.try_wait().expect("its status").is_none(), "it ended by itself");
            thread::yield_now();
        }
        send(signal, &run);
        interrupted(run);
        assert_eq!(names(folder.path()), ["run.csv", "run.csv.state"]);
        assert_eq!(fs::read_to_string(&file).expect("the old one"), "old");
        let text = fs::read_to_string(&state).expect("a state");
        // Behind the eight digits of its checksum.
        let json = &text.lines().last().expect("a line")[8..];
        let stands: Value = serde_json::from_str(json).expect("JSON");
        let steps = stands["progress"]["steps"].as_u64().expect("steps");
        assert!(steps >= before && steps < 1_000_000_000, "{steps}");
        before = steps;
        line = format!("simulate --resume {}", state.display());
    }
}

/// Rows on a pipe, as many as it holds, when the signal comes: the last one is whole, the array is
/// closed.
///
/// Catches: rows in a buffer that are lost, a row cut off, an array left open by a signal.
#[test]
fn a_signal_leaves_standard_output_whole() {
    let mut run =
        printing("simulate --method rk4 --theta0 1 --dt 0.01 --steps 1000000000000 --format json");
    // Somebody has to read while it ends.
    let mut pipe = run.stdout.take().expect("a pipe");
    let reader = thread::spawn(move || {
        let mut rest = vec![b'['];
        pipe.read_to_end(&mut rest).map(|_| rest)
    });
    send(Signal::INT, &run);
    interrupted(run);
    let printed = reader.join().expect("no panic").expect("rows");
    let rows: Vec<Value> = serde_json::from_slice(&printed).expect("an array");
    assert!(rows.len() > 5);
}

/// The run waits for a reader that does not read, and cannot look at the signal.
///
/// Catches: a run that is deaf to the first signal, or to all of them; one that says nothing.
#[test]
fn a_run_that_waits_is_ended() {
    let mut run = printing("simulate --method rk4 --theta0 1 --dt 0.001 --steps 1000000000");
    // Until it has filled the pipe.
    while state(&run) != b'S' {
        thread::sleep(Duration::from_millis(5));
    }
    // Nobody reads the rows, but somebody waits for the end of them.
    let rows = run.stdout.take();
    send(Signal::TERM, &run);
    assert_eq!(ended(run).1, "pendula: interrupted\n");
    drop(rows);
}

/// A FIFO that nobody reads cannot be opened.
///
/// Catches: a run that hears no signal before it computes.
#[test]
fn what_has_not_begun_is_ended() {
    let folder = tempfile::tempdir().expect("a folder");
    let fifo = folder.path().join("fifo");
    assert!(Command::new("mkfifo").arg(&fifo).status().expect("mkfifo").success());
    for signal in [Signal::INT, Signal::TERM, Signal::HUP] {
        let line = "simulate --method rk4 --theta0 1 --dt 0.01 --duration 10 --output";
        let run = start(&format!("{line} {}", fifo.display()));
        // It listens once it sleeps: there is nothing else that it waits for.
        while state(&run) != b'S' {
            thread::sleep(Duration::from_millis(5));
        }
        thread::sleep(Duration::from_millis(50));
        send(signal, &run);
        assert_eq!(ended(run).1, "pendula: interrupted\n");
        assert_eq!(names(folder.path()), ["fifo"]);
    }
}

/// How the system calls the state of a process: S where it sleeps.
fn state(run: &Child) -> u8 {
    let number = run.id().to_string();
    let listed = Command::new("ps").args(["-o", "stat=", "-p", &number]).output().expect("ps");
    listed.stdout.first().copied().unwrap_or_default()
}
