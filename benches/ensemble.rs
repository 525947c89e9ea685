//! Ten thousand pendulums: `cargo bench --bench ensemble`.
//!
//! The first table is the speed of a step, one trajectory after the other and in lanes, with each
//! set of vector instructions; where the processor lacks them, the baseline runs, and its speed is
//! shown. The second is how many additions, subtractions, multiplications and divisions a second
//! that is, where their number is the same in every step, and what share of the sums and products
//! that wait for nothing, timed in the same rounds. The third is the time in which a method brings
//! every one of the pendulums to an error. All are of one thread.
//!
//! `cargo bench --bench ensemble -- NAME` shows the methods whose name contains NAME.

#[path = "common/machine.rs"]
mod machine;
#[path = "common/threads.rs"]
mod threads;

use std::hint::black_box;

use fearless_simd::{Level, Simd, SimdBase};
use machine::{instructions, seconds};
use pendula::fast::{Ensemble, Instructions};
use pendula::metrics::EndError;
use pendula::{AnyMethod, Grid, METHODS, MethodInfo, Pendulum, Phase};
use pendula_device::method_named;
use threads::with_threads;

/// A multiple of the number of lanes.
const PENDULUMS: u32 = 9984;

/// The shortest of this number of runs is taken, which are spread over the time of the bench.
const ROUNDS: usize = 5;

/// The duration of a run to an error (s).
const DURATION: f64 = 10.0;

const GOALS: [f64; 5] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10];

/// A method of which no run to an error comes to it in this number of evaluations takes no part.
const MOST_EVALUATIONS: u64 = 40_000;

/// Starts spread over θ from −3 to 3 rad and ω from −5 to 5 rad/s, successive ones far apart, so
/// that no branch can be predicted: the multiples of 1/φ and of √2 fill the unit interval evenly.
fn spread() -> Vec<Phase> {
    let spread = |j: u32, irrational: f64| 2.0 * (f64::from(j) * irrational).fract() - 1.0;
    (0..PENDULUMS)
        .map(|j| Phase {
            theta: 3.0 * spread(j, 0.618_033_988_749_894_8),
            omega: 5.0 * spread(j, std::f64::consts::SQRT_2),
        })
        .collect()
}

/// Releases from 0.01 to 3.1 rad.
fn releases() -> Vec<Phase> {
    let last = f64::from(PENDULUMS - 1);
    (0..PENDULUMS).map(|j| Phase::at_rest(0.01 + 3.09 * f64::from(j) / last)).collect()
}

/// Evaluations a step, roughly: an implicit method takes some ten sweeps.
fn evaluations(info: &MethodInfo) -> u64 {
    info.force_evaluations * if info.implicit { 10 } else { 1 }
}

/// The speeds of a method.
struct Speeds {
    /// Millions of steps a second: one after the other, and in lanes of each kind.
    steps: [f64; 4],
    /// The [`bounds`] in the same rounds.
    bounds: [Option<f64>; 3],
}

fn speeds(method: &dyn AnyMethod) -> Speeds {
    let (pendulum, starts) = (Pendulum::PAPER, spread());
    let steps = 1000 / evaluations(&method.info()) + 5;
    let grid = Grid::new(0.01, steps).expect("a positive step");
    let mut ends = vec![Phase::default(); starts.len()];
    let (mut shortest, mut highest) = ([f64::INFINITY; 4], [None; 3]);
    for _ in 0..ROUNDS {
        highest = highest_of(highest, bounds());
        let alone = seconds(|| {
            for (start, end) in black_box(&starts).iter().zip(&mut ends) {
                *end = method.end(&pendulum, *start, black_box(&grid));
            }
            ends[0]
        });
        let mut times = vec![alone];
        for instructions in [Instructions::Baseline, Instructions::Avx2, Instructions::Avx512] {
            let ensemble = Ensemble::new(&pendulum, &starts, grid).with_instructions(instructions);
            times.push(seconds(|| {
                black_box(&ensemble).ends(method, &mut ends);
                ends[0]
            }));
        }
        for (shortest, time) in shortest.iter_mut().zip(times) {
            *shortest = shortest.min(time);
        }
    }
    let steps = shortest.map(|time| 1e-6 * f64::from(PENDULUMS) * steps as f64 / time);
    Speeds { steps, bounds: highest }
}

