//! `pendula review`: what moved since the snapshots were reviewed, or since a commit.

use std::env;
use std::io::Write;
use std::path::Path;

use anyhow::{Context, Result, anyhow};
use clap::{Args, ValueEnum};

use crate::failure::Failure;
use crate::interrupt::interrupts;
use crate::locate;
use crate::progress::Progress;
use crate::review::versions::{committed, on_disk};
use crate::review::working_tree::{WorkingTree, contents};
use crate::review::{Review, markdown, page, text};

/// Arguments of `pendula review`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// How what moved is shown
    #[arg(long, value_enum, default_value_t)]
    format: ReviewFormat,
    /// Open the page in the browser
    #[arg(long, conflicts_with = "format")]
    open: bool,
    /// Compare the snapshots committed at this revision with those of the working tree
    #[arg(long, value_name = "REV")]
    since: Option<String>,
    /// Accept what these snapshots are now
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
/// [`Failure::No`] if something moved; [`Failure::Refused`] if the versions cannot be compared, the
/// page cannot be written, or a name is none that moved.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let here = env::current_dir().context("the current directory cannot be read")?;
    run_in(&here, arguments, out)
}

/// The same in the folder `here`.
pub(crate) fn run_in(
    here: &Path,
    arguments: &Arguments,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    // Exit status 1 says that something moved.
    let refused = |error: anyhow::Error| Failure::refused(format!("{error:#}"));
    let book = locate::book(here).map_err(refused)?;
    let root = book.parent().unwrap_or(Path::new("."));
    if !arguments.accept.is_empty() {
        return accept(root, &arguments.accept, out).map_err(refused);
    }
    let review = match &arguments.since {
        Some(revision) => since(root, &book, revision),
        None => as_reviewed(root, &book),
    };
    let review = review.map_err(refused)?;
    match arguments.format {
        ReviewFormat::Text => text::write(&review, out)?,
        ReviewFormat::Markdown => markdown::write(&review, out)?,
        ReviewFormat::Html => {
            // From here on there are files that an interrupt must not leave behind.
            let interrupted = interrupts()?;
            let index = page::write(&review, root, &interrupted).map_err(refused)?;
            text::verdict(&review, out)?;
            writeln!(out, "{}", index.display())?;
            out.flush()?;
            if arguments.open {
                let no_program =
                    || format!("no program could be started to open {}", index.display());
                open::that_detached(&index).with_context(no_program).map_err(refused)?;
            }
        }
    }
    out.flush()?;
    // What cannot be computed has moved in a way that nobody can review.
    if review.is_empty() && review.warnings.is_empty() { Ok(()) } else { Err(Failure::No) }
}

/// The snapshots as reviewed, and what the code gives now.
fn as_reviewed(root: &Path, book: &Path) -> Result<Review> {
    let tree = WorkingTree::read(&root.join("snapshots"), &Progress::on_terminal())?;
    let versions = ["the snapshots as reviewed".to_string(), tree.label()];
    let mut review = Review::new(versions, &tree.reviewed(), &tree.now, &book.join("src"))?;
    review.acceptable = true;
    review.warnings = tree.warnings();
    Ok(review)
}

/// The snapshots committed at a revision, and those of the working tree.
fn since(root: &Path, book: &Path, revision: &str) -> Result<Review> {
    let (commit, old) = committed(root, revision)?;
    let new = contents(&on_disk(&root.join("snapshots"), ".snap")?);
    let before = format!("the snapshots committed at {revision} ({commit})");
    let versions = [before, "the snapshots of the working tree".to_string()];
    Review::new(versions, &old, &new, &book.join("src"))
}

/// Accepts, and says what is left to review.
fn accept(root: &Path, names: &[String], out: &mut dyn Write) -> Result<()> {
    let snapshots = root.join("snapshots");
    let tree = WorkingTree::read(&snapshots, &Progress::on_terminal())?;
    // What is begun is finished, as it takes no time.
    interrupts().map_err(|failure| anyhow!(failure.line().unwrap_or_default()))?;
    tree.accept(&snapshots, names)?;
    writeln!(out, "accepted: {}", names.join(" "))?;
    for warning in tree.warnings() {
        writeln!(out, "! {warning}")?;
    }
    let reviewed = tree.reviewed();
    let moved = tree.now.iter().filter(|(name, content)| reviewed.get(*name) != Some(content));
    let left: Vec<&str> = (moved.map(|(name, _)| name.as_str()))
        .filter(|name| !names.iter().any(|accepted| accepted == name))
        .collect();
    if !left.is_empty() {
        writeln!(out, "still to review: {}", left.join(" "))?;
    }
    Ok(())
}
