//! What a step may be off by.

use crate::error::{Error, positive};
use crate::systems::Components;

/// The error allowed in one step: each component x of the state may be off by absolute + relative ·
/// |x|.
///
/// It is a promise about a step, not about the run: errors add up from step to step, and grow as
/// the motion makes them grow. What the run's error does is fall in proportion to the tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    absolute: f64,
    relative: f64,
}

/// 10 ε: a step's own rounding is a few ε of the state, and below ten of them the estimate would
/// measure nothing else (as in dop853.f, which refuses the same).
pub const SMALLEST_RELATIVE: f64 = 10.0 * f64::EPSILON;

impl Tolerance {
    /// `absolute` in the units of the components (rad, rad/s), and `relative` to them.
    ///
    /// # Errors
    /// [`Error::Parameter`] for an absolute tolerance that is not finite and positive, and for a
    /// relative one that is not between [`SMALLEST_RELATIVE`] and 1.
    pub fn new(absolute: f64, relative: f64) -> Result<Self, Error> {
        let absolute = positive("absolute tolerance", absolute)?;
        // A NaN is in no range.
        if !(SMALLEST_RELATIVE..1.0).contains(&relative) {
            return Err(Error::Parameter {
                name: "relative tolerance",
                value: relative,
                allowed: "at least 2.22e-15, ten roundings of an f64, and less than 1",
            });
        }
        Ok(Self { absolute, relative })
    }

    /// The same number for both.
    ///
    /// # Errors
    /// As [`Tolerance::new`].
    pub fn uniform(tolerance: f64) -> Result<Self, Error> {
        Self::new(tolerance, tolerance)
    }

    /// What is allowed in each component, absolutely (rad, rad/s).
    pub const fn absolute(&self) -> f64 {
        self.absolute
    }

    /// What is allowed of each component, relatively.
    pub const fn relative(&self) -> f64 {
        self.relative
    }

    // ANCHOR: error_norm
    /// The size of a `displacement`, in tolerances: the root of the mean square of its components,
    /// each over what it may be off by in a step between the states `from` and `to` (Hairer,
    /// Nørsett, Wanner, *Solving Ordinary Differential Equations I*, Eqs. II.4.10–11).
    #[inline]
    pub fn error_norm<Z: Components>(&self, from: Z, to: Z, displacement: Z::Displacement) -> f64 {
        let (mut squares, mut count) = (0.0, 0.0);
        from.for_each_component(to, displacement, |x, y, error| {
            let ratio = error / self.allowed(x, y);
            squares += ratio * ratio;
            count += 1.0;
        });
        libm::sqrt(squares / count)
    }
    // ANCHOR_END: error_norm

    /// The size of a state itself, in tolerances. Of `any` displacement nothing is used.
    pub(super) fn state_norm<Z: Components>(&self, z: Z, any: Z::Displacement) -> f64 {
        let (mut squares, mut count) = (0.0, 0.0);
        z.for_each_component(z, any, |x, _, _| {
            let ratio = x / self.allowed(x, x);
            squares += ratio * ratio;
            count += 1.0;
        });
        libm::sqrt(squares / count)
    }

    /// What a component may be off by in a step from `x` to `y`.
    #[inline]
    fn allowed(&self, x: f64, y: f64) -> f64 {
        self.absolute + self.relative * libm::fmax(libm::fabs(x), libm::fabs(y))
    }
}
