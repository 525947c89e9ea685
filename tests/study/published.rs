//! Solvers of other people, judged from their recorded answers by what they claim: the table of all
//! of them, a report for each library, and figures of some.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::path::PathBuf;
use std::sync::LazyLock;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::{fs, thread};

use pendula::{Motion, Pendulum, Phase};
use pendula_judge::zoo::recorded::Recorded;
use pendula_judge::{Claims, Finding, Report, Verdict, judge_solver};
use pendula_study::charts::{Axis, Chart, Figure, Style};
use pendula_study::report::figures::captioned;
use pendula_study::report::snapshots::{Kind, Snapshot};
use pendula_study::report::table::Table;
use serde::Deserialize;

use crate::at_root;

/// `book/strangers/solvers.toml`, whose head says what each field is.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Strangers {
    /// What no library promises, whichever fails.
    #[serde(default)]
    aside: Vec<Aside>,
    library: Vec<Library>,
}

#[derive(Deserialize)]
struct Library {
    name: String,
    id: String,
    language: String,
    version: String,
    docs: String,
    install: String,
    called: String,
    /// Reports on what no property shows.
    #[serde(default)]
    also: Vec<String>,
    solver: Vec<Entry>,
}

#[derive(Deserialize)]
struct Entry {
    name: String,
    claims: String,
    quote: String,
    place: String,
    recording: String,
    unjudged: Option<String>,
    note: Option<String>,
    #[serde(default)]
    documented: Vec<Documented>,
    #[serde(default)]
    defect: Vec<Defect>,
    #[serde(default)]
    aside: Vec<Aside>,
}

/// A property that fails as the documentation says it does.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Documented {
    property: String,
    quote: String,
    place: String,
}

/// Properties that fail by a defect, which has a report of its own.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Defect {
    id: String,
    properties: Vec<String>,
}

/// A property that fails, and why that is nobody's fault.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Aside {
    property: String,
    why: String,
}

static STRANGERS: LazyLock<Strangers> = LazyLock::new(|| {
    let text = fs::read_to_string(at_root("book/strangers/solvers.toml")).expect("the solvers");
    toml::from_str(&text).unwrap_or_else(|error| panic!("{error}"))
});

/// A solver, judged.
struct Judged {
    library: &'static Library,
    entry: &'static Entry,
    report: Report,
}

static JUDGED: LazyLock<Vec<Judged>> = LazyLock::new(|| {
    let all: Vec<(&Library, &Entry)> = STRANGERS
        .library
        .iter()
        .flat_map(|library| library.solver.iter().map(move |entry| (library, entry)))
        .collect();
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some((library, entry)) = all.get(index) else { return done };
            done.push((index, Judged::of(library, entry)));
        }
    };
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let judged: BTreeMap<usize, Judged> = thread::scope(|scope| {
        let threads: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        threads.into_iter().flat_map(|thread| thread.join().expect("a judgement")).collect()
    });
    judged.into_values().collect()
});

/// Whether what is said of one property explains another: many outputs are as wrong as a thousand.
fn covers(said: &str, property: &str) -> bool {
    said == property || (said, property) == ("output", "many")
}

impl Judged {
    fn of(library: &'static Library, entry: &'static Entry) -> Self {
        if entry.unjudged.is_some() {
            return Self { library, entry, report: Report::default() };
        }
        let path = format!("tests/verify/solvers/{}.txt", entry.recording);
        let answers =
            fs::read_to_string(at_root(&path)).unwrap_or_else(|error| panic!("{path}: {error}"));
        let claims: Claims = entry.claims.parse().unwrap_or_else(|error| panic!("{path}: {error}"));
        Self { library, entry, report: judge_solver(&Recorded::read(&answers), claims) }
    }

    /// The anchor of its report: letters and digits, with hyphens between.
    fn anchor(&self) -> String {
        let words = self.entry.recording.split(|c: char| !c.is_ascii_alphanumeric());
        let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
        format!("of-{}", words.join("-").to_lowercase())
    }

