//! Rows of a run, and what made them.
//!
//! What people have of a program is what comes out of it: rows of t, θ and ω. Each pair of
//! neighbours is an equation for the steps that lead from one to the other, and the last digit says
//! how exactly it has to hold. So the rows say which equation they are of, and often which method
//! has made them, in how many steps from row to row.
//!
//! ```
//! use pendula_judge::rows::{Maker, identify};
//!
//! let (mut theta, mut omega) = (1.0_f64, 0.0_f64);
//! let mut text = String::from("t,theta,omega\n");
//! for n in 0..200 {
//!     text += &format!("{:.2},{theta:.6},{omega:.6}\n", 0.02 * f64::from(n));
//!     omega -= 0.02 * 9.8 * theta.sin();
//!     theta += 0.02 * omega;
//! }
//! let report = identify(text.as_bytes()).unwrap();
//! let Maker::Method(made) = &report.maker else { panic!("{report:?}") };
//! assert_eq!((made.name, made.steps, made.step), ("symplectic-euler", 1, 0.02));
//! assert_eq!(made.equation.k.short, 9.8);
//! ```

#[doc(hidden)]
pub mod candidates;
mod columns;
mod faults;
mod fit;
mod json;
mod lanes;
mod noise;
mod packed;
mod parse;
mod report;
mod search;

pub use report::{
    AtTheEnd, Digits, Distinguish, Drawn, Fault, Force, FoundEquation, Known, Made, Maker, Read,
    Refusal, RunReport, Unit, Used,
};

pub(crate) use search::AGREES;

use columns::Run;
use faults::{Places, rounded};
use fit::{Data, Fit, Map};
use parse::{Cell, Column, Table};
use search::{Found, Motion, applied};

/// More bytes than these are not read.
pub const MOST_BYTES: usize = 256 << 20;
/// So many pairs are compared with the method that is found, and all in all in so many steps.
const MOST_COMPARED: usize = 20_000;
const MOST_STEPS_COMPARED: f64 = 2e5;
/// So many rows are drawn.
const MOST_DRAWN: usize = 400;
/// Among measured rows one has to be so many times as far off as otherwise to be told.
const STICKS_OUT: f64 = 5.0;

/// Numbers that are not quite those that make the worst pair least leave no more, in bounds, of the
/// way over an edited row.
const BRIDGED: f64 = 2.0;

/// Says what the rows of a text are.
///
/// # Errors
/// If it is no table of a run.
pub fn identify(text: &[u8]) -> Result<RunReport, Refusal> {
    if text.len() > MOST_BYTES {
        return Err(Refusal::TooLong);
    }
    identify_table(&parse::parse(text)?)
}

/// The same of numbers, whose digits are the fewest that read back to them.
///
/// # Errors
/// If they are no run.
///
/// # Panics
/// If there are not as many angles or velocities as times.
pub fn identify_run(t: &[f64], theta: &[f64], omega: Option<&[f64]>) -> Result<RunReport, Refusal> {
    let column = |heading: &str, numbers: &[f64]| {
        assert_eq!(numbers.len(), t.len(), "as many numbers as times");
        Column {
            heading: heading.to_string(),
            cells: numbers.iter().copied().map(Cell::of).collect(),
        }
    };
    let mut columns = vec![column("t", t), column("theta", theta)];
    columns.extend(omega.map(|omega| column("omega", omega)));
    match t.len() {
        0 => return Err(Refusal::Empty),
        1 => return Err(Refusal::OneRow),
        _ => {}
    }
    identify_table(&Table { columns, lines: (1..=t.len()).collect(), left_out: 0 })
}

fn identify_table(table: &Table) -> Result<RunReport, Refusal> {
    let (mut read, mut run) = columns::choose(table)?;
    let (places, mut faults) = faults::find(&mut run);
    read.spacing = places.even.then_some(places.spacing);
    read.spacing_known_to = places.known_to;
    let written = data(&run, &places);
    let needed = if written.has_velocities() { 4 } else { 7 };
    if written.row.len() < needed || written.pairs(1, usize::MAX).len() < 3 {
        return Err(Refusal::TooFewRows { rows: written.row.len(), needed });
    }
    let Tried { data, found, motions, faults: told } = try_all(&run, &places, written);
    faults.extend(told);
    let mut report = RunReport {
        read,
        faults,
        equation: None,
        maker: Maker::NoPendulum,
        compared: (0, data.pairs(1, usize::MAX).len()),
        end: None,
        drawn: None,
    };
    make(&mut report, &data, found, &motions);
    Ok(report)
}

