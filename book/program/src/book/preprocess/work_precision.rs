//! The work–precision figure in the book.

use std::path::{Path, PathBuf};

use crate::output::files;
use anyhow::ensure;

/// The file of the figure.
pub const SVG: &str = "work-precision.svg";
/// The file of the numbers.
pub const CSV: &str = "work-precision.csv";

/// Where the files are kept for the book in the folder `root`: beside the built one.
pub fn folder(root: &Path) -> PathBuf {
    root.join("../target")
}

/// The figure with its caption: as measured on this machine, or else as recorded in `benches/`.
///
/// HTML that must stand in its own paragraph.
pub fn in_the_book(root: &Path) -> anyhow::Result<String> {
    let (here, recorded) = (folder(root).join(SVG), root.join("../benches").join(SVG));
    let (file, whose) = match here.exists() {
        true => (here, "this machine"),
        false => (recorded, "a shared machine, once"),
    };
    let svg = files::text(&file)?;
    // A blank line would end the HTML.
    let is_figure = svg.starts_with("<svg") && !svg.contains("\n\n");
    ensure!(is_figure, "{}: no figure", file.display());
    Ok(format!(
        "<figure>\n{svg}<figcaption>Run time against error as <code>pendula bench</code> found \
         them on {whose}. Lower left is better: coloured are those that are ahead, one after the \
         other as the error gets smaller. RK4 has its name, too; the thin lines are the library’s \
         other methods.</figcaption>\n</figure>\n"
    ))
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    /// Catches: a book that cannot be built without a measurement of this machine, that ignores
    /// one, or that shows another file of that name.
    #[test]
    fn the_book_shows_what_is_there() {
        let temporary = tempfile::tempdir().unwrap();
        let root = temporary.path().join("book");
        for made in [&root, &folder(&root), &root.join("../benches")] {
            fs::create_dir_all(made).unwrap();
        }
        assert!(in_the_book(&root).is_err());
        fs::write(root.join("../benches").join(SVG), "<svg></svg>\n").unwrap();
        let recorded = in_the_book(&root).unwrap();
        assert!(recorded.starts_with("<figure>\n<svg") && recorded.ends_with("</figure>\n"));
        assert!(!recorded.contains("\n\n") && !recorded.contains("{{"));
        assert!(recorded.contains("a shared machine, once"));
        let file = folder(&root).join(SVG);
        fs::write(&file, "<svg>\n\n</svg>\n").unwrap();
        assert!(in_the_book(&root).is_err());
        fs::write(&file, "<svg></svg>\n").unwrap();
        assert!(in_the_book(&root).unwrap().contains("this machine"));
    }
}