    /// The defect that explains why this property fails.
    fn defect(&self, property: &str) -> Option<&'static Defect> {
        self.entry.defect.iter().find(|it| it.properties.iter().any(|name| covers(name, property)))
    }

    fn documented(&self, property: &str) -> Option<&'static Documented> {
        self.entry.documented.iter().find(|it| covers(&it.property, property))
    }

    /// The properties that something is said to be wrong with.
    fn explained(&self) -> BTreeSet<&'static str> {
        let defects = self.entry.defect.iter().flat_map(|it| &it.properties);
        let documented = self.entry.documented.iter().map(|it| &it.property);
        let aside = self.entry.aside.iter().map(|it| &it.property);
        defects.chain(documented).chain(aside).map(String::as_str).collect()
    }

    /// The claimed properties with this verdict, but for what no library promises.
    fn with(&self, verdict: Verdict) -> impl Iterator<Item = &'static str> {
        let claimed = self.report.findings.iter().filter(|it| it.claimed.is_some());
        let those = claimed.filter(move |it| it.verdict == verdict).map(|it| it.name);
        those.filter(|name| STRANGERS.aside.iter().all(|it| it.property != *name))
    }

    /// The verdict in a word or two.
    fn verdict(&self) -> &'static str {
        let any = |verdict| self.with(verdict).next().is_some();
        if self.entry.unjudged.is_some() {
            "not judged"
        } else if self.with(Verdict::Fails).any(|it| self.defect(it).is_some()) {
            "fails"
        } else if self.with(Verdict::Fails).any(|it| self.documented(it).is_some()) {
            "documented"
        } else if any(Verdict::Fails) {
            "set aside"
        } else if any(Verdict::NotMeasured) || any(Verdict::Unclear) {
            "unclear"
        } else if any(Verdict::Holds) {
            "holds"
        } else {
            "unclaimed"
        }
    }

    /// What the verdict is about, with links to the defects.
    fn why(&self) -> String {
        let mut said: Vec<String> = self.entry.unjudged.iter().map(|why| plain(why)).collect();
        for defect in &self.entry.defect {
            said.push(format!("[{}](others.md#{})", defect.properties.join(", "), defect.id));
        }
        let unexplained = self.with(Verdict::Fails).filter(|name| self.defect(name).is_none());
        said.extend(unexplained.map(str::to_string));
        if said.is_empty() {
            let unknown = [Verdict::NotMeasured, Verdict::Unclear];
            let names = unknown.into_iter().flat_map(|verdict| self.with(verdict));
            said.extend(names.map(str::to_string));
        }
        said.join(", ")
    }

    /// The number of this property, and which of several.
    fn value(&self, property: &str, which: usize) -> String {
        let finding = self.report.finding(property);
        number(finding.and_then(|it| it.values.get(which)).copied())
    }

    /// The power that was found, and the one that is claimed, if one is.
    fn beside_claim(&self, property: &str) -> String {
        let claimed = self.report.finding(property).and_then(|it| it.claimed.as_deref());
        let found = self.value(property, 0);
        match claimed.filter(|it| it.chars().all(|c| c.is_ascii_digit())) {
            Some(claimed) => format!("{found} / {claimed}"),
            None => found,
        }
    }

    /// Tolerance, error at the end and evaluations, where the tolerance is 10⁻⁷.
    fn usual(&self) -> Option<(f64, f64, Option<u64>)> {
        let mut ladder = self.report.evidence.tolerances.iter().copied();
        ladder.find(|(tolerance, ..)| (tolerance / 1e-7 - 1.0).abs() < 0.1)
    }

    /// The error at the end over a tolerance of 10⁻⁷.
    fn over_tolerance(&self) -> Option<f64> {
        self.usual().map(|(tolerance, error, _)| error / tolerance)
    }

    fn crossings(&self) -> &'static str {
        match self.report.finding("crossings").map(|it| it.verdict) {
            Some(Verdict::Holds) => "found",
            Some(Verdict::Fails) => "wrong",
            Some(Verdict::Unclear) => "unclear",
            _ => "–",
        }
    }
}

