//! Area in phase space.

use crate::systems::Phase;

// ANCHOR: area
/// The signed area of a polygon in phase space (rad²/s), positive if its corners are
/// counterclockwise with θ to the right and ω upwards.
///
/// A Hamiltonian flow preserves the area within a curve, but not within a polygon, whose edges it
/// bends: the area of a polygon of n points on a curve is off by O(1/n²). Affine maps, such as the
/// flow of the linear oscillator, keep edges straight.
pub fn polygon_area(corners: &[Phase]) -> f64 {
    let Some((first, rest)) = corners.split_first() else { return 0.0 };
    // Triangles from the first corner: a small polygon far from the origin loses no digits.
    let from_first =
        |z: &Phase| Phase { theta: z.theta - first.theta, omega: z.omega - first.omega };
    rest.windows(2)
        .map(|edge| (from_first(&edge[0]), from_first(&edge[1])))
        .map(|(a, b)| 0.5 * (a.theta * b.omega - b.theta * a.omega))
        .sum()
}
// ANCHOR_END: area
