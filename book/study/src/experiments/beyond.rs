//! Beyond the paper: results for the damped and driven, the shaken and the double pendulum, and
//! for a planet.
//!
//! These are experiments of our own. [`Study::run`](super::Study::run) does not include them; each
//! is a function that takes a fraction of a second.

use core::f64::consts::{PI, SQRT_2};

use pendula::methods::{Rk4, StormerVerlet};
use pendula::metrics::CrossingPeriod;
use pendula::systems::{DoublePendulum, DoublePhase, Driven, Joint, Mathieu, Shaken};
use pendula::{Grid, Observer, Pendulum, Phase, integrate_with};
use pendula_dynamics::floquet::{PeriodicOrbit, contraction, monodromy};
use pendula_dynamics::kepler::{Ellipse, Kepler, PlanePhase};
use pendula_dynamics::lyapunov::Watch;
use pendula_dynamics::{
    Exponent, Stroboscope, largest_exponent, mode_shapes, period_doubling, periodic_orbit, root,
};

use crate::digits::Digits;
use crate::theory::other_systems::{a0, b1, verlet_precession};

// -------------------------------------------------------------------------------------------------
// The driven pendulum
// -------------------------------------------------------------------------------------------------

/// Steps a period for finding an orbit. RK4's error there is O(h⁴), and with twice as many steps
/// the drives of [`doublings`] move by 3e-11.
pub const FINE: u64 = 1000;
/// Steps a period where only the statistics of a chaotic motion count.
pub const COARSE: u64 = 100;

/// A drive at which an orbit of Taylor's pendulum doubles its period.
#[derive(Clone, Copy, Debug)]
pub struct Doubling {
    /// The drive strength γ.
    pub strength: f64,
    /// The orbit, of which one multiplier is −1.
    pub orbit: PeriodicOrbit,
}

/// The first two period doublings of [Taylor's pendulum](Driven::taylor), from period 1 to 2 and
/// from 2 to 4.
pub fn doublings() -> [Doubling; 2] {
    // A period 1 orbit attracts at the lower end of the first bracket, a period 2 orbit at that of
    // the second.
    [(1, (1.06, 1.07)), (2, (1.077, 1.080))].map(|(periods, bracket)| {
        doubling(periods, bracket, FINE).expect("a doubling in each bracket")
    })
}

/// The drive in `bracket` at which the orbit of `periods` periods doubles its period, found with
/// `steps` steps a period.
pub fn doubling(periods: u32, bracket: (f64, f64), steps: u64) -> Option<Doubling> {
    let near = attractor(&Driven::taylor(bracket.0).ok()?);
    let orbit = |strength, near| {
        let driven = Driven::taylor(strength).ok()?;
        periodic_orbit(&seen(&driven, steps), near, periods)
    };
    let mut last = near;
    let followed = |strength, near| {
        let orbit = orbit(strength, near)?;
        last = orbit.point;
        Some(orbit)
    };
    let strength = period_doubling(followed, near, bracket, 10)?;
    Some(Doubling { strength, orbit: orbit(strength, last)? })
}

/// `driven` sampled once a period, which has `steps` steps of RK4.
pub fn seen(driven: &Driven, steps: u64) -> Stroboscope<'_, Driven, Rk4> {
    Stroboscope::new(driven, &Rk4, driven.period(), steps).expect("a period and its steps")
}

/// The state of the pendulum 200 periods after its release at −π/2, with its angle in [−π, π).
///
/// From there it comes to the orbits that double their period. From the bottom it may come, at γ =
/// 1.077, to one of three periods instead (Taylor, Sect. 12.4), and which of the two is a matter of
/// the last digit.
pub fn attractor(driven: &Driven) -> Phase {
    let strobe = seen(driven, COARSE);
    let start = Phase::at_rest(-core::f64::consts::FRAC_PI_2);
    wrapped((0..200).fold(start, |z, _| strobe.map(z)))
}

