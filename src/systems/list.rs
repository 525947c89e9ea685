//! The list of the systems beyond the pendulum on which methods are found by their names.

/// This is the list, passed to the macro `$then`; further arguments follow it. `registry` makes of
/// it that methods are found on a system by their names, and a test asks whether all are found that
/// suit it.
///
/// `separable` stands before a system that splits into kick and drift, which splitting methods suit
/// too; `general` before another.
#[macro_export]
#[doc(hidden)]
macro_rules! for_each_system {
    ($then:ident $(, $($more:tt)+)?) => {
        $then! {
            separable Damped,
            separable Driven,
            separable Shaken,
            general DoublePendulum,
            $($($more)+)?
        }
    };
}
