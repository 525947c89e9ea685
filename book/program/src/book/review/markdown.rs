//! A review in Markdown: for a pull request as it stands, and made into a page or into plain text
//! by [`render`](super::render). Text of snapshots, of files and of git is never markup in it.

use anyhow::Result;
use pendula_study::charts::wrapped;
use pendula_study::claims::Verdict;

use super::claims::Claim;
use super::groups::{Group, Item};
use super::source::Change;
use super::verdict::{Weight, counted, sentences};
use super::words::{code, difference, link, prose, row, summary};
use super::{Figure, Review, Turn};
use crate::book::preprocess::markdown::fence;
use pendula_judge::printable::printable;

/// A review, written.
#[derive(Clone, Debug, Default)]
pub struct Document {
    /// The worst that happened, or that nothing did.
    pub headline: String,
    /// All else, in Markdown.
    pub body: String,
    /// The drawings, as HTML, that stand on a page where the body has [`Document::place`].
    pub drawings: Vec<String>,
}

/// How many lines of a file or of a change in it are shown.
const LINES: usize = 80;

impl Document {
    /// Writes a review.
    pub fn new(review: &Review) -> Result<Self> {
        let mut document = Self::default();
        let said = sentences(review);
        document.headline = said.first().map(|(_, text)| printable(text)).unwrap_or_default();
        let rest = said.iter().skip(1);
        document.list(rest.clone().filter(|(weight, _)| *weight != Weight::Calm).map(|said| {
            let text = prose(&said.1);
            if said.0 == Weight::Alarm { format!("**{text}.**") } else { format!("{text}.") }
        }));
        let [before, now] = &review.versions;
        document.paragraph(&prose(&format!("Before: {before}. Now: {now}.")));
        document.changes(review)?;
        document.claims(&review.claims);
        document.figures(&review.figures);
        document.quotes(review);
        let good: Vec<String> = rest
            .filter(|(weight, _)| *weight == Weight::Calm)
            .map(|(_, text)| format!("{}.", prose(text)))
            .collect();
        if !good.is_empty() {
            document.heading(2, "As it should be");
            document.list(good);
        }
        if !review.recorded.is_empty() {
            let names = code(&review.recorded);
            let text = "Not computed, but compared as their files stand:";
            document.paragraph(&format!("{text} {names}."));
        }
        document.accept(review, said.iter().any(|(weight, _)| *weight == Weight::Alarm));
        Ok(document)
    }

    /// All of it, for a pull request.
    pub fn to_markdown(&self) -> String {
        format!("### {}\n\n{}", prose(&self.headline), self.body)
    }

    /// Where a drawing stands.
    pub fn place(number: usize) -> String {
        format!("<!-- drawing {number} -->")
    }

    fn paragraph(&mut self, markdown: &str) {
        self.body += &format!("{markdown}\n\n");
    }

    fn heading(&mut self, level: usize, text: &str) {
        self.paragraph(&format!("{} {}", "#".repeat(level), prose(text)));
    }

    fn list(&mut self, items: impl IntoIterator<Item = String>) {
        let items: String = items.into_iter().map(|item| format!("* {item}\n")).collect();
        if !items.is_empty() {
            self.paragraph(items.trim_end());
        }
    }

    /// A table of what moved; without its last column if nothing stands there.
    fn table(&mut self, items: &[Item]) {
        let rows: Vec<_> = items.iter().map(|item| row(item).map(|cell| prose(&cell))).collect();
        let width = if rows.iter().all(|row| row[3].is_empty()) { 3 } else { 4 };
        let line = |cells: [&str; 4]| format!("| {} |\n", cells[..width].join(" | "));
        let head = [["", "before", "now", "change"], ["---", "--:", "--:", "--:"]];
        let rows = rows.iter().map(|row| row.each_ref().map(String::as_str));
        let table: String = head.into_iter().chain(rows).map(line).collect();
        self.paragraph(table.trim_end());
    }

    /// Code, in a fence longer than any in it.
    fn code(&mut self, language: &str, text: &str) {
        let fence = fence(text, 3);
        let text = printable(text.trim_end());
        self.paragraph(&format!("{fence}{language}\n{text}\n{fence}"));
    }

    fn draw(&mut self, drawing: String) {
        self.paragraph(&Self::place(self.drawings.len()));
        self.drawings.push(drawing);
    }

    /// What moved, by method, with the change in its file; then what changed elsewhere, and the
    /// methods of which nothing in their own files explains what moved.
    fn changes(&mut self, review: &Review) -> Result<()> {
        let mut changed = review.code.changed()?;
        let (mut own, mut others) = (Vec::new(), Vec::new());
        for group in &review.groups {
            let file = group.method.as_ref().map(|title| review.code.file_of(title)).transpose()?;
            let file = file.flatten();
            let is_changed = file.is_some_and(|file| changed.iter().any(|name| name == file));
            if is_changed { &mut own } else { &mut others }.push((file, group));
        }
        changed.retain(|name| !own.iter().any(|(file, _)| *file == Some(name)));
        for (file, group) in own {
            self.method(review, file, group)?;
        }
        self.elsewhere(review, &changed)?;
        for (file, group) in others {
            self.method(review, file, group)?;
        }
        Ok(())
    }

    /// A method: the change in its file, and what moved.
    fn method(&mut self, review: &Review, file: Option<&str>, group: &Group) -> Result<()> {
        let title = group.method.as_deref().unwrap_or("Of no one method");
        self.heading(2, &format!("{title}: {}", summary(group)));
        if let Some(name) = file {
            match review.code.change(name)? {
                None => self.paragraph(&format!("Its file {} is as it was.", link(name))),
                Some(change) => self.change(name, &change),
            }
        }
        self.group(group);
        Ok(())
    }

