//! A process that is ended with all that it has started, and threads that read what it writes, so
//! that nobody waits for it longer than he wants to, and none of them keeps more than it may.

use std::collections::VecDeque;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::process::{Child, Command, ExitStatus};
use std::sync::mpsc::{self, Receiver, Sender};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::Duration;

/// A process with those that it has started. Dropped, it is ended.
///
/// On Unix these are a group of their own, so that an interrupt at the terminal does not reach
/// them, and all are killed at once, but for one that leaves the group by itself. Elsewhere only
/// the process is killed.
#[derive(Debug)]
pub struct Group {
    child: Child,
    /// How it ended, once it has been waited for. Its number may then be that of another process.
    status: Option<ExitStatus>,
}

impl Group {
    /// Starts the command.
    pub fn start(command: &mut Command) -> io::Result<Self> {
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(command, 0);
        Ok(Self { child: command.spawn()?, status: None })
    }

    /// The process itself, for its pipes.
    pub const fn child(&mut self) -> &mut Child {
        &mut self.child
    }

    /// Whether the process itself has ended.
    pub fn has_ended(&mut self) -> bool {
        self.status.is_some() || has_ended(&mut self.child)
    }

    /// Ends what is left of them and returns how the process itself ended.
    pub fn end(&mut self) -> io::Result<ExitStatus> {
        if let Some(status) = self.status {
            return Ok(status);
        }
        kill(&mut self.child);
        let status = self.child.wait()?;
        self.status = Some(status);
        Ok(status)
    }
}

impl Drop for Group {
    fn drop(&mut self) {
        // A process that cannot be waited for is none of ours any more.
        let _ = self.end();
    }
}

/// Does not wait for the process, so that its number still belongs to its group.
#[cfg(unix)]
fn has_ended(child: &mut Child) -> bool {
    use rustix::process::{Pid, WaitId, WaitIdOptions, waitid};
    let options = WaitIdOptions::EXITED | WaitIdOptions::NOHANG | WaitIdOptions::NOWAIT;
    matches!(waitid(WaitId::Pid(Pid::from_child(child)), options), Ok(Some(_)))
}

#[cfg(not(unix))]
fn has_ended(child: &mut Child) -> bool {
    matches!(child.try_wait(), Ok(Some(_)))
}

#[cfg(unix)]
fn kill(child: &mut Child) {
    use rustix::process::{Pid, Signal, kill_process_group};
    // A group that has ended needs no killing.
    let _ = kill_process_group(Pid::from_child(child), Signal::KILL);
}

#[cfg(not(unix))]
fn kill(child: &mut Child) {
    // A process that has ended needs no killing.
    let _ = child.kill();
}

/// The most bytes of a line: a state takes fifty.
pub const LONGEST: usize = 1000;
/// Lines that wait to be read; beyond them the program waits.
const WAITING: usize = 1024;
/// Lines on standard error that are kept.
const KEPT: usize = 3;

/// A line of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Line {
    /// A whole one, without its end.
    Whole(String),
    /// The first bytes of one that is longer than [`LONGEST`]; what follows is no line.
    TooLong(String),
    /// What came before the output ended; nothing follows.
    Unended(String),
}

/// The next line, or `None` at the end.
fn next(input: &mut impl BufRead) -> io::Result<Option<Line>> {
    let mut bytes = Vec::new();
    input.by_ref().take(LONGEST as u64 + 1).read_until(b'\n', &mut bytes)?;
    let ended = bytes.last() == Some(&b'\n');
    let text = String::from_utf8_lossy(&bytes).trim_end_matches(['\r', '\n']).to_string();
    Ok(match bytes.len() {
        0 => None,
        _ if ended => Some(Line::Whole(text)),
        length if length > LONGEST => Some(Line::TooLong(text)),
        _ => Some(Line::Unended(text)),
    })
}

/// The lines of `input`, read by a thread, until they end or nobody asks for more.
pub fn lines(input: impl Read + Send + 'static) -> Receiver<Line> {
    let (sender, receiver) = mpsc::sync_channel(WAITING);
    thread::spawn(move || {
        let mut input = BufReader::new(input);
        while let Ok(Some(line)) = next(&mut input) {
            if sender.send(line).is_err() {
                break;
            }
        }
    });
    receiver
}

/// Writes the lines that are sent to `output`, in a thread: a program that does not read must not
/// keep anybody waiting. It ends when the sender is dropped, or the program has ended.
pub fn writer(mut output: impl Write + Send + 'static) -> (Sender<String>, JoinHandle<()>) {
    let (sender, receiver) = mpsc::channel::<String>();
    let thread = thread::spawn(move || {
        for line in receiver {
            if output.write_all(line.as_bytes()).and_then(|()| output.flush()).is_err() {
                break;
            }
        }
    });
    (sender, thread)
}

/// The last lines of what a program writes on standard error.
#[derive(Debug)]
pub struct LastLines {
    kept: Arc<Mutex<VecDeque<String>>>,
    /// Disconnected at the end.
    end: Receiver<()>,
}

impl LastLines {
    /// Reads `input` in a thread.
    pub fn of(input: impl Read + Send + 'static) -> Self {
        let kept = Arc::new(Mutex::new(VecDeque::new()));
        let (sender, end) = mpsc::channel();
        let keep = Arc::clone(&kept);
        thread::spawn(move || {
            let mut input = BufReader::new(input);
            while let Ok(Some(line)) = next(&mut input) {
                let (Line::Whole(text) | Line::TooLong(text) | Line::Unended(text)) = line;
                if text.trim().is_empty() {
                    continue;
                }
                let mut keep = keep.lock().unwrap_or_else(PoisonError::into_inner);
                if keep.len() == KEPT {
                    keep.pop_front();
                }
                keep.push_back(text);
            }
            drop(sender);
        });
        Self { kept, end }
    }

    /// The lines, when the program has ended. One that it has started may still hold its standard
    /// error open, and is not waited for.
    pub fn at_the_end(&self) -> Vec<String> {
        const MOMENT: Duration = Duration::from_secs(1);
        let _ = self.end.recv_timeout(MOMENT);
        let kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        kept.iter().cloned().collect()
    }
}
