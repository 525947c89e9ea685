//! The words for what is found in the rows of a run.

use core::fmt;

use super::numbers::{Scientific, plain};
use crate::known_answers;
use crate::rows::{
    AtTheEnd, Digits, Distinguish, Fault, Force, FoundEquation, Known, Made, Maker, Read, Refusal,
    RunReport, Unit,
};

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("There is nothing in it: paste or name rows of t, θ and ω."),
            Self::Binary => f.write_str("It is no text: save the rows as CSV first."),
            Self::TooLong => {
                f.write_str("It is longer than 256 MB: give some thousand rows of it.")
            }
            Self::NoRows => f.write_str(
                "There are no rows of numbers in it: a row is a time, an angle and, if there is \
                 one, an angular velocity.",
            ),
            Self::OneRow => f.write_str(
                "There is one row: what made it shows only where one row leads to the next.",
            ),
            Self::OneColumn => f.write_str(
                "There is one number in each row: a time and an angle are needed side by side.",
            ),
            Self::NoTime => f.write_str("No column goes on from row to row, as the time does."),
            Self::NoMotion => f.write_str("The angle is the same in all rows: nothing moves."),
            Self::TooFewRows { rows, needed } => write!(
                f,
                "There are {rows} rows that can be used, and it takes {needed} to find an equation."
            ),
        }
    }
}

impl core::error::Error for Refusal {}

impl fmt::Display for RunReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "What was read: {}", self.read)?;
        for fault in &self.faults {
            writeln!(f, "  {fault}")?;
        }
        if let Some(equation) = &self.equation {
            writeln!(f, "The equation:  {equation}")?;
        }
        writeln!(f, "The method:    {}", Says(self))?;
        if let Some(end) = &self.end {
            writeln!(f, "What follows:  {end}")?;
        }
        Ok(())
    }
}

impl fmt::Display for Read {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let column = |f: &mut fmt::Formatter<'_>, used: &crate::rows::Used| {
            match used.heading.as_str() {
                "" => write!(f, "column {}", used.column)?,
                heading => write!(f, "{heading:?}")?,
            }
            match used.digits {
                Digits::Decimals(1) => f.write_str(" (1 decimal)"),
                Digits::Decimals(n) => write!(f, " ({n} decimals)"),
                Digits::Significant(n) => write!(f, " ({n} digits)"),
            }
        };
        write!(f, "{} rows; the time is ", self.rows)?;
        column(f, &self.time)?;
        f.write_str(", ")?;
        match &self.height {
            Some(height) => {
                f.write_str("x is ")?;
                column(f, &self.angle)?;
                f.write_str(", y is ")?;
                column(f, height)?;
            }
            None => {
                f.write_str("the angle is ")?;
                column(f, &self.angle)?;
                f.write_str(if self.unit == Unit::Degrees {
                    " in degrees"
                } else {
                    " in radians"
                })?;
            }
        }
        if let Some(velocity) = &self.velocity {
            f.write_str(", the velocity is ")?;
            column(f, velocity)?;
            if self.velocity_in_radians {
                f.write_str(" in radians")?;
            }
        }
        match self.spacing {
            Some(spacing) => write!(f, "; a row each {} s", plain(spacing, 9)),
            None => f.write_str("; the rows are not evenly spaced"),
        }?;
        match self.lines_left_out {
            0 => Ok(()),
            1 => f.write_str("; 1 line is no row"),
            lines => write!(f, "; {lines} lines are no rows"),
        }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::NoNumber { row } => write!(f, "Row {row} has a cell without a number."),
            Self::Missing { after, rows: 1 } => write!(f, "A row is missing after row {after}."),
            Self::Missing { after, rows } => {
                write!(f, "{rows} rows are missing after row {after}.")
            }
            Self::TimeRepeated { row } => {
                write!(f, "Row {row} has the time of the row before, and another state.")
            }
            Self::StateRepeated { row } => write!(f, "Row {row} has the state of the row before."),
            Self::TimesLate { row, by: 1 } => write!(
                f,
                "From row {row} on the times are a row late: the state has gone on by two rows."
            ),
            Self::TimesLate { row, by } => {
                write!(f, "From row {row} on the times are {by} rows late.")
            }
            Self::TimeOff { row } => write!(f, "The time of row {row} is not that of its place."),
            Self::Edited { row } => write!(
                f,
                "Row {row} does not follow from the row before, nor the next from it: was it \
                 edited?"
            ),
            Self::VelocityShifted { rows } => write!(
                f,
                "The velocities are those of the row {}.",
                if rows > 0 { "after" } else { "before" }
            ),
            Self::Wrapped { row, times } => {
                let times = if times == 1 { "once".into() } else { format!("{times} times") };
                write!(f, "The angle is brought back by a full turn {times}, first in row {row}.")
            }
            Self::Uneven => f.write_str(
                "The times are uneven: no steps of one length lead from row to row, so the method \
                 is not looked for.",
            ),
        }
    }
}

/// A number with its uncertainty: "9.8000 ± 0.0004".
struct Within<'a>(&'a Known);

impl fmt::Display for Within<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Known { value, known_to, .. } = *self.0;
        if !(known_to > 0.0 && known_to.is_finite()) {
            return f.write_str(&plain(value, 12));
        }
        let digits = -libm::floor(libm::log10(known_to));
        if !(-3.0..=15.0).contains(&digits) {
            return write!(f, "{} ± {}", plain(value, 15), Scientific(known_to, 0));
        }
        let digits = libm::fmax(digits, 0.0) as usize;
        let value = format!("{value:.digits$}").replace('-', "−");
        if digits > 6 {
            return write!(f, "{value} ± {}", Scientific(known_to, 0));
        }
        write!(f, "{value} ± {known_to:.digits$}")
    }
}

