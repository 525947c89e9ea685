//! The error of a step as a series in the step: which of its first terms should vanish and do not.
//!
//! With time in units of 1/ω₀ the pendulum is θ̈ = α(θ), α = −sin θ. A step of any method that is
//! made of evaluations of α has the same terms as the exact motion, with factors of its own: ω and
//! α at h, α and α̇ = α′ω at h², and so on (Hairer, Lubich and Wanner, Geometric Numerical
//! Integration, III.1, for the terms as trees; III.2 where angle and velocity are treated apart).
//! A method is of order p if the factors up to hᵖ are those of the exact motion.

use super::probe::{G_OVER_L, Probe, exact};
use super::series::{self, least_squares};
use super::verdict::Measured;
use crate::integrator::Request;
use pendula::systems::Phase;

/// The powers of the step that are looked at: 1 to 4.
pub const POWERS: usize = 4;

/// A term of the series.
#[derive(Debug)]
pub struct Term {
    /// Its name, in h, α and derivatives of α by the angle.
    pub name: &'static str,
    /// Which of the two it adds to: the angle θ (0) or the velocity ω (1).
    pub of: usize,
    /// Its value at (θ, ω/ω₀), but for hᵏ.
    value: fn(f64, f64) -> f64,
    /// Its factor in the exact motion.
    pub exact: f64,
    /// The sum over the coefficients of a Runge–Kutta method that has to be right for this factor,
    /// the value that it has to have, in words, and by how much it exceeds the factor.
    pub condition: Option<(&'static str, &'static str, f64)>,
}

const fn term(
    name: &'static str,
    of: usize,
    exact: f64,
    value: fn(f64, f64) -> f64,
    condition: Option<(&'static str, &'static str, f64)>,
) -> Term {
    Term { name, of, value, exact, condition }
}

fn sin(theta: f64) -> f64 {
    libm::sin(theta)
}

fn cos(theta: f64) -> f64 {
    libm::cos(theta)
}

/// The terms of h, h², h³ and h⁴. Where a tree has an angle's and a velocity's part, the condition
/// stands at both.
pub const TERMS: [&[Term]; POWERS] = [
    &[
        term("h ω", 0, 1.0, |_, q| q, Some(("Σ bᵢ", "1", 1.0))),
        term("h α", 1, 1.0, |t, _| -sin(t), Some(("Σ bᵢ", "1", 1.0))),
    ],
    &[
        term("h² α", 0, 1.0 / 2.0, |t, _| -sin(t), Some(("Σ bᵢ cᵢ", "1/2", 1.0))),
        term("h² α′ω", 1, 1.0 / 2.0, |t, q| -cos(t) * q, Some(("Σ bᵢ cᵢ", "1/2", 1.0))),
    ],
    &[
        term("h³ α′ω", 0, 1.0 / 6.0, |t, q| -cos(t) * q, Some(("Σ bᵢ aᵢⱼ cⱼ", "1/6", 1.0))),
        term("h³ α′α", 1, 1.0 / 6.0, |t, _| cos(t) * sin(t), Some(("Σ bᵢ aᵢⱼ cⱼ", "1/6", 1.0))),
        term("h³ α″ω²", 1, 1.0 / 6.0, |t, q| sin(t) * q * q, Some(("Σ bᵢ cᵢ²", "1/3", 2.0))),
    ],
    &[
        term("h⁴ α″ω²", 0, 1.0 / 24.0, |t, q| sin(t) * q * q, Some(("Σ bᵢ aᵢⱼ cⱼ²", "1/12", 2.0))),
        term(
            "h⁴ α′α",
            0,
            1.0 / 24.0,
            |t, _| cos(t) * sin(t),
            Some(("Σ bᵢ aᵢⱼ aⱼₖ cₖ", "1/24", 1.0)),
        ),
        term("h⁴ α‴ω³", 1, 1.0 / 24.0, |t, q| cos(t) * q * q * q, Some(("Σ bᵢ cᵢ³", "1/4", 6.0))),
        term(
            "h⁴ α″αω",
            1,
            1.0 / 8.0,
            |t, q| -sin(t) * sin(t) * q,
            Some(("Σ bᵢ cᵢ aᵢⱼ cⱼ", "1/8", 1.0)),
        ),
        term(
            "h⁴ α′²ω",
            1,
            1.0 / 24.0,
            |t, q| cos(t) * cos(t) * q,
            Some(("Σ bᵢ aᵢⱼ aⱼₖ cₖ", "1/24", 1.0)),
        ),
    ],
];

