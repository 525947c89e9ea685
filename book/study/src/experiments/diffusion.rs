//! What becomes of Störmer–Verlet's orbits at steps so long that it is the standard map beyond its
//! last curve: islands hold some, others wander, and some are carried off.

use core::f64::consts::TAU;
use core::num::NonZeroU64;

use pendula::methods::StormerVerlet;
use pendula::metrics::EnergyDrift;
use pendula::{AnyMethod, Ensemble, Grid, Info, Observer, Pendulum, Phase, method_named};

use super::standard_map::step;

/// The parameters K = (g/L) h² of the standard map: below its last curve at 0.971635, above it, and
/// one with an accelerator mode, an island in which u grows by 2π a step.
pub const PARAMETERS: [f64; 6] = [0.5, 0.9, 1.5, 2.0, 3.0, 6.9];
/// The steps of the two orbits.
pub const STEPS: u64 = 1_000_000;
/// Starts a rounding apart, for each of the two orbits: in the chaotic sea each goes its own way.
pub const NEIGHBOURS: u32 = 8;
/// The steps of the spread, and its starts a side of the square of the phase plane.
pub const SPREAD: (u64, u32) = (2000, 100);

/// What becomes of orbits at one K.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// K = (g/L) h².
    pub k: f64,
    /// The largest energy error (J) over [`STEPS`] steps from rest at 1 rad, or one of the next
    /// angles above it, [`NEIGHBOURS`] in all: the least of them and the greatest. `None` if an
    /// orbit escapes: if it turns by more than 2π a step, to where no curve of small u bars its
    /// way.
    pub from_1_rad: Option<[f64; 2]>,
    /// The same from rest at 3 rad.
    pub from_3_rad: Option<[f64; 2]>,
    /// The mean square of u − u₀ after the steps of [`SPREAD`], over K²n/2: 1 if each kick were
    /// random. The starts are spread evenly over a square of the phase plane.
    pub spread: f64,
}

/// A row for each parameter.
pub fn run() -> Vec<Row> {
    PARAMETERS
        .map(|k| Row {
            k,
            from_1_rad: largest_errors(k, 1.0),
            from_3_rad: largest_errors(k, 3.0),
            spread: spread(k),
        })
        .to_vec()
}

/// See [`Row::from_1_rad`].
fn largest_errors(k: f64, theta_0: f64) -> Option<[f64; 2]> {
    let angles = core::iter::successors(Some(theta_0), |theta| Some(theta.next_up()));
    let starts: Vec<Phase> = angles.take(NEIGHBOURS as usize).map(Phase::at_rest).collect();
    let grid = Grid::new(step(k), STEPS).expect("a positive step");
    let staying =
        |_| Staying { drift: EnergyDrift::new(&Pendulum::PAPER), step: grid.step(), stays: true };
    let mut orbits: Vec<Staying> = starts.iter().map(staying).collect();
    Ensemble::new(&Pendulum::PAPER, &starts, grid).watch(method(), NonZeroU64::MIN, &mut orbits);
    let errors = orbits.iter().map(|orbit| orbit.drift.largest());
    let band = errors.fold([f64::INFINITY, 0.0], |[least, greatest]: [f64; 2], error| {
        [least.min(error), greatest.max(error)]
    });
    orbits.iter().all(|orbit| orbit.stays).then_some(band)
}

/// Störmer–Verlet, with its steps in lanes.
fn method() -> &'static dyn AnyMethod {
    method_named(StormerVerlet.info().name).expect("a method of the library")
}

/// The energy of an orbit until it escapes.
struct Staying {
    drift: EnergyDrift<'static, Pendulum>,
    step: f64,
    stays: bool,
}

impl Observer<Phase> for Staying {
    fn observe(&mut self, n: u64, t: f64, z: Phase) {
        self.drift.observe(n, t, z);
        self.stays &= (z.omega * self.step).abs() <= TAU;
    }

    fn is_satisfied(&self) -> bool {
        !self.stays
    }
}

/// The starts (θ, u) of [`spread`]: the middles of `side` × `side` cells of the square of the phase
/// plane, from 0 to 2π each way.
fn starts(side: u32) -> impl Iterator<Item = (f64, f64)> {
    let at = move |i: u32| TAU * (f64::from(i) + 0.5) / f64::from(side);
    (0..side * side).map(move |i| (at(i / side), at(i % side)))
}

/// See [`Row::spread`].
fn spread(k: f64) -> f64 {
    let (steps, side) = SPREAD;
    let h = step(k);
    let starts: Vec<Phase> = starts(side).map(|(theta, u)| Phase { theta, omega: u / h }).collect();
    let grid = Grid::new(h, steps).expect("a positive step");
    let mut ends = starts.clone();
    Ensemble::new(&Pendulum::PAPER, &starts, grid).ends(method(), &mut ends);
    let change = |(z, end): (&Phase, &Phase)| (end.omega - z.omega) * h;
    let squares: f64 = starts.iter().zip(&ends).map(change).map(|du| du * du).sum();
    squares / (starts.len() as f64 * 0.5 * k * k * steps as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With steps of 1/4 s, a power of two.
    ///
    /// Catches: half a turn a step, or two, for one; the velocity in rad/s taken for that in rad a
    /// step; a rotation to one side that never escapes; an orbit that comes back.
    #[test]
    fn an_orbit_escapes_at_more_than_a_turn_a_step() {
        let stays = |turns: &[f64]| {
            let drift = EnergyDrift::new(&Pendulum::PAPER);
            let mut watch = Staying { drift, step: 0.25, stays: true };
            for (n, turns) in (0..).zip(turns) {
                watch.observe(n, 0.0, Phase { theta: 0.0, omega: 4.0 * TAU * turns });
            }
            assert_eq!(watch.is_satisfied(), !watch.stays);
            watch.stays
        };
        assert!(stays(&[0.0, 0.51, -0.99, 1.0, -1.0]));
        for beyond in [1.0_f64.next_up(), -1.01, 3.0] {
            assert!(!stays(&[0.0, beyond, 0.0]), "{beyond}");
        }
    }

    /// Catches: a square of half the side, or one about the bottom; cells whose corners are taken,
    /// so that some starts are at rest upside down.
    #[test]
    fn the_starts_are_the_middles_of_cells() {
        let turns =
            |side| starts(side).map(|(theta, u)| (theta / TAU, u / TAU)).collect::<Vec<_>>();
        assert_eq!(turns(1), [(0.5, 0.5)]);
        assert_eq!(turns(2), [(0.25, 0.25), (0.25, 0.75), (0.75, 0.25), (0.75, 0.75)]);
    }
}
