//! Beyond small steps: symplectic Euler is the Chirikov standard map, and the map has a last
//! barrier.
//!
//! With u = hω and K = (g/L) h² a step is u' = u − K sin θ, θ' = θ + u' (Chirikov, Physics Reports
//! 52 (1979)). Below K = 0.971635 (Greene, J. Math. Phys. 20 (1979); MacKay, Physica D 7 (1983))
//! invariant curves, "KAM tori", wind round the cylinder and no orbit crosses them; the last two to
//! break turn by the golden mean, 0.381966 or 0.618034 of a turn a step. Beyond, gaps let orbits
//! through, at K = 1.05 after 10⁵ steps or so, and the momentum diffuses without bound.
//!
//! How the numbers were chosen. The bundle starts at rest within 0.016 rad of the upper
//! equilibrium, which is inside the chaotic layer at every K here. Among 16 orbits of 10⁶ steps,
//! measured, at K = 0.95 and 0.97 none crosses u = 2π (nor the angle that the torus allows), at K =
//! 1.05 14 do (Verlet: 16), the median after 3 · 10⁵ steps; at K = 1.2 all do within 6 · 10⁴. So 8
//! orbits of 10⁶ steps tell 0.95 from 1.05 whatever the rounding: these tests do not hang on a
//! single bit.

use std::f64::consts::PI;

use approx::assert_relative_eq;
use pendula::methods::{StormerVerlet, SymplecticEuler};
use pendula::{Grid, Method, Observer, Pendulum, Phase, Separable, integrate};
use pendula_study::experiments::standard_map::{PARAMETERS, golden, orbits, step};
use rstest::rstest;

/// Where the last torus breaks.
const CRITICAL: f64 = 0.971_635;

/// A step that is a power of two: products with it are exact, so that u = hω loses nothing.
const STEP: f64 = 0.25;

/// A pendulum with the parameter `k` in steps of [`STEP`]; L ≠ 1.
fn pendulum(k: f64) -> Pendulum {
    Pendulum::new(2.0 * k / (STEP * STEP), 2.0, 1.0).unwrap()
}

/// At rest beside the upper equilibrium, in the chaotic layer.
fn bundle(orbits: u32) -> impl Iterator<Item = Phase> {
    (1..=orbits).map(|j| Phase::at_rest(PI - 1e-3 * f64::from(j)))
}

/// Catches: a critical step in the book or in a colleague's memory that is another pendulum's.
#[test]
fn the_critical_step_of_the_papers_pendulum() {
    let step = (CRITICAL / Pendulum::PAPER.frequency_squared()).sqrt();
    assert!((step - 0.314_71).abs() < 5e-6, "{step}");
}

// -------------------------------------------------------------------------------------------------
// Symplectic Euler is the standard map
// -------------------------------------------------------------------------------------------------

/// The standard map on (θ, u).
fn standard_map(k: f64, (theta, u): (f64, f64)) -> (f64, f64) {
    let u = u - k * pendula::arithmetic::sine::sin(theta);
    (theta + u, u)
}

/// With a step that is a power of two, scaling by it commutes with rounding: 10⁵ steps in the
/// chaotic layer are the same bits.
///
/// Catches: drift before kick, the old velocity in the drift, g for g/L, a step with any other
/// operation in it.
#[rstest]
fn symplectic_euler_is_the_standard_map_to_the_bit(#[values(0.5, 0.95, 1.2, 6.0)] k: f64) {
    let (pendulum, start) = (pendulum(k), Phase { theta: 3.0, omega: 1.0 });
    // The sine is the force's own, to the bit.
    let kick = |theta| pendulum.force(0.0, Phase::at_rest(theta)) * (STEP * STEP);
    let mut image = (start.theta, start.omega * STEP);
    let mut same = 0;
    let mut watch = |n: u64, _: f64, z: Phase| {
        if n > 0 {
            let u = image.1 + kick(image.0);
            image = (image.0 + u, u);
        }
        same += u64::from((z.theta, z.omega * STEP) == image);
    };
    let grid = Grid::new(STEP, 100_000).unwrap();
    integrate(&pendulum, &SymplecticEuler, start, &grid, &mut watch);
    assert_eq!(same, grid.samples());
}

