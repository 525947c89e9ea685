//! Every snapshot of the book: what it is, and its content as the code makes it now.

use std::sync::LazyLock;
use std::thread;

use pendula::methods::PositionVerlet;
use pendula::registry::InSteps;

use super::figures::{Drawing, figures};
use super::table::Table;
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
    /// Hashes of states, made by the example `bits` of `book/dynamics` and compared by a test: what
    /// builds the book need not compile it.
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

    /// Whether the study makes it, and not a command of its own.
    pub const fn is_of_the_study(self) -> bool {
        !matches!(self, Self::Recorded | Self::Hashes)
    }

    /// The stem of the file in `snapshots/` that holds the snapshot `name`. It begins with a digit,
    /// since `cargo insta review` goes through the files by name.
    pub fn file_stem(self, name: &str) -> String {
        format!("{}_{name}", self as u8 + 1)
    }
}

/// The snapshots that no test compares, with the commands that write them.
pub const RECORDED: [(&str, &str); 7] = [
    ("strangers", "book/strangers/run"),
    ("strangers_all", "book/strangers/run"),
    ("strangers_defects", "book/strangers/run"),
    ("strangers_libraries", "book/strangers/run"),
    ("strangers_named", "book/strangers/run"),
    ("strangers_observed", "book/strangers/run"),
    ("processors", ".ci/processors --record"),
];

/// A snapshot: the file `snapshots/DIGIT_NAME.snap`.
pub struct Snapshot<'a> {
    /// Its name.
    pub name: String,
    /// What it consists of.
    pub kind: Kind,
    /// What it shows, in a line.
    pub about: String,
    content: LazyLock<String, Box<dyn FnOnce() -> String + Send + 'a>>,
}

impl<'a> Snapshot<'a> {
    /// The snapshot `name`, which shows what `about` says, with the `content` that is made when it
    /// is first asked for.
    pub fn new(
        name: &str,
        kind: Kind,
        about: &str,
        content: impl FnOnce() -> String + Send + 'a,
    ) -> Self {
        let (name, about) = (name.to_string(), about.to_string());
        Self { name, kind, about, content: LazyLock::new(Box::new(content)) }
    }

    /// The content between its anchors: a table as data, a figure as HTML, or a difference in a
    /// fence.
    pub fn content(&self) -> &str {
        &self.content
    }

    /// The text of the file below insta's header: the content between anchors, so that a chapter
    /// can include it.
    pub fn text(&self) -> String {
        let (anchor, content) = (self.kind.anchor(), self.content());
        format!("<!-- ANCHOR: {anchor} -->\n{content}<!-- ANCHOR_END: {anchor} -->\n")
    }
}

fn table<'a>(name: &str, about: &str, table: impl FnOnce() -> Table + Send + 'a) -> Snapshot<'a> {
    Snapshot::new(name, Kind::Table, about, move || table().to_data())
}

/// All that are computed, in the order in which they are best reviewed.
pub fn snapshots<'a>(study: &'a Study, ledger: &'a Ledger) -> Vec<Snapshot<'a>> {
    snapshots_with(study, ledger, |drawing| drawing.html(study))
}

/// The same, with the HTML of each figure by a function: for who has drawn them for something else
/// too.
pub fn snapshots_with<'a>(
    study: &'a Study,
    ledger: &'a Ledger,
    html: impl Fn(&Drawing) -> String + Copy + Send + 'a,
) -> Vec<Snapshot<'a>> {
    let of_the_paper = tables::TABLES.map(|number| {
        let of = move || tables::table(ledger, number).expect("a table of the paper");
        let about = format!("The paper's Table {number}, stated and measured");
        table(&format!("table_{number}"), &about, of)
    });
    let mut snapshots = Vec::from(of_the_paper);
    snapshots.extend([
        table("slopes", "Slopes of the energy error (Table 4)", || tables::energy_slopes(study)),
        table(
            "orders",
            "Slopes of the error of the state, of every method on its ladder of steps",
            || tables::state_slopes(study),
        ),
        table("methods", "Every method, as measured", || tables::methods(study)),
        table("predictions", "What theory predicts for 49 cells, beside what is measured", || {
            tables::predictions(ledger)
        }),
        table("ledger_cells", "The ledger of the paper's cells, judged", || tables::cells(ledger)),
        table("ledger_sentences", "The ledger of the paper's sentences, judged", || {
            tables::sentences(ledger)
        }),
        table(
            "beyond",
            "Systems beyond the pendulum: what is known and what is found",
            tables::beyond,
        ),
        table(
            "crossings",
            "From how many evaluations on RK4 is ahead of Störmer–Verlet, by amplitude",
            tables::crossings,
        ),
        table(
            "diffusion",
            "What becomes of Störmer–Verlet's orbits at large steps",
            tables::diffusion,
        ),
        table(
            "enclosure",
            "Proved bounds on a trajectory, whatever the roundings",
            tables::enclosure,
        ),
    ]);
    let about = "What is right in the questions of the book";
    snapshots.push(table("questions", about, tables::questions));
    let about = "Wrong methods, and the properties that catch them";
    snapshots.push(table("zoo", about, tables::zoo));
    snapshots.extend(figures().map(|drawing| {
        Snapshot::new(drawing.name, Kind::Figure, drawing.title(), move || html(drawing))
    }));
    let about = "An example of a difference, for the appendix on changing a method";
    snapshots.push(Snapshot::new("a_change", Kind::Example, about, || a_change(study)));
    snapshots
}

/// Those whose names are `wanted`, each made in a thread of its own. A panic is that of one
/// snapshot: a method may have been changed into one with which an experiment has no result.
pub fn some<'a>(
    study: &'a Study,
    ledger: &'a Ledger,
    wanted: impl Fn(&str) -> bool,
) -> Vec<(String, thread::Result<Snapshot<'a>>)> {
    let mut all = snapshots(study, ledger);
    all.retain(|snapshot| wanted(&snapshot.name));
    thread::scope(|scope| {
        let make = |snapshot: Snapshot<'a>| {
            let name = snapshot.name.clone();
            let made = scope.spawn(move || {
                snapshot.content();
                snapshot
            });
            (name, made)
        };
        let threads: Vec<_> = all.into_iter().map(make).collect();
        threads.into_iter().map(|(name, made)| (name, made.join())).collect()
    })
}

/// What a change looks like to its reviewer: Table 4 before and after Störmer–Verlet drifts first
/// and kicks in the middle, which is as good a method, of the same order.
fn a_change(study: &Study) -> String {
    let mut changed = study.clone();
    for row in &mut changed.convergence {
        if PaperMethod::of(row.method) == Some(PaperMethod::StormerVerlet) {
            row.drift = STEPS.map(|step| convergence::drift(&InSteps(PositionVerlet), step));
        }
    }
    // Every other step, and no ids, so that the example fits on a page.
    let narrow = |line: &str| {
        let cells: Vec<&str> = line.split('|').collect();
        [0, 2, 3, 4, 6, 8, 9].map(|column| cells[column]).join("|") + "\n"
    };
    let table = |study| -> String {
        let table = tables::table(&Ledger::of_the_tables(study), 4).expect("a table of the paper");
        table.to_data().lines().filter(|line| !line.starts_with("| * ")).map(narrow).collect()
    };
    let (before, after) = (table(study), table(&changed));
    let rows =
        before.lines().zip(after.lines()).flat_map(|(before, after)| match before == after {
            true => vec![format!(" {before}\n")],
            false => vec![format!("-{before}\n"), format!("+{after}\n")],
        });
    format!("```diff\n{}```\n", rows.collect::<String>())
}
