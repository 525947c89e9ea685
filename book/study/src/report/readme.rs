//! The pictures of the README, which cannot include a snapshot: files of their own. One is of four
//! pendulums that swing side by side, in a file that moves by itself.
//!
//! The movement is in the SVG's own language (SMIL), which a browser plays in an image too, without
//! scripts. Who asks their system for little motion sees how it ends.

use core::f64::consts::PI;

use pendula::exact::Motion;
use pendula::{Pendulum, Phase};

use super::figures::{figures, style, title};
use crate::charts::{Num, Point, Style, draw_text, escape, line, style_sheet, wrapped};
use crate::experiments::Study;
use crate::experiments::side_by_side::{self, DURATION, EVALUATION, Row, THETA_0};

/// A picture and the file that it is, from the root of the repository.
pub struct Picture {
    /// The path of the file.
    pub path: String,
    /// What the file has to be.
    pub svg: String,
}

/// All of them.
pub fn pictures(study: &Study) -> Vec<Picture> {
    let picture = |path: &str, svg| Picture { path: path.to_string(), svg };
    let figure_2 = figures().find(|figure| figure.name == "figure_2");
    let [moving, at_rest] = moving_pictures();
    vec![
        picture("book/src/assets/four-pendulums.svg", moving),
        picture("book/src/assets/four-pendulums-at-rest.svg", at_rest),
        // It stands in for the lab where there are no scripts.
        picture(
            "book/src/assets/energy-error.svg",
            figure_2.expect("the paper's Figure 2").svg(study),
        ),
    ]
}

const ID: &str = "four-pendulums";
/// Width of a column, and of all of them.
const COLUMN: f64 = 210.0;
const WIDTH: f64 = 840.0;
const HEIGHT: f64 = 510.0;
/// The rod, and how far below the top it hangs from.
const LENGTH: f64 = 78.0;
const PIVOT: f64 = 150.0;
const BOB: f64 = 9.0;
/// The phase portrait: its height from bottom to top on the drawing, and what it shows of ω
/// (rad/s). It is [`PORTRAIT_WIDTH`] wide, for a whole turn.
const PORTRAIT: (f64, f64) = (462.0, 252.0);
const OMEGA: (f64, f64) = (-6.0, 12.0);
const PORTRAIT_WIDTH: f64 = 186.0;
/// Portraits of methods that stay near the exact motion are drawn so many times as large, about
/// their middle: a swing up to [`THETA_0`] would be a small ring in them otherwise.
const ENLARGED: f64 = 2.0;
/// The line of time, at this height.
const CLOCK: f64 = 492.0;
/// At the end everything stands still so long (s), and then it begins again.
const REST: f64 = 2.0;

/// The picture that moves, and how it ends. Not every browser tells an image how much motion its
/// reader wants, so the README asks and shows the one or the other.
fn moving_pictures() -> [String; 2] {
    let rows = side_by_side::run();
    let truth = side_by_side::truth();
    let styles: Vec<Style> = rows.iter().map(|row| style(row.method)).collect();
    let (mut fixed, mut moving, mut still) = (String::new(), String::new(), String::new());
    for (i, row) in rows.iter().enumerate() {
        let left = COLUMN * i as f64;
        let portrait = Portrait::of(row, left);
        let group = if i < 2 { "<g>" } else { "<g class=\"second\">" };
        line(&mut fixed, group.to_string());
        draw_fixed(&mut fixed, row, left, portrait);
        line(&mut fixed, "</g></g>".to_string());
        for (out, moves) in [(&mut moving, true), (&mut still, false)] {
            line(out, group.to_string());
            draw_pendulum(out, Style::REFERENCE, &truth, left, moves);
            draw_pendulum(out, style(row.method), &row.samples, left, moves);
            line(out, "<g class=\"wide\">".to_string());
            draw_orbit(out, row, portrait, moves);
            line(out, "</g></g>".to_string());
        }
    }
    for (out, clock) in [&mut fixed, &mut moving, &mut still].into_iter().zip(clock()) {
        line(out, format!("<g class=\"wide\">\n{clock}</g>"));
    }
    let both = format!("<g class=\"moving\">\n{moving}</g>\n<g class=\"still\">\n{still}</g>\n");
    let file = |rules: String, body: &str| {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"{ID}\" viewBox=\"0 0 {WIDTH} \
             {HEIGHT}\"\nwidth=\"{WIDTH}\" height=\"{HEIGHT}\" \
             preserveAspectRatio=\"xMinYMin slice\" role=\"img\" \
             aria-labelledby=\"title desc\">\n<title id=\"title\">{TITLE}</title>\n\
             <desc id=\"desc\">{}</desc>\n{}<style>\n{rules}</style>\n{fixed}{body}</svg>\n",
            wrapped(&escape(&description())),
            style_sheet(ID, &styles, &[], false),
        )
    };
    [file(rules() + &calm_rules(), &both), file(rules(), &still)]
}

