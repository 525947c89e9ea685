//! The pictures of the README, which cannot include a snapshot: files of their own.

mod badges;
mod moving;

use super::figures::figures;
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
        badges::badges()
            .map(|(name, svg)| Picture { path: format!("book/readme/{name}.svg"), svg }),
    );
    pictures
}
