//! The tables of the splitting methods against their order conditions, word by word, in twice the
//! digits of f64.

use pendula::internals::double_double::DoubleDouble;
use pendula::methods::splitting::{Splitting, length};
use pendula::methods::{
    BlanesMoan6, BlanesMoanSrkn6b, BlanesMoanSrkn14a, ForestRuth, KahanLi8, Ruth3, Suzuki4,
    Yoshida6, Yoshida8,
};
use pendula::{Info, METHODS, Method, Pendulum};

use super::processed;

/// A step as a series in words of the operators A (drift, bit 0) and B (kick, bit 1):
/// `series[d][w]` is the coefficient of the word of d letters whose bits are w.
pub type WordSeries = Vec<Vec<DoubleDouble>>;

// ANCHOR: words
/// The product of exp(bᵢ B) and exp(aᵢ A), to words of `degree` letters.
fn words<M: Splitting>(degree: usize) -> WordSeries {
    let zero = |d: usize| vec![DoubleDouble::ZERO; 1 << d];
    let mut series: WordSeries = (0..=degree).map(zero).collect();
    series[0][0] = DoubleDouble::ONE;
    let mut append = |letter: usize, coefficient: f64| {
        for d in (1..=degree).rev() {
            for word in 0..1 << d {
                // Σ over the k letters at the end that this exponential adds, of coefficientᵏ/k!.
                let mut term = DoubleDouble::ONE;
                let mut sum = series[d][word];
                for k in 1..=d {
                    if (word >> (k - 1)) & 1 != letter {
                        break;
                    }
                    let factor = DoubleDouble::new(coefficient) / DoubleDouble::new(k as f64);
                    term = term * factor;
                    sum = sum + series[d - k][word >> k] * term;
                }
                series[d][word] = sum;
            }
        }
    };
    for (kick, drift) in M::KICKS.iter().zip(M::DRIFTS) {
        append(1, *kick);
        append(0, *drift);
    }
    append(1, M::KICKS[M::KICKS.len() - 1]);
    series
}
// ANCHOR_END: words

/// The difference of the words of `degree` letters from those of exp(A + B), 1/degree! each.
fn defects<M: Splitting>(degree: usize) -> Vec<DoubleDouble> {
    let factorial = (1..=degree).fold(1.0, |product, k| product * k as f64);
    let exact = DoubleDouble::ONE / DoubleDouble::new(factorial);
    words::<M>(degree).swap_remove(degree).into_iter().map(|word| word - exact).collect()
}

/// Removes from `defects`, of words of `degree` letters, the part that vanishes for a quadratic
/// kinetic energy: multiples of [B, [B, [B, A]]] = BBBA − 3 BBAB + 3 BABB − ABBB, with any letters
/// before and after.
pub fn modulo_the_square(mut defects: Vec<DoubleDouble>, degree: usize) -> Vec<DoubleDouble> {
    const BRACKET: [(usize, f64); 4] =
        [(0b1110, 1.0), (0b1101, -3.0), (0b1011, 3.0), (0b0111, -1.0)];
    let mut ideal: Vec<Vec<DoubleDouble>> = Vec::new();
    for after in 0..=degree.saturating_sub(4) {
        for letters in 0..1 << (degree - 4) {
            let (before, behind) = (letters >> after, letters & ((1 << after) - 1));
            let mut row = vec![DoubleDouble::ZERO; 1 << degree];
            for (word, coefficient) in BRACKET {
                row[(((before << 4) | word) << after) | behind] = DoubleDouble::new(coefficient);
            }
            for known in &ideal {
                row = without(row, known);
            }
            if row.iter().any(|x| x.rounded().abs() > 1e-9) {
                ideal.push(row);
            }
        }
    }
    for row in &ideal {
        defects = without(defects, row);
    }
    defects
}

/// `vector` less its component along `row`.
fn without(vector: Vec<DoubleDouble>, row: &[DoubleDouble]) -> Vec<DoubleDouble> {
    let dot = |a: &[DoubleDouble], b: &[DoubleDouble]| {
        a.iter().zip(b).fold(DoubleDouble::ZERO, |sum, (x, y)| sum + *x * *y)
    };
    let share = dot(&vector, row) / dot(row, row);
    vector.into_iter().zip(row).map(|(x, y)| x - share * *y).collect()
}

