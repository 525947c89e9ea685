//! The coefficients of the processed methods against their order conditions, in the words of
//! `splitting.rs`: kernel, processor and its inverse are exponentials, and their product is a
//! series in words.
//!
//! With A and B the drift and the kick as operators, the Hamiltonian of a bracket follows from {F,
//! G} = ∂F/∂θ ∂G/∂ω − ∂F/∂ω ∂G/∂θ: [A, B] has ωV', [B, [A, B]] has −V'², [A, [A, [A, B]]] has
//! ω³V''', and [B, [A, [A, B]]] has −2ωV'V''.

use pendula::internals::double_double::DoubleDouble;
use pendula::internals::processed::{processed_4, processed_6};
use pendula::systems::Processor;

use super::splitting::{WordSeries, largest, modulo_the_square};

/// The methods that are checked here.
pub const CHECKED: [&str; 2] = ["processed-4", "processed-6"];

/// Series to words of this many letters.
const DEGREE: usize = 7;

fn zero() -> WordSeries {
    (0..=DEGREE).map(|d| vec![DoubleDouble::ZERO; 1 << d]).collect()
}

fn letter(word: usize) -> WordSeries {
    let mut series = zero();
    series[1][word] = DoubleDouble::ONE;
    series
}

fn scaled(series: &WordSeries, by: f64) -> WordSeries {
    let all = series.iter();
    all.map(|words| words.iter().map(|c| *c * DoubleDouble::new(by)).collect()).collect()
}

fn sum(a: &WordSeries, b: &WordSeries) -> WordSeries {
    let add = |(a, b): (&Vec<DoubleDouble>, &Vec<DoubleDouble>)| {
        a.iter().zip(b).map(|(a, b)| *a + *b).collect()
    };
    a.iter().zip(b).map(add).collect()
}

fn product(a: &WordSeries, b: &WordSeries) -> WordSeries {
    let mut series = zero();
    for first in 0..=DEGREE {
        for second in 0..=DEGREE - first {
            for (u, x) in a[first].iter().enumerate().filter(|(_, x)| x.rounded() != 0.0) {
                for (v, y) in b[second].iter().enumerate() {
                    let word = &mut series[first + second][u << second | v];
                    *word = *word + *x * *y;
                }
            }
        }
    }
    series
}

fn bracket(a: &WordSeries, b: &WordSeries) -> WordSeries {
    sum(&product(a, b), &scaled(&product(b, a), -1.0))
}

fn exponential(of: &WordSeries) -> WordSeries {
    let mut series = zero();
    series[0][0] = DoubleDouble::ONE;
    let mut term = series.clone();
    for k in 1..=DEGREE {
        let over = DoubleDouble::ONE / DoubleDouble::new(k as f64);
        term = product(&term, of);
        term.iter_mut().flatten().for_each(|c| *c = *c * over);
        series = sum(&series, &term);
    }
    series
}

/// Kicks with what stands before h² f f' in each, and the drifts between them.
struct Kernel {
    kicks: Vec<(f64, f64)>,
    drifts: Vec<f64>,
}

fn of_order_4() -> (Kernel, Processor) {
    let kicks = vec![(0.0, 0.0), (1.0, processed_4::GRADIENT), (0.0, 0.0)];
    (Kernel { kicks, drifts: vec![0.5, 0.5] }, processed_4::PROCESSOR)
}

fn of_order_6() -> (Kernel, Processor) {
    let (a, b) = (processed_6::DRIFT, processed_6::KICK);
    let outer = (b, processed_6::GRADIENT);
    let kicks = vec![outer, (0.5 - b, 0.0), (0.5 - b, 0.0), outer];
    (Kernel { kicks, drifts: vec![a, 1.0 - 2.0 * a, a] }, processed_6::PROCESSOR)
}

