//! The state of an interrupted run: what it takes to resume it with the same bits.
//!
//! A state is one file: the rows so far, as they stand in the output; a line of JSON with the
//! version of the program, the words of the command line and how far the run has come; and a last
//! line with the number of bytes of the rows and the SHA-256 of all before it. So no rows are ever
//! continued that are not those of the run.

use std::ffi::OsString;
use std::fmt::Display;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::{ArgMatches, Args};
use serde::de::{DeserializeOwned, Error as _};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::Value;

use super::destination::{Destination, Summed};
use super::rows::{RowFormat, Rows};
use pendula_output::failure::Failure;
use pendula_output::files;
use pendula_output::files::whole_file::WholeFile;

/// Where a run is kept when it is interrupted, and whence it is resumed.
#[derive(Args, Debug)]
pub struct KeptArguments {
    /// Write to this file, which appears only when it is whole; if the run is interrupted,
    /// FILE.state keeps what it takes to resume it
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Without --output: the file that keeps the state if the run is interrupted
    #[arg(long, value_name = "FILE", conflicts_with_all = ["output", "plot"])]
    state: Option<PathBuf>,
    /// Resume the run whose state this file keeps, with all its arguments
    // Of the groups of which one has to be given, it is one.
    #[arg(long, value_name = "STATE", exclusive = true, groups = ["extent", "stepping"])]
    resume: Option<PathBuf>,
    /// What the command line was, for the state.
    #[arg(skip)]
    pub words: Vec<OsString>,
    /// What the run is resumed from.
    #[arg(skip)]
    pub from: Option<Resumed>,
}

/// The file that the command line asks to resume from.
pub fn asked_for(command: &ArgMatches) -> Option<&PathBuf> {
    command.try_get_one("resume").ok().flatten()
}

/// All of a state but its rows.
#[derive(Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct State {
    version: String,
    arguments: Vec<String>,
    /// Rows printed.
    rows: u64,
    /// Whether they go to a file, and so are here.
    to_file: bool,
    /// How far the run has come.
    progress: Value,
}

/// A state, and where it is.
#[derive(Debug)]
pub struct Resumed {
    path: PathBuf,
    state: State,
    /// How many bytes its rows are.
    bytes: u64,
}

impl Resumed {
    /// Reads the state of a run of `command`.
    ///
    /// # Errors
    /// [`Failure::Refused`] if it cannot be read, is not as it was written, or is of another
    /// command or another version of the program.
    pub fn read(path: &Path, command: &str) -> Result<Self, Failure> {
        let (json, bytes) = read(path).map_err(|error| match error.kind() {
            io::ErrorKind::InvalidData => refused(path, error),
            _ => refused(path, format!("cannot be read: {error}")),
        })?;
        let state: State = serde_json::from_str(&json).map_err(|error| refused(path, error))?;
        if state.version != VERSION {
            let version = state.version.escape_debug();
            let why = format!("it is of version {version} of this program, which is {VERSION}");
            return Err(refused(path, why));
        }
        if state.arguments.first().is_none_or(|of| of != command) {
            let of = state.arguments.first().map_or("", String::as_str).escape_debug();
            return Err(refused(path, format!("it is one of `pendula {of}`")));
        }
        // A link is the state that it leads to.
        let path = match path.is_symlink() {
            true => files::behind_links(path).map_err(|error| refused(path, error))?,
            false => path.to_path_buf(),
        };
        Ok(Self { path, state, bytes })
    }

