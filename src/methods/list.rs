//! The list of the library's methods, as macros that pass it on: to whom the type of each matters.

/// Passes the methods for every system, or every separable one, to the macro `$then`, as
/// `module::Method` pairs: the paper's four in the order of its tables, then the others. Further
/// arguments follow them.
#[macro_export]
#[doc(hidden)]
macro_rules! for_each_general_method {
    ($then:ident $(, $($more:tt)+)?) => {
        $then! {
            forward_euler::ForwardEuler,
            symplectic_euler::SymplecticEuler,
            rk4::Rk4,
            stormer_verlet::StormerVerlet,
            explicit_midpoint::ExplicitMidpoint,
            heun::Heun,
            position_verlet::PositionVerlet,
            ruth_3::Ruth3,
            forest_ruth::ForestRuth,
            suzuki_4::Suzuki4,
            blanes_moan_4::BlanesMoan4,
            yoshida_6::Yoshida6,
            blanes_moan_6::BlanesMoan6,
            yoshida_8::Yoshida8,
            kahan_li_8::KahanLi8,
            dormand_prince::DormandPrince,
            dop853::Dop853,
            implicit_midpoint::ImplicitMidpoint,
            trapezoidal::Trapezoidal,
            gauss_4::Gauss4,
            gauss_6::Gauss6,
            gauss_16::Gauss16,
            $($($more)+)?
        }
    };
}

/// Passes the list of methods to the macro `$then`: the [general ones](for_each_general_method),
/// and those that need more of a system. Further arguments follow them.
///
/// This is the list. `METHODS` is made from it, and so is every test that needs the type of each
/// method.
#[macro_export]
#[doc(hidden)]
macro_rules! for_each_method {
    ($then:ident $(, $($more:tt)+)?) => {
        $crate::for_each_general_method! {
            $then,
            discrete_gradient::DiscreteGradient,
            cieslinski_ratkiewicz::CieslinskiRatkiewicz,
            deuflhard::Deuflhard,
            processed_4::Processed4,
            processed_6::Processed6,
            taylor_24::Taylor24,
            $($($more)+)?
        }
    };
}

/// Passes the Runge–Kutta methods to the macro `$then`: those of the
/// [general ones](for_each_general_method) that need no splitting, and so suit every system.
#[macro_export]
#[doc(hidden)]
macro_rules! for_each_runge_kutta_method {
    ($then:ident) => {
        $then! {
            forward_euler::ForwardEuler,
            rk4::Rk4,
            explicit_midpoint::ExplicitMidpoint,
            heun::Heun,
            dormand_prince::DormandPrince,
            dop853::Dop853,
            implicit_midpoint::ImplicitMidpoint,
            trapezoidal::Trapezoidal,
            gauss_4::Gauss4,
            gauss_6::Gauss6,
            gauss_16::Gauss16,
        }
    };
}
