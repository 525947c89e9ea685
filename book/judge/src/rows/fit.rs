//! Pairs of rows as equations, and the fit of an equation of motion by a method's map.
//!
//! Row i is z = ẑ + δ, where the program had ẑ and its printing rounded by |δ| ≤ u, half a unit
//! of the last digit. The program's map takes ẑ of a row to ẑ' of another, so that
//!
//! z' − M(z) = δ' − J δ, and |z' − M(z)| ≤ u' + |J| u + ρ,
//!
//! entry by entry, where J is M's derivative over a way of δ, taken as the larger of both sides'
//! differences at ±u. ρ is for the rounding of doubles: each step adds at most ε (w + 4) of the
//! size of what it adds up, w being the sum of the sizes of its coefficients; an error of the angle
//! becomes one of the velocity, k times the time as large, and one of the velocity one of the
//! angle. How far off a pair is is told in units of this bound: at most 1, if method and equation
//! are right.

use std::sync::LazyLock;

use super::candidates::{Candidate, Equation, Equations, State, States, named};
use super::lanes::Four;
use super::report::Force;

/// The rows that are compared: good ones, in their order.
#[derive(Clone, Debug, Default)]
pub struct Data {
    /// The time at place 0 (s).
    pub start: f64,
    /// From place to place (s).
    pub spacing: f64,
    /// What that is known to (s).
    pub spacing_known_to: f64,
    /// Whether places follow each other evenly.
    pub even: bool,
    /// The number of each row in the table, from 0.
    pub row: Vec<usize>,
    /// The place of each row.
    pub at: Vec<i64>,
    /// The time of each row.
    pub t: Vec<f64>,
    /// Half a unit of its last digit, where times are not even (s).
    pub half_t: f64,
    /// Angles and velocities; the latter empty, if there are none.
    pub theta: Vec<f64>,
    /// Velocities.
    pub omega: Vec<f64>,
    /// Half a unit of the last digit.
    pub half_theta: Vec<f64>,
    /// Half a unit of the last digit.
    pub half_omega: Vec<f64>,
    /// Whether the program computed in single precision.
    pub single: bool,
}

/// Rows i, i + lag and, without velocities, i + 2 lag.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// Indices of rows in the data.
    pub rows: [usize; 3],
    /// How many places lie between two of them.
    pub lag: u32,
}

/// Whose map leads from row to row.
#[derive(Clone, Copy, Debug)]
pub enum Map {
    /// The exact motion.
    Exact,
    /// So many steps of a candidate from place to place.
    Steps(&'static Candidate, u32),
}

/// A method of several steps has so many older states at most.
const MOST_OLDER: usize = 7;

/// The numbers that are fitted: k, c, the spacing as a factor, a, b and Ω.
pub const NUMBERS: usize = 6;
/// Which of them are.
pub type Active = [bool; NUMBERS];

/// A fit.
#[derive(Clone, Copy, Debug)]
pub struct Fit {
    /// Whose map.
    pub map: Map,
    /// The equation.
    pub equation: Equation,
    /// The spacing as a factor of that of the rows.
    pub stretch: f64,
    /// The mean square of how far off the pairs are, its root.
    pub mean: f64,
    /// The worst of them.
    pub worst: f64,
    /// What each number is known to.
    pub known_to: [f64; NUMBERS],
}

impl Fit {
    /// How many older states its map needs beside the newest.
    pub fn older(&self) -> usize {
        self.map.older()
    }
}

impl Map {
    fn older(&self) -> usize {
        match self {
            Self::Steps(candidate, _) => candidate.older(),
            Self::Exact => 0,
        }
    }
}

impl Data {
    /// Whether there are velocities.
    pub fn has_velocities(&self) -> bool {
        !self.omega.is_empty()
    }

    /// The row at so many places after row i.
    fn after(&self, i: usize, lag: u32) -> Option<usize> {
        if !self.even {
            let j = i + lag as usize;
            return (j < self.row.len() && self.at[j] == self.at[i] + i64::from(lag)).then_some(j);
        }
        let place = self.at[i] + i64::from(lag);
        let guess = i + lag as usize;
        if self.at.get(guess) == Some(&place) {
            return Some(guess);
        }
        self.at[i..].binary_search(&place).ok().map(|j| i + j)
    }

    /// Whether the rows before row i follow each other, as many as any method needs.
    pub fn has_past(&self, i: usize) -> bool {
        i >= MOST_OLDER && self.at[i] - self.at[i - MOST_OLDER] == MOST_OLDER as i64
    }