/// The same state with its angle in [−π, π).
fn wrapped(z: Phase) -> Phase {
    Phase { theta: z.theta - 2.0 * PI * libm::floor((z.theta + PI) / (2.0 * PI)), ..z }
}

/// A drive at which Taylor's pendulum is chaotic (his Sect. 12.5).
pub const CHAOTIC: f64 = 1.105;

/// The largest Lyapunov exponent (1/s) of Taylor's pendulum at [`CHAOTIC`] drive, over 2000 periods
/// after the first 100.
pub fn lyapunov() -> Exponent {
    let driven = Driven::taylor(CHAOTIC).expect("a drive");
    let watch = Watch::new(100, 40, 50).expect("blocks");
    largest_exponent(&seen(&driven, COARSE), Phase::default(), watch)
}

/// The Poincaré section of Taylor's strange attractor, γ = 1.5 and β = ω₀/8: `points` states, one
/// a period, after the first 100; angles in [−π, π).
pub fn poincare(points: usize) -> Vec<Phase> {
    let driven = Driven::taylor_damped(1.5, 0.125).expect("a drive");
    let strobe = seen(&driven, COARSE);
    let states = core::iter::successors(Some(Phase::default()), |z| Some(wrapped(strobe.map(*z))));
    states.skip(100).take(points).collect()
}

/// The drives of [`road_to_chaos`].
pub const DRIVES: [f64; 2] = [1.06, 1.09];

/// The drive γ and the angle (rad) of the pendulum of [`Driven::taylor`], seen `seen` times once a
/// period of the drive, at `drives` strengths from the least of [`DRIVES`] to the largest. Each run
/// begins where the last ended, and settles for 150 periods.
pub fn road_to_chaos(drives: u32, seen: usize) -> Vec<(f64, f64)> {
    let mut z = Phase::at_rest(-PI / 2.0);
    let [least, largest] = DRIVES;
    let strengths =
        (0..drives).map(|k| least + (largest - least) * f64::from(k) / f64::from(drives - 1));
    let mut dots = Vec::new();
    for strength in strengths {
        let driven = Driven::taylor(strength).expect("a drive");
        let strobe = self::seen(&driven, COARSE);
        for n in 0..150 + seen {
            z = wrapped(strobe.map(z));
            if n >= 150 {
                dots.push((strength, z.theta));
            }
        }
    }
    dots
}

// -------------------------------------------------------------------------------------------------
// The shaken pendulum
// -------------------------------------------------------------------------------------------------

/// The two boundaries between which the upright position is stable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Boundary {
    /// Shaken less, it falls over: a multiplier is 1, the trace 2.
    Falling,
    /// Shaken more, it rocks ever wider, to and fro in two periods: a multiplier is −1, the trace
    /// −2.
    Rocking,
}

/// The amplitude of the pivot (m) at which the upright `pendulum` loses its stability, shaken at
/// the angular `frequency` Ω (rad/s), with `steps` steps of RK4 a period; `None` below some Ω,
/// where no shaking holds it.
///
/// The search is between a fifth of Kapitza's √(2gL)/Ω and 0.4 L for falling, and between 0.4 L
/// and 0.6 L for rocking.
pub fn upright(pendulum: &Pendulum, frequency: f64, boundary: Boundary, steps: u64) -> Option<f64> {
    let kapitza = libm::sqrt(2.0 * pendulum.gravity() * pendulum.length()) / frequency;
    let middle = 0.4 * pendulum.length();
    let (multiplier, low, high) = match boundary {
        Boundary::Falling => (1.0, 0.2 * kapitza, middle),
        Boundary::Rocking => (-1.0, middle, 1.5 * middle),
    };
    let distance = |amplitude| {
        let shaken = Shaken::new(*pendulum, amplitude, frequency).ok()?;
        let strobe = Stroboscope::new(&shaken, &Rk4, shaken.period(), steps).ok()?;
        let (_, monodromy) = monodromy(&strobe, Phase::at_rest(PI), 1);
        Some(monodromy.characteristic(multiplier))
    };
    root(distance, low, high)
}

