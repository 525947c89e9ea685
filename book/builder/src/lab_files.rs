//! The scripts and styles of the lab, on the pages that have one and nowhere else. Its scripts are
//! joined to one, which another loads when the reader comes near.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

/// Where the lab's files stand in the book.
const FOLDER: &str = "theme/lab/";

/// What all scripts are joined to, and the script that loads it.
const BUNDLE: &str = "theme/lab/bundle.js";
const LOADER: &str = "theme/lab/near.js";

/// Joins the scripts of the lab, in the order in which `scripts` names them, in the folder of the
/// pages, if there are any.
///
/// # Errors
/// If a script cannot be read, or the joined one not be written.
pub fn join<P: AsRef<Path>>(pages: &Path, scripts: &[P]) -> Result<()> {
    let mut bundle = String::new();
    for script in scripts.iter().map(AsRef::as_ref) {
        if !script.starts_with(FOLDER) || script == Path::new(LOADER) {
            continue;
        }
        let file = pages.join(script);
        bundle += &fs::read_to_string(&file).with_context(|| file.display().to_string())?;
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

/// The page without the scripts that were joined; without any of the lab's files if it has no lab.
pub fn linked(page: &str) -> String {
    let with_lab = has_lab(page);
    let stays = |line: &&str| {
        let tag = line.trim_start();
        let script = tag.starts_with("<script src=\"");
        let of_the_lab = (script || tag.starts_with("<link ")) && tag.contains(FOLDER);
        !of_the_lab || with_lab && (!script || tag.contains(LOADER))
    };
    page.split_inclusive('\n').filter(stays).collect()
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
        let page = linked(PAGE);
        assert_eq!(page.matches("theme/lab/").count(), 1);
        assert_eq!(page.lines().count(), PAGE.lines().count() - 3);
    }

    /// Catches: a lab without its loader or its styles, or with a script that is no longer there.
    #[test]
    fn a_page_with_a_lab_loads_one_script() {
        let page = linked(&PAGE.replace("<main>", "<main><div class=\"lab\">"));
        assert!(page.contains("lab.css") && page.contains("src=\"../theme/lab/near.js"));
        assert!(!page.contains("src=\"../theme/lab/words.js"));
    }
}