/// Rows, as written or with something put right, and what was found of them.
struct Tried {
    data: Data,
    found: Found,
    motions: Vec<Motion>,
    faults: Vec<Fault>,
}

impl Tried {
    fn new(data: Data, motions: Vec<Motion>, faults: Vec<Fault>) -> Self {
        let mut found = Found::default();
        let mut used = motions;
        look(&data, &used, &mut found);
        let mean = |motions: &[Motion]| motions.first().map_or(f64::INFINITY, |it| it.fit.mean);
        let none = |found: &Found| found.agree.is_empty() && found.motion.is_none();
        if none(&found) {
            let others = search::motions(&data, None, &Force::OTHERS);
            // Another force only where it is much nearer.
            if mean(&others) < 0.3 * libm::fmax(mean(&used), 3.0) {
                look(&data, &others, &mut found);
                used = others;
            }
        }
        if none(&found)
            && data.row.len() > 20
            && let Some(drive) = search::drive(&data)
        {
            let driven = search::motions(&data, Some(drive), &Force::USUAL);
            if mean(&driven) < 0.3 * mean(&used) {
                look(&data, &driven, &mut found);
                // One that explains all but a thirtieth is a drive; otherwise it fits a method.
                if mean(&driven) < 0.03 * mean(&used) || !none(&found) {
                    used = driven;
                }
            }
        }
        Self { data, found, motions: used, faults }
    }

    /// What makes all rows: a method, or else the exact motion.
    fn maker(&self) -> Option<Fit> {
        self.found.agree.first().copied().or(self.found.motion)
    }

    /// The faults that what makes the other rows contradicts. Beside a motion that is only near a
    /// method's the method's own error would be one.
    fn proven(mut self, written: &Data) -> Option<Self> {
        let maker = self.maker().filter(|fit| fit.worst <= search::AGREES)?;
        let told = std::mem::take(&mut self.faults);
        let proven = |fault: &&Fault| contradicts(written, &maker, fault, &told);
        self.faults = told.iter().filter(proven).copied().collect();
        (!self.faults.is_empty()).then_some(self)
    }
}

/// Looks for what made the rows; where nothing made them as they are written, with what seems to be
/// wrong with them put right.
///
/// A row is strange beside what a motion that is only nearly that of the rows makes of it, and a
/// method may be strange like that somewhere. So a fault is told only if something makes all rows
/// with it put right and does not make those in which it is. Of rows of which nothing is found,
/// what sticks out far more is told only if the others are measured rows: an unknown method's own
/// error may stick out as far.
fn try_all(run: &Run, places: &Places, written: Data) -> Tried {
    let begun = candidates::work();
    let motions = search::motions(&written, None, &Force::USUAL);
    let mend = |times| {
        let (data, told) = outliers(&written, motions.first()?, times);
        (!told.is_empty() && are_few(&told, written.row.len())).then_some((data, told))
    };
    if let Some((data, told)) = mend(1.0) {
        let fitted = search::motions(&data, None, &Force::USUAL);
        if let Some(mended) = Tried::new(data, fitted, told).proven(&written) {
            return mended;
        }
    }
    let as_written = Tried::new(written.clone(), motions.clone(), Vec::new());
    if as_written.maker().is_some() {
        return as_written;
    }
    if let Some((run, places, told)) = faults::shifted(run, places) {
        let data = data(&run, &places);
        let fitted = search::motions(&data, None, &Force::USUAL);
        let shifted = Tried::new(data, fitted, vec![told]);
        if shifted.maker().is_some() {
            return shifted;
        }
    }
    // Where that has taken long, as many are near, what a part of the rows has is told apart no
    // sooner.
    if candidates::work() - begun < search::MOST_WORK
        && let Some(mended) = by_parts(&written)
    {
        return mended;
    }
    if let Some((data, told)) = mend(STICKS_OUT) {
        let fitted = search::motions(&data, None, &Force::USUAL);
        let noise = |motion| noise::of_measured(&data, motion);
        if fitted.first().and_then(noise).is_some() {
            return Tried { data, motions: fitted, faults: told, ..as_written };
        }
    }
    as_written
}

