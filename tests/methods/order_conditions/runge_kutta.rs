//! The tables of Dormand and Prince's methods against their order conditions, one for each rooted
//! tree, in twice the digits of f64 from the numbers as they are written. What the code makes of
//! them is known from `known_answers.rs`, and of dense output from `adaptive`.
//!
//! A tree τ with the subtrees τ₁ … τₘ is the equation ẏ_τ = y_τ₁ … y_τₘ. From zero its solution is
//! tⁿ/γ(τ), for n vertices, and a Runge–Kutta method is of order p if it is exact for every tree of
//! up to p vertices (Hairer, Nørsett, Wanner, *Solving Ordinary Differential Equations I*, Theorem
//! II.2.13).

use std::collections::BTreeMap;

use pendula::internals::double_double::DoubleDouble;
use pendula::internals::runge_kutta::dop853::{self};
use pendula::internals::runge_kutta::dormand_prince::{self};
use pendula::internals::runge_kutta::{Coefficient, Row, Tableau};
use rstest::rstest;

// -------------------------------------------------------------------------------------------------
// Trees
// -------------------------------------------------------------------------------------------------

struct Tree {
    vertices: usize,
    /// The indices of the subtrees.
    subtrees: Vec<usize>,
    /// γ.
    density: f64,
}

/// All rooted trees of up to `most` vertices, the smaller ones first.
fn trees(most: usize) -> Vec<Tree> {
    let mut trees = vec![Tree { vertices: 1, subtrees: vec![], density: 1.0 }];
    for vertices in 2..=most {
        let smaller = trees.len();
        let mut forests = vec![];
        grow(&trees[..smaller], vertices - 1, smaller, &mut vec![], &mut forests);
        for subtrees in forests {
            let density =
                subtrees.iter().fold(vertices as f64, |product, &tau| product * trees[tau].density);
            trees.push(Tree { vertices, subtrees, density });
        }
    }
    trees
}

/// Finds every multiset of trees with indices below `before` that has `vertices` vertices in all,
/// and appends each, after those in `chosen`, to `found`.
fn grow(
    trees: &[Tree],
    vertices: usize,
    before: usize,
    chosen: &mut Vec<usize>,
    found: &mut Vec<Vec<usize>>,
) {
    if vertices == 0 {
        found.push(chosen.clone());
        return;
    }
    for tau in (0..before).filter(|&tau| trees[tau].vertices <= vertices) {
        chosen.push(tau);
        grow(trees, vertices - trees[tau].vertices, tau + 1, chosen, found);
        chosen.pop();
    }
}

/// OEIS A000081. Catches: a tree forgotten or generated twice, and its condition with it.
#[test]
fn no_tree_is_forgotten() {
    let trees = trees(9);
    let count = |n| trees.iter().filter(|tree| tree.vertices == n).count();
    assert_eq!((1..=9).map(count).collect::<Vec<_>>(), [1, 1, 2, 4, 9, 20, 48, 115, 286]);
    let sum: f64 = trees.iter().filter(|t| t.vertices == 4).map(|t| 1.0 / t.density).sum();
    // 1/4 + 1/8 + 1/12 + 1/24.
    assert!((sum - 0.5).abs() < 1e-15);
}

// -------------------------------------------------------------------------------------------------
// The tables, with all their digits
// -------------------------------------------------------------------------------------------------

/// A number of a table, and by how much the digits that are not printed may change it.
#[derive(Clone, Copy)]
struct Printed {
    value: DoubleDouble,
    half_digit: f64,
}

/// A number with fewer digits than this is exact: 0.0371 is 371/10000. The others are printed to 28
/// digits or more.
const ALL_DIGITS: usize = 20;

/// Reads a fraction, or a decimal number.
fn read(coefficient: &Coefficient) -> Printed {
    let parts: Vec<Printed> = coefficient.written.split('/').map(decimal).collect();
    match parts[..] {
        [number] => number,
        [numerator, denominator] => {
            assert_eq!((numerator.half_digit, denominator.half_digit), (0.0, 0.0));
            Printed { value: numerator.value / denominator.value, half_digit: 0.0 }
        }
        _ => panic!("{} is no number", coefficient.written),
    }
}