/// The whole step: the processor undone, the kernel, the processor.
fn step(kernel: &Kernel, processor: Processor) -> WordSeries {
    let (a, b) = (letter(0), letter(1));
    let ab = bracket(&a, &b);
    let bab = bracket(&b, &ab);
    let aab = bracket(&a, &ab);
    let (aaab, baab) = (bracket(&a, &aab), bracket(&b, &aab));
    let [linear, mixed, cubic] = processor.coefficients();
    // The generating function Θω + S is the motion in the Hamiltonian S − ½ ∂S/∂Θ ∂S/∂ω, to the
    // fourth power of h: so ωV'V'' stands there with μ − ½λ².
    let mixed = mixed - 0.5 * linear * linear;
    let generator =
        sum(&scaled(&ab, linear), &sum(&scaled(&baab, -0.5 * mixed), &scaled(&aaab, cubic)));
    let mut series = exponential(&scaled(&generator, -1.0));
    let kick = |(kick, gradient): (f64, f64)| {
        // The potential V − ½c V'².
        exponential(&scaled(&sum(&b, &scaled(&bab, 0.5 * gradient)), kick))
    };
    for (i, by) in kernel.drifts.iter().enumerate() {
        series = product(&series, &kick(kernel.kicks[i]));
        series = product(&series, &exponential(&scaled(&a, *by)));
    }
    series = product(&series, &kick(kernel.kicks[kernel.drifts.len()]));
    product(&series, &exponential(&generator))
}

/// By how much the words of each degree up to [`DEGREE`] differ from those of exp(A + B), where the
/// kinetic energy is a square.
fn defects(kernel: &Kernel, processor: Processor) -> Vec<f64> {
    let series = step(kernel, processor);
    let mut factorial = 1.0;
    let mut all = vec![0.0];
    for (degree, words) in series.into_iter().enumerate().skip(1) {
        factorial *= degree as f64;
        let exact = DoubleDouble::ONE / DoubleDouble::new(factorial);
        let differences = words.into_iter().map(|word| word - exact).collect();
        all.push(largest(&if degree < 4 {
            differences
        } else {
            modulo_the_square(differences, degree)
        }));
    }
    all
}

/// Each of some ten coefficients is rounded by 2⁻⁵³ of itself, and none exceeds one; the brackets
/// have at most eight words, with coefficients up to three.
const ROUNDING: f64 = 10.0 * 24.0 * 1.2e-16;

fn check((kernel, processor): (Kernel, Processor), order: usize) {
    let defects = defects(&kernel, processor);
    for (degree, defect) in defects.iter().enumerate().take(order + 1) {
        assert!(*defect < ROUNDING, "{degree}: {defect:e}");
    }
    assert!(defects[order + 1] > 1e-4, "{:e}: more than it claims", defects[order + 1]);
}

/// Every word of up to p kicks and drifts is that of the exact flow, and some word of p + 1 is not.
///
/// Catches: a coefficient of kernel or processor that is off by 2e-13.
#[test]
fn kernel_and_processor_meet_their_order_conditions() {
    check(of_order_4(), 4);
    check(of_order_6(), 6);
}

/// Catches: conditions that any coefficients would meet; a processor whose terms are not looked at.
#[test]
fn every_coefficient_counts() {
    let order = |kernel: &Kernel, processor| {
        let defects = defects(kernel, processor);
        defects.iter().position(|defect| *defect > 1e3 * ROUNDING).unwrap() - 1
    };
    let alone = Processor::new(0.0, 0.0, 0.0);
    assert_eq!(order(&of_order_4().0, alone), 2);
    assert_eq!(order(&of_order_6().0, alone), 2);
    let (kernel, processor) = of_order_6();
    assert_eq!(order(&kernel, processor), 6);
    let [linear, mixed, cubic] = processor.coefficients();
    assert_eq!(order(&kernel, Processor::new(linear + 1e-9, mixed, cubic)), 2);
    assert_eq!(order(&kernel, Processor::new(linear, mixed + 1e-9, cubic)), 4);
    assert_eq!(order(&kernel, Processor::new(linear, mixed, cubic + 1e-9)), 4);
    let mut gradient = of_order_6().0;
    gradient.kicks[0].1 += 1e-9;
    gradient.kicks[3].1 += 1e-9;
    assert_eq!(order(&gradient, processor), 2);
    let mut drift = of_order_6().0;
    drift.drifts = vec![drift.drifts[0] + 1e-9, drift.drifts[1] - 2e-9, drift.drifts[2] + 1e-9];
    assert_eq!(order(&drift, processor), 2);
}