/// On the boundary where Mathieu's parameter is `q`, in units that fit every pendulum: the angular
/// frequency Ω/ω₀ and the amplitude a/L; `None` for a `q` at which it is not reached.
pub fn mathieu_boundary(boundary: Boundary, q: f64) -> Option<(f64, f64)> {
    // −4g/(LΩ²).
    let a = match boundary {
        Boundary::Falling => a0(q),
        Boundary::Rocking => b1(q),
    };
    (a < 0.0).then(|| (2.0 / libm::sqrt(-a), 0.5 * q))
}

/// The largest angle from the upright (rad) in 30 s after a release at rest 0.05 rad from it, by
/// Störmer–Verlet in 100 steps a period of the pivot.
pub fn farthest(shaken: &Shaken) -> f64 {
    let step = shaken.period() / 100.0;
    let grid = Grid::new(step, (30.0 / step) as u64).expect("a positive step");
    let mut farthest = 0.0_f64;
    integrate_with(
        shaken,
        &StormerVerlet,
        Phase::at_rest(PI - 0.05),
        &grid,
        &mut |_, _, z: Phase| {
            farthest = farthest.max((z.theta - PI).abs());
        },
    );
    farthest
}

/// A pendulum set upright on a shaken pivot.
#[derive(Clone, Copy, Debug)]
pub struct Trial {
    /// The angular frequency Ω/ω₀ of the pivot.
    pub frequency: f64,
    /// Its amplitude a/L.
    pub amplitude: f64,
    /// Whether it remains within 0.2 rad of the upright, four times as far as it begins.
    pub stands: bool,
}

/// The paper's pendulum, shaken at ten frequencies from 3 ω₀ to 21 ω₀ by ten amplitudes up to 0.6
/// L. None is nearer to a boundary than 0.005 L.
pub fn trials() -> Vec<Trial> {
    let pendulum = Pendulum::PAPER;
    let slow = libm::sqrt(pendulum.frequency_squared());
    let trial = |frequency, amplitude| {
        let shaken = Shaken::new(pendulum, amplitude * pendulum.length(), frequency * slow);
        let stands = farthest(&shaken.expect("a shaking")) < 0.2;
        Trial { frequency, amplitude, stands }
    };
    let frequencies = (1..=10).map(|i| f64::from(2 * i + 1));
    let amplitudes = |frequency| (1..=10).map(move |i| trial(frequency, 0.06 * f64::from(i)));
    frequencies.flat_map(amplitudes).collect()
}

// -------------------------------------------------------------------------------------------------
// The double pendulum
// -------------------------------------------------------------------------------------------------

/// The angular frequency (rad/s) of a swing of `double` from rest at θ₁ = `theta1` and θ₂ = θ₁
/// times the `shape`, over 20 s in steps of 1 ms of RK4: the mean of the crossings of θ₁ = 0.
pub fn swing_frequency(double: &DoublePendulum, theta1: f64, shape: f64) -> Option<f64> {
    let start = double.start([theta1, theta1 * shape], [0.0; 2]).ok()?;
    let grid = Grid::new(0.001, 20_000).ok()?;
    let mut period = CrossingPeriod::default();
    integrate_with(double, &Rk4, start, &grid, &mut |n, t, z: DoublePhase| {
        let [omega, _] = double.velocities(z);
        period.observe(n, t, Phase { theta: z.theta1, omega });
    });
    Some(2.0 * PI / period.period()?)
}

/// Two equal joints of 1 m and 1 kg under the paper's gravity.
pub fn equals() -> DoublePendulum {
    let joint = Joint { length: 1.0, mass: 1.0 };
    DoublePendulum::of_equals(Pendulum::PAPER.gravity(), joint).expect("parameters in range")
}

