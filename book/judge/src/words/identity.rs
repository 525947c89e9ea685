//! A known method and from where it is seen, in words.

use core::fmt;

use super::numbers::about;
use crate::judge::identity::{Identity, Seen};

impl fmt::Display for Seen {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (by, what) =
            if self.kicks == 0.0 { (self.drifts, "drift") } else { (self.kicks, "kick") };
        let much = if by.abs() == 1.0 { "a whole" } else { "half a" };
        write!(f, "{much} {what} {}", if by > 0.0 { "ahead" } else { "behind" })
    }
}

impl fmt::Display for Identity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { method, title, seen, angles_only, on, apart } = self;
        f.write_str(title)?;
        if title != method {
            write!(f, " ({method})")?;
        }
        if *seen != Seen::DIRECTLY {
            write!(f, ", but its states lie {seen}")?;
        }
        if *angles_only {
            f.write_str(", by its angles alone, because its velocities are not the method's")?;
        }
        if let Some(equation) = on {
            write!(f, ", on {equation}")?;
        }
        let what = if *angles_only { "the angles of eight steps" } else { "eight steps" };
        match *apart {
            0.0 => write!(f, ": {what} agree to the bit"),
            apart => write!(f, ": {what} agree to {} rad", about(apart)),
        }
    }
}
