//! The list of the systems beyond the pendulum on which methods are found by their names.

/// Passes the list to the macro `$then`, and further arguments behind it. From it
/// `registry::ByName` is implemented, and a test asks whether every method that suits a system is
/// found on it.
///
/// `separable` stands before a system that splits into kick and drift, so that splitting methods
/// are found on it too; `general` before another.
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
