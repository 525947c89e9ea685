//! States whose components are counted, not named.

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
/// let ring = FromRate::new(|_t, u: Array<N>| {
///     let cell = |i: usize| u.0[i % N];
///     Array(std::array::from_fn(|i| cell(i + 1) - 2.0 * cell(i) + cell(i + N - 1)))
/// });
/// // A wave of two crests decays by the factor exp(−4t sin²(2π/12)) = exp(−t).
/// let wave = Array(std::array::from_fn(|i| (std::f64::consts::TAU * i as f64 / 6.0).cos()));
/// let adaptive = Adaptive::new(DormandPrince, Tolerance::uniform(1e-10)?);
/// let (end, _) = adaptive.integrate(&ring, wave, 0.0, 3.0, &mut ())?;
/// let exact = wave * (-3.0_f64).exp();
/// assert!((end - exact).0.iter().all(|difference| difference.abs() < 1e-9));
/// # Ok::<(), pendula::Error>(())
/// ```
///
/// Where numbers do have names, [`state!`](crate::state) makes a state of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Array<const N: usize>(pub [f64; N]);

state_operations! {
    [const N: usize] Array [N] { 0: [f64; N], }
}

state! {
    /// N positions and their velocities, or a rate of change of both: the state of particles.
    ///
    /// With [`kicked`](ArrayPhase::kicked) and [`drifted`](ArrayPhase::drifted) a system of them is
    /// [`Separable`](crate::Separable) once its accelerations are known:
    ///
    /// ```
    /// use pendula::methods::{BlanesMoan6, Gauss4, StormerVerlet};
    /// use pendula::metrics::EnergyDrift;
    /// use pendula::systems::ArrayPhase;
    /// use pendula::{Grid, Hamiltonian, Method, Separable, System, integrate};
    ///
    /// /// Three bodies of mass 1 in a plane, which attract each other: r̈ = −Δr/|Δr|³.
    /// struct Bodies;
    ///
    /// impl System for Bodies {
    ///     type State = ArrayPhase<6>;
    ///
    ///     fn rate(&self, t: f64, z: ArrayPhase<6>) -> ArrayPhase<6> {
    ///         ArrayPhase { positions: z.velocities, velocities: self.force(t, z) }
    ///     }
    /// }
    ///
    /// impl Separable for Bodies {
    ///     type Force = [f64; 6];
    ///
    ///     fn force(&self, _t: f64, z: ArrayPhase<6>) -> [f64; 6] {
    ///         let mut accelerations = [0.0; 6];
    ///         for (i, j) in [(0, 2), (2, 4), (4, 0)] {
    ///             let [x, y] = [0, 1].map(|k| z.positions[j + k] - z.positions[i + k]);
    ///             let cube = (x * x + y * y).powf(1.5);
    ///             for (k, pull) in [x / cube, y / cube].into_iter().enumerate() {
    ///                 accelerations[i + k] += pull;
    ///                 accelerations[j + k] -= pull;
    ///             }
    ///         }
    ///         accelerations
    ///     }
    ///
    ///     fn kick(&self, z: ArrayPhase<6>, force: [f64; 6], h: f64) -> ArrayPhase<6> {
    ///         z.kicked(force, h)
    ///     }
    ///
    ///     fn drift(&self, z: ArrayPhase<6>, h: f64) -> ArrayPhase<6> {
    ///         z.drifted(h)
    ///     }
    /// }
    ///
    /// impl Hamiltonian for Bodies {
    ///     fn energy(&self, z: ArrayPhase<6>) -> f64 {
    ///         let between = |i: usize, j: usize| {
    ///             let [x, y] = [0, 1].map(|k| z.positions[j + k] - z.positions[i + k]);
    ///             -1.0 / x.hypot(y)
    ///         };
    ///         let kinetic: f64 = z.velocities.iter().map(|v| 0.5 * v * v).sum();
    ///         kinetic + between(0, 2) + between(2, 4) + between(4, 0)
    ///     }
    /// }
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
    /// fn run(method: &impl Method<Bodies>, start: ArrayPhase<6>, period: &Grid) -> [f64; 2] {
    ///     let mut drift = EnergyDrift::new(&Bodies);
    ///     let end = integrate(&Bodies, method, start, period, &mut drift);
    ///     let off = (end - start).positions.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    ///     [off, drift.largest()]
    /// }
    /// let [off, drift] = run(&StormerVerlet, start, &period);
    /// assert!(off < 2e-5 && drift < 1e-5);
    /// // The start has eight digits.
    /// let [off, drift] = run(&BlanesMoan6, start, &period);
    /// assert!(off < 2e-7 && drift < 1e-13);
    /// let [off, drift] = run(&Gauss4, start, &period);
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