    /// The pair that begins with row i.
    pub fn pair(&self, i: usize, lag: u32) -> Option<Pair> {
        let j = self.after(i, lag)?;
        let k = if self.has_velocities() { j } else { self.after(j, lag)? };
        Some(Pair { rows: [i, j, k], lag })
    }

    /// At most so many pairs, spread evenly over the rows; always the first.
    pub fn pairs(&self, lag: u32, most: usize) -> Vec<Pair> {
        let rows = self.row.len();
        if rows <= most {
            return (0..rows).filter_map(|i| self.pair(i, lag)).collect();
        }
        let last =
            rows.saturating_sub(1 + lag as usize * if self.has_velocities() { 1 } else { 2 });
        // By fractions that are no rows, so that a drive's or a swing's own period is not hit.
        let at = |i: usize| (i as f64 * last as f64 / (most.max(2) - 1) as f64) as usize;
        (0..most).filter_map(|i| self.pair(at(i), lag)).collect()
    }

    fn span(&self, pair: &Pair, second: bool) -> f64 {
        let [i, j, k] = pair.rows;
        let (a, b) = if second { (j, k) } else { (i, j) };
        if self.even { f64::from(pair.lag) * self.spacing } else { self.t[b] - self.t[a] }
    }

    fn time(&self, i: usize) -> f64 {
        if self.even { self.start + self.at[i] as f64 * self.spacing } else { self.t[i] }
    }

    /// The steps of the exact motion (rad): so short that their error is below a hundredth of the
    /// digits. Of steps of 0.15 it is below rounding, and it goes with the ninth power.
    fn exactly(&self) -> f64 {
        let half = self.half_theta.first().copied().unwrap_or(0.0);
        if half < 1e-11 {
            0.15
        } else if half < 1e-8 {
            0.3
        } else {
            0.5
        }
    }

    /// How many numbers a pair has.
    pub fn entries(&self) -> usize {
        if self.has_velocities() { 2 } else { 1 }
    }
}

/// A map on given data, with numbers that are known.
#[derive(Clone, Copy)]
pub struct Applied<'a> {
    /// The rows.
    pub data: &'a Data,
    /// The map.
    pub map: Map,
    /// The equation.
    pub equation: Equation,
    /// The factor of the spacing.
    pub stretch: f64,
}

/// Spans that lead from rows to rows, of four pairs or fewer.
#[derive(Clone, Copy)]
struct Way {
    t: Four,
    span: Four,
    /// 0 of those that are no pairs.
    lag: [u32; 4],
}

/// What each of four pairs or fewer has; the last has it more than once.
fn of_each(pairs: &[Pair], f: impl Fn(&Pair) -> f64) -> Four {
    Four(core::array::from_fn(|lane| f(&pairs[lane.min(pairs.len() - 1)])))
}

