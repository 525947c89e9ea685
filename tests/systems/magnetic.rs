//! A charge in a magnetic field, whose force depends on the velocity: what velocity Verlet loses,
//! and Boris's rotation, which loses nothing.

use approx::{assert_abs_diff_eq, assert_relative_eq};
use pendula::methods::{BlanesMoan6, BlanesMoanSrkn6b, Dop853, StormerVerlet};
use pendula::{Grid, Method, Separable, System, integrate};
use pendula_dynamics::kepler::{Planar, PlanePhase};
use rstest::rstest;

/// A magnetic field across the plane, and an electric one in it. Neither turning nor pull is 1, so
/// that a missing factor shows.
#[derive(Clone, Copy, Debug)]
struct Field {
    /// How much the magnetic field varies; 0 for the same everywhere.
    varying: f64,
    /// The pull of the electric field to the origin (1/s²), twice as hard along y.
    pull: f64,
}

const VARYING: Field = Field { varying: 1.0, pull: 0.7 };

/// The rate at which the field turns velocities where it does not vary (rad/s).
const TURNING: f64 = 1.5;

const START: PlanePhase = PlanePhase { x: 0.3, y: -0.2, vx: 0.7, vy: 0.4 };

impl Field {
    /// The rate at which velocities turn here (rad/s): 0.8 to 2.2.
    fn turning(&self, z: PlanePhase) -> f64 {
        TURNING + self.varying * (0.4 * z.x.sin() - 0.3 * z.y.cos())
    }

    fn electric(&self, z: PlanePhase) -> Planar {
        Planar { x: -self.pull * z.x, y: -2.0 * self.pull * z.y }
    }

    /// The acceleration at the position of `z`, with the velocity of `with`.
    fn acceleration(&self, z: PlanePhase, with: PlanePhase) -> Planar {
        let (turning, electric) = (self.turning(z), self.electric(z));
        Planar { x: electric.x + turning * with.vy, y: electric.y - turning * with.vx }
    }
}

impl System for Field {
    type State = PlanePhase;

    fn rate(&self, _t: f64, z: PlanePhase) -> PlanePhase {
        let Planar { x, y } = self.acceleration(z, z);
        PlanePhase { x: z.vx, y: z.vy, vx: x, vy: y }
    }
}

fn kicked(z: PlanePhase, force: Planar, h: f64) -> PlanePhase {
    PlanePhase { vx: z.vx + force.x * h, vy: z.vy + force.y * h, ..z }
}

fn drifted(z: PlanePhase, h: f64) -> PlanePhase {
    PlanePhase { x: z.x + z.vx * h, y: z.y + z.vy * h, ..z }
}

/// The velocity turned clockwise.
fn turned(z: PlanePhase, (cos, sin): (f64, f64)) -> PlanePhase {
    PlanePhase { vx: cos * z.vx + sin * z.vy, vy: cos * z.vy - sin * z.vx, ..z }
}

/// Velocity Verlet, as it is often written: both forces with the velocity before the step.
fn velocity_verlet(field: &Field, h: f64, old: PlanePhase) -> PlanePhase {
    let half = kicked(old, field.acceleration(old, old), 0.5 * h);
    let there = drifted(half, h);
    kicked(there, field.acceleration(there, old), 0.5 * h)
}

/// Half a drift; half the electric kick, the rotation by ψ with tan(ψ/2) = Ωh/2, and the other half
/// (Boris 1970); half a drift.
fn boris(field: &Field, h: f64, z: PlanePhase) -> PlanePhase {
    let middle = drifted(z, 0.5 * h);
    let (electric, t) = (field.electric(middle), 0.5 * h * field.turning(middle));
    let (cos, sin) = ((1.0 - t * t) / (1.0 + t * t), 2.0 * t / (1.0 + t * t));
    let turned = turned(kicked(middle, electric, 0.5 * h), (cos, sin));
    drifted(kicked(turned, electric, 0.5 * h), 0.5 * h)
}

/// A force that reads the velocity, against the rule of [`Separable::force`].
struct Reading(Field);

impl System for Reading {
    type State = PlanePhase;

    fn rate(&self, t: f64, z: PlanePhase) -> PlanePhase {
        self.0.rate(t, z)
    }
}

impl Separable for Reading {
    type Force = Planar;

    fn force(&self, _t: f64, z: PlanePhase) -> Planar {
        self.0.acceleration(z, z)
    }

    fn kick(&self, z: PlanePhase, force: Planar, h: f64) -> PlanePhase {
        kicked(z, force, h)
    }

    fn drift(&self, z: PlanePhase, h: f64) -> PlanePhase {
        drifted(z, h)
    }
}

/// The magnetic field alone, with a kick that rotates: the exact motion of the velocity while the
/// position is held, as the kick of a pendulum with friction is.
struct Rotating(Field);

impl System for Rotating {
    type State = PlanePhase;

    fn rate(&self, t: f64, z: PlanePhase) -> PlanePhase {
        self.0.rate(t, z)
    }
}

impl Separable for Rotating {
    type Force = f64;

    fn force(&self, _t: f64, z: PlanePhase) -> f64 {
        self.0.turning(z)
    }

    fn kick(&self, z: PlanePhase, turning: f64, h: f64) -> PlanePhase {
        turned(z, ((turning * h).cos(), (turning * h).sin()))
    }

    fn drift(&self, z: PlanePhase, h: f64) -> PlanePhase {
        drifted(z, h)
    }
}

/// The end of a run of a method of the library.
fn end<S: System<State = PlanePhase>>(
    system: &S,
    method: &impl Method<S>,
    steps: u32,
) -> PlanePhase {
    let grid = Grid::new(DURATION / f64::from(steps), steps.into()).unwrap();
    integrate(system, method, START, &grid)
}