fn decimal(written: &str) -> Printed {
    let ten = DoubleDouble::new(10.0);
    let written = written.replace(['_', ' '], "");
    let (mantissa, exponent) = written.split_once('e').unwrap_or((&written, "0"));
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let power = exponent.parse::<i32>().unwrap() - fraction.len() as i32;
    let digits = [whole.trim_start_matches('-'), fraction].concat();
    let integer = digits.bytes().fold(DoubleDouble::ZERO, |sum, digit| {
        sum * ten + DoubleDouble::new(f64::from(digit - b'0'))
    });
    let scale = (0..power.abs()).fold(DoubleDouble::ONE, |product, _| product * ten);
    let size = if power < 0 { integer / scale } else { integer * scale };
    let value = if whole.starts_with('-') { -size } else { size };
    let exact = digits.len() < ALL_DIGITS;
    Printed { value, half_digit: if exact { 0.0 } else { 0.5 / scale.rounded() } }
}

/// The weights of a sum over stages, by stage index.
type Weights = BTreeMap<usize, Printed>;

/// A method as given by its tables.
#[derive(Clone)]
struct Table {
    names: Vec<&'static str>,
    stages: Vec<Weights>,
    nodes: Vec<Printed>,
    sums: BTreeMap<&'static str, Weights>,
}

impl Table {
    fn new() -> Self {
        let zero = Printed { value: DoubleDouble::ZERO, half_digit: 0.0 };
        let (names, stages, nodes) = (vec!["k1"], vec![Weights::new()], vec![zero]);
        Self { names, stages, nodes, sums: BTreeMap::new() }
    }

    fn weights(&self, row: &Row) -> Weights {
        let number = |name| self.names.iter().position(|known| known == name).expect("a stage");
        row.terms.iter().map(|(name, coefficient)| (number(name), read(coefficient))).collect()
    }

    fn with(mut self, stages: &[Row], sums: &[Row]) -> Self {
        for row in stages {
            let weights = self.weights(row);
            self.stages.push(weights);
            self.nodes.push(read(&row.node.expect("a stage has a time")));
            self.names.push(row.name);
        }
        for row in sums {
            let weights = self.weights(row);
            self.sums.insert(row.name, weights);
        }
        self
    }

    fn dormand_prince() -> Self {
        let table = &dormand_prince::TABLEAU;
        Self::new().with(table.stages, table.sums)
    }

    fn dop853() -> Self {
        let (step, dense) = (&dop853::STEP, &dop853::DENSE);
        let one = Coefficient { value: 1.0, written: "1.0" };
        let end = Row { name: "k13", node: Some(one), terms: step.sums[0].terms };
        assert_eq!((step.known, step.sums[0].name), (&["k1"][..], "step"));
        let more: Vec<Row> = dense
            .sums
            .iter()
            .map(|row| match row.name {
                // The error estimate has this name too.
                "fifth" => Row { name: "dense fifth", ..*row },
                _ => *row,
            })
            .collect();
        Self::new().with(step.stages, step.sums).with(&[end], &[]).with(dense.stages, &more)
    }

    /// For each tree and stage the elementary weight, and its size if nothing cancelled.
    fn elementary(&self, trees: &[Tree]) -> Vec<Vec<(DoubleDouble, f64)>> {
        let mut table: Vec<Vec<(DoubleDouble, f64)>> = vec![];
        for tree in trees {
            let weight = |stage: &Weights| {
                tree.subtrees.iter().fold((DoubleDouble::ONE, 1.0), |(product, size), &tau| {
                    let (sum, bound) = total(stage, &table[tau]);
                    (product * sum, size * bound)
                })
            };
            let row = self.stages.iter().map(weight).collect();
            table.push(row);
        }
        table
    }

    /// The largest relative error of its printed numbers.
    fn coarseness(&self) -> f64 {
        let rows = self.stages.iter().chain(self.sums.values());
        rows.flat_map(|row| row.values())
            .map(|a| a.half_digit / a.value.rounded().abs())
            .fold(0.0, f64::max)
    }

