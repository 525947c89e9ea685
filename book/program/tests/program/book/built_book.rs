//! The book as a reader gets it: built into an empty folder, and its HTML parsed. And its appendix
//! of claims: the rows, and the links from them to the chapters.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use pendula_program::book::build;
use pendula_program::book::ledger::{Entry, Ledger, Paper};
use pendula_program::book::progress::Progress;
use pendula_program::book::versions::{Made, Version};
use pendula_program::output::files;
use pendula_study::experiments::Study;
use regex::Regex;
use tempfile::TempDir;
use tl::ParserOptions;

use crate::book::chapters::chapters;
use crate::book::pages::{Page, Site, is_remote};
use crate::book::review::REVIEWED;
use crate::book::root;

/// The paper's claims as measured now.
pub static PAPER: LazyLock<Paper> = LazyLock::new(|| Paper::new(Study::of_the_paper()));

/// The page of the appendix.
const CLAIMS: &str = "appendix-claims.html";

/// The paper's claims as measured now, and the snapshots as reviewed: the tests of the study hold
/// each of them to the code.
struct Reviewed;

impl Ledger for Reviewed {
    fn entry(&self, id: &str) -> Option<Entry> {
        PAPER.entry(id)
    }

    fn wrong(&self) -> Option<usize> {
        PAPER.wrong()
    }

    fn snapshots(&self, names: BTreeSet<String>) -> anyhow::Result<Made> {
        let quoted = REVIEWED.iter().filter(|(name, _)| names.contains(*name));
        let quoted: Version = quoted.map(|(name, text)| (name.clone(), text.clone())).collect();
        Ok((quoted, BTreeMap::new()))
    }
}

/// Built once for all tests: the folder that is removed at the end, and the pages of the book in
/// it. `Err` is the reason why the build stopped.
static BOOK: LazyLock<Result<(TempDir, Site), String>> = LazyLock::new(|| {
    let folder = tempfile::tempdir().unwrap();
    let (book, to) = (root().join("book"), Some(folder.path()));
    let built = build::book(&book, to, Reviewed, Progress::hidden());
    built.map_err(|error| format!("{error:#}"))?;
    let site = Site::read(folder.path());
    Ok((folder, site))
});

fn site() -> &'static Site {
    match &*BOOK {
        Ok((_, site)) => site,
        Err(error) => panic!("the book cannot be built: {error}"),
    }
}

/// The HTML of a page.
fn html(page: &str) -> String {
    fs::read_to_string(site().folder.join(page)).unwrap()
}

/// Fails with all findings at once, so that they can be fixed in one go.
#[track_caller]
fn assert_none(findings: impl IntoIterator<Item = String>) {
    let findings: Vec<_> = findings.into_iter().collect();
    assert!(findings.is_empty(), "\n{}", findings.join("\n"));
}

/// What `find` finds on each page, after the page's name.
fn on_each_page(find: impl Fn(&Path, &Page) -> Vec<String>) -> Vec<String> {
    let pages = site().pages.iter();
    pages
        .flat_map(|(path, page)| {
            let findings = find(path, page).into_iter();
            findings.map(move |finding| format!("{}: {finding}", path.display()))
        })
        .collect()
}

/// Catches: a renamed chapter, heading or test that something still links to; a missing figure,
/// style sheet or font.
#[test]
fn every_internal_link_resolves() {
    assert_none(on_each_page(|path, page| {
        let broken =
            |reference: &String| Some((site().broken(path, reference)?, reference.clone()));
        let findings = page.references.iter().filter_map(|(_, reference)| broken(reference));
        findings.map(|(why, reference)| format!("{reference}: {why}")).collect()
    }));
}

/// Catches: a font or image named in a style sheet that is not in the book, or is fetched from
/// elsewhere.
#[test]
fn every_file_named_in_a_style_sheet_is_in_the_book() {
    let site = site();
    let sheets = files::with_extension(&site.folder, "css").unwrap();
    assert_none(sheets.iter().flat_map(|sheet| {
        let css = fs::read_to_string(site.folder.join(sheet)).unwrap();
        let named: Vec<_> = css
            .split("url(")
            .skip(1)
            .filter_map(|rest| Some(rest.split_once(')')?.0.trim_matches(['"', '\''])))
            .filter(|url| is_remote(url) || site.broken(sheet, url).is_some())
            .map(|url| format!("{}: {url}", sheet.display()))
            .collect();
        named
    }));
}

/// Catches: a script, font, image or style sheet that a reader's browser would fetch over the
/// network.
#[test]
fn nothing_is_loaded_from_elsewhere() {
    assert_none(on_each_page(|_, page| {
        // A link loads nothing until a reader clicks on it.
        let loads = page.references.iter().filter(|(tag, _)| tag != "a");
        loads.filter(|(_, url)| is_remote(url)).map(|(tag, url)| format!("<{tag}> {url}")).collect()
    }));
}