const TITLE: &str = "Four pendulums from the same start, one for each method";

fn description() -> String {
    format!(
        "Each evaluates the force {} times a second, for {DURATION} seconds; a ring on a \
         dashed rod is the exact motion. Below each its orbit in phase space grows, drawn \
         {ENLARGED} times as large where it is small. Forward Euler goes over the top and turns \
         ever faster; symplectic Euler and Störmer–Verlet keep swinging close to the exact motion; \
         RK4 runs down.",
        1.0 / EVALUATION
    )
}

/// What the figures' style sheet does not say.
fn rules() -> String {
    let rules = [
        ".title {font-weight:600}",
        ".small {font-size:13px;opacity:.8}",
        ".true {opacity:.62}",
        ".rod {stroke-width:3}",
        ".ring {fill:none;stroke:currentColor;stroke-width:2}",
        ".track {stroke-width:1.8}",
    ];
    // Where the image is higher than wide, two stand below two, and the orbits are left out.
    let narrow = [
        ".second {transform:translate(-420px,262px)}",
        ".wide {display:none}",
        ".small {font-size:16px}",
    ];
    let of = |rule| format!(".{ID} {rule}\n");
    let narrow = format!("@media (max-aspect-ratio:1) {{\n{}}}\n", narrow.map(of).concat());
    rules.map(of).concat() + &narrow
}

/// Nothing moves for those who asked their system for little motion.
fn calm_rules() -> String {
    format!(
        ".{ID} .still {{display:none}}\n@media (prefers-reduced-motion:reduce) {{\n\
         .{ID} .moving {{display:none}}\n.{ID} .still {{display:inline}}\n}}\n"
    )
}

