//! Slopes along a ladder, on errors whose law is known.

use approx::assert_relative_eq;
use pendula::metrics::order::slopes;

/// Catches: a slope upside down, of the wrong pair, or in another base; a ladder read in one
/// direction only.
#[test]
fn a_power_law_has_its_power_as_slope() {
    let steps = [0.1, 0.05, 0.01, 0.02];
    let errors = steps.map(|h: f64| 7.0 * h.powi(3));
    let found: Vec<f64> = slopes(&steps, &errors, 0.0).flatten().collect();
    assert_eq!(found.len(), 3);
    for slope in found {
        assert_relative_eq!(slope, 3.0, max_relative = 1e-13);
    }
}

/// Catches: a pair at the floor counted as above it, zero or NaN errors that become infinite
/// slopes, and a negative floor that lets zero through.
#[test]
fn pairs_at_or_below_the_floor_have_no_slope() {
    let steps = [0.8, 0.4, 0.2, 0.1];
    let has_slopes = |errors: [f64; 4], floor| {
        slopes(&steps, &errors, floor).map(|p| p.is_some()).collect::<Vec<_>>()
    };
    assert_eq!(has_slopes([8.0, 4.0, 2.0, 1.0], 2.0), [true, false, false]);
    assert_eq!(has_slopes([8.0, 4.0, 2.0, 1.0], 1.9), [true, true, false]);
    assert_eq!(has_slopes([8.0, 0.0, 2.0, 1.0], 0.0), [false, false, true]);
    assert_eq!(has_slopes([8.0, 0.0, 2.0, 1.0], -1.0), [false, false, true]);
    assert_eq!(has_slopes([f64::NAN, 4.0, f64::INFINITY, 1.0], 0.0), [false, false, false]);
}