    /// The weights of the dense output at the fraction `s` of the step, from the three coefficients
    /// that match it to both ends and those in `more`.
    fn dense(&self, s: DoubleDouble, end: &str, more: &[&str]) -> Weights {
        let unit = |name: &str| {
            let number = self.names.iter().position(|known| *known == name).unwrap();
            Weights::from([(number, Printed { value: DoubleDouble::ONE, half_digit: 0.0 })])
        };
        let minus = -DoubleDouble::ONE;
        let first = self.sums["step"].clone();
        let second = plus(&unit("k1"), &first, minus);
        let third = plus(&plus(&first, &unit(end), minus), &second, minus);
        let mut coefficients = vec![first, second, third];
        coefficients.extend(more.iter().map(|name| self.sums[name].clone()));
        let mut sum = Weights::new();
        for (i, coefficient) in coefficients.iter().enumerate().rev() {
            let factor = if i % 2 == 0 { DoubleDouble::ONE - s } else { s };
            sum = plus(coefficient, &sum, factor);
        }
        plus(&Weights::new(), &sum, s)
    }
}

/// x + factor · y.
fn plus(x: &Weights, y: &Weights, factor: DoubleDouble) -> Weights {
    let mut sum = x.clone();
    for (&stage, b) in y {
        let zero = Printed { value: DoubleDouble::ZERO, half_digit: 0.0 };
        let term = sum.entry(stage).or_insert(zero);
        term.value = term.value + b.value * factor;
        term.half_digit += b.half_digit * factor.rounded().abs();
    }
    sum
}

/// Σ bᵢ φᵢ, and Σ |bᵢ| |φᵢ|.
fn total(row: &Weights, of_stages: &[(DoubleDouble, f64)]) -> (DoubleDouble, f64) {
    row.iter().fold((DoubleDouble::ZERO, 0.0), |(sum, size), (&stage, b)| {
        let (weight, bound) = of_stages[stage];
        (sum + b.value * weight, size + b.value.rounded().abs() * bound)
    })
}

/// 2⁻¹⁰⁴, the relative error of an operation on double-doubles.
const UNIT: f64 = 4.93e-32;

/// By how much the condition of a tree may fail: each of its vertices contributes one printed
/// number, and a sum over up to 16 stages of a few operations each. The weights themselves may be
/// sums whose numbers cancel, but whose unprinted digits do not.
fn allowed(table: &Table, tree: &Tree, row: &Weights, of_stages: &[(DoubleDouble, f64)]) -> f64 {
    let (_, size) = total(row, of_stages);
    let of_weights: f64 = row.iter().map(|(&stage, b)| b.half_digit * of_stages[stage].1).sum();
    tree.vertices as f64 * (table.coarseness() + 50.0 * UNIT) * size + of_weights
}

/// The order of `row`, whose sum for each tree should be `right` at t = s: the number of vertices
/// of the smallest tree that fails, less one; and by how much it fails.
fn order_and_failure(
    table: &Table,
    row: &Weights,
    s: DoubleDouble,
    right: impl Fn(&Tree, DoubleDouble) -> DoubleDouble,
) -> (usize, f64) {
    let trees = trees(9);
    let elementary = table.elementary(&trees);
    for (tree, of_stages) in trees.iter().zip(&elementary) {
        let (sum, _) = total(row, of_stages);
        let power = (0..tree.vertices).fold(DoubleDouble::ONE, |product, _| product * s);
        let failure = (sum - right(tree, power)).rounded().abs();
        if failure > allowed(table, tree, row, of_stages) {
            return (tree.vertices - 1, failure);
        }
    }
    (9, 0.0)
}

/// The order of `row`. A failure of less than 1e-9 means a wrong digit and not a lower order, and
/// panics.
fn order(
    table: &Table,
    row: &Weights,
    s: DoubleDouble,
    right: impl Fn(&Tree, DoubleDouble) -> DoubleDouble,
) -> usize {
    let (order, failure) = order_and_failure(table, row, s, right);
    assert!(failure > 1e-9, "{failure:e} is too small for a wrong order: a wrong digit");
    order
}