/// The lowest power of the step at which a factor is not that of the exact motion.
#[derive(Clone, Debug, PartialEq)]
pub struct Deviation {
    /// The power k of hᵏ, from 1.
    pub power: usize,
    /// By how much the factors exceed those of the exact motion, term by term.
    pub excess: Vec<f64>,
    /// What they are known to.
    pub known_to: f64,
}

/// Angle (rad) and velocity over ω₀ of the starts: none where a term vanishes at all of them.
pub const STARTS: [[f64; 2]; 6] =
    [[1.0, 0.5], [-0.7, 1.1], [2.1, -0.4], [0.4, -1.3], [-1.6, -0.8], [2.7, 0.9]];

/// The number of steps by which a series is told.
const NODES: usize = 12;
/// The longest of them, in units of 1/ω₀. A series is told the better by longer steps, as far as
/// its first terms suffice; what they leave out is seen by comparing one length with the next.
const LONGEST: [f64; 5] = [0.6, 0.42, 0.3, 0.2, 0.14];

/// The lowest power of the step, up to h⁴, with a factor that is not that of the exact motion;
/// `None` if there is none, or none can be told from rounding and from terms of other kinds.
pub fn deviation(probe: &Probe<'_>) -> Measured<Option<Deviation>> {
    deviation_with(probe, G_OVER_L, STARTS)
}

/// The same at another g/L (1/s²) and other starts, (θ, ω/ω₀).
pub fn deviation_with(
    probe: &Probe<'_>,
    g_over_l: f64,
    starts: [[f64; 2]; 6],
) -> Measured<Option<Deviation>> {
    let told = LONGEST.map(|longest| coefficients(probe, g_over_l, starts, longest));
    let told = told.into_iter().collect::<Measured<Vec<_>>>()?;
    for power in 1..=POWERS {
        let terms = TERMS[power - 1];
        let columns = columns(terms, starts);
        let fitted = |all: &Coefficients| least_squares(&columns, &all.by_power[power - 1]);
        let fits: Vec<Vec<f64>> = told.iter().map(fitted).collect();
        // The larger of what two lengths disagree by, and ten times what rounding may make; at the
        // length at which that is least.
        let known_to = |k: usize| {
            let pairs = fits[k].iter().zip(&fits[k + 1]);
            let apart = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            (3.0 * apart).max(10.0 * told[k].noise[power - 1])
        };
        let best = (0..LONGEST.len() - 1).min_by(|a, b| known_to(*a).total_cmp(&known_to(*b)));
        let best = best.expect("there are several");
        let (excess, known_to) = (fits[best].clone(), known_to(best));
        let largest = excess.iter().map(|x| x.abs()).fold(0.0, f64::max);
        if largest <= known_to {
            continue;
        }
        // A step that is not made of evaluations of α has other terms.
        let left = series::residual(&columns, &excess, &told[best].by_power[power - 1]);
        let explained = left <= (1e-3 * largest).max(known_to) && largest > 30.0 * known_to;
        return Ok(explained.then_some(Deviation { power, excess, known_to }));
    }
    Ok(None)
}

/// The coefficients of the error of a step: of x, x², x³ and x⁴, at each start in θ and ω/ω₀.
struct Coefficients {
    by_power: [Vec<f64>; POWERS],
    /// What rounding may make of them.
    noise: [f64; POWERS],
}

