//! What a recording is; and what the bits would be if products were fused with sums, as compilers
//! for graphics cards do unless they are told not to.

use pendula::internals::{Mask, Number};
use pendula::internals::{ReducedPhase, ScaledPendulum};
use pendula::{Grid, Method, Pendulum, Phase, StormerVerlet};
use pendula_device::numbers::Numbers;
use pendula_device::trace::{Place, Tape, Traced, Value, record};

/// All values of the tape, of a comparison 1 or 0; products are fused with the sum that they are
/// part of if `fused`.
fn values(tape: &Tape, variables: &[f64], fused: bool) -> Vec<f64> {
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

// -------------------------------------------------------------------------------------------------
// Fused
// -------------------------------------------------------------------------------------------------

/// A step of Störmer–Verlet: what becomes of the numbers of state and carry. The variable 0 is −K.
fn step() -> (Tape, Vec<Place>) {
    let recorded = record(|| {
        let system = ScaledPendulum::from_parameter(Traced::variable(0), f64::NAN);
        let mut index = 0;
        let mut variable = || {
            index += 1;
            Traced::variable(index)
        };
        let state = ReducedPhase::read(&mut variable);
        let mut carry = ReducedPhase::read(&mut variable);
        let state = StormerVerlet.step(&system, 0.0, 1.0, state, &mut carry);
        let mut next = Vec::new();
        state.write(&mut |x: Traced| next.push(x.place()));
        carry.write(&mut |x: Traced| next.push(x.place()));
        next
    });
    recorded.expect("it looks at no number")
}

/// The ends of runs from 1024 starts, one after the other.
fn ends(fused: bool) -> Vec<Phase> {
    let (tape, next) = step();
    let grid = Grid::new(0.01, 1000).expect("positive");
    let end = |i: u32| {
        let start = Phase::at_rest(3.1 * f64::from(i) / 1024.0);
        let scaled = ScaledPendulum::new::<StormerVerlet>(&Pendulum::PAPER, &grid, start)
            .expect("it is run in steps");
        let state = scaled.from_phase(start);
        let carry: ReducedPhase = StormerVerlet.start(&scaled, 0.0, 1.0, state);
        let mut variables = vec![scaled.minus_k()];
        state.write(&mut |x| variables.push(x));
        carry.write(&mut |x| variables.push(x));
        for _ in 0..grid.steps() {
            let values = values(&tape, &variables, fused);
            for (variable, place) in variables[1..].iter_mut().zip(&next) {
                *variable = values[*place];
            }
        }
        let mut numbers = variables[1..].iter().copied();
        scaled.to_phase(ReducedPhase::read(&mut || numbers.next().expect("as many as written")))
    };
    (1..=1024).map(end).collect()
}

/// Without fusing, the record gives the library's ends; with it, four of 1024.
///
/// Catches: a fused multiply-add in the library, which would give two sets of bits.
#[test]
fn fused_products_change_nearly_every_end() {
    let apart = ends(false);
    for (i, end) in (1..=1024).zip(&apart) {
        let start = Phase::at_rest(3.1 * f64::from(i) / 1024.0);
        let grid = Grid::new(0.01, 1000).expect("positive");
        let library = pendula::integrate_fast(&Pendulum::PAPER, &StormerVerlet, start, &grid);
        assert_eq!(*end, library);
    }
    let fused = ends(true);
    let same = apart.iter().zip(&fused).filter(|(apart, fused)| apart == fused).count();
    let largest = apart.iter().zip(&fused).map(|(a, b)| (a.theta - b.theta).abs());
    let largest = largest.fold(0.0, f64::max);
    assert_eq!(same, 4);
    // The roundings of a thousand steps, grown by the shear: 5.26e-12 rad, nearest the top.
    assert!((5.2e-12..5.3e-12).contains(&largest), "{largest:e}");
}
