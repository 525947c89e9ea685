//! The ledger's tables, as HTML, with each claim's verdict and its part of the paper, for the style
//! sheet and the filters of the page, and links back to where the chapters quote it.
//!
//! `{{verdicts}}` on that page becomes the table of the verdicts: what each means, and how many
//! claims got it.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use anyhow::{Context, Result, anyhow};
use pendula_study::claims::Verdict;
use pendula_study::report::table::{self, Table};
use pulldown_cmark::Parser;
use pulldown_cmark::html::push_html;

use super::markdown::{options, splice};
use crate::book::{Pattern, pattern};

/// Links to where each claim is quoted, by its id.
pub type Quotes = BTreeMap<String, Vec<String>>;

/// The kinds of claims that the paper makes, in the one table and the other.
const PRINTED: [&str; 2] = ["cell", "sentence"];
/// The kinds that we added to them.
const ADDED: [&str; 2] = ["finding", "reading"];

/// The columns that stand beside the claim.
const VALUES: [&str; 2] = ["stated", "measured"];

/// A row of the ledger's tables.
struct Row {
    id: String,
    gist: String,
    /// What stands in [`VALUES`].
    values: [String; 2],
    verdict: String,
    because: String,
    kind: String,
    /// Where it stands in the paper, and what else is said below it.
    place: String,
}

/// The text with each table of claims, which has that heading above its first column, as HTML.
pub fn set(text: &str, quotes: &Quotes) -> Result<String> {
    static TABLE: Pattern = Pattern::new(|| pattern(r"(?m)^\| Claim .*\n(?:\|.*\n?)*"));
    let (mut edits, mut rows) = (Vec::new(), Vec::new());
    for found in TABLE.find_iter(text) {
        let table = Table::read(found.as_str());
        let table = table.map_err(|why| anyhow!("a table of claims has {why}"))?;
        let style = |name: &str| {
            let mut columns = table.columns().iter();
            let is_right = columns.any(|column| column.heading == name && column.is_value);
            if is_right { " style=\"text-align: right\"" } else { "" }
        };
        let columns = VALUES.map(|name| (name, style(name)));
        let head = [("Claim", "")].into_iter().chain(columns).chain([("verdict", "")]);
        let head: String = head.map(|(name, style)| format!("<th{style}>{name}</th>")).collect();
        let mut set = String::new();
        for row in table.rows() {
            let row = Row::read(row)?;
            set += &row.html(columns, quotes);
            rows.push(row);
        }
        let table = format!(
            "<div class=\"table-wrapper\"><table class=\"claims\">\n<thead><tr>{head}</tr>\
             </thead>\n<tbody>\n{set}</tbody></table></div>\n"
        );
        edits.push((found.range(), table));
    }
    if edits.is_empty() {
        return Ok(text.to_string());
    }
    Ok(splice(text, edits).replace("{{verdicts}}", &counts(&rows)))
}

/// A cell as HTML.
fn html(cell: &str) -> String {
    let mut html = String::new();
    // After a word nothing begins a list, a heading or another block.
    push_html(&mut html, Parser::new_ext(&format!("x {cell}"), options()));
    let inside = html.strip_prefix("<p>x").and_then(|html| html.strip_suffix("</p>\n"));
    inside.unwrap_or(&html).trim().to_string()
}

impl Row {
    fn read(row: table::Row<'_>) -> Result<Self> {
        let id = row.id().trim_matches('`').to_string();
        let get = |name: &str| {
            let cell = row.get(name).with_context(|| format!("{id}: its table has no {name}"))?;
            Ok::<_, anyhow::Error>(cell.text.clone())
        };
        let (kind, definition) = (get("kind")?, get("definition")?);
        let (mut measured, mut place) = (get("measured")?, get("where")?);
        // Of a cell the column says what is measured.
        if !definition.is_empty() && ["cell", "finding"].contains(&kind.as_str()) {
            place = format!("{place}: {definition}");
        } else if !definition.is_empty() {
            measured = format!("{measured} ({definition})");
        }
        let values = [get("stated")?, measured];
        let (gist, verdict, because) = (get("gist")?, get("verdict")?, get("because")?);
        Ok(Self { id, gist, values, verdict, because, kind, place })
    }