impl Applied<'_> {
    /// The state after a span, from a time.
    pub fn advance(&self, t: f64, z: State, span: f64, lag: u32) -> State {
        let [t, span, q, p] = [t, span, z[0], z[1]].map(|x| Four([x; 4]));
        let [q, p] = self.advance_four(&Way { t, span, lag: [lag, 0, 0, 0] }, [q, p]);
        [q.0[0], p.0[0]]
    }

    fn advance_four(&self, way: &Way, z: States) -> States {
        let span = way.span * self.stretch;
        let equations = Equations::of([self.equation; 4]);
        match self.map {
            Map::Exact => {
                let most = way.lag.map(|lag| if lag > 0 { MOST_EXACT } else { 0.0 });
                exact_four(&equations, way.t, z, span, self.data.exactly(), most)
            }
            Map::Steps(candidate, steps) => {
                let steps = way.lag.map(|lag| steps * lag);
                let count = Four(steps.map(|steps| f64::from(steps.max(1))));
                candidate.run_four(&equations, way.t, z, span / count, steps)
            }
        }
    }

    /// From the first row of each to its second, or from that to the third.
    fn way(&self, pairs: &[Pair], second: bool) -> Way {
        let lag = |lane: usize| pairs.get(lane).map_or(0, |pair| pair.lag);
        Way {
            t: of_each(pairs, |pair| self.data.time(pair.rows[usize::from(second)])),
            span: of_each(pairs, |pair| self.data.span(pair, second)),
            lag: core::array::from_fn(lag),
        }
    }

    /// The velocity with which a row's angle becomes the next's, by Newton's method.
    pub fn velocity(&self, pair: &Pair) -> Option<f64> {
        let [i, j, _] = pair.rows;
        let [from, to] = [i, j].map(|i| Four([self.data.theta[i]; 4]));
        let [omega, ..] = self.velocities(&[*pair], from, to).0;
        omega.is_finite().then_some(omega)
    }

    /// The same of four pairs or fewer; NaN where there is none.
    #[expect(clippy::needless_range_loop, reason = "a lane is an entry of several arrays")]
    fn velocities(&self, pairs: &[Pair], from: Four, to: Four) -> Four {
        let mut way = self.way(pairs, false);
        let mut omega = (to - from) / way.span;
        let size: [f64; 4] =
            core::array::from_fn(|lane| libm::fmax(from.0[lane].abs(), to.0[lane].abs()));
        // Two angles on the way up and down again may be the same.
        let scale = Four(core::array::from_fn(|lane| {
            let least = libm::fmax(size[lane], 1e-3) / way.span.0[lane].abs();
            libm::fmax(omega.0[lane].abs(), least)
        }));
        let mut slope = Four::default();
        for round in 0..12 {
            let [end, _] = self.advance_four(&way, [from, omega]);
            // The angle is nearly linear in the velocity: one slope serves some rounds.
            if round % 4 == 0 {
                let d = scale * 1e-6;
                slope = (self.advance_four(&way, [from, omega + d])[0] - end) / d;
            }
            let change = (to - end) / slope;
            for lane in 0..4 {
                if way.lag[lane] == 0 {
                    continue;
                }
                // A map's own rounding.
                let steps = match self.map {
                    Map::Exact => 20,
                    Map::Steps(_, steps) => steps * way.lag[lane],
                };
                let rounding = 4.0 * f64::EPSILON * libm::sqrt(f64::from(steps));
                let (change, slope) = (change.0[lane], slope.0[lane]);
                if !change.is_finite() || change.abs() > 100.0 * scale.0[lane] {
                    omega.0[lane] = f64::NAN;
                    way.lag[lane] = 0;
                    continue;
                }
                omega.0[lane] += change;
                if change.abs() <= rounding * (size[lane] / slope.abs() + omega.0[lane].abs()) {
                    way.lag[lane] = 0;
                }
            }
            if way.lag == [0; 4] {
                break;
            }
        }
        omega
    }

    /// What the last rows of four pairs or fewer would be, if their first were shifted; of a method
    /// of several steps one of the rows before.
    fn predict(&self, pairs: &[Pair], which: usize, shift: States) -> States {
        let data = self.data;
        let older = self.map.older();
        let theta = |n: usize| of_each(pairs, |pair| data.theta[pair.rows[n]]);
        if data.has_velocities() {
            if let Map::Steps(candidate, steps) = self.map
                && older > 0
            {
                return self.of_older(candidate, steps, older, pairs, (which, shift));
            }
            let omega = of_each(pairs, |pair| data.omega[pair.rows[0]]);
            return self
                .advance_four(&self.way(pairs, false), [theta(0) + shift[0], omega + shift[1]]);
        }
        if older > 0 {
            return [Four([f64::NAN; 4]); 2];
        }
        let (from, to) = (theta(0) + shift[0], theta(1) + shift[1]);
        let omega = self.velocities(pairs, from, to);
        let [_, middle] = self.advance_four(&self.way(pairs, false), [from, omega]);
        self.advance_four(&self.way(pairs, true), [to, middle])
    }

    /// The older states are the rows before, where steps are rows.
    fn of_older(
        &self,
        candidate: &Candidate,
        steps: u32,
        older: usize,
        pairs: &[Pair],
        (which, shift): (usize, States),
    ) -> States {
        let data = self.data;
        let follow = |pair: &Pair| {
            let i = pair.rows[0];
            steps == 1 && i >= older && data.at[i] - data.at[i - older] == older as i64
        };
        let mut past = [[Four::default(); 2]; MOST_OLDER + 1];
        for (n, z) in past[..=older].iter_mut().enumerate() {
            *z = [&data.theta, &data.omega].map(|xs| {
                of_each(pairs, |pair| if follow(pair) { xs[pair.rows[0] - n] } else { f64::NAN })
            });
        }
        past[which] = [past[which][0] + shift[0], past[which][1] + shift[1]];
        let h = Four([data.spacing * self.stretch; 4]);
        let equations = Equations::of([self.equation; 4]);
        let way = self.way(pairs, false);
        let mut end = past[0];
        for n in 0..way.lag.into_iter().max().unwrap_or(0) {
            let t = way.t + h * f64::from(n);
            let next = candidate.step_four_from(&equations, t, &past[..=older], h);
            past.copy_within(0..older, 1);
            past[0] = next;
            for lane in (0..4).filter(|&lane| n < way.lag[lane]) {
                (0..2).for_each(|i| end[i].0[lane] = next[i].0[lane]);
            }
        }
        end
    }

    /// By how much the last row of a pair differs from what it would be.
    pub fn residual(&self, pair: &Pair) -> [f64; 2] {
        let pairs = [*pair];
        let [theta, omega] = self.left(&pairs, self.predict(&pairs, 0, NOT_SHIFTED));
        [theta.0[0], omega.0[0]]
    }

    fn left(&self, pairs: &[Pair], predicted: States) -> States {
        let data = self.data;
        let theta = of_each(pairs, |pair| data.theta[pair.rows[2]]) - predicted[0];
        if !data.has_velocities() {
            return [theta, Four::default()];
        }
        [theta, of_each(pairs, |pair| data.omega[pair.rows[2]]) - predicted[1]]
    }

    /// The bounds of that, as they are derived above, about what is predicted.
    fn bound(&self, pairs: &[Pair], here: States) -> States {
        let data = self.data;
        let halves: [Four; 2] = if data.has_velocities() {
            [&data.half_theta, &data.half_omega].map(|xs| of_each(pairs, |pair| xs[pair.rows[0]]))
        } else {
            [0, 1].map(|n| of_each(pairs, |pair| data.half_theta[pair.rows[n]]))
        };
        let span = |pair: &Pair| data.span(pair, false).abs();
        let velocity = |pair: &Pair| {
            let [i, j, k] = pair.rows;
            if data.has_velocities() {
                libm::fmax(data.omega[i].abs(), data.omega[k].abs())
            } else {
                ((data.theta[j] - data.theta[i]) / span(pair)).abs()
            }
        };
        let size = |pair: &Pair| {
            let [i, _, k] = pair.rows;
            libm::fmax(data.theta[i].abs(), data.theta[k].abs())
        };
        let of_angle = |pair: &Pair| libm::fmax(size(pair), span(pair) * velocity(pair));
        let of_velocity = |pair: &Pair| libm::fmax(velocity(pair), 1e-3 * size(pair) / span(pair));
        let mut sizes = [of_each(pairs, of_angle); 2];
        if data.has_velocities() {
            sizes[1] = of_each(pairs, of_velocity);
        }
        let own = |xs: &[f64]| of_each(pairs, |pair| xs.get(pair.rows[2]).copied().unwrap_or(0.0));
        let mut bound = [own(&data.half_theta), own(&data.half_omega)];
        for (which, entry) in (0..=self.map.older()).flat_map(|which| [(which, 0), (which, 1)]) {
            let halves: [f64; 4] = halves[entry].0;
            if halves == [0.0; 4] {
                continue;
            }
            // Over the way that rounding may go, if doubles show it.
            let way = Four(core::array::from_fn(|lane| {
                libm::fmax(halves[lane], 3e-8 * sizes[entry].0[lane])
            }));
            let mut shift = NOT_SHIFTED;
            shift[entry] = way;
            let above = self.predict(pairs, which, shift);
            shift[entry] = way * -1.0;
            let below = self.predict(pairs, which, shift);
            for at in 0..2 {
                for lane in (0..4).filter(|&lane| halves[lane] != 0.0) {
                    let [above, here, below] = [above, here, below].map(|z| z[at].0[lane]);
                    let slope = libm::fmax((above - here).abs(), (here - below).abs());
                    bound[at].0[lane] += slope * halves[lane] / way.0[lane];
                }
            }
        }
        let epsilon = if data.single { f64::from(f32::EPSILON) } else { f64::EPSILON };
        let k = self.equation.rate() * self.equation.rate();
        for (lane, pair) in pairs.iter().enumerate() {
            let (steps, weight) = match self.map {
                Map::Exact => (20.0, 8.0),
                Map::Steps(candidate, steps) => {
                    // Of coefficients that cancel more is lost: no more is allowed for.
                    (f64::from(steps * pair.lag), libm::fmin(candidate.weight, 20.0) + 4.0)
                }
            };
            let (size, velocity) = (size(pair), velocity(pair));
            let time = f64::from(pair.lag) * data.spacing;
            let of_one = epsilon * steps * weight;
            let acceleration = k * libm::fmin(1.0, size);
            let theta = of_one * (size + time * velocity / steps);
            let omega = of_one * (velocity + time * acceleration / steps);
            bound[0].0[lane] += theta + time * omega + 2.0 * data.half_t * velocity;
            bound[1].0[lane] += omega + time * k * theta + 2.0 * data.half_t * acceleration;
            if !data.has_velocities() {
                // The velocity that is found carries the rounding of both angles.
                bound[0].0[lane] += 4.0 * theta;
            }
        }
        bound
    }

    /// The numbers of all pairs, one entry after the other, by four pairs at a time.
    fn entries(&self, pairs: &[Pair], of: impl Fn(&[Pair]) -> States) -> Vec<f64> {
        let entries = self.data.entries();
        let mut all = Vec::with_capacity(entries * pairs.len());
        for pairs in pairs.chunks(4) {
            let z = of(pairs);
            all.extend((0..entries * pairs.len()).map(|n| z[n % entries].0[n / entries]));
        }
        all
    }
}

