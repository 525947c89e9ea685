//! What a reader's search finds: an index of our own in place of mdBook's, of the same form.
//!
//! Of each page it has the sections and the terms of the glossary, each with its prose: without the
//! letters within figures, the outputs of listings, long tables, and what gives the answer to a
//! question or an exercise away. The title of a section weighs more than its text, and more than
//! both weigh the words of book/search.toml, by which a newcomer may look for a place. Accents do
//! not matter.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use anyhow::{Context, Result, bail, ensure};
use elasticlunr::{Index, IndexBuilder};
use html5ever::tendril::StrTendril;
use html5ever::tokenizer::{
    BufferQueue, Tag, TagKind, Token, TokenSink, TokenSinkResult, Tokenizer, TokenizerOpts,
};
use serde_json::{Map, Value, json};
use unicode_normalization::UnicodeNormalization;
use unicode_normalization::char::is_combining_mark;

use crate::book::print;
use crate::output::files;

/// How much a word in the title of a section weighs, and how much one of `WORDS`, if one in its
/// text weighs 1.
const TITLE: u32 = 4;
const GIVEN: u32 = 12;

/// Which words lead where, beside those of the pages.
const WORDS: &str = "search.toml";

/// What is not searched, by class: pictures of formulas (their text stands beside them), questions
/// with their answers, outputs, reports, tables of hundreds of rows.
const LEFT_OUT: [&str; 9] = [
    "answer",
    "answers",
    "claims",
    "defect",
    "katex-html",
    "output",
    "question",
    "reports",
    "sortable",
];

/// Elements that do not part words.
const WITHIN_WORDS: [&str; 10] =
    ["a", "abbr", "b", "code", "em", "i", "span", "strong", "sub", "sup"];

/// Elements of which a line of text cannot be made.
const TALL: [&str; 9] =
    ["mfrac", "mover", "mroot", "msqrt", "msubsup", "msup", "mtable", "munder", "munderover"];

/// Writes the index of the pages in a folder, in place of mdBook's, if the book has one; `root` is
/// the folder of the book's sources.
pub fn index(root: &Path, pages: &Path) -> Result<()> {
    let file = pages.join("searchindex.js");
    if !files::exists(&file)? {
        return Ok(());
    }
    let given = root.join(WORDS);
    let words = if files::exists(&given)? { files::text(&given)? } else { String::new() };
    let words = toml::from_str(&words).with_context(|| given.display().to_string())?;
    let mut sections = Vec::new();
    for page in print::chapters(&files::text(&pages.join("toc.html"))?) {
        if !print::is_left_out(&page) {
            sections.extend(of_page(&page, &files::text(&pages.join(&page))?)?);
        }
    }
    let json = indexed(&sections, words)?.to_string();
    // As mdBook writes it: a string that need not escape its many quotation marks.
    let json = json.replace('\\', r"\\").replace('\'', r"\'");
    let script = format!("window.search = Object.assign(window.search, JSON.parse('{json}'));");
    fs::write(&file, script).with_context(|| file.display().to_string())
}

/// A place that can be found.
#[derive(Debug, Default, PartialEq)]
struct Section {
    /// Its page, and its id there unless it is the page's beginning.
    address: String,
    /// The page's title and its own, or one of the two.
    title: String,
    chapter: String,
    /// What is shown of it, and what is searched.
    shown: String,
    searched: String,
}

/// The sections of a page, in order.
fn of_page(page: &str, html: &str) -> Result<Vec<Section>> {
    let (_, main) = html.split_once("<main>").with_context(|| format!("{page} has no text"))?;
    let (main, _) = main.rsplit_once("</main>").context("the text does not end")?;
    let reader = Reader { state: RefCell::new(State::new(page)) };
    let tokenizer = Tokenizer::new(reader, TokenizerOpts::default());
    let input = BufferQueue::default();
    input.push_back(StrTendril::from(main));
    // A script would stop it; a chapter has none.
    let _ = tokenizer.feed(&input);
    ensure!(input.is_empty(), "{page} cannot be read to its end");
    tokenizer.end();
    let mut state = tokenizer.sink.state.into_inner();
    state.end_section();
    Ok(state.sections)
}

/// Reads a page, element by element.
struct Reader {
    state: RefCell<State>,
}

struct State {
    page: String,
    sections: Vec<Section>,
    /// The one being read.
    section: Section,
    /// The element whose text is its title.
    heading: Option<String>,
    /// The element that is left out, and how many of its name are open.
    skipped: Option<(String, usize)>,
    /// The formula being read, and whether it is one line.
    formula: Option<(String, bool)>,
    /// How much was read before what is folded.
    fold: Option<(usize, usize)>,
}

impl TokenSink for Reader {
    type Handle = ();

