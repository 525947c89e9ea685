//! Texts and numbers for a page.

/// A number with two digits, without an exponent; a dash where there is none.
pub fn number(value: Option<f64>) -> String {
    let Some(value) = value.filter(|it| it.is_finite()) else { return "–".to_string() };
    if value < 10.0 {
        return format!("{value:.1}");
    }
    let rounded: f64 = format!("{value:.1e}").parse().unwrap_or(value);
    format!("{rounded:.0}")
}

/// A text for Markdown, as it stands.
pub fn plain(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        if "\\`*_{}[]<>#|$~&".contains(c) {
            out.push('\\');
        }
        out.push(if c == '\n' { ' ' } else { c });
    }
    out
}

/// A text for HTML, as it stands.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