    /// The words of the command line that the run was begun with.
    pub fn arguments(&self) -> &[String] {
        &self.state.arguments
    }
}

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// The JSON of a state and the number of bytes before it.
fn read(path: &Path) -> io::Result<(String, u64)> {
    /// More than the arguments that a process can have.
    const LONGEST: u64 = 1 << 24;
    let wrong = |why: &str| io::Error::new(io::ErrorKind::InvalidData, why);
    if files::metadata(path)?.is_some_and(|found| !found.is_file()) {
        return Err(wrong("it is not a file"));
    }
    let mut file = File::open(path)?;
    let all = file.seek(SeekFrom::End(0))?;
    file.seek(SeekFrom::Start(all.saturating_sub(200)))?;
    let mut end = Vec::new();
    (&mut file).take(200).read_to_end(&mut end)?;
    let end = String::from_utf8_lossy(&end);
    let last = end.strip_suffix('\n').map(|end| end.rsplit('\n').next().unwrap_or_default());
    let last = last.and_then(|last| last.strip_prefix("rows ")?.split_once(" sha256 "));
    let read = last.and_then(|(bytes, sum)| {
        let before = all.checked_sub((last_line(bytes).len() + sum.len() + 1) as u64)?;
        let bytes: u64 = bytes.parse().ok()?;
        Some((bytes, before.checked_sub(bytes)?, sum))
    });
    let Some((bytes, json, sum)) = read.filter(|(_, json, _)| *json < LONGEST) else {
        return Err(wrong("it does not end as a state does: is it one, and whole?"));
    };
    file.rewind()?;
    let mut summed = Summed::new(io::sink());
    io::copy(&mut (&mut file).take(all - (sum.len() + 1) as u64), &mut summed)?;
    if summed.sum() != sum {
        return Err(wrong("it is not as it was written: its checksum differs"));
    }
    file.seek(SeekFrom::Start(bytes))?;
    let mut text = String::new();
    file.take(json).read_to_string(&mut text)?;
    Ok((text, bytes))
}

/// The last line, up to the sum.
fn last_line(bytes: impl Display) -> String {
    format!("rows {bytes} sha256 ")
}

/// Writes the state behind the rows so far, and puts it at `path`.
fn write(mut file: Summed<WholeFile>, state: &State, path: &Path) -> anyhow::Result<()> {
    let bytes = file.bytes;
    let json = serde_json::to_string(state).expect("a state is texts and integers");
    file.write_all(format!("\n{json}\n{}", last_line(bytes)).as_bytes())?;
    let sum = file.sum();
    file.write_all(format!("{sum}\n").as_bytes())?;
    Ok(file.out.leave(path)?)
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
        let bits = u64::from_str_radix(&text, 16);
        bits.map(|bits| Self(f64::from_bits(bits)))
            .map_err(|_| D::Error::custom("bits are 16 hexadecimal digits"))
    }
}

/// A run that can be kept, and the files that keep it.
#[derive(Debug)]
pub struct Kept<'a> {
    given: &'a KeptArguments,
    output: Option<PathBuf>,
    /// Where its state goes if it is interrupted.
    state: Option<PathBuf>,
}

impl<'a> Kept<'a> {
    /// The run that was asked for.
    ///
    /// # Errors
    /// [`Failure::Refused`] if it is to begin anew where the state of another one lies.
    pub fn new(given: &'a KeptArguments) -> Result<Self, Failure> {
        if let Some(Resumed { path, state, .. }) = &given.from {
            let file = if state.to_file {
                let is_state = path.extension().is_some_and(|extension| extension == "state");
                let file = is_state.then(|| path.with_extension(""));
                let why = "its rows go to a file, and it must be named FILE.state";
                Some(file.ok_or_else(|| refused(path, why))?)
            } else {
                None
            };
            return Ok(Self { given, output: file, state: Some(path.clone()) });
        }
        // Where a link leads, so that what is renamed to it needs no other disk.
        let behind = |path: &Path| {
            let file = path.is_symlink().then(|| files::behind_links(path).ok()).flatten();
            file.unwrap_or_else(|| path.to_path_buf())
        };
        let output = given.output.clone();
        let mut state = given.state.as_deref().map(behind);
        if let Some(output) = &output {
            let mut name = behind(output).into_os_string();
            name.push(".state");
            state = Some(name.into());
        }
        if let Some(path) = &given.state {
            // Not only hours later.
            WholeFile::beside(path).map_err(|error| {
                Failure::refused(format!("--state {}: cannot be written: {error}", path.display()))
            })?;
        }
        if let Some(path) = state.as_ref().filter(|path| path.exists()) {
            let path = path.display();
            let command = given.words.first().map(|word| word.to_string_lossy());
            let command = command.unwrap_or_default();
            return Err(Failure::refused(format!(
                "{path} keeps a run that was interrupted: go on with `pendula {command} --resume \
                 {path}`, or remove it"
            )));
        }
        Ok(Self { given, output, state })
    }

    /// The file that the rows go to, if they do.
    pub fn output(&self) -> Option<&Path> {
        self.output.as_deref()
    }

    /// Whether it is resumed.
    pub const fn is_resumed(&self) -> bool {
        self.given.from.is_some()
    }

