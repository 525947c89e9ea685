//! What moved, in words, and words in Markdown.

use pendula_study::digits::Digits;
use pendula_study::report::table::Cell as Value;

use super::Figure;
use super::cells::Cell;
use super::groups::{Group, Item};
use super::verdict::counted;
use crate::book::preprocess::markdown::fence;
use pendula_judge::printable::printable;

/// A row of a table: what it is, before, now, and how far these are apart.
pub fn row(item: &Item) -> [String; 4] {
    let Item { shown: Cell { old, new, .. }, .. } = item;
    [item.label(), shown(old), shown(new), item.change().map_or_else(String::new, change_text)]
}

/// What a cell says; a dash for none.
pub fn typeset(value: &Option<Value>) -> String {
    let value = value.as_ref().filter(|value| !value.is_empty());
    value.map_or_else(|| "—".to_string(), Value::typeset)
}

/// The same after its mark.
fn shown(value: &Option<Value>) -> String {
    let differs = value.as_ref().is_some_and(|value| value.differs);
    format!("{}{}", if differs { "≠ " } else { "" }, typeset(value))
}

/// The relative change from `old` to `new`; `None` from zero, and where there is none.
pub fn change(old: f64, new: f64) -> Option<f64> {
    let change = (new - old) / old.abs();
    (change.is_finite() && change != 0.0).then_some(change)
}

/// A relative change as text: a factor from a doubling on, per cent, or parts per million.
pub fn change_text(change: f64) -> String {
    let signed = |value: f64, unit: &str| {
        let decimals = match value.abs() {
            size if size >= 100.0 => 0,
            size if size >= 10.0 => 1,
            _ => 2,
        };
        format!("{value:+.decimals$} {unit}").replace('-', "−")
    };
    match change.abs() {
        size if size >= 1.0 => format!("× {}", Digits::Significant(3).print(1.0 + change)),
        size if size >= 1e-4 => signed(100.0 * change, "%"),
        _ => signed(1e6 * change, "ppm"),
    }
}

/// What a group comes to, in a line.
pub fn summary(group: &Group) -> String {
    let n = group.items.len();
    let change = match group.largest_change() {
        Some(change) if n == 1 => format!(", {}", change_text(change)),
        Some(change) => format!(", by up to {}", change_text(change)),
        None => String::new(),
    };
    let left = match group.items.iter().filter(|item| item.leaves()).count() {
        0 => String::new(),
        left => format!("; {left} no longer as stated or predicted"),
    };
    format!("{}{change}{left}", counted(n, "value"))
}

/// What a figure's difference comes to, in a line.
pub fn difference(figure: &Figure) -> String {
    const FEW: usize = 3;
    let Some(difference) = &figure.difference else {
        return if figure.drawings[0].is_none() { "is new" } else { "has gone" }.to_string();
    };
    let moved = difference.displacement;
    let moved = (moved > 0.0).then(|| format!("moved by up to {moved:.1} px of 600"));
    let notes = &difference.notes;
    let more = notes.len().saturating_sub(FEW);
    let more = (more > 0).then(|| format!("and {}", counted(more, "more difference")));
    let parts: Vec<String> =
        moved.into_iter().chain(notes.iter().take(FEW).cloned()).chain(more).collect();
    parts.join("; ")
}

/// Names as code, with commas.
pub fn code<S: AsRef<str>>(names: &[S]) -> String {
    names.iter().map(|name| span(name.as_ref())).collect::<Vec<_>>().join(", ")
}

/// A span of code: between more backticks than it has.
fn span(text: &str) -> String {
    let text = printable(&text.replace(['\n', '\t'], " ")).replace('|', "\\|");
    let fence = fence(&text, 1);
    // A blank on either side is not part of it, but keeps it from the fence.
    if fence.len() == 1 && !text.trim().is_empty() {
        format!("{fence}{text}{fence}")
    } else {
        format!("{fence} {text} {fence}")
    }
}

/// A link to a file of the project.
pub fn link(name: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "/_-.".contains(c);
    if name.chars().all(is_plain) { format!("[`{name}`]({name})") } else { span(name) }
}

/// Text in which Markdown sees no markup, but for code between backticks.
pub fn prose(text: &str) -> String {
    let parts: Vec<&str> = text.split('`').collect();
    let mut out = String::new();
    for (i, part) in parts.iter().enumerate() {
        // The last of an odd number of backticks is a letter.
        match (i % 2 == 1, i + 1 == parts.len()) {
            (true, false) => out += &span(part),
            (true, true) => out += &format!("\\`{}", escaped(part)),
            (false, _) => out += &escaped(part),
        }
    }
    // What would begin a list or a rule.
    let digits = out.chars().take_while(char::is_ascii_digit).count();
    if let [mark, rest @ ..] = &out.as_bytes()[digits..]
        && matches!((digits, mark), (1.., b'.' | b')') | (0, b'-' | b'+'))
        && matches!(rest.first(), None | Some(b' ' | b'-'))
    {
        out.insert(digits, '\\');
    }
    out
}

fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in printable(text).chars() {
        if "\\*_[]<>&|~$#@".contains(c) {
            out.push('\\');
        }
        out.push(if c.is_whitespace() { ' ' } else { c });
    }
    out
}

#[cfg(test)]
mod tests {
    use rstest::rstest;

    use super::*;

    /// Catches: a change in the wrong unit, without a sign, or taken from the new value; one
    /// that is infinite.
    #[rstest]
    #[case(1.0, 1.0132, Some("+1.32 %"))]
    #[case(-2.0, -1.0, Some("+50.0 %"))]
    #[case(1.0, 1.00002, Some("+20.0 ppm"))]
    #[case(1.0, 0.5, Some("−50.0 %"))]
    #[case(1.0, 12.0, Some("× 12.0"))]
    #[case(1.0, 1.2e7, Some("× 1.20 × 10⁷"))]
    #[case(0.0, 1.0, None)]
    #[case(2.0, 2.0, None)]
    fn a_change_has_its_unit(#[case] old: f64, #[case] new: f64, #[case] text: Option<&str>) {
        assert_eq!(change(old, new).map(change_text).as_deref(), text);
    }
}
