//! The ledger's tables, as HTML, with what neither Markdown nor a snapshot says of a claim: its
//! verdict and its part of the paper, for the style sheet and the filters of the page, and links
//! back to where the chapters quote it.
//!
//! `{{verdicts}}` on that page becomes the table of how many claims got which verdict.

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::sync::LazyLock;

use anyhow::{Context, Result, bail};
use pendula_study::report::table::Table;
use pulldown_cmark::Parser;
use pulldown_cmark::html::push_html;
use regex::Regex;

use super::markdown::{options, splice};
use crate::ledger::Ledger;

/// Links to where each claim is quoted, by its id.
pub type Quotes = BTreeMap<String, Vec<String>>;

/// The kinds of claims that the paper makes, in the one table and the other.
const PRINTED: [&str; 2] = ["cell", "sentence"];
/// The kinds that we added to them.
const ADDED: [&str; 2] = ["finding", "reading"];

/// The heading of the column that is set below the claims themselves, as it is narrow and often the
/// same.
const PLACE: &str = "where";

/// What is counted of a claim.
struct Judged {
    id: String,
    kind: String,
    verdict: String,
}

/// The text with each table of claims, which has that heading above its first column, as HTML.
pub fn set(text: &str, ledger: &dyn Ledger, quotes: &Quotes) -> Result<String> {
    static TABLE: LazyLock<Regex> = LazyLock::new(|| {
        Regex::new(r"(?m)^\| Claim .*\n(?:\|.*\n?)*").expect("the pattern is a constant")
    });
    let (mut edits, mut judged) = (Vec::new(), Vec::new());
    for found in TABLE.find_iter(text) {
        let table = Table::from_markdown(found.as_str());
        let table = table.context("a table of claims has rows of several widths")?;
        let rule = found.as_str().lines().nth(1).unwrap_or_default().split('|').skip(1);
        let headings = table.header().iter().map(String::as_str);
        let columns: Vec<_> = headings.zip(rule.map(style)).collect();
        let head = columns.iter().filter(|(name, _)| *name != PLACE);
        let head: String = head.map(|(name, style)| format!("<th{style}>{name}</th>")).collect();
        let mut set = format!(
            "<div class=\"table-wrapper\"><table class=\"claims\">\n<thead><tr>{head}</tr>\
             </thead>\n<tbody>\n"
        );
        for cells in table.rows() {
            judged.push(push_row(&mut set, cells, &columns, ledger, quotes)?);
        }
        set.push_str("</tbody></table></div>\n");
        edits.push((found.range(), set));
    }
    if edits.is_empty() {
        return Ok(text.to_string());
    }
    Ok(splice(text, edits).replace("{{verdicts}}", &counts(&judged)))
}

/// As mdBook aligns the cells of a column with this rule.
fn style(rule: &str) -> &'static str {
    let is_right = rule.trim().starts_with('-') && rule.trim().ends_with(':');
    if is_right { " style=\"text-align: right\"" } else { "" }
}

/// A cell as HTML.
fn html(cell: &str) -> String {
    let mut html = String::new();
    // After a word nothing begins a list, a heading or another block.
    push_html(&mut html, Parser::new_ext(&format!("x {cell}"), options()));
    let inside = html.strip_prefix("<p>x").and_then(|html| html.strip_suffix("</p>\n"));
    inside.unwrap_or(&html).trim().to_string()
}

fn push_row(
    set: &mut String,
    cells: &[String],
    columns: &[(&str, &str)],
    ledger: &dyn Ledger,
    quotes: &Quotes,
) -> Result<Judged> {
    let [name, values @ .., reason] = cells else { bail!("a table of claims has two columns") };
    let id = name.strip_prefix('`').and_then(|rest| rest.split_once('`'));
    let (id, gist) =
        id.with_context(|| format!("{name}: a row of this table begins with the id of its claim"))?;
    let entry = ledger.entry(id).with_context(|| format!("the ledger has no claim {id}"))?;
    let verdict = entry.verdict.with_context(|| format!("the ledger has no verdict on {id}"))?;
    let kind = entry.kind;
    let (mut said, mut below) = (String::new(), Vec::new());
    for (value, (label, style)) in values.iter().zip(&columns[1..]) {
        let value = html(value);
        if *label == PLACE {
            below.push(value);
        } else {
            write!(said, "<td data-label=\"{label}\"{style}>{value}</td>")?;
        }
    }
    if let Some(links) = quotes.get(id) {
        below.push(format!("quoted in {}", links.join(", ")));
    }
    writeln!(
        set,
        "<tr id=\"{id}\" data-kind=\"{kind}\" data-part=\"{}\" data-verdict=\"{}\">\
         <td><code>{id}</code> <span class=\"gist\">{}</span> <small>{}</small></td>{said}\
         <td>{} <span class=\"reason\">{}</span></td></tr>",
        part(id),
        slug(&verdict),
        html(gist),
        below.join("; "),
        tag(&verdict),
        after_verdict(reason, &verdict)
    )?;
    Ok(Judged { id: id.to_string(), kind, verdict })
}