const NOT_SHIFTED: States = [Four([0.0; 4]); 2];

static FINE: LazyLock<&'static Candidate> =
    LazyLock::new(|| named("dormand-prince-8").expect("a method of the tables"));

/// More steps of the exact motion from row to row are a fit that is lost, at a force that no rows
/// have.
pub const MOST_EXACT: f64 = 300.0;

/// The exact motion of one: steps of order 8 of so many radians, but no more than so many.
pub fn exact(equation: &Equation, t: f64, z: State, span: f64, length: f64, most: f64) -> State {
    let equations = Equations::of([*equation; 4]);
    let [t, span, q, p] = [t, span, z[0], z[1]].map(|x| Four([x; 4]));
    let [q, p] = exact_four(&equations, t, [q, p], span, length, [most, 0.0, 0.0, 0.0]);
    [q.0[0], p.0[0]]
}

/// The exact motion of each.
pub fn exact_four(
    equations: &Equations,
    t: Four,
    z: States,
    span: Four,
    length: f64,
    most: [f64; 4],
) -> States {
    let mut steps = [0; 4];
    let mut h = span;
    for lane in 0..4 {
        let speed = libm::fmax(equations.one(lane).rate(), 0.3 * z[1].0[lane].abs());
        let count = libm::fmax(libm::ceil(span.0[lane].abs() * speed / length), 1.0);
        // NaN is no number of steps.
        if count <= most[lane] {
            steps[lane] = count as u32;
            h.0[lane] /= count;
        }
    }
    let mut end = FINE.run_four(equations, t, z, h, steps);
    for lane in (0..4).filter(|&lane| steps[lane] == 0) {
        end.iter_mut().for_each(|x| x.0[lane] = f64::NAN);
    }
    end
}

