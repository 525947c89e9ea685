//! What a page loads, and when: the scripts and styles of the lab where there is one, and nowhere
//! else; and its fonts before its text is set, so that no line is set twice.
//!
//! The lab's scripts are joined to one, without comments, which another loads when it is near.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

use crate::policy::CHARSET;
use pendula_output::files;

/// Where the lab's files stand in the book.
const FOLDER: &str = "theme/lab/";

/// What all scripts are joined to, and the script that loads it.
const BUNDLE: &str = "theme/lab/bundle.js";
const LOADER: &str = "theme/lab/near.js";

/// How book/theme/head.hbs names the picture of a link.
const PICTURE: &str = "<meta property=\"og:image\" content=\"";

/// Joins the scripts of the lab, in the order in which `scripts` names them, in the folder of the
/// pages, if there are any.
pub fn join<P: AsRef<Path>>(pages: &Path, scripts: &[P]) -> Result<()> {
    let mut bundle = String::new();
    for script in scripts.iter().map(AsRef::as_ref) {
        if !script.starts_with(FOLDER) || script == Path::new(LOADER) {
            continue;
        }
        let text = files::text(&pages.join(script))?;
        let is_code = |line: &&str| !line.trim_start().starts_with("//");
        bundle.extend(text.split_inclusive('\n').filter(is_code));
    }
    if bundle.is_empty() {
        return Ok(());
    }
    let file = pages.join(BUNDLE);
    fs::write(&file, bundle).with_context(|| file.display().to_string())
}

/// Whether the page has a lab, or a figure that the lab's library moves.
pub fn has_lab(page: &str) -> bool {
    page.contains("class=\"lab")
}

/// The page with the files that it needs: without the scripts that were joined, without any of the
/// lab's files if it has no lab, and with its fonts called for; with the picture for who posts a
/// link, if `site` is a whole address, as that picture's has to be.
pub fn linked(page: &str, site: &str) -> String {
    let with_lab = has_lab(page);
    let with_picture = site.contains("://");
    let stays = |line: &&str| {
        let tag = line.trim_start();
        if tag.starts_with(PICTURE) {
            return with_picture;
        }
        let script = tag.starts_with("<script src=\"");
        let of_the_lab = (script || tag.starts_with("<link ")) && tag.contains(FOLDER);
        !of_the_lab || with_lab && (!script || tag.contains(LOADER))
    };
    let linked: String = page.split_inclusive('\n').filter(stays).collect();
    let linked = linked.replacen(PICTURE, &format!("{PICTURE}{site}"), 1);
    let linked = linked.replace("<img src=", "<img loading=\"lazy\" src=");
    linked.replacen(CHARSET, &format!("{CHARSET}{}", fonts(page)), 1)
}

/// The script that calls for the fonts of the page. From a disk a browser refuses to load them so
/// early.
fn fonts(page: &str) -> String {
    const KINDS: [(&str, &str); 5] = [
        ("<body", "fonts/open-sans-regular"),
        ("<h1", "fonts/open-sans-600"),
        ("<code", "fonts/source-code-pro-500"),
        ("<em>", "fonts/open-sans-italic"),
        ("class=\"katex", "assets/katex/fonts/KaTeX_Main-Regular"),
    ];
    let kinds = KINDS.iter().filter(|(sign, _)| page.contains(sign));
    let mut names: Vec<&str> = kinds.map(|(_, name)| *name).collect();
    if page.contains("class=\"mord mathnormal") {
        names.push("assets/katex/fonts/KaTeX_Math-Italic");
    }
    // Where the root of the book is, as the page says it.
    let before = page.split_once("fonts/fonts.css\"").map_or("", |(before, _)| before);
    let root = before.rsplit_once('"').map_or("", |(_, root)| root);
    format!(
        "\n        <script>if (location.protocol !== 'file:') for (const name of {names:?}) \
         document.head.append(Object.assign(document.createElement('link'), {{rel: 'preload', \
         as: 'font', type: 'font/woff2', crossOrigin: '', href: `{root}${{name}}.woff2`}}));\
         </script>"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "\
        <link rel=\"stylesheet\" href=\"../theme/pendula.css\">\n\
        <link rel=\"stylesheet\" href=\"../theme/lab/lab.css\">\n\
        <main>\n\
        <p>theme/lab/words.js</p>\n\
        </main>\n\
        <script src=\"../book.js\"></script>\n\
        <script src=\"../theme/lab/words.js\"></script>\n\
        <script src=\"../theme/lab/near.js\"></script>\n";

    /// Catches: a page without a lab that loads it; another file or the text lost with it.
    #[test]
    fn a_page_without_a_lab_loads_nothing_of_it() {
        let page = linked(PAGE, "./");
        assert_eq!(page.matches("theme/lab/").count(), 1);
        assert_eq!(page.lines().count(), PAGE.lines().count() - 3);
    }

    /// Catches: a font called for that the page does not show, of which a browser complains; a font
    /// of another folder.
    #[test]
    fn a_page_calls_for_its_own_fonts() {
        let head = format!("{CHARSET}<link href=\"../../fonts/fonts.css\"><body><h1>x</h1>");
        let page = linked(&head, "./");
        assert!(page.contains("[\"fonts/open-sans-regular\", \"fonts/open-sans-600\"]"), "{page}");
        assert!(page.contains("href: `../../${name}.woff2`"), "{page}");
        let page = linked(&format!("{head}<span class=\"katex\">"), "./");
        assert!(page.contains("KaTeX_Main") && !page.contains("KaTeX_Math"), "{page}");
    }

    /// Catches: a lab without its loader or its styles, or with a script that is no longer there.
    #[test]
    fn a_page_with_a_lab_loads_one_script() {
        let page = linked(&PAGE.replace("<main>", "<main><div class=\"lab\">"), "./");
        assert!(page.contains("lab.css") && page.contains("src=\"../theme/lab/near.js"));
        assert!(!page.contains("src=\"../theme/lab/words.js"));
    }

    /// Catches: a picture at an address that only the book's own pages understand, which nobody
    /// shows.
    #[test]
    fn the_picture_of_a_link_has_a_whole_address_or_is_left_out() {
        let page = format!("{CHARSET}\n{PICTURE}assets/the-lab.png\">\n");
        assert!(!linked(&page, "./").contains("og:image"));
        let page = linked(&page, "https://example.org/pendula/");
        assert!(page.contains("content=\"https://example.org/pendula/assets/the-lab.png\""));
    }
}
