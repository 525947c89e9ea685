//! Three ways to choose the steps of Störmer–Verlet on a long ellipse, and what becomes of the
//! energy: as its last error asks, all equal, and by a density that is moved symmetrically.

use pendula::adaptive::SymmetricSteps;
use pendula::methods::StormerVerlet;
use pendula::{Grid, Hamiltonian, Separable, integrate_with};
use pendula_dynamics::kepler::{Kepler, Planar, PlanePhase};

/// Revolutions of the planet.
pub const REVOLUTIONS: u32 = 1000;
/// The ellipse's eccentricity; its semi-major axis is 1.
const ECCENTRICITY: f64 = 0.8;
/// The attraction μ, which is not 1, so that a forgotten μ shows.
const ATTRACTION: f64 = 2.5;
/// The symmetric step beside the centre.
const SHORTEST: f64 = 0.002;
/// With this tolerance the naive control takes about as many steps as the symmetric one.
const TOLERANCE: f64 = 4e-5;

/// How the steps are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// From the error of the last step, as in any other adaptive method.
    Naive,
    /// They are all equal.
    Equal,
    /// By a density that is moved half a step before the state and half a step after it.
    Symmetric,
}

/// A run: how far its energy has been off, and in how many steps.
#[derive(Clone, Debug)]
pub struct Run {
    /// For each of the revolutions the largest error of the energy so far, as a part of the energy.
    pub so_far: Vec<f64>,
    /// All steps.
    pub steps: u64,
}

/// A planet at its perihelion, and who watches its energy.
struct Watch {
    centre: Kepler,
    start: PlanePhase,
    year: f64,
    largest: f64,
    run: Run,
}

impl Watch {
    fn new() -> Self {
        let centre = Kepler::new(ATTRACTION).expect("an attraction");
        let fastest = ATTRACTION * (1.0 + ECCENTRICITY) / (1.0 - ECCENTRICITY);
        let start = PlanePhase { x: 1.0 - ECCENTRICITY, y: 0.0, vx: 0.0, vy: libm::sqrt(fastest) };
        let year = 2.0 * core::f64::consts::PI / libm::sqrt(ATTRACTION);
        Self { centre, start, year, largest: 0.0, run: Run { so_far: Vec::new(), steps: 0 } }
    }

    fn duration(&self) -> f64 {
        f64::from(REVOLUTIONS) * self.year
    }

    fn see(&mut self, t: f64, z: PlanePhase) {
        let whole = self.run.so_far.len() + 1;
        if t > whole as f64 * self.year && whole <= REVOLUTIONS as usize {
            self.run.so_far.push(self.largest);
        }
        let error = self.centre.energy(z) / self.centre.energy(self.start) - 1.0;
        self.largest = self.largest.max(error.abs());
        self.run.steps += 1;
    }

    fn end(mut self) -> Run {
        self.run.so_far.resize(REVOLUTIONS as usize, self.largest);
        self.run
    }
}

/// The run with steps that are chosen so.
pub fn run(control: Control) -> Run {
    match control {
        Control::Naive => naive(),
        Control::Equal => equal(symmetric().steps),
        Control::Symmetric => symmetric(),
    }
}

/// The estimate is h² times the change of the force in a step, by which its positions differ from
/// those of a method of order 1; as it is proportional to h³, the next step is longer by the cube
/// root of tolerance over estimate.
fn naive() -> Run {
    let mut watch = Watch::new();
    let (centre, mut z) = (watch.centre, watch.start);
    let (mut t, mut h) = (0.0, 1e-3);
    let mut force = centre.force(t, z);
    while t < watch.duration() {
        z = centre.drift(centre.kick(z, force, 0.5 * h), h);
        let next: Planar = centre.force(t + h, z);
        z = centre.kick(z, next, 0.5 * h);
        t += h;
        watch.see(t, z);
        let error = h * h * libm::hypot(next.x - force.x, next.y - force.y);
        h *= libm::cbrt(TOLERANCE / error).clamp(0.5, 2.0);
        force = next;
    }
    watch.end()
}

fn equal(steps: u64) -> Run {
    let mut watch = Watch::new();
    let (centre, start) = (watch.centre, watch.start);
    let grid = Grid::new(watch.duration() / steps as f64, steps).expect("a positive step");
    integrate_with(&centre, &StormerVerlet, start, &grid, &mut |_: u64, t: f64, z| watch.see(t, z));
    watch.end()
}

/// Steps in proportion to r^(3/2), the time of a free fall into the centre: ln σ grows at the rate
/// (3/2) q·v/r².
fn symmetric() -> Run {
    let mut watch = Watch::new();
    let (centre, start) = (watch.centre, watch.start);
    let rate = |z: PlanePhase| -1.5 * (z.x * z.vx + z.y * z.vy) / (z.x * z.x + z.y * z.y);
    let steps = SymmetricSteps::new(&centre, start, SHORTEST, rate).expect("a positive step");
    for sample in steps {
        let sample = sample.expect("a positive density");
        if sample.t > watch.duration() {
            break;
        }
        watch.see(sample.t, sample.z);
    }
    watch.end()
}