/// A number with two digits, without an exponent; a dash where there is none.
fn number(value: Option<f64>) -> String {
    let Some(value) = value.filter(|it| it.is_finite()) else { return "–".to_string() };
    if value < 10.0 {
        return format!("{value:.1}");
    }
    let unit = 10_f64.powf(value.log10().floor() - 1.0);
    format!("{:.0}", (value / unit).round() * unit)
}

// -------------------------------------------------------------------------------------------------
// What the book shows
// -------------------------------------------------------------------------------------------------

/// A table with a row for each solver.
fn table() -> String {
    let mut table = Table::new([
        "library",
        "solver",
        "verdict",
        "error",
        "order",
        "estimate",
        "outputs",
        "crossings",
        "× 5(4)",
        "× 853",
        "language",
        "of what",
    ])
    .with_remarks(1);
    for it in JUDGED.iter() {
        let Library { name, id, language, version, .. } = it.library;
        table.push([
            format!("[{name}](solver-reports.md#{id}) {version}"),
            format!("[`{}`](solver-reports.md#{})", it.entry.name, it.anchor()),
            it.verdict().to_string(),
            number(it.over_tolerance()),
            it.beside_claim("order"),
            it.beside_claim("estimate"),
            it.value("output", 0),
            it.crossings().to_string(),
            it.value("effort", 0),
            it.value("effort", 1),
            language.clone(),
            it.why(),
        ]);
    }
    table.to_markdown()
}

/// A text for Markdown, as it stands.
fn plain(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        if "\\`*_{}[]<>#|$~&".contains(c) {
            out.push('\\');
        }
        out.push(if c == '\n' { ' ' } else { c });
    }
    out
}

/// The bound of a finding, where one number decides.
fn bound(finding: &Finding) -> String {
    let Some(bound) = finding.bound.filter(|it| *it != 0.0) else { return "–".to_string() };
    let text =
        if (0.1..1e4).contains(&bound) { format!("{bound:.1}") } else { format!("{bound:.1e}") };
    format!("{text} {}", finding.unit).trim_end().to_string()
}

/// Library by library, solver by solver, what was measured.
fn reports() -> String {
    let mut page = String::new();
    for library in &STRANGERS.library {
        let Library { name, id, language, version, docs, install, called, also, .. } = library;
        let _ = write!(
            page,
            "## {name} {version} {{ #{id} }}\n\n{language} · {} · [documentation]({docs})\n\n\
             *How it was called:* {}\n\n",
            plain(install),
            plain(called.trim())
        );
        for report in also {
            let _ = write!(page, "Besides: [`{report}`](others.md#{report}).\n\n");
        }
        for it in JUDGED.iter().filter(|it| it.library.id == *id) {
            page += &of_a_solver(it);
        }
    }
    page
}

