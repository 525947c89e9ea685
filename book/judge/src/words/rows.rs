//! The words for what is found in the rows of a run.

use core::fmt::{self, Write as _};

use super::numbers::{Scientific, plain};
use crate::known_answers;
use crate::rows::{
    AGREES, AtTheEnd, Digits, Distinguish, Fault, Force, FoundEquation, Known, Made, Maker, Read,
    Refusal, RunReport, Unit,
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
        for [what, words] in &self.said(title)[1..] {
            writeln!(f, "{:14} {words}", format!("{what}:"))?;
        }
        Ok(())
    }
}

impl RunReport {
    /// What is said, each under its heading; `title` says what a method is called.
    pub fn said(&self, title: fn(&str) -> String) -> Vec<[String; 2]> {
        let mut said = vec![["What was read".to_string(), self.read.to_string()]];
        if let Some(equation) = &self.equation {
            said.push(["The equation".to_string(), equation.to_string()]);
        }
        said.push(["The method".to_string(), Says(self, title).to_string()]);
        if let Some(end) = &self.end {
            said.push(["What follows".to_string(), end.to_string()]);
        }
        said
    }
}

impl fmt::Display for Read {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let column = |f: &mut fmt::Formatter<'_>, used: &crate::rows::Used| {
            match used.heading.as_str() {
                "" => write!(f, "column {}", used.column)?,
                heading => quoted(f, heading)?,
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
            Self::TimeRepeated { row } => write!(f, "Row {row} has the time of the row before."),
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
            Self::Uneven => {
                f.write_str("The times are uneven: no steps of one length lead from row to row.")
            }
        }
    }
}

/// A heading in quotation marks, with an escape for what would move the cursor, hide what stands
/// beside it or turn it around.
///
/// Not as `Debug` has it, whose tables of letters are some kilobytes, which the page would carry.
fn quoted(f: &mut fmt::Formatter<'_>, heading: &str) -> fmt::Result {
    f.write_str("\"")?;
    for c in heading.chars() {
        match c {
            '"' | '\\' => write!(f, "\\{c}")?,
            '\0'..' ' | '\u{7f}'..'\u{a0}' => write!(f, "{}", c.escape_unicode())?,
            '\u{ad}'
            | '\u{61c}'
            | '\u{200b}'..='\u{200f}'
            | '\u{2028}'..='\u{202e}'
            | '\u{2060}'..='\u{206f}'
            | '\u{e000}'..='\u{f8ff}'
            | '\u{feff}'
            | '\u{fff0}'..='\u{fffb}'
            | '\u{e0000}'.. => write!(f, "{}", c.escape_unicode())?,
            c => f.write_char(c)?,
        }
    }
    f.write_str("\"")
}

/// A number with its uncertainty: "9.8000 ± 0.0004".
struct Within<'a>(&'a Known);

impl fmt::Display for Within<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Known { value, known_to, .. } = *self.0;
        if !known_to.is_finite() {
            return write!(f, "about {}", Scientific(value, 1));
        }
        if known_to <= 0.0 {
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
    if short.len() <= 6 && known.known_to > 0.0 && known.known_to.is_finite() {
        write!(f, " ({short}?)")
    } else {
        Ok(())
    }
}

/// What people call a method of the known answers, or what is wrong in a mistake.
pub fn title(name: &str) -> String {
    let mistake = known_answers::mistakes().iter().find(|known| known.name == name);
    if let Some(wrong) = mistake.and_then(|known| known.mistake.as_ref()) {
        return format!("{} with a mistake: {} ({})", wrong.of, wrong.what, wrong.effect);
    }
    let known = known_answers::method(name);
    let also = known.and_then(|known| known.also.first());
    also.map_or_else(|| name.to_string(), |also| format!("{name} ({also})"))
}

/// What a name is called.
type Title = fn(&str) -> String;

struct Named<'a>(&'a Made, Title);

impl fmt::Display for Named<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Made { name, steps, step, .. } = self.0;
        f.write_str(&self.1(name))?;
        let step = plain(*step, 9);
        match steps {
            1 => write!(f, ", a step of {step} s for each row"),
            steps => write!(f, ", {steps} steps of {step} s for each row"),
        }
    }
}

/// What would tell methods apart.
struct Told<'a>(&'a [Distinguish]);

