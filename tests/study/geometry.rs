//! The drawings of a step show the method's own kicks, drifts and slopes, to the last bit, and the
//! level curves of symplectic Euler's modified energy are level.

use pendula::methods::{
    ForwardEuler, PositionVerlet, Rk4, StormerVerlet, Suzuki4, SymplecticEuler,
};
use pendula::{AnyMethod, Grid, Method, Pendulum, Phase, System, integrate};
use pendula_study::experiments::level_curves::{ORDERS, THETA_0, TILTED_STEP, tilted};
use pendula_study::experiments::parts::{Kind, Noting, Parts};
use pendula_study::theory::Dimensionless;
use pendula_study::theory::symplectic_euler::correction_to_order;
use rstest::rstest;

const STEP: f64 = 0.35;

fn pendulum() -> Pendulum {
    Pendulum::new(9.81, 1.3, 0.7).unwrap()
}

/// Below and above the horizontal, moving, at rest, and where there is no force.
fn starts() -> [Phase; 5] {
    let at = |theta, omega| Phase { theta, omega };
    [at(-1.2, 1.0), at(2.5, -0.3), at(1.0, 0.0), at(0.0, 2.0), at(0.0, 0.0)]
}

/// A step, with its slopes followed for a quarter of it.
fn parts<M: for<'a> Method<Noting<'a, Pendulum>>>(method: &M, start: Phase) -> Parts<Phase> {
    Parts::of(method, &pendulum(), start, STEP, 0.25 * STEP).expect("a few parts")
}

/// Catches: a drawing that does not end where the method's step does, to the bit; arrows that do
/// not begin where the one before ends; a kick of the next step drawn in this one; a slope that is
/// not the rate where it begins.
#[rstest]
#[case::forward_euler(ForwardEuler)]
#[case::symplectic_euler(SymplecticEuler)]
#[case::rk4(Rk4)]
#[case::stormer_verlet(StormerVerlet)]
fn the_parts_lead_to_the_methods_own_end<M>(#[case] method: M)
where
    M: AnyMethod + Method<Pendulum> + for<'a> Method<Noting<'a, Pendulum>>,
{
    for start in starts() {
        let taken = parts(&method, start);
        let grid = Grid::new(STEP, 1).unwrap();
        assert_eq!(taken.end, integrate(&pendulum(), &method, start, &grid));
        let mut at = start;
        for part in taken.in_order() {
            if part.kind == Kind::Slope {
                assert_eq!(part.to, part.from + pendulum().rate(0.0, part.from) * (0.25 * STEP));
            } else {
                assert_eq!(part.from, at);
                at = part.to;
            }
        }
        let splits = taken.in_order().all(|part| part.kind != Kind::Slope);
        assert_eq!(at, if splits { taken.end } else { start }, "{taken:?}");
    }
}

/// Catches: a part that is lost or counted twice; kick and drift exchanged; half a kick labelled as
/// a whole one; of a method with many parts the first few.
#[test]
fn the_parts_are_those_of_the_equations() {
    let (kick, drift) = (Kind::Kick, Kind::Drift);
    let of = |parts: Parts<Phase>| -> Vec<_> {
        parts.in_order().map(|part| (part.kind, part.duration)).collect()
    };
    let (half, slope) = (0.5 * STEP, (Kind::Slope, 0.25 * STEP));
    for start in starts() {
        assert_eq!(of(parts(&ForwardEuler, start)), [slope]);
        assert_eq!(of(parts(&Rk4, start)), [slope; 4]);
        assert_eq!(of(parts(&SymplecticEuler, start)), [(kick, STEP), (drift, STEP)]);
        assert_eq!(of(parts(&StormerVerlet, start)), [(kick, half), (drift, STEP), (kick, half)]);
        assert_eq!(of(parts(&PositionVerlet, start)), [(drift, half), (kick, STEP), (drift, half)]);
        assert!(Parts::of(&Suzuki4, &pendulum(), start, STEP, STEP).is_none());
    }
}

/// Catches: an arrow that does not start where the slope was evaluated; stages out of order.
#[test]
fn the_slopes_are_those_of_the_equations() {
    let rate = |z| pendulum().rate(0.0, z);
    for start in starts() {
        let euler: Vec<Phase> = parts(&ForwardEuler, start).in_order().map(|k| k.from).collect();
        assert_eq!(euler, [start]);

        let rk4 = parts(&Rk4, start);
        let at: Vec<Phase> = rk4.in_order().map(|k| k.from).collect();
        let [z1, z2, z3, z4] = at[..] else { panic!("four slopes: {rk4:?}") };
        let ([k1, k2, k3, k4], half) = ([z1, z2, z3, z4].map(rate), STEP / 2.0);
        assert_eq!([z1, z2], [start, start + k1 * half]);
        assert_eq!([z3, z4], [start + k2 * half, start + k3 * STEP]);
        assert_eq!(rk4.end, start + (k1 + k2 * 2.0 + k3 * 2.0 + k4) * (STEP / 6.0));
    }
}

/// H̃ to this order, in units of m g L.
fn modified_energy(order: usize, z: Phase) -> f64 {
    let x = Pendulum::PAPER.small_angle_frequency() * TILTED_STEP;
    let z = Dimensionless::from_phase(&Pendulum::PAPER, z);
    z.energy() + correction_to_order(order, z, x)
}

/// How much H̃ to this order changes along these states.
fn change(order: usize, states: &[Phase]) -> f64 {
    let values = states.iter().map(|z| modified_energy(order, *z));
    let (low, high) = values.fold((f64::MAX, f64::MIN), |(l, h), e| (l.min(e), h.max(e)));
    high - low
}

/// A curve is found by Newton's iteration, to rounding: 1e-12 is ten thousand roundings of a H̃ of
/// about 1/2. Along the method's points H changes as x, H̃ with one term as x², and with seven as
/// x⁸, where x is 0.78 and the coefficients fall too: a factor of 4 for each is little.
///
/// Catches: a curve of another order than it says, or of another step; one through another start;
/// terms that do not come nearer to the method's points.
#[test]
fn each_curve_is_level_and_through_the_start() {
    let run = tilted();
    assert_eq!(run.curves.len(), ORDERS.len());
    let start = Phase::at_rest(THETA_0);
    for (order, curve) in ORDERS.into_iter().zip(&run.curves) {
        assert!(change(order, curve) < 1e-12, "{order}: {:e}", change(order, curve));
        let off = modified_energy(order, curve[0]) - modified_energy(order, start);
        assert!(off.abs() < 1e-12, "{order}: {off:e}");
    }
    let [none, one, seven] = ORDERS.map(|order| change(order, &run.points));
    assert!(one < none / 4.0 && seven < one / 4.0, "{none:e} {one:e} {seven:e}");
}