fn of_a_solver(it: &Judged) -> String {
    let Judged { entry, report, .. } = it;
    let names = it.with(Verdict::Fails).collect::<Vec<_>>().join(", ");
    let told = match it.verdict() {
        "holds" => "every claim holds".to_string(),
        "unclaimed" => "nothing is claimed".to_string(),
        verdict if names.is_empty() => format!("{verdict}: {}", it.why()),
        verdict => format!("{verdict}: {names}"),
    };
    let mut page = format!(
        "<details>\n<summary><code>{}</code> {told}</summary>\n\n<a id=\"{}\"></a>\n\n\
         {} ({})\n\n",
        escape(&entry.name),
        it.anchor(),
        match entry.quote.trim() {
            "" => "*Nothing is promised that could be judged.*".to_string(),
            quote => format!("> “{}”", plain(quote)),
        },
        plain(&entry.place)
    );
    if let Some(note) = &entry.note {
        let _ = write!(page, "{}\n\n", plain(note));
    }
    for it in &entry.documented {
        let (quote, place) = (plain(it.quote.trim()), plain(&it.place));
        let _ = write!(page, "> Of *{}*: “{quote}” — {place}\n\n", it.property);
    }
    for it in &entry.defect {
        let names = it.properties.join(", ");
        let _ = write!(page, "*{names}* fails by [this defect](others.md#{}).\n\n", it.id);
    }
    for it in &entry.aside {
        let _ = write!(page, "*{}* was set aside: {}\n\n", it.property, plain(&it.why));
    }
    for Aside { property, why } in &STRANGERS.aside {
        if report.failures().any(|name| name == property) {
            let _ = write!(page, "*{property}* does not count: {}\n\n", plain(why));
        }
    }
    for line in &report.look_at {
        let _ = writeln!(page, "* {}", plain(line));
    }
    page.push('\n');
    if report.findings.is_empty() {
        return page + "</details>\n\n";
    }
    let mut table = Table::new(["property", "claimed", "verdict", "bound", "measured"]);
    for finding in &report.findings {
        let measured = match finding.verdict {
            Verdict::NotMeasured => &finding.why,
            _ => &finding.measured,
        };
        table.push([
            finding.name.to_string(),
            finding.claimed.clone().unwrap_or_else(|| "–".to_string()),
            finding.verdict.name().to_string(),
            bound(finding),
            plain(measured),
        ]);
    }
    page + &table.with_remarks(5).to_markdown() + "\n</details>\n\n"
}

/// The reports on defects, each folded under its title; those of solvers and of fixed steps.
fn defects() -> String {
    let mut page = String::new();
    for (id, text) in reports_on_defects() {
        let (title, rest) = text.split_once("\n\n").expect("a title");
        let title = escape(title.trim_start_matches("# "));
        let library = text.split_once("*Library:* ").expect("a library").1;
        let library = escape(library.split_once(". *Version:*").expect("a version").0);
        let lines = rest.lines().filter(|line| !line.starts_with("<!-- ANCHOR"));
        let lines = lines.map(|line| match (line, line.strip_prefix("## ")) {
            (_, Some(heading)) => format!("**{heading}**\n"),
            // What the book's highlighter does not know.
            ("```java" | "```octave" | "```r", _) => "```text\n".to_string(),
            _ => format!("{line}\n"),
        });
        // Where a link to it leads, a browser unfolds it.
        let _ = write!(
            page,
            "<details>\n<summary>{library}: {title}</summary>\n\n<a id=\"{id}\"></a>\n{}\n\
             </details>\n\n",
            lines.collect::<String>()
        );
    }
    page
}

/// The reports on defects, by their names.
fn reports_on_defects() -> BTreeMap<String, String> {
    let folder = fs::read_dir(at_root("book/strangers/reports")).expect("a folder");
    let paths = folder.map(|entry| entry.expect("a file").path());
    let read = |path: PathBuf| {
        let name = path.file_stem().and_then(|stem| stem.to_str()).expect("a name").to_string();
        (name, fs::read_to_string(path).expect("a report"))
    };
    paths.map(read).collect()
}

/// A text for HTML, as it stands.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

// -------------------------------------------------------------------------------------------------
// Figures
// -------------------------------------------------------------------------------------------------

/// The judgement of this recording.
fn of(recording: &str) -> &'static Judged {
    let found = JUDGED.iter().find(|it| it.entry.recording == recording);
    found.unwrap_or_else(|| panic!("{recording} is not recorded"))
}

/// Error at the end against evaluations, of solvers that this chart names.
fn by_work(series: &[(&str, &str)], y: (f64, f64), x: (f64, f64)) -> Chart {
    let chart = Chart::new(
        Axis::log("evaluations for three runs of 10 s").range(x.0, x.1),
        Axis::log("largest error at the end (rad)").range(y.0, y.1),
    );
    series.iter().enumerate().fold(chart.height(320.0), |chart, (k, (label, recording))| {
        let ladder = of(recording).report.evidence.tolerances.iter();
        let points = ladder.filter_map(|&(_, error, count)| Some((count? as f64, error)));
        chart.series(*label, Style::series([1, 2, 4, 3][k]).solid(), points)
    })
}

