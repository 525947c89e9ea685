//! The figures of the book, drawn from the study: the paper's, and those it lacks.

mod beyond;
mod choosing;
mod evidence;
mod geometry;
mod opening;
mod paper;
mod solvers;
mod tolerance;

use std::collections::BTreeMap;
use std::sync::LazyLock;

use pendula::methods::{ForwardEuler, StormerVerlet, SymplecticEuler};
use pendula::{METHODS, method_named};
use serde::Deserialize;

use crate::charts::{Axis, Chart, Figure, Style, area_of, wrapped};
use crate::experiments::{MethodRef, Study, in_paper};

/// A figure of the book.
#[derive(Clone, Copy, Debug)]
pub struct Drawing {
    /// Its name: those of the paper have their number, others say what they show.
    pub name: &'static str,
    /// Adds its charts to a figure that has its title and its description.
    draw: fn(&Study, Figure) -> Figure,
}

/// What stands about a figure, in `figures.toml`.
#[derive(Debug, Deserialize)]
struct Words {
    title: String,
    /// What to see in it.
    caption: String,
    /// For who cannot see it.
    description: String,
}

static WORDS: LazyLock<BTreeMap<String, Words>> = LazyLock::new(|| {
    toml::from_str(include_str!("figures.toml")).unwrap_or_else(|error| panic!("{error}"))
});

impl Drawing {
    fn words(&self) -> &'static Words {
        WORDS.get(self.name).unwrap_or_else(|| panic!("{} is not in figures.toml", self.name))
    }

    /// What it is, in a line.
    pub fn title(&self) -> &'static str {
        &self.words().title
    }

    /// The figure, with the values that it shows.
    pub fn figure(&self, study: &Study) -> Figure {
        let Words { title, description, .. } = self.words();
        (self.draw)(study, Figure::new(title, description))
    }

    /// The figure as an `<svg>` element.
    pub fn svg(&self, study: &Study) -> String {
        self.figure(study).to_svg(self.name)
    }

    /// The figure with its caption, as a `<figure>` element without a blank line.
    pub fn html(&self, study: &Study) -> String {
        self.html_of(&self.figure(study))
    }

    /// The same of its figure, which was drawn before.
    pub fn html_of(&self, figure: &Figure) -> String {
        captioned(&figure.to_svg(self.name), &self.words().caption)
    }
}

/// The drawing over its caption, as a `<figure>` element without a blank line.
fn captioned(svg: &str, caption: &str) -> String {
    // The Markdown processor makes apostrophes typographic, but not in HTML.
    let caption = wrapped(&caption.replace('\'', "’"));
    format!("<figure>\n{svg}<figcaption>{caption}</figcaption>\n</figure>\n")
}

/// The figures, file by file.
pub fn figures() -> impl Iterator<Item = &'static Drawing> {
    DRAWINGS.iter()
}

const DRAWINGS: &[Drawing] = &[
    Drawing { name: "two_eulers", draw: opening::two_eulers },
    Drawing { name: "forces", draw: opening::forces },
    Drawing { name: "swings", draw: opening::swings },
    Drawing { name: "figure_2", draw: paper::figure_2 },
    Drawing { name: "figure_3", draw: paper::figure_3 },
    Drawing { name: "figure_4", draw: paper::figure_4 },
    Drawing { name: "figure_5", draw: paper::figure_5 },
    Drawing { name: "figure_6", draw: paper::figure_6 },
    Drawing { name: "figure_7", draw: paper::figure_7 },
    Drawing {
        name: "stencil_forward_euler",
        draw: |_, figure| figure.panel(geometry::step_of(&ForwardEuler)),
    },
    Drawing {
        name: "stencil_symplectic_euler",
        draw: |_, figure| figure.panel(geometry::step_of(&SymplecticEuler)),
    },
    Drawing {
        name: "stencil_stormer_verlet",
        draw: |_, figure| figure.panel(geometry::step_of(&StormerVerlet)),
    },
    Drawing { name: "stencil_rk4", draw: geometry::stencil_rk4 },
    Drawing { name: "area", draw: geometry::area_carried },
    Drawing { name: "cat", draw: geometry::cat },
    Drawing { name: "tilted_curve", draw: geometry::tilted_curve },
    Drawing { name: "level_curves", draw: geometry::level_curves },
    Drawing { name: "cancellation", draw: evidence::cancellation },
    Drawing { name: "five_periods", draw: evidence::five_periods },
    Drawing { name: "standard_map", draw: evidence::standard_map },
    Drawing { name: "rounding_walk", draw: evidence::rounding_walk },
    Drawing { name: "decision", draw: choosing::decision },
    Drawing { name: "decision_small", draw: |_, figure| choosing::other_swing(0.3, figure) },
    Drawing { name: "decision_large", draw: |_, figure| choosing::other_swing(2.0, figure) },
    Drawing { name: "decision_near_top", draw: |_, figure| choosing::other_swing(3.0, figure) },
    Drawing { name: "cost", draw: choosing::cost },
    Drawing { name: "triple_jump", draw: geometry::triple_jump },
    Drawing { name: "resonances", draw: evidence::resonances },
    Drawing { name: "truncation", draw: evidence::truncation },
    Drawing { name: "least_change", draw: evidence::least_change },
    Drawing { name: "widths", draw: evidence::widths },
    Drawing { name: "adaptive_steps", draw: beyond::adaptive_steps },
    Drawing { name: "tolerance_error", draw: tolerance::error },
    Drawing { name: "tolerance_work", draw: tolerance::work },
    Drawing { name: "tolerance_outputs", draw: tolerance::outputs },
    Drawing { name: "solver_ends", draw: solvers::ends },
    Drawing { name: "solver_outputs", draw: solvers::outputs },
    Drawing { name: "solver_again", draw: solvers::again },
    Drawing { name: "solver_back", draw: solvers::back },
    Drawing { name: "solver_clock", draw: solvers::clock },
    Drawing { name: "road_to_chaos", draw: beyond::road_to_chaos },
    Drawing { name: "poincare", draw: beyond::poincare },
    Drawing { name: "separation", draw: beyond::separation },
    Drawing { name: "kapitza", draw: beyond::kapitza },
    Drawing { name: "double_pendulum_trace", draw: beyond::double_pendulum_trace },
    Drawing { name: "turning_ellipse", draw: beyond::turning_ellipse },
];