/// Residuals, bounds and derivatives at some numbers.
pub struct Linear {
    /// Residuals in units of the bound.
    pub off: Vec<f64>,
    /// Their derivatives by the numbers that are fitted.
    pub slopes: Vec<Vec<f64>>,
    /// The bounds.
    pub bounds: Vec<f64>,
}

impl<'a> Applied<'a> {
    /// These numbers.
    pub fn numbers(&self) -> [f64; NUMBERS] {
        let Equation { k, c, drive: [a, b, frequency], .. } = self.equation;
        [k, c, self.stretch, a, b, frequency]
    }

    /// The same map with other numbers.
    pub fn with(&self, [k, c, stretch, a, b, frequency]: [f64; NUMBERS]) -> Applied<'a> {
        let equation = Equation { k, c, drive: [a, b, frequency], ..self.equation };
        Applied { equation, stretch, ..*self }
    }

    /// The ways by which the numbers are moved to see what comes of it.
    fn ways(&self) -> [f64; NUMBERS] {
        let frequency = libm::fmax(self.equation.rate(), 1e-6);
        let force = libm::fmax(self.equation.k.abs(), 1e-9);
        let way = 1e-6;
        [way * force, way * frequency, way, way * force, way * force, way * frequency]
    }

    /// Bounds of all pairs, one entry after the other.
    pub fn bounds(&self, pairs: &[Pair]) -> Vec<f64> {
        self.entries(pairs, |pairs| self.bound(pairs, self.predict(pairs, 0, NOT_SHIFTED)))
    }

    /// Residuals of all pairs.
    pub fn residuals(&self, pairs: &[Pair]) -> Vec<f64> {
        self.entries(pairs, |pairs| self.left(pairs, self.predict(pairs, 0, NOT_SHIFTED)))
    }

    /// Residuals of all pairs in units of their own bounds.
    pub fn in_bounds(&self, pairs: &[Pair]) -> Vec<f64> {
        self.entries(pairs, |pairs| {
            let here = self.predict(pairs, 0, NOT_SHIFTED);
            let (left, bound) = (self.left(pairs, here), self.bound(pairs, here));
            [left[0] / bound[0], left[1] / bound[1]]
        })
    }

    /// How far the states of all pairs move, in units of these bounds.
    pub fn moves(&self, pairs: &[Pair], bounds: &[f64]) -> Vec<f64> {
        let data = self.data;
        let all = pairs.iter().flat_map(|pair| {
            let [i, j, k] = pair.rows;
            if data.has_velocities() {
                vec![data.theta[k] - data.theta[i], data.omega[k] - data.omega[i]]
            } else {
                vec![data.theta[i] - 2.0 * data.theta[j] + data.theta[k]]
            }
        });
        all.zip(bounds).map(|(move_, bound)| move_ / bound).collect()
    }

    /// Residuals of all pairs in units of these bounds.
    pub fn off(&self, pairs: &[Pair], bounds: &[f64]) -> Vec<f64> {
        let all = self.residuals(pairs);
        all.iter().zip(bounds).map(|(residual, bound)| residual / bound).collect()
    }

    /// All of it, linearised.
    pub fn linear(&self, pairs: &[Pair], active: &Active, bounds: Vec<f64>) -> Linear {
        let off = self.off(pairs, &bounds);
        let ways = self.ways();
        let slopes = (0..NUMBERS).filter(|&n| active[n]).map(|n| {
            let mut numbers = self.numbers();
            numbers[n] += ways[n];
            let moved = self.with(numbers).off(pairs, &bounds);
            moved.iter().zip(&off).map(|(a, b)| (a - b) / ways[n]).collect()
        });
        let slopes = slopes.collect();
        Linear { off, slopes, bounds }
    }
}