/// With the paper's pendulum and any step they differ by rounding: of K, of u and of the kick, each
/// ε/2 of numbers below 6.
///
/// Catches: as above, where h is no power of two.
#[rstest]
fn one_step_is_the_standard_map_to_rounding(#[values(0.01, 0.314_71, 0.7)] h: f64) {
    const ROUNDING: f64 = 6.0 * f64::EPSILON;
    let pendulum = Pendulum::PAPER;
    for (theta, omega) in [(0.3, 1.0), (3.0, -4.0), (-2.0, 0.5)] {
        let one = Grid::new(h, 1).unwrap();
        let z = integrate(&pendulum, &SymplecticEuler, Phase { theta, omega }, &one, &mut ());
        let k = pendulum.frequency_squared() * h * h;
        let image = standard_map(k, (theta, omega * h));
        assert!((z.theta - image.0).abs() < ROUNDING && (z.omega * h - image.1).abs() < ROUNDING);
    }
}

/// Störmer–Verlet is symplectic Euler between half a kick back and half a kick forward: Kick½
/// (Drift Kick)ⁿ Kick½⁻¹.
///
/// On a regular orbit at K = 0.95 rounding grows as n at most: 10⁴ steps × a few ε × 4 rad.
///
/// Catches: a Verlet in position form; a first or last half kick forgotten.
#[test]
fn verlet_is_conjugate_to_the_standard_map() {
    const ROUNDING: f64 = 1e4 * 16.0 * f64::EPSILON;
    let pendulum = pendulum(0.95);
    let start = Phase { theta: 1.0, omega: 0.3 };
    let half_kick = |z: Phase, h: f64| pendulum.kick(z, pendulum.force(0.0, z), 0.5 * h);
    let grid = Grid::new(STEP, 10_000).unwrap();
    let inner = integrate(&pendulum, &SymplecticEuler, half_kick(start, -STEP), &grid, &mut ());
    let conjugate = half_kick(inner, STEP);
    let verlet = integrate(&pendulum, &StormerVerlet, start, &grid, &mut ());
    assert!((verlet.theta - conjugate.theta).abs() < ROUNDING);
    assert!((verlet.omega - conjugate.omega).abs() < ROUNDING / STEP);
    assert!((verlet.theta - inner.theta).abs() < ROUNDING, "the angle is the same before the kick");
}

// -------------------------------------------------------------------------------------------------
// The last barrier
// -------------------------------------------------------------------------------------------------

/// Watches an orbit for a crossing of the golden-mean tori, in either direction.
struct Barrier {
    start: Option<f64>,
    /// The lowest that θ − 2πρn and −θ − 2πρn have been.
    low: [f64; 2],
    /// The most that either has risen since, in turns.
    rise: f64,
    /// The largest |u|.
    fastest: f64,
    /// The step at which |u| first passed 2π.
    crossed: Option<u64>,
}

impl Barrier {
    /// The golden mean's turns a step: (3 − √5)/2.
    const TURNS: f64 = 0.381_966_011_250_105_15;

    const fn new() -> Self {
        Self { start: None, low: [0.0; 2], rise: 0.0, fastest: 0.0, crossed: None }
    }
}

impl Observer<Phase> for Barrier {
    fn observe(&mut self, n: u64, _t: f64, z: Phase) {
        let turned = (z.theta - *self.start.get_or_insert(z.theta)) / (2.0 * PI);
        for (low, ahead) in self.low.iter_mut().zip([turned, -turned]) {
            let lead = ahead - Self::TURNS * n as f64;
            *low = low.min(lead);
            self.rise = self.rise.max(lead - *low);
        }
        let u = (z.omega * STEP).abs();
        self.fastest = self.fastest.max(u);
        if u > 2.0 * PI {
            self.crossed.get_or_insert(n);
        }
    }
}

