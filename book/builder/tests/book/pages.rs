//! Parsing built pages: their ids, their links, and what must not be on them.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Component, Path, PathBuf};

use pendula_output::files;
use tl::{HTMLTag, Node, Parser, ParserOptions};

/// The pages and other files of a built book.
pub struct Site {
    /// Pages by path, relative to the book's folder.
    pub pages: BTreeMap<PathBuf, Page>,
    /// Every file, relative to the book's folder.
    pub files: BTreeSet<PathBuf>,
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
        let found = files::tree(folder).unwrap().into_iter();
        let files: BTreeSet<PathBuf> =
            found.filter(|(_, is_folder)| !is_folder).map(|(path, _)| path).collect();
        let pages = files::with_extension(folder, "html").unwrap().into_iter().map(|file| {
            let page = Page::parse(&files::text(&folder.join(&file)).unwrap());
            (file, page)
        });
        let pages = pages.collect();
        Self { pages, files }
    }

    /// Why a reference from `page` is broken, if it is.
    pub fn broken(&self, page: &Path, reference: &str) -> Option<&'static str> {
        if is_remote(reference) || ["data:", "mailto:"].iter().any(|s| reference.starts_with(s)) {
            return None;
        }
        let (path, id) = match reference.split_once('#') {
            Some((path, id)) => (path, Some(id.to_string())),
            None => (reference, None),
        };
        let path = path.split('?').next().unwrap_or_default();
        let target = match path {
            "" => page.to_path_buf(),
            path => joined(page, path),
        };
        // A folder stands for its first page.
        if !self.files.contains(&target) && !self.files.contains(&target.join("index.html")) {
            return Some("no such file");
        }
        match id {
            // An empty fragment is the top of the page.
            Some(id) if !id.is_empty() && !self.pages.get(&target)?.ids.contains(&id) => {
                Some("no such id")
            }
            _ => None,
        }
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

/// `path` resolved relative to `page`, without `.` and `..`.
fn joined(page: &Path, path: &str) -> PathBuf {
    let mut target = PathBuf::new();
    for component in page.parent().unwrap_or(Path::new("")).join(path).components() {
        match component {
            Component::ParentDir => drop(target.pop()),
            Component::CurDir => {}
            other => target.push(other),
        }
    }
    target
}