/// What a cell says besides its verdict, which it begins with.
fn after_verdict(cell: &str, verdict: &str) -> String {
    let html = html(cell);
    let bold = format!("<strong>{verdict}</strong>");
    let rest = html.strip_prefix(&bold).or_else(|| html.strip_prefix(verdict)).unwrap_or(&html);
    rest.trim_start_matches(['.', ' ']).to_string()
}

/// The part of the paper that an id begins with: `T4` for Table 4, `P6` for Section 6, `A`, `F`,
/// and `X` for what is not in it.
fn part(id: &str) -> &str {
    let part = id.split('.').next().unwrap_or(id);
    if part.starts_with('F') { "F" } else { part }
}

fn tag(verdict: &str) -> String {
    format!("<span class=\"tag {}\">{verdict}</span>", slug(verdict))
}

/// A verdict as it stands in an address.
fn slug(verdict: &str) -> String {
    verdict.replace(' ', "-")
}

/// How many cells and sentences of the paper have each verdict, the most frequent first, and apart
/// from them what is not in the paper.
fn counts(claims: &[Judged]) -> String {
    let of_the_paper = |claim: &&Judged| PRINTED.contains(&claim.kind.as_str());
    let mut verdicts: Vec<(usize, &str)> = Vec::new();
    for claim in claims.iter().filter(of_the_paper) {
        match verdicts.iter_mut().find(|(_, verdict)| *verdict == claim.verdict) {
            Some((count, _)) => *count += 1,
            None => verdicts.push((1, &claim.verdict)),
        }
    }
    verdicts.sort_by_key(|(count, _)| Reverse(*count));

    let mut table = String::from(
        "<div class=\"table-wrapper\"><table class=\"verdicts\">\n<thead><tr><th>Verdict</th>\
         <th>cells</th><th>sentences</th><th>claims</th></tr></thead>\n<tbody>\n",
    );
    for (_, verdict) in verdicts {
        let tag = tag(verdict);
        push_counts(&mut table, claims, &tag, Some(verdict), PRINTED);
    }
    table.push_str("</tbody>\n<tfoot>\n");
    push_counts(&mut table, claims, "of the paper", None, PRINTED);
    push_counts(&mut table, claims, "added by us", None, ADDED);
    table.push_str("</tfoot></table></div>\n");
    table
}

