//! The page of one file of tests, as Markdown.

use super::super::markdown::fence;
use super::{Test, TestFile, Tests};

/// The overview: every file with the first paragraph of its header and its tests.
pub fn overview(tests: &Tests) -> String {
    let mut page = String::from(
        "# All tests\n\nThe sources of the tests, as they were when this book was built. \
         `cargo test` runs them.\n",
    );
    for file in &tests.files {
        // mdBook makes a link of each heading, which then cannot contain another.
        page += &format!("\n## `tests/{}.rs`\n\n", file.name);
        let (prose, _) = header(&file.source);
        let first_paragraph = prose.split("\n\n").next().unwrap_or_default().trim_end();
        if !first_paragraph.is_empty() && !first_paragraph.starts_with('#') {
            page += &format!("{first_paragraph}\n\n");
        }
        page += &format!("* [the whole file]({}.md)\n", file.name);
        for Test { name, .. } in &file.tests {
            page += &format!("* [`{name}`]({}.md#{name})\n", file.name);
        }
    }
    page
}

/// The page of a file: its header as prose, then its source, cut so that each test has a heading
/// whose id is the test's name.
pub fn of(file: &TestFile) -> String {
    let mut page = format!("# `tests/{}.rs`\n\n", file.name);
    let (prose, header_lines) = header(&file.source);
    page += &format!("{prose}\n");

    let lines: Vec<&str> = file.source.lines().collect();
    let mut done = header_lines;
    for test in &file.tests {
        push_code(&mut page, &lines[done..test.lines.start]);
        page += &format!("\n## `{0}` {{#{0}}}\n", test.name);
        push_code(&mut page, &lines[test.lines.clone()]);
        done = test.lines.end;
    }
    push_code(&mut page, &lines[done..]);
    page
}

/// The file's `//!` comment as Markdown, and how many lines it takes.
fn header(source: &str) -> (String, usize) {
    let mut prose = String::new();
    let mut taken = 0;
    let mut in_code = false;
    for line in source.lines() {
        let Some(text) = line.strip_prefix("//!") else { break };
        let text = text.strip_prefix(' ').unwrap_or(text);
        if text.trim_start().starts_with("```") {
            in_code = !in_code;
        } else if text.starts_with('#') && !in_code {
            // The page has its own first heading.
            prose.push('#');
        }
        prose.push_str(text);
        prose.push('\n');
        taken += 1;
    }
    (prose, taken)
}

/// The lines as a code block, unless they are blank or only close the block around a test.
fn push_code(page: &mut String, lines: &[&str]) {
    // What a chapter includes is between anchors, which a reader of the file need not see.
    let is_code = |line: &&&str| !line.trim_start().starts_with("// ANCHOR");
    let code = lines.iter().filter(is_code).copied().collect::<Vec<_>>().join("\n");
    if code.chars().all(|c| c.is_whitespace() || "})];,".contains(c)) {
        return;
    }
    let fence = fence(&code, 3);
    let shown: String = code.trim_matches('\n').lines().map(shown).collect();
    // Not a listing, which would be made a program.
    *page += &format!("\n{fence}rust,source\n{shown}{fence}\n");
}

/// mdBook hides a line of Rust that begins with `# `, as rustdoc does; in a file of tests such a
/// line is part of a string. A doubled `#` shows as one.
fn shown(line: &str) -> String {
    let text = line.trim_start();
    let indent = &line[..line.len() - text.len()];
    let is_hidden = text == "#" || text.starts_with("# ") || text.starts_with("##");
    format!("{indent}{}{text}\n", if is_hidden { "#" } else { "" })
}

#[cfg(test)]
mod unit {
    use super::*;

    const SOURCE: &str = r#"//! Order.
//!
//! # Why
//! Because.

use a::b;

/// Catches: a.
#[test]
fn slopes() {}

proptest! {
    #[test]
    fn area(x in 0..1) {
    }
}

/* ```` */ const T: &str = "
# hidden?
";
"#;

    /// Catches: a page without the ids that chapters link to; source lost between the parts,
    /// documentation separated from its test; code that ends its own block early, and lines of code
    /// that mdBook hides; an overview that misses a test.
    #[test]
    fn the_source_is_shown_from_top_to_bottom() {
        let tests = Tests::from_sources([("order", SOURCE)]).unwrap();
        let page = of(&tests.files[0]);
        let mut from = 0;
        for piece in [
            "# `tests/order.rs`\n\nOrder.\n\n## Why\nBecause.\n",
            "use a::b;",
            "\n## `slopes` {#slopes}\n",
            "/// Catches: a.\n#[test]\nfn slopes() {}\n```",
            "proptest! {",
            "\n## `area` {#area}\n",
            "    fn area(x in 0..1) {\n    }\n",
            "`````rust,source\n",
            "const T",
            "\n## hidden?\n",
        ] {
            from += page[from..].find(piece).unwrap_or_else(|| panic!("{piece} in {page}"));
        }
        let overview = overview(&tests);
        assert!(overview.contains("* [`slopes`](order.md#slopes)\n* [`area`](order.md#area)\n"));
        assert!(overview.contains("Order.\n"), "{overview}");
    }
}