/// The distance √(Δθ₁² + Δθ₂²) (rad) against time (s) of two starts from rest, one at the angles
/// `theta` (rad) and one with its upper angle larger by `nudge` (rad), at the times of [`path`].
pub fn separation(
    double: &DoublePendulum,
    theta: [f64; 2],
    nudge: f64,
    grid: (f64, u64),
) -> Vec<(f64, f64)> {
    let path = |theta1| path(double, [theta1, theta[1]], grid);
    let (one, other) = (path(theta[0]), path(theta[0] + nudge));
    let apart = |((t, a), (_, b)): ((f64, DoublePhase), (f64, DoublePhase))| {
        let (upper, lower) = (a.theta1 - b.theta1, a.theta2 - b.theta2);
        (t, libm::sqrt(upper * upper + lower * lower))
    };
    one.into_iter().zip(other).map(apart).collect()
}

/// The motion of `double` from rest at the angles `theta` (rad): every tenth of `steps` steps of
/// `step` (s) of RK4, each with its time (s).
pub fn path(
    double: &DoublePendulum,
    theta: [f64; 2],
    (step, steps): (f64, u64),
) -> Vec<(f64, DoublePhase)> {
    let grid = Grid::new(step, steps).expect("a positive step");
    let start = double.start(theta, [0.0; 2]).expect("finite angles");
    let mut path = Vec::new();
    integrate_with(double, &Rk4, start, &grid, &mut |n, t, z: DoublePhase| {
        if n % 10 == 0 {
            path.push((t, z));
        }
    });
    path
}

// -------------------------------------------------------------------------------------------------
// The planet
// -------------------------------------------------------------------------------------------------

/// The angle (rad) by which Störmer–Verlet turns the pericentre of `ellipse` about `centre` in a
/// revolution of `steps` steps: the mean over 20 revolutions, from apocentre to apocentre, where
/// the direction is steadiest.
pub fn precession(centre: &Kepler, ellipse: &Ellipse, steps: u64) -> f64 {
    // In long steps a revolution takes longer than a period.
    let grid = Grid::new(ellipse.period() / steps as f64, 22 * steps).expect("a positive step");
    let mut apocentres = Vec::new();
    // r · v at the sample before.
    let mut before = 0.0;
    integrate_with(centre, &StormerVerlet, ellipse.at(0.0), &grid, &mut |_, _, z: PlanePhase| {
        let receding = z.x * z.vx + z.y * z.vy;
        if before > 0.0 && receding <= 0.0 {
            let towards = centre.eccentricity(z);
            apocentres.push(libm::atan2(towards.y, towards.x));
        }
        before = receding;
    });
    (apocentres[20] - apocentres[0]) / 20.0
}

/// `revolutions` revolutions of Störmer–Verlet about `centre`, of `steps` steps each, that begin at
/// the apocentre of `ellipse`. The energy of its steps is nearly right there, so that it stays as
/// large as the ellipse.
pub fn turning(
    centre: &Kepler,
    ellipse: &Ellipse,
    steps: u64,
    revolutions: u64,
) -> Vec<PlanePhase> {
    let period = ellipse.period();
    let grid = Grid::new(period / steps as f64, steps * revolutions).expect("a positive step");
    let mut states = Vec::new();
    let start = ellipse.at(0.5 * period);
    integrate_with(centre, &StormerVerlet, start, &grid, &mut |_, _, z| states.push(z));
    states
}

// -------------------------------------------------------------------------------------------------
// All of it
// -------------------------------------------------------------------------------------------------

/// A quantity as found, and its known value.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// The quantity, with its unit.
    pub quantity: &'static str,
    /// What theory or literature says, and in how many digits.
    pub known: Option<(f64, Digits)>,
    /// What the library finds.
    pub found: f64,
    /// Its standard error, where it is a mean.
    pub error: Option<(f64, Digits)>,
    /// As many digits as can be defended.
    pub format: Digits,
    /// The source of the known value.
    pub source: &'static str,
}