/// Sums, and products, under way at a time: two units for each, which take three or four cycles,
/// need six or eight. With no operand but themselves they fill the sixteen registers.
const AT_ONCE: usize = 8;

/// So many times each.
const TIMES: usize = 1 << 18;

/// As many sums as products that wait for nothing but the one before in the same register: a
/// second, in 10⁹. No method has more with these instructions.
fn bound<S: Simd>(simd: S) -> f64 {
    let [one, zero] = black_box([1.0, 0.0]);
    let work = || {
        simd.vectorize(
            #[inline(always)]
            || {
                let splat = |x| S::f64s::splat(simd, x);
                let (mut products, mut sums) = ([splat(one); AT_ONCE], [splat(zero); AT_ONCE]);
                for _ in 0..TIMES {
                    for (product, sum) in products.iter_mut().zip(&mut sums) {
                        *product = *product * *product;
                        *sum = *sum + *sum;
                    }
                }
                let all = products.into_iter().chain(sums);
                all.fold(splat(0.0), |all, one| all + one).as_slice()[0]
            },
        )
    };
    let shortest = (0..ROUNDS).map(|_| seconds(work)).fold(f64::INFINITY, f64::min);
    let lanes = S::f64s::splat(simd, 0.0).as_slice().len();
    1e-9 * (2 * AT_ONCE * TIMES * lanes) as f64 / shortest
}

/// The same for each set of instructions, where the processor has it.
fn bounds() -> [Option<f64>; 3] {
    let level = Level::new();
    #[cfg(target_arch = "x86_64")]
    let bounds =
        [level.as_sse2().map(bound), level.as_avx2().map(bound), level.as_avx512().map(bound)];
    #[cfg(not(target_arch = "x86_64"))]
    let bounds = [Some(fearless_simd::dispatch!(level, simd => bound(simd))), None, None];
    bounds
}

/// The higher of two bounds, for each set of instructions.
fn highest_of(some: [Option<f64>; 3], others: [Option<f64>; 3]) -> [Option<f64>; 3] {
    std::array::from_fn(|i| if others[i] > some[i] { others[i] } else { some[i] })
}

/// The shortest time (s) in which every pendulum comes to each of the [`GOALS`].
///
/// A step counts if the next finer one, shorter by √2, also comes there: an error that happens to
/// cross zero does not count.
fn to_errors(method: &dyn AnyMethod, exact: &[EndError], starts: &[Phase]) -> [f64; 5] {
    let pendulum = Pendulum::PAPER;
    let mut ends = vec![Phase::default(); starts.len()];
    let mut run = |steps: u64| {
        let grid = Grid::new(DURATION / steps as f64, steps).expect("a positive step");
        let ensemble = Ensemble::new(&pendulum, starts, grid);
        let time = seconds(|| {
            black_box(&ensemble).ends(method, &mut ends);
            ends[0]
        });
        let error = exact.iter().zip(&ends).map(|(exact, end)| exact.of(*end));
        // A NaN, of an iteration that does not converge, is the largest error.
        (time, error.fold(0.0, |largest: f64, x| if x <= largest { largest } else { x }))
    };
    let mut shortest = [f64::INFINITY; 5];
    let mut before = None;
    for k in 0_i32.. {
        let steps = (10.0 * f64::powi(std::f64::consts::SQRT_2, k)).round() as u64;
        if steps * evaluations(&method.info()) > MOST_EVALUATIONS {
            break;
        }
        let (_, error) = run(steps);
        if let Some((coarser, its_error)) = before.replace((steps, error)) {
            for (goal, shortest) in GOALS.into_iter().zip(&mut shortest) {
                if its_error <= goal && error <= goal && shortest.is_infinite() {
                    let times = (0..ROUNDS).map(|_| run(coarser).0);
                    *shortest = times.fold(f64::INFINITY, f64::min);
                }
            }
        }
        if shortest.iter().all(|time| time.is_finite()) {
            break;
        }
    }
    shortest
}