impl fmt::Display for Told<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let by = self.0.iter().map(|by| match by {
            Distinguish::Velocity => "the velocity beside the angle",
            Distinguish::Digits => "more digits",
            Distinguish::LongerStep => "longer steps, each in a row",
            Distinguish::Rows => "more rows",
        });
        write!(f, "What would tell them apart: {}.", by.collect::<Vec<_>>().join(", "))
    }
}

/// So many are listed in full of methods that cannot be told apart.
const MOST_LISTED: usize = 6;

struct Says<'a>(&'a RunReport, Title);

impl fmt::Display for Says<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (compared, pairs) = self.0.compared;
        match &self.0.maker {
            Maker::Method(made) => {
                write!(f, "{}. ", Named(made, self.1))?;
                let all = if compared == pairs { "All" } else { "Of" };
                write!(f, "{all} {pairs} pairs of rows")?;
                if compared < pairs {
                    write!(f, " {compared}, evenly spread, were compared and")?;
                }
                f.write_str(
                    " agree within their digits, and every other known method is ten times as far \
                     off, or more (methods of several steps are looked for with a row for each \
                     step).",
                )?;
                let mut names: Vec<&str> = Vec::new();
                for (name, _) in &made.same {
                    if *name != made.name && !names.contains(name) {
                        names.push(name);
                    }
                }
                if names.is_empty() {
                    return Ok(());
                }
                write!(f, " The same rows, with another k perhaps: {}.", names.join(", "))
            }
            Maker::Several { methods, exact: Some(off), by } => {
                f.write_str("it cannot be told: the exact motion ")?;
                match off {
                    off if *off <= AGREES => f.write_str(
                        "has these rows, and so has every method that is accurate enough",
                    )?,
                    off => write!(
                        f,
                        "is off by {} times what rounding does, not by ten times, so each method \
                         that is accurate enough may have made them",
                        plain(*off, 1)
                    )?,
                }
                if let Some(first) = methods.first() {
                    write!(f, ", such as {}", Named(first, self.1))?;
                    f.write_str(" (an example: another may have made them)")?;
                }
                f.write_str(
                    ". The k above is the motion's; a program's own may differ from it, as",
                )?;
                write!(f, " its method changes the period. {}", Told(by))
            }
            Maker::Several { methods, exact: None, by } => {
                f.write_str(
                    "it cannot be told: several methods have these rows, or nearly. Some are \
                     below, and another may have made them:\n",
                )?;
                let own = methods.first().map(|first| first.equation.k);
                for made in methods.iter().take(MOST_LISTED) {
                    write!(f, "    {}", Named(made, self.1))?;
                    let k = made.equation.k;
                    let other = own.is_some_and(|own| (own.value - k.value).abs() > own.known_to);
                    if other {
                        write!(f, ", k = {} /s²", Within(&k))?;
                    }
                    if !made.same.is_empty() {
                        let names: Vec<&str> = made.same.iter().map(|(name, _)| *name).collect();
                        write!(f, " (the same rows: {})", names.join(", "))?;
                    }
                    f.write_str("\n")?;
                }
                write!(f, "    {}", Told(by))
            }
            Maker::Measured { noise } => write!(
                f,
                "none with steps of one length: there is noise of {} rad in the angles, as \
                 measured rows have it. (A solver that chooses its steps and interpolates leaves \
                 something like it, and so does noise that was added.)",
                Scientific(*noise, 1)
            ),
            Maker::Unknown { nearest, exact, equation } => {
                f.write_str(if self.0.faults.contains(&Fault::Uneven) {
                    "not looked for, as the rows are not evenly spaced. "
                } else {
                    "none was found among the known ones that were looked at. "
                })?;
                match nearest {
                    Some((name, off)) if off.is_finite() => write!(
                        f,
                        "The nearest that was looked at, {name}, is off by {} times what rounding \
                         does, the exact motion by {}.",
                        Scientific(*off, 0),
                        Scientific(*exact, 0)
                    ),
                    _ => write!(
                        f,
                        "The exact motion is off by {} times what rounding does.",
                        Scientific(*exact, 0)
                    ),
                }?;
                write!(
                    f,
                    " Of the equations that were tried {equation} is the nearest; but an unknown \
                     method's error may look like another force, a drag or another k, so none of \
                     its numbers is certain."
                )
            }
            Maker::NoPendulum => f.write_str(
                "not found: no equation of a pendulum, damped or driven or neither, was found that \
                 leads from row to row.",
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