/// Twentieths of a run: a record has the largest and the smallest error of each, and not when.
const TWENTIETHS: usize = 20;

/// The largest and the smallest error in each twentieth of a run.
fn along(series: &[(&str, &str)], y: (f64, f64)) -> Chart {
    let chart = Chart::new(
        Axis::linear("t (s)").range(0.0, 10.0),
        Axis::log("error (rad)").range(y.0, y.1),
    );
    series.iter().enumerate().fold(chart.height(300.0), |chart, (k, (label, recording))| {
        let outputs = &of(recording).report.evidence.outputs;
        let parts = outputs.chunks(outputs.len().div_ceil(TWENTIETHS));
        let (mut largest, mut smallest) = (Vec::new(), Vec::new());
        for part in parts {
            let middle = 0.5 * (part[0].0 + part[part.len() - 1].0);
            let errors = part.iter().map(|&(_, error)| error);
            largest.push((middle, errors.clone().fold(0.0, f64::max)));
            smallest.push((middle, errors.fold(f64::INFINITY, f64::min)));
        }
        let style = Style::series([4, 2][k]);
        chart.series(format!("{label}, largest"), style.solid(), largest).series(
            format!("{label}, smallest"),
            style.dashed(),
            smallest,
        )
    })
}

/// Error at the end against the tolerance.
fn by_tolerance(series: &[(&str, &str)], y: (f64, f64), x: (f64, f64)) -> Chart {
    let chart = Chart::new(
        Axis::log("tolerance").range(x.0, x.1),
        Axis::log("largest error at the end (rad)").range(y.0, y.1),
    )
    .series("the tolerance itself", Style::REFERENCE.dashed(), [(x.0, x.0), (x.1, x.1)]);
    series.iter().enumerate().fold(chart.height(320.0), |chart, (k, (label, recording))| {
        let ladder = of(recording).report.evidence.tolerances.iter();
        let points = ladder.map(|&(tolerance, error, _)| (tolerance, error));
        chart.series(*label, Style::series([1, 2, 4, 3][k]).solid(), points)
    })
}

/// Of each solver an error (rad) that should be like its usual one at the same tolerance.
fn beside_usual(property: &str, what: &str) -> Chart {
    let points = JUDGED.iter().filter_map(|it| {
        let (_, usual, _) = it.usual()?;
        let error = *it.report.finding(property)?.values.first()?;
        (usual > 0.0 && error > 0.0).then_some((usual, error.min(100.0)))
    });
    let line = [1e-10, 1.0].map(|x| (x, x));
    Chart::new(
        Axis::log("error of runs forward (rad), at a tolerance of 10⁻⁷").range(1e-10, 1.0),
        Axis::log(what).range(1e-10, 100.0),
    )
    .height(320.0)
    .series("the same", Style::REFERENCE.dashed(), line)
    .series("solvers", Style::series(1).markers_only(), points)
}

/// What the output of a report says, line by line: the numbers of each line that begins so.
fn output_of(report: &str, begins: &str) -> Vec<Vec<f64>> {
    let reports = reports_on_defects();
    let text = reports.get(report).unwrap_or_else(|| panic!("no report {report}"));
    let output = text.split_once("<!-- ANCHOR: output -->").expect("an output").1;
    let output = output.split_once("<!-- ANCHOR_END: output -->").expect("its end").0;
    let lines = output.lines().filter(|line| line.starts_with(begins));
    let numbers = |line: &str| {
        let words = line.split(|c: char| !(c.is_ascii_digit() || ".e-".contains(c)));
        words.filter_map(|word| word.parse().ok()).collect::<Vec<f64>>()
    };
    let found: Vec<Vec<f64>> = lines.map(numbers).collect();
    assert!(found.len() > 2, "{report} prints no lines that begin with {begins}");
    found
}