fn watch<M: Method<Pendulum>>(method: &M, k: f64, start: Phase, steps: u64) -> Barrier {
    let mut barrier = Barrier::new();
    integrate(&pendulum(k), method, start, &Grid::new(STEP, steps).unwrap(), &mut barrier);
    barrier
}

/// Orbits a test watches, and how long.
const ORBITS: u32 = 8;
const STEPS: u64 = 1_000_000;

/// Below the last torus nothing escapes. The map twists: an orbit below an invariant curve falls
/// behind the point of the curve above it, at each step anew, and the curve keeps the order of its
/// points. So from any sample on, n steps turn the orbit by less than ρn + 1 turns, ρ = 0.381966.
/// That holds rigorously while the torus does, for every orbit, and rounding of 10⁶ turns, 2e-10,
/// cannot break it. And u stays below 2π, where the layer's copy a turn faster lies.
///
/// Catches: a step that is not area-preserving, or that loses its tori to sloppy arithmetic; K
/// taken for √K.
#[rstest]
#[case::symplectic_euler(SymplecticEuler)]
#[case::stormer_verlet(StormerVerlet)]
fn below_the_last_torus_no_orbit_escapes<M: Method<Pendulum>>(#[case] method: M) {
    let mut fastest = 0.0_f64;
    for start in bundle(ORBITS) {
        let barrier = watch(&method, 0.95, start, STEPS);
        assert!(barrier.rise < 1.0, "{} turns ahead of the torus from {start:?}", barrier.rise);
        assert_eq!(barrier.crossed, None, "{start:?}");
        fastest = fastest.max(barrier.fastest);
    }
    // It is the chaotic layer all the same: beyond the separatrix of the pendulum, u = 2√K = 1.95,
    // by far.
    assert!(fastest > 2.2, "u = {fastest} is hardly chaos");
}

/// Just above it most do, and outrun the torus by thousands of turns.
///
/// Catches: a critical parameter that is off by more than 8 %; energies that are bounded because
/// the state is clamped or θ reduced.
#[rstest]
#[case::symplectic_euler(SymplecticEuler)]
#[case::stormer_verlet(StormerVerlet)]
fn above_the_last_torus_orbits_escape<M: Method<Pendulum>>(#[case] method: M) {
    let orbits: Vec<Barrier> =
        bundle(ORBITS).map(|start| watch(&method, 1.05, start, STEPS)).collect();
    let escaped = orbits.iter().filter(|barrier| barrier.crossed.is_some()).count();
    // Of 32 orbits measured 2 stay. If even one in eight did, six or more of eight would one time
    // in 10⁴.
    assert!(escaped >= 3, "{escaped} of {ORBITS}");
    assert!(orbits.iter().any(|barrier| barrier.rise > 1000.0));
}

/// At K = 1.2 the mean square of u grows as n: from 2¹⁴ to 2¹⁸ steps 16-fold. (Over 16 orbits it
/// scatters by √(2/16) = 35 % at either end: a factor of 4 is two standard deviations up at one and
/// down at the other. Measured: 8.4 and 16.7.) And all have escaped.
///
/// Catches: diffusion that stops, or runs off like n²: a drift, a clamp.
#[rstest]
#[case::symplectic_euler(SymplecticEuler)]
#[case::stormer_verlet(StormerVerlet)]
fn further_above_momentum_diffuses<M: Method<Pendulum>>(#[case] method: M) {
    const SCATTER: f64 = 4.0;
    let (early, late) = (1_u64 << 14, 1_u64 << 18);
    let (mut squares, mut escaped) = ([0.0; 2], 0);
    for start in bundle(16) {
        let mut watch = (Barrier::new(), |n: u64, _: f64, z: Phase| {
            for (sum, at) in squares.iter_mut().zip([early, late]) {
                if n == at {
                    *sum += (z.omega * STEP).powi(2) / 16.0;
                }
            }
        });
        integrate(&pendulum(1.2), &method, start, &Grid::new(STEP, late).unwrap(), &mut watch);
        escaped += usize::from(watch.0.crossed.is_some());
    }
    let growth = squares[1] / squares[0];
    assert_eq!(escaped, 16);
    assert!(growth > 16.0 / SCATTER && growth < 16.0 * SCATTER, "grew {growth}-fold");
}