/// A chart of states between these values of θ (rad) and of ω (rad/s).
fn phase_plane(theta: (f64, f64), omega: (f64, f64)) -> Chart {
    Chart::new(
        Axis::linear("θ (rad)").range(theta.0, theta.1),
        Axis::linear("ω (rad/s)").range(omega.0, omega.1),
    )
}

/// Methods in the order of their styles: by name, so that a method which comes into the library
/// repaints no other. The paper's four come first, then those of the maps, each with a hue; of the
/// others, those that meet in a figure have different ones. The lab has the same list.
const STYLED: [&str; 28] = [
    "forward-euler",
    "symplectic-euler",
    "rk4",
    "stormer-verlet",
    "blanes-moan-6",
    "taylor-24",
    "processed-6",
    "deuflhard",
    "gauss-16",
    "processed-4",
    "blanes-moan-srkn-6b",
    "dop853",
    "explicit-midpoint",
    "forest-ruth",
    "gauss-6",
    "implicit-midpoint",
    "yoshida-6",
    "dormand-prince",
    "heun",
    "suzuki-4",
    "gauss-4",
    "trapezoidal",
    "yoshida-8",
    "ruth-3",
    "position-verlet",
    "kahan-li-8",
    "discrete-gradient",
    "cieslinski-ratkiewicz",
];

/// The place of a method in the order of styles. Those that are not in [`STYLED`] come after it, in
/// the order of the library's list.
fn styled(method: MethodRef) -> usize {
    let name = method.info().name;
    let place = |name: &str| STYLED.iter().position(|styled| *styled == name);
    let others = || METHODS.iter().map(|it| it.info().name).filter(|name| place(name).is_none());
    let index = place(name).or_else(|| Some(STYLED.len() + others().position(|it| it == name)?));
    index.unwrap_or(0)
}

/// The style of a method, the same in every figure.
pub fn style(method: MethodRef) -> Style {
    Style::numbered(styled(method))
}

/// The colour of a method's area: of the same hue.
fn area(method: MethodRef) -> usize {
    area_of(styled(method)).unwrap_or_else(|| panic!("no area is {}'s", title(method)))
}

/// The rows of the methods that the paper compares: its figures do not change as the list of
/// methods grows.
fn of_the_paper<R>(rows: &[R], method: fn(&R) -> MethodRef) -> impl Iterator<Item = &R> {
    rows.iter().filter(move |row| in_paper(method(row)))
}

pub(super) fn title(method: MethodRef) -> &'static str {
    method.info().title
}

fn named(name: &str) -> MethodRef {
    method_named(name).expect("one of the library's methods")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::experiments::PaperMethod;

    /// Catches: a method that the lab shows in another colour, or with another marker, than the
    /// figures.
    #[test]
    fn the_lab_has_methods_in_the_same_order() {
        let script = concat!(env!("CARGO_MANIFEST_DIR"), "/../theme/lab/sheet.js");
        let script = std::fs::read_to_string(script).unwrap();
        let list = script.split_once("STYLED = `").and_then(|(_, rest)| rest.split_once('`'));
        let list: Vec<&str> = list.unwrap().0.split_whitespace().collect();
        assert_eq!(list, STYLED);
        let papers = PaperMethod::ALL.map(|method| styled(named(method.name())));
        assert!(papers.iter().all(|place| *place < 4), "{papers:?}");
    }

    /// Catches: the words of a figure that is not drawn any more, and a figure drawn twice.
    #[test]
    fn all_words_are_those_of_a_figure() {
        let names: Vec<&str> = figures().map(|drawing| drawing.name).collect();
        assert!(WORDS.keys().all(|name| names.contains(&name.as_str())), "{names:?}");
        assert_eq!(names.len(), WORDS.len());
    }
}
