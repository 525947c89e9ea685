//! Formulas, typeset by KaTeX in Rust: HTML for the screen, MathML for screen readers. No script
//! runs in the reader's browser.

use std::borrow::Cow;

use anyhow::{Result, anyhow, ensure};
use katex::{KatexContext, OutputFormat, Settings, StrictMode, StrictSetting, render_to_string};

use super::inert;
use crate::{Pattern, pattern};

/// A typesetter; constructing one takes longer than typesetting a formula, so the whole book shares
/// one.
#[derive(Default)]
pub struct Maths(KatexContext);

impl Maths {
    /// The HTML of a formula, safe to stand in Markdown.
    pub fn set(&self, tex: &str, display: bool) -> Result<String> {
        let settings = Settings::builder()
            .display_mode(display)
            .output(OutputFormat::HtmlAndMathml)
            .throw_on_error(true)
            .strict(StrictSetting::Mode(StrictMode::Error))
            .build();
        let html = render_to_string(&self.0, tex, &settings)
            .map_err(|error| anyhow!("formula {}: {error}", tex.trim()))?;
        ensure!(!has_bare_root(tex), "formula {}: write \\sqrt{{…}} with braces", tex.trim());
        Ok(inert::html(&without_annotations(&html)))
    }
}

/// Whether there is a root of a bare symbol, `\sqrt2`: katex-rs draws the root sign over it.
fn has_bare_root(tex: &str) -> bool {
    tex.split(r"\sqrt").skip(1).any(|argument| !argument.trim_start().starts_with(['{', '[']))
}

/// KaTeX repeats the TeX source in an annotation, which is invisible but gets into the search
/// index.
fn without_annotations(html: &str) -> Cow<'_, str> {
    static ANNOTATION: Pattern = Pattern::new(|| pattern("(?s)<annotation .*?</annotation>"));
    ANNOTATION.replace_all(html, "")
}

#[cfg(test)]
mod tests {
    use super::*;

    const PENDULUM: &str = r"\ddot\theta + \frac{g}{L}\sin\theta = 0";

    /// Catches: a root sign that covers its argument.
    #[test]
    fn roots_need_their_braces() {
        let maths = Maths::default();
        assert!(maths.set(r"2\sqrt2", false).unwrap_err().to_string().contains("braces"));
        let html = maths.set(r"2\sqrt{2} + \sqrt[3]{x}", false).unwrap();
        assert!(html.contains("padding-left") || html.contains("padding&#45;left"), "{html}");
    }

    /// Catches: only one of the two outputs, for the eye or for a screen reader.
    #[test]
    fn there_is_html_and_mathml() {
        let html = Maths::default().set(PENDULUM, false).unwrap();
        assert!(html.contains("katex-html") && html.contains("<math"), "{html}");
    }
}