fn coefficients(
    probe: &Probe<'_>,
    g_over_l: f64,
    starts: [[f64; 2]; 6],
    longest: f64,
) -> Measured<Coefficients> {
    let frequency = libm::sqrt(g_over_l);
    let nodes = series::nodes::<NODES>(longest);
    let weights = weights(&nodes);
    // A state of up to 3 rad, and the end of the exact motion beside it, are rounded.
    let rounding = 8.0 * probe.rounding;
    let noise = weights.map(|row| row.iter().map(|w| rounding * w.abs()).sum());
    let mut by_power: [Vec<f64>; POWERS] = Default::default();
    for [theta, q] in starts {
        let start = Phase { theta, omega: q * frequency };
        let truth = exact(g_over_l, start);
        let mut sums = [[0.0; 2]; POWERS];
        for (i, x) in nodes.into_iter().enumerate() {
            let h = x / frequency;
            let (end, there) = (probe.end(Request::run(start, h, 1).with(g_over_l))?, truth.at(h));
            let error = [end.theta - there.theta, (end.omega - there.omega) / frequency];
            for (sum, row) in sums.iter_mut().zip(&weights) {
                for part in 0..2 {
                    sum[part] += row[i] * error[part];
                }
            }
        }
        for (all, sum) in by_power.iter_mut().zip(sums) {
            all.extend(sum);
        }
    }
    Ok(Coefficients { by_power, noise })
}

/// Weights of the values at the nodes whose sums are the coefficients of x, x², x³ and x⁴ of the
/// polynomial through them that vanishes at 0: x times the one through the values over x.
fn weights(nodes: &[f64; NODES]) -> [[f64; NODES]; POWERS] {
    let mut weights = series::weights::<NODES, POWERS>(nodes);
    for row in &mut weights {
        for (weight, node) in row.iter_mut().zip(nodes) {
            *weight /= node;
        }
    }
    weights
}

/// The value of a term in both parts, (θ, ω/ω₀), at a start.
fn at(term: &Term, [theta, q]: [f64; 2], part: usize) -> f64 {
    if term.of == part { (term.value)(theta, q) } else { 0.0 }
}

/// The values of the terms at the starts, in both parts.
fn columns(terms: &[Term], starts: [[f64; 2]; 6]) -> Vec<Vec<f64>> {
    let places = || starts.iter().flat_map(|start| [(*start, 0), (*start, 1)]);
    let column = |term| places().map(|(start, part)| at(term, start, part)).collect();
    terms.iter().map(column).collect()
}

impl Deviation {
    /// Whether two excesses are one number.
    fn same(&self, a: f64, b: f64) -> bool {
        (a - b).abs() <= 1e-3 * a.abs().max(b.abs()) + self.known_to
    }

    /// Whether the factors can be those of a Runge–Kutta method, which treats angle and velocity
    /// alike: a tree that has a part in both has one factor.
    pub fn is_runge_kutta(&self) -> bool {
        let e = &self.excess;
        match self.power {
            1..=3 => self.same(e[0], e[1]),
            _ => self.same(e[1], e[4]),
        }
    }

    /// Whether the factors are those of a Hamiltonian, so that the commutators of kick and drift
    /// explain them.
    pub fn commutators(&self) -> Option<&'static str> {
        let e = &self.excess;
        match self.power {
            2 if self.same(e[0], -e[1]) => Some("the commutators [T, V]"),
            3 if self.same(e[0], -2.0 * e[2]) => {
                Some("the commutators [T, [T, V]] and [V, [T, V]]")
            }
            _ => None,
        }
    }

    /// The term whose factor is off by most, in parts of the exact factor, and by how much.
    pub fn worst(&self) -> (&'static Term, f64, f64) {
        let terms = TERMS[self.power - 1].iter().zip(&self.excess);
        let parts = |term: &Term, excess: f64| (excess / term.exact).abs();
        let largest = terms.clone().map(|(term, excess)| parts(term, *excess)).fold(0.0, f64::max);
        // Of several that are off by the same, the first.
        let mut those = terms.filter(|(term, excess)| parts(term, **excess) >= 0.999 * largest);
        let (term, excess) = those.next().expect("one is the largest");
        (term, *excess, parts(term, *excess))
    }
}
