//! What a page loads, and when: the scripts and styles of the lab where there is one, the script of
//! questions where one is asked, and neither anywhere else; and its fonts before its text is set,
//! so that no line is set twice.
//!
//! The lab's scripts are joined to one, without comments, which another loads when it is near. They
//! stand in a block, so that none of their names is a name of the page, as mdBook's own are.
//!
//! Its content security policy says what a browser may load and run on it: files of the book and
//! nothing else, and of scripts those of these files and the few that mdBook writes into the frame
//! of every page, by their hashes. A script in the text of a chapter, in an attribute or in an
//! address does not run. Styles stand inline on most pages: KaTeX gives the parts of a formula
//! their heights, and mdBook the cells of a table their alignment, both as attributes, which no
//! hash can name.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use crate::book::sheets::ALL;
use crate::output::files;
use crate::output::page::hash;
use anyhow::{Context, Result};

/// Where the lab's files stand in the book.
pub const FOLDER: &str = "theme/lab/";

/// What all scripts are joined to, and the script that loads it.
const BUNDLE: &str = "theme/lab/bundle.js";
const LOADER: &str = "theme/lab/near.js";

/// The script of questions.
const QUESTION: &str = "theme/question.js";

/// The line after which mdBook's pages have their policy.
const CHARSET: &str = "<meta charset=\"UTF-8\">";

/// The style of formulas.
const FORMULAS: &str = "assets/katex/katex.min.css";

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
        bundle += &without_comments(&files::text(&pages.join(script))?);
    }
    if bundle.is_empty() {
        return Ok(());
    }
    let file = pages.join(BUNDLE);
    let bundle = format!("'use strict';\n{{\n{bundle}}}\n");
    fs::write(&file, bundle).with_context(|| file.display().to_string())
}

/// Leaves the comments out of the script of questions, in the folder of the pages: nobody who reads
/// the book has to wait for them.
pub fn lighten<P: AsRef<Path>>(pages: &Path, scripts: &[P]) -> Result<()> {
    if scripts.iter().any(|script| script.as_ref() == Path::new(QUESTION)) {
        let file = pages.join(QUESTION);
        let light = without_comments(&files::text(&file)?);
        fs::write(&file, light).with_context(|| file.display().to_string())?;
    }
    Ok(())
}

/// A script without the lines that are comments.
fn without_comments(script: &str) -> String {
    let is_code = |line: &&str| !line.trim_start().starts_with("//");
    script.split_inclusive('\n').filter(is_code).collect()
}

/// The page with the files that it needs and its policy; `site` is the address of the book.
pub fn finished(page: &str, site: &str) -> Result<String> {
    with_policy(&linked(page, site))
}

/// Whether the page has a lab, or a figure that the lab's library moves.
fn has_lab(page: &str) -> bool {
    page.contains("class=\"lab")
}

/// The page with the files that it needs: without the scripts that were joined, without the style
/// of formulas if it has none, without any of the lab's files if it has no lab, and with its fonts
/// called for; with the picture for who posts a link, if `site` is a whole address, as that
/// picture's has to be.
fn linked(page: &str, site: &str) -> String {
    let with_lab = has_lab(page);
    let with_picture = site.contains("://");
    let stays = |line: &&str| {
        let tag = line.trim_start();
        if tag.starts_with(PICTURE) {
            return with_picture;
        }
        let script = tag.starts_with("<script src=\"");
        if script && tag.contains(QUESTION) {
            return page.contains("class=\"question\"");
        }
        if tag.starts_with("<link ") && tag.contains(FORMULAS) {
            return page.contains("class=\"katex");
        }
        let of_the_lab = (script || tag.starts_with("<link ")) && tag.contains(FOLDER);
        !of_the_lab || with_lab && (!script || tag.contains(LOADER))
    };
    let linked: String = page.split_inclusive('\n').filter(stays).collect();
    let linked = linked.replacen(PICTURE, &format!("{PICTURE}{site}"), 1);
    let linked = linked.replace("<img src=", "<img loading=\"lazy\" src=");
    let linked = linked.replacen(CHARSET, &format!("{CHARSET}{}", fonts(page)), 1);
    match linked.rsplit_once(END) {
        Some((text, rest)) => format!("{text}{END}{APPEARS}{rest}"),
        None => linked,
    }
}