    fn process_token(&self, token: Token, _line: u64) -> TokenSinkResult<()> {
        let mut state = self.state.borrow_mut();
        match token {
            Token::TagToken(tag) if tag.kind == TagKind::StartTag => state.start(&tag),
            Token::TagToken(tag) => state.end(&tag.name),
            Token::CharacterTokens(text) => state.text(&text),
            _ => {}
        }
        TokenSinkResult::Continue
    }
}

impl State {
    fn new(page: &str) -> Self {
        State {
            page: page.to_string(),
            sections: Vec::new(),
            section: Section::default(),
            heading: None,
            skipped: None,
            formula: None,
            fold: None,
        }
    }

    fn start(&mut self, tag: &Tag) {
        let name = &*tag.name;
        if let Some((skipped, depth)) = &mut self.skipped {
            *depth += usize::from(skipped == name && !tag.self_closing);
            return;
        }
        let attribute = |wanted: &str| {
            let found = tag.attrs.iter().find(|attribute| &*attribute.name.local == wanted);
            found.map(|attribute| attribute.value.to_string())
        };
        let classes = attribute("class").unwrap_or_default();
        let left_out = classes.split_whitespace().any(|class| LEFT_OUT.contains(&class));
        if left_out || ["annotation", "pre", "script", "style", "svg"].contains(&name) {
            if !tag.self_closing {
                self.skipped = Some((name.to_string(), 1));
            }
            return;
        }
        match (name, attribute("id")) {
            ("h1" | "h2" | "h3" | "dt", Some(id)) => {
                self.end_section();
                let place = if name == "h1" { String::new() } else { format!("#{id}") };
                self.section.address = format!("{}{place}", self.page);
                self.heading = Some(name.to_string());
            }
            ("math", _) => self.formula = Some((String::new(), true)),
            ("details", _) => {
                self.fold = Some((self.section.shown.len(), self.section.searched.len()));
            }
            _ => {}
        }
        if let Some((_, is_line)) = &mut self.formula {
            *is_line &= !TALL.contains(&name);
        }
        self.part(name);
    }

    fn end(&mut self, name: &str) {
        if let Some((skipped, depth)) = &mut self.skipped {
            *depth -= usize::from(skipped == name);
            if *depth == 0 {
                self.skipped = None;
                self.part(name);
            }
            return;
        }
        if self.heading.as_deref() == Some(name) {
            self.heading = None;
        }
        if name == "math"
            && let Some((formula, is_line)) = self.formula.take()
        {
            let formula = if is_line { &formula } else { "…" };
            let Section { title, shown, searched, .. } = &mut self.section;
            let part = if self.heading.is_some() { title } else { shown };
            part.extend(formula.split_whitespace());
            searched.push(' ');
            return;
        }
        if name == "summary"
            && let Some((shown, searched)) = self.fold.take()
            && self.section.shown[shown..].trim_start().starts_with("Solution")
        {
            self.section.shown.truncate(shown);
            self.section.searched.truncate(searched);
            self.skipped = Some(("details".to_string(), 1));
            return;
        }
        self.part(name);
    }

    /// Parts words where an element begins or ends, unless it stands within them.
    fn part(&mut self, name: &str) {
        if self.formula.is_none() && !WITHIN_WORDS.contains(&name) {
            self.text(" ");
        }
    }

    fn text(&mut self, text: &str) {
        if self.skipped.is_some() {
            return;
        }
        if let Some((formula, _)) = &mut self.formula {
            formula.push_str(text);
        } else if self.heading.is_some() {
            self.section.title.push_str(text);
        } else {
            // The marks of a table say nothing without their columns.
            self.section.shown.push_str(&text.replace('●', ""));
            self.section.searched.push_str(text);
        }
    }

    fn end_section(&mut self) {
        let mut section = std::mem::take(&mut self.section);
        self.fold = None;
        if section.address.is_empty() {
            return;
        }
        for part in [&mut section.title, &mut section.shown, &mut section.searched] {
            *part = part.split_whitespace().collect::<Vec<_>>().join(" ");
        }
        section.chapter = match self.sections.first() {
            Some(first) => first.title.clone(),
            None => section.title.clone(),
        };
        self.sections.push(section);
    }
}

/// The words of a text, and those with an accent without it too. The browser's half of the search
/// parts what a reader types at blanks and hyphens; of what is written with a dash it would find
/// only the beginning.
fn tokens(text: &str) -> Vec<String> {
    let is_between = |c: char| !c.is_alphanumeric() && !"'’.,_".contains(c);
    let mut tokens = Vec::new();
    for word in text.split(is_between).map(|word| word.trim_matches(|c: char| !c.is_alphanumeric()))
    {
        // A number alone is nothing that anybody looks for.
        if !word.contains(char::is_alphabetic) {
            continue;
        }
        let word = word.to_lowercase();
        let plain = word.nfd().filter(|&c| !is_combining_mark(c)).collect::<String>();
        if plain != word {
            tokens.push(plain);
        }
        tokens.push(word);
    }
    tokens
}

