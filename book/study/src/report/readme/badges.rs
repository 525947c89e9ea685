//! Badges: a word and what it is now, from the manifest that Cargo reads.

use crate::charts::{Num, escape, width};

/// The letters are so much smaller than those of the figures.
const SCALE: f64 = 11.5 / 17.0;
/// Left and right of a text.
const PADDING: f64 = 7.0;

/// The badges, by the names of their files. The values are those of the workspace, which every
/// crate of it inherits.
pub(super) fn badges() -> [(&'static str, String); 3] {
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