impl fmt::Display for FoundEquation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let force = match self.force {
            Force::Sine => "sin θ",
            Force::Linear => "θ",
            Force::Cubic => "(θ − θ³/6)",
            Force::Cosine => "cos θ",
            Force::SineCosine => "sin θ cos θ",
            Force::Degrees => "sin(πθ/180)",
        };
        write!(f, "θ̈ = −k {force}")?;
        if self.damping.is_some() {
            f.write_str(" − c ω")?;
        }
        if self.drive.is_some() {
            f.write_str(" + A cos(Ωt + φ)")?;
        }
        write!(f, ", k = {} /s²", Within(&self.k))?;
        meant(f, &self.k)?;
        if let Some(damping) = &self.damping {
            write!(f, ", c = {} /s", Within(damping))?;
            meant(f, damping)?;
        }
        if let Some([a, frequency, phase]) = &self.drive {
            write!(f, ", A = {} /s²", Within(a))?;
            write!(f, ", Ω = {} /s, φ = {}", Within(frequency), Within(phase))?;
        }
        Ok(())
    }
}

/// The short number that is within.
fn meant(f: &mut fmt::Formatter<'_>, known: &Known) -> fmt::Result {
    let short = plain(known.short, 6);
    if short.len() <= 6 && known.known_to > 0.0 { write!(f, " ({short}?)") } else { Ok(()) }
}

/// The name that people have for a method of the known answers.
fn title(name: &str) -> String {
    let known = known_answers::method(name);
    let also = known.and_then(|known| known.also.first());
    also.map_or_else(|| name.to_string(), |also| format!("{name} ({also})"))
}

struct Named<'a>(&'a Made);

impl fmt::Display for Named<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Made { name, mistake, steps, step, .. } = self.0;
        match mistake {
            Some([of, what, effect]) => write!(f, "{of} with a mistake: {what} ({effect})")?,
            None => f.write_str(&title(name))?,
        }
        let step = plain(*step, 9);
        match steps {
            1 => write!(f, ", a step of {step} s for each row"),
            steps => write!(f, ", {steps} steps of {step} s for each row"),
        }
    }
}

struct Says<'a>(&'a RunReport);

impl fmt::Display for Says<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (compared, pairs) = self.0.compared;
        match &self.0.maker {
            Maker::Method(made) => {
                write!(f, "{}. ", Named(made))?;
                let all = if compared == pairs { "All" } else { "Of" };
                write!(f, "{all} {pairs} pairs of rows")?;
                if compared < pairs {
                    write!(f, " {compared}, evenly spread, were compared and")?;
                }
                f.write_str(
                    " agree within their digits, and every other known method is ten times as far \
                     off, or more.",
                )?;
                let mut names: Vec<&str> = Vec::new();
                for (name, _) in &made.same {
                    if *name != made.name && !names.contains(&name.as_str()) {
                        names.push(name);
                    }
                }
                if names.is_empty() {
                    return Ok(());
                }
                write!(f, " The same rows, with another k perhaps: {}.", names.join(", "))
            }
            Maker::OneOf { methods, count, exact, by } => {
                if *exact {
                    f.write_str(
                        "It cannot be told: the exact motion has these rows, and so has every \
                         method that is accurate enough",
                    )?;
                    if let Some(first) = methods.first() {
                        write!(f, ", such as {}", Named(first))?;
                    }
                    f.write_str(".")?;
                } else {
                    writeln!(f, "one of these {count}, or one that is as near:")?;
                    for made in methods {
                        writeln!(f, "    {}", Named(made))?;
                    }
                    f.write_str("   ")?;
                }
                let by: Vec<_> = by
                    .iter()
                    .map(|by| match by {
                        Distinguish::Velocity => "the velocity beside the angle",
                        Distinguish::Digits => "more digits",
                        Distinguish::LongerStep => "longer steps, each in a row",
                        Distinguish::Rows => "more rows",
                    })
                    .collect();
                write!(f, " What would tell them apart: {}.", by.join(", "))
            }
            Maker::Measured { noise } => write!(
                f,
                "none: there is noise of {} rad in the angles, so the rows are measured, or noise \
                 was added. No program's steps have it.",
                Scientific(*noise, 1)
            ),
            Maker::Unknown { nearest, exact } => {
                f.write_str("none that is known. ")?;
                match nearest {
                    Some((name, off)) if off.is_finite() => write!(
                        f,
                        "The nearest, {name}, is off by {} times what rounding does, the exact \
                         motion by {}.",
                        Scientific(*off, 0),
                        Scientific(*exact, 0)
                    ),
                    _ => write!(
                        f,
                        "The exact motion is off by {} times what rounding does.",
                        Scientific(*exact, 0)
                    ),
                }
            }
            Maker::NoPendulum => f.write_str(
                "none: no equation of a pendulum, damped or driven or neither, leads from row to \
                 row.",
            ),
        }
    }
}

impl fmt::Display for AtTheEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { angle, energy, others, time } = self;
        write!(
            f,
            "after {} s the angle is off by {} rad from the exact motion of this equation",
            plain(*time, 6),
            Scientific(*angle, 1)
        )?;
        if let Some(energy) = energy {
            write!(f, ", the energy by {} of itself", Scientific(*energy, 1))?;
        }
        f.write_str(".")?;
        let others = others.iter().map(|(name, off)| format!("{name} {} rad", Scientific(*off, 1)));
        let others: Vec<_> = others.collect();
        if others.is_empty() {
            return Ok(());
        }
        write!(f, " With the same steps: {}.", others.join(", "))
    }
}
