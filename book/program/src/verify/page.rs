//! The report of the judge as one page to keep.

use pendula::Phase;
use pendula_charts::{Axis, Chart, Figure, Style};
use pendula_judge::formats::Judged;
use pendula_judge::printable::escaped;
use pendula_judge::{Claims, Finding, Property, Report, Verdict, scientific};

use crate::output::page::{Page, with_code};

/// The page, made on this `date`.
pub fn html(judged: &Judged<'_>, date: &str) -> String {
    let Judged { command, name, report, .. } = *judged;
    let tested = match (command, name) {
        ("", "") => "Tested".to_string(),
        (one, "") | ("", one) => format!("Tested: {one}"),
        (command, name) => format!("Tested: {command} ({name})"),
    };
    let version = env!("CARGO_PKG_VERSION");
    let lead =
        format!("Claimed: {}. {tested}, on {date}, with pendula {version}.", judged.claimed());
    let page = Page {
        title: &title(report, name),
        lead: &lead,
        body: &[verdict(report), properties(report), drawings(report, judged.claims)].concat(),
        style: include_str!("page.css"),
    };
    page.html()
}

/// The beginning of the page for a chapter of the book: its title, what to look at, and the first
/// `rows` of its properties; without a blank line, as HTML within Markdown has to be.
#[cfg(feature = "book")]
pub fn excerpt(report: &Report, rows: usize) -> String {
    let look_at: String = report
        .look_at()
        .iter()
        .map(|line| format!("<li>What to look at: {}</li>\n", set(line)))
        .collect();
    let shown: String = sorted(report).into_iter().take(rows).map(row).collect();
    format!(
        r#"<section class="judged" aria-label="A report">
<p class="name">{}</p>
<ul>
{look_at}<li>What it is: {}.</li>
</ul>
<table class="properties">
{HEAD}
<tbody>
{shown}</tbody></table>
</section>"#,
        escaped(&title(report, "")),
        set(&report.what_it_is())
    )
}

/// The verdict, with the name of what was tested where it has one.
fn title(report: &Report, name: &str) -> String {
    let failing: Vec<&str> = report.failures().map(Property::name).collect();
    let verdict = match (report.verdict, &failing[..]) {
        (Verdict::Holds, _) => "Every claim holds".to_string(),
        (Verdict::Fails, [one]) => format!("A claim fails: {one}"),
        (Verdict::Fails, _) => format!("Claims fail: {}", failing.join(", ")),
        (Verdict::Unclaimed, _) => "Nothing is claimed".to_string(),
        _ => "Not every claim could be decided".to_string(),
    };
    if name.is_empty() { verdict } else { format!("{verdict} · {name}") }
}

fn verdict(report: &Report) -> String {
    let weight = match report.verdict {
        Verdict::Holds | Verdict::Unclaimed => "moved",
        _ => "alarm",
    };
    let look_at: String = report
        .look_at()
        .iter()
        .map(|line| format!("<li>What to look at: {}</li>\n", set(line)))
        .collect();
    format!(
        r#"<section id="verdict" aria-labelledby="verdict-title">
<h2 id="verdict-title">The verdict</h2>
<ul class="sentences">
<li class="{weight}">{}</li>
{look_at}<li>What it is: {}.</li>
</ul>
</section>
"#,
        escaped(&report.summary()),
        set(&report.what_it_is())
    )
}

/// Text as HTML, with what is between backticks as code and powers raised: tol^(−1/q), tol^0.8. No
/// line ends within a number.
fn set(text: &str) -> String {
    let text = text.replace(" × 10", "\u{a0}×\u{a0}10").replace(" ± ", "\u{a0}±\u{a0}");
    let mut parts = text.split('^');
    let mut html = with_code(parts.next().unwrap_or_default());
    for part in parts {
        let bracketed = part.strip_prefix('(').and_then(|rest| rest.split_once(')'));
        let (power, rest) = bracketed.unwrap_or_else(|| {
            let is_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '−');
            let end = part.find(|c| !is_number(c)).unwrap_or(part.len());
            part.split_at(end)
        });
        html += &format!("<sup>{}</sup>{}", escaped(power), with_code(rest));
    }
    html
}