    /// What the run is resumed from, if it is: the rows printed, and how far it has come.
    ///
    /// # Errors
    /// [`Failure::Refused`] if the state is of another kind of run.
    pub fn resumed<P: DeserializeOwned>(&self) -> Result<Option<(u64, P)>, Failure> {
        let Some(Resumed { state, .. }) = &self.given.from else { return Ok(None) };
        match serde_json::from_value(state.progress.clone()) {
            Ok(progress) => Ok(Some((state.rows, progress))),
            Err(error) => Err(self.refused(error)),
        }
    }

    /// The refusal of the state that the run is resumed from, because of `why`.
    pub fn refused(&self, why: impl Display) -> Failure {
        match &self.given.from {
            Some(Resumed { path, .. }) => refused(path, why),
            None => Failure::refused(why),
        }
    }

    /// Opens the output for rows: `out`, or the file, with the rows so far. A run that is
    /// `headless` begins without a header.
    ///
    /// # Errors
    /// [`Failure::Refused`] if it cannot be written, or the rows so far cannot be read.
    pub fn open<'o, const N: usize>(
        &self,
        out: &'o mut dyn Write,
        format: RowFormat,
        columns: [&'static str; N],
        headless: bool,
    ) -> Result<Rows<Destination<'o>, N>, Failure> {
        let mut destination = Destination::open(self.output.as_deref(), out)?;
        match &self.given.from {
            Some(Resumed { path, state, bytes }) if state.to_file => {
                let file = File::open(path).map_err(|error| self.refused(error))?;
                if io::copy(&mut file.take(*bytes), &mut destination)? != *bytes {
                    return Err(self.refused("it has changed since it was read"));
                }
                Ok(Rows::resume(destination, format, columns, state.rows))
            }
            Some(Resumed { state, .. }) => {
                Ok(Rows::begin_again(destination, format, columns, state.rows)?)
            }
            None if headless => Ok(Rows::begin_again(destination, format, columns, 0)?),
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
        progress: &impl Serialize,
        stands: &str,
    ) -> Result<Failure, Failure> {
        let printed = rows.rows();
        let to_file = rows.writer().appears_whole();
        let file = if to_file {
            rows.into_writer().into_file()?
        } else {
            rows.end()?.finish()?;
            None
        };
        // To a device there are no rows that could be kept.
        let state = self.state.filter(|_| to_file || self.output.is_none());
        let Some(path) = state else {
            return Ok(Failure::Failed(anyhow::anyhow!(
                "interrupted {stands}; with --output FILE or --state FILE it could have been \
                 resumed"
            )));
        };
        // It was not there when this run began.
        if self.given.from.is_none() && path.exists() {
            return Ok(Failure::Failed(anyhow::anyhow!(
                "interrupted {stands}; {} keeps another run by now: this one cannot be resumed",
                path.display()
            )));
        }
        let progress = serde_json::to_value(progress).expect("a state is texts and integers");
        let arguments = match &self.given.from {
            Some(from) => from.state.arguments.clone(),
            // The names of files, the only words that may be no UTF-8, are not those of the state.
            None => self.given.words.iter().map(|w| w.to_string_lossy().into_owned()).collect(),
        };
        let command = arguments.first().cloned().unwrap_or_default();
        let version = VERSION.to_owned();
        let state = State { version, arguments, rows: printed, to_file, progress };
        let cannot = || format!("{} cannot be written", path.display());
        let file = match file {
            Some(file) => file,
            None => Summed::new(WholeFile::beside(&path).with_context(cannot)?),
        };
        write(file, &state, &path).with_context(cannot)?;
        let path = path.display();
        Ok(Failure::Failed(anyhow::anyhow!(
            "interrupted {stands}; `pendula {command} --resume {path}` goes on from there"
        )))
    }

    /// The run has come to its end: its output is finished, and its state is removed.
    ///
    /// # Errors
    /// If that fails.
    pub fn finish<const N: usize>(self, rows: Rows<Destination<'_>, N>) -> Result<(), Failure> {
        rows.end()?.finish()?;
        if let Some(Resumed { path, .. }) = &self.given.from {
            files::remove(path).with_context(|| format!("{} cannot be removed", path.display()))?;
        }
        Ok(())
    }
}

fn refused(path: &Path, why: impl Display) -> Failure {
    Failure::refused(format!("--resume {}: {why}", path.display()))
}