/// What does not move: names, supports, axes and the exact orbit.
fn draw_fixed(out: &mut String, row: &Row, left: f64, portrait: Portrait) {
    let middle = left + COLUMN / 2.0;
    draw_text(out, "title", (middle, 20.0), "middle", title(row.method));
    let step = format!("step {} s", row.step);
    draw_text(out, "small", (middle, 40.0), "middle", &step);
    let (x, y) = (Num(middle), Num(PIVOT));
    line(out, format!(r#"<path class="axis" d="M{x},{y}m-14,0h28"/><g class="wide">"#));
    // The axes of the portrait, and the exact orbit.
    let ([a, b], [bottom, top]) = (
        [-0.5, 0.5].map(|share| Num(middle + share * PORTRAIT_WIDTH)),
        [PORTRAIT.0, PORTRAIT.1].map(Num),
    );
    let zero = portrait.place((0.0, 0.0)).1;
    let zero_line = Num(zero);
    line(out, format!(r#"<path class="grid" d="M{a},{bottom}H{b}V{top}H{a}z"/>"#));
    line(out, format!(r#"<path class="axis" d="M{a},{zero_line}H{b}M{x},{bottom}V{top}"/>"#));
    draw_text(out, "small", (middle + 0.45 * PORTRAIT_WIDTH, zero - 5.0), "middle", "θ");
    draw_text(out, "small", (middle + 9.0, PORTRAIT.1 + 12.0), "middle", "ω");
    if portrait.enlarged > 1.0 {
        let corner = (middle - 0.5 * PORTRAIT_WIDTH + 6.0, PORTRAIT.1 + 16.0);
        let label = format!("enlarged {}×", portrait.enlarged);
        draw_text(out, "small", corner, "start", &label);
    }
    let motion = Motion::new(&Pendulum::PAPER, Phase::at_rest(THETA_0)).expect("a finite angle");
    let period = motion.period().expect("it swings");
    let orbit = (0..60).map(|n| motion.at(period * f64::from(n) / 60.0));
    let orbit = orbit.map(|z| portrait.place((z.theta, z.omega)));
    line(out, format!(r#"<path class="line true" d="{}z"/>"#, polyline(orbit)));
}

/// The rod and the bob, or the ring of the exact motion.
fn draw_pendulum(out: &mut String, style: Style, samples: &[Phase], left: f64, moves: bool) {
    let (x, y) = (Num(left + COLUMN / 2.0), Num(PIVOT));
    // θ grows counter-clockwise, an SVG's angles clockwise.
    let angle = |z: &Phase| Num(-z.theta.to_degrees());
    let end = angle(samples.last().expect("a sample"));
    let turn = match moves {
        true => {
            let frames = samples.iter().enumerate();
            let run = played(frames.map(|(n, z)| (n as f64 * EVALUATION, angle(z))));
            format!("<animateTransform attributeName=\"transform\" type=\"rotate\" {run}/>\n")
        }
        false => String::new(),
    };
    let (rod, radius) = (Num(LENGTH - BOB), Num(BOB));
    let shape = match style == Style::REFERENCE {
        true => format!(
            "<g class=\"true\"><path class=\"line\" stroke-dasharray=\"5 4\" d=\"M0,0V{rod}\"/>\
             <circle class=\"ring\" cy=\"{LENGTH}\" r=\"{radius}\"/></g>"
        ),
        false => format!(
            "<path {} d=\"M0,0V{rod}\"/><circle {} cy=\"{LENGTH}\" r=\"{radius}\"/>",
            style.class("rod line"),
            style.class("dot"),
        ),
    };
    line(out, format!("<g transform=\"translate({x},{y})\"><g transform=\"rotate({end})\">"));
    line(out, format!("{turn}{shape}</g></g>"));
}

/// A point of an orbit, within the turn from −π to π: its time and its place.
type Dated = (f64, Point);

/// The orbit in phase space as far as the time has come, and a dot where it is now.
fn draw_orbit(out: &mut String, row: &Row, portrait: Portrait, moves: bool) {
    let style = style(row.method);
    let turns = turns(&row.samples);
    for turn in &turns {
        let places: Vec<Point> = turn.iter().map(|&(_, point)| portrait.place(point)).collect();
        let d = polyline(places.iter().copied());
        let class = style.class("track line");
        if !moves {
            line(out, format!(r#"<path {class} d="{d}"/>"#));
            continue;
        }
        // A dash as long as the whole, which moves in from before the beginning.
        let mut length = 0.0;
        let mut so_far = vec![0.0];
        for pair in places.windows(2) {
            length += libm::hypot(pair[1].0 - pair[0].0, pair[1].1 - pair[0].1);
            so_far.push(length);
        }
        let whole = length.ceil() + 1.0;
        let offsets = turn.iter().zip(so_far).map(|((t, _), gone)| (*t, Num(whole - gone)));
        line(out, format!("<path {class} stroke-dasharray=\"{whole}\" d=\"{d}\">"));
        let run = played(offsets);
        line(out, format!("<animate attributeName=\"stroke-dashoffset\" {run}/></path>"));
    }
    let all: Vec<Dated> =
        turns.into_iter().flatten().map(|(t, point)| (t, portrait.place(point))).collect();
    let (_, end) = all.last().expect("a sample");
    let (x, y) = (Num(end.0), Num(end.1));
    let dot = format!(r#"<circle {} cx="{x}" cy="{y}" r="5""#, style.class("dot"));
    if !moves {
        line(out, format!("{dot}/>"));
        return;
    }
    let along = |name: &str, pick: fn(&Point) -> f64| {
        let run = played(all.iter().map(|(t, place)| (*t, Num(pick(place)))));
        format!("<animate attributeName=\"{name}\" {run}/>")
    };
    line(out, format!("{dot}>\n{}\n{}</circle>", along("cx", |p| p.0), along("cy", |p| p.1)));
}

/// How much time has gone: what does not move, what does, and how it ends.
fn clock() -> [String; 3] {
    let (left, right) = (40.0, WIDTH - 40.0);
    let at = |t: f64| Num(left + (right - left) * t / DURATION);
    let ticks = (0..=DURATION as u32).map(|t| format!("M{},{CLOCK}v-5", at(t.into())));
    let ticks: String = [format!("M{left},{CLOCK}H{right}")].into_iter().chain(ticks).collect();
    let mut fixed = format!("<path class=\"axis\" d=\"{ticks}\"/>\n");
    draw_text(&mut fixed, "small", (left - 8.0, CLOCK + 4.0), "end", "0 s");
    draw_text(&mut fixed, "small", (right + 6.0, CLOCK + 4.0), "start", &format!("{DURATION} s"));
    let dot = format!(r#"<circle class="dot" cx="{right}" cy="{CLOCK}" r="5""#);
    let run = played([0.0, DURATION].map(|t| (t, at(t))));
    let moving = format!("{dot}>\n<animate attributeName=\"cx\" {run}/></circle>\n");
    [fixed, moving, format!("{dot}/>\n")]
}

/// The attributes of an animation that takes values at times (s), straight between them; before
/// and after, the first and the last of them.
fn played(frames: impl IntoIterator<Item = (f64, Num)>) -> String {
    let all = DURATION + REST;
    let (times, mut values): (Vec<f64>, Vec<String>) =
        frames.into_iter().map(|(t, value)| (t, value.to_string())).unzip();
    let last = values.last().cloned().unwrap_or_default();
    let even = |(n, t): (usize, &f64)| (t - n as f64 * EVALUATION).abs() < 1e-9;
    let dates = if times.iter().enumerate().all(even) {
        // A browser spreads the values evenly by itself.
        values.resize((all / EVALUATION).round() as usize + 1, last);
        String::new()
    } else {
        let share = |t: &f64| format!("{:.4}", t / all).trim_start_matches('0').to_string();
        // The first is at 0 and the last at 1.
        let mut shares: Vec<String> = times.iter().map(share).collect();
        shares.insert(0, "0".to_string());
        shares.push("1".to_string());
        values.insert(0, values[0].clone());
        values.push(last);
        format!("keyTimes=\"{}\"\n", in_lines(&shares, ";"))
    };
    let values = in_lines(&values, ";");
    format!("dur=\"{all}s\" repeatCount=\"indefinite\"\n{dates}values=\"{values}\"")
}

/// The samples turn by turn, each from −π to π, cut where the pendulum passes the top.
fn turns(samples: &[Phase]) -> Vec<Vec<Dated>> {
    let number = |theta: f64| ((theta + PI) / (2.0 * PI)).floor();
    let within = |theta: f64, turn: f64| theta - 2.0 * PI * turn;
    let mut turns: Vec<Vec<Dated>> = Vec::new();
    let mut before: Option<(f64, Phase)> = None;
    for (n, z) in samples.iter().enumerate() {
        let (t, turn) = (n as f64 * EVALUATION, number(z.theta));
        match before {
            Some((last, from)) if number(from.theta) != turn => {
                let last_turn = number(from.theta);
                let top = 2.0 * PI * last_turn.max(turn) - PI;
                let s = (top - from.theta) / (z.theta - from.theta);
                let omega = from.omega + s * (z.omega - from.omega);
                let crossing = last + s * (t - last);
                let at = |turn| (crossing, (within(top, turn), omega));
                turns.last_mut().expect("a turn").push(at(last_turn));
                turns.push(vec![at(turn)]);
            }
            Some(_) => {}
            None => turns.push(Vec::new()),
        }
        let dated = (t, (within(z.theta, turn), z.omega));
        turns.last_mut().expect("a turn").push(dated);
        before = Some((t, *z));
    }
    turns
}

/// A phase portrait: its middle, how much larger than [`PORTRAIT`] says it is drawn, and the ω
/// (rad/s) at its bottom.
#[derive(Clone, Copy)]
struct Portrait {
    middle: f64,
    enlarged: f64,
    bottom: f64,
}

impl Portrait {
    /// Of the method in the column that begins at `left`.
    fn of(row: &Row, left: f64) -> Self {
        let fits = |z: &Phase| {
            z.theta.abs() < PI / ENLARGED && z.omega.abs() < 0.5 * (OMEGA.1 - OMEGA.0) / ENLARGED
        };
        let (enlarged, bottom) = match row.samples.iter().all(fits) {
            true => (ENLARGED, -0.5 * (OMEGA.1 - OMEGA.0) / ENLARGED),
            false => (1.0, OMEGA.0),
        };
        Self { middle: left + COLUMN / 2.0, enlarged, bottom }
    }

    /// Where a point (θ, ω) of phase space is on the drawing.
    fn place(self, (theta, omega): (f64, f64)) -> Point {
        let up = (omega - self.bottom) * self.enlarged / (OMEGA.1 - OMEGA.0);
        (
            self.middle + self.enlarged * theta / (2.0 * PI) * PORTRAIT_WIDTH,
            PORTRAIT.0 + up * (PORTRAIT.1 - PORTRAIT.0),
        )
    }
}

/// The attribute `d` of the line through the points.
fn polyline(points: impl Iterator<Item = Point>) -> String {
    let points: Vec<String> = points.map(|(x, y)| format!("{},{}", Num(x), Num(y))).collect();
    format!("M{}", in_lines(&points, " "))
}

/// The items with `between` them, sixteen to a line of text.
fn in_lines(items: &[String], between: &str) -> String {
    let lines: Vec<String> = items.chunks(16).map(|chunk| chunk.join(between)).collect();
    lines.join(&format!("{}\n", between.trim_end()))
}
