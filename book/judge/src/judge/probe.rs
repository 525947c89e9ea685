//! How an integrator is asked: the requests of the judge, their answers checked, and the size of
//! the integrator's own roundings.

use core::fmt;

use super::equation::Departure;
use super::verdict::{Measured, Trouble, checked, told};
use crate::integrator::{Chosen, Integrator, Reply, Request};
use pendula::AnyMethod;
use pendula::exact::Motion;
use pendula::systems::{Hamiltonian, Pendulum, Phase};

/// g/L of most requests (1/s²): not the paper's, and no power of two.
pub const G_OVER_L: f64 = 12.2625;

/// √(g/L) (rad/s).
pub fn frequency() -> f64 {
    libm::sqrt(G_OVER_L)
}

/// The step (s) of which x = ω₀h is `x`.
pub fn step(x: f64) -> f64 {
    x / frequency()
}

/// An integrator, with what has to be known of it before anything can be asked.
pub struct Probe<'s> {
    integrator: &'s dyn Integrator,
    /// The rounding of a step, relative to a state of order 1: as measured, from 2⁻⁵² to 1.
    pub rounding: f64,
    /// The same, if it could be measured.
    pub measured_rounding: Measured<f64>,
    /// What a tolerance inside the integrator makes of 200 steps (rad): by how much they differ in
    /// other units of time, where that is too little to be a mistake.
    tolerance: f64,
    /// And what it makes of a step that is long, where an iteration ends later (rad).
    in_long_steps: f64,
    /// The most steps of a request that it answers in time.
    longest: u64,
}

impl fmt::Debug for Probe<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { measured_rounding, tolerance, in_long_steps, longest, .. } = self;
        f.debug_struct("Probe")
            .field("measured_rounding", measured_rounding)
            .field("tolerance", tolerance)
            .field("in_long_steps", in_long_steps)
            .field("longest", longest)
            .finish_non_exhaustive()
    }
}

impl Request {
    /// `steps` steps of `step` (s) from `start`, of the undamped pendulum with the g/L of most
    /// requests, each state asked for.
    pub(crate) const fn run(start: Phase, step: f64, steps: u64) -> Self {
        Self::new(G_OVER_L, start, step, steps)
    }

    /// With another g/L (1/s²).
    pub(super) const fn with(self, g_over_l: f64) -> Self {
        Self { g_over_l, ..self }
    }
}

impl<'s> Probe<'s> {
    /// Ready to ask, of an integrator without a tolerance; the rounding is measured at once.
    pub fn new(integrator: &'s dyn Integrator) -> Measured<Self> {
        let longest = integrator.longest_run();
        let measured_rounding = Ok(f64::EPSILON);
        let rounding = f64::EPSILON;
        let mut probe = Self {
            integrator,
            rounding,
            measured_rounding,
            tolerance: 0.0,
            in_long_steps: 0.0,
            longest,
        };
        match probe.measure_rounding() {
            Err(Trouble::Broken(why)) => return Err(Trouble::Broken(why)),
            measured => {
                probe.measured_rounding = measured.map(|rounding| rounding.max(f64::EPSILON));
            }
        }
        // What is more than the states themselves is no rounding.
        probe.rounding = probe.measured_rounding.clone().map_or(f64::EPSILON, |x| x.min(1.0));
        if let Some(digits) = told(probe.printed_digits())?.flatten() {
            probe.rounding = probe.rounding.max(half_of_the_last(digits));
        }
        Ok(probe)
    }

    /// With how many significant digits it prints its numbers, if these are 12 to 16: fewer are
    /// told by what they make of a step, and 17 are all that a double has.
    fn printed_digits(&self) -> Measured<Option<usize>> {
        let mut numbers = Vec::new();
        for start in [Phase { theta: 0.9, omega: 0.3 }, Phase { theta: -0.7, omega: 2.1 }] {
            let states = self.states(Request::run(start, step(0.1), 10))?;
            numbers.extend(states.into_iter().flat_map(|z| [z.theta, z.omega]));
        }
        let printed = |x: f64, digits: usize| {
            format!("{x:.*e}", digits - 1).parse::<f64>().is_ok_and(|read| read == x)
        };
        // Of sixteen digits one double in two to ten is a number, of fifteen one in twenty to a
        // hundred, and never all of forty by chance.
        Ok((12..=16).find(|digits| numbers.iter().all(|x| printed(*x, *digits))))
    }

