//! The error allowed in a step.

use crate::error::{Error, checked, positive};
use crate::systems::Components;

/// The error allowed in one step, in each component x of the state: absolute + relative · |x|.
///
/// It bounds the error of a step, not of the run: errors add up from step to step, and grow with
/// the motion. But the error of the run falls in proportion to the tolerance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    absolute: f64,
    relative: f64,
}

/// 10 ε: the rounding of a step is a few ε of the state, and below ten of them the estimate would
/// measure nothing else (radau5.f refuses the same).
pub const SMALLEST_RELATIVE: f64 = 10.0 * f64::EPSILON;

impl Tolerance {
    /// `absolute` in the units of the components (rad, rad/s), and `relative` to them.
    ///
    /// # Errors
    /// [`Error::Parameter`] for an absolute tolerance that is not finite and positive, and for a
    /// relative one that is not between [`SMALLEST_RELATIVE`] and 1.
    pub fn new(absolute: f64, relative: f64) -> Result<Self, Error> {
        let absolute = positive("absolute tolerance", absolute)?;
        let fits = (SMALLEST_RELATIVE..1.0).contains(&relative);
        let allowed = "at least 2.22e-15, ten roundings of an f64, and less than 1";
        Ok(Self { absolute, relative: checked("relative tolerance", relative, fits, allowed)? })
    }

    /// The same number for both.
    ///
    /// # Errors
    /// As [`Tolerance::new`].
    pub fn uniform(tolerance: f64) -> Result<Self, Error> {
        Self::new(tolerance, tolerance)
    }

    /// The absolute tolerance of each component (rad, rad/s).
    pub const fn absolute(&self) -> f64 {
        self.absolute
    }

    /// The relative tolerance of each component.
    pub const fn relative(&self) -> f64 {
        self.relative
    }

    /// The size of a `displacement`, in tolerances: the root of the mean square of its components,
    /// each divided by the error allowed in a step between the states `from` and `to` (Hairer,
    /// Nørsett, Wanner, *Solving Ordinary Differential Equations I*, Eqs. II.4.10–11).
    #[inline]
    pub fn error_norm<Z: Components>(&self, from: Z, to: Z, displacement: Z::Displacement) -> f64 {
        libm::sqrt(self.square_norm(from, to, displacement))
    }

    /// Its square.
    #[inline]
    pub(super) fn square_norm<Z: Components>(
        &self,
        from: Z,
        to: Z,
        displacement: Z::Displacement,
    ) -> f64 {
        let (mut squares, mut count) = (0.0, 0.0);
        from.for_each_component(to, displacement, |x, y, error| {
            let ratio = error / self.allowed(x, y);
            squares += ratio * ratio;
            count += 1.0;
        });
        squares / count
    }

    /// The size of a state itself, in tolerances. The value of `any` displacement is not used.
    pub(super) fn state_norm<Z: Components>(&self, z: Z, any: Z::Displacement) -> f64 {
        let (mut squares, mut count) = (0.0, 0.0);
        z.for_each_component(z, any, |x, _, _| {
            let ratio = x / self.allowed(x, x);
            squares += ratio * ratio;
            count += 1.0;
        });
        libm::sqrt(squares / count)
    }

    /// The error allowed in a component in a step from `x` to `y`.
    #[inline]
    fn allowed(&self, x: f64, y: f64) -> f64 {
        self.absolute + self.relative * x.abs().max(y.abs())
    }
}
