//! Where the book is.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

/// The folder that holds `book.toml`: `book/` in `start` or in the nearest folder above it that has
/// one.
pub fn book(start: &Path) -> Result<PathBuf> {
    // Other projects have a book/book.toml too.
    let is_ours = |folder: &PathBuf| {
        let toml = fs::read_to_string(folder.join("book.toml"));
        toml.is_ok_and(|toml| toml.contains("[preprocessor.pendula]"))
    };
    start.ancestors().map(|folder| folder.join("book")).find(is_ours).with_context(|| {
        format!(
            "there is no checkout of pendula here: no book/book.toml with [preprocessor.pendula] \
             in {} or above",
            start.display()
        )
    })
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    fn folder_with_book(toml: &str) -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir_all(folder.path().join("book")).unwrap();
        fs::create_dir_all(folder.path().join("src/methods")).unwrap();
        fs::write(folder.path().join("book/book.toml"), toml).unwrap();
        folder
    }

    /// Catches: a book found only from the top folder; building whatever book the current directory
    /// happens to hold, or that from whose source the program was compiled.
    #[test]
    fn the_book_is_found_from_below_and_another_projects_is_passed_over() {
        let folder = folder_with_book("[preprocessor.pendula]\n");
        let found = book(&folder.path().join("src/methods")).unwrap();
        assert_eq!(found, folder.path().join("book"));
        let other = folder_with_book("[book]\ntitle = \"other\"\n");
        let line = book(other.path()).unwrap_err().to_string();
        assert!(line.contains("there is no checkout of pendula here"), "{line}");
    }
}
