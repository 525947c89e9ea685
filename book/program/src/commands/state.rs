//! The state of an interrupted run: what it takes to resume it with the same bits.
//!
//! A state is one file: the rows so far, as they stand in the output, and, as its last line, a
//! checksum over all else and JSON with the version of the program, the words of the command line
//! and how far the run has come. So no number that has changed on a disk goes on unnoticed.

use std::fmt::Display;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::{ArgMatches, Args};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::output::{Destination, RowFormat, Rows};
use super::plot::Drawing;
use pendula_output::failure::Failure;
use pendula_output::files;
use pendula_output::files::whole_file::WholeFile;
use pendula_output::interrupt::leaving;

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
    /// What the command line was, for the state. The names of files, the only words that may be no
    /// UTF-8, are not those of the state.
    #[arg(skip)]
    pub words: Vec<String>,
    /// What the run is resumed from.
    #[arg(skip)]
    pub from: Option<Resumed>,
}

impl KeptArguments {
    fn command(&self) -> &str {
        self.words.first().map_or("", String::as_str)
    }
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
    /// How many bytes stand before its last line: its rows, and the end of a line.
    bytes: u64,
}

impl Resumed {
    /// Reads the state of a run of this command. It is refused if it is none, or is of another
    /// version of the program or of another command.
    pub fn read(path: &Path, command: &str) -> Result<Self, Failure> {
        let cannot = |error: io::Error| refused(path, format!("cannot be read: {error}"));
        if files::metadata(path).map_err(cannot)?.is_some_and(|found| !found.is_file()) {
            return Err(refused(path, "it is not a file"));
        }
        let (line, bytes) = last_line(File::open(path).map_err(cannot)?).map_err(cannot)?;
        let sum_and_json = line.split_first_chunk().filter(|(sum, json)| {
            let rows = File::open(path).map(|file| file.take(bytes));
            rows.and_then(|rows| checksum(rows, json)).is_ok_and(|right| right.as_bytes() == *sum)
        });
        let Some((_, json)): Option<(&[u8; SUM], _)> = sum_and_json else {
            return Err(refused(path, "it is no state, or not as it was written"));
        };
        let state: State = serde_json::from_slice(json)
            .map_err(|error| refused(path, format!("its state cannot be read: {error}")))?;
        if state.version != VERSION {
            let version = state.version.escape_debug();
            let why = format!("it is of version {version} of this program, which is {VERSION}");
            return Err(refused(path, why));
        }
        match state.arguments.first() {
            Some(of) if of == command => Ok(Self { path: behind(path), state, bytes }),
            of => {
                let of = of.map_or("", String::as_str).escape_debug();
                Err(refused(path, format!("it is of a run of `pendula {of}`")))
            }
        }
    }

    /// The words of the command line that the run was begun with.
    pub fn arguments(&self) -> &[String] {
        &self.state.arguments
    }
}

const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Characters of a checksum.
const SUM: usize = 8;

/// The checksum over the rows and the JSON of a state: CRC-32, which notices each change within
/// four bytes.
fn checksum(rows: impl Read, json: &[u8]) -> io::Result<String> {
    let (mut rows, mut sum) = (BufReader::new(rows), crc32fast::Hasher::new());
    loop {
        let block = rows.fill_buf()?;
        if block.is_empty() {
            sum.update(json);
            return Ok(format!("{:08x}", sum.finalize()));
        }
        sum.update(block);
        let read = block.len();
        rows.consume(read);
    }
}

/// The last line of a file, without its end, and how many bytes stand before it.
fn last_line(file: File) -> io::Result<(Vec<u8>, u64)> {
    let (mut file, mut last, mut bytes) = (BufReader::new(file), Vec::new(), 0);
    loop {
        let mut line = Vec::new();
        if file.read_until(b'\n', &mut line)? == 0 {
            last.pop_if(|byte| *byte == b'\n');
            return Ok((last, bytes));
        }
        bytes += last.len() as u64;
        last = line;
    }
}

/// Where a link leads, so that what is renamed to it needs no other disk.
fn behind(path: &Path) -> PathBuf {
    let file = path.is_symlink().then(|| files::behind_links(path).ok()).flatten();
    file.unwrap_or_else(|| path.to_path_buf())
}

/// A run that can be kept, and the files that keep it.
#[derive(Debug)]
pub struct Kept<'a> {
    given: &'a KeptArguments,
    output: Option<PathBuf>,
    /// Where its state goes if it is interrupted.
    state: Option<PathBuf>,
    /// The state to be, of a run whose rows go to no file: they are in it otherwise.
    file: Option<WholeFile>,
}

