//! A review in Markdown: for a pull request as it stands, and made into a page or into plain text
//! by [`render`](super::render). Text of snapshots, of files and of git is never markup in it.

use anyhow::Result;
use pendula_study::charts::wrapped;

use super::causes::{Group, Item};
use super::slopes::{Slope, Slopes};
use super::source::Change;
use super::verdict::{Weight, counted, sentences};
use super::words::{capital, code, difference, link, prose, row, shown, summary};
use super::{Figure, Review, Turn};

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

/// What folds the text up to [`UNFOLD`], under these words.
pub const FOLDS: [&str; 2] = [
    "<details><summary>Where else these stand</summary>",
    "<details><summary>The whole file</summary>",
];
/// Where it ends.
pub const UNFOLD: &str = "</details>";

/// What two of the columns are.
const DISTANCES: &str = "Theory: the distance from the predicted value in units of the \
                         prediction’s tolerance. Paper: that from what the paper prints, in half \
                         units of its last digit. Up to 1 it agrees.";

/// How many lines of a difference are shown.
const LINES: usize = 80;

impl Document {
    /// Writes a review.
    ///
    /// # Errors
    /// If the code cannot be read, or git does not say what changed.
    pub fn new(review: &Review) -> Result<Self> {
        let mut document = Self::default();
        let said = sentences(review);
        document.headline = said.first().map(|(_, text)| text.clone()).unwrap_or_default();
        let rest = said.iter().skip(1);
        document.list(rest.clone().filter(|(weight, _)| *weight != Weight::Calm).map(|said| {
            let text = prose(&said.1);
            if said.0 == Weight::Alarm { format!("**{text}.**") } else { format!("{text}.") }
        }));
        let [before, now] = &review.versions;
        document.paragraph(&prose(&format!("Before: {before}. Now: {now}.")));
        if !review.recorded.is_empty() {
            let names = code(&review.recorded);
            let text = "Not computed, but compared as their files stand:";
            document.paragraph(&format!("{text} {names}."));
        }
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

    /// A table without the columns in which nothing stands.
    fn table(&mut self, header: &[&str], rows: &[Vec<String>]) {
        let is_used =
            |column: &usize| *column == 0 || rows.iter().any(|row| !row[*column].is_empty());
        let columns: Vec<usize> = (0..header.len()).filter(is_used).collect();
        let line = |cell: &dyn Fn(usize) -> String| {
            let cells: Vec<String> = columns.iter().map(|column| cell(*column)).collect();
            format!("| {} |\n", cells.join(" | "))
        };
        let mut table = line(&|column| prose(header[column]));
        table += &line(&|column| if column == 0 { "---" } else { "--:" }.to_string());
        table.extend(rows.iter().map(|row| line(&|column| prose(&row[column]))));
        self.paragraph(table.trim_end());
    }

    fn fold(&mut self, words: &str, inside: impl FnOnce(&mut Self)) {
        self.paragraph(words);
        inside(self);
        self.paragraph(UNFOLD);
    }

    /// Code, in a fence longer than any in it.
    fn code(&mut self, language: &str, text: &str) {
        let longest = text.split(|c| c != '`').map(str::len).max().unwrap_or(0);
        let fence = "`".repeat((longest + 1).max(3));
        self.paragraph(&format!("{fence}{language}\n{}\n{fence}", text.trim_end()));
    }

    fn draw(&mut self, drawing: String) {
        self.paragraph(&Self::place(self.drawings.len()));
        self.drawings.push(drawing);
    }

    /// What moved, by method, with the change in its file; then what changed elsewhere.
    fn changes(&mut self, review: &Review) -> Result<()> {
        let Review { groups, code, .. } = review;
        let mut changed = code.changed()?;
        let (mut told, mut others, mut of_none) = (Vec::new(), Vec::new(), Vec::new());
        for group in groups {
            let Some(title) = group.method.as_deref() else {
                of_none.push(group);
                continue;
            };
            let file = code.file_of(title)?;
            let is_changed = file.is_some_and(|file| changed.iter().any(|name| name == file));
            // What nothing in its file explains is shown together, if there is much of it.
            let is_lost = group.items().any(|item| item.is_slope() && item.leaves());
            let is_few = groups.len() <= 3 || code.since().is_none() && group.leaves();
            match is_changed || is_few && (is_lost || changed.is_empty()) {
                true => told.push((!is_changed, title, file, group)),
                false => others.push((file, group)),
            }
        }
        changed.retain(|name| !told.iter().any(|(_, _, file, _)| *file == Some(name)));
        // What has its reason in its own file comes first.
        told.sort_by_key(|(is_same, ..)| *is_same);
        let own = told.iter().filter(|(is_same, ..)| !is_same).count();
        for (number, (_, title, file, group)) in told.iter().enumerate() {
            if number == own {
                self.elsewhere(review, &std::mem::take(&mut changed))?;
            }
            self.heading(2, &format!("{title}: {}", summary(group)));
            self.file(review, *file)?;
            self.group(group);
        }
        self.elsewhere(review, &changed)?;
        if !others.is_empty() {
            let (files, groups): (Vec<_>, Vec<_>) = others.into_iter().unzip();
            let merged = Group::merged(&groups);
            let n = counted(groups.len(), "method");
            self.heading(2, &format!("{n} of unchanged files: {}", summary(&merged)));
            let files: Vec<String> = files.into_iter().flatten().map(link).collect();
            self.paragraph(&files.join(", "));
            self.group(&merged);
        }
        for group in of_none {
            self.heading(2, &format!("Of no one method: {}", summary(group)));
            self.group(group);
        }
        Ok(())
    }

    /// The file of a method, and the change in it.
    fn file(&mut self, review: &Review, name: Option<&str>) -> Result<()> {
        let Some(name) = name else { return Ok(()) };
        match review.code.change(name)? {
            None => self.paragraph(&format!("Its file {} is as it was.", link(name))),
            Some(change) => self.change(name, &change, review.code.since()),
        }
        Ok(())
    }

    fn change(&mut self, name: &str, change: &Change, since: Option<&str>) {
        match change {
            Change::Difference(text) => {
                let since = prose(since.unwrap_or_default());
                self.paragraph(&format!("{}, since {since}:", link(name)));
                // The names of the files stand above.
                let from = text.find("\n@@").map_or(0, |at| at + 1);
                let lines: Vec<&str> = text[from..].lines().collect();
                let mut shown = lines[..lines.len().min(LINES)].join("\n");
                if lines.len() > LINES {
                    shown += &format!("\n… {} more", counted(lines.len() - LINES, "line"));
                }
                self.code("diff", &shown);
            }
            Change::Untracked(text) => {
                let why = match since {
                    Some(_) => "which git does not know yet",
                    None => "all of it, as git does not say what changed in it",
                };
                self.paragraph(&format!("{}, {why}:", link(name)));
                self.fold(FOLDS[1], |document| document.code("rust", text));
            }
        }
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
                self.change(name, &change, review.code.since());
            }
        }
        Ok(())
    }

    fn group(&mut self, group: &Group) {
        for part in &group.parts {
            self.heading(3, &capital(part.quantity));
            if let Some(slopes) = &part.slopes {
                self.slopes(slopes, part.quantity);
            }
            let is_shown = |item: &&Item| part.slopes.is_none() || !item.is_slope();
            let rows: Vec<_> = part.items.iter().filter(is_shown).map(row).collect();
            if !rows.is_empty() {
                self.table(&["", "before", "now", "change", "theory", "paper"], &rows);
            }
            let has_distances = part.items.iter().any(|i| i.theory.is_some() || i.paper.is_some());
            if has_distances && !self.body.contains(DISTANCES) {
                self.paragraph(DISTANCES);
            }
        }
        self.also(group);
    }

    /// The slopes, before and now, with their steps.
    fn slopes(&mut self, slopes: &Slopes, quantity: &str) {
        let of = |step: &str, side: &[Slope]| {
            let slope = side.iter().find(|slope| slope.steps == step);
            slope.map_or_else(String::new, |slope| shown(&Some(slope.said.clone())))
        };
        let sides = |step: &String| slopes.versions.each_ref().map(|side| of(step, side));
        let rows = slopes.steps().into_iter().map(|step| {
            let [before, now] = sides(&step);
            vec![step, before, now]
        });
        self.table(&["from step to step", "before", "now"], &rows.collect::<Vec<_>>());
        if let Some(sign) = slopes.sign() {
            self.paragraph(&format!("**{}.**", prose(&sign)));
        }
        let svg = slopes.svg(&capital(quantity), &format!("slopes-{}", self.drawings.len()));
        self.draw(format!("<figure class=\"slopes\">\n{svg}</figure>\n"));
    }

    /// Where the quantities of a group stand.
    fn also(&mut self, group: &Group) {
        let mut names: Vec<&str> = Vec::new();
        for cell in group.items().flat_map(Item::cells) {
            if !names.contains(&cell.snapshot.as_str()) {
                names.push(&cell.snapshot);
            }
        }
        self.paragraph(&format!("In {}.", code(&names)));
        let also = group.items().flat_map(|item| item.also.iter().map(move |cell| (item, cell)));
        let also: Vec<String> = also
            .map(|(item, cell)| {
                let place = format!("{}, {}", cell.row.replace('`', ""), cell.column);
                let both = format!("{} → {}", shown(&cell.old), shown(&cell.new));
                let label = prose(&item.label);
                format!("{label}: {}, {}: {}", code(&[&cell.snapshot]), prose(&place), prose(&both))
            })
            .collect();
        if !also.is_empty() {
            self.fold(FOLDS[0], |document| document.list(also));
        }
    }

    fn claims(&mut self, claims: &[Turn]) {
        if claims.is_empty() {
            return;
        }
        self.heading(2, "Claims");
        self.list(claims.iter().map(|turn| {
            let Turn { id, gist, old, new, stated, measured, remark } = turn;
            let word =
                |verdict: &String| if verdict.is_empty() { "none".into() } else { prose(verdict) };
            let verdict = match turn.flips() {
                true => format!("{} → **{}**", word(old), word(new)),
                false => format!("{}, for another reason", word(new)),
            };
            let values = prose(&format!("stated {stated}, measured {measured}. {remark}"));
            format!("{} {}: {verdict}; {}", code(&[id]), prose(gist), values.trim_end())
        }));
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
            let typed = if quote.typed { ", **to be typed anew**" } else { "" };
            let file = link(&format!("book/src/{}.md", quote.chapter));
            let (line, moved) = (quote.line, prose(&quote.moved.join("; ")));
            format!("{file}, line {line}{typed}: {moved}\\\n  {}", code(&[&quote.text]))
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
        self.code(
            "text",
            &format!("cargo run --release -- review --accept {}", review.acceptable.join(" ")),
        );
        self.paragraph("For `CHANGELOG.md`, with a reason that a reader can check:");
        let names = code(&review.acceptable);
        let entry = wrapped(&format!("* …, because …. Moved: {names}."));
        // The later lines are part of the same bullet.
        self.code("text", &entry.replace('\n', "\n  "));
    }
}
