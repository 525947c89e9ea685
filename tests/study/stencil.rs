//! The drawings of a step show the method's own kicks, drifts and slopes, to the last bit.

use pendula::methods::{ForwardEuler, PositionVerlet, Rk4, StormerVerlet, SymplecticEuler};
use pendula::{AnyMethod, Grid, Method, Pendulum, Phase, System, integrate};
use pendula_study::experiments::stencil::{Kind, Noting, Part, stencil};
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

fn parts<M: for<'a> Method<Noting<'a>>>(method: &M, start: Phase) -> Vec<Part> {
    stencil(method, &pendulum(), start, STEP).parts
}

/// Catches: a drawing that does not end where the method's step does, to the bit; arrows that do
/// not begin where the one before ends; a kick of the next step drawn in this one.
#[rstest]
#[case::forward_euler(ForwardEuler)]
#[case::symplectic_euler(SymplecticEuler)]
#[case::rk4(Rk4)]
#[case::stormer_verlet(StormerVerlet)]
fn the_parts_lead_to_the_methods_own_end<M>(#[case] method: M)
where
    M: AnyMethod + Method<Pendulum> + for<'a> Method<Noting<'a>>,
{
    for start in starts() {
        let taken = stencil(&method, &pendulum(), start, STEP);
        let grid = Grid::new(STEP, 1).unwrap();
        assert_eq!(taken.end, integrate(&pendulum(), &method, start, &grid, &mut ()));
        let mut at = start;
        for part in &taken.parts {
            assert_eq!(part.from, at);
            at = part.to;
        }
        let splits = taken.slopes.is_empty();
        assert_eq!(at, if splits { taken.end } else { start }, "{:?}", taken.parts);
        for (z, slope) in taken.slopes {
            assert_eq!(slope, pendulum().rate(0.0, z));
        }
    }
}

/// Catches: a part that is lost or counted twice; kick and drift exchanged; half a kick labelled as
/// a whole one.
#[test]
fn the_parts_are_those_of_the_equations() {
    let (kick, drift) = (Kind::Kick, Kind::Drift);
    let of = |parts: Vec<Part>| -> Vec<_> {
        parts.into_iter().map(|part| (part.kind, part.duration)).collect()
    };
    let half = 0.5 * STEP;
    for start in starts() {
        assert_eq!(of(parts(&ForwardEuler, start)), []);
        assert_eq!(of(parts(&Rk4, start)), []);
        assert_eq!(of(parts(&SymplecticEuler, start)), [(kick, STEP), (drift, STEP)]);
        assert_eq!(of(parts(&StormerVerlet, start)), [(kick, half), (drift, STEP), (kick, half)]);
        assert_eq!(of(parts(&PositionVerlet, start)), [(drift, half), (kick, STEP), (drift, half)]);
    }
}

/// Catches: an arrow that does not start where the slope was evaluated; stages out of order.
#[test]
fn the_slopes_are_those_of_the_equations() {
    for start in starts() {
        let euler = stencil(&ForwardEuler, &pendulum(), start, STEP);
        let [(z, slope)] = euler.slopes[..] else { panic!("one slope: {euler:?}") };
        assert_eq!((z, z + slope * STEP), (start, euler.end));

        let rk4 = stencil(&Rk4, &pendulum(), start, STEP);
        let [(z1, k1), (z2, k2), (z3, k3), (z4, k4)] = rk4.slopes[..] else {
            panic!("four slopes: {rk4:?}")
        };
        let half = STEP / 2.0;
        assert_eq!([z1, z2], [start, start + k1 * half]);
        assert_eq!([z3, z4], [start + k2 * half, start + k3 * STEP]);
        assert_eq!(rk4.end, start + (k1 + k2 * 2.0 + k3 * 2.0 + k4) * (STEP / 6.0));
    }
}