/// The quantities of this file, one row each.
pub fn rows() -> Vec<Row> {
    [driven().as_slice(), &[upright_falls()], &double_modes(), &[kepler()]].concat()
}

/// A quantity whose known value has as many digits as what is found.
const fn row(
    quantity: &'static str,
    format: Digits,
    known: f64,
    found: f64,
    source: &'static str,
) -> Row {
    Row { quantity, known: Some((known, format)), found, error: None, format, source }
}

fn driven() -> [Row; 4] {
    let [first, second] = doublings();
    let contraction = contraction(&Driven::taylor(first.strength).expect("a drive"));
    let exponent = lyapunov();
    let taylor = |quantity, known, found: Doubling| Row {
        known: Some((known, Digits::Fixed(4))),
        ..row(quantity, Digits::Fixed(9), known, found.strength, "Taylor (2005), Table 12.1")
    };
    [
        taylor("Driven: γ₁ of the first period doubling", 1.0663, first),
        taylor("Driven: γ₂ of the second period doubling", 1.0793, second),
        row(
            "Driven: determinant of the monodromy matrix at γ₁",
            Digits::Fixed(8),
            contraction,
            first.orbit.monodromy.determinant(),
            "exp(−2β · 2π/Ω), Liouville",
        ),
        Row {
            quantity: "Driven: largest Lyapunov exponent at γ = 1.105 (1/s)",
            known: None,
            found: exponent.value,
            error: Some((exponent.error, Digits::Fixed(2))),
            // Another rounding of one sine leads to another motion, whose mean agrees only within
            // the error bar.
            format: Digits::Fixed(2),
            source: "positive: chaos",
        },
    ]
}

fn upright_falls() -> Row {
    let (pendulum, frequency) = (Pendulum::PAPER, 100.0);
    let amplitude = |boundary| upright(&pendulum, frequency, boundary, FINE);
    let falling = amplitude(Boundary::Falling).expect("fast shaking holds it");
    let kapitza = |amplitude: f64| {
        let speed = amplitude * frequency;
        speed * speed / (2.0 * pendulum.gravity() * pendulum.length())
    };
    let mathieu = |amplitude| {
        let Mathieu { a, q } = Shaken::new(pendulum, amplitude, frequency).ok()?.mathieu();
        Some(a - a0(q))
    };
    let boundary = root(mathieu, 0.5 * falling, 2.0 * falling).expect("Mathieu's boundary");
    row(
        "Shaken at 100 rad/s: (aΩ)²/(2gL) where the upright falls",
        Digits::Fixed(8),
        kapitza(boundary),
        kapitza(falling),
        "a₀(2a/L) = −4g/(LΩ²), Mathieu; 1 for Ω → ∞, Kapitza",
    )
}

fn double_modes() -> [Row; 2] {
    let (pendulum, double) = (Pendulum::PAPER, equals());
    let square = |frequency: f64| frequency * frequency * pendulum.length() / pendulum.gravity();
    let [slow, fast] = mode_shapes(&double).map(|shape| {
        square(swing_frequency(&double, 1e-5, shape).expect("a swing crosses the bottom"))
    });
    [
        row("Double: ω² L/g of the slow mode", Digits::Fixed(6), 2.0 - SQRT_2, slow, "2 − √2"),
        row("Double: ω² L/g of the fast mode", Digits::Fixed(6), 2.0 + SQRT_2, fast, "2 + √2"),
    ]
}

fn kepler() -> Row {
    let centre = Kepler::new(1.0).expect("an attraction");
    let ellipse = Ellipse::new(&centre, 1.0, 0.5).expect("an ellipse");
    row(
        "Kepler: precession per revolution of 1000 steps of Störmer–Verlet at e = 0.5 (rad)",
        Digits::Scientific(3),
        verlet_precession(&ellipse, ellipse.period() / FINE as f64),
        precession(&centre, &ellipse, FINE),
        "−(π/8)(nh)² (4 + e²)/(1 − e²)³",
    )
}