    /// What rounding makes of a pendulum at rest at the bottom in so many steps (rad): along
    /// sixteen starts beside it, as for [`Self::rounding`], at the end of the run. A program that
    /// adds something to the angle inside, as π or Ωt, rounds there as it does elsewhere; one that
    /// does not rounds in proportion to the angle, of which nothing is left.
    pub fn rounding_at_rest(&self, x: f64, steps: u64) -> Measured<f64> {
        const APART: f64 = 1e-9;
        let (mut angles, mut velocities) = (Vec::new(), Vec::new());
        for j in 0..16 {
            let start = Phase { theta: (f64::from(j) - 7.5) * APART, omega: 0.0 };
            let z = self.end(Request::run(start, step(x), steps))?;
            angles.push(z.theta);
            velocities.push(z.omega / frequency());
        }
        Ok(libm::fmaximum(noise(&angles), noise(&velocities)))
    }

    /// Of a method that is known to compute in double precision: what it rounds by more is a
    /// mistake, for which no measurement allows.
    pub fn of_doubles(self) -> Self {
        Self { rounding: self.rounding.min(4.0 * f64::EPSILON), ..self }
    }

    /// With what a tolerance inside the integrator makes of 200 steps (rad).
    pub fn with_tolerance(self, tolerance: f64) -> Self {
        Self { tolerance, ..self }
    }

    /// With what a tolerance inside the integrator makes of a long step (rad).
    pub fn with_long_steps(self, in_long_steps: f64) -> Self {
        Self { in_long_steps, ..self }
    }

    /// What a tolerance inside the integrator makes of a long step (rad).
    pub const fn in_long_steps(&self) -> f64 {
        self.in_long_steps
    }

    /// Of numbers of which digits are `cut_off`: those of order 1 round by half of the last one.
    pub fn printing(self, cut_off: Option<&Departure>) -> Self {
        let rounding = cut_off.and_then(|found| match *found {
            Departure::Digits(digits) => Some(0.5 * libm::pow(10.0, 1.0 - digits as f64)),
            Departure::Decimals(decimals) => Some(0.5 * libm::pow(10.0, -(decimals as f64))),
            _ => None,
        });
        let rounding = rounding.map_or(self.rounding, |rounding| self.rounding.max(rounding));
        Self { rounding: rounding.min(1.0), ..self }
    }

    /// As many of `steps` as it can take in time, in whole twenties; no answer if these are less
    /// than a tenth.
    pub fn in_time(&self, steps: u64) -> Measured<u64> {
        let possible = steps.min(self.longest - self.longest % 20);
        if possible < steps / 10 {
            let longest = self.longest;
            return Err(Trouble::NoAnswer(format!("only {longest} steps are possible in time")));
        }
        Ok(possible)
    }

    /// The answer to a request, as it is.
    pub fn ask(&self, request: &Request) -> Measured<Reply> {
        checked(self.integrator.answer(request)?, request.states())
    }

    /// The states of a run.
    pub fn states(&self, run: Request) -> Measured<Vec<Phase>> {
        Ok(self.ask(&run)?.states)
    }

    /// The last state of a run, which alone is asked for.
    pub fn end(&self, run: Request) -> Measured<Phase> {
        Ok(self.states(run.every(run.steps))?[0])
    }

    /// The bound for the rounding (rad) of an angle of order 1 after `steps` steps of x = ω₀h:
    /// each step rounds by [`Self::rounding`], which adds up like a random walk in the state and,
    /// since an error of the energy is one of the frequency, like its sum in the phase. The factor
    /// is what the largest of some thousand such sums may exceed their mean by.
    pub fn bound(&self, steps: u64, x: f64) -> f64 {
        self.rounding_bound(steps, x) + self.tolerance + steps as f64 * self.tolerance_a_step()
    }

    /// What a tolerance inside the integrator may make of the state in a step, relative to a state
    /// of order 1.
    pub fn tolerance_a_step(&self) -> f64 {
        self.tolerance / 200.0
    }

    /// [`Self::bound`] without what a tolerance inside the integrator may add.
    pub fn rounding_bound(&self, steps: u64, x: f64) -> f64 {
        let n = steps as f64;
        10.0 * self.rounding * libm::sqrt(n) * (1.0 + n * x.abs())
    }

    /// The rounding of a step, relative to a state of order 1.
    ///
    /// Along sixteen starts, 10⁻⁶ apart, the end of a smooth map has third differences of 10⁻²⁰;
    /// what is found beyond is rounding, of which a third difference has √20 times. (Starts that
    /// are a power of two apart would round alike in a map that only moves them.) A map that rounds
    /// more coarsely than the starts are apart would show none: so the ends must be apart as the
    /// derivative says, which a hundredth to either side tells to a thousandth.
    fn measure_rounding(&self) -> Measured<f64> {
        let mut largest = 0.0_f64;
        for start in ROUNDED_FROM {
            let ends = self.ends_along(start)?;
            let (above, below) = (self.end_beside(start, 0.01)?, self.end_beside(start, -0.01)?);
            for k in 0..2 {
                let along: Vec<f64> = ends.iter().map(|end| end[k]).collect();
                let expected = 15.0 * APART * (above[k] - below[k]) / 0.02;
                let missing = (along[15] - along[0] - expected).abs();
                for found in [noise(&along), missing - 1e-3 * expected.abs()] {
                    largest = libm::fmaximum(largest, found);
                }
            }
        }
        // States at the end of the range have differences beyond it.
        if largest.is_finite() { Ok(largest) } else { Err(Trouble::NotFinite) }
    }

