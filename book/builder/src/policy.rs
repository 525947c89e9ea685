//! The content security policy of the book's pages: what a browser may load and run on them.
//!
//! A page loads files of the book and nothing else, and runs the scripts of those files and the
//! few that mdBook writes into the frame of every page, by their hashes. A script in the text of a
//! chapter, in an attribute or in an address does not run.
//!
//! Styles stand inline on most pages: KaTeX gives the parts of a formula their heights, and mdBook
//! the cells of a table their alignment, both as attributes, which no hash can name.

use std::collections::BTreeSet;

use anyhow::{Context, Result};

use crate::page_files::has_lab;
use pendula_output::page::hash;

/// The line after which mdBook's pages have their policy.
pub const CHARSET: &str = "<meta charset=\"UTF-8\">";

/// The page with its policy, before anything that it is about.
pub fn with_policy(page: &str) -> Result<String> {
    let (before, after) = page.split_once(CHARSET).context("a page without its encoding")?;
    let policy = policy(page);
    Ok(format!(
        "{before}{CHARSET}\n        \
         <meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">{after}"
    ))
}

fn policy(page: &str) -> String {
    let hashes = inline_scripts(&frame(page)).into_iter().map(hash).collect::<BTreeSet<_>>();
    let mut scripts = String::from("'self'");
    for hash in hashes {
        scripts += &format!(" {hash}");
    }
    // The lab and the figures that it moves, of class "lab-figure", are compiled in the browser,
    // which is allowed on their pages alone.
    if has_lab(page) {
        scripts += " 'wasm-unsafe-eval'";
    }
    // The page for what is not found says where the book begins.
    let base = if page.contains("<base ") { "'self'" } else { "'none'" };
    // The sign for copying a listing is an image within mdBook's style sheet; without scripts the
    // contents are a frame.
    format!(
        "default-src 'none'; script-src {scripts}; style-src 'self' 'unsafe-inline'; \
         img-src 'self' data:; font-src 'self'; frame-src 'self'; base-uri {base}; \
         form-action 'none'"
    )
}

/// What mdBook writes around the text of a chapter.
fn frame(page: &str) -> String {
    let start = page.find("<main>").unwrap_or(page.len());
    let end = page.rfind("</main>").unwrap_or(page.len()).max(start);
    format!("{}{}", &page[..start], &page[end..])
}

/// The text of each script that is not in a file of its own.
fn inline_scripts(html: &str) -> Vec<&str> {
    let scripts = html.split("<script>").skip(1);
    scripts.filter_map(|rest| Some(rest.split_once("</script>")?.0)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "<html><head><meta charset=\"UTF-8\"><title>x</title>\
        <script>let a;</script><script src=\"book.js\"></script></head><body><main>\
        <script>let b;</script></main><script>let c;</script></body></html>";

    /// Catches: a script of a chapter, which anybody may have written, taken for one of the frame;
    /// one of the frame left out, so that the page is broken.
    #[test]
    fn scripts_of_the_frame_run_and_those_of_the_text_do_not() {
        let page = with_policy(PAGE).unwrap();
        for (script, runs) in [("let a;", true), ("let b;", false), ("let c;", true)] {
            assert_eq!(page.contains(&hash(script)), runs, "{script}");
        }
        assert_eq!(page.matches("'sha256-").count(), 2);
    }

    /// Catches: text that ends the chapter for the builder, and not for the reader.
    #[test]
    fn a_chapter_ends_where_the_last_one_ends() {
        let page = PAGE.replace("let b;", "let b;</script></main><script>let d;");
        assert!(!policy(&page).contains(&hash("let d;")));
    }

    /// Catches: a policy after the first script, which has run by then; compilation allowed on
    /// pages that have no lab.
    #[test]
    fn the_policy_stands_before_every_script() {
        let page = with_policy(PAGE).unwrap();
        assert!(page.find("Content-Security-Policy") < page.find("<script"));
        assert!(!page.contains("wasm"));
        assert!(
            policy(&PAGE.replace("<main>", "<main><div class=\"lab whole\">")).contains("wasm")
        );
    }
}
