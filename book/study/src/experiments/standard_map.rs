//! Symplectic Euler as the standard map: its orbits at large steps.
//!
//! With u = hω (rad a step) and K = (g/L) h² a step of symplectic Euler is u' = u − K sin θ, θ' =
//! θ + u' (Chirikov, *Physics Reports* 52 (1979) 263). The map does not change when θ or u grows by
//! a full turn, so that an orbit on the whole of the phase plane can be folded into one square.

use core::f64::consts::{PI, TAU};

use pendula::methods::SymplecticEuler;
use pendula::{Grid, Pendulum, Phase, integrate_fast, integrate_fast_with};

/// The parameters K of the portraits: well below the last barrier at 0.971635, just below it, above
/// it, and far above.
pub const PARAMETERS: [f64; 4] = [0.5, 0.97, 1.2, 2.0];

/// An orbit, and whether it escapes.
#[derive(Clone, Debug)]
pub struct Orbit {
    /// The points (θ, u) (rad, rad a step), each folded into [−π, π].
    pub points: Vec<(f64, f64)>,
    /// Whether |u| exceeded 2π, a period of the map in u, within [`STEPS`].
    pub escapes: bool,
}

/// Steps of an orbit. All orbits that start beside the upper equilibrium at K = 1.2 escape within
/// them.
pub const STEPS: u64 = 60_000;

/// One point in this many is kept: a prime, so that no chain of islands shows on one island only.
const KEPT: u64 = 353;

/// Orbits of symplectic Euler with the paper's pendulum, at the step that makes its map the one
/// with the parameter `k`.
pub fn orbits(k: f64) -> Vec<Orbit> {
    starts().into_iter().map(|start| orbit(k, start, |n| n.is_multiple_of(KEPT))).collect()
}

/// The golden mean's winding number (turns a step), (3 − √5)/2: that of the last curve to break.
const GOLDEN: f64 = 0.381_966_011_250_105_15;

/// The orbit through θ = 0 with the golden mean's winding number, its points sorted by θ: if it
/// does not escape, it lies on the last curve to break (Greene, *J. Math. Phys.* 20 (1979) 1183).
///
/// The winding number of an orbit grows with its u, so that the start is found by bisection.
pub fn golden(k: f64) -> Orbit {
    let wanted = GOLDEN * TAU * STEPS as f64;
    let grid = Grid::new(step(k), STEPS).expect("a positive step");
    // Between the libration about the equilibrium and the islands of half a turn a step.
    let (mut slow, mut fast) = (1.5, PI);
    for _ in 0..32 {
        let u = 0.5 * (slow + fast);
        let start = Phase { theta: 0.0, omega: u / step(k) };
        let end = integrate_fast(&Pendulum::PAPER, &SymplecticEuler, start, &grid);
        *(if end.theta < wanted { &mut slow } else { &mut fast }) = u;
    }
    // The points of a golden-mean orbit are spaced most evenly when their number is a Fibonacci
    // number.
    let mut orbit = orbit(k, (0.0, 0.5 * (slow + fast)), |n| n < 233);
    orbit.points.sort_by(|a, b| a.0.total_cmp(&b.0));
    orbit
}

/// The step (s) at which the parameter is `k`.
pub fn step(k: f64) -> f64 {
    libm::sqrt(k / Pendulum::PAPER.frequency_squared())
}

/// Fourteen at θ = 0, through the stable equilibrium, up to half a turn a step in either
/// direction; two about the islands of half a turn a step; and six within the chaotic layer, beside
/// the upper equilibrium.
fn starts() -> Vec<(f64, f64)> {
    let column = (1..=7).map(|j| 0.43 * f64::from(j));
    let islands = [2.6, 2.9].into_iter().map(|u| (PI, u));
    let layer = (1..=6).map(|j| (PI - 1e-3 * f64::from(j), 0.0));
    column.flat_map(|u| [(0.0, u), (0.0, -u)]).chain(islands).chain(layer).collect()
}

fn orbit(k: f64, (theta, u): (f64, f64), kept: impl Fn(u64) -> bool) -> Orbit {
    let step = step(k);
    let start = Phase { omega: u / step, ..Phase::at_rest(theta) };
    let grid = Grid::new(step, STEPS).expect("a positive step");
    let mut orbit = Orbit { points: Vec::new(), escapes: false };
    let mut keep = |n: u64, _: f64, z: Phase| {
        let u = z.omega * step;
        orbit.escapes |= u.abs() > TAU;
        if kept(n) {
            orbit.points.push((folded(z.theta), folded(u)));
        }
    };
    integrate_fast_with(&Pendulum::PAPER, &SymplecticEuler, start, &grid, &mut keep);
    orbit
}

/// The angle minus whole turns, between −π and π.
fn folded(angle: f64) -> f64 {
    angle - TAU * libm::rint(angle / TAU)
}
