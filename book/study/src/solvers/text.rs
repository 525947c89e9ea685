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

/// A text for Markdown with the powers of a tolerance raised: `tol^(−1/q)`, `tol^0.8`.
pub fn raised(text: &str) -> String {
    let mut parts = text.split("tol^");
    let mut out = parts.next().unwrap_or_default().to_string();
    for part in parts {
        let bracketed = part.strip_prefix('(').and_then(|rest| rest.split_once(')'));
        let (power, rest) = bracketed.unwrap_or_else(|| {
            let is_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '−');
            part.split_at(part.find(|c| !is_number(c)).unwrap_or(part.len()))
        });
        out += &format!("tol<sup>{power}</sup>{rest}");
    }
    out
}

/// A text for HTML, as it stands.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: a power left as it is typed, or one that takes the text after it along.
    #[test]
    fn powers_of_a_tolerance_are_raised() {
        assert_eq!(
            raised("grow as tol^(−1/q) with q = 2, the error as tol^0.8 ± 0.1; 2^3"),
            "grow as tol<sup>−1/q</sup> with q = 2, the error as tol<sup>0.8</sup> ± 0.1; 2^3"
        );
        assert_eq!(raised("the tolerance"), "the tolerance");
    }
}
