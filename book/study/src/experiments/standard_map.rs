//! Orbits of the standard map, which is what symplectic Euler is when its step is large.
//!
//! With u = hω (rad a step) and K = (g/L) h² a step of symplectic Euler is u' = u − K sin θ, θ' =
//! θ + u' (Chirikov, *Physics Reports* 52 (1979) 263). The map does not change when θ or u grows by
//! a full turn, so that an orbit on the whole of the phase plane can be looked at folded into one
//! square.

use core::f64::consts::{PI, TAU};

use pendula::methods::SymplecticEuler;
use pendula::methods::registry::AnyMethod;
use pendula::{Grid, Pendulum, Phase};

use super::released;

/// The parameters K of the portraits: well below the last barrier at 0.971635, just below it, and
/// above.
pub const PARAMETERS: [f64; 3] = [0.5, 0.97, 1.2];

/// An orbit, and whether it got away.
#[derive(Clone, Debug)]
pub struct Orbit {
    /// The points (θ, u) (rad, rad a step), each folded into [−π, π].
    pub points: Vec<(f64, f64)>,
    /// Whether |u| passed 2π within [`STEPS`], where the picture begins again a full turn a step
    /// faster.
    pub escapes: bool,
}

/// How long an orbit is followed. Of the orbits that start beside the upper equilibrium at K = 1.2,
/// all have escaped by then.
pub const STEPS: u64 = 60_000;

/// Of so many points one is kept: a prime, so that no chain of islands is seen on one island only.
const KEPT: u64 = 281;

/// Orbits of symplectic Euler with the paper's pendulum, at the step that makes its map the one
/// with the parameter `k`.
pub fn orbits(k: f64) -> Vec<Orbit> {
    starts().into_iter().map(|start| orbit(k, start, |n| n.is_multiple_of(KEPT))).collect()
}

/// The golden mean's turns a step, (3 − √5)/2: the winding number of the last curve to break.
const GOLDEN: f64 = 0.381_966_011_250_105_15;

/// The orbit through θ = 0 with the golden mean's turns a step, from left to right: where it stays,
/// it lies on the last curve to break (Greene, *J. Math. Phys.* 20 (1979) 1183).
///
/// The turns of an orbit grow with u, so that its start is found by bisection.
pub fn golden(k: f64) -> Orbit {
    let wanted = GOLDEN * TAU * STEPS as f64;
    let grid = Grid::new(step(k), STEPS).expect("a positive step");
    // Between the libration about the equilibrium and the islands of half a turn a step.
    let (mut slow, mut fast) = (1.5, PI);
    for _ in 0..32 {
        let u = 0.5 * (slow + fast);
        let start = Phase { theta: 0.0, omega: u / step(k) };
        let end = SymplecticEuler.end(&Pendulum::PAPER, start, &grid);
        *(if end.theta < wanted { &mut slow } else { &mut fast }) = u;
    }
    // No points lie more evenly on a curve than the first so many of a golden mean.
    let mut orbit = orbit(k, (0.0, 0.5 * (slow + fast)), |n| n < 233);
    orbit.points.sort_by(|a, b| a.0.total_cmp(&b.0));
    orbit
}

/// The step (s) at which the parameter is `k`.
pub fn step(k: f64) -> f64 {
    libm::sqrt(k / Pendulum::PAPER.frequency_squared())
}

/// Fourteen through the stable equilibrium's column up to half a turn a step, in either direction,
/// two about the islands of half a turn a step, and six within the chaotic layer, beside the upper
/// equilibrium.
fn starts() -> Vec<(f64, f64)> {
    let column = (1..=7).map(|j| 0.43 * f64::from(j));
    let islands = [2.6, 2.9].into_iter().map(|u| (PI, u));
    let layer = (1..=6).map(|j| (PI - 1e-3 * f64::from(j), 0.0));
    column.flat_map(|u| [(0.0, u), (0.0, -u)]).chain(islands).chain(layer).collect()
}

fn orbit(k: f64, (theta, u): (f64, f64), kept: impl Fn(u64) -> bool) -> Orbit {
    let step = step(k);
    let start = Phase { omega: u / step, ..released(theta) };
    let grid = Grid::new(step, STEPS).expect("a positive step");
    let mut orbit = Orbit { points: Vec::new(), escapes: false };
    SymplecticEuler.run(&Pendulum::PAPER, start, &grid, &mut |n: u64, _, z: Phase| {
        let u = z.omega * step;
        orbit.escapes |= u.abs() > TAU;
        if kept(n) {
            orbit.points.push((folded(z.theta), folded(u)));
        }
    });
    orbit
}

/// The angle less whole turns, between −π and π.
fn folded(angle: f64) -> f64 {
    angle - TAU * libm::rint(angle / TAU)
}
