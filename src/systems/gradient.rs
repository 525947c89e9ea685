//! Systems whose force has a known gradient, and the change of variables of processed methods.

use super::{Counting, LinearOscillator, Pendulum, Phase, RateOf, Separable};
use crate::arithmetic::number::Number;
use crate::arithmetic::sine::half_turn;

/// A separable system of one angle, θ̈ = f = −V'(θ), whose force has known derivatives: what
/// [processed methods](crate::methods::processed) need.
pub trait ForceGradient: Separable {
    /// The force, and `c` (s²) times its gradient along itself: f + c f f', which is the force in
    /// the potential V − ½c V'².
    fn force_with_gradient(&self, t: f64, z: Self::State, c: f64) -> Self::Force;

    /// The displacement from a state `z` of the kernel to the state that is seen.
    ///
    /// Implementations are `#[inline(always)]`: the time loop then leaves it out of the steps at
    /// which nobody looks, and is one and a half times as fast.
    fn processing(&self, z: Self::State, by: &Processor) -> RateOf<Self>;

    /// The displacement from a seen state `z` to the kernel's: [`processing`] undone.
    ///
    /// [`processing`]: ForceGradient::processing
    fn unprocessing(&self, z: Self::State, by: &Processor) -> RateOf<Self>;
}

/// A processor: the change of variables between the states of a kernel and those that are seen.
///
/// The function S(Θ, ω) = Θω + h²λ ωV' + h⁴(μ ωV'V'' + ν ω³V''') of the kernel's angle Θ and the
/// seen velocity ω generates it: θ = ∂S/∂ω and Ω = ∂S/∂Θ. Any S preserves area, and this one has
/// even powers of h only, so that the whole method is symmetric if its kernel is. Hairer, Lubich,
/// Wanner, *Geometric Numerical Integration* (2006), Sect. VI.5.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Processor {
    /// λ, or h²λ, in units of time.
    linear: f64,
    /// μ, or h⁴μ.
    mixed: f64,
    /// ν, or h⁴ν.
    cubic: f64,
    /// The unit of time (s): a power of two near h, so that no power of h overflows. A power of two
    /// changes no digit.
    unit: f64,
}

/// The first four derivatives of the potential V (1/s²) by the angle.
type Derivatives<N = f64> = [N; 4];

impl Processor {
    /// Newton's steps to the kernel's angle: the first leaves less than half of λx² times the
    /// displacement, each squares what is left, and λx² is below ½ where the kernel is stable.
    const SWEEPS: u64 = 5;
    /// Newton's steps to the seen velocity: the cube adds less than a hundredth, except in
    /// rotations of more than a turn in two steps.
    const VELOCITY_SWEEPS: u64 = 4;
    /// What [`ForceGradient::unprocessing`] costs: the force and its gradient, for each of Newton's
    /// steps and once more.
    pub const EVALUATIONS: u64 = 2 * (Self::SWEEPS + 1);

    /// The processor with the coefficients λ, μ and ν, for the step 1.
    pub const fn new(linear: f64, mixed: f64, cubic: f64) -> Self {
        Self { linear, mixed, cubic, unit: 1.0 }
    }

    /// λ, μ and ν.
    pub const fn coefficients(&self) -> [f64; 3] {
        [self.linear, self.mixed, self.cubic]
    }

    /// The same for the step `h` (s).
    #[must_use]
    #[inline]
    pub const fn over(self, h: f64) -> Self {
        // The largest power of two that is no longer than h, whatever its sign; of a subnormal h,
        // the smallest normal number.
        let unit = f64::from_bits(h.to_bits() & f64::INFINITY.to_bits()).max(f64::MIN_POSITIVE);
        let square = (h / unit) * (h / unit);
        let Self { linear, mixed, cubic, .. } = self;
        Self {
            linear: linear * square,
            mixed: mixed * (square * square),
            cubic: cubic * (square * square),
            unit,
        }
    }

    /// The derivatives in units of time. Not by `map`, which is not inlined into code for vector
    /// instructions.
    #[inline(always)]
    fn in_units<N: Number>(&self, [v1, v2, v3, v4]: Derivatives<N>) -> Derivatives<N> {
        let u = self.unit;
        [v1 * u * u, v2 * u * u, v3 * u * u, v4 * u * u]
    }

    // ANCHOR: processor
    /// θ − Θ = λV' + μV'V'' + 3νω²V'''.
    #[inline(always)]
    fn shift<N: Number>(&self, [v1, v2, v3, _]: Derivatives<N>, omega: N) -> N {
        v1 * self.linear + v1 * self.mixed * v2 + v3 * self.cubic * omega * omega * 3.0
    }

    /// Ω/ω − 1 = λV'' + μ(V''² + V'V''') + νω²V'''', as the part without ω² and its factor.
    #[inline(always)]
    fn stretch<N: Number>(&self, [v1, v2, v3, v4]: Derivatives<N>) -> (N, N) {
        let mixed = v2 * self.mixed * v2 + v1 * self.mixed * v3;
        (v2 * self.linear + mixed, v4 * self.cubic)
    }