/// Solves the normal equations by elimination with a little added to the diagonal; and the
/// inverse's diagonal.
pub fn solve(
    slopes: &[Vec<f64>],
    off: &[f64],
    weights: &[f64],
    (prior, away): (&[f64], f64),
) -> Option<(Vec<f64>, Vec<f64>)> {
    let size = slopes.len();
    let mut scales = vec![0.0; size];
    let mut m = vec![vec![0.0; 2 * size + 1]; size];
    for i in 0..size {
        let norm: f64 =
            slopes[i].iter().zip(weights).map(|(a, w)| w * a * a).sum::<f64>() + prior[i];
        scales[i] = 1.0 / libm::sqrt(libm::fmax(norm, 1e-300));
    }
    for i in 0..size {
        for j in 0..size {
            let sum: f64 =
                slopes[i].iter().zip(&slopes[j]).zip(weights).map(|((a, b), w)| w * a * b).sum();
            let prior = if i == j { prior[i] } else { 0.0 };
            m[i][j] = (sum + prior) * scales[i] * scales[j];
        }
        m[i][i] += 1e-13;
        m[i][size + i] = 1.0;
        let sum: f64 = slopes[i].iter().zip(off).zip(weights).map(|((a, b), w)| w * a * b).sum();
        // Only the spacing is known beforehand, and by so much it is off.
        m[i][2 * size] = -(sum + prior[i] * away) * scales[i];
    }
    for i in 0..size {
        let pivot = (i..size).max_by(|&a, &b| m[a][i].abs().total_cmp(&m[b][i].abs()))?;
        m.swap(i, pivot);
        let head = m[i][i];
        if head.is_nan() || head.abs() <= 1e-300 {
            return None;
        }
        m[i].iter_mut().for_each(|x| *x /= head);
        for j in (0..size).filter(|&j| j != i) {
            let factor = m[j][i];
            let row = m[i].clone();
            m[j].iter_mut().zip(row).for_each(|(x, head)| *x -= factor * head);
        }
    }
    let step = (0..size).map(|i| m[i][2 * size] * scales[i]).collect();
    let spread = (0..size).map(|i| libm::sqrt(m[i][size + i].abs()) * scales[i]).collect();
    Some((step, spread))
}

