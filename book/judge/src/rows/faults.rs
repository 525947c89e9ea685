//! What is wrong with the times and the angles of a run, before any equation is known.

use core::f64::consts::{PI, TAU};

use super::columns::Run;
use super::report::Fault;

/// The places of the rows on an even grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Places {
    /// From row to row (s); where the times are uneven, the middle one.
    pub spacing: f64,
    /// What it is known to (s).
    pub known_to: f64,
    /// Whether there is a grid.
    pub even: bool,
    /// The place of each row.
    pub at: Vec<i64>,
    /// Whether the row can be used.
    pub good: Vec<bool>,
}

/// More faults of one kind than these are not told one by one.
pub const MOST: usize = 20;

/// Mends what can be mended, says what was wrong, and where each row stands.
pub fn find(run: &mut Run) -> (Places, Vec<Fault>) {
    let mut faults = Vec::new();
    let rows = run.t.len();
    let mut good: Vec<bool> = (0..rows)
        .map(|i| {
            let velocity = run.omega.get(i).is_none_or(|x| x.is_finite());
            run.t[i].is_finite() && run.theta[i].is_finite() && velocity
        })
        .collect();
    for row in (0..rows).filter(|&i| !good[i]) {
        faults.push(Fault::NoNumber { row: row + 1 });
    }
    unwrap(run, &good, &mut faults);
    let places = places(run, &mut good, &mut faults);
    (places, faults)
}

/// Undoes the jumps by a full turn.
fn unwrap(run: &mut Run, good: &[bool], faults: &mut Vec<Fault>) {
    let known: Vec<f64> = (0..run.theta.len()).filter(|&i| good[i]).map(|i| run.theta[i]).collect();
    let mut steps: Vec<f64> = known.windows(2).map(|x| (x[1] - x[0]).abs()).collect();
    steps.sort_by(f64::total_cmp);
    // Where rows are so far apart, a swing from side to side is as large as a jump.
    if steps.get(steps.len() / 2).is_none_or(|&middle| middle > 0.8) {
        return;
    }
    let (mut turns, mut times, mut first) = (0.0, 0, None);
    let mut before: Option<(f64, f64)> = None;
    for i in (0..run.theta.len()).filter(|&i| good[i]) {
        let raw = run.theta[i];
        if let Some((old, step)) = before {
            // A jump is a full turn beside the step before it.
            let jump = libm::round((raw - old - step) / TAU);
            let near = ((raw - old - step) - TAU * jump).abs();
            if jump != 0.0 && near < 0.25 * PI && step.abs() < 0.75 * PI && raw.abs() < 7.0 {
                turns -= jump;
                times += 1;
                first = first.or(Some(i + 1));
            }
        }
        let here = raw + TAU * turns;
        let step = before.map_or(0.0, |(old, _)| here - TAU * turns - old);
        let step = step - TAU * libm::round(step / TAU);
        before = Some((raw, step));
        run.theta[i] = here;
    }
    if let Some(row) = first {
        faults.push(Fault::Wrapped { row, times });
    }
}

fn places(run: &Run, good: &mut [bool], faults: &mut Vec<Fault>) -> Places {
    let t = &run.t;
    let known: Vec<usize> = (0..t.len()).filter(|&i| good[i]).collect();
    let mut steps: Vec<f64> = known.windows(2).map(|x| t[x[1]] - t[x[0]]).collect();
    steps.sort_by(f64::total_cmp);
    let longest = steps.last().copied().unwrap_or(0.0);
    let positive = steps.iter().position(|&x| x > 0.0).unwrap_or(0);
    let middle = steps[(positive + steps.len()) / 2];
    // Each time is off by half a unit, and a sum of steps by its rounding.
    let size = t.iter().copied().filter(|x| x.is_finite()).fold(0.0, |a, b| b.abs().max(a));
    let loose = 2.0 * run.half_t * (1.0 + 1e-9) + 4.0 * f64::EPSILON * size + 1e-9 * middle;
    let mut spacing = middle;
    // Where the steps are all one length, the whole time is a better measure of it.
    let straight = (longest - middle).abs() <= loose && (steps[0] - middle).abs() <= loose;
    if straight && known.len() > 1 {
        let (first, last) = (known[0], known[known.len() - 1]);
        spacing = (t[last] - t[first]) / (known.len() - 1) as f64;
    } else {
        // Steps that are one to within the digits, averaged.
        let near: Vec<f64> =
            steps.iter().copied().filter(|x| (x - middle).abs() <= loose).collect();
        spacing =
            if near.is_empty() { spacing } else { near.iter().sum::<f64>() / near.len() as f64 };
    }
    let mut at = vec![0_i64; t.len()];
    let (mut place, mut irregular, mut told) = (0, 0, Vec::new());
    for pair in known.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        let ratio = (t[b] - t[a]) / spacing;
        let whole = libm::round(ratio);
        let rows = (b - a) as i64;
        let on_it = (ratio - whole).abs() * spacing <= loose * libm::fmax(1.0, whole);
        let mut by = whole as i64;
        if !on_it || whole < 1.0 {
            irregular += 1;
            by = rows.max(1);
            told.push(match () {
                () if whole == 0.0 && on_it => Fault::TimeRepeated { row: b + 1 },
                () => Fault::TimeOff { row: b + 1 },
            });
        } else if by > rows {
            told.push(Fault::Missing { after: a + 1, rows: (by - rows) as usize });
        }
        place += by;
        at[b] = place;
    }
    let even = irregular * 10 <= known.len() || irregular <= 2 && known.len() > 3;
    if !even {
        faults.push(Fault::Uneven);
        for (i, place) in at.iter_mut().enumerate() {
            *place = i as i64;
        }
        let known_to = 2.0 * run.half_t;
        return Places { spacing: middle, known_to, even, at, good: good.to_vec() };
    }
    // A time that is off is so twice: to the row and from it, and its row is in its place.
    let mut off = 0;
    told.retain(|fault| match *fault {
        Fault::TimeOff { row } => {
            let again = off + 1 == row;
            off = row;
            !again
        }
        _ => true,
    });
    faults.extend(told);
    let (first, last) = (known[0], known[known.len() - 1]);
    let whole = at[last].max(1) as f64;
    let mut known_to = (2.0 * run.half_t + 4.0 * f64::EPSILON * size) / whole;
    if irregular == 0 {
        spacing = (t[last] - t[first]) / whole;
    } else {
        known_to = libm::fmax(known_to, loose / libm::sqrt(known.len() as f64));
    }
    Places { spacing: meant(spacing, known_to), known_to, even, at, good: good.to_vec() }
}