/// What becomes of a call that is made again and again: evaluations, and errors.
fn again_and_again(figure: Figure) -> Figure {
    let motion = exact(Phase::at_rest(2.0), 1.0);
    let rows = output_of("extensisq-mu5nmb-weights-shrink", "call");
    let call = || Axis::linear("call");
    let work = rows.iter().map(|row| (row[0], row[1]));
    // The third number is that of y(10).
    let errors = rows.iter().map(|row| (row[0], (row[3] - motion.at(10.0).theta).abs()));
    let style = Style::series(1).solid();
    figure
        .panel(Chart::new(call(), Axis::log("evaluations")).height(150.0).series("", style, work))
        .panel(Chart::new(call(), Axis::log("error (rad)")).height(150.0).series("", style, errors))
}

fn exact(start: Phase, g_over_l: f64) -> Motion {
    let pendulum = Pendulum::new(g_over_l, 1.0, 1.0).expect("a pendulum");
    Motion::new(&pendulum, start).expect("a finite start")
}

/// A figure: its name, title, caption and description, and what draws it.
struct Drawing {
    name: &'static str,
    title: &'static str,
    caption: &'static str,
    description: &'static str,
    draw: fn(Figure) -> Figure,
}

impl Drawing {
    fn html(&self) -> String {
        let figure = (self.draw)(Figure::new(self.title, self.description));
        captioned(&figure.to_svg(self.name), self.caption)
    }
}

const DRAWINGS: [Drawing; 5] = [
    Drawing {
        name: "solver_ends",
        title: "One method of order 8, with its end interpolated and not",
        caption: "Error against work, from loose to tight tolerances. As the steps become short, \
                  torchdiffeq's line is that of the quartic.",
        description: "Three lines on doubly logarithmic axes: the largest error at the end \
                      against the evaluations. Those of diffrax's Dopri8 and SciPy's DOP853 fall \
                      steeply, and together, to 10⁻¹¹ radians. That of torchdiffeq's dopri8 \
                      leaves them at about 10⁻⁵, falls half as steeply, and ends at 3 · 10⁻⁹ \
                      with as many evaluations.",
        draw: |figure| {
            figure.panel(by_work(
                &[
                    ("torchdiffeq dopri8", "torchdiffeq-dopri8"),
                    ("diffrax Dopri8", "diffrax-Dopri8"),
                    ("SciPy DOP853", "SciPy-DOP853"),
                ],
                (1e-13, 1.0),
                (5e2, 3e4),
            ))
        },
    },
    Drawing {
        name: "solver_outputs",
        title: "Two factors exchanged, between the steps",
        caption: "The largest and the smallest error in each twentieth of a run with a tolerance \
                  of 10⁻⁷, of two programs for DOP853.",
        description: "Four lines on a logarithmic axis, errors against time. The largest errors \
                      of differential-equations stand a hundred times above those of SciPy; its \
                      smallest are below SciPy's largest.",
        draw: |figure| {
            figure.panel(along(
                &[
                    ("differential-equations", "differential-equations-dop853"),
                    ("SciPy", "SciPy-DOP853"),
                ],
                (1e-10, 1e-2),
            ))
        },
    },
    Drawing {
        name: "solver_again",
        title: "The same call, again and again",
        caption: "Evaluations, and the error at the end, of one and the same call.",
        description: "Two charts, one below the other. Above, the evaluations fall from 1292 at \
                      the first call to 77 at the sixtieth. Below, the error rises meanwhile by \
                      seven orders of magnitude.",
        draw: again_and_again,
    },
    Drawing {
        name: "solver_back",
        title: "Forwards and backwards",
        caption: "Each point is a solver: the largest error of runs forward and of runs back, \
                  with the same tolerance. On the dashed line both are the same. Errors of more \
                  than 100 rad stand at the upper edge.",
        description: "A chart with a point for each solver, on doubly logarithmic axes. Nearly \
                      all lie near the dashed diagonal; a few stand at the upper edge.",
        draw: |figure| figure.panel(beside_usual("back", "of runs back (rad)")),
    },
    Drawing {
        name: "solver_clock",
        title: "A clock that runs ahead",
        caption: "Error against tolerance, beside SciPy's. On the dashed line an error is the \
                  tolerance.",
        description: "Two lines and a dashed diagonal on doubly logarithmic axes. SciPy's RK45 \
                      runs parallel to the diagonal, a hundred times above it. peroxide's RKF45 \
                      falls from ten radians to a few thousandths, while the tolerance falls by \
                      ten powers of ten.",
        draw: |figure| {
            figure.panel(by_tolerance(
                &[("peroxide RKF45", "peroxide-RKF45"), ("SciPy RK45", "SciPy-RK45")],
                (1e-13, 100.0),
                (1e-13, 1e-3),
            ))
        },
    },
];

