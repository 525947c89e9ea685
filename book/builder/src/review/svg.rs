//! Figures read back: the little of XML that our charts write. All else is an error, so that
//! nothing is passed over.

use anyhow::{Context, Result};

/// A piece of a figure, in the order in which they are written.
#[derive(Clone, Debug, PartialEq)]
pub enum Piece<'a> {
    /// An element begins: its name, and its attributes as they stand.
    Begin(&'a str, Vec<(&'a str, String)>),
    /// Text that is more than blanks.
    Text(String),
    /// The innermost element ends.
    End,
}

/// The pieces of a figure.
///
/// # Errors
/// If it is not one element, well-formed, in the part of XML that our charts write.
pub fn pieces(figure: &str) -> Result<Vec<Piece<'_>>> {
    read(figure).context("a figure is not written as our charts write it")
}

fn read(figure: &str) -> Option<Vec<Piece<'_>>> {
    let (mut pieces, mut open, mut rest) = (Vec::new(), Vec::new(), figure);
    while let Some((text, after)) = rest.split_once('<') {
        if !text.trim().is_empty() {
            pieces.push(Piece::Text(plain(text)?));
        }
        let (tag, after) = after.split_once('>')?;
        rest = after;
        if open.is_empty() && !pieces.is_empty() {
            return None;
        }
        if let Some(name) = tag.strip_prefix('/') {
            if open.pop() != Some(name) {
                return None;
            }
            pieces.push(Piece::End);
            continue;
        }
        let (tag, is_empty) = tag.strip_suffix('/').map_or((tag, false), |tag| (tag, true));
        let (name, attributes) = tag.split_once(char::is_whitespace).unwrap_or((tag, ""));
        pieces.push(Piece::Begin(named(name)?, self::attributes(attributes)?));
        if is_empty {
            pieces.push(Piece::End);
        } else {
            open.push(name);
        }
    }
    (open.is_empty() && rest.trim().is_empty() && !pieces.is_empty()).then_some(pieces)
}

fn attributes(mut text: &str) -> Option<Vec<(&str, String)>> {
    let mut attributes: Vec<(&str, String)> = Vec::new();
    while !text.trim().is_empty() {
        let (name, rest) = text.trim_start().split_once("=\"")?;
        let (value, rest) = rest.split_once('"')?;
        if attributes.iter().any(|known| known.0 == name) {
            return None;
        }
        attributes.push((named(name)?, plain(value)?));
        text = rest;
    }
    Some(attributes)
}

/// The name of an element or an attribute.
fn named(name: &str) -> Option<&str> {
    let is_name = |name: &str| name.chars().all(|c| c.is_ascii_alphanumeric() || c == '-');
    (!name.is_empty() && is_name(name)).then_some(name)
}

/// Text as it is read, its line breaks as they stand.
fn plain(text: &str) -> Option<String> {
    let mut parts = text.split('&');
    let mut plain = parts.next()?.to_string();
    for part in parts {
        let (name, rest) = part.split_once(';')?;
        plain.push(match name {
            "amp" => '&',
            "lt" => '<',
            "gt" => '>',
            "quot" => '"',
            _ => return None,
        });
        plain.push_str(rest);
    }
    Some(plain)
}

/// What is in the element that has begun before `pieces`, and what comes after it.
pub fn inner<'p, 'a>(pieces: &'p [Piece<'a>]) -> (&'p [Piece<'a>], &'p [Piece<'a>]) {
    let mut depth = 1;
    let end = pieces.iter().position(|piece| {
        match piece {
            Piece::Begin(..) => depth += 1,
            Piece::End => depth -= 1,
            Piece::Text(_) => {}
        }
        depth == 0
    });
    // Every element ends: `read` sees to it.
    let end = end.unwrap_or(pieces.len());
    (&pieces[..end], pieces.get(end + 1..).unwrap_or_default())
}

/// The numbers of a list, which blanks or commas separate.
pub fn numbers(list: &str) -> Option<Vec<f64>> {
    let parts = list.split([' ', ',', '\n']).filter(|part| !part.is_empty());
    parts.map(number).collect()
}

