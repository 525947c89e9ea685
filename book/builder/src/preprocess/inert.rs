//! Text and HTML that Markdown leaves unchanged.
//!
//! mdBook parses a chapter again after this preprocessor, and would take `a_1*b_2` for emphasis,
//! `|` for a new cell and primes for curly quotes. It never does so with character references.

use crate::{Pattern, pattern};

/// `text` as HTML without active Markdown characters.
pub fn text(text: &str) -> String {
    let mut inert = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            _ if c.is_ascii_punctuation() => inert += &format!("&#{};", u32::from(c)),
            '\n' | '\r' => inert.push(' '),
            _ => inert.push(c),
        }
    }
    inert
}

/// `html` with its text made inert, its tags' attributes in alphabetical order and its line breaks
/// as spaces.
///
/// katex-rs keeps attributes in a hash map, and so writes them in a different order in each
/// process.
pub fn html(html: &str) -> String {
    // A tag, or a reference such as `&amp;`, which stands for a character already.
    static MARKUP: Pattern = Pattern::new(|| {
        let tag = r#"(?<name></?[^\s/<>]+)(?<attributes>(?:"[^"]*"|'[^']*'|[^"'<>])*?)(?<end>/?>)"#;
        pattern(&format!("{tag}|&[^;]*;"))
    });
    static ATTRIBUTE: Pattern = Pattern::new(|| pattern(r#"(?:"[^"]*"|'[^']*'|[^"'\s])+"#));
    let (mut inert, mut done) = (String::with_capacity(html.len() * 2), 0);
    for found in MARKUP.captures_iter(html) {
        let markup = found.get_match();
        inert += &text(&html[done..markup.start()]);
        done = markup.end();
        let Some(attributes) = found.name("attributes") else {
            inert += markup.as_str();
            continue;
        };
        let mut attributes: Vec<&str> =
            ATTRIBUTE.find_iter(attributes.as_str()).map(|found| found.as_str()).collect();
        attributes.sort_unstable();
        inert += &found["name"];
        for attribute in attributes {
            inert.push(' ');
            // A table cell ends at `|` even inside a tag.
            inert += &attribute.replace(['\n', '\r'], " ").replace('|', "&#124;");
        }
        inert += &found["end"];
    }
    inert + &text(&html[done..])
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// What a browser makes of references, but those such as `&lt;`.
    pub fn shown(inert: &str) -> String {
        let mut parts = inert.split("&#");
        let mut shown = parts.next().unwrap().to_string();
        for part in parts {
            let (code, rest) = part.split_once(';').unwrap();
            shown.push(char::from_u32(code.parse().unwrap()).unwrap());
            shown.push_str(rest);
        }
        shown
    }

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
