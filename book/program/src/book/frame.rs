//! What mdBook writes around every page, mended: names and states stand on the elements that may
//! have them, the bar at the top is a landmark, the first Tab leads to a link past the contents,
//! the printer prints the page, and a page that a reader comes back to is as it was left.
//!
//! Each change is of a text that mdBook writes. One that is not there any more stops the build.

use anyhow::{Result, ensure};

/// The label of the button for the contents, which may have neither a name nor a state; the box
/// that it belongs to may.
const PAGE: [(&str, &str); 6] = [
    (" aria-label=\"Toggle Table of Contents\" aria-controls=\"mdbook-sidebar\">", ">"),
    (
        "id=\"mdbook-sidebar-toggle-anchor\" class=\"hidden\">",
        "id=\"mdbook-sidebar-toggle-anchor\" class=\"hidden\" aria-label=\"Contents\" \
         aria-controls=\"mdbook-sidebar\">",
    ),
    (
        "document.getElementById('mdbook-sidebar-toggle').setAttribute('aria-expanded'",
        "document.getElementById('mdbook-sidebar-toggle-anchor').setAttribute('aria-expanded'",
    ),
    ("class=\"menu-bar sticky\"", "class=\"menu-bar sticky\" role=\"banner\""),
    (
        "<div id=\"mdbook-body-container\">",
        "<a class=\"skip\" href=\"#mdbook-content\">Skip to the text</a>\n    \
         <div id=\"mdbook-body-container\">",
    ),
    // A script of ours (book/theme/copy.js) prints; without scripts it leads to the whole book.
    (
        "title=\"Print this book\" aria-label=\"Print this book\"",
        "class=\"printer\" title=\"Print this page\" aria-label=\"Print this page\"",
    ),
];

/// Of mdBook's script: the same state, a line for an old browser that has every browser forget a
/// page that is left, the sheets of listings that it turns on and off, which are one with the rest
/// ([`super::sheets`]), and the search for a program's words in code that is no listing.
const SCRIPT: [(&str, &str); 6] = [
    (
        "sidebarToggleButton.setAttribute('aria-expanded'",
        "sidebarCheckbox.setAttribute('aria-expanded'",
    ),
    ("window.onunload = function() { };\n", ""),
    ("document.querySelector('#mdbook-ayu-highlight-css')", "{}"),
    ("document.querySelector('#mdbook-tomorrow-night-css')", "{}"),
    ("document.querySelector('#mdbook-highlight-css')", "{}"),
    (
        "} else {\n        code_nodes.forEach(",
        "} else {\n        code_nodes.filter(code => code.matches('pre > code')).forEach(",
    ),
];

/// A page with its frame mended. The contents alone, which mdBook shows in a frame where there are
/// no scripts, have none.
pub fn page(page: &str) -> Result<String> {
    if page.contains("id=\"mdbook-menu-bar\"") { mended(page, &PAGE) } else { Ok(page.to_string()) }
}

/// mdBook's script, mended.
pub fn script(script: &str) -> Result<String> {
    mended(script, &SCRIPT)
}

fn mended(text: &str, changes: &[(&str, &str)]) -> Result<String> {
    let mut text = text.to_string();
    for (from, to) in changes {
        // The print page has no printer.
        ensure!(
            text.contains(from) || from.contains("Print this"),
            "mdBook no longer writes {from}"
        );
        text = text.replace(from, to);
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: a change of mdBook after which nothing is mended, in silence.
    #[test]
    fn what_is_not_there_any_more_is_an_error() {
        assert_eq!(page("<p>the contents</p>").unwrap(), "<p>the contents</p>");
        let error = page("<div id=\"mdbook-menu-bar\">").unwrap_err().to_string();
        assert!(error.starts_with("mdBook no longer writes  aria-label="), "{error}");
        assert!(script("let other;").is_err());
    }
}
