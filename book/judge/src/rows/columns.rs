//! Which column is what, in which unit, and how exactly it is written.

use core::f64::consts::PI;

use super::lanes::sine;
use super::parse::{Column, Table};
use super::report::{Digits, Read, Refusal, Unit, Used};

/// A run as it was read: time, angle and velocity of each row (s, rad, rad/s).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Run {
    /// The times.
    pub t: Vec<f64>,
    /// The angles.
    pub theta: Vec<f64>,
    /// The velocities; empty if there are none.
    pub omega: Vec<f64>,
    /// Half a unit of the last digit of a time.
    pub half_t: f64,
    /// The same of each angle.
    pub half_theta: Vec<f64>,
    /// The same of each velocity.
    pub half_omega: Vec<f64>,
    /// Whether all numbers are those of single precision, in which they were computed then.
    pub single: bool,
}

/// Words in headings, in some languages.
const TIMES: [&str; 12] = [
    "t",
    "time",
    "times",
    "zeit",
    "temps",
    "tiempo",
    "tempo",
    "tid",
    "czas",
    "sec",
    "seconds",
    "время",
];
const VELOCITIES: [&str; 16] = [
    "omega",
    "ω",
    "vel",
    "speed",
    "dtheta",
    "dθ",
    "thetadot",
    "theta_dot",
    "theta'",
    "θ'",
    "θ̇",
    "geschw",
    "vitesse",
    "velocidad",
    "rate",
    "скорость",
];
const ANGLES: [&str; 11] = [
    "theta",
    "θ",
    "ang",
    "winkel",
    "phi",
    "φ",
    "auslenkung",
    "ángulo",
    "displacement",
    "deflection",
    "угол",
];

/// Chooses the columns.
///
/// # Errors
/// If there is no time, or nothing that changes.
pub fn choose(table: &Table) -> Result<(Read, Run), Refusal> {
    let columns = &table.columns;
    if columns.len() < 2 {
        return Err(if columns.is_empty() { Refusal::NoRows } else { Refusal::OneColumn });
    }
    let time = time(columns).ok_or(Refusal::NoTime)?;
    let unit = |column: &Column| small(&column.heading);
    let milliseconds = ["(ms)", "[ms]", "_ms", " ms", "millis"];
    let scale =
        if milliseconds.iter().any(|x| unit(&columns[time]).contains(x)) { 1e-3 } else { 1.0 };
    let t: Vec<f64> = values(&columns[time]).iter().map(|t| t * scale).collect();
    let (digits, halves) = halves(&columns[time]);
    let half_t = scale * halves.iter().copied().fold(0.0, f64::max);
    let used = |column: usize, digits| {
        let heading = columns[column].heading.clone();
        Used { column: column + 1, heading, digits }
    };
    let mut read = Read {
        rows: t.len(),
        time: used(time, digits),
        angle: used(time, digits),
        height: None,
        velocity: None,
        unit: Unit::Radians,
        velocity_in_radians: false,
        spacing: None,
        spacing_known_to: 0.0,
        lines_left_out: table.left_out,
    };
    let mut run = Run { t, half_t, ..Run::default() };
    let rest: Vec<usize> = (0..columns.len()).filter(|&i| i != time).collect();
    if let Some((x, y)) = coordinates(columns, &rest) {
        let [xs, ys] = [x, y].map(|i| values(&columns[i]));
        let up = ys.iter().filter(|y| y.is_finite()).sum::<f64>() > 0.0;
        let (x_digits, x_halves) = self::halves(&columns[x]);
        let (y_digits, y_halves) = self::halves(&columns[y]);
        for i in 0..xs.len() {
            let down = if up { ys[i] } else { -ys[i] };
            run.theta.push(libm::atan2(xs[i], down));
            // Along the circle a move of the point by its two roundings turns it by no more.
            let size = libm::hypot(xs[i], ys[i]);
            run.half_theta.push(libm::hypot(x_halves[i], y_halves[i]) / size);
        }
        read.angle = used(x, x_digits);
        read.height = Some(used(y, y_digits));
        read.unit = Unit::Coordinates;
        return finish(read, run);
    }
    let (angle, velocity) = angle_and_velocity(columns, &rest, &run.t);
    let (digits, mut half_theta) = self::halves(&columns[angle]);
    read.angle = used(angle, digits);
    run.theta = values(&columns[angle]);
    if let Some(velocity) = velocity {
        let (digits, half_omega) = self::halves(&columns[velocity]);
        read.velocity = Some(used(velocity, digits));
        run.omega = values(&columns[velocity]);
        run.half_omega = half_omega;
    }
    run.single = [Some(angle), velocity].into_iter().flatten().all(|i| is_single(&columns[i]));
    if run.single {
        // What is computed in single precision is known to half its last bit.
        for (xs, halves) in [(&run.theta, &mut half_theta), (&run.omega, &mut run.half_omega)] {
            for (x, half) in xs.iter().zip(halves) {
                *half = libm::fmax(*half, 0.5 * f64::from(f32::EPSILON) * x.abs());
            }
        }
    }
    let degrees = ["deg", "°", "grad)", "grad]"].iter().any(|x| unit(&columns[angle]).contains(x));
    let radians = unit(&columns[angle]).contains("rad") && !degrees;
    if degrees || (!radians && looks_like_degrees(&run)) {
        read.unit = Unit::Degrees;
        let of_radians = slope(&run.t, &run.theta, &run.omega).is_some_and(|x| x > 20.0);
        read.velocity_in_radians = of_radians;
        let turn = |xs: &mut Vec<f64>| xs.iter_mut().for_each(|x| *x *= PI / 180.0);
        turn(&mut run.theta);
        turn(&mut half_theta);
        if !of_radians {
            turn(&mut run.omega);
            turn(&mut run.half_omega);
        }
    }
    run.half_theta = half_theta;
    finish(read, run)
}

