//! What is said of one measurement: what came of it, and the verdict.

use crate::integrator::{Fault, Reply};

/// What is to be said of a claim, or of all of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Verdict {
    /// It was measured and holds.
    Holds,
    /// It was measured and does not hold.
    Fails,
    /// It was measured, and cannot be told: from rounding, or between two bounds.
    Unclear,
    /// It was not measured: the integrator does not answer, or not in time.
    #[default]
    NotMeasured,
    /// Nobody claims it; what was measured is said all the same.
    Unclaimed,
}

impl Verdict {
    /// Its name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::Fails => "fails",
            Self::Unclear => "unclear",
            Self::NotMeasured => "not measured",
            Self::Unclaimed => "unclaimed",
        }
    }

    /// That `value` is at most `holds`: it fails beyond `fails`, and between the two nothing can be
    /// told. A NaN fails.
    pub fn of(value: f64, holds: f64, fails: f64) -> Self {
        if value <= holds {
            Self::Holds
        } else if value <= fails {
            Self::Unclear
        } else {
            Self::Fails
        }
    }
}

/// Why a measurement was not had.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Trouble {
    /// The integrator does not answer such a request, and perhaps says why.
    NoAnswer(String),
    /// It answered with other than the number of states that was asked for.
    Count {
        /// So many were asked for.
        asked: u64,
        /// And so many came.
        came: u64,
    },
    /// It answered with a state that is not finite.
    NotFinite,
    /// It gave no answer that can be used, and begins anew: this costs one property.
    Lost(String),
    /// It broke the protocol; the judging ends.
    Broken(String),
}

impl From<Fault> for Trouble {
    fn from(fault: Fault) -> Self {
        match fault {
            Fault::Unsupported => Self::NoAnswer("unsupported".to_string()),
            Fault::Refused(why) => Self::NoAnswer(why),
            Fault::Lost(why) => Self::Lost(why),
            Fault::Broken(why) => Self::Broken(why),
        }
    }
}

impl From<Trouble> for Fault {
    fn from(trouble: Trouble) -> Self {
        match trouble {
            Trouble::Broken(why) => Self::Broken(why),
            Trouble::Lost(why) => Self::Lost(why),
            other => Self::Refused(other.to_string()),
        }
    }
}

/// A reply with as many finite states as were `asked` for.
pub fn checked(reply: Reply, asked: u64) -> Measured<Reply> {
    let came = reply.states.len() as u64;
    if came != asked {
        return Err(Trouble::Count { asked, came });
    }
    if !reply.states.iter().all(|z| z.theta.is_finite() && z.omega.is_finite()) {
        return Err(Trouble::NotFinite);
    }
    Ok(reply)
}

/// What came of a measurement.
pub type Measured<T> = Result<T, Trouble>;

/// `None` for what could not be measured: only a broken protocol ends the judging.
pub fn told<T>(found: Measured<T>) -> Measured<Option<T>> {
    match found {
        Ok(found) => Ok(Some(found)),
        Err(Trouble::Broken(why)) => Err(Trouble::Broken(why)),
        Err(_) => Ok(None),
    }
}