/// Each coefficient is an f64, off by 2⁻⁵³ of itself, or printed in 15 digits; a word of d letters
/// has at most d of them, in a sum of products of size Lᵈ/d!, where L is the sum of the sizes of
/// all kicks or of all drifts.
fn tolerance<M: Splitting>(degree: usize) -> f64 {
    let longest = length(M::KICKS).max(length(M::DRIFTS));
    let size = (1..=degree).fold(1.0, |size, k| size * longest / k as f64);
    2.0 * degree as f64 * 2.2e-16 * size
}

pub fn largest(defects: &[DoubleDouble]) -> f64 {
    defects.iter().map(|x| x.rounded().abs()).fold(0.0, f64::max)
}

fn check<M: Splitting + Info>(method: M, kinetic_energy_is_a_square: bool) {
    let (name, order) = (method.info().name, method.info().order as usize);
    for degree in 1..=order {
        let mut defects = defects::<M>(degree);
        if kinetic_energy_is_a_square && degree >= 4 {
            defects = modulo_the_square(defects, degree);
        }
        let (defect, tolerance) = (largest(&defects), tolerance::<M>(degree));
        assert!(defect < tolerance, "{name}, words of {degree}: {defect:.1e}, not {tolerance:.1e}");
    }
    let beyond = largest(&defects::<M>(order + 1));
    assert!(beyond > 10.0 * tolerance::<M>(order + 1), "{name}, {beyond:.1e}: of higher order");
    // The last kick is where the next step's first is, if there is one at all.
    let from_a_drift = M::KICKS[0] == 0.0 && M::KICKS[M::DRIFTS.len()] == 0.0;
    let kicks = M::DRIFTS.len() - usize::from(from_a_drift);
    assert_eq!(method.info().force_evaluations, kicks as u64, "{name}");
    assert_eq!(M::KICKS.len(), M::DRIFTS.len() + 1, "{name}");
}

/// All order conditions of every table, in double-double: a step agrees with the exact flow in
/// every word of up to p kicks and drifts, and differs in some word of p + 1.
///
/// Catches: a coefficient that is off by 2e-13; a table that is not checked, since these and the
/// processed ones are all of the library's splitting methods of order above 2.
#[test]
fn every_table_meets_its_order_conditions() {
    let mut checked = Vec::new();
    macro_rules! check {
        ($($method:expr, $square:literal;)+) => {$(
            check($method, $square);
            checked.push($method.info().name);
        )+};
    }
    check! {
        Ruth3, false;
        ForestRuth, false;
        Suzuki4, false;
        BlanesMoanSrkn6b, false;
        Yoshida6, false;
        BlanesMoan6, true;
        BlanesMoanSrkn14a, true;
        Yoshida8, false;
        KahanLi8, false;
    }
    checked.extend(processed::CHECKED);
    let all = METHODS.iter().map(|method| method.info());
    let splits = all.filter(|of| of.symplectic && !of.implicit && of.order > 2);
    assert_eq!(checked, splits.map(|of| of.name).collect::<Vec<_>>());
}

/// Catches: conditions that any coefficients would meet.
#[test]
fn a_coefficient_off_by_a_millionth_does_not_meet_them() {
    struct Off;
    impl Splitting for Off {
        const KICKS: &'static [f64] = ForestRuth::KICKS;
        const DRIFTS: &'static [f64] =
            &[ForestRuth::DRIFTS[0] + 1e-6, ForestRuth::DRIFTS[1], ForestRuth::DRIFTS[2] - 1e-6];
    }
    assert!(largest(&defects::<Off>(2)) > 1e3 * tolerance::<Off>(2));
}

/// Blanes and Moan's method of order 6 is of order 4 where the kinetic energy is not quadratic.
///
/// Catches: an ideal so large that it removes every defect.
#[test]
fn that_the_kinetic_energy_is_a_square_is_needed() {
    assert!(largest(&defects::<BlanesMoan6>(5)) > 1e3 * tolerance::<BlanesMoan6>(5));
    let defects = modulo_the_square(defects::<Yoshida6>(7), 7);
    assert!(largest(&defects) > 10.0 * tolerance::<Yoshida6>(7));
}

/// By hand: 2w + (2w − 1) for Forest and Ruth's drifts, with w = 1.351; and its kicks are shorter.
///
/// Catches: a backward substep subtracted from the forward ones, so that a run might have more half
/// turns than can be counted.
#[test]
fn steps_backward_count_too() {
    let reach = <ForestRuth as Method<Pendulum>>::REACH;
    assert!((reach - 4.404_828_8).abs() < 1e-6, "{reach}");
    assert!(length(ForestRuth::KICKS) < reach);
}