fn solution(tree: &Tree, power: DoubleDouble) -> DoubleDouble {
    power / DoubleDouble::new(tree.density)
}

/// Catches: a wrong digit among the 28 or more that are printed, in a stage or in the weights; an
/// order claimed too high.
#[rstest]
#[case::dormand_prince(Table::dormand_prince(), 5)]
#[case::dop853(Table::dop853(), 8)]
fn the_step_has_its_order_for_every_tree(#[case] table: Table, #[case] expected: usize) {
    assert_eq!(order(&table, &table.sums["step"], DoubleDouble::ONE, solution), expected);
}

/// An error estimate is zero for all trees up to the order of the embedded method.
///
/// Catches: a wrong digit in an estimate; an estimate of too high an order, which misses errors, or
/// of too low an order, which reports one everywhere.
#[rstest]
#[case::dormand_prince(Table::dormand_prince(), "error", 4)]
#[case::dop853(Table::dop853(), "fifth", 5)]
#[case::dop853_other(Table::dop853(), "other_fifth", 5)]
fn the_estimate_has_the_order_of_the_method_within(
    #[case] table: Table,
    #[case] name: &str,
    #[case] expected: usize,
) {
    let nothing = |_: &Tree, _| DoubleDouble::ZERO;
    assert_eq!(order(&table, &table.sums[name], DoubleDouble::ONE, nothing), expected);
}

/// The number of symmetries σ of a tree: k! for each k equal subtrees, and those of its subtrees.
fn symmetries(trees: &[Tree], tree: &Tree) -> f64 {
    // Of k equal subtrees the first has k of them from there on, the next k − 1, …
    let from = |i: usize| tree.subtrees[i..].iter().filter(|&&tau| tau == tree.subtrees[i]).count();
    (0..tree.subtrees.len())
        .map(|i| from(i) as f64 * symmetries(trees, &trees[tree.subtrees[i]]))
        .product()
}

/// The error of a step has the terms h⁶ r(τ)/σ(τ) F(τ) for the trees of six vertices, where r is by
/// how much the condition fails (Hairer, Nørsett, Wanner, Theorem II.3.2). Those of DOP853's two
/// differences of order 5 are orthogonal vectors of the same length.
///
/// Catches: a second estimate that is a multiple of the first, and vanishes with it; one that is
/// larger, and shortens all steps, or smaller, and is never heard.
#[test]
fn the_two_estimates_of_order_5_cannot_vanish_together() {
    let table = Table::dop853();
    let trees = trees(6);
    let elementary = table.elementary(&trees);
    let product = |x: &str, y: &str| {
        let of_tree = |(tree, weights): (&Tree, &Vec<_>)| {
            let error = |name: &str| {
                total(&table.sums[name], weights).0.rounded() / symmetries(&trees, tree)
            };
            if tree.vertices == 6 { error(x) * error(y) } else { 0.0 }
        };
        trees.iter().zip(&elementary).map(of_tree).sum::<f64>()
    };
    let [one, other] = ["fifth", "other_fifth"].map(|name| product(name, name));
    // 28 digits, of which three cancel, in sums rounded to f64.
    assert!(one > 1e-9 && (other / one - 1.0).abs() < 1e-13, "{one:e}, {other:e}");
    assert!((product("fifth", "other_fifth") / one).abs() < 1e-13);
}

/// Catches: a wrong digit in the weights of order 3.
#[test]
fn the_third_order_within_has_it() {
    let table = Table::dop853();
    assert_eq!(order(&table, &table.sums["third"], DoubleDouble::ONE, solution), 3);
}

/// Dense output is exact for every tree up to its order, at more times than a polynomial of its
/// degree has coefficients.
///
/// Catches: a wrong digit in the stages and weights of dense output, in any of its coefficients; an
/// order claimed too high.
#[rstest]
#[case::dormand_prince(Table::dormand_prince(), "k7", &["fourth"], 4)]
#[case::dop853(Table::dop853(), "k13", &["fourth", "dense fifth", "sixth", "seventh"], 7)]
fn dense_output_has_its_order_at_every_time(
    #[case] table: Table,
    #[case] end: &str,
    #[case] more: &[&str],
    #[case] expected: usize,
) {
    for ninth in 1..9 {
        let s = DoubleDouble::new(f64::from(ninth)) / DoubleDouble::new(9.0);
        assert_eq!(order(&table, &table.dense(s, end, more), s, solution), expected, "{ninth}/9");
    }
}