/// A motion that is not quite that of the rows: its numbers are known so much less.
fn known_less(mut fit: Fit) -> Fit {
    fit.known_to.iter_mut().for_each(|to| *to *= libm::fmax(1.0, fit.worst));
    fit
}

/// Whether so few rows are edited that the others say what they should be: where many are, or many
/// in a row, what seems to make the others may be the motion of a part of the run, such as its end
/// in small swings.
fn are_few(faults: &[Fault], rows: usize) -> bool {
    let edited = |fault: &Fault| match *fault {
        Fault::Edited { row } => Some(row),
        _ => None,
    };
    let edited: Vec<usize> = faults.iter().filter_map(edited).collect();
    let longest = edited.chunk_by(|a, b| b - a == 1).map(<[usize]>::len).max().unwrap_or(0);
    longest <= 3 && edited.len() < faults::MOST && edited.len() * 20 <= rows.max(40)
}

/// What made a quarter of the rows may have made most others, but for some that were changed by
/// less than the motion shows.
fn by_parts(written: &Data) -> Option<Tried> {
    let rows = written.row.len();
    if rows < 60 || !written.even {
        return None;
    }
    (0..4).find_map(|part| {
        let outside: Vec<usize> =
            (0..rows).filter(|&i| i < part * rows / 4 || i >= (part + 1) * rows / 4).collect();
        let mut data = written.clone();
        remove(&mut data, &outside);
        let motions = search::motions(&data, None, &Force::USUAL);
        let maker = Tried::new(data, motions, Vec::new()).maker()?;
        let (out, faults) = unlike(written, &maker)?;
        if !are_few(&faults, rows) {
            return None;
        }
        let mut data = written.clone();
        remove(&mut data, &out);
        let motions = search::motions(&data, None, &Force::USUAL);
        Tried::new(data, motions, faults).proven(written)
    })
}

/// The rows that a maker of the others does not make: between those that do not follow, or at an
/// end. None if there are more, or others.
fn unlike(written: &Data, maker: &Fit) -> Option<(Vec<usize>, Vec<Fault>)> {
    let here = applied(written, maker);
    let older = maker.older();
    let pairs: Vec<_> =
        (older..written.row.len()).filter_map(|i| written.pair(i, 1)).take(200_000).collect();
    let off = here.in_bounds(&pairs);
    let is_off = |off: &[f64]| off.iter().any(|x| x.is_nan() || x.abs() > search::APART);
    let all = pairs.iter().zip(off.chunks(written.entries()));
    let bad: Vec<usize> =
        all.filter(|(_, off)| is_off(off)).map(|(pair, _)| pair.rows[0]).collect();
    if bad.is_empty() || bad.len() * 5 > pairs.len() {
        return None;
    }
    let last = written.row.len() - 1;
    // So many rows of a pair are before the one that is edited.
    let wide = if written.has_velocities() { 1 + older } else { 2 };
    let mut out = Vec::new();
    for run in bad.chunk_by(|a, b| b - a == 1) {
        let (first, end) = (run[0], run[run.len() - 1]);
        match run.len() {
            n if n > wide => out.extend(first + wide - older..=end - older),
            _ if first == older => out.push(0),
            _ if pairs.last().is_some_and(|pair| pair.rows[0] == end) => out.push(last),
            _ => return None,
        }
    }
    out.dedup();
    let faults = out.iter().map(|&i| Fault::Edited { row: written.row[i] + 1 });
    Some((out.clone(), faults.take(faults::MOST).collect()))
}