/// What mdBook's script searches: an index in the form of elasticlunr, addresses and options.
fn indexed(sections: &[Section], mut words: BTreeMap<String, Vec<String>>) -> Result<Value> {
    let mut index: Index = ["words", "title", "body"]
        .iter()
        .fold(IndexBuilder::new().save_docs(false), |builder, field| {
            builder.add_field_with_tokenizer(field, Box::new(tokens))
        })
        .build();
    let (mut docs, mut addresses) = (Map::new(), Vec::new());
    for section in sections {
        let number = addresses.len().to_string();
        let Section { address, title, chapter, shown, searched } = section;
        let given = words.remove(address).unwrap_or_default().join(" ");
        // All in one, so that each word of a question may stand in another part.
        let body = format!("{given} {chapter} {title} {searched}");
        index.add_doc(&number, [&given, title, &body]);
        let name = if chapter == title { title } else { &format!("{chapter} » {title}") };
        docs.insert(number.clone(), json!({"id": number, "breadcrumbs": name, "body": shown}));
        addresses.push(address);
    }
    if let Some(place) = words.keys().next() {
        bail!("{WORDS}: there is no place {place}");
    }
    let mut index = serde_json::to_value(&index)?;
    index["documentStore"]["docs"] = Value::Object(docs);
    index["documentStore"]["save"] = Value::Bool(true);
    Ok(json!({
        "doc_urls": addresses,
        "index": index,
        "results_options": {"limit_results": 20, "teaser_word_count": 30},
        "search_options": {
            // A place with more of the words stands before one with fewer: a word that is nowhere,
            // in a question, does not leave it without an answer.
            "bool": "OR",
            "expand": true,
            "fields": {
                "words": {"boost": GIVEN}, "title": {"boost": TITLE}, "body": {"boost": 1},
            },
        },
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = r##"<main>
        <h1 id="s"><a href="#s">Störmer–Verlet</a></h1><p>A <em>kick</em>, and<br>a drift
        <span class="katex"><span class="katex-mathml"><math><mi>Φ</mi><mi>h</mi>
        <annotation>\Phi_h</annotation></math></span><span
        class="katex-html"><i>Φ</i></span></span>.</p>
        <figure><svg><text>−1.5</text><g><svg></svg></g></svg>
        <figcaption>Seen &amp; told.</figcaption></figure>
        <h2 id="e">Exercises</h2><p>Prove it.</p><table><tr><td>●</td><td>●</td></tr></table>
        <fieldset class="question"><label>Which?</label></fieldset>
        <details><summary>Solution 1</summary><details><p>No</p></details><p>one.</p></details>
        <details><summary>More</summary><p>Half <math><mfrac>12</mfrac></math>.</p></details>
        </main>"##;

    fn sections() -> Vec<Section> {
        of_page("s.html", PAGE).unwrap()
    }

    /// Catches: letters of a figure, a formula's second copy, the marks of a table, or an answer in
    /// what is found; what stands after them lost.
    #[test]
    fn what_is_read_is_the_prose_of_each_section() {
        let sections = sections();
        let seen = sections.iter().map(|it| [&it.address, &it.title, &it.chapter, &it.shown]);
        let chapter = "Störmer–Verlet";
        assert_eq!(
            seen.collect::<Vec<_>>(),
            [
                ["s.html", chapter, chapter, "A kick, and a drift Φh. Seen & told."],
                ["s.html#e", "Exercises", chapter, "Prove it. More Half …."],
            ]
        );
        assert_eq!(sections[0].searched, "A kick, and a drift . Seen & told.");
    }

    /// Catches: a name that is found with its accent alone, or in its first half alone.
    #[test]
    fn words_are_found_without_accents_and_on_both_sides_of_a_dash() {
        assert_eq!(
            tokens("Störmer–Verlet’s 1.5 θ₀, RK4"),
            ["stormer", "störmer", "verlet’s", "θ₀", "rk4"]
        );
    }

    /// Catches: words for a place that has gone, which would lead nowhere in silence.
    #[test]
    fn words_lead_to_a_place_that_is_there() {
        let words =
            |place: &str| BTreeMap::from([(place.to_string(), vec!["leapfrog".to_string()])]);
        let index = indexed(&sections(), words("s.html#e")).unwrap().to_string();
        assert!(index.contains("s.html#e"));
        let error = indexed(&sections(), words("t.html")).unwrap_err();
        assert_eq!(error.to_string(), "search.toml: there is no place t.html");
    }
}
