//! What moved, in words, and words in Markdown.

use super::Figure;
use super::causes::{Group, Item};
use super::cells::Value;
use super::number::change_text;
use super::verdict::counted;

/// What an item is called, with the id of its claim.
fn labelled(item: &Item) -> String {
    match &item.claim {
        Some(id) if !item.label.contains(id.as_str()) => format!("{} `{id}`", item.label),
        _ => item.label.clone(),
    }
}

/// A row of a table: what it is, before, now, and how far these are apart.
pub fn row(item: &Item) -> Vec<String> {
    let both = |distances: Option<[f64; 2]>| {
        distances.map_or_else(String::new, |[old, new]| format!("{} → {}", short(old), short(new)))
    };
    let (mut old, mut new) = (shown(&item.shown.old), shown(&item.shown.new));
    // Two values of a sentence without the definition in parentheses that both end with.
    if let (Some((a, definition)), Some((b, same))) = (old.split_once(" ("), new.split_once(" ("))
        && definition == same
    {
        (old, new) = (a.to_string(), b.to_string());
    }
    let change = item.change.map_or_else(String::new, change_text);
    vec![labelled(item), old, new, change, both(item.theory), both(item.paper)]
}

/// A cell's text with its mark; a dash for none.
pub fn shown(value: &Option<Value>) -> String {
    match value {
        Some(Value { text, marked: true }) => format!("≠ {text}"),
        Some(Value { text, .. }) if !text.is_empty() => text.clone(),
        _ => "—".to_string(),
    }
}

/// A distance in units of a tolerance: two digits are enough.
fn short(distance: f64) -> String {
    match distance {
        d if d < 0.005 => "0".to_string(),
        d if d < 10.0 => format!("{d:.2}"),
        d if d < 1e5 => format!("{d:.0}"),
        d => format!("{d:.1e}"),
    }
}

/// What a group comes to, in a line.
pub fn summary(group: &Group) -> String {
    let n = group.items().count();
    let change = match group.largest_change() {
        Some(change) if n == 1 => format!(", {}", change_text(change)),
        Some(change) => format!(", by up to {}", change_text(change)),
        None => String::new(),
    };
    let left = match group.items().filter(|item| item.leaves()).count() {
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
    let moved = difference.displacement.filter(|moved| *moved > 0.0);
    let moved = moved.map(|moved| format!("moved by up to {moved:.1} px of 600"));
    let notes = &difference.notes;
    let more = notes.len().saturating_sub(FEW);
    let more = (more > 0).then(|| format!("and {}", counted(more, "more difference")));
    let parts: Vec<String> =
        moved.into_iter().chain(notes.iter().take(FEW).cloned()).chain(more).collect();
    parts.join("; ")
}

/// With a capital.
pub fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_uppercase().collect::<String>() + letters.as_str()
    })
}

/// Names as code, with commas.
pub fn code<S: AsRef<str>>(names: &[S]) -> String {
    names.iter().map(|name| span(name.as_ref())).collect::<Vec<_>>().join(", ")
}

/// A span of code: between more backticks than it has.
fn span(text: &str) -> String {
    let text = text.replace(['\n', '\r'], " ").replace('|', "\\|");
    let longest = text.split(|c| c != '`').map(str::len).max().unwrap_or(0);
    let fence = "`".repeat(longest + 1);
    // A blank on either side is not part of it, but keeps it from the fence.
    if longest == 0 && !text.trim().is_empty() {
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
    for c in text.chars() {
        if "\\*_[]<>&|~$#@".contains(c) {
            out.push('\\');
        }
        out.push(if c.is_control() { ' ' } else { c });
    }
    out
}
