//! States of systems, and the pendulum's: the point in phase space.

use core::ops::{Add, Mul};

use crate::arithmetic::number::Number;

#[diagnostic::on_unimplemented(
    message = "`{Self}` has no components that can be added and scaled",
    note = "`pendula::state!` makes a state of named components; `pendula::systems::Array<3>` is \
            one of numbers without names, in place of `[f64; 3]`",
    note = "a state is copied, which a `Vec` cannot be"
)]
/// A rate of change, or a small displacement: it can be added and scaled.
///
/// A Runge–Kutta method needs no more. Components keep their names in the type that implements this
/// trait.
pub trait Vector: Copy + Send + Add<Output = Self> + Mul<f64, Output = Self> {}

#[diagnostic::on_unimplemented(
    message = "`{Self}` is no state of a system",
    note = "`pendula::state!` makes a state of named components; `pendula::systems::Array` is one \
            of numbers without names, in place of a bare array",
    note = "a state is copied, which a `Vec` cannot be",
    note = "a closure of an array, `|t, y: [f64; 3]| …`, is a system by \
            `pendula::systems::FromRate::new`"
)]
/// A state: a displacement can be added to it.
///
/// Where states themselves form a vector space they are their own displacements. An angle kept as
/// half turns and a remainder is a point, not a vector: it cannot be scaled.
pub trait State: Copy + Send + Add<Self::Displacement, Output = Self> {
    /// The difference of two states.
    type Displacement: Vector;
}

#[diagnostic::do_not_recommend]
impl<V: Vector> State for V {
    type Displacement = V;
}

#[diagnostic::on_unimplemented(
    message = "the components of `{Self}` cannot be looked at one by one",
    note = "steps that vary and implicit methods do so; `pendula::state!` makes a state for them, \
            or implement `pendula::Components` for it"
)]
/// A state whose components are numbers, so that an error in each can be compared with its
/// tolerance.
pub trait Components: State {
    /// Calls `each` for one component after the other, with its value in this state, in the state
    /// `other`, and in the `displacement`.
    fn for_each_component(
        self,
        other: Self,
        displacement: Self::Displacement,
        each: impl FnMut(f64, f64, f64),
    );

    /// The state with each component replaced by what `each` makes of it.
    #[must_use]
    fn map_components(self, each: impl FnMut(f64) -> f64) -> Self;
}

#[diagnostic::on_unimplemented(
    message = "sizes of `{Self}` cannot be compared",
    note = "implicit methods do so; `pendula::state!` makes a state for them, or implement \
            `pendula::Components` for it"
)]
/// A state of which sizes can be compared: what the iteration of an implicit method needs.
///
/// Every state with [`Components`] is one, so that a state of your own implements those instead;
/// and so are many such states in lanes. It has no calls for others.
pub trait Measurable: State {
    /// A size: one number, or one for each lane.
    #[doc(hidden)]
    type Number: Number;

    /// The sum of the absolute values of the components; any displacement of the state will do. A
    /// sum, not a maximum, which would ignore a NaN.
    #[doc(hidden)]
    fn size(self, displacement: Self::Displacement) -> Self::Number;

    /// The sum of the absolute values of the components of a `displacement` of this state.
    #[doc(hidden)]
    fn size_of(self, displacement: Self::Displacement) -> Self::Number;

    /// A `displacement` of this state times `factor`, in each lane its own.
    #[doc(hidden)]
    fn times(displacement: Self::Displacement, factor: Self::Number) -> Self::Displacement;

    /// The displacement `yes` where the mask is true, `no` elsewhere.
    #[doc(hidden)]
    fn select(
        mask: <Self::Number as Number>::Mask,
        yes: Self::Displacement,
        no: Self::Displacement,
    ) -> Self::Displacement;

    /// The displacement `new`, or in lanes `old` where the mask is true. A single state is asked
    /// for only while its mask is false, and takes the new one without looking.
    #[doc(hidden)]
    fn unless(
        mask: <Self::Number as Number>::Mask,
        old: Self::Displacement,
        new: Self::Displacement,
    ) -> Self::Displacement;

    /// The number of components; any displacement of the state will do.
    #[doc(hidden)]
    fn components(self, displacement: Self::Displacement) -> usize;

    /// The state with one component, counted from 0, multiplied by `factor`.
    #[doc(hidden)]
    #[must_use]
    fn with_scaled(self, component: usize, factor: f64) -> Self;
}

impl<Z: Components> Measurable for Z {
    type Number = f64;

    #[inline(always)]
    fn size(self, displacement: Z::Displacement) -> f64 {
        let mut sum = 0.0;
        self.for_each_component(self, displacement, |x, _, _| sum += x.abs());
        sum
    }

    #[inline(always)]
    fn size_of(self, displacement: Z::Displacement) -> f64 {
        let mut sum = 0.0;
        self.for_each_component(self, displacement, |_, _, x| sum += x.abs());
        sum
    }

    #[inline(always)]
    fn times(displacement: Z::Displacement, factor: f64) -> Z::Displacement {
        displacement * factor
    }

