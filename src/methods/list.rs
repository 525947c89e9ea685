//! The list of the library's methods, as macros that pass it on: to whom the type of each matters.

/// This is the list: the paper's four in the order of its tables, then the others, each with the
/// systems that it suits. `METHODS` is made from it, and so is every test that needs the type of
/// each method.
///
/// `every` stands before a Runge–Kutta method, which suits every system; `separable` before one
/// that needs a splitting; `special` before one that asks more of a system.
#[macro_export]
#[doc(hidden)]
macro_rules! listed_methods {
    ($those:ident $then:ident [$($more:tt)*]) => {
        $crate::chosen_methods! {
            $those $then [$($more)*] []
            every forward_euler::ForwardEuler,
            separable symplectic_euler::SymplecticEuler,
            every rk4::Rk4,
            separable stormer_verlet::StormerVerlet,
            every explicit_midpoint::ExplicitMidpoint,
            every heun::Heun,
            separable position_verlet::PositionVerlet,
            separable ruth_3::Ruth3,
            separable forest_ruth::ForestRuth,
            separable suzuki_4::Suzuki4,
            separable blanes_moan_srkn_6b::BlanesMoanSrkn6b,
            separable yoshida_6::Yoshida6,
            separable blanes_moan_6::BlanesMoan6,
            separable blanes_moan_srkn_14a::BlanesMoanSrkn14a,
            separable yoshida_8::Yoshida8,
            separable kahan_li_8::KahanLi8,
            every dormand_prince::DormandPrince,
            every dop853::Dop853,
            every implicit_midpoint::ImplicitMidpoint,
            every trapezoidal::Trapezoidal,
            every gauss_4::Gauss4,
            every gauss_6::Gauss6,
            every gauss_16::Gauss16,
            special discrete_gradient::DiscreteGradient,
            special cieslinski_ratkiewicz::CieslinskiRatkiewicz,
            special deuflhard::Deuflhard,
            special processed_4::Processed4,
            special processed_6::Processed6,
            special taylor_24::Taylor24,
        }
    };
}

/// Passes those of the list on, without their marks, that are `for_every_system`, `for_separable`
/// systems or `for_pendulum`, one method a step.
#[macro_export]
#[doc(hidden)]
macro_rules! chosen_methods {
    ($those:ident $then:ident [$($more:tt)*] [$($chosen:tt)*]) => {
        $then! { $($chosen)* $($more)* }
    };
    (for_every_system $then:ident $more:tt [$($chosen:tt)*]
        every $module:ident::$method:ident, $($rest:tt)*) => {
        $crate::chosen_methods! {
            for_every_system $then $more [$($chosen)* $module::$method,] $($rest)*
        }
    };
    (for_every_system $then:ident $more:tt $chosen:tt
        $other:ident $module:ident::$method:ident, $($rest:tt)*) => {
        $crate::chosen_methods! { for_every_system $then $more $chosen $($rest)* }
    };
    (for_separable $then:ident $more:tt $chosen:tt
        special $module:ident::$method:ident, $($rest:tt)*) => {
        $crate::chosen_methods! { for_separable $then $more $chosen $($rest)* }
    };
    ($those:ident $then:ident $more:tt [$($chosen:tt)*]
        $mark:ident $module:ident::$method:ident, $($rest:tt)*) => {
        $crate::chosen_methods! {
            $those $then $more [$($chosen)* $module::$method,] $($rest)*
        }
    };
}

/// Passes the methods for every system, or every separable one, to the macro `$then`, as
/// `module::Method` pairs in the order of the list. Further arguments follow them.
#[macro_export]
#[doc(hidden)]
macro_rules! for_each_general_method {
    ($then:ident $(, $($more:tt)+)?) => {
        $crate::listed_methods! { for_separable $then [$($($more)+)?] }
    };
}

/// Passes the list of methods to the macro `$then`: the [general ones](for_each_general_method),
/// and those that need more of a system. Further arguments follow them.
#[macro_export]
#[doc(hidden)]
macro_rules! for_each_method {
    ($then:ident $(, $($more:tt)+)?) => {
        $crate::listed_methods! { for_pendulum $then [$($($more)+)?] }
    };
}

/// Passes the Runge–Kutta methods to the macro `$then`: those of the
/// [general ones](for_each_general_method) that need no splitting, and so suit every system.
#[macro_export]
#[doc(hidden)]
macro_rules! for_each_runge_kutta_method {
    ($then:ident) => {
        $crate::listed_methods! { for_every_system $then [] }
    };
}
