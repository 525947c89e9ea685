//! Parsing built pages: their ids, their links, and what must not be on them.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use pendula_program::output::files;
use tl::{HTMLTag, Node, Parser, ParserOptions};

/// A built book.
pub struct Site {
    /// Its folder.
    pub folder: PathBuf,
    /// Its pages by path, relative to that folder.
    pub pages: BTreeMap<PathBuf, Page>,
}

/// One HTML page.
#[derive(Debug, Default)]
pub struct Page {
    /// Its ids, with repetitions.
    pub ids: Vec<String>,
    /// Its `href`s and `src`s with the name of the tag: what it leads to or loads.
    pub references: Vec<(String, String)>,
    /// The text of each code block.
    pub code_blocks: Vec<String>,
    /// The text outside code and scripts.
    pub prose: String,
}

impl Site {
    /// Reads a built book.
    pub fn read(folder: &Path) -> Self {
        let folder = files::canonicalize(folder).unwrap();
        let files = files::with_extension(&folder, "html").unwrap().into_iter();
        let read = |file: &PathBuf| Page::parse(&files::text(&folder.join(file)).unwrap());
        let pages = files.map(|file| (file.clone(), read(&file))).collect();
        Self { folder, pages }
    }

    /// Why a reference from `page` is broken, if it is.
    pub fn broken(&self, page: &Path, reference: &str) -> Option<&'static str> {
        if is_remote(reference) || ["data:", "mailto:"].iter().any(|s| reference.starts_with(s)) {
            return None;
        }
        let (path, id) = reference.split_once('#').unwrap_or((reference, ""));
        let path = path.split('?').next().unwrap_or_default();
        let target = match path {
            "" => page.to_path_buf(),
            path => page.with_file_name(path),
        };
        // A folder stands for its first page.
        let Some(target) = self.file(&target).or_else(|| self.file(&target.join("index.html")))
        else {
            return Some("no such file");
        };
        // An empty fragment is the top of the page.
        let is_there = |page: &Page| id.is_empty() || page.ids.iter().any(|known| known == id);
        let is_broken = self.pages.get(&target).is_some_and(|page| !is_there(page));
        is_broken.then_some("no such id")
    }

    /// The file of the book that this path leads to, without `.` and `..`.
    fn file(&self, path: &Path) -> Option<PathBuf> {
        let file = files::canonicalize(self.folder.join(path)).ok()?;
        file.is_file().then_some(file.strip_prefix(&self.folder).ok()?.to_path_buf())
    }
}

impl Page {
    /// Reads one page.
    pub fn parse(html: &str) -> Self {
        let dom = tl::parse(html, ParserOptions::default()).unwrap();
        let mut page = Self::default();
        for handle in dom.children() {
            page.visit(handle.get(dom.parser()).unwrap(), dom.parser(), false);
        }
        page
    }

    /// The ids that stand more than once.
    pub fn repeated_ids(&self) -> Vec<String> {
        let mut seen = BTreeSet::new();
        self.ids.iter().filter(|id| !seen.insert(*id)).cloned().collect()
    }

    fn visit(&mut self, node: &Node<'_>, parser: &Parser<'_>, in_code: bool) {
        match node {
            Node::Raw(text) if !in_code => self.prose.push_str(&text.as_utf8_str()),
            Node::Tag(tag) => {
                let name = tag.name().as_utf8_str();
                self.note_attributes(&name, tag);
                if name == "script" || name == "style" {
                    return;
                }
                if name == "pre" {
                    self.code_blocks.push(tag.inner_text(parser).into_owned());
                }
                let in_code = in_code || name == "code" || name == "pre";
                for child in tag.children().top().iter() {
                    self.visit(child.get(parser).unwrap(), parser, in_code);
                }
            }
            _ => {}
        }
    }

    fn note_attributes(&mut self, name: &str, tag: &HTMLTag<'_>) {
        let attributes = tag.attributes();
        let value = |key: &str| Some(attributes.get(key)??.as_utf8_str().into_owned());
        self.ids.extend(value("id"));
        let references = ["href", "src"].into_iter().filter_map(value);
        self.references.extend(references.map(|reference| (name.to_string(), reference)));
    }
}

/// Whether following this would leave the reader's machine.
pub fn is_remote(reference: &str) -> bool {
    !reference.starts_with("data:") && (reference.starts_with("//") || reference.contains("://"))
}