    /// Whether a step rounds along all sixteen starts, as it does if numbers have few digits: the
    /// median of thirteen third differences is then about a quarter of the largest. A force with a
    /// corner, such as that of a table, makes at most four of them large, and the median is zero.
    pub fn rounds_everywhere(&self) -> Measured<bool> {
        for start in ROUNDED_FROM {
            let ends = self.ends_along(start)?;
            for k in 0..2 {
                let along: Vec<f64> = ends.iter().map(|end| end[k]).collect();
                let mut thirds: Vec<f64> = third_differences(&along).collect();
                thirds.sort_by(f64::total_cmp);
                let (median, largest) = (thirds[thirds.len() / 2], thirds[thirds.len() - 1]);
                if largest > 0.1 * self.rounding && median > 0.02 * largest {
                    return Ok(true);
                }
            }
        }
        Ok(false)
    }

    /// Where a step from beside `start` ends: the angle, and the velocity over ω₀.
    fn end_beside(&self, start: Phase, by: f64) -> Measured<[f64; 2]> {
        let start = Phase { theta: start.theta + by, ..start };
        let z = self.end(Request::run(start, step(0.1), 1))?;
        Ok([z.theta, z.omega / frequency()])
    }

    /// The same along sixteen starts.
    fn ends_along(&self, start: Phase) -> Measured<Vec<[f64; 2]>> {
        (0..16).map(|j| self.end_beside(start, f64::from(j) * APART)).collect()
    }
}

/// How far apart the starts are from which the rounding of a step is measured (rad), and the first
/// of each sixteen.
const APART: f64 = 1e-6;
const ROUNDED_FROM: [Phase; 2] =
    [Phase { theta: 0.9, omega: 0.3 }, Phase { theta: -0.7, omega: 2.1 }];

/// What is no smooth function along equally spaced starts: third differences, of which those of
/// rounding have √20 times as much.
fn noise(along: &[f64]) -> f64 {
    third_differences(along).fold(0.0, libm::fmaximum) / libm::sqrt(20.0)
}

fn third_differences(along: &[f64]) -> impl Iterator<Item = f64> {
    along.windows(4).map(|w| (w[3] - 3.0 * w[2] + 3.0 * w[1] - w[0]).abs())
}

/// Half of the last of so many significant digits, of a number of order 1.
fn half_of_the_last(digits: usize) -> f64 {
    0.5 * libm::pow(10.0, 1.0 - digits as f64)
}

/// The pendulum with this g/L (1/s²).
pub fn pendulum(g_over_l: f64) -> Pendulum {
    Pendulum::new(g_over_l, 1.0, 1.0).expect("g/L of a request of ours")
}

/// The states of a method of the library on the pendulum with this g/L (1/s²), after 1, 2, …
/// `count` steps of `h` (s); none if there are no such steps. Negative ones are those of the
/// mirrored motion.
pub fn states_after(
    method: &dyn AnyMethod,
    g_over_l: f64,
    start: Phase,
    h: f64,
    count: u64,
) -> Option<Vec<Phase>> {
    let request = Request::run(start, h, count).with(g_over_l);
    Some(Chosen::new(method).answer(&request).ok()?.states)
}

/// The energy above the bottom, in units of mgL.
pub fn energy(z: Phase) -> f64 {
    energies(&[z])[0]
}

/// That of each state.
pub fn energies(states: &[Phase]) -> Vec<f64> {
    let mut energies = vec![0.0; states.len()];
    pendulum(G_OVER_L).energies(states, &mut energies);
    energies.iter().map(|energy| energy / G_OVER_L).collect()
}

/// The exact motion from `start`.
pub fn exact(g_over_l: f64, start: Phase) -> Motion {
    Motion::new(&pendulum(g_over_l), start).expect("a finite start")
}

/// The distance of two states: max(|Δθ|, |Δω|/ω₀) (rad), NaN if one of them is.
pub fn distance(a: Phase, b: Phase) -> f64 {
    libm::fmaximum((a.theta - b.theta).abs(), (a.omega - b.omega).abs() / frequency())
}
