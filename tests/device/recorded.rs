//! What a recording is.

use pendula::arithmetic::number::{Mask, Number};
use pendula_device::trace::{Place, Tape, Traced, Value, record};

/// What the value at `place` is, with these variables.
pub fn evaluate(tape: &Tape, variables: &[f64], place: Place) -> f64 {
    let values = tape.values();
    let of = |place| evaluate(tape, variables, place);
    let is_true = |mask| matches!(values[mask], Value::AtMost(a, b) if of(a) <= of(b));
    match values[place] {
        Value::Variable(index) => variables[index],
        Value::Constant(bits) => f64::from_bits(bits),
        Value::Sum(a, b) => of(a) + of(b),
        Value::Difference(a, b) => of(a) - of(b),
        Value::Product(a, b) => of(a) * of(b),
        Value::Quotient(a, b) => of(a) / of(b),
        Value::Negative(a) => -of(a),
        Value::Size(a) => of(a).abs(),
        Value::WithSign(a, b) => of(a).copysign(of(b)),
        Value::SignedBy(a, b) => of(a).signed_by(of(b)),
        Value::Choice(mask, yes, no) => of(if is_true(mask) { yes } else { no }),
        Value::AtMost(..) | Value::Both(..) | Value::Either(..) => panic!("not a number"),
    }
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
        assert_eq!(places.map(|place| evaluate(&tape, &variables, place).to_bits()), expected);
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
