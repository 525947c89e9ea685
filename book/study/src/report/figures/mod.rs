//! The figures of the book, drawn from the study: the paper's, and those it lacks.

mod beyond;
mod choosing;
mod evidence;
mod geometry;
mod higher_order;
mod limits;
mod opening;
mod paper;

use pendula::{METHODS, method_named};

use crate::charts::{Figure, Style, wrapped};
use crate::experiments::{MethodRef, Study, in_paper};

/// A figure of the book.
#[derive(Clone, Copy, Debug)]
pub struct Drawing {
    /// Its name: those of the paper have its number, others say what they show.
    pub name: &'static str,
    /// What to see in it.
    pub caption: &'static str,
    draw: fn(&Study) -> Figure,
}

impl Drawing {
    /// The figure as an `<svg>` element.
    pub fn svg(&self, study: &Study) -> String {
        (self.draw)(study).to_svg(self.name)
    }

    /// The figure with its caption, as a `<figure>` element without a blank line.
    pub fn html(&self, study: &Study) -> String {
        // The Markdown processor makes apostrophes typographic, but not in HTML.
        let (svg, caption) = (self.svg(study), wrapped(&self.caption.replace('\'', "’")));
        format!("<figure>\n{svg}<figcaption>{caption}</figcaption>\n</figure>\n")
    }
}

/// The figures, file by file.
pub fn figures() -> impl Iterator<Item = &'static Drawing> {
    [
        opening::FIGURES,
        paper::FIGURES,
        geometry::FIGURES,
        evidence::FIGURES,
        choosing::FIGURES,
        higher_order::FIGURES,
        limits::FIGURES,
        beyond::FIGURES,
    ]
    .into_iter()
    .flatten()
}

/// The style of a method, the same in every figure.
pub(super) fn style(method: MethodRef) -> Style {
    let name = method.info().name;
    let index = METHODS.iter().position(|other| other.info().name == name);
    Style::numbered(index.unwrap_or(0))
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
