//! The pictures of the README, which cannot include a snapshot: files of their own.

mod moving;

use super::figures::figures;
use crate::charts::{Num, escape, width};
use crate::experiments::Study;

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
    let [moving, at_rest] = moving::svgs();
    let mut pictures = vec![
        picture("book/src/assets/four-pendulums.svg", moving),
        picture("book/src/assets/four-pendulums-at-rest.svg", at_rest),
        // It stands in for the lab where there are no scripts.
        picture(
            "book/src/assets/energy-error.svg",
            figure_2.expect("the paper's Figure 2").svg(study),
        ),
    ];
    pictures.extend(
        badges().map(|(name, svg)| Picture { path: format!("book/readme/{name}.svg"), svg }),
    );
    pictures
}

/// The letters are so much smaller than those of the figures.
const SCALE: f64 = 11.5 / 17.0;
/// Left and right of a text.
const PADDING: f64 = 7.0;

/// The badges, by the names of their files. The values are those of the workspace, which every
/// crate of it inherits.
fn badges() -> [(&'static str, String); 3] {
    [
        ("version", badge("version", env!("CARGO_PKG_VERSION"))),
        ("licence", badge("licence", env!("CARGO_PKG_LICENSE"))),
        ("rust", badge("Rust", concat!(env!("CARGO_PKG_RUST_VERSION"), " or newer"))),
    ]
}

/// White letters on grey and on blue, which can be read on a light page and on a dark one.
fn badge(label: &str, value: &str) -> String {
    let room = |text: &str| (SCALE * width(text) + 2.0 * PADDING).ceil();
    let (left, right) = (room(label), room(value));
    let (all, middle) = (left + right, left + right / 2.0);
    let (label, value) = (escape(label), escape(value));
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{all}\" height=\"20\" \
         viewBox=\"0 0 {all} 20\" role=\"img\"\naria-label=\"{label}: {value}\">\n\
         <title>{label}: {value}</title>\n\
         <clipPath id=\"round\"><rect width=\"{all}\" height=\"20\" rx=\"4\"/></clipPath>\n\
         <g clip-path=\"url(#round)\">\n<rect width=\"{left}\" height=\"20\" fill=\"#4b535d\"/>\n\
         <rect x=\"{left}\" width=\"{right}\" height=\"20\" fill=\"#0068a8\"/>\n</g>\n\
         <g fill=\"#ffffff\" font-family=\"system-ui,sans-serif\" font-size=\"11.5\" \
         text-anchor=\"middle\">\n<text x=\"{}\" y=\"14\">{label}</text>\n\
         <text x=\"{}\" y=\"14\">{value}</text>\n</g>\n</svg>\n",
        Num(left / 2.0),
        Num(middle),
    )
}
