//! An explicit Runge–Kutta method of a user's own, by its coefficients.

use crate::error::Error;
use crate::integrate::Method;
use crate::systems::{RateOf, System};

/// An explicit Runge–Kutta method by its coefficients: kᵢ = f(t + cᵢ h, z + h Σⱼ aᵢⱼ kⱼ) for j < i,
/// and the step z + h Σ bᵢ kᵢ. The nodes are cᵢ = Σⱼ aᵢⱼ.
///
/// For a method of your own, tried out in a line; the library's are written out, or generated from
/// a table, and take less time. It has no [`MethodInfo`](crate::MethodInfo): to choose it at run
/// time, wrap it in a type that has one.
///
/// ```
/// use pendula::methods::Explicit;
/// use pendula::{Grid, Motion, Pendulum, Phase, integrate};
///
/// // Kutta's method of order 3.
/// let kutta = Explicit::new(
///     [[0.0; 3], [0.5, 0.0, 0.0], [-1.0, 2.0, 0.0]],
///     [1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0],
/// )?;
/// let start = Phase::at_rest(1.0);
/// let truth = Motion::new(&Pendulum::PAPER, start)?.at(1.0);
/// let error = |step| -> Result<f64, pendula::Error> {
///     let grid = Grid::with_duration(step, 1.0)?;
///     let end = integrate(&Pendulum::PAPER, &kutta, start, &grid);
///     Ok((end.theta - truth.theta).abs())
/// };
/// // Half the step, an eighth of the error, and what the next power of the step adds.
/// let ratio = error(0.001)? / error(0.0005)?;
/// assert!((ratio - 8.0).abs() < 0.1, "{ratio}");
/// # Ok::<(), pendula::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Explicit<const S: usize> {
    a: [[f64; S]; S],
    b: [f64; S],
    c: [f64; S],
}

impl<const S: usize> Explicit<S> {
    /// The method of `S` stages with these coefficients.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a coefficient aᵢⱼ with j ≥ i that is not 0, with which the method
    /// would be implicit, a row whose sum is not finite, and weights bᵢ whose sum is not 1, with
    /// which it would have no order. (To 1e-12, so that coefficients may be decimals.)
    pub fn new(a: [[f64; S]; S], b: [f64; S]) -> Result<Self, Error> {
        let refused = |name, value, allowed| Err(Error::Parameter { name, value, allowed });
        let mut c = [0.0; S];
        for (i, (row, c)) in a.iter().zip(&mut c).enumerate() {
            for (j, &value) in row.iter().enumerate() {
                if j >= i && value != 0.0 {
                    return refused("a coefficient on or above the diagonal", value, "0");
                }
                *c += value;
            }
            if !c.is_finite() {
                return refused("a sum of coefficients", *c, "finite");
            }
        }
        let sum: f64 = b.iter().sum();
        if sum.is_nan() || libm::fabs(sum - 1.0) > 1e-12 {
            return refused("the sum of the weights", sum, "1");
        }
        Ok(Self { a, b, c })
    }
}

impl<S: System, const STAGES: usize> Method<S> for Explicit<STAGES> {
    type Carry = ();

    fn start(&self, _system: &S, _t: f64, _h: f64, _z: S::State) {}

    #[inline(always)]
    fn step(&self, system: &S, t: f64, h: f64, z: S::State, _carry: &mut ()) -> S::State {
        let mut k = [system.rate(t, z); STAGES];
        for i in 1..STAGES {
            k[i] = system.rate(t + self.c[i] * h, z + sum::<S>(&self.a[i][..i], &k) * h);
        }
        z + sum::<S>(&self.b, &k) * h
    }
}

/// Σ aⱼ kⱼ over the coefficients `a`, of which there is one at least.
#[inline(always)]
fn sum<S: System>(a: &[f64], k: &[RateOf<S>]) -> RateOf<S> {
    let mut sum = k[0] * a[0];
    for (a, k) in a.iter().zip(k).skip(1) {
        sum = sum + *k * *a;
    }
    sum
}
