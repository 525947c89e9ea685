//! What the bits would be if products were fused with sums, as compilers for graphics cards do
//! unless they are told not to.

use pendula::fast::{ReducedPhase, ScaledPendulum};
use pendula::systems::Numbers;
use pendula::{Grid, Method, Pendulum, Phase, StormerVerlet};
use pendula_device::trace::{Place, Tape, Traced, record};

use crate::recorded::values;

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
        let library =
            pendula::integrate_fast(&Pendulum::PAPER, &StormerVerlet, start, &grid, &mut ());
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