impl<'a> Kept<'a> {
    /// The run that was asked for. It is refused to begin anew where the state of another one lies.
    pub fn new(given: &'a KeptArguments) -> Result<Self, Failure> {
        if let Some(Resumed { path, state, .. }) = &given.from {
            let is_state = path.extension().is_some_and(|extension| extension == "state");
            if state.to_file && !is_state {
                let why = "its rows go to a file, and it must be named FILE.state";
                return Err(refused(path, why));
            }
            let output = state.to_file.then(|| path.with_extension(""));
            return Ok(Self { given, output, state: Some(path.clone()), file: None });
        }
        let output = given.output.clone();
        let state = match &output {
            Some(output) => {
                let mut name = behind(output).into_os_string();
                name.push(".state");
                Some(name.into())
            }
            None => given.state.as_deref().map(behind),
        };
        if let Some(path) = state.as_ref().filter(|path| path.exists()) {
            let (path, command) = (path.display(), given.command());
            return Err(Failure::refused(format!(
                "{path} keeps a run that was interrupted: go on with `pendula {command} --resume \
                 {path}`, or remove it"
            )));
        }
        Ok(Self { given, output, state, file: None })
    }

    /// What the run is resumed from, if it is: the rows printed, and how far it has come.
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

    /// Opens the output for rows: `out`, or the file, with the rows so far; and their plot. A run
    /// that is `headless` begins without a header.
    pub fn open<'o, const N: usize>(
        &mut self,
        out: &'o mut dyn Write,
        plot: Drawing<'_>,
        format: RowFormat,
        columns: [&'static str; N],
        headless: bool,
    ) -> Result<Rows<'o, N>, Failure> {
        let (plot, out) = match &self.given.from {
            // Half a plot is none.
            Some(_) => (None, Destination::Caller(out)),
            None => plot.begin(out)?,
        };
        if let (Some(path), None) = (&self.state, &self.output) {
            // Not only hours later.
            let file = WholeFile::beside(path).map_err(|error| {
                Failure::refused(format!("--state {}: cannot be written: {error}", path.display()))
            })?;
            self.file = Some(file);
        }
        let mut out = Destination::open(self.output.as_deref(), out)?;
        let Some(Resumed { path, state, bytes }) = &self.given.from else {
            let mut rows = Rows::new(out, plot, format, columns, 0);
            rows.begin(!headless)?;
            return Ok(rows);
        };
        if state.to_file {
            let file = File::open(path).map_err(|error| self.refused(error))?;
            io::copy(&mut file.take(bytes.saturating_sub(1)), &mut out)?;
            return Ok(Rows::new(out, plot, format, columns, state.rows));
        }
        let mut rows = Rows::new(out, plot, format, columns, state.rows);
        rows.begin(false)?;
        Ok(rows)
    }

    /// Leaves the run: keeps the rows so far and its state, and returns the failure that says so;
    /// `stands` says where it stands.
    pub fn leave<const N: usize>(
        self,
        rows: Rows<'_, N>,
        progress: &impl Serialize,
        stands: &str,
    ) -> Result<Failure, Failure> {
        let printed = rows.rows();
        let file = rows.leave()?;
        let to_file = file.is_some();
        // To a device there are no rows that could be kept.
        let (Some(path), Some(mut file)) = (self.state, file.or(self.file)) else {
            return Ok(Failure::Failed(anyhow::anyhow!(
                "interrupted {stands}; with --output FILE or --state FILE it could have been \
                 resumed"
            )));
        };
        leaving();
        let progress = serde_json::to_value(progress).expect("a state is texts and numbers");
        let (version, arguments) = (VERSION.to_owned(), self.given.words.clone());
        let state = State { version, arguments, rows: printed, to_file, progress };
        let json = serde_json::to_string(&state).expect("a state is texts and numbers");
        let written = file.write_all(b"\n");
        let written = written.and_then(|()| checksum(file.reopen()?, json.as_bytes()));
        let written = written.and_then(|sum| file.write_all(format!("{sum}{json}\n").as_bytes()));
        let written = written.and_then(|()| file.leave(&path));
        let (path, command) = (path.display(), self.given.command());
        written.with_context(|| format!("{path} cannot be written"))?;
        Ok(Failure::Failed(anyhow::anyhow!(
            "interrupted {stands}; `pendula {command} --resume {path}` goes on from there"
        )))
    }

    /// The run has come to its end: its output is finished, and its state is removed.
    pub fn finish<const N: usize>(self, rows: Rows<'_, N>) -> Result<(), Failure> {
        rows.finish()?;
        if let Some(Resumed { path, .. }) = &self.given.from {
            files::remove(path).with_context(|| format!("{} cannot be removed", path.display()))?;
        }
        Ok(())
    }
}

fn refused(path: &Path, why: impl Display) -> Failure {
    Failure::refused(format!("--resume {}: {why}", path.display()))
}
