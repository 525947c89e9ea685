//! Measured rows: noise in the angles about an exact motion.

use super::fit::{Data, Fit, MOST_EXACT, Map, NUMBERS, Pair, exact, mean, solve};
use super::lanes::{cosine, sine};
use super::search::{Motion, applied, unexplained};

/// The noise of measured angles (rad), and the equation of the motion about which they are.
///
/// The noise of the pairs, and that of the angles about one exact motion over all rows, have to be
/// the same: then the rows are that motion with noise. Of the pairs alone the equation is not to be
/// had, as noise in both of a pair makes the force seem another one.
pub fn of_measured(data: &Data, motion: &Motion) -> Option<(f64, Fit)> {
    if motion.fit.mean <= 3.0 {
        return None;
    }
    let noise = of_pairs(data, motion)?;
    let fit = over_all(data, motion)?;
    let about = fit.mean;
    (about < 2.0 * noise && noise < 2.0 * about).then_some((about, fit))
}

/// The exact motion that is nearest to the angles of all rows, with what is left (rad) as its mean.
///
/// First of a swing, then of twice as many rows again and again, as far motions of a wrong k are
/// half a swing off.
fn over_all(data: &Data, motion: &Motion) -> Option<Fit> {
    let rows = data.row.len().min(2000);
    let rate = motion.fit.equation.rate();
    let first = (0..rows).find(|&i| (data.t[i] - data.t[0]) * rate > 6.0).unwrap_or(rows);
    let equation = |x: &[f64]| {
        let base = motion.fit.equation;
        super::candidates::Equation { k: x[2], c: x[3], ..base }
    };
    let off = |x: &[f64], rows: usize| {
        let equation = equation(x);
        let mut z = [x[0], x[1]];
        let mut off = vec![z[0] - data.theta[0]];
        for i in 1..rows {
            let span = data.t[i] - data.t[i - 1];
            z = exact(&equation, data.t[i - 1], z, span, 0.5, MOST_EXACT);
            off.push(z[0] - data.theta[i]);
        }
        off
    };
    let early = first.min(4).min(rows - 1);
    let speed = (data.theta[early] - data.theta[0]) / (data.t[early] - data.t[0]);
    let mut x = vec![data.theta[0], speed, motion.fit.equation.k, 0.0];
    let mut spread = Vec::new();
    let mut count = first;
    loop {
        for _ in 0..12 {
            let here = off(&x, count);
            let ways = [1e-6, 1e-6 * rate, 1e-6 * x[2], 1e-6 * rate];
            let slopes: Vec<Vec<f64>> = (0..4)
                .map(|n| {
                    let mut moved = x.clone();
                    moved[n] += ways[n];
                    let there = off(&moved, count);
                    there.iter().zip(&here).map(|(a, b)| (a - b) / ways[n]).collect()
                })
                .collect();
            let weights = vec![1.0; here.len()];
            let (step, around) = solve(&slopes, &here, &weights, (&[0.0; 4], 0.0))?;
            spread = around;
            let now = mean(&here);
            let mut part = 1.0;
            let next = loop {
                let next: Vec<f64> = x.iter().zip(&step).map(|(x, dx)| x + part * dx).collect();
                let then = mean(&off(&next, count));
                if then <= now || part < 0.05 {
                    break next;
                }
                part *= 0.5;
            };
            let settled = (mean(&off(&next, count)) - now).abs() <= 1e-6 * now;
            x = next;
            if settled {
                break;
            }
        }
        if count == rows {
            break;
        }
        count = (2 * count).min(rows);
    }
    let left = mean(&off(&x, rows));
    if !left.is_finite() {
        return None;
    }
    let mut known_to = [0.0; NUMBERS];
    known_to[0] = 2.0 * left * spread[2];
    known_to[1] = 2.0 * left * spread[3];
    let mut equation = equation(&x);
    // A drag that is none, to within what it is known to.
    if equation.c.abs() < known_to[1] {
        equation.c = 0.0;
    }
    Some(Fit { map: Map::Exact, equation, stretch: 1.0, mean: left, worst: left, known_to })
}

/// The standard deviation of the angles' noise, if what the motion leaves is noise.
///
/// What a method with steps of one length leaves is a function of the state: smooth along the run,
/// so what is left of one pair is nearly what is left of the next (correlation near 1), or it
/// changes sign from step to step (near −1, and near 1 with the next but one). Noise δ in each
/// angle leaves δ' − Jδ, with J near 1 where rows are near each other: neighbours have a
/// correlation of −1/2, of −2/3 where the velocities are angles' differences, and the next but one
/// have 0 or 1/6. And no smooth function of the state explains it. That rounding is not taken for
/// noise, the noise has to be larger than single precision's.
fn of_pairs(data: &Data, motion: &Motion) -> Option<f64> {
    const LEAST_PAIRS: usize = 40;
    let pairs = data.pairs(1, usize::MAX);
    let pairs = &pairs[..pairs.len().min(2000)];
    let here = applied(data, &motion.fit);
    let rows_are_near = here.equation.rate() * data.spacing < 0.5;
    if pairs.len() < LEAST_PAIRS || !data.even || !rows_are_near {
        return None;
    }
    let left: Vec<f64> = here.residuals(pairs).into_iter().step_by(data.entries()).collect();
    if left.iter().any(|x| !x.is_finite()) {
        return None;
    }
    let alike = |lag: usize| {
        let products = left.iter().zip(&left[lag..]).map(|(a, b)| a * b);
        products.sum::<f64>() / left.iter().map(|x| x * x).sum::<f64>()
    };
    let state = |pair: &Pair| {
        let [i, j, _] = pair.rows;
        (data.theta[i], (data.theta[j] - data.theta[i]) / data.spacing)
    };
    let fastest = pairs.iter().map(|pair| state(pair).1.abs()).fold(1e-300, f64::max);
    let widest = pairs.iter().map(|pair| state(pair).0.abs()).fold(1e-300, f64::max);
    type Of = fn(f64, f64, f64) -> f64;
    // Of θ, ω as a part of the largest, and θ so.
    let functions: [Of; 14] = [
        |_, _, _| 1.0,
        |_, v, _| v,
        |_, v, _| v * v,
        |_, v, _| v * v * v,
        |q, _, _| sine(q),
        |q, _, _| cosine(q),
        |q, _, _| sine(2.0 * q),
        |q, _, _| cosine(2.0 * q),
        |q, v, _| v * sine(q),
        |q, v, _| v * cosine(q),
        |q, v, _| v * v * sine(q),
        |q, v, _| v * v * cosine(q),
        |_, _, x| x,
        |_, _, x| x * x * x,
    ];
    let column = |of: &Of| {
        let of = |pair| {
            let (theta, rate) = state(pair);
            of(theta, rate / fastest, theta / widest)
        };
        pairs.iter().map(of).collect::<Vec<f64>>()
    };
    let columns: Vec<_> = functions.iter().map(column).collect();
    // Of so many numbers as many functions explain a part by chance.
    let count = left.len() as f64;
    let chance = libm::sqrt(1.0 - functions.len() as f64 / count);
    let rough = unexplained(&columns, &left) / chance > 0.8;
    // z' - M(z) of two noises with velocities, of three angles without: 1, 2, 1.
    let of_one = if data.has_velocities() { libm::sqrt(2.0) } else { libm::sqrt(6.0) };
    let noise = mean(&left) / of_one;
    let large = noise > 1e-5 * widest;
    (rough && large && alike(1) < -0.25 && alike(2).abs() < 0.45).then_some(noise)
}
