//! The list of the zoo.

use crate::properties::{
    AREA, CLOCK, CONJUGACY, ERROR_CONSTANT, LINEAR, ORDER, Property, REVERSAL, SYMMETRY, WORK,
};
use pendula::arithmetic::sine::{cos, sin};
use pendula::methods::{
    Deuflhard, DiscreteGradient, Dop853, ForestRuth, Gauss4, Processed4, Processed6, Rk4,
    StormerVerlet, SymplecticEuler, Taylor24, Trapezoidal, Yoshida6,
};
use pendula::{AnyMethod, Info, MethodInfo};

use super::high_order::{self, EntryOff, TermDropped};
use super::runge_kutta::Tableau;
use super::verlet::Kicks;
use super::{completing, euler, processed, verlet, wrapped};

/// A wrong method.
pub struct Impostor {
    /// Its name, in snake case.
    pub name: &'static str,
    /// It, with the entry of the method that it poses as.
    pub method: Box<dyn AnyMethod>,
    /// The method that it poses as.
    pub poses_as: MethodInfo,
    /// The properties that catch it; all others let it pass.
    pub caught_by: &'static [Property],
}

impl Impostor {
    /// Its name in text.
    pub fn title(&self) -> String {
        const PROPER: [&str; 8] =
            ["Euler", "RK4", "Verlet", "Heun", "Yoshida", "Gauss", "DOP853", "Taylor"];
        let words = self.name.split('_').map(|word| {
            PROPER.into_iter().find(|proper| proper.eq_ignore_ascii_case(word)).unwrap_or(word)
        });
        // A name has no minus.
        words.collect::<Vec<_>>().join(" ").replace("1e ", "1e-")
    }
}