/// Whether what makes the other rows does not make those where a fault is seen, whatever its
/// numbers are.
///
/// Of few others the numbers are known less than a row may show, as where digits are significant
/// ones and the angles grow: so they are fitted to a fault's rows, too. If the maker with some
/// numbers makes all of these, each is off by 1 at most, the least sum of squares is no more than
/// their count, and none is off by more than its root: of 2 numbers in each of 24 pairs, and of at
/// most 9 more that a row is in (7 rows are older), and of the spacing, by √67 = 8.2, which is less
/// than what is apart.
fn contradicts(written: &Data, maker: &Fit, fault: &Fault, told: &[Fault]) -> bool {
    let row_of = |fault: &Fault| match *fault {
        Fault::Edited { row } | Fault::TimesLate { row, .. } | Fault::StateRepeated { row } => {
            Some(row - 1)
        }
        _ => None,
    };
    let Some(row) = row_of(fault) else { return true };
    let older = maker.older();
    let touches = |pair: &fit::Pair, row: usize| {
        let rows = written.row[pair.rows[0] - older]..=written.row[pair.rows[2]];
        rows.contains(&row)
    };
    let pairs = |of: Vec<usize>| -> Vec<fit::Pair> {
        of.into_iter().filter(|&i| i >= older).filter_map(|i| written.pair(i, 1)).collect()
    };
    let rows = written.row.len();
    let near = |i: &usize| written.row[*i].abs_diff(row) <= older + 2;
    let mut about = pairs((0..rows).filter(near).collect());
    about.retain(|pair| touches(pair, row));
    let mut all = pairs((0..rows).step_by(rows / 24 + 1).collect());
    all.retain(|pair| told.iter().filter_map(row_of).all(|row| !touches(pair, row)));
    all.extend(&about);
    let equation = maker.equation;
    let numbers = search::active(written, equation.c != 0.0, equation.drive[2] != 0.0);
    let own = applied(written, maker);
    let fitted = fit::fit(own, &all, &numbers, false);
    let here = fitted.as_ref().map_or(own, |fit| applied(written, fit));
    let off = |here: &fit::Applied<'_>, pairs: &[fit::Pair]| fit::worst(&here.in_bounds(pairs));
    let most = off(&here, &about);
    if most <= search::APART || !matches!(fault, Fault::Edited { .. }) {
        return most > search::APART;
    }
    // An edited row is bridged, with the maker's own numbers: the one after follows from the one
    // before. A method's own error is not, as two steps of it add up.
    let edited = |i: usize| told.iter().filter_map(row_of).any(|row| written.row[i] == row);
    let Some(at) = (0..rows).find(|&i| written.row[i] == row) else { return false };
    let before = (0..at).rev().find(|&i| !edited(i)).filter(|&i| i >= older);
    let after = (at + 1..rows).find(|&i| !edited(i));
    let (Some(before), Some(after)) = (before, after) else {
        // At an end nothing is: there the row must be far off where those beside it are as sharp
        // and are not, which a method's error is not from one row to the next.
        let of_angles = |pairs: &[fit::Pair]| -> Vec<f64> {
            own.bounds(pairs).into_iter().step_by(written.entries()).collect()
        };
        let mut bounds = of_angles(&all);
        bounds.sort_by(f64::total_cmp);
        let middle = bounds[bounds.len() / 2];
        let any_sharp = of_angles(&about).iter().any(|&bound| bound < 0.5 * middle);
        return most > 10.0 * search::APART && !any_sharp;
    };
    let lag = (written.at[after] - written.at[before]) as u32;
    let bridge = written.pair(before, lag);
    bridge.is_some_and(|pair| !edited(pair.rows[2]) && off(&own, &[pair]) <= BRIDGED)
}

fn data(run: &Run, places: &Places) -> Data {
    let good: Vec<usize> = (0..run.t.len()).filter(|&i| places.good[i]).collect();
    let of = |xs: &[f64]| good.iter().filter_map(|&i| xs.get(i).copied()).collect::<Vec<f64>>();
    let at: Vec<i64> = good.iter().map(|&i| places.at[i]).collect();
    let first = good.first().map_or(0.0, |&i| run.t[i]);
    let start = first - at.first().copied().unwrap_or(0) as f64 * places.spacing;
    let mut t = of(&run.t);
    if places.even {
        t = at.iter().map(|&at| start + at as f64 * places.spacing).collect();
    }
    Data {
        start,
        spacing: places.spacing,
        spacing_known_to: places.known_to,
        even: places.even,
        at,
        t,
        half_t: if places.even { 0.0 } else { run.half_t },
        theta: of(&run.theta),
        omega: of(&run.omega),
        half_theta: of(&run.half_theta),
        half_omega: of(&run.half_omega),
        single: run.single,
        row: good,
    }
}

