//! From a chapter's source to what mdBook renders.
//!
//! mdBook's own `links` step has inserted the included text before. In order: every include is
//! checked against the disk, and each snapshot against what the code makes of it now ([`checks`]),
//! the pages of the tests are added ([`sources`]), and in each chapter the data of snapshots become
//! tables ([`tables`]) and get their captions ([`captions`]), directives and formulas are replaced
//! ([`chapter`], by [`typeset`]), listings become whole programs ([`listing`]) and [`questions`]
//! forms. Then it is known which chapters quote which claim, and the ledger's tables link back to
//! them ([`claims`]).
//!
//! Nothing is repaired silently: what cannot be resolved stops the build, and the error names its
//! chapter.

use std::collections::BTreeSet;
use std::io::{Read, Write};

use anyhow::{Context, Result};
use mdbook_preprocessor::book::{Book, BookItem, Chapter};
use mdbook_preprocessor::{Preprocessor, PreprocessorContext, parse_input};

use crate::book::ledger::Ledger;
use crate::book::progress::Progress;

pub mod a_report;
pub mod captions;
pub mod chapter;
pub mod checks;
pub mod claims;
pub mod listing;
pub mod markdown;
pub mod questions;
pub mod sources;
pub mod strangers;
pub mod tables;
pub mod typeset;
pub mod work_precision;

/// Formulas and values become HTML, so that no other renderer can use them.
pub fn supports(renderer: &str) -> bool {
    renderer == "html"
}

/// Reads a book as mdBook sends it, and writes it preprocessed to `out`, with the values of the
/// ledger, which is asked for when it is a book.
pub fn protocol<L: Ledger + 'static>(
    ledger: impl FnOnce() -> L,
    input: impl Read,
    out: &mut dyn Write,
) -> Result<()> {
    let (context, book) =
        parse_input(input).context("mdBook sends [context, book] as JSON on standard input")?;
    let book = Pendula::new(ledger(), Progress::hidden()).run(&context, book)?;
    serde_json::to_writer(out, &book).context("the book cannot be written")
}

/// The preprocessor, both in-process and for the command `pendula preprocess`.
pub struct Pendula {
    ledger: Box<dyn Ledger>,
    progress: Progress,
}

impl Pendula {
    /// A preprocessor that takes its values from `ledger`.
    pub fn new(ledger: impl Ledger + 'static, progress: Progress) -> Self {
        Self { ledger: Box::new(ledger), progress }
    }
}

impl Preprocessor for Pendula {
    /// The name of its table in `book.toml`.
    fn name(&self) -> &str {
        "pendula"
    }

    fn supports_renderer(&self, renderer: &str) -> Result<bool> {
        Ok(supports(renderer))
    }

    fn run(&self, context: &PreprocessorContext, mut book: Book) -> Result<Book> {
        let included = checks::includes(&context.root.join(&context.config.book.src), &book)?;
        self.progress.stage("comparing the snapshots", 1);
        checks::snapshots(&included, self.ledger.as_ref())?;

        let reports = context.root.join("strangers/reports");
        each(&mut book, |chapter| {
            chapter.content = a_report::insert(&strangers::insert(&chapter.content, &reports)?);
            const WRONG: &str = "{{wrong-claims}}";
            if chapter.content.contains(WRONG) {
                let wrong = self.ledger.wrong().context("nobody counts the wrong claims")?;
                chapter.content = chapter.content.replace(WRONG, &wrong.to_string());
            }
            Ok(())
        })?;

        // tests/ is beside book/.
        let tests = sources::Tests::read(&context.root.join("..").join("tests"))?;
        for page in sources::pages(&tests) {
            book.push_item(page);
        }

        self.progress.stage("setting the chapters", book.chapters().count());
        let setter = chapter::Setter::new(
            self.ledger.as_ref(),
            &tests,
            work_precision::in_the_book(&context.root)?,
        );
        let mut quotes = claims::Quotes::new();
        each(&mut book, |chapter| {
            self.progress.advance();
            set(&setter, chapter, &mut quotes)
        })?;
        each(&mut book, |chapter| {
            chapter.content = claims::set(&chapter.content, &quotes)?;
            Ok(())
        })?;
        self.progress.stage("writing the pages", 1);
        Ok(book)
    }
}

/// Does this to each chapter. The error names its chapter.
fn each(book: &mut Book, mut action: impl FnMut(&mut Chapter) -> Result<()>) -> Result<()> {
    // for_each_chapter_mut cannot stop early: the first error is kept.
    let mut outcome = Ok(());
    book.for_each_chapter_mut(|chapter| {
        if outcome.is_ok() {
            outcome = action(chapter).with_context(|| format!("chapter {}", name(chapter)));
        }
    });
    outcome
}

fn set(
    setter: &chapter::Setter<'_>,
    chapter: &mut Chapter,
    quotes: &mut claims::Quotes,
) -> Result<()> {
    let depth = chapter.path.as_ref().map_or(0, |path| path.components().count().saturating_sub(1));
    let mut quoted = BTreeSet::new();
    let content = captions::set(&tables::set(&chapter.content)?)?;
    chapter.content = setter.set(&content, &"../".repeat(depth), &mut quoted)?;
    let page = chapter.path.clone().unwrap_or_default().with_extension("html");
    for id in quoted {
        let link = format!("<a href=\"{}#{id}\">{}</a>", page.display(), chapter.name);
        quotes.entry(id).or_default().push(link);
    }
    Ok(())
}

/// The name of a chapter in errors: its file, or its title if it has none.
fn name(chapter: &Chapter) -> String {
    match &chapter.path {
        Some(path) => path.display().to_string(),
        None => chapter.name.clone(),
    }
}

/// All chapters that are not drafts, nested ones included.
fn chapters(book: &Book) -> impl Iterator<Item = &Chapter> {
    book.iter().filter_map(|item| match item {
        BookItem::Chapter(chapter) if !chapter.is_draft_chapter() => Some(chapter),
        _ => None,
    })
}