    /// θ − Θ and ω − Ω, from the kernel's velocity Ω and the derivatives at its angle.
    #[inline(always)]
    pub fn displacement<N: Number>(&self, v: Derivatives<N>, kernel_omega: N) -> (N, N) {
        let (v, kernel_omega) = (self.in_units(v), kernel_omega * self.unit);
        let (a, b) = self.stretch(v);
        let mut omega = kernel_omega / (a + 1.0);
        if self.cubic != 0.0 {
            // Ω = ω (1 + a + bω²), solved for ω.
            for _ in 0..Self::VELOCITY_SWEEPS {
                let last = b * omega * omega;
                let excess = omega * (a + 1.0 + last) - kernel_omega;
                omega = omega - excess / (a + 1.0 + last * 3.0);
            }
        }
        (self.shift(v, omega), -omega * (a + b * omega * omega) / self.unit)
    }

    /// Θ − θ and Ω − ω, from the seen velocity ω and the derivatives at any distance from the seen
    /// angle.
    #[inline(always)]
    pub fn inverse<N: Number>(&self, v: impl Fn(N) -> Derivatives<N>, omega: N) -> (N, N) {
        let omega = omega * self.unit;
        let mut by = omega.splat(0.0);
        for _ in 0..Self::SWEEPS {
            let here = self.in_units(v(by));
            let (a, b) = self.stretch(here);
            by = by - (by + self.shift(here, omega)) / (a + 1.0 + b * omega * omega * 3.0);
        }
        let (a, b) = self.stretch(self.in_units(v(by)));
        (by, omega * (a + b * omega * omega) / self.unit)
    }
    // ANCHOR_END: processor
}

impl Pendulum {
    /// V = −(g/L) cos θ.
    #[inline(always)]
    fn derivatives(&self, theta: f64) -> Derivatives {
        let (s, c) = half_turn::sin_and_cos(theta);
        let (v1, v2) = (self.frequency_squared() * s, self.frequency_squared() * c);
        [v1, v2, -v1, -v2]
    }
}

impl ForceGradient for Pendulum {
    #[inline]
    fn force_with_gradient(&self, _t: f64, z: Phase, c: f64) -> f64 {
        let (sin, cos) = half_turn::sin_and_cos(z.theta);
        -self.frequency_squared() * sin * (1.0 - c * self.frequency_squared() * cos)
    }

    #[inline(always)]
    fn processing(&self, z: Phase, by: &Processor) -> Phase {
        let (theta, omega) = by.displacement(self.derivatives(z.theta), z.omega);
        Phase { theta, omega }
    }

    #[inline(always)]
    fn unprocessing(&self, z: Phase, by: &Processor) -> Phase {
        let (theta, omega) = by.inverse(|by| self.derivatives(z.theta + by), z.omega);
        Phase { theta, omega }
    }
}

impl LinearOscillator {
    /// V = ½ (g/L) θ².
    #[inline(always)]
    fn derivatives(&self, theta: f64) -> Derivatives {
        [-self.force(0.0, Phase::at_rest(theta)), -self.force(0.0, Phase::at_rest(1.0)), 0.0, 0.0]
    }
}

impl ForceGradient for LinearOscillator {
    #[inline]
    fn force_with_gradient(&self, t: f64, z: Phase, c: f64) -> f64 {
        self.force(t, z) * (1.0 - c * self.derivatives(z.theta)[1])
    }

    #[inline(always)]
    fn processing(&self, z: Phase, by: &Processor) -> Phase {
        let (theta, omega) = by.displacement(self.derivatives(z.theta), z.omega);
        Phase { theta, omega }
    }

    #[inline(always)]
    fn unprocessing(&self, z: Phase, by: &Processor) -> Phase {
        let (theta, omega) = by.inverse(|by| self.derivatives(z.theta + by), z.omega);
        Phase { theta, omega }
    }
}

impl<S: ForceGradient> ForceGradient for Counting<S> {
    /// Two evaluations: a gradient along a given direction costs as much as a force, even where, as
    /// for the pendulum, the two share most of their work.
    #[inline]
    fn force_with_gradient(&self, t: f64, z: S::State, c: f64) -> S::Force {
        self.count(2);
        self.system().force_with_gradient(t, z, c)
    }

    /// Counts nothing: only an observer asks for it, and where nobody looks it is never computed.
    #[inline(always)]
    fn processing(&self, z: S::State, by: &Processor) -> RateOf<S> {
        self.system().processing(z, by)
    }

    #[inline(always)]
    fn unprocessing(&self, z: S::State, by: &Processor) -> RateOf<S> {
        self.count(Processor::EVALUATIONS);
        self.system().unprocessing(z, by)
    }
}
