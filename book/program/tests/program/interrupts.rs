//! What the signals that interrupt do to a run.

use std::io::Read;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::Duration;

use rustix::process::{Pid, Signal, kill_process};

use crate::call::PENDULA;

/// A run of hours that has begun to print, and so listens.
fn run() -> Child {
    let steps = ["--dt", "0.001", "--steps", "1000000000"];
    let mut child = Command::new(PENDULA)
        .args(["simulate", "--method", "rk4", "--theta0", "1"])
        .args(steps)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("it starts");
    child.stdout.as_mut().expect("a pipe").read_exact(&mut [0]).expect("a header");
    child
}

fn send(signal: Signal, to: &Child) {
    kill_process(Pid::from_child(to), signal).expect("it runs");
}

/// Waits until the process waits.
fn sleeps(process: &Child) {
    let state = || {
        let number = process.id().to_string();
        Command::new("ps").args(["-o", "stat=", "-p", &number]).output().expect("ps").stdout
    };
    while !state().starts_with(b"S") {
        thread::sleep(Duration::from_millis(5));
    }
}

/// Catches: a signal that is not listened to, or that ends the process where it stands.
#[test]
fn each_signal_interrupts() {
    for signal in [Signal::INT, Signal::TERM, Signal::HUP] {
        let child = run();
        send(signal, &child);
        let output = child.wait_with_output().expect("it ends");
        let line = String::from_utf8(output.stderr).expect("UTF-8");
        assert_eq!(output.status.code(), Some(2), "{signal:?}: {line}");
        assert!(line.contains("interrupted after"), "{signal:?}: {line}");
        assert_eq!(output.stdout.last(), Some(&b'\n'), "half a row");
    }
}

/// The run waits for a reader that does not read.
///
/// Catches: several signals at once, as a closing terminal sends them, that end the process; a
/// later one that does not.
#[test]
fn a_later_signal_ends_the_process_at_once() {
    let mut child = run();
    // Until it has filled the pipe.
    sleeps(&child);
    for signal in [Signal::HUP, Signal::TERM, Signal::INT] {
        send(signal, &child);
        thread::sleep(Duration::from_millis(50));
    }
    assert_eq!(child.try_wait().expect("its status"), None);
    let status = (0..200).find_map(|_| {
        thread::sleep(Duration::from_millis(50));
        // Its number is its own until its status is known.
        send(Signal::INT, &child);
        child.try_wait().expect("its status")
    });
    child.kill().expect("it can be ended");
    assert_eq!(status.and_then(|status| status.code()), Some(2));
}

/// Catches: a run that waits for ever for somebody to read its pipe.
#[test]
fn a_pipe_that_nobody_reads_is_waited_for_until_a_signal() {
    let folder = tempfile::tempdir().expect("a folder");
    let pipe = folder.path().join("pipe");
    let made = Command::new("mkfifo").arg(&pipe).status().expect("mkfifo");
    assert!(made.success());
    let child = Command::new(PENDULA)
        .args(["simulate", "--method", "rk4", "--theta0", "1", "--dt", "0.1", "--steps", "9"])
        .arg("--output")
        .arg(&pipe)
        .stderr(Stdio::piped())
        .spawn()
        .expect("it starts");
    // It listens before it waits for the reader.
    sleeps(&child);
    send(Signal::TERM, &child);
    let output = child.wait_with_output().expect("it ends");
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    assert!(String::from_utf8_lossy(&output.stderr).contains("interrupted"), "{output:?}");
}