fn finish(read: Read, run: Run) -> Result<(Read, Run), Refusal> {
    let mut angles = run.theta.iter().filter(|x| x.is_finite());
    let first = angles.next().copied();
    if angles.all(|&x| Some(x) == first) { Err(Refusal::NoMotion) } else { Ok((read, run)) }
}

fn values(column: &Column) -> Vec<f64> {
    column.cells.iter().map(|cell| cell.value).collect()
}

/// So many numbers do not end with zeros by chance.
const MANY: usize = 20;

/// Whether a column's numbers are all those of single precision, with more digits than it has or in
/// the fewest that read back to them.
fn is_single(column: &Column) -> bool {
    let cells = || column.cells.iter().filter(|cell| cell.value.is_finite() && cell.value != 0.0);
    let long = cells().any(|cell| cell.significant >= 8);
    let is = |cell: &super::parse::Cell| {
        let single = cell.value as f32;
        // The text may end before the number does.
        let unit = libm::pow(10.0, f64::from(-cell.decimals));
        let off = (f64::from(single) - cell.value).abs();
        off <= libm::fmin(unit, 1e-11 * cell.value.abs())
            || single.to_string().parse() == Ok(cell.value)
    };
    long && cells().count() > MANY && cells().all(is)
}

/// Half a unit of the last digit of each number.
///
/// A format with so many decimals has as many in each number, and so has one that drops the zeros
/// at the end in nine of ten: then the unit is that of the most decimals. Otherwise it has so many
/// significant digits, and a number with fewer ends with zeros.
pub fn halves(column: &Column) -> (Digits, Vec<f64>) {
    let cells = || column.cells.iter().filter(|cell| cell.value.is_finite());
    let others = || cells().filter(|cell| cell.value != 0.0);
    // Zeros at the end of all numbers are none of theirs: they were rounded before.
    let zeros = others().map(|cell| cell.zeros).min().unwrap_or(0);
    let zeros = if zeros > 0 && others().count() > MANY { zeros } else { 0 };
    let decimals = cells().map(|cell| cell.decimals).max().unwrap_or(0);
    let significant = cells().map(|cell| cell.significant).max().unwrap_or(0);
    let [mut all, mut full, mut longest] = [0_usize; 3];
    for cell in others() {
        all += 1;
        full += usize::from(cell.decimals == decimals);
        longest += usize::from(cell.significant == significant);
    }
    let (decimals, significant) = (decimals - zeros, significant - zeros);
    // As many with the most decimals as with the most digits: one magnitude, and either is right.
    if full >= longest || full * 10 >= all * 7 && longest * 10 < all * 7 {
        let half = 0.5 * libm::pow(10.0, f64::from(-decimals));
        return (Digits::Decimals(decimals), vec![half; column.cells.len()]);
    }
    let half = |value: f64| {
        let first = libm::floor(libm::log10(value.abs()));
        0.5 * libm::pow(10.0, first - f64::from(significant) + 1.0)
    };
    let halves =
        column.cells.iter().map(|cell| if cell.value == 0.0 { 0.0 } else { half(cell.value) });
    (Digits::Significant(significant), halves.collect())
}