/// Where the text ends.
const END: &str = "</main>";

/// The script after the text that has it appear when the fonts are there that it asks for, without
/// waiting for any other script. What of a page is on the screen, and asks for the fonts of its
/// formulas, a browser finds out in its first frame, so the second has come before we look. Where
/// the contents are a page of their own, there is no text.
const APPEARS: &str = "<script>(async () => { \
     const frame = () => new Promise(requestAnimationFrame); \
     const fonts = async () => { await frame(); await frame(); \
     const asked = [...document.fonts].filter(({ status }) => status === 'loading'); \
     await Promise.allSettled(asked.map(({ loaded }) => loaded)); }; \
     await Promise.race([fonts(), new Promise(late => setTimeout(late, 3000))]); \
     document.documentElement.classList.remove('awaits-fonts'); })();</script>";

/// The script that calls for the fonts of the page, and has its text wait for them, so that nothing
/// moves under the reader; after the 3 s for which browsers wait for a font it appears in any case.
/// From a disk a browser refuses to load fonts so early.
fn fonts(page: &str) -> String {
    const KINDS: [(&str, &str); 6] = [
        ("<body", "fonts/open-sans-regular"),
        ("<h1", "fonts/open-sans-600"),
        ("<code", "fonts/source-code-pro-500"),
        ("<em>", "fonts/open-sans-italic"),
        ("class=\"katex", "assets/katex/fonts/KaTeX_Main-Regular"),
        ("class=\"mord mathnormal", "assets/katex/fonts/KaTeX_Math-Italic"),
    ];
    let kinds = KINDS.iter().filter(|(sign, _)| page.contains(sign));
    let names: Vec<&str> = kinds.map(|(_, name)| *name).collect();
    // Where the root of the book is, as the page says it.
    let before = page.split_once(&format!("{ALL}\"")).map_or("", |(before, _)| before);
    let root = before.rsplit_once('"').map_or("", |(_, root)| root);
    format!(
        "\n        <script>if (location.protocol !== 'file:') for (const name of {names:?}) \
         document.head.append(Object.assign(document.createElement('link'), {{rel: 'preload', \
         as: 'font', type: 'font/woff2', crossOrigin: '', href: `{root}${{name}}.woff2`}}));\
         document.documentElement.classList.add('awaits-fonts');</script>"
    )
}

