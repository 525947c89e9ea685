//! Why something was not measured, in words.

use core::fmt;

use crate::judge::verdict::Trouble;

impl fmt::Display for Trouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoAnswer(why) => write!(f, "no answer: {why}"),
            Self::Count { asked, came } if came > asked => {
                write!(f, "more than the {asked} states that were asked for")
            }
            Self::Count { asked, came } => write!(f, "{came} states where {asked} were asked for"),
            Self::NotFinite => f.write_str("a state is not finite"),
            Self::Lost(why) | Self::Broken(why) => f.write_str(why),
        }
    }
}