/// What stands above the properties.
const HEAD: &str = "\
    <thead><tr><th scope=\"col\">Property</th><th scope=\"col\">claimed</th>\
    <th scope=\"col\">verdict</th>\n<th scope=\"col\">measured, and how</th></tr></thead>";

/// All properties, with what fails first.
fn sorted(report: &Report) -> Vec<&Finding> {
    const ORDER: [Verdict; 3] = [Verdict::Fails, Verdict::Unclear, Verdict::NotMeasured];
    let place = |finding: &&Finding| {
        let claimed = finding.claimed.is_some();
        ORDER.iter().position(|verdict| claimed && *verdict == finding.verdict).unwrap_or(3)
    };
    let mut sorted: Vec<&Finding> = report.findings.iter().collect();
    sorted.sort_by_key(place);
    sorted
}

/// A table of them.
fn properties(report: &Report) -> String {
    let rows: String = sorted(report).into_iter().map(row).collect();
    format!(
        r#"
<section aria-labelledby="properties-title">
<h2 id="properties-title">Property by property</h2>
<div class="table-wrapper" tabindex="0" role="region" aria-label="Property by property">
<table class="properties">
{HEAD}
<tbody>
{rows}</tbody></table></div>
</section>
"#
    )
}

fn row(finding: &Finding) -> String {
    let class = if finding.verdict == Verdict::Fails { r#" class="alarm""# } else { "" };
    let [name, claimed, verdict] = [
        finding.property.name(),
        finding.claimed.as_deref().unwrap_or("–"),
        finding.verdict.name(),
    ]
    .map(escaped);
    let [measured, why] = [finding.measured(), finding.why()].map(|text| set(&text));
    let why = if why.is_empty() { why } else { format!(r#"<p class="how">{why}</p>"#) };
    format!(
        r#"<tr{class}><th scope="row">{name}</th><td data-head="claimed">{claimed}</td>
<td data-head="verdict">{verdict}</td><td>{measured}{why}</td></tr>
"#
    )
}

fn drawings(report: &Report, claims: &Claims) -> String {
    let drawn = figures(report, claims).concat();
    if drawn.is_empty() {
        return drawn;
    }
    format!(
        r#"
<section aria-labelledby="figures-title">
<h2 id="figures-title">What decides</h2>
{drawn}</section>
"#
    )
}

/// The figures there is evidence for: what the judge has measured, drawn as the book draws.
fn figures(report: &Report, claims: &Claims) -> Vec<String> {
    let evidence = &report.evidence;
    let figures = [
        force(&evidence.force),
        ladder(&evidence.ladder, claims.order),
        energy(&evidence.energy),
        evidence.square.as_ref().and_then(square),
        evidence.way.as_ref().and_then(|(out, back)| way(out, back)),
        tolerances(&evidence.tolerances),
        evaluations(&evidence.tolerances, Power::of(report, claims)),
        outputs(&evidence.outputs, evidence.beside_steps),
    ];
    figures.into_iter().flatten().collect()
}

/// The figure with its chart, and its caption below it.
fn drawn(id: &str, title: &str, caption: &str, chart: Chart) -> String {
    framed(id, Figure::new(title, caption).panel(chart), caption)
}

/// A figure with its caption.
fn framed(id: &str, figure: Figure, caption: &str) -> String {
    let svg = figure.to_svg(id);
    format!("<figure>\n{svg}<figcaption>{}</figcaption>\n</figure>\n", set(caption))
}

/// What was measured.
const MEASURED: Style = Style::series(0);
/// What it is compared with.
const OTHER: Style = Style::series(1);

/// The force that was found beside the sine, where it is another one.
fn force(force: &[(f64, f64)]) -> Option<String> {
    let (least, most) = (force.first()?.0, force.last()?.0);
    let sine = (0..=100).map(|k| {
        let theta = least + (most - least) * f64::from(k) / 100.0;
        (theta, -libm::sin(theta))
    });
    let chart = Chart::new(Axis::linear("θ (rad)"), Axis::linear("force/(g/L)"))
        .height(240.0)
        .series("−sin θ", Style::REFERENCE, sine)
        .series("found", MEASURED.markers_only(), force.iter().copied());
    let caption = "The change of ω in a short step, over its length, at fourteen states, in units \
                   of g/L; the line is the pendulum's force.";
    let finite = force.iter().all(|(_, force)| force.is_finite());
    finite.then(|| drawn("force", "The force that was found", caption, chart))
}

/// Error against step, with the slope that is claimed.
fn ladder(ladder: &[(f64, f64)], order: Option<u32>) -> Option<String> {
    let mut sorted = ladder.to_vec();
    sorted.sort_by(|a, b| b.0.total_cmp(&a.0));
    let (coarsest, finest) = (*sorted.first()?, *sorted.last()?);
    let mut chart = Chart::new(Axis::log("h (s)"), Axis::log("largest error (rad)")).series(
        "measured",
        MEASURED,
        ladder.iter().copied(),
    );
    let claimed = match order {
        Some(order) => {
            // From the coarsest step; a claim that is not kept leads away from the points.
            let label = format!("slope {order}, claimed");
            chart = chart.slope(f64::from(order), coarsest, finest.0, label);
            format!("; the dotted line falls with the power {order} that is claimed")
        }
        None => String::new(),
    };
    let caption = format!(
        "Largest error against the step, both axes logarithmic. {}{claimed}.",
        slopes(&sorted).map_or("One step alone".to_string(), |slopes| format!(
            "The slopes between the points are {slopes}"
        ))
    );
    Some(drawn("ladder", "Error against step", &caption, chart))
}

/// The slopes between neighbours.
fn slopes(points: &[(f64, f64)]) -> Option<String> {
    let slope = |pair: &[(f64, f64)]| {
        let [(h, error), (shorter, smaller)] = pair else { return String::new() };
        let slope = libm::log(smaller / error) / libm::log(shorter / h);
        if slope.is_finite() { format!("{slope:.2}").replace('-', "−") } else { "–".into() }
    };
    let slopes: Vec<String> = points.windows(2).map(slope).collect();
    (!slopes.is_empty()).then(|| slopes.join(", "))
}

/// Stretches of a run into which its energy error is put together.
const STRETCHES: usize = 240;
/// Samples of the end that are drawn one by one: a few swings, so that each can be told.
const END: usize = 160;

/// Energy error against time: the largest and the smallest of each stretch, and the end enlarged.
/// Each swing by itself would make a solid block of a long run.
fn energy(energy: &[(f64, f64)]) -> Option<String> {
    let axes = || Chart::new(Axis::linear("t (s)"), Axis::linear("ΔH/(m g L)"));
    // All of one length: of a short one the two lines would meet, as if the error had shrunk.
    let (all, count) = (energy.len(), STRETCHES.min(energy.len()));
    let stretches = (0..count).map(|k| &energy[k * all / count..(k + 1) * all / count]);
    let of = |fold: fn(f64, f64) -> f64, from: f64| {
        stretches.clone().map(move |stretch| {
            let middle = stretch[stretch.len() / 2].0;
            (middle, stretch.iter().map(|sample| sample.1).fold(from, fold))
        })
    };
    let style = MEASURED.line_only().solid();
    let whole = axes()
        .heading("largest and smallest, stretch by stretch")
        .height(240.0)
        .series("", style, of(f64::max, f64::NEG_INFINITY))
        .series("", style, of(f64::min, f64::INFINITY));
    let end = energy[energy.len().saturating_sub(END)..].iter().copied();
    let end = axes().heading("the end of the run").height(240.0).series("", style, end);
    let caption = "Energy error over a long run, in units of m g L: bounded if the two lines stay \
                   apart by as much, a drift if they leave.";
    let figure = Figure::new("Energy error against time", caption).panel(whole).panel(end);
    (!energy.is_empty()).then(|| framed("energy", figure, caption))
}

/// A square of states and its image after a step.
fn square((before, after): &([Phase; 4], [Phase; 4])) -> Option<String> {
    let ratio = area(after) / area(before);
    let closed = |corners: &[Phase; 4]| corners.map(|z| (z.theta, z.omega));
    let chart = plane()
        .series("before the step", Style::REFERENCE.filled(), closed(before))
        .series("after it", MEASURED.filled(), closed(after));
    let caption = format!(
        "A square of states, and where one step takes its corners. The area within them becomes \
         {ratio:.9} times as large; a symplectic step keeps that of the smallest squares."
    );
    let finite = before.iter().chain(after).all(|z| z.theta.is_finite() && z.omega.is_finite());
    finite.then(|| drawn("square", "A square and its image", &caption, chart))
}

/// The area of a quadrilateral, by its diagonals.
fn area(&[a, b, c, d]: &[Phase; 4]) -> f64 {
    let ((x, y), (u, v)) =
        ((c.theta - a.theta, c.omega - a.omega), (d.theta - b.theta, d.omega - b.omega));
    0.5 * (x * v - y * u).abs()
}

/// The way out and the way back.
fn way(out: &[Phase], back: &[Phase]) -> Option<String> {
    let points = |states: &[Phase]| -> Vec<(f64, f64)> {
        states.iter().map(|z| (z.theta, z.omega)).collect()
    };
    let (start, end) = (out.first()?, back.last()?);
    let chart = plane()
        .series("out", Style::REFERENCE, points(out))
        .series("back", OTHER.markers_only(), points(back))
        .series("end of the way back", MEASURED.markers_only(), [(end.theta, end.omega)]);
    let distance = [end.theta - start.theta, end.omega - start.omega];
    let [theta, omega] = distance.map(scientific);
    let caption = format!(
        "Steps of h from the start, then as many of −h. The way back ends {theta} rad and {omega} \
         rad/s from the start."
    );
    Some(drawn("way", "The way out and the way back", &caption, chart))
}

/// Tolerance, largest error (rad), and evaluations if they are counted.
type Tolerance = (f64, f64, Option<u64>);

/// Error against tolerance, of a solver.
fn tolerances(tolerances: &[Tolerance]) -> Option<String> {
    let errors = tolerances.iter().map(|&(tolerance, error, _)| (tolerance, error));
    let itself = tolerances.iter().map(|&(tolerance, ..)| (tolerance, tolerance));
    let chart = Chart::new(Axis::log("tolerance"), Axis::log("largest error (rad)"))
        .series("the tolerance itself", Style::REFERENCE, itself)
        .series("measured", MEASURED, errors);
    let caption = "Largest error at the end of three runs against the tolerance, both axes \
                   logarithmic. An error of a step is held to the tolerance; those of all steps \
                   add up, and grow with the motion.";
    (!tolerances.is_empty()).then(|| drawn("tolerance", "Error against tolerance", caption, chart))
}

/// The power of the step with which an estimate falls.
enum Power {
    Claimed(u32),
    Found(f64),
}

impl Power {
    /// That which is claimed or, if none is, found.
    fn of(report: &Report, claims: &Claims) -> Option<Self> {
        let found = || report.finding(Property::Estimate)?.values.first().copied();
        claims.estimate.map(Self::Claimed).or_else(|| found().map(Self::Found))
    }
}

/// Evaluations against tolerance, of a solver, with the slope of its estimate.
fn evaluations(tolerances: &[Tolerance], power: Option<Power>) -> Option<String> {
    let counted = tolerances.iter().filter_map(|&(tolerance, _, evaluations)| {
        evaluations.filter(|counted| *counted > 0).map(|counted| (tolerance, counted as f64))
    });
    let counted: Vec<(f64, f64)> = counted.collect();
    let (first, last) = (*counted.first()?, *counted.last()?);
    let mut chart = Chart::new(Axis::log("tolerance"), Axis::log("evaluations")).series(
        "counted",
        MEASURED,
        counted.iter().copied(),
    );
    let told = power.map(|power| match power {
        Power::Claimed(power) => (f64::from(power), power.to_string(), "claimed"),
        Power::Found(power) => (power, format!("{power:.1}"), "found"),
    });
    let mut slope = String::new();
    if let Some((power, digits, how)) = told {
        // Long steps tell no power: from the smallest tolerance.
        chart = chart.slope(-1.0 / power, last, first.0, format!("slope −1/{digits}, {how}"));
        slope = format!("; the dotted line has q = {digits}, as {how}");
    }
    let caption = format!(
        "Force evaluations of three runs against the tolerance, both axes logarithmic. With an \
         estimate that falls with the power q of the step they grow as tol^(−1/q){slope}."
    );
    Some(drawn("evaluations", "Evaluations against tolerance", &caption, chart))
}

/// Error along a run, of a solver, at times between its steps, beside what decides: the error at
/// the ends of steps, and the tolerance.
fn outputs(outputs: &[(f64, f64)], beside_steps: Option<(f64, f64)>) -> Option<String> {
    let some = outputs.iter().any(|(_, error)| *error > 0.0 && error.is_finite());
    let (from, to) = (outputs.first()?.0, outputs.last()?.0);
    let level = |height: f64| [(from, height), (to, height)];
    let mut chart = Chart::new(Axis::linear("t (s)"), Axis::log("error (rad)")).height(240.0);
    let mut caption = format!("Error of {} states along a run", outputs.len());
    if let Some((tolerance, steps)) = beside_steps {
        caption += &format!(" with the tolerance {}", scientific(tolerance));
        chart = chart.series("the tolerance", Style::REFERENCE.dashed(), level(tolerance));
        if steps > 0.0 && steps.is_finite() {
            chart = chart.series("at the ends of steps", Style::REFERENCE, level(steps));
        }
    }
    chart = chart.series("all", MEASURED.line_only().solid(), outputs.iter().copied());
    caption += ", most of them between two steps. Where the line rises far above the error at the \
                ends of steps, states between steps are worse than the steps.";
    some.then(|| drawn("outputs", "Error along a run", &caption, chart))
}

/// Axes for states.
fn plane() -> Chart {
    Chart::new(Axis::linear("θ (rad)"), Axis::linear("ω (rad/s)"))
}

#[cfg(test)]
mod tests {
    use pendula::methods::ForwardEuler;
    use pendula_judge::judge;

    use super::*;

    fn state(theta: f64, omega: f64) -> Phase {
        Phase { theta, omega }
    }

    /// Catches: a figure left out, or drawn from nothing; two that share an id; the slope of
    /// another order, slopes in the order of the list.
    #[test]
    fn what_there_is_evidence_for_is_drawn() {
        assert!(figures(&Report::default(), &Claims::order(2).estimate(5)).is_empty());
        let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| state(x, y));
        let mut report = Report::default();
        let evidence = &mut report.evidence;
        evidence.ladder = vec![(0.1, 1e-2), (0.025, 6.25e-4), (0.05, 2.5e-3), (0.0125, 0.0)];
        evidence.energy = vec![(0.0, 0.0), (1.0, 1e-3)];
        evidence.force = vec![(-1.0, 1.0), (2.0, -2.0)];
        evidence.square = Some((square, square.map(|z| state(z.theta + z.omega, 1.5 * z.omega))));
        evidence.way = Some((vec![state(1.0, 0.0), state(0.9, -1.0)], vec![state(1.0, 1e-3)]));
        let figures = figures(&report, &Claims::order(2));
        let [force, ladder, energy, square, way] = &figures[..] else { panic!("{figures:?}") };
        let has = |text: &str, part: &str| {
            assert!(text.contains(part), "{part} is not in {text}");
        };
        has(ladder, "are 2.00, 2.00, –; the dotted line falls with the power 2 ");
        has(ladder, "id=\"fig-ladder\"");
        has(ladder, "slope 2, claimed");
        has(energy, "id=\"fig-energy\"");
        has(force, "id=\"fig-force\"");
        has(square, "becomes 1.500000000 times as large");
        has(way, "ends 0 rad and 1.0 × 10⁻³ rad/s");
    }

    /// Catches: reports that all have one title; a name left out, or a bracket around none; the
    /// first of several failures alone.
    #[test]
    fn the_title_is_the_verdict() {
        let report = judge(&ForwardEuler, Claims::order(2).symplectic());
        let claims = Claims::order(2).symplectic();
        let mut judged = Judged { command: "./euler", name: "", claims: &claims, report: &report };
        assert_eq!(title(judged.report, judged.name), "Claims fail: order, area, stage-times");
        let html = html(&judged, "2026-01-02");
        assert!(html.contains("Tested: ./euler, on 2026-01-02, with pendula "), "{html}");
        (judged.command, judged.name) = ("", "euler");
        assert_eq!(
            title(judged.report, judged.name),
            "Claims fail: order, area, stage-times · euler"
        );
        let report = judge(&ForwardEuler, Claims::order(1));
        judged.report = &report;
        assert_eq!(title(judged.report, judged.name), "Every claim holds · euler");
        // What fails comes first, wherever it was measured.
        let failing = html.find(r#"scope="row">stage-times"#);
        assert!(failing < html.find(r#"scope="row">equation"#), "{html}");
    }

    /// Catches: a power left as it is typed, or one that takes the text after it along; a line that
    /// ends within a number.
    #[test]
    fn powers_are_raised() {
        let html = "grows as tol<sup>−1/q</sup> with q = 2; tol<sup>0.8</sup>~±~0.1 &lt; \
                    <code>x</code>, 2~×~10⁻⁴";
        let text = "grows as tol^(−1/q) with q = 2; tol^0.8 ± 0.1 < `x`, 2 × 10⁻⁴";
        assert_eq!(set(text).replace('\u{a0}', "~"), html);
    }

    /// Catches: a panic where the evidence is a single point or none that has a place.
    #[test]
    fn poor_evidence_is_drawn_as_well_as_it_can_be() {
        let mut report = Report::default();
        let evidence = &mut report.evidence;
        evidence.ladder = vec![(0.1, f64::NAN)];
        evidence.energy = vec![(0.0, f64::INFINITY)];
        evidence.way = Some((vec![state(f64::NAN, 0.0)], vec![]));
        evidence.tolerances = vec![(1e-3, f64::INFINITY, Some(0)), (1e-4, f64::NAN, None)];
        evidence.outputs = vec![(0.0, 0.0), (1.0, f64::INFINITY)];
        assert_eq!(figures(&report, &Claims::none()).len(), 3);
        assert_eq!(figures(&report, &Claims::order(4).estimate(u32::MAX)).len(), 3);
        report.evidence.tolerances = vec![(1e-3, 1e-3, Some(1))];
        assert_eq!(figures(&report, &Claims::order(4).estimate(0)).len(), 4);
    }

    /// Catches: a figure of a solver that is left out, or is drawn of what is not counted; the
    /// slope of another power than that which is claimed, or was found where none is; a slope that
    /// rises; outputs without the error that they are compared with, or its tolerance.
    #[test]
    fn what_a_solver_does_is_drawn() {
        let mut report = Report::default();
        report.evidence.tolerances =
            vec![(1e-3, 1e-2, Some(32)), (1e-5, 1e-4, Some(320)), (1e-7, 0.0, None)];
        report.evidence.outputs = vec![(0.0, 0.0), (1.0, 1e-3), (2.0, 1e-4)];
        report.evidence.beside_steps = Some((1e-7, 2e-8));
        let mut estimate = Finding::default();
        (estimate.property, estimate.values) = (Property::Estimate, vec![2.04]);
        report.findings = vec![estimate];
        for (claims, slope) in [
            (Claims::none(), "slope −1/2.0, found"),
            (Claims::order(2).estimate(3), "slope −1/3, claimed"),
        ] {
            let figures = figures(&report, &claims);
            let [tolerance, evaluations, outputs] = &figures[..] else { panic!("{figures:?}") };
            assert!(tolerance.contains("id=\"fig-tolerance\""), "{tolerance}");
            assert!(tolerance.contains("the tolerance itself"), "{tolerance}");
            assert!(evaluations.contains("id=\"fig-evaluations\""), "{evaluations}");
            assert!(evaluations.contains(slope), "{evaluations}");
            assert!(outputs.contains("id=\"fig-outputs\""), "{outputs}");
            assert!(outputs.contains("Error of 3 states along a run with the"), "{outputs}");
            assert!(outputs.contains("1.0 × 10⁻⁷, most"), "{outputs}");
            assert!(outputs.contains("at the ends of steps</text>"), "{outputs}");
        }
        report.findings.clear();
        assert!(!figures(&report, &Claims::none())[1].contains("slope"));
        report.evidence.tolerances = vec![(1e-3, 1e-2, None), (1e-5, 1e-4, None)];
        assert_eq!(figures(&report, &Claims::none()).len(), 2);
    }
}
