//! The state of an interrupted run: what it takes to resume it with the same bits.
//!
//! A state is a text: a line that names the version, JSON, and a line with the SHA-256 of all
//! before it. The arguments in it are those of the command line, with every default filled in, each
//! number in the shortest form that reads back to the same f64; numbers that no user typed are the
//! 16 hexadecimal digits of their bits.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::io::Write;
use std::num::NonZeroU64;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use clap::{Args, ValueEnum};
use serde::de::{DeserializeOwned, Error as _};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use sha2::{Digest, Sha256};

use super::destination::Destination;
use super::rows::{RowFormat, Rows};
use crate::failure::Failure;
use crate::files::kept;
use crate::sweep::part::Part;
use crate::sweep::range::Sweep;

/// Where a run is kept when it is interrupted, and whence it is resumed.
#[derive(Args, Debug)]
pub struct KeptArguments {
    /// Write to this file, which appears only when it is whole; if the run is interrupted,
    /// FILE.state and FILE.partial keep what it takes to resume it
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Without --output: the file that keeps the state if the run is interrupted
    #[arg(long, value_name = "FILE", conflicts_with = "output")]
    state: Option<PathBuf>,
    /// Resume the run whose state this file keeps; all other arguments are in it, and may be left
    /// out
    #[arg(long, value_name = "STATE", conflicts_with = "plot")]
    resume: Option<PathBuf>,
}

const FIRST_LINE: &str = "pendula state 1";
const FAMILY: &str = "pendula state ";
const LAST_LINE: &str = "sha256 ";

/// The state of a run of a `command`.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct State<P> {
    command: String,
    arguments: BTreeMap<String, String>,
    /// Rows printed.
    rows: u64,
    /// The length of FILE.partial, if the rows go to a file.
    bytes: Option<u64>,
    /// How far it has come.
    progress: P,
}

impl<P: Serialize> State<P> {
    fn text(&self) -> String {
        let json = serde_json::to_string_pretty(self).expect("a state is maps, texts and integers");
        let text = format!("{FIRST_LINE}\n{json}\n");
        let sum = digest(&text);
        format!("{text}{LAST_LINE}{sum}\n")
    }
}

impl<P: DeserializeOwned + Serialize> State<P> {
    fn parse(text: &str, command: &str) -> Result<Self, String> {
        let first = text.lines().next().unwrap_or_default();
        if first != FIRST_LINE {
            return Err(match first.strip_prefix(FAMILY) {
                Some(version) => {
                    format!("it is of version {version:?}, and this program reads version 1")
                }
                None => format!("it does not begin with `{FIRST_LINE}`, as a state does"),
            });
        }
        let broken = || "it is not as it was written: its checksum differs".to_owned();
        let end = text.rfind(LAST_LINE).ok_or_else(broken)?;
        let (body, sum) = text.split_at(end);
        if sum != format!("{LAST_LINE}{}\n", digest(body)) {
            return Err(broken());
        }
        let json = &body[FIRST_LINE.len()..];
        let of: Command = serde_json::from_str(json).map_err(|error| error.to_string())?;
        if of.command != command {
            return Err(format!("it is one of `pendula {}`", of.command));
        }
        let state: Self = serde_json::from_str(json).map_err(|error| error.to_string())?;
        // Of an argument that is there twice JSON keeps the second.
        if state.text() == text { Ok(state) } else { Err("it is not as it is written".to_owned()) }
    }
}

/// The part of a state that says how to read the rest.
#[derive(Deserialize)]
struct Command {
    command: String,
}

fn digest(text: &str) -> String {
    Sha256::digest(text).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The bits of a number, as 16 hexadecimal digits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bits(pub f64);

impl Serialize for Bits {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&format!("{:016x}", self.0.to_bits()))
    }
}

impl<'de> Deserialize<'de> for Bits {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        let digits = text.len() == 16 && !text.starts_with('+');
        let bits = u64::from_str_radix(&text, 16).ok().filter(|_| digits);
        let bits = bits.ok_or_else(|| D::Error::custom("bits are 16 hexadecimal digits"))?;
        Ok(Self(f64::from_bits(bits)))
    }
}

/// An argument that a state keeps as a text.
pub trait Argument: FromStr {
    /// The text, which reads back to the same value.
    fn text(&self) -> String;
}

impl Argument for f64 {
    fn text(&self) -> String {
        format!("{self:?}")
    }
}