    #[inline(always)]
    fn select(mask: bool, yes: Z::Displacement, no: Z::Displacement) -> Z::Displacement {
        if mask { yes } else { no }
    }

    #[inline(always)]
    fn unless(_mask: bool, _old: Z::Displacement, new: Z::Displacement) -> Z::Displacement {
        new
    }

    fn components(self, displacement: Z::Displacement) -> usize {
        let mut count = 0;
        self.for_each_component(self, displacement, |_, _, _| count += 1);
        count
    }

    fn with_scaled(self, component: usize, factor: f64) -> Self {
        let mut index = 0;
        self.map_components(|x| {
            index += 1;
            if index - 1 == component { x * factor } else { x }
        })
    }
}

#[diagnostic::on_unimplemented(
    message = "`{Self}` is no component of a state",
    note = "components are `f64` and arrays of them, `[f64; 6]` or `[[f64; 3]; 2]`: a state is \
            copied, and `Vec` cannot be"
)]
/// What a component of a [`state!`](crate::state) may be: a number, or an array.
#[doc(hidden)]
pub trait Component: Copy {
    /// How many numbers it has.
    const COUNT: usize;

    /// With all of them zero.
    const ZERO: Self;

    /// The sum, number by number.
    #[must_use]
    fn plus(self, other: Self) -> Self;

    /// The difference, number by number.
    #[must_use]
    fn minus(self, other: Self) -> Self;

    /// Each number times `factor`.
    #[must_use]
    fn times(self, factor: f64) -> Self;

    /// As [`Components::for_each_component`].
    fn for_each(self, other: Self, displacement: Self, each: &mut impl FnMut(f64, f64, f64));

    /// As [`Components::map_components`].
    #[must_use]
    fn map_each(self, each: &mut impl FnMut(f64) -> f64) -> Self;
}

impl Component for f64 {
    const COUNT: usize = 1;
    const ZERO: Self = 0.0;

    #[inline(always)]
    fn plus(self, other: Self) -> Self {
        self + other
    }

    #[inline(always)]
    fn minus(self, other: Self) -> Self {
        self - other
    }

    #[inline(always)]
    fn times(self, factor: f64) -> Self {
        self * factor
    }

    #[inline(always)]
    fn for_each(self, other: Self, displacement: Self, each: &mut impl FnMut(f64, f64, f64)) {
        each(self, other, displacement);
    }

    #[inline(always)]
    fn map_each(self, each: &mut impl FnMut(f64) -> f64) -> Self {
        each(self)
    }
}

/// In loops: `map` is a call of a function where it is not compiled with this crate.
impl<C: Component, const N: usize> Component for [C; N] {
    const COUNT: usize = N * C::COUNT;
    const ZERO: Self = [C::ZERO; N];

    #[inline]
    fn plus(mut self, other: Self) -> Self {
        for (x, y) in self.iter_mut().zip(&other) {
            *x = x.plus(*y);
        }
        self
    }

    #[inline]
    fn minus(mut self, other: Self) -> Self {
        for (x, y) in self.iter_mut().zip(&other) {
            *x = x.minus(*y);
        }
        self
    }

    #[inline]
    fn times(mut self, factor: f64) -> Self {
        for x in &mut self {
            *x = x.times(factor);
        }
        self
    }

    #[inline]
    fn for_each(self, other: Self, displacement: Self, each: &mut impl FnMut(f64, f64, f64)) {
        for ((x, y), d) in self.iter().zip(&other).zip(&displacement) {
            x.for_each(*y, *d, each);
        }
    }

    #[inline]
    fn map_each(mut self, each: &mut impl FnMut(f64) -> f64) -> Self {
        for x in &mut self {
            *x = x.map_each(each);
        }
        self
    }
}

