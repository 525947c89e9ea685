//! A process that is ended with all that it has started.

use std::io;
use std::process::{Child, Command, ExitStatus};

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