/// In small letters, of the alphabets in which the words above are: all alphabets' letters are some
/// kilobytes, which the page would carry.
fn small(heading: &str) -> String {
    let by = |c: char| match c {
        'A'..='Z' | 'À'..='Þ' | 'Α'..='Ω' | 'А'..='Я' => 32,
        _ => 0,
    };
    heading.chars().map(|c| char::from_u32(c as u32 + by(c)).unwrap_or(c)).collect()
}

/// The heading in small letters, without its unit.
fn bare(column: &Column) -> String {
    let heading = small(&column.heading);
    let end = heading.find(['(', '[', ',', '/']).filter(|&at| at > 0 && !heading.starts_with('d'));
    heading[..end.unwrap_or(heading.len())].trim().to_string()
}

fn time(columns: &[Column]) -> Option<usize> {
    let named = columns.iter().position(|column| {
        let name = bare(column);
        TIMES.contains(&name.as_str()) || name.starts_with("time") || name.starts_with("t_")
    });
    if named.is_some_and(|i| goes_on(&columns[i]).is_some()) {
        return named;
    }
    let even = |i: usize| Some((goes_on(&columns[i])?, i));
    let mut found: Vec<(f64, usize)> = (0..columns.len()).filter_map(even).collect();
    // The numbers of the rows are no time, if there is another column that goes on.
    let counts = |i: usize| values(&columns[i]).windows(2).all(|x| x[1] - x[0] == 1.0);
    if found.len() > 1 && counts(found[0].1) {
        found.remove(0);
    }
    // The first of those that are even to a thousandth, or else the most even.
    let first = found.iter().find(|(uneven, _)| *uneven < 1e-3);
    let most = || found.iter().min_by(|a, b| a.0.total_cmp(&b.0));
    first.or_else(most).map(|&(_, i)| i)
}

/// How unevenly a column goes on, if it does.
fn goes_on(column: &Column) -> Option<f64> {
    let t = values(column);
    let mut steps: Vec<f64> = t.windows(2).map(|x| x[1] - x[0]).filter(|x| x.is_finite()).collect();
    let forward = steps.iter().filter(|&&x| x > 0.0).count();
    let repeated = steps.iter().filter(|&&x| x == 0.0).count();
    if steps.is_empty() || forward * 10 < (steps.len() - repeated) * 9 || forward * 2 < steps.len()
    {
        return None;
    }
    steps.sort_by(f64::total_cmp);
    let middle = steps[steps.len() / 2];
    let mut off: Vec<f64> = steps.iter().map(|x| (x / middle - 1.0).abs()).collect();
    off.sort_by(f64::total_cmp);
    Some(off[off.len() / 2])
}

/// x and y on a circle.
fn coordinates(columns: &[Column], rest: &[usize]) -> Option<(usize, usize)> {
    let named = |name: &str| rest.iter().copied().find(|&i| bare(&columns[i]) == name);
    let angle = |i: &usize| ANGLES.iter().any(|word| bare(&columns[*i]).starts_with(word));
    if rest.iter().any(angle) {
        return None;
    }
    let on_a_circle = |&(x, y): &(usize, usize)| {
        let squares = columns[x].cells.iter().zip(&columns[y].cells);
        let squares: Vec<f64> =
            squares.map(|(x, y)| libm::hypot(x.value, y.value)).filter(|r| r.is_finite()).collect();
        let mean = squares.iter().sum::<f64>() / squares.len() as f64;
        mean > 0.0 && squares.iter().all(|r| (r / mean - 1.0).abs() < 0.02)
    };
    let by_name = named("x").zip(named("y"));
    let two = (rest.len() == 2).then(|| (rest[0], rest[1]));
    by_name.or(two).filter(on_a_circle)
}