/// Each number in turn is changed in its 20th digit, four beyond those of an f64, and a condition
/// must fail: a test of the tests above. (DOP853's numbers are printed to 28 digits or more; but
/// some have little influence, and many cancel.)
///
/// Catches: tolerances so wide that a wrong digit passes; a number that no condition depends on.
#[rstest]
#[case::dormand_prince(Table::dormand_prince(), "k7", &["fourth"], 4)]
#[case::dop853(Table::dop853(), "k13", &["fourth", "dense fifth", "sixth", "seventh"], 7)]
fn every_digit_counts(
    #[case] table: Table,
    #[case] end: &str,
    #[case] more: &[&'static str],
    #[case] expected: usize,
) {
    let s = DoubleDouble::new(0.375);
    let spoil = |number: Option<&mut Printed>| {
        let number = number.expect("a number of the table");
        number.value = number.value * (DoubleDouble::ONE + DoubleDouble::new(1e-20));
    };
    let is_seen = |table: &Table| {
        order_and_failure(table, &table.dense(s, end, more), s, solution).0 < expected
    };
    for stage in 1..table.stages.len() {
        for other in table.stages[stage].keys() {
            let mut table = table.clone();
            spoil(table.stages[stage].get_mut(other));
            assert!(is_seen(&table), "{}, {}", table.names[stage], table.names[*other]);
        }
    }
    for name in more {
        for stage in table.sums[name].keys() {
            let mut table = table.clone();
            spoil(table.sums.get_mut(name).expect("a sum").get_mut(stage));
            assert!(is_seen(&table), "{name}, {}", table.names[*stage]);
        }
    }
}

/// Catches: a stage time that is not the sum of its row, which an autonomous system never uses.
#[rstest]
#[case::dormand_prince(Table::dormand_prince())]
#[case::dop853(Table::dop853())]
fn each_stage_is_taken_at_the_sum_of_its_row(#[case] table: Table) {
    let ones = vec![(DoubleDouble::ONE, 1.0); table.stages.len()];
    for ((name, row), c) in table.names.iter().zip(&table.stages).zip(&table.nodes) {
        let (sum, size) = total(row, &ones);
        let off = (sum - c.value).rounded().abs();
        assert!(off <= (table.coarseness() + 50.0 * UNIT) * size + c.half_digit, "{name}: {off:e}");
    }
}

// -------------------------------------------------------------------------------------------------
// How far a table reaches
// -------------------------------------------------------------------------------------------------

/// Catches: coefficients that cancel; a row, or the sums, omitted.
#[test]
fn a_table_reaches_as_far_as_its_longest_row() {
    const fn of(value: f64) -> Coefficient {
        Coefficient { value, written: "" }
    }
    const fn row(terms: &'static [(&'static str, Coefficient)]) -> Row {
        Row { name: "", node: None, terms }
    }
    const STAGES: &[Row] = &[
        row(&[("k1", of(1.0))]),
        row(&[("k1", of(-4.0)), ("k2", of(3.5))]),
        row(&[("k1", of(1.0)), ("k2", of(1.0)), ("k3", of(-1.0))]),
    ];
    const SUMS: &[Row] = &[row(&[("k1", of(0.5)), ("k4", of(0.25))])];
    let reach = |stages, sums| Tableau { known: &["k1"], stages, sums }.reach();
    assert_eq!(reach(STAGES, SUMS), 7.5);
    assert_eq!(reach(SUMS, STAGES), 7.5);
    assert_eq!(reach(&[], SUMS), 0.75);
    // Its fifth stage: 19372/6561 + 25360/2187 + 64448/6561 + 212/729.
    let dormand_prince = dormand_prince::TABLEAU.reach();
    assert!((dormand_prince - 161_808.0 / 6561.0).abs() < 1e-14, "{dormand_prince}");
}