/// A finite number.
pub fn number(text: &str) -> Option<f64> {
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use roxmltree::{Document, Node};

    use super::*;

    /// The pieces of a node, as a reader of all XML has them.
    fn read_by_another(node: Node<'_, '_>, pieces: &mut Vec<Piece<'static>>) {
        let stays = |text: &str| -> &'static str { text.to_string().leak() };
        if node.is_element() {
            let namespace = node.tag_name().namespace().filter(|_| node.has_tag_name("svg"));
            let namespace = namespace.map(|uri| ("xmlns", uri.to_string()));
            let attributes =
                node.attributes().map(|known| (stays(known.name()), known.value().to_string()));
            let attributes = namespace.into_iter().chain(attributes).collect();
            pieces.push(Piece::Begin(stays(node.tag_name().name()), attributes));
            node.children().for_each(|child| read_by_another(child, pieces));
            pieces.push(Piece::End);
        } else if let Some(text) = node.text().filter(|text| !text.trim().is_empty()) {
            pieces.push(Piece::Text(text.to_string()));
        }
    }

    /// In an attribute a line break is a blank.
    fn on_a_line(mut pieces: Vec<Piece<'_>>) -> Vec<Piece<'_>> {
        for piece in &mut pieces {
            if let Piece::Begin(_, attributes) = piece {
                attributes.iter_mut().for_each(|(_, value)| *value = value.replace('\n', " "));
            }
        }
        pieces
    }

    /// Catches: an element, an attribute or a letter of a figure that is lost, or read otherwise
    /// than by a reader of all XML; a chart that writes what cannot be read back.
    #[test]
    fn every_figure_is_read_as_it_is() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../snapshots");
        let mut count = 0;
        for entry in fs::read_dir(folder).unwrap() {
            let snapshot = fs::read_to_string(entry.unwrap().path()).unwrap();
            let Some((_, figure)) = snapshot.split_once("<!-- ANCHOR: figure -->") else {
                continue;
            };
            let (figure, _) = figure.split_once("<!-- ANCHOR_END").unwrap();
            let document = Document::parse(figure).unwrap();
            let mut expected = Vec::new();
            read_by_another(document.root_element(), &mut expected);
            assert_eq!(on_a_line(pieces(figure).unwrap()), expected);
            count += 1;
        }
        assert!(count > 30, "{count} figures");
    }

    /// Catches: an escape, a blank or an empty element that is read as another; a depth that is
    /// miscounted.
    #[test]
    fn pieces_stand_in_their_order() {
        let read =
            pieces("<a b=\"1\nc\" d=\"&quot;\">\n<e/> &amp;&lt;\n<f><g>h></g></f></a>\n").unwrap();
        let begin = |name| Piece::Begin(name, Vec::new());
        let said = |text: &str| Piece::Text(text.to_string());
        let first = vec![("b", "1\nc".to_string()), ("d", "\"".to_string())];
        let expected = [
            Piece::Begin("a", first),
            begin("e"),
            Piece::End,
            said(" &<\n"),
            begin("f"),
            begin("g"),
            said("h>"),
            Piece::End,
            Piece::End,
            Piece::End,
        ];
        assert_eq!(read, expected);
        assert_eq!(inner(&read[5..]), (&expected[5..8], &expected[9..]));
        assert_eq!(inner(&read[2..]), (&[][..], &expected[3..]));
    }

    /// Catches: what our charts never write, passed over as if it were not there.
    #[test]
    fn what_our_charts_do_not_write_is_an_error() {
        for figure in [
            "",
            "a",
            "<a>",
            "</a>",
            "<a></b>",
            "<a><b></a></b>",
            "<a/><b/>",
            "<a/>b",
            "a<b/>",
            "<a b=1/>",
            "<a b='1'/>",
            "<a b/>",
            "<a b=\"1/>",
            "<a b=\"1\" b=\"2\"/>",
            "<a b:c=\"1\"/>",
            "<b:a/>",
            "< a/>",
            "<a>&nbsp;</a>",
            "<a>&#60;</a>",
            "<a>& b</a>",
            "<a b=\"&\"/>",
            "<?xml version=\"1.0\"?><a/>",
            "<!DOCTYPE a><a/>",
            "<a><!-- b --></a>",
            "<a><![CDATA[b]]></a>",
        ] {
            assert!(pieces(figure).is_err(), "{figure}");
        }
        for list in ["1-2", "1e400", "nan", "1,inf", "1;2"] {
            assert_eq!(numbers(list), None, "{list}");
        }
        assert_eq!(numbers(" 1,-2.5\n3 "), Some(vec![1.0, -2.5, 3.0]));
    }
}