/// Far above, the kicks are as good as random, and u diffuses as K²/2 a step (Chirikov; the next
/// term is −K² J₂(K)): D = (K²/2)(1 − 2J₂(K)) with J₂(6) = −0.2429, 26.7.
///
/// Catches: a kick of the wrong size that still has the right signs.
#[test]
fn far_above_the_diffusion_is_that_of_random_kicks() {
    const ORBITS: u32 = 1024;
    let k = 6.0;
    let steps = 200_u32;
    let mean: f64 = (1..=ORBITS)
        .map(|j| {
            // Spread over all angles, by the golden angle.
            let start = Phase::at_rest(2.399_963_229_728_653 * f64::from(j) % (2.0 * PI));
            let grid = Grid::new(STEP, u64::from(steps)).unwrap();
            let end = integrate(&pendulum(k), &SymplecticEuler, start, &grid, &mut ());
            (end.omega * STEP).powi(2) / f64::from(ORBITS)
        })
        .sum();
    let rate = mean / f64::from(steps);
    // Scatter √(2/1024) = 4.4 %; terms in J₁², J₃² are (2 · 0.277² + 2 · 0.115²) = 18 % against
    // J₂'s 49 %.
    assert_relative_eq!(rate, 0.5 * k * k * (1.0 + 2.0 * 0.2429), max_relative = 0.35);
}

// -------------------------------------------------------------------------------------------------
// The portraits
// -------------------------------------------------------------------------------------------------

/// In the book's portraits nothing escapes below the last torus; above it at least the six orbits
/// of the chaotic layer do.
///
/// Catches: a step at which the map has another K; an escape counted where the picture was folded,
/// or never.
#[test]
fn orbits_escape_in_the_last_portrait_only() {
    let escaped = PARAMETERS.map(|k| orbits(k).iter().filter(|orbit| orbit.escapes).count());
    assert!(escaped[0] == 0 && escaped[1] == 0 && escaped[2] >= 6, "{escaped:?}");
    for orbit in PARAMETERS.into_iter().flat_map(orbits) {
        let inside = |(theta, u): &(f64, f64)| theta.abs() <= PI && u.abs() <= PI;
        assert!(orbit.points.len() > 200 && orbit.points.iter().all(inside));
    }
    assert!((step(CRITICAL) - 0.314_71).abs() < 5e-6);
}

/// On the last curve u is a function of θ, and the map and its inverse, θ' = θ + u − K sin θ and θ
/// − u, keep the order of the points on it: so the slope of u lies between −(1 + K) and 1. The
/// golden mean's first 233 points are 2π/233 · √5 apart at most where they lie evenly, 0.06; the
/// bent curve stretches that by less than 3. An orbit off the curve jumps by more than either.
///
/// Catches: a bisection that ends in an island or in the sea; a golden mean of another sign; a
/// curve drawn where there is none.
#[rstest]
#[case(0.5, true)]
#[case(0.97, true)]
#[case(1.2, false)]
fn the_last_curve_is_a_curve_while_it_lasts(#[case] k: f64, #[case] stays: bool) {
    let golden = golden(k);
    let pairs = golden.points.windows(2).map(|pair| (pair[1].0 - pair[0].0, pair[1].1 - pair[0].1));
    let is_curve = pairs.clone().all(|(gap, rise)| rise < gap && rise > -(1.0 + k) * gap);
    let widest = pairs.map(|(gap, _)| gap).fold(0.0, f64::max);
    assert_eq!(golden.escapes, !stays);
    assert_eq!(is_curve, stays);
    assert!(!stays || widest < 0.18, "a gap of {widest}");
}
