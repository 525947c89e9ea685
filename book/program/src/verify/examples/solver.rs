// rustc -O solver.rs
/// θ (rad) and ω (rad/s), or how fast they change.
type Pair = [f64; 2];

// Dormand and Prince, as sums over the slopes so far: the stages, of which the last is the new
// state, of order 5; the error of the step; and the last term of an interpolant of order 4.
#[rustfmt::skip]
const STAGES: [&[f64]; 6] = [
    &[1. / 5.],
    &[3. / 40., 9. / 40.],
    &[44. / 45., -56. / 15., 32. / 9.],
    &[19372. / 6561., -25360. / 2187., 64448. / 6561., -212. / 729.],
    &[9017. / 3168., -355. / 33., 46732. / 5247., 49. / 176., -5103. / 18656.],
    &[35. / 384., 0., 500. / 1113., 125. / 192., -2187. / 6784., 11. / 84.],
];
#[rustfmt::skip]
const ERROR: [f64; 7] =
    [71. / 57600., 0., -71. / 16695., 71. / 1920., -17253. / 339200., 22. / 525., -1. / 40.];
#[rustfmt::skip]
const LAST: [f64; 7] = [
    -12715105075. / 11282082432., 0., 87487479700. / 32700410799., -10690763975. / 1880347072.,
    701980252875. / 199316789632., -1453857185. / 822651844., 69997945. / 29380423.,
];

/// Takes steps from z to the time `end`, and tells of each its start, its end and the state at each
/// fraction of it; before them, a step of no length. Times are counted from t₀. Returns the
/// evaluations of the force.
fn walk(
    g_over_l: f64,
    mut z: Pair,
    end: f64,
    tolerance: f64,
    mut tell: impl FnMut(f64, f64, &dyn Fn(f64) -> Pair),
) -> Result<u64, String> {
    if !(g_over_l > 0.0 && (1e-15..1.0).contains(&tolerance)) {
        return Err("g/L must be above 0, and the tolerance from 1e-15 to 1".to_string());
    }
    if ![g_over_l, z[0], z[1], end].iter().all(|x| x.is_finite()) {
        return Err("a number is not finite".to_string());
    }
    tell(0.0, 0.0, &|_| z);
    let slope_at = |[theta, omega]: Pair| [omega, -g_over_l * theta.sin()];
    let units = [1.0, g_over_l.sqrt()];
    let (mut t, mut slope, mut most, mut evaluations) = (0.0, slope_at(z), 10.0, 1);
    let mut h = (tolerance.powf(0.2) / (units[1] + z[1].abs())).copysign(end);
    while t != end {
        if evaluations > 10_000_000 {
            return Err(format!("{evaluations} evaluations do not lead to the end"));
        }
        // The last step is that to the end, and no tiny one is left for it.
        let until = if (1.01 * h).abs() >= (end - t).abs() { end } else { t + h };
        h = until - t;
        let (mut slopes, mut new) = (vec![slope], z);
        let sum = |weights: &[f64], slopes: &[Pair], i: usize| {
            h * weights.iter().zip(slopes).map(|(weight, slope)| weight * slope[i]).sum::<f64>()
        };
        for stage in STAGES {
            new = [0, 1].map(|i| z[i] + sum(stage, &slopes, i));
            slopes.push(slope_at(new));
            evaluations += 1;
        }
        let [of_theta, of_omega] = [0, 1].map(|i| {
            sum(&ERROR, &slopes, i) / (units[i] + z[i].abs().max(new[i].abs())) / tolerance
        });
        let size = of_theta.hypot(of_omega);
        if size <= 1.0 {
            tell(t, until, &|s| {
                [0, 1].map(|i| {
                    let change = new[i] - z[i];
                    let bend = h * slope[i] - change;
                    let twist = change - h * slopes[6][i] - bend;
                    let last = sum(&LAST, &slopes, i);
                    z[i] + s * (change + (1.0 - s) * (bend + s * (twist + (1.0 - s) * last)))
                })
            });
            (t, z, slope) = (until, new, slopes[6]);
            h *= (0.9 * size.max(1e-9).powf(-0.2)).min(most);
            most = 10.0;
        } else {
            // A step after a refused one is no longer.
            h *= (0.9 * size.powf(-0.2)).max(0.2);
            most = 1.0;
        }
    }
    Ok(evaluations)
}

fn solve(numbers: &[f64]) -> Result<String, String> {
    let &[g_over_l, theta, omega, t0, tolerance, ref times @ ..] = numbers else {
        return Err("the numbers are g/L θ ω t₀ tolerance times".to_string());
    };
    let times: Vec<f64> = times.iter().map(|time| time - t0).collect();
    let end = *times.last().ok_or("no time is asked for")?;
    if !times.iter().all(|time| time * end >= 0.0) || !times.is_sorted_by_key(|time| time.abs()) {
        return Err("the times are not in the order of a run".to_string());
    }
    let (mut rows, mut times) = (String::new(), times.iter().peekable());
    let evaluations = walk(g_over_l, [theta, omega], end, tolerance, |t, until, state| {
        while let Some(time) = times.next_if(|time| time.abs() <= until.abs()) {
            let [theta, omega] = state((time - t) / (until - t));
            rows += &format!("{theta:?} {omega:?}\n");
        }
    })?;
    Ok(format!("{rows}done {evaluations}"))
}

fn crossings(numbers: &[f64]) -> Result<String, String> {
    let &[g_over_l, theta, omega, t0, t1, tolerance] = numbers else {
        return Err("the numbers are g/L θ ω t₀ t₁ tolerance".to_string());
    };
    let (mut rows, mut z) = (String::new(), [theta, omega]);
    let evaluations = walk(g_over_l, z, t1 - t0, tolerance, |t, until, state| {
        // A long step may pass zero twice.
        for eighth in 0..8 {
            let [mut low, mut high] = [eighth, eighth + 1].map(|k| f64::from(k) / 8.0);
            let before = z[0];
            z = state(high);
            if (before < 0.0 && z[0] >= 0.0) || (before > 0.0 && z[0] <= 0.0) {
                for _ in 0..60 {
                    let middle = (low + high) / 2.0;
                    let is_before = before * state(middle)[0] > 0.0;
                    *(if is_before { &mut low } else { &mut high }) = middle;
                }
                let ([theta, omega], t) = (state(high), t0 + t + high * (until - t));
                rows += &format!("{t:?} {theta:?} {omega:?}\n");
            }
        }
    })?;
    Ok(format!("{rows}done {evaluations}"))
}

fn main() {
    for line in std::io::stdin().lines().map_while(Result::ok) {
        let (word, numbers) = line.split_once(' ').unwrap_or((&line, ""));
        let numbers = numbers.split_whitespace().map(str::parse);
        let numbers: Result<Vec<f64>, _> = numbers.collect();
        let answer = match (word, numbers) {
            ("bye", _) => break,
            ("hello", _) => Ok("hello 1 my solver".to_string()),
            ("solve", Ok(numbers)) => solve(&numbers),
            ("crossings", Ok(numbers)) => crossings(&numbers),
            ("solve" | "crossings", Err(why)) => Err(why.to_string()),
            _ => Ok("unsupported".to_string()),
        };
        println!("{}", answer.unwrap_or_else(|why| format!("error {why}")));
    }
}
