//! What a recording is.

use pendula::arithmetic::number::{Mask, Number};
use pendula_device::trace::{Place, Tape, Traced, Value, record};

/// All values of the tape, of a comparison 1 or 0; products are fused with the sum that they are
/// part of if `fused`.
pub fn values(tape: &Tape, variables: &[f64], fused: bool) -> Vec<f64> {
    let mut done: Vec<f64> = Vec::with_capacity(tape.values().len());
    for value in tape.values() {
        let product = |place: Place| match tape.values()[place] {
            Value::Product(x, y) if fused => Some((done[x], done[y])),
            _ => None,
        };
        let x = match *value {
            Value::Variable(index) => variables[index],
            Value::Constant(bits) => f64::from_bits(bits),
            Value::Sum(a, b) => match (product(a), product(b)) {
                (Some((x, y)), _) => x.mul_add(y, done[b]),
                (None, Some((x, y))) => x.mul_add(y, done[a]),
                (None, None) => done[a] + done[b],
            },
            Value::Difference(a, b) => match (product(a), product(b)) {
                (Some((x, y)), _) => x.mul_add(y, -done[b]),
                (None, Some((x, y))) => (-x).mul_add(y, done[a]),
                (None, None) => done[a] - done[b],
            },
            Value::Product(a, b) => done[a] * done[b],
            Value::Quotient(a, b) => done[a] / done[b],
            Value::Negative(a) => -done[a],
            Value::SignedBy(a, b) => f64::from_bits(done[a].to_bits() ^ done[b].to_bits() << 63),
            Value::Size(a) => done[a].abs(),
            Value::WithSign(a, b) => done[a].copysign(done[b]),
            Value::Choice(mask, yes, no) => done[if done[mask] == 1.0 { yes } else { no }],
            Value::AtMost(a, b) => f64::from(done[a] <= done[b]),
            Value::Both(a, b) => done[a].min(done[b]),
            Value::Either(a, b) => done[a].max(done[b]),
        };
        done.push(x);
    }
    done
}

/// All that a number can do.
fn everything<N: Number>(x: N, y: N) -> [N; 10] {
    let (n, rest) = (x * 3.0).half_turns();
    let (sine, cosine) = rest.sine_and_cosine();
    [
        x + y * 2.0 - 0.5,
        x / y + 1.0 / 3.0,
        -x * 1.0,
        (x - y).abs(),
        y.copysign(-x),
        x.signed_by(n + 6_755_399_441_055_744.0),
        N::select(x.at_most(y), x, y),
        rest,
        sine,
        cosine,
    ]
}

/// Catches: operands exchanged, a constant rounded, a product with 1 that loses the number, a
/// choice the wrong way round.
#[test]
fn a_recording_gives_what_the_function_does() {
    let (tape, places) =
        record(|| everything(Traced::variable(0), Traced::variable(1)).map(Traced::place))
            .expect("it looks at no number");
    for variables in [[0.7, 1.9], [-2.5, -3.0], [40.0, 0.1], [-0.0, 5e-324]] {
        let [x, y] = variables;
        let expected = everything(x, y).map(f64::to_bits);
        let values = values(&tape, &variables, false);
        assert_eq!(places.map(|place| values[place].to_bits()), expected);
    }
}

/// Catches: a function whose branch is taken for the only one.
#[test]
fn a_function_that_looks_is_not_recorded() {
    let x = || Traced::variable(0);
    assert!(record(|| x().at_most(x() * 2.0).all()).is_none());
    assert!(record(|| x().largest()).is_none());
    assert!(record(|| x().sine()).is_none());
    // The tape of one recording is not that of the next.
    assert!(record(|| x() + 1.0).is_some());
}