/// A turn, and no whole number of them (s).
const DURATION: f64 = 4.7;

/// Both slopes of the error at the end as the steps are halved twice, against DOP853 in steps whose
/// error is rounding.
fn orders(field: &Field, steps: u32, run: impl Fn(u32) -> PlanePhase) -> [f64; 2] {
    let right = end(field, &Dop853, 1000);
    let error = |steps: u32| {
        let off = run(steps) + right * -1.0;
        (off.x * off.x + off.y * off.y + off.vx * off.vx + off.vy * off.vy).sqrt()
    };
    let [rough, half, quarter] = [1, 2, 4].map(|times| error(times * steps));
    [(rough / half).log2(), (half / quarter).log2()]
}

/// The next term of an error is smaller by Ωh, or by its square where the method is symmetric, and
/// changes a slope by some times this: with Ωh ≤ 2.2 · 4.7/1000 of velocity Verlet's steps and
/// (2.2 · 4.7/60)² of the others, a slope is off by 0.03 times a number below 1.
const SLOPE_TOLERANCE: f64 = 0.03;

/// Catches: velocity Verlet taken for a method of order 2 where the force reads the velocity, with
/// the old one in both forces or with that of the half step; a cosine and a sine of Boris's that
/// are not those of one angle, half a drift with the other velocity.
#[test]
fn boris_has_order_two_and_velocity_verlet_one() {
    let steps = |step: fn(&Field, f64, PlanePhase) -> PlanePhase, steps: u32| {
        (0..steps).fold(START, |z, _| step(&VARYING, DURATION / f64::from(steps), z))
    };
    let old = orders(&VARYING, 1000, |n| steps(velocity_verlet, n));
    let half = orders(&VARYING, 1000, |n| end(&Reading(VARYING), &StormerVerlet, n));
    let rotation = orders(&VARYING, 100, |n| steps(boris, n));
    for (slopes, order) in [(old, 1.0), (half, 1.0), (rotation, 2.0)] {
        for slope in slopes {
            assert_abs_diff_eq!(slope, order, epsilon = SLOPE_TOLERANCE);
        }
    }
}

/// The determinant of a step: the factor of a small volume of positions and velocities.
fn volume(step: impl Fn(PlanePhase) -> PlanePhase) -> f64 {
    const DELTA: f64 = 1e-5;
    let unit = |k: usize| {
        let [x, y, vx, vy] = [0, 1, 2, 3].map(|i| if i == k { DELTA } else { 0.0 });
        PlanePhase { x, y, vx, vy }
    };
    let mut columns = [0, 1, 2, 3].map(|k| {
        let change = step(START + unit(k)) + step(START + unit(k) * -1.0) * -1.0;
        [change.x, change.y, change.vx, change.vy].map(|change| change / (2.0 * DELTA))
    });
    // Gauss's elimination; the steps are so short that the pivots are near 1.
    let mut volume = 1.0;
    for k in 0..4 {
        volume *= columns[k][k];
        for j in k + 1..4 {
            let share = columns[j][k] / columns[k][k];
            columns[j] = [0, 1, 2, 3].map(|i| columns[j][i] - share * columns[k][i]);
        }
    }
    volume
}

/// Central differences with δ = 1e-5: rounding ε/δ = 2e-11 in each of sixteen elements, δ²/6 =
/// 2e-11 times third derivatives below 1; a margin of 10.
const VOLUME_TOLERANCE: f64 = 4e-10;

/// Catches: a rotation by a cosine and a sine that are not those of one angle; a field at another
/// place than that of the kick; velocity Verlet that posed as a method that keeps either.
#[test]
fn boris_keeps_the_speed_and_the_volume() {
    let h = 0.3;
    assert_abs_diff_eq!(volume(|z| boris(&VARYING, h, z)), 1.0, epsilon = VOLUME_TOLERANCE);
    // Without an electric field it is the speed that is kept. Of 10 000 long steps each rounds it
    // by less than 4ε: that of the two quotients, of the products and of the sums.
    let magnetic = Field { pull: 0.0, ..VARYING };
    let speed = |z: PlanePhase| z.vx.hypot(z.vy);
    let end = (0..10_000).fold(START, |z, _| boris(&magnetic, 0.5, z));
    assert_relative_eq!(speed(end), speed(START), max_relative = 1e-11);
    // In a field that does not vary, velocity Verlet multiplies small areas of velocities by 1 +
    // (Ωh)², and the speed by the root of that.
    let even = Field { varying: 0.0, pull: 0.0 };
    let growth = 1.0 + TURNING * TURNING * h * h;
    assert_abs_diff_eq!(
        volume(|z| velocity_verlet(&even, h, z)),
        growth,
        epsilon = VOLUME_TOLERANCE
    );
    let end = (0..100).fold(START, |z, _| velocity_verlet(&even, h, z));
    assert_relative_eq!(speed(end), speed(START) * growth.powi(50), max_relative = 1e-12);
}

/// The orders are those with friction: Blanes–Moan 6 is made for kicks that do not depend on the
/// velocity.
///
/// Catches: a half kick that is left out or taken whole by a splitting method; a kick by the force
/// of the step before.
#[rstest]
#[case(StormerVerlet, 2.0)]
#[case(BlanesMoanSrkn6b, 4.0)]
#[case(BlanesMoan6, 4.0)]
fn a_kick_that_rotates_suits_the_methods_of_kicks_and_drifts(
    #[case] method: impl Method<Rotating>,
    #[case] order: f64,
) {
    let field = Field { pull: 0.0, ..VARYING };
    for slope in orders(&field, 60, |n| end(&Rotating(field), &method, n)) {
        assert_abs_diff_eq!(slope, order, epsilon = SLOPE_TOLERANCE);
    }
}
