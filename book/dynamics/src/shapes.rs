//! Shapes in phase space, polygons of many points, and the area of such a polygon.

use pendula::{Pendulum, Phase};

/// The corners of a polygon, anticlockwise, in hundredths of the size of its [`Place`]: to the
/// right θ, upwards ω/ω₀.
pub type Polygon = &'static [[i8; 2]];

/// A square with sides of one size.
pub const SQUARE: Polygon = &[[-50, -50], [50, -50], [50, 50], [-50, 50]];

/// A cat that sits and looks at us, two sizes tall: its outline, then eyes, nose and whiskers.
#[rustfmt::skip]
pub const CAT: &[Polygon] = &[
    &[
        [-48, -100], [-41, -102], [-33, -104], [-24, -104], [-16, -104], [-5, -104], [5, -104],
        [16, -104], [27, -103], [38, -102], [48, -102], [57, -103], [64, -104], [72, -104],
        [80, -101], [89, -97], [96, -92], [102, -85], [108, -77], [112, -68], [114, -59],
        [115, -50], [114, -42], [112, -34], [108, -27], [106, -20], [106, -11], [108, -4],
        [118, 4], [116, 16], [109, 18], [100, 16], [93, 9], [88, 0], [88, -11], [90, -22],
        [93, -33], [96, -44], [95, -56], [92, -66], [86, -74], [78, -78], [70, -77], [64, -74],
        [64, -64], [62, -52], [59, -43], [56, -33], [52, -24], [47, -15], [42, -7], [38, 0],
        [36, 8], [36, 14], [45, 17], [54, 22], [60, 30], [64, 40], [63, 51], [60, 62],
        [59, 70], [59, 78], [58, 86], [57, 96], [55, 106], [54, 114], [47, 109], [38, 102],
        [32, 96], [27, 89], [22, 84], [12, 86], [0, 88], [-12, 86], [-22, 84], [-27, 89],
        [-32, 96], [-38, 102], [-47, 109], [-54, 114], [-55, 106], [-57, 96], [-58, 86],
        [-59, 78], [-59, 70], [-60, 62], [-63, 51], [-64, 40], [-60, 30], [-54, 22], [-45, 17],
        [-36, 14], [-36, 8], [-38, 0], [-42, -7], [-47, -15], [-52, -24], [-56, -33],
        [-59, -43], [-62, -52], [-64, -60], [-65, -68], [-64, -76], [-61, -85], [-55, -93],
    ],
    &[
        [-18, 52], [-19, 57], [-23, 61], [-27, 61], [-31, 57], [-32, 52], [-31, 47], [-27, 43],
        [-23, 43], [-19, 47],
    ],
    &[
        [32, 52], [31, 57], [27, 61], [23, 61], [19, 57], [18, 52], [19, 47], [23, 43],
        [27, 43], [31, 47],
    ],
    &[
        [-6, 36], [0, 29], [6, 36],
    ],
    &[
        [-28, 34], [-74, 41], [-28, 32],
    ],
    &[
        [-28, 27], [-72, 21], [-28, 25],
    ],
    &[
        [28, 32], [74, 41], [28, 34],
    ],
    &[
        [28, 25], [72, 21], [28, 27],
    ],
];

/// Where a shape is, and how large, in the coordinates (θ, ω/ω₀), in which small swings are
/// circles.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// The middle of the shape.
    pub centre: Phase,
    /// Its size (rad).
    pub size: f64,
}

impl Place {
    /// The polygon here: each corner, and after it `pieces` − 1 points evenly spaced on the way to
    /// the next. None for no pieces.
    pub fn outline(
        self,
        polygon: Polygon,
        pendulum: &Pendulum,
        pieces: u32,
    ) -> impl Iterator<Item = Phase> {
        let Self { centre, size } = self;
        let frequency = pendulum.small_angle_frequency();
        (0..polygon.len() as u32 * pieces).map(move |n| {
            let (corner, share) = ((n / pieces) as usize, f64::from(n % pieces));
            let (from, to) = (polygon[corner], polygon[(corner + 1) % polygon.len()]);
            let along = |i: usize| {
                let (from, to) = (f64::from(from[i]), f64::from(to[i]));
                0.01 * size * (from + (to - from) * (share / f64::from(pieces)))
            };
            Phase { theta: centre.theta + along(0), omega: centre.omega + frequency * along(1) }
        })
    }
}

/// The area (rad²/s) of the polygon with these corners: positive if they go round it anticlockwise.
///
/// A Hamiltonian flow preserves the area within a curve, but not within a polygon, whose edges it
/// bends: the area of a polygon of n points on a curve is off by O(1/n²). Affine maps, such as the
/// flow of the linear oscillator, keep edges straight.
pub fn area(corners: impl IntoIterator<Item = Phase>) -> f64 {
    let mut corners = corners.into_iter();
    let Some(first) = corners.next() else { return 0.0 };
    // Relative to the first corner, so that a small polygon far from the origin keeps its digits.
    let (mut before, mut twice) = ((0.0, 0.0), 0.0);
    for z in corners {
        let here = (z.theta - first.theta, z.omega - first.omega);
        twice += before.0 * here.1 - before.1 * here.0;
        before = here;
    }
    0.5 * twice
}