impl Argument for u64 {
    fn text(&self) -> String {
        self.to_string()
    }
}

impl Argument for NonZeroU64 {
    fn text(&self) -> String {
        self.to_string()
    }
}

impl Argument for String {
    fn text(&self) -> String {
        self.clone()
    }
}

impl Argument for Sweep {
    fn text(&self) -> String {
        self.to_string()
    }
}

impl Argument for Part {
    fn text(&self) -> String {
        self.to_string()
    }
}

impl FromStr for RowFormat {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        <Self as ValueEnum>::from_str(text, false)
    }
}

impl Argument for RowFormat {
    fn text(&self) -> String {
        match self {
            Self::Csv => "csv".to_owned(),
            Self::Json => "json".to_owned(),
        }
    }
}

/// A run that can be kept: its arguments, those given completed by those of the state it is resumed
/// from, and the files that keep it.
#[derive(Debug)]
pub struct Kept<P> {
    command: &'static str,
    from: Option<(PathBuf, State<P>)>,
    arguments: BTreeMap<String, String>,
    output: Option<PathBuf>,
    state: Option<PathBuf>,
}

impl<P: DeserializeOwned + Serialize> Kept<P> {
    /// A run of `command`, with the state that it is resumed from, if it is.
    ///
    /// # Errors
    /// [`Failure::Refused`] if the state cannot be read, or contradicts where the output is to go.
    pub fn new(command: &'static str, given: &KeptArguments) -> Result<Self, Failure> {
        let (mut output, mut state) = (given.output.clone(), given.state.clone());
        let mut from = None;
        if let Some(path) = &given.resume {
            let text = kept::read(path).map_err(|error| refused(path, error))?;
            let found = State::parse(&text, command).map_err(|why| refused(path, why))?;
            if found.bytes.is_some() {
                let file = file_of(path).ok_or_else(|| {
                    refused(path, "its rows are beside it, and it must be named FILE.state")
                })?;
                let other = output.replace(file.clone());
                if other.is_some_and(|o| o != file && !kept::same(&kept::beside(&o, "state"), path))
                {
                    let file = file.display();
                    return Err(refused(path, format!("its --output is {file} and no other")));
                }
                if state.is_some() {
                    return Err(refused(path, "its rows go to a file, and its state stays here"));
                }
            } else if output.is_some() {
                return Err(refused(
                    path,
                    "its rows go to standard output, and --output cannot be used with it",
                ));
            } else {
                state.get_or_insert_with(|| path.clone());
            }
            from = Some((path.clone(), found));
        }
        Ok(Self { command, from, arguments: BTreeMap::new(), output, state })
    }

    /// The argument `--name`: the one `given`, or that of the state, or else the `default`.
    ///
    /// # Errors
    /// [`Failure::Refused`] if the argument given is not that of the state; if there is none.
    pub fn argument<T: Argument>(
        &mut self,
        name: &'static str,
        given: Option<T>,
        default: Option<T>,
    ) -> Result<T, Failure> {
        let value = match &self.from {
            None => given.or(default).ok_or_else(|| {
                Failure::refused(format!("--{name} is missing; only a --resume can do without"))
            })?,
            Some((path, state)) => {
                let text = state.arguments.get(name);
                let stored = text.and_then(|text| Some((text, text.parse::<T>().ok()?)));
                let Some((text, stored)) = stored else {
                    return Err(refused(path, format!("it has no --{name}")));
                };
                if let Some(given) = given.filter(|given| given.text() != stored.text()) {
                    let given = given.text();
                    return Err(refused(
                        path,
                        format!("its --{name} is {text}, and {given} contradicts it"),
                    ));
                }
                stored
            }
        };
        self.arguments.insert(name.to_owned(), value.text());
        Ok(value)
    }

    /// The argument `--name` that not every run has: the one `given`, or that of the state.
    ///
    /// # Errors
    /// As [`argument`](Self::argument); if it is given, and the state has none.
    pub fn optional<T: Argument>(
        &mut self,
        name: &'static str,
        given: Option<T>,
    ) -> Result<Option<T>, Failure> {
        let stored = self.from.as_ref().map(|(path, state)| (path, state.arguments.get(name)));
        match (stored, given) {
            (Some((path, None)), Some(given)) => {
                let given = given.text();
                Err(refused(path, format!("it has no --{name}, and {given} contradicts that")))
            }
            (None | Some((_, None)), None) => Ok(None),
            (_, given) => self.argument(name, given, None).map(Some),
        }
    }