/// Rows that do not follow where those around them do, by the exact motion; and the others.
fn outliers(data: &Data, motion: &Motion, sticks: f64) -> (Data, Vec<Fault>) {
    let here = applied(data, &motion.fit);
    let rows = data.row.len();
    if rows < 8 || !data.even || motion.fraction > 0.3 {
        return (data.clone(), Vec::new());
    }
    // Of so many rows each is looked at.
    let pairs: Vec<_> = (0..rows).filter_map(|i| data.pair(i, 1)).take(200_000).collect();
    let (residuals, bounds) = (here.residuals(&pairs), here.bounds(&pairs));
    let entries = data.entries();
    let [residuals, bounds]: [Vec<&[f64]>; 2] =
        [&residuals, &bounds].map(|numbers| numbers.chunks(entries).collect());
    let strange = |n: usize, times: f64| {
        (0..entries).any(|entry| {
            let near = (n.saturating_sub(5)..(n + 6).min(pairs.len())).filter(|&m| m != n);
            let mut around: Vec<f64> = near.map(|m| residuals[m][entry]).collect();
            around.sort_by(f64::total_cmp);
            let middle = around[around.len() / 2];
            let spread = around[around.len() * 3 / 4] - around[around.len() / 4];
            let apart = (residuals[n][entry] - middle).abs();
            let limit = sticks * times * (12.0 * spread + 6.0 * bounds[n][entry]);
            apart.is_nan() || limit.is_nan() || apart > limit
        })
    };
    let bad: Vec<usize> = (0..pairs.len()).filter(|&n| strange(n, 1.0)).collect();
    if bad.is_empty() || bad.len() * 5 > pairs.len() {
        return (data.clone(), Vec::new());
    }
    let mut faults = Vec::new();
    let mut out: Vec<usize> = Vec::new();
    let mut late: Vec<(usize, i64)> = Vec::new();
    let mut n = 0;
    while n < bad.len() {
        let mut last = n;
        while last + 1 < bad.len() && bad[last + 1] == bad[last] + 1 {
            last += 1;
        }
        let [first_pair, last_pair] = [bad[n], bad[last]];
        let [i, j, _] = pairs[first_pair].rows;
        let wide = usize::from(!data.has_velocities());
        let single = last_pair - first_pair <= wide;
        // A state that has gone on further, or not at all, is where the times have not.
        let jump = (first_pair..=last_pair).take(2).find_map(|n| {
            let [i, j, _] = pairs[n].rows;
            Some((j, gone_on(data, motion, i, j)?))
        });
        if let Some((j, by)) = jump {
            faults.push(match by {
                0 => Fault::StateRepeated { row: data.row[j] + 1 },
                by => Fault::TimesLate { row: data.row[j] + 1, by: by as usize - 1 },
            });
            late.push((j, by - 1));
        } else if single {
            // The first row or the last: that the rows beyond fit together cannot be asked.
            let at_an_end = match first_pair {
                0 => Some(i),
                _ if last_pair + 1 == pairs.len() => Some(pairs[last_pair].rows[2]),
                _ => None,
            };
            if let Some(row) = at_an_end.filter(|_| strange(first_pair, 20.0)) {
                faults.push(Fault::Edited { row: data.row[row] + 1 });
                out.push(row);
            }
        } else if bridged(data, motion, &residuals[first_pair..=last_pair], i) {
            let begin = if data.has_velocities() { j } else { pairs[first_pair].rows[2] };
            let end = pairs[last_pair].rows[0];
            for row in begin..=end.max(begin) {
                faults.push(Fault::Edited { row: data.row[row] + 1 });
                out.push(row);
            }
        }
        n = last + 1;
    }
    let mut data = data.clone();
    for (from, by) in late {
        for place in &mut data.at[from..] {
            *place += by;
        }
    }
    remove(&mut data, &out);
    faults.truncate(faults::MOST);
    (data, faults)
}

/// Whether the row after those that are off follows from row i, the one before them: then they were
/// edited, and are not where a method's error is large.
fn bridged(data: &Data, motion: &Motion, residuals: &[&[f64]], i: usize) -> bool {
    let here = applied(data, &motion.fit);
    let Some(pair) = data.pair(i, residuals.len() as u32) else { return false };
    let over = here.residual(&pair);
    let sizes = |entry: usize| residuals.iter().map(move |r| r[entry].abs()).fold(0.0, f64::max);
    (0..data.entries()).all(|entry| over[entry].abs() <= 0.5 * sizes(entry))
}

