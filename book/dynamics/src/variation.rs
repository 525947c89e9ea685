//! The neighbours of a trajectory.

use core::array::from_fn;
use core::ops::{Add, Mul};

use pendula::{RateOf, State, System, Vector};

use crate::linearised::Linearised;

/// A system together with N infinitesimal displacements: a system too, which any method for systems
/// can step.
///
/// A one-step method then maps a displacement by the derivative of its map of the state. So
/// determinants and exponents are those of the numerical map itself, not only of the motion.
#[derive(Clone, Copy, Debug)]
pub struct Variational<'a, S, const N: usize>(pub &'a S);

/// A state and N displacements from it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bundle<Z, V, const N: usize> {
    /// The state, or its rate of change.
    pub base: Z,
    /// The displacements, or theirs.
    pub tangents: [V; N],
}

impl<Z: Add<V, Output = Z> + Copy, V: Vector, const N: usize> Add<Bundle<V, V, N>>
    for Bundle<Z, V, N>
{
    type Output = Self;

    #[inline]
    fn add(self, other: Bundle<V, V, N>) -> Self {
        Self {
            base: self.base + other.base,
            tangents: from_fn(|i| self.tangents[i] + other.tangents[i]),
        }
    }
}

impl<V: Vector, const N: usize> Mul<f64> for Bundle<V, V, N> {
    type Output = Self;

    #[inline]
    fn mul(self, factor: f64) -> Self {
        Self { base: self.base * factor, tangents: self.tangents.map(|v| v * factor) }
    }
}

impl<V: Vector, const N: usize> Vector for Bundle<V, V, N> {}

impl<S: Linearised, const N: usize> System for Variational<'_, S, N>
where
    Bundle<S::State, RateOf<S>, N>: State<Displacement = Bundle<RateOf<S>, RateOf<S>, N>>,
{
    type State = Bundle<S::State, RateOf<S>, N>;

    #[inline]
    fn rate(&self, t: f64, z: Self::State) -> Bundle<RateOf<S>, RateOf<S>, N> {
        Bundle {
            base: self.0.rate(t, z.base),
            tangents: z.tangents.map(|v| self.0.tangent(t, z.base, v)),
        }
    }
}
