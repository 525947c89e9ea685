//! Building the book in-process: mdBook's driver with our preprocessor in place of the command.
//!
//! mdBook reports an unclosed tag or a missing include through `tracing`, and continues. Such
//! reports are collected here, so that the build can stop.

use std::fmt::Debug;
use std::fs;
use std::mem;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use anyhow::{Context, Result, bail, ensure};
use mdbook_driver::MDBook;
use pendula::METHODS;
use serde_json::Value;
use tracing::field::Field;
use tracing::span::{Attributes, Id, Record};
use tracing::{Event, Level, Metadata, Subscriber, subscriber};

use crate::book::frame;
use crate::book::ledger::Ledger;
use crate::book::names;
use crate::book::page_files;
use crate::book::preprocess::Pendula;
use crate::book::print;
use crate::book::progress::Progress;
use crate::book::search;
use crate::book::sheets::Sheets;
use crate::output::files;
use crate::output::files::whole_folder::WholeFolder;

/// Builds the book in the folder `root`, into the folder `destination` or the one that its
/// `book.toml` names, and returns the path of its first page. It is built beside that folder, and
/// takes the place of what is there when it is whole. While somebody else builds the same book, it
/// waits.
///
/// # Errors
/// Anything that stops the build, and anything mdBook only warns of. The old book is then as it
/// was.
pub fn book(
    root: &Path,
    destination: Option<&Path>,
    ledger: impl Ledger + 'static,
    progress: Progress,
) -> Result<PathBuf> {
    let (built, warnings) = collect(|| driven(root, destination, ledger, &progress));
    progress.finish();
    let Built { folder, pages } = built?;
    if let Some((first, others)) = warnings.split_first() {
        match others.len() {
            0 => bail!("mdBook warns: {first}"),
            n => bail!("mdBook warns: {first} (and {n} more)"),
        }
    }
    let index = pages.join("index.html");
    let is_there = files::exists(&folder.path().join(&index))?;
    ensure!(is_there, "mdBook made no {}", index.display());
    let target = folder.replace().context("the old book cannot be replaced")?;
    Ok(target.join(index))
}

/// A book that is to take the place of the old one.
struct Built {
    folder: WholeFolder,
    /// Where its pages are in that folder.
    pages: PathBuf,
}

/// Has mdBook write the pages.
fn driven(
    root: &Path,
    destination: Option<&Path>,
    ledger: impl Ledger + 'static,
    progress: &Progress,
) -> Result<Built> {
    progress.stage("reading the chapters", 1);
    let mut book = MDBook::load(root)
        .with_context(|| format!("the book in {} cannot be read", root.display()))?;
    // From there, unless it begins at the root of the disk.
    let target = root.join(destination.unwrap_or(&book.config.build.build_dir));
    let wait = || progress.stage("waiting for another build", 1);
    let folder = WholeFolder::beside(&target, wait)
        .with_context(|| format!("the book cannot be built beside {}", target.display()))?;
    let new = files::canonicalize(folder.path())?;
    book.config.build.build_dir = new.clone();
    // The same name as in book.toml, so that it takes the command's place.
    book.with_preprocessor(Pendula::new(ledger, progress.clone()));
    book.build()?;
    let pages = book.build_dir_for("html");
    let html = book.config.html_config().unwrap_or_default();
    search::index(root, &pages)?;
    print::shorten(&pages)?;
    page_files::join(&pages, &html.additional_js)?;
    page_files::lighten(&pages, &html.additional_js)?;
    let sheets = Sheets::join(&pages)?;
    let site = html.site_url.unwrap_or_default();
    each_page(&pages, |page| {
        let page = sheets.linked(&names::coloured(&frame::page(page)?));
        page_files::finished(&page, &site)
    })?;
    mend_script(&pages)?;
    known_answers(root, &pages)?;
    let pages = pages.strip_prefix(&new)?.to_path_buf();
    Ok(Built { folder, pages })
}

