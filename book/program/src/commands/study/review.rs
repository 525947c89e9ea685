//! `pendula review`: what moved since the snapshots were reviewed, or since a commit.

use std::env;
use std::io::Write;
use std::path::Path;

use anyhow::{Context, Result};
use clap::{Args, ValueEnum};

use super::open_in_browser;
use crate::book::locate;
use crate::book::progress::Progress;
use crate::book::review::markdown::Document;
use crate::book::review::source::Code;
use crate::book::review::working_tree::WorkingTree;
use crate::book::review::{Review, render};
use crate::book::versions::{Made, committed, computed};
use crate::commands::output::Stream;
use crate::output::failure::Failure;
use crate::output::files;

/// Arguments of `pendula review`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// How to show what moved
    #[arg(long, value_enum, default_value_t)]
    format: ReviewFormat,
    /// Open the page in the browser
    #[arg(long, conflicts_with = "format")]
    open: bool,
    /// Compare the snapshots committed at this revision with those of the working tree
    #[arg(long, value_name = "REV")]
    since: Option<String>,
    /// Accept these snapshots as they are now
    #[arg(long, value_name = "NAME", num_args = 1..)]
    #[arg(conflicts_with_all = ["since", "open", "format"])]
    accept: Vec<String>,
}

/// How what moved is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum ReviewFormat {
    /// A page to read offline: target/review/index.html
    #[default]
    Html,
    /// Text on standard output
    Text,
    /// Markdown on standard output, for a pull request
    Markdown,
}

/// Compares two versions of the snapshots, and shows what moved or accepts it.
///
/// # Errors
/// [`Failure::No`] if something moved; another if the versions cannot be compared, the page cannot
/// be written, or a name is none that moved.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let here = env::current_dir().context("the current directory cannot be read")?;
    run_in(&here, arguments, &|| computed(&Progress::on_terminal()), out)
}

/// The same in the folder `here`, where `compute` says what the code gives.
pub fn run_in(
    here: &Path,
    arguments: &Arguments,
    compute: &dyn Fn() -> Result<Made>,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    let book = locate::book(here)?;
    let root = book.parent().unwrap_or(Path::new("."));
    if !arguments.accept.is_empty() {
        return accept(root, &arguments.accept, compute, out);
    }
    if arguments.format == ReviewFormat::Html {
        // Before anything is computed, which takes seconds.
        let folder = root.join(render::FOLDER);
        let no_page = || format!("{} cannot be written", folder.join("index.html").display());
        files::create_folder(&folder).with_context(no_page)?;
        let index = folder.join("index.html");
        if Stream::Output.leads_to(&index) {
            return Err(Stream::Output.refusal("the page", &index));
        }
    }
    let review = compared(root, &book, arguments.since.as_deref(), compute)?;
    let document = Document::new(&review)?;
    match arguments.format {
        ReviewFormat::Text => out.write_all(render::text(&document).as_bytes())?,
        ReviewFormat::Markdown => out.write_all(document.to_markdown().as_bytes())?,
        ReviewFormat::Html => {
            let index = render::write(&document, root)?;
            writeln!(out, "{}\n{}", document.headline, index.display())?;
            out.flush()?;
            if arguments.open {
                open_in_browser(&index)?;
            }
        }
    }
    out.flush()?;
    // What cannot be computed has moved in a way that nobody can review.
    let is_sure = review.failed.is_empty() && review.warnings.is_empty();
    let is_same = review.is_empty() && is_sure && review.outdated.is_none();
    if is_same { Ok(()) } else { Err(Failure::No) }
}

/// What the code gives now, compared with the snapshots as reviewed, or as committed at a revision.
fn compared(
    root: &Path,
    book: &Path,
    revision: Option<&str>,
    compute: &dyn Fn() -> Result<Made>,
) -> Result<Review> {
    let committed = revision.map(|revision| committed(root, revision)).transpose()?;
    let tree = WorkingTree::read(&root.join("snapshots"), compute)?;
    let code = Code::read(root, committed.as_ref().map(|(commit, _)| commit.as_str()))?;
    let (before, mut old) = match (committed, revision) {
        (Some((commit, version)), Some(revision)) => {
            let short = commit.get(..9).unwrap_or(&commit);
            (format!("the snapshots committed at {revision} ({short})"), version)
        }
        _ => ("the snapshots as reviewed".to_string(), tree.reviewed()),
    };
    let mut now = tree.now.clone();
    // What cannot be computed is compared with nothing.
    for name in tree.failed.keys() {
        old.remove(name);
        now.remove(name);
    }
    let versions = [before, "what the code of the working tree gives".to_string()];
    let mut review = Review::new(versions, &old, &now, &book.join("src"))?;
    match revision {
        None => review.acceptable = review.snapshots.iter().map(|c| c.name.clone()).collect(),
        Some(_) => review.waiting = tree.moved().into_iter().map(str::to_string).collect(),
    }
    review.warnings = tree.stale.iter().map(|name| format!("`{name}`: {STALE}")).collect();
    let outdated = code.not_compiled()?;
    review.outdated =
        outdated.map(|file| format!("This program was not compiled from {file}: {RUN}"));
    (review.recorded, review.failed, review.code) = (tree.recorded, tree.failed, code);
    Ok(review)
}

/// What to do about a pending file that the code does not give.
const STALE: &str =
    "its pending file is not what the code gives now; run the tests again, or remove it";
/// What to do about a program that is older than its source.
const RUN: &str = "what it computes may be something else; `cargo run -- review` compiles it";

/// Accepts, and says what is left to review.
fn accept(
    root: &Path,
    names: &[String],
    compute: &dyn Fn() -> Result<Made>,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    if let Some(file) = Code::read(root, None)?.not_compiled()? {
        let why = format!("--accept: this program was not compiled from {file}: {RUN}");
        return Err(Failure::refused(why));
    }
    let snapshots = root.join("snapshots");
    let tree = WorkingTree::read(&snapshots, compute)?;
    tree.accept(&snapshots, names)?;
    writeln!(out, "accepted: {}", names.join(" "))?;
    let mut left = tree.moved();
    left.retain(|name| !names.iter().any(|accepted| accepted == name));
    if !left.is_empty() {
        writeln!(out, "still to review: {}", left.join(" "))?;
    }
    Ok(())
}