/// Catches: a page without a policy, or with one that lets any script run; WebAssembly compiled
/// where there is no lab.
#[test]
fn every_page_has_a_policy() {
    assert_none(on_each_page(|path, _| {
        let html = html(&path.display().to_string());
        let content = html.split_once("http-equiv=\"Content-Security-Policy\" content=\"");
        let policy = content.and_then(|(_, rest)| rest.split_once('"')).unwrap_or_default().0;
        let directives: Vec<&str> = policy.split("; ").collect();
        let scripts = directives.iter().find(|directive| directive.starts_with("script-src "));
        let scripts = scripts.copied().unwrap_or("script-src 'unsafe-inline'");
        let is_before = html.find("Content-Security-Policy") < html.find("<script");
        let sound = [
            ("loads what it likes", directives[0] == "default-src 'none'"),
            ("runs any script", !scripts.contains("'unsafe-") && scripts.contains("'self'")),
            ("has its policy after a script", is_before || !html.contains("<script")),
            (
                "compiles, or cannot",
                scripts.contains("'wasm-unsafe-eval'")
                    == (html.contains("class=\"lab") || html.contains("rows-spot")),
            ),
        ];
        let wrong = sound.into_iter().filter(|(_, sound)| !sound);
        wrong.map(|(what, _)| what.to_string()).collect()
    }));
}

/// Catches: a directive or a formula that reached the page as its source.
#[test]
fn no_source_is_left_in_the_prose() {
    assert_none(on_each_page(|_, page| {
        let left = |sign: &str| {
            let at = page.prose.find(sign)?;
            Some(page.prose[at..].chars().take(60).collect::<String>())
        };
        ["{{", "}}", "$$", "\\frac", "\\theta", "\\omega"].into_iter().filter_map(left).collect()
    }));
}

/// Catches: an include without text.
#[test]
fn no_code_block_is_empty() {
    assert_none(on_each_page(|_, page| {
        let empty = page.code_blocks.iter().filter(|code| code.trim().is_empty());
        empty.map(|_| "an empty code block".to_string()).collect()
    }));
}

/// Catches: a test with the id of a heading, so that links lead to the wrong one.
#[test]
fn no_id_stands_twice_on_a_page() {
    assert_none(on_each_page(|_, page| page.repeated_ids()));
}

/// Catches: a chapter forgotten in SUMMARY.md, or one that mdBook dropped from it.
#[test]
fn every_chapter_is_in_the_book() {
    let chapters = chapters().into_iter().map(|(file, _)| file);
    assert_have_pages(chapters.filter(|file| file != "SUMMARY.md").map(PathBuf::from));
}

/// Each of these sources has its page.
#[track_caller]
fn assert_have_pages(sources: impl Iterator<Item = PathBuf>) {
    let pages = sources.map(|source| source.with_extension("html"));
    let missing = pages.filter(|page| !site().pages.contains_key(page));
    assert_none(missing.map(|page| page.display().to_string()));
}

/// Catches: a file of tests that no page shows.
#[test]
fn every_file_of_tests_has_its_page() {
    let files = files::with_extension(&root().join("tests"), "rs").unwrap();
    assert!(files.len() > 50, "{files:?}");
    assert_have_pages(files.iter().map(|file| Path::new("tests").join(file)));
}

/// Catches: a file of tests that no program compiles, so that its tests never run; a folder of
/// tests that Cargo does not know.
#[test]
fn every_file_of_tests_is_listed_in_its_program() {
    let top = root();
    let read = |path: PathBuf| fs::read_to_string(&path).unwrap_or_default();
    let packages =
        ["", "book/study/", "book/judge/", "book/device/"].map(|at| format!("{at}Cargo.toml"));
    let manifests = packages.map(|manifest| read(top.join(manifest))).concat();
    let unlisted = |file: &PathBuf| {
        let (folder, stem) = (file.parent()?, file.file_stem()?.to_str()?);
        let listed_in = |list: PathBuf, line: &str| read(list).lines().any(|l| l == line);
        let module = |folder: &Path, name: &str| {
            let (line, folder) = (format!("mod {name};"), top.join("tests").join(folder));
            let lists = ["main.rs", "mod.rs"].map(|list| folder.join(list));
            lists.into_iter().chain([folder.with_extension("rs")]).any(|list| {
                listed_in(list.clone(), &line) || listed_in(list, &format!("pub {line}"))
            })
        };
        let listed = match stem {
            "main" => manifests.contains(&format!("tests/{}", file.display())),
            "mod" => module(folder.parent()?, folder.file_name()?.to_str()?),
            // Files shared by several programs are included by `#[path]`.
            _ if folder == Path::new("common") => true,
            _ => module(folder, stem),
        };
        (!listed).then(|| file.display().to_string())
    };
    let files = files::with_extension(&top.join("tests"), "rs").unwrap();
    assert_none(files.iter().filter_map(unlisted));
}