/// Mends mdBook's script, whose name may have a hash in it.
fn mend_script(pages: &Path) -> Result<()> {
    let is_it = |name: &str| name.starts_with("book") && name.ends_with(".js");
    let named = |path: &PathBuf| path.file_name().is_some_and(|it| is_it(&it.to_string_lossy()));
    let script = files::list(pages)?.into_iter().find(named).context("mdBook made no script")?;
    fs::write(&script, frame::script(&files::text(&script)?)?)
        .with_context(|| script.display().to_string())
}

/// Changes every page in the folder.
fn each_page(folder: &Path, change: impl Fn(&str) -> Result<String>) -> Result<()> {
    for path in files::with_extension(folder, "html")? {
        let file = folder.join(path);
        let name = || file.display().to_string();
        fs::write(&file, change(&files::text(&file)?).with_context(name)?).with_context(name)?;
    }
    Ok(())
}

/// Adds the known answers to a book that has the page for them: as they are, to be taken along, and
/// as a script, since a page that is opened from a disk cannot fetch a file. In the script the
/// methods of the library have the titles by which the book calls them.
fn known_answers(root: &Path, pages: &Path) -> Result<()> {
    let assets = pages.join("assets");
    let page = assets.join("which");
    if !files::exists(&page).with_context(|| page.display().to_string())? {
        return Ok(());
    }
    let file = root.join("judge/known-answers/known-answers.json");
    let json = files::text(&file)?;
    let mut known: Value =
        serde_json::from_str(&json).with_context(|| file.display().to_string())?;
    for method in known["methods"].as_array_mut().into_iter().flatten() {
        let title = METHODS.iter().map(|known| known.info()).find(|it| method["name"] == it.name);
        if let Some(info) = title {
            method["title"] = info.title.into();
        }
    }
    let script = format!("globalThis.knownAnswers = {known};\n");
    for (name, text) in [("known-answers.json", &json), ("known-answers.js", &script)] {
        let to = assets.join(name);
        fs::write(&to, text).with_context(|| to.display().to_string())?;
    }
    Ok(())
}

/// Runs `work`; returns its result and what mdBook warned of meanwhile.
fn collect<T>(work: impl FnOnce() -> T) -> (T, Vec<String>) {
    let warnings = Arc::<Mutex<Vec<String>>>::default();
    let result = subscriber::with_default(Collector(Arc::clone(&warnings)), work);
    let warnings = mem::take(&mut *warnings.lock().unwrap_or_else(PoisonError::into_inner));
    (result, warnings)
}

struct Collector(Arc<Mutex<Vec<String>>>);

impl Subscriber for Collector {
    fn enabled(&self, metadata: &Metadata<'_>) -> bool {
        *metadata.level() <= Level::WARN && metadata.target().starts_with("mdbook")
    }

    fn event(&self, event: &Event<'_>) {
        event.record(&mut |field: &Field, value: &dyn Debug| {
            if field.name() == "message" {
                let mut warnings = self.0.lock().unwrap_or_else(PoisonError::into_inner);
                warnings.push(format!("{value:?}"));
            }
        });
    }

    // Spans are not needed.
    fn new_span(&self, _: &Attributes<'_>) -> Id {
        Id::from_u64(1)
    }
    fn record(&self, _: &Id, _: &Record<'_>) {}
    fn record_follows_from(&self, _: &Id, _: &Id) {}
    fn enter(&self, _: &Id) {}
    fn exit(&self, _: &Id) {}
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: a collector that receives nothing, and one that also receives other crates' events
    /// or mere information.
    #[test]
    fn only_mdbooks_warnings_are_collected() {
        let (result, messages) = collect(|| {
            tracing::warn!(target: "mdbook_html::html", "unclosed tag <{}>", "div");
            tracing::info!(target: "mdbook_html::html", "building");
            tracing::warn!(target: "other", "none of our business");
            7
        });
        assert_eq!(result, 7);
        assert_eq!(messages, ["unclosed tag <div>"]);
    }
}
