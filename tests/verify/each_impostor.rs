//! A function as a test for each wrong method of the zoo, by its name.

/// Makes of the function `$test` a test for each wrong method.
macro_rules! each_impostor {
    ($test:ident) => {
        pendula_zoo::for_each_impostor! { impostors, => $test }
    };
}

macro_rules! impostors {
    ($($name:ident: $impostor:expr, $truth:expr, [$($caught_by:ident),+];)+ => $test:ident) => {
        cases! { $test: $($name(stringify!($name)),)+ }
    };
}