fn angle_and_velocity(columns: &[Column], rest: &[usize], t: &[f64]) -> (usize, Option<usize>) {
    let begins = |i: usize, words: &[&str]| {
        let name = bare(&columns[i]);
        words.iter().any(|word| name.contains(word))
    };
    let velocity = rest.iter().copied().find(|&i| {
        let name = bare(&columns[i]);
        begins(i, &VELOCITIES) || name == "v" || name == "w"
    });
    let others = || rest.iter().copied().filter(|&i| Some(i) != velocity);
    let angle = others().find(|&i| begins(i, &ANGLES) && !begins(i, &["acc", "mom"]));
    if let Some(angle) = angle {
        return (angle, velocity.or_else(|| fits(columns, &[angle], rest, t).map(|x| x.1)));
    }
    match fits(columns, rest, rest, t) {
        Some((angle, velocity)) => (angle, Some(velocity)),
        None => (others().next().unwrap_or(rest[0]), velocity.filter(|_| rest.len() > 1)),
    }
}

/// The first two columns of which the second is the rate of the first.
fn fits(columns: &[Column], angles: &[usize], rest: &[usize], t: &[f64]) -> Option<(usize, usize)> {
    let pairs = angles.iter().flat_map(|&a| rest.iter().map(move |&b| (a, b)));
    let is = |&(a, b): &(usize, usize)| {
        let turned =
            |x: f64| [1.0, 2.0, 180.0 / PI, PI / 180.0].iter().any(|y| (x / y - 1.0).abs() < 0.2);
        a != b && slope(t, &values(&columns[a]), &values(&columns[b])).is_some_and(turned)
    };
    pairs.into_iter().find(is)
}

/// What the rate of `angle` is in units of `velocity`, if it is proportional to it at all.
pub fn slope(t: &[f64], angle: &[f64], velocity: &[f64]) -> Option<f64> {
    if velocity.is_empty() {
        return None;
    }
    let [mut rr, mut rv, mut vv] = [0.0; 3];
    for i in 1..t.len() - 1 {
        let rate = (angle[i + 1] - angle[i - 1]) / (t[i + 1] - t[i - 1]);
        // Jumps of an angle that is brought back, a missing cell and the like.
        if rate.is_finite()
            && velocity[i].is_finite()
            && (angle[i + 1] - angle[i - 1]).abs() < 3.0 * range(angle) / 4.0
        {
            rr += rate * rate;
            rv += rate * velocity[i];
            vv += velocity[i] * velocity[i];
        }
    }
    let alike = rv / libm::sqrt(rr * vv);
    (alike > 0.8).then(|| rr / rv)
}

fn range(xs: &[f64]) -> f64 {
    let finite = || xs.iter().copied().filter(|x| x.is_finite());
    finite().fold(f64::NEG_INFINITY, f64::max) - finite().fold(f64::INFINITY, f64::min)
}

/// Whether the second differences fit the sine of degrees, and not that of radians or the angle.
fn looks_like_degrees(run: &Run) -> bool {
    let misfit = |f: fn(f64) -> f64| {
        let [mut aa, mut af, mut ff] = [0.0; 3];
        for i in 1..run.t.len() - 1 {
            let [a, b, c] = [run.theta[i - 1], run.theta[i], run.theta[i + 1]];
            let (bend, force) = (a - 2.0 * b + c, f(b));
            if bend.is_finite() && (a - c).abs() < 180.0 {
                aa += bend * bend;
                af += bend * force;
                ff += force * force;
            }
        }
        1.0 - af * af / (aa * ff)
    };
    let largest =
        run.theta.iter().copied().filter(|x| x.is_finite()).fold(0.0, |a, b| b.abs().max(a));
    let [degrees, radians] = [|x: f64| sine(x * PI / 180.0), sine].map(misfit);
    largest > 3.3 && degrees < 0.1 * radians
}