/// The short number, or the fraction of a second, that is meant by one.
pub fn meant(value: f64, known_to: f64) -> f64 {
    let whole = libm::round(1.0 / value);
    let fraction = (whole < 1e5 && (1.0 / whole - value).abs() <= known_to).then(|| 1.0 / whole);
    let size = libm::floor(libm::log10(value.abs())) as i32;
    for digits in 0..=16 {
        let decimal = rounded(value, digits - size);
        if (decimal - value).abs() <= known_to {
            // 1/60 rather than 0.016667, 0.01 rather than 1/99.9.
            return fraction.filter(|_| digits > 3).unwrap_or(decimal);
        }
    }
    value
}

/// To so many decimals.
pub fn rounded(value: f64, decimals: i32) -> f64 {
    if decimals >= 0 {
        return format!("{value:.*}", decimals as usize).parse().unwrap_or(value);
    }
    let unit = libm::pow(10.0, f64::from(-decimals));
    libm::round(value / unit) * unit
}

/// The run with the velocities of the rows before or after, if they fit the angles better.
///
/// The rate of the angle, from row to row before and after, is that at the row to second order; a
/// method's own velocity may be half a row off, as symplectic Euler's is. So it may be a fault from
/// three quarters of a row on. It is one only if something makes the rows with it put right.
pub fn shifted(run: &Run, places: &Places) -> Option<(Run, Places, Fault)> {
    let rows = run.t.len();
    if run.omega.is_empty() || rows < 8 || !places.even {
        return None;
    }
    let next =
        |i: usize| places.at[i + 1] == places.at[i] + 1 && places.good[i] && places.good[i + 1];
    let h = places.spacing;
    let misfit = |shift: f64| {
        let (mut sum, mut count) = (0.0, 0);
        for i in 2..rows - 2 {
            if !(i - 2..i + 2).all(next) {
                continue;
            }
            let th = &run.theta;
            let rate = (8.0 * (th[i + 1] - th[i - 1]) - (th[i + 2] - th[i - 2])) / (12.0 * h);
            let [a, b, c] = [run.omega[i - 1], run.omega[i], run.omega[i + 1]];
            let seen = b + 0.5 * shift * (c - a) + 0.5 * shift * shift * (a - 2.0 * b + c);
            sum += (rate - seen) * (rate - seen);
            count += 1;
        }
        (sum, count)
    };
    // The ω of row i is that of time t + s: then the rate at i is the ω interpolated at -s.
    let mut tried = [-1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 1.5].map(|shift| (misfit(shift), shift));
    tried.sort_by(|a, b| a.0.0.total_cmp(&b.0.0));
    let ((least, count), shift) = tried[0];
    let unshifted = misfit(0.0).0;
    if count < 4 || shift.abs() < 0.75 || least * 16.0 > unshifted {
        return None;
    }
    let by = if shift > 0.0 { 1 } else { -1 };
    let (mut run, mut places) = (run.clone(), places.clone());
    if by > 0 {
        run.omega.rotate_left(1);
        run.half_omega.rotate_left(1);
    } else {
        run.omega.rotate_right(1);
        run.half_omega.rotate_right(1);
    }
    let end = if by > 0 { rows - 1 } else { 0 };
    run.omega[end] = f64::NAN;
    places.good[end] = false;
    // Rate at i is the ω of row i + 1: this row shows the ω of the row before.
    Some((run, places, Fault::VelocityShifted { rows: -by }))
}