/// A map with numbers that are nearer to the pairs', and how far its states still move in the last
/// step to them (in bounds).
///
/// Gauss and Newton's method converges quadratically where the pairs are the map's own: each step
/// moves the states about as far as the square of the one before, as a part of how far pairs move.
pub fn refine<'a>(
    from: Applied<'a>,
    pairs: &[Pair],
    active: &Active,
    bounds: &[f64],
    moved: f64,
) -> Option<(Applied<'a>, f64)> {
    let known = from.data.spacing_known_to / from.data.spacing;
    let places: Vec<usize> = (0..NUMBERS).filter(|&n| active[n]).collect();
    let of = |&n: &usize| if n == 2 { 1.0 / libm::fmax(known * known, 1e-30) } else { 0.0 };
    let prior: Vec<f64> = places.iter().map(of).collect();
    let weights = vec![1.0; bounds.len()];
    let mut here = from;
    let (mut last, mut effect) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..5 {
        let Linear { off, slopes, .. } = here.linear(pairs, active, bounds.to_vec());
        let now = mean(&off);
        if !now.is_finite() || now > 1.5 * last {
            return None;
        }
        if now <= 1.0 || effect <= 1e-6 * moved {
            break;
        }
        last = now;
        let (step, _) = solve(&slopes, &off, &weights, (&prior, here.stretch - 1.0))?;
        let mut moves = vec![0.0; off.len()];
        let mut numbers = here.numbers();
        for ((&place, step), slope) in places.iter().zip(&step).zip(&slopes) {
            numbers[place] += step;
            moves.iter_mut().zip(slope).for_each(|(x, slope)| *x += step * slope);
        }
        effect = mean(&moves);
        here = here.with(numbers);
    }
    effect.is_finite().then_some((here, effect))
}

/// The root of the mean of the squares.
pub fn mean(off: &[f64]) -> f64 {
    libm::sqrt(off.iter().map(|x| x * x).sum::<f64>() / off.len().max(1) as f64)
}

/// The largest size; infinite if one is no number.
pub fn worst(off: &[f64]) -> f64 {
    off.iter().fold(0.0, |a, x| if x.is_finite() { libm::fmax(a, x.abs()) } else { f64::INFINITY })
}

