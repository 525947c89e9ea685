//! States whose components are counted, not named.

use core::ops::{Index, IndexMut};

use crate::{state, state_operations};

/// A state of N numbers, or a rate of change of one, where they have no names of their own: values
/// on a grid, concentrations, the modes of a string.
///
/// N is known to the compiler, and a state is copied: each stage of a step is one, and is kept
/// without an allocator. So there is no state of a `Vec`. Some hundred numbers are well on the
/// stack; for fields of many thousand values a library with matrices is the better tool.
///
/// ```
/// use pendula::adaptive::{Adaptive, Tolerance};
/// use pendula::methods::DormandPrince;
/// use pendula::systems::{Array, FromRate};
///
/// // Heat on a ring of 12 cells.
/// const N: usize = 12;
/// let ring = FromRate::new(|_t, u: [f64; N]| {
///     std::array::from_fn(|i| u[(i + 1) % N] - 2.0 * u[i] + u[(i + N - 1) % N])
/// });
/// // A wave of two crests decays by the factor exp(−4t sin²(2π/12)) = exp(−t).
/// let wave = Array(std::array::from_fn(|i| (std::f64::consts::TAU * i as f64 / 6.0).cos()));
/// let adaptive = Adaptive::new(DormandPrince, Tolerance::uniform(1e-10)?);
/// let (end, _) = adaptive.integrate(&ring, wave, 0.0, 3.0)?;
/// let exact = wave * (-3.0_f64).exp();
/// assert!((end - exact).into_iter().all(|difference| difference.abs() < 1e-9));
/// # Ok::<(), pendula::Error>(())
/// ```
///
/// It is indexed and iterated as an array is, and an array becomes one by `into`; loops such as
/// [`integrate()`](crate::integrate()) do that themselves. Where numbers do have names,
/// [`state!`](crate::state) makes a state of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Array<const N: usize>(pub [f64; N]);

state_operations! {
    [const N: usize] Array [N] { 0: [f64; N], }
}

impl<const N: usize> From<[f64; N]> for Array<N> {
    #[inline]
    fn from(numbers: [f64; N]) -> Self {
        Self(numbers)
    }
}

impl<const N: usize> From<Array<N>> for [f64; N] {
    #[inline]
    fn from(Array(numbers): Array<N>) -> [f64; N] {
        numbers
    }
}

impl<const N: usize> PartialEq<[f64; N]> for Array<N> {
    fn eq(&self, numbers: &[f64; N]) -> bool {
        self.0 == *numbers
    }
}

impl<const N: usize> Index<usize> for Array<N> {
    type Output = f64;

    #[inline]
    fn index(&self, index: usize) -> &f64 {
        &self.0[index]
    }
}

impl<const N: usize> IndexMut<usize> for Array<N> {
    #[inline]
    fn index_mut(&mut self, index: usize) -> &mut f64 {
        &mut self.0[index]
    }
}

impl<const N: usize> IntoIterator for Array<N> {
    type Item = f64;
    type IntoIter = core::array::IntoIter<f64, N>;

    #[inline]
    fn into_iter(self) -> Self::IntoIter {
        self.0.into_iter()
    }
}

impl<'a, const N: usize> IntoIterator for &'a Array<N> {
    type Item = &'a f64;
    type IntoIter = core::slice::Iter<'a, f64>;

    #[inline]
    fn into_iter(self) -> Self::IntoIter {
        self.0.iter()
    }
}

