//! The energy itself: the methods of the discrete gradient conserve it in steps of any length.
//!
//! Hairer, Lubich, Wanner, *Geometric Numerical Integration* (2006), Sect. V.5.

use super::{CheckResult, beyond, measured, near};
use crate::judge::energy::run;
use crate::judge::probe::frequency;
use pendula::{AnyMethod, Phase};

const STEPS: u64 = 2000;

/// To and fro and over the top, as θ (rad) and ω/ω₀.
const STARTS: [(f64, f64); 3] = [(1.0, 0.0), (-2.5, 0.5), (0.3, 3.0)];

/// x = ω₀h, from short steps to those that are hardly solved.
const XS: [f64; 3] = [0.05, 0.3, 1.0];

/// Whether the energy is conserved, in steps of any length, or not, as the entry says.
pub fn check(method: &dyn AnyMethod) -> CheckResult {
    let mut furthest = 0.0_f64;
    for (theta, q) in STARTS {
        let start = Phase { theta, omega: q * frequency() };
        for x in XS {
            let found = measured(method, |probe| run(probe, start, x, STEPS))?;
            if method.info().conserves_energy {
                // The bound is that of roundings of an energy of order 1: the rotation has six, and
                // a rounding of its q, 3.6 at the bottom, changes it by as much.
                let what = format_args!("|ΔH|/(m g L) from {start:?} at x = {x}");
                near(what, found.largest(), 0.0, 10.0 * found.bound)?;
            }
            furthest = furthest.max(found.largest() / (10.0 * found.bound));
        }
    }
    if method.info().conserves_energy {
        return Ok(());
    }
    beyond("conserving after all: the largest |ΔH|, over what rounding makes", furthest, 10.0)
}