/// The snapshots that are made here.
pub fn snapshots() -> Vec<Snapshot<'static>> {
    let of =
        |name, about, content: fn() -> String| Snapshot::new(name, Kind::Judged, about, content);
    let mut all = vec![
        of("solvers", "Solvers of other people, judged from their recorded answers", table),
        of("solver_reports", "What was measured of each solver", reports),
        of("defects", "Reports on defects in published integrators and solvers", defects),
    ];
    all.extend(DRAWINGS.iter().map(|drawing| {
        Snapshot::new(drawing.name, Kind::Judged, drawing.title, || drawing.html())
    }));
    all
}

// -------------------------------------------------------------------------------------------------
// Nothing is wrong in silence
// -------------------------------------------------------------------------------------------------

/// Catches: a claim that fails and of which nobody has said why; a defect or a sentence that is
/// said to explain a failure that there is not.
#[test]
fn each_failure_is_explained() {
    let mut wrong = Vec::new();
    for it in JUDGED.iter() {
        let failing: BTreeSet<&str> = it.with(Verdict::Fails).collect();
        let explained = it.explained();
        let explains = |name: &&&str| explained.iter().any(|said| covers(said, name));
        // A sentence stands whether it is needed or not.
        let needless = |name: &&str| it.documented(name).is_none() && !failing.contains(*name);
        if !failing.iter().all(|name| explains(&name)) || explained.iter().any(needless) {
            let name = &it.entry.recording;
            let report = &it.report;
            wrong.push(format!(
                "{name}: {failing:?} fail, and {explained:?} are explained\n{report}"
            ));
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

/// Catches: a recording of which nothing is said, one that two solvers share.
#[test]
fn each_recording_is_that_of_a_solver() {
    let folder = fs::read_dir(at_root("tests/verify/solvers")).expect("a folder");
    let name = |path: PathBuf| Some(path.file_stem()?.to_str()?.to_string());
    let mut recorded: Vec<_> =
        folder.filter_map(|entry| name(entry.expect("a file").path())).collect();
    let judged = JUDGED.iter().filter(|it| it.entry.unjudged.is_none());
    let mut listed: Vec<_> = judged.map(|it| it.entry.recording.clone()).collect();
    recorded.sort();
    listed.sort();
    assert_eq!(recorded, listed);
}

/// Catches: a README or a chapter that counts solvers or libraries as they were once.
#[test]
fn solvers_are_counted_as_they_are() {
    let judged = || JUDGED.iter().filter(|it| it.entry.unjudged.is_none());
    let libraries = judged().map(|it| &it.library.id).collect::<BTreeSet<_>>().len();
    let solvers = judged().count();
    let languages = judged().map(|it| &it.library.language).collect::<BTreeSet<_>>().len();
    let with = |verdict| JUDGED.iter().filter(|it| it.verdict() == verdict).count();
    let (holding, failing) = (with("holds"), with("fails"));
    for (path, said) in [
        ("README.md", format!("and {solvers} solvers from {libraries}.")),
        (
            "book/src/others.md",
            format!("{solvers} solvers of {libraries} libraries, in {languages} languages"),
        ),
        ("book/src/others.md", format!("{holding} keep every claim, and {failing} fail one")),
    ] {
        let text = fs::read_to_string(at_root(path)).expect("a text");
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(text.contains(&said), "{path} does not say {said:?}");
    }
}