    fn change(&mut self, name: &str, Change { language, why, text }: &Change) {
        self.paragraph(&format!("{}, {}:", link(name), prose(why)));
        let lines: Vec<&str> = text.lines().collect();
        let mut shown = lines[..lines.len().min(LINES)].join("\n");
        if lines.len() > LINES {
            shown += &format!("\n… {} more", counted(lines.len() - LINES, "line"));
        }
        self.code(language, &shown);
    }

    /// What changed in the code, apart from the files of methods that moved.
    fn elsewhere(&mut self, review: &Review, changed: &[String]) -> Result<()> {
        const FEW: usize = 4;
        if changed.is_empty() || review.is_empty() {
            return Ok(());
        }
        let is_first = !self.body.contains("\n## ");
        let which = if is_first { "What changed" } else { "What else changed" };
        self.heading(2, &format!("{which} in the code"));
        if changed.len() > FEW {
            let since = prose(review.code.since().unwrap_or_default());
            self.paragraph(&format!("Since {since}: {}.", code(changed)));
            return Ok(());
        }
        for name in changed {
            if let Some(change) = review.code.change(name)? {
                self.change(name, &change);
            }
        }
        Ok(())
    }

    fn group(&mut self, group: &Group) {
        for items in group.items.chunk_by(|a, b| a.shown.snapshot == b.shown.snapshot) {
            let snapshot = &items[0].shown.snapshot;
            self.heading(3, &format!("In `{snapshot}`"));
            self.table(items);
            if let Some(sign) = group.sign.as_ref().filter(|_| snapshot == "orders") {
                self.paragraph(&format!("**{}.**", prose(sign)));
            }
            let mut also: Vec<&str> =
                items.iter().flat_map(|i| &i.also).map(|cell| cell.snapshot.as_str()).collect();
            also.sort_unstable();
            also.dedup();
            if !also.is_empty() {
                self.paragraph(&format!("Also in {}.", code(&also)));
            }
        }
    }

    fn claims(&mut self, claims: &[Turn]) {
        if claims.is_empty() {
            return;
        }
        self.heading(2, "Claims");
        self.list(claims.iter().map(|turn| {
            let Turn { old, new, claim } = turn;
            let Claim { id, gist, stated, measured, remark, .. } = claim;
            let word = |verdict: Option<Verdict>| {
                verdict.map_or_else(|| "none".to_string(), |verdict| verdict.to_string())
            };
            let verdict = match turn.flips() {
                true => format!("{} → **{}**", word(*old), word(*new)),
                false => format!("{}, for another reason", word(*new)),
            };
            let values = prose(&format!("stated {stated}, measured {measured}. {remark}"));
            format!("{} {}: {verdict}; {}", code(&[id]), prose(gist), values.trim_end())
        }));
        let turned = |verdict| claims.iter().any(|turn| turn.flips() && turn.new == Some(verdict));
        let meanings: Vec<String> = Verdict::ALL
            .into_iter()
            .filter(|verdict| turned(*verdict))
            .map(|verdict| prose(&format!("{verdict}: {}.", verdict.meaning())))
            .collect();
        if !meanings.is_empty() {
            self.paragraph("What these verdicts mean:");
            self.list(meanings);
        }
    }

    fn figures(&mut self, figures: &[Figure]) {
        let (seen, unseen): (Vec<&Figure>, Vec<_>) = figures.iter().partition(|f| f.is_visible());
        if !figures.is_empty() {
            self.heading(2, "Figures");
        }
        for figure in seen {
            self.paragraph(&format!("{}: {}.", code(&[&figure.name]), prose(&difference(figure))));
            self.draw(super::render::figure(figure));
        }
        if !unseen.is_empty() {
            let names: Vec<&String> = unseen.iter().map(|figure| &figure.name).collect();
            self.paragraph(&format!("Not visibly: {}.", code(&names)));
        }
    }

    fn quotes(&mut self, review: &Review) {
        if review.quotes.is_empty() {
            return;
        }
        self.heading(2, "Lines of the book that quote what moved");
        self.list(review.quotes.iter().map(|quote| {
            let file = link(&format!("book/src/{}.md", quote.chapter));
            let (line, moved) = (quote.line, prose(&quote.moved.join("; ")));
            format!("{file}, line {line}: {moved}\\\n  {}", code(&[&quote.text]))
        }));
    }

    /// How to accept, and what goes into the changelog.
    fn accept(&mut self, review: &Review, is_alarming: bool) {
        let moved: Vec<&str> = review.snapshots.iter().map(|change| change.name.as_str()).collect();
        if !moved.is_empty() {
            self.paragraph(&format!("Snapshots that moved: {}.", code(&moved)));
        }
        if !review.waiting.is_empty() {
            let names = code(&review.waiting);
            self.paragraph(&format!("Of the working tree not yet accepted: {names}."));
        }
        if review.acceptable.is_empty() {
            return;
        }
        self.heading(2, "Accept");
        if is_alarming {
            self.paragraph(
                "**Take care: something above is no longer as it should be. Who accepts it says \
                 that it is right so.**",
            );
        }
        self.paragraph("A snapshot is accepted whole, with all that moved in it.");
        self.code("text", &format!("cargo run -- review --accept {}", review.acceptable.join(" ")));
        self.paragraph("For `CHANGELOG.md`, with a reason that a reader can check:");
        let names = code(&review.acceptable);
        let entry = wrapped(&format!("* …, because …. Moved: {names}."));
        // The later lines are part of the same bullet.
        self.code("text", &entry.replace('\n', "\n  "));
    }
}