    /// What the run is resumed from, after all arguments have been asked for: the rows printed, and
    /// how far it has come.
    ///
    /// # Errors
    /// [`Failure::Refused`] if the state has an argument that nobody asked for.
    pub fn resumed(&self) -> Result<Option<(u64, &P)>, Failure> {
        let Some((path, state)) = &self.from else { return Ok(None) };
        match state.arguments.keys().find(|name| !self.arguments.contains_key(*name)) {
            Some(name) => Err(refused(path, format!("there is no --{name}"))),
            None => Ok(Some((state.rows, &state.progress))),
        }
    }

    /// The refusal of the state that the run is resumed from, because of `why`.
    pub fn refused(&self, why: impl Display) -> Failure {
        match &self.from {
            Some((path, _)) => refused(path, why),
            None => Failure::refused(why),
        }
    }

    /// Opens the output for rows: `out`, or the file, with the rows so far, of which there are
    /// `printed`.
    ///
    /// # Errors
    /// [`Failure::Refused`] if it cannot be written, or the rows so far are not there.
    pub fn open<'a, const N: usize>(
        &self,
        out: &'a mut dyn Write,
        format: RowFormat,
        columns: [&'static str; N],
        printed: Option<u64>,
    ) -> Result<Rows<Destination<'a>, N>, Failure> {
        let mut destination = Destination::open(self.output.as_deref(), out)?;
        if let (Some(file), Some((path, state))) = (&self.output, &self.from) {
            if !destination.appears_whole() {
                return Err(refused(path, format!("{} is not a file", file.display())));
            }
            let bytes = state.bytes.unwrap_or(0);
            kept::copy(&kept::beside(file, "partial"), bytes, &mut destination)
                .map_err(|error| refused(path, format!("{error:#}")))?;
            return Ok(Rows::resume(destination, format, columns, state.rows));
        }
        match printed {
            Some(rows) => Ok(Rows::begin_again(destination, format, columns, rows)?),
            None => Ok(Rows::begin(destination, format, columns)?),
        }
    }

    /// Leaves the run: keeps the rows so far and its state, and returns the failure that says so;
    /// `stands` says where it stands.
    ///
    /// # Errors
    /// If that fails.
    pub fn leave<const N: usize>(
        self,
        rows: Rows<Destination<'_>, N>,
        progress: P,
        stands: &str,
    ) -> Result<Failure, Failure> {
        let printed = rows.rows();
        let (state, bytes) = match &self.output {
            Some(file) if rows.writer().appears_whole() => {
                // The rows first: to a state of before, they are more than it asks for.
                let bytes = rows.into_writer().leave(&kept::beside(file, "partial"))?;
                (Some(kept::beside(file, "state")), Some(bytes))
            }
            _ => {
                rows.end()?.finish()?;
                (self.state, None)
            }
        };
        let Some(path) = state else {
            return Ok(Failure::Failed(anyhow::anyhow!(
                "interrupted {stands}; with --output FILE or --state FILE it could have been \
                 resumed"
            )));
        };
        let command = self.command;
        let (command_name, arguments) = (command.to_owned(), self.arguments);
        let state = State { command: command_name, arguments, rows: printed, bytes, progress };
        kept::write(&path, &state.text())?;
        let path = path.display();
        Ok(Failure::Failed(anyhow::anyhow!(
            "interrupted {stands}; `pendula {command} --resume {path}` goes on from there"
        )))
    }

    /// The run has come to its end: its output is finished, and what was kept of it is removed.
    ///
    /// # Errors
    /// If that fails.
    pub fn finish<const N: usize>(self, rows: Rows<Destination<'_>, N>) -> Result<(), Failure> {
        rows.end()?.finish()?;
        if let Some((path, state)) = &self.from {
            if let (Some(file), Some(_)) = (&self.output, state.bytes) {
                kept::remove(&kept::beside(file, "partial"))?;
            }
            kept::remove(path)?;
        }
        Ok(())
    }
}

/// FILE, if `path` is FILE.state.
fn file_of(path: &Path) -> Option<PathBuf> {
    let is_state = path.extension()? == "state";
    is_state.then(|| path.with_extension(""))
}

fn refused(path: &Path, why: impl Display) -> Failure {
    Failure::refused(format!("--resume {}: {why}", path.display()))
}
