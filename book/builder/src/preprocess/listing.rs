//! Listings: code included from within an `impl` begins at the left margin, and below a listing
//! that prints stands what it prints.

/// A fenced block with the common indentation of its lines removed; `None` where there is nothing
/// to remove.
pub fn flush_left(block: &str) -> Option<String> {
    let mut lines: Vec<&str> = block.lines().collect();
    let fenced = lines.len() > 2 && lines[0].starts_with("```");
    let body = if fenced { 1..lines.len() - 1 } else { return None };
    let indent = |line: &&str| line.len() - line.trim_start().len();
    let code = lines[body.clone()].iter().filter(|line| !line.trim().is_empty());
    let common = code.map(indent).min().filter(|&common| common > 0)?;
    for line in &mut lines[body] {
        *line = line.get(common..).unwrap_or_default();
    }
    let end = if block.ends_with('\n') { "\n" } else { "" };
    Some(lines.join("\n") + end)
}

/// What a listing prints: the text of its hidden `assert_eq!(printed(), "…")`, to which the listing
/// is held when it runs as a test.
fn output(block: &str) -> Option<String> {
    let (_, text) = block.split_once("\n# assert_eq!(printed(), \"\\\n")?;
    let (text, _) = text.split_once("\n# \");\n")?;
    Some(text.lines().map(|line| line.strip_prefix("# ").unwrap_or("").to_owned() + "\n").collect())
}

/// The listing with its output below it; `None` where it prints nothing.
pub fn with_output(block: &str) -> Option<String> {
    let (output, end) = (output(block)?, if block.ends_with('\n') { "" } else { "\n" });
    Some(format!("{block}{end}\n<div class=\"output\">\n\n```text\n{output}```\n\n</div>\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: a method taken from its `impl` that keeps its common indentation, and relative
    /// indentation that is lost; blocks rewritten that are flush left already, or are not fenced.
    #[test]
    fn the_common_margin_goes_and_no_more() {
        let block = "```rust,ignore\n    fn f() {\n        1\n\n    }\n```\n";
        let expected = "```rust,ignore\nfn f() {\n    1\n\n}\n```\n";
        assert_eq!(flush_left(block).as_deref(), Some(expected));
        for flush in ["```rust\nfn f() {}\n```\n", "`code`", "```\n```\n"] {
            assert_eq!(flush_left(flush), None);
        }
    }

    /// Catches: an output that is lost, or keeps the marks of what is hidden.
    #[test]
    fn what_is_printed_stands_below() {
        let block = "```rust\nprint();\n# assert_eq!(printed(), \"\\\n# 1\n#\n#  2\n# \");\n```";
        let expected =
            format!("{block}\n\n<div class=\"output\">\n\n```text\n1\n\n 2\n```\n\n</div>\n");
        assert_eq!(with_output(block), Some(expected));
        assert_eq!(with_output("```rust\nlet x = 1;\n```"), None);
    }
}