/// Fits the active numbers by Gauss and Newton's method from those of `from`.
///
/// With `even_out` the largest residual is made small, not the mean square: pairs are given the
/// more weight the further off they are, again and again (Lawson's method).
pub fn fit(from: Applied<'_>, pairs: &[Pair], active: &Active, even_out: bool) -> Option<Fit> {
    let mut here = from;
    let count = active.iter().filter(|&&x| x).count();
    // The spacing is known beforehand, as the times have digits.
    let known = from.data.spacing_known_to / from.data.spacing;
    let places: Vec<usize> = (0..NUMBERS).filter(|&n| active[n]).collect();
    let prior: Vec<f64> = places
        .iter()
        .map(|&n| if n == 2 { 1.0 / libm::fmax(known * known, 1e-30) } else { 0.0 })
        .collect();
    let mut bounds = here.bounds(pairs);
    if pairs.is_empty() || bounds.len() < count + 1 || !worst(&bounds).is_finite() {
        return None;
    }
    let mut weights = vec![1.0; bounds.len()];
    let mut cost = f64::INFINITY;
    let mut spread = vec![f64::NAN; count];
    let mut best: Option<(f64, Applied<'_>)> = None;
    let rounds = if even_out { 15 } else { 8 };
    for round in 0..rounds {
        let Linear { off, slopes, .. } = here.linear(pairs, active, bounds.clone());
        let now = mean(&off);
        if !now.is_finite() {
            break;
        }
        let measure = if even_out { worst(&off) } else { now };
        if best.is_none_or(|(least, _)| measure < least) {
            best = Some((measure, here));
        }
        if even_out {
            let most = worst(&off);
            weights.iter_mut().zip(&off).for_each(|(w, x)| *w *= 1e-3 + x.abs() / most);
            let sum = weights.iter().sum::<f64>() / weights.len() as f64;
            weights.iter_mut().for_each(|w| *w /= sum);
        }
        let Some((step, around)) = solve(&slopes, &off, &weights, (&prior, here.stretch - 1.0))
        else {
            break;
        };
        spread = around;
        let mut numbers = here.numbers();
        let mut moved = 0.0;
        for (n, &place) in places.iter().enumerate() {
            numbers[place] += step[n];
            moved = libm::fmax(moved, step[n].abs() / libm::fmax(spread[n], 1e-300));
        }
        // A step that makes it worse is halved, some times.
        let mut next = here.with(numbers);
        for _ in 0..if even_out { 0 } else { 2 } {
            let then = mean(&next.off(pairs, &bounds));
            if then.is_finite() && then <= now * (1.0 + 1e-9) {
                break;
            }
            let (a, b) = (next.numbers(), here.numbers());
            next = here.with(core::array::from_fn(|n| 0.5 * (a[n] + b[n])));
        }
        here = next;
        if !even_out && moved < 1e-3 {
            break;
        }
        // Far off, and hardly less than before: another map.
        let is_method = matches!(here.map, Map::Steps(..));
        let lost = is_method && round >= 2 && now > 30.0 && now > 0.7 * cost;
        let settled = !even_out && ((cost - now).abs() <= 1e-6 * now || lost);
        cost = now;
        if settled {
            break;
        }
        if round == 3 && !even_out {
            bounds = here.bounds(pairs);
            best = None;
            if !worst(&bounds).is_finite() {
                return None;
            }
        }
    }
    let here = if even_out { best?.1 } else { here };
    let bounds = here.bounds(pairs);
    let off = here.off(pairs, &bounds);
    if spread.iter().any(|x| x.is_nan()) {
        let Linear { off, slopes, .. } = here.linear(pairs, active, bounds.clone());
        let ones = vec![1.0; off.len()];
        let around = solve(&slopes, &off, &ones, (&prior, 0.0));
        spread = around.map_or_else(|| vec![f64::INFINITY; count], |(_, spread)| spread);
    }
    let mut known_to = [0.0; NUMBERS];
    for (n, &place) in places.iter().enumerate() {
        known_to[place] = 2.0 * spread[n];
    }
    let (mean, worst) = (mean(&off), worst(&off));
    // Another spacing than the times have is none: a wrong map would take it.
    if active[2] && (here.stretch - 1.0).abs() > libm::fmax(known, 1e-12) {
        let fixed = [active[0], active[1], false, active[3], active[4], active[5]];
        return fit(Applied { stretch: 1.0, ..from }, pairs, &fixed, even_out);
    }
    let Applied { map, equation, stretch, .. } = here;
    mean.is_finite().then_some(Fit { map, equation, stretch, mean, worst, known_to })
}

/// The equation of this force that the second differences of the angles, or the differences of the
/// velocities, fit best: to begin with.
pub fn first_guess(data: &Data, force: Force) -> Equation {
    let mut sums = [[0.0; 3]; 2];
    let mut add = |bend: f64, force: f64, rate: f64| {
        let [x, y] = [-force, -rate];
        if [bend, x, y].iter().all(|x| x.is_finite()) {
            sums[0] = [sums[0][0] + x * x, sums[0][1] + x * y, sums[0][2] + x * bend];
            sums[1] = [sums[1][0] + y * y, sums[1][1] + y * bend, 0.0];
        }
    };
    for pair in data.pairs(1, 2000) {
        let [i, j, k] = pair.rows;
        let (span, th) = (data.span(&pair, false), &data.theta);
        if data.has_velocities() {
            let (a, b) = (data.omega[i], data.omega[j]);
            add((b - a) / span, 0.5 * (force.at(th[i]) + force.at(th[j])), 0.5 * (a + b));
        } else {
            let next = data.span(&pair, true);
            let (before, after) = ((th[j] - th[i]) / span, (th[k] - th[j]) / next);
            add(2.0 * (after - before) / (span + next), force.at(th[j]), 0.5 * (before + after));
        }
    }
    let [[xx, xy, xb], [yy, yb, _]] = sums;
    let det = xx * yy - xy * xy;
    let (k, c) = if det.abs() > 1e-9 * xx * yy {
        ((xb * yy - yb * xy) / det, (xx * yb - xy * xb) / det)
    } else {
        (xb / libm::fmax(xx, 1e-300), 0.0)
    };
    let (k, c) = if k.is_finite() && c.is_finite() { (k, c) } else { (1.0, 0.0) };
    Equation { force, k, c, drive: [0.0; 3] }
}
