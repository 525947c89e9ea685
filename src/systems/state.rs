//! States of systems, and the pendulum's: the point in phase space.

use core::ops::{Add, Mul};

use crate::arithmetic::number::Number;

#[diagnostic::on_unimplemented(
    message = "`{Self}` has no named components that can be added and scaled",
    note = "`pendula::state!` makes a state of named components"
)]
/// A rate of change, or a small displacement: it can be added and scaled.
///
/// A Runge–Kutta method needs no more. Components keep their names in the type that implements this
/// trait.
pub trait Vector: Copy + Add<Output = Self> + Mul<f64, Output = Self> {}

#[diagnostic::on_unimplemented(
    message = "`{Self}` is no state of a system",
    note = "`pendula::state!` makes a state of named components"
)]
/// A state: a displacement can be added to it.
///
/// Where states themselves form a vector space they are their own displacements. An angle kept as
/// half turns and a remainder is a point, not a vector: it cannot be scaled.
pub trait State: Copy + Add<Self::Displacement, Output = Self> {
    /// The difference of two states.
    type Displacement: Vector;
}

impl<V: Vector> State for V {
    type Displacement = V;
}

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

/// A state of which sizes can be compared: what the iteration of an implicit method needs. Every
/// state of named [`Components`] is one, and so are many such states in lanes.
#[doc(hidden)]
pub trait Measurable: State {
    /// A size: one number, or one for each lane.
    type Number: Number;

    /// The sum of the absolute values of the components; any displacement of the state will do. A
    /// sum, not a maximum, which would ignore a NaN.
    fn size(self, displacement: Self::Displacement) -> Self::Number;

    /// The sum of the absolute values of the components of a `displacement` of this state.
    fn size_of(self, displacement: Self::Displacement) -> Self::Number;

    /// A `displacement` of this state times `factor`, in each lane its own.
    fn times(displacement: Self::Displacement, factor: Self::Number) -> Self::Displacement;

    /// The displacement `yes` where the mask is true, `no` elsewhere.
    fn select(
        mask: <Self::Number as Number>::Mask,
        yes: Self::Displacement,
        no: Self::Displacement,
    ) -> Self::Displacement;

    /// The displacement `new`, or in lanes `old` where the mask is true. A single state is asked
    /// for only while its mask is false, and takes the new one without looking.
    fn unless(
        mask: <Self::Number as Number>::Mask,
        old: Self::Displacement,
        new: Self::Displacement,
    ) -> Self::Displacement;

    /// The number of components; any displacement of the state will do.
    fn components(self, displacement: Self::Displacement) -> usize;

    /// The state with one component, counted from 0, multiplied by `factor`.
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

/// What can be taken apart into numbers and put together again with the same bits: a state, or what
/// a step carries to the next.
#[doc(hidden)]
pub trait Numbers<N = f64>: Copy {
    /// How many numbers it has.
    const COUNT: usize;

    /// Passes its numbers to `write`, one after the other.
    fn write(self, write: &mut impl FnMut(N));

    /// Puts it together from the numbers that [`write`](Numbers::write) passed on, in their order.
    fn read(next: &mut impl FnMut() -> N) -> Self;
}

impl<N> Numbers<N> for () {
    const COUNT: usize = 0;

    #[inline]
    fn write(self, _write: &mut impl FnMut(N)) {}

    #[inline]
    fn read(_next: &mut impl FnMut() -> N) -> Self {}
}

impl<N: Number> Numbers<N> for N {
    const COUNT: usize = 1;

    #[inline(always)]
    fn write(self, write: &mut impl FnMut(N)) {
        write(self);
    }

    #[inline(always)]
    fn read(next: &mut impl FnMut() -> N) -> Self {
        next()
    }
}

/// Defines a state of named components, each an `f64`: a struct that can be displaced and scaled,
/// component by component, so that every method and the control of steps can work with it. A
/// [`System`](crate::System) of your own then needs only its equations.
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
/// let end = integrate(&LotkaVolterra, &Rk4, start, &Grid::with_duration(0.01, 10.0)?, &mut ());
/// // What the motion conserves.
/// let constant = |z: Populations| z.prey - z.prey.ln() + z.predators - z.predators.ln();
/// assert!((constant(end) - constant(start)).abs() < 1e-8);
/// # Ok::<(), pendula::Error>(())
/// ```
#[macro_export]
macro_rules! state {
    (
        $(#[$attribute:meta])*
        $visibility:vis struct $State:ident {
            $($(#[$of_component:meta])* $visible:vis $component:ident: f64),+ $(,)?
        }
    ) => {
        $(#[$attribute])*
        #[derive(Clone, Copy, Debug, Default, PartialEq)]
        $visibility struct $State {
            $($(#[$of_component])* $visible $component: f64,)+
        }

        impl ::core::ops::Add for $State {
            type Output = Self;

            #[inline]
            fn add(self, other: Self) -> Self {
                Self { $($component: self.$component + other.$component,)+ }
            }
        }

        impl ::core::ops::Sub for $State {
            type Output = Self;

            #[inline]
            fn sub(self, other: Self) -> Self {
                Self { $($component: self.$component - other.$component,)+ }
            }
        }

        impl ::core::ops::Mul<f64> for $State {
            type Output = Self;

            #[inline]
            fn mul(self, factor: f64) -> Self {
                Self { $($component: self.$component * factor,)+ }
            }
        }

        impl $crate::Vector for $State {}

        impl $crate::Components for $State {
            #[inline]
            fn for_each_component(
                self,
                other: Self,
                displacement: Self,
                mut each: impl FnMut(f64, f64, f64),
            ) {
                $(each(self.$component, other.$component, displacement.$component);)+
            }

            #[inline]
            fn map_components(self, mut each: impl FnMut(f64) -> f64) -> Self {
                Self { $($component: each(self.$component),)+ }
            }
        }

        impl $crate::systems::Numbers for $State {
            const COUNT: usize = [$(::core::stringify!($component)),+].len();

            #[inline]
            fn write(self, write: &mut impl FnMut(f64)) {
                $(write(self.$component);)+
            }

            #[inline]
            fn read(next: &mut impl FnMut() -> f64) -> Self {
                Self { $($component: next(),)+ }
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

impl Phase {
    /// The pendulum held still at the angle `theta` (rad).
    pub const fn at_rest(theta: f64) -> Self {
        Self { theta, omega: 0.0 }
    }
}