/// How many places the state has gone on from row i to row j, if not one.
fn gone_on(data: &Data, motion: &Motion, i: usize, j: usize) -> Option<i64> {
    if !data.has_velocities() {
        return None;
    }
    let here = applied(data, &motion.fit);
    let z = [data.theta[i], data.omega[i]];
    let rate = libm::fmax(here.equation.rate(), 1e-9);
    let off = |by: i64| {
        let end = here.advance(data.t[i], z, by as f64 * data.spacing, 1);
        libm::hypot(end[0] - data.theta[j], (end[1] - data.omega[j]) / rate)
    };
    let step = libm::hypot(
        here.advance(data.t[i], z, data.spacing, 1)[0] - z[0],
        (here.advance(data.t[i], z, data.spacing, 1)[1] - z[1]) / rate,
    );
    [0, 2, 3, 4].into_iter().find(|&by| off(by) < 0.1 * step)
}

fn remove(data: &mut Data, out: &[usize]) {
    let keep: Vec<bool> = (0..data.row.len()).map(|i| !out.contains(&i)).collect();
    fn sieve<T: Copy>(xs: &mut Vec<T>, keep: &[bool]) {
        if !xs.is_empty() {
            let kept = xs.iter().zip(keep).filter(|(_, keep)| **keep).map(|(x, _)| *x).collect();
            *xs = kept;
        }
    }
    sieve(&mut data.row, &keep);
    sieve(&mut data.at, &keep);
    for xs in
        [&mut data.t, &mut data.theta, &mut data.omega, &mut data.half_theta, &mut data.half_omega]
    {
        sieve(xs, &keep);
    }
}

/// Who made the rows, and what follows.
fn make(report: &mut RunReport, data: &Data, found: Found, motions: &[Motion]) {
    let Some(motion) = motions.first() else { return };
    report.compared.0 = report.compared.1.min(found.compared);
    if !found.agree.is_empty() {
        let best = decide(report, data, &found);
        report.end = Some(at_the_end(data, &best));
        report.drawn = Some(drawn(data, &best));
    } else if let Some(mut motion) = found.motion {
        motion = known_less(motion);
        report.equation = Some(equation(&motion));
        let by = distinguish(data);
        report.maker = Maker::Several { methods: Vec::new(), exact: Some(motion.worst), by };
        report.end = Some(at_the_end(data, &motion));
        report.drawn = Some(drawn(data, &motion));
    } else if let Some((noise, fit)) = noise::of_measured(data, motion) {
        report.equation = Some(equation(&fit));
        report.drawn = Some(drawn(data, &fit));
        report.maker = Maker::Measured { noise };
    } else if motion.fraction < 0.5 {
        // An unknown method's error may look like another force, or like a drag: so the equation is
        // the nearest, and none of its numbers is known.
        let mut fit = motion.fit;
        fit.known_to.fill(f64::INFINITY);
        report.drawn = Some(drawn(data, &fit));
        let nearest = found.near.first().or(found.nearest.as_ref());
        let nearest = nearest.map(|fit| (name(fit), fit.worst));
        report.maker =
            Maker::Unknown { nearest, exact: motion.fit.worst, equation: equation(&fit) };
    }
}

fn look(data: &Data, motions: &[Motion], found: &mut Found) {
    let Some(best) = motions.first() else { return };
    let limit = 10.0 * libm::fmax(best.fit.mean, 0.5);
    for motion in motions.iter().filter(|motion| motion.fit.mean <= limit) {
        search::search(data, motion, found);
        if found.exact || found.many {
            break;
        }
    }
    search::sharpen(data, found);
    // Many that agree, or many steps from row to row, are compared in fewer rows.
    let steps =
        |fit: &Fit| if let Map::Steps(_, steps) = fit.map { f64::from(steps) } else { 20.0 };
    let all: f64 = found.agree.iter().chain(&found.motion).map(steps).sum();
    found.compared = (MOST_STEPS_COMPARED / all).clamp(500.0, MOST_COMPARED as f64) as usize;
    for fit in std::mem::take(&mut found.agree) {
        if let Some(fit) = in_all(data, &fit, found.compared) {
            found.sort_in(fit);
        }
    }
    found.motion = found.motion.and_then(|motion| in_all(data, &motion, found.compared));
    found.motion = found.motion.filter(|motion| motion.worst < search::APART);
    found.exact &= found.motion.is_some();
    found.agree.sort_by(|a, b| a.worst.total_cmp(&b.worst));
}

