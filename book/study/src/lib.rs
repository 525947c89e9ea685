//! The study: the paper's experiments repeated, their results predicted by theory, the paper's
//! claims judged, and tables and figures of all of it.
//!
//! Each module uses only those above it:
//!
//! * [`digits`]: how numbers are printed.
//! * [`theory`]: what follows from the equations, without running a method.
//! * [`experiments`]: what the methods do, as typed rows.
//! * [`claims`]: the paper's claims compared with the rows; theory's predictions of its cells.
//! * [`dynamics`]: periodic orbits and Lyapunov exponents, in a crate of their own.
//! * [`solvers`]: other people's solvers, and what the judge found of them.
//! * [`questions`]: what is right in the book's questions.
//! * [`charts`]: series to SVG, in a crate of their own.
//! * [`report`]: rows and claims as tables and figures.
//!
//! Apart from these, [`listing`] holds the book's listings to the output that stands below them.
#![warn(clippy::disallowed_methods)]

pub mod claims;
pub mod digits;
pub mod experiments;
pub mod listing;
pub mod questions;
pub mod report;
pub mod solvers;
pub mod theory;

pub use pendula_charts as charts;
pub use pendula_dynamics as dynamics;

/// The listings of the book's chapters, run as tests.
#[cfg(doctest)]
mod listings {
    macro_rules! listings {
        ($($name:ident: $file:literal,)+) => {
            $(#[doc = include_str!($file)] mod $name {})+
        };
    }
    listings! {
        introduction: "../../src/introduction.md",
        pendulum: "../../src/pendulum.md",
        forward_euler: "../../src/forward-euler.md",
        symplectic_euler: "../../src/symplectic-euler.md",
        stormer_verlet: "../../src/stormer-verlet.md",
        rk4: "../../src/rk4.md",
        order: "../../src/order.md",
        long_run: "../../src/long-run.md",
        phase_space: "../../src/phase-space.md",
        small_angle: "../../src/small-angle.md",
        limits: "../../src/limits.md",
        higher_order: "../../src/higher-order.md",
        adaptive_steps: "../../src/adaptive-steps.md",
        tolerance: "../../src/tolerance.md",
        friction_and_drives: "../../src/friction-and-drives.md",
        other_systems: "../../src/other-systems.md",
        choosing: "../../src/choosing.md",
        judging: "../../src/judging.md",
        exact_motion: "../../src/exact-motion.md",
        methods: "../../src/methods.md",
        speed: "../../src/speed.md",
    }
}