/// Defines a state of named components, each an `f64` or an array: a struct that can be displaced
/// and scaled, component by component, so that every method and the control of steps can work with
/// it. A [`System`](crate::System) of your own then needs only its equations.
///
/// ```
/// use pendula::{Grid, Rk4, System, integrate, state};
///
/// state! {
///     /// Predators and prey, in thousands; or their rates of change, a year.
///     pub struct Populations {
///         pub prey: f64,
///         pub predators: f64
///     }
/// }
///
/// /// Lotka's and Volterra's equations.
/// struct LotkaVolterra;
///
/// impl System for LotkaVolterra {
///     type State = Populations;
///
///     fn rate(&self, _t: f64, z: Populations) -> Populations {
///         Populations {
///             prey: z.prey - z.prey * z.predators,
///             predators: z.prey * z.predators - z.predators,
///         }
///     }
/// }
///
/// let start = Populations { prey: 2.0, predators: 1.0 };
/// let end = integrate(&LotkaVolterra, &Rk4, start, &Grid::with_duration(0.01, 10.0)?);
/// // What the motion conserves.
/// let constant = |z: Populations| z.prey - z.prey.ln() + z.predators - z.predators.ln();
/// assert!((constant(end) - constant(start)).abs() < 1e-8);
/// # Ok::<(), pendula::Error>(())
/// ```
///
/// Arrays may be of arrays, and of a length that is a parameter of the struct:
///
/// ```
/// use pendula::methods::Gauss4;
/// use pendula::systems::FromRate;
/// use pendula::{Grid, integrate, state};
///
/// state! {
///     /// Spinning tops without a torque: the angular momenta along their axes, and the time by a
///     /// clock beside them.
///     struct Tops<const N: usize> {
///         momenta: [[f64; 3]; N],
///         clock: f64,
///     }
/// }
///
/// // Euler's equations, for moments of inertia of 1, 2 and 3.
/// let free = FromRate::new(|_t, z: Tops<2>| Tops {
///     momenta: z.momenta.map(|[x, y, z]| [-y * z / 6.0, 2.0 * z * x / 3.0, -x * y / 2.0]),
///     clock: 1.0,
/// });
/// let start = Tops { momenta: [[0.0, 1.0, 0.1], [1.0, 0.0, 0.1]], clock: 0.0 };
/// let end = integrate(&free, &Gauss4, start, &Grid::with_duration(0.1, 100.0)?);
/// // Of each top the momentum keeps its length, which the method conserves, as a square.
/// for (before, after) in start.momenta.into_iter().zip(end.momenta) {
///     let square = |l: [f64; 3]| l.iter().map(|x| x * x).sum::<f64>();
///     assert!((square(after) - square(before)).abs() < 1e-12);
/// }
/// assert!((end.clock - 100.0).abs() < 1e-11);
/// # Ok::<(), pendula::Error>(())
/// ```
///
/// A state is `Copy`, so that steps and their stages need no allocator: `Vec` can be no component
/// of it. For states without names see [`Array`](crate::systems::Array) and
/// [`ArrayPhase`](crate::systems::ArrayPhase).
#[macro_export]
macro_rules! state {
    (
        $(#[$attribute:meta])*
        $visibility:vis struct $State:ident $(<$(const $N:ident: usize),+ $(,)?>)? {
            $($(#[$of_component:meta])* $visible:vis $component:ident: $Component:ty),+ $(,)?
        }
    ) => {
        $(#[$attribute])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        $visibility struct $State $(<$(const $N: usize),+>)? {
            $($(#[$of_component])* $visible $component: $Component,)+
        }

        $crate::state_operations! {
            [$($(const $N: usize),+)?] $State [$($($N),+)?] { $($component: $Component,)+ }
        }
    };
}

/// What makes a struct a state, its components named or numbered.
#[doc(hidden)]
#[macro_export]
macro_rules! state_operations {
    ([$($generics:tt)*] $State:ident [$($N:tt)*] { $($component:tt: $Component:ty,)+ }) => {
        impl<$($generics)*> ::core::default::Default for $State<$($N)*> {
            #[inline]
            fn default() -> Self {
                Self { $($component: <$Component as $crate::systems::Component>::ZERO,)+ }
            }
        }

        impl<$($generics)*> ::core::ops::Add for $State<$($N)*> {
            type Output = Self;

            #[inline]
            fn add(self, other: Self) -> Self {
                Self {
                    $($component: $crate::systems::Component::plus(
                        self.$component,
                        other.$component,
                    ),)+
                }
            }
        }

        impl<$($generics)*> ::core::ops::Sub for $State<$($N)*> {
            type Output = Self;

            #[inline]
            fn sub(self, other: Self) -> Self {
                Self {
                    $($component: $crate::systems::Component::minus(
                        self.$component,
                        other.$component,
                    ),)+
                }
            }
        }

        impl<$($generics)*> ::core::ops::Mul<f64> for $State<$($N)*> {
            type Output = Self;

            #[inline]
            fn mul(self, factor: f64) -> Self {
                Self {
                    $($component: $crate::systems::Component::times(self.$component, factor),)+
                }
            }
        }

        impl<$($generics)*> $crate::Vector for $State<$($N)*> {}

        impl<$($generics)*> $crate::Components for $State<$($N)*> {
            #[inline]
            fn for_each_component(
                self,
                other: Self,
                displacement: Self,
                mut each: impl FnMut(f64, f64, f64),
            ) {
                $($crate::systems::Component::for_each(
                    self.$component,
                    other.$component,
                    displacement.$component,
                    &mut each,
                );)+
            }

            #[inline]
            fn map_components(self, mut each: impl FnMut(f64) -> f64) -> Self {
                Self {
                    $($component: $crate::systems::Component::map_each(
                        self.$component,
                        &mut each,
                    ),)+
                }
            }
        }
    };
}

state! {
    /// A point (θ, ω) in the phase space of the pendulum, or a rate of change of one.
    ///
    /// As a state, `theta` is in rad and `omega` in rad/s; as a rate, both are per second.
    pub struct Phase {
        /// Angle from the downward vertical, unwrapped: it counts turns.
        pub theta: f64,
        /// Angular velocity, dθ/dt.
        pub omega: f64,
    }
}

impl From<[f64; 2]> for Phase {
    #[inline]
    fn from([theta, omega]: [f64; 2]) -> Self {
        Self { theta, omega }
    }
}

impl Phase {
    /// The pendulum held still at the angle `theta` (rad).
    pub const fn at_rest(theta: f64) -> Self {
        Self { theta, omega: 0.0 }
    }
}
