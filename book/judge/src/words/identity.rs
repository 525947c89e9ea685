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
            write!(f, ", seen {seen}")?;
        }
        if *angles_only {
            f.write_str(", by its angles; the velocities are others")?;
        }
        if let Some(equation) = on {
            write!(f, ", on {equation}")?;
        }
        match *apart {
            0.0 => f.write_str(", to the bit in eight steps"),
            apart => write!(f, ", to {} rad in eight steps", about(apart)),
        }
    }
}
