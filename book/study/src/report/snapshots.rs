//! Every snapshot of the book: what it is, and its content as the code makes it now.

use std::panic::resume_unwind;
use std::thread;

use pendula::methods::PositionVerlet;

use super::bits::bits;
use super::figures::{Drawing, figures};
use super::tables;
use crate::claims::Ledger;
use crate::experiments::{PaperMethod, STEPS, Study, convergence};

/// What a snapshot consists of; in the order in which they are best reviewed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// Rows and columns.
    Table,
    /// A drawing.
    Figure,
    /// Hashes of states.
    Hashes,
    /// A table that takes minutes to make: a command of its own writes it, and no test compares it.
    Recorded,
    /// A difference of tables, shown to a reader as an example.
    Example,
}

impl Kind {
    /// The anchor around the content, by which a chapter includes it.
    pub const fn anchor(self) -> &'static str {
        match self {
            Self::Table | Self::Recorded => "table",
            Self::Figure => "figure",
            Self::Hashes => "hashes",
            Self::Example => "diff",
        }
    }

    /// The stem of the file in `snapshots/` that holds the snapshot `name`. It begins with a digit,
    /// since `cargo insta review` goes through the files by name.
    pub fn file_stem(self, name: &str) -> String {
        format!("{}_{name}", self as u8 + 1)
    }
}

/// The snapshots that no test compares, with the commands that write them.
pub const RECORDED: [(&str, &str); 1] = [("what_moves_when", "book/study/what_moves_when/run")];

/// A snapshot: the file `snapshots/DIGIT_NAME.snap`.
#[derive(Clone, Debug)]
pub struct Snapshot {
    /// Its name.
    pub name: String,
    /// What it consists of.
    pub kind: Kind,
    /// What it shows, in a line.
    pub about: String,
    /// The content between its anchors.
    content: String,
}

impl Snapshot {
    fn table(name: &str, about: &str, table: &super::table::Table) -> Self {
        let (name, about) = (name.to_string(), about.to_string());
        Self { name, kind: Kind::Table, about, content: table.to_markdown() }
    }

    /// The content: a table in Markdown, a figure as HTML, or a difference in a fence.
    pub fn content(&self) -> &str {
        &self.content
    }

    /// The text of the file below insta's header: the content between anchors, so that a chapter
    /// can include it.
    pub fn text(&self) -> String {
        let (anchor, content) = (self.kind.anchor(), &self.content);
        format!("<!-- ANCHOR: {anchor} -->\n{content}<!-- ANCHOR_END: {anchor} -->\n")
    }
}

/// The paper's Table `number`, stated and measured.
///
/// # Panics
/// For a number that is not among [`tables::TABLES`].
pub fn of_table(ledger: &Ledger, number: u32) -> Snapshot {
    let table = tables::table(ledger, number).expect("a table of the paper");
    let about = format!("The paper's Table {number}, stated and measured");
    Snapshot::table(&format!("table_{number}"), &about, &table)
}

/// The slopes of Table 4's energy errors.
pub fn of_energy_slopes(study: &Study) -> Snapshot {
    Snapshot::table("slopes", "Slopes of the energy error (Table 4)", &tables::energy_slopes(study))
}

/// The slopes of the error of the state, method by method.
pub fn of_state_slopes(study: &Study) -> Snapshot {
    let about = "Slopes of the error of the state, of every method on its ladder of steps";
    Snapshot::table("orders", about, &tables::state_slopes(study))
}

/// The measured properties of every method.
pub fn of_methods(study: &Study) -> Snapshot {
    Snapshot::table("methods", "Every method, as measured", &tables::methods(study))
}

/// Theory's predictions beside the measurements.
pub fn of_predictions(ledger: &Ledger) -> Snapshot {
    let about = "What theory predicts for 49 cells, beside what is measured";
    Snapshot::table("predictions", about, &tables::predictions(ledger))
}

/// The systems beyond the simple pendulum.
pub fn of_systems() -> Snapshot {
    let about = "Systems beyond the pendulum: what is known and what is found";
    Snapshot::table("beyond", about, &tables::beyond())
}

