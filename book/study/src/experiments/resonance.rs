//! Step-size resonances: the largest energy error against the number of steps a period.
//!
//! Where a numerical swing takes a whole number of steps, each swing meets the steps at the same
//! phases, and what the steps do to the energy adds up from swing to swing. The half swings are
//! mirror images, and so is what the steps do in them: if the number is odd, the second half swing
//! takes back what the first one gave, up to terms that are much smaller. So resonances show at
//! even numbers.
//!
//! Islands of the standard map (Chirikov, *Physics Reports* 52 (1979) 263), for any symplectic
//! method.

use pendula::exact::period;
use pendula::{Grid, Pendulum, Phase};

use super::{MethodRef, largest_energy_error};
use crate::theory;

/// The angle of release (rad).
pub const THETA_0: f64 = 1.0;
/// Swings of each run.
pub const SWINGS: u64 = 400;
/// From how many to how many steps a period.
pub const STEPS: (f64, f64) = (5.0, 12.5);
/// The whole numbers of steps a swing with a resonance, as far as they are in [`STEPS`].
pub const EVEN: [u32; 4] = [6, 8, 10, 12];

const PENDULUM: Pendulum = Pendulum::PAPER;

/// The step (s) of which `steps` make an exact period.
fn step(steps: f64) -> f64 {
    period(&PENDULUM, THETA_0).expect("a finite angle") / steps
}

/// The number of steps to an exact period with which a numerical swing takes `count` steps, by the
/// method's relative change of the period, `tau` h².
///
/// ```
/// use pendula::Pendulum;
/// use pendula_study::{experiments::resonance, theory::period::of_stormer_verlet};
///
/// // Störmer–Verlet's period is too short, so that six of its steps make less than a period.
/// let tau = of_stormer_verlet(&Pendulum::PAPER, resonance::THETA_0);
/// assert!((6.2..6.3).contains(&resonance::place(6, tau)));
/// assert_eq!(resonance::place(6, 0.0), 6.0);
/// ```
pub fn place(count: u32, tau: f64) -> f64 {
    // With h = T/s the numerical period is T (1 + τT²/s²), and count steps are as long: s² + τT² =
    // count s. Of the two roots that near `count`.
    let count = f64::from(count);
    let shift = tau * step(1.0) * step(1.0);
    0.5 * (count + libm::sqrt(count * count - 4.0 * shift))
}

/// The change of the period of a method of the figure, over h² (1/s²). That of a method of order 6
/// is 0 here: it is of order h⁶, and moves no place by as much as 1e-6.
pub fn tau(method: MethodRef) -> f64 {
    match method.info().order {
        2 => theory::period::of_stormer_verlet(&PENDULUM, THETA_0),
        _ => 0.0,
    }
}

/// The largest energy error (J) over [`SWINGS`] exact periods, with `steps` steps to a period.
pub fn largest_error(method: MethodRef, steps: f64) -> f64 {
    largest_energy_error(method, THETA_0, &grid(steps))
}

/// How far an orbit is, after each numerical swing of `count` steps, from where it would be if it
/// took just as many steps: the largest angle in phase space (turns) over [`SWINGS`] periods, with
/// `steps` steps to an exact period. Less than half the distance of two samples, 1/(2 count), where
/// the orbit is locked to the step; otherwise it grows with time.
pub fn slip(method: MethodRef, steps: f64, count: u32) -> f64 {
    let rate = PENDULUM.small_angle_frequency();
    let turn = core::f64::consts::TAU;
    let (mut turned, mut last, mut largest) = (0.0, 0.0, 0.0_f64);
    method.run(
        &PENDULUM,
        Phase::at_rest(THETA_0),
        &grid(steps),
        &mut |n: u64, _: f64, z: Phase| {
            let angle = -libm::atan2(z.omega / rate, z.theta) / turn;
            // The turn since the last sample, between 0 and 1.
            let step = angle - last;
            turned += step - libm::floor(step);
            last = angle;
            if n.is_multiple_of(count.into()) {
                largest = largest.max((turned - (n / u64::from(count)) as f64).abs());
            }
        },
    );
    largest
}

fn grid(steps: f64) -> Grid {
    Grid::new(step(steps), (SWINGS as f64 * steps) as u64).expect("a positive step")
}

/// Pairs of the number of steps a period and the largest energy error (J): ten to a unit, and
/// closer and closer towards the places of the resonances.
pub fn line(method: MethodRef) -> Vec<(f64, f64)> {
    let (from, to) = STEPS;
    let even = (0..).map(|i| from + 0.1 * f64::from(i)).take_while(|s| *s <= to);
    let offsets = || (0..=12).map(|k| 0.4 * libm::exp10(-f64::from(k) / 6.0));
    let near = EVEN.into_iter().flat_map(|count| {
        let place = place(count, tau(method));
        offsets().flat_map(move |d| [place - d, place + d])
    });
    let mut ladder: Vec<f64> = even.chain(near).filter(|s| (from..=to).contains(s)).collect();
    ladder.sort_by(f64::total_cmp);
    ladder.into_iter().map(|steps| (steps, largest_error(method, steps))).collect()
}
