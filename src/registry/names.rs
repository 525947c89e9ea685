//! Methods by their names, on systems other than the pendulum.

use crate::registry::AnyMethod;
use crate::systems::{Compensated, Measurable, Pendulum, Separable, System};
use crate::{methods, systems};

/// A system on which the methods of the library are found by their names.
///
/// On a system of your own they are too, by one line, [`method_for`] or [`method_for_separable`].
/// With the feature `table` those for the systems of the library are compiled with it; without, in
/// your crate.
pub trait ByName: System + 'static {
    /// The method of that [name](crate::MethodInfo::name); none if there is no such method, or if
    /// it needs more of a system than this one has.
    fn method_named(name: &str) -> Option<&'static dyn AnyMethod<Self>>
    where
        Self: Sized;
}

macro_rules! find {
    ($name:ident in $($method:ident)+) => {{
        $(if $name == methods::Info::info(&methods::$method).name {
            return Some(&methods::$method);
        })+
        None
    }};
}

macro_rules! for_every_system {
    ($($module:ident::$method:ident,)+) => {
        /// The Runge–Kutta method of that [name](crate::MethodInfo::name), explicit or implicit,
        /// which is one for every system.
        pub fn method_for<S>(name: &str) -> Option<&'static dyn AnyMethod<S>>
        where
            S: System<State: Measurable> + Clone + 'static,
        {
            find!(name in $($method)+)
        }
    };
}
crate::for_each_runge_kutta_method!(for_every_system);

macro_rules! for_every_separable_system {
    ($($module:ident::$method:ident,)+) => {
        /// The Runge–Kutta or splitting method of that [name](crate::MethodInfo::name), which is
        /// one for every separable system.
        pub fn method_for_separable<S>(name: &str) -> Option<&'static dyn AnyMethod<S>>
        where
            S: Separable<State: Measurable> + Clone + 'static,
        {
            find!(name in $($method)+)
        }
    };
}
crate::for_each_general_method!(for_every_separable_system);

macro_rules! for_the_pendulum {
    ($($module:ident::$method:ident,)+) => {
        /// The method of that [name](crate::MethodInfo::name) on the pendulum, with the time in
        /// seconds: the bits of [`integrate`](crate::integrate()).
        #[cfg_attr(not(feature = "table"), inline)]
        pub fn in_seconds(name: &str) -> Option<&'static dyn AnyMethod> {
            find!(name in $($method)+)
        }

        impl ByName for Pendulum {
            fn method_named(name: &str) -> Option<&'static dyn AnyMethod> {
                super::method_named(name)
            }
        }

        impl ByName for Compensated<Pendulum> {
            #[cfg_attr(not(feature = "table"), inline)]
            fn method_named(name: &str) -> Option<&'static dyn AnyMethod<Self>> {
                find!(name in $($method)+)
            }
        }
    };
}
crate::for_each_method!(for_the_pendulum);

macro_rules! method_on {
    (separable) => {
        method_for_separable
    };
    (general) => {
        method_for
    };
}

macro_rules! by_name {
    ($($mark:ident $System:ident,)+) => {
        $(impl ByName for systems::$System {
            #[cfg_attr(not(feature = "table"), inline)]
            fn method_named(name: &str) -> Option<&'static dyn AnyMethod<Self>> {
                let find = method_on!($mark);
                find(name)
            }
        })+
    };
}
crate::for_each_system!(by_name);
