//! Faults for tests: the operations of this thread are counted, and one of them fails.

use std::cell::{Cell, RefCell};
use std::io;
use std::path::{Path, PathBuf};

use super::operations::Operation;

/// Which operations fail.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// None.
    None,
    /// That with this number, counted from 1, and no other.
    Once(usize),
    /// From this number on all that take room on the disk, as once it is full.
    FullFrom(usize),
    /// From this number on all, which leaves what a process leaves that is killed.
    AllFrom(usize),
}

struct Plan {
    fault: Fault,
    done: Vec<(Operation, PathBuf)>,
    /// Whether half of the bytes of the write that is to fail have been written.
    halved: bool,
}

thread_local! {
    static PLAN: RefCell<Option<Plan>> = const { RefCell::new(None) };
}

thread_local! {
    static IN_ONE_STEP: Cell<bool> = const { Cell::new(true) };
}

/// Whether two folders can change places in one step.
pub fn in_one_step() -> bool {
    IN_ONE_STEP.get()
}

/// The result of `work` where two folders cannot change places in one step.
pub fn with_two_renames<T>(work: impl FnOnce() -> T) -> T {
    IN_ONE_STEP.set(false);
    let result = work();
    IN_ONE_STEP.set(true);
    result
}

impl Operation {
    /// Whether a full disk makes it fail.
    pub fn takes_room(self) -> bool {
        matches!(self, Self::Create | Self::Write | Self::Sync)
    }

    /// Whether something is different after it.
    pub fn changes(self) -> bool {
        !matches!(self, Self::Look | Self::Read | Self::List | Self::Sync)
    }
}

/// What every fault says.
pub const SAYS: &str = "a fault for the test";

/// The result of `work`, during which `fault` happens, and the operations that it did or tried.
pub fn with<T>(fault: Fault, work: impl FnOnce() -> T) -> (T, Vec<(Operation, PathBuf)>) {
    PLAN.set(Some(Plan { fault, done: Vec::new(), halved: false }));
    let result = work();
    (result, PLAN.take().map(|plan| plan.done).unwrap_or_default())
}

/// Whether the next operation may succeed.
pub fn allow(operation: Operation, path: &Path) -> io::Result<()> {
    PLAN.with_borrow_mut(|plan| {
        let Some(plan) = plan else { return Ok(()) };
        plan.done.push((operation, path.to_path_buf()));
        let fails = match plan.fault {
            Fault::None => false,
            Fault::Once(number) => plan.done.len() == number,
            Fault::FullFrom(number) => plan.done.len() >= number && operation.takes_room(),
            Fault::AllFrom(number) => plan.done.len() >= number,
        };
        if fails { Err(io::Error::other(SAYS)) } else { Ok(()) }
    })
}

/// How many of the bytes may be written. A write that is to fail writes half of them first, as to a
/// disk that fills up.
pub fn allow_write(path: &Path, bytes: usize) -> io::Result<usize> {
    let half = PLAN.with_borrow_mut(|plan| {
        let Some(Plan { fault, done, halved }) = plan else { return false };
        let fails = match fault {
            Fault::None => false,
            Fault::Once(number) | Fault::FullFrom(number) | Fault::AllFrom(number) => {
                *number == done.len() + 1
            }
        };
        fails && bytes > 1 && !std::mem::replace(halved, true)
    });
    if half {
        return Ok(bytes / 2);
    }
    allow(Operation::Write, path).map(|()| bytes)
}