/// The fit of what agrees in some pairs to all of them, with numbers that are fitted to the worst
/// of them too.
fn in_all(data: &Data, fit: &Fit, most: usize) -> Option<Fit> {
    let older = fit.older();
    let mut all = data.pairs(1, most);
    // The older states of a method of several steps are not there in the first rows.
    all.retain(|pair| pair.rows[0] >= older);
    let mut some: Vec<_> = all.iter().step_by(all.len() / 60 + 1).copied().collect();
    let mut best = *fit;
    let mut least: Option<Fit> = None;
    let damped = best.equation.c != 0.0;
    let numbers = search::active(data, damped, best.equation.drive[2] != 0.0);
    for _ in 0..5 {
        let here = applied(data, &best);
        let off = here.in_bounds(&all);
        let off = off.chunks(data.entries()).map(fit::worst);
        let mut worst: Vec<(f64, fit::Pair)> = off.zip(all.iter().copied()).collect();
        worst.sort_by(|a, b| b.0.total_cmp(&a.0));
        best.worst = worst.first()?.0;
        if least.is_none_or(|least| best.worst < least.worst) {
            least = Some(best);
        }
        if best.worst <= 1.0 || best.worst >= 100.0 {
            break;
        }
        some.extend(worst.iter().take(20).map(|(_, pair)| *pair));
        let known_to = best.known_to;
        let Some(next) = fit::fit(here, &some, &numbers, true) else { break };
        best = Fit { known_to, ..next };
    }
    least
}

fn name(fit: &Fit) -> &'static str {
    match fit.map {
        Map::Exact => "",
        Map::Steps(candidate, _) => candidate.name,
    }
}

/// The method, if it is one, or those that are left.
fn decide(report: &mut RunReport, data: &Data, found: &Found) -> Fit {
    let mut agree = found.agree.clone();
    agree.sort_by_key(search::rank);
    let best = agree[0];
    let mut same = Vec::new();
    let mut others = Vec::new();
    for fit in agree[1..].iter().chain(&found.near) {
        match search::same(data, &best, fit) {
            Some(k) => same.push((name(fit), k)),
            None => others.push(*fit),
        }
    }
    // Mistakes that are another k, far from where the search began.
    if let Map::Steps(_, steps) = best.map {
        same.extend(search::relatives(data, &best, steps));
    }
    same.sort_by(|a, b| a.0.cmp(b.0));
    same.dedup_by(|a, b| a.0 == b.0);
    report.equation = Some(equation(&best));
    // Without velocities methods that differ in nothing but these have the same angles.
    let hidden = !data.has_velocities() && same.iter().any(|(name, _)| is_right(name));
    if others.is_empty() && !found.exact && !found.many && !hidden {
        report.maker = Maker::Method(Box::new(made(data, &best, same)));
        return best;
    }
    let by = distinguish(data);
    let mut methods = vec![made(data, &best, same)];
    let exact = found.motion.filter(|_| found.exact).map(|motion| motion.worst);
    let of = |fit: &Fit| matches!(fit.map, Map::Steps(..)).then(|| made(data, fit, Vec::new()));
    methods.extend(others.iter().filter_map(of));
    let motion = found.motion.filter(|_| found.exact);
    let best = motion.map_or(best, known_less);
    report.equation = Some(equation(&best));
    report.maker = Maker::Several { methods, exact, by };
    best
}

/// What would tell apart methods that are left.
fn distinguish(data: &Data) -> Vec<Distinguish> {
    let mut by = Vec::new();
    if !data.has_velocities() {
        by.push(Distinguish::Velocity);
    }
    let digits = data.half_theta.iter().copied().fold(0.0, f64::max) > 1e-15;
    if digits {
        by.push(Distinguish::Digits);
    }
    by.push(Distinguish::LongerStep);
    if data.row.len() < 50 {
        by.push(Distinguish::Rows);
    }
    by
}

fn is_right(name: &str) -> bool {
    candidates::named(name).is_some_and(|candidate| candidate.right)
}

fn known(value: f64, known_to: f64) -> Known {
    let size = libm::floor(libm::log10(libm::fmax(value.abs(), 1e-300))) as i32;
    let near =
        |digits: i32| Some(rounded(value, digits - size)).filter(|x| (x - value).abs() <= known_to);
    Known { value, known_to, short: (0..17).find_map(near).unwrap_or(value) }
}

