//! Text of others, which may be anything, as it can be shown.

/// The text with an escape such as `\u{1b}` for each character that would move the cursor, hide
/// what stands beside it or turn it around. Ends of lines and tabs stay.
pub fn printable(text: &str) -> String {
    let mut shown = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\n' | '\t' | '"' | '\'' | '\\' | '\u{a0}' => shown.push(c),
            // The dots of θ̈ and ω̇, which belong to the letter before them.
            '\u{307}' | '\u{308}' if shown.ends_with(['θ', 'ω']) => shown.push(c),
            _ => shown.extend(c.escape_debug()),
        }
    }
    shown
}

/// The text as it can be shown, as HTML or XML.
pub fn escaped(text: &str) -> String {
    let text = printable(text);
    let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    text.replace('"', "&quot;").replace('\'', "&#x27;")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: an escape sequence that reaches the terminal, a mark that turns text around; a
    /// letter, a quote or a line that does not stay.
    #[test]
    fn what_cannot_be_shown_is_escaped() {
        assert_eq!(printable("a\u{1b}[2J\u{202e}\r\0"), r"a\u{1b}[2J\u{202e}\r\0");
        let plain = "θ̈ = −θ̇, \"θ₀ = 2.01 × 10⁻⁴\u{a0}J\", 'Störmer–Verlet'\\\n\t≠ —";
        assert_eq!(printable(plain), plain);
    }
}
