//! Step-size resonances: where a numerical swing takes a whole number of steps.

use pendula::{METHODS, method_named};
use pendula_study::experiments::resonance::{EVEN, largest_error, place, slip, tau};
use rstest::rstest;

/// At the place that theory gives, every swing takes `count` steps, so that the samples of all
/// swings fall on each other, within half their distance; `beside` it (steps a period) they have
/// gone round by a whole turn or more.
///
/// An offset d slips by d/count turns a swing, and 400 swings by 400 d/count. Störmer–Verlet's
/// orbit stays locked for a twentieth of a step and more on either side; its place is a quarter of
/// a step from that of a method whose period is right.
///
/// Catches: the period's shift left out of the place, or with the other sign; a place in steps a
/// small-angle period.
#[rstest]
#[case("blanes-moan-6", 6, 0.05)]
#[case("blanes-moan-6", 8, 0.05)]
#[case("blanes-moan-6", 10, 0.05)]
#[case("stormer-verlet", 6, 0.15)]
fn theory_has_the_place_of_a_resonance(
    #[case] name: &str,
    #[case] count: u32,
    #[case] beside: f64,
) {
    let method = method_named(name).unwrap();
    let place = place(count, tau(method));
    let locked = slip(method, place, count);
    assert!(locked < 0.5 / f64::from(count), "{name} slips by {locked} at {place}");
    for steps in [place - beside, place + beside] {
        let slipped = slip(method, steps, count);
        assert!(slipped > 1.0, "{name} slips by {slipped} at {steps}");
    }
}

/// The largest error within 0.04 steps of the place, over the larger of those a quarter of a step
/// to either side.
fn height(name: &str, place: f64) -> f64 {
    let method = method_named(name).unwrap();
    let error = |offset: f64| largest_error(method, place + offset);
    let peak = [0.01, 0.02, 0.03, 0.04].into_iter().flat_map(|d| [error(-d), error(d)]);
    peak.fold(0.0, f64::max) / error(-0.25).max(error(0.25))
}

/// Beside a place that is met, errors are small divisors: they fall as one over the distance, and
/// so by 6 to 25 from 0.01 to 0.25, where the method's own error is smaller than that and its
/// period near enough to the exact one. At an odd count the half swings, mirror images, undo each
/// other, whatever the symplectic method; the errors of order 16 are rounding.
///
/// Catches: peaks that are those of a single swing; odd counts taken for resonances; a parity that
/// one method has by chance.
#[test]
fn peaks_stand_at_even_counts_and_not_at_odd_ones() {
    for (name, counts) in [
        ("blanes-moan-6", &EVEN[..3]),
        ("gauss-6", &EVEN[..2]),
        ("processed-6", &EVEN[..2]),
        ("yoshida-6", &EVEN[..1]),
        ("yoshida-8", &EVEN[..1]),
        ("kahan-li-8", &EVEN[..1]),
    ] {
        for count in counts {
            let height = height(name, f64::from(*count));
            assert!(height > 6.0, "{name} at {count}: {height}");
        }
    }
    let symplectic = METHODS.iter().map(|method| method.info());
    for info in symplectic.filter(|info| info.symplectic && info.order <= 8) {
        for count in [7, 9, 11] {
            let height = height(info.name, f64::from(count));
            assert!(height < 1.0, "{} at {count}: {height}", info.name);
        }
    }
}
