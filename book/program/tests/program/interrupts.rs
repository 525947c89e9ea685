//! What the signals that interrupt do to a run.

use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::process::{Child, Command, Output, Stdio};
use std::thread;
use std::time::Duration;

use rustix::process::{Pid, Signal, kill_process};

use crate::{PENDULA, names, printed, words};

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

/// What the run has said after a signal that has ended it, with status 2 and one line.
fn ended(run: Child) -> Output {
    let output = run.wait_with_output().expect("it ends");
    let line = String::from_utf8_lossy(&output.stderr);
    assert_eq!((output.status.code(), &*line), (Some(2), "pendula: interrupted\n"));
    output
}

/// A run of hours with no row between the first and the last, interrupted by each signal.
///
/// Catches: a signal that is not listened to, or is heard only at the next row; a file that is
/// touched or left half.
#[test]
fn signals_are_heard_between_rows() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("run.csv");
    fs::write(&file, "old").expect("it can be written");
    let far = "simulate --method kahan-li-8 --theta0 1 --dt 0.01 --steps 1000000000";
    let line = format!("{far} --every 1000000000 --output {}", file.display());
    for signal in [Signal::INT, Signal::TERM, Signal::HUP] {
        let mut run = start(&line);
        // The temporary file shows that the run has begun and listens.
        while !names(folder.path()).iter().any(|name| name.starts_with(".pendula-")) {
            assert!(run.try_wait().expect("its status").is_none(), "it ended by itself");
            thread::yield_now();
        }
        send(signal, &run);
        ended(run);
        assert_eq!(names(folder.path()), ["run.csv"]);
        assert_eq!(fs::read_to_string(&file).expect("the old one"), "old");
    }
}

/// Rows on a pipe, at random moments: while somebody reads them as fast as they come, and while the
/// pipe is full and some of it has been read. They are those of a run that is not ended, cut off
/// behind one of them.
///
/// Catches: a row that is cut off where a buffer or the pipe was full; rows lost in their midst.
#[test]
fn a_signal_leaves_whole_rows() {
    const RUN: &str = "simulate --method rk4 --theta0 1 --dt 0.01 --steps";
    let whole = printed(&words(&format!("{RUN} 100000")));
    let mut random = 0x2545_F491_u64;
    for attempt in 0..6 {
        // Knuth's generator.
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        let mut run = printing(&format!("{RUN} 100000000"));
        let mut pipe = run.stdout.take().expect("a pipe");
        let mut rows = b"t".to_vec();
        if attempt < 3 {
            let reader = thread::spawn(move || pipe.read_to_end(&mut rows).map(|_| rows));
            thread::sleep(Duration::from_micros(random >> 46));
            send(Signal::TERM, &run);
            ended(run);
            rows = reader.join().expect("no panic").expect("rows");
        } else {
            while state(&run) != b'S' {
                thread::sleep(Duration::from_millis(5));
            }
            pipe.by_ref().take(random >> 50).read_to_end(&mut rows).expect("rows");
            thread::sleep(Duration::from_millis(50));
            send(Signal::TERM, &run);
            ended(run);
            pipe.read_to_end(&mut rows).expect("rows");
        }
        let rows = String::from_utf8(rows).expect("UTF-8");
        assert!(rows.ends_with('\n') && rows.lines().count() > 5, "{attempt}");
        let is_row = |row: &str| row.split(',').filter_map(|x| x.parse::<f64>().ok()).count() == 4;
        assert!(rows.lines().skip(1).all(is_row), "{attempt}");
        let both = rows.lines().zip(whole.lines());
        assert!(both.into_iter().all(|(row, expected)| row == expected), "{attempt}");
    }
}

/// A run of forty rows, which are fewer than go out at once, ended long before the last.
///
/// Catches: rows that wait for others, and are lost with the hours that they took.
#[test]
fn a_row_does_not_wait_for_others() {
    let run = "simulate --method kahan-li-8 --theta0 1 --dt 0.01 --steps 40000000 --every 1000000";
    let mut run = start(run);
    let mut rows = BufReader::new(run.stdout.take().expect("a pipe")).lines();
    let seen: Vec<String> = rows.by_ref().take(3).map(|row| row.expect("a row")).collect();
    send(Signal::TERM, &run);
    ended(run);
    assert_eq!(seen[2].split(',').next(), Some("10000.0"));
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
    ended(run);
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
        ended(run);
        assert_eq!(names(folder.path()), ["fifo"]);
    }
}

/// How the system calls the state of a process: S where it sleeps.
fn state(run: &Child) -> u8 {
    let number = run.id().to_string();
    let listed = Command::new("ps").args(["-o", "stat=", "-p", &number]).output().expect("ps");
    listed.stdout.first().copied().unwrap_or_default()
}
