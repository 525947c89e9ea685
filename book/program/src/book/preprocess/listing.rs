//! The code blocks of a chapter, as they are shown.
//!
//! A listing, marked `rust`, runs as a test of the study. On the page it is a whole program: `fn
//! main` and what ends it are hidden, and are copied with what is shown. What the listing prints
//! stands below it. An excerpt of the library, marked `rust,ignore`, loses its common
//! indentation, and hints to the compiler are hidden. Nothing else is, since readers write their
//! own methods in the form that they see.

use crate::book::{Pattern, pattern};

/// The first line of a listing whose output is held, and where its last statement begins and ends.
const PRINTS: &str = "# use pendula_study::listing::{printed, println};";
const HELD: &str = "# assert_eq!(printed(), \"\\";
const HELD_END: &str = "# \");";
/// The last line of a listing in which `?` stands.
const RETURNS: &str = "# Ok::<(), pendula::Error>(())";

/// The block as its page shows it; `None` if it does not change.
pub fn shown(block: &str) -> Option<String> {
    let mut lines = block.lines();
    let (first, last) = (lines.next()?, lines.next_back()?);
    let language = first.strip_prefix("```")?;
    let body: Vec<&str> = lines.collect();
    let below = if language == "rust" { output(&body) } else { None };
    let body = match language {
        "rust" => program(&body),
        "rust,ignore" => flush_left(&body).into_iter().map(without_hint).collect(),
        _ => flush_left(&body),
    };
    let mut page = format!("{first}\n");
    for line in body {
        page += &(line + "\n");
    }
    page += last;
    if let Some(output) = below {
        page += &format!("\n\n<div class=\"output\">\n\n```text\n{output}```\n\n</div>\n");
    } else if block.ends_with('\n') {
        page.push('\n');
    }
    (page != block).then_some(page)
}

/// The lines without their common indentation.
fn flush_left(body: &[&str]) -> Vec<String> {
    let indent = |line: &&str| line.len() - line.trim_start().len();
    let code = body.iter().filter(|line| !line.trim().is_empty());
    let common = code.map(indent).min().unwrap_or(0);
    body.iter().map(|line| line.get(common..).unwrap_or_default().to_string()).collect()
}

/// Hides hints to the compiler, which a reader's own code can do without. Whatever it needs stays.
fn without_hint(line: String) -> String {
    static HINT: Pattern = Pattern::new(|| pattern(r"^ *#\[inline(?:\(\w+\))?\]$"));
    if HINT.is_match(&line) { format!("# {line}") } else { line }
}

/// The listing as a program that compiles by itself, without what holds its output.
fn program(body: &[&str]) -> Vec<String> {
    let mut is_held = false;
    let is_of_program = |line: &&&str| {
        is_held = is_held || **line == HELD;
        let is_shown = !is_held && **line != PRINTS && **line != RETURNS;
        is_held = is_held && **line != HELD_END;
        is_shown
    };
    let mut lines: Vec<String> =
        body.iter().filter(is_of_program).map(|line| line.to_string()).collect();
    if lines.iter().any(|line| line.trim_start_matches("# ").starts_with("fn main()")) {
        return lines;
    }
    let returns = body.contains(&RETURNS);
    let result = if returns { " -> Result<(), pendula::Error>" } else { "" };
    lines.insert(0, format!("# fn main(){result} {{"));
    lines.extend(returns.then(|| "# Ok(())".to_string()));
    lines.push("# }".to_string());
    lines
}

/// What a listing prints: the text of its hidden `assert_eq!(printed(), "…")`, to which the listing
/// is held when it runs as a test.
fn output(body: &[&str]) -> Option<String> {
    let held = body.iter().skip_while(|line| **line != HELD).skip(1);
    let text: String = held
        .take_while(|line| **line != HELD_END)
        .map(|line| line.strip_prefix("# ").unwrap_or("").to_owned() + "\n")
        .collect();
    (!text.is_empty()).then_some(text)
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
        assert_eq!(shown(block).as_deref(), Some(expected));
        for flush in ["```rust,ignore\nfn f() {}\n```\n", "`code`", "```\n```\n", "```\na\n```"] {
            assert_eq!(shown(flush), None, "{flush}");
        }
    }

    /// Catches: a hint in the way of a method's two lines; a line hidden without which a method of
    /// the same form does not compile.
    #[test]
    fn hints_are_hidden_and_nothing_else() {
        let block = "```rust,ignore\ntype Carry = ();\n\nfn start(&self, _h: f64) {}\n\n\
                     #[inline(always)]\nfn step() {\n\n    #[inline]\n    fn f() {}\n}\n```";
        let expected = "```rust,ignore\ntype Carry = ();\n\nfn start(&self, _h: f64) {}\n\n\
                        # #[inline(always)]\nfn step() {\n\n#     #[inline]\n    fn f() {}\n}\n```";
        assert_eq!(shown(block).as_deref(), Some(expected));
    }

    /// Catches: a listing that does not compile where it is copied to; one that keeps what holds it
    /// to its output; an output that is lost, or keeps the marks of what is hidden.
    #[test]
    fn a_listing_is_a_whole_program_above_its_output() {
        let held = "# assert_eq!(printed(), \"\\\n# 1\n#\n#  2\n# \");\n";
        let output = "\n\n<div class=\"output\">\n\n```text\n1\n\n 2\n```\n\n</div>\n";
        let block = format!("```rust\n{PRINTS}\nf()?;\n{held}{RETURNS}\n```");
        let program = "# fn main() -> Result<(), pendula::Error> {\nf()?;\n# Ok(())\n# }\n";
        assert_eq!(shown(&block), Some(format!("```rust\n{program}```{output}")));
        let block = "```rust\nf();\n```\n";
        assert_eq!(shown(block).unwrap(), "```rust\n# fn main() {\nf();\n# }\n```\n");
        let block = format!("```rust\n{PRINTS}\n# fn main() {{\nf();\n{held}# }}\n```");
        assert_eq!(
            shown(&block),
            Some(format!("```rust\n# fn main() {{\nf();\n# }}\n```{output}"))
        );
    }
}