/// The page with its policy, before anything that it is about.
fn with_policy(page: &str) -> Result<String> {
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
    // The lab and the figures that it moves, of class "lab-figure", and the identification of rows
    // are compiled in the browser, which is allowed on their pages alone.
    if has_lab(page) || page.contains("rows-spot") {
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

    const PAGE: &str = "\
        <link rel=\"stylesheet\" href=\"../theme/pendula.css\">\n\
        <link rel=\"stylesheet\" href=\"../theme/lab/lab.css\">\n\
        <main>\n\
        <p>theme/lab/words.js</p>\n\
        </main>\n\
        <script src=\"../book.js\"></script>\n\
        <script src=\"../theme/lab/words.js\"></script>\n\
        <script src=\"../theme/lab/near.js\"></script>\n";

    /// Catches: a name of the lab that the page has too, as mdBook's own scripts have theirs.
    #[test]
    fn the_scripts_of_the_lab_stand_in_a_block() {
        let pages = tempfile::tempdir().unwrap();
        fs::create_dir_all(pages.path().join(FOLDER)).unwrap();
        let write = |script: &str, text| fs::write(pages.path().join(script), text).unwrap();
        write("theme/lab/words.js", "// Why.\nconst html = 1;\n");
        write("theme/lab/lab.js", "const lab = html;\n");
        join(pages.path(), &["theme/lab/words.js", "theme/lab/lab.js"]).unwrap();
        let bundle = fs::read_to_string(pages.path().join(BUNDLE)).unwrap();
        assert_eq!(bundle, "'use strict';\n{\nconst html = 1;\nconst lab = html;\n}\n");
    }

    /// Catches: a line of code lost with a comment, or a comment that is kept.
    #[test]
    fn comments_are_left_out_and_nothing_else() {
        assert_eq!(
            without_comments("// x\nlet a = 1; // y\n  // z\nb();\n"),
            "let a = 1; // y\nb();\n"
        );
    }

    /// Catches: a page without a lab that loads it; another file or the text lost with it; a lab
    /// without its loader or its styles, or with a script that is no longer there.
    #[test]
    fn the_lab_is_loaded_by_one_script_and_only_where_it_is() {
        let page = linked(PAGE, "./");
        assert_eq!(page.matches("theme/lab/").count(), 1);
        assert_eq!(page.lines().count(), PAGE.lines().count() - 3);
        let page = linked(&PAGE.replace("<main>", "<main><div class=\"lab\">"), "./");
        assert!(page.contains("lab.css") && page.contains("src=\"../theme/lab/near.js"));
        assert!(!page.contains("src=\"../theme/lab/words.js"));
    }

    /// Catches: a page without formulas that waits for their style; one with them that lacks it.
    #[test]
    fn formulas_have_their_style_and_nothing_else_waits_for_it() {
        let page = format!("<link rel=\"stylesheet\" href=\"{FORMULAS}\">\n<main>\n</main>\n");
        assert!(!linked(&page, "./").contains(FORMULAS));
        let page = page.replace("<main>", "<main><span class=\"katex\">");
        assert!(linked(&page, "./").contains(FORMULAS));
    }

    /// Catches: a font called for that the page does not show, of which a browser complains; a font
    /// of another folder.
    #[test]
    fn a_page_calls_for_its_own_fonts() {
        let head = format!("{CHARSET}<link href=\"../../{ALL}\"><body><h1>x</h1>");
        let page = linked(&head, "./");
        assert!(page.contains("[\"fonts/open-sans-regular\", \"fonts/open-sans-600\"]"), "{page}");
        assert!(page.contains("href: `../../${name}.woff2`"), "{page}");
        let page = linked(&format!("{head}<span class=\"katex\">"), "./");
        assert!(page.contains("KaTeX_Main") && !page.contains("KaTeX_Math"), "{page}");
    }

    /// Catches: a text that waits for other scripts, or for ever; a script among the text, which
    /// the policy refuses.
    #[test]
    fn the_text_appears_right_after_it_is_there() {
        let page = linked("<main><code>&lt;/main></code></main>\n<script src=\"book.js\">", "./");
        let (text, rest) = page.split_once("<script>").unwrap();
        assert!(text.ends_with("</main>") && page.matches(APPEARS).count() == 1, "{page}");
        assert!(rest.ends_with("</script>\n<script src=\"book.js\">"), "{page}");
        assert!(!linked("<body></body>", "./").contains(APPEARS));
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

    /// Catches: a script of a chapter, which anybody may have written, taken for one of the frame,
    /// also where its text ends the chapter for the builder, and not for the reader; one of the
    /// frame left out, so that the page is broken.
    #[test]
    fn scripts_of_the_frame_run_and_those_of_the_text_do_not() {
        let page = "<html><head><meta charset=\"UTF-8\"><title>x</title>\
            <script>let a;</script><script src=\"book.js\"></script></head><body><main>\
            <script>let b;</script></main><script>let c;</script>\
            </main><script>let d;</script></body></html>";
        let page = with_policy(page).unwrap();
        let scripts = [("let a;", true), ("let b;", false), ("let c;", false), ("let d;", true)];
        for (script, runs) in scripts {
            assert_eq!(page.contains(&hash(script)), runs, "{script}");
        }
        assert_eq!(page.matches("'sha256-").count(), 2);
    }
}