fn equation(fit: &Fit) -> FoundEquation {
    let candidates::Equation { force, k, c, drive: [a, b, frequency] } = fit.equation;
    let to = fit.known_to;
    let amplitude = libm::hypot(a, b);
    let drive = (frequency != 0.0).then(|| {
        let of_a = libm::fmax(to[3], to[4]);
        [
            known(amplitude, of_a),
            known(frequency, to[5]),
            known(libm::atan2(-b, a), of_a / amplitude),
        ]
    });
    let damping = (c != 0.0).then(|| known(c, to[1]));
    FoundEquation { force, k: known(k, to[0]), damping, drive }
}

fn made(data: &Data, fit: &Fit, same: Vec<(&'static str, f64)>) -> Made {
    let Map::Steps(candidate, steps) = fit.map else { unreachable!("a candidate's steps") };
    Made {
        name: candidate.name,
        wrong: !candidate.right,
        steps,
        step: data.spacing / f64::from(steps),
        equation: equation(fit),
        off: fit.worst,
        same,
    }
}

/// The state of the first row.
fn start(data: &Data, best: &Fit) -> [f64; 2] {
    let velocity = || {
        let pair = data.pair(0, 1)?;
        applied(data, best).velocity(&pair)
    };
    let omega = data.omega.first().copied().or_else(velocity);
    [data.theta[0], omega.unwrap_or(0.0)]
}

fn drawn(data: &Data, best: &Fit) -> Drawn {
    let rows = data.row.len();
    let here = applied(data, best);
    let (mut z, mut before) = (start(data, best), data.t[0]);
    let mut drawn = Drawn::default();
    for n in 0..rows.min(MOST_DRAWN) {
        let i = n * (rows - 1) / (rows.min(MOST_DRAWN) - 1).max(1);
        let t = data.t[i];
        z = search::exact_end(&best.equation, before, z, t - before);
        before = t;
        let pair = i.checked_sub(if data.has_velocities() { 1 } else { 2 });
        let pair = pair.and_then(|i| data.pair(i, 1)).filter(|pair| pair.rows[2] == i);
        let pair = pair.filter(|pair| pair.rows[0] >= best.older());
        let off = pair.map_or(f64::NAN, |pair| here.in_bounds(&[pair])[0]);
        drawn.t.push(t);
        drawn.theta.push(data.theta[i]);
        drawn.exact.push(z[0]);
        drawn.off.push(off);
    }
    drawn
}

/// What follows from the method that was found.
fn at_the_end(data: &Data, best: &Fit) -> AtTheEnd {
    let (first, last) = (0, data.row.len() - 1);
    let equation = best.equation;
    let time = data.t[last] - data.t[first];
    let start = start(data, best);
    let end = search::exact_end(&equation, data.t[first], start, time);
    let angle = data.theta[last] - end[0];
    let plain = equation.c == 0.0 && equation.drive[2] == 0.0;
    let depth = |theta: f64| match equation.force {
        Force::Sine => Some(2.0 * libm::pow(lanes::sine(0.5 * theta), 2.0)),
        Force::Linear => Some(0.5 * theta * theta),
        _ => None,
    };
    let energy = |z: [f64; 2]| Some(0.5 * z[1] * z[1] + equation.k * depth(z[0])?);
    let energy = data.omega.last().filter(|_| plain).and_then(|omega| {
        let (first, last) = (energy(start)?, energy([data.theta[last], *omega])?);
        (first > 0.0).then(|| (last - first) / first)
    });
    let steps = match best.map {
        Map::Steps(_, steps) => steps,
        Map::Exact => 1,
    };
    let count = libm::round(time / data.spacing) as u64 * u64::from(steps);
    let others = ["stormer-verlet", "rk4"].into_iter().filter_map(|name| {
        let candidate = candidates::named(name)?;
        let count = u32::try_from(count).ok().filter(|&count| count <= 5_000_000)?;
        let h = time / f64::from(count);
        let z = candidate.run(&equation, data.t[first], start, h, count);
        Some((name, z[0] - end[0])).filter(|(_, off)| off.is_finite())
    });
    AtTheEnd { angle, energy, others: others.collect(), time }
}

#[cfg(test)]
mod tests;