    fn html(&self, columns: [(&str, &str); 2], quotes: &Quotes) -> String {
        let Self { id, gist, values, verdict, because, kind, place } = self;
        let said = values.iter().zip(columns).map(|(value, (label, style))| {
            format!("<td data-label=\"{label}\"{style}>{}</td>", html(value))
        });
        let place = (!place.is_empty()).then(|| html(place));
        let quoted = quotes.get(id).map(|links| format!("quoted in {}", links.join(", ")));
        let below: Vec<String> = place.into_iter().chain(quoted).collect();
        format!(
            "<tr id=\"{id}\" data-kind=\"{kind}\" data-part=\"{}\" data-verdict=\"{}\">\
             <td><code>{id}</code> <span class=\"gist\">{}</span> <small>{}</small></td>{}\
             <td>{} <span class=\"reason\">{}</span></td></tr>\n",
            part(id),
            slug(verdict),
            html(gist),
            below.join("; "),
            said.collect::<String>(),
            tag(verdict),
            html(because)
        )
    }
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

/// What each verdict means, and how many cells and sentences of the paper have it, the most
/// frequent first; apart from them what is not in the paper.
fn counts(rows: &[Row]) -> String {
    let mut verdicts: Vec<(usize, &str)> = Vec::new();
    for row in rows.iter().filter(|row| PRINTED.contains(&row.kind.as_str())) {
        match verdicts.iter_mut().find(|(_, verdict)| *verdict == row.verdict) {
            Some((count, _)) => *count += 1,
            None => verdicts.push((1, &row.verdict)),
        }
    }
    verdicts.sort_by_key(|(count, _)| Reverse(*count));
    let judged = verdicts.iter().map(|(_, name)| {
        let meaning = Verdict::named(name).map_or("", Verdict::meaning);
        let head = format!("{}<div class=\"meaning\">{meaning}</div>", tag(name));
        counted(rows, &head, Some(name), PRINTED)
    });
    format!(
        "<div class=\"table-wrapper\"><table class=\"verdicts\">\n<thead><tr><th>Verdict</th>\
         <th>cells</th><th>sentences</th><th>claims</th></tr></thead>\n<tbody>\n{}</tbody>\n\
         <tfoot>\n{}{}</tfoot></table></div>\n",
        judged.collect::<String>(),
        counted(rows, "of the paper", None, PRINTED),
        counted(rows, "added by us", None, ADDED)
    )
}

/// A row of counts: in the one table, in the other, in both. A count leads to the first claim of
/// those counted; `data-filter` is the address of all of them, where there is a script to filter.
fn counted(rows: &[Row], name: &str, verdict: Option<&str>, kinds: [&str; 2]) -> String {
    let cell = |kinds: &[&str]| {
        let is_counted = |row: &&Row| {
            kinds.contains(&row.kind.as_str()) && verdict.is_none_or(|name| name == row.verdict)
        };
        let found: Vec<&Row> = rows.iter().filter(is_counted).collect();
        let mut filters: Vec<String> =
            verdict.iter().map(|name| format!("verdict={}", slug(name))).collect();
        if let [kind] = kinds {
            filters.push(format!("part={kind}"));
        }
        let (count, filters) = (found.len(), filters.join("&amp;"));
        match found.first() {
            Some(Row { id, .. }) if !filters.is_empty() => {
                format!("<td><a href=\"#{id}\" data-filter=\"{filters}\">{count}</a></td>")
            }
            _ => format!("<td>{count}</td>"),
        }
    };
    let cells: String = [&kinds[..1], &kinds[1..], &kinds].into_iter().map(cell).collect();
    format!("<tr><th scope=\"row\">{name}</th>{cells}</tr>\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = "\
        | Claim | gist | stated | measured | verdict | because | kind | where | definition |\n\
        | --- | --- | --: | --- | --- | --- | --- | --- | --- |\n\
        | `T4.a` | some *gist* | \\|2\\| | 3 | wrong | A reason. | cell | Table 4 | of *it* |\n\
        | `T4.b` | other | 2 | 2 | reproduced |  | cell | Table 4 |  |\n\
        | `F7` | it | 3 | 4 | wrong |  | sentence | Figure 7 | the last |\n\
        | `X.c` | ours | — | 5 | not stated |  | finding |  |  |\n";

    fn set(text: &str) -> Result<String> {
        let links = vec!["<a>one</a>".to_string(), "<a>two</a>".to_string()];
        super::set(text, &Quotes::from([("T4.a".to_string(), links)]))
    }

    /// Catches: a row without what filters and links need; Markdown left in a cell, a bar that is
    /// still escaped, the verdict said twice, a claim quoted nowhere that says it is; a place that
    /// is none; a definition that is lost, or stands elsewhere.
    #[test]
    fn a_row_has_its_claim_its_verdict_and_its_quotes() {
        let set = set(&format!("Before.\n\n{TABLE}\nAfter.\n")).unwrap();
        let row = "<tr id=\"T4.a\" data-kind=\"cell\" data-part=\"T4\" data-verdict=\"wrong\">\
                   <td><code>T4.a</code> <span class=\"gist\">some <em>gist</em></span> \
                   <small>Table 4: of <em>it</em>; quoted in <a>one</a>, <a>two</a></small></td>\
                   <td data-label=\"stated\" style=\"text-align: right\">|2|</td>\
                   <td data-label=\"measured\">3</td>\
                   <td><span class=\"tag wrong\">wrong</span> \
                   <span class=\"reason\">A reason.</span></td></tr>\n";
        assert!(set.contains(row), "{set}");
        assert!(set.starts_with("Before.") && set.ends_with("\nAfter.\n"), "{set}");
        assert!(set.contains("data-part=\"F\"") && set.contains("data-verdict=\"not-stated\""));
        assert_eq!(set.matches("quoted in").count(), 1);
        assert!(set.contains("<small>Figure 7</small>") && set.contains(">4 (the last)</td>"));
        assert!(set.contains("<span class=\"gist\">ours</span> <small></small>"), "{set}");
    }

    /// Catches: what we added counted as the paper's; a claim counted in the other column or under
    /// another verdict; a verdict left out, or explained as another; a count that leads to other
    /// claims.
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
        let wrong =
            format!("{}<div class=\"meaning\">{}</div>", tag("wrong"), Verdict::Wrong.meaning());
        assert!(set.contains(&wrong), "{set}");
        let rows = set.split("<tfoot>").next().unwrap();
        assert!(rows.contains("reproduced") && !rows.contains("not stated"), "{set}");
    }

    /// Catches: a table that lacks what a row has to say, set without it; another table set so.
    #[test]
    fn a_table_without_a_column_stops_the_build() {
        let table = TABLE.replace(" verdict ", " word ");
        assert!(set(&table).unwrap_err().to_string().contains("T4.a: its table has no verdict"));
        let other = "| Method | a |\n|---|---|\n| `T9` | 1 |\n";
        assert_eq!(set(other).unwrap(), other);
    }
}