/// Passes the list to the macro `$then`, each case as `name: impostor, the method that it poses as,
/// [the properties that catch it];`. Further arguments follow them.
#[macro_export]
macro_rules! for_each_impostor {
    ($then:ident $(, $($more:tt)+)?) => {
        $then! {
            forward_euler_posing_as_symplectic_euler:
                euler::Forward, SymplecticEuler,
                [ERROR_CONSTANT, LINEAR, AREA, CONJUGACY];
            drift_kick_for_kick_drift:
                euler::DriftKick, SymplecticEuler,
                [ERROR_CONSTANT, LINEAR, CONJUGACY];
            symplectic_euler_with_the_mean_velocity:
                euler::MeanVelocity, SymplecticEuler,
                [ERROR_CONSTANT, LINEAR, AREA, CONJUGACY];
            a_billionth_lost_a_step:
                wrapped::ABillionthLost(SymplecticEuler), SymplecticEuler,
                [ERROR_CONSTANT, LINEAR, AREA, CONJUGACY];
            a_trillionth_lost_a_step:
                wrapped::ATrillionthLost(StormerVerlet), StormerVerlet,
                [ERROR_CONSTANT, LINEAR, REVERSAL, CONJUGACY];
            position_verlet_for_velocity_verlet:
                verlet::PositionForm, StormerVerlet,
                [ERROR_CONSTANT, LINEAR, CONJUGACY, WORK];
            force_evaluated_twice:
                verlet::EvaluatedTwice, StormerVerlet,
                [WORK];
            heun_posing_as_verlet:
                verlet::Heun, StormerVerlet,
                [ERROR_CONSTANT, LINEAR, AREA, REVERSAL, CONJUGACY, WORK];
            leapfrog_begun_without_its_half_kick:
                verlet::Unstaggered, StormerVerlet,
                [ORDER, ERROR_CONSTANT, LINEAR, REVERSAL, CONJUGACY, WORK];
            one_half_kick_missing:
                Kicks { second: 0.0, ..Kicks::RIGHT }, StormerVerlet,
                [ORDER, ERROR_CONSTANT, LINEAR, REVERSAL, CONJUGACY];
            full_kicks:
                Kicks { first: 1.0, second: 1.0, ..Kicks::RIGHT }, StormerVerlet,
                [ORDER, ERROR_CONSTANT, LINEAR, CONJUGACY];
            kicks_of_one_third_and_two:
                Kicks { first: 1.0 / 3.0, second: 2.0 / 3.0, ..Kicks::RIGHT }, StormerVerlet,
                [ORDER, ERROR_CONSTANT, LINEAR, REVERSAL, CONJUGACY];
            second_kick_with_the_old_force:
                Kicks { stale_kick: true, ..Kicks::RIGHT }, StormerVerlet,
                [ORDER, ERROR_CONSTANT, LINEAR, AREA, REVERSAL, CONJUGACY];
            stale_force_handed_on:
                Kicks { stale_memory: true, ..Kicks::RIGHT }, StormerVerlet,
                [ORDER, ERROR_CONSTANT, LINEAR, REVERSAL, CONJUGACY];
            weights_of_the_three_eighths_rule:
                Tableau::weighing([0.125, 0.375, 0.375, 0.125]), Rk4,
                [ORDER, ERROR_CONSTANT, LINEAR];
            weights_1_3_1_1:
                Tableau::weighing([1.0 / 6.0, 0.5, 1.0 / 6.0, 1.0 / 6.0]), Rk4,
                [ORDER, ERROR_CONSTANT, LINEAR];
            equal_weights:
                Tableau::weighing([0.25; 4]), Rk4,
                [ORDER, ERROR_CONSTANT, LINEAR];
            midpoint_posing_as_rk4:
                Tableau::weighing([0.0, 1.0, 0.0, 0.0]), Rk4,
                [ORDER, ERROR_CONSTANT, LINEAR];
            k3_built_on_k1:
                Tableau { a31: 0.5, a32: 0.0, ..Tableau::RIGHT }, Rk4,
                [ORDER, ERROR_CONSTANT, LINEAR];
            k4_after_half_a_step:
                Tableau { a43: 0.5, ..Tableau::RIGHT }, Rk4,
                [ORDER, ERROR_CONSTANT, LINEAR];
            a21_off_by_1e_6:
                Tableau { a21: 0.500_001, ..Tableau::RIGHT }, Rk4,
                [ORDER, ERROR_CONSTANT, LINEAR];
            a32_off_by_1e_6:
                Tableau { a32: 0.500_001, ..Tableau::RIGHT }, Rk4,
                [ORDER, ERROR_CONSTANT, LINEAR];
            a43_off_by_1e_6:
                Tableau { a43: 1.000_001, ..Tableau::RIGHT }, Rk4,
                [ORDER, ERROR_CONSTANT, LINEAR];
            b1_off_by_1e_6:
                Tableau::weighing([0.166_667_666, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0]), Rk4,
                [ORDER, ERROR_CONSTANT, LINEAR];
            b2_and_b3_off_by_1e_6:
                Tableau::weighing([1.0 / 6.0, 1.0 / 3.0 + 1e-6, 1.0 / 3.0 - 1e-6, 1.0 / 6.0]), Rk4,
                [ORDER, ERROR_CONSTANT, LINEAR];
            half_the_step:
                wrapped::HalfTheStep(Rk4), Rk4,
                [ORDER, ERROR_CONSTANT, LINEAR];
            single_precision:
                wrapped::SinglePrecision(StormerVerlet), StormerVerlet,
                [ORDER, ERROR_CONSTANT, LINEAR, AREA, REVERSAL, CONJUGACY, SYMMETRY];
            angle_wrapped:
                wrapped::AngleWrapped(StormerVerlet), StormerVerlet,
                [ERROR_CONSTANT, LINEAR, CONJUGACY, SYMMETRY];
            one_step_short:
                wrapped::OneStepShort(StormerVerlet), StormerVerlet,
                [ORDER, ERROR_CONSTANT, LINEAR, AREA, REVERSAL, CONJUGACY, SYMMETRY, CLOCK];
            time_accumulated:
                wrapped::TimeAccumulated(StormerVerlet), StormerVerlet,
                [ORDER, ERROR_CONSTANT, CONJUGACY, SYMMETRY, CLOCK];
            g_times_l:
                wrapped::Accelerated(|p, theta| -p.gravity() * p.length() * sin(theta)),
                StormerVerlet,
                [ORDER, ERROR_CONSTANT, LINEAR, CONJUGACY, SYMMETRY];
            l_forgotten:
                wrapped::Accelerated(|p, theta| -p.gravity() * sin(theta)), StormerVerlet,
                [ORDER, ERROR_CONSTANT, LINEAR, CONJUGACY, SYMMETRY];
            mass_in_the_motion:
                wrapped::Accelerated(|p, theta| -p.frequency_squared() * p.mass() * sin(theta)),
                StormerVerlet,
                [ORDER, ERROR_CONSTANT, LINEAR, CONJUGACY, SYMMETRY];
            degrees_for_radians:
                wrapped::Accelerated(|p, theta| -p.frequency_squared() * sin(theta.to_radians())),
                StormerVerlet,
                [ORDER, ERROR_CONSTANT, LINEAR, CONJUGACY, SYMMETRY];
            wrong_sign_of_the_force:
                wrapped::Accelerated(|p, theta| p.frequency_squared() * sin(theta)), StormerVerlet,
                [ORDER, ERROR_CONSTANT, LINEAR, CONJUGACY];
            linearised_sine:
                wrapped::Accelerated(|p, theta| -p.frequency_squared() * theta), StormerVerlet,
                [ORDER, ERROR_CONSTANT, CONJUGACY, SYMMETRY];
            // (REVERSAL starts beside its separatrix, where rounding grows beyond what is derived.)
            cosine_for_sine:
                wrapped::Accelerated(|p, theta| -p.frequency_squared() * cos(theta)),
                StormerVerlet,
                [ORDER, ERROR_CONSTANT, LINEAR, REVERSAL, CONJUGACY, SYMMETRY];
            series_of_two_terms:
                wrapped::Accelerated(|p, theta| {
                    -p.frequency_squared() * (theta - theta * theta * theta / 6.0)
                }),
                StormerVerlet,
                [ORDER, ERROR_CONSTANT, CONJUGACY, SYMMETRY];
            root_of_g_over_l:
                wrapped::Accelerated(|p, theta| -p.small_angle_frequency() * sin(theta)),
                StormerVerlet,
                [ORDER, ERROR_CONSTANT, LINEAR, CONJUGACY, SYMMETRY];
            a_thousandth_lost_a_step:
                wrapped::AThousandthLost(StormerVerlet), StormerVerlet,
                [ORDER, ERROR_CONSTANT, LINEAR, AREA, REVERSAL, CONJUGACY];
            a_step_of_its_own:
                wrapped::ItsOwnStep(StormerVerlet), StormerVerlet,
                [ORDER, ERROR_CONSTANT, LINEAR, CONJUGACY, SYMMETRY];
            sine_to_seven_digits:
                wrapped::Accelerated(|p, theta| {
                    -p.frequency_squared() * f64::from(sin(theta) as f32)
                }),
                StormerVerlet,
                [ERROR_CONSTANT, LINEAR, AREA, REVERSAL, CONJUGACY];
            a_torque_of_1e_12:
                wrapped::Accelerated(|p, theta| 1e-12 - p.frequency_squared() * sin(theta)),
                StormerVerlet,
                [LINEAR, CONJUGACY, SYMMETRY];
            // (It is no palindrome, but so nearly one that REVERSAL detects it by a factor of three
            // only.)
            triple_jump_too_long_by_1e_6:
                high_order::TripleJumpTooLong, ForestRuth,
                [ORDER, ERROR_CONSTANT, LINEAR, REVERSAL];
            triple_jump_off_by_1e_6:
                high_order::TripleJumpOff, ForestRuth,
                [ORDER, ERROR_CONSTANT];
            yoshida_6_with_a_sign_lost:
                high_order::SignLost, Yoshida6,
                [ORDER, ERROR_CONSTANT, LINEAR];
            yoshida_6_in_six_digits:
                high_order::SixDigits, Yoshida6,
                [ORDER, ERROR_CONSTANT];
            gauss_4_swept_once:
                high_order::SweptOnce, Gauss4,
                [ORDER, ERROR_CONSTANT, LINEAR, AREA, REVERSAL, WORK];
            // (In the library, implicit steps of the pendulum are solved without units. These three
            // iterate until |Δθ| + |Δω| is rounding: SYMMETRY sees it in the last digit.)
            midpoint_for_the_trapezoidal_rule:
                completing::Midpoint(Trapezoidal), Trapezoidal,
                [ERROR_CONSTANT, AREA, CONJUGACY, SYMMETRY];
            trapezoidal_rule_swept_once:
                completing::SweptOnce, Trapezoidal,
                [ERROR_CONSTANT, LINEAR, REVERSAL, CONJUGACY, WORK];
            midpoint_for_the_discrete_gradient:
                completing::Midpoint(DiscreteGradient), DiscreteGradient,
                [ERROR_CONSTANT, AREA, SYMMETRY, WORK];
            mean_force_over_twice_the_way:
                completing::TwiceTheWay, DiscreteGradient,
                [ERROR_CONSTANT, SYMMETRY];
            // (The rotation by a rounded sine and cosine grows or shrinks by an ε each time, which
            // REVERSAL sees: in the library it is made of kicks and a drift, and cannot.)
            rotation_kick_rotation:
                completing::RotationFirst, Deuflhard,
                [ERROR_CONSTANT, REVERSAL, WORK];
            angles_from_one_bottom:
                completing::OneBottom, Deuflhard,
                [ERROR_CONSTANT, REVERSAL, SYMMETRY, WORK];
            dop853_with_a_stage_off_by_1e_6:
                EntryOff { row: "k7", term: "k5", by: 1e-6 }, Dop853,
                [ORDER, ERROR_CONSTANT];
            dop853_with_a_weight_off_by_1e_9:
                EntryOff { row: "step", term: "k9", by: 1e-9 }, Dop853,
                [ORDER, ERROR_CONSTANT];
            taylor_24_with_a_term_dropped_early:
                TermDropped { power: 5, factor: 2 }, Taylor24,
                [ORDER, ERROR_CONSTANT];
            taylor_24_with_a_term_dropped_late:
                TermDropped { power: 20, factor: 7 }, Taylor24,
                [ORDER, ERROR_CONSTANT];
            processed_4_without_its_processor:
                processed::ALONE, Processed4,
                [ORDER, ERROR_CONSTANT, LINEAR, CONJUGACY];
            processed_4_with_half_the_gradient:
                processed::HALF_THE_GRADIENT, Processed4,
                [ORDER, ERROR_CONSTANT, LINEAR, CONJUGACY];
            processed_4_undone_by_its_first_term:
                processed::FIRST_TERM, Processed4,
                [ERROR_CONSTANT, LINEAR, AREA, REVERSAL, CONJUGACY];
            processed_6_to_the_second_power:
                processed::SECOND_POWER, Processed6,
                [ORDER, ERROR_CONSTANT, CONJUGACY];
            processed_6_gradient_in_five_digits:
                processed::FIVE_DIGITS, Processed6,
                [ORDER, ERROR_CONSTANT, CONJUGACY];
            $($($more)+)?
        }
    };
}

macro_rules! collect {
    ($($name:ident: $impostor:expr, $truth:expr, [$($caught_by:ident),+];)+) => {
        /// Every wrong method of the zoo.
        pub fn impostors() -> Vec<Impostor> {
            vec![$(Impostor {
                name: stringify!($name),
                method: Box::new($impostor),
                poses_as: $truth.info(),
                caught_by: &[$($caught_by),+],
            }),+]
        }
    };
}
for_each_impostor!(collect);

/// The impostor of this name.
pub fn impostor_named(name: &str) -> Option<Impostor> {
    impostors().into_iter().find(|impostor| impostor.name == name)
}
