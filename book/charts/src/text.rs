//! Text inside a figure: XML escaping, `^{…}` and `_{…}`, and an estimate of its width.

use super::path::{Num, Point};

/// Height of the letters, in units of the view box (which is 600 wide).
pub(super) const FONT: f64 = 17.0;
const SMALL: f64 = 0.72;

/// Text that is safe between tags and in attributes, on one line, with typographic apostrophes.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push('’'),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

/// `text` with a line break for the blank at which a line would grow longer than a screen is wide.
/// Where it is shown, a line break is a blank.
pub fn wrapped(text: &str) -> String {
    let mut lines = String::with_capacity(text.len());
    let mut width = 0;
    for word in text.split(' ') {
        let longer = width + 1 + word.chars().count();
        if lines.is_empty() || longer > 100 {
            lines.push_str(if lines.is_empty() { "" } else { "\n" });
            width = word.chars().count();
        } else {
            lines.push(' ');
            width = longer;
        }
        lines.push_str(word);
    }
    lines
}

/// `text` with the true minus sign instead of the hyphen.
pub(super) fn minus(text: &str) -> String {
    text.replace('-', "−")
}

/// Markup cut into pieces, each with the distance by which it is lowered (negative: raised).
fn pieces(markup: &str) -> Vec<(i32, &str)> {
    let mut pieces = Vec::new();
    let (mut plain, mut from) = (0, 0);
    while let Some(mark) = markup[from..].find(['^', '_']).map(|i| from + i) {
        from = mark + 1;
        let Some(inner) = markup[from..].strip_prefix('{') else {
            continue;
        };
        let Some(length) = inner.find('}') else { break };
        pieces.push((0, &markup[plain..mark]));
        pieces.push((if markup[mark..].starts_with('^') { -6 } else { 5 }, &inner[..length]));
        from += length + 2;
        plain = from;
    }
    pieces.push((0, &markup[plain..]));
    pieces.retain(|(_, text)| !text.is_empty());
    pieces
}

/// A tilde over the letter before it, U+0303, which many fonts put through a capital.
const TILDE: char = '\u{303}';

/// The inside of a `<text>` element.
pub(super) fn spans(markup: &str) -> String {
    /// The tilde by itself is put over a capital H, as wide as in most fonts: so far to the left
    /// and up, and then so far to the right.
    const BACK: (f64, i32, f64) = (-10.4, -3, 2.0);
    let mut out = String::new();
    let (mut height, mut aside) = (0, 0.0);
    for (level, text) in pieces(markup) {
        for (i, part) in text.split(TILDE).enumerate() {
            if i > 0 {
                let (dx, up, forward) = BACK;
                let dy = level + up - height;
                out += &format!(r#"<tspan dx="{dx}" dy="{dy}">˜</tspan>"#);
                (height, aside) = (level + up, forward);
            }
            if part.is_empty() {
                continue;
            }
            let (part, shift, small) = (escape(part), level - height, (FONT * SMALL).round());
            let dx = if aside == 0.0 { String::new() } else { format!(r#" dx="{aside}""#) };
            out += &match (shift, level) {
                (0, 0) => part,
                (_, 0) => format!(r#"<tspan{dx} dy="{shift}">{part}</tspan>"#),
                _ => format!(r#"<tspan{dx} dy="{shift}" font-size="{small}">{part}</tspan>"#),
            };
            (height, aside) = (level, 0.0);
        }
    }
    out
}

/// About how wide the markup is drawn; a little generous, since the reader's font is unknown.
pub fn width(markup: &str) -> f64 {
    let em = |c: char| match c {
        TILDE => 0.0,
        'i' | 'j' | 'l' | 'I' | '.' | ',' | ':' | ';' | '\'' | '|' | ' ' => 0.3,
        'f' | 'r' | 't' | '(' | ')' | '/' | '-' => 0.4,
        'm' | 'w' | 'M' | 'W' => 0.95,
        '−' | '×' | '+' | '=' | '<' | '>' => 0.84,
        c if c.is_uppercase() => 0.7,
        _ => 0.62,
    };
    let of = |(level, text): (i32, &str)| {
        let size = if level == 0 { FONT } else { FONT * SMALL };
        size * text.chars().map(em).sum::<f64>()
    };
    pieces(markup).into_iter().map(of).sum()
}

/// Adds an element, on its own line.
pub fn line(out: &mut String, element: String) {
    out.push_str(&element);
    out.push('\n');
}

/// Adds a text; `anchor` says which part of it is at the point.
pub fn draw_text(out: &mut String, class: &str, at: Point, anchor: &str, markup: &str) {
    let attribute = |name: &str, value: &str, default: &str| match value {
        value if value == default => String::new(),
        value => format!(r#" {name}="{value}""#),
    };
    let class = attribute("class", class, "");
    let anchor = attribute("text-anchor", anchor, "start");
    let (x, y) = (Num(at.0), Num(at.1));
    line(out, format!(r#"<text{class} x="{x}" y="{y}"{anchor}>{}</text>"#, spans(markup)));
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: a title with `<`, `&` or a line break that ends the SVG or the Markdown block.
    #[test]
    fn escapes_what_xml_and_markdown_would_read() {
        assert_eq!(escape("a<b & \"c's\">\n\nd"), "a&lt;b &amp; &quot;c’s&quot;&gt;  d");
    }

    /// Catches: a panic or lost text where `^`, `_` or `{` is not markup.
    #[test]
    fn stray_markup_is_plain_text() {
        for plain in ["a_b ^ c", "x^{2", "θ_", "", "}{"] {
            assert_eq!(spans(plain), plain);
        }
    }
}
