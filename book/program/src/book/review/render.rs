//! A review's Markdown as a page that needs nothing but itself, and as plain text.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use pendula_study::report::table::Table;
use pulldown_cmark::html::push_html;
use pulldown_cmark::{CodeBlockKind, Event, Options, Parser, Tag, TagEnd};

use super::Figure;
use super::drawings::{self, Difference};
use super::markdown::Document;
use crate::output::files::whole_file::{self, Change};
use crate::output::files::{canonicalize, create_folder};
use crate::output::page::Page;
use pendula_judge::printable::escaped;

/// The folder of the page, below the top folder of the project.
pub const FOLDER: &str = "target/review";
/// The way back from there.
const TOP: &str = "../../";

/// Writes the page and returns its path.
///
/// # Errors
/// If it cannot be written; an older page is then as it was.
pub fn write(document: &Document, root: &Path) -> Result<PathBuf> {
    let folder = root.join(FOLDER);
    let index = folder.join("index.html");
    let refused = || format!("{} cannot be written", index.display());
    let html = html(document);
    create_folder(&folder).with_context(refused)?;
    // The path to print, as long as nothing has changed.
    let index = canonicalize(&folder).with_context(refused)?.join("index.html");
    whole_file::change(&[Change::Written(index.clone(), html.into_bytes())])?;
    Ok(index)
}

fn events(markdown: &str) -> Parser<'_> {
    Parser::new_ext(markdown, Options::ENABLE_TABLES)
}

/// The page.
pub fn html(document: &Document) -> String {
    let mut body = "<section id=\"verdict\">\n".to_string();
    let mut is_difference = false;
    let events = events(&document.body).map(|event| match event {
        Event::Html(html) | Event::InlineHtml(html) => {
            let place = |number: &usize| Document::place(*number) == html.trim();
            match (0..document.drawings.len()).find(place) {
                Some(number) => Event::Html(document.drawings[number].clone().into()),
                // Markup that we did not write is text.
                None => Event::Text(html),
            }
        }
        Event::Start(Tag::Link { link_type, dest_url, title, id }) => {
            let dest_url = format!("{TOP}{dest_url}").into();
            Event::Start(Tag::Link { link_type, dest_url, title, id })
        }
        Event::Start(Tag::CodeBlock(kind)) => {
            is_difference = kind == CodeBlockKind::Fenced("diff".into());
            Event::Start(Tag::CodeBlock(kind))
        }
        Event::Text(text) if std::mem::take(&mut is_difference) => {
            Event::Html(difference(&text).into())
        }
        other => other,
    });
    push_html(&mut body, events);
    let page = Page {
        title: &plain(&document.headline),
        lead: "",
        body: &(body + "</section>\n"),
        style: include_str!("page.css"),
    };
    page.html()
}

/// A text without the marks of code.
fn plain(text: &str) -> String {
    text.replace('`', "")
}

/// The review for a terminal, in columns.
pub fn text(document: &Document) -> String {
    let mut out = format!("{}\n\n", plain(&document.headline));
    let (mut line, mut rows) = (String::new(), Vec::<Vec<String>>::new());
    for event in events(&document.body) {
        match event {
            Event::Text(text) | Event::Code(text) => line += &text,
            Event::HardBreak => line += "\n    ",
            Event::SoftBreak => line.push(' '),
            Event::Start(Tag::Item) => line += "* ",
            Event::Start(Tag::TableHead | Tag::TableRow) => rows.push(Vec::new()),
            Event::End(TagEnd::TableCell) => {
                let row = rows.last_mut().expect("a cell stands in a row");
                row.push(std::mem::take(&mut line));
            }
            Event::End(TagEnd::Table) => {
                let mut rows = rows.drain(..);
                let mut table = Table::new(rows.next().unwrap_or_default());
                rows.for_each(|row| table.push(row));
                out += &format!("{}\n", table.to_text());
            }
            Event::End(end) if is_block(end) => {
                if !line.is_empty() {
                    out += &format!("{}\n", std::mem::take(&mut line).trim_end());
                }
                if end != TagEnd::Item {
                    out.push('\n');
                }
            }
            _ => {}
        }
    }
    out.trim_end().to_string() + "\n"
}

fn is_block(end: TagEnd) -> bool {
    use TagEnd::{CodeBlock, Heading, Item, List, Paragraph};
    matches!(end, CodeBlock | Heading(_) | Item | List(_) | Paragraph)
}

/// A difference with its lines marked, as HTML.
fn difference(text: &str) -> String {
    let line = |line: &str| {
        let escaped = escaped(line);
        match line.as_bytes().first() {
            Some(b'+') => format!("<ins>{escaped}</ins>"),
            Some(b'-') => format!("<del>{escaped}</del>"),
            _ => escaped,
        }
    };
    text.split_inclusive('\n').map(line).collect()
}

/// A figure for the page: both drawings side by side or one over the other, or the only one.
pub fn figure(figure: &Figure) -> String {
    let name = escaped(&figure.name);
    let drawing = |version: usize, class: &str, word: &str| {
        let drawing = apart(figure.drawings[version].as_ref()?, &figure.name, class);
        let drawing = ringed(&drawing, figure.difference.as_ref());
        Some(format!("<div class=\"{class}\"><p class=\"version\">{word}</p>{drawing}</div>"))
    };
    let drawn: Vec<String> =
        [drawing(0, "old", "before"), drawing(1, "new", "now")].into_iter().flatten().collect();
    let stage = format!("<div class=\"stage\">{}</div>\n", drawn.concat());
    if drawn.len() < 2 {
        return stage;
    }
    let mode = |mode: &str, words: &str, is: &str| {
        let input = format!("<input type=\"radio\" name=\"{name}\" value=\"{mode}\"{is}>");
        format!("<label>{input} {words}</label> ")
    };
    let modes = mode("beside", "side by side", " checked") + &mode("over", "overlaid", "");
    let modes = format!("<fieldset><legend>{name}</legend>{modes}</fieldset>");
    format!("<div class=\"compare\">{modes}{stage}</div>\n")
}

/// The drawing with a ring around the point that moved farthest, where one can see it.
fn ringed(drawing: &str, difference: Option<&Difference>) -> String {
    let moved = difference.filter(|difference| difference.displacement >= drawings::VISIBLE);
    let (Some((x, y)), Some((before, after))) =
        (moved.and_then(|difference| difference.place), drawing.rsplit_once("</svg>"))
    else {
        return drawing.to_string();
    };
    let ring = format!(r#"<circle class="ring" cx="{x}" cy="{y}" r="24"/>"#);
    format!("{before}{ring}\n</svg>{after}")
}

/// The drawing with ids and classes of its own, so that two versions of it can stand on one page.
fn apart(drawing: &str, name: &str, version: &str) -> String {
    let id = format!("fig-{}", name.replace('_', "-"));
    drawing.replace(&id, &format!("{version}-{id}"))
}