/// The claims that are cells.
pub fn of_cells(ledger: &Ledger) -> Snapshot {
    let about = "The ledger of the paper's cells, judged";
    Snapshot::table("ledger_cells", about, &tables::cells(ledger))
}

/// The claims that are sentences.
pub fn of_sentences(ledger: &Ledger) -> Snapshot {
    let about = "The ledger of the paper's sentences, judged";
    Snapshot::table("ledger_sentences", about, &tables::sentences(ledger))
}

/// A figure.
pub fn of_figure(drawing: &Drawing, study: &Study) -> Snapshot {
    let content = drawing.html(study);
    // An SVG's title is what its element of that name says.
    let title = content.split_once("<title").and_then(|(_, rest)| {
        let (_, title) = rest.split_once('>')?;
        title.split_once("</title>")
    });
    let about = title.map_or(String::new(), |(title, _)| title.to_string());
    Snapshot { name: drawing.name.to_string(), kind: Kind::Figure, about, content }
}

/// The hashes of long runs.
pub fn of_bits() -> Snapshot {
    let about = "Hashes of a million steps of each method of the paper, and fewer of the others";
    let (name, about) = ("bits".to_string(), about.to_string());
    Snapshot { name, kind: Kind::Hashes, about, content: bits() }
}

/// What a change looks like to its reviewer: Table 4 before and after Störmer–Verlet drifts first
/// and kicks in the middle, which is as good a method, of the same order.
pub fn of_a_change(study: &Study) -> Snapshot {
    let mut changed = study.clone();
    for row in &mut changed.convergence {
        if PaperMethod::of(row.method) == Some(PaperMethod::StormerVerlet) {
            row.drift = STEPS.map(|step| convergence::drift(&PositionVerlet, step));
        }
    }
    // Every other step, so that the example fits on a page.
    let narrow = |line: &str| {
        let cells: Vec<&str> = line.split('|').collect();
        [0, 1, 2, 3, 5, 7, 8].map(|column| cells[column]).join("|") + "\n"
    };
    let table = |study| -> String {
        of_table(&Ledger::new(study), 4).content.lines().map(narrow).collect()
    };
    let (before, after) = (table(study), table(&changed));
    let rows =
        before.lines().zip(after.lines()).flat_map(|(before, after)| match before == after {
            true => vec![format!(" {before}\n")],
            false => vec![format!("-{before}\n"), format!("+{after}\n")],
        });
    Snapshot {
        name: "a_change".to_string(),
        kind: Kind::Example,
        about: "An example of a difference, for the appendix on changing a method".to_string(),
        content: format!("```diff\n{}```\n", rows.collect::<String>()),
    }
}

/// All that are computed, in the order in which they are best reviewed. Each is made in a thread of
/// its own.
pub fn all(study: &Study, ledger: &Ledger) -> Vec<Snapshot> {
    type Make<'a> = Box<dyn FnOnce() -> Snapshot + Send + 'a>;
    let mut makes: Vec<Make<'_>> = Vec::new();
    for number in tables::TABLES {
        makes.push(Box::new(move || of_table(ledger, number)));
    }
    makes.push(Box::new(|| of_energy_slopes(study)));
    makes.push(Box::new(|| of_state_slopes(study)));
    makes.push(Box::new(|| of_methods(study)));
    makes.push(Box::new(|| of_predictions(ledger)));
    makes.push(Box::new(|| of_cells(ledger)));
    makes.push(Box::new(|| of_sentences(ledger)));
    makes.push(Box::new(of_systems));
    for drawing in figures() {
        makes.push(Box::new(|| of_figure(drawing, study)));
    }
    makes.push(Box::new(of_bits));
    makes.push(Box::new(|| of_a_change(study)));
    thread::scope(|scope| {
        let threads: Vec<_> = makes.into_iter().map(|make| scope.spawn(make)).collect();
        let join = |thread: thread::ScopedJoinHandle<'_, Snapshot>| match thread.join() {
            Ok(snapshot) => snapshot,
            Err(panic) => resume_unwind(panic),
        };
        threads.into_iter().map(join).collect()
    })
}