/// The claims that each chapter quotes, by the page.
fn quoted() -> BTreeSet<(String, String)> {
    let code = Regex::new(r"(?ms)^```.*?^```$|`[^`\n]*`").unwrap();
    let quote = Regex::new(r"\{\{\s*(?:measured|stated|verdict)\s+([^\s}]+)\s*\}\}").unwrap();
    let mut quoted = BTreeSet::new();
    for (file, text) in chapters() {
        let page = file.replace(".md", ".html");
        for found in quote.captures_iter(&code.replace_all(&text, "")) {
            quoted.insert((page.clone(), found[1].to_string()));
        }
    }
    assert!(quoted.len() > 25, "only {} quotes", quoted.len());
    quoted
}

/// Catches: a claim that does not link back to a chapter that quotes it, or links to one that does
/// not; a link that leads to the top of a chapter, or to another quote.
#[test]
fn each_quoted_claim_links_back_to_its_quotes() {
    let page = html(CLAIMS);
    let page = tl::parse(&page, ParserOptions::default()).unwrap();
    let mut links = BTreeSet::new();
    for row in page.query_selector("tr[id]").unwrap() {
        let row = row.get(page.parser()).unwrap().outer_html(page.parser());
        let Page { ids, references, .. } = Page::parse(&row);
        for (tag, link) in references {
            let (chapter, quote) = link.split_once('#').expect("a link to the very place");
            assert_eq!((tag.as_str(), quote), ("a", ids[0].as_str()));
            assert!(site().pages[Path::new(chapter)].ids.contains(&ids[0]), "{link}");
            links.insert((chapter.to_string(), ids[0].clone()));
        }
    }
    assert_eq!(links, quoted());
}

/// Catches: a claim without a row; a row hidden before a script could show it, and a control that
/// does nothing without one.
#[test]
fn nothing_waits_for_a_script() {
    let page = html(CLAIMS);
    let main = page.split_once("<main>").unwrap().1.split_once("</main>").unwrap().0;
    for dead in ["hidden", "<form", "<select", "<button", "display: none"] {
        assert!(!main.contains(dead), "{dead}");
    }
    assert_eq!(main.matches("<tr id=").count(), PAPER.claims().len());
}

/// Catches: an adapter that mixes up what is stated and what is measured; a dash for what the paper
/// does not print.
#[test]
fn the_papers_claims_come_through() {
    let entry = PAPER.entry("T4.fe.0.1").expect("a claim of Table 4");
    assert_eq!(entry.stated.as_deref(), Some("2.01 × 10²"));
    assert!(entry.measured.is_some_and(|text| text.starts_with("2.0118")));
    assert_eq!(entry.verdict.as_deref(), Some("reproduced"));
    assert_eq!(PAPER.entry("T4.no.such"), None);
    let unstated = PAPER.claims().iter().find(|claim| claim.stated.is_none()).unwrap();
    assert_eq!(PAPER.entry(&unstated.id).unwrap().stated, None);
}

/// Catches: checks that find nothing, because the parser of pages misses links, ids, code or text.
#[test]
fn the_checks_see_what_is_wrong() {
    let page = Page::parse(
        "<!DOCTYPE html><head><script src=\"https://x.example/a.js\">let a = '{{';</script></head>\
         <h2 id=\"a\"><a href=\"#b\">A</a></h2><p id=\"a\">{{stated}} <code>{{fine}}</code></p>\
         <pre><code class=\"language-rust\">\n</code></pre><b>x</b>",
    );
    assert_eq!(page.ids, ["a", "a"]);
    assert!(page.prose.contains("{{stated}}") && !page.prose.contains("fine"));
    assert!(!page.prose.contains("let a"));
    assert_eq!(page.code_blocks, ["\n"]);
    assert!(is_remote(&page.references[0].1));

    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("tests")).unwrap();
    for name in ["one.html", "tests/two.html"] {
        fs::write(folder.path().join(name), "<p id=\"störmer\">").unwrap();
    }
    let site = Site::read(folder.path());
    let from = Path::new("tests/two.html");
    assert_eq!(site.broken(from, "../one.html#störmer"), None);
    assert_eq!(site.broken(from, "#störmer"), None);
    assert_eq!(site.broken(from, "one.html"), Some("no such file"));
    assert_eq!(site.broken(from, "../../"), Some("no such file"));
    assert_eq!(site.broken(from, "../one.html#verlet"), Some("no such id"));
}
