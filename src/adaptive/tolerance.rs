//! The error allowed in a step.

use crate::error::{Error, checked, positive};
use crate::systems::Components;

/// The error allowed in one step, in each component x of the state: absolute + relative · |x|.
///
/// It bounds the error of a step, not of the run: errors add up from step to step, and grow with
/// the motion. But the error of the run falls in proportion to the tolerance.
///
/// A tolerance is a `Tolerance<'static>`, unless it borrows such a list. The absolute part may be
/// [another for each component](Self::for_each), where they differ much in size:
///
/// ```
/// use pendula::adaptive::{Adaptive, Tolerance};
/// use pendula::methods::DormandPrince;
/// use pendula::systems::FromRate;
///
/// // Robertson's reaction, a short while: the second of its numbers is the smallest by far.
/// let reaction = FromRate::new(|_t, [a, b, c]: [f64; 3]| {
///     let (slow, fast, middle) = (0.04 * a, 3e7 * b * b, 1e4 * b * c);
///     [middle - slow, slow - fast - middle, fast]
/// });
/// let tolerance = Tolerance::for_each(&[1e-8, 1e-12, 1e-8], 1e-8)?;
/// let (end, _) =
///     Adaptive::new(DormandPrince, tolerance).integrate(&reaction, [1.0, 0.0, 0.0], 0.0, 0.4)?;
/// assert!((end[1] - 3.3864e-5).abs() < 1e-9);
/// # Ok::<(), pendula::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance<'a> {
    /// Of each component, or of the first if there are more in `each`.
    absolute: f64,
    /// Of the components, in their order; empty if they have the same.
    each: &'a [f64],
    relative: f64,
}

/// 10 ε: the rounding of a step is a few ε of the state, and below ten of them the estimate would
/// measure nothing else (radau5.f refuses the same).
pub const SMALLEST_RELATIVE: f64 = 10.0 * f64::EPSILON;

impl<'a> Tolerance<'a> {
    /// `absolute` in the units of the components (rad, rad/s), and `relative` to them. **The
    /// absolute tolerance comes first**: what SciPy calls `rtol=1e-8, atol=1e-10` is
    /// `Tolerance::new(1e-10, 1e-8)`.
    ///
    /// # Errors
    /// [`Error::Parameter`] for an absolute tolerance that is not finite and positive, and for a
    /// relative one that is not between [`SMALLEST_RELATIVE`] and 1.
    pub fn new(absolute: f64, relative: f64) -> Result<Self, Error> {
        let absolute = positive("absolute tolerance", absolute)?;
        let fits = (SMALLEST_RELATIVE..1.0).contains(&relative);
        let allowed = "at least 2.22e-15, ten roundings of an f64, and less than 1";
        let relative = checked("relative tolerance", relative, fits, allowed)?;
        Ok(Self { absolute, each: &[], relative })
    }

    /// The `absolute` tolerance of each component of the state, in their order and units, and one
    /// that is `relative` to each. Of a state of arrays each number is a component: of an
    /// [`ArrayPhase`](crate::systems::ArrayPhase) first the positions.
    ///
    /// # Errors
    /// As [`Tolerance::new`], and for no tolerance at all. A walk of a state with more or fewer
    /// components is refused where it begins.
    pub fn for_each(absolute: &'a [f64], relative: f64) -> Result<Self, Error> {
        let first = absolute.first().copied().unwrap_or(f64::NAN);
        for absolute in absolute {
            positive("absolute tolerance", *absolute)?;
        }
        Ok(Self { each: absolute, ..Self::new(first, relative)? })
    }

    /// The same number for both.
    ///
    /// # Errors
    /// As [`Tolerance::new`].
    pub fn uniform(tolerance: f64) -> Result<Self, Error> {
        Self::new(tolerance, tolerance)
    }

    /// The absolute tolerance of the component with this number, counted from 0 (rad, rad/s).
    pub const fn absolute(&self, component: usize) -> f64 {
        if component < self.each.len() { self.each[component] } else { self.absolute }
    }

    /// Refuses a state that has more or fewer components than there are absolute tolerances.
    pub(super) fn check<Z: Components>(&self, z: Z) -> Result<(), Error> {
        let mut components = 0;
        let _ = z.map_components(|x| {
            components += 1;
            x
        });
        let fits = self.each.is_empty() || self.each.len() == components;
        let allowed = "the number of the state's components";
        checked("number of absolute tolerances", self.each.len() as f64, fits, allowed).map(drop)
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
        let (mut squares, mut count) = (0.0, 0);
        from.for_each_component(to, displacement, |x, y, error| {
            let ratio = error / self.allowed(count, x, y);
            squares += ratio * ratio;
            count += 1;
        });
        squares / count as f64
    }

    /// The size of a state itself, in tolerances. The value of `any` displacement is not used.
    pub(super) fn state_norm<Z: Components>(&self, z: Z, any: Z::Displacement) -> f64 {
        let (mut squares, mut count) = (0.0, 0);
        z.for_each_component(z, any, |x, _, _| {
            let ratio = x / self.allowed(count, x, x);
            squares += ratio * ratio;
            count += 1;
        });
        libm::sqrt(squares / count as f64)
    }

    /// The error allowed in this component in a step from `x` to `y`.
    #[inline]
    fn allowed(&self, component: usize, x: f64, y: f64) -> f64 {
        self.absolute(component) + self.relative * x.abs().max(y.abs())
    }
}
