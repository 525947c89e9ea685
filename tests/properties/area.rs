//! Area in phase space: the determinant of the Jacobian of one step.

use pendula::study::properties::{AREA_TOLERANCE, area_defect};
use pendula::{AnyMethod, Pendulum, Phase};

use super::{Verdict, beyond, near};

/// Below and above the horizontal, moving and at rest; L ≠ 1 so that no g can stand for g/L.
pub fn cases() -> impl Iterator<Item = (Pendulum, Phase)> {
    let long = Pendulum::new(9.81, 3.0, 1.0).expect("a pendulum");
    [(0.0, 0.0), (0.5, 1.0), (1.0, -2.0), (2.5, 0.3), (-3.0, 0.0)].into_iter().flat_map(
        move |(theta, omega)| {
            [Pendulum::PAPER, long].map(|pendulum| (pendulum, Phase { theta, omega }))
        },
    )
}

pub fn check(method: &dyn AnyMethod) -> Verdict {
    let mut largest = 0.0_f64;
    for (pendulum, z) in cases() {
        let defect = area_defect(method, &pendulum, z, 0.1).abs();
        if method.properties().symplectic {
            near("det J − 1", defect, 0.0, AREA_TOLERANCE)?;
        }
        largest = largest.max(defect);
    }
    if method.properties().symplectic {
        return Ok(());
    }
    // The smallest defect among the paper's methods is RK4's, x⁶/72 = 5e-7 at the bottom of the long pendulum.
    beyond("symplectic after all: det J − 1", largest, 100.0 * AREA_TOLERANCE)
}