state! {
    /// N positions and their velocities, or a rate of change of both: the state of particles.
    ///
    /// It is the state of a [`FromForce`](crate::systems::FromForce). A type of your own is
    /// [`Separable`](crate::Separable) with it by [`kicked`](ArrayPhase::kicked) and
    /// [`drifted`](ArrayPhase::drifted).
    ///
    /// ```
    /// use pendula::methods::{BlanesMoan6, Gauss4, StormerVerlet};
    /// use pendula::metrics::EnergyDrift;
    /// use pendula::systems::{ArrayPhase, FromForce};
    /// use pendula::{Grid, Hamiltonian, Method, integrate, integrate_with};
    ///
    /// // Three bodies of mass 1 in a plane, which attract each other: r̈ = −Δr/|Δr|³.
    /// const PAIRS: [(usize, usize); 3] = [(0, 2), (2, 4), (4, 0)];
    /// let between = |r: [f64; 6], (i, j)| [0, 1].map(|k| r[j + k] - r[i + k]);
    /// let bodies = FromForce::new(|_t, r: [f64; 6]| {
    ///     let mut accelerations = [0.0; 6];
    ///     for (i, j) in PAIRS {
    ///         let [x, y] = between(r, (i, j));
    ///         let cube = (x * x + y * y).powf(1.5);
    ///         for (k, pull) in [x / cube, y / cube].into_iter().enumerate() {
    ///             accelerations[i + k] += pull;
    ///             accelerations[j + k] -= pull;
    ///         }
    ///     }
    ///     accelerations
    /// })
    /// .with_potential(|r| {
    ///     let distances = PAIRS.map(|pair| between(r, pair)).map(|[x, y]| x.hypot(y));
    ///     distances.iter().map(|distance| -1.0 / distance).sum()
    /// });
    ///
    /// // The figure of eight on which three bodies follow each other (Chenciner, Montgomery, *Ann.
    /// // of Math.* 152 (2000) 881–901): after a period each is where it was.
    /// let (x, y, vx, vy) = (0.97000436, -0.24308753, 0.46620369, 0.43236573);
    /// let start = ArrayPhase {
    ///     positions: [x, y, -x, -y, 0.0, 0.0],
    ///     velocities: [vx, vy, vx, vy, -2.0 * vx, -2.0 * vy],
    /// };
    /// let period = Grid::new(6.32591398 / 2000.0, 2000)?;
    ///
    /// fn run<S: Hamiltonian<State = ArrayPhase<6>>>(
    ///     bodies: &S,
    ///     method: &impl Method<S>,
    ///     start: ArrayPhase<6>,
    ///     period: &Grid,
    /// ) -> [f64; 2] {
    ///     let mut drift = EnergyDrift::new(bodies);
    ///     let end = integrate_with(bodies, method, start, period, &mut drift);
    ///     let off = (end - start).positions.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    ///     [off, drift.largest()]
    /// }
    /// let [off, drift] = run(&bodies, &StormerVerlet, start, &period);
    /// assert!(off < 2e-5 && drift < 1e-5);
    /// // The start has eight digits.
    /// let [off, drift] = run(&bodies, &BlanesMoan6, start, &period);
    /// assert!(off < 2e-7 && drift < 1e-13);
    /// let [off, drift] = run(&bodies, &Gauss4, start, &period);
    /// assert!(off < 2e-7 && drift < 1e-11);
    /// # Ok::<(), pendula::Error>(())
    /// ```
    pub struct ArrayPhase<const N: usize> {
        /// The positions.
        pub positions: [f64; N],
        /// Their velocities, in the same order.
        pub velocities: [f64; N],
    }
}

impl<const N: usize> ArrayPhase<N> {
    /// The positions with these velocities.
    pub const fn new(positions: [f64; N], velocities: [f64; N]) -> Self {
        Self { positions, velocities }
    }

    /// The positions at rest.
    pub const fn at_rest(positions: [f64; N]) -> Self {
        Self { positions, velocities: [0.0; N] }
    }

    /// Velocities after the `accelerations` have acted for the time `h` (s); the positions stay.
    #[inline]
    #[must_use]
    pub fn kicked(mut self, accelerations: [f64; N], h: f64) -> Self {
        for (v, a) in self.velocities.iter_mut().zip(&accelerations) {
            *v += a * h;
        }
        self
    }

    /// Positions moved for the time `h` (s) with constant velocities, which stay.
    #[inline]
    #[must_use]
    pub fn drifted(mut self, h: f64) -> Self {
        for (x, v) in self.positions.iter_mut().zip(&self.velocities) {
            *x += v * h;
        }
        self
    }
}