/// Three digits of a number.
fn digits(x: f64) -> String {
    let decimals = (2.0 - x.log10().floor()).max(0.0) as usize;
    format!("{x:.decimals$}")
}

struct Tables {
    speeds: Vec<(&'static str, Speeds)>,
    times: Vec<(&'static str, [f64; 5])>,
}

fn measure(only: &str) -> Tables {
    let mut tables = Tables { speeds: Vec::new(), times: Vec::new() };
    let starts = releases();
    let exact: Vec<EndError> = starts
        .iter()
        .map(|start| EndError::new(&Pendulum::PAPER, *start, DURATION))
        .collect::<Result<_, _>>()
        .expect("a pendulum's motion");
    for &method in METHODS {
        let info = method.info();
        if info.name.contains(only) {
            tables.speeds.push((info.title, speeds(method)));
            tables.times.push((info.title, to_errors(method, &exact, &starts)));
        }
    }
    tables
}

/// Prints what the speeds are in operations, and how much of the [`bounds`].
fn print_operations(speeds: &[(&'static str, Speeds)]) {
    println!("\nBillions of operations a second, and their share of the last row in its rounds.\n");
    println!("| Method | operations a step | SSE2 | % | AVX2 | % | AVX-512 | % |");
    println!("|---|--:|--:|--:|--:|--:|--:|--:|");
    for (title, Speeds { steps: [_, lanes @ ..], bounds }) in speeds {
        let method = METHODS.iter().find(|method| method.info().title == *title);
        let on_device = method.and_then(|method| method_named(method.info().name));
        let Some(program) = on_device.and_then(|method| (method.program)()) else { continue };
        let cells = lanes.iter().zip(bounds).map(|(speed, bound)| match bound {
            Some(bound) => {
                let done = 1e-3 * speed * program.operations as f64;
                format!("{} | {:.0}", digits(done), 100.0 * done / bound)
            }
            None => "– | –".into(),
        });
        println!(
            "| {title} | {} | {} |",
            program.operations,
            cells.collect::<Vec<_>>().join(" | ")
        );
    }
    let highest = speeds.iter().map(|(_, speeds)| speeds.bounds).fold([None; 3], highest_of);
    let highest =
        highest.map(|bound| bound.map_or("– |".into(), |bound| format!("{} |", digits(bound))));
    println!("| sums and products that wait for nothing | | {} |", highest.join(" | "));
}

fn main() {
    let only = std::env::args().skip(1).find(|argument| !argument.starts_with('-'));
    let Tables { speeds, times } = with_threads(1, || measure(only.as_deref().unwrap_or("")));
    println!("{}\n", instructions());
    println!("Millions of steps a second of one thread, and how many times as fast as alone.\n");
    println!("| Method | alone | SSE2 | × | AVX2 | × | AVX-512 | × |");
    println!("|---|--:|--:|--:|--:|--:|--:|--:|");
    for (title, Speeds { steps: [alone, lanes @ ..], .. }) in &speeds {
        let cells = lanes.map(|speed| format!("{} | {:.1}", digits(speed), speed / alone));
        println!("| {title} | {} | {} |", digits(*alone), cells.join(" | "));
    }
    print_operations(&speeds);
    println!("\nMilliseconds for {PENDULUMS} pendulums, {DURATION} s, to a largest error of\n");
    let goals = GOALS.map(|goal| format!("to $10^{{{}}}$", goal.log10().round()));
    println!("| Method | {} |\n|---{}|", goals.join(" | "), "|--:".repeat(GOALS.len()));
    let quickest: Vec<f64> = (0..GOALS.len())
        .map(|goal| times.iter().map(|(_, time)| time[goal]).fold(f64::INFINITY, f64::min))
        .collect();
    for (title, times) in &times {
        if times.iter().all(|time| time.is_infinite()) {
            continue;
        }
        let cells = times.iter().zip(&quickest).map(|(time, quickest)| match 1e3 * time {
            ms if ms.is_infinite() => "–".into(),
            ms if time == quickest => format!("**{ms:.1}**"),
            ms => format!("{ms:.1}"),
        });
        println!("| {title} | {} |", cells.collect::<Vec<_>>().join(" | "));
    }
}