/// A row of counts: in the one table, in the other, in both. A count leads to the first claim of
/// those counted; `data-filter` is the address of all of them, where there is a script to filter.
fn push_counts(
    table: &mut String,
    claims: &[Judged],
    name: &str,
    verdict: Option<&str>,
    kinds: [&str; 2],
) {
    let _ = write!(table, "<tr><th scope=\"row\">{name}</th>");
    for counted in [&kinds[..1], &kinds[1..], &kinds] {
        let is_counted = |claim: &&Judged| {
            counted.contains(&claim.kind.as_str())
                && verdict.is_none_or(|verdict| verdict == claim.verdict)
        };
        let found: Vec<&Judged> = claims.iter().filter(is_counted).collect();
        let mut filters = verdict.map(|verdict| format!("verdict={}", slug(verdict)));
        if let [kind] = counted {
            let kind = format!("part={kind}");
            filters = Some(filters.map_or(kind.clone(), |filters| format!("{filters}&amp;{kind}")));
        }
        let count = found.len();
        let _ = match (found.first(), filters) {
            (Some(Judged { id, .. }), Some(filters)) => {
                write!(table, "<td><a href=\"#{id}\" data-filter=\"{filters}\">{count}</a></td>")
            }
            _ => write!(table, "<td>{count}</td>"),
        };
    }
    table.push_str("</tr>\n");
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ledger::Entry;

    fn ledger(id: &str) -> Option<Entry> {
        let (kind, verdict) = match id {
            "T4.a" => ("cell", "wrong"),
            "T4.b" => ("cell", "reproduced"),
            "F7" => ("sentence", "wrong"),
            "X.c" => ("finding", "not stated"),
            _ => return None,
        };
        let verdict = Some(verdict.to_string());
        Some(Entry { verdict, kind: kind.to_string(), ..Entry::default() })
    }

    const TABLE: &str = "| Claim | where | stated | verdict |\n| --- | --- | --: | --- |\n\
                         | `T4.a` some *gist* | Table 4 | \\|2\\| | **wrong**. A reason. |\n\
                         | `T4.b` other | Table 4 | 2 | reproduced |\n\
                         | `F7` it | Figure 7 | 3 | **wrong** |\n\
                         | `X.c` ours |  | — | not stated |\n";

    fn set(text: &str) -> Result<String> {
        let links = vec!["<a>one</a>".to_string(), "<a>two</a>".to_string()];
        super::set(text, &ledger, &Quotes::from([("T4.a".to_string(), links)]))
    }

    /// Catches: a row without what filters and links need; Markdown left in a cell, a bar that is
    /// still escaped, the verdict said twice, a claim quoted nowhere that says it is.
    #[test]
    fn a_row_has_its_claim_its_verdict_and_its_quotes() {
        let set = set(&format!("Before.\n\n{TABLE}\nAfter.\n")).unwrap();
        let row = "<tr id=\"T4.a\" data-kind=\"cell\" data-part=\"T4\" data-verdict=\"wrong\">\
                   <td><code>T4.a</code> <span class=\"gist\">some <em>gist</em></span> \
                   <small>Table 4; quoted in <a>one</a>, <a>two</a></small></td>\
                   <td data-label=\"stated\" style=\"text-align: right\">|2|</td>\
                   <td><span class=\"tag wrong\">wrong</span> \
                   <span class=\"reason\">A reason.</span></td></tr>\n";
        assert!(set.contains(row), "{set}");
        assert!(set.starts_with("Before.") && set.ends_with("\nAfter.\n"), "{set}");
        assert!(set.contains("data-part=\"F\"") && set.contains("data-verdict=\"not-stated\""));
        assert_eq!(set.matches("quoted in").count(), 1);
    }

    /// Catches: what we added counted as the paper's; a claim counted in the other column or under
    /// another verdict; a verdict left out; a count that leads to other claims.
    #[test]
    fn verdicts_are_counted_by_kind() {
        let set = set(&format!("{{{{verdicts}}}}\n\n{TABLE}")).unwrap();
        let cell = |count, id, filter| {
            format!("<td><a href=\"#{id}\" data-filter=\"{filter}\">{count}</a></td>")
        };
        let wrong = cell(1, "T4.a", "verdict=wrong&amp;part=cell")
            + &cell(1, "F7", "verdict=wrong&amp;part=sentence")
            + &cell(2, "T4.a", "verdict=wrong");
        assert!(set.contains(&wrong), "{set}");
        let added = cell(1, "X.c", "part=finding") + "<td>0</td><td>1</td>";
        assert!(set.contains(&format!("added by us</th>{added}")), "{set}");
        let rows = set.split("<tfoot>").next().unwrap();
        assert!(rows.contains("reproduced") && !rows.contains("not stated"), "{set}");
    }

    /// Catches: a claim that the ledger does not know, shown without a verdict.
    #[test]
    fn a_row_that_is_no_claim_stops_the_build() {
        for row in ["| `T9` x | 1 | wrong |", "| x | 1 | wrong |"] {
            let table = format!("| Claim | a | verdict |\n| -- | -- | -- |\n{row}\n");
            assert!(set(&table).is_err(), "{row}");
        }
        let other = "| Method | a |\n|---|---|\n| `T9` | 1 |\n";
        assert_eq!(set(other).unwrap(), other);
    }
}
