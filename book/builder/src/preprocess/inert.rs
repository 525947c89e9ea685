//! Text and HTML that Markdown leaves unchanged.
//!
//! mdBook parses a chapter again after this preprocessor, and would take `a_1*b_2` for emphasis,
//! `|` for a new cell and primes for curly quotes. It never does so with character references.

use std::fmt::Write;

/// `text` as HTML without active Markdown characters.
pub fn text(text: &str) -> String {
    let mut inert = String::with_capacity(text.len());
    push_text(&mut inert, text);
    inert
}

/// `html` with its text made inert, its tags' attributes in alphabetical order and its line breaks
/// as spaces.
///
/// katex-rs keeps attributes in a hash map, and so writes them in a different order in each
/// process.
pub fn html(html: &str) -> String {
    let mut inert = String::with_capacity(html.len() * 2);
    let mut rest = html;
    while !rest.is_empty() {
        if rest.starts_with('<') {
            let (tag, after) = rest.split_at(tag_length(rest));
            push_tag(&mut inert, tag);
            rest = after;
        } else {
            let (between, after) = rest.split_at(rest.find('<').unwrap_or(rest.len()));
            push_escaped_text(&mut inert, between);
            rest = after;
        }
    }
    inert
}

fn push_text(inert: &mut String, text: &str) {
    for c in text.chars() {
        match c {
            _ if c.is_ascii_punctuation() => {
                write!(inert, "&#{};", u32::from(c)).expect("a String takes everything");
            }
            '\n' | '\r' => inert.push(' '),
            _ => inert.push(c),
        }
    }
}

/// As [`push_text`], for text in which `&amp;` and the like already stand for characters.
fn push_escaped_text(inert: &mut String, mut text: &str) {
    while let Some(start) = text.find('&') {
        push_text(inert, &text[..start]);
        text = &text[start..];
        let reference = text.find(';').map_or(1, |end| end + 1);
        inert.push_str(&text[..reference]);
        text = &text[reference..];
    }
    push_text(inert, text);
}

/// The length of the tag that `html` begins with; a `>` inside quotes does not end it.
fn tag_length(html: &str) -> usize {
    let mut quote = None;
    for (at, c) in html.char_indices() {
        match (quote, c) {
            (None, '"' | '\'') => quote = Some(c),
            (Some(open), _) if open == c => quote = None,
            (None, '>') => return at + 1,
            _ => {}
        }
    }
    html.len()
}

fn push_tag(inert: &mut String, tag: &str) {
    let tag = tag.trim_start_matches('<').trim_end_matches('>');
    let (tag, close) = match tag.strip_suffix('/') {
        Some(tag) => (tag, "/>"),
        None => (tag, ">"),
    };
    let (name, rest) = tag.split_at(tag.find(char::is_whitespace).unwrap_or(tag.len()));
    let mut attributes = attributes(rest);
    attributes.sort_unstable();
    inert.push('<');
    inert.push_str(name);
    for attribute in attributes {
        inert.push(' ');
        // A table cell ends at `|` even inside a tag.
        inert.push_str(&attribute.replace(['\n', '\r'], " ").replace('|', "&#124;"));
    }
    inert.push_str(close);
}

/// Splits `a="1" b='2 3' c` at the spaces outside quotes.
fn attributes(text: &str) -> Vec<&str> {
    let mut quote = None;
    text.split(|c: char| {
        match quote {
            None if c == '"' || c == '\'' => quote = Some(c),
            Some(open) if open == c => quote = None,
            _ => {}
        }
        quote.is_none() && c.is_whitespace()
    })
    .filter(|attribute| !attribute.is_empty())
    .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: a subscript read as emphasis, a norm as a cell's end, primes as curly quotes.
    #[test]
    fn no_active_character_is_left_in_text() {
        assert_eq!(text("a_1*|b|'"), "a&#95;1&#42;&#124;b&#124;&#39;");
        assert_eq!(html("<b>a_1</b>"), "<b>a&#95;1</b>");
    }

    /// Catches: `&lt;` escaped twice, which shows as `&lt;` on the page.
    #[test]
    fn character_references_stay() {
        assert_eq!(html("<i>a &lt; b</i>"), "<i>a &lt; b</i>");
    }

    /// Catches: pages that differ from run to run.
    #[test]
    fn attributes_are_in_order() {
        assert_eq!(html("<mo stretchy=\"false\" form='a > b' lspace=\"0\">"), {
            "<mo form='a > b' lspace=\"0\" stretchy=\"false\">"
        });
        assert_eq!(html("<path d=\"M1 2\" a=\"|\"/>"), "<path a=\"&#124;\" d=\"M1 2\"/>");
    }
}
